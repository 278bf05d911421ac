"""What the commands print: answers, progress, and Ctrl-C while they work."""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import typer
from rich import box
from rich.console import Console, ConsoleOptions
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bar
from rich.table import Table
from rich.text import Text

from ..core.errors import InputError
from ..core.status import NoProgress, Progress, compiling, share_done
from ..core.units import prefixed, show
from ..core.words import printable

if TYPE_CHECKING:
    from ..contact.result import ContactResult
    from ..core.status import Advice, Verdict
    from ..run.execute import Outcome


WIDTH = 120
"""Width of tables that are not printed on a terminal."""

SHORT, ROOM, NATURAL = 20, 12, 10_000
"""Letters up to which a cell is not broken, least width of a column of longer ones, and a width
that holds any table."""


class Answers(Console):
    """Console that drops its text once the program that reads it has ended, as in
    ``asperity materials | head``."""

    def on_broken_pipe(self) -> None:
        """Drop the rest of the text; the exit code stays that of the work and not that of the
        reader."""
        self.quiet = True
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


class Nowhere(io.StringIO):
    """Output that is dropped."""

    def write(self, text: str) -> int:
        """Drop ``text``."""
        return len(text)


def silence() -> Any:
    """Context in which answers and progress are dropped; warnings go to stderr, as errors do."""
    return redirect_stdout(Nowhere())


def console() -> Console:
    """Console for answers; lines that go to a file or another program are not broken at 80
    characters."""
    watched = sys.stdout is not None and sys.stdout.isatty()  # None: closed before the start
    return Answers(width=None if watched else WIDTH)


def error_console() -> Console:
    """Console for errors and progress."""
    return Console(stderr=True)


def say(text: str, style: str = "", *, warning: bool = False) -> None:
    """Print ``text`` as it is, whatever brackets it holds and however long it is; a ``warning``
    also where answers are dropped."""
    out = error_console() if warning and isinstance(sys.stdout, Nowhere) else console()
    out.print(printable(text, keep="\n\t"), style=style, markup=False, highlight=False, soft_wrap=True)


FIRM = "\N{NO-BREAK SPACE}"


