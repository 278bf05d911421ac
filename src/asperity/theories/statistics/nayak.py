"""Summits of an isotropic Gaussian surface (Longuet-Higgins 1957; Nayak 1971; McCool 1986)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ..ask import Way, asked
from ..protocol import MeanSquareBend, MeanSquareHeight, MeanSquareSlope, Theory, real_numbers
from .roughness import Roughness

GEOMETRIC_CURVATURE = 1.35621131344399
"""<sqrt(κ1 κ2)>/sqrt(m4) over all summits, by quadrature of (t² - u)^(3/2) e^(-u) φ(t)."""

NARROWEST = 1.5
"""α of a surface with a single wavelength, the least of all isotropic ones."""

ROUNDING = 1e-9
"""Share by which α of a computed narrow spectrum may lie below 1.5."""

_NODES, _SIGMAS = 96, 9.5  # Gauss points, and the standard deviations that matter of curvatures at one height


@dataclass(frozen=True, eq=False, repr=False)
class SummitsAt(Tabled):
    """Summits at heights (n,): ``probability`` density in 1/m, ``curvature`` the mean of κ in
    1/m."""

    probability: RealArray
    curvature: RealArray


@dataclass(frozen=True)
class NayakSummits(Theory):
    """Statistics of the summits of an isotropic Gaussian surface with the profile moments m0, m2,
    m4.

    With ξ = z/sqrt(m0) and the mean curvature κ = -∇²z/2 = t sqrt(2 m4/3) of a summit, the summits
    have the density η and the joint distribution of height and curvature

        η = m_4/(6 π √3 m_2),  α = m_0 m_4/m_2²,
        p(ξ, t) = 2 √3 (t² - 1 + e^(-t²)) φ_2(ξ, t; ρ),  t > 0,  ρ = sqrt(3/(2 α)).

    InputError if a moment is not positive or α < 1.5, which no isotropic surface has.
    """

    m0: MeanSquareHeight
    m2: MeanSquareSlope
    m4: MeanSquareBend
    name: ClassVar[str] = "nayak"
    title: ClassVar[str] = "Nayak, summits of a Gaussian surface"
    citation_keys: ClassVar[tuple[str, ...]] = ("LonguetHiggins1957", "McCool1986", "Nayak1971")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("alpha", "1", "bandwidth m0 m4/m2²"),
        Quantity("density", "1/m^2", "summits per area"),
        Quantity("mean_height", "m", "mean height of the summits above the mean plane"),
        Quantity("height_deviation", "m", "standard deviation of the summit heights"),
        Quantity("height_skewness", "1", "skewness of the summit heights"),
        Quantity("height_kurtosis", "1", "kurtosis of the summit heights"),
        Quantity("radius", "m", "1/<κ>, κ the mean curvature"),
        Quantity("mean_curvature", "1/m", "mean of κ"),
        Quantity("curvature_deviation", "1/m", "standard deviation of κ"),
        Quantity("height_curvature_correlation", "1", "correlation of height and κ"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("height", "m", "height above the mean plane"),
            "at_height",
            (
                Quantity("probability", "1/m", "probability density of the summit heights"),
                Quantity("curvature", "1/m", "mean of κ over the summits of this height"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.alpha < NARROWEST * (1.0 - ROUNDING):
            raise InputError(
                f"moments of an isotropic surface must have m0 m4/m2^2 >= 1.5, but have {self.alpha:.6g}. "
                "Finite differences on a coarse grid or an anisotropic surface can give less."
            )

    @classmethod
    def of_roughness(cls, roughness: Roughness) -> Self:
        """Summits of a Gaussian surface with the moments of ``roughness``."""
        return cls(roughness.m0, roughness.m2, roughness.m4)

    @property
    def alpha(self) -> float:
        """Nayak's bandwidth parameter m0 m4/m2²."""
        return self.m0 * self.m4 / self.m2**2

    @property
    def correlation(self) -> float:
        """ρ = sqrt(3/(2α)) of height and mean curvature over the whole surface."""
        return min(1.0, math.sqrt(1.5 / self.alpha))

    @property
    def density(self) -> float:
        """Summits per area in 1/m²: m4/(6π√3 m2)."""
        return self.m4 / (6.0 * math.pi * math.sqrt(3.0) * self.m2)

    @property
    def mean_height(self) -> float:
        """Mean height of the summits above the mean plane in m: 4 sqrt(m0/(πα))."""
        return math.sqrt(self.m0) * self.correlation * _curvature_moment(1)

    @property
    def height_deviation(self) -> float:
        """Standard deviation σ_s of the summit heights in m: sqrt[(1 - 0.8968/α) m0]."""
        return math.sqrt(self.m0 * self._height_cumulants()[0])

    @property
    def height_skewness(self) -> float:
        """Skewness of the summit heights."""
        variance, third, _ = self._height_cumulants()
        return float(third / variance**1.5)

    @property
    def height_kurtosis(self) -> float:
        """Kurtosis of the summit heights, 3 for a Gaussian."""
        variance, _, fourth = self._height_cumulants()
        return 3.0 + fourth / variance**2

    @property
    def mean_curvature(self) -> float:
        """Mean of κ over the summits in 1/m: (8/3) sqrt(m4/π)."""
        return math.sqrt(2.0 * self.m4 / 3.0) * _curvature_moment(1)

    @property
    def radius(self) -> float:
        """R = 1/<κ> in m: (3/8) sqrt(π/m4)."""
        return 1.0 / self.mean_curvature

    @property
    def curvature_deviation(self) -> float:
        """Standard deviation of κ over the summits in 1/m: 0.5178 sqrt(m4)."""
        return math.sqrt(2.0 * self.m4 / 3.0) * math.sqrt(_curvature_cumulants()[0])

    @property
    def mean_geometric_curvature(self) -> float:
        """<sqrt(κ1 κ2)> over the summits in 1/m: 1.3562 sqrt(m4)."""
        return GEOMETRIC_CURVATURE * math.sqrt(self.m4)

    @property
    def height_curvature_correlation(self) -> float:
        """Correlation of height and mean curvature over the summits."""
        return self.correlation * math.sqrt(_curvature_cumulants()[0] / self._height_cumulants()[0])

    def height_density(self, height: ArrayLike) -> RealArray:
        """Probability density in 1/m of the summit heights at ``height`` in m (any shape)."""
        xi = real_numbers(height, "heights (m)") / math.sqrt(self.m0)
        scale, moments = self._partial_moments(xi)
        return np.exp(scale) * moments[0] / math.sqrt(self.m0)

    def mean_curvature_at(self, height: ArrayLike) -> RealArray:
        """Mean of κ in 1/m over the summits at ``height`` in m (any shape): higher summits are
        sharper."""
        xi = real_numbers(height, "heights (m)") / math.sqrt(self.m0)
        moments = self._partial_moments(xi)[1]
        with np.errstate(invalid="ignore"):  # no summits below the mean plane where there is a single wavelength
            return np.asarray(math.sqrt(2.0 * self.m4 / 3.0) * moments[1] / moments[0])

    def at_height(self, height: ArrayLike) -> SummitsAt:
        """Summits at ``height`` in m (any shape)."""
        return SummitsAt(self.height_density(height), self.mean_curvature_at(height))

    def _height_cumulants(self) -> tuple[float, float, float]:
        """Second to fourth cumulant of ξ = ρ t + sqrt(1 - ρ²) n, n standard normal and independent
        of t."""
        rho, (second, third, fourth) = self.correlation, _curvature_cumulants()
        return rho**2 * second + 1.0 - rho**2, rho**3 * third, rho**4 * fourth

    def _partial_moments(self, xi: RealArray) -> tuple[RealArray, tuple[RealArray, RealArray]]:
        """∫₀^∞ p(ξ, t) dt and ∫₀^∞ t p(ξ, t) dt for ξ = ``xi``, without the factor whose logarithm
        comes first.

        p = 2√3 (t² - 1 + e^(-t²)) φ(ξ) times the normal density of t of mean ρξ and variance 1 -
        ρ². Nothing is subtracted, so the moments keep their digits far below the mean plane, where
        only the flattest summits are left.
        """
        variance, mean = 1.0 - self.correlation**2, self.correlation * xi
        plain = -0.5 * xi**2 + math.log(2.0 * math.sqrt(3.0) / math.sqrt(2.0 * math.pi))
        if variance < ROUNDING:  # a single wavelength: t = ξ
            t = np.maximum(xi, 0.0)
            return plain, (_flatness(t), t * _flatness(t))
        first = np.maximum(mean - _SIGMAS * math.sqrt(variance), 0.0)
        rise = np.minimum(mean, 0.0) ** 2  # (t - mean)² where the density is largest
        reach = _SIGMAS**2 * variance
        last = np.where(mean > 0.0, mean + math.sqrt(reach), reach / (np.sqrt(rise + reach) + np.abs(mean)))
        t, weight = gauss(np.stack([first, last], axis=-1), _NODES)
        density = np.exp(-0.5 * ((t - mean[..., None]) ** 2 - rise[..., None]) / variance) / math.sqrt(
            2.0 * math.pi * variance
        )
        weight = weight * density * _flatness(t)
        return plain - 0.5 * rise / variance, (weight.sum(axis=-1), (t * weight).sum(axis=-1))


