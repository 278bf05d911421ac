"""When a material yields or breaks: an equivalent stress and the strength it is compared with."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.tensor import StressTensor, second_invariant
from ...solids.elastic import TABOR, Elastic

_BLOCK = 1 << 14  # points whose temporaries stay in the cache


def sqrt_J2(s: StressTensor) -> RealArray:
    """√J2 in Pa, to be compared with the yield stress in pure shear k; Peng (2001, eq. 3.33) calls
    it von Mises stress."""
    return np.sqrt(second_invariant(s))


def von_mises(s: StressTensor) -> RealArray:
    """Equivalent stress √(3 J2) in Pa, to be compared with the tensile yield stress Y = √3 k."""
    return np.asarray(np.sqrt(3.0 * second_invariant(s)))


def hydrostatic(s: StressTensor) -> RealArray:
    """Mean normal stress in Pa, positive in tension."""
    return (s.xx + s.yy + s.zz) / 3.0


def principal_tensile(s: StressTensor) -> RealArray:
    """Larger principal stress within planes parallel to the surface in Pa (Peng 2001, eq. 3.34).

    It is the largest principal stress on a free surface in tension, and a lower bound of it inside
    the body.
    """
    return 0.5 * (s.xx + s.yy) + np.hypot(0.5 * (s.xx - s.yy), s.xy)


def principal_stresses(s: StressTensor) -> RealArray:
    """Principal stresses σ1 >= σ2 >= σ3 in Pa, shape (3, ...); error a few roundings of the
    largest.

    The eigenvalue apart from the others by the trigonometric formula, the others from the 2 x 2
    problem across its direction (Eberly 2014): unlike the formula alone this loses no digits where
    two of them are equal.
    """
    return _in_blocks(_values, s, (3,))


def tresca(s: StressTensor) -> RealArray:
    """σ1 - σ3 in Pa, to be compared with the tensile yield stress."""
    values = principal_stresses(s)
    return np.asarray(values[0] - values[2])


def max_shear(s: StressTensor) -> RealArray:
    """Largest shear stress on any plane, (σ1 - σ3)/2, in Pa."""
    return 0.5 * tresca(s)


def principal_directions(s: StressTensor) -> RealArray:
    """Unit vectors of the principal stresses, shape (3, 3, ...): [number of the principal stress,
    axis x y z].

    Signs are arbitrary, and where principal stresses are equal so is the direction across the
    others.
    """
    return _in_blocks(_directions, s, (3, 3))


def max_shear_normal(s: StressTensor) -> RealArray:
    """Unit normal (3, ...) of a plane of largest shear stress: (n1 + n3)/√2, n1 and n3 the first
    and last direction.

    The other such plane has the normal (n1 - n3)/√2.
    """
    directions = principal_directions(s)
    return np.asarray((directions[0] + directions[2]) * math.sqrt(0.5))


def _in_blocks(function: Callable[[StressTensor], RealArray], s: StressTensor, shape: tuple[int, ...]) -> RealArray:
    """``function`` on blocks of points that stay in the cache: five times faster on large fields
    than all at once."""
    points = s.map(np.ravel)
    out = np.empty((*shape, points.xx.size), points.xx.dtype)
    for first in range(0, points.xx.size, _BLOCK):
        block = slice(first, first + _BLOCK)
        out[..., block] = function(points.map(lambda component, block=block: component[block]))  # type: ignore[misc]
    return out.reshape(*shape, *np.shape(s.xx))


def _values(s: StressTensor) -> RealArray:
    state = _Deviator(s)
    middle, radius = 0.5 * (state.uu + state.vv), np.hypot(0.5 * (state.uu - state.vv), state.uv)
    upper, lower = middle + radius, middle - radius
    first, apart = state.first, state.apart
    ordered = [np.where(first, apart, upper), np.where(first, upper, lower), np.where(first, lower, apart)]
    return np.asarray(state.mean + state.size * np.stack(ordered))


def _directions(s: StressTensor) -> RealArray:
    state = _Deviator(s)
    angle = 0.5 * np.arctan2(2.0 * state.uv, state.uu - state.vv)
    upper = np.cos(angle) * state.u + np.sin(angle) * state.v
    lower = np.cos(angle) * state.v - np.sin(angle) * state.u
    first, apart = state.first, state.n
    return np.stack([np.where(first, apart, upper), np.where(first, upper, lower), np.where(first, lower, apart)])


class _Deviator:
    """Deviator over √(J2/3): the eigenvalue ``apart`` from the others, its direction ``n``, the 2 x
    2 form across it.

    ``first``: whether that eigenvalue is the largest, else the smallest.
    """

    def __init__(self, s: StressTensor) -> None:
        self.mean = hydrostatic(s)
        self.size = np.sqrt(second_invariant(s) / 3.0)
        scale = np.where(self.size > 0.0, self.size, 1.0)
        m = a, b, c, d, e, f = tuple(
            v / scale for v in (s.xx - self.mean, s.yy - self.mean, s.zz - self.mean, s.xy, s.xz, s.yz)
        )
        half_determinant = 0.5 * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e))
        self.first = half_determinant >= 0.0
        largest = 2.0 * np.cos(np.arccos(np.minimum(np.abs(half_determinant), 1.0)) / 3.0)
        self.apart = np.where(self.first, largest, -largest)
        # the unit vector that the singular matrix [[a d e], [d b f], [e f c]] less that value, of
        # rank 2, maps to zero
        rows = (
            np.stack([a - self.apart, d, e]),
            np.stack([d, b - self.apart, f]),
            np.stack([e, f, c - self.apart]),
        )
        crosses = np.stack([_cross(rows[0], rows[1]), _cross(rows[1], rows[2]), _cross(rows[2], rows[0])])
        squares = (crosses**2).sum(axis=1)
        best = np.argmax(squares, axis=0)
        vector = np.take_along_axis(crosses, best[None, None], axis=0)[0]
        length = np.sqrt(np.take_along_axis(squares, best[None], axis=0)[0])
        vector[0] = np.where(length > 0.0, vector[0], 1.0)
        self.n = np.asarray(vector / np.where(length > 0.0, length, 1.0))
        # two unit vectors that make an orthonormal triad with it
        x, y, z = self.n
        wide = np.abs(x) > np.abs(y)
        breadth = np.where(wide, np.hypot(x, z), np.hypot(y, z))
        zero = np.zeros_like(x)
        u = np.where(wide, np.stack([-z, zero, x]), np.stack([zero, z, -y])) / breadth
        self.u, self.v = u, _cross(self.n, u)
        self.uu, self.vv, self.uv = _form(self.u, self.u, m), _form(self.v, self.v, m), _form(self.u, self.v, m)


def _cross(u: RealArray, v: RealArray) -> RealArray:
    return np.stack([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])


def _form(u: RealArray, v: RealArray, m: tuple[RealArray, ...]) -> RealArray:
    """Product u·M·v with the symmetric matrix of the components xx, yy, zz, xy, xz, yz."""
    a, b, c, d, e, f = m
    x = a * v[0] + d * v[1] + e * v[2]
    y = d * v[0] + b * v[1] + f * v[2]
    z = e * v[0] + f * v[1] + c * v[2]
    return np.asarray(u[0] * x + u[1] * y + u[2] * z)


@dataclass(frozen=True)
class Limit:
    """Strength in Pa, NaN where unknown, and whether it was inferred from the hardness."""

    value: float
    inferred: bool = False


class Criterion(Protocol):
    """A criterion of failure.

    One whose equivalent stress rises with a quantity of ``stress.extremes`` may name that in
    ``measure`` ("von_mises", "tension", or "shear" for twice the largest): only where that may be
    largest it is then evaluated.
    """

    @property
    def name(self) -> str:
        """For tables."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers it rests on."""

    def equivalent(self, stress: StressTensor) -> RealArray:
        """Equivalent stress in Pa, an array of the shape of the components."""

    def limit(self, material: Elastic) -> Limit:
        """Strength of ``material``."""


