"""Which points of a plane are wanted: all, a line along x or y (a vertical section of the body), or one (a depth profile)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid

Position: TypeAlias = float | Literal["max"]
"""Coordinate in m, or "max" for that of the largest pressure."""


@dataclass(frozen=True)
class Everywhere:
    """All points of the grid."""


@dataclass(frozen=True)
class Section:
    """Vertical plane x = const or y = const through the grid line nearest to the position.

    Parameters
    ----------
    x, y
        Exactly one of the two: position in m, or ``"max"`` for the plane through the largest pressure.

    Raises
    ------
    InputError
        If none or both are given, or one is neither a number nor "max".
    """

    x: Position | None = None
    y: Position | None = None

    def __post_init__(self) -> None:
        if (self.x is None) == (self.y is None):
            raise InputError(f"section must have exactly one of x and y, but has x={self.x!r}, y={self.y!r}.")
        _check(self.y if self.x is None else self.x, "position of a section (m)")


@dataclass(frozen=True)
class DepthProfile:
    """Line into the body at the grid point nearest to (x, y), by default under the largest pressure.

    Parameters
    ----------
    x, y
        Position in m, or ``"max"``.

    Raises
    ------
    InputError
        If a position is neither a number nor "max".
    """

    x: Position = "max"
    y: Position = "max"

    def __post_init__(self) -> None:
        _check(self.x, "x of a depth profile (m)")
        _check(self.y, "y of a depth profile (m)")


Where: TypeAlias = Everywhere | Section | DepthProfile
"""Points of every plane."""


@dataclass(frozen=True, eq=False)
class Selection:
    """Points of a grid: ``index`` picks them from an array (nx, ny); their coordinates ``x`` and ``y`` in m.

    ``dims`` names the axes that are left, in order.
    """

    index: tuple[int | slice, int | slice]
    x: RealArray
    y: RealArray
    dims: tuple[str, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points along each axis that is left."""
        return tuple({"x": self.x, "y": self.y}[dim].size for dim in self.dims)


def selection(where: Where, grid: Grid, pressure: RealArray) -> Selection:
    """Points of ``grid`` that ``where`` asks for; "max" is where ``pressure`` is largest.

    Raises
    ------
    InputError
        If ``where`` is of another type, or a position lies outside the grid.
    """
    if not isinstance(where, Everywhere | Section | DepthProfile):
        raise InputError(
            f"points of a plane must be Everywhere(), Section(...) or DepthProfile(...), but are {where!r}."
        )
    x, y = (line.ravel() for line in grid.coordinates())
    if isinstance(where, Everywhere):
        return Selection((slice(None), slice(None)), x, y, ("x", "y"))
    top = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
    if isinstance(where, DepthProfile):
        i, j = _nearest(where.x, x, int(top[0]), "x"), _nearest(where.y, y, int(top[1]), "y")
        return Selection((i, j), x[i], y[j], ())
    if where.x is not None:
        i = _nearest(where.x, x, int(top[0]), "x")
        return Selection((i, slice(None)), x[i], y, ("y",))
    assert where.y is not None
    j = _nearest(where.y, y, int(top[1]), "y")
    return Selection((slice(None), j), x, y[j], ("x",))


def _check(position: Position | None, what: str) -> None:
    if position != "max":
        require.finite(position, what, "Write a position, or 'max' for that of the largest pressure.")  # type: ignore[arg-type]


def _nearest(position: Position, line: RealArray, top: int, axis: str) -> int:
    if position == "max":
        return top
    step = float(line[1] - line[0]) if line.size > 1 else np.inf
    if not line[0] - step <= position <= line[-1] + step:
        raise InputError(
            f"{axis} of a section or profile (m) must lie between 0 and {line[-1]:g} on this grid, but is {position:g}."
        )
    return int(np.argmin(np.abs(line - position)))
