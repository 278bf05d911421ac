"""What a design leaves in its folder: numbers, tables, figures and a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..io.tables import write_table
from ..parts.part import Table
from ..plots.design import bars_height, plot_changes, plot_front, plot_history, plot_margins
from ..plots.picture import CURVE_SIZE, Figure, curve_figure
from ..plots.together import save_pictures
from ..studies.campaign import STUDY
from ..studies.design.answer import Design, Objective, value_text
from .page import shown, software_rows, write_page

DESIGN, TABLE, CHANGES, FRONT, PLOTS = "design.json", "design.csv", "changes.csv", "front.csv", "plots"
REPORT = "report.html"
"""Names in the folder."""


def design_figures(design: Design) -> Iterator[Figure]:
    """Figures of ``design``: how the search went, the margins, and the front where there is one."""
    aim = design.objective
    values, missed = np.array(design.history).reshape(-1, 2).T
    text = f"{aim.label[:1].upper()}{aim.label[1:]} of the designs that the search met, in their order."
    history, larger = _labelled(aim, values), aim.goal == "maximise"
    yield curve_figure(
        "history", "Search", text, lambda ax: plot_history(history, missed <= design.tolerance, ax, larger=larger)
    )
    if design.constraints:
        names = [each.words for each in design.constraints]
        margins = np.array([each.margin for each in design.constraints])
        text = "How far each number is within its limit at the recommended design, as a share of the limit."
        yield curve_figure(
            "margins", "Margins", text, lambda ax: plot_margins(names, margins, ax), (CURVE_SIZE[0], bars_height(names))
        )
    yield from _changes(design)
    if design.front and design.second is not None:
        first = _labelled(aim, np.array([point.objective for point in design.front]))
        second = _labelled(design.second, np.array([point.second for point in design.front]))
        best = int(np.argmax(first.values) if larger else np.argmin(first.values))
        text = "Designs of which none is better in one objective without being worse in the other."
        said = design.in_words
        yield curve_figure("front", "Front", text, lambda ax: plot_front(first, second, best, ax, designs=said))


def write_design_files(design: Design, folder: str | Path) -> tuple[Path, ...]:
    """Write numbers, tables and figures of ``design`` into ``folder``, over those of an earlier
    time.

    Raises
    ------
    OutputError
        If one of them cannot be written.
    """
    place = Path(folder)
    design.save_json(place / DESIGN, overwrite=True)
    design.save_csv(place / TABLE, overwrite=True)
    written = [place / DESIGN, place / TABLE]
    units = {each.name: each.unit for each in design.variables}
    if design.changes:
        names = [f"margin of {limit}" for limit in design.limits]
        rows: list[tuple[Any, ...]] = [
            ("variable", "unit", "value", f"{design.objective.name} ({design.objective.unit})", *names)
        ]
        rows += [
            (each.variable, units[each.variable], each.value, each.objective, *each.margins) for each in design.changes
        ]
        write_table(rows, place / CHANGES, overwrite=True)
        written.append(place / CHANGES)
    if design.front and design.second is not None:
        names = [each.name for each in design.variables]
        heads = [f"{each.name} ({each.unit})" for each in (design.objective, design.second)]
        points = [(each.objective, each.second, *each.values) for each in design.front]
        write_table([(*heads, *names), *points], place / FRONT, overwrite=True)
        written.append(place / FRONT)
    figures = tuple(design_figures(design))
    save_pictures(figures, place / PLOTS, overwrite=True)
    study = place / STUDY
    document = study.read_text(encoding="utf-8") if study.is_file() else None
    write_design_report(design, place / REPORT, document=document, figures=figures, overwrite=True)
    return (*written, place / PLOTS, place / REPORT)


def write_design_report(
    design: Design,
    path: str | Path,
    *,
    document: str | None = None,
    figures: Sequence[Figure] | None = None,
    overwrite: bool = False,
) -> None:
    """Write a page on ``design`` to the HTML file ``path``; it needs no network and no other file.

    Parameters
    ----------
    design
        What was found.
    path
        File, ending in .html.
    document
        Text of the study document behind it.
    figures
        Those that have been drawn already.
    overwrite
        Whether a file that exists is replaced.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    tables = [(heading.lower(), heading, Table(headings, tuple(rows))) for heading, headings, rows in design.tables()]
    headings, rows = design.searches()
    tables.append(("searches", "Searches", Table(headings, tuple(rows))))
    aims = [one for one in (design.objective, design.second) if one is not None]
    headline = [(each.name.replace("_", " "), value_text(each.value, each.unit)) for each in design.variables]
    headline += [(f"{one.label} ({one.goal})", value_text(one.value, one.unit)) for one in aims]
    goal = f"{design.objective.goal} {design.objective.label}"
    write_page(
        path,
        "design.html",
        title=design.title or "Design",
        summary=f"Design: {goal} by {', '.join(each.name for each in design.variables)}.",
        good=design.feasible and design.converged,
        verdict=design.verdict,
        work=design.work,
        headline=headline,
        tables=tables,
        figures=shown(design_figures(design) if figures is None else figures),
        provenance=software_rows(design.software),
        citation_keys=design.citation_keys,
        document=document,
        document_of="Study",
        overwrite=overwrite,
    )


MOST_CHANGES = 24
"""Changes that are drawn; the table holds all."""


def _changes(design: Design) -> Iterator[Figure]:
    """The figure of what each change of a variable does."""
    base, units = design.objective.value, {each.name: each.unit for each in design.variables}
    shown_here = design.changes[:MOST_CHANGES]
    if not shown_here or not base:
        return
    names = [f"{each.variable} {value_text(each.value, units[each.variable])}" for each in shown_here]
    shares = np.array([each.objective / base - 1.0 for each in shown_here])
    met = np.array([all(margin >= -design.tolerance for margin in each.margins) for each in shown_here])
    label = design.objective.label
    text = f"{label[:1].upper()}{label[1:]} with one variable changed: each number by a tenth, and each other choice."
    yield curve_figure(
        "changes", "Changes", text, lambda ax: plot_changes(names, shares, met, ax), (CURVE_SIZE[0], bars_height(names))
    )


def _labelled(aim: Objective, values: np.ndarray) -> Labelled:
    return Labelled(Quantity(aim.name, aim.unit, aim.label), values)
