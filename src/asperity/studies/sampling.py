"""Samples of uncertain scalars: the value of a sample depends on the seed, its number and its path, and on nothing else."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np

from ..core import require
from ..core.errors import InputError
from ..io.schemas.study import MonteCarloTable, RandomTable
from .axes import Axis, Base, Coordinate, Point, numeric_edit
from .edits import Edit
from .places import Place, locate


@dataclass(frozen=True)
class Uncertain:
    """One scalar at ``place`` under the column ``name``, with its distribution in SI numbers ``first`` and ``second``.

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
            edit = numeric_edit(scalar.place, scalar.drawn(self.seed, number))
            edits.append(edit)
            columns[scalar.name] = float(edit.content)
        return Point(float(number), tuple(edits), columns)


def sample_axis(base: Base, table: MonteCarloTable, names: Sequence[str]) -> Axis:
    """Axis of the samples of ``table``, whose scalars are listed under ``names``.

    Raises
    ------
    InputError
        If a path leads nowhere, or a distribution has no such numbers.
    """
    scalars = tuple(_uncertain(base, item, name) for item, name in zip(table.random, names, strict=True))
    columns = {scalar.name: scalar.place.unit for scalar in scalars}
    return Axis("sample", "1", "", Samples(base, table.seed, table.samples, scalars), False, columns)


def _uncertain(base: Base, table: RandomTable, name: str) -> Uncertain:
    place = locate(base.document, table.path)
    if table.distribution == "seed":
        if not place.whole:
            raise InputError(f"{place.path} must be a whole number to be drawn as a seed, but is another scalar.")
        return Uncertain(name, place, "seed")
    keys = ("low", "high") if table.distribution == "uniform" else ("mean", "deviation")
    first, second = (place.number(getattr(table, key)) for key in keys)
    if table.distribution == "uniform":
        if second <= first:
            raise InputError(f"high of {place.path} must be above low, but runs from {table.low!r} to {table.high!r}.")
    else:
        require.positive(second, f"deviation of {place.path}")
    if table.distribution == "lognormal":
        require.positive(first, f"mean of {place.path}")
    for number in (first, second) if table.distribution == "uniform" else (first,):
        base.edit(place, place.written(number))
    return Uncertain(name, place, table.distribution, first, second)
