"""Constrained conjugate gradients (Polonsky & Keer 1999; prescribed approach: Nogi & Kato 1997; pressure cap added)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from .feasible import scaled_to_load
from .optimality import relative_error
from .protocol import ContactQP, FixedMean, FixedOffset, SolverState


@dataclass(frozen=True, eq=False)
class _Memory:
    """Search direction, squared norm of the last residual, and whether the direction is still conjugate."""

    direction: RealArray
    norm: float
    conjugate: bool


@dataclass(frozen=True)
class ConjugateGradient:
    """Conjugate gradients on the points strictly between the bounds; the field's workhorse.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of iterations; their number grows with the square root of the points per side.
    """

    tolerance: float = 1e-7
    max_iterations: int = 5000
    name: ClassVar[str] = "conjugate_gradient"
    citation_keys: ClassVar[tuple[str, ...]] = ("Nogi1997", "Polonsky1999")

    def init(self, qp: ContactQP, start: RealArray) -> SolverState:
        """State at ``start``, steepest descent first."""
        deflection = qp.operator.apply(start)
        memory = _Memory(np.zeros_like(start), 1.0, conjugate=False)
        return SolverState(start, deflection, relative_error(qp, start, deflection), applications=1, memory=memory)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One constrained conjugate-gradient step."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        p = state.pressure
        working = (p > 0.0) & (p < qp.cap)
        gap = _gap(qp, state, working)
        norm = float((gap[working] ** 2).sum())
        ratio = norm / memory.norm if memory.conjugate else 0.0
        direction = np.where(working, gap + ratio * memory.direction, 0.0)
        response = qp.operator.apply(direction)
        length = _step_length(qp, gap, direction, response, working)

        trial = p - length * direction
        bounded = np.clip(trial, 0.0, qp.cap)
        entering = (bounded == 0.0) & (gap < 0.0) | (bounded == qp.cap) & (gap > 0.0)
        clipped = bool((bounded != trial).any())
        re_entered = bool(entering.any())
        if re_entered:
            bounded[entering] -= length * gap[entering]
            np.clip(bounded, 0.0, qp.cap, out=bounded)

        fixed_mean = isinstance(qp.constraint, FixedMean)
        if fixed_mean:
            bounded = scaled_to_load(bounded, qp.cap, qp.constraint.mean_pressure)
        applications = state.applications + 1
        if clipped or re_entered or (fixed_mean and not qp.elastic):
            deflection = qp.operator.apply(bounded)
            applications += 1
        else:  # nothing but a linear combination and a common factor: no need to apply the operator again
            factor = bounded.sum() / trial.sum() if fixed_mean else 1.0
            deflection = factor * (state.deflection - length * response)
        return SolverState(
            bounded,
            deflection,
            relative_error(qp, bounded, deflection),
            state.iterations + 1,
            applications,
            memory=_Memory(direction, norm, conjugate=not re_entered),
        )


def _gap(qp: ContactQP, state: SolverState, working: RealArray) -> RealArray:
    """Gap (m): negative of the energy gradient's driving part, with zero mean over the working points under load."""
    r = state.deflection - qp.profile
    if isinstance(qp.constraint, FixedOffset):
        return r + qp.constraint.offset
    return r - (r[working].mean() if working.any() else r.mean())


def _step_length(qp: ContactQP, gap: RealArray, direction: RealArray, response: RealArray, working: RealArray) -> float:
    if isinstance(qp.constraint, FixedMean) and working.any():
        response = response - response[working].mean()
    curvature = float((response[working] * direction[working]).sum())
    if curvature > 0.0:
        return float((gap[working] * direction[working]).sum()) / curvature
    # nothing between the bounds: the step that levels one pixel, from the stiffest response of the operator
    impulse = np.zeros_like(gap)
    impulse[0, 0] = 1.0
    return 1.0 / float(qp.operator.apply(impulse)[0, 0])
