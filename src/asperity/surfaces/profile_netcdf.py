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
from typing import Any

from ..core.errors import FileFormatError
from . import formats_netcdf
from .formats import ChannelInfo
from .profile import Instrument, Profile
from .surface import Surface

RECORD = "asperity_profile"
"""Global attribute that marks a line scan written here: JSON of what the layout lacks."""


def write_profile(profile: Profile, path: Path) -> None:
    """Write ``profile`` to ``path``, heights and lengths in m."""
    record = {
        "spacing": profile.spacing,
        "periodic": profile.periodic,
        "lay_angle": _or_none(profile.lay_angle),
        "short_cutoff": profile.short_cutoff,
        "measured_with": {key: _or_none(value) for key, value in asdict(profile.instrument).items()},
    }
    formats_netcdf.write_heights(profile, (profile.spacing,), path, RECORD, record)


def is_own(file: Path) -> bool:
    """Whether ``file`` is a NetCDF file of a map or a line scan that this package wrote."""
    return not formats_netcdf.own_attributes(file).keys().isdisjoint((formats_netcdf.RECORD, RECORD))


def read_netcdf(file: Path) -> Surface | Profile:
    """Map or line scan that this package wrote to ``file``, equal to the last bit.

    Raises FileFormatError if the file is damaged.
    """
    text = formats_netcdf.own_attributes(file).get(RECORD)
    return formats_netcdf.read_netcdf(file) if text is None else _read_profile(file, text)


def netcdf_channel(file: Path) -> ChannelInfo:
    """The one map or line scan of a file of our own."""
    found = read_netcdf(file)
    if isinstance(found, Profile):
        return ChannelInfo(0, "heights", (found.n_points,), (found.length,), "m", True)
    return ChannelInfo(0, "heights", found.shape, found.size, "m", True)


def _read_profile(file: Path, text: str) -> Profile:
    """Line scan that :func:`write_profile` wrote to ``file``, with the ``text`` of its record."""
    try:
        record = json.loads(text)
        heights, origin = formats_netcdf.heights_and_origin(file, record)
        known: dict[str, Any] = {
            key: math.nan if value is None else value for key, value in record["measured_with"].items()
        }
        return Profile(
            heights,
            record["spacing"],
            periodic=record["periodic"],
            lay_angle=math.nan if record["lay_angle"] is None else record["lay_angle"],
            instrument=Instrument(**known),
            short_cutoff=record["short_cutoff"],
            origin=origin,
        )
    except formats_netcdf.DAMAGED as error:
        raise FileFormatError(f"file {file} must hold a whole line scan, but is damaged ({error}).") from error


def _or_none(value: Any) -> Any:
    """``value``, None for NaN, which JSON has no word for."""
    return None if isinstance(value, float) and math.isnan(value) else value
