"""Nested cells of the CPU engine with a coarse correction: sweeps end at the cells of one level, whose true compliance is a convolution A.

With S and T what the levels below pass up for given and for unit loads, the loads f on the cells follow from
(1/T + A) f = S/T, and the deflections are d = A f = (S - f)/T. Nested cells from there on up give a guess d0 and hence
f0 = S - T d0, whose residual is d0 - A f0; one step of conjugate gradients follows, preconditioned by nested cells again.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import RealArray
from .protocol import CoarseCompliance, Convolution, FreeSet, Products

if TYPE_CHECKING:
    from .cpu import Blocks, CpuCells


class CorrectedCells:
    """Inverse of nested cells with coarse correction, a hierarchy and a product per thread."""

    def __init__(
        self,
        blocks: Blocks,
        cells: CpuCells,
        coarse: CoarseCompliance,
        products: tuple[Convolution, ...],
        dtype: str,
    ) -> None:
        self._blocks = blocks
        self._cells = cells
        self._depth = coarse.depth
        self._products = products
        unit, argument, response = (np.zeros((len(products), *coarse.cells), dtype) for _ in range(3))
        self._unit, self._argument, self._response = unit, argument, response

    def factorise(self, free: FreeSet) -> None:
        """g of all cells and T of the coarse ones for the points of ``free``."""
        self._cells.factorise(free)
        for number, unit in enumerate(self._unit):
            sums = self._cells.level(number, self._depth)
            _within(unit, sums)[...] = sums

    def solve(self, free: FreeSet, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``, see ``protocol.Cells``."""
        self._blocks.share(self._deflect, len(self._products), free, r, serial=self._cells.serial)
        return self._cells.at_points(free, r, other, out)

    def predicted_residual(
        self, free: FreeSet, r: RealArray, loaded: FreeSet, change: RealArray, factor: float
    ) -> RealArray:
        """r - factor times the deflection of nested cells without coarse correction, which is near enough."""
        return self._cells.predicted_residual(free, r, loaded, change, factor)

    @np.errstate(over="ignore", invalid="ignore")  # as in compiled passes: what is not finite shows in the solution
    def _deflect(self, span: tuple[int, int], free: FreeSet, r: RealArray) -> None:
        """Deflections of the finest cells of the hierarchies of the span."""
        cells, depth, last = self._cells, self._depth, len(self._cells.weights) - 1
        for number in range(*span):
            s, argument, response = cells.level(number, depth), self._argument[number], self._response[number]
            unit, field, product = (_within(values, s) for values in (self._unit[number], argument, response))
            sweep = partial(cells.sweep_one, number, free, r)
            sweep((1, depth, depth, 0))
            sums = s.copy()
            sweep((depth + 1, last, depth, 0))
            guess = s.copy()
            np.subtract(sums, unit * guess, out=field)
            self._products[number].apply(argument, response)
            residual = guess - product
            np.multiply(unit, residual, out=s)
            sweep((depth + 1, last, depth, 0))
            step = residual - s  # the direction t of the step over T
            np.multiply(unit, step, out=field)
            gain = float(np.vdot(field.astype(float), residual))
            self._products[number].apply(argument, response)
            curvature = float(np.vdot(field.astype(float), step + product))
            length = s.dtype.type(gain / curvature if curvature > 0.0 else 0.0)
            np.subtract(guess, length * step, out=s)
            sweep((depth + 1, depth, 1, 0))


def _within(values: RealArray, level: RealArray) -> RealArray:
    """The corner of ``values`` that holds as many cells as the ``level``."""
    return values[: level.shape[0], : level.shape[1]]
