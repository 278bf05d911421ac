"""One meniscus as a theory of the catalogue: a sphere in a droplet or a film, and a meniscus in
equilibrium with vapour."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length, Number
from ..ask import Way, asked
from ..protocol import Theory, checked
from .meniscus import ROOM_TEMPERATURE, adsorbed_water_film, droplet_force, film_force, kelvin_radius, wetting_factor

Tension: TypeAlias = Annotated[float, Number("N/m", above=0.0), Help("surface tension of the liquid", of="bodies")]
SphereRadius: TypeAlias = Annotated[Length, Help("radius R of the sphere", of="bodies")]
Angle: TypeAlias = Annotated[float, Number("angle"), Help("contact angle on the sphere", of="bodies")]

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
