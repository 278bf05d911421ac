"""Peaks of profiles: Whitehouse and Archard, Onions and Archard."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Length, Number
from ..protocol import (
    FEW_CONTACTS,
    ISOTROPY,
    MEASURED_SLOPES,
    Bound,
    Modulus,
    SeparationTheory,
    Theory,
)
from ..statistics.heights import GaussianHeights
from ..statistics.roughness import Roughness

# Onions & Archard (1973): summits of a Gaussian surface with exponential autocorrelation, radii
# varying with height.


SAMPLING = 2.3
"""Interval ℓ of independent ordinates over the correlation length β* (1/e): the autocorrelation has
fallen to 1/10."""

UNLIKELY, CERTAIN = 0.25, 0.45
"""(E*/H)(σ/β*) below which plastic flow is most unlikely, and above which it occurs at the lightest
load."""

_LOWEST, _HIGHEST = -30.0, 35.0  # separations in σ between which pressures are inverted
_NODES = 16  # in each panel over the square root of the curvature
_PANELS, _DEEP_PANELS = 5, 20  # they leave 1e-14 of all peaks, and of those above depth/C
_REACH = 22.0  # beyond which exp(-C²/12) is below 1e-17
_NORM = 3.0 / (2.0**1.5 * math.pi) * math.sqrt(2.0 * math.pi / 3.0)  # of f* after integration over s


@dataclass(frozen=True)
class OnionsArchard(SeparationTheory):
    """Peaks among independent ordinates at the interval ℓ = 2.3 β*, one in five of a square grid
    being a summit.

    With the joint density f*(s, C) of height s (in σ) and curvature C (in σ/ℓ²) of three-point
    peaks (Whitehouse & Archard 1970), summits of radius ℓ²/(σC), 1/(5ℓ²) of them per area, D = h/σ:

        A_r/A_a = (π/5) ∫_D^∞ (s - D) ∫ f*/C dC ds,
        p = (4 E* σ/15ℓ) ∫_D^∞ (s - D)^(3/2) ∫ f*/C^(1/2) dC ds.

    The area is nearly proportional to the load, A_r/A_a ≈ 3.1 p/(E* σ/β*).
    """

    E_star: Modulus
    rms_height: Annotated[Length, "standard deviation σ of the surface heights"]
    correlation_length: Annotated[Length, "lag at which the autocorrelation has fallen to 1/e"]
    name: ClassVar[str] = "onions-archard"
    title: ClassVar[str] = "Onions-Archard"
    citation_keys: ClassVar[tuple[str, ...]] = ("Onions1973", "Whitehouse1970")
    limits: ClassVar[tuple[Bound, ...]] = (
        replace(FEW_CONTACTS, citation="Onions1973"),
        Bound(
            "rms height over correlation length",
            lambda theory, answer: theory.rms_height / theory.correlation_length,
            0.0,
            0.3,
            "Onions1973",
            "Contacts become as large as their radius of curvature, which is of the order of β*²/σ.",
        ),
        Bound(
            "rms gradient over that of the ordinates",
            lambda theory, roughness: roughness.rms_gradient * SAMPLING * theory.correlation_length / theory.rms_height,
            0.0,
            2.0,  # the area is about 0.7 times this that of elasticity
            "Whitehouse1970",
            "Waves shorter than 2.3 correlation lengths, which the theory leaves out, hold most of the slope; "
            "its area is too large by their share.",
            measured=True,
        ),
        MEASURED_SLOPES,
        ISOTROPY,
    )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the rms height and correlation length of ``roughness``; InputError without the
        latter."""
        if math.isnan(roughness.correlation_length):
            raise InputError(
                "roughness for the theory onions-archard must hold a correlation length (m), but does not. Give it to "
                "Roughness; a map must be longer than the length at which its autocorrelation falls to 1/e."
            )
        return cls(E_star, roughness.rms_height, roughness.correlation_length)

    @property
    def _ends(self) -> tuple[float, float, float]:
        return self.rms_height * _LOWEST, self.rms_height * _HIGHEST, self.rms_height

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D = h / self.rms_height
        unit = 4.0 * self.E_star * self.rms_height / (15.0 * SAMPLING * self.correlation_length)
        return unit * peak_integral(D, 1.5, 0.5), 1.5 * unit / self.rms_height * peak_integral(D, 0.5, 0.5)

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D, interval = h / self.rms_height, SAMPLING * self.correlation_length
        return math.pi / 5.0 * peak_integral(D, 1.0, 1.0), peak_integral(D, 0.0, 0.0) / (5.0 * interval**2)


