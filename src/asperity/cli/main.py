"""The program ``asperity``. A command is imported when it is asked for, so that the list of all commands is immediate."""

from __future__ import annotations

import importlib
import io
import sys
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any

import typer

from .failures import Reporting

COMMANDS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "contact": (
            "contact",
            "Press rough surfaces against a body: contact area, pressure, gap; menisci and stresses.",
        ),
        "demo": ("contact", "Solve a built-in problem: a rough magnetic disk under a flat slider. Nothing to prepare."),
        "stress": ("stress", "Compute the stresses in a saved contact, without solving it again."),
        "compare": ("compare", "Compare every theory of rough contact with the numerical solution, on one surface."),
        "run": ("campaigns", "Run or resume a campaign over many contacts: only missing cases are computed."),
        "status": ("campaigns", "Tell how far a campaign is, also while it runs."),
        "collect": ("campaigns", "Write what a campaign has found so far: NetCDF, CSV, pictures and a report."),
        "info": ("info", "Tell what is in files with heights: channels, size, pixel, units, roughness."),
        "generate": ("generate", "Generate a rough surface, a texture or an indenter and write it to a file."),
        "theory": ("theory", "Evaluate a theory, from numbers or for a measured surface."),
        "materials": ("materials", "List the named materials with their values and sources."),
        "liquids": ("materials", "List the named liquids for films between surfaces, with their values and sources."),
        "plot": ("results", "Draw the figures of a result as PNG files."),
        "report": ("results", "Write the report of a result again, from what its file holds."),
        "export": ("results", "Write a result for other programs."),
        "cite": ("results", "Print the papers behind the numbers of a result or a problem."),
    }
)
"""Module and line of the help of each command, in the order of the help."""


class Program(Reporting):
    """The commands, each made when it is asked for."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of the commands."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Command of a name; None if there is none."""
        if cmd_name not in COMMANDS:
            return None
        from .declared import built

        module = importlib.import_module(f".{COMMANDS[cmd_name][0]}", __package__)
        if hasattr(module, "app"):
            return typer.main.get_command(module.app)
        return built(getattr(module, cmd_name), cmd_name)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write name and line of each command."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, line) for name, (_, line) in COMMANDS.items()])


app = typer.Typer(
    name="asperity",
    cls=Program,
    help="Contact mechanics of layered rough surfaces.",
    epilog="`asperity COMMAND -h` explains a command. The environment variable ASPERITY_THREADS sets the number of threads of "
    "all commands (all cores by default; --threads of a command goes before). Exit codes: 0 done, 1 not converged or failed "
    "cases, 2 bad input, 3 internal error, 130 interrupted.",
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["--help", "-h"], "max_content_width": 110},
)


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
