"""The fast solver as a part: settings, first guess, states, counted work, coarser grids."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from contact_cases import elastic, rough
from refusals import refused

import asperity as asp
from asperity.contact.operators.convolution import coarse_grid, restricted
from asperity.contact.solve import default_solver
from asperity.contact.solvers.active_set import bounds, first_guess, linear_system, spline_model
from asperity.contact.solvers.active_set import solver as solver_module
from asperity.contact.solvers.active_set.first_guess import COARSEST, coarsened, highest_points, nested_start
from asperity.contact.solvers.active_set.linear_system import Stopping
from asperity.contact.solvers.protocol import relative_error
from asperity.core.engine import SQUARE_SIDE, cpu
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import ActiveSet, ContactQP, FixedMean, FixedOffset, run

BOUNDARIES = pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)


def posed(shape: tuple[int, int], boundary: Any = None, load: float = 0.05) -> ContactQP:
    operator = asp.solvers.prepare_operator(HalfSpace(1.0), asp.Grid(shape, (1.0, 1.0)), boundary or asp.Periodic())
    heights = rough(shape, 21).heights
    return ContactQP(operator, heights, np.inf, FixedMean(load), float(heights.std()))


@pytest.mark.parametrize(
    ("settings", "subject", "shown"),
    [
        ({"tolerance": 0.0}, "tolerance of the solver active_set", "0.0"),
        ({"tolerance": 1.0}, "tolerance of the solver active_set", "1.0"),
        ({"max_iterations": 0}, "iteration limit of the solver active_set", "0"),
        (
            {"precision": "half"},
            "precision of the solver active_set",
            "'half'",
        ),
    ],
)
def test_bad_settings_are_refused(settings: dict[str, Any], subject: str, shown: str) -> None:
    with refused(asp.InputError, subject, shown):
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
        assert following.applications >= state.applications
        assert following.extra_pairs >= state.extra_pairs
        assert following.applications + following.extra_pairs > state.applications + state.extra_pairs
        state = following


@BOUNDARIES
@pytest.mark.parametrize("cap", [np.inf, 0.3])
@pytest.mark.parametrize("precision", ["mixed", "single"])
def test_the_same_steps_follow_from_a_copied_state_to_the_bit(boundary: Any, cap: float, precision: Any) -> None:
    """Wherever in a run the copy is made, and although the run goes on in between, in work arrays
    that both share."""
    qp, solver = replace(posed((70, 66), boundary), cap=cap), ActiveSet(precision=precision)
    state, copies = solver.init(qp, None), []
    for _ in range(6):
        copies.append(state.copy())
        state = solver.step(qp, state)
    for made_after, branch in enumerate(copies):
        for _ in range(made_after, 6):
            branch = solver.step(qp, branch)
        np.testing.assert_array_equal(branch.pressure, state.pressure)
        np.testing.assert_array_equal(branch.deflection, state.deflection)
        assert (branch.error, branch.iterations, branch.applications, branch.extra_pairs) == (
            state.error,
            state.iterations,
            state.applications,
            state.extra_pairs,
        )


def test_steps_leave_a_copied_state_alone_and_refuse_one_used_up() -> None:
    qp, solver = posed((40, 36)), ActiveSet()
    state = solver.step(qp, solver.init(qp, None))
    kept = state.copy()
    pressure, deflection = kept.pressure.copy(), kept.deflection.copy()
    solver.step(qp, solver.step(qp, state))
    np.testing.assert_array_equal(kept.pressure, pressure)
    np.testing.assert_array_equal(kept.deflection, deflection)
    for use_again in (lambda: solver.step(qp, state), state.copy):
        with refused(asp.InputError, "state of the solver active_set"):
            use_again()


@BOUNDARIES
@pytest.mark.parametrize("cap", [np.inf, 0.3])
@pytest.mark.parametrize("control", [FixedMean(0.05), FixedOffset(1.0)], ids=["load", "position"])
def test_the_reported_error_is_that_of_the_fields(boundary: Any, cap: float, control: Any) -> None:
    """Of the positive pressures, plus tension over load; the deflection is that of the pressure at
    every step."""
    qp = replace(posed((40, 36), boundary), cap=cap, constraint=control)
    for precision, rounding in (("mixed", 2.0**-22), ("double", 1e-12)):
        solver = ActiveSet(precision=precision)  # type: ignore[arg-type]
        state, tensions = solver.init(qp, None), []
        for _ in range(4):
            exact = qp.operator.apply(state.pressure)
            largest = float(np.abs(exact).max())
            pressing = np.maximum(state.pressure, 0.0)
            tensions.append((pressing - state.pressure).sum() / pressing.sum())
            expected = relative_error(qp, pressing, exact) + tensions[-1]
            assert state.error == pytest.approx(expected, rel=1e-6, abs=rounding * largest / qp.height_scale)
            np.testing.assert_allclose(state.deflection, exact, atol=rounding * largest)
            if control == FixedMean(0.05):
                assert state.pressure.mean() == pytest.approx(0.05, rel=rounding)
            state = solver.step(qp, state)
        assert (max(tensions) > 0.0) == np.isinf(cap)  # with a cap all steps are clipped


@BOUNDARIES
def test_answers_keep_their_bounds_and_load_whenever_a_run_ends(boundary: Any) -> None:
    for limit in (1, 2, 3, 300):
        solution = run(ActiveSet(max_iterations=limit), posed((40, 36), boundary))
        assert solution.state.pressure.min() >= 0.0
        assert solution.state.pressure.mean() == pytest.approx(0.05, rel=1e-13)
        assert solution.status.converged == (limit == 300)


@BOUNDARIES
def test_monotone_steps_lead_to_the_same_answer(boundary: Any) -> None:
    qp = posed((128, 120), boundary)
    unclipped, monotone = (run(ActiveSet(tolerance=1e-9, monotone=flag), qp) for flag in (False, True))
    scale = float(unclipped.state.pressure.max())
    # errors of 1e-9 leave a pressure within some 1e-6, see the accuracy table of the benchmarks
    np.testing.assert_allclose(unclipped.state.pressure, monotone.state.pressure, atol=1e-5 * scale)


@pytest.mark.parametrize("refinements", [0, 3])
def test_unclipped_steps_end_where_they_do_not_help(refinements: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """With first steps much too long none of them helps: closer solutions make up for it; without
    these clipped steps take over, and the answer is found."""
    monkeypatch.setattr("asperity.contact.solvers.active_set.linear_system._STEP_LENGTH", 50.0)
    monkeypatch.setattr(solver_module, "_MOST_REFINEMENTS", refinements)
    qp = posed((64, 60))
    # a start that is given: its first step is measured, and helps
    state, solver = ActiveSet().init(qp, highest_points(qp)), ActiveSet(tolerance=1e-9)
    unclipped = 0
    while state.error > solver.tolerance:
        state = solver.step(qp, state)
        unclipped += int(state.memory.unsuccessful is not None)  # type: ignore[attr-defined]
        assert state.iterations < 60
    assert unclipped >= 3
    assert (unclipped < state.iterations) is (refinements == 0)
    assert state.pressure.min() >= 0.0


def test_work_on_coarser_grids_is_counted_in_pairs_of_the_fine_one() -> None:
    small, large = posed((64, 64)), posed((128, 128))
    assert nested_start(small, ActiveSet()).pairs == 0.0
    start = nested_start(large, ActiveSet(tolerance=0.5))  # looser than the loosest it would ask for
    coarse = run(ActiveSet(tolerance=0.5).loosened(0.5), coarsened(large)).state
    assert start.pairs == pytest.approx((coarse.applications + coarse.extra_pairs) / 4.0)
    assert start.pressure.mean() == pytest.approx(0.05, rel=1e-12)
    assert start.pressure.min() >= 0.0
    assert start.deflection is None  # half-spaces need no steps on the model before the first product


def film(ratio: float, thickness: float) -> asp.Layered:
    return asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))


def smooth(n: int, seed: int) -> asp.Surface:
    """Self-affine surface of n x n points with waves down to 8."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0
    )
    return asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=seed)


