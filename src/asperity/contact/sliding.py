"""Sliding contact by its earlier name: ``solve`` with friction in the problem."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import ConvergenceError
from ..core.status import Status
from .control import Control
from .couplings.driver import Rounds
from .laws import Coulomb
from .problem import ContactProblem
from .result import ContactResult
from .solve import Keep, solve


@dataclass(frozen=True, eq=False)
class SlidingResult:
    """Contact that slides, all values SI."""

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
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> SlidingResult:
    """Solve a contact in which all points slide, see ``solve``."""
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    require.positive(tolerance, "tolerance of a sliding contact")
    rounds = Rounds(tolerances={"sliding": tolerance})
    sliding = replace(problem, friction=Coulomb(friction, direction))
    found = solve(sliding, control, keep=Keep(stiffness=False), rounds=rounds, on_failure="return", **options)
    moved = np.zeros(problem.grid.shape) if found.sliding is None else found.sliding.shear_displacement
    change = next((check.residual for check in found.certificate.couplings if check.name == "sliding"), 0.0)
    contact = replace(found, problem=problem)
    result = SlidingResult(contact, friction, direction, moved, found.certificate.rounds, change, found.status)
    if on_failure == "raise" and not result.converged:
        raise ConvergenceError(f"{result.status.message} {result.status.remedy}", result)
    return result
