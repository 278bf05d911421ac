"""Rolling on the command line and in documents: the numbers of Python, files and figures made
again, studies, and what is refused."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import Runner
from study_cases import InProcess, plan

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.rolling.part import FIELDS, SCALARS
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out

WHEEL: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [24, 24], "size": "1.6 mm", "radius": "50 mm"},
    "body": "E=200GPa,nu=0.3",
    "counter_body": "E=200GPa,nu=0.3",
    "boundary": {"kind": "free"},
    "control": {"force": "500 N"},
    "friction": {"coefficient": 0.3},
    "rolling": {"longitudinal": "0.1 %", "spin": "0.3 rad/m"},
}
OPTIONS = (
    "--level",
    "none",
    "--body",
    "E=200GPa,nu=0.3",
    "--counter-body",
    "E=200GPa,nu=0.3",
    "--boundary",
    "free",
    "--load",
    "500N",
)


@pytest.fixture
def wheel(tmp_path: Path) -> Path:
    path = tmp_path / "wheel.nc"
    asp.files.save_surface(build(checked(WHEEL)).problem.surface, path)
    return path


@pytest.mark.slow
def test_a_wheel_and_its_files(run: Runner, wheel: Path, tmp_path: Path) -> None:
    """Options give the numbers of Python; the files hold them, and give the same words and pictures
    again."""
    out = tmp_path / "out"
    rolling = ("--friction", "0.3", "--creepage", "0.1%", "--spin", "0.3rad/m", "--creep-points", "2")
    done = run("contact", wheel, *OPTIONS, *rolling, "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    problem = build(checked(WHEEL)).problem
    law = asp.Coulomb(0.3, coupled=True)
    rolls = asp.ContactProblem(
        problem.surface, problem.body, counter_body=problem.counter_body, boundary=asp.Free(), friction=law
    )
    found = asp.roll(rolls, asp.Force(500.0), asp.rolling.Creepage(1e-3, 0.0, 0.3))
    values = outcome.values
    assert values["rolling_longitudinal_force"] == pytest.approx(found.longitudinal_force, rel=1e-6)
    assert values["rolling_heat"] == pytest.approx(found.dissipated, rel=1e-6)
    assert values["fastsim_longitudinal_force"] == pytest.approx(found.longitudinal_force, rel=0.1)
    assert np.isnan(values["carter_longitudinal_force"])
    tree = asp.files.open_tree(out / "result.nc")
    for item in (*SCALARS, *FIELDS):
        assert tree[f"rolling/{item.name}"].attrs["units"] == item.unit
    largest = np.abs(found.traction).max()
    np.testing.assert_allclose(tree["rolling/rolling_traction_x"], found.traction[0], atol=1e-5 * largest)
    assert tree["rolling/creep_longitudinal"].values == pytest.approx([5e-4, 1e-3])
    made = {path.stem for path in (out / "plots").iterdir()}
    assert {figure.name for figure in outcome.figures["rolling"]} <= made
    assert {"rolling_map", "rolling_section", "creep_curve"} <= made
    (words,) = (words for part, words in outcome.sections if part.name == "rolling")
    assert words.sentence in done.output.replace("\n", " ")
    with (out / "scalars.csv").open(encoding="utf-8") as file:
        rows = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert float(rows["traction_coefficient"]) == values["traction_coefficient"]
    again = run("report", out / "result.nc", "--out", tmp_path / "again.html")
    assert again.exit_code == 0, again.output
    assert words.sentence in (tmp_path / "again.html").read_text(encoding="utf-8")


def test_a_rough_wheel(run: Runner, tmp_path: Path) -> None:
    """A map that moves with the material: means, and the forces over the distance."""
    problem = build(checked(WHEEL)).problem
    rng = np.random.default_rng(2)
    spacing = problem.grid.spacing
    heights = 2e-8 * rng.normal(size=(10, 24))
    asp.files.save_surface(asp.Surface(heights, *spacing), tmp_path / "rough.nc")
    pixel = float(spacing[0])
    table = {"longitudinal": 0.001, "roughness_file": "rough.nc", "distance": f"{60 * pixel} m"}
    outcome = asp.run(WHEEL | {"rolling": table}, tmp_path)
    values = outcome.values
    path = outcome.found["rolling"].values["rolled_force_x"]
    assert path.shape == (60,)
    assert values["rolling_force_deviation"] > 0.0
    assert np.isnan(values["fastsim_longitudinal_force"])
    smooth = asp.run(WHEEL | {"rolling": {"longitudinal": 0.001}}).values
    assert values["rolling_longitudinal_force"] == pytest.approx(smooth["rolling_longitudinal_force"], rel=0.1)
    assert "rolling_path" in {figure.name for figure in outcome.figures["rolling"]}


def test_documents_keep_their_text_and_lines_carter() -> None:
    document = checked(WHEEL)
    assert loads(dumps(document)) == document
    assert build(document).problem.friction is None  # pressed without shear, then rolled
    line = WHEEL | {
        "surface": {"kind": "cylinder", "points": [64, 1], "size": "1.6 mm x 1 mm", "radius": "50 mm"},
        "boundary": {"kind": "line"},
        "control": {"force": "50 N/mm"},
        "rolling": {"longitudinal": 5e-4, "direction": "-x"},
    }
    values = asp.run(line).values
    assert values["carter_longitudinal_force"] == pytest.approx(values["rolling_longitudinal_force"], rel=0.05)
    sliding = asp.run(WHEEL | {"rolling": {"lateral": "20 %"}})
    assert {finding.criterion for finding in sliding.findings} >= {"gross sliding", "large creepage"}
    assert sliding.values["rolling_friction_share"] == pytest.approx(1.0, abs=1e-3)


REFUSED = {
    "no friction": ({"friction": {}}, "friction"),
    "no creepage": ({"rolling": {}}, "rolling"),
    "distance of a smooth wheel": ({"rolling": {"longitudinal": 0.001, "distance": "1 mm"}}, "rolling.distance"),
    "spin without a unit": ({"rolling": {"spin": 0.3}}, "rolling.spin"),
    "no such direction": ({"rolling": {"longitudinal": 0.001, "direction": "z"}}, "rolling.direction"),
    "rolling and shifting": ({"shear": {"shift": "1 um"}}, "rolling"),
    "spin of a contact that repeats": ({"boundary": {"kind": "periodic"}}, "spin"),
    "hardness": ({"law": {"kind": "hardness", "hardness": "5 GPa"}}, "law of a rolling contact"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    tables, subject = REFUSED[name]
    with pytest.raises(InputError) as refused:
        build(checked(WHEEL | tables))
    assert refused.value.subject.endswith(subject)


def test_a_study_over_the_creepage(tmp_path: Path) -> None:
    """Forces of a campaign are those of single runs; nothing is drawn, so that no curve is
    computed."""
    quantities = ["traction_coefficient", "rolling_heat"]
    axis = {"path": "rolling.longitudinal", "values": ["0.02 %", "0.08 %"]}
    made = plan(problem=WHEEL, axes=[axis], quantities=quantities)
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    alone = asp.run(WHEEL | {"rolling": WHEEL["rolling"] | {"longitudinal": "0.08 %"}}).values
    for name in quantities:
        assert float(data[name][1]) == pytest.approx(alone[name], rel=1e-4)
        assert float(data[name][0]) < float(data[name][1])
