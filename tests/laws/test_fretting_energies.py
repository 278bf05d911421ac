"""Where the work of a tangential cycle goes: into slip, and what the length of the implicit steps
takes."""

from __future__ import annotations

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp

COATED = asp.Layered([asp.Layer(asp.Elastic(2.0, 0.3), 2.0)], asp.Elastic(0.5, 0.2))
LOAD = asp.MeanPressure(0.02)


def cycle(counter: object, steps: int) -> asp.HistoryResult:
    """One closed cycle at constant load, after pressing and the first shift to the amplitude."""
    problem = asp.ContactProblem(rough((20, 20), 4), COATED, counter_body=counter, friction=asp.Coulomb(0.3))  # type: ignore[arg-type]
    course = (
        asp.Step(LOAD, asp.Shift()),
        *asp.friction.shear_cycles(LOAD, asp.Shift(6e-3, 4e-3), cycles=1, steps=steps),
    )
    before = asp.solve(problem, asp.History(course[:steps]))
    return asp.solve(problem, asp.History(course[steps:]), state=before.state)


@pytest.mark.parametrize("counter", [asp.Rigid(), COATED])
def test_a_closed_cycle_balances(counter: object) -> None:
    """The shift does work; all of it is heat or the loss of the steps, to 1e-4. Equal bodies come
    back to the same energy (to the tolerance 1e-6)."""
    found = cycle(counter, 3).energies
    work = found.tangential_work[-1] + found.external_work[-1]
    assert work > 0.0
    assert found.slip_work[-1] > 0.01 * work
    assert np.abs(found.residual).max() <= 1e-4 * work
    assert work == pytest.approx(
        found.slip_work[-1] + found.step_work[-1] + found.elastic_energy[-1], rel=1e-4, abs=0.0
    )
    if counter is COATED:
        assert np.abs(found.residual).max() <= 1e-6 * work
        assert abs(found.elastic_energy[-1]) <= 1e-4 * work
        assert (np.diff(found.step_work) > 0.0).all()


def test_shorter_steps_lose_less() -> None:
    """What the steps take falls with their length; the work of the slip does not."""
    coarse, fine = (cycle(COATED, steps).energies for steps in (2, 4))
    assert fine.step_work[-1] == pytest.approx(0.5 * coarse.step_work[-1], rel=0.1)
    assert fine.slip_work[-1] == pytest.approx(coarse.slip_work[-1], rel=0.1)
