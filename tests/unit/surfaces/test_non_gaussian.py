"""Translation and rank ordering: heights, spectra, acceptance intervals, and what cannot be had."""

import numpy as np
import pytest
from ensemble import average, raw_statistics, require_accepted, rows
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused
from scipy.special import ndtr

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.core.pearson import Pearson
from asperity.core.spectral import mode_sum
from asperity.generate import (
    ExponentialAutocorrelation,
    GaussianAutocorrelation,
    HeightMoments,
    HeightsOf,
    RmsHeight,
    SelfAffine,
    TabulatedSpectrum,
    TwoLevels,
    endless,
    gaussian,
    rank_ordered,
    spectrum_of,
    translated,
)
from asperity.surfaces.characterise.heights import height_parameters
from asperity.surfaces.characterise.spectrum import power_spectrum
from asperity.surfaces.generate.digital_filter import cumulant_factors
from asperity.surfaces.surface import Surface

GRID = Grid((128, 128), (1.0, 1.0))
ROUGH = ExponentialAutocorrelation(1.0, 6.4)
BAND = SelfAffine(amplitude=RmsHeight(2.0), hurst=0.8, rolloff_wavelength=25.0, shortest_wavelength=8.0)


def lagged(heights, lag):
    return np.mean(heights * np.roll(heights, (-lag[0], -lag[1]), axis=(0, 1)))


# translation


def test_translation_ensemble_meets_its_acceptance_intervals():
    spectrum, lags = ExponentialAutocorrelation(1.0, 8.0), ((1, 0), (0, 1), (4, 0), (8, 3))

    def statistics(seed):
        made = translated(GRID, spectrum, seed=seed, skewness=0.7, kurtosis=5.0, predistorted=False)
        return raw_statistics(made.heights, lags)

    require_accepted("G7", average(statistics(seed) for seed in range(int(rows("G7")[0]["n_realisations"]))))


@pytest.mark.slow
def test_predistorted_translation_has_the_autocovariance_asked_for():
    """Mean over 60 realisations against R, with the standard error of those realisations."""
    spectrum = ExponentialAutocorrelation(2.0, 8.0, correlation_length_y=5.0)
    lags = ((1, 0), (0, 2), (3, 3), (8, 0))
    found = np.array(
        [
            [lagged(translated(GRID, spectrum, seed=s, skewness=-1.0, kurtosis=4.0).heights, lag) for lag in lags]
            for s in range(60)
        ]
    )
    expected = [float(spectrum.autocovariance(np.array(float(k)), np.array(float(m)))) for k, m in lags]
    error = found.std(axis=0, ddof=1) / np.sqrt(len(found))
    assert np.all(np.abs(found.mean(axis=0) - expected) < 4.5 * error)


def test_translation_without_predistortion_is_off_by_what_theory_says():
    # ρ_G = 0.5 becomes 0.484 for (-1, 4) (Johnson reference file); one neighbour away at this
    # length ρ_G = 0.5
    spectrum = ExponentialAutocorrelation(1.0, np.log(10.0) / np.log(2.0))
    found = np.array(
        [
            lagged(translated(GRID, spectrum, seed=s, skewness=-1.0, kurtosis=4.0, predistorted=False).heights, (1, 0))
            for s in range(100)
        ]
    )
    error = found.std(ddof=1) / np.sqrt(found.size)
    assert found.mean() == pytest.approx(0.484112207599, abs=4.5 * error)
    assert abs(found.mean() - 0.5) > 4.5 * error


@pytest.mark.parametrize(("moments", "kind"), [((0.7, 5.0), "IV"), ((-0.8, 2.6), "I"), ((2.0, 9.0), "III")])
def test_translation_to_a_curve_of_pearsons_system(moments, kind):
    made = translated(
        GRID, ROUGH, seed=3, skewness=moments[0], kurtosis=moments[1], system="pearson", predistorted=False
    )
    assert f"(Pearson's type {kind})" in made.origin.history[0]
    assert {"Pearson1895", "Pearson1916"} <= set(made.citation_keys)
    # heights of the same seed before the translation are normal numbers: equal ranks, and equal
    # probabilities below
    field = translated(GRID, ROUGH, seed=3, skewness=0.0, kurtosis=3.0, predistorted=False).heights
    law = Pearson(*moments)
    np.testing.assert_allclose(law.cdf(made.heights), ndtr(field), rtol=1e-5)  # spline 1e-8, times the density


