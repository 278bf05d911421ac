"""Elastic-plastic asperities, one and many: the laws of Chang, Etsion and Bogy, of Kogut and
Etsion, of Jackson and Green."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.values import Pressure
from ..hardness.plasticity import critical_interference, hardness_coefficient, yield_coefficient
from ..protocol import (
    BLUNT_SUMMITS,
    CONTACT_RADIUS,
    FEW_CONTACTS,
    Bound,
    ContactAnswer,
    HeightDeviation,
    MeanHeight,
    Modulus,
    PoissonOfSolid,
    Prediction,
    Radius,
    SeparationTheory,
    SummitDensity,
    SummitRadius,
    Theory,
    bisected,
    checked,
)
from ..single.hertz import HertzPoint
from ..statistics.heights import GaussianHeights
from ..statistics.roughness import Roughness
from .greenwood_williamson import GreenwoodWilliamson, OnSummits

HardnessOfSofter: TypeAlias = Annotated[
    Pressure, Help("hardness H of the softer body, 2.8 times its yield stress", of="bodies")
]
YieldOfSofter: TypeAlias = Annotated[Pressure, Help("yield stress Y of the softer body", of="bodies")]
PoissonK: TypeAlias = Annotated[
    PoissonOfSolid,
    Help("Poisson's ratio ν of the body that yields, up to 0.5; K = 0.454 + 0.41ν", of="bodies"),
]
PoissonC: TypeAlias = Annotated[
    PoissonOfSolid, Help("Poisson's ratio ν of the body that yields, up to 0.5; C = 1.295 exp(0.736ν)", of="bodies")
]

# What laws of elastic-plastic spheres have in common: loads and areas in units of first yield, and
# their inversion.


class ElasticPlasticSphere(Theory):
    """Base of laws of load and area of a sphere against its interference ω, in units of first
    yield, x = ω/ω_c.

    ``breaks`` are the x at which the law changes its form; below the first of them it is Hertz's.
    """

    E_star: float
    radius: float
    breaks: ClassVar[tuple[float, ...]]
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)

    @property
    def critical_interference(self) -> float:
        """ω_c in m at first yield."""
        raise NotImplementedError

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c at ``x`` >= 0 of any shape."""
        raise NotImplementedError

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c at ``x`` >= 0 of any shape."""
        raise NotImplementedError

    def at_interference(self, interference: ArrayLike) -> ContactAnswer:
        """The contact at ``interference`` ω in m, >= 0, of any shape.

        The largest pressure is Hertz's below first yield and NaN beyond, where these laws give the
        mean pressure only; the stiffness is a central difference within the branch of the law.
        """
        omega = checked(interference, "interference (m)")
        unit = at_first_yield(self)
        x = omega / self.critical_interference
        area = unit.area * self.area_ratio(x)
        step = 1e-5 * np.maximum(x, 1e-300)
        branch = np.searchsorted(self.breaks, x)
        ends = [np.where(np.searchsorted(self.breaks, y) == branch, y, x) for y in (x - step, x + step)]
        with np.errstate(invalid="ignore"):
            slope = np.where(x > 0.0, (self.load_ratio(ends[1]) - self.load_ratio(ends[0])) / (ends[1] - ends[0]), 0.0)
        return ContactAnswer(
            load=unit.load * self.load_ratio(x),
            approach=omega,
            radius=np.sqrt(area / np.pi),
            area=area,
            max_pressure=np.where(x <= self.breaks[0], unit.max_pressure * np.sqrt(x), np.nan),
            stiffness=slope * unit.load / self.critical_interference,
        )

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape; within a jump of the law the
        interference of the jump."""
        P = checked(load, "load (N)")
        ratio = P / at_first_yield(self).load
        highest = np.full_like(ratio, np.log(np.max(ratio, initial=1.0)) + 10.0)
        log_x = bisected(lambda y: self.load_ratio(np.exp(y)) - ratio, np.full_like(ratio, -300.0), highest)
        return self.at_interference(np.where(ratio > 0.0, np.exp(log_x), 0.0) * self.critical_interference)


def at_first_yield(law: ElasticPlasticSphere) -> ContactAnswer:
    """Hertz's contact at ω_c, whose load and area are P_c and A_c."""
    return HertzPoint(law.E_star, law.radius).at_approach(law.critical_interference)


_NODES = 48  # between breaks of the law; 32 leave 1e-12
_SIGMAS = 9.0


