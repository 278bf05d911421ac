"""Courses of a load or position from turning point to turning point, in equal steps."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from ..core import require
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
        Number of equal steps from each turning point to the next.

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
    legs = [np.linspace(start, end, steps + 1)[1:] for start, end in itertools.pairwise(points)]
    course = [*(points[:1] if kind is MeanGap else []), *(float(value) for leg in legs for value in leg)]
    return tuple(kind(value) if value > 0.0 or kind is MeanGap else Unloaded() for value in course)
