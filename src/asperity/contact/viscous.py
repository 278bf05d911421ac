"""Shear of the liquid between sliding surfaces."""

from __future__ import annotations

import math

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from .wetting import LiquidFilm, Wetting


def viscous_force(gap: RealArray, grid: Grid, found: Wetting, film: LiquidFilm, speed: float) -> float:
    """Force in N on the menisci at the sliding ``speed`` in m/s, >= 0: μ A U <1/g>, at most strength times area.

    A is the area of the menisci without contact and <1/g> the mean of the inverse ``gap`` (nx, ny) in m over it.

    Raises
    ------
    InputError
        If the speed is negative, or the viscosity of the liquid is not known and it moves.
    """
    if require.not_negative(speed, "sliding speed (m/s)") == 0.0 or not found.menisci.any():
        return 0.0
    if math.isnan(film.viscosity):
        raise InputError(
            "viscosity of the liquid must be known for viscous friction, but is not; give it, or a speed of 0."
        )
    area = np.count_nonzero(found.menisci) * grid.pixel_area
    with np.errstate(divide="ignore"):
        shear = film.viscosity * speed * float(np.mean(1.0 / gap[found.menisci]))
    return area * min(shear, film.shear_strength)
