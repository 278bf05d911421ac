"""Viscoelastic contacts through holds of any length: relaxed and glassy limits, the law of a fixed
contact, and energies that balance or are said not to."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.parts.advice import review
from asperity.physics.viscoelastic.energy import LARGEST_MISS
from asperity.solids.layers import Body

RELAXED, FIRST, MILDLY, TIME = 3e6, 300e6, 12e6, 1e-3
STANDARD = asp.Viscoelastic.standard_linear(RELAXED, FIRST, TIME, 0.5)
"""Solid whose modulus falls to a hundredth: retarded by 100 ms."""

MILD = asp.Viscoelastic.standard_linear(RELAXED, MILDLY, TIME, 0.5)
DEPTH = asp.Approach(0.3e-6)


def ball(points: int = 24, radius: float = 20e-6) -> asp.Surface:
    """Paraboloid, whose tip lies between four pixels."""
    x = (np.arange(points) - 0.5 * (points - 1)) * 12.8e-6 / points
    return asp.Surface(-(x[:, None] ** 2 + x**2) / (2.0 * radius), 12.8e-6 / points)


def problem(body: Body, boundary: asp.contact.Boundary = asp.Free(), **more: object) -> asp.ContactProblem:
    return asp.ContactProblem(ball(), body, boundary=boundary, **more)  # type: ignore[arg-type]


def held(control: asp.contact.Control, *durations: float) -> asp.History:
    """Pressed at once, and held."""
    return asp.History([control, *(asp.Step(control, duration=duration) for duration in durations)])


def coated(material: asp.Elastic) -> asp.Layered:
    return asp.Layered([asp.Layer(material, 1e-6)], asp.Elastic(1e9, 0.3))


# Relaxation at a held position.


@pytest.mark.parametrize("seed", range(12))
def test_force_at_a_fixed_contact_falls_as_the_modulus(seed: int) -> None:
    """F(t) = F(0) E(t)/E(0) for a step of approach (Lee & Radok 1960), exact on the grid as the
    contact stays, after holds of 0.1 to 1000 relaxation times."""
    random = np.random.default_rng(seed)
    ratio, tau = 10.0 ** random.uniform(0.1, 2.5), 10.0 ** random.uniform(-4.0, 3.0)
    solid = asp.Viscoelastic.standard_linear(RELAXED, RELAXED * ratio, tau, 0.5)
    duration = tau * 10.0 ** random.uniform(-1.0, 3.0)
    found = asp.solve(problem(solid), held(asp.Approach(10.0 ** random.uniform(-7.5, -6.2)), duration))
    relaxation = solid.relaxation
    expected = found.steps[0].force * float(relaxation.at(duration)) / relaxation.instantaneous
    creep = found.last.creep
    assert creep is not None
    assert found.last.force == pytest.approx(expected, rel=1e-6 + 2.0 * creep.time_error)
    np.testing.assert_array_equal(found.last.contact, found.steps[0].contact)
    assert found.energies.relative_error < 5e-3
    assert found.converged


@pytest.mark.parametrize("duration", [60e-3, 79e-3, 158e-3, 10.0])
def test_force_of_a_long_hold_is_that_of_the_relaxed_body(duration: float) -> None:
    elastic = asp.solve(problem(asp.Elastic(RELAXED, 0.5)), DEPTH)
    found = asp.solve(problem(STANDARD), held(DEPTH, duration))
    assert found.last.force == pytest.approx(elastic.force, rel=1e-5)
    np.testing.assert_allclose(found.last.pressure, elastic.pressure, atol=1e-4 * elastic.max_pressure)


@pytest.mark.parametrize("control", [DEPTH, asp.MeanGap(4e-7)])
@pytest.mark.parametrize("coating", [False, True])
def test_long_hold_of_layers_and_at_a_mean_gap(control: asp.contact.Control, coating: bool) -> None:
    """The relaxed contact, within the error of the series of a coating (1e-3)."""
    boundary = asp.Periodic() if isinstance(control, asp.MeanGap) else asp.Free()
    bodies = STANDARD, asp.Elastic(RELAXED, 0.5)
    viscous, elastic = (problem(coated(body) if coating else body, boundary) for body in bodies)
    found, end = asp.solve(viscous, held(control, 0.2)), asp.solve(elastic, control)
    assert found.last.force == pytest.approx(end.force, rel=1e-3)
    assert found.energies.relative_error < 5e-3


def test_sheared_contact_held_in_place_relaxes() -> None:
    """Where surfaces stick, force and tangential force of a position held go to those of the
    relaxed body."""
    place = asp.Step(DEPTH, asp.Shift(20e-9))
    both = [problem(body, friction=asp.friction.FullStick()) for body in (STANDARD, asp.Elastic(RELAXED, 0.5))]
    found = asp.solve(both[0], asp.History([place, replace(place, duration=0.2)]))
    end = asp.solve(both[1], place)
    assert found.last.force == pytest.approx(end.force, rel=1e-4)
    assert found.last.require_stick_slip().force_x == pytest.approx(end.require_stick_slip().force_x, rel=1e-4)
    assert found.energies.relative_error < 5e-3


def test_sheared_coating_held_in_place_stays_in_touch() -> None:
    """Points that touch later stick elsewhere than in the relaxed contact: the same forces for
    other lengths of the steps, and energies that balance."""
    place = asp.Step(DEPTH, asp.Shift(20e-9))
    course = asp.History([place, replace(place, duration=0.2)])
    sheared = problem(coated(STANDARD), friction=asp.friction.FullStick())
    coarse, fine = (asp.solve(sheared, course, time_steps=asp.TimeSteps(each)) for each in (1e-2, 1e-3))
    creep = coarse.last.creep
    assert creep is not None
    assert coarse.last.force == pytest.approx(fine.last.force, rel=2.0 * creep.time_error)
    assert fine.last.force > 0.0
    assert fine.energies.relative_error < 5e-3


def test_wet_contact_held_in_place_relaxes() -> None:
    """Tries that part the surfaces look for menisci in the gap; the end is the wet contact of the
    relaxed body."""
    film = asp.LiquidFilm(surface_tension=0.03, thickness=3e-8)
    found = asp.solve(problem(STANDARD, film=film), held(DEPTH, 60e-3))
    end = asp.solve(problem(asp.Elastic(RELAXED, 0.5), film=film), DEPTH)
    assert found.last.force == pytest.approx(end.force, rel=1e-5)
    assert found.last.external_force == pytest.approx(end.external_force, rel=1e-3)
    assert found.energies.relative_error < 5e-3
    parted = asp.solve(problem(STANDARD, film=film), asp.Step(asp.Approach(1e-9), duration=TIME), state=found.state)
    assert parted.force == 0.0
    assert parted.require_menisci().meniscus_force == 0.0  # the dent is deeper than the film


def test_contact_that_is_lost_in_truth_ends() -> None:
    """Withdrawn to first touch in a relaxation time surfaces part; a long hold afterwards costs no
    more steps of time."""
    course = [DEPTH, asp.Step(DEPTH, duration=50e-3), asp.Step(asp.Approach(1e-9), duration=TIME)]
    found = asp.solve(problem(STANDARD), asp.History([*course, asp.Step(asp.Approach(1e-9), duration=1.0)]))
    parted, later = found.steps[2:]
    assert parted.force == 0.0
    assert parted.creep is not None
    assert parted.creep.tries < 200
    assert later.creep is not None
    assert later.creep.tries < 200
    assert later.force == pytest.approx(
        asp.solve(problem(asp.Elastic(RELAXED, 0.5)), asp.Approach(1e-9)).force, rel=0.02
    )
    assert found.energies.relative_error < LARGEST_MISS


# Energies.


def test_energies_that_miss_are_not_converged(tmp_path: Path) -> None:
    """Equal steps that part the surfaces lose more energy than there was; status, advice and files
    say so."""
    settings = asp.TimeSteps(number=16)
    with refused(asp.ConvergenceError, "Step 2 of the history"):
        asp.solve(problem(STANDARD), held(DEPTH, 60e-3), time_steps=settings)
    found = asp.solve(problem(STANDARD), held(DEPTH, 60e-3), time_steps=settings, on_failure="return")
    assert not found.converged
    assert found.last.status.remedy
    assert "energy balance" in {finding.criterion for finding in review(found.last)}
    creep = found.last.creep
    assert creep is not None
    assert creep.energy_error == pytest.approx(found.energies.relative_error, rel=1e-9)
    asp.save(found, tmp_path / "h.nc")
    again = asp.load(tmp_path / "h.nc")
    assert not again.converged
    assert again.last.creep.missed == creep.missed
    assert "energy balance" in {finding.criterion for finding in review(again.last)}


def test_a_lone_step_is_checked_from_its_state(tmp_path: Path) -> None:
    """The account of energies is part of the state, also of one from a file; of a state without it
    energies are counted from there."""
    first = asp.solve(problem(STANDARD), DEPTH)
    asp.save(first, tmp_path / "r.nc")
    hold, settings = asp.Step(DEPTH, duration=60e-3), asp.TimeSteps(number=16)
    unknown = {name: value for name, value in first.state.memory["creep"].items() if name != "account"}
    blind = replace(first.state, memory={**first.state.memory, "creep": unknown})
    for state, known in ((first.state, True), (asp.load(tmp_path / "r.nc").state, True), (blind, False)):
        found = asp.solve(problem(STANDARD), hold, state=state, time_steps=settings, on_failure="return")
        assert found.converged is not known
    fine = asp.solve(problem(STANDARD), hold, state=first.state)
    assert fine.converged
    assert not [finding for finding in review(fine) if finding.criterion == "energy balance"]


@pytest.mark.parametrize("body", [STANDARD, coated(STANDARD)])
def test_work_of_a_step_at_once_is_what_is_stored(body: Body) -> None:
    """No error of a rule: ∫F dδ = 2/5 F δ of Hertz within the pixels of a half-space, and further
    steps at once take or give the change."""
    found = asp.solve(problem(body), asp.History([DEPTH, asp.Approach(0.1e-6), asp.Approach(0.2e-6)]))
    energies = found.energies
    np.testing.assert_allclose(energies.external_work, found.elastic_energy, rtol=1e-12)
    assert energies.relative_error < 1e-12
    if body is STANDARD:
        pixels = np.sqrt(20e-6 * found.approach) / found.last.problem.grid.spacing[0]  # in the radius of contact
        ratio = energies.external_work / (0.4 * found.force * found.approach)
        assert (np.abs(ratio - 1.0) < 0.5 / pixels**2).all()


def test_work_of_a_step_at_once_beside_hardness() -> None:
    """Plastic work is part of it: many small steps at once do the same work by the trapezoidal rule
    of the elastic path."""
    law = {"law": asp.Hardness(20e6)}
    at_once = asp.solve(problem(STANDARD, **law), asp.History([DEPTH]))
    assert at_once.plastic_work[0] > 0.01 * at_once.elastic_energy[0]
    assert at_once.energies.relative_error < 1e-12
    instantaneous = asp.Elastic(FIRST, 0.5)
    small = asp.History([asp.Approach(value) for value in np.linspace(0.0, DEPTH.value, 61)[1:]])
    elastic = asp.solve(problem(instantaneous, **law), small).energies
    assert at_once.energies.external_work[0] == pytest.approx(elastic.external_work[-1], rel=2e-3)


@pytest.mark.parametrize("duration", [0.1, 10.0, 1e3, 1e5])
def test_heat_of_a_long_hold_under_a_load(duration: float) -> None:
    """Work F (δ2 - δ1) less the change of the stored energy, those of the elastic contacts of the
    first and the relaxed modulus; the first step of time of a hold of 10⁴ times and more ended at
    the right place with a fifth too much heat."""
    load = asp.Force(2e-6)
    first, last = (asp.solve(problem(asp.Elastic(E, 0.5)), load) for E in (MILDLY, RELAXED))
    found = asp.solve(problem(MILD), held(load, duration)).last
    expected = load.value * (last.approach - first.approach) - (last.elastic_energy - first.elastic_energy)
    creep = found.creep
    assert creep is not None
    assert creep.dissipated == pytest.approx(expected, rel=2e-3)
    assert creep.energy_error < 1e-3
    assert creep.tries < 60


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
def test_energies_of_sliding_surfaces_that_creep(boundary: asp.contact.Boundary) -> None:
    """The work of the displacement by shear is that of pressures linear in time: energies balance
    over long and short holds."""
    solid = asp.Viscoelastic.standard_linear(RELAXED, 4.0 * RELAXED, TIME, 0.2)
    sliding = problem(solid, boundary, friction=asp.Coulomb(0.8))
    found = asp.solve(sliding, held(asp.Force(5e-6), 2e-3, 10.0))
    assert np.abs(found.energies.shear_work).max() > 1e-3 * found.energies.external_work.max()
    assert found.energies.relative_error < 2e-3
    assert found.last.creep is not None
    assert found.last.creep.energy_error == pytest.approx(found.energies.relative_error, abs=1e-4)


def test_history_of_a_dented_surface_begins_at_its_touch() -> None:
    """Ramp from the touch of a surface that another contact has dented: work from there, and
    energies that balance."""
    law = {"law": asp.Hardness(20e6)}
    dented = asp.solve(problem(asp.Elastic(FIRST, 0.5), **law), asp.History([DEPTH, asp.Unloaded()])).state
    assert dented is not None
    state = asp.solvers.InterfaceState.dented(dented.permanent_indentation, np.zeros((24, 24)), dented.plastic_work)
    found = asp.solve(problem(STANDARD, **law), asp.History([asp.Step(DEPTH, duration=TIME)]), state=state)
    creep = found.last.creep
    assert creep is not None
    top = ball().heights.max()
    assert creep.column("approach")[0] == pytest.approx(top - (ball().heights - dented.permanent_indentation).max())
    assert found.energies.relative_error < 0.01


def test_state_after_sliding_in_time_goes_on_with_a_new_account() -> None:
    """The work of a surface that moves is not that of the force over the approach; what follows is
    counted from its end."""
    wave = asp.Surface(1e-7 * np.cos(2.0 * np.pi * np.arange(24) / 24)[:, None] * np.ones(4), 1e-6, periodic=True)
    moving = asp.ContactProblem(wave, asp.Rigid(), counter_body=MILD)
    moved = asp.viscoelasticity.slide_in_time(moving, asp.MeanPressure(1e4), 1e-3, 12e-6)
    after = asp.solve(moved.last.problem, asp.Step(asp.MeanPressure(1e4), duration=1.0), state=moved.last.state)
    assert after.converged
    assert after.creep is not None
    assert after.creep.energy_error < 0.01
