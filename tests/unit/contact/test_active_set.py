"""The fast solver as a part: settings, first guess, states, counted work, coarser grids."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, replace
from typing import Any

import numpy as np
import pytest
from contact_cases import elastic, rough

import asperity as asp
from asperity.contact.operators.coarse import coarse_grid, restricted
from asperity.contact.solvers import ActiveSet, ContactQP, FixedMean, FixedOffset, run
from asperity.contact.solvers.choose import default_solver
from asperity.contact.solvers.nested import COARSEST, coarsened, nested_start
from asperity.contact.solvers.optimality import relative_error
from asperity.solids.compliance.halfspace import HalfSpace

BOUNDARIES = pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)


def posed(shape: tuple[int, int], boundary: Any = None, load: float = 0.05) -> ContactQP:
    operator = asp.prepare_operator(HalfSpace(1.0), asp.Grid(shape, (1.0, 1.0)), boundary or asp.Periodic())
    heights = rough(shape, 21).heights
    return ContactQP(operator, heights, np.inf, FixedMean(load), float(heights.std()))


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"tolerance": 0.0}, "tolerance of the solver active_set must be greater than 0 and less than 1"),
        ({"tolerance": 1.0}, "tolerance of the solver active_set"),
        ({"max_iterations": 0}, "iteration limit of the solver active_set must be a whole number of at least 1"),
        (
            {"precision": "half"},
            "precision of the solver active_set must be one of mixed, double, single, but is 'half'",
        ),
    ],
)
def test_bad_settings_are_refused(settings: dict[str, Any], message: str) -> None:
    with pytest.raises(asp.InputError, match=message):
        ActiveSet(**settings)


def test_it_is_a_frozen_value_and_the_default() -> None:
    with pytest.raises(FrozenInstanceError):
        ActiveSet().tolerance = 1.0  # type: ignore[misc]
    problem = asp.ContactProblem(rough((8, 8)), elastic(1.0))
    assert default_solver(problem) == ActiveSet()
    assert asp.solve(problem, asp.MeanPressure(0.1)).certificate.solver == "active_set"


@BOUNDARIES
def test_a_start_without_pressure_is_no_start(boundary: Any) -> None:
    qp = posed((70, 66), boundary)
    nothing = ActiveSet().init(qp, np.zeros(qp.profile.shape))
    np.testing.assert_array_equal(nothing.pressure, ActiveSet().init(qp, None).pressure)


@BOUNDARIES
@pytest.mark.parametrize("cap", [np.inf, 0.3])
def test_steps_go_on_in_the_same_arrays_and_count_their_work(boundary: Any, cap: float) -> None:
    qp, solver = replace(posed((40, 36), boundary), cap=cap), ActiveSet()
    state = solver.init(qp, None)
    for _ in range(4):
        following = solver.step(qp, state)
        assert following.pressure is state.pressure
        assert following.deflection is state.deflection
        assert following.iterations == state.iterations + 1
        assert following.applications > state.applications
        assert following.extra_pairs >= state.extra_pairs
        state = following


@BOUNDARIES
@pytest.mark.parametrize("cap", [np.inf, 0.3])
def test_the_reported_error_is_that_of_the_fields(boundary: Any, cap: float) -> None:
    load = replace(posed((40, 36), boundary), cap=cap)
    for precision, rounding in (("mixed", 2.0**-22), ("double", 1e-12)):
        solver = ActiveSet(precision=precision)  # type: ignore[arg-type]
        for qp in (load, replace(load, constraint=FixedOffset(1.0))):
            state = solver.init(qp, None)
            for _ in range(4):
                exact = qp.operator.apply(state.pressure)
                floor = rounding * float(np.abs(exact).max()) / qp.height_scale
                assert state.error == pytest.approx(relative_error(qp, state.pressure, exact), rel=1e-6, abs=floor)
                state = solver.step(qp, state)


def test_work_on_coarser_grids_is_counted_in_pairs_of_the_fine_one() -> None:
    small, large = posed((64, 64)), posed((128, 128))
    assert nested_start(small, ActiveSet())[1] == 0.0
    start, pairs = nested_start(large, ActiveSet(tolerance=0.5))  # looser than the loosest it would ask for
    coarse = run(ActiveSet(tolerance=0.5).loosened(0.5), coarsened(large)).state
    assert pairs == pytest.approx((coarse.applications + coarse.extra_pairs) / 4.0)
    assert start.mean() == pytest.approx(0.05, rel=1e-12)
    assert start.min() >= 0.0


@pytest.mark.parametrize("shape", [(131, 97), (65, 300), (128, 66)])
def test_coarser_problems_cover_the_same_area_and_keep_means(shape: tuple[int, int]) -> None:
    qp = replace(posed(shape), cap=np.random.default_rng(1).uniform(1.0, 2.0, shape))
    coarse = coarsened(qp)
    assert coarse.operator.grid == coarse_grid(qp.operator.grid)
    assert coarse.operator.grid.size == pytest.approx(qp.operator.grid.size)
    assert coarse.profile.shape == tuple(-(-n // 2) for n in shape)
    assert isinstance(coarse.cap, np.ndarray)
    assert coarse.cap.shape == coarse.profile.shape
    assert coarse.operator is coarsened(qp).operator  # prepared once
    even = tuple(2 * (n // 2) for n in shape)
    cut = qp.profile[: even[0], : even[1]]
    assert restricted(cut).mean() == pytest.approx(cut.mean(), abs=1e-13)
    halved = restricted(cut)
    flat = qp.operator.engine.refined(halved, halved, cut, 0.0)
    np.testing.assert_array_equal(restricted(flat), np.maximum(halved, 0.0))


def test_lines_and_small_grids_have_no_coarser_one() -> None:
    for shape in ((1, 1000), (COARSEST, 500)):
        assert nested_start(posed(shape), ActiveSet())[1] == 0.0
