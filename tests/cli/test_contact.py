"""The command ``contact``: what it prints, what it writes, what it refuses."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from refusals import subject_of
from study_cases import InProcess

import asperity as asp
from asperity.io.results import load
from asperity.run.document import load_document
from asperity.studies.campaign import open_study

pytestmark = pytest.mark.usefixtures("undrawn")


def test_prints_problem_result_and_status(run: Runner, matrix: Path) -> None:
    result = run("contact", matrix, *SCALE, *BODY, *LOAD)
    assert result.exit_code == 0, result.stderr
    for text in ("rough.txt", "32 × 24", "8 µm × 6 µm", "1 MPa", "109.9 GPa"):
        assert text in result.stdout
    assert result.stderr == ""


@pytest.mark.parametrize(
    ("control", "prescribed"),
    [
        (("--pressure", "1MPa"), asp.MeanPressure(1e6)),
        (("--load", "50uN"), asp.Force(50e-6)),
        (("--approach", "0.5nm"), asp.Approach(0.5e-9)),
        (("--mean-gap", "2nm"), asp.MeanGap(2e-9)),
    ],
)
def test_loads(
    run: Runner, matrix: Path, tmp_path: Path, control: tuple[str, str], prescribed: asp.MeanPressure
) -> None:
    result = run("contact", matrix, *SCALE, *BODY, *control, "--out", tmp_path / "run")
    assert result.exit_code == 0, result.stderr
    solved = load(tmp_path / "run" / "result.nc").control
    assert type(solved) is type(prescribed)
    assert solved.value == pytest.approx(prescribed.value, rel=1e-15)


def test_out_holds_everything_and_the_document_gives_the_same_answer(
    run: Runner, matrix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    out = tmp_path / "deep" / "run"
    result = run("contact", matrix.name, *SCALE, *BODY, *LOAD, "--hardness", "body", "--out", "deep/run")
    assert result.exit_code == 0, result.stderr
    assert {path.name for path in out.iterdir()} == {"report.html", "result.nc", "scalars.csv", "plots", "problem.toml"}
    assert [path.name for path in (tmp_path / "deep").iterdir()] == ["run"]
    assert len(list((out / "plots").glob("*.png"))) >= 5
    assert "deep/run/report.html" in result.stdout
    assert load_document(out / "problem.toml").surface.path == "../../rough.txt"  # type: ignore[union-attr]

    again = run("contact", "--from", out / "problem.toml", "--out", tmp_path / "again")
    assert again.exit_code == 0, again.stderr
    first, second = load(out / "result.nc"), load(tmp_path / "again" / "result.nc")
    np.testing.assert_array_equal(first.pressure, second.pressure)
    with (out / "scalars.csv").open(encoding="utf-8") as file:
        scalars = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert float(scalars["area_fraction"]) == first.area_fraction


def test_single_files(run: Runner, matrix: Path, tmp_path: Path) -> None:
    paths = {name: tmp_path / name for name in ("p.toml", "s.csv", "f.vti")}
    files = ("--save-document", paths["p.toml"], "--csv", paths["s.csv"], "--vtk", paths["f.vti"])
    command = ("contact", matrix, *SCALE, *BODY, *LOAD, *files)
    result = run(*command)
    assert result.exit_code == 0, result.stderr
    assert all(path.stat().st_size > 100 for path in paths.values())
    again = run(*command)
    assert subject_of(again) == "output file"
    assert "--force" in again.stderr
    assert run(*command, "--force").exit_code == 0


def test_never_overwrites_without_force(run: Runner, matrix: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    out.mkdir()
    (out / "notes.txt").write_text("mine")
    command = ("contact", matrix, *SCALE, *BODY, *LOAD, "--out", out)
    result = run(*command)
    assert subject_of(result) == "output folder"
    assert "--force" in result.stderr
    assert [path.name for path in out.iterdir()] == ["notes.txt"]
    assert run(*command, "--force").exit_code == 0
    assert (out / "notes.txt").read_text() == "mine"
    assert (out / "result.nc").exists()


def test_empty_folder_is_fine(run: Runner, matrix: Path, tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    assert run("contact", matrix, *SCALE, *BODY, *LOAD, "--out", tmp_path / "run").exit_code == 0


@pytest.mark.parametrize("option", ["--out", "--csv", "--save-document"])
def test_unwritable_output(run: Runner, matrix: Path, option: str) -> None:
    result = run("contact", matrix, *SCALE, *BODY, *LOAD, option, matrix / "below" / "x")
    assert result.exit_code == 2
    assert result.stderr.startswith("asperity: ")
    assert len(result.stderr.splitlines()) == 1


def test_not_converged_is_exit_1_with_the_remedy_and_still_written(run: Runner, matrix: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    result = run("contact", matrix, *SCALE, *BODY, *LOAD, "--max-iterations", 1, "--out", out)
    assert result.exit_code == 1
    assert "--max-iterations" in result.stdout
    assert not load(out / "result.nc").converged


def test_preparation_steps_in_order(run: Runner, matrix: Path, tmp_path: Path) -> None:
    options = ("--crop", "0um:4um,1um:6um", "--level", "quadratic", "--resample", "20x16", "--taper", 0.2)
    saved = ("--save-document", tmp_path / "p.toml")
    result = run("contact", matrix, *SCALE, *BODY, *LOAD, *options, *saved, "--periodise")
    assert result.exit_code == 0, result.stderr
    steps = [step.step for step in load_document(tmp_path / "p.toml").surface.prepare]
    assert steps == ["crop", "level", "fill", "resample", "taper", "periodise"]
    assert "20 × 16" in result.stdout
    assert "4 µm × 5 µm" in result.stdout


def test_missing_points_are_filled_and_counted(run: Runner, tmp_path: Path) -> None:
    heights = np.random.default_rng(2).normal(size=(16, 16))
    heights[3, 4] = heights[8, 8:11] = np.nan
    np.savetxt(tmp_path / "holes.txt", heights)
    command = ("contact", tmp_path / "holes.txt", "--size", "4um", "--height-unit", "nm", *BODY, *LOAD)
    result = run(*command, "--out", tmp_path / "run")
    assert result.exit_code == 0, result.stderr
    filled = load(tmp_path / "run" / "result.nc").problem.surface
    assert np.isfinite(filled.heights).all()
    known = np.isfinite(asp.read(tmp_path / "holes.txt", size=(4e-6, 4e-6), height_unit="nm").heights)
    assert np.count_nonzero(~known) == 4
    assert subject_of(run(*command, "--fill", "none")) == "surface"


def test_counter_surface_boundary_solver_and_own_material(run: Runner, matrix: Path, tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text('[material."glass"]\nyoungs_modulus = "70 GPa"\npoisson_ratio = 0.2\nhardness = "6 GPa"\n')
    bodies = (
        "--body",
        "glass",
        "--counter",
        "DLC",
        "--materials-file",
        own,
        "--counter-surface",
        matrix,
        "--mirror",
        "y",
    )
    rest = (
        "--boundary",
        "free",
        "--solver",
        "steepest_descent",
        "--tolerance",
        1e-4,
        "--threads",
        1,
        "--hardness",
        "6GPa",
    )
    result = run("contact", matrix, *SCALE, *bodies, *LOAD, *rest)
    assert result.exit_code == 0, result.stderr
    for text in ("glass", "70 GPa", "DLC", "140 GPa", "6 GPa", "steepest_descent"):
        assert text in result.stdout


def test_options_replace_parts_of_a_document(run: Runner, matrix: Path, tmp_path: Path) -> None:
    document = tmp_path / "p.toml"
    assert run("contact", matrix, *SCALE, *BODY, *LOAD, "--save-document", document).exit_code == 0
    options = ("--load", "20uN", "--body", "DLC", "--tolerance", 1e-5, "--out", tmp_path / "run")
    result = run("contact", "--from", document, *options)
    assert result.exit_code == 0, result.stderr
    solved = load(tmp_path / "run" / "result.nc")
    assert solved.force == pytest.approx(20e-6)
    assert solved.problem.body.youngs_modulus == asp.material("DLC").youngs_modulus
    assert (
        subject_of(run("contact", matrix, "--from", document))
        == "FILE and the options for reading, preparation and counter surface"
    )


def test_advice_is_printed(run: Runner, matrix: Path) -> None:
    result = run("contact", matrix, *SCALE, *BODY, *LOAD)
    assert "(resolution)" in result.stdout


def test_coated_bodies(run: Runner, matrix: Path, tmp_path: Path) -> None:
    bodies = ("--body", "DLC:5nm~/Cr:2nm/steel", "--counter-body", "E=1GPa,nu=0.4:1um/rigid", "--hardness", "body")
    result = run("contact", matrix, *SCALE, *bodies, *LOAD, "--out", tmp_path / "run")
    assert result.exit_code == 0, result.stderr
    for text in ("DLC 5 nm", "chromium 2 nm", "steel", "1 GPa", "1 µm", "15 GPa"):
        assert text in result.stdout, text
    solved = load(tmp_path / "run" / "result.nc")
    layers = [asp.Layer(asp.material("DLC"), 5e-9, asp.Frictionless()), asp.Layer(asp.material("Cr"), 2e-9)]
    assert str(vars(solved.problem.body)) == str(vars(asp.Layered(layers, asp.material("steel"))))
    again = run("contact", "--from", tmp_path / "run" / "problem.toml", "--out", tmp_path / "again")
    assert again.exit_code == 0, again.stderr
    np.testing.assert_array_equal(load(tmp_path / "again" / "result.nc").pressure, solved.pressure)


def test_line_contact_from_a_document(run: Runner, tmp_path: Path) -> None:
    document = tmp_path / "cylinder.toml"
    document.write_text(
        """version = 1
