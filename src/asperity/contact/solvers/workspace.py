"""What the fast solver works in: prepared convolutions and buffers of one problem."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Cells, Convolution, Engine
from .cells import hierarchies
from .protocol import ContactQP, FixedOffset

_OFF_CENTRE = 10.0


@dataclass(frozen=True, eq=False)
class Workspace:
    """Prepared convolutions and buffers of one problem. Lengths are in m, the kernels over ``scale`` (m/Pa).

    ``pressure`` and ``deflection`` are the iterate, changed in place; ``field`` and ``response`` go through ``fast``,
    in the precision ``dtype`` of the corrections; ``exact`` is the convolution that makes the deflection.
    """

    qp: ContactQP
    engine: Engine
    state_dtype: str
    dtype: str
    heights: Any
    cap: Any
    exact: Convolution
    fast: Convolution
    scale: float
    field: Any
    response: Any
    pressure: Any
    deflection: Any

    @cached_property
    def cells(self) -> Cells:
        """Nested cells that follow the compliance."""
        operator = self.qp.operator
        nested = hierarchies(operator.compliance, operator.grid)
        return self.engine.cells(operator.grid.shape, nested, self.dtype)

    @cached_property
    def inverse(self) -> Convolution:
        """Convolution whose ``solve`` divides by the compliance, nearly."""
        return self.qp.operator.preconditioner(self.fast, self.dtype, self.scale)


def workspace(qp: ContactQP, precision: str, start: RealArray) -> Workspace:
    """Workspace of ``qp`` with the pressure ``start`` (Pa), which it may take over.

    ``precision`` is ``"double"``, ``"single"``, or ``"mixed"`` for corrections in single and the rest in double.
    """
    operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
    state = "float32" if precision == "single" else "float64"
    dtype = "float64" if precision == "double" else "float32"
    scale = float(operator.kernel.max()) or 1.0
    pressure, deflection = engine.array(start, state), engine.zeros(shape, state)
    exact = operator.convolution(state)
    exact.apply(pressure, deflection)
    return Workspace(
        qp=qp,
        engine=engine,
        state_dtype=state,
        dtype=dtype,
        heights=engine.array(_centred(qp, always=precision == "single"), state),
        cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), state),
        exact=exact,
        fast=operator.convolution(dtype, scale),
        scale=scale,
        field=engine.field(shape, dtype),
        response=engine.field(shape, dtype),
        pressure=pressure,
        deflection=deflection,
    )


def _centred(qp: ContactQP, *, always: bool) -> RealArray:
    """Heights from the prescribed position; at prescribed load any level serves, and a copy is made only where it pays."""
    if isinstance(qp.constraint, FixedOffset):
        return qp.profile - qp.constraint.offset if qp.constraint.offset else qp.profile
    mean = float(qp.profile.mean())
    return qp.profile - mean if always or abs(mean) > _OFF_CENTRE * qp.height_scale else qp.profile
