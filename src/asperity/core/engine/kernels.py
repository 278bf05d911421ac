"""Fused, compiled passes over flat arrays. Each works on a span (first, last) of fixed blocks and releases the lock.

Sums are kept per block and added up in a fixed order by the caller, so results do not depend on the number of threads.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

BLOCK = 1 << 14
"""Elements per block."""

_compiled: Any = njit(nogil=True, cache=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz"})


@_compiled
def scale_spectrum(span, spectrum, factor):  # type: ignore[no-untyped-def]
    """spectrum *= factor."""
    for i in range(span[0] * BLOCK, min(span[1] * BLOCK, spectrum.size)):
        spectrum[i] *= factor[i]


@_compiled
def divide_spectrum(span, spectrum, divisor):  # type: ignore[no-untyped-def]
    """spectrum /= divisor."""
    for i in range(span[0] * BLOCK, min(span[1] * BLOCK, spectrum.size)):
        spectrum[i] *= 1.0 / divisor[i]


@_compiled
def assess(span, p, u, h, cap, sums):  # type: ignore[no-untyped-def]
    """Per block: sum p, sum p·r, sum p·h, sum and p-weighted sum of r where 0 < p < cap, min r, bounds of the level."""
    each = 1 if cap.size > 1 else 0  # one cap for all points, or one for each
    for b in range(span[0], span[1]):
        total = 0.0
        pr = 0.0
        ph = 0.0
        weight = 0.0
        weighted = 0.0
        lowest = np.inf
        highest_capped = -np.inf
        lowest_open = np.inf
        for i in range(b * BLOCK, min((b + 1) * BLOCK, p.size)):
            pi = np.float64(p[i])
            ri = np.float64(u[i]) - h[i]
            lowest = min(lowest, ri)
            if pi > 0.0:
                total += pi
                pr += pi * ri
                ph += pi * h[i]
                if pi >= cap[i * each]:
                    highest_capped = max(highest_capped, ri)
                else:
                    weight += pi
                    weighted += pi * ri
            else:
                lowest_open = min(lowest_open, ri)
        sums[b, 0] = total
        sums[b, 1] = pr
        sums[b, 2] = ph
        sums[b, 3] = weight
        sums[b, 4] = weighted
        sums[b, 5] = lowest
        sums[b, 6] = highest_capped
        sums[b, 7] = lowest_open


@_compiled
def violation(span, p, u, h, cap, level, sums):  # type: ignore[no-untyped-def]
    """Per block: sum (r - level)+ p, sum (level - r)+ (cap - p), max (level - r)+ below the cap."""
    each = 1 if cap.size > 1 else 0  # one cap for all points, or one for each
    for b in range(span[0], span[1]):
        above = 0.0
        below = 0.0
        deepest = 0.0
        for i in range(b * BLOCK, min((b + 1) * BLOCK, p.size)):
            gap = np.float64(u[i]) - h[i] - level
            pi = np.float64(p[i])
            room = cap[i * each] - pi
            if gap > 0.0:
                above += gap * pi
            elif gap < 0.0 and room > 0.0:
                deepest = max(deepest, -gap)
                below -= gap * room
        sums[b, 0] = above
        sums[b, 1] = below
        sums[b, 2] = deepest


@_compiled
def count_face(span, p, u, h, cap, level, counts):  # type: ignore[no-untyped-def]
    """Per block: number of points of the working set, and of those entering it from a bound.

    Without branches: which points belong is as random as the surface, and a processor cannot guess it.
    """
    each = 1 if cap.size > 1 else 0
    for b in range(span[0], span[1]):
        members = 0
        entering = 0
        for i in range(b * BLOCK, min((b + 1) * BLOCK, p.size)):
            gap = np.float64(u[i]) - h[i] - level
            open_ = int(p[i] <= 0.0)
            full = int(p[i] >= cap[i * each])
            enters = open_ * int(gap < 0.0) + (1 - open_) * full * int(gap > 0.0)
            entering += enters
            members += enters + (1 - open_) * (1 - full)
        counts[b, 0] = members
        counts[b, 1] = entering


@_compiled
def fill_face(span, p, u, h, cap, level, scale, starts, index, residual):  # type: ignore[no-untyped-def]
    """Indices of the working set in order, and (level - r) / scale there."""
    each = 1 if cap.size > 1 else 0
    for b in range(span[0], span[1]):
        k = starts[b]
        for i in range(b * BLOCK, min((b + 1) * BLOCK, p.size)):
            gap = np.float64(u[i]) - h[i] - level
            inside = gap < 0.0 if p[i] <= 0.0 else (gap > 0.0 if p[i] >= cap[i * each] else True)
            if inside:
                index[k] = i
                residual[k] = -gap / scale
                k += 1


@_compiled
def scatter(span, index, values, field):  # type: ignore[no-untyped-def]
    """field[index] = values."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        field[index[k]] = values[k]


