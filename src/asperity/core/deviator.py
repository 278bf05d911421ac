"""The invariant of a stress that measures its departure from hydrostatic pressure."""

from __future__ import annotations

from .arrays import RealArray
from .tensor import StressTensor


def second_invariant(s: StressTensor) -> RealArray:
    """J2 of the deviator in Pa²: [(σxx-σyy)² + (σyy-σzz)² + (σzz-σxx)²]/6 + σxy² + σyz² + σxz²."""
    normal = (s.xx - s.yy) ** 2 + (s.yy - s.zz) ** 2 + (s.zz - s.xx) ** 2
    shear = s.xy**2 + s.yz**2 + s.xz**2
    invariant: RealArray = normal / 6.0 + shear
    return invariant
