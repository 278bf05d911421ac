"""Compiled sweeps: from surface traction and eigenstrain in depth cells to mean stress in the cells
and displacement of the surface.

In the frame (L, T, z) of a wavevector with real amplitudes, u_L = iU, u_z = W, σ_Lz = -iτ_L, σ_zz =
-τ_z, σ_Tz = -τ_T, σ_LT = iS, and of the eigenstrain ε_Lz = ig, ε_LT = is, ε_Tz = t, with k =
ν/(1-ν) and M = 2G(1-ν)/(1-2ν),

    U' = -αW - τ_L/G + 2g,        W' = kαU - τ_z/M + ε_zz + k(ε_LL + ε_TT),
    u_T' = -τ_T/G + 2t,
    τ_z' = ατ_L,        τ_L' = ασ_LL,        σ_LL = -(2GαU + ντ_z + 2G(ε_LL + νε_TT))/(1-ν),
    τ_T' = -αS,        S = Gαu_T - 2Gs.

Constant in a cell, the eigenstrain has the constant solution αU = -ε_LL - k(ε_zz + ε_TT), αW = 2g,
τ_z = 2G(ε_zz + νε_TT)/(1-ν), τ_L = 0, αu_T = 2s, τ_T = 2Gt; the rest obeys the equations of the
layer without eigenstrain. With v = Cτ + s at the lower face, m = s + Cτ_p - v_p being what does not
fit there,

    up:   s_top = v_p - C_top τ_p + F m,
    down: τ_bot = τ_p + Fᵀ(τ_top - τ_p) - K m,  v_bot = v_p + C(τ_bot - τ_p) + m.

F and K have decaying exponentials only. Means of the stress over a cell follow from the equations
by the changes across it, so that stress and displacement are exactly adjoint to each other.
"""

from __future__ import annotations

from typing import Any

from ...core.engine.compile import REORDERED, passes

compiled: Any = passes(no_cfunc_wrapper=True, fastmath=REORDERED)


@compiled
def sweep(span, rows, q, top, table, solids, loads, fields, moved, work):  # type: ignore[no-untyped-def]
    """Turn the eigenstrain ``fields`` (cells, 6, rows, columns) of the rows ``span`` into mean
    stress (Pa); add no stress for no ``loads``.

    ``rows`` gives the row of the ``table`` for each; ``q`` (4, rows, columns) the wavevector, and
    the same for odd functions of it; ``loads`` (3, rows, columns) tractions (q_x, q_y, p) in Pa;
    ``moved`` (3, rows, columns) receives the displacement of the surface in m; ``work`` (cells + 2,
    3, columns) is room for m of each cell, and for the tractions and the displacement from which
    the way down goes on.
    """
    count, columns = fields.shape[0], fields.shape[3]
    for row in range(span[0], span[1]):
        place = rows[row]
        for j in range(columns):
            work[count, 0, j] = 0.0
            work[count, 1, j] = 0.0
            work[count, 2, j] = 0.0
        for down in range(count):
            cell = count - 1 - down
            G, nu = solids[cell, 0], solids[cell, 1]
            k = nu / (1.0 - nu)
            M = 2.0 * G / (1.0 - nu)
            for j in range(columns):
                x, y, ox, oy = q[0, row, j], q[1, row, j], q[2, row, j], q[3, row, j]
                square = x * x + y * y
                away = 1.0 / square**0.5
                cc, ss, cs = x * x / square, y * y / square, ox * oy / square
                c, s = ox * away, oy * away
                xx, yy, zz = fields[cell, 0, row, j], fields[cell, 1, row, j], fields[cell, 2, row, j]
                xy, xz, yz = fields[cell, 3, row, j], fields[cell, 4, row, j], fields[cell, 5, row, j]
                LL = cc * xx + ss * yy + 2.0 * cs * xy
                TT = ss * xx + cc * yy - 2.0 * cs * xy
                twist = cs * (yy - xx) + (cc - ss) * xy  # ε_LT
                along = c * xz + s * yz  # ε_Lz
                across = c * yz - s * xz  # ε_Tz
                fields[cell, 0, row, j] = LL
                fields[cell, 1, row, j] = TT
                fields[cell, 3, row, j] = twist
                fields[cell, 4, row, j] = along
                fields[cell, 5, row, j] = across
                U = -(LL + k * (zz + TT)) * away
                W = -2j * along * away
                T = -2j * twist * away
                t_z = M * (zz + nu * TT)
                t_T = 2.0 * G * across
                m_U = work[cell + 1, 0, j] + table[place, cell, 0, j] * t_z - U
                m_W = work[cell + 1, 1, j] + table[place, cell, 1, j] * t_z - W
                m_T = work[cell + 1, 2, j] + table[place, cell, 2, j] * t_T - T
                work[cell + 1, 0, j] = m_U
                work[cell + 1, 1, j] = m_W
                work[cell + 1, 2, j] = m_T
                if cell > 0:
                    Lz, c_zz, c_T = (
                        table[place, cell - 1, 0, j],
                        table[place, cell - 1, 1, j],
                        table[place, cell - 1, 2, j],
                    )
                else:
                    Lz, c_zz, c_T = top[place, 1, j], top[place, 2, j], top[place, 3, j]
                work[cell, 0, j] = U - Lz * t_z + table[place, cell, 3, j] * m_U + table[place, cell, 4, j] * m_W
                work[cell, 1, j] = W - c_zz * t_z + table[place, cell, 5, j] * m_U + table[place, cell, 6, j] * m_W
                work[cell, 2, j] = T - c_T * t_T + table[place, cell, 7, j] * m_T
        for j in range(
            columns
        ):  # the surface; from here work[0] holds the traction, the last one the displacement on top of a cell
            x, y, ox, oy = q[0, row, j], q[1, row, j], q[2, row, j], q[3, row, j]
            away = 1.0 / (x * x + y * y) ** 0.5
            c, s = ox * away, oy * away
            t_L = -1j * (c * loads[0, row, j] + s * loads[1, row, j])
            t_T = c * loads[1, row, j] - s * loads[0, row, j]
            t_z = loads[2, row, j]
            U = work[0, 0, j] + top[place, 0, j] * t_L + top[place, 1, j] * t_z
            W = work[0, 1, j] + top[place, 1, j] * t_L + top[place, 2, j] * t_z
            T = work[0, 2, j] + top[place, 3, j] * t_T
            moved[0, row, j] = 1j * c * U - s * T
            moved[1, row, j] = 1j * s * U + c * T
            moved[2, row, j] = W
            work[0, 0, j] = t_L
            work[0, 1, j] = t_z
            work[0, 2, j] = t_T
            work[count + 1, 1, j] = W
            work[count + 1, 2, j] = T
        _down(row, place, q, table, solids, fields, work)


