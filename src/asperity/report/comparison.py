"""A self-contained HTML page on a comparison of theories with the numerical solution."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path

from ..core.citations import REFERENCES
from ..io.atomic import atomic_file
from ..io.provenance import software, surface_provenance
from ..io.words import surface_rows
from ..plots.comparison import comparison_figures
from ..plots.figure import Figure
from ..studies.comparison import Comparison
from .comparison_tables import comparison_sentence, left_out_rows, limit_rows, setup_rows, slope_table
from .page import rendered

TEMPLATE = "comparison.html"
"""Template in the folder ``templates``."""


def write_comparison_report(
    comparison: Comparison,
    path: str | Path,
    *,
    title: str = "",
    figures: Sequence[Figure] | None = None,
    overwrite: bool = False,
) -> None:
    """Write a page on ``comparison`` to the HTML file ``path``; it needs no network and no other file.

    Parameters
    ----------
    comparison
        As of ``compare``.
    path
        HTML file to write.
    title
        Heading; made from the source of the surface if empty.
    figures
        Its figures where they have been drawn already.
    overwrite
        Whether an existing file is replaced.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_text(_html(comparison, title or _title(comparison), figures), encoding="utf-8")


def _html(comparison: Comparison, title: str, figures: Sequence[Figure] | None) -> str:
    drawn = comparison_figures(comparison.dataset) if figures is None else figures
    return rendered(
        TEMPLATE,
        title=title,
        summary=comparison_sentence(comparison),
        findings=comparison.findings,
        remarks=comparison.remarks,
        table=slope_table(comparison),
        setup=setup_rows(comparison),
        surface=surface_rows(comparison.surface),
        limits=limit_rows(comparison),
        left_out=left_out_rows(comparison),
        figures=[
            {"title": f.title, "caption": f.caption, "picture": base64.b64encode(f.picture).decode("ascii")}
            for f in drawn
        ],
        provenance=[
            *((name.replace("_", " "), text) for name, text in software().items()),
            ("SHA-256 of the heights", surface_provenance(comparison.surface)["digest"]),
        ],
        references=[(key, REFERENCES.get(key, "unknown reference")) for key in comparison.citation_keys],
    )


def _title(comparison: Comparison) -> str:
    source = comparison.surface.origin.source
    return f"Theories beside the numerical solution: {source}" if source else "Theories beside the numerical solution"
