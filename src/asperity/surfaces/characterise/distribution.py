"""How the heights are distributed, beside the normal distribution of the same deviation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ..surface import Surface
from .heights import deviations


@dataclass(frozen=True, eq=False)
class HeightDistribution:
    """Probability density of the heights about their mean: ``edges`` (n + 1,) in m, ``density`` (n,) in 1/m.

    ``deviation`` is Sq in m, that of the normal distribution to compare with.
    """

    edges: RealArray
    density: RealArray
    deviation: float

    def normal(self, height: RealArray) -> RealArray:
        """Density in 1/m of the normal distribution of the same deviation at ``height`` in m; zero for a flat map."""
        if self.deviation == 0.0:
            return np.zeros_like(height)
        values: RealArray = np.exp(-0.5 * (height / self.deviation) ** 2) / (np.sqrt(2.0 * np.pi) * self.deviation)
        return values


def height_distribution(surface: Surface, bins: int | None = None) -> HeightDistribution:
    """Histogram of the valid heights of ``surface`` in equal ``bins`` from the lowest to the highest.

    By default there are as many bins as Rice's rule says, 2 N^(1/3), up to 100.

    Raises
    ------
    InputError
        If ``bins`` is not a whole number >= 1.
    """
    z = deviations(surface)
    count = (
        min(100, int(np.ceil(2.0 * z.size ** (1.0 / 3.0))))
        if bins is None
        else require.integer(bins, 1, "number of bins")
    )
    density, edges = np.histogram(z, count, density=True)
    return HeightDistribution(edges, density, float(np.sqrt(np.mean(np.square(z)))))
