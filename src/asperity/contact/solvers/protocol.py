"""The discrete problem every solver solves, the state it iterates on, and the loop around it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.progress import NoProgress, Progress
from ...core.status import Outcome, Status
from ..operators.protocol import Operator


@dataclass(frozen=True)
class FixedMean:
    """The mean pressure (Pa) is prescribed; the offset of the bodies is the multiplier of this constraint."""

    mean_pressure: float


@dataclass(frozen=True)
class FixedOffset:
    """The offset d (m) in gap = d + K p - h is prescribed."""

    offset: float


Constraint: TypeAlias = FixedMean | FixedOffset
"""What fixes the rigid-body position."""


@dataclass(frozen=True, eq=False)
class ContactQP:
    """Minimise p·Kp/2 - p·(h - d) over 0 <= p <= cap, with the mean of p or the offset d fixed (Kalker 1977).

    Parameters
    ----------
    operator
        K, from pressure (Pa) to displacement (m).
    profile
        h, composite heights (nx, ny) in m, float64.
    cap
        Largest pressure in Pa: a number, an (nx, ny) array, or infinity.
    constraint
        ``FixedMean`` or ``FixedOffset``.
    height_scale
        Length in m by which errors are made relative: the rms height of the profile.
    """

    operator: Operator
    profile: RealArray
    cap: float | RealArray
    constraint: Constraint
    height_scale: float

    @property
    def elastic(self) -> bool:
        """Whether there is no cap at all."""
        return not isinstance(self.cap, np.ndarray) and self.cap == np.inf


@dataclass(frozen=True, eq=False)
class SolverState:
    """One iterate, everything needed to continue from it.

    ``pressure`` feasible pressure (Pa), unless a method says that it leaves the bounds on the way; ``deflection`` K·pressure
    (m); ``error`` its relative optimality error (see ``optimality.relative_error``); ``iterations`` and operator
    ``applications`` so far, and ``extra_pairs``, FFT pairs of the size of the grid that went into other work
    (preconditioner, coarser grids); ``exhausted`` when the method cannot improve the iterate; ``memory`` what the method
    carries from step to step; ``engine`` whose arrays pressure and deflection are, None for NumPy arrays.
    """

    pressure: RealArray
    deflection: RealArray
    error: float
    iterations: int = 0
    applications: int = 0
    extra_pairs: float = 0.0
    exhausted: bool = False
    memory: object = None
    engine: Engine | None = None

    @property
    def finished(self) -> SolverState:
        """The same as NumPy arrays, without the buffers of the method."""
        if self.engine is None:
            return replace(self, memory=None)
        pressure, deflection = self.engine.numpy(self.pressure), self.engine.numpy(self.deflection)
        return replace(self, pressure=pressure, deflection=deflection, memory=None, engine=None)


class Solver(Protocol):
    """A method; a frozen value holding only its settings."""

    @property
    def name(self) -> str:
        """Name in reports and documents."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method."""

    @property
    def tolerance(self) -> float:
        """Relative error at which to stop."""

    @property
    def max_iterations(self) -> int:
        """Number of steps after which to give up."""

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at the pressure ``start`` (Pa), made feasible, or at a first guess of the method; ``start`` is not changed."""

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """Next state (a direct method solves the whole problem in one step).

        ``state`` is left unchanged, but a method may go on in its arrays, and must say so.
        """


def require_settings(solver: Solver) -> None:
    """Check tolerance (in (0, 1)) and iteration limit (whole, >= 1) of ``solver``; InputError names the wrong one."""
    require.between(solver.tolerance, 0.0, 1.0, f"tolerance of the solver {solver.name}")
    require.integer(solver.max_iterations, 1, f"iteration limit of the solver {solver.name}")


@dataclass(frozen=True, eq=False)
class Solution:
    """Last state of a solver and how it ended; ``errors`` holds the relative error after every iteration."""

    state: SolverState
    status: Status
    errors: tuple[float, ...]


PATIENCE = 500
LEAST_PATIENCE = 20
"""Iterations without a smaller error after which a method counts as stagnated: a quarter of its limit, within these."""

_SMALLER = 0.99
"""Share of the smallest error so far below which one counts as smaller: near rounding, last digits go on falling."""


def run(solver: Solver, qp: ContactQP, start: RealArray | None = None, progress: Progress | None = None) -> Solution:
    """Iterate ``solver`` from the pressure ``start`` (Pa), if there is one, until it converges, stagnates or gives up."""
    report = progress or NoProgress()
    state = solver.init(qp, start)
    errors = [state.error]
    best_at = 0
    patience = min(PATIENCE, max(LEAST_PATIENCE, solver.max_iterations // 4))
    while True:
        report.update(state.iterations, state.error, solver.tolerance)
        stagnated = state.exhausted or len(errors) - 1 - best_at >= patience
        if state.error <= solver.tolerance or stagnated or state.iterations >= solver.max_iterations:
            return Solution(state.finished, _status(solver, state, stagnated), tuple(errors))
        state = solver.step(qp, state)
        errors.append(state.error)
        if state.error < _SMALLER * errors[best_at]:
            best_at = len(errors) - 1


def _status(solver: Solver, state: SolverState, stagnated: bool) -> Status:
    if state.error <= solver.tolerance:
        text = f"Converged: relative error {state.error:.2e} by {solver.name}, tolerance {solver.tolerance:.0e}."
        return Status(Outcome.CONVERGED, text)
    reached = f"relative error {state.error:.2e} after {state.iterations} iterations of {solver.name}"
    if stagnated:
        remedy = "Try another solver (conjugate_gradient is the most robust) or a tolerance the arithmetic can reach."
        return Status(Outcome.STAGNATED, f"Stagnated above the tolerance {solver.tolerance:.0e}: {reached}.", remedy)
    remedy = f"Raise max_iterations above {solver.max_iterations} or loosen the tolerance."
    return Status(
        Outcome.ITERATION_LIMIT, f"Iteration limit before the tolerance {solver.tolerance:.0e}: {reached}.", remedy
    )
