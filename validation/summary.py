"""Writes README.md of this folder: the pages, the sources, and all published numbers beside ours
with deviation and verdict.

The numbers are those of the table of published numbers of each page, else those of its columns
called "theirs" with the column of ours beside. Numbers that share a surface or a statement count
once, with the worst of their verdicts; numbers that rest on a value chosen or put in here are no
test and are counted apart. Pages whose reference is an independent solution of our own say so and
are not read.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from page import AGREES, APART, BETWEEN, DIFFERS, NEAR, PUBLISHED_HEAD, PUBLISHED_TITLE, SCATTER, verdict_of

FOLDER = Path(__file__).parent
TABLES = {
    "peng_load": ("Peng 2001, table 3.1", "table 3.1, one surface"),
    "peng_table_3_1": ("Peng 2001, table 3.1", "table 3.1, one surface"),
}
"""Source and what their numbers share, of pages whose tables say neither."""

REPEATED = ("peng_load",)
"""Pages whose numbers stand on another page, too."""

ORDER = (AGREES, SCATTER, BETWEEN, DIFFERS)
"""Verdicts from the best to the worst."""

HEAD = """# Comparison with published results

Made by `python validation/summary.py`, the last step of `make validate`. One script for each published result
writes a page of the same name:

```sh
python validation/sphere_on_layer.py     # writes validation/sphere_on_layer.md
make validate                            # all pages (an hour of one core), this page, pictures
```

Each page states what was computed, the source of the published values ("theirs"), whether a parameter was
chosen freely, and the deviations found and allowed. Where the reference is an independent solution of our
own, the page says "independent solution". `tests/validation` runs every script on a smaller grid and checks
the bounds.
"""

TAIL = """`python validation/gold_film_area.py 1000 FOLDER` and `python validation/gold_film_grid.py 4096
FOLDER` write their pages from the whole studies, `python validation/layered_sliding.py FOLDER` its own, and
keep the results in the folder; stored results are not computed again. `python validation/pictures.py FOLDER`
draws rough cylinder, rough sphere, scaling laws, layers and stresses as in chapter 3 of Peng (2001), the
layered solid of its fig. 2.8 under a sliding sphere, the motions of the sliding block, and gaps that close with
their leak rates. `python
validation/gallery.py FOLDER` characterises every surface file of a folder and writes a gallery of pages; its
output is not part of the repository.

