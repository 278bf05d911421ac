"""Elastic-plastic asperities: the laws of Chang, Etsion and Bogy, of Kogut and Etsion, and of Jackson and Green."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.parameters import Declared, Help
from ...core.values import Length, Pressure
from ..hardness.plasticity import critical_interference, hardness_coefficient, yield_coefficient
from ..protocol import (
    ContactAnswer,
    HeightDeviation,
    Limit,
    MeanHeight,
    Modulus,
    PoissonOfSolid,
    Prediction,
    SummitDensity,
    SummitRadius,
    small_slope,
)
from ..statistics.roughness import Roughness
from . import elastic_plastic_summits as law
from .elastic_plastic_summits import OfElasticPlasticSummits
from .greenwood_williamson import GreenwoodWilliamson

# Plastic flow of constant volume beyond first yield (Chang, Etsion & Bogy 1987).


@dataclass(frozen=True)
class ChangEtsionBogySphere(Declared):
    """Sphere that keeps its volume beyond ω_c: A = πRω(2 - 1/x), P = KHA, x = ω/ω_c; Hertz below.

    The load jumps by half at ω_c, from the mean pressure (2/3)KH to KH.
    """

    E_star: Modulus
    radius: Annotated[Length, "relative radius of curvature R"]
    hardness: Annotated[Pressure, Help("hardness H of the softer body", of="bodies")]
    nu: Annotated[PoissonOfSolid, Help("Poisson's ratio of the body that yields", of="bodies")] = 0.3
    breaks: ClassVar[tuple[float, ...]] = (1.0,)
    name: ClassVar[str] = "chang-etsion-bogy-sphere"
    title: ClassVar[str] = "Chang-Etsion-Bogy, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Chang1987",)

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
    """Greenwood and Williamson's summits, each with the law of ``ChangEtsionBogySphere``; Gaussian heights."""

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    hardness: Annotated[Pressure, Help("hardness H of the softer body", of="bodies")]
    nu: Annotated[PoissonOfSolid, Help("Poisson's ratio of the body that yields", of="bodies")] = 0.3
    mean_height: MeanHeight = 0.0
    name: ClassVar[str] = "chang-etsion-bogy"
    title: ClassVar[str] = "Chang-Etsion-Bogy"
    citation_keys: ClassVar[tuple[str, ...]] = ("Chang1987",)

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


# Finite elements of an elastic-plastic sphere in four regimes (Kogut & Etsion 2002).


@dataclass(frozen=True)
class KogutEtsionSphere(Declared):
    """Sphere with fitted powers of x = ω/ω_c between first yield and x = 110, fully plastic beyond; Hertz below.

    The fits do not join: load and area step by +3 % and -7 % at 1, +1.7 % and +2.9 % at 6, +7.9 % and +7.1 % at 110.

    Examples
    --------
    >>> sphere = KogutEtsionSphere(E_star=110e9, radius=1e-6, hardness=6e9)
    >>> deep = sphere.at_interference(200 * sphere.critical_interference)
    >>> f"{deep.mean_pressure / 1e9:.2f} GPa"
    '6.00 GPa'
    """

    E_star: Modulus
    radius: Annotated[Length, "relative radius of curvature R"]
    hardness: Annotated[Pressure, Help("hardness of the softer body, 2.8 times its yield stress", of="bodies")]
    nu: Annotated[
        PoissonOfSolid,
        Help(
            "Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν. The fits were made at 0.3",
            of="bodies",
        ),
    ] = 0.3
    breaks: ClassVar[tuple[float, ...]] = (1.0, 6.0, 110.0)
    name: ClassVar[str] = "kogut-etsion-sphere"
    title: ClassVar[str] = "Kogut-Etsion, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kogut2002",)

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
    """Greenwood and Williamson's summits, each with the law of ``KogutEtsionSphere``; Gaussian heights."""

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    hardness: Annotated[Pressure, Help("hardness of the softer body, 2.8 times its yield stress", of="bodies")]
    nu: Annotated[
        PoissonOfSolid,
        Help(
            "Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν. The fits were made at 0.3",
            of="bodies",
        ),
    ] = 0.3
    mean_height: MeanHeight = 0.0
    name: ClassVar[str] = "kogut-etsion"
    title: ClassVar[str] = "Kogut-Etsion"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kogut2002",)

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


# Finite elements of a sphere whose hardness falls as the contact grows (Jackson & Green 2005).


