"""Surfaces in words for a table: label and text with units."""

from __future__ import annotations

from typing import TypeAlias

from ..core.units import show
from ..surfaces.characterise.heights import peak_to_valley, rms_height
from ..surfaces.surface import Surface

Rows: TypeAlias = list[tuple[str, str]]
"""Label and text of each row of a table."""


def surface_rows(surface: object) -> Rows:
    """What the ``surface`` is, where it comes from and what was done to it."""
    if not isinstance(surface, Surface):
        return [("shape", "perfectly flat")]
    origin, (nx, ny), (width, height) = surface.origin, surface.shape, surface.size
    rows = [
        ("source", origin.source or "given as an array"),
        ("channel", origin.channel),
        ("size", f"{show(width, 'm')} × {show(height, 'm')}"),
        ("points", f"{nx} × {ny}"),
        ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
        ("rms height", show(rms_height(surface), "m")),
        ("peak to valley", show(peak_to_valley(surface), "m")),
        ("periodic", "yes" if surface.periodic else "no"),
        *((f"step {number}", step) for number, step in enumerate(origin.history, start=1)),
        *((str(key), str(value)) for key, value in origin.instrument.items()),
    ]
    return [row for row in rows if row[1]]
