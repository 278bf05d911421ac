"""The methods by the names that documents and the command line use."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, TypeAlias

from ...core import require
from ...core.errors import InputError
from .active_set.solver import ActiveSet
from .protocol import Solver
from .reference.conjugate_gradient import ConjugateGradient
from .reference.dense import DenseActiveSet, Lemke
from .reference.gradient_projection import GradientProjection
from .reference.nnls import NonNegativeLeastSquares
from .reference.nogi_kato import NogiKato
from .reference.quasi_newton import QuasiNewton
from .reference.steepest_descent import SteepestDescent

SolverClass: TypeAlias = Callable[..., Solver]
"""Makes a solver from the optional keywords ``tolerance`` and ``max_iterations``."""

SOLVERS: Mapping[str, SolverClass] = MappingProxyType(
    {
        cls.name: cls
        for cls in (
            ActiveSet,
            ConjugateGradient,
            NogiKato,
            SteepestDescent,
            QuasiNewton,
            NonNegativeLeastSquares,
            GradientProjection,
            DenseActiveSet,
            Lemke,
        )
    }
)
"""Class of every method by its name."""


def solver_by_name(
    name: str, tolerance: float | None = None, max_iterations: int | None = None, *, precision: str | None = None
) -> Solver:
    """Method called ``name``, with its own defaults for what is not given.

    Raises
    ------
    InputError
        If no method has this name, the tolerance is not positive, the limit not a whole number >=
        1, or the ``precision`` none of those of active_set, the only method with a choice.
    """
    make = SOLVERS[require.one_of(name, SOLVERS, "solver")]
    settings: dict[str, Any] = {}
    if tolerance is not None:
        settings["tolerance"] = tolerance
    if max_iterations is not None:
        settings["max_iterations"] = max_iterations
    if precision is not None:
        if name != ActiveSet.name:
            raise InputError(
                f"precision must not be given for the solver {name}, which has double precision only, but is "
                f"{precision!r}. Leave it out or choose active_set."
            )
        settings["precision"] = precision
    return make(**settings)
