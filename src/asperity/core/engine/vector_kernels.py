"""Compiled sweeps over nested cells of loads and deflections with two components.

A point may yield along one direction only, or by more along one than along the other: its conductance is a symmetric tensor. S, T and g of
``cell_kernels`` then are a vector and tensors, which commute, so that its formulas hold as they stand. ``g`` and ``t`` hold the entries xx, xy, yy of all
cells, ``s`` the components.
"""

from __future__ import annotations

from .cell_kernels import COLUMNS, MERGE_X, MERGE_Y, OFFSET_X, OFFSET_Y, ROLL_X, ROLL_Y, ROWS, START, STRIDE
from .kernels import compiled


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
    """g = (1 + w T)^-1 in the hierarchies of the span, for the points ``index`` with the ``conductance`` (3, n)."""
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
    """Deflections of the finest cells of the hierarchies of the span, left in s, under the loads ``values`` (2, n)."""
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
