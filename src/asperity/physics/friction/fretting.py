"""What a step with stick and slip comes to in numbers, and the cycles of a history with what they
dissipate."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...core.units import show
from .answer import MEASURES, NUMBERS

SHEAR_SCALARS = (*NUMBERS, *MEASURES)
"""Every scalar of stick and slip in the order of tables."""

STICKS, SLIPS, OPEN = 1, 2, 0
"""Kinds of points in ``kinds``."""


def kinds(result: ContactResult) -> RealArray:
    """(nx, ny): ``OPEN``, ``STICKS`` or ``SLIPS`` of each point in the last step of ``result``."""
    found = result.require_stick_slip()
    return np.where(result.contact, np.where(found.slipping, float(SLIPS), float(STICKS)), float(OPEN))


def shear_numbers(result: ContactResult) -> dict[str, float]:
    """``SHEAR_SCALARS`` of ``result`` by name; NaN where there is nothing to divide by.

    InputError if the result has no stick and slip.
    """
    return {item.quantity.name: item.values for item in result.require_stick_slip().tabled(result)}


@dataclass(frozen=True, eq=False)
class Loop:
    """Tangential force against shift along the direction of the largest shift of a history.

    Attributes
    ----------
    shift, force
        Shift (m) and force (N) along ``direction`` after each step.
    direction
        Unit vector of the largest shift.
    dissipated
        Energy (J) dissipated by slip in each step.
    cycles
        First and last step of each closed cycle: from one turning point to the next of the same
        side.
    """

    shift: RealArray
    force: RealArray
    direction: tuple[float, float]
    dissipated: RealArray
    cycles: tuple[tuple[int, int], ...]

    @property
    def cycle_energies(self) -> RealArray:
        """Energy (J) dissipated in each closed cycle."""
        return np.array([self.dissipated[first + 1 : last + 1].sum() for first, last in self.cycles])


def loop_of(steps: Sequence[ContactResult]) -> Loop:
    """The loop of the ``steps`` of a history with stick and slip.

    InputError if a step has none.
    """
    found = [step.require_stick_slip() for step in steps]
    shifts = np.array([[item.shift_x, item.shift_y] for item in found])
    forces = np.array([[item.force_x, item.force_y] for item in found])
    farthest = shifts[int(np.argmax(np.nan_to_num(np.hypot(*shifts.T))))]
    length = float(np.hypot(*farthest))
    direction = farthest / length if length > 0.0 else np.array([1.0, 0.0])
    shift = shifts @ direction
    # steps between which the shift turns at one side and comes back to it
    cycles: tuple[tuple[int, int], ...] = ()
    moves = np.nan_to_num(np.diff(shift))  # NaN where a force was all that friction bears
    moving = np.flatnonzero(moves)
    if moving.size:
        signs = np.sign(moves[moving])
        turns = [int(moving[k]) + 1 for k in np.flatnonzero(np.diff(signs))]
        turns.append(int(moving[-1]) + 1)
        cycles = tuple(itertools.pairwise(turns[::2]))
    return Loop(
        shift,
        forces @ direction,
        (float(direction[0]), float(direction[1])),
        np.array([item.dissipated for item in found]),
        cycles,
    )


def step_texts(steps: Sequence[ContactResult]) -> list[str]:
    """The shift of each of the ``steps`` of a history with stick and slip, in words."""
    return [f"shift {show(float(shift), 'm', 4)}" for shift in loop_of(steps).shift]