@_compiled
def clear(span, index, field):  # type: ignore[no-untyped-def]
    """field[index] = 0."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        field[index[k]] = 0.0


@_compiled
def gather(span, index, field, other, values, sums):  # type: ignore[no-untyped-def]
    """values = field[index]; per block: sum values, sum values·other."""
    for b in range(span[0], span[1]):
        total = 0.0
        product = 0.0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
            value = field[index[k]]
            values[k] = value
            total += value
            product += np.float64(value) * other[k]
        sums[b, 0] = total
        sums[b, 1] = product


@_compiled
def direct(span, index, z, mean, ratio, t, field):  # type: ignore[no-untyped-def]
    """t = (z - mean) + ratio t, and field[index] = t."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        value = (z[k] - mean) + ratio * t[k]
        t[k] = value
        field[index[k]] = value


@_compiled
def advance(span, index, length, t, kt, mean, d, r, field):  # type: ignore[no-untyped-def]
    """d += length t; r -= length (kt - mean); field[index] = r."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        d[k] += length * t[k]
        value = r[k] - length * (kt[k] - mean)
        r[k] = value
        field[index[k]] = value


@_compiled
def step_pressure(span, index, p, d, scale, cap, out, sums):  # type: ignore[no-untyped-def]
    """out[index] = p[index] + scale d clipped to [0, cap]; per block: sum of the change, number of points clipped."""
    each = 1 if cap.size > 1 else 0  # one cap for all points, or one for each
    for b in range(span[0], span[1]):
        change = 0.0
        clipped = 0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
            i = index[k]
            before = np.float64(p[i])
            value = before + scale * np.float64(d[k])
            if value < 0.0:
                value = 0.0
                clipped += 1
            elif value > cap[i * each]:
                value = cap[i * each]
                clipped += 1
            out[i] = value
            change += value - before
        sums[b, 0] = change
        sums[b, 1] = clipped


@_compiled
def multiply(span, field, factor):  # type: ignore[no-untyped-def]
    """field *= factor."""
    for i in range(span[0] * BLOCK, min(span[1] * BLOCK, field.size)):
        field[i] *= factor


@_compiled
def blend(span, a, b, weight):  # type: ignore[no-untyped-def]
    """b = a + weight (b - a)."""
    for i in range(span[0] * BLOCK, min(span[1] * BLOCK, a.size)):
        b[i] = a[i] + weight * (b[i] - a[i])


@_compiled
def segment(span, p, q, u, v, h, sums):  # type: ignore[no-untyped-def]
    """Per block along q - p: slope sum (u - h)(q - p) and curvature sum (v - u)(q - p)."""
    for b in range(span[0], span[1]):
        slope = 0.0
        curvature = 0.0
        for i in range(b * BLOCK, min((b + 1) * BLOCK, p.size)):
            step = np.float64(q[i]) - p[i]
            slope += step * (np.float64(u[i]) - h[i])
            curvature += step * (np.float64(v[i]) - u[i])
        sums[b, 0] = slope
        sums[b, 1] = curvature


@_compiled
def dot(span, a, b, sums):  # type: ignore[no-untyped-def]
    """Per block: sum a·b."""
    for block in range(span[0], span[1]):
        total = 0.0
        for k in range(block * BLOCK, min((block + 1) * BLOCK, a.size)):
            total += np.float64(a[k]) * b[k]
        sums[block, 0] = total
