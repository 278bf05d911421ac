"""Options that follow from declarations."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import pytest
import typer
from typer.testing import CliRunner

from asperity.cli.declared import Given, Lazy, Option, late, offers, options_of
from asperity.core.settings import Settings, setting, validated
from asperity.core.values import Count, Length, NonNegative


class Film(Settings):
    """A film."""

    thickness: Length | None = setting(None, option="--film", help="Thickness of the film")
    friction: NonNegative = setting(0.0, help="Dry coefficient")
    on: bool = setting(False, help="Switch")
    off: bool = setting(True, help="Other switch")
    steps: Count = setting(10, help="Steps")


SEEN: list[Any] = []


def options() -> tuple[Option, ...]:
    return options_of(Film, ("film",), "Liquid film")


@offers(options)
def wet(file: Annotated[Path, typer.Argument(help="File.")], given: Given, out: Path | None = None) -> None:
    """Press with a film."""
    SEEN[:] = [file, given, out]


@offers(lambda: (*options(), *options_of(Film, ("other",))))
def clash(given: Given) -> None:
    """Two options of one name."""


def app() -> typer.Typer:
    made = typer.Typer()
    for command in (wet, clash):
        made.command(cls=Lazy)(late(command))
    return made


def test_what_is_given_comes_as_a_table() -> None:
    found = CliRunner().invoke(
        app(), ["wet", "scan.di", "--film", "2nm", "--no-off", "--steps", "3", "--out", "run"], catch_exceptions=False
    )
    assert found.exit_code == 0, found.output
    file, given, out = SEEN
    assert (file, out) == (Path("scan.di"), Path("run"))
    assert given.table() == {"film": {"thickness": "2nm", "off": False, "steps": "3"}}
    assert given.names["film.thickness"] == "--film"
    assert validated(Film, given.under("film").table(), "here").steps == 3


def test_help_says_what_is_declared() -> None:
    text = CliRunner().invoke(app(), ["wet", "--help"], env={"COLUMNS": "120"}).output
    for words in ("Press with a film.", "Liquid film", "--film", "LENGTH", "Thickness of the film.", "Default: 10."):
        assert words in text


def test_clashes_are_refused() -> None:
    with pytest.raises(ValueError, match=r"--film of `clash` is the option of other.thickness and of film.thickness"):
        CliRunner().invoke(app(), ["clash"], catch_exceptions=False)
