"""Names by which problems and results give their physics, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..core.arrays import RealArray
    from .couplings.adhesion import AdhesiveContact
    from .couplings.menisci import Menisci
    from .couplings.plastic_flow import PlasticBody
    from .couplings.sliding import GrossSliding
    from .couplings.stick_slip import StickSlip
    from .laws.adhesion import Adhesion
    from .laws.friction import FrictionLaw
    from .laws.plastic_flow import PlasticFlow
    from .time_steps import Creeping
    from .wetting import LiquidFilm


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
