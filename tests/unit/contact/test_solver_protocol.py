"""The contract of every solver: values in, values out, limits and tolerances respected, failures
flagged, bounds true."""

from __future__ import annotations

import gc
import weakref
from dataclasses import replace

import numpy as np
import pytest
from catalogue import CASES, EXACT, SOLVERS, Case, feasible_start, pair_id, rough, solved
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from refusals import refused

import asperity as asp
from asperity import Grid, InputError
from asperity.contact.operators import PeriodicOperator
from asperity.contact.solvers.protocol import best_level, duality_gap, relative_error, scaled_to_load
from asperity.contact.solvers.reference import nnls
from asperity.contact.solvers.reference.steepest_descent import shifted_to_load
from asperity.core.status import Outcome
from asperity.errors import NoSolutionError
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import SOLVERS as CLASSES
from asperity.solvers import (
    ActiveSet,
    ContactQP,
    FixedMean,
    FixedOffset,
    Lemke,
    NonNegativeLeastSquares,
    QuasiNewton,
    Solver,
    SteepestDescent,
    run,
    solver_by_name,
)

BY_NAME = {case.name: case for case in CASES}
SOME = [
    BY_NAME[name]
    for name in (
        "rough periodic load",
        "rough free approach",
        "rough periodic hardness load",
        "rough periodic hardness approach",
    )
]
every_solver = pytest.mark.parametrize("solver", SOLVERS.values(), ids=pair_id)
some_cases = pytest.mark.parametrize("case", SOME, ids=pair_id)


def posed(case: Case) -> ContactQP:
    return solved(case, EXACT)[0]


@every_solver
@some_cases
def test_neither_start_nor_profile_nor_a_copied_state_is_changed(solver: Solver, case: Case) -> None:
    qp = posed(case)
    start = feasible_start(qp)
    copy, profile = start.copy(), qp.profile.copy()
    state = solver.init(qp, start)
    kept = state.copy()
    before = (kept.pressure.copy(), kept.deflection.copy(), kept.error, kept.iterations, kept.applications)
    following = solver.step(qp, state)
    solver.step(qp, following)
    np.testing.assert_array_equal(start, copy)
    np.testing.assert_array_equal(qp.profile, profile)
    np.testing.assert_array_equal(kept.pressure, before[0])
    np.testing.assert_array_equal(kept.deflection, before[1])
    assert (kept.error, kept.iterations, kept.applications) == before[2:]
    assert following is not state
    assert following.iterations > state.iterations
    assert following.applications + following.extra_pairs > state.applications + state.extra_pairs


@every_solver
@some_cases
def test_repeated_steps_from_one_state_agree_exactly(solver: Solver, case: Case) -> None:
    qp = posed(case)
    state = solver.init(qp, feasible_start(qp))
    other = state.copy()
    first, second = solver.step(qp, state), solver.step(qp, other)
    np.testing.assert_array_equal(first.pressure, second.pressure)
    assert first.error == second.error


@every_solver
@some_cases
def test_every_state_is_feasible_and_consistent(solver: Solver, case: Case) -> None:
    qp = posed(case)
    if isinstance(solver, ActiveSet):  # its unclipped steps: see test_active_set
        solver = replace(solver, monotone=True)
    state = solver.init(qp, feasible_start(qp))
    for _ in range(5):
        p = state.pressure
        assert p.min() >= 0.0
        assert (p <= qp.cap).all()
        if isinstance(qp.constraint, FixedMean):
            assert p.mean() == pytest.approx(qp.constraint.mean_pressure, rel=1e-13)
        exact = qp.operator.apply(p)
        # corrections of the fast solver are in single precision, its answer is not: see
        # test_active_set
        rounding = 2.0**-22 if isinstance(solver, ActiveSet) else 1e-12
        largest = float(np.abs(exact).max())
        np.testing.assert_allclose(state.deflection, exact, atol=rounding * largest)
        floor = 1e-12 + (rounding if isinstance(solver, ActiveSet) else 0.0) * largest / qp.height_scale
        assert state.error == pytest.approx(relative_error(qp, p, exact), rel=1e-6, abs=floor)
        state = solver.step(qp, state)


