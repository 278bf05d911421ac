"""When a material yields or breaks: an equivalent stress and the strength it is compared with."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Protocol

from ..core import require
from ..core.arrays import RealArray
from ..core.tensor import StressTensor
from ..solids.elastic import Elastic
from . import invariants

TABOR = 2.8
"""Hardness over tensile yield stress of metals (Tabor 1951), used where only the hardness is known."""


@dataclass(frozen=True)
class Limit:
    """Strength in Pa, NaN where unknown, and whether it was inferred from the hardness."""

    value: float
    inferred: bool = False


class Criterion(Protocol):
    """A criterion of failure."""

    @property
    def name(self) -> str:
        """For tables."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers it rests on."""

    def equivalent(self, stress: StressTensor) -> RealArray:
        """Equivalent stress in Pa, an array of the shape of the components."""

    def limit(self, material: Elastic) -> Limit:
        """Strength of ``material``."""


@dataclass(frozen=True)
class VonMises:
    """√(3 J2) against the tensile yield stress; where that is unknown against hardness/2.8 (Tabor 1951)."""

    name: ClassVar[str] = "von Mises"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Tabor1951")

    def equivalent(self, stress: StressTensor) -> RealArray:
        """√(3 J2) in Pa."""
        return invariants.von_mises(stress)

    def limit(self, material: Elastic) -> Limit:
        """Tensile yield stress of ``material``."""
        return tensile_yield_stress(material)


@dataclass(frozen=True)
class Tresca:
    """σ1 - σ3 against the tensile yield stress; where that is unknown against hardness/2.8 (Tabor 1951)."""

    name: ClassVar[str] = "Tresca"
    citation_keys: ClassVar[tuple[str, ...]] = ("Eberly2014", "Johnson1985", "Tabor1951")

    def equivalent(self, stress: StressTensor) -> RealArray:
        """σ1 - σ3 in Pa."""
        return invariants.tresca(stress)

    def limit(self, material: Elastic) -> Limit:
        """Tensile yield stress of ``material``."""
        return tensile_yield_stress(material)


@dataclass(frozen=True)
class MaxPrincipal:
    """Largest principal stress against a tensile ``strength`` in Pa, for brittle materials.

    Raises
    ------
    InputError
        If the strength is not positive.
    """

    strength: float
    name: ClassVar[str] = "maximum principal stress"
    citation_keys: ClassVar[tuple[str, ...]] = ("Eberly2014", "Johnson1985")

    def __post_init__(self) -> None:
        require.positive(self.strength, "tensile strength (Pa)")

    def equivalent(self, stress: StressTensor) -> RealArray:
        """σ1 in Pa."""
        largest: RealArray = invariants.principal_stresses(stress)[0]
        return largest

    def limit(self, material: Elastic) -> Limit:
        """The given strength, the same in every material."""
        return Limit(self.strength)


def tensile_yield_stress(material: Elastic) -> Limit:
    """Yield stress of ``material``, or hardness/2.8 where only that is known."""
    strength = material.strength
    if not math.isnan(strength.yield_stress):
        return Limit(strength.yield_stress)
    return Limit(strength.hardness / TABOR, inferred=not math.isnan(strength.hardness))
