"""Engine of any array-API library, such as CuPy on a GPU: whole-array passes, free sets as masks."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import Any, cast

import numpy as np

from ..arrays import RealArray
from ..errors import InputError
from .protocol import (
    NEAR_CAP,
    SQUARE_SIDE,
    Cells,
    Clipped,
    CoarseCompliance,
    Convolution,
    FreeSet,
    Hierarchy,
    Load,
    Merge,
    Products,
    Totals,
    Unclipped,
    Violation,
)

# An array-API library with the few operations that depend on the device.


@dataclass(frozen=True)
class Library:
    """Array-API namespace ``xp`` with the few operations that depend on the device."""

    xp: Any
    device: Any

    @classmethod
    def of(cls, namespace: Any, device: Any) -> Library:
        """Library of the module ``namespace``; its gaps to the standard are filled by array_api_compat."""
        if not hasattr(namespace, "zeros") or not hasattr(namespace, "__name__"):
            raise InputError(f"namespace of ArrayEngine must be a module such as cupy, but is {namespace!r}.")
        probe = namespace.zeros(1)
        xp = compat().array_namespace(probe)
        if not hasattr(xp, "fft"):
            raise _unfit("Fourier transforms", namespace)
        try:
            probe[...] = 1.0
        except TypeError:
            raise _unfit("writable arrays", namespace) from None
        return cls(xp, device)

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` on the device."""
        host = np.ascontiguousarray(values, dtype=dtype)
        return self.xp.asarray(host, dtype=getattr(self.xp, dtype), device=self.device)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        adapters = compat()
        if adapters.is_numpy_array(values):
            return np.asarray(values)
        if adapters.is_cupy_array(values) or adapters.is_torch_array(values):
            return np.asarray(adapters.to_device(values, "cpu"))
        host = cast(RealArray, np.from_dlpack(values, device="cpu"))
        return host if host.flags.writeable else host.copy()  # numpy 2.1 gives an array that cannot be written to

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""
        return self.xp.zeros(shape, dtype=getattr(self.xp, dtype), device=self.device)

    def numbers(self, scalars: list[Any]) -> list[float]:
        """Double-precision ``scalars`` of the device as Python numbers, in one transfer."""
        return [float(value) for value in self.numpy(self.xp.stack(scalars))]

    def select(self, mask: Any, values: Any, other: float = 0.0) -> Any:
        """``values`` where ``mask``, else ``other``."""
        return self.xp.where(mask, values, self.xp.full((), other, dtype=values.dtype, device=self.device))

    def count(self, mask: Any) -> Any:
        """Number of points of ``mask`` as a double."""
        return self.xp.sum(self.xp.astype(mask, self.xp.uint8), dtype=self.xp.float64)


def bound(library: Library, cap: Any, p: Any) -> Any:
    """Flat ``cap`` in a shape that fits ``p``: one number, or one for each point."""
    return library.xp.reshape(cap, p.shape if math.prod(cap.shape) > 1 else ())


def _unfit(what: str, namespace: Any) -> InputError:
    return InputError(
        f"namespace of ArrayEngine must be a library with {what}, but is {namespace.__name__}. Use for example cupy."
    )


def compat() -> Any:
    """array_api_compat; only who uses an array engine imports it."""
    return import_module("array_api_compat")


# Free set of the array-API engine: a mask; vectors are arrays that are zero outside it. Methods without docstring: see ``protocol``.


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


# Nested cells of the array-API engine: whole arrays per level (see ``cell_kernels`` for the algorithm).