def peak_integral(D: ArrayLike, m: float, k: float) -> RealArray:
    """∫_D^∞ (s - D)^m ∫₀^∞ f*(s, C) C^(-k) dC ds over three-point peaks of independent ordinates.

    f* = 3/(2^(3/2) π) exp[-s²/2 - (s - C/2)²] erf(C/2) is a normal density of s about C/3 with
    variance 1/3, times exp(-C²/12) erf(C/2): the integral over s is a one-sided moment of a
    Gaussian.
    """
    D = np.asarray(D, dtype=float)
    C, weight = _curvatures(D, k)
    return np.asarray(np.sum(weight * _above(D[..., None] - C / 3.0, m), axis=-1))


def plastic_area_share(D: ArrayLike, psi: float) -> RealArray:
    """Share of the elastic area on summits deeper than δ_p = R (H/E*)², for ψ = (E*/H)(σ/β*) > 0.

    In σ, δ_p is w = (2.3/ψ)²/C. Onions and Archard's bounds ``UNLIKELY`` and ``CERTAIN`` are on the
    safe side: the share is below 1e-3 at 0.45 and reaches 2 % at about 0.65, almost whatever the
    load.
    """
    D = np.asarray(D, dtype=float)
    unit = (SAMPLING / require.positive(psi, "plasticity index psi")) ** 2
    C, weight = _curvatures(D, 1.0, unit)
    depth = unit / C
    lowest = D[..., None] + depth - C / 3.0
    flowing = np.sum(weight * (_above(lowest, 1.0) + depth * _above(lowest, 0.0)), axis=-1)
    return np.asarray(flowing / peak_integral(D, 1.0, 1.0))


def _above(x: RealArray, m: float) -> RealArray:
    """∫_x^∞ (s - x)^m of the normal density with variance 1/3 about zero."""
    return np.asarray(3.0 ** (-0.5 * m) * GaussianHeights().tail_moment(math.sqrt(3.0) * x, m))


def _curvatures(D: RealArray, k: float, depth: float = 0.0) -> tuple[RealArray, RealArray]:
    """Nodes C (…, n) where peaks above D + depth/C lie, and weights with erf(C/2) exp(-C²/12)
    C^(-k)."""
    from scipy.special import erf

    # peaks at height s have C about 2s with deviation √2; those deeper than depth/C lie about s =
    # D + depth/C
    panels = _DEEP_PANELS if depth > 0.0 else _PANELS
    above = np.maximum(D, 0.0)
    ends = np.stack([np.maximum(0.0, 2.0 * D - 13.0), above + np.sqrt(above**2 + 2.0 * depth) + _REACH], axis=-1)
    breaks = np.sqrt(ends[..., :1]) + np.linspace(0.0, 1.0, panels + 1) * np.diff(np.sqrt(ends), axis=-1)
    root, weight = gauss(breaks, _NODES)
    C = root * root
    return C, _NORM * weight * 2.0 * root * erf(0.5 * C) * np.exp(-C * C / 12.0) * C ** (-k)


# Three-point peaks of sampled Gaussian profiles (Whitehouse & Archard 1970; Whitehouse & Phillips
# 1978).


