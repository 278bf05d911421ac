"""The program ``asperity``. A command is imported when it is asked for, so that the list of all
commands is immediate."""

from __future__ import annotations

import difflib
import errno
import gc
import importlib.resources
import io
import sys
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Annotated, Any, ClassVar

import typer
from typer.core import TyperGroup

from ..core.errors import AsperityError, ConvergenceError
from ..core.units import prefixed
from ..core.words import printable, speaking
from .interrupt import INTERRUPTED, SENTENCE

OK = 0
NOT_CONVERGED = 1
BAD_INPUT = 2
INTERNAL_ERROR = 3
"""Exit codes, beside that of an interrupt."""

GARBAGE = (10_000, 20, 20)
"""Allocations between two searches for garbage, and searches between two of older objects. Python's
(700, 10, 10) suits programs with small libraries: here searches through what has just been
imported, which stays, took 5 % of the time of a contact."""

COMMANDS: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(("contact", "demo", "dynamics"), "contact"),
        "stress": "results",
        "compare": "compare",
        **dict.fromkeys(("run", "status", "collect"), "campaigns"),
        "design": "design",
        "calibrate": "calibrate",
        "app": "app",
        "info": "info",
        "predict": "predict",
        "generate": "generate",
        "theory": "theory",
        **dict.fromkeys(("materials", "liquids"), "materials"),
        **dict.fromkeys(("plot", "report", "export", "cite"), "results"),
    }
)
"""Module of each command, in the order of the help."""


class Listing(TyperGroup):
    """Group of commands that are made when they are asked for; its page lists them with one line
    each."""

    lines: ClassVar[Callable[[], Mapping[str, str]]]

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of the commands."""
        return list(type(self).lines())

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write name and line of each command."""
        with formatter.section("Commands"):
            formatter.write_dl(list(type(self).lines().items()))


class Program(Listing):
    """The commands, each made when it is asked for; every exception ends as a sentence on stderr
    and an exit code."""

    @staticmethod
    def lines() -> Mapping[str, str]:
        """Names of the commands and the first lines of their docstrings, read from the text:
        modules take long to import."""
        folder = importlib.resources.files(__package__)
        texts = {module: folder.joinpath(f"{module}.py").read_text(encoding="utf-8") for module in COMMANDS.values()}
        begin = {name: texts[module].partition(f"\ndef {name}(")[2] for name, module in COMMANDS.items()}
        return {name: text.split('"""')[1].partition("\n")[0] for name, text in begin.items()}

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Command of a name; None if there is none."""
        if cmd_name not in COMMANDS:
            near = difflib.get_close_matches(cmd_name, COMMANDS, n=1)
            if near and not ctx.resilient_parsing:
                ctx.fail(f"No such command {cmd_name!r}; did you mean {near[0]}?")
            return None
        from .declared import built

        module = importlib.import_module(f".{COMMANDS[cmd_name]}", __package__)
        if isinstance(found := getattr(module, "app", None), typer.Typer):
            return typer.main.get_command(found)
        return built(getattr(module, cmd_name), cmd_name)

    def invoke(self, ctx: Any) -> Any:
        """Run the command; leave deliberate exits to typer."""
        try:
            with speaking("command", _options_by_key):
                return super().invoke(ctx)
        except KeyboardInterrupt:
            _say(SENTENCE)
            raise typer.Exit(INTERRUPTED) from None
        except Exception as error:
            if isinstance(error, typer.Exit | typer.Abort | BrokenPipeError) or (
                not str(error) and hasattr(error, "ctx")
            ):  # help, exits, and a reader such as head that has ended
                raise
            if hasattr(error, "format_message"):
                usage = getattr(error, "ctx", None)
                command = usage.command_path if usage is not None else "asperity"
                _say(f"{error.format_message().rstrip('.')}. See `{command} --help`.")
                raise typer.Exit(BAD_INPUT) from None
            code, sentence = diagnosis(error)
            _say(sentence, traceback=bool(ctx.params.get("debug")))
            raise typer.Exit(code) from None


def _options_by_key() -> dict[str, str]:
    from .options import option_words  # brings the schemas of documents

    return option_words()


def diagnosis(error: Exception) -> tuple[int, str]:
    """Exit code and sentence for ``error``."""
    if isinstance(error, ConvergenceError):
        return NOT_CONVERGED, prefixed(str(error))
    if isinstance(error, AsperityError):
        return BAD_INPUT, prefixed(str(error))
    if isinstance(error, MemoryError):
        return BAD_INPUT, "Not enough memory: crop the surface or resample it to fewer points."
    if isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EIO):
        return BAD_INPUT, f"Output cannot be written: {error.strerror}. Free some space or choose another place."
    if isinstance(error, OSError) and error.errno in (errno.ENAMETOOLONG, errno.ELOOP, errno.EACCES, errno.EPERM):
        return BAD_INPUT, f"{error.filename} cannot be used: {error.strerror}. Check name and rights."
    text = " ".join(str(error).split())[:200]
    sentence = f"Internal error, {type(error).__name__}: {text}" if text else f"Internal error, {type(error).__name__}"
    return INTERNAL_ERROR, f"{sentence}. Run again as `asperity --debug …` and report the traceback, please."


def _say(sentence: str, *, traceback: bool = False) -> None:
    from .show import error_console  # brings rich

    console = error_console()
    if traceback:
        from traceback import format_exc

        console.print(format_exc(), markup=False, highlight=False, soft_wrap=True)
    console.print(
        printable(f"asperity: {sentence}", keep="\n\t"), style="red", markup=False, highlight=False, soft_wrap=True
    )


app = typer.Typer(
    name="asperity",
    cls=Program,
    help="Contact mechanics of layered rough surfaces.",
    epilog="`asperity COMMAND -h` explains a command. The environment variable ASPERITY_THREADS sets the "
    "number of threads of all commands (all cores by default; --threads of a command goes before). "
    "Exit codes: 0 done, 1 not converged or failed cases, 2 bad input, 3 internal error, 130 "
    "interrupted.",
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
    gc.set_threshold(*GARBAGE)
    try:
        app(prog_name="asperity")
    finally:
        gc.freeze()  # else Python looks through all objects once more when it ends: a tenth of the time of a contact
