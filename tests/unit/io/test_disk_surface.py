"""Gaussian surfaces beyond the memory equal those made within it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

from asperity.core.errors import InputError, OutputError
from asperity.core.grid import Grid
from asperity.generate import (
    ExponentialAutocorrelation,
    PlateauPSD,
    RmsHeight,
    RmsSlope,
    SelfAffine,
    TabulatedSpectrum,
    TwoSlopes,
    gaussian,
)
from asperity.io.surface_files import BYTES_PER_MODE, save_gaussian

WITHOUT_ROLLOFF = SelfAffine(
    amplitude=RmsHeight(2.0), hurst=0.8, rolloff_wavelength=90.0, shortest_wavelength=4.0, longest_wavelength=90.0
)
SPECTRA = (
    WITHOUT_ROLLOFF,
    SelfAffine(amplitude=PlateauPSD(3.0), hurst=0.5, rolloff_wavelength=30.0, shortest_wavelength=0.0),
    TwoSlopes(amplitude=RmsSlope(0.2), exponents=(3.0, 5.0), rolloff_wavelength=40.0, crossover_wavelength=10.0),
    TabulatedSpectrum([0.1, 1.0, 3.0], [5.0, 0.1, 0.01]),
)
GRID = Grid((96, 64), (1.0, 1.2))


class Watch:
    def __init__(self):
        self.left = []

    def update(self, iteration, error, gap):
        self.left.append(error)


@pytest.mark.parametrize("spectrum", SPECTRA, ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("shape", [(96, 64), (45, 63), (64, 1), (1, 96)])
@pytest.mark.parametrize("columns", [1, 7, 1000])
def test_blocks_are_the_surface_made_as_a_whole(tmp_path, spectrum, shape, columns):
    grid = Grid(shape, (1.0, 1.2))
    memory = BYTES_PER_MODE * max(shape[0], shape[1] // 2 + 1) * columns
    save_gaussian(grid, spectrum, tmp_path / "a.npy", seed=3, memory=memory)
    whole = gaussian(grid, spectrum, seed=3).heights
    # transforms in another order: rounding of some 1e-16 for each of the ten stages
    np.testing.assert_allclose(np.load(tmp_path / "a.npy"), whole, atol=1e-14 * np.abs(whole).max())
    assert [path.name for path in tmp_path.iterdir()] == ["a.npy"]


def test_single_precision_progress_and_files_that_exist(tmp_path):
    watch = Watch()
    made = {"seed": 1, "memory": BYTES_PER_MODE * 96.0 * 8}
    save_gaussian(GRID, WITHOUT_ROLLOFF, tmp_path / "a.npy", **made, precision="single", progress=watch)
    assert np.load(tmp_path / "a.npy").dtype == np.float32
    assert watch.left == sorted(watch.left, reverse=True)
    assert watch.left[-1] == pytest.approx(0.0, abs=1e-12)
    assert len(watch.left) == 2 * math.ceil(96 / 23) + math.ceil(33 / 8)  # rows twice, columns once
    with pytest.raises(OutputError):
        save_gaussian(GRID, WITHOUT_ROLLOFF, tmp_path / "a.npy", **made)


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"spectrum": ExponentialAutocorrelation(1.0, 9.0)}, "spectrum of a surface beyond the memory"),
        ({"memory": 10.0}, "memory of the blocks"),
        ({"seed": -1}, "seed of a random surface"),
        ({"precision": "half"}, "precision of the heights"),
        ({"path": "a.txt"}, "file of a surface"),
        (
            {
                "spectrum": SelfAffine(
                    amplitude=RmsHeight(1.0), hurst=0.8, rolloff_wavelength=9.0, shortest_wavelength=1.0
                )
            },
            "shortest wavelength",
        ),
    ],
)
def test_refusals_leave_no_file(tmp_path, change, subject):
    given = {"spectrum": WITHOUT_ROLLOFF, "path": "a.npy", "seed": 1} | change
    with refused((InputError, OutputError), subject):
        save_gaussian(GRID, given.pop("spectrum"), tmp_path / given.pop("path"), **given)
    assert list(tmp_path.iterdir()) == []
