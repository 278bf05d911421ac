"""Published and independently computed numbers in tests/reference, for the tests."""

from __future__ import annotations

import csv
from pathlib import Path

FOLDER = Path(__file__).parent / "reference"

Row = dict[str, float | str]


def reference(name: str) -> list[Row]:
    """Rows of tests/reference/<name>.csv by column name; cells that are numbers become floats."""
    lines = (FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if line.strip() and not line.startswith("#"))
    return [{column: _cell(text) for column, text in row.items()} for row in rows]


def _cell(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