def _flatness(t: RealArray) -> RealArray:
    """t² - 1 + e^(-t²) for t >= 0, of small t by its series t⁴/2 - t⁶/6 + …."""
    square = t**2
    small = np.minimum(square, 0.1)
    series = small**2 * np.polynomial.polynomial.polyval(small, [(-1.0) ** k / math.factorial(k) for k in range(2, 13)])
    return np.where(square < 0.1, series, square + np.expm1(-square))


def _curvature_moment(power: int) -> float:
    """<t^power> over the summits: 2√3 ∫₀^∞ t^power (t² - 1 + e^(-t²)) φ(t) dt."""
    normal = [math.pow(2.0, 0.5 * n - 1.0) * math.gamma(0.5 * (n + 1)) / math.sqrt(math.pi) for n in (power, power + 2)]
    damped = math.pow(2.0 / 3.0, 0.5 * (power + 1)) * math.gamma(0.5 * (power + 1)) / math.sqrt(8.0 * math.pi)
    return 2.0 * math.sqrt(3.0) * (normal[1] - normal[0] + damped)


def _curvature_cumulants() -> tuple[float, float, float]:
    """Second to fourth cumulant of t over the summits."""
    first, second, third, fourth = (_curvature_moment(n) for n in (1, 2, 3, 4))
    variance = second - first**2
    central_3 = third - 3.0 * first * second + 2.0 * first**3
    central_4 = fourth - 4.0 * first * third + 6.0 * first**2 * second - 3.0 * first**4
    return variance, central_3, central_4 - 3.0 * variance**2
