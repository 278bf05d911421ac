"""Compiled sweeps over nested cells, of loads and deflections with two components: summed up the
levels, prolonged down again.

The compliance of nested cells is B = 1 + sum over cells of w 1 1^T, in units of the deflection of a
point under its own load. Its inverse on any set of points follows from the Sherman-Morrison
formula, cell by cell: with S the sum over the parts of a cell of what they pass up, T the same for
unit loads, and g = 1 / (1 + w T), a cell passes up g S and down the deflection D = g (D of its
parent + w S).

A point may yield along one direction only, or by more along one than along the other: its
conductance is a symmetric tensor. S, T and g then are a vector and tensors, which commute, so that
the formulas hold as they stand. ``g`` and ``t`` hold the entries xx, xy, yy of all cells, ``s`` the
components: the sums S on the way up and the deflections D on the way down.

``levels`` holds for every hierarchy and level: place of its first cell, cells along x and y,
distance of rows, and for the step from the level below: whether pairs merge along x and y (1 or 0),
and the offsets; then, how far the points are rolled along x and y, round the grid, before they form
cells. Level 0 are the points. Cells are stored with a rim of empty ones (g = s = 0), so the edges
are no special case.
"""

from __future__ import annotations

import numpy as np

from .kernels import compiled, natural

START, ROWS, COLUMNS, STRIDE, MERGE_X, MERGE_Y, OFFSET_X, OFFSET_Y, ROLL_X, ROLL_Y = range(10)


@compiled
def _sum_points(level, shape, rows, index, values, s):  # type: ignore[no-untyped-def]
    """First level of cells: s = sum of the values of its points."""
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        s[base : base + level[COLUMNS]] = 0.0
        first = (cell << level[MERGE_X]) - level[OFFSET_X]
        for moved in range(max(first, 0), min(first + 1 + level[MERGE_X], shape[0])):
            row = moved - level[ROLL_X]
            row += shape[0] if row < 0 else 0
            shift = level[OFFSET_Y] + level[ROLL_Y] - row * shape[1]
            end = shape[1] + level[OFFSET_Y]
            for k in range(rows[row], rows[row + 1]):
                column = index[k] + shift
                column -= shape[1] if column >= end else 0
                place = base + (column >> level[MERGE_Y])
                s[place] += values[k]


@compiled
def _restrict_tensors(below, level, g, t):  # type: ignore[no-untyped-def]
    """t of a level = sum of g t over the parts of its cells."""
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            xx = xy = yy = 0.0
            for row in range(1 + level[MERGE_X]):
                first = (
                    below[START] + ((cell << level[MERGE_X]) - level[OFFSET_X] + row) * below[STRIDE] - level[OFFSET_Y]
                )
                for column in range(1 + level[MERGE_Y]):
                    a = first + (j << level[MERGE_Y]) + column
                    xx += g[0, a] * t[0, a] + g[1, a] * t[1, a]
                    xy += g[0, a] * t[1, a] + g[1, a] * t[2, a]
                    yy += g[1, a] * t[1, a] + g[2, a] * t[2, a]
            t[0, base + j], t[1, base + j], t[2, base + j] = xx, xy, yy


@compiled
def factorise_tensors(span, levels, weights, shape, rows, index, conductance, g, t):  # type: ignore[no-untyped-def]
    """g = (1 + w T)^-1 in the hierarchies of the span, for the points ``index`` with the
    ``conductance`` (3, n)."""
    for hierarchy in range(span[0], span[1]):
        for depth in range(1, levels.shape[1]):
            level = levels[hierarchy, depth]
            if depth == 1:
                for entry in range(3):
                    _sum_points(level, shape, rows, index, conductance[entry], t[entry])
            else:
                _restrict_tensors(levels[hierarchy, depth - 1], level, g, t)
            weight = weights[depth]
            for cell in range(level[ROWS]):
                base = level[START] + cell * level[STRIDE]
                for j in range(base, base + level[COLUMNS]):
                    xx, xy, yy = 1.0 + weight * t[0, j], weight * t[1, j], 1.0 + weight * t[2, j]
                    scale = 1.0 / (xx * yy - xy * xy)
                    g[0, j], g[1, j], g[2, j] = yy * scale, -xy * scale, xx * scale


