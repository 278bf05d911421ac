"""Spectra and Gaussian surfaces: exact lattice sums, ensemble statistics and reproducibility."""

from functools import cache

import numpy as np
import pytest
from ensemble import periodic_statistics
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.core.spectral import mode_sum
from asperity.generate import ExponentialAutocorrelation, PlateauPSD, RmsHeight, RmsSlope, SelfAffine, gaussian

# Cases of the reference file, in its units (µm, or nm over µm for G3)
CASES = {
    "G1": (
        Grid((128, 128), (0.1, 0.1)),
        SelfAffine(amplitude=PlateauPSD(2e-5), hurst=0.8, rolloff_wavelength=2.9, shortest_wavelength=0.47),
    ),
    "G2": (
        Grid((96, 160), (0.2, 0.1)),
        SelfAffine(
            amplitude=PlateauPSD(3.94784176044e-05), hurst=0.5, rolloff_wavelength=3.3, shortest_wavelength=0.71
        ),
    ),
    "G3": (
        Grid((128, 96), (0.078125, 0.078125)),
        ExponentialAutocorrelation(1.0, 0.5, correlation_length_y=1.0),
    ),
}
ROWS = reference("surfaces_ensemble_gaussian")


def _row_id(row):
    return f"{row['case']}-{row['statistic']}"


def _statistics(heights, spacing):
    """Periodic statistics of one realisation and its extremes."""
    values = periodic_statistics(heights, spacing, ((1, 0), (0, 1), (3, 0), (5, -4)))
    return values | {"max": heights.max() - heights.mean(), "range": np.ptp(heights)}


@cache
def _average(case, realisations):
    grid, spectrum = CASES[case]
    every = [_statistics(gaussian(grid, spectrum, seed=seed).heights, grid.spacing) for seed in range(realisations)]
    return {name: np.mean([one[name] for one in every]) for name in every[0]}


@every_row([row for row in ROWS if "spec" not in row["statistic"]], label=_row_id)
def test_ensemble_average_lies_in_the_acceptance_interval(row):
    average = _average(row["case"], int(row["n_realisations"]))
    name = row["statistic"]
    if name in ("Sp_over_rms", "Sz_over_rms"):
        expected_m0 = next(r for r in ROWS if r["case"] == row["case"] and r["statistic"] == "m0")["expected_exact"]
        rms = 1.0 if row["case"] == "G3" else np.sqrt(expected_m0)
        value = average["max" if name.startswith("Sp") else "range"] / rms
    else:
        value = average[name]
    assert row["lower"] <= value <= row["upper"]


_LATTICE = {
    "m0": lambda qx, qy, dx, dy: 1.0,
    "m2x_fd": lambda qx, qy, dx, dy: (2 / dx * np.sin(qx * dx / 2)) ** 2,
    "m2y_fd": lambda qx, qy, dx, dy: (2 / dy * np.sin(qy * dy / 2)) ** 2,
    "m4x_fd": lambda qx, qy, dx, dy: (2 / dx * np.sin(qx * dx / 2)) ** 4,
    "m4y_fd": lambda qx, qy, dx, dy: (2 / dy * np.sin(qy * dy / 2)) ** 4,
    "m20_spec": lambda qx, qy, dx, dy: qx**2,
    "m02_spec": lambda qx, qy, dx, dy: qy**2,
    "m40_spec": lambda qx, qy, dx, dy: qx**4,
    "m04_spec": lambda qx, qy, dx, dy: qy**4,
    "acf(1,0)": lambda qx, qy, dx, dy: np.cos(qx * dx),
    "acf(0,1)": lambda qx, qy, dx, dy: np.cos(qy * dy),
    "acf(3,0)": lambda qx, qy, dx, dy: np.cos(3 * qx * dx),
}


@every_row([row for row in ROWS if row["statistic"] in _LATTICE], label=_row_id)
def test_lattice_sum_of_the_spectrum_is_the_exact_expectation(row):
    grid, spectrum = CASES[row["case"]]
    weight = _LATTICE[row["statistic"]](*grid.wavevector(), *grid.spacing)
    value = mode_sum(grid, weight * spectrum.lattice_psd(grid))
    assert value == pytest.approx(row["expected_exact"], rel=2e-9)  # the file prints ten digits


def _self_affine(amplitude, **changes):
    values = {"hurst": 0.7, "rolloff_wavelength": 2e-6, "shortest_wavelength": 2e-7, **changes}
    return SelfAffine(amplitude=amplitude, **values)


@pytest.mark.parametrize("shape", [(64, 48), (63, 47)])
def test_amplitudes_are_met_on_the_lattice(shape):
    grid = Grid(shape, (1e-7, 0.8e-7))
    by_height = _self_affine(RmsHeight(3e-9)).lattice_psd(grid)
    by_slope = _self_affine(RmsSlope(0.2)).lattice_psd(grid)
    assert mode_sum(grid, by_height) == pytest.approx(9e-18, rel=1e-13)
    assert mode_sum(grid, grid.wavenumber() ** 2 * by_slope) == pytest.approx(0.04, rel=1e-13)


