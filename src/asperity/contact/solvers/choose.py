"""Which method solves a problem best."""

from __future__ import annotations

from ..problem import ContactProblem
from .active_set import ActiveSet
from .protocol import Solver


def default_solver(problem: ContactProblem) -> Solver:
    """Method for ``problem``: the inexact active set, which handles every boundary, control, cap and size."""
    return ActiveSet()
