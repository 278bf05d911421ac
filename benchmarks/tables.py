"""Tables of the benchmarks, kept in ``results`` and shown in README.md between two markers.

Every script prints its tables; with ``--write`` it also stores each as ``results/NAME.json`` with
date, machine and command, and puts it in the place of the one before in README.md. Files are
replaced whole and only at the end of a script, so that a run that is broken off changes nothing.

Usage: python benchmarks/tables.py writes README.md again from all that is stored; with --check it
ends with an error if that would change it.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
import re
import sys
import tempfile
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent
PAGE, RESULTS = FOLDER / "README.md", FOLDER / "results"
_LOAD_AT_START = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")


@dataclass(frozen=True)
class Table:
    """A table as it is shown, and where it comes from; cells are text."""

    name: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    date: str
    machine: str
    command: str

    def markdown(self) -> str:
        """Source and cells in Markdown; columns without a single cell are left out."""
        kept = [place for place in range(len(self.columns)) if any(row[place] for row in self.rows)]
        lines = [[cells[place] for place in kept] for cells in (self.columns, *self.rows)]
        head = [*_source(self), "", _line(lines[0]), "|---" * len(kept) + "|"]
        return "\n".join([*head, *map(_line, lines[1:])])

    def column(self, name: str, **chosen: str) -> list[float]:
        """Numbers of column ``name``, of the rows whose cells in other columns are those
        ``chosen``; nan where it is empty."""
        places = {list(self.columns).index(key): text for key, text in chosen.items()}
        rows = [row for row in self.rows if all(row[place] == text for place, text in places.items())]
        own = list(self.columns).index(name)
        return [float(row[own]) if row[own] else float("nan") for row in rows]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _source(table: Table) -> list[str]:
    """Date and machine in lines of at most 100 columns, then the command."""
    return [*textwrap.wrap(f"*{table.date}; {table.machine}*", 100), f"`{table.command}`"]


def machine() -> str:
    """Processor, cores, load by other work when the script began, and versions; nothing that names
    the computer."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    names = [f"Python {platform.python_version()}"]
    for package in ("numpy", "numba", "ducc0", "asperity"):
        try:
            names.append(f"{package} {version(package)}")
        except ModuleNotFoundError:  # ducc0 is optional
            continue
    return f"{platform.machine()}, {cores} cores, load {_LOAD_AT_START:.1f} before, {', '.join(names)}"


def add_option(parser: argparse.ArgumentParser) -> None:
    """The option ``--write`` of every script."""
    parser.add_argument("--write", action="store_true", help="store the tables, and put them into benchmarks/README.md")


def made(name: str, columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> Table:
    """Table ``name`` of this run of a script; cells become text, None an empty one."""
    cells = [["" if cell is None else str(cell) for cell in row] for row in rows]
    words = [word for word in sys.argv[1:] if word != "--write"]
    command = " ".join(["python", f"benchmarks/{Path(sys.argv[0]).name}", *words])
    today = datetime.datetime.now(datetime.UTC).date().isoformat()
    return Table(name, list(columns), cells, today, machine(), command)


def show(*tables: Table, write: bool) -> None:
    """Print ``tables`` and, if ``write``, store them and put them into README.md."""
    for table in tables:
        print(f"\n{table.markdown()}", flush=True)
    if write:
        for table in tables:
            store(table)
        refresh()


def store(table: Table) -> None:
    """Write ``table`` to ``results``."""
    RESULTS.mkdir(exist_ok=True)
    replace(RESULTS / f"{table.name}.json", json.dumps(asdict(table), indent=1, ensure_ascii=False) + "\n")


def stored(name: str) -> Table:
    """The table ``name`` of ``results``."""
    return Table(**json.loads((RESULTS / f"{name}.json").read_text(encoding="utf-8")))


def refresh() -> None:
    """Put all stored tables into README.md."""
    replace(PAGE, filled(PAGE.read_text(encoding="utf-8")))


def filled(page: str) -> str:
    """``page`` with the stored table between ``<!-- table NAME -->`` and ``<!-- end -->``, for all
    names.

    Raises ValueError if a stored table has no place in it.
    """
    names = {path.stem for path in RESULTS.glob("*.json")}
    parts = re.split(r"(<!-- table ([\w-]+) -->\n)(.*?)(?=<!-- end -->)", page, flags=re.DOTALL)
    if missing := names - set(parts[2::4]):
        raise ValueError(f"benchmarks/README.md has no markers for the stored tables {', '.join(sorted(missing))}.")
    found = [parts[0]]
    for head, name, content, rest in zip(*(iter(parts[1:]),) * 4, strict=True):
        found += [head, f"{stored(name).markdown()}\n" if name in names else content, rest]
    return "".join(found)


def replace(path: Path, text: str) -> None:
    """Write ``text`` to ``path`` in one go: whoever reads sees the old file or the new one."""
    with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
        file.write(text)
    Path(file.name).chmod(0o644)
    Path(file.name).replace(path)


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        sys.exit(filled(PAGE.read_text(encoding="utf-8")) != PAGE.read_text(encoding="utf-8"))
    refresh()
