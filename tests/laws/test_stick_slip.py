"""Laws of stick and slip: limits, symmetries, memory of the path, work, refusals."""

from dataclasses import replace

import numpy as np
import pytest
from contact_cases import rough
from hypothesis import given, settings
from hypothesis import strategies as st

import asperity as asp
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.friction.solver.newton import StickSlipNewton
from asperity.physics.friction.solver.problem import TangentialQP
from asperity.physics.friction.stick_slip import SERVES
from asperity.solvers import ActiveSet

TIGHT = {"solver": ActiveSet(tolerance=1e-12), "rounds": asp.solvers.Rounds(tolerances={"stick_slip": 1e-9})}
SOFT = asp.Elastic(1.0, 0.3)
COATED = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.25), 1.5)], base=asp.Elastic(1.0, 0.3))
LOAD = asp.MeanPressure(0.1)
MU = 0.4


def posed(body=SOFT, friction=asp.Coulomb(MU), **options):
    """Problem of a rough surface on 24 x 24 points."""
    return asp.ContactProblem(rough((24, 24), 7, power=1.6), body, friction=friction, **options)


def solved(problem, *steps, **options):
    return asp.solve(problem, asp.History(steps), **{**TIGHT, **options})


PRESSED = asp.Step(LOAD, asp.Shift())
SHIFTED = asp.Step(LOAD, asp.Shift(0.2, 0.1))
SLID = asp.Step(LOAD, asp.Shift(5e5))


def test_large_shifts_slide_everything_as_gross_sliding_does():
    problem = posed()
    last = solved(problem, SLID).last
    gross = asp.solve(problem, LOAD, solver=ActiveSet(tolerance=1e-13))
    assert last.stick_slip.slipping[last.contact].all()
    assert np.linalg.norm(last.pressure - gross.pressure) <= 1e-5 * np.linalg.norm(gross.pressure)
    # the traction follows the slip, which at points turns a little out of the direction of the
    # shift
    assert last.stick_slip.force_x == pytest.approx(last.stick_slip.friction_limit, rel=1e-3)


def test_small_friction_leaves_the_frictionless_contact_and_large_friction_sticks():
    bare = asp.solve(posed(friction=None), LOAD, solver=ActiveSet(tolerance=1e-12))
    slippery = solved(posed(friction=asp.Coulomb(1e-7)), SHIFTED).last
    assert np.linalg.norm(slippery.pressure - bare.pressure) <= 1e-6 * np.linalg.norm(bare.pressure)
    rough_, stuck = (solved(posed(friction=law), SHIFTED).last for law in (asp.Coulomb(1e6), asp.friction.FullStick()))
    assert not stuck.stick_slip.slipping.any()
    difference = rough_.stick_slip.traction - stuck.stick_slip.traction
    assert np.linalg.norm(difference) <= 1e-5 * np.linalg.norm(stuck.stick_slip.traction)


def test_a_quarter_turn_turns_everything():
    """(x, y) → (y, -x): the surface, the shift, and hence traction and slip."""
    problem = posed()
    turned = replace(problem, surface=asp.Surface(np.rot90(problem.surface.heights).copy(), 1.0, 1.0, periodic=True))
    first = solved(problem, SHIFTED).last
    # rot90 takes the point (i, j) to (n - 1 - j, i): x' = -y, y' = x
    other = solved(turned, asp.Step(LOAD, asp.Shift(-0.1, 0.2))).last
    scale = np.abs(first.stick_slip.traction).max()
    assert np.abs(np.rot90(first.stick_slip.traction[0]) - other.stick_slip.traction[1]).max() <= 1e-6 * scale
    assert np.abs(np.rot90(first.stick_slip.traction[1]) + other.stick_slip.traction[0]).max() <= 1e-6 * scale


def test_a_mirror_reverses_one_component():
    problem = posed(COATED)
    mirrored = replace(problem, surface=asp.Surface(problem.surface.heights[::-1].copy(), 1.0, 1.0, periodic=True))
    first = solved(problem, SHIFTED).last.stick_slip
    other = solved(mirrored, asp.Step(LOAD, asp.Shift(-0.2, 0.1))).last.stick_slip
    scale = np.abs(first.traction).max()
    assert np.abs(first.traction[0][::-1] + other.traction[0]).max() <= 1e-6 * scale
    assert np.abs(first.traction[1][::-1] - other.traction[1]).max() <= 1e-6 * scale


