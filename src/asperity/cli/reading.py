"""A file with heights and the options for reading it, into a surface."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..surfaces.surface import Surface
    from .options import ReadingOptions


def read_surface(file: Path, reading: ReadingOptions) -> Surface:
    """Surface in ``file``; units are those that the options give."""
    from ..core.units import parse, parse_size
    from ..surfaces.read import read

    return read(
        file,
        channel=reading.channel,
        size=None if reading.size is None else parse_size(reading.size, "--size"),
        height_unit=reading.height_unit,
        z_scale=None if reading.z_scale is None else parse(reading.z_scale, "length", "--z-scale"),
    )


def level_of(surface: Surface, level: str) -> str:
    """What ``level`` removes from ``surface``: left to itself, the mean of a periodic one and the plane of any other."""
    return level if level != "auto" else "mean" if surface.periodic else "plane"
