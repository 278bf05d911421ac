"""Normal displacement caused by shear traction, which couples friction to the pressure of unlike bodies (Dundurs 1969)."""

from __future__ import annotations

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.spectral import PaddedTransform, RealTransform, fast_length, thread_count, wrapped
from ...solids.compliance.influence_tensor import influence_tensor
from ...solids.compliance.tensor import surface_tensor
from ..boundary import Free, Periodic
from ..problem import ContactProblem


class SlidingCoupling:
    """Normal displacement under shear that is the pressure times the ratios (kx, ky), prepared once.

    The coupling of the two bodies subtracts, for they carry opposite tractions: equal bodies have none, nor has an
    incompressible body against a rigid one.

    Raises
    ------
    InputError
        If the boundary is a free line, or a layer may slip on the free boundary.
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
        elif isinstance(problem.boundary, Free):
            influence = influence_tensor(grid, problem.body, problem.counter_body)
            padded = fast_length(2 * grid.shape[0] - 1), fast_length(2 * grid.shape[1] - 1)
            x, y = wrapped(influence.xz, padded, odd_x=True), wrapped(influence.yz, padded, odd_y=True)
            self._kernel = RealTransform(padded, threads).forward(-kx * x - ky * y)
            self._transform = PaddedTransform(grid.shape, padded, threads)
        else:
            raise InputError(
                "boundary of a sliding contact with coupling must be Periodic() or Free(), but is FreeLine(). "
                "Use Periodic() on a longer line."
            )

    def displacement(self, pressure: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m of ``body`` relative to the counter body under the shear of ``pressure``."""
        field = np.ascontiguousarray(pressure, dtype=np.float64)
        spectrum = self._transform.forward(field, np.empty(self._transform.spectrum_shape, np.complex128))
        spectrum *= self._kernel
        return self._transform.backward(spectrum, np.empty_like(field))
