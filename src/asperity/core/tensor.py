"""Displacement and stress at points as values: named components, sums and multiples, nothing of
their physics."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Self

from .arrays import RealArray


class _Components:
    """Base of values with named components: sums, multiples, and functions of every component."""

    def __add__(self, other: Self) -> Self:
        return self.combined(other, operator.add)

    def __mul__(self, factor: float) -> Self:
        return self.map(lambda component: component * factor)

    def map(self, function: Callable[[RealArray], RealArray]) -> Self:
        """``function`` of every component."""
        return type(self)(*(function(component) for component in vars(self).values()))

    def combined(self, other: Self, function: Callable[[RealArray, RealArray], RealArray]) -> Self:
        """``function`` of every component of both."""
        return type(self)(*map(function, vars(self).values(), vars(other).values()))


@dataclass(frozen=True, eq=False)
class StressTensor(_Components):
    """Six components of the symmetric stress in Pa, tension positive: arrays of one shape, any
    shape."""

    xx: RealArray
    yy: RealArray
    zz: RealArray
    xy: RealArray
    xz: RealArray
    yz: RealArray

    def exchanged(self) -> StressTensor:
        """The same state with the axes x and y renamed into each other."""
        return StressTensor(xx=self.yy, yy=self.xx, zz=self.zz, xy=self.xy, xz=self.yz, yz=self.xz)


@dataclass(frozen=True, eq=False)
class Displacement(_Components):
    """Three components of the displacement in m: arrays of one shape, any shape."""

    x: RealArray
    y: RealArray
    z: RealArray

    def exchanged(self) -> Displacement:
        """The same displacement with the axes x and y renamed into each other."""
        return Displacement(x=self.y, y=self.x, z=self.z)


@dataclass(frozen=True, eq=False)
class ElasticFields(_Components):
    """Displacement and stress at the same points."""

    displacement: Displacement
    stress: StressTensor

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
    return normal / 6.0 + shear
