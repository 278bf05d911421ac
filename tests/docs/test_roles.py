"""Each role has a way through the pages, and what it shows can be pasted."""

from __future__ import annotations

import shlex

import pytest
from doc_pages import DOCS, blocks, linked
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app

ROLES = sorted(path for path in (DOCS / "roles").glob("*.md") if path.stem != "index")
HOW_TO = {path for path in (DOCS / "how-to").glob("*.md") if path.stem != "index"}


def test_there_are_four_roles():
    assert [path.stem for path in ROLES] == ["design-engineer", "developer", "lab", "researcher"]


def test_every_how_to_is_on_the_way_of_a_role():
    reached = set().union(*map(linked, ROLES))
    assert sorted(path.stem for path in HOW_TO - reached) == []


@pytest.mark.parametrize("page", ROLES, ids=lambda page: page.stem)
def test_a_role_has_something_to_paste_and_pages_to_go_on_with(page):
    assert blocks(page, "console") or blocks(page, "python")
    assert len(linked(page)) >= 8


@pytest.mark.slow
def test_the_commands_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(100e-9), hurst=0.8, rolloff_wavelength=3e-6, shortest_wavelength=1e-6
    )
    surface = asp.generate.gaussian(asp.Grid((48, 48), (0.1e-6, 0.1e-6)), waves, seed=1)
    asp.files.save_surface(surface, "scan.nc")
    for page in ROLES:
        for line in [line for block in blocks(page, "console") for line in block.splitlines()]:
            command = shlex.split(line.removeprefix("$ ").replace("scan.di", "scan.nc"))[1:]
            result = CliRunner().invoke(app, [*command, *(["--force"] if "--out" in command else [])])
            assert result.exit_code == 0, (line, result.output)


def test_the_code_for_developers_runs(capsys):
    (code,) = blocks(DOCS / "roles" / "developer.md", "python")
    names = {}
    exec(compile(code, "developer.md", "exec"), names)  # noqa: S102 - running the page is the test
    assert names["outcome"].values["max_pressure"] > 0.0
    assert names["outcome"].verdict.what in capsys.readouterr().out
