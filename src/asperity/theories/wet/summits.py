"""Menisci on rough surfaces: statistical theories at rest and in growth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length, Number, Positive, Viscosity
from ..ask import PRESSURE, Way, asked
from ..protocol import (
    Bound,
    HeightDeviation,
    Limit,
    MeanHeight,
    Modulus,
    Prediction,
    SummitDensity,
    SummitKurtosis,
    SummitRadius,
    SummitSkewness,
    Theory,
    curve,
)
from ..rough.greenwood_williamson import HIGHEST, LOWEST, GreenwoodWilliamson
from ..statistics.heights import GaussianHeights, PearsonHeights, SummitHeights
from ..statistics.roughness import Roughness
from .meniscus import MeniscusGrowth, film_force

SurfaceTension: TypeAlias = Annotated[
    float, Number("N/m", above=0.0), Help("surface tension of the liquid", of="bodies")
]
FilmThickness: TypeAlias = Annotated[Length, Help("thickness of the film", of="bodies")]
ContactAngle: TypeAlias = Annotated[float, Number("angle"), Help("contact angle on the summits", of="bodies")]

# Menisci of Greenwood-Williamson summits in a liquid film (Gao, Tian & Bhushan 1995; Bhushan 1998,
# eq. 56-58).


Pull: TypeAlias = Callable[[RealArray], RealArray]
"""Meniscus force per nominal area in Pa at separations in m, (1, m) for all loads or (n, 1), one
for each."""

_STEPS = 100  # ten are the rule
_CLOSE = 1e-14  # standard deviations; the error is less than the last step
_STEP = 0.1  # of the search for the first balance, in standard deviations; all curves change over about one
_NEAR = 12.0  # beyond, on the dense side every summit is in the film, and on the other there is hardly one left
_FAR_STEP = 1.0


@dataclass(frozen=True, eq=False, repr=False)
class WetPrediction(Tabled):
    """Balance of load, menisci and summits along a curve; arrays (n,).

    ``pressure`` external load per nominal area in Pa, ``meniscus_pressure`` meniscus force per
    nominal area in Pa, ``contact`` what the summits do under the sum of both.
    """

    pressure: RealArray
    meniscus_pressure: RealArray
    contact: Prediction

    def static_friction(self, coefficient: float) -> RealArray:
        """μ_s = μ_r (1 + F_m/W) for the dry ``coefficient`` μ_r, without viscous part (Bhushan
        1998, eq. 59)."""
        mu = require.not_negative(coefficient, "friction coefficient")
        return np.asarray(mu * (1.0 + self.meniscus_pressure / self.pressure))


@dataclass(frozen=True)
class StatisticalMeniscus:
    """A smooth surface with a film of liquid against rough summits of ``contact``.

    Every summit that reaches the film, touching the solid or not, is pulled by the full force of a
    sphere that touches it, 2πRγ(1 + cos θ): true for menisci much higher than the film. Below about
    one molecular layer there is none.

    InputError if a number is out of its range, or the liquid does not wet.

    Parameters
    ----------
    contact
        Summits and contact modulus; any distribution of heights.
    surface_tension
        γ of the liquid in N/m, > 0.
    film_thickness
        h in m, > 0.
    contact_angle
        θ in rad on the summits.
    molecular_layer
        Thickness in m below which a film is no liquid.
    """

    contact: GreenwoodWilliamson
    surface_tension: float
    film_thickness: float
    contact_angle: float = 0.0
    molecular_layer: float = 0.0
    citation_keys: ClassVar[tuple[str, ...]] = ("McFarlane1950", "Bhushan1998", "Gao1995", "Greenwood1966")

    def __post_init__(self) -> None:
        require.positive(self.film_thickness, "film thickness (m)")
        require.not_negative(self.molecular_layer, "molecular layer (m)")
        film_force(self.contact.radius, self.surface_tension, self.contact_angle)

    @property
    def largest(self) -> float:
        """Meniscus force per nominal area in Pa when every summit reaches the film; zero for less
        than a layer."""
        if self.film_thickness < self.molecular_layer:
            return 0.0
        return self.contact.density * film_force(self.contact.radius, self.surface_tension, self.contact_angle)

    def meniscus_pressure(self, separation: ArrayLike) -> RealArray:
        """Meniscus force per nominal area in Pa at separations (n,) in m from the mean plane of the
        surface."""
        return self._pull(curve(separation, "separations (m)"))

    def _pull(self, separation: RealArray) -> RealArray:
        reached = self.contact.standardised(separation - self.film_thickness)
        return np.asarray(self.largest * self.contact.heights.tail_moment(reached, 0.0))

    def at_pressure(self, pressure: ArrayLike) -> WetPrediction:
        """Balance under external pressures (n,) in Pa, > 0."""
        return balance(self.contact, self._pull, curve(pressure, "pressures (Pa)", positive=True))

    def feedback(self, separation: ArrayLike) -> RealArray:
        """dF_m/dL at separations (n,) in m: repeated solution converges only where this is below
        one."""
        h = curve(separation, "separations (m)")
        reached = self.contact.standardised(h - self.film_thickness)
        slope = self.largest * self.contact.heights.density(reached) / self.contact.height_deviation
        return np.asarray(slope / self.contact.at_separation(h).stiffness)

    @property
    def pull_off(self) -> float:
        """Largest tension per nominal area in Pa that the menisci hold against the summits, >=
        0."""
        h = _separations(self.contact)
        rest = self.contact.borne(h) - self.meniscus_pressure(h)
        lowest = int(np.argmin(rest))
        if lowest in (0, h.size - 1):
            return 0.0
        from scipy.optimize import minimize_scalar

        def net(separation: float) -> float:
            at = np.array([separation])
            return float((self.contact.borne(at) - self.meniscus_pressure(at))[0])

        found = minimize_scalar(net, bounds=(h[lowest - 1], h[lowest + 1]), method="bounded", options={"xatol": 0.0})
        return max(0.0, -float(found.fun))


def balance(contact: GreenwoodWilliamson, pull: Pull, pressure: RealArray) -> WetPrediction:
    """Equilibrium of the summits under ``pressure`` (n,) in Pa and the ``pull`` of the menisci, at
    the smallest separation.

    NoSolutionError if the summits do not carry load and menisci at any separation.
    """
    h, loads = _separations(contact), pressure[:, None]

    def rest(separation: RealArray) -> RealArray:
        return np.asarray(contact.borne(separation) - pull(separation))

    table = rest(h[None, :])
    short = table < loads
    first = np.argmax(short, axis=1)
    unborne = (first == 0) | ~short.any(axis=1)
    if unborne.any():
        densest = float(np.broadcast_to(table, short.shape)[unborne, 0][0])
        raise NoSolutionError(
            f"load (Pa) with its menisci must be within what the summits carry, at most {densest:.4g} Pa at "
            f"{-LOWEST:g} standard deviations below their mean, but is {pressure[unborne][0]:g}."
        )
    # where the rest falls through the load, to a small step: false position (Illinois)
    low, high = h[first - 1][:, None], h[first][:, None]
    at_low, at_high = rest(low) - loads, rest(high) - loads
    for _ in range(_STEPS):
        fall = at_high - at_low
        x = high - np.divide(at_high * (high - low), fall, out=np.zeros_like(high), where=fall != 0.0)
        step, value = np.abs(x - high), rest(x) - loads
        passed = value * at_high < 0.0
        low, at_low = np.where(passed, high, low), np.where(passed, at_high, 0.5 * at_low)
        high, at_high = x, value
        if np.all((step <= _CLOSE * contact.height_deviation) | (value == 0.0)):
            break
    separations = high
    return WetPrediction(pressure, pull(separations)[:, 0], contact.at_separation(separations[:, 0]))


def _separations(contact: GreenwoodWilliamson) -> RealArray:
    """Separations in m, from the smallest up, spaced closely enough to bracket every
    equilibrium."""
    end = min(HIGHEST, contact.heights.support[1])
    dense = np.arange(LOWEST, -_NEAR, _FAR_STEP)
    near = np.arange(-_NEAR, min(end, _NEAR) + _STEP, _STEP)
    D = np.concatenate([dense, near, np.arange(_NEAR + _FAR_STEP, end + _FAR_STEP, _FAR_STEP)]) - contact.heights.mean
    return contact.mean_height + contact.height_deviation * D


# Meniscus force of rough contacts while the menisci grow and reach further summits.


@dataclass(frozen=True)
class KineticMeniscus:
    """Statistical meniscus force at a time after contact.

    The force of a sphere that touches does not depend on the height of its meniscus; that of a
    summit at the distance d - z from the solid grows as 1 - (d - z)/s. So the force rises from that
    of the film to that of ``statistical``.

    Parameters
    ----------
    statistical
        Summits, liquid and film.
    growth
        Growth of one meniscus, of the same film.
    """

    statistical: StatisticalMeniscus
    growth: MeniscusGrowth
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998", "Gao1995")

    def at(self, time: ArrayLike, pressure: ArrayLike) -> WetPrediction:
        """Balance at ``time`` in s (>= 0) under external pressures in Pa, > 0; numbers or (n,),
        broadcast."""
        times, loads = np.broadcast_arrays(curve(time, "times (s)"), curve(pressure, "pressures (Pa)", positive=True))
        height = self.growth.height(times)[:, None]
        contact, film = self.statistical.contact, self.statistical.film_thickness
        unit = contact.height_deviation

        def pull(separation: RealArray) -> RealArray:
            D = contact.standardised(separation)
            return np.asarray(self.statistical.largest * caught(contact.heights, D, film / unit, height / unit))

        return balance(contact, pull, loads)


def caught(heights: SummitHeights, D: RealArray, film: float, height: ArrayLike) -> RealArray:
    """∫_D^∞ p ds + ∫_(D-H)^D [1 - (D - s)/S] p ds: mean force of a summit over that of one that
    touches.

    ``D`` separation, ``film`` H and meniscus ``height`` S >= H, all in standard deviations; D and S
    broadcast.
    """
    lowest = np.asarray(D, dtype=float) - film
    reached = heights.tail_moment(lowest, 0.0)
    # mean gap of the summits between film and contact, by parts
    gaps = film * reached - heights.tail_moment(lowest, 1.0) + heights.tail_moment(np.asarray(D, dtype=float), 1.0)
    return np.asarray(reached - gaps / np.asarray(height))


# Menisci of Greenwood-Williamson summits from plain numbers: heights of any skewness and kurtosis,
# at rest and growing.


WET = (
    Quantity("pressure", "Pa", "external load per nominal area"),
    Quantity("meniscus_pressure", "Pa", "meniscus force per nominal area"),
    Quantity("contact.pressure", "Pa", "what the summits carry"),
    Quantity("contact.area_fraction", "1", "real area per nominal area"),
    Quantity("contact.contact_density", "1/m^2", "contacts per nominal area"),
    Quantity("contact.separation", "m", "plane to mean plane of the undeformed surface"),
)
"""What wet summits answer."""


@dataclass(frozen=True)
class WetSummits(Theory):
    """Summits in a film of liquid, each pulled by the force of a sphere that touches it, against a
    smooth plane.

    With the load of the summits in ``GreenwoodWilliamson`` at the separation d, the film thickness
    h and F_0 of the heights,

        p_m = 2 π R γ (1 + cos θ) η F_0((d - h - z̄_s)/σ_s),  p + p_m = p_(solid)(d).

    ``theory`` is the ``asperity.theories.StatisticalMeniscus`` of these numbers.
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    surface_tension: SurfaceTension
    film_thickness: FilmThickness
    contact_angle: ContactAngle = 0.0
    mean_height: MeanHeight = 0.0
    skewness: SummitSkewness = 0.0
    kurtosis: SummitKurtosis = 3.0
    name: ClassVar[str] = "statistical-meniscus"
    title: ClassVar[str] = "Menisci of Greenwood-Williamson summits"
    citation_keys: ClassVar[tuple[str, ...]] = (*StatisticalMeniscus.citation_keys, "Kotwal1996")
    limits: ClassVar[tuple[Bound, ...]] = GreenwoodWilliamson.limits
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("theory.largest", "Pa", "meniscus force per area when every summit reaches the film"),
        Quantity("theory.pull_off", "Pa", "largest tension that the menisci hold"),
    )
    ways: ClassVar[tuple[Way, ...]] = (Way(PRESSURE, "at_pressure", WET),)

    def __post_init__(self) -> None:
        super().__post_init__()
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
        s = roughness.of_summits(cls.name)
        summits = (s.density, s.mean_radius, s.height_deviation)
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

    def validity(self, answer: WetPrediction, roughness: Roughness | None = None) -> tuple[Limit, ...]:
        """Conditions of the contact of the summits."""
        return self.theory.contact.validity(answer.contact)


