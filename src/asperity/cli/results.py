"""The commands on results: ``stress``, ``plot``, ``report``, ``export`` and ``cite``."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ..contact.history import HistoryResult
from ..core import require
from ..core.citations import cite as references
from ..core.errors import InputError
from ..core.settings import COMMAND_LINE, validated
from ..io.atomic import require_new_files
from ..io.export import export_csv, export_vtk
from ..io.results import contact_of, document_in, load
from ..io.schemas.problem import SolverTable
from ..io.surface_files import ENDINGS, require_ending, save_surface
from ..physics.stress.part import Stress, stress_request
from ..physics.stress.survey import Planned, StressRequest
from ..plots.contact import figures_of
from ..plots.together import save_pictures
from ..report import write_report
from ..report.folder import STRESSES, write_parts
from ..report.tractions import write_tractions_report
from ..run.build import build
from ..run.document import TRACTIONS, ProblemDocument, checked_parts, dumps, load_document, loads, read_table, relocated
from ..run.execute import analysed
from ..run.stored import load_outcome
from ..run.tractions import checked_tractions, run_tractions, save_tractions, traction_rows
from .contact import Force, Out, file_options, files_in, output_folder, write_volume
from .declared import Given, Option, offers, part_names, part_options, with_parts
from .main import NOT_CONVERGED, OK
from .options import solver_options
from .show import console, print_files, print_problem, print_verdict, print_words, say, stage
from .show import table as text_table

Loaded = Annotated[
    Path,
    typer.Argument(
        help="Result file of `asperity contact --out`, or document with a table [tractions].",
        metavar="RESULT.nc|LOADS.toml",
    ),
]
Result = Annotated[Path, typer.Argument(help="Result file of `asperity contact --out`.", metavar="RESULT.nc")]


def plot(
    file: Result,
    kind: Annotated[
        str,
        typer.Option(
            "--kind",
            help="all, heights, pressure, pressure_log, pressure_view, contact, gap, section, histogram or "
            "gap_histogram; "
            "of an indented surface also indentation and residual, of a wet contact menisci.",
        ),
    ] = "all",
    out: Annotated[Path, typer.Option("--out", help="Folder of the pictures, made if missing.")] = Path(),
    force: Force = False,
) -> None:
    """Draw the figures of a result as PNG files."""
    outcome = load_outcome(file)
    found = {figure.name: figure for figure in figures_of(outcome.path or outcome.result)}
    if kind not in found:
        found = {figure.name: figure for figure in itertools.chain(*outcome.figures.values())} | found
    require.one_of(kind, ("all", *found), "--kind")
    print_files(save_pictures(found.values() if kind == "all" else [found[kind]], out, overwrite=force))


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
    surface: Annotated[
        Path | None,
        typer.Option("--surface", help=f"Heights of the surface or line scan as prepared: {', '.join(ENDINGS)}."),
    ] = None,
    force: Force = False,
) -> None:
    """Write a result for other programs."""
    wanted = [path for path in (csv, vtk, surface) if path is not None]
    if not wanted:
        raise InputError(
            "export must have a file to write, but has none: give --csv FILE, --vtk FILE or --surface FILE."
        )
    if surface is not None:
        require_ending(surface)
    require_new_files(wanted, overwrite=force, inputs=(file,))
    outcome = load_outcome(file)
    if csv is not None:
        result = outcome.result if outcome.stored or outcome.path is None else outcome.path
        export_csv(result, csv, scalars=outcome.scalars, overwrite=force)
    if vtk is not None:
        export_vtk(outcome.result, vtk, overwrite=force)
    if surface is not None:
        heights = outcome.result.problem.surface
        save_surface(heights.row(0) if heights.shape[1] == 1 else heights, surface, overwrite=force)
    print_files(wanted)


def cite(
    file: Annotated[Path, typer.Argument(help="Result file (.nc) or problem document (.toml, .json).", metavar="FILE")],
) -> None:
    """Print the papers behind the numbers of a result or a problem."""
    if file.suffix.lower() in (".toml", ".json"):
        say(references(build(load_document(file), file.parent)))
        return
    result, text = load(file), document_in(file)
    document, part = None if text is None else loads(text), Stress()
    stressed = document is not None and part.settings_in(document) is not None
    planned = [Planned(part.asked(document, file.parent), contact_of(result).problem)] if stressed else []
    say(references(result, *planned))


# The stresses in a contact that has been solved and saved.


def _options() -> list[Option]:
    threads = [option for option in solver_options() if option.name == "--threads"]
    return [*part_options("friction", "stress"), *threads, *file_options("stress_vtk", "stress_nc")]


@offers(_options)
def stress(file: Loaded, given: Given, out: Out = None, force: Force = False) -> None:
    """Compute the stresses in a saved contact, without solving it again, or under prescribed
    tractions.

    A document with the table [tractions] prescribes point, line and patch loads and arrays of
    pressure and shear on a body. Of a result, what the result's own problem document requests is
    computed, with the options in place of its parts; without either, the section y=max. The
    pressure stays that of the result, whatever the friction.

    Examples: asperity stress run/result.nc --friction 0.3 --section y=max --depths 0nm,5nm --out
    stresses; asperity stress loads.toml --section y=max --out stresses

    Exit code 1 if the saved contact has not converged; the others as for `contact`.
    """
    files = files_in(given, force=force)
    written = [*files.values()]
    if file.suffix.lower() in (".toml", ".json"):
        _under_tractions(file, given, out, files, force=force)
        return
    loaded = load(file)
    result, path = contact_of(loaded), loaded if isinstance(loaded, HistoryResult) else None
    request, document, threads = _asked(document_in(file), given)
    Stress().at_work.check(request, result.problem)
    with output_folder(out, force=force) as folder:
        asks = {"stress": request, "yielding": True}
        outcome = analysed(result, asks, path, threads=threads, lines=folder is not None, stage=stage)
        if folder is not None and out is not None:
            write_parts(outcome, folder, document and relocated(document, file.parent, out))
            names = ["report.html", "result.nc", "plots", STRESSES, *(["problem.toml"] if document else [])]
            written = [*(out / name for name in names), *written]
    write_volume(outcome, files, force=force)
    print_problem(outcome, f"Stresses in {file}")
    print_words(outcome)
    print_verdict(outcome.verdict)
    print_files(written)
    raise typer.Exit(OK if result.converged else NOT_CONVERGED)


def _under_tractions(file: Path, given: Given, out: Path | None, files: Mapping[str, Path], *, force: bool) -> None:
    """The stresses under the tractions of the document ``file``, with the options in place of its
    table [stress]."""
    table = read_table(file)
    if TRACTIONS not in table:
        raise InputError(
            f"document for `asperity stress` must have a table [tractions], but {file} has none; a contact is "
            "solved by `asperity contact --from`.",
            subject="document for `asperity stress`",
        )
    if given.under("friction").values:
        raise InputError(
            "friction must be left out under prescribed tractions, but is given: prescribe the shear of the loads."
        )
    chosen = {"stress": given.under("stress").table(), "solver": given.under("solver").table()}
    table = {**table, **{name: {**table.get(name, {}), **values} for name, values in chosen.items() if values}}
    document = checked_tractions(table, f"problem document {file}", part_names(given, everything=False))
    with output_folder(out, force=force) as folder:
        outcome = run_tractions(document, file.parent, stage=stage, lines=folder is not None)
        if folder is not None and out is not None:
            text = dumps(relocated(document, file.parent, out))
            (folder / "problem.toml").write_text(text, encoding="utf-8", newline="\n")
            save_tractions(outcome, text, folder / "result.nc")
            figures = itertools.chain(*outcome.figures.values())
            save_pictures(figures, folder / "plots", processes=document.solver.threads)
            write_tractions_report(outcome, folder / "report.html", document=document, text=text)
            export_csv(outcome.found["stress"].detail, folder / STRESSES)
    write_volume(outcome, files, force=force)
    loaded: Any = outcome.result
    console().print(text_table(document.title or f"Tractions of {file}", traction_rows(loaded, document)))
    print_words(outcome)
    names = ("report.html", "result.nc", "plots", STRESSES, "problem.toml")
    print_files([*([] if out is None else [out / name for name in names]), *files.values()])


def _asked(text: str | None, given: Given) -> tuple[StressRequest, ProblemDocument | None, int | None]:
    """What is asked for, the document in the result, whose ``text`` is given, with that in it, and
    the threads."""
    document = None if text is None else loads(text)
    before: Any = None if document is None or getattr(document, "stress") is None else document  # noqa: B009
    tables = ("friction", "stress")
    start = (
        {}
        if before is None
        else {name: getattr(before, name).model_dump(mode="json", exclude_none=True) for name in tables}
    )
    table = with_parts(start, given, ("stress",))
    checked = checked_parts(table, COMMAND_LINE, part_names(given, everything=True))
    request = stress_request(checked.stress, checked.friction)
    earlier = None if before is None else stress_request(before.stress, before.friction)
    had = None if earlier is None or not earlier.coupled else (earlier.friction, earlier.direction)
    if request.coupled and had != (request.friction, request.direction):  # the saved pressure is without it
        holds = (
            "without coupling"
            if had is None
            else f"coupled with friction {had[0]:g} along {math.degrees(had[1]):g} deg"
        )
        raise InputError(
            "--coupled must have the pressure under the friction asked for, but that of the result was solved "
            f"{holds}. Solve again: asperity contact --from problem.toml --coupled with that friction.",
            subject="--coupled",
        )
    asked = {name: getattr(checked, name) for name in tables}
    threads = validated(SolverTable, given.under("solver").table(), COMMAND_LINE, {"threads": "--threads"}).threads
    return request, None if document is None else document.model_copy(update=asked), threads
