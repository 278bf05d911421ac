"""Prescribed positions: the load that reaches one is found along with the pressure."""

from __future__ import annotations

import numpy as np
import pytest
from contact_cases import elastic, rough

import asperity as asp
from asperity.contact.solvers.active_set import level
from asperity.solvers import ActiveSet, ConjugateGradient

BODIES = {
    "half-space": elastic(1.0),
    "stiff film": asp.Layered([asp.Layer(elastic(10.0), 4.0)], elastic(1.0)),
    "very stiff film": asp.Layered([asp.Layer(elastic(100.0), 2.0)], elastic(1.0)),
    "soft film": asp.Layered([asp.Layer(elastic(0.1), 4.0)], elastic(1.0)),
}
LOADS = (0.001, 0.005, 0.02)  # up to a third of the area of half-spaces, nearly all of a soft film
BOUND = 1e-7  # of a position over the rms height, and of the load by which it is prescribed here


def posed(body: str = "half-space", seed: int = 3) -> asp.ContactProblem:
    """Rough surface of 128² points."""
    surface = asp.Surface(rough((128, 128), seed, power=2.0).heights, 1.0, periodic=True)
    return asp.ContactProblem(surface, BODIES[body])


def reached(problem: asp.ContactProblem, load: float, solver=None) -> tuple[asp.ContactResult, asp.ContactResult]:
    """Contacts at the approach and at the mean gap of a load."""
    solver = solver or ActiveSet(tolerance=1e-9)
    cold = asp.solve(problem, asp.MeanPressure(load), solver=ActiveSet(tolerance=1e-10))
    controls = asp.Approach(cold.approach), asp.MeanGap(cold.mean_gap)
    near, apart = (asp.solve(problem, control, solver=solver) for control in controls)
    for found in (near, apart):
        assert found.converged
        np.testing.assert_allclose(found.pressure, cold.pressure, rtol=0.0, atol=1e-4 * cold.max_pressure)
    return near, apart


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("load", LOADS)
def test_load_is_the_one_that_gives_the_position(body, load):
    """The way back from a load by its approach, and by its mean gap."""
    for found in reached(posed(body), load):
        assert found.mean_pressure == pytest.approx(load, rel=BOUND)


def test_one_contact_is_solved_instead_of_several(monkeypatch):
    """Where the search gives up, loads are tried one after the other; both ways end in the same
    contact, the latter after more transforms."""
    problem = posed()
    ways = []
    for steps in (level._MOST_STEPS, 0):
        monkeypatch.setattr(level, "_MOST_STEPS", steps)
        ways.append(reached(problem, 0.05, ActiveSet(tolerance=1e-7)))
    for quick, slow in zip(*ways, strict=True):
        assert quick.mean_pressure == pytest.approx(slow.mean_pressure, rel=BOUND)
        assert quick.certificate.fft_pairs < 0.8 * slow.certificate.fft_pairs


@pytest.mark.parametrize("load", [1e-6, 0.2])
def test_hardly_touching_and_nearly_full_contacts(load):
    """Few points, and a mean gap that is small against the rms height."""
    problem = posed()
    cold = asp.solve(problem, asp.MeanPressure(load), solver=ActiveSet(tolerance=1e-10))
    found = asp.solve(problem, asp.Approach(cold.approach), solver=ActiveSet(tolerance=1e-9))
    assert found.converged
    assert found.approach == pytest.approx(cold.approach, rel=BOUND)
    assert abs(found.mean_gap - cold.mean_gap) < BOUND * problem.surface.heights.std()


def test_another_method_finds_the_same():
    """Conjugate gradients are searched with loads alone."""
    (near, apart), (other, _) = reached(posed(), 0.05), reached(posed(), 0.05, ConjugateGradient(tolerance=1e-9))
    assert near.mean_pressure == pytest.approx(other.mean_pressure, rel=BOUND)
    assert near.mean_pressure == pytest.approx(apart.mean_pressure, rel=BOUND)


def test_path_of_positions_goes_on_from_the_contact_before():
    """Each position starts from the load of the one before, upwards and back."""
    problem = posed()
    loads = (0.02, 0.05, 0.08, 0.03)
    controls = [asp.Approach(asp.solve(problem, asp.MeanPressure(load)).approach) for load in loads]
    for step, load in zip(asp.solve(problem, asp.History(controls)).steps, loads, strict=True):
        assert step.converged
        assert step.mean_pressure == pytest.approx(load, rel=1e-5)
