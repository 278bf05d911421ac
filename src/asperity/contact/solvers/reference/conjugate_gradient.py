"""Constrained conjugate gradients (Polonsky & Keer 1999; prescribed approach: Nogi & Kato 1997;
pressure cap added)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ....core.arrays import RealArray
from ..protocol import (
    ContactQP,
    FixedMean,
    FixedOffset,
    Iterative,
    SolverState,
    energy,
    feasible_start,
    relative_error,
    scaled_to_load,
)
from .steepest_descent import descend, levelling_step

_ROUNDING = 1e-13
"""Relative rise of the energy that counts as none: the rounding of sums over some 10⁵ points."""


@dataclass(frozen=True, eq=False)
class _Memory:
    """Search direction, squared norm of the last residual, whether they are still good, and the
    levelling step."""

    direction: RealArray
    norm: float
    conjugate: bool
    pixel_step: float


@dataclass(frozen=True)
class ConjugateGradient(Iterative):
    """Conjugate gradients on the points strictly between the bounds; the field's workhorse.

    The method of the sources for elastic contact. Far into plasticity its corrections of points at
    the bounds overshoot; a step that raises the energy is therefore replaced by one along the
    projected gradient.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of iterations; their number grows with the square root of the points per
        side.
    """

    tolerance: float = 1e-7
    max_iterations: int = 5000
    name: ClassVar[str] = "conjugate_gradient"
    citation_keys: ClassVar[tuple[str, ...]] = ("Nogi1997", "Polonsky1999")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, steepest descent first."""
        begin = feasible_start(qp, start)
        deflection = qp.operator.apply(begin)
        memory = _Memory(np.zeros_like(begin), 1.0, conjugate=False, pixel_step=levelling_step(qp))
        return SolverState(begin, deflection, relative_error(qp, begin, deflection), applications=2, memory=memory)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One constrained conjugate-gradient step, or one of steepest descent where that would
        raise the energy."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        # Polonsky & Keer (1999), steps 1-8; the pressures leaving and entering the bounds treated
        # alike at both
        p = state.pressure
        working = (p > 0.0) & (p < qp.cap)
        gap: RealArray = state.deflection - qp.profile  # under load relative to its mean over the working points
        if isinstance(qp.constraint, FixedOffset):
            gap = gap + qp.constraint.offset
        else:
            gap = gap - (gap[working].mean() if working.any() else gap.mean())
        norm = float((gap[working] ** 2).sum())
        ratio = norm / memory.norm if memory.conjugate else 0.0
        direction = np.where(working, gap + ratio * memory.direction, 0.0)
        response = qp.operator.apply(direction)
        # pressure per gap (Pa/m) that minimises the energy along the direction
        centred = isinstance(qp.constraint, FixedMean) and working.any()
        along = response - response[working].mean() if centred else response
        curvature = float((along[working] * direction[working]).sum())
        length = float((gap[working] * direction[working]).sum()) / curvature if curvature > 0.0 else 0.0
        length = length or memory.pixel_step

        trial: RealArray = p - length * direction
        bounded: RealArray = np.clip(trial, 0.0, qp.cap)
        entering = (bounded == 0.0) & (gap < 0.0) | (bounded == qp.cap) & (gap > 0.0)
        clipped = bool((bounded != trial).any())
        re_entered = bool(entering.any())
        if re_entered:
            bounded[entering] -= length * gap[entering]
            bounded = np.clip(bounded, 0.0, qp.cap)
        if isinstance(qp.constraint, FixedMean):
            bounded = scaled_to_load(bounded, qp.cap, qp.constraint.mean_pressure)

        linear = not (clipped or re_entered) and (qp.elastic or isinstance(qp.constraint, FixedOffset))
        if linear:  # a combination and a common factor: no need to apply the operator again
            factor = bounded.sum() / trial.sum() if isinstance(qp.constraint, FixedMean) else 1.0
            deflection = factor * (state.deflection - length * response)
        else:
            deflection = qp.operator.apply(bounded)
        taken = SolverState(
            bounded,
            deflection,
            relative_error(qp, bounded, deflection),
            state.iterations + 1,
            state.applications + (1 if linear else 2),
            memory=replace(memory, direction=direction, norm=norm, conjugate=not re_entered),
        )
        before, after = energy(qp, state.pressure, state.deflection), energy(qp, taken.pressure, taken.deflection)
        if after <= before + _ROUNDING * abs(before):
            return taken
        lower = descend(qp, state, memory.pixel_step)
        applications = lower.applications + taken.applications - state.applications
        if lower.exhausted:  # no decrease above rounding in either: the conjugate step is as good
            return replace(taken, applications=applications)
        return replace(lower, applications=applications, memory=replace(memory, conjugate=False))
