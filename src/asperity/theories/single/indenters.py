"""Indenters of any profile pressed into a half-space: flat, spherical, conical, by a power of the
radius, round or long."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from ...core.values import Length, Number, Positive
from ..ask import LINE_LOAD, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Theory, bisected, checked, small_slope

Exponent: TypeAlias = Annotated[float, Number(least=1.0, fix="Concave tips have no closed form."), "n of the profile"]
Slope: TypeAlias = Annotated[Positive, "slope of the flanks against the surface, cotangent of the half-angle"]

# Rigid axisymmetric indenters: power laws (cone, paraboloid, …), flat punch, exact sphere (Galin
# 1946; Sneddon 1965).
#
# For a profile f(r) and g(x) = x ∫ f'(r)/sqrt(x² - r²) dr over 0 < r < x: δ = g(a), P = 2E* ∫ [δ -
# g] dx over 0 < x < a, p(r) = (E*/π) ∫ g'(x)/sqrt(x² - r²) dx over r < x < a, and dP/dδ = 2E*a for
# all of them.


_NODES = 48  # 16 leave 1e-9 at exponent 8, 48 rounding


def convex(exponent: float) -> float:
    """``exponent`` if it is that of a convex tip, >= 1. InputError if it is not."""
    if not require.finite(exponent, "exponent of the profile") >= 1.0:
        raise InputError(
            f"exponent of the profile must be at least 1, but is {exponent:g}. Concave tips have no closed form."
        )
    return exponent


def power_integral(rho: ArrayLike, exponent: float) -> RealArray:
    """∫ t^(n-1)/sqrt(t² - ρ²) dt over ρ < t < 1, n = ``exponent``, at ``rho`` in 0 < ρ <= 1 of any
    shape.

    With t = ρ cosh s it is ρ^(n-1) ∫ cosh^(n-1) s ds up to arcosh(1/ρ), smooth; for n = 1 it is
    arcosh(1/ρ) itself.
    """
    inside = np.asarray(rho, dtype=float)
    end = np.arccosh(1.0 / inside)
    s, weight = gauss(np.stack([0.0 * end, end], axis=-1), _NODES)
    return np.asarray(np.sum(weight * (inside[..., None] * np.cosh(s)) ** (exponent - 1.0), axis=-1))


_EDGE = small_slope(
    "slope of the profile at the edge",
    lambda theory, answer: theory.exponent * theory.coefficient * answer.radius ** (theory.exponent - 1.0),
)


@dataclass(frozen=True)
class PowerLawIndenter(Theory):
    """Profile f = B r^n against an elastic half-space.

        δ = κ B a^n,  P = (2 n/(n + 1)) E* a δ,  κ = sqrt(π) Γ(n/2 + 1)/Γ((n + 1)/2).

    κ is π/2 for the cone (n = 1, B its slope), 2 for the paraboloid (n = 2, B = 1/2R), and the
    flat punch for n → ∞ at fixed B aⁿ.
    """

    E_star: Modulus
    coefficient: Annotated[float, Number("m^(1-n)", above=0.0), "B of the profile B r^n"]
    exponent: Exponent
    name: ClassVar[str] = "power-law-indenter"
    title: ClassVar[str] = "Power-law indenter"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Sneddon1965")
    limits: ClassVar[tuple[Bound, ...]] = (_EDGE,)

    @property
    def approach_factor(self) -> float:
        """κ of δ = κ B aⁿ."""
        n = self.exponent
        return math.sqrt(math.pi) * math.exp(math.lgamma(0.5 * n + 1.0) - math.lgamma(0.5 * n + 0.5))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        n, kappa = self.exponent, self.approach_factor
        P = checked(load, "load (N)")
        return self.at_radius((P * (n + 1.0) / (2.0 * n * self.E_star * kappa * self.coefficient)) ** (1.0 / (n + 1.0)))

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape."""
        delta = checked(approach, "approach (m)")
        return self.at_radius((delta / (self.approach_factor * self.coefficient)) ** (1.0 / self.exponent))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape."""
        n, a = self.exponent, checked(contact_radius, "contact radius (m)")
        approach = self.approach_factor * self.coefficient * a**n
        load = 2.0 * n / (n + 1.0) * self.E_star * a * approach
        # the largest pressure is at the centre for n <= 2; for larger n on a ring inside, found on
        # a fine grid of radii and refined
        with np.errstate(invalid="ignore"):
            scale = np.where(a > 0.0, n * self.E_star * approach / (np.pi * a), 0.0)
        if n == 1.0:
            peak = np.where(a > 0.0, np.inf, 0.0)
        elif n <= 2.0:
            peak = scale / (n - 1.0)
        else:
            low, high = 0.0, 1.0
            for _ in range(12):  # each a twentieth of the one before
                rho = np.linspace(low, high, 41)[1:]
                values = power_integral(rho, n)
                best = float(rho[np.argmax(values)])
                step = (high - low) / 40.0
                low, high = max(0.0, best - step), min(1.0, best + step)
            peak = scale * values.max()
        return ContactAnswer(load, approach, a, np.pi * a**2, np.asarray(peak), 2.0 * self.E_star * a)

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape) from the axis under ``load`` in
        N, > 0.

        n E* δ/(πa) ∫ t^(n-1)/sqrt(t² - ρ²) dt over ρ = r/a < t < 1; infinite at the apex of a cone.
        """
        answer = self.at_load(require.positive(load, "load (N)"))
        rho = np.abs(np.asarray(r, dtype=float)) / answer.radius
        scale = self.exponent * self.E_star * answer.approach / (np.pi * answer.radius)
        open_ = (rho > 0.0) & (rho < 1.0)
        values = scale * power_integral(np.where(open_, rho, 1.0), self.exponent)
        at_apex = np.inf if self.exponent == 1.0 else scale / (self.exponent - 1.0)
        return np.where(rho == 0.0, at_apex, values)


