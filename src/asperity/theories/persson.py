"""Persson's theory of rough contact: area and distribution of pressure from the rms slope alone."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError, NoSolutionError

LOW_LOAD_SLOPE = math.sqrt(8.0 / math.pi)
"""κ = (A/A_n) E* h'_rms/p at vanishing load."""


@dataclass(frozen=True)
class Persson:
    """Area and pressure of an elastic half-space on a randomly rough rigid surface.

    Roughness of ever shorter waves is taken in turn; with each the density P of the pressure spreads as by diffusion,
    ∂P/∂ζ = f(ζ) ∂²P/∂p², and what reaches zero pressure is out of contact (Persson 2001; Persson et al. 2002). With
    the standard deviation s = E* h'_rms/2 of the pressure in full contact the solution is a Gaussian about the mean
    pressure less its image. Exact at full contact; below it the area is about 30 % too small at 2 % contact and 20 %
    at 20 %, against elasticity, and the same for every width of the spectrum.

    Parameters
    ----------
    contact_modulus
        E* in Pa, > 0.
    rms_slope
        Root mean square gradient h'_rms of the composite surface, > 0: sqrt(2 m2).

    Raises
    ------
    InputError
        If a parameter is not positive.
    """

    contact_modulus: float
    rms_slope: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2002")

    def __post_init__(self) -> None:
        require.positive(self.contact_modulus, "contact modulus E* (Pa)")
        require.positive(self.rms_slope, "rms slope")

    @property
    def spread(self) -> float:
        """s = E* h'_rms/2 in Pa, standard deviation of the pressure in full contact."""
        return 0.5 * self.contact_modulus * self.rms_slope

    def area_fraction(self, pressure: ArrayLike) -> RealArray:
        """A/A_n at the mean ``pressure`` in Pa (>= 0, any shape): erf[sqrt(2) p/(E* h'_rms)]."""
        from scipy.special import erf

        return np.asarray(erf(_pressures(pressure) / (math.sqrt(2.0) * self.spread)))

    def pressure_at(self, area_fraction: float) -> float:
        """Mean pressure in Pa at which ``area_fraction`` (0 < … < 1) is in contact."""
        from scipy.special import erfinv

        area = require.between(area_fraction, 0.0, 1.0, "area fraction", "Full contact needs an infinite pressure.")
        return math.sqrt(2.0) * self.spread * float(erfinv(area))

    def mean_real_pressure(self, pressure: ArrayLike) -> RealArray:
        """Mean pressure in Pa over the contact at the mean ``pressure`` in Pa (> 0, any shape)."""
        nominal = _pressures(pressure)
        if not (nominal > 0.0).all():
            raise NoSolutionError("mean pressure (Pa) must be greater than zero for a mean real pressure, but is zero.")
        return np.asarray(nominal / self.area_fraction(nominal))

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
