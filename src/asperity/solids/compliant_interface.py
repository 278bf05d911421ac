"""Normal compliance of an interface of rough surfaces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError


@dataclass(frozen=True)
class CompliantInterface:
    """Pressure p = c w^m of an interface of rough surfaces that is compressed by w (Oden and
    Martins 1985).

    Parameters
    ----------
    stiffness
        c in Pa/m^m, > 0.
    exponent
        m, 1 to 10; rough surfaces have 2 to 3.33.
    """

    stiffness: float
    exponent: float = 2.0

    def __post_init__(self) -> None:
        require.positive(self.stiffness, "stiffness of the interface")
        if not 1.0 <= require.finite(self.exponent, "exponent of the interface") <= 10.0:
            raise InputError(f"exponent of the interface must be at least 1 and at most 10, but is {self.exponent:g}.")

    def pressure(self, overlap: RealArray) -> RealArray:
        """p in Pa at the ``overlap`` w in m of any shape; zero where it is negative."""
        return np.asarray(self.stiffness * np.maximum(overlap, 0.0) ** self.exponent)

    def slope(self, overlap: RealArray) -> RealArray:
        """dp/dw in Pa/m."""
        w = np.maximum(overlap, 0.0)
        return np.where(overlap > 0.0, self.stiffness * self.exponent * w ** (self.exponent - 1.0), 0.0)
