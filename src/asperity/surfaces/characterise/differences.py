"""Height differences over a lag, the raw material of slopes, curvatures and structure functions.

The rule for missing points is the same everywhere: a difference counts only if all its points are valid.
"""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface

AXES = ("x", "y")
"""Names of the array axes."""


def axis_index(axis: str) -> int:
    """Array axis of the name ``x`` or ``y``.

    Raises
    ------
    InputError
        If it is neither.
    """
    return AXES.index(require.one_of(axis, AXES, "axis of the profiles"))


def increments(surface: Surface, lag: tuple[int, int]) -> RealArray:
    """h(x + r) - h(x) in m for the lag r = (k dx, l dy), k and l whole numbers of either sign.

    A periodic surface wraps and returns (nx, ny) values; otherwise the nodes with both points inside the map. Values
    with a missing point are NaN.

    Raises
    ------
    InputError
        If the lag leaves no pair of points inside the map.
    """
    k, moved = lag
    h = surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        there = _wrapped(_wrapped(h, 0, k), 1, moved)
        wrapped: RealArray = there - h
        return wrapped
    if abs(k) >= surface.shape[0] or abs(moved) >= surface.shape[1]:
        raise InputError(
            f"lag of a difference must be shorter than the map of {surface.shape[0]} x {surface.shape[1]} points, "
            f"but is ({k}, {moved}) pixels."
        )
    first = tuple(slice(max(0, -s), n - max(0, s)) for s, n in zip((k, moved), h.shape, strict=True))
    second = tuple(slice(max(0, s), n - max(0, -s)) for s, n in zip((k, moved), h.shape, strict=True))
    inside: RealArray = h[second] - h[first]
    return inside


def second_differences(surface: Surface, axis: str) -> RealArray:
    """h(i+1) - 2 h(i) + h(i-1) in m along ``axis``; NaN as in :func:`increments`.

    A periodic surface wraps; otherwise the array is two points shorter along the axis.

    Raises
    ------
    InputError
        If the map has fewer than three points along the axis.
    """
    number, h = axis_index(axis), surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        h = np.concatenate([h[_part(number, slice(-1, None))], h, h[_part(number, slice(0, 1))]], axis=number)
    elif h.shape[number] < 3:
        raise InputError(
            f"surface must have three points or more along {axis} for a second difference, but has {h.shape[number]}."
        )
    second: RealArray = np.diff(h, n=2, axis=number)
    return second


def mean_square(values: RealArray, what: str) -> float:
    """Mean of the squares of the numbers in ``values``, NaN left out; ``what`` names the quantity for the error.

    Raises
    ------
    InputError
        If there is no number.
    """
    return mean_of(np.square(values), what)


def mean_of(values: RealArray, what: str) -> float:
    """Mean of the numbers in ``values``, NaN left out; ``what`` names the quantity for the error.

    Raises
    ------
    InputError
        If there is no number.
    """
    total = float(values.sum())
    if np.isnan(total):
        values = values[~np.isnan(values)]
        total = float(values.sum())
    if values.size == 0:
        raise InputError(
            f"surface must have neighbouring valid points for a {what}, but has none. Fill the missing points first."
        )
    return total / values.size


def _wrapped(h: RealArray, axis: int, shift: int) -> RealArray:
    """``h`` moved by ``shift`` points towards lower indices, what leaves coming back at the other end."""
    shift %= h.shape[axis]
    if shift == 0:
        return h
    moved: RealArray = np.concatenate(
        [h[_part(axis, slice(shift, None))], h[_part(axis, slice(None, shift))]], axis=axis
    )
    return moved


def _part(axis: int, part: slice) -> tuple[slice, slice]:
    return (part, slice(None)) if axis == 0 else (slice(None), part)
