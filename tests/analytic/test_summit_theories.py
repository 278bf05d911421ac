"""Summits of Gaussian surfaces and peaks of Gaussian profiles against quadrature, simulation and
closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from scipy.integrate import dblquad, quad

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories.rough.profile_peaks import SampledPeaks
from asperity.theories.statistics.nayak import GEOMETRIC_CURVATURE, NayakSummits

SUMMITS = {
    "density_times_m2_over_m4": lambda n: n.density * n.m2 / n.m4,
    "mean_height": lambda n: n.mean_height,
    "std_height": lambda n: n.height_deviation,
    "skew_height": lambda n: n.height_skewness,
    "kurt_height": lambda n: n.height_kurtosis,
    "mean_curvature": lambda n: n.mean_curvature / math.sqrt(n.m4),
    "std_curvature": lambda n: n.curvature_deviation / math.sqrt(n.m4),
    "mean_geometric_curvature": lambda n: n.mean_geometric_curvature / math.sqrt(n.m4),
    "corr_height_curvature": lambda n: n.height_curvature_correlation,
}
PEAKS = {
    "peak_fraction": lambda p: p.fraction,
    "mean_peak_height": lambda p: p.mean_height,
    "std_peak_height": lambda p: p.height_deviation,
    "mean_peak_curvature": lambda p: p.mean_curvature,
    "std_peak_curvature": lambda p: p.curvature_deviation,
    "corr_height_curvature": lambda p: p.height_curvature_correlation,
}


@pytest.mark.parametrize("quantity", SUMMITS)
@pytest.mark.parametrize("row", reference("nayak_summits"), ids=lambda row: f"{row['alpha']:g}")
def test_summits_against_quadrature(row, quantity):
    summits = NayakSummits(1.0, 1.0, row["alpha"])
    # third and fourth cumulants are small differences: absolute, too
    assert SUMMITS[quantity](summits) == pytest.approx(row[quantity], rel=1e-11, abs=1e-14)


@every_row(reference("nayak_height_pdf"), label=lambda row: f"{row['alpha']:g}-{row['xi']:g}")
def test_height_density_against_quadrature(row):
    summits = NayakSummits(4.0, 2.0, row["alpha"])  # m0 m4/m2² = alpha
    height = 2.0 * row["xi"]
    assert float(summits.height_density(height)) * 2.0 == pytest.approx(row["pdf"], rel=1e-10)
    expected = row["mean_curvature_given_xi"] * math.sqrt(summits.m4)
    assert float(summits.mean_curvature_at(height)) == pytest.approx(expected, rel=1e-10)


@every_row(reference("mccool_parameters"), label=lambda row: f"{row['alpha']:.3g}")
def test_mccool_parameters(row):
    summits = NayakSummits(row["m0_m2"], row["m2"], row["m4_per_m2"])
    assert summits.alpha == pytest.approx(row["alpha"], rel=1e-12)
    assert summits.density == pytest.approx(row["eta_per_m2"], rel=1e-12)
    assert summits.radius == pytest.approx(row["R_m"], rel=1e-12)
    # the reference takes the constant 0.8968 with ten digits
    assert summits.height_deviation == pytest.approx(row["sigma_s_m"], rel=1e-10)
    assert summits.mean_height == pytest.approx(row["zbar_s_m"], rel=1e-12)


def test_the_mean_geometric_curvature_is_its_integral():
    integral, _ = dblquad(
        lambda u, t: (t * t - u) ** 1.5 * math.exp(-u - 0.5 * t * t) / math.sqrt(2.0 * math.pi),
        0.0,
        12.0,  # the density beyond is below exp(-72)
        0.0,
        lambda t: t * t,
        epsabs=1e-12,
    )
    # sqrt(2/3) is the unit of curvature, 2 sqrt(3) the norm of the density of summits
    assert math.sqrt(2.0 / 3.0) * 2.0 * math.sqrt(3.0) * integral == pytest.approx(GEOMETRIC_CURVATURE, rel=1e-10)


@given(alpha=st.floats(1.5, 500.0))
def test_the_density_of_heights_has_the_stated_moments(alpha):
    summits = NayakSummits(1.0, 1.0, alpha)
    # the density of a single wavelength ends at zero height, that of nearly one falls there within
    # sqrt(1 - 1.5/α)
    edges = np.geomspace(1e-6, 14.0, 48)
    low = [0.0] if alpha < 1.5 + 1e-8 else [*-edges[::-1], 0.0]
    z, weight = gauss(np.array([*low, *edges]), 12)
    moments = [float(weight @ (z**n * summits.height_density(z))) for n in range(3)]
    assert moments[0] == pytest.approx(1.0, rel=1e-7)
    assert moments[1] == pytest.approx(summits.mean_height, rel=1e-6)
    assert moments[2] - moments[1] ** 2 == pytest.approx(summits.height_deviation**2, rel=1e-6)


def test_wide_spectra_have_gaussian_summits_independent_of_curvature():
    summits = NayakSummits(1.0, 1.0, 1e8)
    assert summits.mean_height == pytest.approx(4.0 / math.sqrt(math.pi * 1e8))
    assert summits.height_deviation == pytest.approx(1.0, rel=1e-8)
    assert summits.height_curvature_correlation < 1e-4
    assert float(summits.height_density(0.0)) == pytest.approx(1.0 / math.sqrt(2.0 * math.pi), rel=1e-4)


@pytest.mark.parametrize(("rolloff", "hurst"), [(18e-9, 0.8), (90e-9, 0.7)], ids=["narrow", "wide"])
def test_summits_of_generated_surfaces(rolloff, hurst):
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-9), hurst=hurst, rolloff_wavelength=rolloff, shortest_wavelength=16e-9
    )
    maps = [
        asp.roughness_of(asp.generate.gaussian(asp.Grid((768, 768), (1e-9, 1e-9)), spectrum, seed=seed))
        for seed in range(4)
    ]
    moments = [float(np.mean([getattr(found, name) for found in maps])) for name in ("m0", "m2", "m4")]
    expected = NayakSummits(*moments)
    height, curvature = (
        np.concatenate([getattr(found.summits, name) for found in maps]) for name in ("height", "curvature")
    )
    # four standard errors of independent summits; sixteen points to the shortest wave make central
    # differences too small by at most 1.3 %, and more summits by up to 1 % (on a lattice some
    # saddles count as summits)
    error = 4.0 / math.sqrt(height.size)
    density = float(np.mean([found.summits.density for found in maps]))
    assert density == pytest.approx(expected.density, rel=error + 0.01)
    assert height.mean() == pytest.approx(expected.mean_height, abs=error * expected.height_deviation)
    assert height.std() == pytest.approx(expected.height_deviation, rel=error)
    assert curvature.mean() == pytest.approx(expected.mean_curvature, rel=0.344 * error + 0.013)
    found_correlation = float(np.corrcoef(height, curvature)[0, 1])
    assert found_correlation == pytest.approx(expected.height_curvature_correlation, abs=error)


def test_no_isotropic_surface_has_alpha_below_three_halves():
    with refused(InputError, "moments of an isotropic surface", "1.5"):
        NayakSummits(1.0, 1.0, 1.4)
    with refused(InputError, "m4 (1/m^2) of nayak"):
        NayakSummits(1.0, 1.0, 0.0)


@pytest.mark.parametrize("quantity", PEAKS)
@pytest.mark.parametrize("row", reference("profile_peaks_exponential_acf"), ids=lambda row: f"{row['l_over_beta']:g}")
def test_peaks_against_quadrature(row, quantity):
    assert PEAKS[quantity](SampledPeaks(row["rho1"], row["rho2"])) == pytest.approx(row[quantity], rel=1e-11)


@every_row(reference("surfaces_sampled_peaks"), label=lambda row: f"{row['delta_over_beta_e']:g}")
def test_sampled_exponential_profiles(row):
    rho = [math.exp(-n * row["delta_over_beta_e"]) for n in (1, 2)]
    peaks = SampledPeaks(*rho)
    assert peaks.fraction == pytest.approx(row["peak_density_times_delta"], rel=1e-10)
    assert peaks.mean_height == pytest.approx(row["mean_peak_height_over_sigma"], rel=1e-10)
    assert peaks.mean_curvature == pytest.approx(row["mean_peak_curvature_times_delta2_over_sigma"], rel=1e-10)
    assert peaks.zero_crossings == pytest.approx(row["zero_crossing_density_times_delta"], rel=1e-10)


@given(rho_1=st.floats(-0.6, 0.99), share=st.floats(0.01, 0.99))
def test_peaks_of_any_profile(rho_1, share):
    lowest = 2.0 * rho_1**2 - 1.0
    peaks = SampledPeaks(rho_1, lowest + share * (1.0 - lowest))
    assert 0.0 < peaks.fraction < 0.5
    assert abs(peaks.height_curvature_correlation) <= 1.0
    assert peaks.mean_height > 0.0


def test_peaks_of_white_noise_are_every_third_point():
    peaks = SampledPeaks(0.0, 0.0)
    triples = np.random.default_rng(3).standard_normal((3, 400_000))
    is_peak = (triples[1] > triples[0]) & (triples[1] > triples[2])
    heights = triples[1, is_peak]
    assert peaks.fraction == pytest.approx(1.0 / 3.0, rel=1e-14)
    error = heights.std() / math.sqrt(heights.size)
    assert peaks.mean_height == pytest.approx(heights.mean(), abs=5.0 * error)
    assert peaks.height_deviation == pytest.approx(heights.std(), abs=5.0 * error)


def test_impossible_correlations_are_refused():
    with refused(InputError, "correlations of a profile"):
        SampledPeaks(0.9, 0.1)
    with refused(InputError, "rho_1 of sampled-peaks"):
        SampledPeaks(1.0, 0.9)


@pytest.mark.parametrize("alpha", [1.6, 2.0, 10.0])
@pytest.mark.parametrize("xi", [-1.0, -4.0, -8.0, -30.0])
def test_curvature_of_summits_far_below_the_mean_plane(alpha, xi):
    """Ratio of integrals over t of (t² - 1 + e^(-t²)) times the normal density given ξ, whose
    common factor cancels."""
    rho = math.sqrt(1.5 / alpha)
    mean, variance = rho * xi, 1.0 - rho**2

    def weight(t):
        square = t * t
        flat = square + math.expm1(-square) if t > 0.03 else square**2 * (0.5 - square / 6.0 + square**2 / 24.0)
        return flat * math.exp(-0.5 * (square - 2.0 * mean * t) / variance)

    end = 70.0 * variance / (abs(mean) + math.sqrt(variance))
    above, below = (
        quad(lambda t, k=k: t**k * weight(t), 0.0, end, epsabs=0.0, epsrel=1e-12, limit=200)[0] for k in (1, 0)
    )
    found = float(NayakSummits(1.0, 1.0, alpha).mean_curvature_at(xi))
    assert found == pytest.approx(math.sqrt(2.0 * alpha / 3.0) * above / below, rel=1e-9)
