"""Free contact: exact discrete convolution with influence coefficients on a zero-padded grid."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.spectral import RealTransform, fast_length, thread_count
from ...solids.compliance.protocol import Compliance
from ..boundary import Boundary, Free
from .convolution import toeplitz_matrix


class FreeOperator:
    """u = sum of influence coefficients times pressures, by DC-FFT (Liu, Wang & Liu 2000): no periodicity error.

    Parameters
    ----------
    compliance
        Normal compliance of the contact.
    grid
        Grid of pixels that can carry pressure.
    threads
        Threads of the transform; see ``core.spectral.thread_count``.
    """

    def __init__(self, compliance: Compliance, grid: Grid, *, threads: int | None = None) -> None:
        nx, ny = grid.shape
        padded = fast_length(2 * nx - 1), fast_length(2 * ny - 1)
        self.grid = grid
        self.compliance = compliance
        self.boundary: Boundary = Free()
        self.zero_mean_mode = False
        self.pairs_per_application = padded[0] * padded[1] / grid.n_points
        self._influence = compliance.influence(grid)
        self._transform = RealTransform(padded, thread_count(threads))
        wrapped = np.zeros(padded)
        wrapped[:nx, :ny] = self._influence
        wrapped[padded[0] - nx + 1 :, :ny] = self._influence[:0:-1, :]
        wrapped[:, padded[1] - ny + 1 :] = wrapped[:, ny - 1 : 0 : -1]
        self._kernel = self._transform.forward(wrapped).real.copy()
        self._padded_shape = padded

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (m) under ``pressure`` (Pa), zero at infinity."""
        nx, ny = self.grid.shape
        padded = np.zeros(self._padded_shape)
        padded[:nx, :ny] = pressure
        spectrum = self._transform.forward(padded)
        spectrum *= self._kernel
        return self._transform.backward(spectrum)[:nx, :ny].copy()

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        return toeplitz_matrix(self._influence)
