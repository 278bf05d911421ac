"""Contact with a liquid film: the menisci press the surfaces together, which makes more menisci, until both balance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..core import require
from ..core.errors import ConvergenceError, NoSolutionError
from ..core.progress import Progress
from ..core.status import Outcome, Status
from .control import Control, Force, MeanPressure, mean_pressure
from .laws import cap_at
from .operators import Operator, prepare_operator
from .path import predicted
from .problem import ContactProblem
from .result import ContactResult
from .solve import Keep, solve
from .solvers.protocol import Solver
from .state import InterfaceState
from .stiffness import normal_stiffness
from .viscous import viscous_force
from .wet_result import WetContactResult
from .wetting import LiquidFilm, Wetting, wetting

COLLAPSED = 0.5
"""Share of the nominal area up to which an interface that ends flooded was open, and so has collapsed."""

_PIXELS = 2  # that may change sides from one solve to the next by its error alone
_FULL = (
    "Liquid and contact fill nearly all of the interface. Take a thinner film, a rougher surface, stiffer bodies or a liquid of less "
    "surface tension; or prescribe the position, Approach(...) or MeanGap(...)."
)
_REMEDY = "Allow more rounds, or take a thinner film, a rougher surface or a larger load."


@dataclass(frozen=True)
class Friction:
    """Sliding with a liquid: dry ``coefficient`` μ_r >= 0, and the ``speed`` in m/s >= 0 of the viscous part."""

    coefficient: float = 0.0
    speed: float = 0.0

    def __post_init__(self) -> None:
        require.not_negative(self.coefficient, "friction coefficient")
        require.not_negative(self.speed, "sliding speed (m/s)")


@dataclass(frozen=True)
class Steady:
    """When the meniscus force counts as steady.

    ``tolerance`` is its change over the external force, two pixels more or less never matter; ``max_rounds`` the largest
    number of solves.
    """

    tolerance: float = 1e-4
    max_rounds: int = 100

    def __post_init__(self) -> None:
        require.positive(self.tolerance, "tolerance of a wet contact")
        require.integer(self.max_rounds, 1, "number of rounds")


def solve_wet(
    problem: ContactProblem,
    control: Control,
    film: LiquidFilm,
    *,
    friction: Friction = Friction(),
    steady: Steady = Steady(),
    solver: Solver | None = None,
    state: InterfaceState | None = None,
    operator: Operator | None = None,
    progress: Progress | None = None,
    on_failure: Literal["raise", "return"] = "raise",
) -> WetContactResult:
    """Solve a contact with a film of liquid (Tian & Bhushan 1996; Peng 2001, sec. 3.2.4).

    The dry contact under the load W has menisci of the force F; it is solved again under W + F until F is steady. The
    force rises from round to round to the smallest balance. A prescribed position needs one solve: there the external
    force is what the contact bears less what the menisci pull.

    Parameters
    ----------
    problem, solver, state, progress
        As for ``solve``. The pressure of the state is the first guess of the contact under W alone.
    control
        External load (``MeanPressure``, ``Force``) or position (``Approach``, ``MeanGap``).
    film
        Liquid, thickness, meniscus height and contact angles.
    friction
        Dry coefficient and speed for the friction force.
    steady
        When to stop.
    operator
        Prepared operator of the same problem (``prepare_operator``), to spare the set-up in repeated solves and to choose
        the engine.
    on_failure
        ``"raise"`` a ConvergenceError holding the result, or ``"return"`` it with its status, when not steady.

    Raises
    ------
    NoSolutionError
        If the meniscus force runs away: an interface with liquid on less than half of its area under the external load
        collapses until liquid or contact nearly fills it, or load and menisci exceed the hardness.
    ConvergenceError
        If the force is not steady after the rounds allowed, or a solve on the way does not converge, and ``on_failure`` is
        ``"raise"``.
    InputError
        As for ``solve``.
    """
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    require.instance(film, LiquidFilm, "film of a wet contact", "Use LiquidFilm.of(liquid, thickness).")
    ready = operator or prepare_operator(problem.compliance, problem.grid, problem.boundary)
    rounds = _Rounds(problem, film, ready, solver, state, progress)
    load, found = _balanced(rounds, control, steady)
    result = WetContactResult(
        control=control,
        contact=rounds.whole(found.contact),
        film=film,
        wetting=found.wetting,
        external_force=load,
        meniscus_force=rounds.force(found.wetting),
        dry_friction=friction.coefficient,
        viscous_force=viscous_force(found.contact.gap, problem.grid, found.wetting, film, friction.speed),
        rounds=found.rounds,
        change=found.change,
        feedback=found.feedback,
        status=_status(found, rounds.slack(load, steady.tolerance)),
    )
    if on_failure == "raise" and not result.converged:
        raise ConvergenceError(f"{result.status.message} {result.status.remedy}", result)
    return result


@dataclass(frozen=True, eq=False)
class _Settled:
    """Last contact and menisci, number of solves, change of the force over the load, share due to feedback."""

    contact: ContactResult
    wetting: Wetting
    rounds: int
    change: float
    feedback: float


@dataclass(frozen=True)
class _Rounds:
    """Everything that stays the same from one solve to the next."""

    problem: ContactProblem
    film: LiquidFilm
    operator: Operator
    solver: Solver | None
    state: InterfaceState | None
    progress: Progress | None

    def solved(self, control: Control, last: list[ContactResult]) -> ContactResult:
        """Contact under ``control``, started from what the ``last`` rounds suggest; its stiffness is left out."""
        start = self.state
        if last:
            guess = predicted(self.problem, control, last).pressure
            virgin = InterfaceState(np.zeros(guess.shape), guess)
            start = virgin if start is None else replace(start, pressure=guess)
        options = {"solver": self.solver, "state": start, "progress": self.progress, "operator": self.operator}
        keep = Keep(stiffness=False)
        return solve(self.problem, control, keep=keep, on_failure="return", **options)  # type: ignore[arg-type]

    def whole(self, contact: ContactResult) -> ContactResult:
        """``contact`` with its stiffness, which only the last round needs."""
        cap = cap_at(self.problem.law, contact.permanent_indentation)
        return replace(contact, normal_stiffness=normal_stiffness(self.operator, contact.pressure, cap))

    def wetted(self, contact: ContactResult) -> Wetting:
        """Menisci of ``contact``."""
        return wetting(contact.gap, contact.contact, self.film, wraps=self.problem.boundary.wraps)

    def force(self, found: Wetting) -> float:
        """Meniscus force in N: suction times area of the menisci."""
        return self.film.suction * int(np.count_nonzero(found.menisci)) * self.problem.grid.pixel_area

    def slack(self, load: float, tolerance: float) -> float:
        """Change of the force over the ``load`` that does not count."""
        if load <= 0.0:
            return tolerance
        return tolerance + _PIXELS * self.film.suction * self.problem.grid.pixel_area / load


def _balanced(rounds: _Rounds, control: Control, steady: Steady) -> tuple[float, _Settled]:
    """External force in N, and the contact with menisci that goes with it."""
    if isinstance(control, MeanPressure | Force):
        load = mean_pressure(control, rounds.problem.grid) * rounds.problem.grid.area
        return load, _settled(rounds, load, steady)
    contact = rounds.solved(control, [])
    found = rounds.wetted(contact)
    return contact.force - rounds.force(found), _Settled(contact, found, 1, 0.0, 0.0)


def _settled(rounds: _Rounds, load: float, steady: Steady) -> _Settled:
    """Repeat until the menisci of the contact under ``load`` (N) and menisci are those that it was loaded with."""
    contact = rounds.solved(Force(load), [])
    last, found = [contact], rounds.wetted(contact)
    pull = start = rounds.force(found)
    was_open, change, count = found.share("kept") < COLLAPSED, pull / load, 1
    slack = rounds.slack(load, steady.tolerance)
    while count < steady.max_rounds and change > slack and contact.converged:
        try:
            contact = rounds.solved(Force(load + pull), last)
        except NoSolutionError as error:
            raise NoSolutionError(f"{_runaway(load, start, pull, count)} The contact bears no more: {error}") from error
        last, found = [last[-1], contact], rounds.wetted(contact)
        count += 1
        latest = rounds.force(found)
        if found.regime == "flooded" and was_open:
            raise NoSolutionError(f"{_runaway(load, start, latest, count)} {_FULL}")
        change = abs(latest - pull) / load
        # where contact takes the place of menisci the force falls with the load, and plain repetition would swing
        pull = latest if latest >= pull or change <= slack else 0.5 * (latest + pull)
    feedback = 1.0 - start / pull if pull > 0.0 else 0.0
    return _Settled(contact, found, count, change, feedback)


def _runaway(load: float, start: float, pull: float, count: int) -> str:
    """Beginning of the message on a force (N) that runs away."""
    return (
        f"meniscus force runs away: under the external force of {load:.4g} N the menisci pull with {start:.4g} N, which closes "
        f"the surfaces, and so on to {pull:.4g} N, {pull / load:.3g} times the external force, after {count} solves."
    )


def _status(found: _Settled, slack: float) -> Status:
    if not found.contact.converged:
        return found.contact.status
    if found.change <= slack:
        solves = "one solve" if found.rounds == 1 else f"{found.rounds} solves"
        return Status(Outcome.CONVERGED, f"The meniscus force is steady after {solves} ({found.wetting.regime}).")
    message = (
        f"The meniscus force still changes by {found.change:.1e} of the external force after {found.rounds} solves."
    )
    return Status(Outcome.ITERATION_LIMIT, message, _REMEDY)
