"""Stick and slip on the command line and in documents: steps, files, figures made again, and what
is refused."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import LOAD, SCALE, Runner

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.friction.fretting import SHEAR_SCALARS
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome

BODY = ("--body", "E=100GPa,nu=0.2:50nm/E=200GPa,nu=0.3")
PROBLEM: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [16, 16],
        "size": "10 um",
        "seed": 1,
        "spectrum": {"kind": "gaussian", "rms_height": "1 nm", "correlation_length": "2 um"},
    },
    "body": "E=100GPa,nu=0.3",
    "control": {"mean_pressure": "20 MPa"},
    "friction": {"coefficient": 0.3},
    "shear": {"shift": "0.4 nm"},
}


def course(**tables: Any) -> list[asp.Step]:
    """Steps of the problem with these ``tables``."""
    return [item if isinstance(item, asp.Step) else asp.Step(item) for item in build(checked(PROBLEM | tables)).path]


@pytest.mark.slow
def test_a_fretting_loop_and_its_files(run: Runner, matrix: Path, tmp_path: Path) -> None:
    """The loop from options is that of Python; the files hold it, and give the same words and
    pictures again."""
    out = tmp_path / "out"
    loop = ("--friction", "0.3", "--shift", "0.2nm", "--cycles", "1", "--cycle-steps", "1")
    done = run("contact", matrix, *SCALE, "--periodise", *BODY, *LOAD, *loop, "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    assert outcome.path is not None
    last = outcome.result
    steps = [asp.Step(last.control, asp.Shift())]
    steps += asp.friction.shear_cycles(last.control, asp.Shift(last.stick_slip.shift_x), cycles=1, steps=1)
    again = asp.solve(last.problem, asp.History(steps))
    np.testing.assert_array_equal(last.stick_slip.traction, again.last.stick_slip.traction)
    assert {"stick_slip", "loop", "dissipation"} <= {path.stem for path in (out / "plots").iterdir()}
    assert {figure.name for figure in outcome.figures["stick_slip"]} <= {p.stem for p in (out / "plots").iterdir()}
    (words,) = (words for part, words in outcome.sections if part.name == "stick_slip")
    assert words.sentence in done.output.replace("\n", " ")
    with (out / "path.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    forces = [step.stick_slip.force_x for step in again.steps]
    assert [float(row["force_x (N)"]) for row in rows] == forces
    tree = asp.files.open_tree(out / "result.nc")
    for item in SHEAR_SCALARS:
        assert tree[f"stick_slip/{item.name}"].attrs == item.attributes
    assert float(tree["stick_slip/cycle_dissipation"]) == sum(s.stick_slip.dissipated for s in again.steps[2:])


def test_steps_of_a_document() -> None:
    """Turning points along the friction, cycles, forces, and lists of steps."""
    load, unit = asp.MeanPressure(20e6), 0.4 * 1e-9
    pressed = asp.Step(load, asp.Shift())
    assert course() == [pressed, asp.Step(load, asp.Shift(unit))]
    assert course(shear={}) == [pressed]
    cycle = course(shear={"shift": "0.4 nm", "cycles": 1})
    wanted = asp.friction.shear_cycles(load, asp.Shift(unit))
    assert [s.tangential.x for s in cycle[1:]] == pytest.approx([s.tangential.x for s in wanted], abs=1e-12 * unit)
    turned = course(
        shear={"shift": ["2 nm", "-1 nm"], "steps": 2}, friction={"coefficient": 0.3, "direction": "90 deg"}
    )
    assert [step.tangential.y for step in turned] == pytest.approx([0.0, 1e-9, 2e-9, 1e-9, 0.0, -1e-9])
    assert all(step.tangential.x == 0.0 for step in turned)
    force = course(shear={"force": "1 uN"})
    assert [step.tangential for step in force] == [asp.TangentialForce(), asp.TangentialForce(1e-6)]
    listed = course(shear={"history": ["10 MPa", "1 mN, 1 nm, 2 nm", {"force": "1 uN"}]})
    assert listed == [
        asp.Step(asp.MeanPressure(10e6)),
        asp.Step(asp.Force(1e-3), asp.Shift(1e-9, 2e-9)),
        asp.Step(asp.Force(1e-3), asp.TangentialForce(1e-6)),
    ]
    turned = course(boundary={"kind": "free"}, shear={"history": ["3 nm, 1 deg"]})
    assert turned == [asp.Step(asp.Approach(3 * 1e-9), asp.Shift(twist=math.radians(1.0)))]
    path = course(control={"path": {"mean_pressure": ["20 MPa", "10 MPa"], "steps": 1}})
    assert [(s.normal.value, s.tangential) for s in path] == [
        (20e6, asp.Shift()),
        (10e6, asp.Shift()),
        (10e6, asp.Shift(unit)),
    ]


def test_laws_of_a_document() -> None:
    laws = {
        "coulomb": ({"coefficient": 0.3, "limit": "50 MPa"}, asp.Coulomb(0.3, limit=50e6)),
        "tresca": ({"law": "tresca", "strength": "20 MPa"}, asp.friction.TrescaFriction(20e6)),
        "full stick": ({"law": "full stick"}, asp.friction.FullStick()),
    }
    pressure = np.array([[0.0, 1e8, 1e9]])
    for table, law in laws.values():
        found = build(checked(PROBLEM | {"friction": table})).problem.friction
        assert type(found) is type(law)
        np.testing.assert_array_equal(found.bound(pressure), law.bound(pressure))
        document = checked(PROBLEM | {"friction": table})
        assert loads(dumps(document)) == document
    alone = {key: value for key, value in PROBLEM.items() if key != "shear"}
    assert build(checked(alone)).problem.friction is None
    assert isinstance(
        build(checked(alone | {"friction": {"law": "full stick"}})).problem.friction, asp.friction.FullStick
    )


REFUSED = {
    "no friction": ({"friction": {}}, "friction"),
    "shift and force": ({"shear": {"shift": "1 nm", "force": "1 N"}}, "shear"),
    "cycles of nothing": ({"shear": {"cycles": 2}}, "shear"),
    "twist of a contact that repeats": ({"shear": {"twist": "1 deg"}}, "twist"),
    "list and shift": ({"shear": {"shift": "1 nm", "history": ["1 MPa, 1 nm"]}}, "shear.history"),
    "negative friction": ({"friction": {"coefficient": -0.1}}, "friction.coefficient"),
    "strength without its law": ({"friction": {"coefficient": 0.1, "strength": "1 MPa"}}, "friction"),
    "law without strength": ({"friction": {"law": "tresca"}}, "friction"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(PROBLEM | tables))
    assert refused.value.subject.endswith(subject)


def test_a_force_that_friction_does_not_bear() -> None:
    """20 MPa on 100 µm² and a coefficient of 0.3 bear 600 µN."""
    alone = PROBLEM | {"friction": {"coefficient": 0.3, "coupled": False}}
    with pytest.raises(asp.errors.NoSolutionError) as refused:
        asp.run(alone | {"shear": {"force": "601 uN"}})
    assert refused.value.subject.endswith("tangential force")
    assert asp.run(alone | {"shear": {"force": "500 uN"}}).values["friction_share"] == pytest.approx(5.0 / 6.0)
