"""Individual asperities: the summits of a map, and identical ones."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.values import Length, Number, Several, SignedLength
from ..protocol import (
    BLUNT_SUMMITS,
    FEW_CONTACTS,
    Bound,
    ContactAnswer,
    Modulus,
    Prediction,
    SeparationTheory,
    Theory,
    curve,
    prediction,
    small_slope,
)
from ..single.hertz import HertzPoint
from ..statistics.roughness import Roughness

# Greenwood & Williamson's theory for the individual summits of a map, each with its height and
# radius.


_REACH = 4.0  # ranges of the heights below the lowest summit to which pressures are inverted


@dataclass(frozen=True, eq=False)
class DiscreteSummits(SeparationTheory):
    """Sums over the summits z_i > h of one map.

        A_r = π Σ R_i (z_i - h),  W = (4/3) E* Σ R_i^(1/2) (z_i - h)^(3/2).

    InputError if heights and radii differ in length, or a radius or a number is not positive.
    """

    E_star: Modulus
    height: Annotated[ArrayLike, Several(Number("length")), "heights of the summits above the mean plane"] = field(
        repr=False
    )
    radius: Annotated[ArrayLike, Several(Number("length", above=0.0)), "radii of the summits"] = field(repr=False)
    area: Annotated[float, Number("area", above=0.0), "nominal area"]
    name: ClassVar[str] = "discrete-summits"
    title: ClassVar[str] = "Greenwood-Williamson on the summits of the map"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966",)
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS)

    def __post_init__(self) -> None:
        super().__post_init__()
        height = curve(self.height, "heights of summits (m)")
        radius = curve(self.radius, "radii of summits (m)", positive=True)
        if height.shape != radius.shape:
            raise InputError(f"heights and radii of summits must be as many, but are {height.size} and {radius.size}.")
        order = np.argsort(-height, kind="stable")
        object.__setattr__(self, "height", height[order])
        object.__setattr__(self, "radius", radius[order])

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the summits of a map, with the radii of their mean curvatures."""
        summits = roughness.known(roughness.summits, "its summits", cls.name)
        return cls(E_star, summits.height, summits.radius, summits.area)

    @property
    def highest(self) -> float:
        """Height of the highest summit in m, where contact begins."""
        return float(self._z[0])

    @property
    def roughness_ratio(self) -> float:
        """Standard deviation of the heights over the mean radius."""
        return float(self._z.std() / self._r.mean())

    @property
    def _ends(self) -> tuple[float, float, float]:
        unit = float(np.ptp(self._z)) or float(self._r.mean())
        return float(self._z[-1]) - _REACH * unit, self.highest, unit

    @property
    def _z(self) -> RealArray:
        return np.asarray(self.height)

    @property
    def _r(self) -> RealArray:
        return np.asarray(self.radius)

    def _depths(self, h: float) -> RealArray:
        """z_i - h of the summits above ``h``, the highest first."""
        z = self._z
        return z[: np.searchsorted(-z, -h, side="left")] - h

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        roots = np.sqrt(self._r)
        sums = np.empty((2, h.size))
        for n, value in enumerate(h):
            depth = self._depths(value)
            shares = roots[: depth.size] * np.sqrt(depth)
            sums[:, n] = shares @ depth, shares.sum()
        unit = self.E_star / self.area
        return 4.0 / 3.0 * unit * sums[0], 2.0 * unit * sums[1]

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        depths = [self._depths(value) for value in h]
        areas = np.array([depth @ self._r[: depth.size] for depth in depths])
        return math.pi * areas / self.area, np.array([depth.size for depth in depths]) / self.area


# Equal spheres at equal height: a defined texture against a plane (Bhushan 1998, eq. 1-5).


ROUNDED_ONSET = 0.5  # peak over hardness at p_m = H/3, Bhushan's rounded first yield


@dataclass(frozen=True)
class IdenticalAsperities(Theory):
    """η equal spheres per area that share the load equally and do not interact.

    A_r/A_a = π η (3 p R/(4 η E*))^(2/3).
    """

    E_star: Modulus
    density: Annotated[float, Number("1/m^2", above=0.0), "asperities per area η"]
    radius: Annotated[Length, "their radius R"]
    height: Annotated[
        SignedLength, "height of their tops above the mean plane of the surface, from which separations count"
    ] = 0.0
    name: ClassVar[str] = "identical-asperities"
    title: ClassVar[str] = "Identical asperities"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Hertz1882")
    limits: ClassVar[tuple[Bound, ...]] = (
        replace(FEW_CONTACTS, citation="Bhushan1998"),
        small_slope(
            "contact radius over radius of the asperities",
            lambda theory, answer: np.sqrt(answer.area_fraction / (math.pi * theory.density)) / theory.radius,
        ),
    )

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
        """Nominal pressure in Pa at p_m = H/3: η π³R²H³/48E*², ``hardness`` H in Pa; plan with a
        third to a half of it.

        Exact first yield is at p_m = 0.38H for ν = 0.3 and H = 2.8Y, half as much load again.
        """
        peak = ROUNDED_ONSET * require.positive(hardness, "hardness (Pa)")
        return self.density * float(self.asperity.at_peak(peak).load)

    def _prediction(self, answer: ContactAnswer, separation: RealArray | None = None) -> Prediction:
        touching = np.where(answer.area > 0.0, self.density, 0.0)
        return prediction(
            self.density * answer.load,
            area_fraction=self.density * answer.area,
            contact_density=touching,
            separation=self.height - answer.approach if separation is None else separation,
            stiffness=self.density * answer.stiffness,
        )
