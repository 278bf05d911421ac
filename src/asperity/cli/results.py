"""The commands on results: ``plot``, ``report``, ``export`` and ``cite``."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from ..core import require
from ..core.citations import cite as references
from ..core.errors import InputError
from ..io.atomic import require_new_files
from ..io.export import export_csv, export_vtk
from ..io.results import contact_of, document_in, load
from ..parts.stress import Stress
from ..plots.contact import figures_of
from ..plots.picture import save_pictures
from ..report import write_report
from ..run.build import build
from ..run.document import load_document, loads
from ..run.stored import load_outcome
from ..stress.survey import Planned
from .show import print_files, say

Result = Annotated[Path, typer.Argument(help="Result file of `asperity contact --out`.", metavar="RESULT.nc")]
Force = Annotated[bool, typer.Option("--force", help="Replace files that exist.")]


def plot(
    file: Result,
    kind: Annotated[
        str,
        typer.Option(
            "--kind",
            help="all, heights, pressure, pressure_log, contact, gap, section, histogram or gap_histogram; of an indented surface "
            "also indentation and residual, of a wet contact menisci.",
        ),
    ] = "all",
    out: Annotated[Path, typer.Option("--out", help="Folder of the pictures, made if missing.")] = Path(),
    force: Force = False,
) -> None:
    """Draw the figures of a result as PNG files."""
    outcome = load_outcome(file)
    found = figures_of(outcome.path or outcome.result)
    if kind not in found:
        figures = (figure for figures in outcome.figures.values() for figure in figures)
        found = {**{figure.name: partial(bytes, figure.picture) for figure in figures}, **found}
    require.one_of(kind, ("all", *found), "--kind")
    wanted = found if kind == "all" else {kind: found[kind]}
    print_files(save_pictures(wanted, out, overwrite=force))


def report(
    file: Result,
    out: Annotated[Path, typer.Option("--out", help="The HTML file.", metavar="FILE.html")] = Path("report.html"),
    force: Force = False,
) -> None:
    """Write the report of a result again, from what its file holds.

    Example: asperity report run/result.nc --out again.html
    """
    require_new_files((out,), overwrite=force, inputs=(file,))
    outcome = load_outcome(file)
    title = str(outcome.stored.get("report_title", ""))
    write_report(outcome, out, document=document_in(file), title=title, overwrite=force)
    print_files((out,))


def export(
    file: Result,
    csv: Annotated[Path | None, typer.Option("--csv", help="Scalars as a CSV file.")] = None,
    vtk: Annotated[Path | None, typer.Option("--vtk", help="Fields as a VTK image file (.vti).")] = None,
    force: Force = False,
) -> None:
    """Write a result for other programs."""
    wanted = [path for path in (csv, vtk) if path is not None]
    if not wanted:
        raise InputError("export must have a file to write: give --csv FILE or --vtk FILE or both.")
    require_new_files(wanted, overwrite=force, inputs=(file,))
    outcome = load_outcome(file)
    if csv is not None:
        result = outcome.result if outcome.stored or outcome.path is None else outcome.path
        export_csv(result, csv, scalars=outcome.scalars, overwrite=force)
    if vtk is not None:
        export_vtk(outcome.result, vtk, overwrite=force)
    print_files(wanted)


def cite(
    file: Annotated[Path, typer.Argument(help="Result file (.nc) or problem document (.toml, .json).")],
) -> None:
    """Print the papers behind the numbers of a result or a problem."""
    if file.suffix.lower() in (".toml", ".json"):
        say(references(build(load_document(file), file.parent)))
        return
    result, text = load(file), document_in(file)
    asked = None if text is None else Stress().asked(loads(text), file.parent)
    say(references(result, *(() if asked is None else (Planned(asked, contact_of(result).problem),))))
