"""Self-contained HTML pages from the templates of this folder: no network and no other file is needed to read one."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape

from ..core.citations import REFERENCES
from ..core.text import printable
from ..io.atomic import atomic_file
from ..io.words import Rows
from ..plots.picture import Figure

WHOLE = re.compile(r"(?<![\w-])--\w[\w-]*|\d[\d.]*e-\d+")
"""Names of options, and numbers with exponents: no line of a page is broken at their hyphens."""


def write_page(
    path: str | Path,
    template: str,
    *,
    citation_keys: Iterable[str],
    figures: Iterable[Figure] = (),
    overwrite: bool = False,
    **values: Any,
) -> None:
    """Write the page ``template`` (a file in the folder ``templates``) with ``values``, all of them escaped, to the HTML file ``path``.

    Those of every page are ``title`` and ``summary``, those of most ``provenance`` (rows) and ``document`` (its text).

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as file:
        page = rendered(
            template,
            references=[(key, REFERENCES.get(key, "unknown reference")) for key in citation_keys],
            figures=shown(figures),
            **{"provenance": None, "document": None, **values},
        )
        file.write_text(page, encoding="utf-8")


def rendered(template: str, **values: Any) -> str:
    """Text of the page ``template`` with ``values``, all of them escaped, control characters too."""
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
    return environment.get_template(template).render(**values)


def prose(text: object) -> Markup:
    """``text`` as HTML whose lines are broken after underscores too, but not within options and numbers."""

    def kept(found: re.Match[str]) -> str:
        return f'<span class="whole">{found[0]}</span>'

    return Markup(WHOLE.sub(kept, str(escape(printable(str(text), keep="\n\t")))).replace("_", "_<wbr>"))


def shown(figures: Iterable[Figure]) -> list[dict[str, Any]]:
    """``figures`` for a template, the pictures as base64."""
    return [{**vars(f), "picture": base64.b64encode(f.picture).decode("ascii")} for f in figures]


def software_rows(software: Mapping[str, str], **digests: str) -> Rows:
    """Names and versions of the ``software`` behind a page, and SHA-256 ``digests`` of what it is about."""
    rows = [(name.replace("_", " "), text) for name, text in software.items()]
    return [*rows, *((f"SHA-256 of the {name.replace('_', ' ')}", text) for name, text in digests.items())]


def _source(name: str) -> str:
    return resources.files(__package__).joinpath("templates", name).read_text(encoding="utf-8")
