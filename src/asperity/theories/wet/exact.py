"""The exact meniscus between a sphere and a flat: Young and Laplace's surface of constant
curvature, with its force and volume."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quadrature import rule
from ...core.quantity import Quantity
from ...core.scipy_parts import optimize
from ...core.values import Number
from ..ask import Way, asked
from ..protocol import Bound, Theory, checked
from .meniscus import wetting_factor
from .single import Angle, SphereRadius, Tension

_NODES = 400
"""Nodes of the quadrature over the meridian, crowded at both ends."""

_STEEPEST = 1e6
"""Largest curvature that is looked at, over that of the circular arc."""


@dataclass(frozen=True, eq=False, repr=False)
class MeniscusShape(Tabled):
    """Exact menisci at filling angles; arrays of one shape: ``height`` of the rim on the sphere
    over the flat, radii of the wetted circle on the flat and of the neck (m), pressure ``deficit``
    (Pa), ``force`` (N) and ``volume`` (m³); ``arc_force`` (N) of a circular meridian, at its neck,
    and ``simple_force`` (N), 2 π R γ (cos θ_s + cos θ_p)(1 - D/s)."""

    height: RealArray
    plane_radius: RealArray
    neck_radius: RealArray
    deficit: RealArray
    force: RealArray
    volume: RealArray
    arc_force: RealArray
    simple_force: RealArray


@dataclass(frozen=True)
class ExactMeniscus(Theory):
    """Concave meniscus between a sphere and a flat, of constant mean curvature: what circular arcs
    approximate.

    The meridian with the inclination ψ, from the flat to the sphere at the filling angle β, obeys

        dψ/ds = K - sin ψ/r,  r sin ψ - K r²/2 = F/(2 π γ),

        ψ_p = π - θ_p,  ψ_s = β + θ_s.

    K is the pressure in the liquid over γ, found so that the meridian is as high as the gap. The
    force includes that of the surface tension along the rim and is the same at both ends. No
    gravity. Beside it stand the force of a circular meridian and that of the simple formula, which
    is too large by 0.28 to 0.4 times the root of height over radius.

    Examples
    --------
    >>> ring = ExactMeniscus(radius=1e-6, surface_tension=0.072, contact_angle=0.0)
    >>> found = ring.at_filling_angle([0.1])
    >>> share = found.force / found.simple_force
    >>> f"{found.height.item() * 1e9:.2f} nm high, {share.item():.3f} of the simple force"
    '5.00 nm high, 0.980 of the simple force'
    """

    radius: SphereRadius
    surface_tension: Tension
    contact_angle: Angle
    other_angle: Annotated[float, Number("angle"), Help("contact angle on the flat", of="bodies")] = 0.0
    gap: Annotated[float, Number("length", least=0.0), Help("gap D between sphere and flat", of="bodies")] = 0.0
    name: ClassVar[str] = "exact-meniscus"
    title: ClassVar[str] = "Exact meniscus of a sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Orr1975",)
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("filling_angle", "rad", "filling angle β of the sphere"),
            "at_filling_angle",
            (
                Quantity("height", "m", "height of the meniscus at the sphere"),
                Quantity("plane_radius", "m", "radius of the wetted circle on the flat"),
                Quantity("neck_radius", "m", "radius of the neck"),
                Quantity("deficit", "Pa", "pressure below that of the air in it"),
                Quantity("force", "N", "attraction of sphere and flat"),
                Quantity("volume", "m^3", "volume of the liquid"),
                Quantity("arc_force", "N", "attraction by a circular meridian, at its neck"),
                Quantity("simple_force", "N", "attraction by the simple formula"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        wetting_factor(self.contact_angle, self.other_angle)

    def at_filling_angle(self, filling_angle: ArrayLike) -> MeniscusShape:
        """Menisci at the filling angles β in rad, of any shape, > 0 and less than π - θ_s - θ_p,
        beyond which they are not concave.

        Raises
        ------
        NoSolutionError
            If no surface of constant curvature spans the gap.
        """
        angles = checked(filling_angle, "filling angle (rad)")
        most = math.pi - self.contact_angle - self.other_angle
        for angle in angles.ravel():
            if not 0.0 < angle < most:
                raise InputError(
                    f"filling angle (rad) must be greater than 0 and less than {most:.4g}, at which the meniscus is no "
                    f"longer concave, but is {angle:g}."
                )
        rows = np.array([self._one(float(angle)) for angle in angles.ravel()]).reshape(*angles.shape, 8)
        return MeniscusShape(*np.moveaxis(rows, -1, 0))

    def _one(self, angle: float) -> tuple[float, ...]:
        """Numbers of one meniscus in the order of the answer."""
        unit, gamma = self.radius, self.surface_tension
        rim, apart = math.sin(angle), self.gap / unit
        height = apart + 1.0 - math.cos(angle)
        start, end = angle + self.contact_angle, math.pi - self.other_angle
        meridian = _Meridian(rim, start, end)
        bend = height / (math.cos(start) + math.cos(self.other_angle))  # radius of the circular arc
        K = meridian.curvature(height, bend)
        r, dz = meridian.swept(K)
        cap = 1.0 - math.cos(angle)
        volume = math.pi * (float((r**2 * dz).sum()) - cap**2 * (3.0 - cap) / 3.0)
        neck = rim - bend * (1.0 - math.sin(start))  # of the whole arc
        simple = 2.0 * math.pi * wetting_factor(self.contact_angle, self.other_angle) * (1.0 - apart / height)
        return (
            unit * height,
            unit * meridian.radius_at(end, K),
            unit * meridian.radius_at(min(max(0.5 * math.pi, start), end), K),
            -K * gamma / unit,
            2.0 * math.pi * gamma * unit * meridian.pull(K),
            unit**3 * volume,
            gamma * unit * math.pi * (neck + neck**2 / bend),
            gamma * unit * simple,
        )


@dataclass(frozen=True)
class _Meridian:
    """Meridian that leaves the sphere at the radius ``rim`` with the inclination ``start`` and
    reaches the flat with ``end``; lengths over the radius of the sphere."""

    rim: float
    start: float
    end: float

    def pull(self, K: float) -> float:
        """F/(2 π γ), the same all along it."""
        return self.rim * math.sin(self.start) - 0.5 * K * self.rim**2

    def radius_at(self, psi: float, K: float) -> float:
        """Radius where the inclination is ``psi``."""
        c, sine = self.pull(K), math.sin(psi)
        return 2.0 * c / (sine + math.sqrt(max(sine**2 - 2.0 * K * c, 0.0)))

    def swept(self, K: float) -> tuple[RealArray, RealArray]:
        """Radii and heights of its elements."""
        nodes, weights = rule(_NODES)
        half, middle = 0.5 * (self.end - self.start), 0.5 * (self.end + self.start)
        # crowded at the ends, where the inclination of a wetted flat makes the root small
        psi = middle + half * (1.5 * nodes - 0.5 * nodes**3)
        step = weights * half * 1.5 * (1.0 - nodes**2)
        c, sine = self.pull(K), np.sin(psi)
        root = np.sqrt(sine**2 - 2.0 * K * c)
        r = 2.0 * c / (sine + root)
        return r, r * sine / root * step

    def curvature(self, height: float, bend: float) -> float:
        """K with which it is as high as wanted; ``bend`` is the radius of the circular arc.

        The height rises with K, so that the arc is only where the search begins.
        """

        def excess(K: float) -> float:
            return float(self.swept(K)[1].sum()) - height

        most = self._largest()
        low = -1.0 / bend
        while excess(low) > 0.0:
            low *= 2.0
            if low < -_STEEPEST / bend:
                break
        high = most * (1.0 - 1e-9) if most > 0.0 else 0.0
        if not excess(low) < 0.0 < excess(high):
            raise NoSolutionError(
                "filling angle (rad) must be such that a surface of constant curvature spans the gap, but is not: "
                "take a larger filling angle or a smaller gap."
            )
        return float(optimize.brentq(excess, low, high, xtol=1e-15 / bend, rtol=1e-14))

    def _largest(self) -> float:
        """Largest K with which the root stays real along the meridian."""
        least = min(math.sin(self.start), math.sin(self.end)) ** 2
        # sin²ψ = 2 K c with c = a - K b
        a, b = self.rim * math.sin(self.start), 0.5 * self.rim**2
        inside = a**2 - 2.0 * b * least
        return (a - math.sqrt(inside)) / (2.0 * b) if inside > 0.0 else a / (2.0 * b)
