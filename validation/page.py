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


NEAR, APART = 0.05, 0.2
"""Deviations up to which a published number agrees, and from which it differs."""

SCATTER, AGREES, BETWEEN, DIFFERS = "within the scatter of one surface", "agrees", "near", "differs"


def verdict_of(theirs: str, ours: float, spread: float = 0.0) -> str:
    """The one verdict on a published number, on the pages and in their summary.

    Parameters
    ----------
    theirs
        The number as printed.
    ours
        Ours; of several surfaces the mean.
    spread
        Standard deviation of ours from surface to surface, 0 without.

    Returns
    -------
    ``SCATTER`` within two standard deviations, ``AGREES`` within 5 % or where ours rounds to
    theirs, ``BETWEEN`` within 20 %, else ``DIFFERS``.
    """
    printed = value_of(theirs)
    apart = abs(ours - printed)
    if spread and apart <= 2.0 * spread:
        return SCATTER
    if apart <= max(_half_a_digit(theirs), NEAR * abs(printed)):
        return AGREES
    return BETWEEN if apart <= APART * abs(printed) else DIFFERS


def value_of(text: str) -> float:
    """The number of a text with a minus sign of print or of a computer."""
    return float(text.replace("−", "-"))


def _half_a_digit(text: str) -> float:
    """Half a unit of the last digit of a printed number."""
    return 0.0 if "e" in text else 0.5001 * 10.0 ** -len(text.partition(".")[2])


@dataclass(frozen=True)
class Published:
    """A published number beside ours; ``verdict_of`` judges it.

    Parameters
    ----------
    source
        Work and place in it, such as ``"Peng 2001, fig. 2.5"``; ``", after X"`` at its end names
        the work that the number comes from.
    what
        The quantity and its inputs.
    theirs
        The number as printed.
    ours
        Ours; of several surfaces the mean.
    within
        Largest deviation relative to theirs that a test of the page lets pass.
    spread
        Standard deviation of ours from surface to surface: twice that counts as agreement, too.
    reason
        Why they differ, where they do; or how ours was found.
    rests_on
        What was chosen here, or put in as published, and decides the number: it is no test then.
    shared
        Name of what several published numbers share, such as one surface or one statement found
        in two ways: together they count once.
    """

    source: str
    what: str
    theirs: str
    ours: float
    within: float = 0.02
    spread: float = 0.0
    reason: str = ""
    rests_on: str = ""
    shared: str = ""

    @property
    def value(self) -> float:
        """Their number."""
        return value_of(self.theirs)

    @property
    def deviation(self) -> float:
        """Ours over theirs, less one."""
        return self.ours / self.value - 1.0

    @property
    def verdict(self) -> str:
        """In words."""
        return verdict_of(self.theirs, self.ours, self.spread)

    @property
    def agrees(self) -> bool:
        """Whether within the scatter, the rounding or 5 %."""
        return self.verdict in (SCATTER, AGREES)

    @property
    def kept(self) -> bool:
        """Whether ours lies within the bound ``within``, within two standard deviations, or rounds
        to theirs."""
        apart = abs(self.ours - self.value)
        return apart <= max(2.0 * self.spread, _half_a_digit(self.theirs), self.within * abs(self.value))

    @property
    def cells(self) -> tuple[str, ...]:
        """Row of the table ``PUBLISHED_HEAD``."""
        ours = f"{float(f'{self.ours:.3g}'):g}" + (f" ± {self.spread:.2g}" if self.spread else "")
        verdict = self.verdict + (f": {self.reason}" if self.reason else "")
        return self.source, self.what, self.theirs, ours, f"{100.0 * self.deviation:+.1f} %", verdict


def published_table(numbers: tuple[Published, ...]) -> Table:
    """Table of published numbers; what they rest on and what they share have columns where any
    does."""
    columns = [(head, name) for head, name in PUBLISHED_MORE if any(getattr(one, name) for one in numbers)]
    rows = tuple((*one.cells, *(getattr(one, name) for _, name in columns)) for one in numbers)
    return Table(PUBLISHED_TITLE, (*PUBLISHED_HEAD, *(head for head, _ in columns)), rows)


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
PUBLISHED_MORE = (("rests on", "rests_on"), ("counts once with", "shared"))


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
            lines += published_table(self.published).lines()
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