@dataclass(frozen=True)
class FlatPunch(Theory):
    """Flat-ended rigid cylinder.

    P = 2 E* a δ,  p = P/(2 π a² sqrt(1 - r²/a²)).
    """

    E_star: Modulus
    radius: Annotated[Length, "radius a of the end"]
    name: ClassVar[str] = "flat-punch"
    title: ClassVar[str] = "Flat punch"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Sneddon1965")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("approach over radius of the punch", lambda theory, answer: answer.approach / theory.radius),
    )

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        everywhere = np.ones_like(P)
        return ContactAnswer(
            load=P,
            approach=P / (2.0 * self.E_star * self.radius),
            radius=self.radius * everywhere,
            area=np.pi * self.radius**2 * everywhere,
            max_pressure=np.where(P > 0.0, np.inf, 0.0),
            stiffness=2.0 * self.E_star * self.radius * everywhere,
        )

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape."""
        return self.at_load(2.0 * self.E_star * self.radius * checked(approach, "approach (m)"))

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape) from the axis under ``load`` in N;
        infinite at the edge."""
        inside = np.maximum(1.0 - (np.asarray(r, dtype=float) / self.radius) ** 2, 0.0)
        outside = np.abs(np.asarray(r)) > self.radius
        mean = require.positive(load, "load (N)") / (np.pi * self.radius**2)
        with np.errstate(divide="ignore"):
            profile: RealArray = np.where(outside, 0.0, 0.5 * mean / np.sqrt(inside))
        return profile

    def displacement(self, r: ArrayLike, load: float) -> RealArray:
        """Normal displacement in m at the distance ``r`` in m (any shape): δ inside, (2δ/π)
        arcsin(a/r) outside."""
        distance = np.maximum(np.abs(np.asarray(r, dtype=float)), self.radius)
        approach = self.at_load(require.positive(load, "load (N)")).approach
        return np.asarray(2.0 / np.pi * approach * np.arcsin(self.radius / distance))


