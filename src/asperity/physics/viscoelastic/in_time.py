"""Steps of time of a prepared problem with viscoelastic bodies."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...contact.answer import Answer, outside
from ...contact.controls import Approach, Control, MeanGap, Step, as_step
from ...contact.couplings.driver import Settled
from ...contact.couplings.protocol import Contact, Coupling, Memory, Posed, height_scale
from ...contact.edges import real_area
from ...contact.operators import Operator
from ...contact.operators.creep import OperatorsInTime
from ...contact.result import ContactResult, edges_in
from ...contact.solvers.protocol import ContactQP, FixedOffset, Solution, SolverState
from ...contact.state import InterfaceState
from ...core.arrays import RealArray
from ...core.errors import ConvergenceError
from ...core.status import Outcome, Status
from ...solids.compliance.creep import SharedCreep, contact_creep
from ..friction.answer import StickSlip
from ..friction.operator import NO_COUPLING
from ..friction.sliding import GrossSliding, SlidingCoupling
from ..friction.stick_slip import StickSlipCoupling
from .coupling import CreepCoupling, LayeredPast, Past, TimeWeights, remembering
from .energy import Account, accounted, balanced, force_work, step_error
from .layered_shear import LayeredShear
from .moments import Creeping, Moment, marched
from .shear import ShearMemory

if TYPE_CHECKING:
    from ...contact.solve import Prepared


class InTime:
    """Steps of time of a prepared problem with viscoelastic bodies."""

    def __init__(self, prepared: Prepared) -> None:
        problem, operator = prepared.problem, prepared.operator
        for physics in problem.physics:
            physics.check_relaxing(problem)
        sheared = any(isinstance(coupling, StickSlipCoupling | SlidingCoupling) for coupling in prepared.couplings)
        creep = contact_creep(problem.body, problem.counter_body, shear=sheared)
        assert creep is not None
        self.sticks = any(isinstance(coupling, StickSlipCoupling) for coupling in prepared.couplings)
        self.prepared, self.remembering = prepared, remembering(creep, operator)
        self.operators = OperatorsInTime(creep, operator)
        self.shear: ShearMemory | LayeredShear | None = None
        if sheared:
            threads = getattr(operator.engine, "threads", None)
            if isinstance(self.remembering, LayeredPast):
                self.shear = LayeredShear.prepared(problem, self.remembering, threads)
            else:
                assert isinstance(creep, SharedCreep)
                self.shear = ShearMemory.prepared(problem, creep, threads)
        lifting: list[Coupling] = []
        for coupling in prepared.couplings:
            # Shear lifts the surfaces now or later, as that of bodies which are equal at the first
            # instant only.
            if isinstance(coupling, StickSlipCoupling):
                assert self.shear is not None
                coupling = coupling.lifting(coupled=any(each.coupled for each in self.shear.operators))
            elif isinstance(coupling, SlidingCoupling):
                assert self.shear is not None
                largest = max(each.coupling.largest for each in self.shear.operators)
                coupling = replace(coupling, feedback=largest > NO_COUPLING * operator.largest)
            lifting.append(coupling)
        prepared.couplings = (*lifting, CreepCoupling())

    @property
    def area(self) -> float:
        """Nominal area, m²."""
        return self.prepared.problem.grid.area

    def step(self, step: Step, state: InterfaceState | None) -> ContactResult:
        """Result at the end of ``step``, started from ``state``."""
        started, prepared = time.perf_counter(), self.prepared
        begin = self.begin(state)
        moments, tries = marched(begin, step, prepared.time_steps, self)
        if not moments:
            raise ConvergenceError(
                f"None of {tries} tries was within the tolerance {prepared.time_steps.tolerance:g} of the "
                "steps of time. Allow more of them, or a larger tolerance."
            )
        last, before = moments[-1], state if len(moments) < 2 else moments[-2].state
        settled, end = last.settled, begin.past.time + step.duration
        assert settled is not None
        status = settled.status
        if status.converged and last.past.time < end * (1.0 - 1e-9):
            message = f"{tries} steps of time led to {last.past.time:.6g} s of the {end:.6g} s at the end of the step."
            remedy = "Allow more steps of time, or a larger tolerance of theirs."
            status = Status(Outcome.ITERATION_LIMIT, message, remedy)
        records = np.stack([begin.record, *(moment.record for moment in moments)])
        happened = Creeping(
            records,
            np.broadcast_to(last.retarded, last.past.pressure.shape),
            last.stored,
            last.past.dissipated - begin.past.dissipated,
            force_work(records)[0],
            tries,
            sum(moment.shear_works[0] for moment in moments),
            sum(moment.shear_works[1] for moment in moments),
            sum(moment.lift_work for moment in moments),
        )
        creeping, account = accounted(begin, moments, happened)
        settled = replace(settled, status=balanced(status, creeping))
        ends = dict(last.ends)
        for name, (memory, found) in ends.items():
            if isinstance(found, Answer) and len(moments) > 1:  # slip, heat and jumps are those of all moments
                earlier = [one for one in (moment.ends[name][1] for moment in moments[:-1]) if isinstance(one, Answer)]
                ends[name] = memory, found.summed(earlier)
        ends["creep"] = replace(last.past, account=account.numbers).memory, creeping
        result = prepared.result(settled, before, time.perf_counter() - started, ends)
        if before is not state:  # the work since the step began, not since the last moment
            vars(result)["plastic_work"] = result.total_plastic_work - (0.0 if state is None else state.plastic_work)
        return result

    def _lift_work(
        self, before: Moment, later: RealArray, ends: Mapping[str, tuple[Memory, object]], length: float
    ) -> float:
        """Work (J) of the displacement by the shear of gross sliding in the step of time from
        ``before``, exact for a pressure linear in time."""
        coupling = next((each for each in self.prepared.couplings if isinstance(each, SlidingCoupling)), None)
        if coupling is None or not coupling.feedback or "sliding" not in ends:
            return 0.0
        found = ends["sliding"][1]
        assert self.shear is not None
        assert isinstance(found, GrossSliding)
        at_once = TimeWeights.of(self.remembering.times, 0.0)
        kernel = coupling.in_time(self.shear.operator(at_once).coupling, np.zeros(later.shape))
        pressure = _pressure_before(before)
        first, last = coupling.traction(pressure), coupling.traction(later)
        lift = kernel.displacement(pressure) + self.shear.lifted(before.past, first, at_once)
        # mean over the step of the retarded displacement, to which that of the pressure at the time
        # adds
        weights, after = TimeWeights.of(self.remembering.times, length).of_mean
        none = replace(before.past, shear=None)
        by_last = replace(weights, e=np.zeros_like(after), before=after)
        mean = self.shear.lifted(before.past, first, weights) + self.shear.lifted(none, last, by_last)
        mean += kernel.displacement(0.5 * (pressure + later))
        now = found.shear_displacement
        total = float((pressure * (now - lift) + (later - pressure) * (now - mean)).sum())
        return total * self.prepared.problem.grid.pixel_area

    def begin(self, state: InterfaceState | None) -> Moment:
        """What the interface is before a step, from its ``state``."""
        past = self.remembering.past({} if state is None else state.memory.get("creep", {}))
        if state is not None and "stick_slip" not in state.memory and self.sticks:
            past = replace(past, shear=None)  # of gross sliding, which leaves no traction to stick to
        profile = self.prepared.profile
        if np.isnan(past.place[2]):  # the first touch
            dented = profile if state is None else profile - state.permanent_indentation
            touch = float(profile.max() - dented.max()), float(dented.max() - dented.mean())
            past = replace(past, place=(0.0, *touch), account=Account.begun(0.0).numbers)
        force = float(past.pressure.sum()) * self.prepared.problem.grid.pixel_area
        fraction = np.count_nonzero(past.pressure > 0.0) / profile.size
        largest = float(past.pressure.max())
        mean, held, gap = past.place
        memories = {} if state is None else state.memory
        approach = float(next((known["approach"] for known in memories.values() if "approach" in known), held))
        account = Account.of(past)
        stored = np.nan if account is None else account.stored
        record = np.array([past.time, mean, force, approach, gap, fraction, largest, stored, past.dissipated, 0.0])
        if state is not None:
            state = replace(state, earlier=None)  # of a moment within the step before, which is not kept
        return Moment(None, past, state, record, stored=stored)

    def advanced(self, moment: Moment, control: Control | Step, length: float) -> Moment:
        """Contact under ``control`` a step of time of this ``length`` (s) after ``moment``."""
        prepared, problem = self.prepared, self.prepared.problem
        weights = TimeWeights.of(self.remembering.times, length)
        retarded = self.remembering.lift(moment.past, weights)
        operator = self.operators.at(weights.after, self.remembering.summed(weights))
        ahead = length / moment.length if moment.length else None
        couplings, step = self._couplings(operator, moment, weights), as_step(control)
        settled = self._apart(step, moment.state, operator, retarded, couplings) or prepared.settled(
            step, moment.state, operator, retarded, ahead, couplings
        )
        contact = settled.contact
        ends = {c.name: c.end(settled.exchanges[c.name], contact) for c in couplings if c.name in settled.exchanges}
        answers = [found for _, found in ends.values() if isinstance(found, Answer)]
        area, beside = problem.grid.area, [answer for answer in answers if answer.traction_beside() is not None]
        external = outside(answers, contact.force)
        external = external if beside else max(external, 0.0)
        approach, gap = contact.posed.top + contact.level, float(contact.gap.mean())
        traction, deflection = contact.traction, contact.solution.state.deflection
        for attraction in (answer.traction_beside() for answer in beside):
            assert attraction is not None
            deflection = deflection - operator.apply(attraction)
        held = next((at for at in (answer.held_at() for answer in answers) if at is not None), approach)
        place = (external / area, held, gap)
        past, stored = self.remembering.after(moment.past, weights, traction, deflection, place)
        heat = past.dissipated - moment.past.dissipated
        for coupling in couplings:
            name = coupling.name
            if name in ends:
                ends[name] = coupling.end_in_time(settled.exchanges[name], contact, ends[name], stored, heat)
        lift_work = self._lift_work(moment, contact.pressure, ends, length)
        for slides in prepared.couplings:  # the memory of the shear of gross sliding
            if isinstance(slides, SlidingCoupling) and slides.feedback:
                assert self.shear is not None
                tractions = slides.traction(_pressure_before(moment)), slides.traction(contact.pressure)
                past = replace(past, shear=self.shear.advanced(moment.past, *tractions, weights))
        past, sheared, works = self._sheared(moment, past, traction, weights, ends, couplings)
        stored += sheared
        memories = {name: memory for name, (memory, _) in ends.items() if memory}
        earlier = moment.state.pressure if moment.state is not None and moment.state.pressure.any() else None
        state = InterfaceState(contact.pressure, {**memories, "creep": past.memory}, earlier)
        capped = contact.touching & (contact.pressure >= contact.cap)
        edges = edges_in(problem, contact.pressure, contact.gap, capped)
        fraction = real_area(contact.pressure, capped, edges, problem.boundary.wraps).total / area
        force = contact.force if not beside else outside(beside, contact.force)
        top = contact.pressure.max()
        numbers = (past.time, place[0], force, approach, gap, fraction, top, stored, past.dissipated, 0.0)
        return Moment(settled, past, state, np.array(numbers), retarded, stored, length, ends, works, lift_work)

    def _sheared(
        self,
        moment: Moment,
        past: Past,
        pressure: RealArray,
        weights: TimeWeights,
        ends: dict[str, tuple[Memory, object]],
        couplings: tuple[Coupling, ...],
    ) -> tuple[Past, float, tuple[float, float]]:
        """``past`` after a step with the memory and heat of shear, the energy (J) that it stores,
        which is noted in ``ends``, and its works (J): of tangential force and torque, and what of
        it an implicit step takes."""
        coupling = next((each for each in couplings if isinstance(each, StickSlipCoupling)), None)
        if self.shear is None or coupling is None:
            return past, 0.0, (0.0, 0.0)
        memory, found = ends["stick_slip"]
        assert isinstance(found, StickSlip)
        before = _traction_before(moment.state, pressure.shape)
        shear, more, heat = self.shear.after(moment.past, before, found.traction, pressure, weights)
        ends["stick_slip"] = memory, replace(found, tangential_energy=more)
        started = {} if moment.state is None else moment.state.memory.get("stick_slip", {})
        place = started["shift"] if started else np.zeros(3)
        moved = np.array([found.shift_x, found.shift_y, found.twist]) - place
        assert coupling.held is not None
        displaced, pixel = found.tangential_displacement - coupling.held.start, self.prepared.problem.grid.pixel_area
        taken = 0.5 * pixel * float(np.einsum("kij,kij->", found.traction - before, displaced))
        works = found.work_by(moved, displaced, pixel), taken
        return replace(past, shear=shear, dissipated=past.dissipated + heat), more, works

    def _couplings(self, operator: Operator, moment: Moment, weights: TimeWeights) -> tuple[Coupling, ...]:
        """Couplings of the problem with the ``operator`` of the step, and shear with what the past
        of the ``moment`` left."""
        found: list[Coupling] = []
        past = moment.past
        for coupling in self.prepared.couplings:
            if isinstance(coupling, SlidingCoupling) and coupling.feedback:
                assert self.shear is not None
                lifted = self.shear.lifted(past, coupling.traction(_pressure_before(moment)), weights)
                found.append(coupling.in_time(self.shear.operator(weights).coupling, lifted))
            elif isinstance(coupling, StickSlipCoupling):
                assert self.shear is not None
                held = self.shear.held(past, _traction_before(moment.state, past.pressure.shape), weights)
                found.append(replace(coupling, operator=self.shear.operator(weights), held=held))
            else:
                found.append(coupling.at(operator))
        return tuple(found)

    def _apart(
        self,
        step: Step,
        state: InterfaceState | None,
        operator: Operator,
        retarded: RealArray,
        couplings: tuple[Coupling, ...],
    ) -> Settled | None:
        """The surfaces without contact, where they lie apart at the prescribed position; None
        elsewhere."""
        prepared, control = self.prepared, step.normal
        if (
            not isinstance(control, Approach | MeanGap)
            or not retarded.any()
            or any(item.bears_pull for item in prepared.problem.physics)
        ):
            return None
        dented = prepared.profile - retarded
        if state is not None:
            dented = dented - state.permanent_indentation
        top = float(prepared.profile.max())
        offset = top - control.value if isinstance(control, Approach) else control.value + float(dented.mean())
        if float(dented.max()) > offset:
            return None
        none, scale = np.zeros_like(dented), height_scale(prepared.profile, control, prepared.operator)
        posed = Posed(operator, prepared.profile, dented, control, scale, tangential=step.tangential, retarded=retarded)
        qp = ContactQP(operator, dented, np.inf, FixedOffset(offset), scale)
        status = Status(Outcome.CONVERGED, "The surfaces lie apart: nothing to solve.")
        contact = Contact(posed, qp, Solution(SolverState(none, none, 0.0), status, (0.0,)))
        memories = {} if state is None else state.memory
        exchanges = {c.name: c.begin(posed, memories.get(c.name, {})) for c in couplings}
        exchanges = {c.name: c.apart(exchanges[c.name], contact) for c in couplings}
        return Settled(contact, exchanges, (), 1, prepared.solver.tolerance, status)

    def error(self, first: Moment, second: Moment, third: Moment) -> float:
        """Error that the last of two steps of time adds to the displacement, relative to it, or one
        of them to the energy where that is more.

        Of the energy only of steps longer than a retardation: shorter ones follow it, and what
        jumps is not divided without end.
        """
        weights, pasts = (
            TimeWeights.of(self.remembering.times, third.past.time - second.past.time),
            (first.past, second.past, third.past),
        )
        found = self.remembering.curvature(pasts, weights)
        if weights.length > float(self.remembering.times.min()):
            found = max(found, step_error(first, second), step_error(second, third))
        if self.shear is None or not self.sticks:
            return found
        shape = third.past.pressure.shape
        tractions = tuple(_traction_before(moment.state, shape) for moment in (first, second, third))
        return max(found, self.shear.curvature(pasts, tractions, weights))


def _pressure_before(moment: Moment) -> RealArray:
    """Pressure (nx, ny) in Pa of the contact at a ``moment``, without what adhesion pulls; a first
    guess alone is none."""
    state = moment.state
    return moment.past.pressure if state is None or "creep" not in state.memory else state.pressure


def _traction_before(state: InterfaceState | None, shape: tuple[int, ...]) -> RealArray:
    """Shear traction (2, nx, ny) in Pa that a ``state`` remembers; zero where it does not."""
    memory = {} if state is None else state.memory.get("stick_slip", {})
    return np.stack([memory["traction_x"], memory["traction_y"]]) if memory else np.zeros((2, *shape))
