"""What finite windows and pixels show of a known spectrum: reference integrals, limits, simulated
maps."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from reference_data import FOLDER, every_row, reference
from refusals import refused
from spectra_cases import with_fixed_amplitudes

import asperity as asp
from asperity.core.errors import InputError
from asperity.surfaces.characterise.moments import difference_moments
from asperity.surfaces.characterise.spectral_model import SpectralModel
from asperity.surfaces.characterise.spectrum import (
    effective_samples,
    expected_difference_moments,
    mean_square_after_levelling,
    power_spectrum,
)

FORMS = ("mean", "plane", "quadratic")


@every_row(
    reference("surfaces_fd_bias"), label=lambda row: f"{row['H']}-{row['qs_over_qr']:g}-{row['lambda_s_over_delta']:g}"
)
def test_differences_of_plateau_and_power_law(row):
    shortest, rolloff = row["lambda_s_over_delta"], row["lambda_s_over_delta"] * row["qs_over_qr"]
    model = SpectralModel(
        level=1.0, rolloff_wavelength=rolloff, exponents=(2.0 + 2.0 * row["H"],), shortest_wavelength=shortest
    )
    m0, m2, m4 = model.moments()
    first, second = expected_difference_moments(
        model.psd, 1.0, shortest_wavelength=shortest, longest_wavelength=1e4 * rolloff, bends=(rolloff,)
    )
    # the second difference cancels four digits where waves are 16 pixels and the range is wide
    assert first / m2 == pytest.approx(row["m2fd_over_m2"], rel=1e-9)
    assert second / m4 == pytest.approx(row["m4fd_over_m4"], rel=1e-8)
    assert m0 * m4 / m2**2 == pytest.approx(row["alpha"], rel=1e-10)
    assert m0 * second / first**2 == pytest.approx(row["alpha_fd"], rel=1e-8)


@every_row(reference("surfaces_sampled_peaks"), label=lambda row: f"{row['delta_over_beta_e']:g}")
def test_differences_of_an_exponential_autocorrelation(row):
    """A periodic surface with exactly this autocovariance shows 2[R(0) - R(Δ)]/Δ² and its like for
    curvature."""
    decay = 1.0 / row["delta_over_beta_e"]
    grid = asp.Grid((16 * math.ceil(decay), 16 * math.ceil(decay)), (1.0, 1.0))
    spectrum = asp.generate.ExponentialAutocorrelation(1.0, decay, drop=math.exp(-1.0))
    surface = with_fixed_amplitudes(spectrum.lattice_psd(grid), grid, seed=1)
    found = difference_moments(surface)
    # the domain of 16 decays clips a negative part of the spectrum, below 1e-10 of the whole
    for m2, m4 in ((found.m2_x, found.m4_x), (found.m2_y, found.m4_y)):
        assert m2 == pytest.approx(row["m2_fd_times_delta2_over_sigma2"], rel=1e-8)
        assert m4 == pytest.approx(row["m4_fd_times_delta4_over_sigma2"], rel=1e-8)


def test_differences_over_a_short_distance_are_derivatives():
    model = SpectralModel(level=1.0, rolloff_wavelength=10.0, exponents=(3.6,), shortest_wavelength=1.0)
    _, m2, m4 = model.moments()
    first, second = expected_difference_moments(
        model.psd, 1e-3, shortest_wavelength=1.0, longest_wavelength=1e5, bends=(10.0,)
    )
    # the leading errors are Δ² m4/12 and Δ² m6/6 with m6 <= q_s² m4
    assert first == pytest.approx(m2, rel=1e-6 * m4 / m2)
    assert second == pytest.approx(m4, rel=1e-6 * 7.0)


@every_row(reference("surfaces_detrend_expectation"), label=lambda row: f"{row['L']:g}-{row['degree_removed']:g}")
def test_levelled_windows(row):
    given = json.loads(row["parameters"])
    if "beta_e" in given:
        shortest = 1e-5

        def psd(q):
            return 2.0 * np.pi * (1.0 + q**2) ** -1.5

    else:
        shortest = given["lambda_s"]
        model = SpectralModel(
            level=1.0,
            rolloff_wavelength=given["lambda_r"],
            exponents=(2.0 + 2.0 * given["H"],),
            shortest_wavelength=shortest,
        )
        variance = model.moments()[0]

        def psd(q):
            return model.psd(q) / variance

    form = FORMS[int(row["degree_removed"])]
    found = mean_square_after_levelling(psd, (row["L"], row["L"]), form, shortest_wavelength=shortest)
    assert found == pytest.approx(row["expected_mean_square"], rel=row["accuracy_rel"])


def scan_size_case():
    given = json.loads((FOLDER / "surfaces_scan_size_model.json").read_text(encoding="utf-8"))
    model = SpectralModel(
        level=1.0,
        rolloff_wavelength=given["lambda_r_um"],
        exponents=(2.0 + 2.0 * given["H"],),
        shortest_wavelength=given["lambda_s_um"],
    )
    return given, model


@every_row(
    [row for row in reference("surfaces_scan_size") if row["expected_exact_continuum_window"] != ""],
    label=lambda row: f"{row['L_um']:g}-{row['quantity']}",
)
def test_windows_of_the_scan_size_study(row):
    given, model = scan_size_case()
    m0, m2, _ = model.moments()
    form = row["quantity"].removeprefix("mean_square_after_")
    shortest = given["lambda_s_um"]
    found = mean_square_after_levelling(model.psd, (row["L_um"],) * 2, form, shortest_wavelength=shortest) / m0
    # the reference integrates on a grid of its own; both are within 1e-3
    assert found == pytest.approx(row["expected_exact_continuum_window"], rel=2e-3)
    assert m2 / m0 == pytest.approx(given["continuum_m2_profile"], rel=1e-9)


def test_a_window_much_longer_than_all_waves_keeps_everything():
    model = SpectralModel(
        level=1.0, rolloff_wavelength=2.0, exponents=(3.6,), shortest_wavelength=1.0, longest_wavelength=4.0
    )
    options = {"shortest_wavelength": 1.0, "longest_wavelength": 4.0}
    kept = mean_square_after_levelling(model.psd, (4000.0, 2000.0), "quadratic", **options)
    assert kept == pytest.approx(model.moments()[0], rel=1e-3)
    # a narrow window in one direction alone loses more than a square one of its long side
    narrow = mean_square_after_levelling(model.psd, (20.0, 2.0), "plane", **options)
    assert narrow < mean_square_after_levelling(model.psd, (20.0, 20.0), "plane", **options)


def test_simulated_windows_agree():
    model = SpectralModel(level=1.0, rolloff_wavelength=64.0, exponents=(3.6,), shortest_wavelength=4.0)
    grid = asp.Grid((512, 512), (1.0, 1.0))
    squares = []
    for seed in range(6):
        surface = asp.generate.gaussian(grid, model, seed=seed)
        windows = [
            asp.levelled(asp.surfaces.cropped(surface, x=(64.0 * i, 64.0 * (i + 1)), y=(64.0 * j, 64.0 * (j + 1))))
            for i in range(8)
            for j in range(8)
        ]
        squares += [asp.roughness.rms_height(window) ** 2 for window in windows]
    expected = mean_square_after_levelling(
        model.psd, (64.0, 64.0), "plane", shortest_wavelength=4.0, longest_wavelength=512.0
    )
    error = np.std(squares) / math.sqrt(len(squares) / 4.0)  # neighbouring windows are correlated
    assert np.mean(squares) == pytest.approx(expected, abs=4.0 * error)
    assert error < 0.05 * expected


def test_effective_number_of_heights():
    """N_eff = 2A/(π β²) of an exponential autocorrelation; the scatter of the mean square is the
    predicted one."""
    grid, decay = asp.Grid((256, 256), (1.0, 1.0)), 6.0
    spectrum = asp.generate.ExponentialAutocorrelation(1.0, decay, drop=math.exp(-1.0))
    surfaces = [asp.generate.gaussian(grid, spectrum, seed=seed) for seed in range(40)]
    found = np.array([effective_samples(power_spectrum(surface)) for surface in surfaces])
    expected = 2.0 * grid.area / (math.pi * decay**2)
    # the estimate scatters by some per cent from map to map
    assert found.mean() == pytest.approx(expected, rel=5.0 * found.std() / found.mean() / math.sqrt(40.0) + 0.02)
    squares = [asp.roughness.rms_height(surface) ** 2 for surface in surfaces]
    # a standard deviation of forty values is uncertain by 1/sqrt(80)
    assert np.std(squares) == pytest.approx(math.sqrt(2.0 / expected), rel=4.0 / math.sqrt(80.0))


def test_effective_samples_of_white_noise_and_of_a_flat():
    noise = asp.Surface(np.random.default_rng(8).standard_normal((128, 96)), 1.0, periodic=True)
    assert effective_samples(power_spectrum(noise)) == pytest.approx(128 * 96, rel=0.05)
    assert math.isnan(effective_samples(power_spectrum(asp.Surface(np.zeros((8, 8)), 1.0))))


def test_refusals():
    model = SpectralModel(level=1.0, rolloff_wavelength=1.0, exponents=(3.0,))
    with refused(InputError, "form to be removed"):
        mean_square_after_levelling(model.psd, (1.0, 1.0), "cubic", shortest_wavelength=0.1)
    with refused(InputError, "side of a window (m)"):
        mean_square_after_levelling(model.psd, (1.0, 0.0), shortest_wavelength=0.1)
    with refused(InputError, "spacing (m)"):
        expected_difference_moments(model.psd, -1.0, shortest_wavelength=0.1, longest_wavelength=1.0)
