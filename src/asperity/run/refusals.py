"""What a complete document would be refused for before anything is solved, without its surfaces
being made or read."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import AsperityError
from ..core.grid import Grid
from ..io.schemas.surfaces import FileSurface, SurfaceTable
from ..surfaces.surface import Surface
from .build import build, table_grid
from .document import checked

MOST_POINTS, UNKNOWN = 32, 1.0
"""Points along a side of a stand-in for a surface, and its sides in m where only a file states
them: no position in it is beyond these."""


class Refusal(NamedTuple):
    """A ``text``, and the table of the document that it is about, empty if that is not known."""

    place: str
    text: str


def refusals(table: Mapping[str, Any], folder: Path) -> tuple[Refusal, ...]:
    """The first thing for which the complete document ``table`` is refused before it is solved;
    nothing if it is not. Relative paths start at ``folder``.

    Surfaces are stood in for by waves of the size that is stated: what is wrong with a file, or
    with a step of preparation, is not found.

    Raises
    ------
    InputError
        If the document is incomplete or wrong.
    """
    document = checked(table)
    try:
        build(document, folder, surfaces=stand_ins)
    except AsperityError as error:
        return (Refusal(error.place, str(error)),)
    return ()


def stand_ins(table: SurfaceTable, counter: SurfaceTable | None, folder: Path) -> tuple[Surface, Surface | None]:
    """Waves of the size that is stated, for ``build`` in place of surface and counter surface."""
    surface = _stand_in(table)
    return surface, None if counter is None else surface


def _stand_in(table: SurfaceTable) -> Surface:
    grid = Grid((MOST_POINTS, MOST_POINTS), (UNKNOWN / MOST_POINTS, UNKNOWN / MOST_POINTS))
    if not isinstance(table, FileSurface):
        grid = table_grid(table)
    sliced = any(step.step == "slice" for step in table.prepare)
    nx, ny = (min(n, MOST_POINTS) for n in grid.shape)
    shape = (nx, 1 if sliced else ny)
    x, y = (np.cos(2.0 * np.pi * np.arange(n) / n) if n > 1 else np.ones(1) for n in shape)
    spacing = tuple(side / n for side, n in zip(grid.size, shape, strict=True))
    return Surface(1e-3 * min(spacing) * x[:, None] * y, *spacing, periodic=True)
