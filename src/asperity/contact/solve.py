"""The one function in which problem, control, solver and what to keep meet."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Literal

from ..core import require
from ..core.engine import Engine
from ..core.errors import ConvergenceError, InputError
from ..core.progress import Progress
from .assemble import assemble
from .certificate import certify
from .control import Control
from .drive import drive
from .operators import Operator, prepare_operator
from .problem import ContactProblem
from .result import ContactResult
from .solvers.by_name import default_solver
from .solvers.protocol import Solver
from .state import InterfaceState


@dataclass(frozen=True)
class Keep:
    """What to compute beyond the fields: ``stiffness`` costs about one further solve."""

    stiffness: bool = True


def solve(
    problem: ContactProblem,
    control: Control,
    *,
    solver: Solver | None = None,
    state: InterfaceState | None = None,
    keep: Keep = Keep(),
    operator: Operator | None = None,
    progress: Progress | None = None,
    engine: Engine | None = None,
    on_failure: Literal["raise", "return"] = "raise",
) -> ContactResult:
    """Solve a contact problem.

    Parameters
    ----------
    problem
        Surfaces, bodies, boundary, law.
    control
        ``MeanPressure``, ``Force``, ``Approach``, ``MeanGap`` or ``Unloaded``.
    solver
        Method with its tolerance; chosen by ``default_solver`` if not given.
    state
        Result state of an earlier load: its permanent indentation is kept, its pressure is the first guess.
    keep
        What to compute beyond the fields.
    operator
        Prepared operator (``prepare_operator``) of the same problem, to spare the set-up in repeated solves.
    progress
        Receives the error after every iteration.
    engine
        Machine to compute on, such as ``CpuEngine(threads=2)``; the CPU with ASPERITY_THREADS or all cores by default.
    on_failure
        ``"raise"`` a ConvergenceError holding the result, or ``"return"`` it with its status, when not converged.

    Raises
    ------
    NoSolutionError
        If the load exceeds what the pressure cap bears, or the position lies beyond full contact.
    ConvergenceError
        If the solver does not reach its tolerance and ``on_failure`` is ``"raise"``.
    InputError
        If state or operator do not belong to the grid of the problem.
    """
    require.one_of(on_failure, ("raise", "return"), "on_failure")
    if not isinstance(control, Control):
        kinds = "MeanPressure, Force, Approach, MeanGap or Unloaded"
        raise InputError(f"control must be a {kinds}, but is {control!r}. Write for example MeanPressure(50e3).")
    if solver is not None and not hasattr(solver, "step"):
        raise InputError(f"solver must be a method such as ConjugateGradient(), but is {solver!r}. See solver_by_name.")
    method = solver or default_solver(problem)
    ready = operator or prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    _require_same_problem(ready, problem)
    started = time.perf_counter()
    qp, solution = drive(problem, control, method, ready, state, progress)
    seconds = time.perf_counter() - started
    certificate = certify(qp, solution, solver=method.name, tolerance=method.tolerance, wall_time=seconds)
    citation_keys = tuple(sorted({*problem.citation_keys, *method.citation_keys}))
    result = assemble(
        problem,
        control,
        qp,
        solution,
        state=state,
        stiffness=keep.stiffness,
        certificate=certificate,
        citations=citation_keys,
    )
    if on_failure == "raise" and not solution.status.converged:
        raise ConvergenceError(f"{solution.status.message} {solution.status.remedy}", result)
    return result


def _require_same_problem(operator: Operator, problem: ContactProblem) -> None:
    """An operator of another grid, solid or boundary would give a wrong answer without a word."""
    for what, found, wanted in (
        ("grid", operator.grid, problem.grid),
        ("compliance", operator.compliance, problem.compliance),
        ("boundary", operator.boundary, problem.boundary),
    ):
        if found != wanted:
            raise InputError(f"operator must be prepared for the {what} {wanted} of the problem, but is for {found}.")
