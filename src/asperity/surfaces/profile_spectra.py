"""Spectra of isotropic surfaces and of their profiles: the exact relation both ways, for models and
for power-law pieces.

    C1D(k) = (1/π) ∫_k^∞ q C dq/sqrt(q² - k²),      C(q) = -2 ∫_q^∞ (dC1D/dk) dk/sqrt(k² - q²)

in the convention m0 = (1/2π) ∫ q C dq = (1/π) ∫ C1D dk, with C in m⁴ and the two-sided C1D in m³. A
measured spectrum is never differentiated: a model or power laws are fitted to it first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.quadrature import gauss
from ..core.scipy_parts import special
from ..core.units import show

_SERIES_BELOW, _SERIES_TERMS = 1.0, 14  # x of the series of 1 - ρ, and terms with (x/2)^2m/m! below 1e-18 there
_PANEL, _NODES = 0.5, 10  # of the quadrature over arcosh(q/k)


class IsotropicModel(Protocol):
    """Spectrum of an isotropic surface that knows that of its profiles."""

    def psd(self, q: RealArray | float) -> RealArray:
        """C in m⁴ at the wavenumbers ``q`` (rad/m)."""

    def profile_psd(self, k: RealArray | float) -> RealArray:
        """Two-sided C1D in m³ at the wavenumbers ``k`` (rad/m)."""

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface."""


# Rounded roll-off: the one pair that is closed everywhere.


