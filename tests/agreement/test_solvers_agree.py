"""All solvers find the one solution of the convex problem, within bounds that follow from their own reported errors.

With e the relative error of a solver (``optimality.relative_error``), convexity gives, for prescribed load and for
prescribed position alike (variational inequality at the exact p*),

    |p - p*|_K² <= sum g·(p - p*) <= e · height_scale · max(sum p, sum p*),

from which bounds of pressure, displacement, offset and contact area follow without any tuned number.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from catalogue import (
    CASES,
    EXACT,
    SOLVERS,
    SUPPORTED,
    UNSUPPORTED,
    Case,
    feasible_start,
    pair_id,
    solved,
)

from asperity import MeanGap
from asperity.contact.solvers import ContactQP, FixedMean, Solution, Solver, run
from asperity.contact.solvers.protocol import level, relative_error
from asperity.core.errors import InputError

ROUNDING = 1e-13
"""Relative rounding of sums over these grids."""


PAIRS = [pytest.param(solver, case, id=f"{pair_id(solver)}-{pair_id(case)}") for solver, case in SUPPORTED]


def reference(qp: ContactQP) -> Solution:
    """Exact solution of the discrete problem that was solved (at mean gap: with the constraint that was found)."""
    return run(EXACT, qp, feasible_start(qp))


def energy_distance(qp: ContactQP, solution: Solution, exact: Solution) -> float:
    """Bound on |p - p*|_K, from the errors of both solutions and the rounding of displacements."""
    largest = max(solution.state.pressure.sum(), exact.state.pressure.sum())
    scale = qp.height_scale + float(np.abs(solution.state.deflection).max()) + float(np.abs(qp.profile).max())
    floor = ROUNDING * scale * largest
    parts = [state.error * qp.height_scale * largest + floor for state in (solution.state, exact.state)]
    return sum(math.sqrt(part) for part in parts)


@pytest.mark.parametrize(("solver", "case"), PAIRS)
def test_every_solver_finds_the_exact_solution(solver: Solver, case: Case) -> None:
    qp, solution = solved(case, solver)
    exact = reference(qp)
    assert solution.status.converged, solution.status.message
    assert exact.status.converged
    p, best = solution.state.pressure, exact.state.pressure
    assert relative_error(qp, p, qp.operator.apply(p)) <= 1.01 * solver.tolerance + 1e-12
    assert p.min() >= 0.0
    assert (p <= qp.cap).all()
    if isinstance(qp.constraint, FixedMean):
        assert p.mean() == pytest.approx(qp.constraint.mean_pressure, rel=1e-13)

    distance = energy_distance(qp, solution, exact)
    matrix = qp.operator.matrix()
    difference = (p - best).ravel()
    assert difference @ matrix @ difference <= distance**2
    displacement = np.abs(solution.state.deflection - exact.state.deflection).max()
    assert displacement <= math.sqrt(matrix[0, 0]) * distance * (1 + 1e-9) + 1e-12 * np.abs(qp.profile).max()

    bound = pressure_bound(qp, matrix, p, best, distance)
    assert np.abs(difference).max() <= bound
    assert np.count_nonzero(best > bound) <= np.count_nonzero(p > 0.0)
    assert np.count_nonzero(p > bound) <= np.count_nonzero(best > 0.0)
    if isinstance(case.control, MeanGap):
        r = solution.state.deflection - qp.profile
        mean_gap = np.maximum(r - level(qp, p, r), 0.0).mean()
        assert mean_gap == pytest.approx(case.control.value, rel=max(1e-8, 10 * solver.tolerance))


def pressure_bound(qp: ContactQP, matrix: np.ndarray, p: np.ndarray, best: np.ndarray, distance: float) -> float:
    """Bound on |p - p*|_2 from that in the energy norm, on the points where either is loaded."""
    loaded = ((p > 0.0) | (best > 0.0)).ravel()
    block = matrix[np.ix_(loaded, loaded)]
    if isinstance(qp.constraint, FixedMean):  # differences have zero sum: a common shift of the matrix changes nothing
        block = block + matrix[0, 0]
    stiffest = float(np.linalg.eigvalsh(block)[0])
    if stiffest <= 1e-12 * matrix[0, 0]:  # full contact at a prescribed position does not fix the mean pressure
        return math.inf
    return distance / math.sqrt(stiffest) + 1e-12 * float(best.max())


@pytest.mark.parametrize(("solver", "case"), PAIRS)
def test_every_solver_finds_the_same_offset(solver: Solver, case: Case) -> None:
    qp, solution = solved(case, solver)
    exact = reference(qp)
    p, best = solution.state.pressure, exact.state.pressure
    found = level(qp, p, solution.state.deflection - qp.profile)
    wanted = level(qp, best, exact.state.deflection - qp.profile)
    if not isinstance(qp.constraint, FixedMean):
        assert found == wanted
        return
    margin = np.where((best > 0.0) & (best < qp.cap), np.minimum(p, qp.cap - p), 0.0).max()
    if margin <= 0.0:  # every pressure at a bound: the level is an interval
        return
    displacement = math.sqrt(qp.operator.matrix()[0, 0]) * energy_distance(qp, solution, exact)
    error = solution.state.error * qp.height_scale * (1.0 + p.sum() / margin)
    assert abs(found - wanted) <= displacement + error + 1e-12 * (qp.height_scale + abs(wanted))


@pytest.mark.parametrize(("solver", "case"), UNSUPPORTED, ids=str)
def test_unsupported_cases_are_refused_with_a_way_out(solver: str, case: str) -> None:
    with pytest.raises(InputError, match=r"must have at most .* Use "):
        solved(next(c for c in CASES if c.name == case), SOLVERS[solver])


def test_reasons_name_known_solvers_and_cases() -> None:
    names = {case.name for case in CASES}
    assert len(names) == len(CASES)
    for solver, case in UNSUPPORTED:
        assert solver in SOLVERS
        assert case in names
