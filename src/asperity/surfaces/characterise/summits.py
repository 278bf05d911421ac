"""Summits of a surface: the points above all their neighbours, with their heights and
curvatures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface, maps_only, of_lines
from .heights import mean_height, rms_height
from .slopes import axis_index

Indices: TypeAlias = NDArray[np.intp]
"""Positions of points along one axis."""

_SIDES = ((1, 0), (0, 1))
_DIAGONALS = ((1, 1), (1, -1))  # each direction and its opposite


@dataclass(frozen=True, eq=False)
class Summits:
    """The summits of a surface.

    Parameters
    ----------
    i, j
        Positions (n,) along x and y.
    height
        (n,) heights above the mean of the valid points in m.
    kappa_x, kappa_y, kappa_xy
        (n,) curvatures -∂²h/∂x², -∂²h/∂y², -∂²h/∂x∂y by central differences in 1/m, the first two
        positive; ``kappa_xy`` is NaN where a diagonal neighbour is missing (4 neighbours only).
    candidates
        Number of points that have all their neighbours.
    candidate_area
        Area of these points in m².
    neighbours
        4 or 8, the number of neighbours that a summit exceeds.
    """

    i: Indices
    j: Indices
    height: RealArray
    kappa_x: RealArray
    kappa_y: RealArray
    kappa_xy: RealArray
    candidates: int
    candidate_area: float
    neighbours: int
    citation_keys: ClassVar[tuple[str, ...]] = ("Nayak1971", "McCool1986")

    @property
    def count(self) -> int:
        """Number of summits."""
        return int(self.height.size)

    @property
    def density(self) -> float:
        """Summits per area of the candidates in 1/m²; NaN without candidates."""
        return self.count / self.candidate_area if self.candidate_area > 0.0 else math.nan

    @property
    def curvature(self) -> RealArray:
        """Mean curvature κ = (κ_x + κ_y)/2 of each summit in 1/m, half the negative Laplacian."""
        return 0.5 * (self.kappa_x + self.kappa_y)

    @property
    def principal_curvatures(self) -> tuple[RealArray, RealArray]:
        """Largest and smallest curvature of each summit in 1/m; the smallest may be negative."""
        half = np.hypot(0.5 * (self.kappa_x - self.kappa_y), self.kappa_xy)
        return self.curvature + half, self.curvature - half

    @property
    def geometric_curvature(self) -> RealArray:
        """sqrt(κ1 κ2) of each summit in 1/m, NaN where the smallest curvature is not positive."""
        largest, smallest = self.principal_curvatures
        product = np.where(smallest > 0.0, largest * smallest, np.nan)
        return np.sqrt(product)


@dataclass(frozen=True)
class SummitStatistics:
    """Averages over the summits, NaN where there is none.

    ``count``; ``density`` (1/m²); ``mean_height``, ``height_deviation`` (m, above the mean plane,
    normalised by the number of summits); ``mean_curvature`` <κ> (= Ssc), ``curvature_deviation``,
    ``mean_geometric_curvature`` (1/m); ``radius`` = 1/<κ> and ``mean_radius`` = <1/κ> (m), which is
    larger; ``saddles``, the number of summits whose smallest principal curvature is not positive;
    ``bandwidth`` = density × radius × deviation of heights (η R σ_s).
    """

    count: int = 0
    density: float = math.nan
    mean_height: float = math.nan
    height_deviation: float = math.nan
    mean_curvature: float = math.nan
    curvature_deviation: float = math.nan
    mean_geometric_curvature: float = math.nan
    radius: float = math.nan
    mean_radius: float = math.nan
    saddles: int = 0
    bandwidth: float = math.nan


@maps_only
def summits(surface: Surface, neighbours: int = 8) -> Summits:
    """Points strictly above all their ``neighbours``, all present and valid; equal heights are
    never summits.

    Borders are excluded unless the surface is periodic. With 8 neighbours the density of a well
    resolved isotropic surface is 1.01 times the true one, with 4 it is 1.31 times: use 8, and 4 for
    comparison with the literature only. On a surface rough down to the pixel densities and
    curvatures depend on the sampling interval. Raises InputError if ``neighbours`` is neither 4
    nor 8.
    """
    if neighbours not in (4, 8):
        raise InputError(f"neighbours of a summit must be 4 or 8, but are {neighbours!r}.")
    heights = surface.heights.astype(np.float64, copy=False)
    h = np.pad(heights, 1, mode="wrap") if surface.periodic else heights
    middle = h[1:-1, 1:-1]
    highest, candidate = ~np.isnan(middle), ~np.isnan(middle)
    complete = bool(candidate.all()) and not np.isnan(h).any()
    for step_x, step_y in _SIDES + (_DIAGONALS if neighbours == 8 else ()):
        for sign in (1, -1):
            neighbour = h[1 + sign * step_x :, 1 + sign * step_y :][: middle.shape[0], : middle.shape[1]]
            highest &= middle > neighbour
            if not complete:
                candidate &= ~np.isnan(neighbour)
    i, j = (places + 1 for places in np.nonzero(highest & candidate))
    dx, dy = surface.grid.spacing
    number = int(np.count_nonzero(candidate))
    border = 1 if surface.periodic else 0
    return Summits(
        i - border,
        j - border,
        h[i, j] - mean_height(surface),
        kappa_x=-(h[i + 1, j] - 2.0 * h[i, j] + h[i - 1, j]) / dx**2,
        kappa_y=-(h[i, j + 1] - 2.0 * h[i, j] + h[i, j - 1]) / dy**2,
        kappa_xy=-(h[i + 1, j + 1] - h[i + 1, j - 1] - h[i - 1, j + 1] + h[i - 1, j - 1]) / (4.0 * dx * dy),
        candidates=number,
        candidate_area=number * surface.grid.pixel_area,
        neighbours=neighbours,
    )


def summit_statistics(found: Summits) -> SummitStatistics:
    """Averages of the summits ``found``."""
    if found.count == 0:
        return SummitStatistics(density=found.density)
    curvature, geometric = found.curvature, found.geometric_curvature
    mean_curvature, height_deviation = float(curvature.mean()), float(found.height.std())
    valid = geometric[~np.isnan(geometric)]
    return SummitStatistics(
        count=found.count,
        density=found.density,
        mean_height=float(found.height.mean()),
        height_deviation=height_deviation,
        mean_curvature=mean_curvature,
        curvature_deviation=float(curvature.std()),
        mean_geometric_curvature=float(valid.mean()) if valid.size else math.nan,
        radius=1.0 / mean_curvature,
        mean_radius=float(np.mean(1.0 / curvature)),
        saddles=int(np.count_nonzero(found.principal_curvatures[1] <= 0.0)),
        bandwidth=found.density * height_deviation / mean_curvature,
    )


# Profile peaks (Whitehouse & Archard 1970).


@dataclass(frozen=True)
class ProfilePeaks:
    """Three-point peaks of all profiles along ``axis``; NaN where there is none.

    ``density`` peaks per length and ``zero_crossings`` crossings of the mean plane per length
    (1/m); ``mean_height``, ``height_deviation`` above the mean plane (m); ``mean_curvature``,
    ``curvature_deviation`` (1/m); ``rho_1``, ``rho_2`` correlation of the heights one and two
    points apart, from which the theory of Whitehouse & Archard predicts all the others for Gaussian
    heights.
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


