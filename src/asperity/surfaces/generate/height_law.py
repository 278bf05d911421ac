"""Distribution of heights with given skewness and kurtosis, of one of the systems that have one for every such pair."""

from __future__ import annotations

from typing import Protocol

from ...core import require
from ...core.arrays import RealArray
from ...core.pearson import Pearson
from .johnson import johnson

SYSTEMS = ("johnson", "pearson")
"""Systems of distributions; both have every possible pair, but other tails, which is what touches first."""


class HeightLaw(Protocol):
    """A distribution of zero mean and unit variance."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind it."""

    @property
    def label(self) -> str:
        """Name of the curve, for the history."""

    def of_normal(self, normal: RealArray) -> RealArray:
        """The number of this distribution for each standard normal number; increasing."""


def height_law(skewness: float, kurtosis: float, system: str = "johnson") -> HeightLaw:
    """Distribution of zero mean, unit variance and the given ``skewness`` and ``kurtosis``, of ``johnson`` or ``pearson``.

    Raises
    ------
    InputError
        If no distribution has these moments, only one of two heights, or the system is unknown.
    """
    if require.one_of(system, SYSTEMS, "system of distributions of the heights") == "pearson":
        return Pearson(skewness, kurtosis)
    return johnson(skewness, kurtosis)
