"""What the bodies would overlap if they did not deform, and the complementary energy of a
contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import BoolArray

if TYPE_CHECKING:
    from .result import ContactResult


@dataclass(frozen=True, eq=False)
class Interference:
    """Overlap of the undeformed bodies at the approach of a contact (Peng 2001, fig. 3.8).

    Attributes
    ----------
    overlapping
        (nx, ny), True where they overlap; an area of contact lies within, but for adhesion.
    area
        Area in m², by points; NaN where the approach is not known.
    volume
        Volume in m³.
    """

    overlapping: BoolArray
    area: float
    volume: float


def interference(result: ContactResult) -> Interference:
    """Overlap of the virgin bodies at the ``approach`` δ of ``result``: points of heights
    h > h_max - δ.

    For a sphere 2 π a² and π R δ², twice the area of Hertz. Where nothing lies outside the grid and
    nothing pulls, the contact lies within. On a periodic map the approach is that of the mean
    planes, without the mean displacement: some points of the contact may lie outside.
    """
    profile, approach = result.problem.profile(), result.approach
    depth = profile - (float(profile.max()) - approach)
    overlapping = depth > 0.0
    if not math.isfinite(approach):
        return Interference(overlapping, math.nan, math.nan)
    pixel = result.problem.grid.pixel_area
    return Interference(overlapping, pixel * float(overlapping.sum()), pixel * float(depth[overlapping].sum()))


def complementary_energy(result: ContactResult) -> float:
    """V* = U - ∫ p u* dA in J, with u* the displacement on the contact and U the elastic energy
    (Peng 2001, eqs 3.3-3.10, 3.27 and 3.28).

    u* is the elastic displacement and the permanent indentation w_p. With pressures that vanish
    outside the contact and a first load V* = -U - H ∫ w_p dA: minus the elastic energy where
    nothing yields. NaN with attraction or creep, whose energies it does not hold.
    """
    if result.creep is not None or any(answer.traction_beside() is not None for answer in result.answers):
        return math.nan
    work = float(np.sum(result.pressure * (result.displacement + result.permanent_indentation)))
    return float(result.elastic_energy) - work * result.problem.grid.pixel_area
