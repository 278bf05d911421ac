"""Sums over the modes of a periodic grid."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid


def mode_sum(grid: Grid, half: RealArray) -> float:
    """(1/A) Σ over all modes of ``grid`` of a quantity given on the half spectrum (nx, ny // 2 + 1).

    For the spectrum C (m⁴) this is the mean square height (m²); for q²C the mean square gradient.
    """
    columns = half.sum(axis=0)
    weights = np.full(columns.shape, 2.0)
    weights[0] = 1.0
    if grid.shape[1] % 2 == 0:
        weights[-1] = 1.0
    return float(columns @ weights) / grid.area
