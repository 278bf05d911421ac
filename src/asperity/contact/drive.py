"""From a control to a constraint of the discrete problem, and to its solution."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError, NoSolutionError
from ..core.progress import Progress
from .control import Approach, Control, Force, MeanGap, MeanPressure, mean_pressure
from .load_search import LoadSearch, Solved, contact_level, mean_gap, solve_at_load
from .operators import Operator
from .problem import ContactProblem
from .solvers.protocol import ContactQP, FixedOffset, Solver, run
from .state import InterfaceState


def drive(
    problem: ContactProblem,
    control: Control,
    solver: Solver,
    operator: Operator,
    state: InterfaceState | None,
    progress: Progress | None,
) -> Solved:
    """Pose the discrete problem that ``control`` asks for, starting from ``state``, and solve it."""
    virgin = problem.profile()
    scale = _height_scale(virgin, control, operator)
    posed = ContactQP(operator, indented(virgin, state), problem.law.pressure_cap(), FixedOffset(0.0), scale)
    start = None if state is None else state.pressure
    if isinstance(control, MeanPressure | Force):
        return solve_at_load(posed, mean_pressure(control, problem.grid), solver, start, progress)
    top = float(virgin.max())
    if isinstance(control, Approach):
        _require_below_full_contact(posed, top, control.value)
        if not operator.zero_mean_mode:
            qp = replace(posed, constraint=FixedOffset(top - control.value))
            return qp, run(solver, qp, start, progress)
        search = LoadSearch(posed, solver, progress, start)
        return search.find(lambda qp, solution: top + contact_level(qp, solution), control.value)
    _require_touching(posed, control.value)
    search = LoadSearch(posed, solver, progress, start)
    return search.find(lambda qp, solution: -mean_gap(qp, solution), -control.value)


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
    uniform = np.full(virgin.shape, mean_pressure(control, operator.grid))
    return float(np.abs(operator.apply(uniform)).max()) or 1.0


def _require_below_full_contact(qp: ContactQP, top: float, approach: float) -> None:
    """Beyond full contact a periodic elastic half-space would carry any pressure: its mean gap cannot be negative."""
    largest = top - float(qp.profile.mean())
    if qp.elastic and qp.operator.zero_mean_mode and approach >= largest:
        raise NoSolutionError(
            f"approach must be less than {largest:.6g} m, where a periodic elastic contact is full and its mean gap zero, "
            f"but is {approach:.6g} m. Prescribe MeanPressure(...) to go beyond full contact."
        )


def _require_touching(qp: ContactQP, gap: float) -> None:
    first_touch = float(qp.profile.max() - qp.profile.mean())
    if gap >= first_touch:
        raise NoSolutionError(
            f"mean gap must be less than {first_touch:.6g} m, the mean gap at first touch, but is {gap:.6g} m."
        )
