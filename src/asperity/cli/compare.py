"""The command ``compare``: every theory of rough contact beside the numerical solution."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..core.errors import InputError
from ..core.parameters import Parameter
from ..core.settings import COMMAND_LINE
from ..core.values import Number, Text, Whole
from ..io.schemas.problem import ControlTable
from ..plots.comparison import comparison_figures
from ..plots.together import save_pictures
from ..report.comparison import (
    comparison_sentence,
    left_out_rows,
    limit_rows,
    setup_rows,
    slope_table,
    write_comparison_report,
)
from ..run.build import Case, build, large_grid, stated_points
from ..run.document import checked, relocated, save_document
from ..studies.compare import LOADS, MOST_CONTACTS
from ..studies.compare import compare as compare_theories
from ..studies.comparison import Comparison, export_comparison_csv, save_comparison
from .contact import YES, Force, asked_table, output_folder
from .declared import Given, Option, offers, sorted_out
from .main import NOT_CONVERGED, OK
from .options import BASIC, OUTPUT, body_options, preparation_options, reading_options, solver_options
from .show import confirmed, console, print_advice, print_files, say, stage, table
from .theory import option_of, read_range

NAMES_IN_FOLDER = ("report.html", "comparison.nc", "comparison.csv", "plots", "problem.toml")
"""What a comparison leaves in its folder."""

PANEL = "Loads and theories"

PRESSURES = Parameter(
    "pressures",
    float,
    Number("pressure"),
    None,
    "nominal pressures: a logarithmic range 1MPa..1GPa, or a list 1MPa,10MPa; from 0.004 to 0.25 E* h' by default",
)
OWN = (
    (PRESSURES, "PRESSURES"),
    (Parameter("loads", int, Whole(2), LOADS, "number of loads of a range"), None),
    (
        Parameter("theories", str, Text(), None, "names with commas between; all that the surface allows by default"),
        "NAME,…",
    ),
    (Parameter("work", float, Number("J/m^2"), None, "work of adhesion, for fuller-tabor: 50mJ/m^2"), "ENERGY/AREA"),
    (
        Parameter("most_contacts", int, Whole(1), MOST_CONTACTS, "contacts up to which interacting-crests are solved"),
        None,
    ),
)
"""Parameters of the comparison beside those of the document, and what stands for their values."""


def _options() -> list[Option]:
    own = [Option(option_of(item), ("compare", item.name), item, PANEL, metavar=metavar) for item, metavar in OWN]
    solver = [option for option in solver_options() if option.name in ("--tolerance", "--threads", "--machine")]
    document = (*body_options(), *reading_options(), *preparation_options(), *solver)
    return [*own, YES, *sorted_out(document, BASIC)]


@offers(_options)
def compare(
    given: Given,
    file: Annotated[
        Path | None, typer.Argument(help="File with the heights of the rough surface.", metavar="FILE")
    ] = None,
    from_: Annotated[
        Path | None,
        typer.Option("--from", "--document", help="Problem document; its load is left aside.", metavar="DOCUMENT"),
    ] = None,
    no_numerical: Annotated[
        bool, typer.Option("--no-numerical", help="Leave the boundary-element solution out.", rich_help_panel=PANEL)
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            help="Folder for report.html, comparison.nc, comparison.csv and plots.",
            metavar="DIR",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    force: Force = False,
) -> None:
    """Compare every theory of rough contact with the numerical solution, on one surface.

    Examples: asperity compare scan.di --body DLC --out run; asperity compare scan.di --body steel
    --pressures 1MPa..1GPa --loads 20 --theories persson,bush-gibson-thomas

    Exit code 0: done; 1: a load did not converge (it is empty and named); 2: input that cannot be
    used; 130: interrupted.
    """
    placed = Given({**given.values, ("control", "mean_pressure"): _PLACEHOLDER}, given.options)
    made, names, base = asked_table(file, from_, placed)
    document = checked(made, str(from_ or COMMAND_LINE), names)
    confirmed(large_grid(stated_points(document.surface)), yes=bool(given.get("yes")))
    case = build(document, base)
    with output_folder(out, force=force) as folder:
        comparison = _compared(case, given, numerical=not no_numerical)
        if folder is not None and out is not None:
            highest = ControlTable.model_validate({"mean_pressure": f"{float(comparison.pressures[-1])!r} Pa"})
            moved = relocated(document, base, out).model_copy(update={"control": highest})
            save_document(moved, folder / "problem.toml")
            save_comparison(comparison, folder / "comparison.nc")
            export_comparison_csv(comparison, folder / "comparison.csv")
            figures = comparison_figures(comparison.dataset)
            save_pictures(figures, folder / "plots")
            write_comparison_report(comparison, folder / "report.html", title=document.title, figures=figures)
    _print(comparison, document.title)
    print_files([] if out is None else [out / name for name in NAMES_IN_FOLDER])
    solved = comparison.numerical
    raise typer.Exit(NOT_CONVERGED if solved is not None and solved.notes else OK)


def _compared(case: Case, given: Given, *, numerical: bool) -> Comparison:
    chosen = given.under("compare").table()
    read = {
        item.name: item.values.read(chosen[item.name], option_of(item)) for item, _ in OWN[3:] if item.name in chosen
    }
    text, loads, theories = chosen.get("pressures"), chosen.get("loads"), chosen.get("theories")
    if loads is not None and (text is None or ".." not in text):
        raise InputError("--loads must be given together with a range only, such as --pressures 1MPa..1GPa.")
    count = LOADS if loads is None else Whole(2).read(loads, "--loads")
    values = None if text is None else read_range(PRESSURES, text, points=count, linear=False)
    with stage("solving every load") as progress:
        return compare_theories(
            case.problem,
            pressures=values,
            theories=theories and [name.strip() for name in theories.split(",")],
            inputs={"work": read["work"]} if "work" in read else {},
            numerical=numerical,
            most_contacts=read.get("most_contacts", MOST_CONTACTS),
            solver=case.solver,
            progress=progress,
            engine=case.engine(),
        )


_PLACEHOLDER = "1 Pa"
"""Load that a document must have until the loads of the comparison are known."""

_HEADING = "Theories and numerical solution (area of a theory: deviation from the numerical one; rms: where it holds)"


def _print(comparison: Comparison, title: str) -> None:
    """Print setup, table, limits, what was left out, remarks and findings."""
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
