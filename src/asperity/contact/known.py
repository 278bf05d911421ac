"""Names by which problems give their physics and histories their energies, with their types: for
type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from ..core.arrays import RealArray
    from ..physics.adhesion.law import Adhesion
    from ..physics.friction.law import FrictionLaw
    from ..physics.menisci.film import LiquidFilm
    from ..physics.plastic_flow.law import PlasticFlow


class Keywords(TypedDict, total=False):
    """Physics of a ``ContactProblem`` by keyword."""

    film: LiquidFilm | None
    friction: FrictionLaw | None
    adhesion: Adhesion | None
    plastic_flow: PlasticFlow | None


class ProblemNames:
    """What was given for each keyword."""

    if TYPE_CHECKING:
        film: LiquidFilm | None
        friction: FrictionLaw | None
        adhesion: Adhesion | None
        plastic_flow: PlasticFlow | None


class EnergyNames:
    """What each physics adds to the energies of a history."""

    if TYPE_CHECKING:
        meniscus_work: RealArray
        shear_work: RealArray
        tangential_work: RealArray
        slip_work: RealArray
        step_work: RealArray
        jump_work: RealArray
