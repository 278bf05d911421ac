"""Finding the load at which a contact reaches a prescribed position.

At prescribed load the discrete problem is well conditioned up to and beyond full contact; at prescribed position on a
periodic half-space it is not (a uniform pressure moves nothing). Approach and mean gap are monotone in the load, so a
bracketing root search over loads, each solve starting from the last, is the robust way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import NoSolutionError
from ..core.progress import Progress
from ..core.status import Outcome, Status
from .solvers.protocol import ContactQP, FixedMean, Solution, Solver, level, run

Solved: TypeAlias = tuple[ContactQP, Solution]
Measure: TypeAlias = Callable[[ContactQP, Solution], float]

_FACTOR = 8.0
_EXPANSIONS = 60
_PRECISION = 1e-12
_TARGET_ERROR = 1e-4
_NEGLIGIBLE = 1e-3

_UNREACHED = (
    "No load reaches the prescribed position: where nearly every point yields, the position jumps with the load, and "
    "at a mean pressure equal to the hardness it is undetermined."
)
_REMEDY = "Prescribe a load, or a position of less overlap."


def solve_at_load(
    posed: ContactQP, mean: float, solver: Solver, start: RealArray | None, progress: Progress | None
) -> Solved:
    """Solve at the ``mean`` pressure (Pa), from ``start`` scaled to it or from a uniform pressure.

    Raises
    ------
    NoSolutionError
        If the mean pressure exceeds the mean of the pressure cap.
    """
    bearable = float(np.mean(posed.cap))
    if mean > bearable:
        raise NoSolutionError(
            f"mean pressure must be at most the mean hardness {bearable:.6g} Pa (force: hardness times nominal area), "
            f"but is {mean:.6g} Pa. Lower the load or raise the hardness."
        )
    qp = replace(posed, constraint=FixedMean(mean))
    return qp, run(solver, qp, start, progress)


def contact_level(qp: ContactQP, solution: Solution) -> float:
    """Level of the contacting plane (m), see ``solvers.optimality.level``."""
    state = solution.state
    return level(qp, state.pressure, state.deflection - qp.profile)


def mean_gap(qp: ContactQP, solution: Solution) -> float:
    """Mean gap (m) of the deformed, permanently indented bodies."""
    r = solution.state.deflection - qp.profile
    return float(np.maximum(r - contact_level(qp, solution), 0.0).mean())


def with_work_of(earlier: Solved | None, solved: Solved) -> Solved:
    """``solved`` with the work of the solves before it added."""
    if earlier is None:
        return solved
    (qp, solution), before = solved, earlier[1].state
    state = replace(
        solution.state,
        iterations=solution.state.iterations + before.iterations,
        applications=solution.state.applications + before.applications,
        extra_pairs=solution.state.extra_pairs + before.extra_pairs,
    )
    return qp, replace(solution, state=state)


class _NotConvergedError(Exception):
    """A solve on the way failed; its state is the last of the search."""


@dataclass
class LoadSearch:
    """Root search over loads; ``last`` is the latest solve, with the work of the whole search, ``at`` the logarithm of its load."""

    posed: ContactQP
    solver: Solver
    progress: Progress | None
    start: RealArray | None
    last: Solved | None = None
    at: float = np.nan

    def find(self, measure: Measure, target: float) -> Solved:
        """Solution at which ``measure``, a quantity growing with the load, equals ``target``.

        Without convergence on the way the failed solve is returned, whose status says so; likewise where the measure
        jumps over the target (at the load at which the last point yields) and no load reaches it.
        """
        from scipy.optimize import brentq

        allowed = _TARGET_ERROR * abs(target) + 10.0 * self.solver.tolerance * self.posed.height_scale
        known: dict[float, float] = {}

        def miss(log_load: float) -> float:
            if log_load not in known:
                start = self.start if self.last is None else self.last[1].state.pressure
                mean = min(float(np.exp(log_load)), float(np.mean(self.posed.cap)))  # exp(log x) may exceed x
                solved = solve_at_load(self.posed, mean, self.solver, start, self.progress)
                self.last, self.at = with_work_of(self.last, solved), log_load
                if not self.last[1].status.converged:
                    raise _NotConvergedError
                found = measure(*self.last) - target
                known[log_load] = 0.0 if abs(found) <= _NEGLIGIBLE * allowed else found
            return known[log_load]

        missed = 0.0
        try:
            root, high = self._bracket(miss)
            if root < high:
                root = brentq(miss, root, high, xtol=max(_PRECISION, 0.1 * self.solver.tolerance), rtol=_PRECISION)
            if self.at != root:
                known.clear()
            missed = abs(miss(root))
        except _NotConvergedError:
            pass
        assert self.last is not None
        if missed <= allowed:
            return self.last
        qp, solution = self.last
        return qp, replace(solution, status=Status(Outcome.STAGNATED, _UNREACHED, _REMEDY))

    def _bracket(self, miss: Callable[[float], float]) -> tuple[float, float]:
        """Logarithms of two loads around the target, from the load that flattens one pixel's worth of roughness."""
        limit = float(np.log(np.mean(self.posed.cap)))
        known = 0.0 if self.start is None else float(self.start.mean())
        at = min(float(np.log(known if known > 0.0 else self._first_load())), limit)
        sign = np.sign(miss(at))
        if sign == 0.0:
            return at, at
        step = np.log(_FACTOR) * (-1.0 if sign > 0.0 else 1.0)
        for _ in range(_EXPANSIONS):
            ahead = min(at + step, limit)
            if ahead == at:
                break
            reached = miss(ahead)
            if reached == 0.0:
                return ahead, ahead
            if np.sign(reached) != sign:
                return min(at, ahead), max(at, ahead)
            at = ahead
        raise NoSolutionError(f"{_UNREACHED} {_REMEDY}")

    def _first_load(self) -> float:
        """Mean pressure (Pa) of the order that moves the surface by a tenth of its rms height."""
        response = self.posed.operator.apply(self.posed.profile)
        stiffness = float(self.posed.profile.std()) / float(response.std() or 1.0)
        return 0.1 * self.posed.height_scale * stiffness
