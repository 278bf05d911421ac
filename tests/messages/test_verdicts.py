"""The verdict on some fifty documents, compared with verdicts.txt as a whole, and the same at every
door.

``ASPERITY_WRITE_MESSAGES=1 pytest tests/messages/test_verdicts.py`` writes the file anew; the
difference is read like any other.
"""

from __future__ import annotations

import json
import os
import re
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from instrument_file import bcr
from messages.test_messages import NUMBER
from messages.verdict_documents import COATED, DOCUMENTS, DOWN, PLAIN
from refusals import refused
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.contact.result import SCALARS
from asperity.core.status import GRADES, Verdict
from asperity.io.words import PLASTIC, result_rows
from asperity.run.stored import load_outcome, save_outcome
from asperity.run.verdict import verdict
from asperity.web.views import SHOWN, Views

WRITTEN = Path(__file__).with_name("verdicts.txt")
PREFIX = re.compile(r"# [yzafpnµmkMGTP]?(J|Pa|N|m²|m|s)\b")
"""Rounding decides on the prefix of what is nearly zero."""


def worded(name: str, given: Verdict) -> str:
    rows = [f"    {label}: {text}" for label, text in given.rows]
    return PREFIX.sub(r"# \1", NUMBER.sub("#", "\n".join([name, *rows]).replace("± ", "±"))).replace("#e", "#")


@pytest.mark.slow
def test_verdicts_are_those_of_the_file() -> None:
    assert len(DOCUMENTS) >= 40
    found = {name: asp.run(table, on_failure="return") for name, table in DOCUMENTS.items()}
    given = {name: outcome.verdict for name, outcome in found.items()}
    for name, outcome in found.items():
        one = given[name]
        assert one.trust.startswith(GRADES[one.grade]), name
        assert (one.grade == "not") >= (not outcome.converged), name
        touched = outcome.result if outcome.path is None else max(outcome.path.steps, key=lambda step: step.force)
        assert ("do not touch;" in one.what) == (not touched.contact.any()), name
    text = "\n\n".join(worded(name, one) for name, one in given.items()) + "\n"
    if os.environ.get("ASPERITY_WRITE_MESSAGES"):
        WRITTEN.write_text(text, encoding="utf-8")
    assert text == WRITTEN.read_text(encoding="utf-8"), "read the difference; ASPERITY_WRITE_MESSAGES=1 accepts it"


