"""Conjugate gradients at a prescribed approach, negative pressures cut off (Nogi & Kato 1997, as
given by Peng 2001, eq. 3.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple

import numpy as np

from ....core.arrays import BoolArray, RealArray
from ...operators.convolution import Operator, PeriodicOperator
from ..protocol import (
    ContactQP,
    FixedMean,
    FixedOffset,
    Iterative,
    SolverState,
    energy,
    feasible_start,
    heights_near_contact,
    level,
    relative_error,
    scaled_to_load,
)
from .steepest_descent import descend, levelling_step

_ROUNDING = 1e-13
"""Relative rise of the energy that counts as none: the rounding of sums over some 10⁵ points."""

_SOLVED = 0.1
"""Largest residual in contact over the largest overlap outside at which the set is changed; and
the error of the contact at one approach, and of its load, over the error allowed at the end."""


class _Tried(NamedTuple):
    """An offset (m) and the excess of the load there over the prescribed one, in shares of it."""

    offset: float
    excess: float


@dataclass(frozen=True, eq=False)
class _Memory:
    """The problem at the present approach, its state, the points in contact, the search direction,
    the squared norm of the residual before it (0: begin anew), the step of last resort (Pa/m), the
    error at which the approach changes, and the nearest approaches with more and with less load."""

    at: ContactQP
    state: SolverState
    touching: BoolArray
    direction: RealArray
    norm: float
    pixel_step: float
    settled: float
    closer: _Tried | None = None
    farther: _Tried | None = None


@dataclass(frozen=True)
class NogiKato(Iterative):
    """Conjugate gradients at a prescribed approach; the load is met by a search around them.

    The points that overlap undeformed are in contact first. In each iteration (Peng's eq. 3.2)

        a = s·s / t·Kt,  p' = p + a t,  s' = s - a Kt,  t' = s' + (s'·s' / s·s) t

    with the residual s = h - d - K p on the points in contact and the step a; pressures beyond
    their bounds are cut off, those points leave, and the directions begin anew. The source ends
    where no pressure is negative and never takes a point back. Here points that overlap outside
    join again, a step that raises the energy is replaced by one along the projected gradient, and
    the method ends by the same error as all. A prescribed load is met by trying approaches, each
    a whole solve, by regula falsi: some ten times the work of ``ConjugateGradient``.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of iterations, of all approaches together.
    """

    tolerance: float = 1e-7
    max_iterations: int = 20000
    name: ClassVar[str] = "nogi_kato"
    citation_keys: ClassVar[tuple[str, ...]] = ("Nogi1997", "Peng2001")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, with the points in contact that overlap undeformed."""
        begin = feasible_start(qp, start)
        if isinstance(qp.constraint, FixedOffset):
            at = qp
        else:
            at = replace(qp, operator=_definite(qp.operator), profile=heights_near_contact(qp))
        deflection = at.operator.apply(begin)
        if isinstance(qp.constraint, FixedMean):
            at = replace(at, constraint=FixedOffset(-level(at, begin, deflection - at.profile)))
        state = SolverState(begin, deflection, relative_error(at, begin, deflection), applications=2)
        # without a load nothing touches
        none = _Tried(float(at.profile.max()), -1.0) if isinstance(qp.constraint, FixedMean) else None
        memory = _Memory(
            at,
            state,
            _first_contact(at, begin),
            np.zeros_like(begin),
            0.0,
            levelling_step(qp),
            _SOLVED * self.tolerance,
            farther=none,
        )
        return _reported(qp, memory)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One iteration of conjugate gradients, after a new set or approach where it is time."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        if isinstance(qp.constraint, FixedMean) and memory.state.error <= memory.settled:
            moved = _next_approach(qp.constraint.mean_pressure, memory)
            if moved is None:
                return replace(state, iterations=state.iterations + 1, exhausted=True)
            memory = moved
        return _reported(qp, _iterated(memory))


def _definite(operator: Operator) -> Operator:
    """``operator``, where a uniform pressure moves nothing with a stiffness of the mean as of the
    longest wave.

    At full contact no approach would have a load of its own; the load prescribed decides how far
    the approach is then shifted.
    """
    if not operator.zero_mean_mode:
        return operator
    kernel = np.array(operator.kernel)
    kernel[0, 0] = operator.largest or 1.0
    return PeriodicOperator(operator.compliance, operator.grid, engine=operator.engine, kernel=kernel)


def _residual(at: ContactQP, state: SolverState) -> RealArray:
    """s = h - d - K p (m), the overlap left, at all points."""
    assert isinstance(at.constraint, FixedOffset)
    found: RealArray = at.profile - at.constraint.offset - state.deflection
    return found


def _first_contact(at: ContactQP, pressure: RealArray) -> BoolArray:
    """The points that overlap undeformed, and those that are loaded already."""
    assert isinstance(at.constraint, FixedOffset)
    found: BoolArray = (at.profile > at.constraint.offset) | (pressure > 0.0)
    return found


def _iterated(memory: _Memory) -> _Memory:
    """``memory`` after one iteration at its approach."""
    at, state, touching = memory.at, memory.state, memory.touching
    p, overlap = state.pressure, _residual(memory.at, memory.state)
    wrong = ((p <= 0.0) & (overlap > 0.0)) | ((p >= at.cap) & (overlap < 0.0))
    joining = wrong & ~touching
    largest = float(np.abs(overlap[touching]).max()) if touching.any() else 0.0
    norm_before = memory.norm
    if joining.any() and largest <= _SOLVED * float(np.abs(overlap[joining]).max()):
        touching, norm_before = touching | joining, 0.0

    s: RealArray = np.where(touching, overlap, 0.0)
    norm = float((s**2).sum())
    t: RealArray = s + (norm / norm_before) * memory.direction if norm_before > 0.0 else s
    response = at.operator.apply(t)
    curvature = float((t * response).sum())
    length = norm / curvature if curvature > 0.0 else memory.pixel_step
    trial = p + length * t
    bounded: RealArray = np.clip(trial, 0.0, at.cap)
    leaving = bounded != trial
    cut = bool(leaving.any())
    deflection = at.operator.apply(bounded) if cut else state.deflection + length * response
    before, after = energy(at, p, state.deflection), energy(at, bounded, deflection)
    applications = state.applications + (2 if cut else 1)
    if after > before + _ROUNDING * abs(before) or norm == 0.0:
        lower = descend(at, replace(state, applications=applications), memory.pixel_step)
        touching = (lower.pressure > 0.0) & (lower.pressure < at.cap)
        return replace(memory, state=replace(lower, exhausted=False), touching=touching, norm=0.0)
    taken = replace(
        state,
        pressure=bounded,
        deflection=deflection,
        error=relative_error(at, bounded, deflection),
        iterations=state.iterations + 1,
        applications=applications,
    )
    return replace(memory, state=taken, touching=touching & ~leaving, direction=t, norm=0.0 if cut else norm)


def _next_approach(mean: float, memory: _Memory) -> _Memory | None:
    """``memory`` at the next approach to try for the ``mean`` pressure (Pa); None where there is
    none between those tried."""
    constraint, state = memory.at.constraint, memory.state
    assert isinstance(constraint, FixedOffset)
    here = _Tried(constraint.offset, float(state.pressure.mean()) / mean - 1.0)
    if abs(here.excess) <= memory.settled:  # the load is met: what is wrong is the contact
        return replace(memory, settled=_SOLVED * memory.settled)
    closer, farther = memory.closer, memory.farther
    assert farther is not None
    # the end that stays counts half from the second time on (Illinois), so that both ends move
    if here.excess > 0.0:
        again = closer is not None and here.offset > closer.offset
        closer, farther = here, farther._replace(excess=0.5 * farther.excess) if again else farther
    else:
        if closer is not None and here.offset < farther.offset:
            closer = closer._replace(excess=0.5 * closer.excess)
        farther = here
    ends = (closer, farther) if closer is not None else (here, _Tried(float(memory.at.profile.max()), -1.0))
    (a, fa), (b, fb) = ends
    offset = a - fa * (b - a) / (fb - fa) if fb != fa else math.nan
    if closer is not None and not closer.offset < offset < farther.offset:
        offset = 0.5 * (closer.offset + farther.offset)
    if not math.isfinite(offset) or offset == here.offset or (closer and offset in (closer.offset, farther.offset)):
        return None
    at = replace(memory.at, constraint=FixedOffset(offset))
    error = relative_error(at, state.pressure, state.deflection)
    return replace(memory, at=at, state=replace(state, error=error), norm=0.0, closer=closer, farther=farther)


def _reported(qp: ContactQP, memory: _Memory) -> SolverState:
    """State of ``qp`` at the state of the approach: its pressure, scaled to the load where one is
    prescribed."""
    state = memory.state
    if isinstance(qp.constraint, FixedOffset):
        return replace(state, memory=memory)
    pressure = scaled_to_load(state.pressure, qp.cap, qp.constraint.mean_pressure)
    before = float(state.pressure.mean())
    if qp.elastic and state.iterations > 0 and before > 0.0:
        moved = 0.0 if memory.at.operator is qp.operator else before * float(memory.at.operator.kernel[0, 0])
        deflection = (float(pressure.mean()) / before) * (state.deflection - moved)
        applications = state.applications + 1
    else:
        deflection = qp.operator.apply(pressure)
        applications = state.applications + state.iterations + 1
    error = relative_error(qp, pressure, deflection)
    return replace(
        state, pressure=pressure, deflection=deflection, error=error, applications=applications, memory=memory
    )
