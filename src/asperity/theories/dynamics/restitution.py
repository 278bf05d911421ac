"""Rebound of a mass from a contact with damping proportional to the force, for any force law."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ..protocol import bisected, checked


def rebound(speed: ArrayLike) -> RealArray:
    """βv after an impact at βv = ``speed``, >= 0, of any shape, for the contact force c yᵐ (1 + β
    dy/dt).

    βv_in - ln(1 + βv_in) = -βv_out - ln(1 - βv_out), whatever mass, stiffness and exponent, without
    gravity. The coefficient of restitution is the ratio of both.
    """
    v = checked(speed, "speed times damping over stiffness")
    lost = _excess_of_logarithm(-v)
    return bisected(lambda out: _excess_of_logarithm(out) - lost, np.zeros_like(v), np.minimum(v, 1.0))


def _excess_of_logarithm(x: RealArray) -> RealArray:
    """-x - ln(1 - x) = x²/2 + x³/3 + …; for |x| < 0.05 by the series, whose first term left out is
    0.05^14/16 of the sum.
    """
    series = np.polynomial.polynomial.polyval(x, [0.0, 0.0, *(1.0 / k for k in range(2, 16))])
    with np.errstate(divide="ignore"):
        return np.where(np.abs(x) < 0.05, series, -x - np.log1p(-x))