class _ArrayCells:
    """Inverse of nested cells on a free set; see ``cell_kernels`` for the coarse correction."""

    def __init__(
        self,
        library: Library,
        hierarchies: tuple[Hierarchy, Hierarchy],
        coarse: CoarseCompliance | None,
        product: Convolution | None,
        dtype: str,
    ) -> None:
        self._library = library
        self._hierarchies = hierarchies
        self._coarse = coarse
        self._product = product
        self._dtype = dtype
        self._factors: tuple[tuple[list[Any], list[Any]], ...] = ()

    def factorise(self, free: FreeSet) -> None:
        """g and T of all cells for the points of ``free``."""
        assert isinstance(free, _ArrayFreeSet)
        xp = self._library.xp
        unit = xp.astype(free.inside, getattr(xp, self._dtype))
        self._factors = tuple(
            self._factorised(hierarchy.merges, xp.roll(unit, hierarchy.roll, axis=(0, 1)))
            for hierarchy in self._hierarchies
        )

    def solve(self, free: FreeSet, r: Any, other: Any, out: Any) -> Products:
        assert isinstance(free, _ArrayFreeSet)
        z = r - self._library.select(free.inside, self._mean_deflection(self._factors, r))
        return free.products(z, r, other)

    def predicted_residual(self, free: FreeSet, r: Any, loaded: FreeSet, change: Any, factor: float) -> Any:
        assert isinstance(free, _ArrayFreeSet)
        ones: tuple[tuple[list[Any], list[Any]], ...]
        ones = tuple(([1.0] * len(hierarchy.merges), []) for hierarchy in self._hierarchies)
        return r - float(factor) * self._library.select(free.inside, self._mean_deflection(ones, change))

    def _mean_deflection(self, factors: tuple[tuple[list[Any], list[Any]], ...], load: Any) -> Any:
        """Mean over the hierarchies of the deflection of the points by the cells they lie in."""
        roll, deflection = self._library.xp.roll, self._library.xp.zeros_like(load)
        for hierarchy, (g, units) in zip(self._hierarchies, factors, strict=True):
            back = (-hierarchy.roll[0], -hierarchy.roll[1])
            moved = self._deflected(hierarchy.merges, g, units, roll(load, hierarchy.roll, axis=(0, 1)))
            deflection = deflection + roll(moved, back, axis=(0, 1))
        return deflection / float(len(self._hierarchies))

    def _factorised(self, merges: tuple[Merge, ...], passed: Any) -> tuple[list[Any], list[Any]]:
        """g = 1 / (1 + w T) and T on every level of a hierarchy, from the sums ``passed`` up by single points."""
        levels, units = [], []
        for merge in merges:
            units.append(self._summed(passed, merge))
            levels.append(1.0 / (1.0 + merge.weight * units[-1]))
            passed = levels[-1] * units[-1]
        return levels, units

    def _deflected(self, merges: tuple[Merge, ...], g: list[Any], units: list[Any], passed: Any) -> Any:
        """Deflection of points by the cells they lie in under the loads ``passed`` up by them; coarse-corrected with ``units``."""
        if self._coarse is None or not units:
            return self._by_cells(merges, g, passed)
        depth, sums, shapes = self._coarse.depth, [], []
        for merge, stiff in zip(merges[:depth], g, strict=False):
            shapes.append(passed.shape)
            sums.append(self._summed(passed, merge))
            passed = stiff * sums[-1]
        deflection = self._coarse_corrected(merges[depth - 1 :], g[depth - 1 :], units[depth - 1], sums[-1])
        for level in range(depth - 1, -1, -1):
            deflection = _spread(self._library.xp, deflection, merges[level], shapes[level])
            if level > 0:
                deflection = g[level - 1] * (deflection + merges[level - 1].weight * sums[level - 1])
        return deflection

    def _coarse_corrected(self, merges: tuple[Merge, ...], g: list[Any], unit: Any, total: Any) -> Any:
        """Deflection of the cells of the coarse level, the first of those given, under the loads ``total``."""
        xp, sum_of = self._library.xp, self._library.xp.sum
        guess = self._of_level(merges, g, total)
        residual = guess - self._convolved(total - unit * guess)
        step = residual - self._of_level(merges, g, unit * residual)
        t = unit * step
        curvature = sum_of(t * (step + self._convolved(t)), dtype=xp.float64)
        product = sum_of(t * residual, dtype=xp.float64)
        safe = xp.where(curvature > 0.0, curvature, xp.ones_like(curvature))
        return guess - xp.astype(xp.where(curvature > 0.0, product / safe, xp.zeros_like(product)), t.dtype) * step

    def _of_level(self, merges: tuple[Merge, ...], g: list[Any], total: Any) -> Any:
        """Deflection of the cells of the first level given, under the loads ``total``, by nested cells from there on."""
        return g[0] * (self._by_cells(merges[1:], g[1:], g[0] * total) + merges[0].weight * total)

    def _convolved(self, loads: Any) -> Any:
        """True deflection of cells under ``loads``."""
        assert self._coarse is not None
        assert self._product is not None
        (nx, ny), out = loads.shape, self._library.zeros(self._coarse.cells, self._dtype)
        out[:nx, :ny] = loads
        return self._product.apply(out, out)[:nx, :ny]

    def _by_cells(self, merges: tuple[Merge, ...], g: list[Any], passed: Any) -> Any:
        """Deflection of parts by the cells they lie in under the loads ``passed`` up by them."""
        sums, shapes = [], []
        for merge, stiff in zip(merges, g, strict=True):
            shapes.append(passed.shape)
            sums.append(self._summed(passed, merge))
            passed = stiff * sums[-1]
        deflection = self._library.xp.zeros_like(passed)
        for merge, stiff, total, shape in reversed(list(zip(merges, g, sums, shapes, strict=True))):
            deflection = _spread(self._library.xp, stiff * (deflection + merge.weight * total), merge, shape)
        return deflection

    def _summed(self, values: Any, merge: Merge) -> Any:
        """Sums over the parts of every cell."""
        xp = self._library.xp
        for axis, pairs, offset in ((0, merge.x, merge.offset_x), (1, merge.y, merge.offset_y)):
            if not pairs:
                continue
            n = values.shape[axis]
            before, after = offset, (n + offset) % 2
            values = xp.concat([_rim(xp, values, axis, before), values, _rim(xp, values, axis, after)], axis=axis)
            halves = (n + before + after) // 2
            split = (halves, 2, values.shape[1]) if axis == 0 else (values.shape[0], halves, 2)
            values = xp.sum(xp.reshape(values, split), axis=axis + 1)
        return values


