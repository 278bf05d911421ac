"""Columns of a text that hold a line scan x z, or a list of points x y z on a regular grid."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from .text_files import TextNumbers
from .text_header import unit_of_name

_OFF_GRID = 0.1  # of a step: coordinates are written with few digits
_SPARSE = 4  # nodes of the grid for every point of a list, at most


class LineScan(NamedTuple):
    """A line scan in a text of two columns: positions ``x`` and heights ``z`` (n,) in the units of
    the file, empty if unknown."""

    x: RealArray
    z: RealArray
    x_unit: str
    z_unit: str


_FEWEST = 3  # points of a line scan


def line_scan(found: TextNumbers, *, stated: bool = False) -> LineScan | None:
    """The line scan that a text holds, None if it holds something else: two columns of four points
    or more, the first of which rises or falls throughout.

    Where it is ``stated`` that the text is no map, any two columns of three points or more are one.
    """
    rows, units = found.rows, [unit_of_name(name) for name in (found.names or ("", ""))[-2:]]
    if found.x is None and found.y is not None and rows.shape[1] == 1:
        return LineScan(found.y, rows[:, 0], *units)
    if found.x is not None or rows.shape[1] != 2 or rows.shape[0] < _FEWEST:
        return None
    steps = np.diff(rows[:, 0])
    one_way = bool(np.isfinite(steps).all() and (np.all(steps > 0) or np.all(steps < 0)))
    if (one_way and rows.shape[0] > _FEWEST) or (stated and found.y is None):
        return LineScan(rows[:, 0], rows[:, 1], *units)
    return None


class PointColumns(NamedTuple):
    """Columns x, y, z of a list of points, in their order (n, 3), and the units that their names
    state, empty if none."""

    points: RealArray
    lateral_unit: str
    height_unit: str


_ROLES = (
    ("x", ("x", "pos x", "position x", "x position", "x coordinate")),
    ("y", ("y", "pos y", "position y", "y position", "y coordinate")),
    ("z", ("z", "h", "height", "heights", "topography", "elevation")),
)


def point_columns(found: TextNumbers) -> PointColumns | None:
    """The list of points x y z that a text holds: three columns on more than three lines, or
    columns of these names."""
    if found.x is not None or found.y is not None or found.rows.shape[0] <= 3:
        return None
    plain = [re.sub(r"\s*[\(\[].*|[_ ](nm|um|µm|μm|mm|m)$", "", name.strip().lower()) for name in found.names]
    places = []
    for _, words in _ROLES:
        at = [place for place, name in enumerate(plain) if name in words]
        places.append(at[0] if len(at) == 1 else None)
    if None in places:
        if found.rows.shape[1] != 3:
            return None
        places = [0, 1, 2]
    columns = [place for place in places if place is not None]
    units = [unit_of_name(found.names[place]) if found.names else "" for place in columns]
    if units[0] != units[1]:
        raise InputError(
            f"units of x and y in its list of points must be equal, but are {units[0] or 'unknown'} and "
            f"{units[1] or 'unknown'}"
        )
    return PointColumns(found.rows[:, columns], units[0], units[2])


def gridded(points: RealArray) -> tuple[RealArray, tuple[float, float]]:
    """Heights [x, y] of a list of ``points`` (n, 3) on a regular grid, and its spacing; NaN where a
    point is missing.

    Raises InputError if the points do not lie on a regular grid, or two on one node.
    """
    (i, dx), (j, dy) = (_nodes(points[:, axis], "xy"[axis]) for axis in (0, 1))
    nx, ny = int(i.max()) + 1, int(j.max()) + 1
    if nx * ny > _SPARSE * len(points):
        raise InputError(
            f"its three columns are no regular grid of points x y z: {len(points)} of {nx} x {ny} nodes{_MAP}",
            subject=_COLUMNS,
        )
    if len(np.unique(i * ny + j)) < len(points):
        raise InputError(
            f"its three columns, taken as points x y z, give several heights at one node{_MAP}", subject=_COLUMNS
        )
    heights = np.full((nx, ny), np.nan)
    heights[i, j] = points[:, 2]
    return heights, (dx, dy)


_COLUMNS = "points x y z in three columns"
_MAP = "; resample scattered points first, and save a map of three columns as .npy"


def _nodes(coordinates: RealArray, axis: str) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.int64]], float]:
    """Node numbers of ``coordinates`` and their step."""
    if not np.isfinite(coordinates).all():
        raise InputError(
            f"its three columns, taken as points x y z, have a coordinate {axis} that is no number{_MAP}",
            subject=_COLUMNS,
        )
    places = np.unique(coordinates)
    extent = float(places[-1] - places[0])
    gaps = np.diff(places)
    gaps = gaps[gaps > 1e-6 * extent]
    steps = round(extent / float(np.median(gaps))) if gaps.size else 0
    if steps == 0:
        raise InputError(
            f"its three columns, taken as points x y z, have one value of {axis} only{_MAP}", subject=_COLUMNS
        )
    step = extent / steps
    numbers = np.rint((coordinates - places[0]) / step)
    if np.abs((coordinates - places[0]) / step - numbers).max() > _OFF_GRID:
        raise InputError(
            f"its three columns, taken as points x y z, are no regular grid: {places.size} values of {axis} from "
            f"{places[0]:g} to {places[-1]:g}{_MAP}",
            subject=_COLUMNS,
        )
    return numbers.astype(np.int64), step
