"""Levels of neighbourhoods, by which points enter a working set.

While an iterate is not yet solved for, its residual on the loaded points is smooth: whole regions stand too high or too
low. Were unloaded points judged by the level of the plane, too many would enter in the one and too few in the other,
and the set would follow the error instead of the surface. They are judged by the mean level of the loaded points
near by, which is the level of the plane at the solution.
"""

from __future__ import annotations

import numpy as np

from ..arrays import RealArray

SIDE = 16
"""Points along the side of a square, a multiple of 8. Stiff films bend over a few pixels: squares of 64 take three times the steps."""

_PRIOR = 4.0
"""Loaded points that the mean over a larger square counts for in that of a smaller one."""


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
