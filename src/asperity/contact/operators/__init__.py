"""Pressure to displacement on a grid: prepared once, applied many times."""

from ...core.engine import Engine
from ...core.errors import InputError
from ...core.grid import Grid
from ...solids.compliance.halfspace import Compliance
from ..boundary import Boundary, Free, FreeLine, Periodic
from .convolution import FreeOperator, PeriodicOperator
from .protocol import Operator

__all__ = ["FreeOperator", "Operator", "PeriodicOperator", "prepare_operator"]


def prepare_operator(
    compliance: Compliance, grid: Grid, boundary: Boundary, *, engine: Engine | None = None
) -> Operator:
    """Pressure-displacement operator, to be held by the caller and reused in further solves of the same problem.

    Parameters
    ----------
    compliance
        Solid, usually ``problem.compliance``.
    grid
        Grid of pressure and displacement, ``problem.grid``.
    boundary
        ``Periodic()``, ``Free()`` or ``FreeLine()``, ``problem.boundary``.
    engine
        Machine to compute on; the CPU with ASPERITY_THREADS or all cores by default.

    Raises
    ------
    InputError
        If the boundary is none of them, or the grid is no line where it must be.
    """
    if isinstance(boundary, Periodic):
        return PeriodicOperator(compliance, grid, engine=engine)
    if isinstance(boundary, Free | FreeLine):
        return FreeOperator(compliance, grid, boundary, engine=engine)
    raise InputError(f"boundary of an operator must be Periodic(), Free() or FreeLine(), but is {boundary!r}.")
