"""Crossed waves pressed flat: both ends of the load (Johnson, Greenwood & Higginson 1985).

Between the asymptotes there is no closed form; ``asp.solve`` on ``asp.generate.bisinusoid`` has the answer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .hertz import HertzPoint
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .single_contact import checked, small_slope
from .ways import Column

LOW_LOAD, HIGH_LOAD = 0.02, 0.95
"""p̄/p* up to which the area of Hertz is low by less than 5 %, and from which that of full contact is right to 0.05 %."""


@dataclass(frozen=True)
class CrossedWaves:
    """Gap Δ(2 - cos 2πx/λ - cos 2πy/λ) before loading; p* = 2πE*Δ/λ closes it everywhere.

    The product form Δ' cos(2πx'/λ') cos(2πy'/λ') of the paper is the same surface turned by 45°, Δ = Δ'/2, λ = λ'/√2.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    amplitude
        Δ of each wave in m, > 0.
    wavelength
        λ in m, > 0.
    """

    E_star: float
    amplitude: float
    wavelength: float
    name: ClassVar[str] = "crossed-waves"
    title: ClassVar[str] = "Johnson-Greenwood-Higginson, crossed waves"
    citation_keys: ClassVar[tuple[str, ...]] = ("JohnsonGreenwood1985",)
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("amplitude", "m", "amplitude of the wave"),
        Input("wavelength", "m", "wavelength"),
    )
    numbers: ClassVar[tuple[Column, ...]] = (
        Column("full_contact_pressure", "Pa", "mean pressure that closes the gap everywhere"),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.amplitude, "amplitude of the waves (m)")
        require.positive(self.wavelength, "wavelength (m)")

    @property
    def full_contact_pressure(self) -> float:
        """p* = 2πE*Δ/λ in Pa."""
        return 2.0 * np.pi * self.E_star * self.amplitude / self.wavelength

    @property
    def crest(self) -> HertzPoint:
        """One crest as a sphere of R = λ²/4π²Δ."""
        return HertzPoint(self.E_star, self.wavelength**2 / (4.0 * np.pi**2 * self.amplitude))

    def area_fraction_at_low_load(self, mean_pressure: ArrayLike) -> RealArray:
        """Hertz at each crest, π (3p̄/8πp*)^(2/3); ``mean_pressure`` in Pa, >= 0, of any shape."""
        P = checked(mean_pressure, "mean pressure (Pa)") * self.wavelength**2
        return np.asarray(self.crest.at_load(P).area / self.wavelength**2)

    def max_pressure_at_low_load(self, mean_pressure: ArrayLike) -> RealArray:
        """Hertz's peak pressure at each crest in Pa."""
        return self.crest.at_load(checked(mean_pressure, "mean pressure (Pa)") * self.wavelength**2).max_pressure

    def area_fraction_at_high_load(self, mean_pressure: ArrayLike) -> RealArray:
        """1 - (3/2π)(1 - p̄/p*): round gaps that the pressure around them just holds open; 1 from p* on."""
        share = np.minimum(checked(mean_pressure, "mean pressure (Pa)") / self.full_contact_pressure, 1.0)
        return np.asarray(1.0 - 1.5 / np.pi * (1.0 - share))

    def full_contact(self, x: ArrayLike, y: ArrayLike, mean_pressure: float) -> RealArray:
        """Pressure in Pa at ``x``, ``y`` in m (broadcast) from a crest in full contact, p̄ >= p*."""
        p = require.positive(mean_pressure, "mean pressure (Pa)")
        full = self.full_contact_pressure
        if p < full * (1.0 - 1e-12):
            raise InputError(
                f"mean pressure must be at least that of full contact, {full:.6g} Pa, but is {p:.6g} Pa. "
                "Partial contact has no closed form: solve the contact."
            )
        q = 2.0 * np.pi / self.wavelength
        return np.asarray(p + 0.5 * full * (np.cos(q * np.asarray(x)) + np.cos(q * np.asarray(y))))

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive: the area, NaN where neither end of the load is near."""
        p = curve(pressure, "mean pressures (Pa)", positive=True)
        share = p / self.full_contact_pressure
        between = np.where(share >= HIGH_LOAD, self.area_fraction_at_high_load(p), np.nan)
        return prediction(p, area_fraction=np.where(share <= LOW_LOAD, self.area_fraction_at_low_load(p), between))

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Slopes small, and every load near one of the ends: p̄/p* <= 0.02 or >= 0.95."""
        share = prediction.pressure / self.full_contact_pressure
        inside = np.minimum(share - LOW_LOAD, HIGH_LOAD - share)
        message = "There is no closed form between the asymptotes of low and of high load."
        steepest = np.full(len(prediction), 2.0 * math.sqrt(2.0) * math.pi * self.amplitude / self.wavelength)
        return (
            small_slope("largest slope of the waves", steepest),
            Limit("p/p* between 0.02 and 0.95, by", inside, -math.inf, 0.0, "JohnsonGreenwood1985", message),
        )
