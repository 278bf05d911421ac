"""The spline filter of line scans (ISO 16610-22)."""

from __future__ import annotations

import math

import numpy as np

from ..core.arrays import RealArray
from ..core.scipy_parts import linalg, sparse, sparse_linalg

# (I + β⁴ DᵀD) w = z with the second differences D and β = 1/(2 sin(πΔ/λc)); natural ends, circulant
# if closed.


def spline_transmission(spacing: float, cutoff: float, wavelength: RealArray | float) -> RealArray:
    """Amplitude transmission of a wave of ``wavelength``; all lengths in m, wavelengths of at least
    two spacings."""
    waves = np.sin(np.pi * spacing / np.asarray(wavelength, dtype=float)) / math.sin(math.pi * spacing / cutoff)
    return np.asarray(1.0 / (1.0 + waves**4))


def spline_smooth(heights: RealArray, spacing: float, cutoff: float, *, periodic: bool) -> RealArray:
    """Low-pass of ``heights`` (n,) in m at equal ``spacing`` (m) with the ``cutoff`` (m); NaN has
    no weight, and is bridged.

    Exact for a straight line up to the ends of a profile that is not ``periodic``. n points take
    O(n) operations.
    """
    n, valid = heights.size, ~np.isnan(heights)
    if np.count_nonzero(valid) < 2:
        return np.full(n, float(np.nanmean(heights)))
    stiff = 1.0 / (2.0 * math.sin(math.pi * spacing / cutoff)) ** 4
    known = np.where(valid, heights, 0.0)
    mean = float(np.mean(heights[valid]))
    right = np.where(valid, known - mean, 0.0)  # digits of large offsets
    if n < 5 or not periodic:
        middle, first, second = np.zeros(n), np.zeros(max(n - 1, 0)), np.zeros(max(n - 2, 0))
        for row, weight in enumerate((1.0, -2.0, 1.0)):  # of each second difference
            if n < 3:
                break
            middle[row : n - 2 + row] += weight**2
        if n >= 3:
            first[: n - 2] += -2.0
            first[1:] += -2.0
            second += 1.0
        bands = np.zeros((3, n))
        bands[2] = valid + stiff * middle
        bands[1, 1:] = stiff * first
        bands[0, 2:] = stiff * second
        return np.asarray(linalg.solveh_banded(bands[max(0, 3 - n) :], right)) + mean
    every = np.arange(n)
    shifts = {0: 6.0, 1: -4.0, 2: 1.0, n - 2: 1.0, n - 1: -4.0}  # of a circulant
    rows, columns = np.tile(every, len(shifts)), np.concatenate([(every + shift) % n for shift in shifts])
    entries = np.concatenate([stiff * weight + (0.0 if shift else 1.0) * valid for shift, weight in shifts.items()])
    matrix = sparse.coo_array((entries, (rows, columns)), shape=(n, n)).tocsc()
    return np.asarray(sparse_linalg.spsolve(matrix, right), dtype=np.float64) + mean
