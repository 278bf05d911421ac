"""Sizes of the contact spots of a fractal surface: Korcak's law of islands (Mandelbrot 1982; Majumdar & Bhushan 1991)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError


@dataclass(frozen=True)
class SpotSizes:
    """N(A > a) = (a_l/a)^(D/2) spots larger than a, none larger than a_l; without bound towards small ones.

    Parameters
    ----------
    dimension
        Fractal dimension D of the profile, 1 < D < 2.

    Raises
    ------
    InputError
        If the dimension is out of its range.
    """

    dimension: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Majumdar1991",)

    def __post_init__(self) -> None:
        require.between(self.dimension, 1.0, 2.0, "fractal dimension of a profile")

    def larger_than(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Number of spots with more than the area ``spot`` in m² (any shape), ``largest`` a_l in m²."""
        a, limit = spot_areas(spot), spot_areas(largest)
        return np.asarray(np.where(a <= limit, (limit / a) ** (0.5 * self.dimension), 0.0))

    def density(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Number n(a) of spots per area in 1/m² of the area ``spot``: (D/2) a_l^(D/2)/a^(D/2+1)."""
        return np.asarray(0.5 * self.dimension * self.larger_than(spot, largest) / spot_areas(spot))

    def share_below(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Share of the real area in spots smaller than ``spot`` in m²: (a/a_l)^(1-D/2)."""
        return np.asarray(np.minimum(1.0, spot_areas(spot) / spot_areas(largest)) ** (1.0 - 0.5 * self.dimension))

    def area(self, largest: ArrayLike) -> RealArray:
        """Area in m² of all spots when the largest has ``largest`` m²: D a_l/(2-D)."""
        return np.asarray(self.dimension / (2.0 - self.dimension) * spot_areas(largest))

    def largest(self, area: ArrayLike) -> RealArray:
        """Area a_l in m² of the largest spot when all together have ``area`` m²."""
        return np.asarray((2.0 - self.dimension) / self.dimension * spot_areas(area))


def spot_areas(value: ArrayLike) -> RealArray:
    """Return ``value`` in m² as an array, any shape, if all are positive and finite.

    Raises
    ------
    InputError
        If they are not.
    """
    areas = np.asarray(value, dtype=float)
    if not (np.isfinite(areas).all() and (areas > 0.0).all()):
        raise InputError(
            f"area of a contact spot (m^2) must be positive and finite, but its least value is {areas.min():g}."
        )
    return areas
