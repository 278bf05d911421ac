"""Wavy surfaces: one wave, crossed waves, and the crest of a wave."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Length
from ..protocol import (
    Bound,
    ContactAnswer,
    Modulus,
    Prediction,
    Theory,
    bisected,
    checked,
    curve,
    prediction,
    small_slope,
)
from .hertz import HertzPoint, root_gap

Amplitude: TypeAlias = Annotated[Length, "amplitude of the wave"]
Wavelength: TypeAlias = Annotated[Length, "wavelength λ"]

# Partial contact of a sinusoid (Westergaard 1939; Johnson 1985, sec. 13.2).


@dataclass(frozen=True)
class Westergaard(Theory):
    """Gap Δ(1 - cos 2πx/λ) before loading, pressed by the mean pressure p̄; p* just closes it
    everywhere.

        p* = π E* Δ/λ,  A/A_a = (2/π) arcsin sqrt(p̄/p*),  max p = 2 sqrt(p̄ p*),
        δ = Δ (p̄/p*) [1 - ln(p̄/p*)].

    Examples
    --------
    >>> wave = Westergaard(E_star=1e9, amplitude=1e-6, wavelength=1e-3)
    >>> [round(float(part), 3) for part in wave.area_fraction([0.1e6, 1e6, 4e6])]
    [0.114, 0.382, 1.0]
    """

    E_star: Modulus
    amplitude: Amplitude
    wavelength: Wavelength
    name: ClassVar[str] = "westergaard"
    title: ClassVar[str] = "Westergaard, sinusoid"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Westergaard1939")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(
            "largest slope of the wave", lambda theory, answer: 2.0 * np.pi * theory.amplitude / theory.wavelength
        ),
    )
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("full_contact_pressure", "Pa", "mean pressure that closes the gap everywhere"),
    )

    @property
    def full_contact_pressure(self) -> float:
        """p* = πE*Δ/λ in Pa."""
        return np.pi * self.E_star * self.amplitude / self.wavelength

    def area_fraction(self, mean_pressure: ArrayLike) -> RealArray:
        """2a/λ = (2/π) arcsin sqrt(p̄/p*), 1 from p* on; ``mean_pressure`` p̄ in Pa, >= 0, of any
        shape."""
        return 2.0 / np.pi * np.arcsin(np.sqrt(np.minimum(self._share(mean_pressure), 1.0)))

    def max_pressure(self, mean_pressure: ArrayLike) -> RealArray:
        """Pressure at the crest in Pa: 2 sqrt(p̄ p*), from p* on p̄ + p*."""
        share = self._share(mean_pressure)
        return self.full_contact_pressure * np.where(share < 1.0, 2.0 * np.sqrt(share), 1.0 + share)

    def approach(self, mean_pressure: ArrayLike) -> RealArray:
        """Approach δ of the mean planes since first touch in m: Δω(1 - ln ω), ω = p̄/p*; Δ from p*
        on."""
        share = np.minimum(self._share(mean_pressure), 1.0)
        return self.amplitude * share * (1.0 - np.log(np.maximum(share, 1e-300)))

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

    def gap(self, x: ArrayLike, mean_pressure: float) -> RealArray:
        """Distance of the deformed surfaces in m at ``x`` in m (any shape) from a crest, zero in
        contact.

        2Δ [S sqrt(S² - s²) - s² arcosh(S/s)], S = |sin ψ|, s = sin ψa.
        """
        share = min(require.positive(mean_pressure, "mean pressure (Pa)") / self.full_contact_pressure, 1.0)
        sine = np.abs(np.sin(np.pi * np.asarray(x, dtype=float) / self.wavelength))
        return 2.0 * self.amplitude * root_gap(sine, np.asarray(math.sqrt(share)))

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive; the gap is also the separation of
        the mean planes."""
        p = curve(pressure, "mean pressures (Pa)", positive=True)
        gap = self.mean_gap(p)
        return prediction(
            p, area_fraction=self.area_fraction(p), separation=gap, mean_gap=gap, stiffness=self.stiffness(p)
        )

    def _share(self, mean_pressure: ArrayLike) -> RealArray:
        return checked(mean_pressure, "mean pressure (Pa)") / self.full_contact_pressure


# Crossed waves (Johnson, Greenwood & Higginson 1985): asymptotes of light load and full contact, a
# table between them.
#
# The table was computed with asperity's solver on one period at 160² to 256² points: areas
# corrected for the perimeter, mean over seven grids, of which the standard error is up to 1.5e-4;
# cubic interpolation between the rows adds up to 3e-4, and at p̄/p* = 0.21 to 0.24, where the
# separate contacts join, up to 8e-4.


AREA_ERROR = 1e-3
"""Largest error of the tabulated area fraction of crossed waves."""

