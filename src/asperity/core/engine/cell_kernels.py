"""Compiled sweeps over nested cells: loads summed up the levels, deflections prolonged down again.

The compliance of nested cells is B = 1 + sum over cells of w 1 1^T, in units of the deflection of a point under its own
load. Its inverse on any set of points follows from the Sherman-Morrison formula, cell by cell: with S the sum over the
parts of a cell of what they pass up, T the same for unit loads, and g = 1 / (1 + w T), a cell passes up g S and down
the deflection D = g (D of its parent + w S).

``levels`` holds for every hierarchy and level: place of its first cell, cells along x and y, distance of rows, and for
the step from the level below: whether pairs merge along x and y (1 or 0), and the offsets; last, how far the points are
rolled along x and y, round the grid, before they form cells. Level 0 are the points. ``s`` holds the sums S on the way up
and the deflections D on the way down. Cells are stored with a rim of empty ones (g = s = 0), so the edges are no special
case.
"""

from __future__ import annotations

import numpy as np

from .kernels import compiled

START, ROWS, COLUMNS, STRIDE, MERGE_X, MERGE_Y, OFFSET_X, OFFSET_Y, ROLL_X, ROLL_Y = range(10)


@compiled
def sum_points(level, shape, rows, index, values, s):  # type: ignore[no-untyped-def]
    """First level of cells: s = sum of the values of its points; unit values where ``values`` is empty."""
    unit = values.size == 0
    one = s.dtype.type(1.0)
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
                s[place] += one if unit else values[k]


@compiled
def _restrict_level(below, level, g, s):  # type: ignore[no-untyped-def]
    """s of a level = sum of g s over the parts of its cells."""
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        part = below[START] + ((cell << level[MERGE_X]) - level[OFFSET_X]) * below[STRIDE] - level[OFFSET_Y]
        other = part + below[STRIDE]
        n = level[COLUMNS]
        if level[MERGE_X] and level[MERGE_Y]:
            for j in range(n):
                a, b = part + 2 * j, other + 2 * j
                s[base + j] = g[a] * s[a] + g[a + 1] * s[a + 1] + g[b] * s[b] + g[b + 1] * s[b + 1]
        elif level[MERGE_Y]:
            for j in range(n):
                a = part + 2 * j
                s[base + j] = g[a] * s[a] + g[a + 1] * s[a + 1]
        elif level[MERGE_X]:
            for j in range(n):
                s[base + j] = g[part + j] * s[part + j] + g[other + j] * s[other + j]
        else:
            for j in range(n):
                s[base + j] = g[part + j] * s[part + j]


@compiled
def _prolong_level(above, level, weight, g, s):  # type: ignore[no-untyped-def]
    """s = g (deflection of the parent + weight s), the parent's standing in its own s. On the rim g, and so s, is 0."""
    for cell in range(level[ROWS]):
        parent = above[START] + ((cell + above[OFFSET_X]) >> above[MERGE_X]) * above[STRIDE]
        base = level[START] + cell * level[STRIDE] - above[OFFSET_Y]
        if above[MERGE_Y]:
            for j in range(above[COLUMNS]):
                d = s[parent + j]
                a = base + 2 * j
                s[a] = g[a] * (d + weight * s[a])
                s[a + 1] = g[a + 1] * (d + weight * s[a + 1])
        else:
            for j in range(above[COLUMNS]):
                s[base + j] = g[base + j] * (s[parent + j] + weight * s[base + j])


@compiled
def restrict(levels, first, last, g, s):  # type: ignore[no-untyped-def]
    """Sums s of the levels beyond the ``first`` up to the ``last``."""
    for depth in range(first + 1, last + 1):
        _restrict_level(levels[depth - 1], levels[depth], g, s)


@compiled
def prolong(levels, weights, first, last, g, s):  # type: ignore[no-untyped-def]
    """Deflections, in s, of the levels below the ``first`` down to the ``last``."""
    for depth in range(first - 1, last - 1, -1):
        _prolong_level(levels[depth + 1], levels[depth], weights[depth], g, s)


@compiled
def cycle(levels, weights, depth, g, s):  # type: ignore[no-untyped-def]
    """Deflections, in s, of the level ``depth`` under its sums s: one cycle up to the coarsest level and down again."""
    last = levels.shape[0] - 1
    restrict(levels, depth, last, g, s)
    top = levels[last]
    for cell in range(top[ROWS]):
        base = top[START] + cell * top[STRIDE]
        for j in range(base, base + top[COLUMNS]):
            s[j] *= g[j] * weights[last]
    prolong(levels, weights, last, depth, g, s)


@compiled
def factorise(span, levels, weights, shape, rows, index, nothing, g, s):  # type: ignore[no-untyped-def]
    """g = 1 / (1 + w T) in the hierarchies of the span, for the points ``index``, those of row i from ``rows[i]`` on."""
    for hierarchy in range(span[0], span[1]):
        last = levels.shape[1] - 1
        for depth in range(1, last + 1):
            level = levels[hierarchy, depth]
            if depth == 1:
                sum_points(level, shape, rows, index, nothing, s)
            else:
                _restrict_level(levels[hierarchy, depth - 1], level, g, s)
            weight = weights[depth]
            for cell in range(level[ROWS]):
                base = level[START] + cell * level[STRIDE]
                for j in range(base, base + level[COLUMNS]):
                    g[j] = 1.0 / (1.0 + weight * s[j])


