"""Options that follow from declarations."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import pytest
import typer

from asperity.cli.declared import Given, Option, built, offers, options_of
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


def call(command: Callable[..., None], *arguments: str) -> int:
    with pytest.raises(SystemExit) as ended:
        built(command, command.__name__).main(list(arguments))
    return int(ended.value.code or 0)


def test_what_is_given_comes_as_a_table() -> None:
    assert call(wet, "scan.di", "--film", "2nm", "--no-off", "--steps", "3", "--out", "run") == 0
    file, given, out = SEEN
    assert (file, out) == (Path("scan.di"), Path("run"))
    assert given.table() == {"film": {"thickness": "2nm", "off": False, "steps": "3"}}
    assert given.names["film.thickness"] == "--film"
    assert validated(Film, given.under("film").table(), "here").steps == 3


def test_help_says_what_is_declared(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("COLUMNS", "120")
    call(wet, "--help")
    text = capsys.readouterr().out
    for words in ("Press with a film.", "Liquid film", "--film", "LENGTH", "Thickness of the film.", "Default: 10."):
        assert words in text


def test_clashes_are_refused() -> None:
    with pytest.raises(ValueError, match=r"--film .*clash.* other\.thickness .* film\.thickness"):
        built(clash, "clash")
