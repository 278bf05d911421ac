"""Pages on the sealing of contacts, on fewer surfaces and points: all claims hold, and they belong
to their scripts."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import leakage
import numpy as np
import percolation
import pytest
from validation_pages import assert_claims_hold, assert_written_by_script, written_rows

import asperity as asp
from asperity import sealing

RUNS = {
    "percolation": lambda: percolation.page(seeds=2, points=128, grids=(128, 256), wave_grids=(32, 64), rounds=6),
    "leakage": lambda: leakage.page(seeds=2, points=128, grids=(64, 128, 256), wave_points=64),
}


@cache
def page_of(name):
    return RUNS[name]()


@pytest.mark.parametrize("name", RUNS)
def test_every_claim_holds(name):
    assert_claims_hold(page_of(name))


@pytest.mark.parametrize("name", RUNS)
def test_page_belongs_to_the_script(name):
    assert_written_by_script(page_of(name), name)


@pytest.mark.parametrize(("turned", "column"), [(False, 1), (True, 4)])
def test_closing_load_is_that_of_the_page(turned, column):
    """The load of the page, with its four digits, lies in the bracket; a way is open at one end and
    none at the other, and one pixel more or less on the way through the neck is what the areas
    differ by."""
    n = 64
    surface = percolation.waves(n, turned=turned)
    problem = asp.ContactProblem(surface, asp.Elastic(percolation.E_STAR, 0.0))
    full = percolation.E_STAR * percolation.rms_gradient(surface)
    found = sealing.closing_load(problem, (0.1 * full, 0.6 * full), rounds=percolation.WAVE_ROUNDS)
    row = next(row for row in written_rows("percolation", "Crossed waves whose") if row[0] == f"{n}²")
    assert found.lower < (float(row[column]) + 5e-5) * full
    assert (float(row[column]) - 5e-5) * full < found.upper
    assert found.upper / found.lower == pytest.approx(6.0 ** (0.5**percolation.WAVE_ROUNDS), rel=1e-9)
    assert sealing.leakage(asp.solve(problem, asp.MeanPressure(found.upper)), sealing.ViscousLiquid(1.0), 1.0).sealed
    assert not sealing.leakage(
        asp.solve(problem, asp.MeanPressure(found.lower)), sealing.ViscousLiquid(1.0), 1.0
    ).sealed
    # what closes are the necks of one period, alike by symmetry: four of two pixels at most
    assert 0.0 < found.closed_fraction - found.open_fraction <= 8.0 / n**2


@pytest.mark.parametrize("n", [32, 64])
def test_loads_without_and_with_corners_enclose_the_limit_along_the_diagonals(n):
    """Necks along the diagonals of the grid close at corners first; the limit of the page lies
    between the loads at which spots meet at corners and at faces."""
    surface = percolation.waves(n, turned=True)
    problem = asp.ContactProblem(surface, asp.Elastic(percolation.E_STAR, 0.0))
    full = percolation.E_STAR * percolation.rms_gradient(surface)
    between, limit = (0.15 * full, 0.4 * full), 0.2286
    first = sealing.closing_load(problem, between, rounds=9)
    last = sealing.closing_load(problem, between, rounds=9, corners=True)
    assert first.upper < limit * full < last.upper
    assert last.lower > first.lower


def test_the_pixel_bracket_of_crossed_waves_closes():
    """Along the axes from above, along the diagonals from below, and nearer with each grid."""
    rows = [row for row in written_rows("percolation", "Crossed waves whose") if row[0].endswith("²")]
    widths = [float(row[3]) - float(row[6]) for row in rows]
    assert all(width > 0.0 for width in widths)
    assert all(fine < coarse for coarse, fine in pairwise(widths))
    loads = [float(row[1]) - float(row[4]) for row in rows]
    assert loads[0] > loads[1] > loads[2] >= 0.0


def test_leak_of_the_page_is_that_of_a_flow_of_its_own():
    """K of both directions at one load of one surface against the tensor of its gap."""
    surface = leakage.rough(leakage.HURST, 0, 64)
    problem = asp.ContactProblem(surface, asp.Elastic(leakage.E_STAR, 0.0))
    load = 0.06 * leakage.E_STAR * leakage.rms_gradient(surface)
    found = leakage.leak_of(problem, load)
    result = asp.solve(problem, asp.MeanPressure(load))
    tensor = sealing.flow_tensor(result.gap * ~result.contact, surface.grid).matrix
    assert found.flow == pytest.approx(0.5 * np.trace(tensor) / surface.heights.std() ** 3, rel=1e-6)
    assert found.area == result.area_fraction
