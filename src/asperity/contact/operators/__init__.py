"""Pressure to displacement on a grid: prepared once, applied many times."""

from ...core.engine import Engine
from ...core.grid import Grid
from ...solids.compliance.protocol import Compliance
from ..boundary import Boundary, Periodic
from .free import FreeOperator
from .periodic import PeriodicOperator
from .protocol import Operator

__all__ = ["FreeOperator", "Operator", "PeriodicOperator", "prepare_operator"]


def prepare_operator(compliance: Compliance, grid: Grid, boundary: Boundary, *, engine: Engine | None = None) -> Operator:
    """Operator of ``compliance`` on ``grid`` with ``boundary``; hold on to it to reuse it in further solves."""
    if isinstance(boundary, Periodic):
        return PeriodicOperator(compliance, grid, engine=engine)
    return FreeOperator(compliance, grid, engine=engine)
