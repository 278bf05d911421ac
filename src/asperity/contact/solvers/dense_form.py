"""The problem as a small dense quadratic programme in dimensionless numbers, and its solution on a given contact set."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.arrays import BoolArray, RealArray
from .feasible import feasible_start, scaled_to_load
from .optimality import relative_error
from .protocol import ContactQP, FixedMean, SolverState

ROUNDING = 1e-13
"""Violations of the optimality conditions below this, relative to the largest number in them, count as rounding."""


def started(qp: ContactQP, start: RealArray | None) -> SolverState:
    """State of a direct method before its one step: feasible pressure, its deflection and error."""
    begin = feasible_start(qp, start)
    deflection = qp.operator.apply(begin)
    return SolverState(begin, deflection, relative_error(qp, begin, deflection), applications=1)


@dataclass(frozen=True, eq=False)
class DenseQP:
    """Minimise x·Ax/2 - x·h over 0 <= x <= cap, with the sum of x fixed or free; A has a unit diagonal or nearly so.

    Parameters
    ----------
    matrix
        A, (n, n).
    heights
        h, (n,): heights above the highest point (fixed sum) or above the prescribed plane (free sum).
    cap
        (n,), infinite where there is none.
    total
        Prescribed sum of x, or None.
    singular
        Whether A maps a uniform x to zero.
    unit
        Pressure in Pa that is 1 here; a power of two, so that no digit is lost on the way back.
    """

    matrix: RealArray
    heights: RealArray
    cap: RealArray
    total: float | None
    singular: bool
    unit: float

    @property
    def shift(self) -> float:
        """Number added to every entry of A to make it definite; at fixed sum it moves nothing but the level."""
        return 1.0 if self.singular or self.total is not None else 0.0


@dataclass(frozen=True, eq=False)
class OnSet:
    """Solution ``x`` with the points ``free`` strictly in contact, ``capped`` at the cap, all others at zero.

    ``level`` is what the gap Ax - h must equal on the free points: 0 for a free sum.
    """

    x: RealArray
    level: float
    free: BoolArray
    capped: BoolArray


def dense_form(qp: ContactQP) -> DenseQP:
    """Dense form of ``qp``.

    Raises
    ------
    InputError
        If the grid is too large for a dense matrix.
    """
    compliance = qp.operator.matrix()
    length = _power_of_two(qp.height_scale)
    unit = _power_of_two(length / float(compliance[0, 0]))
    plane, total = float(qp.profile.max()), None
    if isinstance(qp.constraint, FixedMean):
        total = qp.constraint.mean_pressure * qp.profile.size / unit
    else:
        plane = qp.constraint.offset
    return DenseQP(
        matrix=compliance * (unit / length),
        heights=(qp.profile.ravel() - plane) / length,
        cap=np.broadcast_to(np.asarray(qp.cap, dtype=float), qp.profile.shape).ravel() / unit,
        total=total,
        singular=qp.operator.zero_mean_mode,
        unit=unit,
    )


def _power_of_two(value: float) -> float:
    return math.ldexp(1.0, math.frexp(value)[1])


def solve_on(qp: DenseQP, free: BoolArray, capped: BoolArray) -> OnSet:
    """Solve (Ax)_F = h_F + level, with the sum where it is fixed (Cole & Sayles 1992; Tian & Bhushan 1996).

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
    return 1.0 + float(np.abs(qp.heights).max()) + float(np.abs(x).max()) + float(np.abs(qp.matrix @ x).max())


def answered(
    qp: ContactQP, state: SolverState, x: RealArray | None, unit: float, *, iterations: int, tolerance: float
) -> SolverState:
    """State after a direct method found ``x`` (n,), in units of ``unit`` Pa, in ``iterations`` steps of its own.

    ``None`` stands for no answer within the iteration limit: the pressure stays. The state is exhausted if the answer
    misses the tolerance: a direct method cannot improve it. Work with the dense matrix counts as no application.
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
