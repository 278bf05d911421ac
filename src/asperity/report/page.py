"""Self-contained HTML pages from the templates of this folder: no network and no other file is
needed to read one."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape

from ..core.citations import REFERENCES
from ..core.words import printable
from ..io.atomic import atomic_file
from ..io.words import Rows
from ..parts.part import Solved
from ..plots.picture import Figure
from ..plots.together import draw_all
from .scene import as_json, curves_of

WHOLE = re.compile(r"(?<![\w-])--\w[\w-]*|\d[\d.]*e-\d+")
"""Names of options, and numbers with exponents: no line of a page is broken at their hyphens."""


HEADING = re.compile(r'<h2 id="([^"]+)">(.*?)</h2>')
"""Heading of a section, with what it is called elsewhere in the page."""

CONTENTS = "<!-- contents -->"
"""Stands in a template for the list of contents."""

POLICY = "default-src 'none'"
"""Stands in a template for the policy of the page."""


def write_page(
    path: str | Path,
    template: str,
    *,
    citation_keys: Iterable[str],
    overwrite: bool = False,
    **values: Any,
) -> None:
    """Write the page ``template`` (a file in the folder ``templates``) with ``values``, all of them
    escaped, to the HTML file ``path``.

    Those of every page are ``title`` and ``summary``, those of most ``provenance`` (rows),
    ``document`` (its text), ``figures`` (see ``shown``) and ``scene`` (what its viewer shows, see
    ``scene.scene``).

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    code = script()
    with atomic_file(path, overwrite=overwrite) as file:
        page = rendered(
            template,
            references=[(key, REFERENCES.get(key, "unknown reference")) for key in citation_keys],
            script=Markup(code),
            policy=POLICY,
            **{"provenance": None, "document": None, "figures": [], "scene": None, **values},
        )
        page = page.replace(CONTENTS, _contents(page), 1)
        # nothing is allowed but embedded pictures, the page's own style sheet and this script
        sheet = page[page.index("<style>") + 7 : page.index("</style>")]
        digests = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in (code, sheet)]
        allowed = f"img-src data:; script-src 'sha256-{digests[0]}'; style-src 'sha256-{digests[1]}'"
        policy = f"default-src 'none'; {allowed}; base-uri 'none'; form-action 'none'"
        file.write_text(page.replace(POLICY, policy, 1), encoding="utf-8")


def rendered(template: str, **values: Any) -> str:
    """Text of the page ``template`` with ``values``, all of them escaped, control characters
    too."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(_source),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        finalize=lambda value: printable(value, keep="\n\t") if type(value) is str else value,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["prose"] = prose
    environment.filters["json"] = lambda value: Markup(as_json(value))
    return environment.get_template(template).render(**values)


def prose(text: object) -> Markup:
    """``text`` as HTML whose lines are broken after underscores too, but not within options and
    numbers."""

    def kept(found: re.Match[str]) -> str:
        return f'<span class="whole">{found[0]}</span>'

    return Markup(WHOLE.sub(kept, str(escape(printable(str(text), keep="\n\t")))).replace("_", "_<wbr>"))


def shown(figures: Iterable[Figure], solved: Solved | None = None) -> list[dict[str, Any]]:
    """``figures`` for a template: the pictures as base64, the points of their curves as JSON, and
    the step of the load path of a ``solved`` contact that each is of, in words."""
    figures = tuple(figures)
    draw_all(figures)
    return [
        {
            **{key: getattr(figure, key) for key in ("name", "title", "caption")},
            "at": step_text(solved, None if solved is None else solved.step_of(figure.of)),
            "again": figure.kind == "cut" and figure.shows is None,  # a part of a section, enlarged
            "wide": figure.wide or figure.drawing.enlarged,
            "explored": figure.kind == "cut" or (figure.kind == "map" and figure.shows is not None),
            "picture": base64.b64encode(figure.picture).decode("ascii"),
            "curves": curves_of(figure.drawing.curves),
        }
        for figure in figures
    ]


def step_text(solved: Solved | None, number: int | None) -> str:
    """Step ``number`` of the load path of a ``solved`` contact in words; empty for none."""
    return "" if solved is None or number is None else solved.at(number).where


def _contents(page: str) -> str:
    """List of the sections of ``page`` with links to them."""
    found = ((name, re.sub(r' <span class="at">.*?</span>', "", text)) for name, text in HEADING.findall(page))
    links = "\n".join(f'<li><a href="#{name}">{text}</a></li>' for name, text in found)
    return f'<nav class="contents" aria-label="Contents">\n<ul>\n{links}\n</ul>\n</nav>'


def script() -> str:
    """The viewer of maps and curves: JavaScript that needs no other file."""
    return _source("viewer.js")


def style() -> str:
    """The style sheet of the viewer."""
    return _source("viewer.css")


def software_rows(software: Mapping[str, str], **digests: str) -> Rows:
    """Names and versions of the ``software`` behind a page, and SHA-256 ``digests`` of what it is
    about."""
    rows = [(name.replace("_", " "), text) for name, text in software.items()]
    return [*rows, *((f"SHA-256 of the {name.replace('_', ' ')}", text) for name, text in digests.items())]


def _source(name: str) -> str:
    return resources.files(__package__).joinpath("templates", name).read_text(encoding="utf-8")
