"""What steady heat does to the surface it enters: bulge, stress along the surface, and the wave
that grows by it.

Half-spaces that are elastically homogeneous, their surface free of traction, with temperatures that
fall as exp(-s z) below each wave of the surface temperature.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from .impedance import Speed, decay

CITATION_KEYS = ("Burton1980",)
"""Papers behind the critical wavelength."""


def bulge(
    qx: ArrayLike,
    qy: ArrayLike,
    diffusivity: float,
    expansion: float,
    nu: float,
    speed: Speed = 0.0,
) -> ComplexArray:
    """û/T̂ = 2 α (1 + ν)/(s + q) in m/K, out of the solid, per surface temperature of the wave
    (``qx``, ``qy``) in rad/m; times ``impedance`` it is that per flux.

    Parameters
    ----------
    diffusivity
        κ in m²/s, > 0.
    expansion
        Coefficient α of thermal expansion in 1/K.
    nu
        Poisson's ratio.
    speed
        Of the material in m/s.
    """
    q, s = np.hypot(qx, qy), decay(qx, qy, diffusivity, speed)
    return np.asarray(2.0 * expansion * (1.0 + nu) / (s + q))


class SurfaceStress(NamedTuple):
    """Stresses of a free surface per surface temperature in Pa/K, tension positive."""

    xx: ComplexArray
    yy: ComplexArray
    xy: ComplexArray


def surface_stress(
    qx: ArrayLike, qy: ArrayLike, diffusivity: float, hindered: float, nu: float, speed: Speed = 0.0
) -> SurfaceStress:
    """Stresses in the surface per surface temperature of the wave (``qx``, ``qy``) in rad/m, not
    both zero; other arguments as of ``bulge``.

    -E α/(1 - ν) times (s - q)/(s + q) along the wavevector, and 1 - 2 ν q/(s + q) across it.

    Parameters
    ----------
    hindered
        E α in Pa/K, Young's modulus times thermal expansion.
    """
    qx, qy = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    q, s = np.hypot(qx, qy), decay(qx, qy, diffusivity, speed)
    scale = -hindered / (1.0 - nu)
    along, across = scale * (s - q) / (s + q), scale * (1.0 - 2.0 * nu * q / (s + q))
    c, n = qx / q, qy / q
    return SurfaceStress(along * c**2 + across * n**2, along * n**2 + across * c**2, (along - across) * c * n)


def critical_wavelength(
    friction: float, speed: float, expansion: float, nu: float, E_star: float, conductivity: float
) -> float:
    """λ_c = 4π k/(μ v α (1 + ν) E*) in m: longer waves of the pressure grow, of a conductor that
    slides on an insulator (Burton 1980); infinite without friction or motion.

    Parameters
    ----------
    friction
        Coefficient μ of friction, >= 0.
    speed
        v in m/s, >= 0.
    expansion, nu
        α in 1/K, and Poisson's ratio, of the conductor.
    E_star
        Contact modulus of both in Pa, > 0.
    conductivity
        k in W/(m K) of the conductor, > 0.

    Examples
    --------
    Bearing steel at 1 m/s:

    >>> round(1e3 * critical_wavelength(0.3, 1.0, 12e-6, 0.3, 115e9, 46.0), 2)  # mm
    1.07
    """
    made = require.not_negative(friction, "coefficient of friction") * require.not_negative(speed, "speed (m/s)")
    k = require.positive(conductivity, "thermal conductivity (W/m/K)")
    heating = made * expansion * (1.0 + nu) * require.positive(E_star, "contact modulus E* (Pa)") / k
    return 4.0 * math.pi / heating if heating else math.inf


def growth_rate(q: ArrayLike, diffusivity: float, critical: float) -> RealArray:
    """Γ = κ (s² - q²) in 1/s of waves ``q`` > 0 in rad/m, s = (sqrt(q² + 4 q H) - q)/2, H = 4π/λ_c
    of the ``critical`` wavelength in m; ``diffusivity`` κ in m²/s."""
    waves = np.asarray(q, dtype=float)
    if not np.all(waves > 0.0):
        raise InputError(f"wavenumbers (rad/m) must be greater than zero, but the smallest is {waves.min():g}.")
    if not critical > 0.0:
        raise InputError(f"critical wavelength (m) must be greater than zero, but is {critical!r}.")
    s = 0.5 * (np.sqrt(waves**2 + 16.0 * math.pi * waves / critical) - waves)
    return np.asarray(diffusivity * (s**2 - waves**2))