def test_exchanged_bodies_and_opposite_shift_give_the_opposite_traction():
    """Seen from the other body the coupling changes its sign, and so does the traction that acts on
    it."""
    stiff = asp.Elastic(5.0, 0.1)
    first = solved(posed(SOFT, counter_body=stiff), SHIFTED).last
    other = solved(posed(stiff, counter_body=SOFT), asp.Step(LOAD, asp.Shift(-0.2, -0.1))).last
    assert np.linalg.norm(first.pressure - other.pressure) <= 1e-6 * np.linalg.norm(first.pressure)
    total = first.stick_slip.traction + other.stick_slip.traction
    assert np.linalg.norm(total) <= 1e-5 * np.linalg.norm(first.stick_slip.traction)


@settings(max_examples=10, deadline=None)
@given(length=st.floats(1e-12, 1e6), modulus=st.floats(1e-6, 1e13))
def test_lengths_and_moduli_scale(length, modulus):
    """Heights, pixels and shift together with moduli and load: tractions scale with the modulus."""
    first = solved(posed(), SHIFTED).last.stick_slip
    surface = rough((24, 24), 7, power=1.6)
    scaled = asp.ContactProblem(
        asp.Surface(surface.heights * length, length, length, periodic=True),
        asp.Elastic(modulus, 0.3),
        friction=asp.Coulomb(MU),
    )
    step = asp.Step(asp.MeanPressure(0.1 * modulus), asp.Shift(0.2 * length, 0.1 * length))
    other = solved(scaled, step).last.stick_slip
    assert np.linalg.norm(other.traction / modulus - first.traction) <= 1e-6 * np.linalg.norm(first.traction)


@pytest.mark.parametrize(("body", "tolerance"), [(asp.Elastic(1.0, 0.0), 1e-7), (COATED, 0.03)], ids=["nu 0", "coated"])
def test_a_closed_cycle_returns(body, tolerance):
    """Return-point memory: after a smaller cycle the tractions are those before it; every increment
    of work is >= 0.

    Exact where tractions are along the shift (ν = 0); else slip turns within a step, of which
    implicit steps make an error.
    """
    mirror = posed(body, counter_body=body)
    shifts = (0.3, 0.0, 0.3, -0.3, 0.3)
    found = solved(mirror, PRESSED, *(asp.Step(LOAD, asp.Shift(x)) for x in shifts))
    start, after, later = (found.steps[k].stick_slip for k in (1, 3, 5))
    scale = np.abs(start.traction).max()
    assert np.abs(after.traction - start.traction).max() <= tolerance * scale
    assert np.abs(later.traction - start.traction).max() <= tolerance * scale
    for step in found.steps:
        assert step.stick_slip.dissipation_density.min() >= 0.0
        assert step.stick_slip.total_dissipated >= step.stick_slip.dissipated


def test_the_law_holds_at_every_point():
    last = solved(posed(COATED), PRESSED, SHIFTED).last
    shear = last.stick_slip
    bound = MU * last.pressure
    size = np.hypot(*shear.traction)
    assert np.all(size <= bound * (1.0 + 1e-9))
    slips = shear.slipping
    assert slips.any()
    assert (last.contact & ~slips).any()
    along = np.einsum("kij,kij->ij", shear.traction, shear.slip_increment)[slips]
    assert along == pytest.approx((bound * np.hypot(*shear.slip_increment))[slips], rel=1e-5)
    assert shear.duality_gap <= 1e-9
    assert abs(shear.complementarity) <= 1e-6
    (check,) = (item for item in last.certificate.couplings if item.name == "stick_slip")
    assert check.residual <= 1e-9
    assert 0.0 < check.rate < 0.5


def test_histories_go_on_from_a_state_and_do_not_depend_on_threads():
    problem, steps = posed(COATED), (PRESSED, SHIFTED, asp.Step(asp.MeanPressure(0.12), asp.Shift(-0.1, 0.1)))
    whole = solved(problem, *steps).last
    first = solved(problem, *steps[:2])
    second = solved(problem, steps[2], state=first.state).last
    assert np.array_equal(whole.stick_slip.traction, second.stick_slip.traction)
    assert np.array_equal(whole.pressure, second.pressure)
    two = solved(problem, *steps, engine=asp.engines.CpuEngine(threads=2)).last
    scale = np.abs(whole.stick_slip.traction).max()
    assert np.abs(whole.stick_slip.traction - two.stick_slip.traction).max() <= 1e-9 * scale


