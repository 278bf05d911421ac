from .contact.couplings.driver import CouplingCheck, Rounds
from .contact.operators import prepare_operator
from .contact.solvers.active_set.solver import ActiveSet
from .contact.solvers.by_name import SOLVERS, solver_by_name
from .contact.solvers.protocol import ContactQP, FixedMean, FixedOffset, Solution, Solver, SolverState, run
from .contact.solvers.reference.conjugate_gradient import ConjugateGradient
from .contact.solvers.reference.dense import DenseActiveSet, Lemke
from .contact.solvers.reference.gradient_projection import GradientProjection
from .contact.solvers.reference.nnls import NonNegativeLeastSquares
from .contact.solvers.reference.nogi_kato import NogiKato
from .contact.solvers.reference.quasi_newton import QuasiNewton
from .contact.solvers.reference.steepest_descent import SteepestDescent
from .contact.state import InterfaceState

__all__ = [
    "SOLVERS",
    "ActiveSet",
    "ConjugateGradient",
    "ContactQP",
    "CouplingCheck",
    "DenseActiveSet",
    "FixedMean",
    "FixedOffset",
    "GradientProjection",
    "InterfaceState",
    "Lemke",
    "NogiKato",
    "NonNegativeLeastSquares",
    "QuasiNewton",
    "Rounds",
    "Solution",
    "Solver",
    "SolverState",
    "SteepestDescent",
    "prepare_operator",
    "run",
    "solver_by_name",
]
