"""Hertz contacts of spheres, cylinders and ellipsoids."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.values import Angle, Length, Number
from ..ask import BY_CONTACT, LINE_LOAD, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, bisected, checked, small_slope

RadiusX: TypeAlias = Annotated[Length, "relative radius of curvature along x"]
RadiusY: TypeAlias = Annotated[Length, "relative radius of curvature along y"]
PrincipalRadius: TypeAlias = Annotated[float, Number("length", infinite=True)]

# Hertz's point contact of two paraboloids of revolution (Hertz 1882; Johnson 1985, sec. 4.2).


@dataclass(frozen=True)
class HertzPoint(Theory):
    """Frictionless elastic contact of a sphere of relative radius R.

        a³ = 3 P R/(4 E*),  δ = a²/R,  p = p_0 sqrt(1 - r²/a²),  p_0 = 3 P/(2 π a²).

    Examples
    --------
    >>> ball = HertzPoint(E_star=115e9, radius=5e-3)
    >>> answer = ball.at_load(10.0)
    >>> radius, peak, approach = answer.radius, answer.max_pressure, answer.approach
    >>> f"{radius * 1e6:.1f} µm, {peak / 1e9:.3f} GPa, {approach * 1e9:.0f} nm"
    '68.8 µm, 1.008 GPa, 948 nm'
    """

    E_star: Modulus
    radius: Annotated[Length, "relative radius of curvature R, 1/R = 1/R1 + 1/R2"]
    name: ClassVar[str] = "hertz"
    title: ClassVar[str] = "Hertz, point contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        return self.at_radius(np.cbrt(0.75 * P * self.radius / self.E_star))

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape: P = (4/3) E* sqrt(R)
        δ^(3/2)."""
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
        """Pressure in Pa at the distance ``r`` in m (any shape) from the axis under ``load`` in
        N, > 0."""
        answer = self.at_load(require.positive(load, "load (N)"))
        return hertz_profile(np.asarray(r, dtype=float), answer)

    def displacement(self, r: ArrayLike, load: float) -> RealArray:
        """Sum of the normal displacements of both surfaces in m at the distance ``r`` in m (any
        shape).

        Inside p0 π (2a² - r²)/(4aE*), which is δ - r²/2R; outside
        p0/(2E*a) [(2a² - r²) arcsin(a/r) + r a sqrt(1 - a²/r²)].
        """
        answer = self.at_load(require.positive(load, "load (N)"))
        a, scale = answer.radius, answer.max_pressure / (2.0 * self.E_star * answer.radius)
        distance = np.abs(np.asarray(r, dtype=float))
        sine = a / np.maximum(distance, a)
        outside = np.maximum(distance, a) * a * np.sqrt((1.0 - sine) * (1.0 + sine))
        return np.asarray(scale * ((2.0 * a**2 - distance**2) * np.arcsin(sine) + outside))

    def gap(self, r: ArrayLike, load: float) -> RealArray:
        """Distance of the deformed surfaces in m at the distance ``r`` in m (any shape) from the
        axis, zero inside."""
        answer = self.at_load(require.positive(load, "load (N)"))
        distance = np.abs(np.asarray(r, dtype=float))
        opened = self.displacement(distance, load) - answer.approach + distance**2 / (2.0 * self.radius)
        return np.where(distance > answer.radius, np.maximum(opened, 0.0), 0.0)


def hertz_profile(r: RealArray, answer: ContactAnswer) -> RealArray:
    """p0 sqrt(1 - r²/a²), zero outside, in Pa; also the pressure of a line contact at the distance
    ``r`` in m."""
    return answer.max_pressure * np.sqrt(np.maximum(1.0 - (r / answer.radius) ** 2, 0.0))


# Hertz's line contact of two parallel cylinders in plane strain (Hertz 1882; Johnson 1985, sec.
# 4.2c).


