"""More like this one: spectra from tables and from surfaces, and the round trip."""

import numpy as np
import pytest
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.core.spectral import mode_sum
from asperity.generate import (
    ExponentialAutocorrelation,
    GaussianAutocorrelation,
    RmsHeight,
    SelfAffine,
    TabulatedSpectrum,
    digital_filter,
    flat,
    gaussian,
    spectrum_of,
)
from asperity.surfaces.characterise.moments import difference_moments, spectral_moments
from asperity.surfaces.characterise.spectrum import power_spectrum
from asperity.surfaces.surface import Surface

BAND = SelfAffine(amplitude=RmsHeight(2.0), hurst=0.7, rolloff_wavelength=25.0, shortest_wavelength=4.0)


def test_table_is_a_power_law_between_its_rows():
    q = np.geomspace(0.1, 10.0, 7)
    table = TabulatedSpectrum(q, 3.0 * q**-3.4)
    between = np.array([0.1, 0.37, 2.2, 10.0])
    np.testing.assert_allclose(table.interpolated(between), 3.0 * between**-3.4, rtol=1e-12)
    np.testing.assert_array_equal(table.interpolated(np.array([0.0, 10.1])), [0.0, 0.0])
    assert table.interpolated(np.array(0.01)) == pytest.approx(3.0 * 0.1**-3.4)
    assert table.correlation_range == pytest.approx(2 * np.pi / 0.1)


@pytest.mark.parametrize("shape", [(48, 64), (45, 63)])
@pytest.mark.parametrize("anisotropic", [False, True])
def test_spectrum_of_a_periodic_surface_is_met_mode_by_mode(shape, anisotropic):
    model = ExponentialAutocorrelation(1.0, 3.0, correlation_length_y=5.0) if anisotropic else BAND
    seen = gaussian(Grid(shape, (1.0, 1.1)), model, seed=1)
    again = gaussian(seen.grid, spectrum_of(seen, isotropic=False), seed=2, variant="fixed")
    expected = power_spectrum(seen).psd
    np.testing.assert_allclose(power_spectrum(again).psd, expected, rtol=1e-9, atol=1e-12 * expected.max())
    assert np.abs(again.heights - seen.heights).max() > seen.heights.std()


def test_moments_survive_the_round_trip_to_another_grid():
    """Isotropic, on half the pixel and another size: the moments of the ensemble the first surface
    was drawn from.

    The first map holds N_eff independent heights, so its own moments scatter by sqrt(2/N_eff) (10 %
    here).
    """
    grid = Grid((192, 192), (1.0, 1.0))
    seen = gaussian(grid, BAND, seed=4, variant="fixed")
    first = spectral_moments(power_spectrum(seen))
    finer = Grid((400, 360), (0.5, 0.5))
    psd = spectrum_of(seen, per_decade=40).lattice_psd(finer)
    q = finer.wavenumber()
    assert mode_sum(finer, psd) == pytest.approx(first.m00, rel=0.05)  # rings against single modes near the roll-off
    assert 0.5 * mode_sum(finer, q**2 * psd) == pytest.approx(0.5 * (first.m20 + first.m02), rel=0.03)
    assert 0.5 * mode_sum(finer, q**4 * psd) == pytest.approx(0.5 * (first.m40 + 2 * first.m22 + first.m04), rel=0.05)


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 1.5)])
def test_isotropic_average_keeps_the_shortest_waves_of_the_grid(spacing):
    """A quarter of the mean square slope of an exponential surface lies beyond the Nyquist circle,
    along the diagonals."""
    seen = gaussian(Grid((256, 256), spacing), ExponentialAutocorrelation(1.0, 6.4), seed=1)
    psd, q = spectrum_of(seen).lattice_psd(seen.grid), seen.grid.wavenumber()
    measured = power_spectrum(seen).psd
    outside = q > np.pi / max(spacing)
    assert mode_sum(seen.grid, q**2 * measured * outside) > 0.2 * mode_sum(seen.grid, q**2 * measured)
    # rings keep their power; how it lies within their width of 12 % counts for less than a
    # hundredth of that in the slope
    for power, tolerance in ((0, 1e-3), (2, 2e-3), (4, 5e-3)):
        assert mode_sum(seen.grid, q**power * psd) == pytest.approx(
            mode_sum(seen.grid, q**power * measured), rel=tolerance
        )


@pytest.mark.parametrize("model", [BAND, GaussianAutocorrelation(1.0, 20.0)], ids=["cut off", "steep"])
def test_isotropic_average_keeps_the_power_of_its_rings(model):
    """Means over rings alone would lose a tenth of the mean square curvature where the spectrum is
    cut off."""
    seen = gaussian(Grid((256, 256), (1.0, 1.0)), model, seed=1)
    psd, q, measured = spectrum_of(seen).lattice_psd(seen.grid), seen.grid.wavenumber(), power_spectrum(seen).psd
    for power, tolerance in ((0, 1e-3), (2, 5e-3), (4, 1e-2)):
        assert mode_sum(seen.grid, q**power * psd) == pytest.approx(
            mode_sum(seen.grid, q**power * measured), rel=tolerance
        )


