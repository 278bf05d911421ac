"""Greenwood & Williamson (1966): spherical summits of one radius and random heights, each a Hertz contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .inversion import separation_at
from .limits import area_limit, blunt_summits
from .measured_heights import HistogramHeights
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .roughness import Roughness
from .summit_heights import NAMED_HEIGHTS, GaussianHeights, SummitHeights

LOWEST, HIGHEST = -40.0, 37.0
"""Separations in standard deviations between which pressures are inverted; at 37 a Gaussian has 1e-300 left."""


@dataclass(frozen=True)
class GreenwoodWilliamson:
    """Independent spherical summits on a rough surface against a rigid plane.

    With D = (h - z̄_s)/σ_s and F_m(D) = ∫_D^∞ (s - D)^m p(s) ds (Greenwood & Williamson 1966; Bhushan 1998, eq. 12-16)

        n = η F_0,  A_r/A_a = π η R σ_s F_1,  p = (4/3) η E* R^(1/2) σ_s^(3/2) F_(3/2).

    Parameters
    ----------
    E_star
        Contact modulus in Pa.
    density
        Summits per area η in 1/m².
    radius
        Radius R of the summits in m.
    height_deviation
        Standard deviation σ_s of the summit heights in m.
    mean_height
        Mean z̄_s of the summit heights above the mean plane of the surface in m, from which separations count.
    heights
        Distribution of the standardised summit heights.

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
    name: ClassVar[str] = "greenwood-williamson"
    title: ClassVar[str] = "Greenwood-Williamson"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966",)
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("density", "1/m^2", "summits per area"),
        Input("radius", "m", "radius of the summits"),
        Input("height_deviation", "m", "standard deviation of the summit heights"),
        Input("mean_height", "m", "mean summit height above the mean plane of the surface", default=0.0),
        Input("heights", "", "distribution of the summit heights", default=GaussianHeights(), choices=NAMED_HEIGHTS),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.density, "density of summits (1/m^2)")
        require.positive(self.radius, "radius of summits (m)")
        require.positive(self.height_deviation, "standard deviation of summit heights (m)")
        require.finite(self.mean_height, "mean height of summits (m)")

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, bins: int | None = None) -> Self:
        """Theory for the summits of a map: their density, 1/<κ>, and the mean and deviation of their heights.

        ``bins`` None: Gaussian heights; a number: their histogram with so many bins.

        Raises
        ------
        InputError
            If the roughness holds no summits, or their heights are all equal.
        """
        summits = roughness.known(roughness.summits, "its summits", cls.name)
        return cls(
            E_star,
            summits.density,
            1.0 / float(summits.curvature.mean()),
            summits.height_deviation,
            summits.mean_height,
            GaussianHeights() if bins is None else HistogramHeights.from_samples(summits.height, bins),
        )

    @property
    def pressure_unit(self) -> float:
        """η R σ_s E* (σ_s/R)^(1/2) in Pa, the unit of the dimensionless pressure P_a."""
        return self.density * self.radius * self.height_deviation * self.E_star * math.sqrt(self.roughness_ratio)

    @property
    def roughness_ratio(self) -> float:
        """σ_s/R."""
        return self.height_deviation / self.radius

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        h = curve(separation, "separations (m)")
        D = self.standardised(h)
        pressure, stiffness = self._law(h)
        return prediction(
            pressure,
            area_fraction=math.pi
            * self.density
            * self.radius
            * self.height_deviation
            * self.heights.tail_moment(D, 1.0),
            contact_density=self.density * self.heights.tail_moment(D, 0.0),
            separation=h,
            stiffness=stiffness,
        )

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa.

        Raises
        ------
        InputError
            If a pressure is not positive, or larger than at 40 standard deviations below the mean summit height.
        """
        wanted = curve(pressure, "pressures (Pa)", positive=True)
        ends = (LOWEST, min(HIGHEST, self.heights.support[1]))
        low, high = (self.mean_height + self.height_deviation * (D - self.heights.mean) for D in ends)
        return self.at_separation(separation_at(wanted, self._law, low, high, unit=self.height_deviation))

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts that do not feel each other, on blunt summits."""
        return (area_limit(prediction), blunt_summits(prediction, self.roughness_ratio))

    def standardised(self, separation: RealArray) -> RealArray:
        """D at ``separation`` in m, in the coordinate of the distribution of heights."""
        D: RealArray = (separation - self.mean_height) / self.height_deviation + self.heights.mean
        return D

    def borne(self, separation: RealArray) -> RealArray:
        """Pressure in Pa that the summits carry at ``separation`` in m, of any shape."""
        D = self.standardised(separation)
        return np.asarray(4.0 / 3.0 * self.pressure_unit * self.heights.tail_moment(D, 1.5))

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D, pressure = self.standardised(h), self.borne(h)
        stiffness = 2.0 * self.pressure_unit / self.height_deviation * self.heights.tail_moment(D, 0.5)
        return pressure, stiffness
