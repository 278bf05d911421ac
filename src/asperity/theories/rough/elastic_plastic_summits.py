"""Rough contact of spherical summits of Gaussian heights with any law of an elastic-plastic asperity."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.parameters import Declared
from ...core.quadrature import gauss
from ..ask import separation_at
from ..limits import area_limit, blunt_summits
from ..protocol import ContactAnswer, Limit, Prediction, bisected, checked, curve, prediction
from ..single.hertz import HertzPoint
from ..statistics.heights import GaussianHeights
from .greenwood_williamson import HIGHEST, LOWEST, GreenwoodWilliamson

# What laws of elastic-plastic spheres have in common: loads and areas in units of first yield, and their inversion.


class ElasticPlasticLaw(Protocol):
    """Load and area of a sphere against its interference ω, in units of their values at first yield, x = ω/ω_c.

    ``breaks`` are the x at which the law changes its form; below the first of them it is Hertz's.
    """

    breaks: ClassVar[tuple[float, ...]]

    @property
    def E_star(self) -> float:
        """Contact modulus in Pa."""
        ...

    @property
    def radius(self) -> float:
        """Relative radius of curvature R in m."""
        ...

    @property
    def critical_interference(self) -> float:
        """ω_c in m at first yield."""
        ...

    def load_ratio(self, x: RealArray) -> RealArray:
        """P/P_c at ``x`` >= 0 of any shape."""
        ...

    def area_ratio(self, x: RealArray) -> RealArray:
        """A/A_c at ``x`` >= 0 of any shape."""
        ...


def at_first_yield(law: ElasticPlasticLaw) -> ContactAnswer:
    """Hertz's contact at ω_c, whose load and area are P_c and A_c."""
    return HertzPoint(law.E_star, law.radius).at_approach(law.critical_interference)


def at_interference(law: ElasticPlasticLaw, interference: ArrayLike) -> ContactAnswer:
    """The contact at ``interference`` ω in m, >= 0, of any shape.

    The largest pressure is Hertz's below first yield and NaN beyond, where these laws give the mean pressure only; the
    stiffness is a central difference within the branch of the law.
    """
    omega = checked(interference, "interference (m)")
    unit = at_first_yield(law)
    x = omega / law.critical_interference
    area = unit.area * law.area_ratio(x)
    step = 1e-5 * np.maximum(x, 1e-300)
    branch = np.searchsorted(law.breaks, x)
    ends = [np.where(np.searchsorted(law.breaks, y) == branch, y, x) for y in (x - step, x + step)]
    with np.errstate(invalid="ignore"):
        slope = np.where(x > 0.0, (law.load_ratio(ends[1]) - law.load_ratio(ends[0])) / (ends[1] - ends[0]), 0.0)
    return ContactAnswer(
        load=unit.load * law.load_ratio(x),
        approach=omega,
        radius=np.sqrt(area / np.pi),
        area=area,
        max_pressure=np.where(x <= law.breaks[0], unit.max_pressure * np.sqrt(x), np.nan),
        stiffness=slope * unit.load / law.critical_interference,
    )


def at_load(law: ElasticPlasticLaw, load: ArrayLike) -> ContactAnswer:
    """The contact under ``load`` in N, >= 0, of any shape; within a jump of the law the interference of the jump."""
    P = checked(load, "load (N)")
    ratio = P / at_first_yield(law).load
    highest = np.full_like(ratio, np.log(np.max(ratio, initial=1.0)) + 10.0)
    log_x = bisected(lambda y: law.load_ratio(np.exp(y)) - ratio, np.full_like(ratio, -300.0), highest)
    x = np.where(ratio > 0.0, np.exp(log_x), 0.0)
    return at_interference(law, x * law.critical_interference)


_NODES = 48  # between breaks of the law; 32 leave 1e-12
_SIGMAS = 9.0