@dataclass(frozen=True)
class SampledPeaks(Theory):
    """Peaks of a Gaussian profile sampled at an interval ℓ, from the correlations ρ1 = ρ(ℓ) and
    ρ2 = ρ(2ℓ).

    A peak is a point above both neighbours. Heights are in standard deviations of the profile,
    curvatures C = (2 z2 - z1 - z3)/σ in σ/ℓ². At given height s curvature and slope z1 - z3 are
    independently normal,

        E(C) = 2 s (1 - ρ_1),  Var(C) = 2 (1 + ρ_2 - 2 ρ_1²),  Var(z_1 - z_3) = 2 (1 - ρ_2) σ².

    InputError if no Gaussian profile has these correlations.
    """

    rho_1: Annotated[float, Number(above=-1.0, below=1.0), "correlation of neighbouring points"]
    rho_2: Annotated[float, Number(above=-1.0, below=1.0), "correlation of next neighbours"]
    name: ClassVar[str] = "sampled-peaks"
    title: ClassVar[str] = "Whitehouse-Archard, peaks of a sampled profile"
    citation_keys: ClassVar[tuple[str, ...]] = ("Whitehouse1970", "Whitehouse1978")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("fraction", "1", "peaks per point"),
        Quantity("mean_height", "1", "mean height of the peaks in rms heights"),
        Quantity("height_deviation", "1", "standard deviation of their heights in rms heights"),
        Quantity("mean_curvature", "1", "mean curvature of the peaks in rms heights per squared interval"),
        Quantity("curvature_deviation", "1", "standard deviation of their curvature in the same unit"),
        Quantity("height_curvature_correlation", "1", "correlation of height and curvature"),
        Quantity("zero_crossings", "1", "crossings of the mean line per point"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 1.0 + self.rho_2 - 2.0 * self.rho_1**2 > 0.0:
            raise InputError(
                f"correlations of a profile must have 1 + rho_2 - 2 rho_1^2 > 0, but are {self.rho_1:g}, "
                f"{self.rho_2:g}."
            )

    @property
    def fraction(self) -> float:
        """Peaks per point: (1/π) arctan sqrt[(3 - 4ρ1 + ρ2)/(1 - ρ2)]."""
        return math.atan(math.sqrt(self._curvature_variance / (2.0 * (1.0 - self.rho_2)))) / math.pi

    @property
    def mean_height(self) -> float:
        """Mean height of the peaks in σ: sqrt[(1 - ρ1)/π]/(2N), N peaks per point."""
        return math.sqrt((1.0 - self.rho_1) / math.pi) / (2.0 * self.fraction)

    @property
    def mean_curvature(self) -> float:
        """Mean curvature of the peaks in σ/ℓ²: (3 - 4ρ1 + ρ2)/(2N sqrt[π(1 - ρ1)])."""
        return 0.5 * self._curvature_variance / (2.0 * self.fraction * math.sqrt(math.pi * (1.0 - self.rho_1)))

    @property
    def curvature_deviation(self) -> float:
        """Standard deviation of the curvature of the peaks in σ/ℓ².

        <C²> over the peaks is ∫₀^∞ C² n(C) erf(C/2sqrt(1 - ρ2)) dC/N with n the normal density of
        C; with a² = Var C and b² the variance of the slope, the integral is (a²/π) [arctan(a/b) +
        ab/(a² + b²)].
        """
        a, b = math.sqrt(self._curvature_variance), math.sqrt(2.0 * (1.0 - self.rho_2))
        mean_square = a**2 / math.pi * (math.atan(a / b) + a * b / (a**2 + b**2)) / self.fraction
        return math.sqrt(mean_square - self.mean_curvature**2)

    @property
    def height_deviation(self) -> float:
        """Standard deviation of the heights of the peaks in σ."""
        # the height is its regression on the curvature and an independent normal rest
        regression = 2.0 * (1.0 - self.rho_1) / self._curvature_variance
        rest = 1.0 - regression**2 * self._curvature_variance
        return math.sqrt(rest + regression**2 * self.curvature_deviation**2)

    @property
    def height_curvature_correlation(self) -> float:
        """Correlation of height and curvature over the peaks."""
        regression = 2.0 * (1.0 - self.rho_1) / self._curvature_variance  # slope of the mean height over the curvature
        return regression * self.curvature_deviation / self.height_deviation

    @property
    def zero_crossings(self) -> float:
        """Crossings of the mean line per point: arccos(ρ1)/π."""
        return math.acos(self.rho_1) / math.pi

    @property
    def _curvature_variance(self) -> float:
        """Variance of C over all points: 2(3 - 4ρ1 + ρ2)."""
        return 2.0 * (3.0 - 4.0 * self.rho_1 + self.rho_2)
