"""Normal displacement caused by shear traction, which couples friction to the pressure of unlike bodies (Dundurs 1969)."""

from __future__ import annotations

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.spectral import PaddedTransform, RealTransform, fast_length, thread_count, wrapped
from ...solids.compliance.tensor import coupling_influence, coupling_strips, surface_tensor
from ..boundary import Free, Periodic
from ..problem import ContactProblem


class SlidingCoupling:
    """Normal displacement under shear that is the pressure times the ratios (kx, ky), prepared once.

    The coupling of the two bodies subtracts, for they carry opposite tractions: equal bodies have none, nor has an
    incompressible body against a rigid one. On a free line shear along y moves nothing up or down.
    """

    def __init__(self, problem: ContactProblem, ratios: tuple[float, float], *, threads: int | None = None) -> None:
        grid, (kx, ky) = problem.grid, ratios
        threads = thread_count(threads)
        self._transform: RealTransform | PaddedTransform
        self._kernel: ComplexArray
        if isinstance(problem.boundary, Periodic):
            tensor = surface_tensor(grid, problem.body, problem.counter_body)
            self._kernel = -1j * (kx * tensor.xz + ky * tensor.yz)  # C_zx = -C_xz
            self._transform = RealTransform(grid.shape, threads)
        else:
            bodies = problem.body, problem.counter_body
            padded = fast_length(2 * grid.shape[0] - 1), fast_length(2 * grid.shape[1] - 1)
            if isinstance(problem.boundary, Free):
                xz, yz = coupling_influence(grid, *bodies)  # C_zx = -C_xz
                kernel = -kx * wrapped(xz, padded, odd_x=True) - ky * wrapped(yz, padded, odd_y=True)
            else:
                kernel = kx * wrapped(coupling_strips(grid, *bodies), padded, odd_x=True)
            self._kernel = RealTransform(padded, threads).forward(kernel)
            self._transform = PaddedTransform(grid.shape, padded, threads)

    def displacement(self, pressure: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m of ``body`` relative to the counter body under the shear of ``pressure``."""
        field = np.ascontiguousarray(pressure, dtype=np.float64)
        spectrum = self._transform.forward(field, np.empty(self._transform.spectrum_shape, np.complex128))
        spectrum *= self._kernel
        return self._transform.backward(spectrum, np.empty_like(field))
