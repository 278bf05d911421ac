"""Incremental normal stiffness of a contact."""

from __future__ import annotations

import math

import numpy as np

from ..core.arrays import RealArray
from .operators.protocol import Operator
from .solvers.active_set.linear_system import Effort, System, bench, correction

_EFFORT = Effort(reduction=1e-4, limit=500)


def normal_stiffness(operator: Operator, pressure: RealArray, cap: float | RealArray) -> float:
    """Incremental stiffness d(mean pressure)/d(approach) in Pa/m, from one linear solve on the elastic contact.

    Infinite for full contact on a periodic half-space, zero without elastic contact points, NaN if the linear solve
    does not converge. Points at the cap yield and carry no increment (loading). The error is of second order in the
    relative residual, which is 1e-4: what remains is the rounding of single precision, below 1e-6.
    """
    engine, shape = operator.engine, operator.grid.shape
    tools = bench(operator, "float32", float(operator.kernel.max()) or 1.0)
    p, flat = engine.array(pressure, "float64"), engine.zeros(shape, "float64")
    bound = None if np.all(np.isinf(cap)) else engine.array(np.asarray(cap, dtype=float).reshape(-1), "float64")
    face = engine.survey(p, flat, flat, bound).face(0.0, 1.0, tools.dtype)  # u = h: the points between the bounds
    if face.size == 0:
        return 0.0
    if face.size == operator.grid.n_points and operator.zero_mean_mode:
        return math.inf
    unit, _ = face.pick(engine.array(np.ones(shape), tools.dtype))
    found = correction(System(tools, face, centred=False), unit, _EFFORT)
    if not found.reached:
        return math.nan
    face.lay(found.d, tools.field)
    _, total = face.pick(tools.field)
    return total / tools.scale / operator.grid.n_points
