"""Partial slip of coated bodies that are mirror images of each other, from their compliances alone.

Bodies without coupling between normal and tangential directions, whose compliances per wavenumber α
are given functions: ``normal`` S_zz, along the wave S_LL, across it S_T, sums of both bodies in
m/Pa, such as of layers (solids.plane_compliance). α times each tends to a constant for large α,
that of the surface layer; the rest decays and makes a smooth kernel. A parabola x²/2R in plane
strain or r²/2R is pressed to the half-width or radius a, then sheared or twisted until it sticks
within c. The reduced rule Q = μ [P(a) - P(c)] of homogeneous bodies is wrong for layers by tens of
per cent. The nodes grow with the contact over the coat, the time with its cube: a second at a ratio
of fifty.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from .torsion import slip_transform

Spectrum: TypeAlias = Callable[[RealArray], RealArray]
"""Compliance S(α) in m/Pa at wavenumbers α > 0 in rad/m, (n,) to (n,)."""

Wave: TypeAlias = Callable[[RealArray], RealArray]

_CHUNK = 2048  # wavenumbers whose waves are held at once
_FARTHEST = 2.0**40  # over the contact: αS has its limit there to the last digit, for coats of 1e-10 of its size too
_OCTAVES = 44


@dataclass(frozen=True, eq=False)
class _Split:
    """αS(α) as its ``limit`` for large α and the rest: ``excess`` times weight at the nodes
    ``alpha``."""

    limit: float
    alpha: RealArray
    excess: RealArray

    @classmethod
    def of(cls, compliance: Spectrum, length: float) -> _Split:
        """For a contact of half the ``length``."""
        octaves = 2.0 ** np.arange(-3, _OCTAVES) / length
        values = octaves * compliance(octaves)
        limit = float(_FARTHEST / length * compliance(np.array([_FARTHEST / length]))[0])
        far = np.flatnonzero(np.abs(values - limit) > 1e-15 * abs(limit))
        if not far.size:
            return cls(limit, np.zeros(1), np.zeros(1))
        end = float(octaves[min(int(far[-1]) + 1, octaves.size - 1)])
        # the decay has a scale of end/36, a coat on a soft body one of its own near zero, the waves
        # in the contact 1/length
        width = min(end / 12.0, 10.0 / length)
        breaks = np.concatenate(
            [[0.0], width * 0.5 ** np.arange(20.0, 0.0, -1.0), np.arange(1.0, end / width + 1.0) * width]
        )
        alpha, weight = gauss(breaks, 24)  # 20 rad of a wave across the contact in each
        return cls(limit, alpha, weight * (alpha * compliance(alpha) - limit))

    def nodes(self, length: float) -> int:
        """Points that resolve the kernel over a contact of half the ``length``."""
        return 2 * (24 + int(min(0.25 * float(self.alpha[-1]) * length, 1000.0)))

    def odd(self, x: RealArray, s: RealArray) -> RealArray:
        """∫ (αS - limit) sin α(x - s) dα, (x, s)."""
        return self._sum(x, s, np.sin, np.cos) - self._sum(x, s, np.cos, np.sin)

    def waves(self, x: RealArray, t: RealArray, wave: Wave) -> RealArray:
        """(2/π) ∫ (αS - limit) f(αx) f(αt) dα of sines or cosines f = ``wave``, (x, t)."""
        return 2.0 / np.pi * self._sum(x, t, wave, wave)

    def _sum(self, x: RealArray, t: RealArray, left: Wave, right: Wave) -> RealArray:
        total = np.zeros((x.size, t.size))
        for begin in range(0, self.alpha.size, _CHUNK):
            part = slice(begin, begin + _CHUNK)
            row = left(np.multiply.outer(x, self.alpha[part])) * self.excess[part]
            total += row @ right(np.multiply.outer(t, self.alpha[part])).T
        return total


# Lines: Cauchy's kernel by Gauss-Chebyshev quadrature of the second kind (Erdogan & Gupta 1972).
#
# For u' = -(1/π) ∫ [limit/(x - s) + L(x - s)] p(s) ds of tractions that end as roots, p = Σ b_k sin
# kθ with s = a cos θ.


@dataclass(frozen=True, eq=False)
class _Roots:
    """Even traction on (-a, a) that ends as roots: its values p(a cos θ_j) at θ_j = πj/(n + 1)."""

    half_width: float
    angle: RealArray
    values: RealArray

    @property
    def places(self) -> RealArray:
        return self.half_width * np.cos(self.angle)

    @property
    def weights(self) -> RealArray:
        """Of ∫ p ds."""
        return self.half_width * np.sin(self.angle) * np.pi / (self.angle.size + 1.0)

    def at(self, x: ArrayLike) -> RealArray:
        """Traction at ``x``, zero outside."""
        k = np.arange(1, self.angle.size + 1)
        b = 2.0 / (k.size + 1.0) * np.sin(np.multiply.outer(k, self.angle)) @ self.values
        theta = np.arccos(np.clip(np.asarray(x, dtype=float) / self.half_width, -1.0, 1.0))
        return np.asarray(np.sin(np.multiply.outer(theta, k)) @ b)

    @property
    def total(self) -> float:
        return float(np.sum(self.weights * self.values))


def _solved(split: _Split, half_width: float, count: int, slope: Callable[[RealArray], RealArray]) -> _Roots:
    """Traction p with ∫ [limit/(x - s) + L(x - s)] p ds = ``slope`` at x within the half-width, for
    an odd slope."""
    empty = _Roots(half_width, np.pi * np.arange(1.0, count + 1.0) / (count + 1.0), np.zeros(count))
    s = empty.places
    x = half_width * np.cos(np.pi * (np.arange(1.0, count + 2.0) - 0.5) / (count + 1.0))
    x = np.delete(x, count // 2)  # the middle of an even number of nodes, where an odd slope vanishes by itself
    matrix = (split.limit / np.subtract.outer(x, s) + split.odd(x, s)) * empty.weights
    return _Roots(half_width, empty.angle, np.linalg.solve(matrix, slope(x)))


@dataclass(frozen=True, eq=False)
class CoatedLineSlip:
    """A coated line contact in partial slip.

    Parameters
    ----------
    load, tangential
        Normal and tangential force P and Q in N/m.
    reduced
        μ [P(a) - P(c)] in N/m, the force of the reduced rule at the same stick zone.
    """

    load: float
    tangential: float
    reduced: float
    friction: float
    normal: _Roots
    sticking: _Roots

    def pressure(self, x: ArrayLike) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from the middle."""
        return self.normal.at(x)

    def traction(self, x: ArrayLike) -> RealArray:
        """Shear traction in Pa at ``x`` in m (any shape) from the middle."""
        return self.friction * self.normal.at(x) - self.sticking.at(x)


