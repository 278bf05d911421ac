"""Courses of a load or position from turning point to turning point, step by step."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .control import Approach, Control, Force, MeanGap, MeanPressure, Unloaded

Ramped: TypeAlias = type[MeanPressure] | type[Force] | type[Approach] | type[MeanGap]
"""Kind of control that is changed step by step."""


def ramps(kind: Ramped, turning_points: Sequence[float], *, steps: int = 10) -> tuple[Control, ...]:
    """Controls of a load path that runs through the ``turning_points``.

    Parameters
    ----------
    kind
        ``MeanPressure``, ``Force``, ``Approach`` or ``MeanGap``.
    turning_points
        Values in SI units, >= 0, in order; for example ``[50e6, 0, 80e6]`` to load, unload and load again. Zero is no
        load (``Unloaded``). A path starts at zero, except of ``MeanGap``, which starts at its first value.
    steps
        Number of steps from each turning point to the next. They are equal, but where a load begins or ends at zero they
        grow with the distance from it, load = (k/steps)² of the other end: a light contact changes fastest.

    Raises
    ------
    InputError
        If there is no turning point, two neighbours are equal, one is negative, or a mean gap is zero.
    """
    require.integer(steps, 1, "number of steps")
    if not isinstance(kind, type) or kind not in (MeanPressure, Force, Approach, MeanGap):
        raise InputError(f"kind of a ramp must be MeanPressure, Force, Approach or MeanGap, but is {kind!r}.")
    values = [require.not_negative(value, f"turning point of a load path ({kind.unit})") for value in turning_points]
    first = [] if kind is MeanGap else [0.0]
    points = [*first, *(values[1:] if values[:1] == first else values)]
    if len(points) < 2 - (kind is MeanGap):
        raise InputError("turning points of a load path must hold at least one value greater than zero, but hold none.")
    if any(low == high for low, high in itertools.pairwise(points)):
        raise InputError(f"neighbouring turning points of a load path must differ, but are {values}.")
    graded = kind in (MeanPressure, Force)
    legs = [_leg(start, end, steps, graded=graded) for start, end in itertools.pairwise(points)]
    course = [*(points[:1] if kind is MeanGap else []), *(float(value) for leg in legs for value in leg)]
    return tuple(kind(value) if value > 0.0 or kind is MeanGap else Unloaded() for value in course)


def _leg(start: float, end: float, steps: int, *, graded: bool) -> RealArray:
    """Values after each of the ``steps`` from ``start`` to ``end``; ``graded`` ones are denser towards a zero."""
    share = np.arange(1, steps + 1) / steps
    if graded and start == 0.0:
        share = share**2
    elif graded and end == 0.0:
        share = 1.0 - (1.0 - share) ** 2
    values: RealArray = start + share * (end - start)
    values[-1] = end
    return values
