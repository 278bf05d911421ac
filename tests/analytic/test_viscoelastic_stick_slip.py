"""Stick and slip of viscoelastic bodies: elastic limits, relaxation under full stick, Cattaneo and
Mindlin, energies, operators, restart."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from sheared_loop import LOAD, MU, left_of_a_loop, sphere

import asperity as asp
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.viscoelastic.coupling import TimeWeights
from asperity.physics.viscoelastic.shear import ShearMemory
from asperity.solids.compliance.creep import SharedCreep, contact_creep

SOLID = asp.Viscoelastic.standard_linear(1.0, 4.0, 1.0, 0.3)


def sheared(shift: float, duration: float) -> list[asp.Step]:
    """Pressed at once, or slowly, and moved there and half-way back."""
    pressed = asp.Step(LOAD, asp.Shift(), duration=duration)
    return [pressed, *(asp.Step(LOAD, asp.Shift(to), duration=duration) for to in (shift, 0.5 * shift))]


def forces(found: asp.HistoryResult) -> np.ndarray:
    return np.array([step.require_stick_slip().force_x for step in found.steps])


def test_a_solid_that_hardly_relaxes_is_elastic() -> None:
    """With a relaxation of 1e-6 of the modulus a history of shear is that of the elastic body,
    through the same steps."""
    nearly = asp.Viscoelastic.standard_linear(1.0, 1.0 + 1e-6, 1.0, 0.3)
    number = 4
    found = asp.solve(sphere(nearly), asp.History(sheared(0.02, 1.0)), time_steps=asp.TimeSteps(number=number))
    shares = np.arange(1, number + 1) / number
    pressed = [asp.Step(asp.Force(share * LOAD.value), asp.Shift()) for share in shares]
    there = [asp.Step(LOAD, asp.Shift(0.02 * share)) for share in shares]
    back = [asp.Step(LOAD, asp.Shift(0.02 - 0.01 * share)) for share in shares]
    elastic = asp.solve(sphere(asp.Elastic(1.0, 0.3)), asp.History([*pressed, *there, *back]))
    at = elastic.steps[number - 1 :: number]
    for one, other in zip(found.steps, at, strict=True):
        np.testing.assert_allclose(one.pressure, other.pressure, atol=2e-5 * other.max_pressure)
        shear = other.require_stick_slip()
        scale = shear.friction_limit / (other.contact_area or 1.0)
        np.testing.assert_allclose(one.require_stick_slip().traction, shear.traction, atol=2e-4 * scale)
    dissipated = sum(step.require_stick_slip().dissipated for step in elastic.steps)
    assert found.last.require_stick_slip().total_dissipated == pytest.approx(dissipated, rel=1e-3)


@pytest.mark.parametrize(("duration", "modulus"), [(1e-7, 4.0), (1e6, 1.0)])
def test_fast_and_slow_shear_are_elastic(duration: float, modulus: float) -> None:
    """Steps far shorter than the relaxation time see the modulus of the first instant, far longer
    ones the relaxed one."""
    elastic = asp.solve(sphere(asp.Elastic(modulus, 0.3)), asp.History(_divided(sheared(0.02, 0.0), 8)))
    found = asp.solve(sphere(SOLID), asp.History(sheared(0.02, duration)), time_steps=asp.TimeSteps(number=8))
    np.testing.assert_allclose(forces(found), forces(elastic)[7::8], atol=1e-4 * MU * LOAD.value)


def _divided(steps: list[asp.Step], number: int) -> list[asp.Step]:
    """Elastic steps through ramps of force and shift."""
    made, force, shift = [], 0.0, 0.0
    for step in steps:
        assert isinstance(step.normal, asp.Force)
        assert isinstance(step.tangential, asp.Shift)
        for share in np.arange(1, number + 1) / number:
            normal = asp.Force(force + share * (step.normal.value - force))
            made.append(asp.Step(normal, asp.Shift(shift + share * (step.tangential.x - shift))))
        force, shift = step.normal.value, step.tangential.x
    return made


def test_force_of_a_shift_held_relaxes_with_the_modulus() -> None:
    """Full stick at a fixed position of an incompressible solid: Q(t)/Q(0) = E(t)/E(0)."""
    solid = asp.Viscoelastic.prony(1.0, ((2.0, 0.3), (1.0, 3.0)), 0.5)
    place, shift, times = asp.Approach(0.02), asp.Shift(1e-3), (0.2, 0.8, 4.0)
    held = [asp.Step(place, shift, duration=time) for time in times]
    history = asp.History([asp.Step(place, asp.Shift()), asp.Step(place, shift), *held])
    found = asp.solve(sphere(solid, friction=asp.friction.FullStick()), history, time_steps=asp.TimeSteps(2e-5))
    wanted = solid.relaxation.at(np.concatenate([[0.0], np.cumsum(times)])) / 4.0
    np.testing.assert_allclose(forces(found)[1:] / forces(found)[1], wanted, rtol=2e-3)


def test_cattaneo_and_mindlin_after_long_times() -> None:
    """Shift under a slow tangential force as of the relaxed sphere, three times as far as at once;
    incompressible, so without coupling."""
    solid = asp.Viscoelastic.standard_linear(1.0, 3.0, 1.0, 0.5)
    radius, share = 10.0, 0.6
    for modulus, duration in ((1.0, 1e5), (3.0, 1e-7)):
        force = asp.TangentialForce(share * MU * LOAD.value)
        steps = [asp.Step(LOAD, asp.TangentialForce(), duration=duration), asp.Step(LOAD, force, duration=duration)]
        found = asp.solve(sphere(solid, 48), asp.History(steps), time_steps=asp.TimeSteps(number=4))
        contact_modulus, shear_modulus = modulus / 0.75, modulus / 3.0
        a = (0.75 * LOAD.value * radius / contact_modulus) ** (1.0 / 3.0)
        whole = 3.0 * MU * LOAD.value * 1.5 / (16.0 * a * shear_modulus)
        wanted = whole * (1.0 - (1.0 - share) ** (2.0 / 3.0))
        assert found.last.require_stick_slip().shift_x == pytest.approx(wanted, rel=0.02)


@pytest.mark.parametrize("bulk", [False, True])
def test_work_is_stored_or_heat_of_slip_or_of_the_solid(bulk: bool) -> None:
    """The balance of a loop with coupling between shear and pressure closes as the steps of time
    get shorter."""
    solid = asp.Viscoelastic.standard_linear(1.0, 4.0, 1.0, 0.3, elastic_bulk=bulk)
    left, whole = left_of_a_loop(sphere(solid), 0.005)
    assert left[1] < 1e-3 * whole
    assert left[1] < 0.3 * left[0]


RUBBER = asp.Viscoelastic.prony(3.0, ((1.0, 0.5), (2.0, 5.0)), 0.4)
VOLUME = asp.Viscoelastic.prony(1.0, ((3.0, 0.7),), 0.35, elastic_bulk=True)
STEEL = asp.Elastic(20.0, 0.3)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("pair", [(RUBBER, STEEL), (STEEL, VOLUME), (RUBBER, VOLUME), (VOLUME, asp.Rigid())])
def test_operators_of_the_first_instant_and_of_long_times(
    pair: tuple[asp.Elastic, asp.Elastic], boundary: asp.Free | asp.Periodic
) -> None:
    """The parts add up to the elastic bodies that both solids are at once and after all relaxation,
    coupling included."""
    problem = sphere(pair[0], 12, counter_body=pair[1], boundary=boundary)
    creep = contact_creep(*pair)
    assert isinstance(creep, SharedCreep)
    memory = ShearMemory.prepared(problem, creep, 1)
    rng = np.random.default_rng(1)
    q, p = rng.normal(size=(2, 12, 12)), rng.normal(size=(12, 12))
    for duration, bodies in ((0.0, [_elastic(x, 0.0) for x in pair]), (1e12, [_elastic(x, 1.0) for x in pair])):
        found = memory.operator(TimeWeights.of(memory.times, duration))
        wanted = TangentialOperator(problem.grid, (bodies[0], bodies[1]), boundary)
        for name, load in (("displacement", q), ("drawn", p), ("lift", q)):
            right = getattr(wanted, name)(load)
            np.testing.assert_allclose(getattr(found, name)(load), right, atol=1e-9 * np.abs(right).max())


def _elastic(solid: asp.Elastic, relaxed: float) -> asp.Elastic:
    """What ``solid`` is at the first instant (0) or after all relaxation (1)."""
    if not isinstance(solid, asp.Viscoelastic):
        return solid
    if not relaxed:
        return solid.instantaneous
    G, nu = solid.shear_modulus * solid.relaxed_share, solid.poisson_ratio
    if solid.elastic_bulk:
        K = solid.bulk_modulus
        nu = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G))
    return asp.Elastic(2.0 * G * (1.0 + nu), nu)


@pytest.mark.slow
def test_sheared_history_goes_on_to_the_bit(tmp_path: Path) -> None:
    """From a file too, and from a step in the middle; slip and heat of a step are those of all its
    steps of time."""
    problem, steps = sphere(SOLID, 16), sheared(0.01, 0.5)
    whole = asp.solve(problem, asp.History(steps), time_steps=asp.TimeSteps(number=3))
    asp.save(whole, tmp_path / "h.nc")
    again = asp.load(tmp_path / "h.nc")
    for state in (whole.steps[1].state, again.steps[1].state):
        rest = asp.solve(problem, steps[2], state=state, time_steps=asp.TimeSteps(number=3))
        np.testing.assert_array_equal(rest.pressure, whole.last.pressure)
        for name in ("traction", "slip", "slip_increment", "tangential_displacement"):
            one, other = (getattr(found.require_stick_slip(), name) for found in (rest, whole.last))
            np.testing.assert_array_equal(one, other)
        assert rest.creep.dissipated == whole.last.creep.dissipated
    assert again.energies.relative_error == whole.energies.relative_error
    slips = [step.require_stick_slip() for step in whole.steps]
    np.testing.assert_allclose(slips[2].slip - slips[1].slip, slips[2].slip_increment, atol=1e-15)
    assert slips[2].total_dissipated - slips[1].total_dissipated == pytest.approx(slips[2].dissipated, rel=1e-9)


def test_layers_that_relax_alike_stick_and_slip() -> None:
    """A stack of one viscoelastic material is the half-space of it."""
    stack = asp.Layered([asp.Layer(SOLID, 0.3)], SOLID)
    steps = asp.History(sheared(0.01, 0.5))
    found, wanted = (asp.solve(sphere(body, 16), steps, time_steps=asp.TimeSteps(number=3)) for body in (stack, SOLID))
    np.testing.assert_allclose(forces(found), forces(wanted), rtol=1e-3, atol=1e-6 * LOAD.value)