@dataclass(frozen=True)
class RoundedSpectrum:
    """C(q) = A/(1 + q²/q0²)^(1 + H) (K-correlation, Matérn), the one pair closed everywhere; H =
    1/2 is an exponential ACF.

    C1D(k) = A q0 Γ(H + 1/2)/(2 sqrt(π) Γ(H + 1)) (1 + k²/q0²)^-(1/2 + H), m0 = A q0²/(4π H) and
    ρ(r) = 2^(1-H)/Γ(H) x^H K_H(x), x = q0 r.
    Raises InputError if a parameter is not positive.

    Parameters
    ----------
    level
        A in m⁴.
    corner
        q0 in rad/m.
    hurst
        H > 0; below 1 for a self-affine surface.
    """

    level: float
    corner: float
    hurst: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    def __post_init__(self) -> None:
        require.positive(self.level, "level of a rounded spectrum (m^4)")
        require.positive(self.corner, "corner of a rounded spectrum (rad/m)")
        require.positive(self.hurst, "Hurst exponent of a rounded spectrum")

    @property
    def rolloff_wavelength(self) -> float:
        """2π/q0 in m."""
        return 2.0 * math.pi / self.corner

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: two roll-off
        wavelengths."""
        return 2.0 * self.rolloff_wavelength

    @property
    def mean_square(self) -> float:
        """m0 in m² of all waves."""
        return self.level * self.corner**2 / (4.0 * math.pi * self.hurst)

    def psd(self, q: RealArray | float) -> RealArray:
        """C in m⁴ at the wavenumbers ``q`` (rad/m, any shape)."""
        x = np.asarray(q, dtype=float) / self.corner
        return np.asarray(self.level * (1.0 + x**2) ** -(1.0 + self.hurst))

    def profile_psd(self, k: RealArray | float) -> RealArray:
        """Two-sided C1D in m³ at the wavenumbers ``k`` (rad/m, any shape)."""
        x, H = np.asarray(k, dtype=float) / self.corner, self.hurst
        factor = math.exp(math.lgamma(H + 0.5) - math.lgamma(H + 1.0)) / (2.0 * math.sqrt(math.pi))
        return np.asarray(self.level * self.corner * factor * (1.0 + x**2) ** -(0.5 + H))

    def autocorrelation(self, lag: ArrayLike) -> RealArray:
        """ρ at the ``lag`` in m >= 0 (any shape)."""
        x = self.corner * np.asarray(lag, dtype=float)
        return np.where(x < _SERIES_BELOW, 1.0 - self._series(x, 1.0, 0.0), self._bessel(x))

    def half_structure(self, lag: ArrayLike) -> RealArray:
        """S/(2 m0) = 1 - ρ at the ``lag`` in m >= 0 (any shape), with all digits for short lags
        (H < 1)."""
        x = self.corner * np.asarray(lag, dtype=float)
        return np.where(x < _SERIES_BELOW, self._series(x, 1.0, 0.0), 1.0 - self._bessel(x))

    def half_slope(self, lag: ArrayLike) -> RealArray:
        """(1/2) d ln S/d ln τ at the ``lag`` τ in m > 0 (any shape): the Hurst exponent that a line
        through ln S shows."""
        x = self.corner * np.asarray(lag, dtype=float)
        return np.asarray(0.5 * self._growth(x) / self.half_structure(lag))

    def half_slope_of_second_differences(self, lag: ArrayLike) -> RealArray:
        """The same of V = <[h(x+τ) - 2h(x) + h(x-τ)]²> = 4 S(τ) - S(2τ), which is blind to tilt and
        to long waves."""
        x = self.corner * np.asarray(lag, dtype=float)
        short = np.minimum(x, _SERIES_BELOW)
        V = np.where(2.0 * x < _SERIES_BELOW, self._series(short, 4.0, 1.0), 4.0 * self._gap(x) - self._gap(2.0 * x))
        return np.asarray(0.5 * (4.0 * self._growth(x) - self._growth(2.0 * x)) / V)

    def moment(self, order: int, shortest_wavelength: float, *, cut: str = "map") -> float:
        """m_n in m^(2-n) of the profile, n = 0, 2 or 4, of waves longer than
        ``shortest_wavelength`` (m).

        ``cut`` in the ``map`` (waves of the surface on a disc) or in the ``profile``: the second
        leaves the profile more of the short oblique waves, and is larger. Raises InputError if the
        order, the cut or the wavelength is none of these.
        """
        factor = {0: 0.5, 2: 0.25, 4: 0.1875}.get(order)
        if factor is None:
            raise InputError(f"order of a moment must be 0, 2 or 4, but is {order!r}.")
        require.one_of(cut, ("map", "profile"), "cut of a moment")
        last = 2.0 * math.pi / require.positive(shortest_wavelength, "shortest wavelength (m)")
        edges = np.append(0.0, np.geomspace(min(1e-3 * self.corner, 0.1 * last), last, 200))
        q, weight = gauss(edges, _NODES)
        density = factor * q ** (order + 1) * self.psd(q) if cut == "map" else q**order * self.profile_psd(q)
        return float(weight @ density) / math.pi

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        q = grid.wavenumber()
        return np.where(q > 0.0, self.psd(q), 0.0)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        return f"rounded roll-off at {show(self.rolloff_wavelength, 'm')}, H = {self.hurst:.4g}"

    def _bessel(self, x: RealArray) -> RealArray:
        H = self.hurst
        with np.errstate(invalid="ignore", over="ignore"):
            value = 2.0 ** (1.0 - H) / math.gamma(H) * x**H * special.kv(H, x)
        return np.where(x > 0.0, np.nan_to_num(value), 1.0)

    def _gap(self, x: RealArray) -> RealArray:
        return self.half_structure(x / self.corner)

    def _growth(self, x: RealArray) -> RealArray:
        """x d(1 - ρ)/dx = 2^(1-H)/Γ(H) x^(H+1) K_(1-H)(x)."""
        H = self.hurst
        return np.asarray(2.0 ** (1.0 - H) / math.gamma(H) * x ** (H + 1.0) * special.kv(abs(1.0 - H), x))

    def _series(self, x: RealArray, one: float, two: float) -> RealArray:
        """``one`` (1 - ρ(x)) - ``two`` (1 - ρ(2x)) by the power series, for 0 < H < 1; by
        difference otherwise."""
        H, t = self.hurst, np.square(0.5 * x)
        if not 0.0 < H < 1.0:
            return np.asarray(one * (1.0 - self._bessel(x)) - two * (1.0 - self._bessel(2.0 * x)))
        total, power = np.zeros_like(x), np.ones_like(x)
        for m in range(_SERIES_TERMS):
            scale = one - two * 4.0**m
            broken = (one - two * 4.0 ** (m + H)) / math.gamma(m + 1.0 + H)
            total += power / math.factorial(m) * (t**H * broken - (scale / math.gamma(m + 1.0 - H) if m else 0.0))
            power = power * t
        return np.asarray(math.gamma(1.0 - H) * total)


# Power-law pieces.


@dataclass(frozen=True, eq=False)
class PowerPieces:
    """Continuous power laws between the wavenumbers ``q`` (n,), rising, in rad/m, with the values
    ``psd`` (n,) there.

    Constant below the first with ``plateau``, else zero. Raises InputError if the two are no such
    table.
    """

    q: RealArray
    psd_at: RealArray
    plateau: bool = True

    def __post_init__(self) -> None:
        if self.q.ndim != 1 or self.q.shape != self.psd_at.shape or self.q.size < 2:
            raise InputError(
                "pieces of a spectrum must be two arrays of the same length of at least 2, but have shapes "
                f"{self.q.shape} and {self.psd_at.shape}."
            )
        if not (self.q[0] > 0.0 and (np.diff(self.q) > 0.0).all() and (self.psd_at > 0.0).all()):
            raise InputError("pieces of a spectrum must be positive at rising wavenumbers, but are not. Sort them.")

    @property
    def exponents(self) -> RealArray:
        """Fall -d ln C/d ln q of each piece, (n - 1,)."""
        return np.asarray(-np.diff(np.log(self.psd_at)) / np.diff(np.log(self.q)))

    def at(self, q: RealArray | float) -> RealArray:
        """Values at the wavenumbers ``q`` (rad/m, any shape) up to the last."""
        number = np.asarray(q, dtype=float)
        with np.errstate(divide="ignore"):
            inside = np.exp(np.interp(np.log(number), np.log(self.q), np.log(self.psd_at)))
        return np.where((number < self.q[0]) & (not self.plateau), 0.0, inside)


class MapPieces(PowerPieces):
    """Spectrum C (m⁴) of an isotropic surface in power-law pieces, zero beyond the last
    wavenumber."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: the longest wave of the
        table."""
        return float(2.0 * np.pi / self.q[0])

    def psd(self, q: RealArray | float) -> RealArray:
        """C in m⁴ at the wavenumbers ``q`` (rad/m, any shape)."""
        number = np.asarray(q, dtype=float)
        return np.where(number <= self.q[-1] * (1.0 + 1e-9), self.at(number), 0.0)

    def profile_psd(self, k: RealArray | float) -> RealArray:
        """C1D in m³ at the wavenumbers ``k`` > 0 (rad/m, any shape): it falls to zero at the last
        as sqrt(q_s² - k²).

        A piece c q^-e, e > 1, from a to b adds (c/2π) k^(1-e) [B(k²/a'²) - B(k²/b²)] with the
        incomplete beta function B_x((e-1)/2, 1/2) and a' = max(a, k); a plateau (c/π) [sqrt(b² -
        k²) - sqrt(a'² - k²)].
        """
        number = np.asarray(k, dtype=float)
        flat = number.ravel()
        total = np.zeros_like(flat)
        if self.plateau:
            total += self.psd_at[0] / np.pi * np.sqrt(np.maximum(self.q[0] ** 2 - flat**2, 0.0))
        for a, b, c, e in zip(self.q[:-1], self.q[1:], self.psd_at[:-1], self.exponents, strict=True):
            part = flat < b
            if e > 1.0:
                low, high = np.maximum(a, flat[part]), b
                law = c * a**e / (2.0 * np.pi) * flat[part] ** (1.0 - e)
                half = 0.5 * (e - 1.0)
                total[part] += law * (_beta(half, (flat[part] / low) ** 2) - _beta(half, (flat[part] / high) ** 2))
            else:
                total[part] += [_quadrature(a, b, c, float(e), one) for one in flat[part]]
        return total.reshape(number.shape)

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""
        q = grid.wavenumber()
        return np.where(q > 0.0, self.psd(q), 0.0)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        falls = ", ".join(f"{fall:.3g}" for fall in self.exponents[:4])
        more = " …" if self.exponents.size > 4 else ""
        ends = f"waves down to {show(2.0 * math.pi / self.q[-1], 'm')}"
        return f"{self.exponents.size} power laws of exponents {falls}{more}, {ends}"


class ProfilePieces(PowerPieces):
    """Spectrum C1D (m³) of a profile in power-law pieces, the last of which goes on without end."""

    def profile_psd(self, k: RealArray | float) -> RealArray:
        """C1D in m³ at the wavenumbers ``k`` (rad/m, any shape)."""
        number = np.asarray(k, dtype=float)
        beyond = self.psd_at[-1] * (np.maximum(number, self.q[-1]) / self.q[-1]) ** -self.exponents[-1]
        return np.where(number > self.q[-1], beyond, self.at(number))

    def psd(self, q: RealArray | float) -> RealArray:
        """C in m⁴ of the isotropic surface at the wavenumbers ``q`` > 0 (rad/m, any shape).

        A piece c k^-p from a to b adds c p q^(-p-1) [B(q²/a'²) - B(q²/b²)], B_x((p+1)/2, 1/2), a' =
        max(a, q). Raises InputError if a piece rises as k or steeper, or the last does not fall.
        """
        p = self.exponents
        if not ((p > -1.0).all() and p[-1] > 0.0):
            raise InputError(
                "spectrum of a profile must fall at its end and nowhere rise as its wavenumber to become that "
                f"of a surface, but its exponents are {', '.join(f'{one:.3g}' for one in p)}. Use fewer "
                "pieces, or filter its noise."
            )
        number = np.asarray(q, dtype=float)
        flat = number.ravel()
        total = np.zeros_like(flat)
        bounds = np.append(self.q[1:-1], np.inf)
        for a, b, c, fall in zip(self.q[:-1], bounds, self.psd_at[:-1], p, strict=True):
            part = flat < b
            one = flat[part]
            law = c * a**fall * fall * one ** (-fall - 1.0)
            half = 0.5 * (fall + 1.0)
            ended = _beta(half, (one / b) ** 2) if math.isfinite(b) else 0.0
            total[part] += law * (_beta(half, (one / np.maximum(a, one)) ** 2) - ended)
        return total.reshape(number.shape)


def _beta(a: float, x: RealArray) -> RealArray:
    """Incomplete beta function B_x(a, 1/2), a > 0."""
    return np.asarray(special.beta(a, 0.5) * special.betainc(a, 0.5, x))


def _quadrature(a: float, b: float, c: float, e: float, k: float) -> float:
    """(1/π) ∫ c (q/a)^-e q dq/sqrt(q² - k²) from max(a, k) to b, over u = arcosh(q/k)."""
    low, high = math.acosh(max(a, k) / k), math.acosh(b / k)
    edges = np.linspace(low, high, 2 + int((high - low) / _PANEL))
    u, weight = gauss(edges, _NODES)
    q = k * np.cosh(u)
    return float(weight @ (c * (q / a) ** -e * q)) / math.pi


# What a cut, the sampling and neighbouring lines do.


def cut_ratio(hurst: float, order: int) -> float:
    """m_n of a power law whose *profile* spectrum ends at q_s over that whose *map* ends on the
    disc q_s, n = 2 or 4.

    2 Γ(H + 1/2)/(sqrt(π) Γ(H + 1)), times 4/3 for m4: at H = 0.8 the same cut is 9 % and 45 %
    apart. Raises InputError if the exponent is not between 0 and 1 or the order neither 2 nor 4.
    """
    H = require.between(hurst, 0.0, 1.0, "Hurst exponent of a power law")
    if order not in (2, 4):
        raise InputError(f"order of a moment must be 2 or 4, but is {order!r}.")
    ratio = 2.0 / math.sqrt(math.pi) * math.exp(math.lgamma(H + 0.5) - math.lgamma(H + 1.0))
    return ratio if order == 2 else ratio * 4.0 / 3.0


def independent_line_distance(hurst: float, q: float) -> float:
    """Distance in m of independent lines of an isotropic map at the wavenumber ``q`` (rad/m) of its
    power law, c_H/q.

    c_H = 2 sqrt(π) Γ(2H + 3/2)/Γ(2H + 2) [Γ(H + 1)/Γ(H + 1/2)]²: a square map of 256 lines is worth
    8 at its third mode. Raises InputError if the exponent is not between 0 and 1 or the wavenumber
    not positive.
    """
    H = require.between(hurst, 0.0, 1.0, "Hurst exponent of a power law")
    return independent_line_factor(H) / require.positive(q, "wavenumber (rad/m)")


def independent_line_factor(hurst: float) -> float:
    """c_H of the distance c_H/q of independent lines; of the rounded spectrum with sqrt(q² + q0²)
    in place of q, there for any ``hurst`` > 0."""
    logs = math.lgamma(2.0 * hurst + 1.5) - math.lgamma(2.0 * hurst + 2.0)
    logs += 2.0 * (math.lgamma(hurst + 1.0) - math.lgamma(hurst + 0.5))
    return 2.0 * math.sqrt(math.pi) * math.exp(logs)


def alias_factor(exponent: float, k: ArrayLike, spacing: float) -> RealArray:
    """Σ_j C1D(k + 2πj/Δ)/C1D(k) of a power law k^-p sampled at points a ``spacing`` Δ (m) apart.

    s^p [ζ(p, s) + ζ(p, 1 - s)] with s = kΔ/2π and the Hurwitz zeta function; p > 1, 0 < k <= π/Δ
    (rad/m). Raises InputError if the exponent is not above 1 or a wavenumber is out of range.
    """
    zeta = special.zeta
    p = require.finite(exponent, "exponent of a sampled spectrum")
    if p <= 1.0:
        raise InputError(f"exponent of a sampled spectrum must be above 1 for its aliases to have a sum, but is {p:g}.")
    s = np.asarray(k, dtype=float) * require.positive(spacing, "spacing of the points (m)") / (2.0 * np.pi)
    if not ((s > 0.0) & (s <= 0.5 * (1.0 + 1e-9))).all():
        raise InputError("wavenumber of a sampled spectrum must lie above zero and at most at π/Δ, but does not.")
    return np.asarray(s**p * (zeta(p, s) + zeta(p, 1.0 - s)))
