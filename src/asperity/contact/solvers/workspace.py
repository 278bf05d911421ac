"""What the fast solver works in: prepared convolutions and buffers of one problem."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Cells, Convolution, Engine
from ..operators.protocol import Operator
from .cell_waves import Waves, waves_of
from .cells import OWN_SHARE, OWN_SHARE_BELOW_WAVES, hierarchies, pixel_compliance
from .protocol import ContactQP, FixedOffset

_OFF_CENTRE = 10.0


@dataclass(frozen=True, eq=False)
class Bench:
    """What linear systems on a working set are solved with, in the precision ``dtype``.

    ``fast`` is the product with the compliance over ``scale`` (m/Pa), from ``field`` to ``response``.
    """

    operator: Operator
    dtype: str
    scale: float
    fast: Convolution
    field: Any
    response: Any

    @property
    def engine(self) -> Engine:
        """Machine that does it."""
        return self.operator.engine

    @cached_property
    def cells(self) -> Cells:
        """Nested cells that follow the compliance."""
        operator = self.operator
        periodic = all(operator.boundary.wraps)
        nested = hierarchies(operator.octaves, operator.grid, periodic=periodic, share=self._share)
        waves = None if self.waves is None else self.waves.form
        return self.engine.cells(operator.grid.shape, nested, waves, self.dtype)

    @cached_property
    def waves(self) -> Waves | None:
        """True compliance that takes the place of large cells, where it can."""
        return waves_of(self.operator)

    @cached_property
    def cell_unit(self) -> float:
        """Deflection of a point under its own load in the model of nested cells, over ``scale``."""
        return self._share * pixel_compliance(self.operator.octaves, self.operator.grid) / self.scale

    @property
    def _share(self) -> float:
        return OWN_SHARE if self.waves is None else OWN_SHARE_BELOW_WAVES

    @cached_property
    def inverse(self) -> Convolution:
        """Convolution whose ``solve`` divides by the compliance, nearly."""
        return self.operator.preconditioner(self.fast, self.dtype, self.scale)


def bench(operator: Operator, dtype: str, scale: float) -> Bench:
    """Bench of ``operator`` with buffers of its own."""
    engine, shape = operator.engine, operator.grid.shape
    fields = engine.field(shape, dtype), engine.field(shape, dtype)
    return Bench(operator, dtype, scale, operator.convolution(dtype, scale), *fields)


@dataclass(frozen=True, eq=False)
class Workspace:
    """Arrays of one problem and the bench for its corrections.

    ``pressure`` and ``deflection`` (Pa, m; in the precision ``dtype``) are the iterate, changed in place; ``exact`` is
    the convolution that makes the one from the other.
    """

    qp: ContactQP
    bench: Bench
    dtype: str
    heights: Any
    cap: Any
    exact: Convolution
    pressure: Any
    deflection: Any

    @property
    def unit(self) -> float:
        """Pressure (Pa) of one in a correction."""
        return self.qp.height_scale / self.bench.scale

    @property
    def engine(self) -> Engine:
        """Machine it is on."""
        return self.bench.engine


def workspace(qp: ContactQP, precision: str, start: RealArray) -> Workspace:
    """Workspace of ``qp`` with the pressure ``start`` (Pa), which it may take over.

    ``precision`` is ``"double"``, ``"single"``, or ``"mixed"`` for corrections in single and the rest in double.
    """
    operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
    state = "float32" if precision == "single" else "float64"
    pressure, deflection = engine.array(start, state), engine.zeros(shape, state)
    exact = operator.convolution(state)
    exact.apply(pressure, deflection)
    scale = float(operator.kernel.max()) or 1.0
    return Workspace(
        qp=qp,
        bench=bench(operator, "float64" if precision == "double" else "float32", scale),
        dtype=state,
        heights=engine.array(_centred(qp, always=precision == "single"), state),
        cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), state),
        exact=exact,
        pressure=pressure,
        deflection=deflection,
    )


def _centred(qp: ContactQP, *, always: bool) -> RealArray:
    """Heights from the prescribed position; at prescribed load any level serves, and a copy is made only where it pays."""
    if isinstance(qp.constraint, FixedOffset):
        return qp.profile - qp.constraint.offset if qp.constraint.offset else qp.profile
    mean = float(qp.profile.mean())
    return qp.profile - mean if always or abs(mean) > _OFF_CENTRE * qp.height_scale else qp.profile