@pytest.mark.parametrize("moments", [(0.7, 5.0), (-0.8, 2.6), (0.0, 1.8)])
def test_rank_ordered_heights_are_quantiles_of_pearsons_system(moments):
    made = rank_ordered(GRID, ROUGH, HeightMoments(*moments, system="pearson"), seed=1, max_iterations=30)
    wanted = Pearson(*moments).quantile((np.arange(GRID.n_points) + 0.5) / GRID.n_points)
    wanted = (wanted - wanted.mean()) / wanted.std()
    np.testing.assert_allclose(np.sort(made.heights.ravel()) / made.heights.std(), wanted, rtol=1e-6, atol=1e-7)


def test_pearsons_digital_filter_has_noise_of_the_raised_moments():
    made = endless(ROUGH, (1.0, 1.0), seed=1, skewness=0.1, kurtosis=3.2, system="pearson")
    third, fourth = cumulant_factors(made.kernel.weights)
    assert made.noise.skewness == pytest.approx(0.1 / third, rel=1e-12)
    assert made.noise.kurtosis == pytest.approx(3.0 + 0.2 / fourth, rel=1e-12)


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: HeightMoments(0.0, 0.5, system="pearson"), "kurtosis of the heights", "1 + skewness² = 1"),
        (lambda: HeightMoments(1.0, 2.0, system="pearson"), "kurtosis of the heights", "1 + skewness² = 2"),
        (lambda: HeightMoments(0.0, 3.0, system="burr"), "system of HeightMoments", "johnson, pearson"),
        (
            lambda: translated(GRID, ROUGH, seed=1, skewness=1.0, kurtosis=1.5, system="pearson"),
            "kurtosis of the heights",
            "1 + skewness² = 2",
        ),
    ],
)
def test_what_no_curve_of_the_system_has_is_refused(make, subject, shown):
    with refused(InputError, subject, shown):
        make()


def test_translation_to_gaussian_heights_is_a_gaussian_surface():
    spectrum = ExponentialAutocorrelation(3.0, 8.0)
    made = translated(GRID, spectrum, seed=4, skewness=0.0, kurtosis=3.0)
    same = gaussian(GRID, spectrum, seed=4)
    np.testing.assert_allclose(made.heights - made.heights.mean(), same.heights, atol=1e-7)  # table of the correlations
    assert "translation" in made.origin.history[0]


def test_translation_that_no_gaussian_field_can_give_is_refused():
    # a wave has the correlation -1 at half its length, which skewed heights never reach
    wave = TabulatedSpectrum([0.37, 0.39, 0.40], [0.0, 1.0, 1.0])
    with refused(InputError, "autocorrelation of these heights"):
        translated(Grid((160, 4), (1.0, 1.0)), wave, seed=1, skewness=2.0, kurtosis=9.0)
    with refused(InputError, "autocorrelation of the Gaussian field", "rank_ordered()"):
        translated(GRID, GaussianAutocorrelation(1.0, 12.0), seed=1, skewness=3.0, kurtosis=16.0)
    with refused(InputError, "kurtosis of the heights", "1"):
        translated(GRID, ROUGH, seed=1, skewness=2.0, kurtosis=4.0)


# rank ordering


