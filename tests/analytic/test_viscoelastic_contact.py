"""Viscoelastic contacts in time against Lee & Radok, Ting, the flat punch, coated limits, and their
energies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reference_data import Row, reference
from refusals import refused

import asperity as asp
from asperity.contact.measure import normal_stiffness
from asperity.contact.solve import steps
from asperity.physics.stress.survey import StressRequest, survey
from asperity.physics.viscoelastic.coupling import TimeWeights
from asperity.solids.compliance.creep import LayeredCreep, SharedCreep, complex_compliance, contact_creep

PRONY = {
    "sls": (1.0, ((9.0, 1.0),)),
    "prony3": (1.0, ((2.0, 10.0), (5.0, 1.0), (20.0, 0.01))),
    "maxwell": (0.0, ((1.0, 1.0),)),
}
"""Contact modulus of the reference materials: Young's modulus of a solid whose Poisson's ratio is
zero."""


def solid(name: str) -> asp.Viscoelastic:
    return asp.Viscoelastic.prony(*PRONY[name], 0.0)


def sphere(reach: float, points: int = 48) -> asp.Surface:
    """Paraboloid of radius 1 m on a square of half side ``reach``, its tip between four pixels."""
    x = (np.arange(points) - points / 2 + 0.5) * 2 * reach / points
    return asp.Surface(-0.5 * (x[:, None] ** 2 + x**2), 2 * reach / points)


def free(surface: asp.Surface, body: asp.Elastic | asp.Layered) -> asp.ContactProblem:
    return asp.ContactProblem(surface, body, boundary=asp.Free())


def rows(name: str, **wanted: object) -> list[Row]:
    found = [
        row for row in reference(f"viscoelasticity/{name}") if all(row[key] == value for key, value in wanted.items())
    ]
    return sorted(found, key=lambda row: float(row["t"]))


# Growing contact (Lee & Radok 1960).


@pytest.mark.parametrize("material", ["sls", "prony3", "maxwell"])
def test_sphere_creeps_under_a_step_of_load(material: str) -> None:
    """a³ = 3/4 R P J(t) by the approach a²/R, within the error of 48² pixels (2e-3) and of the
    steps of time."""
    table = rows("sphere_growing", material=material, history="load_step")
    largest = max(float(row["a"]) for row in table)
    times = [float(row["t"]) for row in table]
    load = asp.Force(float(table[0]["P"]))
    holds = [asp.Step(load, duration=float(dt)) for dt in np.diff([0.0, *times])]
    found = asp.solve(free(sphere(1.15 * largest), solid(material)), asp.History([load, *holds]))
    errors = [step.creep.time_error for step in found.steps if step.creep is not None]
    for step, row in zip(found.steps[1:], table, strict=True):
        assert step.approach == pytest.approx(row["delta"], rel=4e-3 + 2.0 * sum(errors))
        pixels = np.sqrt(step.contact_area / np.pi) - float(row["a"])
        assert abs(pixels) < 0.5 * step.problem.grid.spacing[0]


@pytest.mark.parametrize("material", ["sls", "prony3"])
def test_load_of_a_sphere_relaxes_under_a_step_of_approach(material: str) -> None:
    """P = 4/3 sqrt(R) delta^3/2 E(t) at a fixed area: within 3e-3, the error of the pixels, at all
    times.

    The pixels in contact stay what they are; where between them the edge lies is read with the
    modulus of the first instant, within its error.
    """
    table = rows("sphere_growing", material=material, history="approach_step")
    approach = asp.Approach(float(table[0]["delta"]))
    times = [float(row["t"]) for row in table]
    holds = [asp.Step(approach, duration=float(dt)) for dt in np.diff([0.0, *times])]
    found = asp.solve(free(sphere(0.17), solid(material)), asp.History([approach, *holds]))
    np.testing.assert_allclose(found.force[1:], [row["P"] for row in table], rtol=4e-3)
    assert (found.scalars("area_fraction") == found.scalars("area_fraction")[0]).all()
    area, error = found.area_fraction_corrected, found.scalars("area_fraction_error")
    assert (np.abs(area - area[0]) < error + error[0]).all()


@pytest.mark.parametrize("history", ["load_ramp", "approach_ramp"])
def test_ramps_of_a_sphere(history: str) -> None:
    table = [row for row in rows("sphere_growing", material="sls", history=history) if float(row["t"]) <= 2.0]
    surface = sphere(1.15 * max(float(row["a"]) for row in table), 64)
    by_load = history == "load_ramp"
    marks = [0.02 * float(table[-1]["t"]), *(float(row["t"]) for row in table if float(row["t"]) > 0.2)]
    rate = float(table[0]["amplitude_or_rate"])
    ramp = [
        asp.Step(asp.Force(rate * t) if by_load else asp.Approach(rate * t), duration=float(dt))
        for t, dt in zip(marks, np.diff([0.0, *marks]), strict=True)
    ]
    found = asp.solve(free(surface, solid("sls")), asp.History(ramp), time_steps=asp.TimeSteps(tolerance=3e-4))
    late = [row for row in table if float(row["t"]) > 0.2]
    for step, row in zip(found.steps[1:], late, strict=True):
        assert step.force == pytest.approx(row["P"], rel=6e-3)
        assert step.approach == pytest.approx(row["delta"], rel=6e-3)


def test_flat_punch_under_any_history_of_approach() -> None:
    """P(t) = ∫ E(t - s) d(stiffness delta): any history without tension, exact for approaches that
    are linear in time."""
    height = np.zeros((24, 24))
    height[:6], height[-6:], height[:, :6], height[:, -6:] = -1.0, -1.0, -1.0, -1.0
    problem = free(asp.Surface(height, 1e-3), solid("prony3"))
    stiffness = asp.solve(problem, asp.Approach(1e-4)).force / 1e-4 / 28.0
    times, values = np.array([0.0, 0.3, 2.0, 2.05, 6.0]), np.array([0.0, 1e-4, 1e-4, 0.95e-4, 1.3e-4])
    history = asp.History(
        [asp.Step(asp.Approach(float(d)), duration=float(t)) for d, t in zip(values[1:], np.diff(times), strict=True)]
    )
    found = asp.solve(problem, history, time_steps=asp.TimeSteps(tolerance=1e-5))
    relaxed, terms = PRONY["prony3"]
    slopes = np.diff(values) / np.diff(times)
    for end, step in enumerate(found.steps, start=1):
        expected = relaxed * values[end]
        for strength, tau in terms:
            late, early = np.exp(-(times[end] - times[1 : end + 1]) / tau), np.exp(-(times[end] - times[:end]) / tau)
            expected += strength * tau * float((slopes[:end] * (late - early)).sum())
        assert step.force == pytest.approx(stiffness * expected, rel=2e-3)


# Receding contact (Ting 1966).


@pytest.mark.parametrize("material", ["sls", "prony3", "maxwell"])
def test_sphere_pressed_and_withdrawn(material: str) -> None:
    """Load within 2e-3 of its peak all through a triangle of approach, and no contact after Ting's
    time of separation."""
    table = rows("sphere_ting_triangle", material=material, T=1.0)
    v, end = float(table[0]["v"]), float(table[0]["t_separation"])
    inside = [float(row["t"]) for row in table if float(row["t"]) < 0.995 * end]
    times = sorted({1.0, *inside, 1.02 * end})
    ramp = [
        asp.Step(asp.Approach(v * min(t, 2.0 - t)), duration=float(dt))
        for t, dt in zip(times, np.diff([0.0, *times]), strict=True)
    ]
    problem = free(sphere(1.2 * np.sqrt(v)), solid(material))
    found = asp.solve(problem, asp.History(ramp), time_steps=asp.TimeSteps(tolerance=5e-4))
    peak = max(float(row["P"]) for row in table)
    at = dict(zip(np.round(times, 9), found.steps, strict=True))
    for row in (row for row in table if float(row["t"]) < 0.995 * end):
        assert at[round(float(row["t"]), 9)].force == pytest.approx(row["P"], abs=2e-3 * peak)
    assert found.last.force == 0.0
    assert found.last.approach > 0.0
    assert found.energies.relative_error < 5e-3


def test_steps_of_time_are_of_second_order_and_their_error_is_estimated() -> None:
    """The load at a fixed approach falls as E(t): twice as many equal steps have a quarter of the
    error, which the estimate bounds."""
    problem = free(sphere(0.3, 24), solid("sls"))
    course = asp.History([asp.Approach(0.02), asp.Step(asp.Approach(0.02), duration=2.0)])
    relaxation, errors = solid("sls").relaxation, []
    expected = float(relaxation.at(2.0)) / relaxation.instantaneous
    for number in (8, 16, 32):
        settings = asp.TimeSteps(number=number)
        found = asp.solve(problem, course, time_steps=settings, solver=asp.solvers.ActiveSet(tolerance=1e-12))
        errors.append(abs(found.force[1] / found.force[0] / expected - 1.0))
        assert found.last.creep is not None
        assert errors[-1] < found.last.creep.time_error < 30.0 * errors[-1]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.2)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.2)


# Layers.


def test_complex_compliance_of_a_coated_body() -> None:
    for row in reference("viscoelasticity/layered_complex_compliance"):
        layer = asp.Viscoelastic.prony(*PRONY[str(row["material_layer"])], float(row["nu1"]))
        body = asp.Layered([asp.Layer(layer, float(row["h"]))], asp.Elastic(float(row["E2"]), float(row["nu2"])))
        found = complex_compliance(body, asp.Rigid(), np.array([row["q"]], float), np.array([row["omega"]], float))[0]
        assert abs(found / complex(float(row["c_real"]), float(row["c_imag"])) - 1.0) < 1e-12


RUBBER = asp.Viscoelastic.standard_linear(1.0, 10.0, 1.0, 0.4)
STIFF = asp.Elastic(20.0, 0.3)
STACKS = {
    "soft coating": (asp.Layered([asp.Layer(RUBBER, 0.1)], STIFF), 1e-3),
    "stiff film": (asp.Layered([asp.Layer(STIFF, 0.05)], RUBBER), 6e-3),
    "rigid base": (asp.Layered([asp.Layer(RUBBER, 0.1), asp.Layer(STIFF, 0.2)], asp.RigidBase()), 4e-3),
}


@pytest.mark.parametrize("name", STACKS)
def test_retarded_compliance_is_that_of_the_complex_moduli(name: str) -> None:
    """The series meets the exact complex compliance at all wavelengths and frequencies within the
    error it states."""
    body, allowed = STACKS[name]
    creep = contact_creep(body, asp.Rigid())
    assert isinstance(creep, LayeredCreep)
    assert creep.error < 2.0 * allowed
    q = np.geomspace(1e-2, 1e3, 30)
    for omega in (0.03, 0.3, 3.0, 30.0):
        weights = 1.0 / (1.0 + 1j * omega * creep.times)
        found = creep.with_terms(weights.real).spectral(q) + 1j * creep.with_terms(weights.imag).spectral(q)
        found -= 1j * creep.instantaneous.spectral(q)
        exact = complex_compliance(body, asp.Rigid(), q, np.full(q.shape, omega))
        assert np.abs(found / exact - 1.0).max() < creep.error + 3e-3


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("name", STACKS)
def test_coated_contact_ends_at_the_relaxed_elastic_one(name: str, boundary: asp.Free | asp.Periodic) -> None:
    """After a load and a hold of 500 relaxation times; on the way the work is stored or turned into
    heat."""
    body = STACKS[name][0]
    soft = asp.Elastic(1.0, 0.4)
    layers = [replace(layer, material=soft if layer.material is RUBBER else layer.material) for layer in body.layers]
    relaxed = asp.Layered(layers, soft if body.base is RUBBER else body.base)
    surface = asp.Surface(sphere(0.5, 32).heights / 5.0, 1.0 / 32)
    course = asp.History(
        [asp.Step(asp.Force(0.01), duration=0.5), *(asp.Step(asp.Force(0.004), duration=t) for t in (0.5, 500.0))]
    )
    found = asp.solve(asp.ContactProblem(surface, body, boundary=boundary), course)
    end = asp.solve(asp.ContactProblem(surface, relaxed, boundary=boundary), asp.Force(0.004))
    assert np.abs(found.last.pressure - end.pressure).max() < 4e-3 * end.max_pressure
    assert found.last.approach == pytest.approx(end.approach, rel=1e-3)
    assert found.last.elastic_energy == pytest.approx(end.elastic_energy, rel=1e-3)
    assert found.energies.relative_error < 0.02


def test_layers_of_one_material_are_that_material() -> None:
    """A stack of layers that relax alike up to 1e-6, fitted wavenumber by wavenumber, against the
    exact shared creep."""
    surface = asp.Surface(sphere(0.5, 32).heights / 5.0, 1.0 / 32)
    course = asp.History([asp.Force(0.01), asp.Step(asp.Force(0.01), duration=2.0)])
    almost = asp.Layered([asp.Layer(RUBBER.with_times(1.0 + 1e-6), 0.2)], RUBBER)
    assert isinstance(contact_creep(almost, asp.Rigid()), LayeredCreep)
    layered, whole = (
        asp.solve(free(surface, body), course, time_steps=asp.TimeSteps(number=8)).last for body in (almost, RUBBER)
    )
    exact = asp.Layered([asp.Layer(RUBBER, 0.2)], RUBBER)
    assert isinstance(contact_creep(exact, asp.Rigid()), SharedCreep)
    assert np.abs(layered.pressure - whole.pressure).max() < 1e-5 * whole.max_pressure
    assert layered.creep is not None
    assert whole.creep is not None
    assert layered.creep.stored_energy == pytest.approx(whole.creep.stored_energy, rel=1e-5)
    assert layered.creep.dissipated == pytest.approx(whole.creep.dissipated, rel=1e-5)


def test_two_bodies_add_their_creep_and_share_equal_terms() -> None:
    other = asp.Viscoelastic.standard_linear(1.0, 10.0, 1.0, 0.2)
    creep = contact_creep(RUBBER, other)
    assert isinstance(creep, SharedCreep)
    assert creep.times.size == 1
    with_elastic = contact_creep(RUBBER, STIFF)
    assert isinstance(with_elastic, SharedCreep)
    total = RUBBER.contact_creep.at(3.0) + 1.0 / STIFF.plane_strain_modulus
    first = RUBBER.contact_creep.at(0.0) + 1.0 / STIFF.plane_strain_modulus
    assert with_elastic.ratio.at(3.0) == pytest.approx(total / first)
    assert contact_creep(STIFF, asp.Rigid()) is None


# Energies, invariance, restart, files.


def rough() -> asp.Surface:
    x = 2.0 * np.pi * (np.arange(32) + 0.5) / 32
    waves = np.cos(x)[:, None] + 0.4 * np.cos(3 * x + 1.0)[:, None] * np.cos(2 * x) + 0.2 * np.sin(5 * x)
    return asp.Surface(1e-7 * waves, 1e-6 / 32)


RUBBERY = asp.Viscoelastic.prony(2e6, ((5e6, 0.1), (9e6, 0.01)), 0.5)
CYCLE = [asp.Step(asp.MeanPressure(p), duration=0.05) for p in (1e6, 0.2e6)]


@pytest.mark.slow
@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
def test_work_of_a_cycle_is_the_heat_of_the_cycle(boundary: asp.Free | asp.Periodic) -> None:
    """In the steady state no energy is left over, and the work of each cycle is what is dissipated
    in it."""
    problem = asp.ContactProblem(rough(), RUBBERY, boundary=boundary)
    found = asp.solve(problem, asp.History([asp.Step(asp.MeanPressure(0.2e6), duration=0.05), *CYCLE * 14]))
    last = [step.creep for step in found.steps[-2:] if step.creep is not None]
    before = found.steps[-3].creep
    assert before is not None
    heat = sum(each.dissipated for each in last)
    assert last[-1].stored_energy == pytest.approx(before.stored_energy, rel=2e-3)
    assert sum(each.work for each in last) == pytest.approx(heat, rel=1e-2)
    assert heat > 0.1 * last[0].work
    assert all(np.diff(step.creep.column("dissipated")).min() >= 0.0 for step in found.steps if step.creep is not None)
    assert found.energies.relative_error < 2e-2


def test_time_and_modulus_only_scale() -> None:
    """Twice the times under twice the durations, and all moduli with all loads, change nothing but
    units."""
    course = [asp.Step(asp.MeanPressure(1e6), duration=0.02), asp.Step(asp.MeanPressure(1e6), duration=0.1)]
    first = asp.solve(asp.ContactProblem(rough(), RUBBERY), asp.History(course)).last
    slow = [replace(step, duration=2.0 * step.duration) for step in course]
    second = asp.solve(asp.ContactProblem(rough(), RUBBERY.with_times(2.0)), asp.History(slow)).last
    assert np.abs(second.pressure - first.pressure).max() < 1e-5 * first.max_pressure
    stiff = asp.Viscoelastic.prony(6e6, ((15e6, 0.1), (27e6, 0.01)), 0.5)
    loads = [replace(step, normal=asp.MeanPressure(3e6)) for step in course]
    third = asp.solve(asp.ContactProblem(rough(), stiff), asp.History(loads)).last
    np.testing.assert_allclose(third.gap, first.gap, atol=1e-5 * float(first.gap.max()))


def test_elastic_bodies_do_not_mind_durations() -> None:
    problem = asp.ContactProblem(rough(), asp.Elastic(2e6, 0.5))
    slow = asp.solve(problem, asp.Step(asp.MeanPressure(1e6), duration=7.0))
    np.testing.assert_array_equal(slow.pressure, asp.solve(problem, asp.MeanPressure(1e6)).pressure)
    at_once = asp.solve(asp.ContactProblem(rough(), RUBBERY), asp.MeanPressure(1e6))
    first = asp.solve(asp.ContactProblem(rough(), RUBBERY.instantaneous), asp.MeanPressure(1e6))
    np.testing.assert_array_equal(at_once.pressure, first.pressure)
    assert at_once.creep is not None
    assert at_once.creep.stored_energy == pytest.approx(first.elastic_energy, rel=1e-9)


@pytest.mark.parametrize("body", [RUBBERY, asp.Layered([asp.Layer(RUBBERY, 2e-7)], asp.Elastic(1e8, 0.3))])
def test_history_stopped_saved_and_continued_is_the_same(body: asp.Elastic | asp.Layered, tmp_path: Path) -> None:
    problem = asp.ContactProblem(rough(), body)
    course = [asp.Step(asp.MeanPressure(1e6)), *CYCLE]
    whole = asp.solve(problem, asp.History(course))
    first = asp.solve(problem, asp.History(course[:2]))
    asp.save(first, tmp_path / "half.nc")
    back = asp.load(tmp_path / "half.nc")
    rest = asp.solve(problem, asp.History(course[2:]), state=back.state)
    np.testing.assert_array_equal(rest.last.pressure, whole.last.pressure)
    assert rest.last.creep is not None
    assert whole.last.creep is not None
    np.testing.assert_array_equal(rest.last.creep.records, whole.last.creep.records)
    for ours, theirs in zip(back.steps, first.steps, strict=True):
        np.testing.assert_array_equal(ours.creep.records, theirs.creep.records)
        np.testing.assert_array_equal(ours.creep.retarded_displacement, theirs.creep.retarded_displacement)
    assert back.energies.viscous_work == pytest.approx(first.energies.viscous_work)
    again = asp.solve(problem, asp.History(course[1:]), state=back.steps[0].state)
    np.testing.assert_array_equal(again.last.pressure, whole.last.pressure)
    assert again.last.creep is not None
    np.testing.assert_array_equal(again.last.creep.records, whole.last.creep.records)


def test_hardness_beside_creep() -> None:
    """It stays the limit while the contact grows."""
    load = asp.MeanPressure(1e6)
    course = asp.History([load, asp.Step(load, duration=0.3)])
    found = asp.solve(asp.ContactProblem(rough(), RUBBERY, law=asp.Hardness(6e6)), course)
    assert found.last.max_pressure <= 6e6 * (1.0 + 1e-9)
    assert found.steps[0].is_plastic
    assert found.last.area_fraction > found.steps[0].area_fraction
    assert found.last.total_plastic_work >= found.steps[0].total_plastic_work


def test_steps_come_one_by_one_and_say_why_they_end_early() -> None:
    problem = asp.ContactProblem(rough(), RUBBERY)
    course = [asp.MeanPressure(1e6), asp.Step(asp.MeanPressure(1e6), duration=1.0)]
    with pytest.raises(asp.ConvergenceError) as caught:
        list(steps(problem, course, time_steps=asp.TimeSteps(tolerance=1e-4, most=14)))
    assert "steps of time" in str(caught.value)
    unloaded = asp.solve(problem, asp.History([*course, asp.Step(asp.Unloaded(), duration=0.1)])).last
    assert unloaded.force == 0.0
    assert unloaded.approach > 0.0
    recovered = asp.solve(problem, asp.Step(asp.Unloaded(), duration=50.0), state=unloaded.state)
    assert abs(recovered.approach) < 1e-6 * unloaded.approach


def test_weights_of_short_and_long_steps_are_smooth() -> None:
    """Series and closed forms meet; a constant pressure is kept exactly; weights of e, before and
    after add up to one."""
    times = np.array([1.0, np.inf])
    for length in (0.0, 1e-9, 0.0199999, 0.0200001, 1.0, 1e3):
        found = TimeWeights.of(times, length)
        assert found.e[0] + found.before[0] + found.after[0] == pytest.approx(1.0, abs=1e-13)
        assert found.before[1] + found.after[1] == length
        assert found.of_curvature.min() >= 0.0
    below, above = (TimeWeights.of(times, length) for length in (0.02 * (1 - 1e-9), 0.02 * (1 + 1e-9)))
    np.testing.assert_allclose(below.after, above.after, rtol=1e-8)
    np.testing.assert_allclose(below.before, above.before, rtol=1e-8)


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: asp.Step(asp.MeanPressure(1.0), duration=-1.0), "duration of a step (s)"),
        (lambda: asp.TimeSteps(tolerance=2.0), "tolerance of the steps of time"),
        (lambda: asp.TimeSteps(number=0), "number of steps of time"),
    ],
)
def test_what_is_refused(make: Callable[[], object], subject: str) -> None:
    with refused(asp.InputError, subject):
        make()


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("name", STACKS)
def test_harmonic_stiffness_of_a_coated_contact(name: str, boundary: asp.Free | asp.Periodic) -> None:
    """At high and low frequency the stiffness of the same area with instantaneous and relaxed
    moduli, between them a loss."""
    body = STACKS[name][0]
    soft = asp.Elastic(1.0, 0.4)
    layers = [replace(layer, material=soft if layer.material is RUBBER else layer.material) for layer in body.layers]
    relaxed = asp.Layered(layers, soft if body.base is RUBBER else body.base)
    surface = asp.Surface(sphere(0.5, 24).heights / 5.0, 1.0 / 24)
    problem = asp.ContactProblem(surface, body, boundary=boundary)
    found = asp.solve(problem, asp.Force(0.01))
    fast, slow, middle = (asp.viscoelasticity.harmonic(found, f) for f in (1e5, 1e-7, 0.1))
    assert fast.stiffness.real == pytest.approx(found.normal_stiffness, rel=1e-3)
    operator = asp.solvers.prepare_operator(asp.ContactProblem(surface, relaxed).compliance, problem.grid, boundary)
    assert slow.stiffness.real == pytest.approx(normal_stiffness(operator, found.contact), rel=2e-3)
    assert slow.stiffness.real < middle.stiffness.real < fast.stiffness.real
    assert middle.loss_tangent > 0.02 > fast.loss_tangent


def test_harmonic_stiffness_of_a_half_space_is_the_complex_modulus() -> None:
    found = asp.solve(free(sphere(0.3, 24), solid("prony3")), asp.Force(0.02))
    response = asp.viscoelasticity.harmonic(found, 0.2)
    modulus = solid("prony3").complex_modulus(2.0 * np.pi * 0.2)
    assert response.stiffness == pytest.approx(found.normal_stiffness * modulus / 28.0, rel=1e-9)
    assert response.heat(1e-3) == pytest.approx(np.pi * response.stiffness.imag * 1e-6 * 0.36, rel=1e-9)
    with refused(asp.InputError, "contact that oscillates"):
        asp.viscoelasticity.harmonic(asp.solve(free(sphere(0.3, 24), asp.Elastic(1.0, 0.3)), asp.Force(0.02)), 1.0)


def test_stresses_only_where_they_do_not_depend_on_the_past() -> None:
    course = asp.History([asp.MeanPressure(1e6), asp.Step(asp.MeanPressure(1e6), duration=0.1)])
    whole = asp.solve(asp.ContactProblem(rough(), RUBBERY), course).last
    assert asp.stress(whole, [1e-7]).von_mises.max() > 0.0
    coated = asp.Layered([asp.Layer(RUBBERY, 2e-7)], asp.Elastic(1e8, 0.3))
    first, last = asp.solve(asp.ContactProblem(rough(), coated), course).steps
    for asked in (lambda found: asp.stress(found, [1e-7]), lambda found: survey(StressRequest(), found)):
        with refused(asp.InputError, "moduli of a viscoelastic body in which stresses are asked"):
            asked(last)
    elastic = replace(coated, layers=[asp.Layer(asp.Elastic(16e6, 0.5), 2e-7)])
    at_once = asp.solve(asp.ContactProblem(rough(), elastic), asp.MeanPressure(1e6))
    wanted = asp.stress(at_once, [1e-7]).von_mises
    np.testing.assert_allclose(asp.stress(first, [1e-7]).von_mises, wanted, atol=1e-4 * float(wanted.max()))
    with refused(asp.InputError, "displacement inside a body"):
        asp.stress(whole, [1e-7], displacement=True)


def test_a_duration_that_is_lost_in_rounding_is_refused() -> None:
    """After 10²⁴ s a millisecond adds nothing to the time."""
    grid = asp.Grid((8, 8), (1e-6, 1e-6))
    ball = asp.generate.sphere(grid, radius=1e-5)
    rubber = asp.Viscoelastic.standard_linear(1e6, 1e7, 1e-2, 0.4)
    problem = asp.ContactProblem(ball, rubber, boundary=asp.Free())
    course = asp.History([asp.Step(asp.Force(1e-8), duration=1e24), asp.Step(asp.Force(2e-8), duration=1e-3)])
    with refused(asp.InputError, "duration of a step (s)", "0.001"):
        asp.solve(problem, course)
