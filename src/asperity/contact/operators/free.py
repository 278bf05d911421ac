"""Free contact: exact discrete convolution with influence coefficients on a zero-padded grid."""

from __future__ import annotations

from functools import cached_property

from ...core.arrays import RealArray
from ...core.engine import Convolution, CpuEngine, Engine
from ...core.grid import Grid
from ...core.spectral import RealTransform, fast_length, wrapped
from ...solids.compliance.protocol import Compliance
from ..boundary import Free, FreeLine
from .application import displacement
from .coarse import coarse_grid
from .convolution import toeplitz_matrix
from .octaves import Octaves
from .periodic import spectral_kernel


class FreeOperator:
    """u = sum of influence coefficients times pressures, by DC-FFT (Liu, Wang & Liu 2000): no periodicity error.

    Transforms and their buffers are prepared at first use and kept, so one operator serves one solve at a time.

    Parameters
    ----------
    compliance
        Normal compliance of the contact.
    grid
        Grid of pixels that can carry pressure.
    boundary
        ``Free()`` or, for strips in plane strain, ``FreeLine()``.
    engine
        Machine to compute on; the CPU with its default threads if not given.
    octaves
        Values of the compliance to share, from the operator of a finer grid.
    """

    zero_mean_mode = False

    def __init__(
        self,
        compliance: Compliance,
        grid: Grid,
        boundary: Free | FreeLine = Free(),
        *,
        engine: Engine | None = None,
        octaves: Octaves | None = None,
    ) -> None:
        nx, ny = grid.shape
        self.grid = grid
        self.compliance = compliance
        self.octaves = octaves or Octaves(compliance)
        self.boundary: Free | FreeLine = boundary
        self.engine: Engine = engine or CpuEngine()
        self._influence = boundary.influence(compliance, grid)
        self._prepared: dict[tuple[str, float], Convolution] = {}
        self._preconditioners: dict[tuple[str, float], Convolution] = {}
        self.padded = fast_length(2 * nx - 1), fast_length(2 * ny - 1)
        self.pairs_per_application = 0.75 * self.padded[0] * self.padded[1] / grid.n_points  # pruned along y

    @cached_property
    def kernel(self) -> RealArray:
        """Transform of the influence coefficients (m/Pa) on the padded grid."""
        return RealTransform(self.padded).forward(wrapped(self._influence, self.padded)).real.copy()

    def convolution(self, dtype: str, scale: float = 1.0) -> Convolution:
        """Prepared product with the compliance over ``scale`` in the precision ``dtype``."""
        if (dtype, scale) not in self._prepared:
            kernel = self.kernel if scale == 1.0 else self.kernel / scale
            self._prepared[dtype, scale] = self.engine.padded_convolution(kernel, self.grid.shape, self.padded, dtype)
        return self._prepared[dtype, scale]

    def preconditioner(self, fast: Convolution, dtype: str, scale: float = 1.0) -> Convolution:
        """Convolution whose ``solve`` divides by the periodic compliance of the grid: near enough, and not padded."""
        if (dtype, scale) not in self._preconditioners:
            kernel = spectral_kernel(self.compliance, self.grid) / scale
            self._preconditioners[dtype, scale] = self.engine.convolution(kernel, self.grid.shape, dtype)
        return self._preconditioners[dtype, scale]

    @cached_property
    def coarsened(self) -> FreeOperator:
        """Operator on the grid of half as many points per side."""
        grid = coarse_grid(self.grid)
        return FreeOperator(self.compliance, grid, self.boundary, engine=self.engine, octaves=self.octaves)

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (m) under ``pressure`` (Pa), zero at infinity (strips: at the datum)."""
        return displacement(self, pressure)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        return toeplitz_matrix(self._influence)
