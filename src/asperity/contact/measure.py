"""Measures of a contact: connected islands, spots in pixels, distributions, stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.engine import FreeSet
from ..core.errors import InputError
from .operators import Operator
from .solvers.active_set.linear_system import LinearSystem, ScaledOperator, Stopping, conjugate_gradients

Labels = NDArray[np.integer[Any]]
"""Number of the island of each pixel, from 1; zero outside all."""


def labelled(mask: BoolArray, *, wraps: tuple[bool, bool], diagonal: bool = False) -> tuple[Labels, int]:
    """Label the islands of ``mask`` (nx, ny) and count them.

    Pixels are joined by edges, with ``diagonal`` by corners too; along x and along y also across
    the border where the map ``wraps``.
    """
    from scipy.ndimage import label

    found, islands = label(mask, np.ones((3, 3)) if diagonal else None)  # without regard to what lies across the border
    labels: Labels = np.asarray(found)
    count = int(islands)
    if count == 0 or not any(wraps):
        return labels, count
    # the number from 0 of the island to which each label belongs across the border
    pairs: list[tuple[Labels, Labels]] = []  # of neighbours on both sides of the borders that wrap
    for axis in (axis for axis in (0, 1) if wraps[axis]):
        low_side, high_side = np.asarray(labels.take(0, axis)), np.asarray(labels.take(-1, axis))
        pairs.append((low_side, high_side))
        if diagonal and wraps[1 - axis]:
            pairs += [(low_side, np.roll(high_side, shift)) for shift in (1, -1)]
        elif diagonal:
            pairs += [(low_side[1:], high_side[:-1]), (low_side[:-1], high_side[1:])]
    first, last = (np.concatenate(lines) for lines in zip(*pairs, strict=True))
    joined = (first > 0) & (last > 0)
    parent: dict[int, int] = {}  # an island joined to one of a smaller label; those without are on their own

    def root(island: int) -> int:
        while island in parent:
            parent[island] = parent.get(parent[island], parent[island])  # the next search is half as long
            island = parent[island]
        return island

    numbers = np.unique((first[joined] - 1) * np.int64(count) + (last[joined] - 1))  # each once, as one number
    for pair in numbers.tolist():
        low, high = sorted((root(pair // count), root(pair % count)))
        if low != high:
            parent[high] = low
    if not parent:
        return labels, count
    alone = np.ones(count, dtype=bool)
    alone[list(parent)] = False
    whole = np.cumsum(alone) - 1
    for island in parent:
        whole[island] = whole[root(island)]
    names = np.concatenate([[0], whole + 1]).astype(labels.dtype)
    return names.take(labels), count - len(parent)


def island_sizes(mask: BoolArray, *, wraps: tuple[bool, bool]) -> Labels:
    """Number of pixels of every island of ``mask`` (nx, ny), joined by edges, in the order of their
    labels.

    The same as to count the pixels of each label, in one compiled pass and without a map of labels.
    """
    from ..core.engine import kernels

    nx, ny = mask.shape
    most = nx * ((ny + 1) // 2) + 1
    lines, parent, sizes = np.empty((2, ny), np.int64), np.empty(most, np.int64), np.empty(most, np.int64)
    count = kernels.island_sizes(np.ascontiguousarray(mask), wraps, lines, parent, sizes)
    return sizes[:count].copy()


def spans(labels: Labels, *, wraps: tuple[bool, bool]) -> BoolArray:
    """Whether each island, (count,) in the order of the labels, reaches all across the map along x
    or along y.

    Where the map wraps, an island that has pixels in every row or column goes round it or nearly
    so.
    """
    count = int(labels.max(initial=0))
    reaching = np.zeros(count + 1, dtype=bool)
    for axis in (0, 1):
        if labels.shape[axis] == 1:
            continue
        if wraps[axis]:
            lines = np.zeros((count + 1, labels.shape[axis]), dtype=bool)
            lines[labels, np.indices(labels.shape)[axis]] = True
            reaching |= lines.all(axis=1)
        else:
            both = np.intersect1d(labels.take(0, axis), labels.take(-1, axis))
            reaching[both] = True
    return reaching[1:]


def contact_spots(contact: BoolArray, *, wraps: tuple[bool, bool]) -> RealArray:
    """Number of pixels of every contact spot (pixels joined by edges), largest first."""
    return np.sort(island_sizes(contact, wraps=wraps))[::-1].astype(float)


@dataclass(frozen=True, eq=False)
class Distribution:
    """Histogram: bin ``edges`` (n + 1) and probability ``density`` (n) per unit of the quantity;
    integrates to one."""

    edges: RealArray
    density: RealArray


def distribution(values: RealArray, bins: int = 50) -> Distribution:
    """Probability density of ``values`` (any shape, at least one) from 0 to their maximum in equal
    ``bins``.

    Serves the gap (``distribution(result.gap[~result.contact])``) and the contact pressure alike.

    Raises
    ------
    InputError
        If there is no value or ``bins`` is not a whole number >= 1.
    """
    bins = require.integer(bins, 1, "number of bins")
    if values.size == 0:
        raise InputError("values of a distribution must hold at least one number, but are empty.")
    density, edges = np.histogram(values, bins, range=(0.0, float(values.max()) or 1.0), density=True)
    return Distribution(edges, density)


# Stiffness.

_STOPPING = Stopping(reduction=1e-4, max_steps=500)


def normal_stiffness(operator: Operator, moving: BoolArray) -> float:
    """Incremental stiffness d(mean pressure)/d(approach) in Pa/m, from one linear solve on the
    points ``moving`` (nx, ny).

    Infinite for full contact on a periodic half-space, zero without elastic contact points, NaN if
    the linear solve does not converge. They are the points of elastic contact: those at the cap
    yield and carry no increment (loading). The error is of second order in the relative residual,
    which is 1e-4: what remains is the rounding of single precision, below 1e-6.
    """
    if not moving.any():
        return 0.0
    if moving.all() and operator.zero_mean_mode:
        return math.inf
    found = Response.of(operator, moving).solved()
    if found.values is None:
        return math.nan
    return found.total / operator.grid.n_points


class Response(NamedTuple):
    """Pressure that moves some points as prescribed: the set ``free`` of them, the ``scaled``
    operator, the ``values`` on the set, None where it is not solved, the FFT ``pairs`` it took, and
    of the rise less that found the largest ``error`` and the mean ``level``, both in m as the
    solution carries them along."""

    free: FreeSet
    scaled: ScaledOperator
    values: Any = None
    pairs: float = 0.0
    error: float = math.inf
    level: float = 0.0

    @classmethod
    def of(cls, operator: Operator, moving: BoolArray, dtype: str = "float32") -> Self:
        """Not solved yet, on the points ``moving`` (nx, ny), at least one, in the precision
        ``dtype``."""
        engine, shape = operator.engine, operator.grid.shape
        scaled = ScaledOperator.of(operator, dtype, operator.largest or 1.0)
        p, flat = engine.array(moving.astype(float), "float64"), engine.zeros(shape, "float64")
        survey = engine.survey(p, flat, flat, None)  # u = h: no point enters, and the residual is the level
        free = survey.free_set(np.zeros((*survey.squares.shape[:2], 2)), 1.0, 1.0, scaled.dtype)
        return cls(free, scaled)

    def solved(self, rise: RealArray | None = None, *, zero_sum: bool = False, stopping: Stopping = _STOPPING) -> Self:
        """With the pressure under which the points rise by ``rise`` (nx, ny) in m, by 1 m without
        one; no values if the linear solve does not converge.

        With ``zero_sum`` the pressure sums to zero, and the points rise by that up to a constant;
        ``rise`` must have the mean zero on them.
        """
        r = self.free.residual(centred=False) if rise is None else self._vector(rise)
        found = conjugate_gradients(LinearSystem(self.scaled, self.free, zero_sum=zero_sum), r, stopping)
        engine = self.scaled.engine
        engine.clear_field(self.free, self.scaled.field)
        if not found.reached:
            return self._replace(values=None, pairs=found.pairs)
        error = float(np.abs(np.asarray(engine.numpy(found.residual))).max())
        return self._replace(values=found.d, pairs=found.pairs, error=error, level=found.level)

    def preconditioned(self, rise: RealArray) -> RealArray:
        """Approximate pressure (nx, ny) for a ``rise`` (nx, ny) of the points, in the units and the
        precision of ``scaled``: the preconditioner's, once the model of the compliance is
        factorised. The next call overwrites it."""
        r = self._vector(rise)
        system = LinearSystem(self.scaled, self.free, zero_sum=False)
        self.free.scatter(system.preconditioned(r, r, self.free.empty()).vector, self.scaled.field)
        return np.asarray(self.scaled.engine.numpy(self.scaled.field))

    def _vector(self, values: RealArray) -> Any:
        return self.free.gather(self.scaled.engine.array(values, self.scaled.dtype))[0]

    @property
    def total(self) -> float:
        """Sum of the pressure in Pa."""
        self.free.scatter(self.values, self.scaled.field)
        products = self.free.gather_products(self.scaled.field, self.values, self.values, self.free.empty())
        return products.total / self.scaled.scale

    @property
    def pressure(self) -> RealArray:
        """(nx, ny) in Pa, zero on all other points."""
        engine = self.scaled.engine
        self.free.scatter(self.values, self.scaled.field)
        return np.asarray(engine.numpy(self.scaled.field), dtype=float) / self.scaled.scale
