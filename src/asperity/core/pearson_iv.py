"""Type IV of Pearson's system, and type VII (Student's), its symmetric case; of positive skewness."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import RealArray

_PANEL, _ORDER = 0.125, 10  # panels in t, x = sinh t, and Gauss-Legendre points in each; twice as many change nothing
_REACH = 190.0  # the tails fall at least as x^-6, that is below exp(-745), the least positive number
_LEAST = 1e-300  # probabilities below are taken for this one
_NEWTON = 4  # steps, each of which squares an error that starts below 1e-2


@dataclass(frozen=True)
class StudentLikeCurve:
    """(1 + u²)^(-m) exp(-ν arctan u), u = (x - λ)/a, m = 1/(2 c2), λ = -c1/(2 c2), a² = c0/c2 - λ², ν = (c1 + λ)/(c2 a).

    Its distribution function is integrated over t, x = sinh t, in which the algebraic tails are exponential ones.
    """

    c0: float
    c1: float
    c2: float
    low: float = -math.inf
    high: float = math.inf

    def log_density(self, x: RealArray, from_low: RealArray, from_high: RealArray) -> RealArray:
        """Logarithm of the density; sums of the arctangents at x and 0, and alike, leave digits where m and ν are large."""
        return self._relative(x) - self._log_norm

    def lower(self, x: RealArray) -> RealArray:
        """Probability below ``x``."""
        return self._one_sided(np.arcsinh(x), upper=False)

    def upper(self, x: RealArray) -> RealArray:
        """Probability above ``x``."""
        return self._one_sided(np.arcsinh(x), upper=True)

    def at_lower(self, probability: RealArray) -> RealArray:
        """The x below which values have this ``probability``."""
        return self._inverted(probability, upper=False)

    def at_upper(self, probability: RealArray) -> RealArray:
        """The x above which values have this ``probability``."""
        return self._inverted(probability, upper=True)

    def _relative(self, x: RealArray) -> RealArray:
        """ln f(x) - ln f(0)."""
        shift = 0.5 * self.c1 / self.c2
        a = math.sqrt(self.c0 / self.c2 - shift**2)
        turn = np.arctan2(2.0 * a * self.c2 * x, 2.0 * self.c0 + self.c1 * x)  # arctan u - arctan u(0)
        power = np.log1p(x * (self.c1 + self.c2 * x) / self.c0) / (2.0 * self.c2)
        values: RealArray = -power - (self.c1 - shift) / (self.c2 * a) * turn
        return values

    def _weight(self, t: RealArray) -> RealArray:
        """f(x)/f(0) dx/dt."""
        values: RealArray = np.exp(self._relative(np.sinh(t)) + np.logaddexp(t, -t) - math.log(2.0))
        return values

    def _integral(self, start: RealArray, end: RealArray) -> RealArray:
        """∫ f(x)/f(0) dx over t from ``start`` to ``end``, within one panel."""
        points, weights = np.polynomial.legendre.leggauss(_ORDER)
        middle, half = 0.5 * (start + end), 0.5 * (end - start)
        values: RealArray = half * (self._weight(middle[..., None] + half[..., None] * points) @ weights)
        return values

    @cached_property
    def _edges(self) -> RealArray:
        return np.linspace(-_REACH, _REACH, round(2.0 * _REACH / _PANEL) + 1)

    @cached_property
    def _tails(self) -> tuple[RealArray, RealArray]:
        """∫ f(x)/f(0) dx below and above each edge, summed up from the ends."""
        panels = self._integral(self._edges[:-1], self._edges[1:])
        below = np.concatenate([[0.0], np.cumsum(panels)])
        above = np.concatenate([[0.0], np.cumsum(panels[::-1])])[::-1]
        return below, above

    @property
    def _norm(self) -> float:
        return float(self._tails[0][-1])

    @property
    def _log_norm(self) -> float:
        return math.log(self._norm)

    def _one_sided(self, t: RealArray, *, upper: bool) -> RealArray:
        t = np.clip(t, -_REACH, _REACH)
        edges = self._edges
        panel = np.clip(((t + _REACH) / _PANEL).astype(np.intp), 0, edges.size - 2)
        if upper:
            sums = self._tails[1][panel + 1] + self._integral(t, edges[panel + 1])
        else:
            sums = self._tails[0][panel] + self._integral(edges[panel], t)
        values: RealArray = sums / self._norm
        return values

    def _inverted(self, probability: RealArray, *, upper: bool) -> RealArray:
        """Newton's method for the logarithm of the probability of the nearer tail."""
        x = np.empty(probability.shape)
        for tail_is_upper in (False, True):
            chosen = (probability <= 0.5) == (tail_is_upper == upper)
            p = np.maximum(probability[chosen] if tail_is_upper == upper else 1.0 - probability[chosen], 0.0)
            x[chosen] = np.sinh(self._quantile(np.maximum(p, _LEAST), tail_is_upper))
            x[chosen] = np.where(p > 0.0, x[chosen], math.inf if tail_is_upper else -math.inf)
        return x

    def _quantile(self, p: RealArray, upper: bool) -> RealArray:
        """The t beyond which the upper or lower tail has the probability ``p``."""
        sums = self._tails[1 if upper else 0]
        known = sums > _LEAST * _LEAST**0.02
        order = slice(None, None, -1) if upper else slice(None)
        t: RealArray = np.interp(np.log(p), np.log(sums[known] / self._norm)[order], self._edges[known][order])
        for _ in range(_NEWTON):
            tail = self._one_sided(t, upper=upper)
            step = np.log(tail / p) * tail * self._norm / self._weight(t)
            t = t + (step if upper else -step)
        return np.asarray(t)