@dataclass(frozen=True)
class EllipticPunch(Theory):
    """Flat rigid punch with an elliptic end of the half-axes a >= b.

        p = P/(2 π a b sqrt(1 - x²/a² - y²/b²)),  δ = P K(e)/(π E* a).

    K is the complete elliptic integral of the eccentricity e; either half-axis may be the longer
    one.
    """

    E_star: Modulus
    half_axis_x: Annotated[Length, "half-axis of the end along x"]
    half_axis_y: Annotated[Length, "half-axis of the end along y"]
    name: ClassVar[str] = "elliptic-punch"
    title: ClassVar[str] = "Flat punch with an elliptic end"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(
            "approach over shorter half-axis of the punch",
            lambda theory, answer: answer.approach / min(theory.half_axis_x, theory.half_axis_y),
        ),
    )

    @property
    def stiffness(self) -> float:
        """dP/dδ = πE*a/K(e) in N/m."""
        from scipy.special import ellipkm1

        short, long = sorted((self.half_axis_x, self.half_axis_y))
        return math.pi * self.E_star * long / float(ellipkm1((short / long) ** 2))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        everywhere = np.ones_like(P)
        return ContactAnswer(
            load=P,
            approach=P / self.stiffness,
            radius=math.sqrt(self.half_axis_x * self.half_axis_y) * everywhere,
            area=math.pi * self.half_axis_x * self.half_axis_y * everywhere,
            max_pressure=np.where(P > 0.0, np.inf, 0.0),
            stiffness=self.stiffness * everywhere,
        )

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape."""
        return self.at_load(self.stiffness * checked(approach, "approach (m)"))

    def pressure(self, x: ArrayLike, y: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x``, ``y`` in m (broadcast) from the axis under ``load`` in N, > 0;
        infinite at the edge."""
        mean = require.positive(load, "load (N)") / (math.pi * self.half_axis_x * self.half_axis_y)
        place = (np.asarray(x) / self.half_axis_x) ** 2 + (np.asarray(y) / self.half_axis_y) ** 2
        with np.errstate(divide="ignore"):
            profile: RealArray = np.where(place > 1.0, 0.0, 0.5 * mean / np.sqrt(np.maximum(1.0 - place, 0.0)))
        return profile


