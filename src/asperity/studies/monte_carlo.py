"""Means of samples with their confidence, and when there are enough of them."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..io.schemas.study import MonteCarloTable, StopTable
from .axes import Axis, Base, Coordinate, Point
from .places import Edit, Place, locate

CONFIDENCE = 0.95
"""Default confidence of intervals."""


@dataclass(frozen=True)
class Estimate:
    """Mean of a quantity over samples.

    ``half_width`` is half the confidence interval of the mean (Student's t); NaN with fewer than
    two samples.
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
    """Half width of the confidence interval of a mean of ``count`` >= 2 samples in standard
    errors."""
    from scipy.special import stdtrit

    return float(stdtrit(count - 1, 0.5 * (1.0 + confidence)))


class Stop:
    """Decides after how many samples to stop: the least number at which the intervals are narrow
    enough.

    Samples count in their order and not in that of their arrival, so that the decision does not
    depend on the workers. Failed cases do not count.

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
        """Take in the ``value`` of a ``sample`` at a ``point`` of the other axes, NaN where it
        failed.

        Counts, means and sums of squares are updated sample by sample (Welford 1962).
        """
        if self.reached or sample < self.samples:
            return
        self._waiting.setdefault(sample, {})[point] = value
        while not self.reached and len(self._waiting.get(self.samples, ())) == self._mean.size:
            values = self._waiting.pop(self.samples)
            row = np.array([values[place] for place in range(self._mean.size)])
            good = np.isfinite(row)
            self._count += good
            change = np.where(good, row - self._mean, 0.0)
            self._mean += change / np.maximum(self._count, 1.0)
            self._square += change * np.where(good, row - self._mean, 0.0)
            self.samples += 1
            half_widths = np.full(self._mean.size, math.inf)
            for place in np.flatnonzero(self._count >= 2):
                count = self._count[place]
                error = math.sqrt(self._square[place] / (count - 1.0) / count)
                half_widths[place] = student(int(count), self._table.confidence) * error
            allowed: RealArray | float | None = self._table.width
            if self._table.relative_width is not None:
                allowed = self._table.relative_width * np.abs(self._mean)
            assert allowed is not None
            self.reached = self.samples >= self._table.at_least and bool(np.all(half_widths <= allowed))


@dataclass(frozen=True)
class Uncertain:
    """One scalar at ``place`` under the column ``name``, with its distribution in SI numbers
    ``first`` and ``second``.

    These are mean and standard deviation, or the two ends.
    """

    name: str
    place: Place
    distribution: str
    first: float = 0.0
    second: float = 0.0

    def drawn(self, seed: int, number: int) -> float:
        """SI value of the sample ``number``."""
        words = np.frombuffer(hashlib.sha256(self.place.path.encode()).digest()[:16], "<u4")
        stream = np.random.SeedSequence([seed, number, *(int(word) for word in words)])
        if self.distribution == "seed":
            return float(stream.generate_state(1)[0])
        draw = np.random.default_rng(stream)
        if self.distribution == "uniform":
            return float(draw.uniform(self.first, self.second))
        if self.distribution == "normal":
            return float(draw.normal(self.first, self.second))
        spread = math.log1p((self.second / self.first) ** 2)  # variance of the logarithm
        return float(draw.lognormal(math.log(self.first) - 0.5 * spread, math.sqrt(spread)))


@dataclass(frozen=True)
class Samples(Sequence[Point]):
    """Points of the axis of samples, each made when it is asked for."""

    base: Base
    seed: int
    size: int
    scalars: tuple[Uncertain, ...]

    def __len__(self) -> int:
        return self.size

    @overload
    def __getitem__(self, number: int) -> Point: ...
    @overload
    def __getitem__(self, number: slice) -> Sequence[Point]: ...
    def __getitem__(self, number: int | slice) -> Point | Sequence[Point]:
        if isinstance(number, slice):
            return [self[index] for index in range(*number.indices(self.size))]
        if not 0 <= number < self.size:
            raise IndexError(number)
        edits: list[Edit] = []
        columns: dict[str, Coordinate] = {}
        for scalar in self.scalars:
            place, value = scalar.place, scalar.drawn(self.seed, number)
            written = place.written(value)
            content = written if place.quantity is None else value
            edits.append(Edit(place.keys, written, content))
            columns[scalar.name] = float(content)
        return Point(float(number), tuple(edits), columns)


def sample_axis(base: Base, table: MonteCarloTable, names: Sequence[str]) -> Axis:
    """Axis of the samples of ``table``, whose scalars are listed under ``names``.

    Raises
    ------
    InputError
        If a path leads nowhere, or a distribution has no such numbers.
    """
    scalars: list[Uncertain] = []
    for item, name in zip(table.random, names, strict=True):
        place = locate(base.document, item.path)
        if item.distribution == "seed":
            if not place.whole:
                raise InputError(f"{place.path} must be a whole number to be drawn as a seed, but is another scalar.")
            scalars.append(Uncertain(name, place, "seed"))
            continue
        uniform = item.distribution == "uniform"
        keys = ("low", "high") if uniform else ("mean", "deviation")
        first, second = (place.number(getattr(item, key)) for key in keys)
        if uniform and second <= first:
            raise InputError(f"high of {place.path} must be above low, but runs from {item.low!r} to {item.high!r}.")
        if not uniform:
            require.positive(second, f"deviation of {place.path}")
        if item.distribution == "lognormal":
            require.positive(first, f"mean of {place.path}")
        for number in (first, second) if uniform else (first,):
            base.edit(place, place.written(number))
        scalars.append(Uncertain(name, place, item.distribution, first, second))
    columns = {scalar.name: scalar.place.unit for scalar in scalars}
    return Axis("sample", "1", "", Samples(base, table.seed, table.samples, tuple(scalars)), False, columns)
