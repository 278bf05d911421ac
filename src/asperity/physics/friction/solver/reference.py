"""Two independent methods for the tangential problem of a step, simple and slow, that check the
fast one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ....contact.solvers.protocol import Iterative
from ....core.arrays import RealArray
from .problem import Deviation, Points, Sets, TangentialQP, TangentialSolution, best_shift, ended


class _Iterate:
    """Traction (2, n) with its displacement, slip and deviation from the friction law, on the
    points of a problem."""

    def __init__(self, qp: TangentialQP, start: RealArray | None) -> None:
        self.qp, self.points = qp, Points.of(qp)
        self.total = None if qp.mean_traction is None else np.asarray(qp.mean_traction) * qp.bound.size
        n = len(self.points.index)
        self.pairs = 0.0
        self.q = self.within(np.zeros((2, n)) if start is None else self.points.gathered(start))
        self.refresh()

    def within(self, traction: RealArray) -> RealArray:
        """Nearest feasible traction; at a prescribed mean one that has it."""
        if self.total is None:
            return self.points.projected(traction)
        return self.points.nearest(traction, self.total)

    def product(self, values: RealArray) -> RealArray:
        """C times ``values`` (2, n)."""
        operator = self.qp.operator
        self.pairs += operator.pairs_per_application
        return self.points.gathered(operator.displacement(self.points.scattered(values, self.qp.bound.shape)))

    def refresh(self) -> None:
        """Displacement, slip and deviation of the traction."""
        self.u = self.product(self.q)
        residual = self.points.target - self.u
        self.shift = np.zeros(2) if self.total is None else best_shift(self.points, self.q, residual)
        self.s = residual + self.shift[:, None]
        self.deviation = Deviation.of(self.points, self.q, self.u, self.s)

    @property
    def energy(self) -> float:
        """1/2 q·C q - q·b, up to a factor the same for all."""
        return float(np.einsum("ij,ij->", self.q, 0.5 * self.u - self.points.target))

    def ended(self, tolerance: float, iterations: int) -> TangentialSolution:
        """Solution at this iterate."""
        iterate = self.q, self.s, self.shift
        return ended(self.qp, self.points, iterate, self.deviation, tolerance=tolerance, work=(iterations, self.pairs))


@dataclass(frozen=True)
class AcceleratedGradient(Iterative):
    """Projected gradient with Nesterov's momentum, restarted where it points uphill (Beck &
    Teboulle 2009; O'Donoghue & Candes 2015).

    Parameters
    ----------
    tolerance
        Largest ``Deviation.error``, in (0, 1).
    max_iterations
        Steps at most, one product each.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    tolerance: float = 1e-6
    max_iterations: int = 20000
    name: ClassVar[str] = "accelerated gradient"
    citation_keys: ClassVar[tuple[str, ...]] = ("Beck2009", "ODonoghue2015")

    def solve(self, qp: TangentialQP, start: RealArray | None = None) -> TangentialSolution:
        """Solution of ``qp`` from the traction ``start`` (2, nx, ny) in Pa."""
        at, length, momentum = _Iterate(qp, start), 1.0 / qp.operator.largest, 1.0
        y, s = at.q, at.s
        for count in range(self.max_iterations + 1):
            if at.deviation.error <= self.tolerance or count == self.max_iterations:
                break
            before = at.q
            at.q = at.within(y + length * s)
            following = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * momentum**2))
            ratio, momentum = (momentum - 1.0) / following, following
            if float(np.einsum("ij,ij->", y - at.q, at.q - before)) > 0.0:
                ratio, momentum = 0.0, 1.0
            step = at.q - before
            u = at.u
            at.refresh()
            y, s = at.q + ratio * step, at.s - ratio * (at.u - u)
        return at.ended(self.tolerance, count)


@dataclass(frozen=True)
class ProjectedGradients(Iterative):
    """Conjugate gradients on what sticks, slipping points turning on their circles, begun anew
    whenever the sets change.

    In the manner of Polonsky & Keer (1999) for the normal contact, with discs in place of
    half-lines.

    Parameters
    ----------
    tolerance
        Largest ``Deviation.error``, in (0, 1).
    max_iterations
        Steps at most, two products each.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    tolerance: float = 1e-6
    max_iterations: int = 20000
    name: ClassVar[str] = "projected gradients"
    citation_keys: ClassVar[tuple[str, ...]] = ("Polonsky1999",)

    def solve(self, qp: TangentialQP, start: RealArray | None = None) -> TangentialSolution:
        """Solution of ``qp`` from the traction ``start`` (2, nx, ny) in Pa."""
        at = _Iterate(qp, start)
        direction = previous = np.zeros_like(at.q)
        before: Sets | None = None
        for count in range(self.max_iterations + 1):
            if at.deviation.error <= self.tolerance or count == self.max_iterations:
                break
            sets = Sets.of(at.points, at.q, at.s)
            free = sets.free_part(at.s)
            if at.total is not None:
                sticking = ~sets.slip
                free[:, sticking] -= free.sum(axis=1, keepdims=True) / max(int(sticking.sum()), 1)
            returned = before is not None and bool(np.any(before.slip & ~sets.slip))
            norm = float(np.einsum("ij,ij->", previous, previous))
            ratio = (
                0.0
                if before is None or returned or norm == 0.0
                else float(np.einsum("ij,ij->", free, free - previous)) / norm
            )
            direction, previous, before = free + max(ratio, 0.0) * sets.free_part(direction), free, sets
            response = at.product(direction)
            along = float(np.einsum("ij,ij->", at.s, direction))
            curvature = float(np.einsum("ij,ij->", direction, response)) + float(
                np.sum(
                    np.where(sets.slip, sets.outward / np.where(sets.slip, at.points.bound, 1.0), 0.0) * direction**2
                )
            )
            q, s, energy = at.q, at.s, at.energy
            if curvature > 0.0 and along > 0.0:
                at.q = at.within(q + (along / curvature) * direction)
                at.refresh()
            if at.energy >= energy:
                at.q, at.s, returned = q, s, True
            if returned:
                at.q, before = at.within(at.q + at.s / qp.operator.largest), None
                at.refresh()
        return at.ended(self.tolerance, count)
