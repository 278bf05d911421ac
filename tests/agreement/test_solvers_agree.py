"""All solvers find the one solution of the convex problem, within bounds that follow from their own
reported errors.

With e the relative error of a solver (``optimality.relative_error``), convexity gives, for
prescribed load and for prescribed position alike (variational inequality at the exact p*),

    |p - p*|_K² <= sum g·(p - p*) <= e · height_scale · max(sum p, sum p*),

from which bounds of pressure, displacement, offset and contact area follow without any tuned
number.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from catalogue import (
    CASES,
    EXACT,
    SOLVERS,
    UNSUPPORTED,
    Case,
    feasible_start,
    pair_id,
    solved,
)
from refusals import refused

from asperity import MeanGap
from asperity.contact.solvers.protocol import level, relative_error
from asperity.core.errors import InputError
from asperity.solvers import ContactQP, FixedMean, Solution, Solver, run

ROUNDING = 1e-13
"""Relative rounding of sums over these grids."""


def energy_distance(qp: ContactQP, solution: Solution, exact: Solution) -> float:
    """Bound on |p - p*|_K, from the errors of both solutions and the rounding of displacements."""
    largest = max(solution.state.pressure.sum(), exact.state.pressure.sum())
    scale = qp.height_scale + float(np.abs(solution.state.deflection).max()) + float(np.abs(qp.profile).max())
    floor = ROUNDING * scale * largest
    parts = [state.error * qp.height_scale * largest + floor for state in (solution.state, exact.state)]
    return sum(math.sqrt(part) for part in parts)


@pytest.mark.parametrize("case", CASES, ids=pair_id)
def test_every_solver_finds_the_exact_solution(case: Case) -> None:
    """Each pair is solved once; the exact solution once for each constraint, which differs only
    where it was searched."""
    exact: dict[object, Solution] = {}
    wrong = []
    for solver in SOLVERS.values():
        if (solver.name, case.name) in UNSUPPORTED:
            continue
        qp, solution = solved(case, solver)
        if qp.constraint not in exact:
            exact[qp.constraint] = run(EXACT, qp, feasible_start(qp))
        try:
            check_fields(case, solver, qp, solution, exact[qp.constraint])
            check_level(qp, solution, exact[qp.constraint])
        except AssertionError as error:
            wrong.append(f"{solver.name}: {error}")
    assert not wrong, "\n".join(wrong)


def check_fields(case: Case, solver: Solver, qp: ContactQP, solution: Solution, exact: Solution) -> None:
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


def check_level(qp: ContactQP, solution: Solution, exact: Solution) -> None:
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


@pytest.mark.parametrize(("solver", "case"), UNSUPPORTED, ids=str)
def test_unsupported_cases_are_refused_with_a_way_out(solver: str, case: str) -> None:
    with refused(InputError, "grid of Lemke's method"):
        solved(next(c for c in CASES if c.name == case), SOLVERS[solver])


def test_reasons_name_known_solvers_and_cases() -> None:
    names = {case.name for case in CASES}
    assert len(names) == len(CASES)
    for solver, case in UNSUPPORTED:
        assert solver in SOLVERS
        assert case in names
