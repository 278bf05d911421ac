"""Contact with a liquid film by its earlier name: ``solve`` with the film in the problem."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

from ..core import require
from ..core.errors import ConvergenceError
from .control import Control
from .couplings.driver import Rounds
from .laws import Coulomb
from .problem import ContactProblem
from .solve import solve
from .wet_result import WetContactResult
from .wetting import LiquidFilm


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
    """When the meniscus force counts as steady."""

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
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> WetContactResult:
    """Solve a contact with a film of liquid, see ``solve``."""
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    require.instance(film, LiquidFilm, "film of a wet contact", "Use LiquidFilm.of(liquid, thickness).")
    sliding = Coulomb(friction.coefficient, speed=friction.speed, coupled=False)
    rounds = Rounds(most=steady.max_rounds, tolerances={"menisci": steady.tolerance})
    wet = replace(problem, film=film, friction=sliding)
    found = solve(wet, control, rounds=rounds, on_failure="return", **options)
    menisci = found.menisci
    assert menisci is not None
    check = next(check for check in found.certificate.couplings if check.name == "menisci")
    result = WetContactResult(
        control=control,
        contact=replace(found, problem=problem),
        film=film,
        wetting=menisci.wetting,
        external_force=menisci.external_force,
        meniscus_force=menisci.meniscus_force,
        dry_friction=friction.coefficient,
        viscous_force=menisci.viscous_force,
        rounds=found.certificate.rounds,
        change=check.residual,
        feedback=menisci.feedback,
        status=found.status,
    )
    if on_failure == "raise" and not result.converged:
        raise ConvergenceError(f"{result.status.message} {result.status.remedy}", result)
    return result
