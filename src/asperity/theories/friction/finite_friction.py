"""Pressing unlike bodies together with friction: a disc that sticks and an annulus that slips
inwards (Spence 1973, 1975).

By similarity the stick zone is the same part c/a of the contact for the flat punch and for every
profile B rⁿ, and depends on the friction coefficient μ and Dundurs' β only. The flat punch of
radius 1 and displacement 1 is solved for the Abel transforms P = ∫ rp/sqrt(r² - x²) dr and Q = x ∫
q/sqrt(r² - x²) dr, over E*/2:

    P(x) - (2β/π) ∫ Q(t) t/(t² - x²) dt = 1                 (0 < x < 1),
    Q(x) + (2β/π) ∫ P(t) x/(t² - x²) dt = 0                 (0 < x < c, no radial motion),
    Q(x) = μ [P(x) - (2x/π) ∫ P(t) (K - E)/(k²t²) dt]       (c < x < 1, q = μp), k² = 1 - x²/t²,

and Q is continuous at c, or q would be infinite there. Panels are graded geometrically toward c
from both sides and toward 1; with polynomials of 16 nodes all ratios are within 1e-10 of those of
finer meshes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import rule
from ...core.quantity import Quantity
from ...core.values import Length
from ..protocol import Bound, ContactAnswer, Modulus, Theory, checked
from ..single.indenters import Exponent, FlatPunch, PowerLawIndenter
from .full_stick import Beta, ProfileCoefficient, StickingIndenter, StickingPunch
from .partial_slip import Friction
from .torsion import elliptic_ratio

_NODES = 16  # of a panel
_RATIO = 0.2  # of neighbouring panels
_LEVELS = 11  # 0.2^11 = 2e-8 of the nearest length
_NEAR = 1.05  # half-lengths of a panel from its middle within which recursions of Q_n are stable
_FINE = 64  # Gauss nodes that resolve 1/(t - x) beyond
_SMALLEST = 1e-6  # stick zone or annulus that is not told from none


class _Mesh:
    """Panels on (0, 1); places are kept as distances from c or 1, where they would lose their
    digits otherwise."""

    def __init__(self, share: float) -> None:
        c, half = share, 0.5 * (1.0 - share)
        levels = _LEVELS + math.ceil(math.log(min(c, half) / half) / math.log(_RATIO)) if c else _LEVELS
        grades = np.append(0.0, _RATIO ** np.arange(levels, -1.0, -1.0))
        inner = np.append(0.0, _RATIO ** np.arange(_LEVELS, -1.0, -1.0)) if c else np.zeros(1)
        lows = [(-c * inner[1:])[::-1], half * grades[:-1], (-half * grades[1:])[::-1]]
        highs = [(-c * inner[:-1])[::-1], half * grades[1:], (-half * grades[:-1])[::-1]]
        low, high = np.concatenate(lows), np.concatenate(highs)
        self.sticking = (inner.size - 1) * _NODES
        self.anchor = np.repeat([c, c, 1.0], [part.size for part in lows])
        self.middle, self.half = 0.5 * (low + high), 0.5 * (high - low)
        self.local, self.rule = rule(_NODES)
        self.offset = self.middle[:, None] + self.half[:, None] * self.local
        self.x: RealArray = (self.anchor[:, None] + self.offset).ravel()
        self.weight: RealArray = (self.half[:, None] * self.rule).ravel()
        # Legendre coefficients from values at the nodes
        orders = np.arange(_NODES) + 0.5
        self.coefficients = orders[:, None] * (legendre.legvander(self.local, _NODES - 1) * self.rule[:, None]).T

    def values_at(self, z: RealArray) -> RealArray:
        """Lagrange polynomials of a panel at local places ``z``, (z, nodes)."""
        return np.asarray(legendre.legvander(z, _NODES - 1) @ self.coefficients)

    def cauchy(self, sign: float) -> RealArray:
        """∫ l_j(t)/(t - ``sign`` x_i) dt, principal values, (i, j)."""
        anchor = np.repeat(self.anchor, _NODES)
        z = (sign * anchor[:, None] - self.anchor) + (sign * self.offset.ravel()[:, None] - self.middle)
        z /= self.half
        if sign > 0.0:
            own = np.arange(self.x.size)
            z[own, own // _NODES] = np.tile(self.local, self.half.size)
        found = np.empty((*z.shape, _NODES))
        near, far = np.abs(z) < _NEAR, np.abs(z) > 8.0
        between = ~(near | far)
        at = z[near]
        second = np.empty((_NODES, at.size))  # Legendre functions Q_n of the second kind
        second[0] = 0.5 * np.log(np.abs((1.0 + at) / (1.0 - at)))
        second[1] = at * second[0] - 1.0
        for n in range(1, _NODES - 1):
            second[n + 1] = ((2 * n + 1) * at * second[n] - n * second[n - 1]) / (n + 1)
        found[near] = -2.0 * second.T @ self.coefficients
        found[far] = self.rule / (self.local - z[far][:, None])
        fine, weight = rule(_FINE)
        found[between] = (weight / (fine - z[between][:, None])) @ self.values_at(fine)
        return found.reshape(self.x.size, -1)

    def slip(self) -> RealArray:
        """Q/μ from P where it slips."""
        x, weight = self.x[self.sticking :], self.weight[self.sticking :]
        panel = np.arange(x.size) // _NODES
        later = panel[None, :] > panel[:, None]
        matrix = np.zeros(later.shape)
        row, column = np.nonzero(later)
        # the kernel is (K - E)/(k²t²)
        matrix[row, column] = elliptic_ratio((x[row] / x[column]) ** 2) / x[column] ** 2 * weight[column]
        middle, half = (part[self.sticking // _NODES :] for part in (self.anchor + self.middle, self.half))
        for a, start in enumerate(self.local):  # the own panel from the place on
            z, rule = start + 0.5 * (1.0 - start) * (self.local + 1.0), 0.5 * (1.0 - start) * self.rule
            t = middle[:, None] + half[:, None] * z
            rows = np.arange(half.size) * _NODES + a
            kernel = elliptic_ratio((x[rows][:, None] / t) ** 2) / t**2
            own = (kernel * rule * half[:, None]) @ self.values_at(z)
            for b in range(_NODES):
                matrix[rows, rows - a + b] += own[:, b]
        return np.eye(x.size) - 2.0 / np.pi * x[:, None] * matrix


class _Punch:
    """Equations of the flat punch for one ``share`` c/a of stick."""

    def __init__(self, beta: float, share: float) -> None:
        self.beta, self.mesh = beta, _Mesh(share)
        plus, minus = self.mesh.cauchy(1.0), self.mesh.cauchy(-1.0)
        n, scale = self.mesh.sticking, beta / np.pi
        to_normal = scale * (plus + minus)  # of Q
        self.stick, self.slip = -scale * (plus - minus)[:n], self.mesh.slip()
        self.held = np.eye(self.mesh.x.size) - to_normal[:, :n] @ self.stick
        self.slipping = np.concatenate([np.zeros_like(to_normal[:, :n]), -to_normal[:, n:] @ self.slip], axis=1)

    def solved(self, friction: float) -> tuple[RealArray, RealArray]:
        """P and Q at the nodes."""
        P = np.linalg.solve(self.held + friction * self.slipping, np.ones(self.mesh.x.size))
        return P, np.concatenate([self.stick @ P, friction * (self.slip @ P[self.mesh.sticking :])])

    def jump(self, friction: float) -> float:
        """Q below c less that above."""
        _, Q = self.solved(friction)
        ends, n = self.mesh.values_at(np.array([-1.0, 1.0])), self.mesh.sticking
        return float(ends[1] @ Q[n - _NODES : n] - ends[0] @ Q[n : n + _NODES])


def friction_of_stick(beta: float, share: float) -> float:
    """Friction coefficient μ that leaves the ``share`` c/a of a round contact sticking, 1e-6 <=
    c/a <= 1 - 1e-6.

    Examples
    --------
    >>> print(f"{friction_of_stick(beta=2 / 7, share=0.5):.6f}")
    0.152482
    """
    at = require.finite(share, "stick radius over contact radius")
    if not _SMALLEST <= at <= 1.0 - _SMALLEST:
        raise InputError(f"stick radius over contact radius must be from 1e-6 to 1 - 1e-6, but is {share:g}.")
    coupling = abs(_coupling(beta))
    if coupling == 0.0:
        return 0.0
    punch, guess = _Punch(coupling, at), goodman_friction(beta, at)
    high = 1.5 * guess
    while punch.jump(high) > 0.0:
        high *= 2.0
        if high > 1e3 * guess:
            raise InputError(
                f"stick radius over contact radius must be less for β = {beta:g}, but is {share:g}: no "
                "friction holds so much."
            )
    return _root(punch.jump, 0.5 * guess, high)


def stick_share(beta: float, friction: float) -> float:
    """Share c/a of a round contact that sticks; 0 or 1 where stick zone or annulus are less than
    1e-6 of the contact."""
    coupling, mu = abs(_coupling(beta)), require.positive(friction, "friction coefficient")
    # μ of the round contact is 0.63 to 1.3 times that of Goodman's line
    low, high = (goodman_share(beta, factor * mu) for factor in (0.4, 2.2))

    if coupling == 0.0 or low > 1.0 - _SMALLEST:
        return 1.0
    if high < _SMALLEST:
        return 0.0
    low, high = max(low, _SMALLEST), min(high, 1.0 - _SMALLEST)

    def jump(logit: float) -> float:  # rises through zero
        return _Punch(coupling, 1.0 / (1.0 + math.exp(-logit))).jump(mu)

    ends = [math.log(share / (1.0 - share)) for share in (low, high)]
    if jump(ends[0]) > 0.0:
        return 0.0
    return 1.0 if jump(ends[1]) < 0.0 else 1.0 / (1.0 + math.exp(-_root(jump, *ends)))


def _coupling(beta: float) -> float:
    if not -1.0 < require.finite(beta, "Dundurs' second parameter") < 1.0:
        raise InputError(f"Dundurs' second parameter must be between -1 and 1, but is {beta:g}.")
    return beta


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=1e-12 * min(abs(high), 1.0), rtol=1e-13))


# Goodman's simplification, in plane strain: the shear does not change the pressure.


def goodman_friction(beta: float, share: float) -> float:
    """μ = |β| K(c/a)/K(sqrt(1 - c²/a²)) that leaves the ``share`` c/a of a line contact sticking,
    between 0 and 1."""
    from scipy.special import ellipk, ellipkm1

    at = require.finite(share, "stick zone over contact")
    if not 0.0 < at < 1.0:
        raise InputError(f"stick zone over contact must be between 0 and 1, both excluded, but is {share:g}.")
    return abs(_coupling(beta)) * float(ellipkm1((1.0 - at) * (1.0 + at)) / ellipkm1(at**2)) if at else float(ellipk(0))


def goodman_share(beta: float, friction: float) -> float:
    """c/a of ``goodman_friction``, by the theta functions of the nome exp(-π|β|/μ)."""
    ratio = require.positive(friction, "friction coefficient") / max(abs(_coupling(beta)), np.finfo(float).tiny)
    nome = math.exp(-math.pi * max(ratio, 1.0 / ratio))  # at most exp(-π)
    orders = np.arange(8)
    second = 2.0 * nome**0.25 * float(np.sum(nome ** (orders * (orders + 1.0))))
    third = 1.0 + 2.0 * float(np.sum(nome ** (orders[1:] ** 2.0)))
    modulus = (second / third) ** 2
    return modulus if ratio <= 1.0 else math.sqrt((1.0 - modulus) * (1.0 + modulus))


_STICK = Quantity("stick_share", "1", "stick radius (half-width) over that of the contact")


@dataclass(frozen=True)
class GoodmanLine(Theory):
    """Stick zone of any power-law profile or flat punch that is pressed with friction, in plane
    strain.

        μ/β = K(c/a)/K(sqrt(1 - c²/a²)).

    K is the complete elliptic integral of the modulus. The effect of the shear on the pressure is
    left out. Round contacts need up to a third less friction, see ``FrictionalIndenter``.
    """

    beta: Beta
    friction: Friction
    name: ClassVar[str] = "goodman-line"
    title: ClassVar[str] = "Goodman, indentation with friction in plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Goodman1962", "Spence1973")
    numbers: ClassVar[tuple[Quantity, ...]] = (_STICK,)

    @property
    def stick_share(self) -> float:
        """c/a."""
        return goodman_share(self.beta, self.friction)


@dataclass(frozen=True)
class FrictionalPunch(Theory):
    """Flat round punch with friction, which sticks within the radius c and slips outside.

        P = 2 C E* a δ.

    C is between 1, without friction, and that of ``StickingPunch``; see ``FrictionalIndenter``.
    """

    E_star: Modulus
    radius: Annotated[Length, "radius a of the end"]
    beta: Beta
    friction: Friction
    name: ClassVar[str] = "frictional-punch"
    title: ClassVar[str] = "Flat punch with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Spence1973", "Spence1975")
    limits: ClassVar[tuple[Bound, ...]] = FlatPunch.limits
    numbers: ClassVar[tuple[Quantity, ...]] = (_STICK, Quantity("gain", "1", "load over that without friction"))

    @cached_property
    def stick_share(self) -> float:
        """c/a."""
        return stick_share(self.beta, self.friction)

    @cached_property
    def gain(self) -> float:
        """C."""
        return _gains(self.beta, self.friction, self.stick_share, 1.0)[0]

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        P = checked(load, "load (N)")
        return FlatPunch(self.E_star * self.gain, self.radius).at_load(P)


@dataclass(frozen=True)
class FrictionalIndenter(Theory):
    """Profile f = B r^n pressed with friction; it sticks within the radius c and slips inwards
    outside.

        δ = D δ_0,  P = C D P_0,

    beside the contact of the same radius without friction, δ_0 and P_0. C is the gain of the flat
    punch, and D and c/a depend on β, μ and, D, on n. For steadily growing load; unloading takes
    another path.

    Examples
    --------
    A rigid sphere on a body of ν = 0.3 at μ = 0.2:

    >>> ball = FrictionalIndenter(
    ...     E_star=1e9, coefficient=50.0, exponent=2.0, beta=2 / 7, friction=0.2
    ... )
    >>> print(f"{ball.stick_share:.4f}, {ball.load_gain:.5f}")
    0.6983, 1.03444
    """

    E_star: Modulus
    coefficient: ProfileCoefficient
    exponent: Exponent
    beta: Beta
    friction: Friction
    name: ClassVar[str] = "frictional-indenter"
    title: ClassVar[str] = "Spence, power-law indenter with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Spence1973", "Spence1975")
    limits: ClassVar[tuple[Bound, ...]] = PowerLawIndenter.limits
    numbers: ClassVar[tuple[Quantity, ...]] = (
        _STICK,
        Quantity("approach_gain", "1", "approach over that without friction at the same contact radius"),
        Quantity("load_gain", "1", "load over that without friction at the same contact radius"),
    )

    @cached_property
    def stick_share(self) -> float:
        """c/a."""
        return stick_share(self.beta, self.friction)

    @cached_property
    def _both(self) -> tuple[float, float]:
        return _gains(self.beta, self.friction, self.stick_share, self.exponent)

    @property
    def approach_gain(self) -> float:
        """D."""
        return self._both[1]

    @property
    def load_gain(self) -> float:
        """C D."""
        return self._both[0] * self._both[1]

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape; the largest pressure has no closed
        form (NaN)."""
        free = PowerLawIndenter(self.E_star, self.coefficient, self.exponent)
        return self.at_radius(free.at_load(checked(load, "load (N)") / self.load_gain).radius)

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape; as ``at_load``."""
        free = PowerLawIndenter(self.E_star, self.coefficient, self.exponent).at_radius(contact_radius)
        return ContactAnswer(
            load=free.load * self.load_gain,
            approach=free.approach * self.approach_gain,
            radius=free.radius,
            area=free.area,
            max_pressure=np.full_like(free.load, np.nan),
            stiffness=free.stiffness * self._both[0],
        )


def _gains(beta: float, friction: float, share: float, exponent: float) -> tuple[float, float]:
    """Load of the flat punch, and approach of B rⁿ at the same radius, over those without friction.

    Each increment moves the surface outside of its contact by w(x) = (2β/π) ∫ Q t/(x² - t²) dt in
    terms of Abel transforms, so that 1/D = 1 - n ∫ s^(n-1) w(1/s) ds over 0 < s < 1.
    """
    from scipy.special import hyp2f1

    if share == 1.0:
        return StickingPunch(1.0, 1.0, beta).gain, StickingIndenter(1.0, 1.0, exponent, beta).approach_gain
    punch, n = _Punch(abs(beta), share), exponent
    P, Q = punch.solved(friction)
    mesh = punch.mesh
    # ∫ s^(n+1)/(1 - s²t²) ds, whose logarithm at t = 1 the weights there make nothing of
    square = np.minimum(mesh.x**2, 1.0 - 1e-13)
    moved = mesh.x * hyp2f1(1.0, 0.5 * n + 1.0, 0.5 * n + 2.0, square) / (n + 2.0)
    outside = 2.0 * abs(beta) * n / np.pi * float(np.sum(mesh.weight * Q * moved))
    return float(np.sum(mesh.weight * P)), 1.0 / (1.0 - outside)
