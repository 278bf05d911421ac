"""What the benchmark asks of a solver, ours or another's."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Solved:
    """One solve: ``pressure`` (n, n) over E*, ``seconds`` from heights in memory to pressure, its
    own counts."""

    pressure: NDArray[np.float64]
    seconds: float
    counts: dict[str, float] = field(default_factory=dict)


class Method(Protocol):
    """A solver under test. Made in a process of its own, once; ``threads`` is what it really
    uses."""

    name: str
    version: str
    threads: int

    def supports(self, n: int) -> bool:
        """Whether it can solve on n x n points."""

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float) -> Solved:
        """Solve the periodic contact of unit pixels at the mean pressure ``load`` (over E*)."""
