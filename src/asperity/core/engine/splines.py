"""Nested quadratic B-splines of the CPU engine: compiled sweeps sum loads up the levels and prolong deflections down again.

A cell of a level merges two of the level below along one axis or both. Its B-spline reaches half a cell beyond it on either side: a part passes
three quarters of its load to the cell that it lies in and a quarter to the nearest other, along each axis, and takes its deflection from both in
the same shares. Where the axis wraps, the first cell comes after the last one; else there is one more cell at either end, beyond the points.
The compliance averages the loads of neighbouring cells of a level (half of a cell's own and a quarter of that beside it on either side) before they
deflect it, along the axes for which the model says so.

``levels`` holds for every level the place of its first cell in memory, its cells along x and y, the distance of its rows, whether the level below
merges along x and y to it, and whether it averages along them. Level 0 are the points themselves, in an array with a margin.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import ref

import numpy as np

from ..arrays import RealArray
from .kernels import compiled, natural
from .protocol import Products, SplineModel, cells_of

if TYPE_CHECKING:
    from .cpu import Blocks

_START, _ROWS, _COLUMNS, _STRIDE, _MERGE_X, _MERGE_Y, _AVERAGE_X, _AVERAGE_Y = range(8)

_MARGIN = 2
"""Points kept beyond the rim of the array of points, for their neighbours."""

_SOLVE, _FACTORISE, _DEFLECT = range(3)
"""What a sweep is for: the inverse, g for it, or the deflection by loads."""

_PARTS = 64
"""Parts into which the rows of a level are divided among threads: the line of scratch memory of a thread follows from its first part."""


@compiled
def _surround(levels, wraps, points):  # type: ignore[no-untyped-def]
    """Values beyond the rim of the array of points: those of the other end where the axis wraps, else zero."""
    start, rows, columns, stride = levels[0, _START], levels[0, _ROWS], levels[0, _COLUMNS], levels[0, _STRIDE]
    for row in range(rows):
        for k in range(_MARGIN):
            base = start + row * stride
            points[base - 1 - k] = points[base + (-1 - k) % columns] if wraps[1] else 0.0
            points[base + columns + k] = points[base + k % columns] if wraps[1] else 0.0
    for k in range(_MARGIN):
        before, after = start - (1 + k) * stride - _MARGIN, start + (rows + k) * stride - _MARGIN
        last, first = start + (-1 - k) % rows * stride - _MARGIN, start + k % rows * stride - _MARGIN
        for j in range(columns + 2 * _MARGIN):
            points[before + j] = points[last + j] if wraps[0] else 0.0
            points[after + j] = points[first + j] if wraps[0] else 0.0


@compiled
def _place(rows, index, levels, wraps, values, points):  # type: ignore[no-untyped-def]
    """Set the array of points to the ``values`` at the points of a set, and beyond its rim."""
    for row in range(levels[0, _ROWS]):
        shift = levels[0, _START] + row * (levels[0, _STRIDE] - levels[0, _COLUMNS])
        for k in range(rows[row], rows[row + 1]):
            points[index[k] + shift] = values[k]
    _surround(levels, wraps, points)


@compiled
def _gather(rows, index, levels, points, out):  # type: ignore[no-untyped-def]
    """Values of the array of points at the points of a set."""
    for row in range(levels[0, _ROWS]):
        shift = levels[0, _START] + row * (levels[0, _STRIDE] - levels[0, _COLUMNS])
        for k in range(rows[row], rows[row + 1]):
            out[k] = points[index[k] + shift]


@compiled
def _neighbours(rows, index, levels, points, factors, out):  # type: ignore[no-untyped-def]
    """Sum of the values of the array of points at the nearest points along x and y, times the ``factors``, at the points of a set."""
    stride = levels[0, _STRIDE]
    for row in range(levels[0, _ROWS]):
        shift = levels[0, _START] + row * (stride - levels[0, _COLUMNS])
        for k in range(rows[row], rows[row + 1]):
            i = index[k] + shift
            out[k] = factors[0] * (points[i - stride] + points[i + stride]) + factors[1] * (
                points[i - 1] + points[i + 1]
            )


@compiled
def _rise(span, levels, way, wraps, weights, lines, points, sums, g):  # type: ignore[no-untyped-def]
    """Sums over the cells of the levels ``way[0]`` to ``way[1]`` of the loads on the ``points``, of the rows of the span.

    What a level passes up is left in ``sums``: g S of its sums S, or, to ``_DEFLECT``, S itself. To ``_FACTORISE`` (``way[2]``), g = 1 / (1 + w S) is set.
    """
    near, far, one = g.dtype.type(0.75), g.dtype.type(0.25), g.dtype.type(1.0)
    scratch = lines[-(-span[0] * len(lines) // _PARTS)]
    line, nothing, unit = scratch[0], scratch[1], scratch[2]
    for k in range(3):
        line[k] = 0.0
    for depth in range(way[0], way[1] + 1):
        fine, level, weight = levels[depth - 1], levels[depth], weights[depth]
        source = points if depth == 1 else sums
        rows, columns, below, stride = fine[_ROWS], fine[_COLUMNS], fine[_START], fine[_STRIDE]
        lead = 1 if wraps[1] else 3
        for cell in range(level[_ROWS] * span[0] // _PARTS, level[_ROWS] * span[1] // _PARTS):
            own_line = line[lead : lead + columns]
            if level[_MERGE_X]:
                first = 2 * cell if wraps[0] else 2 * cell - 2
                before, second, after = first - 1, first + 1, first + 2
                if wraps[0]:  # an odd number of rows leaves the last cell with one
                    if before < 0 and rows % 2 == 0:
                        before = rows - 1
                    if after >= rows:
                        after = 0
                row_a = (
                    source[below + before * stride : below + before * stride + columns]
                    if 0 <= before < rows
                    else nothing
                )
                row_b = (
                    source[below + first * stride : below + first * stride + columns] if 0 <= first < rows else nothing
                )
                row_c = (
                    source[below + second * stride : below + second * stride + columns]
                    if 0 <= second < rows
                    else nothing
                )
                row_d = (
                    source[below + after * stride : below + after * stride + columns] if 0 <= after < rows else nothing
                )
                for j in range(columns):
                    own_line[j] = far * (row_a[j] + row_d[j]) + near * (row_b[j] + row_c[j])
            else:
                row_b = source[below + cell * stride : below + cell * stride + columns]
                for j in range(columns):
                    own_line[j] = row_b[j]
            start, wide = level[_START] + cell * level[_STRIDE], level[_COLUMNS]
            out, own = sums[start : start + wide], g[start : start + wide] if way[2] != _DEFLECT else unit
            if level[_MERGE_Y]:
                for k in range(lead + columns, lead + columns + 4):
                    line[k] = 0.0
                if wraps[1]:
                    line[0] = line[columns] if columns % 2 == 0 else 0.0
                    line[columns + 1 + columns % 2] = line[1]
                for k in range(wide):
                    out[k] = far * (line[2 * k] + line[2 * k + 3]) + near * (line[2 * k + 1] + line[2 * k + 2])
            else:
                for k in range(wide):
                    out[k] = own_line[k]
            if way[2] == _FACTORISE:
                for k in range(wide):
                    own[k] = one / (one + weight * out[k])
            for k in range(wide):
                out[k] *= own[k]


@compiled
def _fall(span, levels, way, wraps, weights, lines, sums, g, cells):  # type: ignore[no-untyped-def]
    """Deflections of the ``cells`` of the levels ``way[0]`` down to ``way[1]``, of the rows of the span, from what ``_rise`` has left in ``sums``.

    That of a level is w g S plus g times that of the level above; to ``_DEFLECT``, w times the average of S over neighbouring cells plus that of the level above.
    """
    near, far, half = g.dtype.type(0.75), g.dtype.type(0.25), g.dtype.type(0.5)
    scratch = lines[-(-span[0] * len(lines) // _PARTS)]
    line, nothing, unit = scratch[0], scratch[1], scratch[2]
    top = len(levels) - 1
    for depth in range(way[0], way[1] - 1, -1):
        level, weight, wide, rows = levels[depth], weights[depth], levels[depth, _COLUMNS], levels[depth, _ROWS]
        for cell in range(rows * span[0] // _PARTS, rows * span[1] // _PARTS):
            start = level[_START] + cell * level[_STRIDE]
            out, own = cells[start : start + wide], g[start : start + wide] if way[2] != _DEFLECT else unit
            row_b, mixed = sums[start : start + wide], line[1 : wide + 1]
            if way[2] == _DEFLECT and level[_AVERAGE_X]:
                before, after = cell - 1, cell + 1
                if wraps[0]:
                    before, after = before if cell > 0 else rows - 1, after if after < rows else 0
                a, c = level[_START] + before * level[_STRIDE], level[_START] + after * level[_STRIDE]
                row_a = sums[a : a + wide] if before >= 0 else nothing
                row_c = sums[c : c + wide] if after < rows else nothing
                for j in range(wide):
                    mixed[j] = half * row_b[j] + far * (row_a[j] + row_c[j])
                row_b = mixed
            if way[2] == _DEFLECT and level[_AVERAGE_Y]:
                for j in range(wide):
                    mixed[j] = row_b[j]
                line[0], line[wide + 1] = (line[wide], line[1]) if wraps[1] else (nothing[0], nothing[0])
                for j in range(wide):
                    out[j] = weight * (half * line[j + 1] + far * (line[j] + line[j + 2]))
            else:
                for j in range(wide):
                    out[j] = weight * row_b[j]
            if depth == top:
                continue
            above = levels[depth + 1]
            columns = above[_COLUMNS]
            lead = 1 if wraps[1] else 0
            own_line = line[lead : lead + columns]
            if above[_MERGE_X]:
                parent = cell >> 1 if wraps[0] else (cell >> 1) + 1
                beside = parent - 1 if cell & 1 == 0 else parent + 1
                if wraps[0]:
                    beside = above[_ROWS] - 1 if beside < 0 else 0 if beside >= above[_ROWS] else beside
                a, b = above[_START] + parent * above[_STRIDE], above[_START] + beside * above[_STRIDE]
                row_a, row_b = cells[a : a + columns], cells[b : b + columns]
                for k in range(columns):
                    own_line[k] = near * row_a[k] + far * row_b[k]
            else:
                a = above[_START] + cell * above[_STRIDE]
                row_a = cells[a : a + columns]
                for k in range(columns):
                    own_line[k] = row_a[k]
            if above[_MERGE_Y]:
                if wraps[1]:
                    line[0], line[columns + 1] = line[columns], line[1]
                for k in range(wide >> 1):
                    out[2 * k] += own[2 * k] * (near * line[k + 1] + far * line[k])
                    out[2 * k + 1] += own[2 * k + 1] * (near * line[k + 1] + far * line[k + 2])
                if wide & 1:
                    k = wide >> 1
                    out[wide - 1] += own[wide - 1] * (near * line[k + 1] + far * line[k])
            else:
                for j in range(wide):
                    out[j] += own[j] * own_line[j]


@compiled
def _at_points(span, levels, wraps, members, memory, stencil, vectors, out, products):  # type: ignore[no-untyped-def]
    """out = (stencil[0] + stencil[1] count) values + what the neighbours among the ``points`` and the cells of level 1 add, at the points of a set.

    ``members`` of the set are (rows, index), ``memory`` is (lines, found, points, cells), found being lines as well: were they rows of the same array, the
    loop that writes every second value would not be vectorised. ``stencil`` holds further the factors of the nearest points along x and y, of those at twice the distance
    along x and y, of the diagonal ones, and of the deflection of the cells. ``vectors`` are values, count, and two of which the products with out are
    left in ``products``, row by row, after the sum of out.
    """
    rows, index = members
    lines, founds, points, cells = memory
    values, count, one, other = vectors
    own, each, x1, y1, x2, y2, diagonal, factor = stencil
    near, far = points.dtype.type(0.75), points.dtype.type(0.25)
    height, columns, stride = levels[0, _ROWS], levels[0, _COLUMNS], levels[0, _STRIDE]
    level = levels[1]
    wide, merges_x, merges_y = level[_COLUMNS], level[_MERGE_X], level[_MERGE_Y]
    thread = -(-span[0] * len(lines) // _PARTS)
    line, found = lines[thread, 0], founds[thread]
    for row in range(height * span[0] // _PARTS, height * span[1] // _PARTS):
        total = 0.0
        with_one = 0.0
        with_other = 0.0
        base = row * columns
        if rows[row] < rows[row + 1]:
            first = (np.int64(index[rows[row]]) - base) >> 1  # in pairs of columns
            pairs = ((np.int64(index[rows[row + 1] - 1]) - base) >> 1) + 1 - first
            parent, beside = row, row
            if merges_x:
                parent = row >> 1 if wraps[0] else (row >> 1) + 1
                beside = parent - 1 if row & 1 == 0 else parent + 1
                if wraps[0]:
                    beside = level[_ROWS] - 1 if beside < 0 else 0 if beside >= level[_ROWS] else beside
            a, b = level[_START] + parent * level[_STRIDE], level[_START] + beside * level[_STRIDE]
            if merges_y:
                begin, number = first if wraps[1] else first + 1, pairs
                left, right = begin - 1, begin + number
                if wraps[1]:
                    left = wide - 1 if left < 0 else left
                    right = 0 if right >= wide else right
                right = min(right, wide - 1)
                row_a, row_b = cells[a + begin : a + begin + number], cells[b + begin : b + begin + number]
                middle = line[1 : number + 1]
                for k in range(number):
                    middle[k] = factor * (near * row_a[k] + far * row_b[k])
                line[0] = factor * (near * cells[a + left] + far * cells[b + left])
                line[number + 1] = factor * (near * cells[a + right] + far * cells[b + right])
                for k in range(number):
                    found[2 * k] = near * line[k + 1] + far * line[k]
                    found[2 * k + 1] = near * line[k + 1] + far * line[k + 2]
            else:
                begin, number = 2 * first, min(2 * pairs, columns - 2 * first)
                row_a, row_b = cells[a + begin : a + begin + number], cells[b + begin : b + begin + number]
                for j in range(number):
                    found[j] = factor * (near * row_a[j] + far * row_b[j])
            place = levels[0, _START] + row * stride + 2 * first
            here = points[place - _MARGIN : place + 2 * pairs + _MARGIN]
            up, down = (
                points[place - stride - 1 : place - stride + 2 * pairs + 1],
                points[place + stride - 1 : place + stride + 2 * pairs + 1],
            )
            for j in range(2 * pairs):
                found[j] += x1 * (up[j + 1] + down[j + 1]) + y1 * (here[j + 1] + here[j + 3])
            if diagonal != 0.0:
                for j in range(2 * pairs):
                    found[j] += diagonal * ((up[j] + down[j]) + (up[j + 2] + down[j + 2]))
            if x2 != 0.0 or y2 != 0.0:
                above, below = (
                    points[place - 2 * stride : place - 2 * stride + 2 * pairs],
                    points[place + 2 * stride : place + 2 * stride + 2 * pairs],
                )
                for j in range(2 * pairs):
                    found[j] += x2 * (above[j] + below[j]) + y2 * (here[j] + here[j + 4])
            begins, ends, before = natural(rows[row]), natural(rows[row + 1]), natural(base + 2 * first)
            for k in range(begins, ends):
                out[k] = found[natural(index[k]) - before]
            for k in range(begins, ends):
                z = (own + each * count[k]) * values[k] + out[k]
                out[k] = z
                total += z
                with_one += np.float64(z) * one[k]
                with_other += np.float64(z) * other[k]
        products[row, 0] = total
        products[row, 1] = with_one
        products[row, 2] = with_other


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
        self._lines = np.zeros((min(blocks.threads, _PARTS), 3, shape[1] + 8), dtype)
        self._lines[:, 2] = 1.0
        self._found = np.zeros((len(self._lines), shape[1] + 8), dtype)
        self._products = np.empty((shape[0], 3))
        self._wraps, kind = model.wraps, np.dtype(dtype).type
        self._inverse, self._weights = (
            np.array([0.0, *weights], dtype) for weights in (model.inverse_weights, model.weights)
        )
        point, *nearest, diagonal = model.own
        own = (point, 0.0, *(0.5 * side for side in nearest), 0.0, 0.0, 0.25 * diagonal, 1.0)
        stiff = (
            1.0 + 0.375 * sum(model.bend),
            1.0,
            *(-0.25 * (fall + bend) for fall, bend in zip(model.fall, model.bend, strict=True)),
            *(0.0625 * bend for bend in model.bend),
            0.0,
            -1.0,
        )
        self._own = tuple(kind(value) for value in own)
        self._stiff = tuple(kind(model.stiffness * value) for value in stiff)
        self._falls = tuple(kind(0.25 * fall) for fall in model.fall)
        self._count = np.empty(0, dtype)
        self._loaded: Callable[[], Any] = lambda: None

    def factorise(self, free: Any, conductance: RealArray | None = None) -> None:
        """g of all cells, and the local stiffness of every point of ``free`` by its neighbours.

        ``conductance``: factors (of any sign) to the yielding of the points to their own load, one if not given.
        """
        unit = np.ones(free.size, self._points.dtype) if conductance is None else conductance.copy()
        self._rise(free, unit, _FACTORISE, self._inverse)
        _neighbours(free.rows, free.index, self._layout.levels, self._points, self._falls, unit)
        self._count = unit

    def solve(self, free: Any, r: RealArray, other: RealArray, out: RealArray) -> Products:
        """Inverse times ``r``, see ``protocol.Splines``."""
        self._rise(free, r, _SOLVE, self._inverse)
        self._fall(_SOLVE, self._inverse)
        return self._at_points(free, self._stiff, r, self._count, r, other, out)

    def solve_with(self, free: Any, r: RealArray, conductance: RealArray) -> RealArray:
        """Inverse times ``r`` after ``factorise`` with the same ``conductance``; not quite symmetric."""
        self._rise(free, conductance * r, _SOLVE, self._inverse)
        self._fall(_SOLVE, self._inverse)
        found: RealArray = self._at_points(free, self._stiff, r, self._count, r, r, np.empty_like(r)).vector
        found *= conductance
        return found

    def deflection(self, free: Any, t: RealArray, other: RealArray, out: RealArray) -> Products:
        """Deflection by ``t``, see ``protocol.Splines``."""
        self._rise(free, t, _DEFLECT, self._weights)
        self._fall(_DEFLECT, self._weights)
        return self._at_points(free, self._own, t, t, t, other, out)

    def predicted_residual(self, free: Any, r: RealArray, loaded: Any, change: RealArray) -> RealArray:
        """``r`` less the deflection of the points of ``free`` by ``change``."""
        self._rise(loaded, change, _DEFLECT, self._weights)
        self._fall(_DEFLECT, self._weights)
        at = free.empty()
        _gather(free.rows, free.index, self._layout.levels, self._points, at)
        u = self._at_points(free, self._own, at, at, at, at, np.empty_like(r)).vector
        found: RealArray = np.subtract(r, u, out=u)
        return found

    def late_sweeps(self, free: Any) -> list[Callable[[], Any]]:
        """Calls of the sweeps that a solve needs last, on ``free``: see ``first_use``."""
        vector = free.zeros()
        at = (free, self._own, vector, vector, vector, vector, free.empty())
        gathered = (free.rows, free.index, self._layout.levels, self._points, vector)
        return [
            partial(self._fall, _DEFLECT, self._weights),
            partial(self._at_points, *at),
            partial(_gather, *gathered),
        ]

    def _rise(self, set_: Any, values: RealArray, purpose: int, weights: RealArray) -> None:
        """Loads ``values`` of the set at its points, and their sums on all levels."""
        levels, large, top = self._layout[:3]
        if self._loaded() is not set_:
            self._points[...] = 0.0
            self._loaded = ref(set_)
        _place(set_.rows, set_.index, levels, self._wraps, values, self._points)
        arguments = self._wraps, weights, self._lines, self._points, self._sums, self._g
        for depth in range(1, large + 1):
            self._share(_rise, levels, (depth, depth, purpose), *arguments, serial=False)
        if large < top:
            self._share(_rise, levels, (large + 1, top, purpose), *arguments, serial=True)

    def _fall(self, purpose: int, weights: RealArray) -> None:
        """Deflections on all levels."""
        levels, large, top = self._layout[:3]
        arguments = self._wraps, weights, self._lines, self._sums, self._g, self._cells
        if large < top:
            self._share(_fall, levels, (top, large + 1, purpose), *arguments, serial=True)
        for depth in range(large, 0, -1):
            self._share(_fall, levels, (depth, depth, purpose), *arguments, serial=False)

    def _at_points(
        self, free: Any, stencil: tuple[Any, ...], values: RealArray, count: RealArray, *vectors: RealArray
    ) -> Products:
        """Values at the points of ``free`` from those of the points and the cells around them."""
        levels, products = self._layout.levels, self._products
        one, other, out = vectors
        arguments = (
            (free.rows, free.index),
            (self._lines, self._found, self._points, self._cells),
            stencil,
            (values, count, one, other),
            out,
            products,
        )
        self._share(_at_points, levels, self._wraps, *arguments, serial=self._layout.large == 0)
        return Products(out, *np.add.reduce(products).tolist())

    def _share(self, kernel: Any, *arguments: Any, serial: bool) -> None:
        self._blocks.share(kernel, _PARTS, *arguments, serial=serial)


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
    return _Layout(np.array(levels, np.int64), large, len(merges), (shape[0] + 5) * stride, size)