def test_a_step_without_tangential_control_keeps_what_was_prescribed():
    problem = posed()
    by_shift = solved(problem, SHIFTED, asp.Step(asp.MeanPressure(0.12))).last.stick_slip
    assert (by_shift.shift_x, by_shift.shift_y) == (0.2, 0.1)
    limit = 0.1 * MU * problem.grid.area
    held = solved(problem, asp.Step(LOAD, asp.TangentialForce(0.5 * limit)), asp.Step(asp.MeanPressure(0.12))).last
    assert held.stick_slip.force_x == pytest.approx(0.5 * limit, rel=1e-10)
    assert held.stick_slip.force_y == pytest.approx(0.0, abs=1e-10 * limit)


def test_prescribed_forces_up_to_the_limit():
    problem = posed(counter_body=SOFT)
    limit = 0.1 * MU * problem.grid.area
    for share in (
        0.99,
        0.999,
        0.9999,
        0.99999,
        0.999999,
    ):  # few points stick, and they alone say how far the others have slipped
        near = solved(problem, asp.Step(LOAD, asp.TangentialForce(0.0, share * limit))).last.stick_slip
        assert near.force_y == pytest.approx(share * limit, rel=1e-10)
        assert near.duality_gap <= 1e-9
    at_limit = solved(problem, asp.Step(LOAD, asp.TangentialForce(0.0, limit))).last.stick_slip
    assert at_limit.slipping[at_limit.traction_magnitude > 0.0].mean() > 0.99
    assert at_limit.force_y == pytest.approx(limit, rel=1e-9)
    with pytest.raises(asp.errors.NoSolutionError) as refused:
        solved(problem, asp.Step(LOAD, asp.TangentialForce(1.01 * limit)))
    assert "tangential force" in refused.value.subject


@pytest.mark.parametrize(("seed", "points"), [(3, 48), (5, 24), (5, 48)])
def test_forces_just_below_the_limit_settle(seed, points):
    """Surfaces on which neither the mean residual of the few sticking points nor the duality gap
    alone finds the shift."""
    problem = asp.ContactProblem(
        rough((points, points), seed, power=1.6), SOFT, counter_body=SOFT, friction=asp.Coulomb(MU)
    )
    limit = 0.1 * MU * problem.grid.area
    force = asp.TangentialForce(0.6 * 0.999 * limit, 0.8 * 0.999 * limit)
    assert asp.solve(problem, asp.Step(LOAD, force)).stick_slip.duality_gap <= 1e-6


def test_a_strength_that_begins_at_once_may_leave_no_solution():
    """Unlike bodies pressed and shifted at once: most settle; where a point opens under its own
    shear, the message says so."""
    settles = posed(friction=asp.friction.TrescaFriction(0.03))
    assert asp.solve(settles, asp.Step(LOAD, asp.Shift(2.0))).converged
    has_none = posed(friction=asp.friction.TrescaFriction(0.05))
    result = asp.solve(has_none, asp.Step(LOAD, asp.Shift()), on_failure="return")
    assert not result.converged
    assert "1 point" in result.status.message
    begins_at_zero = posed(friction=asp.Coulomb(10.0, limit=0.05))
    assert asp.solve(begins_at_zero, asp.Step(LOAD, asp.Shift())).converged


def test_a_map_of_friction_and_a_limit_bound_the_traction():
    rng = np.random.default_rng(0)
    coefficients = rng.uniform(0.1, 0.5, (24, 24))
    mapped = solved(posed(friction=asp.Coulomb(coefficients)), SHIFTED).last
    assert np.all(mapped.stick_slip.traction_magnitude <= coefficients * mapped.pressure * (1.0 + 1e-9))
    limited = solved(posed(friction=asp.Coulomb(MU, limit=0.02)), SLID).last
    expected = np.minimum(MU * limited.pressure, 0.02)
    assert limited.stick_slip.traction_magnitude == pytest.approx(expected, rel=1e-9, abs=1e-15)
    tresca = solved(posed(friction=asp.friction.TrescaFriction(0.02)), SLID).last
    assert tresca.stick_slip.traction_magnitude[tresca.contact] == pytest.approx(0.02, rel=1e-9)


def test_the_goodman_simplification_leaves_the_pressure():
    """Coulomb(coupled=False): shear follows the pressure, and leaves it."""
    bare = asp.solve(posed(friction=None), LOAD, solver=ActiveSet(tolerance=1e-12))
    simple = solved(posed(friction=asp.Coulomb(MU, coupled=False)), SHIFTED).last
    assert np.array_equal(simple.pressure, bare.pressure)
    assert simple.stick_slip.force_x > 0.0


