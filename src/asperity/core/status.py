"""How a computation ended, what to do about it, and what its checks found."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal


class Outcome(StrEnum):
    """End of an iterative computation."""

    CONVERGED = "converged"
    STAGNATED = "stagnated"
    ITERATION_LIMIT = "iteration limit"
    INTERRUPTED = "interrupted"


@dataclass(frozen=True)
class Status:
    """Outcome with a sentence for the user and the usual remedy (empty when converged)."""

    outcome: Outcome
    message: str
    remedy: str = ""

    @property
    def converged(self) -> bool:
        """Whether the tolerance was reached."""
        return self.outcome is Outcome.CONVERGED


@dataclass(frozen=True)
class Advice:
    """One finding of the checks of resolution and regime.

    ``level`` is ``"note"`` (good to know) or ``"warning"`` (the answer may be wrong); ``criterion`` a short name;
    ``message`` one or two sentences with the numbers and the remedy.
    """

    level: Literal["note", "warning"]
    criterion: str
    message: str
