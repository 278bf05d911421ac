"""Exact active set on the dense matrix (Cole & Sayles 1992; Tian & Bhushan 1996), made finite: the reference method."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import BoolArray, RealArray
from .dense_form import ROUNDING, DenseQP, OnSet, answered, dense_form, gaps, magnitude, solve_on, started, violation
from .protocol import ContactQP, SolverState, require_settings


@dataclass(frozen=True)
class DenseActiveSet:
    """Matrix inversion on the contact set, the set changed until it is right; for small grids.

    All points that break a condition change sides at once (primal-dual active set, a handful of linear solves). If
    that ever returns to an earlier set, single points change sides with the energy decreasing, which is finite.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) that the answer must meet; rounding is about 1e-15, or with a cap
        1e-16 times cap over mean pressure.
    max_iterations
        Largest number of linear solves.
    """

    tolerance: float = 1e-10
    max_iterations: int = 10000
    name: ClassVar[str] = "dense_active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Tian1996")

    def __post_init__(self) -> None:
        require_settings(self)

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
        dense = dense_form(qp)
        start = state.pressure.ravel() / dense.unit
        limit = self.max_iterations - state.iterations
        found, used = all_at_once(dense, start, limit)
        x: RealArray | None = None if found is None else found.x
        if found is None and used < limit:
            x, more, finished = one_by_one(dense, start, limit - used)
            used += more
            if not finished:  # feasible and better than the start, but the limit must be what is reported
                return answered(qp, state, x, dense.unit, iterations=used, tolerance=np.inf)
        return answered(qp, state, x, dense.unit, iterations=used, tolerance=self.tolerance)


def all_at_once(qp: DenseQP, start: RealArray, limit: int) -> tuple[OnSet | None, int]:
    """Primal-dual active set from the set of ``start``: the solution, or None if a set came back; linear solves used."""
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


def one_by_one(qp: DenseQP, start: RealArray, limit: int) -> tuple[RealArray, int, bool]:
    """Primal active set from the feasible ``start``, one point at a time: x, linear solves used, whether optimal.

    The energy never increases. Among violated conditions the worst is taken, or after a step of no length the one of
    lowest index (Bland's rule), so that no set comes back.
    """
    x = start.copy()
    free, capped = (x > 0.0) & (x < qp.cap), x >= qp.cap
    moved = True
    for count in range(limit):
        trial = solve_on(qp, free, capped)
        fraction, blocking = _way_to(qp, x, trial)
        if blocking is not None:
            upper = bool(trial.x[blocking] > x[blocking])
            x += np.where(free, fraction * (trial.x - x), 0.0)
            np.clip(x, 0.0, qp.cap, out=x)
            x[blocking] = qp.cap[blocking] if upper else 0.0
            free[blocking], capped[blocking] = False, upper
            moved = fraction > 0.0
            continue
        x = np.where(free, trial.x, x)
        entering = _entering(qp, x, trial, worst_first=moved)
        if entering is None:
            return x, count + 1, True
        free[entering], capped[entering] = True, False
    return x, limit, False


def _way_to(qp: DenseQP, x: RealArray, trial: OnSet) -> tuple[float, int | None]:
    """Largest fraction of the way from ``x`` to the free part of ``trial`` within bounds, and the point that stops it."""
    target = trial.x
    out_low, out_high = trial.free & (target < 0.0), trial.free & (target > qp.cap)
    fraction = np.full(x.shape, np.inf)
    fraction[out_low] = x[out_low] / (x - target)[out_low]
    fraction[out_high] = (qp.cap - x)[out_high] / (target - x)[out_high]
    index = int(np.argmin(fraction))
    return (float(fraction[index]), index) if fraction[index] <= 1.0 else (1.0, None)


def _entering(qp: DenseQP, x: RealArray, trial: OnSet, *, worst_first: bool) -> int | None:
    """Point at a bound that the energy wants off it; None at the solution."""
    idle: BoolArray = ~(trial.free | trial.capped)
    r = qp.matrix @ x - qp.heights
    level = trial.level
    if qp.total is not None and not trial.free.any():  # the level is open: the idle point nearest to contact sets it
        if not (idle.any() and trial.capped.any()):
            return None
        level = 0.5 * float(r[idle].min() + r[trial.capped].max())
    excess = np.where(idle, level - r, np.where(trial.capped, r - level, -np.inf))
    wrong = excess > ROUNDING * magnitude(qp, x)
    if not wrong.any():
        return None
    return int(np.argmax(excess)) if worst_first else int(np.argmax(wrong))
