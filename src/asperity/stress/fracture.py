"""Indicators of fracture: tension at the surface, shear and peel of interfaces, each against a given strength."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from .field import Peak, StressField


@dataclass(frozen=True)
class Indicator:
    """A largest stress with its place, and the ``ratio`` to the strength given for it (NaN where none was)."""

    name: str
    peak: Peak
    ratio: float


def fracture_indicators(
    field: StressField,
    *,
    tensile: float = math.nan,
    interface_shear: float = math.nan,
    interface_peel: float = math.nan,
) -> tuple[Indicator, ...]:
    """Largest tension on the surface, largest tension in each region, and shear and peel of each interface of ``field``.

    Tension is the largest principal stress. Strengths ``tensile``, ``interface_shear`` and ``interface_peel`` in Pa give
    the ratios; a ratio of one or more means failure. Only planes of the field count: it needs depth 0 for the surface
    and the depths of the interfaces.
    """
    tension = field.max_principal
    found: list[Indicator] = []
    surface = [number for number, plane in enumerate(field.planes) if plane.side == "surface"]
    if surface:
        found.append(_indicator("tension at the surface", field, tension, surface, tensile))
    for region in field.regions:
        inside = [number for number, plane in enumerate(field.planes) if plane.region == region]
        found.append(_indicator(f"tension in {region.name}", field, tension, inside, tensile))
    shear, peel = np.hypot(field.shear_xz, field.shear_yz), field.normal_zz
    for number, plane in enumerate(field.planes):
        if plane.side == "above":
            below = next(
                (p.region.name for p in field.planes if p.region.index == plane.region.index + 1), "rigid base"
            )
            pair = f"{plane.region.name}/{below}"
            found.append(_indicator(f"shear of the interface {pair}", field, shear, [number], interface_shear))
            found.append(_indicator(f"peel of the interface {pair}", field, peel, [number], interface_peel))
    return tuple(found)


def _indicator(name: str, field: StressField, values: RealArray, planes: list[int], strength: float) -> Indicator:
    peak = max((field.peak(values, plane=number) for number in planes), key=lambda p: p.value)
    return Indicator(name, peak, peak.value / strength)
