"""Normal compliance of a homogeneous half-space and of the contact of two bodies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.grid import Grid
from ..layers import Body, Layered, contact_modulus, deformable, materials_of
from .influence import patch_displacement, wavenumbers
from .layered import LayerStack


class Compliance(Protocol):
    """Normal surface compliance of one body or of the sum of two; a value that does not change."""

    def __hash__(self) -> int:
        """Equal for equal compliances."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the compliance rests on."""

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """Displacement per pressure c(q) in m/Pa at each ``wavenumber`` q > 0 (rad/m), of any
        shape; InputError at q = 0."""

    def mean_mode(self) -> float:
        """Displacement per pressure in m/Pa of the mode q = 0; 0 where the datum is the mean
        displacement."""

    def influence(self, grid: Grid) -> RealArray:
        """Displacement (m/Pa) at pixel offsets (i, j) = (0…nx-1, 0…ny-1) from a pixel under unit
        pressure."""

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Displacement (m/Pa), shape (nx, 1), at offsets (0…nx-1) dx from a strip along y under
        unit pressure.

        Plane strain; a half-space gives it relative to the distance ``datum`` (m) from a line load.
        """


@dataclass(frozen=True)
class HalfSpace:
    """Homogeneous half-space of plane-strain modulus E' (or, for two bodies, of contact modulus
    E*), in Pa.

    InputError if the modulus is not positive.
    """

    modulus: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Boussinesq1885", "Johnson1985")
    """Boussinesq's point force; the boundary names the discretisation."""

    def __post_init__(self) -> None:
        require.positive(self.modulus, "plane-strain modulus of a half-space (Pa)")

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """c(q) = 2 / (E' q) in m/Pa (Johnson 1985, sec. 13.2), q > 0 in rad/m."""
        return 2.0 / (self.modulus * wavenumbers(wavenumber))

    def mean_mode(self) -> float:
        """0: the mean displacement of a half-space under mean pressure is unbounded and serves as
        datum."""
        return 0.0

    def influence(self, grid: Grid) -> RealArray:
        """Love's coefficients in m/Pa, shape (nx, ny), for constant pressure on each pixel."""
        x, y = grid.coordinates()
        return patch_displacement(x, y, *grid.spacing) / self.modulus

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Coefficients in m/Pa, shape (nx, 1), for constant pressure on strips of width dx, zero at
        distance ``datum``.

        Differences of the integral of -2/(pi E') ln(x/datum) (Johnson 1985, eq. 2.24), which is
        odd: the first strip reaches from -edge to edge.
        """
        edge = (np.arange(grid.shape[0]) + 0.5) * grid.spacing[0]
        integral = 2.0 / np.pi * edge * (1.0 - np.log(edge / datum))
        return np.asarray(np.diff(integral, prepend=-integral[0])[:, None] / self.modulus)


@dataclass(frozen=True)
class SumOfCompliances:
    """Compliance of bodies that carry the same pressure: their normal displacements add up (Peng
    2001, eq. 3.32)."""

    parts: tuple[Compliance, ...]

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of all parts."""
        return (*citation_keys(*self.parts), "Peng2001")

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """Sum of c(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        first, *others = (part.spectral(wavenumber) for part in self.parts)
        return sum(others, start=first)

    def mean_mode(self) -> float:
        """Sum in m/Pa; 0 if the datum of one part is its mean displacement, which then is that of
        the sum."""
        modes = [part.mean_mode() for part in self.parts]
        return sum(modes) if all(modes) else 0.0

    def influence(self, grid: Grid) -> RealArray:
        """Sum of the influence coefficients in m/Pa, shape (nx, ny)."""
        first, *others = (part.influence(grid) for part in self.parts)
        return sum(others, start=first)

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Sum of the strip coefficients in m/Pa, shape (nx, 1)."""
        first, *others = (part.line_influence(grid, datum) for part in self.parts)
        return sum(others, start=first)


def contact_compliance(body: Body, counter_body: Body) -> Compliance:
    """Sum of the normal compliances of ``body`` and ``counter_body`` (Peng 2001, eq. 3.32).

    Two homogeneous half-spaces act as one of contact modulus E*.

    InputError if both bodies are rigid.
    """
    solids = [solid for solid, _ in deformable(body, counter_body)]
    stacks = [LayerStack(solid) for solid in solids if isinstance(solid, Layered) and solid.reduced.layers]
    if not stacks:
        return HalfSpace(contact_modulus(body, counter_body))
    half_spaces = [
        HalfSpace(material.plane_strain_modulus)
        for solid in solids
        if not (isinstance(solid, Layered) and solid.reduced.layers)
        for material in materials_of(solid)
    ]
    parts: tuple[Compliance, ...] = (*half_spaces, *stacks)
    return parts[0] if len(parts) == 1 else SumOfCompliances(parts)
