"""The answer to a wet contact: the contact under load and menisci, where the liquid stands, forces, friction."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..core.quantity import Quantity
from ..core.status import Status
from .control import Control
from .problem import ContactProblem
from .result import ContactResult
from .wetting import LiquidFilm, Wetting

WET_SCALARS = (
    Quantity("external_force", "N", "external force"),
    Quantity("meniscus_force", "N", "meniscus force"),
    Quantity("relative_meniscus_force", "1", "meniscus force / external force"),
    Quantity("suction", "Pa", "pressure deficit in the menisci"),
    Quantity("meniscus_height", "m", "meniscus height"),
    Quantity("film_thickness", "m", "film thickness"),
    Quantity("meniscus_area_fraction", "1", "area of the menisci / nominal area"),
    Quantity("wetted_area_fraction", "1", "wetted area with contact / nominal area"),
    Quantity("cut_area_fraction", "1", "cross-cut area at the meniscus height / nominal area"),
    Quantity("n_menisci", "1", "number of menisci"),
    Quantity("friction_force", "N", "static friction force"),
    Quantity("viscous_force", "N", "viscous part of the friction force"),
    Quantity("static_friction", "1", "static friction coefficient, friction / external force"),
    Quantity("feedback", "1", "share of the meniscus force that the menisci themselves cause"),
)
"""Every scalar of a wet contact beside those of the contact itself, in the order of tables."""


@dataclass(frozen=True, eq=False)
class WetContactResult:
    """Contact with a liquid film, all values SI.

    Attributes
    ----------
    control
        What was prescribed: external load or position.
    contact
        The solid contact, under the external force and that of the menisci.
    film, wetting
        The liquid, and where it stands.
    external_force, meniscus_force
        W and F_m in N; W is negative where the menisci hold the bodies against a tension (position prescribed).
    dry_friction
        True coefficient of friction μ_r, shear over normal force of the solid contact.
    viscous_force
        Shear of the liquid at the sliding speed, N.
    rounds, change
        Number of solves, and the change of the meniscus force in the last over the external force.
    feedback
        1 - F_m(W)/F_m(W + F_m): share of the meniscus force that is there because menisci press the surfaces together;
        the mean growth dF_m/dL on the way. Zero where the position is prescribed.
    status
        Whether the meniscus force is steady.
    """

    control: Control
    contact: ContactResult
    film: LiquidFilm
    wetting: Wetting
    external_force: float
    meniscus_force: float
    dry_friction: float
    viscous_force: float
    rounds: int
    change: float
    feedback: float
    status: Status

    @property
    def problem(self) -> ContactProblem:
        """What was solved."""
        return self.contact.problem

    @property
    def converged(self) -> bool:
        """Whether the meniscus force is steady and the contact solved."""
        return self.status.converged

    @property
    def relative_meniscus_force(self) -> float:
        """F_m/W; NaN without external force."""
        return self.meniscus_force / self.external_force if self.external_force > 0.0 else math.nan

    @property
    def suction(self) -> float:
        """Pressure deficit in the menisci in Pa."""
        return self.film.suction

    @property
    def film_thickness(self) -> float:
        """h_f in m."""
        return self.film.thickness

    @property
    def meniscus_height(self) -> float:
        """h_m in m."""
        return self.film.meniscus_height

    @property
    def meniscus_area_fraction(self) -> float:
        """Area that the suction acts on over nominal area."""
        return self.wetting.share("menisci")

    @property
    def wetted_area_fraction(self) -> float:
        """Pixels with a gap up to the film thickness over all."""
        return self.wetting.share("wetted")

    @property
    def cut_area_fraction(self) -> float:
        """Pixels with a gap up to the meniscus height over all."""
        return self.wetting.share("cut")

    @property
    def n_menisci(self) -> int:
        """Number of islands that hold liquid."""
        return self.wetting.n_menisci

    @property
    def friction_force(self) -> float:
        """μ_r (W + F_m) + viscous force in N."""
        return self.dry_friction * (self.external_force + self.meniscus_force) + self.viscous_force

    @property
    def static_friction(self) -> float:
        """Friction force over external force: μ_r (1 + F_m/W) without viscous force; NaN without external force."""
        return self.friction_force / self.external_force if self.external_force > 0.0 else math.nan

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        return tuple(sorted({*self.contact.citation_keys, *self.film.citation_keys, *self.wetting.citation_keys}))
