"""Largest stresses and what follows from them in words: with their errors, or as bounds where they
are not to be trusted."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...core.quantity import given, measured
from ...core.units import show
from .regions import Region


@dataclass(frozen=True)
class Peak:
    """Extreme ``value`` of a field and where it is, lengths in m; ``region`` and ``side`` as for
    ``Plane``.

    ``error`` bounds that of the value by the size of the pixels, where it is known: at the surface
    of a contact (``sharp``). Else it is NaN. ``doubt`` is empty, or says why the value, that of the
    field, is but a lower bound.
    """

    value: float = measured("Pa", "extreme value")
    x: float = measured("m", "x of the extreme value")
    y: float = measured("m", "y of the extreme value")
    depth: float = measured("m", "depth of the extreme value")
    region: Region = given()
    side: str = measured("", "position in the region")
    error: float = measured("Pa", "bound of the error by the size of the pixels", default=math.nan)
    doubt: str = measured("", "why it is but a lower bound", default="")


@dataclass(frozen=True, eq=False)
class SurfaceMaxima:
    """Largest stresses at the surface of a contact, edges between its pixels included (``sharp``):
    σ1, von Mises, shear (σ1 - σ3)/2, and the larger principal stress in the plane."""

    tension: Peak
    von_mises: Peak
    shear: Peak
    in_plane: Peak

    def joined(self, name: str, peak: Peak) -> Peak:
        """The larger of that ``name`` here and ``peak``, the largest at the points of planes, which
        at the surface it replaces."""
        own: Peak = getattr(self, name)
        return own if peak.side == "surface" or own.value > peak.value else peak


MAXIMA = ("tension", "von_mises", "shear", "in_plane")
"""Names of the largest stresses at a surface."""


def peak_text(peak: Peak, factor: float = 1.0) -> str:
    """Value of a ``peak`` times ``factor`` with its error where that is known; as a lower bound
    where it is not to be trusted."""
    value = show(factor * peak.value, "Pa")
    if peak.doubt:
        return f"> {value}"
    return value if math.isnan(peak.error) else f"{value} ± {show(factor * peak.error, 'Pa', 2)}"


FAILS = "fails"
"""What is said of a strength that does not hold."""


def verdict(peak: Peak, strength: float) -> str:
    """Whether a ``strength`` holds, with the error of the largest stress."""
    error = 0.0 if math.isnan(peak.error) else peak.error
    if peak.value - error >= strength or (peak.doubt and peak.value >= strength):
        return FAILS
    return "not certain" if peak.doubt or peak.value + error >= strength else "holds"
