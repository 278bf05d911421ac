"""Nested quadratic B-splines of the CPU engine: compiled sweeps sum loads up the levels and prolong
deflections down again.

A cell of a level merges two of the level below along one axis or both. Its B-spline reaches half a
cell beyond it on either side: a part passes three quarters of its load to the cell that it lies in
and a quarter to the nearest other, along each axis, and takes its deflection from both in the same
shares. Where the axis wraps, the first cell comes after the last one; else there is one more cell
at either end, beyond the points. The compliance averages the loads of neighbouring cells of a level
(half of a cell's own and a quarter of that beside it on either side) before they deflect it, along
the axes for which the model says so.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any
from weakref import ref

import numpy as np

from ..arrays import RealArray
from .blocks import Blocks
from .kernels import compiled, natural
from .protocol import Products, SplineModel
from .row_sums import corrected, overlaps
from .spline_levels import (
    AVERAGE_X,
    AVERAGE_Y,
    COLUMNS,
    DEFLECT,
    FACTORISE,
    MARGIN,
    MERGE_X,
    MERGE_Y,
    PARTS,
    ROWS,
    SOLVE,
    START,
    STRIDE,
    layout,
)


@compiled
def _surround(levels, wraps, points):  # type: ignore[no-untyped-def]
    """Values beyond the rim of the array of points: those of the other end where the axis wraps,
    else zero."""
    start, rows, columns, stride = levels[0, START], levels[0, ROWS], levels[0, COLUMNS], levels[0, STRIDE]
    for row in range(rows):
        for k in range(MARGIN):
            base = start + row * stride
            points[base - 1 - k] = points[base + (-1 - k) % columns] if wraps[1] else 0.0
            points[base + columns + k] = points[base + k % columns] if wraps[1] else 0.0
    for k in range(MARGIN):
        before, after = start - (1 + k) * stride - MARGIN, start + (rows + k) * stride - MARGIN
        last, first = start + (-1 - k) % rows * stride - MARGIN, start + k % rows * stride - MARGIN
        for j in range(columns + 2 * MARGIN):
            points[before + j] = points[last + j] if wraps[0] else 0.0
            points[after + j] = points[first + j] if wraps[0] else 0.0


@compiled
def place(rows, index, levels, wraps, values, points):  # type: ignore[no-untyped-def]
    """Set the array of points to the ``values`` at the points of a set, and beyond its rim."""
    for row in range(levels[0, ROWS]):
        shift = levels[0, START] + row * (levels[0, STRIDE] - levels[0, COLUMNS])
        for k in range(natural(rows[row]), natural(rows[row + 1])):
            points[natural(index[k] + shift)] = values[k]
    _surround(levels, wraps, points)


@compiled
def gather(rows, index, levels, points, out):  # type: ignore[no-untyped-def]
    """Values of the array of points at the points of a set."""
    for row in range(levels[0, ROWS]):
        shift = levels[0, START] + row * (levels[0, STRIDE] - levels[0, COLUMNS])
        for k in range(natural(rows[row]), natural(rows[row + 1])):
            out[k] = points[natural(index[k] + shift)]


@compiled
def local_stiffness(span, levels, members, memory, stencil, alone, together):  # type: ignore[no-untyped-def]
    """Of the local stiffness at the points of a set: its own entry ``alone``, and the sum
    ``together`` of its row, for points that yield by the values of the array of points.

    ``members`` of the set are (rows, index), ``memory`` is (found, under, points) as for
    ``at_points``. ``stencil`` holds the entry without neighbours, what each nearest point along x
    and y adds to it, the entries of these, and those of the points at twice the distance.
    """
    rows, index = members
    founds, unders, points = memory
    own, fall_x, fall_y, x1, y1, x2, y2 = stencil
    height, columns, stride = levels[0, ROWS], levels[0, COLUMNS], levels[0, STRIDE]
    thread = -(-span[0] * len(founds) // PARTS)
    found, under = founds[thread], unders[thread]
    for row in range(height * span[0] // PARTS, height * span[1] // PARTS):
        if rows[row] == rows[row + 1]:
            continue
        first = np.int64(index[rows[row]]) - row * columns
        number = np.int64(index[rows[row + 1] - 1]) - row * columns + 1 - first
        place = levels[0, START] + row * stride + first
        here = points[place - MARGIN : place + number + MARGIN]
        up, down = points[place - stride : place - stride + number], points[place + stride : place + stride + number]
        above = points[place - 2 * stride : place - 2 * stride + number]
        below = points[place + 2 * stride : place + 2 * stride + number]
        for j in range(number):
            x, y = up[j] + down[j], here[j + 1] + here[j + 3]
            entry = own + fall_x * x + fall_y * y
            found[j] = entry
            under[j] = entry + x1 * x + y1 * y + x2 * (above[j] + below[j]) + y2 * (here[j] + here[j + 4])
        begins, ends, before = natural(rows[row]), natural(rows[row + 1]), natural(row * columns + first)
        for k in range(begins, ends):
            i = natural(index[k]) - before
            alone[k] = found[i]
            together[k] = under[i]


@compiled
def rise(span, levels, way, wraps, weights, lines, points, sums, g):  # type: ignore[no-untyped-def]
    """Sums over the cells of the levels ``way[0]`` to ``way[1]`` of the loads on the ``points``, of
    the rows of the span.

    What a level passes up is left in ``sums``: g S of its sums S, or, to ``DEFLECT``, S itself. To
    ``FACTORISE`` (``way[2]``), g = 1 / (1 + w S) is set.
    """
    near, far, one = g.dtype.type(0.75), g.dtype.type(0.25), g.dtype.type(1.0)
    scratch = lines[-(-span[0] * len(lines) // PARTS)]
    line, nothing, unit = scratch[0], scratch[1], scratch[2]
    for k in range(3):
        line[k] = 0.0
    for depth in range(way[0], way[1] + 1):
        fine, level, weight = levels[depth - 1], levels[depth], weights[depth]
        source = points if depth == 1 else sums
        rows, columns, below, stride = fine[ROWS], fine[COLUMNS], fine[START], fine[STRIDE]
        lead = 1 if wraps[1] else 3
        for cell in range(level[ROWS] * span[0] // PARTS, level[ROWS] * span[1] // PARTS):
            own_line = line[lead : lead + columns]
            if level[MERGE_X]:
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
            start, wide = level[START] + cell * level[STRIDE], level[COLUMNS]
            out, own = sums[start : start + wide], g[start : start + wide] if way[2] != DEFLECT else unit
            if level[MERGE_Y]:
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
            if way[2] == FACTORISE:
                for k in range(wide):
                    own[k] = one / (one + weight * out[k])
            for k in range(wide):
                out[k] *= own[k]


@compiled
def fall(span, levels, way, wraps, weights, lines, sums, g, cells, target):  # type: ignore[no-untyped-def]
    """Deflections of the ``cells`` of the levels ``way[0]`` down to ``way[1]``, of the rows of the
    span, from what ``rise`` has left in ``sums``.

    They are left in ``target``, which is ``cells`` but for a single level. That of a level is w g S
    plus g times that of the level above; to ``DEFLECT``, w times the average of S over neighbouring
    cells plus that of the level above.
    """
    near, far, half = g.dtype.type(0.75), g.dtype.type(0.25), g.dtype.type(0.5)
    scratch = lines[-(-span[0] * len(lines) // PARTS)]
    line, nothing, unit = scratch[0], scratch[1], scratch[2]
    top = len(levels) - 1
    for depth in range(way[0], way[1] - 1, -1):
        level, weight, wide, rows = levels[depth], weights[depth], levels[depth, COLUMNS], levels[depth, ROWS]
        for cell in range(rows * span[0] // PARTS, rows * span[1] // PARTS):
            start = level[START] + cell * level[STRIDE]
            out, own = target[start : start + wide], g[start : start + wide] if way[2] != DEFLECT else unit
            row_b, mixed = sums[start : start + wide], line[1 : wide + 1]
            if way[2] == DEFLECT and level[AVERAGE_X]:
                before, after = cell - 1, cell + 1
                if wraps[0]:
                    before, after = before if cell > 0 else rows - 1, after if after < rows else 0
                a, c = level[START] + before * level[STRIDE], level[START] + after * level[STRIDE]
                row_a = sums[a : a + wide] if before >= 0 else nothing
                row_c = sums[c : c + wide] if after < rows else nothing
                for j in range(wide):
                    mixed[j] = half * row_b[j] + far * (row_a[j] + row_c[j])
                row_b = mixed
            if way[2] == DEFLECT and level[AVERAGE_Y]:
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
            columns = above[COLUMNS]
            lead = 1 if wraps[1] else 0
            own_line = line[lead : lead + columns]
            if above[MERGE_X]:
                parent = cell >> 1 if wraps[0] else (cell >> 1) + 1
                beside = parent - 1 if cell & 1 == 0 else parent + 1
                if wraps[0]:
                    beside = above[ROWS] - 1 if beside < 0 else 0 if beside >= above[ROWS] else beside
                a, b = above[START] + parent * above[STRIDE], above[START] + beside * above[STRIDE]
                row_a, row_b = cells[a : a + columns], cells[b : b + columns]
                for k in range(columns):
                    own_line[k] = near * row_a[k] + far * row_b[k]
            else:
                a = above[START] + cell * above[STRIDE]
                row_a = cells[a : a + columns]
                for k in range(columns):
                    own_line[k] = row_a[k]
            if above[MERGE_Y]:
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
def _around(points, at, stencil, adds, found):  # type: ignore[no-untyped-def]
    """What the neighbours among the ``points`` give to those ``at`` a place, a number of them in a
    row (then the distance of rows), by the ``stencil`` of ``at_points``: added to what is ``found``
    there if it ``adds``, else instead of it."""
    place, number, stride = at
    x1, y1, x2, y2, diagonal, _ = stencil
    here = points[place - MARGIN : place + number + MARGIN]
    up = points[place - stride - 1 : place - stride + number + 1]
    down = points[place + stride - 1 : place + stride + number + 1]
    above = points[place - 2 * stride : place - 2 * stride + number]
    below = points[place + 2 * stride : place + 2 * stride + number]
    beyond = x2 != 0.0 or y2 != 0.0
    if beyond and not adds:
        for j in range(number):
            nearest = x1 * (up[j + 1] + down[j + 1]) + y1 * (here[j + 1] + here[j + 3])
            found[j] = nearest + x2 * (above[j] + below[j]) + y2 * (here[j] + here[j + 4])
        return
    if not adds:
        for j in range(number):
            found[j] = points.dtype.type(0.0)
    if beyond:
        for j in range(number):
            nearest = x1 * (up[j + 1] + down[j + 1]) + y1 * (here[j + 1] + here[j + 3])
            found[j] += nearest + x2 * (above[j] + below[j]) + y2 * (here[j] + here[j + 4])
    else:
        for j in range(number):
            nearest = x1 * (up[j + 1] + down[j + 1]) + y1 * (here[j + 1] + here[j + 3])
            found[j] += nearest + diagonal * ((up[j] + down[j]) + (up[j + 2] + down[j + 2]))


@compiled
def at_points(span, levels, wraps, members, memory, stencil, vectors, out, products):  # type: ignore[no-untyped-def]
    """out = alone values + what the neighbours among the ``points`` add + share times the
    deflection of the cells of level 1, at the points of a set.

    ``members`` of the set are (rows, index), ``memory`` is (lines, found, under, points, cells),
    found and under being lines as well: were they rows of the same array, the loop that writes
    every second value would not be vectorised. ``stencil`` holds the factors of the nearest points
    along x and y, of those at twice the distance along x and y, of the diagonal ones (if those are
    zero), and of the deflection of the cells. ``vectors`` are values, alone and share (of one entry
    each if they are the same at all points, which is a share of one), and two of which the products
    with out are left in ``products``, row by row, after the sum of out.
    """
    rows, index = members
    lines, founds, unders, points, cells = memory
    values, alone, share, one, other = vectors
    each, apart = natural(1) if alone.size > 1 else natural(0), share.size == values.size
    factor = stencil[5]
    near, far = points.dtype.type(0.75), points.dtype.type(0.25)
    height, columns, stride = levels[0, ROWS], levels[0, COLUMNS], levels[0, STRIDE]
    level = levels[1]
    wide, merges_x, merges_y = level[COLUMNS], level[MERGE_X], level[MERGE_Y]
    thread = -(-span[0] * len(lines) // PARTS)
    line, found, under = lines[thread, 0], founds[thread], unders[thread] if apart else founds[thread]
    for row in range(height * span[0] // PARTS, height * span[1] // PARTS):
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
                    beside = level[ROWS] - 1 if beside < 0 else 0 if beside >= level[ROWS] else beside
            a, b = level[START] + parent * level[STRIDE], level[START] + beside * level[STRIDE]
            if merges_y:
                begin, number = first if wraps[1] else first + 1, pairs
                left, right = begin - 1 if begin > 0 else wide - 1, begin + number
                right = 0 if wraps[1] and right >= wide else min(right, wide - 1)
                row_a, row_b = cells[a + begin : a + begin + number], cells[b + begin : b + begin + number]
                middle = line[1 : number + 1]
                for k in range(number):
                    middle[k] = factor * (near * row_a[k] + far * row_b[k])
                line[0] = factor * (near * cells[a + left] + far * cells[b + left])
                line[number + 1] = factor * (near * cells[a + right] + far * cells[b + right])
                for k in range(number):
                    under[2 * k] = near * line[k + 1] + far * line[k]
                    under[2 * k + 1] = near * line[k + 1] + far * line[k + 2]
            else:
                begin, number = 2 * first, min(2 * pairs, columns - 2 * first)
                row_a, row_b = cells[a + begin : a + begin + number], cells[b + begin : b + begin + number]
                for j in range(number):
                    under[j] = factor * (near * row_a[j] + far * row_b[j])
            place = levels[0, START] + row * stride + 2 * first
            _around(points, (place, 2 * pairs, stride), stencil, not apart, found)
            begins, ends, before = natural(rows[row]), natural(rows[row + 1]), natural(base + 2 * first)
            if apart:
                for k in range(begins, ends):
                    i = natural(index[k]) - before
                    out[k] = found[i] + share[k] * under[i]
            else:
                for k in range(begins, ends):
                    out[k] = found[natural(index[k]) - before]
            for k in range(begins, ends):
                z = alone[k * each] * values[k] + out[k]
                out[k] = z
                total += z
                with_one += np.float64(z) * one[k]
                with_other += np.float64(z) * other[k]
        products[0, row] = total
        products[1, row] = with_one
        products[2, row] = with_other


@compiled
def fall_corrected(levels, way, wraps, weights, lines, sums, g, correction, cells):  # type: ignore[no-untyped-def]
    """``fall`` to solve, through the levels ``way[0]`` down to ``way[1]``, with the ``correction``
    (zeros, mean, per, raw) of every level."""
    for depth in range(way[0], way[1] - 1, -1):
        fall((0, PARTS), levels, (depth, depth, SOLVE), wraps, weights, lines, sums, g, cells, correction[3])
        corrected((0, PARTS), levels, depth, wraps, *correction, cells)


# All levels in one piece of memory, rows of the large ones shared by the threads.


class CpuSplines:
    """Compliance of nested splines and its inverse on a free set."""

    def __init__(self, blocks: Blocks, shape: tuple[int, int], model: SplineModel, dtype: str) -> None:
        self._blocks = blocks
        self._layout = layout(shape, model.merges, model.averages, model.wraps)
        self._points, cells = np.zeros(self._layout.points, dtype), self._layout.cells
        self._sums, self._g, self._cells = (np.zeros(cells, dtype) for _ in range(3))
        # for each thread: a line of sums or deflections, zeros and ones; what is found at the
        # points of a row
        self._lines = np.zeros((min(blocks.threads, PARTS), 3, shape[1] + 8), dtype)
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
        self._correction = self._lines[0, 1], *(np.zeros(size, dtype) for _ in range(3))
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
        """Local stiffness of every point of ``free``, g of all cells, and what the correction
        takes.

        ``conductance``: factors (of any sign) to the yielding of the points to their own load, one
        if not given. Then the cells are not corrected.
        """
        unit = np.ones(free.size, self._points.dtype) if conductance is None else conductance
        self._alone, together = np.empty_like(unit), np.empty_like(unit)
        self._rise(free, unit, FACTORISE, self._inverse)
        at = (free.rows, free.index), (self._found, self._under, self._points)
        stiffness = self._stencil, self._alone, together
        self._blocks.share(local_stiffness, PARTS, self._layout.levels, *at, *stiffness, serial=self._layout.large == 0)
        self._alone *= self._stiffness
        if self._first:
            self._together = together
        self._correct = self._first > 0 and conductance is None
        if self._correct:
            levels, _, larger, top = self._layout[:4]
            memory = self._wraps, self._shares, self._lines, self._points, self._sums, self._g, self._correction[1:3]
            for depth in range(self._first, larger + 1):
                self._blocks.share(overlaps, PARTS, levels, (depth, depth), *memory, serial=False)
            overlaps((0, PARTS), levels, (max(larger + 1, self._first), top), *memory)

    def solve(
        self, free: Any, r: RealArray, other: RealArray, out: RealArray, yielding: RealArray | None = None
    ) -> Products:
        """Inverse times ``r``, see ``protocol.Splines``, which acts on other points by how they are
        ``yielding`` to it, if given."""
        self._rise(free, r if yielding is None else yielding, SOLVE, self._inverse)
        if self._correct:
            # deflections on all levels, corrected from the first level on that is
            levels, _, larger, top = self._layout[:4]
            first, small, raw = self._first, larger + 1, self._correction[3]
            before = self._wraps, self._inverse, self._lines, self._sums, self._g
            fall_corrected(levels, (top, max(small, first)), *before, self._correction, self._cells)
            if first > small:
                fall((0, PARTS), levels, (first - 1, small, SOLVE), *before, self._cells, self._cells)
            for depth in range(larger, 0, -1):
                way, target = (depth, depth, SOLVE), raw if depth >= first else self._cells
                self._blocks.share(fall, PARTS, levels, way, *before, self._cells, target, serial=False)
                if depth >= first:
                    self._blocks.share(
                        corrected, PARTS, levels, depth, self._wraps, *self._correction, self._cells, serial=False
                    )
        else:
            self._fall(SOLVE, self._inverse)
        return self._at_points(free, self._stiff, r, self._alone, self._together, r, other, out)

    def solve_with(self, free: Any, r: RealArray, conductance: RealArray) -> RealArray:
        """Inverse times ``r`` after ``factorise`` with the same ``conductance``; not quite
        symmetric."""
        found: RealArray = self.solve(free, r, r, np.empty_like(r), conductance * r).vector
        found *= conductance
        return found

    def deflection(self, free: Any, t: RealArray, other: RealArray, out: RealArray) -> Products:
        """Deflection by ``t``, see ``protocol.Splines``."""
        self._rise(free, t, DEFLECT, self._weights)
        self._fall(DEFLECT, self._weights)
        return self._at_points(free, self._own, t, self._point, self._one, t, other, out)

    def predicted_residual(self, free: Any, r: RealArray, loaded: Any, change: RealArray) -> RealArray:
        """``r`` less the deflection of the points of ``free`` by ``change``."""
        self._rise(loaded, change, DEFLECT, self._weights)
        self._fall(DEFLECT, self._weights)
        at = free.empty()
        gather(free.rows, free.index, self._layout.levels, self._points, at)
        u = self._at_points(free, self._own, at, self._point, self._one, at, at, np.empty_like(r)).vector
        found: RealArray = np.subtract(r, u, out=u)
        return found

    def late_sweeps(self, free: Any) -> list[Callable[[], Any]]:
        """Calls of the sweeps that a solve needs last, on ``free``: see ``first_use``."""
        vector = free.zeros()
        at = (free, self._own, vector, self._point, self._one, vector, vector, free.empty())
        gathered = (free.rows, free.index, self._layout.levels, self._points, vector)
        return [
            partial(self._fall, DEFLECT, self._weights),
            partial(self._at_points, *at),
            partial(gather, *gathered),
        ]

    def _rise(self, set_: Any, values: RealArray, purpose: int, weights: RealArray) -> None:
        """Loads ``values`` of the set at its points and none elsewhere, and the sums of the loads
        on all levels."""
        if self._loaded() is not set_:
            self._points[...] = 0.0
            self._loaded = ref(set_)
        place(set_.rows, set_.index, self._layout.levels, self._wraps, values, self._points)
        levels, large, _, top = self._layout[:4]
        arguments = self._wraps, weights, self._lines, self._points, self._sums, self._g
        for depth in range(1, large + 1):
            self._blocks.share(rise, PARTS, levels, (depth, depth, purpose), *arguments, serial=False)
        if large < top:
            self._blocks.share(rise, PARTS, levels, (large + 1, top, purpose), *arguments, serial=True)

    def _fall(self, purpose: int, weights: RealArray) -> None:
        """Deflections on all levels."""
        levels, _, larger, top = self._layout[:4]
        arguments = self._wraps, weights, self._lines, self._sums, self._g, self._cells, self._cells
        if larger < top:
            self._blocks.share(fall, PARTS, levels, (top, larger + 1, purpose), *arguments, serial=True)
        for depth in range(larger, 0, -1):
            self._blocks.share(fall, PARTS, levels, (depth, depth, purpose), *arguments, serial=False)

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
        self._blocks.share(at_points, PARTS, levels, self._wraps, *arguments, serial=self._layout.large == 0)
        return Products(out, *np.add.reduce(products, axis=1).tolist())
