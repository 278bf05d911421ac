"""Displacement and stress at points as values: named components, sums and multiples, nothing of their physics."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass, fields

from .arrays import RealArray


@dataclass(frozen=True, eq=False)
class StressTensor:
    """Six components of the symmetric stress in Pa, tension positive: arrays of one shape, any shape."""

    xx: RealArray
    yy: RealArray
    zz: RealArray
    xy: RealArray
    xz: RealArray
    yz: RealArray

    def __add__(self, other: StressTensor) -> StressTensor:
        return self.combined(other, operator.add)

    def __mul__(self, factor: float) -> StressTensor:
        return self.map(lambda component: component * factor)

    def map(self, function: Callable[[RealArray], RealArray]) -> StressTensor:
        """``function`` of every component."""
        return StressTensor(*(function(getattr(self, name)) for name in STRESSES))

    def combined(self, other: StressTensor, function: Callable[[RealArray, RealArray], RealArray]) -> StressTensor:
        """``function`` of every component of both."""
        return StressTensor(*(function(getattr(self, name), getattr(other, name)) for name in STRESSES))

    def exchanged(self) -> StressTensor:
        """The same state with the axes x and y renamed into each other."""
        return StressTensor(xx=self.yy, yy=self.xx, zz=self.zz, xy=self.xy, xz=self.yz, yz=self.xz)


@dataclass(frozen=True, eq=False)
class Displacement:
    """Three components of the displacement in m: arrays of one shape, any shape."""

    x: RealArray
    y: RealArray
    z: RealArray

    def __add__(self, other: Displacement) -> Displacement:
        return self.combined(other, operator.add)

    def __mul__(self, factor: float) -> Displacement:
        return self.map(lambda component: component * factor)

    def map(self, function: Callable[[RealArray], RealArray]) -> Displacement:
        """``function`` of every component."""
        return Displacement(function(self.x), function(self.y), function(self.z))

    def combined(self, other: Displacement, function: Callable[[RealArray, RealArray], RealArray]) -> Displacement:
        """``function`` of every component of both."""
        return Displacement(function(self.x, other.x), function(self.y, other.y), function(self.z, other.z))

    def exchanged(self) -> Displacement:
        """The same displacement with the axes x and y renamed into each other."""
        return Displacement(x=self.y, y=self.x, z=self.z)


@dataclass(frozen=True, eq=False)
class ElasticFields:
    """Displacement and stress at the same points."""

    displacement: Displacement
    stress: StressTensor

    def __add__(self, other: ElasticFields) -> ElasticFields:
        return self.combined(other, operator.add)

    def __mul__(self, factor: float) -> ElasticFields:
        return ElasticFields(self.displacement * factor, self.stress * factor)

    def map(self, function: Callable[[RealArray], RealArray]) -> ElasticFields:
        """``function`` of every component."""
        return ElasticFields(self.displacement.map(function), self.stress.map(function))

    def combined(self, other: ElasticFields, function: Callable[[RealArray, RealArray], RealArray]) -> ElasticFields:
        """``function`` of every component of both."""
        u = self.displacement.combined(other.displacement, function)
        return ElasticFields(u, self.stress.combined(other.stress, function))

    def exchanged(self) -> ElasticFields:
        """The same fields with the axes x and y renamed into each other."""
        return ElasticFields(self.displacement.exchanged(), self.stress.exchanged())


STRESSES = tuple(field.name for field in fields(StressTensor))
"""Names of the components of a stress, in order."""

AXES = tuple(field.name for field in fields(Displacement))
"""Names of the components of a displacement, in order."""


# The invariant of a stress that measures its departure from hydrostatic pressure.


def second_invariant(s: StressTensor) -> RealArray:
    """J2 of the deviator in Pa²: [(σxx-σyy)² + (σyy-σzz)² + (σzz-σxx)²]/6 + σxy² + σyz² + σxz²."""
    normal = (s.xx - s.yy) ** 2 + (s.yy - s.zz) ** 2 + (s.zz - s.xx) ** 2
    shear = s.xy**2 + s.yz**2 + s.xz**2
    invariant: RealArray = normal / 6.0 + shear
    return invariant