@every_solver
@some_cases
def test_the_answer_as_start_is_recognised(solver: Solver, case: Case) -> None:
    qp, solution = solved(case, solver)
    again = run(solver, qp, solution.state.pressure)
    assert again.status.converged
    assert again.state.iterations == 0


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize("name", ["conjugate_gradient", "steepest_descent", "quasi_newton"])
@some_cases
def test_tighter_tolerance_costs_more_and_is_met(name: str, tolerance: float, case: Case) -> None:
    qp, solution = solved(case, solver_by_name(name, tolerance))
    assert solution.status.converged
    assert relative_error(qp, solution.state.pressure, solution.state.deflection) <= tolerance
    loose = solved(case, solver_by_name(name, 10 * tolerance))[1]
    assert loose.state.iterations <= solution.state.iterations


@every_solver
@some_cases
def test_iteration_limit_is_reported_with_a_remedy(solver: Solver, case: Case) -> None:
    qp = posed(case)
    needed = run(solver, qp, feasible_start(qp)).state.iterations
    limited = solver_by_name(solver.name, 1e-12, 1)
    solution = run(limited, qp, feasible_start(qp))
    if needed == 1:
        assert solution.status.converged
        return
    assert solution.status.outcome is Outcome.ITERATION_LIMIT
    assert "iterations above 1 (max_iterations" in solution.status.remedy
    assert solution.state.iterations == 1
    assert solution.state.pressure.min() >= 0.0


@pytest.mark.parametrize("solver", [SteepestDescent(1e-30), QuasiNewton(1e-30)], ids=pair_id)
@some_cases
def test_a_stall_is_flagged_not_accepted(solver: Solver, case: Case) -> None:
    """On some processors rounding leaves an error of zero to the last digit, which is no stall."""
    solution = solved(case, solver)[1]
    assert solution.state.error < 1e-6
    if solution.state.error <= solver.tolerance:
        assert solution.state.error == 0.0
        assert solution.status.outcome is Outcome.CONVERGED
        return
    assert solution.status.outcome is Outcome.STAGNATED
    assert solution.state.exhausted or solution.state.iterations >= 500
    assert "another solver" in solution.status.remedy


@pytest.mark.parametrize("name", ["nnls", "dense_active_set", "lemke"])
def test_a_direct_method_that_misses_its_tolerance_says_so(name: str) -> None:
    solution = solved(BY_NAME["rough free load"], solver_by_name(name, 1e-30))[1]
    assert solution.status.outcome is Outcome.STAGNATED
    assert solution.state.exhausted


def test_steepest_descent_never_raises_the_energy() -> None:
    for case in SOME:
        qp = posed(case)
        state = SteepestDescent().init(qp, feasible_start(qp))
        energies = []
        for _ in range(20):
            energies.append(energy(qp, state.pressure))
            state = SteepestDescent().step(qp, state)
        assert (np.diff(energies) <= 1e-13 * np.abs(energies).max()).all()


def energy(qp: ContactQP, p: np.ndarray) -> float:
    """V(p) in Pa·m."""
    offset = qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else 0.0
    return float((p * (0.5 * qp.operator.apply(p) - qp.profile + offset)).sum())


def periodic_qp(cap: float | np.ndarray, mean: float, seed: int) -> ContactQP:
    grid = Grid((6, 7), (1e-7, 0.8e-7))
    heights = rough(grid.shape, seed).heights
    return ContactQP(PeriodicOperator(HalfSpace(1e11), grid), heights, cap, FixedMean(mean), 1e-9)


