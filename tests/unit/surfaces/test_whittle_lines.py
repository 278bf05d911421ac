"""Expectation of periodograms of lines, and the likelihood of scans of several lengths together."""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from reference_data import FOLDER, Row, every_row, reference
from scipy.integrate import quad

from asperity.core.arrays import RealArray
from asperity.surfaces.characterise.scans_corners import Rounded, Sharp
from asperity.surfaces.characterise.whittle_lines import (
    LineFit,
    LineModes,
    corner_bound,
    expected_periodogram,
    fit_lines,
    levelled_expectation,
    window_correlation,
)
from asperity.surfaces.profile_spectra import independent_line_distance

BIAS = reference("profiles/periodogram_bias")


def hann(n: int) -> RealArray:
    weights = 1.0 - np.cos(2.0 * np.pi * (np.arange(n) + 0.5) / n)
    return np.asarray(weights / np.sqrt(np.mean(weights**2)))


def band(name: str, spacing: float) -> LineModes:
    """Modes 3 to 63 of the reference scans ``name``."""
    heights = np.load(FOLDER / "profiles/scans.npz")[f"A_{name}"].astype(float)
    n = heights.shape[1]
    x = np.arange(n) - 0.5 * (n - 1)
    heights -= heights.mean(axis=1, keepdims=True)
    heights -= np.outer(heights @ x / (x @ x), x)
    weights, modes = hann(n), np.arange(3, 64)
    power = spacing / n * np.abs(np.fft.rfft(heights * weights, axis=1)) ** 2
    correlation = window_correlation(weights)
    return LineModes(power[:, modes], modes.astype(float), n, spacing, correlation, "hann", np.ones(modes.size))


TRUTH = {str(row["scan"]): row for row in reference("profiles/scans_truth")}


@cache
def scans() -> tuple[LineModes, ...]:
    return tuple(band(name, float(row["spacing_m"])) for name, row in TRUTH.items())


@cache
def fitted() -> LineFit:
    return fit_lines(scans())


@every_row(BIAS, lambda row: str(row["case"]))
def test_levelling_and_windows_bias_a_periodogram_as_the_covariance_says(row: Row) -> None:
    n, H, mode = 512, float(row["hurst"]), int(row["mode"])
    q0 = 2.0 * math.pi * float(row["q0_L_over_2pi"]) / n
    weights = np.ones(n) if row["window"] == "none" else hann(n)
    R = Rounded(1.0, q0, H).autocovariance(np.arange(n))
    found = levelled_expectation(R, weights, 1.0, [mode], str(row["detrend"]))[0]
    C1D = float(Rounded(1.0, q0, H).profile_psd(2.0 * math.pi * mode / n))
    digits = 5e-6  # the table has six digits
    assert found / C1D == pytest.approx(float(row["ratio_to_C1D"]), rel=digits)