def test_menisci_hardness_and_stick_slip_in_one_solve():
    surface = rough((24, 24), 7, power=1.6)
    surface = asp.Surface(surface.heights * 1e-9, 5e-9, 5e-9, periodic=True)
    body = asp.Elastic(100e9, 0.3)
    film = asp.LiquidFilm(surface_tension=0.072, thickness=0.5e-9)
    problem = asp.ContactProblem(surface, body, law=asp.Hardness(8e9), film=film, friction=asp.Coulomb(0.3))
    steps = [asp.Step(asp.MeanPressure(5e8), asp.Shift(0.1e-9 * k)) for k in range(3)]
    last = asp.solve(problem, asp.History(steps)).last
    assert last.converged
    assert last.menisci is not None
    assert last.menisci.meniscus_force > 0.0
    assert last.pressure.max() <= 8e9 * (1.0 + 1e-9)
    assert np.all(last.stick_slip.traction_magnitude <= 0.3 * last.pressure * (1.0 + 1e-6))


@pytest.mark.parametrize(
    ("problem", "step"),
    [
        ({"friction": None}, SHIFTED),
        ({}, asp.Step(LOAD, asp.Shift(twist=0.1))),
        ({"friction": asp.Coulomb(np.ones((3, 3)))}, SHIFTED),
        (
            {"body": asp.Layered([asp.Layer(SOFT, 1.0, asp.Frictionless())], base=SOFT)},
            SHIFTED,
        ),
    ],
    ids=["no friction", "twist of a periodic contact", "map of another shape", "layers that slip"],
)
def test_what_has_no_meaning_is_refused(problem, step):
    with pytest.raises(asp.InputError):
        asp.solve(posed(**problem), step)


@pytest.mark.slow
def test_random_problems_converge():
    """Bounds over ten decades, shifts, forces and fields on all kinds of bodies."""
    rng, failed = np.random.default_rng(11), []
    bodies = (SOFT, COATED, asp.Elastic(1.0, 0.0), asp.Elastic(1.0, 0.499))
    for case in range(200):
        shape = (int(rng.integers(4, 40)), int(rng.integers(1, 40)))
        boundary = asp.Periodic() if shape[1] == 1 or rng.random() < 0.5 else asp.Free()
        grid = asp.Grid(shape, (1.0, float(rng.uniform(0.5, 2.0))))
        operator = TangentialOperator(grid, (bodies[case % 4], asp.Rigid()), boundary)
        bound = np.where(rng.random(shape) < rng.uniform(0.05, 1.0), 10.0 ** rng.uniform(-5, 5, shape), 0.0)
        target = rng.standard_normal((2, 1, 1)) * 10.0 ** rng.uniform(-4, 4) + np.zeros((2, *shape))
        target += rng.standard_normal((2, *shape)) * 10.0 ** rng.uniform(-6, 2)
        mean = None
        if rng.random() < 0.4 and bound.any():
            angle = rng.uniform(0, 2 * np.pi)
            mean = bound.mean() * rng.uniform(0.0, 0.99) * np.array([np.cos(angle), np.sin(angle)])
        found = StickSlipNewton(tolerance=1e-8).solve(TangentialQP(operator, bound, target, mean))
        if not found.status.converged:
            failed.append((case, found.deviation.error))
    assert failed == []


def pressed(law: asp.Coulomb | asp.friction.FullStick, points: int = 24) -> asp.HistoryResult:
    """A rigid sphere of unit radius pressed in twelve steps on a body of Poisson's ratio zero,
    whose shear lifts the edge most."""
    places = (np.arange(points) - (points - 1) / 2) * 0.24 / points
    sphere = asp.Surface(-(places[:, None] ** 2 + places**2) / 2, 0.24 / points, periodic=False)
    problem = asp.ContactProblem(sphere, asp.Elastic(1.0, 0.0), boundary=asp.Free(), friction=law)
    loads = 4 / 3 * 0.1**3 * np.arange(1, 13) / 12
    return asp.solve(problem, asp.History([asp.Step(asp.Force(load), asp.Shift()) for load in loads]))


def test_full_stick_without_solution_names_the_friction_that_serves():
    """Points at the edge open by the shear that they would bear: the error says so and which
    Coulomb's law stands for it."""
    with pytest.raises(asp.ConvergenceError) as caught:
        pressed(asp.friction.FullStick())
    assert f"Coulomb({SERVES:g})" in str(caught.value)
    last = pressed(asp.Coulomb(SERVES)).last
    assert last.converged
    slipping = last.stick_slip.slipping
    assert 0 < slipping.sum() < 0.2 * last.contact.sum()
    assert abs(last.force - 4 / 3 * 0.1**3) <= 1e-8 * last.force
