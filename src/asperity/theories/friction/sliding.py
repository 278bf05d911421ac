"""Sliding with friction in plane strain: a cylinder and a punch on a dissimilar body."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.quantity import Quantity
from ...core.values import Length, Number
from ..ask import LINE_LOAD, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, checked
from ..single.indenters import LineFlatPunch
from .full_stick import Beta

Coefficient = Annotated[float, Number(least=0.0), "friction coefficient μ"]

# Sliding in plane strain (Galin 1961; Johnson 1985, secs. 2.8 and 7.1). With the traction μp along
# +x on the body ∫ p(s)/(x - s) ds + π tan(πγ) p = (πE*/2) f'(x), tan πγ = -βμ: the surface rises
# behind the contact, which moves there.


def shift_exponent(beta: float, friction: float) -> float:
    """γ of tan πγ = -βμ, in -1/2 < γ < 1/2; negative where the contact moves against the direction
    of sliding."""
    return -math.atan(beta * friction) / math.pi


@dataclass(frozen=True)
class SlidingCylinder(Theory):
    """Cylinder that slides along +x with friction.

        p = (E* cos(π γ)/(2 R)) (a + x)^(1/2 + γ) (a - x)^(1/2 - γ),  tan(π γ) = -β μ,
        P = π E* a² (1 - 4 γ²)/(4 R).

    x counts from the middle of the contact, which lies at 2γa from the axis of the cylinder. The
    traction on the body is μp along +x, the direction in which the cylinder moves.

    Examples
    --------
    A rigid cylinder on a body of ν = 0.3 (β = 2/7) at μ = 0.5 touches 0.4 % more than without
    friction:

    >>> slides = SlidingCylinder(E_star=1e9, radius=1e-2, beta=2 / 7, friction=0.5)
    >>> stands = SlidingCylinder(E_star=1e9, radius=1e-2, beta=2 / 7, friction=0.0)
    >>> ratio = slides.at_load(1e3).radius / stands.at_load(1e3).radius
    >>> print(f"{float(ratio):.4f}, {slides.shift:.4f}")
    1.0041, -0.0903
    """

    E_star: Modulus
    radius: Radius
    beta: Beta
    friction: Coefficient
    name: ClassVar[str] = "sliding-cylinder"
    title: ClassVar[str] = "Cylinder sliding with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("shift", "1", "place of the middle of the contact over its half-width"),
    )

    @property
    def exponent(self) -> float:
        """γ."""
        return shift_exponent(self.beta, self.friction)

    @property
    def shift(self) -> float:
        """Place of the middle of the contact along +x from the axis of the cylinder over the
        half-width, 2γ."""
        return 2.0 * self.exponent

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; approach and stiffness depend on
        the supports (NaN)."""
        P, gamma = checked(load, "load per length (N/m)"), self.exponent
        a = np.sqrt(4.0 * P * self.radius / (np.pi * self.E_star * (1.0 - 4.0 * gamma**2)))
        scale = self.E_star * math.cos(math.pi * gamma) / (2.0 * self.radius)
        peak = scale * a * (1.0 + 2.0 * gamma) ** (0.5 + gamma) * (1.0 - 2.0 * gamma) ** (0.5 - gamma)
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(P, unknown, a, 2.0 * a, peak, unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from the axis of the cylinder under ``load`` in
        N/m, > 0."""
        a, gamma = float(self.at_load(require.positive(load, "load per length (N/m)")).radius), self.exponent
        place = np.asarray(x, dtype=float) - 2.0 * gamma * a
        front, back = np.maximum(a - place, 0.0), np.maximum(a + place, 0.0)
        scale = self.E_star * math.cos(math.pi * gamma) / (2.0 * self.radius)
        return scale * back ** (0.5 + gamma) * front ** (0.5 - gamma)


@dataclass(frozen=True)
class SlidingPunch(Theory):
    """Flat rigid punch that slides along +x without tilting, in plane strain with P per length.

        p = (P cos(π γ)/π) (a + x)^(γ - 1/2) (a - x)^(-γ - 1/2),  tan(π γ) = -β μ.

    The traction on the body is μp along +x.
    """

    E_star: Modulus
    half_width: Annotated[Length, "half the width of the punch a"]
    beta: Beta
    friction: Coefficient
    name: ClassVar[str] = "sliding-punch"
    title: ClassVar[str] = "Flat punch sliding with friction, plane strain"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1961", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = LineFlatPunch.limits
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("centre", "1", "place of the resultant pressure over the half-width"),
    )

    @property
    def centre(self) -> float:
        """Place of the resultant of the pressure along +x over the half-width, 2γ: where the force
        must act."""
        return 2.0 * shift_exponent(self.beta, self.friction)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; as without friction but for the
        pressure."""
        return LineFlatPunch(self.E_star, self.half_width).at_load(load)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from the middle under ``load`` in N/m, > 0;
        infinite at the edges."""
        P, gamma = require.positive(load, "load per length (N/m)"), shift_exponent(self.beta, self.friction)
        place, a = np.asarray(x, dtype=float), self.half_width
        outside = np.abs(place) > a
        front, back = np.where(outside, 1.0, a - place), np.where(outside, 1.0, a + place)
        with np.errstate(divide="ignore"):
            shape = back ** (gamma - 0.5) * front ** (-gamma - 0.5)
        return np.where(outside, 0.0, P * math.cos(math.pi * gamma) / math.pi * shape)
