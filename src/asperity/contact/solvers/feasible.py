"""Pressures that respect the bounds and the prescribed load."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from .protocol import ContactQP, FixedMean

_SWEEPS = 100


def feasible_start(qp: ContactQP, start: RealArray | None) -> RealArray:
    """Feasible pressure (Pa, float64) near ``start``; without one, a uniform pressure or a rough guess from the overlap."""
    given = start is not None and bool(start.any())
    start = None if start is None else np.asarray(start, dtype=np.float64)
    if isinstance(qp.constraint, FixedMean):
        mean = qp.constraint.mean_pressure
        guess = np.maximum(start, 0.0) if start is not None and given else np.full(qp.profile.shape, mean)
        return scaled_to_load(guess, qp.cap, mean)
    if start is not None and given:
        return np.asarray(np.clip(start, 0.0, qp.cap))
    overlap = np.maximum(qp.profile - qp.constraint.offset, 0.0)
    response = float((overlap * qp.operator.apply(overlap)).sum())
    factor = float((overlap**2).sum()) / response if response > 0.0 else 0.0
    return np.asarray(np.clip(factor * overlap, 0.0, qp.cap))


def scaled_to_load(pressure: RealArray, cap: float | RealArray, mean: float) -> RealArray:
    """Pressure (Pa) of the given ``mean``, by scaling the points below ``cap`` and clipping them to it, repeatedly.

    ``pressure`` must be >= 0 and ``mean`` at most the mean of ``cap``. Where every loaded point is at its cap, the
    rest of the load is spread over the unloaded ones.
    """
    p = np.minimum(pressure, cap)
    target = mean * p.size
    for _ in range(_SWEEPS):
        missing = target - p.sum()
        if abs(missing) <= 1e-14 * target:
            break
        below = (p > 0.0) & (p < cap)
        movable = float(p[below].sum())
        if movable + missing > 0.0 and movable > 0.0:
            p[below] *= (movable + missing) / movable
        elif missing < 0.0:
            p *= target / p.sum()
        else:
            p[p < cap] += missing / np.count_nonzero(p < cap)
        np.minimum(p, cap, out=p)
    return p