@of_lines
def profile_peaks(surface: Surface, *, axis: str = "x") -> ProfilePeaks:
    """Peaks of the profiles of ``surface``: points strictly above both neighbours along ``axis``,
    all three valid.

    A periodic surface wraps. Correlations are pair averages over the mean square of the valid
    heights. Raises InputError if the axis is neither x nor y.
    """
    number = axis_index(axis)
    d, variance = surface.grid.spacing[number], rms_height(surface) ** 2
    z = surface.heights.astype(np.float64, copy=False) - mean_height(surface)
    z = z if number == 0 else z.T
    if surface.periodic:
        z = np.asarray(z[np.arange(z.shape[0] + 2) % z.shape[0]])
    left, middle, right = z[:-2], z[1:-1], z[2:]
    curvature = (middle - left) - (right - middle)
    triples = int(np.count_nonzero(~np.isnan(curvature)))
    peak = (middle > left) & (middle > right)
    heights, curvatures = middle[peak], curvature[peak] / d**2
    products = []  # of the heights of all valid pairs one and two points apart
    for lag in (1, 2):
        starts = max(0, z.shape[0] - (2 if surface.periodic else lag))
        pairs = z[:starts] * z[lag : lag + starts]
        products.append(pairs[~np.isnan(pairs)])
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


def _mean(values: RealArray) -> float:
    return float(values.mean()) if values.size else math.nan
