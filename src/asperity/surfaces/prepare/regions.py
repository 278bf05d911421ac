"""Regions of a map whose points are taken as missing: rectangles, ellipses and polygons.

Lengths are measured from the corner of the map, where pixel i covers i·dx to (i + 1)·dx; a point
belongs to a region if the middle of its pixel lies inside.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from typing import Annotated, TypeAlias

import numpy as np

from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import Declared, checked
from ...core.values import Angle, Length, LengthRange, SignedLength
from ..surface import Surface, lines_too


@dataclass(frozen=True)
class Rectangle(Declared):
    """Points of a rectangle, which reaches over the full side where ``x`` or ``y`` is left out.

    Both are pairs of lengths in m from the corner of the map. Raises InputError if a range is
    reversed, or both are left out.
    """

    x: Annotated[LengthRange | None, "ends of a rectangle along x, from the corner"] = None
    y: Annotated[LengthRange | None, "ends of a rectangle along y, from the corner"] = None

    def __post_init__(self) -> None:
        """Check the ranges."""
        super().__post_init__()
        if self.x is None and self.y is None:
            raise InputError("rectangle of a mask must have a range along x or y or both, but has none.")

    def covers(self, grid: Grid) -> BoolArray:
        """Points (nx, ny) of ``grid`` inside."""
        inside = [
            np.ones(count, dtype=bool) if ends is None else (place >= ends[0]) & (place <= ends[1])
            for ends, count, place in zip((self.x, self.y), grid.shape, _middles(grid), strict=True)
        ]
        return np.asarray(inside[0][:, None] & inside[1][None, :])


@dataclass(frozen=True)
class Ellipse(Declared):
    """Points of an ellipse about its ``centre``, whose first semi-axis stands at ``angle`` from +x
    towards +y.

    Centre and ``radii`` are pairs of lengths in m, the former from the corner of the map, the angle
    is in rad. Raises InputError if a radius is not positive.
    """

    centre: Annotated[tuple[SignedLength, SignedLength], "middle of an ellipse along x and y, from the corner"]
    radii: Annotated[tuple[Length, Length], "semi-axes of an ellipse"]
    angle: Annotated[Angle, "angle of its first semi-axis from +x towards +y"] = 0.0

    def covers(self, grid: Grid) -> BoolArray:
        """Points (nx, ny) of ``grid`` inside."""
        x, y = _middles(grid)
        dx, dy = (x - self.centre[0])[:, None], (y - self.centre[1])[None, :]
        cosine, sine = math.cos(self.angle), math.sin(self.angle)
        along, across = (cosine * dx + sine * dy) / self.radii[0], (cosine * dy - sine * dx) / self.radii[1]
        return np.asarray(along**2 + across**2 <= 1.0)


@dataclass(frozen=True)
class Polygon(Declared):
    """Points of a polygon; where its sides cross one another, those enclosed an odd number of
    times.

    Its corners are ``x`` and ``y`` (n,) in m from the corner of the map. Raises InputError if there
    are fewer than three, or not as many x as y.
    """

    x: Annotated[tuple[SignedLength, ...], "corners of a polygon along x, from the corner of the map"]
    y: Annotated[tuple[SignedLength, ...], "corners of a polygon along y, from the corner of the map"]

    def __post_init__(self) -> None:
        """Check the corners."""
        super().__post_init__()
        if len(self.x) != len(self.y) or len(self.x) < 3:
            raise InputError(
                f"polygon of a mask must have at least three corners, each with x and y, but has {len(self.x)} along x "
                f"and {len(self.y)} along y."
            )

    def covers(self, grid: Grid) -> BoolArray:
        """Points (nx, ny) of ``grid`` inside: rows change sides where a side of the polygon crosses
        them."""
        (nx, ny), (dx, _), (_, rows) = grid.shape, grid.spacing, _middles(grid)
        changes = np.zeros((nx + 1, ny), dtype=bool)
        x, y = np.array(self.x, dtype=float), np.array(self.y, dtype=float)
        for x0, y0, x1, y1 in zip(x, y, np.roll(x, -1), np.roll(y, -1), strict=True):
            first, last = np.searchsorted(rows, (min(y0, y1), max(y0, y1)))
            crossed = x0 + (rows[first:last] - y0) * ((x1 - x0) / (y1 - y0)) if last > first else rows[:0]
            place = np.ceil(np.clip(crossed / dx - 0.5, 0.0, nx)).astype(int)
            changes[place, np.arange(first, last)] ^= True
        return np.asarray(np.logical_xor.accumulate(changes[:-1], axis=0))


Region: TypeAlias = Rectangle | Ellipse | Polygon
"""A shape on a map."""


def _middles(grid: Grid) -> tuple[RealArray, RealArray]:
    """Middles of the pixels of ``grid`` along x (nx,) and y (ny,), in m from its corner."""
    x, y = ((np.arange(count) + 0.5) * spacing for count, spacing in zip(grid.shape, grid.spacing, strict=True))
    return x, y


@lines_too
@checked
def masked(
    surface: Surface,
    regions: Annotated[tuple[Region, ...], "rectangles, ellipses and polygons, any number of them"],
    *,
    invert: Annotated[bool, "keep only the points inside the regions of a mask"] = False,
) -> Surface:
    """Surface whose points inside the ``regions`` are missing from now on; with ``invert`` those
    outside all of them.

    Points that are missing already stay so, and heights that stay are not changed. Of a line scan
    regions are ranges along x: rectangles. Raises InputError if there is no region, one covers no
    point of the surface, or no valid point would be left.
    """
    if not regions:
        raise InputError("mask must have at least one region, such as a rectangle, but has none.")
    inside = np.zeros(surface.shape, dtype=bool)
    for number, region in enumerate(regions, start=1):
        if not isinstance(region, Rectangle | Ellipse | Polygon):
            raise InputError(f"region {number} of a mask must be a Rectangle, Ellipse or Polygon, but is {region!r}.")
        name = type(region).__name__.lower()
        if surface.shape[1] == 1 and not isinstance(region, Rectangle):
            raise InputError(
                f"region {number} of a mask must be a rectangle with a range along x on a line scan, but is of the "
                f"kind {name}."
            )
        covered = region.covers(surface.grid)
        if not covered.any():
            size = " x ".join(f"{side:g}" for side, count in zip(surface.size, surface.shape, strict=True) if count > 1)
            raise InputError(
                f"region {number} of a mask must cover at least one point of the surface, which extends over {size} m "
                f"from its corner, but the {name} covers none; correct its lengths, or leave it out."
            )
        inside |= covered
    taken = ~inside if invert else inside
    if (surface.mask | taken).all():
        raise InputError(
            f"mask must leave at least one valid point, but would take all {surface.heights.size} points of the "
            "surface; make its regions smaller."
        )
    kinds = Counter(type(region).__name__.lower() for region in regions)
    named = ", ".join(name if count == 1 else f"{count} {name}s" for name, count in kinds.items())
    step = f"masked: {taken.sum()} of {taken.size} points {'outside' if invert else 'inside'} {named}"
    mask = surface.mask | taken
    return Surface(
        surface.heights,
        surface.dx,
        surface.dy,
        periodic=surface.periodic,
        mask=mask,
        origin=surface.origin.continued(step),
    )
