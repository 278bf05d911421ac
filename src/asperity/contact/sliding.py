"""Sliding contact of unlike bodies: shear traction moves the surfaces up and down, and so changes the pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.engine import Engine
from ..core.errors import ConvergenceError
from ..core.progress import NoProgress, Progress
from ..core.status import Outcome, Status
from ..surfaces.surface import Surface
from .control import Approach, Control
from .operators import Operator, prepare_operator
from .operators.coupling import SlidingCoupling
from .problem import ContactProblem
from .result import ContactResult
from .solve import Keep, solve
from .solvers.active_set.solver import ActiveSet
from .solvers.protocol import Solver
from .state import InterfaceState

_TIGHT = 1e-12
_MOST_ROUNDS = 30  # a change that halves in every round is 1e-9 after them
_REMEDY = "Tighten the solver's tolerance, allow more change, or lower the friction coefficient."


@dataclass(frozen=True, eq=False)
class SlidingResult:
    """Contact that slides, all values SI.

    Attributes
    ----------
    contact
        Pressure, gap and everything else of the contact; its displacement includes that of the shear traction.
    friction, direction
        Coefficient μ, and angle in rad of the shear traction on ``body`` from +x towards +y.
    shear_displacement
        Normal displacement (nx, ny) in m caused by the shear traction alone.
    rounds, change
        Number of solves, and the relative L2 change of the pressure in the last.
    status
        Whether the pressure stopped changing.
    """

    contact: ContactResult
    friction: float
    direction: float
    shear_displacement: RealArray
    rounds: int
    change: float
    status: Status

    @property
    def problem(self) -> ContactProblem:
        """What was solved."""
        return self.contact.problem

    @property
    def pressure(self) -> RealArray:
        """Contact pressure in Pa."""
        return self.contact.pressure

    @property
    def converged(self) -> bool:
        """Whether the pressure stopped changing."""
        return self.status.converged

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        return (*self.contact.citation_keys, "Dundurs1969", "Johnson1985")


def solve_sliding(
    problem: ContactProblem,
    control: Control,
    friction: float,
    *,
    direction: float = 0.0,
    tolerance: float = 1e-6,
    solver: Solver | None = None,
    state: InterfaceState | None = None,
    progress: Progress = NoProgress(),
    engine: Engine | None = None,
    on_failure: Literal["raise", "return"] = "raise",
) -> SlidingResult:
    """Solve a contact in which all points slide, with the coupling of shear traction and normal displacement.

    The contact is solved again and again on the profile less the displacement of the last shear traction, until the
    pressure stops changing; every round reduces the change by about friction times Dundurs' β. After 30 rounds it gives up.

    Parameters
    ----------
    problem, control, state
        As for ``solve``.
    friction
        Coefficient μ >= 0: shear traction over pressure.
    direction
        Angle in rad of the shear traction on ``body``, from +x towards +y.
    tolerance
        Relative L2 change of the pressure from one round to the next at which to stop.
    solver
        Method; by default ``ActiveSet`` with a tolerance tight enough that its error does not hide convergence.
    progress
        Receives, after every iteration of every round, the number of all iterations so far and the larger of the solver's
        error and the last change of the pressure.
    engine
        Machine to compute on, as for ``solve``.
    on_failure
        ``"raise"`` a ConvergenceError holding the result, or ``"return"`` it with its status, when not converged.

    Raises
    ------
    ConvergenceError
        If the pressure does not settle and ``on_failure`` is ``"raise"``, or a solve on the way does not converge.
    NoSolutionError, InputError
        As for ``solve``; also if the friction coefficient is negative.
    """
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    mu = require.not_negative(friction, "friction coefficient")
    require.positive(tolerance, "tolerance of a sliding contact")
    ratios = mu * math.cos(direction), mu * math.sin(direction)
    coupling = SlidingCoupling(problem, ratios, threads=getattr(engine, "threads", None))
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    told = _Told(progress, tolerance)
    rounds = _Round(problem, control, solver or ActiveSet(tolerance=_TIGHT), operator, state, told)
    contact, lift, count, change = _settled(rounds, coupling, told)
    status = _status(change <= tolerance, change, count)
    result = SlidingResult(contact, mu, direction, lift, count, change, status)
    if on_failure == "raise" and not status.converged:
        raise ConvergenceError(f"{status.message} {status.remedy}", result)
    return result


@dataclass(frozen=True)
class _Round:
    """Everything that stays the same from one solve to the next."""

    problem: ContactProblem
    control: Control
    solver: Solver
    operator: Operator
    state: InterfaceState | None
    told: _Told

    def solved(self, lift: RealArray, guess: RealArray | None) -> ContactResult:
        """Contact of the profile less ``lift`` (m), started from the pressure ``guess``, seen from the true profile."""
        whole = self.problem
        surface = whole.surface
        moved = Surface(
            surface.heights - lift, surface.dx, surface.dy, periodic=surface.periodic, origin=surface.origin
        )
        posed = replace(whole, surface=moved)
        shift = float(posed.profile().max() - whole.profile().max())
        control = self.control
        if isinstance(control, Approach):  # counts from first touch of the true surfaces
            control = Approach(control.value + shift)
        start = self.state
        if guess is not None:
            virgin = InterfaceState(np.zeros(guess.shape), guess)
            start = virgin if start is None else replace(start, pressure=guess)
        options = {"solver": self.solver, "operator": self.operator, "progress": self.told}
        found = solve(posed, control, state=start, keep=Keep(stiffness=False), **options)  # type: ignore[arg-type]
        displacement = found.displacement + lift
        energy = 0.5 * float((found.pressure * displacement).sum()) * whole.grid.pixel_area
        return replace(
            found,
            problem=whole,
            control=self.control,
            displacement=displacement,
            approach=found.approach - shift,
            elastic_energy=energy,
        )


class _Told:
    """Progress of all rounds together: one count of iterations, and an error that ends at the ``tolerance`` of the change."""

    def __init__(self, progress: Progress, tolerance: float) -> None:
        self.tolerance = tolerance
        self._progress, self._before, self._latest, self._change = progress, 0, 0, 1.0

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """An iteration of a round."""
        self._latest = iteration
        self._progress.update(self._before + iteration, max(error, self._change), self.tolerance)

    def round(self, change: float) -> None:
        """The end of a round."""
        self._before, self._latest, self._change = self._before + self._latest, 0, change
        self._progress.update(self._before, change, self.tolerance)


def _settled(rounds: _Round, coupling: SlidingCoupling, told: _Told) -> tuple[ContactResult, RealArray, int, float]:
    """Last contact, the lift (m) it was solved on, number of solves and last change of the pressure."""
    lift: RealArray = np.zeros(rounds.problem.grid.shape)
    contact, count, change = rounds.solved(lift, None), 1, 1.0
    while count < _MOST_ROUNDS and change > told.tolerance:
        told.round(change)
        lift = coupling.displacement(contact.pressure)
        latest = rounds.solved(lift, contact.pressure)
        change = _change(latest.pressure, contact.pressure)
        contact, count = latest, count + 1
    told.round(change)
    return contact, lift, count, change


def _change(pressure: RealArray, before: RealArray) -> float:
    return float(np.linalg.norm(pressure - before)) / (float(np.linalg.norm(pressure)) or 1.0)


def _status(converged: bool, change: float, rounds: int) -> Status:
    if converged:
        return Status(Outcome.CONVERGED, f"The pressure settled in {rounds} rounds.")
    message = f"The pressure of the sliding contact still changes by {change:.1e} after {rounds} rounds."
    return Status(Outcome.ITERATION_LIMIT, message, _REMEDY)