@dataclass(frozen=True, eq=False, repr=False)
class GrownMenisci(Tabled):
    """Wet summits at times (n,): ``height`` of the menisci in m, ``meniscus_pressure`` and
    ``area_fraction``."""

    height: RealArray
    meniscus_pressure: RealArray
    area_fraction: RealArray


@dataclass(frozen=True)
class GrowingMenisci(Theory):
    """Wet summits whose menisci grow with time; Gaussian heights.

    With the disjoining pressure Π = A_H/(6πh³) of the film, y = s/s_eq and τ = t/t_0 the height s
    of a meniscus obeys

        dy/dτ = (1 - y)/y²,  s_(eq) = γ (1 + cos θ)/Π,  t_0 = 3 μ R ln(r_o/r_i) s_(eq)²/(h³ Π),

    and a summit at the distance g from the plane, within the film, is pulled by 1 - g/s of the
    force of one that touches. ``theory`` is the ``asperity.theories.KineticMeniscus`` of these
    numbers.
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    surface_tension: SurfaceTension
    film_thickness: FilmThickness
    viscosity: Annotated[Viscosity, Help("viscosity of the liquid", of="bodies")]
    hamaker_constant: Annotated[
        float, Number("energy", above=0.0), Help("Hamaker constant of solid, liquid and vapour", of="bodies")
    ]
    contact_angle: ContactAngle = 0.0
    radius_ratio: Annotated[
        Positive, Help("outer over inner radius of the film that feeds a meniscus", of="bodies")
    ] = 10.0
    name: ClassVar[str] = "kinetic-meniscus"
    title: ClassVar[str] = "Growing menisci of Greenwood-Williamson summits"
    citation_keys: ClassVar[tuple[str, ...]] = (*KineticMeniscus.citation_keys, "Greenwood1966")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("theory.growth.equilibrium_height", "m", "height at which the film holds back its liquid"),
        Quantity("theory.growth.time_scale", "s", "time scale of the growth"),
        Quantity("theory.growth.disjoining_pressure", "Pa", "disjoining pressure of the film"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("time", "s", "time after contact"),
            "at_time",
            (
                Quantity("height", "m", "height of the menisci"),
                Quantity("meniscus_pressure", "Pa", "meniscus force per nominal area"),
                Quantity("area_fraction", "1", "real area per nominal area"),
            ),
            (PRESSURE,),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
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
        times = curve(time, "times (s)")
        found = self.theory.at(times, pressure)
        return GrownMenisci(self.theory.growth.height(times), found.meniscus_pressure, found.contact.area_fraction)
