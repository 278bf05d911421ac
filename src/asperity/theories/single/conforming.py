"""Conforming contacts: a cylinder in a hole and a sphere in a cavity of nearly the same radius."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Length
from ..ask import LINE_LOAD, Way
from ..protocol import Bound, ContactAnswer, Modulus, Theory, bisected, checked, small_slope
from .indenters import SphericalIndenter

_NODES = 48

Inner = Annotated[Length, "radius of the inner body R1"]
Outer = Annotated[Length, "radius of the hole or cavity R2, larger than R1"]

_ARC = small_slope("contact radius over radius of the inner body", lambda theory, answer: answer.radius / theory.inner)


@dataclass(frozen=True)
class _InHole(Theory):
    """Base of theories of a body in a hole that is larger."""

    E_star: Modulus
    inner: Inner
    outer: Outer

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.outer > self.inner:
            raise InputError(
                f"radius of the hole (m) must be larger than that of the body in it, {self.inner:g} m, but is "
                f"{self.outer:g} m."
            )


# Exact circular profiles on half-planes (Steuermann 1939; Johnson 1985, secs. 5.3 and 2.7): the gap
# is [R1 - sqrt(R1² - x²)] - [R2 - sqrt(R2² - x²)], and the contact a sum of flat punches of growing
# width.


@dataclass(frozen=True)
class CylinderInHole(_InHole):
    """Cylinder in a hole, both as half-planes, with the elliptic integrals K and E of the moduli
    k = a/R:

        P = E* (R_1 (K(k_1) - E(k_1)) - R_2 (K(k_2) - E(k_2))),  k_1 = a/R_1,  k_2 = a/R_2.

    What Hertz's parabolas leave out of the profile; what the half-planes leave out of the
    compliance is in ``PinInHole``.
    """

    name: ClassVar[str] = "cylinder-in-hole"
    title: ClassVar[str] = "Steuermann, cylinder in a hole"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Steuermann1939")
    limits: ClassVar[tuple[Bound, ...]] = (_ARC,)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape.

        InputError if a load needs a contact wider than 0.999 of the inner radius.
        """
        P = checked(load, "load per length (N/m)")
        widest = 0.999 * self.inner
        largest = float(self._load(np.array(widest)))
        if np.any(largest < P):
            raise InputError(
                f"load of a cylinder in a hole must be at most {largest:.4g} N/m, where half of it is in "
                f"contact, but is {float(P.max()):.4g} N/m."
            )
        a = bisected(lambda a: self._load(a) - P, np.zeros_like(P), np.full_like(P, widest))
        return self.at_half_width(a)

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, 0 <= a < R1, of any shape; approach and
        stiffness as for ``HertzLine``."""
        a = checked(half_width, "half-width (m)")
        if np.any(a >= self.inner):
            raise InputError(
                f"half-width must be less than the radius of the cylinder, {self.inner:g} m, but is "
                f"{float(a.max()):g} m."
            )
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(self._load(a), unknown, a, 2.0 * a, self._pressure(np.zeros_like(a), a), unknown)

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in
        N/m, > 0.

        (1/π) ∫ P'(t)/sqrt(t² - x²) dt over x < t < a, P' = E* Σ ± k E(k)/(1 - k²).
        """
        a = self.at_load(require.positive(load, "load per length (N/m)")).radius
        return self._pressure(np.minimum(np.abs(np.asarray(x, dtype=float)), a), a)

    def _load(self, a: RealArray) -> RealArray:
        """The sum written as one integral, E* ∫ x f'(x)/sqrt(a² - x²) dx with x = a sin t, in which
        nothing cancels."""
        t, weight = gauss(np.array([0.0, 0.5 * math.pi]), 2 * _NODES)
        square = (a[..., None] * np.sin(t)) ** 2
        s1, s2 = np.sqrt(self.inner**2 - square), np.sqrt(self.outer**2 - square)
        integral = np.sum(weight * np.sin(t) ** 2 / (s1 * s2 * (s1 + s2)), axis=-1)
        return np.asarray(self.E_star * (self.outer - self.inner) * (self.outer + self.inner) * a**2 * integral)

    def _pressure(self, x: RealArray, a: RealArray) -> RealArray:
        from scipy.special import ellipe

        end = np.sqrt(a**2 - x**2)  # t² = x² + v²
        v, weight = gauss(np.stack([0.0 * end, end], axis=-1), _NODES)
        m1, m2 = ((x[..., None] ** 2 + v**2) / R**2 for R in (self.inner, self.outer))
        rise = ellipe(m1) / (1.0 - m1) / self.inner - ellipe(m2) / (1.0 - m2) / self.outer  # P'(t)/E*t
        return np.asarray(self.E_star / np.pi * np.sum(weight * rise, axis=-1))


