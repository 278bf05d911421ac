"""Levels of neighbourhoods, by which points enter a working set.

While an iterate is not yet solved for, its residual on the loaded points is smooth: whole regions stand too high or too
low. Were unloaded points judged by the level of the plane, too many would enter in the one and too few in the other,
and the set would follow the error instead of the surface. They are judged by the mean level of the loaded points
near by, which is the level of the plane at the solution.

What the residual scatters about that mean from point to point is error as well: a step on points that enter by less than it
is mostly undone by the next, and a stiff film, whose pressures change sign within a few pixels, may never settle. Points
enter that are beyond the mean by half of the scatter, which vanishes at the solution.
"""

from __future__ import annotations

import numpy as np

from ..arrays import RealArray

SIDE = 16
"""Points along the side of a square, a multiple of 8. Stiff films bend over a few pixels: squares of 64 take three times the steps."""

_PRIOR = 4.0
"""Loaded points that the mean over a larger square counts for in that of a smaller one."""

_MARGIN = 0.5
"""Share of the scatter. Film of E 10, h 4 pixels at 1024²: 32, 31, 28, 30, 29 pairs for 0, 0.3, 0.5, 0.7, 1, and 64, 42, 36, 34,
35 if every iterate keeps its bounds; a half-space 17 and 20 to 22 for all of them."""

_RESOLVED = 1e-14
"""Scatter² over mean square below which it is lost in the rounding of sums of squares."""


def entering_levels(squares: RealArray, level: float) -> RealArray:
    """Levels of r for each square (..., 2): unloaded points enter below the first, points at their cap above the second.

    ``squares`` holds the number of its movable points, their sum of r and of r².
    """
    count, total, square = (squares[..., kind] for kind in range(3))
    total, square = total - level * count, square - level * (2.0 * total - level * count)
    mean = local_means(squares[..., :2], level)
    spread = square - mean * (2.0 * total - mean * count)
    spread = np.where(spread > _RESOLVED * squares[..., 2], spread, 0.0)
    margin = _MARGIN * np.sqrt(local_means(np.stack([count, spread], axis=-1)))
    return np.asarray(level + np.stack([mean - margin, mean + margin], axis=-1))


def local_means(squares: RealArray, level: float = 0.0) -> RealArray:
    """Mean above ``level`` in each square of a grid, from ``squares[..., 0]``, the number of its points, and ``[..., 1]``, their sum.

    Where there are few points it falls back on the square of twice the side, and in the end on zero.
    """
    count = squares[..., 0]
    total = squares[..., 1] - level * count
    if count.size > 1:
        wider = local_means(_in_fours(squares), level).repeat(2, axis=0).repeat(2, axis=1)
        total += _PRIOR * wider[: count.shape[0], : count.shape[1]]
    return np.asarray(total / (count + _PRIOR))


def _in_fours(squares: RealArray) -> RealArray:
    """Sums over 2 x 2 squares; those beyond an odd end are zero."""
    nx, ny, kinds = squares.shape
    if nx % 2 or ny % 2:
        even = np.zeros((nx + nx % 2, ny + ny % 2, kinds))
        even[:nx, :ny] = squares
        squares = even
    return np.asarray(squares[::2, ::2] + squares[1::2, ::2] + squares[::2, 1::2] + squares[1::2, 1::2])
