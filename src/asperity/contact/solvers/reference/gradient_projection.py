"""Non-negative least squares without a matrix, started by gradient projection (Bemporad & Paggi
2015; spectral steps: Birgin et al. 2000)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ....core.arrays import BoolArray, RealArray
from ...operators.convolution import Operator
from ..on_set import Until, inverse_of_waves, solved_on
from ..protocol import (
    ContactQP,
    FixedMean,
    FixedOffset,
    Iterative,
    SolverState,
    feasible_start,
    level,
    relative_error,
)
from .steepest_descent import descend, levelling_step, shifted_to_load

_NEAR = 1e-3
_MOST_PROJECTIONS = 100
"""Relative error, or number of steps, at which projection has done its work: its pressure is good
early, but its relative error stalls at 1e-7 to 1e-5 on rough surfaces."""

_REDUCTION = 0.05
_MOST_ROUNDS = 60
"""Residual of a linear system over that at its start at which it counts as solved, and conjugate
gradients on it at most: the set will change."""

_HALVINGS = 8
"""Halvings of a step to a new set before one along the projected gradient is taken instead."""


@dataclass(frozen=True, eq=False)
class _Memory:
    """Approximate inverse, step of last resort (Pa/m), spectral step (Pa/m), and whether the start
    is still being made."""

    inverse: Operator
    pixel_step: float
    step: float
    projecting: bool = True


@dataclass(frozen=True)
class GradientProjection(Iterative):
    """Non-negative least squares with the compliance applied by transforms only, for large grids.

    Gradient projection with spectral steps comes near the solution; then the points in contact are
    solved for by conjugate gradients preconditioned with the inverse of the compliance of the
    waves, points whose pressure would leave its bounds are held there, and points that overlap are
    freed. A step that would raise the energy is halved. Memory is some ten fields of the grid.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of steps of both kinds.
    """

    tolerance: float = 1e-8
    max_iterations: int = 2000
    name: ClassVar[str] = "gradient_projection"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bemporad2015", "Bertsekas1976", "Birgin2000")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``."""
        begin = feasible_start(qp, start)
        deflection = qp.operator.apply(begin)
        # the longest wave yields most: no step can be shorter than the one that levels it
        step = 1.0 / qp.operator.largest if qp.operator.largest > 0.0 else 0.0
        memory = _Memory(inverse_of_waves(qp.operator), levelling_step(qp), step)
        return SolverState(begin, deflection, relative_error(qp, begin, deflection), applications=2, memory=memory)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One step along the projected gradient, or one to the solution on a set of points."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        if not memory.projecting:
            return _on_set(qp, state, memory)
        taken = _projected(qp, state, memory)
        if taken is None or taken.error < _NEAR or taken.iterations >= _MOST_PROJECTIONS:
            return replace(taken or _counted(state), memory=replace(memory, projecting=False))
        return taken


def _counted(state: SolverState) -> SolverState:
    """``state`` after a step that led nowhere."""
    return replace(state, iterations=state.iterations + 1, applications=state.applications + 1)


def _made_feasible(qp: ContactQP, trial: RealArray, free: BoolArray) -> RealArray:
    """``trial`` (Pa) with the points ``free`` clipped to the bounds, shifted to carry the load."""
    cap = np.broadcast_to(np.asarray(qp.cap, dtype=float), trial.shape)
    made = trial.copy()
    if isinstance(qp.constraint, FixedOffset):
        made[free] = np.clip(trial[free], 0.0, cap[free])
        return made
    load = qp.constraint.mean_pressure * trial.size - float(trial[~free].sum())
    if load >= 0.0:
        made[free] = shifted_to_load(trial[free], cap[free], load / int(np.count_nonzero(free)))
    return made


def _projected(qp: ContactQP, state: SolverState, memory: _Memory) -> SolverState | None:
    """State at the least energy on the line to the projected gradient step; None if that is no
    descent."""
    p = state.pressure
    gradient = state.deflection - qp.profile
    gradient += qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else -gradient.mean()
    everywhere = np.ones(p.shape, dtype=bool)
    change = _made_feasible(qp, p - memory.step * gradient, everywhere) - p
    response = qp.operator.apply(change)
    slope, curvature = float((gradient * change).sum()), float((change * response).sum())
    if not slope < 0.0:
        return None
    length = min(1.0, -slope / curvature) if curvature > 0.0 else 1.0
    pressure, deflection = p + length * change, state.deflection + length * response
    # the two steps of Barzilai and Borwein in turn
    above, below = ((change**2).sum(), curvature) if state.iterations % 2 else (curvature, (response**2).sum())
    step = float(above / below) if below > 0.0 and above > 0.0 else memory.step
    return SolverState(
        pressure,
        deflection,
        relative_error(qp, pressure, deflection),
        state.iterations + 1,
        state.applications + 1,
        state.extra_pairs,
        memory=replace(memory, step=step),
    )


def _on_set(qp: ContactQP, state: SolverState, memory: _Memory) -> SolverState:
    """State after a step to the solution on the points in contact and those that overlap."""
    p = state.pressure
    r = state.deflection - qp.profile
    gap: RealArray = r - level(qp, p, r)
    free = ((p > 0.0) | (gap < 0.0)) & ((p < qp.cap) | (gap > 0.0))
    if free.any():
        fixed = isinstance(qp.constraint, FixedMean)
        step, rounds = solved_on(
            qp.operator, memory.inverse, gap, free, balanced=fixed, until=Until(_REDUCTION, _MOST_ROUNDS)
        )
        state = replace(
            state,
            applications=state.applications + rounds,
            extra_pairs=state.extra_pairs + rounds + 1,
        )
        for _ in range(_HALVINGS):
            trial = _made_feasible(qp, p + step, free)
            deflection = qp.operator.apply(trial)
            state = replace(state, applications=state.applications + 1)
            change = trial - p
            if float((change * (gap + 0.5 * (deflection - state.deflection))).sum()) < 0.0:
                error = relative_error(qp, trial, deflection)
                return replace(
                    state, pressure=trial, deflection=deflection, error=error, iterations=state.iterations + 1
                )
            step *= 0.5
    taken = descend(qp, state, memory.pixel_step)
    return replace(taken, extra_pairs=state.extra_pairs)
