"""Kotwal & Bhushan (1996): the theory of Greenwood & Williamson for summit heights of any skewness and kurtosis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Self

from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.parameters import Declared
from ...core.pearson import Pearson
from ...core.values import Positive, Real
from ..protocol import HeightDeviation, Limit, MeanHeight, Modulus, Prediction, SummitDensity, SummitRadius
from ..statistics.roughness import Roughness
from .greenwood_williamson import GreenwoodWilliamson


@dataclass(frozen=True)
class PearsonHeights:
    """Standardised summit heights with the density of Pearson's system that has this ``skewness`` and ``kurtosis``.

    Raises
    ------
    InputError
        If kurtosis <= 1 + skewness².
    """

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
class KotwalBhushan(Declared):
    """Independent spherical summits of one radius, with heights of Pearson's system, against a rigid plane.

    Equations of :class:`~asperity.theories.greenwood_williamson.GreenwoodWilliamson` with F_m(D) = ∫_D^∞ (s - D)^m p(s)
    ds of the Pearson curve p(s) (Kotwal & Bhushan 1996). Types I and II end: there is no contact above the highest
    summit.

    Raises
    ------
    InputError
        If a parameter that must be positive is not, or kurtosis <= 1 + skewness².

    Examples
    --------
    Few high summits touch on a smaller area than those of Gaussian heights:

    >>> loads = [KotwalBhushan(1e11, 3e12, 2e-7, 5e-9, skewness=s, kurtosis=k).at_pressure(1e5) for s, k in ((0, 3),
    (0.5, 5))] >>> [f"{load.area_fraction[0]:.2e}" for load in loads] ['2.03e-05', '1.11e-05']
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    mean_height: MeanHeight = 0.0
    skewness: Annotated[Real, "skewness of the summit heights"] = 0.0
    kurtosis: Annotated[Positive, "kurtosis of the summit heights, 3 for Gaussian ones"] = 3.0
    name: ClassVar[str] = "kotwal-bhushan"
    title: ClassVar[str] = "Kotwal-Bhushan"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "Kotwal1996", "Pearson1895", "Pearson1916")

    def __post_init__(self) -> None:
        super().__post_init__()
        _ = self.greenwood_williamson  # a kurtosis that no heights have

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the summits of a map: density, 1/<κ>, and mean, deviation, skewness and kurtosis of their heights.

        Raises
        ------
        InputError
            If the roughness holds no summits, or their heights are all equal.
        """
        summits = roughness.known(roughness.summits, "its summits", cls.name)
        require.positive(summits.height_deviation, "standard deviation of summit heights (m)")
        return cls(
            E_star,
            summits.density,
            1.0 / float(summits.curvature.mean()),
            summits.height_deviation,
            summits.mean_height,
            summits.height_skewness,
            summits.height_kurtosis,
        )

    @cached_property
    def greenwood_williamson(self) -> GreenwoodWilliamson:
        """The same summits in the theory of Greenwood & Williamson, whose equations this one shares."""
        heights = PearsonHeights(self.skewness, self.kurtosis)
        return GreenwoodWilliamson(
            self.E_star, self.density, self.radius, self.height_deviation, self.mean_height, heights
        )

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        return self.greenwood_williamson.at_separation(separation)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa.

        Raises
        ------
        InputError
            If a pressure is not positive, or larger than at 40 standard deviations below the mean summit height.
        """
        return self.greenwood_williamson.at_pressure(pressure)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts without elastic interaction, on blunt summits."""
        return self.greenwood_williamson.validity(prediction)
