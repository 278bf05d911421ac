"""Band-limited rough surfaces of the reference values in tests/reference/sharp, on any grid."""

from __future__ import annotations

import numpy as np
from reference_data import Row, reference

from asperity.core.arrays import RealArray

SIDE, SLOPE, E_STAR = 1e-6, 0.1, 1e9
"""Side in m, rms slope and contact modulus in Pa."""

UNIT = SLOPE * E_STAR
"""Unit of pressures and stresses in the tables, Pa."""


def rough_heights(points: int, row: Row, *, slope: float = SLOPE, hurst: float = 0.8) -> RealArray:
    """Periodic heights (points, points) in m with waves ``q_low`` to ``q_high`` per side, the same
    surface on every grid."""
    low, high = float(row["q_low"]), float(row["q_high"])
    rng, few = np.random.default_rng(int(float(row["seed"]))), 2 * int(high) + 2
    waves = np.fft.fftfreq(few, 1 / few)
    number = np.hypot(*np.meshgrid(waves, waves, indexing="ij"))
    inside = (number >= low) & (number <= high)
    amplitude = np.where(inside, np.where(number > 0.0, number, 1.0) ** (-1.0 - hurst), 0.0)
    noise = np.fft.fft2(rng.standard_normal((few, few)))
    spectrum = amplitude * noise / np.abs(noise)
    spectrum *= slope / np.sqrt((np.abs(spectrum) ** 2 * (2.0 * np.pi * number / SIDE) ** 2).sum())
    padded, places = np.zeros((points, points), complex), waves.astype(int) % points
    padded[np.ix_(places, places)] = spectrum
    return np.fft.ifft2(padded).real * points**2


def rough_rows(name: str) -> list[Row]:
    """Rows of the table ``rough_<name>``."""
    return reference(f"sharp/rough_{name}")
