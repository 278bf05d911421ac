"""Exact active set on the dense matrix (Cole & Sayles 1992; Tian & Bhushan 1996), made finite: the
reference method."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ....core.arrays import BoolArray, RealArray
from ....core.errors import InputError, NoSolutionError
from ..protocol import (
    ContactQP,
    FixedMean,
    Iterative,
    SolverState,
    feasible_start,
    heights_near_contact,
    lightly_loaded,
    relative_error,
    scaled_to_load,
)

# The problem as a small dense quadratic programme in dimensionless numbers, and its solution on a
# given contact set.


ROUNDING = 1e-13
"""Violations of the optimality conditions below this, relative to the largest number in them, count
as rounding."""


def started(qp: ContactQP, start: RealArray | None) -> SolverState:
    """State of a direct method before its one step: feasible pressure, its deflection and error."""
    begin = feasible_start(qp, start)
    deflection = qp.operator.apply(begin)
    return SolverState(begin, deflection, relative_error(qp, begin, deflection), applications=1)


@dataclass(frozen=True, eq=False)
class DenseQP:
    """Minimise x·Ax/2 - x·h over 0 <= x <= cap, with the sum of x fixed to ``total`` or free; A has
    a unit diagonal or nearly so.

    ``heights`` h (n,) count from the highest point or a level near the contact (fixed sum; the
    latter where the load is ``light``, with deflections far smaller than the heights), or from the
    prescribed plane (free sum). ``singular``: A maps a uniform x to zero. ``unit`` is the pressure
    in Pa that is 1 here, a power of two, so that no digit is lost on the way back.
    """

    matrix: RealArray
    heights: RealArray
    cap: RealArray
    total: float | None
    singular: bool
    unit: float
    light: bool = False

    @property
    def shift(self) -> float:
        """Number added to every entry of A to make it definite; at fixed sum it moves nothing but
        the level."""
        return 1.0 if self.singular or self.total is not None else 0.0


@dataclass(frozen=True, eq=False)
class OnSet:
    """Solution ``x`` with the points ``free`` strictly in contact, ``capped`` at the cap, all
    others at zero.

    ``level`` is what the gap Ax - h must equal on the free points: 0 for a free sum.
    """

    x: RealArray
    level: float
    free: BoolArray
    capped: BoolArray


def dense_form(qp: ContactQP, *, near_contact: bool = False) -> DenseQP:
    """Dense form of ``qp``; with heights from a level ``near_contact`` instead of the highest
    point, if the load is light.

    Raises
    ------
    InputError
        If the grid is too large for a dense matrix.
    """
    compliance = qp.operator.matrix()
    length = math.ldexp(1.0, math.frexp(qp.height_scale)[1])  # powers of two
    unit = math.ldexp(1.0, math.frexp(length / float(compliance[0, 0]))[1])
    light, total = near_contact and lightly_loaded(qp), None
    profile = heights_near_contact(qp) if light else qp.profile
    plane = 0.0 if light else float(qp.profile.max())
    if isinstance(qp.constraint, FixedMean):
        total = qp.constraint.mean_pressure * qp.profile.size / unit
    else:
        plane = qp.constraint.offset
    return DenseQP(
        matrix=compliance * (unit / length),
        heights=(profile.ravel() - plane) / length,
        cap=np.broadcast_to(np.asarray(qp.cap, dtype=float), qp.profile.shape).ravel() / unit,
        total=total,
        singular=qp.operator.zero_mean_mode,
        unit=unit,
        light=light,
    )


def solve_on(qp: DenseQP, free: BoolArray, capped: BoolArray) -> OnSet:
    """Solve (Ax)_F = h_F + level, with the sum where it is fixed (Cole & Sayles 1992; Tian &
    Bhushan 1996).

    Without a free point x is known and the level stays 0, whatever the sum.
    """
    from scipy.linalg import cho_factor, cho_solve

    x = np.where(capped, qp.cap, 0.0)
    if not free.any():
        return OnSet(x, 0.0, free, capped)
    shift, level = float(qp.total is not None), 0.0
    if qp.total is None and qp.singular and free.all():
        shift = 1e-6 / free.size  # a uniform x costs nothing: let it run away, to the bound that stops it
    factor = cho_factor(qp.matrix[np.ix_(free, free)] + shift)
    ones = cho_solve(factor, np.ones(np.count_nonzero(free)))
    for _ in range(2):  # the second pass is iterative refinement
        y = cho_solve(factor, qp.heights[free] + level - (qp.matrix @ x)[free])
        if qp.total is not None:
            missing = qp.total - float(x.sum())
            change = (missing - float(y.sum())) / float(ones.sum())
            y += change * ones
            level += change - shift * missing
        x[free] += y
    return OnSet(x, level, free, capped)


def gaps(qp: DenseQP, trial: OnSet) -> RealArray:
    """Gap A x - h - level at every point."""
    return qp.matrix @ trial.x - qp.heights - trial.level


def violation(qp: DenseQP, trial: OnSet, gap: RealArray) -> float:
    """Largest violation of the optimality conditions, relative to the largest number in them."""
    idle = ~(trial.free | trial.capped)
    x = trial.x[trial.free]
    parts = (-x, x - qp.cap[trial.free], -gap[idle], gap[trial.capped])
    worst = max((float(part.max()) for part in parts if part.size), default=0.0)
    if qp.total is not None and not trial.free.any():
        worst = max(worst, abs(qp.total - float(trial.x.sum())))
    return worst / magnitude(qp, trial.x)


def magnitude(qp: DenseQP, x: RealArray) -> float:
    """Largest number in the optimality conditions at ``x``."""
    heights = 0.0 if qp.light else 1.0 + float(np.abs(qp.heights).max())
    return heights + float(np.abs(x).max()) + float(np.abs(qp.matrix @ x).max())


def answered(
    qp: ContactQP, state: SolverState, x: RealArray | None, unit: float, *, iterations: int, tolerance: float
) -> SolverState:
    """State after a direct method found ``x`` (n,), in units of ``unit`` Pa, in ``iterations``
    steps of its own.

    ``None`` stands for no answer within the iteration limit: the pressure stays. The state is
    exhausted if the answer misses the tolerance: a direct method cannot improve it. Work with the
    dense matrix counts as no application.
    """
    count = state.iterations + max(iterations, 1)
    if x is None:
        return SolverState(state.pressure, state.deflection, state.error, count, state.applications)
    p = np.clip(x.reshape(qp.profile.shape) * unit, 0.0, qp.cap)
    if isinstance(qp.constraint, FixedMean):
        p = scaled_to_load(p, qp.cap, qp.constraint.mean_pressure)
    deflection = qp.operator.apply(p)
    error = relative_error(qp, p, deflection)
    return SolverState(p, deflection, error, count, state.applications + 1, exhausted=not error <= tolerance)


@dataclass(frozen=True)
class DenseActiveSet(Iterative):
    """Matrix inversion on the contact set, the set changed until it is right; for small grids.

    All points that break a condition change sides at once (primal-dual active set, a handful of
    linear solves). If that ever returns to an earlier set, single points change sides with the
    energy decreasing, which is finite.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) that the answer must meet; rounding is about 1e-15,
        or with a cap 1e-16 times cap over mean pressure.
    max_iterations
        Largest number of linear solves.
    """

    tolerance: float = 1e-10
    max_iterations: int = 10000
    name: ClassVar[str] = "dense_active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Tian1996")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, whose contact set is the first guess."""
        return started(qp, start)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """The whole solve.

        Raises
        ------
        InputError
            If the grid is too large for a dense matrix.
        """
        dense = dense_form(qp, near_contact=True)
        start = state.pressure.ravel() / dense.unit
        limit = self.max_iterations - state.iterations
        found, used = all_at_once(dense, start, limit)
        x: RealArray | None = None if found is None else found.x
        if found is None and used < limit:
            pivoted = one_by_one(dense, start, limit - used)
            x, used = pivoted.x, used + pivoted.solves
            if not pivoted.optimal:  # feasible and better than the start, but the limit must be what is reported
                return answered(qp, state, x, dense.unit, iterations=used, tolerance=np.inf)
        return answered(qp, state, x, dense.unit, iterations=used, tolerance=self.tolerance)


