"""Contact under a prescribed shear traction against closed forms, and what it has in common with
sliding."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.contact import stamp_contact
from asperity.core.errors import InputError
from asperity.friction import shear_displacement, sheared

BODY = asp.Elastic(0.91, 0.3)  # E' = 1
LINE = asp.FreeLine(datum=4.0)


@every_row(reference("missing/prescribed_shear_punch"))
def test_flat_stamps_of_reference(row: Row) -> None:
    """Under a uniform shear; the error halves with the spacing, as in ``test_stamps``."""
    found = []
    for points in (500, 1000, 2000):
        flat = asp.Surface(np.zeros((points, 1)), 2.0 / points, 1.0)
        traction = np.zeros((2, points, 1))
        traction[0] = row["tau0_over_Eprime"]
        turned = sheared(flat, traction, BODY, boundary=LINE)
        field = stamp_contact(turned, BODY, row["P_over_Eprime_a"] / 2.0, boundary=LINE)
        x = -1.0 + (np.arange(points) + 0.5) * 2.0 / points
        found.append(np.interp(row["x_over_a"], x, field.pressure[:, 0]))
    coarse, fine = 2.0 * found[1] - found[0], 2.0 * found[2] - found[1]
    assert abs(fine - row["p_over_Eprime"]) < abs(fine - coarse) + 1e-12
    assert fine == pytest.approx(row["p_over_Eprime"], rel=1e-4)


def test_waves_of_shear_move_the_surface_as_in_the_closed_form() -> None:
    """-i (1 - 2ν)/(2G) q·τ/q², in a periodic cell; across the wave, and uniform, it moves
    nothing."""
    grid = asp.Grid((32, 24), (1e-6, 2e-6))
    x, y = grid.coordinates()
    qx, qy = 2.0 * np.pi * 3 / 32e-6, 2.0 * np.pi * 2 / 48e-6
    wave = np.cos(qx * x + qy * y)
    along, across = np.stack([2.0 * wave, 5.0 * wave]), np.stack([-qy * wave, qx * wave])
    steel = asp.Elastic(200e9, 0.3)
    found = shear_displacement(grid, along, steel)
    expected = 0.4 / (2.0 * steel.shear_modulus) * (2.0 * qx + 5.0 * qy) / (qx**2 + qy**2)
    expected = expected * np.sin(qx * x + qy * y)
    scale = np.abs(expected).max()
    assert np.abs(found - expected).max() < 1e-10 * scale
    for still in (across / qx, np.ones_like(along)):
        assert np.abs(shear_displacement(grid, still, steel)).max() < 1e-10 * scale


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free(), asp.FreeLine()])
def test_incompressible_and_equal_bodies_are_not_moved(boundary: asp.contact.Boundary) -> None:
    shape = (16, 1) if isinstance(boundary, asp.FreeLine) else (16, 12)
    grid = asp.Grid(shape, (1e-6, 1e-6))
    traction = np.random.default_rng(3).normal(size=(2, *shape))
    steel, rubber = asp.Elastic(1.0, 0.3), asp.Elastic(1.0, 0.5)
    scale = np.abs(shear_displacement(grid, traction, steel, boundary=boundary)).max()
    assert np.abs(shear_displacement(grid, traction, rubber, boundary=boundary)).max() < 1e-12 * scale
    assert (
        np.abs(shear_displacement(grid, traction, steel, counter_body=steel, boundary=boundary)).max() < 1e-12 * scale
    )
    swapped = shear_displacement(grid, traction, asp.Rigid(), counter_body=steel, boundary=boundary)
    assert swapped == pytest.approx(-shear_displacement(grid, traction, steel, boundary=boundary), abs=1e-12 * scale)


def test_the_shear_of_a_body_that_slides_gives_its_pressure() -> None:
    """The contact of a sliding ball is found again from the tractions that it ends with."""
    grid = asp.Grid((48, 48), (1e-7, 1e-7))
    ball, body = asp.generate.sphere(grid, radius=5e-5), asp.Elastic(100e9, 0.1)
    load, solver = asp.MeanPressure(1e8), asp.solvers.ActiveSet(tolerance=1e-10)
    slides = asp.ContactProblem(ball, body, friction=asp.Coulomb(0.4), boundary=asp.Free())
    slid = asp.solve(slides, load, solver=solver, rounds=asp.solvers.Rounds(tolerances={"sliding": 1e-9}))
    alone = asp.solve(asp.ContactProblem(ball, body, boundary=asp.Free()), load, solver=solver)
    traction = np.stack([0.4 * slid.pressure, np.zeros(grid.shape)])
    turned = asp.ContactProblem(sheared(ball, traction, body, boundary=asp.Free()), body, boundary=asp.Free())
    found = asp.solve(turned, load, solver=solver)
    largest = slid.max_pressure
    assert np.abs(found.pressure - slid.pressure).max() < 1e-6 * largest
    assert np.abs(found.pressure - alone.pressure).max() > 1e-2 * largest


def test_refused() -> None:
    grid = asp.Grid((8, 6), (1.0, 1.0))
    for traction in (np.zeros((3, 8, 6)), np.zeros((2, 6, 8))):
        with refused(InputError, "shear traction (Pa)", str(traction.shape)):
            shear_displacement(grid, traction, BODY)
    with refused(InputError, "shear traction (Pa)", "96"):
        shear_displacement(grid, np.full((2, 8, 6), np.nan), BODY)
    with pytest.raises(InputError):
        sheared(grid, np.zeros((2, 8, 6)), BODY)  # type: ignore[arg-type]
