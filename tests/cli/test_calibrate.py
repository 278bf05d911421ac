"""The command calibrate: the numbers of Python as tables, JSON and files."""

from __future__ import annotations

import json
from pathlib import Path

import tomli_w
from cli.conftest import Runner
from refusals import subject_of
from study_cases import PROBLEM

import asperity as asp
from asperity.core.units import show

HALFSPACE = {"youngs_modulus": "150 GPa", "poisson_ratio": 0.3}


def test_a_modulus_is_fitted_and_kept(tmp_path: Path, run: Runner) -> None:
    problem = {**PROBLEM, "body": {**HALFSPACE, "youngs_modulus": "200 GPa"}}
    loads = (1, 2, 4)
    found = [asp.run({**problem, "control": {"mean_pressure": f"{p} MPa"}}).values for p in loads]
    pairs = [(1e9 * values["mean_gap"], 1e9 * values["approach"]) for values in found]
    rows = "\n".join(f"{p},{gap!r},{approach!r}" for p, (gap, approach) in zip(loads, pairs, strict=True))
    head = "mean_pressure (MPa),mean_gap (nm),approach (nm)"
    (tmp_path / "curve.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
    fitted = {"path": "body.youngs_modulus", "name": "E", "low": "50 GPa", "high": "800 GPa"}
    study = {"version": 1, "problem": {**PROBLEM, "body": HALFSPACE}}
    path = tmp_path / "fit.toml"
    table = {"curve": "curve.csv", "parameters": [fitted], "noise": 0.005}
    path.write_text(tomli_w.dumps({**study, "calibration": table}), encoding="utf-8")
    result = run("calibrate", path, "--workers", 1)
    assert result.exit_code == 0, result.output
    record = json.loads((tmp_path / "fit-results" / "calibration.json").read_text(encoding="utf-8"))
    (modulus,) = record["parameters"]
    assert len(record["curve"]) == 6
    assert abs(modulus["value"] / 200e9 - 1.0) < 2e-3
    assert show(modulus["value"], "Pa") in result.stdout
    again = run("calibrate", path, "--workers", 1, "--json")
    assert json.loads(again.stdout)["solves"] == 0
    assert subject_of(run("run", path)) == "study"
