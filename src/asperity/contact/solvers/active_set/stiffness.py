"""Normal stiffness of a contact: one linear solve by the conjugate gradients of the fast solver."""

from __future__ import annotations

import math

import numpy as np

from ....core.arrays import BoolArray
from ...operators import Operator
from .linear_system import LinearSystem, ScaledOperator, Stopping, conjugate_gradients

_STOPPING = Stopping(reduction=1e-4, max_steps=500)


def normal_stiffness(operator: Operator, moving: BoolArray) -> float:
    """Incremental stiffness d(mean pressure)/d(approach) in Pa/m, from one linear solve on the points ``moving`` (nx, ny).

    Infinite for full contact on a periodic half-space, zero without elastic contact points, NaN if the linear solve
    does not converge. They are the points of elastic contact: those at the cap yield and carry no increment (loading). The error is of second order in the
    relative residual, which is 1e-4: what remains is the rounding of single precision, below 1e-6.
    """
    engine, shape = operator.engine, operator.grid.shape
    scaled = ScaledOperator.of(operator, "float32", float(operator.kernel.max()) or 1.0)
    p, flat = engine.array(moving.astype(float), "float64"), engine.zeros(shape, "float64")
    survey = engine.survey(p, flat, flat, None)  # u = h: no point enters, and the residual is the level
    free = survey.free_set(np.zeros((*survey.squares.shape[:2], 2)), 1.0, 1.0, scaled.dtype)
    if free.size == 0:
        return 0.0
    if free.size == operator.grid.n_points and operator.zero_mean_mode:
        return math.inf
    unit = free.residual(centred=False)
    found = conjugate_gradients(LinearSystem(scaled, free, zero_sum=False), unit, _STOPPING)
    if not found.reached or found.d is None:
        return math.nan
    free.scatter(found.d, scaled.field)
    total = free.gather_products(scaled.field, found.d, found.d, free.empty()).total
    return total / scaled.scale / operator.grid.n_points
