"""Rebound of a mass from a contact whose damping is in proportion to its force, whatever the law of the force."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ..protocol import bisected, checked


def rebound(speed: ArrayLike) -> RealArray:
    """βv after an impact at βv = ``speed``, >= 0, of any shape, for the contact force c yᵐ (1 + β dy/dt).

    βv_in - ln(1 + βv_in) = -βv_out - ln(1 - βv_out), whatever mass, stiffness and exponent, without gravity. The
    coefficient of restitution is the ratio of both.
    """
    v = checked(speed, "speed times damping over stiffness")
    # both sides are half the square of their speed to first order: for slow impacts by their series
    lost = np.where(v < 1e-3, v**2 * (0.5 - v * (1.0 / 3.0 - 0.25 * v)), v - np.log1p(v))

    def excess(out: RealArray) -> RealArray:
        series = out**2 * (0.5 + out * (1.0 / 3.0 + 0.25 * out))
        with np.errstate(divide="ignore"):
            return np.asarray(np.where(out < 1e-3, series, -out - np.log1p(-out)) - lost)

    return bisected(excess, np.zeros_like(v), np.minimum(v, 1.0))
