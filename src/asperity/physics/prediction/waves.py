"""Sums over the waves of a rough surface that decide its contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Self, TypeAlias

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, mode_sum, thread_count
from ...core.words import in_words
from ...solids.compliance.halfspace import contact_compliance
from ...solids.elastic import Rigid
from ...solids.layers import Body, Layered, contact_modulus
from ...surfaces.characterise.correlation import DROP_TENTH, autocovariance
from ...surfaces.characterise.spectrum import PowerSpectrum, power_spectrum
from ...surfaces.generate.autocorrelation import ExponentialAutocorrelation
from ...surfaces.generate.gaussian import Spectrum
from ...surfaces.prepare.level import filled
from ...surfaces.surface import Surface

Rough: TypeAlias = Surface | Spectrum
"""A measured or generated map, or the spectrum of surfaces that have not been made."""

LEAST_PROPORTION, LARGEST_PROPORTION = 0.5, 2.0
"""Ratio of the 10 % lengths along x and y between which a surface counts as isotropic."""


@dataclass(frozen=True)
class Waves:
    """Sums over the waves of a rough surface and the compliance of the bodies that it presses on.

    Attributes
    ----------
    full_contact
        s in Pa, rms pressure of full contact, s² = Σ |h|²/c².
    stiffening
        ε, mean of c_base/c with the weights |h|² q^(-1/2)/c_base; 1 on a half-space.
    rms, gradient
        Rms height in m, and rms of the gradient.
    nayak
        Bandwidth α = m0 m4/m2².
    length
        10 % length β in m, the mean of those along x and y; NaN if the correlation does not fall so
        far.
    modulus
        Contact modulus in Pa of the half-spaces below the layers.
    """

    full_contact: float
    stiffening: float
    rms: float
    gradient: float
    nayak: float
    length: float
    modulus: float

    @property
    def summit_length(self) -> float:
        """λ in m, rms gradient over rms curvature √(m2/m4): as wide as the smallest contacts."""
        return self.rms / self.gradient * math.sqrt(1.5 / self.nayak)

    @classmethod
    def of(cls, spectrum: PowerSpectrum, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums over the modes of ``spectrum``."""
        grid = spectrum.grid
        q = grid.wavenumber()
        q[0, 0] = q[-1, -1]  # any wavenumber: the mean has no share
        psd = spectrum.psd.copy()
        psd[0, 0] = 0.0
        m0, m2, m4 = (mode_sum(grid, psd * q**order) for order in (0, 2, 4))
        if not m0 > 0.0:
            raise InputError("surface of a prediction must be rough, but is flat.")
        compliance = contact_compliance(body, counter_body).spectral(q)
        modulus = contact_modulus(_base(body), _base(counter_body))
        weights = psd / np.sqrt(q)
        return cls(
            full_contact=math.sqrt(mode_sum(grid, psd / np.square(compliance))),
            stiffening=mode_sum(grid, weights / compliance) / mode_sum(grid, 0.5 * modulus * q * weights),
            rms=math.sqrt(m0),
            gradient=math.sqrt(m2),
            nayak=1.5 * m0 * m4 / m2**2,  # m2 and m4 of profiles are 1/2 and 3/8 of these sums
            length=_length(grid, psd),
            modulus=modulus,
        )

    @classmethod
    def of_spectrum(cls, grid: Grid, spectrum: Spectrum, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums expected of surfaces with the ``spectrum`` on a ``grid``."""
        found = cls.of(PowerSpectrum(grid, spectrum.lattice_psd(grid), "none"), body, counter_body)
        if not isinstance(spectrum, ExponentialAutocorrelation):
            return found
        # as it is without the removal of the mean from maps of finite size
        return replace(found, length=_isotropic(*(math.log(10.0) * decay for decay in spectrum.decay_lengths)))

    @classmethod
    def of_surface(cls, surface: Surface, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums of a map, of a measured one with a Hann window; missing points are filled."""
        whole = filled(surface) if surface.n_missing else surface
        found = cls.of(power_spectrum(whole), body, counter_body)
        covariance = autocovariance(surface)
        lengths = [covariance.correlation_length(DROP_TENTH, axis=axis, logarithmic=True) for axis in ("x", "y")]
        return replace(found, length=_isotropic(*lengths))


def _base(body: Body) -> Any:
    return body.base if isinstance(body, Layered) else body


def _length(grid: Grid, psd: RealArray) -> float:
    """10 % length of the autocovariance that belongs to the spectrum ``psd``."""
    covariance = RealTransform(grid.shape, thread_count()).backward(psd.astype(complex))
    lengths = []
    for values, pixel in ((covariance[:, 0], grid.spacing[0]), (covariance[0], grid.spacing[1])):
        below = np.flatnonzero(values <= DROP_TENTH * values[0])
        if below.size == 0:
            return math.nan
        after = int(below[0])
        high, low, level = float(values[after - 1]), float(values[after]), DROP_TENTH * float(values[0])
        share = math.log(high / level) / math.log(high / low) if low > 0.0 else (high - level) / (high - low)
        lengths.append(pixel * (after - 1 + share))
    return _isotropic(*lengths)


def _isotropic(along_x: float, along_y: float) -> float:
    """Mean of two lengths, which must be about the same."""
    if not math.isfinite(along_x + along_y):
        raise InputError(
            "autocorrelation of the surface must fall to 10 % within the map for a prediction, but does "
            "not. Level the surface, take a larger map, or solve it."
        )
    if not LEAST_PROPORTION <= along_x / along_y <= LARGEST_PROPORTION:
        raise InputError(
            f"surface of a prediction must be isotropic, but its 10 % lengths are {along_x:.3g} m along x and "
            f"{along_y:.3g} m along y. Solve it: {in_words('{solve}')}."
        )
    return 0.5 * (along_x + along_y)