def _rim(xp: Any, values: Any, axis: int, width: int) -> Any:
    shape = (width, values.shape[1]) if axis == 0 else (values.shape[0], width)
    return xp.zeros(shape, dtype=values.dtype, device=values.device)


def _spread(xp: Any, values: Any, merge: Merge, shape: tuple[int, int]) -> Any:
    """Value of every cell on each of its parts, which are of ``shape``."""
    if merge.x:
        values = xp.repeat(values, 2, axis=0)[merge.offset_x : merge.offset_x + shape[0], :]
    if merge.y:
        values = xp.repeat(values, 2, axis=1)[:, merge.offset_y : merge.offset_y + shape[1]]
    return values


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

    @classmethod
    def of(cls, library: Library, p: Any, u: Any, h: Any, cap: Any) -> _ArraySurvey:
        """Survey of an iterate."""
        return cls(library, _totals(library, p, u, h, cap), p, u, h, cap)

    @cached_property
    def squares(self) -> RealArray:
        r, movable = self.u - self.h, self._movable
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

    @property
    def _movable(self) -> Any:
        return (self.p > 0.0) & ~self._capped

    def free_set(self, levels: RealArray, level: float, scale: float, dtype: str) -> _ArrayFreeSet:
        library, xp, (nx, ny) = self.library, self.library.xp, self.p.shape
        on_device = (library.array(levels[..., bound_of], "float64") for bound_of in (0, 1))
        low, high = (
            xp.repeat(xp.repeat(values, SQUARE_SIDE, axis=0), SQUARE_SIDE, axis=1)[:nx, :ny] for values in on_device
        )
        r, movable = self.u - self.h, self._movable
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
    """Engine on the arrays of a library that follows the array-API standard with its ``fft`` extension.

    Parameters
    ----------
    namespace
        The library, such as the module ``cupy``. Its arrays must be writable and may be float64.
    device
        Device in the library's own words; its default device if not given.
    """

    def __init__(self, namespace: Any, *, device: Any = None) -> None:
        self._library = library = Library.of(namespace, device)
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

    def copy(self, values: Any) -> Any:
        """New array equal to ``values``."""
        return self._library.xp.asarray(values, copy=True)

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution."""
        return _Convolution(self._library, kernel, shape, shape, dtype)

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution with pruned transforms."""
        return _Convolution(self._library, kernel, shape, padded, dtype)

    def cells(
        self,
        shape: tuple[int, int],
        hierarchies: tuple[Hierarchy, Hierarchy],
        coarse: CoarseCompliance | None,
        dtype: str,
    ) -> Cells:
        """Nested cells."""
        product = None
        if coarse is not None:
            product = _Convolution(self._library, coarse.kernel, coarse.cells, coarse.padded, dtype)
        return _ArrayCells(self._library, hierarchies, coarse, product, dtype)

    def prolonged(
        self, coarse: RealArray, coarse_heights: RealArray, heights: RealArray, stiffness: float
    ) -> RealArray:
        """Pressure on the points of ``heights`` from a coarser one."""
        xp, fine = self._library.xp, self.array(heights, "float64")
        nx, ny = fine.shape
        p, base = (
            xp.repeat(xp.repeat(self.array(values, "float64"), 2, axis=0), 2, axis=1)[:nx, :ny]
            for values in (coarse, coarse_heights)
        )
        raised = p + float(stiffness) * (fine - base)
        return self.numpy(self._library.select((p > 0.0) & (raised > 0.0), raised))

    def survey(self, p: Any, u: Any, h: Any, cap: Any) -> _ArraySurvey:
        """Survey of an iterate."""
        double = self._library.xp.float64
        p, u, h = (self._library.xp.astype(values, double, copy=False) for values in (p, u, h))
        return _ArraySurvey.of(self._library, p, u, h, cap)

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


class _Convolution:
    """Transform, product with the kernel, transform back; along y only the rows that hold data."""

    def __init__(
        self, library: Library, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> None:
        self._library = library
        self._kernel = library.array(kernel, dtype)
        self._mean_factor = 0.5 / float(kernel.max() or 1.0)
        self._shape = shape
        self._padded = padded

    @cached_property
    def _inverse(self) -> Any:
        kernel = self._library.numpy(self._kernel).copy()
        kernel[0, 0] = 1.0 / self._mean_factor
        return self._library.array(1.0 / kernel, str(kernel.dtype))

    def apply(self, field: Any, out: Any) -> Any:
        return self._multiply(field, self._kernel, out)

    def solve(self, field: Any, out: Any) -> Any:
        return self._multiply(field, self._inverse, out)

    def _multiply(self, field: Any, factor: Any, out: Any) -> Any:
        fft, (mx, my) = self._library.xp.fft, self._padded
        if self._shape == self._padded:
            out[...] = fft.irfftn(fft.rfftn(field, axes=(0, 1)) * factor, s=(mx, my), axes=(0, 1))
            return out
        nx, ny = self._shape
        spectrum = fft.fft(fft.rfft(field, n=my, axis=1), n=mx, axis=0) * factor
        out[...] = fft.irfft(fft.ifft(spectrum, axis=0)[:nx, :], n=my, axis=1)[:, :ny]
        return out
