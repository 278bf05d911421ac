"""Engine of any array-API library, such as CuPy on a GPU: whole-array passes, free sets as
masks."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import RealArray
from .array_library import Library, compat
from .array_splines import ArraySplines, part_of, spread_over
from .protocol import (
    NEAR_CAP,
    SQUARE_SIDE,
    Clipped,
    Convolution,
    FreeSet,
    Load,
    Products,
    SplineModel,
    Splines,
    Survey,
    Totals,
    Unclipped,
    Violation,
)

# Free set of the array-API engine: a mask; vectors are arrays that are zero outside it. Methods
# without docstring: see ``protocol``.


def bound(library: Library, cap: Any, p: Any) -> Any:
    """Flat ``cap`` in a shape that fits ``p``: one number, or one for each point."""
    return library.xp.reshape(cap, p.shape if math.prod(cap.shape) > 1 else ())


@dataclass(frozen=True, eq=False)
class _ArrayFreeSet:
    """Free set ``inside``; ``start`` is its residual."""

    library: Library
    inside: Any
    start: Any
    size: int
    entering: int

    def residual(self, *, centred: bool) -> Any:
        if not (centred and self.size):
            return self.start
        mean = self.library.numbers([self._sum(self.start)])[0] / self.size
        return self.library.select(self.inside, self.start - mean)

    def zeros(self) -> Any:
        return self.library.xp.zeros_like(self.start)

    def empty(self) -> Any:
        """The residual, since nothing is changed in place."""
        return self.start

    def copy(self, vector: Any) -> Any:
        """``vector``, which nothing changes in place."""
        return vector

    def shifted(self, vector: Any, by: float) -> Any:
        return self.library.select(self.inside, vector + float(by))

    def square(self, vector: Any) -> float:
        found = self.library.numbers([self._sum(vector * vector)])[0]
        return found if math.isfinite(found) else math.nan

    def largest(self, vector: Any) -> float:
        xp = self.library.xp
        return max(0.0, self.library.numbers([xp.astype(xp.max(vector), xp.float64)])[0])

    def gather(self, values: Any) -> tuple[Any, float]:
        vector = self.library.select(self.inside, values)
        return vector, self.library.numbers([self._sum(vector)])[0]

    def gather_products(self, field: Any, a: Any, b: Any, out: Any) -> Products:
        return self.products(self.library.select(self.inside, field), a, b)

    def products(self, vector: Any, a: Any, b: Any) -> Products:
        """``vector`` with its sum and its products with a and b."""
        sums = [self._sum(vector), self._sum(vector * a), self._sum(vector * b)]
        return Products(vector, *self.library.numbers(sums))

    def scatter(self, values: Any, field: Any) -> None:
        field[...] = values

    def scatter_add(self, values: Any, factor: float, field: Any) -> None:
        field[...] = field + float(factor) * values

    def scatter_change(self, old: Any, values: Any, r: Any, field: Any) -> tuple[Any, float]:
        change = self.library.xp.astype(self.library.select(self.inside, values - old), field.dtype)
        field[...] = change
        return change, self.library.numbers([self._sum(change * r)])[0]

    def update_direction(self, z: Any, mean: float, ratio: float, t: Any, r: Any, field: Any) -> tuple[Any, float]:
        t = self.library.select(self.inside, (z - float(mean)) + float(ratio) * t)
        if field is not None:
            field[...] = t
        return t, self.library.numbers([self._sum(t * r)])[0]

    def update_solution(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any, float]:
        r = self.library.select(self.inside, r - float(length) * (kt - float(mean)))
        return d + float(length) * t, r, self.square(r)

    def add_unclipped(self, p: Any, d: Any, scale: float) -> Unclipped:
        library = self.library
        self._put(p + float(scale) * library.xp.astype(d, p.dtype), p)
        tensions = library.select(self.inside & (p < 0.0), -p)
        carried = library.select(self.inside & (p > 0.0), p)
        tensile, *sums = library.numbers([library.count(tensions > 0.0), self._sum(tensions), self._sum(carried)])
        return Unclipped(int(tensile), *sums)

    def clear_tension(self, p: Any, factor: float, scale: float) -> Any:
        """p = factor max(p, 0) and the change over scale."""
        value = self.library.select(self.inside & (p > 0.0), float(factor) * p)
        change = self.library.select(self.inside, value - p) / float(scale)
        self._put(value, p)
        return self.library.xp.astype(change, self.start.dtype)

    def loaded(self, values: Any, total: float | None, vector: Any) -> tuple[FreeSet, Any, Any]:
        library, inside = self.library, self.inside & (values > 0.0)
        values = library.select(inside, values)
        size, carried = library.numbers([library.count(inside), self._sum(values)])
        if total is not None and size:
            values = values * (total / carried)
        left = _ArrayFreeSet(library, inside, library.xp.zeros_like(self.start), int(size), 0)
        return left, values, library.select(inside, vector)

    def spread(self, left: Any, values: Any) -> Any:
        """``values``, which are zero on the other points."""
        return values

    def change(self, values: Any, before: Any, scale: float) -> Any:
        return self.library.xp.astype((values - before) / float(scale), self.start.dtype)

    def put(self, values: Any, p: Any) -> None:
        self._put(values, p)

    def add_clipped(self, p: Any, d: Any, scale: float, cap: Any) -> Clipped:
        library = self.library
        moved = p + float(scale) * library.xp.astype(d, p.dtype)
        value = library.select(moved > 0.0, moved)
        if cap is not None:
            value = library.xp.minimum(value, bound(library, cap, p))
        clipped = self.inside & (value != moved)
        self._put(value, p)
        return Clipped(self._load(p, cap), int(library.numbers([library.count(clipped)])[0]))

    def rescale(self, p: Any, factor: float, shift: float, cap: Any) -> Load:
        moved = float(factor) * p + float(shift)
        if cap is not None:
            most = bound(self.library, cap, p)
            moved = self.library.xp.where(moved < NEAR_CAP * most, moved, most)
            moved = self.library.xp.where(p < most, moved, p)
        self._put(moved, p)
        return self._load(p, cap)

    def interpolate(self, old: Any, share: float, values: Any) -> None:
        self._put(old + float(share) * (values - old), values)

    def _put(self, vector: Any, values: Any) -> None:
        values[...] = self.library.xp.where(self.inside, vector, values)

    def _load(self, p: Any, cap: Any) -> Load:
        below = self.inside if cap is None else self.inside & (p < bound(self.library, cap, p))
        sums = [self._sum(self.library.select(self.inside, p)), self._sum(self.library.select(below, p))]
        pressure, movable, number = self.library.numbers([*sums, self.library.count(below)])
        return Load(pressure, movable, int(number))

    def _sum(self, values: Any) -> Any:
        """Sum in double precision."""
        return self.library.xp.sum(values, dtype=self.library.xp.float64)


# Survey of an iterate of the array-API engine.


@dataclass(frozen=True, eq=False)
class _ArraySurvey:
    """One iterate seen as a whole."""

    library: Library
    totals: Totals
    p: Any
    u: Any
    h: Any
    cap: Any

    @cached_property
    def squares(self) -> RealArray:
        r, movable = self.u - self.h, (self.p > 0.0) & ~self._capped
        sums = [
            self._in_squares(self.library.xp.astype(movable, r.dtype)),
            self._in_squares(self.library.select(movable, r)),
            self._in_squares(self.library.select(movable, r * r)),
        ]
        return np.stack(sums, axis=-1)

    @property
    def _capped(self) -> Any:
        loaded = self.p > 0.0
        return loaded & (self.p >= bound(self.library, self.cap, self.p)) if self.cap is not None else loaded & ~loaded

    def free_set(self, levels: RealArray, level: float, scale: float, dtype: str) -> _ArrayFreeSet:
        library, xp, (nx, ny) = self.library, self.library.xp, self.p.shape
        on_device = (library.array(levels[..., bound_of], "float64") for bound_of in (0, 1))
        low, high = (
            xp.repeat(xp.repeat(values, SQUARE_SIDE, axis=0), SQUARE_SIDE, axis=1)[:nx, :ny] for values in on_device
        )
        r, movable = self.u - self.h, (self.p > 0.0) & ~self._capped
        entering = ((self.p == 0.0) & (r < low)) | (self._capped & (r > high))
        inside = movable | entering
        start = (float(level) - r) * (1.0 / float(scale))
        start = library.select(inside, xp.astype(start, getattr(xp, dtype)))
        size, arrived = library.numbers([library.count(inside), library.count(entering)])
        return _ArrayFreeSet(library, inside, start, int(size), int(arrived))

    def _in_squares(self, values: Any) -> RealArray:
        """Sums over squares of SQUARE_SIDE points a side."""
        library, (nx, ny) = self.library, values.shape
        bands, squares = -(-nx // SQUARE_SIDE), -(-ny // SQUARE_SIDE)
        whole = library.zeros((bands * SQUARE_SIDE, squares * SQUARE_SIDE), "float64")
        whole[:nx, :ny] = values
        blocks = library.xp.reshape(whole, (bands, SQUARE_SIDE, squares, SQUARE_SIDE))
        return library.numpy(library.xp.sum(blocks, axis=(1, 3)))


def _totals(library: Library, p: Any, u: Any, h: Any, cap: Any) -> Totals:
    xp, select, numbers = library.xp, library.select, library.numbers
    r = u - h
    p = select(p > 0.0, p)
    sums = [xp.sum(p), xp.sum(p * u), xp.sum(p * r), xp.min(r)]
    if cap is None:
        pressure, deflected, work, lowest = numbers(sums)
        return Totals(pressure, deflected, work, pressure, work, lowest, -math.inf, lowest)
    loaded = p > 0.0
    capped = loaded & (p >= bound(library, cap, p))
    inner = select(~capped, p)
    sums += [
        xp.min(select(~loaded, r, math.inf)),
        xp.sum(inner),
        xp.sum(inner * r),
        xp.max(select(capped, r, -math.inf)),
    ]
    pressure, deflected, work, lowest, lowest_open, weight, weighted, highest_capped = numbers(sums)
    return Totals(pressure, deflected, work, weight, weighted, lowest, highest_capped, lowest_open)


class ArrayEngine:
    """Engine on the arrays of a library that follows the array-API standard with its ``fft``
    extension.

    Parameters
    ----------
    namespace
        The library, such as the module ``cupy``. Its arrays must be writable and may be float64.
    device
        Device in the library's own words; its default device if not given.
    """

    def __init__(self, namespace: Any, *, device: Any = None) -> None:
        self._library = library = Library.of(namespace, device)
        self._fft = library.xp.fft
        where = str(compat().device(library.zeros((1, 1), "float64"))).strip("<>")
        self.name = f"{namespace.__name__} ({where})"

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` on the device."""
        return self._library.array(values, dtype)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        return self._library.numpy(values)

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""
        return self._library.zeros(shape, dtype)

    field = zeros
    separate_memory = False

    def resident(self, values: Any) -> Any:
        """``values`` itself: arrays of other libraries do not take the operations of NumPy."""
        return values

    def total(self, values: Any) -> float:
        """Sum of the ``values``."""
        return self._library.numbers([self._library.xp.sum(values, dtype=self._library.xp.float64)])[0]

    def copy(self, values: Any) -> Any:
        """New array equal to ``values``."""
        return self._library.xp.asarray(values, copy=True)

    def convolution(
        self, kernel: RealArray, shape: tuple[int, int], dtype: str, padded: tuple[int, int] | None = None
    ) -> Convolution:
        """Periodic convolution, or free with pruned transforms."""
        return _Convolution(self._fft, self.array(kernel, dtype), shape, padded or shape)

    def splines(self, shape: tuple[int, int], model: SplineModel, dtype: str) -> Splines:
        """Nested splines."""
        return ArraySplines(self._library, model, dtype)

    def prolonged(self, coarse: Any, coarse_heights: RealArray, heights: RealArray, stiffness: float) -> Any:
        """Pressure on the points of ``heights`` from a coarser one."""
        xp, fine = self._library.xp, self.array(heights, "float64")
        nx, ny = fine.shape
        p, base = (
            xp.repeat(xp.repeat(self.array(values, "float64"), 2, axis=0), 2, axis=1)[:nx, :ny]
            for values in (coarse, coarse_heights)
        )
        raised = p + float(stiffness) * (fine - base)
        return self.numpy(self._library.select((p > 0.0) & (raised > 0.0), raised))

    def interpolated(self, coarse: Any, shape: tuple[int, int], wraps: tuple[bool, bool]) -> RealArray:
        """Values between coarser points."""
        xp, values = self._library.xp, self.array(coarse, "float64")
        for axis in (0, 1):
            n = values.shape[axis]
            first, last = part_of(values, axis, 0, 1), part_of(values, axis, n - 1, n)
            before, after = (last, first) if wraps[axis] else (first, last)
            before = xp.concat([before, part_of(values, axis, 0, n - 1)], axis=axis)
            after = xp.concat([part_of(values, axis, 1, n), after], axis=axis)
            values = spread_over(xp, axis, values, before, after, shape[axis])
        return self.numpy(values)

    def survey(self, p: Any, u: Any, h: Any, cap: Any) -> Survey:
        """Survey of an iterate."""
        double = self._library.xp.float64
        p, u, h = (self._library.xp.astype(values, double, copy=False) for values in (p, u, h))
        return _ArraySurvey(self._library, _totals(self._library, p, u, h, cap), p, u, h, cap)

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        xp, select, numbers = self._library.xp, self._library.select, self._library.numbers
        gap = u - h - float(level)
        p = select(p > 0.0, p)
        above = xp.sum(select(gap > 0.0, gap) * p)
        if cap is None:
            first, deepest = numbers([above, xp.max(select(gap < 0.0, -gap))])
            return Violation(first, math.inf if deepest > 0.0 else 0.0, deepest)
        room = bound(self._library, cap, p) - p
        overlap = select((gap < 0.0) & (room > 0.0), -gap)
        return Violation(*numbers([above, xp.sum(overlap * room), xp.max(overlap)]))

    def add(self, field: Any, factor: float, values: Any) -> None:
        """values += factor field."""
        values[...] = values + float(factor) * self._library.xp.astype(field, values.dtype)

    def clear_field(self, free: FreeSet, field: Any) -> None:
        """Zero everywhere."""
        field[...] = 0.0


@dataclass(eq=False)
class _Convolution:
    """Transform, product with the kernel, transform back; along y only the rows that hold data."""

    fft: Any
    kernel: Any
    shape: tuple[int, int]
    padded: tuple[int, int]

    def apply(self, field: Any, out: Any) -> Any:
        fft, factor, (mx, my) = self.fft, self.kernel, self.padded
        if self.shape == self.padded:
            out[...] = fft.irfftn(fft.rfftn(field, axes=(0, 1)) * factor, s=(mx, my), axes=(0, 1))
            return out
        nx, ny = self.shape
        spectrum = fft.fft(fft.rfft(field, n=my, axis=1), n=mx, axis=0) * factor
        out[...] = fft.irfft(fft.ifft(spectrum, axis=0)[:nx, :], n=my, axis=1)[:, :ny]
        return out
