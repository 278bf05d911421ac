"""One liquid meniscus: Laplace and Kelvin equations, the adsorbed film, and the force between a
sphere and a flat.

Circular arcs, no gravity, menisci much lower than the sphere; the line force of the surface
tension, of relative order (height/radius)^(1/2), is left out. Sources: McFarlane & Tabor (1950),
Gao, Tian & Bhushan (1995), Bhushan (1998, eq. 55-67).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError

GAS_CONSTANT = 8.31446261815324
"""R in J/(mol K)."""

ROOM_TEMPERATURE = 293.15
"""20 °C in K."""


def wetting_factor(angle: float, other_angle: float = 0.0) -> float:
    """cos θ1 + cos θ2 of two contact angles in rad, 0 on the side that carries a film of the
    liquid.

    InputError if an angle is not between 0 and π, or the sum is not positive: such a liquid is
    pushed out of the gap.
    """
    for value in (angle, other_angle):
        if not 0.0 <= require.finite(value, "contact angle (rad)") <= math.pi:
            raise InputError(f"contact angle (rad) must be between 0 and π, but is {value:g}.")
    factor = math.cos(angle) + math.cos(other_angle)
    if factor <= 0.0:
        raise InputError(
            "contact angles must wet, cos θ1 + cos θ2 > 0, but are "
            f"{math.degrees(angle):.4g}° and {math.degrees(other_angle):.4g}°: no meniscus forms."
        )
    return factor


def laplace_pressure(surface_tension: float, height: float, wetting: float = 2.0) -> float:
    """Pressure deficit γ (cos θ1 + cos θ2)/s in Pa in a meniscus of ``height`` s in m, ``wetting``
    the sum of cosines."""
    gamma = require.positive(surface_tension, "surface tension (N/m)")
    return gamma * wetting / require.positive(height, "meniscus height (m)")


def kelvin_radius(
    humidity: float, surface_tension: float, molar_volume: float, temperature: float = ROOM_TEMPERATURE
) -> float:
    """r_K = γ V/(R T ln(1/RH)) in m: radius of a meniscus in equilibrium with vapour, as a positive
    number.

    ``humidity``: relative humidity as a fraction, 0 < RH < 1. Below about 0.5 the radius of water
    is that of a few molecules and the continuum a formality; ``surface_tension``: γ in N/m;
    ``molar_volume``: of the liquid, m³/mol; ``temperature``: in K.

    InputError if a number is out of its range.
    """
    share = require.between(
        humidity, 0.0, 1.0, "relative humidity", "At saturation the liquid fills everything; give the film instead."
    )
    energy = require.positive(surface_tension, "surface tension (N/m)")
    energy *= require.positive(molar_volume, "molar volume (m^3/mol)")
    return energy / (GAS_CONSTANT * require.positive(temperature, "temperature (K)") * -math.log(share))


def adsorbed_water_film(humidity: float) -> float:
    """Thickness in m of the water on a carbon-coated disk: 0.3 nm RH + 0.5 nm exp[20(RH - 1)]
    (Bhushan 1998, eq. 67).

    An empirical law of one surface; 0.8 nm at saturation, 0.15 nm at 50 %.
    """
    share = require.within(humidity, 0.0, 1.0, "relative humidity")
    return 0.3e-9 * share + 0.5e-9 * math.exp(20.0 * (share - 1.0))


def droplet_force(
    radius: float, surface_tension: float, wetting: float, *, gap: float = 0.0, immersion: float = math.inf
) -> float:
    """Attraction in N of a sphere to a flat by a ring of liquid around the nearest point: 2πRγ(cos
    θ1 + cos θ2)/(1 + D/d).

    Independent of the amount of liquid where sphere and flat touch (case A); with a ``gap`` D in m
    between them the sphere is immersed by d in m (case B, Bhushan 1998, fig. 35).
    """
    apart = require.not_negative(gap, "gap of sphere and flat (m)")
    gamma = require.positive(surface_tension, "surface tension (N/m)")
    touching = 2.0 * math.pi * require.positive(radius, "radius of the sphere (m)") * gamma * wetting
    return touching / (1.0 + apart / immersion)


def film_force(
    radius: float, surface_tension: float, angle: float, *, gap: float = 0.0, height: float = math.inf
) -> float:
    """Attraction in N of a sphere to a flat with a continuous film: 2πRγ(1 + cos θ)(1 - D/s), zero
    for D > s.

    ``angle`` θ in rad on the sphere, ``gap`` D and meniscus ``height`` s in m (case C, Bhushan
    1998, fig. 35).
    """
    apart = require.not_negative(gap, "gap of sphere and flat (m)")
    return droplet_force(radius, surface_tension, wetting_factor(angle)) * max(0.0, 1.0 - apart / height)


# Growth of a meniscus that draws liquid from the surrounding film, up to equilibrium with the
# disjoining pressure.
#
# A compact model of the kinetic meniscus of Bhushan, Kotwal & Chilamakuri (1998) with all of its
# trends, not a transcription.


@dataclass(frozen=True)
class MeniscusGrowth:
    """Height of the meniscus around a sphere that touches a film, against time.

    The suction γ(1 + cos θ)/s drives lubrication flow through the film towards the meniscus of
    volume πRs²; it ends when the suction equals the disjoining pressure A_H/(6πh³) of the film.
    With y = s/s_eq and τ = t/t0, dy/dτ = (1 - y)/y².

    InputError if a number is out of its range, or the film is so thin that it holds its liquid back
    (h >= s_eq).

    Parameters
    ----------
    radius
        R of the sphere in m.
    surface_tension
        γ in N/m.
    film_thickness
        h in m; the meniscus starts at s = h.
    viscosity
        Of the liquid in Pa s.
    hamaker_constant
        A_H of solid, liquid and vapour in J, about 1e-19.
    contact_angle
        θ in rad on the sphere.
    radius_ratio
        Outer over inner radius of the film that feeds the meniscus, > 1; only its logarithm enters.
    """

    radius: float
    surface_tension: float
    film_thickness: float
    viscosity: float
    hamaker_constant: float
    contact_angle: float = 0.0
    radius_ratio: float = 10.0
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998",)

    def __post_init__(self) -> None:
        require.positive(self.radius, "radius of the sphere (m)")
        require.positive(self.surface_tension, "surface tension (N/m)")
        require.positive(self.film_thickness, "film thickness (m)")
        require.positive(self.viscosity, "viscosity (Pa s)")
        require.positive(self.hamaker_constant, "Hamaker constant (J)")
        if not require.finite(self.radius_ratio, "ratio of radii of the film") > 1.0:
            raise InputError(f"ratio of radii of the film must be greater than one, but is {self.radius_ratio:g}.")
        if self.start >= 1.0:
            least = self.film_thickness * math.sqrt(self.start)
            raise InputError(
                f"film thickness (m) must be greater than {least:.3g} for a meniscus to grow, but is "
                f"{self.film_thickness:.3g}: so thin a film holds its liquid back."
            )

    @property
    def disjoining_pressure(self) -> float:
        """Π = A_H/(6πh³) of the film in Pa."""
        return self.hamaker_constant / (6.0 * math.pi * self.film_thickness**3)

    @property
    def equilibrium_height(self) -> float:
        """s_eq = γ(1 + cos θ)/Π in m."""
        return self.surface_tension * wetting_factor(self.contact_angle) / self.disjoining_pressure

    @property
    def start(self) -> float:
        """y0 = h/s_eq."""
        return self.film_thickness / self.equilibrium_height

    @property
    def time_scale(self) -> float:
        """t0 = 3 μ R ln(r_o/r_i) s_eq²/(h³ Π) in s."""
        flow = self.film_thickness**3 * self.disjoining_pressure
        return 3.0 * self.viscosity * self.radius * math.log(self.radius_ratio) * self.equilibrium_height**2 / flow

    def height(self, time: ArrayLike) -> RealArray:
        """Height s in m at ``time`` in s (any shape, >= 0)."""
        tau = np.asarray(time, dtype=float) / self.time_scale
        return np.asarray(self.equilibrium_height * grown(tau, self.start))

    def time_to(self, share: float) -> float:
        """Time in s until the meniscus has ``share`` of its equilibrium height; 0.99 is
        customary."""
        y = require.between(share, 0.0, 1.0, "share of the equilibrium height")
        return self.time_scale * max(0.0, float(_time(np.array(-math.log1p(-y)), self.start)))


def grown(tau: ArrayLike, start: float) -> RealArray:
    """y at the dimensionless times ``tau`` (any shape, >= 0) from y0 = ``start``, 0 <= y0 < 1."""
    from scipy.optimize import brentq

    times = np.asarray(tau, dtype=float)
    if not (np.isfinite(times).all() and (times >= 0.0).all()):
        raise InputError("times of a growing meniscus must be finite and not negative.")
    first = -math.log1p(-start)
    # in u = -ln(1 - y) the solution is τ later plus what is left of y²/2 + y, at most 3/2
    found = [
        brentq(lambda u, t=t: float(_time(np.array(u), start)) - t, first, first + t + 1.5, xtol=1e-15, rtol=1e-14)
        if t > 0.0
        else first
        for t in times.ravel()
    ]
    return np.asarray(-np.expm1(-np.array(found, dtype=float))).reshape(times.shape)


def _time(u: RealArray, start: float) -> RealArray:
    """τ at which y = 1 - exp(-u) is reached: (y0² - y²)/2 + y0 - y + ln[(1 - y0)/(1 - y)]."""
    y = -np.expm1(-u)
    return np.asarray((start - y) * (0.5 * (start + y) + 1.0) + u + math.log1p(-start))
