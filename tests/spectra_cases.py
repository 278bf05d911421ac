"""The spectrum of the gold film, and surfaces that meet a spectrum exactly, for tests."""

from __future__ import annotations

import math

import numpy as np

from asperity.core.arrays import RealArray
from asperity.core.grid import Grid
from asperity.surfaces.characterise.spectral_model import SpectralModel
from asperity.surfaces.surface import Surface

GOLD = SpectralModel(
    level=380.0 * 4.0 * math.pi**2, rolloff_wavelength=90.0, exponents=(6.5, 4.6), crossover_wavelength=50.0
)
"""Spectrum of the gold film, lengths in nm: 380 nm⁴ in the convention <h²> = ∫ C d²q."""

GOLD_GRID = Grid((512, 512), (1500.0 / 512.0, 1500.0 / 512.0))
"""Grid of its scan, in nm."""


def with_fixed_amplitudes(psd: RealArray, grid: Grid, seed: int) -> Surface:
    """Periodic surface whose every mode has exactly the power ``psd`` (nx, ny // 2 + 1)."""
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal(grid.shape))
    phases = noise / np.abs(noise)
    heights = np.fft.irfft2(phases * np.sqrt(psd * grid.n_points / grid.pixel_area), s=grid.shape)
    return Surface(heights, *grid.spacing, periodic=True)