class Unbroken(Table):
    """Table with headings whose numbers are not broken where the terminal is narrow: what all rows
    share is said below, and if that is not enough each row stands by itself."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Any]:
        """Lay the table out as the ``console`` has room."""
        limit = options.max_width
        if not self.show_header or self.__rich_measure__(console, options.update(width=NATURAL)).maximum <= limit:
            yield from super().__rich_console__(console, options)
            return
        cells = [[str(cell) for cell in column.cells] for column in self.columns]
        headings, rows = [str(column.header) for column in self.columns], list(zip(*cells, strict=True))
        shared = [number for number, column in enumerate(cells) if len(rows) > 1 and len({*column}) == 1]
        kept = [number for number in range(len(cells)) if number not in shared]
        wide = [max(map(len, [*cells[number], *headings[number].split()])) for number in kept]
        fixed = [width if width <= SHORT else None for width in wide]
        spare = limit - sum(ROOM if width is None else width for width in fixed) - 2 * len(kept) - 2
        made = Table(title=self.title, title_justify="left", title_style="bold", box=self.box, padding=(0, 1, 0, 0))
        if spare >= 0:
            for number, width in zip(kept, fixed, strict=True):
                room = 0 if width is None else min(max(len(headings[number]) - width, 0), spare // len(kept))
                made.add_column(headings[number], width=None if width is None else width + room, overflow="fold")
            for row, styled in zip(rows, self.rows, strict=True):
                made.add_row(*(Text(row[number]) for number in kept), style=styled.style)
        else:
            made.show_header = False
            made.add_column(overflow="fold")
            made.add_column(overflow="fold", width=max(SHORT, min(max(wide), limit - max(map(len, headings)) - 6)))
            for row, styled in zip(rows, self.rows, strict=True):
                for number in kept:
                    last = number == kept[-1]
                    made.add_row(Text(headings[number]), Text(row[number]), style=styled.style, end_section=last)
        yield made
        same = ", ".join(f"{headings[number]} {cells[number][0]}".strip().replace(" ", FIRM) for number in shared)
        yield from (Text(line.replace(FIRM, " ")) for line in wrap(f"  of all: {same}", limit) if shared)


def table(title: str, rows: Iterable[tuple[str, ...]], headings: tuple[str, ...] = ()) -> Table:
    """Table of text; without ``headings`` the first column names what the others say."""
    made = Unbroken(
        title=Text(printable(title)),
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE,
        show_header=bool(headings),
    )
    filled = [tuple(Text(printable(cell)) for cell in row) for row in rows]
    for index in range(len(headings) or max((len(row) for row in filled), default=0)):
        made.add_column(headings[index] if headings else "", overflow="fold")
    for row in filled:
        made.add_row(*row)
    return made


def short_names(files: Sequence[Path]) -> list[str]:
    """Names of ``files`` in a table: without their folders where these do not tell them apart."""
    names = [file.name for file in files]
    return names if len(set(names)) == len(names) else [str(file) for file in files]


def scalar_rows(result: ContactResult, doubted: tuple[str, ...] = ()) -> list[tuple[str, str]]:
    """The scalars of ``result``, with a mark where they begin with a name of ``doubted``, and the
    checks that bound its error."""
    from ..io.words import CERTIFICATE, result_rows

    checks = result.certificate
    labels = {q.name: q.label for q in CERTIFICATE}
    work = f"{checks.solver}, {checks.iterations} iterations, {show(checks.wall_time, 's', 3)}"
    return [
        *result_rows(result, doubted),
        (labels["duality_gap"], f"{checks.duality_gap:.1e}"),
        (labels["solver"], work),
    ]


def print_problem(outcome: Outcome, title: str) -> None:
    """Print what was solved, and what was done to the surface."""
    from ..io.words import problem_rows

    control, problem = outcome.solved.control, outcome.solved.problem
    asked = ("prescribed", f"{control.name} {show(control.value, control.unit)}")
    console().print(table(title, [*problem_rows(problem), asked]))
    for step in problem.surface.origin.history:
        say(f"  {step}", "dim")


def print_result(outcome: Outcome) -> None:
    """Print scalars and status of ``outcome``, with the words and findings of its parts."""
    from ..run.verdict import verdict

    reached, given = outcome.solved.at(), verdict(outcome)
    heading = f"Result at {reached.where}" if reached.where else "Result"
    console().print(table(heading, scalar_rows(reached.result, given.doubted)))
    print_words(outcome)
    say(outcome.status.message, "green" if outcome.converged else "bold red", warning=not outcome.converged)
    if outcome.status.remedy:
        say(outcome.status.remedy, "red", warning=True)
    print_verdict(given)


def print_verdict(given: Verdict) -> None:
    """Print findings, then what was found, whether it holds, and whether it can be trusted."""
    print_advice(given.others)
    styles = (
        "bold",
        "bold red" if given.fails else "green",
        {"good": "green", "doubtful": "yellow", "not": "bold red"}[given.grade],
    )
    warns = (False, given.fails, given.grade != "good")
    for (name, text), style, warning in zip(given.rows, styles, warns, strict=True):
        say(f"{name}: {text}", style, warning=warning)


def print_words(outcome: Outcome) -> None:
    """Print what the parts of ``outcome`` say, without their remarks and what its verdict says."""
    out = console()
    for part, words in outcome.sections:
        if words.rows:
            out.print(table(part.title, words.rows))
        else:
            say(part.title, "bold")
        for heading, made in words.tables:
            # the name of a row is left out where the row above has it too
            above = ("", *(row[0] for row in made.cells))
            rows = [("" if row[0] == name else row[0], *row[1:]) for name, row in zip(above, made.cells, strict=False)]
            out.print(table(heading, rows, made.headings))
        if words.sentence and not (part.answers or words.holds):
            say(words.sentence, "yellow" if words.alarming else "")


def print_advice(findings: Iterable[Advice]) -> None:
    """Print one line for each finding."""
    for finding in findings:
        warns = finding.level == "warning"
        text = prefixed(f"{finding.level} ({finding.criterion}): {finding.message}")
        say(text, "yellow" if warns else "cyan", warning=warns)


def print_files(paths: Iterable[Path]) -> None:
    """Print where things were written."""
    for path in paths:
        say(f"wrote {path}")


def confirmed(large: str, *, yes: bool) -> None:
    """Ask on a terminal whether to go on with what is ``large``; nothing is asked if it is empty or
    ``yes`` was given.

    Raises
    ------
    InputError
        If nobody can be asked.
    """
    if not large or yes:
        return
    if sys.stdin is None or not sys.stdin.isatty() or not watching():
        raise InputError(f"{large} Confirm it with --yes.")
    typer.confirm(f"{large} Go on?", abort=True, err=True)


def watching() -> bool:
    """Whether progress is to be shown: stderr is a terminal, and answers are not dropped."""
    return sys.stderr is not None and sys.stderr.isatty() and not isinstance(sys.stdout, Nowhere)


@contextmanager
def shown(text: str) -> Iterator[Progress]:
    """Progress on a bar with ``text``, silent when stderr is not a terminal."""
    if not watching():
        yield NoProgress()
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[state]}"), TimeElapsedColumn())
    with Bar(*columns, console=error_console(), transient=True) as bar:
        yield OnBar(bar, text)


@contextmanager
def stage(text: str) -> Iterator[Progress]:
    """Progress of a stage of a run on a bar with ``text``, which Ctrl-C stops."""
    with shown(text) as bar, interruptible(bar) as progress:
        yield progress


class OnBar:
    """Progress of the error from its first value to the tolerance, on a logarithmic scale.

    Without a tolerance the error is the share of the work that is left.
    """

    def __init__(self, bar: Bar, text: str) -> None:
        self._bar = bar
        self._task = bar.add_task(text, total=1.0, state="")
        self._largest = 0.0

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Move the bar; it never moves back unless the error exceeds all earlier ones."""
        if tolerance == 0.0:
            self._bar.update(self._task, completed=1.0 - error, state=f"step {iteration}")
            return
        self._largest = max(self._largest, error)
        share = share_done(error, self._largest, tolerance)
        self._bar.update(self._task, completed=share, state=f"iteration {iteration}, error {error:.1e}")


