"""From shear traction to tangential displacement on a grid, and the coupling of both with the
normal direction.

Tractions act on the body, displacements are those of the body relative to the counter body, arrays
(2, nx, ny) of their x and y components. The two-body compliance is that of Kalker (1990): the
bodies' own compliances add up, their coupling between normal and tangential directions subtracts.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...contact.boundary import Boundary, Free, FreeLine, Periodic
from ...contact.operators.convolution import Octaves, Operator, coarse_grid
from ...core.arrays import ComplexArray, RealArray
from ...core.engine import CpuEngine
from ...core.engine.vectors import VectorConvolution
from ...core.grid import Grid
from ...core.spectral import PaddedTransform, RealTransform, fast_length, wrapped
from ...solids.compliance.tensor import BodiesSurface, SurfaceCompliance
from ...solids.layers import Body

NO_COUPLING = 1e-11
"""Coupling over compliance that is rounding: equal bodies, or an incompressible one on a rigid
one."""


@dataclass(frozen=True, eq=False)
class CouplingKernel:
    """Coupling between normal and tangential directions in Fourier space: C_zx = i ``zx``, C_xz =
    -i ``zx``, likewise y (m/Pa).

    ``transform`` takes fields of the grid to the half spectra of ``zx`` and ``zy`` and back.
    """

    zx: RealArray
    zy: RealArray
    transform: RealTransform | PaddedTransform

    @classmethod
    def of(cls, grid: Grid, compliance: SurfaceCompliance, boundary: Boundary, threads: int) -> CouplingKernel:
        """Coupling of a ``compliance``. On a free line shear along y moves nothing up or down."""
        if isinstance(boundary, Periodic):
            tensor = compliance.tensor(grid)
            return cls(-tensor.xz, -tensor.yz, RealTransform(grid.shape, threads))
        padded = padded_shape(grid)
        transform = RealTransform(padded, threads)

        def spectrum(coefficients: RealArray, *, odd_x: bool) -> RealArray:
            kernel = wrapped(coefficients, padded, odd_x=odd_x, odd_y=not odd_x)
            return transform.forward(kernel).imag.copy()

        if isinstance(boundary, Free):
            xz, yz = compliance.coupling_pixels(grid)  # C_zx = -C_xz
            zx, zy = spectrum(-xz, odd_x=True), spectrum(-yz, odd_x=False)
        else:
            zx = spectrum(compliance.coupling_strips(grid), odd_x=True)
            zy = np.zeros_like(zx)
        return cls(zx, zy, PaddedTransform(grid.shape, padded, threads))

    @property
    def largest(self) -> float:
        """Largest displacement by a wave of unit traction, m/Pa."""
        return max(float(np.abs(kernel).max()) for kernel in (self.zx, self.zy))

    def lift(self, traction: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m under the ``traction`` (2, nx, ny) in Pa."""
        total = self.zx * self._forward(traction[0])
        total += self.zy * self._forward(traction[1])
        total *= 1j
        return self.transform.backward(total, np.empty(traction.shape[1:]))

    def drawn(self, pressure: RealArray) -> RealArray:
        """Tangential displacement (2, nx, ny) in m under ``pressure`` (nx, ny) in Pa."""
        spectrum = -1j * self._forward(pressure)
        out = np.empty((2, *pressure.shape))
        for component, kernel in zip(out, (self.zx, self.zy), strict=True):
            self.transform.backward(kernel * spectrum, component)
        return out

    def _forward(self, field: RealArray) -> ComplexArray:
        values = np.ascontiguousarray(field, dtype=np.float64)
        return self.transform.forward(values, np.empty(self.transform.spectrum_shape, np.complex128))


def padded_shape(grid: Grid) -> tuple[int, int]:
    """Shape on which a cyclic convolution of fields on ``grid`` is a free one."""
    return fast_length(2 * grid.shape[0] - 1), fast_length(2 * grid.shape[1] - 1)


