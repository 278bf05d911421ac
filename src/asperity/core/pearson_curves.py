"""What the curves of Pearson's system have in common, and the normal one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .arrays import RealArray

_NEAR = 0.5  # |x| as a part of the distance to an end below which ln(1 + x/distance) keeps more digits


class Curve(Protocol):
    """A density between two ends, which may be infinite, with its distribution function and the inverse, from both sides."""

    @property
    def low(self) -> float:
        """Lower end."""

    @property
    def high(self) -> float:
        """Upper end."""

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """Logarithm of the density at ``x``, of which the distances to the ends are given, too, for their digits."""

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""


@dataclass(frozen=True)
class MirroredCurve:
    """Distribution of -x for the x of ``curve``."""

    curve: Curve

    @property
    def low(self) -> float:
        """Lower end."""
        return -self.curve.high

    @property
    def high(self) -> float:
        """Upper end."""
        return -self.curve.low

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """As in the protocol."""
        return self.curve.log_density(-x, from_high, from_low)

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        return self.curve.upper(-x)

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        return self.curve.lower(-x)

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        return -self.curve.at_upper(probability)

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        return -self.curve.at_lower(probability)


@dataclass(frozen=True)
class NormalCurve:
    """Standard normal distribution."""

    low: float = -math.inf
    high: float = math.inf

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """-x²/2 - ln sqrt(2π)."""
        values: RealArray = -0.5 * np.square(x) - 0.5 * math.log(2.0 * math.pi)
        return values

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        from scipy.special import ndtr

        return np.asarray(ndtr(x))

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        return self.lower(-x)

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        from scipy.special import ndtri

        return np.asarray(ndtri(probability))

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        return -self.at_lower(probability)


def log_ratio(x: RealArray, from_end: RealArray, distance: float) -> RealArray:
    """ln(1 + x/distance) = ln(from_end/distance), the form of it that keeps its digits."""
    near = np.abs(x) < _NEAR * distance
    with np.errstate(divide="ignore"):
        far = np.log(np.where(near, 1.0, from_end) / distance)
    values: RealArray = np.where(near, np.log1p(np.where(near, x, 0.0) / distance), far)
    return values