@dataclass(frozen=True)
class ElasticPlasticSummits:
    """Sums over summits, p = η ∫ P(z - d) φ(z) dz and A_r/A_a = η ∫ A(z - d) φ(z) dz, with the law P, A of one summit.

    Parameters
    ----------
    summits
        Greenwood and Williamson's summits: what holds if none of them yields. Gaussian heights.
    law
        Law of one summit, of the same modulus and radius.
    """

    summits: GreenwoodWilliamson
    law: ElasticPlasticLaw

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        h = curve(separation, "separations (m)")
        pressure, stiffness = self._law(h)
        D = self.summits.standardised(h)
        u, weight = self._depths(D)
        area = np.sum(weight * self.law.area_ratio(u / self._unit) * _density(D[..., None] + u), axis=-1)
        return prediction(
            pressure,
            area_fraction=self.summits.density * float(at_first_yield(self.law).area) * area,
            contact_density=self.summits.density * GaussianHeights().tail_moment(D, 0.0),
            separation=h,
            stiffness=stiffness,
        )

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive."""
        wanted = curve(pressure, "pressures (Pa)", positive=True)
        deviation = self.summits.height_deviation
        low, high = (self.summits.mean_height + deviation * D for D in (LOWEST, HIGHEST))
        return self.at_separation(separation_at(wanted, self._law, low, high, unit=deviation))

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts without elastic interaction, on blunt summits."""
        return (area_limit(prediction), blunt_summits(prediction, self.summits.roughness_ratio))

    @property
    def _unit(self) -> float:
        """ω_c/σ_s."""
        return self.law.critical_interference / self.summits.height_deviation

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        """Pressure and stiffness: -d/dD of φ(D + u) is (D + u) φ, so that jumps of the law need no care."""
        D = self.summits.standardised(h)
        u, weight = self._depths(D)
        scale = self.summits.density * float(at_first_yield(self.law).load)
        terms = weight * self.law.load_ratio(u / self._unit) * _density(D[..., None] + u)
        pressure: RealArray = scale * np.sum(terms, axis=-1)
        rise: RealArray = scale * np.sum(terms * (D[..., None] + u), axis=-1)
        return pressure, rise / self.summits.height_deviation

    def _depths(self, D: RealArray) -> tuple[RealArray, RealArray]:
        """Nodes u = s - D > 0 and weights between the breaks of the law and where the density of heights is nothing.

        Over sqrt(u), in which half-integer powers are smooth. For D > 0 the density falls like exp(-Du), so the panels
        end where it has fallen by exp(-40).
        """
        first = np.maximum(0.0, -_SIGMAS - D)
        last = np.where(D > 0.0, 80.0 / (np.sqrt(D * D + 80.0) + np.abs(D)), _SIGMAS - D)
        middle = 0.5 * (first + last)  # a narrow law leaves one wide panel: halved
        inner = [np.full_like(D, x * self._unit) for x in self.law.breaks]
        ends = np.sort(np.stack([np.clip(e, first, last) for e in (first, *inner, middle, last)], axis=-1), axis=-1)
        q, weight = gauss(np.sqrt(ends), _NODES)
        return q * q, 2.0 * q * weight


class OfElasticPlasticSummits(Declared):
    """What theories of rough surfaces have in common that differ by the ``law`` of one summit only."""

    E_star: float
    density: float
    radius: float
    height_deviation: float
    mean_height: float

    @property
    def law(self) -> ElasticPlasticLaw:
        """Law of one summit."""
        raise NotImplementedError

    @property
    def model(self) -> ElasticPlasticSummits:
        """The summits, and the law of one of them."""
        summits = GreenwoodWilliamson(self.E_star, self.density, self.radius, self.height_deviation, self.mean_height)
        return ElasticPlasticSummits(summits, self.law)

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        return self.model.at_separation(separation)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa.

        Raises
        ------
        InputError
            If a pressure is not positive, or larger than at 40 standard deviations below the mean summit height.
        """
        return self.model.at_pressure(pressure)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts without elastic interaction, on blunt summits."""
        return self.model.validity(prediction)


def _density(s: RealArray) -> RealArray:
    density: RealArray = np.exp(-0.5 * s * s) / math.sqrt(2.0 * math.pi)
    return density
