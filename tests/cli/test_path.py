"""Load paths and effective hardness on the command line: what is printed, what is written."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import SCALE, Runner

import asperity as asp
from asperity.run.document import load_document

pytestmark = pytest.mark.usefixtures("undrawn")
COATED = ("--body", "E=100GPa,nu=0.3,H=9GPa:2nm/E=100GPa,nu=0.3,H=0.1GPa")
PATH = ("--path", "30MPa,0,40MPa,0", "--path-steps", "3")


def test_a_path_is_printed_and_written(run: Runner, matrix: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    body = ("--body", "E=100GPa,nu=0.3,H=0.5GPa")
    result = run("contact", matrix, *SCALE, *body, "--hardness", "body", *PATH, "--out", out)
    assert result.exit_code == 0, result.stderr
    for text in ("30 MPa", "40 MPa", "12"):
        assert text in result.stdout
    names = {"report.html", "result.nc", "scalars.csv", "plots", "problem.toml", "path.csv"}
    assert {path.name for path in out.iterdir()} == names
    plots = {path.stem for path in (out / "plots").iterdir()}
    assert {"load_loop", "area_loop", "energies", "indentation", "residual"} <= plots
    document = load_document(out / "problem.toml")
    assert document.control.path is not None
    assert document.control.path.mean_pressure == (30e6, "0", 40e6, "0")
    assert document.control.path.steps == 3

    data = asp.files.open_tree(out / "result.nc")["path"].to_dataset()
    assert data.sizes["step"] == 12
    np.testing.assert_allclose(data["mean_pressure"][[2, 5, 8, 11]], [30e6, 0.0, 40e6, 0.0], rtol=1e-9)
    assert float(data["plastic_work"].sum()) > 0.0
    last = asp.load(out / "result.nc")
    np.testing.assert_array_equal(last.permanent_indentation, data["permanent_indentation"][-1])
    with (out / "path.csv").open(encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == 12

    again = run("contact", "--from", out / "problem.toml", "--out", tmp_path / "again")
    assert again.exit_code == 0, again.stderr
    other = asp.files.open_tree(tmp_path / "again" / "result.nc")["path"].to_dataset()
    np.testing.assert_array_equal(other["pressure"], data["pressure"])


@pytest.mark.parametrize(
    ("path", "last"), [("0.2nm,0.1nm", asp.Approach(0.1e-9)), ("20uN,0", asp.Unloaded())], ids=["approach", "force"]
)
def test_a_path_of_approaches_and_of_forces(
    run: Runner, matrix: Path, tmp_path: Path, path: str, last: asp.Approach | asp.Unloaded
) -> None:
    command = ("contact", matrix, *SCALE, *COATED, "--boundary", "free", "--path", path, "--out", tmp_path / "run")
    result = run(*command)
    assert result.exit_code == 0, result.stderr
    assert asp.files.open_tree(tmp_path / "run" / "result.nc")["path"].to_dataset().sizes["step"] == 20
    control = asp.load(tmp_path / "run" / "result.nc").control
    assert type(control) is type(last)
    assert vars(control) == pytest.approx(vars(last), rel=1e-15)


def test_the_steps_of_a_document_are_replaced(run: Runner, matrix: Path, tmp_path: Path) -> None:
    first = tmp_path / "a.toml"
    assert run("contact", matrix, *SCALE, *COATED, *PATH, "--save-document", first).exit_code == 0
    second = run("contact", "--from", first, "--path-steps", "2", "--save-document", tmp_path / "b.toml")
    assert second.exit_code == 0, second.stderr
    table = load_document(tmp_path / "b.toml").control.path
    assert table is not None
    assert table.steps == 2


def test_effective_hardness(run: Runner, matrix: Path) -> None:
    result = run("contact", matrix, *SCALE, *COATED, "--hardness", "effective", "--pressure", "20MPa")
    assert result.exit_code == 0, result.stderr
    assert "9 GPa" in result.stdout
    assert "100 MPa" in result.stdout


def test_plots_of_an_indented_surface(run: Runner, matrix: Path, tmp_path: Path, rendered: None) -> None:
    out = tmp_path / "run"
    body = ("--body", "E=100GPa,nu=0.3,H=0.5GPa")
    result = run("contact", matrix, *SCALE, *body, "--hardness", "body", "--pressure", "30MPa", "--out", out)
    assert result.exit_code == 0, result.stderr
    drawn = run("plot", out / "result.nc", "--kind", "indentation", "--out", tmp_path)
    assert drawn.exit_code == 0, drawn.stderr
    assert (tmp_path / "indentation.png").stat().st_size > 1000


def test_the_plastic_load(run: Runner, matrix: Path, tmp_path: Path) -> None:
    body = ("--body", "E=100GPa,nu=0.3,H=0.5GPa")
    options = ("--hardness", "body", "--pressure", "1MPa", "--plastic-load", "--out", tmp_path / "run")
    result = run("contact", matrix, *SCALE, *body, *options)
    assert result.exit_code == 0, result.stderr
    with (tmp_path / "run" / "scalars.csv").open(encoding="utf-8") as file:
        scalars = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert 0.0 < float(scalars["plastic_load_pressure"]) < 0.5e9
