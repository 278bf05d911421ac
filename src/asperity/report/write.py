"""A self-contained HTML report of one contact."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..contact.result import ContactResult
from ..core.errors import InputError
from ..core.status import Advice
from ..io.description import provenance
from ..io.words import (
    Rows,
    body_rows,
    certificate_rows,
    result_rows,
    setting_rows,
    surface_rows,
)
from ..parts.part import Part
from ..parts.registry import versions
from ..plots.together import drawing
from ..run.execute import Outcome, analysed
from ..run.verdict import doubted, verdict
from .page import shown, software_rows, step_text, write_page
from .scene import scene_of


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
        A result, or the outcome of a document with all its parts; converged or not: if not, that
        stands first.
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
    reached, given = outcome.solved.at(), verdict(outcome)
    result, told = reached.result, tuple(dict.fromkeys((*given.findings, *advice)))
    given = replace(given, findings=told, doubted=doubted(told, result))
    source = result.problem.surface.origin.source
    stored = json.loads(outcome.stored["provenance"]) if outcome.stored else provenance(result, versions())
    surfaces = [key for key in ("surface", "counter_surface") if key in stored]
    problem = result.problem
    inputs: list[tuple[str, Rows]] = [
        ("Surface", surface_rows(problem.surface)),
        ("Body", body_rows(problem.body)),
        ("Counter surface", surface_rows(problem.counter_surface)),
        ("Counter body", body_rows(problem.counter_body)),
        ("Boundary, law and load", setting_rows(result)),
    ]
    with drawing(outcome.all_figures, outcome.solved.threads):  # meanwhile other processes draw the figures
        maps = scene_of(outcome)
    write_page(
        path,
        "report.html",
        title=title or (f"Contact report: {source}" if source else "Contact report"),
        status=outcome.status,
        summary=given.what,
        verdict=given,
        at=reached.where,
        headline=given.headline,
        inputs=inputs,
        certificate=certificate_rows(result),
        results=result_rows(result, given.doubted),
        figures=shown(outcome.pictures, outcome.solved),
        scene=maps,
        sections=[
            (p.name, p.title, where(outcome, p), words, shown(outcome.figures[p.name], outcome.solved))
            for p, words in outcome.sections
        ],
        advice=given.others,
        provenance=[
            ("written (UTC)", stored["created"]),
            *software_rows(stored["software"], **{key: stored[key]["digest"] for key in surfaces}),
        ],
        citation_keys=outcome.citation_keys,
        document=document,
        document_of="Problem",
        overwrite=overwrite,
    )


def where(outcome: Outcome, part: Part) -> str:
    """Step of the load path of an ``outcome`` that what a ``part`` says is about, in words; empty
    where it is about all of it."""
    return step_text(outcome.solved, part.at_work.step(outcome.found[part.name], outcome.solved))
