"""Names by which problems give their physics, results what these found, and histories their energies, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.arrays import RealArray
    from ..physics.adhesion.answer import AdhesiveContact
    from ..physics.adhesion.law import Adhesion
    from ..physics.friction.answer import StickSlip
    from ..physics.friction.law import FrictionLaw
    from ..physics.friction.sliding import GrossSliding
    from ..physics.menisci.coupling import Menisci
    from ..physics.menisci.film import LiquidFilm
    from ..physics.plastic_flow.answer import PlasticBody
    from ..physics.plastic_flow.law import PlasticFlow
    from ..physics.viscoelastic.moments import Creeping


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


class ResultNames:
    """What each coupling has found."""

    if TYPE_CHECKING:
        menisci: Menisci | None
        adhesion: AdhesiveContact | None
        plastic_flow: PlasticBody | None
        sliding: GrossSliding | None
        stick_slip: StickSlip | None
        creep: Creeping | None
        require_menisci: Callable[[], Menisci]
        require_adhesion: Callable[[], AdhesiveContact]
        require_stick_slip: Callable[[], StickSlip]
        require_plastic_flow: Callable[[], PlasticBody]


class EnergyNames:
    """What each physics adds to the energies of a history."""

    if TYPE_CHECKING:
        meniscus_work: RealArray
        shear_work: RealArray
        tangential_work: RealArray
        slip_work: RealArray
        step_work: RealArray
        jump_work: RealArray
