"""Nested quadratic B-splines of the CPU engine; what its sweeps do: see ``spline_kernels``."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import ref

import numpy as np

from ..arrays import RealArray
from . import spline_kernels as kernels
from .protocol import Products, SplineModel, cells_of

if TYPE_CHECKING:
    from .cpu import Blocks

# All levels in one piece of memory, rows of the large ones shared by the threads.


_SHARED = 1 << 17
"""Cells of a level from which on threads share its rows, and those of the points below: the first level from 1024² points on."""

_GAP = 8
"""Points between the rows of the array of points: its margins, and so many that rows of 2^k points do not collide in the cache."""


class CpuSplines:
    """Compliance of nested splines and its inverse on a free set."""

    def __init__(self, blocks: Blocks, shape: tuple[int, int], model: SplineModel, dtype: str) -> None:
        self._blocks = blocks
        self._layout = _layout(shape, model.merges, model.averages, model.wraps)
        self._points, cells = np.zeros(self._layout.points, dtype), self._layout.cells
        self._sums, self._g, self._cells = (np.zeros(cells, dtype) for _ in range(3))
        # for each thread: a line of sums or deflections, zeros and ones; what is found at the points of a row
        self._lines = np.zeros((min(blocks.threads, kernels.PARTS), 3, shape[1] + 8), dtype)
        self._lines[:, 2] = 1.0
        self._found, self._under = (np.zeros((len(self._lines), shape[1] + 8), dtype) for _ in range(2))
        self._products = np.empty((3, shape[0]))
        self._wraps, kind = model.wraps, np.dtype(dtype).type
        self._inverse, self._weights = (
            np.array([0.0, *weights], dtype) for weights in (model.inverse_weights, model.weights)
        )
        point, *nearest, diagonal = model.own
        self._shares = np.array([0.0, *model.corrections], dtype)
        self._first = int(np.flatnonzero(self._shares)[0]) if self._shares.any() else 0
        size = cells if self._first else 0
        scratch = tuple(np.zeros((len(self._lines), shape[1] + 8), dtype) for _ in range(3))
        self._correction = (scratch, *(np.zeros(size, dtype) for _ in range(3)))
        self._correct = False
        self._point, self._one = np.array([point], dtype), np.ones(1, dtype)
        own = (*(0.5 * side for side in nearest), 0.0, 0.0, 0.25 * diagonal, 1.0)
        falls = [0.25 * fall for fall in model.fall]
        beside = [-0.25 * (fall + bend) for fall, bend in zip(model.fall, model.bend, strict=True)]
        beside += [0.0625 * bend for bend in model.bend]
        self._own = tuple(kind(value) for value in own)
        self._stencil = tuple(kind(value) for value in (1.0 + 0.375 * sum(model.bend), *falls, *beside))
        self._stiff = tuple(kind(model.stiffness * value) for value in (*beside, 0.0, -1.0))
        self._stiffness = kind(model.stiffness)
        self._alone, self._together = np.empty(0, dtype), self._one
        self._loaded: Callable[[], Any] = lambda: None

    def factorise(self, free: Any, conductance: RealArray | None = None) -> None:
        """Local stiffness of every point of ``free``, g of all cells, and what the correction takes.

        ``conductance``: factors (of any sign) to the yielding of the points to their own load, one if not given. Then the cells are not corrected.
        """
        unit = np.ones(free.size, self._points.dtype) if conductance is None else conductance
        self._alone, together = np.empty_like(unit), np.empty_like(unit)
        self._load(free, unit)
        at = (free.rows, free.index), (self._found, self._under, self._points)
        stiffness = self._stencil, self._alone, together
        self._share(kernels.local_stiffness, self._layout.levels, *at, *stiffness, serial=self._layout.large == 0)
        self._alone *= self._stiffness
        if self._first:
            self._together = together
        self._rise(kernels.FACTORISE, self._inverse)
        self._correct = self._first > 0 and conductance is None
        if self._correct:
            levels, large, top = self._layout[:3]
            memory = self._wraps, self._shares, self._lines, self._points, self._sums, self._g, self._correction[1:3]
            for depth in range(self._first, large + 1):
                self._share(kernels.overlaps, levels, (depth, depth), *memory, serial=False)
            kernels.overlaps((0, kernels.PARTS), levels, (max(large + 1, self._first), top), *memory)

    def solve(self, free: Any, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``, see ``protocol.Splines``."""
        return self._solved(free, r, r, other, out)

    def solve_with(self, free: Any, r: RealArray, conductance: RealArray) -> RealArray:
        """Inverse times ``r`` after ``factorise`` with the same ``conductance``; not quite symmetric."""
        found: RealArray = self._solved(free, r, conductance * r, r, np.empty_like(r)).vector
        found *= conductance
        return found

    def _solved(self, free: Any, r: RealArray, yielding: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``, which acts on other points by how they are ``yielding`` to it."""
        self._load(free, yielding)
        self._rise(kernels.SOLVE, self._inverse)
        if self._correct:
            self._fall_corrected()
        else:
            self._fall(kernels.SOLVE, self._inverse)
        return self._at_points(free, self._stiff, r, self._alone, self._together, r, other, out)

    def deflection(self, free: Any, t: RealArray, other: RealArray, out: RealArray) -> Products:
        """Deflection by ``t``, see ``protocol.Splines``."""
        self._load(free, t)
        self._rise(kernels.DEFLECT, self._weights)
        self._fall(kernels.DEFLECT, self._weights)
        return self._at_points(free, self._own, t, self._point, self._one, t, other, out)

    def predicted_residual(self, free: Any, r: RealArray, loaded: Any, change: RealArray) -> RealArray:
        """``r`` less the deflection of the points of ``free`` by ``change``."""
        self._load(loaded, change)
        self._rise(kernels.DEFLECT, self._weights)
        self._fall(kernels.DEFLECT, self._weights)
        at = free.empty()
        kernels.gather(free.rows, free.index, self._layout.levels, self._points, at)
        u = self._at_points(free, self._own, at, self._point, self._one, at, at, np.empty_like(r)).vector
        found: RealArray = np.subtract(r, u, out=u)
        return found

    def late_sweeps(self, free: Any) -> list[Callable[[], Any]]:
        """Calls of the sweeps that a solve needs last, on ``free``: see ``first_use``."""
        vector = free.zeros()
        at = (free, self._own, vector, self._point, self._one, vector, vector, free.empty())
        gathered = (free.rows, free.index, self._layout.levels, self._points, vector)
        return [
            partial(self._fall, kernels.DEFLECT, self._weights),
            partial(self._at_points, *at),
            partial(kernels.gather, *gathered),
        ]

    def _rise(self, purpose: int, weights: RealArray) -> None:
        """Sums of the loads on all levels."""
        levels, large, top = self._layout[:3]
        arguments = self._wraps, weights, self._lines, self._points, self._sums, self._g
        for depth in range(1, large + 1):
            self._share(kernels.rise, levels, (depth, depth, purpose), *arguments, serial=False)
        if large < top:
            self._share(kernels.rise, levels, (large + 1, top, purpose), *arguments, serial=True)

    def _load(self, set_: Any, values: RealArray) -> None:
        """Loads ``values`` of the set at its points, and none elsewhere."""
        if self._loaded() is not set_:
            self._points[...] = 0.0
            self._loaded = ref(set_)
        kernels.place(set_.rows, set_.index, self._layout.levels, self._wraps, values, self._points)

    def _fall(self, purpose: int, weights: RealArray) -> None:
        """Deflections on all levels."""
        levels, large, top = self._layout[:3]
        arguments = self._wraps, weights, self._lines, self._sums, self._g, self._cells, self._cells
        if large < top:
            self._share(kernels.fall, levels, (top, large + 1, purpose), *arguments, serial=True)
        for depth in range(large, 0, -1):
            self._share(kernels.fall, levels, (depth, depth, purpose), *arguments, serial=False)

    def _fall_corrected(self) -> None:
        """Deflections on all levels to solve, corrected from the first level on that is."""
        levels, large, top = self._layout[:3]
        first, small, raw = self._first, large + 1, self._correction[3]
        before = self._wraps, self._inverse, self._lines, self._sums, self._g
        kernels.fall_corrected(levels, (top, max(small, first)), *before, self._correction, self._cells)
        if first > small:
            kernels.fall(
                (0, kernels.PARTS), levels, (first - 1, small, kernels.SOLVE), *before, self._cells, self._cells
            )
        for depth in range(large, 0, -1):
            way, target = (depth, depth, kernels.SOLVE), raw if depth >= first else self._cells
            self._share(kernels.fall, levels, way, *before, self._cells, target, serial=False)
            if depth >= first:
                self._share(kernels.corrected, levels, depth, self._wraps, *self._correction, self._cells, serial=False)

    def _at_points(
        self,
        free: Any,
        stencil: tuple[Any, ...],
        values: RealArray,
        alone: RealArray,
        share: RealArray,
        *vectors: RealArray,
    ) -> Products:
        """Values at the points of ``free`` from those of the points and the cells around them."""
        levels, products = self._layout.levels, self._products
        one, other, out = vectors
        arguments = (
            (free.rows, free.index),
            (self._lines, self._found, self._under, self._points, self._cells),
            stencil,
            (values, alone, share, one, other),
            out,
            products,
        )
        self._share(kernels.at_points, levels, self._wraps, *arguments, serial=self._layout.large == 0)
        return Products(out, *np.add.reduce(products, axis=1).tolist())

    def _share(self, kernel: Any, *arguments: Any, serial: bool) -> None:
        self._blocks.share(kernel, kernels.PARTS, *arguments, serial=serial)


class _Layout(NamedTuple):
    """Table ``levels`` of the sweeps; the number of ``large`` levels and of all; the sizes of the arrays of ``points`` and of ``cells``."""

    levels: Any
    large: int
    top: int
    points: int
    cells: int


@lru_cache(maxsize=32)
def _layout(
    shape: tuple[int, int],
    merges: tuple[tuple[bool, bool], ...],
    averages: tuple[tuple[bool, bool], ...],
    wraps: tuple[bool, bool],
) -> _Layout:
    """Layout of nested splines on a grid of ``shape``."""
    (nx, ny), size, large = shape, 0, 0
    stride = ny + _GAP
    levels = [(2 * stride + 2, nx, ny, stride, 0, 0, 0, 0)]
    for (x, y), average in zip(merges, averages, strict=True):
        nx, ny = (cells_of(n, wrap) if merge else n for n, merge, wrap in zip((nx, ny), (x, y), wraps, strict=True))
        levels.append((size, nx, ny, ny, int(x), int(y), int(average[0]), int(average[1])))
        size += nx * ny
        large += int(nx * ny >= _SHARED)
    at_least = max(size, 2)  # an array of one entry would be a factor for all cells
    return _Layout(np.array(levels, np.int64), large, len(merges), (shape[0] + 5) * stride, at_least)
