"""Pages with several tables and claims that a number lies within bounds, as Markdown."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Table:
    """Texts in rows under a head, with a line above that says what they are."""

    about: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def lines(self) -> list[str]:
        """The table in Markdown."""
        lines = ([self.about, ""] if self.about else []) + ["| " + " | ".join(self.head) + " |"]
        lines.append("|" + "---|" * len(self.head))
        return lines + ["| " + " | ".join(row) + " |" for row in self.rows]


@dataclass(frozen=True)
class Claim:
    """A statement that holds if ``low`` <= ``found`` <= ``high``."""

    text: str
    found: float
    low: float = -math.inf
    high: float = math.inf

    @property
    def holds(self) -> bool:
        """Whether the number lies within the bounds."""
        return self.low <= self.found <= self.high

    @property
    def expected(self) -> str:
        """The bounds in words."""
        if self.low == self.high:
            return f"{self.low:.3g}"
        if math.isinf(self.low):
            return f"at most {self.high:.3g}"
        if math.isinf(self.high):
            return f"at least {self.low:.3g}"
        return f"{self.low:.3g} to {self.high:.3g}"


def within_scatter(text: str, theirs: float, ours: np.ndarray) -> Claim:
    """That a published number lies within two standard deviations of the mean of ours."""
    mean, width = float(ours.mean()), 2.0 * float(ours.std(ddof=1))
    return Claim(f"{text}, within two standard deviations of ours", theirs, mean - width, mean + width)


@dataclass(frozen=True)
class Published:
    """A published number beside ours.

    Parameters
    ----------
    source
        Work and place in it, such as ``"Peng 2001, fig. 2.5"``.
    what
        The quantity and its inputs.
    theirs
        The number as printed.
    ours
        Ours; of several surfaces the mean.
    within
        Largest deviation relative to theirs that counts as agreement.
    spread
        Standard deviation of ours from surface to surface: twice that counts as agreement, too.
    reason
        Why they differ, where they do; or what was chosen freely.
    """

    source: str
    what: str
    theirs: str
    ours: float
    within: float = 0.02
    spread: float = 0.0
    reason: str = ""

    @property
    def value(self) -> float:
        """Their number."""
        return float(self.theirs.replace("−", "-"))

    @property
    def deviation(self) -> float:
        """Ours over theirs, less one."""
        return self.ours / self.value - 1.0

    @property
    def agrees(self) -> bool:
        """Whether ours lies within the bound, within two standard deviations, or rounds to
        theirs."""
        digits = len(self.theirs.partition(".")[2])
        near = abs(self.ours - self.value) <= max(2.0 * self.spread, 0.5001 * 10.0**-digits * ("e" not in self.theirs))
        return near or abs(self.deviation) <= self.within

    @property
    def cells(self) -> tuple[str, ...]:
        """Row of the table ``PUBLISHED_HEAD``."""
        ours = f"{float(f'{self.ours:.3g}'):g}" + (f" ± {self.spread:.2g}" if self.spread else "")
        verdict = ("agrees" if self.agrees else "differs") + (f": {self.reason}" if self.reason else "")
        return self.source, self.what, self.theirs, ours, f"{100.0 * self.deviation:+.1f} %", verdict


@dataclass(frozen=True)
class Stated:
    """What a publication states in words beside what is found here; ``why``: where they differ, or
    what the agreement hangs on."""

    text: str
    ours: str
    holds: bool
    why: str = ""

    @property
    def cells(self) -> tuple[str, ...]:
        """Row of a table of statements."""
        return self.text, self.ours, ("agrees" if self.holds else "differs") + (f": {self.why}" if self.why else "")


def statements(about: str, rows: tuple[Stated, ...]) -> Table:
    """Table of the ``rows``; ``about`` stands above it."""
    return Table(about, ("stated", "ours", "verdict"), tuple(row.cells for row in rows))


PUBLISHED_TITLE = "## Published numbers"
PUBLISHED_HEAD = ("source", "number", "theirs", "ours", "deviation", "verdict")


@dataclass(frozen=True)
class Page:
    """A published result: text and tables in order, what is claimed of them, and the published
    numbers beside ours."""

    title: str
    about: str
    parts: tuple[str | Table, ...]
    claims: tuple[Claim, ...]
    published: tuple[Published, ...] = ()

    @property
    def agrees(self) -> bool:
        """Whether every claim holds."""
        return all(claim.holds for claim in self.claims)

    def markdown(self) -> str:
        """The whole page."""
        lines = [f"# {self.title}", "", self.about, ""]
        for part in self.parts:
            lines += [*(part.lines() if isinstance(part, Table) else [part]), ""]
        if self.published:
            lines += Table(PUBLISHED_TITLE, PUBLISHED_HEAD, tuple(one.cells for one in self.published)).lines()
            lines.append("")
        rows = tuple(
            (claim.text, f"{claim.found:.3g}", claim.expected, "yes" if claim.holds else "NO") for claim in self.claims
        )
        lines += Table("## Claims and checks", ("claim", "found", "expected", "holds"), rows).lines()
        return "\n".join(lines) + "\n"


def write_page(page: Page, script: str) -> None:
    """Write the page beside its ``script``; exit status 1 if it disagrees."""
    path = Path(script).with_suffix(".md")
    path.write_text(page.markdown(), encoding="utf-8")
    print(f"{path.name}: {'agrees' if page.agrees else 'DISAGREES'}")
    if not page.agrees:
        raise SystemExit(1)