@dataclass(frozen=True)
class SphericalIndenter(Theory):
    """Rigid sphere with its exact profile R - sqrt(R² - r²).

        δ = a artanh(a/R),  P = E* [(R² + a²) artanh(a/R) - a R].

    The body is still a half-space with small slopes, so this shows what the paraboloid of
    ``HertzPoint`` leaves out.
    """

    E_star: Modulus
    radius: Annotated[Length, "radius R of the sphere"]
    name: ClassVar[str] = "rigid-sphere"
    title: ClassVar[str] = "Sphere with its exact profile"
    citation_keys: ClassVar[tuple[str, ...]] = ("Sneddon1965",)
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("contact radius over radius of the sphere", CONTACT_RADIUS.value),
    )

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        t = bisected(lambda t: self._load(np.tanh(t)) - P, np.zeros_like(P), np.full_like(P, 18.0))
        return self.at_radius(self.radius * np.tanh(t))

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape."""
        delta = checked(approach, "approach (m)") / self.radius
        t = bisected(lambda t: t * np.tanh(t) - delta, np.zeros_like(delta), np.full_like(delta, 18.0))
        return self.at_radius(self.radius * np.tanh(t))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, 0 <= a < R, of any shape."""
        a = checked(contact_radius, "contact radius (m)")
        if np.any(a >= self.radius):
            raise InputError(
                f"contact radius must be less than that of the sphere, {self.radius:g} m, but is {float(a.max()):g} m."
            )
        from scipy.special import spence

        s = a / self.radius
        # ∫ artanh(x)/x dx over 0 < x < s: the Legendre chi function of order two, by its series
        # where the difference loses digits
        series = sum(s ** (2 * n + 1) / (2 * n + 1) ** 2 for n in range(9))
        chi = np.where(s < 0.1, series, 0.5 * (spence(1.0 - s) - spence(1.0 + s)))
        with np.errstate(invalid="ignore", divide="ignore"):
            # p at the axis: (E*/π) ∫ g'(x)/x dx, g = x artanh(x/R)
            mean_slope = np.where(s > 0.0, np.arctanh(s), 0.0) + chi
        return ContactAnswer(
            load=self._load(s),
            approach=a * np.arctanh(s),
            radius=a,
            area=np.pi * a**2,
            max_pressure=self.E_star / np.pi * mean_slope,
            stiffness=2.0 * self.E_star * a,
        )

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape) from the axis under ``load`` in
        N, > 0."""
        a = self.at_load(require.positive(load, "load (N)")).radius
        inside = np.minimum(np.abs(np.asarray(r, dtype=float)), a)
        # x² = r² + v² removes the root: p = (E*/π) ∫ g'(x)/x dv
        end = np.sqrt(a**2 - inside**2)
        v, weight = gauss(np.stack([0.0 * end, end], axis=-1), _NODES)
        x = np.hypot(inside[..., None], v)
        rise = np.arctanh(x / self.radius) / x + self.radius / (self.radius**2 - x**2)
        return np.asarray(self.E_star / np.pi * np.sum(weight * rise, axis=-1))

    def _load(self, s: RealArray) -> RealArray:
        """P of s = a/R; for small s the two terms cancel to (4/3) s³, so the series of artanh is
        used there."""
        exact = (1.0 + s**2) * np.arctanh(s) - s
        terms = [(1.0 / (2 * n + 1) + 1.0 / (2 * n - 1)) * s ** (2 * n + 1) for n in range(1, 9)]
        return self.E_star * self.radius**2 * np.where(s < 0.1, sum(terms), exact)


# Rigid symmetric indenters in plane strain: power laws (wedge, cylinder, …) and flat punch (Galin
# 1946; Johnson 1985, ch. 2).


@dataclass(frozen=True)
class LinePowerLawIndenter(Theory):
    """Profile f = B|x|ⁿ in plane strain; P per length.

        P = E* n B c a^n,  c = (sqrt(π)/2) Γ((n + 1)/2)/Γ(n/2 + 1).

    The wedge has n = 1 and slope B, the cylinder n = 2 and B = 1/2R. Approach and stiffness depend
    on how the body is held and are NaN.
    """

    E_star: Modulus
    coefficient: Annotated[float, Number("m^(1-n)", above=0.0), "B of the profile B |x|^n"]
    exponent: Exponent
    name: ClassVar[str] = "line-power-law-indenter"
    title: ClassVar[str] = "Power-law indenter in plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (_EDGE,)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    @property
    def load_factor(self) -> float:
        """c of P = E* n B c aⁿ."""
        n = self.exponent
        return 0.5 * math.sqrt(math.pi) * math.exp(math.lgamma(0.5 * n + 0.5) - math.lgamma(0.5 * n + 1.0))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape."""
        P = checked(load, "load per length (N/m)")
        stiff = self.E_star * self.exponent * self.coefficient * self.load_factor
        return self.at_half_width((P / stiff) ** (1.0 / self.exponent))

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, >= 0, of any shape."""
        a = checked(half_width, "half-width (m)")
        stiff = self.E_star * self.exponent * self.coefficient * self.load_factor
        load, unknown = stiff * a**self.exponent, np.full_like(a, np.nan)
        # the pressure of n <= 2 is largest in the middle, (n P/πa)/(n - 1)
        n = self.exponent
        with np.errstate(invalid="ignore", divide="ignore"):
            middle = (
                np.where(a > 0.0, n * load / (np.pi * a), 0.0) / (n - 1.0) if n > 1.0 else np.where(a > 0, np.inf, 0)
            )
        peak = middle if n <= 2.0 else unknown
        return ContactAnswer(load, unknown, a, 2.0 * a, np.asarray(peak, dtype=float), unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in
        N/m, > 0.

        (n P/πa) ∫ t^(n-1)/sqrt(t² - ξ²) dt over ξ = x/a < t < 1; infinite under the edge of a
        wedge.
        """
        answer = self.at_load(require.positive(load, "load per length (N/m)"))
        xi = np.abs(np.asarray(x, dtype=float)) / answer.radius
        scale = self.exponent * answer.load / (np.pi * answer.radius)
        values = scale * power_integral(np.where((xi > 0.0) & (xi < 1.0), xi, 1.0), self.exponent)
        return np.where(xi == 0.0, scale / (self.exponent - 1.0) if self.exponent > 1.0 else np.inf, values)


