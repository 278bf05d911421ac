"""The report of a run is made again from its result file alone, and the file is one labelled
tree."""

from __future__ import annotations

import difflib
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from cli.conftest import SCALE, Runner
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import BAD_INPUT, app
from asperity.run.stored import load_outcome, outcome_to_xarray

KINDS = {
    "stress": (
        "--pressure",
        "30MPa",
        "--friction",
        "0.2",
        "--section",
        "y=max",
        "--profile",
        "x=max",
        "--depths",
        "1nm,5nm",
    ),
    "path": ("--path", "30MPa,0,40MPa", "--path-steps", "2"),
    "wet": ("--pressure", "30MPa", "--liquid", "water", "--film", "0.4nm"),
}


@pytest.fixture(scope="module", params=KINDS)
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp(request.param)
    heights = 5.0 * np.random.default_rng(4).normal(size=(12, 16))
    np.savetxt(place / "map.txt", heights)
    body = ("--body", "DLC:5nm/steel", "--hardness", "9GPa")
    words = ("contact", place / "map.txt", *SCALE, *body, *KINDS[request.param], "--out", place / "run")
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.stderr
    return place / "run"


def test_the_report_is_made_again(folder: Path, run: Runner, tmp_path: Path) -> None:
    again = run("report", folder / "result.nc", "--out", tmp_path / "again.html")
    assert again.exit_code == 0, again.stderr
    first, second = (
        path.read_text(encoding="utf-8").splitlines() for path in (folder / "report.html", tmp_path / "again.html")
    )
    differing = [line for line in difflib.ndiff(first, second) if line[0] in "+-"]
    # the gaps of the steps of a path come back within their rounding
    # (tests/unit/report/test_scene.py)
    expected = ("written (UTC)", "application/json") if (folder / "path.csv").exists() else ("written (UTC)",)
    assert all(any(word in line for word in expected) for line in differing), differing


@pytest.mark.parametrize(
    "damaged", ["", "{", "[]", "null", '{"created": "now"}', '{"created": "now", "software": {"a": {}}}']
)
def test_damaged_provenance_is_a_damaged_file(damaged: str, folder: Path, run: Runner, tmp_path: Path) -> None:
    shutil.copy(folder / "result.nc", tmp_path / "result.nc")
    with h5py.File(tmp_path / "result.nc", "r+") as file:
        file.attrs["provenance"] = damaged
    said = run("report", tmp_path / "result.nc", "--out", tmp_path / "again.html")
    assert said.exit_code == BAD_INPUT
    assert str(tmp_path / "result.nc") in said.stderr.replace("\n", "")
    assert not (tmp_path / "again.html").exists()


def test_the_pictures_are_drawn_again(folder: Path, run: Runner, tmp_path: Path) -> None:
    assert run("plot", folder / "result.nc", "--out", tmp_path / "again").exit_code == 0
    names = {path.name for path in (folder / "plots").iterdir()}
    assert {path.name for path in (tmp_path / "again").iterdir()} == names
    for name in names:
        assert (tmp_path / "again" / name).read_bytes() == (folder / "plots" / name).read_bytes(), name


def test_the_tree_is_labelled(folder: Path) -> None:
    tree = asp.files.open_tree(folder / "result.nc")
    for group in tree.subtree:
        data = group.to_dataset(inherit=False)
        assert all({"units", "long_name"} <= set(data[name].attrs) for name in data.variables), group.path
        assert {"x", "y"} & set(data.dims) <= set(group.coords), group.path  # its own, or those of the contact
    assert tree.groups == outcome_to_xarray(load_outcome(folder / "result.nc")).groups
    assert tree.attrs["status_outcome"] == "converged"
    if "stress" in tree.children:
        stress = tree["stress"]
        for name in ("von_mises", "tension", "shear"):
            assert float(stress[f"layer_max_{name}"].max()) == float(stress[f"max_{name}"])
            assert stress[f"layer_max_{name}_depth"].attrs["units"] == "m"


def test_findings_and_values_are_those_of_the_run(folder: Path) -> None:
    outcome, again = asp.run(folder / "problem.toml"), load_outcome(folder / "result.nc")
    assert again.findings == outcome.findings
    assert again.status.outcome is outcome.status.outcome
    assert again.values == pytest.approx(outcome.values, nan_ok=True)
    assert asp.load(folder / "result.nc") is not None
