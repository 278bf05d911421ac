"""Pressure limits that follow the indentation they allow: limit and depth made to agree within one load.

A load ends where p <= H(w) everywhere and p = H(w) wherever the surface went deeper, w being the indentation *reached*.
Taking H at the indentation before the load instead would make the answer depend on the number of steps; here a step of
any size ends in agreement, and steps are needed only for loads that go up and down.

With the limit held the problem is the convex one of every solver, so limit and depth are found in turn, each solve
starting from the pressure of the last. The first limit is that of the indentation so far. Where the solid softens with
depth (hard film), limits fall and the indentation grows from round to round towards the smallest that agrees: the one a
growing load meets first, though others may agree, too. Where it hardens there is only one, and rounds would overshoot:
there they are shortened by what one pixel springs back, 1/(1 + H'c), and extrapolated (Anderson 1965; measured: 8 to 40 rounds
where the plain rounds do not settle). Hard films took 5 to 100 plain rounds, the more the thinner against the indentation.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import NoSolutionError
from ..core.status import Outcome, Status
from .laws import LimitByDepth
from .load_search import Solved, contact_level, with_work_of
from .operators import Operator

AtCap: TypeAlias = Callable[[float | RealArray, RealArray | None], Solved]
"""Solves with the pressure limit (Pa) and from the pressure (Pa) given."""

TOLERANCE = 1e-5
"""Relative difference of the limit used and the limit at the indentation reached; the law itself is good to per cents."""

_ROUNDS = 200
_REMEMBERED = 6
_NUDGE = 1e-3
_MORE_DEPTHS = tuple(10.0**power for power in range(-12, 7))
_SHALLOW = 1e-3
_REMEDY = (
    "Take smaller steps of load or a finer grid; a soft layer more than a hundred times thinner than the indentation can be "
    "left out, the hardness being that of what lies below."
)


def at_reached_depth(law: LimitByDepth, before: RealArray, start: RealArray | None, at_cap: AtCap) -> Solved:
    """Solution whose limit is that of ``law`` at the indentation (nx, ny, m) it ends with, which is ``before`` or more.

    A solve that does not converge is returned at once; rounds that do not agree end as stagnated, with what is left.
    """
    depth, miss = before, np.inf
    bearing: RealArray | None = None
    solved: Solved | None = None
    history = _History()
    for _ in range(_ROUNDS):
        try:
            found = at_cap(cap := law.cap_at(depth), start)
        except NoSolutionError as error:
            bearing = _deep_enough(law, before, at_cap, error) if bearing is None else bearing
            depth, history = 0.5 * (depth + bearing), _History()
            continue
        bearing = depth
        solved = found if solved is None else with_work_of(solved, found)
        if not found[1].status.converged:
            return solved
        start = found[1].state.pressure
        reached = before + added_indentation(solved)
        miss = _disagreement(start, cap, law.cap_at(reached))
        if miss <= TOLERANCE:
            return solved
        hardening = _hardening(law, np.maximum(depth, reached))
        step = (reached - depth) / (1.0 + np.maximum(hardening, 0.0) * _own_compliance(found[0].operator))
        if hardening.min() < 0.0:
            history, depth = _History(), depth + step
        else:
            depth = np.maximum(history.extrapolated(depth, step), before)
    assert solved is not None  # _deep_enough has found a load that can be borne, or raised
    return _unsettled(solved, miss)


def _unsettled(solved: Solved, miss: float) -> Solved:
    qp, solution = solved
    message = f"The hardness still changes by {miss:.1e} with the depth of the indentation after {_ROUNDS} rounds."
    return qp, replace(solution, status=Status(Outcome.STAGNATED, message, _REMEDY))


def _deep_enough(law: LimitByDepth, before: RealArray, at_cap: AtCap, error: NoSolutionError) -> RealArray:
    """Indentation (m), the same more everywhere than ``before``, at which the load can be borne.

    Raises
    ------
    NoSolutionError
        The ``error`` of the load at ``before``, if the solid does not harden enough at any depth.
    """
    for more in _MORE_DEPTHS:
        try:
            at_cap(law.cap_at(before + more), None)
        except NoSolutionError:
            continue
        return before + more
    raise error


def added_indentation(solved: Solved) -> RealArray:
    """Permanent indentation (nx, ny) in m that ``solved`` adds: the overlap of the bodies where the pressure is at its limit."""
    qp, solution = solved
    p = solution.state.pressure
    if qp.elastic:
        return np.zeros_like(qp.profile)
    overlap = contact_level(qp, solution) - (solution.state.deflection - qp.profile)
    return np.where((p > 0.0) & (p >= qp.cap), np.maximum(overlap, 0.0), 0.0)


def _disagreement(pressure: RealArray, cap: float | RealArray, limit: float | RealArray) -> float:
    """Largest relative excess of the pressure over the ``limit``, or at yielding points difference from it either way."""
    yields = pressure >= cap
    off = np.where(yields, np.abs(pressure - limit), pressure - limit) / limit
    return float(off.max())


def _hardening(law: LimitByDepth, depth: RealArray) -> RealArray:
    """Change H' of the limit with the depth in Pa/m; zero where there is no indentation."""
    more = _NUDGE * np.maximum(depth, _SHALLOW * depth.max())
    return np.where(depth > 0.0, (law.cap_at(depth + more) - law.cap_at(depth)) / np.where(more > 0.0, more, 1.0), 0.0)


def _own_compliance(operator: Operator) -> float:
    """Displacement (m) of a pixel by one Pa on it alone."""
    unit = np.zeros(operator.grid.shape)
    unit[0, 0] = 1.0
    return float(operator.apply(unit)[0, 0])


@dataclass
class _History:
    """The last arguments and steps of a fixed-point iteration, for its extrapolation (Anderson 1965)."""

    places: list[RealArray] = field(default_factory=list)
    moves: list[RealArray] = field(default_factory=list)

    def extrapolated(self, place: RealArray, move: RealArray) -> RealArray:
        """Where the iteration that steps from ``place`` by ``move`` would come to rest if it were linear."""
        self.places = [*self.places[1 - _REMEMBERED :], place]
        self.moves = [*self.moves[1 - _REMEMBERED :], move]
        if len(self.places) < 2:
            return place + move
        changes = np.diff(np.stack([m.ravel() for m in self.moves]), axis=0).T
        ways = np.diff(np.stack([p.ravel() for p in self.places]), axis=0).T
        weights, *_ = np.linalg.lstsq(changes, move.ravel(), rcond=1e-8)
        ahead: RealArray = place + move - ((ways + changes) @ weights).reshape(place.shape)
        return ahead
