"""HTML pages from the templates of this folder."""

from __future__ import annotations

from importlib import resources
from typing import Any

# HTML pages from the templates of this folder.


def rendered(template: str, **values: Any) -> str:
    """Text of the page ``template`` (a file in the folder ``templates``) with ``values``, all of them escaped."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(_source),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(**values)


def _source(name: str) -> str:
    return resources.files(__package__).joinpath("templates", name).read_text(encoding="utf-8")


# Tables of text for the templates.
