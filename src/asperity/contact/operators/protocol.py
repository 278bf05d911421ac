"""What a solver may ask of a pressure-displacement operator."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Convolution, Engine
from ...core.grid import Grid
from ...solids.compliance.halfspace import Compliance
from ..boundary import Boundary

# Compliance at octaves of wavenumbers, for models of it that ask on every grid for much the same few.


_AHEAD = 8


class Octaves:
    """Values of ``compliance`` that were asked for before, and those up to eight octaves beyond, which finer grids ask for.

    Few values cost as much as one: 3 ms for 32 sublayers, twenty times in one solve at 1024² if nothing is kept.
    """

    def __init__(self, compliance: Compliance) -> None:
        self._compliance = compliance
        self._known: dict[float, float] = {}

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure (m/Pa) at each ``wavenumber`` (rad/m, one-dimensional), to 1e-9 of it."""
        keys = [_key(q) for q in wavenumber]
        if not all(key in self._known for key in keys):
            ahead = float(np.max(wavenumber)) * 2.0 ** np.arange(1, _AHEAD + 1)
            asked = np.concatenate([wavenumber, ahead])
            found = np.asarray(self._compliance.spectral(asked), dtype=float)
            self._known.update((_key(q), float(c)) for q, c in zip(asked, found, strict=True))
        return np.array([self._known[key] for key in keys])


def _key(wavenumber: float) -> float:
    """Equal for wavenumbers that differ by rounding."""
    return float(f"{wavenumber:.9e}")


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


# Applying a prepared operator to pressures of the host.


def displacement(operator: Operator, pressure: RealArray) -> RealArray:
    """New array (nx, ny) of the displacement (m) that ``operator`` gives under ``pressure`` (Pa), in double precision."""
    engine = operator.engine
    field, out = engine.array(pressure, "float64"), engine.zeros(operator.grid.shape, "float64")
    return engine.numpy(operator.convolution("float64").apply(field, out))
