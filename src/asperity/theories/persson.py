"""Persson's theory of rough contact: area and distribution of pressure; mean gap and stiffness from ``persson_gap``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .isotropic_spectrum import IsotropicSpectrum
from .persson_gap import CALIBRATED, PerssonGap
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .roughness import Roughness
from .ways import PRESSURE, ROUGH, Column, Way, asked

LOW_LOAD_SLOPE = math.sqrt(8.0 / math.pi)
"""κ = (A/A_n) E* h'_rms/p at vanishing load."""


@dataclass(frozen=True, eq=False)
class LocalPressures:
    """Distribution at local pressures (n,): probability ``density`` in 1/Pa, ``area_above`` the share with more."""

    density: RealArray
    area_above: RealArray


@dataclass(frozen=True, eq=False)
class Persson:
    """Area and pressure of an elastic half-space on a randomly rough rigid surface.

    Roughness of ever shorter waves is taken in turn; with each the density P of the pressure spreads as by diffusion,
    ∂P/∂ζ = f(ζ) ∂²P/∂p², and what reaches zero pressure is out of contact (Persson 2001; Persson et al. 2002). With
    the standard deviation s = E* h'_rms/2 of the pressure in full contact the solution is a Gaussian about the mean
    pressure less its image. Exact at full contact; below it the area is about 30 % too small at 2 % contact and 20 %
    at 20 %, against elasticity, and the same for every width of the spectrum.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    rms_gradient
        Root mean square gradient h'_rms of the composite surface, > 0: sqrt(2 m2).
    q, psd
        Power spectrum, see ``IsotropicSpectrum``; needed for the mean gap and the stiffness, NaN without.
    gamma
        Weight of the elastic energy in the mean gap, see ``PerssonGap``.

    Raises
    ------
    InputError
        If a parameter is not positive, or the spectrum cannot be used.
    """

    E_star: float
    rms_gradient: float
    q: ArrayLike = ()
    psd: ArrayLike = ()
    gamma: float = CALIBRATED
    name: ClassVar[str] = "persson"
    title: ClassVar[str] = "Persson"
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2002", "Persson2007", "Yang2008")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("rms_gradient", "", "rms gradient of the surface, sqrt(2 m2)"),
        Input("q", "rad/m", "wavenumbers of the power spectrum, for the mean gap", default=(), many=True),
        Input("psd", "m^4", "power spectrum at those wavenumbers, m0 = (1/2π) ∫ q C dq", default=(), many=True),
        Input(
            "gamma", "", "weight of the elastic energy in the mean gap, 1 in the original form", "choice", CALIBRATED
        ),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(PRESSURE, "at_pressure", ROUGH),
        Way(
            asked("local", "Pa", "pressure at a point"),
            "at_local",
            (
                Column("density", "1/Pa", "probability density of the pressure at a point"),
                Column("area_above", "", "share of the nominal area with more pressure"),
            ),
            (PRESSURE,),
            checked=False,
        ),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E* (Pa)")
        require.positive(self.rms_gradient, "rms gradient")
        if self._has_spectrum:
            PerssonGap(self.E_star, IsotropicSpectrum(self.q, self.psd), self.gamma)

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, gamma: float = CALIBRATED) -> Self:
        """Theory for ``roughness``: its m2, and its spectrum where it has one, less the bands without power."""
        found = roughness.spectrum
        if found is None or np.count_nonzero(found.psd > 0.0) < 2:
            return cls(E_star, roughness.rms_gradient, gamma=gamma)
        holds = found.psd > 0.0
        return cls(E_star, roughness.rms_gradient, found.q[holds], found.psd[holds], gamma=gamma)

    @cached_property
    def gap(self) -> PerssonGap:
        """Theory of the mean gap and the stiffness.

        Raises
        ------
        InputError
            If there is no spectrum.
        """
        if not self._has_spectrum:
            raise InputError(
                "power spectrum must be given for the mean gap in Persson's theory, but is not: give q and psd."
            )
        return PerssonGap(self.E_star, IsotropicSpectrum(self.q, self.psd), self.gamma)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Area, mean real pressure and, with a spectrum, mean gap and stiffness at ``pressure`` (n,) in Pa, > 0."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        known = {"area_fraction": self.area_fraction(p)}
        if self._has_spectrum:
            known |= {"mean_gap": self.gap.mean_gap(p), "stiffness": self.gap.stiffness(p)}
        return prediction(p, **known)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """The range of loads in which the calibrated gap has been compared with elasticity, where there is a gap."""
        if not self._has_spectrum:
            return ()
        message = "The calibrated mean gap is within 7 % of elasticity inside these loads only."
        relative = prediction.pressure / (self.E_star * self.rms_gradient)
        return (Limit("p/(E* h'_rms), for the mean gap", relative, 0.01, 0.2, "Yang2008", message),)

    @property
    def _has_spectrum(self) -> bool:
        return np.size(self.q) > 0 or np.size(self.psd) > 0

    @property
    def spread(self) -> float:
        """s = E* h'_rms/2 in Pa, standard deviation of the pressure in full contact."""
        return 0.5 * self.E_star * self.rms_gradient

    def area_fraction(self, pressure: ArrayLike) -> RealArray:
        """A/A_n at the mean ``pressure`` in Pa (>= 0, any shape): erf[sqrt(2) p/(E* h'_rms)]."""
        from scipy.special import erf

        return np.asarray(erf(_pressures(pressure) / (math.sqrt(2.0) * self.spread)))

    def pressure_for(self, area_fraction: float) -> float:
        """Mean pressure in Pa at which ``area_fraction`` (0 < … < 1) is in contact."""
        from scipy.special import erfinv

        area = require.between(area_fraction, 0.0, 1.0, "area fraction", "Full contact needs an infinite pressure.")
        return math.sqrt(2.0) * self.spread * float(erfinv(area))

    def pressure_density(self, local: ArrayLike, pressure: float) -> RealArray:
        """Density P in 1/Pa of the pressure ``local`` in Pa (>= 0, any shape) at the mean ``pressure`` in Pa.

        The integral over all pressures is the area fraction, that of p P the mean pressure; P ∝ p near zero.
        """
        nominal = require.not_negative(pressure, "mean pressure (Pa)")
        p, s = _pressures(local), self.spread
        # a difference of Gaussians as one Gaussian times 1 - exp, which keeps its digits near zero pressure
        front = np.exp(-((p - nominal) ** 2) / (2.0 * s**2)) / (math.sqrt(2.0 * math.pi) * s)
        values: RealArray = front * -np.expm1(-2.0 * p * nominal / s**2)
        return values

    def at_local(self, local: ArrayLike, pressure: float) -> LocalPressures:
        """Distribution of the pressure at ``local`` pressures in Pa (>= 0, any shape) under the mean ``pressure`` in Pa."""
        return LocalPressures(self.pressure_density(local, pressure), self.area_fraction_above(local, pressure))

    def area_fraction_above(self, local: ArrayLike, pressure: float) -> RealArray:
        """Share of the nominal area on which the pressure exceeds ``local`` in Pa (>= 0, any shape)."""
        from scipy.special import erfc

        nominal = require.not_negative(pressure, "mean pressure (Pa)")
        p, width = _pressures(local), math.sqrt(2.0) * self.spread
        return np.asarray(0.5 * (erfc((p - nominal) / width) - erfc((p + nominal) / width)))


def _pressures(pressure: ArrayLike) -> RealArray:
    values = np.asarray(pressure, dtype=float)
    if not (np.isfinite(values).all() and (values >= 0.0).all()):
        raise InputError(f"pressure (Pa) must be finite and not negative, but its least value is {values.min():g}.")
    return values
