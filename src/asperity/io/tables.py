"""Tables as text separated by commas, which spreadsheets open: what begins like a formula is
written as text."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from .atomic import atomic_file

_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""First characters of a cell that spreadsheets compute, or skip to find one that they compute."""


def cell(value: Any) -> Any:
    """``value``, with an apostrophe before it if it is text that a spreadsheet would compute;
    numbers, also written ones, stay numbers."""
    if not isinstance(value, str) or not value.startswith(_FORMULA):
        return value
    try:
        float(value)
    except ValueError:
        return f"'{value}"
    return value


def table_text(rows: Iterable[Iterable[Any]]) -> str:
    """``rows`` as text, a line each."""
    text = io.StringIO(newline="")
    csv.writer(text).writerows([cell(value) for value in row] for row in rows)
    return text.getvalue()


def write_table(rows: Iterable[Iterable[Any]], path: str | Path, *, overwrite: bool = False) -> None:
    """Write ``rows`` to ``path``, whole or not at all.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([cell(value) for value in row] for row in rows)
