"""One line of a map as a surface of one row, for contacts in plane strain."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from ...core import require
from ...core.errors import InputError
from ...core.units import show
from ..surface import Surface

Position: TypeAlias = float | Literal["middle"]
"""Coordinate in m from the corner, or "middle"."""


def sliced(surface: Surface, *, x: Position | None = None, y: Position | None = None, length: float = 1.0) -> Surface:
    """The line of ``surface`` at ``y``, or that at ``x`` turned into the x direction, as a surface (n, 1).

    Parameters
    ----------
    surface
        Map to cut.
    x, y
        Exactly one of the two: position in m from the corner; the line is that whose pixels hold it.
    length
        Length in m along y that the line stands for. Forces and areas of a line contact are those of this length, per
        metre with the 1 m of the default.

    Raises
    ------
    InputError
        If none or both positions are given, the position lies outside the map, or the length is not positive.
    """
    if (x is None) == (y is None):
        raise InputError(f"line of a map must be given by exactly one of x and y, but is given by x={x!r}, y={y!r}.")
    axis = 0 if y is None else 1
    position = x if y is None else y
    number = _index(surface, position, axis)
    heights = np.take(surface.heights, number, axis=axis)[:, None]
    at = show((number + 0.5) * surface.grid.spacing[axis], "m")
    step = f"sliced: line at {'xy'[axis]} = {at} ({heights.size} points)"
    return Surface(
        heights,
        surface.grid.spacing[1 - axis],
        require.positive(length, "length that a line of a map stands for (m)"),
        periodic=surface.periodic,
        origin=surface.origin.continued(step),
    )


def _index(surface: Surface, position: Position | None, axis: int) -> int:
    count, spacing, name = surface.shape[axis], surface.grid.spacing[axis], "xy"[axis]
    if position == "middle":
        return count // 2
    place = require.finite(position, f"{name} of a line of a map (m)", 'Or write "middle".')  # type: ignore[arg-type]
    if not 0.0 <= place <= count * spacing * (1.0 + 1e-9):
        raise InputError(
            f"{name} of a line must lie on the map, between 0 and {show(count * spacing, 'm')}, but is {show(place, 'm')}."
        )
    return min(int(place / spacing), count - 1)
