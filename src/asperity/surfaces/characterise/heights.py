"""Height parameters of ISO 25178-2 about the mean of the valid points, normalised by their number N."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface


@dataclass(frozen=True)
class HeightParameters:
    """Height parameters: ``Sa``, ``Sq``, ``Sp``, ``Sv``, ``Sz`` in m; ``Ssk``, ``Sku`` NaN if all heights are equal."""

    Sa: float
    Sq: float
    Sp: float
    Sv: float
    Sz: float
    Ssk: float
    Sku: float


def height_parameters(surface: Surface) -> HeightParameters:
    """All height parameters of ``surface`` in one pass over its valid points."""
    z = deviations(surface)
    squared = np.square(z)
    mean_square = float(squared.mean())
    highest, lowest = float(z.max()), float(z.min())
    return HeightParameters(
        Sa=float(np.abs(z).mean()),
        Sq=float(np.sqrt(mean_square)),
        Sp=highest,
        Sv=-lowest,
        Sz=highest - lowest,
        Ssk=float((squared * z).mean()) / mean_square**1.5 if mean_square > 0.0 else math.nan,
        Sku=float(np.square(squared).mean()) / mean_square**2 if mean_square > 0.0 else math.nan,
    )


def mean_height(surface: Surface) -> float:
    """Mean of the valid heights in m."""
    valid = _valid(surface)
    return float(valid[0] + (valid - valid[0]).mean())  # avoids cancellation with a large common offset


def rms_height(surface: Surface) -> float:
    """Sq = sqrt(<z²>) in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.1)."""
    return float(np.sqrt(np.mean(np.square(deviations(surface)))))


def mean_absolute_height(surface: Surface) -> float:
    """Sa = <|z|> in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.7)."""
    return float(np.mean(np.abs(deviations(surface))))


def highest_peak(surface: Surface) -> float:
    """Sp = max z in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.4)."""
    return float(deviations(surface).max())


def deepest_valley(surface: Surface) -> float:
    """Sv = -min z in m, positive, z measured from the mean of the valid points (ISO 25178-2, 4.1.5)."""
    return float(-deviations(surface).min())


def peak_to_valley(surface: Surface) -> float:
    """Sz = Sp + Sv = max z - min z in m over the valid points (ISO 25178-2, 4.1.6)."""
    valid = _valid(surface)
    return float(valid.max() - valid.min())


def skewness(surface: Surface) -> float:
    """Ssk = <z³>/Sq³, 0 for Gaussian heights (ISO 25178-2, 4.1.2).

    Raises InputError if all heights are equal.
    """
    return _defined(height_parameters(surface).Ssk, "skewness")


def kurtosis(surface: Surface) -> float:
    """Sku = <z⁴>/Sq⁴, 3 for Gaussian heights (not the excess), never below 1 + Ssk² (ISO 25178-2, 4.1.3).

    Raises InputError if all heights are equal.
    """
    return _defined(height_parameters(surface).Sku, "kurtosis")


def _valid(surface: Surface) -> RealArray:
    return surface.heights[~surface.mask].astype(np.float64, copy=False)


def deviations(surface: Surface) -> RealArray:
    """Heights (N,) of the valid points less their mean, in m."""
    valid = _valid(surface)
    shifted = valid - valid[0]  # avoids cancellation with a large common offset
    return np.asarray(shifted - shifted.mean())


def _defined(value: float, what: str) -> float:
    if math.isnan(value):
        raise InputError(f"surface must have heights that differ for its {what} to be defined, but all are equal.")
    return value


# Height distribution.


@dataclass(frozen=True, eq=False)
class HeightDistribution:
    """Probability density of the heights about their mean: ``edges`` (n + 1,) in m, ``density`` (n,) in 1/m.

    ``deviation`` is Sq in m.
    """

    edges: RealArray
    density: RealArray
    deviation: float

    def normal(self, height: RealArray) -> RealArray:
        """Density in 1/m of the normal distribution of the same deviation at ``height`` in m; zero for a flat map."""
        if self.deviation == 0.0:
            return np.zeros_like(height)
        return np.asarray(np.exp(-0.5 * (height / self.deviation) ** 2) / (np.sqrt(2.0 * np.pi) * self.deviation))


def height_distribution(surface: Surface, bins: int | None = None) -> HeightDistribution:
    """Histogram of the valid heights of ``surface`` in equal ``bins`` from the lowest to the highest.

    By default the number of bins follows Rice's rule, 2 N^(1/3), up to 100.
    Raises InputError if ``bins`` is not a whole number >= 1.
    """
    z = deviations(surface)
    count = (
        min(100, int(np.ceil(2.0 * z.size ** (1.0 / 3.0))))
        if bins is None
        else require.integer(bins, 1, "number of bins")
    )
    density, edges = np.histogram(z, count, density=True)
    return HeightDistribution(edges, density, float(np.sqrt(np.mean(np.square(z)))))


# Tilt.


def tilt_share(surface: Surface) -> float:
    """Share of the mean square height in the least-squares plane, 0 to 1; 0 for a flat map. It is exact for a complete
    map and an estimate with missing points, since the fits along x and y are then not independent.
    """
    z = np.where(surface.mask, 0.0, surface.heights - mean_height(surface))
    total = float(np.einsum("ij,ij", z, z))
    if total == 0.0:
        return 0.0
    count = surface.grid.n_points - surface.n_missing
    return min(1.0, sum(_explained(z.sum(axis=1 - axis), count) for axis in (0, 1)) / total)


def _explained(sums: RealArray, count: int) -> float:
    """Sum of squares that the line along an axis explains, from the ``sums`` of heights of its lines."""
    x = np.arange(sums.size) - 0.5 * (sums.size - 1)
    spread = float(x @ x) * count / sums.size
    return float(x @ sums) ** 2 / spread if spread > 0.0 else 0.0