@dataclass(frozen=True)
class CoatedLine:
    """Cylinder on coated twins in plane strain, sheared in the plane (``shear`` S_LL) or across it
    (S_T).

    Examples
    --------
    Compliances of homogeneous bodies give Cattaneo's stick zone, c = a sqrt(1 - Q/(μ P)):

    >>> def half_space(alpha):
    ...     return 2.0 / alpha
    >>> line = CoatedLine(normal=half_space, shear=half_space, radius=10.0, friction=0.5)
    >>> slip = line.at_stick_width(half_width=1.0, share=0.6)
    >>> print(f"{slip.tangential / (0.5 * slip.load):.6f}")
    0.640000
    """

    normal: Spectrum
    shear: Spectrum
    radius: float
    friction: float

    def at_stick_width(self, half_width: float, share: float) -> CoatedLineSlip:
        """The contact of the ``half_width`` a in m that sticks within a ``share`` c/a of it, 0 <
        c/a < 1."""
        a = require.positive(half_width, "half-width (m)")
        k, mu = _share(share), require.positive(self.friction, "friction coefficient")
        normal, shear = _Split.of(self.normal, a), _Split.of(self.shear, a)
        count = max(normal.nodes(a), shear.nodes(a))
        pressed = self._pressed(normal, a, count)
        mirrored = shear.limit / normal.limit

        def slope(x: RealArray) -> RealArray:
            """Of the displacement by μp, its Cauchy integral taken from the normal contact."""
            force = pressed.weights * pressed.values
            smooth = shear.odd(x, pressed.places) - mirrored * normal.odd(x, pressed.places)
            return np.asarray(mu * (mirrored * np.pi * x / self.radius + smooth @ force))

        sticking = _solved(shear, k * a, count, slope)
        load, inner = pressed.total, self._pressed(normal, k * a, count).total
        return CoatedLineSlip(load, mu * load - sticking.total, mu * (load - inner), mu, pressed, sticking)

    def _pressed(self, normal: _Split, half_width: float, count: int) -> _Roots:
        radius = require.positive(self.radius, "relative radius of curvature (m)")
        return _solved(normal, half_width, count, lambda x: np.pi * x / radius)


