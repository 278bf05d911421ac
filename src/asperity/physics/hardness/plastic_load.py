"""The load at which a contact counts as plastic: a search over loads for a share of the real area
at the hardness."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...contact.controls import MeanPressure
from ...contact.operators import Operator, prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import PLASTIC_FRACTION, ContactResult
from ...contact.solve import Keep, solve
from ...contact.solvers.protocol import Solver
from ...core import require
from ...core.errors import InputError, NoSolutionError
from ...core.status import Progress

_START, _DOWN, _UP = 16.0, 8.0, 2.0
_LARGEST = 1.0 - 1e-6
_KEEP = Keep(stiffness=False)


@dataclass(frozen=True, eq=False)
class PlasticLoad:
    """Two first loads close to one another, between which the plastic share of the real area passes
    ``fraction``.

    Parameters
    ----------
    fraction
        The share asked for; 0.02 is the criterion of Greenwood & Williamson (1966).
    below, above
        Results with at most and with more than this share. In pixels the share jumps: the larger
        the contact in pixels, the closer the shares of the two.
    """

    fraction: float
    below: ContactResult
    above: ContactResult

    @property
    def mean_pressure(self) -> float:
        """Largest mean pressure in Pa found at which the contact is still elastic in this sense."""
        return self.below.mean_pressure

    @property
    def force(self) -> float:
        """The same as a force in N."""
        return self.below.force


def plastic_load(
    problem: ContactProblem,
    *,
    fraction: float = PLASTIC_FRACTION,
    tolerance: float = 1e-3,
    solver: Solver | None = None,
    operator: Operator | None = None,
    progress: Progress | None = None,
) -> PlasticLoad:
    """Load of virgin surfaces at which the plastic area passes ``fraction`` of the real area.

    A contact is called plastic when more than 2 % of its real area is at the hardness (Greenwood &
    Williamson 1966). From an elastic contact the load is doubled until the contact is plastic, and
    the last interval then halved in the logarithm, each solve from virgin surfaces. The share need
    not grow steadily with the load, so this is the first passage that doubling does not jump over.
    On rough surfaces it may come when only a few pixels touch; look at ``below.contact`` then.

    Parameters
    ----------
    problem
        Its law must limit the pressure: ``Hardness`` or ``LayeredHardness``.
    fraction
        Share of the real area, 0 <= fraction < 1; zero for the first pixel that yields.
    tolerance
        Relative distance of the two loads at which to stop, between 0 and 1.
    solver, operator, progress
        See ``solve``.

    Raises
    ------
    NoSolutionError
        If no load below the hardness makes the contact plastic.
    InputError
        If the law has no limit or a number is out of range.
    ConvergenceError
        If a solve on the way does not converge.
    """
    if not 0.0 <= require.finite(fraction, "share of the real area") < 1.0:
        raise InputError(f"share of the real area must be at least 0 and less than 1, but is {fraction:g}.")
    require.between(tolerance, 0.0, 1.0, "tolerance of the load")
    hardest = mean_cap(problem)
    ready = operator or prepare_operator(problem.compliance, problem.grid, problem.boundary)

    def at(load: float) -> ContactResult:
        return solve(problem, MeanPressure(load), solver=solver, operator=ready, keep=_KEEP, progress=progress)

    # the lower load lies between an elastic contact and the first of its doubled loads that is
    # plastic
    below = at(hardest / _START)
    while below.plastic_area_fraction > 0.0:
        below = at(below.mean_pressure / _DOWN)
    while True:
        load = below.mean_pressure
        if load > _LARGEST * hardest:
            raise NoSolutionError(
                f"No load below the hardness brings more than {fraction:g} of the real area to it, but all of "
                "it at once does. Such smooth surfaces yield as a whole; ask for a smaller share.",
                subject=f"plastic share {fraction:g}",
            )
        above = at(min(load * _UP, math.sqrt(load * hardest)))
        if above.plastic_area_fraction > fraction:
            break
        below = above
    while above.mean_pressure > below.mean_pressure * (1.0 + tolerance):
        found = at(math.sqrt(above.mean_pressure * below.mean_pressure))
        if found.plastic_area_fraction > fraction:
            above = found
        else:
            below = found
    return PlasticLoad(fraction, below, above)


def mean_cap(problem: ContactProblem) -> float:
    """Mean pressure (Pa) at which all of the virgin surface would yield.

    Raises
    ------
    InputError
        If the law does not limit the pressure.
    """
    mean = float(np.mean(problem.law.pressure_cap()))
    if not math.isfinite(mean):
        raise InputError(
            f"law of a contact with a plastic load must limit the pressure, but is {problem.law.name}. Use "
            f"{{hardness}}."
        )
    return mean
