"""What is called converged is right: random small problems against the exact dense solution, over
all kinds of trouble."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from catalogue import feasible_start

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.solve import doubted
from asperity.core.arrays import RealArray
from asperity.solids.compliance.halfspace import Compliance, HalfSpace
from asperity.solvers import ActiveSet, ContactQP, DenseActiveSet, FixedMean, FixedOffset, run

LARGEST_ERROR = 1e-3
"""Of the pressure, relative L2."""

EXACT = DenseActiveSet(tolerance=1e-8)
"""Its error is rounding, which is up to 1e-9 of the small lengths by which errors are made relative
here."""

FILMS = [(10.0, 0.5), (0.1, 2.0), (3.0, 8.0)]
"""Modulus over that of the base, thickness in pixels."""


def heights_of(rng: np.random.Generator, shape: tuple[int, int]) -> RealArray:
    """Rough, stepped, with plateaus, ties or spikes, nearly flat or flat, of rms slopes about one
    or less."""
    kind = rng.integers(7)
    rough = rng.standard_normal(shape)
    if kind == 0:
        return rough
    if kind == 1:
        return np.round(rough)
    if kind == 2:
        plateau = np.zeros(shape)
        plateau[: rng.integers(1, shape[0] + 1), : rng.integers(1, shape[1] + 1)] = 1.0
        return plateau
    if kind == 3:
        return np.minimum(rough, rng.uniform(-0.5, 1.0))
    if kind == 4:
        spike = 0.01 * rough
        spike[rng.integers(shape[0]), rng.integers(shape[1])] += 1.0
        return spike
    if kind == 5:
        return 1.0 + 10.0 ** rng.uniform(-12.0, -3.0) * rough
    return np.full(shape, rng.choice([0.0, 1e-7, 1.0]))


def problem(seed: int) -> ContactQP:
    """Up to 12 x 12 points; pixels up to 1 : 4; half-spaces and films; caps; loads over twelve
    decades; both boundaries."""
    rng = np.random.default_rng([seed, 14])
    shape = int(rng.integers(2, 13)), int(rng.integers(1, 13))
    grid = asp.Grid(shape, (1.0, float(rng.choice([1.0, 0.25, 0.7, 4.0]))))
    heights = heights_of(rng, shape)
    compliance: Compliance = HalfSpace(1.0)
    if rng.random() < 0.25:
        modulus, thickness = FILMS[rng.integers(len(FILMS))]
        layered = asp.Layered([asp.Layer(asp.Elastic(modulus, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
        compliance = asp.ContactProblem(asp.Surface(np.zeros((2, 2)), 1.0, periodic=True), layered).compliance
    boundary = asp.Free() if rng.random() < 0.5 else asp.Periodic()
    operator = prepare_operator(compliance, grid, boundary, engine=asp.engines.CpuEngine(1))
    mean = 10.0 ** rng.uniform(-12.0, 0.0)
    scale = float(heights.std()) or float(np.abs(operator.apply(np.full(shape, mean))).max()) or 1.0
    cap = np.inf if rng.random() < 0.6 else mean * 10.0 ** rng.uniform(0.01, 2.0)
    if rng.random() < 0.2 and np.ptp(heights) > 0.0:
        depth = 10.0 ** rng.uniform(-6.0, -0.3) * float(heights.max() - heights.mean())
        return ContactQP(operator, heights, np.inf, FixedOffset(float(heights.max()) - depth), scale)
    return ContactQP(operator, heights, cap, FixedMean(mean), scale)


def count_wrong(seeds: range) -> Counter[str]:
    """Number of problems by what came of them, those wrongly called converged by their seed."""
    found: Counter[str] = Counter()
    for seed in seeds:
        qp = problem(seed)
        solution, exact = run(ActiveSet(), qp), run(EXACT, qp, feasible_start(qp))
        if not exact.status.converged:
            found["no exact solution"] += 1
        elif not solution.status.converged:
            found["not converged"] += 1
        else:
            p, right = solution.state.pressure, exact.state.pressure
            error = float(np.linalg.norm(p - right) / (np.linalg.norm(right) or 1.0))
            found["right" if error <= LARGEST_ERROR else f"wrong: seed {seed}, {error:.1e}"] += 1
    return found


def assert_none_wrong(seeds: range) -> None:
    found = count_wrong(seeds)
    assert not [kind for kind in found if kind.startswith("wrong")], found
    assert found["right"] >= 0.97 * len(seeds), found


def test_no_small_problem_is_wrongly_called_converged() -> None:
    assert_none_wrong(range(60))


@pytest.mark.slow
def test_no_problem_of_a_thousand_is_wrongly_called_converged() -> None:
    assert_none_wrong(range(60, 1060))


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize(("shape", "height"), [((100, 100), 0.0), ((16, 16), 1e-7), ((60, 45), 1e-7)], ids=str)
@pytest.mark.parametrize("pressure", [1e-3, 1e3, 1e8])
def test_flat_bodies_are_solved(
    boundary: asp.contact.Boundary, shape: tuple[int, int], height: float, pressure: float
) -> None:
    """Their rms height is nothing but rounding."""
    surface = asp.Surface(np.full(shape, height), 1e-6, periodic=boundary == asp.Periodic())
    result = asp.solve(
        asp.ContactProblem(surface, asp.Elastic(1e9, 0.3), boundary=boundary), asp.MeanPressure(pressure)
    )
    assert result.area_fraction == 1.0
    assert max(result.certificate.duality_gap, result.certificate.field_error) < 1e-6
    if boundary == asp.Periodic():
        np.testing.assert_allclose(result.pressure, pressure, rtol=1e-6)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize("pressure", [1e-3, 0.1, 10.0, 1e5])
def test_a_plateau_under_a_tiny_load_carries_it_as_a_whole(boundary: asp.contact.Boundary, pressure: float) -> None:
    heights = np.zeros((16, 16))
    heights[4:12, 4:12] = 1e-6
    surface = asp.Surface(heights, 1e-6, periodic=boundary == asp.Periodic())
    problem = asp.ContactProblem(surface, asp.Elastic(1e9, 0.3), boundary=boundary)
    found, right = (asp.solve(problem, asp.MeanPressure(pressure), solver=solver) for solver in (ActiveSet(), EXACT))
    np.testing.assert_allclose(found.pressure, right.pressure, atol=1e-4 * right.pressure.max())
    np.testing.assert_array_equal(found.pressure > 0.0, heights > 0.0)
    if boundary == asp.Free():
        assert found.pressure.max() == pytest.approx(8.847 * pressure, rel=1e-3)
    assert found.certificate.duality_gap < 1e-5


def film_of(modulus: float) -> Compliance:
    """Compliance of a film two pixels thick, of this modulus over that of the base."""
    layered = asp.Layered([asp.Layer(asp.Elastic(modulus, 0.3), 2.0)], base=asp.Elastic(1.0, 0.3))
    return asp.ContactProblem(asp.Surface(np.zeros((2, 2)), 1.0, periodic=True), layered).compliance


@pytest.mark.parametrize(
    ("shape", "modulus", "relative_cap"), [((3, 12), 100.0, 1.01), ((24, 24), 100.0, 10.0), ((24, 24), 1000.0, 2.0)]
)
def test_bending_films_under_a_cap_are_solved(shape: tuple[int, int], modulus: float, relative_cap: float) -> None:
    """Steps that are clipped to the bounds must let points reach them: shortened as a whole they
    went on for ever."""
    heights = 1e-3 * np.random.default_rng(shape[0] // 24).standard_normal(shape)
    load = 1.0 if shape[0] == 3 else 0.1
    operator = prepare_operator(
        film_of(modulus), asp.Grid(shape, (1.0, 4.0)), asp.Periodic(), engine=asp.engines.CpuEngine(1)
    )
    qp = ContactQP(operator, heights, load * relative_cap, FixedMean(load), float(heights.std()))
    found, exact = run(ActiveSet(), qp), run(EXACT, qp, feasible_start(qp))
    assert found.status.converged, found.status.message
    assert np.linalg.norm(found.state.pressure - exact.state.pressure) <= 1e-3 * np.linalg.norm(exact.state.pressure)


@pytest.mark.parametrize(("load", "relative_cap"), [(0.01, np.inf), (1.0, 10.0)])
def test_stiff_films_are_solved_while_the_energy_falls(load: float, relative_cap: float) -> None:
    """Their errors rise above that of the start for many steps, which must not count as
    stagnation."""
    grid = asp.Grid((64, 64), (1.0, 4.0))
    operator = prepare_operator(film_of(1000.0), grid, asp.Periodic(), engine=asp.engines.CpuEngine(1))
    heights = 1e-3 * np.random.default_rng(0).standard_normal(grid.shape)
    qp = ContactQP(operator, heights, load * relative_cap, FixedMean(load), float(heights.std()))
    solution = run(ActiveSet(), qp)
    assert solution.status.converged, solution.status.message
    p = solution.state.pressure
    gap = operator.apply(p) - heights
    gap -= gap.min()
    assert (p * gap).sum() <= 1e-6 * p.sum() * float(heights.std())
    assert p.mean() == pytest.approx(load, rel=1e-12)
    assert p.min() >= 0.0


def test_the_energy_of_clipped_steps_is_that_of_their_pressure_and_never_rises() -> None:
    rng = np.random.default_rng(3)
    operator = prepare_operator(
        film_of(100.0), asp.Grid((24, 20), (1.0, 4.0)), asp.Periodic(), engine=asp.engines.CpuEngine(1)
    )
    heights = 1e-3 * rng.standard_normal((24, 20))
    qp = ContactQP(operator, heights, 1.0, FixedMean(0.1), float(heights.std()))
    solver, energies, right = ActiveSet(precision="double"), [], []
    state = solver.init(qp, None)
    while state.error > solver.tolerance:
        state = solver.step(qp, state)
        p = np.asarray(state.pressure)
        energies.append(state.energy)
        right.append(float((p * (0.5 * operator.apply(p) - heights)).sum()))
    assert len(energies) > 5
    np.testing.assert_allclose(energies, right, atol=1e-12 * np.abs(right).max())
    assert (np.diff(right) <= 1e-13 * np.abs(right).max()).all()


@pytest.mark.parametrize("tolerance", [1e-7, 1e-10])
@pytest.mark.parametrize("pressure", [5e-4, 6e-4, 5e-3, 0.3])
@pytest.mark.parametrize("shape", [(2, 2), (8, 6), (8, 1)], ids=str)
def test_flat_periodic_bodies_far_above_the_datum_are_solved(
    shape: tuple[int, int], pressure: float, tolerance: float
) -> None:
    """Their height, many times what a wave would deflect by, must not round away the error."""
    problem = asp.ContactProblem(asp.Surface(np.ones(shape), 1.0, 0.7, periodic=True), asp.Elastic(1.0, 0.0))
    result = asp.solve(problem, asp.MeanPressure(pressure), solver=ActiveSet(tolerance=tolerance))
    np.testing.assert_allclose(result.pressure, pressure, rtol=1e-12)


@pytest.mark.parametrize(("shape", "seed", "load"), [((2, 2), 8, 1e-2), ((2, 3), 7, 2e-3)])
def test_a_load_just_below_the_cap_is_solved_to_rounding(shape: tuple[int, int], seed: int, load: float) -> None:
    """Only the missing 1e-4 of the load deflects, so that heights count from the level of the last
    point that bears."""
    heights = np.random.default_rng(seed).standard_normal(shape)
    operator = prepare_operator(
        HalfSpace(1.0), asp.Grid(shape, (1.0, 4.0)), asp.Periodic(), engine=asp.engines.CpuEngine(1)
    )
    qp = ContactQP(operator, heights, 1.0001 * load, FixedMean(load), float(heights.std()))
    solution = run(ActiveSet(tolerance=1e-10), qp)
    assert solution.status.converged, solution.status.message


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize("film", [1.0, 100.0])
def test_a_load_equal_to_the_cap_but_for_rounding_puts_all_points_at_it(
    boundary: asp.contact.Boundary, film: float
) -> None:
    wrong = []
    for seed in (*range(20), 153, 263):
        rng = np.random.default_rng([seed, 13])
        grid = asp.Grid((10, 11), (1.0, float(rng.choice([20.0, 0.05]))))
        operator = prepare_operator(film_of(film), grid, boundary, engine=asp.engines.CpuEngine(1))
        cap = 0.03 * (rng.uniform(0.5, 1.5, grid.shape) if seed % 2 else np.ones(grid.shape))
        heights, mean = heights_of(rng, grid.shape), float(cap.mean()) * (1.0 - 1e-16 * rng.integers(0, 50))
        solution = run(ActiveSet(), ContactQP(operator, heights, cap, FixedMean(mean), float(heights.std()) or 1.0))
        if not (solution.status.converged and np.array_equal(solution.state.pressure, cap)):
            wrong.append(f"seed {seed}: {solution.status.message}")
    assert not wrong, wrong


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_the_certificate_of_a_light_load_states_the_duality_gap_that_heights_round_away(
    boundary: asp.contact.Boundary,
) -> None:
    """Plateaus so that points share a load whose deflection is 1e-11 of the heights."""
    heights = 1e-8 * np.minimum(np.random.default_rng(3).standard_normal((14, 6)), 0.5)
    surface = asp.Surface(heights, 5e-6, periodic=boundary == asp.Periodic())
    problem = asp.ContactProblem(surface, asp.Elastic(1e9, 0.3), boundary=boundary)
    found = asp.solve(problem, asp.MeanPressure(1e-8))
    p = np.asarray(found.pressure, dtype=float)
    deflection = prepare_operator(problem.compliance, problem.grid, boundary).apply(p)
    apart = deflection + (heights.max() - heights)
    gap, energy = float((p * (apart - apart.min())).sum()), 0.5 * float((p * deflection).sum())
    assert deflection.max() < 1e-9 * heights.max()
    assert gap > 1e-12 * energy
    assert found.certificate.duality_gap == pytest.approx(gap / energy, rel=1e-3)


def test_a_position_of_a_nearly_flat_surface_far_from_the_zero_of_its_heights_is_reached() -> None:
    """Its closeness is a thousandth of the rounding that was asked of it."""
    heights = 1e-9 * (1.0 + 1e-6 * np.random.default_rng(0).standard_normal((8, 8)))
    touch = float(heights.max() - heights.mean())
    problem = asp.ContactProblem(asp.Surface(heights, 1e-6, periodic=True), asp.Elastic(1e5, 0.3))
    for closer in (1e-5 * touch, 3e-5 * touch, 1e-4 * touch):
        found = asp.solve(problem, asp.MeanGap(touch - closer))
        assert found.mean_gap == pytest.approx(touch - closer, abs=1e-15 * heights.max())


EXTREME = {
    "approach": {"control": lambda: asp.Approach(1e300)},
    "mean gap": {"control": lambda: asp.MeanGap(1e-300)},
    "force": {"control": lambda: asp.Force(5e-324)},
    "pressure": {"control": lambda: asp.MeanPressure(1e300)},
    "wide pixels": {"pixel": 1e160},
    "narrow pixels": {"pixel": 1e-160},
    "stiff": {"body": lambda: asp.Elastic(1.7e308, 0.3)},
    "compliant": {"body": lambda: asp.Elastic(1e-300, 0.3)},
    "high": {"height": 1e160},
    "low": {"height": 1e-162},
    "hard": {"law": lambda: asp.Hardness(1e158)},
    "hard and low": {"height": 1e-162, "law": lambda: asp.Hardness(1e158)},
    "soft film": {"body": lambda: asp.Layered([asp.Layer(asp.Elastic(0.1, 0.3), 1e-8)], asp.Elastic(1e11, 0.3))},
    "stiff film": {"body": lambda: asp.Layered([asp.Layer(asp.Elastic(1e23, 0.3), 1e-8)], asp.Elastic(1e11, 0.3))},
    "thin film": {"body": lambda: asp.Layered([asp.Layer(asp.Elastic(1e10, 0.5), 1e-15)], asp.RigidBase())},
}
SOLVED = ("low", "hard", "hard and low", "soft film")


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_extreme_numbers_are_refused_or_solved(boundary: asp.contact.Boundary) -> None:
    """What is called converged is finite, in balance and has a small duality gap."""
    wrong = []
    for name, case in EXTREME.items():
        heights = case.get("height", 1e-9) * np.random.default_rng(1).standard_normal((16, 16))
        control, body = (
            case.get("control", lambda: asp.MeanPressure(1e7)),
            case.get("body", lambda: asp.Elastic(1e11, 0.3)),
        )
        try:
            surface = asp.Surface(heights, case.get("pixel", 1e-8), periodic=boundary == asp.Periodic())
            posed = asp.ContactProblem(
                surface, body(), boundary=boundary, law=case.get("law", asp.plasticity.HardWall)()
            )
            found = asp.solve(posed, control(), on_failure="return")
        except (asp.InputError, asp.errors.NoSolutionError):
            if name in SOLVED:
                wrong.append(f"{name}: refused")
            continue
        if name in SOLVED and not found.converged:
            wrong.append(f"{name}: {found.status.message}")
        right = found.mean_pressure == pytest.approx(1e7) and found.certificate.duality_gap < 1e-3
        if found.converged and not right:
            wrong.append(f"{name}: {found.mean_pressure}, {found.certificate.duality_gap}")
    assert not wrong, wrong


def test_a_large_duality_gap_is_a_warning_or_no_convergence() -> None:
    problem = asp.ContactProblem(
        asp.Surface(np.random.default_rng(1).standard_normal((16, 16)), 1.0, periodic=True), asp.Elastic(1.0, 0.3)
    )
    loose = asp.solve(problem, asp.MeanPressure(0.1), solver=asp.solvers.ConjugateGradient(tolerance=0.05))
    assert loose.certificate.duality_gap > 1e-3
    assert "duality gap" in {finding.criterion for finding in asp.contact.review(loose)}
    doubtful = replace(loose.certificate, tolerance=1e-7)
    status = doubted(loose.status, doubtful)
    assert status.outcome == "stagnated"
    assert doubted(loose.status, loose.certificate) is loose.status
