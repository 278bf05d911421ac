"""Fretting wear of a ball: a ring in partial slip, a scar in gross slip, and jumps over cycles."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.boundary import Free
from asperity.contact.problem import ContactProblem
from asperity.core.errors import InputError
from asperity.friction import Coulomb, Shift
from asperity.wear import Sides, WearSteps, archard, dissipated_energy, fretted

RADIUS, MODULUS, POISSON, FORCE, FRICTION = 10e-3, 210e9, 0.3, 10.0, 0.6
REDUCED = MODULUS / (1.0 - POISSON**2)
HERTZ = (3.0 * FORCE * RADIUS / (4.0 * REDUCED)) ** (1.0 / 3.0)
SLIDES = 3.0 * FRICTION * FORCE * (2.0 - POISSON) * 2.0 * (1.0 + POISSON) / (16.0 * MODULUS * HERTZ)
"""Shift (m) from which on a ball on a rigid flat slides (Mindlin 1949)."""


def ball(points: int = 32) -> ContactProblem:
    """A ball on a rigid flat with friction."""
    side = 4.0 * HERTZ
    x = (np.arange(points) - 0.5 * (points - 1)) * side / points
    heights = -(x[:, None] ** 2 + x[None] ** 2) / (2.0 * RADIUS)
    return ContactProblem(
        asp.Surface(heights, side / points), asp.Elastic(MODULUS, POISSON), boundary=Free(), friction=Coulomb(FRICTION)
    )


def test_partial_slip_wears_a_ring_around_what_sticks() -> None:
    history = fretted(ball(), asp.Force(FORCE), Shift(0.5 * SLIDES), 20000, archard(3e-15), quarter=4)
    row = history.depth[:, 16]
    assert row[15:17].max() == 0.0, "the middle sticks"
    assert row[8:14].max() > 0.0
    x = np.hypot(*(np.mgrid[:32, :32] - 15.5)) * history.last.problem.grid.spacing[0]
    worn = history.depth > 1e-3 * history.depth.max()
    # Mindlin: points stick within a (1 - Q/mu P)^(1/3); half of the shift is 1 - (1 - Q/mu P)^(2/3)
    stuck = HERTZ * math.sqrt(0.5)
    assert x[worn].min() == pytest.approx(stuck, rel=0.15)
    assert x[worn].max() == pytest.approx(HERTZ, rel=0.1)
    assert history["max_pressure"][-1] > history["max_pressure"][0], "load moves to what sticks"
    assert history.last.contact[16, 16]


def test_gross_slip_wears_a_scar_that_widens() -> None:
    """The deepest point is in the middle, the pressure falls, the contact widens, and the volume is
    k times force times slip: 4 (shift - elastic part) a cycle."""
    shift = 5.0 * SLIDES
    history = fretted(ball(), asp.Force(FORCE), Shift(shift), [1, 3000], archard(2e-14), quarter=4)
    row = history.depth[:, 16]
    assert int(row.argmax()) in (15, 16)
    assert np.all(np.diff(row[:16]) >= -1e-12)
    assert history["area_fraction"][-1] > 1.2 * history["area_fraction"][0]
    assert history["max_pressure"][-1] < 0.8 * history["max_pressure"][0]
    per_cycle = history["worn_volume"][1] / (2e-14 * FORCE)
    # slip of the points that slide all the time is 4 (shift - its elastic part), which is about
    # SLIDES 2/3 on average
    assert 4.0 * (shift - SLIDES) < per_cycle < 4.0 * shift


@pytest.mark.slow
def test_jumps_agree_with_every_cycle_within_their_error() -> None:
    problem, control, law = ball(32), asp.Force(FORCE), archard(1e-13)
    one = fretted(problem, control, Shift(3.0 * SLIDES), 24, law, quarter=4, steps=WearSteps(number=24))
    jumps = fretted(problem, control, Shift(3.0 * SLIDES), 24, law, quarter=4, steps=WearSteps(tolerance=0.05))
    assert len(jumps.course) < len(one.course)
    off = float(np.abs(jumps.depth - one.depth).sum() / one.depth.sum())
    assert off < jumps.error + one.error
    assert jumps.worn_volume == pytest.approx(one.worn_volume, rel=jumps.error + one.error)


@pytest.mark.slow
def test_both_bodies_and_energy_wear_alike() -> None:
    """Two equal bodies lose as much as one of twice the coefficient; the law of energy with alpha =
    k/mu is Archard's."""
    problem, control, shift = ball(24), asp.Force(FORCE), Shift(3.0 * SLIDES)
    steps = WearSteps(number=3)
    both = fretted(problem, control, shift, 30, Sides(archard(1e-14), archard(1e-14)), quarter=4, steps=steps)
    one = fretted(problem, control, shift, 30, archard(2e-14), quarter=4, steps=steps)
    energy = fretted(problem, control, shift, 30, dissipated_energy(2e-14 / FRICTION, FRICTION), quarter=4, steps=steps)
    assert both.depth == pytest.approx(one.depth, rel=1e-6, abs=1e-15)
    assert energy.depth == pytest.approx(one.depth, rel=1e-12, abs=1e-18)
    assert both.body_depth == pytest.approx(both.counter_depth, rel=1e-12)


@pytest.mark.slow
def test_it_goes_on_as_without_a_break() -> None:
    problem, control, law, shift = ball(24), asp.Force(FORCE), archard(1e-13), Shift(3.0 * SLIDES)
    whole = fretted(problem, control, shift, [10, 30], law, quarter=4)
    first = fretted(problem, control, shift, 10, law, quarter=4)
    second = fretted(problem, control, shift, 30, law, quarter=4, state=first.state)
    assert second["cycles"][-1] == 30.0
    # the first cycle after a break is solved anew, from the end of the last
    assert second.depth == pytest.approx(whole.depth, rel=0.05, abs=0.01 * float(whole.depth.max()))


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"cycles": 0}, "number of cycles"),
        ({"cycles": [3, 2]}, "numbers of cycles"),
        ({"shift": Shift(0.0)}, "shift of a cycle"),
        ({"problem": ball(24).with_physics(friction=None)}, "friction of a problem that frets"),
        ({"steps": WearSteps(order=2)}, "jumps of cycles"),
        ({"wear": Sides(archard(1e-15), body_track=1.0)}, "sides that fret"),
    ],
)
def test_what_cannot_fret_is_refused(change: dict[str, object], subject: str) -> None:
    given = {
        "problem": ball(24),
        "control": asp.Force(FORCE),
        "shift": Shift(1e-7),
        "cycles": 10,
        "wear": archard(1e-15),
    }
    with refused(InputError, subject):
        fretted(**given | change)  # type: ignore[arg-type]


def test_slides_is_the_shift_at_which_all_points_slide() -> None:
    """The shift by which the tests count is that of Mindlin's theory."""
    assert math.isclose(SLIDES, 3 * FRICTION * FORCE * (2 - POISSON) / (16 * MODULUS / (2 * (1 + POISSON)) * HERTZ))
