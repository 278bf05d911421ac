"""Elements as arrays: strains from displacements, forces from stresses, stiffness from tangents,
for any dimension.

An element is its matrix B, which gives the strains at its Gauss points, their weights and the
numbers of its unknowns. Strains of B are those of engineering (shear doubled), so that forces are
the sum of B^T stress; strains that are handed out are components of the tensor.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy import sparse

from ..core.arrays import RealArray
from ..solids.plasticity import WEIGHTS
from .mesh import IntArray, Mesh


@dataclass(frozen=True, eq=False)
class Elements:
    """Elements of one kind, with the pattern of their stiffness prepared.

    Attributes
    ----------
    strain_of
        B (elements, points, components, unknowns of an element).
    weights
        (elements, points) volume of each Gauss point in m³ (in m² in plane strain).
    unknowns
        (elements, unknowns of an element) numbers of the unknowns.
    places
        (elements, points, dimension) of the Gauss points in m.
    region
        (elements,) number of the material.
    size
        Number of all unknowns.
    components
        Which of xx, yy, zz, xy, xz, yz the rows of B are.
    """

    strain_of: RealArray
    weights: RealArray
    unknowns: IntArray
    places: RealArray
    region: IntArray
    size: int
    components: tuple[int, ...]
    pattern: Pattern = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "pattern", Pattern.of(self.unknowns, self.size))

    @property
    def shape(self) -> tuple[int, int]:
        """Number of elements and Gauss points of each."""
        return self.weights.shape[0], self.weights.shape[1]

    def strains(self, displacement: RealArray) -> RealArray:
        """Strain tensors (elements, points, 6) of the ``displacement`` (unknowns,) in m."""
        own = displacement[self.unknowns]
        found = np.zeros((*self.shape, 6))
        rows = list(self.components)
        flat = self.strain_of.reshape(len(own), -1, own.shape[1])
        engineering = (flat @ own[:, :, None]).reshape(*self.shape, len(rows))
        found[..., rows] = engineering / WEIGHTS[rows]
        return found

    def forces(self, stress: RealArray) -> RealArray:
        """Forces (unknowns,) in N that balance the ``stress`` (elements, points, 6) in Pa."""
        weighed = (stress[..., list(self.components)] * self.weights[..., None]).reshape(self.shape[0], 1, -1)
        own = (weighed @ self.strain_of.reshape(len(weighed), -1, self.unknowns.shape[1]))[:, 0]
        return np.bincount(self.unknowns.ravel(), own.ravel(), minlength=self.size).astype(float)

    def stiffnesses(self, tangent: RealArray, chosen: IntArray | slice = slice(None)) -> RealArray:
        """Matrices B^T C B of the ``chosen`` elements; ``tangent`` (chosen, points, 6, 6), or
        (chosen, 1, 6, 6) for all points of an element."""
        rows = list(self.components)
        strain_of = self.strain_of[chosen]
        small = tangent[..., rows, :][..., :, rows]
        turned = (small * self.weights[chosen][..., None, None]) @ strain_of
        count, _, _, unknowns = strain_of.shape
        flat = strain_of.reshape(count, -1, unknowns)
        found: RealArray = np.swapaxes(flat, 1, 2) @ turned.reshape(count, -1, unknowns)
        return found


@dataclass(frozen=True, eq=False)
class Pattern:
    """Where the entries of element matrices stand in the sparse matrix, by columns.

    Attributes
    ----------
    place
        (elements, n, n) position of each entry among the stored ones.
    rows, starts
        Of the compressed columns.
    size
        Number of unknowns.
    """

    place: IntArray
    rows: IntArray
    starts: IntArray
    size: int

    @classmethod
    def of(cls, unknowns: IntArray, size: int) -> Pattern:
        """Pattern of elements with ``unknowns`` (elements, n)."""
        key = unknowns[:, None, :] * size + unknowns[:, :, None]
        stored, place = np.unique(key, return_inverse=True)
        starts = np.searchsorted(stored, np.arange(size + 1) * size)
        return cls(place.reshape(key.shape), (stored % size).astype(np.int32), starts.astype(np.int32), size)

    def sum(self, matrices: RealArray, chosen: IntArray | slice = slice(None)) -> RealArray:
        """Stored entries of the sum of element ``matrices`` of the ``chosen`` elements."""
        return np.bincount(self.place[chosen].ravel(), matrices.ravel(), minlength=len(self.rows)).astype(float)

    def matrix(self, entries: RealArray) -> sparse.csc_array:
        """Sparse matrix with the stored ``entries``."""
        return sparse.csc_array((entries, self.rows, self.starts), shape=(self.size, self.size))


# Strains of quadrilaterals.

GAUSS = 1.0 / np.sqrt(3.0)
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def mean_dilatation(strain_of: RealArray, weights: RealArray) -> RealArray:
    """B with the change of volume at every point replaced by its mean over the element (B-bar,
    Hughes 1980): flow that keeps the volume does not lock.

    The first three components must be xx, yy, zz.
    """
    local = strain_of[:, :, :3].sum(axis=2)
    mean = np.einsum("cp,cpn->cn", weights, local) / weights.sum(axis=1)[:, None]
    found = strain_of.copy()
    found[:, :, :3] += ((mean[:, None] - local) / 3.0)[:, :, None]
    return found


def _in_the_plane(mesh: Mesh, axisymmetric: bool) -> Elements:
    """Bilinear shape functions at 2 x 2 Gauss points."""
    corners = mesh.points[mesh.cells]
    linear = 1.0 + (CORNERS * GAUSS)[:, None, :] * CORNERS
    values = 0.25 * linear[..., 0] * linear[..., 1]
    slopes = 0.25 * np.stack([CORNERS[:, 0] * linear[..., 1], CORNERS[:, 1] * linear[..., 0]], axis=-1)
    jacobian = np.einsum("pka,ckb->cpab", slopes, corners)
    gradients = np.einsum("cpba,pka->cpkb", np.linalg.inv(jacobian), slopes)
    weights = np.linalg.det(jacobian)
    places = np.einsum("pk,ckx->cpx", values, corners)
    strain_of = np.zeros((*weights.shape, 4, 8))
    strain_of[:, :, 0, 0::2] = gradients[..., 0]
    strain_of[:, :, 2, 1::2] = gradients[..., 1]
    strain_of[:, :, 3, 0::2] = gradients[..., 1]
    strain_of[:, :, 3, 1::2] = gradients[..., 0]
    if axisymmetric:
        strain_of[:, :, 1, 0::2] = values / places[..., :1]
        weights = weights * 2.0 * np.pi * places[..., 0]
    unknowns = (2 * mesh.cells[:, :, None] + np.arange(2)).reshape(len(mesh.cells), 8)
    return Elements(
        mean_dilatation(strain_of, weights), weights, unknowns, places, mesh.region, 2 * len(mesh.points), (0, 1, 2, 4)
    )


def axisymmetric(mesh: Mesh) -> Elements:
    """Rings of quadrilaterals of a ``mesh`` in (r, z), free of locking; unknowns u_r, u_z of each
    point; xx, yy, zz, xz are rr, θθ, zz, rz."""
    return _in_the_plane(mesh, True)


def plane_strain(mesh: Mesh) -> Elements:
    """Quadrilaterals of a ``mesh`` in (x, z) without strain along y, free of locking; unknowns u_x,
    u_z of each point; weights per metre of y."""
    return _in_the_plane(mesh, False)
