"""Writes README.md of this folder: the pages, and all published numbers in them beside ours with
deviation and verdict.

The numbers are those of the tables of the pages: a column called "theirs" and the column of ours
beside it. Where a page has none, those of its claims that a published number lies within two
standard deviations of ours. Pages whose reference is an independent solution of our own say so and
are not read.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from page import PUBLISHED_TITLE

FOLDER = Path(__file__).parent
UNCOUNTED = {
    "bhushan_film": "the load was chosen freely",
    "peng_load": "rows of table 3.1 again",
}
"""Pages whose numbers are listed but not counted, and why."""

NEAR, APART = 0.05, 0.2
"""Deviations up to which numbers without a stated scatter agree, and from which they differ."""

SCATTER = "within two standard deviations of ours"

HEAD = """# Comparison with published results

Made by `python validation/summary.py`, the last step of `make validate`. One script for each published result
writes a page of the same name:

```sh
python validation/sphere_on_layer.py     # writes validation/sphere_on_layer.md
make validate                            # all pages (half an hour of one core), this page, pictures
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
of its docstring stands here.
"""


@dataclass(frozen=True)
class Number:
    """A published number beside ours, as the page shows both."""

    page: str
    case: str
    theirs: str
    ours: str

    @property
    def deviation(self) -> float:
        """Ours over theirs, less one; the difference where theirs is zero."""
        theirs, ours = _first(self.theirs), _first(self.ours)
        return ours / theirs - 1.0 if theirs else ours

    @property
    def verdict(self) -> str:
        """In words; a scatter that the page states goes first."""
        theirs, ours = _first(self.theirs), _first(self.ours)
        scatter = re.search(r"± *([-+.\de]+)", self.ours)
        if scatter and abs(ours - theirs) <= 2.0 * float(scatter[1]):
            return "within the scatter of one surface"
        if abs(self.deviation) <= NEAR or abs(ours - theirs) <= _half_a_digit(self.theirs):
            return "agrees"
        return "near" if abs(self.deviation) <= APART else "differs"

    @property
    def agrees(self) -> bool:
        """Whether within the scatter, the rounding or 5 %."""
        return self.verdict not in ("near", "differs")


def _first(text: str) -> float:
    """First number of a text."""
    found = re.search(r"[-+]?\d*\.?\d+(?:e[-+]?\d+)?", text.replace("−", "-"))
    assert found is not None, text
    return float(found[0])


def _half_a_digit(text: str) -> float:
    """Half a unit of the last digit shown."""
    digits = re.search(r"\d*\.(\d+)", text)
    return 0.0 if "e" in text else 0.5001 * 10.0 ** -(len(digits[1]) if digits else 0)


def numbers(name: str, text: str) -> list[Number]:
    """The published numbers of the page ``name``."""
    _, given, rest = text.partition(PUBLISHED_TITLE)
    text = rest.partition("\n## ")[0] if given else text
    tables = [number for head, rows in _tables(text) for number in _pairs(name, head, rows)]
    return tables or list(_scatters(name, text))


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
            yield Number(name, ", ".join(part for part in (*labels, what) if part), row[at], row[beside])


def _beside(head: list[str], at: int) -> int | None:
    """Column of ours for the column ``at`` of theirs: the next after "X: theirs", else the one
    before or after; None without."""
    ours = [word.endswith("ours") for word in head]
    order = (at + 1, at - 1) if ": theirs" in head[at] else (at - 1, at + 1)
    return next((column for column in order if 0 <= column < len(head) and ours[column]), None)


def _scatters(name: str, text: str) -> Iterator[Number]:
    """Claims that a published number lies within two standard deviations of ours."""
    for head, rows in _tables(text):
        for row in rows:
            if head[0] == "claim" and SCATTER in row[0]:
                low, high = (float(part) for part in row[2].split(" to "))
                ours = f"{0.5 * (low + high):.3g} ± {0.25 * (high - low):.2g}"
                yield Number(name, row[0].replace(f", {SCATTER}", ""), f"{float(row[1]):g}", ours)


def about(name: str) -> str:
    """First sentence of the docstring of the script."""
    docstring = ast.get_docstring(ast.parse((FOLDER / f"{name}.py").read_text(encoding="utf-8"))) or ""
    return " ".join(docstring.split("\n\n")[0].split()).rstrip(".")


def readme() -> str:
    """The page of all pages."""
    names = sorted(path.stem for path in FOLDER.glob("*.md") if path.stem != "README")
    found = {name: numbers(name, (FOLDER / f"{name}.md").read_text(encoding="utf-8")) for name in names}
    counted = [number for name in names if name not in UNCOUNTED for number in found[name]]
    agree = sum(number.agrees for number in counted)
    near = sum(number.verdict == "near" for number in counted)
    lines = [
        HEAD,
        f"**{len(counted)} published numbers**: {agree} agree (within the scatter of one surface that the page "
        f"states, the last printed digit, or {100 * NEAR:.0f} %), {near} are within {100 * APART:.0f} %, "
        f"{len(counted) - agree - near} differ more, for reasons that their pages give. Numbers of one page "
        "may come from one surface of theirs, as all of table 3.1 do, and are then no independent checks.",
        "",
        "| page | problem | numbers | agree |",
        "|---|---|---|---|",
    ]
    for name in names:
        of = found[name]
        count = f"({len(of)}: {UNCOUNTED[name]})" if name in UNCOUNTED else f"{len(of) or '–'}"
        agreeing = f"{sum(number.agrees for number in of)}" if of else "–"
        lines.append(f"| [{name}]({name}.md) | {about(name)} | {count} | {agreeing} |")
    lines += [
        "",
        TAIL,
        "## All numbers",
        "",
        "| page | number | theirs | ours | deviation | verdict |",
        "|---|---|---|---|---|---|",
    ]
    for name in names:
        for number in found[name]:
            row = (number.case, number.theirs, number.ours, f"{100.0 * number.deviation:+.1f} %", number.verdict)
            lines.append(f"| [{name}]({name}.md) | " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    (FOLDER / "README.md").write_text(readme(), encoding="utf-8")
