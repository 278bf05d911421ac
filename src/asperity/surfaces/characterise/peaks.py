"""Peaks of the profiles of a surface: the quantities of Whitehouse & Archard (1970)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ..surface import Surface
from .differences import axis_index
from .heights import mean_height, rms_height


@dataclass(frozen=True)
class ProfilePeaks:
    """Three-point peaks of all profiles along ``axis``; NaN where there is none.

    ``density`` peaks per length and ``zero_crossings`` crossings of the mean plane per length (1/m); ``mean_height``,
    ``height_deviation`` above the mean plane (m); ``mean_curvature``, ``curvature_deviation`` (1/m);
    ``rho_1``, ``rho_2`` correlation of the heights of neighbouring points and of next neighbours, from which the
    theory of Whitehouse & Archard predicts all of these for Gaussian heights.
    """

    axis: str
    density: float
    mean_height: float
    height_deviation: float
    mean_curvature: float
    curvature_deviation: float
    zero_crossings: float
    rho_1: float
    rho_2: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Whitehouse1970",)


def profile_peaks(surface: Surface, *, axis: str = "x") -> ProfilePeaks:
    """Peaks of the profiles of ``surface``: points strictly above both neighbours along ``axis``, all three valid.

    A periodic surface wraps. Correlations are pair averages over the mean square of the valid heights.

    Raises
    ------
    InputError
        If the axis is neither x nor y.
    """
    number = axis_index(axis)
    d, variance = surface.grid.spacing[number], rms_height(surface) ** 2
    z = _lines(surface, number)
    left, middle, right = z[:-2], z[1:-1], z[2:]
    curvature = (middle - left) - (right - middle)
    triples = int(np.count_nonzero(~np.isnan(curvature)))
    peak = (middle > left) & (middle > right)
    heights, curvatures = middle[peak], curvature[peak] / d**2
    products = [_products(surface, z, lag) for lag in (1, 2)]
    crossings = np.mean(products[0] < 0.0) if products[0].size else math.nan
    return ProfilePeaks(
        axis,
        density=heights.size / (triples * d) if triples else math.nan,
        mean_height=_mean(heights),
        height_deviation=float(heights.std()) if heights.size else math.nan,
        mean_curvature=_mean(curvatures),
        curvature_deviation=float(curvatures.std()) if curvatures.size else math.nan,
        zero_crossings=float(crossings) / d,
        rho_1=_mean(products[0]) / variance if variance > 0.0 else math.nan,
        rho_2=_mean(products[1]) / variance if variance > 0.0 else math.nan,
    )


def _lines(surface: Surface, number: int) -> RealArray:
    """Heights about their mean with the profiles along the first axis, two points longer where they wrap."""
    z = surface.heights.astype(np.float64, copy=False) - mean_height(surface)
    z = z if number == 0 else z.T
    if not surface.periodic:
        return z
    longer: RealArray = z[np.arange(z.shape[0] + 2) % z.shape[0]]
    return longer


def _products(surface: Surface, z: RealArray, lag: int) -> RealArray:
    """Products of the heights of all valid pairs ``lag`` points apart."""
    starts = max(0, z.shape[0] - (2 if surface.periodic else lag))
    products = z[:starts] * z[lag : lag + starts]
    valid: RealArray = products[~np.isnan(products)]
    return valid


def _mean(values: RealArray) -> float:
    return float(values.mean()) if values.size else math.nan
