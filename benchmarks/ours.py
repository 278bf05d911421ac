"""Our solvers and the bare FFT pair."""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass

import numpy as np
from method import Solved
from numpy.typing import NDArray
from surfaces import BODY

import asperity as asp
from asperity.core.spectral import RealTransform, fft_library

SOLVERS = {"asperity": asp.solvers.ActiveSet, "asperity cg": asp.solvers.ConjugateGradient}
"""Our methods by their names in the tables: the default one and plain constrained conjugate
gradients."""

_WITHOUT_STIFFNESS = asp.Keep(stiffness=False)


@dataclass
class Ours:
    """``asperity.solve`` with one of ``SOLVERS``."""

    name: str
    threads: int

    def __post_init__(self) -> None:
        self.version = f"{asp.__version__} ({fft_library()})"

    def supports(self, n: int) -> bool:
        return n > 0

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float) -> Solved:
        """Prepare the operator and solve. ``user_seconds`` adds what a user gets besides: gap,
        spots, area, certificate."""
        problem = asp.ContactProblem(asp.Surface(heights, 1.0, 1.0, periodic=True), BODY)
        started = time.perf_counter()
        engine = asp.engines.CpuEngine(self.threads)
        operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
        prepared = time.perf_counter() - started
        result = asp.solve(
            problem,
            asp.MeanPressure(load),
            solver=SOLVERS[self.name](tolerance=tolerance),
            operator=operator,
            keep=_WITHOUT_STIFFNESS,
        )
        work = result.certificate
        counts = {
            "iterations": work.iterations,
            "pairs": work.fft_pairs,
            "solver_seconds": work.wall_time,
            "user_seconds": time.perf_counter() - started,
        }
        return Solved(result.pressure, prepared + work.wall_time, counts)


@dataclass
class BarePair:
    """One real transform and its inverse, float64, buffers made beforehand: the unit of cost.
    Ignores the load."""

    threads: int
    name: str = "fft pair"

    def __post_init__(self) -> None:
        self.version = fft_library()

    def supports(self, n: int) -> bool:
        return n > 0

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float, repeats: int = 9) -> Solved:
        """Median of ``repeats`` pairs after one more."""
        transform = RealTransform(heights.shape, self.threads)
        spectrum, back = transform.forward(heights), np.empty_like(heights)
        seconds = []
        for _ in range(repeats + 1):
            started = time.perf_counter()
            transform.backward(transform.forward(heights, spectrum), back)
            seconds.append(time.perf_counter() - started)
        return Solved(back, statistics.median(seconds[1:]))
