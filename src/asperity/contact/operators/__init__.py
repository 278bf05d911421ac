"""Pressure to displacement on a grid: prepared once, applied many times."""

from .convolution import FreeOperator, Operator, PeriodicOperator, prepare_operator

__all__ = ["FreeOperator", "Operator", "PeriodicOperator", "prepare_operator"]
