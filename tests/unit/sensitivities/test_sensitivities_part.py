"""Sensitivities in documents: numbers of Python, files, load paths, words, studies, and what is
refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from study_cases import InProcess, plan
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.core.errors import InputError
from asperity.physics.sensitivities.part import QUANTITIES
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome, save_outcome
from asperity.sensitivities import PressureNorm, sensitivities
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out

COATED: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "20 um",
        "seed": 2,
        "spectrum": {"kind": "gaussian", "rms_height": "50 nm", "correlation_length": "3 um"},
    },
    "body": "E=300GPa,nu=0.2,Y=8GPa,name=film:1um/E=200GPa,nu=0.3,Y=1GPa,name=base",
    "control": {"mean_pressure": "200 MPa"},
    "sensitivities": {},
}


def test_numbers_are_those_of_python_and_files_keep_them(tmp_path: Path) -> None:
    document = COATED | {"sensitivities": {"of": ["peak_pressure", "stiffness", "yield"], "exponent": 8.0}}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    values = outcome.found["sensitivities"].values
    peak = sensitivities(outcome.result, PressureNorm(8.0))
    names = [str(name) for name in values["sensitivity_parameter"]]
    assert {*names} == {*peak.relative, "strength"}
    for name, relative in peak.relative.items():
        assert values["sensitivity_peak_pressure"][names.index(name)] == pytest.approx(relative, rel=1e-6, abs=1e-9)
    assert values["sensitive_peak_pressure"] == pytest.approx(peak.value, rel=1e-9)
    assert values["sensitivity_peak_pressure_load"] == pytest.approx(peak.relative["force"], rel=1e-6)
    assert values["sensitivity_peak_pressure_thickness"] == pytest.approx(
        peak.relative["body.layers[0].thickness"], rel=1e-6
    )
    np.testing.assert_allclose(values["sensitivity_map"], np.asarray(peak["heights"]) / peak.value, rtol=1e-5, atol=1)
    assert values["sensitivity_stiffness_load"] == pytest.approx(
        sensitivities(outcome.result, "stiffness", "force").relative["force"], rel=1e-6
    )
    save_outcome(outcome, tmp_path / "sensitive.nc")
    again = load_outcome(tmp_path / "sensitive.nc")
    tree = asp.files.open_tree(tmp_path / "sensitive.nc")
    kept = {item.name: item for item in QUANTITIES if item.name in values}
    for name, item in kept.items():
        assert tree[f"sensitivities/{name}"].attrs.get("units", "") == item.unit
    first, second = (next(w for p, w in one.sections if p.name == "sensitivities") for one in (outcome, again))
    assert (first.sentence, first.rows, first.tables) == (second.sentence, second.rows, second.tables)
    drawn = {figure.name for figure in again.figures["sensitivities"]}
    assert drawn == {
        "sensitivities_peak_pressure",
        "sensitivities_normal_stiffness",
        "sensitivities_load_at_first_yield",
        "sensitivity_map",
    }
    assert all(figure.picture for figure in again.figures["sensitivities"])
    assert {"Giles2000", "Squire1998"} <= {*outcome.found["sensitivities"].citation_keys}


def test_only_some_parameters() -> None:
    asked = {"of": ["approach"], "to": ["body.layers", "force"]}
    outcome = asp.run(COATED | {"sensitivities": asked})
    names = {str(name) for name in outcome.found["sensitivities"].values["sensitivity_parameter"]}
    assert names == {f"body.layers[0].{key}" for key in ("youngs_modulus", "poisson_ratio", "thickness")} | {"force"}
    assert "sensitivity_map" not in outcome.found["sensitivities"].values
    assert {figure.name for figure in outcome.figures["sensitivities"]} == {"sensitivities_approach"}


def test_the_largest_load_of_a_path_is_the_one() -> None:
    control = {"path": {"mean_pressure": ["200 MPa", "0 Pa"], "steps": 3}}
    at_peak = asp.run(COATED | {"control": control}).values
    alone = asp.run(COATED).values
    assert at_peak["sensitivity_approach_load"] == pytest.approx(alone["sensitivity_approach_load"], rel=1e-4)
    first = asp.run(COATED | {"control": control, "sensitivities": {"step": 1}}).values
    assert first["sensitive_approach"] < at_peak["sensitive_approach"]


def test_homogeneous_bodies_have_one_modulus() -> None:
    values = asp.run(COATED | {"body": "E=200GPa,nu=0.3,name=base"}).values
    assert values["sensitivity_approach_modulus"] == values["sensitivity_approach_base_modulus"]
    # the load divided by the modulus decides
    assert values["sensitivity_approach_modulus"] == pytest.approx(-values["sensitivity_approach_load"], rel=1e-6)


REFUSED = {
    "unknown number": ({"sensitivities": {"of": ["volume"]}}, "sensitivities.of[1]"),
    "exponent": ({"sensitivities": {"exponent": 0.5}}, "sensitivities.exponent"),
    "no strength": (
        {"body": "E=200GPa,nu=0.3", "sensitivities": {"of": ["yield"]}},
        "strength of a layer or base",
    ),
    "no conductivity": (
        {"body": "E=200GPa,nu=0.3,name=base", "sensitivities": {"of": ["electrical_conductance"]}},
        "electrical resistivity of base",
    ),
    "adhesion": (
        {"adhesion": {"work": "50 mJ/m^2", "range": "1 nm"}},
        "contact of sensitivities",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(COATED | tables))
    assert refused.value.subject.endswith(subject)


def test_a_study_over_the_thickness(tmp_path: Path) -> None:
    """The thicker a stiff film is, the less its base decides."""
    quantities = ["sensitivity_approach_base_modulus", "sensitivity_approach_modulus"]
    axis = {"path": "body.layers.0.thickness", "values": ["0.2 um", "1 um", "5 um"]}
    made = plan(problem=COATED, axes=[axis], quantities=quantities)
    carry_out(made, tmp_path / "r.log", InProcess())
    table = dataset(made, tmp_path / "r.log")
    of_base, of_film = (np.abs(np.asarray(table[name]).ravel()) for name in quantities)
    assert np.all(np.diff(of_base) < 0.0)
    assert np.all(np.diff(of_film) > 0.0)


def test_the_command_asks_for_them(tmp_path: Path) -> None:
    plain = {key: value for key, value in COATED.items() if key != "sensitivities"}
    (tmp_path / "p.toml").write_text(dumps(checked(plain)), encoding="utf-8")
    options = ("--sensitivities-of", "approach,mean_gap", "--out", str(tmp_path / "o"))
    done = CliRunner().invoke(app, ["contact", "--from", str(tmp_path / "p.toml"), *options])
    assert done.exit_code == 0, done.output
    assert "changes by" in " ".join(done.output.split())
    tree = asp.files.open_tree(tmp_path / "o" / "result.nc")
    single = asp.run(COATED).values
    assert float(tree["sensitivities/sensitivity_approach_load"]) == pytest.approx(
        single["sensitivity_approach_load"], rel=1e-5
    )
    drawn = {path.stem for path in (tmp_path / "o").rglob("*.png")}
    assert drawn >= {"sensitivities_approach", "sensitivities_mean_gap", "sensitivity_map"}
