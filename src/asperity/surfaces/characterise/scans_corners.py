"""Two isotropic spectra with one corner and one power law, closed in map, profile and covariance.

C, C1D and R belong together exactly: a spectrum of a profile is never differentiated, and the
covariance at the points of a scan holds its aliases.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.quadrature import gauss
from ...core.scipy_parts import interpolate, special
from ..profile_spectra import RoundedSpectrum


class Corner(Protocol):
    """Spectrum of an isotropic surface with the ``variance`` m0 in m², a ``corner`` q0 in rad/m and
    the Hurst exponent ``hurst``."""

    name: ClassVar[str]
    largest_hurst: ClassVar[float]

    @property
    def variance(self) -> float:
        """m0 in m²."""

    @property
    def corner(self) -> float:
        """q0 in rad/m."""

    @property
    def hurst(self) -> float:
        """H, C falls as q^(-2-2H)."""

    @classmethod
    def of(cls, values: RealArray) -> Self:
        """From the parameters (ln m0, ln q0, H)."""

    def psd(self, q: ArrayLike) -> RealArray:
        """C in m⁴ of the isotropic surface at the wavenumbers ``q`` (rad/m, any shape)."""

    def profile_psd(self, k: ArrayLike) -> RealArray:
        """Two-sided C1D in m³ of its profiles at the wavenumbers ``k`` (rad/m, any shape)."""

    def autocovariance(self, lag: ArrayLike) -> RealArray:
        """R in m² at the ``lag`` in m >= 0 (any shape)."""


@dataclass(frozen=True)
class Rounded:
    """C = A/(1 + q²/q0²)^(1+H), a rounded roll-off, by its mean square; H = 1/2 has the exponential
    autocovariance.

    ``variance`` m0 = A q0²/(4πH) in m², ``corner`` q0 in rad/m, ``hurst`` H.
    """

    variance: float
    corner: float
    hurst: float
    name: ClassVar[str] = "rounded"
    largest_hurst: ClassVar[float] = 2.0

    @classmethod
    def of(cls, values: RealArray) -> Self:
        """From the parameters (ln m0, ln q0, H)."""
        return cls(math.exp(values[0]), math.exp(values[1]), float(values[2]))

    @property
    def spectrum(self) -> RoundedSpectrum:
        """The spectrum by its level A in m⁴."""
        return RoundedSpectrum(4.0 * math.pi * self.hurst * self.variance / self.corner**2, self.corner, self.hurst)

    def psd(self, q: ArrayLike) -> RealArray:
        """C in m⁴ of the isotropic surface at the wavenumbers ``q`` (rad/m, any shape)."""
        return self.spectrum.psd(np.asarray(q, dtype=float))

    def profile_psd(self, k: ArrayLike) -> RealArray:
        """Two-sided C1D in m³ at the wavenumbers ``k`` (rad/m, any shape)."""
        return self.spectrum.profile_psd(np.asarray(k, dtype=float))

    def autocovariance(self, lag: ArrayLike) -> RealArray:
        """R in m² at the ``lag`` in m >= 0 (any shape)."""
        return np.asarray(self.variance * self.spectrum.autocorrelation(lag))


_SERIES_TO = 10.0  # x up to which the power series of the tail keeps twelve digits
_FAR = 45.0  # x from which its asymptotic series has them
_TERMS = 60
_PANELS, _NODES = 1400, 4  # of the table in between


@dataclass(frozen=True)
class Sharp:
    """C = A up to q0 and A (q/q0)^(-2-2H) beyond, a plateau with a hard corner.

    ``variance`` m0 = A q0²/(4π) (1 + 1/H) in m², ``corner`` q0 in rad/m, ``hurst`` 0 < H < 1.
    """

    variance: float
    corner: float
    hurst: float
    name: ClassVar[str] = "sharp"
    largest_hurst: ClassVar[float] = 0.98

    @classmethod
    def of(cls, values: RealArray) -> Self:
        """From the parameters (ln m0, ln q0, H)."""
        return cls(math.exp(values[0]), math.exp(values[1]), float(values[2]))

    @property
    def level(self) -> float:
        """A in m⁴."""
        return 4.0 * math.pi * self.variance / (self.corner**2 * (1.0 + 1.0 / self.hurst))

    def psd(self, q: ArrayLike) -> RealArray:
        """C in m⁴ of the isotropic surface at the wavenumbers ``q`` (rad/m, any shape)."""
        x = np.asarray(q, dtype=float) / self.corner
        return np.asarray(self.level * np.maximum(x, 1.0) ** -(2.0 + 2.0 * self.hurst))

    def profile_psd(self, k: ArrayLike) -> RealArray:
        """Two-sided C1D in m³ at the wavenumbers ``k`` > 0 (rad/m, any shape).

        A plateau gives (A/π) sqrt(q0² - k²), the power law beyond a' = max(k, q0) the incomplete
        beta function B_(k²/a'²)(1/2 + H, 1/2).
        """
        x, H = np.asarray(k, dtype=float) / self.corner, self.hurst
        share = special.betainc(0.5 + H, 0.5, np.minimum(x, 1.0) ** 2) * special.beta(0.5 + H, 0.5)
        tail = np.where(x > 0.0, x, 1.0) ** (-1.0 - 2.0 * H) * share / (2.0 * math.pi)
        flat = np.sqrt(np.maximum(1.0 - x**2, 0.0)) / math.pi
        return np.asarray(self.level * self.corner * (tail + flat))

    def autocovariance(self, lag: ArrayLike) -> RealArray:
        """R = (A q0²/2π) [J1(x)/x + x^(2H) ∫_x^∞ v^(-1-2H) J0(v) dv] in m², x = q0 ``lag``, at the
        ``lag`` in m >= 0 (any shape)."""
        x = self.corner * np.asarray(lag, dtype=float)
        safe = np.where(x > 0.0, x, 1.0)
        plateau = np.where(x > 0.0, special.j1(safe) / safe, 0.5)
        value = self.level * self.corner**2 / (2.0 * math.pi) * (plateau + self._tail(x))
        return np.where(x > 0.0, value, self.variance)

    def _tail(self, x: RealArray) -> RealArray:
        """x^(2H) ∫_x^∞ v^(-1-2H) J0(v) dv: a power series, a table, an asymptotic series."""
        H, found = self.hurst, np.empty_like(x)
        near, far = x < _SERIES_TO, x > _FAR
        quarter = np.square(0.5 * x[near])
        total, term = np.full(quarter.shape, 0.5 / H), np.ones_like(quarter)
        for m in range(1, _TERMS):
            term = term * -quarter / m**2
            total += term / (2.0 * H - 2.0 * m)
        found[near] = x[near] ** (2.0 * H) * 2.0 ** (-1.0 - 2.0 * H) * special.gamma(-H) / math.gamma(1.0 + H) + total
        found[far] = x[far] ** (2.0 * H) * _bessel_tail(x[far], 1.0 + 2.0 * H)
        between = ~(near | far)
        if between.any():
            found[between] = x[between] ** (2.0 * H) * self._tabulated(x[between])
        return found

    def _tabulated(self, x: RealArray) -> RealArray:
        """∫_x^∞ v^(-1-2H) J0(v) dv between the two series, by a Hermite spline through sums."""
        power = -1.0 - 2.0 * self.hurst
        edges = np.linspace(_SERIES_TO, _FAR, _PANELS + 1)
        v, weight = gauss(edges, _NODES)
        parts = (weight * v**power * special.j0(v)).reshape(-1, _NODES).sum(axis=1)
        last = _bessel_tail(edges[-1:], -power)[0]
        sums = np.concatenate([np.cumsum(parts[::-1])[::-1], [0.0]]) + last
        return np.asarray(interpolate.CubicHermiteSpline(edges, sums, -(edges**power) * special.j0(edges))(x))


def _bessel_tail(x: RealArray, a: float) -> RealArray:
    """∫_x^∞ v^-a J0(v) dv for large ``x`` by repeated integration by parts."""
    zero, one = special.j0(x), special.j1(x)
    total, factor = np.zeros_like(x), np.ones_like(x)
    for _ in range(12):
        total += factor * x**-a * ((a + 1.0) / x * zero - one)
        factor *= -((a + 1.0) ** 2)
        a += 2.0
    return total


CORNERS: dict[str, type[Rounded] | type[Sharp]] = {"rounded": Rounded, "sharp": Sharp}
"""Corners by name."""
