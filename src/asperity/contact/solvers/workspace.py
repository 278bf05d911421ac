"""What the fast solver works in: prepared convolutions and buffers of one problem."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.engine import Convolution, Engine
from .protocol import ContactQP, FixedOffset


@dataclass(frozen=True, eq=False)
class Workspace:
    """Prepared convolutions and buffers of one problem. Lengths are in m, the kernels over ``scale`` (m/Pa)."""

    engine: Engine
    heights: Any
    cap: Any
    double: Convolution
    fast: Convolution
    preconditioner: Convolution
    scale: float
    field: Any
    response: Any
    pressures: tuple[Any, Any]
    deflections: tuple[Any, Any]


def workspace(qp: ContactQP, precision: str) -> Workspace:
    """Workspace of ``qp`` with corrections in single (``"mixed"``) or double precision (``"double"``)."""
    operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
    dtype = "float64" if precision == "double" else "float32"
    kernel = operator.kernel
    scale = float(kernel.max()) or 1.0
    datum = -qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else 0.0
    heights = qp.profile + datum if datum else qp.profile - qp.profile.mean()
    fast = operator.convolution(dtype, scale)
    return Workspace(
        engine=engine,
        heights=engine.array(heights, "float64"),
        cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), "float64"),
        double=operator.convolution("float64"),
        fast=fast,
        preconditioner=operator.preconditioner(fast, dtype, scale),
        scale=scale,
        field=engine.field(shape, dtype),
        response=engine.field(shape, dtype),
        pressures=(engine.zeros(shape, "float64"), engine.zeros(shape, "float64")),
        deflections=(engine.zeros(shape, "float64"), engine.zeros(shape, "float64")),
    )
