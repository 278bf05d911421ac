"""The page of the command line, from the help of the program."""

from __future__ import annotations

import os
from unittest.mock import patch

from typer.testing import CliRunner

from asperity.cli.main import app

HEAD = """# Command line

What `asperity COMMAND --help` prints. Every option of `asperity contact` is also a key of the
[problem document](document.md); quantities carry [units](units.md).
"""


def page() -> str:
    """Text of the page."""
    parts = [HEAD, _block(())]
    for name in names():
        parts += [f"## asperity {name}\n", _block((name,))]
    return "\n".join(parts)


def names() -> list[str]:
    """Names of the commands in the order of the help."""
    lines = _help(()).partition("Commands:\n")[2].partition("\n\n")[0].splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and line[2] != " "]


def _block(command: tuple[str, ...]) -> str:
    return f"```text\n{_help(command)}\n```\n"


def _help(command: tuple[str, ...]) -> str:
    usual = _printed((*command, "--help"))
    return _printed((*command, "--help-all")) if "--help-all" in usual else usual


def _printed(words: tuple[str, ...]) -> str:
    with patch.dict(os.environ, {"COLUMNS": "96", "TERMINAL_WIDTH": "96", "NO_COLOR": "1", "TERM": "dumb"}):
        result = CliRunner().invoke(app, list(words), prog_name="asperity")
    if result.exit_code:
        raise RuntimeError(result.output)
    return result.output.rstrip()
