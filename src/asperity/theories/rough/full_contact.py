"""Pressure of full contact, which may be tensile: a Gaussian for every Gaussian surface."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.quantity import Quantity
from ...core.scipy_parts import special
from ...core.values import Number, Several
from ..ask import PRESSURE, Way, asked
from ..protocol import GENTLE_SLOPES, Bound, Modulus, Theory, checked, curve, real_numbers
from ..statistics.roughness import Roughness
from .persson import IsotropicSpectrum


def tension_share(pressure: ArrayLike, spread: ArrayLike) -> RealArray:
    """Share of the area of full contact under tension: Q(p/s) for a mean ``pressure`` p in Pa and a
    ``spread`` s in Pa, > 0, of the pressure; of one shape."""
    return np.asarray(special.ndtr(-np.asarray(pressure) / np.asarray(spread)))


def mean_tension(pressure: ArrayLike, spread: ArrayLike) -> RealArray:
    """Tension of full contact over the whole area in Pa: s φ(p/s) - p Q(p/s); as
    ``tension_share``."""
    p, s = np.asarray(pressure), np.asarray(spread)
    density = np.exp(-0.5 * np.square(p / s)) / math.sqrt(2.0 * math.pi)
    return np.asarray(s * density - p * tension_share(p, s))


@dataclass(frozen=True, eq=False, repr=False)
class FullContactAnswer(Tabled):
    """Full contact at mean pressures (n,): ``tension_share`` of the area, ``mean_tension`` over the
    whole area in Pa; and ``area_fraction`` of the contact without tension."""

    tension_share: RealArray
    mean_tension: RealArray
    area_fraction: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class FullContactPressures(Tabled):
    """Densities in 1/Pa of the pressure at a point (n,): in full contact, and without tension."""

    density: RealArray
    absorbed: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class FullContactWaves(Tabled):
    """With the waves up to a wavenumber (n,): ``rms_gradient``, ``spread`` of the pressure in Pa
    and ``tension_share``; and ``area_fraction`` of the contact without tension."""

    rms_gradient: RealArray
    spread: RealArray
    tension_share: RealArray
    area_fraction: RealArray


@dataclass(frozen=True, eq=False)
class FullContact(Theory):
    """Pressure where a half-space follows a Gaussian surface everywhere, pulled where it must be.

    Persson's diffusion without an absorbing boundary, P(±∞, ζ) = 0: the pressure of full contact is
    linear in the heights, so for a Gaussian surface this is exact, with the mean p and the
    deviation s,

        P = exp(-(σ - p)²/(2 s²))/(s sqrt(2π)),  s² = ((E*)²/4) ∫ q² C d²q/(4 π²),
        A_t/A_a = Q(p/s),  p_t = s φ(p/s) - p Q(p/s),  U/A_a = (E*/4) ∫ q C d²q/(4 π²),

    Q and φ of the normal distribution, A_t and p_t area and mean of the tension, U the elastic
    energy. Without adhesion tension parts the bodies: ``persson`` absorbs what reaches zero, which
    leaves the area erf[p/(sqrt(2) s)] in contact, with the same s; the densities differ by the
    image of the Gaussian alone. Full contact is stable where the work of adhesion exceeds U/A_a
    (``persson-tosatti``). Of a map, also on layered bodies, ``asperity.contact.full_contact`` gives
    the field.

    InputError if the spectrum cannot be used.

    Examples
    --------
    >>> full = FullContact(1e11, q=[1e6, 1e7, 1e8], psd=[1e-30, 1e-30, 1e-34])
    >>> f"{full.spread / 1e9:.2f} GPa, {full.energy_per_area:.1f} J/m²"
    '3.19 GPa, 4.9 J/m²'
    >>> full.at_pressure([0.0, 1e9]).tension_share.round(3)
    array([0.5  , 0.377])
    """

    E_star: Modulus
    q: Annotated[ArrayLike, Several(Number("rad/m", above=0.0)), "wavenumbers of the power spectrum"]
    psd: Annotated[
        ArrayLike, Several(Number("power spectrum")), "power spectrum at those wavenumbers, m0 = (1/2π) ∫ q C dq"
    ]
    name: ClassVar[str] = "full-contact"
    title: ClassVar[str] = "Full contact, tension allowed"
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2002", "PerssonTosatti2001")
    limits: ClassVar[tuple[Bound, ...]] = (GENTLE_SLOPES,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("spread", "Pa", "standard deviation s of the pressure"),
        Quantity("energy_per_area", "J/m^2", "elastic energy over nominal area"),
        Quantity("rms_gradient", "1", "rms gradient of the surface"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            PRESSURE,
            "at_pressure",
            (
                Quantity("tension_share", "1", "share of the area under tension"),
                Quantity("mean_tension", "Pa", "tension over the whole area"),
                Quantity("area_fraction", "1", "area in contact where tension parts the bodies (Persson)"),
            ),
        ),
        Way(
            asked("local", "Pa", "pressure at a point, negative for tension"),
            "at_local",
            (
                Quantity("density", "1/Pa", "probability density of the pressure at a point"),
                Quantity("absorbed", "1/Pa", "the same where tension parts the bodies (Persson)"),
            ),
            (PRESSURE,),
            checked=False,
        ),
        Way(
            asked("wavenumber", "rad/m", "largest wavenumber that is taken into account"),
            "at_wavenumber",
            (
                Quantity("rms_gradient", "1", "rms gradient of these waves"),
                Quantity("spread", "Pa", "standard deviation of the pressure"),
                Quantity("tension_share", "1", "share of the area under tension"),
                Quantity("area_fraction", "1", "area in contact where tension parts the bodies (Persson)"),
            ),
            (PRESSURE,),
            checked=False,
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        _ = self.spectrum

    @classmethod
    def of_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the spectrum of ``roughness``, less the bands without power."""
        found = roughness.known(roughness.spectrum, "its power spectrum", cls.name)
        return cls(E_star, found.q[found.psd > 0.0], found.psd[found.psd > 0.0])

    @cached_property
    def spectrum(self) -> IsotropicSpectrum:
        """The spectrum of the surface."""
        return IsotropicSpectrum(self.q, self.psd)

    @property
    def rms_gradient(self) -> float:
        """h'_rms of the surface."""
        return self.spectrum.rms_slope

    @property
    def spread(self) -> float:
        """s = E* h'_rms/2 in Pa, standard deviation of the pressure."""
        return 0.5 * self.E_star * self.rms_gradient

    @property
    def energy_per_area(self) -> float:
        """Elastic energy of full contact over nominal area in J/m²."""
        return 0.25 * self.E_star * self.spectrum.moment(2) / (2.0 * math.pi)

    def at_pressure(self, pressure: ArrayLike) -> FullContactAnswer:
        """Tension at mean pressures (n,) in Pa, >= 0."""
        p = checked(curve(pressure, "pressures (Pa)"), "pressure (Pa)")
        s = np.full_like(p, self.spread)
        return FullContactAnswer(tension_share(p, s), mean_tension(p, s), 1.0 - 2.0 * tension_share(p, s))

    def at_local(self, local: ArrayLike, pressure: float) -> FullContactPressures:
        """Densities at ``local`` pressures (n,) in Pa, of either sign, under the mean ``pressure``
        in Pa, >= 0."""
        found, p = real_numbers(local, "pressures at a point (Pa)"), require.not_negative(pressure, "pressure (Pa)")
        s = self.spread
        front = np.exp(-0.5 * np.square((found - p) / s)) / (math.sqrt(2.0 * math.pi) * s)
        image = -np.expm1(-2.0 * np.maximum(found, 0.0) * p / s**2)
        return FullContactPressures(front, front * image)

    def at_wavenumber(self, wavenumber: ArrayLike, pressure: float) -> FullContactWaves:
        """With the waves up to the ``wavenumber`` (n,) in rad/m, above that of the longest wave, at
        the mean ``pressure`` in Pa, >= 0."""
        q, p = curve(wavenumber, "wavenumbers (rad/m)"), require.not_negative(pressure, "pressure (Pa)")
        first = float(np.asarray(self.spectrum.wavenumber)[0])
        if not q.min() > first:
            raise InputError(
                f"wavenumbers (rad/m) must be larger than that of the longest wave, {first:g}, but the smallest is "
                f"{q.min():g}."
            )
        gradient = np.sqrt(self.spectrum.partial_moment(3, np.log(q / first)) / (2.0 * math.pi))
        s = 0.5 * self.E_star * gradient
        share = tension_share(np.full_like(s, p), s)
        return FullContactWaves(gradient, s, share, 1.0 - 2.0 * share)
