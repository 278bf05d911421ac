"""Plastic flow of constant volume beyond first yield (Chang, Etsion & Bogy 1987)."""

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
class ChangEtsionBogySphere:
    """Sphere that keeps its volume beyond ω_c: A = πRω(2 - 1/x), P = KHA, x = ω/ω_c; Hertz below.

    The load jumps by half at ω_c, from the mean pressure (2/3)KH to KH.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius
        Relative radius of curvature R in m, > 0.
    hardness
        Hardness H of the softer body in Pa, > 0.
    nu
        Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν. The first paper has K = 0.6, ν = 0.356.
    """

    E_star: float
    radius: float
    hardness: float
    nu: float = 0.3
    breaks: ClassVar[tuple[float, ...]] = (1.0,)
    name: ClassVar[str] = "chang-etsion-bogy-sphere"
    title: ClassVar[str] = "Chang-Etsion-Bogy, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Chang1987",)
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("radius", "m", "relative radius of curvature"),
        Input("hardness", "Pa", "hardness of the softer body", of="bodies"),
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
        """P/P_c: x^(3/2) up to 1, then 1.5(2x - 1)."""
        x = np.asarray(x, dtype=float)
        return np.where(x <= 1.0, x * np.sqrt(x), 1.5 * (2.0 * x - 1.0))

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c: x up to 1, then 2x - 1."""
        x = np.asarray(x, dtype=float)
        return np.where(x <= 1.0, x, 2.0 * x - 1.0)

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
class ChangEtsionBogy(OfElasticPlasticSummits):
    """Greenwood and Williamson's summits, each with the law of ``ChangEtsionBogySphere``; Gaussian heights.

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
        Hardness H of the softer body in Pa, > 0.
    nu
        Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν. The first paper has K = 0.6, ν = 0.356.
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
    name: ClassVar[str] = "chang-etsion-bogy"
    title: ClassVar[str] = "Chang-Etsion-Bogy"
    citation_keys: ClassVar[tuple[str, ...]] = ("Chang1987",)
    inputs: ClassVar[tuple[Input, ...]] = (
        *SUMMITS,
        Input("hardness", "Pa", "hardness of the softer body", of="bodies"),
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
    def law(self) -> ChangEtsionBogySphere:
        """Law of one summit."""
        return ChangEtsionBogySphere(self.E_star, self.radius, self.hardness, self.nu)
