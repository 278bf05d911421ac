"""Which method solves a problem best."""

from __future__ import annotations

from ..problem import ContactProblem
from .conjugate_gradient import ConjugateGradient
from .protocol import Solver


def default_solver(problem: ContactProblem) -> Solver:
    """Method for ``problem``: constrained conjugate gradients, which handle every boundary, control and cap."""
    return ConjugateGradient()
