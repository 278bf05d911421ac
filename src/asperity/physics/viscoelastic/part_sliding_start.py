"""Start of sliding over a viscoelastic body, in steps of time: friction and area from the load at
once to the steady state."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ...core.quantity import Quantity
from ...parts.part import Part

if TYPE_CHECKING:
    pass


SCALARS = (
    Quantity("start_last_friction", "1", "coefficient of friction by the slope over the last quarter of the distance"),
    Quantity("start_last_heat_friction", "1", "the same by the heat"),
    Quantity("start_largest_friction", "1", "largest coefficient of friction on the way"),
    Quantity("start_first_area_fraction", "1", "real contact area / nominal area at rest"),
    Quantity("start_last_area_fraction", "1", "real contact area / nominal area after the distance"),
    Quantity("start_heat", "J", "heat of viscoelastic solids on the way"),
)
"""Numbers of the start of sliding."""

FIELD = Quantity("start_pressure", "Pa", "contact pressure after the distance", ("x", "y"))

STEP = "start_step"
"""Axis of steps of time."""

FRICTION = Quantity("way_friction", "1", "coefficient of friction by the slope of what moves", (STEP,))


class SlidingStart(Part):
    """What happens from the load at once over the first distance of sliding."""

    name = "sliding_start"
    title = "Start of sliding"
    table = "hysteresis"
    needs = "distance"
    work = "physics.viscoelastic.work_sliding_start:SlidingStartWork"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, pressure, and columns of all steps of time."""
        from .transient_sliding import COLUMNS

        columns = (replace(item, name=f"way_{item.name}", dims=(STEP,)) for item in COLUMNS)
        return (*SCALARS, FIELD, *columns, FRICTION)
