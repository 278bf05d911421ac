"""Hertz's point contact of two paraboloids of revolution (Hertz 1882; Johnson 1985, sec. 4.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer, checked, small_slope


@dataclass(frozen=True)
class HertzPoint:
    """Frictionless elastic contact of a sphere of relative radius R: a³ = 3PR/4E*, δ = a²/R, p = p0 sqrt(1 - r²/a²).

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, 1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2, > 0.
    radius
        Relative radius of curvature R in m, 1/R = 1/R1 + 1/R2, > 0.

    Examples
    --------
    >>> ball = HertzPoint(E_star=115e9, radius=5e-3)
    >>> answer = ball.at_load(10.0)
    >>> f"{answer.radius * 1e6:.1f} µm, {answer.max_pressure / 1e9:.3f} GPa, {answer.approach * 1e9:.0f} nm"
    '68.8 µm, 1.008 GPa, 948 nm'
    """

    E_star: float
    radius: float
    name: ClassVar[str] = "hertz"
    title: ClassVar[str] = "Hertz, point contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("radius", "m", "relative radius of curvature"),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.radius, "radius of curvature (m)")

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        return self.at_radius(np.cbrt(0.75 * P * self.radius / self.E_star))

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape: P = (4/3) E* sqrt(R) δ^(3/2)."""
        return self.at_radius(np.sqrt(self.radius * checked(approach, "approach (m)")))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape."""
        a = checked(contact_radius, "contact radius (m)")
        return ContactAnswer(
            load=4.0 / 3.0 * self.E_star * a**3 / self.radius,
            approach=a**2 / self.radius,
            radius=a,
            area=np.pi * a**2,
            max_pressure=2.0 / np.pi * self.E_star * a / self.radius,
            stiffness=2.0 * self.E_star * a,
        )

    def at_peak(self, pressure: ArrayLike) -> ContactAnswer:
        """The contact whose largest pressure p0 in Pa is ``pressure``, >= 0, of any shape."""
        p0 = checked(pressure, "largest pressure (Pa)")
        return self.at_radius(0.5 * np.pi * p0 * self.radius / self.E_star)

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape) from the axis under ``load`` in N, > 0."""
        answer = self.at_load(require.positive(load, "load (N)"))
        return hertz_profile(np.asarray(r, dtype=float), answer)

    def displacement(self, r: ArrayLike, load: float) -> RealArray:
        """Sum of the normal displacements of both surfaces in m at the distance ``r`` in m (any shape).

        Inside p0 π (2a² - r²)/(4aE*), which is δ - r²/2R; outside
        p0/(2E*a) [(2a² - r²) arcsin(a/r) + r a sqrt(1 - a²/r²)].
        """
        answer = self.at_load(require.positive(load, "load (N)"))
        a, scale = answer.radius, answer.max_pressure / (2.0 * self.E_star * answer.radius)
        distance = np.abs(np.asarray(r, dtype=float))
        sine = a / np.maximum(distance, a)
        outside = np.maximum(distance, a) * a * np.sqrt((1.0 - sine) * (1.0 + sine))
        displacement: RealArray = scale * ((2.0 * a**2 - distance**2) * np.arcsin(sine) + outside)
        return displacement

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Slopes must be small: a/R <= 0.3."""
        return (small_slope("contact radius over radius of curvature", answer.radius / self.radius),)


def hertz_profile(r: RealArray, answer: ContactAnswer) -> RealArray:
    """p0 sqrt(1 - r²/a²), zero outside, in Pa; also the pressure of a line contact at the distance ``r`` in m."""
    profile: RealArray = answer.max_pressure * np.sqrt(np.maximum(1.0 - (r / answer.radius) ** 2, 0.0))
    return profile
