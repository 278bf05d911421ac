"""Stress below an elliptical Hertz contact, on and off axis (Hertz 1882; Johnson 1985, secs. 3.4, 4.2).

The potential of the semi-ellipsoidal pressure and its derivatives are Carlson's symmetric integrals. What compressible
bodies need besides, the second derivatives of ∫ V dz, is one more integral, along z, of elementary functions of these.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.quadrature import gauss
from ..core.tensor import StressTensor

_BREAKS = (0.0, 0.002, 0.01, 0.04, 0.15, 0.5, 1.5, 4.0)
"""Ends of the panels along z in minor semi-axes; the last one continues to infinity in 1/z."""

_NODES = 16


def hertz_ellipse_normal(
    x: RealArray, y: RealArray, z: RealArray | float, semi_axes: tuple[float, float], *, nu: float
) -> StressTensor:
    """Stress under the pressure sqrt(1 - x²/a² - y²/b²) per unit peak; error below 1e-11 of it.

    On the very edge of the contact, where stresses have a kink, the error is 5e-4.

    Parameters
    ----------
    x, y, z
        Field points in m, broadcast against each other, z >= 0.
    semi_axes
        (a, b) along x and y in m, in any order of size, see ``HertzEllipse.semi_axes``.
    nu
        Poisson's ratio, up to 0.5.
    """
    x, y, z = (np.asarray(values, dtype=float) for values in np.broadcast_arrays(x, y, z))
    f = _Potential.of(x, y, z, semi_axes)
    k = 1.0 - 2.0 * nu
    chi_xx, chi_yy, chi_xy = _integrals(x, y, z, semi_axes) if k > 0.0 else (0.0 * x, 0.0 * x, 0.0 * x)
    stress = StressTensor(
        xx=2.0 * nu * f.V_z - z * f.V_xx - k * chi_xx,
        yy=2.0 * nu * f.V_z - z * f.V_yy - k * chi_yy,
        zz=f.V_z + z * (f.V_xx + f.V_yy),
        xy=-z * f.V_xy - k * chi_xy,
        xz=-z * f.V_xz,
        yz=-z * f.V_yz,
    )
    return stress * (0.5 / math.pi)


@dataclass(frozen=True, eq=False)
class _Potential:
    """Derivatives of V = ∫ p/ρ dA = (πab/2) ∫ [1 - x²/(a² + s) - y²/(b² + s) - z²/s]/Δ ds over s > λ.

    Δ² = (a² + s)(b² + s)s, and λ is the confocal ellipsoid through the point, x²/(a² + λ) + y²/(b² + λ) + z²/λ = 1.
    """

    V_z: RealArray
    V_xx: RealArray
    V_yy: RealArray
    V_xy: RealArray
    V_xz: RealArray
    V_yz: RealArray

    @classmethod
    def of(cls, x: RealArray, y: RealArray, z: RealArray, semi_axes: tuple[float, float]) -> _Potential:
        from scipy.special import elliprd

        a, b = semi_axes
        s = _confocal(x, y, z, semi_axes)
        A, B = a**2 + s, b**2 + s
        root = np.sqrt(A * B)
        # z/√λ, which inside of the contact on the surface is the root of the pressure
        inside = np.sqrt(np.maximum(1.0 - x**2 / A - y**2 / B, 0.0))
        w = np.where(s > 0.0, z / np.sqrt(np.where(s > 0.0, s, 1.0)), inside)
        along_x, along_y = 2.0 / 3.0 * elliprd(B, s, A), 2.0 / 3.0 * elliprd(A, s, B)
        spread = s * ((x / A) ** 2 + (y / B) ** 2) + w**2
        spread = np.where(spread > 0.0, spread, 1.0)  # the edge itself
        bend = 2.0 * np.sqrt(s) / (root * spread)
        tilt = 2.0 * w / (root * spread)
        scale = math.pi * a * b
        return cls(
            V_z=-scale * (2.0 * w / root - z * (along_x + along_y)),
            V_xx=-scale * (along_x - (x / A) ** 2 * bend),
            V_yy=-scale * (along_y - (y / B) ** 2 * bend),
            V_xy=scale * x * y / (A * B) * bend,
            V_xz=scale * x / A * tilt,
            V_yz=scale * y / B * tilt,
        )


def _confocal(x: RealArray, y: RealArray, z: RealArray, semi_axes: tuple[float, float]) -> RealArray:
    """λ >= 0 in m², the largest root of a cubic, by Newton's method from above, where the cubic is convex."""
    a2, b2 = semi_axes[0] ** 2, semi_axes[1] ** 2
    s = x**2 + y**2 + z**2
    for _ in range(60):
        value = s * (a2 + s) * (b2 + s) - x**2 * s * (b2 + s) - y**2 * s * (a2 + s) - z**2 * (a2 + s) * (b2 + s)
        slope = (
            (a2 + s) * (b2 + s)
            + s * (a2 + b2 + 2.0 * s)
            - x**2 * (b2 + 2.0 * s)
            - y**2 * (a2 + 2.0 * s)
            - z**2 * (a2 + b2 + 2.0 * s)
        )
        new = np.maximum(s - np.divide(value, slope, out=np.zeros_like(s), where=slope > 0.0), 0.0)
        if np.all(np.abs(new - s) <= 1e-15 * s):
            break
        s = new
    return s


def _integrals(
    x: RealArray, y: RealArray, z: RealArray, semi_axes: tuple[float, float]
) -> tuple[RealArray, RealArray, RealArray]:
    """χ_xx, χ_yy, χ_xy with χ_z = V: minus the integrals of V_xx, V_yy, V_xy from z on."""
    unit = min(semi_axes)
    near, near_weight = gauss(np.array(_BREAKS), _NODES)
    # beyond, u = 1/t: the fields are powers of t
    t, t_weight = gauss(np.array([0.0, 0.1 / _BREAKS[-1], 0.4 / _BREAKS[-1], 1.0 / _BREAKS[-1]]), _NODES)
    depth = unit * np.concatenate([near, 1.0 / t])
    weight = unit * np.concatenate([near_weight, t_weight / t**2])
    f = _Potential.of(x[..., None], y[..., None], z[..., None] + depth, semi_axes)
    chi_xx, chi_yy, chi_xy = (-np.sum(weight * values, axis=-1) for values in (f.V_xx, f.V_yy, f.V_xy))
    return chi_xx, chi_yy, chi_xy