@pytest.mark.parametrize("table", [PLAIN, COATED | {"control": DOWN, "stress": {}}], ids=["contact", "unloaded path"])
@pytest.mark.usefixtures("unrendered")
def test_it_is_the_same_at_every_door(table: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", "1")
    outcome = asp.run(table)
    given = outcome.verdict
    save_outcome(outcome, tmp_path / "result.nc")
    assert verdict(tmp_path / "result.nc") == given
    assert load_outcome(tmp_path / "result.nc").verdict == given
    lines = [text.split(". ")[0] for _, text in given.rows]
    document = tmp_path / "problem.json"
    document.write_text(json.dumps(table), encoding="utf-8")
    told = CliRunner().invoke(app, ["contact", "--from", str(document)]).stdout
    for (name, text), line in zip(given.rows, lines, strict=True):
        assert f"{name}: {line}" in told, text
    asp.write_report(outcome, tmp_path / "report.html")
    page = unescape(re.sub(r"<[^>]+>", "", (tmp_path / "report.html").read_text(encoding="utf-8")))
    views = Views(tmp_path / "run")
    views.page(outcome)
    views.end()
    shown = json.loads((tmp_path / f"run{SHOWN}").read_text(encoding="utf-8"))
    assert [tuple(row) for row in shown["verdict"]] == given.rows
    assert [tuple(row) for row in shown["headline"]] == given.headline
    for thing in (repr(outcome), repr(outcome.path or outcome.result), outcome._repr_html_()):
        flat = " ".join(unescape(thing).split())
        assert given.what in flat
    for line in lines:
        assert line in page


def test_a_path_that_ends_unloaded_leads_with_its_peak() -> None:
    outcome = asp.run(COATED | {"control": DOWN, "stress": {}})
    given, loads = outcome.verdict, outcome.path.mean_pressure  # type: ignore[union-attr]
    assert (given.step, given.steps) == (int(loads.argmax()) + 1, loads.size)
    assert dict(given.headline)["mean pressure"] == "20 MPa"
    alone = asp.run(COATED | {"control": {"mean_pressure": "20 MPa"}, "stress": {}})
    assert outcome.values["max_von_mises"] == pytest.approx(alone.values["max_von_mises"], rel=1e-4)
    assert outcome.values["yield_load_factor"] == pytest.approx(alone.values["yield_load_factor"], rel=1e-4)
    last = asp.run(COATED | {"control": DOWN, "stress": {"step": "last"}})
    assert last.values["max_von_mises"] == 0.0


def test_a_step_beyond_the_path_is_refused() -> None:
    with refused(asp.InputError, "step of the stresses", "6", "7"):
        asp.run(COATED | {"control": DOWN, "stress": {"step": 7}})


def test_rows_on_plastic_deformation_stand_where_it_was_asked_for() -> None:
    limit = {"law": {"kind": "hardness", "hardness": "2 GPa"}}
    elastic, limited = (dict(result_rows(asp.run(PLAIN | more).result)) for more in ({}, limit))
    labels = {quantity.label for quantity in SCALARS if quantity.name in PLASTIC}
    assert len(labels) == len(PLASTIC)
    assert limited.keys() - elastic.keys() == labels


def test_numbers_in_doubt_are_marked() -> None:
    thin = DOCUMENTS["unresolved layer with stresses"]
    given = asp.run(thin).verdict
    assert given.grade == "doubtful"
    assert "(doubtful)" in given.holds
    assert "(doubtful)" in dict(given.headline)["maximum pressure"]
    assert "(doubtful)" not in dict(given.headline)["mean pressure"]


def test_press_is_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bcr(tmp_path / "scan.bcr")
    monkeypatch.setenv("NO_COLOR", "1")
    outcome = asp.press(tmp_path / "scan.bcr", body="DLC:5nm/steel", pressure="50 MPa", friction=0.3)
    options = ["--body", "DLC:5nm/steel", "--pressure", "50 MPa", "--friction", "0.3"]
    told = CliRunner().invoke(app, ["contact", str(tmp_path / "scan.bcr"), *options, "--out", str(tmp_path / "run")])
    assert told.exit_code == 0
    stored = load_outcome(tmp_path / "run" / "result.nc")
    assert stored.values.keys() == outcome.values.keys()
    for name, value in outcome.values.items():
        assert stored.values[name] == pytest.approx(value, rel=1e-9, nan_ok=True), name
    assert f"Result: {outcome.verdict.what}" in told.stdout
    assert outcome.verdict.holds in told.stdout


@pytest.mark.parametrize(
    ("options", "subject", "shown"),
    [
        ({"body": "DLC", "presure": "5 MPa"}, "arguments of asperity.press", ("presure", "pressure?")),
        ({"body": "DLC", "pressure": 50}, "asperity.press: pressure", ("50",)),
        ({"body": "DLC"}, "load", ("pressure", "mean_gap")),
        ({"pressure": "5 MPa"}, "body", ()),
    ],
)
def test_press_refuses_in_words_of_python(
    options: dict[str, Any], subject: str, shown: tuple[str, ...], tmp_path: Path
) -> None:
    bcr(tmp_path / "scan.bcr")
    with refused(asp.InputError, subject, *shown) as caught:
        asp.press(tmp_path / "scan.bcr", **options)
    assert "--" not in str(caught.value)


def test_stresses_under_prescribed_tractions_have_one_too() -> None:
    patch = {"kind": "patch", "x": ["0.8 um", "1.6 um"], "y": ["0.5 um", "1 um"], "pressure": "1 GPa"}
    loads = {"points": [24, 16], "size": "2.4 um x 1.6 um", "boundary": "free", "loads": [patch]}
    outcome = asp.run({"version": 2, "body": "steel{Y=400MPa}", "tractions": loads, "stress": {"depths": ["0.1 um"]}})
    assert outcome.verdict.fails
    assert outcome.verdict.holds.startswith("The body yields: ")
    assert outcome.verdict.holds in " ".join(repr(outcome).split())
    assert "The body yields: " in outcome._repr_html_()
