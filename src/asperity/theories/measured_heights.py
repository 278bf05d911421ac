"""Distributions of summit heights from measurements and from any density."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.quadrature import gauss

_NODES = 24  # in each panel of a user's density


@dataclass(frozen=True, eq=False)
class HistogramHeights:
    """Heights spread evenly within the bins of a histogram; they are standardised with their own mean and deviation.

    Parameters
    ----------
    edges
        (n + 1,) rising edges of the bins, in any unit of length.
    counts
        (n,) how many summits each bin holds, or numbers in proportion.

    Raises
    ------
    InputError
        If the edges do not rise, or counts are negative or all zero.
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

        Raises
        ------
        InputError
            If all heights are equal.
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
        values: RealArray = np.where(inside, heights[index], 0.0)
        return values

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """Sum of the closed forms of the bins."""
        above = np.maximum(self.edges - np.asarray(D, dtype=float)[..., None], 0.0) ** (m + 1.0) / (m + 1.0)
        values: RealArray = np.diff(above, axis=-1) @ (self.counts / np.diff(self.edges))
        return values


@dataclass(frozen=True, eq=False)
class AnyHeights:
    """Heights with a density of your own, mean zero and standard deviation one.

    Parameters
    ----------
    function
        Density p(s), array in, array out; smooth between the breaks.
    breaks
        Two or more rising, finite numbers: ends of the support (or heights beyond which the density is negligible) and
        all places where the density is not smooth. More breaks make the Gauss rules between them more accurate.

    Raises
    ------
    InputError
        If the breaks do not rise, or the density does not have integral 1, mean 0 and variance 1 to 1e-6.
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
        s, weight = gauss(edges, _NODES)
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
        values: RealArray = np.where((s >= low) & (s <= high), self.function(np.clip(s, low, high)), 0.0)
        return values

    def tail_moment(self, D: RealArray, m: float) -> RealArray:
        """F_m by Gauss rules over q = sqrt(s - D) between the breaks above D."""
        D = np.asarray(D, dtype=float)[..., None]
        q, weight = gauss(np.sqrt(np.maximum(np.asarray(self.breaks) - D, 0.0)), _NODES)
        values: RealArray = np.sum(2.0 * weight * q ** (2.0 * m + 1.0) * self.density(D + q * q), axis=-1)
        return values
