"""Johnson's system of distributions: the one with given skewness and kurtosis, as a function of a normal number.

G = γ + δ f((z - ξ)/λ) is standard normal; unbounded z = ξ + λ sinh((G - γ)/δ), bounded z = ξ + λ/(1 + exp(-(G - γ)/δ)),
lognormal z = ξ + λ exp((G - γ)/δ) (Johnson 1949). Here z has zero mean and unit variance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.pearson import require_possible

KINDS = ("normal", "lognormal", "unbounded", "bounded")
"""Families of the system."""

_ON_LINE = 1e-7  # distance of the kurtosis from the lognormal line, relative to it, below which the lognormal serves
_STEP, _REACH = 0.2, 9.6  # trapezoidal rule over G; the error of its step is exp(-2π² δ/step) for poles at iπδ
_WIDEST_DELTA = 1e3  # of a symmetric bounded distribution: kurtosis 3 - 2e-6
_SMALLEST_DELTA = 0.01  # beyond, the bounded family is two spikes that the rule above does not resolve
_SQRT_TWO_PI = math.sqrt(2.0 * math.pi)


@dataclass(frozen=True)
class Johnson:
    """Distribution of one ``kind`` of the system with its four parameters; made by :func:`johnson`."""

    kind: str
    gamma: float
    delta: float
    xi: float
    scale: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1949", "Tuenter2001")

    @property
    def label(self) -> str:
        """Name of the curve in words."""
        return self.kind if self.kind in ("normal", "lognormal") else f"Johnson's {self.kind}"

    def of_normal(self, normal: RealArray) -> RealArray:
        """z(G): the number of this distribution for each standard normal number; increasing."""
        if self.kind == "normal":
            return normal
        u = (normal - self.gamma) / self.delta
        if self.kind == "unbounded":
            values: RealArray = self.xi + self.scale * np.sinh(u)
        elif self.kind == "bounded":
            values = self.xi + self.scale * _logistic(u)
        else:
            values = self.xi + self.scale * np.exp(u)
        return values


def johnson(skewness: float, kurtosis: float) -> Johnson:
    """Distribution of zero mean, unit variance and the given ``skewness`` and ``kurtosis`` (3 for Gaussian heights).

    The lognormal curve in the plane of both divides the unbounded family (larger kurtosis; Tuenter 2001) from the
    bounded one, whose moments come by quadrature.

    Raises
    ------
    InputError
        If kurtosis < 1 + skewness², which no distribution has, or so close to it that only two heights remain.
    """
    require_possible(skewness, kurtosis)
    if abs(skewness) < _ON_LINE:
        skewness = 0.0
    if skewness < 0.0:
        return _mirrored(johnson(-skewness, kurtosis))
    w = _lognormal_w(skewness)
    line = w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0
    if abs(kurtosis - line) <= _ON_LINE * line:
        return Johnson("normal", 0.0, 1.0, 0.0, 1.0) if skewness == 0.0 else _lognormal(w)
    return _unbounded(skewness, kurtosis) if kurtosis > line else _bounded(skewness, kurtosis, w)


def _mirrored(other: Johnson) -> Johnson:
    """Distribution of -z as an increasing function of a normal number."""
    if other.kind == "unbounded":
        return replace(other, gamma=-other.gamma, xi=-other.xi)
    if other.kind == "bounded":
        return replace(other, gamma=-other.gamma, xi=-(other.xi + other.scale))
    if other.kind == "lognormal":  # -z(-G) = -ξ - λ exp(-(G + γ)/δ)
        return replace(other, gamma=-other.gamma, delta=-other.delta, xi=-other.xi, scale=-other.scale)
    return other


def _lognormal_w(skewness: float) -> float:
    """w = exp(1/δ²) >= 1 with (w - 1)(w + 2)² = skewness²."""
    from scipy.optimize import brentq

    square = skewness**2
    upper = 1.0 + square / 9.0  # (w + 2)² >= 9
    return float(brentq(lambda w: (w - 1.0) * (w + 2.0) ** 2 - square, 1.0, upper + 1e-15, xtol=1e-15, rtol=1e-14))


def _lognormal(w: float) -> Johnson:
    """exp(G/δ) scaled to zero mean and unit variance: mean w^½, variance w (w - 1)."""
    scale = 1.0 / math.sqrt(w * (w - 1.0))
    return Johnson("lognormal", 0.0, 1.0 / math.sqrt(math.log(w)), -scale * math.sqrt(w), scale)


def _unbounded(skewness: float, kurtosis: float) -> Johnson:
    """Tuenter (2001): skewness² as a function of w alone, at the given kurtosis, and its one root."""
    from scipy.optimize import brentq

    square = skewness**2

    def m(w: float) -> float:
        return -2.0 + math.sqrt(max(0.0, 4.0 + 2.0 * (w * w - (kurtosis + 3.0) / (w * w + 2.0 * w + 3.0))))

    def excess(w: float) -> float:
        return (w - 1.0 - m(w)) * (w + 2.0 + 0.5 * m(w)) ** 2 - square

    low = _root_of_line(kurtosis)  # the lognormal with this kurtosis, m = 0
    high = math.sqrt(math.sqrt(2.0 * kurtosis - 2.0) - 1.0)  # the symmetric one, m = w - 1
    w, omega = high, 0.0
    if square > 0.0:
        w = float(brentq(excess, low, high, xtol=1e-15, rtol=1e-14))
        sinh_square = (w + 1.0) / (2.0 * w) * max(0.0, (w - 1.0) / m(w) - 1.0)
        omega = -math.asinh(math.sqrt(sinh_square))  # negative for positive skewness
    variance = 0.5 * (w - 1.0) * (w * math.cosh(2.0 * omega) + 1.0)
    scale, delta = 1.0 / math.sqrt(variance), 1.0 / math.sqrt(math.log(w))
    return Johnson("unbounded", omega * delta, delta, scale * math.sqrt(w) * math.sinh(omega), scale)


def _root_of_line(kurtosis: float) -> float:
    """w with w⁴ + 2 w³ + 3 w² - 3 = kurtosis."""
    from scipy.optimize import brentq

    return float(brentq(lambda w: w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0 - kurtosis, 1.0, kurtosis**0.25 + 1.0))


def _bounded(skewness: float, kurtosis: float, w: float) -> Johnson:
    """At each δ the skewness fixes γ; along this line the kurtosis rises from 1 + skewness² to the lognormal one.

    The line is followed to a per cent, Newton's method does the rest.
    """
    from scipy.optimize import brentq, root

    def gamma_at(delta: float) -> float:
        if skewness == 0.0:
            return 0.0
        top = 1.0
        while _bounded_moments(top, delta).skewness < skewness:
            top *= 2.0
        return float(brentq(lambda gamma: _bounded_moments(gamma, delta).skewness - skewness, 0.0, top, rtol=1e-4))

    def missing(log_delta: float) -> float:
        delta = math.exp(log_delta)
        return _bounded_moments(gamma_at(delta), delta).kurtosis - kurtosis

    def both(unknown: RealArray) -> list[float]:
        found = _bounded_moments(float(unknown[0]), math.exp(float(unknown[1])))
        return [found.skewness - skewness, found.kurtosis - kurtosis]

    widest = 1.0 / math.sqrt(math.log(w)) if skewness > 0.0 else _WIDEST_DELTA  # the lognormal of this skewness
    low, high = math.log(_SMALLEST_DELTA), math.log(widest * (1.0 - 1e-6))
    if missing(low) > 0.0:
        raise InputError(
            f"kurtosis {kurtosis:.4g} of the heights at skewness {skewness:.4g} must be further above its limit "
            f"1 + skewness² = {1.0 + skewness**2:.4g}, at which there are only two heights."
        )
    start = float(brentq(missing, low, high, xtol=1e-3)) if missing(high) > 0.0 else high
    gamma, log_delta = (float(value) for value in root(both, [gamma_at(math.exp(start)), start], tol=1e-13).x)
    gamma = 0.0 if skewness == 0.0 else gamma
    if max(abs(error) for error in both(np.array([gamma, log_delta]))) > _ON_LINE:
        raise ArithmeticError(f"no bounded distribution found for skewness {skewness:g} and kurtosis {kurtosis:g}.")
    found = _bounded_moments(gamma, math.exp(log_delta))
    return Johnson("bounded", gamma, math.exp(log_delta), -found.mean / found.deviation, 1.0 / found.deviation)


@dataclass(frozen=True)
class _Moments:
    mean: float
    deviation: float
    skewness: float
    kurtosis: float


def _bounded_moments(gamma: float, delta: float) -> _Moments:
    """Moments of 1/(1 + exp(-(G - γ)/δ)) by the trapezoidal rule."""
    step = _STEP * min(1.0, delta)
    normal = np.arange(-_REACH, _REACH + 0.5 * step, step)
    weight = step / _SQRT_TWO_PI * np.exp(-0.5 * normal**2)
    u = (normal - gamma) / delta
    logarithm = u - np.logaddexp(0.0, u)
    largest = float(logarithm[-1])  # far from the bounds the values are tiny, and lognormal
    values = np.exp(logarithm - largest)
    mean = float(weight @ values)
    centred = values - mean
    square, third, fourth = (float(weight @ centred**power) for power in (2, 3, 4))
    deviation = math.sqrt(square)
    unit = math.exp(largest)
    return _Moments(mean * unit, deviation * unit, third / deviation**3, fourth / square**2)


def _logistic(u: RealArray) -> RealArray:
    """1/(1 + exp(-u)) without overflow."""
    small = np.exp(-np.abs(u))
    values: RealArray = np.where(u >= 0.0, 1.0, small) / (1.0 + small)
    return values