def all_at_once(qp: DenseQP, start: RealArray, limit: int) -> tuple[OnSet | None, int]:
    """Primal-dual active set from the set of ``start``: the solution, or None if a set came back;
    linear solves used."""
    free, capped = (start > 0.0) & (start < qp.cap), start >= qp.cap
    seen: set[bytes] = set()
    for count in range(limit):
        key = np.packbits(np.concatenate([free, capped])).tobytes()
        if key in seen or (qp.total is not None and not free.any()):
            return None, count
        seen.add(key)
        trial = solve_on(qp, free, capped)
        gap = gaps(qp, trial)
        if violation(qp, trial, gap) <= ROUNDING:
            return trial, count + 1
        moved = trial.x - gap  # on the free points the gap is zero, elsewhere x sits at its bound
        free, capped = (moved > 0.0) & (moved < qp.cap), moved >= qp.cap
    return None, limit


class Pivoted(NamedTuple):
    """Feasible ``x``, linear ``solves`` used, and whether it is ``optimal``."""

    x: RealArray
    solves: int
    optimal: bool


def one_by_one(qp: DenseQP, start: RealArray, limit: int) -> Pivoted:
    """Primal active set from the feasible ``start``, one point at a time.

    The energy never increases. Among violated conditions the worst is taken, or after a step of no
    length the one of lowest index (Bland's rule), so that no set comes back.
    """
    x = start.copy()
    free, capped = (x > 0.0) & (x < qp.cap), x >= qp.cap
    moved = True
    for count in range(limit):
        trial = solve_on(qp, free, capped)
        # largest fraction of the way to the free part of the trial within bounds, and the point
        # that stops it
        target, ways = trial.x, np.full(x.shape, np.inf)
        out_low, out_high = trial.free & (target < 0.0), trial.free & (target > qp.cap)
        ways[out_low] = x[out_low] / (x - target)[out_low]
        ways[out_high] = (qp.cap - x)[out_high] / (target - x)[out_high]
        blocking = int(np.argmin(ways))
        fraction = float(ways[blocking])
        if fraction <= 1.0:
            upper = bool(target[blocking] > x[blocking])
            x += np.where(free, fraction * (target - x), 0.0)
            np.clip(x, 0.0, qp.cap, out=x)
            x[blocking] = qp.cap[blocking] if upper else 0.0
            free[blocking], capped[blocking] = False, upper
            moved = fraction > 0.0
            continue
        x = np.where(free, trial.x, x)
        entering = _entering(qp, x, trial, worst_first=moved)
        if not entering:
            return Pivoted(x, count + 1, optimal=True)
        free[entering], capped[entering] = True, False
    return Pivoted(x, limit, optimal=False)