body = "E=100GPa,nu=0.3:1um/steel"
surface = { kind = "cylinder", radius = "1 mm", axis = "y", points = [64, 1], size = "20 um x 1 m" }
boundary = { kind = "line" }
control = { force = "1 kN" }
"""
    )
    result = run("contact", "--from", document, "--out", tmp_path / "run")
    assert result.exit_code == 0, result.stderr
    solved = load(tmp_path / "run" / "result.nc")
    assert solved.problem.boundary == asp.FreeLine()
    assert solved.force == pytest.approx(1e3)
    assert "1 kN" in result.stdout


def test_many_files_are_one_study_with_a_row_for_each(
    run: Runner, matrix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("asperity.studies.local.LocalProcesses", lambda *_: InProcess())
    other, broken, out = tmp_path / "other.txt", tmp_path / "broken.txt", tmp_path / "all"
    np.savetxt(other, 2.0 * np.loadtxt(matrix))
    broken.write_text("no heights", encoding="utf-8")
    found = run("contact", matrix, other, broken, *SCALE, *BODY, *LOAD, "--threads", 1, "--out", out)
    assert found.exit_code == 1, found.stderr
    alone = run("contact", matrix, *SCALE, *BODY, *LOAD)
    largest = next(
        line.split("pressure")[1].strip() for line in alone.stdout.splitlines() if "maximum pressure" in line
    )
    row = next(line for line in found.stdout.splitlines() if matrix.name in line)
    assert largest.split()[0] in row
    state = open_study(out).state()
    assert (state.done, state.failed) == (2, 1)
    page = (out / "report.html").read_text(encoding="utf-8")
    assert all(file.name in page for file in (matrix, other, broken))
    assert run("status", out).exit_code == 0, "paths start at the folder"
    refused = run("contact", matrix, other, *SCALE, *BODY, *LOAD, "--csv", tmp_path / "a.csv")
    assert subject_of(refused) == "--csv"
