"""A sinusoid pressed flat: partial contact of a wavy line (Westergaard 1939; Johnson 1985, sec. 13.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .single_contact import checked, small_slope
from .ways import Column


@dataclass(frozen=True)
class Westergaard:
    """Gap Δ(1 - cos 2πx/λ) before loading, pressed by the mean pressure p̄; p* = πE*Δ/λ just closes it everywhere.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    amplitude
        Δ in m, > 0: half the height from trough to crest.
    wavelength
        λ in m, > 0.

    Examples
    --------
    >>> wave = Westergaard(E_star=1e9, amplitude=1e-6, wavelength=1e-3)
    >>> [round(float(part), 3) for part in wave.area_fraction([0.1e6, 1e6, 4e6])]
    [0.114, 0.382, 1.0]
    """

    E_star: float
    amplitude: float
    wavelength: float
    name: ClassVar[str] = "westergaard"
    title: ClassVar[str] = "Westergaard, sinusoid"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Westergaard1939")
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
        require.positive(self.amplitude, "amplitude of the wave (m)")
        require.positive(self.wavelength, "wavelength (m)")

    @property
    def full_contact_pressure(self) -> float:
        """p* = πE*Δ/λ in Pa."""
        return np.pi * self.E_star * self.amplitude / self.wavelength

    def area_fraction(self, mean_pressure: ArrayLike) -> RealArray:
        """2a/λ = (2/π) arcsin sqrt(p̄/p*), 1 from p* on; ``mean_pressure`` p̄ in Pa, >= 0, of any shape."""
        fraction: RealArray = 2.0 / np.pi * np.arcsin(np.sqrt(np.minimum(self._share(mean_pressure), 1.0)))
        return fraction

    def max_pressure(self, mean_pressure: ArrayLike) -> RealArray:
        """Pressure at the crest in Pa: 2 sqrt(p̄ p*), from p* on p̄ + p*."""
        share = self._share(mean_pressure)
        crest: RealArray = self.full_contact_pressure * np.where(share < 1.0, 2.0 * np.sqrt(share), 1.0 + share)
        return crest

    def approach(self, mean_pressure: ArrayLike) -> RealArray:
        """Approach δ of the mean planes since first touch in m: Δω(1 - ln ω), ω = p̄/p*; Δ from p* on."""
        share = np.minimum(self._share(mean_pressure), 1.0)
        approach: RealArray = self.amplitude * share * (1.0 - np.log(np.maximum(share, 1e-300)))
        return approach

    def mean_gap(self, mean_pressure: ArrayLike) -> RealArray:
        """Mean gap Δ - δ in m."""
        return self.amplitude - self.approach(mean_pressure)

    def stiffness(self, mean_pressure: ArrayLike) -> RealArray:
        """dp̄/dδ = p*/(-Δ ln ω) in Pa/m, infinite from p* on and zero without load."""
        share = np.minimum(self._share(mean_pressure), 1.0)
        with np.errstate(divide="ignore"):
            slope: RealArray = self.full_contact_pressure / (self.amplitude * -np.log(share) + 0.0)
        return slope

    def pressure(self, x: ArrayLike, mean_pressure: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from a crest.

        (2p̄ cos ψ/sin²ψa) sqrt(sin²ψa - sin²ψ) with ψ = πx/λ, ψa = πa/λ; from p* on p̄ + p* cos 2ψ.
        """
        p, full = require.positive(mean_pressure, "mean pressure (Pa)"), self.full_contact_pressure
        psi = np.pi * np.asarray(x, dtype=float) / self.wavelength
        if p >= full:
            return np.asarray(p + full * np.cos(2.0 * psi))
        open_ = np.maximum(p / full - np.sin(psi) ** 2, 0.0)
        return np.asarray(2.0 * full * np.abs(np.cos(psi)) * np.sqrt(open_))

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive; the gap is also the separation of the mean planes."""
        p = curve(pressure, "mean pressures (Pa)", positive=True)
        gap = self.mean_gap(p)
        return prediction(
            p, area_fraction=self.area_fraction(p), separation=gap, mean_gap=gap, stiffness=self.stiffness(p)
        )

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Slopes of the wave must be small: 2πΔ/λ <= 0.3."""
        slope = 2.0 * np.pi * self.amplitude / self.wavelength
        return (small_slope("largest slope of the wave", np.full(len(prediction), slope)),)

    def _share(self, mean_pressure: ArrayLike) -> RealArray:
        share: RealArray = checked(mean_pressure, "mean pressure (Pa)") / self.full_contact_pressure
        return share
