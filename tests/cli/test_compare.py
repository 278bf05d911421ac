"""``asperity compare``: what is printed and written, documents, loads, what is refused."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, SCALE, Runner
from refusals import subject_of

import asperity as asp
from asperity.run.document import load_document

FILES = {"report.html", "comparison.nc", "comparison.csv", "plots", "problem.toml"}


def test_a_comparison_is_printed_and_written(run: Runner, matrix: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    chosen = ("--theories", "persson, kogut-etsion,jackson-green", "--pressures", "1MPa..100MPa", "--loads", "3")
    result = run("compare", matrix, *SCALE, *BODY, *chosen, "--out", out)
    assert result.exit_code == 0, result.stderr
    for text in ("persson", "kogut-etsion", "jackson-green", "yield_stress"):
        assert text in result.stdout
    assert {path.name for path in out.iterdir()} == FILES
    plots = sorted(path.name for path in (out / "plots").iterdir())
    assert plots == ["area.png", "deviation.png", "gap.png", "kappa.png", "local_slope.png"]
    data = asp.files.open_tree(out / "comparison.nc").to_dataset()
    np.testing.assert_allclose(data["pressure"], [1e6, 1e7, 1e8])
    assert list(data["theory"].values) == ["persson", "kogut-etsion"]
    assert list(json.loads(data.attrs["left_out"])) == ["jackson-green"]
    with (out / "comparison.csv").open(encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == 9
    page = (out / "report.html").read_text(encoding="utf-8")
    for text in ("jackson-green", "Yang"):
        assert text in page
    assert len(re.findall(r'src="data:image/png', page)) == 5
    assert not re.search(r'(src|href)="(?!data:|#)', page)
    document = load_document(out / "problem.toml")
    assert document.control.mean_pressure == pytest.approx(1e8)

    again = run("compare", "--document", out / "problem.toml", *chosen)
    assert again.exit_code == 0, again.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"run", matrix.name}


def test_theories_alone_are_quick_and_have_no_numerical_curve(run: Runner, matrix: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    words = ("--no-numerical", "--pressures", "1MPa,5MPa", "--work", "50mJ/m^2", "--theories", "fuller-tabor,mccool")
    result = run("compare", matrix, *SCALE, *BODY, *words, "--out", out)
    assert result.exit_code == 0, result.stderr
    data = asp.files.open_tree(out / "comparison.nc").to_dataset()
    assert "numerical_area_fraction" not in data
    assert set(data["theory"].values) <= {"fuller-tabor", "mccool"}
    assert not (out / "plots" / "deviation.png").exists()


def test_a_load_beyond_the_hardness_is_named_and_the_exit_code_tells(run: Runner, matrix: Path) -> None:
    words = ("--theories", "persson", "--pressures", "1MPa,6GPa", "--hardness", "body")
    result = run("compare", matrix, *SCALE, *BODY, *words)
    assert result.exit_code == 1, result.output
    assert "5 GPa" in result.stdout
    assert "–" in result.stdout


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        (("--pressures", "5"), "--pressures"),
        (("--pressures", "1MPa,0Pa"), "pressure (Pa) of a comparison"),
        (("--pressures", "1MPa,2MPa", "--loads", "5"), "--loads"),
        (("--pressures", "1MPa..2MPa", "--loads", "1"), "--loads"),
        (("--theories", "gw"), "name of a theory to compare"),
        (("--work", "5 Pa"), "--work"),
        (("--from", "a.toml"), "FILE and the options for reading, preparation and counter surface"),
    ],
)
def test_what_cannot_be_compared_is_refused(run: Runner, matrix: Path, options: tuple[str, ...], subject: str) -> None:
    result = run("compare", matrix, *SCALE, *BODY, *options)
    assert subject_of(result) == subject


def test_a_surface_and_a_body_are_needed(run: Runner, matrix: Path) -> None:
    assert subject_of(run("compare")) == "FILE with the rough surface"
    assert subject_of(run("compare", matrix, *SCALE)) == "--body"
