"""The exact active-set solver, on which the agreement of all others rests, against enumeration and
a general QP solver."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from catalogue import EXACT, MODULUS, feasible_start

from asperity import Grid
from asperity.contact.operators import FreeOperator, PeriodicOperator
from asperity.contact.solvers.reference.dense import Lemke, all_at_once, dense_form, one_by_one
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import ContactQP, DenseActiveSet, FixedMean, FixedOffset, run

SHAPES = ((1, 4), (2, 3), (5, 1), (2, 4))


def tiny(shape: tuple[int, int], seed: int, *, free: bool, capped: bool, load: bool) -> ContactQP:
    """Random problem of at most eight points with all kinds of contact."""
    rng = np.random.default_rng(seed)
    grid = Grid(shape, (1e-7, 1.5e-7))
    operator = (FreeOperator if free else PeriodicOperator)(HalfSpace(MODULUS), grid)
    heights = 1e-9 * rng.standard_normal(shape)
    cap = rng.uniform(0.2e9, 1.0e9, shape) if capped else np.inf
    mean = rng.uniform(0.05e9, 0.15e9)
    offset = float(heights.mean() + rng.uniform(0.1, 0.9) * (heights.max() - heights.mean()))
    return ContactQP(operator, heights, cap, FixedMean(mean) if load else FixedOffset(offset), float(heights.std()))


def enumerated(qp: ContactQP) -> np.ndarray:
    """Pressure of the one assignment of points to idle, free and capped that meets every
    condition."""
    n, matrix, heights = qp.profile.size, qp.operator.matrix(), qp.profile.ravel()
    cap = np.broadcast_to(qp.cap, qp.profile.shape).ravel()
    unit = float(matrix[0, 0])  # keeps the bordered matrix well scaled
    sides = (0, 1) if qp.elastic else (0, 1, 2)
    slack_p, slack_g = 1.0, 1e-9 * qp.height_scale  # Pa, m: rounding
    for assignment in itertools.product(sides, repeat=n):
        side = np.array(assignment)
        free, p = side == 1, np.where(side == 2, cap, 0.0)
        right = heights - matrix @ p
        if isinstance(qp.constraint, FixedMean):
            count = int(free.sum())
            if count == 0:
                continue
            system = np.zeros((count + 1, count + 1))
            system[:count, :count] = matrix[np.ix_(free, free)] / unit
            system[:count, count], system[count, :count] = -1.0, 1.0
            total = qp.constraint.mean_pressure * n - p.sum()
            solution = np.linalg.solve(system, np.append(right[free] / unit, total))
            p[free], at = solution[:count], unit * solution[count]
        else:
            at = -qp.constraint.offset
            if free.any() and np.linalg.matrix_rank(matrix[np.ix_(free, free)]) < free.sum():
                continue
            p[free] = np.linalg.solve(matrix[np.ix_(free, free)], right[free] + at)
        gap = matrix @ p - heights - at
        bounded = (p >= -slack_p).all() and (p <= cap + slack_p).all()
        if bounded and (gap[side == 0] >= -slack_g).all() and (gap[side == 2] <= slack_g).all():
            return p.reshape(qp.profile.shape)
    raise AssertionError("no assignment meets the conditions")


KINDS = list(itertools.product((False, True), repeat=3))


@pytest.mark.parametrize(("free", "capped", "load"), KINDS)
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_equals_the_enumeration_of_all_contact_sets(
    shape: tuple[int, int], free: bool, capped: bool, load: bool
) -> None:
    for seed in range(1 if capped and np.prod(shape) == 8 else 4):
        qp = tiny(shape, seed, free=free, capped=capped, load=load)
        solution = run(EXACT, qp, feasible_start(qp))
        assert solution.status.converged
        expected = enumerated(qp)
        np.testing.assert_allclose(solution.state.pressure, expected, rtol=1e-9, atol=1e-10 * expected.max())


@pytest.mark.parametrize(("free", "capped", "load"), KINDS)
def test_equals_a_general_solver(free: bool, capped: bool, load: bool) -> None:
    from scipy.optimize import Bounds, LinearConstraint, minimize

    qp = tiny((4, 5), 11, free=free, capped=capped, load=load)
    exact = run(EXACT, qp, feasible_start(qp)).state.pressure.ravel()
    dense = dense_form(qp)
    constraints = [] if dense.total is None else [LinearConstraint(np.ones((1, 20)), dense.total, dense.total)]
    found = minimize(
        lambda x: (0.5 * x @ dense.matrix @ x - x @ dense.heights, dense.matrix @ x - dense.heights),
        feasible_start(qp).ravel() / dense.unit,
        jac=True,
        method="SLSQP",
        bounds=Bounds(0.0, dense.cap),
        constraints=constraints,
        options={"ftol": 1e-15, "maxiter": 500},
    )
    np.testing.assert_allclose(found.x * dense.unit, exact, atol=1e-6 * exact.max())


@pytest.mark.parametrize(("free", "capped", "load"), KINDS)
def test_single_changes_end_where_all_at_once_does(free: bool, capped: bool, load: bool) -> None:
    qp = tiny((7, 6), 3, free=free, capped=capped, load=load)
    dense = dense_form(qp)
    start = feasible_start(qp).ravel() / dense.unit
    together, _ = all_at_once(dense, start, 100)
    x, used, finished = one_by_one(dense, start, 1000)
    assert finished
    assert used < 200
    assert together is not None
    np.testing.assert_allclose(x, together.x, atol=1e-11 * together.x.max())


def test_reaches_rounding() -> None:
    qp = tiny((9, 8), 5, free=True, capped=True, load=True)
    solution = run(DenseActiveSet(tolerance=1e-13), qp, feasible_start(qp))
    assert solution.status.converged
    assert solution.state.error < 1e-13


@pytest.mark.parametrize("mean", [1e-6, 0.3])
def test_a_load_carried_by_points_at_their_cap_moves_to_others(mean: float) -> None:
    """With no point free the level is open: a point leaves its cap only together with one that
    takes the load."""
    unfinished, wrong = [], []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        operator = PeriodicOperator(HalfSpace(1.0), Grid((4, 6), (1.0, 0.7)))
        heights = np.round(2.0 * rng.standard_normal((4, 6)))
        qp = ContactQP(operator, heights, 4.0 * mean, FixedMean(mean), 2.0)
        dense = dense_form(qp, near_contact=True)
        start = np.zeros(24)
        start[rng.permutation(24)[:6]] = dense.cap[0]  # the whole load, at points that need not be the right ones
        x, _, finished = one_by_one(dense, start, 300)
        if not finished:
            unfinished.append(seed)
        state = run(Lemke(tolerance=1e-8), qp).state
        right = dense.matrix @ (state.pressure.ravel() / dense.unit), dense.matrix @ x
        if np.abs(right[0] - right[1]).max() > 1e-9 * np.abs(right[0]).max():
            wrong.append(seed)
    assert not unfinished
    assert not wrong
