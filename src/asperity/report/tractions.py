"""A self-contained HTML report of the stresses under prescribed tractions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..io.description import software
from ..run.execute import Outcome
from ..run.tractions import TractionsDocument, traction_rows
from .page import shown, software_rows, write_page
from .scene import scene


def write_tractions_report(
    outcome: Outcome, path: str | Path, *, document: TractionsDocument, text: str, overwrite: bool = False
) -> None:
    """Write a report of the stresses under prescribed tractions, the ``outcome`` of a ``document``
    with this ``text``, to ``path``.

    Raises OutputError if the file exists and ``overwrite`` is false, or cannot be written.
    """
    loaded: Any = outcome.result
    sections = [*outcome.sections]
    write_page(
        path,
        "tractions.html",
        title=document.title or "Stresses under prescribed tractions",
        summary=" ".join(words.sentence for _, words in sections),
        inputs=traction_rows(loaded, document),
        scene=scene((figure for group in outcome.figures.values() for figure in group), loaded.problem.grid),
        sections=[(p.name, p.title, "", words, shown(outcome.figures[p.name])) for p, words in sections],
        provenance=software_rows(software()),
        citation_keys=outcome.citation_keys,
        document=text,
        document_of="Problem",
        overwrite=overwrite,
    )