_AREAS = (
    (0.01, 0.03632),
    (0.02, 0.05868),
    (0.03, 0.07807),
    (0.05, 0.1128),
    (0.075, 0.1525),
    (0.1, 0.1904),
    (0.15, 0.2651),
    (0.17, 0.2957),
    (0.185, 0.3197),
    (0.2, 0.3445),
    (0.21, 0.3626),
    (0.22, 0.3816),
    (0.23, 0.4049),
    (0.24, 0.4256),
    (0.25, 0.4433),
    (0.265, 0.4665),
    (0.28, 0.4879),
    (0.3, 0.5136),
    (0.32, 0.5376),
    (0.35, 0.5705),
    (0.4, 0.6197),
    (0.45, 0.6637),
    (0.5, 0.7039),
    (0.55, 0.7412),
    (0.6, 0.776),
    (0.65, 0.8087),
    (0.7, 0.8398),
    (0.75, 0.8693),
    (0.8, 0.8975),
    (0.85, 0.9246),
    (0.9, 0.9506),
    (0.93, 0.9658),
    (0.95, 0.9757),
    (0.97, 0.9855),
    (0.98, 0.9904),
    (0.99, 0.9952),
    (0.995, 0.9976),
)
"""p̄/p* and area fraction."""


@dataclass(frozen=True)
class CrossedWaves(Theory):
    """Gap Δ(2 - cos 2πx/λ - cos 2πy/λ) before loading; p* closes it everywhere.

        p* = 2 π E* Δ/λ,
        A/A_a ≈ π (3 p̄/(8 π p*))^(2/3)  (p̄ ≤ 0.02 p*),
        A/A_a ≈ 1 - (3/(2 π)) (1 - p̄/p*)  (p̄ ≥ 0.95 p*).

    Both are asymptotes; at any load the area is that of a table computed with asperity's solver,
    within 1e-3. The product form Δ' cos(2πx'/λ') cos(2πy'/λ') of the paper is the same surface
    turned by 45°, Δ = Δ'/2, λ = λ'/√2.
    """

    E_star: Modulus
    amplitude: Amplitude
    wavelength: Wavelength
    name: ClassVar[str] = "crossed-waves"
    title: ClassVar[str] = "Johnson-Greenwood-Higginson, crossed waves"
    citation_keys: ClassVar[tuple[str, ...]] = ("JohnsonGreenwood1985",)
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(
            "largest slope of the waves",
            lambda theory, answer: 2.0 * math.sqrt(2.0) * math.pi * theory.amplitude / theory.wavelength,
        ),
    )
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("full_contact_pressure", "Pa", "mean pressure that closes the gap everywhere"),
    )

    @property
    def full_contact_pressure(self) -> float:
        """p* = 2πE*Δ/λ in Pa."""
        return 2.0 * np.pi * self.E_star * self.amplitude / self.wavelength

    @property
    def crest(self) -> HertzPoint:
        """One crest as a sphere of R = λ²/4π²Δ."""
        return HertzPoint(self.E_star, self.wavelength**2 / (4.0 * np.pi**2 * self.amplitude))

    def area_fraction(self, mean_pressure: ArrayLike) -> RealArray:
        """Area fraction at any load from the table, within 1e-3, 1 from p* on; ``mean_pressure`` in
        Pa, >= 0, of any shape.

        Monotone cubics in (p̄/p*)^(2/3) of the area over that of light load, exact at both ends.
        """
        from scipy.interpolate import PchipInterpolator

        share = np.minimum(checked(mean_pressure, "mean pressure (Pa)") / self.full_contact_pressure, 1.0)
        knots, areas = np.array([*_AREAS, (1.0, 1.0)]).T
        light = math.pi * (3.0 / (8.0 * math.pi)) ** (2.0 / 3.0)  # area of light load over (p̄/p*)^(2/3)
        place = knots ** (2.0 / 3.0)
        ratio = PchipInterpolator(np.append(0.0, place), np.append(1.0, areas / (light * place)))
        at = share ** (2.0 / 3.0)
        return np.asarray(ratio(at) * light * at)

    def area_fraction_at_low_load(self, mean_pressure: ArrayLike) -> RealArray:
        """Hertz at each crest, π (3p̄/8πp*)^(2/3); ``mean_pressure`` in Pa, >= 0, of any shape."""
        P = checked(mean_pressure, "mean pressure (Pa)") * self.wavelength**2
        return np.asarray(self.crest.at_load(P).area / self.wavelength**2)

    def max_pressure_at_low_load(self, mean_pressure: ArrayLike) -> RealArray:
        """Hertz's peak pressure at each crest in Pa."""
        return self.crest.at_load(checked(mean_pressure, "mean pressure (Pa)") * self.wavelength**2).max_pressure

    def area_fraction_at_high_load(self, mean_pressure: ArrayLike) -> RealArray:
        """1 - (3/2π)(1 - p̄/p*): round gaps that the pressure around them just holds open; 1 from
        p* on."""
        share = np.minimum(checked(mean_pressure, "mean pressure (Pa)") / self.full_contact_pressure, 1.0)
        return np.asarray(1.0 - 1.5 / np.pi * (1.0 - share))

    def full_contact(self, x: ArrayLike, y: ArrayLike, mean_pressure: float) -> RealArray:
        """Pressure in Pa at ``x``, ``y`` in m (broadcast) from a crest in full contact, p̄ >=
        p*."""
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
        """Prediction at nominal pressures (n,) in Pa, positive: the area."""
        p = curve(pressure, "mean pressures (Pa)", positive=True)
        return prediction(p, area_fraction=self.area_fraction(p))


