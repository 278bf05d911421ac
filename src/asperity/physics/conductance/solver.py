"""Flux density on the contact at one potential drop: (K + rho) j = V, and bounds on its sum.

On the contact set alone the linear system is that of the contact's stiffness, K d = 1, and is
solved by the same conjugate gradients in single precision; the residual, computed in double
precision, is solved for once more. With a gap that conducts all points take part,
(K + D) j = V with the film in D in contact and one over the conductance of the gap outside.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...contact.measure import Response
from ...contact.operators import Operator
from ...contact.solvers.active_set.linear_system import ScaledOperator
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError

ROUNDS = 3
"""Linear solves at most: the first leaves a residual of 1e-4 and single precision, the second 1e-7
or so."""

CLOSE = 1e-8
"""Distance of the bounds over the conductance at which no further round follows: the flux density
then errs by 1e-4 in the norm of the energy at most. One round mostly leaves 1e-8 to 1e-7."""

ENDING = 0.25
"""Share of ``CLOSE`` at which conjugate gradients with a conducting gap end: the flux density of
single pixels errs more than their sum, and single precision adds to the residual."""

GAP_STEPS = 300
"""Steps of the conjugate gradients with a conducting gap at most; 10 to 20 are the rule."""


@dataclass(frozen=True, eq=False)
class Flux:
    """Flux density per unit drop, and what is known of its error.

    Attributes
    ----------
    density
        (nx, ny), S/m² or W/(m² K): flux density per unit drop.
    drop
        (nx, ny): share of the drop that the flux spends in the bodies and the film at each point;
        one on the contact, less where a gap conducts.
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
        bounded = _bounded(operator, density, drop, contact)
        if bounded.upper - bounded.lower <= CLOSE * bounded.lower:
            break
    return bounded


def flux_with_gap(operator: Operator, contact: BoolArray, gap_resistance: RealArray, film_resistance: float) -> Flux:
    """The same where the gap conducts, too: its specific resistance at every point outside the
    contact is ``gap_resistance`` (nx, ny), > 0, infinite where it does not conduct.

    The ``operator`` holds the ``film_resistance`` everywhere, which outside gives way to the gap.
    Conjugate gradients in single precision on all points that conduct, preconditioned by the model
    of the contact's solver on the contact and by the diagonal outside; the residual, in double
    precision, is solved for again until the bounds are close.

    Raises
    ------
    ConvergenceError
        If the linear system is not solved.
    """
    conducts = contact | np.isfinite(gap_resistance)
    if not conducts.any():
        return flux(operator, contact)
    more = np.where(conducts & ~contact, gap_resistance - film_resistance, 0.0)
    system = _GapSystem(operator, contact, conducts, more, film_resistance)
    density: RealArray = np.zeros(contact.shape)
    left = conducts.astype(float)
    for _ in range(ROUNDS):
        density = density + system.solved(left)
        through_bodies = operator.apply(density)
        drop = through_bodies + more * density
        left = np.where(conducts, 1.0 - drop, 0.0)
        bounded = _bounded(operator, density, drop, conducts, more, film_resistance)
        if bounded.upper - bounded.lower <= CLOSE * bounded.lower:
            break
    in_bodies = np.where(contact, drop, through_bodies - film_resistance * density)
    return replace(bounded, drop=in_bodies)


