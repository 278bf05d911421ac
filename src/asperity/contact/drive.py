"""From a control to a constraint of the discrete problem, and to its solution."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError, NoSolutionError
from ..core.progress import Progress
from .control import Approach, Control, Force, MeanGap, MeanPressure
from .operators import Operator
from .problem import ContactProblem
from .solvers.feasible import scaled_to_load
from .solvers.protocol import ContactQP, FixedMean, FixedOffset, Solution, Solver, run
from .state import InterfaceState


def drive(
    problem: ContactProblem,
    control: Control,
    solver: Solver,
    operator: Operator,
    state: InterfaceState | None,
    progress: Progress | None,
) -> tuple[ContactQP, Solution]:
    """Pose the discrete problem that ``control`` asks for, starting from ``state``, and solve it."""
    virgin = problem.profile()
    scale = _height_scale(virgin, control, operator)
    posed = ContactQP(operator, indented(virgin, state), problem.law.pressure_cap(), FixedOffset(0.0), scale)
    start = None if state is None else state.pressure
    if isinstance(control, MeanPressure | Force):
        mean = control.value if isinstance(control, MeanPressure) else control.value / problem.grid.area
        qp = replace(posed, constraint=FixedMean(mean))
        return qp, run(solver, qp, _start_at_load(qp, mean, start), progress)
    if isinstance(control, Approach):
        qp = replace(posed, constraint=FixedOffset(float(virgin.max()) - control.value))
        _require_below_full_contact(qp, float(virgin.max()))
        return qp, run(solver, qp, _start_at_offset(qp, start), progress)
    if isinstance(control, MeanGap):
        return _at_mean_gap(posed, control.value, solver, start, progress)
    raise InputError(f"control must be MeanPressure, Force, Approach or MeanGap, but is {type(control).__name__}.")


def indented(virgin: RealArray, state: InterfaceState | None) -> RealArray:
    """Profile (nx, ny) in m after the permanent indentation of ``state``.

    Raises
    ------
    InputError
        If the state belongs to another grid.
    """
    if state is None:
        return virgin
    for values, what in ((state.permanent_indentation, "permanent indentation"), (state.pressure, "pressure")):
        if values.shape != virgin.shape:
            raise InputError(
                f"{what} of the state must have the shape {virgin.shape} of the grid, but has {values.shape}."
            )
    return virgin - state.permanent_indentation


def _height_scale(virgin: RealArray, control: Control, operator: Operator) -> float:
    """Rms height (m); for flat bodies the length by which they deform, for there is no other."""
    rms = float(virgin.std())
    if rms > 0.0:
        return rms
    if isinstance(control, Approach | MeanGap):
        return control.value
    mean = control.value if isinstance(control, MeanPressure) else control.value / operator.grid.area
    return float(np.abs(operator.apply(np.full(virgin.shape, mean))).max()) or 1.0


def _start_at_load(qp: ContactQP, mean: float, start: RealArray | None) -> RealArray:
    bearable = float(np.mean(qp.cap))
    if mean > bearable:
        raise NoSolutionError(
            f"mean pressure must be at most the mean hardness {bearable:.6g} Pa (force: hardness times nominal area), "
            f"but is {mean:.6g} Pa. Lower the load or raise the hardness."
        )
    guess = np.full(qp.profile.shape, mean) if start is None or not start.any() else np.maximum(start, 0.0)
    return scaled_to_load(guess, qp.cap, mean)


def _start_at_offset(qp: ContactQP, start: RealArray | None) -> RealArray:
    if start is not None and start.any():
        clipped: RealArray = np.clip(start, 0.0, qp.cap)
        return clipped
    assert isinstance(qp.constraint, FixedOffset)
    overlap = np.maximum(qp.profile - qp.constraint.offset, 0.0)
    response = float((overlap * qp.operator.apply(overlap)).sum())
    factor = float((overlap**2).sum()) / response if response > 0.0 else 0.0
    bounded: RealArray = np.clip(factor * overlap, 0.0, qp.cap)
    return bounded


def _require_below_full_contact(qp: ContactQP, top: float) -> None:
    """Beyond full contact a periodic elastic half-space would carry any pressure: its mean gap cannot be negative."""
    if not (qp.elastic and qp.operator.zero_mean_mode):
        return
    assert isinstance(qp.constraint, FixedOffset)
    largest = top - float(qp.profile.mean())
    if top - qp.constraint.offset >= largest:
        raise NoSolutionError(
            f"approach must be less than {largest:.6g} m, where a periodic elastic contact is full and its mean gap zero, "
            f"but is {top - qp.constraint.offset:.6g} m. Prescribe MeanPressure(...) to go beyond full contact."
        )


@dataclass
class _Trials:
    """Solutions at trial offsets, each started from the one before."""

    posed: ContactQP
    solver: Solver
    start: RealArray | None
    progress: Progress | None
    last: list[tuple[ContactQP, Solution]] = field(default_factory=list)

    def mean_gap(self, offset: float) -> float:
        qp = replace(self.posed, constraint=FixedOffset(offset))
        start = self.last[-1][1].state.pressure if self.last else self.start
        solution = run(self.solver, qp, _start_at_offset(qp, start), self.progress)
        self.last[:] = [(qp, solution)]
        return float(np.maximum(offset + solution.state.deflection - qp.profile, 0.0).mean())


def _at_mean_gap(
    posed: ContactQP, target: float, solver: Solver, start: RealArray | None, progress: Progress | None
) -> tuple[ContactQP, Solution]:
    from scipy.optimize import brentq

    mean, top = float(posed.profile.mean()), float(posed.profile.max())
    if target >= top - mean:
        raise NoSolutionError(
            f"mean gap must be less than {top - mean:.6g} m, the mean gap at first touch, but is {target:.6g} m."
        )
    trials = _Trials(posed, solver, start, progress)
    high = mean + target  # the mean displacement is never negative, so here the mean gap is at least the target
    if trials.mean_gap(high) - target > 1e-12 * target:
        step = top - mean - target
        low = high - step
        while trials.mean_gap(low) > target:
            step *= 2.0
            low -= step
        brentq(lambda offset: trials.mean_gap(offset) - target, low, high, xtol=1e-10 * target, rtol=1e-12)
    return trials.last[-1]
