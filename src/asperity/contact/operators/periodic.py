"""Periodic contact: multiplication by the compliance in Fourier space."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Convolution, CpuEngine, Engine
from ...core.grid import Grid
from ...solids.compliance.protocol import Compliance
from ..boundary import Boundary, Periodic
from .application import displacement
from .coarse import coarse_grid
from .convolution import circulant_matrix
from .octaves import Octaves


class PeriodicOperator:
    """u(q) = c(q) p(q) on a periodic grid (Stanley & Kato 1997), spectral discretisation.

    Transforms and their buffers are prepared at first use and kept, so one operator serves one solve at a time.

    Parameters
    ----------
    compliance
        Normal compliance of the contact.
    grid
        Periodic cell.
    engine
        Machine to compute on; the CPU with its default threads if not given.
    kernel
        Compliance (m/Pa) on the half spectrum of ``grid`` where it is known already.
    octaves
        Values of the compliance to share, from the operator of a finer grid.
    """

    pairs_per_application = 1.0

    def __init__(
        self,
        compliance: Compliance,
        grid: Grid,
        *,
        engine: Engine | None = None,
        kernel: RealArray | None = None,
        octaves: Octaves | None = None,
    ) -> None:
        self.grid = grid
        self.compliance = compliance
        self.octaves = octaves or Octaves(compliance)
        self.boundary: Boundary = Periodic()
        self.engine: Engine = engine or CpuEngine()
        self.kernel = spectral_kernel(compliance, grid) if kernel is None else kernel
        self._prepared: dict[tuple[str, float], Convolution] = {}
        self.zero_mean_mode = bool(self.kernel[0, 0] == 0.0)

    @property
    def padded(self) -> tuple[int, int]:
        """Shape of the grid of the kernel: no padding."""
        return self.grid.shape

    def convolution(self, dtype: str, scale: float = 1.0) -> Convolution:
        """Prepared product with the compliance over ``scale`` in the precision ``dtype``."""
        if (dtype, scale) not in self._prepared:
            kernel = self.kernel if scale == 1.0 else self.kernel / scale
            self._prepared[dtype, scale] = self.engine.convolution(kernel, self.grid.shape, dtype)
        return self._prepared[dtype, scale]

    def preconditioner(self, fast: Convolution, dtype: str, scale: float = 1.0) -> Convolution:
        """Convolution whose ``solve`` divides by the compliance over ``scale``: the application ``fast`` itself."""
        return fast

    @cached_property
    def coarsened(self) -> PeriodicOperator:
        """Operator on the grid of half as many points per side, whose waves are the longer half of those here."""
        grid = coarse_grid(self.grid)
        fine, (rows, columns) = self.grid.shape[0], grid.shape
        row = np.arange(rows)
        of_wave = np.where(row < (rows + 1) // 2, row, fine - rows + row)
        kernel = self.kernel[of_wave, : columns // 2 + 1]
        return PeriodicOperator(self.compliance, grid, engine=self.engine, kernel=kernel, octaves=self.octaves)

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (m), relative to its mean where the mean mode is zero, under ``pressure`` (Pa)."""
        return displacement(self, pressure)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa, built from the response to one loaded point."""
        point = np.zeros(self.grid.shape)
        point[0, 0] = 1.0
        return circulant_matrix(self.apply(point))


def spectral_kernel(compliance: Compliance, grid: Grid) -> RealArray:
    """Compliance (m/Pa) on the half spectrum of ``grid``; negative frequencies along x are copies of positive ones."""
    nx, ny = grid.shape
    rows = nx // 2 + 1
    qx, qy = grid.wavevector()
    q = np.hypot(qx[:rows], qy)
    q[0, 0] = q[-1, -1] or 1.0  # any wavenumber of the grid: its value is replaced
    kernel = np.empty((nx, ny // 2 + 1))
    kernel[:rows] = compliance.spectral(q)
    kernel[0, 0] = compliance.mean_mode()
    kernel[rows:] = kernel[nx - rows : 0 : -1]
    return kernel
