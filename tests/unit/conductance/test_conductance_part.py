"""Conductance in documents: numbers of Python, files, load paths, words, studies, and what is
refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from study_cases import InProcess, plan

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.conductance.conductance import conductance
from asperity.physics.conductance.law import ConductingInterface, radiation
from asperity.physics.conductance.part import QUANTITIES
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome, save_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out
from asperity.theories.conductance.spots import hottest

JOINT: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 48],
        "size": "20 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "100 nm", "correlation_length": "2 um"},
    },
    "body": "gold:100nm/nickel",
    "counter_body": "copper",
    "control": {"mean_pressure": "50 MPa"},
    "conductance": {"flow": "both"},
}


def test_numbers_are_those_of_python_and_files_keep_them(tmp_path: Path) -> None:
    asked = {
        "flow": "both",
        "film_resistance": "1e-15 ohm*m^2",
        "gap_conductivity": "0.026 W/m/K",
        "jump": "300 nm",
        "emissivity": 0.1,
        "mean_free_path": "40 nm",
        "voltage": "50 mV",
    }
    document = JOINT | {"conductance": asked}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    values, result = outcome.values, outcome.result
    current = conductance(result, "electrical", ConductingInterface(1e-15))
    heat = conductance(result, "thermal", ConductingInterface(0.0, 0.026, 3e-7, radiation(293.15, (0.1, 0.1))))
    for found in (current, heat):
        assert values[f"{found.flow}_resistance"] == pytest.approx(found.resistance, rel=1e-9)
        assert values[f"{found.flow}_half_spots"] == found.spots.needed()
        assert values[f"{found.flow}_layer_resistance"] == pytest.approx(found.layers)
    assert values["electrical_layer_resistance"] == pytest.approx(1e-7 * 22.14e-9)
    assert values["thermal_gap_share"] == pytest.approx(heat.through_gap)
    assert values["ballistic_resistance"] == pytest.approx(1.0 / current.with_ballistic_spots(40e-9))
    assert values["ballistic_resistance"] > values["electrical_resistance"]
    assert values["hottest_spot"] == pytest.approx(hottest(0.05))
    assert math.isnan(values["electrical_stiffness_conductance"])  # the body is layered
    save_outcome(outcome, tmp_path / "joint.nc")
    again = load_outcome(tmp_path / "joint.nc")
    tree = asp.files.open_tree(tmp_path / "joint.nc")
    for item in QUANTITIES:
        if not item.name.startswith("path_"):
            assert tree[f"conductance/{item.name}"].attrs["units"] == item.unit
    np.testing.assert_allclose(tree["conductance/thermal_density"], heat.density, rtol=1e-6, atol=1e-12)
    first, second = (next(w for p, w in kept.sections if p.name == "conductance") for kept in (outcome, again))
    assert (first.sentence, first.rows, first.holds) == (second.sentence, second.rows, second.holds)
    assert {figure.name for figure in again.figures["conductance"]} == {
        f"{flow}_{kind}" for flow in ("electrical", "thermal") for kind in ("density", "drop")
    }


def test_what_is_known_flows_and_stiffness_agrees() -> None:
    one = JOINT | {"body": "steel", "counter_body": {"rigid": True}, "conductance": {}}
    outcome = asp.run(one)
    assert outcome.found["conductance"].detail["flows"] == ["thermal"]
    values = outcome.values
    assert values["thermal_stiffness_conductance"] == pytest.approx(values["thermal_conductance"], rel=1e-5)
    assert "rigid conductor" in {finding.criterion for finding in outcome.findings}


def test_a_loaded_and_unloaded_joint() -> None:
    control = {"path": {"mean_pressure": ["200 MPa", "20 MPa", "0 Pa"], "steps": 3}}
    law = {"kind": "hardness", "hardness": "1 GPa"}
    outcome = asp.run(JOINT | {"body": "nickel", "control": control, "law": law, "conductance": {"flow": "thermal"}})
    found = outcome.found["conductance"]
    along = found.values["path_thermal_conductance_per_area"]
    assert along.shape == (9,)
    assert along[-1] == 0.0
    peak = int(np.argmax(along))
    assert found.values["thermal_conductance_per_area"] == pytest.approx(along[peak])
    pressures = [step.mean_pressure for step in outcome.path.steps]
    falling = slice(-1, peak, -1)
    assert np.interp(pressures[0], pressures[falling], along[falling]) > 1.02 * along[0]
    assert "thermal_path" in {figure.name for figure in outcome.figures["conductance"]}
    assert all(figure.picture for figure in outcome.figures["conductance"])
    words = next(words for part, words in outcome.sections if part.name == "conductance")
    assert [len(table.cells) for _, table in words.tables] == [2]
    half = 0.5 * max(pressures)
    ratio = np.interp(half, pressures[: peak - 1 : -1], along[: peak - 1 : -1]) / np.interp(
        half, pressures[: peak + 1], along[: peak + 1]
    )
    assert ratio > 1.02
    assert f"{ratio:.2g}" in words.sentence
    elastic = asp.run(JOINT | {"body": "nickel", "control": control, "conductance": {"flow": "thermal"}})
    assert "Unloaded" not in next(words for part, words in elastic.sections if part.name == "conductance").sentence


def test_few_pixels_are_warned_of() -> None:
    rough = JOINT["surface"] | {"points": [24, 24]}
    outcome = asp.run(JOINT | {"surface": rough, "control": {"mean_pressure": "1 MPa"}})
    assert "pixels of conducting spots" in {finding.criterion for finding in outcome.findings}


REFUSED = {
    "no conductivity at all": (
        {"body": "E=1GPa,nu=0.3", "conductance": {}},
        "electrical resistivity of body or thermal conductivity of body",
    ),
    "no resistivity": ({"body": "alumina", "conductance": {"flow": "both"}}, "electrical resistivity of alumina"),
    "no conductivity of a layer": (
        {"body": "DLC:5nm/nickel", "conductance": {"flow": "thermal"}},
        "thermal conductivity of DLC",
    ),
    "film without its unit": ({"conductance": {"film_resistance": "1e-12"}}, "conductance.film_resistance"),
    "film of a length": ({"conductance": {"film_resistance": "1 nm"}}, "conductance.film_resistance"),
    "jump without gas": ({"conductance": {"jump": "300 nm"}}, "conductance.jump"),
    "voltage of heat": ({"conductance": {"flow": "thermal", "voltage": "1 mV"}}, "conductance.voltage"),
    "gas of current": ({"conductance": {"flow": "electrical", "emissivity": 0.5}}, "conductance.emissivity"),
    "emissivity": ({"conductance": {"emissivity": 1.5}}, "conductance.emissivity"),
    "flow": ({"conductance": {"flow": "magnetic"}}, "conductance.flow"),
    "line": (
        {"surface": JOINT["surface"] | {"points": [64, 1], "size": "20 um x 1 m"}, "boundary": {"kind": "line"}},
        "boundary of a conducting contact",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(JOINT | tables))
    assert refused.value.subject.endswith(subject)


def test_a_study_over_the_thickness_of_the_gold(tmp_path: Path) -> None:
    """Gold conducts better than nickel: the thicker, the less resistance; as single runs say."""
    quantities = ["electrical_resistance", "thermal_conductance_per_area"]
    axis = {"path": "body.layers.0.thickness", "values": ["50 nm", "2 um"]}
    made = plan(problem=JOINT, axes=[axis], quantities=quantities)
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    alone = asp.run(JOINT | {"body": "gold:2um/nickel"}).values
    for name in quantities:
        assert float(data[name][1]) == pytest.approx(alone[name], rel=1e-5)
    assert float(data["electrical_resistance"][0]) > float(data["electrical_resistance"][1])