@dataclass(frozen=True)
class HertzLine(Theory):
    """Frictionless elastic contact of a cylinder of relative radius R; P per length.

        a² = 4 P R/(π E*),  p_0 = E* a/(2 R),  p = p_0 sqrt(1 - x²/a²).

    The approach of distant points depends on how the bodies are held (it grows with the logarithm
    of their size), so approach and stiffness are NaN.
    """

    E_star: Modulus
    radius: Radius
    name: ClassVar[str] = "hertz-line"
    title: ClassVar[str] = "Hertz, line contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape."""
        P = checked(load, "load per length (N/m)")
        return self.at_half_width(np.sqrt(4.0 * P * self.radius / (np.pi * self.E_star)))

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, >= 0, of any shape."""
        a = checked(half_width, "half-width (m)")
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(
            load=0.25 * np.pi * self.E_star * a**2 / self.radius,
            approach=unknown,
            radius=a,
            area=2.0 * a,
            max_pressure=0.5 * self.E_star * a / self.radius,
            stiffness=unknown,
        )

    def at_peak(self, pressure: ArrayLike) -> ContactAnswer:
        """The contact whose largest pressure p0 in Pa is ``pressure``, >= 0, of any shape."""
        p0 = checked(pressure, "largest pressure (Pa)")
        return self.at_half_width(2.0 * p0 * self.radius / self.E_star)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in
        N/m, > 0."""
        answer = self.at_load(require.positive(load, "load per length (N/m)"))
        return hertz_profile(np.asarray(x, dtype=float), answer)

    def gap(self, x: ArrayLike, load: float) -> RealArray:
        """Distance of the deformed surfaces in m at ``x`` in m (any shape) from the middle, zero
        inside.

        (1/2R) [x sqrt(x² - a²) - a² arcosh(x/a)].
        """
        a = self.at_load(require.positive(load, "load per length (N/m)")).radius
        return root_gap(np.abs(np.asarray(x, dtype=float)), a) / (2.0 * self.radius)


def root_gap(x: RealArray, a: RealArray) -> RealArray:
    """2 ∫ sqrt(t² - a²) dt over a < t < ``x``: x sqrt(x² - a²) - a² arcosh(x/a), zero for x < a."""
    outside = np.maximum(x, a)
    return np.asarray(outside * np.sqrt((outside - a) * (outside + a)) - a**2 * np.arccosh(outside / a))


# Hertz's contact with two different curvatures: an ellipse (Hertz 1882; Johnson 1985, sec. 4.2).


def axis_ratio(curvature_ratio: ArrayLike) -> RealArray:
    """Minor over major semi-axis of the contact ellipse for B/A = larger over smaller curvature, >=
    1, of any shape.

    B/A = [(a/b)² E - K]/(K - E) with complete elliptic integrals, written as a ratio of Carlson's
    symmetric integrals, R_D(0, 1, b²/a²)/R_D(0, b²/a², 1), which loses no digits near the circle.
    """
    from scipy.special import elliprd

    ratio = checked(curvature_ratio, "ratio of the curvatures", lowest=1.0)
    target = np.log(ratio)

    def excess(s: RealArray) -> RealArray:
        n = np.exp(-2.0 * s)
        return np.asarray(np.log(elliprd(0.0, 1.0, n) / elliprd(0.0, n, 1.0)) - target)

    # -ln(b/a) is some 0.64 ln(B/A)
    return np.exp(-bisected(excess, np.zeros_like(target), target))


@dataclass(frozen=True, eq=False)
class EllipseAnswer(ContactAnswer):
    """Elliptical contacts with their semi-axes along x and y, ``semi_x`` and ``semi_y`` in m."""

    semi_x: RealArray
    semi_y: RealArray


_BY_LOAD = BY_CONTACT[0]
_SEMI_X, _SEMI_Y = (Quantity(f"semi_{axis}", "m", f"semi-axis of the contact along {axis}") for axis in "xy")


