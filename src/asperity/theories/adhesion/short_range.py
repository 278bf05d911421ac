"""Adhesion of infinitely short range: JKR's contacts of any power-law profile, of a cylinder, of a
wave, and of a coated sphere.

Detachment by Griffith's criterion at the edge of the contact. Loads and approaches are positive
where they press.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.quadrature import gauss


@dataclass(frozen=True)
class ShortRangeState:
    """A contact: radius or half-width (m), load (N, or N/m of a line contact) and approach (m; NaN
    of a cylinder)."""

    radius: float
    load: float
    approach: float


@dataclass(frozen=True)
class PowerLawJKR:
    """Profile B r^n against a half-space, with adhesion in the contact alone.

        P = P_H(a) - sqrt(8π E* w a³),  δ = δ_H(a) - sqrt(2π a w/E*),  δ_H = n κ B a^n,
        P_H = 2E* n/(n+1) δ_H a,

    κ = ∫ t^(n-1)/sqrt(1 - t²) dt over 0 < t < 1 (Johnson, Kendall & Roberts 1971 for n = 2).

    Parameters
    ----------
    E_star, exponent, coefficient, work
        Contact modulus in Pa, n >= 1, B in m^(1-n), work of adhesion in J/m², > 0.
    """

    E_star: float
    exponent: float
    coefficient: float
    work: float

    @property
    def _nk(self) -> float:
        n = self.exponent
        return n * 0.5 * math.sqrt(math.pi) * math.exp(math.lgamma(0.5 * n) - math.lgamma(0.5 * n + 0.5))

    def terms(self, a: RealArray) -> tuple[RealArray, RealArray, RealArray]:
        """δ_H in m, and what adhesion takes from load (N) and approach (m), of contact radii ``a``
        (m) of any shape, > 0."""
        pull = np.sqrt(8.0 * np.pi * self.E_star * self.work * a**3)
        return self._nk * self.coefficient * a**self.exponent, pull, np.sqrt(2.0 * np.pi * a * self.work / self.E_star)

    def at_radius(self, radius: float) -> ShortRangeState:
        """The contact of this ``radius`` in m, > 0."""
        a, n = require.positive(radius, "contact radius (m)"), self.exponent
        indented, pull, lift = map(float, self.terms(np.array(a)))
        return ShortRangeState(a, 2.0 * self.E_star * n / (n + 1.0) * indented * a - pull, indented - lift)

    def _at_power(self, value: float) -> ShortRangeState:
        """The contact of a^(n-1/2) = ``value``/(n² κ B)."""
        n = self.exponent
        return self.at_radius(math.pow(value / (n * self._nk * self.coefficient), 1.0 / (n - 0.5)))

    @property
    def pull_off(self) -> ShortRangeState:
        """Where a dead load parts the bodies."""
        return self._at_power(0.75 * math.sqrt(8.0 * math.pi * self.work / self.E_star))

    @property
    def fold(self) -> ShortRangeState:
        """Where rigid grips part the bodies."""
        return self._at_power(0.5 * math.sqrt(2.0 * math.pi * self.work / self.E_star))

    @property
    def unloaded(self) -> ShortRangeState:
        """The contact without load."""
        n = self.exponent
        return self._at_power(math.sqrt(8.0 * math.pi * self.work / self.E_star) * 0.5 * (n + 1.0))


@dataclass(frozen=True)
class CylinderJKR:
    """Cylinder of ``radius`` R on a half-space, per length: P = π E* a²/4R - sqrt(2π E* w a), a the
    half-width.

    ``E_star`` in Pa, ``radius`` in m, ``work`` of adhesion in J/m², all > 0.
    """

    E_star: float
    radius: float
    work: float

    def at_half_width(self, half_width: float) -> ShortRangeState:
        """The contact of this ``half_width`` in m, > 0."""
        a = require.positive(half_width, "half-width (m)")
        return ShortRangeState(a, float(self.load(np.array(a))), math.nan)

    def load(self, half_width: RealArray) -> RealArray:
        """Load per length in N/m at half-widths in m, > 0, of any shape."""
        pull = np.sqrt(2.0 * math.pi * self.E_star * self.work * half_width)
        return np.asarray(0.25 * math.pi * self.E_star * half_width**2 / self.radius - pull)

    @property
    def pull_off(self) -> ShortRangeState:
        """Where a dead load parts the bodies: -3 (π E* w² R/16)^(1/3)."""
        return self.at_half_width(float(np.cbrt(2.0 * self.work * self.radius**2 / (math.pi * self.E_star))))

    @property
    def unloaded(self) -> ShortRangeState:
        """The contact without load."""
        return self.at_half_width(float(np.cbrt(32.0 * self.work * self.radius**2 / (math.pi * self.E_star))))

    def centre_pressure(self, half_width: float) -> float:
        """Pressure in Pa in the middle of a contact of this ``half_width`` in m: E*a/2R -
        sqrt(2E*w/πa)."""
        a = require.positive(half_width, "half-width (m)")
        return 0.5 * self.E_star * a / self.radius - math.sqrt(2.0 * self.E_star * self.work / (math.pi * a))


@dataclass(frozen=True)
class WavyJKR:
    """Wave with the gap Δ(1 - cos 2πx/λ) before contact, with adhesion in the contact alone
    (Johnson 1995).

    With ψ = πa/λ, half-width a, ω = sin²ψ, in units of p* = πE*Δ/λ and of Δ:

        p/p* = sin²ψ - α sqrt(tan ψ),  δ/Δ = ω (1 - ln ω) + α sqrt(tan ψ) ln ω,
        α² = 2E*w/(λ (p*)²).

    ``alpha`` is α >= 0.
    """

    alpha: float

    @classmethod
    def of(cls, E_star: float, wavelength: float, amplitude: float, work: float) -> WavyJKR:
        """Theory of a wave of this ``wavelength`` λ and ``amplitude`` Δ in m, contact modulus in
        Pa, work of adhesion in J/m², all > 0."""
        full = math.pi * E_star * amplitude / wavelength
        return cls(math.sqrt(2.0 * E_star * work / wavelength) / full)

    def mean_pressure(self, fraction: float) -> float:
        """Mean pressure over p* of a contact ``fraction`` 2a/λ between 0 and 1."""
        return float(self.at(np.array(self._psi(fraction)))[0])

    def approach(self, fraction: float) -> float:
        """Approach over Δ of a contact ``fraction`` 2a/λ between 0 and 1."""
        return float(self.at(np.array(self._psi(fraction)))[1])

    def at(self, psi: RealArray) -> tuple[RealArray, RealArray]:
        """Mean pressure over p* and approach over Δ at ``psi`` of any shape, between 0 and π/2."""
        omega, pull = np.sin(psi) ** 2, self.alpha * np.sqrt(np.tan(psi))
        return omega - pull, omega * (1.0 - np.log(omega)) + pull * np.log(omega)

    def crest_pressure(self, fraction: float) -> float:
        """Pressure at the crest over p* of a contact ``fraction`` 2a/λ between 0 and 1."""
        sine = math.sin(self._psi(fraction))
        return 2.0 * sine - self.alpha * math.sqrt(math.tan(self._psi(fraction))) / sine

    @property
    def stationary(self) -> tuple[float, ...]:
        """Contact fractions of pull-off and of the jump into full contact, where 4 sin^(3/2)ψ
        cos^(5/2)ψ = α; none beyond α = 1.065."""
        from scipy.optimize import brentq

        def miss(psi: float) -> float:
            return 4.0 * math.pow(math.sin(psi), 1.5) * math.pow(math.cos(psi), 2.5) - self.alpha

        top = math.atan(math.sqrt(0.6))
        if miss(top) <= 0.0 or self.alpha == 0.0:
            return ()
        ends = ((0.0, top), (top, 0.5 * math.pi))
        return tuple(2.0 / math.pi * float(brentq(miss, *pair, xtol=1e-15, rtol=8.9e-16)) for pair in ends)

    @staticmethod
    def _psi(fraction: float) -> float:
        return 0.5 * math.pi * require.between(fraction, 0.0, 1.0, "contact fraction")


_PANELS, _NODES, _DECAY = 60, 20, 40.0
_FINER = 6.0, 2.5
"""Further points over the contact, and panels of wavenumbers in all, per thickness in its radius: a
hundred of these leave 1e-11."""
_HALVED = 5
"""Times that the first panel of wavenumbers is halved: a film passes from bending to its own
modulus at q h of (6 E2/E1)^(1/3), for E1/E2 = 50 within that panel, where 20 nodes lost 2e-8 of the
approach."""


@dataclass(frozen=True)
class CoatedJKR:
    """Rigid sphere on a coated half-space, with adhesion in the contact alone; the edge lies in the
    top layer.

    With C(q) = 2/(E_1* q) [1 + M(q)] the pressure follows from φ(x) of one Fredholm equation,

        φ(x) + (2/π) ∫ φ(t) ∫ M(q) cos qx cos qt dq dt = 2E_1* (δ - x²/R),
        P = ∫ φ dt over 0 < t < a,

    φ(a) = 0 without adhesion, φ(a)² = 8π E_1* a w and φ(a) < 0 with it.

    Parameters
    ----------
    top_modulus
        E_1* in Pa of the top layer.
    excess
        M of wavenumbers q (n,) in rad/m, which decays where q times the ``depth`` is large.
    depth
        Thickness of the coating in m.
    radius
        Radius R of the sphere in m.
    work
        Work of adhesion in J/m².
    nodes
        Points of Gauss' quadrature over a contact smaller than the depth, more over larger ones; 48
        leave 1e-12.
    """

    top_modulus: float
    excess: Callable[[RealArray], RealArray]
    depth: float
    radius: float
    work: float
    nodes: int = 48

    def at_radius(self, radius: float) -> CoatedState:
        """The contact of this ``radius`` in m, > 0, without and with adhesion."""
        a = require.positive(radius, "contact radius (m)")
        nodes = self.nodes + int(_FINER[0] * a / self.depth)
        x, weight = (part[0] for part in gauss(np.array([[0.0, a]]), nodes))
        points = np.append(x, a)
        equal = np.linspace(0.0, _DECAY / self.depth, max(_PANELS, math.ceil(_FINER[1] * a / self.depth)) + 1)
        ends = np.concatenate([[0.0], equal[1] * 0.5 ** np.arange(_HALVED, 0, -1), equal[1:]])
        q, weight_q = (part.ravel() for part in gauss(np.stack([ends[:-1], ends[1:]], axis=-1), _NODES))
        cosines = np.cos(np.outer(points, q))
        kernel = 2.0 / math.pi * (cosines * (self.excess(q) * weight_q)) @ cosines.T
        matrix = np.eye(nodes) + kernel[:-1, :-1] * weight
        right = 2.0 * self.top_modulus * np.stack([np.ones_like(x), x**2 / self.radius], axis=1)
        found = np.linalg.solve(matrix, right)
        edge_right = 2.0 * self.top_modulus * np.array([1.0, a**2 / self.radius])
        edge = edge_right - (kernel[-1, :-1] * weight) @ found
        stiffness, shape = (float(value) for value in weight @ found)
        hertz = float(edge[1] / edge[0])
        pull = math.sqrt(8.0 * math.pi * self.top_modulus * a * self.work)
        approach = float((edge[1] - pull) / edge[0])
        return CoatedState(a, stiffness * hertz - shape, hertz, stiffness, stiffness * approach - shape, approach)

    def pull_off(self, smallest: float, largest: float) -> CoatedState:
        """The contact of the most tensile load, with a radius between these in m."""
        from scipy.optimize import minimize_scalar

        found = minimize_scalar(
            lambda a: self.at_radius(float(a)).load,
            bounds=(smallest, largest),
            method="bounded",
            options={"xatol": 1e-7 * largest},
        )
        return self.at_radius(float(found.x))


@dataclass(frozen=True)
class CoatedState:
    """A contact of ``radius`` (m): load (N) and approach (m) without adhesion, stiffness dP/dδ at
    this radius (N/m), load and approach with it."""

    radius: float
    hertz_load: float
    hertz_approach: float
    stiffness: float
    load: float
    approach: float
