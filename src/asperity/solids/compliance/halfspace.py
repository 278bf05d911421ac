"""Normal compliance of a homogeneous half-space."""

from __future__ import annotations

from dataclasses import dataclass

from ...core import require
from ...core.arrays import RealArray
from ...core.grid import Grid
from .line_kernel import half_space_strips
from .patch import patch_displacement


@dataclass(frozen=True)
class HalfSpace:
    """Homogeneous half-space of plane-strain modulus E' (or, for two bodies, of contact modulus E*), in Pa.

    Raises
    ------
    InputError
        If the modulus is not positive.
    """

    modulus: float

    def __post_init__(self) -> None:
        require.positive(self.modulus, "plane-strain modulus of a half-space (Pa)")

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Boussinesq's point force; the boundary names the discretisation."""
        return ("Boussinesq1885", "Johnson1985")

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """c(q) = 2 / (E' q) in m/Pa (Johnson 1985, sec. 13.2), q > 0 in rad/m."""
        return 2.0 / (self.modulus * wavenumber)

    def mean_mode(self) -> float:
        """0: the mean displacement of a half-space under mean pressure is unbounded and serves as datum."""
        return 0.0

    def influence(self, grid: Grid) -> RealArray:
        """Love's coefficients in m/Pa, shape (nx, ny), for constant pressure on each pixel."""
        x, y = grid.coordinates()
        return patch_displacement(x, y, *grid.spacing) / self.modulus

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Coefficients in m/Pa, shape (nx, 1), for constant pressure on strips of width dx, zero at distance ``datum``."""
        return half_space_strips(grid, datum) / self.modulus
