"""Surface response to a point force from its spectrum, for laterally isotropic bodies of any structure.

A compliance C(alpha) that multiplies cos(m phi) (phi: direction of the wavevector) belongs to the point response
k(r) cos(m theta) with, up to the factor i^m,

    k(r) = 1/(2 pi) ∫ C(alpha) J_m(alpha r) alpha d alpha = E(r) / (2 pi r),

where E, the local value of alpha C, runs smoothly from its limit at short wavelengths (near field, top layer) to that at
long ones (far field, base). Both limits are removed in closed form: C = high/alpha + (low - high) exp(-alpha d)/alpha
+ remainder. A homogeneous half-space has E = alpha C = constant.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.hankel import log_hankel
from ...core.panels import STEP, LogTable, log_grid, log_table

COUNT = 8192
"""Nodes of the grids of wavenumber and distance, 85 e-folds: the alias of a tail 1/r is exp(-42) = 4e-19."""


def wavenumber_grid(length: float) -> RealArray:
    """Logarithmic grid (COUNT,) of wavenumbers around 1/``length`` (m)."""
    return log_grid(np.exp(-COUNT // 2 * STEP) / length, COUNT)


@dataclass(frozen=True, eq=False)
class PointKernel:
    """Response k(r) = E(r)/(2 pi r) of angular ``order`` m.

    ``strength`` E(r) in m²/N·m; ``moment`` the integral of E from 0 to r, both tables over r in m.
    """

    order: int
    strength: LogTable
    moment: LogTable

    def response(self, r: RealArray) -> RealArray:
        """k(r) in m/N at distances ``r`` > 0 in m."""
        value: RealArray = self.strength(r) / (2.0 * np.pi * r)
        return value


@dataclass(frozen=True)
class Limits:
    """Limits of alpha C (1/Pa) at short (``high``) and long (``low``) wavelengths, and a ``depth`` d (m) between them."""

    high: float
    low: float
    depth: float


def point_kernel(values: RealArray, limits: Limits, order: int = 0) -> PointKernel:
    """Kernel of the compliance with ``values`` of alpha C (1/Pa) on ``wavenumber_grid(limits.depth)``.

    The error of E is about 1e-13 of the larger limit: rounding, and the interpolation of the tables.
    """
    d, jump = limits.depth, limits.low - limits.high
    alpha = wavenumber_grid(d)
    remainder = log_hankel(values - limits.high - jump * np.exp(-alpha * d), order)
    r = 1.0 / alpha[::-1]
    root = np.hypot(r, d)
    strength = limits.high + jump * r / root * (r / (root + d)) ** order + remainder
    start = float(r[0])
    moment = log_table(start, strength * r)
    moment = moment.integral(float(strength[0]) * moment.start)
    return PointKernel(order, log_table(start, strength), moment)