def test_rank_ordered_surfaces_meet_their_requirements():
    eigenvalues = np.fft.rfft2(ROUGH.autocovariance(*(lags(n) for n in ("x", "y")))).real
    eigenvalues[0, 0] = 0.0
    wanted = np.sqrt(GRID.n_points * eigenvalues)
    autocovariance = np.fft.irfft2(eigenvalues, s=GRID.shape)

    def statistics(seed):
        z = rank_ordered(GRID, ROUGH, HeightMoments(-1.0, 4.0), seed=seed).heights
        modes = np.abs(np.fft.rfft2(z))
        found = np.fft.irfft2(modes**2, s=GRID.shape) / GRID.n_points
        m0 = np.mean(z**2)
        return {
            "m0": m0,
            "Ssk": np.mean(z**3) / m0**1.5,
            "Sku": np.mean(z**4) / m0**2,
            "rel_amplitude_error": np.sqrt(mode_sum(GRID, (modes - wanted) ** 2) / mode_sum(GRID, wanted**2)),
            "max_acf_error_over_m0": np.abs(found - autocovariance).max() / m0,
            "m2x_fd": np.mean((np.roll(z, -1, 0) - z) ** 2),
        }

    require_accepted("G6", average(statistics(seed) for seed in range(int(rows("G6")[0]["n_realisations"]))))


def lags(axis):
    steps = np.minimum(np.arange(128), 128 - np.arange(128)).astype(float)
    return steps[:, None] if axis == "x" else steps[None, :]


@pytest.mark.parametrize("moments", [(0.0, 1.5), (0.0, 2.0), (0.7, 5.0), (-2.0, 10.0), (1.0, 2.5)])
def test_moments_that_the_filter_cannot_give(moments):
    made = rank_ordered(GRID, ROUGH, HeightMoments(*moments), seed=2)
    found = height_parameters(made)
    # quantiles at (k - 1/2)/N leave out the tails beyond the outermost: 1 % of the fourth moment of
    # the longest tail here
    assert found.Ssk == pytest.approx(moments[0], abs=0.01 * max(1.0, abs(moments[0])))
    assert found.Sku == pytest.approx(moments[1], rel=0.02)
    assert found.Sq**2 == pytest.approx(mode_sum(GRID, ROUGH.lattice_psd(GRID)), rel=1e-12)


def test_last_step_decides_what_is_exact():
    heights = rank_ordered(GRID, BAND, HeightMoments(0.7, 5.0), seed=1, max_iterations=300)
    spectrum = rank_ordered(GRID, BAND, HeightMoments(0.7, 5.0), seed=1, max_iterations=300, last="spectrum")
    expected = HeightMoments(0.7, 5.0).sorted_heights(GRID.n_points)
    expected = (expected - expected.mean()) / expected.std() * 2.0
    np.testing.assert_allclose(np.sort(heights.heights, axis=None), expected, atol=1e-12)
    psd = BAND.lattice_psd(GRID)
    np.testing.assert_allclose(power_spectrum(spectrum).psd, psd, rtol=1e-8, atol=1e-14 * psd.max())
    found = height_parameters(spectrum)
    unit = expected / 2.0
    off = np.sqrt(np.mean((np.sort(spectrum.heights, axis=None) / 2.0 - unit) ** 2))
    assert off < 0.02
    # by the inequality of Cauchy and Schwarz, to first order
    assert found.Ssk == pytest.approx(np.mean(unit**3), abs=3.0 * off * np.sqrt(np.mean(unit**4)))
    assert found.Sku == pytest.approx(np.mean(unit**4), abs=4.0 * off * np.sqrt(np.mean(unit**6)))
    assert "amplitudes to" in heights.origin.history[0]
    assert "heights to" in spectrum.origin.history[0]
    assert {"Schreiber1996", "PerezRafols2019", "Johnson1949", "Jacobs2017"} <= set(heights.citation_keys)


def test_heights_of_a_measured_surface_and_its_spectrum_at_once():
    """More like this one: the round trip of spectrum and heights of a skewed surface, on a larger
    grid."""
    x, y = np.arange(96)[:, None], np.arange(64)[None, :]
    base = gaussian(Grid((96, 64), (1.0, 1.5)), ExponentialAutocorrelation(1.0, 5.0), seed=1).heights
    seen = Surface(np.exp(0.6 * base) + 0.0 * x * y, 1.0, 1.5, periodic=True)
    made = rank_ordered(Grid((144, 128), (1.0, 1.5)), spectrum_of(seen, isotropic=False), HeightsOf(seen), seed=3)
    measured, found = height_parameters(seen), height_parameters(made)
    assert found.Ssk == pytest.approx(measured.Ssk, rel=0.02)  # quantiles of the outermost of 6144 points
    assert found.Sku == pytest.approx(measured.Sku, rel=0.05)
    assert found.Sq == pytest.approx(measured.Sq, rel=0.05)  # sum over modes interpolated between those measured


