"""The command ``compare``: every theory of rough contact beside the numerical solution."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer import Argument, Option

from ..core.parameters import Parameter
from ..core.values import Number
from .failures import NOT_CONVERGED, OK
from .options import BodyOptions, ReadingOptions, SolveOptions, option
from .preparing import PreparationOptions

if TYPE_CHECKING:
    from ..core.arrays import RealArray
    from ..run.build import Case
    from ..run.document import ProblemDocument
    from ..studies.comparison import Comparison


NAMES_IN_FOLDER = ("report.html", "comparison.nc", "comparison.csv", "plots", "problem.toml")
"""What a comparison leaves in its folder."""


def compare(
    source: CompareSource,
    reading: ReadingOptions,
    preparation: PreparationOptions,
    bodies: BodyOptions,
    options: CompareOptions,
) -> None:
    """Compare every theory of rough contact with the boundary-element solution, on one surface.

    Examples: asperity compare scan.di --body DLC --out run;
    asperity compare scan.di --body steel --pressures 1MPa..1GPa --loads 20 --theories persson,bush-gibson-thomas

    Exit code 0: done; 1: a load did not converge (it is empty and named); 2: input that cannot be used; 130: interrupted.
    """
    from ..run.build import build
    from ..run.document import checked, relocated
    from .perform import output_folder
    from .show import print_files

    table, names, base = _table(source, reading, preparation, bodies, options)
    document = checked(table, str(source.from_ or "command line"), names)
    values, case = _pressures(options), build(document, base)
    with output_folder(options.out, force=options.force) as folder:
        comparison = _compared(case, values, options)
        if folder is not None and options.out is not None:
            _write(comparison, relocated(document, base, options.out), folder)
    _print(comparison, document.title)
    print_files([] if options.out is None else [options.out / name for name in NAMES_IN_FOLDER])
    solved = comparison.numerical
    raise typer.Exit(NOT_CONVERGED if solved is not None and solved.notes else OK)


def _table(
    source: CompareSource,
    reading: ReadingOptions,
    preparation: PreparationOptions,
    bodies: BodyOptions,
    options: CompareOptions,
) -> tuple[dict[str, Any], dict[str, str], Path]:
    """Document without a load of its own, what the user calls its keys, and the folder its paths start at."""
    from ..core.errors import InputError
    from .compose import NAMES, body_names, composed, overlaid
    from .contact import require_no_surface, table_of_document
    from .preparing import step_names

    solve = SolveOptions(tolerance=options.tolerance, threads=options.threads)
    if source.from_ is not None:
        require_no_surface(source.file, reading, preparation, bodies)
        table = table_of_document(source.from_, bodies, solve)
        return {**table, "control": dict(_PLACEHOLDER)}, {}, source.from_.parent
    if source.file is None:
        raise InputError("FILE with the rough surface must be given, or a problem document by --from, but neither is.")
    table = overlaid(
        {**composed(source.file, reading, preparation, bodies), "control": dict(_PLACEHOLDER)}, bodies, solve
    )
    return table, {**NAMES, **body_names(table), **step_names(table["surface"]["prepare"])}, Path()


_PLACEHOLDER = MappingProxyType({"mean_pressure": "1 Pa"})
"""Load that a document must have until the loads of the comparison are known."""

_HEADING = "Theories and numerical solution (area of a theory: deviation from the numerical one; rms: where it holds)"


def _pressures(options: CompareOptions) -> RealArray | None:
    from ..core.errors import InputError
    from ..studies.compare import LOADS
    from .theory import read_range

    text, count = options.pressures, LOADS if options.loads is None else options.loads
    if options.loads is not None and (text is None or ".." not in text):
        raise InputError("--loads must be given together with a range only, such as --pressures 1MPa..1GPa.")
    if count < 2:
        raise InputError(f"--loads must be at least 2 for a range, but is {count}.")
    asked = Parameter("pressures", float, Number("pressure"), help="nominal pressures")
    return None if text is None else read_range(asked, text, points=count, linear=False)


def _compared(case: Case, pressures: RealArray | None, options: CompareOptions) -> Comparison:
    from ..core import units
    from ..core.engine import CpuEngine
    from ..studies.compare import MOST_CONTACTS
    from ..studies.compare import compare as compare_theories
    from .progress import stage

    names = None if options.theories is None else [name.strip() for name in options.theories.split(",")]
    inputs = {} if options.work is None else {"work": units.parse_in(options.work, "J/m^2", "--work")}
    with stage("solving every load") as progress:
        return compare_theories(
            case.problem,
            pressures=pressures,
            theories=names,
            inputs=inputs,
            numerical=not options.no_numerical,
            most_contacts=MOST_CONTACTS if options.most_contacts is None else options.most_contacts,
            solver=case.solver,
            progress=progress,
            engine=CpuEngine(case.threads),
        )


def _write(comparison: Comparison, document: ProblemDocument, folder: Path) -> None:
    """Write everything into ``folder``; the load of the document is the highest."""
    from ..io.schemas.problem import ControlTable
    from ..plots.comparison import comparison_figures, save_comparison_plots
    from ..report.comparison import write_comparison_report
    from ..run.document import save_document
    from ..studies.comparison_files import export_comparison_csv, save_comparison

    highest = ControlTable.model_validate({"mean_pressure": f"{float(comparison.pressures[-1])!r} Pa"})
    save_document(document.model_copy(update={"control": highest}), folder / "problem.toml")
    save_comparison(comparison, folder / "comparison.nc")
    export_comparison_csv(comparison, folder / "comparison.csv")
    figures = comparison_figures(comparison.dataset)
    save_comparison_plots(figures, folder / "plots")
    write_comparison_report(comparison, folder / "report.html", title=document.title, figures=figures)


def _print(comparison: Comparison, title: str) -> None:
    """Print setup, table, limits, what was left out, remarks and findings."""
    from ..report.comparison import comparison_sentence, left_out_rows, limit_rows, setup_rows, slope_table
    from .show import console, print_advice, say, table

    out, found = console(), slope_table(comparison)
    out.print(table(title or "Comparison", setup_rows(comparison)))
    shown = table(_HEADING, found.cells, found.headings)
    for column in (shown.columns[0], shown.columns[-1]):
        column.no_wrap = True  # names and ranges are read whole, numbers fit anyway
    out.print(shown)
    for heading, rows in (
        ("Where each leaves its validity", limit_rows(comparison)),
        ("Left out", left_out_rows(comparison)),
    ):
        if rows:
            out.print(table(heading, rows))
    for remark in comparison.remarks:
        say(remark, "cyan")
    print_advice(comparison.findings)
    say(comparison_sentence(comparison))


LOADS, THEORIES, OUTPUT = "Loads", "Theories and solver", "Output"


@dataclass(frozen=True)
class CompareSource:
    """Where the surface and the bodies come from: a file with heights and options, or a document."""

    file: Annotated[Path | None, Argument(help="File with the heights of the rough surface.")] = None
    from_: Annotated[
        Path | None,
        Option("--from", "--document", help="Problem document; its load is left aside.", metavar="DOCUMENT"),
    ] = None


@dataclass(frozen=True)
class CompareOptions:
    """Loads, theories, and where the comparison is written."""

    pressures: Annotated[
        str | None,
        option(
            "--pressures",
            "Nominal pressures: a logarithmic range 1MPa..1GPa, or a list 1MPa,10MPa; from 0.004 to 0.25 E* h' by default.",
            LOADS,
            "PRESSURES",
        ),
    ] = None
    loads: Annotated[int | None, option("--loads", "Number of loads of a range; 12 by default.", LOADS)] = None
    theories: Annotated[
        str | None,
        option("--theories", "Names with commas between; all that the surface allows by default.", THEORIES, "NAME,…"),
    ] = None
    no_numerical: Annotated[bool, option("--no-numerical", "Leave the boundary-element solution out.", THEORIES)] = (
        False
    )
    work: Annotated[
        str | None, option("--work", "Work of adhesion, for fuller-tabor: 50mJ/m^2.", THEORIES, "ENERGY/AREA")
    ] = None
    most_contacts: Annotated[
        int | None,
        option("--most-contacts", "Contacts up to which interacting-crests are solved; 1000 by default.", THEORIES),
    ] = None
    tolerance: Annotated[float | None, option("--tolerance", "Relative error at which to stop.", THEORIES)] = None
    threads: Annotated[int | None, option("--threads", "Threads of the solver; all cores by default.", THEORIES)] = None
    out: Annotated[
        Path | None,
        option("--out", "Folder for report.html, comparison.nc, comparison.csv and plots.", OUTPUT, "DIR"),
    ] = None
    force: Annotated[bool, option("--force", "Replace files that exist.", OUTPUT)] = False
