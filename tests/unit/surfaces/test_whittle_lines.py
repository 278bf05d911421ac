"""Expectation of periodograms of lines, and the likelihood of scans of several lengths together."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from reference_data import FOLDER, Row, every_row, reference

from asperity.core.arrays import RealArray
from asperity.surfaces.characterise.whittle_lines import (
    LineFit,
    LineModes,
    Rounded,
    corner_bound,
    expected_periodogram,
    fit_lines,
    independent_line_factor,
    levelled_expectation,
    matern,
    window_correlation,
)

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
    R = matern(q0 * np.arange(n), H)
    found = levelled_expectation(R, weights, 1.0, [mode], str(row["detrend"]))[0]
    C1D = float(Rounded(1.0, q0, H).profile_psd(2.0 * math.pi * mode / n))
    digits = 5e-6  # the table has six digits
    assert found / C1D == pytest.approx(float(row["ratio_to_C1D"]), rel=digits)


@pytest.mark.parametrize("window", ["none", "hann"])
def test_one_transform_gives_the_expectation_of_the_covariance(window: str) -> None:
    n = 96
    weights = np.ones(n) if window == "none" else hann(n)
    R = matern(0.05 * np.arange(n), 0.7)
    fast = expected_periodogram(R, window_correlation(weights), 0.3)
    dense = levelled_expectation(R, weights, 0.3, range(n // 2 + 1), "none")
    assert fast == pytest.approx(dense, rel=1e-11)


@every_row(reference("profiles/band_cut"), lambda row: str(row["case"]))
def test_distance_of_independent_lines(row: Row) -> None:
    found = independent_line_factor(float(row["hurst"]))
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
