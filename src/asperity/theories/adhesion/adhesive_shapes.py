"""Adhesion of infinitely short range beyond the sphere: any power-law profile, a cylinder, and a
wave with its jump into full contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.quantity import Quantity
from ...core.values import Number
from ..ask import BY_RADIUS, Way, asked
from ..protocol import ContactAnswer, Modulus, Radius, Theory, Work, checked
from ..single.indenters import Exponent
from ..single.waves import Amplitude, Wavelength
from .short_range import CylinderJKR, PowerLawJKR, WavyJKR


@dataclass(frozen=True)
class AdhesivePowerLaw(Theory):
    """Profile B r^n against a half-space, with adhesion in the contact alone; JKR's sphere is n =
    2, B = 1/2R.

        P = P_H(a) - sqrt(8π E* w a³),  δ = δ_H(a) - sqrt(2π a w/E*),  δ_H = κ B a^n,
        P_H = 2n/(n + 1) E* a δ_H.

    Examples
    --------
    >>> cone = AdhesivePowerLaw(E_star=1e6, coefficient=0.1, exponent=1.0, work=0.05)
    >>> f"{cone.pull_off * 1e6:.3f} µN under dead load"
    '42.972 µN under dead load'
    """

    E_star: Modulus
    coefficient: Annotated[float, Number("m^(1-n)", above=0.0), "B of the profile B r^n"]
    exponent: Exponent
    work: Work
    name: ClassVar[str] = "jkr-power-law"
    title: ClassVar[str] = "JKR, power-law profile"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1971", "Sneddon1965")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("pull_off", "N", "force that separates the bodies under dead load"),
        Quantity("jump_off", "m", "approach at which rigid grips part, negative"),
        Quantity("unloaded_radius", "m", "contact radius without load"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        replace(
            BY_RADIUS,
            columns=(
                *BY_RADIUS.columns,
                Quantity("stiffness", "N/m", "derivative of the load by the approach along the equilibria"),
            ),
        ),
    )

    @property
    def _contact(self) -> PowerLawJKR:
        return PowerLawJKR(self.E_star, self.exponent, self.coefficient, self.work)

    @property
    def pull_off(self) -> float:
        """Force in N that separates the bodies under dead load."""
        return -self._contact.pull_off.load

    @property
    def jump_off(self) -> float:
        """Approach in m at which rigid grips part."""
        return self._contact.fold.approach

    @property
    def unloaded_radius(self) -> float:
        """Contact radius in m without load."""
        return self._contact.unloaded.radius

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, > 0, of any shape; its pressure is
        infinitely tensile at the edge."""
        a = checked(contact_radius, "contact radius (m)", lowest=np.finfo(float).tiny)
        n, E = self.exponent, self.E_star
        pressed, pull, lift = self._contact.terms(a)
        load = 2.0 * n / (n + 1.0) * E * a * pressed - pull
        rise = 2.0 * n * E * pressed - 1.5 * pull / a  # dP/da
        along = (n * pressed - 0.5 * lift) / a  # dδ/da
        with np.errstate(divide="ignore"):
            stiffness = rise / along
        return ContactAnswer(load, pressed - lift, a, np.pi * a**2, np.full_like(a, np.nan), stiffness)


