"""The command ``design``: the best design of a study document."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import Progress, TextColumn

from ..core.words import speaking
from ..report.design import write_design_files
from ..studies.design.answer import Design
from ..studies.design.optimise import folder_of, optimise
from ..studies.local import available_cores
from .campaigns import Dask, Out, Retry, Workers
from .interrupt import INTERRUPTED
from .main import NOT_CONVERGED, OK
from .show import console, error_console, print_files, say, table, watching


def design(
    study: Annotated[Path, typer.Argument(help="Study document with a table [design].", metavar="STUDY")],
    out: Out = None,
    workers: Workers = None,
    dask: Dask = None,
    retry: Retry = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, all values in SI.")] = False,
) -> None:
    """Find the best design: thickness, material, roughness or load under limits that must hold.

    Example: asperity design coating.toml

    Every contact that is solved is kept: run it again after an interrupt or a change, and only new
    ones are computed. Exit code 0: all limits hold and the search converged; 1: not so; 2: bad
    input; 130: interrupted.
    """
    folder = folder_of(study, out)
    with speaking("command"), resumable(f"asperity design {study}"), counting() as told:
        count = available_cores() if workers is None else workers
        found = optimise(study, folder, workers=count, dask=dask, retry=retry, progress=told)
    written = write_design_files(found, folder)
    if as_json:
        console().out(json.dumps(found.record(), indent=2, ensure_ascii=False), highlight=False)
    else:
        print_design(found)
        print_files(written)
    raise typer.Exit(OK if found.feasible and found.converged else NOT_CONVERGED)


@contextmanager
def resumable(again: str) -> Iterator[None]:
    """Context that ends with the exit code of an interrupt by Ctrl-C; ``again`` is the command that
    goes on."""
    try:
        yield
    except KeyboardInterrupt:
        say(f"Interrupted. Solved contacts are kept; resume with: {again}", "yellow")
        raise typer.Exit(INTERRUPTED) from None


@contextmanager
def counting() -> Iterator[Callable[[int, int], None]]:
    """What shows how many contacts are solved, on stderr if that is a terminal."""
    column = TextColumn("{task.description}")
    with Progress(column, console=error_console(), transient=True, disable=not watching()) as bar:
        task = bar.add_task("checking", total=None)

        def told(solved: int, reused: int) -> None:
            bar.update(task, description=f"{solved} contacts solved, {reused} kept from before")

        yield told


def print_design(found: Design) -> None:
    """Print the tables of a design and its verdict."""
    for heading, headings, rows in found.tables():
        console().print(table(heading, rows, headings))
    say(found.work, "dim")
    good = found.feasible and found.converged
    say(found.verdict, "green" if good else "bold red", warning=not good)
