"""Progress reporting of long computations; the default reports nothing."""

from __future__ import annotations

from typing import Protocol


class Progress(Protocol):
    """Receives the state of an iterative computation after every iteration."""

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Report that ``iteration`` is done with relative ``error``; work ends at ``tolerance``."""


class NoProgress:
    """Report nothing."""

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Do nothing."""