@dataclass(frozen=True)
class HertzEllipse(Theory):
    """Frictionless elastic contact of bodies whose gap before loading is x²/2Rx + y²/2Ry.

        p = p_0 sqrt(1 - x²/a² - y²/b²),  p_0 = 3 P/(2 π a b),  δ = p_0 b K(e)/E*,  e² = 1 - b²/a².

    a is the larger semi-axis, which lies along the axis of the larger radius, K the complete
    elliptic integral. ``HertzBodies`` makes it from the principal radii of both bodies.
    """

    E_star: Modulus
    radius_x: RadiusX
    radius_y: RadiusY
    name: ClassVar[str] = "hertz-ellipse"
    title: ClassVar[str] = "Hertz, elliptical contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("semi-axis over radius of curvature", lambda theory, answer: theory.steepest(answer.load)),
    )
    ways: ClassVar[tuple[Way, ...]] = (replace(_BY_LOAD, columns=(*_BY_LOAD.columns, _SEMI_X, _SEMI_Y)),)

    @property
    def eccentricity(self) -> float:
        """sqrt(1 - b²/a²) of the contact ellipse, the same at all loads."""
        ratio = self._axis_ratio
        return float(np.sqrt((1.0 - ratio) * (1.0 + ratio)))

    def at_load(self, load: ArrayLike) -> EllipseAnswer:
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
        along = (a, b) if self.radius_x >= self.radius_y else (b, a)
        return EllipseAnswer(P, approach, np.sqrt(a * b), area, p0, stiffness, *along)

    def semi_axes(self, load: ArrayLike) -> tuple[RealArray, RealArray]:
        """Semi-axes of the contact along x and y in m under ``load`` in N, >= 0, of any shape."""
        major, minor = self._major_and_minor(checked(load, "load (N)"))
        return (major, minor) if self.radius_x >= self.radius_y else (minor, major)

    def steepest(self, load: ArrayLike) -> RealArray:
        """Largest semi-axis over radius of curvature along the same axis under ``load`` in N, >= 0,
        of any shape."""
        along_x, along_y = self.semi_axes(load)
        return np.asarray(np.maximum(along_x / self.radius_x, along_y / self.radius_y))

    def pressure(self, x: ArrayLike, y: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x``, ``y`` in m (broadcast) from the centre under ``load`` in N, >
        0."""
        along_x, along_y = self.semi_axes(require.positive(load, "load (N)"))
        inside = 1.0 - (np.asarray(x) / along_x) ** 2 - (np.asarray(y) / along_y) ** 2
        return self.at_load(load).max_pressure * np.sqrt(np.maximum(inside, 0.0))

    @property
    def _axis_ratio(self) -> float:
        radii = sorted((self.radius_x, self.radius_y))
        return float(axis_ratio(radii[1] / radii[0]))

    def _major_and_minor(self, P: RealArray) -> tuple[RealArray, RealArray]:
        """Semi-axes a >= b from 1/2R = (p0/E*)(b/a²)(K - E)/e², R the larger radius and (K -
        E)/e² = R_D(0, b²/a², 1)/3."""
        from scipy.special import elliprd

        ratio, flattest = self._axis_ratio, max(self.radius_x, self.radius_y)
        a: RealArray = np.cbrt(P * flattest * elliprd(0.0, ratio**2, 1.0) / (np.pi * self.E_star))
        return a, ratio * a


@dataclass(frozen=True)
class HertzBodies(Theory):
    """Frictionless elastic contact of two bodies by their four principal radii, whose planes x are
    turned by the angle α.

    A relative radius R of the gap is that of the curvatures 1/R = 1/2 (S ± D) with

        S = 1/R_1x + 1/R_1y + 1/R_2x + 1/R_2y,  D² = d_1² + d_2² + 2 d_1 d_2 cos 2α,
        d_i = 1/R_ix - 1/R_iy,

    and the contact is that of ``HertzEllipse``. Radii are positive where a body is convex, negative
    where it is hollow and infinite where it is straight.

    Examples
    --------
    Two crossed cylinders of equal radii touch in a circle:

    >>> rods = HertzBodies(
    ...     100e9,
    ...     radius_1x=math.inf, radius_1y=0.01, radius_2x=math.inf, radius_2y=0.01,
    ...     angle=math.pi / 2,
    ... )
    >>> f"{rods.radius_x:.4f} m, {rods.radius_y:.4f} m"
    '0.0100 m, 0.0100 m'
    """

    E_star: Modulus
    radius_1x: Annotated[PrincipalRadius, "radius of the first body in its plane x; inf where it is straight"]
    radius_1y: Annotated[PrincipalRadius, "radius of the first body in its plane y; inf where it is straight"]
    radius_2x: Annotated[PrincipalRadius, "radius of the second body in its plane x; inf where it is straight"]
    radius_2y: Annotated[PrincipalRadius, "radius of the second body in its plane y; inf where it is straight"]
    angle: Annotated[Angle, "angle from the plane x of the first body to that of the second"] = 0.0
    name: ClassVar[str] = "hertz-bodies"
    title: ClassVar[str] = "Hertz, two bodies by their principal radii"
    citation_keys: ClassVar[tuple[str, ...]] = HertzEllipse.citation_keys
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("semi-axis over radius of curvature", lambda theory, answer: theory.ellipse.steepest(answer.load)),
    )
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("radius_x", "m", "larger relative radius of curvature, that along the larger semi-axis"),
        Quantity("radius_y", "m", "smaller relative radius of curvature"),
        Quantity("turn", "rad", "angle from the plane x of the first body to the larger semi-axis"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        replace(
            _BY_LOAD,
            columns=(
                *_BY_LOAD.columns,
                replace(_SEMI_X, label="larger semi-axis of the contact"),
                replace(_SEMI_Y, label="smaller semi-axis of the contact"),
            ),
        ),
    )

    radius_x: float = field(init=False, repr=False)
    radius_y: float = field(init=False, repr=False)
    turn: float = field(init=False, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        radii = (self.radius_1x, self.radius_1y, self.radius_2x, self.radius_2y)
        if 0.0 in radii:
            raise InputError("principal radii (m) must not be zero, but one is. Write inf where a body is straight.")
        first, second = 1.0 / self.radius_1x - 1.0 / self.radius_1y, 1.0 / self.radius_2x - 1.0 / self.radius_2y
        along, across = first + second * math.cos(2.0 * self.angle), second * math.sin(2.0 * self.angle)
        total, difference = sum(1.0 / radius for radius in radii), math.hypot(along, across)
        flat, steep = 0.5 * (total - difference), 0.5 * (total + difference)
        # what rounding leaves of two equal curvatures is none
        if not flat > 1e-12 * sum(abs(1.0 / radius) for radius in radii):
            raise InputError(
                "principal radii (m) must leave a gap that opens in all directions, but its curvatures are "
                f"{flat:.4g} and {steep:.4g} 1/m. A line contact is that of HertzLine; a hollow body must be "
                "wider than the one in it."
            )
        made = {"radius_x": 1.0 / flat, "radius_y": 1.0 / steep, "turn": 0.5 * math.atan2(0.0 - across, -along)}
        for name, value in made.items():
            object.__setattr__(self, name, value)

    @property
    def ellipse(self) -> HertzEllipse:
        """The same in the principal planes of the gap, its larger radius along x."""
        return HertzEllipse(self.E_star, self.radius_x, self.radius_y)

    def at_load(self, load: ArrayLike) -> EllipseAnswer:
        """The contact under ``load`` in N, >= 0, of any shape; ``semi_x`` is the larger
        semi-axis."""
        return self.ellipse.at_load(load)


# Hertz contact of a summit with two curvatures (Johnson 1985, eq. 4.26-4.30), without solving for
# the ellipse.
#
# Curvatures κ_m(1 ± r), 0 <= r < 1. With the approach δ, A = π δ/κ_m f_A and P = (4/3) E*
# δ^(3/2)/κ_m^(1/2) f_P. The axis ratio k = b/a of the ellipse is the natural parameter: r and both
# factors are closed forms in it.


@dataclass(frozen=True, eq=False)
class Ellipse:
    """Contact ellipses of axis ratio ``k`` = b/a, 0 < k <= 1, any shape.

    ``r`` relative difference of the curvatures; ``area`` f_A and ``load`` f_P, which are 1 for a
    sphere; ``slope`` is dr/d(ln k), not positive.
    """

    k: RealArray
    r: RealArray
    area: RealArray
    load: RealArray
    slope: RealArray


def ellipse(k: RealArray) -> Ellipse:
    """Factors of ellipses with axis ratio ``k`` = b/a.

    With complete elliptic integrals K, E of the parameter m = 1 - k² and D = (K - E)/m, B = K - D,
    which lose no digits at small m: (1 + r)/(1 - r) = B/(k² D), f_A = (B + k² D)/(k K), f_P =
    (π/2K) sqrt[(B + k² D)/(k² K)].
    """
    from scipy.special import ellipkm1, elliprd

    k2 = np.square(k)
    K = ellipkm1(k2)
    D = elliprd(0.0, k2, 1.0) / 3.0
    B, both = K - D, K - D + k2 * D
    r = (B - k2 * D) / both
    # d ln(B/(k² D))/d(ln k) from the derivatives of K and E; the limit at the sphere is 3/4
    m = np.where(k2 < 1.0, 1.0 - k2, 1.0)
    D_slope = (B - k2 * D) / (2.0 * m * k2)
    B_slope = B / (2.0 * k2) - D_slope
    by_m = B_slope / B - D_slope / D + 1.0 / k2
    slope = np.where(k2 < 1.0, -(1.0 - r * r) * k2 * by_m, -0.75)
    return Ellipse(k, r, both / (k * K), math.pi / (2.0 * K) * np.sqrt(both / (k2 * K)), slope)


def ellipse_of_curvatures(ratio: float) -> Ellipse:
    """Ellipse of a summit whose curvatures have the ``ratio`` κ1/κ2 >= 1."""
    return ellipse(axis_ratio(ratio))
