"""What instruments can measure: scales of files that cannot be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.status import Advice
from ..core.units import show

SCALE = "scale of the file"
"""Criterion of the finding that a size or the heights of a file cannot be."""


@dataclass(frozen=True)
class Family:
    """Instruments of one kind and what they can measure: sides, pixels and range of heights in m,
    from least to most."""

    name: str
    sides: tuple[float, float]
    pixels: tuple[float, float]
    heights: tuple[float, float]


PROBE = Family("a scanning probe microscope", (1e-10, 2e-3), (1e-13, 1e-4), (1e-14, 1e-3))
OPTICAL = Family("an optical profiler or microscope", (1e-7, 1.0), (1e-10, 1e-2), (1e-13, 0.1))
ANY = Family("any instrument", (1e-10, 10.0), (1e-13, 0.1), (1e-14, 1.0))

_FAMILIES = {
    **dict.fromkeys(("DI", "MDT", "IBW", "MI", "PS", "EZD", "WSXM", "JPK", "BCR", "NHF"), PROBE),
    **dict.fromkeys(
        ("OPD", "OPDx", "DATX", "MetroPro", "VK", "ZMG", "ZON", "OS3D", "AL3D", "PLU", "PLUX", "FRT"), OPTICAL
    ),
    **dict.fromkeys(("LEXT", "OIR", "POIR", "NMS", "TMD", "QEP", "Mitutoyo"), OPTICAL),
}
"""Families by the name of the reader, without "Reader"; files of all others may come from
anything."""

TERRAIN = "HGT"
"""Reader of terrain, which has no limits."""


def family_of(reader: str) -> Family:
    """Family of instruments whose files the ``reader`` reads."""
    return _FAMILIES.get(reader.removesuffix("Reader"), ANY)


def lateral_doubt(family: Family, size: tuple[float, ...], shape: tuple[int, ...]) -> str:
    """Why a stated ``size`` in m cannot be right, empty if it can."""
    for side, n in zip(size, shape, strict=True):
        least, most = family.sides
        if not least <= side <= most:
            return f"a side of {show(side, 'm')}, but {family.name} measures {show(least, 'm')} to {show(most, 'm')}"
        least, most = family.pixels
        if not least <= side / n <= most:
            return (
                f"pixels of {show(side / n, 'm')}, but those of {family.name} are {show(least, 'm')} to "
                f"{show(most, 'm')}"
            )
    return ""


def height_doubt(family: Family, heights: RealArray) -> str:
    """Why ``heights`` in m cannot be right, empty if they can."""
    valid = heights[np.isfinite(heights)]
    with np.errstate(all="ignore"):  # of numbers that are damaged
        extent = float(np.ptp(np.percentile(valid, (0.5, 99.5)))) if valid.size else 0.0
    least, most = family.heights
    if extent == 0.0 or least <= extent <= most:
        return ""
    return f"heights over {show(extent, 'm')}, but {family.name} measures {show(least, 'm')} to {show(most, 'm')}"


def scale_finding(lateral: str, vertical: str, *, line: bool = False) -> Advice:
    """The finding that a scale cannot be, from the reasons of :func:`lateral_doubt` and
    :func:`height_doubt`; of a ``line`` scan the unit along it is stated in place of a size."""
    along = "{give_lateral_unit}" if line else "{give_size}"
    remedies = [word for word, doubt in ((along, lateral), ("{give_height_unit}", vertical)) if doubt]
    return Advice(
        "warning",
        SCALE,
        f"The file states {' and '.join(doubt for doubt in (lateral, vertical) if doubt)}.",
        f"State the right one, or this one if it is right ({' and '.join(remedies)}).",
    )
