"""The load at which the gap of a contact closes: percolation of the contact across the flow."""

from __future__ import annotations

from dataclasses import dataclass

from ...contact.controls import MeanPressure
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...core import require
from ...core.errors import InputError, NoSolutionError
from .flow import WAYS, Way
from .network import carrying_cells

ROUNDS = 12
"""Halvings of the interval of loads: the load is then known to some thousandths of its
logarithm."""


@dataclass(frozen=True, eq=False)
class Closing:
    """Where the gap of a contact closes.

    Attributes
    ----------
    lower, upper
        Mean pressures in Pa at which fluid still passes and at which none does.
    open_fraction, closed_fraction
        Real contact area over nominal area (pixels) at both.
    """

    lower: float
    upper: float
    open_fraction: float
    closed_fraction: float


def passes(result: ContactResult, way: Way = "x") -> bool:
    """Whether the gap of a contact leads through it along ``way``: from side to side, or around the
    grid where that repeats."""
    require.one_of(way, WAYS, "direction of flow")
    wraps, axis = result.problem.boundary.wraps, WAYS.index(way)
    gap = result.gap * ~result.contact
    if not gap.any():
        return False
    return bool(carrying_cells(gap, wraps, None if wraps[axis] else axis, along=axis).any())


def closing_load(
    problem: ContactProblem, between: tuple[float, float], *, way: Way = "x", rounds: int = ROUNDS
) -> Closing:
    """The load at which the gap of a contact closes along ``way``, by halving the interval of its
    logarithm.

    Parameters
    ----------
    problem
        Contact that loads by a mean pressure; each load is a first loading.
    between
        Mean pressures in Pa, > 0, at the lower of which fluid must pass and at the higher not.
    way
        ``"x"`` or ``"y"``.
    rounds
        Halvings, so many solves.

    Raises
    ------
    InputError
        If a pressure is not > 0 or they are not in order.
    NoSolutionError
        If fluid passes at both pressures, or at none.
    """
    low, high = (require.positive(value, "mean pressure of a gap that closes (Pa)") for value in between)
    if low >= high:
        raise InputError(f"mean pressures of a gap that closes must rise, but are {low:g} Pa and {high:g} Pa.")
    fractions = []
    for value, wanted in ((low, True), (high, False)):
        result = solve(problem, MeanPressure(value))
        fractions.append(result.area_fraction)
        if passes(result, way) is not wanted:
            state = "closed at {} already" if wanted else "open at {} still"
            raise NoSolutionError(
                "mean pressures of a gap that closes must have that load between them, but the gap is "
                f"{state.format(f'{value:g} Pa')}; the contact covers {result.area_fraction:.3g} of the area."
            )
    for _ in range(rounds):
        middle = (low * high) ** 0.5
        result = solve(problem, MeanPressure(middle))
        if passes(result, way):
            low, fractions[0] = middle, result.area_fraction
        else:
            high, fractions[1] = middle, result.area_fraction
    return Closing(low, high, *fractions)
