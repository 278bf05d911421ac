"""Height parameters of ISO 25178-2 about the mean of the valid points, normalised by their number
N; material ratio."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface, maps_only, of_lines


@dataclass(frozen=True)
class HeightParameters:
    """Height parameters: ``Sa``, ``Sq``, ``Sp``, ``Sv``, ``Sz`` in m; ``Ssk``, ``Sku`` NaN if all
    heights are equal."""

    Sa: float
    Sq: float
    Sp: float
    Sv: float
    Sz: float
    Ssk: float
    Sku: float


@of_lines
def height_parameters(surface: Surface) -> HeightParameters:
    """All height parameters of ``surface`` in one pass over its valid points."""
    z = deviations(surface)
    squared = np.square(z)
    mean_square = float(squared.mean())
    highest, lowest = float(z.max()), float(z.min())
    flat = not mean_square**2 > 0.0  # also where the square of heights of 1e-82 m is no number any more
    return HeightParameters(
        Sa=float(np.abs(z).mean()),
        Sq=float(np.sqrt(mean_square)),
        Sp=highest,
        Sv=-lowest,
        Sz=highest - lowest,
        Ssk=float((squared * z).mean()) / mean_square**1.5 if not flat else math.nan,
        Sku=float(np.square(squared).mean()) / mean_square**2 if not flat else math.nan,
    )


@of_lines
def mean_height(surface: Surface) -> float:
    """Mean of the valid heights in m."""
    valid = surface.heights[~surface.mask].astype(np.float64, copy=False)
    return float(valid[0] + (valid - valid[0]).mean())  # avoids cancellation with a large common offset


@of_lines
def rms_height(surface: Surface) -> float:
    """Sq = sqrt(<z²>) in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.1)."""
    return float(np.sqrt(np.mean(np.square(deviations(surface)))))


@of_lines
def mean_absolute_height(surface: Surface) -> float:
    """Sa = <|z|> in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.7)."""
    return float(np.mean(np.abs(deviations(surface))))


@of_lines
def highest_peak(surface: Surface) -> float:
    """Sp = max z in m, z measured from the mean of the valid points (ISO 25178-2, 4.1.4)."""
    return float(deviations(surface).max())


@of_lines
def deepest_valley(surface: Surface) -> float:
    """Sv = -min z in m, positive, z measured from the mean of the valid points (ISO 25178-2,
    4.1.5)."""
    return float(-deviations(surface).min())


@of_lines
def peak_to_valley(surface: Surface) -> float:
    """Sz = Sp + Sv = max z - min z in m over the valid points (ISO 25178-2, 4.1.6)."""
    valid = surface.heights[~surface.mask].astype(np.float64, copy=False)
    return float(valid.max() - valid.min())


@of_lines
def skewness(surface: Surface) -> float:
    """Ssk = <z³>/Sq³, 0 for Gaussian heights (ISO 25178-2, 4.1.2).

    Raises InputError if all heights are equal.
    """
    return _defined(height_parameters(surface).Ssk, "skewness")


@of_lines
def kurtosis(surface: Surface) -> float:
    """Sku = <z⁴>/Sq⁴, 3 for Gaussian heights (not the excess), never below 1 + Ssk² (ISO 25178-2,
    4.1.3).

    Raises InputError if all heights are equal.
    """
    return _defined(height_parameters(surface).Sku, "kurtosis")


@of_lines
def deviations(surface: Surface) -> RealArray:
    """Heights (N,) of the valid points less their mean, in m."""
    valid = surface.heights[~surface.mask].astype(np.float64, copy=False)
    shifted = valid - valid[0]  # avoids cancellation with a large common offset
    return np.asarray(shifted - shifted.mean())


def _defined(value: float, what: str) -> float:
    if math.isnan(value):
        raise InputError(f"surface must have heights that differ for its {what} to be defined, but all are equal.")
    return value


# Height distribution.


@dataclass(frozen=True, eq=False)
class HeightDistribution:
    """Probability density of the heights about their mean: ``edges`` (n + 1,) in m, ``density``
    (n,) in 1/m.

    ``deviation`` is Sq in m.
    """

    edges: RealArray
    density: RealArray
    deviation: float

    def normal(self, height: RealArray) -> RealArray:
        """Density in 1/m of the normal distribution of the same deviation at ``height`` in m; zero
        for a flat map."""
        if self.deviation == 0.0:
            return np.zeros_like(height)
        return np.asarray(np.exp(-0.5 * (height / self.deviation) ** 2) / (np.sqrt(2.0 * np.pi) * self.deviation))


@of_lines
def height_distribution(surface: Surface, bins: int | None = None) -> HeightDistribution:
    """Histogram of the valid heights of ``surface`` in equal ``bins`` from the lowest to the
    highest.

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


