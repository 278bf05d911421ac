"""How the levels of nested splines lie in memory.

``levels`` holds for every level the place of its first cell in memory, its cells along x and y, the
distance of its rows, whether the level below merges along x and y to it, and whether it averages
along them. Level 0 are the points themselves, in an array with a margin.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from .protocol import cells_of

START, ROWS, COLUMNS, STRIDE, MERGE_X, MERGE_Y, AVERAGE_X, AVERAGE_Y = range(8)

MARGIN = 2
"""Points kept beyond the rim of the array of points, for their neighbours."""

SOLVE, FACTORISE, DEFLECT = range(3)
"""What a sweep is for: the inverse, g for it, or the deflection by loads."""

PARTS = 64
"""Parts into which the rows of a level are divided among threads: the line of scratch memory of a
thread follows from its first part."""

_SHARED, _ALL_SHARED = 1 << 17, 1 << 19
"""Cells of a level from which on threads share its rows, and those of the points below: the first
level from 1024² points on for its sums (0.5 ms), from 2048² for the sweeps down (0.2 ms), which
take as long as it takes to wake a thread (0.03 to 0.18 ms, the latter in a virtual machine). Shared
from the same size on, half-spaces took 1.01 and films of E 10 on 4 pixels 1.04 times as long at
1024², on two threads."""

_GAP = 8
"""Points between the rows of the array of points: its margins, and so many that rows of 2^k points
do not collide in the cache."""


class Layout(NamedTuple):
    """Table ``levels`` of the sweeps; the number of levels ``large`` enough for threads to share
    their sums, of ``larger`` ones with all sweeps shared, and of all; the sizes of the arrays of
    ``points`` and of ``cells``."""

    levels: Any
    large: int
    larger: int
    top: int
    points: int
    cells: int


@lru_cache(maxsize=32)
def layout(
    shape: tuple[int, int],
    merges: tuple[tuple[bool, bool], ...],
    averages: tuple[tuple[bool, bool], ...],
    wraps: tuple[bool, bool],
) -> Layout:
    """Layout of nested splines on a grid of ``shape``."""
    (nx, ny), size, large, larger = shape, 0, 0, 0
    stride = ny + _GAP
    levels = [(2 * stride + 2, nx, ny, stride, 0, 0, 0, 0)]
    for (x, y), average in zip(merges, averages, strict=True):
        nx, ny = (cells_of(n, wrap) if merge else n for n, merge, wrap in zip((nx, ny), (x, y), wraps, strict=True))
        levels.append((size, nx, ny, ny, int(x), int(y), int(average[0]), int(average[1])))
        size += nx * ny
        large += int(nx * ny >= _SHARED)
        larger += int(nx * ny >= _ALL_SHARED)
    return Layout(np.array(levels, np.int64), large, larger, len(merges), (shape[0] + 5) * stride, size)
