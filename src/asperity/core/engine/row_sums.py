"""Compiled passes that correct the row sums in the inverse of nested splines.

B-splines of neighbouring cells overlap: the products P^T D P of a level, D being what its parts
pass up, are their row sums S less a Laplacian H, which follows from D between the middles of
neighbouring cells. The inverse takes S for the products; 1 + c H/S times the deflections of a level
makes up for most of it.
"""

from __future__ import annotations

from .kernels import compiled, natural
from .protocol import MISSING
from .spline_levels import COLUMNS, MERGE_X, MERGE_Y, PARTS, ROWS, START, STRIDE


@compiled
def _between(span, levels, depth, wraps, lines, points, sums, mean):  # type: ignore[no-untyped-def]
    """Mean of what the four parts between the middles of each cell of a level and those after it
    pass up, a part that is missing counting as zero."""
    fine, level = levels[depth - 1], levels[depth]
    source = points if depth == 1 else sums
    scratch = lines[-(-span[0] * len(lines) // PARTS)]
    line, nothing, quarter = scratch[0], scratch[1], mean.dtype.type(0.25)
    rows, columns, stride, wide = fine[ROWS], fine[COLUMNS], fine[STRIDE], level[COLUMNS]
    lead, skipped = (0, 1) if wraps[1] else (1, 0)
    for cell in range(level[ROWS] * span[0] // PARTS, level[ROWS] * span[1] // PARTS):
        first = 2 * cell + 1 if wraps[0] else 2 * cell - 1
        second = 0 if wraps[0] and first + 1 == 2 * level[ROWS] else first + 1
        a, b = fine[START] + first * stride, fine[START] + second * stride
        row_a = source[a : a + columns] if 0 <= first < rows else nothing
        row_b = source[b : b + columns] if second < rows else nothing
        line[0] = line[lead + columns] = line[lead + columns + 1] = line[lead + columns + 2] = nothing[0]
        own_line = line[lead : lead + columns]
        for j in range(columns):
            own_line[j] = row_a[j] + row_b[j]
        if wraps[1]:
            line[2 * wide] = line[0]
        out = mean[level[START] + cell * wide : level[START] + (cell + 1) * wide]
        for k in range(wide):
            out[k] = quarter * (line[2 * k + skipped] + line[2 * k + skipped + 1])


@compiled
def _reciprocals(span, levels, depth, share, sums, g, per):  # type: ignore[no-untyped-def]
    """share / S of the cells of a level, whose g S are in ``sums``."""
    level, least = levels[depth], per.dtype.type(1e-30)  # where nothing is in contact H is nothing
    first = level[START] + level[ROWS] * span[0] // PARTS * level[STRIDE]
    last = level[START] + level[ROWS] * span[1] // PARTS * level[STRIDE]
    for k in range(natural(first), natural(last)):
        per[k] = share * g[k] / (sums[k] + least)


@compiled
def _excess(own, other, weights, missing):  # type: ignore[no-untyped-def]
    """What the two blocks between a row of cells and the ``other`` one add to H of a cell: values
    (before, here, after) of both rows, the ``weights`` of the blocks before and after it."""
    middle, side, corner = missing
    here = middle * own[1] - side * other[1]
    before, after = side * own[0] + corner * other[0], side * own[2] + corner * other[2]
    return weights[0] * (here - before) + weights[1] * (here - after)


@compiled
def corrected(span, levels, depth, wraps, nothing, mean, per, raw, cells):  # type: ignore[no-untyped-def]
    """``cells`` = raw + per H raw on a level, of the rows of the span; H by the ``mean`` of
    ``_between``. The ``raw`` values themselves where it merges along one axis only."""
    level = levels[depth]
    rows, wide, kind = level[ROWS], level[COLUMNS], cells.dtype.type
    missing, zero = (kind(MISSING[0]), kind(MISSING[1]), kind(MISSING[2])), kind(0.0)
    for cell in range(rows * span[0] // PARTS, rows * span[1] // PARTS):
        start = level[START] + cell * wide
        own, factor, out = raw[start : start + wide], per[start : start + wide], cells[start : start + wide]
        if level[MERGE_X] + level[MERGE_Y] < 2:
            for k in range(wide):
                out[k] = own[k]
            continue
        last, following = level[START] + (cell - 1) % rows * wide, level[START] + (cell + 1) % rows * wide
        above, below = raw[last : last + wide], raw[following : following + wide]
        over = mean[last : last + wide] if wraps[0] or cell > 0 else nothing[:wide]
        under = mean[start : start + wide] if wraps[0] or cell + 1 < rows else nothing[:wide]
        for k in range(1, wide - 1):
            near = own[k - 1], own[k], own[k + 1]
            found = _excess(near, (above[k - 1], above[k], above[k + 1]), (over[k - 1], over[k]), missing)
            found += _excess(near, (below[k - 1], below[k], below[k + 1]), (under[k - 1], under[k]), missing)
            out[k] = own[k] + factor[k] * found
        for k in (0, wide - 1):
            i, j = (k - 1) % wide, (k + 1) % wide
            before = kind(1.0) if wraps[1] or k > 0 else zero
            after = kind(1.0) if wraps[1] or k + 1 < wide else zero
            near = before * own[i], own[k], after * own[j]
            beyond = before * above[i], above[k], after * above[j]
            found = _excess(near, beyond, (before * over[i], over[k]), missing)
            beyond = before * below[i], below[k], after * below[j]
            found += _excess(near, beyond, (before * under[i], under[k]), missing)
            out[k] = own[k] + factor[k] * found


@compiled
def overlaps(span, levels, way, wraps, shares, lines, points, sums, g, found):  # type: ignore[no-untyped-def]
    """``_between`` and ``_reciprocals``, left in the two arrays ``found``, of the levels ``way[0]``
    to ``way[1]``, of the rows of the span; on levels that merge along one axis only nothing is
    corrected."""
    for depth in range(way[0], way[1] + 1):
        if levels[depth, MERGE_X] + levels[depth, MERGE_Y] == 2:
            _between(span, levels, depth, wraps, lines, points, sums, found[0])
            _reciprocals(span, levels, depth, shares[depth], sums, g, found[1])
