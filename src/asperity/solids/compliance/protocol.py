"""What a solid must say about its surface so that any contact operator can be built on it."""

from __future__ import annotations

from typing import Protocol

from ...core.arrays import RealArray
from ...core.grid import Grid


class Compliance(Protocol):
    """Normal surface compliance of one body or of the sum of two."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the compliance rests on."""

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure c(q) in m/Pa at each ``wavenumber`` q > 0 (rad/m)."""

    def mean_mode(self) -> float:
        """Displacement per pressure in m/Pa of the mode q = 0; 0 where the datum is the mean displacement."""

    def influence(self, grid: Grid) -> RealArray:
        """Displacement (m/Pa) at pixel offsets (i, j) = (0…nx-1, 0…ny-1) from a pixel under unit pressure."""

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Displacement (m/Pa), shape (nx, 1), at offsets (0…nx-1) dx from a strip along y under unit pressure.

        Plane strain; a half-space gives it relative to the distance ``datum`` (m) from a line load.
        """
