"""THE place for new numerical methods: solvers of the contact problem, all behind one protocol."""

from .active_set import ActiveSet
from .by_name import SOLVERS, solver_by_name
from .conjugate_gradient import ConjugateGradient
from .dense import DenseActiveSet
from .lemke import Lemke
from .nnls import NonNegativeLeastSquares
from .protocol import ContactQP, FixedMean, FixedOffset, Solution, Solver, SolverState, run
from .quasi_newton import QuasiNewton
from .steepest_descent import SteepestDescent

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
