"""The fast solver where it is hardest: against the exact solver, against constrained CG, and
against itself.

Bounds of differences follow from the errors both solutions report: |p - p*|_K² <= e · height
scale · load.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from catalogue import feasible_start
from contact_cases import elastic, rough

import asperity as asp
from asperity.contact.boundary import Boundary
from asperity.contact.certificate import certify
from asperity.contact.solvers.protocol import energy, relative_error, scaled_error
from asperity.core.arrays import RealArray
from asperity.core.engine import blocks, cpu, spline_levels
from asperity.core.status import Outcome
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import (
    ActiveSet,
    ConjugateGradient,
    ContactQP,
    DenseActiveSet,
    FixedMean,
    FixedOffset,
    Solution,
    run,
)

PRECISIONS = ("mixed", "double")
BOUNDARIES = (asp.Periodic(), asp.Free())
ROUNDING = 1e-13
"""Relative rounding of sums over these grids."""

EPSILON = {"mixed": 2.0**-22, "double": ROUNDING, "single": 2.0**-22}
"""Relative rounding of corrections."""

both = pytest.mark.parametrize("precision", PRECISIONS)
each_boundary = pytest.mark.parametrize("boundary", BOUNDARIES, ids=lambda b: b.name)


def posed(
    heights: RealArray, boundary: Boundary, load: float = 0.1, spacing: tuple[float, float] = (1.0, 1.0)
) -> ContactQP:
    """Elastic problem with E* = 1 at the mean pressure ``load``."""
    operator = asp.solvers.prepare_operator(HalfSpace(1.0), asp.Grid(heights.shape, spacing), boundary)
    return ContactQP(operator, heights, np.inf, FixedMean(load), float(heights.std()) or 1.0)


def rounding(qp: ContactQP, p: RealArray) -> float:
    """Relative error that the rounding of heights and deflections, of some units in the last place
    each, leaves in the gap."""
    u = qp.operator.apply(p)
    length = 8.0 * np.finfo(float).eps * (np.abs(qp.profile).max() + np.abs(u).max())
    return scaled_error(qp, float(length), float(p.sum()), 0.5 * float((p * u).sum()))


def magnitude(qp: ContactQP, p: RealArray) -> float:
    """Lengths (m) whose rounding enters the gap, over the height scale."""
    return 1.0 + float(np.abs(qp.profile).max() + np.abs(qp.operator.apply(p)).max()) / qp.height_scale


def assert_sound(qp: ContactQP, solution: Solution, tolerance: float) -> None:
    """Converged, feasible, and the error is what the fields say and below ``tolerance``."""
    p = solution.state.pressure
    assert solution.status.converged, solution.status.message
    assert p.min() >= 0.0
    assert (p <= qp.cap).all()
    if isinstance(qp.constraint, FixedMean):
        assert p.mean() == pytest.approx(qp.constraint.mean_pressure, rel=1e-12)
    assert relative_error(qp, p, qp.operator.apply(p)) <= tolerance * (1.0 + 1e-6) + rounding(qp, p)
    certificate = certify(
        qp, solution, qp.survey(solution.state).totals, solver="active_set", tolerance=tolerance, wall_time=0.0
    )
    if isinstance(qp.constraint, FixedMean):
        assert certificate.field_error <= tolerance * (1.0 + 1e-6) + rounding(qp, p)
        assert certificate.load_imbalance <= 1e-12


def assert_agree(qp: ContactQP, found: Solution, exact: Solution) -> None:
    """Pressures agree in the energy norm within the errors of both."""
    p, best = found.state.pressure, exact.state.pressure
    difference = p - best
    total = max(float(p.sum()), float(best.sum()))
    floor = ROUNDING * magnitude(qp, best)
    bound = sum(math.sqrt((s.state.error + floor) * qp.height_scale * total) for s in (found, exact))
    assert float((difference * qp.operator.apply(difference)).sum()) <= bound**2


def reference(qp: ContactQP) -> Solution:
    solution = run(DenseActiveSet(tolerance=1e-9), qp, feasible_start(qp))
    assert solution.status.converged, solution.status.message
    return solution


def reference_of_any_size(qp: ContactQP) -> Solution:
    """Exact solution of a small problem, else one of constrained conjugate gradients, an
    independent method."""
    if qp.profile.size <= 256:
        return reference(qp)
    solution = run(ConjugateGradient(tolerance=1e-9), qp)
    assert solution.status.converged, solution.status.message
    return solution


def checkerboard(shape: tuple[int, int]) -> RealArray:
    return np.asarray((np.indices(shape).sum(axis=0) % 2) * 2.0 - 1.0)


def summit(shape: tuple[int, int]) -> RealArray:
    heights = np.zeros(shape)
    heights[shape[0] // 3, shape[1] // 2] = 1.0
    return heights


def plateau(shape: tuple[int, int]) -> RealArray:
    heights = np.zeros(shape)
    heights[2 : shape[0] // 2 + 2, 1 : shape[1] // 2] = 1.0
    return heights


def spikes(shape: tuple[int, int]) -> RealArray:
    heights = rough(shape, 5).heights.copy()
    heights[::5, 1::4] += 10.0 + np.random.default_rng(2).random(heights[::5, 1::4].shape)
    return heights


Terrain = tuple[Callable[[], RealArray], tuple[float, float]]

TERRAINS: dict[str, Terrain] = {
    "summit": (lambda: summit((9, 8)), (1.0, 1.0)),
    "plateau": (lambda: plateau((9, 11)), (1.0, 1.0)),
    "checkerboard": (lambda: checkerboard((10, 10)), (1.0, 1.0)),
    "checkerboard of odd sides": (lambda: checkerboard((11, 13)), (1.0, 1.0)),
    "spikes": (lambda: spikes((11, 10)), (1.0, 1.0)),
    "rough": (lambda: rough((10, 11), 1).heights, (1.0, 1.0)),
    "needles along x": (lambda: rough((14, 16), 2, spacing=(20.0, 1.0)).heights, (20.0, 1.0)),
    "needles along y": (lambda: rough((10, 11), 3, spacing=(1.0, 20.0)).heights, (1.0, 20.0)),
    "white noise": (lambda: np.random.default_rng(4).standard_normal((10, 11)), (1.0, 1.0)),
    "one row": (lambda: rough((1, 100), 6).heights, (1.0, 1.0)),
    "one column": (lambda: rough((80, 1), 7).heights, (1.0, 3.0)),
    "two rows": (lambda: rough((2, 50), 8).heights, (1.0, 1.0)),
}

LOADS = (1e-12, 1e-3, 0.03, 0.3, 3.0, 1e4)
"""From a pixel to far beyond full contact, E* = 1 and rms height 1 pixel."""


def capped(qp: ContactQP, pressure: RealArray) -> Iterator[ContactQP]:
    """The problem without cap and with caps reached nowhere, in one pixel, in most, in all, and
    with a map of caps."""
    yield qp
    yield replace(qp, cap=2.0 * float(pressure.max()))
    first, second = np.sort(pressure, axis=None)[:-3:-1]
    mean = float(pressure.mean())
    if first > 1.001 * second and 0.5 * (first + second) > 1.001 * mean:
        yield replace(qp, cap=0.5 * float(first + second))
    yield replace(qp, cap=1.01 * mean)
    yield replace(qp, cap=mean)
    yield replace(qp, cap=mean * np.random.default_rng(3).uniform(1.05, 6.0, pressure.shape))


def complaints(name: str, elastic_qp: ContactQP) -> Iterator[str]:
    """What is wrong with the solutions of ``elastic_qp`` and its capped variants, in both
    precisions.

    With a cap no step is free; without one both kinds of steps are tried.
    """
    without = reference(elastic_qp)
    for number, qp in enumerate(capped(elastic_qp, without.state.pressure)):
        exact = reference(qp) if number else without
        tolerance = max(1e-10, rounding(qp, exact.state.pressure))  # no smaller one can be reached
        for precision, monotone in product(PRECISIONS, (False, True) if qp.elastic else (False,)):
            try:
                solver = ActiveSet(tolerance=tolerance, precision=precision, monotone=monotone)  # type: ignore[arg-type]
                solution = run(solver, qp)
                assert_sound(qp, solution, tolerance)
                assert_agree(qp, solution, exact)
            except AssertionError as error:
                yield f"{name}, cap {number}, {precision}, monotone {monotone}: {str(error).splitlines()[0]}"


@each_boundary
@pytest.mark.parametrize("terrain", TERRAINS)
def test_every_load_and_cap_on_every_terrain(terrain: str, boundary: Boundary) -> None:
    make, spacing = TERRAINS[terrain]
    wrong = [text for load in LOADS for text in complaints(f"load {load:g}", posed(make(), boundary, load, spacing))]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("terrain", TERRAINS)
def test_every_position_and_cap_on_every_terrain(terrain: str) -> None:
    make, spacing = TERRAINS[terrain]
    heights = make()
    free = posed(heights, asp.Free(), 0.1, spacing)
    wrong = []
    for overlap in (1e-6, 0.01, 0.3, 0.9, 1.5, 30.0):
        offset = float(heights.max() - overlap * (heights.max() - heights.min()))
        wrong += complaints(f"overlap {overlap:g}", replace(free, constraint=FixedOffset(offset)))
    assert not wrong, "\n".join(wrong)


@both
@each_boundary
@pytest.mark.parametrize("tolerance", [10.0**-k for k in range(3, 11)])
def test_every_tolerance_is_honoured(tolerance: float, boundary: Boundary, precision: str) -> None:
    solver = ActiveSet(tolerance=tolerance, precision=precision)  # type: ignore[arg-type]
    for load in (0.01, 0.2):
        qp = posed(rough((48, 40), 9).heights, boundary, load)
        for problem in (qp, replace(qp, cap=6.0 * load)):
            assert_sound(problem, run(solver, problem), tolerance)


@both
@each_boundary
@pytest.mark.parametrize("shape", [(37, 41), (13, 19), (2, 3), (1, 2), (5, 1)], ids=str)
def test_prime_and_smallest_sizes(shape: tuple[int, int], boundary: Boundary, precision: str) -> None:
    solver = ActiveSet(tolerance=1e-10, precision=precision)  # type: ignore[arg-type]
    for load in (0.001, 0.1):
        qp = posed(rough(shape, 10).heights, boundary, load)
        solution = run(solver, qp)
        assert_sound(qp, solution, solver.tolerance)
        assert_agree(qp, solution, reference_of_any_size(qp))


@pytest.mark.parametrize("n", [1, 2, 3, 7, 64, 65, 127, 333, 1000])
@each_boundary
def test_lines_of_any_length(n: int, boundary: Boundary) -> None:
    heights = rough((1, n), 11).heights if n > 1 else np.zeros((1, 1))
    row, column = posed(heights, boundary, 0.02), posed(heights.T.copy(), boundary, 0.02)
    solver = ActiveSet(tolerance=1e-9)
    solutions = run(solver, row), run(solver, column)
    for qp, solution in zip((row, column), solutions, strict=True):
        assert_sound(qp, solution, solver.tolerance)
        assert_agree(qp, solution, reference_of_any_size(qp))
    turned = replace(solutions[1], state=replace(solutions[1].state, pressure=solutions[1].state.pressure.T))
    assert_agree(row, solutions[0], turned)


@each_boundary
@pytest.mark.parametrize("shape", [(131, 97), (257, 129), (128, 70), (300, 66)], ids=str)
def test_nested_grids_of_odd_sizes(shape: tuple[int, int], boundary: Boundary) -> None:
    """Against constrained conjugate gradients, an independent method, to their own tolerance."""
    qp = posed(rough(shape, 12).heights, boundary, 0.03)
    for problem in (qp, replace(qp, cap=0.2)):
        solution = run(ActiveSet(tolerance=1e-9), problem)
        assert_sound(problem, solution, 1e-9)
        other = run(ConjugateGradient(tolerance=1e-8), problem)
        assert other.status.converged
        assert_agree(problem, solution, other)


def test_a_single_pixel_carries_a_vanishing_load() -> None:
    heights = rough((64, 64), 13).heights
    qp = posed(heights, asp.Periodic(), 1e-14)
    solution = run(ActiveSet(tolerance=1e-9), qp)
    assert solution.status.converged
    expected = np.zeros(heights.shape)
    expected[np.unravel_index(np.argmax(heights), heights.shape)] = 1e-14 * heights.size
    np.testing.assert_allclose(solution.state.pressure, expected, rtol=1e-12)


@both
def test_full_contact_is_the_inverse_of_the_compliance(precision: str) -> None:
    """p = mean + F^-1[h/c] once that is positive everywhere: exact, no iteration can be blamed."""
    qp = posed(rough((96, 80), 14).heights, asp.Periodic())
    kernel = qp.operator.kernel.copy()
    kernel[0, 0] = np.inf
    wave = np.fft.irfft2(np.fft.rfft2(qp.profile) / kernel, s=qp.profile.shape)
    for excess in (1.001, 2.0, 1e4):
        mean = -excess * float(wave.min())
        solver = ActiveSet(tolerance=1e-10, precision=precision)  # type: ignore[arg-type]
        problem = replace(qp, constraint=FixedMean(mean))
        solution = run(solver, problem)
        assert_sound(problem, solution, solver.tolerance)
        # |p - p*|² <= |p - p*|_K² / smallest compliance
        error = (solution.state.error + ROUNDING * magnitude(qp, wave)) * qp.height_scale * mean * wave.size
        assert float(((solution.state.pressure - mean - wave) ** 2).sum()) <= error / float(
            qp.operator.kernel[1:].min()
        )


def rough_problem(boundary: Boundary, cap: float = np.inf) -> ContactQP:
    return replace(posed(rough((72, 66), 15).heights, boundary, 0.05), cap=cap)


CAPS = pytest.mark.parametrize("cap", [np.inf, 0.3], ids=["elastic", "capped"])


@both
@CAPS
@each_boundary
def test_the_energy_never_rises(boundary: Boundary, cap: float, precision: str) -> None:
    qp = rough_problem(boundary, cap)
    solver = ActiveSet(tolerance=1e-9, precision=precision, monotone=True)  # type: ignore[arg-type]
    start = np.zeros(qp.profile.shape)
    start[::7, ::5] = 1.0  # nothing like the answer
    state = solver.init(qp, start)
    for _ in range(60):
        old = state.pressure.copy()  # iterates share their arrays
        before = energy(qp, old, qp.operator.apply(old))
        state = solver.step(qp, state)
        p = state.pressure
        lengths = magnitude(qp, p) * qp.height_scale
        # the solver judges a step by its slope, from the deflection to the rounding of corrections
        floor = lengths * (ROUNDING * p.sum() + EPSILON[precision] * np.abs(p - old).sum())
        assert energy(qp, p, qp.operator.apply(p)) <= before + floor
        if state.error <= solver.tolerance:
            return
    pytest.fail(f"no convergence: {state.error:.1e}")


@CAPS
@each_boundary
def test_equal_inputs_give_equal_bits(boundary: Boundary, cap: float) -> None:
    first, second = (run(ActiveSet(tolerance=1e-8), rough_problem(boundary, cap)) for _ in range(2))
    np.testing.assert_array_equal(first.state.pressure, second.state.pressure)
    assert first.errors == second.errors


@CAPS
@each_boundary
def test_the_number_of_threads_changes_rounding_only(
    boundary: Boundary, cap: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in (blocks, cpu):
        monkeypatch.setattr(module, "SERIAL_BELOW", 1 << 17)
    monkeypatch.setattr(spline_levels, "_SHARED", 1 << 15)
    heights = rough((384, 360), 16).heights  # large enough for threads
    grid, solver = asp.Grid(heights.shape, (1.0, 1.0)), ActiveSet(tolerance=1e-10, precision="double")
    found = []
    for threads in (1, 2):
        operator = asp.solvers.prepare_operator(HalfSpace(1.0), grid, boundary, engine=asp.engines.CpuEngine(threads))
        found.append(run(solver, replace(posed(heights, boundary, 0.05), operator=operator, cap=cap)))
    one, two = (solution.state.pressure for solution in found)
    assert [s.state.iterations for s in found] == [found[0].state.iterations] * 2
    assert np.abs(two - one).max() <= 1e-9 * one.max()


class Interrupt:
    """Progress that stops the work after some iterations."""

    def __init__(self, after: int) -> None:
        self.after = after

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        if iteration >= self.after:
            raise KeyboardInterrupt


@CAPS
@each_boundary
def test_an_interrupted_solve_leaves_everything_as_it_was(boundary: Boundary, cap: float) -> None:
    surface = asp.Surface(rough((72, 66), 15).heights, 1.0, periodic=True)
    law = asp.plasticity.HardWall() if cap == np.inf else asp.Hardness(cap)
    problem = asp.ContactProblem(surface, elastic(1.0), boundary=boundary, law=law)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    state = asp.solve(problem, asp.MeanPressure(0.02), operator=operator).state
    kept = surface.heights.copy(), state.pressure.copy(), state.permanent_indentation.copy()
    undisturbed = asp.solve(problem, asp.MeanPressure(0.05), state=state)
    for after in (0, 1, 3):
        with pytest.raises(KeyboardInterrupt):
            asp.solve(problem, asp.MeanPressure(0.05), state=state, operator=operator, progress=Interrupt(after))
    for found, wanted in zip((surface.heights, state.pressure, state.permanent_indentation), kept, strict=True):
        np.testing.assert_array_equal(found, wanted)
    again = asp.solve(problem, asp.MeanPressure(0.05), state=state, operator=operator)
    np.testing.assert_array_equal(again.pressure, undisturbed.pressure)


@CAPS
@each_boundary
def test_restart_from_any_iterate_finds_the_same_answer_with_less_work(boundary: Boundary, cap: float) -> None:
    qp, solver = rough_problem(boundary, cap), ActiveSet(tolerance=1e-9)
    whole = run(solver, qp)
    cold = pairs(qp, whole)
    state = solver.init(qp, None)
    used = []
    while state.error > solver.tolerance:
        restarted = run(solver, qp, state.pressure.copy())
        assert_sound(qp, restarted, solver.tolerance)
        assert_agree(qp, restarted, whole)
        used.append(pairs(qp, restarted))
        state = solver.step(qp, state)
    assert max(used[len(used) // 2 :]) < cold
    assert used[-1] < 0.5 * cold
    assert run(solver, qp, whole.state.pressure).state.iterations == 0


def pairs(qp: ContactQP, solution: Solution) -> float:
    return solution.state.applications * qp.operator.pairs_per_application + solution.state.extra_pairs


@both
def test_the_iteration_limit_is_reported(precision: str) -> None:
    solver = ActiveSet(tolerance=1e-10, max_iterations=2, precision=precision)  # type: ignore[arg-type]
    solution = run(solver, rough_problem(asp.Periodic()))
    assert solution.status.outcome is Outcome.ITERATION_LIMIT
    assert solution.state.iterations == 2
    assert solution.state.error > solver.tolerance
    assert "iterations above 2 (max_iterations" in solution.status.remedy


@both
@pytest.mark.parametrize("cap", [np.inf, 0.3], ids=["elastic", "capped"])
@each_boundary
def test_an_unreachable_tolerance_stagnates_near_rounding(boundary: Boundary, cap: float, precision: str) -> None:
    qp, solver = rough_problem(boundary, cap), ActiveSet(tolerance=1e-17, precision=precision)  # type: ignore[arg-type]
    solution = run(solver, qp)
    assert solution.status.outcome is Outcome.STAGNATED, solution.status.message
    assert solution.state.error <= 1e-12
    assert solution.status.remedy


def self_affine(n: int) -> RealArray:
    """H = 0.8, roll-off L/4, cut-off 8 pixels, unit rms slope: the benchmark."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0
    )
    return asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=1).heights