To add a page: a script with a function `compare` that returns a `Comparison` of numbers (see
`side_by_side.py`) or a `Page` of tables and claims (see `page.py`), its page, and a test; the first sentence
of its docstring stands here. Its published numbers are `Published`, with the source (`after` the work that they
come from), what they rest on where something was chosen or put in, and what they share with others.
"""


@dataclass(frozen=True)
class Number:
    """A published number beside ours, as the page shows both; ``verdict`` and ``deviation`` are
    those of the page where it has them."""

    page: str
    source: str
    case: str
    theirs: str
    ours: str
    said: str = ""
    apart: str = ""
    rests_on: str = ""
    shared: str = ""

    @property
    def deviation(self) -> str:
        """Ours over theirs, less one, in per cent; the difference where theirs is zero."""
        theirs, ours = _first(self.theirs), _first(self.ours)
        return self.apart or f"{100.0 * (ours / theirs - 1.0 if theirs else ours):+.1f} %"

    @property
    def verdict(self) -> str:
        """In words; a scatter that the page states goes first."""
        scatter = re.search(r"± *([-+.\de]+)", self.ours)
        return self.said or verdict_of(
            _digits(self.theirs), _first(self.ours), float(scatter[1]) if scatter is not None else 0.0
        )

    @property
    def agrees(self) -> bool:
        """Whether within the scatter, the rounding or 5 %."""
        return self.verdict in (SCATTER, AGREES)

    @property
    def work(self) -> str:
        """The work that it comes from: after "after" at the end of the source, else up to its year,
        or where it has none to its first comma."""
        if ", after " in self.source:
            return self.source.rpartition(", after ")[2]
        dated = re.match(r".*?\b\d{4}\b", self.source)
        return dated[0] if dated else self.source.partition(",")[0]


@dataclass(frozen=True)
class Tally:
    """Numbers that count once each, ``rest`` of which rest on values chosen or put in here; the
    others by verdict."""

    counted: int
    agree: int
    near: int
    differ: int
    rest: int

    @classmethod
    def of(cls, numbers: Iterable[Number]) -> Tally:
        """Of ``numbers``, those that share something as one with the worst verdict."""
        groups: dict[object, list[Number]] = {}
        for place, number in enumerate(numbers):
            groups.setdefault(number.shared or place, []).append(number)
        tested = [found for found in ([one for one in of if not one.rests_on] for of in groups.values()) if found]
        worst = [max((one.verdict for one in found), key=ORDER.index) for found in tested]
        near, differ = worst.count(BETWEEN), worst.count(DIFFERS)
        return cls(len(groups), len(worst) - near - differ, near, differ, len(groups) - len(tested))

    @property
    def whole(self) -> bool:
        """Whether something was tested and all of it agrees."""
        return self.agree > 0 and self.near == self.differ == 0


def _digits(text: str) -> str:
    """First number of a text, as it is written."""
    found = re.search(r"[-+]?\d*\.?\d+(?:e[-+]?\d+)?", text.replace("−", "-"))
    assert found is not None, text
    return found[0]


def _first(text: str) -> float:
    """First number of a text."""
    return float(_digits(text))


def numbers(name: str, text: str) -> list[Number]:
    """The published numbers of the page ``name``."""
    _, given, rest = text.partition(PUBLISHED_TITLE)
    if given:
        return [number for head, rows in _tables(rest.partition("\n## ")[0]) for number in _published(name, head, rows)]
    return [number for head, rows in _tables(text) for number in _pairs(name, head, rows)]


def _published(name: str, head: list[str], rows: Iterable[list[str]]) -> Iterator[Number]:
    """Rows of a table of published numbers."""
    if tuple(head[: len(PUBLISHED_HEAD)]) != PUBLISHED_HEAD:
        return
    for row in rows:
        cells = dict(zip(head, row, strict=True))
        yield Number(
            name,
            *(cells[key] for key in ("source", "number", "theirs", "ours")),
            said=next(word for word in ORDER if cells["verdict"].startswith(word)),
            apart=cells["deviation"],
            rests_on=cells.get("rests on", ""),
            shared=cells.get("counts once with", ""),
        )


def _tables(text: str) -> Iterator[tuple[list[str], list[list[str]]]]:
    """Head and rows of every table."""
    for block in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        head, _, *rows = ([cell.strip() for cell in line.strip().strip("|").split("|")] for line in block.splitlines())
        yield head, rows


def _pairs(name: str, head: list[str], rows: Iterable[list[str]]) -> Iterator[Number]:
    """Every cell of a column "theirs" with the cell of ours beside it."""
    given = [at for at, word in enumerate(head) if "theirs" in word and "over" not in word]
    first = next((at for at, word in enumerate(head) if "ours" in word or "theirs" in word), 0)
    for row in rows:
        for at in given:
            beside = _beside(head, at)
            if (
                beside is None
                or len(row) != len(head)
                or not re.search(r"\d", row[at])
                or not re.search(r"\d", row[beside])
            ):
                continue
            what = next((head[column] for column in (at, beside) if ":" in head[column]), "")
            what = re.sub(r"[:,]? *\(?(ours|theirs)\b.*", "", what)
            labels = [f"{key} = {cell}" if key else cell for key, cell in zip(head[:first], row[:first], strict=True)]
            case = ", ".join(part for part in (*labels, what) if part)
            source, shared = TABLES.get(name, (name, ""))
            yield Number(name, source, case, row[at], row[beside], shared=shared)


def _beside(head: list[str], at: int) -> int | None:
    """Column of ours for the column ``at`` of theirs: the next after "X: theirs", else the one
    before or after; None without."""
    ours = [word.endswith("ours") for word in head]
    order = (at + 1, at - 1) if ": theirs" in head[at] else (at - 1, at + 1)
    return next((column for column in order if 0 <= column < len(head) and ours[column]), None)


def about(name: str) -> str:
    """First sentence of the docstring of the script."""
    docstring = ast.get_docstring(ast.parse((FOLDER / f"{name}.py").read_text(encoding="utf-8"))) or ""
    return " ".join(docstring.split("\n\n")[0].split()).rstrip(".")


def readme() -> str:
    """The page of all pages."""
    names = sorted(path.stem for path in FOLDER.glob("*.md") if path.stem != "README")
    found = {name: numbers(name, (FOLDER / f"{name}.md").read_text(encoding="utf-8")) for name in names}
    every = [number for name in names for number in found[name]]
    lines = [HEAD, *_counted(every), "", "| page | problem | numbers | counted | agree |", "|---|---|---|---|---|"]
    for name in names:
        tally = Tally.of(found[name])
        counts = (len(found[name]), tally.counted, tally.agree) if found[name] else ("–",) * 3
        lines.append(f"| [{name}]({name}.md) | {about(name)} | " + " | ".join(map(str, counts)) + " |")
    lines += ["", TAIL, *_sources(every), ""]
    head = ("page", "source", "number", "theirs", "ours", "deviation", "verdict", "rests on", "counts once with")
    lines += ["## All numbers", "", "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for one in every:
        row = (one.source, one.case, one.theirs, one.ours, one.deviation, one.verdict, one.rests_on, one.shared)
        lines.append(f"| [{one.page}]({one.page}.md) | " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"


def _by_work(every: Iterable[Number]) -> dict[str, list[Number]]:
    """Numbers by the work that they come from."""
    found: dict[str, list[Number]] = {}
    for number in every:
        found.setdefault(number.work, []).append(number)
    return dict(sorted(found.items()))


def _counted(every: list[Number]) -> list[str]:
    """What all numbers say, in words."""
    tally = Tally.of(every)
    works = [Tally.of(of) for of in _by_work(every).values()]
    tested = [one for one in works if one.counted > one.rest]
    printed = sum(number.page not in REPEATED for number in every)
    return [
        f"**{len(tested)} independent sources**: of {sum(one.whole for one in tested)} every number agrees, of "
        f"{sum(one.agree > 0 and not one.whole for one in tested)} some, of "
        f"{sum(one.agree == 0 for one in tested)} none ([table](#sources)).",
        "",
        f"**{printed} published numbers, {tally.counted} where those of one surface or of one statement count "
        f"once**. {tally.rest} of them rest on a value that was chosen or put in here and test nothing. Of the other "
        f"{tally.counted - tally.rest}, {tally.agree} agree (within {100 * NEAR:.0f} %, the last printed digit, or "
        f"two standard deviations from surface to surface), {tally.near} are near (within {100 * APART:.0f} %), and "
        f"{tally.differ} differ more, for reasons that their pages give. Pages and this summary judge by the same "
        "rule (`verdict_of` in `page.py`).",
    ]


def _sources(every: list[Number]) -> list[str]:
    """The table of sources."""
    head = ("source", "numbers", "counted", "agree", "near", "differ", "rest on a choice")
    lines = [
        "## Sources",
        "",
        "Works that the numbers come from; `agree`, `near` and `differ` count what rests on no choice.",
        "",
        "| " + " | ".join(head) + " |",
        "|" + "---|" * len(head),
    ]
    for work, of in _by_work(every).items():
        tally = Tally.of(of)
        row = (work, len(of), tally.counted, tally.agree, tally.near, tally.differ, tally.rest)
        lines.append("| " + " | ".join(map(str, row)) + " |")
    return lines


if __name__ == "__main__":
    (FOLDER / "README.md").write_text(readme(), encoding="utf-8")
