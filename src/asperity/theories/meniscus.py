"""One liquid meniscus: Laplace and Kelvin equations, the adsorbed film, and the force between a sphere and a flat.

Circular arcs, no gravity, menisci much lower than the sphere; the line force of the surface tension, of relative order
(height/radius)^(1/2), is left out. Sources: McFarlane & Tabor (1950), Gao, Tian & Bhushan (1995), Bhushan (1998, eq. 55-67).
"""

from __future__ import annotations

import math

from ..core import require
from ..core.errors import InputError

GAS_CONSTANT = 8.31446261815324
"""R in J/(mol K)."""

ROOM_TEMPERATURE = 293.15
"""20 °C in K."""


def wetting_factor(angle: float, other_angle: float = 0.0) -> float:
    """cos θ1 + cos θ2 of two contact angles in rad, 0 on the side that carries a film of the liquid.

    Raises
    ------
    InputError
        If an angle is not between 0 and π, or the sum is not positive: such a liquid is pushed out of the gap.
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
    """Pressure deficit γ (cos θ1 + cos θ2)/s in Pa in a meniscus of ``height`` s in m, ``wetting`` the sum of cosines."""
    gamma = require.positive(surface_tension, "surface tension (N/m)")
    return gamma * wetting / require.positive(height, "meniscus height (m)")


def kelvin_radius(
    humidity: float, surface_tension: float, molar_volume: float, temperature: float = ROOM_TEMPERATURE
) -> float:
    """r_K = γ V/(R T ln(1/RH)) in m: radius of a meniscus in equilibrium with vapour, as a positive number.

    Parameters
    ----------
    humidity
        Relative humidity as a fraction, 0 < RH < 1. Below about 0.5 the radius of water is that of a few molecules
        and the continuum a formality.
    surface_tension
        γ in N/m.
    molar_volume
        Of the liquid, m³/mol.
    temperature
        In K.

    Raises
    ------
    InputError
        If a number is out of its range.
    """
    share = require.between(
        humidity, 0.0, 1.0, "relative humidity", "At saturation the liquid fills everything; give the film instead."
    )
    energy = require.positive(surface_tension, "surface tension (N/m)")
    energy *= require.positive(molar_volume, "molar volume (m^3/mol)")
    return energy / (GAS_CONSTANT * require.positive(temperature, "temperature (K)") * -math.log(share))


def adsorbed_water_film(humidity: float) -> float:
    """Thickness in m of the water on a carbon-coated disk: 0.3 nm RH + 0.5 nm exp[20(RH - 1)] (Bhushan 1998, eq. 67).

    An empirical law of one surface; 0.8 nm at saturation, 0.15 nm at 50 %.
    """
    share = require.within(humidity, 0.0, 1.0, "relative humidity")
    return 0.3e-9 * share + 0.5e-9 * math.exp(20.0 * (share - 1.0))


def droplet_force(
    radius: float, surface_tension: float, wetting: float, *, gap: float = 0.0, immersion: float = math.inf
) -> float:
    """Attraction in N of a sphere to a flat by a ring of liquid around the nearest point: 2πRγ(cos θ1 + cos θ2)/(1 + D/d).

    Independent of the amount of liquid where sphere and flat touch (case A); with a ``gap`` D in m between them the
    sphere is immersed by d in m (case B, Bhushan 1998, fig. 35).
    """
    apart = require.not_negative(gap, "gap of sphere and flat (m)")
    return _touching(radius, surface_tension, wetting) / (1.0 + apart / immersion)


def film_force(
    radius: float, surface_tension: float, angle: float, *, gap: float = 0.0, height: float = math.inf
) -> float:
    """Attraction in N of a sphere to a flat with a continuous film: 2πRγ(1 + cos θ)(1 - D/s), zero for D > s.

    ``angle`` θ in rad on the sphere, ``gap`` D and meniscus ``height`` s in m (case C, Bhushan 1998, fig. 35).
    """
    apart = require.not_negative(gap, "gap of sphere and flat (m)")
    return _touching(radius, surface_tension, wetting_factor(angle)) * max(0.0, 1.0 - apart / height)


def _touching(radius: float, surface_tension: float, wetting: float) -> float:
    gamma = require.positive(surface_tension, "surface tension (N/m)")
    return 2.0 * math.pi * require.positive(radius, "radius of the sphere (m)") * gamma * wetting