@compiled
def _restrict_vectors(below, level, g, s):  # type: ignore[no-untyped-def]
    """s of a level = sum of g s over the parts of its cells."""
    xx, xy, yy, x, y = g[0], g[1], g[2], s[0], s[1]
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        x[base : base + level[COLUMNS]] = 0.0
        y[base : base + level[COLUMNS]] = 0.0
        for row in range(1 + level[MERGE_X]):
            part = below[START] + ((cell << level[MERGE_X]) - level[OFFSET_X] + row) * below[STRIDE] - level[OFFSET_Y]
            if level[MERGE_Y]:
                for j in range(level[COLUMNS]):
                    a, b = part + 2 * j, part + 2 * j + 1
                    x[base + j] += xx[a] * x[a] + xy[a] * y[a] + xx[b] * x[b] + xy[b] * y[b]
                    y[base + j] += xy[a] * x[a] + yy[a] * y[a] + xy[b] * x[b] + yy[b] * y[b]
            else:
                for j in range(level[COLUMNS]):
                    a = part + j
                    x[base + j] += xx[a] * x[a] + xy[a] * y[a]
                    y[base + j] += xy[a] * x[a] + yy[a] * y[a]


@compiled
def _prolong_vectors(above, level, weight, g, s):  # type: ignore[no-untyped-def]
    """s = g (deflection of the parent + weight s)."""
    xx, xy, yy, x, y = g[0], g[1], g[2], s[0], s[1]
    for cell in range(level[ROWS]):
        parent = above[START] + ((cell + above[OFFSET_X]) >> above[MERGE_X]) * above[STRIDE]
        base = level[START] + cell * level[STRIDE] - above[OFFSET_Y]
        for j in range(above[COLUMNS]):
            for a in range(base + (j << above[MERGE_Y]), base + ((j + 1) << above[MERGE_Y])):
                along, across = x[parent + j] + weight * x[a], y[parent + j] + weight * y[a]
                x[a] = xx[a] * along + xy[a] * across
                y[a] = xy[a] * along + yy[a] * across


@compiled
def vector_deflections(span, levels, weights, shape, rows, index, values, g, s):  # type: ignore[no-untyped-def]
    """Deflections of the finest cells of the hierarchies of the span, left in s, under the loads
    ``values`` (2, n)."""
    for hierarchy in range(span[0], span[1]):
        own = levels[hierarchy]
        last = own.shape[0] - 1
        for component in range(2):
            _sum_points(own[1], shape, rows, index, values[component], s[component])
        for depth in range(2, last + 1):
            _restrict_vectors(own[depth - 1], own[depth], g, s)
        top = own[last]
        for cell in range(top[ROWS]):
            base = top[START] + cell * top[STRIDE]
            for j in range(base, base + top[COLUMNS]):
                along, across = weights[last] * s[0, j], weights[last] * s[1, j]
                s[0, j] = g[0, j] * along + g[1, j] * across
                s[1, j] = g[1, j] * along + g[2, j] * across
        for depth in range(last - 1, 0, -1):
            _prolong_vectors(own[depth + 1], own[depth], weights[depth], g, s)


@compiled
def subtract_deflections(span, levels, shape, rows, index, values, other, s, out, sums):  # type: ignore[no-untyped-def]
    """out = values - mean of the deflections of two hierarchies in s; per row: sums of out, with
    values, with other."""
    half = s.dtype.type(0.5)
    one, two = levels[0, 1], levels[1, 1]
    merge_one, merge_two = one[MERGE_Y], two[MERGE_Y]
    end_one, end_two = shape[1] + one[OFFSET_Y], shape[1] + two[OFFSET_Y]
    for row in range(span[0], span[1]):
        moved_one, moved_two = row + one[ROLL_X], row + two[ROLL_X]
        moved_one -= shape[0] if moved_one >= shape[0] else 0
        moved_two -= shape[0] if moved_two >= shape[0] else 0
        base_one = one[START] + ((moved_one + one[OFFSET_X]) >> one[MERGE_X]) * one[STRIDE]
        base_two = two[START] + ((moved_two + two[OFFSET_X]) >> two[MERGE_X]) * two[STRIDE]
        shift_one = one[OFFSET_Y] + one[ROLL_Y] - row * shape[1]
        shift_two = two[OFFSET_Y] + two[ROLL_Y] - row * shape[1]
        total = 0.0
        with_values = 0.0
        with_other = 0.0
        for k in range(rows[row], rows[row + 1]):
            i = index[k]
            column_one, column_two = i + shift_one, i + shift_two
            column_one -= shape[1] if column_one >= end_one else 0
            column_two -= shape[1] if column_two >= end_two else 0
            d = s[natural(base_one + (column_one >> merge_one))] + s[natural(base_two + (column_two >> merge_two))]
            z = values[k] - half * d
            out[k] = z
            total += z
            with_values += np.float64(z) * values[k]
            with_other += np.float64(z) * other[k]
        sums[row, 0] = total
        sums[row, 1] = with_values
        sums[row, 2] = with_other
