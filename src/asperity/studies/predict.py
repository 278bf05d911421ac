"""Contacts of rough surfaces predicted from a table of solved ones, in milliseconds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np

from ..contact.controls import Force, MeanPressure, mean_pressure
from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.quantity import Quantity
from ..core.spectral import RealTransform, mode_sum, thread_count
from ..core.status import Advice
from ..physics.menisci.film import LiquidFilm
from ..solids.compliance.halfspace import contact_compliance
from ..solids.elastic import Elastic, Rigid
from ..solids.layers import Body, Bonded, Layered, contact_modulus, weaker_strength
from ..surfaces.characterise.correlation import DROP_TENTH, autocovariance
from ..surfaces.characterise.spectrum import PowerSpectrum, power_spectrum
from ..surfaces.generate.gaussian import Spectrum
from ..surfaces.prepare.level import filled
from ..surfaces.profile import Profile
from ..surfaces.surface import Surface
from ..theories.rough.predictor import SQRT_J2, Expected, Groups

Rough: TypeAlias = Surface | Spectrum
"""A measured or generated map, or the spectrum of surfaces that have not been made."""

NU = (0.2, 0.4)
"""Poisson's ratios of a layer and its base for which the factors of a layer hold."""

SOLVE = "Solve it instead: solve(ContactProblem(surface, body), MeanPressure(...)), or `asperity contact`."


@dataclass(frozen=True)
class Waves:
    """Sums over the waves of a rough surface and the compliance of the bodies that it presses
    on.

    Attributes
    ----------
    full_contact
        s in Pa, rms pressure of full contact: s² = Σ |h|²/c².
    stiffening
        ε, mean of c_base/c with the weights |h|² q^(-1/2)/c_base: 1 on a half-space.
    rms, gradient
        Rms height in m, rms of the gradient.
    nayak
        Bandwidth α = m0 m4/m2² of profile moments.
    modulus
        Contact modulus E in Pa of the half-spaces below the layers.
    """

    full_contact: float
    stiffening: float
    rms: float
    gradient: float
    nayak: float
    modulus: float

    @classmethod
    def of(cls, spectrum: PowerSpectrum, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums over the modes of ``spectrum``."""
        grid = spectrum.grid
        q = grid.wavenumber()
        q[0, 0] = q[0, 1]  # any wavenumber: the mean has no share
        psd = spectrum.psd.copy()
        psd[0, 0] = 0.0
        compliance = contact_compliance(body, counter_body).spectral(q)
        modulus = contact_modulus(_base(body), _base(counter_body))
        weights = psd / np.sqrt(q)
        m0, m2, m4 = (mode_sum(grid, psd * q**order) for order in (0, 2, 4))
        if not m0 > 0.0:
            raise InputError("surface must be rough for a prediction, but is flat.")
        return cls(
            math.sqrt(mode_sum(grid, psd / np.square(compliance))),
            mode_sum(grid, weights / compliance) / mode_sum(grid, 0.5 * modulus * q * weights),
            math.sqrt(m0),
            math.sqrt(m2),
            1.5 * m0 * m4 / m2**2,  # m2 and m4 of profiles are 1/2 and 3/8 of these sums
            modulus,
        )

    @classmethod
    def of_spectrum(cls, grid: Grid, spectrum: Spectrum, body: Body, counter_body: Body = Rigid()) -> Self:
        """Those expected of surfaces with the ``spectrum`` on a ``grid``."""
        return cls.of(PowerSpectrum(grid, spectrum.lattice_psd(grid), "none"), body, counter_body)


def _base(body: Body) -> Elastic | Rigid:
    return body.base if isinstance(body, Layered) else body  # type: ignore[return-value]
