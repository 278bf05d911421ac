"""Finding the load at which a contact reaches a prescribed position.

At prescribed load the discrete problem is well conditioned up to and beyond full contact; at prescribed position on a
periodic half-space it is not (a uniform pressure moves nothing). Approach and mean gap are monotone in the load, so a
bracketing root search over loads, each solve starting from the last, is the robust way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import NoSolutionError
from ..core.progress import Progress
from ..core.status import Outcome, Status
from .solvers.optimality import level
from .solvers.protocol import ContactQP, FixedMean, Solution, Solver, run

Solved: TypeAlias = tuple[ContactQP, Solution]
Measure: TypeAlias = Callable[[ContactQP, Solution], float]

_FACTOR = 8.0
_EXPANSIONS = 60
_PRECISION = 1e-10
_TARGET_ERROR = 1e-4

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


class _NotConvergedError(Exception):
    """A solve on the way failed; its state is the last of the search."""


@dataclass
class LoadSearch:
    """Root search over loads; ``solved`` holds every solve so far, the latest last."""

    posed: ContactQP
    solver: Solver
    progress: Progress | None
    start: RealArray | None
    solved: list[Solved] = field(default_factory=list)

    def find(self, measure: Measure, target: float) -> Solved:
        """Solution at which ``measure``, a quantity growing with the load, equals ``target``.

        Without convergence on the way the failed solve is returned, whose status says so; likewise where the measure
        jumps over the target (at the load at which the last point yields) and no load reaches it.
        """
        from scipy.optimize import brentq

        def miss(log_load: float) -> float:
            start = self.solved[-1][1].state.pressure if self.solved else self.start
            self.solved.append(solve_at_load(self.posed, float(np.exp(log_load)), self.solver, start, self.progress))
            if not self.solved[-1][1].status.converged:
                raise _NotConvergedError
            return measure(*self.solved[-1]) - target

        missed = 0.0

        try:
            low, high = self._bracket(miss)
            if low < high:
                missed = abs(miss(brentq(miss, low, high, xtol=_PRECISION, rtol=_PRECISION)))
        except _NotConvergedError:
            pass
        allowed = _TARGET_ERROR * abs(target) + 10.0 * self.solver.tolerance * self.posed.height_scale
        return self._with_all_work(reached=missed <= allowed)

    def _with_all_work(self, *, reached: bool) -> Solved:
        """Latest solve, with the iterations and applications of the whole search, flagged if the target is missed."""
        qp, solution = self.solved[-1]
        status = solution.status if reached else Status(Outcome.STAGNATED, _UNREACHED, _REMEDY)
        iterations = sum(earlier.state.iterations for _, earlier in self.solved)
        applications = sum(earlier.state.applications for _, earlier in self.solved)
        extra = sum(earlier.state.extra_pairs for _, earlier in self.solved)
        state = replace(solution.state, iterations=iterations, applications=applications, extra_pairs=extra)
        return qp, replace(solution, state=state, status=status)

    def _bracket(self, miss: Callable[[float], float]) -> tuple[float, float]:
        """Logarithms of two loads around the target, from the load that flattens one pixel's worth of roughness."""
        limit = float(np.log(np.mean(self.posed.cap)))
        at = min(float(np.log(self._first_load())), limit)
        sign = np.sign(miss(at))
        step = np.log(_FACTOR) * (-1.0 if sign > 0.0 else 1.0)
        for _ in range(_EXPANSIONS):
            ahead = min(at + step, limit)
            if ahead == at:
                break
            reached = miss(ahead)
            if reached == 0.0 or np.sign(reached) != sign:
                return min(at, ahead), max(at, ahead)
            at = ahead
        if sign == 0.0:
            return at, at
        raise NoSolutionError(f"{_UNREACHED} {_REMEDY}")

    def _first_load(self) -> float:
        """Mean pressure (Pa) of the order that moves the surface by a tenth of its rms height."""
        response = self.posed.operator.apply(self.posed.profile)
        stiffness = float(self.posed.profile.std()) / float(response.std() or 1.0)
        return 0.1 * self.posed.height_scale * stiffness
