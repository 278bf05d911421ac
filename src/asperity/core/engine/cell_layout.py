"""How nested cells lie in memory for the compiled sweeps of ``cell_kernels``."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from .protocol import GROUP, SPARSE, Hierarchy


class Layout(NamedTuple):
    """How the cells of hierarchies lie in memory: table ``levels`` of ``cell_kernels`` (hierarchy, level, column), ``size`` in elements, ``runs`` that
    sweep whole rows, and number of ``groups`` of cells in a hierarchy. Shared: not to be written to."""

    levels: Any
    size: int
    runs: Any
    groups: int


def layout(shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy]) -> Layout:
    """Layout of the cells of ``hierarchies`` on a grid of ``shape``."""
    merges = tuple(tuple((int(m.x), int(m.y), m.offset_x, m.offset_y) for m in one.merges) for one in hierarchies)
    return _layout(shape, merges, tuple(one.roll for one in hierarchies))


@lru_cache(maxsize=32)
def _layout(
    shape: tuple[int, int], merges: tuple[tuple[tuple[int, ...], ...], ...], rolls: tuple[tuple[int, int], ...]
) -> Layout:
    """Layout for these ``merges`` (along x, along y, offsets) of every hierarchy and level, rolled by ``rolls``."""
    levels, tables = np.zeros((len(merges), len(merges[0]) + 1, 12), np.int64), []
    size, length, groups = 0, 0, [0] * len(merges)
    for number, hierarchy in enumerate(merges):
        nx, ny = shape
        for depth, (along_x, along_y, *offsets) in enumerate(hierarchy, start=1):
            nx, ny = merged(nx, bool(along_x), offsets[0]), merged(ny, bool(along_y), offsets[1])
            stride, across = ny + 2, -(-ny // GROUP) if depth <= SPARSE else 1
            table = np.zeros((nx, 1 + 2 * (-(-across // 2))), np.int32)
            table[:, :3] = 1, 0, ny
            flags = along_x, along_y, *offsets, *rolls[number]
            levels[number, depth] = size + stride + 1, nx, ny, stride, *flags, length, table.shape[1]
            size, length, groups[number] = size + (nx + 2) * stride, length + table.size, groups[number] + nx * across
            tables.append(table.ravel())
    return Layout(levels, size, np.concatenate(tables), max(groups))


def merged(n: int, pairs: bool, offset: int) -> int:
    """Number of cells that ``n`` cells form in ``pairs`` (or stay), the first alone if ``offset`` is 1."""
    return ((n - 1 + offset) >> 1) + 1 if pairs else n
