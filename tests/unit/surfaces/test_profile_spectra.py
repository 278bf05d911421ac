"""Spectra of profiles and of isotropic surfaces: reference values, the relation both ways, fits,
generated surfaces."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.generate import surface_of_profile
from asperity.roughness import (
    MapPieces,
    ProfilePieces,
    RoundedSpectrum,
    alias_factor,
    compared_directions,
    cut_ratio,
    independent_line_distance,
    isotropic_spectrum,
    power_spectrum,
    profile_moments,
    profile_peaks,
    profile_spectrum,
    summits_of_peaks,
)
from asperity.surfaces import Profile, filtered, levelled

TEN_DIGITS = 6e-10  # of the tables, relative


@every_row(reference("profiles/rounded_spectrum"), lambda row: f"case {row['case']}")
def test_rounded_model(row: Row) -> None:
    model, x = RoundedSpectrum(1.0, 1.0, float(row["hurst"])), float(row["x"])
    exact = {
        "C_over_A": model.psd,
        "C1D_over_A_q0": model.profile_psd,
        "acf": model.autocorrelation,
        "half_S_over_sigma2": model.half_structure,
    }
    for name, function in exact.items():
        assert float(function(x)) == pytest.approx(float(row[name]), rel=TEN_DIGITS)
    slopes = {
        "half_local_slope_S": model.half_slope,
        "half_local_slope_second_difference": model.half_slope_of_second_differences,
    }
    for name, function in slopes.items():
        if row[name] != "":
            assert float(function(x)) == pytest.approx(float(row[name]), abs=1e-6)  # central differences of the table


@every_row(reference("profiles/plateau_profile_spectrum"), lambda row: f"case {row['case']}")
def test_plateau_in_the_map_is_rounded_in_the_profile(row: Row) -> None:
    H, last, k = float(row["hurst"]), float(row["qs_over_qr"]), float(row["k_over_qr"])
    pieces = MapPieces(np.array([1.0, last]), np.array([1.0, last ** (-2.0 - 2.0 * H)]))
    found = float(pieces.profile_psd(k))
    law = math.gamma(H + 0.5) / (2.0 * math.sqrt(math.pi) * math.gamma(H + 1.0)) * k ** (-1.0 - 2.0 * H)
    assert found == pytest.approx(float(row["C1D_over_C0_qr"]), rel=1e-9)
    assert found / law == pytest.approx(float(row["ratio_to_unlimited_power_law"]), rel=1e-9)


@every_row(reference("profiles/band_cut"), lambda row: f"case {row['case']}")
def test_a_cut_in_the_profile_is_none_in_the_map(row: Row) -> None:
    H = float(row["hurst"])
    assert cut_ratio(H, 2) == pytest.approx(float(row["m2_cut_in_profile_over_cut_in_map"]), rel=TEN_DIGITS)
    assert cut_ratio(H, 4) == pytest.approx(float(row["m4_cut_in_profile_over_cut_in_map"]), rel=TEN_DIGITS)
    distance = float(row["independent_line_distance_times_q"])
    assert independent_line_distance(H, 1.0) == pytest.approx(distance, rel=TEN_DIGITS)


def test_moments_of_the_rounded_model_with_either_cut() -> None:
    model = RoundedSpectrum(2.0, 1.0, 0.8)
    assert model.moment(0, 1e-4) == pytest.approx(model.mean_square, rel=1e-6)  # the rest falls as q^-1.6
    ratios = [model.moment(n, 1e-3, cut="profile") / model.moment(n, 1e-3) for n in (2, 4)]
    assert ratios == pytest.approx([cut_ratio(0.8, 2), cut_ratio(0.8, 4)], rel=0.1)  # power law only in the limit
    assert ratios[1] == pytest.approx(cut_ratio(0.8, 4), rel=1e-3)


def test_aliases_of_a_power_law() -> None:
    s = np.array([0.1, 0.2, 0.25, 0.35, 0.5])
    np.testing.assert_allclose(alias_factor(2.0, 2.0 * np.pi * s, 1.0), [1.034, 1.143, 1.234, 1.523, 2.467], atol=5e-4)
    direct = sum((np.abs(0.25 + j) / 0.25) ** -3.0 for j in range(-2000, 2001))
    assert alias_factor(3.0, 0.5 * np.pi, 1.0) == pytest.approx(direct, rel=1e-6)  # the rest of the sum
    with refused(InputError, "exponent of a sampled spectrum"):
        alias_factor(1.0, 1.0, 1.0)


def test_pieces_by_quadrature() -> None:
    """Closed forms against the integrals over arcosh, rising and slowly falling pieces among
    them."""
    pieces = MapPieces(np.array([1.0, 3.0, 9.0, 40.0]), np.array([1.0, 1.6, 1.0, 1e-3]))
    for k in (0.3, 2.0, 5.0, 20.0):
        top = math.acosh(40.0 / k)
        kinks = [math.acosh(max(q, k) / k) for q in (1.0, 3.0, 9.0, 40.0)]
        u, weight = gauss(np.unique([*np.linspace(0.0, top, 30), *kinks]), 12)
        q = k * np.cosh(u)
        assert float(pieces.profile_psd(k)) == pytest.approx(float(weight @ (q * pieces.psd(q))) / math.pi, rel=1e-9)


@pytest.mark.parametrize("hurst", [0.3, 0.5, 0.8])
def test_there_and_back(hurst: float) -> None:
    """The rounded pair as many pieces, each way: power laws of 1/400 decade are 1e-4 off where it
    bends."""
    model = RoundedSpectrum(1.0, 1.0, hurst)
    k, q = np.geomspace(1e-3, 1e4, 2801), np.array([0.3, 1.0, 10.0, 100.0])
    np.testing.assert_allclose(ProfilePieces(k, model.profile_psd(k)).psd(q), model.psd(q), rtol=2e-4)
    np.testing.assert_allclose(MapPieces(k, model.psd(k)).profile_psd(q), model.profile_psd(q), rtol=3e-3)  # cut at 1e4
    with refused(InputError, "spectrum of a profile"):
        ProfilePieces(np.array([1.0, 2.0]), np.array([1.0, 2.0])).psd(1.5)


def sampled(model: RoundedSpectrum, points: int, spacing: float, seed: int) -> Profile:
    """Closed Gaussian profile of point samples of the model, its aliases summed."""
    k = 2.0 * np.pi * np.fft.rfftfreq(points, spacing)
    psd = sum(model.profile_psd(np.abs(k + 2.0 * np.pi * j / spacing)) for j in range(-40, 41))
    rng = np.random.default_rng(seed)
    waves = (rng.standard_normal(k.size) + 1j * rng.standard_normal(k.size)) * np.sqrt(0.5 * psd * points / spacing)
    waves[0] = 0.0
    return Profile(np.fft.irfft(waves, points), spacing, periodic=True)


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_the_fit_of_the_rounded_model_has_honest_errors(hurst: float) -> None:
    model = RoundedSpectrum(1e-30, 2e6, hurst)
    found = [isotropic_spectrum(sampled(model, 4096, 2e-8, seed), model="rounded") for seed in range(3)]
    scores = np.array([(one.hurst - hurst) / one.errors["hurst"] for one in found])
    assert abs(scores.mean()) < 4.0 / math.sqrt(3.0)
    assert np.abs(scores).max() < 4.0


def test_pieces_find_a_plateau_and_a_power_law() -> None:
    rng = np.random.default_rng(5)
    k = 2.0 * np.pi * np.fft.rfftfreq(8192, 1e-8)
    psd = 1e-24 * np.minimum(1.0, (np.maximum(k, 1.0) / 2e6) ** -2.6)
    waves = (rng.standard_normal(k.size) + 1j * rng.standard_normal(k.size)) * np.sqrt(0.5 * psd * 8192 / 1e-8)
    waves[0] = 0.0
    found = isotropic_spectrum(Profile(np.fft.irfft(waves, 8192), 1e-8, periodic=True), model="pieces")
    assert found.hurst == pytest.approx(0.8, abs=4.0 * found.errors["hurst"])
    assert set(isotropic_spectrum(Profile(np.fft.irfft(waves, 8192), 1e-8)).criteria) == {"rounded", "pieces"}


def test_a_short_or_flat_scan_has_no_spectrum() -> None:
    for profile in (Profile(np.zeros(300), 1e-6), Profile(np.random.default_rng(1).standard_normal(30), 1e-6)):
        with refused(InputError, "line scan"):
            isotropic_spectrum(profile)


def test_parseval_and_the_sum_rule_of_rows() -> None:
    surface = asp.generate.gaussian(
        asp.Grid((64, 48), (1e-8, 2e-8)),
        asp.generate.SelfAffine(
            amplitude=asp.generate.RmsHeight(1e-9), hurst=0.7, rolloff_wavelength=2e-7, shortest_wavelength=0.0
        ),
        seed=1,
    )
    rows = profile_spectrum(surface)
    C = power_spectrum(surface)
    full = np.concatenate([C.psd, C.psd[(-np.arange(64)) % 64][:, 1:-1]], axis=1)  # both signs of q_y
    np.testing.assert_allclose(rows.psd, full.sum(axis=1)[1:33] / surface.size[1], rtol=1e-10)
    profile = surface.row(3)
    modes = profile_spectrum(profile)
    both = np.r_[np.full(31, 2.0), 1.0]
    assert float(both @ modes.psd) / profile.length == pytest.approx(float(np.var(profile.heights)), rel=1e-12)


def test_a_generated_surface_has_the_spectrum_and_says_its_assumption() -> None:
    model = RoundedSpectrum(1e-30, 4e6, 0.8)
    profile = sampled(model, 4096, 2e-8, 7)
    spectrum = isotropic_spectrum(profile)
    surface = surface_of_profile(profile, asp.Grid((256, 256), (4e-8, 4e-8)), seed=1)
    assert "isotropic" in surface.origin.history[0]
    rows, within = profile_spectrum(surface), slice(3, 40)
    # the surface is cut on a disc: its rows have less than the profile next to the cut
    expected = spectrum.pieces().profile_psd(rows.q[within])
    ratio = float(np.mean(rows.psd[within] / expected))
    lines = 256 * 4e-8 / independent_line_distance(0.8, float(rows.q[20]))
    assert ratio == pytest.approx(1.0, abs=4.0 / math.sqrt(37 * lines))
    shaped = surface_of_profile(profile, asp.Grid((64, 64), (4e-8, 4e-8)), seed=1, heights=True)
    assert float(np.mean(shaped.heights**3)) * np.mean(profile.heights**3) > 0.0
    extrapolated = isotropic_spectrum(profile, shortest_wavelength=1e-8)
    assert "extrapolated" in extrapolated.assumption


def test_summits_from_peaks_of_a_generated_map() -> None:
    """Band-limited Gaussian map: density 1.01 by the rule of the lattice, heights and curvatures
    within their scatter."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=1.6e-7
    )
    surface = asp.generate.gaussian(asp.Grid((512, 512), (1e-8, 1e-8)), spectrum, seed=2)
    true = asp.roughness.summit_statistics(asp.roughness.summits(surface))
    found = summits_of_peaks(profile_peaks(surface), asp.roughness.rms_height(surface) ** 2)
    assert found.density == pytest.approx(true.density, rel=0.05)
    assert found.mean_height == pytest.approx(true.mean_height, rel=0.1)
    assert found.mean_curvature == pytest.approx(true.mean_curvature, rel=0.05)
    moments = profile_moments(surface.row(0))
    assert moments.rms_gradient == pytest.approx(math.sqrt(2.0 * moments.m2))
    assert moments.rms_laplacian == pytest.approx(math.sqrt(8.0 / 3.0 * moments.m4))


