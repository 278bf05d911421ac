"""Engine of the CPU: FFT library with threads, compiled fused passes on blocks, vectors compressed
to the free set."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import RealArray
from ..spectral import PaddedTransform, RealTransform, fft_library, thread_count
from .blocks import SERIAL_BELOW, Blocks
from .protocol import (
    SQUARE_SIDE,
    Clipped,
    Convolution,
    FreeSet,
    Load,
    Products,
    SplineModel,
    Totals,
    Unclipped,
    Violation,
)

if TYPE_CHECKING:
    from .splines import CpuSplines

# Free set of the CPU engine: indices of its points, vectors as compressed arrays. Methods without
# docstring: see ``protocol``.


ROW_PAD = 16
"""Gap in floats (one cache line) between the rows of a field in single precision, see
``CpuEngine.field``."""

_PADDED_FROM = 1024
"""Points in a row from which on there is such a gap: 1024² single floats take 3.3 ms a pair with it
and 12.4 without, 512² and smaller grids the same, and the places of a free set are those in any
other array."""

_MANY = 0.05
"""Share of its points on which it takes longer to clear a field than to clear it as a whole."""

_NO_CAP = np.full(1, np.inf)
_ZERO = {np.dtype(name): np.zeros(1, name) for name in ("float32", "float64")}


@dataclass(frozen=True, eq=False)
class _CpuFreeSet:
    """Free set of points at the flat ``index`` (ascending) of arrays of ``shape``; ``start`` is its
    residual, of the ``sums`` (parts,).

    ``rows`` (nx + 1,): where the points of every row begin in ``index``, and the number of points;
    ``kept``: the places of its points in the set from which they were taken by ``loaded``, if they
    were.
    """

    blocks: Blocks
    shape: tuple[int, int]
    index: Any
    start: RealArray
    sums: RealArray
    rows: Any
    size: int
    entering: int
    kept: Any = None

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
        return np.zeros(self.size, self.start.dtype)

    def empty(self) -> RealArray:
        return np.empty(self.size, self.start.dtype)

    def copy(self, vector: RealArray) -> RealArray:
        return vector.copy()

    def shifted(self, vector: RealArray, by: float) -> RealArray:
        return vector + by

    def square(self, vector: RealArray) -> float:
        with np.errstate(over="ignore"):
            found = float(np.dot(vector, vector))
        return found if np.isfinite(found) else np.nan

    def largest(self, vector: RealArray) -> float:
        return float(vector.max(initial=0.0))

    def gather(self, values: RealArray) -> tuple[RealArray, float]:
        found = values.reshape(-1).take(self.index)
        return found, float(found.sum())

    def gather_products(self, field: RealArray, a: RealArray, b: RealArray, out: RealArray) -> Products:
        total, first, second = self._sums("gather_products", 3, self.place(field), memory(field), a, b, out)
        return Products(out, total, first, second)

    def products(self, vector: RealArray, a: RealArray, b: RealArray) -> Products:
        return Products(vector, *self._sums("products", 3, vector, a, b))

    def scatter(self, values: RealArray, field: RealArray) -> None:
        self.blocks.run(self.blocks.kernels.scatter, self.size, self.place(field), values, memory(field))

    def scatter_add(self, values: RealArray, factor: float, field: RealArray) -> None:
        arguments = (self.place(field), values, values.dtype.type(factor), memory(field))
        self.blocks.run(self.blocks.kernels.scatter_add, self.size, *arguments)

    def scatter_change(
        self, old: RealArray, values: RealArray, r: RealArray, field: RealArray
    ) -> tuple[RealArray, float]:
        change = np.empty_like(r)
        arguments = (self.index, self.place(field), old, values.ravel(), r, change, memory(field))
        return change, self._sums("scatter_change", 1, *arguments)[0]

    def update_direction(
        self, z: RealArray, mean: float, ratio: float, t: RealArray, r: RealArray, field: RealArray | None
    ) -> tuple[RealArray, float]:
        kind = t.dtype.type
        if field is None:  # of a model, after others have been compiled: no pass of its own to wait for
            # as in compiled passes; what comes of it is seen in the sums
            with np.errstate(over="ignore", invalid="ignore"):
                t *= kind(ratio)
                t += z
                t -= kind(mean)
            return t, self.products(t, r, r).first
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
        arguments = (self.index, p.ravel(), factor, scale, self.start)
        self.blocks.run(self.blocks.kernels.clear_tension, self.size, *arguments)
        return self.start

    def loaded(self, values: RealArray, total: float | None, vector: RealArray) -> tuple[FreeSet, RealArray, RealArray]:
        kept = np.flatnonzero(values > 0.0)  # these take half the time of masks
        values, r, index = values.take(kept), vector.take(kept), self.index.take(kept)
        if total is not None and kept.size:
            values *= total / float(values.sum())
        rows = np.searchsorted(kept, self.rows)
        kept = kept if self.kept is None else self.kept.take(kept)
        residual, sums = np.zeros_like(r), np.zeros(1)
        return _CpuFreeSet(self.blocks, self.shape, index, residual, sums, rows, r.size, 0, kept), values, r

    def spread(self, left: Any, values: RealArray) -> RealArray:
        found = np.zeros(self.size, values.dtype)
        found[left.kept] = values
        return found

    def change(self, values: RealArray, before: RealArray, scale: float) -> RealArray:
        found = values - before
        found *= 1.0 / scale
        return found.astype(self.start.dtype)

    def put(self, values: RealArray, p: RealArray) -> None:
        p.reshape(-1)[self.index.astype(np.intp)] = values  # twice as fast as with short indices

    def add_clipped(self, p: RealArray, d: RealArray, scale: float, cap: RealArray | None) -> Clipped:
        total, movable, below, number = self._sums("add_clipped", 4, self.index, p.ravel(), d, scale, bound(cap))
        return Clipped(Load(total, movable, int(below)), int(number))

    def rescale(self, p: RealArray, factor: float, shift: float, cap: RealArray | None) -> Load:
        total, movable, below = self._sums("rescale", 3, self.index, p.ravel(), factor, shift, bound(cap))
        return Load(total, movable, int(below))

    def interpolate(self, old: RealArray, share: float, values: RealArray) -> None:
        self.blocks.run(self.blocks.kernels.interpolate, self.size, self.index, old, share, values.ravel())

    def _sums(self, kernel: str, columns: int, *arguments: Any) -> list[float]:
        """Sums over the set that a kernel leaves block by block in its last argument."""
        kernels, serial = self.blocks.kernels, self.size < SERIAL_BELOW
        found = np.zeros((-(-self.size // kernels.BLOCK), columns))
        self.blocks.share(getattr(kernels, kernel), len(found), *arguments, found, serial=serial)
        sums: list[float] = (np.add.reduce(found) if len(found) != 1 else found[0]).tolist()
        return sums


def memory(field: RealArray) -> RealArray:
    """All memory of a field made by ``CpuEngine.field``, gaps between rows included; of others the
    field itself."""
    base = field if field.flags.c_contiguous or not isinstance(field.base, np.ndarray) else field.base
    return base.reshape(-1)


def bound(cap: RealArray | None) -> RealArray:
    """Flat cap for the kernels: one value for all points, infinity for none, or one for each."""
    return _NO_CAP if cap is None else cap.ravel()


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

    separate_memory = False

    def resident(self, values: RealArray) -> RealArray:
        """``values`` itself."""
        return values

    def total(self, values: RealArray) -> float:
        """Sum of the ``values``."""
        return float(values.sum())

    def copy(self, values: RealArray) -> RealArray:
        """New array equal to ``values``."""
        return np.array(values)

    def field(self, shape: tuple[int, int], dtype: str) -> RealArray:
        """Field of zeros; in single precision with a gap of ``ROW_PAD`` between long rows.

        Rows of 2^k floats map to the same cache lines, which doubles the time of ducc0's last
        transform back.
        """
        pad = ROW_PAD if dtype == "float32" and shape[1] >= _PADDED_FROM else 0
        return np.zeros((shape[0], shape[1] + pad), dtype)[:, : shape[1]]

    def convolution(
        self, kernel: RealArray, shape: tuple[int, int], dtype: str, padded: tuple[int, int] | None = None
    ) -> Convolution:
        """Periodic convolution, or free with pruned transforms."""
        threads = self.threads_for(padded or shape)
        if padded is None:
            return _Convolution(self.blocks, RealTransform(shape, threads), kernel, dtype)
        return _Convolution(self.blocks, PaddedTransform(shape, padded, threads), kernel, dtype)

    def threads_for(self, shape: tuple[int, int]) -> int:
        """Threads for transforms of this ``shape``."""
        return self.threads if shape[0] * shape[1] >= SERIAL_BELOW else 1

    def points(self, shape: tuple[int, int], index: Any, dtype: str) -> FreeSet:
        """Free set of the points at the flat ``index`` (ascending) of a grid of ``shape``, with a
        residual of zero."""
        rows = np.searchsorted(index, np.arange(shape[0] + 1) * shape[1])
        index = index.astype(np.uint32 if shape[0] * (shape[1] + ROW_PAD) < 2**31 else np.int64)
        return _CpuFreeSet(self.blocks, shape, index, np.zeros(index.size, dtype), np.zeros(1), rows, index.size, 0)

    def splines(self, shape: tuple[int, int], model: SplineModel, dtype: str) -> CpuSplines:
        """Nested splines, whose compiled sweeps are imported when they are first needed."""
        prepared: CpuSplines = import_module(".splines", __package__).CpuSplines(self.blocks, shape, model, dtype)
        return prepared

    def prolonged(
        self, coarse: RealArray, coarse_heights: RealArray, heights: RealArray, stiffness: float
    ) -> RealArray:
        """Pressure on the points of ``heights`` from a coarser one."""
        out = np.empty_like(heights)
        fine = _read_only(heights).reshape(heights.shape)
        arguments = (coarse, coarse_heights, fine, stiffness, out)
        self.blocks.share(self.blocks.kernels.prolong_pressure, len(out), *arguments, serial=out.size < SERIAL_BELOW)
        return out

    def interpolated(self, coarse: RealArray, shape: tuple[int, int], wraps: tuple[bool, bool]) -> RealArray:
        """Values between coarser points."""
        out = np.empty(shape)
        values, kernel = np.ascontiguousarray(coarse, float), self.blocks.kernels.interpolate_rows
        self.blocks.share(kernel, len(out), values, wraps, out, serial=out.size < SERIAL_BELOW)
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
            pressure, deflected, work, _ = np.add.reduce(s).tolist()
            lowest = float(s[:, 3].min())
            totals = Totals(pressure, deflected, work, pressure, work, lowest, -np.inf, lowest)
        else:
            self.blocks.share(
                kernels.survey_capped, len(s), *flat, bound(cap), ny, SQUARE_SIDE, s, squares, serial=serial
            )
            pressure, deflected, work, weight, weighted, *_ = np.add.reduce(s).tolist()
            bounds = float(s[:, 5].min()), float(s[:, 6].max()), float(s[:, 7].min())
            totals = Totals(pressure, deflected, work, weight, weighted, *bounds)
        return _CpuSurvey(totals, self.blocks, (nx, ny), *flat, cap, squares)

    def violation(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        arguments = (p.ravel(), u.ravel(), _read_only(h), bound(cap), level)
        kernels = self.blocks.kernels
        s = np.zeros((-(-p.size // kernels.BLOCK), 3))
        self.blocks.share(kernels.violation, len(s), *arguments, s, serial=p.size < SERIAL_BELOW)
        return Violation(float(s[:, 0].sum()), float(s[:, 1].sum()), float(s[:, 2].max()))

    def beyond(self, late: RealArray, early: RealArray, ratio: float) -> RealArray:
        """late + ratio (late - early), a new array."""
        out = np.empty_like(late)
        self.blocks.run(self.blocks.kernels.beyond, out.size, late.ravel(), early.ravel(), ratio, out.ravel())
        return out

    def move_on(self, late: RealArray, early: RealArray, ratio: float) -> None:
        """late += ratio (late - early)."""
        there = late.ravel()
        self.blocks.run(self.blocks.kernels.beyond, there.size, there, early.ravel(), ratio, there)

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
        self.blocks.run(self.blocks.kernels.scatter, free.size, free.place(field), _ZERO[field.dtype], memory(field))


_LARGEST_KEPT = (1 << 25) - (1 << 13)
"""Bytes of an array up to which the allocator of glibc learns to keep what is freed: 32 MiB less
what it stores itself."""


@cache
def _keep_freed_memory() -> None:
    """Let the allocator keep the memory of freed fields of up to 32 MiB for the next ones, instead
    of giving it back to the system each time.

    glibc does so for sizes that have once been freed, and then keeps at most twice as much free; an
    array of this size that is freed unused costs nothing. New pages for fields of every solve took
    16 % of the time of a call at 512², 13 % at 256² and 1024². Other allocators take no notice.
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
        bands, serial = len(self.squares), size < SERIAL_BELOW
        marked: tuple[Any, ...]
        if self.cap is None:
            mark, lines = kernels.mark_free_elastic, levels[..., 0].repeat(SQUARE_SIDE, axis=1)
            marked = (*flat, SQUARE_SIDE, lines, self.squares, mask, found, counts)
        else:
            mark = kernels.mark_free
            marked = (*flat, bound(self.cap), SQUARE_SIDE, levels, mask, found, counts)
        self.blocks.share(mark, bands, *marked, serial=serial)
        np.cumsum(found, out=found)
        starts = np.empty(len(levels) + 1, np.int64)
        starts[:-1], starts[-1] = rows[:-1:SQUARE_SIDE], rows[-1]
        short = self.shape[0] * (row + ROW_PAD) < 2**31
        index = np.empty(int(rows[-1]), np.uint32 if short else np.int64)
        residual, sums = np.empty(index.size, dtype), np.empty(len(levels))
        masks, length = (mask, mask.view(np.uint64)), SQUARE_SIDE // 8 * row  # words in a band of squares
        filled = (self.u, self.h, (level, scale), length, masks, starts, index, residual, sums)
        self.blocks.share(kernels.fill_free, bands, *filled, serial=serial)
        return _CpuFreeSet(self.blocks, self.shape, index, residual, sums, rows, index.size, int(counts.sum()))


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
        spectrum = self._transform.forward(field, self._spectrum)
        self._blocks.run(self._blocks.kernels.scale_spectrum, self._kernel.size, self._parts, self._kernel)
        return self._transform.backward(spectrum, out)


def _read_only(values: RealArray) -> RealArray:
    """Flat view that cannot be written to: passes are compiled once, whatever heights a user
    brings."""
    flat = values.ravel()
    flat.setflags(write=False)
    return flat
