"""Nested cells of the CPU engine that end at a convolution."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import RealArray
from .blocks import FEW, Blocks
from .cpu_cells import CpuCells
from .cpu_face import CpuFace
from .protocol import CellWaves, Convolution, Face, Products


class CpuWaves:
    """Inverse of nested cells with waves on a working set (see ``wave_kernels``), a hierarchy and a product per thread."""

    def __init__(
        self, blocks: Blocks, cells: CpuCells, waves: CellWaves, products: tuple[Convolution, ...], dtype: str
    ) -> None:
        self._blocks = blocks
        self._cells = cells
        self._depth = waves.depth
        self._products = products
        self._fields = np.zeros((len(products), 5, *waves.cells), dtype)

    def restrict(self, face: Face) -> None:
        """Prepare for the points of ``face``."""
        self._cells.restrict(face)
        kernels = self._blocks.wave_kernels
        for levels, fields in zip(self._cells.levels, self._fields, strict=True):
            kernels.take(levels[self._depth], self._cells.s, fields[kernels.UNIT])

    def solve(self, face: Face, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``, nearly."""
        assert isinstance(face, CpuFace)
        self._blocks.share(self._deflect, len(self._products), face, r, alone=self._cells.g.size < FEW)
        return self._cells.at_points(face, r, other, out)

    def relieved(self, face: Face, r: RealArray, loaded: Face, change: RealArray, factor: float) -> RealArray:
        """r - factor times the deflection of nested cells, which is near enough."""
        return self._cells.relieved(face, r, loaded, change, factor)

    def _deflect(self, span: tuple[int, int], face: CpuFace, r: RealArray) -> None:
        """Deflections of the finest cells of the hierarchies of the span."""
        kernels: Any = self._blocks.wave_kernels
        cells = self._cells
        for number in range(*span):
            tower = cells.levels[number], cells.weights, cells.g, cells.s, self._depth
            fields, apply = self._fields[number], self._products[number].apply
            field, response = fields[kernels.FIELD], fields[kernels.RESPONSE]
            kernels.begin(tower, face.shape, face.rows, face.index, r, fields)
            apply(field, response)
            product = kernels.improve(tower, fields)
            apply(field, response)
            kernels.finish(tower, fields, product)
