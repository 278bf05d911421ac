"""JKR's contacts of power-law profiles, cylinders, waves and coated spheres against the reference,
and the grid against them."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import every_row, reference

import asperity as asp
from asperity.solids.compliance.halfspace import contact_compliance
from asperity.theories.adhesion.short_range import CoatedJKR, CylinderJKR, PowerLawJKR, WavyJKR
from asperity.theories.adhesion.spheres import JKR


def label(row):
    return f"case{row['case']:g}"


@every_row(reference("adhesion/jkr_power_law"), label=label)
def test_power_law_indenters(row):
    found = PowerLawJKR(1.0, row["n"], 1.0, row["w_over_EstarL"])
    for state, ending in ((found.pull_off, "pulloff"), (found.fold, "fold")):
        assert state.radius == pytest.approx(row[f"a_{ending}"], rel=1e-12)
        assert -state.load == pytest.approx(row[f"minus_P_{ending}"], rel=1e-12)
    assert found.pull_off.approach == pytest.approx(row["delta_at_pulloff"], rel=1e-10, abs=1e-14)
    assert found.fold.approach == pytest.approx(row["delta_fold"], rel=1e-11)
    assert found.unloaded.radius == pytest.approx(row["a_zero_load"], rel=1e-12)
    assert found.unloaded.approach == pytest.approx(row["delta_zero_load"], rel=1e-11)


@every_row(reference("adhesion/jkr_cylinder"), label=label)
def test_cylinders(row):
    found = CylinderJKR(row["E_star_Pa"], row["R_m"], row["w_J_per_m2"])
    assert found.pull_off.radius == pytest.approx(row["a_pulloff_m"], rel=1e-12)
    assert -found.pull_off.load == pytest.approx(row["P_pulloff_N_per_m"], rel=1e-12)
    assert found.unloaded.radius == pytest.approx(row["a_zero_load_m"], rel=1e-12)
    assert found.at_half_width(row["a_m"]).load == pytest.approx(row["P_N_per_m"], rel=1e-11)
    assert found.centre_pressure(row["a_m"]) == pytest.approx(row["p_centre_Pa"], rel=1e-11)


@every_row(reference("adhesion/wavy_jkr_curve"), label=label)
def test_waves(row):
    found = WavyJKR(row["alpha"])
    fraction = row["contact_fraction"]
    assert found.mean_pressure(fraction) == pytest.approx(row["pbar_over_pstar"], rel=1e-12, abs=1e-13)
    assert found.approach(fraction) == pytest.approx(row["approach_over_amplitude"], rel=1e-12, abs=1e-13)
    assert found.crest_pressure(fraction) == pytest.approx(row["p_crest_over_pstar"], rel=1e-12, abs=1e-13)


@every_row(reference("adhesion/wavy_jkr_events"), label=label)
def test_events_of_waves(row):
    found = WavyJKR(row["alpha"])
    off, full = found.stationary
    assert off == pytest.approx(row["fraction_at_pulloff"], rel=1e-9)
    assert full == pytest.approx(row["fraction_at_jump_full"], rel=1e-9)
    assert -found.mean_pressure(off) == pytest.approx(row["minus_pulloff_over_pstar"], rel=1e-11)
    assert found.mean_pressure(full) == pytest.approx(row["jump_full_over_pstar"], rel=1e-11, abs=1e-13)


def test_waves_beyond_the_largest_parameter_have_no_extremum():
    assert WavyJKR(1.07).stationary == ()


def coated(row) -> CoatedJKR:
    """Theory of a row: R = 1, E_2 = 1."""
    top = asp.Elastic(row["E1_over_E2"], row["nu1"])
    body = asp.Layered([asp.Layer(top, row["h"])], asp.Elastic(1.0, row["nu2"]))
    compliance, modulus = contact_compliance(body, asp.Rigid()), top.plane_strain_modulus
    return CoatedJKR(modulus, lambda q: 0.5 * modulus * q * compliance.spectral(q) - 1.0, row["h"], 1.0, row["w"])


@every_row(reference("adhesion/jkr_coated_sphere"), label=label)
def test_coated_spheres(row):
    found = coated(row).at_radius(row["a"])
    for name, column in (
        ("hertz_load", "P_hertz"),
        ("hertz_approach", "delta_hertz"),
        ("stiffness", "stiffness"),
        ("load", "P"),
        ("approach", "delta"),
    ):
        assert getattr(found, name) == pytest.approx(row[column], rel=1e-12, abs=1e-14)


@every_row([row for row in reference("adhesion/jkr_coated_pulloff") if row["a_pulloff"] != ""], label=label)
def test_pull_off_of_coated_spheres(row):
    found = coated(row).pull_off(0.5 * row["a_pulloff"], 2.0 * row["a_pulloff"])
    assert found.load == pytest.approx(row["P_pulloff"], rel=1e-8)
    assert found.radius == pytest.approx(row["a_pulloff"], rel=1e-4)  # of a minimum: the root of the error of the load


def test_homogeneous_limit_is_jkr():
    body = asp.Elastic(1.0, 0.3)
    modulus = body.plane_strain_modulus
    found = CoatedJKR(modulus, lambda q: 0.0 * q, 1.0, 1.0, 0.02).at_radius(0.4)
    expected = JKR(modulus, 1.0, 0.02).at_radius(0.4)
    assert found.load == pytest.approx(float(expected.load), rel=1e-12)
    assert found.approach == pytest.approx(float(expected.approach), rel=1e-12)


@pytest.mark.slow
def test_grid_meets_jkr_on_a_soft_coating():
    """Exponential law of short range on the grid, E1/E2 = 0.25, h = R/2: the pull-off is 1.113 of
    that of a half-space."""
    row = next(r for r in reference("adhesion/jkr_coated_pulloff") if r["E1_over_E2"] == 0.25 and r["h"] == 0.5)
    top = asp.Elastic(row["E1_over_E2"], row["nu1"])
    body = asp.Layered([asp.Layer(top, row["h"])], asp.Elastic(1.0, row["nu2"]))
    n, size = 96, 3.0
    pixel = size / n
    work, modulus = row["w"], top.plane_strain_modulus
    strength = float(np.sqrt(modulus * work / (4.0 * pixel)))
    x = (np.arange(n) - 0.5 * (n - 1)) * pixel
    heights = -0.5 * (x[:, None] ** 2 + x[None, :] ** 2)
    law = asp.adhesion.DugdaleAdhesion(work, work / strength, 0.3)
    problem = asp.ContactProblem(asp.Surface(heights, pixel), body, boundary=asp.Free(), adhesion=law)
    steps = row["delta_at_pulloff"] + np.array([0.1, 0.02, 0.0, -0.02, -0.04, -0.06])
    found = asp.solve(problem, asp.History([asp.FixedGrips(float(step)) for step in steps]))
    # a zone of four pixels at the edge of a contact of twenty: Maugis' transition is within 4 % of
    # JKR there
    assert -min(found.external_force) == pytest.approx(-row["P_pulloff"], rel=0.04)
