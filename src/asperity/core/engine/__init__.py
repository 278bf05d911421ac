"""Machines to compute on: the CPU with compiled passes, or any array-API library."""

from .array_api import ArrayEngine
from .cpu import CpuEngine
from .protocol import (
    Cells,
    CellWaves,
    Convolution,
    Engine,
    Face,
    Hierarchy,
    Load,
    Merge,
    Products,
    Survey,
    Totals,
    Violation,
)

__all__ = [
    "ArrayEngine",
    "CellWaves",
    "Cells",
    "Convolution",
    "CpuEngine",
    "Engine",
    "Face",
    "Hierarchy",
    "Load",
    "Merge",
    "Products",
    "Survey",
    "Totals",
    "Violation",
]
