"""Linear system of one Newton step on stick and slip, by conjugate gradients preconditioned with
nested cells.

Where points stick both components of the traction are free; where they slip the traction turns on
its circle, so that one component along the tangent is free. With P the projection on what is free,
the step d solves

    (P C P + diag(|s| / B on slipping points)) d = P s,

the curvature |s|/B >= 0 being that of the circle: slipping points are better conditioned than
sticking ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np

from ....contact.solvers.active_set.spline_model import pixel_compliance
from ....core.arrays import BoolArray, RealArray
from ....core.engine import FreeSet
from ....core.engine.vectors import VectorCells
from ..operator import TangentialOperator
from .nested_cells import PIXEL_SHARE, hierarchies
from .problem import Points, Sets, free_part


class Fields(NamedTuple):
    """Traction and displacement, two components each, of products in one precision."""

    traction: tuple[RealArray, RealArray]
    displacement: tuple[RealArray, RealArray]


@dataclass(frozen=True, eq=False)
class Workspace:
    """Arrays for products with the compliance of ``operator`` on ``points``, in the precision
    ``dtype``.

    Nothing but zeros is outside the points in the fields.
    """

    operator: TangentialOperator
    points: Points
    free: FreeSet
    fields: Fields
    cells: VectorCells
    pixel: float
    dtype: str

    @classmethod
    def of(cls, operator: TangentialOperator, points: Points, dtype: str) -> Workspace:
        """Workspace with fields of its own."""
        engine, shape = operator.engine, operator.grid.shape
        fields = [engine.field(shape, dtype) for _ in range(4)]
        periodic = all(operator.boundary.wraps)
        mean = operator.mean if periodic else None
        nested = hierarchies(operator.octaves, operator.grid, periodic=periodic, share=PIXEL_SHARE, mean=mean)
        return cls(
            operator=operator,
            points=points,
            free=engine.points(shape, points.index, dtype),
            fields=Fields((fields[0], fields[1]), (fields[2], fields[3])),
            cells=VectorCells(engine, shape, nested, dtype),
            pixel=PIXEL_SHARE * pixel_compliance(operator.octaves, operator.grid),
            dtype=dtype,
        )

    def product(self, values: RealArray) -> RealArray:
        """C times ``values`` (2, n) at the points."""
        for component, field in zip(values, self.fields.traction, strict=True):
            self.free.scatter(component, field)
        self.operator.convolution(self.dtype).apply(self.fields.traction, self.fields.displacement)
        out = np.empty_like(values)
        for component, field in zip(out, self.fields.displacement, strict=True):
            self.free.gather_products(field, component, component, component)
        return out


@dataclass(frozen=True, eq=False)
class NewtonSystem:
    """System of one step with the sets of an iterate, everything divided by the deflection
    ``pixel`` of a point under its own load.

    ``tangent`` (2, n) is that of the circle at slipping points, ``curvature`` (n,) the diagonal
    there, and ``conductance`` (3, n) by how much a point yields along x, along y under a load along
    x, and along y, over what one that sticks does.
    """

    work: Workspace
    slip: BoolArray
    tangent: RealArray
    curvature: RealArray
    conductance: RealArray
    uniform: tuple[RealArray, RealArray] | None

    @classmethod
    def of(cls, work: Workspace, sets: Sets, *, zero_sum: bool) -> NewtonSystem:
        """System at ``sets``; if ``zero_sum`` steps sum to zero, and residuals count up to a
        uniform shift."""
        kind, slip = work.dtype, sets.slip
        tangent = sets.tangent
        bound = np.where(slip, work.points.bound, 1.0)
        curvature = np.where(slip, sets.outward / bound / work.pixel, 0.0)
        x, y = tangent
        share = 1.0 / (1.0 + curvature)
        conductance = np.stack([np.where(slip, x * x * share, 1.0), x * y * share, np.where(slip, y * y * share, 1.0)])
        conductance = conductance.astype(kind)
        work.cells.factorise(work.free, conductance)
        system = cls(work, slip, tangent.astype(kind), curvature.astype(kind), conductance, None)
        if not zero_sum:
            return system
        # the preconditioned uniform residuals, by which steps are kept to a sum of zero
        ones = np.zeros((2, 2, len(slip)), kind)
        ones[0, 0], ones[1, 1] = 1.0, 1.0
        solved = np.stack([work.cells.solve(work.free, system.free_part(each), conductance) for each in ones])
        sums = solved.sum(axis=2, dtype=np.float64)  # (shift, component)
        return replace(system, uniform=(solved, np.linalg.pinv(sums.T)))

    def free_part(self, values: RealArray) -> RealArray:
        """P times ``values`` (2, n)."""
        return free_part(self.slip, self.tangent, values)

    def product(self, values: RealArray) -> RealArray:
        """The matrix times ``values`` (2, n), which are P times something."""
        scaled = self.work.product(values) * values.dtype.type(1.0 / self.work.pixel)
        return self.free_part(scaled) + self.curvature * values

    def preconditioned(self, r: RealArray) -> RealArray:
        """Approximate inverse times ``r`` (2, n), of zero sum where steps are."""
        z = self.work.cells.solve(self.work.free, r, self.conductance)
        if self.uniform is not None:
            solved, inverse = self.uniform
            weights = (inverse @ z.sum(axis=1, dtype=np.float64)).astype(z.dtype)
            z -= np.tensordot(weights, solved, axes=1)
        return z

    def solved(self, r: RealArray, reduction: float, most: int) -> tuple[RealArray, int]:
        """Step (2, n) for the residual ``r`` = P s over ``pixel``, and the number of products it
        took.

        The residual falls by ``reduction`` in the norm of the preconditioner, or ``most`` products
        are made.
        """
        d, taken, first = np.zeros_like(r), 0, 0.0
        direction, response, curvature = r, r, 0.0
        while taken < most:
            z = self.preconditioned(r)
            size = _dot(z, r)
            if size <= 0.0 or (taken and size < reduction**2 * first):
                break
            first = first or size
            if taken:
                z -= r.dtype.type(_dot(z, response) / curvature) * direction
            direction = z
            response = self.product(direction)
            curvature = _dot(direction, response)
            if curvature <= 0.0:
                break
            length = r.dtype.type(_dot(direction, r) / curvature)
            d += length * direction
            r = r - length * response
            taken += 1
        return d, taken


class GeneralSystem(Protocol):
    """Linear system that need not be symmetric, of vectors (k, n)."""

    def product(self, z: RealArray) -> RealArray:
        """The matrix times ``z``."""

    def preconditioned(self, r: RealArray) -> RealArray:
        """Approximate inverse times ``r``."""


def gmres(system: GeneralSystem, r: RealArray, reduction: float, most: int) -> tuple[RealArray, int]:
    """Solution of ``system`` for the residual ``r`` (k, n), and the number of products it took
    (Saad & Schultz 1986).

    Preconditioned from the right. The residual falls by ``reduction``, or ``most`` products are
    made.
    """
    size = math.sqrt(_dot(r, r))
    if size == 0.0:
        return np.zeros_like(r), 0
    basis, steps = np.empty((most + 1, r.size), r.dtype), np.empty((most, r.size), r.dtype)
    basis[0] = r.reshape(-1) / r.dtype.type(size)
    hessenberg, right = np.zeros((most + 1, most)), np.zeros(most + 1)
    right[0] = size
    for taken in range(1, most + 1):
        known = basis[:taken]
        z = system.preconditioned(known[-1].reshape(r.shape))
        steps[taken - 1] = z.reshape(-1)
        new = system.product(z).reshape(-1)
        for _ in range(2):  # once more, because of rounding in single precision
            along = known @ new
            new -= along @ known
            hessenberg[:taken, taken - 1] += along
        length = math.sqrt(float(new @ new))
        hessenberg[taken, taken - 1] = length
        matrix, wanted = hessenberg[: taken + 1, :taken], right[: taken + 1]
        weights = np.linalg.lstsq(matrix, wanted, rcond=None)[0]
        left = float(np.linalg.norm(wanted - matrix @ weights))
        if left <= reduction * size or length == 0.0:
            break
        basis[taken] = new / r.dtype.type(length)
    return np.asarray(weights.astype(r.dtype) @ steps[:taken]).reshape(r.shape), taken


def _dot(a: RealArray, b: RealArray) -> float:
    return float(np.einsum("ij,ij->", a, b, dtype=np.float64))
