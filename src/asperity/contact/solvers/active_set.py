"""Inexact active set with preconditioned conjugate gradients on nested grids: the fast solver."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Face, Totals
from .correction import Direction, carried, correction
from .feasible import feasible_start, scaled_to_load
from .nested import nested_start
from .protocol import ContactQP, FixedMean, FixedOffset, SolverState, require_settings
from .steepest_descent import descend, levelling_step
from .workspace import Workspace, workspace

_COARSE_TOLERANCE = 1e-2
_COARSE_ITERATIONS = 30
_UNSETTLED_STEPS = 2
_SETTLED_STEPS = 14
_REDUCTION = 0.25
_SMALLEST_REDUCTION = 1e-4
_MARGIN = 0.6
_CARRIED = 0.1
_LEAST_SHARE = 0.1
_ENERGY_ROUNDING = 1e-13
_MOST_SETBACKS = 4
_ROUNDING = 4.0 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class _Memory:
    """Where the iterate lies (``side`` of the buffers), its sums, how many points the last step clipped, the last
    search direction, and how many steps had to be replaced so far: each doubles the effort put into the next."""

    work: Workspace
    side: int
    totals: Totals
    clipped: int
    last: Direction | None = None
    setbacks: int = 0


@dataclass(frozen=True)
class ActiveSet:
    """Newton's method on the contact set, each linear system solved loosely by preconditioned conjugate gradients.

    A step frees the points whose pressure may move, solves K p = h + level on them to a modest accuracy (FFT
    preconditioner: the inverse compliance restricted to the set), and clips the pressure to its bounds. The first guess
    comes from coarser grids. Corrections are computed in single precision, the gap they must close in double
    (``precision="mixed"``), so the answer has double precision at nearly the cost of single.

    The energy never rises: a step that would raise it is shortened to the minimum on its way, or replaced by one along
    the projected gradient. Buffers are reused: a state is valid until the step after next.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of steps.
    precision
        ``"mixed"`` or ``"double"``.
    """

    tolerance: float = 1e-7
    max_iterations: int = 300
    precision: Literal["mixed", "double"] = "mixed"
    name: ClassVar[str] = "active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Polonsky1999")

    def __post_init__(self) -> None:
        require_settings(self)
        require.one_of(self.precision, ("mixed", "double"), "precision of the solver active_set")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, or at the solution on coarser grids."""
        if start is None or not start.any():
            coarse = replace(self, tolerance=max(_COARSE_TOLERANCE, self.tolerance), max_iterations=_COARSE_ITERATIONS)
            begin, pairs = nested_start(qp, coarse)
        else:
            begin, pairs = feasible_start(qp, start), 0.0
        work = workspace(qp, self.precision)
        work.engine.copy(work.engine.array(begin, "float64"), work.pressures[0])
        work.double.apply(work.pressures[0], work.deflections[0])
        totals = work.engine.totals(work.pressures[0], work.deflections[0], work.heights, work.cap)
        spent = SolverState(begin, begin, np.inf, applications=1, extra_pairs=pairs)
        return _state(qp, _Memory(work, 0, totals, clipped=1), spent)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One working set, its correction, and the clipped pressure."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        work, here, there = memory.work, memory.side, 1 - memory.side
        engine, p, u = work.engine, work.pressures[here], work.deflections[here]
        level = _level(qp, memory.totals)
        face = engine.face(p, u, work.heights, work.cap, level, qp.height_scale, work.field)
        d, pairs, last = correction(qp, work, face, _carried(memory, face), *self._effort(memory, face, state.error))
        spent = replace(state, iterations=state.iterations + 1, extra_pairs=state.extra_pairs + pairs)
        if d is None:
            engine.release(face, work.field)
            return _gradient_step(qp, memory, spent)
        q, v = work.pressures[there], work.deflections[there]
        change, clipped = face.pressure(p, d, qp.height_scale / work.scale, work.cap, q)
        engine.release(face, work.field)
        _restore_load(qp, work, q, memory.totals.pressure + change)
        work.double.apply(q, v)
        totals = engine.totals(q, v, work.heights, work.cap)
        totals, descended = _monotone(memory, there, totals)
        spent = replace(spent, applications=state.applications + 1)
        if not descended:
            return _gradient_step(qp, memory, spent)
        return _state(qp, _Memory(work, there, totals, clipped, last, memory.setbacks), spent)

    def _effort(self, memory: _Memory, face: Face, error: float) -> tuple[float, int]:
        """Relative residual at which to stop a correction, and the largest number of its steps.

        Accuracy is wasted on a set that will change: only once no point enters or leaves is the system solved to what
        the tolerance asks for.
        """
        if face.entering or memory.clipped:
            return _REDUCTION, _UNSETTLED_STEPS << min(memory.setbacks, _MOST_SETBACKS)
        wanted = _MARGIN * self.tolerance / error if error > 0.0 else 1.0
        return min(_REDUCTION, max(wanted, _SMALLEST_REDUCTION)), _SETTLED_STEPS