@dataclass(frozen=True)
class AdhesiveCylinder(Theory):
    """Cylinder of relative radius R with adhesion in the contact alone; P per length, a the
    half-width, P_c the pull-off force.

        P = π E* a²/4R - sqrt(2π E* w a),  P_c = 3 (π E* w² R/16)^(1/3)

    The approach of distant points depends on how the bodies are held, so approach and stiffness are
    NaN.

    Examples
    --------
    >>> cylinder = AdhesiveCylinder(E_star=1e6, radius=1e-4, work=0.05)
    >>> f"{cylinder.pull_off:.3f} N/m under dead load"
    '1.098 N/m under dead load'
    """

    E_star: Modulus
    radius: Radius
    work: Work
    name: ClassVar[str] = "jkr-cylinder"
    title: ClassVar[str] = "JKR, cylinder"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1971", "Johnson1985")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("pull_off", "N/m", "force per length that separates the bodies under dead load"),
        Quantity("unloaded_half_width", "m", "half-width without load"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("half_width", "m", "half-width of the contact"),
            "at_half_width",
            (Quantity("load", "N/m", "normal force per length"), Quantity("area", "m", "contact area per length")),
        ),
    )

    @property
    def _contact(self) -> CylinderJKR:
        return CylinderJKR(self.E_star, self.radius, self.work)

    @property
    def pull_off(self) -> float:
        """Force per length in N/m that separates the bodies under dead load."""
        return -self._contact.pull_off.load

    @property
    def unloaded_half_width(self) -> float:
        """Half-width in m without load."""
        return self._contact.unloaded.radius

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, > 0, of any shape; its pressure is infinitely
        tensile at the edge."""
        a = checked(half_width, "half-width (m)", lowest=np.finfo(float).tiny)
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(self._contact.load(a), unknown, a, 2.0 * a, unknown, unknown)


@dataclass(frozen=True)
class AdhesiveWave(Theory):
    """Gap Δ(1 - cos 2πx/λ) with adhesion in the contact alone (Johnson 1995), ψ = πa/λ, p* =
    πE*Δ/λ.

        p̄/p* = sin²ψ - α sqrt(tan ψ),  α² = 2E*w/(λ (p*)²).

    Pull-off and the jump into full contact lie where 4 sin^(3/2)ψ cos^(5/2)ψ = α; from α = 0.570 on
    the wave closes without load.

    Examples
    --------
    >>> wave = AdhesiveWave(E_star=1e6, amplitude=1e-6, wavelength=1e-4, work=2e-3)
    >>> pull_off, jump = -wave.pull_off_pressure, wave.jump_pressure
    >>> f"α = {wave.alpha:.3f}, pulls off at {pull_off:.0f} Pa, closes at {jump:.0f} Pa"
    'α = 0.201, pulls off at 1763 Pa, closes at 17321 Pa'
    """

    E_star: Modulus
    amplitude: Amplitude
    wavelength: Wavelength
    work: Work
    name: ClassVar[str] = "jkr-wave"
    title: ClassVar[str] = "JKR, wave (Johnson)"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1995",)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("alpha", "1", "strength of the adhesion against the wave: from 0.570 on it closes without load"),
        Quantity("full_contact_pressure", "Pa", "p*, mean pressure that closes the gap everywhere without adhesion"),
        Quantity("pull_off_pressure", "Pa", "mean pressure at the pull-off, negative; NaN where none is left"),
        Quantity("jump_pressure", "Pa", "mean pressure of the jump into full contact; NaN where it closes at touch"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("fraction", "", "contact fraction between 0 and 1"),
            "at_fraction",
            (
                Quantity("mean_pressure", "Pa", "mean pressure"),
                Quantity("approach", "m", "approach of the mean planes"),
            ),
        ),
    )

    @property
    def _wave(self) -> WavyJKR:
        return WavyJKR.of(self.E_star, self.wavelength, self.amplitude, self.work)

    @property
    def alpha(self) -> float:
        """α."""
        return self._wave.alpha

    @property
    def full_contact_pressure(self) -> float:
        """p* in Pa."""
        return math.pi * self.E_star * self.amplitude / self.wavelength

    @property
    def pull_off_pressure(self) -> float:
        """Mean pressure in Pa at the pull-off."""
        found = self._wave.stationary
        return self._wave.mean_pressure(found[0]) * self.full_contact_pressure if found else math.nan

    @property
    def jump_pressure(self) -> float:
        """Mean pressure in Pa of the jump into full contact."""
        found = self._wave.stationary
        return self._wave.mean_pressure(found[1]) * self.full_contact_pressure if found else math.nan

    def at_fraction(self, fraction: ArrayLike) -> WaveAnswer:
        """Mean pressure and approach at contact fractions between 0 and 1, of any shape; InputError
        if one is not."""
        share = checked(fraction, "contact fraction", lowest=np.finfo(float).tiny)
        if (share >= 1.0).any():
            raise InputError(f"contact fraction must be below 1, but is {share.max():.6g}.")
        pressure, approach = self._wave.at(0.5 * math.pi * share)
        return WaveAnswer(self.full_contact_pressure * pressure, self.amplitude * approach)


@dataclass(frozen=True, eq=False, repr=False)
class WaveAnswer(Tabled):
    """``mean_pressure`` in Pa and ``approach`` in m of contacts of a wave."""

    mean_pressure: RealArray
    approach: RealArray
