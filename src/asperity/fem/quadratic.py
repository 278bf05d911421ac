"""Quadrilaterals of nine points: displacements that are quadratic along both sides, for elastic
bodies whose answer is wanted to many digits."""

from __future__ import annotations

import numpy as np

from ..core.arrays import RealArray
from .elements import Elements
from .mesh import IntArray, Mesh

POINTS = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)])
"""Gauss points on a side of length 2."""

WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0


def quadratic_mesh(x: RealArray, z: RealArray) -> Mesh:
    """Rectangles of nine points between the lines ``x`` and ``z`` in m, each increasing, with at
    least two lines; points run down first, those of a cell too. One region."""
    across, down = _with_middles(x), _with_middles(z)
    points = np.stack(np.meshgrid(across, down, indexing="ij"), axis=-1).reshape(-1, 2)
    corner = 2 * (np.arange(len(x) - 1)[:, None] * len(down) + np.arange(len(z) - 1)).ravel()
    own = (np.arange(3)[:, None] * len(down) + np.arange(3)).ravel()
    cells = (corner[:, None] + own).astype(np.intp)
    return Mesh(points, cells, np.zeros(len(cells), dtype=np.intp))


def quadratic_rings(mesh: Mesh) -> Elements:
    """Rings of a ``quadratic_mesh`` in (r, z); unknowns u_r, u_z of each point; xx, yy, zz, xz are
    rr, θθ, zz, rz."""
    return _nine_points(mesh, rings=True)


def quadratic_plane_strain(mesh: Mesh) -> Elements:
    """Rectangles of a ``quadratic_mesh`` in (x, z) without strain along y; unknowns u_x, u_z of
    each point; weights per metre of y."""
    return _nine_points(mesh, rings=False)


def shape_functions(places: RealArray) -> tuple[RealArray, RealArray]:
    """Values and slopes (places, 3) of the three quadratic functions at ``places`` between -1
    and 1."""
    s = np.asarray(places)
    values = np.stack([0.5 * s * (s - 1.0), 1.0 - s**2, 0.5 * s * (s + 1.0)], axis=-1)
    return values, np.stack([s - 0.5, -2.0 * s, s + 0.5], axis=-1)


def cornered_line(length: float, parts: int, finest: float, ends: tuple[bool, bool]) -> RealArray:
    """Lines from 0 to ``length`` in m: ``parts`` equal ones, of which those at the ``ends`` asked
    for are halved again and again until they are shorter than ``finest`` parts; for the
    singularity of a corner."""
    halves = 0.5 ** np.arange(1, 1 + max(0, int(np.ceil(-np.log2(finest)))))
    inner = np.arange(parts + 1.0)
    low = halves if ends[0] else halves[:0]
    high = parts - halves if ends[1] else halves[:0]
    found: RealArray = np.unique(np.concatenate([inner, low, high])) * (length / parts)
    return found


def _with_middles(line: RealArray) -> RealArray:
    """Lines, and the middles between them."""
    found = np.empty(2 * len(line) - 1)
    found[0::2] = line
    found[1::2] = 0.5 * (line[1:] + line[:-1])
    return found


def _nine_points(mesh: Mesh, *, rings: bool) -> Elements:
    """Biquadratic shape functions at 3 x 3 Gauss points of rectangles."""
    line, slope = shape_functions(POINTS)
    values, along, below = (np.kron(a, b) for a, b in ((line, line), (slope, line), (line, slope)))
    corners = mesh.points[mesh.cells]
    sides = corners[:, -1] - corners[:, 0]
    x_slope = 2.0 * along[None] / sides[:, 0, None, None]
    z_slope = 2.0 * below[None] / sides[:, 1, None, None]
    weights = 0.25 * (sides[:, 0] * sides[:, 1])[:, None] * np.outer(WEIGHTS, WEIGHTS).ravel()
    places = np.einsum("pk,ckx->cpx", values, corners)
    strain_of = np.zeros((len(corners), 9, 4, 18))
    strain_of[:, :, 0, 0::2] = x_slope
    strain_of[:, :, 2, 1::2] = z_slope
    strain_of[:, :, 3, 0::2] = z_slope
    strain_of[:, :, 3, 1::2] = x_slope
    if rings:
        strain_of[:, :, 1, 0::2] = values / places[..., :1]
        weights = weights * 2.0 * np.pi * places[..., 0]
    unknowns: IntArray = (2 * mesh.cells[:, :, None] + np.arange(2)).reshape(len(corners), 18)
    return Elements(strain_of, weights, unknowns, places, mesh.region, 2 * len(mesh.points), (0, 1, 2, 4))
