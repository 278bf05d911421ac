"""Wear of rolling contacts by creepage: what slips in the contact, passage after passage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from .law import WearLaw

if TYPE_CHECKING:
    from ..rolling.rolling import RollingContact


@dataclass(frozen=True, eq=False)
class RollingWear:
    """Wear of one body of a rolling contact.

    Attributes
    ----------
    across
        (n,) in m: position across the direction of rolling, from the middle of the grid.
    depth
        (n,) in m: worn depth, the same all around.
    volume
        Worn volume in m³.
    passages
        How often each point has run through the contact.
    """

    across: RealArray
    depth: RealArray
    volume: float
    passages: float


def rolled(contact: RollingContact, law: WearLaw, distance: float, circumference: float) -> RollingWear:
    """Wear by creepage of a body that has rolled ``distance``.

    A point that runs through the contact slips by s(x) dx on the way, s being the slip over the
    rolling speed, so that its dose in one passage is ∫ p s dx: Archard's law along the way. The
    shape is taken as it is: the contact of what has worn is another one, once the depth is no more
    small against the deflection (``worn_by_rolling``).

    Parameters
    ----------
    contact
        Steady rolling contact.
    law
        Law of the body, with one coefficient and without a threshold of the pressure.
    distance
        Distance rolled in m, > 0.
    circumference
        Of the body in m, > 0: every point runs through the contact once in as many metres.

    Raises
    ------
    InputError
        If a value is out of range, or the law has a map or a threshold of the pressure.
    """
    require_rolling_law(law)
    require.positive(distance, "distance rolled (m)")
    require.positive(circumference, "circumference of a rolling body (m)")
    grid = contact.normal.problem.grid
    passages = distance / circumference
    depth = law.depth(passages * dose_of_passage(contact))
    side = 1 if contact.direction.endswith("x") else 0
    across = (np.arange(grid.shape[side]) - 0.5 * (grid.shape[side] - 1)) * grid.spacing[side]
    return RollingWear(across, depth, float(depth.sum()) * grid.spacing[side] * circumference, passages)


def dose_of_passage(contact: RollingContact) -> RealArray:
    """(n,): dose ∫ p s dx in Pa m that points at each place across bear in one passage."""
    along = 0 if contact.direction.endswith("x") else 1
    slip = np.hypot(*contact.slip)
    dose = (contact.normal.pressure * slip).sum(axis=along) * contact.normal.problem.grid.spacing[along]
    return np.asarray(dose)


def require_rolling_law(law: WearLaw) -> None:
    """Refuse a ``law`` that has no meaning in rolling, with an InputError."""
    require.instance(law, WearLaw, "law of wear of a rolling body", "Write archard(1e-15).")
    if isinstance(law.factor, np.ndarray) or law.threshold_pressure:
        raise InputError(f"law of wear of a rolling body must have one coefficient and no threshold, but is {law!r}.")
