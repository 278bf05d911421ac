"""The equation of the gap, gap = offset + displacement - profile, in every contact whose shear or
past moves the surfaces up and down."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp
from asperity.contact.controls import Control

UNLIKE = asp.Elastic(1e9, 0.2)
BALL = asp.generate.sphere(asp.Grid((24, 24), (1e-6, 1e-6)), radius=1e-4)
LOAD, MU = asp.Force(1e-3), asp.Coulomb(0.5)
RUBBER = asp.Viscoelastic.prony(1.0, ((9.0, 1.0),), 0.0)


def pressed(**options: object) -> asp.ContactProblem:
    settings = {"body": UNLIKE, "boundary": asp.Free(), "friction": MU, **options}
    return asp.ContactProblem(BALL, **settings)  # type: ignore[arg-type]


def equation(result: asp.ContactResult) -> tuple[float, float]:
    """Largest error of the equation anywhere and in contact, over the length of deflection plus
    height."""
    heights = result.problem.profile()
    gap = result.offset + result.displacement - heights + result.permanent_indentation
    touching, length = result.contact, float(np.ptp(heights)) + float(np.ptp(result.displacement))
    assert touching.any()
    return float(np.abs(gap - result.gap)[~touching].max()) / length, float(np.abs(gap[touching]).max()) / length


def rolling(control: Control, method: str = "direct") -> asp.ContactResult:
    return asp.roll(pressed(), control, asp.rolling.Creepage(5e-3), method=method, tolerance=1e-3).normal  # type: ignore[arg-type]


def rough_rolling() -> asp.ContactResult:
    line = asp.Surface(BALL.heights[:, 12:13].copy(), 1e-6, 1e-6)
    wheel = asp.ContactProblem(line, UNLIKE, boundary=asp.FreeLine(), friction=MU)
    ripple = asp.Surface(2e-8 * np.cos(np.arange(12)[:, None] * np.pi / 6.0), 1e-6, 1e-6)
    return asp.rolling.roll_rough(wheel, asp.Force(5e-5), asp.rolling.Creepage(5e-3), ripple, distance=4e-6).last.normal


CASES: dict[str, Callable[[], asp.ContactResult]] = {
    "rolling under a force": lambda: rolling(LOAD),
    "rolling at an approach": lambda: rolling(asp.Approach(2e-7)),
    "rolling at a mean gap": lambda: rolling(asp.MeanGap(3.5e-7)),
    "rolling by moves": lambda: rolling(LOAD, "transient"),
    "rough rolling": rough_rolling,
    "gross sliding": lambda: asp.solve(pressed(), LOAD),
    "sliding of layers": lambda: asp.solve(
        pressed(body=asp.Layered([asp.Layer(asp.Elastic(4e9, 0.3), 2e-6)], UNLIKE)), LOAD
    ),
    "stick and slip": lambda: asp.solve(pressed(), asp.Step(LOAD, asp.Shift(1e-7))),
    "a tangential force": lambda: asp.solve(pressed(), asp.Step(LOAD, asp.TangentialForce(2e-4))),
    "stick and slip at an approach": lambda: asp.solve(pressed(), asp.Step(asp.Approach(2e-7), asp.Shift(1e-7))),
    "hardness and stick": lambda: asp.solve(pressed(law=asp.Hardness(3e7)), asp.Step(LOAD, asp.Shift(1e-7))),
    "steady sliding": lambda: asp.slide(waved(), asp.MeanPressure(0.01), 0.3).normal,
    "transient sliding": lambda: asp.viscoelasticity.slide_in_time(waved(), asp.MeanPressure(0.01), 0.3, 0.2).last,
}


def waved() -> asp.ContactProblem:
    x = np.arange(32) / 32
    wave = asp.Surface(-0.01 * (1.0 - np.cos(2.0 * np.pi * x))[:, None], 1.0 / 32, 1.0, periodic=True)
    return asp.ContactProblem(wave, asp.Rigid(), counter_body=RUBBER)


@pytest.mark.parametrize("name", CASES)
def test_gap_is_offset_and_displacement_less_profile(name: str) -> None:
    """Beside the contact to rounding; in contact, where the gap is zero, to the tolerance of the
    normal solve (1e-8 or finer)."""
    result = CASES[name]()
    beside, inside = equation(result)
    assert beside <= 1e-13
    assert inside <= 3e-8


@pytest.mark.parametrize("control", [LOAD, asp.Approach(2e-7), asp.MeanGap(3.5e-7)], ids=str)
def test_numbers_of_rolling_unlike_bodies_are_those_of_its_fields(control: Control) -> None:
    """Approach from first touch, the control, and half of pressure times displacement; a prescribed
    approach or gap is the one reached."""
    result = rolling(control)
    assert result.control == control
    assert result.problem.surface.heights == pytest.approx(BALL.heights, rel=0.0, abs=0.0)
    assert result.approach == pytest.approx(float(BALL.heights.max()) - result.offset, rel=1e-12)
    work = 0.5 * float((result.pressure * result.displacement).sum()) * result.problem.grid.pixel_area
    assert result.elastic_energy == pytest.approx(work, rel=1e-10)
    reached = {asp.Approach: result.approach, asp.MeanGap: result.mean_gap, asp.Force: result.force}[type(control)]
    assert reached == pytest.approx(control.value, rel=1e-8)  # type: ignore[union-attr]


def test_rolling_goes_to_the_contact_of_stick_and_slip_at_an_approach() -> None:
    """Both count the approach from first touch without shear: under a creepage at which all slips
    rolling is gross sliding along x."""
    problem, control = pressed(), asp.Approach(2e-7)
    rolls = asp.roll(problem, control, asp.rolling.Creepage(10.0), tolerance=1e-5).normal
    slides = asp.solve(problem, control)
    assert rolls.force == pytest.approx(slides.force, rel=1e-4)


@pytest.mark.parametrize("way", ["stick and slip", "gross sliding", "rolling"])
def test_files_keep_the_equation(way: str, tmp_path: Path) -> None:
    problem = asp.ContactProblem(rough((16, 16), 4), asp.Elastic(0.5, 0.2), friction=MU)
    if way == "rolling":
        found: asp.ContactResult | asp.HistoryResult = rolling(LOAD)
    elif way == "gross sliding":
        found = asp.solve(problem, asp.MeanPressure(0.01))
    else:
        found = asp.solve(
            problem, asp.History([asp.Step(asp.MeanPressure(0.01 * (k + 1)), asp.Shift(3e-3 * k)) for k in range(2)])
        )
    asp.save(found, tmp_path / "r.nc")
    again = asp.load(tmp_path / "r.nc")
    for step in getattr(again, "steps", (again,)):
        beside, inside = equation(step)
        assert beside <= 1e-13
        assert inside <= 3e-8
