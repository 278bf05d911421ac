"""HTML pages from the templates of this folder."""

from __future__ import annotations

import base64
from collections.abc import Iterable
from importlib import resources
from typing import Any

from ..core.text import printable
from ..plots.picture import Figure


def rendered(template: str, **values: Any) -> str:
    """Text of the page ``template`` (a file in the folder ``templates``) with ``values``, all of them escaped, control characters too."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(_source),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        finalize=lambda value: printable(value, keep="\n\t") if type(value) is str else value,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(**values)


def shown(figures: Iterable[Figure]) -> list[dict[str, str]]:
    """``figures`` for a template: title, caption, and the picture as base64."""
    return [
        {"title": f.title, "caption": f.caption, "picture": base64.b64encode(f.picture).decode("ascii")}
        for f in figures
    ]


def _source(name: str) -> str:
    return resources.files(__package__).joinpath("templates", name).read_text(encoding="utf-8")
