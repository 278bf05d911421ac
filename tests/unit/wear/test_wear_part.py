"""Wear in documents: numbers of Python, files, tables, words, figures, studies, and what is
refused."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from refusals import refused
from study_cases import InProcess, plan
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.core.errors import InputError
from asperity.core.registry import RESULTS
from asperity.parts.registry import parts
from asperity.physics.wear.history import ROLLING
from asperity.physics.wear.part import STRESS_COLUMNS
from asperity.physics.wear.work import KEPT_WAYS
from asperity.report.animation import save_animation
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome, save_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out
from asperity.wear import Sides, WearSteps, archard, worn

WEARING: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "20 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "50 nm", "correlation_length": "3 um"},
    },
    "body": "DLC{kw=1e-7mm^3/Nm}:40nm/bearing steel{kw=1e-6mm^3/Nm}",
    "counter_body": "bearing steel",
    "control": {"mean_pressure": "20 MPa"},
    "wear": {"distance": "1 m"},
}
THROUGH: dict[str, Any] = {"distance": "8 m", "until_bare": True, "tolerance": "5 %"}


def words_of(outcome: Any) -> Any:
    return next(words for part, words in outcome.sections if part.name == "wear")


def test_numbers_are_those_of_python_and_files_keep_them(tmp_path: Path) -> None:
    asked = {"distance": "0.1 m", "allowed_depth": "5 nm", "tolerance": "5 %", "order": 2}
    document = WEARING | {"wear": asked}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    problem, control = outcome.solved.problem, outcome.solved.control
    sides = Sides(archard(1e-15, layers=[(40e-9, 1e-16)]))
    marks = [share * 0.1 for share in KEPT_WAYS]
    history = worn(problem, control, marks, sides, steps=WearSteps(0.05, order=2))
    values = outcome.values
    for name, value in {
        "wear_distance": 0.1,
        "wear_volume": history.worn_volume,
        "wear_depth": history["max_depth"][-1],
        "wear_rms_height_last": history["rms_height"][-1],
        "wear_life": history.life(5e-9),
        "wear_rate": history.worn_volume / (0.1 * outcome.result.force),
        "wear_area_fraction_first": outcome.result.area_fraction,
    }.items():
        assert values[name] == pytest.approx(value, rel=1e-6), name
    assert values["wear_peak_height_last"] < values["wear_peak_height_first"], "peaks go first"
    assert values["wear_valley_depth_last"] > 0.0
    assert math.isnan(values["wear_cycles"])
    save_outcome(outcome, tmp_path / "worn.nc")
    tree = asp.files.open_tree(tmp_path / "worn.nc")
    (part,) = (part for part in parts() if part.name == "wear")
    rolling = {f"course_{item.name}" for item in ROLLING}
    stored = [item for item in part.quantities if item not in STRESS_COLUMNS and item.name not in rolling]
    for item in stored:
        assert tree[f"wear/{item.name}"].attrs["units"] == item.unit, item.name
    np.testing.assert_allclose(tree["wear/worn_body"], history.body_depth, rtol=1e-5, atol=1e-14)
    again = load_outcome(tmp_path / "worn.nc")
    first, second = words_of(outcome), words_of(again)
    assert (first.sentence, first.rows, first.holds, first.tables) == (
        second.sentence,
        second.rows,
        second.holds,
        second.tables,
    )
    names = {"worn_depth", "worn_profile", "worn_section_depth", "worn_section_pressure", "wear_life", "wear_course"}
    assert {figure.name for figure in again.figures["wear"]} == names | {"bearing_curve"}
    assert all(figure.picture for figure in again.figures["wear"])


def test_a_coating_that_is_worn_through() -> None:
    """The first point is bare when its dose is thickness over coefficient; the march ends there if
    asked to."""
    outcome = asp.run(WEARING | {"wear": THROUGH})
    values, words = outcome.values, words_of(outcome)
    assert 0.0 < values["wear_breakthrough"] < values["wear_distance"] < 8.0
    assert values["wear_depth"] >= 40e-9
    assert words.alarming
    assert "worn_through" in {figure.name for figure in outcome.figures["wear"]}
    assert outcome.found["wear"].values["worn_bare"].sum() >= 1.0
    slow = asp.run(WEARING | {"wear": THROUGH | {"distance": "0.1 m"}})
    assert math.isnan(slow.values["wear_breakthrough"])
    assert not words_of(slow).alarming
    assert words_of(slow).holds


@pytest.mark.parametrize(("allowed", "alarming"), [("1 um", False), ("1 nm", True)])
def test_the_verdict_says_whether_it_is_allowed(allowed: str, alarming: bool) -> None:
    outcome = asp.run(WEARING | {"wear": {"distance": "0.1 m", "allowed_depth": allowed}})
    assert words_of(outcome).alarming is alarming
    assert outcome.verdict.fails is alarming
    assert math.isnan(outcome.values["wear_life"]) is not alarming


def test_who_wears() -> None:
    """Both by the volume of each coefficient; a track shares its loss among all its points."""
    table = {"distance": "0.5 m", "wears": "both", "coefficient_counter_body": "2e-7 mm^3/Nm"}
    both = asp.run(WEARING | {"wear": table}).values
    work = 0.5 * 20e6 * (20e-6) ** 2
    assert both["wear_body_volume"] == pytest.approx(1e-16 * work, rel=1e-6)
    assert both["wear_counter_body_volume"] == pytest.approx(2e-16 * work, rel=1e-6)
    one = asp.run(WEARING | {"wear": table | {"wears": "counter_body"}}).values
    assert one["wear_body_volume"] == 0.0
    track = asp.run(WEARING | {"wear": table | {"track_counter_body": "2 mm"}}).values
    assert track["wear_counter_body_depth"] < 0.05 * both["wear_counter_body_depth"]


def test_energy_wears_as_its_coefficient_times_friction_beyond_the_threshold() -> None:
    plain = {"distance": "0.5 m", "coefficient_body": "4e-7 mm^3/Nm", "law": "energy"}
    rubbing = WEARING | {"friction": {"coefficient": 0.25, "coupled": False}}
    by_energy = asp.run(rubbing | {"wear": plain}).values
    assert by_energy["wear_rate"] == pytest.approx(1e-16, rel=1e-6)
    less = asp.run(rubbing | {"wear": plain | {"threshold_energy": "10 MJ/m^2"}}).values
    assert less["wear_volume"] < 0.95 * by_energy["wear_volume"]


def test_fretting_wears_where_it_slips() -> None:
    """Of a sphere in partial slip a ring, while the middle sticks; all of it in gross sliding."""
    sphere = WEARING | {
        "surface": {"kind": "sphere", "points": [16, 16], "size": "240 um", "radius": "10 mm"},
        "body": "bearing steel{kw=1e-5mm^3/Nm}",
        "counter_body": "bearing steel",
        "boundary": {"kind": "free"},
        "control": {"force": "10 N"},
        "friction": {"coefficient": 0.5},
    }
    asked = {"cycles": 6, "shift": "0.25 um", "quarter": 3}
    outcome = asp.run(sphere | {"wear": asked})
    depth = outcome.found["wear"].values["worn_body"]
    assert depth.max() > 0.0
    assert depth[8, 8] == 0.0
    assert outcome.values["wear_cycles"] == 6.0
    assert 0.0 < outcome.values["wear_distance"] < 6 * 4 * 0.25e-6
    slides = asp.run(sphere | {"wear": asked | {"shift": "5 um", "cycles": 2}}).found["wear"].values["worn_body"]
    assert slides[8, 8] > 0.5 * slides.max()


def test_the_load_of_a_path_that_wears() -> None:
    control = {"path": {"mean_pressure": ["20 MPa", "5 MPa"], "steps": 2}}
    largest, last = (
        asp.run(WEARING | {"control": control, "wear": {"distance": "0.1 m", "step": step}}).values["wear_volume"]
        for step in ("peak", "last")
    )
    assert largest == pytest.approx(4.0 * last, rel=1e-4)


def test_debris_stays() -> None:
    """The gap opens by what does not stay, while the bodies lose as much as before."""
    plain, left = (
        asp.run(WEARING | {"wear": {"distance": "0.1 m", "tolerance": "5 %"} | more})
        for more in ({}, {"debris": "50 %", "debris_modulus": "100 GPa"})
    )
    assert left.values["wear_volume"] == pytest.approx(plain.values["wear_volume"], rel=1e-6)
    virgin = plain.solved.problem.profile()
    taken = [virgin - outcome.found["wear"].values["worn_heights"] for outcome in (plain, left)]
    assert taken[1].sum() == pytest.approx(0.5 * taken[0].sum(), rel=1e-6)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no coefficient": ({"body": "DLC:40nm/bearing steel"}, "wear coefficient"),
    "no coefficient of the base": (
        {"body": "DLC{kw=1e-7mm^3/Nm}:40nm/bearing steel"},
        "wear coefficient of bearing steel",
    ),
    "no coefficient of the one that is named": (
        {"wear": {"distance": "1 m", "wears": "both"}},
        "wear coefficient of bearing steel",
    ),
    "nothing": ({"wear": {}}, "wear.distance"),
    "both": ({"wear": {"distance": "1 m", "cycles": 3, "shift": "1 um"}}, "wear.distance"),
    "cycles alone": ({"wear": {"cycles": 3}}, "wear.shift"),
    "shift alone": ({"wear": {"shift": "1 um"}}, "wear.cycles"),
    "fretting along a track": ({"wear": {"cycles": 3, "shift": "1 um", "track_body": "1 m"}}, "wear.track_body"),
    "fretting of second order": ({"wear": {"cycles": 3, "shift": "1 um", "order": 2}}, "wear.order"),
    "quarter of a distance": ({"wear": {"distance": "1 m", "quarter": 3}}, "wear.quarter"),
    "fretting without friction": ({"wear": {"cycles": 3, "shift": "1 um"}}, "friction.coefficient"),
    "energy without friction": ({"wear": {"distance": "1 m", "law": "energy"}}, "friction.coefficient"),
    "two tracks": (
        {"wear": {"distance": "1 m", "track_body": "1 m", "track_counter_body": "1 m"}},
        "wear.track_counter_body",
    ),
    "threshold of the other law": (
        {"wear": {"distance": "1 m", "threshold_energy": "1 J/m^2"}},
        "wear.threshold_energy",
    ),
    "track of what does not wear": (
        {"wear": {"distance": "1 m", "track_counter_body": "1 m"}},
        "wear.track_counter_body",
    ),
    "coefficient of what does not wear": (
        {"wear": {"distance": "1 m", "wears": "body", "coefficient_counter_body": "1e-6 mm^3/Nm"}},
        "wear.coefficient_counter_body",
    ),
    "coefficient of a length": ({"wear": {"distance": "1 m", "coefficient_body": "1 mm"}}, "wear.coefficient_body"),
    "bare without a coating": (
        {"body": "bearing steel{kw=1e-6mm^3/Nm}", "wear": {"distance": "1 m", "until_bare": True}},
        "wear.until_bare",
    ),
    "debris without its modulus": ({"wear": {"distance": "1 m", "debris": "20 %"}}, "wear.debris_modulus"),
    "debris on a track": (
        {"wear": {"distance": "1 m", "debris": "20 %", "debris_modulus": "1 GPa", "track_body": "1 m"}},
        "wear.debris",
    ),
    "step beyond the load": ({"wear": {"distance": "1 m", "step": 3}}, "wear.step"),
    "beside a shift": ({"friction": {"coefficient": 0.3}, "shear": {"shift": "1 nm"}}, "wear"),
    "adhesion": (
        {"adhesion": {"work": "50 mJ/m^2", "range": "1 nm"}},
        "physics of a contact that wears",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as caught:
        build(checked(WEARING | tables))
    assert caught.value.subject.endswith(subject)


def test_a_study_of_the_life(tmp_path: Path) -> None:
    """A coating twice as thick lives more than twice as long, as pressures fall while it runs in;
    half the coefficient doubles the life."""
    quantities = ["wear_breakthrough"]
    problem = WEARING | {"wear": THROUGH | {"tolerance": "10 %"}}
    axes = [
        {"path": "body.layers.0.thickness", "values": ["10 nm", "20 nm"]},
        {"path": "body.layers.0.wear_coefficient", "values": ["1e-7 mm^3/Nm", "2e-7 mm^3/Nm"]},
    ]
    made = plan(problem=problem, axes=axes, quantities=quantities)
    carry_out(made, tmp_path / "r.log", InProcess())
    life = np.asarray(dataset(made, tmp_path / "r.log")[quantities[0]])
    assert (life[1] > 2.0 * life[0]).all()
    np.testing.assert_allclose(life[:, 0], 2.0 * life[:, 1], rtol=0.05)


def test_the_command_line_says_the_same(tmp_path: Path) -> None:
    """Options and keys mean the same; the folder has the course as a table, and the figures."""
    (tmp_path / "p.toml").write_text(dumps(checked(WEARING)), encoding="utf-8")
    options = ("--wear-distance", "0.2m", "--wear-body", "2e-7mm^3/Nm", "--allowed-wear-depth", "10nm")
    done = CliRunner().invoke(
        app, ["contact", "--from", str(tmp_path / "p.toml"), *options, "--out", str(tmp_path / "o")]
    )
    assert done.exit_code == 0, done.output
    asked = {"distance": "0.2 m", "coefficient_body": "2e-7 mm^3/Nm", "allowed_depth": "10 nm"}
    single = asp.run(WEARING | {"wear": asked})
    tree = asp.files.open_tree(tmp_path / "o" / "result.nc")
    assert float(tree["wear/wear_volume"]) == pytest.approx(single.values["wear_volume"], rel=1e-5)
    with (tmp_path / "o" / "wear.csv").open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert len(rows) == int(single.values["wear_steps"]) + 1
    column = [float(row[head.index("course_worn_volume (m**3)")]) for row in rows]
    assert column[-1] == pytest.approx(single.values["wear_volume"], rel=1e-5)
    assert np.all(np.diff(column) > 0.0)
    assert {path.stem for path in (tmp_path / "o").rglob("*.png")} >= {"worn_depth", "worn_profile", "wear_life"}


def test_the_section_moves(tmp_path: Path) -> None:
    """One frame for each state that was kept, from the file of the outcome too."""
    outcome = asp.run(WEARING | {"wear": {"distance": "0.1 m", "tolerance": "5 %"}})
    asp.report.save_wear_animation(outcome, tmp_path / "worn.gif")
    save_outcome(outcome, tmp_path / "worn.nc")
    save_animation(load_outcome(tmp_path / "worn.nc"), tmp_path / "again.gif")
    many = len(outcome.found["wear"].values["section_way"])
    assert many > 10
    for name in ("worn", "again"):
        with Image.open(tmp_path / f"{name}.gif") as picture:
            assert picture.n_frames == many
    plain = asp.run({key: value for key, value in WEARING.items() if key != "wear"})
    with refused(InputError, "outcome of an animation of wear"):
        asp.report.save_wear_animation(plain, tmp_path / "none.gif")


def test_a_history_is_kept_in_a_file(tmp_path: Path) -> None:
    outcome = asp.run(WEARING | {"wear": {"distance": "0.01 m"}})
    history = worn(outcome.solved.problem, outcome.solved.control, 0.1, archard(1e-16))
    asp.save(history, tmp_path / "history.nc")
    again = asp.load(tmp_path / "history.nc")
    assert "wear_history" in RESULTS
    np.testing.assert_array_equal(again.body_depth, history.body_depth)
    np.testing.assert_array_equal(again["max_depth"], history["max_depth"])
    np.testing.assert_array_equal(again.last.pressure, history.last.pressure)
    assert again.status == history.status


@pytest.mark.slow
def test_a_measured_scan_runs_in(shared_data: Path) -> None:
    """Of a scan by white-light interferometry: peaks go, valleys stay, and the volume is that of
    the dose."""
    scan = {
        "kind": "file",
        "path": str(shared_data / "wli_126um_640x480.opd"),
        "prepare": [
            {"step": "fill"},
            {"step": "level"},
            {"step": "crop", "x": ["0 um", "100 um"], "y": ["0 um", "90 um"]},
            {"step": "resample", "points": [128, 128]},
            {"step": "periodise"},
        ],
    }
    table = {"distance": "1 m", "tolerance": "5 %"}
    outcome = asp.run(WEARING | {"surface": scan, "body": "bearing steel{kw=1e-6mm^3/Nm}", "wear": table})
    values = outcome.values
    area = outcome.solved.problem.grid.area
    assert values["wear_volume"] == pytest.approx(1e-15 * 20e6 * area, rel=1e-6)
    assert values["wear_peak_height_last"] < 0.9 * values["wear_peak_height_first"]
    assert values["wear_area_fraction_last"] > 1.5 * values["wear_area_fraction_first"]
    assert values["wear_max_pressure_last"] < 0.5 * values["wear_max_pressure_first"]
    assert outcome.found["wear"].status.converged
