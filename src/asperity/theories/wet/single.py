"""One meniscus as a theory of the catalogue: a sphere in a droplet or a film, a meniscus in
equilibrium with vapour, and one that grows from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.scipy_parts import optimize
from ...core.values import Length, Number
from ..ask import Way, asked
from ..protocol import Theory, checked
from .feeds import DIFFUSIVITY, WATER_VAPOUR, VapourFeed
from .meniscus import ROOM_TEMPERATURE, adsorbed_water_film, droplet_force, film_force, kelvin_radius, wetting_factor

Tension: TypeAlias = Annotated[float, Number("N/m", above=0.0), Help("surface tension of the liquid", of="bodies")]
SphereRadius: TypeAlias = Annotated[Length, Help("radius R of the sphere", of="bodies")]
Angle: TypeAlias = Annotated[float, Number("angle"), Help("contact angle on the sphere", of="bodies")]

_SETTLED = 34.0
"""-ln(1 - s/s_eq) from which a meniscus is as high as it gets, to rounding."""

PULL: tuple[Way, ...] = (
    Way(
        asked("gap", "m", "gap D between sphere and flat, 0 where they touch"),
        "at_gap",
        (Quantity("force", "N", "attraction of sphere and flat"),),
    ),
)


@dataclass(frozen=True, eq=False, repr=False)
class PullAnswer(Tabled):
    """Attraction in N of sphere and flat; an array of any shape."""

    force: RealArray


@dataclass(frozen=True)
class DropletMeniscus(Theory):
    """Sphere and flat with a ring of liquid around the nearest point: touching (case A) or with a
    gap D (case B).

        F = 2 π R γ (cos θ_1 + cos θ_2)/(1 + D/d).

    d is the depth to which the liquid immerses the sphere. Case A has D = 0 and does not depend on
    the amount of liquid.

    Examples
    --------
    >>> water = DropletMeniscus(
    ...     radius=1e-6, surface_tension=0.073, contact_angle=0.0, immersion=5e-9
    ... )
    >>> print([f"{force:.3g}" for force in water.at_gap([0.0, 5e-9]).force])
    ['9.17e-07', '4.59e-07']
    """

    radius: SphereRadius
    surface_tension: Tension
    contact_angle: Angle
    immersion: Annotated[Length, Help("depth d to which the liquid immerses the sphere", of="bodies")]
    other_angle: Annotated[float, Number("angle"), Help("contact angle on the flat", of="bodies")] = 0.0
    name: ClassVar[str] = "droplet-meniscus"
    title: ClassVar[str] = "Meniscus of a sphere, droplet"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "McFarlane1950")
    ways: ClassVar[tuple[Way, ...]] = PULL

    def __post_init__(self) -> None:
        super().__post_init__()
        wetting_factor(self.contact_angle, self.other_angle)

    def at_gap(self, gap: ArrayLike) -> PullAnswer:
        """Attraction with the ``gap`` D in m, >= 0, of any shape."""
        apart = checked(gap, "gap of sphere and flat (m)")
        wetting = wetting_factor(self.contact_angle, self.other_angle)
        touching = droplet_force(self.radius, self.surface_tension, wetting)
        return PullAnswer(np.asarray(touching / (1.0 + apart / self.immersion)))


@dataclass(frozen=True)
class FilmMeniscus(Theory):
    """Sphere above a flat with a continuous film of liquid (case C); no force for D > s.

        F = 2 π R γ (1 + cos θ)(1 - D/s)  (D ≤ s).

    s is the height of the meniscus, at most that of the film before.
    """

    radius: SphereRadius
    surface_tension: Tension
    contact_angle: Angle
    height: Annotated[Length, Help("height s of the meniscus", of="bodies")]
    name: ClassVar[str] = "film-meniscus"
    title: ClassVar[str] = "Meniscus of a sphere, film"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Gao1995")
    ways: ClassVar[tuple[Way, ...]] = PULL

    def __post_init__(self) -> None:
        super().__post_init__()
        wetting_factor(self.contact_angle)

    def at_gap(self, gap: ArrayLike) -> PullAnswer:
        """Attraction with the ``gap`` D in m, >= 0, of any shape."""
        apart = checked(gap, "gap of sphere and flat (m)")
        touching = film_force(self.radius, self.surface_tension, self.contact_angle)
        return PullAnswer(np.asarray(touching * np.maximum(0.0, 1.0 - apart / self.height)))


@dataclass(frozen=True, eq=False, repr=False)
class VapourAnswer(Tabled):
    """Kelvin radius in m, pressure deficit in Pa and film on carbon in m; arrays of one shape."""

    kelvin_radius: RealArray
    deficit: RealArray
    water_film: RealArray


@dataclass(frozen=True)
class VapourMeniscus(Theory):
    """Meniscus in equilibrium with vapour of the relative humidity φ, and the water adsorbed on a
    carbon-coated disk.

        r_K = γ V/(R T ln(1/φ)),  Δp = γ/r_K.

    The film, 0.3 nm φ + 0.5 nm exp[20(φ - 1)], is an empirical law of one surface, for water alone.

    Examples
    --------
    >>> water = VapourMeniscus(surface_tension=0.07275, molar_volume=1.8048e-5)
    >>> print(f"{float(water.at_humidity(0.5).kelvin_radius) * 1e9:.3f} nm")
    0.777 nm
    """

    surface_tension: Tension
    molar_volume: Annotated[float, Number("m^3/mol", above=0.0), Help("molar volume of the liquid", of="bodies")]
    temperature: Annotated[float, Number("temperature", above=0.0), Help("temperature", of="bodies")] = ROOM_TEMPERATURE
    name: ClassVar[str] = "vapour-meniscus"
    title: ClassVar[str] = "Kelvin radius and adsorbed film against humidity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998",)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("humidity", "", "relative humidity, between 0 and 1"),
            "at_humidity",
            (
                Quantity("kelvin_radius", "m", "radius of a meniscus in equilibrium with the vapour"),
                Quantity("deficit", "Pa", "pressure below that of the air in it"),
                Quantity("water_film", "m", "water adsorbed on a carbon-coated disk"),
            ),
        ),
    )

    def at_humidity(self, humidity: ArrayLike) -> VapourAnswer:
        """Menisci and film at the relative ``humidity``, between 0 and 1, of any shape."""
        shares = checked(humidity, "relative humidity")
        if not np.all((shares > 0.0) & (shares < 1.0)):
            wrong = float(shares.max() if shares.max() >= 1.0 else shares.min())
            raise InputError(f"relative humidity must be greater than 0 and less than 1, but is {wrong:g}.")
        numbers = self.surface_tension, self.molar_volume, self.temperature
        radius = np.array([kelvin_radius(float(share), *numbers) for share in shares.ravel()]).reshape(shares.shape)
        film = np.array([adsorbed_water_film(float(share)) for share in shares.ravel()]).reshape(shares.shape)
        return VapourAnswer(radius, self.surface_tension / radius, film)


@dataclass(frozen=True, eq=False, repr=False)
class GrownAnswer(Tabled):
    """Height in m and volume in m³ of a growing meniscus, and its height over that of equilibrium;
    arrays of one shape."""

    height: RealArray
    volume: RealArray
    share: RealArray


@dataclass(frozen=True)
class VapourGrowth(Theory):
    """Meniscus around a touching sphere that condenses from vapour of the relative humidity φ.

    Vapour diffuses through the wedge to the meniscus of the volume π R s², whose vapour pressure is
    Kelvin's:

        ds/dt = (2 D/R) V c_s [φ - exp(-λ/s)],  λ = γ c V/(R_g T),  c_s = p_s/(R_g T).

    c is the sum of cosines. Free diffusion: gaps are below the mean free path of 0.1 µm, in which
    vapour is slower by about its ratio to the gap, so that times are lower bounds.

    Examples
    --------
    >>> water = {"surface_tension": 0.07275, "molar_volume": 1.8048e-5}
    >>> ball = VapourGrowth(radius=1e-3, **water, humidity=0.99, start=0.6e-9)
    >>> print(f"{ball.equilibrium_height * 1e9:.0f} nm, 99 % of it after {ball.settling:.1f} s")
    107 nm, 99 % of it after 46.5 s
    """

    radius: SphereRadius
    surface_tension: Tension
    molar_volume: Annotated[float, Number("m^3/mol", above=0.0), Help("molar volume of the liquid", of="bodies")]
    humidity: Annotated[float, Number("1", above=0.0, below=1.0), Help("relative humidity φ", of="bodies")]
    start: Annotated[Length, Help("height at the beginning, that of the adsorbed film", of="bodies")]
    contact_angle: Angle = 0.0
    other_angle: Annotated[float, Number("angle"), Help("contact angle on the flat", of="bodies")] = 0.0
    vapour_pressure: Annotated[
        float, Number("pressure", above=0.0), Help("saturation pressure of the vapour", of="bodies")
    ] = WATER_VAPOUR
    diffusivity: Annotated[float, Number("m^2/s", above=0.0), Help("of the vapour in air", of="bodies")] = DIFFUSIVITY
    temperature: Annotated[float, Number("temperature", above=0.0), Help("temperature", of="bodies")] = ROOM_TEMPERATURE
    name: ClassVar[str] = "vapour-growth"
    title: ClassVar[str] = "Meniscus of a sphere that grows from vapour"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kohonen1999", "Bhushan1998")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("equilibrium_height", "m", "height in equilibrium with the vapour"),
        Quantity("settling", "s", "time to 99 % of that height"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("time", "s", "time after contact"),
            "at_time",
            (
                Quantity("height", "m", "height of the meniscus"),
                Quantity("volume", "m^3", "volume of the liquid"),
                Quantity("share", "1", "height over that of equilibrium"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.start < self.equilibrium_height:
            raise InputError(
                f"height at the beginning (m) must be less than {self.equilibrium_height:.3g}, that of equilibrium, "
                f"for a meniscus to grow, but is {self.start:.3g}."
            )

    @property
    def feed(self) -> VapourFeed:
        """What the vapour brings."""
        wetting = wetting_factor(self.contact_angle, self.other_angle)
        liquid = (self.surface_tension, self.molar_volume, self.humidity, self.vapour_pressure)
        return VapourFeed(*liquid, self.diffusivity, wetting, self.temperature)

    @property
    def equilibrium_height(self) -> float:
        """Height in m in equilibrium with the vapour."""
        return self.feed.equilibrium_height

    @property
    def settling(self) -> float:
        """Time in s to 99 % of it."""
        return self.time_to(max(0.99 * self.equilibrium_height, self.start))

    def time_to(self, height: float) -> float:
        """Time in s until the meniscus has this ``height`` in m, from the beginning to
        equilibrium."""
        return self.feed.time_on_sphere(self.radius, self.start, height)

    def at_time(self, time: ArrayLike) -> GrownAnswer:
        """Meniscus at the ``time`` in s, >= 0, of any shape."""
        times, final = checked(time, "time (s)"), self.equilibrium_height
        if not np.all(times >= 0.0):
            raise InputError(f"time (s) must not be negative, but is {float(times.min()):g}.")
        first = -math.log1p(-self.start / final)

        def late(u: float, moment: float) -> float:
            return self.time_to(-final * math.expm1(-u)) - moment

        found = []
        for moment in times.ravel():
            last = first + 1.0
            while last < _SETTLED and late(last, float(moment)) < 0.0:
                last += 1.0
            high = last >= _SETTLED
            found.append(
                final
                if high
                else -final * math.expm1(-optimize.brentq(late, first, last, (float(moment),), rtol=1e-13))
            )
        heights = np.array(found, dtype=float).reshape(times.shape)
        return GrownAnswer(heights, np.asarray(math.pi * self.radius * heights**2), heights / final)
