"""Compiled passes from the spectra of surface tractions to the spectra of the fields on a plane at depth.

A row of wavevectors first gets its panel polynomials (see ``panels``), then the coefficients of each field under each
load, turned from the frame of every wavevector into that of the grid; its mirror image has the same ones up to signs.
Loops are short and touch few arrays, so that compilers turn them into vector instructions.

``waves`` holds the components of the wavevectors (first halves, not negative), each also with the highest one of an even
grid set to zero: there an odd function of it vanishes, c, s and c s among them, while c² and s² do not. ``table`` holds
breaks, coefficients and the wavenumber beyond which all is zero.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from .panels import TERMS

_compiled: Any = njit(nogil=True, cache=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz"})


@_compiled
def _columns_below(limit, xi, eta):  # type: ignore[no-untyped-def]
    """Number of columns of a row whose wavenumber is below ``limit``, give or take rounding; eta is evenly spaced."""
    if xi >= limit:
        return 0
    if eta.size == 1 or limit == np.inf:
        return eta.size
    return min(eta.size, int(np.sqrt(limit * limit - xi * xi) / eta[1]) + 1)


@_compiled
def _amplitudes(xi, eta, table, alpha, t, values):  # type: ignore[no-untyped-def]
    """Wavenumbers of a row and the functions there; returns the number of columns below the limit."""
    breaks, coefficients, limit = table
    last = breaks.size - 2
    for j in range(eta.size):
        alpha[j] = np.sqrt(xi * xi + eta[j] * eta[j])
    alpha[0] = max(alpha[0], breaks[0])
    used = _columns_below(limit, xi, eta)
    panel = 0
    start = 0
    while start < used:
        while panel < last and alpha[start] >= breaks[panel + 1]:
            panel += 1
        stop = used if panel == last else min(used, max(start + 1, _columns_below(breaks[panel + 1], xi, eta)))
        middle = 0.5 * (breaks[panel] + breaks[panel + 1])
        scale = 2.0 / (breaks[panel + 1] - breaks[panel])
        for j in range(start, stop):
            t[j] = (alpha[j] - middle) * scale
        for f in range(values.shape[0]):
            c = coefficients[panel, f]
            for j in range(start, stop):
                value = c[TERMS - 1]
                for k in range(TERMS - 2, -1, -1):
                    value = value * t[j] + c[k]
                values[f, j] = value
        start = stop
    return used


@_compiled
def _directions(i, waves, alpha, used, d):  # type: ignore[no-untyped-def]
    """Rows c, s, c², s², c s of the row ``i``."""
    _, xi_odd, eta, eta_odd = waves
    c, s, cc, ss, cs = d
    for j in range(used):
        scale = 1.0 / alpha[j]
        c[j] = xi_odd[i] * scale
        s[j] = eta_odd[j] * scale
    for j in range(used):
        square = eta[j] * eta[j] / (alpha[j] * alpha[j])
        ss[j] = square
        cc[j] = 1.0 - square
    for j in range(used):
        cs[j] = c[j] * s[j]


@_compiled
def _stress_under_pressure(used, d, v, nu, K):  # type: ignore[no-untyped-def]
    """Coefficients of xx, yy, zz, xy (real) and xz, yz (imaginary); functions τ_zz, τ_Lz, LL_z."""
    c, s, cc, ss, cs = d
    M, m, A = v[0], v[1], v[2]
    xx, yy, zz, xy, xz, yz = K
    for j in range(used):
        T = nu * (A[j] - M[j])
        xx[j] = cc[j] * A[j] + ss[j] * T
        yy[j] = ss[j] * A[j] + cc[j] * T
    for j in range(used):
        zz[j] = -M[j]
        xy[j] = cs[j] * (A[j] - nu * (A[j] - M[j]))
    for j in range(used):
        xz[j] = -c[j] * m[j]
        yz[j] = -s[j] * m[j]


@_compiled
def _stress_under_shear(used, d, v, nu, K):  # type: ignore[no-untyped-def]
    """Coefficients under q_x of xx, yy, zz, xy (imaginary), xz, yz (real); functions τ_zL, τ_LL, LL_L, τ_T, LT.

    Under q_y they are those of exchanged axes: ``d`` and ``K`` with x and y exchanged.
    """
    c, s, cc, ss, cs = d
    M, n, A, w, g = v[3], v[4], v[5], v[6], v[7]
    xx, yy, zz, xy, xz, yz = K
    for j in range(used):
        T = nu * (A[j] - M[j])
        xx[j] = -c[j] * (cc[j] * A[j] + ss[j] * (T - 2.0 * g[j]))
        yy[j] = -c[j] * (ss[j] * (A[j] + 2.0 * g[j]) + cc[j] * T)
    for j in range(used):
        xy[j] = -s[j] * (cc[j] * (A[j] - nu * (A[j] - M[j])) + (cc[j] - ss[j]) * g[j])
    for j in range(used):
        zz[j] = c[j] * M[j]
    for j in range(used):
        xz[j] = -cc[j] * n[j] - ss[j] * w[j]
    for j in range(used):
        yz[j] = -cs[j] * (n[j] - w[j])


@_compiled
def _displacement_under_pressure(used, d, v, K):  # type: ignore[no-untyped-def]
    """Coefficients of x, y (imaginary) and z (real); functions U_z, W_z."""
    x, y, z = K
    for j in range(used):
        x[j] = d[0][j] * v[0, j]
        y[j] = d[1][j] * v[0, j]
    for j in range(used):
        z[j] = v[1, j]


@_compiled
def _displacement_under_shear(used, d, v, K):  # type: ignore[no-untyped-def]
    """Coefficients under q_x of x, y (real) and z (imaginary), functions U_L, W_L, u_T; under q_y exchanged."""
    c, _, cc, ss, cs = d
    U, W, T = v[2], v[3], v[4]
    x, y, z = K
    for j in range(used):
        x[j] = cc[j] * U[j] + ss[j] * T[j]
        y[j] = cs[j] * (U[j] - T[j])
    for j in range(used):
        z[j] = -c[j] * W[j]


@_compiled
def _field(used, parity, mirror, K, loads, out):  # type: ignore[no-untyped-def]
    """One field on one row, coefficients ``K`` under p, q_x, q_y times loads.

    ``parity`` says whether the coefficient under p is real and whether it is odd in c, hence changes its sign on the
    ``mirror`` row. That under q_y is as odd, that under q_x is not; both are imaginary where the first is real.
    """
    real, odd = parity
    p, kx, ky, fields, qx, qy = loads
    z = -1.0 if mirror and odd else 1.0
    x = -1.0 if mirror and not odd else 1.0
    A, X, Y = K
    if fields and real:
        for j in range(used):
            a, b, c, u, v, w = z * A[j], x * X[j], z * Y[j], p[j], qx[j], qy[j]
            out[j] = complex(a * u.real - b * v.imag - c * w.imag, a * u.imag + b * v.real + c * w.real)
    elif fields:
        for j in range(used):
            a, b, c, u, v, w = z * A[j], x * X[j], z * Y[j], p[j], qx[j], qy[j]
            out[j] = complex(b * v.real + c * w.real - a * u.imag, b * v.imag + c * w.imag + a * u.real)
    elif real:
        a, b = x * kx, z * ky
        for j in range(used):
            out[j] = complex(z * A[j], a * X[j] + b * Y[j]) * p[j]
    else:
        a, b = x * kx, z * ky
        for j in range(used):
            out[j] = complex(a * X[j] + b * Y[j], z * A[j]) * p[j]
    out[used:] = 0.0


@_compiled
def _rows(r, traction):  # type: ignore[no-untyped-def]
    """Row ``r`` of the loads: p, the ratios of the shear to it, whether there are shear fields besides, and these."""
    p, kx, ky, fields, qx, qy = traction
    return p[r], kx, ky, fields, qx[r], qy[r]


@_compiled
def _sheared(traction):  # type: ignore[no-untyped-def]
    """Whether there is shear along x, and along y."""
    _, kx, ky, fields, _, _ = traction
    return fields or kx != 0.0, fields or ky != 0.0


@_compiled
def stress_spectra(span, waves, table, nu, traction, out):  # type: ignore[no-untyped-def]
    """Spectra xx, yy, zz, xy, xz, yz; functions τ_zz, τ_Lz, LL_z, and for shear τ_zL, τ_LL, LL_L, τ_T, LT."""
    nx, n = traction[0].shape[0], traction[0].shape[1]
    v, alpha, t, rows = np.zeros((table[1].shape[1], n)), np.empty(n), np.empty(n), np.empty((5, n))
    K = np.zeros((6, 3, n))  # by field and load
    sheared_x, sheared_y = _sheared(traction)
    d = (rows[0], rows[1], rows[2], rows[3], rows[4])
    turned = (d[1], d[0], d[3], d[2], d[4])
    for i in range(span[0], span[1]):
        used = _amplitudes(waves[0][i], waves[2], table, alpha, t, v)
        _directions(i, waves, alpha, used, d)
        _stress_under_pressure(used, d, v, nu, (K[0, 0], K[1, 0], K[2, 0], K[3, 0], K[4, 0], K[5, 0]))
        if sheared_x:
            _stress_under_shear(used, d, v, nu, (K[0, 1], K[1, 1], K[2, 1], K[3, 1], K[4, 1], K[5, 1]))
        if sheared_y:
            _stress_under_shear(used, turned, v, nu, (K[1, 2], K[0, 2], K[2, 2], K[3, 2], K[5, 2], K[4, 2]))
        for mirror in range(1 if i == 0 or 2 * i == nx else 2):
            r = nx - i if mirror else i
            loads = _rows(r, traction)
            for f in range(6):
                _field(used, (f < 4, f == 3 or f == 4), mirror == 1, (K[f, 0], K[f, 1], K[f, 2]), loads, out[f, r])


@_compiled
def displacement_spectra(span, waves, table, traction, out):  # type: ignore[no-untyped-def]
    """Spectra x, y, z of the displacement; functions U_z, W_z, U_L, W_L, u_T."""
    nx, n = traction[0].shape[0], traction[0].shape[1]
    v, alpha, t, rows = np.zeros((5, n)), np.empty(n), np.empty(n), np.empty((5, n))
    K = np.zeros((3, 3, n))
    d = (rows[0], rows[1], rows[2], rows[3], rows[4])
    turned = (d[1], d[0], d[3], d[2], d[4])
    for i in range(span[0], span[1]):
        used = _amplitudes(waves[0][i], waves[2], table, alpha, t, v)
        _directions(i, waves, alpha, used, d)
        _displacement_under_pressure(used, d, v, (K[0, 0], K[1, 0], K[2, 0]))
        _displacement_under_shear(used, d, v, (K[0, 1], K[1, 1], K[2, 1]))
        _displacement_under_shear(used, turned, v, (K[1, 2], K[0, 2], K[2, 2]))
        for mirror in range(1 if i == 0 or 2 * i == nx else 2):
            r = nx - i if mirror else i
            loads = _rows(r, traction)
            for f in range(3):
                _field(used, (f == 2, f == 0), mirror == 1, (K[f, 0], K[f, 1], K[f, 2]), loads, out[f, r])
