"""`asperity contact`, `asperity run` and ``asp.run`` give the same numbers to the last bit for the
same document."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import pytest
from cli.conftest import Runner
from study_cases import PROBLEM, InProcess

import asperity as asp
from asperity.run.document import checked, save_document
from asperity.studies.plan import computed

FLAT = {key: value for key, value in PROBLEM.items() if key not in ("body", "control")}
BODY = "E=100GPa,nu=0.3,H=5GPa"
SPHERE = {"kind": "sphere", "points": [32, 24], "size": "8 um x 6 um", "radius": "40 um"}
LINE = {"kind": "rough", "points": [64, 1], "size": "10 um x 1 um", "seed": 3, "spectrum": FLAT["surface"]["spectrum"]}
FILM = {"liquid": "PFPE", "thickness": "1 nm"}
SLIDING = {"friction": 0.5, "coupled": True, "depths": ["0 nm"]}


def document(**tables: Any) -> dict[str, Any]:
    whole = {**FLAT, "body": BODY, "control": {"mean_pressure": "20 MPa"}} | tables
    return {**whole, "solver": {"threads": 1, **whole.get("solver", {})}}


DOCUMENTS = {
    "plain": document(),
    "force": document(control={"force": "2 mN"}),
    "approach": document(control={"approach": "2 nm"}),
    "gap": document(control={"mean_gap": "2 nm"}),
    "pair": document(
        counter_surface={**FLAT["surface"], "seed": 2}, counter_body={"youngs_modulus": "200 GPa", "poisson_ratio": 0.2}
    ),
    "layered": document(body=PROBLEM["body"]),
    "hardness": document(law={"kind": "hardness", "hardness": "0.5 GPa"}),
    "layered hardness": document(body=PROBLEM["body"], law={"kind": "hardness", "hardness": "effective"}),
    "shift": document(friction={"coefficient": 0.3}, shear={"shift": "0.5 nm"}),
    "fretting cycle": document(
        friction={"coefficient": 0.3, "direction": "30 deg", "limit": "0.2 GPa"},
        shear={"shift": "0.5 nm", "cycles": 1, "steps": 2},
    ),
    "tangential force": document(friction={"law": "full stick"}, shear={"force": ["1 uN", "-1 uN"], "steps": 1}),
    "held and let go": document(
        counter_body="E=1GPa+2GPa@1ms+1GPa@0.1s,nu=0.4:50nm/E=3MPa+10MPa@10ms,nu=0.5",
        control={"path": {"mean_pressure": ["1 MPa", "0.4 MPa"]}},
        viscoelastic={"ramp": ["0 s", "1 ms"], "hold": "10 ms", "steps": 4},
    ),
    "sliding over rubber": document(
        body="E=200GPa,nu=0.3",
        counter_body="E=3MPa+3MPa@0.1s+10MPa@10ms,nu=0.5,WLF=298K;8.86;101.6K",
        control={"mean_pressure": "1 kPa"},
        viscoelastic={"temperature": "310 K"},
        hysteresis={"speed": "1 mm/s", "direction": "30 deg", "distance": "2 um", "steps_per_pixel": 1},
    ),
    "list of steps": document(
        counter_body=BODY,
        friction={"law": "tresca", "strength": "50 MPa"},
        shear={
            "history": [{"mean_pressure": "10 MPa", "shift": "0 nm"}, "20 MPa, 0.2 nm, 0.1 nm", {"shift": "0.4 nm"}]
        },
    ),
    "path": document(
        law={"kind": "hardness", "hardness": "0.5 GPa"},
        control={"path": {"mean_pressure": ["20 MPa", "0", "30 MPa"], "steps": 3}},
    ),
    "film": document(film=FILM),
    "humidity": document(film={"liquid": "water", "humidity": "70 %", "friction": 0.2}),
    "coupled": document(body="E=100GPa,nu=0.2", stress=SLIDING),
    "coupled, own solver": document(
        body="E=100GPa,nu=0.2", stress=SLIDING, solver={"method": "conjugate_gradient", "tolerance": 1e-3}
    ),
    "stress": document(stress={"friction": 0.3, "depths": ["0 nm", "50 nm"], "sections": ["y=max"]}),
    "free": document(surface=SPHERE, boundary={"kind": "free"}, control={"force": "0.1 mN"}),
    "line": document(surface=LINE, boundary={"kind": "line"}, control={"force": "1 N"}),
    "solver": document(solver={"method": "conjugate_gradient", "tolerance": 1e-8}),
    "plastic load": document(law={"kind": "hardness", "hardness": "0.5 GPa"}, plastic_load={"share": 0.02}),
    "plastic flow": document(
        body="E=300GPa,nu=0.25,Y=5GPa:100nm/E=200GPa,nu=0.3,Y=400MPa,hardening=swift(0.2)",
        plastic_flow={"steps": 1, "cells": 4, "unload": True},
    ),
    "indentation": document(
        body="E=200GPa,nu=0.3,Y=4GPa,hardening=voce(1GPa,20)",
        indentation={"depth": "5 nm", "radius": "10 um", "elements": 4, "steps": 4, "unloading_steps": 6},
    ),
    "passes": document(
        body="E=200GPa,nu=0.3,Y=400MPa,kinematic=10GPa,recall=50",
        passes={
            "count": 1,
            "radius": "10 um",
            "line_load": "150 N/m",
            "friction": 0.1,
            "elements": 4,
            "steps": 4,
            "track": "0.1 um",
        },
    ),
}
COSTLY = ("normal_stiffness", "statistical_meniscus_force")


@pytest.mark.parametrize("name", DOCUMENTS)
def test_all_ways_to_run_give_the_same_bits(
    run: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    table = DOCUMENTS[name]
    wanted = computed(checked(table), ["normal_stiffness", *COSTLY[1 : 1 + ("film" in table)]])
    from_python = asp.run(table).values
    assert set(wanted) <= set(from_python)
    from_study = _by_study(run, tmp_path, monkeypatch, table, wanted)
    for quantity in wanted:
        assert _same(float(from_python[quantity]), from_study[quantity]), quantity
    from_command = _by_command(run, tmp_path, table)
    for quantity in set(wanted) & set(from_command):
        assert _same(float(from_python[quantity]), from_command[quantity]), quantity
    assert len(set(wanted) & set(from_command)) >= 20


def _by_command(run: Runner, folder: Path, table: dict[str, Any]) -> dict[str, float]:
    """Scalars that `asperity contact` writes."""
    save_document(checked(table), folder / "problem.toml")
    done = run("contact", "--from", folder / "problem.toml", "--csv", folder / "scalars.csv")
    assert done.exit_code == 0, done.output
    with (folder / "scalars.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {row["name"]: float(row["value"]) for row in rows if row["unit"] and "." not in row["name"]}


def _by_study(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch, table: dict[str, Any], wanted: tuple[str, ...]
) -> dict[str, float]:
    """Values that `asperity run` collects, in this process; exact in the store, as in its
    dataset."""
    monkeypatch.setattr("asperity.studies.local.LocalProcesses", lambda *_: InProcess())
    body, layers = checked(table).body, checked(table).body.layers
    path = "body.layers.0.poisson_ratio" if layers else "body.poisson_ratio"
    axis = {"path": path, "values": [(layers[0] if layers else body).poisson_ratio]}
    study = {"version": 1, "problem": table, "quantities": list(wanted), "axes": [axis]}
    (folder / "study.json").write_text(json.dumps(study), encoding="utf-8")
    done = run("run", folder / "study.json", "--out", folder / "study")
    assert done.exit_code == 0, done.output
    data = asp.studies.open_study(folder / "study").dataset()
    return {quantity: float(data[quantity][0]) for quantity in wanted}


def _same(one: float, other: float) -> bool:
    return one == other or (math.isnan(one) and math.isnan(other))
