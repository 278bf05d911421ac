"""Nested cells of the CPU engine: all levels of all hierarchies in one piece of memory."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import RealArray
from .blocks import FEW, Blocks
from .cpu_face import CpuFace
from .protocol import Face, Hierarchy, Products


class CpuCells:
    """Exact inverse of nested cells on a working set (see ``cell_kernels``), a hierarchy per thread."""

    def __init__(
        self, blocks: Blocks, shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy], dtype: str
    ) -> None:
        self._blocks = blocks
        self._shape = shape
        self.levels, size = _layout(shape, hierarchies)
        self.weights = np.array([1.0, *(merge.weight for merge in hierarchies[0].merges)], dtype)
        self.g = np.zeros(size, dtype)
        self.s = np.zeros(size, dtype)
        self._nothing = np.empty(0, dtype)

    def restrict(self, face: Face) -> None:
        """Prepare for the points of ``face``."""
        self._sweep("stiffen", face, self._nothing)

    def solve(self, face: Face, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``."""
        self._sweep("deflect", face, r)
        return self.at_points(face, r, other, out)

    def relieved(self, face: Face, r: RealArray, loaded: Face, change: RealArray, factor: float) -> RealArray:
        """r - factor times the deflection of the cells, which pass everything on: g = 1, and 0 on the rims."""
        for start, nx, ny, stride in self.levels[:, 1:, :4].reshape(-1, 4):
            self.g[start : start + nx * stride].reshape(nx, stride)[:, :ny] = 1.0
        self._sweep("deflect", loaded, change * change.dtype.type(factor))
        return np.asarray(self.at_points(face, r, r, np.empty_like(r)).vector)

    def at_points(self, face: Face, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """``r`` less the deflections of the finest cells that lie in s."""
        assert isinstance(face, CpuFace)
        sums = np.zeros((self._shape[0], 3))
        arguments = (self.levels, self._shape, face.rows, face.index, r, other, self.s, out, sums)
        relieve = self._blocks.cell_kernels.relieve
        self._blocks.share(relieve, self._shape[0], *arguments, alone=face.size < FEW)
        total, first, second = (float(value) for value in sums.sum(axis=0))
        return Products(out, total, first, second)

    def _sweep(self, kernel: str, face: Face, values: RealArray) -> None:
        assert isinstance(face, CpuFace)
        arguments = (self.levels, self.weights, self._shape, face.rows, face.index, values, self.g, self.s)
        call = getattr(self._blocks.cell_kernels, kernel)
        self._blocks.share(call, len(self.levels), *arguments, alone=self.g.size < FEW)


def _layout(shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy]) -> tuple[Any, int]:
    """Table ``levels`` of ``cell_kernels`` (hierarchy, level, column) and the memory in elements."""
    levels = np.zeros((len(hierarchies), len(hierarchies[0].merges) + 1, 10), np.int64)
    end = 0
    for number, hierarchy in enumerate(hierarchies):
        nx, ny = shape
        for depth, merge in enumerate(hierarchy.merges, start=1):
            nx, ny = merged(nx, merge.x, merge.offset_x), merged(ny, merge.y, merge.offset_y)
            stride = ny + 2
            flags = merge.x, merge.y, merge.offset_x, merge.offset_y
            levels[number, depth] = end + stride + 1, nx, ny, stride, *flags, *hierarchy.roll
            end += (nx + 2) * stride
    return levels, end


def merged(n: int, pairs: bool, offset: int) -> int:
    """Number of cells that ``n`` cells form in ``pairs`` (or stay), the first alone if ``offset`` is 1."""
    return ((n - 1 + offset) >> 1) + 1 if pairs else n
