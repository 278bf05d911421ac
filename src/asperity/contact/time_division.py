"""How the duration of a step of a history is divided into steps of time for bodies that relax."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import require

_FIRST = 1.0 / 16.0
"""Length of the first step of time over the duration, until the error says more."""

_LARGEST, _SMALLEST = 2.0, 0.1
"""Factors between the lengths of one step and the next."""

_SAFE = 0.85
"""Share of the length at which the error would be the tolerance."""


@dataclass(frozen=True)
class TimeSteps:
    """How a duration is divided into steps of time.

    Parameters
    ----------
    tolerance
        Error of the displacement that a step of time may add, over the displacement; the lengths
        follow from it.
    number
        Number of equal steps instead; None for steps by their error.
    most
        Largest number of steps of time within one step of a history, tries included.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    tolerance: float = 1e-3
    number: int | None = None
    most: int = 10000

    def __post_init__(self) -> None:
        require.between(self.tolerance, 0.0, 1.0, "tolerance of the steps of time")
        if self.number is not None:
            require.integer(self.number, 1, "number of steps of time")
        require.integer(self.most, 3, "largest number of steps of time")

    def first(self, duration: float) -> float:
        """Length (s) of the first step of time."""
        return duration / self.number if self.number is not None else _FIRST * duration

    def factor(self, error: float) -> float:
        """Length of the next step, or of the same one again, over the last, after one with this
        ``error``; it is of third order."""
        if error <= 0.0:
            return _LARGEST
        return float(np.clip(_SAFE * (self.tolerance / error) ** (1.0 / 3.0), _SMALLEST, _LARGEST))