@dataclass(frozen=True)
class JacksonGreenSphere(Declared):
    """Sphere, Hertz up to x = ω/ω_c = 1.9, with a hardness H_G that depends on a/R beyond."""

    E_star: Modulus
    radius: Annotated[Length, "relative radius of curvature R"]
    yield_stress: Annotated[Pressure, Help("yield stress Y of the softer body", of="bodies")]
    nu: Annotated[
        PoissonOfSolid, Help("Poisson's ratio ν of the body that yields, up to 0.5; C = 1.295 exp(0.736ν)", of="bodies")
    ] = 0.3
    breaks: ClassVar[tuple[float, ...]] = (1.9,)
    name: ClassVar[str] = "jackson-green-sphere"
    title: ClassVar[str] = "Jackson-Green, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Jackson2005",)

    @property
    def critical_interference(self) -> float:
        """ω_c = (πCY/2E*)² R in m, C = 1.295 exp(0.736ν)."""
        return critical_interference(self.E_star, self.radius, yield_coefficient(self.nu) * self.yield_stress)

    @property
    def yield_strain(self) -> float:
        """e_y = Y/E*."""
        return self.yield_stress / self.E_star

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c: x^1.5 up to 1.9, then exp(-x^(5/12)/4) x^1.5 + (4H_G/CY)(1 - exp(-x^(5/9)/25)) x."""
        x = np.asarray(x, dtype=float)
        C = yield_coefficient(self.nu)
        flow = 4.0 / C * self.hardness_ratio(x) * -np.expm1(-(x ** (5.0 / 9.0)) / 25.0) * x
        return np.where(x <= self.breaks[0], x**1.5, np.exp(-0.25 * x ** (5.0 / 12.0)) * x**1.5 + flow)

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c: x up to 1.9, then x (x/1.9)^B with B = 0.14 exp(23 e_y)."""
        x = np.asarray(x, dtype=float)
        B = 0.14 * math.exp(23.0 * self.yield_strain)
        return np.asarray(x * np.maximum(x / self.breaks[0], 1.0) ** B)

    def hardness_ratio(self, x: RealArray) -> RealArray:
        """H_G/Y = 2.84 [1 - exp(-0.82 (a/R)^(-0.7))] at ``x`` of any shape, with a/R = (πCe_y/2) sqrt(A/A_c)."""
        slope = 0.5 * math.pi * yield_coefficient(self.nu) * self.yield_strain * np.sqrt(self.area_ratio(x))
        with np.errstate(divide="ignore"):
            ratio: RealArray = -2.84 * np.expm1(-0.82 * slope**-0.7)
        return ratio

    def at_interference(self, interference: ArrayLike) -> ContactAnswer:
        """The contact at ``interference`` ω in m, >= 0, of any shape."""
        return law.at_interference(self, interference)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        return law.at_load(self, load)

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """a/R up to 0.4, to which the finite elements went."""
        message = "The formulas were fitted to finite elements up to there."
        return (
            Limit(
                "contact radius over radius", np.ravel(answer.radius / self.radius), 0.0, 0.4, "Jackson2005", message
            ),
        )


@dataclass(frozen=True)
class JacksonGreen(OfElasticPlasticSummits):
    """Greenwood and Williamson's summits, each with the law of ``JacksonGreenSphere``; Gaussian heights."""

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    yield_stress: Annotated[Pressure, Help("yield stress Y of the softer body", of="bodies")]
    nu: Annotated[
        PoissonOfSolid, Help("Poisson's ratio ν of the body that yields, up to 0.5; C = 1.295 exp(0.736ν)", of="bodies")
    ] = 0.3
    mean_height: MeanHeight = 0.0
    name: ClassVar[str] = "jackson-green"
    title: ClassVar[str] = "Jackson-Green"
    citation_keys: ClassVar[tuple[str, ...]] = ("Jackson2005",)

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, yield_stress: float, nu: float = 0.3) -> Self:
        """Theory for the summits of a map, taken as Greenwood and Williamson's.

        Raises
        ------
        InputError
            If the roughness holds no summits, or their heights are all equal.
        """
        s = GreenwoodWilliamson.from_roughness(roughness, E_star)
        return cls(E_star, s.density, s.radius, s.height_deviation, yield_stress, nu, s.mean_height)

    @property
    def law(self) -> JacksonGreenSphere:
        """Law of one summit."""
        return JacksonGreenSphere(self.E_star, self.radius, self.yield_stress, self.nu)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts without elastic interaction, on blunt summits, and a mean contact radius of up to 0.4 R."""
        mean_area = np.divide(
            prediction.area_fraction,
            prediction.contact_density,
            out=np.zeros_like(prediction.area_fraction),
            where=prediction.contact_density > 0.0,
        )
        message = "The law of one summit was fitted to finite elements up to there."
        slope = np.sqrt(mean_area / np.pi) / self.radius
        limit = Limit("mean contact radius over radius of summits", slope, 0.0, 0.4, "Jackson2005", message)
        return (*self.model.validity(prediction), limit)
