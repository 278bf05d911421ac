"""Projected steepest descent with a load shift (Stanley & Kato 1997; steps along the projection:
Bertsekas 1976)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ....core.arrays import RealArray
from ..protocol import (
    ContactQP,
    FixedMean,
    FixedOffset,
    Iterative,
    SolverState,
    feasible_start,
    relative_error,
    scaled_to_load,
)

_SUFFICIENT = 1e-4
"""Share of the decrease that the slope promises which a step must reach (Armijo's rule with its
usual constant)."""

_HALVINGS = 40
"""Halvings of a step at most, to 1e-12 of it: any decrease is then hidden by rounding."""


@dataclass(frozen=True)
class SteepestDescent(Iterative):
    """Steepest descent of the complementary energy: clip the pressure to its bounds, shift it to
    carry the load.

    The step is the exact one for the points free to move, halved until the clipped and shifted
    pressure lowers the energy. Historic: iterations grow with the number of points per side,
    several times those of conjugate gradients. When rounding hides any decrease it is flagged as
    stalled.

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

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``."""
        begin = feasible_start(qp, start)
        deflection = qp.operator.apply(begin)
        error = relative_error(qp, begin, deflection)
        return SolverState(begin, deflection, error, applications=2, memory=levelling_step(qp))

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One step along the projected gradient."""
        assert isinstance(state.memory, float)
        return descend(qp, state, state.memory)


def descend(qp: ContactQP, state: SolverState, pixel_step: float) -> SolverState:
    """Next state along the projected gradient, lower in energy; exhausted if rounding hides any
    decrease.

    ``pixel_step`` (Pa/m) is the step of last resort, see ``levelling_step``.
    """
    p, constraint = state.pressure, qp.constraint
    gradient = state.deflection - qp.profile
    if isinstance(constraint, FixedOffset):
        relative = gradient + constraint.offset
    else:
        working = (p > 0.0) & (p < qp.cap)
        relative = gradient - (gradient[working].mean() if working.any() else gradient.mean())
    # the points that can follow the gradient of the energy (m), freed of its mean there under load
    movable = ((p > 0.0) | (relative < 0.0)) & ((p < qp.cap) | (relative > 0.0))
    if isinstance(constraint, FixedMean) and movable.any():
        relative = relative - relative[movable].mean()
    downhill = np.where(movable, relative, 0.0)
    # at fixed load a constant is irrelevant to the energy, but rounding grows with it
    gradient += constraint.offset if isinstance(constraint, FixedOffset) else -gradient.mean()
    curvature = float((downhill * qp.operator.apply(downhill)).sum())
    length = float((downhill**2).sum()) / curvature if curvature > 0.0 else 0.0  # to the least energy along it
    length = length or pixel_step
    applications = state.applications + 1
    for _ in range(_HALVINGS):
        trial: RealArray = p - length * gradient  # then made feasible, with the least sum of squares
        if isinstance(constraint, FixedOffset):
            trial = np.clip(trial, 0.0, qp.cap)
        else:
            mean = constraint.mean_pressure
            trial = scaled_to_load(shifted_to_load(trial, qp.cap, mean), qp.cap, mean)
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
    """Step in Pa/m that levels a single pixel: the largest that can make sense. Costs one
    application.

    Zero where a pixel does not move under its own pressure (a periodic grid of one point).
    """
    impulse = np.zeros_like(qp.profile)
    impulse[0, 0] = 1.0
    compliance = float(qp.operator.apply(impulse)[0, 0])
    return 1.0 / compliance if compliance > 0.0 else 0.0


def shifted_to_load(values: RealArray, cap: float | RealArray, mean: float) -> RealArray:
    """Clip ``values`` (Pa) plus a common shift to [0, cap], with the shift for which the mean is
    ``mean``.

    The load is a piecewise linear, increasing function of the shift; its root is found from the
    sorted kinks.
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
