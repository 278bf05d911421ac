"""Coarser grids and the fields on them, for first guesses."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid


def coarse_grid(grid: Grid) -> Grid:
    """Grid of half as many points per side (rounded up) on the same area."""
    shape = (-(-grid.shape[0] // 2), -(-grid.shape[1] // 2))
    return Grid(shape, (grid.size[0] / shape[0], grid.size[1] / shape[1]))


def restricted(field: RealArray) -> RealArray:
    """Means of 2 x 2 points of ``field``; at an odd end the last point counts twice."""
    for axis in (0, 1):
        n = field.shape[axis]
        pairs = (
            np.take(field, np.minimum(np.arange(0, n, 2), n - 1), axis),
            np.take(field, np.minimum(np.arange(1, n + 1, 2), n - 1), axis),
        )
        field = 0.5 * (pairs[0] + pairs[1])
    return field
