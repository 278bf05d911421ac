"""Where stresses are: homogeneous regions of a body, planes in them with both sides of interfaces,
and points of a plane."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Frictionless, Layered

Side: TypeAlias = Literal["surface", "inside", "above", "below"]
"""Position of a plane in its region: on the loaded surface, inside, just above or just below an
interface."""

_SAME = 1e-9  # relative difference of depths that are one and the same


@dataclass(frozen=True)
class Region:
    """Homogeneous part of a body: its ``material`` between the depths ``top`` and ``bottom`` (m,
    infinite for a half-space).

    ``name`` is that of the material if it has one, else "layer 1", … or "substrate".
    """

    index: int
    name: str
    material: Elastic
    top: float
    bottom: float


@dataclass(frozen=True)
class Plane:
    """Plane parallel to the surface at ``depth`` (m) whose points belong to ``region``."""

    depth: float
    region: Region
    side: Side

    @property
    def local_depth(self) -> float:
        """Depth below the top of the region in m."""
        return self.depth - self.region.top


def stack(body: object) -> Layered:
    """``body`` as layers of finite, positive thickness on a base.

    InputError if the body is rigid or no body: nothing is known about the stress in it.
    """
    if isinstance(body, Elastic):
        return Layered((), body)
    if isinstance(body, Rigid):
        raise InputError("body in which stresses are asked must deform, but is rigid; ask for the other body.")
    if not isinstance(body, Layered):
        raise InputError(f"body in which stresses are asked must be Elastic or Layered, but is {body!r}.")
    return body.reduced


def regions(body: object) -> tuple[Region, ...]:
    """Regions of ``body`` from the surface down; a rigid base is none. InputError if the body is
    rigid or no body."""
    layers = stack(body)
    found: list[Region] = []
    top = 0.0
    for number, layer in enumerate(layers.layers):
        name = layer.material.name or f"layer {number + 1}"
        found.append(Region(number, name, layer.material, top, top + layer.thickness))
        top += layer.thickness
    if isinstance(layers.base, Elastic):
        found.append(Region(len(found), layers.base.name or "substrate", layers.base, top, math.inf))
    if not found:
        raise InputError("body in which stresses are asked must deform, but is a bare rigid base.")
    return tuple(found)


def slips(layers: Layered, plane: Plane) -> bool:
    """Whether ``plane`` is a side of an interface of ``layers`` (see ``stack``) that carries no
    shear traction."""
    upper = {"above": plane.region.index, "below": plane.region.index - 1}.get(plane.side)
    return upper is not None and isinstance(layers.layers[upper].interface, Frictionless)


def planes(body: object, depths: Iterable[float]) -> tuple[Plane, ...]:
    """Planes at ``depths`` (m, >= 0) in increasing order; a depth of an interface gives two, above
    and below it.

    InputError if a depth is negative, no number, or below a rigid base.
    """
    if not isinstance(depths, Iterable) or isinstance(depths, str):
        raise InputError(f"depths must be a list of depths in m, such as [0.0, 5e-9], but are {depths!r}.")
    parts = regions(body)
    found: list[Plane] = []
    for value in depths:
        depth = require.finite(value, "depth (m)")
        if depth < 0.0:
            raise InputError(f"depth (m) must be at least zero, but is {depth:g}; depths count from the surface down.")
        count = len(found)
        for region in parts:
            if depth == 0.0 and region.top == 0.0:
                found.append(Plane(0.0, region, "surface"))
            elif region.top > 0.0 and math.isclose(depth, region.top, rel_tol=_SAME):
                found.append(Plane(region.top, region, "below"))
            elif math.isclose(depth, region.bottom, rel_tol=_SAME):
                found.append(Plane(region.bottom, region, "above"))
            elif region.top < depth < region.bottom:
                found.append(Plane(depth, region, "inside"))
        if len(found) == count:
            raise InputError(
                f"depth (m) must lie in the body, whose rigid base is at {parts[-1].bottom:g}, but is {depth:g}."
            )
    if not found:
        raise InputError("depths must hold at least one depth (m), but are empty.")
    return tuple(sorted(found, key=lambda plane: (plane.depth, plane.region.index)))


_GRADING = 1.5  # power of the spacing below the lowest interface, where stresses vary ever more slowly


def depths_through(body: object, deepest: float, *, per_region: int = 12) -> RealArray:
    """Increasing depths in m from the surface of ``body`` to ``deepest`` (m), for ``stress``.

    Every layer has ``per_region`` equal intervals, so that both its faces are among the depths; the
    substrate has as many intervals down to ``deepest``, short ones first. Layers below ``deepest``
    are left out.

    InputError if the body is rigid, ``deepest`` is not positive or there is less than one interval.
    """
    limit = require.positive(deepest, "deepest depth (m)")
    count = require.integer(per_region, 1, "number of intervals in a region")
    share = np.arange(count + 1) / count
    found = [0.0]
    for region in regions(body):
        bottom = min(region.bottom, limit)
        if bottom > region.top:
            steps = share**_GRADING if math.isinf(region.bottom) else share
            found.extend((region.top + (bottom - region.top) * steps)[1:])
    return np.array(found)


# Points of every plane: all, a line along x or y (a vertical section of the body), or one (a depth
# profile).

Position: TypeAlias = float | Literal["pressure", "max"]
"""Coordinate in m, or "pressure" for that of the largest pressure; "max" is another word for it."""

_TOP = ("pressure", "max")


@dataclass(frozen=True)
class Everywhere:
    """All points of the grid."""


@dataclass(frozen=True)
class Section:
    """Vertical plane x = const or y = const through the grid line nearest to the position.

    InputError if none or both are given, or one is neither a number nor a word for a place.

    Parameters
    ----------
    x, y
        Exactly one of the two: position in m, or ``"pressure"`` (``"max"``) for the plane through
        the largest pressure.
    """

    x: Position | None = None
    y: Position | None = None

    def __post_init__(self) -> None:
        if (self.x is None) == (self.y is None):
            raise InputError(f"section must have exactly one of x and y, but has x={self.x!r}, y={self.y!r}.")
        _check(self.y if self.x is None else self.x, "position of a section (m)")


@dataclass(frozen=True)
class DepthProfile:
    """Line into the body at the grid point nearest to (x, y), by default under the largest
    pressure.

    InputError if a position is neither a number nor a word for a place.

    Parameters
    ----------
    x, y
        Position in m, or ``"pressure"`` (``"max"``) for that of the largest pressure.
    """

    x: Position = "max"
    y: Position = "max"

    def __post_init__(self) -> None:
        _check(self.x, "x of a depth profile (m)")
        _check(self.y, "y of a depth profile (m)")


Where: TypeAlias = Everywhere | Section | DepthProfile
"""Points of every plane."""


@dataclass(frozen=True, eq=False)
class Selection:
    """Points of a grid: ``index`` picks them from an array (nx, ny); their coordinates ``x`` and
    ``y`` in m.

    ``dims`` names the axes that are left, in order.
    """

    index: tuple[int | slice, int | slice]
    x: RealArray
    y: RealArray
    dims: tuple[str, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points along each axis that is left."""
        return tuple({"x": self.x, "y": self.y}[dim].size for dim in self.dims)


