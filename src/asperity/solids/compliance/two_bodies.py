"""Compliance of the contact of two bodies."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.grid import Grid
from ..layers import Body, Layered, contact_modulus, deformable, materials_of
from .halfspace import Compliance, HalfSpace
from .layered import LayerStack


@dataclass(frozen=True)
class SumOfCompliances:
    """Compliance of bodies that carry the same pressure: their normal displacements add up (Peng 2001, eq. 3.32)."""

    parts: tuple[Compliance, ...]

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of all parts."""
        return (*citation_keys(*self.parts), "Peng2001")

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Sum of c(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        first, *others = (part.spectral(wavenumber) for part in self.parts)
        return sum(others, start=first)

    def mean_mode(self) -> float:
        """Sum in m/Pa; 0 if the datum of one part is its mean displacement, which then is that of the sum."""
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

    Raises
    ------
    InputError
        If both bodies are rigid.
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
