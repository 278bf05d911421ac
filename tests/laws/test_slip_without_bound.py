"""Points that bear no shear slip; a force that is all that friction bears leaves the shift open."""

import math

import numpy as np
import pytest
from contact_cases import rough
from refusals import refused

import asperity as asp
from asperity.parts.advice import review
from asperity.physics.friction.fretting import loop_of, shear_numbers
from asperity.physics.rolling.rolling import Creepage

SOFT, STIFF = asp.Elastic(1.0, 0.3), asp.Elastic(5.0, 0.1)
LOAD = asp.MeanPressure(0.1)
HALF = np.where(np.arange(24)[:, None] < 12, 0.0, 0.4) + np.zeros((24, 24))
BARE = {
    "Coulomb 0": asp.Coulomb(0.0),
    "Tresca 0": asp.friction.TrescaFriction(0.0),
    "half without friction": asp.Coulomb(HALF),
    "half without strength": asp.friction.TrescaFriction(0.02 * (HALF > 0.0)),
}


TIGHT = {
    "solver": asp.solvers.ActiveSet(tolerance=1e-12),
    "rounds": asp.solvers.Rounds(tolerances={"stick_slip": 1e-9}),
}


def posed(friction, body=SOFT, counter=SOFT, **options):
    surface = rough((24, 24), 7, power=1.6)
    return asp.ContactProblem(surface, body, counter_body=counter, friction=friction, **options)


@pytest.mark.parametrize(
    "options", [{}, {"boundary": asp.Free()}, {"counter": STIFF}, {"law": asp.Hardness(0.3)}], ids=str
)
@pytest.mark.parametrize("name", BARE)
def test_points_without_bound_slip_by_what_is_left_of_the_shift(name, options):
    """Their slip is the shift less the elastic displacement along the surface; where nothing bears
    shear and bodies are alike, the shift."""
    law = BARE[name]
    problem = posed(law, **options)
    path = asp.solve(problem, asp.History([asp.Step(LOAD, asp.Shift()), asp.Step(LOAD, asp.Shift(0.2, 0.1))]))
    first, last = (step.stick_slip for step in path.steps)
    result = path.last
    bare = result.contact & (law.bound(result.pressure) == 0.0)
    assert bare.any()
    assert last.slipping[bare].all()
    left = np.array([0.2, 0.1])[:, None, None] - (last.tangential_displacement - first.tangential_displacement)
    assert last.slip_increment[:, bare] == pytest.approx(left[:, bare], rel=1e-9, abs=1e-12)
    assert not last.traction[:, bare].any()
    assert not last.dissipation_density[bare].any()
    assert not last.slip[:, ~result.contact].any() or first.slip.any()
    if not np.any(law.bound(result.pressure)) and problem.body == problem.counter_body:
        assert np.all(last.slip_increment[0][result.contact] == pytest.approx(0.2, rel=1e-12))
        assert shear_numbers(result)["slip_area_fraction"] == 1.0
        assert math.isnan(shear_numbers(result)["friction_share"])


def test_zero_friction_is_the_limit_of_little_friction():
    step = asp.Step(LOAD, asp.Shift(0.2, 0.1))
    bare, little = (asp.solve(posed(asp.Coulomb(mu), counter=STIFF), step, **TIGHT) for mu in (0.0, 1e-9))
    assert np.array_equal(bare.contact, little.contact)
    difference = bare.stick_slip.slip_increment - little.stick_slip.slip_increment
    assert np.abs(difference).max() <= 1e-6 * np.abs(bare.stick_slip.slip_increment).max()


def test_linearisation_leaves_out_what_bears_nothing():
    result = asp.solve(posed(asp.Coulomb(HALF), counter=STIFF), asp.Step(LOAD, asp.Shift(1e-3)))
    assert asp.friction.tangential_stiffness(result).along(1.0, 0.0) > 0.0


