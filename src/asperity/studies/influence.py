"""What a sweep says as a whole: which axis decides a quantity, and where all limits hold."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.arrays import BoolArray, RealArray


@dataclass(frozen=True)
class Influence:
    """Share of the variance of a quantity over all cases that each axis makes by itself.

    Attributes
    ----------
    shares
        Name of the axis and its share, the largest first.
    together
        The rest: what axes make together, beyond the sum of what each makes.
    logarithmic
        Whether the variance is that of the logarithm: of quantities that are positive throughout.
    """

    shares: tuple[tuple[str, float], ...]
    together: float
    logarithmic: bool


def influence(values: RealArray, names: Sequence[str]) -> Influence | None:
    """Influence of the axes ``names`` on the ``values`` on them; None where these do not vary, or
    a case is missing.

    The shares are those of a full factorial: the variance of the mean over all other axes (Sobol'
    1993, eq. 9, with all points of an axis alike).
    """
    if not np.isfinite(values).all() or values.size < 2:
        return None
    logarithmic = bool((values > 0.0).all())
    used = np.log(values) if logarithmic else values
    variance = float(used.var())
    if not variance > (1e-9 * max(1.0, float(np.abs(used).max()))) ** 2:
        return None
    shares = []
    for axis, name in enumerate(names):
        others = tuple(other for other in range(values.ndim) if other != axis)
        shares.append((name, float(used.mean(axis=others).var()) / variance))
    shares.sort(key=lambda each: -each[1])
    return Influence(tuple(shares), max(0.0, 1.0 - sum(share for _, share in shares)), logarithmic)


@dataclass(frozen=True)
class Region:
    """Where all limits hold.

    Attributes
    ----------
    fitting, cases
        Numbers of cases within all limits, and of all.
    ranges
        First and last point, on each axis, of the largest block of cases of which all are within
        the limits; empty where there is none.
    """

    fitting: int
    cases: int
    ranges: tuple[tuple[int, int], ...]


MOST_BLOCKS = 200_000
"""Blocks that are looked at; on larger grids those that begin at coarser steps."""


def region(within: BoolArray) -> Region:
    """Region of the cases ``within`` all limits, on the axes of a study; points of an axis in their
    order."""
    fitting = int(np.count_nonzero(within))
    if not fitting:
        return Region(0, within.size, ())
    sums = np.pad(within.astype(np.int64), [(1, 0)] * within.ndim)
    for axis in range(within.ndim):
        sums = sums.cumsum(axis=axis)
    spans = []
    step = 1
    while math.prod(len(_ranges(length, step)) for length in within.shape) > MOST_BLOCKS:
        step += 1
    spans = [_ranges(length, step) for length in within.shape]
    best, largest = ((0, 0),) * within.ndim, 0
    for block in itertools.product(*spans):
        size = math.prod(last - first + 1 for first, last in block)
        if size > largest and _count(sums, block) == size:
            best, largest = block, size
    if not largest:  # steps too coarse for any block: one case
        at = tuple(int(number) for number in np.argwhere(within)[0])
        best = tuple((number, number) for number in at)
    return Region(fitting, within.size, best)


def _ranges(length: int, step: int) -> list[tuple[int, int]]:
    ends = sorted({*range(0, length, step), length - 1})
    return [(first, last) for first in ends for last in ends if last >= first]


def _count(sums: np.ndarray, block: Sequence[tuple[int, int]]) -> int:
    """Cases within the limits in a ``block``, by inclusion and exclusion."""
    total = 0
    for corner in itertools.product((0, 1), repeat=len(block)):
        place = tuple(last + 1 if side else first for side, (first, last) in zip(corner, block, strict=True))
        total += (-1) ** (len(block) - sum(corner)) * int(sums[place])
    return total