def test_window_keeps_the_tail_of_a_scan_that_is_not_periodic():
    """Without a window the jump between the borders would raise the mean square curvature many
    times."""
    model = SelfAffine(amplitude=RmsHeight(2.0), hurst=0.9, rolloff_wavelength=40.0, shortest_wavelength=4.0)
    grid = Grid((160, 160), (1.0, 1.0))
    expected = mode_sum(grid, grid.wavenumber() ** 4 * model.lattice_psd(grid))
    found, without = [], []
    for seed in range(6):
        seen = gaussian(grid, model, seed=seed, periodic=False)
        for kind, results in (("auto", found), ("none", without)):
            psd = spectrum_of(seen, window=kind).lattice_psd(grid)
            results.append(mode_sum(grid, grid.wavenumber() ** 4 * psd))
    assert np.mean(found) == pytest.approx(expected, rel=0.15)
    assert np.mean(without) > 3.0 * expected


def test_lowest_modes_of_a_windowed_scan_are_replaced():
    seen = gaussian(Grid((96, 96), (1.0, 1.0)), BAND, seed=2, periodic=False)
    tilted = Surface(seen.heights + 50.0, 1.0)
    rings = spectrum_of(tilted)
    assert rings.q[0] * 96.0 / (2 * np.pi) >= 2.5
    plane = spectrum_of(tilted, isotropic=False).lattice_psd(seen.grid)
    assert plane[1, 0] == plane[0, 1] == plane[2, 1] > 0.0


def test_floor_is_subtracted():
    grid, sigma = Grid((128, 128), (1.0, 1.0)), 0.3
    noise = sigma * np.random.default_rng(1).standard_normal(grid.shape)
    base = gaussian(grid, GaussianAutocorrelation(1.0, 9.0), seed=3)
    noisy = Surface(base.heights + noise, 1.0, periodic=True)
    q = grid.wavenumber()
    with_floor = mode_sum(grid, q**2 * spectrum_of(noisy).lattice_psd(grid))
    without = mode_sum(grid, q**2 * spectrum_of(noisy, floor=sigma**2).lattice_psd(grid))
    expected = mode_sum(grid, q**2 * power_spectrum(base).psd)
    # rings of N modes scatter by sqrt(2/N) of the floor, the widest, which matter most, by less
    # than 3 %
    assert with_floor > 3.0 * expected
    assert without == pytest.approx(expected, abs=0.1 * (with_floor - expected))


def test_endless_surface_like_a_measured_one():
    seen = gaussian(Grid((256, 256), (1.0, 1.0)), BAND, seed=5)
    made = digital_filter(Grid((300, 250), (1.0, 1.0)), spectrum_of(seen), seed=1)
    first, second = difference_moments(seen), difference_moments(made)
    assert second.m0 == pytest.approx(first.m0, rel=0.4)  # σ² of either scatters by sqrt(2/N_eff) = 8 %
    assert second.m2 == pytest.approx(first.m2, rel=0.1)


def test_origin_names_the_measured_surface():
    seen = gaussian(Grid((64, 64), (1.0, 1.0)), BAND, seed=1)
    made = gaussian(Grid((32, 32), (1.0, 1.0)), spectrum_of(seen), seed=1)
    assert "radial spectrum of gaussian" in made.origin.history[0]
    assert "Jacobs2017" in made.citation_keys


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: TabulatedSpectrum([1.0], [1.0]), "table of a spectrum", "(1,)"),
        (lambda: TabulatedSpectrum([1.0, 2.0], [1.0, 2.0, 3.0]), "table of a spectrum", "(3,)"),
        (lambda: TabulatedSpectrum([2.0, 1.0], [1.0, 2.0]), "wavenumbers of a spectrum (rad/m)", "ascending"),
        (lambda: TabulatedSpectrum([0.0, 1.0], [1.0, 2.0]), "wavenumbers of a spectrum (rad/m)", "ascending"),
        (lambda: TabulatedSpectrum([1.0, 2.0], [0.0, 0.0]), "spectrum C (m^4) of a table", "positive"),
        (lambda: TabulatedSpectrum([1.0, 2.0], [-1.0, 1.0]), "spectrum C (m^4) of a table", "negative"),
        (lambda: spectrum_of(flat(Grid((8, 8), (1.0, 1.0)))), "surface whose spectrum is to be generated", "0 m^4"),
        (
            lambda: spectrum_of(gaussian(Grid((64, 64), (1.0, 1.0)), BAND, seed=1), floor=1e9),
            "surface whose spectrum is to be generated",
            "1e+09 m^4",
        ),
        (
            lambda: spectrum_of(gaussian(Grid((64, 64), (1.0, 1.0)), BAND, seed=1), floor=-1.0),
            "floor (m^4) of spectrum_of()",
            "-1.0",
        ),
    ],
)
def test_refusals(make, subject, shown):
    with refused(InputError, subject, shown):
        make()
