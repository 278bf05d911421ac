"""Bodies in space: bricks between three sets of planes, graded beneath a track, halved by a plane
of symmetry."""

from __future__ import annotations

import math

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..solids.layers import Bonded, Layered, RigidBase
from .elements import GAUSS, Elements, mean_dilatation
from .mesh import IntArray, Mesh, Resolution, graded_line

BRICK = np.array([[i, j, k] for i in (-1.0, 1.0) for j in (-1.0, 1.0) for k in (-1.0, 1.0)])
"""Corners of a brick, z running fastest."""


def brick_mesh(x: RealArray, y: RealArray, z: RealArray, region: IntArray) -> Mesh:
    """Bricks between the planes ``x``, ``y`` and ``z`` (m); ``region`` (len(z) - 1,) is that of
    each layer of bricks. Points run down first, then along y."""
    points = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    ny, nz = len(y), len(z)
    i, j, k = np.meshgrid(np.arange(len(x) - 1), np.arange(ny - 1), np.arange(nz - 1), indexing="ij")
    corner = ((i * ny + j) * nz + k).ravel()
    steps = (BRICK > 0.0) @ np.array([ny * nz, nz, 1])
    cells = corner[:, None] + steps.astype(np.intp)
    return Mesh(points, cells, np.asarray(region, dtype=np.intp)[k.ravel()])


def track_lines(
    body: Layered, radius: float, resolution: Resolution, ends: tuple[float, float]
) -> tuple[RealArray, RealArray, RealArray, IntArray]:
    """Lines x, y >= 0 and z of a mesh beneath contacts of at most ``radius`` (m) centred between
    the ``ends`` (m) of a track along x, and the region of each row.

    Elements have their finest size a/across up to a quarter radius beside the track and down to
    ``depth`` radii.

    Raises
    ------
    InputError
        If an interface slips, or the ends are not in order.
    """
    reduced = body.reduced
    if not all(isinstance(layer.interface, Bonded) for layer in reduced.layers):
        raise InputError("interface of a meshed layer must be Bonded(), but is Frictionless().")
    first, last = ends
    a, fine, growth = (
        require.positive(radius, "largest contact radius (m)"),
        radius / resolution.across,
        resolution.growth,
    )
    if not last >= first:
        raise InputError(f"ends of the track (m) must be in order, but are {first:g} and {last:g}.")
    reach, far = 1.25 * a, resolution.distance * a

    def along(x: RealArray) -> RealArray:
        size: RealArray = fine + (growth - 1.0) * np.maximum(np.maximum(first - reach - x, x - last - reach), 0.0)
        return size

    def across(y: RealArray) -> RealArray:
        size: RealArray = fine + (growth - 1.0) * np.maximum(y - reach, 0.0)
        return size

    middle = 0.5 * (first + last)
    right = graded_line(np.array([middle, last + far]), along)
    left = graded_line(np.array([-middle, far - first]), lambda x: along(-x))
    x = np.concatenate([-left[:0:-1], right])
    steps = np.cumsum([layer.thickness for layer in reduced.layers])
    bounds = np.concatenate(
        [[0.0], steps, [] if isinstance(reduced.base, RigidBase) else [max(far, 4.0 * steps.max(initial=0.0))]]
    )

    def down(z: RealArray) -> RealArray:
        size: RealArray = fine + (growth - 1.0) * np.maximum(z - resolution.depth * a, 0.0)
        for top, bottom in zip(bounds[:-1], steps, strict=False):
            outside = np.maximum(np.maximum(top - z, z - bottom), 0.0)
            size = np.minimum(size, (bottom - top) / resolution.per_layer + (growth - 1.0) * outside)
        return size

    z = graded_line(bounds, down)
    region = np.searchsorted(bounds[1:], 0.5 * (z[1:] + z[:-1]))
    return x, graded_line(np.array([0.0, far]), across), z, region


def bricks(mesh: Mesh) -> Elements:
    """Bricks of a ``mesh`` in space with 2 x 2 x 2 Gauss points, free of locking (B-bar); unknowns
    u_x, u_y, u_z of each point."""
    corners = mesh.points[mesh.cells]
    places = BRICK * GAUSS
    linear = 1.0 + places[:, None, :] * BRICK
    values = linear.prod(axis=-1) / 8.0
    slopes = (
        np.stack([BRICK[:, axis] * np.delete(linear, axis, axis=-1).prod(axis=-1) for axis in range(3)], axis=-1) / 8.0
    )
    jacobian = np.einsum("pka,ckb->cpab", slopes, corners)
    gradients = np.einsum("cpba,pka->cpkb", np.linalg.inv(jacobian), slopes)
    weights = np.linalg.det(jacobian)
    strain_of = np.zeros((*weights.shape, 6, 24))
    for row, (first, second) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))):
        strain_of[:, :, row, first::3] = gradients[..., second]
        strain_of[:, :, row, second::3] = gradients[..., first]
    unknowns = (3 * mesh.cells[:, :, None] + np.arange(3)).reshape(len(mesh.cells), 24)
    place = np.einsum("pk,ckx->cpx", values, corners)
    return Elements(
        mean_dilatation(strain_of, weights),
        weights,
        unknowns,
        place,
        mesh.region,
        3 * len(mesh.points),
        tuple(range(6)),
    )


def tributary(lines: tuple[RealArray, ...]) -> RealArray:
    """Area (length in the plane) in m² that each point of a surface between ``lines`` stands for, x
    first."""
    found = np.ones(1)
    for line in lines:
        half = 0.5 * np.diff(line)
        found = np.multiply.outer(found, np.append(half, 0.0) + np.append(0.0, half))
    return found.ravel() if lines else np.full(1, math.nan)
