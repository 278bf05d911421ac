"""The program ``asperity``. Heavy imports stay inside the commands, so that ``--help`` is immediate."""

from __future__ import annotations

import io
import sys
from collections.abc import Callable
from typing import Annotated

import typer

from . import campaigns, compare, contact, generate, info, materials, results, stress, theory
from .declared import Lazy, late
from .failures import Reporting
from .groups import grouped

app = typer.Typer(
    name="asperity",
    cls=Reporting,
    help="Contact mechanics of layered rough surfaces.",
    epilog="Exit codes: 0 done, 1 not converged or failed cases, 2 bad input, 3 internal error, 130 interrupted.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

COMMANDS: tuple[Callable[..., None], ...] = (
    contact.contact,
    contact.demo,
    stress.stress,
    compare.compare,
    campaigns.run,
    campaigns.status,
    campaigns.collect,
    info.info,
    materials.materials,
    materials.liquids,
    results.plot,
    results.report,
    results.export,
    results.cite,
)
"""The commands in the order of the help."""

for _command in COMMANDS:
    flat = grouped(_command)
    if "offered" in flat.__dict__:
        app.command(_command.__name__, cls=Lazy)(late(flat))
    else:
        app.command()(flat)
app.add_typer(generate.app)
app.add_typer(theory.app)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"asperity {version('asperity')}")
        raise typer.Exit


@app.callback()
def options(
    debug: Annotated[bool, typer.Option("--debug", help="Show the traceback of an error.")] = False,
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    """Contact mechanics of layered rough surfaces."""


def run() -> None:
    """Run the program with the arguments of the process; never returns.

    Where the encoding of the output lacks a letter such as µ, its code is printed.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    app(prog_name="asperity")
