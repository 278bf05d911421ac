"""Adhesion of infinitely short range: JKR's limit, in which only the work of adhesion is left."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray


@dataclass(frozen=True)
class JKRAdhesion:
    """Surfaces that gain the energy w per area where they touch, and do not attract where they are
    apart (Johnson, Kendall & Roberts 1971).

    The edge of a contact is a crack: it recedes where it would release more than w, by Griffith's
    criterion, and closes where it would release less. On a grid a point comes loose at the tension
    sqrt(2w/s), s the compliance of a point at a step of the edge, which ``adhesion.solver.front``
    finds from the discrete operator (after Pohrt & Popov 2015): the tension grows as the grid is
    refined, the energy does not.

    Parameters
    ----------
    work
        Work of adhesion w in J/m², > 0.
    closes
        Whether the edge also closes by itself. If not, contact grows by touching alone, as on a
        first approach of surfaces that hold only what has been pressed together (Pohrt & Popov
        2015).

    Examples
    --------
    >>> law = JKRAdhesion(work=0.05)
    >>> law.range, law.strength
    (0.0, inf)
    """

    work: float
    closes: bool = True
    name: ClassVar[str] = "JKR"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1971", "PohrtPopov2015")
    spacing: ClassVar[float] = 0.0
    range: ClassVar[float] = 0.0
    strength: ClassVar[float] = math.inf
    steepest: ClassVar[float] = math.inf

    def __post_init__(self) -> None:
        require.magnitude(self.work, "work of adhesion (J/m^2)")

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa: infinite where the gap is zero, none beyond."""
        return np.where(gap <= 0.0, math.inf, 0.0)

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m, zero where the surfaces are apart."""
        return np.zeros_like(gap)

    def energy(self, gap: RealArray) -> RealArray:
        """φ in J/m²: -w where the gap is zero, none beyond."""
        return np.where(gap <= 0.0, -self.work, 0.0)