@dataclass(frozen=True)
class ElasticPlasticSummits(SeparationTheory):
    """Sums over summits, p = η ∫ P(z - d) φ(z) dz and A_r/A_a = η ∫ A(z - d) φ(z) dz, with the law
    P, A of one summit.

    ``summits`` have Gaussian heights and are what holds if none of them yields; the ``law`` of one
    summit has the same modulus and radius.
    """

    summits: GreenwoodWilliamson
    law: ElasticPlasticSphere

    @property
    def _ends(self) -> tuple[float, float, float]:
        return self.summits._ends

    @property
    def _unit(self) -> float:
        """ω_c/σ_s."""
        return self.law.critical_interference / self.summits.height_deviation

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        """Pressure and stiffness: -d/dD of φ(D + u) is (D + u) φ, so that jumps of the law need no
        care."""
        D = self.summits.standardised(h)
        u, weight = self._depths(D)
        scale = self.summits.density * float(at_first_yield(self.law).load)
        terms = weight * self.law.load_ratio(u / self._unit) * GaussianHeights().density(D[..., None] + u)
        pressure: RealArray = scale * np.sum(terms, axis=-1)
        rise: RealArray = scale * np.sum(terms * (D[..., None] + u), axis=-1)
        return pressure, rise / self.summits.height_deviation

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D, gaussian = self.summits.standardised(h), GaussianHeights()
        u, weight = self._depths(D)
        area = np.sum(weight * self.law.area_ratio(u / self._unit) * gaussian.density(D[..., None] + u), axis=-1)
        unit = self.summits.density * float(at_first_yield(self.law).area)
        return unit * area, self.summits.density * gaussian.tail_moment(D, 0.0)

    def _depths(self, D: RealArray) -> tuple[RealArray, RealArray]:
        """Nodes u = s - D > 0 and weights between the breaks of the law and where the density of
        heights is nothing.

        Over sqrt(u), in which half-integer powers are smooth. For D > 0 the density falls like
        exp(-Du), so the panels end where it has fallen by exp(-40).
        """
        first = np.maximum(0.0, -_SIGMAS - D)
        last = np.where(D > 0.0, 80.0 / (np.sqrt(D * D + 80.0) + np.abs(D)), _SIGMAS - D)
        middle = 0.5 * (first + last)  # a narrow law leaves one wide panel: halved
        inner = [np.full_like(D, x * self._unit) for x in self.law.breaks]
        ends = np.sort(np.stack([np.clip(e, first, last) for e in (first, *inner, middle, last)], axis=-1), axis=-1)
        q, weight = gauss(np.sqrt(ends), _NODES)
        return q * q, 2.0 * q * weight


