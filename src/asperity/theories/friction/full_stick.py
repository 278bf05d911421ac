"""Indentation without slip, round and in plane strain (Mossakovskii 1954, 1963; Spence 1968)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss, geometric
from ...core.quantity import Quantity
from ...core.values import Length, Number
from ..ask import LINE_LOAD, Way
from ..protocol import Bound, ContactAnswer, Modulus, Theory, checked, small_slope
from ..single.indenters import Exponent, LineFlatPunch, LinePowerLawIndenter, PowerLawIndenter

Beta = Annotated[
    float,
    Number(above=-1.0, below=1.0),
    "Dundurs' second parameter β, (1 - 2ν)/2(1 - ν) of a rigid indenter on a body of Poisson's ratio ν",
]

ProfileCoefficient: TypeAlias = Annotated[float, Number("m^(1-n)", above=0.0), "B of the profile B r^n"]

# A point of the surface is held from the moment at
# which it is touched; every increment is that of a sticking flat punch. κ = ln((1 + β)/(1 - β))/2π.


_REACH = 18.0  # of quadratures over hyperbolic angles, where exp(-2y) is rounding
_NODES = 96  # of the quadratures in y and t below, whose integrands fall off like exp(-2y): 1e-12 up to κ = 0.3


def oscillation(beta: float) -> float:
    """κ = ln((1 + β)/(1 - β))/2π of a bonded edge."""
    return math.atanh(beta) / math.pi


def sticking_gain(beta: float) -> float:
    """ln((1 + β)/(1 - β))/2β, stiffness of a round contact without slip over that without
    friction."""
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
        """Pressure in Pa at the distance ``r`` in m (any shape, less than a) from the axis under
        ``load`` in N, > 0.

        Inverse of ∫ rp/sqrt(r² - x²) dr = A cos κL over x < r < a with L = ln((a + x)/(a - x)), A =
        E*δ/2 sqrt(1 - β²).
        """
        a, kappa = self.radius, oscillation(self.beta)
        x, angle, scale = self._inverse(r, load)
        terms = np.cos(kappa * angle) + 2.0 * kappa * a * np.sin(kappa * angle) / x
        return np.asarray(np.sum(scale * terms, axis=-1))

    def traction(self, r: ArrayLike, load: float) -> RealArray:
        """Radial shear traction on the body in Pa, outwards, at ``r`` in m (any shape, between 0
        and a); as ``pressure``.

        Inverse of ∫ xq/sqrt(r² - x²) dr = A sin κL.
        """
        a, kappa = self.radius, oscillation(self.beta)
        x, angle, scale = self._inverse(r, load)
        terms = (a / x) ** 2 * np.sin(kappa * angle) / x - 2.0 * kappa * a * np.cos(kappa * angle) / x**2
        return np.asarray(np.abs(np.asarray(r, dtype=float)) * np.sum(scale * terms, axis=-1))

    def _inverse(self, r: ArrayLike, load: float) -> tuple[RealArray, RealArray, RealArray]:
        """x = sqrt(r² + (a² - r²) s²) at the nodes of s = tanh t, L there, and the weights times
        2A/π sqrt(a² - r²)."""
        a = self.radius
        distance = np.abs(np.asarray(r, dtype=float))
        if np.any(distance >= a):
            raise InputError(
                f"distance from the axis must be less than the radius of the punch, {a:g} m, but is "
                f"{float(distance.max()):g} m."
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
        """The contact under ``load`` in N/m, >= 0, of any shape; as without friction but for the
        tractions."""
        return LineFlatPunch(self.E_star, self.half_width).at_load(load)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape, inside the punch) from the middle under ``load``
        in N/m, > 0."""
        size, angle = self._polar(x, load)
        return size * np.cos(angle)

    def traction(self, x: ArrayLike, load: float) -> RealArray:
        """Shear traction on the body along +x in Pa at ``x`` in m (any shape) under ``load`` in
        N/m, > 0: outwards."""
        size, angle = self._polar(x, load)
        return size * np.sin(angle)

    def _polar(self, x: ArrayLike, load: float) -> tuple[RealArray, RealArray]:
        place, a = np.asarray(x, dtype=float), self.half_width
        if np.any(np.abs(place) >= a):
            raise InputError(
                f"place under the punch must be within its half-width, {a:g} m, but is "
                f"{float(np.abs(place).max()):g} m."
            )
        P = require.positive(load, "load per length (N/m)")
        angle = oscillation(self.beta) * np.log((a + place) / (a - place))
        return P / (np.pi * np.sqrt((1.0 - self.beta**2) * (a**2 - place**2))), angle


def _rooted(end: float) -> tuple[RealArray, RealArray]:
    """Nodes y and weights up to ``end``: y = u⁴ removes the root of tanh^(n-1) at zero; at large n
    all lies within 1 of y = ln(4n)/2, hence panels."""
    u, weight = gauss(np.linspace(0.0, end**0.25, 5), _NODES)
    return u**4, weight * 4.0 * u**3


