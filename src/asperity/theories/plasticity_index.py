"""Interferences at which a summit yields, and the plasticity indices made of them (Greenwood & Williamson 1966; Bhushan 1998).

Three indices are in use for the same surface: say which one is meant.
"""

from __future__ import annotations

import math

from ..core import require
from .single_contact import poissons_ratio

HARDNESS_OVER_YIELD = 2.8
"""H/Y of full plasticity (Tabor 1951)."""


def hardness_coefficient(nu: float) -> float:
    """K = 0.454 + 0.41ν of p0 = K H at first yield of a sphere, the later form of Chang, Etsion & Bogy (1987); ``nu`` from 0 to 0.5.

    With H = 2.8Y within 2.2 % of the exact value (``sphere_yield_onset``), 0.2 % at ν = 0.3.
    """
    return 0.454 + 0.41 * poissons_ratio(nu)


def yield_coefficient(nu: float) -> float:
    """C = 1.295 exp(0.736ν) of p0 = C Y at first yield (Jackson & Green 2005): within 0.4 % of the exact value."""
    return 1.295 * math.exp(0.736 * poissons_ratio(nu))


def nominal_interference(E_star: float, radius: float, hardness: float) -> float:
    """δ_p = R (H/E*)² in m, the round number of Greenwood & Williamson; first yield at p_m = H/3 has (π²/16) δ_p."""
    return _positive(radius, "radius (m)") * (_positive(hardness, "hardness (Pa)") / _modulus(E_star)) ** 2


def critical_interference(E_star: float, radius: float, peak: float) -> float:
    """ω_c = (π p0/2E*)² R in m at which the Hertz pressure of a sphere reaches the ``peak`` p0 in Pa.

    p0 = K H for Chang, Etsion & Bogy and Kogut & Etsion, C Y for Jackson & Green.
    """
    return (
        _positive(radius, "radius (m)")
        * (0.5 * math.pi * _positive(peak, "peak pressure (Pa)") / _modulus(E_star)) ** 2
    )


def summit_plasticity_index(height_deviation: float, interference: float) -> float:
    """ψ = sqrt(σ_s/δ): deviation of the summit heights over the ``interference`` of yield, both in m, > 0.

    With δ_p (``nominal_interference``) ψ = (E*/H) sqrt(σ_s/R) of Greenwood & Williamson: below 0.6 elastic at any
    realistic load, above 1 plastic at any. With ω_c it is ψ_c of Chang, Etsion & Bogy, 1.1 times larger at ν = 0.3.
    """
    return math.sqrt(
        _positive(height_deviation, "deviation of summit heights (m)") / _positive(interference, "interference (m)")
    )


def profile_plasticity_index(E_star: float, hardness: float, deviation: float, correlation_length: float) -> float:
    """ψ = (E*/H)(σ/β*) of Whitehouse & Archard, β* the ``correlation_length`` (1/e) of an exponential autocorrelation in m.

    Onions & Archard (1973): plastic flow is most unlikely below 0.25 and happens at trivial loads above 0.45.
    """
    slope = _positive(deviation, "deviation of heights (m)") / _positive(correlation_length, "correlation length (m)")
    return _modulus(E_star) / _positive(hardness, "hardness (Pa)") * slope


def _positive(value: float, what: str) -> float:
    return require.positive(value, what)


def _modulus(E_star: float) -> float:
    return require.positive(E_star, "contact modulus E_star (Pa)")
