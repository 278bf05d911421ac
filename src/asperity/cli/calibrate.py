"""The command ``calibrate``: parameters of a contact from a measured curve."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from ..core.words import speaking
from ..report.calibration import write_calibration_files
from ..studies.calibrate import calibrate as fitted
from ..studies.calibration import Calibration
from ..studies.design.optimise import folder_of
from ..studies.local import available_cores
from .campaigns import Out, Retry, Workers
from .design import counting, resumable
from .main import NOT_CONVERGED, OK
from .show import console, print_files, say, table


def calibrate(
    study: Annotated[Path, typer.Argument(help="Study document with a table [calibration].", metavar="STUDY")],
    out: Out = None,
    workers: Workers = None,
    retry: Retry = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, all values in SI.")] = False,
) -> None:
    """Fit modulus, thickness, hardness or work of adhesion to a measured curve.

    Example: asperity calibrate film.toml

    Exit code 0: the curve tells all parameters; 1: it does not, or the fit did not converge; 2: bad
    input; 130: interrupted (solved contacts are kept: run it again to resume).
    """
    folder = folder_of(study, out)
    with speaking("command"), resumable(f"asperity calibrate {study}"), counting() as told:
        count = available_cores() if workers is None else workers
        found = fitted(study, folder, workers=count, retry=retry, progress=told)
    written = write_calibration_files(found, folder)
    if as_json:
        console().out(json.dumps(found.record(), indent=2, ensure_ascii=False), highlight=False)
    else:
        print_calibration(found)
        print_files(written)
    raise typer.Exit(OK if found.converged and found.identifiable else NOT_CONVERGED)


def print_calibration(found: Calibration) -> None:
    """Print the tables of a calibration, its findings and its verdict."""
    for heading, headings, rows in found.tables():
        console().print(table(heading, rows, headings))
    say(found.work, "dim")
    for text in found.findings:
        say(text, "yellow", warning=True)
    good = found.converged and found.identifiable
    say(found.verdict, "green" if good else "bold red", warning=not good)
