"""Machines to compute on: the CPU or a GPU with compiled passes, or any array-API library."""

from .array_api import ArrayEngine
from .cpu import CpuEngine
from .gpu import GpuEngine
from .protocol import (
    SQUARE_SIDE,
    Clipped,
    Convolution,
    Engine,
    FreeSet,
    Load,
    Products,
    SplineModel,
    Splines,
    Survey,
    Totals,
    Violation,
)

__all__ = [
    "SQUARE_SIDE",
    "ArrayEngine",
    "Clipped",
    "Convolution",
    "CpuEngine",
    "Engine",
    "FreeSet",
    "GpuEngine",
    "Load",
    "Products",
    "SplineModel",
    "Splines",
    "Survey",
    "Totals",
    "Violation",
]