def _carried(memory: _Memory, face: Face) -> Direction | None:
    """Last search direction on the new ``face``, if the set has changed so little that it still helps."""
    if memory.last is None or memory.clipped + face.entering > _CARRIED * face.size:
        return None
    return carried(memory.work, face, memory.last)


def _restore_load(qp: ContactQP, work: Workspace, pressure: Any, total: float) -> None:
    """Scale the clipped ``pressure`` (in place) back to the prescribed load."""
    if not isinstance(qp.constraint, FixedMean):
        return
    if work.cap is None:
        if total > 0.0:
            work.engine.rescale(pressure, qp.constraint.mean_pressure * qp.profile.size / total)
        return
    scaled = scaled_to_load(work.engine.numpy(pressure), qp.cap, qp.constraint.mean_pressure)
    work.engine.copy(work.engine.array(scaled, "float64"), pressure)


def _level(qp: ContactQP, totals: Totals) -> float:
    """Level of the contacting plane in the heights of the workspace, as in ``optimality.level``."""
    if isinstance(qp.constraint, FixedOffset):
        return 0.0
    if totals.weight > 0.0:
        return totals.weighted / totals.weight
    low = totals.highest_capped if np.isfinite(totals.highest_capped) else totals.lowest
    high = totals.lowest_open if np.isfinite(totals.lowest_open) else low
    return 0.5 * (low + high)


def _energy(totals: Totals) -> float:
    """p·Kp/2 - p·h from p·(Kp - h) and p·h."""
    return 0.5 * (totals.work - totals.height)


def _monotone(memory: _Memory, there: int, totals: Totals) -> tuple[Totals, bool]:
    """Shorten the step just taken so that the energy does not rise; whether that was possible."""
    before = _energy(memory.totals)
    if _energy(totals) <= before + _ENERGY_ROUNDING * abs(before):
        return totals, True
    work = memory.work
    p, q = work.pressures[memory.side], work.pressures[there]
    u, v = work.deflections[memory.side], work.deflections[there]
    slope, curvature = work.engine.segment(p, q, u, v, work.heights)
    if slope >= 0.0 or curvature <= 0.0:
        return totals, False
    share = min(1.0, -slope / curvature)
    if share < _LEAST_SHARE:
        return totals, False
    work.engine.blend(p, q, share)
    work.engine.blend(u, v, share)
    return work.engine.totals(q, v, work.heights, work.cap), True


def _gradient_step(qp: ContactQP, memory: _Memory, spent: SolverState) -> SolverState:
    """Step along the projected gradient from the last good iterate; exhausted if not even that lowers the energy."""
    work, there = memory.work, 1 - memory.side
    pressure = work.engine.numpy(work.pressures[memory.side]).copy()
    deflection = work.engine.numpy(work.deflections[memory.side]).copy()
    here = replace(spent, pressure=pressure, deflection=deflection)
    lower = descend(qp, here, levelling_step(qp))
    work.engine.copy(work.engine.array(lower.pressure, "float64"), work.pressures[there])
    work.engine.copy(work.engine.array(lower.deflection, "float64"), work.deflections[there])
    totals = work.engine.totals(work.pressures[there], work.deflections[there], work.heights, work.cap)
    spent = replace(spent, applications=lower.applications + 1, exhausted=lower.exhausted)
    return _state(qp, _Memory(work, there, totals, clipped=1, setbacks=memory.setbacks + 1), spent)


def _state(qp: ContactQP, memory: _Memory, spent: SolverState) -> SolverState:
    """State at the iterate of ``memory`` with the work ``spent``; its error is ``optimality.relative_error``."""
    work = memory.work
    p, u = work.pressures[memory.side], work.deflections[memory.side]
    error = _relative_error(qp, work, p, u, memory.totals)
    pressure, deflection = work.engine.numpy(p), work.engine.numpy(u)
    return replace(spent, pressure=pressure, deflection=deflection, error=error, memory=memory)


def _relative_error(qp: ContactQP, work: Workspace, p: Any, u: Any, totals: Totals) -> float:
    load = totals.pressure * qp.height_scale
    if isinstance(qp.constraint, FixedMean) and work.cap is None:
        lifted = totals.lowest * totals.pressure
        rounding = _ROUNDING * (abs(totals.work) + abs(lifted))  # the difference below is not known any better
        return max(totals.work - lifted, rounding) / load
    found = work.engine.violation(p, u, work.heights, work.cap, _level(qp, totals))
    if isinstance(qp.constraint, FixedMean):
        lowest = work.engine.violation(p, u, work.heights, work.cap, totals.lowest)
        return min(found.above + found.below, lowest.above + lowest.below) / load
    weighted = found.above / totals.pressure if totals.pressure > 0.0 else 0.0
    return (weighted + found.deepest) / qp.height_scale
