"""Compiled passes over the half spectra of all internal pressures at once: what they displace, and
how they go on over a step of time.

Each works on a span (first, last) of rows and releases the lock. Complex rows are given as real and
imaginary parts in turn; sums are kept per row and added up in a fixed order by the caller, so that
results do not depend on the number of threads. ``cuts`` (terms, rows) are the numbers of columns
beyond which a compliance is zero: there nothing is read or written.
"""

from __future__ import annotations

from typing import Any

from .compile import REORDERED, passes

_compiled: Any = passes(no_cfunc_wrapper=True, fastmath=REORDERED)


@_compiled
def retarded(span, cuts, weights, kernels, xi, whole, response, total):  # type: ignore[no-untyped-def]
    """total = whole response + sum over the terms of weights kernels xi."""
    columns = whole.shape[1]
    for row in range(span[0], span[1]):
        here = total[row]
        for j in range(columns):
            here[2 * j] = whole[row, j] * response[row, 2 * j]
            here[2 * j + 1] = whole[row, j] * response[row, 2 * j + 1]
        for k in range(weights.size):
            weight, kernel, each = weights[k], kernels[k, row], xi[k, row]
            for j in range(cuts[k, row]):
                factor = weight * kernel[j]
                here[2 * j] += factor * each[2 * j]
                here[2 * j + 1] += factor * each[2 * j + 1]


@_compiled
def advance(span, cuts, weights, kernels, counted, p0, p1, xi, ends, sums):  # type: ignore[no-untyped-def]
    """ends = weights[0] xi + weights[1] p0 + weights[2] p1; per row and term the products of p0 and
    p1 with xi, and of the two with each other."""
    for row in range(span[0], span[1]):
        first, last = p0[row], p1[row]
        for k in range(weights.shape[1]):
            old, kernel, new = xi[k, row], kernels[k, row], ends[k, row]
            decay, begin, end = weights[0, k], weights[1, k], weights[2, k]
            x0, x1, p00, p01, p11 = 0.0, 0.0, 0.0, 0.0, 0.0
            for j in range(cuts[k, row]):
                weight = counted[j] * kernel[j]
                xr, xs = old[2 * j], old[2 * j + 1]
                ar, ai = first[2 * j], first[2 * j + 1]
                br, bi = last[2 * j], last[2 * j + 1]
                x0 += weight * (xr * ar + xs * ai)
                x1 += weight * (xr * br + xs * bi)
                p00 += weight * (ar * ar + ai * ai)
                p01 += weight * (ar * br + ai * bi)
                p11 += weight * (br * br + bi * bi)
                new[2 * j] = decay * xr + begin * ar + end * br
                new[2 * j + 1] = decay * xs + begin * ai + end * bi
            sums[row, k, 0] = x0
            sums[row, k, 1] = x1
            sums[row, k, 2] = p00
            sums[row, k, 3] = p01
            sums[row, k, 4] = p11


@_compiled
def curvature(span, bent, first, after, factors, p0, p1, p2, sums):  # type: ignore[no-untyped-def]
    """Per row the squares of bent (factors p) over three pressures, and of (first + after) p2."""
    for row in range(span[0], span[1]):
        change, size = 0.0, 0.0
        x, y, z = p0[row], p1[row], p2[row]
        for j in range(bent.shape[1]):
            re = factors[0] * x[2 * j] + factors[1] * y[2 * j] + factors[2] * z[2 * j]
            im = factors[0] * x[2 * j + 1] + factors[1] * y[2 * j + 1] + factors[2] * z[2 * j + 1]
            change += bent[row, j] * bent[row, j] * (re * re + im * im)
            whole = first[row, j] + after[row, j]
            size += whole * whole * (z[2 * j] * z[2 * j] + z[2 * j + 1] * z[2 * j + 1])
        sums[row, 0] = change
        sums[row, 1] = size


@_compiled
def weighted(span, cuts, weights, kernels, sums):  # type: ignore[no-untyped-def]
    """sums[m] = sum over the terms of weights[m] kernels, all of them in one pass."""
    for row in range(span[0], span[1]):
        for m in range(weights.shape[0]):
            here = sums[m, row]
            for j in range(here.size):
                here[j] = 0.0
            for k in range(weights.shape[1]):
                weight, kernel = weights[m, k], kernels[k, row]
                for j in range(cuts[k, row]):
                    here[j] += weight * kernel[j]
