"""How a computation goes on and ended, what its checks found, and what it takes of the machine."""

from __future__ import annotations

import importlib.util
import math
import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Literal, Protocol

from .errors import InputError
from .words import in_words


class Outcome(StrEnum):
    """End of an iterative computation."""

    CONVERGED = "converged"
    STAGNATED = "stagnated"
    ITERATION_LIMIT = "iteration limit"
    INTERRUPTED = "interrupted"


@dataclass(frozen=True)
class Status:
    """Outcome with a sentence for the user and the usual remedy (empty when converged), in the
    words of the door that speaks."""

    outcome: Outcome
    message: str
    remedy: str = ""

    def __post_init__(self) -> None:
        """Say what can be done in words."""
        if self.remedy:
            object.__setattr__(self, "remedy", in_words(self.remedy))

    @property
    def converged(self) -> bool:
        """Whether the tolerance was reached."""
        return self.outcome is Outcome.CONVERGED


@dataclass(frozen=True)
class Advice:
    """One finding of the checks of resolution and regime, as data; ``message`` is its text.

    Attributes
    ----------
    level
        ``"note"`` (of interest) or ``"warning"`` (the answer may be wrong).
    criterion
        Short name of the check.
    fact
        One or two sentences with what was found.
    remedy
        What to do about it, with the names of ``words.ACTIONS`` in braces; empty where there is
        nothing to do.
    numbers
        What the criterion compares, by name, SI.
    concerns
        Names of the quantities, or beginnings of such names, whose values it puts in doubt; empty
        where it is about the whole.
    """

    level: Literal["note", "warning"]
    criterion: str
    fact: str
    remedy: str = ""
    numbers: Mapping[str, float] = field(default_factory=dict, hash=False)
    concerns: tuple[str, ...] = ()

    @property
    def message(self) -> str:
        """Fact and remedy, in the words of the door that is speaking."""
        return f"{self.fact} {in_words(self.remedy)}".rstrip()


GRADES = {"good": "Good", "doubtful": "Doubtful", "not": "Not to be trusted"}
"""Grades of trust, and what they are called."""

SENTENCES = ("Result", "Strength", "Trust")
"""What the sentences of a verdict are about."""


@dataclass(frozen=True)
class Verdict:
    """What was found, whether it holds, and whether it can be trusted, in a sentence or two each.

    Attributes
    ----------
    what
        Area, load and approach at the decisive step, and what each physics that was asked for
        found.
    holds
        What yields, flows or cracks, where and by which factor; or that it was not checked, and
        why.
    trust
        The grade, with the reason that matters most and its remedy.
    grade
        ``"good"``, ``"doubtful"`` or ``"not"``.
    fails
        Whether something does not hold.
    step, steps
        Number of the decisive step from 1, that of the largest load, and how many there are.
    headline
        Label and text of the numbers that people look for first, at that step.
    findings
        Everything that should be known before the numbers are used.
    doubted
        Beginnings of the names of all quantities that the findings put in doubt.
    """

    what: str
    holds: str
    trust: str
    grade: Literal["good", "doubtful", "not"]
    fails: bool
    step: int
    steps: int
    headline: list[tuple[str, str]]
    findings: tuple[Advice, ...] = ()
    doubted: tuple[str, ...] = ()

    @property
    def rows(self) -> list[tuple[str, str]]:
        """The three sentences with what each is about."""
        return list(zip(SENTENCES, (self.what, self.holds, self.trust), strict=True))

    @property
    def others(self) -> tuple[Advice, ...]:
        """Findings that the sentence on trust does not tell itself."""
        return tuple(item for item in self.findings if item.message not in self.trust)


class Progress(Protocol):
    """Receives the state of an iterative computation after every iteration."""

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Report that ``iteration`` is done with relative ``error``; work ends at ``tolerance``."""


class NoProgress:
    """Report nothing."""

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Do nothing."""


def share_done(error: float, largest: float, tolerance: float) -> float:
    """Share of the way from the ``largest`` error to the ``tolerance`` on a logarithmic scale,
    between 0 and 1."""
    if error <= tolerance:
        return 1.0
    if not tolerance > 0.0 or not tolerance < largest < math.inf or not error < math.inf:
        return 0.0
    return min(1.0, max(0.0, math.log(largest / error) / math.log(largest / tolerance)))


def peak_memory() -> float:
    """Largest resident memory of the process so far in bytes; NaN where it is not known
    (Windows)."""
    if importlib.util.find_spec("resource") is None:
        return math.nan
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)


def free_memory() -> float:
    """Bytes of memory that new work may take; infinite where it is not known (Windows, macOS)."""
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        return next(1024.0 * float(line.split()[1]) for line in lines if line.startswith("MemAvailable"))
    except (OSError, StopIteration):
        names = getattr(os, "sysconf_names", {})
        known = "SC_AVPHYS_PAGES" in names and "SC_PAGE_SIZE" in names
        return float(os.sysconf("SC_AVPHYS_PAGES")) * float(os.sysconf("SC_PAGE_SIZE")) if known else math.inf


def require_memory(needed: float, what: str, count: str, remedy: str, kind: type[InputError] = InputError) -> None:
    """Refuse what takes more than the free memory, before anything is allocated.

    Parameters
    ----------
    needed
        Memory in bytes.
    what, count
        What needs it, and how much of it there is.
    remedy
        What to do instead, the end of a sentence.
    kind
        Error to raise.

    Raises
    ------
    InputError
        Of the ``kind``, with both sizes.
    """
    if needed > free_memory():
        raise kind(f"{what} must fit into the memory, but {count} need about {room_text(needed)}; {remedy}.")


def room_text(needed: float, free: float | None = None) -> str:
    """Bytes ``needed`` beside those that are ``free``, by default in the memory, in words."""
    return f"{needed / 2**30:.3g} GiB where {(free_memory() if free is None else free) / 2**30:.3g} GiB are free"


def is_large(needed: float, free: float | None = None) -> bool:
    """Whether the bytes ``needed`` are more than half of those that are ``free``, by default in the
    memory.

    Work that takes as much is confirmed; the other half is for whatever else runs.
    """
    return needed > 0.5 * (free_memory() if free is None else free)


def compiling() -> bool:
    """Whether this thread is inside the compiler of the passes: an exception raised there by a
    signal may crash it."""
    lock = sys.modules.get("numba.core.compiler_lock")
    return lock is not None and bool(lock.global_compiler_lock.is_locked())
