"""Sliding and rolling in steps of time against the steady solutions, the heat, and itself in two
parts."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

import asperity as asp

RUBBER = asp.Viscoelastic.prony(1.0, ((9.0, 1.0),), 0.0)
PRESSURE = asp.MeanPressure(0.3 * np.pi * 0.01)


def wave(
    points: int = 64, body: asp.Elastic = RUBBER, moved: float = 0.0, **more: asp.Hardness | asp.ExponentialAdhesion
) -> asp.ContactProblem:
    x = np.arange(points) / points - moved
    heights = -0.01 * (1.0 - np.cos(2.0 * np.pi * x))[:, None]
    surface = asp.Surface(heights, 1.0 / points, 1.0, periodic=True)
    return asp.ContactProblem(surface, asp.Rigid(), counter_body=body, **more)  # type: ignore[arg-type]


def test_sliding_wave_comes_to_its_steady_state() -> None:
    """From no friction at the first instant to the friction of the steady state, by slope and by
    heat, to half a percent."""
    steady = asp.slide(wave(), PRESSURE, 0.1)
    found = asp.viscoelasticity.slide_in_time(wave(), PRESSURE, 0.1, 3.0)
    assert abs(found.friction[0]) < 1e-6
    assert found.mean_friction(1.0) == pytest.approx(steady.friction, rel=5e-3)
    assert found.mean_loss(1.0) == pytest.approx(steady.friction, rel=5e-3)
    assert found.last.max_pressure == pytest.approx(steady.normal.max_pressure, rel=0.02)
    assert (np.diff(found.column("dissipated")) >= 0.0).all()
    first = asp.solve(wave(), PRESSURE)
    assert found.records[0, 6] == pytest.approx(first.max_pressure, rel=1e-6)
    assert found.distance[-1] == pytest.approx(3.0, rel=1e-12)


def test_motion_in_two_parts_is_the_same() -> None:
    whole = asp.viscoelasticity.slide_in_time(wave(32), PRESSURE, 0.3, 0.5)
    first = asp.viscoelasticity.slide_in_time(wave(32), PRESSURE, 0.3, 0.25)
    rest = asp.viscoelasticity.slide_in_time(wave(32), PRESSURE, 0.3, 0.25, after=first)
    np.testing.assert_array_equal(np.concatenate([first.records, rest.records[1:]]), whole.records)
    np.testing.assert_array_equal(rest.last.pressure, whole.last.pressure)
    np.testing.assert_array_equal(rest.last.problem.surface.heights, whole.last.problem.surface.heights)


def parabola(points: int, reach: float, start: float) -> asp.Surface:
    x = (np.arange(points) - points / 2 + 0.5) * 2 * reach / points
    return asp.Surface(-0.5 * ((x - start)[:, None] ** 2 + np.zeros(1)), 2 * reach / points, 1.0)


@pytest.mark.slow
def test_cylinder_on_a_free_line_comes_to_its_steady_state() -> None:
    """It starts at the left and has forgotten that after a few lengths of memory."""
    load, speed = asp.Force(0.02), 0.03
    moving = asp.ContactProblem(parabola(400, 1.2, -0.8), asp.Rigid(), counter_body=RUBBER, boundary=asp.FreeLine())
    centred = asp.ContactProblem(parabola(200, 0.6, 0.0), asp.Rigid(), counter_body=RUBBER, boundary=asp.FreeLine())
    steady = asp.slide(centred, load, speed)
    found = asp.viscoelasticity.slide_in_time(moving, load, speed, 1.5, steps_per_pixel=1)
    assert found.mean_friction(0.1) == pytest.approx(steady.friction, rel=0.01)
    assert found.mean_loss(0.1) == pytest.approx(steady.friction, rel=0.01)
    assert abs(found.friction[0]) < 1e-3 * steady.friction
    assert (np.diff(found.friction) > -1e-3 * steady.friction).all()


def test_rough_body_rolls() -> None:
    """Roughness that passes through the contact at rest adds to the heat of the shape that moves
    over it; work and heat agree over a period."""
    points = 64
    x = np.arange(points) / points
    shape = asp.Surface(-0.01 * (1.0 - np.cos(2.0 * np.pi * x))[:, None], 1.0 / points, 1.0, periodic=True)
    track = asp.Surface(0.0008 * np.cos(2.0 * np.pi * 8 * x)[:, None], 1.0 / points, 1.0, periodic=True)
    problem = asp.ContactProblem(shape, asp.Rigid(), counter_surface=track, counter_body=RUBBER)
    found = asp.viscoelasticity.slide_in_time(problem, PRESSURE, 0.1, 3.0)
    assert found.mean_friction(1.0) == pytest.approx(found.mean_loss(1.0), rel=0.02)
    assert float(np.ptp(found.friction[-128:])) > 0.05 * found.mean_friction(1.0)
    smooth = asp.slide(wave(), PRESSURE, 0.1)
    assert found.mean_friction(1.0) == pytest.approx(smooth.friction, rel=0.5)
    assert found.column("area_fraction")[-1] < asp.slide(wave(), PRESSURE, 0.1).normal.area_fraction


def test_direction_of_a_motion() -> None:
    """Along y the wave stands still and nothing but creep happens; against x it is as along x."""
    x = np.arange(16) / 16
    surface = asp.Surface(np.tile(-0.01 * (1.0 - np.cos(2.0 * np.pi * x))[:, None], 16), 1.0 / 16, periodic=True)
    problem = asp.ContactProblem(surface, asp.Rigid(), counter_body=RUBBER)
    along, back, across = (
        asp.viscoelasticity.slide_in_time(problem, PRESSURE, 0.2, 0.5, direction=angle).friction
        for angle in (0.0, np.pi, np.pi / 2)
    )
    np.testing.assert_allclose(back, along, atol=1e-6)
    assert np.abs(across).max() < 1e-6
    assert along[-1] > 1e-3


LIGHT = asp.MeanPressure(0.1 * np.pi * 0.01)
STICKY = asp.ExponentialAdhesion(2e-4, 2e-3)


@pytest.mark.parametrize(("speed", "modulus", "error"), [(1e6, 10.0, 1e-5), (1e-5, 1.0, 5e-4)])
def test_adhesive_sliding_fast_and_slow_is_elastic(speed: float, modulus: float, error: float) -> None:
    """The adhesive contact of the first instant carried along, or that of the relaxed body; without
    friction in both."""
    found = asp.viscoelasticity.slide_in_time(wave(48, adhesion=STICKY), LIGHT, speed, 0.25, steps_per_pixel=1)
    elastic = asp.solve(wave(48, asp.Elastic(modulus, 0.0), 0.25, adhesion=STICKY), LIGHT)
    np.testing.assert_allclose(found.last.pressure, elastic.pressure, atol=error * elastic.max_pressure)
    assert elastic.area_fraction > asp.solve(wave(48, asp.Elastic(modulus, 0.0)), LIGHT).area_fraction
    assert abs(found.friction[-1]) < 5e-4


@pytest.mark.slow
def test_adhesion_adds_to_hysteretic_friction() -> None:
    """Work along the motion of pressure and attraction is the heat of the solid, and more than
    without adhesion."""
    found = asp.viscoelasticity.slide_in_time(wave(32, adhesion=STICKY), LIGHT, 0.1, 1.5)
    assert found.mean_friction(1.0) == pytest.approx(found.mean_loss(1.0), rel=0.01)
    assert found.mean_friction(1.0) > 1.5 * asp.slide(wave(48), LIGHT, 0.1).friction


def test_dents_stay_on_the_body_at_rest() -> None:
    """After a period there is one groove of the same depth at all points, and pressures stay below
    the hardness."""
    hardness = 0.05
    found = asp.viscoelasticity.slide_in_time(wave(48, law=asp.Hardness(hardness)), LIGHT, 0.1, 2.0, steps_per_pixel=1)
    dent = found.last.permanent_indentation
    assert dent.min() > 0.0
    assert found.last.max_pressure <= hardness * (1.0 + 1e-9)
    assert float(found.column("max_pressure").max()) <= hardness * (1.0 + 1e-9)
    first = asp.solve(wave(48, law=asp.Hardness(hardness)), LIGHT)
    assert found.records[0, 5] == pytest.approx(first.area_fraction_corrected, rel=1e-9)


def test_what_is_refused() -> None:
    x = np.arange(16) / 16
    rough = asp.Surface(0.01 * np.cos(2.0 * np.pi * x)[:, None], 1.0 / 16, 1.0, periodic=True)
    with refused(asp.InputError, "bodies of sliding in time"):
        asp.viscoelasticity.slide_in_time(asp.ContactProblem(rough, asp.Elastic(1.0, 0.3)), PRESSURE, 1.0, 1.0)
    with refused(asp.InputError, "counter_surface of sliding in time"):
        asp.viscoelasticity.slide_in_time(asp.ContactProblem(rough, RUBBER), PRESSURE, 1.0, 1.0)
    with refused(asp.InputError, "sliding speed (m/s)"):
        asp.viscoelasticity.slide_in_time(wave(16), PRESSURE, 0.0, 1.0)
    with refused(asp.InputError, "control of sliding in time"):
        asp.viscoelasticity.slide_in_time(wave(16), asp.Unloaded(), 1.0, 1.0)
    with refused(asp.InputError, "friction of sliding in time"):
        rubbed = asp.ContactProblem(rough, asp.Rigid(), counter_body=RUBBER, friction=asp.Coulomb(0.2))
        asp.viscoelasticity.slide_in_time(rubbed, PRESSURE, 1.0, 1.0)
    with refused(asp.InputError, "adhesion of viscoelastic bodies", "JKRAdhesion"):
        sticky = asp.ContactProblem(rough, asp.Rigid(), counter_body=RUBBER, adhesion=asp.adhesion.JKRAdhesion(1e-4))
        asp.viscoelasticity.slide_in_time(sticky, PRESSURE, 1.0, 1.0)
    first = asp.viscoelasticity.slide_in_time(wave(16), PRESSURE, 1.0, 0.1)
    with refused(asp.InputError, "earlier part of a motion"):
        asp.viscoelasticity.slide_in_time(wave(16), PRESSURE, 2.0, 0.1, after=first)
