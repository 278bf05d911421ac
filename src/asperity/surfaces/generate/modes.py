"""Sums over the modes of a periodic grid."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid


def mode_sum(grid: Grid, half: RealArray) -> float:
    """(1/A) Σ over all modes of ``grid`` of a quantity given on the half spectrum (nx, ny // 2 + 1).

    For the spectrum C (m⁴) this is the mean square height (m²); for q²C the mean square gradient.
    """
    return float(half.sum(axis=0) @ multiplicity(grid)) / grid.area


def multiplicity(grid: Grid) -> RealArray:
    """How many modes of the full plane each column (ny // 2 + 1,) of a half spectrum stands for."""
    weights = np.full(grid.shape[1] // 2 + 1, 2.0)
    weights[0] = 1.0
    if grid.shape[1] % 2 == 0:
        weights[-1] = 1.0
    return weights


def mean_square(grid: Grid, psd: RealArray) -> float:
    """Mean square height in m² of the spectrum C on the modes of ``grid`` in m⁴.

    Raises
    ------
    InputError
        If it is zero.
    """
    square = mode_sum(grid, psd)
    if not square > 0.0:
        raise InputError("spectrum of a random surface must be positive at some mode, but is zero on this grid.")
    return square