@given(
    seed=st.integers(0, 2**31),
    shape=st.tuples(st.integers(1, 8), st.integers(1, 8)),
    mapped=st.booleans(),
    share=st.sampled_from([0.0, 0.2, 0.9, 1.0]),
)
def test_the_best_level_is_that_of_a_point_with_the_smallest_gap(
    seed: int, shape: tuple[int, int], mapped: bool, share: float
) -> None:
    rng = np.random.default_rng(seed)
    r, cap = rng.standard_normal(shape), rng.uniform(0.2, 2.0, shape) if mapped else 1.5
    pressure = cap * np.minimum(1.0, rng.random(shape) * share / 0.9) if share < 1.0 else cap * np.ones(shape)
    found = duality_gap(pressure, r, cap, best_level(pressure, r, cap))
    smallest = min(duality_gap(pressure, r, cap, float(level)) for level in r.flat)
    assert found <= smallest + 1e-13 * r.size


@settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
@given(
    seed=st.integers(0, 2**31),
    cap=st.sampled_from([np.inf, 1e9, 0.3e9]),
    log_mean=st.floats(5.0, 8.4),
    spread=st.floats(0.0, 6.0),
)
def test_duality_gap_bounds_the_energy_error(seed: int, cap: float, log_mean: float, spread: float) -> None:
    rng = np.random.default_rng(seed)
    qp = periodic_qp(cap, 10.0**log_mean, seed % 5)
    best = run(EXACT, qp, feasible_start(qp))
    assert best.status.converged
    weights = np.exp(spread * rng.standard_normal((6, 7))) * (rng.random((6, 7)) < 0.7)
    weights[0, 0] += 1e-3
    p = scaled_to_load(weights / weights.mean() * qp.constraint.mean_pressure, qp.cap, qp.constraint.mean_pressure)
    r = qp.operator.apply(p) - qp.profile
    error = energy(qp, p) - energy(qp, best.state.pressure)
    rounding = 1e-12 * float((p * (np.abs(r) + np.abs(qp.profile))).sum())
    gap = duality_gap(p, r, qp.cap, best_level(p, r, qp.cap))
    assert -rounding <= error <= gap + rounding
    difference = p - best.state.pressure
    assert 0.5 * float((difference * qp.operator.apply(difference)).sum()) <= error + rounding
    for level in rng.uniform(r.min(), r.max(), 3):
        assert duality_gap(p, r, qp.cap, level) >= gap * (1 - 1e-12)


@settings(max_examples=100)
@given(seed=st.integers(0, 2**31), cap=st.sampled_from([np.inf, 1.0, "map"]), fraction=st.floats(1e-6, 0.999999))
@example(seed=0, cap=1.0, fraction=0.5)
def test_the_load_shift_is_the_nearest_feasible_pressure(seed: int, cap: float | str, fraction: float) -> None:
    rng = np.random.default_rng(seed)
    values = rng.normal(0.0, 2.0, (5, 4))
    bound = rng.uniform(0.1, 2.0, (5, 4)) if cap == "map" else cap
    mean = fraction * (np.mean(bound) if np.isfinite(bound).all() else 1.0)
    p = shifted_to_load(values, bound, mean)
    assert p.mean() == pytest.approx(mean, rel=1e-10)
    assert p.min() >= 0.0
    assert (p <= bound).all()
    inside = (p > 0.0) & (p < bound)
    if inside.any():  # one shift for all; the clipped ones lie beyond their bound with it
        shift = (p - values)[inside]
        np.testing.assert_allclose(shift, shift[0], atol=1e-9)
        assert (values + shift[0])[p == 0.0].max(initial=-np.inf) <= 1e-9
        assert ((values + shift[0]) - bound)[p == bound].min(initial=np.inf) >= -1e-9


def test_lemke_proves_that_there_is_no_solution() -> None:
    grid = Grid((4, 4), (1e-7, 1e-7))
    heights = rough((4, 4)).heights
    beyond = FixedOffset(float(heights.mean()) - 1e-10)
    qp = ContactQP(PeriodicOperator(HalfSpace(1e11), grid), heights, np.inf, beyond, 1e-9)
    with refused(NoSolutionError, "contact conditions"):
        run(Lemke(), qp, np.zeros((4, 4)))


