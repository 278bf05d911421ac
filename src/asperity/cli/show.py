"""What the commands print."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from ..contact.result import ContactResult
    from ..core.status import Advice
    from ..run.execute import Outcome


WIDTH = 120
"""Width of tables that are not printed on a terminal."""


def console() -> Console:
    """Console for answers; lines that go to a file or another program are not broken at 80 characters."""
    from .answers import Answers

    watched = sys.stdout is not None and sys.stdout.isatty()  # None: closed before the start
    return Answers(width=None if watched else WIDTH)


def error_console() -> Console:
    """Console for errors and progress."""
    from rich.console import Console

    return Console(stderr=True)


def say(text: str, style: str = "") -> None:
    """Print ``text`` as it is, whatever brackets it holds and however long it is."""
    console().print(text, style=style, markup=False, highlight=False, soft_wrap=True)


def table(title: str, rows: Iterable[tuple[str, ...]], headings: tuple[str, ...] = ()) -> Table:
    """Table of text; without ``headings`` the first column names what the others say."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    made = Table(
        title=Text(title), title_justify="left", title_style="bold", box=box.SIMPLE, show_header=bool(headings)
    )
    filled = [tuple(Text(cell) for cell in row) for row in rows]
    for index in range(len(headings) or max((len(row) for row in filled), default=0)):
        made.add_column(headings[index] if headings else "", overflow="fold")
    for row in filled:
        made.add_row(*row)
    return made


def scalar_rows(result: ContactResult) -> list[tuple[str, str]]:
    """The scalars of ``result`` and the checks that bound its error."""
    from ..core.units import show
    from ..io.words import CERTIFICATE, result_rows

    checks = result.certificate
    labels = {q.name: q.label for q in CERTIFICATE}
    work = f"{checks.solver}, {checks.iterations} iterations, {show(checks.wall_time, 's', 3)}"
    return [
        *result_rows(result),
        (labels["duality_gap"], f"{checks.duality_gap:.1e}"),
        (labels["solver"], work),
    ]


def print_problem(outcome: Outcome, title: str) -> None:
    """Print what was solved, and what was done to the surface."""
    from ..core.units import show
    from ..io.words import problem_rows

    control, problem = outcome.solved.control, outcome.solved.problem
    asked = ("prescribed", f"{control.name} {show(control.value, control.unit)}")
    console().print(table(title, [*problem_rows(problem), asked]))
    for step in problem.surface.origin.history:
        say(f"  {step}", "dim")


def print_result(outcome: Outcome) -> None:
    """Print scalars and status of ``outcome``, with the words and findings of its parts."""
    console().print(table("Result", scalar_rows(outcome.result)))
    print_words(outcome)
    say(outcome.status.message, "green" if outcome.converged else "bold red")
    if outcome.status.remedy:
        say(outcome.status.remedy, "red")
    print_advice(outcome.findings)


def print_words(outcome: Outcome) -> None:
    """Print what the parts of ``outcome`` say, without their remarks."""
    out = console()
    for part, words in outcome.sections:
        if words.rows:
            out.print(table(part.title, words.rows))
        else:
            say(part.title, "bold")
        for heading, made in words.tables:
            out.print(table(heading, _once(made.cells), made.headings))
        if words.sentence:
            say(words.sentence, "yellow" if words.alarming else "")


def _once(cells: tuple[tuple[str, ...], ...]) -> list[tuple[str, ...]]:
    """The same ``cells``, without the name of a row where the row above has it too."""
    above = ("", *(row[0] for row in cells))
    return [("" if row[0] == name else row[0], *row[1:]) for name, row in zip(above, cells, strict=False)]


def print_advice(findings: Iterable[Advice]) -> None:
    """Print one line for each finding."""
    for finding in findings:
        style = "yellow" if finding.level == "warning" else "cyan"
        say(f"{finding.level} ({finding.criterion}): {finding.message}", style)


def print_files(paths: Iterable[Path]) -> None:
    """Print where things were written."""
    for path in paths:
        say(f"wrote {path}")
