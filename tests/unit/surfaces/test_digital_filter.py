"""The two-dimensional digital filter: kernel and autocovariance, non-Gaussian input, windows of the
endless surface."""

import numpy as np
import pytest
from ensemble import average, raw_statistics, require_accepted, rows
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import (
    ExponentialAutocorrelation,
    GaussianAutocorrelation,
    PlateauPSD,
    RmsHeight,
    RmsSlope,
    SelfAffine,
    digital_filter,
    endless,
)
from asperity.surfaces.generate.digital_filter import cumulant_factors, filter_kernel, input_noise, zero_phase_weights
from asperity.surfaces.generate.gaussian import block_noise, lattice_eigenvalues

HU_TONDER = reference("surfaces_hu_tonder")
KINDS = {"exp": ExponentialAutocorrelation, "gauss": GaussianAutocorrelation}


def model(row):
    beta = row["beta_star_x_over_delta"]
    return KINDS[row["acf"]](1.0, beta, correlation_length_y=beta / row["beta_x_over_beta_y"])


def row_id(row):
    return f"{row['acf']}-{row['beta_x_over_beta_y']:g}-{row['beta_star_x_over_delta']:g}"


@every_row(HU_TONDER, label=row_id)
def test_cumulant_factors_are_those_of_the_reference(row):
    grid = Grid((512, 512), (1.0, 1.0))
    third, fourth = cumulant_factors(zero_phase_weights(lattice_eigenvalues(model(row), grid), grid))
    assert third == pytest.approx(row["N3"], rel=1e-10)
    assert fourth == pytest.approx(row["N4"], rel=1e-10)
    assert 3.0 - 2.0 * fourth == pytest.approx(row["Sku_min_at_Ssk_0"], rel=1e-10)


def autocovariance(weights):
    """Σ α(k) α(k + r) at the lags 0 … reach, by explicit sums."""
    k, m = weights.shape[0] // 2, weights.shape[1] // 2
    return np.array(
        [
            [np.sum(weights[a:, b:] * weights[: weights.shape[0] - a, : weights.shape[1] - b]) for b in range(m)]
            for a in range(k)
        ]
    )


@pytest.mark.parametrize(
    ("spectrum", "tolerance"),
    [
        (ExponentialAutocorrelation(2.0, 6.0), 2e-4),
        (ExponentialAutocorrelation(1.0, 4.0, correlation_length_y=9.0), 2e-4),
        (GaussianAutocorrelation(1.5, 8.0), 1e-6),
    ],
)
def test_kernel_has_the_autocovariance_asked_for(spectrum, tolerance):
    spacing = (1.0, 0.8)
    kernel = filter_kernel(spectrum, spacing)
    found = autocovariance(kernel.weights)
    x, y = (np.arange(n) * d for n, d in zip(found.shape, spacing, strict=True))
    expected = spectrum.autocovariance(x[:, None], y[None, :])
    worst = np.abs(found - expected).max() / spectrum.rms_height**2
    assert worst <= kernel.error * (1.0 + 1e-9) + 1e-12  # the kernel states its own error
    assert worst < tolerance
    assert kernel.rms_height == pytest.approx(spectrum.rms_height, rel=1e-7)


@pytest.mark.parametrize("amplitude", [RmsHeight(2.0), RmsSlope(0.3), PlateauPSD(50.0)])
def test_kernel_of_a_plateau_spectrum_has_its_continuous_spectrum(amplitude):
    spectrum = SelfAffine(amplitude=amplitude, hurst=0.8, rolloff_wavelength=16.0, shortest_wavelength=4.0)
    kernel = filter_kernel(spectrum, (1.0, 1.0), reach=64.0)
    n = 512
    field = np.zeros((n, n))
    field[: kernel.weights.shape[0], : kernel.weights.shape[1]] = kernel.weights
    grid = Grid((n, n), (1.0, 1.0))
    found, q = np.abs(np.fft.rfft2(field)) ** 2, grid.wavenumber()
    smooth = (q > 0.02) & (q < 2 * np.pi / 4.5) & (np.abs(q - 2 * np.pi / 16.0) > 0.04)
    # the cut kernel ripples by sqrt(tail) = 1 % of the plateau
    np.testing.assert_allclose(found[smooth], spectrum.psd(q)[smooth], atol=0.015 * found.max(), rtol=0.02)
    if isinstance(amplitude, RmsHeight):
        assert kernel.rms_height == pytest.approx(2.0, rel=1e-12)


