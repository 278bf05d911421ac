"""Error against time: what our solvers have reached after each iteration."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from ours import SOLVERS
from surfaces import BODY

import asperity as asp

_TIGHT = 1e-10


@dataclass
class Clock:
    """Progress that notes the time and the field's error of every iteration."""

    started: float = field(default_factory=time.perf_counter)
    seconds: list[float] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        self.seconds.append(time.perf_counter() - self.started)
        self.errors.append(error)


def histories(heights: NDArray[np.float64], load: float, threads: int) -> dict[str, Clock]:
    """Histories of our solvers down to a tight tolerance, each after a first, unmeasured solve."""
    problem = asp.ContactProblem(asp.Surface(heights, 1.0, 1.0, periodic=True), BODY)
    engine = asp.engines.CpuEngine(threads)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    found = {}
    for name, solver in SOLVERS.items():
        for tolerance in (1e-2, _TIGHT):
            clock = Clock()
            asp.solve(
                problem,
                asp.MeanPressure(load),
                solver=solver(tolerance=tolerance),
                operator=operator,
                keep=asp.Keep(stiffness=False),
                progress=clock,
                on_failure="return",
            )
        found[name] = clock
    return found