@maps_only
def tilt_share(surface: Surface) -> float:
    """Share of the mean square height in the least-squares plane, 0 to 1; 0 for a flat map.

    It is exact for a complete map and an estimate with missing points, since the fits along x and y
    are then not independent.
    """
    z = np.where(surface.mask, 0.0, surface.heights - mean_height(surface))
    total = float(np.einsum("ij,ij", z, z))
    if total == 0.0:
        return 0.0
    count = surface.grid.n_points - surface.n_missing
    explained = 0.0  # squares that the lines along x and along y explain
    for axis in (0, 1):
        sums = z.sum(axis=1 - axis)
        x = np.arange(sums.size) - 0.5 * (sums.size - 1)
        spread = float(x @ x) * count / sums.size
        explained += float(x @ sums) ** 2 / spread if spread > 0.0 else 0.0
    return min(1.0, explained / total)


# The areal material ratio (Abbott-Firestone, bearing area) curve and its parameters (ISO 25178-2,
# 4.5).


CORE_LINES = ("least squares", "secant")
"""Definitions of the core line through the 40 % of the curve with the smallest slope."""

_AS_FLAT = 1.01  # fall of another window over that of the core, up to which the core is not determined
_CORE = 0.4  # share of the curve in the window of the core line, ISO 13565-2 and ISO 25178-2


