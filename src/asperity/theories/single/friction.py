"""Contacts of dissimilar bodies with friction: a cylinder and a punch that slide, and indenters that stick."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Length, Number
from ..ask import LINE_LOAD, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, checked, small_slope
from .indenters import LineFlatPunch, PowerLawIndenter

Beta = Annotated[
    float,
    Number(above=-1.0, below=1.0),
    "Dundurs' second parameter β, (1 - 2ν)/2(1 - ν) of a rigid indenter on a body of Poisson's ratio ν",
]
Coefficient = Annotated[float, Number(least=0.0), "friction coefficient μ"]

# Sliding in plane strain (Galin 1961; Johnson 1985, secs. 2.8 and 7.1). With the traction μp along +x on the body
# ∫ p(s)/(x - s) ds + π tan(πγ) p = (πE*/2) f'(x), tan πγ = -βμ: the surface rises behind the contact, which moves there.


def shift_exponent(beta: float, friction: float) -> float:
    """γ of tan πγ = -βμ, in -1/2 < γ < 1/2; negative where the contact moves against the direction of sliding."""
    return -math.atan(beta * friction) / math.pi


@dataclass(frozen=True)
class SlidingCylinder(Theory):
    """Cylinder that slides along +x with friction.

        p = (E* cos(π γ)/(2 R)) (a + x)^(1/2 + γ) (a - x)^(1/2 - γ),  tan(π γ) = -β μ,
        P = π E* a² (1 - 4 γ²)/(4 R).

    x counts from the middle of the contact, which lies at 2γa from the axis of the cylinder. The traction on the body is μp
    along +x, the direction in which the cylinder moves.

    Examples
    --------
    A rigid cylinder on a body of ν = 0.3 (β = 2/7) at μ = 0.5 touches 0.4 % more than without friction:

    >>> slides = SlidingCylinder(E_star=1e9, radius=1e-2, beta=2 / 7, friction=0.5)
    >>> stands = SlidingCylinder(E_star=1e9, radius=1e-2, beta=2 / 7, friction=0.0)
    >>> print(f"{float(slides.at_load(1e3).radius / stands.at_load(1e3).radius):.4f}, {slides.shift:.4f}")
    1.0041, -0.0903
    """

    E_star: Modulus
    radius: Radius
    beta: Beta
    friction: Coefficient
    name: ClassVar[str] = "sliding-cylinder"
    title: ClassVar[str] = "Cylinder sliding with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("shift", "1", "place of the middle of the contact over its half-width"),
    )

    @property
    def exponent(self) -> float:
        """γ."""
        return shift_exponent(self.beta, self.friction)

    @property
    def shift(self) -> float:
        """Place of the middle of the contact along +x from the axis of the cylinder over the half-width, 2γ."""
        return 2.0 * self.exponent

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; approach and stiffness depend on the supports (NaN)."""
        P, gamma = checked(load, "load per length (N/m)"), self.exponent
        a = np.sqrt(4.0 * P * self.radius / (np.pi * self.E_star * (1.0 - 4.0 * gamma**2)))
        peak = self._scale * a * (1.0 + 2.0 * gamma) ** (0.5 + gamma) * (1.0 - 2.0 * gamma) ** (0.5 - gamma)
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(P, unknown, a, 2.0 * a, peak, unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from the axis of the cylinder under ``load`` in N/m, > 0."""
        a, gamma = float(self.at_load(require.positive(load, "load per length (N/m)")).radius), self.exponent
        place = np.asarray(x, dtype=float) - 2.0 * gamma * a
        front, back = np.maximum(a - place, 0.0), np.maximum(a + place, 0.0)
        return self._scale * back ** (0.5 + gamma) * front ** (0.5 - gamma)

    @property
    def _scale(self) -> float:
        return self.E_star * math.cos(math.pi * self.exponent) / (2.0 * self.radius)


@dataclass(frozen=True)
class SlidingPunch(Theory):
    """Flat rigid punch that slides along +x without tilting, in plane strain with P per length.

        p = (P cos(π γ)/π) (a + x)^(γ - 1/2) (a - x)^(-γ - 1/2),  tan(π γ) = -β μ.

    The traction on the body is μp along +x.
    """

    E_star: Modulus
    half_width: Annotated[Length, "half the width of the punch a"]
    beta: Beta
    friction: Coefficient
    name: ClassVar[str] = "sliding-punch"
    title: ClassVar[str] = "Flat punch sliding with friction, plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = LineFlatPunch.limits
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("centre", "1", "place of the resultant pressure over the half-width"),
    )

    @property
    def centre(self) -> float:
        """Place of the resultant of the pressure along +x over the half-width, 2γ: where the force must act."""
        return 2.0 * shift_exponent(self.beta, self.friction)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; as without friction but for the pressure."""
        return LineFlatPunch(self.E_star, self.half_width).at_load(load)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from the middle under ``load`` in N/m, > 0; infinite at the edges."""
        P, gamma = require.positive(load, "load per length (N/m)"), shift_exponent(self.beta, self.friction)
        place, a = np.asarray(x, dtype=float), self.half_width
        outside = np.abs(place) > a
        front, back = np.where(outside, 1.0, a - place), np.where(outside, 1.0, a + place)
        with np.errstate(divide="ignore"):
            shape = back ** (gamma - 0.5) * front ** (-gamma - 0.5)
        return np.where(outside, 0.0, P * math.cos(math.pi * gamma) / math.pi * shape)


# Indentation without slip (Mossakovskii 1954, 1963; Spence 1968). A point of the surface is held from the moment at
# which it is touched; every increment is that of a sticking flat punch. κ = ln((1 + β)/(1 - β))/2π.


_NODES = 96  # of the quadratures in y and t below, whose integrands fall off like exp(-2y): 1e-12 up to κ = 0.3


def oscillation(beta: float) -> float:
    """κ = ln((1 + β)/(1 - β))/2π of a bonded edge."""
    return math.atanh(beta) / math.pi


def sticking_gain(beta: float) -> float:
    """ln((1 + β)/(1 - β))/2β, stiffness of a round contact without slip over that without friction."""
    return math.atanh(beta) / beta if beta else 1.0


@dataclass(frozen=True)
class StickingPunch(Theory):
    """Flat round punch without slip.

        P = (E* a δ/β) ln((1 + β)/(1 - β)).

    A rigid punch has P = 4Gaδ ln(3 - 4ν)/(1 - 2ν).
    """

    E_star: Modulus
    radius: Annotated[Length, "radius a of the end"]
    beta: Beta
    name: ClassVar[str] = "sticking-punch"
    title: ClassVar[str] = "Flat punch without slip"
    citation_keys: ClassVar[tuple[str, ...]] = ("Mossakovskii1963", "Spence1968")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("approach over radius of the punch", lambda theory, answer: answer.approach / theory.radius),
    )
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("gain", "1", "load over that without friction"),)

    @property
    def gain(self) -> float:
        """Load over that of the punch without friction at the same approach."""
        return sticking_gain(self.beta)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        everywhere = np.ones_like(P)
        stiffness = 2.0 * self.E_star * self.radius * self.gain
        return ContactAnswer(
            load=P,
            approach=P / stiffness,
            radius=self.radius * everywhere,
            area=np.pi * self.radius**2 * everywhere,
            max_pressure=np.where(P > 0.0, np.inf, 0.0),
            stiffness=stiffness * everywhere,
        )

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape, less than a) from the axis under ``load`` in N, > 0.

        Inverse of ∫ rp/sqrt(r² - x²) dr = A cos κL over x < r < a with L = ln((a + x)/(a - x)), A = E*δ/2 sqrt(1 - β²).
        """
        a, kappa = self.radius, oscillation(self.beta)
        x, angle, scale = self._inverse(r, load)
        terms = np.cos(kappa * angle) + 2.0 * kappa * a * np.sin(kappa * angle) / x
        return np.asarray(np.sum(scale * terms, axis=-1))

    def traction(self, r: ArrayLike, load: float) -> RealArray:
        """Radial shear traction on the body in Pa, outwards, at ``r`` in m (any shape, between 0 and a); as ``pressure``.

        Inverse of ∫ xq/sqrt(r² - x²) dr = A sin κL.
        """
        a, kappa = self.radius, oscillation(self.beta)
        x, angle, scale = self._inverse(r, load)
        terms = (a / x) ** 2 * np.sin(kappa * angle) / x - 2.0 * kappa * a * np.cos(kappa * angle) / x**2
        return np.asarray(np.abs(np.asarray(r, dtype=float)) * np.sum(scale * terms, axis=-1))

    def _inverse(self, r: ArrayLike, load: float) -> tuple[RealArray, RealArray, RealArray]:
        """x = sqrt(r² + (a² - r²) s²) at the nodes of s = tanh t, L there, and the weights times 2A/π sqrt(a² - r²)."""
        a = self.radius
        distance = np.abs(np.asarray(r, dtype=float))
        if np.any(distance >= a):
            raise InputError(
                f"distance from the axis must be less than the radius of the punch, {a:g} m, but is {float(distance.max()):g} m."
            )
        approach = float(self.at_load(require.positive(load, "load (N)")).approach)
        t, weight = gauss(np.array([0.0, 18.0]), _NODES)
        rest = 1.0 / np.cosh(t) ** 2  # 1 - s²
        width = np.sqrt(a**2 - distance**2)[..., None]
        x = np.sqrt(distance[..., None] ** 2 + (width * np.tanh(t)) ** 2)
        angle = 2.0 * np.log(a + x) - np.log(width**2 * rest)  # (a + x)/(a - x) = (a + x)²/(a² - x²)
        amplitude = 0.5 * self.E_star * approach / math.sqrt(1.0 - self.beta**2)
        return x, angle, 2.0 * amplitude / (np.pi * width) * weight * rest


@dataclass(frozen=True)
class StickingPunchLine(Theory):
    """Flat punch without slip in plane strain.

    p = P cos(κ L)/(π sqrt((1 - β²)(a² - x²))),  q = P sin(κ L)/(π sqrt((1 - β²)(a² - x²))),
    L = ln((a + x)/(a - x)),  κ = ln((1 + β)/(1 - β))/(2 π).
    """

    E_star: Modulus
    half_width: Annotated[Length, "half the width of the punch a"]
    beta: Beta
    name: ClassVar[str] = "sticking-punch-line"
    title: ClassVar[str] = "Flat punch without slip, plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Spence1968")
    limits: ClassVar[tuple[Bound, ...]] = LineFlatPunch.limits
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; as without friction but for the tractions."""
        return LineFlatPunch(self.E_star, self.half_width).at_load(load)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape, inside the punch) from the middle under ``load`` in N/m, > 0."""
        size, angle = self._polar(x, load)
        return size * np.cos(angle)

    def traction(self, x: ArrayLike, load: float) -> RealArray:
        """Shear traction on the body along +x in Pa at ``x`` in m (any shape) under ``load`` in N/m, > 0: outwards."""
        size, angle = self._polar(x, load)
        return size * np.sin(angle)

    def _polar(self, x: ArrayLike, load: float) -> tuple[RealArray, RealArray]:
        place, a = np.asarray(x, dtype=float), self.half_width
        if np.any(np.abs(place) >= a):
            raise InputError(
                f"place under the punch must be within its half-width, {a:g} m, but is {float(np.abs(place).max()):g} m."
            )
        P = require.positive(load, "load per length (N/m)")
        angle = oscillation(self.beta) * np.log((a + place) / (a - place))
        return P / (np.pi * np.sqrt((1.0 - self.beta**2) * (a**2 - place**2))), angle


