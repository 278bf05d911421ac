"""Pearson's system of distributions: the one with given skewness and kurtosis, of zero mean and
unit variance.

With β1 = skewness² and β2 = kurtosis the density obeys f'/f = -(x + c1)/(c0 + c1 x + c2 x²) with
c0 = (4 β2 - 3 β1)/Δ, c1 = sqrt(β1) (β2 + 3)/Δ, c2 = (2 β2 - 3 β1 - 6)/Δ and Δ = 10 β2 - 12 β1 - 18
(Pearson 1895, 1916). The sign of ϰ = c1²/(4 c0 c2) and whether it exceeds 1 decide the type.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike

from . import require
from .arrays import RealArray
from .errors import InputError
from .quadrature import LogDensity, gauss, partial_moment
from .scipy_parts import interpolate, special

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline
TYPES = ("normal", "I", "II", "III", "IV", "V", "VI", "VII")
"""Types of the system in the order of their numbers."""

_ON_LINE = 1e-11  # relative distance from a line between two types below which that of the line serves
_SYMMETRIC = 1e-8  # |skewness| taken for zero: that is the error made, and the one of rounding if it were not
_TABLE_STEP, _TABLE_REACH = 0.02, 10.0  # quantiles at normal numbers, between which a cubic spline is good to 1e-8
_PANEL, _ORDER = 0.125, 10  # type IV: panels in t = arsinh x and Gauss points in each; twice as many change nothing
_REACH = 190.0  # the tails fall at least as x^-6, that is below exp(-745), the least positive number
_NEAREST = 1e-100  # distance from the end of type V below which its density is zero
_LEAST = 1e-300  # probabilities below are taken for this one
_NEWTON = 4  # steps, each of which squares an error that starts below 1e-2


@dataclass(frozen=True)
class Pearson:
    """Distribution of Pearson's system with zero mean, unit variance and the given ``skewness`` and
    ``kurtosis``.

    Types I and II have bounds on both sides, III, V and VI on one side, IV, VII and the normal on
    none.

    InputError if kurtosis <= 1 + skewness², where there is no distribution, or only one of two
    values.

    Parameters
    ----------
    skewness
        Third moment.
    kurtosis
        Fourth moment, above 1 + skewness²; 3 for a Gaussian.
    """

    skewness: float
    kurtosis: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Pearson1895", "Pearson1916", "Takahasi1974")

    def __post_init__(self) -> None:
        require_possible(self.skewness, self.kurtosis)
        least = 1.0 + self.skewness**2
        if self.kurtosis <= least * (1.0 + _ON_LINE):
            raise InputError(
                f"kurtosis of the heights must exceed its limit 1 + skewness² = {least:.4g}, at which there "
                f"are only two heights, but is {self.kurtosis:.4g}."
            )

    @property
    def coefficients(self) -> tuple[float, float, float]:
        """c0, c1, c2 of the differential equation, c1 with the sign of the skewness; infinite where
        Δ = 0."""
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
        """Where the slope of the density vanishes, -c1: a maximum, or the minimum of a U-shaped
        density."""
        return -self.coefficients[1]

    @cached_property
    def type(self) -> str:
        """Type of the curve, one of ``TYPES``."""
        c0, _, c2, _ = self._scaled
        symmetric = abs(self.skewness) <= _SYMMETRIC
        if abs(c2) <= _ON_LINE * c0:
            return "normal" if symmetric else "III"
        if symmetric:
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
        low, high = self._curve.low, self._curve.high
        return (-high, -low) if self.skewness < 0.0 else (low, high)

    def pdf(self, x: ArrayLike) -> RealArray:
        """Density at ``x`` (any shape), zero outside of the support."""
        given = np.asarray(x, dtype=np.float64)
        low, high = self.support
        inside = (given > low) & (given < high)
        safe = np.where(inside, given, 0.0)
        return np.where(inside, np.exp(self._log_density(safe, safe - low, high - safe)), 0.0)

    def cdf(self, x: ArrayLike) -> RealArray:
        """Probability of values below ``x`` (any shape), relatively accurate where it is small."""
        given, law = np.asarray(x, dtype=np.float64), self._curve.law
        return np.asarray(law.sf(-given) if self.skewness < 0.0 else law.cdf(given))

    def survival(self, x: ArrayLike) -> RealArray:
        """Probability of values above ``x`` (any shape), relatively accurate where it is small."""
        given, law = np.asarray(x, dtype=np.float64), self._curve.law
        return np.asarray(law.cdf(-given) if self.skewness < 0.0 else law.sf(given))

    def quantile(self, probability: ArrayLike) -> RealArray:
        """x below which values lie with the given ``probability``, between 0 and 1 (any shape)."""
        given, law = np.asarray(probability, dtype=np.float64), self._curve.law
        return np.asarray(-law.isf(given) if self.skewness < 0.0 else law.ppf(given))

    def of_normal(self, normal: ArrayLike) -> RealArray:
        """The number of this distribution for each standard ``normal`` number (any shape);
        increasing.

        Numbers between -10 and 10, which hold all but 1e-23 of the probability, are taken from a
        table with cubic splines.
        """
        given = np.asarray(normal, dtype=np.float64)
        values = np.array(self._table(np.clip(given, -_TABLE_REACH, _TABLE_REACH)))
        far = np.abs(given) > _TABLE_REACH
        if far.any():
            values[far] = self._at_normal(given[far])
        return values

    def excess_moment(self, order: float, level: ArrayLike) -> RealArray:
        """F_m(D) = ∫_D^∞ (s - D)^m f(s) ds for the order m at each ``level`` D (any shape).

        InputError if m is not between -1 and 4; higher moments do not exist for all types.
        """
        require.between(order, -1.0, 4.0, "order of the moment of the excess")
        return partial_moment(self._log_density, self.support, order, np.asarray(level, dtype=np.float64))

    @property
    def _scaled(self) -> tuple[float, float, float, float]:
        """Δ c0, Δ |c1|, Δ c2 and Δ, all finite."""
        b1, b2 = self.skewness**2, self.kurtosis
        c0, c1 = 4.0 * b2 - 3.0 * b1, abs(self.skewness) * (b2 + 3.0)
        return c0, c1, 2.0 * b2 - 3.0 * b1 - 6.0, 10.0 * b2 - 12.0 * b1 - 18.0

    @cached_property
    def _curve(self) -> _Curve:
        """The curve of the skewness without its sign; the distribution of negative skewness is that
        of -x."""
        return _curve(self.type, *self._scaled)

    def _log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        if self.skewness < 0.0:
            return self._curve.relative(-x, from_high, from_low) - self._curve.log_norm
        return self._curve.relative(x, from_low, from_high) - self._curve.log_norm

    def _at_normal(self, normal: RealArray) -> RealArray:
        law, tail, mirrored = self._curve.law, special.ndtr(-np.abs(normal)), self.skewness < 0.0
        of_low = (normal < 0.0) != mirrored
        x = np.where(of_low, law.ppf(tail), law.isf(tail))
        return -x if mirrored else x

    @cached_property
    def _table(self) -> CubicSpline:
        count = round(2.0 * _TABLE_REACH / _TABLE_STEP) + 1
        normal = np.linspace(-_TABLE_REACH, _TABLE_REACH, count)
        return interpolate.CubicSpline(normal, self._at_normal(normal))


def require_possible(skewness: float, kurtosis: float) -> None:
    """Refuse a pair that no distribution has. InputError if kurtosis < 1 + skewness²."""
    require.finite(skewness, "skewness of the heights")
    require.finite(kurtosis, "kurtosis of the heights")
    least = 1.0 + skewness**2
    if kurtosis < least:
        raise InputError(
            f"kurtosis of the heights must be at least 1 + skewness² = {least:.4g}, as that of every distribution, "
            f"but is {kurtosis:.4g}. It is 3, not 0, for Gaussian heights."
        )


# The curves, of positive skewness. Distribution functions and most quantiles are SciPy's; its
# densities lose 1e-8 where shape parameters reach 1e6 (skewness 1e-3 on the line of type III),
# whereas ln f(x)/f(0) with a norm by quadrature keeps its digits.


class _Law(Protocol):
    """Distribution function and quantiles from below and from above, as ``scipy.stats`` names
    them."""

    def cdf(self, x: RealArray, /) -> RealArray: ...
    def sf(self, x: RealArray, /) -> RealArray: ...
    def ppf(self, q: RealArray, /) -> RealArray: ...
    def isf(self, q: RealArray, /) -> RealArray: ...


@dataclass(frozen=True, eq=False)
class _Curve:
    """A distribution ``law``, ``relative`` = ln f(x)/f(0) and the ends."""

    law: _Law
    relative: LogDensity
    low: float = -math.inf
    high: float = math.inf

    @cached_property
    def log_norm(self) -> float:
        """Logarithm of the integral of f(x)/f(0); without a lower end, of the part above 0 and of
        that below, mirrored."""
        if math.isfinite(self.low):
            return math.log(partial_moment(self.relative, (self.low, self.high), 0.0, np.array(self.low)))
        ends, zero = (-math.inf, math.inf), np.zeros(())
        above = partial_moment(self.relative, ends, 0.0, zero)
        return math.log(above + partial_moment(lambda x, low, high: self.relative(-x, high, low), ends, 0.0, zero))


def _curve(kind: str, c0: float, c1: float, c2: float, delta: float) -> _Curve:
    """Curve of the type ``kind`` with the coefficients c0/delta, c1/delta >= 0 and c2/delta."""
    from scipy import stats

    law: _Law
    if kind == "normal":
        return _Curve(stats.norm(), lambda x, *_: -0.5 * x**2)
    if kind == "III":  # (x - low)^(shape - 1) exp(-x/scale)
        shape, low, scale = c0 * delta / c1**2, -c0 / c1, c1 / delta
        law = stats.gamma(shape, low, scale)
        return _Curve(law, lambda x, y, _: (shape - 1.0) * _log_ratio(x, y, -low) - x / scale, low)
    if kind == "IV":
        four = _TypeIV(c0 / delta, c1 / delta, c2 / delta)
        return _Curve(four, lambda x, *_: four.relative(x))
    if kind == "V":
        c1, c2 = c1 / delta, c2 / delta
        shape, low = 1.0 / c2 - 1.0, -0.5 * c1 / c2  # y^-(shape + 1) exp(-b/y), y = x - low
        b = -(low + c1) / c2

        def relative(x: RealArray, from_low: RealArray, _from_high: RealArray) -> RealArray:
            y = np.maximum(from_low, _NEAREST)
            return -b / low * (x / y) - (shape + 1.0) * _log_ratio(x, y, -low)

        return _Curve(stats.invgamma(shape, low, b), relative, low)
    if kind == "VII":  # (1 + c2 x²/c0)^-m
        m = 0.5 * delta / c2
        law = stats.t(2.0 * m - 1.0, scale=math.sqrt(c0 / c2 / (2.0 * m - 1.0)))
        return _Curve(law, lambda x, *_: -m * np.log1p(c2 / c0 * x**2))
    far = -0.5 * (c1 + math.sqrt(max(0.0, c1**2 - 4.0 * c0 * c2))) / c2  # a sum of one sign: no digits cancel
    a1, a2 = sorted((far, c0 / (c2 * far)))
    width = a2 - a1
    m1, m2 = (delta * a1 + c1) / (c2 * width), -(delta * a2 + c1) / (c2 * width)
    if kind == "VI":  # (x - a1)^m1 (x - a2)^m2 above a2 > a1
        law = _Beta(m2 + 1.0, -m1 - m2 - 1.0, a2, width, prime=True)
        return _Curve(law, lambda x, y, _: m1 * _log_ratio(x, y + width, -a1) + m2 * _log_ratio(x, y, -a2), a2)
    law = _Beta(m1 + 1.0, m2 + 1.0, a1, width)  # (x - a1)^m1 (a2 - x)^m2
    return _Curve(law, lambda x, y, rest: m1 * _log_ratio(x, y, -a1) + m2 * _log_ratio(-x, rest, a2), a1, a2)


def _log_ratio(x: RealArray, from_end: RealArray, distance: float) -> RealArray:
    """ln(1 + x/distance) = ln(from_end/distance), the form of it that keeps its digits."""
    near = np.abs(x) < 0.5 * distance
    # next to an end where the density is infinite, the ratio must not round to zero
    far = np.log(np.maximum(np.where(near, 1.0, from_end) / distance, np.finfo(np.float64).smallest_subnormal))
    return np.where(near, np.log1p(np.where(near, x, 0.0) / distance), far)


class _Beta:
    """Types I and II, where z = (x - low)/width has a beta distribution of p and q, and VI, where
    z/(1 - z) is that ratio."""

    def __init__(self, p: float, q: float, low: float, width: float, *, prime: bool = False) -> None:
        from scipy import stats

        law = stats.betaprime(p, q, low, width) if prime else stats.beta(p, q, low, width)
        self.cdf, self.sf = law.cdf, law.sf
        self.p, self.q, self.low, self.width, self.prime = p, q, low, width, prime

    def ppf(self, q: RealArray, /) -> RealArray:
        """The x below which values have the probability ``q``."""
        return self._x(*_beta_quantiles(self.p, self.q, q))

    def isf(self, q: RealArray, /) -> RealArray:
        """The x above which values have the probability ``q``."""
        return self._x(*_beta_quantiles(self.q, self.p, q)[::-1])

    def _x(self, z: RealArray, rest: RealArray) -> RealArray:
        if self.prime:
            with np.errstate(divide="ignore"):
                return np.asarray(self.low + self.width * z / rest)
        return np.where(z < rest, self.low + self.width * z, self.low + self.width - self.width * rest)


def _beta_quantiles(a: float, b: float, probability: RealArray) -> tuple[RealArray, RealArray]:
    """z below which a number with the beta distribution of a, b lies, and 1 - z; by the first term
    of the series at small z.

    SciPy's inverses are nan or far off for some probabilities below 1e-15 (a = 1.03, b = 0.44),
    where that term is all that counts.
    """
    with np.errstate(divide="ignore"):
        first = np.exp((np.log(probability) + math.log(a) + float(special.betaln(a, b))) / a)
    z = np.where(first * max(1.0, b) < 1e-9, first, special.betaincinv(a, b, probability))
    return z, np.asarray(special.betainccinv(b, a, probability))


@dataclass(frozen=True)
class _TypeIV:
    """(1 + u²)^(-m) exp(-ν arctan u), u = (x - λ)/a, m = 1/(2 c2), λ = -c1/(2 c2), a² = c0/c2 - λ²,
    ν = (c1 + λ)/(c2 a).

    Its distribution function is integrated over t, x = sinh t, in which the algebraic tails are
    exponential ones.
    """

    c0: float
    c1: float
    c2: float

    def cdf(self, x: RealArray, /) -> RealArray:
        """Probability below ``x``."""
        return np.asarray(self._below(np.arcsinh(x)) / self._sums[-1])

    def sf(self, x: RealArray, /) -> RealArray:
        """Probability above ``x``."""
        return self._mirrored.cdf(-x)

    def ppf(self, q: RealArray, /) -> RealArray:
        """The x below which values have the probability ``q``."""
        x, low = np.empty(q.shape), q <= 0.5
        x[low] = self._in_lower_half(q[low])
        x[~low] = -self._mirrored._in_lower_half(np.maximum(1.0 - q[~low], 0.0))
        return x

    def isf(self, q: RealArray, /) -> RealArray:
        """The x above which values have the probability ``q``."""
        return -self._mirrored.ppf(q)

    def relative(self, x: RealArray) -> RealArray:
        """ln f(x)/f(0); the arctangents at x and 0 are taken together, which leaves digits where m
        and ν are large."""
        shift = 0.5 * self.c1 / self.c2
        a = math.sqrt(self.c0 / self.c2 - shift**2)
        turn = np.arctan2(2.0 * a * self.c2 * x, 2.0 * self.c0 + self.c1 * x)
        power = np.log1p(x * (self.c1 + self.c2 * x) / self.c0) / (2.0 * self.c2)
        return np.asarray(-power - (self.c1 - shift) / (self.c2 * a) * turn)

    @cached_property
    def _mirrored(self) -> _TypeIV:
        return _TypeIV(self.c0, -self.c1, self.c2)

    @cached_property
    def _edges(self) -> RealArray:
        return np.linspace(-_REACH, _REACH, round(2.0 * _REACH / _PANEL) + 1)

    @cached_property
    def _sums(self) -> RealArray:
        """∫ f(x)/f(0) dx below each edge."""
        return np.concatenate([[0.0], np.cumsum(self._integral(self._edges[:-1], self._edges[1:]))])

    def _integral(self, start: RealArray, end: RealArray) -> RealArray:
        """∫ f(x)/f(0) dx over t from ``start`` to ``end``, within one panel."""
        points, weights = gauss(np.stack(np.broadcast_arrays(start, end), axis=-1), _ORDER)
        return np.asarray((self._weight(points) * weights).sum(axis=-1))

    def _weight(self, t: RealArray) -> RealArray:
        """f(x)/f(0) dx/dt."""
        return np.asarray(np.exp(self.relative(np.sinh(t)) + np.logaddexp(t, -t) - math.log(2.0)))

    def _below(self, t: RealArray) -> RealArray:
        """∫ f(x)/f(0) dx below ``t``."""
        t = np.clip(t, -_REACH, _REACH)
        panel = np.clip(((t + _REACH) / _PANEL).astype(np.intp), 0, self._edges.size - 2)
        return self._sums[panel] + self._integral(self._edges[panel], t)

    def _in_lower_half(self, probability: RealArray) -> RealArray:
        """The x below which values have a ``probability`` (n,) of at most a half: Newton's method
        for its logarithm."""
        p, known = np.maximum(probability, _LEAST), self._sums > _LEAST**1.02
        t: RealArray = np.interp(np.log(p), np.log(self._sums[known] / self._sums[-1]), self._edges[known])
        for _ in range(_NEWTON):
            below = self._below(t)
            t = t - np.log(below / self._sums[-1] / p) * below / self._weight(t)
        return np.where(probability > 0.0, np.sinh(t), -math.inf)
