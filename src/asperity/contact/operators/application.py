"""Applying a prepared operator to pressures of the host."""

from __future__ import annotations

from ...core.arrays import RealArray
from .protocol import Operator


def displacement(operator: Operator, pressure: RealArray) -> RealArray:
    """New array (nx, ny) of the displacement (m) that ``operator`` gives under ``pressure`` (Pa), in double precision."""
    engine = operator.engine
    field, out = engine.array(pressure, "float64"), engine.zeros(operator.grid.shape, "float64")
    return engine.numpy(operator.convolution("float64").apply(field, out))
