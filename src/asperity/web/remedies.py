"""What a finding advises, as changes of the document that was run, or as the page where a person
chooses."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ..core.errors import AsperityError
from ..core.units import show
from ..core.words import ACTIONS, in_words
from ..run.document import checked
from .draft import Keys, changed, found

NAMED = re.compile(r"\{(\w+(?:\.\w+)*)(?:=([^{}]*))?\}")
"""An action, or the dotted key of a document and perhaps its value, in the text of a remedy."""

MOST_POINTS = 4096 * 4096
"""Points to which a grid is refined at one press of a button."""

PIXELS_PER_WAVE, TAPERED, TIGHTER, MORE = 8, 0.1, 1e-10, 4
"""Shortest wave of a smoothed surface in pixels; share of the sides that is tapered; tolerance that
is smaller than any default; and times the iterations."""

Change = tuple[Keys, Any]
"""Where a value of the document stands, and the value."""


@dataclass(frozen=True)
class Remedy:
    """One thing that a finding advises.

    ``words`` name it in words of the form; ``table`` is the document with it, None where a person
    must choose a value, on ``page``.
    """

    words: str
    page: str
    table: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class _Was:
    """The document that was run, and points and pixels (m) of its grid."""

    table: Mapping[str, Any]
    points: Sequence[int]
    cell: Sequence[float]

    def step(self, **step: Any) -> Change:
        """One more step of preparation; a last one of the same kind is replaced."""
        present = list(found(self.table, ("surface", "prepare")) or ())
        if present and present[-1].get("step") == step["step"]:
            present.pop()
        return ("surface", "prepare"), [*present, step]


def _resampled(was: _Was) -> tuple[str, Change] | None:
    finer = [2 * n if n > 1 else 1 for n in was.points]
    if finer[0] * finer[1] > MOST_POINTS:
        return None
    return f"{finer[0]} x {finer[1]} points", was.step(step="resample", points=finer)


def _smoothed(was: _Was) -> tuple[str, Change]:
    short = show(PIXELS_PER_WAVE * max(was.cell), "m", 3)
    return f"waves shorter than {short}", was.step(step="filter", short=short)


def _iterations(was: _Was) -> tuple[str, Change]:
    given = found(was.table, ("solver", "max_iterations"))
    more = MORE * int(given or checked(was.table).solver.max_iterations or 5000)
    return str(more), (("solver", "max_iterations"), more)


CHANGES: Mapping[str, Callable[[_Was], tuple[str, Change] | None]] = MappingProxyType(
    {
        "periodise": lambda was: ("", was.step(step="periodise")),
        "fill": lambda was: ("", was.step(step="fill")),
        "despike": lambda was: ("", was.step(step="despike")),
        "taper": lambda was: (f"{TAPERED:g} of each side", was.step(step="taper", width=TAPERED)),
        "resample": _resampled,
        "smooth": _smoothed,
        "free": lambda was: ("", (("boundary",), {"kind": "free"})),
        "periodic": lambda was: ("", (("boundary",), {"kind": "periodic"})),
        "hardness": lambda was: ("", (("law",), {"kind": "hardness", "hardness": "from body"})),
        "effective_hardness": lambda was: ("", (("law",), {"kind": "hardness", "hardness": "effective"})),
        "tolerance": lambda was: (f"{TIGHTER:g}", (("solver", "tolerance"), TIGHTER)),
        "iterations": _iterations,
        "stresses": lambda was: ("", (("stress",), {})),
    }
)
"""What an action changes in the document that was run, and the value in words; None where it cannot
be chosen for a person."""

PAGES = MappingProxyType(
    {"Surface": "surface", "Prepare": "prepare", "Bodies": "bodies", "Body": "bodies", "Counter body": "bodies"}
)
"""Pages by what the words of the form begin with; all others are on that of load and physics."""


def remedies(text: str, table: Mapping[str, Any], points: Sequence[int], cell: Sequence[float]) -> Iterator[Remedy]:
    """What the ``text`` of a remedy advises, each thing once, for a document ``table`` whose grid
    had these ``points`` and pixels ``cell`` (m)."""
    was, told = _Was(table, points, cell), set[str]()
    for name, value in NAMED.findall(text):
        if name not in ACTIONS and "." not in name:
            continue
        words = in_words(f"{{{name}={value}}}" if value else f"{{{name}}}", "form")
        made = _changed(name, value, was)
        if made is not None and made[0]:
            words += f" ({made[0]})"
        if words not in told:
            told.add(words)
            page = PAGES.get(re.split(r"[:,]", words)[0], "load")
            yield Remedy(words, page, None if made is None else made[1])


def _changed(name: str, value: str, was: _Was) -> tuple[str, Mapping[str, Any]] | None:
    """The value in words, and the document that holds it; None where there is no such document."""
    if value:
        made: tuple[str, Change] | None = ("", (tuple(name.split(".")), _read(value)))
    else:
        change = CHANGES.get(name)
        made = None if change is None else change(was)
    if made is None:
        return None
    words, (keys, new) = made
    table = changed(was.table, keys, new)
    try:
        checked(table)
    except AsperityError:
        return None
    return (words, table) if table != was.table else None


def _read(value: str) -> Any:
    """A value as in text of a document: a number, true or false, or text."""
    try:
        return json.loads(value)
    except ValueError:
        return value
