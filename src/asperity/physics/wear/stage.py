"""One implicit stretch of sliding: the contact whose pressure wears the surfaces while it acts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...contact.controls import Step
from ...contact.couplings.protocol import Coupling, Deflections, Exchange, Memory, Posed
from ...contact.operators import Operator
from ...contact.solve import Prepared
from ...contact.state import InterfaceState
from ...core.arrays import RealArray
from ...core.status import Outcome, Status
from .losses import Doses, Linearised, Losses
from .operator import WearOperator

_MOST = 40
"""Contacts at most within one stretch, each with the stages of wear that the last one has shown;
break-through takes two to five."""

_CHORDS_FROM = 8
"""Contact from which on points that go to and fro between two stages take the chord of both."""

_AGREES = 1e-7
"""Miss of the depth over the largest lost in the stretch, or over the height of the surfaces, at
which the stages agree with the contact."""


@dataclass(frozen=True, eq=False)
class Hollow(Coupling):
    """What is lost whatever the pressure, ``depth`` (nx, ny) in m, as a displacement."""

    depth: RealArray
    name: ClassVar[str] = "wear"
    feedback: ClassVar[bool] = False
    remedy: ClassVar[str] = ""

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The depth, which stays."""
        return Exchange(self.depth, self.depth)


@dataclass(frozen=True, eq=False)
class Stage:
    """What one stretch comes to: its ``pressure`` (nx, ny) in Pa, by which the bodies deflect by
    ``deflection`` (nx, ny) in m, how it ended, and the work: FFT ``pairs`` and number of
    ``contacts``."""

    pressure: RealArray
    deflection: RealArray
    status: Status
    pairs: float
    contacts: int


def implicit_stage(
    prepared: Prepared,
    step: Step,
    state: InterfaceState,
    losses: Losses,
    stretch: Stretch,
    ahead: float | None = None,
) -> Stage:
    """Contact at the end of ``stretch`` under ``step``, started from ``state``, the surfaces of
    ``prepared`` being those at its begin.

    The depth is piecewise linear in the pressure, so that the contact with the slopes of the last
    pressure (Newton's method) is the answer as soon as no point changes its stage. ``ahead``:
    length of the stretch over the one before, in which pressures are extrapolated to start from.
    """
    guess, earlier = state.pressure, None
    if ahead is not None and state.earlier is not None and not losses.linear:
        guess = np.maximum(guess + ahead * (guess - state.earlier), 0.0)
    pairs, slid = 0.0, stretch.slid
    scale = 1.0 if losses.linear else float(np.ptp(prepared.profile)) or 1.0
    model = losses.linearised(stretch.before, stretch.doses, guess, slid)
    for count in range(1, _MOST + 1):
        least = None
        if isinstance(model.bed, np.ndarray) and (touching := guess > 0.0).any():
            least = float(model.bed[touching].min())
        operator = WearOperator(prepared.operator, model.bed, model.track, least)
        begun = _begun(state, model, operator)
        hollow = model.start if isinstance(model.start, np.ndarray) and model.start.any() else None
        settled = prepared.settled(
            step,
            begun,
            operator=operator,
            retarded=hollow,
            ahead=ahead if count == 1 else None,
            couplings=prepared.couplings if hollow is None else (*prepared.couplings, Hollow(hollow)),
        )
        found = settled.contact
        own = found.solution.state
        pairs += own.applications * operator.pairs_per_application + own.extra_pairs
        pressure = found.pressure
        plain, status = own.deflection - model.beside(pressure), settled.status
        if losses.linear or not status.converged:
            break
        wanted = losses.hollow(losses.after(stretch.doses, pressure, slid)) - losses.hollow(stretch.before)
        miss = float(np.abs(wanted - model.depth(pressure)).max())
        enough = _AGREES * max(float(np.abs(wanted).max()), _AGREES * scale)
        if miss <= enough:
            break
        following = losses.linearised(stretch.before, stretch.doses, pressure, slid)
        if count >= _CHORDS_FROM and earlier is not None:
            following = _chords(following, losses, stretch, pressure, earlier)
        earlier, guess, model = pressure, pressure, following
        state = resumed(state, pressure, plain, operator.whole)
    else:
        status = Status(
            Outcome.ITERATION_LIMIT,
            f"Not converged: the stages of wear still change the depth by {miss:.1e} m after {_MOST} contacts.",
            "Take more steps ({wear.steps}).",
        )
    return Stage(pressure, plain, status, pairs, count)


def resumed(state: InterfaceState, pressure: RealArray, deflection: RealArray, operator: Operator) -> InterfaceState:
    """``state`` with a ``pressure`` to start from, by which the bodies deflect as is known."""
    pairs = ((pressure, deflection),)
    known = Deflections(operator.compliance, operator.boundary, operator.grid, pairs, within=True)
    return InterfaceState.solved(pressure, state.memory, deflections=known)


@dataclass(frozen=True, eq=False)
class Stretch:
    """A stretch of ``slid`` (m, or a map of it) that begins with ``doses``; depths count from
    ``before``, at which the surfaces of the contact are."""

    before: Doses
    doses: Doses
    slid: float | RealArray


def _begun(state: InterfaceState, model: Linearised, operator: WearOperator) -> InterfaceState:
    """``state`` with the displacements that its pressures cause with wear, where those without are
    known."""
    known, pairs = state.deflections, []
    for pressure in (state.pressure, state.earlier):
        plain = None if known is None or pressure is None else known.by(pressure, operator.whole)
        if pressure is None or plain is None:
            break
        pairs.append((pressure, plain + model.beside(pressure)))
    if known is None or not pairs:
        return InterfaceState.solved(state.pressure, state.memory)
    found = Deflections(operator.compliance, operator.boundary, operator.grid, tuple(pairs), known.within)
    return InterfaceState.solved(state.pressure, state.memory, state.earlier if len(pairs) > 1 else None, found)


def _chords(model: Linearised, losses: Losses, stretch: Stretch, pressure: RealArray, other: RealArray) -> Linearised:
    """``model`` with the slope between two pressures where they are in different stages."""
    if model.track is not None:
        return model
    depths = [losses.hollow(losses.after(stretch.doses, p, stretch.slid)) for p in (pressure, other)]
    apart = pressure - other
    moved = np.abs(apart) > 1e-12 * float(pressure.max())
    chord = np.where(moved, (depths[0] - depths[1]) / np.where(moved, apart, 1.0), 0.0)
    bed = np.where(moved, np.maximum(chord, 0.0), np.broadcast_to(model.bed, pressure.shape))
    start = depths[0] - losses.hollow(stretch.before) - bed * pressure
    return Linearised(start, bed, None)
