"""Random tiny problems with loads, heights and caps over many decades: every solver solves every
one of them."""

from __future__ import annotations

import numpy as np
import pytest
from catalogue import EXACT, MODULUS, SOLVERS, feasible_start, pair_id

from asperity import Grid
from asperity.contact.operators import FreeOperator, PeriodicOperator
from asperity.core.status import Outcome
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import ContactQP, FixedMean, FixedOffset, Solver, run

SEEDS = range(2, 100)


def problem(seed: int) -> ContactQP:
    """Up to 8 x 8 points, a third of the profiles with many equal heights, caps from 10 MPa to 10
    GPa or none."""
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(2, 9)), int(rng.integers(1, 9))
    free, capped = rng.random() < 0.5, int(rng.integers(3))
    operator_class = FreeOperator if free else PeriodicOperator
    operator = operator_class(HalfSpace(MODULUS), Grid(shape, (1e-7, rng.uniform(0.3e-7, 3e-7))))
    heights = 1e-9 * rng.standard_normal(shape)
    if rng.random() < 0.3:
        heights = np.round(heights, 9)
    cap = (np.inf, 10.0 ** rng.uniform(7, 10), 10.0 ** rng.uniform(7, 10, shape))[capped]
    scale = float(heights.std()) or 1e-9
    if rng.random() < 0.5:
        mean = min(10.0 ** rng.uniform(3, 10), 0.9999 * float(np.mean(cap)))
        return ContactQP(operator, heights, cap, FixedMean(mean), scale)
    full_contact_ends_it = capped == 0 and not free
    low = heights.mean() if full_contact_ends_it else heights.min() - 2e-9
    return ContactQP(
        operator, heights, cap, FixedOffset(float(low + 0.99 * rng.random() * (heights.max() - low))), scale
    )


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=pair_id)
def test_random_problems_are_solved(solver: Solver) -> None:
    for seed in SEEDS:
        qp = problem(seed)
        solution = run(solver, qp, feasible_start(qp))
        if solver.name == "steepest_descent" and not solution.status.converged:  # may stall, with that status
            assert solution.status.outcome is Outcome.STAGNATED
            continue
        assert solution.status.converged, f"seed {seed}: {solution.status.message}"
        exact = run(EXACT, qp, feasible_start(qp)).state
        found = solution.state
        difference = found.pressure - exact.pressure
        largest = max(found.pressure.sum(), exact.pressure.sum())
        floor = 1e-13 * (np.abs(qp.profile).max() + np.abs(found.deflection).max()) * largest
        bound = sum(np.sqrt(error * qp.height_scale * largest + floor) for error in (found.error, exact.error))
        assert (difference * qp.operator.apply(difference)).sum() <= bound**2, f"seed {seed}"