@dataclass(frozen=True)
class StickingIndenter(Theory):
    """Profile f = B r^n without slip; beside the contact of the same radius without friction, δ_0
    and P_0:

        δ = δ_0/(n I),  P = C P_0/(n I),  C = ln((1 + β)/(1 - β))/(2 β),
        I = ∫_0^1 t^(n - 1) cos(κ ln((1 + t)/(1 - t))) dt,  κ = ln((1 + β)/(1 - β))/(2 π).

    n = 2 and B = 1/2R for a sphere.
    """

    E_star: Modulus
    coefficient: ProfileCoefficient
    exponent: Exponent
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
        y, weight = _rooted(_REACH)  # t = tanh y
        integral = np.sum(weight * np.tanh(y) ** (n - 1.0) / np.cosh(y) ** 2 * np.cos(2.0 * kappa * y))
        return 1.0 / (n * float(integral))

    @property
    def load_gain(self) -> float:
        """C/nI."""
        return sticking_gain(self.beta) * self.approach_gain

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape; the largest pressure has no closed
        form (NaN)."""
        free = PowerLawIndenter(self.E_star, self.coefficient, self.exponent)
        return self._with_stick(free.at_load(checked(load, "load (N)") / self.load_gain))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape; as ``at_load``."""
        free = PowerLawIndenter(self.E_star, self.coefficient, self.exponent)
        return self._with_stick(free.at_radius(contact_radius))

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape, less than a) from the axis under
        ``load`` in N, > 0.

        Punches of growing radius add up to -P'(x) = A x^(n-1) [cos 2κη + 2κ ∫ (coth^n y - 1) sin
        2κy dy] over y > η of P = ∫ rp/sqrt(r² - x²) dr, with tanh η = x/a. Infinite at the apex of
        a cone.
        """
        x, eta, rule = self._inverse(r, load)
        tail = self._tail(eta, np.sin)
        values = np.sum(rule * x ** (self.exponent - 1.0) * (np.cos(2.0 * self._kappa * eta) + tail), axis=-1)
        at_apex = (np.asarray(r) == 0.0) & (self.exponent == 1.0)
        return np.where(at_apex, np.inf, values)

    def traction(self, r: ArrayLike, load: float) -> RealArray:
        """Radial shear traction on the body in Pa, outwards, at ``r`` in m (any shape, between 0
        and a); as ``pressure``.

        From -(Q/x)' = A x^(n-2) [(coth^n η + (n - 1)) sin 2κη - (n - 1) 2κ ∫ (coth^n y - 1) cos 2κy
        dy]/n, with Q = x ∫ q/sqrt(r² - x²) dr.
        """
        x, eta, rule = self._inverse(r, load)
        n = self.exponent
        sine = (np.tanh(eta) ** -n + (n - 1.0)) * np.sin(2.0 * self._kappa * eta)
        terms = x ** (n - 2.0) * (sine - (n - 1.0) * self._tail(eta, np.cos)) / n
        return np.asarray(np.abs(np.asarray(r, dtype=float)) * np.sum(rule * terms, axis=-1))

    @property
    def _kappa(self) -> float:
        return oscillation(self.beta)

    def _tail(self, eta: RealArray, wave: Callable[[RealArray], RealArray]) -> RealArray:
        """2κ ∫ (coth^n y - 1) f(2κy) dy over y > ``eta`` of a sine or cosine f = ``wave``."""
        found = np.empty_like(eta)
        for place in np.ndindex(eta.shape[:-1]):  # one at a time stays in the cache
            y, weight = geometric(eta[place], eta[place] + _REACH)
            decay = np.expm1(-self.exponent * np.log(np.tanh(y)))
            found[place] = 2.0 * self._kappa * np.sum(weight * decay * wave(2.0 * self._kappa * y), axis=-1)
        return found

    def _inverse(self, r: ArrayLike, load: float) -> tuple[RealArray, RealArray, RealArray]:
        """x = sqrt(r² + (a² - r²) s²) at nodes of s = tanh t, artanh(x/a), and the rule of (2/π) A
        ∫ dx/sqrt(x² - r²)."""
        answer = self.at_load(require.positive(load, "load (N)"))
        a, distance = float(answer.radius), np.abs(np.asarray(r, dtype=float))
        if np.any(distance >= a):
            raise InputError(
                f"distance from the axis must be less than the radius of the contact, {a:g} m, but is "
                f"{float(distance.max()):g} m."
            )
        t, weight = geometric(np.asarray(0.0), np.asarray(_REACH))
        rest = 1.0 / np.cosh(t) ** 2  # 1 - s²
        width = np.sqrt(a**2 - distance**2)[..., None]
        x = np.sqrt(distance[..., None] ** 2 + (width * np.tanh(t)) ** 2)
        eta = np.log(a + x) - 0.5 * np.log(width**2 * rest)  # (a + x)/(a - x) = (a + x)²/(a² - x²)
        grown = self.exponent * float(answer.approach) / a**self.exponent
        amplitude = 0.5 * self.E_star * grown / math.sqrt(1.0 - self.beta**2)
        return x, eta, 2.0 / np.pi * amplitude * weight * rest * width / x

    def _with_stick(self, free: ContactAnswer) -> ContactAnswer:
        return ContactAnswer(
            load=free.load * self.load_gain,
            approach=free.approach * self.approach_gain,
            radius=free.radius,
            area=free.area,
            max_pressure=np.full_like(free.load, np.nan),
            stiffness=free.stiffness * sticking_gain(self.beta),
        )


@dataclass(frozen=True)
class StickingIndenterLine(Theory):
    """Profile f = B |x|^n in plane strain without slip; the contact of half-width a carries P = P_0
    I_0/I_κ.

        I_κ = ∫_0^1 t^(n - 1) cos(κ ln((1 + t)/(1 - t)))/sqrt(1 - t²) dt,
        κ = ln((1 + β)/(1 - β))/(2 π).

    P_0 is the load without friction. A wedge (n = 1) carries P_0 cosh(πκ).

    Examples
    --------
    >>> wedge = StickingIndenterLine(E_star=1e9, coefficient=0.1, exponent=1.0, beta=2 / 7)
    >>> print(f"{wedge.load_gain:.6f}")
    1.043498
    """

    E_star: Modulus
    coefficient: Annotated[float, Number("m^(1-n)", above=0.0), "B of the profile B |x|^n"]
    exponent: Exponent
    beta: Beta
    name: ClassVar[str] = "sticking-indenter-line"
    title: ClassVar[str] = "Power-law indenter without slip, plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Spence1968")
    limits: ClassVar[tuple[Bound, ...]] = LinePowerLawIndenter.limits
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("load_gain", "1", "load over that without friction at the same half-width"),
    )

    @property
    def load_gain(self) -> float:
        """P/P_0 at the same half-width."""
        n, kappa = self.exponent, oscillation(self.beta)
        y, weight = _rooted(2.0 * _REACH)
        density = weight * np.tanh(y) ** (n - 1.0) / np.cosh(y)
        return float(np.sum(density) / np.sum(density * np.cos(2.0 * kappa * y)))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; the largest pressure has no closed
        form (NaN)."""
        free = LinePowerLawIndenter(self.E_star, self.coefficient, self.exponent)
        return self.at_half_width(free.at_load(checked(load, "load per length (N/m)") / self.load_gain).radius)

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, >= 0, of any shape; as ``at_load``."""
        free = LinePowerLawIndenter(self.E_star, self.coefficient, self.exponent).at_half_width(half_width)
        unknown = np.full_like(free.load, np.nan)
        return ContactAnswer(free.load * self.load_gain, unknown, free.radius, free.area, unknown, unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape, inside the contact) from the middle under
        ``load`` in N/m, > 0.

        Punches of growing width: p + iq = (nP cosh πκ/πa) ∫ (ξ coth y)^(n-1) csch y exp(2iκy) dy
        over tanh y > ξ = |x|/a.
        """
        return self._superposed(x, load, np.cos)

    def traction(self, x: ArrayLike, load: float) -> RealArray:
        """Shear traction on the body along +x in Pa at ``x`` in m (any shape), outwards; as
        ``pressure``."""
        return np.asarray(np.sign(np.asarray(x, dtype=float)) * self._superposed(x, load, np.sin))

    def _superposed(self, x: ArrayLike, load: float, wave: Callable[[RealArray], RealArray]) -> RealArray:
        n, kappa = self.exponent, oscillation(self.beta)
        P = require.positive(load, "load per length (N/m)")
        a = float(self.at_load(P).radius)
        xi = np.abs(np.asarray(x, dtype=float)) / a
        if np.any(xi >= 1.0):
            raise InputError(f"place must be within the contact, {a:g} m wide, but is {float(xi.max() * a):g} m.")
        inside = np.maximum(xi, 1e-7)
        eta = np.arctanh(inside)
        y, weight = geometric(eta, eta + 2.0 * _REACH)
        kernel = (inside[..., None] / np.tanh(y)) ** (n - 1.0) / np.sinh(y) * wave(2.0 * kappa * y)
        scale = n * P / (np.pi * a * math.sqrt(1.0 - self.beta**2))
        middle = 0.0 if wave is np.sin else 1.0 / (n - 1.0) if n > 1.0 else np.inf
        return np.where(xi == 0.0, scale * middle, scale * np.sum(weight * kernel, axis=-1))
