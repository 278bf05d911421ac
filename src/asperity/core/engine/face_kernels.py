"""Fused, compiled passes over the points of a working set, at ``index`` in flat arrays or ``place`` in a field.

As in ``kernels`` each works on a span of fixed blocks and leaves sums per block.
"""

from __future__ import annotations

import numpy as np

from .kernels import BLOCK, compiled
from .protocol import NEAR_CAP


@compiled
def clear(span, index, field):  # type: ignore[no-untyped-def]
    """field[index] = 0."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        field[index[k]] = 0.0


@compiled
def scatter(span, index, values, field):  # type: ignore[no-untyped-def]
    """field[index] = values."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        field[index[k]] = values[k]


@compiled
def scatter_more(span, index, values, factor, field):  # type: ignore[no-untyped-def]
    """field[index] += factor values."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        field[index[k]] += factor * values[k]


@compiled
def press(span, index, p, factor, scale, change):  # type: ignore[no-untyped-def]
    """p[index] = factor max(p, 0); change = what that adds to p over scale."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        old = np.float64(p[index[k]])
        value = factor * max(old, 0.0)
        p[index[k]] = value
        change[k] = (value - old) / scale


@compiled
def lay_change(span, index, place, old, values, r, change, field, sums):  # type: ignore[no-untyped-def]
    """field[place] = change = values[index] - old; per block: sum change·r."""
    for b in range(span[0], span[1]):
        product = 0.0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
            step = values[index[k]] - old[k]
            change[k] = step
            field[place[k]] = step
            product += np.float64(step) * r[k]
        sums[b, 0] = product


@compiled
def gather(span, index, field, a, b, values, sums):  # type: ignore[no-untyped-def]
    """values = field[index]; per block: sum values, sum values·a, sum values·b."""
    for block in range(span[0], span[1]):
        total = 0.0
        first = 0.0
        second = 0.0
        for k in range(block * BLOCK, min((block + 1) * BLOCK, index.size)):
            value = field[index[k]]
            values[k] = value
            total += value
            first += np.float64(value) * a[k]
            second += np.float64(value) * b[k]
        sums[block, 0] = total
        sums[block, 1] = first
        sums[block, 2] = second


@compiled
def direct(span, index, z, mean, ratio, t, r, field, sums):  # type: ignore[no-untyped-def]
    """t = (z - mean) + ratio t, and field[index] = t; per block: sum t·r."""
    for block in range(span[0], span[1]):
        product = 0.0
        for k in range(block * BLOCK, min((block + 1) * BLOCK, index.size)):
            value = (z[k] - mean) + ratio * t[k]
            t[k] = value
            field[index[k]] = value
            product += np.float64(value) * r[k]
        sums[block, 0] = product


@compiled
def advance(span, length, t, kt, mean, d, r):  # type: ignore[no-untyped-def]
    """d += length t; r -= length (kt - mean)."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, t.size)):
        d[k] += length * t[k]
        r[k] -= length * (kt[k] - mean)


@compiled
def pick(span, index, values, out, sums):  # type: ignore[no-untyped-def]
    """out = values[index]; per block: their sum."""
    for b in range(span[0], span[1]):
        total = 0.0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
            out[k] = values[index[k]]
            total += out[k]
        sums[b, 0] = total


@compiled
def shift(span, index, p, d, scale, sums):  # type: ignore[no-untyped-def]
    """p[index] += scale d; per block: number of points then below 0, and by how much in all."""
    for b in range(span[0], span[1]):
        below = 0
        lack = 0.0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
            i = index[k]
            value = p[i] + scale * np.float64(d[k])
            p[i] = value
            below += int(value < 0.0)
            lack += max(-value, 0.0)
        sums[b, 0] = below
        sums[b, 1] = lack


@compiled
def move(span, index, p, d, scale, cap, sums):  # type: ignore[no-untyped-def]
    """p[index] += scale d, clipped to [0, cap]; per block: sum p, sum p below the cap, number below it, number clipped."""
    each = 1 if cap.size > 1 else 0  # one cap for all points, or one for each
    for b in range(span[0], span[1]):
        total = 0.0
        movable = 0.0
        below = 0
        clipped = 0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
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
def scale(span, index, p, factor, shift, cap, sums):  # type: ignore[no-untyped-def]
    """p[index] = factor p + shift where below the cap, clipped to it; per block: sum p, sum and number below the cap."""
    each = 1 if cap.size > 1 else 0
    for b in range(span[0], span[1]):
        total = 0.0
        movable = 0.0
        below = 0
        for k in range(b * BLOCK, min((b + 1) * BLOCK, index.size)):
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
def blend(span, index, old, share, values):  # type: ignore[no-untyped-def]
    """values[index] = old + share (values[index] - old)."""
    for k in range(span[0] * BLOCK, min(span[1] * BLOCK, index.size)):
        i = index[k]
        values[i] = old[k] + share * (values[i] - old[k])