class _OfYieldStress:
    """Base of criteria of yielding."""

    def limit(self, material: Elastic) -> Limit:
        """Tensile yield stress of ``material``, or hardness/2.8 where only that is known."""
        strength = material.strength
        if not math.isnan(strength.yield_stress):
            return Limit(strength.yield_stress)
        return Limit(strength.hardness / TABOR, inferred=not math.isnan(strength.hardness))


@dataclass(frozen=True)
class VonMises(_OfYieldStress):
    """√(3 J2) against the tensile yield stress; where that is unknown against hardness/2.8 (Tabor
    1951)."""

    name: ClassVar[str] = "von Mises"
    measure: ClassVar[str] = "von_mises"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Tabor1951")

    def equivalent(self, stress: StressTensor) -> RealArray:
        """√(3 J2) in Pa."""
        return von_mises(stress)


@dataclass(frozen=True)
class Tresca(_OfYieldStress):
    """σ1 - σ3 against the tensile yield stress; where that is unknown against hardness/2.8 (Tabor
    1951)."""

    name: ClassVar[str] = "Tresca"
    measure: ClassVar[str] = "shear"
    citation_keys: ClassVar[tuple[str, ...]] = ("Eberly2014", "Johnson1985", "Tabor1951")

    def equivalent(self, stress: StressTensor) -> RealArray:
        """σ1 - σ3 in Pa."""
        return tresca(stress)


@dataclass(frozen=True)
class MaxPrincipal:
    """Largest principal stress against a tensile ``strength`` in Pa, for brittle materials.

    InputError if the strength is not positive.
    """

    strength: float
    name: ClassVar[str] = "maximum principal stress"
    measure: ClassVar[str] = "tension"
    citation_keys: ClassVar[tuple[str, ...]] = ("Eberly2014", "Johnson1985")

    def __post_init__(self) -> None:
        require.positive(self.strength, "tensile strength (Pa)")

    def equivalent(self, stress: StressTensor) -> RealArray:
        """σ1 in Pa."""
        return np.asarray(principal_stresses(stress)[0])

    def limit(self, material: Elastic) -> Limit:
        """The given strength, the same in every material."""
        return Limit(self.strength)
