"""From a control to a constraint of the discrete problem, and to its solution."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError, NoSolutionError
from ..core.progress import Progress
from ..core.status import Outcome, Status
from .control import Approach, Control, Force, MeanGap, MeanPressure, Unloaded, mean_pressure
from .depth_limit import at_reached_depth
from .laws import LimitByDepth
from .load_search import LoadSearch, Solved, contact_level, mean_gap, solve_at_load
from .operators import Operator
from .problem import ContactProblem
from .solvers.protocol import ContactQP, FixedOffset, Solution, Solver, SolverState, run
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
    profile = indented(virgin, state)
    if isinstance(control, Unloaded):
        return _unloaded(operator, profile, scale)
    before = np.zeros_like(profile) if state is None else state.permanent_indentation
    start = None if state is None or not state.pressure.any() else state.pressure

    def at_cap(cap: float | RealArray, start: RealArray | None) -> Solved:
        posed = ContactQP(operator, profile, cap, FixedOffset(0.0), scale)
        return _controlled(problem, control, posed, solver, start, progress)

    if isinstance(problem.law, LimitByDepth):
        return at_reached_depth(problem.law, before, start, at_cap)
    return at_cap(problem.law.pressure_cap(), start)


def _unloaded(operator: Operator, profile: RealArray, scale: float) -> Solved:
    """The bodies touch at the highest point; nothing is to be solved."""
    none = np.zeros_like(profile)
    qp = ContactQP(operator, profile, np.inf, FixedOffset(float(profile.max())), scale)
    return qp, Solution(SolverState(none, none, 0.0), Status(Outcome.CONVERGED, "Unloaded: nothing to solve."), (0.0,))


def _controlled(
    problem: ContactProblem,
    control: MeanPressure | Force | Approach | MeanGap,
    posed: ContactQP,
    solver: Solver,
    start: RealArray | None,
    progress: Progress | None,
) -> Solved:
    """Solve ``posed`` with the load or position that ``control`` prescribes."""
    if isinstance(control, MeanPressure | Force):
        return solve_at_load(posed, mean_pressure(control, problem.grid), solver, start, progress)
    top = float(problem.profile().max())
    if isinstance(control, Approach):
        _require_below_full_contact(posed, top, control.value)
        if not posed.operator.zero_mean_mode:
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
    if isinstance(control, Unloaded):
        return 1.0
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
