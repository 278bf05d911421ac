"""How far a feasible pressure is from the solution: multiplier, duality gap and the customary relative error.

All functions take r = K p - h (m) and the level lambda (m); the gap of the bodies is r - lambda.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from .protocol import ContactQP, FixedOffset


def level(qp: ContactQP, pressure: RealArray, r: RealArray) -> float:
    """Level lambda = -offset (m) of the contacting plane.

    Prescribed for ``FixedOffset``; else the pressure-weighted mean of r over the points strictly between the bounds.
    Where there is none (every pressure at a bound), the middle of the interval the conditions leave open.
    """
    if isinstance(qp.constraint, FixedOffset):
        return -qp.constraint.offset
    working = (pressure > 0.0) & (pressure < qp.cap)
    weight = pressure[working].sum()
    if weight > 0.0:
        return float((pressure[working] * r[working]).sum() / weight)
    capped = pressure > 0.0
    low = r[capped].max() if capped.any() else r.min()
    high = r[~capped].min() if not capped.all() else low
    return float(0.5 * (low + high))


def energy(qp: ContactQP, pressure: RealArray, deflection: RealArray) -> float:
    """Total complementary energy per pixel area (Pa·m), p·Kp/2 - p·(h - d), d = 0 where the load is prescribed."""
    height = qp.profile - qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else qp.profile
    return float((pressure * (0.5 * deflection - height)).sum())


def duality_gap(pressure: RealArray, r: RealArray, cap: float | RealArray, at: float) -> float:
    """Sum of (r - lambda)+ p + (lambda - r)+ (cap - p) in Pa·m; times the pixel area it bounds V(p) - V(p*).

    Infinite if r < lambda anywhere without a cap (weak duality of the quadratic programme, Kalker 1977).
    """
    gap = r - at  # sums of products rather than np.vdot, after which idle threads of BLAS keep the processors busy
    if not isinstance(cap, np.ndarray) and cap == np.inf:
        return np.inf if gap.min() < 0.0 else float((gap * pressure).sum())
    above = float((np.maximum(gap, 0.0) * pressure).sum())
    return above + float((np.maximum(-gap, 0.0) * (cap - pressure)).sum())


def best_level(pressure: RealArray, r: RealArray, cap: float | RealArray) -> float:
    """Level (m) with the smallest duality gap, so the sharpest bound: min r without cap, else a weighted median."""
    if not isinstance(cap, np.ndarray) and cap == np.inf:
        return float(r.min())
    order = np.argsort(r, axis=None)
    room = np.broadcast_to(np.asarray(cap, dtype=float), r.shape).ravel()[order].cumsum()
    # slope of the gap in lambda: sum of (cap - p) where r < lambda, minus sum of p where r > lambda
    index = int(np.searchsorted(room, pressure.sum()))
    return float(r.ravel()[order[min(index, order.size - 1)]])


def relative_error(qp: ContactQP, pressure: RealArray, deflection: RealArray) -> float:
    """The field's error, duality gap over (total pressure times rms height); at prescribed offset see below.

    With a prescribed offset and no cap the gap is infinite at any penetration; there the error is the mean of the
    pressure-weighted gap plus the largest penetration, both over the rms height.
    """
    r = deflection - qp.profile
    total = float(pressure.sum())
    if isinstance(qp.constraint, FixedOffset):
        gap = r + qp.constraint.offset
        penetration = np.maximum(-gap, 0.0)
        if not qp.elastic:
            penetration = np.where(pressure < qp.cap, penetration, 0.0)
        weighted = float((pressure * np.maximum(gap, 0.0)).sum()) / total if total > 0.0 else 0.0
        return (weighted + float(penetration.max())) / qp.height_scale
    lowest = duality_gap(pressure, r, qp.cap, float(r.min()))
    found = lowest if qp.elastic else min(lowest, duality_gap(pressure, r, qp.cap, level(qp, pressure, r)))
    return found / (total * qp.height_scale)
