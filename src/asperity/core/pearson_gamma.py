"""Types III and V of Pearson's system, of positive skewness: transformed gamma distributions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import RealArray
from .pearson_curves import log_ratio
from .quadrature import partial_moment

_LEAST = 1e-100  # distance from the end of type V below which its density is zero, and its logarithm needs no digits


@dataclass(frozen=True)
class GammaCurve:
    """Type III: (c0 + c1 x)^m exp(-x/c1), m = c0/c1² - 1, above -c0/c1; (x + c0/c1)/c1 has a gamma distribution."""

    c0: float
    c1: float
    high: float = math.inf

    @property
    def low(self) -> float:
        """Lower end -c0/c1."""
        return -self.c0 / self.c1

    @property
    def shape(self) -> float:
        """m + 1."""
        return self.c0 / self.c1**2

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """m ln(1 + c1 x/c0) - x/c1, with the norm."""
        return self.relative(x, from_low, from_high) - self._log_norm

    def relative(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """ln f(x)/f(0)."""
        return (self.shape - 1.0) * log_ratio(x, from_low, -self.low) - x / self.c1

    @cached_property
    def _log_norm(self) -> float:
        return math.log(float(partial_moment(self.relative, (self.low, self.high), 0.0, np.array(self.low))))

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        from scipy.special import gammainc

        return np.asarray(gammainc(self.shape, np.maximum(x - self.low, 0.0) / self.c1))

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        from scipy.special import gammaincc

        return np.asarray(gammaincc(self.shape, np.maximum(x - self.low, 0.0) / self.c1))

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        from scipy.special import gammaincinv

        return self.low + self.c1 * np.asarray(gammaincinv(self.shape, probability))

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        from scipy.special import gammainccinv

        return self.low + self.c1 * np.asarray(gammainccinv(self.shape, probability))


@dataclass(frozen=True)
class InverseGammaCurve:
    """Type V: y^(-1/c2) exp(-b/y), y = x + c1/(2 c2) > 0, b = (c1/(2 c2) - c1)/c2; b/y has a gamma distribution."""

    c1: float
    c2: float
    high: float = math.inf

    @property
    def low(self) -> float:
        """Lower end -c1/(2 c2)."""
        return -0.5 * self.c1 / self.c2

    @property
    def shape(self) -> float:
        """1/c2 - 1."""
        return 1.0 / self.c2 - 1.0

    @property
    def b(self) -> float:
        """Scale of the gamma distribution of b/y."""
        return (-self.low - self.c1) / self.c2

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """-(shape + 1) ln y - b/y, with the norm."""
        return self.relative(x, from_low, from_high) - self._log_norm

    def relative(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """ln f(x)/f(0)."""
        y = np.maximum(from_low, _LEAST)
        return self.b / -self.low * (x / y) - (self.shape + 1.0) * log_ratio(x, y, -self.low)

    @cached_property
    def _log_norm(self) -> float:
        return math.log(float(partial_moment(self.relative, (self.low, self.high), 0.0, np.array(self.low))))

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        from scipy.special import gammaincc

        return np.asarray(gammaincc(self.shape, self._gamma(x)))

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        from scipy.special import gammainc

        return np.asarray(gammainc(self.shape, self._gamma(x)))

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        from scipy.special import gammainccinv

        return self._of_gamma(np.asarray(gammainccinv(self.shape, probability)))

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        from scipy.special import gammaincinv

        return self._of_gamma(np.asarray(gammaincinv(self.shape, probability)))

    def _gamma(self, x: RealArray) -> RealArray:
        with np.errstate(divide="ignore"):
            values: RealArray = self.b / np.maximum(x - self.low, 0.0)
        return values

    def _of_gamma(self, gamma: RealArray) -> RealArray:
        with np.errstate(divide="ignore"):
            values: RealArray = self.low + self.b / gamma
        return values
