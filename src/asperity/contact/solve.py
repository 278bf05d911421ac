"""The one function in which problem, control or history, solver and what to keep meet."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal, TypedDict, Unpack, overload

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.engine import Engine
from ..core.errors import ConvergenceError, InputError, NoSolutionError
from ..core.status import Outcome, Progress, Status
from ..solids.compliance.creep import AnyCreep, SharedCreep, contact_creep
from ..solids.layers import deformable, materials_of
from ..solids.viscoelastic import alike
from . import measure
from .couplings.adhesion import TOLERANCE as ADHESION_TOLERANCE
from .couplings.adhesion import AdhesionCoupling, AdhesiveContact, in_time, require_adhesion
from .couplings.creep import CreepCoupling, Past, Remembering, SharedPast, TimeWeights, remembering
from .couplings.driver import Rounds, Settled, settle
from .couplings.hardness import TOLERANCE as HARDNESS_TOLERANCE
from .couplings.hardness import ConstantHardness, DepthHardness
from .couplings.menisci import TOLERANCE as MENISCUS_TOLERANCE
from .couplings.menisci import MeniscusCoupling
from .couplings.plastic_flow import PlasticFlowCoupling
from .couplings.protocol import Contact, Coupling, Memory, Posed
from .couplings.sliding import TOLERANCE as SLIDING_TOLERANCE
from .couplings.sliding import SlidingCoupling
from .couplings.stick_slip import TOLERANCE as STICK_SLIP_TOLERANCE
from .couplings.stick_slip import StickSlipCoupling
from .history import History, HistoryResult
from .laws import Coulomb, JKRAdhesion, LimitByDepth
from .operators import Operator, prepare_operator
from .operators.creep import OperatorsInTime
from .problem import (
    Approach,
    ContactProblem,
    Control,
    FixedGrips,
    MeanGap,
    Pull,
    Step,
    Unloaded,
    as_step,
    mean_pressure,
)
from .result import LARGEST_DUALITY_GAP, Certificate, ContactResult, assemble, certify
from .solvers.active_set.solver import ActiveSet
from .solvers.protocol import ContactQP, FixedOffset, Solution, Solver, SolverState
from .state import InterfaceState
from .time_steps import Creeping, Moment, TimeSteps, marched


@dataclass(frozen=True)
class Keep:
    """What a result gives beyond its fields: the ``stiffness``, which costs about half a further solve when it is first read."""

    stiffness: bool = True


class _Options(TypedDict, total=False):
    """Keywords of ``solve``."""

    solver: Solver | None
    state: InterfaceState | None
    keep: Keep | None
    operator: Operator | None
    progress: Progress | None
    engine: Engine | None
    rounds: Rounds
    time_steps: TimeSteps
    on_failure: Literal["raise", "return"]


@overload
def solve(problem: ContactProblem, control: Control | Step, **options: Unpack[_Options]) -> ContactResult: ...


@overload
def solve(problem: ContactProblem, control: History, **options: Unpack[_Options]) -> HistoryResult: ...


def solve(
    problem: ContactProblem,
    control: Control | Step | History,
    *,
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> ContactResult | HistoryResult:
    """Solve a contact problem for one load or position, or for a history of them.

    Normal contact, hardness, menisci and sliding friction are balanced together, whatever the problem holds. Where a
    physics gives back more the more it gets (menisci, softening films), the balance found is the first that a growing
    load meets from the interface it started with; others may exist.

    Parameters
    ----------
    problem
        Surfaces, bodies, boundary, physics of the interface.
    control
        ``MeanPressure``, ``Force``, ``Approach``, ``MeanGap`` or ``Unloaded``, with adhesion also ``Pull`` or ``FixedGrips``; a ``Step`` with one of these and a ``Shift`` or
        ``TangentialForce``, under which the surfaces stick and slip; or a ``History`` of such steps, each of which starts from the interface the last one left, so that it takes a fraction of the work of a solve on its own.
        All results of a history are held in memory; see ``steps`` for one of which only a few numbers are wanted.
    solver
        Method of the normal solves with its tolerance; chosen by ``default_solver`` if not given.
    state
        State of an earlier result: its memory is kept, its pressure is the first guess.
    keep
        What the result gives beyond its fields; by default the stiffness of a single load, computed when it is first read.
    operator
        Prepared operator (``prepare_operator``) of the same problem, to spare the set-up in repeated solves.
    progress
        Receives the error after every iteration.
    engine
        Machine to compute on, such as ``CpuEngine(threads=2)``; the CPU with ASPERITY_THREADS or all cores by default.
    rounds
        When to give up the iteration between contact and couplings.
    time_steps
        How durations of steps are divided for viscoelastic bodies, see ``TimeSteps``.
    on_failure
        ``"raise"`` a ConvergenceError holding the result (of the first step that fails), or ``"return"`` it with its
        status, when not converged; a history then goes on from the last step that did converge.

    Raises
    ------
    NoSolutionError
        If a load exceeds what the pressure cap bears or menisci run away, or a position has no solution.
    ConvergenceError
        If the tolerance is not reached and ``on_failure`` is ``"raise"``.
    InputError
        If the control is none, or state or operator do not belong to the problem.
    """
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    if isinstance(control, History):
        start = options.get("state")
        return HistoryResult(tuple(steps(problem, control, on_failure=on_failure, **options)), start)
    if not isinstance(control, Control | Step):
        kinds = "MeanPressure, Force, Approach, MeanGap, Unloaded, Pull, FixedGrips, a Step or a History of them"
        raise InputError(f"control must be a {kinds}, but is {control!r}. Write for example MeanPressure(50e3).")
    state = options.pop("state", None)
    keep = options.pop("keep", None) or Keep()
    step = as_step(control)
    result = Prepared(problem, keep=keep, sticks=sticks(problem, [step], state), **options).step(step, state)
    if on_failure == "raise" and not result.converged:
        raise ConvergenceError(f"{result.status.message} {result.status.remedy}", result)
    return result


def steps(
    problem: ContactProblem,
    history: History | Iterable[Step | Control],
    *,
    state: InterfaceState | None = None,
    keep: Keep | None = None,
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> Iterator[ContactResult]:
    """Results of the steps of ``history`` one by one, each when it is solved; only the last is held here.

    Arguments and errors are those of ``solve``; what is wrong with them is raised at the call, before any step.
    """
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    ordered = history if isinstance(history, History) else History(history)
    prepared = Prepared(problem, keep=keep or Keep(stiffness=False), sticks=sticks(problem, ordered, state), **options)

    def run() -> Iterator[ContactResult]:
        latest = state
        for number, step in enumerate(ordered, start=1):
            where = f"Step {number} of the history"
            try:
                result = prepared.step(step, latest)
            except NoSolutionError as error:
                raise NoSolutionError(f"{where}: {error}", subject=f"{where}: {error.subject}") from error
            if result.converged:
                latest = result.state
            elif on_failure == "raise":
                status = result.status
                raise ConvergenceError(f"{where}: {status.message} {status.remedy}", result, subject=where)
            yield result

    return run()


class Prepared:
    """A problem with everything prepared once for all its steps."""

    def __init__(
        self,
        problem: ContactProblem,
        *,
        keep: Keep = Keep(),
        solver: Solver | None = None,
        operator: Operator | None = None,
        progress: Progress | None = None,
        engine: Engine | None = None,
        rounds: Rounds = Rounds(),
        time_steps: TimeSteps = TimeSteps(),
        sticks: bool = False,
    ) -> None:
        if solver is not None and not hasattr(solver, "step"):
            raise InputError(
                f"solver must be a method such as ConjugateGradient(), but is {solver!r}. See solver_by_name."
            )
        self.problem, self.keep, self.progress, self.rounds = problem, keep, progress, rounds
        self.solver = solver or default_solver(problem, sticks=sticks)
        self.operator = operator or prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
        _require_same_problem(self.operator, problem)
        self.couplings = couplings_of(problem, self.operator, rounds, sticks=sticks)
        self.profile, self.time_steps = problem.profile(), time_steps
        creep = contact_creep(problem.body, problem.counter_body)
        self.remembering: Remembering | None = None
        if creep is not None:
            _require_followed(self.couplings, creep, problem)
            self.remembering = remembering(creep, self.operator)
            self.operators = OperatorsInTime(creep, self.operator)
            self.couplings = (*self.couplings, CreepCoupling())

    def settled(self, step: Step, state: InterfaceState | None = None) -> Settled:
        """Contact under ``step`` that agrees with all couplings, started from ``state``; its duration does not matter."""
        return self._settled(step, state, self.operator, None)

    def _settled(
        self,
        step: Step,
        state: InterfaceState | None,
        operator: Operator,
        retarded: RealArray | None,
        ahead: float | None = None,
        couplings: tuple[Coupling, ...] | None = None,
    ) -> Settled:
        """The same with the ``operator`` and ``couplings`` of a step of time, and the displacement that the past leaves at its end; ``ahead`` as of ``Posed``."""
        control, dented, start = step.normal, self.profile, None
        if state is not None:
            state.require_shape(self.profile.shape)
            dented = self.profile - state.permanent_indentation
            start = state.pressure if state.pressure.any() else None
        require_adhesion(self.problem, control)
        if isinstance(control, Approach | MeanGap):
            require.magnitude(control.value, f"{control.name} (m)")
        elif not isinstance(control, Unloaded | Pull | FixedGrips):
            require.magnitude(mean_pressure(control, self.problem.grid), "mean pressure (Pa)")
        scale = _height_scale(self.profile, control, self.operator)
        earlier = None if state is None else state.earlier
        lift: RealArray | float = 0.0
        if retarded is not None:
            dented, lift = dented - retarded, retarded
        known = None if state is None else state.deflections
        tangential = step.tangential
        posed = Posed(operator, self.profile, dented, control, scale, start, earlier, tangential, lift, known, ahead)
        memories = {} if state is None else state.memory
        joined = self.couplings if couplings is None else couplings
        return settle(posed, joined, memories, self.solver, rounds=self.rounds, progress=self.progress)

    def step(self, step: Step, state: InterfaceState | None = None) -> ContactResult:
        """Result of ``step``, started from ``state``."""
        started = time.perf_counter()
        if self.remembering is not None:
            return InTime(self, self.remembering).step(step, state)
        settled = self.settled(step, state)
        return self.result(settled, state, time.perf_counter() - started)

    def result(
        self,
        settled: Settled,
        state: InterfaceState | None,
        seconds: float,
        in_time: tuple[Creeping, Moment] | None = None,
    ) -> ContactResult:
        """Result of what ``settled`` in so many ``seconds``, started from ``state``, with what happened in time."""
        contact, problem = settled.contact, self.problem
        ends: dict[str, tuple[Memory, object]]
        if in_time is None:
            ends = {c.name: c.end(settled.exchanges[c.name], contact) for c in self.couplings}
        else:
            ends = {**in_time[1].ends, "creep": (in_time[1].past.memory, in_time[0])}
        found: dict[str, Any] = {name: outcome for name, (_, outcome) in ends.items() if outcome is not None}
        lift = next((found[name].shear_displacement for name in ("sliding", "stick_slip") if name in found), None)
        attraction = found["adhesion"].attraction if "adhesion" in found else None
        if attraction is not None:
            lift = (0.0 if lift is None else lift) - contact.posed.operator.apply(attraction)
        residual = found["stick_slip"].complementarity if "stick_slip" in found else 0.0
        certificate = replace(self._certificate(settled, seconds), complementarity=residual)
        status = doubted(settled.status, certificate)
        for name in ("stick_slip", "adhesion"):
            if status.converged and name in found and not found[name].status.converged:
                status = found[name].status
        shown = replace(contact, solution=replace(contact.solution, status=status))
        papers = (key for outcome in found.values() for key in getattr(outcome, "citation_keys", ()))
        return assemble(
            problem,
            shown,
            before=state,
            memories={name: memory for name, (memory, _) in ends.items()},
            lift=lift if lift is not None and lift.any() else None,
            attraction=attraction,
            stiffness=self.keep.stiffness,
            certificate=certificate,
            outcomes=found,
            citations=tuple(sorted({*problem.citation_keys, *self.solver.citation_keys, *papers})),
        )

    def _certificate(self, settled: Settled, seconds: float) -> Certificate:
        contact, name = settled.contact, self.solver.name
        found = certify(
            contact.qp,
            contact.solution,
            contact.totals,
            solver=name,
            tolerance=settled.tolerance,
            wall_time=seconds,
        )
        return replace(found, couplings=settled.checks, rounds=settled.rounds)


def _require_followed(couplings: tuple[Coupling, ...], creep: AnyCreep, problem: ContactProblem) -> None:
    """Refuse shear whose creep is not followed, of sticking surfaces and of moduli that do not all relax alike, and adhesion without range."""
    if isinstance(problem.adhesion, JKRAdhesion):
        raise InputError(
            "adhesion of viscoelastic bodies must have a range, but is JKRAdhesion (coupling adhesion), whose edge would lose energy at all "
            "wavelengths. Take ExponentialAdhesion(work, range)."
        )
    for coupling in couplings:
        if isinstance(coupling, StickSlipCoupling):
            raise InputError(
                "friction of viscoelastic bodies must be None or Coulomb friction of surfaces that slide everywhere, but here they stick "
                "and slip (coupling stick_slip), and how shear makes them creep is not followed. Leave it out."
            )
        if isinstance(coupling, SlidingCoupling) and coupling.feedback:
            materials = [m for solid, _ in deformable(problem.body, problem.counter_body) for m in materials_of(solid)]
            if not isinstance(creep, SharedCreep) or not alike(tuple(materials)):
                raise InputError(
                    "friction of viscoelastic bodies must be None, or their moduli must all relax alike, but here they do not, and how shear "
                    "makes them creep (coupling sliding) is not followed. Leave it out, or write Coulomb(mu, coupled=False)."
                )


class InTime:
    """Steps of time of a prepared problem with viscoelastic bodies."""

    def __init__(self, prepared: Prepared, remembering: Remembering) -> None:
        self.prepared, self.remembering = prepared, remembering

    @property
    def area(self) -> float:
        """Nominal area, m²."""
        return self.prepared.problem.grid.area

    def step(self, step: Step, state: InterfaceState | None) -> ContactResult:
        """Result at the end of ``step``, started from ``state``."""
        started, prepared = time.perf_counter(), self.prepared
        begin = self.begin(state)
        moments, tries = marched(begin, step.normal, step.duration, prepared.time_steps, self)
        if not moments:
            raise ConvergenceError(
                f"None of {tries} tries was within the tolerance {prepared.time_steps.tolerance:g} of the steps of time. "
                "Allow more of them, or a larger tolerance."
            )
        last, before = moments[-1], state if len(moments) < 2 else moments[-2].state
        settled = self._ended(last, begin.past.time + step.duration, tries)
        creeping = _creeping(begin, moments, tries)
        result = prepared.result(settled, before, time.perf_counter() - started, (creeping, last))
        if before is not state:  # the work since the step began, not since the last moment
            vars(result)["plastic_work"] = result.total_plastic_work - (0.0 if state is None else state.plastic_work)
        return result

    def _ended(self, last: Moment, end: float, tries: int) -> Settled:
        """What settled in the ``last`` moment; not converged if the ``end`` (s) was not reached."""
        settled = last.settled
        assert settled is not None
        if not settled.status.converged or last.past.time >= end * (1.0 - 1e-9):
            return settled
        message = f"{tries} steps of time led to {last.past.time:.6g} s of the {end:.6g} s at the end of the step."
        remedy = "Allow more steps of time, or a larger tolerance of theirs."
        return replace(settled, status=Status(Outcome.ITERATION_LIMIT, message, remedy))

    def begin(self, state: InterfaceState | None) -> Moment:
        """What the interface is before a step, from its ``state``."""
        past = self.remembering.past({} if state is None else state.memory.get("creep", {}))
        profile = self.prepared.profile
        mean, approach, gap = past.place
        if np.isnan(gap):
            past = replace(past, place=(mean, approach, float(profile.max() - profile.mean())))
        force = float(past.pressure.sum()) * self.prepared.problem.grid.pixel_area
        fraction = np.count_nonzero(past.pressure > 0.0) / profile.size
        largest = float(past.pressure.max())
        record = np.array(
            [past.time, *past.place[:1], force, *past.place[1:], fraction, largest, 0.0, past.dissipated, 0.0]
        )
        if state is not None:
            state = replace(state, earlier=None)  # of a moment within the step before, which is not kept
        return Moment(None, past, state, record)

    def advanced(self, moment: Moment, control: Control, length: float) -> Moment:
        """Contact under ``control`` a step of time of this ``length`` (s) after ``moment``."""
        prepared, problem = self.prepared, self.prepared.problem
        weights = TimeWeights.of(self.remembering.times, length)
        retarded = self.remembering.lift(moment.past, weights)
        operator = prepared.operators.at(weights.after, self.remembering.summed(weights))
        ahead = length / moment.length if moment.length else None
        couplings = self._couplings(operator, moment.past, weights)
        settled = self._apart(control, moment.state, operator, retarded) or prepared._settled(
            Step(control), moment.state, operator, retarded, ahead, couplings
        )
        contact = settled.contact
        ends = {c.name: c.end(settled.exchanges[c.name], contact) for c in couplings if c.name in settled.exchanges}
        menisci = next(
            (outcome for outcome in (end[1] for end in ends.values()) if hasattr(outcome, "external_force")), None
        )
        area, wraps = problem.grid.area, problem.boundary.wraps
        external = contact.force if menisci is None else max(float(menisci.external_force), 0.0)
        approach, gap = contact.posed.top + contact.level, float(contact.gap.mean())
        traction, deflection = contact.pressure, contact.solution.state.deflection
        adhesive = ends["adhesion"][1] if "adhesion" in ends else None
        if isinstance(adhesive, AdhesiveContact):
            traction = traction - adhesive.attraction
            deflection = deflection - operator.apply(adhesive.attraction)
            external = adhesive.external_force
        held = adhesive.grips if isinstance(adhesive, AdhesiveContact) else approach
        place = (external / area, held, gap)
        past, stored = self.remembering.after(moment.past, weights, traction, deflection, place)
        if isinstance(adhesive, AdhesiveContact):
            heat = past.dissipated - moment.past.dissipated
            ends["adhesion"] = in_time(settled.exchanges["adhesion"], contact, adhesive, stored, heat)
        memories = {name: memory for name, (memory, _) in ends.items() if memory}
        earlier = moment.state.pressure if moment.state is not None and moment.state.pressure.any() else None
        state = InterfaceState(contact.pressure, {**memories, "creep": past.memory}, earlier)
        fraction = measure.corrected_area(contact.touching, problem.grid, wraps=wraps) / area
        force = external if isinstance(adhesive, AdhesiveContact) else contact.force
        top = contact.pressure.max()
        numbers = (past.time, place[0], force, approach, gap, fraction, top, stored, past.dissipated, 0.0)
        return Moment(settled, past, state, np.array(numbers), retarded, stored, length, ends)

    def _couplings(self, operator: Operator, past: Past, weights: TimeWeights) -> tuple[Coupling, ...]:
        """Couplings of the problem with the ``operator`` of the step, and shear with what the ``past`` left."""
        found: list[Coupling] = []
        for coupling in self.prepared.couplings:
            if isinstance(coupling, AdhesionCoupling):
                found.append(replace(coupling, operator=operator))
            elif isinstance(coupling, SlidingCoupling) and coupling.feedback:
                assert isinstance(self.remembering, SharedPast)
                growth = 1.0 + float(self.remembering.creep.shares @ weights.after)
                found.append(coupling.in_time(growth, self.remembering.held(past, weights)))
            else:
                found.append(coupling)
        return tuple(found)

    def _apart(
        self, control: Control, state: InterfaceState | None, operator: Operator, retarded: RealArray
    ) -> Settled | None:
        """The surfaces without contact, where they lie apart at the prescribed position; None elsewhere."""
        prepared = self.prepared
        if not isinstance(control, Approach | MeanGap) or not retarded.any() or prepared.problem.adhesion is not None:
            return None
        dented = prepared.profile - retarded
        if state is not None:
            dented = dented - state.permanent_indentation
        top = float(prepared.profile.max())
        offset = top - control.value if isinstance(control, Approach) else control.value + float(dented.mean())
        if float(dented.max()) > offset:
            return None
        none, scale = np.zeros_like(dented), _height_scale(prepared.profile, control, prepared.operator)
        posed = Posed(operator, prepared.profile, dented, control, scale, retarded=retarded)
        qp = ContactQP(operator, dented, np.inf, FixedOffset(offset), scale)
        status = Status(Outcome.CONVERGED, "The surfaces lie apart: nothing to solve.")
        contact = Contact(posed, qp, Solution(SolverState(none, none, 0.0), status, (0.0,)))
        memories = {} if state is None else state.memory
        exchanges = {c.name: c.begin(posed, memories.get(c.name, {})) for c in prepared.couplings}
        return Settled(contact, exchanges, (), 1, prepared.solver.tolerance, status)

    def error(self, first: Moment, second: Moment, third: Moment) -> float:
        """Error that the last of two steps of time adds to the displacement, relative to it."""
        weights = TimeWeights.of(self.remembering.times, third.past.time - second.past.time)
        return self.remembering.curvature((first.past, second.past, third.past), weights)


def _creeping(begin: Moment, moments: list[Moment], tries: int) -> Creeping:
    """What happened through the ``moments`` after ``begin``."""
    records, last = np.stack([begin.record, *(moment.record for moment in moments)]), moments[-1]
    force, approach = records[:, 2], records[:, 3]
    return Creeping(
        records,
        np.broadcast_to(last.retarded, last.past.pressure.shape),
        last.stored,
        last.past.dissipated - begin.past.dissipated,
        float((0.5 * (force[1:] + force[:-1]) * np.diff(approach)).sum()),
        tries,
    )


def sticks(problem: ContactProblem, ordered: Iterable[Step], state: InterfaceState | None) -> bool:
    """Whether surfaces stick and slip: where a step prescribes it, the interface remembers it, or the law knows no gross sliding.

    InputError if a step is tangential and the problem has no friction.
    """
    tangential = any(step.tangential is not None for step in ordered)
    if problem.friction is None:
        if tangential:
            raise InputError(
                "friction of a problem under a Shift or TangentialForce must be given, but is None. "
                "Write ContactProblem(..., friction=Coulomb(0.3))."
            )
        return False
    gross = isinstance(problem.friction, Coulomb) and problem.friction.limit == np.inf
    return tangential or not gross or (state is not None and "stick_slip" in state.memory)


def default_solver(problem: ContactProblem, *, sticks: bool = False) -> Solver:
    """Method for ``problem``: the inexact active set, which handles every boundary, control, cap and size.

    Where shear changes the pressure the tolerance is 1e-12, so that the error of the normal solve (which goes with its
    root) does not hide that the displacement by shear has settled to 1e-6. With stick and slip, settled to 1e-5, it is 1e-8.
    """
    friction = problem.friction
    if sticks:
        return ActiveSet(tolerance=1e-8)
    return ActiveSet(tolerance=1e-12) if isinstance(friction, Coulomb) and friction.couples else ActiveSet()


def couplings_of(
    problem: ContactProblem, operator: Operator, rounds: Rounds = Rounds(), *, sticks: bool = False
) -> tuple[Coupling, ...]:
    """Couplings of the physics that ``problem`` holds, prepared for ``operator``; friction with stick and slip if it ``sticks``."""
    law, film, friction, tolerances = problem.law, problem.film, problem.friction, rounds.tolerances
    found: list[Coupling] = []
    if isinstance(law, LimitByDepth) and np.ndim(law.cap_at(np.zeros(problem.grid.shape))):
        found.append(DepthHardness.prepared(law, operator, tolerances.get("hardness", HARDNESS_TOLERANCE)))
    else:
        found.append(ConstantHardness(law))
    if film is not None:
        tolerance = tolerances.get("menisci", MENISCUS_TOLERANCE)
        dry = friction if isinstance(friction, Coulomb) else Coulomb(0.0)
        found.append(MeniscusCoupling(film, problem.boundary.wraps, dry, tolerance))
    if problem.adhesion is not None:
        found.append(AdhesionCoupling.prepared(problem, operator, tolerances.get("adhesion", ADHESION_TOLERANCE)))
    threads = getattr(operator.engine, "threads", None)
    if problem.plastic_flow is not None:
        if sticks:
            raise InputError(
                "friction of a contact with plastic flow must slide everywhere, but a step prescribes a shift or a tangential force. "
                "Leave that out: under Coulomb(mu) all points slide."
            )
        found.append(PlasticFlowCoupling.prepared(problem, tolerances.get("plastic_flow"), threads))
    if sticks:
        tolerance = tolerances.get("stick_slip", STICK_SLIP_TOLERANCE)
        found.append(StickSlipCoupling.prepared(problem, tolerance, threads))
    elif isinstance(friction, Coulomb) and friction.couples:
        tolerance, stiffest = tolerances.get("sliding", SLIDING_TOLERANCE), float(operator.kernel.max())
        found.append(SlidingCoupling.prepared(problem, friction, stiffest, tolerance, threads))
    return tuple(found)


_GAPS = 1e3
"""Largest duality gap over the tolerance, where that is loose: it bounds the gap to 30 times itself (``solvers.protocol.scaled_error``)."""


def doubted(status: Status, certificate: Certificate) -> Status:
    """``status``, or why a contact that the solver holds for converged is not."""
    if not status.converged or certificate.duality_gap <= max(LARGEST_DUALITY_GAP, _GAPS * certificate.tolerance):
        return status
    message = f"Not converged: the energy is off by up to {certificate.duality_gap:.1e} of itself (duality gap)."
    return Status(Outcome.STAGNATED, message, "Use a smaller tolerance, and numbers that are not extreme.")


def _height_scale(virgin: RealArray, control: Control, operator: Operator) -> float:
    """Rms height (m); for flat bodies the length by which they deform, for there is no other."""
    rms = float(virgin.std())
    if rms > 0.0:
        return rms
    if isinstance(control, Approach | MeanGap):
        return control.value
    if isinstance(control, Unloaded | Pull | FixedGrips):
        return 1.0
    uniform = np.full(virgin.shape, mean_pressure(control, operator.grid))
    return float(np.abs(operator.apply(uniform)).max()) or 1.0


def _require_same_problem(operator: Operator, problem: ContactProblem) -> None:
    """An operator of another grid, solid or boundary would give a wrong answer without an error."""
    for what, found, wanted in (
        ("grid", operator.grid, problem.grid),
        ("compliance", operator.compliance, problem.compliance),
        ("boundary", operator.boundary, problem.boundary),
    ):
        if found != wanted:
            raise InputError(f"operator must be prepared for the {what} {wanted} of the problem, but is for {found}.")
