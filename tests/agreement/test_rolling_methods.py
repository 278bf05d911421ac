"""Steady rolling by the direct method against moves of the material until they rest, and under the
symmetries of the grid."""

from dataclasses import replace

import numpy as np
import pytest
from refusals import refused

import asperity as asp

A, R = 0.1, 1.0
UNIT = 0.3 * A / R  # creepages at which a good part slips
STEEL = asp.Elastic(1.0, 0.3)
COATED = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.2), 0.04)], base=STEEL)


def wheel(shape=(24, 24), body=STEEL, counter=None, law=None, across=0.6):
    """Ellipsoid with more curvature across the rolling direction, under a load of a contact of
    about A."""
    spacing = 2.5 * A / shape[0]
    x, y = ((np.arange(n) - 0.5 * (n - 1)) * spacing for n in shape)
    heights = -(x[:, None] ** 2 + y[None, :] ** 2 / across) / (2.0 * R)
    law = asp.Coulomb(0.3) if law is None else law
    surface = asp.Surface(heights, spacing, spacing)
    other = body if counter is None else counter
    problem = asp.ContactProblem(surface, body, counter_body=other, boundary=asp.Free(), friction=law)
    return problem, asp.Force(1.1 * problem.contact_modulus * A**3 / R)


MOTIONS = [(0.1, 0.0, 0.0), (0.5, 0.3, 0.0), (0.0, 0.0, 1.0), (0.3, 0.3, 3.0), (3.0, 0.0, 0.0), (-0.4, 0.0, -1.0)]
UNLIKE = "rigid on coated"


@pytest.mark.parametrize(
    ("pair", "motion"),
    [
        *(("equal", motion) for motion in MOTIONS),
        *(("coated", motion) for motion in MOTIONS[1:4]),
        *(pytest.param(UNLIKE, motion, marks=pytest.mark.slow) for motion in MOTIONS[1::2]),
    ],
    ids=str,
)
def test_both_methods_find_the_same_traction(pair, motion):
    """A steady state at a change of 1e-8 a move; the error of the transient method is a hundred
    times that."""
    body = STEEL if pair == "equal" else COATED
    problem, load = wheel(body=body, counter=asp.Rigid() if pair == UNLIKE else None)
    creepage = asp.rolling.Creepage(motion[0] * UNIT, motion[1] * UNIT, motion[2] * UNIT / A)
    tolerance = 1e-6 if pair == UNLIKE else 1e-8
    direct = asp.roll(problem, load, creepage, tolerance=tolerance)
    moved = asp.roll(problem, load, creepage, method="transient", tolerance=tolerance, start=direct)
    again = asp.roll(problem, load, creepage, method="transient", tolerance=1e-5)  # from nothing
    largest = np.abs(direct.traction).max()
    assert np.abs(direct.traction - moved.traction).max() <= 300.0 * tolerance * largest
    assert np.abs(direct.traction - again.traction).max() <= 3e-3 * largest
    assert direct.steps < 0.5 * again.steps


def turned(field, quarter):
    return np.rot90(field, quarter)


@pytest.mark.parametrize(("direction", "quarter"), [("y", 1), ("-x", 2), ("-y", 3)])
def test_a_turned_contact_rolls_as_before_in_the_turned_direction(direction, quarter):
    problem, load = wheel((26, 20), body=COATED)
    creepage = asp.rolling.Creepage(0.4 * UNIT, 0.2 * UNIT, UNIT / A)
    first = asp.roll(problem, load, creepage)
    heights = turned(problem.surface.heights, quarter)
    dx = problem.grid.spacing[0]
    other = asp.ContactProblem(
        asp.Surface(heights, dx, dx), COATED, counter_body=COATED, boundary=asp.Free(), friction=problem.friction
    )
    second = asp.roll(other, load, creepage, direction=direction)
    assert second.longitudinal_force == pytest.approx(first.longitudinal_force, rel=1e-5)
    assert second.lateral_force == pytest.approx(first.lateral_force, rel=1e-5)
    assert second.torque == pytest.approx(first.torque, rel=1e-5)
    assert second.dissipated == pytest.approx(first.dissipated, rel=1e-5)
    size = np.hypot(*first.traction)
    assert np.abs(np.hypot(*second.traction) - turned(size, quarter)).max() <= 1e-4 * size.max()


def test_a_row_of_far_cylinders_rolls_as_one():
    """Periods of 2 contact widths are not far; the difference falls with their square."""
    found = []
    for period in (8.0, 16.0):
        n = int(32 * period)
        spacing = period * A / n
        x = (np.arange(n) - 0.5 * (n - 1)) * spacing
        heights = -(x[:, None] ** 2) / (2.0 * R)
        body = asp.Elastic(1.0, 0.3)
        forces = []
        for boundary in (asp.Periodic(), asp.FreeLine()):
            surface = asp.Surface(heights, spacing, 1.0)
            problem = asp.ContactProblem(surface, body, counter_body=body, boundary=boundary, friction=asp.Coulomb(0.3))
            load = asp.Force(np.pi / 4.0 * problem.contact_modulus * A**2 / R)
            rolled = asp.roll(problem, load, asp.rolling.Creepage(0.3 * UNIT))
            forces.append(rolled.force_x / rolled.friction_limit)
        found.append(forces[0] / forces[1] - 1.0)
    assert abs(found[1]) < 0.4 * abs(found[0]) < 0.02


@pytest.mark.parametrize(
    "law", [asp.friction.TrescaFriction(0.005), asp.Coulomb(0.5, limit=0.004), asp.friction.FullStick()], ids=str
)
def test_other_laws_roll(law):
    problem, load = wheel(law=law)
    found = asp.roll(problem, load, asp.rolling.Creepage(0.3 * UNIT, 0.0, 0.3 * UNIT / A))
    bound = law.bound(found.normal.pressure)
    assert np.all(np.hypot(*found.traction) <= bound * (1.0 + 1e-9))
    if isinstance(law, asp.friction.FullStick):
        assert not found.slipping.any()
    else:
        assert 0 < found.slipping.sum() < found.normal.contact.sum()


def test_rolling_is_refused_where_it_makes_no_sense():
    line = asp.Surface(-(np.linspace(-1, 1, 16)[:, None] ** 2), 0.1, 1.0)
    problem = asp.ContactProblem(line, STEEL, boundary=asp.FreeLine(), friction=asp.Coulomb(0.3))
    with refused(asp.InputError, "direction of rolling"):
        asp.roll(problem, asp.Force(1e-2), asp.rolling.Creepage(1e-3), direction="y")
    with refused(asp.InputError, "method of rolling"):
        asp.roll(problem, asp.Force(1e-2), asp.rolling.Creepage(1e-3), method="guess")
    ball, load = wheel()
    with refused(asp.InputError, "spin"):
        asp.roll(replace(ball, boundary=asp.Periodic()), load, asp.rolling.Creepage(0.0, 0.0, 1e-3))
    with refused(asp.InputError, "adhesion of a rolling contact"):
        asp.roll(replace(ball, adhesion=asp.ExponentialAdhesion(1e-3, 1e-3)), load, asp.rolling.Creepage(1e-3))
    with refused(asp.InputError, "law of a rolling contact"):
        asp.roll(replace(ball, law=asp.Hardness(1.0)), load, asp.rolling.Creepage(1e-3))
