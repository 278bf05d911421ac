"""THE place for new numerical methods: solvers of the contact problem, all behind one protocol."""

from .conjugate_gradient import ConjugateGradient
from .protocol import ContactQP, FixedMean, FixedOffset, Solution, Solver, SolverState, run

__all__ = [
    "ConjugateGradient",
    "ContactQP",
    "FixedMean",
    "FixedOffset",
    "Solution",
    "Solver",
    "SolverState",
    "run",
]
