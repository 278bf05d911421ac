"""Tables of text for the templates."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Table:
    """Headings and cells of a table of text."""

    headings: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
