"""What a design leaves in its folder: numbers, tables and figures."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..io.tables import write_table
from ..plots.design import plot_front, plot_history, plot_margins
from ..plots.picture import Figure, curve_figure
from ..plots.together import save_pictures
from ..studies.design.answer import Design, Objective

DESIGN, TABLE, CHANGES, FRONT, PLOTS = "design.json", "design.csv", "changes.csv", "front.csv", "plots"
"""Names in the folder."""


def design_figures(design: Design) -> Iterator[Figure]:
    """Figures of ``design``: how the search went, the margins, and the front where there is one."""
    aim = design.objective
    values, missed = np.array(design.history).reshape(-1, 2).T
    text = f"{aim.label} of the designs that the search met, in their order."
    history, larger = _labelled(aim, values), aim.goal == "maximise"
    yield curve_figure(
        "history", "Search", text, lambda ax: plot_history(history, missed <= design.tolerance, ax, larger=larger)
    )
    if design.constraints:
        names = [each.words for each in design.constraints]
        margins = np.array([each.margin for each in design.constraints])
        text = "How far each number is within its limit at the recommended design, as a share of the limit."
        yield curve_figure("margins", "Margins", text, lambda ax: plot_margins(names, margins, ax))
    if design.front and design.second is not None:
        first = _labelled(aim, np.array([point.objective for point in design.front]))
        second = _labelled(design.second, np.array([point.second for point in design.front]))
        best = int(np.argmax(first.values) if larger else np.argmin(first.values))
        text = "Designs of which none is better in one objective without being worse in the other."
        yield curve_figure("front", "Front", text, lambda ax: plot_front(first, second, best, ax))


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
    save_pictures(design_figures(design), place / PLOTS, overwrite=True)
    return (*written, place / PLOTS)


def _labelled(aim: Objective, values: np.ndarray) -> Labelled:
    return Labelled(Quantity(aim.name, aim.unit, aim.label), values)
