"""The one function in which problem, control or history, solver and what to keep meet."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from copy import copy
from dataclasses import dataclass, replace
from itertools import pairwise
from threading import Event
from typing import Any, Literal, Protocol, TypedDict, Unpack, overload

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.engine import CpuEngine, Engine
from ..core.errors import ConvergenceError, InputError, NoSolutionError
from ..core.registry import PAIRS, home, role
from ..core.status import Outcome, Progress, Status
from ..solids.layers import relaxes
from .answer import Answer
from .certificate import LARGEST_DUALITY_GAP, LARGEST_IMBALANCE, Certificate, certify, imbalance
from .controls import (
    Approach,
    Control,
    FixedGrips,
    Force,
    MeanGap,
    MeanPressure,
    Pull,
    Step,
    Unloaded,
    mean_pressure,
)
from .couplings.driver import Rounds, Settled, settle
from .couplings.held import settle_position
from .couplings.protocol import Coupling, Memory, Posed, height_scale
from .history import History, HistoryResult
from .law import ConstantHardness, HardWall, LimitByDepth
from .operators import Operator, prepare_operator
from .problem import ContactProblem, Preparing, require_borne
from .result import ContactResult, added, assemble
from .solvers.active_set.solver import ActiveSet
from .solvers.protocol import Iterative, Solver
from .state import InterfaceState
from .time_division import TimeSteps


@dataclass(frozen=True)
class Keep:
    """What a result gives beyond its fields: the ``stiffness``, which costs about half a further
    solve when it is first read."""

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

    Normal contact, hardness, menisci and sliding friction are balanced together, whatever the
    problem holds. Where a physics gives back more the more it gets (menisci, softening films), the
    balance found is the first that a growing load meets from the interface it started with; others
    may exist.

    Parameters
    ----------
    problem
        Surfaces, bodies, boundary, physics of the interface.
    control
        ``MeanPressure``, ``Force``, ``Approach``, ``MeanGap`` or ``Unloaded``, with adhesion also
        ``Pull`` or ``FixedGrips``; a ``Step`` with one of these and a ``Shift`` or
        ``TangentialForce``, under which the surfaces stick and slip; or a ``History`` of such
        steps, each of which starts from the interface the last one left, so that it takes a
        fraction of the work of a solve on its own. All results of a history are held in memory; see
        ``steps`` for one of which only a few numbers are wanted. Sixteen loads and more of an
        elastic contact are solved in two to four chains, as many at a time as there are threads.
    solver
        Method of the normal solves with its tolerance; chosen by ``default_solver`` if not given.
    state
        State of an earlier result: its memory is kept, its pressure is the first guess.
    keep
        What the result gives beyond its fields; by default the stiffness of a single load, computed
        when it is first read.
    operator
        Prepared operator (``prepare_operator``) of the same problem, to spare the set-up in
        repeated solves.
    progress
        Receives the error after every iteration; the steps of a history then follow one another.
    engine
        Machine to compute on, such as ``CpuEngine(threads=2)``; the CPU with ASPERITY_THREADS or
        all cores by default.
    rounds
        When to give up the iteration between contact and couplings.
    time_steps
        How durations of steps are divided for viscoelastic bodies, see ``TimeSteps``.
    on_failure
        ``"raise"`` a ConvergenceError holding the result (of the first step that fails), or
        ``"return"`` it with its status, when not converged; a history then goes on from the last
        step that did converge.

    Raises
    ------
    NoSolutionError
        If a load exceeds what the pressure cap bears or menisci run away, or a position has no
        solution.
    ConvergenceError
        If the tolerance is not reached and ``on_failure`` is ``"raise"``.
    InputError
        If the control is none, state or operator do not belong to the problem, or a keyword is none
        of these.
    """
    if not isinstance(problem, ContactProblem):
        raise InputError(
            f"problem must be a ContactProblem, but is a {type(problem).__name__}. Write "
            'ContactProblem(surface, body), such as ContactProblem(surface, material("steel")).'
        )
    for name in options:
        require.one_of(name, _Options.__annotations__, "keyword of solve")
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    if isinstance(control, History):
        return HistoryResult(_all_results(problem, control, on_failure, **options), options.get("state"))
    if not isinstance(control, Control | Step):
        kinds = "MeanPressure, Force, Approach, MeanGap, Unloaded, Pull, FixedGrips, a Step or a History of them"
        raise InputError(f"control must be a {kinds}, but is {control!r}. Write for example MeanPressure(50e3).")
    state = options.pop("state", None)
    keep = options.pop("keep", None) or Keep()
    step = control if isinstance(control, Step) else Step(control)
    result = Prepared(problem, keep=keep, sticks=sticks(problem, [step], state), **options).step(step, state)
    if on_failure == "raise" and not result.status.converged:
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
    """Results of the steps of ``history`` one by one, each when it is solved; only the last is held
    here.

    Arguments and errors are those of ``solve``; what is wrong with them is raised at the call,
    before any step.
    """
    for name in options:
        require.one_of(name, _Options.__annotations__, "keyword of solve")
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    ordered = history if isinstance(history, History) else History(history)
    prepared = Prepared(problem, keep=keep or Keep(stiffness=False), sticks=sticks(problem, ordered, state), **options)
    return _results(prepared, enumerate(ordered, start=1), state, on_failure)


