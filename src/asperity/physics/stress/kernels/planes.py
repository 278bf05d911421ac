"""Compiled passes from the spectra of surface tractions to the spectra of the fields on a plane at
depth.

A line of wavevectors along x first gets its panel polynomials (see ``panels``) where ξ >= 0. Field
after field, they are turned from the frame of every wavevector into that of the grid and multiplied
with the loads, mirrored for ξ < 0. Loops are short and touch few arrays, which all stay in the
cache, so that compilers turn them into vector instructions.

``waves`` holds the components of the wavevectors across and along the lines (first halves, not
negative), each also with the highest one of an even grid set to zero: there an odd function of it
vanishes, c, s and c s among them, while c² and s² do not. ``table`` holds breaks, coefficients and
the wavenumber beyond which all is zero.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....core.engine.compile import REORDERED, passes
from ....core.interpolation import TERMS

_compiled: Any = passes(fastmath=REORDERED)

_WHOLE = (
    32  # elements by which a loop over a panel ends late: whole vectors, and the next panel puts right what is past it
)


@_compiled
def _waves_below(limit, eta, xi):  # type: ignore[no-untyped-def]
    """Number of waves of a half line whose wavenumber is below ``limit``, give or take rounding; xi
    is evenly spaced."""
    if eta >= limit:
        return 0
    if xi.size == 1 or limit == np.inf:
        return xi.size
    return min(xi.size, int(np.sqrt(limit * limit - eta * eta) / xi[1]) + 1)


@_compiled
def _amplitudes(eta, xi, table, alpha, t, values):  # type: ignore[no-untyped-def]
    """Wavenumbers of a half line, and the functions there; the arrays are longer than the line by
    ``_WHOLE``."""
    breaks, coefficients, limit = table
    last = breaks.size - 2
    for i in range(xi.size):
        alpha[i] = np.sqrt(xi[i] * xi[i] + eta * eta)
    alpha[0] = max(alpha[0], breaks[0])
    used = _waves_below(limit, eta, xi)
    panel = 0
    start = 0
    while start < used:
        while panel < last and alpha[start] >= breaks[panel + 1]:
            panel += 1
        stop = used if panel == last else min(used, max(start + 1, _waves_below(breaks[panel + 1], eta, xi)))
        middle = 0.5 * (breaks[panel] + breaks[panel + 1])
        scale = 2.0 / (breaks[panel + 1] - breaks[panel])
        count = -(-(stop - start) // _WHOLE) * _WHOLE
        here = alpha[start : start + count]
        for i in range(count):
            t[i] = (here[i] - middle) * scale
        for f in range(values.shape[0]):
            c = coefficients[panel, f]
            found = values[f, start : start + count]
            for i in range(count):
                value = c[TERMS - 1]
                for k in range(TERMS - 2, -1, -1):
                    value = value * t[i] + c[k]
                found[i] = value
        start = stop
    values[:, used:] = 0.0


@_compiled
def _directions(eta, eta_odd, xi, xi_odd, alpha, d):  # type: ignore[no-untyped-def]
    """Half lines c, s, c², s², c s."""
    c, s, cc, ss, cs = d
    for i in range(xi.size):
        scale = 1.0 / alpha[i]
        c[i] = xi_odd[i] * scale
        s[i] = eta_odd * scale
        cs[i] = xi_odd[i] * scale * (eta_odd * scale)
    for i in range(xi.size):
        square = eta * eta / (alpha[i] * alpha[i])
        ss[i] = square
        cc[i] = 1.0 - square


@_compiled
def _stress_along(d, v, nu, sheared, K):  # type: ignore[no-untyped-def]
    """Coefficients of xx under p (real), q_x, q_y (imaginary); of yy with the axes exchanged in
    ``d`` and ``K``."""
    c, s, cc, ss, _ = d
    p, x, y = K
    M, A = v[0], v[2]
    for i in range(p.size):
        p[i] = cc[i] * A[i] + ss[i] * nu * (A[i] - M[i])
    if sheared:
        M, A, g = v[3], v[5], v[7]
        for i in range(p.size):
            x[i] = -c[i] * (cc[i] * A[i] + ss[i] * (nu * (A[i] - M[i]) - 2.0 * g[i]))
        for i in range(p.size):
            y[i] = -s[i] * (cc[i] * (A[i] + 2.0 * g[i]) + ss[i] * nu * (A[i] - M[i]))


@_compiled
def _stress_normal(d, v, sheared, K):  # type: ignore[no-untyped-def]
    """Coefficients of zz under p (real), q_x, q_y (imaginary)."""
    c, s, _, _, _ = d
    p, x, y = K
    M = v[0]
    for i in range(p.size):
        p[i] = -M[i]
    if sheared:
        M = v[3]
        for i in range(p.size):
            x[i] = c[i] * M[i]
        for i in range(p.size):
            y[i] = s[i] * M[i]


@_compiled
def _stress_across(d, v, nu, sheared, K):  # type: ignore[no-untyped-def]
    """Coefficients of xy under p (real), q_x, q_y (imaginary)."""
    c, s, cc, ss, cs = d
    p, x, y = K
    M, A = v[0], v[2]
    for i in range(p.size):
        p[i] = cs[i] * (A[i] - nu * (A[i] - M[i]))
    if sheared:
        M, A, g = v[3], v[5], v[7]
        for i in range(p.size):
            x[i] = -s[i] * (cc[i] * (A[i] - nu * (A[i] - M[i])) + (cc[i] - ss[i]) * g[i])
        for i in range(p.size):
            y[i] = -c[i] * (ss[i] * (A[i] - nu * (A[i] - M[i])) + (ss[i] - cc[i]) * g[i])


@_compiled
def _stress_through(d, v, sheared, K):  # type: ignore[no-untyped-def]
    """Coefficients of xz under p (imaginary), q_x, q_y (real); of yz with the axes exchanged in
    ``d`` and ``K``."""
    c, _, cc, ss, cs = d
    p, x, y = K
    m = v[1]
    for i in range(p.size):
        p[i] = -c[i] * m[i]
    if sheared:
        n, w = v[4], v[6]
        for i in range(p.size):
            x[i] = -cc[i] * n[i] - ss[i] * w[i]
        for i in range(p.size):
            y[i] = -cs[i] * (n[i] - w[i])


@_compiled
def _displacement_along(d, v, K):  # type: ignore[no-untyped-def]
    """Coefficients of x under p (imaginary), q_x, q_y (real); of y with the axes exchanged in ``d``
    and ``K``."""
    c, _, cc, ss, cs = d
    p, x, y = K
    for i in range(p.size):
        p[i] = c[i] * v[0, i]
    U, T = v[2], v[4]
    for i in range(p.size):
        x[i] = cc[i] * U[i] + ss[i] * T[i]
    for i in range(p.size):
        y[i] = cs[i] * (U[i] - T[i])


@_compiled
def _displacement_normal(d, v, K):  # type: ignore[no-untyped-def]
    """Coefficients of z under p (real), q_x, q_y (imaginary)."""
    c, s, _, _, _ = d
    p, x, y = K
    for i in range(p.size):
        p[i] = v[1, i]
    W = v[3]
    for i in range(p.size):
        x[i] = -c[i] * W[i]
    for i in range(p.size):
        y[i] = -s[i] * W[i]


@_compiled
def _combined(kx, x, ky, y, total, difference):  # type: ignore[no-untyped-def]
    """Write kx x + ky y, and ky y - kx x."""
    for i in range(total.size):
        total[i] = kx * x[i] + ky * y[i]
    for i in range(total.size):
        difference[i] = ky * y[i] - kx * x[i]


@_compiled
def _product(a, b, mirror, p, out):  # type: ignore[no-untyped-def]
    """(a + i b) p for ξ >= 0; behind, sign (a + i b) p with the mirror images of others,
    ``mirror`` = sign, a, b."""
    for i in range(a.size):
        out[i] = complex(a[i] * p[i].real - b[i] * p[i].imag, a[i] * p[i].imag + b[i] * p[i].real)
    sign, a, b = mirror
    p, out = p[a.size :], out[a.size :]
    for i in range(out.size):
        k = np.uintp(out.size - i)
        u, v, w = sign * a[k], sign * b[k], p[i]
        out[i] = complex(u * w.real - v * w.imag, u * w.imag + v * w.real)


@_compiled
def _sum(real, sign, K, loads, out):  # type: ignore[no-untyped-def]
    """If ``real``, a p + i (b x + c y), else i a p + b x + c y; behind, with mirror images times
    sign, -sign, sign."""
    (a, b, c), (p, x, y) = K, loads
    r, i = (1.0, 0.0) if real else (0.0, 1.0)  # all times r + i i, with b and c turned back by its square
    turn = r - i
    for k in range(a.size):
        u, v, w, e, f = p[k], x[k], y[k], turn * b[k], turn * c[k]
        m, n = a[k] * u.real - e * v.imag - f * w.imag, a[k] * u.imag + e * v.real + f * w.real
        out[k] = complex(r * m - i * n, i * m + r * n)
    p, x, y, out = p[a.size :], x[a.size :], y[a.size :], out[a.size :]
    r, i = sign * r, sign * i
    for k in range(out.size):
        j = np.uintp(out.size - k)
        u, v, w, e, f = p[k], x[k], y[k], -turn * b[j], turn * c[j]
        m, n = a[j] * u.real - e * v.imag - f * w.imag, a[j] * u.imag + e * v.real + f * w.real
        out[k] = complex(r * m - i * n, i * m + r * n)


@_compiled
def _field(parity, K, loads, lines, out):  # type: ignore[no-untyped-def]
    """One field on one line, coefficients ``K`` under p, q_x, q_y times loads.

    ``parity``: whether the coefficient under p is real and whether it is odd in c, hence has
    another sign at -ξ. That under q_y is as odd, that under q_x is not; both are imaginary where
    the first is real.
    """
    real, odd = parity
    p, kx, ky, fields, qx, qy = loads
    sign = -1.0 if odd else 1.0
    b, mirrored = lines
    if fields:
        _sum(real, sign, K, (p, qx, qy), out)
    else:
        if kx != 0.0 or ky != 0.0:
            _combined(kx, K[1], ky, K[2], b, mirrored)
        if real:
            _product(K[0], b, (sign, K[0], mirrored), p, out)
        else:
            _product(b, K[0], (sign, mirrored, K[0]), p, out)


@_compiled
def _line(r, traction):  # type: ignore[no-untyped-def]
    """Line ``r`` of the loads: p, the ratios of the shear to it, whether there are shear fields
    besides, and these."""
    p, kx, ky, fields, qx, qy = traction
    return p[r], kx, ky, fields, qx[r], qy[r]


@_compiled
def _room(functions, n):  # type: ignore[no-untyped-def]
    """Arrays for a line: functions, wavenumbers, t; directions, these exchanged; coefficients,
    these exchanged; two more."""
    v, alpha, t = np.zeros((functions, n + _WHOLE)), np.zeros(n + _WHOLE), np.empty(n + _WHOLE)
    half = np.zeros((10, n))
    c, s, cc, ss, cs, p, x, y = half[0], half[1], half[2], half[3], half[4], half[5], half[6], half[7]
    return v, alpha, t, (c, s, cc, ss, cs), (s, c, ss, cc, cs), (p, x, y), (p, y, x), (half[8], half[9])


@_compiled
def stress_spectra(span, waves, table, nu, traction, out):  # type: ignore[no-untyped-def]
    """Spectra xx, yy, zz, xy, xz, yz; functions τ_zz, τ_Lz, LL_z, and for shear τ_zL, τ_LL, LL_L,
    τ_T, LT.

    Line ``span[0]`` of the waves and loads goes to the first line of ``out``, and so on to
    ``span[1]``; ``out`` may have more lines and longer ones.
    """
    (_, kx, ky, fields, _, _), (eta, eta_odd, xi, xi_odd), nx = traction, waves, traction[0].shape[1]
    v, alpha, t, d, turned, K, exchanged, lines = _room(table[1].shape[1], xi.size)
    sheared = fields or kx != 0.0 or ky != 0.0
    for r in range(span[0], span[1]):
        _amplitudes(eta[r], xi, table, alpha, t, v)
        _directions(eta[r], eta_odd[r], xi, xi_odd, alpha, d)
        loads, to = _line(r, traction), r - span[0]
        _stress_along(d, v, nu, sheared, K)
        _field((True, False), K, loads, lines, out[0, to, :nx])
        _stress_along(turned, v, nu, sheared, exchanged)
        _field((True, False), K, loads, lines, out[1, to, :nx])
        _stress_normal(d, v, sheared, K)
        _field((True, False), K, loads, lines, out[2, to, :nx])
        _stress_across(d, v, nu, sheared, K)
        _field((True, True), K, loads, lines, out[3, to, :nx])
        _stress_through(d, v, sheared, K)
        _field((False, True), K, loads, lines, out[4, to, :nx])
        _stress_through(turned, v, sheared, exchanged)
        _field((False, False), K, loads, lines, out[5, to, :nx])


@_compiled
def displacement_spectra(span, waves, table, traction, out):  # type: ignore[no-untyped-def]
    """Spectra x, y, z of the displacement; functions U_z, W_z, U_L, W_L, u_T. Lines as in
    ``stress_spectra``."""
    (eta, eta_odd, xi, xi_odd), nx = waves, traction[0].shape[1]
    v, alpha, t, d, turned, K, exchanged, lines = _room(table[1].shape[1], xi.size)
    for r in range(span[0], span[1]):
        _amplitudes(eta[r], xi, table, alpha, t, v)
        _directions(eta[r], eta_odd[r], xi, xi_odd, alpha, d)
        loads, to = _line(r, traction), r - span[0]
        _displacement_along(d, v, K)
        _field((False, True), K, loads, lines, out[0, to, :nx])
        _displacement_along(turned, v, exchanged)
        _field((False, False), K, loads, lines, out[1, to, :nx])
        _displacement_normal(d, v, K)
        _field((True, False), K, loads, lines, out[2, to, :nx])