@dataclass(frozen=True)
class LineFlatPunch(Theory):
    """Flat rigid punch of the half-width a in plane strain; P per length.

    p = P/(π sqrt(a² - x²)).
    """

    E_star: Modulus
    half_width: Annotated[Length, "half the width of the punch a"]
    name: ClassVar[str] = "line-flat-punch"
    title: ClassVar[str] = "Flat punch in plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("mean pressure over contact modulus", lambda theory, answer: answer.mean_pressure / theory.E_star),
    )
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; approach and stiffness depend on
        the supports."""
        P = checked(load, "load per length (N/m)")
        ones, unknown = np.ones_like(P), np.full_like(P, np.nan)
        peak = np.where(P > 0.0, np.inf, 0.0)
        return ContactAnswer(P, unknown, self.half_width * ones, 2.0 * self.half_width * ones, peak, unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in
        N/m; infinite at the edge."""
        distance = np.abs(np.asarray(x, dtype=float))
        P = require.positive(load, "load per length (N/m)")
        root = np.sqrt(np.maximum(self.half_width**2 - distance**2, 0.0))
        with np.errstate(divide="ignore"):
            profile: RealArray = np.where(distance > self.half_width, 0.0, P / (np.pi * root))
        return profile


# Cone and wedge: the power-law indenters of exponent one by their slope (Sneddon 1965; Johnson
# 1985, secs. 5.1, 5.2).


@dataclass(frozen=True)
class Cone(Theory):
    """Cone against an elastic half-space, its flanks at the slope m to the surface.

        a = 2 δ/(π m),  P = (2/π) E* δ²/m.

    Examples
    --------
    >>> f"{Cone(1e9, 0.1).at_load(1e-3).approach:.4e}"
    '3.9633e-07'
    """

    E_star: Modulus
    slope: Slope
    name: ClassVar[str] = "cone"
    title: ClassVar[str] = "Cone"
    citation_keys: ClassVar[tuple[str, ...]] = PowerLawIndenter.citation_keys
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("slope of the profile at the edge", lambda theory, answer: theory.slope),
    )

    @property
    def indenter(self) -> PowerLawIndenter:
        """The same as a power law."""
        return PowerLawIndenter(self.E_star, self.slope, 1.0)

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at the ``approach`` δ in m, >= 0, of any shape."""
        return self.indenter.at_approach(approach)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        return self.indenter.at_load(load)


@dataclass(frozen=True)
class Wedge(Theory):
    """Wedge against an elastic half-space in plane strain, its flanks at the slope m to the
    surface; P per length.

    P = E* m a.
    """

    E_star: Modulus
    slope: Slope
    name: ClassVar[str] = "wedge"
    title: ClassVar[str] = "Wedge"
    citation_keys: ClassVar[tuple[str, ...]] = LinePowerLawIndenter.citation_keys
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("slope of the profile at the edge", lambda theory, answer: theory.slope),
    )
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    @property
    def indenter(self) -> LinePowerLawIndenter:
        """The same as a power law."""
        return LinePowerLawIndenter(self.E_star, self.slope, 1.0)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape."""
        return self.indenter.at_load(load)