# Axisymmetric cosine cap pressed by a plane, exactly and to two terms of its profile (Sneddon 1965;
# Johnson 1985).


TWO_TERMS = math.sqrt(9.0 / 8.0) / math.pi
"""a/λ = 0.3376 at which load and approach of the two-term profile have their maximum: the end of
its use."""

_NODES = 24  # the integrand is entire; 24 leave rounding up to a = λ/2


_WIDEST_CAP = 0.35
"""Contact radius over wavelength up to which the valley around a cap stays out of contact."""


@dataclass(frozen=True)
class SinusoidalAsperity(Theory):
    """Cap that drops as (h/2)(1 - cos 2πr/λ) from its top, with radius of curvature λ²/2π²h.

        δ = (π² h a/(2 λ)) H_0(2 π a/λ),
        P = (2 π E* h a²/λ) ∫_0^(π/2) (sin t)² sin((2 π a/λ) sin t) dt.

    H_0 is Struve's function.
    """

    E_star: Modulus
    height: Annotated[Length, "height from crest to trough"]
    wavelength: Wavelength
    name: ClassVar[str] = "sinusoidal-asperity"
    title: ClassVar[str] = "Sinusoidal asperity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Sneddon1965")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(
            "slope of the profile at the edge",
            lambda theory, answer: (
                math.pi * theory.height / theory.wavelength * np.sin(2.0 * math.pi * answer.radius / theory.wavelength)
            ),
        ),
    )

    @property
    def radius(self) -> float:
        """Radius of curvature of the crest in m."""
        return self.wavelength**2 / (2.0 * math.pi**2 * self.height)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, from 0 to that of a = 0.35 λ, of any shape.

        InputError if a load needs a larger contact, which would include the valley around the cap.
        """
        P = checked(load, "load (N)")
        widest = self.at_radius(_WIDEST_CAP * self.wavelength)
        if np.any(widest.load < P):
            raise InputError(
                f"load of a cap must be at most that of a contact radius of {_WIDEST_CAP:g} wavelengths, "
                f"{float(widest.load):.6g} N, but is {float(P.max()):.6g} N. At larger loads the valley around "
                "the cap is in contact: solve the contact numerically."
            )
        a = bisected(lambda a: self.at_radius(a).load - P, np.zeros_like(P), np.full_like(P, widest.radius))
        return self.at_radius(a)

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, 0 to 0.35 λ, of any shape; the largest
        pressure is not known (NaN).

        InputError if a radius is larger: the contact would include the valley around the cap.
        """
        from scipy.special import struve

        a = checked(contact_radius, "contact radius (m)")
        widest = _WIDEST_CAP * self.wavelength
        if np.any(a > widest):
            raise InputError(
                f"contact radius (m) of a cap must be at most {_WIDEST_CAP:g} wavelengths, {widest:.6g} m, but "
                f"is {float(a.max()):.6g} m. A larger contact includes the valley around the cap: solve it "
                "numerically."
            )
        q = 2.0 * math.pi / self.wavelength
        t, weight = gauss(np.array([0.0, 0.5 * math.pi]), _NODES)
        integral = np.sum(weight * np.sin(t) ** 2 * np.sin(q * a[..., None] * np.sin(t)), axis=-1)
        return ContactAnswer(
            load=self.E_star * self.height * q * a**2 * integral,
            approach=0.25 * math.pi * self.height * q * a * struve(0, q * a),
            radius=a,
            area=math.pi * a**2,
            max_pressure=np.full_like(a, np.nan),
            stiffness=2.0 * self.E_star * a,
        )


def two_term_load(contact_radius: ArrayLike, E_star: float, A1: ArrayLike, A2: ArrayLike) -> RealArray:
    """P in N for the profile A1 r² + A2 r⁴: (8/3) A1 E* a³ + (64/15) A2 E* a⁵; ``contact_radius`` a
    in m, any shape."""
    a = np.asarray(contact_radius, dtype=float)
    return np.asarray(E_star * a**3 * (8.0 / 3.0 * np.asarray(A1) + 64.0 / 15.0 * np.asarray(A2) * a**2))


def two_term_approach(contact_radius: ArrayLike, A1: ArrayLike, A2: ArrayLike) -> RealArray:
    """δ in m for the profile A1 r² + A2 r⁴: 2A1 a² + (8/3) A2 a⁴; ``contact_radius`` a in m, any
    shape."""
    a = np.asarray(contact_radius, dtype=float)
    return np.asarray(a**2 * (2.0 * np.asarray(A1) + 8.0 / 3.0 * np.asarray(A2) * a**2))


def two_terms(height: float, wavelength: float) -> tuple[float, float]:
    """A1 = π²h/λ² in 1/m and A2 = -π⁴h/3λ⁴ in 1/m³ of the cap."""
    A1 = math.pi**2 * require.positive(height, "height (m)") / require.positive(wavelength, "wavelength (m)") ** 2
    return A1, -A1 * math.pi**2 / (3.0 * wavelength**2)
