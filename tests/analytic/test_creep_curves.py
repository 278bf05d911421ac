"""Creep-force curves against Kalker's linear slope, saturation, FASTSIM and Carter; layered rollers
in their limits; rough wheels."""

import numpy as np
import pytest
from refusals import refused

import asperity as asp

A, R, MU = 0.1, 1.0, 0.3
UNIT = MU * A / R
STEEL = asp.Elastic(1.0, 0.25)


def ball(n=32, body=STEEL, across=1.0, counter=None):
    spacing = 2.5 * A / n
    x = (np.arange(n) - 0.5 * (n - 1)) * spacing
    heights = -(x[:, None] ** 2 + x[None, :] ** 2 / across) / (2.0 * R)
    other = body if counter is None else counter
    problem = asp.ContactProblem(
        asp.Surface(heights, spacing, spacing), body, counter_body=other, boundary=asp.Free(), friction=asp.Coulomb(MU)
    )
    return problem, asp.Force(4.0 / 3.0 * problem.contact_modulus * A**3 / R)


def roller(n=64, body=STEEL, reach=1.5, boundary=None):
    spacing = 2.0 * reach * A / n
    x = (np.arange(n) - 0.5 * (n - 1)) * spacing
    problem = asp.ContactProblem(
        asp.Surface(-(x[:, None] ** 2) / (2.0 * R), spacing, 1.0),
        body,
        counter_body=body,
        boundary=boundary or asp.FreeLine(),
        friction=asp.Coulomb(MU),
    )
    return problem, asp.Force(np.pi / 4.0 * problem.contact_modulus * A**2 / R)


def waves(problem, count, seed=3):
    """Random roughness along the rolling direction with a few wavelengths, periodic over ``count``
    pixels."""
    spacing = problem.grid.spacing[0]
    rng, x = np.random.default_rng(seed), np.arange(count)
    numbers = np.arange(4, 16)
    phase, size = rng.uniform(0.0, 2.0 * np.pi, numbers.size), 4e-4 / numbers**1.2
    heights = np.sum(size * np.sin(2.0 * np.pi * numbers * x[:, None] / count + phase), axis=1)
    return asp.Surface(np.repeat(heights[:, None], problem.grid.shape[1], axis=1), spacing, problem.grid.spacing[1])


@pytest.mark.parametrize("across", [1.0, 0.4])
def test_curves_begin_with_kalkers_slope_end_at_the_limit_and_lie_beside_fastsim(across):
    problem, _ = ball(28, across=across)
    load = asp.Force(0.9 * 4.0 / 3.0 * problem.contact_modulus * A**3 / R * across**0.5)
    share = np.array([0.02, 0.3, 0.6, 1.0, 3.0]) * UNIT
    cases = ({"longitudinal": share}, {"lateral": share}, {"longitudinal": share, "lateral": 0.5 * share})
    for creepages in cases:
        curve = asp.rolling.creep_curve(problem, load, **creepages)
        assert curve.theories == ("fastsim", "linear")
        force = np.hypot(curve.longitudinal_force, curve.lateral_force) / curve.friction_limit
        linear, fast = (curve.theory(name) for name in ("linear", "fastsim"))
        slope = np.hypot(linear.force_x, linear.force_y)[0] / curve.friction_limit
        assert force[0] == pytest.approx(slope, rel=0.08)  # a pixel of the rim slips
        assert force[-1] == pytest.approx(1.0, abs=1e-3)
        assert np.all(np.diff(force) > 0.0)
        beside = np.hypot(fast.force_x, fast.force_y) / curve.friction_limit
        assert np.abs(force / beside - 1.0).max() < 0.10
    spinning = asp.rolling.creep_curve(problem, load, spin=np.array([0.1, 0.5, 1.0]) * UNIT / A)
    fast = spinning.theory("fastsim")
    assert np.abs(spinning.lateral_force / fast.force_y - 1.0).max() < 0.15
    assert np.all(spinning.torque > 0.0)


