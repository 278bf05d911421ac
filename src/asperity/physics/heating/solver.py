"""Share of the heat between both bodies: one linear equation on the contact.

Equal temperature of the plane in which heat q is made, on every point of contact,

    (K1 + K2 + R1 + R2) q1 = (K2 + R2) q + Tb2 - Tb1.

The operator is real, not symmetric where something moves, and q·Kq > 0, so that there is exactly
one answer, which may be negative: where the hot wake of one body warms the other. GMRES in
single precision, preconditioned by the inverse of every wave, with residuals in double precision.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from .kernels import HeatKernel

TOLERANCE = 3e-10
"""Residual over the right-hand side, root of the mean square, at which the share is found."""

ROUNDS = 8
"""Rounds of GMRES in single precision at most, each with the residual in double precision; three
are the rule."""

REDUCTION = 3e-5
"""By which a round reduces the residual: single precision gives little more."""

MOST = 200
"""Steps of a round at most; 5 to 15 are the rule."""

LEAST = 1e-3
"""Waves that respond less than this share of their median are not preconditioned by their
inverse."""

_ROOM = 16
"""Steps for which there is room at first."""

SingleArray: TypeAlias = NDArray[np.float32]


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
    heat = np.ascontiguousarray(heat, dtype=np.float64)
    if first is None or second is None or not contact.any():
        into = heat if second is None else np.zeros(heat.shape)
        fluxes = ((first, into), (second, heat - into))
        rises = [None if kernel is None else kernel.apply(flux) for kernel, flux in fluxes]
        return Shared(into, rises[0], rises[1], 0.0, 0.0, 0)
    both, between = first + second, resistance[0] + resistance[1]
    if contact.all() and not between and not both.spectrum[0, 0].real:
        raise InputError(
            "heat sinks must be given where all points touch, since the mean heat is shared by what the bodies are in "
            "depth, but are not. Give both ({heating.sink_body=1mm}, {heating.sink_counter_body=1mm})."
        )
    at = np.flatnonzero(contact)
    alone = [kernel.apply(heat) for kernel in (first, second)]
    known = (alone[1] + resistance[1] * heat).ravel()[at] + difference
    # that of two homogeneous bodies at rest at every point: of a single pixel
    own = [float(kernel.spectrum.real.mean()) + more for kernel, more in zip((first, second), resistance, strict=True)]
    share = own[1] / sum(own)
    heat_1: RealArray = np.zeros(heat.shape)
    heat_1.ravel()[at] = share * heat.ravel()[at]
    left: RealArray = known - share * (alone[0] + alone[1] + between * heat).ravel()[at]
    heat_1, left, steps = _refined(both, between, at, (heat_1, left), TOLERANCE * float(np.linalg.norm(known)))
    rise_1, of_first = first.apply(heat_1), second.apply(heat_1)
    left = known - (rise_1 + of_first + between * heat_1).ravel()[at]
    work = float((heat_1 * (rise_1 + of_first + between * heat_1)).sum())
    return Shared(heat_1, rise_1, alone[1] - of_first, float(np.abs(left).max()), work, steps)


def _refined(
    both: HeatKernel, between: float, at: NDArray[np.intp], start: tuple[RealArray, RealArray], allowed: float
) -> tuple[RealArray, RealArray, int]:
    """Flux (nx, ny) and what is left of the right-hand side on the points ``at`` of contact, from a
    ``start`` of both, and the steps taken, in rounds of single precision.

    Raises
    ------
    ConvergenceError
        If the norm of what is left is far above ``allowed``.
    """
    (flux, left), steps = start, 0
    forward = _on_contact(both.single, flux.shape, at)
    backward = _on_contact(_inverse(both, between).single, flux.shape, at)
    size = float(np.linalg.norm(left))
    for _ in range(ROUNDS):
        if size <= allowed:
            return flux, left, steps
        scaled = (left / size).astype(np.float32)
        more, taken = gmres(
            lambda x: forward(x) + np.float32(between) * x, backward, scaled, max(0.5 * allowed / size, REDUCTION)
        )
        change = np.zeros_like(flux)
        change.ravel()[at] = size * more
        flux, steps = flux + change, steps + taken
        left = left - (both.apply(change) + between * change).ravel()[at]
        size = float(np.linalg.norm(left))
    if size > 1e3 * allowed:
        raise ConvergenceError(
            f"The share of the heat was not found in {steps} steps: the temperatures of both bodies still differ by "
            f"{size / math.sqrt(at.size):.1e} K."
        )
    return flux, left, steps


def _inverse(both: HeatKernel, between: float) -> HeatKernel:
    """Inverse of every wave, but of those that give way least."""
    waves = both.spectrum + between
    size = np.abs(waves)
    kept = size > LEAST * float(np.median(size))
    return replace(both, spectrum=np.reciprocal(np.where(kept, waves, complex(size.max()))))


def _on_contact(
    kernel: HeatKernel, shape: tuple[int, ...], at: NDArray[np.intp]
) -> Callable[[SingleArray], SingleArray]:
    """``kernel`` between fluxes and temperatures of the points ``at`` of contact."""

    def times(flux: SingleArray) -> SingleArray:
        whole: Any = np.zeros(shape, np.float32)
        whole.ravel()[at] = flux
        return np.asarray(kernel.apply(whole).ravel()[at], np.float32)

    return times


def gmres(
    operator: Callable[[SingleArray], SingleArray],
    preconditioner: Callable[[SingleArray], SingleArray],
    right: SingleArray,
    allowed: float,
) -> tuple[SingleArray, int]:
    """Solution x (n,) of operator(x) = ``right``, whose norm is one, preconditioned from the right,
    and its steps, with a residual whose norm is ``allowed`` or after ``MOST`` steps."""
    most = min(MOST, right.size)
    basis, turned = (np.empty((0, right.size), np.float32) for _ in range(2))
    upper, turns, g, steps = np.zeros((most + 1, most)), list[tuple[float, float]](), np.zeros(most + 1), 0
    g[0], w, last = 1.0, right, 1.0
    while steps < most and last and abs(g[steps]) > allowed:
        if steps == len(basis):  # room for more
            room = np.empty((_ROOM, right.size), np.float32)
            basis, turned = (np.concatenate([rows, room]) for rows in (basis, turned))
        basis[steps] = w / np.float32(last)
        turned[steps] = preconditioner(basis[steps])
        w, column = operator(turned[steps]), np.zeros(steps + 2)
        known = basis[: steps + 1]
        for _ in range(2):  # twice, so that rounding leaves the basis orthogonal
            parts = np.einsum("kn,n->k", known, w)  # matrix products wait for threads that are busy elsewhere
            column[:-1] += parts
            w = w - np.einsum("k,kn->n", parts, known)
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
    weights = np.linalg.solve(upper[:steps, :steps], g[:steps])
    return np.einsum("k,kn->n", weights.astype(np.float32), turned[:steps]), steps
