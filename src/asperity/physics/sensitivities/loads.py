"""Contacts at several loads about that of a result, from which area, stiffness and conductance
have their derivatives."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ...contact.controls import MeanPressure
from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.active_set.solver import ActiveSet
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.errors import InputError
from .answer import SensitivityCertificate
from .one_load import AGAIN, require_differentiable
from .system import Held

REACH = 0.15
"""Relative change of the load up to which others are solved. The secant of the compliance errs by
0.2 % of a sphere and by 0.8 % of a contact whose load grows exponentially."""

MANY = 8
"""Loads at which the area, or the flow through layered conductors, is found."""

ENDS = (-1.0, 1.0)
"""Shares of the largest change of the load for a secant."""

EVENLY = tuple(((np.arange(MANY) + 0.5) / MANY * 2.0 - 1.0).tolist())
"""The same for a straight line through several."""


def require_moving_edge(result: ContactResult, name: str, held: Held | None) -> None:
    """Refuse contacts whose edge does not move with the load, or not by elasticity alone, with an
    ``InputError``; ``name`` of what is differentiated."""
    require_differentiable(result)
    if held == "approach":
        raise InputError(f"held of sensitivities must be load for {name}, but is approach.")
    if result.plastic.any():
        raise InputError(
            f"contact must be elastic for sensitivities of {name}, but {int(result.plastic.sum())} points have "
            "yielded. Leave the {hardness} out."
        )
    if not open_over_touching(result):
        raise InputError(f"contact must be partial for sensitivities of {name}, but is full.")


def open_over_touching(result: ContactResult) -> float:
    """Open over touching area of a periodic contact, at most one: near full contact the load and
    the pressure at edges change less."""
    if not all(result.problem.boundary.wraps):
        return 1.0
    touching = float(result.contact.mean())
    return min(1.0, (1.0 - touching) / touching)


def factors_about(result: ContactResult, shares: Sequence[float]) -> RealArray:
    """Loads over that of the ``result``, from the ``shares`` of the largest change."""
    return 1.0 + REACH * open_over_touching(result) * np.array(shares)


def solved_at(
    problem: ContactProblem, pressures: RealArray, engine: Engine | None, tolerance: float = AGAIN
) -> list[ContactResult]:
    """``problem`` at each of the mean ``pressures`` in Pa."""
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    loads, method = [MeanPressure(float(each)) for each in pressures], ActiveSet(tolerance=tolerance)
    return [solve(problem, load, solver=method, operator=operator, on_failure="return") for load in loads]


def worst_of(certificates: Iterable[SensitivityCertificate], by_edges: float = 1.0) -> SensitivityCertificate:
    """Certificate of derivatives that several contacts make."""
    several = list(certificates)
    return SensitivityCertificate(
        adjoint_residual=max(each.adjoint_residual for each in several),
        state_error=max(each.state_error for each in several),
        output_error=float("nan"),
        changed=max(each.changed for each in several),
        fft_pairs=sum(each.fft_pairs for each in several),
        by_edges=by_edges,
    )
