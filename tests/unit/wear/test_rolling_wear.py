"""Wear by creepage: where it slips, as much as the heat says; and of the shape that is worn."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.run.build import build
from asperity.run.document import checked
from asperity.run.stored import load_outcome, save_outcome
from asperity.wear import Sides, WearSteps, archard, dissipated_energy, rolled, worn_by_rolling


def rolling(direction: str = "x") -> asp.rolling.RollingContact:
    """A ball that rolls with some creepage across and along."""
    n, radius, contact, friction = 32, 1.0, 0.1, 0.3
    spacing = 2.3 * contact / n
    x = (np.arange(n) - 0.5 * (n - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2 + x[None] ** 2) / (2.0 * radius), spacing)
    body = asp.Elastic(1.0, 0.3)
    problem = asp.ContactProblem(
        surface, body, counter_body=body, boundary=asp.Free(), friction=asp.friction.Coulomb(friction)
    )
    load = asp.Force(4.0 / 3.0 * problem.contact_modulus * contact**3 / radius)
    return asp.roll(problem, load, asp.rolling.Creepage(8e-3, 3e-3), direction=direction)


def test_the_volume_is_that_of_the_heat() -> None:
    """mu p s is the heat per area and distance rolled: V = k/mu times it, whatever the
    circumference."""
    found = rolling()
    heat = float(found.power_density.sum()) * found.normal.problem.grid.pixel_area
    for circumference in (2.0, 5.0):
        worn = rolled(found, archard(1e-9), 100.0, circumference)
        assert worn.volume == pytest.approx(1e-9 / 0.3 * heat * 100.0, rel=1e-9)
        assert worn.passages == pytest.approx(100.0 / circumference)
    energy = rolled(found, dissipated_energy(1e-9 / 0.3, 0.3), 100.0, 2.0)
    assert energy.depth == pytest.approx(rolled(found, archard(1e-9), 100.0, 2.0).depth)


def test_what_sticks_does_not_wear_and_the_way_is_that_of_rolling() -> None:
    """Lines along the direction of rolling on which no point slips keep their height; the profile
    is across."""
    along_x = rolled(rolling(), archard(1e-9), 100.0, 2.0)
    along_y = rolled(rolling("y"), archard(1e-9), 100.0, 2.0)
    assert along_x.depth[[0, -1]].tolist() == [0.0, 0.0]
    assert along_x.depth[len(along_x.depth) // 2] > 0.0
    assert along_x.across == pytest.approx(-along_x.across[::-1])
    assert along_y.depth.shape == along_x.depth.shape
    assert along_y.volume != along_x.volume, "the creepage along x is across now"


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"distance": 0.0}, "distance rolled (m)"),
        ({"circumference": -1.0}, "circumference of a rolling body (m)"),
        ({"law": archard(1e-15, threshold_pressure=1.0)}, "law of wear of a rolling body"),
        ({"law": 1e-15}, "law of wear of a rolling body"),
    ],
)
def test_what_does_not_wear_by_rolling_is_refused(change: dict[str, object], subject: str) -> None:
    given = {"contact": rolling(), "law": archard(1e-15), "distance": 1.0, "circumference": 1.0}
    with refused(InputError, subject):
        rolled(**given | change)  # type: ignore[arg-type]


# The worn shape rolls on.

CREEPAGE = asp.rolling.Creepage(8e-3, 3e-3)


def balls(body: asp.Elastic | asp.Layered | None = None) -> tuple[asp.ContactProblem, asp.Force]:
    """The same ball, to be solved."""
    normal = rolling().normal
    problem = normal.problem.with_physics(friction=asp.friction.Coulomb(0.3))
    return problem if body is None else replace(problem, body=body), asp.Force(normal.force)


def test_one_step_is_that_of_the_shape_as_it_is() -> None:
    """V = k s ∫∫ p |slip| to rounding, of each body."""
    problem, load = balls()
    sides = Sides(archard(1e-9), archard(3e-9))
    history = worn_by_rolling(problem, load, CREEPAGE, 1e3, sides, (2.0, 5.0), steps=WearSteps(number=1))
    found = rolling()
    slid = float((found.normal.pressure * np.hypot(*found.slip)).sum()) * problem.grid.pixel_area
    assert history["body_volume"][-1] == pytest.approx(1e-9 * 1e3 * slid, rel=1e-12)
    assert history["counter_volume"][-1] == pytest.approx(3e-9 * 1e3 * slid, rel=1e-12)
    alone = rolled(found, archard(1e-9), 1e3, 2.0)
    np.testing.assert_allclose(history.body_depth, np.broadcast_to(alone.depth, (32, 32)), rtol=1e-12, atol=1e-30)
    np.testing.assert_allclose(history.counter_depth, history.body_depth * 3.0 * 2.0 / 5.0, rtol=1e-12, atol=1e-30)
    assert history.dose_balance < 1e-12


@pytest.mark.slow
def test_pressure_flattens_across_and_steps_keep_their_error() -> None:
    """What slips most is worn most, until it bears less; a few equal steps are unstable, as their
    error says; twice as many small ones agree within it."""
    problem, load = balls()
    found = worn_by_rolling(problem, load, CREEPAGE, 1e6, archard(1e-3), 2.0)
    assert found.converged
    assert 0.0 < found.error < 0.1
    assert found["area_fraction"][-1] > found["area_fraction"][0]
    middle = found.last.pressure[16]
    first = found.kept[0][1].pressure[16]
    assert middle.std() / middle.mean() < first.std() / first.mean()
    finer = worn_by_rolling(problem, load, CREEPAGE, 1e6, archard(1e-3), 2.0, steps=WearSteps(0.02))
    apart = np.abs(found.body_depth - finer.body_depth).sum() / finer.body_depth.sum()
    assert apart < found.error + finer.error
    coarse = worn_by_rolling(problem, load, CREEPAGE, 1e6, archard(1e-3), 2.0, steps=WearSteps(number=4))
    assert coarse.error > 0.2
    assert "steps of wear" in {item.criterion for item in coarse.findings()}
    assert found.kept[-1][0] == 1e6
    assert found.state is None


def test_a_coated_wheel_is_worn_through_where_it_slips_most() -> None:
    """At the distance at which the dose of the first point is thickness over coefficient."""
    ball = asp.Elastic(1.0, 0.3)
    problem, load = balls(asp.Layered([asp.Layer(ball, 1e-6)], ball))
    law = archard(1e-3, layers=[(1e-6, 1e-4)])
    history = worn_by_rolling(problem, load, CREEPAGE, 1e5, law, 2.0, until_bare=True, steps=WearSteps(number=50))
    base = rolled(rolling(), archard(1e-4), 1.0, 2.0).depth.max()
    # of the first shape; what is worn by then is small against the deflection of 1e-2
    assert history.breakthrough == pytest.approx(1e-6 / base, rel=1e-2)
    assert history["distance"][-1] < 1e5
    assert history["max_depth"][-1] >= 1e-6


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"distance": 0.0}, "distance rolled (m)"),
        ({"circumference": (1.0, 0.0)}, "circumference of a rolling body (m)"),
        ({"wear": archard(1e-15, threshold_pressure=1.0)}, "law of wear of a rolling body"),
        ({"wear": Sides(archard(1e-15), body_track=1.0)}, "sides of a contact that rolls"),
    ],
)
def test_what_does_not_roll_on_is_refused(change: dict[str, object], subject: str) -> None:
    problem, load = balls()
    given = {"distance": 1.0, "wear": archard(1e-15), "circumference": 1.0} | change
    with refused(InputError, subject):
        worn_by_rolling(problem, load, CREEPAGE, **given)  # type: ignore[arg-type]


# In documents.

WHEEL: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [24, 24], "size": "12 mm", "radius": "300 mm"},
    "body": "bearing steel{kw=1e-6mm^3/Nm}",
    "counter_body": "bearing steel",
    "boundary": {"kind": "free"},
    "control": {"force": "5 kN"},
    "friction": {"coefficient": 0.3},
    "rolling": {"longitudinal": "0.1 %", "direction": "y"},
    "wear": {"distance": "1000 km", "track_body": "1.9 m"},
}


def test_a_document_that_rolls_wears_as_python_says(tmp_path: Path) -> None:
    outcome = asp.run(WHEEL)
    problem = outcome.solved.problem.with_physics(friction=asp.friction.Coulomb(0.3))
    creepage = asp.rolling.Creepage(1e-3, 0.0)
    python = worn_by_rolling(
        problem, outcome.solved.control, creepage, 1e6, archard(1e-15), 1.9, direction="y", steps=WearSteps()
    )
    values, found = outcome.values, outcome.found["wear"].values
    assert values["wear_volume"] == pytest.approx(python.worn_volume, rel=1e-9)
    np.testing.assert_allclose(found["worn_body"], python.body_depth, rtol=1e-9, atol=1e-20)
    assert values["wear_steps"] == len(python["distance"]) - 1
    assert values["wear_balance"] < 1e-12
    assert found["section_heights"].shape[1] == 24
    assert found["course_rolling_heat"][0] == pytest.approx(values["rolling_heat"], rel=1e-9)
    assert found["course_tangential_force"][0] == pytest.approx(abs(values["rolling_longitudinal_force"]), rel=1e-9)
    assert found["course_slip_area_fraction"][0] == pytest.approx(values["rolling_slip_area_fraction"])
    assert np.isnan(values["wear_mean_depth"])
    first = {figure.name for figure in outcome.figures["wear"]}
    assert first >= {"worn_profile", "worn_section_pressure", "wear_life", "wear_course"}
    words = next(words for part, words in outcome.sections if part.name == "wear")
    save_outcome(outcome, tmp_path / "wheel.nc")
    again = next(words for part, words in load_outcome(tmp_path / "wheel.nc").sections if part.name == "wear")
    assert (again.sentence, again.rows, again.tables) == (words.sentence, words.rows, words.tables)
    asp.save(python, tmp_path / "history.nc")
    stored = asp.load(tmp_path / "history.nc")
    np.testing.assert_array_equal(stored.body_depth, python.body_depth)
    for name in ("max_pressure", "tangential_force"):
        np.testing.assert_array_equal(stored[name], python[name])


@pytest.mark.parametrize(
    ("tables", "subject"),
    [
        ({"wear": {"distance": "1 km"}}, "wear.track_body"),
        ({"wear": {"distance": "1 km", "track_body": "2 m", "wears": "both"}}, "wear coefficient of bearing steel"),
        ({"wear": {"cycles": 3, "shift": "1 um", "track_body": None}}, "wear.cycles"),
        ({"wear": {"distance": "1 km", "track_body": "2 m", "order": 2}}, "wear.order"),
        ({"wear": {"distance": "1 km", "track_body": "2 m", "threshold_pressure": "1 MPa"}}, "wear.threshold_pressure"),
        ({"wear": {"distance": "1 km", "debris": "20 %", "debris_modulus": "1 GPa"}}, "wear.debris"),
        ({"wear": {"distance": "1 km", "track_body": "2 m", "step": 1}}, "wear.step"),
        ({"rolling": {"longitudinal": "0.1 %", "roughness_file": "rough.nc"}}, "rolling.roughness_file"),
    ],
)
def test_keys_without_a_meaning_in_rolling_are_refused(tables: dict[str, Any], subject: str) -> None:
    with pytest.raises(InputError) as caught:
        build(checked(WHEEL | tables))
    assert caught.value.subject == subject


def test_both_bodies_wear_as_they_roll() -> None:
    """Each by the passages of its circumference; two lengths are no two tracks there."""
    wear = {"distance": "100 km", "track_body": "1.9 m", "track_counter_body": "1 km", "wears": "both"}
    outcome = asp.run(WHEEL | {"wear": wear | {"coefficient_counter_body": "1e-6 mm^3/Nm", "steps": 1}})
    values = outcome.values
    assert values["wear_body_volume"] == pytest.approx(values["wear_counter_body_volume"], rel=1e-9)
    assert values["wear_body_depth"] == pytest.approx(values["wear_counter_body_depth"] * 1e3 / 1.9, rel=1e-9)
