"""Projected steepest descent with a load shift (Stanley & Kato 1997; steps along the projection: Bertsekas 1976)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ....core.arrays import RealArray
from ..protocol import (
    ContactQP,
    FixedMean,
    FixedOffset,
    SolverState,
    feasible_start,
    relative_error,
    require_settings,
    scaled_to_load,
)

_SUFFICIENT = 1e-4
"""Share of the decrease that the slope promises which a step must reach (Armijo's rule with its usual constant)."""

_HALVINGS = 40
"""Halvings of a step at most, to 1e-12 of it: any decrease is then hidden by rounding."""


@dataclass(frozen=True, eq=False)
class _Memory:
    """Step of last resort in Pa/m: the one that levels a single pixel."""

    pixel_step: float


@dataclass(frozen=True)
class SteepestDescent:
    """Steepest descent of the complementary energy: clip the pressure to its bounds, shift it to carry the load.

    The step is the exact one for the points free to move, halved until the clipped and shifted pressure lowers the
    energy. Historic: iterations grow with the number of points per side, several times those of conjugate gradients.
    When rounding hides any decrease it is flagged as stalled.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of iterations.
    """

    tolerance: float = 1e-6
    max_iterations: int = 20000
    name: ClassVar[str] = "steepest_descent"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bertsekas1976", "Stanley1997")

    def __post_init__(self) -> None:
        require_settings(self)

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``."""
        begin = feasible_start(qp, start)
        deflection = qp.operator.apply(begin)
        memory = _Memory(levelling_step(qp))
        return SolverState(begin, deflection, relative_error(qp, begin, deflection), applications=2, memory=memory)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One step along the projected gradient."""
        assert isinstance(state.memory, _Memory)
        return descend(qp, state, state.memory.pixel_step)


def descend(qp: ContactQP, state: SolverState, pixel_step: float) -> SolverState:
    """Next state along the projected gradient, lower in energy; exhausted if rounding hides any decrease.

    ``pixel_step`` (Pa/m) is the step of last resort, see ``levelling_step``.
    """
    p = state.pressure
    gradient = state.deflection - qp.profile
    downhill = _free_gradient(qp, p, gradient)
    # at fixed load a constant is irrelevant to the energy, but rounding grows with it
    gradient += qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else -gradient.mean()
    length = _exact_length(qp, downhill) or pixel_step
    applications = state.applications + 1
    for _ in range(_HALVINGS):
        trial = _projected(qp, p - length * gradient)
        deflection = qp.operator.apply(trial)
        applications += 1
        change = trial - p
        slope = float((gradient * change).sum())
        decrease = -slope - 0.5 * float((change * (deflection - state.deflection)).sum())
        if slope < 0.0 and decrease >= -_SUFFICIENT * slope:
            error = relative_error(qp, trial, deflection)
            return SolverState(trial, deflection, error, state.iterations + 1, applications, memory=state.memory)
        length *= 0.5
    return SolverState(
        p,
        state.deflection,
        state.error,
        state.iterations + 1,
        applications,
        exhausted=True,
        memory=state.memory,
    )


def levelling_step(qp: ContactQP) -> float:
    """Step in Pa/m that levels a single pixel: the largest that can make sense. Costs one application.

    Zero where a pixel does not move under its own pressure (a periodic grid of one point).
    """
    impulse = np.zeros_like(qp.profile)
    impulse[0, 0] = 1.0
    compliance = float(qp.operator.apply(impulse)[0, 0])
    return 1.0 / compliance if compliance > 0.0 else 0.0


def _free_gradient(qp: ContactQP, pressure: RealArray, gradient: RealArray) -> RealArray:
    """Energy gradient (m) on the points that can follow it, freed of its mean there under load; zero elsewhere."""
    if isinstance(qp.constraint, FixedOffset):
        relative = gradient + qp.constraint.offset
    else:
        working = (pressure > 0.0) & (pressure < qp.cap)
        relative = gradient - (gradient[working].mean() if working.any() else gradient.mean())
    movable = ((pressure > 0.0) | (relative < 0.0)) & ((pressure < qp.cap) | (relative > 0.0))
    if isinstance(qp.constraint, FixedMean) and movable.any():
        relative = relative - relative[movable].mean()
    return np.where(movable, relative, 0.0)


def _exact_length(qp: ContactQP, downhill: RealArray) -> float:
    """Step in Pa/m to the least energy along ``downhill``; 0 where the energy has no curvature along it."""
    curvature = float((downhill * qp.operator.apply(downhill)).sum())
    return float((downhill**2).sum()) / curvature if curvature > 0.0 else 0.0


def _projected(qp: ContactQP, values: RealArray) -> RealArray:
    """Feasible pressure (Pa) nearest to ``values`` in the sum of squares."""
    if isinstance(qp.constraint, FixedOffset):
        return np.clip(values, 0.0, qp.cap)
    mean = qp.constraint.mean_pressure
    return scaled_to_load(shifted_to_load(values, qp.cap, mean), qp.cap, mean)


def shifted_to_load(values: RealArray, cap: float | RealArray, mean: float) -> RealArray:
    """Clip ``values`` (Pa) plus a common shift to [0, cap], with the shift for which the mean is ``mean``.

    The load is a piecewise linear, increasing function of the shift; its root is found from the sorted kinks.
    """
    flat = values.ravel()
    upper = np.broadcast_to(np.asarray(cap, dtype=float), values.shape).ravel() - flat
    bounded = np.isfinite(upper)
    kinks = np.concatenate([-flat, upper[bounded]])
    slopes = np.concatenate([np.ones(flat.size), -np.ones(int(bounded.sum()))])
    order = np.argsort(kinks)
    kinks, slopes = kinks[order], slopes[order].cumsum()
    loads = np.concatenate([[0.0], np.cumsum(slopes[:-1] * np.diff(kinks))])
    target = mean * flat.size
    piece = min(int(np.searchsorted(loads, target, side="right")) - 1, kinks.size - 1)
    shift = kinks[piece] + ((target - loads[piece]) / slopes[piece] if slopes[piece] > 0.0 else 0.0)
    return np.asarray(np.clip(values + shift, 0.0, cap))
