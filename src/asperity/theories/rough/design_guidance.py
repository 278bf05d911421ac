"""Roughness and modulus for the least real area without plasticity (Bhushan 1984; 1998, sec. 3.2.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Positive, Pressure
from ..ask import PRESSURE, Way, asked
from ..protocol import Theory, curve

ELASTIC_INDEX = 0.6
"""Plasticity index ψ = (E*/H) sqrt(σ_s/R) below which a Gaussian rough contact is elastic at any realistic load."""

ELASTIC_PROFILE_INDEX = 0.25
"""Plasticity index (E*/H)(σ/β*) below which plastic flow is most unlikely (Onions & Archard 1973)."""

AREA_FACTOR = 3.2
"""A_r/A_a = 3.2 p_a/(E* sqrt(σ_s/R)), within 10 % for 1e-4 <= p_a/(η R σ_s E* sqrt(σ_s/R)) <= 1e-2."""


@dataclass(frozen=True, eq=False)
class RoughnessFor:
    """Largest ratios for contact moduli (n,): ``summit_ratio`` σ_s/R and ``profile_ratio`` σ/β*."""

    summit_ratio: RealArray
    profile_ratio: RealArray


@dataclass(frozen=True, eq=False)
class LeastAreas:
    """Real over nominal area at pressures (n,): ``elastic`` of the designed surface, ``plastic`` if everything flowed."""

    elastic: RealArray
    plastic: RealArray


@dataclass(frozen=True)
class LeastArea(Theory):
    """Surface of the least real area that stays elastic: the area falls with E* sqrt(σ_s/R) until that reaches ψ H.

        A_r/A_a = 3.2 p/(E* sqrt(σ_s/R)),  E* sqrt(σ_s/R) = ψ H.

    A plastic contact has less area yet, p/H, but smooths itself and ends elastic with more. Both the real area and
    the real pressure should be low, so the elastic limit is the aim. Friction brings yield to the surface at a lower
    pressure: multiply ``plasticity_index`` by the ratio of the pressures at first yield with and without it. A stiffer
    overcoat lowers the admissible index, a more compliant one raises it, unless contacts are much larger than the
    overcoat is thick. Hardness and modulus are those at the strain rate of a passing asperity.
    """

    hardness: Annotated[Pressure, Help("hardness H of the softer solid", of="bodies")]
    plasticity_index: Annotated[Positive, Help("plasticity index that is still elastic", of="choice")] = ELASTIC_INDEX
    name: ClassVar[str] = "least-area"
    title: ClassVar[str] = "Design for the least area without plasticity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1984", "Bhushan1998", "Greenwood1966", "Onions1973")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("mean_real_pressure", "Pa", "real pressure of the designed surface"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            PRESSURE,
            "at_pressure",
            (
                Quantity("elastic", "1", "real per nominal area of the designed surface"),
                Quantity("plastic", "1", "real per nominal area if everything flowed"),
            ),
        ),
        Way(
            asked("E_star", "Pa", "contact modulus"),
            "at_modulus",
            (
                Quantity("summit_ratio", "1", "largest height deviation over radius of the summits"),
                Quantity("profile_ratio", "1", "largest rms height over correlation length"),
            ),
        ),
    )

    def summit_ratio(self, E_star: float) -> float:
        """Largest σ_s/R, deviation of the summit heights over summit radius, for the contact modulus ``E_star`` in Pa."""
        modulus = require.positive(E_star, "contact modulus E* (Pa)")
        return (self.plasticity_index * self.hardness / modulus) ** 2

    def contact_modulus(self, summit_ratio: float) -> float:
        """Largest contact modulus E* in Pa for summits of σ_s/R = ``summit_ratio``."""
        ratio = require.positive(summit_ratio, "ratio of summit deviation and radius")
        return self.plasticity_index * self.hardness / math.sqrt(ratio)

    def profile_ratio(self, E_star: float, index: float = ELASTIC_PROFILE_INDEX) -> float:
        """Largest σ/β*, rms height over correlation length (1/e), for the modulus ``E_star`` in Pa.

        The same guidance for exponential autocorrelation: plasticity is avoided by less height or longer waves.
        """
        modulus = require.positive(E_star, "contact modulus E* (Pa)")
        return require.positive(index, "plasticity index of a profile") * self.hardness / modulus

    def at_modulus(self, E_star: ArrayLike) -> RoughnessFor:
        """Largest roughness for the contact moduli ``E_star`` (n,) in Pa."""
        moduli = curve(E_star, "contact moduli E* (Pa)", positive=True)
        summit = np.array([self.summit_ratio(float(modulus)) for modulus in moduli])
        return RoughnessFor(summit, np.array([self.profile_ratio(float(modulus)) for modulus in moduli]))

    def at_pressure(self, pressure: ArrayLike) -> LeastAreas:
        """Areas at nominal pressures (n,) in Pa, positive."""
        pressures = curve(pressure, "pressures (Pa)", positive=True)
        elastic = np.array([self.area_fraction(float(p)) for p in pressures])
        return LeastAreas(elastic, np.array([self.plastic_area_fraction(float(p)) for p in pressures]))

    @property
    def mean_real_pressure(self) -> float:
        """Real pressure in Pa of that surface: ψ H/3.2."""
        return self.plasticity_index * self.hardness / AREA_FACTOR

    def area_fraction(self, mean_pressure: float) -> float:
        """Real over nominal area of that surface at ``mean_pressure`` in Pa: 3.2 p/(ψ H), 5.3 p/H for ψ = 0.6."""
        return require.positive(mean_pressure, "mean pressure (Pa)") / self.mean_real_pressure

    def plastic_area_fraction(self, mean_pressure: float) -> float:
        """Real over nominal area if everything were plastic, the least possible: p/H."""
        return require.positive(mean_pressure, "mean pressure (Pa)") / self.hardness
