"""Flux density on the contact at one potential drop: (K + rho) j = V, and bounds on its sum.

On the contact set alone the linear system is that of the contact's stiffness, K d = 1, and is
solved by the same conjugate gradients in single precision; the residual, computed in double
precision, is solved for once more. With a gap that conducts all points take part,
(K + D) j = V with the film in D in contact and one over the conductance of the gap outside.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...contact.measure import Response
from ...contact.operators import Operator
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError

ROUNDS = 3
"""Linear solves at most: the first leaves a residual of 1e-4 and single precision, the second 1e-7
or so."""

CLOSE = 1e-8
"""Distance of the bounds over the conductance at which no further round follows: the flux density
then errs by 1e-4 in the norm of the energy at most. One round mostly leaves 1e-8 to 1e-7."""

REDUCTION = 1e-6
"""Residual over the drop, root of the mean square on the conducting points, at which conjugate
gradients with a conducting gap end: the conductance errs by its square."""

GAP_STEPS = 300
"""Steps of the conjugate gradients with a conducting gap at most; 10 to 40 are the rule."""


@dataclass(frozen=True, eq=False)
class Flux:
    """Flux density per unit drop, and what is known of its error.

    Attributes
    ----------
    density
        (nx, ny), S/m² or W/(m² K): flux density per unit drop.
    drop
        (nx, ny): share of the drop that the flux spends in the bodies and the film at each point;
        one on the contact.
    lower, upper
        Bounds of the mean flux density per unit drop on this grid: Thomson's principle of the flux
        found, and the energy of its residual by the wave that gives way least.
    residual
        Root of the mean square of the drop that is left over, on the points that conduct.
    """

    density: RealArray
    drop: RealArray
    lower: float
    upper: float
    residual: float

    @property
    def mean(self) -> float:
        """Mean flux density per unit drop: that of the lower bound, which is nearer to the truth
        than the mean of the flux."""
        return self.lower


def flux(operator: Operator, contact: BoolArray) -> Flux:
    """Flux on the points of ``contact`` (nx, ny) at the drop one, by the ``operator`` of the
    conductors and the film.

    Without contact it is zero. Where every point is in contact the drop of a uniform flow is left
    out of a periodic operator, and the flux would be infinite.

    Raises
    ------
    ConvergenceError
        If the linear system is not solved.
    """
    shape = operator.grid.shape
    if not contact.any():
        nothing = np.zeros(shape)
        return Flux(nothing, nothing, 0.0, 0.0, 0.0)
    if contact.all() and operator.zero_mean_mode:
        everywhere = np.full(shape, math.inf)
        return Flux(everywhere, np.zeros(shape), math.inf, math.inf, 0.0)
    density: RealArray = np.zeros(shape)
    drop, left = density, contact.astype(float)
    prepared = Response.of(operator, contact)
    for done in range(ROUNDS):
        found = prepared.solved(left if done else None)
        if found.values is None:
            raise ConvergenceError(
                f"The flux on the contact was not found: the linear system was not solved in round {done + 1}."
            )
        density = density + found.pressure
        drop = operator.apply(density)
        left = np.where(contact, 1.0 - drop, 0.0)
        bounded = _bounded(operator, density, drop, left, contact)
        if bounded.upper - bounded.lower <= CLOSE * bounded.lower:
            break
    return bounded


def flux_with_gap(operator: Operator, contact: BoolArray, gap_resistance: RealArray, film_resistance: float) -> Flux:
    """The same where the gap conducts, too: its specific resistance at every point outside the
    contact is ``gap_resistance`` (nx, ny), > 0, infinite where it does not conduct.

    The ``operator`` holds the ``film_resistance`` everywhere, which outside gives way to the gap.
    Conjugate gradients on all points that conduct, preconditioned by the model of the contact's
    solver on the contact and by the diagonal outside.

    Raises
    ------
    ConvergenceError
        If the linear system is not solved.
    """
    conducts = contact | np.isfinite(gap_resistance)
    if not conducts.any():
        return flux(operator, contact)
    own = float(operator.apply(_point(operator))[0, 0]) - film_resistance
    more = np.where(conducts & ~contact, gap_resistance - film_resistance, 0.0)
    diagonal = np.where(conducts & ~contact, own + gap_resistance, 1.0)
    system = _Preconditioner(operator, contact, diagonal)
    j, r = np.zeros(contact.shape), conducts.astype(float)
    z = np.where(conducts, system(r), 0.0)
    t, rz = z.copy(), float((r * z).sum())
    for _ in range(GAP_STEPS):
        kt = np.where(conducts, operator.apply(t) + more * t, 0.0)
        curvature = float((t * kt).sum())
        if not curvature > 0.0:
            break
        length = rz / curvature
        j += length * t
        r -= length * kt
        if _rms(r, conducts) <= REDUCTION:
            break
        z = np.where(conducts, system(r), 0.0)
        rz, before = float((r * z).sum()), rz
        t = z + rz / before * t
    else:
        raise ConvergenceError(
            f"The flux through contact and gap was not found in {GAP_STEPS} steps: the drop is still off by "
            f"{_rms(r, conducts):.1e}."
        )
    drop = operator.apply(j) + more * j
    left = np.where(conducts, 1.0 - drop, 0.0)
    return _bounded(operator, j, drop, left, conducts)


class _Preconditioner:
    """Approximate inverse: nested splines on the contact, the diagonal outside."""

    def __init__(self, operator: Operator, contact: BoolArray, diagonal: RealArray) -> None:
        self.contact, self.diagonal, self.engine = contact, diagonal, operator.engine
        self.found = Response.of(operator, contact) if contact.any() else None
        if self.found is not None:
            self.found.scaled.splines.factorise(self.found.free)

    def __call__(self, r: RealArray) -> RealArray:
        """It times the residual ``r`` (nx, ny)."""
        z = r / self.diagonal
        return z if self.found is None else np.where(self.contact, self.found.preconditioned(r), z)


def _point(operator: Operator) -> RealArray:
    unit = np.zeros(operator.grid.shape)
    unit[0, 0] = 1.0
    return unit


def _rms(left: RealArray, points: BoolArray) -> float:
    return math.sqrt(float((left * left).sum()) / int(np.count_nonzero(points)))


def _bounded(operator: Operator, density: RealArray, drop: RealArray, left: RealArray, points: BoolArray) -> Flux:
    """The flux with its bounds: 1·K⁻¹1 = 2 1·j - j·Kj + r·K⁻¹r for any j, r = 1 - Kj.

    Thomson: (1·j)²/(j·Kj) is below it for any j; r·K⁻¹r is at most r·r over the least eigenvalue.
    """
    n = operator.grid.n_points
    total, energy = float(density[points].sum()), float((density * drop)[points].sum())
    lower = total * total / energy / n if energy > 0.0 else 0.0
    square = float((left * left).sum())
    upper = (2.0 * total - energy + square / operator.smallest) / n
    return Flux(density, drop, lower, max(upper, lower), _rms(left, points))
