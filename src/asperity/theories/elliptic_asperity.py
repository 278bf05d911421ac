"""Hertz contact of a summit with two curvatures (Johnson 1985, eq. 4.26-4.30), without solving for the ellipse.

Curvatures κ_m(1 ± r), 0 <= r < 1. With the approach δ, A = π δ/κ_m f_A and P = (4/3) E* δ^(3/2)/κ_m^(1/2) f_P. The axis
ratio k = b/a of the ellipse is the natural parameter: r and both factors are closed forms in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from .hertz_ellipse import axis_ratio


@dataclass(frozen=True, eq=False)
class Ellipse:
    """Contact ellipses of axis ratio ``k`` = b/a, 0 < k <= 1, any shape.

    ``r`` relative difference of the curvatures; ``area`` f_A and ``load`` f_P, which are 1 for a sphere; ``slope`` is
    dr/d(ln k), not positive.
    """

    k: RealArray
    r: RealArray
    area: RealArray
    load: RealArray
    slope: RealArray


def ellipse(k: RealArray) -> Ellipse:
    """Factors of ellipses with axis ratio ``k`` = b/a.

    With complete elliptic integrals K, E of the parameter m = 1 - k² and D = (K - E)/m, B = K - D, which lose no digits
    at small m: (1 + r)/(1 - r) = B/(k² D), f_A = (B + k² D)/(k K), f_P = (π/2K) sqrt[(B + k² D)/(k² K)].
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