def _entering(qp: DenseQP, x: RealArray, trial: OnSet, *, worst_first: bool) -> list[int]:
    """Point at a bound that lowers the energy by leaving it; none at the solution.

    Where the points at their cap carry the whole load the level is open, and one of them must give
    what another point takes.
    """
    idle: BoolArray = ~(trial.free | trial.capped)
    r = qp.matrix @ x - qp.heights
    resolved = ROUNDING * magnitude(qp, x)
    if qp.total is not None and not trial.free.any():
        takes, gives = int(np.argmin(np.where(idle, r, np.inf))), int(np.argmax(np.where(trial.capped, r, -np.inf)))
        wanted = idle.any() and trial.capped.any() and r[gives] - r[takes] > 2.0 * resolved
        return [takes, gives] if wanted else []
    excess = np.where(idle, trial.level - r, np.where(trial.capped, r - trial.level, -np.inf))
    wrong = excess > resolved
    if not wrong.any():
        return []
    return [int(np.argmax(excess)) if worst_first else int(np.argmax(wrong))]


# Lemke's complementary pivoting (Cottle, Pang & Stone 1992, sec. 4.4) with a lexicographic ratio
# test; tiny grids.


IntArray: TypeAlias = NDArray[np.integer[Any]]

LARGEST = 400
"""Largest number of points: with a cap the tableau then has 801 rows and 1604 columns (10 MB, about
5 ms a pivot)."""

_ZERO = 1e-11
"""Entries of the tableau, of order one, below which they count as rounding left by earlier
pivots."""


