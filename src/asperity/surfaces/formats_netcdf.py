"""Surfaces in classic NetCDF files, in the layout of SurfaceTopography and contact.engineering,
with our own record beside.

Dimensions x, y; variable heights(x, y) with the attribute unit, x and y with length, unit and
periodic; missing points in the variable mask. The global attribute ``asperity_surface`` holds what
the layout lacks, so that a file of our own comes back exactly.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..core.arrays import RealArray
from ..core.citations import Origin
from ..core.errors import FileFormatError
from ..core.scipy_parts import io
from .profile import Profile
from .surface import Surface

RECORD = "asperity_surface"
"""Global attribute that marks a surface written here: JSON of the pixel, the period and the
origin."""

_MAGIC = b"CDF"

DAMAGED = (LookupError, ValueError, TypeError, AttributeError, OverflowError, EOFError, OSError, RecursionError)
"""What SciPy and the reading of records raise on damaged files."""


def own_attributes(file: Path) -> dict[str, Any]:
    """Global attributes of a classic NetCDF file, text decoded; empty if it is another file, or
    damaged."""
    if file.suffix.lower() != ".nc":
        return {}
    with file.open("rb") as stream:
        if stream.read(3) != _MAGIC:
            return {}
    try:
        with opened(file, "r") as data:
            found = dict(data._attributes)
    except DAMAGED:
        return {}
    return {
        key: value.decode("utf-8", "replace") if isinstance(value, bytes) else value for key, value in found.items()
    }


def write_netcdf(surface: Surface, path: Path) -> None:
    """Write ``surface`` to ``path``, heights and lengths in m."""
    record = {"dx": surface.dx, "dy": surface.dy, "periodic": surface.periodic}
    write_heights(surface, surface.grid.spacing, path, RECORD, record)


def write_heights(
    held: Surface | Profile, spacing: Sequence[float], path: Path, mark: str, record: Mapping[str, Any]
) -> None:
    """Write the heights ``held``, points of a ``spacing`` in m along each axis, to ``path``, and
    under the attribute ``mark`` the ``record`` of what the layout lacks, with the origin."""
    origin = held.origin
    whole = {
        **record,
        "source": origin.source,
        "channel": origin.channel,
        "instrument": {str(key): str(value) for key, value in origin.instrument.items()},
        "history": list(origin.history),
        "citation_keys": list(origin.citation_keys),
    }
    names = ("x", "y")[: held.heights.ndim]
    with opened(path, "w") as file:
        setattr(file, mark, json.dumps(whole).encode("ascii"))
        file.history = "\n".join(origin.history).encode("utf-8")
        for name, n, d in zip(names, held.heights.shape, spacing, strict=True):
            file.createDimension(name, n)
            axis = file.createVariable(name, "f8", (name,))
            axis[:] = np.arange(n) * d
            axis.length, axis.periodic = np.float64(n * d), np.int32(held.periodic)
            axis.unit, axis.units = b"m", b"m"
        kind = "f4" if held.heights.dtype == np.float32 else "f8"
        heights = file.createVariable("heights", kind, names)
        heights[:] = held.heights
        heights.unit, heights.units, heights.long_name = b"m", b"m", b"heights, positive out of the solid"
        if held.n_missing:
            file.createVariable("mask", "b", names)[:] = held.mask


def heights_and_origin(file: Path, record: Mapping[str, Any]) -> tuple[RealArray, Origin]:
    """Heights in ``file`` in m, in the order of bytes of this machine, and the origin by its
    ``record``."""
    with opened(file, "r") as data:
        values = np.array(data.variables["heights"][:])
    history, keys = tuple(record["history"]), tuple(record["citation_keys"])
    origin = Origin(record["source"], record["channel"], record["instrument"], history, keys)
    return values.astype(values.dtype.newbyteorder("=")), origin


def read_netcdf(file: Path) -> Surface:
    """Surface that :func:`write_netcdf` wrote to ``file``, equal to the last bit.

    Raises FileFormatError if the file is damaged.
    """
    try:
        record = json.loads(own_attributes(file)[RECORD])
        heights, origin = heights_and_origin(file, record)
        return Surface(heights, record["dx"], record["dy"], periodic=record["periodic"], origin=origin)
    except DAMAGED as error:
        raise FileFormatError(f"file {file} must hold a whole surface, but is damaged ({error}).") from error


def opened(path: Path, mode: Literal["r", "w"]) -> Any:
    """SciPy's file object, whose attributes are those of the file and hence of any name."""
    return io.netcdf_file(path, mode, mmap=False, version=2)