def test_roughness_of_a_profile_serves_theories_and_says_its_assumption() -> None:
    profile = sampled(RoundedSpectrum(1e-30, 4e6, 0.8), 4096, 2e-8, 3)
    rough = asp.roughness_of(levelled(filtered(profile, short=1.6e-7)))
    assert "isotropic" in rough.assumption
    assert rough.summits is None
    assert "isotropic" in repr(rough)
    m0 = rough.m0
    assert m0 == pytest.approx(float(np.mean(np.square(filtered(profile, short=1.6e-7).heights))), rel=0.05)
    theory = asp.theories.Persson.from_roughness(rough, 1e9)
    assert 0.0 < float(np.ravel(theory.at_pressure(1e5).area_fraction)[0]) < 1.0


def test_two_directions_of_an_isotropic_and_of_a_ground_surface() -> None:
    model = RoundedSpectrum(1e-30, 4e6, 0.8)
    alike = [compared_directions(sampled(model, 4096, 2e-8, k), sampled(model, 4096, 2e-8, 50 + k)) for k in range(10)]
    assert sum(one.isotropic for one in alike) >= 7  # 0.86 of three correlated tests at two errors pass
    along = sampled(RoundedSpectrum(1e-30, 2e6, 0.8), 4096, 2e-8, 3)  # gentler waves along the lay
    assert not compared_directions(sampled(model, 4096, 2e-8, 1), along).isotropic
    with refused(InputError, "scans to be compared"):
        compared_directions(along, Profile(along.heights, 4e-8))


