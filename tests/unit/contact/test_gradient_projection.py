"""Non-negative least squares by transforms only: agreement on grids that no dense method takes, the
certificate, and energies that never rise."""

from __future__ import annotations

import numpy as np
import pytest
from catalogue import CASES, EXACT, feasible_start, solved
from contact_cases import elastic, rough

import asperity as asp
from asperity.contact.solvers.protocol import energy
from asperity.solvers import GradientProjection

TOLERANCE = 1e-10


def certified(shape, boundary, law, load, seed=1):
    """Results by gradient projection and the default method."""
    problem = asp.ContactProblem(rough(shape, seed, power=1.8), elastic(1.0), boundary=boundary, law=law)
    methods = GradientProjection(tolerance=TOLERANCE), asp.solvers.ActiveSet(tolerance=TOLERANCE)
    return [asp.solve(problem, asp.MeanPressure(load), solver=method) for method in methods]


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=["periodic", "free"])
@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(0.4)], ids=["elastic", "capped"])
def test_agrees_beyond_the_dense_limit(boundary, law) -> None:
    """The duality gap bounds the energy of the difference, so that pressures differ by about the
    square root of the error."""
    found, default = certified((96, 80), boundary, law, 0.01)
    assert found.converged
    assert found.mean_pressure == pytest.approx(0.01, rel=1e-12)
    bound = np.sqrt(TOLERANCE) * default.max_pressure
    np.testing.assert_allclose(found.pressure, default.pressure, rtol=0.0, atol=bound)


@pytest.mark.parametrize("name", ["rough free load", "rough periodic load"])
def test_no_step_raises_the_energy(name: str) -> None:
    qp = solved(next(case for case in CASES if case.name == name), EXACT)[0]
    method = GradientProjection()
    state, energies = method.init(qp, feasible_start(qp)), []
    while state.error > 1e-9 and state.iterations < 200:
        energies.append(energy(qp, state.pressure, state.deflection))
        state = method.step(qp, state)
    assert state.error <= 1e-9
    assert (np.diff(energies) <= 1e-13 * np.abs(energies).max()).all()
