"""Pearson's system of distributions: the one with given skewness and kurtosis, of zero mean and unit variance.

With β1 = skewness² and β2 = kurtosis the density obeys f'/f = -(x + c1)/(c0 + c1 x + c2 x²) with c0 = (4 β2 - 3 β1)/Δ,
c1 = sqrt(β1) (β2 + 3)/Δ, c2 = (2 β2 - 3 β1 - 6)/Δ and Δ = 10 β2 - 12 β1 - 18 (Pearson 1895, 1916). The sign of
ϰ = c1²/(4 c0 c2) and whether it exceeds 1 tell the type.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from . import require
from .arrays import RealArray
from .errors import InputError
from .pearson_beta import BetaCurve, BetaPrimeCurve
from .pearson_curves import Curve, MirroredCurve, NormalCurve
from .pearson_gamma import GammaCurve, InverseGammaCurve
from .pearson_iv import StudentLikeCurve
from .quadrature import partial_moment

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

TYPES = ("normal", "I", "II", "III", "IV", "V", "VI", "VII")
"""Types of the system in the order of their numbers."""

_ON_LINE = 1e-11  # relative distance from a line between two types below which that of the line serves
_TABLE_STEP, _TABLE_REACH = 0.02, 10.0  # quantiles at normal numbers, between which a cubic spline is good to 1e-8


@dataclass(frozen=True)
class Pearson:
    """Distribution of Pearson's system with zero mean, unit variance and the given ``skewness`` and ``kurtosis``.

    Types I and II have bounds on both sides, III, V and VI on one side, IV, VII and the normal on none.

    Parameters
    ----------
    skewness
        Third moment.
    kurtosis
        Fourth moment, above 1 + skewness²; 3 for a Gaussian.

    Raises
    ------
    InputError
        If kurtosis <= 1 + skewness², where there is no distribution, or only one of two values.
    """

    skewness: float
    kurtosis: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Pearson1895", "Pearson1916", "Takahasi1974")

    def __post_init__(self) -> None:
        require_possible(self.skewness, self.kurtosis)
        least = 1.0 + self.skewness**2
        if self.kurtosis <= least * (1.0 + _ON_LINE):
            raise InputError(
                f"kurtosis of the heights must exceed its limit 1 + skewness² = {least:.4g}, at which there are only two "
                f"heights, but is {self.kurtosis:.4g}."
            )

    @property
    def coefficients(self) -> tuple[float, float, float]:
        """c0, c1, c2 of the differential equation, c1 with the sign of the skewness; infinite where Δ = 0."""
        c0, c1, c2, delta = self._scaled
        with np.errstate(divide="ignore", invalid="ignore"):
            values = np.array([c0, math.copysign(c1, self.skewness), c2]) / np.float64(delta)
        return float(values[0]), float(values[1]), float(values[2])

    @property
    def criterion(self) -> float:
        """ϰ = c1²/(4 c0 c2), infinite on the line of type III."""
        c0, c1, c2, _ = self._scaled
        return c1**2 / (4.0 * c0 * c2) if c2 != 0.0 else math.inf

    @property
    def mode(self) -> float:
        """Where the slope of the density vanishes, -c1: a maximum, or the minimum of a U-shaped density."""
        return -self.coefficients[1]

    @cached_property
    def type(self) -> str:
        """Type of the curve, one of ``TYPES``."""
        c0, _, c2, _ = self._scaled
        if abs(c2) <= _ON_LINE * c0:
            return "normal" if self.skewness == 0.0 else "III"
        if self.skewness == 0.0:
            return "II" if c2 < 0.0 else "VII"
        if c2 < 0.0:
            return "I"
        if abs(self.criterion - 1.0) <= _ON_LINE:
            return "V"
        return "IV" if self.criterion < 1.0 else "VI"

    @property
    def label(self) -> str:
        """Name of the curve in words."""
        return "normal" if self.type == "normal" else f"Pearson's type {self.type}"

    @property
    def support(self) -> tuple[float, float]:
        """Bounds between which the density is positive, infinite where there is none."""
        return self._curve.low, self._curve.high

    def pdf(self, x: ArrayLike) -> RealArray:
        """Density at ``x`` (any shape), zero outside of the support."""
        given = np.asarray(x, dtype=np.float64)
        low, high = self.support
        inside = (given > low) & (given < high)
        safe = np.where(inside, given, 0.0)
        density: RealArray = np.where(inside, np.exp(self._curve.log_density(safe, safe - low, high - safe)), 0.0)
        return density

    def cdf(self, x: ArrayLike) -> RealArray:
        """Probability of values below ``x`` (any shape), relatively accurate where it is small."""
        return self._curve.lower(np.asarray(x, dtype=np.float64))

    def survival(self, x: ArrayLike) -> RealArray:
        """Probability of values above ``x`` (any shape), relatively accurate where it is small."""
        return self._curve.upper(np.asarray(x, dtype=np.float64))

    def quantile(self, probability: ArrayLike) -> RealArray:
        """x below which values lie with the given ``probability``, between 0 and 1 (any shape)."""
        return self._curve.at_lower(np.asarray(probability, dtype=np.float64))

    def of_normal(self, normal: ArrayLike) -> RealArray:
        """The number of this distribution for each standard ``normal`` number (any shape); increasing.

        Numbers between -10 and 10, which hold all but 1e-23 of the probability, are taken from a table with cubic splines.
        """
        given = np.asarray(normal, dtype=np.float64)
        values = np.array(self._table(np.clip(given, -_TABLE_REACH, _TABLE_REACH)))
        far = np.abs(given) > _TABLE_REACH
        if far.any():
            values[far] = self._at_normal(given[far])
        return values

    def excess_moment(self, order: float, level: ArrayLike) -> RealArray:
        """F_m(D) = ∫_D^∞ (s - D)^m f(s) ds for the order m at each ``level`` D (any shape).

        Raises
        ------
        InputError
            If m is not between -1 and 4; higher moments do not exist for all types.
        """
        require.between(order, -1.0, 4.0, "order of the moment of the excess")
        return partial_moment(self._curve.log_density, self.support, order, np.asarray(level, dtype=np.float64))

    @property
    def _scaled(self) -> tuple[float, float, float, float]:
        """Δ c0, Δ |c1|, Δ c2 and Δ, all finite."""
        b1, b2 = self.skewness**2, self.kurtosis
        c0, c1 = 4.0 * b2 - 3.0 * b1, abs(self.skewness) * (b2 + 3.0)
        return c0, c1, 2.0 * b2 - 3.0 * b1 - 6.0, 10.0 * b2 - 12.0 * b1 - 18.0

    @cached_property
    def _curve(self) -> Curve:
        curve = self._curve_of_positive_skewness()
        return MirroredCurve(curve) if self.skewness < 0.0 else curve

    def _curve_of_positive_skewness(self) -> Curve:
        c0, c1, c2, delta = self._scaled
        if self.type == "normal":
            return NormalCurve()
        if self.type == "III":
            return GammaCurve(c0 / delta, c1 / delta)
        if self.type in ("IV", "VII"):
            return StudentLikeCurve(c0 / delta, c1 / delta, c2 / delta)
        if self.type == "V":
            return InverseGammaCurve(c1 / delta, c2 / delta)
        far = -0.5 * (c1 + math.sqrt(max(0.0, c1**2 - 4.0 * c0 * c2))) / c2  # a sum of one sign: no digits cancel
        a1, a2 = sorted((far, c0 / (c2 * far)))
        m1, m2 = (delta * a1 + c1) / (c2 * (a2 - a1)), -(delta * a2 + c1) / (c2 * (a2 - a1))
        return BetaPrimeCurve(a1, a2, m1, m2) if self.type == "VI" else BetaCurve(a1, a2, m1, m2)

    def _at_normal(self, normal: RealArray) -> RealArray:
        from scipy.special import ndtr

        tail = ndtr(-np.abs(normal))
        return np.where(normal < 0.0, self._curve.at_lower(tail), self._curve.at_upper(tail))

    @cached_property
    def _table(self) -> CubicSpline:
        from scipy.interpolate import CubicSpline

        count = round(2.0 * _TABLE_REACH / _TABLE_STEP) + 1
        normal = np.linspace(-_TABLE_REACH, _TABLE_REACH, count)
        return CubicSpline(normal, self._at_normal(normal))


def require_possible(skewness: float, kurtosis: float) -> None:
    """Refuse a pair that no distribution has.

    Raises
    ------
    InputError
        If kurtosis < 1 + skewness².
    """
    require.finite(skewness, "skewness of the heights")
    require.finite(kurtosis, "kurtosis of the heights")
    least = 1.0 + skewness**2
    if kurtosis < least:
        raise InputError(
            f"kurtosis of the heights must be at least 1 + skewness² = {least:.4g}, as that of every distribution, "
            f"but is {kurtosis:.4g}. It is 3, not 0, for Gaussian heights."
        )
