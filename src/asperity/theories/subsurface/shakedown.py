"""Elastic shakedown of rolling and sliding line contacts: the largest load at which plastic flow
ceases after some passes (Melan 1938)."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.tensor import StressTensor
from .hertz import hertz_line_normal, hertz_line_shear


@dataclass(frozen=True, eq=False)
class LineShakedown:
    """Limits at depths (n,) under a load that passes along x; stresses over the yield stress in
    shear k there.

    Attributes
    ----------
    radius
        Radius of the smallest circle about the stress states of a pass, centred on the axis of
        (σ_xx - σ_zz)/2, over k. Loads may be larger by its inverse before plastic flow goes on at
        every pass.
    residual
        Residual stress σ_xx over k that protects the depth: minus twice the centre of that circle.
    """

    radius: RealArray
    residual: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1962",)

    @property
    def limit(self) -> float:
        """Factor on the load up to which all depths shake down."""
        return 1.0 / float(self.radius.max())


GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
ROUNDS = 40
"""Steps of the golden section: 0.618^40 = 4e-9, of which the radius errs by the square."""


def line_shakedown(stress: StressTensor, shear_strength: float | RealArray) -> LineShakedown:
    """Smallest circles about the ``stress`` (n, m) at n depths and m places along a pass, in plane
    strain along y.

    Residual stresses σ_xx and σ_yy that depend on the depth alone are free in a pass (Melan); the
    second makes σ_yy the intermediate one. Homogeneous or layered: each depth has its own
    ``shear_strength`` k in Pa, a number or (n,).

        p^s = min_z 1/min_c max_x sqrt(((σ_xx - σ_zz)/2 - c)² + σ_xz²)   (Johnson 1962).

    Raises
    ------
    InputError
        If the shear strength is not positive, or the stresses are not (n, m).
    """
    k = np.asarray(shear_strength, dtype=float)
    half, across = 0.5 * (np.asarray(stress.xx) - np.asarray(stress.zz)), np.asarray(stress.xz)
    if half.ndim != 2 or np.any(~(k > 0.0)) or k.shape not in ((), half.shape[:1]):
        raise InputError(
            "stress must be (depths, places) and the shear strength above zero, a number or one for each "
            f"depth, but they have the shapes {half.shape} and {k.shape}."
        )
    scale = np.broadcast_to(k, half.shape[:1])[:, None]
    half, across = half / scale, across / scale

    def radius(centre: RealArray) -> RealArray:
        return np.asarray(np.hypot(half - centre[:, None], across).max(axis=1))

    low, high = (
        half.min(axis=1),
        half.max(axis=1),
    )  # the best centre lies between them; the largest distance is convex in it
    for _ in range(ROUNDS):
        first, second = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        left = radius(first) < radius(second)
        low, high = np.where(left, low, first), np.where(left, second, high)
    centre = 0.5 * (low + high)
    return LineShakedown(radius(centre), -2.0 * centre)


@dataclass(frozen=True)
class CylinderShakedown:
    """Elastic shakedown limit of a homogeneous line contact.

    Attributes
    ----------
    peak_over_k
        Peak pressure over the yield stress in shear.
    depth
        Depth in half-widths where the limit is reached; 0 at the surface.
    residual
        σ_xx there over the peak pressure that protects it.
    """

    peak_over_k: float
    depth: float
    residual: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1962",)


PLACES = 4001
"""Places along a pass from -4 to 4 half-widths: the limit changes by 1e-7 from 2001 to 4001."""


def cylinder_shakedown(friction: float = 0.0) -> CylinderShakedown:
    """Limit of a rolling and sliding cylinder with the traction q = ``friction`` p everywhere,
    friction >= 0; any Poisson's ratio.

    4 k at 0.5 a in pure rolling (Johnson 1962), k/μ at the surface from a friction of 0.367 on.

    Raises
    ------
    InputError
        If the friction is negative.
    """
    return _cylinder(float(require.not_negative(friction, "friction coefficient")))


@functools.cache
def _cylinder(mu: float) -> CylinderShakedown:
    """The limit at one friction; it takes a second, and studies of loads and thicknesses ask for it
    again and again."""
    x = np.linspace(-4.0, 4.0, PLACES)[None, :]  # in half-widths, as the depths; the peak pressure is one
    low, high = 0.0, 1.2
    for _ in range(6):
        depths = np.linspace(low, high, 41)
        normal = hertz_line_normal(x, depths[:, None], 1.0, shear=1.0, nu=0.3).stress
        shear = hertz_line_shear(x, depths[:, None], 1.0, shear=1.0, nu=0.3).stress
        circles = line_shakedown(normal + shear * mu, 1.0)
        place = int(np.argmax(circles.radius))
        step = (high - low) / 40.0
        if depths[place] == 0.0:
            break
        low, high = max(depths[place] - step, 0.0), depths[place] + step
    return CylinderShakedown(1.0 / float(circles.radius[place]), float(depths[place]), float(circles.residual[place]))
