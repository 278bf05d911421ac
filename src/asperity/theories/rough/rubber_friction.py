"""Hysteretic friction of rubber on a rough surface by Persson's theory (2001), from the power spectrum and the complex modulus."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.quadrature import gauss
from .persson import IsotropicSpectrum

_POINTS = 801
"""Wavenumbers between two of the table; odd."""

_ANGLES, _DECAY = 24, 46.0
"""Panels of the angle from the direction across the motion, and the e-folds over which they shrink towards it."""


@dataclass(frozen=True, eq=False)
class RubberFriction:
    """Friction and contact area while sliding.

    Attributes
    ----------
    friction
        Coefficient of hysteretic friction.
    area_fraction
        Contact area over nominal area at the largest wavenumber of the spectrum.
    wavenumber
        (n,), rad/m.
    cumulative_friction
        (n,): friction by all waves up to each wavenumber.
    magnification_area
        (n,): contact area over nominal area at that magnification.
    """

    friction: float
    area_fraction: float
    wavenumber: RealArray
    cumulative_friction: RealArray
    magnification_area: RealArray


def rubber_friction(
    spectrum: IsotropicSpectrum,
    modulus: Callable[[RealArray], ComplexArray],
    *,
    speed: float,
    pressure: float,
    reduction: float = 1.0,
) -> RubberFriction:
    """Friction coefficient by Persson (2001), eqs. 58-60, of a hard rough surface that slides over a viscoelastic half-space.

    .. math::

        \\mu = \\tfrac12\\int dq\\,q^3 C(q) S(q) P(q) \\int_0^{2\\pi} d\\phi\\,\\cos\\phi\\,
        \\frac{\\mathrm{Im}\\,E(qv\\cos\\phi)}{\\sigma_0}

    with P = erf(1/2√G) and G = 1/8 ∫ dq q³ C ∫ dφ |E(qv cos φ)/σ0|², C here being that of <h²> = ∫ C d²q. All waves up to the largest
    of the spectrum count; the shortest dominate, so that where the spectrum ends must be stated with the result.

    Parameters
    ----------
    spectrum
        Of the rough surface.
    modulus
        Complex plane-strain modulus E/(1 - nu²) in Pa at angular frequencies (any shape) in rad/s, for the time dependence exp(+i omega t);
        ``Viscoelastic.contact_relaxation.complex_modulus``.
    speed
        v in m/s, > 0.
    pressure
        Nominal pressure in Pa, > 0.
    reduction
        gamma in S = gamma + (1 - gamma) P², 0 < gamma <= 1: how much less the rubber follows in partial contact; 1 leaves it out, about
        1/2 is usual.

    Raises
    ------
    InputError
        If a number is outside its range.
    """
    v, sigma = require.positive(speed, "sliding speed (m/s)"), require.positive(pressure, "nominal pressure (Pa)")
    gamma = require.at_most(reduction, 1.0, "reduction factor gamma of the deformation")
    from scipy.integrate import cumulative_simpson
    from scipy.special import erf

    cosine, weight = _quarter()
    ends, steepness, spread = np.asarray(spectrum.wavenumber), [], []
    waves = []
    for low, high in pairwise(ends):
        q = np.geomspace(low, high, _POINTS)
        E = modulus(v * q[:, None] * cosine) / sigma
        density = q**4 * spectrum.at(np.log(q / ends[0])) / (2.0 * np.pi) ** 2  # q³ C dq = q⁴ C d ln q
        waves.append(q)
        spread.append(0.5 * density * (np.abs(E) ** 2 @ weight))
        steepness.append(2.0 * density * ((cosine * E.imag) @ weight))
    G, mu, shares, friction, areas = 0.0, 0.0, [], [], []
    for q, of_G, of_mu in zip(waves, spread, steepness, strict=True):
        x = np.log(q)
        spreads = G + cumulative_simpson(of_G, x=x, initial=0.0)
        with np.errstate(divide="ignore"):
            P = erf(0.5 / np.sqrt(spreads))
        follows = gamma + (1.0 - gamma) * P**2
        sums = mu + cumulative_simpson(of_mu * follows * P, x=x, initial=0.0)
        G, mu = float(spreads[-1]), float(sums[-1])
        shares.append(q)
        friction.append(sums)
        areas.append(P)
    return RubberFriction(mu, float(areas[-1][-1]), *map(np.concatenate, (shares, friction, areas)))


def _quarter() -> tuple[RealArray, RealArray]:
    """cos phi and weights over a quarter turn, dense where the motion is along the wave's crests and the frequency goes to zero."""
    w, share = gauss(np.linspace(0.0, _DECAY, _ANGLES + 1), 8)
    angle = 0.5 * np.pi * np.exp(-w)
    return np.sin(angle), share * angle
