"""Frictional heating in documents: numbers of Python, files, load paths, words, studies, and what
is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from study_cases import InProcess, plan
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.core.errors import InputError
from asperity.heating import HeatedInterface, Motion, flash_temperature
from asperity.physics.heating.part import QUANTITIES
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome, save_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out

RUBBING: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 48],
        "size": "20 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "50 nm", "correlation_length": "3 um"},
    },
    "body": "mild steel",
    "counter_body": "zirconia",
    "control": {"mean_pressure": "100 MPa"},
    "law": {"kind": "hardness", "hardness": "2 GPa"},
    "heating": {"speed": "1 m/s", "friction": 0.3},
}


def test_numbers_are_those_of_python_and_files_keep_them(tmp_path: Path) -> None:
    asked = {
        "speed": "2 m/s",
        "friction": 0.25,
        "moving": "rolling",
        "rolling": "5 m/s",
        "direction": "90 deg",
        "bulk_body": "300 K",
        "bulk_counter_body": "320 K",
        "resistance_body": "1e-8 m^2*K/W",
        "sink_body": "1 mm",
        "sink_counter_body": "2 mm",
        "section": "2 um",
        "allowed": "500 K",
    }
    document = RUBBING | {"heating": asked}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    motion = Motion.of(2.0, "rolling", direction=math.pi / 2.0, rolling=5.0)
    between = HeatedInterface((1e-8, 0.0), (300.0, 320.0), (1e-3, 2e-3))
    heated = flash_temperature(outcome.result, motion, 0.25, between)
    values = outcome.values
    for name, value in {
        "flash_temperature": heated.maximum,
        "hottest_temperature": 300.0 + heated.maximum,
        "flash_heat_mean": heated.flux_mean,
        "heat_share": heated.share,
        "frictional_power": 0.25 * 2.0 * outcome.result.force,
        "flash_x": heated.place[0],
        "flash_blok": heated.blok,
        "critical_wavelength": heated.critical_wavelength,
    }.items():
        assert values[name] == pytest.approx(value, rel=1e-6), name
    assert values["flash_disc"] > 0.0
    save_outcome(outcome, tmp_path / "hot.nc")
    again = load_outcome(tmp_path / "hot.nc")
    tree = asp.files.open_tree(tmp_path / "hot.nc")
    for item in QUANTITIES:
        if not item.name.startswith("path_"):
            assert tree[f"heating/{item.name}"].attrs["units"] == item.unit
    np.testing.assert_allclose(tree["heating/flash_body"], heated.surface_1, rtol=1e-5, atol=1e-4)
    first, second = (next(w for p, w in kept.sections if p.name == "heating") for kept in (outcome, again))
    assert (first.sentence, first.rows, first.holds) == (second.sentence, second.rows, second.holds)
    names = {"flash_rise", "heat_share", "flash_distribution", "heat_section"}
    assert {figure.name for figure in again.figures["heating"]} == names
    assert all(figure.picture for figure in again.figures["heating"])


def test_the_friction_of_the_contact_serves_and_gives_the_direction() -> None:
    sliding = RUBBING | {
        "friction": {"coefficient": 0.3, "direction": "90 deg", "coupled": False},
        "heating": {"speed": "1 m/s"},
    }
    along_y = asp.run(sliding).values
    given = asp.run(RUBBING | {"heating": {"speed": "1 m/s", "friction": 0.3, "direction": "90 deg"}}).values
    assert along_y["flash_temperature"] == pytest.approx(given["flash_temperature"], rel=1e-6)
    assert along_y["heat_share"] == pytest.approx(given["heat_share"], rel=1e-6)


@pytest.mark.parametrize(("allowed", "alarming"), [("1000 K", False), ("294 K", True)])
def test_the_verdict_says_whether_it_is_allowed(allowed: str, alarming: bool) -> None:
    outcome = asp.run(RUBBING | {"heating": RUBBING["heating"] | {"allowed": allowed}})
    words = next(words for part, words in outcome.sections if part.name == "heating")
    assert words.alarming is alarming
    assert words.holds


def test_a_load_path_has_its_temperatures() -> None:
    control = {"path": {"mean_pressure": ["100 MPa", "0 Pa"], "steps": 3}}
    outcome = asp.run(RUBBING | {"control": control})
    found = outcome.found["heating"]
    along = found.values["path_flash_temperature"]
    assert along[-1] == 0.0
    assert along.max() == pytest.approx(found.values["flash_temperature"])
    assert math.isnan(found.values["path_heat_share"][-1])
    assert "flash_path" in {figure.name for figure in outcome.figures["heating"]}
    last = asp.run(RUBBING | {"control": control, "heating": RUBBING["heating"] | {"step": "last"}})
    words = next(words for part, words in last.sections if part.name == "heating")
    assert last.values["flash_temperature"] == 0.0
    assert words.sentence
    assert last.figures["heating"] == ()


def test_a_rigid_body_takes_no_heat() -> None:
    outcome = asp.run(RUBBING | {"counter_body": {"rigid": True}})
    assert outcome.values["heat_share"] == 1.0
    assert math.isnan(outcome.values["flash_all_counter_body"])
    assert "rigid body and heat" in {finding.criterion for finding in outcome.findings}
    assert "heat_share" not in {figure.name for figure in outcome.figures["heating"]}


def test_peaks_without_a_hardness_and_few_pixels_are_warned_of() -> None:
    rough = RUBBING["surface"] | {"points": [24, 24]}
    outcome = asp.run(
        RUBBING | {"surface": rough, "law": {"kind": "hard_wall"}, "control": {"mean_pressure": "20 MPa"}}
    )
    assert {"peaks without a hardness", "pixels of the hottest spot"} <= {f.criterion for f in outcome.findings}


def test_free_and_coated() -> None:
    outcome = asp.run(RUBBING | {"counter_body": "zirconia:1um/mild steel", "boundary": {"kind": "free"}})
    bare = asp.run(RUBBING | {"counter_body": "mild steel", "boundary": {"kind": "free"}})
    assert outcome.values["flash_temperature"] > bare.values["flash_temperature"]
    assert outcome.values["heat_share"] > bare.values["heat_share"]


REFUSED = {
    "no heat capacity": ({"body": "E=1GPa,nu=0.3{k=10W/m/K}"}, "volumetric heat capacity of body"),
    "no conductivity": ({"body": "DLC:5nm/nickel"}, "thermal conductivity of DLC"),
    "no friction": ({"heating": {"speed": "1 m/s"}}, "heating.friction"),
    "no speed": ({"heating": {"friction": 0.3}}, "heating.speed"),
    "step beyond the load": ({"heating": {"speed": "1 m/s", "friction": 0.3, "step": 3}}, "heating.step"),
    "speed of zero": ({"heating": {"speed": "0 m/s", "friction": 0.3}}, "heating.speed"),
    "moving": ({"heating": {"speed": "1 m/s", "moving": "both"}}, "heating.moving"),
    "rolling without its speed": ({"heating": {"speed": "1 m/s", "moving": "rolling"}}, "heating.rolling"),
    "speed without rolling": ({"heating": {"speed": "1 m/s", "rolling": "1 m/s"}}, "heating.rolling"),
    "one sink": ({"heating": {"speed": "1 m/s", "sink_body": "1 mm"}}, "heating.sink_counter_body"),
    "film of a length": ({"heating": {"speed": "1 m/s", "resistance_body": "1 nm"}}, "heating.resistance_body"),
    "line": (
        {"surface": RUBBING["surface"] | {"points": [64, 1], "size": "20 um x 1 m"}, "boundary": {"kind": "line"}},
        "boundary of a contact that is heated",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(RUBBING | tables))
    assert refused.value.subject.endswith(subject)


def test_a_study_over_the_speed(tmp_path: Path) -> None:
    """The temperature grows less than in proportion, and the resting body takes less of the
    heat."""
    quantities = ["flash_temperature", "heat_share"]
    axis = {"path": "heating.speed", "values": ["0.1 m/s", "1 m/s", "10 m/s"]}
    made = plan(problem=RUBBING, axes=[axis], quantities=quantities)
    carry_out(made, tmp_path / "r.log", InProcess())
    table = dataset(made, tmp_path / "r.log")
    hot, share = (np.asarray(table[name]).ravel() for name in quantities)
    assert np.all(np.diff(hot) > 0.0)
    assert hot[2] < 10.0 * hot[1] < 100.0 * hot[0]
    assert np.all(np.diff(share) < 0.0)
    single = asp.run(RUBBING | {"heating": RUBBING["heating"] | {"speed": "10 m/s"}})
    assert hot[2] == pytest.approx(single.values["flash_temperature"], rel=1e-6)


def test_the_command_line_says_the_same(tmp_path: Path) -> None:
    """Options and keys mean the same, and the page of the result has the figures."""
    (tmp_path / "p.toml").write_text(dumps(checked(RUBBING)), encoding="utf-8")
    options = ("--flash-speed", "2m/s", "--flash-friction", "0.2", "--moving", "opposite", "--heat-section", "1um")
    done = CliRunner().invoke(
        app, ["contact", "--from", str(tmp_path / "p.toml"), *options, "--out", str(tmp_path / "o")]
    )
    assert done.exit_code == 0, done.output
    asked = {"speed": "2 m/s", "friction": 0.2, "moving": "opposite", "section": "1 um"}
    single = asp.run(RUBBING | {"heating": asked})
    tree = asp.files.open_tree(tmp_path / "o" / "result.nc")
    assert float(tree["heating/flash_temperature"]) == pytest.approx(single.values["flash_temperature"], rel=1e-5)
    assert {path.stem for path in (tmp_path / "o").rglob("*.png")} >= {"flash_rise", "heat_share", "heat_section"}
