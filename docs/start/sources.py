"""Writes ``sources.md``, what the sources describe and where it is in the package, from
``sources.csv``, and the sentence of ``features.md`` that counts it.

``python docs/start/sources.py`` takes a second. To change the page, change the table: a row for
each thing that a source describes. ``tests/docs/test_sources.py`` holds it against the code.
"""

from __future__ import annotations

import csv
import os
from collections import Counter
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
TABLE, PAGE, FEATURES = HERE / "sources.csv", HERE / "sources.md", HERE / "features.md"

STATUSES = ("there", "partly", "not yet", "left out")
"""There; with something missing, which the note says; missing; missing on purpose, the note says
why."""

SOURCES = {
    "Peng (2001)": "W. Peng, dissertation on the contact of layered rough surfaces, dry and wet (Ohio State).",
    "Yastrebov (2016)": "V. A. Yastrebov, lectures 2 and 3 of a course on computational contact mechanics.",
    "Bhushan (1998)": "B. Bhushan, review of the contact of rough surfaces, Tribology Letters 4, 1-35.",
    "Gold-film chapter": "A review chapter that compares models of rough contact on a sputtered gold film.",
}
"""What the table takes its rows from."""

LEAD = "**From the sources.** "
"""How the sentence of ``features.md`` begins."""

HEAD = """# What the sources describe, and where it is here

Every thing that four sources of this package describe, in their order: where it is used, the tests
that hold it, and the page that explains it or compares it with what was published. A door is a name
of Python, a command with its options, a theory of the catalogue, a key of a document, or an example;
tests are below `tests`. Made by `python docs/start/sources.py` from the table `sources.csv` beside it,
which a test holds against the code.
"""


class Row(NamedTuple):
    """One thing that a source describes; paths are those of the repository."""

    source: str
    place: str
    item: str
    status: str
    doors: tuple[str, ...]
    tests: tuple[str, ...]
    pages: tuple[str, ...]
    note: str


def rows() -> list[Row]:
    """Every row of the table."""

    def several(cell: str) -> tuple[str, ...]:
        return tuple(part.strip() for part in cell.split(";") if part.strip())

    with TABLE.open(encoding="utf-8", newline="") as file:
        return [
            Row(
                one["source"],
                one["place"],
                one["item"],
                one["status"],
                several(one["doors"]),
                several(one["tests"]),
                several(one["pages"]),
                one["note"],
            )
            for one in csv.DictReader(file)
        ]


def page(found: list[Row]) -> str:
    """Text of ``sources.md``."""
    parts = [HEAD, counts(found)]
    for status, name in (("not yet", "Not there yet"), ("left out", "Left out on purpose")):
        parts.append("\n".join([f"## {name}\n", *(missing(row) for row in found if row.status == status)]) + "\n")
    for source, what in SOURCES.items():
        head = [
            f"## {source}\n",
            f"{what}\n",
            "| place | what | status | doors | tests | page |",
            "|---|---|---|---|---|---|",
        ]
        parts.append("\n".join([*head, *(line(row) for row in found if row.source == source)]) + "\n")
    return "\n".join(parts)


def counts(found: list[Row]) -> str:
    """Table of how many rows of each source have which status."""
    lines = ["| source | all | " + " | ".join(STATUSES) + " |", "|---|" + "---|" * (1 + len(STATUSES))]
    for source in SOURCES:
        number = Counter(row.status for row in found if row.source == source)
        lines.append(
            " | ".join([f"| {source}", str(number.total()), *(str(number[status]) for status in STATUSES)]) + " |"
        )
    number = Counter(row.status for row in found)
    lines.append(" | ".join(["| **all**", str(number.total()), *(str(number[status]) for status in STATUSES)]) + " |")
    return "\n".join(lines) + "\n"


def missing(row: Row) -> str:
    """Line of a list for one row that is not there."""
    return f"* {row.source}, {row.place}: **{plain(row.item)}**. {row.note[0].upper()}{plain(row.note[1:])}."


def line(row: Row) -> str:
    """Line of a table for one row."""
    status = f"{row.status}: {plain(row.note)}" if row.note else row.status
    doors = ", ".join(f"`{door}`" for door in row.doors)
    tests = ", ".join(f"`{test.removeprefix('tests/')}`" for test in row.tests)
    pages = ", ".join(f"[{title(aim)}]({os.path.relpath(ROOT / aim, HERE)})" for aim in row.pages)
    return f"| {row.place} | {plain(row.item)} | {status} | {doors} | {tests} | {pages} |"


def title(aim: str) -> str:
    """Title of a page of the repository."""
    return (ROOT / aim).read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")


def plain(text: str) -> str:
    """``text`` with its asterisks shown as they are."""
    return text.replace("*", r"\*")


def sentence(found: list[Row]) -> str:
    """Line of ``features.md`` that counts the rows."""
    number = Counter(row.status for row in found)
    return (
        f"{LEAD}Of {number.total()} things that four sources of this package describe, {number['there']} are there, "
        f"{number['partly']} with something missing, {number['not yet']} not yet, and {number['left out']} are left "
        "out on purpose: [each with its door, its test and its page](sources.md)."
    )


def features(text: str, found: list[Row]) -> str:
    """Text of ``features.md`` with its sentence anew."""
    return "\n".join(sentence(found) if one.startswith(LEAD) else one for one in text.split("\n"))


if __name__ == "__main__":
    known = rows()
    PAGE.write_text(page(known), encoding="utf-8")
    FEATURES.write_text(features(FEATURES.read_text(encoding="utf-8"), known), encoding="utf-8")
