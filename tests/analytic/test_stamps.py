"""Stamps of prescribed shape against closed forms: on a line, on a disc, on a periodic cell."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import chebyshev
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.contact import stamp_contact
from asperity.core.errors import ConvergenceError, InputError

BODY = asp.Elastic(0.91, 0.3)  # E* = 1 against a rigid stamp
LINE = asp.FreeLine(datum=4.0)


def _stamp(points: int, coefficients: float | str, load: float) -> tuple[np.ndarray, asp.contact.StampField]:
    """Stamp of width 2 that leaves the surface along the Chebyshev series of ``coefficients``."""
    x = -1.0 + (np.arange(points) + 0.5) * 2.0 / points
    depth = chebyshev.chebval(x, [float(value) for value in str(coefficients).split()])
    surface = asp.Surface(-depth[:, None], 2.0 / points, 1.0)
    return x, stamp_contact(surface, BODY, load / 2.0, boundary=LINE)


@every_row(reference("missing/rigid_stamp"))
def test_stamps_of_reference(row: Row) -> None:
    """The error halves with the spacing: without its first order it is below the change that this
    makes on the grids before."""
    load = row["P_over_Estar_a"]
    found = []
    for points in (500, 1000, 2000):
        x, field = _stamp(points, row["chebyshev_coefficients_over_a"], load)
        found.append(np.interp(row["x_over_a"], x, field.pressure[:, 0]))
        assert field.force == pytest.approx(load, rel=1e-12)
    coarse, fine = 2.0 * found[1] - found[0], 2.0 * found[2] - found[1]
    assert abs(fine - row["p_over_Estar"]) < abs(fine - coarse) + 1e-9 * load
    assert abs(fine - row["p_over_Estar"]) < 1e-3 * load


SHAPES = {row["shape"]: row for row in reference("missing/rigid_stamp")}


@pytest.mark.parametrize("shape", SHAPES)
def test_edges_come_off_at_the_load_of_reference(shape: str) -> None:
    """Pressure grows in proportion to the load: where it vanishes on the last point."""
    row = SHAPES[shape]
    for end, key in ((0, "P_free_left"), (-1, "P_free_right")):
        free = []
        for points in (500, 1000, 2000):
            at_none, at_one = (
                _stamp(points, row["chebyshev_coefficients_over_a"], load)[1].pressure[end, 0] for load in (0.0, 0.01)
            )
            free.append(-0.01 * at_none / (at_one - at_none))
        coarse, fine = 2.0 * free[1] - free[0], 2.0 * free[2] - free[1]
        assert abs(fine - row[key]) < abs(fine - coarse) + 1e-9
        assert fine == pytest.approx(row[key], rel=2e-3, abs=1e-9)


def test_a_tilted_stamp_needs_a_moment() -> None:
    """-π E* a c₁/4 of the first term c₁ of its shape, whatever the load, the others none."""
    for load in (0.0, 0.002):
        moments = [_stamp(points, "0 0.001 0.0004 0.0002", load)[1].moments[0] for points in (500, 1000)]
        assert 2.0 * moments[1] - moments[0] == pytest.approx(-0.25e-3 * np.pi, rel=1e-4)
        assert moments[1] == pytest.approx(-0.25e-3 * np.pi, rel=5e-3)


def test_a_flat_disc_is_stiff_by_its_diameter() -> None:
    """F = 2 E* a δ, with the radius of the disc of as many pixels to first order."""
    errors = []
    for points in (16, 32):
        grid = asp.Grid((2 * points + 4,) * 2, (1.0 / points,) * 2)
        x, y = grid.centred_coordinates()
        on = x**2 + y**2 < 1.0
        flat = asp.Surface(np.zeros(grid.shape), *grid.spacing)
        field = stamp_contact(flat, BODY, approach=0.01, on=on, boundary=asp.Free())
        errors.append(field.force / 0.02 - 1.0)
        assert field.approach == pytest.approx(0.01, rel=1e-9)
        assert field.energy == pytest.approx(0.5 * field.force * 0.01, rel=1e-9)
        assert field.tension_share == 0.0
    assert abs(errors[1]) < 0.6 * abs(errors[0])
    assert abs(errors[1]) < 0.03


def _waves() -> tuple[asp.Surface, np.ndarray]:
    """Heights, and the pressure E* q h/2 that gives each wave its own."""
    grid = asp.Grid((32, 24), (1e-6, 2e-6))
    x, y = grid.coordinates()
    qx, qy = 2.0 * np.pi * 3 / 32e-6, 2.0 * np.pi * 2 / 48e-6
    first, second = 2e-9 * np.cos(qx * x) * np.ones_like(y), 1e-9 * np.sin(qx * x + qy * y)
    return asp.Surface(first + second, 1e-6, 2e-6), 0.5 * (qx * first + np.hypot(qx, qy) * second)


def test_waves_prescribed_everywhere() -> None:
    """Mode by mode in a periodic cell, with tension at loads of either sign."""
    surface, waves = _waves()
    for load in (0.0, 1e-3, -2e-3):
        field = stamp_contact(surface, BODY, load)
        assert np.abs(field.pressure - load - waves).max() < 1e-9 * np.abs(waves).max()
        assert field.mean_pressure == pytest.approx(load, abs=1e-15)


def test_where_nothing_pulls_it_is_the_contact_of_the_solver() -> None:
    """On all points of contact that ``solve`` finds, with its approach or its load."""
    grid = asp.Grid((48, 48), (1e-7, 1e-7))
    ball = asp.generate.sphere(grid, radius=5e-5)
    body = asp.Elastic(100e9, 0.3)
    problem = asp.ContactProblem(ball, body, boundary=asp.Free())
    contact = asp.solve(problem, asp.MeanPressure(1e8), solver=asp.solvers.ActiveSet(tolerance=1e-12))
    on = contact.pressure > 0.0
    by_load = stamp_contact(ball, body, 1e8, on=on, boundary=asp.Free())
    by_approach = stamp_contact(ball, body, approach=by_load.approach, on=on, boundary=asp.Free())
    for field in (by_load, by_approach):
        assert np.abs(field.pressure - contact.pressure).max() < 1e-6 * contact.pressure.max()
        assert field.tension_share == 0.0


def test_refused() -> None:
    surface, _ = _waves()
    with refused(InputError, "load of a stamp"):
        stamp_contact(surface, BODY)
    with refused(InputError, "load of a stamp", "1.0", "2.0"):
        stamp_contact(surface, BODY, 1.0, approach=2.0)
    with refused(InputError, "approach of a stamp", "1e-09"):
        stamp_contact(surface, BODY, approach=1e-9)
    with refused(InputError, "mean pressure (Pa)", "nan"):
        stamp_contact(surface, BODY, np.nan)
    nowhere = np.zeros(surface.shape, dtype=bool)
    with refused(InputError, "points touched"):
        stamp_contact(surface, BODY, 1.0, on=nowhere)
    heights = np.array(surface.heights)
    heights[0, 0] = np.nan
    holed = asp.Surface(heights, 1e-6, 2e-6)
    with refused(InputError, "points touched", "1"):
        stamp_contact(holed, BODY, 1.0, on=~nowhere)
    assert stamp_contact(holed, BODY, 1.0).pressure[0, 0] == 0.0


def test_a_shape_that_is_missed_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("asperity.contact.stamp._MOST_ROUNDS", 2)
    flat = asp.Surface(np.zeros((64, 1)), 1.0, 1.0)
    with pytest.raises(ConvergenceError) as caught:
        stamp_contact(flat, BODY, approach=1.0, boundary=asp.FreeLine())
    assert isinstance(caught.value.result, asp.contact.StampField)
    assert caught.value.result.misfit > 0.0
