"""Machines to compute on: the CPU with compiled passes, or any array-API library."""

from .cpu import CpuEngine
from .generic import ArrayEngine
from .protocol import Convolution, Engine, Face, Totals, Violation

__all__ = ["ArrayEngine", "Convolution", "CpuEngine", "Engine", "Face", "Totals", "Violation"]
