"""Critical thickness of a layer: where it begins to have an effect, and where nothing below it has
one any more (Peng 2001, eq. 4.1)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..io.schemas.study import CriticalThicknessTable
from ..run.document import checked
from .axes import Axis, Base, Point, values_of
from .places import Change, Edit, edited, locate, problem_table

CHANGES: tuple[Change, Change] = ("without", "endless")
"""The layer at both ends of the axis."""


@dataclass(frozen=True)
class CriticalThickness:
    """Thicknesses in m between which both the layer and what lies below it matter for a quantity.

    Attributes
    ----------
    floor
        Largest thickness up to which the layer has no effect; NaN where it has one at every
        thickness given.
    ceiling
        Smallest thickness from which what lies below has no effect; NaN where it has one at every
        thickness given.
    at_zero, at_infinity
        The quantity without the layer, and with an endless one.
    """

    floor: float
    ceiling: float
    at_zero: float
    at_infinity: float


def critical_thickness(
    thickness: ArrayLike, values: ArrayLike, at_zero: float, at_infinity: float, *, share: float = 0.05
) -> CriticalThickness:
    """Floor and ceiling of the quantity whose ``values`` belong to the rising ``thickness`` in m
    (Peng 2001, eq. 4.1).

    The bounds |Y - Y(0)| and |Y - Y(∞)| <= ``share`` |Y(∞) - Y(0)| must hold and keep holding: of
    several crossings the outermost counts. Between two thicknesses Y is linear in their logarithm.

    Raises
    ------
    InputError
        If thicknesses are not positive and rising, or lengths differ.
    """
    h, y = np.asarray(thickness, dtype=float), np.asarray(values, dtype=float)
    if h.ndim != 1 or h.shape != y.shape or h.size < 2 or h[0] <= 0.0 or np.any(np.diff(h) <= 0.0):
        raise InputError(
            "thicknesses must be at least two, positive and rising, with one value each, but there are "
            f"{h.size} with {y.size}."
        )
    change = at_infinity - at_zero
    known = np.isfinite(y)
    if not math.isfinite(change) or change == 0.0 or known.sum() < 2:
        return CriticalThickness(math.nan, math.nan, at_zero, at_infinity)
    log_h, done = np.log(h[known]), (y[known] - at_zero) / change
    floor = _last_within(log_h, done, share)
    ceiling = _last_within(-log_h[::-1], 1.0 - done[::-1], share)
    return CriticalThickness(math.exp(floor), math.exp(-ceiling), at_zero, at_infinity)


def thickness_axis(base: Base, table: CriticalThicknessTable) -> Axis:
    """Thicknesses of one layer between its absence (coordinate 0) and what lies below being out of
    reach (infinity).

    Raises
    ------
    InputError
        If there is no such layer, or a thickness is not positive.
    """
    place = locate(base.document, f"{table.layer}.thickness")
    if place.keys[1] != "layers":
        raise InputError(f'critical_thickness.layer must be a layer such as "body.layers.0", but is {table.layer!r}.')
    key, number = str(place.keys[0]), int(place.keys[2])
    thicknesses = sorted((place.number(value), value) for value in values_of(place, table, scale="log"))
    if thicknesses[0][0] <= 0.0:
        raise InputError(
            f"thicknesses must be greater than zero, but one is {thicknesses[0][1]!r}; zero comes by itself."
        )
    layer: Any = getattr(base.document, key).layers[number]
    if hasattr(layer, "top"):
        raise InputError("critical_thickness.layer must be homogeneous, but is graded; take another layer.")
    limits = [Edit(place.keys, change=change) for change in CHANGES]
    for edit in limits:
        checked(edited(problem_table(base.document), [edit]), f"problem with the layer {edit.change}")
    inside = [Point(thickness, (base.edit(place, value),)) for thickness, value in thicknesses]
    return Axis("thickness", "m", place.path, (Point(0.0, (limits[0],)), *inside, Point(math.inf, (limits[1],))))


def _last_within(x: RealArray, done: RealArray, share: float) -> float:
    """Largest x up to which |``done``| <= ``share`` everywhere; NaN if it is larger at the
    first."""
    beyond = np.flatnonzero(np.abs(done) > share)
    if beyond.size == 0:
        return float(x[-1])
    after = int(beyond[0])
    if after == 0:
        return math.nan
    before = after - 1
    edge = math.copysign(share, done[after])
    return float(x[before] + (x[after] - x[before]) * (edge - done[before]) / (done[after] - done[before]))
