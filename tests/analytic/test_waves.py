"""Periodic sinusoids: Westergaard (1939) and Johnson, Greenwood & Higginson (1985)."""

import numpy as np
import pytest
from contact_cases import TIGHT, elastic, square_grid
from reference_data import every_row, reference

import asperity as asp
from asperity import generate
from asperity.solvers import ConjugateGradient
from asperity.theories.single.waves import CrossedWaves, Westergaard

SOLVER = ConjugateGradient(tolerance=1e-10)
NUMERIC = [row for row in reference("johnson_greenwood_higginson") if row["area_fraction_numeric"] != ""]
ASYMPTOTIC = [row for row in reference("johnson_greenwood_higginson") if row["pbar_over_pstar"] < 0.005]


def westergaard(row, n=512):
    grid = asp.Grid((n, 1), (row["lambda"] / n, row["lambda"] / n))
    surface = generate.sinusoid(grid, amplitude=row["amplitude"], wavelength=row["lambda"])
    return asp.solve(asp.ContactProblem(surface, elastic(row["E_star"])), asp.MeanPressure(row["pbar"]), solver=SOLVER)


@every_row(reference("westergaard"), label=lambda row: f"load{row['pbar_over_pstar']:g}")
def test_westergaard(row):
    """On 512 points each end of the contact is known to a pixel, 2/512 of the period; smooth
    quantities to order 3/2

    of the pixel in the half-width: (2/512)^1.5 = 2.4e-4 for the narrowest contact and less for the
    others.
    """
    result = westergaard(row)
    assert result.area_fraction == pytest.approx(row["contact_fraction"], abs=2.0 / 512)
    assert result.max_pressure == pytest.approx(row["p_x0"], rel=2.4e-4)
    assert result.approach / row["amplitude"] == pytest.approx(row["approach_over_amplitude"], abs=2.4e-4)


@every_row(reference("westergaard")[:5], label=lambda row: f"load{row['pbar_over_pstar']:g}")
def test_westergaard_stiffness(row):
    """The open part is known to two pixels."""
    result = westergaard(row)
    exact = float(Westergaard(row["E_star"], row["amplitude"], row["lambda"]).stiffness(row["pbar"]))
    open_fraction = 1.0 - row["contact_fraction"]
    assert result.normal_stiffness == pytest.approx(exact, rel=2.0 / 512 / min(open_fraction, row["contact_fraction"]))


def bisinusoid(load, n=128, amplitude=0.01):
    surface = generate.bisinusoid(square_grid(n, 1.0), amplitude=amplitude, wavelength=1.0)
    full = CrossedWaves(1.0, amplitude, 1.0).full_contact_pressure
    return asp.solve(asp.ContactProblem(surface, elastic(1.0)), asp.MeanPressure(load * full), solver=SOLVER), full


@every_row(NUMERIC, label=lambda row: f"load{row['pbar_over_pstar']:g}")
def test_bisinusoid_against_the_fine_solution(row):
    """Peak pressure: order 2 on 128² against 1024²; area: within its error, 3e-4 to 7e-4."""
    result, full = bisinusoid(row["pbar_over_pstar"])
    assert result.max_pressure / full == pytest.approx(row["pmax_over_pstar_numeric"], rel=1e-4)
    assert result.area_fraction_corrected == pytest.approx(row["area_fraction_numeric"], abs=result.area_fraction_error)


def test_place_of_edges_removes_the_pixel_bias():
    raw, corrected = [], []
    for row in NUMERIC:
        result, _ = bisinusoid(row["pbar_over_pstar"])
        raw.append(result.area_fraction - row["area_fraction_numeric"])
        corrected.append(result.area_fraction_corrected - row["area_fraction_numeric"])
    assert np.mean(raw) > 1e-3
    assert abs(np.mean(corrected)) < 0.1 * np.mean(raw)


@every_row(ASYMPTOTIC, label=lambda row: f"load{row['pbar_over_pstar']:g}")
def test_bisinusoid_at_low_load_is_hertz(row):
    """The Hertz asymptote is 4.5 % low at 0.02 and its error falls like the area: below 1.2 % at
    0.002."""
    result, full = bisinusoid(row["pbar_over_pstar"], n=512)
    assert result.max_pressure / full == pytest.approx(row["pmax_over_pstar_low_load"], rel=0.02)
    assert result.area_fraction_corrected == pytest.approx(row["area_fraction_low_load"], rel=0.03)


@pytest.mark.parametrize("load", [1.001, 1.5])
def test_full_contact_is_the_inverse_spectrum(load):
    """Where p = pbar + F^-1[h/c] is positive everywhere it is the solution: here pbar + p*/2 (cos +
    cos)."""
    result, full = bisinusoid(load, n=32)
    x, y = result.problem.grid.centred_coordinates()
    exact = CrossedWaves(1.0, 0.01, 1.0).full_contact(x, y, load * full)
    np.testing.assert_allclose(result.pressure, exact, rtol=0, atol=1e-5 * full)
    assert result.area_fraction == 1.0
    assert result.area_fraction_corrected == 1.0
    assert result.normal_stiffness == np.inf
    assert result.mean_gap == pytest.approx(0.0, abs=1e-9)


def test_full_contact_is_certified():
    surface = generate.bisinusoid(square_grid(32, 1.0), amplitude=0.01, wavelength=1.0)
    result = asp.solve(asp.ContactProblem(surface, elastic(1.0)), asp.MeanPressure(1.0), solver=TIGHT)
    assert result.converged
    assert result.certificate.duality_gap < 1e-8
