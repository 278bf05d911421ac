"""Machines to compute on: the CPU; in ``gpu`` and ``array_api``, which few runs need, a GPU and any
array-API library."""

from .cpu import CpuEngine
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
    UnevenSplines,
    Violation,
)

__all__ = [
    "SQUARE_SIDE",
    "Clipped",
    "Convolution",
    "CpuEngine",
    "Engine",
    "FreeSet",
    "Load",
    "Products",
    "SplineModel",
    "Splines",
    "Survey",
    "Totals",
    "UnevenSplines",
    "Violation",
]