@compiled
def _down(row, place, q, table, solids, fields, work):  # type: ignore[no-untyped-def]
    """Tractions from cell to cell, and the mean stress in each."""
    count, columns = fields.shape[0], fields.shape[3]
    for cell in range(count):
        G, nu, h = solids[cell, 0], solids[cell, 1], solids[cell, 2]
        k = nu / (1.0 - nu)
        M = 2.0 * G / (1.0 - nu)
        E = 2.0 * G * (1.0 + nu)
        for j in range(columns):
            x, y, ox, oy = q[0, row, j], q[1, row, j], q[2, row, j], q[3, row, j]
            square = x * x + y * y
            away = 1.0 / square**0.5
            cc, ss, cs = x * x / square, y * y / square, ox * oy / square
            c, s = ox * away, oy * away
            TT, zz = fields[cell, 1, row, j], fields[cell, 2, row, j]
            twist, along, across = fields[cell, 3, row, j], fields[cell, 4, row, j], fields[cell, 5, row, j]
            p_W = -2j * along * away
            p_T = -2j * twist * away
            p_z = M * (zz + nu * TT)
            p_t = 2.0 * G * across
            m_U, m_W, m_T = work[cell + 1, 0, j], work[cell + 1, 1, j], work[cell + 1, 2, j]
            a_L, a_z, a_T = work[0, 0, j], work[0, 1, j] - p_z, work[0, 2, j] - p_t
            b_L = table[place, cell, 3, j] * a_L + table[place, cell, 5, j] * a_z
            b_L -= table[place, cell, 8, j] * m_U + table[place, cell, 9, j] * m_W
            b_z = table[place, cell, 4, j] * a_L + table[place, cell, 6, j] * a_z
            b_z -= table[place, cell, 9, j] * m_U + table[place, cell, 10, j] * m_W
            b_T = table[place, cell, 7, j] * a_T - table[place, cell, 11, j] * m_T
            W = p_W + table[place, cell, 0, j] * b_L + table[place, cell, 1, j] * b_z + m_W
            T = p_T + table[place, cell, 2, j] * b_T + m_T
            W_top, T_top = work[count + 1, 1, j], work[count + 1, 2, j]
            work[count + 1, 1, j] = W
            work[count + 1, 2, j] = T
            work[0, 0, j] = b_L
            work[0, 1, j] = b_z + p_z
            work[0, 2, j] = b_T + p_t
            per = 1.0 / h
            s_LL = (b_L - a_L) * away * per
            t_L = (b_z - a_z) * away * per
            t_z = p_z - k * (b_L - a_L) * away * per - M * (W - W_top) * per
            s_TT = nu * (s_LL - t_z) - E * TT
            t_T = p_t - G * (T - T_top) * per
            s_LT = -1j * (b_T - a_T) * away * per
            s_Lz = -1j * t_L
            fields[cell, 0, row, j] = cc * s_LL + ss * s_TT - 2.0 * cs * s_LT
            fields[cell, 1, row, j] = ss * s_LL + cc * s_TT + 2.0 * cs * s_LT
            fields[cell, 2, row, j] = -t_z
            fields[cell, 3, row, j] = cs * (s_LL - s_TT) + (cc - ss) * s_LT
            fields[cell, 4, row, j] = c * s_Lz + s * t_T
            fields[cell, 5, row, j] = s * s_Lz - c * t_T


