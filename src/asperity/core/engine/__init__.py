"""Machines to compute on: the CPU with compiled passes, or any array-API library."""

from .cpu import CpuEngine
from .protocol import Convolution, Engine, Face, Totals, Violation

__all__ = ["Convolution", "CpuEngine", "Engine", "Face", "Totals", "Violation"]