def selection(where: Where, grid: Grid, pressure: RealArray) -> Selection:
    """Points of ``grid`` at ``where``; words for a place mean where ``pressure`` is largest.

    InputError if ``where`` is of another type, or a position lies outside the grid.
    """
    if not isinstance(where, Everywhere | Section | DepthProfile):
        raise InputError(
            f"points of a plane must be Everywhere(), Section(...) or DepthProfile(...), but are {where!r}."
        )
    x, y = (line.ravel() for line in grid.coordinates())
    if isinstance(where, Everywhere):
        return Selection((slice(None), slice(None)), x, y, ("x", "y"))
    top = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
    if isinstance(where, DepthProfile):
        i, j = _nearest(where.x, x, int(top[0]), "x"), _nearest(where.y, y, int(top[1]), "y")
        return Selection((i, j), x[i], y[j], ())
    if where.x is not None:
        i = _nearest(where.x, x, int(top[0]), "x")
        return Selection((i, slice(None)), x[i], y, ("y",))
    assert where.y is not None
    j = _nearest(where.y, y, int(top[1]), "y")
    return Selection((slice(None), j), x, y[j], ("x",))


def _check(position: Position | None, what: str) -> None:
    if isinstance(position, str):
        if position not in _TOP:
            raise InputError(f"{what} must be a number or one of {', '.join(_TOP)}, but is {position!r}.")
    else:
        require.finite(position, what, "Write a position, or 'pressure' for that of the largest pressure.")  # type: ignore[arg-type]


def _nearest(position: Position, line: RealArray, top: int, axis: str) -> int:
    if isinstance(position, str):
        return top
    step = float(line[1] - line[0]) if line.size > 1 else np.inf
    if not line[0] - step <= position <= line[-1] + step:
        raise InputError(
            f"{axis} of a section or profile (m) must lie between 0 and {line[-1]:g} on this grid, but is {position:g}."
        )
    return int(np.argmin(np.abs(line - position)))
