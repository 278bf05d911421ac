"""Means of samples with their confidence, and when there are enough of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from ..io.schemas.study import StopTable

CONFIDENCE = 0.95
"""Default confidence of intervals."""


@dataclass(frozen=True)
class Estimate:
    """Mean of a quantity over samples.

    ``half_width`` is half the confidence interval of the mean (Student's t); NaN with fewer than two samples.
    """

    mean: float
    deviation: float
    half_width: float
    count: int


def estimate(values: ArrayLike, confidence: float = CONFIDENCE) -> Estimate:
    """Mean, standard deviation and confidence of ``values``, those that are finite."""
    array = np.asarray(values, dtype=float)
    good = array[np.isfinite(array)]
    if good.size < 2:
        return Estimate(float(good.mean()) if good.size else math.nan, math.nan, math.nan, good.size)
    deviation = float(good.std(ddof=1))
    return Estimate(
        float(good.mean()), deviation, student(good.size, confidence) * deviation / math.sqrt(good.size), good.size
    )


def student(count: int, confidence: float) -> float:
    """Half width of the confidence interval of a mean of ``count`` >= 2 samples in standard errors."""
    from scipy.special import stdtrit

    return float(stdtrit(count - 1, 0.5 * (1.0 + confidence)))


class Stop:
    """Decides after how many samples to stop: the least number at which the intervals are narrow enough.

    Samples count in their order and not in that of their arrival, so that the decision does not depend on the workers.
    Failed cases do not count.

    Parameters
    ----------
    table
        When to stop.
    points
        Number of points on the other axes; the interval must be narrow at each of them.
    """

    def __init__(self, table: StopTable, points: int) -> None:
        self._table = table
        self._waiting: dict[int, dict[int, float]] = {}
        self._count, self._mean, self._square = np.zeros(points), np.zeros(points), np.zeros(points)
        self.samples = 0
        self.reached = False

    @property
    def end(self) -> int | None:
        """Number of samples that are enough; None as long as they are not."""
        return self.samples if self.reached else None

    def take(self, sample: int, point: int, value: float) -> None:
        """Take in the ``value`` of a ``sample`` at a ``point`` of the other axes, NaN where it failed."""
        if self.reached or sample < self.samples:
            return
        self._waiting.setdefault(sample, {})[point] = value
        while not self.reached and len(self._waiting.get(self.samples, ())) == self._mean.size:
            self._absorb(self._waiting.pop(self.samples))

    def _absorb(self, values: dict[int, float]) -> None:
        """Update count, mean and sum of squares (Welford 1962)."""
        row = np.array([values[point] for point in range(self._mean.size)])
        good = np.isfinite(row)
        self._count += good
        change = np.where(good, row - self._mean, 0.0)
        self._mean += change / np.maximum(self._count, 1.0)
        self._square += change * np.where(good, row - self._mean, 0.0)
        self.samples += 1
        self.reached = self.samples >= self._table.at_least and bool(np.all(self._half_widths() <= self._allowed()))

    def _half_widths(self) -> RealArray:
        widths = np.full(self._mean.size, math.inf)
        for point, count in enumerate(self._count):
            if count >= 2:
                error = math.sqrt(self._square[point] / (count - 1.0) / count)
                widths[point] = student(int(count), self._table.confidence) * error
        return widths

    def _allowed(self) -> RealArray:
        if self._table.width is not None:
            return np.full(self._mean.size, self._table.width)
        assert self._table.relative_width is not None
        return self._table.relative_width * np.abs(self._mean)
