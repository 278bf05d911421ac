"""Axisymmetric cosine cap pressed by a plane, exactly and to two terms of its profile (Sneddon 1965; Johnson 1985)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.quadrature import gauss
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer, bisected, checked, small_slope

TWO_TERMS = math.sqrt(9.0 / 8.0) / math.pi
"""a/λ = 0.3376 at which load and approach of the two-term profile have their maximum: the end of its use."""

_NODES = 24  # the integrand is entire; 24 leave rounding up to a = λ/2


@dataclass(frozen=True)
class SinusoidalAsperity:
    """Cap that drops as (h/2)(1 - cos 2πr/λ) from its top, with radius of curvature λ²/2π²h.

    δ = (π²ha/2λ) H0(2πa/λ) with Struve's function, P = (2πE*ha²/λ) ∫ sin²t sin((2πa/λ) sin t) dt over 0 < t < π/2.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    height
        h from crest to trough in m, > 0.
    wavelength
        λ in m, > 0.
    """

    E_star: float
    height: float
    wavelength: float
    name: ClassVar[str] = "sinusoidal-asperity"
    title: ClassVar[str] = "Sinusoidal asperity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Sneddon1965")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("height", "m", "height from crest to trough"),
        Input("wavelength", "m", "wavelength"),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.height, "height of the asperity (m)")
        require.positive(self.wavelength, "wavelength (m)")

    @property
    def radius(self) -> float:
        """Radius of curvature of the crest in m."""
        return self.wavelength**2 / (2.0 * math.pi**2 * self.height)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, from 0 to that of a = 0.35 λ, of any shape.

        Raises
        ------
        InputError
            If a load needs a larger contact, in which the valley around the cap takes part.
        """
        P = checked(load, "load (N)")
        widest = self.at_radius(0.35 * self.wavelength)
        if np.any(widest.load < P):
            raise InputError(
                f"load of a cap must be at most that of a contact radius of 0.35 wavelengths, {float(widest.load):.6g} N, "
                f"but is {float(P.max()):.6g} N. Beyond, the valley around the cap takes part: solve the contact."
            )
        a = bisected(lambda a: self.at_radius(a).load - P, np.zeros_like(P), np.full_like(P, widest.radius))
        return self.at_radius(a)

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape; the largest pressure is not known (NaN)."""
        from scipy.special import struve

        a = checked(contact_radius, "contact radius (m)")
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

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Small slopes at the edge."""
        steepest = math.pi * self.height / self.wavelength * np.sin(2.0 * math.pi * answer.radius / self.wavelength)
        return (small_slope("slope of the profile at the edge", np.asarray(steepest)),)


def two_term_load(contact_radius: ArrayLike, E_star: float, A1: ArrayLike, A2: ArrayLike) -> RealArray:
    """P in N for the profile A1 r² + A2 r⁴: (8/3) A1 E* a³ + (64/15) A2 E* a⁵; ``contact_radius`` a in m, any shape."""
    a = np.asarray(contact_radius, dtype=float)
    return np.asarray(E_star * a**3 * (8.0 / 3.0 * np.asarray(A1) + 64.0 / 15.0 * np.asarray(A2) * a**2))


def two_term_approach(contact_radius: ArrayLike, A1: ArrayLike, A2: ArrayLike) -> RealArray:
    """δ in m for the profile A1 r² + A2 r⁴: 2A1 a² + (8/3) A2 a⁴; ``contact_radius`` a in m, any shape."""
    a = np.asarray(contact_radius, dtype=float)
    return np.asarray(a**2 * (2.0 * np.asarray(A1) + 8.0 / 3.0 * np.asarray(A2) * a**2))


def two_terms(height: float, wavelength: float) -> tuple[float, float]:
    """A1 = π²h/λ² in 1/m and A2 = -π⁴h/3λ⁴ in 1/m³ of the cap."""
    A1 = math.pi**2 * require.positive(height, "height (m)") / require.positive(wavelength, "wavelength (m)") ** 2
    return A1, -A1 * math.pi**2 / (3.0 * wavelength**2)
