"""Hertz's contact with two different curvatures: an ellipse (Hertz 1882; Johnson 1985, sec. 4.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer, bisected, checked, small_slope


def axis_ratio(curvature_ratio: ArrayLike) -> RealArray:
    """Minor over major semi-axis of the contact ellipse for B/A = larger over smaller curvature, >= 1, of any shape.

    B/A = [(a/b)² E - K]/(K - E) with complete elliptic integrals, written as a ratio of Carlson's symmetric integrals,
    R_D(0, 1, b²/a²)/R_D(0, b²/a², 1), which loses no digits near the circle.
    """
    from scipy.special import elliprd

    ratio = checked(curvature_ratio, "ratio of the curvatures", lowest=1.0)
    target = np.log(ratio)

    def excess(s: RealArray) -> RealArray:
        n = np.exp(-2.0 * s)
        rise: RealArray = np.log(elliprd(0.0, 1.0, n) / elliprd(0.0, n, 1.0)) - target
        return rise

    # -ln(b/a) is some 0.64 ln(B/A)
    aspect: RealArray = np.exp(-bisected(excess, np.zeros_like(target), target))
    return aspect


@dataclass(frozen=True)
class HertzEllipse:
    """Frictionless elastic contact of bodies whose gap before loading is x²/2Rx + y²/2Ry.

    p = p0 sqrt(1 - x²/a² - y²/b²) on an ellipse, p0 = 3P/2πab, δ = p0 b K(e)/E*, e² = 1 - b²/a² with a the larger
    semi-axis, which lies along the axis of the larger radius.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius_x, radius_y
        Principal relative radii of curvature Rx and Ry in m, > 0.
    """

    E_star: float
    radius_x: float
    radius_y: float
    name: ClassVar[str] = "hertz-ellipse"
    title: ClassVar[str] = "Hertz, elliptical contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("radius_x", "m", "relative radius of curvature along x"),
        Input("radius_y", "m", "relative radius of curvature along y"),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.radius_x, "radius of curvature along x (m)")
        require.positive(self.radius_y, "radius of curvature along y (m)")

    @property
    def eccentricity(self) -> float:
        """sqrt(1 - b²/a²) of the contact ellipse, the same at all loads."""
        ratio = self._axis_ratio
        return float(np.sqrt((1.0 - ratio) * (1.0 + ratio)))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        from scipy.special import ellipkm1

        P = checked(load, "load (N)")
        a, b = self._major_and_minor(P)
        area = np.pi * a * b
        with np.errstate(invalid="ignore"):  # no load: no pressure
            p0 = np.where(P > 0.0, 1.5 * P / area, 0.0)
        approach = p0 * b * ellipkm1(self._axis_ratio**2) / self.E_star
        with np.errstate(invalid="ignore"):
            stiffness = np.where(P > 0.0, 1.5 * P / approach, 0.0)  # P rises like δ^(3/2)
        return ContactAnswer(P, approach, np.sqrt(a * b), area, p0, stiffness)

    def semi_axes(self, load: ArrayLike) -> tuple[RealArray, RealArray]:
        """Semi-axes of the contact along x and y in m under ``load`` in N, >= 0, of any shape."""
        major, minor = self._major_and_minor(checked(load, "load (N)"))
        return (major, minor) if self.radius_x >= self.radius_y else (minor, major)

    def pressure(self, x: ArrayLike, y: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x``, ``y`` in m (broadcast) from the centre under ``load`` in N, > 0."""
        along_x, along_y = self.semi_axes(require.positive(load, "load (N)"))
        inside = 1.0 - (np.asarray(x) / along_x) ** 2 - (np.asarray(y) / along_y) ** 2
        profile: RealArray = self.at_load(load).max_pressure * np.sqrt(np.maximum(inside, 0.0))
        return profile

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Slopes must be small: semi-axis over radius along either axis <= 0.3."""
        along_x, along_y = self.semi_axes(answer.load)
        slopes = np.maximum(along_x / self.radius_x, along_y / self.radius_y)
        return (small_slope("semi-axis over radius of curvature", slopes),)

    @property
    def _axis_ratio(self) -> float:
        radii = sorted((self.radius_x, self.radius_y))
        return float(axis_ratio(radii[1] / radii[0]))

    def _major_and_minor(self, P: RealArray) -> tuple[RealArray, RealArray]:
        """Semi-axes a >= b from 1/2R = (p0/E*)(b/a²)(K - E)/e², R the larger radius and (K - E)/e² = R_D(0, b²/a², 1)/3."""
        from scipy.special import elliprd

        ratio, flattest = self._axis_ratio, max(self.radius_x, self.radius_y)
        a: RealArray = np.cbrt(P * flattest * elliprd(0.0, ratio**2, 1.0) / (np.pi * self.E_star))
        return a, ratio * a
