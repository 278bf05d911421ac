"""Surfaces in classic NetCDF files, in the layout of SurfaceTopography and contact.engineering,
with our own record beside.

Dimensions x, y; variable heights(x, y) with the attribute unit, x and y with length, unit and
periodic; missing points in the variable mask. The global attribute ``asperity_surface`` holds what
the layout lacks, so that a file of our own comes back exactly.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..core.errors import FileFormatError
from .formats import ChannelInfo
from .surface import Origin, Surface

RECORD = "asperity_surface"
"""Global attribute that marks a surface written here: JSON of the pixel, the period and the
origin."""

_MAGIC = b"CDF"


def is_own(file: Path) -> bool:
    """Whether ``file`` is a NetCDF file that :func:`write_netcdf` wrote."""
    if file.suffix.lower() != ".nc":
        return False
    with file.open("rb") as stream:
        if stream.read(3) != _MAGIC:
            return False
    return RECORD in _attributes(file)


def write_netcdf(surface: Surface, path: Path) -> None:
    """Write ``surface`` to ``path``, heights and lengths in m."""
    origin = surface.origin
    record = {
        "dx": surface.dx,
        "dy": surface.dy,
        "periodic": surface.periodic,
        "source": origin.source,
        "channel": origin.channel,
        "instrument": {str(key): str(value) for key, value in origin.instrument.items()},
        "history": list(origin.history),
        "citation_keys": list(origin.citation_keys),
    }
    with _opened(path, "w") as file:
        setattr(file, RECORD, json.dumps(record).encode("ascii"))
        file.history = "\n".join(origin.history).encode("utf-8")
        for name, n, d in zip("xy", surface.shape, surface.grid.spacing, strict=True):
            file.createDimension(name, n)
            axis = file.createVariable(name, "f8", (name,))
            axis[:] = np.arange(n) * d
            axis.length, axis.periodic = np.float64(n * d), np.int32(surface.periodic)
            axis.unit, axis.units = b"m", b"m"
        kind = "f4" if surface.heights.dtype == np.float32 else "f8"
        heights = file.createVariable("heights", kind, ("x", "y"))
        heights[:] = surface.heights
        heights.unit, heights.units, heights.long_name = b"m", b"m", b"heights, positive out of the solid"
        if surface.n_missing:
            file.createVariable("mask", "b", ("x", "y"))[:] = surface.mask


_DAMAGED = (LookupError, ValueError, TypeError, AttributeError, OverflowError, EOFError, OSError, RecursionError)
"""What SciPy and the reading of records raise on damaged files."""


def read_netcdf(file: Path) -> Surface:
    """Surface that :func:`write_netcdf` wrote to ``file``, equal to the last bit.

    Raises FileFormatError if the file is damaged.
    """
    try:
        record = json.loads(_attributes(file)[RECORD])
        with _opened(file, "r") as data:
            values = np.array(data.variables["heights"][:])
        heights = values.astype(values.dtype.newbyteorder("="))
        history, keys = tuple(record["history"]), tuple(record["citation_keys"])
        origin = Origin(record["source"], record["channel"], record["instrument"], history, keys)
        return Surface(heights, record["dx"], record["dy"], periodic=record["periodic"], origin=origin)
    except _DAMAGED as error:
        raise FileFormatError(f"file {file} must hold a whole surface, but is damaged ({error}).") from error


def netcdf_channel(file: Path) -> ChannelInfo:
    """The one channel of a file of our own."""
    surface = read_netcdf(file)
    return ChannelInfo(0, "heights", surface.shape, surface.size, "m", True)


def _attributes(file: Path) -> dict[str, Any]:
    """Global attributes of a classic NetCDF file, text decoded; empty if it is damaged."""
    try:
        with _opened(file, "r") as data:
            found = dict(data._attributes)
    except _DAMAGED:
        return {}
    return {
        key: value.decode("utf-8", "replace") if isinstance(value, bytes) else value for key, value in found.items()
    }


def _opened(path: Path, mode: Literal["r", "w"]) -> Any:
    """SciPy's file object, whose attributes are those of the file and hence of any name."""
    from scipy.io import netcdf_file

    return netcdf_file(path, mode, mmap=False, version=2)
