"""Finite elements of an elastic-plastic sphere in four regimes (Kogut & Etsion 2002)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from . import elastic_plastic_asperity as law
from .elastic_plastic_summits import MEAN_HEIGHT, NU, SUMMITS, OfElasticPlasticSummits
from .greenwood_williamson import GreenwoodWilliamson
from .hertz import HertzPoint
from .plasticity_index import critical_interference, hardness_coefficient
from .protocol import E_STAR, Input, Limit
from .roughness import Roughness
from .single_contact import ContactAnswer, small_slope


@dataclass(frozen=True)
class KogutEtsionSphere:
    """Sphere with fitted powers of x = ω/ω_c between first yield and x = 110, fully plastic beyond; Hertz below.

    The fits do not join: load and area step by +3 % and -7 % at 1, +1.7 % and +2.9 % at 6, +7.9 % and +7.1 % at 110.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius
        Relative radius of curvature R in m, > 0.
    hardness
        Hardness H = 2.8Y of the softer body in Pa, > 0.
    nu
        Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν. The fits were made at 0.3.

    Examples
    --------
    >>> sphere = KogutEtsionSphere(E_star=110e9, radius=1e-6, hardness=6e9)
    >>> deep = sphere.at_interference(200 * sphere.critical_interference)
    >>> f"{deep.mean_pressure / 1e9:.2f} GPa"
    '6.00 GPa'
    """

    E_star: float
    radius: float
    hardness: float
    nu: float = 0.3
    breaks: ClassVar[tuple[float, ...]] = (1.0, 6.0, 110.0)
    name: ClassVar[str] = "kogut-etsion-sphere"
    title: ClassVar[str] = "Kogut-Etsion, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kogut2002",)
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("radius", "m", "relative radius of curvature"),
        Input("hardness", "Pa", "hardness of the softer body, 2.8 times its yield stress", of="bodies"),
        Input("nu", "", "Poisson's ratio of the body that yields", of="bodies", default=0.3),
    )

    def __post_init__(self) -> None:
        HertzPoint(self.E_star, self.radius)
        require.positive(self.hardness, "hardness (Pa)")
        hardness_coefficient(self.nu)

    @property
    def critical_interference(self) -> float:
        """ω_c = (πKH/2E*)² R in m, K = 0.454 + 0.41ν."""
        return critical_interference(self.E_star, self.radius, hardness_coefficient(self.nu) * self.hardness)

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c: x^1.5, 1.03x^1.425, 1.40x^1.263 and (3/K)x up to 1, 6, 110 and beyond."""
        x = np.asarray(x, dtype=float)
        plastic = 3.0 / hardness_coefficient(self.nu) * x
        branches = [x**1.5, 1.03 * x**1.425, 1.40 * x**1.263]
        return np.select([x <= end for end in self.breaks], branches, plastic)

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c: x, 0.93x^1.136, 0.94x^1.146 and 2x up to 1, 6, 110 and beyond."""
        x = np.asarray(x, dtype=float)
        branches = [x, 0.93 * x**1.136, 0.94 * x**1.146]
        return np.select([x <= end for end in self.breaks], branches, 2.0 * x)

    def at_interference(self, interference: ArrayLike) -> ContactAnswer:
        """The contact at ``interference`` ω in m, >= 0, of any shape."""
        return law.at_interference(self, interference)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        return law.at_load(self, load)

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Small slopes."""
        return (small_slope("contact radius over radius of curvature", answer.radius / self.radius),)


@dataclass(frozen=True)
class KogutEtsion(OfElasticPlasticSummits):
    """Greenwood and Williamson's summits, each with the law of ``KogutEtsionSphere``; Gaussian heights.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    density
        Summits per area η in 1/m², > 0.
    radius
        Radius R of the summits in m, > 0.
    height_deviation
        Standard deviation σ_s of the summit heights in m, > 0.
    hardness
        Hardness H = 2.8Y of the softer body in Pa, > 0.
    nu
        Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν. The fits were made at 0.3.
    mean_height
        Mean height of the summits above the mean plane of the surface in m, from which separations count.
    """

    E_star: float
    density: float
    radius: float
    height_deviation: float
    hardness: float
    nu: float = 0.3
    mean_height: float = 0.0
    name: ClassVar[str] = "kogut-etsion"
    title: ClassVar[str] = "Kogut-Etsion"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kogut2002",)
    inputs: ClassVar[tuple[Input, ...]] = (
        *SUMMITS,
        Input("hardness", "Pa", "hardness of the softer body, 2.8 times its yield stress", of="bodies"),
        NU,
        MEAN_HEIGHT,
    )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, hardness: float, nu: float = 0.3) -> Self:
        """Theory for the summits of a map, taken as Greenwood and Williamson's.

        Raises
        ------
        InputError
            If the roughness holds no summits, or their heights are all equal.
        """
        s = GreenwoodWilliamson.from_roughness(roughness, E_star)
        return cls(E_star, s.density, s.radius, s.height_deviation, hardness, nu, s.mean_height)

    @property
    def law(self) -> KogutEtsionSphere:
        """Law of one summit."""
        return KogutEtsionSphere(self.E_star, self.radius, self.hardness, self.nu)
