"""The load at which the gap of a contact closes: percolation of the contact across the flow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...contact.controls import MeanPressure
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...core import require
from ...core.arrays import BoolArray
from ...core.errors import InputError, NoSolutionError
from .flow import WAYS, Way
from .network import carrying_cells, open_cells

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


def passes(result: ContactResult, way: Way = "x", *, corners: bool = False) -> bool:
    """Whether the gap of a contact leads through it along ``way``: from side to side, or around the
    grid where that repeats; through ``corners`` between spots of contact, too, if asked for."""
    require.one_of(way, WAYS, "direction of flow")
    wraps, axis = result.problem.boundary.wraps, WAYS.index(way)
    gap = result.gap * ~result.contact
    if not gap.any():
        return False
    if corners:
        gap = _through_corners(open_cells(gap), wraps).astype(float)
    return bool(carrying_cells(gap, wraps, None if wraps[axis] else axis, along=axis).any())


def _through_corners(opened: BoolArray, wraps: tuple[bool, bool]) -> BoolArray:
    """The ``opened`` cells (nx, ny) as four each, (2 nx, 2 ny); where open and closed ones meet
    crosswise at a corner one of the closed quarters there is open, which joins the open cells."""
    fine = np.repeat(np.repeat(opened, 2, 0), 2, 1)
    after = np.roll(opened, -1, 0)
    beside, both = np.roll(opened, -1, 1), np.roll(after, -1, 1)
    rising, falling = opened & both & ~after & ~beside, after & beside & ~opened & ~both
    for axis in (0, 1):
        if not wraps[axis]:  # no corner beyond the last cell
            for each in (rising, falling):
                each[(slice(None),) * axis + (-1,)] = False
    # of the quarters at the corner of a cell: its own, and that of the next along x
    fine[1::2, 1::2] |= falling
    fine[0::2, 1::2] |= np.roll(rising, 1, 0)
    return fine


def closing_load(
    problem: ContactProblem,
    between: tuple[float, float],
    *,
    way: Way = "x",
    rounds: int = ROUNDS,
    corners: bool = False,
) -> Closing:
    """The load at which the gap of a contact closes along ``way``, by halving the interval of its
    logarithm.

    Where spots of contact meet at a corner of pixels, nothing passes; with ``corners`` fluid does.
    The gap closes then at a higher load: what lies between both loads, pixels do not resolve.

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
    corners
        Whether fluid passes between spots of contact that meet at a corner of pixels only.

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
        if passes(result, way, corners=corners) is not wanted:
            state = "closed at {} already" if wanted else "open at {} still"
            raise NoSolutionError(
                "mean pressures of a gap that closes must have that load between them, but the gap is "
                f"{state.format(f'{value:g} Pa')}; the contact covers {result.area_fraction:.3g} of the area."
            )
    for _ in range(rounds):
        middle = (low * high) ** 0.5
        result = solve(problem, MeanPressure(middle))
        if passes(result, way, corners=corners):
            low, fractions[0] = middle, result.area_fraction
        else:
            high, fractions[1] = middle, result.area_fraction
    return Closing(low, high, *fractions)
