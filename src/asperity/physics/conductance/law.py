"""What lies between the bodies: a film in contact, gas and radiation in the gap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.late import Shown

STEFAN_BOLTZMANN = 5.670374419e-8
"""σ in W/(m² K⁴), exact."""


@dataclass(frozen=True, repr=False)
class ConductingInterface(Shown):
    """Film on the contact, and what conducts across the gap beside it.

    InputError if a value is negative or no number.

    Parameters
    ----------
    film_resistance
        Specific resistance of a thin film in contact, Ω m² or m² K/W, >= 0; 0 for none.
    gap_conductivity
        Conductivity k_g of what fills the gap, S/m or W/(m K), >= 0.
    jump
        Length M in m by which the jump of temperature at both walls widens the gap of a gas, >= 0
        (``temperature_jump``).
    radiation
        Conductance per area by radiation in W/(m² K), >= 0 (``radiation``).
    """

    film_resistance: float = 0.0
    gap_conductivity: float = 0.0
    jump: float = 0.0
    radiation: float = 0.0
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        require.not_negative(self.film_resistance, "specific resistance of the film")
        require.not_negative(self.gap_conductivity, "conductivity of the gap")
        require.not_negative(self.jump, "temperature jump as a length (m)")
        require.not_negative(self.radiation, "conductance by radiation (W/(m² K))")

    @property
    def bridges(self) -> bool:
        """Whether the gap conducts."""
        return self.gap_conductivity > 0.0 or self.radiation > 0.0

    def gap_resistance(self, gap: RealArray) -> RealArray:
        """Specific resistance 1/(k_g/(g + M) + h_r) at the ``gap`` g (m, any shape); infinite where
        nothing conducts."""
        wide = np.maximum(gap + self.jump, _LEAST)
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / (self.gap_conductivity / wide + self.radiation))


_LEAST = 1e-12
"""Gap in m below which none is meant: beside an edge it falls to zero, and there the contact
conducts anyway."""


def temperature_jump(
    mean_free_path: float,
    accommodation: tuple[float, float] = (0.9, 0.9),
    *,
    heat_capacity_ratio: float = 1.4,
    prandtl: float = 0.71,
) -> float:
    """M in m of a gas between two walls: the sum of (2 - α)/α times 2γ/(γ + 1) Λ/Pr (Kennard 1938).

    Parameters
    ----------
    mean_free_path
        Λ in m, > 0: 68 nm in air at 1 bar.
    accommodation
        Coefficients α of both walls, 0 < α <= 1.
    heat_capacity_ratio, prandtl
        γ > 1 and Pr > 0 of the gas, those of air by default.

    Raises
    ------
    InputError
        If a value is outside its range.

    Examples
    --------
    >>> f"{temperature_jump(68e-9):.3g}"  # about 4 mean free paths
    '2.73e-07'
    """
    path = require.positive(mean_free_path, "mean free path (m)")
    ratio = require.positive(heat_capacity_ratio, "ratio of heat capacities")
    walls = 0.0
    for value in accommodation:
        alpha = require.within(value, 0.0, 1.0, "accommodation coefficient")
        walls += (2.0 - alpha) / alpha
    return walls * 2.0 * ratio / (ratio + 1.0) * path / require.positive(prandtl, "Prandtl number")


def radiation(temperature: float, emissivities: tuple[float, float] = (1.0, 1.0)) -> float:
    """4 σ T³/(1/ε1 + 1/ε2 - 1) in W/(m² K) between parallel grey walls near the ``temperature``
    (K).

    Raises
    ------
    InputError
        If the temperature is not positive, or an emissivity is not in 0 < ε <= 1.

    Examples
    --------
    >>> round(radiation(300.0), 2)
    6.12
    """
    T = require.positive(temperature, "temperature (K)")
    series = sum(1.0 / require.within(e, 0.0, 1.0, "emissivity") for e in emissivities) - 1.0
    return 4.0 * STEFAN_BOLTZMANN * T**3 / series


def softens(temperature: float) -> bool:
    """Whether a metallic spot at this ``temperature`` (K) softens: at 190 °C copper does, at a
    voltage of 0.12 V (Holm 1967)."""
    return math.isfinite(temperature) and temperature > SOFTENING


SOFTENING = 463.0
"""Softening temperature of copper in K (Holm 1967)."""
