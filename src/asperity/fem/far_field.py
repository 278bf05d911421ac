"""What lies beyond the boundary of an axisymmetric mesh: a support by which a point load has
exactly its displacement in the half-space."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ..core.arrays import RealArray
from ..core.quadrature import rule
from ..solids.elastic import Elastic
from .mesh import Mesh


def point_load(r: RealArray, z: RealArray, solid: Elastic) -> tuple[RealArray, RealArray]:
    """Displacement (…, 2) along r and z in m, and stress (…, 3) rr, zz, rz in Pa, under a unit load
    into a half-space (Johnson 1985, eqs 3.18, 3.19); r > 0."""
    nu, G = solid.poisson_ratio, solid.shear_modulus
    R, part = np.hypot(r, z), 1.0 - 2.0 * nu
    moved = np.stack([r * z / R**3 - part * (R - z) / (R * r), z**2 / R**3 + 2.0 * (1.0 - nu) / R], axis=-1)
    rr = part * (1.0 - z / R) / r**2 - 3.0 * z * r**2 / R**5
    stress = np.stack([rr, -3.0 * z**3 / R**5, -3.0 * r * z**2 / R**5], axis=-1)
    return moved / (4.0 * np.pi * G), stress / (2.0 * np.pi)


def exterior(mesh: Mesh, solid: Elastic) -> sparse.csc_array:
    """Stiffness (unknowns, unknowns) of the half-space ``solid`` outside ``mesh``, in N/m, for the
    field of a load at the origin.

    The boundary is pushed back by its forces f under a unit load when it moves, weighed by f, as
    far as under a unit load: f f^T/(f^T u). What is left out falls as the square of contact radius
    over distance or faster, where a fixed boundary errs by 0.6 of the first power.
    """
    pushed = np.zeros((len(mesh.points), 2))
    places, weights = rule(4)
    for line, normal in ((mesh.lower, 1), (mesh.side(), 0)):  # whose outer normal is z or r
        line = line[np.argsort(mesh.points[line, 1 - normal])]
        start, end = mesh.points[line[:-1]], mesh.points[line[1:]]
        for place, weight in zip(0.5 * (1.0 + places), 0.5 * weights, strict=True):
            at = start + place * (end - start)
            _, stress = point_load(at[:, 0], at[:, 1], solid)
            traction = stress[:, [2, 1]] if normal else stress[:, [0, 2]]
            area = 2.0 * np.pi * at[:, 0] * np.linalg.norm(end - start, axis=1) * weight
            np.add.at(pushed, line[:-1], ((1.0 - place) * area)[:, None] * traction)
            np.add.at(pushed, line[1:], (place * area)[:, None] * traction)
    forces = pushed.ravel()
    edge = np.union1d(mesh.lower, mesh.side())
    places = mesh.points[edge]
    moved, _ = point_load(np.maximum(places[:, 0], 1e-9 * places.max()), places[:, 1], solid)
    unknowns = (2 * edge[:, None] + np.arange(2)).ravel()
    own = forces[unknowns]
    block = np.outer(own, own) / -float(own @ moved.ravel())
    rows, columns = np.repeat(unknowns, len(own)), np.tile(unknowns, len(own))
    size = len(forces)
    return sparse.csc_array(sparse.coo_array((block.ravel(), (rows, columns)), shape=(size, size)))
