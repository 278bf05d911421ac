"""Adhesion of infinitely short range of a sphere on a coated half-space, by the energy that the
edge of the contact releases."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length, Pressure
from ..ask import BY_RADIUS, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, PoissonOfSolid, Radius, Theory, Work, checked
from ..single.coating import softening
from .short_range import CoatedJKR, CoatedState

WIDEST = 100.0
"""Contact radius over thickness up to which contacts are solved, to 1e-10. At 80 a coating ten
times as stiff as the base still takes 2 % from the pull-off, one a tenth as stiff adds 5 %."""

_SCANNED = 40
"""Radii among which the largest tensile load is bracketed."""


@dataclass(frozen=True)
class AdhesiveCoatedSphere(Theory):
    """Rigid sphere on a coating (1) of thickness h bonded to a half-space (2), with adhesion in the
    contact alone.

    With the compliance C(q) of the coated half-space the pressure follows from φ of one Fredholm
    equation of the contact radius a,

        φ(x) + (2/π) ∫ φ(t) ∫ M(q) cos qx cos qt dq dt = 2 E1* (δ - x²/R),
        P = ∫ φ dt over 0 < t < a,
        C(q) = 2 [1 + M(q)]/(E1* q),  E1* = E1/(1 - ν1²).

    The edge lies in the coating and releases the work of adhesion where

        φ(a)² = 8π E1* a w,  φ(a) < 0.

    M is that of a layer and a half-space (O'Sullivan & King 1988), with ξ = q h, μ = G1/G2, κ =
    (μ - 1)/(μ + 3 - 4ν1) and λ = 1 - 4(1 - ν1)/[1 + μ(3 - 4ν2)],

        1 + M = [1 + 4κξ e^(-2ξ) - λκ e^(-4ξ)]/[1 - (λ + κ + 4κξ²) e^(-2ξ) + λκ e^(-4ξ)].

    Examples
    --------
    >>> stiff = AdhesiveCoatedSphere(
    ...     10e6, 1e6, thickness=10e-6, radius=100e-6, work=2.0, coating_nu=0.25, base_nu=0.3
    ... )
    >>> f"{stiff.pull_off * 1e6:.0f} µN, {stiff.pull_off_ratio:.3f} of that without a coating"
    '730 µN, 0.774 of that without a coating'
    """

    coating: Annotated[Pressure, Help("Young's modulus E1 of the coating", of="bodies")]
    base: Annotated[Pressure, Help("Young's modulus E2 of the half-space", of="bodies")]
    thickness: Annotated[Length, Help("thickness h of the coating", of="bodies")]
    radius: Radius
    work: Work
    coating_nu: Annotated[PoissonOfSolid, Help("Poisson's ratio ν1 of the coating", of="bodies")] = 0.3
    base_nu: Annotated[PoissonOfSolid, Help("Poisson's ratio ν2 of the half-space", of="bodies")] = 0.3
    name: ClassVar[str] = "jkr-coated-sphere"
    title: ClassVar[str] = "JKR, coated sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1971", "Barthel2007", "OSullivan1988")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("pull_off", "N", "force that separates the bodies under dead load; NaN of a very thin coating"),
        Quantity("pull_off_ratio", "1", "that force over 1.5πwR, the one of a homogeneous half-space"),
        Quantity("pull_off_radius", "m", "contact radius at the pull-off"),
    )
    ways: ClassVar[tuple[Way, ...]] = (BY_RADIUS,)

    @property
    def coating_modulus(self) -> float:
        """E1* = E1/(1 - ν1²) in Pa."""
        return self.coating / (1.0 - self.coating_nu**2)

    def excess(self, wavenumber: RealArray) -> RealArray:
        """M of ``wavenumber`` q in rad/m, >= 0, of any shape: by how much the base makes the
        coating more compliant."""
        moduli = self.coating, self.base
        return softening(wavenumber, *moduli, self.thickness, self.coating_nu, self.base_nu)

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, > 0, of any shape; its pressure is
        infinitely tensile at the edge.

        InputError if a radius is not positive, or more than 100 times the thickness.
        """
        a = checked(contact_radius, "contact radius (m)", lowest=np.finfo(float).tiny)
        if (a > WIDEST * self.thickness).any():
            raise InputError(
                f"contact radius (m) must be at most {WIDEST:g} times the thickness {self.thickness:g} of the "
                f"coating, but is {a.max():g}. Use the theory jkr with the base alone."
            )
        contact = CoatedJKR(self.coating_modulus, self.excess, self.thickness, self.radius, self.work)
        found = [contact.at_radius(float(value)) for value in a.ravel()]
        load = np.array([state.load for state in found]).reshape(a.shape)
        approach = np.array([state.approach for state in found]).reshape(a.shape)
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(load, approach, a, np.pi * a**2, unknown, unknown)

    @cached_property
    def _off(self) -> CoatedState | None:
        """The contact of the most tensile load; None where its radius may be more than can be
        solved."""
        moduli = self.coating_modulus, self.base / (1.0 - self.base_nu**2)
        sizes = [float(np.cbrt(1.125 * math.pi * self.work * self.radius**2 / modulus)) for modulus in moduli]
        widest = WIDEST * self.thickness
        radii = np.geomspace(0.1 * min(sizes), min(10.0 * max(sizes), widest), _SCANNED)
        if radii[0] >= radii[-1]:
            return None
        contact = CoatedJKR(self.coating_modulus, self.excess, self.thickness, self.radius, self.work)
        least = int(np.argmin([contact.at_radius(float(a)).load for a in radii]))
        if least == _SCANNED - 1:
            return None
        return contact.pull_off(float(radii[max(least - 1, 0)]), float(radii[least + 1]))

    @property
    def pull_off(self) -> float:
        """Force in N that separates the bodies under dead load; NaN where the contact would be
        wider than 100 thicknesses."""
        return math.nan if self._off is None else -self._off.load

    @property
    def pull_off_ratio(self) -> float:
        """Pull-off over 1.5πwR."""
        return self.pull_off / (1.5 * math.pi * self.work * self.radius)

    @property
    def pull_off_radius(self) -> float:
        """Contact radius in m at the pull-off."""
        return math.nan if self._off is None else self._off.radius
