"""Sensitivity of quantities to the scalars of a problem: one at a time, up and down."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import reduce
from operator import getitem
from typing import Any

from ..core.errors import InputError
from ..io.schemas.study import SensitivityTable
from .axes import Axis, Base, Point, coordinate
from .places import locate, problem_table

BASE = "base"
"""Coordinate of the base problem on the axis of parameters."""

ENDS = ("low", "high")
"""Words behind the path of a parameter in the coordinates of its two cases."""


@dataclass(frozen=True)
class Sensitivity:
    """What one scalar does to one quantity.

    Attributes
    ----------
    low, high
        Quantity at the low and the high value of the scalar.
    elasticity
        d ln Y / d ln x between them: per cent of the quantity by per cent of the scalar; NaN where
        a sign forbids it.
    slope
        dY/dx in SI units.
    """

    low: float
    high: float
    elasticity: float
    slope: float


def sensitivity(x: tuple[float, float], y: tuple[float, float]) -> Sensitivity:
    """Sensitivity of a quantity that is ``y`` at the values ``x``, low and high, of a scalar."""
    slope = (y[1] - y[0]) / (x[1] - x[0]) if x[1] != x[0] else math.nan
    same_sign = x[0] * x[1] > 0.0 and y[0] * y[1] > 0.0
    elasticity = math.log(y[1] / y[0]) / math.log(x[1] / x[0]) if same_sign and x[0] != x[1] else math.nan
    return Sensitivity(y[0], y[1], elasticity, slope)


def parameter_axis(base: Base, table: SensitivityTable) -> Axis:
    """Axis with the base problem, and for each parameter its low and its high value.

    Raises
    ------
    InputError
        If a path leads nowhere, or a scalar has no value in the base problem to be changed by a
        share.
    """
    points = [Point(BASE, (), {"value": math.nan})]
    for item in table.parameters:
        place = locate(base.document, item.path)
        if item.low is not None and item.high is not None:
            ends = place.number(item.low), place.number(item.high)
        else:
            table_of_problem: Any = problem_table(base.document)
            try:
                middle = place.number(reduce(getitem, place.keys, table_of_problem))
            except (KeyError, InputError):
                raise InputError(
                    f"{place.path} must have a number in the problem to be changed by a share; give low and "
                    "high instead."
                ) from None
            share = item.change or table.change
            ends = middle * (1.0 - share), middle * (1.0 + share)
        for end, number in zip(ENDS, ends, strict=True):
            value = place.written(number)
            points.append(Point(f"{item.path} {end}", (base.edit(place, value),), {"value": coordinate(place, value)}))
    return Axis("parameter", "1", "", points, False, {"value": ""})