@pytest.mark.parametrize("load", [0.01, 0.05, 0.2])
@pytest.mark.parametrize("n", [128, 256])
def test_single_precision_corrections_give_pressures_to_1e_5(n: int, load: float) -> None:
    qp = posed(self_affine(n), asp.Periodic(), load)
    precise = run(ActiveSet(tolerance=1e-10, precision="double"), qp)
    found = run(ActiveSet(tolerance=1e-6, precision="mixed"), qp)
    assert_sound(qp, precise, 1e-10)
    assert_sound(qp, found, 1e-6)
    best = precise.state.pressure
    assert np.linalg.norm(found.state.pressure - best) <= 1e-5 * np.linalg.norm(best)


@pytest.mark.parametrize("load", [0.01, 0.05, 0.2])
@pytest.mark.parametrize("n", [128, 256])
def test_single_precision_alone_gives_pressures_to_1e_5_and_can_be_polished(n: int, load: float) -> None:
    """Gaps are known to some roundings of the height scale, 2^-24 each: tolerances of 1e-6 are
    within reach."""
    qp = posed(
        self_affine(n) + 1e3, asp.Periodic(), load
    )  # heights far from zero: they are centred in double precision
    precise = run(ActiveSet(tolerance=1e-10, precision="double"), qp)
    found = run(ActiveSet(tolerance=2e-6, precision="single"), qp)
    assert found.status.converged, found.status.message
    assert found.state.pressure.dtype == np.float32
    best = precise.state.pressure
    assert np.linalg.norm(found.state.pressure - best) <= 1e-5 * np.linalg.norm(best)
    polished = run(ActiveSet(tolerance=1e-9), qp, found.state.pressure)
    assert_sound(qp, polished, 1e-9)
    assert pairs(qp, polished) < 0.7 * pairs(qp, run(ActiveSet(tolerance=1e-9), qp))


def test_a_result_in_single_precision_is_as_good_as_it_says() -> None:
    surface = asp.Surface(1e-9 * self_affine(128), 1e-9, periodic=True)
    problem = asp.ContactProblem(surface, asp.Elastic(2e11, 0.3))
    single, double = (
        asp.solve(problem, asp.MeanPressure(1e10), solver=ActiveSet(tolerance=1e-5, precision=precision))
        for precision in ("single", "double")
    )
    assert single.pressure.dtype == np.float32
    assert single.certificate.field_error <= 2e-5  # the certificate is computed anew, in double precision
    assert single.certificate.load_imbalance <= 1e-6
    for name in ("area_fraction", "approach", "mean_gap", "elastic_energy", "normal_stiffness", "max_pressure"):
        assert getattr(single, name) == pytest.approx(getattr(double, name), rel=1e-3)
