"""Compiled sweeps over nested cells: loads summed up the levels, deflections prolonged down again.

The compliance of nested cells is B = 1 + sum over cells of w 1 1^T, in units of the deflection of a point under its own
load. Its inverse on any set of points follows from the Sherman-Morrison formula, cell by cell: with S the sum over the
parts of a cell of what they pass up, T the same for unit loads, and g = 1 / (1 + w T), a cell passes up g S and down
the deflection D = g (D of its parent + w S).

``levels`` holds for every hierarchy and level: place of its first cell, cells along x and y, distance of rows, and for
the step from the level below: whether pairs merge along x and y (1 or 0), and the offsets; then, how far the points are
rolled along x and y, round the grid, before they form cells. Level 0 are the points. ``s`` holds the sums S on the way up
and the deflections D on the way down. Cells are stored with a rim of empty ones (g = s = 0), so the edges are no special
case.

A light load touches few of the smallest cells, which are most of all. Up to the level ``SPARSE`` cells form groups of ``GROUP`` along y:
only groups in which points lie are swept, in all others s = 0. ``runs`` holds for every row of cells, from the place and at the distance
that ``levels`` tells last, the number of runs of such groups, and the first cell and the end of each.
"""

from __future__ import annotations

import numpy as np

from .kernels import compiled
from .protocol import GROUP, SPARSE

START, ROWS, COLUMNS, STRIDE, MERGE_X, MERGE_Y, OFFSET_X, OFFSET_Y, ROLL_X, ROLL_Y, RUNS, WIDTH = range(12)