def test_carters_curve():
    """First order in the pixel, on grids whose pixels lie alike at the rims."""
    errors = []
    for n in (32, 128):
        problem, load = roller(n)
        curve = asp.rolling.creep_curve(problem, load, np.linspace(-1.5, 1.5, 7) * UNIT)
        assert curve.theories == ("carter",)
        off = curve.longitudinal_force - curve.theory("carter").force_x
        errors.append(float(np.abs(off).max()) / curve.friction_limit)
    assert errors[1] < 0.3 * errors[0] < 0.01
    assert curve.longitudinal_force == pytest.approx(-curve.longitudinal_force[::-1], abs=1e-5 * curve.friction_limit)
    table = curve.to_xarray()
    assert table["longitudinal_force"].attrs["units"] == "N"
    assert "carter_longitudinal_force" in table


def test_theories_stand_aside_where_they_do_not_hold():
    coated = asp.Layered([asp.Layer(asp.Elastic(3.0, 0.3), 0.05)], base=STEEL)
    problem, load = ball(16, body=coated)
    curve = asp.rolling.creep_curve(problem, load, 0.3 * UNIT)
    assert curve.theories == ()
    with refused(asp.InputError, "theory of a creep-force curve"):
        curve.theory("fastsim")
    with refused(asp.InputError, "longitudinal, lateral and spin"):
        asp.rolling.creep_curve(problem, load, [1e-3, 2e-3], lateral=[1e-3, 2e-3, 3e-3])


def test_layered_rollers_between_their_limits():
    """A layer of the roller's own material is no layer; a thin one is its base, a thick one its own
    material."""
    soft, at = asp.Elastic(0.4, 0.25), np.array([0.3, 0.7]) * UNIT
    load = asp.Force(0.4 * roller()[1].value)

    def forces(body):
        return asp.rolling.creep_curve(roller(64, body)[0], load, at).longitudinal_force

    def coated(material, thickness):
        return asp.Layered([asp.Layer(material, thickness)], base=STEEL)

    hard, compliant = forces(STEEL), forces(soft)
    assert forces(coated(STEEL, 0.5 * A)) == pytest.approx(hard, rel=1e-6)
    assert forces(coated(soft, 1e-4 * A)) == pytest.approx(hard, rel=0.01)
    assert forces(coated(soft, 300.0 * A)) == pytest.approx(compliant, rel=0.01)
    between = forces(coated(soft, 0.3 * A))
    assert np.all((np.minimum(hard, compliant) < between) & (between < np.maximum(hard, compliant)))


def test_a_rough_wheel_without_roughness_comes_to_steady_rolling():
    problem, load = roller(48)
    creepage = asp.rolling.Creepage(0.4 * UNIT)
    flat = asp.Surface(np.zeros((20, 1)), *problem.grid.spacing)
    rough = asp.rolling.roll_rough(problem, load, creepage, flat, distance=10.0 * A)
    steady = asp.roll(problem, load, creepage)
    off = np.abs(rough.force_x / steady.force_x - 1.0)
    at = [np.searchsorted(rough.distance, length) for length in (2.0 * A, 4.0 * A, 8.0 * A)]
    assert off[at[0]] > off[at[1]] > off[at[2]]
    assert off[-1] < 1e-3
    assert rough.deviation("force_x") < 0.01 * steady.force_x


def test_ridges_along_the_rolling_direction_are_steady():
    """Moves of a surface that is the same all along come to what the direct method finds."""
    problem, load = ball(26)
    y = np.arange(26)
    ridges = 2e-4 * np.cos(2.0 * np.pi * 5.0 * y / 26.0)
    rough = asp.Surface(np.repeat(ridges[None, :], 8, axis=0), *problem.grid.spacing)
    creepage = asp.rolling.Creepage(0.4 * UNIT, 0.2 * UNIT, 0.5 * UNIT / A)
    found = asp.rolling.roll_rough(problem, load, creepage, rough, distance=9.0 * A)
    ridged = asp.ContactProblem(
        asp.Surface(problem.surface.heights + ridges, *problem.grid.spacing),
        STEEL,
        counter_body=STEEL,
        boundary=asp.Free(),
        friction=problem.friction,
    )
    steady = asp.roll(ridged, load, creepage)
    assert found.last.force_x == pytest.approx(steady.force_x, rel=2e-3)
    assert found.last.force_y == pytest.approx(steady.force_y, rel=2e-3)


