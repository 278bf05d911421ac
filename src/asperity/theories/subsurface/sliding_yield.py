"""First yield of a Hertz contact with and without friction (Hamilton 1983; Johnson 1985, secs. 4.2,
7.1; Bhushan 1998, fig. 8).

Von Mises' criterion: yield starts where the largest sqrt(J2) reaches the yield stress in pure shear
k = Y/√3. With friction that place moves forward and up, and from some friction coefficient on (0.30
for a sphere at ν = 0.3) it lies on the surface.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.tensor import StressTensor, second_invariant
from ..ask import Way, asked
from ..protocol import PoissonOfSolid, Theory, curve, poissons_ratio
from .hertz import hertz_line_normal, hertz_line_shear, hertz_normal, hertz_shear

_ROUNDS = 14  # of refinement by 5 each: past the square root of the rounding, which the place of a maximum is known to


@dataclass(frozen=True)
class YieldOnset:
    """Largest sqrt(J2) in a contact of peak pressure 1 and contact radius (half-width) 1, and where
    it is.

    Parameters
    ----------
    root_J2
        max sqrt(J2)/p0 over the body.
    x, z
        Its place in contact radii, on the section y = 0; the counter-body moves toward +x.
    surface_root_J2
        max sqrt(J2)/p0 on the surface alone.
    """

    root_J2: float
    x: float
    z: float
    surface_root_J2: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Hamilton1983", "Johnson1985")

    @property
    def peak_over_k(self) -> float:
        """Peak pressure at first yield over the yield stress in pure shear k."""
        return 1.0 / self.root_J2

    @property
    def peak_over_Y(self) -> float:
        """Peak pressure at first yield over the tensile yield stress Y = √3 k."""
        return 1.0 / (math.sqrt(3.0) * self.root_J2)

    @property
    def at_surface(self) -> bool:
        """Whether yield starts on the surface."""
        return self.z == 0.0


@dataclass(frozen=True, eq=False, repr=False)
class OnsetCurve(Tabled):
    """First yield at friction coefficients (n,): see ``YieldOnset``."""

    peak_over_Y: RealArray
    peak_over_k: RealArray
    x: RealArray
    z: RealArray

    @classmethod
    def of(cls, onsets: list[YieldOnset]) -> OnsetCurve:
        """The curve through ``onsets``."""
        names = ("peak_over_Y", "peak_over_k", "x", "z")
        return cls(*(np.array([getattr(onset, name) for onset in onsets]) for name in names))


ONSET: tuple[Way, ...] = (
    Way(
        asked("friction", "", "friction coefficient"),
        "at_friction",
        (
            Quantity("peak_over_Y", "1", "peak pressure at first yield over the tensile yield stress"),
            Quantity("peak_over_k", "1", "peak pressure at first yield over the yield stress in shear"),
            Quantity("x", "1", "place along the sliding direction in contact radii"),
            Quantity("z", "1", "depth in contact radii; 0 is the surface"),
        ),
    ),
)


PoissonsRatio: TypeAlias = Annotated[PoissonOfSolid, Help("Poisson's ratio of the body that yields", of="bodies")]


@dataclass(frozen=True)
class SphereYield(Theory):
    """First yield of a point contact of revolution, pressed and sliding, by von Mises' criterion.

    max sqrt(J_2(p_0, μ)) = k = Y/sqrt(3).
    """

    nu: PoissonsRatio = 0.3
    name: ClassVar[str] = "first-yield"
    title: ClassVar[str] = "First yield below a sphere, with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hamilton1983", "Johnson1985")
    ways: ClassVar[tuple[Way, ...]] = ONSET

    def at_friction(self, friction: ArrayLike) -> OnsetCurve:
        """First yield at friction coefficients (n,), >= 0."""
        return OnsetCurve.of(_onsets(_sphere, self.nu, curve(friction, "friction coefficients")))


@dataclass(frozen=True)
class CylinderYield(Theory):
    """First yield of a line contact in plane strain, pressed and sliding; see ``SphereYield``.

    max sqrt(J_2(p_0, μ)) = k = Y/sqrt(3).
    """

    nu: PoissonsRatio = 0.3
    name: ClassVar[str] = "first-yield-line"
    title: ClassVar[str] = "First yield below a cylinder, with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "McEwen1949")
    ways: ClassVar[tuple[Way, ...]] = ONSET

    def at_friction(self, friction: ArrayLike) -> OnsetCurve:
        """First yield at friction coefficients (n,), >= 0."""
        return OnsetCurve.of(_onsets(_cylinder, self.nu, curve(friction, "friction coefficients")))


def sphere_yield_onset(nu: float, friction: float = 0.0) -> YieldOnset:
    """First yield of a point contact of revolution, Poisson's ratio ``nu`` (0 to 0.5), ``friction``
    coefficient >= 0.

    InputError if Poisson's ratio or the friction coefficient is out of range.
    """
    return _onsets(_sphere, nu, np.array([float(friction)]))[0]


def cylinder_yield_onset(nu: float, friction: float = 0.0) -> YieldOnset:
    """First yield of a line contact in plane strain; see ``sphere_yield_onset``."""
    return _onsets(_cylinder, nu, np.array([float(friction)]))[0]


def _sphere(nu: float, x: RealArray, z: RealArray) -> tuple[StressTensor, StressTensor]:
    y = np.zeros_like(x)
    normal = hertz_normal(x, y, z, 1.0, shear=1.0, nu=nu).stress
    return normal, hertz_shear(x, y, z, 1.0, shear=1.0, nu=nu).stress


def _cylinder(nu: float, x: RealArray, z: RealArray) -> tuple[StressTensor, StressTensor]:
    normal = hertz_line_normal(x, z, 1.0, shear=1.0, nu=nu).stress
    return normal, hertz_line_shear(x, z, 1.0, shear=1.0, nu=nu).stress


_Fields: TypeAlias = Callable[[float, RealArray, RealArray], tuple[StressTensor, StressTensor]]
"""Stress under the pressure, and under a shear traction equal to it, at (x, z) for a Poisson's
ratio."""


def _onsets(fields: _Fields, nu: float, friction: RealArray) -> list[YieldOnset]:
    """First yield at every one of the friction coefficients (n,)."""
    poissons_ratio(nu)
    for coefficient in friction:
        require.not_negative(float(coefficient), "friction coefficient")
    at_surface, x_surface, _ = _largest(fields, nu, friction, (0.0, 0.0))
    inside, x, z = _largest(fields, nu, friction, (0.05, 1.5))
    # without friction all is symmetric, and the place of a maximum is known to the root of the
    # rounding only
    x[friction == 0.0] = 0.0
    deeper = inside > at_surface
    columns = np.maximum(inside, at_surface), np.where(deeper, x, x_surface), np.where(deeper, z, 0.0), at_surface
    return [YieldOnset(*map(float, values)) for values in zip(*columns, strict=True)]


def _largest(
    fields: _Fields, nu: float, friction: RealArray, down: tuple[float, float]
) -> tuple[RealArray, RealArray, RealArray]:
    """Largest sqrt(J2) at depths ``down`` below the contact for every friction, and its place x, z.

    By ever finer grids about the largest value of the last one, of all frictions at once.
    """
    along, rows = (-1.0, 1.0), 11 if down[1] > down[0] else 1
    x, z = (a.ravel() for a in np.meshgrid(np.linspace(*along, 161), np.linspace(*down, 59 if rows > 1 else 1)))
    normal, shear = fields(nu, x, z)
    values = np.zeros_like(friction)
    best = [int(np.argmax(second_invariant(normal + shear * mu))) for mu in friction]
    step_x, step_z = np.array(2.0 / 160), np.array((down[1] - down[0]) / 58)
    x, z, each = x[best], z[best], np.arange(friction.size)
    for _ in range(_ROUNDS):
        low, high = np.maximum(along[0], x - step_x), np.minimum(along[1], x + step_x)
        top, bottom = np.maximum(0.0, z - step_z), z + step_z
        grid_x, grid_z = np.broadcast_arrays(
            np.linspace(low, high, 11, axis=-1)[:, None, :], np.linspace(top, bottom, rows, axis=-1)[:, :, None]
        )
        grid_x, grid_z = grid_x.reshape(friction.size, -1), grid_z.reshape(friction.size, -1)
        normal, shear = fields(nu, grid_x, grid_z)
        root_J2 = np.sqrt(second_invariant(normal + shear.map(lambda component: component * friction[:, None])))
        highest = np.argmax(root_J2, axis=1)
        values, x, z = root_J2[each, highest], grid_x[each, highest], grid_z[each, highest]
        step_x, step_z = (high - low) / 10.0, (bottom - top) / max(rows - 1, 1)
    return values, x, z
