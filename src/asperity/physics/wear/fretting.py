"""Fretting wear: stick and slip in cycles of a small shift, with jumps over many of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Literal, NamedTuple

import numpy as np

from ...contact.controls import Control, Step
from ...contact.history import shear_cycles
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import Prepared
from ...contact.state import InterfaceState
from ...contact.tangential import Shift
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.status import Status
from .history import QUANTITIES, WearHistory, WearState
from .law import Sides, WearLaw
from .march import REPEATED, At, March, WearSteps, check, too_many
from .stage import Stretch

_FIRST_JUMP = 1.0
"""Cycles of the first jump."""


def fretted(
    problem: ContactProblem,
    control: Control,
    shift: Shift,
    cycles: int | Sequence[int],
    wear: Sides | WearLaw,
    *,
    steps: WearSteps = WearSteps(),
    quarter: int = 8,
    state: WearState | None = None,
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> WearHistory:
    """Contact that wears by the slip of cycles of a small shift, under friction.

    One cycle is solved with stick and slip. The dose of each point in it, the sum of pressure times
    slip of its steps, is taken for that of the cycles of a jump; within the jump the pressure is
    implicit, as in ``worn``, and the slip is that of the cycle. The cycle after the jump tells how
    much the dose has changed, and so the error and the length of the next jump (jump in cycles,
    Johansson 1994; McColl, Ding and Leen 2004).

    The contact stays where it is on both surfaces: the shift has to be small against its width. Of
    a cylinder that was shifted by half of the width of its contact, depths came out 7 to 10 % too
    large.

    Parameters
    ----------
    problem
        Virgin surfaces and bodies with friction: ``Coulomb(coefficient)``.
    control
        ``MeanPressure``, ``Force`` or ``Approach``, held throughout.
    shift
        Amplitude: the counter body goes to it, to its opposite, and back.
    cycles
        Number of cycles >= 1 counted from the virgin surfaces, or ascending numbers at which
        contacts are kept.
    wear
        Law of the body, or ``Sides`` of both; tracks have no part in fretting.
    steps
        Tolerance of the jumps, or the number of equal jumps; ``order`` and ``method`` are first and
        implicit.
    quarter
        Steps of a quarter of a cycle, >= 1.
    state
        Where an earlier history of the same problem ended, to go on from.
    on_failure
        ``"raise"`` a ConvergenceError holding the history so far, or ``"return"`` it.
    options
        Keywords of ``solve``.

    Raises
    ------
    InputError
        If a value is out of range, or the problem has no friction.
    ConvergenceError
        If a contact or the jumps do not reach their tolerance and ``on_failure`` is ``"raise"``.
    """
    sides = check(problem, control, wear)
    if problem.friction is None:
        raise InputError("friction of a problem that frets must be given, but is None. Give friction=Coulomb(0.3).")
    require.instance(shift, Shift, "shift of a cycle", "Write Shift(1e-6).")
    if not (shift.x or shift.y or shift.twist):
        raise InputError("shift of a cycle must not be zero, but is. Write Shift(1e-6).")
    if sides.body_track is not None or sides.counter_track is not None:
        raise InputError("sides that fret must be without a track, but one has a length. Both slide all the time.")
    if steps.order != 1 or steps.method != "implicit":
        raise InputError(f"jumps of cycles must be implicit and of first order, but are {steps!r}.")
    require.integer(quarter, 1, "number of steps of a quarter of a cycle")
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    marks = [cycles] if isinstance(cycles, int) else list(cycles)
    begin = 0.0 if state is None else state.cycles
    for low, high in zip([begin, *marks], marks, strict=False):
        require.integer(high, 1, "number of cycles")
        if not high > low:
            raise InputError(f"numbers of cycles must be ascending and above the start {begin:g}, but are {marks}.")
    if not marks:
        raise InputError("numbers of cycles must hold at least one, but hold none.")
    course = Fretting(problem, control, sides, steps, options, shear_cycles(control, shift, cycles=1, steps=quarter))
    history = course.over(state, [float(mark) for mark in marks])
    if on_failure == "raise" and not history.converged:
        raise ConvergenceError(f"{history.status.message} {history.status.remedy}", history)
    return history


class Cycle(NamedTuple):
    """One cycle: the contact at its end, its dose (nx, ny) in Pa m, and how it ended."""

    result: ContactResult
    dose: RealArray
    status: Status


class Fretting(March):
    """Jumps over cycles of one contact."""

    def __init__(
        self,
        problem: ContactProblem,
        control: Control,
        sides: Sides,
        steps: WearSteps,
        options: dict[str, Any],
        path: Sequence[Step],
    ) -> None:
        super().__init__(problem, control, sides, steps, options)
        self.path = path

    def sheared(self, at: Prepared, interface: InterfaceState) -> Cycle:
        """One cycle on the prepared surfaces, from ``interface`` on; a virgin one is loaded
        first."""
        prepared = self.made(at.problem, at.operator, sticks=True)
        first = len(self.path) // 5  # a quarter to the first turning point, and the cycle of four
        begun, status, result = "stick_slip" in interface.memory, None, None
        dose = np.zeros(self.problem.grid.shape)
        for number, step in enumerate(self.path):
            if begun and number < first:
                continue
            result = prepared.step(step, interface)
            self.count(result.certificate.fft_pairs)
            status, interface = result.status, result.state
            if not result.converged:
                break
            if number >= first:
                slipped = np.hypot(*result.require_stick_slip().slip_increment)
                dose += result.pressure * slipped
        assert result is not None
        assert status is not None
        return Cycle(result, dose, status)

    def over(self, state: WearState | None, marks: Sequence[float]) -> WearHistory:
        """History up to all ``marks`` (cycles)."""
        if state is None:
            none = InterfaceState(np.zeros(self.problem.grid.shape))
            state = WearState(0.0, 0.0, self.losses.virgin(), none)
        state.interface.require_shape(self.problem.grid.shape)
        depths = self.losses.depths(state.doses)
        prepared = self.prepared(state, depths)
        cycle = self.sheared(prepared, state.interface)
        at = At(replace(state, interface=cycle.result.state), cycle.result, prepared, cycle.status, depths)
        values: dict[str, list[float]] = {item.name: [] for item in QUANTITIES}
        kept, taken, number = [(at.state.cycles, at.result)], 0, self.steps.number
        self.record(values, at)
        for mark in marks:
            equal = None if number is None else max(1.0, (mark - at.state.cycles) / number)
            while at.status.converged and at.state.cycles < mark:
                if taken == self.steps.most:
                    at = at._replace(status=too_many("cycle", at.state.cycles, marks[-1], taken))
                    break
                at, cycle = self.jumped(at, cycle, mark, equal)
                self.record(values, at)
                taken += 1
            kept.append((at.state.cycles, at.result))
            if not at.status.converged:
                break
        return self.history(values, at, kept)

    def jumped(self, at: At, cycle: Cycle, mark: float, equal: float | None) -> tuple[At, Cycle]:
        """After one jump, with the cycle there; one whose error is too large is repeated over fewer
        cycles."""
        state, losses = at.state, self.losses
        length = (state.length if not math.isnan(state.length) else _FIRST_JUMP) if equal is None else equal
        # within the jump the contact is without shear, and so is that by which the slip is measured
        plain = self.frictionless(at.prepared)
        begin = self.solved(plain, InterfaceState(at.result.pressure, _hardness(at.result)))
        touching = begin.contact
        slip = np.where(touching, cycle.dose / np.where(touching, begin.pressure, 1.0), 0.0)
        outside = np.where(touching, 0.0, cycle.dose)
        while True:
            count = min(max(1.0, float(round(length))), mark - state.cycles)
            before = losses.each(lambda loss, start: start + count * outside, state.doses)  # noqa: B023
            stretch = Stretch(state.doses, before, count * slip)
            stage = self.stage(plain, begin.state, stretch, None)
            doses = losses.after(before, stage.pressure, count * slip)
            found = replace(state, doses=doses)
            depths = losses.depths(doses)
            prepared = self.prepared(found, depths, at.prepared)
            after = self.sheared(prepared, at.result.state)
            status = stage.status if not stage.status.converged else after.status
            # the trapezoidal rule between the cycles before and after the jump
            mean = 0.5 * count * (cycle.dose + after.dose)
            other = losses.each(lambda loss, start: start + mean, state.doses)  # noqa: B023
            misplaced = losses.apart(doses, other)
            error = losses.share(state.doses, doses, misplaced, count / (state.cycles + count))
            factor = self.steps.factor(error)
            if equal is not None or count == 1.0 or not status.converged:
                break
            if error <= REPEATED * self.steps.tolerance:
                break
            length = factor * count
        slipped = count * float(slip[touching].mean()) if touching.any() else 0.0
        found = replace(
            found,
            distance=state.distance + slipped,
            cycles=state.cycles + count,
            interface=after.result.state,
            length=math.nan if equal is not None else max(1.0, factor * count),
            misplaced=state.misplaced + misplaced,
            breakthrough=min(state.breakthrough, losses.worn_through(state.doses, doses, (state.cycles, count))),
        )
        return At(found, after.result, prepared, status, depths), after

    def frictionless(self, prepared: Prepared) -> Prepared:
        """The ``prepared`` surfaces without friction."""
        return self.made(prepared.problem.with_physics(friction=None), prepared.operator)


def _hardness(result: ContactResult) -> dict[str, Any]:
    return {name: memory for name, memory in result.state.memory.items() if name == "hardness"}
