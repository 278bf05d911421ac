"""Stick, slip and sliding of viscoelastic layers that relax differently: passive series, exact
waves, elastic limits, energies, restart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused
from sheared_loop import LOAD, MU, left_of_a_loop, sphere

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.core.arrays import ComplexArray, RealArray
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.viscoelastic.coupling import LayeredPast, TimeWeights
from asperity.physics.viscoelastic.layered_shear import LayeredShear
from asperity.solids.compliance.creep import LayeredCreep, contact_creep
from asperity.solids.compliance.layered import PlaneCompliance, operational_plane
from asperity.solids.compliance.retardation_fit import responses
from asperity.solids.compliance.tensor import summed_planes
from asperity.solids.layers import Body

RUBBER = asp.Viscoelastic.standard_linear(1.0, 4.0, 1.0, 0.3)
VOLUME = asp.Viscoelastic.prony(1.0, ((3.0, 0.7),), 0.35, elastic_bulk=True)
STEEL = asp.Elastic(20.0, 0.3)
COATED = asp.Layered([asp.Layer(RUBBER, 0.3)], STEEL)
FILM = asp.Layered([asp.Layer(STEEL, 0.05)], VOLUME)
PAD = asp.Layered([asp.Layer(RUBBER, 0.1), asp.Layer(VOLUME, 0.2)], asp.RigidBase())
PAIRS: tuple[tuple[Body, Body], ...] = (
    (COATED, asp.Rigid()),
    (asp.Rigid(), FILM),
    (PAD, asp.Rigid()),
    (COATED, VOLUME),
)


def as_elastic(body: Body, relaxed: float) -> Body:
    """What ``body`` is at the first instant (0) or after all relaxation (1)."""
    if isinstance(body, asp.Layered):
        layers = [replace(layer, material=as_elastic(layer.material, relaxed)) for layer in body.layers]  # type: ignore[arg-type]
        return asp.Layered(layers, as_elastic(body.base, relaxed) if isinstance(body.base, asp.Elastic) else body.base)  # type: ignore[arg-type]
    if not isinstance(body, asp.Viscoelastic):
        return body
    G, nu = body.shear_modulus, body.poisson_ratio
    if relaxed:
        G *= body.relaxed_share
        K = body.bulk_modulus
        nu = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G)) if body.elastic_bulk else nu
    return asp.Elastic(2.0 * G * (1.0 + nu), nu)


def of_waves(pair: tuple[Body, Body], q: RealArray, omega: float) -> PlaneCompliance:
    stacks = [
        (each if isinstance(each, asp.Layered) else asp.Layered([], each), sign)
        for each, sign in zip(pair, (1.0, -1.0), strict=True)
        if not isinstance(each, asp.Rigid)
    ]  # type: ignore[arg-type]
    return summed_planes([(operational_plane(stack, q, 1j * omega), sign) for stack, sign in stacks])


# The series.


@pytest.mark.slow
@pytest.mark.parametrize("pair", PAIRS)
def test_series_of_all_directions_is_passive_and_near_the_complex_compliance(pair: tuple[Body, Body]) -> None:
    """At all wavelengths and frequencies within the error that it states; each term is positive
    semi-definite."""
    creep = contact_creep(*pair, shear=True)
    assert isinstance(creep, LayeredCreep)
    assert creep.shear is not None
    assert creep.error < 0.01
    planes = creep.shear.planes
    assert min(planes.LL.min(), planes.zz.min(), planes.T.min()) >= 0.0
    assert (planes.Lz**2 <= planes.LL * planes.zz * (1.0 + 1e-12) + 1e-30).all()
    np.testing.assert_array_equal(planes.zz, creep.strengths)
    omega = np.array([0.03, 0.3, 3.0, 30.0])
    columns, nodes = responses(creep.times, omega), creep.nodes
    for row, w in zip(columns, omega, strict=True):
        exact, first = of_waves(pair, nodes, w), of_waves(pair, nodes, 1e30)
        for name in ("LL", "zz", "Lz", "T"):
            value = getattr(first, name) + row @ getattr(planes, name) / nodes
            scale = np.sqrt(np.abs(exact.LL * exact.zz)) if name == "Lz" else np.abs(getattr(exact, name))
            assert (np.abs(value - getattr(exact, name)) / scale).max() < creep.error + 3e-3


def memory_of(problem: asp.ContactProblem) -> LayeredShear:
    creep = contact_creep(problem.body, problem.counter_body, shear=True)
    assert isinstance(creep, LayeredCreep)
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    return LayeredShear.prepared(problem, LayeredPast.prepared(creep, operator), 1)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("pair", PAIRS)
def test_operators_of_the_first_instant_and_of_long_times(
    pair: tuple[Body, Body], boundary: asp.contact.Boundary
) -> None:
    """Those of the elastic bodies that both are at once and after all relaxation, coupling
    included, and on coarser grids."""
    memory = memory_of(sphere(pair[0], 12, counter_body=pair[1], boundary=boundary))
    rng = np.random.default_rng(1)
    error = memory.kept.creep.error
    for duration, relaxed, allowed in ((0.0, 0.0, 1e-12), (1e9, 1.0, error)):
        found = memory.operator(TimeWeights.of(memory.kept.times, duration))
        bodies = as_elastic(pair[0], relaxed), as_elastic(pair[1], relaxed)
        wanted = TangentialOperator(found.grid, bodies, boundary)
        for ours, theirs in ((found, wanted), (found.coarsened, wanted.coarsened)):
            q, p = rng.normal(size=(2, *ours.grid.shape)), rng.normal(size=ours.grid.shape)
            scale = np.abs(theirs.displacement(q)).max()
            for name, load in (("displacement", q), ("drawn", p), ("lift", q)):
                np.testing.assert_allclose(getattr(ours, name)(load), getattr(theirs, name)(load), atol=allowed * scale)


# A wave of shear and pressure.


def wave_compliance(k: float, stack: asp.Layered, s: complex) -> ComplexArray:
    """Displacements (u_x/i, u_z) by tractions (q_x/i, p) exp(ikx) on one layer on a base at ``s``
    (1/s), from Navier's equations.

    Solutions u_x = i (A + B z) exp(m k z), u_z = (m A - (3 - 4 nu) B/k + m B z) exp(m k z) with m =
    1, -1: two in a half-space, four in a layer; tractions on the surface are given, displacements
    and stresses are continuous below.
    """
    (layer,) = stack.layers

    def fields(solid: asp.Elastic, m: float, z: float) -> ComplexArray:
        """Rows u_x/i, u_z, -s_xz/i, -s_zz for A and B."""
        G, nu = (
            solid.operational(s) if isinstance(solid, asp.Viscoelastic) else (solid.shear_modulus, solid.poisson_ratio)
        )
        A, B = np.array([1.0, 0.0], complex), np.array([0.0, 1.0], complex)
        kappa = 3.0 - 4.0 * nu
        u, du = A + B * z, B + m * k * (A + B * z)
        w = m * A - kappa * B / k + m * B * z
        dw = m * B + m * k * w
        return np.stack([u, w, -G * (du + k * w), -(-4.0 * G * nu * m * B + 2.0 * G * dw)]) * np.exp(m * k * z)

    h = layer.thickness
    top, bottom = (np.hstack([fields(layer.material, m, z) for m in (1.0, -1.0)]) for z in (0.0, h))
    if isinstance(stack.base, asp.Elastic):
        base = fields(stack.base, -1.0, 0.0)
        system = np.block([[top[2:], np.zeros((2, 2))], [bottom, -base]])
    else:
        system = np.vstack([top[2:], bottom[:2]])
    right = np.zeros((len(system), 2), complex)
    right[0, 0] = right[1, 1] = 1.0
    return np.asarray(top[:2] @ np.linalg.solve(system, right)[:4])


def inverse_laplace(f: Callable[[complex], ComplexArray], t: float, points: int = 32) -> RealArray:
    """f(t) by the fixed Talbot contour (Abate & Valko 2004)."""
    r = 2.0 * points / (5.0 * t)
    theta = np.arange(1, points) * np.pi / points
    cot = 1.0 / np.tan(theta)
    total = 0.5 * np.exp(r * t) * f(complex(r)).real
    for angle, c in zip(theta, cot, strict=True):
        s = r * angle * (c + 1j)
        sigma = angle + (angle * c - 1.0) * c
        total = total + (np.exp(t * s) * f(s) * (1.0 + 1j * sigma)).real
    return np.asarray(r / points * total)


WAVE = 1e-3
STACKS = {
    "coating": asp.Layered([asp.Layer(RUBBER, 0.1)], STEEL),
    "film": asp.Layered([asp.Layer(STEEL, 0.05)], RUBBER),
    "pad": asp.Layered([asp.Layer(VOLUME, 0.2)], asp.RigidBase()),
}


def stuck(stack: asp.Layered, times: RealArray, steps: asp.TimeSteps) -> RealArray:
    """Amplitudes of shear traction and pressure of a wavy surface pressed flat at once, and held
    without slip for these ``times`` (s)."""
    x = 2.0 * np.pi * np.arange(16) / 16
    surface = asp.Surface(WAVE * np.cos(x)[:, None] * np.ones(4), 1.0 / 16)
    problem = asp.ContactProblem(surface, stack, counter_body=asp.Rigid(), friction=asp.friction.FullStick())
    load = asp.MeanPressure(0.2)
    held = [asp.Step(load, asp.Shift(), duration=float(dt)) for dt in np.diff([0.0, *times])]
    found = asp.solve(problem, asp.History([asp.Step(load, asp.Shift()), *held]), time_steps=steps)
    shear = [-float((np.sin(x) * step.require_stick_slip().traction[0, :, 0]).mean()) * 2.0 for step in found.steps]
    pressure = [float((np.cos(x) * step.pressure[:, 0]).mean()) * 2.0 for step in found.steps]
    return np.array([shear, pressure])


@pytest.mark.parametrize("name", STACKS)
def test_stuck_wave_relaxes_as_the_inverse_of_the_complex_compliance(name: str) -> None:
    """u_x = 0 and u_z = h cos kx for all times: (q, p) = C(s)^-1 (0, h)/s, within the error of the
    series and of the steps of time."""
    k, times, stack = 2.0 * np.pi, np.array([0.1, 0.5, 2.0, 10.0]), STACKS[name]

    def tractions(s: complex) -> ComplexArray:
        return np.linalg.solve(wave_compliance(k, stack, s), np.array([0.0, WAVE / s]))

    found = stuck(stack, times, asp.TimeSteps(2e-5))
    first = np.linalg.solve(wave_compliance(k, stack, 1e20), np.array([0.0, WAVE])).real
    wanted = np.stack([first, *(inverse_laplace(tractions, t) for t in times)], axis=1)
    assert np.ptp(wanted[0]) > 0.05 * np.abs(wanted[1]).max()
    creep = contact_creep(stack, asp.Rigid(), shear=True)
    assert isinstance(creep, LayeredCreep)
    np.testing.assert_allclose(found[:, 0], wanted[:, 0], rtol=1e-5)
    for one, other in zip(found, wanted, strict=True):
        np.testing.assert_allclose(one, other, atol=(2.0 * creep.error + 5e-4) * np.abs(other).max())


@pytest.mark.slow
def test_steps_of_time_are_of_second_order_in_a_stuck_wave() -> None:
    times = np.array([1.0])
    fine, *coarse = (
        stuck(STACKS["coating"], times, asp.TimeSteps(number=number))[:, -1] for number in (160, 5, 10, 20)
    )
    errors = [float(np.abs(found - fine).max()) for found in coarse]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.2)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.2)


# Stick and slip of a sphere.


def sheared(shift: float, duration: float) -> list[asp.Step]:
    """Pressed at once, or slowly, and moved there and half-way back."""
    pressed = asp.Step(LOAD, asp.Shift(), duration=duration)
    return [pressed, *(asp.Step(LOAD, asp.Shift(to), duration=duration) for to in (shift, 0.5 * shift))]


def divided(shift: float, number: int) -> list[asp.Step]:
    """The same at once through elastic steps."""
    shares = np.arange(1, number + 1) / number
    pressed = [asp.Step(asp.Force(share * LOAD.value), asp.Shift()) for share in shares]
    there = [asp.Step(LOAD, asp.Shift(shift * share)) for share in shares]
    return [*pressed, *there, *(asp.Step(LOAD, asp.Shift(shift * (1.0 - 0.5 * share))) for share in shares)]


def forces(found: asp.HistoryResult) -> RealArray:
    return np.array([step.require_stick_slip().force_x for step in found.steps])


@pytest.mark.slow
@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("body", [COATED, FILM])
def test_fast_and_slow_shear_are_elastic(body: asp.Layered, boundary: asp.contact.Boundary) -> None:
    """Steps far shorter than all relaxation see the layers of the first instant, far longer ones
    the relaxed layers."""
    number, shift = 6, 0.004
    for duration, relaxed, allowed in ((1e-7, 0.0, 2e-5), (1e7, 1.0, 1e-3)):
        layers = sphere(as_elastic(body, relaxed), boundary=boundary)
        at_once = asp.solve(layers, asp.History(divided(shift, number))).steps
        course = asp.History(sheared(shift, duration))
        found = asp.solve(sphere(body, boundary=boundary), course, time_steps=asp.TimeSteps(number=number))
        for ours, theirs in zip(found.steps, at_once[number - 1 :: number], strict=True):
            np.testing.assert_allclose(ours.pressure, theirs.pressure, atol=allowed * theirs.max_pressure)
            one, other = ours.require_stick_slip(), theirs.require_stick_slip()
            assert one.force_x == pytest.approx(other.force_x, abs=allowed * MU * LOAD.value)
            np.testing.assert_allclose(one.traction, other.traction, atol=2.0 * allowed * MU * theirs.max_pressure)
        total = sum(step.require_stick_slip().dissipated for step in at_once)
        assert found.last.require_stick_slip().total_dissipated == pytest.approx(total, rel=3.0 * allowed)


@pytest.mark.parametrize("solid", [RUBBER, VOLUME])
def test_layers_of_one_material_are_that_material(solid: asp.Viscoelastic) -> None:
    """Layers of a solid of elastic bulk are fitted wave by wave, the half-space of it is two parts
    of one factor each; layers whose times differ by 1e-6 likewise."""
    times = 1.0 if solid.elastic_bulk else 1.0 + 1e-6
    stack = asp.Layered([asp.Layer(solid.with_times(times), 0.3)], solid)
    assert isinstance(contact_creep(stack, asp.Rigid(), shear=True), LayeredCreep)
    course, steps = asp.History(sheared(0.01, 0.5)), asp.TimeSteps(number=3)
    one, other = (asp.solve(sphere(body, 16), course, time_steps=steps) for body in (stack, solid))
    for ours, theirs in zip(one.steps, other.steps, strict=True):
        np.testing.assert_allclose(ours.pressure, theirs.pressure, atol=2e-6 * theirs.max_pressure)
        wanted = theirs.require_stick_slip().traction
        np.testing.assert_allclose(ours.require_stick_slip().traction, wanted, atol=1e-5 * np.abs(wanted).max())
        assert ours.creep.stored_energy == pytest.approx(theirs.creep.stored_energy, rel=1e-5)
        assert ours.creep.dissipated == pytest.approx(theirs.creep.dissipated, rel=1e-5)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("body", [COATED, FILM, PAD])
def test_work_is_stored_or_heat_of_slip_or_of_the_layers(body: asp.Layered, boundary: asp.contact.Boundary) -> None:
    """The balance of a loop with coupling between shear and pressure closes as the steps of time
    get shorter."""
    left, whole = left_of_a_loop(sphere(body, 16, boundary=boundary), 0.004)
    assert left[1] < 1e-3 * whole
    assert left[1] < 0.2 * left[0]


@pytest.mark.slow
def test_sheared_layers_go_on_to_the_bit(tmp_path: Path) -> None:
    """From a file too, and from a step in the middle."""
    problem, steps, divided_into = sphere(COATED, 16), sheared(0.005, 0.5), asp.TimeSteps(number=3)
    whole = asp.solve(problem, asp.History(steps), time_steps=divided_into)
    asp.save(whole, tmp_path / "h.nc")
    again = asp.load(tmp_path / "h.nc")
    for state in (whole.steps[1].state, again.steps[1].state):
        rest = asp.solve(problem, steps[2], state=state, time_steps=divided_into)
        np.testing.assert_array_equal(rest.pressure, whole.last.pressure)
        for name in ("traction", "slip", "slip_increment", "tangential_displacement"):
            one, other = (getattr(found.require_stick_slip(), name) for found in (rest, whole.last))
            np.testing.assert_array_equal(one, other)
        assert rest.creep.dissipated == whole.last.creep.dissipated
    assert again.energies.relative_error == whole.energies.relative_error


def test_a_state_of_another_series_is_refused() -> None:
    """Without friction the same layers are a series of their own."""
    film, load = (
        asp.Layered([asp.Layer(asp.Elastic(20.0, 0.3), 0.05)], asp.Viscoelastic.standard_linear(1.0, 10.0, 1.0, 0.4)),
        asp.Step(LOAD, duration=0.5),
    )
    alone = asp.solve(sphere(film, 16, friction=None), load, time_steps=asp.TimeSteps(number=2)).state
    with refused(asp.InputError, "state of viscoelastic layers"):
        asp.solve(sphere(film, 16), asp.Step(LOAD, asp.Shift(0.001), duration=0.5), state=alone)


def test_tresca_and_a_force_along_y_on_a_line() -> None:
    """A strip on the free line: forces are borne, and a tangential force held creeps onwards until
    the layers are relaxed."""
    x = (np.arange(48) - 23.5) * 0.05
    surface = asp.Surface(-(x[:, None] ** 2) / 20.0, 0.05)
    problem = asp.ContactProblem(
        surface, COATED, boundary=asp.FreeLine(), counter_body=asp.Rigid(), friction=asp.friction.TrescaFriction(0.05)
    )
    load, force = asp.Force(0.02), asp.TangentialForce(1.8e-3, 1.8e-3)
    course = [
        asp.Step(load, asp.TangentialForce()),
        asp.Step(load, force),
        asp.Step(load, force, duration=1.0),
        asp.Step(load, force, duration=1e4),
    ]
    found = asp.solve(problem, asp.History(course), time_steps=asp.TimeSteps(number=6))
    shifts = np.array(
        [[step.require_stick_slip().shift_x, step.require_stick_slip().shift_y] for step in found.steps[1:]]
    )
    assert (np.diff(shifts, axis=0) > 0.0).all()
    ends = [
        asp.solve(replace(problem, body=as_elastic(COATED, relaxed)), asp.History(course[:2])).last
        for relaxed in (0.0, 1.0)
    ]
    assert shifts[0, 0] == pytest.approx(ends[0].require_stick_slip().shift_x, rel=1e-4)
    assert found.last.require_stick_slip().force_y == pytest.approx(1.8e-3, rel=1e-6)


def test_bodies_that_are_equal_at_the_first_instant_only_couple_later() -> None:
    """Shear lifts a relaxed solid on its elastic twin, though it does not at the first instant."""
    twin = asp.Elastic(4.0, 0.3)
    course = asp.History([asp.Step(LOAD, asp.Shift(), duration=1e7), asp.Step(LOAD, asp.Shift(0.02), duration=1e7)])
    found = asp.solve(sphere(RUBBER, counter_body=twin), course, time_steps=asp.TimeSteps(number=6)).last
    pressed = [asp.Step(asp.Force(share * LOAD.value), asp.Shift()) for share in np.arange(1, 7) / 6]
    moved = [asp.Step(LOAD, asp.Shift(0.02 * share)) for share in np.arange(1, 7) / 6]
    relaxed = asp.solve(sphere(asp.Elastic(1.0, 0.3), counter_body=twin), asp.History([*pressed, *moved])).last
    lift = relaxed.require_stick_slip().shear_displacement
    assert np.abs(lift).max() > 1e-4
    np.testing.assert_allclose(found.require_stick_slip().shear_displacement, lift, atol=1e-3 * np.abs(lift).max())


# Gross sliding.

SLIDING: tuple[tuple[Body, Body], ...] = (
    (COATED, asp.Rigid()),
    (asp.Rigid(), FILM),
    (asp.Layered([asp.Layer(RUBBER, 0.3, asp.Frictionless())], STEEL), asp.Rigid()),
    (RUBBER, STEEL),
    (RUBBER, asp.Elastic(4.0, 0.3)),
    (VOLUME, asp.Rigid()),
)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("pair", SLIDING)
def test_shear_of_sliding_creeps_with_the_pressure(pair: tuple[Body, Body], boundary: asp.contact.Boundary) -> None:
    """Coupled friction, by a map of coefficients too: at once as the first elastic bodies, after a
    long hold as the relaxed ones."""
    coefficients = 0.4 + 0.4 * (np.arange(24)[:, None] > 12) * np.ones(24)
    course = asp.History([LOAD, asp.Step(LOAD, duration=0.5), asp.Step(LOAD, duration=1e4)])
    for friction in (asp.Coulomb(0.8, direction=0.3), asp.Coulomb(coefficients)):
        settings = {"boundary": boundary, "friction": friction}
        found = asp.solve(sphere(pair[0], counter_body=pair[1], **settings), course)
        for step, relaxed, allowed in ((found.steps[0], 0.0, 1e-6), (found.last, 1.0, 0.01)):
            first, second = (as_elastic(body, relaxed) for body in pair)
            elastic = asp.solve(sphere(first, counter_body=second, **settings), LOAD)
            np.testing.assert_allclose(step.pressure, elastic.pressure, atol=allowed * elastic.max_pressure)
            wanted = elastic.sliding.shear_displacement
            scale = max(float(np.abs(wanted).max()), 1e-4 * elastic.approach)
            np.testing.assert_allclose(step.sliding.shear_displacement, wanted, atol=allowed * scale)


def test_sliding_layers_go_on_to_the_bit(tmp_path: Path) -> None:
    """The shear of gross sliding is remembered too, in files as in states."""
    problem, divided_into = sphere(COATED, 16, friction=asp.Coulomb(0.8)), asp.TimeSteps(number=2)
    steps = [asp.Step(LOAD, duration=0.3), asp.Step(asp.Force(0.02), duration=0.3), asp.Step(LOAD, duration=0.3)]
    whole = asp.solve(problem, asp.History(steps), time_steps=divided_into)
    asp.save(whole, tmp_path / "h.nc")
    for state in (whole.steps[1].state, asp.load(tmp_path / "h.nc").steps[1].state):
        rest = asp.solve(problem, steps[2], state=state, time_steps=divided_into)
        np.testing.assert_array_equal(rest.pressure, whole.last.pressure)
        np.testing.assert_array_equal(rest.sliding.shear_displacement, whole.last.sliding.shear_displacement)
