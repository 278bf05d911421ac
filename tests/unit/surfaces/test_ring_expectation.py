"""Expected ring means against the exact covariance of a windowed sample, and the rounded
spectrum."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference

import asperity as asp
from asperity.surfaces.characterise.expectation import ring_expectation
from asperity.surfaces.characterise.spectral_model import SpectralModel
from asperity.surfaces.characterise.spectrum import PowerSpectrum, default_edges, line_window, radial_spectrum

LENGTH = 5.0  # of the exponential autocorrelation, in pixels


def exact_rings(n: int, window: str, edges: np.ndarray):
    """Ring means of the expected periodogram of point values on n x n pixels, by the sum over the
    autocorrelation times that of the window."""
    grid, weights = asp.Grid((n, n), (1.0, 1.0)), line_window(window, n)
    overlap = np.correlate(weights, weights, "full") / n  # lags -n + 1 to n - 1
    lag = np.arange(-n + 1, n)
    terms = np.exp(-np.hypot(lag[:, None], lag[None, :]) / LENGTH) * np.outer(overlap, overlap)
    qx, qy = grid.wavevector()
    expected = (np.cos(np.outer(qx, lag)) @ terms @ np.cos(np.outer(lag, qy))).clip(min=0.0)
    return grid, radial_spectrum(PowerSpectrum(grid, expected, window), edges)


def test_expected_rings_of_point_values():
    n = 96
    grid = asp.Grid((n, n), (1.0, 1.0))
    edges = default_edges(PowerSpectrum(grid, np.zeros((n, n // 2 + 1)), "hann"))
    grid, exact = exact_rings(n, "hann", edges[edges > 2.5 * 2.0 * np.pi / n])
    expectation = ring_expectation(grid, exact, folded=True)
    psd = 2.0 * np.pi * LENGTH**2 / (1.0 + (expectation.q * LENGTH) ** 2) ** 1.5
    found = expectation.weights @ psd
    # the rest of the folded waves is an integral, and the window has its second moment alone
    assert found == pytest.approx(exact.psd, rel=0.01)
    unfolded = ring_expectation(grid, exact, folded=False)
    lower = unfolded.weights @ (2.0 * np.pi * LENGTH**2 / (1.0 + (unfolded.q * LENGTH) ** 2) ** 1.5)
    assert np.all(lower < found)


@every_row(reference("profiles/rounded_spectrum"), label=lambda row: f"case {row['case']:g}")
def test_rounded_spectra(row):
    model = SpectralModel(
        level=2.0, rolloff_wavelength=2.0 * math.pi, exponents=(2.0 + 2.0 * row["hurst"],), rounded=True
    )
    assert float(model.psd(row["x"])) == pytest.approx(2.0 * row["C_over_A"], rel=1e-9)
    # <h²> = A q0²/(4π H)
    assert model.moments()[0] == pytest.approx(2.0 / (4.0 * math.pi * row["hurst"]), rel=1e-6)