def test_kernel_refuses_what_does_not_die_out():
    spectrum = SelfAffine(
        amplitude=RmsHeight(1.0), hurst=0.8, rolloff_wavelength=16.0, shortest_wavelength=4.0, longest_wavelength=16.0
    )
    with refused(InputError, "spectrum of a digital filter"):
        filter_kernel(spectrum, (1.0, 1.0))
    with refused(InputError, "reach of a digital filter (m)"):
        filter_kernel(ExponentialAutocorrelation(1.0, 4.0), (1.0, 1.0), reach=0.0)
    with refused(InputError, "pixel of a digital filter"):
        filter_kernel(ExponentialAutocorrelation(1.0, 1e5), (1.0, 1.0))


# non-Gaussian heights


def test_ensemble_of_skewed_heights_meets_its_acceptance_intervals():
    grid, spectrum = Grid((128, 128), (1.0, 1.0)), ExponentialAutocorrelation(1.0, 4.0)
    lags = ((1, 0), (0, 1), (4, 0), (8, 3))

    def statistics(seed):
        made = digital_filter(grid, spectrum, seed=seed, skewness=0.7, kurtosis=5.0, periodic=True)
        return raw_statistics(made.heights, lags)

    require_accepted("G5", average(statistics(seed) for seed in range(int(rows("G5")[0]["n_realisations"]))))


def test_input_noise_of_the_reference_case():
    grid = Grid((128, 128), (1.0, 1.0))
    weights = zero_phase_weights(lattice_eigenvalues(ExponentialAutocorrelation(1.0, 4.0), grid), grid)
    law = input_noise(weights, 0.7, 5.0)
    found = (law.gamma, law.delta, law.xi, law.scale)
    expected = (-0.922806250325, 1.74429626046, -0.822241618596, 1.25911792419)  # given with the acceptance intervals
    assert found == pytest.approx(expected, rel=1e-9)


def test_windows_have_the_moments_on_average():
    """Raw moments over many small windows of one endless surface, against their standard error."""
    made = endless(ExponentialAutocorrelation(1.0, 3.0), (1.0, 1.0), seed=4, skewness=-0.5, kurtosis=4.0)
    powers = np.array(
        [[np.mean(made.window((64, 64), (128 * k, 0)).heights ** p) for p in (1, 2, 3, 4)] for k in range(120)]
    )
    error = powers.std(axis=0, ddof=1) / np.sqrt(len(powers))
    assert np.all(np.abs(powers.mean(axis=0) - [0.0, 1.0, -0.5, 4.0]) < 5.0 * error)


@pytest.mark.parametrize(
    ("skewness", "kurtosis", "subject", "shown"),
    [
        # 3 - 2 N4 + N4/N3², impossible at 16 pixels to the 10 % length
        (-1.0, 4.0, "kurtosis of the heights at skewness -1", "4.623"),
        (0.0, 2.5, "kurtosis of the heights at skewness 0", "2.827"),
        (2.0, 3.0, "kurtosis of the heights", "1 + skewness² = 5"),
    ],
)
def test_what_the_filter_cannot_give_is_refused(skewness, kurtosis, subject, shown):
    grid, spectrum = Grid((128, 128), (1.0, 1.0)), ExponentialAutocorrelation(1.0, 16.0)
    with refused(InputError, subject, shown):
        digital_filter(grid, spectrum, seed=1, skewness=skewness, kurtosis=kurtosis, periodic=True)


@settings(max_examples=30)
@given(beta=st.floats(1.0, 12.0), skewness=st.floats(-2.0, 2.0), above=st.floats(0.05, 20.0))
def test_noise_exists_exactly_where_the_rule_says(beta, skewness, above):
    kurtosis = 1.0 + skewness**2 + above
    grid = Grid((96, 96), (1.0, 1.0))
    weights = zero_phase_weights(lattice_eigenvalues(ExponentialAutocorrelation(1.0, beta), grid), grid)
    third, fourth = cumulant_factors(weights)
    least = 3.0 - 2.0 * fourth + skewness**2 * fourth / third**2
    if kurtosis < least:
        with refused(InputError, f"kurtosis of the heights at skewness {skewness:.4g}", f"{least:.4g}", "rank_ordered"):
            input_noise(weights, skewness, kurtosis)
    elif kurtosis > least + 0.2 * fourth * (1.0 + (skewness / third) ** 2):
        assert input_noise(weights, skewness, kurtosis).delta != 0.0


