"""Steady rolling against Carter's cylinders, Kalker's linear coefficients, and its own laws."""

import math

import numpy as np
import pytest
from reference_data import reference

import asperity as asp

R, A = 1.0, 0.1


def ball(n, body, law, counter=None, reach=1.15):
    """Paraboloid on n x n pixels whose contact circle has the radius A under ``load_of``."""
    spacing = 2.0 * reach * A / n
    x = (np.arange(n) - 0.5 * (n - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * R), spacing, spacing)
    other = body if counter is None else counter
    return asp.ContactProblem(surface, body, counter_body=other, boundary=asp.Free(), friction=law)


def load_of(problem):
    return asp.Force(4.0 / 3.0 * problem.contact_modulus * A**3 / R)


@pytest.mark.parametrize("row", reference("friction/rolling_carter"), ids=lambda row: f"{row['case']:.0f}")
def test_carters_cylinders(row):
    """Force and tractions at a creepage, first order in the pixel."""
    body = asp.Elastic(row["E_each"], row["nu_each"])
    errors = []
    for n in (64, 128):
        spacing = 2.6 * row["a"] / n
        x = (np.arange(n) - 0.5 * (n - 1)) * spacing
        surface = asp.Surface(-(x[:, None] ** 2) / (2.0 * row["R"]), spacing, 1.0)
        law = asp.Coulomb(row["mu"])
        problem = asp.ContactProblem(surface, body, counter_body=body, boundary=asp.FreeLine(), friction=law)
        found = asp.roll(problem, asp.Force(row["P"]), asp.rolling.Creepage(row["creep"]))
        assert found.converged
        at = np.interp([0.0, 0.9 * row["a"], -0.9 * row["a"]], x, found.traction[0, :, 0])
        expected = np.array([row["q_x0"], row["q_x09a"], row["q_xm09a"]])
        errors.append(np.abs(at - expected).max() / (row["mu"] * row["p0"]))
    assert errors[-1] < max(0.01, 0.6 * errors[0])
    assert errors[-1] < 0.04
    assert found.force_x == pytest.approx(row["Q"], abs=0.005 * row["mu"] * row["P"])
    assert found.dissipated == pytest.approx(row["W_per_distance"], rel=0.03)
    # stick at the leading edge, slip at the trailing one
    slips = np.flatnonzero(found.slipping[:, 0])
    touching = np.flatnonzero(found.normal.contact[:, 0])
    assert slips.size == 0 or slips[0] == touching[0]


def test_kalkers_table():
    """Every row that was at hand to its three digits, but for a misprint; the misprint against its
    neighbours."""
    for row in reference("friction/kalker_coefficients"):
        found = asp.theories.kalker_coefficients(row["a_over_b"], row["nu"])
        for name in ("C11", "C22", "C23", "C33"):
            if (name, row["a_over_b"], row["nu"]) == ("C11", 0.5, 0.5):
                assert pytest.approx(row[name], rel=0.01) == found.C11
            else:
                assert getattr(found, name) == pytest.approx(row[name], rel=1e-8), (name, row)


def test_forces_are_odd_bounded_and_balance_the_heat():
    body, mu = asp.Elastic(1.0, 0.3), 0.3
    problem = ball(40, body, asp.Coulomb(mu))
    load = load_of(problem)
    motion = asp.rolling.Creepage(3e-3, -2e-3, 0.02)
    found = asp.roll(problem, load, motion)
    back = asp.roll(problem, load, asp.rolling.Creepage(-3e-3, 2e-3, -0.02))
    scale = np.abs(found.traction).max()
    assert np.abs(found.traction + back.traction).max() <= 1e-3 * scale
    assert np.all(np.hypot(*found.traction) <= mu * found.normal.pressure * (1.0 + 1e-9))
    # heat by the tractions and slip at points against the power of the forces: an error of first
    # order
    finer = ball(80, body, asp.Coulomb(mu))
    missing = []
    for result in (found, asp.roll(finer, load_of(finer), motion)):
        heat = float(result.power_density.sum()) * result.normal.problem.grid.pixel_area
        assert result.power_density.min() >= 0.0
        missing.append(1.0 - heat / result.dissipated)
    assert 0.0 < missing[1] < 0.6 * missing[0]
    sliding = asp.roll(problem, load, asp.rolling.Creepage(5.0))
    assert sliding.force_x == pytest.approx(mu * sliding.normal.force, rel=1e-4)


def test_thick_layers_roll_as_their_material_and_unlike_bodies_shift_the_pressure():
    body, law = asp.Elastic(1.0, 0.3), asp.Coulomb(0.3)
    thick = asp.Layered([asp.Layer(body, 1e4 * A)], base=asp.Elastic(3.0, 0.2))
    plain, coated = ball(24, body, law), ball(24, thick, law)
    motion = asp.rolling.Creepage(2e-3)
    first, second = (asp.roll(problem, load_of(plain), motion) for problem in (plain, coated))
    assert np.abs(first.traction - second.traction).max() <= 2e-3 * np.abs(first.traction).max()
    unlike = ball(24, body, law, counter=asp.Rigid())
    found = asp.roll(unlike, load_of(unlike), motion)
    pressure = found.normal.pressure
    assert found.converged
    assert np.abs(pressure - pressure[::-1]).max() > 1e-3 * pressure.max()  # shear along x tilts it
    assert np.abs(pressure - pressure[:, ::-1]).max() < 1e-6 * pressure.max()


@pytest.mark.parametrize(
    "options",
    [
        {"boundary": asp.Periodic()},
        {"friction": None},
        {"film": asp.LiquidFilm(surface_tension=0.07, thickness=1e-9), "friction": asp.Coulomb(0.3)},
    ],
    ids=["periodic", "no friction", "film"],
)
def test_what_cannot_roll_is_refused(options):
    surface = asp.Surface(np.zeros((8, 8)), 1e-9, 1e-9)
    problem = asp.ContactProblem(
        surface, asp.Elastic(1e9, 0.3), **{"boundary": asp.Free(), "friction": asp.Coulomb(0.3), **options}
    )
    with pytest.raises(asp.InputError):
        asp.roll(problem, asp.Force(1e-9), asp.rolling.Creepage(1e-3))


def test_creepages_must_be_finite():
    with pytest.raises(asp.InputError):
        asp.rolling.Creepage(math.nan)