@pytest.mark.parametrize("rough_wheel", [False, True])
def test_rolling_without_friction_slips_by_the_creepage(rough_wheel):
    line = asp.Surface(-((np.arange(24) - 11.5)[:, None] ** 2) / 200.0, 1.0, 1.0)
    problem = asp.ContactProblem(line, SOFT, counter_body=SOFT, boundary=asp.FreeLine(), friction=asp.Coulomb(0.0))
    if rough_wheel:
        ripple = asp.Surface(0.01 * np.cos(np.arange(12)[:, None] * np.pi / 6.0), 1.0, 1.0)
        found = asp.rolling.roll_rough(problem, asp.Force(0.02), Creepage(1e-3), ripple, distance=3.0).last
    else:
        found = asp.roll(problem, asp.Force(0.02), Creepage(1e-3))
    touching = found.normal.contact
    assert found.slip_area_fraction == 1.0
    assert found.slip[0][touching] == pytest.approx(1e-3, rel=1e-12)
    assert found.dissipated == 0.0


@pytest.mark.parametrize("law", [asp.Coulomb(0.0), asp.friction.TrescaFriction(0.0)], ids=str)
def test_force_without_friction_has_no_solution(law):
    with refused(asp.errors.NoSolutionError, "tangential force", "2 N"):
        asp.solve(posed(law), asp.Step(LOAD, asp.TangentialForce(2.0)))


@pytest.mark.parametrize("counter", [SOFT, STIFF], ids=["like", "unlike"])
def test_force_that_friction_just_bears_leaves_the_shift_open(counter):
    """NaN from there on, with a finding; forces and energies stay, and a smaller force after it
    slips back by a known amount."""
    problem = posed(asp.Coulomb(0.4), counter=counter)
    limit = 0.4 * 0.1 * problem.grid.area
    forces = (0.0, 0.5, 1.0, -0.5)
    found = asp.solve(
        problem, asp.History([asp.Step(LOAD, asp.TangentialForce(0.6 * f * limit, 0.8 * f * limit)) for f in forces])
    )
    known, open_, after = (found.steps[k] for k in (1, 2, 3))
    assert math.isfinite(known.stick_slip.shift_x)
    assert "shift not determined" not in {item.criterion for item in review(known)}
    for step in (open_, after):
        assert math.isnan(step.stick_slip.shift_x)
        assert math.isnan(step.stick_slip.shift_y)
        assert step.stick_slip.twist == 0.0
        (finding,) = (item for item in review(step) if item.criterion == "shift not determined")
        assert finding.level == "warning"
    # the least shift leaves the point that slides last where it is
    assert np.count_nonzero(open_.contact & ~open_.stick_slip.slipping) <= 1
    assert open_.stick_slip.force_x == pytest.approx(0.6 * limit, rel=1e-8)
    assert np.isfinite(found.energies.tangential_work).all()
    assert np.isfinite(loop_of(found.steps).force).all()
    # the work of a known shift is that of the slip and displacement of its points
    moved = known.stick_slip.tangential_displacement - found.steps[0].stick_slip.tangential_displacement
    pixel = problem.grid.pixel_area
    work = known.stick_slip.work_by(np.full(3, np.nan), moved, pixel)
    shift = np.array(
        [getattr(known.stick_slip, n) - getattr(found.steps[0].stick_slip, n) for n in ("shift_x", "shift_y", "twist")]
    )
    assert work == pytest.approx(known.stick_slip.work_by(shift, moved, pixel), rel=1e-3)
    with refused(asp.errors.NoSolutionError, "shift"):
        asp.solve(problem, asp.Step(LOAD, asp.Shift(0.1)), state=found.state)


def test_no_contact_is_no_sliding():
    surface = rough((24, 24), 7, power=1.6)
    problem = asp.ContactProblem(surface, SOFT, friction=asp.Coulomb(0.4))
    path = asp.solve(
        problem, asp.History([asp.Step(LOAD, asp.TangentialForce()), asp.Step(asp.Unloaded(), asp.TangentialForce())])
    )
    assert not path.last.contact.any()
    assert math.isfinite(path.last.stick_slip.shift_x)
