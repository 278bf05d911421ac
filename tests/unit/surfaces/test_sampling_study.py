"""Scan size and sampling interval: reference populations, nested parts, known dependences."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from reference_data import FOLDER, reference
from refusals import refused

import asperity as asp
from asperity import roughness as r
from asperity.core.arrays import RealArray
from asperity.core.errors import InputError
from asperity.core.grid import Grid

GIVEN = json.loads((FOLDER / "surfaces_scan_size_model.json").read_text(encoding="utf-8"))
POPULATION = r.SpectralModel(
    level=1.0,
    rolloff_wavelength=GIVEN["lambda_r_um"],
    exponents=(2.0 + 2.0 * GIVEN["H"],),
    shortest_wavelength=GIVEN["lambda_s_um"],
)
VARIANCE = POPULATION.moments()[0]
NAMES = {
    "beta_e_x_after_plane": ("beta_e_x", 1.0),
    "beta_0.1_x_after_plane": ("beta_01_x", 1.0),
    "m2x_fd_over_m2_continuum": ("m2_x", 1.0 / GIVEN["continuum_m2_profile"]),
    "P-V_after_plane": ("Sz", 1.0),
    "Rp_after_plane": ("Sp", 1.0),
}


@dataclass(frozen=True)
class Sampled:
    """The population at the nodes of a grid too coarse for it: waves beyond the Nyquist wavenumber
    fold back."""

    def lattice_psd(self, grid: Grid) -> RealArray:
        return folded_psd(grid)

    def describe(self, grid: Grid) -> str:
        return "point-sampled"


@cache
def folded_psd(grid: Grid) -> RealArray:
    qx, qy = grid.wavevector()
    fold = [2.0 * np.pi / d for d in grid.spacing]
    reach = [math.ceil(POPULATION.law.high / f) for f in fold]
    psd = sum(
        POPULATION.psd(np.hypot(qx + i * fold[0], qy + j * fold[1]))
        for i in range(-reach[0], reach[0] + 1)
        for j in range(-reach[1], reach[1] + 1)
    )
    psd[0, 0] = 0.0
    return psd / VARIANCE


def window(length: float, seed: int) -> asp.Surface:
    """256 x 256 nodes of the population, cut from a map large enough to be independent of its
    period."""
    pixel = length / 256
    nodes = 256 * math.ceil((length + 2.0 * POPULATION.rolloff_wavelength) / length)
    large = asp.generate.gaussian(asp.Grid((nodes, nodes), (pixel, pixel)), Sampled(), seed=seed)
    return asp.surfaces.cropped(large, x=(0.0, length), y=(0.0, length))


@pytest.mark.parametrize("length", [32.0, 64.0, 128.0])
def test_reference_population(length):
    rows = [row for row in reference("surfaces_scan_size") if row["L_um"] == length]
    surfaces = [window(length, seed) for seed in range(int(rows[0]["n_realisations"]))]
    studies = {
        form: [r.scan_size_study(s, form=form, smallest=256) for s in surfaces]
        for form in ("mean", "plane", "quadratic")
    }
    assert rows
    for row in rows:
        quantity = row["quantity"]
        if quantity.startswith("mean_square_after_"):
            form = quantity.removeprefix("mean_square_after_")
            values = [study.mean["Sq"][0] ** 2 for study in studies[form]]
        else:
            name, factor = NAMES[quantity]
            values = [factor * study.mean[name][0] for study in studies["plane"]]
        # an undefined correlation length is left out of the average, as in the reference
        assert row["lower"] < np.nanmean(values) < row["upper"], quantity


@pytest.fixture(scope="module")
def rough() -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1.0), hurst=0.8, rolloff_wavelength=64.0, shortest_wavelength=0.0
    )
    return asp.generate.gaussian(asp.Grid((256, 256), (1.0, 1.0)), spectrum, seed=2)


def test_the_largest_window_is_the_map(rough):
    study = r.scan_size_study(rough, form="plane")
    whole = asp.levelled(rough, "plane")
    assert study.length.tolist() == [16.0, 32.0, 64.0, 128.0, 256.0]
    assert study.parts.tolist() == [64.0, 64.0, 16.0, 4.0, 1.0]
    assert study.mean["Sq"][-1] == pytest.approx(asp.roughness.rms_height(whole), rel=1e-12)
    assert study.mean["m2_x"][-1] == pytest.approx(r.rms_profile_slope(whole, axis="x") ** 2, rel=1e-12)
    assert math.isnan(study.scatter["Sq"][-1])
    assert np.all(np.diff(study.mean["Sq"]) > 0.0)
    assert np.all(np.diff(study.mean["Sz"]) > 0.0)


def test_windows_by_hand(rough):
    study = r.scan_size_study(rough, form="mean", smallest=64)
    quarters = [rough.heights[i : i + 64, j : j + 64] for i in range(0, 256, 64) for j in range(0, 256, 64)]
    assert study.mean["Sq"][0] == pytest.approx(np.mean([part.std() for part in quarters]), rel=1e-12)
    assert study.scatter["Sq"][0] == pytest.approx(np.std([part.std() for part in quarters], ddof=1), rel=1e-10)


def test_the_slope_falls_with_the_sampling_interval(rough):
    """Picked points keep σ; m2 by differences goes as Δ^(2H-2), m4 as Δ^(2H-4) well above the
    shortest wave."""
    study = r.sampling_interval_study(rough)
    assert study.length.tolist() == [1.0, 2.0, 4.0, 8.0, 16.0]
    assert study.parts.tolist() == [1.0, 4.0, 16.0, 16.0, 16.0]
    assert study.mean["Sq"] == pytest.approx(np.full(5, study.mean["Sq"][0]), rel=0.02)
    ratio = study.mean["m4_x"][:3] / study.mean["m4_x"][1:4]
    assert ratio == pytest.approx(np.full(3, 2.0 ** (4.0 - 1.6)), rel=0.35)  # the range is finite on both sides
    assert study.independent_range("Sq") == (1.0, 16.0)
    assert math.isnan(study.independent_range("m4_x")[0])


def test_averaging_removes_height_and_picking_does_not(rough):
    averaged = r.sampling_interval_study(rough, mode="average")
    assert averaged.kind == "sampling interval, average"
    assert np.all(np.diff(averaged.mean["Sq"]) < 0.0)
    blocks = rough.heights.reshape(64, 4, 64, 4).mean(axis=(1, 3))
    expected = asp.roughness.rms_height(asp.levelled(asp.Surface(blocks, 4.0)))
    assert averaged.mean["Sq"][2] == pytest.approx(expected, rel=1e-12)


def test_holes_and_oblong_maps(rough):
    heights = np.array(rough.heights[:100, :70])
    heights[10:20, 5:9] = np.nan
    surface = asp.Surface(heights, 1.0, 2.0)
    study = r.scan_size_study(surface)
    assert study.length[-1] == pytest.approx(math.sqrt(100.0 * 140.0))
    assert np.all(np.isfinite(study.mean["Sq"]))
    assert np.all(np.isfinite(r.sampling_interval_study(surface, mode="average").mean["Sq"]))


def test_independent_range_of_given_numbers():
    def study(*values: float) -> r.SamplingStudy:
        length = np.arange(1.0, len(values) + 1.0)
        return r.SamplingStudy("scan size", "mean", length, length, {"Sq": np.array(values)}, {"Sq": np.array(values)})

    assert study(1.0, 2.0, 2.04, 2.02, 5.0).independent_range("Sq") == (2.0, 4.0)
    assert study(1.0, 1.04, 1.08, 1.12).independent_range("Sq") == (1.0, 2.0)
    assert study(1.0, math.nan, 1.0, 1.0).independent_range("Sq") == (3.0, 4.0)
    assert math.isnan(study(1.0, 2.0, 4.0).independent_range("Sq")[1])


def test_refusals(rough):
    with refused(InputError, "surface", "16"):
        r.scan_size_study(asp.Surface(np.zeros((8, 100)), 1.0))
    with refused(InputError, "mode of a sampling-interval study"):
        r.sampling_interval_study(rough, mode="skip")
    with refused(InputError, "form to be removed"):
        r.scan_size_study(rough, form="cubic")
    with refused(InputError, "quantity of a study"):
        r.scan_size_study(rough).independent_range("Sa")
