"""Residual stress of the plastic strain at any depth."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...solids.eigenstrain.cells import DepthCells
from ...solids.eigenstrain.operator import EigenstrainOperator
from ...solids.eigenstrain.slices import slice_at
from ..boundary import Free
from ..laws.plastic_flow import plastic_body
from ..problem import ContactProblem

if TYPE_CHECKING:
    from .plastic_flow import PlasticBody

_TRACTIONS = [2, 4, 5]


def cells_of(problem: ContactProblem, edges: RealArray) -> DepthCells:
    """Depth cells of the plastic body of ``problem`` between ``edges``."""
    return DepthCells(plastic_body(problem.body, problem.counter_body)[0], edges)


def operator_of(problem: ContactProblem, edges: RealArray, threads: int | None = None) -> EigenstrainOperator:
    """Operator of the plastic body of ``problem`` with depth cells between ``edges``."""
    free = isinstance(problem.boundary, Free)
    return EigenstrainOperator.prepared(problem.grid, cells_of(problem, edges), free=free, threads=threads)


class ResidualStress:
    """Stress of a plastic ``body`` by its plastic strain alone, at single depths.

    Exact for the plastic strain of the cells, which is constant in depth within each of them, to 1e-4 of its change within a cell.
    """

    def __init__(self, body: PlasticBody, threads: int | None = None) -> None:
        self._body, self._threads = body, threads
        self.citation_keys = body.citation_keys

    @cached_property
    def _cells(self) -> DepthCells:
        return cells_of(self._body.problem, self._body.flowed.edges)

    @cached_property
    def _spectra(self) -> ComplexArray:
        """Transforms (cells, 6, …) of the plastic strain."""
        operator = operator_of(self._body.problem, self._body.flowed.edges, self._threads)
        fields = operator.spectra()
        strain = np.ascontiguousarray(self._body.plastic_strain)
        busy = np.flatnonzero(strain.any(axis=(1, 2, 3)))
        operator.forward(strain, fields, [(int(cell), part) for cell in busy for part in range(6)])
        return fields

    def at(self, depth: float, *, above: bool, below: bool) -> RealArray:
        """(6, nx, ny) in Pa at ``depth`` (m), components xx, yy, zz, xy, xz, yz.

        Just ``above`` it, just ``below`` it, or the mean of both, which differ at interfaces and between cells; of the surface below it.
        """
        cut = slice_at(self._cells, depth, above=above, below=below)
        operator = operator_of(self._body.problem, cut.edges, self._threads)
        fields = operator.spectra()
        held = cut.owner >= 0
        fields[held] = self._spectra[cut.owner[held]]
        operator.respond(np.zeros((3, *operator.spectrum_shape), dtype=complex), fields)
        rows = np.array(cut.rows)
        found = np.empty((rows.size, 6, *operator.grid.shape))
        pairs = [(number, part) for number in range(rows.size) for part in range(6)]
        operator.backward(np.ascontiguousarray(fields[rows]), found, pairs)
        mean: RealArray = found.mean(axis=0)
        if depth == 0.0:
            mean[_TRACTIONS] = 0.0
        return mean
