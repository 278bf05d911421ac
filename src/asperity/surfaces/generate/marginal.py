"""Distributions of heights that a surface can be made to have exactly: by moments, of a measured surface, of two levels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ..surface import Surface
from .height_law import height_law


class Marginal(Protocol):
    """Distribution of heights up to their mean and scale."""

    def sorted_heights(self, count: int) -> RealArray:
        """``count`` heights in ascending order, in any unit, that stand for the distribution."""

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""


@dataclass(frozen=True)
class HeightMoments:
    """Heights of given ``skewness`` and ``kurtosis`` (3 for Gaussian ones): the distribution of Johnson's or Pearson's system.

    Raises
    ------
    InputError
        If kurtosis < 1 + skewness², or the system is unknown.
    """

    skewness: float = 0.0
    kurtosis: float = 3.0
    system: str = "johnson"

    def __post_init__(self) -> None:
        height_law(self.skewness, self.kurtosis, self.system)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the system."""
        return height_law(self.skewness, self.kurtosis, self.system).citation_keys

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count; their moments are those asked for up to the tails beyond the outermost."""
        from scipy.special import ndtri

        law = height_law(self.skewness, self.kurtosis, self.system)
        return law.of_normal(ndtri((np.arange(count) + 0.5) / count))

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        law = height_law(self.skewness, self.kurtosis, self.system)
        return f"skewness {self.skewness:.4g}, kurtosis {self.kurtosis:.4g} ({law.label})"


@dataclass(frozen=True, eq=False)
class HeightsOf:
    """Heights distributed as those of a measured ``surface``, levelled beforehand; missing points do not count."""

    surface: Surface

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count, linear between the sorted heights at (k - 1/2)/N."""
        valid = self.surface.heights[~self.surface.mask].astype(np.float64)
        quantiles: RealArray = np.quantile(valid, (np.arange(count) + 0.5) / count, method="hazen")
        return np.sort(quantiles)

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        return f"heights of {self.surface.origin.source or 'a surface'}"

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the surface."""
        return self.surface.citation_keys


@dataclass(frozen=True)
class TwoLevels:
    """Two Gaussian distributions of heights, ``separation`` apart: the upper one on the ``share`` of the area.

    ``separation`` of their means and ``upper_deviation`` in units of the standard deviation of the lower one. Equal
    distributions show two maxima if their means are more than two standard deviations apart.

    Raises
    ------
    InputError
        If the share is not between 0 and 1, or the others are not positive.
    """

    share: float
    separation: float
    upper_deviation: float = 1.0

    def __post_init__(self) -> None:
        require.between(self.share, 0.0, 1.0, "share of the upper level")
        require.positive(self.separation, "separation of the two levels")
        require.positive(self.upper_deviation, "deviation of the upper level")

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count, by inversion of the distribution function on a fine table."""
        from scipy.special import ndtr

        low = min(-9.0, self.separation - 9.0 * self.upper_deviation)
        high = max(9.0, self.separation + 9.0 * self.upper_deviation)
        z = np.linspace(low, high, max(200_001, 4 * count))
        upper = ndtr((z - self.separation) / self.upper_deviation)
        below = (1.0 - self.share) * ndtr(z) + self.share * upper
        heights: RealArray = np.interp((np.arange(count) + 0.5) / count, below, z)
        return heights

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        distance = f"{self.separation:.4g} apart, the upper {self.upper_deviation:.4g} as wide"
        return f"two levels {distance} on {self.share:.4g} of the area"
