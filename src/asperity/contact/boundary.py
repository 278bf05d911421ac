"""What lies outside the grid: the same surface again, free half-space, or the same line contact for
ever."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..solids.compliance.halfspace import Compliance


@dataclass(frozen=True)
class Periodic:
    """The contact repeats in x and y; pressures and displacements are trigonometric (spectral
    discretisation).

    On a grid of one point along y nothing varies along y: a plane-strain contact that repeats in x.
    """

    name: ClassVar[str] = "periodic"
    wraps: ClassVar[tuple[bool, bool]] = (True, True)
    citation_keys: ClassVar[tuple[str, ...]] = ("Stanley1997",)


@dataclass(frozen=True)
class Free:
    """No load outside the grid; pressure is constant on each pixel and the displacement exact
    (DC-FFT).

    On a grid of one point along y the contact is a row of rectangles dx x dy; see ``FreeLine`` for
    a line contact.
    """

    name: ClassVar[str] = "free"
    wraps: ClassVar[tuple[bool, bool]] = (False, False)
    citation_keys: ClassVar[tuple[str, ...]] = ("Liu2000", "Love1929")

    def influence(self, compliance: Compliance, grid: Grid) -> RealArray:
        """Displacement (m/Pa) at pixel offsets from a pixel under unit pressure."""
        return compliance.influence(grid)


@dataclass(frozen=True)
class FreeLine:
    """Line contact: no load outside the grid along x, and along y everything goes on unchanged
    (plane strain).

    The grid has one point along y; pressure is in Pa as ever, forces and areas are those of the
    length dy, so that dy = 1 m gives them per metre.

    Parameters
    ----------
    datum
        Distance in m from a line load at which the displacement of a half-space is called zero, at
        least the length of the grid; None takes that length. The plane problem fixes displacements
        up to a constant only, so approach and elastic energy depend on the datum (pressure and gap
        do not); on a rigid base there is no such freedom and the datum is the base.

    Raises
    ------
    InputError
        If the datum is not positive.
    """

    datum: float | None = None
    name: ClassVar[str] = "free line"
    wraps: ClassVar[tuple[bool, bool]] = (False, True)
    citation_keys: ClassVar[tuple[str, ...]] = ("Liu2000", "Johnson1985")

    def __post_init__(self) -> None:
        if self.datum is not None:
            require.positive(self.datum, "datum of a line contact (m)")

    def require_line(self, grid: Grid) -> None:
        """Refuse grids that are no line, and a datum within the grid, where a pressure could pull
        the surface up.

        Raises
        ------
        InputError
            If the grid has more than one point along y or is longer than the datum.
        """
        if grid.shape[1] != 1:
            raise InputError(
                f"grid of a line contact must have one point along y, but has {grid.shape[0]} x "
                f"{grid.shape[1]} points. "
                "Take one line of the map ({slice}), or the free or the periodic boundary ({free}, {periodic})."
            )
        if self.datum is not None and self.datum < grid.size[0] * (1.0 - 1e-9):
            raise InputError(
                f"datum of a line contact (m) must be at least the length {grid.size[0]:.6g} of the grid, "
                f"but is {self.datum:.6g}."
            )

    def influence(self, compliance: Compliance, grid: Grid) -> RealArray:
        """Displacement (m/Pa) at pixel offsets from a strip under unit pressure."""
        self.require_line(grid)
        return compliance.line_influence(grid, grid.size[0] if self.datum is None else self.datum)


Boundary: TypeAlias = Periodic | Free | FreeLine
"""A lateral boundary condition."""
