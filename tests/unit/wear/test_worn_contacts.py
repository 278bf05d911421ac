"""Contacts that wear: a ball, a coating worn through, tracks, two materials, hardness, friction;
volumes, restarts, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.boundary import Free
from asperity.contact.controls import Step
from asperity.contact.problem import ContactProblem
from asperity.contact.solve import Prepared
from asperity.core.errors import ConvergenceError, InputError
from asperity.physics.wear.losses import Losses
from asperity.physics.wear.stage import Stretch, implicit_stage
from asperity.solids.layers import Layer, Layered
from asperity.wear import Sides, WearSteps, archard, worn

RADIUS, MODULUS, FORCE = 3e-3, 110e9, 10.0
HERTZ = (3.0 * FORCE * RADIUS / (4.0 * MODULUS)) ** (1.0 / 3.0)


def ball(points: int = 48, side: float = 6e-4, body: asp.Elastic | Layered | None = None) -> ContactProblem:
    """A ball of reduced modulus ``MODULUS`` on a rigid flat."""
    x = (np.arange(points) - 0.5 * (points - 1)) * side / points
    heights = -(x[:, None] ** 2 + x[None] ** 2) / (2.0 * RADIUS)
    return ContactProblem(asp.Surface(heights, side / points), body or asp.Elastic(MODULUS, 0.0), boundary=Free())


def rough(points: int = 64, **given: object) -> ContactProblem:
    """A self-affine surface of steel, coated."""
    side = 4e-6
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(10e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=250e-9
    )
    surface = asp.generate.gaussian(asp.Grid((points, points), (side / points,) * 2), waves, seed=4)
    body = Layered([Layer(asp.Elastic(300e9, 0.2), 100e-9)], asp.Elastic(210e9, 0.3))
    return ContactProblem(surface, body, **given)  # type: ignore[arg-type]


def test_a_ball_runs_in_to_uniform_pressure() -> None:
    """a⁴ = a_H⁴ + 4 R k P s/pi for uniform pressure, which is right from 1.5 a_H on (handbook,
    transport, section 10); the volume is k P s."""
    law, distances = archard(1e-15), [1.0, 10.0, 30.0]
    history = worn(ball(), asp.Force(FORCE), distances, law)
    assert history.worn_volume == pytest.approx(1e-15 * FORCE * 30.0, rel=1e-12)
    assert history.dose_balance < 1e-12
    for distance, result in history.kept[2:]:
        radius = math.sqrt(result.contact_area / math.pi)
        wanted = (HERTZ**4 + 4.0 * RADIUS * 1e-15 * FORCE * distance / math.pi) ** 0.25
        # half a pixel in the radius, and the error of the steps
        assert radius == pytest.approx(wanted, abs=0.5 * result.problem.grid.spacing[0])
        assert result.force == pytest.approx(FORCE)
    pressure = history.last.pressure
    inner = pressure[pressure > 0.0]
    assert np.median(inner) == pytest.approx(float(inner.mean()), rel=0.05)
    assert history["max_pressure"][-1] < 0.1 * history["max_pressure"][0]


def test_what_the_checks_of_worn_surfaces_find_is_the_contact_of_the_step() -> None:
    """The contact of the worn surfaces, solved without any wear, is that of the implicit step."""
    history = worn(ball(), asp.Force(FORCE), 1.0, archard(1e-15), steps=WearSteps(number=3))
    alone = asp.solve(history.last.problem, asp.Force(FORCE))
    # both to a relative error of 1e-7 of the energy: the pressure to the root of that
    assert history.last.pressure == pytest.approx(alone.pressure, abs=1e-3 * alone.max_pressure)
    assert history.last.approach == pytest.approx(alone.approach, rel=1e-5)


def test_steps_hand_on_the_displacement_of_the_bodies() -> None:
    """What the contact of a step hands on to that of the worn surfaces is the product of the bodies
    alone with its pressure, where a coating wears through, too: what is worn is taken off."""
    problem, law = rough(), archard(3e-12, layers=[(3e-9, 1e-12)])
    losses, prepared = Losses.of(Sides(body=law), problem.grid), Prepared(problem)
    virgin, control = losses.virgin(), Step(asp.MeanPressure(5e7))
    first = prepared.step(control)
    worn_by = losses.after(virgin, first.pressure, 20e-6)
    stage = implicit_stage(prepared, control, first.state, losses, Stretch(virgin, worn_by, 20e-6))
    depth = losses.hollow(losses.after(worn_by, stage.pressure, 20e-6))
    assert np.unique(law.stage(losses.after(worn_by, stage.pressure, 20e-6).body)).size == 2, "in both materials"
    wanted = prepared.operator.apply(stage.pressure)
    # rounding of the product, and of the depth that is added and taken off
    atol = 1e-13 * (np.abs(wanted).max() + depth.max())
    np.testing.assert_allclose(stage.deflection, wanted, rtol=0.0, atol=atol)


def test_a_coating_wears_through_in_the_middle_first() -> None:
    """Behind the break-through the coating bears most: pressures of both materials tend to the
    inverse of their coefficients."""
    law = archard(1e-14, layers=[(0.5e-6, 1e-15)])
    history = worn(ball(), asp.Force(FORCE), 6.0, law, steps=WearSteps(tolerance=0.1))
    assert math.isfinite(history.breakthrough)
    bare = history.depth > law.thickness
    assert bare[24, 24]
    assert not bare[0].any()
    before = worn(ball(), asp.Force(FORCE), history.breakthrough, law, steps=WearSteps(tolerance=0.1))
    assert before["max_depth"][-1] == pytest.approx(law.thickness, rel=history.error + before.error)
    assert before.breakthrough == pytest.approx(history.breakthrough, rel=history.error + before.error) or math.isnan(
        before.breakthrough
    )
    touching = history.last.contact
    pressure = history.last.pressure
    ratio = float(pressure[touching & ~bare].mean() / pressure[touching & bare].mean())
    assert 2.0 < ratio < 10.0
    # each pixel has lost what its dose says, also where it changed its material within a step
    state = history.state
    assert state is not None
    assert state.doses.body is not None
    assert history.body_depth == pytest.approx(law.depth(state.doses.body))
    assert history["bare_fraction"][-1] > 0.0
    assert history["bare_fraction"][0] == 0.0


def test_until_bare_ends_with_the_break_through() -> None:
    law = archard(1e-14, layers=[(0.5e-6, 1e-15)])
    history = worn(ball(), asp.Force(FORCE), 100.0, law, until_bare=True, steps=WearSteps(tolerance=0.1))
    assert history.breakthrough <= history["distance"][-1] < 100.0
    assert history["bare_fraction"][-2] == 0.0


def test_two_materials_share_the_pressure_by_their_coefficients() -> None:
    """p_i k_i are equal once a surface wears alike everywhere; p_i = mean p (1/k_i) / sum f_j/k_j.

    Stripes of a flat surface in full contact: the ends between them bend, so that means over them
    are compared after many decay times of the stripes.
    """
    n, side = 32, 1.0
    factor = np.ones((n, n))
    factor[: n // 4] = 4.0
    flat = ContactProblem(asp.Surface(np.zeros((n, n)), side / n, periodic=True), asp.Elastic(1.0, 0.3))
    law = archard(1.0, factor=factor)
    history = worn(flat, asp.MeanPressure(1e-4), 200.0, law, steps=WearSteps(number=30))
    mean = 1e-4 / (0.25 / 4.0 + 0.75)
    pressure = history.last.pressure
    assert pressure[: n // 4] == pytest.approx(np.full((n // 4, n), mean / 4.0), rel=1e-3)
    assert pressure[n // 4 :] == pytest.approx(np.full((n - n // 4, n), mean), rel=1e-3)


def test_a_track_wears_alike_along_x_by_the_mean_pressure() -> None:
    """Ball and track of the same coefficient lose the same volume, the track all along its
    length."""
    length, distance = 0.05, 5.0
    sides = Sides(body=archard(1e-15), counter=archard(1e-15), counter_track=length)
    history = worn(ball(), asp.Force(FORCE), distance, sides)
    volume = 1e-15 * FORCE * distance
    assert (history["body_volume"][-1], history["counter_volume"][-1]) == pytest.approx((volume, volume), rel=1e-12)
    assert np.ptp(history.counter_depth, axis=0).max() == 0.0
    section = float(history.counter_depth[0].sum()) * history.last.problem.grid.spacing[1]
    assert section == pytest.approx(volume / length, rel=1e-12)
    assert history.counter_depth.max() < 0.02 * history.body_depth.max()


def test_a_short_track_wears_as_much_as_the_body_at_any_length_of_steps() -> None:
    """A track as long as the contact, in which every point is under the mean pressure all the time:
    explicit steps would be unstable, implicit ones end at a flat track."""
    n, side = 32, 1.0
    y = np.arange(n) * side / n
    heights = np.repeat(1e-4 * np.cos(2.0 * math.pi * y)[None], n, axis=0)
    problem = ContactProblem(asp.Surface(heights, side / n, periodic=True), asp.Elastic(1.0, 0.3))
    sides = Sides(counter=archard(1.0), counter_track=side)
    history = worn(problem, asp.MeanPressure(1e-2), 20.0, sides, steps=WearSteps(number=5))
    alone = worn(problem, asp.MeanPressure(1e-2), 20.0, archard(1.0), steps=WearSteps(number=5))
    assert history.last.problem.profile() == pytest.approx(alone.last.problem.profile(), abs=1e-9)


def test_points_below_the_threshold_do_not_wear() -> None:
    law = archard(1e-15, threshold_pressure=0.5e9)
    history = worn(ball(), asp.Force(FORCE), 50.0, law)
    assert math.isnan(history.dose_balance)
    rate = history.wear_rate
    assert rate[-1] < 0.02 * rate[0]
    assert history["max_pressure"][-1] == pytest.approx(0.5e9, rel=0.1)


def test_pressure_stays_below_the_hardness_and_the_base_has_its_own() -> None:
    """Where the coating is gone the hardness is that of the base."""
    soft = asp.Elastic(210e9, 0.3, strength=asp.solids.Strength(hardness=3e9))
    body = Layered([Layer(asp.Elastic(300e9, 0.2), 100e-9)], soft)
    plain = rough()
    problem = ContactProblem(plain.surface, body, law=asp.Hardness(6e9))
    law = archard(3e-15, layers=[(5e-9, 1e-15)])
    history = worn(problem, asp.MeanPressure(300e6), 0.2, law, steps=WearSteps(tolerance=0.2))
    assert history.converged
    last, bare = history.last, history.depth > 5e-9
    assert bare.any()
    assert last.pressure.max() <= 6e9
    assert last.pressure[bare].max() <= 3e9
    assert history["max_pressure"][0] == pytest.approx(6e9)


def test_gross_sliding_goes_along() -> None:
    """Unlike bodies under friction: every step balances shear and normal contact."""
    problem = rough(friction=asp.friction.Coulomb(0.3))
    history = worn(problem, asp.MeanPressure(200e6), 0.01, archard(1e-15), steps=WearSteps(number=3))
    assert history.converged
    alone = asp.solve(history.last.problem, asp.MeanPressure(200e6))
    assert history.last.pressure == pytest.approx(alone.pressure, abs=2e-3 * alone.max_pressure)
    assert history.dose_balance < 1e-9


def test_a_history_goes_on_as_without_a_break() -> None:
    """To the bit, from the state in memory."""
    problem, control, law = rough(), asp.MeanPressure(200e6), archard(3e-15, layers=[(5e-9, 1e-15)])
    whole = worn(problem, control, [0.01, 0.03], law)
    first = worn(problem, control, 0.01, law)
    second = worn(problem, control, 0.03, law, state=first.state)
    assert np.array_equal(second.depth, whole.depth)
    assert np.array_equal(second.last.pressure, whole.last.pressure)
    assert second["distance"].tolist() == whole["distance"][whole["distance"] >= 0.01].tolist()
    assert second.breakthrough == whole.breakthrough or math.isnan(whole.breakthrough)


def test_a_thinned_coating_changes_the_compliance() -> None:
    """A stiff coating worn to less than half: the compliance is that of what is left, and says so
    where it is uneven."""
    body = Layered([Layer(asp.Elastic(1000e9, 0.2), 4e-6)], asp.Elastic(MODULUS, 0.0))
    problem = ball(body=body)
    history = worn(problem, asp.Force(FORCE), 30.0, archard(1e-15))
    left = history.last.problem.body
    assert isinstance(left, Layered)
    pressure = history.last.pressure
    # what is worn below a point that is bare was none of the coating
    mean = float((np.minimum(history.depth, 4e-6) * pressure).sum() / pressure.sum())
    # refreshed at every twentieth of the thickness
    assert 4e-6 - left.thickness == pytest.approx(mean, abs=0.05 * 4e-6)
    assert history.unevenness > 0.0
    assert 0.0 < history.compliance_error < 0.2


def test_steps_that_are_too_few_say_so() -> None:
    with pytest.raises(ConvergenceError) as caught:
        worn(ball(), asp.Force(FORCE), 30.0, archard(1e-15), steps=WearSteps(most=2))
    history = caught.value.result
    assert len(history.course) == 3
    assert not history.converged


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        (lambda: worn(ball(), asp.Force(FORCE), [1.0, 0.5], archard(1e-15)), "sliding distances (m)"),
        (lambda: worn(ball(), asp.Force(FORCE), -1.0, archard(1e-15)), "sliding distances (m)"),
        (lambda: worn(ball(), asp.Force(FORCE), [], archard(1e-15)), "sliding distances"),
        (lambda: worn(ball(), 1e5, 1.0, archard(1e-15)), "control of a contact that wears"),  # type: ignore[arg-type]
        (lambda: worn(ball(), asp.Force(FORCE), 1.0, 1e-15), "wear"),  # type: ignore[arg-type]
        (
            lambda: worn(
                rough(adhesion=asp.ExponentialAdhesion(0.05, 1e-9)), asp.MeanPressure(1e6), 1.0, archard(1e-15)
            ),
            "physics of a contact that wears",
        ),
        (
            lambda: worn(ball(), asp.Force(FORCE), 1.0, archard(1e-15, factor=np.ones((2, 2)))),
            "factor on the wear coefficient of the body",
        ),
        (
            lambda: worn(ball(), asp.Force(FORCE), 1.0, Sides(counter=archard(1e-15), counter_track=1e-6)),
            "length of the track of the counter (m)",
        ),
        (lambda: WearSteps(order=2, method="explicit"), "explicit steps of wear"),
        (lambda: WearSteps(order=3), "order of the steps of wear"),  # type: ignore[arg-type]
        (lambda: WearSteps(tolerance=2.0), "tolerance of the steps of wear"),
    ],
)
def test_what_cannot_wear_is_refused(change: object, subject: str) -> None:
    with refused(InputError, subject):
        change()  # type: ignore[operator]
