"""Loading, unloading and loading again: conservation of energy, reversibility, the surface that is
left."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from contact_cases import elastic, rough
from refusals import refused

import asperity as asp
from asperity.solvers import ActiveSet

SOLVER = ActiveSet(tolerance=1e-10)
BOUNDARIES = pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)


def coated(film: float, base: float, thickness: float) -> asp.Layered:
    """Unit E*, film and base of different hardness."""
    upper, lower = (asp.Elastic(0.91, 0.3, asp.Strength(hardness=h)) for h in (film, base))
    return asp.Layered([asp.Layer(upper, thickness)], lower)


def posed(law: str = "constant", boundary: asp.Periodic | asp.Free = asp.Periodic()) -> asp.ContactProblem:
    if law == "constant":
        return asp.ContactProblem(rough((24, 20), 3), elastic(1.0), boundary=boundary, law=asp.Hardness(0.4))
    body = coated(0.3, 0.6, 0.3) if law == "soft film" else coated(0.6, 0.3, 0.5)
    return asp.ContactProblem(rough((24, 20), 3), body, boundary=boundary, law=asp.plasticity.LayeredHardness(body))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("boundary", "law"),
    [
        *((asp.Periodic(), law) for law in ("constant", "soft film", "hard film")),
        (asp.Free(), "constant"),
        *(pytest.param(asp.Free(), law, marks=pytest.mark.slow) for law in ("soft film", "hard film")),
    ],
    ids=lambda value: getattr(value, "name", value),
)
def test_work_goes_into_elastic_energy_and_plastic_work(boundary, law):
    """The residual is that of the trapezoidal rule for ∫ F dδ, of second order: measured 1.7 to 2.4
    from one halving to the next, 2.0 on average, since pixels come into contact one by one."""
    problem = posed(law, boundary)
    errors = []
    for steps in (4, 8, 16):
        path = asp.solve(
            problem, asp.History(asp.contact.ramps(asp.MeanPressure, [0.2, 0.0, 0.24, 0.0], steps=steps)), solver=SOLVER
        )
        balance = path.energies
        assert path.converged
        assert balance.elastic_energy[-1] == 0.0  # unloaded
        assert (np.diff(balance.plastic_work) >= 0.0).all()
        errors.append(balance.relative_error)
    assert min(math.log2(a / b) for a, b in itertools.pairwise(errors)) > 1.5
    assert math.log2(errors[0] / errors[-1]) / 2.0 > 1.7
    assert errors[-1] < 0.006


def test_the_balance_is_of_second_order_in_the_step_of_the_approach():
    """Measured 2.1 on average of three halvings."""
    problem = posed("constant", asp.Free())
    errors = []
    for steps in (4, 8, 16, 32):
        path = asp.solve(problem, asp.History(asp.contact.ramps(asp.Approach, [2.0], steps=steps)), solver=SOLVER)
        errors.append(path.energies.relative_error)
    assert path.plastic_work.sum() > 0.1 * path.elastic_energy[-1]
    assert math.log2(errors[0] / errors[-1]) / 3.0 > 1.7


def test_a_path_that_goes_on_is_balanced_from_its_first_step():
    problem = posed()
    whole = asp.solve(problem, asp.History(asp.contact.ramps(asp.MeanPressure, [0.2], steps=8)), solver=SOLVER)
    rest = asp.solve(
        problem,
        asp.History(asp.contact.ramps(asp.MeanPressure, [0.2], steps=8)[4:]),
        solver=SOLVER,
        state=whole.steps[3].state,
    )
    parts, total = rest.energies, whole.energies
    for name in ("external_work", "elastic_energy", "plastic_work"):
        found, wanted = getattr(parts, name), getattr(total, name)[4:]
        assert found[0] == 0.0
        # two solutions of the same load agree to the tolerance of the solver
        np.testing.assert_allclose(found, wanted - wanted[0], rtol=1e-5, atol=1e-7 * total.external_work[-1])


@pytest.mark.parametrize("law", ["constant", "soft film", "hard film"])
@BOUNDARIES
def test_a_lower_load_than_before_is_elastic_and_reversible(boundary, law):
    problem = posed(law, boundary)
    first = asp.solve(problem, asp.History(asp.contact.ramps(asp.MeanPressure, [0.2, 0.0], steps=4)), solver=SOLVER)
    again = asp.solve(
        problem,
        asp.History(asp.contact.ramps(asp.MeanPressure, [0.15, 0.0], steps=3)),
        solver=SOLVER,
        state=first.steps[-1].state,
    )
    work = first.plastic_work.sum()
    assert again.plastic_work.sum() <= 1e-3 * work
    for up, down in zip(again.steps[:2], again.steps[4:2:-1], strict=True):
        assert up.mean_pressure == pytest.approx(down.mean_pressure)
        assert up.approach == pytest.approx(down.approach, rel=1e-4)
        # energy norm: the square of the pressure error is bounded by field error times load times
        # rms height
        assert up.elastic_energy == pytest.approx(down.elastic_energy, rel=1e-3)
    assert again.steps[-1].approach == pytest.approx(first.steps[-1].approach, rel=1e-3)
    assert again.steps[-1].total_plastic_work == pytest.approx(work, rel=1e-3)


@BOUNDARIES
def test_the_residual_surface_is_a_surface_like_any_other(boundary):
    """Pressed elastically, it meets the counter body as the indented surface does with its
    state."""
    problem = posed(boundary=boundary)
    loaded = asp.solve(problem, asp.MeanPressure(0.2), solver=SOLVER)
    left = loaded.residual_surface()
    fresh = asp.ContactProblem(left, problem.body, boundary=boundary, law=problem.law)
    one = asp.solve(fresh, asp.MeanPressure(0.15), solver=SOLVER)
    other = asp.solve(problem, asp.MeanPressure(0.15), solver=SOLVER, state=loaded.state)
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=0.0, atol=1e-4 * other.max_pressure)
    assert one.gap == pytest.approx(other.gap, abs=1e-4)
    assert left.periodic == problem.surface.periodic
    assert left.origin.history[-1].startswith("indented for good")


def test_the_residual_surface_of_each_body():
    surface, counter = rough((24, 20), 3), rough((24, 20), 5)
    problem = asp.ContactProblem(surface, elastic(1.0), counter, law=asp.Hardness(0.5))
    result = asp.solve(problem, asp.MeanPressure(0.2), solver=SOLVER)
    dents = result.permanent_indentation
    assert dents.max() > 0.0
    np.testing.assert_array_equal(result.residual_surface("body").heights, surface.heights - dents)
    np.testing.assert_array_equal(result.residual_surface("counter_body").heights, counter.heights - dents)
    np.testing.assert_array_equal(result.residual_surface().heights, surface.heights + counter.heights - dents)
    against_flat = asp.solve(posed(), asp.MeanPressure(0.2), solver=SOLVER)
    np.testing.assert_array_equal(
        against_flat.residual_surface("counter_body").heights, -against_flat.permanent_indentation
    )
    with refused(asp.InputError, "part of a residual surface", "counter_body"):
        result.residual_surface("both")  # type: ignore[arg-type]


@BOUNDARIES
def test_unloaded_bodies_just_touch(boundary):
    problem = posed(boundary=boundary)
    loaded = asp.solve(problem, asp.MeanPressure(0.2), solver=SOLVER)
    free = asp.solve(problem, asp.Unloaded(), state=loaded.state)
    assert free.converged
    assert free.gap.min() == 0.0
    assert (free.pressure == 0.0).all()
    assert (free.displacement == 0.0).all()
    for name in ("force", "area_fraction", "elastic_energy", "plastic_work", "n_spots", "max_pressure"):
        assert getattr(free, name) == 0.0, name
    np.testing.assert_array_equal(free.permanent_indentation, loaded.permanent_indentation)
    assert free.approach == pytest.approx(problem.profile().max() - loaded.residual_surface().heights.max())
    assert free.total_plastic_work == loaded.total_plastic_work > 0.0
    assert asp.solve(problem, asp.Unloaded()).approach == 0.0


def test_plastic_work_adds_up():
    problem = posed()
    path = asp.solve(
        problem, asp.History(asp.contact.ramps(asp.MeanPressure, [0.2, 0.0, 0.25], steps=3)), solver=SOLVER
    )
    last = path.steps[-1]
    assert last.total_plastic_work == pytest.approx(path.plastic_work.sum(), rel=1e-12)
    assert last.total_plastic_work == pytest.approx(0.4 * last.plastic_volume, rel=1e-12)
    assert last.indented_area == np.count_nonzero(last.indented) * problem.grid.pixel_area
    assert (last.indented >= last.plastic).all()


def test_a_state_must_have_dissipated_something_positive():
    none = np.zeros((4, 4))
    with refused(asp.InputError, "plastic work (J) of an interface state"):
        asp.solvers.InterfaceState.dented(none, none, -1.0)
