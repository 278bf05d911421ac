"""Conjugate gradients on a set of points, preconditioned with the inverse of the compliance of the
waves."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import BoolArray, RealArray
from ..operators.convolution import Operator, PeriodicOperator, spectral_kernel


class Until(NamedTuple):
    """When conjugate gradients end: at this ``reduction`` of the residual, or after ``most``
    products."""

    reduction: float
    most: int


def inverse_of_waves(operator: Operator) -> Operator:
    """Inverse of the compliance of the waves on the grid; the mean as the longest wave."""
    periodic = operator.padded == operator.grid.shape
    waves = operator.kernel if periodic else spectral_kernel(operator.compliance, operator.grid)
    return inverse_by(waves, operator)


def inverse_by(waves: RealArray, operator: Operator) -> Operator:
    """Inverse on the grid of ``operator`` of the compliances (m/Pa) of its ``waves``; the mean as
    the longest wave."""
    kernel = np.array(waves, dtype=float)
    kernel[0, 0] = 0.0
    largest = float(kernel.max()) or 1.0
    kernel[0, 0] = largest
    return PeriodicOperator(operator.compliance, operator.grid, kernel=1.0 / np.maximum(kernel, 1e-9 * largest))


def solved_on(
    operator: Operator,
    inverse: Operator,
    gap: RealArray,
    free: BoolArray,
    *,
    balanced: bool,
    until: Until,
) -> tuple[RealArray, int]:
    """Change of pressure (Pa) on ``free`` that closes ``gap`` (m) there, about, and the products
    with the ``operator`` that it took.

    A ``balanced`` change sums to zero and closes the gap but for a constant. The residual, in the
    norm of ``inverse`` (see ``inverse_of_waves``), ends at the reduction of ``until``.
    """

    def on_free(field: RealArray) -> RealArray:
        found: RealArray = np.where(free, field, 0.0)
        return found

    uniform: Any = on_free(inverse.apply(free.astype(float))) if balanced else None

    def preconditioned(residual: RealArray) -> RealArray:
        z = on_free(inverse.apply(residual))
        return z - (z.sum() / uniform.sum()) * uniform if balanced else z

    found, residual = np.zeros_like(gap), on_free(-gap)
    z = preconditioned(residual)
    direction, norm = z, float((residual * z).sum())
    enough = until.reduction**2 * norm
    for count in range(until.most):
        response = on_free(operator.apply(direction))
        curvature = float((direction * response).sum())
        if not (norm > 0.0 and curvature > 0.0):
            return found, count + 1
        found = found + (norm / curvature) * direction
        residual = residual - (norm / curvature) * response
        z = preconditioned(residual)
        before, norm = norm, float((residual * z).sum())
        if norm <= enough:
            return found, count + 1
        direction = z + (norm / before) * direction
    return found, until.most