@compiled
def cell_deflections(span, levels, weights, shape, rows, index, values, g, s):  # type: ignore[no-untyped-def]
    """Deflections of the finest cells of the hierarchies of the span, left in s, under the loads ``values``."""
    for hierarchy in range(span[0], span[1]):
        sum_points(levels[hierarchy, 1], shape, rows, index, values, s)
        cycle(levels[hierarchy], weights, 1, g, s)


@compiled
def _row_of_cells(row, level, shape):  # type: ignore[no-untyped-def]
    """Where the cells of the level that hold points of this row begin."""
    moved = row + level[ROLL_X]
    moved -= shape[0] if moved >= shape[0] else 0
    return level[START] + ((moved + level[OFFSET_X]) >> level[MERGE_X]) * level[STRIDE]


@compiled
def subtract_deflections(span, levels, shape, rows, index, values, other, s, out, sums):  # type: ignore[no-untyped-def]
    """out = values - mean of the deflections of two hierarchies in s; per row: sums of out, with values, with other."""
    half = s.dtype.type(0.5)
    one, two = levels[0, 1], levels[1, 1]
    merge_one, merge_two = one[MERGE_Y], two[MERGE_Y]
    end_one, end_two = shape[1] + one[OFFSET_Y], shape[1] + two[OFFSET_Y]
    for row in range(span[0], span[1]):
        base_one, base_two = _row_of_cells(row, one, shape), _row_of_cells(row, two, shape)
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
            d = s[base_one + (column_one >> merge_one)] + s[base_two + (column_two >> merge_two)]
            z = values[k] - half * d
            out[k] = z
            total += z
            with_values += np.float64(z) * values[k]
            with_other += np.float64(z) * other[k]
        sums[row, 0] = total
        sums[row, 1] = with_values
        sums[row, 2] = with_other


# Coarse correction: sweeps that end at the cells of one level, whose true compliance is a convolution A.
#
# With S and T what the levels below pass up for given and for unit loads, the loads f on the cells follow from
# (1/T + A) f = S/T, and the deflections are d = A f = (S - f)/T. Nested cells from there on up give a guess d0 and hence
# f0 = S - T d0, whose residual is d0 - A f0; one step of conjugate gradients follows, preconditioned by nested cells again.
#
# ``hierarchy`` holds levels, weights, g, s of one hierarchy as above, and the number of the level; ``fields`` for each cell
# of the level T, d0, the direction t of the step over T, the argument of a product with A, and the product.


UNIT, GUESS, STEP, FIELD, RESPONSE = range(5)


@compiled
def copy_level(level, s, unit):  # type: ignore[no-untyped-def]
    """unit = s of the level."""
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            unit[cell, j] = s[base + j]


@compiled
def coarse_guess(hierarchy, shape, rows, index, values, fields):  # type: ignore[no-untyped-def]
    """Guess d0 by nested cells under the loads ``values`` of points; f0 is the argument of a product."""
    levels, weights, g, s, depth = hierarchy
    unit, guess, field = fields[UNIT], fields[GUESS], fields[FIELD]
    sum_points(levels[1], shape, rows, index, values, s)
    restrict(levels, 1, depth, g, s)
    copy_level(levels[depth], s, field)
    cycle(levels, weights, depth, g, s)
    level = levels[depth]
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            guess[cell, j] = s[base + j]
            field[cell, j] -= unit[cell, j] * s[base + j]


@compiled
def coarse_direction(hierarchy, fields):  # type: ignore[no-untyped-def]
    """From the product A f0 the direction t, the argument of the next; its product with the residual is returned."""
    levels, weights, g, s, depth = hierarchy
    unit, guess, step, field, response = fields[UNIT], fields[GUESS], fields[STEP], fields[FIELD], fields[RESPONSE]
    level = levels[depth]
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            residual = guess[cell, j] - response[cell, j]
            step[cell, j] = residual
            s[base + j] = unit[cell, j] * residual
    cycle(levels, weights, depth, g, s)
    product = 0.0
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            residual = step[cell, j]
            direction = residual - s[base + j]
            t = unit[cell, j] * direction
            product += np.float64(t) * residual
            step[cell, j] = direction
            field[cell, j] = t
    return product


@compiled
def coarse_step(hierarchy, fields, product):  # type: ignore[no-untyped-def]
    """From the product A t the deflections d0 - length t / T, prolonged down to the finest cells."""
    levels, weights, g, s, depth = hierarchy
    guess, step, field, response = fields[GUESS], fields[STEP], fields[FIELD], fields[RESPONSE]
    level = levels[depth]
    curvature = 0.0
    for cell in range(level[ROWS]):
        for j in range(level[COLUMNS]):
            curvature += np.float64(field[cell, j]) * (step[cell, j] + response[cell, j])
    length = s.dtype.type(product / curvature if curvature > 0.0 else 0.0)
    for cell in range(level[ROWS]):
        base = level[START] + cell * level[STRIDE]
        for j in range(level[COLUMNS]):
            s[base + j] = guess[cell, j] - length * step[cell, j]
    prolong(levels, weights, depth, 1, g, s)
