"""First yield of a Hertz contact with and without friction (Hamilton 1983; Johnson 1985, secs. 4.2, 7.1; Bhushan 1998, fig. 8).

Von Mises' criterion: yield starts where the largest sqrt(J2) reaches the yield stress in pure shear k = Y/√3. With friction
that place moves forward and up, and from some friction coefficient on (0.30 for a sphere at ν = 0.3) it lies on the surface.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.deviator import second_invariant
from ..core.tensor import StressTensor
from .hertz_fields import hertz_normal, hertz_shear
from .hertz_line_fields import hertz_line_normal, hertz_line_shear
from .protocol import Input, curve
from .single_contact import poissons_ratio
from .ways import Column, Way, asked

_ROUNDS = 14  # of refinement by 5 each: past the square root of the rounding, which the place of a maximum is known to


@dataclass(frozen=True)
class YieldOnset:
    """Largest sqrt(J2) in a contact of peak pressure 1 and contact radius (half-width) 1, and where it is.

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


@dataclass(frozen=True, eq=False)
class OnsetCurve:
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
            Column("peak_over_Y", "", "peak pressure at first yield over the tensile yield stress"),
            Column("peak_over_k", "", "peak pressure at first yield over the yield stress in shear"),
            Column("x", "", "place along the sliding direction in contact radii"),
            Column("z", "", "depth in contact radii; 0 is the surface"),
        ),
    ),
)
YIELDING = (Input("nu", "", "Poisson's ratio of the body that yields", of="bodies", default=0.3),)


@dataclass(frozen=True)
class SphereYield:
    """First yield of a point contact of revolution, pressed and sliding, by von Mises' criterion.

    Parameters
    ----------
    nu
        Poisson's ratio, 0 to 0.5.
    """

    nu: float = 0.3
    name: ClassVar[str] = "first-yield"
    title: ClassVar[str] = "First yield below a sphere, with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hamilton1983", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = YIELDING
    ways: ClassVar[tuple[Way, ...]] = ONSET

    def __post_init__(self) -> None:
        poissons_ratio(self.nu)

    def at_friction(self, friction: ArrayLike) -> OnsetCurve:
        """First yield at friction coefficients (n,), >= 0."""
        return OnsetCurve.of(
            [sphere_yield_onset(self.nu, float(mu)) for mu in curve(friction, "friction coefficients")]
        )


@dataclass(frozen=True)
class CylinderYield:
    """First yield of a line contact in plane strain, pressed and sliding; see ``SphereYield``."""

    nu: float = 0.3
    name: ClassVar[str] = "first-yield-line"
    title: ClassVar[str] = "First yield below a cylinder, with friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "McEwen1949")
    inputs: ClassVar[tuple[Input, ...]] = YIELDING
    ways: ClassVar[tuple[Way, ...]] = ONSET

    def __post_init__(self) -> None:
        poissons_ratio(self.nu)

    def at_friction(self, friction: ArrayLike) -> OnsetCurve:
        """First yield at friction coefficients (n,), >= 0."""
        return OnsetCurve.of(
            [cylinder_yield_onset(self.nu, float(mu)) for mu in curve(friction, "friction coefficients")]
        )


def sphere_yield_onset(nu: float, friction: float = 0.0) -> YieldOnset:
    """First yield of a point contact of revolution, Poisson's ratio ``nu`` (0 to 0.5), ``friction`` coefficient >= 0.

    Raises
    ------
    InputError
        If Poisson's ratio or the friction coefficient is out of range.
    """

    def stress(x: RealArray, z: RealArray) -> StressTensor:
        y = np.zeros_like(x)
        normal = hertz_normal(x, y, z, 1.0, shear=1.0, nu=nu).stress
        return normal + hertz_shear(x, y, z, 1.0, shear=1.0, nu=nu).stress * friction

    return _onset(stress, nu, friction)


def cylinder_yield_onset(nu: float, friction: float = 0.0) -> YieldOnset:
    """First yield of a line contact in plane strain; see ``sphere_yield_onset``."""

    def stress(x: RealArray, z: RealArray) -> StressTensor:
        normal = hertz_line_normal(x, z, 1.0, shear=1.0, nu=nu).stress
        return normal + hertz_line_shear(x, z, 1.0, shear=1.0, nu=nu).stress * friction

    return _onset(stress, nu, friction)


def _onset(stress: Callable[[RealArray, RealArray], StressTensor], nu: float, friction: float) -> YieldOnset:
    poissons_ratio(nu)
    require.not_negative(friction, "friction coefficient")

    def root_J2(x: RealArray, z: RealArray) -> RealArray:
        root: RealArray = np.sqrt(second_invariant(stress(x, z)))
        return root

    # without friction all is symmetric, and the place of a maximum is known to the root of the rounding only
    side = 0.0 if friction == 0.0 else 1.0
    surface, x_surface, _ = _largest(root_J2, (-1.0, 1.0), (0.0, 0.0))
    inside, x, z = _largest(root_J2, (-1.0, 1.0), (0.05, 1.5))
    if surface >= inside:
        return YieldOnset(surface, x_surface, 0.0, surface)
    return YieldOnset(inside, side * x, z, surface)


def _largest(
    function: Callable[[RealArray, RealArray], RealArray], along: tuple[float, float], down: tuple[float, float]
) -> tuple[float, float, float]:
    """Largest value in a rectangle and its place, by ever finer grids about the largest of the last one."""
    (low, high), (top, bottom) = along, down
    columns, rows = 161, 59 if bottom > top else 1
    while True:
        x, z = np.meshgrid(np.linspace(low, high, columns), np.linspace(top, bottom, rows))
        values = function(x, z)
        best = np.unravel_index(np.argmax(values), values.shape)
        step_x, step_z = (high - low) / (columns - 1), (bottom - top) / max(rows - 1, 1)
        if step_x < 5.0**-_ROUNDS:
            return float(values[best]), float(x[best]), float(z[best])
        low, high = max(along[0], float(x[best]) - step_x), min(along[1], float(x[best]) + step_x)
        top, bottom = max(0.0, float(z[best]) - step_z), float(z[best]) + step_z
        columns, rows = 11, 11 if step_z > 0.0 else 1
