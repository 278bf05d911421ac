"""Periodic contact: multiplication by the compliance in Fourier space."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.spectral import RealTransform, thread_count
from ...solids.compliance.protocol import Compliance
from ..boundary import Boundary, Periodic
from .convolution import circulant_matrix


class PeriodicOperator:
    """u(q) = c(q) p(q) on a periodic grid (Stanley & Kato 1997), spectral discretisation.

    Parameters
    ----------
    compliance
        Normal compliance of the contact.
    grid
        Periodic cell.
    threads
        Threads of the transform; see ``core.spectral.thread_count``.
    """

    def __init__(self, compliance: Compliance, grid: Grid, *, threads: int | None = None) -> None:
        q = grid.wavenumber()
        q[0, 0] = 1.0
        kernel = np.array(compliance.spectral(q), dtype=float)
        kernel[0, 0] = compliance.mean_mode()
        self.grid = grid
        self.compliance = compliance
        self.boundary: Boundary = Periodic()
        self.zero_mean_mode = bool(kernel[0, 0] == 0.0)
        self.pairs_per_application = 1.0
        self._kernel = kernel
        self._transform = RealTransform(grid.shape, thread_count(threads))

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (m), relative to its mean where the mean mode is zero, under ``pressure`` (Pa)."""
        spectrum = self._transform.forward(pressure)
        spectrum *= self._kernel
        return self._transform.backward(spectrum)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa, built from the response to one loaded point."""
        point = np.zeros(self.grid.shape)
        point[0, 0] = 1.0
        return circulant_matrix(self.apply(point))