class _ElasticPlastic(OnSummits):
    """Base of theories of rough surfaces that differ by the law of one ``summit`` only; Gaussian
    heights."""

    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS)

    @property
    def law(self) -> ElasticPlasticSphere:
        """Law of one summit."""
        raise NotImplementedError

    @property
    def model(self) -> ElasticPlasticSummits:
        """The summits, and the law of one of them."""
        return ElasticPlasticSummits(self.summits, self.law)

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        return self.model.at_separation(separation)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa; InputError as of ``GreenwoodWilliamson``."""
        return self.model.at_pressure(pressure)


@dataclass(frozen=True)
class _OfHardness(_ElasticPlastic):
    """Base of those whose summit yields by its hardness, in a law of the class ``sphere``."""

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    hardness: HardnessOfSofter
    nu: PoissonK = 0.3
    mean_height: MeanHeight = 0.0
    sphere: ClassVar[type[ChangEtsionBogySphere] | type[KogutEtsionSphere]]

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, hardness: float, nu: float = 0.3) -> Self:
        """Theory for the summits of a map, see ``GreenwoodWilliamson.from_roughness``."""
        s = GreenwoodWilliamson.from_roughness(roughness, E_star)
        numbers = (s.density, s.radius, s.height_deviation, hardness, nu, s.mean_height)
        return cls(E_star, *numbers)

    @property
    def law(self) -> ElasticPlasticSphere:
        """Law of one summit."""
        return self.sphere(self.E_star, self.radius, self.hardness, self.nu)


@dataclass(frozen=True)
class _SphereOfHardness(ElasticPlasticSphere):
    """Base of the spheres that yield by their hardness."""

    E_star: Modulus
    radius: Radius
    hardness: HardnessOfSofter
    nu: PoissonK = 0.3

    @property
    def critical_interference(self) -> float:
        """ω_c = (πKH/2E*)² R in m, K = 0.454 + 0.41ν."""
        return critical_interference(self.E_star, self.radius, hardness_coefficient(self.nu) * self.hardness)


# Plastic flow of constant volume beyond first yield (Chang, Etsion & Bogy 1987).


@dataclass(frozen=True)
class ChangEtsionBogySphere(_SphereOfHardness):
    """Sphere that keeps its volume beyond first yield at ω_c, K = 0.454 + 0.41ν; Hertz below.

        ω_c = (π K H/(2 E*))² R,  x = ω/ω_c > 1,
        A = π R ω (2 - 1/x),  P = K H A.

    The load jumps by half at ω_c, from the mean pressure (2/3)KH to KH.
    """

    breaks: ClassVar[tuple[float, ...]] = (1.0,)
    name: ClassVar[str] = "chang-etsion-bogy-sphere"
    title: ClassVar[str] = "Chang-Etsion-Bogy, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Chang1987",)

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c: x^(3/2) up to 1, then 1.5(2x - 1)."""
        return np.where(x <= 1.0, x * np.sqrt(x), 1.5 * (2.0 * x - 1.0))

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c: x up to 1, then 2x - 1."""
        return np.where(x <= 1.0, x, 2.0 * x - 1.0)


@dataclass(frozen=True)
class ChangEtsionBogy(_OfHardness):
    """Greenwood and Williamson's summits, each with the law of ``ChangEtsionBogySphere``; Gaussian
    heights.

        A_r/A_a = η ∫_h^∞ A(z - h) φ(z) dz,  p = η ∫_h^∞ P(z - h) φ(z) dz.

    A and P are area and load of one summit pressed by z - h, φ the density of the summit heights.
    """

    name: ClassVar[str] = "chang-etsion-bogy"
    title: ClassVar[str] = "Chang-Etsion-Bogy"
    citation_keys: ClassVar[tuple[str, ...]] = ("Chang1987",)
    sphere: ClassVar[type[ChangEtsionBogySphere]] = ChangEtsionBogySphere


# Finite elements of an elastic-plastic sphere in four regimes (Kogut & Etsion 2002).


@dataclass(frozen=True)
class KogutEtsionSphere(_SphereOfHardness):
    """Sphere with fitted powers of x = ω/ω_c between first yield and x = 110, fully plastic beyond;
    Hertz below.

        P/P_c = 1.03 x^(1.425),  A/A_c = 0.93 x^(1.136)  (1 < x ≤ 6),
        P/P_c = 1.40 x^(1.263),  A/A_c = 0.94 x^(1.146)  (6 < x ≤ 110),
        P/P_c = (3/K) x,  A/A_c = 2 x  (x > 110).

    The fits were made at ν = 0.3 and do not join: load and area step by +3 % and -7 % at 1, +1.7 %
    and +2.9 % at 6, +7.9 % and +7.1 % at 110.

    Examples
    --------
    >>> sphere = KogutEtsionSphere(E_star=110e9, radius=1e-6, hardness=6e9)
    >>> deep = sphere.at_interference(200 * sphere.critical_interference)
    >>> f"{deep.mean_pressure / 1e9:.2f} GPa"
    '6.00 GPa'
    """

    breaks: ClassVar[tuple[float, ...]] = (1.0, 6.0, 110.0)
    name: ClassVar[str] = "kogut-etsion-sphere"
    title: ClassVar[str] = "Kogut-Etsion, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kogut2002",)

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c: x^1.5, 1.03x^1.425, 1.40x^1.263 and (3/K)x up to 1, 6, 110 and beyond."""
        plastic = 3.0 / hardness_coefficient(self.nu) * x
        return np.select([x <= end for end in self.breaks], [x**1.5, 1.03 * x**1.425, 1.40 * x**1.263], plastic)

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c: x, 0.93x^1.136, 0.94x^1.146 and 2x up to 1, 6, 110 and beyond."""
        return np.select([x <= end for end in self.breaks], [x, 0.93 * x**1.136, 0.94 * x**1.146], 2.0 * x)


@dataclass(frozen=True)
class KogutEtsion(_OfHardness):
    """Greenwood and Williamson's summits, each with the law of ``KogutEtsionSphere``; Gaussian
    heights.

        A_r/A_a = η ∫_h^∞ A(z - h) φ(z) dz,  p = η ∫_h^∞ P(z - h) φ(z) dz.

    A and P are area and load of one summit pressed by z - h, φ the density of the summit heights.
    """

    name: ClassVar[str] = "kogut-etsion"
    title: ClassVar[str] = "Kogut-Etsion"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kogut2002",)
    sphere: ClassVar[type[KogutEtsionSphere]] = KogutEtsionSphere


# Finite elements of a sphere whose hardness falls as the contact grows (Jackson & Green 2005).

_FITTED = 0.4
_FITTED_TO = "The law of one sphere was fitted to finite elements up to there."


_LARGEST_STRAIN = 25.0
"""Y/E* up to which exp(23 Y/E*) is a number."""


@dataclass(frozen=True)
class JacksonGreenSphere(ElasticPlasticSphere):
    """Sphere, Hertz up to x = ω/ω_c = 1.9, with a hardness H_G that depends on a/R beyond.

    ω_c = (π C Y/(2 E*))² R,  C = 1.295 exp(0.736 ν),
    P/P_c = exp(-x^(5/12)/4) x^(3/2) + (4 H_G/(C Y)) [1 - exp(-x^(5/9)/25)] x,
    A/A_c = x (x/1.9)^B,  B = 0.14 exp(23 Y/E*),
    H_G/Y = 2.84 [1 - exp(-0.82 (a/R)^(-0.7))].
    """

    E_star: Modulus
    radius: Radius
    yield_stress: YieldOfSofter
    nu: PoissonC = 0.3
    breaks: ClassVar[tuple[float, ...]] = (1.9,)
    name: ClassVar[str] = "jackson-green-sphere"
    title: ClassVar[str] = "Jackson-Green, one sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Jackson2005",)
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound("contact radius over radius", CONTACT_RADIUS.value, 0.0, _FITTED, "Jackson2005", _FITTED_TO),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.yield_strain > _LARGEST_STRAIN:
            raise InputError(
                f"yield stress (Pa) must be at most {_LARGEST_STRAIN:g} times the contact modulus of "
                f"{self.E_star:g} Pa, for exp(23 Y/E*) to be a number, but is {self.yield_stress:g} Pa. The "
                "laws were fitted to yield strains up to about 0.01."
            )

    @property
    def critical_interference(self) -> float:
        """ω_c = (πCY/2E*)² R in m, C = 1.295 exp(0.736ν)."""
        return critical_interference(self.E_star, self.radius, yield_coefficient(self.nu) * self.yield_stress)

    @property
    def yield_strain(self) -> float:
        """e_y = Y/E*."""
        return self.yield_stress / self.E_star

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c: x^1.5 up to 1.9, then exp(-x^(5/12)/4) x^1.5 + (4H_G/CY)(1 - exp(-x^(5/9)/25))
        x."""
        C = yield_coefficient(self.nu)
        flow = 4.0 / C * self.hardness_ratio(x) * -np.expm1(-(x ** (5.0 / 9.0)) / 25.0) * x
        return np.where(x <= self.breaks[0], x**1.5, np.exp(-0.25 * x ** (5.0 / 12.0)) * x**1.5 + flow)

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c: x up to 1.9, then x (x/1.9)^B with B = 0.14 exp(23 e_y)."""
        B = 0.14 * math.exp(23.0 * self.yield_strain)
        return np.asarray(x * np.maximum(x / self.breaks[0], 1.0) ** B)

    def hardness_ratio(self, x: RealArray) -> RealArray:
        """H_G/Y = 2.84 [1 - exp(-0.82 (a/R)^(-0.7))] at ``x`` of any shape, with a/R = (πCe_y/2)
        sqrt(A/A_c)."""
        slope = 0.5 * math.pi * yield_coefficient(self.nu) * self.yield_strain * np.sqrt(self.area_ratio(x))
        with np.errstate(divide="ignore"):
            return np.asarray(-2.84 * np.expm1(-0.82 * slope**-0.7))


def _mean_slope(theory: JacksonGreen, answer: Prediction) -> RealArray:
    """Mean contact radius over radius, zero without contact."""
    area, count = answer.area_fraction, answer.contact_density
    mean_area = np.divide(area, count, out=np.zeros_like(area), where=count > 0.0)
    return np.asarray(np.sqrt(mean_area / np.pi) / theory.radius)


@dataclass(frozen=True)
class JacksonGreen(_ElasticPlastic):
    """Greenwood and Williamson's summits, each with the law of ``JacksonGreenSphere``; Gaussian
    heights.

        A_r/A_a = η ∫_h^∞ A(z - h) φ(z) dz,  p = η ∫_h^∞ P(z - h) φ(z) dz.

    A and P are area and load of one summit pressed by z - h, φ the density of the summit heights.
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    yield_stress: YieldOfSofter
    nu: PoissonC = 0.3
    mean_height: MeanHeight = 0.0
    name: ClassVar[str] = "jackson-green"
    title: ClassVar[str] = "Jackson-Green"
    citation_keys: ClassVar[tuple[str, ...]] = ("Jackson2005",)
    limits: ClassVar[tuple[Bound, ...]] = (
        *_ElasticPlastic.limits,
        Bound("mean contact radius over radius of summits", _mean_slope, 0.0, _FITTED, "Jackson2005", _FITTED_TO),
    )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, yield_stress: float, nu: float = 0.3) -> Self:
        """Theory for the summits of a map, see ``GreenwoodWilliamson.from_roughness``."""
        s = GreenwoodWilliamson.from_roughness(roughness, E_star)
        return cls(E_star, s.density, s.radius, s.height_deviation, yield_stress, nu, s.mean_height)

    @property
    def law(self) -> JacksonGreenSphere:
        """Law of one summit."""
        return JacksonGreenSphere(self.E_star, self.radius, self.yield_stress, self.nu)
