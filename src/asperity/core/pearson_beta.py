"""Types I, II and VI of Pearson's system, of positive skewness: transformed beta distributions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import RealArray
from .pearson_curves import log_ratio
from .quadrature import partial_moment

_SERIES = 1e-9  # z of a beta distribution below which the second term of the series, z times the first, is left out


@dataclass(frozen=True)
class BetaCurve:
    """Types I and II: (x - a1)^m1 (a2 - x)^m2 between a1 and a2; (x - a1)/(a2 - a1) has a beta distribution."""

    a1: float
    a2: float
    m1: float
    m2: float

    @property
    def low(self) -> float:
        """Lower end a1."""
        return self.a1

    @property
    def high(self) -> float:
        """Upper end a2."""
        return self.a2

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """m1 ln(1 - x/a1) + m2 ln(1 - x/a2), with the norm."""
        return self.relative(x, from_low, from_high) - self._log_norm

    def relative(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """ln f(x)/f(0)."""
        return self.m1 * log_ratio(x, from_low, -self.a1) + self.m2 * log_ratio(-x, from_high, self.a2)

    @cached_property
    def _log_norm(self) -> float:
        return math.log(float(partial_moment(self.relative, (self.low, self.high), 0.0, np.array(self.low))))

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        from scipy.special import betainc

        part = np.clip((x - self.a1) / (self.a2 - self.a1), 0.0, 1.0)
        return np.asarray(betainc(self.m1 + 1.0, self.m2 + 1.0, part))

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        from scipy.special import betainc

        part = np.clip((self.a2 - x) / (self.a2 - self.a1), 0.0, 1.0)
        return np.asarray(betainc(self.m2 + 1.0, self.m1 + 1.0, part))

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        return self.a1 + (self.a2 - self.a1) * beta_quantile(self.m1 + 1.0, self.m2 + 1.0, probability)

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        return self.a2 - (self.a2 - self.a1) * beta_quantile(self.m2 + 1.0, self.m1 + 1.0, probability)


@dataclass(frozen=True)
class BetaPrimeCurve:
    """Type VI: (x - a1)^m1 (x - a2)^m2 above a2 > a1; (x - a2)/(x - a1) has a beta distribution."""

    a1: float
    a2: float
    m1: float
    m2: float
    high: float = math.inf

    @property
    def low(self) -> float:
        """Lower end a2."""
        return self.a2

    @property
    def shapes(self) -> tuple[float, float]:
        """Of the beta distribution: m2 + 1 and -m1 - m2 - 1."""
        return self.m2 + 1.0, -self.m1 - self.m2 - 1.0

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """m1 ln(1 - x/a1) + m2 ln(1 - x/a2), with the norm."""
        return self.relative(x, from_low, from_high) - self._log_norm

    def relative(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """ln f(x)/f(0)."""
        first = self.m1 * log_ratio(x, from_low + (self.a2 - self.a1), -self.a1)
        return first + self.m2 * log_ratio(x, from_low, -self.a2)

    @cached_property
    def _log_norm(self) -> float:
        return math.log(float(partial_moment(self.relative, (self.low, self.high), 0.0, np.array(self.low))))

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        from scipy.special import betainc

        y, (p, q) = np.maximum(x - self.a2, 0.0), self.shapes
        return np.asarray(betainc(p, q, y / (y + (self.a2 - self.a1))))

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        from scipy.special import betainc

        y, (p, q), width = np.maximum(x - self.a2, 0.0), self.shapes, self.a2 - self.a1
        return np.asarray(betainc(q, p, width / (y + width)))

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        from scipy.special import betainccinv

        p, q = self.shapes
        return self._of_beta(beta_quantile(p, q, probability), np.asarray(betainccinv(q, p, probability)))

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        from scipy.special import betainccinv

        p, q = self.shapes
        return self._of_beta(np.asarray(betainccinv(p, q, probability)), beta_quantile(q, p, probability))

    def _of_beta(self, part: RealArray, rest: RealArray) -> RealArray:
        with np.errstate(divide="ignore"):
            values: RealArray = self.a2 + (self.a2 - self.a1) * part / rest
        return values


def beta_quantile(a: float, b: float, probability: RealArray) -> RealArray:
    """z below which a number with the beta distribution of a, b lies; by the first term of the series where z is small.

    SciPy's inverse returns nan for some probabilities below 1e-15, where that term is all that counts.
    """
    from scipy.special import betaincinv, betaln

    with np.errstate(divide="ignore"):
        first = np.exp((np.log(probability) + math.log(a) + float(betaln(a, b))) / a)
    return np.where(first < _SERIES, first, betaincinv(a, b, probability))
