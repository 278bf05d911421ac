"""Distributions of summit heights: Gaussian, exponential, measured, of any density."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Declared
from ...core.pearson import Pearson
from ...core.quadrature import gauss, geometric
from ...core.values import Number

# Distributions of summit heights and their one-sided moments F_m(D) = ∫_D^∞ (s - D)^m p(s) ds.
#
# Heights s are standardised: standard deviation one, mean zero (the exponential one excepted, which
# starts at s = 0). Greenwood & Williamson (1966); closed forms in Bhushan (1998, eq. 17-20).


_NODES = 48  # of the rule over sqrt(s - D); they leave 1e-14
_SIGMAS = 9.0  # beyond which a Gaussian is below 1e-18 of its maximum
_DECAY = 80.0  # twice the exponent at which the tail is cut


class SummitHeights(Protocol):
    """Distribution of standardised summit heights; ``mean`` of s, zero but for heights that count
    from the lowest."""

    name: ClassVar[str]
    mean: ClassVar[float]

    @property
    def support(self) -> tuple[float, float]:
        """Lowest and highest possible height; infinite where there is none."""
        ...

    def density(self, s: RealArray) -> RealArray:
        """Probability density p(s), any shape."""
        ...

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """F_m(D) for ``D`` of any shape and m > -1: for m = 0 the share of summits above D."""
        ...


@dataclass(frozen=True)
class GaussianHeights:
    """p = exp(-s²/2)/sqrt(2π)."""

    name: ClassVar[str] = "gaussian"
    mean: ClassVar[float] = 0.0
    support: ClassVar[tuple[float, float]] = (-math.inf, math.inf)

    def density(self, s: RealArray) -> RealArray:
        """Standard normal density."""
        return np.exp(-0.5 * np.square(s)) / math.sqrt(2.0 * math.pi)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """F_m by a Gauss rule over q = sqrt(s - D), in which half-integer powers are smooth;
        relative error 1e-13.

        The closed form with a parabolic cylinder function loses digits in the libraries at hand
        (2e-9).
        """
        from scipy.special import ndtr

        D = np.asarray(D, dtype=float)
        if m == 0.0:
            return np.asarray(ndtr(-D), dtype=float)
        first = np.sqrt(np.maximum(0.0, -_SIGMAS - D))
        last = np.sqrt(np.where(D > 0.0, _DECAY / (np.sqrt(D * D + _DECAY) + np.abs(D)), _SIGMAS - D))
        q, weight = gauss(np.stack([first, last], axis=-1), _NODES)
        weight *= 2.0 * q ** (2.0 * m + 1.0)
        q *= q
        q += D[..., None]
        weight *= self.density(q)
        return np.asarray(weight.sum(axis=-1))


@dataclass(frozen=True)
class ExponentialHeights:
    """p = exp(-s), s >= 0: heights count from the lowest summit, one standard deviation below the
    mean."""

    name: ClassVar[str] = "exponential"
    mean: ClassVar[float] = 1.0
    support: ClassVar[tuple[float, float]] = (0.0, math.inf)

    def density(self, s: RealArray) -> RealArray:
        """Exponential density."""
        return np.where(s >= 0.0, np.exp(-np.maximum(s, 0.0)), 0.0)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """Γ(m + 1) exp(-D) for D >= 0 (Bhushan 1998, eq. 20), exp(-D) Γ(m + 1, -D) below."""
        return _exponential_tail(np.asarray(D, dtype=float), m)


@dataclass(frozen=True)
class LaplaceHeights:
    """p = exp(-√2 |s|)/√2, exponential to both sides."""

    name: ClassVar[str] = "laplace"
    mean: ClassVar[float] = 0.0
    support: ClassVar[tuple[float, float]] = (-math.inf, math.inf)

    def density(self, s: RealArray) -> RealArray:
        """Two-sided exponential density."""
        return np.exp(-math.sqrt(2.0) * np.abs(s)) / math.sqrt(2.0)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """Closed form: the part above s = 0 as for the exponential, the part below by Kummer's
        function."""
        from scipy.special import hyp1f1

        D = np.asarray(D, dtype=float)
        rate, depth = math.sqrt(2.0), np.maximum(-D, 0.0)
        above = _exponential_tail(rate * D, m) / rate ** (m + 1.0)
        below = depth ** (m + 1.0) / (m + 1.0) * hyp1f1(1.0, m + 2.0, -rate * depth)
        return np.asarray((above + below) / math.sqrt(2.0))


@dataclass(frozen=True)
class UniformHeights:
    """All heights between -√3 and √3 alike."""

    name: ClassVar[str] = "uniform"
    mean: ClassVar[float] = 0.0
    support: ClassVar[tuple[float, float]] = (-math.sqrt(3.0), math.sqrt(3.0))

    def density(self, s: RealArray) -> RealArray:
        """1/(2√3) within the support."""
        return np.where(np.abs(s) <= math.sqrt(3.0), 0.5 / math.sqrt(3.0), 0.0)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """Closed form."""
        high, low = (np.maximum(end - np.asarray(D, dtype=float), 0.0) for end in (math.sqrt(3.0), -math.sqrt(3.0)))
        return (high ** (m + 1.0) - low ** (m + 1.0)) / (2.0 * math.sqrt(3.0) * (m + 1.0))


@dataclass(frozen=True)
class TriangularHeights:
    """p = (√6 - |s|)/6 between -√6 and √6."""

    name: ClassVar[str] = "triangular"
    mean: ClassVar[float] = 0.0
    support: ClassVar[tuple[float, float]] = (-math.sqrt(6.0), math.sqrt(6.0))

    def density(self, s: RealArray) -> RealArray:
        """Symmetric triangle."""
        return np.maximum(math.sqrt(6.0) - np.abs(s), 0.0) / 6.0

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """Closed form."""
        D = np.asarray(D, dtype=float)
        high, middle, low = (np.maximum(end - D, 0.0) for end in (math.sqrt(6.0), 0.0, -math.sqrt(6.0)))
        twice = high ** (m + 2.0) - 2.0 * middle ** (m + 2.0) + low ** (m + 2.0)
        return np.asarray(twice / (6.0 * (m + 1.0) * (m + 2.0)))


@dataclass(frozen=True)
class PearsonHeights:
    """The density of Pearson's system that has this ``skewness`` and ``kurtosis``; InputError if
    kurtosis <= 1 + skewness²."""

    skewness: float
    kurtosis: float
    name: ClassVar[str] = "pearson"
    mean: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        _ = self.curve

    @cached_property
    def curve(self) -> Pearson:
        """The curve of the system."""
        return Pearson(self.skewness, self.kurtosis)

    @property
    def support(self) -> tuple[float, float]:
        """Lowest and highest possible height; infinite where there is none."""
        return self.curve.support

    def density(self, s: RealArray) -> RealArray:
        """Probability density p(s), any shape."""
        return self.curve.pdf(s)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """F_m(D) for ``D`` of any shape, -1 < m < 4."""
        return self.curve.excess_moment(m, D)


@dataclass(frozen=True)
class WeibullHeights(Declared):
    """p = k x^(k-1) exp(-x^k) of heights x above the lowest summit, standardised (Weibull 1951).

    ``shape`` k: 1 is exponential with mean zero, 2 Rayleigh's distribution, 3.6 nearly symmetric;
    ``upward`` false turns it over, so that the highest summits are alike and low ones scatter.
    """

    shape: Annotated[float, Number(least=1.0, most=100.0), "shape k"]
    upward: Annotated[bool, "whether the long tail is above"] = True
    name: ClassVar[str] = "weibull"
    mean: ClassVar[float] = 0.0
    citation_keys: ClassVar[tuple[str, ...]] = ("Weibull1951",)

    @property
    def label(self) -> str:
        """Name with the shape, as commands take it."""
        return f"{self.name}:{self.shape:g}"

    @property
    def _scale(self) -> tuple[float, float]:
        """Mean and deviation of x."""
        first, second = (math.gamma(1.0 + n / self.shape) for n in (1, 2))
        return first, math.sqrt(second - first**2)

    @property
    def support(self) -> tuple[float, float]:
        """Lowest and highest possible height."""
        first, deviation = self._scale
        end = first / deviation
        return (-end, math.inf) if self.upward else (-math.inf, end)

    def density(self, s: RealArray) -> RealArray:
        """Probability density p(s), any shape."""
        first, deviation = self._scale
        x = first + deviation * (np.asarray(s, dtype=float) * (1.0 if self.upward else -1.0))
        inside = np.where(x > 0.0, x, 1.0)
        found = deviation * self.shape * inside ** (self.shape - 1.0) * np.exp(-(inside**self.shape))
        return np.where(x > 0.0, found, 0.0)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """F_m(D) for ``D`` of any shape, -1 < m < 4: by the exponential number u = x^k, on panels
        that grow from its least value."""
        D = np.asarray(D, dtype=float)
        first, deviation = self._scale
        level = first + deviation * (D if self.upward else -D)
        start = np.maximum(level, 0.0) ** self.shape
        if self.upward:
            t, weight = geometric(np.zeros_like(D), np.full_like(D, _WEIBULL_END))
            x = (start[..., None] + t) ** (1.0 / self.shape)
            # of near numbers by their ratio, whose logarithm keeps the digits
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                rise = level[..., None] * np.expm1(np.log1p(t / start[..., None]) / self.shape)
            above = np.where(start[..., None] > 0.0, rise, x - level[..., None])
            shares = weight * np.exp(-t - start[..., None])
        else:  # x below the level, u from zero to its end
            top = np.minimum(np.maximum(level, 0.0), _WEIBULL_END ** (1.0 / self.shape))
            t, weight = geometric(np.zeros_like(D), 0.5 * top)
            x = np.concatenate([t, top[..., None] - t], axis=-1)
            above = np.concatenate([level[..., None] - t, (level - top)[..., None] + t], axis=-1)
            pieces = np.concatenate([weight, weight], axis=-1)
            shares = pieces * self.shape * x ** (self.shape - 1.0) * np.exp(-(x**self.shape))
        return np.asarray(np.sum(shares * (np.maximum(above, 0.0) / deviation) ** m, axis=-1))


_WEIBULL_END = 60.0
"""Exponential number beyond the least, beyond which 1e-26 of the heights are left."""

NAMED_HEIGHTS: tuple[tuple[str, SummitHeights], ...] = (
    ("gaussian", GaussianHeights()),
    ("exponential", ExponentialHeights()),
    ("uniform", UniformHeights()),
    ("triangular", TriangularHeights()),
    ("laplace", LaplaceHeights()),
)
"""Distributions without parameters, by name."""


def _exponential_tail(D: RealArray, m: float) -> RealArray:
    """∫ (s - D)^m e^(-s) ds over s > max(D, 0)."""
    from scipy.special import gammaincc

    return math.gamma(m + 1.0) * np.exp(-D) * gammaincc(m + 1.0, np.maximum(-D, 0.0))


# Distributions of summit heights from measurements and from any density.


_PANEL_NODES = 24  # in each panel of a user's density


@dataclass(frozen=True, eq=False)
class HistogramHeights:
    """Heights spread evenly within the bins of a histogram; they are standardised with their own
    mean and deviation.

    InputError if the edges do not rise, or counts are negative or all zero.

    Parameters
    ----------
    edges
        (n + 1,) rising edges of the bins, in any unit of length.
    counts
        (n,) how many summits each bin holds, or numbers in proportion.
    """

    edges: RealArray
    counts: RealArray
    name: ClassVar[str] = "histogram"
    mean: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        edges, counts = np.asarray(self.edges, dtype=float), np.asarray(self.counts, dtype=float)
        if edges.ndim != 1 or counts.shape != (edges.size - 1,) or not np.all(np.diff(edges) > 0.0):
            raise InputError(
                f"histogram must have n + 1 rising edges and n counts, but has shapes {edges.shape} and {counts.shape}."
            )
        if not (np.all(counts >= 0.0) and counts.sum() > 0.0):
            raise InputError("counts of a histogram must be at least zero and not all zero.")
        share = counts / counts.sum()
        middle, width = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
        mean = float(share @ middle)
        deviation = float(np.sqrt(share @ (np.square(middle - mean) + width**2 / 12.0)))
        object.__setattr__(self, "edges", (edges - mean) / deviation)
        object.__setattr__(self, "counts", share)

    @classmethod
    def from_samples(cls, heights: ArrayLike, bins: int = 50) -> Self:
        """Histogram of the measured summit ``heights`` (n,) with equal ``bins``.

        InputError if all heights are equal.
        """
        values = np.asarray(heights, dtype=float)
        if not np.ptp(values) > 0.0:
            raise InputError("summit heights of a histogram must differ, but are all equal.")
        counts, edges = np.histogram(values, bins=require.integer(bins, 1, "number of bins"))
        return cls(edges, counts.astype(float))

    @property
    def support(self) -> tuple[float, float]:
        """First and last edge."""
        return float(self.edges[0]), float(self.edges[-1])

    def density(self, s: RealArray) -> RealArray:
        """Share of the bin over its width."""
        heights = self.counts / np.diff(self.edges)
        index = np.clip(np.searchsorted(self.edges, s, side="right") - 1, 0, heights.size - 1)
        inside = (s >= self.edges[0]) & (s <= self.edges[-1])
        return np.where(inside, heights[index], 0.0)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """Sum of the closed forms of the bins."""
        above = np.maximum(self.edges - np.asarray(D, dtype=float)[..., None], 0.0) ** (m + 1.0) / (m + 1.0)
        return np.asarray(np.diff(above, axis=-1) @ (self.counts / np.diff(self.edges)))


@dataclass(frozen=True, eq=False)
class AnyHeights:
    """Heights with a density of your own, mean zero and standard deviation one.

    InputError if the breaks do not rise, or the density does not have integral 1, mean 0 and
    variance 1 to 1e-6.

    Parameters
    ----------
    function
        Density p(s), array in, array out; smooth between the breaks.
    breaks
        Two or more rising, finite numbers: ends of the support (or heights beyond which the density
        is negligible) and all places where the density is not smooth. More breaks make the Gauss
        rules between them more accurate.
    """

    function: Callable[[RealArray], RealArray]
    breaks: tuple[float, ...]
    name: ClassVar[str] = "any"
    mean: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        edges = np.asarray(self.breaks, dtype=float)
        if edges.ndim != 1 or edges.size < 2 or not np.all(np.isfinite(edges)) or not np.all(np.diff(edges) > 0.0):
            raise InputError(
                f"breaks of a density must be two or more rising, finite numbers, but are {self.breaks!r}."
            )
        s, weight = gauss(edges, _PANEL_NODES)
        found = [float(np.sum(weight * self.function(s) * s**n)) for n in range(3)]
        if not np.allclose(found, (1.0, 0.0, 1.0), atol=1e-6):
            raise InputError(
                "density of standardised heights must have integral 1, mean 0 and variance 1, but has "
                f"{found[0]:.7g}, {found[1]:.7g} and {found[2]:.7g}. Standardise it, or add breaks where it is sharp."
            )

    @property
    def support(self) -> tuple[float, float]:
        """First and last break."""
        return self.breaks[0], self.breaks[-1]

    def density(self, s: RealArray) -> RealArray:
        """The function within the support."""
        low, high = self.support
        return np.where((s >= low) & (s <= high), self.function(np.clip(s, low, high)), 0.0)

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """F_m by Gauss rules over q = sqrt(s - D) between the breaks above D."""
        D = np.asarray(D, dtype=float)[..., None]
        q, weight = gauss(np.sqrt(np.maximum(np.asarray(self.breaks) - D, 0.0)), _PANEL_NODES)
        return np.asarray(np.sum(2.0 * weight * q ** (2.0 * m + 1.0) * self.density(D + q * q), axis=-1))
