"""Compiled passes over some rows of the stresses of a plane: where it may be largest.

With the invariants of the deviator, r = (J3/2) / (J2/3)^(3/2) between -1 and 1, the principal
stresses are mean + 2 √(J2/3) cos(θ/3 - 2πk/3), θ = acos r. Bounds that need no such functions,
σ1 <= mean + 2 √(J2/3) and (σ1 - σ3)/2 <= √J2, are compared with the largest stress known so far;
few points are beyond them, and only these are looked at.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....core.engine.compile import REORDERED, passes

QUANTITIES = ("von_mises", "tension", "shear", "in_plane", "shear_xz", "shear_yz", "traction", "zz")
"""What may be sought, by number: √(3 J2), σ1, (σ1 - σ3)/2, the larger principal stress parallel to
the plane, |σxz|, |σyz|, the magnitude of both, and σzz."""

CLOSE = 1e-7
"""Part of √(J2/3) by which the principal stresses above may be wrong: near r = ±1 the rounding of
r, 1e-15, becomes its root."""

_MOST = 256  # points kept that are as close to the largest: a uniform field has more, all within ``CLOSE``

# no stress is NaN: without that case comparisons become vector instructions
_compiled: Any = passes(fastmath=REORDERED | {"nnan"})


@_compiled
def overview(rows, least, interface):  # type: ignore[no-untyped-def]
    """Which of ``QUANTITIES`` may be larger than ``least`` (8,) in ``rows`` (6, rows, ny), (8,);
    largest √J2 and mean stress.

    The last two quantities are those of an ``interface`` only.
    """
    deviator, mean, tension, in_plane, along, across = 0.0, -np.inf, -np.inf, -np.inf, 0.0, 0.0
    square, normal = 0.0, -np.inf
    for i in range(rows.shape[1]):
        xx, yy, zz, xy, xz, yz = rows[0, i], rows[1, i], rows[2, i], rows[3, i], rows[4, i], rows[5, i]
        for k in range(xx.size):
            c, d, e, f = np.float64(zz[k]), np.float64(xy[k]), abs(np.float64(xz[k])), abs(np.float64(yz[k]))
            middle, half = 0.5 * (np.float64(xx[k]) + np.float64(yy[k])), 0.5 * (np.float64(xx[k]) - np.float64(yy[k]))
            radius = half * half + d * d
            m = (middle + middle + c) * (1.0 / 3.0)
            j = radius + (middle - c) * (middle - c) * (1.0 / 3.0) + e * e + f * f
            s, t = least[1] - m, least[3] - middle
            beyond_all, beyond_plane = j * (4.0 / 3.0) - s * abs(s), radius - t * abs(t)  # positive beyond ``least``
            deviator = j if j > deviator else deviator
            mean = m if m > mean else mean
            tension = beyond_all if beyond_all > tension else tension
            in_plane = beyond_plane if beyond_plane > in_plane else in_plane
            along = e if e > along else along
            across = f if f > across else across
        if interface:
            for k in range(xx.size):
                c, e, f = np.float64(zz[k]), np.float64(xz[k]), np.float64(yz[k])
                square = max(square, e * e + f * f)
                normal = max(normal, c)
    root = np.sqrt(deviator)
    beyond = np.zeros(8, np.bool_)
    beyond[0], beyond[1], beyond[2] = np.sqrt(3.0) * root > least[0], tension > 0.0, root > least[2]
    beyond[3], beyond[4], beyond[5] = in_plane > 0.0, along > least[4], across > least[5]
    if interface:
        beyond[6], beyond[7] = np.sqrt(square) > least[6], normal > least[7]
    return beyond, root, mean


@_compiled
def _invariant(xx, yy, zz, xy, xz, yz, mean, factor, found):  # type: ignore[no-untyped-def]
    """``mean`` times the mean stress plus ``factor`` times √J2."""
    for k in range(found.size):
        a, b, c = np.float64(xx[k]), np.float64(yy[k]), np.float64(zz[k])
        d, e, f = np.float64(xy[k]), np.float64(xz[k]), np.float64(yz[k])
        m = (a + b + c) * (1.0 / 3.0)
        a, b, c = a - m, b - m, c - m
        found[k] = mean * m + factor * np.sqrt(0.5 * (a * a + b * b + c * c) + d * d + e * e + f * f)


@_compiled
def _in_plane(xx, yy, xy, found):  # type: ignore[no-untyped-def]
    """The larger principal stress parallel to the plane."""
    for k in range(found.size):
        a, b, d = np.float64(xx[k]), np.float64(yy[k]), np.float64(xy[k])
        half = 0.5 * (a - b)
        found[k] = 0.5 * (a + b) + np.sqrt(half * half + d * d)


@_compiled
def _magnitude(a, b, found):  # type: ignore[no-untyped-def]
    """√(a² + b²)."""
    for k in range(found.size):
        c, d = np.float64(a[k]), np.float64(b[k])
        found[k] = np.sqrt(c * c + d * d)


@_compiled
def _signed(a, sign, found):  # type: ignore[no-untyped-def]
    """|a|, with a ``sign`` a itself."""
    for k in range(found.size):
        found[k] = np.float64(a[k]) if sign else abs(np.float64(a[k]))


@_compiled
def bounds(quantity, points, found):  # type: ignore[no-untyped-def]
    """One of ``QUANTITIES`` at ``points``, components xx, yy, zz, xy, xz, yz (n,) each; of the
    principal stresses what they are at most."""
    xx, yy, zz, xy, xz, yz = points
    if quantity == 0:
        _invariant(xx, yy, zz, xy, xz, yz, 0.0, np.sqrt(3.0), found)
    elif quantity == 1:
        _invariant(xx, yy, zz, xy, xz, yz, 1.0, 2.0 / np.sqrt(3.0), found)
    elif quantity == 2:
        _invariant(xx, yy, zz, xy, xz, yz, 0.0, 1.0, found)
    elif quantity == 3:
        _in_plane(xx, yy, xy, found)
    elif quantity == 4:
        _signed(xz, False, found)
    elif quantity == 5:
        _signed(yz, False, found)
    elif quantity == 6:
        _magnitude(xz, yz, found)
    else:
        _signed(zz, True, found)


@_compiled
def _principal(shear, s):  # type: ignore[no-untyped-def]
    """The largest ``shear``, else principal stress, and what it may be wrong by."""
    a, b, c, d, e, f = s
    m = (a + b + c) * (1.0 / 3.0)
    a, b, c = a - m, b - m, c - m
    size = np.sqrt((0.5 * (a * a + b * b + c * c) + d * d + e * e + f * f) * (1.0 / 3.0))
    r = 0.5 * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e)) / max(size * size * size, 1e-300)
    third = np.arccos(min(1.0, max(-1.0, r))) * (1.0 / 3.0)
    if shear:
        return np.sqrt(3.0) * size * np.sin(third + np.pi / 3.0), CLOSE * size
    return m + 2.0 * size * np.cos(third), CLOSE * size


@_compiled
def _kept(count, best, values, margins, places):  # type: ignore[no-untyped-def]
    """Move the candidates that may be the largest still to the front; their number."""
    kept = 0
    for k in range(count):
        if values[k] + margins[k] >= best:
            values[kept], margins[kept] = values[k], margins[k]
            places[kept, 0], places[kept, 1] = places[k, 0], places[k, 1]
            kept += 1
    return kept


@_compiled
def candidates(quantity, rows, least):  # type: ignore[no-untyped-def]
    """Points of ``rows`` where a quantity, by its number, may be larger than ``least`` and than
    anywhere else in them.

    Their places (n, 2), values (n,) and what these may be wrong by.
    """
    values, margins, places = np.empty(_MOST), np.empty(_MOST), np.empty((_MOST, 2), np.intp)
    count, best, most = 0, least, np.empty(rows.shape[2])
    principal = quantity == 1 or quantity == 2
    for i in range(rows.shape[1]):
        points = (rows[0, i], rows[1, i], rows[2, i], rows[3, i], rows[4, i], rows[5, i])
        bounds(quantity, points, most)
        for k in range(most.size):
            if most[k] > best:
                value, margin = most[k], 0.0
                if principal:
                    s = (
                        np.float64(rows[0, i, k]),
                        np.float64(rows[1, i, k]),
                        np.float64(rows[2, i, k]),
                        np.float64(rows[3, i, k]),
                        np.float64(rows[4, i, k]),
                        np.float64(rows[5, i, k]),
                    )
                    value, margin = _principal(quantity == 2, s)
                if value + margin > best:
                    best = max(best, value)
                    if count == _MOST:
                        count = _kept(count, best, values, margins, places)
                    if count < _MOST:
                        values[count], margins[count], places[count, 0], places[count, 1] = value, margin, i, k
                        count += 1
    count = _kept(count, best, values, margins, places)
    return places[:count], values[:count], margins[:count]
