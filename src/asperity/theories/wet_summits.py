"""Menisci of Greenwood-Williamson summits from plain numbers: heights of any skewness and kurtosis, at rest and growing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from .greenwood_williamson import GreenwoodWilliamson
from .kinetic_meniscus import KineticMeniscus
from .kotwal_bhushan import PearsonHeights
from .meniscus_growth import MeniscusGrowth
from .protocol import E_STAR, Input, Limit
from .roughness import Roughness
from .statistical_meniscus import StatisticalMeniscus, WetPrediction
from .summit_heights import GaussianHeights, SummitHeights
from .ways import PRESSURE, Column, Way, asked

WET = (
    Column("pressure", "Pa", "external load per nominal area"),
    Column("meniscus_pressure", "Pa", "meniscus force per nominal area"),
    Column("contact.pressure", "Pa", "what the summits carry"),
    Column("contact.area_fraction", "", "real area per nominal area"),
    Column("contact.contact_density", "1/m^2", "contacts per nominal area"),
    Column("contact.separation", "m", "plane to mean plane of the undeformed surface"),
)
"""What wet summits answer."""

SUMMITS = (E_STAR, *GreenwoodWilliamson.inputs[1:4])
FILM = (
    Input("surface_tension", "N/m", "surface tension of the liquid", of="bodies"),
    Input("film_thickness", "m", "thickness of the film", of="bodies"),
)
ANGLE = Input("contact_angle", "rad", "contact angle on the summits", of="bodies", default=0.0)
GROWTH = (
    Input("viscosity", "Pa*s", "viscosity of the liquid", of="bodies"),
    Input("hamaker_constant", "J", "Hamaker constant of solid, liquid and vapour", of="bodies"),
)
SHAPE = (
    GreenwoodWilliamson.inputs[4],
    Input("skewness", "", "skewness of the summit heights", default=0.0),
    Input("kurtosis", "", "kurtosis of the summit heights, 3 for Gaussian ones", default=3.0),
)


@dataclass(frozen=True)
class WetSummits:
    """Summits in a film of liquid, each pulled by the force of a sphere that touches it, against a smooth plane.

    ``theory`` is the :class:`~asperity.theories.statistical_meniscus.StatisticalMeniscus` of these numbers.

    Parameters
    ----------
    E_star, density, radius, height_deviation, mean_height
        As for ``GreenwoodWilliamson``.
    surface_tension
        In N/m, > 0.
    film_thickness
        In m, > 0.
    contact_angle
        In rad on the summits.
    skewness, kurtosis
        Of the summit heights, of Pearson's system; 0 and 3 for Gaussian ones.
    """

    E_star: float
    density: float
    radius: float
    height_deviation: float
    surface_tension: float
    film_thickness: float
    contact_angle: float = 0.0
    mean_height: float = 0.0
    skewness: float = 0.0
    kurtosis: float = 3.0
    name: ClassVar[str] = "statistical-meniscus"
    title: ClassVar[str] = "Menisci of Greenwood-Williamson summits"
    citation_keys: ClassVar[tuple[str, ...]] = (*StatisticalMeniscus.citation_keys, "Kotwal1996")
    inputs: ClassVar[tuple[Input, ...]] = (*SUMMITS, *FILM, ANGLE, *SHAPE)
    numbers: ClassVar[tuple[Column, ...]] = (
        Column("theory.largest", "Pa", "meniscus force per area when every summit reaches the film"),
        Column("theory.pull_off", "Pa", "largest tension that the menisci hold"),
    )
    ways: ClassVar[tuple[Way, ...]] = (Way(PRESSURE, "at_pressure", WET),)

    def __post_init__(self) -> None:
        _ = self.theory

    @classmethod
    def of_roughness(
        cls,
        roughness: Roughness,
        E_star: float,
        *,
        surface_tension: float,
        film_thickness: float,
        contact_angle: float = 0.0,
    ) -> Self:
        """Theory for the summits of a map, with the skewness and kurtosis of their heights."""
        s = roughness.known(roughness.summits, "its summits", cls.name)
        summits = (s.density, 1.0 / float(s.curvature.mean()), s.height_deviation)
        shape = (s.mean_height, s.height_skewness, s.height_kurtosis)
        return cls(E_star, *summits, surface_tension, film_thickness, contact_angle, *shape)

    @property
    def heights(self) -> SummitHeights:
        """Distribution of the summit heights."""
        gaussian = (self.skewness, self.kurtosis) == (0.0, 3.0)
        return GaussianHeights() if gaussian else PearsonHeights(self.skewness, self.kurtosis)

    @property
    def theory(self) -> StatisticalMeniscus:
        """The theory of these numbers."""
        numbers = (self.E_star, self.density, self.radius, self.height_deviation, self.mean_height)
        contact = GreenwoodWilliamson(*numbers, heights=self.heights)
        return StatisticalMeniscus(contact, self.surface_tension, self.film_thickness, self.contact_angle)

    def at_pressure(self, pressure: ArrayLike) -> WetPrediction:
        """Balance under external pressures (n,) in Pa, > 0."""
        return self.theory.at_pressure(pressure)

    def validity(self, answer: WetPrediction) -> tuple[Limit, ...]:
        """Conditions of the contact of the summits."""
        return self.theory.contact.validity(answer.contact)


@dataclass(frozen=True, eq=False)
class GrownMenisci:
    """Wet summits at times (n,): ``height`` of the menisci in m, ``meniscus_pressure`` and ``area_fraction``."""

    height: RealArray
    meniscus_pressure: RealArray
    area_fraction: RealArray


@dataclass(frozen=True)
class GrowingMenisci:
    """Wet summits whose menisci grow with time; Gaussian heights.

    ``theory`` is the :class:`~asperity.theories.kinetic_meniscus.KineticMeniscus` of these numbers.

    Parameters
    ----------
    E_star, density, radius, height_deviation, surface_tension, film_thickness, contact_angle
        As for ``WetSummits``.
    viscosity
        Of the liquid in Pa s.
    hamaker_constant
        Of solid, liquid and vapour in J, about 1e-19.
    radius_ratio
        Outer over inner radius of the film that feeds a meniscus, > 1; only its logarithm enters.
    """

    E_star: float
    density: float
    radius: float
    height_deviation: float
    surface_tension: float
    film_thickness: float
    viscosity: float
    hamaker_constant: float
    contact_angle: float = 0.0
    radius_ratio: float = 10.0
    name: ClassVar[str] = "kinetic-meniscus"
    title: ClassVar[str] = "Growing menisci of Greenwood-Williamson summits"
    citation_keys: ClassVar[tuple[str, ...]] = (*KineticMeniscus.citation_keys, "Greenwood1966")
    inputs: ClassVar[tuple[Input, ...]] = (
        *SUMMITS,
        *FILM,
        *GROWTH,
        ANGLE,
        Input(
            "radius_ratio", "", "outer over inner radius of the film that feeds a meniscus", of="bodies", default=10.0
        ),
    )
    numbers: ClassVar[tuple[Column, ...]] = (
        Column("theory.growth.equilibrium_height", "m", "height at which the film holds back its liquid"),
        Column("theory.growth.time_scale", "s", "time scale of the growth"),
        Column("theory.growth.disjoining_pressure", "Pa", "disjoining pressure of the film"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("time", "s", "time after contact"),
            "at_time",
            (
                Column("height", "m", "height of the menisci"),
                Column("meniscus_pressure", "Pa", "meniscus force per nominal area"),
                Column("area_fraction", "", "real area per nominal area"),
            ),
            (PRESSURE,),
        ),
    )

    def __post_init__(self) -> None:
        _ = self.theory

    @property
    def theory(self) -> KineticMeniscus:
        """The theory of these numbers."""
        numbers = (self.E_star, self.density, self.radius, self.height_deviation)
        film = (self.surface_tension, self.film_thickness)
        summits = WetSummits(*numbers, *film, self.contact_angle)
        liquid = (self.viscosity, self.hamaker_constant, self.contact_angle, self.radius_ratio)
        return KineticMeniscus(summits.theory, MeniscusGrowth(self.radius, *film, *liquid))

    def at_time(self, time: ArrayLike, pressure: float) -> GrownMenisci:
        """Balance at ``time`` (n,) in s, >= 0, under the external ``pressure`` in Pa, > 0."""
        times = np.atleast_1d(np.asarray(time, dtype=float))
        found = self.theory.at(times, pressure)
        return GrownMenisci(self.theory.growth.height(times), found.meniscus_pressure, found.contact.area_fraction)
