"""Compiled pass over the stresses of a plane: upper bounds of what is sought, block by block of points.

Exact values are wanted at few points only, so it pays to leave out the blocks that cannot hold them. With the deviator's
invariants, r = (J3/2) / (J2/3)^(3/2) between -1 and 1, the principal stresses are mean + 2 √(J2/3) cos(θ/3 - 2πk/3), θ = acos r.
Bounds that need no such functions: cos(θ/3), concave in r, is at most 1 + (r-1)/9, its tangent at r = 1, and at most
1/2 + √((1+r)/6), exact at r = -1 to second order; (σ1 - σ3)² / 4 is at most J2 (1 - r²/9), as |sin 3φ| <= 3 |sin φ|.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

BLOCK = 1024
"""Points of a block: its temporaries stay in the first-level cache."""

BOUNDS = ("von_mises", "tension", "shear", "in_plane", "shear_xz", "shear_yz", "traction", "zz")
"""What is bounded, in order: √(3 J2), σ1, (σ1 - σ3)/2, the larger principal stress parallel to the plane, |σxz|, |σyz|, the
magnitude of both, and σzz. All but the second and third bounds are the largest values themselves."""

_compiled: Any = njit(nogil=True, cache=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "nnan"})


@_compiled
def _largest(values, used):  # type: ignore[no-untyped-def]
    found = values[0]
    for k in range(used):
        found = max(found, values[k])
    return found


@_compiled
def _deviator(part, used, J2, mean, r):  # type: ignore[no-untyped-def]
    """J2, mean stress and r of the points of a block."""
    xx, yy, zz, xy, xz, yz = part
    for k in range(used):
        m = (xx[k] + yy[k] + zz[k]) * (1.0 / 3.0)
        a, b, c, d, e, f = xx[k] - m, yy[k] - m, zz[k] - m, xy[k], xz[k], yz[k]
        mean[k] = m
        J2[k] = 0.5 * (a * a + b * b + c * c) + d * d + e * e + f * f
        r[k] = 0.5 * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e))
    for k in range(used):
        third = J2[k] * (1.0 / 3.0)
        r[k] = min(1.0, max(-1.0, r[k] / max(third * np.sqrt(third), 1e-300)))


@_compiled
def _tension_bound(used, J2, mean, r, out):  # type: ignore[no-untyped-def]
    """Upper bound of σ1, point by point."""
    for k in range(used):
        cosine = min(1.0 + (r[k] - 1.0) / 9.0, 0.5 + np.sqrt((1.0 + r[k]) / 6.0))
        out[k] = mean[k] + 2.0 * np.sqrt(J2[k] / 3.0) * cosine


@_compiled
def _shear_bound(used, J2, r, out):  # type: ignore[no-untyped-def]
    """Upper bound of (σ1 - σ3)/2, point by point."""
    for k in range(used):
        out[k] = np.sqrt(J2[k] * (1.0 - r[k] * r[k] / 9.0))


@_compiled
def _block(components, first, used, copied):  # type: ignore[no-untyped-def]
    """The components of a block in double precision, whatever the fields are."""
    for component in range(6):
        copied[component, :used] = components[component][first : first + used]
    return copied[0], copied[1], copied[2], copied[3], copied[4], copied[5]


@_compiled
def _tractions(part, used, work, out):  # type: ignore[no-untyped-def]
    """Largest |σxz|, |σyz|, magnitude of both, and σzz."""
    zz, xz, yz = part
    for k in range(used):
        work[k] = abs(xz[k])
    out[0] = _largest(work, used)
    for k in range(used):
        work[k] = abs(yz[k])
    out[1] = _largest(work, used)
    for k in range(used):
        work[k] = xz[k] * xz[k] + yz[k] * yz[k]
    out[2] = np.sqrt(_largest(work, used))
    out[3] = _largest(zz, used)


@_compiled
def block_bounds(span, components, out):  # type: ignore[no-untyped-def]
    """Largest of each of ``BOUNDS`` in every block of the flat ``components`` xx, yy, zz, xy, xz, yz; ``out`` (blocks, 8)."""
    copied, J2, mean, r, work = np.empty((6, BLOCK)), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    size = components[0].size
    for block in range(span[0], span[1]):
        first, last = block * BLOCK, min(size, (block + 1) * BLOCK)
        used = last - first
        xx, yy, zz, xy, xz, yz = _block(components, first, used, copied)
        _deviator((xx, yy, zz, xy, xz, yz), used, J2, mean, r)
        out[block, 0] = np.sqrt(3.0 * _largest(J2, used))
        _tension_bound(used, J2, mean, r, work)
        out[block, 1] = _largest(work, used)
        _shear_bound(used, J2, r, work)
        out[block, 2] = _largest(work, used)
        for k in range(used):
            half = 0.5 * (xx[k] - yy[k])
            work[k] = 0.5 * (xx[k] + yy[k]) + np.sqrt(half * half + xy[k] * xy[k])
        out[block, 3] = _largest(work, used)
        _tractions((zz, xz, yz), used, work, out[block, 4:])


@_compiled
def points_beyond(blocks, components, shear, value):  # type: ignore[no-untyped-def]
    """Places in ``blocks`` whose own bound of the ``shear``, else of the tension, is above ``value``."""
    copied, J2, mean, r, bound = (
        np.empty((6, BLOCK)),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
        np.empty(BLOCK),
    )
    found, count = np.empty(blocks.size * BLOCK, np.intp), 0
    for block in blocks:
        first = block * BLOCK
        used = min(BLOCK, components[0].size - first)
        _deviator(_block(components, first, used, copied), used, J2, mean, r)
        if shear:
            _shear_bound(used, J2, r, bound)
        else:
            _tension_bound(used, J2, mean, r, bound)
        for k in range(used):
            if bound[k] > value:
                found[count] = first + k
                count += 1
    return found[:count]
