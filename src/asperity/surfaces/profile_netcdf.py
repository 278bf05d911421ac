"""Line scans in classic NetCDF files, in the layout of SurfaceTopography and contact.engineering,
with our own record beside; and which of a map and a line scan a file of our own holds.

Dimension x; variable heights(x) with the attribute unit, x with length, unit and periodic; missing
points in the variable mask. The global attribute ``asperity_profile`` holds what the layout lacks,
so that a line scan comes back exactly.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..core.citations import Origin
from ..core.errors import FileFormatError, InputError
from ..core.scipy_parts import io
from . import formats_netcdf
from .formats import ChannelInfo
from .profile import Instrument, Profile
from .surface import Surface

RECORD = "asperity_profile"
"""Global attribute that marks a line scan written here: JSON of what the layout lacks."""

_MAGIC = b"CDF"
_DAMAGED = (LookupError, ValueError, TypeError, AttributeError, OverflowError, EOFError, OSError, RecursionError)


def write_profile(profile: Profile, path: Path) -> None:
    """Write ``profile`` to ``path``, heights and lengths in m."""
    origin = profile.origin
    record = {
        "spacing": profile.spacing,
        "periodic": profile.periodic,
        "lay_angle": _or_none(profile.lay_angle),
        "short_cutoff": profile.short_cutoff,
        "measured_with": {key: _or_none(value) for key, value in asdict(profile.instrument).items()},
        "source": origin.source,
        "channel": origin.channel,
        "instrument": {str(key): str(value) for key, value in origin.instrument.items()},
        "history": list(origin.history),
        "citation_keys": list(origin.citation_keys),
    }
    with _opened(path, "w") as file:
        setattr(file, RECORD, json.dumps(record).encode("ascii"))
        file.history = "\n".join(origin.history).encode("utf-8")
        file.createDimension("x", profile.n_points)
        axis = file.createVariable("x", "f8", ("x",))
        axis[:] = profile.x
        axis.length, axis.periodic = np.float64(profile.length), np.int32(profile.periodic)
        axis.unit, axis.units = b"m", b"m"
        kind = "f4" if profile.heights.dtype == np.float32 else "f8"
        heights = file.createVariable("heights", kind, ("x",))
        heights[:] = profile.heights
        heights.unit, heights.units, heights.long_name = b"m", b"m", b"heights, positive out of the solid"
        if profile.n_missing:
            file.createVariable("mask", "b", ("x",))[:] = profile.mask


def is_own(file: Path) -> bool:
    """Whether ``file`` is a NetCDF file of a map or a line scan that this package wrote."""
    return formats_netcdf.is_own(file) or is_own_profile(file)


def is_own_profile(file: Path) -> bool:
    """Whether ``file`` is a NetCDF file that :func:`write_profile` wrote."""
    if file.suffix.lower() != ".nc":
        return False
    with file.open("rb") as stream:
        if stream.read(3) != _MAGIC:
            return False
    try:
        with _opened(file, "r") as data:
            return RECORD in data._attributes
    except _DAMAGED:
        return False


def read_netcdf(file: Path) -> Surface | Profile:
    """Map or line scan that this package wrote to ``file``, equal to the last bit.

    Raises FileFormatError if the file is damaged.
    """
    return _read_profile(file) if is_own_profile(file) else formats_netcdf.read_netcdf(file)


def netcdf_channel(file: Path) -> ChannelInfo:
    """The one map or line scan of a file of our own."""
    if not is_own_profile(file):
        return formats_netcdf.netcdf_channel(file)
    found = _read_profile(file)
    return ChannelInfo(0, "heights", (found.n_points,), (found.length,), "m", True)


def _read_profile(file: Path) -> Profile:
    """Line scan that :func:`write_profile` wrote to ``file``."""
    try:
        with _opened(file, "r") as data:
            record = json.loads(data._attributes[RECORD])
            values = np.array(data.variables["heights"][:])
        known: dict[str, Any] = {
            key: math.nan if value is None else value for key, value in record["measured_with"].items()
        }
        return Profile(
            values.astype(values.dtype.newbyteorder("=")),
            record["spacing"],
            periodic=record["periodic"],
            lay_angle=math.nan if record["lay_angle"] is None else record["lay_angle"],
            instrument=Instrument(**known),
            short_cutoff=record["short_cutoff"],
            origin=Origin(
                record["source"],
                record["channel"],
                record["instrument"],
                tuple(record["history"]),
                tuple(record["citation_keys"]),
            ),
        )
    except (*_DAMAGED, InputError) as error:
        raise FileFormatError(f"file {file} must hold a whole line scan, but is damaged ({error}).") from error


def _or_none(value: Any) -> Any:
    """``value``, None for NaN, which JSON has no word for."""
    return None if isinstance(value, float) and math.isnan(value) else value


def _opened(path: Path, mode: Literal["r", "w"]) -> Any:
    """SciPy's file object, whose attributes are those of the file."""
    return io.netcdf_file(path, mode, mmap=False, version=2)
