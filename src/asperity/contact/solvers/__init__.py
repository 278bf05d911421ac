"""THE place for new numerical methods: solvers of the contact problem, all behind one protocol."""

from .active_set.solver import ActiveSet
from .by_name import SOLVERS, solver_by_name
from .protocol import ContactQP, FixedMean, FixedOffset, Solution, Solver, SolverState, run
from .reference.conjugate_gradient import ConjugateGradient
from .reference.dense import DenseActiveSet, Lemke
from .reference.nnls import NonNegativeLeastSquares
from .reference.quasi_newton import QuasiNewton
from .reference.steepest_descent import SteepestDescent

__all__ = [
    "SOLVERS",
    "ActiveSet",
    "ConjugateGradient",
    "ContactQP",
    "DenseActiveSet",
    "FixedMean",
    "FixedOffset",
    "Lemke",
    "NonNegativeLeastSquares",
    "QuasiNewton",
    "Solution",
    "Solver",
    "SolverState",
    "SteepestDescent",
    "run",
    "solver_by_name",
]
