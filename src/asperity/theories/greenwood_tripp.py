"""Greenwood & Tripp (1970): two rough surfaces whose summits meet on their shoulders."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .greenwood_williamson import HIGHEST, LOWEST
from .inversion import separation_at
from .limits import area_limit, blunt_summits
from .nayak import NayakSummits
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .roughness import Roughness
from .summit_heights import NAMED_HEIGHTS, GaussianHeights, SummitHeights


@dataclass(frozen=True)
class GreenwoodTripp:
    """Two surfaces, each with paraboloidal summits of the same radius and density, at random relative positions.

    With the sum of two summit heights of standard deviation σ_s and D = (h - z̄_s)/σ_s, averaged over the misalignment
    of a pair,

        n = 4π η² β σ_s F_1,  A_r/A_a = π² (η β σ_s)² F_2,
        p = (16√2 π/15) (η β σ_s)² E* (σ_s/β)^(1/2) F_(5/2).

    The second power of the density stands for pairs: doubling the summits of both surfaces quadruples the contacts.

    Parameters
    ----------
    E_star
        Contact modulus in Pa.
    density
        Summits per area η of each surface in 1/m².
    radius
        Radius β of the summits of each surface in m.
    height_deviation
        Standard deviation σ_s of the sum of a summit height of either surface in m.
    mean_height
        Mean z̄_s of that sum above the sum of the mean planes in m.
    heights
        Distribution of the standardised sum.

    Raises
    ------
    InputError
        If a parameter is not positive (the mean height may have any sign).
    """

    E_star: float
    density: float
    radius: float
    height_deviation: float
    mean_height: float = 0.0
    heights: SummitHeights = GaussianHeights()
    name: ClassVar[str] = "greenwood-tripp"
    title: ClassVar[str] = "Greenwood-Tripp, two rough surfaces"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "Greenwood1970", "McCool1986")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("density", "1/m^2", "summits per area of each surface"),
        Input("radius", "m", "radius of the summits of each surface"),
        Input("height_deviation", "m", "standard deviation of the sum of two summit heights"),
        Input("mean_height", "m", "mean of that sum above the mean planes", default=0.0),
        Input("heights", "", "distribution of the sum", default=GaussianHeights(), choices=NAMED_HEIGHTS),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.density, "density of summits (1/m^2)")
        require.positive(self.radius, "radius of summits (m)")
        require.positive(self.height_deviation, "standard deviation of the sum of summit heights (m)")
        require.finite(self.mean_height, "mean sum of summit heights (m)")

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for two independent surfaces, each with half of the moments m0, m2, m4 of ``roughness``.

        Such a pair has the same gap as one surface of ``roughness`` against a plane; summits are those of McCool.
        """
        half = NayakSummits(0.5 * roughness.m0, 0.5 * roughness.m2, 0.5 * roughness.m4)
        deviation = math.sqrt(2.0) * half.height_deviation
        return cls(E_star, half.density, half.radius, deviation, 2.0 * half.mean_height)

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m of the two mean planes."""
        h = curve(separation, "separations (m)")
        D = self._standardised(h)
        pressure, stiffness = self._law(h)
        return prediction(
            pressure,
            area_fraction=(math.pi * self._crowding) ** 2 * self.heights.tail_moment(D, 2.0),
            contact_density=4.0 * math.pi * self.density * self._crowding * self.heights.tail_moment(D, 1.0),
            separation=h,
            stiffness=stiffness,
        )

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa.

        Raises
        ------
        InputError
            If a pressure is not positive, or larger than at 40 standard deviations below the mean.
        """
        wanted = curve(pressure, "pressures (Pa)", positive=True)
        ends = (LOWEST, min(HIGHEST, self.heights.support[1]))
        low, high = (self.mean_height + self.height_deviation * (D - self.heights.mean) for D in ends)
        return self.at_separation(separation_at(wanted, self._law, low, high, unit=self.height_deviation))

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts that do not feel each other, on blunt summits."""
        return (area_limit(prediction), blunt_summits(prediction, self.height_deviation / self.radius))

    @property
    def _crowding(self) -> float:
        """η β σ_s."""
        return self.density * self.radius * self.height_deviation

    def _standardised(self, h: RealArray) -> RealArray:
        D: RealArray = (h - self.mean_height) / self.height_deviation + self.heights.mean
        return D

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D = self._standardised(h)
        unit = 16.0 * math.sqrt(2.0) * math.pi / 15.0 * self._crowding**2 * self.E_star
        unit *= math.sqrt(self.height_deviation / self.radius)
        slope = 2.5 * unit / self.height_deviation * self.heights.tail_moment(D, 1.5)
        return unit * self.heights.tail_moment(D, 2.5), slope