def test_theories_of_summits_take_those_of_a_line_scan() -> None:
    """Their numbers are those that follow from the peaks, and the theory is that of the map the
    line is from, within what the conversion gives."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=1.6e-7
    )
    surface = asp.generate.gaussian(asp.Grid((8192, 256), (1e-8, 1e-8)), spectrum, seed=2)
    line = surface.row(0)
    rough = asp.roughness_of(line)
    expected = summits_of_peaks(profile_peaks(line), asp.roughness.rms_height(line) ** 2)
    found = asp.theories.GreenwoodWilliamson.from_roughness(rough, 1e11)
    assert (found.density, found.radius) == (expected.density, expected.radius)
    assert (found.mean_height, found.height_deviation) == (expected.mean_height, expected.height_deviation)
    for theory in (asp.theories.KotwalBhushan, asp.theories.KogutEtsion):
        more = {"hardness": 1e9} if theory is asp.theories.KogutEtsion else {}
        made = theory.from_roughness(rough, 1e11, **more)
        assert made.density == expected.density
    # 240 peaks give each number to 1/sqrt(240) = 6.5 % or better; at a pressure the area goes with
    # the roots of radius and height deviation, and hardly with the density: two errors
    of_map = asp.theories.GreenwoodWilliamson.from_roughness(asp.roughness_of(surface), 1e11)
    areas = [float(np.ravel(one.at_pressure(1e6).area_fraction)[0]) for one in (found, of_map)]
    assert areas[0] == pytest.approx(areas[1], rel=0.13)
    with refused(asp.InputError, "roughness for the theory discrete-summits"):
        asp.theories.DiscreteSummits.from_roughness(rough, 1e11)
    with refused(asp.InputError, "roughness for the theory greenwood-williamson"):
        asp.theories.GreenwoodWilliamson.from_roughness(rough, 1e11, bins=20)


def test_a_stated_lay_is_said_beside_the_isotropy_and_turns_the_strip() -> None:
    profile = sampled(RoundedSpectrum(1e-30, 4e6, 0.8), 512, 2e-8, 3)
    laid = Profile(profile.heights, profile.spacing, lay_angle=0.5)
    plain, stated = (isotropic_spectrum(one).assumption for one in (profile, laid))
    assert stated.startswith(plain)
    assert "28.65°" in stated
    grooves = asp.surfaces.strip(laid, 1.0)
    assert grooves.dx == pytest.approx(profile.spacing * math.cos(0.5), rel=1e-15)
    assert len(grooves.origin.history) == len(laid.origin.history) + 2
    assert asp.surfaces.strip(profile, 1.0).dx == profile.spacing
