"""How much of a map is its tilt, which has to be removed before most numbers mean anything."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ..surface import Surface
from .heights import mean_height


def tilt_share(surface: Surface) -> float:
    """Share of the mean square height that lies in the best plane, 0 to 1; exact for a complete map, 0 for a flat one.

    On a map with holes the fits along x and y are not independent, and the share is an estimate.
    """
    z = np.where(surface.mask, 0.0, surface.heights - mean_height(surface))
    total = float(np.einsum("ij,ij", z, z))
    if total == 0.0:
        return 0.0
    count = surface.grid.n_points - surface.n_missing
    return min(1.0, sum(_explained(z.sum(axis=1 - axis), count) for axis in (0, 1)) / total)


def _explained(sums: RealArray, count: int) -> float:
    """Sum of squares that the line along an axis explains, from the ``sums`` of heights of its lines."""
    x = np.arange(sums.size) - 0.5 * (sums.size - 1)
    spread = float(x @ x) * count / sums.size
    return float(x @ sums) ** 2 / spread if spread > 0.0 else 0.0
