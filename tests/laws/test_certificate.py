"""The certificate is a bound: for any feasible pressure the duality gap is at least the true error
of the energy.

Against the exact dense solution: V(p) - V(p*) <= G and |p - p*|_K² / 2 <= V(p) - V(p*) (weak
duality and strong convexity of the quadratic programme; Kalker 1977).
"""

from __future__ import annotations

import numpy as np
import pytest
from catalogue import feasible_start
from contact_cases import rough
from hypothesis import given, settings
from hypothesis import strategies as st

import asperity as asp
from asperity.contact.certificate import Certificate, certify
from asperity.contact.solvers.protocol import SolverState, best_level, duality_gap, relative_error, scaled_to_load
from asperity.core.arrays import RealArray
from asperity.core.status import Outcome, Status
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import ActiveSet, ContactQP, DenseActiveSet, FixedMean, Solution, run

few = settings(max_examples=40)
SEEDS = st.integers(0, 10**6)
SHAPES = st.sampled_from([(8, 8), (9, 7), (1, 40), (11, 12)])
BOUNDARIES = st.sampled_from([asp.Periodic(), asp.Free()])
LOADS = st.floats(1e-6, 1.0)
CAPS = st.sampled_from(["none", "scalar", "map"])
problems = given(SEEDS, SHAPES, BOUNDARIES, LOADS, CAPS)


def posed(seed: int, shape: tuple[int, int], boundary: object, load: float, cap: str) -> ContactQP:
    """Random problem at prescribed load, E* = 1, heights of unit rms, cap of a few times the
    load."""
    rng = np.random.default_rng(seed)
    operator = asp.solvers.prepare_operator(HalfSpace(1.0), asp.Grid(shape, (1.0, 1.3)), boundary)  # type: ignore[arg-type]
    heights = rough(shape, seed).heights
    caps = {"none": np.inf, "scalar": load * rng.uniform(1.1, 9.0), "map": load * rng.uniform(1.1, 9.0, shape)}
    return ContactQP(operator, heights, caps[cap], FixedMean(load), float(heights.std()))


def feasible(qp: ContactQP, exact: RealArray, rng: np.random.Generator) -> RealArray:
    """Random pressure that carries the load: noise, or the solution with noise of any size, often
    sparse."""
    assert isinstance(qp.constraint, FixedMean)
    noise = rng.exponential(qp.constraint.mean_pressure, exact.shape) * (rng.random(exact.shape) < rng.random())
    weight = 10.0 ** rng.uniform(-6.0, 0.0)
    raw = noise if rng.random() < 0.3 else (1.0 - weight) * exact + weight * noise
    return scaled_to_load(raw, qp.cap, qp.constraint.mean_pressure)


def as_solution(qp: ContactQP, pressure: RealArray) -> Solution:
    deflection = qp.operator.apply(pressure)
    state = SolverState(pressure, deflection, relative_error(qp, pressure, deflection))
    return Solution(state, Status(Outcome.STAGNATED, "not a solution"), (state.error,))


def certified(qp: ContactQP, solution: Solution) -> Certificate:
    return certify(qp, solution, qp.survey(solution.state).totals, solver="none", tolerance=1e-6, wall_time=0.0)


@few
@problems
def test_the_gap_bounds_the_energy_and_the_distance(
    seed: int, shape: tuple[int, int], boundary: object, load: float, cap: str
) -> None:
    qp = posed(seed, shape, boundary, load, cap)
    exact = run(DenseActiveSet(), qp, feasible_start(qp)).state
    rng = np.random.default_rng(seed + 1)
    for _ in range(5):
        p = feasible(qp, exact.pressure, rng)
        deflection = qp.operator.apply(p)
        difference = p - exact.pressure
        half = 0.5 * float((difference * qp.operator.apply(difference)).sum())
        # V(p) - V(p*) without cancellation: slope along the difference and its curvature
        slope = float((difference * (exact.deflection - qp.profile)).sum())
        excess = slope + half
        total = float(p.sum())
        rounding = 1e-12 * total * (1.0 + float(np.abs(deflection).max() + np.abs(qp.profile).max()))

        certificate = certified(qp, as_solution(qp, p))
        gap = certificate.field_error * total * qp.height_scale
        assert excess <= gap + rounding
        assert half <= excess + rounding  # p* minimises: the slope from it is never downwards
        assert half <= gap + rounding

        # any level bounds too, and none better than the one the certificate takes
        r = deflection - qp.profile
        for at in rng.uniform(r.min(), r.max(), 3):
            bound = duality_gap(p, r, qp.cap, float(at))
            assert excess <= bound + rounding
            assert gap <= bound + rounding


@few
@problems
def test_the_relative_gap_is_the_gap_over_the_energy(
    seed: int, shape: tuple[int, int], boundary: object, load: float, cap: str
) -> None:
    qp = posed(seed, shape, boundary, load, cap)
    p = feasible(qp, feasible_start(qp), np.random.default_rng(seed + 2))
    solution = as_solution(qp, p)
    certificate = certified(qp, solution)
    r = solution.state.deflection - qp.profile
    gap = duality_gap(p, r, qp.cap, best_level(p, r, qp.cap))
    assert certificate.field_error == pytest.approx(gap / (p.sum() * qp.height_scale), rel=1e-12)
    raised = ContactQP(qp.operator, qp.profile + 1e3, qp.cap, qp.constraint, qp.height_scale)
    again = certified(raised, as_solution(raised, p))  # the datum of the heights means nothing to G or V
    rounding = 1e-11 * 1e3 * float(p.sum())
    assert again.field_error == pytest.approx(certificate.field_error, rel=1e-9, abs=1e-9)
    if gap > rounding:
        assert abs(gap / again.duality_gap - gap / certificate.duality_gap) <= rounding


@few
@problems
def test_a_solution_has_a_gap_below_its_tolerance_and_it_still_bounds(
    seed: int, shape: tuple[int, int], boundary: object, load: float, cap: str
) -> None:
    qp = posed(seed, shape, boundary, load, cap)
    exact = run(DenseActiveSet(), qp, feasible_start(qp)).state
    for tolerance in (1e-2, 1e-4, 1e-6):
        solution = run(ActiveSet(tolerance=tolerance), qp)
        assert solution.status.converged
        certificate = certified(qp, solution)
        assert certificate.field_error <= tolerance * (1.0 + 1e-9)
        difference = solution.state.pressure - exact.pressure
        slope = float((difference * (exact.deflection - qp.profile)).sum())
        half = 0.5 * float((difference * qp.operator.apply(difference)).sum())
        total = float(exact.pressure.sum())
        rounding = 1e-12 * total * (1.0 + float(np.abs(exact.deflection).max() + np.abs(qp.profile).max()))
        assert slope + half <= certificate.field_error * total * qp.height_scale + rounding


@few
@problems
def test_the_gap_is_no_worse_than_the_error_the_solver_reports(
    seed: int, shape: tuple[int, int], boundary: object, load: float, cap: str
) -> None:
    """The certificate chooses the level best; the solver's own error takes a cheaper one."""
    qp = posed(seed, shape, boundary, load, cap)
    solution = as_solution(qp, feasible(qp, feasible_start(qp), np.random.default_rng(seed)))
    certificate = certified(qp, solution)
    assert certificate.field_error <= solution.state.error * (1.0 + 1e-12)
    assert certificate.load_imbalance <= 1e-12
