"""Published and independently computed numbers in tests/reference, for the tests."""

from __future__ import annotations

import csv
import inspect
from collections.abc import Callable, Iterable
from functools import wraps
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


def every_row(
    rows: Iterable[Row], label: Callable[[Row], str] = str
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Decorator: a test of one ``row`` becomes one test of all ``rows``, which lists those that
    fail by their ``label``.

    A thousand rows of a table are one law, and take less time than a thousand tests.
    """
    table = list(rows)

    def folded(test: Callable[..., None]) -> Callable[..., None]:
        @wraps(test)
        def all_rows(**fixtures: object) -> None:
            wrong = []
            for row in table:
                try:
                    test(row=row, **fixtures)
                except Exception as error:
                    wrong.append(f"{label(row)}: {type(error).__name__} {error}")
            assert table, "there are no rows"
            assert not wrong, f"{len(wrong)} of {len(table)} rows fail\n" + "\n".join(wrong[:20])

        signature = inspect.signature(test)
        left = [parameter for name, parameter in signature.parameters.items() if name != "row"]
        all_rows.__signature__ = signature.replace(parameters=left)  # type: ignore[attr-defined]
        return all_rows

    return folded