class TangentialOperator:
    """u = C q for shear tractions q on ``grid``: periodic by the spectrum, free by influence
    coefficients.

    Parameters
    ----------
    grid, boundary
        Those of the contact.
    bodies
        The body that carries the traction, and the counter body; or a compliance.
    engine
        Processors to use; those of ASPERITY_THREADS or all cores by default.

    Raises
    ------
    InputError
        If both bodies are rigid, or, when ``entries`` are first read, on a free boundary a layer
        may slip: it would move without end.
    """

    def __init__(
        self,
        grid: Grid,
        bodies: tuple[Body, Body] | SurfaceCompliance,
        boundary: Boundary = Periodic(),
        *,
        engine: CpuEngine | None = None,
        entries: tuple[RealArray, RealArray, RealArray] | None = None,
        octaves: Octaves | None = None,
    ) -> None:
        self.grid, self.boundary = grid, boundary
        self.compliance: SurfaceCompliance = BodiesSurface(*bodies) if isinstance(bodies, tuple) else bodies
        self.engine = engine or CpuEngine()
        self.padded = grid.shape if isinstance(boundary, Periodic) else padded_shape(grid)
        self.octaves = octaves or Octaves(self.compliance)
        self._entries = entries
        self._convolutions: dict[str, VectorConvolution] = {}
        self._coupled_convolutions: dict[str, VectorConvolution] = {}
        pruned = 1.0 if self.padded == grid.shape else 0.75 * self.padded[0] * self.padded[1] / grid.n_points
        self.pairs_per_application = 2.0 * pruned

    @cached_property
    def entries(self) -> tuple[RealArray, RealArray, RealArray]:
        """``xx``, ``yy`` and ``xy`` (m/Pa) on the half spectrum of the grid or of its padded
        form."""
        if self._entries is not None:
            return self._entries
        if isinstance(self.boundary, Periodic):
            tensor = self.compliance.tensor(self.grid)
            return tensor.xx, tensor.yy, tensor.xy
        if isinstance(self.boundary, FreeLine):
            datum = self.grid.size[0] if self.boundary.datum is None else self.boundary.datum
            xx, yy = self.compliance.shear_strips(self.grid, datum)
            xy = np.zeros_like(xx)
        else:
            xx, yy, xy = self.compliance.shear_pixels(self.grid)
        transform = RealTransform(self.padded, self.engine.threads)
        odd = {"odd_x": True, "odd_y": True}
        kernels = wrapped(xx, self.padded), wrapped(yy, self.padded), wrapped(xy, self.padded, **odd)
        return tuple(transform.forward(kernel).real.copy() for kernel in kernels)  # type: ignore[return-value]

    @cached_property
    def coupling(self) -> CouplingKernel:
        """Coupling with the normal direction."""
        return CouplingKernel.of(self.grid, self.compliance, self.boundary, self.engine.threads_for(self.padded))

    @cached_property
    def coupled(self) -> bool:
        """Whether shear moves the surfaces up and down, and pressure moves them sideways."""
        return self.coupling.largest > NO_COUPLING * self.largest

    @property
    def mean(self) -> float:
        """Displacement by a uniform traction, m/Pa; of a periodic half-space none, whose datum is
        the mean."""
        return float(self.entries[0][0, 0])

    @cached_property
    def largest(self) -> float:
        """Largest displacement by a wave of unit traction, m/Pa."""
        return float(max(entry.max() for entry in self.entries[:2]))

    def convolution(self, dtype: str) -> VectorConvolution:
        """Prepared product in the precision ``dtype``."""
        if dtype not in self._convolutions:
            self._convolutions[dtype] = VectorConvolution(
                self.engine, self.entries, self.grid.shape, self.padded, dtype
            )
        return self._convolutions[dtype]

    def coupled_convolution(self, dtype: str, normal: Operator) -> VectorConvolution:
        """Prepared product with all three components of traction, ``normal`` being the operator of
        the pressure on the same grid."""
        if dtype not in self._coupled_convolutions:
            entries = (*self.entries, normal.kernel, self.coupling.zx, self.coupling.zy)
            made = VectorConvolution(self.engine, entries, self.grid.shape, self.padded, dtype)
            self._coupled_convolutions[dtype] = made
        return self._coupled_convolutions[dtype]

    def displacement(self, traction: RealArray) -> RealArray:
        """Tangential displacement (2, nx, ny) in m under ``traction`` (2, nx, ny) in Pa, in double
        precision; a new array."""
        values, out = np.ascontiguousarray(traction, dtype=np.float64), np.empty(traction.shape)
        self.convolution("float64").apply((values[0], values[1]), (out[0], out[1]))
        return out

    def drawn(self, pressure: RealArray) -> RealArray:
        """Tangential displacement (2, nx, ny) in m under ``pressure`` (nx, ny) in Pa; zero for
        bodies that do not couple."""
        return self.coupling.drawn(pressure) if self.coupled else np.zeros((2, *pressure.shape))

    def lift(self, traction: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m under ``traction`` (2, nx, ny) in Pa; zero for bodies
        that do not couple."""
        return self.coupling.lift(traction) if self.coupled else np.zeros(traction.shape[1:])

    @cached_property
    def coarsened(self) -> TangentialOperator:
        """Operator on the grid of half as many points per side."""
        grid, entries = coarse_grid(self.grid), None
        if isinstance(self.boundary, Periodic):
            fine, (rows, columns) = self.grid.shape[0], grid.shape
            row = np.arange(rows)
            of_wave = np.where(row < (rows + 1) // 2, row, fine - rows + row)
            xx, yy, xy = (entry[of_wave, : columns // 2 + 1].copy() for entry in self.entries)
            if rows % 2 == 0:
                xy[rows // 2] = 0.0  # odd in x: no sign on the Nyquist line
            if columns % 2 == 0:
                xy[:, columns // 2] = 0.0
            entries = xx, yy, xy
        return TangentialOperator(
            grid, self.compliance, self.boundary, engine=self.engine, entries=entries, octaves=self.octaves
        )
