"""What a solver may ask of a pressure-displacement operator."""

from __future__ import annotations

from typing import Protocol

from ...core.arrays import RealArray
from ...core.engine import Convolution, Engine
from ...core.grid import Grid
from ...solids.compliance.protocol import Compliance
from ..boundary import Boundary
from .octaves import Octaves


class Operator(Protocol):
    """Linear, symmetric, positive semi-definite map from pressure (Pa) to normal displacement (m) on a grid."""

    @property
    def grid(self) -> Grid:
        """Grid of pressure and displacement."""

    @property
    def compliance(self) -> Compliance:
        """Solid it was prepared for."""

    @property
    def octaves(self) -> Octaves:
        """Its values at a few wavenumbers, shared with the operators of coarser grids."""

    @property
    def boundary(self) -> Boundary:
        """Boundary it was prepared for."""

    @property
    def zero_mean_mode(self) -> bool:
        """Whether a uniform pressure gives no displacement (periodic half-space: its datum is the mean)."""

    @property
    def pairs_per_application(self) -> float:
        """Cost of one application in real FFT pairs of the grid."""

    @property
    def engine(self) -> Engine:
        """Machine that applies it."""

    @property
    def kernel(self) -> RealArray:
        """Compliance (m/Pa) on the half spectrum of the grid or of its padded form; the largest entry sets the scale."""

    @property
    def padded(self) -> tuple[int, int]:
        """Shape of the grid whose half spectrum ``kernel`` holds."""

    @property
    def coarsened(self) -> Operator:
        """Operator of the same solid on half as many points per side."""

    def convolution(self, dtype: str, scale: float = 1.0) -> Convolution:
        """Prepared application, divided by ``scale``, on arrays of the engine in the precision ``dtype``."""

    def preconditioner(self, fast: Convolution, dtype: str, scale: float = 1.0) -> Convolution:
        """Convolution whose ``solve`` approximates the inverse of the operator over ``scale``.

        ``fast`` is the prepared application of the same precision and scale, to be shared where it serves.
        """

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (nx, ny) in m under ``pressure`` (nx, ny) in Pa; a new array."""

    def matrix(self) -> RealArray:
        """Dense symmetric matrix (n, n) in m/Pa over the n = nx·ny points in C order; for small grids only."""
