"""What laws of elastic-plastic spheres have in common: loads and areas in units of first yield, and their inversion."""

from __future__ import annotations

from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from .hertz import HertzPoint
from .single_contact import ContactAnswer, bisected, checked


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

    The largest pressure is Hertz's below first yield and NaN beyond, where these laws know the mean alone; the
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
