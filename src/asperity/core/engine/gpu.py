"""Engine of a GPU, by CuPy: every pass a kernel of its own (``gpu_kernels.cu``), transforms by
cuFFT; vectors over a free set are arrays that are zero outside it."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any
from weakref import ref

import numpy as np

from ..arrays import RealArray
from ..errors import InputError
from ..spectral import thread_count
from .array_api import ArrayEngine
from .protocol import (
    NEAR_CAP,
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
    cells_of,
)

# Kernels and how they are called.


_THREADS = 256
"""Threads of a block."""

_MOST_BLOCKS = 1024
"""Blocks of a pass at most: more than any GPU runs at a time. Not a number of the GPU at hand, on
which sums would depend."""

_TURNING = 4096
"""Cells of a level from which on one block goes up and down all levels above, which saves two
launches for each."""

_TOUCHED_FROM = 1 << 26
"""Bytes from which on new memory of the host is first written to by all threads: its pages take a
thread three times as long as the copy from the GPU."""

_TYPES = {"float32": "float", "float64": "double"}


class Passes:
    """Kernels for iterates and vectors of given precisions, on arrays of the module ``cupy``."""

    def __init__(self, cupy: Any, iterate: str, vector: str, *, threads: int = _THREADS) -> None:
        words = {"ITERATE": _TYPES[iterate], "VECTOR": _TYPES[vector], "SIDE": SQUARE_SIDE}
        options = ("--std=c++14", *(f"-D{word}={meaning}" for word, meaning in words.items()))
        code = Path(__file__).with_name("gpu_kernels.cu").read_text(encoding="utf-8")
        self._cupy, self._module, self._threads = cupy, cupy.RawModule(code=code, options=options), threads
        self._kernels: dict[str, Any] = {}

    def run(self, name: str, points: int, *arguments: Any, blocks: int | None = None) -> None:
        """Call the kernel ``name`` for so many points, a thread for each or several."""
        if name not in self._kernels:
            self._kernels[name] = self._module.get_function(name)
        blocks = blocks_for(points) if blocks is None else blocks
        self._kernels[name]((blocks,), (self._threads,), arguments)

    def sums(self, name: str, points: int, columns: int, *arguments: Any) -> RealArray:
        """What each block leaves (columns, blocks) when the kernel ``name`` is called for so many
        points."""
        partial = self._cupy.empty((columns, blocks_for(points)))
        self.run(name, points, *arguments, partial)
        return np.asarray(self._cupy.asnumpy(partial))

    def totals(self, name: str, points: int, columns: int, *arguments: Any) -> list[float]:
        """Sums over all blocks."""
        found: list[float] = self.sums(name, points, columns, *arguments).sum(axis=1).tolist()
        return found


def blocks_for(points: int) -> int:
    """Blocks of threads of a pass over so many points."""
    return max(1, min(-(-points // _THREADS), _MOST_BLOCKS))


def _of_cap(cap: Any) -> tuple[Any, int]:
    """A ``cap`` and its number of values as kernels take it."""
    return (0, 0) if cap is None else (cap, int(cap.size))


# Free set. Methods without docstring: see ``protocol``.


@dataclass(eq=False)
class _GpuFreeSet:
    """Free set ``inside`` of so many points; ``start`` is its residual, of the sum ``total``."""

    passes: Passes
    cupy: Any
    inside: Any
    start: Any
    size: int
    entering: int
    total: float

    def residual(self, *, centred: bool) -> Any:
        if centred and self.size and self.total:
            self._run("centred", self.total / self.size, self.start)
            self.total = 0.0
        return self.start

    def zeros(self) -> Any:
        return self.cupy.zeros_like(self.start)

    def empty(self) -> Any:
        return self.cupy.empty_like(self.start)

    def copy(self, vector: Any) -> Any:
        return vector.copy()

    def shifted(self, vector: Any, by: float) -> Any:
        out = self.empty()
        self._run("shifted", vector, float(by), out)
        return out

    def square(self, vector: Any) -> float:
        n = vector.size
        (found,) = self.passes.totals("square", n, 1, vector, n)
        return found if math.isfinite(found) else math.nan

    def largest(self, vector: Any) -> float:
        return float(self.passes.sums("largest", vector.size, 1, vector, vector.size).max())

    def gather(self, values: Any) -> tuple[Any, float]:
        out = self.cupy.empty_like(values)
        kind = "gather_vector" if values.dtype == self.start.dtype else "gather_iterate"
        return out, self._totals(kind, 1, values, out)[0]

    def gather_products(self, field: Any, a: Any, b: Any, out: Any) -> Products:
        return Products(out, *self._totals("gather_products", 3, field, a, b, out))

    def products(self, vector: Any, a: Any, b: Any) -> Products:
        return self.gather_products(vector, a, b, vector)

    def scatter(self, values: Any, field: Any) -> None:
        field[...] = values

    def scatter_add(self, values: Any, factor: float, field: Any) -> None:
        self.passes.run("scatter_add", field.size, values, float(factor), field, field.size)

    def scatter_change(self, old: Any, values: Any, r: Any, field: Any) -> tuple[Any, float]:
        change = self.empty()
        return change, self._totals("scatter_change", 1, old, values, r, change, field)[0]

    def update_direction(self, z: Any, mean: float, ratio: float, t: Any, r: Any, field: Any) -> tuple[Any, float]:
        target = 0 if field is None else field
        return t, self._totals("update_direction", 1, z, float(mean), float(ratio), t, r, target)[0]

    def update_solution(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any, float]:
        left = self._totals("update_solution", 1, float(length), t, kt, float(mean), d, r)[0]
        return d, r, left if math.isfinite(left) else math.nan

    def add_unclipped(self, p: Any, d: Any, scale: float) -> Unclipped:
        tensile, tension, pressure = self._totals("add_unclipped", 3, p, d, float(scale))
        return Unclipped(int(tensile), tension, pressure)

    def clear_tension(self, p: Any, factor: float, scale: float) -> Any:
        change = self.empty()
        self._run("clear_tension", p, float(factor), float(scale), change)
        return change

    def loaded(self, values: Any, total: float | None, vector: Any) -> tuple[FreeSet, Any, Any]:
        inside, on_left, out = self.cupy.empty_like(self.inside), self.cupy.empty_like(values), self.empty()
        size, carried = self._totals("loaded", 2, values, vector, inside, on_left, out)
        if total is not None and size:
            on_left *= total / carried
        return _GpuFreeSet(self.passes, self.cupy, inside, self.zeros(), int(size), 0, 0.0), on_left, out

    def spread(self, left: Any, values: Any) -> Any:
        """``values``, which are zero on the other points."""
        return values

    def change(self, values: Any, before: Any, scale: float) -> Any:
        change = self.empty()
        self._run("change", values, before, float(scale), change)
        return change

    def put(self, values: Any, p: Any) -> None:
        self._run("put", values, p)

    def add_clipped(self, p: Any, d: Any, scale: float, cap: Any) -> Clipped:
        *load, clipped = self._totals("add_clipped", 4, p, d, float(scale), *_of_cap(cap))
        return Clipped(_load(load), int(clipped))

    def rescale(self, p: Any, factor: float, shift: float, cap: Any) -> Load:
        return _load(self._totals("rescale", 3, p, float(factor), float(shift), NEAR_CAP, *_of_cap(cap)))

    def interpolate(self, old: Any, share: float, values: Any) -> None:
        self._run("interpolate", old, float(share), values)

    def _run(self, name: str, *arguments: Any) -> None:
        self.passes.run(name, self.inside.size, self.inside, *arguments, self.inside.size)

    def _totals(self, name: str, columns: int, *arguments: Any) -> list[float]:
        return self.passes.totals(name, self.inside.size, columns, self.inside, *arguments, self.inside.size)


def _load(sums: list[float]) -> Load:
    pressure, movable, below = sums
    return Load(pressure, movable, int(below))


# Nested splines.


class _GpuSplines:
    """Compliance of nested splines and its inverse on a free set; sums, factors and deflections of
    all levels in one array each."""

    def __init__(self, passes: Passes, cupy: Any, shape: tuple[int, int], model: SplineModel, dtype: str) -> None:
        self._passes = passes
        self._wraps = tuple(int(wrap) for wrap in model.wraps)
        levels, parts, begin = [], -1, 0
        for merge, average in zip(model.merges, model.averages, strict=True):
            cells = [
                cells_of(n, wrap) if merged else n for n, wrap, merged in zip(shape, model.wraps, merge, strict=True)
            ]
            levels.append([*shape, *cells, *merge, parts, begin, *average])
            parts, begin, shape = begin, begin + cells[0] * cells[1], (cells[0], cells[1])
        self._cells = [level[2] * level[3] for level in levels]
        self._points = levels[0][0] * levels[0][1]
        self._turn = next((level for level, cells in enumerate(self._cells) if cells <= _TURNING), len(levels) - 1)
        table = cupy.asarray(np.array(levels, np.int32))
        self._levels = [table[level:] for level in range(len(levels))]
        local = [*model.own, model.stiffness, *model.fall, *model.bend]
        self._local = cupy.asarray(np.array(local))
        self._weights, self._inverse = (
            [weights[level:] for level in range(len(levels))]
            for weights in (cupy.asarray(np.array(given)) for given in (model.weights, model.inverse_weights))
        )
        self._sums, self._factors, self._deflections = (cupy.empty(begin, dtype) for _ in range(3))
        self._corrections = [
            share if merges_x and merges_y else 0.0
            for share, (merges_x, merges_y) in zip(model.corrections, model.merges, strict=False)
        ]
        self._together = cupy.empty(levels[0][:2] if model.corrections else (1, 1), dtype)
        self._mean, self._per, self._raw = (cupy.empty(begin if model.corrections else 1, dtype) for _ in range(3))
        self._dtype = dtype

    def factorise(self, free: FreeSet) -> None:
        """g of all cells for the points of ``free``, and what the correction takes."""
        assert isinstance(free, _GpuFreeSet)
        points = free.inside.astype(self._dtype)
        self._sweep(_FACTORISE, self._inverse, points)
        if not self._corrections:
            return
        arguments = (self._levels[0], *self._wraps, self._local, free.inside, self._together)
        self._passes.run("local_stiffness", self._points, *arguments)
        for level, share in enumerate(self._corrections):
            if share:
                fields = (share, points, self._sums, self._factors, self._mean, self._per)
                self._passes.run("overlap", self._cells[level], self._levels[level], *self._wraps, *fields)

    def solve(self, free: FreeSet, r: Any, other: Any, out: Any) -> Products:
        assert isinstance(free, _GpuFreeSet)
        if self._corrections:
            # up all levels, and down again with the correction for row sums
            run, weights, memory = self._passes.run, self._inverse, (self._sums, self._factors)
            for level, cells in enumerate(self._cells):
                run("rise", cells, self._levels[level], _INVERT, *self._wraps, weights[level], r, *memory)
            for level in reversed(range(len(self._cells))):
                cells, at, share = self._cells[level], self._levels[level], self._corrections[level]
                last, target = int(level + 1 == len(self._cells)), self._raw if share else self._deflections
                run("fall", cells, at, last, _INVERT, *self._wraps, weights[level], *memory, self._deflections, target)
                if share:
                    run("corrected", cells, at, *self._wraps, self._mean, self._per, self._raw, self._deflections)
        else:
            self._sweep(_INVERT, self._inverse, r)
        fields = (
            int(bool(self._corrections)),
            self._local,
            self._deflections,
            free.inside,
            self._together,
            r,
            other,
            out,
        )
        arguments = (self._levels[0], *self._wraps, *fields)
        return Products(out, *self._passes.totals("invert_points", self._points, 3, *arguments))

    def deflection(self, free: FreeSet, t: Any, other: Any, out: Any) -> Products:
        return Products(out, *self._deflected(free, t, other, 0, out).sum(axis=1).tolist())

    def predicted_residual(self, free: FreeSet, r: Any, loaded: FreeSet, change: Any) -> Any:
        out = free.empty()
        self._deflected(free, change, r, 1, out)
        return out

    def _deflected(self, free: FreeSet, t: Any, other: Any, less: int, out: Any) -> RealArray:
        assert isinstance(free, _GpuFreeSet)
        self._sweep(_DEFLECT, self._weights, t)
        arguments = (self._levels[0], *self._wraps, self._local, self._deflections, free.inside, t, other, less, out)
        return self._passes.sums("deflect_points", self._points, 3, *arguments)

    def _sweep(self, way: int, weights: list[Any], points: Any) -> None:
        """Up all levels from the ``points``, and down again to the cells of the first; only up to
        factorise."""
        run, turn, number = self._passes.run, self._turn, len(self._cells) - self._turn
        sums, memory = (self._sums, self._factors), (self._sums, self._factors, self._deflections)
        for level in range(turn):
            run("rise", self._cells[level], self._levels[level], way, *self._wraps, weights[level], points, *sums)
        last = (self._levels[turn], number, way, *self._wraps, weights[turn], points, *memory)
        run("turn", self._cells[turn], *last, blocks=1)
        if way == _FACTORISE:
            return
        for level in reversed(range(turn)):
            arguments = (0, way, *self._wraps, weights[level], *memory, self._deflections)
            run("fall", self._cells[level], self._levels[level], *arguments)


_INVERT, _DEFLECT, _FACTORISE = range(3)
"""Ways through the levels, as in the kernels."""


# Survey of an iterate.


@dataclass(frozen=True, eq=False)
class _GpuSurvey:
    """One iterate seen as a whole."""

    engine: GpuEngine
    totals: Totals
    arrays: tuple[Any, Any, Any]
    cap: Any
    on_device: Any

    @cached_property
    def squares(self) -> RealArray:
        """Sums in squares."""
        return self.engine.numpy(self.on_device)

    def free_set(self, levels: RealArray, level: float, scale: float, dtype: str) -> _GpuFreeSet:
        """Free set of the iterate."""
        cupy, p = self.engine.cupy, self.arrays[0]
        passes = self.engine.passes(p.dtype.name, dtype)
        inside, start = cupy.empty(p.shape, np.uint8), cupy.empty(p.shape, dtype)
        arguments = (*self.arrays, *_of_cap(self.cap), *p.shape, self.engine.array(levels, "float64"))
        targets = (float(level), float(scale), inside, start)
        size, entering, total = passes.totals("free_set", p.size, 3, *arguments, *targets)
        return _GpuFreeSet(passes, cupy, inside, start, int(size), int(entering), total)


# The engine.


class GpuEngine(ArrayEngine):
    """A GPU, by the library CuPy, which is installed with the driver of the GPU in mind:
    ``pip install cupy-cuda12x`` or ``cupy-cuda13x``.

    Parameters
    ----------
    cupy
        The module ``cupy``; imported if not given.

    Raises
    ------
    InputError
        If CuPy is not installed or finds no GPU.
    """

    separate_memory = True

    def __init__(self, cupy: Any = None) -> None:
        if cupy is None:
            try:
                cupy = import_module("cupy")
            except ImportError:
                raise InputError(
                    "library of GpuEngine must be CuPy, but it is not installed. Install the one for your "
                    "driver: pip install cupy-cuda12x or cupy-cuda13x."
                ) from None
            try:
                cupy.cuda.runtime.getDeviceCount()
            except cupy.cuda.runtime.CUDARuntimeError as error:
                raise InputError(
                    f"machine of GpuEngine must have a GPU, but CuPy finds none ({error}). Leave the engine "
                    "out to compute on the CPU."
                ) from None
        self.cupy = cupy
        super().__init__(self.cupy)
        self._fft = self.cupy.fft
        self.name = f"gpu ({self._device()})"
        self._passes: dict[tuple[str, str], Passes] = {}
        self._transforms: dict[tuple[tuple[int, int], str], Any] = {}
        self._threads = thread_count(None)
        self._last: tuple[ref[RealArray], Any] | None = None

    def _device(self) -> str:
        runtime = self.cupy.cuda.runtime
        name: bytes = runtime.getDeviceProperties(self.cupy.cuda.Device().id)["name"]
        return name.decode()

    def passes(self, iterate: str, vector: str) -> Passes:
        """Kernels for these precisions, compiled when they are first needed and then kept on disk
        by CuPy."""
        if (iterate, vector) not in self._passes:
            self._passes[iterate, vector] = self._compiled(iterate, vector)
        return self._passes[iterate, vector]

    def _compiled(self, iterate: str, vector: str) -> Passes:
        return Passes(self.cupy, iterate, vector)

    def transforms(self, shape: tuple[int, int], dtype: str) -> Any:
        """Transforms of fields of ``shape``, prepared once."""
        if (shape, dtype) not in self._transforms:
            self._transforms[shape, dtype] = self._planned(shape, dtype)
        return self._transforms[shape, dtype]

    def _planned(self, shape: tuple[int, int], dtype: str) -> Any:
        return (_Transforms if min(shape) > 1 else _LineTransforms)(self.cupy, shape, dtype)

    def array(self, values: Any, dtype: str) -> Any:
        """``values`` of the host or the GPU as a contiguous array of the GPU."""
        if isinstance(values, self.cupy.ndarray):
            return self.cupy.ascontiguousarray(values, dtype=dtype)
        # converted there, which takes a tenth of the time
        host = np.ascontiguousarray(values)
        return self.cupy.asarray(host).astype(dtype, copy=False)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        if not isinstance(values, self.cupy.ndarray):
            return np.asarray(values)
        out = np.empty(values.shape, values.dtype.name)
        if out.nbytes >= _TOUCHED_FROM:
            with ThreadPoolExecutor(self._threads) as pool:
                list(pool.map(lambda part: part.fill(0), np.array_split(out.reshape(-1), self._threads)))
        self.cupy.asnumpy(values, out=out)
        return out

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""
        return self.cupy.zeros(shape, dtype)

    field = zeros

    def copy(self, values: Any) -> Any:
        """New array equal to ``values``."""
        return values.copy()

    def resident(self, values: Any) -> Any:
        """``values`` in the memory of the GPU; of those that cannot be written to, as heights of a
        surface, the last ones stay there as long as they are on the host."""
        if isinstance(values, self.cupy.ndarray):
            return values
        if values.flags.writeable or values.base is not None:
            return self.array(values, "float64")
        if self._last is None or self._last[0]() is not values:
            engine = ref(self)  # which holds what is to be forgotten

            def forget(which: ref[RealArray]) -> None:
                found = engine()
                if found is not None and found._last is not None and found._last[0] is which:
                    found._last = None

            self._last = ref(values, forget), self.array(values, "float64")
        return self._last[1]

    def total(self, values: Any) -> float:
        """Sum of the ``values``."""
        return float(values.sum(dtype=np.float64))

    def convolution(
        self, kernel: Any, shape: tuple[int, int], dtype: str, padded: tuple[int, int] | None = None
    ) -> Convolution:
        """Periodic convolution, or free as of any library."""
        if padded is not None:
            return super().convolution(kernel, shape, dtype, padded)
        return _GpuConvolution(self.transforms(shape, dtype), self.array(kernel, dtype) / math.prod(shape))

    def splines(self, shape: tuple[int, int], model: SplineModel, dtype: str) -> _GpuSplines:
        """Nested splines."""
        return _GpuSplines(self.passes("float64", dtype), self.cupy, shape, model, dtype)

    def prolonged(self, coarse: Any, coarse_heights: Any, heights: Any, stiffness: float) -> Any:
        """Pressure on the points of ``heights`` from a coarser one, in the memory of the GPU."""
        given = [self.array(values, "float64") for values in (coarse, coarse_heights, heights)]
        out = self.cupy.empty_like(given[-1])
        passes = self.passes("float64", "float32")
        passes.run("prolonged", out.size, *given, float(stiffness), *out.shape, out)
        return out

    def survey(self, p: Any, u: Any, h: Any, cap: Any) -> _GpuSurvey:
        """Survey of an iterate."""
        nx, ny = p.shape
        squares = self.cupy.empty((-(-nx // SQUARE_SIDE), -(-ny // SQUARE_SIDE), 3))
        p, u, h = self._alike(p, u, h)
        arguments = (p, u, h, *_of_cap(cap), nx, ny, squares)
        found = self.passes(p.dtype.name, "float32").sums("survey", p.size, 8, *arguments)
        pressure, deflected, work, weight, weighted = found[:5].sum(axis=1).tolist()
        lowest, highest_capped, lowest_open = float(found[5].min()), float(found[6].max()), float(found[7].min())
        if cap is None:
            lowest_open = lowest
        totals = Totals(pressure, deflected, work, weight, weighted, lowest, highest_capped, lowest_open)
        return _GpuSurvey(self, totals, (p, u, h), cap, squares)

    def _alike(self, *fields: Any) -> tuple[Any, ...]:
        """``fields`` of one precision."""
        if all(field.dtype == fields[0].dtype for field in fields):
            return fields
        return tuple(self.array(field, "float64") for field in fields)

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        p, u, h = self._alike(p, u, h)
        arguments = (p, u, h, *_of_cap(cap), float(level), p.size)
        found = self.passes(p.dtype.name, "float32").sums("violation", p.size, 3, *arguments)
        return Violation(float(found[0].sum()), float(found[1].sum()), float(found[2].max()))

    def add(self, field: Any, factor: float, values: Any) -> None:
        """values += factor field."""
        passes = self.passes(values.dtype.name, field.dtype.name)
        passes.run("add", values.size, field, float(factor), values, values.size)

    def clear_field(self, free: FreeSet, field: Any) -> None:
        """Zero everywhere."""
        field.fill(0.0)


class _Transforms:
    """Transforms of cuFFT, planned once, without normalisation."""

    def __init__(self, cupy: Any, shape: tuple[int, int], dtype: str) -> None:
        plan = import_module("cupyx.scipy.fft").get_fft_plan
        self._cupy = cupy
        self._spectrum = (shape[0], shape[1] // 2 + 1), np.dtype("complex128" if dtype == "float64" else "complex64")
        field, spectrum = cupy.empty(shape, dtype), cupy.empty(*self._spectrum)
        self._forward = plan(field, axes=(0, 1), value_type="R2C")
        self._backward = plan(spectrum, shape=shape, axes=(0, 1), value_type="C2R")

    def forward(self, field: Any) -> Any:
        """Half spectrum of ``field``."""
        spectrum = self._cupy.empty(*self._spectrum)
        self._forward.fft(field, spectrum, self._cupy.cuda.cufft.CUFFT_FORWARD)
        return spectrum

    def backward(self, spectrum: Any, out: Any) -> None:
        """Set ``out`` to the field of a ``spectrum``, which is lost."""
        self._backward.fft(spectrum, out, self._cupy.cuda.cufft.CUFFT_INVERSE)


@dataclass(eq=False)
class _LineTransforms:
    """The same for grids of one line, which CuPy plans no transforms of real numbers for."""

    cupy: Any
    shape: tuple[int, int]
    dtype: str

    def forward(self, field: Any) -> Any:
        """Half spectrum of ``field``."""
        return self.cupy.fft.rfftn(field, axes=(0, 1))

    def backward(self, spectrum: Any, out: Any) -> None:
        """Set ``out`` to the field of a ``spectrum``."""
        out[...] = self.cupy.fft.irfftn(spectrum, s=self.shape, axes=(0, 1), norm="forward")


@dataclass(eq=False)
class _GpuConvolution:
    """Transform, product with the kernel, transform back."""

    transforms: Any
    kernel: Any

    def apply(self, field: Any, out: Any) -> Any:
        spectrum = self.transforms.forward(field)
        spectrum *= self.kernel
        self.transforms.backward(spectrum, out)
        return out