@dataclass(frozen=True, eq=False)
class MaterialRatioCurve:
    """Height against the share of the area above it.

    ``heights`` (N,) of the valid points about their mean in m, highest first. The k-th of them
    (from 1) has the material ratio p = (k - 1/2)/N; the curve is linear in between and constant
    beyond the ends. Ratios are fractions, not per cent. The curve describes a geometric section,
    not a contact area.
    """

    heights: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Abbott1933", "ISO25178")

    @property
    def ratios(self) -> RealArray:
        """Material ratios of ``heights``, shape (N,)."""
        return (np.arange(self.heights.size) + 0.5) / self.heights.size

    def height(self, ratio: ArrayLike) -> RealArray:
        """Smc(p): height in m above the mean plane at the material ``ratio`` 0 <= p <= 1 (any
        shape)."""
        n = self.heights.size
        # position in steps of the samples, within the first and the last, and the sample before it
        place: RealArray = np.clip(np.asarray(ratio, dtype=float) * n - 0.5, 0.0, n - 1.0)
        below = np.floor(place).astype(np.intp)
        following = self.heights[np.minimum(below + 1, n - 1)]
        return self.heights[below] + (place - below) * (following - self.heights[below])

    def ratio(self, height: ArrayLike) -> RealArray:
        """Smr(c): share of the valid points with z >= c, for the ``height`` c in m above the mean
        plane (any shape)."""
        above = np.searchsorted(-self.heights, -np.asarray(height, dtype=float), side="right")
        return above / self.heights.size

    def height_difference(self, upper: float, lower: float) -> float:
        """Sdc(p, q) = Smc(p) - Smc(q) in m for two material ratios."""
        return float(self.height(upper) - self.height(lower))

    def material_volume(self, ratio: float) -> float:
        """Vm(p) = ∫₀^p [Smc(t) - Smc(p)] dt, volume of material above Smc(p) per area, in m."""
        return self._area_to(ratio) - ratio * float(self.height(ratio))

    def void_volume(self, ratio: float) -> float:
        """Vv(p) = ∫_p^1 [Smc(p) - Smc(t)] dt, volume of voids below Smc(p) per area, in m."""
        return (1.0 - ratio) * float(self.height(ratio)) - (self._area_to(1.0) - self._area_to(ratio))

    def crossing(self, height: float) -> float:
        """Material ratio at which the continuous curve passes ``height`` (m); 0 above and 1 below
        all points."""
        n, h = self.heights.size, self.heights
        if height >= h[0]:
            return 0.0
        if height <= h[-1]:
            return 1.0
        below = int(np.searchsorted(-h, -height, side="left"))  # first point at or below the height
        upper, lower = float(h[below - 1]), float(h[below])
        return (below - 0.5 + (upper - height) / (upper - lower)) / n

    @cached_property
    def _areas(self) -> RealArray:
        """∫ of the curve from 0 to each of the ratios, m."""
        n, h = self.heights.size, self.heights
        areas: RealArray = np.empty(n)
        areas[0] = 0.5 * h[0] / n
        np.cumsum(0.5 * (h[1:] + h[:-1]) / n, out=areas[1:])
        areas[1:] += areas[0]
        return areas

    def _area_to(self, ratio: float) -> float:
        n = self.heights.size
        if ratio <= 0.5 / n:
            return ratio * float(self.heights[0])
        if ratio >= 1.0 - 0.5 / n:
            return float(self._areas[-1] + (ratio - 1.0 + 0.5 / n) * self.heights[-1])
        below = int(np.floor(np.clip(ratio * n - 0.5, 0.0, n - 1.0)))
        step = ratio - (below + 0.5) / n
        return float(self._areas[below] + 0.5 * step * (self.heights[below] + float(self.height(ratio))))


@dataclass(frozen=True)
class FunctionalParameters:
    """Parameters of the material ratio curve (ISO 25178-2, 4.5): heights and volumes per area in m,
    ratios of one.

    ``Sk`` height of the core, ``Spk`` of the reduced peaks, ``Svk`` of the reduced valleys;
    ``Smr1``, ``Smr2`` ratios that bound the core; ``Vmp``, ``Vmc`` material volume of peaks (above
    10 %) and core (10 to 80 %); ``Vvc``, ``Vvv`` void volume of core and valleys (below 80 %);
    ``Sxp`` = Smc(2.5 %) - Smc(50 %); ``Sdc`` = Smc(10 %) - Smc(80 %).
    """

    Sk: float
    Spk: float
    Svk: float
    Smr1: float
    Smr2: float
    Vmp: float
    Vmc: float
    Vvc: float
    Vvv: float
    Sxp: float
    Sdc: float


@dataclass(frozen=True)
class Core:
    """Core of a material ratio curve: line from ``top`` at ratio 0 to ``bottom`` at ratio 1 (m),
    between two ratios.

    ``start`` is the ratio where the window of least slope begins; ``reduced_peak`` and
    ``reduced_valley`` are the heights (m) of the triangles that replace peaks and valleys.
    """

    top: float
    bottom: float
    ratio_1: float
    ratio_2: float
    start: float
    reduced_peak: float
    reduced_valley: float


@of_lines
def material_ratio_curve(surface: Surface) -> MaterialRatioCurve:
    """Curve of the valid heights of ``surface`` about their mean."""
    heights = np.sort(deviations(surface))[::-1]
    heights.flags.writeable = False
    return MaterialRatioCurve(heights)