@compiled
def press(span, rows, q, top, table, solids, loads, fields, work):  # type: ignore[no-untyped-def]
    """Add the mean stress (Pa) by ``loads`` to the ``fields`` of the rows ``span``, as ``sweep``
    does for no eigenstrain, and take the mean of xx, yy and zz away.

    ``work`` (5, columns).
    """
    count, columns = fields.shape[0], fields.shape[3]
    for row in range(span[0], span[1]):
        place = rows[row]
        for j in range(columns):
            x, y, ox, oy = q[0, row, j], q[1, row, j], q[2, row, j], q[3, row, j]
            away = 1.0 / (x * x + y * y) ** 0.5
            c, s = ox * away, oy * away
            t_L = -1j * (c * loads[0, row, j] + s * loads[1, row, j])
            t_T = c * loads[1, row, j] - s * loads[0, row, j]
            t_z = loads[2, row, j]
            work[0, j] = t_L
            work[1, j] = t_z
            work[2, j] = t_T
            work[3, j] = top[place, 1, j] * t_L + top[place, 2, j] * t_z
            work[4, j] = top[place, 3, j] * t_T
        for cell in range(count):
            G, nu, per = solids[cell, 0], solids[cell, 1], 1.0 / solids[cell, 2]
            k = nu / (1.0 - nu)
            M = 2.0 * G / (1.0 - nu)
            for j in range(columns):
                x, y, ox, oy = q[0, row, j], q[1, row, j], q[2, row, j], q[3, row, j]
                square = x * x + y * y
                away = 1.0 / square**0.5
                cc, ss, cs = x * x / square, y * y / square, ox * oy / square
                c, s = ox * away, oy * away
                a_L, a_z, a_T = work[0, j], work[1, j], work[2, j]
                b_L = table[place, cell, 3, j] * a_L + table[place, cell, 5, j] * a_z
                b_z = table[place, cell, 4, j] * a_L + table[place, cell, 6, j] * a_z
                b_T = table[place, cell, 7, j] * a_T
                W = table[place, cell, 0, j] * b_L + table[place, cell, 1, j] * b_z
                T = table[place, cell, 2, j] * b_T
                s_LL = (b_L - a_L) * away * per
                s_Lz = -1j * (b_z - a_z) * away * per
                t_z = -k * s_LL - M * (W - work[3, j]) * per
                s_TT = nu * (s_LL - t_z)
                t_T = -G * (T - work[4, j]) * per
                s_LT = -1j * (b_T - a_T) * away * per
                work[0, j] = b_L
                work[1, j] = b_z
                work[2, j] = b_T
                work[3, j] = W
                work[4, j] = T
                xx = fields[cell, 0, row, j] + cc * s_LL + ss * s_TT - 2.0 * cs * s_LT
                yy = fields[cell, 1, row, j] + ss * s_LL + cc * s_TT + 2.0 * cs * s_LT
                zz = fields[cell, 2, row, j] - t_z
                mean = (xx + yy + zz) / 3.0
                fields[cell, 0, row, j] = xx - mean
                fields[cell, 1, row, j] = yy - mean
                fields[cell, 2, row, j] = zz - mean
                fields[cell, 3, row, j] += cs * (s_LL - s_TT) + (cc - ss) * s_LT
                fields[cell, 4, row, j] += c * s_Lz + s * t_T
                fields[cell, 5, row, j] += s * s_Lz - c * t_T


@compiled
def exceeding(deviator, known, limit, found):  # type: ignore[no-untyped-def]
    """Put the points whose von Mises stress is above ``limit`` (Pa), but for the ``known``, into
    ``found``; their number.

    ``deviator`` (5, points) holds xx, yy, xy, xz, yz in Pa, ``known`` (points,) one where a point
    is known.
    """
    most, number = limit * limit / 3.0, 0
    for i in range(known.size):
        xx, yy = deviator[0, i], deviator[1, i]
        a, b, c = deviator[2, i], deviator[3, i], deviator[4, i]
        second = xx * xx + yy * yy + xx * yy + a * a + b * b + c * c
        if second > most and known[i] == 0:
            found[number] = i
            number += 1
    return number