@dataclass(frozen=True)
class Lemke(Iterative):
    """Lemke's method on the linear complementarity problem: finitely many pivots, and a proof where
    none solves it.

    The start is not used. The contact set found by pivoting is solved once more by Cholesky, which
    removes the rounding that pivots accumulate.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) that the answer must meet; rounding is about 1e-15,
        or with a cap 1e-16 times cap over mean pressure.
    max_iterations
        Largest number of pivots.
    """

    tolerance: float = 1e-10
    max_iterations: int = 20000
    name: ClassVar[str] = "lemke"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cottle1992",)

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
        # M and q of: find z >= 0 with w = Mz + q >= 0 and z·w = 0; z holds x, then overlaps mu,
        # then the level. w_x = Ax - h + mu - level, w_mu = cap - x, w_level = sum(x) - total.
        # Fixing the sum by an inequality is exact: with all heights measured downwards from above
        # the highest point, x > 0 needs a level > 0, and then w_level = 0.
        n = dense.heights.size
        matrix, vector = dense.matrix, -dense.heights
        if np.isfinite(dense.cap).any():
            eye = np.eye(n)
            matrix = np.block([[matrix, eye], [-eye, np.zeros((n, n))]])
            vector = np.concatenate([vector, dense.cap])
        if dense.total is not None:
            ones = np.zeros(vector.size)
            ones[:n] = 1.0
            matrix = np.block([[matrix, -ones[:, None]], [ones[None, :], np.zeros((1, 1))]])
            vector = np.append(vector + ones, -dense.total)
        basic, pivots = solve_lcp(matrix, vector, self.max_iterations - state.iterations)
        x: RealArray | None = None
        if basic is not None:
            at_cap = basic[n : 2 * n] if np.isfinite(dense.cap).any() else np.zeros(n, dtype=bool)
            x = solve_on(dense, basic[:n] & ~at_cap, basic[:n] & at_cap).x
        return answered(qp, state, x, dense.unit, iterations=pivots, tolerance=self.tolerance)


def solve_lcp(matrix: RealArray, vector: RealArray, limit: int) -> tuple[BoolArray | None, int]:
    """Which z are basic in the solution, or None if not done after ``limit`` pivots; number of
    pivots.

    ``matrix`` positive semi-definite (m, m), ``vector`` (m,).

    Raises
    ------
    NoSolutionError
        If the pivots end on a ray; for a positive semi-definite matrix the conditions are then
        contradictory.
    """
    m = vector.size
    artificial = 2 * m
    # columns: w, z, the artificial variable, right-hand side; the first m columns always hold the
    # inverse of the basis
    tableau = np.hstack([np.eye(m), -matrix, -np.ones((m, 1)), vector[:, None]])
    basis = np.arange(m)
    if vector.min() >= 0.0:
        return np.zeros(m, dtype=bool), 0
    entering, row = artificial, _lexicographic_least(np.column_stack([vector, np.eye(m)]), np.arange(m))
    for count in range(limit):
        tableau[row] /= tableau[row, entering]
        factors = tableau[:, entering].copy()
        factors[row] = 0.0
        others = np.flatnonzero(factors)
        tableau[others] -= factors[others, None] * tableau[row]
        leaving, basis[row] = int(basis[row]), entering
        if leaving == artificial:
            return np.isin(np.arange(m, 2 * m), basis), count + 1
        entering = leaving + m if leaving < m else leaving - m
        column = tableau[:, entering]
        rows = np.flatnonzero(column > _ZERO)
        if not rows.size:
            raise NoSolutionError(
                "contact conditions must have a solution, but Lemke's pivots end on a ray: no pressure within "
                "the bounds balances the prescribed load or position. Lower the load, raise the hardness or "
                "prescribe {mean_pressure}."
            )
        # row of the lexicographic minimum ratio; the artificial variable goes first where it ties
        ratios = tableau[rows, -1] / column[rows]
        tied = rows[ratios <= ratios.min() + _ZERO * (1.0 + abs(ratios.min()))]
        last = tied[basis[tied] == artificial]
        inverse = tableau[tied, : basis.size] / column[tied, None]
        row = int(last[0]) if last.size else _lexicographic_least(inverse, tied)
    return None, limit


def _lexicographic_least(values: RealArray, rows: IntArray) -> int:
    """Entry of ``rows`` whose row of ``values`` comes first in lexicographic order."""
    left = np.arange(len(values))
    for column in values.T:
        if left.size == 1:
            break
        entries = column[left]
        left = left[entries <= entries.min() + _ZERO]
    return int(rows[left[0]])
