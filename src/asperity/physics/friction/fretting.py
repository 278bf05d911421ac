"""What a step with stick and slip comes to in numbers, and the cycles of a history with what they dissipate."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...core.quantity import Quantity, stored_quantities
from .answer import StickSlip

_STORED = {item.name: item for item in stored_quantities(StickSlip)}

NUMBERS = tuple(
    _STORED[name]
    for name in (
        "force_x",
        "force_y",
        "torque",
        "shift_x",
        "shift_y",
        "twist",
        "friction_limit",
        "dissipated",
        "total_dissipated",
        "tangential_energy",
    )
)
"""Numbers that a ``StickSlip`` holds."""

MEASURES = (
    Quantity("friction_share", "1", "tangential force / largest that friction bears"),
    Quantity("stick_area_fraction", "1", "sticking area / real contact area (pixels)"),
    Quantity("slip_area_fraction", "1", "area that slips in the last step / real contact area (pixels)"),
    Quantity("max_slip", "m", "largest slip since the start"),
    Quantity("max_shear_traction", "Pa", "largest shear traction"),
    Quantity("secant_stiffness", "N/m", "tangential force along the shift / shift"),
)
"""Numbers that follow from its fields."""

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
    found = result.require_stick_slip()
    touching = int(np.count_nonzero(result.contact))
    slipping = int(np.count_nonzero(found.slipping & result.contact))
    along = found.force_x * found.shift_x + found.force_y * found.shift_y
    squared = found.shift_x**2 + found.shift_y**2
    force = math.hypot(found.force_x, found.force_y)
    finite = 0.0 < found.friction_limit < math.inf
    return {
        **{item.name: float(getattr(found, item.name)) for item in NUMBERS},
        "friction_share": force / found.friction_limit if finite else math.nan,
        "stick_area_fraction": 1.0 - slipping / touching if touching else math.nan,
        "slip_area_fraction": slipping / touching if touching else math.nan,
        "max_slip": float(np.hypot(*found.slip).max()),
        "max_shear_traction": float(found.traction_magnitude.max()),
        "secant_stiffness": along / squared if squared > 0.0 else math.nan,
    }


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
        First and last step of each closed cycle: from one turning point to the next of the same side.
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
