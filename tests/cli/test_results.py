"""The commands on results: ``plot``, ``export``, ``cite``; and ``demo``, which makes one."""

from __future__ import annotations

from pathlib import Path

import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from refusals import subject_of

from asperity.io.results import load
from asperity.plots import PLOTS

pytestmark = pytest.mark.usefixtures("undrawn")


@pytest.fixture
def result_file(run: Runner, matrix: Path, tmp_path: Path) -> Path:
    assert run("contact", matrix, *SCALE, *BODY, *LOAD, "--out", tmp_path / "run").exit_code == 0
    return tmp_path / "run" / "result.nc"


@pytest.mark.slow
def test_plot_all_and_one(run: Runner, result_file: Path, tmp_path: Path) -> None:
    result = run("plot", result_file, "--out", tmp_path / "all")
    assert result.exit_code == 0, result.stderr
    names = {path.stem for path in (tmp_path / "all").iterdir()}
    assert {"heights", "pressure", "contact", "gap", "section", "histogram"} <= names
    for kind in names:
        assert run("plot", result_file, "--kind", kind, "--out", tmp_path / "one").exit_code == 0
    assert {path.stem for path in (tmp_path / "one").iterdir()} == names
    assert run("plot", result_file, "--out", tmp_path / "all").exit_code == 2
    assert run("plot", result_file, "--out", tmp_path / "all", "--force").exit_code == 0


def test_help_names_every_figure(run: Runner) -> None:
    text = " ".join(run("plot", "--help").stdout.replace("│", " ").split())
    assert all(item.name in text for item in PLOTS)


def test_plot_refusals(run: Runner, result_file: Path, tmp_path: Path) -> None:
    assert subject_of(run("plot", result_file, "--kind", "cake")) == "--kind"
    assert run("plot", tmp_path / "none.nc").exit_code == 2
    assert run("plot", result_file, "--kind", "gap", "--out", result_file / "below").exit_code == 2


def test_export(run: Runner, result_file: Path, tmp_path: Path) -> None:
    files = ("--csv", tmp_path / "s.csv", "--vtk", tmp_path / "f.vti")
    assert run("export", result_file, *files).exit_code == 0
    assert (tmp_path / "f.vti").read_text().startswith("<?xml")
    assert run("export", result_file, *files).exit_code == 2
    assert run("export", result_file, *files, "--force").exit_code == 0
    assert subject_of(run("export", result_file)) == "export"


def test_cite_result_and_document(run: Runner, result_file: Path) -> None:
    from_result = run("cite", result_file)
    from_document = run("cite", result_file.with_name("problem.toml"))
    assert from_result.exit_code == from_document.exit_code == 0, from_document.stderr
    for result in (from_result, from_document):
        assert "[Polonsky1999]" in result.stdout


@pytest.mark.parametrize("content", [b"", b"\x89HDF\r\n\x1a\n cut", b"nothing like it"])
def test_damaged_results(run: Runner, tmp_path: Path, content: bytes) -> None:
    (tmp_path / "bad.nc").write_bytes(content)
    for command in (("plot",), ("cite",), ("export", "--csv", tmp_path / "x.csv")):
        result = run(command[0], tmp_path / "bad.nc", *command[1:])
        assert subject_of(result) == "result file"
    assert not (tmp_path / "x.csv").exists()


def test_demo(run: Runner, tmp_path: Path) -> None:
    out = tmp_path / "demo"
    result = run("demo", "--out", out)
    assert result.exit_code == 0, result.stderr
    for text in ("256 × 256", "10 µm × 10 µm", "4 MPa", "10 GPa", "200 nm"):
        assert text in result.stdout
    assert "<html" in (out / "report.html").read_text(encoding="utf-8").lower()
    solved = load(out / "result.nc")
    assert solved.converged
    assert solved.mean_pressure == pytest.approx(4e-5 * 100e9, rel=1e-9)
    again = run("contact", "--from", out / "problem.toml")
    assert again.exit_code == 0
    assert f"{solved.area_fraction:.4g}" in again.stdout


def test_demo_without_a_folder_only_prints(run: Runner, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    result = run("demo")
    assert result.exit_code == 0
    assert "--out" in result.stdout
    assert list(tmp_path.iterdir()) == []