@pytest.mark.parametrize("window", ["none", "hann"])
def test_one_transform_gives_the_expectation_of_the_covariance(window: str) -> None:
    n = 96
    weights = np.ones(n) if window == "none" else hann(n)
    R = Rounded(1.0, 0.05, 0.7).autocovariance(np.arange(n))
    fast = expected_periodogram(R, window_correlation(weights), 0.3)
    dense = levelled_expectation(R, weights, 0.3, range(n // 2 + 1), "none")
    assert fast == pytest.approx(dense, rel=1e-11)


def transformed(model: Rounded | Sharp, lag: float) -> float:
    """(1/π) ∫ C1D(k) cos(k ``lag``) dk."""
    near = quad(lambda k: float(model.profile_psd(k)) * math.cos(k * lag), 0.0, 1.0, limit=400, epsabs=1e-12)[0]
    far = quad(lambda k: float(model.profile_psd(k)), 1.0, np.inf, weight="cos", wvar=lag, limlst=200, epsabs=1e-12)
    return (near + far[0]) / math.pi


@pytest.mark.parametrize("H", [0.3, 0.8])
@pytest.mark.parametrize("corner", [Rounded, Sharp])
def test_covariance_is_the_transform_of_the_profile_spectrum(corner: type[Rounded] | type[Sharp], H: float) -> None:
    model = corner(1.0, 1.0, H)
    lags = np.array([0.3, 9.999, 10.001, 20.0, 44.999, 45.001])
    wanted = [transformed(model, float(lag)) for lag in lags]
    assert model.autocovariance(lags) == pytest.approx(wanted, abs=1e-10)  # the quadrature keeps ten digits


@pytest.mark.parametrize("H", [0.3, 0.8])
@pytest.mark.parametrize("corner", [Rounded, Sharp])
def test_profile_spectrum_is_the_projection_of_the_map(corner: type[Rounded] | type[Sharp], H: float) -> None:
    model = corner(2.0, 1.0, H)
    for k in (0.01, 0.7, 3.0):
        kinks = np.append(0.0, math.sqrt(max(1.0 - k * k, 0.0)))
        parts = [
            quad(lambda y, k=k: float(model.psd(math.hypot(k, y))), low, high, epsabs=0.0, epsrel=1e-11)[0]
            for low, high in pairwise([*np.unique(kinks), np.inf])
        ]
        assert float(model.profile_psd(k)) == pytest.approx(sum(parts) / math.pi, rel=1e-9)
    assert float(model.autocovariance(np.array([0.0]))[0]) == 2.0


@every_row(reference("profiles/band_cut"), lambda row: str(row["case"]))
def test_distance_of_independent_lines(row: Row) -> None:
    found = independent_line_distance(float(row["hurst"]), 1.0)
    assert found == pytest.approx(float(row["independent_line_distance_times_q"]), rel=1e-9)


def test_fit_of_three_scan_lengths_is_that_of_the_reference() -> None:
    (row,) = reference("profiles/scans_fit")
    fit = fitted()
    se = {name: float(row[f"{name}_se"]) for name in ("hurst", "q0", "rms_height")}
    assert fit.model.hurst == pytest.approx(float(row["hurst"]), abs=0.2 * se["hurst"])
    assert fit.model.corner == pytest.approx(float(row["q0_rad_per_m"]), abs=0.2 * se["q0"])
    rms = math.sqrt(fit.model.variance)
    assert rms == pytest.approx(float(row["rms_height_m"]), abs=0.2 * se["rms_height"])
    assert fit.error("H") == pytest.approx(se["hurst"], rel=1e-3)
    assert fit.model.corner * fit.error("ln q0") == pytest.approx(se["q0"], rel=1e-2)
    assert 0.5 * rms * fit.error("ln m0") == pytest.approx(se["rms_height"], rel=1e-2)


def test_truth_lies_within_the_errors_of_the_fit() -> None:
    row, fit = TRUTH["stylus"], fitted()
    two = 1.96 * max(fit.error("H"), fit.error("H", by="sandwich"))
    assert fit.model.hurst == pytest.approx(float(row["hurst"]), abs=two)
    assert abs(math.log(fit.model.corner / float(row["q0_rad_per_m"]))) < 1.96 * fit.error("ln q0")
    assert fit.clusters == 18
    assert corner_bound(scans(), fit) > float(row["q0_rad_per_m"])


def test_rounded_corner_is_told_from_a_sharp_one() -> None:
    heights = surface(Rounded(1e-12, 2.0 * math.pi / 32e-6, 0.6))
    rounded, sharp = (fit_lines([heights], corner=name) for name in ("rounded", "sharp"))
    assert rounded.deviance < sharp.deviance


def surface(model: Rounded | Sharp) -> LineModes:
    """Modes of 200 independent lines of a surface with this spectrum, drawn with their exact
    covariance."""
    n, spacing, modes = 256, 1e-6, np.arange(3, 64)
    R = model.autocovariance(spacing * np.arange(n))
    root = np.linalg.cholesky(R[np.abs(np.arange(n)[:, None] - np.arange(n)[None, :])])
    heights = np.random.default_rng(3).standard_normal((200, n)) @ root.T
    weights = hann(n)
    power = spacing / n * np.abs(np.fft.rfft(heights * weights, axis=1)) ** 2
    correlation = window_correlation(weights)
    return LineModes(power[:, modes], modes.astype(float), n, spacing, correlation, "hann", np.ones(modes.size))


def test_sharp_corner_is_told_from_a_rounded_one() -> None:
    model = Sharp(1e-12, 2.0 * math.pi / 32e-6, 0.6)
    heights = surface(model)
    rounded, sharp = (fit_lines([heights], corner=name) for name in ("rounded", "sharp"))
    assert sharp.deviance < rounded.deviance
    assert sharp.model.hurst == pytest.approx(0.6, abs=3.0 * sharp.error("H"))
    assert math.log(sharp.model.corner / model.corner) == pytest.approx(0.0, abs=3.0 * sharp.error("ln q0"))