def pairs_on(body: asp.Layered, load: float, n: int, seeds: tuple[int, ...]) -> list[float]:
    """FFT pairs on surfaces of n x n points."""
    found = []
    for seed in seeds:
        problem, solver = asp.ContactProblem(smooth(n, seed), body), ActiveSet(tolerance=1e-6)
        found.append(asp.solve(problem, asp.MeanPressure(load), solver=solver).certificate.fft_pairs)
    return found


@pytest.mark.parametrize("ratio", [1000.0, 3000.0])
def test_closer_solutions_spare_clipped_steps_on_very_stiff_films(
    ratio: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Loosely solved, the set goes in circles. Clipped steps, an independent way to the answer,
    take more than twice as many products."""
    problem, solver = asp.ContactProblem(smooth(128, 1), film(ratio, 1.0)), ActiveSet(tolerance=1e-8)
    closely = asp.solve(problem, asp.MeanPressure(0.75), solver=solver)
    monkeypatch.setattr(solver_module, "_MOST_REFINEMENTS", 0)
    clipped = asp.solve(problem, asp.MeanPressure(0.75), solver=solver)
    assert 2.0 * closely.certificate.fft_pairs < clipped.certificate.fft_pairs
    scale = float(clipped.pressure.max())
    np.testing.assert_allclose(closely.pressure, clipped.pressure, atol=1e-4 * scale)


def guess(body: asp.Layered, engine: Any) -> linear_system.Workspace:
    """A start prolonged from the coarser grid, and its deflection, on 128 x 128 points at a mean
    pressure of 0.2."""
    problem = asp.ContactProblem(smooth(128, 2), body)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    heights = np.asarray(problem.surface.heights, dtype=float)
    qp = ContactQP(operator, heights, np.inf, FixedMean(0.2), float(heights.std()))
    return linear_system.Workspace.of(qp.resident, "mixed", nested_start(qp.resident, ActiveSet()).pressure)


@pytest.mark.parametrize("engine", [asp.engines.CpuEngine(1), asp.engines.ArrayEngine(np)], ids=["cpu", "arrays"])
@pytest.mark.parametrize("rounds", [1, 2, 3])
def test_narrowing_keeps_load_and_bounds_and_tells_its_change(engine: Any, rounds: int) -> None:
    """Points leave with the pressure they have lost; the change, told on the set before, is that of
    the pressure in single precision."""
    work = guess(film(10.0, 4.0), engine)
    qp, survey = work.qp, work.survey()
    level = bounds.plane_level(qp, survey.totals)
    free = bounds.free_set(survey, level, qp.height_scale, work.scaled.dtype, wide=True)
    before, residual = np.array(work.pressure), free.residual(centred=True)
    kept = free.copy(residual)
    left, r, change = bounds.narrowed(work, free, residual, rounds=rounds)
    pressure = np.array(work.pressure)
    assert pressure.min() == 0.0
    assert pressure.mean() == pytest.approx(0.2, rel=1e-12)
    assert left.size == np.count_nonzero(pressure) < free.size
    told, unchanged = np.zeros(pressure.shape, np.float32), np.zeros(pressure.shape, np.float32)
    free.scatter(change.values, told)
    largest = float(np.abs(pressure - before).max())
    np.testing.assert_allclose(told * work.unit, pressure - before, rtol=0.0, atol=1e-6 * largest)
    left.scatter(r, unchanged)
    given = np.zeros(pressure.shape, np.float32)
    free.scatter(kept, given)
    np.testing.assert_array_equal(unchanged, np.where(pressure > 0.0, given, 0.0))
    assert not np.any(work.scaled.field)


def test_a_second_narrowing_lets_points_go_that_will_not_touch_and_few_others() -> None:
    """Against the contact of the same problem: a set for narrowing lacks fewer points, and those
    too many leave it."""
    body = film(10.0, 4.0)
    answer = asp.solve(asp.ContactProblem(smooth(128, 2), body), asp.MeanPressure(0.2)).pressure > 0.0
    lacking, excess = {}, {}
    for rounds in (0, 1, 2):
        work = guess(body, asp.engines.CpuEngine(1))
        qp, survey = work.qp, work.survey()
        level = bounds.plane_level(qp, survey.totals)
        free = bounds.free_set(survey, level, qp.height_scale, work.scaled.dtype, wide=rounds > 0)
        if rounds:
            free = bounds.narrowed(work, free, free.residual(centred=True), rounds=rounds).free
        inside = np.zeros(answer.shape, np.float32)
        free.scatter(free.zeros() + 1.0, inside)
        lacking[rounds] = np.count_nonzero(answer & (inside == 0.0))
        excess[rounds] = np.count_nonzero(~answer & (inside > 0.0))
    assert max(lacking[1], lacking[2]) < lacking[0]
    assert excess[2] < excess[1] < excess[0]


def test_stiff_films_take_few_products() -> None:
    """A film of E 10, four points thick, 5.8 pairs, one of E 100, two thick, 7.7."""
    assert sum(pairs_on(film(10.0, 4.0), 0.2, 256, (1, 2, 3))) <= 19.5
    assert max(pairs_on(film(100.0, 2.0), 0.4, 512, (1, 2))) <= 10.0


@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(0.3)], ids=["elastic", "capped"])
def test_a_result_takes_no_product_beyond_those_of_the_solver(law: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    products, apply = [0], cpu._Convolution.apply

    def counting(self: Any, *given: Any) -> Any:
        products[0] += 1
        return apply(self, *given)

    monkeypatch.setattr(cpu._Convolution, "apply", counting)
    result = asp.solve(asp.ContactProblem(rough((64, 48), 21), elastic(1.0), law=law), asp.MeanPressure(0.05))
    assert products[0] == result.certificate.fft_pairs > 5


def test_a_cap_costs_at_most_a_fifth_more_pairs() -> None:
    """Mean of two surfaces at the loads of the table in ``benchmarks``, where a third of the
    contact yields."""
    pairs = dict.fromkeys((asp.plasticity.HardWall(), asp.Hardness(0.3)), 0.0)
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=64.0, shortest_wavelength=8.0
    )
    for seed in (1, 2):
        surface = asp.generate.gaussian(asp.Grid((256, 256), (1.0, 1.0)), spectrum, seed=seed)
        for law in pairs:
            for load in (0.02, 0.1):
                problem = asp.ContactProblem(surface, elastic(1.0), law=law)
                found = asp.solve(problem, asp.MeanPressure(load), solver=ActiveSet(tolerance=1e-6))
                pairs[law] += found.certificate.fft_pairs
    free, capped = pairs.values()
    assert capped <= 1.2 * free


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
    flat = qp.operator.engine.prolonged(halved, halved, cut, 0.0)
    np.testing.assert_array_equal(restricted(flat), np.maximum(halved, 0.0))


def test_lines_and_small_grids_have_no_coarser_one() -> None:
    for shape in ((1, 1000), (COARSEST, 500)):
        assert nested_start(posed(shape), ActiveSet()).pairs == 0.0


@pytest.mark.parametrize("load", [0.01, 0.05, 0.2])
def test_the_coarsest_guess_loads_about_as_many_of_the_highest_points_as_will_touch(load: float) -> None:
    qp = posed((64, 60), load=load)
    loaded = highest_points(qp)
    assert loaded is not None
    assert qp.profile[loaded > 0.0].min() >= qp.profile[loaded == 0.0].max()
    assert 0.6 <= loaded.sum() / np.count_nonzero(run(ActiveSet(), qp).state.pressure) <= 1.6
    small = replace(qp.operator.grid, spacing=(2e-9, 2e-9))  # all lengths, and so moduli over a length
    tiny = replace(
        qp, operator=asp.solvers.prepare_operator(HalfSpace(1.0), small, asp.Periodic()), profile=2e-9 * qp.profile
    )
    np.testing.assert_array_equal(highest_points(tiny), loaded)


def test_without_slope_or_load_all_points_are_the_guess_on_the_coarsest_grid() -> None:
    qp = posed((12, 10))
    assert highest_points(replace(qp, profile=np.ones((12, 10)))) is None
    assert highest_points(replace(qp, constraint=FixedOffset(0.0))) is None
    assert highest_points(posed((12, 10), load=1e6)).all()  # type: ignore[union-attr]


@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(0.3)], ids=("elastic", "capped"))
def test_the_product_that_ends_a_solve_serves_a_last_step(law: Any, monkeypatch: Any) -> None:
    """With and without such steps the pressures agree to the tolerance, the load and the bounds are
    kept; with them products are fewer."""
    surfaces = [rough((128, 128), seed) for seed in (1, 2, 3, 4)]

    def solved() -> list[asp.ContactResult]:
        problems = (asp.ContactProblem(surface, elastic(1.0), law=law) for surface in surfaces)
        return [asp.solve(p, asp.MeanPressure(0.05), solver=ActiveSet(tolerance=1e-6)) for p in problems]

    with_step, stopping = solved(), ActiveSet._stopping

    def measured(self: Any, memory: Any, free: Any, error: float) -> Stopping:
        found = stopping(self, memory, free, error)
        return found if found.ending is None else Stopping(0.1, 8)

    monkeypatch.setattr(ActiveSet, "_stopping", measured)
    without = solved()
    assert sum(r.certificate.fft_pairs for r in with_step) < sum(r.certificate.fft_pairs for r in without)
    for one, other in zip(with_step, without, strict=True):
        assert max(one.certificate.field_error, other.certificate.field_error) <= 1e-6
        assert one.pressure.mean() == pytest.approx(0.05, rel=1e-12)
        assert one.pressure.min() == 0.0
        assert np.linalg.norm(one.pressure - other.pressure) <= 1e-4 * np.linalg.norm(other.pressure)


def test_the_page_of_the_algorithm_states_the_constants_of_the_code() -> None:
    page = (Path(__file__).parents[3] / "docs/theory/contact.md").read_text(encoding="utf-8")
    settled, nearly = solver_module._SETTLED_SET, solver_module._NEARLY_SETTLED
    for phrase in (
        (
            f"n > {solver_module._SETTLED} |F|  :  reduction {solver_module._REDUCTION} · "
            f"{solver_module._CLOSER}^refinements,  at most {solver_module._UNSETTLED_STEPS} · "
        ),
        f"2^min(fallbacks + {solver_module._CLOSER_DOUBLINGS} refinements, {solver_module._MOST_DOUBLINGS}) steps",
        f"reduction {nearly.reduction},  at most {nearly.max_steps} steps",
        (
            f"at most {settled.max_steps} steps    ({solver_module._MARGIN} tol/ε if larger, "
            f"{solver_module._REDUCTION} at most)"
        ),
        f"has fallen by {solver_module._MARGIN} tol/({solver_module._LAST_STEP} ε)",
        f"{solver_module._MARGIN} tol/ε ≥ {solver_module._SINGLE}",
        f"(below {solver_module._CLOSELY} one more step on B)",
        f"For a steepness up to {spline_model._STEEP:g} (",
        f"{spline_model._STIFF:g} on lines",
        f"more than {spline_model._STIFF:g} times that of the shortest waves",
        f"{spline_model._CORRECTION:g}\\,T^{{-1}}HD",
        f"pixels of {spline_model._SLENDER:g} to 1 and more slender have no averages",
        f"{linear_system._MODEL_STEPS} steps of conjugate gradients for $B$",
        f"{linear_system._LAST_LENGTH} of the length of the first",
        f"θ ≥ {bounds.LEAST_SHARE}:",
        f"square of {SQUARE_SIDE} pixels",
        f"${first_guess._FINE_STIFFNESS}/\\hat c_0$",
        f"erf({first_guess._AREA_PER_LOAD:g} p̄/E*s)",
        f"a steepness above {first_guess._SETTLING_FROM:g}:",
        f"the start given, if ε ≤ {solver_module._POOR}",
    ):
        assert phrase in page, phrase
