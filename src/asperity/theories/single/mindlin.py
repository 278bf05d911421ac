"""Tangential loading below the limit of friction: a stick zone and a slipping rim (Cattaneo 1938; Mindlin 1949).

The normal force comes first, then Q <= μP. The shear traction is q = μ [p(P) - p(P*)] with P* = P - Q/μ, the contact of
P* being the stick zone (Ciavarella 1998; Jäger 1998): exact for equal materials in plane strain, and for a point contact
but for the small transverse traction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Positive, Pressure
from ..ask import Way, asked
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, checked, small_slope
from .hertz import HertzLine, HertzPoint


def tangential_modulus(shear_0: float, nu_0: float, shear_1: float, nu_1: float) -> float:
    """G* in Pa, 1/G* = (2 - ν0)/4G0 + (2 - ν1)/4G1, from shear moduli (Pa) and Poisson's ratios of both bodies."""
    parts = [(shear_0, nu_0), (shear_1, nu_1)]
    return 1.0 / sum((2.0 - nu) / (4.0 * require.positive(G, "shear modulus (Pa)")) for G, nu in parts)


SLIP = (
    Quantity("normal.radius", "m", "radius (half-width) of the contact"),
    Quantity("stick_radius", "m", "radius (half-width) of the stick zone"),
    Quantity("displacement", "m", "tangential displacement of distant points"),
    Quantity("stiffness", "N/m", "derivative of the tangential force by it"),
)
"""What a contact under a tangential force answers; the first two in plane strain."""


@dataclass(frozen=True, eq=False)
class SlipAnswer:
    """A contact under a tangential force: arrays of one shape.

    Parameters
    ----------
    stick_radius
        Radius (half-width) c of the stick zone in m.
    displacement
        Tangential displacement of distant points relative to each other in m; NaN in plane strain.
    stiffness
        Derivative of the tangential force by that displacement in N/m; NaN in plane strain.
    normal
        The contact under the load alone.
    """

    stick_radius: RealArray
    displacement: RealArray
    stiffness: RealArray
    normal: ContactAnswer


@dataclass(frozen=True)
class MindlinPoint(Theory):
    """Sphere pressed by P, then pulled by Q; it sticks within the radius c.

    c = a (1 - Q/(μ P))^(1/3),  δ_x = μ (E*/G*) (a² - c²)/R,  dQ/dδ_x = 2 G* c.
    """

    E_star: Modulus
    radius: Radius
    G_star: Annotated[Pressure, Help("tangential modulus G*", of="bodies")]
    friction: Annotated[Positive, "friction coefficient μ"]
    name: ClassVar[str] = "mindlin"
    title: ClassVar[str] = "Cattaneo-Mindlin, point contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cattaneo1938", "Ciavarella1998", "Jager1998", "Mindlin1949")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(CONTACT_RADIUS.criterion, lambda theory, answer: answer.normal.radius / theory.radius),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(asked("tangential", "N", "tangential force"), "at_load", SLIP, (asked("load", "N", "normal force"),)),
    )

    @property
    def normal(self) -> HertzPoint:
        """The contact under the load alone."""
        return HertzPoint(self.E_star, self.radius)

    def at_load(self, load: float, tangential: ArrayLike) -> SlipAnswer:
        """Under ``load`` P in N, > 0, and the ``tangential`` force Q in N, 0 <= Q <= μP, of any shape.

        InputError if Q exceeds the limit of friction.
        """
        normal = self.normal.at_load(require.positive(load, "load (N)"))
        a = float(normal.radius)
        c = a * np.cbrt(_sticking(tangential, self.friction * load))
        ratio = self.E_star / self.G_star
        displacement = self.friction * ratio * (a - c) * (a + c) / self.radius
        return SlipAnswer(c, displacement, 2.0 * self.G_star * c, normal)

    def traction(self, r: ArrayLike, load: float, tangential: float) -> RealArray:
        """Shear traction q in Pa at the distance ``r`` in m (any shape) from the axis."""
        return _difference(self.normal, r, load, tangential, self.friction)


@dataclass(frozen=True)
class MindlinLine(Theory):
    """Cylinder in plane strain pressed by P, then pulled by Q (both per length); it sticks within |x| < c.

    c = a sqrt(1 - Q/(μ P)).
    """

    E_star: Modulus
    radius: Radius
    friction: Annotated[Positive, "friction coefficient μ"]
    name: ClassVar[str] = "mindlin-line"
    title: ClassVar[str] = "Cattaneo-Mindlin, line contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cattaneo1938", "Ciavarella1998", "Jager1998", "Mindlin1949")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(CONTACT_RADIUS.criterion, lambda theory, answer: answer.normal.radius / theory.radius),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("tangential", "N/m", "tangential force per length"),
            "at_load",
            SLIP[:2],
            (asked("load", "N/m", "normal force per length"),),
        ),
    )

    @property
    def normal(self) -> HertzLine:
        """The contact under the load alone."""
        return HertzLine(self.E_star, self.radius)

    def at_load(self, load: float, tangential: ArrayLike) -> SlipAnswer:
        """Under ``load`` P in N/m, > 0, and the ``tangential`` force Q in N/m, 0 <= Q <= μP, of any shape."""
        normal = self.normal.at_load(require.positive(load, "load per length (N/m)"))
        a = float(normal.radius)
        c = a * np.sqrt(_sticking(tangential, self.friction * load))
        unknown = np.full_like(c, np.nan)
        return SlipAnswer(c, unknown, unknown, normal)

    def traction(self, x: ArrayLike, load: float, tangential: float) -> RealArray:
        """Shear traction q in Pa at the distance ``x`` in m (any shape) from the middle."""
        return _difference(self.normal, x, load, tangential, self.friction)

    def stick_shift(self, load: float, tangential: float, bulk_stress: float) -> float:
        """Shift e = aσ/(4μp0) in m of the stick zone by a tension σ = ``bulk_stress`` (Pa) in one of the bodies.

        InputError if the stick zone would reach the edge of the contact, e + c > a, where the solution is another one.
        """
        answer = self.normal.at_load(require.positive(load, "load per length (N/m)"))
        a, c = float(answer.radius), float(self.at_load(load, tangential).stick_radius)
        shift = a * require.finite(bulk_stress, "bulk stress (Pa)") / (4.0 * self.friction * float(answer.max_pressure))
        if abs(shift) + c > a * (1.0 + 1e-12):
            raise InputError(
                f"bulk stress must leave the stick zone inside of the contact, but {bulk_stress:g} Pa moves it by "
                f"{shift / a:.3g} half-widths with a half-width of {c / a:.3g}. Less bulk stress or more friction does."
            )
        return shift


def _sticking(tangential: ArrayLike, limit: float) -> RealArray:
    """1 - Q/μP."""
    Q = checked(tangential, "tangential force")
    if np.any(limit * (1.0 + 1e-12) < Q):
        raise InputError(
            f"tangential force must be at most friction coefficient times load, {limit:.6g}, but is {float(Q.max()):.6g}. "
            "Beyond it the contact slides."
        )
    return np.asarray(np.maximum(1.0 - Q / limit, 0.0))


def _difference(
    normal: HertzPoint | HertzLine, r: ArrayLike, load: float, tangential: float, friction: float
) -> RealArray:
    sticking = float(_sticking(tangential, friction * load))
    traction = normal.pressure(r, load)
    if sticking > 0.0:
        traction = traction - normal.pressure(r, load * sticking)
    return friction * traction