@dataclass(frozen=True)
class StickingIndenter(Theory):
    """Profile f = B r^n without slip; beside the contact of the same radius without friction, δ_0 and P_0:

        δ = δ_0/(n I),  P = C P_0/(n I),  C = ln((1 + β)/(1 - β))/(2 β),
        I = ∫_0^1 t^(n - 1) cos(κ ln((1 + t)/(1 - t))) dt,  κ = ln((1 + β)/(1 - β))/(2 π).

    n = 2 and B = 1/2R for a sphere.
    """

    E_star: Modulus
    coefficient: Annotated[float, Number("m^(1-n)", above=0.0), "B of the profile B r^n"]
    exponent: Annotated[float, Number(least=1.0, fix="Concave tips have no closed form."), "n of the profile"]
    beta: Beta
    name: ClassVar[str] = "sticking-indenter"
    title: ClassVar[str] = "Power-law indenter without slip"
    citation_keys: ClassVar[tuple[str, ...]] = ("Mossakovskii1963", "Spence1968")
    limits: ClassVar[tuple[Bound, ...]] = PowerLawIndenter.limits
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("approach_gain", "1", "approach over that without friction at the same contact radius"),
        Quantity("load_gain", "1", "load over that without friction at the same contact radius"),
    )

    @property
    def approach_gain(self) -> float:
        """1/nI, which is 1 without friction."""
        n, kappa = self.exponent, oscillation(self.beta)
        u, weight = gauss(
            np.array([0.0, 18.0**0.25]), _NODES
        )  # t = tanh y, y = u⁴ removes the root of tanh^(n-1) at zero
        y = u**4
        integral = np.sum(weight * 4.0 * u**3 * np.tanh(y) ** (n - 1.0) / np.cosh(y) ** 2 * np.cos(2.0 * kappa * y))
        return 1.0 / (n * float(integral))

    @property
    def load_gain(self) -> float:
        """C/nI."""
        return sticking_gain(self.beta) * self.approach_gain

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape; the largest pressure has no closed form (NaN)."""
        return self._with_stick(self._free.at_load(checked(load, "load (N)") / self.load_gain))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape; as ``at_load``."""
        return self._with_stick(self._free.at_radius(contact_radius))

    @property
    def _free(self) -> PowerLawIndenter:
        return PowerLawIndenter(self.E_star, self.coefficient, self.exponent)

    def _with_stick(self, free: ContactAnswer) -> ContactAnswer:
        return ContactAnswer(
            load=free.load * self.load_gain,
            approach=free.approach * self.approach_gain,
            radius=free.radius,
            area=free.area,
            max_pressure=np.full_like(free.load, np.nan),
            stiffness=free.stiffness * sticking_gain(self.beta),
        )
