"""Lemke's complementary pivoting (Cottle, Pang & Stone 1992, sec. 4.4) with a lexicographic ratio test; tiny grids."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError, NoSolutionError
from .dense_form import DenseQP, answered, dense_form, solve_on, started
from .protocol import ContactQP, SolverState, require_settings

IntArray: TypeAlias = NDArray[np.integer[Any]]

LARGEST = 400
"""Largest number of points: with a cap the tableau then has 801 rows and 1604 columns (10 MB, about 5 ms a pivot)."""

_ZERO = 1e-11


@dataclass(frozen=True)
class Lemke:
    """Lemke's method on the linear complementarity problem: finitely many pivots, and a proof where none solves it.

    The start is not used. The contact set found by pivoting is solved once more by Cholesky, which removes the
    rounding that pivots accumulate.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) that the answer must meet; rounding is about 1e-15, or with a cap
        1e-16 times cap over mean pressure.
    max_iterations
        Largest number of pivots.
    """

    tolerance: float = 1e-10
    max_iterations: int = 20000
    name: ClassVar[str] = "lemke"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cottle1992",)

    def __post_init__(self) -> None:
        require_settings(self)

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``.

        Raises
        ------
        InputError
            If the grid has more than ``LARGEST`` points.
        """
        if qp.profile.size > LARGEST:
            raise InputError(
                f"grid of Lemke's method must have at most {LARGEST} points, but has {qp.profile.size}. "
                "Use DenseActiveSet() or, on large grids, ConjugateGradient()."
            )
        return started(qp, start)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """The whole solve.

        Raises
        ------
        NoSolutionError
            If pivoting ends on a ray, which proves that no pressure meets the conditions.
        """
        dense = dense_form(qp)
        basic, pivots = solve_lcp(*complementarity_problem(dense), self.max_iterations - state.iterations)
        x: RealArray | None = None
        if basic is not None:
            n = dense.heights.size
            at_cap = basic[n : 2 * n] if np.isfinite(dense.cap).any() else np.zeros(n, dtype=bool)
            x = solve_on(dense, basic[:n] & ~at_cap, basic[:n] & at_cap).x
        return answered(qp, state, x, dense.unit, iterations=pivots, tolerance=self.tolerance)


def complementarity_problem(qp: DenseQP) -> tuple[RealArray, RealArray]:
    """M and q of: find z >= 0 with w = Mz + q >= 0 and z·w = 0; z holds x, then overlaps mu, then the level.

    w_x = Ax - h + mu - level, w_mu = cap - x, w_level = sum(x) - total. Fixing the sum by an inequality is exact: with
    all heights measured downwards from above the highest point, x > 0 needs a level > 0, and then w_level = 0.
    """
    n = qp.heights.size
    matrix, vector = qp.matrix, -qp.heights
    if np.isfinite(qp.cap).any():
        eye = np.eye(n)
        matrix = np.block([[matrix, eye], [-eye, np.zeros((n, n))]])
        vector = np.concatenate([vector, qp.cap])
    if qp.total is not None:
        ones = np.zeros(vector.size)
        ones[:n] = 1.0
        matrix = np.block([[matrix, -ones[:, None]], [ones[None, :], np.zeros((1, 1))]])
        vector = np.append(vector + ones, -qp.total)
    return matrix, vector


def solve_lcp(matrix: RealArray, vector: RealArray, limit: int) -> tuple[BoolArray | None, int]:
    """Which z are basic in the solution, or None if not done after ``limit`` pivots; number of pivots.

    ``matrix`` positive semi-definite (m, m), ``vector`` (m,).

    Raises
    ------
    NoSolutionError
        If the pivots end on a ray; for a positive semi-definite matrix the conditions are then contradictory.
    """
    m = vector.size
    artificial = 2 * m
    # columns: w, z, the artificial variable, right-hand side; the first m columns always hold the inverse of the basis
    tableau = np.hstack([np.eye(m), -matrix, -np.ones((m, 1)), vector[:, None]])
    basis = np.arange(m)
    if vector.min() >= 0.0:
        return np.zeros(m, dtype=bool), 0
    entering, row = artificial, _lexicographic_least(np.column_stack([vector, np.eye(m)]), np.arange(m))
    for count in range(limit):
        _pivot(tableau, row, entering)
        leaving, basis[row] = int(basis[row]), entering
        if leaving == artificial:
            return np.isin(np.arange(m, 2 * m), basis), count + 1
        entering = leaving + m if leaving < m else leaving - m
        found = _leaving_row(tableau, basis, entering, artificial)
        if found is None:
            raise NoSolutionError(
                "contact conditions must have a solution, but Lemke's pivots end on a ray: no pressure within the bounds "
                "balances the prescribed load or position. Lower the load, raise the hardness or prescribe MeanPressure(...)."
            )
        row = found
    return None, limit


def _pivot(tableau: RealArray, row: int, column: int) -> None:
    tableau[row] /= tableau[row, column]
    factors = tableau[:, column].copy()
    factors[row] = 0.0
    others = np.flatnonzero(factors)
    tableau[others] -= factors[others, None] * tableau[row]


def _leaving_row(tableau: RealArray, basis: IntArray, entering: int, artificial: int) -> int | None:
    """Row of the lexicographic minimum ratio; the artificial variable goes first where it ties; None on a ray."""
    column = tableau[:, entering]
    rows = np.flatnonzero(column > _ZERO)
    if not rows.size:
        return None
    ratios = tableau[rows, -1] / column[rows]
    tied = rows[ratios <= ratios.min() + _ZERO * (1.0 + abs(ratios.min()))]
    for row in tied:
        if basis[row] == artificial:
            return int(row)
    inverse = tableau[tied, : basis.size] / column[tied, None]
    return _lexicographic_least(inverse, tied)


def _lexicographic_least(values: RealArray, rows: IntArray) -> int:
    """Entry of ``rows`` whose row of ``values`` comes first in lexicographic order."""
    left = np.arange(len(values))
    for column in values.T:
        if left.size == 1:
            break
        entries = column[left]
        left = left[entries <= entries.min() + _ZERO]
    return int(rows[left[0]])