def _results(
    prepared: Prepared, numbered: Iterable[tuple[int, Step]], state: InterfaceState | None, on_failure: str
) -> Iterator[ContactResult]:
    """Results of ``numbered`` steps one after the other, from ``state`` on."""
    for number, step in numbered:
        where = f"Step {number} of the history"
        try:
            result = prepared.step(step, state)
        except NoSolutionError as error:
            raise NoSolutionError(f"{where}: {error}", subject=f"{where}: {error.subject}") from error
        if result.converged:
            state = result.state
        elif on_failure == "raise":
            status = result.status
            raise ConvergenceError(f"{where}: {status.message} {status.remedy}", result, subject=where)
        yield result


_CHAIN, _MOST_CHAINS = 8, 4
"""Least number of loads in a chain, and most chains. The first load of a chain takes 8 FFT pairs at
512², each of the others 6: two chains of ten loads take 2 % more than one of twenty. Their number
does not depend on that of the threads, nor do the results."""


def _all_results(
    problem: ContactProblem,
    history: History,
    on_failure: str,
    state: InterfaceState | None = None,
    keep: Keep | None = None,
    **options: Any,
) -> tuple[ContactResult, ...]:
    """Results of all steps of ``history``; loads of a contact that remembers nothing in chains,
    each on a thread of its own.

    A chain begins from coarser grids, as a single load does. If one fails the others end with the
    step at which they are.
    """
    keep = keep or Keep(stiffness=False)
    prepared = Prepared(problem, keep=keep, sticks=sticks(problem, history, state), **options)
    numbered, engine = list(enumerate(history, start=1)), prepared.operator.engine
    chains = min(_MOST_CHAINS, len(numbered) // _CHAIN)
    alone = state is None and prepared.progress is None and isinstance(prepared.solver, ActiveSet)
    pressed = all(isinstance(step.normal, MeanPressure | Force) for step in history)
    # each step depends on its own load alone: elastic contact without other physics
    elastic = isinstance(problem.law, HardWall) and len(prepared.couplings) == 1 and prepared.in_time is None
    if chains < 2 or not (alone and pressed and elastic and isinstance(engine, CpuEngine)):
        return tuple(_results(prepared, numbered, state, on_failure))
    ended, threads = Event(), max(1, engine.threads // chains)

    def chain(part: list[tuple[int, Step]]) -> list[ContactResult]:
        own, found = Prepared(problem, keep=keep, **{**options, "operator": None, "engine": CpuEngine(threads)}), []
        for result in _results(own, part, None, on_failure):
            found.append(result)
            if ended.is_set():
                break
        return found

    cuts = [len(numbered) * i // chains for i in range(chains + 1)]
    with ThreadPoolExecutor(min(chains, engine.threads)) as pool:
        jobs = [pool.submit(copy_context().run, chain, numbered[start:end]) for start, end in pairwise(cuts)]
        try:
            return tuple(result for job in jobs for result in job.result())
        finally:
            ended.set()
            for job in jobs:
                job.cancel()


class InTime(Protocol):
    """What takes over the steps of bodies that relax."""

    def step(self, step: Step, state: InterfaceState | None) -> ContactResult:
        """Result at the end of ``step``, started from ``state``."""


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
        # one of another grid, solid or boundary would give a wrong answer without an error
        for what in ("grid", "compliance", "boundary"):
            prepared_for, wanted = getattr(self.operator, what), getattr(problem, what)
            if prepared_for != wanted:
                raise InputError(
                    f"operator must be prepared for the {what} {wanted} of the problem, but is for {prepared_for}."
                )
        self.couplings = couplings_of(problem, self.operator, rounds, sticks=sticks)
        self.profile, self.time_steps = problem.profile(), time_steps
        self._measured: tuple[RealArray, float] | None = None
        relaxing = relaxes(problem.body) or relaxes(problem.counter_body)
        self.in_time: InTime | None = role("in_time")(self) if relaxing else None

    def loosened(self, factor: float) -> Prepared:
        """The same to a tolerance ``factor`` times as large, for a contact that only leads to
        another."""
        if not isinstance(self.solver, Iterative):
            return self
        looser = copy(self)
        looser.solver = replace(self.solver, tolerance=min(factor * self.solver.tolerance, 0.1))
        return looser

    def settled(
        self,
        step: Step,
        state: InterfaceState | None = None,
        operator: Operator | None = None,
        retarded: RealArray | None = None,
        ahead: float | None = None,
        couplings: tuple[Coupling, ...] | None = None,
    ) -> Settled:
        """Contact under ``step`` that agrees with all couplings, started from ``state``; its
        duration does not matter.

        A step of time gives its own ``operator`` and ``couplings``, and the displacement that the
        past leaves at its end; ``ahead`` as of ``Posed``.
        """
        control, dented, start = step.normal, self.profile, None
        if state is not None:
            state.require_shape(self.profile.shape)
            if state.is_dented:
                dented = self.profile - state.permanent_indentation
            start = state.pressure if state.pressure.any() else None
        require_borne(self.problem, control)
        if isinstance(control, Approach | MeanGap):
            require.magnitude(control.value, f"{control.name} (m)")
        elif not isinstance(control, Unloaded | Pull | FixedGrips):
            require.magnitude(mean_pressure(control, self.problem.grid), "mean pressure (Pa)")
        if self._measured is None or self._measured[0] is not self.profile:  # once for the steps of a surface at rest
            self._measured = self.profile, float(self.operator.engine.resident(self.profile).std())
        scale = self._measured[1] or height_scale(self.profile, control, self.operator)
        earlier = None if state is None else state.earlier
        lift: RealArray | float = 0.0
        if retarded is not None:
            dented, lift = dented - retarded, retarded
        known = None if state is None else state.deflections
        tangential = step.tangential
        posed = Posed(
            operator or self.operator,
            self.profile,
            dented,
            control,
            scale,
            start,
            earlier,
            tangential,
            lift,
            known,
            ahead,
        )
        memories = {} if state is None else state.memory
        joined = self.couplings if couplings is None else couplings
        return settled_with(joined, posed, memories, self.solver, rounds=self.rounds, progress=self.progress)

    def step(self, step: Step, state: InterfaceState | None = None) -> ContactResult:
        """Result of ``step``, started from ``state``."""
        started = time.perf_counter()
        if self.in_time is not None:
            return self.in_time.step(step, state)

        def solved(control: Control, at: InterfaceState | None) -> ContactResult:
            return self.result(self.settled(Step(control, step.tangential), at), at, time.perf_counter() - started)

        require_borne(self.problem, step.normal)
        way: Callable[[Control, InterfaceState | None], ContactResult] = solved
        for physics in self.problem.physics:
            way = physics.followed(self.problem, step, way)
        return way(step.normal, state)

    def result(
        self,
        settled: Settled,
        state: InterfaceState | None,
        seconds: float,
        ends: Mapping[str, tuple[Memory, object]] | None = None,
    ) -> ContactResult:
        """Result of what ``settled`` in so many ``seconds``, started from ``state``; ``ends`` of
        all couplings where they are known."""
        if ends is None:
            ends = {c.name: c.end(settled.exchanges[c.name], settled.contact) for c in self.couplings}
        found: dict[str, Any] = {name: outcome for name, (_, outcome) in ends.items()}
        lift = added(each.lifted() for each in found.values() if isinstance(each, Answer))
        return finished(
            self.problem,
            settled,
            ends,
            self.solver,
            before=state,
            lift=lift,
            seconds=seconds,
            stiffness=self.keep.stiffness,
        )


def settled_with(
    couplings: tuple[Coupling, ...], posed: Posed, memories: Mapping[str, Memory], solver: Solver, **options: Any
) -> Settled:
    """Contact that agrees with all ``couplings``; where two of them carry a force together, in the
    way that the registry names for the pair.

    Arguments and errors are those of ``settle``.
    """
    names = {coupling.name for coupling in couplings}
    together = [place for pair, place in PAIRS.items() if pair <= names]
    way = plain = settle_position if isinstance(posed.control, Approach | MeanGap) else settle
    if together:  # and the force has to come out right: a prescribed one, or that of a machine that gives way
        gives = isinstance(posed.control, FixedGrips) and math.isfinite(posed.control.stiffness)
        way = home(together[0]) if gives or posed.external_force is not None else plain
    settled: Settled = way(posed, couplings, memories, solver, **options)
    return settled


def finished(
    problem: ContactProblem,
    settled: Settled,
    ends: Mapping[str, tuple[Memory, object]],
    solver: Solver,
    *,
    before: InterfaceState | None,
    lift: RealArray | None,
    seconds: float,
    stiffness: bool = False,
) -> ContactResult:
    """Result of what ``settled`` by ``solver`` in so many ``seconds`` from the interface
    ``before``, and of the ``ends`` of all couplings.

    ``lift`` (nx, ny) in m is the elastic displacement that is neither by pressure nor by
    attraction.
    """
    contact = settled.contact
    found: dict[str, Any] = {name: outcome for name, (_, outcome) in ends.items() if outcome is not None}
    answers = [outcome for outcome in found.values() if isinstance(outcome, Answer)]
    attraction = added(answer.traction_beside() for answer in answers)
    if attraction is not None:
        lift = (0.0 if lift is None else lift) - contact.posed.operator.apply(attraction)
    certificate = certify(
        contact.qp,
        contact.solution,
        contact.totals,
        solver=solver.name,
        tolerance=settled.tolerance,
        wall_time=seconds,
    )
    certificate = replace(certificate, couplings=settled.checks, rounds=settled.rounds)
    if any(answer.pulls() for answer in answers):
        pulled = sum(answer.pulls() for answer in answers)
        certificate = replace(certificate, load_imbalance=imbalance(contact, pulled))
    for answer in answers:
        certificate = answer.certified(certificate)
    status = doubted(settled.status, certificate)
    for ended in (answer.ended() for answer in answers):
        if status.converged and ended is not None and not ended.converged:
            status = ended
    papers = (key for outcome in found.values() for key in getattr(outcome, "citation_keys", ()))
    return assemble(
        problem,
        contact.ended(status),
        before=before,
        memories={name: memory for name, (memory, _) in ends.items()},
        lift=lift if lift is not None and lift.any() else None,
        attraction=attraction,
        stiffness=stiffness,
        certificate=certificate,
        outcomes=found,
        citations=tuple(sorted({*problem.citation_keys, *solver.citation_keys, *papers})),
    )


def sticks(problem: ContactProblem, ordered: Iterable[Step], state: InterfaceState | None) -> bool:
    """Whether surfaces stick and slip: where a step prescribes it, the interface remembers it, or
    the law knows no gross sliding.

    InputError if a step is tangential and the problem has no friction.
    """
    tangential = any(step.tangential is not None for step in ordered)
    if any(physics.sticks(state, tangential=tangential) for physics in problem.physics):
        return True
    if tangential:
        raise InputError(
            "friction of a problem under a Shift or TangentialForce must be given, but is None. "
            "Write ContactProblem(..., friction=Coulomb(0.3))."
        )
    return False


def default_solver(problem: ContactProblem, *, sticks: bool = False) -> Solver:
    """Method for ``problem``: the inexact active set, which handles every boundary, control, cap
    and size, as tight as its physics need."""
    wanted = (physics.normal_tolerance(sticks=sticks) for physics in problem.physics)
    tolerance = min((each for each in wanted if each is not None), default=None)
    return _USUAL if tolerance is None else ActiveSet(tolerance=tolerance)


_USUAL = ActiveSet()


def couplings_of(
    problem: ContactProblem, operator: Operator, rounds: Rounds = Rounds(), *, sticks: bool = False
) -> tuple[Coupling, ...]:
    """Couplings of the physics that ``problem`` holds, prepared for ``operator``; friction with
    stick and slip if it ``sticks``."""
    law, tolerances = problem.law, rounds.tolerances
    first: Coupling = ConstantHardness(law)
    if isinstance(law, LimitByDepth) and np.ndim(law.cap_at(np.zeros(problem.grid.shape))):
        first = role("limit_by_depth").prepared(law, operator, tolerances.get("hardness"))
    how = Preparing(tolerances, sticks, getattr(operator.engine, "threads", None))
    return (first, *(found for item in problem.physics for found in item.couplings(problem, operator, how)))


_GAPS = 1e3
"""Largest duality gap over the tolerance, where that is loose: it bounds the gap to 30 times itself
(``solvers.protocol.scaled_error``)."""


def doubted(status: Status, certificate: Certificate) -> Status:
    """``status``, or why a contact that the solver holds for converged is not."""
    if status.converged and certificate.load_imbalance > LARGEST_IMBALANCE:
        message = f"Not converged: the forces miss their balance by {certificate.load_imbalance:.1e} of their sum."
        return Status(Outcome.STAGNATED, message, "Prescribe the position, with {approach} or {mean_gap}.")
    if not status.converged or certificate.duality_gap <= max(LARGEST_DUALITY_GAP, _GAPS * certificate.tolerance):
        return status
    message = f"Not converged: the energy is off by up to {certificate.duality_gap:.1e} of itself (duality gap)."
    return Status(Outcome.STAGNATED, message, "Use a smaller tolerance, and numbers that are not extreme.")
