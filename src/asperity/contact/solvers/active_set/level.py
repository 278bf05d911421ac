"""The load under which the contacting plane comes to a prescribed level, found along with the
pressure; constants as in ``solver``.

On a periodic grid a uniform pressure moves nothing, so that methods at a prescribed level converge
badly, and a search over loads solves four or five contacts to the end. Here the load changes while
one contact is being solved: pressure and deflection go on along their difference from a contact
under less load, both being known (``ActiveSet.extrapolated``). On points in contact this difference
is nearly the response s to the plane's own movement, K s = 1; the mean of K p - h weighted by it is
the level that the contact will have when it is solved, to second order in what the pressure still
lacks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import CpuEngine
from ....core.status import Progress
from ..protocol import ContactQP, FixedMean, SolverState, multiplier
from .solver import ActiveSet, Loaded

# What other values of the constants change: docs/develop/solver-history.md.

_UNDER = 0.05
"""Logarithm of the load by which the first contact is to lie below the level. From below, points
that enter on the way bear pressure in the difference of two contacts; from above those that left
would be loaded again, and cleared."""

_CLOSE, _NEXT = 1e-3, 0.03
"""Errors of the contact from which the difference is taken and of that which is moved first."""

_MOST_RISE = 0.35
"""Change of the logarithm of the load above which a contact is not moved but solved anew, from
coarser grids."""

_LACKING = 0.05
"""Miss of the level over the rms height, and over the error of the contact, below which the contact
is not moved."""

_MOST_STEPS, _MOST_STARTS = 30, 6
"""Steps of the solver, and contacts from coarser grids, after which a search over loads takes over,
as on very stiff films."""


class Reached(NamedTuple):
    """Steps (``iterations``) and FFT ``pairs`` of a search, and the contact ``at`` the level, None
    where none was found."""

    iterations: int
    pairs: float
    at: Loaded | None


class _Base(NamedTuple):
    """A contact under less load, its mean pressure (Pa) and its level (m)."""

    contact: Loaded
    mean_pressure: float
    level: float


@dataclass
class LevelSearch:
    """Search for the load of ``qp`` whose plane is at ``level`` (m, in the heights of its profile)
    to within ``allowed`` (m).

    ``towards`` gives the step of the logarithm of the load from another level, as a law of rough
    surfaces has it: the first one, before two levels are known.
    """

    solver: ActiveSet
    qp: ContactQP
    level: float
    allowed: float
    towards: Callable[[float], float]
    progress: Progress
    iterations: int = 0
    pairs: float = 0.0
    mean_pressure: float = 0.0

    @staticmethod
    def serves(solver: ActiveSet, qp: ContactQP) -> bool:
        """Whether contacts of ``qp`` can be moved: elastic ones, with a zero mean mode."""
        return (
            qp.elastic
            and qp.operator.zero_mean_mode
            and isinstance(qp.operator.engine, CpuEngine)
            and not solver.monotone
            and solver.precision != "single"
        )

    def found(self, start: RealArray | None) -> Reached:
        """The contact at the level, from a pressure ``start`` (nx, ny) in Pa, if one is known."""
        state = self._below(start)
        base = None if state is None else self._raised(state)
        contact = None if base is None else self._followed(*base)
        return Reached(self.iterations, self.pairs, contact)

    def _loaded(self) -> ContactQP:
        """The contact under the load reached."""
        return replace(self.qp, constraint=FixedMean(self.mean_pressure))

    def _spend(self, state: SolverState) -> None:
        """Count the work of ``state``, of which no step follows."""
        self.iterations += state.iterations
        self.pairs += state.applications * self.qp.operator.pairs_per_application + state.extra_pairs

    def _closer(self, state: SolverState, error: float, least: int = 0) -> SolverState | None:
        """``state`` after steps down to this ``error``, ``least`` of them at the least; None where
        they are too many."""
        qp = self._loaded()
        while state.error > error or least > 0:
            if self.iterations + state.iterations >= _MOST_STEPS or state.exhausted:
                self._spend(state)
                return None
            state = self.solver.step(qp, state)
            least -= 1
            self.progress.update(self.iterations + state.iterations, max(state.error, 1e-9), self.solver.tolerance)
        return state

    def _below(self, start: RealArray | None) -> SolverState | None:
        """Contact under a load somewhat less than that which is looked for, or None."""
        assert isinstance(self.qp.constraint, FixedMean)
        self.mean_pressure = self.qp.constraint.mean_pressure
        for _ in range(_MOST_STARTS):
            state: SolverState | None = self.solver.init(self._loaded(), start)
            assert state is not None
            start = None
            rise = self.towards(self._level(state))
            if abs(rise) > _MOST_RISE:
                self._spend(state)
                self.mean_pressure *= math.exp(rise)
                continue
            state = self._moved(state, None, math.expm1(rise - _UNDER))
            state = None if state is None else self._closer(state, _CLOSE)
            if state is None:
                return None
            rise = self.towards(self._level(state))
            if 0.0 < rise <= _MOST_RISE:
                return state
            self._spend(state)
            self.mean_pressure *= math.exp(rise)
        return None

    def _raised(self, state: SolverState) -> tuple[_Base, SolverState] | None:
        """That contact, and one nearer to the level."""
        contact = Loaded(np.array(state.pressure), np.array(state.deflection))
        base = _Base(contact, self.mean_pressure, self._level(state))
        moved = self._moved(state, None, math.expm1(self.towards(base.level)))
        nearer = None if moved is None else self._closer(moved, _NEXT, 1)
        return None if nearer is None else (base, nearer)

    def _followed(self, base: _Base, state: SolverState) -> Loaded | None:
        """The contact at the level: between its steps it is moved to the load that follows from the
        two levels, as long as that lacks more than the contact itself."""
        while True:
            ended = state.error <= self.solver.tolerance
            level = self._level(state, None if ended else base.contact)
            miss = self.level - level
            if ended and abs(miss) <= self.allowed:
                self._spend(state)
                return Loaded(state.pressure, state.deflection)
            following: SolverState | None = state
            if ended or abs(miss) > _LACKING * state.error * self.qp.height_scale:
                if not (self.mean_pressure > base.mean_pressure and level > base.level):
                    self._spend(state)
                    return None
                per_level = math.log(self.mean_pressure / base.mean_pressure) / (level - base.level)
                change = self.mean_pressure * math.expm1(per_level * miss)
                following = self._moved(state, base, change / (self.mean_pressure - base.mean_pressure))
            if following is not None and following.error > self.solver.tolerance:
                following = self._closer(following, math.inf, 1)
            if following is None:
                return None
            state = following

    def _moved(self, state: SolverState, base: _Base | None, ratio: float) -> SolverState | None:
        """``state`` and ``ratio`` times its difference from ``base``, or from no contact."""
        self.mean_pressure += ratio * (self.mean_pressure - (0.0 if base is None else base.mean_pressure))
        contact, moved = None if base is None else base.contact, None
        if self.mean_pressure > 0.0:
            moved = self.solver.moved(self._loaded(), state, contact, ratio)
        if moved is None:
            self._spend(state)
        return moved

    def _level(self, state: SolverState, earlier: Loaded | None = None) -> float:
        """Level (m) of ``state``, weighted by the pressure or its difference from an ``earlier``
        one."""
        if earlier is None:
            return multiplier(self.qp.survey(state).totals)
        index = np.flatnonzero(state.pressure)
        weight = state.pressure.ravel()[index] - earlier.pressure.ravel()[index]
        off = state.deflection.ravel()[index] - self.qp.profile.ravel()[index]
        return float((weight * off).sum() / weight.sum())