@pytest.mark.slow
def test_roughness_comes_again_after_its_length_and_rolls_on_from_where_it_was():
    problem, load = roller(40)
    creepage = asp.rolling.Creepage(0.5 * UNIT)
    rough = waves(problem, 30)
    whole = asp.rolling.roll_rough(problem, load, creepage, rough, distance=200 * problem.grid.spacing[0])
    force = whole.force_x
    assert force[-30:] == pytest.approx(force[-60:-30], rel=2e-3)
    assert np.ptp(force[-30:]) > 0.003 * force[-1]  # and it does fluctuate
    half = asp.rolling.roll_rough(problem, load, creepage, rough, distance=100 * problem.grid.spacing[0])
    rest = asp.rolling.roll_rough(problem, load, creepage, rough, distance=100 * problem.grid.spacing[0], start=half)
    assert rest.force_x == pytest.approx(force, rel=1e-4)
    assert rest.distance == pytest.approx(whole.distance)
    assert whole.mean("traction_coefficient") < MU
    assert whole.to_xarray()["force_x"].attrs["units"] == "N"


def test_a_mirrored_rough_wheel_rolls_backwards():
    problem, load = roller(32)
    rough = waves(problem, 24)
    creepage, distance = asp.rolling.Creepage(0.5 * UNIT), 2.0 * A
    one = asp.rolling.roll_rough(problem, load, creepage, rough, distance=distance)
    mirrored = asp.Surface(rough.heights[::-1], *rough.grid.spacing)
    other = asp.rolling.roll_rough(problem, load, creepage, mirrored, distance=distance, direction="-x")
    assert other.force_x == pytest.approx(-one.force_x, rel=1e-4)
    assert other.traction_coefficient == pytest.approx(one.traction_coefficient, rel=1e-4)


def test_unlike_rough_rollers_and_periodic_ones():
    problem, load = roller(32, asp.Elastic(1.0, 0.2))
    unlike = asp.ContactProblem(
        problem.surface, problem.body, boundary=asp.FreeLine(), friction=problem.friction
    )  # on a rigid body
    found = asp.rolling.roll_rough(
        unlike, asp.Force(2.0 * load.value), asp.rolling.Creepage(0.4 * UNIT), waves(unlike, 24), distance=2.0 * A
    )
    assert found.converged
    assert np.all(found.force_x <= found.friction_limit * (1.0 + 1e-9))
    periodic, load = roller(64, reach=3.0, boundary=asp.Periodic())
    again = asp.rolling.roll_rough(
        periodic, load, asp.rolling.Creepage(0.4 * UNIT), waves(periodic, 32), distance=2.0 * A
    )
    assert np.all(again.contact_area < 2.5 * A)


def test_roughness_that_does_not_fit_is_refused():
    problem, load = roller(32)
    spacing = problem.grid.spacing
    creepage = asp.rolling.Creepage(1e-3)
    with refused(asp.InputError, "roughness"):
        asp.rolling.roll_rough(problem, load, creepage, asp.Surface(np.zeros((20, 1)), 2.0 * spacing[0], 1.0))
    with refused(asp.InputError, "roughness"):
        asp.rolling.roll_rough(problem, load, creepage, asp.Surface(np.zeros((20, 3)), *spacing))
    with refused(asp.InputError, "roughness"):
        asp.rolling.roll_rough(problem, load, creepage, asp.Surface(np.r_[np.zeros(19), np.nan][:, None], *spacing))
    short = asp.rolling.roll_rough(
        problem, load, creepage, asp.Surface(np.zeros((20, 1)), *spacing), distance=spacing[0]
    )
    with refused(asp.InputError, "distance of rough rolling"):
        short.mean("force_x")
