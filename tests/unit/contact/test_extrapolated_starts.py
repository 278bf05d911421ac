"""Loads that start from the two before them: pressure and displacement extrapolated alike, for the
displacement is linear in the pressure."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest
from contact_cases import elastic, rough

import asperity as asp
from asperity.solvers import ActiveSet

SOLVER = ActiveSet(tolerance=1e-9)
LOADS = (0.02, 0.03, 0.045, 0.06)


def posed(boundary=asp.Periodic(), modulus: float = 1.0) -> asp.ContactProblem:
    """Rough surface of 96² points."""
    surface = rough((96, 96), 3, power=2.0)
    surface = asp.Surface(surface.heights, 1.0, periodic=isinstance(boundary, asp.Periodic))
    return asp.ContactProblem(surface, elastic(modulus), boundary=boundary)


def along(problem: asp.ContactProblem, loads=LOADS, **options) -> list[asp.ContactResult]:
    """Results of the path of ``loads``."""
    controls = [asp.MeanPressure(load) for load in loads]
    return list(asp.solve(problem, asp.History(controls), solver=SOLVER, **options).steps)


def forgotten(state: asp.solvers.InterfaceState) -> asp.solvers.InterfaceState:
    """The same as from a file, with arrays of its own."""
    return asp.solvers.InterfaceState(state.pressure.copy(), state.memory, state.earlier.copy())


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize(
    "loads", [LOADS, (0.06, 0.05, 0.035, 0.02), (0.02, 0.05, 0.03, 0.01)], ids=("up", "down", "back")
)
def test_answers_are_those_of_cold_solves(boundary, loads):
    """On the way down pressures would become tensile at the border of the contact; a turn starts
    anew."""
    problem = posed(boundary)
    for result, load in zip(along(problem, loads), loads, strict=True):
        cold = asp.solve(problem, asp.MeanPressure(load), solver=SOLVER)
        assert result.converged
        assert result.certificate.duality_gap < 1e-7
        np.testing.assert_allclose(result.pressure, cold.pressure, rtol=0.0, atol=2e-4 * cold.max_pressure)
        np.testing.assert_array_equal(result.displacement, along_displacement(problem, result))


def along_displacement(problem: asp.ContactProblem, result: asp.ContactResult) -> np.ndarray:
    """Displacement by the pressure, from scratch."""
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    out = np.empty_like(result.pressure)
    return operator.convolution("float64").apply(result.pressure, out)


def test_products_at_hand_do_not_change_the_answer():
    """A state without them, as one from a file, gives the same bits after two more products."""
    problem = posed()
    third, last = along(problem)[2:]
    again = asp.solve(problem, asp.MeanPressure(LOADS[-1]), solver=SOLVER, state=forgotten(third.state))
    np.testing.assert_array_equal(again.pressure, last.pressure)
    np.testing.assert_array_equal(again.displacement, last.displacement)
    assert again.certificate.fft_pairs == last.certificate.fft_pairs + 2.0


def test_displacements_of_another_body_are_not_taken():
    """The pressure of a contact may start one of other bodies; its displacement is then another."""
    problem, other = posed(), posed(modulus=3.0)
    state = along(problem)[2].state
    found = asp.solve(other, asp.MeanPressure(LOADS[-1]), solver=SOLVER, state=state)
    forgot = asp.solve(other, asp.MeanPressure(LOADS[-1]), solver=SOLVER, state=forgotten(state))
    np.testing.assert_array_equal(found.pressure, forgot.pressure)
    assert found.certificate.fft_pairs == forgot.certificate.fft_pairs


def test_displacements_belong_to_the_arrays_of_pressure():
    """A state with other pressures cannot bring the displacements of the old ones."""
    problem = posed()
    state = along(problem)[2].state
    changed = replace(state, pressure=1.01 * state.pressure)
    found = asp.solve(problem, asp.MeanPressure(LOADS[-1]), solver=SOLVER, state=changed)
    forgot = asp.solve(problem, asp.MeanPressure(LOADS[-1]), solver=SOLVER, state=forgotten(changed))
    np.testing.assert_array_equal(found.pressure, forgot.pressure)


def test_the_load_of_the_last_step_again():
    """A start that is the answer already is confirmed by a product from scratch."""
    problem = posed()
    state = along(problem)[2].state
    found = asp.solve(problem, asp.MeanPressure(LOADS[2] * (1.0 + 1e-13)), solver=SOLVER, state=state)
    assert found.certificate.fft_pairs <= 3.0
    np.testing.assert_array_equal(found.displacement, along_displacement(problem, found))


def test_a_pickle_has_no_products():
    """They hold arrays and a machine that cannot go along."""
    result = along(posed())[2]
    copied = pickle.loads(pickle.dumps(result))
    assert result.deflections is not None
    assert copied.deflections is None
    np.testing.assert_array_equal(copied.pressure, result.pressure)


def test_a_product_less_each_step():
    """Steps after the second against the same without displacements at hand: two products less, one
    less than by a product of the start."""
    problem = posed()
    results = along(problem)
    for before, result, load in zip(results[1:], results[2:], LOADS[2:], strict=False):
        without = asp.solve(problem, asp.MeanPressure(load), solver=SOLVER, state=forgotten(before.state))
        assert without.certificate.fft_pairs - result.certificate.fft_pairs == 2.0


def test_a_contact_goes_on_from_a_known_one_without_a_product():
    """The same problem needs nothing; one of slightly other heights one product less than without
    the displacement, with an answer within the bounds of both."""
    problem, control = posed(), asp.MeanPressure(LOADS[0])
    found = asp.solve(problem, control, solver=SOLVER)
    state = replace(found.state, earlier=None, deflections=replace(found.deflections, within=True))
    again = asp.solve(problem, control, solver=SOLVER, state=state)
    np.testing.assert_array_equal(again.pressure, found.pressure)
    assert again.converged
    assert again.certificate.fft_pairs == 0.0
    heights = np.asarray(problem.surface.heights)
    other = replace(problem, surface=asp.Surface(heights + 1e-4 * heights**2 / heights.std(), 1.0))
    known, forgot = (
        asp.solve(other, control, solver=SOLVER, state=each)
        for each in (state, asp.solvers.InterfaceState(state.pressure.copy()))
    )
    cold = asp.solve(other, control, solver=SOLVER)
    assert known.certificate.fft_pairs == forgot.certificate.fft_pairs - 1.0
    np.testing.assert_allclose(known.pressure, cold.pressure, rtol=0.0, atol=2e-4 * cold.max_pressure)
    np.testing.assert_array_equal(known.displacement, along_displacement(other, known))
