"""A self-contained HTML report of one contact."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..contact.path import LoadPath
from ..contact.plastic_load import PlasticLoad
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
from ..plots.contact import PATH_PLOTS, PLASTIC_PLOTS, PLOTS, render, render_path_plot
from .page import rendered
from .plasticity import energy_table, path_sentence, plastic_rows, turn_table
from .stress import StressPart, interface_table, maxima_table, remarks, strength_table, yield_sentence, yield_table
from .stress import setting_rows as stress_rows
from .wet import REMARK, THEORY_REMARK, WetPart, film_rows, theory_rows, wet_rows, wet_sentence

TEMPLATE = "report.html"
"""Template in the folder ``templates``."""


def write_report(
    result: ContactResult,
    path: str | Path,
    *,
    advice: Sequence[Advice] = (),
    document: str | None = None,
    title: str = "",
    stress: StressPart | None = None,
    load_path: LoadPath | None = None,
    wet: WetPart | None = None,
    plastic_load: PlasticLoad | None = None,
    overwrite: bool = False,
) -> None:
    """Write a report of ``result`` to the HTML file ``path``; it needs no network and no other file.

    Parameters
    ----------
    result
        The result, converged or not; if not, the report says so first.
    path
        HTML file to write.
    advice
        Findings of the checks of resolution and regime.
    document
        Text of the problem document that the result came from.
    title
        Heading; made from the source of the surface if empty.
    stress
        Stresses inside a body and their figures, as of ``asperity contact``.
    load_path
        The path whose last step is ``result``.
    wet
        Liquid film and menisci of a wet contact, whose contact is ``result``, and their figures.
    plastic_load
        The load at which the contact becomes plastic, if it was searched for.
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
    with atomic_file(path, overwrite=overwrite) as file:
        page = _Page(result, advice, document, title or _title(result), stress, load_path, wet, plastic_load)
        file.write_text(_html(page), encoding="utf-8")


@dataclass(frozen=True, eq=False)
class _Page:
    """What a report shows, see ``write_report``."""

    result: ContactResult
    advice: Sequence[Advice]
    document: str | None
    title: str
    stress: StressPart | None
    load_path: LoadPath | None
    wet: WetPart | None
    plastic_load: PlasticLoad | None


def _html(page: _Page) -> str:
    result, stress, load_path, wet = page.result, page.stress, page.load_path, page.wet
    warnings = [item for item in page.advice if item.level == "warning"]
    return rendered(
        TEMPLATE,
        title=page.title,
        status=result.status if wet is None else wet.result.status,
        result=result,
        summary=summary(result),
        headline=headline_rows(result),
        inputs=_inputs(result),
        certificate=certificate_rows(result),
        results=result_rows(result),
        figures=[_shown(plot.title, plot.caption, render(plot, result)) for plot in PLOTS],
        plastic=_plastic(result, page.plastic_load),
        path=None if load_path is None else _path(load_path),
        stress=None if stress is None else _stress(stress),
        wet=None if wet is None else _wet(wet),
        warnings=warnings,
        notes=[item for item in page.advice if item.level != "warning"],
        provenance=_provenance_rows(provenance(result)),
        references=[(key, REFERENCES.get(key, "unknown reference")) for key in _citation_keys(page)],
        document=page.document,
    )


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


def _shown(title: str, caption: str, picture: bytes) -> dict[str, str]:
    """A figure for the template: the picture as base64."""
    return {"title": title, "caption": caption, "picture": base64.b64encode(picture).decode("ascii")}


def _plastic(result: ContactResult, found: PlasticLoad | None) -> dict[str, Any] | None:
    """The part on plastic deformation for the template; None where nothing has yielded and no yield was searched for."""
    if found is None and not result.indented.any():
        return None
    figures = [
        _shown(plot.title, plot.caption, render(plot, result)) for plot in PLASTIC_PLOTS if result.indented.any()
    ]
    return {"rows": plastic_rows(result, found), "figures": figures}


def _path(path: LoadPath) -> dict[str, Any]:
    """The part on the load path for the template."""
    tables = [("Where the load turns", turn_table(path)), ("Energies from the start of the path", energy_table(path))]
    figures = [_shown(plot.title, plot.caption, render_path_plot(plot, path)) for plot in PATH_PLOTS]
    return {"summary": path_sentence(path), "tables": tables, "figures": figures}


def _stress(part: StressPart) -> dict[str, Any]:
    """The part on stresses for the template."""
    survey = part.survey
    tables = [
        ("Largest stresses of each layer", maxima_table(survey)),
        ("Interfaces", interface_table(survey)),
        ("Onset of yield", yield_table(survey)),
        ("Given strengths", strength_table(survey)),
    ]
    return {
        "summary": yield_sentence(survey),
        "settings": stress_rows(survey),
        "tables": [(heading, table) for heading, table in tables if table.cells],
        "remarks": remarks(survey),
        "figures": [_shown(figure.title, figure.caption, figure.picture) for figure in part.figures],
    }


def _wet(part: WetPart) -> dict[str, Any]:
    """The part on the liquid for the template."""
    return {
        "summary": wet_sentence(part.result),
        "film": film_rows(part.result),
        "results": wet_rows(part.result),
        "remark": REMARK,
        "theory": theory_rows(part.theory, part.result),
        "theory_remark": "" if isinstance(part.theory, str) else THEORY_REMARK,
        "figures": [_shown(figure.title, figure.caption, figure.picture) for figure in part.figures],
    }


def _citation_keys(page: _Page) -> tuple[str, ...]:
    stress = () if page.stress is None else page.stress.survey.citation_keys
    return tuple(dict.fromkeys((*page.result.citation_keys, *stress, *_wet_citations(page.wet))))


def _wet_citations(part: WetPart | None) -> tuple[str, ...]:
    if part is None:
        return ()
    return (*part.result.citation_keys, *(() if isinstance(part.theory, str) else part.theory.citation_keys))


def _provenance_rows(described: dict[str, Any]) -> Rows:
    surfaces = [key for key in ("surface", "counter_surface") if key in described]
    return [
        ("written (UTC)", described["created"]),
        *((name.replace("_", " "), text) for name, text in described["software"].items()),
        *((f"SHA-256 of the {key.replace('_', ' ')}", described[key]["digest"]) for key in surfaces),
    ]
