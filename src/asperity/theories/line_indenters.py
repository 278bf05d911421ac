"""Rigid symmetric indenters in plane strain: power laws (wedge, cylinder, …) and flat punch (Galin 1946; Johnson 1985, ch. 2)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .indenters import convex, power_integral
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer, checked, small_slope
from .ways import LINE_LOAD, Way


@dataclass(frozen=True)
class LinePowerLawIndenter:
    """Profile f = B|x|ⁿ in plane strain: P = E* n B c aⁿ per length, c = (√π/2) Γ((n + 1)/2)/Γ(n/2 + 1).

    The wedge has n = 1 and slope B, the cylinder n = 2 and B = 1/2R. Approach and stiffness depend on how the body is
    held and are NaN.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    coefficient
        B in m^(1-n), > 0.
    exponent
        n, >= 1.
    """

    E_star: float
    coefficient: float
    exponent: float
    name: ClassVar[str] = "line-power-law-indenter"
    title: ClassVar[str] = "Power-law indenter in plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("coefficient", "m^(1-n)", "B of the profile B |x|^n"),
        Input("exponent", "", "n of the profile"),
    )
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.coefficient, "coefficient of the profile")
        convex(self.exponent)

    @property
    def load_factor(self) -> float:
        """c of P = E* n B c aⁿ."""
        n = self.exponent
        return 0.5 * math.sqrt(math.pi) * math.exp(math.lgamma(0.5 * n + 0.5) - math.lgamma(0.5 * n + 1.0))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape."""
        P = checked(load, "load per length (N/m)")
        return self.at_half_width((P / self._stiff) ** (1.0 / self.exponent))

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, >= 0, of any shape."""
        a = checked(half_width, "half-width (m)")
        load, unknown = self._stiff * a**self.exponent, np.full_like(a, np.nan)
        # the pressure of n <= 2 is largest in the middle, (n P/πa)/(n - 1)
        n = self.exponent
        with np.errstate(invalid="ignore", divide="ignore"):
            middle = (
                np.where(a > 0.0, n * load / (np.pi * a), 0.0) / (n - 1.0) if n > 1.0 else np.where(a > 0, np.inf, 0)
            )
        peak = middle if n <= 2.0 else unknown
        return ContactAnswer(load, unknown, a, 2.0 * a, np.asarray(peak, dtype=float), unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in N/m, > 0.

        (n P/πa) ∫ t^(n-1)/sqrt(t² - ξ²) dt over ξ = x/a < t < 1; infinite under the edge of a wedge.
        """
        answer = self.at_load(require.positive(load, "load per length (N/m)"))
        xi = np.abs(np.asarray(x, dtype=float)) / answer.radius
        scale = self.exponent * answer.load / (np.pi * answer.radius)
        values = scale * power_integral(np.where((xi > 0.0) & (xi < 1.0), xi, 1.0), self.exponent)
        profile: RealArray = np.where(
            xi == 0.0, scale / (self.exponent - 1.0) if self.exponent > 1.0 else np.inf, values
        )
        return profile

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Slopes must be small: n B a^(n-1) <= 0.3 at the edge of the contact."""
        slope = self.exponent * self.coefficient * answer.radius ** (self.exponent - 1.0)
        return (small_slope("slope of the profile at the edge", slope),)

    @property
    def _stiff(self) -> float:
        return self.E_star * self.exponent * self.coefficient * self.load_factor


@dataclass(frozen=True)
class LineFlatPunch:
    """Flat rigid punch of the half-width a in plane strain: p = P/(π sqrt(a² - x²)), P per length.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    half_width
        a in m, > 0.
    """

    E_star: float
    half_width: float
    name: ClassVar[str] = "line-flat-punch"
    title: ClassVar[str] = "Flat punch in plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("half_width", "m", "half the width of the punch"),
    )
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.half_width, "half-width of the punch (m)")

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; approach and stiffness depend on the supports."""
        P = checked(load, "load per length (N/m)")
        ones, unknown = np.ones_like(P), np.full_like(P, np.nan)
        peak = np.where(P > 0.0, np.inf, 0.0)
        return ContactAnswer(P, unknown, self.half_width * ones, 2.0 * self.half_width * ones, peak, unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in N/m; infinite at the edge."""
        distance = np.abs(np.asarray(x, dtype=float))
        P = require.positive(load, "load per length (N/m)")
        root = np.sqrt(np.maximum(self.half_width**2 - distance**2, 0.0))
        with np.errstate(divide="ignore"):
            profile: RealArray = np.where(distance > self.half_width, 0.0, P / (np.pi * root))
        return profile

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """The pressure away from the edge must be small against the modulus: P/2aE* <= 0.3."""
        return (small_slope("mean pressure over contact modulus", answer.mean_pressure / self.E_star),)
