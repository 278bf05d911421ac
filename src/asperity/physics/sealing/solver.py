"""Solution of the linear systems of flow: sparse symmetric M-matrices whose entries span many
decades.

Rows and columns are scaled by the diagonal. Systems up to ``DIRECT`` unknowns are factorised, of
porous gaps up to ``POROUS``; larger ones are solved by conjugate gradients with algebraic multigrid
(smoothed aggregation) where pyamg is installed, and factorised where it is not.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeAlias

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, cg, splu

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.status import require_memory
from .network import Labels, Network

try:
    import pyamg
except ImportError:  # an extra
    pyamg = None

Method: TypeAlias = Literal["auto", "direct", "multigrid"]
"""How a system is solved."""

METHODS = ("auto", "direct", "multigrid")

DIRECT, POROUS = 100_000, 1_500_000
"""Unknowns up to which a system is factorised where multigrid is there, too; more where contact
takes away many of the cells, where a factorisation of 0.7 million takes 5 s and the solution by
multigrid 12 s."""

FILLED = 0.85
"""Share of the cells that carry from which a system is not porous: a factorisation of a million
takes 22 s, the solution by multigrid 7 s; of 0.26 million 3.4 s and 1.2 s."""

BYTES = 3000.0
"""Memory of the factors per unknown: 1800 bytes measured on 0.7 million unknowns with a third of
the cells in contact, more where all are open."""

TOLERANCE = 1e-13
"""Relative residual at which conjugate gradients stop; the limit is rounding, mostly."""

MOST = 300
"""Iterations of conjugate gradients at most."""


class System:
    """The balance of flow of a ``network`` in the pressures of its cells, prepared for solving.

    A network without sides leaves the pressure of each cluster free by a constant; it is zero at
    the cell of the cluster with the largest conductance.
    """

    def __init__(self, network: Network, clusters: Labels | None = None, method: Method = "auto") -> None:
        """``clusters`` are the labels (nx, ny) of the clusters of a network without sides."""
        require.one_of(method, METHODS, "method for flow")
        self.free = network.carrying.copy()
        diagonal = _diagonal(network)
        if not network.ends.any():
            self.free &= ~_anchors(network.carrying, diagonal, clusters)
        self.matrix = _matrix(network.across, diagonal, self.free)
        self._scale = 1.0 / np.sqrt(self.matrix.diagonal())
        scaled = sparse.diags_array(self._scale) @ self.matrix @ sparse.diags_array(self._scale)
        known = pyamg is not None
        if method == "multigrid" and not known:
            raise InputError('method for flow must be "direct" where pyamg is not installed, but is "multigrid".')
        many = scaled.shape[0] > (DIRECT if network.carrying.mean() > FILLED else POROUS)
        self.method = "multigrid" if method == "multigrid" or (method == "auto" and many and known) else "direct"
        self._solve = self._multigrid(scaled) if self.method == "multigrid" else _factorised(scaled)

    def _multigrid(self, scaled: Any) -> Callable[[RealArray], RealArray]:
        # a constant pressure is the smoothest of all, and smoothed aggregation is told so
        levels = pyamg.smoothed_aggregation_solver(scaled.tocsr(), B=1.0 / self._scale[:, None], max_coarse=500)
        return _conjugate(scaled, levels.aspreconditioner())

    def pressure(self, right: RealArray) -> RealArray:
        """(nx, ny) pressure whose outflow from the cells is ``right``; of a factorisation corrected
        once for what rounding left."""
        b, x = np.asarray(right)[self.free], np.zeros(self._scale.size)
        for _ in range(2 if self.method == "direct" else 1):
            x = x + self._scale * self._solve(self._scale * (b - self.matrix @ x))
        found = np.zeros(self.free.shape)
        found[self.free] = x
        return found

    def like(self, network: Network) -> Callable[[RealArray], RealArray]:
        """Solver of a ``network`` with other conductances of the same faces: conjugate gradients
        with this system as preconditioner."""
        matrix = _matrix(network.across, _diagonal(network), self.free)
        scaled = sparse.diags_array(self._scale) @ matrix @ sparse.diags_array(self._scale)
        solve = _conjugate(scaled, LinearOperator(scaled.shape, matvec=self._solve, dtype=np.float64))

        def pressure(right: RealArray) -> RealArray:
            found = np.zeros(self.free.shape)
            found[self.free] = self._scale * solve(self._scale * np.asarray(right)[self.free])
            return found

        return pressure


def _conjugate(scaled: Any, preconditioner: Any) -> Callable[[RealArray], RealArray]:
    def solve(b: RealArray) -> RealArray:
        if not b.any():
            return np.zeros_like(b)
        x, _ = cg(scaled, b, rtol=TOLERANCE, maxiter=MOST, M=preconditioner)
        return np.asarray(x)

    return solve


def _factorised(scaled: Any) -> Callable[[RealArray], RealArray]:
    count = scaled.shape[0]
    require_memory(
        BYTES * count,
        "factors of the flow",
        f"{count} open cells",
        "install pyamg (the extra flow), or crop the surface",
    )
    factors = splu(scaled.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    solve: Callable[[RealArray], RealArray] = factors.solve
    return solve


def _diagonal(network: Network) -> RealArray:
    """(nx, ny) sum of the conductances of each cell; a face of a cell with itself adds nothing."""
    total = network.ends.sum(axis=0)
    for axis, part in enumerate(network.across):
        if part.shape[axis] > 1:
            total = total + part + np.roll(part, 1, axis)
    return np.asarray(total)


def _anchors(carrying: BoolArray, diagonal: RealArray, clusters: Labels | None) -> BoolArray:
    """(nx, ny) True at one cell of each cluster, that of the largest ``diagonal``."""
    labels = np.where(carrying, 1 if clusters is None else clusters, 0).ravel()
    order = np.argsort(diagonal.ravel(), kind="stable")
    best = np.full(int(labels.max(initial=0)) + 1, -1)
    best[labels[order]] = order
    anchors = np.zeros(carrying.size, bool)
    anchors[best[1:][best[1:] >= 0]] = True
    return anchors.reshape(carrying.shape)


def _matrix(across: RealArray, diagonal: RealArray, free: BoolArray) -> Any:
    """Balance of the ``free`` cells in their pressures, those of others being zero."""
    number = np.where(free, np.cumsum(free.ravel()).reshape(free.shape) - 1, -1)
    count = int(free.sum())
    rows, columns, values = [np.arange(count)], [np.arange(count)], [diagonal[free]]
    for axis, part in enumerate(across):
        other = np.roll(number, -1, axis)
        there = (part > 0.0) & (number >= 0) & (other >= 0) & (number != other)
        rows += [number[there], other[there]]
        columns += [other[there], number[there]]
        values += [-part[there], -part[there]]
    place = np.concatenate(rows), np.concatenate(columns)
    return sparse.coo_array((np.concatenate(values), place), shape=(count, count)).tocsr()
