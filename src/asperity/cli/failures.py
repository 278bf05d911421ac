"""Exit codes, and what the user reads when something goes wrong: one sentence, or with ``--debug`` the traceback."""

from __future__ import annotations

import errno
from typing import Any

import typer
from typer.core import TyperGroup

from ..core.errors import AsperityError, ConvergenceError
from ..core.text import printable
from ..core.units import prefixed

OK = 0
NOT_CONVERGED = 1
BAD_INPUT = 2
INTERNAL_ERROR = 3
INTERRUPTED = 130


class Reporting(TyperGroup):
    """Group of commands that turns every exception into a sentence on stderr and an exit code."""

    def invoke(self, ctx: Any) -> Any:
        """Run the command; leave deliberate exits to typer."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            _say("Interrupted: the work was stopped and nothing is half-written.")
            raise typer.Exit(INTERRUPTED) from None
        except Exception as error:
            if isinstance(error, typer.Exit | typer.Abort | BrokenPipeError) or (
                not str(error) and hasattr(error, "ctx")
            ):  # help, exits, and a reader such as head that has seen enough
                raise
            if hasattr(error, "format_message"):
                usage = getattr(error, "ctx", None)
                command = usage.command_path if usage is not None else "asperity"
                _say(f"{error.format_message().rstrip('.')}. See `{command} --help`.")
                raise typer.Exit(BAD_INPUT) from None
            code, sentence = diagnosis(error)
            _say(sentence, traceback=bool(ctx.params.get("debug")))
            raise typer.Exit(code) from None


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
