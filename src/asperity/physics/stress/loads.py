"""Loads at a point, along a line and on a rectangle, shared out among the pixels of a grid."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.values import Number, Several

Vector: TypeAlias = tuple[float, float]
"""Two numbers, along x and along y."""

Place: TypeAlias = Annotated[Vector, Several(Number("length"), 2)]
PerLength: TypeAlias = Annotated[Vector, Several(Number("surface tension"), 2)]
Forces: TypeAlias = Annotated[Vector, Several(Number("force"), 2)]
Shears: TypeAlias = Annotated[Vector, Several(Number("pressure"), 2)]


class PrescribedLoad(Protocol):
    """A load that can be distributed over the pixels of a grid."""

    def on(self, grid: Grid, *, wraps: bool) -> RealArray:
        """Shear along x and along y and pressure in Pa, (3, nx, ny); what leaves the grid comes
        back if it ``wraps``."""


@dataclass(frozen=True)
class PointLoad:
    """A force at a point of the surface.

    The four nearest pixels share it so that force and moments are exact. At a depth of z below
    pixels of Δ the stresses differ from those of a point by about (Δ/z)² relatively.

    InputError if a number is not finite.

    Parameters
    ----------
    at
        Point (x, y) in m on the grid, whose node (0, 0) is the origin.
    normal
        Force in N into the body.
    tangential
        Forces (x, y) in N along the surface.
    """

    at: Annotated[Place, "point (x, y)"]
    normal: Annotated[float, Number("force"), "force into the body"] = 0.0
    tangential: Annotated[Forces, "forces (x, y) along the surface"] = (0.0, 0.0)

    def __post_init__(self) -> None:
        _finite_pair(self.at, "place of a point load (m)")
        require.finite(self.normal, "normal force of a point load (N)")
        _finite_pair(self.tangential, "tangential force of a point load (N)")

    def on(self, grid: Grid, *, wraps: bool) -> RealArray:
        """The load on the pixels of ``grid``."""
        if grid.shape[1] == 1:
            raise InputError(
                "point load must be on a grid of several points along y, but this grid has one, along which everything "
                "goes on unchanged: use a LineLoad along y."
            )
        values = np.array([*self.tangential, self.normal]) / grid.pixel_area
        return values[:, None, None] * _shared(grid, np.array([self.at]), np.ones(1), wraps=wraps)


@dataclass(frozen=True)
class LineLoad:
    """A force per length along a straight line on the surface.

    As many point loads as there are quarters of a pixel in it.

    InputError if a number is not finite, or the line has no length.

    Parameters
    ----------
    start, end
        Ends (x, y) in m. On a grid of one point along y the line runs along y and only its x
        counts.
    normal
        Force per length in N/m into the body.
    tangential
        Forces per length (x, y) in N/m along the surface.
    """

    start: Annotated[Place, "one end (x, y)"]
    end: Annotated[Place, "the other end (x, y)"]
    normal: Annotated[float, Number("surface tension"), "force per length into the body"] = 0.0
    tangential: Annotated[PerLength, "forces per length (x, y) along the surface"] = (0.0, 0.0)

    def __post_init__(self) -> None:
        _finite_pair(self.start, "start of a line load (m)")
        _finite_pair(self.end, "end of a line load (m)")
        require.finite(self.normal, "normal force of a line load (N/m)")
        _finite_pair(self.tangential, "tangential force of a line load (N/m)")
        if self.start == self.end:
            raise InputError(f"end of a line load (m) must differ from its start, but both are {self.start}.")

    def on(self, grid: Grid, *, wraps: bool) -> RealArray:
        """The load on the pixels of ``grid``."""
        values = np.array([*self.tangential, self.normal])[:, None, None]
        start, end = np.array(self.start), np.array(self.end)
        if grid.shape[1] == 1:
            if self.start[0] != self.end[0]:
                raise InputError(
                    "line load on a grid of one point along y must run along y, but goes from x = "
                    f"{self.start[0]:g} to {self.end[0]:g} m."
                )
            nodes, shares = _neighbours(start[:1], grid, 0, wraps=wraps)
            total = np.zeros(grid.shape)
            np.add.at(total[:, 0], nodes[0], shares[0])
            return values / grid.spacing[0] * total
        length = math.hypot(*(end - start))
        count = math.ceil(4.0 * length / min(grid.spacing))
        places = start + (np.arange(count)[:, None] + 0.5) / count * (end - start)
        return values / grid.pixel_area * _shared(grid, places, np.full(count, length / count), wraps=wraps)


@dataclass(frozen=True)
class PatchLoad:
    """Uniform pressure and shear traction on a rectangle along the axes.

    Pixels at its edges carry the part that covers them, so that force and moments are exact; a
    rectangle whose edges lie between pixels (half a pixel beside a node) is itself exact on a free
    boundary.

    InputError if a number is not finite or a range empty.

    Parameters
    ----------
    x, y
        Ranges (from, to) in m. On a grid of one point along y the patch is a strip and ``y`` does
        not count.
    pressure
        In Pa, positive in compression.
    shear
        Shear tractions (x, y) in Pa.
    """

    x: Annotated[Place, "range (from, to) along x"]
    y: Annotated[Place, "range (from, to) along y"]
    pressure: Annotated[float, Number("pressure"), "pressure, positive in compression"] = 0.0
    shear: Annotated[Shears, "shear tractions (x, y)"] = (0.0, 0.0)

    def __post_init__(self) -> None:
        for axis, ends in (("x", self.x), ("y", self.y)):
            what = f"range of a patch along {axis} (m)"
            _finite_pair(ends, what)
            if not ends[0] < ends[1]:
                raise InputError(f"{what} must run from a smaller to a larger number, but is {ends}.")
        require.finite(self.pressure, "pressure of a patch (Pa)")
        _finite_pair(self.shear, "shear traction of a patch (Pa)")

    def on(self, grid: Grid, *, wraps: bool) -> RealArray:
        """The load on the pixels of ``grid``."""
        along_x = _covered(self.x, grid, 0, wraps=wraps)
        along_y = np.ones(1) if grid.shape[1] == 1 else _covered(self.y, grid, 1, wraps=wraps)
        return np.array([*self.shear, self.pressure])[:, None, None] * np.multiply.outer(along_x, along_y)


def _finite_pair(values: Vector, what: str) -> None:
    for value in require.two(values, what, "Write (x, y)."):
        require.finite(value, what)


def _neighbours(positions: RealArray, grid: Grid, axis: int, *, wraps: bool) -> tuple[NDArray[np.intp], RealArray]:
    """Of each position in m along ``axis`` the two nearest nodes (n, 2) and their shares (n, 2)."""
    count, step = grid.shape[axis], grid.spacing[axis]
    place = positions / step
    if not wraps and not np.all((place >= -1e-9) & (place <= count - 1 + 1e-9)):
        outside = positions[int(np.argmax(np.abs(place - 0.5 * (count - 1))))]
        raise InputError(
            f"{'xy'[axis]} of a load must lie between the first and the last node, 0 and {(count - 1) * step:g} m, "
            f"on a boundary that does not repeat, but is {outside:g}: use a larger grid or another origin."
        )
    low = np.floor(place)
    share = place - low
    nodes = (low[:, None] + np.array([0.0, 1.0])).astype(int)
    nodes = nodes % count if wraps else np.clip(nodes, 0, count - 1)
    return nodes, np.stack([1.0 - share, share], axis=1)


def _shared(grid: Grid, places: RealArray, amounts: RealArray, *, wraps: bool) -> RealArray:
    """Sum (nx, ny) of ``amounts`` (n,) at ``places`` (n, 2) in m, each shared by its four nearest
    pixels."""
    i, share_x = _neighbours(places[:, 0], grid, 0, wraps=wraps)
    j, share_y = _neighbours(places[:, 1], grid, 1, wraps=wraps)
    total = np.zeros(grid.shape)
    weights = amounts[:, None, None] * share_x[:, :, None] * share_y[:, None, :]
    np.add.at(total, (i[:, :, None], j[:, None, :]), weights)
    return total


def _covered(ends: Vector, grid: Grid, axis: int, *, wraps: bool) -> RealArray:
    """Part of every pixel along ``axis`` that the range ``ends`` in m covers."""
    count, step = grid.shape[axis], grid.spacing[axis]
    low, high = ends
    edges = (np.arange(count) - 0.5) * step
    first, last = float(edges[0]), float(edges[0]) + count * step
    what = f"range of a patch along {'xy'[axis]} (m)"
    if high - low > (last - first) * (1.0 + 1e-9):
        raise InputError(f"{what} must be no longer than the grid, {last - first:g}, but is {high - low:g}.")
    if not wraps and not (low >= first - 1e-9 * step and high <= last + 1e-9 * step):
        raise InputError(
            f"{what} must lie on the grid, from {first:g} to {last:g}, on a boundary that does not repeat, but "
            f"is {ends}."
        )
    turns = np.arange(math.floor((first - high) / (last - first)), 2 + math.ceil((last - low) / (last - first)))
    shifts = turns * (last - first) if wraps else np.zeros(1)
    lows, highs = low + shifts[:, None], high + shifts[:, None]
    covered = np.minimum(highs, edges + step) - np.maximum(lows, edges)
    return np.asarray(np.clip(covered, 0.0, None).sum(axis=0) / step)
