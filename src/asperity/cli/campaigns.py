"""The commands on campaigns: ``run``, ``status`` and ``collect``."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import BarColumn, Progress, TextColumn

from ..core.words import speaking
from ..io.schemas.study import DEFAULT_QUANTITIES
from ..parts.registry import parts
from ..report.study import (
    axis_rows,
    case_table,
    cause_table,
    derived_table,
    sentences,
    summary,
    warning_texts,
    write_study_files,
)
from ..run.document import ProblemDocument, relocated
from ..studies.campaign import Campaign, open_study, prepare_study
from ..studies.places import problem_table
from ..studies.run import NoWatch, Watch
from .interrupt import INTERRUPTED
from .main import NOT_CONVERGED, OK
from .show import Nowhere, confirmed, console, error_console, print_files, say, short_names, table, watching

if TYPE_CHECKING:
    from ..studies.collect import CampaignState

Folder = Annotated[
    Path, typer.Argument(help="Folder of the results, or the study document they lie beside.", metavar="FOLDER")
]


Out = Annotated[
    Path | None, typer.Option("--out", help="Folder of the results; STUDY-results by default.", metavar="DIR")
]
Workers = Annotated[
    int | None, typer.Option("--workers", help="Worker processes; as many as cores by default.", metavar="N")
]
Dask = Annotated[
    str | None,
    typer.Option("--dask", help='Scheduler of a Dask cluster instead, "tcp://host:8786".', metavar="ADDRESS"),
]
Retry = Annotated[bool, typer.Option("--retry", help="Try again what has failed.")]


def run(
    study: Annotated[Path, typer.Argument(help="Study document (TOML or JSON).", metavar="STUDY")],
    out: Out = None,
    workers: Workers = None,
    dask: Dask = None,
    retry: Retry = False,
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask before work of hours.")] = False,
) -> None:
    """Run or resume a campaign over many contacts: only missing cases are computed.

    Example: asperity run study.toml

    Exit code 0: all cases done; 1: some failed (the others are there, and the causes are listed);
    2: bad input; 130: interrupted by Ctrl-C (all finished cases are kept: run it again to resume).
    """
    with speaking("command"):  # of a document, whose keys have no options here
        campaign = prepare_study(study, out, confirm=partial(confirmed, yes=yes))
    monte_carlo = campaign.study.document.monte_carlo
    most = "at most " if monte_carlo is not None and monte_carlo.stop is not None else ""
    say(f"{campaign.title}: {most}{campaign.plan.n_cases} cases, results in {campaign.folder}")
    _run(campaign, f"asperity run {study}", workers=workers, dask=dask, retry=retry)
    raise typer.Exit(_report(campaign))


def _run(campaign: Campaign, again: str, **options: Any) -> None:
    """Compute what is missing; ``again`` is the command that resumes it."""
    try:
        with watched(campaign.title) as watch:
            done = campaign.run(watch=watch, **options)
    except KeyboardInterrupt:
        say(f"Interrupted. Finished cases are kept; resume with: {again}", "yellow")
        raise typer.Exit(INTERRUPTED) from None
    say(f"computed {done.done} cases, {done.failed} of them failed; {done.found} were there already")


def solve_files(document: ProblemDocument, files: Sequence[Path], out: Path | None, *, yes: bool) -> int:
    """Solve ``document`` for each of the ``files`` as a study in the folder ``out``, or one of no
    duration; the exit code."""
    with TemporaryDirectory() if out is None else nullcontext(out) as name:
        place = Path(name)
        paths = [str(file.absolute()) if out is None else os.path.relpath(file, place) for file in files]
        asked = [part.headline for part in parts() if part.headline and getattr(document, part.table) is not None]
        study = {
            "version": 1,
            "title": document.title or f"{len(files)} files",
            "problem": problem_table(relocated(document, Path(), place)),
            "quantities": [*DEFAULT_QUANTITIES, *asked],
            "axes": [{"path": "surface.path", "name": "file", "values": paths}],
        }
        campaign = prepare_study(study, place, start=place, confirm=partial(confirmed, yes=yes))
        _run(campaign, "the same command")
        found = case_table(campaign, campaign.dataset())
        rows = [(name, *row[1:]) for name, row in zip(short_names(files), found.cells, strict=False)]
        console().print(table(campaign.title, rows, found.headings))
        if out is not None:
            return _report(campaign)
        _print_causes(campaign, campaign.state())
        say("Add --out DIR for the report and the table of all files.", "dim")
        return NOT_CONVERGED if campaign.state().failed else OK


def status(folder: Folder) -> None:
    """Tell how far a campaign is, also while it runs."""
    campaign = open_study(folder)
    state = campaign.state()
    console().print(table(campaign.title, axis_rows(campaign)))
    say(summary(campaign, state), "green" if state.complete and not state.failed else "yellow")
    _print_causes(campaign, state)


def collect(folder: Folder) -> None:
    """Write what a campaign has found so far: NetCDF, CSV, pictures and a report."""
    raise typer.Exit(_report(open_study(folder)))


MOST_PRINTED = 24
"""Rows of the table of cases on the terminal; the files hold all."""


def _report(campaign: Campaign) -> int:
    """Write and print results; the exit code."""
    written = write_study_files(campaign, campaign.folder)
    state, derived, data = campaign.state(), campaign.analysis(), campaign.dataset()
    if derived is not None:
        found = derived_table(campaign, data, derived)
        console().print(table("Findings", found.cells, found.headings))
    else:
        found = case_table(campaign, data)
        few = len(found.cells) <= MOST_PRINTED
        heading = "Cases" if few else f"The first {MOST_PRINTED} of {data['outcome'].size} cases"
        console().print(table(heading, found.cells[:MOST_PRINTED], found.headings))
    for text in sentences(campaign, data):
        say(text)
    say(summary(campaign, state), "green" if state.complete and not state.failed else "yellow")
    _print_causes(campaign, state)
    print_files(written)
    return NOT_CONVERGED if state.failed else OK


def _print_causes(campaign: Campaign, state: CampaignState) -> None:
    """Print the warnings above the tables that count them."""
    for text in warning_texts(state):
        say(f"warning: {text}", "yellow", warning=True)
    shown = (
        ("Failures by cause", cause_table(campaign, state.causes, "Cause")),
        ("Warnings and notes of the cases", cause_table(campaign, state.findings, "Warning or note")),
    )
    for heading, found in shown:
        if found.cells:
            console().print(table(heading, found.cells, found.headings))


BETWEEN_LINES = 10.0
"""Seconds between two lines where no bar is shown."""


@contextmanager
def watched(title: str) -> Iterator[Watch]:
    """Watch that shows the progress of a study on stderr, on a bar or in lines that begin with its
    ``title``.

    It shows nothing where answers are dropped (``--quiet``).
    """
    if isinstance(sys.stdout, Nowhere):
        yield NoWatch()
        return
    if not watching():
        yield Lines(lambda text: _write(f"{title}: {text}\n"))
        return

    with Progress(BarColumn(24), TextColumn("{task.description}"), console=error_console()) as bar:
        yield OnBar(bar)


class Pace:
    """Cases per second since the first answer, and what that leaves to wait."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._started = clock()

    def text(self, done: int, failed: int, found: int, total: int) -> tuple[str, float]:
        """One line on the state of the study, and the share that is done."""
        seconds = max(self._clock() - self._started, 1e-9)
        rate = done / seconds
        left = max(total - found - done, 0) / rate if rate > 0.0 else float("inf")
        share = min(1.0, (found + done) / max(total, 1))
        failures = f", {failed} failed" if failed else ""
        speed = f"{rate:.3g} cases/s" if rate >= 1.0 else f"{rate * 60.0:.3g} cases/min"
        return f"{found + done} of {total} cases{failures}, {speed}, {duration(left)} left", share


class Lines:
    """Progress as a line of text every ten seconds, and after the last case."""

    def __init__(self, write: Callable[[str], None], clock: Callable[[], float] = time.monotonic) -> None:
        self._write, self._clock, self._pace = write, clock, Pace(clock)
        self._last = clock()

    def update(self, done: int, failed: int, found: int, total: int) -> None:
        """Write a line if it is time for one."""
        if self._clock() - self._last >= BETWEEN_LINES or found + done >= total:
            self._last = self._clock()
            self._write(self._pace.text(done, failed, found, total)[0])


class OnBar:
    """Moves a ``bar``."""

    def __init__(self, bar: Progress) -> None:
        self._bar, self._task, self._pace = bar, bar.add_task("starting workers", total=None), Pace()

    def update(self, done: int, failed: int, found: int, total: int) -> None:
        """Move it."""
        text, share = self._pace.text(done, failed, found, total)
        self._bar.update(self._task, description=text, total=1.0, completed=share)


def duration(seconds: float) -> str:
    """``seconds`` as 3 s, 2 min 05 s, 1 h 20 min."""
    if not seconds < 1e9:
        return "unknown time"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def _write(text: str) -> None:
    if sys.stderr is not None:
        sys.stderr.write(text)
        sys.stderr.flush()
