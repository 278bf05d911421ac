"""Flat punch and cone on a free half-space (Sneddon 1965)."""

import numpy as np
import pytest
from contact_cases import elastic, square_grid
from reference_data import every_row, reference

import asperity as asp
from asperity import generate
from asperity.solvers import ConjugateGradient

ROWS = reference("axisymmetric_indenters")
CONES = [row for row in ROWS if row["shape"] == "power" and row["n"] == 1]
PUNCHES = [row for row in ROWS if row["shape"] == "flat"]
SOLVER = ConjugateGradient(tolerance=1e-9)
AT = {0.25: "p_r025a", 0.5: "p_r05a", 0.9: "p_r09a"}


def name(row):
    return f"case{row['case']:g}"


def solved(surface, row, control):
    return asp.solve(asp.ContactProblem(surface, elastic(row["E_star"]), boundary=asp.Free()), control, solver=SOLVER)


def profile(result, radius):
    """Pressure along +x from the centre, as a function of r / radius."""
    n = result.problem.grid.shape[0]
    x, _ = result.problem.grid.centred_coordinates()
    return x[n // 2 :, 0] / radius, result.pressure[n // 2 :, n // 2]


def test_reference_has_both_shapes():
    assert len(CONES) >= 1
    assert len(PUNCHES) >= 3


@every_row(CONES, label=name)
def test_cone(row):
    """At 80 pixels per diameter, radius to half a pixel; approach as for the sphere; the apex is
    log-singular, so

    pressures are compared away from it. Near the rim (0.9 a) the slope of the pressure makes 3
    pixel/a * 0.1 there.
    """
    n, a = 96, row["a"]
    result = solved(generate.cone(square_grid(n, 2.4 * a), slope=row["B"]), row, asp.Force(row["P"]))
    pixel = 2.4 / n
    assert np.sqrt(result.contact_area / np.pi) == pytest.approx(a, rel=pixel / 2.0)
    assert result.approach == pytest.approx(row["delta"], rel=1e-3)
    r, pressure = profile(result, a)
    for at, column in AT.items():
        assert np.interp(at, r, pressure) == pytest.approx(row[column], rel=pixel**2 if at < 0.9 else 3.0 * pixel * 0.1)


@every_row(PUNCHES, label=name)
def test_flat_punch(row):
    """The staircase rim is uncertain by half a pixel, and so is the force 2 E* a delta; the error
    must fall with it."""
    a, errors = row["a"], []
    for n in (48, 192):
        surface = generate.flat_punch(square_grid(n, 2.4 * a), radius=a, depth=10.0 * row["delta"])
        result = solved(surface, row, asp.Approach(row["delta"]))
        pixel = 2.4 / n
        errors.append(abs(result.force / row["P"] - 1.0))
        assert errors[-1] < pixel / 2.0
        r, pressure = profile(result, a)
        for at in (0.25, 0.5):
            assert np.interp(at, r, pressure) == pytest.approx(row[AT[at]], rel=pixel / 2.0)
    assert errors[1] < errors[0] / 2.0


def test_punch_under_force_gives_the_same_answer():
    row = PUNCHES[0]
    surface = generate.flat_punch(square_grid(48, 2.4 * row["a"]), radius=row["a"], depth=10.0 * row["delta"])
    by_approach = solved(surface, row, asp.Approach(row["delta"]))
    by_force = solved(surface, row, asp.Force(by_approach.force))
    assert by_force.approach == pytest.approx(row["delta"], rel=1e-6)
    np.testing.assert_allclose(by_force.pressure, by_approach.pressure, rtol=0, atol=1e-4 * by_force.max_pressure)