@pytest.mark.parametrize("hurst", [0.3, 0.8, 1.0])
@pytest.mark.parametrize("longest", [np.inf, 5e-6, 2e-6])
def test_continuous_psd_integrates_to_the_amplitude(hurst, longest):
    q_s, q_l = 2 * np.pi / 2e-7, 0.0 if longest == np.inf else 2 * np.pi / longest
    edges = np.unique(np.concatenate([np.linspace(q_l, np.pi * 1e6, 20001), np.geomspace(np.pi * 1e6, q_s, 20001)]))
    q, step = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    by_height = _self_affine(RmsHeight(1e-9), hurst=hurst, longest_wavelength=longest).psd(q)
    by_slope = _self_affine(RmsSlope(0.1), hurst=hurst, longest_wavelength=longest).psd(q)
    # midpoint rule: error (step/q)²/24 · O(10) of the steps used here < 1e-6
    assert np.sum(q * by_height * step) / (2 * np.pi) == pytest.approx(1e-18, rel=1e-6)
    assert np.sum(q**3 * by_slope * step) / (2 * np.pi) == pytest.approx(1e-2, rel=1e-6)


def test_exponential_psd_has_the_lattice_spectrum_as_its_aliased_sum():
    beta, grid = 20.0, Grid((512, 512), (1.0, 1.0))
    spectrum = ExponentialAutocorrelation(1.0, beta, drop=np.exp(-1))
    lattice = spectrum.lattice_psd(grid)
    q = grid.wavenumber()
    # aliases at 2π/Δ and beyond add less than 1e-3 at the small wavenumbers compared
    low = (q > 0) & (q * beta < 2)
    np.testing.assert_allclose(lattice[low], spectrum.psd(q)[low], rtol=2e-3)


def test_drop_defines_the_correlation_length():
    ten_percent = ExponentialAutocorrelation(1.0, np.log(10.0))
    one_over_e = ExponentialAutocorrelation(1.0, 1.0, drop=np.exp(-1.0))
    assert ten_percent.decay_lengths == pytest.approx((1.0, 1.0), rel=1e-14)
    assert one_over_e.decay_lengths == pytest.approx((1.0, 1.0), rel=1e-14)


def test_generated_surface_is_reproducible_and_recorded():
    grid, spectrum = CASES["G1"]
    one, same, other = (gaussian(grid, spectrum, seed=seed) for seed in (7, 7, 8))
    np.testing.assert_array_equal(one.heights, same.heights)
    assert np.abs(one.heights - other.heights).max() > one.heights.std()
    assert one.periodic
    assert "PCG64 seed 7" in one.origin.history[0]
    assert "Hurst exponent 0.8" in one.origin.history[0]
    assert abs(one.heights.mean()) < 1e-15 * one.heights.std() * one.heights.size


def test_noise_stream_is_that_of_every_machine():
    class White:
        def lattice_psd(self, grid):
            psd = np.full((grid.shape[0], grid.shape[1] // 2 + 1), grid.pixel_area)
            psd[0, 0] = 0.0
            return psd

        def describe(self, grid):
            return "white"

    heights = gaussian(Grid((4, 3), (1.0, 1.0)), White(), seed=0).heights
    # first numbers of numpy's documented PCG64(0) standard normal stream, less their mean
    assert heights[0, 0] - heights[0, 1] == pytest.approx(0.12573022 + 0.13210486, abs=2e-8)
    assert heights[0, 2] - heights[1, 0] == pytest.approx(0.64042265 - 0.10490012, abs=2e-8)


@pytest.mark.parametrize("case", CASES)
def test_exact_rms_rescales_one_realisation(case):
    grid, spectrum = CASES[case]
    surface = gaussian(grid, spectrum, seed=1, exact_rms=True)
    target = mode_sum(grid, spectrum.lattice_psd(grid))
    assert np.mean(surface.heights**2) == pytest.approx(target, rel=1e-12)
    assert "rescaled" in surface.origin.history[0]


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: _self_affine(1e-9), "amplitude of a self-affine spectrum", "1e-09"),
        (lambda: _self_affine(RmsHeight(1e-9), hurst=1.2), "hurst of SelfAffine", "1.2"),
        (lambda: _self_affine(RmsHeight(1e-9), hurst=0.0), "hurst of SelfAffine", "0.0"),
        (
            lambda: _self_affine(RmsHeight(1e-9), shortest_wavelength=3e-6),
            "wavelengths of a self-affine spectrum",
            "3e-06, 2e-06, inf",
        ),
        (
            lambda: _self_affine(RmsHeight(1e-9), longest_wavelength=1e-6),
            "wavelengths of a self-affine spectrum",
            "2e-07, 2e-06, 1e-06",
        ),
        (lambda: RmsHeight(0.0), "value (m) of RmsHeight", "0.0"),
        (lambda: RmsSlope(-1.0), "value of RmsSlope", "-1.0"),
        (lambda: PlateauPSD(np.nan), "value (m^4) of PlateauPSD", "nan"),
        (lambda: ExponentialAutocorrelation(1.0, 1.0, drop=1.0), "drop of ExponentialAutocorrelation", "1.0"),
        (
            lambda: _self_affine(RmsHeight(1e-9)).lattice_psd(Grid((32, 32), (2e-7, 1e-7))),
            "shortest wavelength",
            "2e-07",
        ),
        (lambda: _self_affine(RmsHeight(1e-9)).lattice_psd(Grid((1, 1), (1e-8, 1e-8))), "grid", "1e-08"),
        (lambda: ExponentialAutocorrelation(1.0, 1.0).lattice_psd(Grid((32, 32), (0.05, 0.05))), "grid size", "1.6"),
        (lambda: gaussian(*CASES["G1"], seed=-1), "seed of gaussian()", "-1"),
        (lambda: gaussian(*CASES["G1"], seed=1.5), "seed of gaussian()", "1.5"),
    ],
)
def test_refusals(make, subject, shown):
    with refused(InputError, subject, shown):
        make()
