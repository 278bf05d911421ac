"""Work that fits the machine but takes much of it is confirmed: by an answer on a terminal, or by
--yes."""

from __future__ import annotations

import io
import sys
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path

import pytest
import tomli_w
import typer
from cli.conftest import BODY, LOAD, SCALE
from study_cases import LOADS, study
from typer.testing import Result

from asperity.cli.show import confirmed
from asperity.run.build import large_grid
from asperity.studies import campaign as campaigns
from asperity.studies.campaign import run_study

Runner = Callable[..., Result]
GENERATE = ("generate", "sphere", "--points", "64", "--size", "1um", "--radius", "10um", "--out")


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine on which 4096 points are much of the free memory, and a second of work is long."""
    monkeypatch.setattr("asperity.core.status.free_memory", lambda: 600e3)
    monkeypatch.setattr("asperity.studies.plan.LONG", 1e-3)


@pytest.mark.usefixtures("small")
def test_a_large_grid_is_refused_with_the_numbers_where_nobody_can_be_asked(run: Runner, tmp_path: Path) -> None:
    told = run(*GENERATE, tmp_path / "s.nc")
    assert told.exit_code == 2
    assert [text for text in ("4.1e+03", "0.000381 GiB", "0.000559 GiB", "--yes") if text not in told.stderr] == []
    assert not (tmp_path / "s.nc").exists()
    assert run(*GENERATE, tmp_path / "s.nc", "--yes").exit_code == 0
    assert (tmp_path / "s.nc").exists()


@pytest.mark.usefixtures("small")
def test_so_is_one_that_a_contact_states(run: Runner, matrix: Path) -> None:
    for command, more in (("contact", LOAD), ("compare", ())):
        told = run(command, matrix, *SCALE, *BODY, *more, "--resample", "64")
        assert told.exit_code == 2
        assert "--yes" in told.stderr


@pytest.mark.usefixtures("small")
def test_a_long_study_leaves_nothing_behind_where_it_is_refused(run: Runner, tmp_path: Path) -> None:
    path = tmp_path / "s.toml"
    path.write_text(tomli_w.dumps(study(axes=[LOADS])), encoding="utf-8")
    told = run("run", path)
    assert told.exit_code == 2
    assert " 3 " in told.stderr
    assert "--yes" in told.stderr
    assert [item.name for item in tmp_path.iterdir()] == ["s.toml"]


@pytest.mark.usefixtures("small")
def test_python_goes_on_without_asking(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(campaigns.Campaign, "run", lambda self, **options: None)
    assert run_study(study(axes=[LOADS]), tmp_path / "s").state().missing == 3


def test_what_was_begun_goes_on_without_asking(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    campaigns.prepare_study(study(axes=[LOADS]), tmp_path / "s", confirm=asked.append)
    assert asked == [""], "a small study is told to be none that takes much"
    campaigns.prepare_study(study(axes=[LOADS]), tmp_path / "s", confirm=asked.append)
    assert len(asked) == 1


class Terminal(io.StringIO):
    """Standard input of somebody who types."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(("answer", "goes_on"), [("y", True), ("n", False)])
def test_on_a_terminal_it_is_asked(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], answer: str, goes_on: bool
) -> None:
    monkeypatch.setattr("asperity.cli.show.watching", lambda: True)
    monkeypatch.setattr(sys, "stdin", Terminal(f"{answer}\n"))
    with nullcontext() if goes_on else pytest.raises(typer.Abort):
        confirmed("Much.", yes=False)
    assert "Much." in capsys.readouterr().err
    confirmed("Much.", yes=True)
    confirmed("", yes=False)
    assert capsys.readouterr().err == ""


def test_usual_grids_are_not_large() -> None:
    assert large_grid(1024 * 1024) == ""
