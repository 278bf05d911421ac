"""Engine of the CPU: FFT library with threads, compiled fused passes on blocks, vectors compressed to the free set."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from itertools import pairwise
from typing import Any
from weakref import ref

import numpy as np

from ..arrays import RealArray
from ..spectral import PaddedTransform, RealTransform, fft_library, thread_count
from .cell_layout import layout
from .corrected_cells import CorrectedCells
from .protocol import (
    SQUARE_SIDE,
    Cells,
    Clipped,
    CoarseCompliance,
    Convolution,
    FreeSet,
    Hierarchy,
    Load,
    Products,
    Totals,
    Unclipped,
    Violation,
)

# Threads for compiled passes: fixed blocks of work, shared out evenly.


SERIAL_BELOW = 1 << 17
"""Points below which handing work to another thread costs more than it saves. Two threads on grids of 256² points took
half as long again as one, on 512² they make no difference, above they gain (two-core virtual machine)."""


class Blocks:
    """Runs compiled passes with a given number of threads. Numba takes long to import, so only when something runs."""

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None

    @cached_property
    def kernels(self) -> Any:
        """Passes over whole arrays and over free sets."""
        return import_module(".kernels", __package__)

    @cached_property
    def cell_kernels(self) -> Any:
        """Sweeps over nested cells, with and without coarse correction."""
        return import_module(".cell_kernels", __package__)

    def run(self, kernel: Callable[..., None], size: int, *arguments: Any) -> None:
        """Call ``kernel`` over all blocks of ``size`` elements."""
        blocks = -(-size // self.kernels.BLOCK)
        self.share(kernel, blocks, *arguments, serial=size < SERIAL_BELOW)

    def share(self, kernel: Callable[..., None], parts: int, *arguments: Any, serial: bool) -> None:
        """Call ``kernel`` over ``parts`` parts of equal work, shared by the threads unless ``serial``."""
        if self._pool is None or serial:
            kernel((0, parts), *arguments)
            return
        shares = min(self.threads, parts)
        cuts = [parts * i // shares for i in range(shares + 1)]
        own, *others = pairwise(cuts)
        jobs = [self._pool.submit(kernel, span, *arguments) for span in others]
        kernel(own, *arguments)
        for job in jobs:
            job.result()

    def sums(self, kernel: Callable[..., None], size: int, columns: int, *arguments: Any) -> RealArray:
        """Per-block sums (blocks, columns) that ``kernel`` leaves in its last argument."""
        blocks = -(-size // self.kernels.BLOCK)
        partial = np.zeros((blocks, columns))
        self.share(kernel, blocks, *arguments, partial, serial=size < SERIAL_BELOW)
        return partial


# Free set of the CPU engine: indices of its points, vectors as compressed arrays. Methods without docstring: see ``protocol``.


ROW_PAD = 16
"""Gap in floats (one cache line) between the rows of a field in single precision, see ``CpuEngine.field``."""

_PADDED_FROM = 1024
"""Points in a row from which on there is such a gap: 1024² single floats take 3.3 ms a pair with it and 12.4 without, 512² and smaller
grids the same, and the places of a free set are those in any other array."""

_MANY = 0.05
"""Share of its points on which it takes longer to clear a field than to clear it as a whole."""

_NO_CAP = np.full(1, np.inf)
_CROWDED = 0.05
"""Share of points in the free set from which on cells are swept as whole rows. Below it a call takes 0.94 of the time at a load of 0.01 (512² and 1024²);
with the groups found at a tenth of the area as well, 1.03."""

_NO_ROWS = np.empty(0, np.int64)
_ZERO = {dtype: np.zeros(1, dtype) for dtype in ("float32", "float64")}


@dataclass(frozen=True, eq=False)
class _CpuFreeSet:
    """Free set of points at the flat ``index`` (ascending) of arrays of ``shape``; ``start`` is its residual, of the ``sums`` (parts,).

    ``rows`` (nx + 1,): where the points of every row begin in ``index``, and the number of points.
    """

    blocks: Blocks
    shape: tuple[int, int]
    index: Any
    start: RealArray
    sums: RealArray
    rows: Any
    entering: int

    @property
    def size(self) -> int:
        return int(self.index.size)

    @cached_property
    def _index_in_padded_rows(self) -> Any:
        gaps = ROW_PAD * np.arange(self.shape[0], dtype=self.index.dtype)
        return self.index + gaps.repeat(np.diff(self.rows))

    def place(self, field: RealArray) -> Any:
        """Indices of the points in the memory of ``field``."""
        return self.index if field.flags.c_contiguous else self._index_in_padded_rows

    def residual(self, *, centred: bool) -> RealArray:
        if centred and self.size:
            self.start[...] -= float(self.sums.sum()) / self.size
            self.sums[...] = 0.0
        return self.start

    def zeros(self) -> RealArray:
        return np.zeros_like(self.start)

    def empty(self) -> RealArray:
        return np.empty_like(self.start)

    def copy(self, vector: RealArray) -> RealArray:
        return vector.copy()

    def square(self, vector: RealArray) -> float:
        with np.errstate(over="ignore"):
            found = float(np.dot(vector, vector))
        return found if np.isfinite(found) else np.nan

    def largest(self, vector: RealArray) -> float:
        return float(vector.max(initial=0.0))

    def gather(self, values: RealArray) -> tuple[RealArray, float]:
        out = np.empty(self.size, values.dtype)
        return out, self._sums("gather", 1, self.index, values.ravel(), out)[0]

    def gather_products(self, field: RealArray, a: RealArray, b: RealArray, out: RealArray) -> Products:
        total, first, second = self._sums("gather_products", 3, self.place(field), memory(field), a, b, out)
        return Products(out, total, first, second)

    def scatter(self, values: RealArray, field: RealArray) -> None:
        self._run("scatter", self.place(field), values, memory(field))

    def scatter_add(self, values: RealArray, factor: float, field: RealArray) -> None:
        self._run("scatter_add", self.place(field), values, values.dtype.type(factor), memory(field))

    def scatter_change(
        self, old: RealArray, values: RealArray, r: RealArray, field: RealArray
    ) -> tuple[RealArray, float]:
        change = np.empty_like(r)
        arguments = (self.index, self.place(field), old, values.ravel(), r, change, memory(field))
        return change, self._sums("scatter_change", 1, *arguments)[0]

    def update_direction(
        self, z: RealArray, mean: float, ratio: float, t: RealArray, r: RealArray, field: RealArray
    ) -> tuple[RealArray, float]:
        kind = t.dtype.type
        arguments = (self.place(field), z, kind(mean), kind(ratio), t, r, memory(field))
        return t, self._sums("update_direction", 1, *arguments)[0]

    def update_solution(
        self, length: float, t: RealArray, kt: RealArray, mean: float, d: RealArray, r: RealArray
    ) -> tuple[RealArray, RealArray, float]:
        kind = t.dtype.type
        return d, r, self._sums("update_solution", 1, kind(length), t, kt, kind(mean), d, r)[0]

    def add_unclipped(self, p: RealArray, d: RealArray, scale: float) -> Unclipped:
        tensile, *sums = self._sums("add_unclipped", 3, self.index, p.ravel(), d, scale)
        return Unclipped(int(tensile), *sums)

    def clear_tension(self, p: RealArray, factor: float, scale: float) -> RealArray:
        """p = factor max(p, 0) and the change over scale, in the memory of the residual."""
        self._run("clear_tension", self.index, p.ravel(), factor, scale, self.start)
        return self.start

    def add_clipped(self, p: RealArray, d: RealArray, scale: float, cap: RealArray | None) -> Clipped:
        total, movable, below, number = self._sums("add_clipped", 4, self.index, p.ravel(), d, scale, bound(cap))
        return Clipped(Load(total, movable, int(below)), int(number))

    def rescale(self, p: RealArray, factor: float, shift: float, cap: RealArray | None) -> Load:
        total, movable, below = self._sums("rescale", 3, self.index, p.ravel(), factor, shift, bound(cap))
        return Load(total, movable, int(below))

    def interpolate(self, old: RealArray, share: float, values: RealArray) -> None:
        self._run("interpolate", self.index, old, share, values.ravel())

    def _run(self, kernel: str, *arguments: Any) -> None:
        self.blocks.run(getattr(self.blocks.kernels, kernel), self.size, *arguments)

    def _sums(self, kernel: str, columns: int, *arguments: Any) -> list[float]:
        found = self.blocks.sums(getattr(self.blocks.kernels, kernel), self.size, columns, *arguments)
        sums: list[float] = (found.sum(axis=0) if len(found) != 1 else found[0]).tolist()
        return sums


def _index_type(shape: tuple[int, int]) -> Any:
    """Type of indices in arrays of ``shape`` and in fields with gaps between rows."""
    return np.uint32 if shape[0] * (shape[1] + ROW_PAD) < 2**31 else np.int64


def memory(field: RealArray) -> RealArray:
    """All memory of a field made by ``CpuEngine.field``, gaps between rows included; of others the field itself."""
    base = field if field.flags.c_contiguous or not isinstance(field.base, np.ndarray) else field.base
    return base.reshape(-1)


def bound(cap: RealArray | None) -> RealArray:
    """Flat cap for the kernels: one value for all points, infinity for none, or one for each."""
    return _NO_CAP if cap is None else cap.ravel()


# Nested cells of the CPU engine: all levels of all hierarchies in one piece of memory.


_Way = tuple[int, int, int, int]
"""First and last level of sums, last of deflections, and whether to factorise, see ``cell_kernels.sweep``."""


class CpuCells:
    """Exact inverse of nested cells on a free set (see ``cell_kernels``), a hierarchy per thread."""

    def __init__(
        self, blocks: Blocks, shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy], dtype: str
    ) -> None:
        self._blocks = blocks
        self._shape = shape
        self.levels, size, self._whole, groups = layout(shape, hierarchies)
        self._runs, self._full = self._whole, np.empty(len(hierarchies) * groups, np.uint8)
        self._swept: Callable[[], FreeSet | None] = lambda: None
        self.weights = np.array([1.0, *(merge.weight for merge in hierarchies[0].merges)], dtype)
        self.g = np.zeros(size, dtype)
        self.s = np.zeros(size, dtype)
        self._nothing = np.empty(0, dtype)

    @cached_property
    def _all(self) -> RealArray:
        """g of cells that pass everything on: 1, and 0 on the rims."""
        g = np.zeros_like(self.g)
        for start, nx, ny, stride in self.levels[:, 1:, :4].reshape(-1, 4):
            g[start : start + nx * stride].reshape(nx, stride)[:, :ny] = 1.0
        return g

    def factorise(self, free: FreeSet) -> None:
        """g of all cells for the points of ``free``."""
        last = len(self.weights) - 1
        if self._swept() is not free:
            self._occupy(free)
        self._sweep(free, self._nothing, self.g, (1, last, last + 1, 1))

    def solve(self, free: FreeSet, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``, see ``protocol.Cells``."""
        self._sweep(free, r, self.g, self._cycle)
        return self.at_points(free, r, other, out)

    def factorise_with(self, free: FreeSet, conductance: RealArray) -> None:
        """g of all cells for the points of ``free``, which yield by the ``conductance`` (of any sign) times their own load, instead of by it."""
        last = len(self.weights) - 1
        self._occupy(free)
        self._sweep(free, conductance, self.g, (1, last, last + 1, 1))

    def solve_with(self, free: FreeSet, r: RealArray, conductance: RealArray) -> RealArray:
        """Inverse times ``r`` after ``factorise_with`` the same."""
        self._sweep(free, conductance * r, self.g, self._cycle)
        vector: RealArray = self.at_points(free, r, r, np.empty_like(r)).vector
        return conductance * vector

    def predicted_residual(
        self, free: FreeSet, r: RealArray, loaded: FreeSet, change: RealArray, factor: float
    ) -> RealArray:
        """r - factor times the deflection of the cells."""
        self._occupy(free, loaded)
        self._sweep(loaded, change * change.dtype.type(factor), self._all, self._cycle)
        return np.asarray(self.at_points(free, r, r, np.empty_like(r)).vector)

    def at_points(self, free: FreeSet, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """``r`` less the deflections of the finest cells that lie in s."""
        assert isinstance(free, _CpuFreeSet)
        sums = np.empty((self._shape[0], 3))
        arguments = (self.levels, self._shape, free.rows, free.index, r, other, self.s, out, sums)
        subtract = self._blocks.cell_kernels.subtract_deflections
        self._blocks.share(subtract, self._shape[0], *arguments, serial=free.size < SERIAL_BELOW)
        return Products(out, *sums.sum(axis=0).tolist())

    @property
    def serial(self) -> bool:
        """Whether both hierarchies are swept by one thread."""
        return self.g.size < SERIAL_BELOW

    @property
    def _cycle(self) -> _Way:
        return 1, len(self.weights) - 1, 1, 0

    def level(self, number: int, depth: int) -> RealArray:
        """Sums or deflections s of the cells of the level ``depth`` of one hierarchy, (cells along x, along y)."""
        start, nx, ny, stride = self.levels[number, depth, :4]
        return self.s[start : start + nx * stride].reshape(nx, stride)[:, :ny]

    def sweep_one(self, number: int, free: FreeSet, values: RealArray, way: _Way) -> None:
        """Sweep of one hierarchy."""
        assert isinstance(free, _CpuFreeSet)
        points = free.rows, free.index
        self._blocks.cell_kernels.sweep(
            (number, number + 1),
            self.levels,
            self.weights,
            way,
            self._shape,
            points,
            values,
            self._runs,
            self.g,
            self.s,
        )

    def _occupy(self, free: FreeSet, other: FreeSet | None = None) -> None:
        """Sweep the cells of ``free`` from here on, and those of the ``other`` set."""
        assert isinstance(free, _CpuFreeSet)
        self._swept = ref(free)
        if free.size > _CROWDED * math.prod(self._shape):
            self._runs = self._whole
            return
        if self._runs is self._whole:
            self._runs = self._whole.copy()  # all cells may hold something: they will be cleared
        points, more = (free.rows, free.index), (_NO_ROWS, free.index)
        if other is not None:
            assert isinstance(other, _CpuFreeSet)
            more = other.rows, other.index
        arguments = (self.levels, self._shape, points, more, self._full, self._runs, self.g, self.s)
        self._blocks.share(self._blocks.cell_kernels.occupy, len(self.levels), *arguments, serial=self.serial)

    def _sweep(self, free: FreeSet, values: RealArray, g: RealArray, way: _Way) -> None:
        assert isinstance(free, _CpuFreeSet)
        arguments = (
            self.levels,
            self.weights,
            way,
            self._shape,
            (free.rows, free.index),
            values,
            self._runs,
            g,
            self.s,
        )
        self._blocks.share(self._blocks.cell_kernels.sweep, len(self.levels), *arguments, serial=self.serial)


class CpuEngine:
    """The usual engine. ``threads``: see ``core.spectral.thread_count``."""

    def __init__(self, threads: int | None = None) -> None:
        _keep_freed_memory()
        self.threads = thread_count(threads)
        self.blocks = Blocks(self.threads)
        self.name = f"cpu ({fft_library()}, {self.threads} thread{'s' if self.threads > 1 else ''})"

    def array(self, values: RealArray | float, dtype: str) -> RealArray:
        """Contiguous NumPy array of ``values``."""
        return np.ascontiguousarray(values, dtype=dtype)

    def numpy(self, values: Any) -> RealArray:
        """``values`` itself."""
        return np.asarray(values)

    def zeros(self, shape: tuple[int, int], dtype: str) -> RealArray:
        """Array of zeros."""
        return np.zeros(shape, dtype)

    def copy(self, values: RealArray) -> RealArray:
        """New array equal to ``values``."""
        return np.array(values)

    def field(self, shape: tuple[int, int], dtype: str) -> RealArray:
        """Field of zeros; in single precision with a gap of ``ROW_PAD`` between long rows.

        Rows of 2^k floats map to the same cache lines, which doubles the time of ducc0's last transform back.
        """
        pad = ROW_PAD if dtype == "float32" and shape[1] >= _PADDED_FROM else 0
        return np.zeros((shape[0], shape[1] + pad), dtype)[:, : shape[1]]

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution."""
        return _Convolution(self.blocks, RealTransform(shape, self.threads_for(shape)), kernel, dtype)

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution with pruned transforms."""
        return _Convolution(self.blocks, PaddedTransform(shape, padded, self.threads_for(padded)), kernel, dtype)

    def threads_for(self, shape: tuple[int, int]) -> int:
        """Threads for transforms of this ``shape``."""
        return self.threads if shape[0] * shape[1] >= SERIAL_BELOW else 1

    def points(self, shape: tuple[int, int], index: Any, dtype: str) -> FreeSet:
        """Free set of the points at the flat ``index`` (ascending) of a grid of ``shape``, with a residual of zero."""
        rows = np.searchsorted(index, np.arange(shape[0] + 1) * shape[1])
        index = index.astype(_index_type(shape))
        return _CpuFreeSet(self.blocks, shape, index, np.zeros(index.size, dtype), np.zeros(1), rows, 0)

    def cells(
        self,
        shape: tuple[int, int],
        hierarchies: tuple[Hierarchy, Hierarchy],
        coarse: CoarseCompliance | None,
        dtype: str,
    ) -> Cells:
        """Nested cells. Two hierarchies are swept side by side, so their transforms share the threads."""
        cells = CpuCells(self.blocks, shape, hierarchies, dtype)
        if coarse is None:
            return cells
        threads = max(1, self.threads // len(hierarchies))
        parts = coarse.cells, coarse.padded
        transform = RealTransform(parts[0], threads) if parts[0] == parts[1] else PaddedTransform(*parts, threads)
        serial = Blocks(1)
        products = tuple(_Convolution(serial, transform, coarse.kernel, dtype) for _ in hierarchies)
        return CorrectedCells(self.blocks, cells, coarse, products, dtype)

    def prolonged(
        self, coarse: RealArray, coarse_heights: RealArray, heights: RealArray, stiffness: float
    ) -> RealArray:
        """Pressure on the points of ``heights`` from a coarser one."""
        out = np.empty_like(heights)
        fine = _read_only(heights).reshape(heights.shape)
        arguments = (coarse, coarse_heights, fine, stiffness, out)
        self.blocks.share(self.blocks.kernels.prolong_pressure, len(out), *arguments, serial=out.size < SERIAL_BELOW)
        return out

    def survey(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None) -> _CpuSurvey:
        """Survey of an iterate."""
        nx, ny = p.shape
        flat = p.ravel(), u.ravel(), _read_only(h)
        squares = np.zeros((-(-nx // SQUARE_SIDE), -(-ny // SQUARE_SIDE), 3))
        s = np.zeros((len(squares), 4 if cap is None else 8))
        kernels, serial = self.blocks.kernels, p.size < SERIAL_BELOW
        if cap is None:
            self.blocks.share(kernels.survey, len(s), *flat, ny, SQUARE_SIDE, s, squares, serial=serial)
            pressure, deflected, work = (float(v) for v in s[:, :3].sum(axis=0))
            lowest = float(s[:, 3].min())
            totals = Totals(pressure, deflected, work, pressure, work, lowest, -np.inf, lowest)
        else:
            self.blocks.share(
                kernels.survey_capped, len(s), *flat, bound(cap), ny, SQUARE_SIDE, s, squares, serial=serial
            )
            pressure, deflected, work, weight, weighted = (float(v) for v in s[:, :5].sum(axis=0))
            bounds = float(s[:, 5].min()), float(s[:, 6].max()), float(s[:, 7].min())
            totals = Totals(pressure, deflected, work, weight, weighted, *bounds)
        return _CpuSurvey(totals, self.blocks, (nx, ny), *flat, cap, squares)

    def violation(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        arguments = (p.ravel(), u.ravel(), _read_only(h), bound(cap), level)
        s = self.blocks.sums(self.blocks.kernels.violation, p.size, 3, *arguments)
        return Violation(float(s[:, 0].sum()), float(s[:, 1].sum()), float(s[:, 2].max()))

    def beyond(self, late: RealArray, early: RealArray, ratio: float) -> RealArray:
        """late + ratio (late - early), a new array."""
        out = np.empty_like(late)
        self.blocks.run(self.blocks.kernels.beyond, out.size, late.ravel(), early.ravel(), ratio, out.ravel())
        return out

    def add(self, field: RealArray, factor: float, values: RealArray) -> None:
        """values += factor field."""
        row, stride = field.shape[1], field.strides[0] // field.itemsize
        arguments = (memory(field), row, stride, factor, values.ravel())
        self.blocks.share(self.blocks.kernels.add, len(field), *arguments, serial=values.size < SERIAL_BELOW)

    def clear_field(self, free: FreeSet, field: RealArray) -> None:
        """field = 0 on the set, or everywhere where that is quicker."""
        assert isinstance(free, _CpuFreeSet)
        if free.size > _MANY * field.size:
            field[...] = 0.0
            return
        self.blocks.run(
            self.blocks.kernels.scatter, free.size, free.place(field), _ZERO[field.dtype.name], memory(field)
        )


_LARGEST_KEPT = (1 << 25) - (1 << 13)
"""Bytes of an array up to which the allocator of glibc learns to keep what is freed: 32 MiB less what it stores itself."""


@cache
def _keep_freed_memory() -> None:
    """Let the allocator keep the memory of freed fields of up to 32 MiB for the next ones, instead of giving it back to the system each time.

    glibc does so for sizes that have once been freed, and then keeps at most twice as much free; an array of this size that is freed unused costs
    nothing. New pages for fields of every solve took 16 % of the time of a call at 512², 13 % at 256² and 1024². Other allocators take no notice.
    """
    np.empty(_LARGEST_KEPT, np.uint8)


@dataclass(frozen=True, eq=False)
class _CpuSurvey:
    """Sums over an iterate of flat fields."""

    totals: Totals
    blocks: Blocks
    shape: tuple[int, int]
    p: RealArray
    u: RealArray
    h: RealArray
    cap: RealArray | None
    squares: RealArray

    def free_set(self, levels: RealArray, level: float, scale: float, dtype: str) -> _CpuFreeSet:
        kernels, size, row = self.blocks.kernels, self.p.size, self.shape[1]
        mask, counts = np.empty(-(-size // 8) * 8, np.uint8), np.empty(len(levels), np.int64)
        mask[size:] = 0
        rows = np.zeros(self.shape[0] + 1, np.int64)
        flat, found = (self.p, self.u, self.h), rows[1:]
        if self.cap is None:
            lines = levels[..., 0].repeat(SQUARE_SIDE, axis=1)
            self._share(kernels.mark_free_elastic, *flat, SQUARE_SIDE, lines, self.squares, mask, found, counts)
        else:
            self._share(kernels.mark_free, *flat, bound(self.cap), SQUARE_SIDE, levels, mask, found, counts)
        np.cumsum(found, out=found)
        starts = np.empty(len(levels) + 1, np.int64)
        starts[:-1], starts[-1] = rows[:-1:SQUARE_SIDE], rows[-1]
        index = np.empty(int(rows[-1]), _index_type(self.shape))
        residual, sums = np.empty(index.size, dtype), np.empty(len(levels))
        masks, length = (mask, mask.view(np.uint64)), SQUARE_SIDE // 8 * row  # words in a band of squares
        self._share(kernels.fill_free, self.u, self.h, (level, scale), length, masks, starts, index, residual, sums)
        return _CpuFreeSet(self.blocks, self.shape, index, residual, sums, rows, int(counts.sum()))

    def _share(self, kernel: Any, *arguments: Any) -> None:
        self.blocks.share(kernel, len(self.squares), *arguments, serial=self.p.size < SERIAL_BELOW)


class _Convolution:
    """Transform, fused product with the kernel, transform back."""

    def __init__(
        self, blocks: Blocks, transform: RealTransform | PaddedTransform, kernel: RealArray, dtype: str
    ) -> None:
        self._blocks = blocks
        self._transform = transform
        self._kernel = np.ascontiguousarray(kernel, dtype=dtype).ravel()
        self._spectrum = np.empty(transform.spectrum_shape, np.complex128 if dtype == "float64" else np.complex64)
        self._parts = self._spectrum.view(dtype).ravel()  # real and imaginary in turn

    def apply(self, field: RealArray, out: RealArray) -> RealArray:
        return self._product(field, self._kernel, out)

    def solve(self, field: RealArray, out: RealArray) -> RealArray:
        return self._product(field, self._inverse, out)

    @cached_property
    def _inverse(self) -> RealArray:
        """One over the kernel; for the mean, see ``protocol``."""
        inverse = np.empty_like(self._kernel)
        np.divide(1.0, self._kernel[1:], out=inverse[1:])
        inverse[0] = 0.5 / float(self._kernel.max() or 1.0)
        return inverse

    def _product(self, field: RealArray, kernel: RealArray, out: RealArray) -> RealArray:
        spectrum = self._transform.forward(field, self._spectrum)
        self._blocks.run(self._blocks.kernels.scale_spectrum, kernel.size, self._parts, kernel)
        return self._transform.backward(spectrum, out)


def _read_only(values: RealArray) -> RealArray:
    """Flat view that cannot be written to: passes are compiled once, whatever heights a user brings."""
    flat = values.ravel()
    flat.setflags(write=False)
    return flat
