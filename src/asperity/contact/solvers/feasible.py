"""Pressures that respect the bounds and the prescribed load."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray

_SWEEPS = 100


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