def core(curve: MaterialRatioCurve, line: str = "least squares") -> Core:
    """Core of ``curve`` by its 40 % window of least slope (the first, if several) (ISO 25178-2,
    4.5.7 to 4.5.11).

    ``line`` is ``least squares`` (ISO: fitted to the curve in the window) or ``secant`` (through
    its ends, as in many programs; for Gaussian heights Sk is 2 % larger and Smr1 4 % smaller).
    Raises InputError if the line is unknown or all heights are equal.
    """
    require.one_of(line, CORE_LINES, "core line")
    if curve.heights[0] == curve.heights[-1]:
        raise InputError(
            "surface must have heights that differ for a core of its material ratio curve, but all are equal."
        )
    n = curve.heights.size
    whole, drops = _window_drops(curve)
    first = int(np.argmin(drops))  # the window begins at one of the samples
    start = (first + 0.5) / n
    if line == "secant":
        slope = -float(drops[first]) / _CORE
        top = float(curve.height(start)) - slope * start
    else:
        heights = curve.heights[first : first + whole + 1]
        if heights.size < 2:
            raise InputError(f"surface must have more points for a core of its material ratio curve than {n}.")
        ratios = (np.arange(heights.size) + first + 0.5) / n
        centred, mean = ratios - ratios.mean(), float(heights.mean())
        slope = float(centred @ (heights - mean) / (centred @ centred))
        top = mean - slope * float(ratios.mean())
    bottom = top + slope
    ratio_1, ratio_2 = curve.crossing(top), curve.crossing(bottom)
    peak = curve._area_to(ratio_1) - ratio_1 * top
    valley = (1.0 - ratio_2) * bottom - (curve._area_to(1.0) - curve._area_to(ratio_2))
    return Core(
        top=top,
        bottom=bottom,
        ratio_1=ratio_1,
        ratio_2=ratio_2,
        start=start,
        reduced_peak=2.0 * peak / ratio_1 if ratio_1 > 0.0 else 0.0,
        reduced_valley=2.0 * valley / (1.0 - ratio_2) if ratio_2 < 1.0 else 0.0,
    )


def _window_drops(curve: MaterialRatioCurve) -> tuple[int, RealArray]:
    """Whole steps of the window of the core, and the fall in m of ``curve`` over each such
    window."""
    n = curve.heights.size
    whole = int(np.floor(_CORE * n + 1e-9))
    share = max(0.0, _CORE * n - whole)
    highest = curve.heights[: max(1, n - whole - (share > 1e-9))]
    lowest = curve.heights[whole : whole + highest.size]
    following = np.append(curve.heights[1:], curve.heights[-1])[whole : whole + highest.size]
    return whole, highest - (lowest + share * (following - lowest))


def core_is_unique(curve: MaterialRatioCurve) -> bool:
    """Whether no window disjoint from that of the core is as flat to 1 %, as happens for sines and
    triangles."""
    whole, drops = _window_drops(curve)
    first = int(np.argmin(drops))
    apart = np.abs(np.arange(drops.size) - first) >= whole
    return not bool((drops[apart] <= _AS_FLAT * drops[first]).any())


def functional_parameters(curve: MaterialRatioCurve, line: str = "least squares") -> FunctionalParameters:
    """Parameters of ``curve``; ``line`` as for :func:`core`.

    Raises InputError if the line is unknown or all heights are equal.
    """
    found = core(curve, line)
    volume_10, volume_80 = curve.material_volume(0.1), curve.material_volume(0.8)
    void_10, void_80 = curve.void_volume(0.1), curve.void_volume(0.8)
    return FunctionalParameters(
        Sk=found.top - found.bottom,
        Spk=found.reduced_peak,
        Svk=found.reduced_valley,
        Smr1=found.ratio_1,
        Smr2=found.ratio_2,
        Vmp=volume_10,
        Vmc=volume_80 - volume_10,
        Vvc=void_10 - void_80,
        Vvv=void_80,
        Sxp=curve.height_difference(0.025, 0.5),
        Sdc=curve.height_difference(0.1, 0.8),
    )