def test_two_levels_make_two_maxima():
    made = rank_ordered(GRID, ROUGH, TwoLevels(0.4, 4.0), seed=1)
    p, d = 0.4, 4.0
    variance = 1.0 + p * (1 - p) * d**2
    third = p * (1 - p) * (1 - 2 * p) * d**3 / variance**1.5
    fourth = (3.0 + 6.0 * p * (1 - p) * d**2 + p * (1 - p) * (1 - 3 * p + 3 * p**2) * d**4) / variance**2
    found = height_parameters(made)
    assert found.Ssk == pytest.approx(third, abs=2e-3)
    assert found.Sku == pytest.approx(fourth, rel=2e-3)
    scale = found.Sq / np.sqrt(variance)
    lower, between, upper = (
        np.mean(np.abs(made.heights / scale - z) < 0.2) for z in (-p * d, 0.5 * d - p * d, d - p * d)
    )
    assert between < 0.5 * min(lower, upper)


@settings(max_examples=15)
@given(share=st.floats(0.05, 0.95), separation=st.floats(0.5, 8.0), width=st.floats(0.2, 3.0))
def test_two_levels_have_the_moments_of_their_mixture(share, separation, width):
    z = TwoLevels(share, separation, width).sorted_heights(20000)
    assert (np.diff(z) >= 0.0).all()
    assert z.mean() == pytest.approx(share * separation, abs=2e-3 * (1 + separation))
    variance = (1 - share) + share * width**2 + share * (1 - share) * separation**2
    assert z.var() == pytest.approx(variance, rel=5e-3)


def test_waves_of_one_length_cannot_carry_gaussian_heights():
    wave = TabulatedSpectrum([0.37, 0.39, 0.40], [0.0, 1.0, 1.0])  # a single wave along x: kurtosis 1.5
    with refused(InputError, "spectrum and distribution of the heights"):
        rank_ordered(Grid((160, 4), (1.0, 1.0)), wave, HeightMoments(0.0, 3.0), seed=1)


def test_rank_ordering_is_reproducible():
    one, same, other = (rank_ordered(GRID, ROUGH, HeightMoments(0.5, 4.0), seed=s) for s in (7, 7, 8))
    np.testing.assert_array_equal(one.heights, same.heights)
    assert np.abs(one.heights - other.heights).max() > 1.0
    assert "PCG64 seed 7" in one.origin.history[0]


class Watch:
    def __init__(self):
        self.seen = []

    def update(self, iteration, error, tolerance):
        self.seen.append((iteration, error))


def test_rank_ordering_reports_its_progress_and_stops_where_told():
    watch = Watch()
    made = rank_ordered(GRID, ROUGH, HeightMoments(0.5, 4.0), seed=7, max_iterations=5, progress=watch)
    assert [iteration for iteration, _ in watch.seen] == [1, 2, 3, 4, 5]
    assert "5 iterations, not settled" in made.origin.history[0]


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: HeightMoments(1.0, 1.9), "kurtosis of the heights"),
        (lambda: TwoLevels(1.0, 3.0), "share of TwoLevels"),
        (lambda: TwoLevels(0.5, 0.0), "separation of TwoLevels"),
        (lambda: rank_ordered(GRID, ROUGH, HeightMoments(), seed=1, last="both"), "last of rank_ordered()"),
        (
            lambda: rank_ordered(GRID, ROUGH, HeightMoments(), seed=1, max_iterations=0),
            "max_iterations of rank_ordered()",
        ),
    ],
)
def test_refusals(make, subject):
    with refused(InputError, subject):
        make()
