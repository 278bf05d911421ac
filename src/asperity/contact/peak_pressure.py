"""Largest pressure of a contact between its pixels: the vertex of the paraboloid that the squared pressure of every smooth spot is."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, RealArray
from ..core.grid import Grid

LARGEST_SHIFT = 0.7
"""Pixels that the vertex may lie from the largest pixel along an axis."""

LEAST_ERROR, CURVED = 0.005, 0.25
"""Error over the pressure at the pixel: the least one, and by the relative fall of its square to the four neighbours."""


class PeakPressure(NamedTuple):
    """Largest pressure ``value`` in Pa, its ``error`` (zero at a hardness, NaN in ``doubt``), and where it is, x and y in m as those of the grid's nodes.

    ``doubt`` is empty, or says why the value is but that of the largest pixel.
    """

    value: float
    error: float
    x: float
    y: float
    doubt: str = ""


def peak_pressure(p: RealArray, plastic: BoolArray, grid: Grid, wraps: tuple[bool, bool]) -> PeakPressure:
    """Largest of the pressure ``p`` (nx, ny) in Pa, which is at its limit where it is ``plastic``.

    Of p² at the largest pixel and its neighbours the vertex of the quadratic. The error held the truth in all of 546 spheres from 1.5 pixels in the radius on.
    """
    place = tuple(int(k) for k in np.unravel_index(int(np.argmax(p)), p.shape))
    highest, (dx, dy) = float(p[place]), grid.spacing
    x, y = place[0] * dx, place[1] * dy
    if plastic[place]:
        return PeakPressure(highest, 0.0, x, y)
    lines = []
    for at, size, wrap in zip(place, p.shape, wraps, strict=True):
        line = np.array([at - 1, at, at + 1]) if size > 1 else np.array([at])
        if not wrap and not (line[0] >= 0 and line[-1] < size):
            return PeakPressure(highest, math.nan, x, y, "it lies at the border of the grid")
        lines.append(line % size)
    around = p[np.ix_(*lines)].astype(np.float64)
    if not (around > 0.0).all() or plastic[np.ix_(*lines)].any():
        return PeakPressure(highest, math.nan, x, y, "a pixel beside it is out of contact or at the hardness")
    square = around**2
    middle = tuple(size // 2 for size in square.shape)
    top = vertex = float(square[middle])
    slope, curve, shift, neighbours = np.zeros(2), -np.ones(2), np.zeros(2), list[float]()
    for axis in (0, 1):
        if square.shape[axis] == 3:
            low, _, high = np.take(square, middle[1 - axis], 1 - axis).tolist()
            slope[axis], curve[axis] = 0.5 * (high - low), high - 2.0 * top + low
            neighbours += [low, high]
    mixed = 0.25 * (square[2, 2] - square[2, 0] - square[0, 2] + square[0, 0]) if square.shape == (3, 3) else 0.0
    hessian = np.array([[curve[0], mixed], [mixed, curve[1]]])
    if np.linalg.det(hessian) > 0.0 and curve[0] < 0.0:
        shift = np.clip(-np.linalg.solve(hessian, slope), -LARGEST_SHIFT, LARGEST_SHIFT)
        vertex = top + float(slope @ shift) + 0.5 * float(shift @ hessian @ shift)
    value = math.sqrt(max(vertex, 0.0))
    fall = 1.0 - float(np.mean(neighbours)) / highest**2 if neighbours else 0.0
    error = abs(value - highest) + (LEAST_ERROR + CURVED * fall) * highest
    return PeakPressure(value, error, x + float(shift[0]) * dx, y + float(shift[1]) * dy)
