"""Interleaved repeats: in each round every solver solves the same problem once, the FFT pair among
them."""

from __future__ import annotations

import statistics
from dataclasses import dataclass, field

import numpy as np
from checks import contact_pixels, disagreement, field_error, relative_l2
from method import Solved
from numpy.typing import NDArray
from worker import Worker


@dataclass
class Row:
    """All rounds of one solver on one problem; ``fault`` says why it has no or no right answer."""

    n: int
    load: float
    solver: str
    version: str
    threads: int
    seconds: list[float] = field(default_factory=list)
    pair_seconds: float = float("nan")
    pixels: int = 0
    field_error: float = float("nan")
    distance: float = float("nan")
    counts: dict[str, float] = field(default_factory=dict)
    ratio_to_ours: float = float("nan")
    fault: str = ""

    @property
    def median(self) -> float:
        """Median of the times (s); nan without one."""
        return statistics.median(self.seconds) if self.seconds else float("nan")

    @property
    def cost(self) -> float:
        """Time in the solver over FFT pairs times the time of a pair; nan where pairs are not
        counted."""
        if "pairs" not in self.counts:
            return float("nan")
        return self.counts["solver_seconds"] / (self.counts["pairs"] * self.pair_seconds)


@dataclass(frozen=True)
class Rounds:
    """``repeats`` rounds, less for a solver whose last solve took longer than ``patience`` s."""

    repeats: int
    patience: float
    tolerance: float


def problem_rows(
    workers: list[Worker], pair: Worker, heights: NDArray[np.float64], load: float, rounds: Rounds
) -> list[Row]:
    """Rows of all ``workers`` on one problem, the first of them being the reference of the
    checks."""
    n = heights.shape[0]
    rows = [Row(n, load, worker.name, worker.version, worker.threads) for worker in workers]
    answers: dict[str, list[Solved]] = {worker.name: [] for worker in workers}
    pairs = []
    for _ in range(rounds.repeats):
        pairs.append(pair.solve(heights, load, rounds.tolerance).seconds)
        for worker, row in zip(workers, rows, strict=True):
            _solve_once(worker, row, answers[worker.name], heights, rounds)
    for row in rows:
        row.pair_seconds = statistics.median(pairs)
        _judge(row, answers[row.solver], answers[rows[0].solver], heights)
        row.ratio_to_ours = row.median / rows[0].median
    return rows


def _solve_once(worker: Worker, row: Row, answers: list[Solved], heights: NDArray[np.float64], rounds: Rounds) -> None:
    if row.fault or (row.seconds and row.seconds[-1] > rounds.patience):
        return
    try:
        answer = worker.solve(heights, row.load, rounds.tolerance)
    except RuntimeError as error:
        row.fault = str(error)
        return
    row.seconds.append(answer.seconds)
    answers.append(answer)


def _judge(row: Row, answers: list[Solved], reference: list[Solved], heights: NDArray[np.float64]) -> None:
    """Medians of the counts, accuracy of the last answer, its distance from the reference."""
    if not answers:
        return
    row.counts = {key: statistics.median(a.counts[key] for a in answers) for key in answers[0].counts}
    pressure = answers[-1].pressure
    row.pixels = contact_pixels(pressure)
    row.field_error = field_error(heights, pressure)
    if reference:
        row.distance = relative_l2(pressure, reference[-1].pressure)
        row.fault = row.fault or disagreement(pressure, reference[-1].pressure)