def test_every_pressure_at_its_cap() -> None:
    cap = np.random.default_rng(3).uniform(1e8, 3e8, (6, 7))
    qp = periodic_qp(cap, float(cap.mean()), 2)
    for solver in SOLVERS.values():
        solution = run(solver, qp, feasible_start(qp))
        assert solution.status.converged
        np.testing.assert_allclose(solution.state.pressure, cap, rtol=1e-12)


def test_nnls_reaches_the_cap_by_its_two_sided_form() -> None:
    qp, solution = solved(BY_NAME["rough free hardness load"], NonNegativeLeastSquares())
    assert solution.status.converged
    assert np.count_nonzero(solution.state.pressure == qp.cap) > 10


@pytest.mark.parametrize("name", CLASSES)
def test_solvers_are_found_by_name(name: str) -> None:
    solver = solver_by_name(name, 1e-5, 7)
    assert (solver.name, solver.tolerance, solver.max_iterations) == (name, 1e-5, 7)
    assert solver_by_name(name) == CLASSES[name]()
    assert solver.citation_keys


@pytest.mark.parametrize(
    ("arguments", "subject"),
    [
        (("newton",), "solver"),
        (("lemke", 0.0), "tolerance of the solver lemke"),
        (("lemke", 1e-5, 0), "iteration limit of the solver lemke"),
    ],
)
def test_bad_settings_are_refused(arguments: tuple[object, ...], subject: str) -> None:
    with refused(InputError, subject):
        solver_by_name(*arguments)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=["periodic", "free"])
@pytest.mark.parametrize("cap", [np.inf, 2e8], ids=["elastic", "capped"])
def test_nnls_from_a_coarser_grid_gives_the_same_answer(boundary, cap, monkeypatch) -> None:
    """Spikes of one pixel lie outside the coarse contact at first; the answer is that of all points
    at once."""
    heights = 1e-9 * np.random.default_rng(3).standard_normal((16, 20))
    heights[::7, ::5] += 4e-9
    law = asp.plasticity.HardWall() if np.isinf(cap) else asp.Hardness(cap)
    problem = asp.ContactProblem(asp.Surface(heights, 1e-7), asp.Elastic(1e10, 0.3), boundary=boundary, law=law)
    sizes: list[int] = []
    least_squares = nnls._least_squares

    def counting(qp, heights, taken):
        sizes.append(int(np.count_nonzero(taken)))
        return least_squares(qp, heights, taken)

    monkeypatch.setattr(nnls, "_least_squares", counting)
    found = {}
    for small in (40, 10**6):
        monkeypatch.setattr(nnls, "SMALL", small)
        sizes.clear()
        found[small] = asp.solve(problem, asp.MeanPressure(2e6), solver=nnls.NonNegativeLeastSquares())
        assert (max(sizes) < heights.size) == (small == 40)
    np.testing.assert_allclose(found[40].pressure, found[10**6].pressure, rtol=1e-9, atol=1e-9 * 1e8)


@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(5e9)])
def test_fields_of_a_contact_go_with_it(law: asp.plasticity.HardWall | asp.Hardness) -> None:
    """Large arrays do not wait for the search for garbage, which may be long in coming."""
    surface = asp.Surface(1e-9 * rough((66, 70), 3).heights / rough((66, 70), 3).heights.std(), 1e-8, periodic=True)
    gc.collect()
    gc.disable()
    try:
        result = asp.solve(asp.ContactProblem(surface, asp.Elastic(1e11, 0.3), law=law), asp.MeanPressure(1e9))
        fields = [weakref.ref(values) for values in (surface.heights, result.pressure, result.displacement)]
        del result, surface
        assert [field() for field in fields] == [None, None, None]
    finally:
        gc.enable()
