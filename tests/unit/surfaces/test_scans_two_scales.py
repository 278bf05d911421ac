"""Maps of two scales: powers of independent maps add, registered maps give the surface back."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.core.errors import InputError
from asperity.generate import SelfAffine, gaussian
from asperity.surfaces import with_fine_detail, with_registered_detail
from asperity.surfaces.characterise.spectrum import power_spectrum, radial_spectrum
from asperity.surfaces.surface import Surface

SPECTRUM = SelfAffine(
    amplitude=asp.generate.RmsHeight(1e-7), hurst=0.6, rolloff_wavelength=64e-6, shortest_wavelength=2e-6
)
EDGES = 2.0 * np.pi / np.array([40e-6, 24e-6, 16e-6, 12e-6, 9e-6, 7e-6, 5e-6])


def coarse(fine: Surface, step: int) -> Surface:
    """Waves of ``fine`` that the coarser grid can hold."""
    nx, ny = fine.shape
    return asp.surfaces.resampled(fine, (nx // step, ny // step))


def rings(surface: Surface) -> RealArray:
    return radial_spectrum(power_spectrum(surface), EDGES).psd


def test_powers_of_maps_from_different_places_add_up() -> None:
    grid = asp.Grid((256, 256), (1e-6, 1e-6))
    wanted, found = np.zeros(EDGES.size - 1), np.zeros(EDGES.size - 1)
    for seed in range(4):
        large = coarse(gaussian(grid, SPECTRUM, seed=seed, variant="fixed"), 2)
        small = gaussian(grid, SPECTRUM, seed=100 + seed, variant="fixed")
        made = with_fine_detail(large, small, crossover=16e-6, seed=seed)
        assert made.shape == grid.shape
        found += rings(made)
        wanted += rings(gaussian(grid, SPECTRUM, seed=seed, variant="fixed"))
    modes = 4.0 * radial_spectrum(power_spectrum(made), EDGES).modes / 2.0
    # random powers of the detail scatter by 1/sqrt(modes); the ring averages of its table by 2 %
    assert found / wanted == pytest.approx(1.0, abs=float(3.0 / np.sqrt(modes.min()) + 0.02))


def test_detail_of_the_same_place_gives_the_surface_back() -> None:
    grid = asp.Grid((256, 256), (1e-6, 1e-6))
    truth = gaussian(grid, SPECTRUM, seed=3)
    large = Surface(coarse(truth, 2).heights, 2e-6, periodic=True)
    part = Surface(truth.heights[40:168, 60:188] + 5e-6 + 1e-3 * 1e-6 * np.arange(128)[:, None], 1e-6)
    made = with_registered_detail(large, part, at=(40e-6, 60e-6), crossover=20e-6)
    inner = (slice(24, 104), slice(24, 104))  # a crossover off the border, where waves are mirrored
    error = made.heights[inner] - truth.heights[40:168, 60:188][inner]
    short = truth.heights[40:168, 60:188][inner] - np.mean(truth.heights[40:168, 60:188][inner])
    assert np.sqrt(np.mean(error**2)) < 0.02 * np.sqrt(np.mean(short**2))


def test_refusals() -> None:
    grid = asp.Grid((64, 64), (1e-6, 1e-6))
    surface = gaussian(grid, SPECTRUM, seed=1)
    tiny = Surface(surface.heights, 1e-8)
    with refused(InputError, "maps of two scales"):
        with_fine_detail(surface, tiny, seed=1)
    with refused(InputError, "crossover of two maps (m)", "1e-06"):
        with_fine_detail(surface, surface, crossover=1e-6, seed=1)
    with refused(InputError, "small map"):
        with_registered_detail(surface, surface, at=(10e-6, 0.0), crossover=10e-6)