class _GapSystem:
    """(K + D) j = r on the points that conduct, in units of the largest entry of K and in single
    precision; its preconditioner is nested splines on the contact, the diagonal outside."""

    def __init__(
        self, operator: Operator, contact: BoolArray, conducts: BoolArray, more: RealArray, film_resistance: float
    ) -> None:
        self.found = Response.of(operator, contact) if contact.any() else None
        if self.found is None:
            self.scaled = ScaledOperator.of(operator, "float32", operator.largest or 1.0)
        else:
            self.scaled = self.found.scaled
            self.scaled.splines.factorise(self.found.free)
        scale = self.scaled.scale
        own = float(operator.apply(_point(operator))[0, 0])
        outside = conducts & ~contact
        self.more = np.divide(more, scale, dtype=np.float32)
        self.diagonal = np.where(outside, scale / (own + more), 0.0).astype(np.float32)  # its inverse
        self.closed = None if conducts.all() else ~conducts
        weight, _ = _weights(operator, conducts, more, film_resistance)
        self.weight = (scale * weight).astype(np.float32)
        self.response = self.scaled.engine.field(contact.shape, "float32")

    def solved(self, left: RealArray) -> RealArray:
        """Flux density (nx, ny) of the drop ``left`` (nx, ny), to a share of ``CLOSE``."""
        r = left.astype(np.float32)
        j = np.zeros_like(r)
        z = self._preconditioned(r)
        t, rz = z.copy(), _dot(r, z)
        for _ in range(GAP_STEPS):
            kt = self._product(t)
            curvature = _dot(t, kt)
            if not curvature > 0.0:
                break
            length = np.float32(rz / curvature)
            j += length * t
            kt *= length
            r -= kt
            if _dot(r, r * self.weight) <= ENDING * CLOSE * abs(float(j.sum(dtype=float))):
                break
            z = self._preconditioned(r)
            before, rz = rz, _dot(r, z)
            t *= np.float32(rz / before)
            t += z
        else:
            raise ConvergenceError(
                f"The flux through contact and gap was not found in {GAP_STEPS} steps: the drop is still off by "
                f"{math.sqrt(_dot(r, r) / r.size):.1e}."
            )
        return np.divide(j, self.scaled.scale, dtype=float)

    def _product(self, t: RealArray) -> RealArray:
        engine = self.scaled.engine
        self.scaled.product.apply(engine.array(t, "float32"), self.response)
        found: RealArray = np.asarray(engine.numpy(self.response)) + self.more * t
        if self.closed is not None:
            found[self.closed] = 0.0
        return found

    def _preconditioned(self, r: RealArray) -> RealArray:
        z: RealArray = r * self.diagonal
        if self.found is not None:
            z += self.found.preconditioned(r)
        return z


def _dot(a: RealArray, b: RealArray) -> float:
    return float(np.dot(a.ravel(), b.ravel()))


def _point(operator: Operator) -> RealArray:
    unit = np.zeros(operator.grid.shape)
    unit[0, 0] = 1.0
    return unit


def _rms(left: RealArray, points: BoolArray) -> float:
    return math.sqrt(float((left * left).sum()) / int(np.count_nonzero(points)))


def _bounded(
    operator: Operator,
    density: RealArray,
    drop: RealArray,
    points: BoolArray,
    more: RealArray | float = 0.0,
    film_resistance: float = 0.0,
) -> Flux:
    """The flux with its bounds: 1·A⁻¹1 = 2 1·j - j·Aj + r·A⁻¹r for any j, r = 1 - Aj.

    Thomson: (1·j)²/(j·Aj) is below it for any j. Above it is what a smaller matrix gives in r·A⁻¹r
    (``_weights``).
    """
    n, left = operator.grid.n_points, np.where(points, 1.0 - drop, 0.0)
    total, energy = float(density[points].sum()), float((density * drop)[points].sum())
    lower = total * total / energy / n if energy > 0.0 else 0.0
    weight, uniform = _weights(operator, points, more, film_resistance)
    rest = float((left * left * weight).sum()) + uniform * float((left * weight).sum()) ** 2
    upper = (2.0 * total - energy + rest) / n
    return Flux(density, drop, lower, max(upper, lower), _rms(left, points))


def _weights(
    operator: Operator, points: BoolArray, more: RealArray | float, film_resistance: float
) -> tuple[RealArray, float]:
    """Weights w (nx, ny), zero off the ``points``, and a factor c of r·A⁻¹r <= Σ w r² + c (Σ w r)².

    A = K + D, D the resistance at each point, and the conductors' K is at least its least
    eigenvalue λ times the identity, in periodic conductors but for the uniform flow, which they do
    not resist: A >= λ (1 - 1 1ᵀ/n) + D, whose inverse is w = 1/(λ + D) and c = (λ/n)/(1 - λ Σw/n).
    With λ = 0 that is Dirichlet's principle for the potential Kj. The ``operator`` holds the film
    everywhere, to which ``more`` is added.
    """
    least = max(operator.smallest - film_resistance, 0.0)
    weight: RealArray = np.where(points, 1.0 / (least + film_resistance + more), 0.0)
    if not operator.zero_mean_mode:
        return weight, 0.0
    n = operator.grid.n_points
    left = 1.0 - least * float(weight.sum()) / n
    return weight, least / n / left if left > 0.0 else 0.0
