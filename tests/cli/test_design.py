"""The command design: tables, files, exit codes, and that a second run solves nothing."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from cli.conftest import Runner
from refusals import subject_of
from study_cases import PROBLEM

from asperity.core.units import show

LIMIT = {"quantity": "mean_gap", "at_least": "1.5 nm"}
ROUGHNESS = {"path": "surface.spectrum.rms_height", "name": "rms", "low": "0.5 nm", "high": "4 nm"}
DESIGN = {"minimise": "rms", "variables": [ROUGHNESS], "constraints": [LIMIT]}


def written(folder: Path, **tables: Any) -> Path:
    path = folder / "d.toml"
    path.write_text(tomli_w.dumps({"version": 1, "problem": PROBLEM, "design": DESIGN, **tables}), encoding="utf-8")
    return path


def test_a_design_is_printed_written_and_kept(tmp_path: Path, run: Runner) -> None:
    path = written(tmp_path)
    result = run("design", path, "--workers", 1)
    assert result.exit_code == 0, result.output
    with (tmp_path / "d-results" / "design.csv").open(newline="", encoding="utf-8") as text:
        rows = {(row["kind"], row["name"]): row for row in csv.DictReader(text)}
    value = float(rows["variable", "rms"]["value"])
    assert show(value, "m") in result.stdout
    assert float(rows["constraint", "mean_gap"]["limit"]) == pytest.approx(1.5e-9)
    again = run("design", path, "--workers", 1, "--json")
    assert again.exit_code == 0, again.output
    found = json.loads(again.stdout)
    assert (found["solves"], found["variables"][0]["value"]) == (0, value)
    assert found["active"] == ["mean_gap"]


def test_limits_that_cannot_be_met_are_exit_code_1(tmp_path: Path, run: Runner) -> None:
    limits = [LIMIT, {"quantity": "max_pressure", "at_most": "1 MPa"}]
    result = run("design", written(tmp_path, design={**DESIGN, "constraints": limits}), "--workers", 1)
    assert result.exit_code == 1, result.output
    found = json.loads((tmp_path / "d-results" / "design.json").read_text(encoding="utf-8"))
    assert (found["feasible"], [each["met"] for each in found["constraints"]]) == (False, [False, False])
    assert len(found["unmet"]) == 2
    assert (tmp_path / "d-results" / "plots" / "margins.png").exists()


def test_studies_and_designs_have_commands_of_their_own(tmp_path: Path, run: Runner) -> None:
    path = written(tmp_path)
    assert subject_of(run("run", path)) == "study"
    axes = [{"path": "surface.seed", "values": [1, 2]}]
    path.write_text(tomli_w.dumps({"version": 1, "problem": PROBLEM, "axes": axes}), encoding="utf-8")
    assert subject_of(run("design", path)) == "study of a design"
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "notes.txt").touch()
    assert subject_of(run("design", written(tmp_path), "--out", tmp_path / "other")) == "folder of a study"


def test_an_interrupt_says_how_to_go_on(tmp_path: Path, run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*given: Any, **more: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("asperity.cli.design.optimise", interrupted)
    result = run("design", written(tmp_path))
    assert result.exit_code == 130
    assert f"asperity design {tmp_path / 'd.toml'}" in result.stdout