# windows and tiles

ENDLESS = endless(ExponentialAutocorrelation(1.0, 5.0), (1.0, 1.5), seed=3, skewness=0.3, kurtosis=4.0)


@settings(max_examples=25)
@given(
    first=st.tuples(st.integers(-(10**6), 10**6), st.integers(-300, 300)),
    shape=st.tuples(st.integers(1, 90), st.integers(1, 90)),
    data=st.data(),
)
def test_tiles_equal_the_whole(first, shape, data):
    cut = [data.draw(st.integers(0, n - 1)) for n in shape]
    whole = ENDLESS.window(shape, first).heights
    tile = ENDLESS.window((shape[0] - cut[0], shape[1] - cut[1]), (first[0] + cut[0], first[1] + cut[1])).heights
    # rounding of two transforms of different length: a few 1e-16 of the largest sums
    np.testing.assert_allclose(tile, whole[cut[0] :, cut[1] :], rtol=0.0, atol=1e-13)


def test_window_equals_the_direct_sum():
    """Every node by its definition Σ α(k, l) η(I + k, J + l)."""
    weights = ENDLESS.kernel.weights
    k, m = ENDLESS.kernel.reach
    noise = ENDLESS.noise.of_normal(block_noise((-k, -m), (5 + 2 * k, 4 + 2 * m), 3))
    expected = [[np.sum(weights * noise[i : i + 2 * k + 1, j : j + 2 * m + 1]) for j in range(4)] for i in range(5)]
    np.testing.assert_allclose(ENDLESS.window((5, 4)).heights, expected, rtol=0.0, atol=1e-13)


def test_digital_filter_is_the_window_at_the_origin():
    grid, spectrum = Grid((30, 40), (1.0, 1.5)), ExponentialAutocorrelation(1.0, 5.0)
    made = digital_filter(grid, spectrum, seed=3, skewness=0.3, kurtosis=4.0)
    np.testing.assert_array_equal(made.heights, ENDLESS.window((30, 40)).heights)
    assert not made.periodic
    assert "Philox seed 3" in made.origin.history[0]
    assert {"HuTonder1992", "Johnson1949", "Chilamakuri1998"} <= set(made.citation_keys)
    assert "Johnson1949" not in digital_filter(grid, spectrum, seed=3).citation_keys
    moved = ENDLESS.window((3, 3), (5, -7))
    assert moved.origin.history[-1] == "window from node (5, -7) on"


def test_periodic_filter_wraps():
    grid, spectrum = Grid((64, 48), (1.0, 1.0)), ExponentialAutocorrelation(1.0, 3.0)
    made = digital_filter(grid, spectrum, seed=2, periodic=True)
    weights = np.fft.irfft2(np.sqrt(lattice_eigenvalues(spectrum, grid)), s=grid.shape)
    noise = block_noise((0, 0), grid.shape, 2)
    direct = sum(
        weights[k, m] * np.roll(noise, (k, m), axis=(0, 1))
        for k in range(64)
        for m in range(48)
        if abs(weights[k, m]) > 1e-9
    )
    np.testing.assert_allclose(made.heights, direct, atol=64 * 48 * 1e-9 * 5.0)
    assert made.periodic


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: endless(ExponentialAutocorrelation(1.0, 3.0), (1.0, 1.0), seed=-1), "seed of a random surface"),
        (
            lambda: endless(ExponentialAutocorrelation(1.0, 3.0), (1.0, 0.0), seed=1),
            "pixel of an endless surface along y (m)",
        ),
        (lambda: ENDLESS.window((0, 4)), "number of points along x"),
        (lambda: ENDLESS.window((4, 4), (0.5, 0)), "first node along x"),
        (
            lambda: digital_filter(
                Grid((8, 8), (1.0, 1.0)), ExponentialAutocorrelation(1.0, 30.0), seed=1, periodic=True
            ),
            "grid size",
        ),
    ],
)
def test_refusals(make, subject):
    with refused(InputError, subject):
        make()