# Torsion: equations of the second kind for the Abel transforms P = ∫ rp/sqrt(r² - x²) dr and Q = x
# ∫ q/sqrt(r² - x²) dr.
#
# limit P + (2/π) ∫∫ (αS - limit) cos αx cos αt dα P dt = δ - x²/R, with P(a) = 0; with sines limit
# Q + … = 2θx within c.


@dataclass(frozen=True, eq=False)
class CoatedTwistSlip:
    """A coated round contact under a torque: ``load`` in N, ``approach`` in m, ``rotation`` in rad,
    ``torque`` in N m."""

    load: float
    approach: float
    rotation: float
    torque: float


@dataclass(frozen=True)
class CoatedTwist:
    """Sphere on coated twins, pressed and twisted; exact for every Poisson's ratio (``across`` is
    S_T).

    Examples
    --------
    Homogeneous bodies are those of Lubkin:

    >>> twist = CoatedTwist(
    ...     normal=lambda alpha: 2.0 / alpha,
    ...     across=lambda alpha: 2.5 / alpha,
    ...     radius=10.0,
    ...     friction=0.5,
    ... )
    >>> slip = twist.at_stick_radius(contact_radius=1.0, share=0.6)
    >>> print(f"{slip.torque / (3 * np.pi / 16 * 0.5 * slip.load):.6f}")
    0.815688
    """

    normal: Spectrum
    across: Spectrum
    radius: float
    friction: float

    def at_stick_radius(self, contact_radius: float, share: float) -> CoatedTwistSlip:
        """The contact of the ``contact_radius`` a in m that sticks within a ``share`` c/a of it,
        0 < c/a < 1."""
        a, k = require.positive(contact_radius, "contact radius (m)"), _share(share)
        mu, c = require.positive(self.friction, "friction coefficient"), k * a
        split = _Split.of(self.across, a)
        load, approach, pressed = self._pressed(a)
        count = split.nodes(a)
        x, weight = gauss(np.array([0.0, c]), count)
        y, outer = gauss(np.array([c, a]), count)
        slipping = mu * slip_transform(pressed, y, a)
        edge = float(mu * slip_transform(pressed, np.array([c]), a)[0])
        at = np.append(x, c)
        inner = split.waves(at, x, np.sin) * weight
        drive = np.stack([2.0 * at, -split.waves(at, y, np.sin) @ (outer * slipping)])
        matrix = split.limit * np.eye(count) + inner[:-1]
        found = np.linalg.solve(matrix, drive[:, :-1].T).T
        ends = (drive[:, -1] - inner[-1] @ found.T) / split.limit
        rotation = float((edge - ends[1]) / ends[0])
        sticking = rotation * found[0] + found[1]
        torque = 8.0 * float(np.sum(weight * x * sticking) + np.sum(outer * y * slipping))
        return CoatedTwistSlip(load, approach, rotation, torque)

    def _pressed(self, a: float) -> tuple[float, float, Callable[[RealArray], RealArray]]:
        """Load, approach, and P(x)."""
        split = _Split.of(self.normal, a)
        count = split.nodes(a)
        t, weight = gauss(np.array([0.0, a]), count)
        kernel = split.waves(t, t, np.cos) * weight
        parts = np.stack([np.ones_like(t), -(t**2) / require.positive(self.radius, "relative radius of curvature (m)")])
        found = np.linalg.solve(split.limit * np.eye(count) + kernel, parts.T).T

        def extended(x: RealArray) -> RealArray:
            """Both solutions at ``x``, (2, n)."""
            right = np.stack([np.ones_like(x), -(x**2) / self.radius])
            return np.asarray((right - found @ (split.waves(x, t, np.cos) * weight).T) / split.limit)

        edge = extended(np.array([a]))[:, 0]
        approach = float(-edge[1] / edge[0])
        mixed = np.array([approach, 1.0])
        nodes = 2 * count + 1
        points = np.cos(np.pi * (np.arange(nodes) + 0.5) / nodes)
        series = chebyshev.chebfit(points, mixed @ extended(a * np.abs(points)), nodes - 1)
        load = 4.0 * float(np.sum(weight * (mixed @ found)))
        return load, approach, lambda x: np.asarray(chebyshev.chebval(x / a, series))


def _share(share: float) -> float:
    if not 0.0 < require.finite(share, "stick zone over contact") < 1.0:
        raise InputError(f"stick zone over contact must be between 0 and 1, both excluded, but is {share:g}.")
    return share
