"""The guide to theories runs; what the reference says of each, see ``tests/unit/test_site.py``."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app

GUIDE = Path(__file__).parents[3] / "docs" / "how-to" / "theories.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", GUIDE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_the_commands_of_the_guide_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=1.6e-7
    )
    asp.files.save_surface(asp.generate.gaussian(asp.Grid((64, 64), (4e-8, 4e-8)), spectrum, seed=1), "scan.nc")
    (text,) = blocks("console")
    lines = [line.removeprefix("$ ").split("  #")[0] for line in text.splitlines()]
    assert len(lines) >= 7
    for line in lines:
        result = CliRunner().invoke(app, shlex.split(line)[1:])
        assert result.exit_code == 0, result.output
    assert (tmp_path / "bgt.csv").read_text(encoding="utf-8").startswith("pressure (Pa),area_fraction,")


def test_the_example_of_the_guide_runs(capsys):
    names = {}
    (code,) = blocks("python")
    exec(compile(code, GUIDE.name, "exec"), names)  # noqa: S102 - running the page is the test
    printed = capsys.readouterr().out
    assert "[Hertz1882]" in printed
    assert "area fraction False Contacts deform each other" in printed
    assert "('summits per area', " in printed
