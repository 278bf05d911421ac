"""Elastic shakedown of rolling and sliding point contacts: bounds from both sides on the load at
which plastic flow ceases (Melan 1938)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.tensor import StressTensor
from ..protocol import poissons_ratio
from .hertz import hertz_ellipse_normal, hertz_normal, hertz_shear
from .shakedown import GOLDEN

Index: TypeAlias = NDArray[np.integer[Any]]

# Von Mises' criterion in five orthonormal components of the deviator, whose sum of squares is J2. A
# pass along x is a loop of states at every (y, z); a residual stress shifts it. Residual stresses
# that a steady pass leaves do not depend on x, so that ρ_xx(y, z) and ρ_yy(z) are in equilibrium by
# themselves: they give a load that certainly shakes down. Whatever the residual stress is, it is
# constant in time, so that a loop that fits into no sphere of radius k never shakes down.


@dataclass(frozen=True, eq=False)
class PointShakedown:
    """Bounds at depths (n,) under a load that passes along x, over the yield stress in shear k
    there.

    Attributes
    ----------
    radius
        Largest sqrt(J2)/k of a pass with the best residual stresses ρ_xx(y, z) and ρ_yy(z). Loads
        may be larger by its inverse.
    least
        Largest sqrt(J2)/k of a pass that no residual stress can lower: half the range of stress
        that alternates.
    residual_along
        Those σ_xx over k, (n, m) at the places across the pass.
    residual_across
        Those σ_yy over k, (n,).
    """

    radius: RealArray
    least: RealArray
    residual_along: RealArray
    residual_across: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1962", "Hearle1985")

    @property
    def limit(self) -> float:
        """Factor on the load up to which all depths certainly shake down."""
        return 1.0 / float(self.radius.max())

    @property
    def bound(self) -> float:
        """Factor on the load from which on some point yields in every pass, whatever the residual
        stress."""
        return 1.0 / float(self.least.max())


def point_shakedown(
    stress: StressTensor, shear_strength: float | RealArray, *, surface: bool | BoolArray = False
) -> PointShakedown:
    """Bounds on elastic shakedown from the ``stress`` (n, m_x, m_y) on n planes under a load that
    passes along x.

    ``least`` is that of the smallest spheres about the loops of states with free centres, by
    pairwise exchange of weights between the farthest and the nearest state; the value of the dual
    problem is a lower bound of the radius whatever the number of exchanges.

    Homogeneous or layered: each plane has its own ``shear_strength`` k in Pa, a number or (n,).
    ``surface``, a truth value or (n,), tells which planes are the surface of the body, on which
    residual stresses have no σ_xz and σ_yz.

    Raises
    ------
    InputError
        If the shear strength is not positive, or the stresses are not (n, m_x, m_y).
    """
    k = np.asarray(shear_strength, dtype=float)
    shape = np.shape(stress.xx)
    if len(shape) != 3 or np.any(~(k > 0.0)) or k.shape not in ((), shape[:1]):
        raise InputError(
            "stress must be (planes, places along the pass, places across) and the shear strength above zero, "
            f"a number or one for each plane, but they have the shapes {shape} and {k.shape}."
        )
    scale = np.broadcast_to(k, shape[:1])[:, None, None]
    s = stress.map(lambda component: np.swapaxes(np.asarray(component), 1, 2) / scale)
    # components whose squares sum to J2; a shift of σ_xx changes the first alone, one of σ_yy the
    # first two
    first = (2.0 * s.xx - s.yy - s.zz) / math.sqrt(12.0)
    states = np.stack([first, 0.5 * (s.yy - s.zz), s.xz, s.xy, s.yz])
    along, across, radius = _best_normal_stresses(states)
    least = np.zeros(shape[0])
    for plane, bare in enumerate(np.broadcast_to(np.asarray(surface, dtype=bool), shape[:1])):
        points = np.moveaxis(states[:, plane], 0, 1)  # (places across, 5, places along)
        least[plane] = math.sqrt(_largest_sphere(points, np.array([True, True, not bare, True, not bare])))
    return PointShakedown(radius, least, along, across)


_ROUNDS = 32
"""Steps of the golden section over ρ_yy: 0.618^32 = 2e-7 of its range; the radius is convex in it,
and errs by less."""


def _best_normal_stresses(states: RealArray) -> tuple[RealArray, RealArray, RealArray]:
    """ρ_xx (n, m), ρ_yy (n,) and the largest radius (n,) with them, for ``states`` (5, n, m across,
    m along)."""
    rest = (states[2:] ** 2).sum(axis=0)

    def radii(centre: RealArray) -> tuple[RealArray, RealArray]:
        return _best_centres(states[0], rest + (states[1] - centre[:, None, None]) ** 2)

    low, high = states[1].min(axis=(1, 2)), states[1].max(axis=(1, 2))
    first, second = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_first, at_second = (radii(centre)[1].max(axis=1) for centre in (first, second))
    for _ in range(_ROUNDS):
        left = at_first < at_second
        low, high = np.where(left, low, first), np.where(left, second, high)
        # one of the two is a point of the round before
        fresh = np.where(left, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        found = radii(fresh)[1].max(axis=1)
        first, second = np.where(left, fresh, second), np.where(left, first, fresh)
        at_first, at_second = np.where(left, found, at_second), np.where(left, at_first, found)
    centre = 0.5 * (low + high)
    along, squared = radii(centre)
    across = -2.0 * centre  # a shift ρ_yy moves the second component by ρ_yy/2 and the first by -ρ_yy/√12
    return -math.sqrt(3.0) * along + 0.5 * across[:, None], across, np.sqrt(squared.max(axis=1))


def _best_centres(at: RealArray, height: RealArray) -> tuple[RealArray, RealArray]:
    """Centre c with the least max_i (a_i - c)² + b_i along the last axis, and that least: parabolas
    ``at`` a with ``height`` b.

    All have one curvature, so that each pair meets once: the least lies at the vertex of one or
    where two meet.
    """
    offset, twice = at**2 + height, 2.0 * at
    begin = at.shape[-1] * np.arange(at[..., 0].size).reshape(at.shape[:-1])

    def of(values: RealArray, index: Index) -> RealArray:
        return np.asarray(values.take(begin + index))

    def highest(c: RealArray) -> tuple[Index, RealArray]:
        values = offset - twice * c[..., None]
        index = np.argmax(values, axis=-1)
        return index, of(values, index)

    left, right = np.argmin(at, axis=-1), np.argmax(at, axis=-1)
    centre = of(at, left)
    for _ in range(40):
        a, b, over_a, over_b = of(at, left), of(at, right), of(offset, left), of(offset, right)
        apart = np.where(b > a, b - a, 1.0)
        meet = np.where(b > a, 0.5 * (over_b - over_a) / apart, a)
        trial = np.clip(meet, np.minimum(a, b), np.maximum(a, b))
        top, value = highest(trial)
        known = np.maximum(over_a - 2.0 * a * trial, over_b - 2.0 * b * trial)
        centre = trial
        if np.all(value <= known + 1e-14 * np.abs(known)):
            break
        beyond, better = of(at, top) > trial, value > known
        right, left = np.where(better & beyond, top, right), np.where(better & ~beyond, top, left)
    return centre, centre**2 + highest(centre)[1]


_EXCHANGES = 150


def _largest_sphere(points: RealArray, free: BoolArray) -> float:
    """Largest of the squared radii of smallest spheres about ``points`` (loops, 5, m), their
    centres zero but where ``free``."""
    size = (points**2).sum(axis=1)
    weight = np.zeros_like(size)
    weight[np.arange(size.shape[0]), np.argmax(size, axis=1)] = 1.0
    points, most = points * free[:, None], 0.0
    for _ in range(_EXCHANGES):
        rows = np.arange(size.shape[0])
        centre = np.einsum("lcm,lm->lc", points, weight)
        height = size - 2.0 * np.einsum("lcm,lc->lm", points, centre)
        far, near = np.argmax(height, axis=1), np.argmin(np.where(weight > 0.0, height, np.inf), axis=1)
        shift = (centre**2).sum(axis=1)
        most = max(most, float(((weight * size).sum(axis=1) - shift).max()))
        gain = height[rows, far] - height[rows, near]
        move = ((points[rows, :, far] - points[rows, :, near]) ** 2).sum(axis=1)
        step = np.minimum(weight[rows, near], 0.5 * gain / np.maximum(move, 1e-300))
        weight[rows, far] += step
        weight[rows, near] -= step
        kept = height[rows, far] + shift > most * (1.0 + 1e-9)  # the others cannot be the largest
        if not kept.any():
            break
        points, size, weight = points[kept], size[kept], weight[kept]
    return most


@dataclass(frozen=True)
class SphereShakedown:
    """Elastic shakedown of a homogeneous point contact that rolls and slides.

    Attributes
    ----------
    peak_over_k
        Peak pressure over the yield stress in shear up to which it certainly shakes down.
    bound_over_k
        The same from which on it certainly does not.
    depth
        Depth in contact radii (semi-axes along the pass) where the former is reached; 0 at the
        surface.
    """

    peak_over_k: float
    bound_over_k: float
    depth: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Hearle1985", "Hamilton1983")


def sphere_shakedown(friction: float = 0.0, nu: float = 0.3) -> SphereShakedown:
    """Bounds for a sphere with the traction q = ``friction`` p everywhere, friction >= 0, by von
    Mises' criterion.

    Pure rolling: 4.68 k (Hearle, Ponter and Johnson 1985), one over the largest σ_xz; k/μ at the
    surface under high friction.

    Raises
    ------
    InputError
        If the friction is negative or Poisson's ratio out of range.
    """
    mu, nu = require.not_negative(friction, "friction coefficient"), poissons_ratio(nu)

    def stress(x: RealArray, y: RealArray, z: RealArray) -> StressTensor:
        pressed = hertz_normal(x, y, z, 1.0, shear=1.0, nu=nu).stress
        return pressed + hertz_shear(x, y, z, 1.0, shear=1.0, nu=nu).stress * mu if mu > 0.0 else pressed

    return _searched(stress, 1.0, 1.0)


def ellipse_shakedown(ratio: float, nu: float = 0.3) -> SphereShakedown:
    """Bounds in pure rolling of an elliptical contact, ``ratio`` of the semi-axis across to that
    along the pass, 0.05 to 20.

    The limit is that of a line contact for long ellipses across.

    Raises
    ------
    InputError
        If the ratio or Poisson's ratio is out of range.
    """
    b, nu = require.between(ratio, 0.05, 20.0, "ratio of the semi-axes"), poissons_ratio(nu)

    def stress(x: RealArray, y: RealArray, z: RealArray) -> StressTensor:
        half = x.shape[1] // 2
        ahead = hertz_ellipse_normal(x[:, half:], y, z, (1.0, b), nu=nu)
        odd = ("xy", "xz")  # in x; the others are even
        whole = {
            name: np.concatenate([(-part if name in odd else part)[:, :0:-1], part], axis=1)
            for name, part in vars(ahead).items()
        }
        return StressTensor(**whole)

    return _searched(stress, min(1.0, b), b, along=24, across=7, down=9)


_Stress: TypeAlias = Callable[[RealArray, RealArray, RealArray], StressTensor]
"""Stress under unit peak pressure at places in semi-axes along the pass."""


def _searched(
    stress: _Stress, depth: float, b: float, *, along: int = 81, across: int = 15, down: int = 13
) -> SphereShakedown:
    """Bounds of a homogeneous contact, semi-axes 1 along the pass and ``b`` across, on ever finer
    depths of the order of ``depth``.

    ``along`` and ``across`` are numbers of places along half a pass and across the half contact,
    ``down`` of depths in each round.
    """
    # dense at the contact, and with its edges
    half = np.unique([*np.sinh(np.linspace(0.0, math.asinh(15.0), along)) / 5.0, 1.0])
    x = np.concatenate([-half[:0:-1], half])[:, None]
    y = np.array([*np.linspace(0.0, 1.2, across), 1.6, 2.2]) * b
    low, high, best, bound = 0.0, 1.2 * depth, (0.0, 0.0), 0.0
    for _ in range(4):
        depths = np.linspace(low, high, down)
        passes = stress(x[None], y[None, None], depths[:, None, None])
        found = point_shakedown(passes, 1.0, surface=depths == 0.0)
        place, step = int(np.argmax(found.radius)), (high - low) / (down - 1.0)
        best = max(best, (float(found.radius[place]), float(depths[place])))
        bound = max(bound, float(found.least.max()))
        low, high = max(depths[place] - step, 0.0), depths[place] + step
    return SphereShakedown(1.0 / best[0], 1.0 / bound, best[1])
