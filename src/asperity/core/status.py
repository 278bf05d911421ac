"""How a computation ended, and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


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
