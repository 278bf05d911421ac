"""Fused, compiled passes over whole flat arrays, then over the points of a free set.

Each works on a span (first, last) of fixed blocks and releases the lock. Sums are kept per block
and added up in a fixed order by the caller, so results do not depend on the number of threads.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .compile import REORDERED, passes
from .protocol import NEAR_CAP

BLOCK = 1 << 14
"""Elements per block, what a thread takes at a time: 128 KiB, less than the second-level cache."""

# What a first solve compiles is waited for. Cheap to compile are plain loops with conditional
# expressions: every function of NumPy or Python in a kernel (max, sum, slices, complex products) is
# compiled on its own first, as is a wrapper for C.

natural: Any = np.uint64
"""Type of the indices of long loops. A signed index could be negative and count from the end of the
array, which Numba tests at every access, so that loops are not vectorised; with unsigned ones
``update_solution`` and ``add`` take a quarter of the time, ``scale_spectrum`` a third. Arithmetic
of an unsigned and a signed integer gives a float: cast both."""

in_order: Any = passes(no_cfunc_wrapper=True)
"""For differences of differences, rounded one by one: equal residuals are at no distance then."""

compiled: Any = passes(no_cfunc_wrapper=True, fastmath=REORDERED)


@compiled
def scale_spectrum(span, spectrum, factor):  # type: ignore[no-untyped-def]
    """spectrum *= factor, the complex spectrum given as real and imaginary parts in turn."""
    for i in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, factor.size))):
        spectrum[i + i] *= factor[i]
        spectrum[i + i + natural(1)] *= factor[i]


@compiled
def tensor_product(span, x, y, xx, yy, xy):  # type: ignore[no-untyped-def]
    """(x, y) = symmetric tensor times (x, y)."""
    for i in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, x.size))):
        along, across = x[i], y[i]
        x[i] = xx[i] * along + xy[i] * across
        y[i] = xy[i] * along + yy[i] * across


@compiled
def coupled_product(span, x, y, z, xx, yy, xy, zz, zx, zy):  # type: ignore[no-untyped-def]
    """(x, y, z) = Hermitian tensor times (x, y, z), in which i zx and i zy couple (x, y) and z."""
    for i in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, x.size))):
        along, across, normal = x[i], y[i], z[i]
        x[i] = xx[i] * along + xy[i] * across + complex(zx[i] * normal.imag, -zx[i] * normal.real)
        y[i] = xy[i] * along + yy[i] * across + complex(zy[i] * normal.imag, -zy[i] * normal.real)
        lifted = zx[i] * along + zy[i] * across
        z[i] = zz[i] * normal + complex(-lifted.imag, lifted.real)


@compiled
def survey(span, p, u, h, row, side, sums, squares):  # type: ignore[no-untyped-def]
    """Without a cap, per band of ``side`` rows: sum p, p·u, p·r, min r; per square: number of
    loaded points, their sum r and r².

    Where p < 0 it counts as 0. The sums are without branches, so that they are vectorised; the
    minimum is not, since it must hold with NaN, and has a loop of its own.
    """
    for band in range(span[0], span[1]):
        total = 0.0
        pu = 0.0
        pr = 0.0
        lowest = np.inf
        for start in range(band * side * row, min((band + 1) * side * row, p.size), row):
            for square in range(squares.shape[1]):
                first = start + square * side
                loaded = 0.0
                level = 0.0
                spread = 0.0
                for i in range(natural(first), natural(min(first + side, start + row))):
                    ri = u[i] - np.float64(h[i])
                    lowest = ri if ri < lowest else lowest
                for i in range(natural(first), natural(min(first + side, start + row))):
                    pi = np.float64(p[i])
                    ri = u[i] - np.float64(h[i])
                    carries = 1.0 if pi > 0.0 else 0.0
                    carried = pi if pi > 0.0 else 0.0
                    total += carried
                    pu += carried * u[i]
                    pr += carried * ri
                    loaded += carries
                    level += carries * ri
                    spread += carries * ri * ri
                squares[band, square, 0] += loaded
                squares[band, square, 1] += level
                squares[band, square, 2] += spread
        sums[band, 0] = total
        sums[band, 1] = pu
        sums[band, 2] = pr
        sums[band, 3] = lowest


@compiled
def survey_capped(span, p, u, h, cap, row, side, sums, squares):  # type: ignore[no-untyped-def]
    """Per band: sum p, p·u, p·r, sum and p-weighted sum of r where 0 < p < cap, min r, bounds of
    the level.

    Per square: number of points with 0 < p < cap, their sum r and r².
    """
    each = natural(1) if cap.size > 1 else natural(0)  # one cap for all points, or one for each
    for band in range(span[0], span[1]):
        total = 0.0
        pu = 0.0
        pr = 0.0
        weight = 0.0
        weighted = 0.0
        lowest = np.inf
        highest_capped = -np.inf
        lowest_open = np.inf
        for start in range(band * side * row, min((band + 1) * side * row, p.size), row):
            for square in range(squares.shape[1]):
                first = start + square * side
                for i in range(natural(first), natural(min(first + side, start + row))):
                    pi = np.float64(p[i])
                    ri = np.float64(u[i]) - h[i]
                    lowest = min(lowest, ri)
                    if pi > 0.0:
                        total += pi
                        pu += pi * u[i]
                        pr += pi * ri
                        if pi >= cap[i * each]:
                            highest_capped = max(highest_capped, ri)
                        else:
                            weight += pi
                            weighted += pi * ri
                            squares[band, square, 0] += 1.0
                            squares[band, square, 1] += ri
                            squares[band, square, 2] += ri * ri
                    else:
                        lowest_open = min(lowest_open, ri)
        sums[band, 0] = total
        sums[band, 1] = pu
        sums[band, 2] = pr
        sums[band, 3] = weight
        sums[band, 4] = weighted
        sums[band, 5] = lowest
        sums[band, 6] = highest_capped
        sums[band, 7] = lowest_open


@in_order
def violation(span, p, u, h, cap, level, sums):  # type: ignore[no-untyped-def]
    """Per block: sum (r - level)+ p, sum (level - r)+ (cap - p), max (level - r)+ below the cap;
    where p < 0 it counts as 0."""
    each = natural(1) if cap.size > 1 else natural(0)  # one cap for all points, or one for each
    for b in range(span[0], span[1]):
        above = 0.0
        below = 0.0
        deepest = 0.0
        for i in range(natural(b * BLOCK), natural(min((b + 1) * BLOCK, p.size))):
            gap = np.float64(u[i]) - h[i] - level
            pi = np.float64(p[i]) if p[i] > 0.0 else 0.0
            room = cap[i * each] - pi
            if gap > 0.0:
                above += gap * pi
            elif gap < 0.0 and room > 0.0:
                deepest = -gap if -gap > deepest else deepest
                below -= gap * room
        sums[b, 0] = above
        sums[b, 1] = below
        sums[b, 2] = deepest


@compiled
def beyond(span, late, early, ratio, out):  # type: ignore[no-untyped-def]
    """out = late + ratio (late - early); zero where both are."""
    for i in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, out.size))):
        out[i] = late[i] + ratio * (late[i] - early[i])


@compiled
def add(span, field, row, stride, factor, values):  # type: ignore[no-untyped-def]
    """values += factor field in the rows of the span, those of the field ``stride`` apart."""
    for i in range(span[0], span[1]):
        into, out_of = natural(i * row), natural(i * stride)
        for j in range(natural(row)):
            values[into + j] += factor * field[out_of + j]


@compiled
def entering_levels(squares, level, prior, share, resolved, sums, levels):  # type: ignore[no-untyped-def]
    """``levels`` of each square from its points between the bounds: their number, sum of r and of
    r², see ``entering``.

    ``sums`` has room for all squares and the wider ones of twice, four times ... the side: number,
    sum and mean of a quantity in each. First the quantity is r, then the square of what r differs
    by from its mean.
    """
    for pass_ in range(2):
        nx, ny, start = squares.shape[0], squares.shape[1], 0
        for i in range(nx):
            for j in range(ny):
                count, total = squares[i, j, 0], squares[i, j, 1] - level * squares[i, j, 0]
                k = i * ny + j
                if pass_ == 1:
                    mean = sums[k, 2]
                    spread = squares[i, j, 2] - level * (2.0 * total + level * count)
                    spread -= mean * (2.0 * total - mean * count)
                    levels[i, j, 0] = mean
                    total = spread if spread > resolved * squares[i, j, 2] else 0.0
                sums[k, 0] = count
                sums[k, 1] = total
        while nx * ny > 1:  # sums over squares of twice the side
            wide_x, wide_y, above = (nx + 1) >> 1, (ny + 1) >> 1, start + nx * ny
            for k in range(above, above + wide_x * wide_y):
                sums[k, 0] = 0.0
                sums[k, 1] = 0.0
            for i in range(nx):
                for j in range(ny):
                    k, wide = start + i * ny + j, above + (i >> 1) * wide_y + (j >> 1)
                    sums[wide, 0] += sums[k, 0]
                    sums[wide, 1] += sums[k, 1]
            nx, ny, start = wide_x, wide_y, above
        sums[start, 2] = sums[start, 1] / (sums[start, 0] + prior)
        shift = 0
        while (squares.shape[0] - 1) >> shift > 0 or (squares.shape[1] - 1) >> shift > 0:
            shift += 1
        while shift > 0:  # means, to which the wider square counts as ``prior`` points
            shift -= 1
            wide_y, above = ny, start
            nx, ny = ((squares.shape[0] - 1) >> shift) + 1, ((squares.shape[1] - 1) >> shift) + 1
            start -= nx * ny
            for i in range(nx):
                for j in range(ny):
                    k, wide = start + i * ny + j, above + (i >> 1) * wide_y + (j >> 1)
                    sums[k, 2] = (sums[k, 1] + prior * sums[wide, 2]) / (sums[k, 0] + prior)
    for i in range(squares.shape[0]):
        for j in range(squares.shape[1]):
            mean, margin = levels[i, j, 0] + level, share * np.sqrt(sums[i * squares.shape[1] + j, 2])
            levels[i, j, 0] = mean - margin
            levels[i, j, 1] = mean + margin


@compiled
def mark_free_elastic(span, p, u, h, side, lines, loaded, mask, rows, counts):  # type: ignore[no-untyped-def]
    """``mark_free`` without a cap; ``lines`` holds the level of each point along a band, ``loaded``
    the loaded points per square.

    Row by row and with one comparison per point the loop vectorises, which is five times as fast.
    """
    row = p.size // rows.size
    for band in range(span[0], span[1]):
        entering = np.int64(0)
        line = lines[band]
        for line_number in range(band * side, min((band + 1) * side, rows.size)):
            start = line_number * row
            pressure, deflection, heights = p[start : start + row], u[start : start + row], h[start : start + row]
            inside = mask[start : start + row]
            for j in range(row):
                gap = deflection[j] - np.float64(heights[j]) - line[j]
                decides = gap if pressure[j] == 0.0 else -np.float64(pressure[j])
                inside[j] = np.uint8(1) if decides < 0.0 else np.uint8(0)
            members = np.int64(0)
            for j in range(row):
                members += np.int64(inside[j])
            rows[line_number] = members
            entering += members
        for square in range(loaded.shape[1]):
            entering -= np.int64(loaded[band, square, 0])
        counts[band] = entering


@compiled
def mark_free(span, p, u, h, cap, side, levels, mask, rows, counts):  # type: ignore[no-untyped-def]
    """Mask of the free set by two ``levels`` of each square, for points at 0 and at the cap.

    Per row: number of its points; per band: of those entering it. Without branches, which would be
    mispredicted: membership is as random as the surface.
    """
    each = natural(1) if cap.size > 1 else natural(0)
    row = p.size // rows.size
    for band in range(span[0], span[1]):
        entering = 0
        for line_number in range(band * side, min((band + 1) * side, rows.size)):
            start, members = line_number * row, 0
            for square in range(levels.shape[1]):
                first = start + square * side
                for i in range(natural(first), natural(min(first + side, start + row))):
                    r = u[i] - np.float64(h[i])
                    open_ = np.uint8(p[i] <= 0.0)
                    full = np.uint8(p[i] >= cap[i * each])
                    low, high = np.uint8(r < levels[band, square, 0]), np.uint8(r > levels[band, square, 1])
                    enters = (open_ & low) | (full & high)
                    mask[i] = enters | (np.uint8(1) - (open_ | full))
                    entering += int(enters)
                    members += int(mask[i])
            rows[line_number] = members
        counts[band] = entering


@compiled
def fill_free(span, u, h, plane, length, masks, starts, index, residual, sums):  # type: ignore[no-untyped-def]
    """Indices of the points of the mask in order, and (level - r) / scale there; per band: its sum.
    A band has ``length`` words of the mask.

    ``plane`` are the level and the scale, ``masks`` the mask point by point and in words of eight
    points.
    """
    mask, words = masks
    level, scale = plane
    for band in range(span[0], span[1]):
        first, last = natural(starts[band]), natural(starts[band + 1])
        k, eight = first, natural(8)
        for word in range(natural(band * length), natural(min((band + 1) * length, words.size))):
            if words[word] == 0:  # most of the surface is out of contact
                continue
            for i in range(eight * word, eight * word + eight):
                if k < last:
                    index[k] = i
                    k += natural(mask[i])
        total = 0.0
        for k in range(first, last):
            i = index[k]
            residual[k] = (level - (u[i] - np.float64(h[i]))) / scale
            total += residual[k]
        sums[band] = total


@compiled
def prolong_pressure(span, coarse, coarse_heights, heights, stiffness, out):  # type: ignore[no-untyped-def]
    """Rows of the span of out: 0 where coarse is, else coarse + stiffness (heights - coarse
    heights), at least 0."""
    for i in range(span[0], span[1]):
        for j in range(out.shape[1]):
            p = coarse[i >> 1, j >> 1]
            value = p + stiffness * (heights[i, j] - coarse_heights[i >> 1, j >> 1])
            out[i, j] = value if p > 0.0 and value > 0.0 else 0.0


@compiled
def interpolate_rows(span, coarse, wraps, out):  # type: ignore[no-untyped-def]
    """Rows of the span of out: linear interpolation of coarse values, two points for each along
    either axis; flat beyond an end that does not wrap."""
    rows, columns = coarse.shape
    line = np.empty(columns)
    for i in range(span[0], span[1]):
        near = i >> 1
        other = near + 2 * (i & 1) - 1
        if other < 0 or other >= rows:
            other = (rows - 1 - near) if wraps[0] else near
        own, beside = coarse[near], coarse[other]
        for j in range(columns):
            line[j] = 0.75 * own[j] + 0.25 * beside[j]
        before = line[columns - 1] if wraps[1] else line[0]
        after = line[0] if wraps[1] else line[columns - 1]
        for j in range(out.shape[1]):
            k = j >> 1
            if j & 1:
                out[i, j] = 0.75 * line[k] + 0.25 * (line[k + 1] if k + 1 < columns else after)
            else:
                out[i, j] = 0.75 * line[k] + 0.25 * (line[k - 1] if k > 0 else before)


@compiled
def _join(parent, one, other):  # type: ignore[no-untyped-def]
    """Make the island of the smaller number, of those of ``one`` and ``other``, the parent."""
    while parent[one] != one:
        parent[one] = parent[parent[one]]
        one = parent[one]
    while parent[other] != other:
        parent[other] = parent[parent[other]]
        other = parent[other]
    parent[max(one, other)] = min(one, other)


@compiled
def island_sizes(mask, wraps, lines, parent, sizes):  # type: ignore[no-untyped-def]
    """Sizes of the islands of ``mask`` in the order of their first pixels, joined by edges, across
    the borders that wrap too; their number.

    ``lines`` has room for the numbers of the islands in the first and in the latest row, ``parent``
    for an island of a smaller number to which each has turned out to belong; there are at most half
    as many as pixels, rounded up in each row, and one.
    """
    found = 0
    for i in range(mask.shape[0]):
        left = 0
        for j in range(mask.shape[1]):
            above = lines[1, j] if i > 0 else 0
            if not mask[i, j]:
                left = 0
            elif left == 0 and above == 0:
                found += 1
                left = found
                parent[found] = found
                sizes[found] = 1
            else:
                if left > 0 and above > 0:
                    _join(parent, np.int64(left), np.int64(above))  # of one type, to be compiled once
                left = left if left > 0 else above
                sizes[left] += 1
            lines[1, j] = left
            if i == 0:
                lines[0, j] = left
        if wraps[1] and lines[1, 0] > 0 and left > 0:
            _join(parent, lines[1, 0], np.int64(left))
    for j in range(mask.shape[1]):
        if wraps[0] and lines[0, j] > 0 and lines[1, j] > 0:
            _join(parent, lines[0, j], lines[1, j])
    count = 0
    for island in range(1, found + 1):
        first = parent[island]
        while first > 0 and parent[first] != first:
            first = parent[first]
        if first == island:  # minus its place among the whole ones, for those that belong to it
            parent[island] = -count
            sizes[count] = sizes[island]
            count += 1
        else:
            sizes[-first] += sizes[island]
            parent[island] = first
    return count


# Passes over the points of a free set, at ``index`` in flat arrays or ``place`` in a field.


@compiled
def scatter(span, index, values, field):  # type: ignore[no-untyped-def]
    """field[index] = values, or the only one of them."""
    each = natural(1) if values.size > 1 else natural(0)
    for k in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, index.size))):
        field[index[k]] = values[k * each]


@compiled
def scatter_add(span, index, values, factor, field):  # type: ignore[no-untyped-def]
    """field[index] += factor values."""
    for k in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, index.size))):
        field[index[k]] += factor * values[k]


@compiled
def clear_tension(span, index, p, factor, scale, change):  # type: ignore[no-untyped-def]
    """p[index] = factor max(p, 0); change = what that adds to p over scale."""
    for k in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, index.size))):
        old = np.float64(p[index[k]])
        value = factor * old if old > 0.0 else 0.0
        p[index[k]] = value
        change[k] = (value - old) / scale


@compiled
def scatter_change(span, index, place, old, values, r, change, field, sums):  # type: ignore[no-untyped-def]
    """field[place] = change = values[index] - old; per block: sum change·r."""
    for b in range(span[0], span[1]):
        product = 0.0
        for k in range(natural(b * BLOCK), natural(min((b + 1) * BLOCK, index.size))):
            step = values[index[k]] - old[k]
            change[k] = step
            field[place[k]] = step
            product += np.float64(step) * r[k]
        sums[b, 0] = product


@compiled
def products(span, values, a, b, sums):  # type: ignore[no-untyped-def]
    """Per block: sum values, sum values·a, sum values·b."""
    for block in range(span[0], span[1]):
        total = 0.0
        first = 0.0
        second = 0.0
        for k in range(natural(block * BLOCK), natural(min((block + 1) * BLOCK, values.size))):
            value = np.float64(values[k])
            total += value
            first += value * a[k]
            second += value * b[k]
        sums[block, 0] = total
        sums[block, 1] = first
        sums[block, 2] = second


@compiled
def gather_products(span, index, field, a, b, values, sums):  # type: ignore[no-untyped-def]
    """values = field[index]; per block: sum values, sum values·a, sum values·b."""
    for k in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, index.size))):
        values[k] = field[index[k]]
    products(span, values, a, b, sums)


@compiled
def update_direction(span, index, z, mean, ratio, t, r, field, sums):  # type: ignore[no-untyped-def]
    """t = (z - mean) + ratio t, and field[index] = t; per block: sum t·r."""
    for block in range(span[0], span[1]):
        product = 0.0
        for k in range(natural(block * BLOCK), natural(min((block + 1) * BLOCK, index.size))):
            value = (z[k] - mean) + ratio * t[k]
            t[k] = value
            product += np.float64(value) * r[k]
        for k in range(natural(block * BLOCK), natural(min((block + 1) * BLOCK, index.size))):
            field[index[k]] = t[k]
        sums[block, 0] = product


@compiled
def update_solution(span, length, t, kt, mean, d, r, sums):  # type: ignore[no-untyped-def]
    """d += length t; r -= length (kt - mean); per block: sum r²."""
    for block in range(span[0], span[1]):
        square = 0.0
        for k in range(natural(block * BLOCK), natural(min((block + 1) * BLOCK, t.size))):
            d[k] += length * t[k]
            left = r[k] - length * (kt[k] - mean)
            r[k] = left
            square += np.float64(left) * left
        sums[block, 0] = square


@compiled
def add_unclipped(span, index, p, d, scale, sums):  # type: ignore[no-untyped-def]
    """p[index] += scale d; per block: number of tensile points then, the sum of their tension, and
    that of the other pressures."""
    for b in range(span[0], span[1]):
        tensile = 0
        tension = 0.0
        carried = 0.0
        for k in range(natural(b * BLOCK), natural(min((b + 1) * BLOCK, index.size))):
            i = index[k]
            value = p[i] + scale * np.float64(d[k])
            p[i] = value
            tensile += 1 if value < 0.0 else 0
            tension -= value if value < 0.0 else 0.0
            carried += value if value > 0.0 else 0.0
        sums[b, 0] = tensile
        sums[b, 1] = tension
        sums[b, 2] = carried


@compiled
def add_clipped(span, index, p, d, scale, cap, sums):  # type: ignore[no-untyped-def]
    """p[index] += scale d, clipped to [0, cap]; per block: sum p, sum p below the cap, number below
    it, number clipped."""
    each = natural(1) if cap.size > 1 else natural(0)  # one cap for all points, or one for each
    for b in range(span[0], span[1]):
        total = 0.0
        movable = 0.0
        below = 0
        clipped = 0
        for k in range(natural(b * BLOCK), natural(min((b + 1) * BLOCK, index.size))):
            i = index[k]
            moved = np.float64(p[i]) + scale * np.float64(d[k])
            value = min(max(moved, 0.0), np.float64(cap[i * each]))
            clipped += int(value != moved)
            p[i] = value
            free = int(value < cap[i * each])
            total += value
            movable += free * value
            below += free
        sums[b, 0] = total
        sums[b, 1] = movable
        sums[b, 2] = below
        sums[b, 3] = clipped


@compiled
def rescale(span, index, p, factor, shift, cap, sums):  # type: ignore[no-untyped-def]
    """p[index] = factor p + shift where below the cap, clipped to it; per block: sum p, sum and
    number below the cap."""
    each = natural(1) if cap.size > 1 else natural(0)
    for b in range(span[0], span[1]):
        total = 0.0
        movable = 0.0
        below = 0
        for k in range(natural(b * BLOCK), natural(min((b + 1) * BLOCK, index.size))):
            i = index[k]
            value = np.float64(p[i])
            if value < cap[i * each]:
                value = factor * value + shift
                if value >= NEAR_CAP * cap[i * each]:  # a point within rounding of its cap is at it
                    value = np.float64(cap[i * each])
                p[i] = value
            free = int(value < cap[i * each])
            total += value
            movable += free * value
            below += free
        sums[b, 0] = total
        sums[b, 1] = movable
        sums[b, 2] = below


@compiled
def interpolate(span, index, old, share, values):  # type: ignore[no-untyped-def]
    """values[index] = old + share (values[index] - old)."""
    for k in range(natural(span[0] * BLOCK), natural(min(span[1] * BLOCK, index.size))):
        i = index[k]
        values[i] = old[k] + share * (values[i] - old[k])