@dataclass(frozen=True)
class SphereInCavity(_InHole):
    """Sphere in a spherical cavity with the exact profiles of both, as half-spaces: the difference
    of two ``SphericalIndenter``.

        δ = a (artanh(a/R_1) - artanh(a/R_2)).

    Goodman and Keer (1965) treated sphere and cavity as such, which has no closed form.
    """

    name: ClassVar[str] = "sphere-in-cavity"
    title: ClassVar[str] = "Sphere in a cavity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Sneddon1965", "Steuermann1939")
    limits: ClassVar[tuple[Bound, ...]] = (_ARC,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape. InputError if it needs more than
        0.999 of the inner radius."""
        P = checked(load, "load (N)")
        widest = 0.999 * self.inner
        largest = float(self.at_radius(widest).load)
        if np.any(largest < P):
            raise InputError(
                f"load of a sphere in a cavity must be at most {largest:.4g} N, where half of it is in "
                f"contact, but is {float(P.max()):.4g} N."
            )
        a = bisected(lambda a: self.at_radius(a).load - P, np.zeros_like(P), np.full_like(P, widest))
        return self.at_radius(a)

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, 0 <= a < R1, of any shape."""
        inner, outer = (SphericalIndenter(self.E_star, R).at_radius(contact_radius) for R in (self.inner, self.outer))
        return ContactAnswer(
            load=inner.load - outer.load,
            approach=inner.approach - outer.approach,
            radius=inner.radius,
            area=inner.area,
            max_pressure=inner.max_pressure - outer.max_pressure,
            stiffness=inner.stiffness,
        )


# Disc in the hole of an infinite plane, exactly, for elastically similar bodies (Persson 1964;
# Ciavarella & Decuzzi 2001): with b = tan(ε/2) for the half-angle ε of contact and y = tan(θ/2),
# E'ΔR/P = [2 - ln(1 + b²) - 2b⁴]/[πb²(1 + b²)].


@dataclass(frozen=True)
class PinInHole(_InHole):
    """Disc in the hole of an infinite plate of the same material, exactly.

        2 E* ΔR/P = (2 - ln(1 + b²) - 2 b⁴)/(π b² (1 + b²)),  b = tan(ε/2).

    ε is the half-angle of the contact, ΔR the clearance. The force is held at the centre of the
    disc and far away in the plate. Without clearance the arc is 84.9° wide to each side whatever
    the load.
    """

    name: ClassVar[str] = "pin-in-hole"
    title: ClassVar[str] = "Persson, pin in a hole"
    citation_keys: ClassVar[tuple[str, ...]] = ("Ciavarella2001", "Persson1964")
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("largest_angle", "rad", "half-angle of contact that no load exceeds"),
    )

    @property
    def largest_angle(self) -> float:
        """Half-angle ε in rad of the contact without clearance, or under an infinite load."""
        b = bisected(lambda b: 2.0 * b**4 + np.log1p(b**2) - 2.0, np.array(0.1), np.array(1.0))
        return float(2.0 * np.arctan(b))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape; area and radius along the arc;
        approach not known (NaN)."""
        P = checked(load, "load per length (N/m)")
        b = self._width(P)
        arc = 2.0 * np.arctan(b) * self.inner
        unknown = np.full_like(P, np.nan)
        with np.errstate(invalid="ignore", divide="ignore"):
            peak = np.where(P > 0.0, _persson(np.zeros_like(b), b) * P / self.inner, 0.0)
        return ContactAnswer(P, unknown, arc, 2.0 * arc, peak, unknown)

    def angle(self, load: ArrayLike) -> RealArray:
        """Half-angle ε of the contact in rad under ``load`` in N/m, >= 0, of any shape."""
        return 2.0 * np.arctan(self._width(checked(load, "load per length (N/m)")))

    def pressure(self, angle: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the ``angle`` θ in rad (any shape) from the line of the force under
        ``load`` in N/m, > 0."""
        P = require.positive(load, "load per length (N/m)")
        b = self._width(np.asarray(P))
        y = np.tan(0.5 * np.clip(np.abs(np.asarray(angle, dtype=float)), 0.0, 0.5 * math.pi))
        return np.where(y < b, _persson(np.minimum(y, b), b) * P / self.inner, 0.0)

    def _width(self, P: RealArray) -> RealArray:
        """b at the loads."""
        share = P / (2.0 * self.E_star * (self.outer - self.inner))
        return bisected(
            lambda b: math.pi * b**2 * (1.0 + b**2) - share * (2.0 - np.log1p(b**2) - 2.0 * b**4),
            np.zeros_like(P),
            np.ones_like(P),
        )


def _persson(y: RealArray, b: RealArray) -> RealArray:
    """pR/P at y = tan(θ/2) <= b."""
    root, far = np.sqrt(b**2 - y**2), np.sqrt(1.0 + b**2)
    # ln((far + root)/(far - root)) = 2 artanh(root/far)
    logarithm = 2.0 * np.arctanh(root / far) / (2.0 * np.pi * b**2 * (1.0 + b**2))
    return np.asarray(2.0 * root / (np.pi * far * (1.0 + y**2)) + logarithm)
