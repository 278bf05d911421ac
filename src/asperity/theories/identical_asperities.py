"""Equal spheres at equal height: a defined texture against a plane (Bhushan 1998, eq. 1-5)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .hertz import HertzPoint
from .limits import area_limit
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .single_contact import ContactAnswer, small_slope

ROUNDED_ONSET = 0.5  # peak over hardness at p_m = H/3, Bhushan's rounded first yield


@dataclass(frozen=True)
class IdenticalAsperities:
    """η equal spheres per area that share the load equally and do not feel each other: A_r ∝ p^(2/3).

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    density
        Asperities per area η in 1/m², > 0.
    radius
        Their radius R in m, > 0.
    height
        Height of their tops above the mean plane of the surface in m, from which separations count.
    """

    E_star: float
    density: float
    radius: float
    height: float = 0.0
    name: ClassVar[str] = "identical-asperities"
    title: ClassVar[str] = "Identical asperities"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Hertz1882")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("density", "1/m^2", "asperities per area"),
        Input("radius", "m", "radius of the asperities"),
        Input("height", "m", "height of their tops above the mean plane", default=0.0),
    )

    def __post_init__(self) -> None:
        self.asperity  # noqa: B018 - checks modulus and radius
        require.positive(self.density, "density of asperities (1/m^2)")
        require.finite(self.height, "height of the asperities (m)")

    @property
    def asperity(self) -> HertzPoint:
        """One of them."""
        return HertzPoint(self.E_star, self.radius)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        return self._prediction(self.asperity.at_load(p / self.density))

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        h = curve(separation, "separations (m)")
        return self._prediction(self.asperity.at_approach(np.maximum(self.height - h, 0.0)), h)

    def pressure_at_yield(self, hardness: float) -> float:
        """Nominal pressure in Pa at p_m = H/3: η π³R²H³/48E*², ``hardness`` H in Pa; plan with a third to a half of it.

        Exact first yield is at p_m = 0.38H for ν = 0.3 and H = 2.8Y, half as much load again.
        """
        peak = ROUNDED_ONSET * require.positive(hardness, "hardness (Pa)")
        return self.density * float(self.asperity.at_peak(peak).load)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts, small against the radius."""
        radius = np.sqrt(prediction.area_fraction / (math.pi * self.density))
        slope = small_slope("contact radius over radius of the asperities", radius / self.radius)
        return (area_limit(prediction, citation="Bhushan1998"), slope)

    def _prediction(self, answer: ContactAnswer, separation: RealArray | None = None) -> Prediction:
        touching = np.where(answer.area > 0.0, self.density, 0.0)
        return prediction(
            self.density * answer.load,
            area_fraction=self.density * answer.area,
            contact_density=touching,
            separation=self.height - answer.approach if separation is None else separation,
            stiffness=self.density * answer.stiffness,
        )
