"""The folder that a run leaves: document, result file, scalars, report and pictures, the same from
every shell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..io.export import export_csv
from ..io.tables import write_table
from ..parts.part import Part
from ..plots.together import drawing, save_pictures
from ..run.document import ProblemDocument, dumps, save_document
from ..run.execute import Outcome
from ..run.stored import save_outcome
from .write import write_report

NAMES = ("report.html", "result.nc", "scalars.csv", "plots", "problem.toml")
"""What every run leaves in its folder."""

PATH, STRESSES = "path.csv", "stress.csv"
"""Scalars and energies of the steps of a load path, and the table of the largest stresses."""

ALL_NAMES = (*NAMES, PATH, STRESSES)
"""What a run may leave in its folder."""


def names_in_folder(outcome: Outcome) -> tuple[str, ...]:
    """Names of what ``write_run`` writes for ``outcome``."""
    stressed = (STRESSES,) if "stress" in outcome.found else ()
    return (*NAMES, *stressed, *(name for name, _ in sheets(outcome)), *((PATH,) if outcome.path else ()))


def sheets(outcome: Outcome) -> Iterator[tuple[str, Iterator[tuple[Any, ...]]]]:
    """Name and rows, the headings first, of each table that parts leave for other programs."""
    for part in outcome.parts:
        name, axis = part.sheet
        if name and part.name in outcome.found:
            yield name, _rows(list(_columns(part, outcome.found[part.name].values, axis)))


def _columns(part: Part, values: Mapping[str, Any], axis: str) -> Iterator[tuple[str, Any]]:
    """Heading and numbers of each column along the ``axis``; an array of two axes has one for each
    name along the second."""
    for item in part.quantities:
        if item.dims[:1] != (axis,) or item.name not in values:
            continue
        if len(item.dims) == 1:
            yield f"{item.name} ({item.unit})", values[item.name]
        elif item.dims[1] in values:
            along = np.asarray(values[item.name]).T
            for text, column in zip(np.atleast_1d(values[item.dims[1]]), along, strict=True):
                yield f"{item.name} of {text} ({item.unit})", column


def _rows(columns: list[tuple[str, Any]]) -> Iterator[tuple[Any, ...]]:
    yield tuple(heading for heading, _ in columns)
    yield from zip(*(np.atleast_1d(column).tolist() for _, column in columns), strict=True)


def write_run(outcome: Outcome, folder: Path, document: ProblemDocument) -> None:
    """Write everything that a run leaves into ``folder``; paths in ``document`` start there."""
    export_csv(outcome.result, folder / "scalars.csv", scalars=outcome.scalars)
    if outcome.path is not None:
        export_csv(outcome.path, folder / PATH)
    write_parts(outcome, folder, document)


def write_parts(outcome: Outcome, folder: Path, document: ProblemDocument | None) -> None:
    """Write document, result file, report and pictures of ``outcome`` into ``folder``."""
    text, title = (None, "") if document is None else (dumps(document), document.title)
    if document is not None:
        save_document(document, folder / "problem.toml")
    figures, threads = outcome.all_figures, outcome.solved.threads
    with drawing(figures, threads):
        save_outcome(outcome, folder / "result.nc", document=text, title=title)
    save_pictures(figures, folder / "plots")
    write_report(outcome, folder / "report.html", document=text, title=title)
    if "stress" in outcome.found:
        export_csv(outcome.found["stress"].detail, folder / STRESSES)
    for name, rows in sheets(outcome):
        write_table(rows, folder / name)
