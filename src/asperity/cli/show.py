"""What the commands print."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from ..contact.path import LoadPath
    from ..contact.plastic_load import PlasticLoad
    from ..contact.result import ContactResult
    from ..core.status import Advice


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


def print_problem(result: ContactResult, title: str) -> None:
    """Print what was solved."""
    from ..core.units import show
    from ..io.words import problem_rows

    control = result.control
    console().print(
        table(
            title,
            [*problem_rows(result.problem), ("prescribed", f"{control.name} {show(control.value, control.unit)}")],
        )
    )


def print_result(result: ContactResult, title: str) -> None:
    """Print problem, scalars and status of ``result``."""
    out = console()
    print_problem(result, title or "Contact")
    for step in result.problem.surface.origin.history:
        say(f"  {step}", "dim")
    out.print(table("Result", scalar_rows(result)))
    say(result.status.message, "green" if result.converged else "bold red")
    if result.status.remedy:
        say(result.status.remedy, "red")


def print_path(path: LoadPath) -> None:
    """Print where the load of ``path`` turns, and where its work went."""
    from ..report.plasticity import energy_table, path_sentence, turn_table

    out = console()
    for title, made in (("Load path", turn_table(path)), ("Energies", energy_table(path))):
        out.print(table(title, made.cells, made.headings))
    say(path_sentence(path), "" if path.converged else "bold red")


def print_plastic_load(found: PlasticLoad) -> None:
    """Print the load at which the contact becomes plastic."""
    from ..report.plasticity import plastic_load_row

    console().print(table("Plastic load", [plastic_load_row(found)]))


def print_advice(findings: Iterable[Advice]) -> None:
    """Print one line for each finding."""
    for finding in findings:
        style = "yellow" if finding.level == "warning" else "cyan"
        say(f"{finding.level} ({finding.criterion}): {finding.message}", style)


def print_files(paths: Iterable[Path]) -> None:
    """Print where things were written."""
    for path in paths:
        say(f"wrote {path}")
