"""Sliding contact of unlike bodies: shear traction moves the surfaces up and down, and so changes the pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import ConvergenceError
from ..core.status import Outcome, Status
from ..surfaces.surface import Surface
from .control import Approach, Control
from .operators import Operator, prepare_operator
from .operators.coupling import SlidingCoupling
from .problem import ContactProblem
from .result import ContactResult
from .solve import Keep, solve
from .solvers.active_set import ActiveSet
from .solvers.protocol import Solver
from .state import InterfaceState

_TIGHT = 1e-12
_REMEDY = "Allow more rounds, tighten the solver's tolerance, or lower the friction coefficient."


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
    max_rounds: int = 30,
    solver: Solver | None = None,
    state: InterfaceState | None = None,
    on_failure: Literal["raise", "return"] = "raise",
) -> SlidingResult:
    """Solve a contact in which all points slide, with the coupling of shear traction and normal displacement.

    The contact is solved again and again on the profile less the displacement of the last shear traction, until the
    pressure stops changing; every round reduces the change by about friction times Dundurs' β.

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
    max_rounds
        Largest number of solves, at least 2.
    solver
        Method; by default ``ActiveSet`` with a tolerance tight enough that its error does not hide convergence.
    on_failure
        ``"raise"`` a ConvergenceError holding the result, or ``"return"`` it with its status, when not converged.

    Raises
    ------
    ConvergenceError
        If the pressure does not settle and ``on_failure`` is ``"raise"``, or a solve on the way does not converge.
    NoSolutionError, InputError
        As for ``solve``; also if the boundary is a free line or the friction coefficient negative.
    """
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    mu = require.not_negative(friction, "friction coefficient")
    require.positive(tolerance, "tolerance of a sliding contact")
    require.integer(max_rounds, 2, "number of rounds")
    coupling = SlidingCoupling(problem, (mu * math.cos(direction), mu * math.sin(direction)))
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    rounds = _Round(problem, control, solver or ActiveSet(tolerance=_TIGHT), operator, state)
    contact, lift, count, change = _settled(rounds, coupling, tolerance, max_rounds)
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
            permanent = np.zeros(guess.shape) if start is None else start.permanent_indentation
            start = InterfaceState(permanent, guess)
        found = solve(
            posed, control, solver=self.solver, state=start, keep=Keep(stiffness=False), operator=self.operator
        )
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


def _settled(
    rounds: _Round, coupling: SlidingCoupling, tolerance: float, most: int
) -> tuple[ContactResult, RealArray, int, float]:
    """Last contact, the lift (m) it was solved on, number of solves and last change of the pressure."""
    lift: RealArray = np.zeros(rounds.problem.grid.shape)
    contact, change = rounds.solved(lift, None), math.inf
    for count in range(2, most + 1):
        lift = coupling.displacement(contact.pressure)
        latest = rounds.solved(lift, contact.pressure)
        change = _change(latest.pressure, contact.pressure)
        contact = latest
        if change <= tolerance:
            return contact, lift, count, change
    return contact, lift, most, change


def _change(pressure: RealArray, before: RealArray) -> float:
    return float(np.linalg.norm(pressure - before)) / (float(np.linalg.norm(pressure)) or 1.0)


def _status(converged: bool, change: float, rounds: int) -> Status:
    if converged:
        return Status(Outcome.CONVERGED, f"The pressure settled in {rounds} rounds.")
    message = f"The pressure of the sliding contact still changes by {change:.1e} after {rounds} rounds."
    return Status(Outcome.ITERATION_LIMIT, message, _REMEDY)
