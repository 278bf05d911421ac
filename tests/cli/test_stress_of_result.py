"""The command ``stress``: the same numbers as with the contact, other friction without solving, refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cli.conftest import LOAD, SCALE, Runner

import asperity as asp
from asperity.io.documents import load_document
from asperity.io.results import load, open_dataset, save

COATED = ("--body", "E=300GPa,nu=0.2,H=20GPa,name=film:50nm/E=100GPa,nu=0.1,H=5GPa,name=base")


@pytest.fixture
def plain(run: Runner, matrix: Path, tmp_path: Path) -> Path:
    result = run("contact", matrix, *SCALE, *COATED, *LOAD, "--out", tmp_path / "plain")
    assert result.exit_code == 0, result.stderr
    return tmp_path / "plain" / "result.nc"


WANTED = ("--friction", 0.3, "--section", "y=max", "--profile", "x=max,y=max", "--depths", "0nm,50nm")


def test_stresses_are_those_of_a_run_that_asked_for_them(
    run: Runner, plain: Path, matrix: Path, tmp_path: Path
) -> None:
    later = run("stress", plain, *WANTED, "--out", tmp_path / "later")
    assert later.exit_code == 0, later.stderr
    at_once = run("contact", matrix, *SCALE, *COATED, *LOAD, *WANTED, "--out", tmp_path / "once")
    assert at_once.exit_code == 0, at_once.stderr
    names = sorted(path.relative_to(tmp_path / "later") for path in (tmp_path / "later").rglob("*"))
    expected = {path.relative_to(tmp_path / "once") for path in (tmp_path / "once").rglob("*")}
    assert set(names) == expected - {Path("result.nc"), Path("scalars.csv")}
    assert (tmp_path / "later" / "stress.csv").read_text() == (tmp_path / "once" / "stress.csv").read_text()
    fields = [open_dataset(tmp_path / folder / "stress" / "section_1.nc") for folder in ("later", "once")]
    np.testing.assert_array_equal(fields[0]["xz"], fields[1]["xz"])
    html = (tmp_path / "later" / "report.html").read_text(encoding="utf-8")
    assert "Largest stresses of each layer" in html
    assert "film" in later.stdout
    document = load_document(tmp_path / "later" / "problem.toml")
    assert document.stress is not None
    assert document.stress.friction == 0.3
    again = run("contact", "--from", tmp_path / "later" / "problem.toml")
    assert again.exit_code == 0, again.stderr


def test_the_document_in_the_result_says_what_options_do_not(run: Runner, plain: Path, tmp_path: Path) -> None:
    first = run("stress", plain, "--friction", 0.3, "--depths", "10nm", "--out", tmp_path / "a")
    assert first.exit_code == 0, first.stderr
    solved = run("contact", "--from", tmp_path / "a" / "problem.toml", "--out", tmp_path / "b")
    assert solved.exit_code == 0, solved.stderr
    volume = tmp_path / "v.nc"
    changed = run("stress", tmp_path / "b" / "result.nc", "--friction", 0.5, "--stress-nc", volume, "--threads", 1)
    assert changed.exit_code == 0, changed.stderr
    found = open_dataset(volume)
    assert found["depth"].values.tolist() == pytest.approx([10e-9])
    pressure = load(plain)
    wanted = asp.stress(pressure, [10e-9], friction=0.5)
    np.testing.assert_allclose(found["xz"][0], wanted.shear_xz[0], atol=1e-6 * np.abs(wanted.shear_xz).max())
    assert run("stress", plain, "--stress-nc", volume).exit_code == 2
    cited = run("cite", tmp_path / "b" / "result.nc").stdout
    assert "[Burmister1945]" in cited
    assert "[Eberly2014]" in cited
    assert run("cite", tmp_path / "b" / "problem.toml").stdout.count("[Eberly2014]") == 1
    assert "[Eberly2014]" not in run("cite", plain).stdout


def test_a_result_without_document(run: Runner, plain: Path, tmp_path: Path) -> None:
    save(load(plain), tmp_path / "bare.nc")
    result = run("stress", tmp_path / "bare.nc", "--out", tmp_path / "out")
    assert result.exit_code == 0, result.stderr
    assert (tmp_path / "out" / "plots" / "stress_section_1_von_mises.png").is_file()
    assert not (tmp_path / "out" / "problem.toml").exists()


def test_a_coupled_pressure_belongs_to_its_friction(run: Runner, matrix: Path, tmp_path: Path, plain: Path) -> None:
    options = ("--friction", 0.5, "--coupled", "--out", tmp_path / "coupled")
    assert run("contact", matrix, *SCALE, *COATED, *LOAD, *options).exit_code == 0
    file = tmp_path / "coupled" / "result.nc"
    assert run("stress", file, "--section", "x=max").exit_code == 0
    assert "[Dundurs1969]" in run("cite", file).stdout
    refused = run("stress", file, "--friction", 0.2)
    assert refused.exit_code == 2
    assert "was solved coupled with friction 0.5" in refused.stderr
    assert "was solved without coupling" in run("stress", plain, "--coupled", "--friction", 0.2).stderr


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (("--stress-in", "counter"), "inside the counter body, which is rigid"),
        (("--depths", "1nm,5"), "part 2 of --depths must have a unit"),
        (("--section", "z=1nm"), "--section must be a position"),
    ],
)
def test_refusals(run: Runner, plain: Path, options: tuple[str, ...], expected: str) -> None:
    result = run("stress", plain, *options)
    assert result.exit_code == 2
    assert expected in " ".join(result.stderr.split())
