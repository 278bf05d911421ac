"""Contacts of fixed size whose shear traction is bounded by a constant τ, whatever the pressure
(Tresca's law of friction).

The stick zone shrinks from the edge as in Cattaneo's and Lubkin's contacts; the tractions are
elementary functions. The tangential twin of a flat punch with a plastic rim.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length, Pressure
from ..ask import Way, asked
from ..protocol import Theory, bisected, checked
from .torsion import TORQUE, Torsional

Bounded: TypeAlias = Annotated[Pressure, "largest shear traction τ"]
Disc: TypeAlias = Annotated[Length, "radius a of the contact"]


@dataclass(frozen=True, eq=False, repr=False)
class BoundedSlip(Tabled):
    """A contact with bounded traction under a force or torque: arrays of one shape.

    Parameters
    ----------
    stick_radius
        Radius (half-width) c of the stick zone in m.
    displacement
        Tangential displacement in m or rotation in rad of distant points against each other; NaN in
        plane strain.
    stiffness
        Derivative of force or torque by it; NaN in plane strain.
    """

    stick_radius: RealArray
    displacement: RealArray
    stiffness: RealArray


_STICK = Quantity("stick_radius", "m", "radius (half-width) of the stick zone")


def _angle(load: ArrayLike, what: str, largest: float) -> RealArray:
    """φ = arccos(c/a) of φ + sin φ cos φ = π/2 times ``load`` over its ``largest`` value."""
    Q = checked(load, what)
    if np.any(largest * (1.0 + 1e-12) < Q):
        raise InputError(
            f"{what} must be at most {largest:.6g}, but is {float(Q.max()):.6g}. Beyond it the contact slides."
        )
    target = 0.5 * np.pi * np.minimum(Q / largest, 1.0)
    return bisected(lambda phi: phi + np.sin(phi) * np.cos(phi) - target, 0.0 * target, 0.0 * target + 0.5 * np.pi)


def _sticking(r: RealArray, a: float, c: float, factor: RealArray | float = 1.0) -> RealArray:
    """(2/π) arctan of ``factor`` sqrt((a² - c²)/(c² - r²)) where it sticks, one where it slips,
    zero outside."""
    room = np.maximum((c - r) * (c + r), np.finfo(float).tiny)
    sticking = 2.0 / np.pi * np.arctan(factor * np.sqrt((a - c) * (a + c) / room))
    return np.where(r < c, sticking, np.where(r <= a, 1.0, 0.0))


@dataclass(frozen=True)
class TrescaDisc(Theory):
    """Disc of radius a under a shear force Q; it sticks within the radius c.

        Q = 2 τ a² [arccos(c/a) + (c/a) sqrt(1 - c²/a²)],  δ_x = (2 τ/G*) sqrt(a² - c²),
        q = (2 τ/π) arctan sqrt((a² - c²)/(c² - r²)).

    Exact for identical bodies of ν = 0, G* = G; otherwise but for the transverse traction, with G*
    of ``MindlinPoint``.

    Examples
    --------
    >>> disc = TrescaDisc(G_star=1e9, radius=1e-3, bound=1e6)
    >>> print(f"{float(disc.at_force(2.0).stick_radius):.2e}")
    8.51e-04
    """

    G_star: Annotated[Pressure, Help("tangential modulus G*", of="bodies")]
    radius: Disc
    bound: Bounded
    name: ClassVar[str] = "tresca-disc"
    title: ClassVar[str] = "Disc with bounded traction, shear"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("tangential", "N", "tangential force"),
            "at_force",
            (
                _STICK,
                Quantity("displacement", "m", "tangential displacement of distant points"),
                Quantity("stiffness", "N/m", "derivative of the tangential force by it"),
            ),
            checked=False,
        ),
    )

    def at_force(self, tangential: ArrayLike) -> BoundedSlip:
        """Under the force ``tangential`` Q in N, 0 <= Q <= πa²τ, of any shape."""
        phi = _angle(tangential, "tangential force (N)", np.pi * self.radius**2 * self.bound)
        c = self.radius * np.cos(phi)
        shift = 2.0 * self.bound / self.G_star * self.radius * np.sin(phi)
        return BoundedSlip(c, shift, 2.0 * self.G_star * c)

    def traction(self, r: ArrayLike, tangential: float) -> RealArray:
        """Shear traction in Pa at the distance ``r`` in m (any shape) from the axis."""
        c = float(self.at_force(tangential).stick_radius)
        return self.bound * _sticking(np.abs(np.asarray(r, dtype=float)), self.radius, c)


@dataclass(frozen=True)
class TrescaTwist(Theory):
    """Disc of radius a under a torque M; it sticks within the radius c.

        M = (4/3) τ a³ [arccos(c/a) + (c/a) sqrt(1 - c²/a²)],  θ = (τ/(2 G)) arcosh(a/c),
        q = (2 τ/π) arctan((r/a) sqrt((a² - c²)/(c² - r²))).

    Exact for every Poisson's ratio.
    """

    G_torsion: Torsional
    radius: Disc
    bound: Bounded
    name: ClassVar[str] = "tresca-twist"
    title: ClassVar[str] = "Disc with bounded traction, torsion"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Lubkin1951")
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            TORQUE,
            "at_torque",
            (
                _STICK,
                Quantity("displacement", "rad", "rotation of the bodies against each other"),
                Quantity("stiffness", "N*m", "derivative of the torque by it"),
            ),
            checked=False,
        ),
    )

    def at_torque(self, torque: ArrayLike) -> BoundedSlip:
        """Under the ``torque`` M in N m, 0 <= M <= (2π/3) a³τ, of any shape."""
        phi = _angle(torque, "torque (N m)", 2.0 * np.pi / 3.0 * self.radius**3 * self.bound)
        c = self.radius * np.cos(phi)
        rotation = 0.5 * self.bound / self.G_torsion * np.arctanh(np.sin(phi))  # arcosh(1/cos φ)
        return BoundedSlip(c, rotation, 16.0 / 3.0 * self.G_torsion * c**3)

    def traction(self, r: ArrayLike, torque: float) -> RealArray:
        """Circumferential traction in Pa at the distance ``r`` in m (any shape) from the axis."""
        c, distance = float(self.at_torque(torque).stick_radius), np.abs(np.asarray(r, dtype=float))
        return self.bound * _sticking(distance, self.radius, c, distance / self.radius)


@dataclass(frozen=True)
class TrescaLine(Theory):
    """Strip of half-width a under a shear force Q per length, in the plane or across it; it sticks
    within |x| < c.

        Q = 2 τ sqrt(a² - c²),  q = (2 τ/π) arctan sqrt((a² - c²)/(c² - x²)).

    For bodies without coupling, whatever their moduli.
    """

    half_width: Annotated[Length, "half-width a of the contact"]
    bound: Bounded
    name: ClassVar[str] = "tresca-line"
    title: ClassVar[str] = "Strip with bounded traction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(asked("tangential", "N/m", "tangential force per length"), "at_force", (_STICK,), checked=False),
    )

    def at_force(self, tangential: ArrayLike) -> BoundedSlip:
        """Under the force ``tangential`` Q in N/m, 0 <= Q <= 2aτ, of any shape."""
        Q, largest = checked(tangential, "tangential force per length (N/m)"), 2.0 * self.half_width * self.bound
        if np.any(largest * (1.0 + 1e-12) < Q):
            raise InputError(
                f"tangential force per length (N/m) must be at most {largest:.6g}, but is {float(Q.max()):.6g}. "
                "Beyond it the contact slides."
            )
        share = np.minimum(Q / largest, 1.0)
        unknown = np.full_like(share, np.nan)
        return BoundedSlip(self.half_width * np.sqrt((1.0 - share) * (1.0 + share)), unknown, unknown)

    def traction(self, x: ArrayLike, tangential: float) -> RealArray:
        """Shear traction in Pa at ``x`` in m (any shape) from the middle."""
        require.finite(tangential, "tangential force per length (N/m)")
        c = float(self.at_force(tangential).stick_radius)
        return self.bound * _sticking(np.abs(np.asarray(x, dtype=float)), self.half_width, c)
