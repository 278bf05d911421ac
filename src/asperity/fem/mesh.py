"""Meshes of layered half-spaces: fine under the contact, growing geometrically to a far boundary, a
line at each interface."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..solids.layers import Bonded, Layered, RigidBase

IntArray = NDArray[np.intp]


@dataclass(frozen=True)
class Resolution:
    """How fine a mesh is and how far it reaches; lengths in radii a at which the indenter would cut
    the undeformed surface at its deepest.

    Parameters
    ----------
    across
        Elements over a, >= 4. The elastic load of a sphere is within 0.1 % at 40, stresses within
        some per cent.
    per_layer
        Elements over the thickness of each layer, >= 1, unless ``across`` asks for more.
    depth
        Down to which the elements keep their size, > 0.
    growth
        Size of an element over that of its inner neighbour, beyond, 1 to 2.
    distance
        From the axis to the far boundary, at least 4; ten thicknesses of all layers are added. If
        it is fixed, approaches are too small by some 0.6/distance of themselves; with the support
        of ``far_field.exterior`` by less than 1/distance².
    radius
        a in m where it shall not follow from the indenter and the steps; None: it does.
    """

    across: int = 40
    per_layer: int = 6
    depth: float = 0.8
    growth: float = 1.1
    distance: float = 40.0
    radius: float | None = None

    def __post_init__(self) -> None:
        require.integer(self.across, 4, "elements across the contact radius")
        require.integer(self.per_layer, 1, "elements over a layer")
        require.positive(self.depth, "depth of the fine mesh (contact radii)")
        require.between(self.growth, 1.0, 2.0, "growth of elements")
        if require.positive(self.distance, "distance of the far boundary (contact radii)") < 4.0:
            raise InputError(
                f"distance of the far boundary (contact radii) must be at least 4, but is {self.distance:g}."
            )
        if self.radius is not None:
            require.magnitude(self.radius, "radius of the fine mesh (m)")


@dataclass(frozen=True, eq=False)
class Mesh:
    """Cells between points.

    Attributes
    ----------
    points
        (n, dimension) in m: (r, z) or (x, z) in the plane, (x, y, z) in space; z into the body.
    cells
        (cells, corners) numbers of points; corners of quadrilaterals run from x to z.
    region
        (cells,) number of the region: layers from the surface down, then the base.
    """

    points: RealArray
    cells: IntArray
    region: IntArray

    @property
    def surface(self) -> IntArray:
        """Points at z = 0, in the order of x."""
        found = np.flatnonzero(self.points[:, -1] == 0.0)
        return found[np.argsort(self.points[found, 0], kind="stable")]

    @property
    def lower(self) -> IntArray:
        """Points of the far boundary below."""
        return np.flatnonzero(self.points[:, -1] == self.points[:, -1].max())

    def side(self, sign: int = 1) -> IntArray:
        """Points with the largest x, or for ``sign`` -1 the smallest, which is the axis of a mesh
        in r."""
        x = sign * self.points[:, 0]
        return np.flatnonzero(x == x.max())


def layered_mesh(body: Layered, radius: float, resolution: Resolution, *, both_sides: bool = False) -> Mesh:
    """Quadrilaterals from the axis (``both_sides``: from the far left) to the far boundary, beneath
    a contact of at most ``radius`` in m.

    Raises
    ------
    InputError
        If an interface slips.
    """
    reduced, fine = body.reduced, radius / resolution.across
    if not all(isinstance(layer.interface, Bonded) for layer in reduced.layers):
        raise InputError("interface of a meshed layer must be Bonded(), but is Frictionless().")
    steps = np.cumsum([layer.thickness for layer in reduced.layers])
    far = radius * resolution.distance + 10.0 * float(steps.max(initial=0.0))
    ends = steps if isinstance(reduced.base, RigidBase) else np.append(steps, far)
    starts = np.append(0.0, ends)

    def beside(x: RealArray, reach: float) -> RealArray:
        """Wanted size of elements in m at the distance ``x`` from the contact, whose fine mesh
        reaches ``reach`` radii."""
        size: RealArray = fine + (resolution.growth - 1.0) * np.maximum(np.abs(x) - reach * radius, 0.0)
        return size

    def below(z: RealArray) -> RealArray:
        """At the depth ``z``, fine enough for every layer."""
        size = beside(z, resolution.depth)
        for top, bottom in pairwise(starts[: len(steps) + 1]):
            away = np.maximum(np.maximum(top - z, z - bottom), 0.0)
            own = (bottom - top) / resolution.per_layer + (resolution.growth - 1.0) * away
            size = np.minimum(size, own)
        return size

    across = graded_line(np.array([0.0, radius, far]), lambda x: beside(x, 1.0))
    if both_sides:
        across = np.concatenate([-across[:0:-1], across])
    down = graded_line(starts, below)
    region = np.searchsorted(ends, 0.5 * (down[1:] + down[:-1]))
    return tensor_mesh(across, down, region)


def graded_line(bounds: RealArray, size: Callable[[RealArray], RealArray]) -> RealArray:
    """Points from the first of ``bounds`` to the last, all of which are points, whose distances in
    m follow ``size`` of the place."""
    pieces = [bounds[:1]]
    for low, high in pairwise(bounds):
        inner = np.geomspace(1.0, 1e6, 4001)
        sample = low + (high - low) * (inner - 1.0) / (inner[-1] - 1.0)
        rate = 1.0 / size(sample)
        count = np.append(0.0, np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(sample)))
        number = max(1, math.ceil(count[-1] - 1e-9))
        line = np.interp(np.arange(1, number + 1) * count[-1] / number, count, sample)
        line[-1] = high
        pieces.append(line)
    return np.concatenate(pieces)


def tensor_mesh(x: RealArray, z: RealArray, region: IntArray) -> Mesh:
    """Rectangles between the lines ``x`` and ``z`` (m); ``region`` (len(z) - 1,) is that of each
    row. Points run down first."""
    points = np.stack(np.meshgrid(x, z, indexing="ij"), axis=-1).reshape(-1, 2)
    corner = (np.arange(len(x) - 1)[:, None] * len(z) + np.arange(len(z) - 1)).ravel()
    cells = corner[:, None] + np.array([0, len(z), len(z) + 1, 1])
    return Mesh(points, cells.astype(np.intp), np.tile(region, len(x) - 1).astype(np.intp))
