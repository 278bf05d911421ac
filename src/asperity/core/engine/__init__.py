"""Machines to compute on: the CPU with compiled passes, or any array-API library."""

from .array_api import ArrayEngine
from .cpu import CpuEngine
from .protocol import (
    SQUARE_SIDE,
    Cells,
    Clipped,
    CoarseCompliance,
    Convolution,
    Engine,
    FreeSet,
    Hierarchy,
    Load,
    Merge,
    Products,
    Survey,
    Totals,
    Violation,
)

__all__ = [
    "SQUARE_SIDE",
    "ArrayEngine",
    "Cells",
    "Clipped",
    "CoarseCompliance",
    "Convolution",
    "CpuEngine",
    "Engine",
    "FreeSet",
    "Hierarchy",
    "Load",
    "Merge",
    "Products",
    "Survey",
    "Totals",
    "Violation",
]