@compiled
def occupy(span, levels, shape, points, others, full, runs, g, s):  # type: ignore[no-untyped-def]
    """Set the ``runs`` of the hierarchies of the span from the ``points`` of a set (rows, index), and those of ``others`` if it holds rows.

    Cells that were in runs before are cleared, g and s. ``full`` has room for the groups of the levels, see ``SPARSE``.
    """
    rows, index = points
    other_rows, other_index = others
    lowest = min(SPARSE, levels.shape[1] - 1)
    for hierarchy in range(span[0], span[1]):
        below = 0  # where the groups of the level below are in ``full``
        start = hierarchy * (full.size // levels.shape[0])
        for depth in range(1, lowest + 1):
            level = levels[hierarchy, depth]
            columns, merge_y = level[COLUMNS], level[MERGE_Y]
            groups = (columns + GROUP - 1) // GROUP
            groups_below = (levels[hierarchy, depth - 1, COLUMNS] + GROUP - 1) // GROUP
            for cell in range(level[ROWS]):
                base, at = level[START] + cell * level[STRIDE], level[RUNS] + cell * level[WIDTH]
                for run in range(at + 1, at + 1 + 2 * runs[at], 2):
                    # where pairs are offset, deflections were written one cell beyond either end
                    for j in range(base + runs[run] - 1, base + runs[run + 1] + 1):
                        g[j] = 0.0
                        s[j] = 0.0
                marks = start + cell * groups
                for group in range(marks, marks + groups):
                    full[group] = 0
                first = (cell << level[MERGE_X]) - level[OFFSET_X]
                for moved in range(first, first + 1 + level[MERGE_X]):
                    if depth == 1:
                        if moved < 0 or moved >= shape[0]:
                            continue
                        row = moved - level[ROLL_X]
                        row += shape[0] if row < 0 else 0
                        shift = level[OFFSET_Y] + level[ROLL_Y] - row * shape[1]
                        end = shape[1] + level[OFFSET_Y]
                        for k in range(rows[row], rows[row + 1]):
                            column = index[k] + shift
                            column -= shape[1] if column >= end else 0
                            full[np.uint64(marks + (column >> merge_y) // GROUP)] = 1
                        if other_rows.size:
                            for k in range(other_rows[row], other_rows[row + 1]):
                                column = other_index[k] + shift
                                column -= shape[1] if column >= end else 0
                                full[np.uint64(marks + (column >> merge_y) // GROUP)] = 1
                    elif moved >= 0 and moved < levels[hierarchy, depth - 1, ROWS]:
                        for part in range(groups_below):
                            if full[below + moved * groups_below + part]:
                                one = (part * GROUP + level[OFFSET_Y]) >> level[MERGE_Y]
                                other = (part * GROUP + GROUP - 1 + level[OFFSET_Y]) >> level[MERGE_Y]
                                full[marks + one // GROUP] = 1
                                full[marks + min(other, columns - 1) // GROUP] = 1
                number, before = 0, 0
                for group in range(groups):
                    now = full[marks + group]
                    if now and not before:
                        runs[at + 1 + 2 * number] = group * GROUP
                        number += 1
                    if now:
                        runs[at + 2 * number] = min((group + 1) * GROUP, columns)
                    before = now
                runs[at] = number
            below, start = start, start + level[ROWS] * groups


@compiled
def sweep(span, levels, weights, way, shape, points, values, runs, g, s):  # type: ignore[no-untyped-def]
    """In the hierarchies of the span: sums s of the levels ``way[0]`` up to ``way[1]``, deflections down to ``way[2]``.

    Those of level 1 are the sums of ``values`` at the ``points``, of which those of row i are in ``index`` from ``rows[i]`` on, or of unit values
    if there is none. If ``way[3]``, g = 1 / (1 + w s) is set on the way up. From the coarsest level, or from deflections
    that lie in s, it goes down: the deflection is g (that of the parent + w s). On the rim g, and so s, is 0.

    One function, since what it calls would be compiled once more in every caller.
    """
    rows, index = points
    unit = values.size == 0
    one = s.dtype.type(1.0)
    last = levels.shape[1] - 1
    for hierarchy in range(span[0], span[1]):
        for depth in range(way[0], way[1] + 1):
            level = levels[hierarchy, depth]
            below = levels[hierarchy, depth - 1]
            start, stride = level[START], level[STRIDE]
            merge_x, merge_y, offset_y = level[MERGE_X], level[MERGE_Y], level[OFFSET_Y]
            for cell in range(level[ROWS]):
                base, at = start + cell * stride, level[RUNS] + cell * level[WIDTH]
                first = (cell << merge_x) - level[OFFSET_X]
                if depth == 1:
                    for run in range(at + 1, at + 1 + 2 * runs[at], 2):
                        for j in range(base + runs[run], base + runs[run + 1]):
                            s[j] = 0.0
                    for moved in range(first, first + 1 + merge_x):
                        if moved < 0 or moved >= shape[0]:
                            continue
                        row = moved - level[ROLL_X]
                        row += shape[0] if row < 0 else 0
                        shift = offset_y + level[ROLL_Y] - row * shape[1]
                        end = shape[1] + offset_y
                        for k in range(rows[row], rows[row + 1]):
                            column = index[k] + shift
                            column -= shape[1] if column >= end else 0
                            s[np.uint64(base + (column >> merge_y))] += one if unit else values[k]
                    continue
                part = below[START] + first * below[STRIDE] - offset_y
                other = part + below[STRIDE]
                for run in range(at + 1, at + 1 + 2 * runs[at], 2):
                    begin, columns = runs[run], runs[run + 1] - runs[run]
                    if merge_x and merge_y:
                        one_part, two_part = part + 2 * begin, other + 2 * begin
                        out = s[base + begin : base + begin + columns]
                        ga, sa = g[one_part : one_part + 2 * columns], s[one_part : one_part + 2 * columns]
                        gb, sb = g[two_part : two_part + 2 * columns], s[two_part : two_part + 2 * columns]
                        for j in range(columns):
                            k = 2 * j
                            out[j] = ga[k] * sa[k] + ga[k + 1] * sa[k + 1] + gb[k] * sb[k] + gb[k + 1] * sb[k + 1]
                    else:  # pairs along one axis
                        step, pair = 1 + merge_y, other - part if merge_x else 1
                        for j in range(begin, begin + columns):
                            a = part + step * j
                            s[base + j] = g[a] * s[a] + g[a + pair] * s[a + pair]
            if way[3]:
                weight = weights[depth]
                for cell in range(level[ROWS]):
                    base, at = start + cell * stride, level[RUNS] + cell * level[WIDTH]
                    for run in range(at + 1, at + 1 + 2 * runs[at], 2):
                        for j in range(base + runs[run], base + runs[run + 1]):
                            g[j] = one / (one + weight * s[j])
        if way[1] == last and way[2] <= last:
            top = levels[hierarchy, last]
            for cell in range(top[ROWS]):
                base = top[START] + cell * top[STRIDE]
                for j in range(base, base + top[COLUMNS]):
                    s[j] *= g[j] * weights[last]
        for depth in range(way[1] - 1, way[2] - 1, -1):
            above, level, weight = levels[hierarchy, depth + 1], levels[hierarchy, depth], weights[depth]
            merge_y, offset_y = above[MERGE_Y], above[OFFSET_Y]
            for cell in range(level[ROWS]):
                parent = above[START] + ((cell + above[OFFSET_X]) >> above[MERGE_X]) * above[STRIDE]
                base, at = level[START] + cell * level[STRIDE] - offset_y, level[RUNS] + cell * level[WIDTH]
                for run in range(at + 1, at + 1 + 2 * runs[at], 2):
                    if merge_y:
                        first = (runs[run] + offset_y) >> 1
                        columns = ((runs[run + 1] - 1 + offset_y) >> 1) + 1 - first
                        part = base + 2 * first
                        sd = s[parent + first : parent + first + columns]
                        sa, ga = s[part : part + 2 * columns], g[part : part + 2 * columns]
                        for j in range(columns):
                            k = 2 * j
                            sa[k] = ga[k] * (sd[j] + weight * sa[k])
                            sa[k + 1] = ga[k + 1] * (sd[j] + weight * sa[k + 1])
                    else:
                        for j in range(runs[run], runs[run + 1]):
                            s[base + j] = g[base + j] * (s[parent + j] + weight * s[base + j])


@compiled
def subtract_deflections(span, levels, shape, rows, index, values, other, s, out, sums):  # type: ignore[no-untyped-def]
    """out = values - mean of the deflections of two hierarchies in s; per row: sums of out, with values, with other."""
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
            d = s[np.uint64(base_one + (column_one >> merge_one))] + s[np.uint64(base_two + (column_two >> merge_two))]
            z = values[k] - half * d
            out[k] = z
            total += z
            with_values += np.float64(z) * values[k]
            with_other += np.float64(z) * other[k]
        sums[row, 0] = total
        sums[row, 1] = with_values
        sums[row, 2] = with_other
