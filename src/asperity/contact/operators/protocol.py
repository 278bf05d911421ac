"""What a solver may ask of a pressure-displacement operator."""

from __future__ import annotations

from typing import Protocol

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...solids.compliance.protocol import Compliance
from ..boundary import Boundary


class Operator(Protocol):
    """Linear, symmetric, positive semi-definite map from pressure (Pa) to normal displacement (m) on a grid."""

    @property
    def grid(self) -> Grid:
        """Grid of pressure and displacement."""

    @property
    def compliance(self) -> Compliance:
        """Solid it was prepared for."""

    @property
    def boundary(self) -> Boundary:
        """Boundary it was prepared for."""

    @property
    def zero_mean_mode(self) -> bool:
        """Whether a uniform pressure gives no displacement (periodic half-space: its datum is the mean)."""

    @property
    def pairs_per_application(self) -> float:
        """Cost of one application in real FFT pairs of the grid."""

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (nx, ny) in m under ``pressure`` (nx, ny) in Pa; a new array."""

    def matrix(self) -> RealArray:
        """Dense symmetric matrix (n, n) in m/Pa over the n = nx·ny points in C order; for small grids only."""
