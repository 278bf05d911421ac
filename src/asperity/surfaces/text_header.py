"""What the header of a text says of the size of the map and the units of its numbers."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..core.errors import UnitError
from ..core.units import unit_factor


@dataclass(frozen=True)
class Stated:
    """What a header states: ``pixel`` and ``size`` (x, y) in m, and the ``height_unit``; None and
    empty where it does not."""

    pixel: tuple[float, float] | None = None
    size: tuple[float, float] | None = None
    height_unit: str = ""


_NUMBER = r"([+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+-]?\d+)?)"
_UNIT = r"\s*[\(\[]?\s*(nm|um|µm|μm|mm|m|pm|Å)\b"
_PIXELS = re.compile(
    r"\b(xy[ -]?calibration|pixel[ _-]?(?:size|width|pitch)|lateral (?:resolution|sampling)|"
    r"([xy])[ _-]?(?:pixel[ _-]?size|spacing|step|increment|pitch|calibration))\b[^\d+-]*" + _NUMBER + _UNIT,
    re.IGNORECASE,
)
_SIZES = re.compile(
    r"\b(scan[ _-]?size|field of view|size|([xy])[ _-]?(?:size|length|range|real|extent))\b[^\d+-]*" + _NUMBER + _UNIT,
    re.IGNORECASE,
)
_HEIGHTS = re.compile(
    r"^\W*(?:unit|z[ _-]?units?|height[ _-]?units?|value[ _-]?units?|data[ _-]?units?|units? (?:of "
    r")?(?:z|height|data))\b[\s:=,;]*[\(\[]?\s*(nm|um|µm|μm|mm|m|pm|Å)\W*$",
    re.IGNORECASE,
)


def stated_by(head: Sequence[str], cells: Callable[[str], list[str]]) -> Stated:
    """What the lines of a ``head`` state; ``cells`` takes a line apart.

    Pixel and size count only where they are given for both directions, or once for both.
    """
    pixels: dict[str, float] = {}
    sizes: dict[str, float] = {}
    height = ""
    for line in head:
        text = " ".join(cell.strip() for cell in cells(line.lstrip("#% ")))
        for pattern, found in ((_PIXELS, pixels), (_SIZES, sizes)):
            if hit := pattern.search(text):
                metres = float(hit[3].replace(",", ".")) * unit_factor(hit[4], "length", "unit of a header")
                for axis in (hit[2] or "xy").lower():
                    found.setdefault(axis, metres)
        if hit := _HEIGHTS.match(text):
            height = height or hit[1]
    pixel, size = (
        (found["x"], found["y"]) if {"x", "y"} <= found.keys() and min(found.values()) > 0.0 else None
        for found in (pixels, sizes)
    )
    return Stated(pixel, size, height)


def unit_of_name(name: str) -> str:
    """Unit of length that the name of a column states, as ``x (µm)``, ``z [nm]`` and ``height_nm``
    do; empty if it states none."""
    hit = re.search(r"[\(\[]\s*([^\)\]]+?)\s*[\)\]]\s*$", name) or re.search(r"[_ /](nm|um|µm|μm|mm|m)$", name.strip())
    if hit is None:
        return ""
    try:
        unit_factor(hit[1], "length", "unit of a column")
    except UnitError:
        return ""
    return hit[1]
