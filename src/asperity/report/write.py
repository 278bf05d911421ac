"""A self-contained HTML report of one contact."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..contact.result import ContactResult
from ..core.citations import REFERENCES
from ..core.errors import InputError
from ..core.status import Advice
from ..io.atomic import atomic_file
from ..io.provenance import provenance
from ..io.words import (
    Rows,
    body_rows,
    certificate_rows,
    headline_rows,
    result_rows,
    setting_rows,
    summary,
    surface_rows,
)
from ..parts.part import Part, Words
from ..parts.registry import versions
from ..plots.picture import Figure
from ..run.execute import Outcome, analysed
from .page import rendered, shown

TEMPLATE = "report.html"
"""Template in the folder ``templates``."""


def write_report(
    answer: ContactResult | Outcome,
    path: str | Path,
    *,
    advice: Sequence[Advice] = (),
    document: str | None = None,
    title: str = "",
    overwrite: bool = False,
) -> None:
    """Write a report of a contact to the HTML file ``path``; it needs no network and no other file.

    Parameters
    ----------
    answer
        A result, or the outcome of a document with all its parts; converged or not: if not, that stands first.
    path
        HTML file to write.
    advice
        Findings of the checks of resolution and regime, beside those of an outcome.
    document
        Text of the problem document that the answer came from.
    title
        Heading; made from the source of the surface if empty.
    overwrite
        Whether an existing file is replaced.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If ``advice`` holds anything but ``Advice``.
    """
    for item in advice:
        if not isinstance(item, Advice):
            raise InputError(f"advice of a report must hold Advice, but holds {type(item).__name__}.")
    outcome = answer if isinstance(answer, Outcome) else analysed(answer, {"plasticity": True})
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_text(_html(outcome, (*outcome.findings, *advice), document, title), encoding="utf-8")


def _html(outcome: Outcome, advice: Sequence[Advice], document: str | None, title: str) -> str:
    result = outcome.result
    keys = dict.fromkeys((*result.citation_keys, *outcome.citation_keys))
    return rendered(
        TEMPLATE,
        title=title or _title(result),
        status=outcome.status,
        result=result,
        summary=" ".join([summary(result), *(words.sentence for _, words in outcome.sections if words.alarming)]),
        headline=headline_rows(result),
        inputs=_inputs(result),
        certificate=certificate_rows(result),
        results=result_rows(result),
        figures=shown(outcome.pictures),
        sections=[_section(part, words, outcome.figures[part.name]) for part, words in outcome.sections],
        warnings=[item for item in advice if item.level == "warning"],
        notes=[item for item in advice if item.level != "warning"],
        provenance=_provenance_rows(
            json.loads(outcome.stored["provenance"]) if outcome.stored else provenance(result, versions())
        ),
        references=[(key, REFERENCES.get(key, "unknown reference")) for key in keys],
        document=document,
    )


def _section(part: Part, words: Words, figures: Sequence[Figure]) -> dict[str, Any]:
    """Words and figures of one part, for the template."""
    return {"name": part.name, "title": part.title, "words": words, "figures": shown(figures)}


def _title(result: ContactResult) -> str:
    source = result.problem.surface.origin.source
    return f"Contact report: {source}" if source else "Contact report"


def _inputs(result: ContactResult) -> list[tuple[str, Rows]]:
    problem = result.problem
    return [
        ("Surface", surface_rows(problem.surface)),
        ("Body", body_rows(problem.body)),
        ("Counter surface", surface_rows(problem.counter_surface)),
        ("Counter body", body_rows(problem.counter_body)),
        ("Boundary, law and load", setting_rows(result)),
    ]


def _provenance_rows(described: dict[str, Any]) -> Rows:
    surfaces = [key for key in ("surface", "counter_surface") if key in described]
    return [
        ("written (UTC)", described["created"]),
        *((name.replace("_", " "), text) for name, text in described["software"].items()),
        *((f"SHA-256 of the {key.replace('_', ' ')}", described[key]["digest"]) for key in surfaces),
    ]
