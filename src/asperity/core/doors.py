"""Names of what a person can do, in the words of the door at which they stand: Python, the command line or the form of the application.

Findings say ``{periodise}``; a reader in Python is told ``surface.periodised()``, one of the command line ``--periodise``, one of the form the field.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from types import MappingProxyType
from typing import Literal, NamedTuple, TypeAlias

Door: TypeAlias = Literal["python", "command", "form"]
"""Where a person stands."""


class Action(NamedTuple):
    """One thing to do, as it is named at each door."""

    python: str
    command: str
    form: str


ACTIONS = MappingProxyType(
    {
        "periodise": Action("surface.periodised()", "--periodise", "Surface, Preparation: periodise"),
    }
)
"""What findings advise, by name."""

_DOOR: ContextVar[Door] = ContextVar("door", default="python")

_NAMED = re.compile(r"\{(\w+)\}")


@contextmanager
def speaking(door: Door) -> Iterator[None]:
    """Context in which findings name what can be done at this ``door``."""
    before = _DOOR.set(door)
    try:
        yield
    finally:
        _DOOR.reset(before)


def in_words(text: str, door: Door | None = None) -> str:
    """``text`` with every ``{action}`` in the words of ``door``, by default the one that is speaking."""
    chosen = door or _DOOR.get()
    return _NAMED.sub(lambda found: getattr(ACTIONS[found[1]], chosen), text)
