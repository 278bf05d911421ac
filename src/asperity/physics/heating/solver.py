"""Share of the heat between both bodies: one linear equation on the contact.

Equal temperature of the plane in which heat q is made, on every point of contact,

    (K1 + K2 + R1 + R2) q1 = (K2 + R2) q + Tb2 - Tb1.

The operator is real, not symmetric where something moves, and q·Kq > 0, so that there is exactly
one answer, which may be negative: where the hot wake of one body warms the other. GMRES without
restart, preconditioned by the inverse of the symmetric part of every wave.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from .kernels import HeatKernel

TOLERANCE = 3e-10
"""Residual over the right-hand side, root of the mean square, at which GMRES ends."""

_ROOM = 32
"""Steps for which there is room at first."""

MOST = 200
"""Steps at most; 10 to 40 are the rule."""


@dataclass(frozen=True, eq=False)
class Shared:
    """How the heat is shared.

    Attributes
    ----------
    heat_1
        (nx, ny) flux into body 1, W/m².
    rise_1, rise_2
        (nx, ny) temperature rise of the surfaces of both bodies over their bulk, K; None of a body
        that takes no heat.
    mismatch
        Largest difference between both temperatures of the plane of generation on the contact, K.
    work
        Σ q·(K1 + K2 + R) q over the contact for the flux q1 found, > 0.
    steps
        Steps of GMRES.
    """

    heat_1: RealArray
    rise_1: RealArray | None
    rise_2: RealArray | None
    mismatch: float
    work: float
    steps: int


def shared(
    kernels: tuple[HeatKernel | None, HeatKernel | None],
    heat: RealArray,
    contact: BoolArray,
    resistance: tuple[float, float],
    difference: float,
) -> Shared:
    """Share of ``heat`` (nx, ny) in W/m² on the points of ``contact`` (nx, ny).

    Parameters
    ----------
    kernels
        Of body and counter body; None of one that takes no heat, so that the other takes all.
    resistance
        R1 and R2 in m² K/W.
    difference
        Bulk temperature of the counter body less that of the body, K.

    Raises
    ------
    InputError
        If all points touch and nothing determines how the mean heat is shared.
    ConvergenceError
        If the equation is not solved.
    """
    first, second = kernels
    nothing = np.zeros_like(heat)
    if first is None or second is None or not contact.any():
        heat_1 = heat if second is None else nothing
        rises = [
            None if kernel is None else kernel.apply(flux)
            for kernel, flux in ((first, heat_1), (second, heat - heat_1))
        ]
        return Shared(heat_1, rises[0], rises[1], 0.0, 0.0, 0)
    both, between = first + second, resistance[0] + resistance[1]
    if contact.all() and not between and not both.spectrum[0, 0].real:
        raise InputError(
            "heat sinks must be given where all points touch, since the mean heat is shared by what the bodies are in "
            "depth, but are not. Give both ({heating.sink_body=1mm}, {heating.sink_counter_body=1mm})."
        )

    def applied(flux: RealArray) -> RealArray:
        whole = np.zeros_like(heat)
        whole[contact] = flux
        return both.apply(whole)[contact] + between * flux

    known = second.apply(heat)[contact] + resistance[1] * heat[contact] + difference
    # that of two homogeneous bodies at rest at every point: of a single pixel
    own = [
        float(kernel.spectrum.real.mean()) + between
        for kernel, between in zip((first, second), resistance, strict=True)
    ]
    start = own[1] / sum(own) * heat[contact]
    left, size = known - applied(start), float(np.linalg.norm(known))
    more, steps = gmres(applied, _preconditioner(both, contact, between), left, TOLERANCE * size)
    found = start + more
    heat_1 = nothing.copy()
    heat_1[contact] = found
    heat_2 = heat - heat_1
    rise_1, rise_2 = first.apply(heat_1), second.apply(heat_2)
    planes = rise_1 + resistance[0] * heat_1 - rise_2 - resistance[1] * heat_2 - difference
    work = float(found @ applied(found))
    return Shared(heat_1, rise_1, rise_2, float(np.abs(planes[contact]).max()), work, steps)


def _preconditioner(both: HeatKernel, contact: BoolArray, between: float) -> Callable[[RealArray], RealArray]:
    """Inverse of the symmetric part of every wave, on the contact."""
    symmetric = both.spectrum.real + between
    least = symmetric[symmetric > 0.0]
    safe = np.where(symmetric > 0.0, symmetric, least.max()) if least.size else np.ones_like(symmetric)
    inverse = replace(both, spectrum=(1.0 / np.maximum(safe, 1e-3 * np.median(safe))).astype(np.complex128))

    def times(residual: RealArray) -> RealArray:
        whole = np.zeros(contact.shape)
        whole[contact] = residual
        return inverse.apply(whole)[contact]

    return times


def gmres(
    operator: Callable[[RealArray], RealArray],
    preconditioner: Callable[[RealArray], RealArray],
    right: RealArray,
    allowed: float,
) -> tuple[RealArray, int]:
    """Solution x (n,) of operator(x) = ``right``, preconditioned from the right, and its steps,
    with a residual whose norm is ``allowed``.

    Raises
    ------
    ConvergenceError
        If the residual is far above that after ``MOST`` steps.
    """
    size = float(np.linalg.norm(right))
    if size <= allowed:
        return np.zeros_like(right), 0
    most = min(MOST, right.size)
    basis, turned = np.empty((0, right.size)), np.empty((0, right.size))
    upper, turns, g, steps = np.zeros((most + 1, most)), list[tuple[float, float]](), np.zeros(most + 1), 0
    g[0], w, last = size, right, size
    while steps < most and last and abs(g[steps]) > allowed:
        if steps == len(basis):  # room for more
            basis, turned = (np.concatenate([rows, np.empty((_ROOM, right.size))]) for rows in (basis, turned))
        basis[steps] = w / last
        turned[steps] = preconditioner(basis[steps])
        w, column = operator(turned[steps]), np.zeros(steps + 2)
        known = basis[: steps + 1]
        for _ in range(2):  # twice, so that rounding leaves the basis orthogonal
            parts = known @ w
            column[:-1] += parts
            w = w - parts @ known
        last = column[-1] = float(np.linalg.norm(w))
        for i, (c, s) in enumerate(turns):
            column[i], column[i + 1] = c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]
        radius = math.hypot(column[-2], last)
        c, s = (column[-2] / radius, last / radius) if radius else (1.0, 0.0)
        turns.append((c, s))
        g[steps], g[steps + 1] = c * g[steps], -s * g[steps]
        column[-2] = radius
        upper[: steps + 1, steps] = column[:-1]
        steps += 1
    if abs(g[steps]) > 1e3 * allowed:
        raise ConvergenceError(
            f"The share of the heat was not found in {steps} steps: the residual is still {abs(g[steps]) / size:.1e}."
        )
    weights = np.linalg.solve(upper[:steps, :steps], g[:steps])
    return np.asarray(weights @ turned[:steps]), steps
