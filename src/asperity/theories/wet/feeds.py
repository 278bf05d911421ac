"""What brings liquid to a growing meniscus: the film around it, a flooded gap, or vapour; volumes
per time against its height."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from ...core import require
from ...core.errors import InputError
from ...core.quadrature import gauss
from .meniscus import GAS_CONSTANT, ROOM_TEMPERATURE, kelvin_radius, laplace_pressure

DIFFUSIVITY = 2.42e-5
"""Of water vapour in air at 20 °C, m²/s."""

WATER_VAPOUR = 2339.0
"""Saturation pressure of water at 20 °C, Pa."""


class Feed(Protocol):
    """How fast liquid comes to a meniscus."""

    @property
    def equilibrium_height(self) -> float:
        """Height in m at which nothing comes any more; infinite where there is none."""

    def flow(self, height: float) -> float:
        """Volume per time Q in m³/s to a meniscus of this ``height`` s in m, > 0."""


@dataclass(frozen=True)
class FilmFeed:
    """Viscous flow through the film around the meniscus, which holds its liquid back.

    The lubrication flow of a film of the thickness h between the radii r_i and r_o:

        Q = 2 π h³/(3 μ ln(r_o/r_i)) [γ c/s - Π].

    Parameters
    ----------
    surface_tension
        γ in N/m, > 0.
    film_thickness
        h in m, > 0.
    viscosity
        μ in Pa s, > 0.
    disjoining_pressure
        Π of the film in Pa, >= 0.
    wetting
        c, the sum of the cosines of both contact angles.
    radius_ratio
        r_o/r_i > 1; only its logarithm enters.

    Raises
    ------
    InputError
        If a number is out of its range.
    """

    surface_tension: float
    film_thickness: float
    viscosity: float
    disjoining_pressure: float = 0.0
    wetting: float = 2.0
    radius_ratio: float = 10.0
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998",)

    def __post_init__(self) -> None:
        laplace_pressure(self.surface_tension, self.film_thickness, self.wetting)
        require.positive(self.viscosity, "viscosity (Pa s)")
        require.not_negative(self.disjoining_pressure, "disjoining pressure (Pa)")
        if not require.finite(self.radius_ratio, "ratio of radii of the film") > 1.0:
            raise InputError(f"ratio of radii of the film must be greater than one, but is {self.radius_ratio:g}.")

    @property
    def equilibrium_height(self) -> float:
        """γ c/Π in m."""
        return _height(self.surface_tension * self.wetting, self.disjoining_pressure)

    def flow(self, height: float) -> float:
        """Q in m³/s at the ``height`` s in m."""
        pull = laplace_pressure(self.surface_tension, height, self.wetting) - self.disjoining_pressure
        return 2.0 * math.pi * self.film_thickness**3 * pull / (3.0 * self.viscosity * math.log(self.radius_ratio))


@dataclass(frozen=True)
class FloodedFeed:
    """Viscous flow through a gap that is flooded outside the meniscus.

    From the resistance ∫ 12 μ dr/(2 π r g³) of the wedge g = r²/2R around a sphere:

        Q = π s³/μ [γ c/s - Π].

    Parameters as of ``FilmFeed``.

    Raises
    ------
    InputError
        If a number is out of its range.
    """

    surface_tension: float
    viscosity: float
    disjoining_pressure: float = 0.0
    wetting: float = 2.0
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998",)

    def __post_init__(self) -> None:
        laplace_pressure(self.surface_tension, 1.0, self.wetting)
        require.positive(self.viscosity, "viscosity (Pa s)")
        require.not_negative(self.disjoining_pressure, "disjoining pressure (Pa)")

    @property
    def equilibrium_height(self) -> float:
        """γ c/Π in m."""
        return _height(self.surface_tension * self.wetting, self.disjoining_pressure)

    def flow(self, height: float) -> float:
        """Q in m³/s at the ``height`` s in m."""
        pull = laplace_pressure(self.surface_tension, height, self.wetting) - self.disjoining_pressure
        return math.pi * height**3 * pull / self.viscosity


@dataclass(frozen=True)
class VapourFeed:
    """Diffusion of vapour through the wedge around the meniscus, whose own vapour pressure follows
    from its height (Kelvin).

        Q = 4 π D s V c_s [φ - exp(-λ/s)],  λ = γ c V/(R_g T),  c_s = p_s/(R_g T).

    The conductance 4 π D s does not contain the radius of the sphere. In gaps below the mean free
    path of the vapour, 0.1 µm in air, diffusion is slower, so that times are lower bounds.

    Parameters
    ----------
    surface_tension
        γ in N/m, > 0.
    molar_volume
        V of the liquid in m³/mol, > 0.
    humidity
        Relative humidity φ, a fraction between 0 and 1.
    vapour_pressure
        Saturation pressure p_s in Pa, > 0.
    diffusivity
        D of the vapour in air in m²/s, > 0.
    wetting
        c, the sum of the cosines of both contact angles.
    temperature
        T in K, > 0.

    Raises
    ------
    InputError
        If a number is out of its range.
    """

    surface_tension: float
    molar_volume: float
    humidity: float
    vapour_pressure: float = WATER_VAPOUR
    diffusivity: float = DIFFUSIVITY
    wetting: float = 2.0
    temperature: float = ROOM_TEMPERATURE
    citation_keys: ClassVar[tuple[str, ...]] = ("Kohonen1999",)

    def __post_init__(self) -> None:
        laplace_pressure(self.surface_tension, 1.0, self.wetting)
        kelvin_radius(self.humidity, self.surface_tension, self.molar_volume, self.temperature)
        require.positive(self.vapour_pressure, "saturation pressure of the vapour (Pa)")
        require.positive(self.diffusivity, "diffusivity of the vapour (m^2/s)")

    @property
    def length(self) -> float:
        """λ in m."""
        return self.surface_tension * self.wetting * self.molar_volume / (GAS_CONSTANT * self.temperature)

    @property
    def equilibrium_height(self) -> float:
        """λ/ln(1/φ) in m."""
        return self.length / -math.log(self.humidity)

    @property
    def rate(self) -> float:
        """4 π D V c_s φ in m²/s: the flow over the height of a meniscus that takes all vapour."""
        concentration = self.vapour_pressure / (GAS_CONSTANT * self.temperature)
        return 4.0 * math.pi * self.diffusivity * self.molar_volume * concentration * self.humidity

    def flow(self, height: float) -> float:
        """Q in m³/s at the ``height`` s in m."""
        missing = self.length / require.positive(height, "meniscus height (m)") + math.log(self.humidity)
        return -self.rate * height * math.expm1(-missing)

    def time_on_sphere(self, radius: float, start: float, height: float) -> float:
        """Time in s in which the meniscus around a touching sphere of ``radius`` R in m, whose
        volume is π R s², grows from ``start`` to ``height`` (m), both below equilibrium.

        The substitution s = s_eq (1 - exp(-u)) takes the pole at equilibrium out.
        """
        final = self.equilibrium_height
        low, high = (-math.log1p(-each / final) for each in (start, height))
        u, weights = gauss(np.linspace(low, high, 2 + math.ceil(4.0 * (high - low))), 20)
        rest = np.exp(-u)
        missing = -math.log(self.humidity) * rest / -np.expm1(-u)
        slowness = final * rest / -np.expm1(-missing)
        return 2.0 * math.pi * radius / self.rate * float((weights * slowness).sum())


def _height(pull: float, held: float) -> float:
    return pull / held if held > 0.0 else math.inf