@contextmanager
def interruptible(progress: Progress) -> Iterator[Progress]:
    """``progress`` that raises KeyboardInterrupt if Ctrl-C came since the start.

    An exception raised by a signal inside a compiler's or the interpreter's own callback is printed
    and dropped by Python, or crashes the compiler; the first solve of a new installation compiles
    for seconds, and would go on for good.
    """
    if threading.current_thread() is not threading.main_thread():
        yield progress
        return
    guarded = _Guarded(progress)
    before, report = signal.signal(signal.SIGINT, guarded.interrupt), sys.unraisablehook
    sys.unraisablehook = lambda lost: None if lost.exc_type is KeyboardInterrupt else report(lost)  # not lost: kept
    try:
        yield guarded
    finally:
        signal.signal(signal.SIGINT, before)
        sys.unraisablehook = report


@dataclass(eq=False)
class _Guarded:
    progress: Progress
    wanted: bool = False

    def interrupt(self, number: int, frame: Any) -> None:
        """Handle the signal: remember it, and raise as Python does, unless inside the compiler."""
        self.wanted = True
        if not compiling():
            raise KeyboardInterrupt

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Stop if asked to, else report."""
        if self.wanted:
            raise KeyboardInterrupt
        self.progress.update(iteration, error, tolerance)
