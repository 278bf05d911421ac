"""Autocovariance R(r) = <h(x) h(x + r)> of the heights about their mean, and the correlation lengths read from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.spectral import RealTransform, fast_length, thread_count
from ..surface import Surface
from .differences import axis_index
from .heights import mean_height

LagRange: TypeAlias = tuple[int, int]
"""Largest lags along x and y in pixels."""

DROP_1E, DROP_TENTH, DROP_ISO = math.exp(-1.0), 0.1, 0.2
"""Values of R/R(0) that define a correlation length: 1/e (β_e), 0.1 (β*, Peng & Bhushan 2001), 0.2 (ISO 25178-2)."""


@dataclass(frozen=True, eq=False)
class Autocovariance:
    """R at the lags (k dx, l dy), 0 <= k <= K and -L <= l <= L, of a map; R(-r) = R(r).

    ``values`` (K + 1, 2 L + 1) in m², ``pairs`` number of pairs of points behind each of them, NaN where there is none;
    ``spacing`` (dx, dy) and ``size`` of the map in m.
    """

    values: RealArray
    pairs: RealArray
    spacing: tuple[float, float]
    size: tuple[float, float]

    @property
    def range(self) -> LagRange:
        """Largest lags K and L in pixels."""
        return self.values.shape[0] - 1, self.values.shape[1] // 2

    @property
    def mean_square(self) -> float:
        """R(0) in m²."""
        return float(self.values[0, self.range[1]])

    def at(self, lag: tuple[int, int]) -> float:
        """R in m² at the ``lag`` (k, l) in pixels, of either sign."""
        k, moved = lag if lag[0] >= 0 else (-lag[0], -lag[1])
        return float(self.values[k, self.range[1] + moved])

    def along(self, axis: str) -> tuple[RealArray, RealArray]:
        """Lags (m) from 0 along +``axis`` and R (m²) there.

        Raises
        ------
        InputError
            If the axis is neither x nor y.
        """
        number = axis_index(axis)
        values = self.values[:, self.range[1]] if number == 0 else self.values[0, self.range[1] :]
        return np.arange(values.size) * self.spacing[number], values

    def correlation_length(self, drop: float, *, axis: str = "x", logarithmic: bool = False) -> float:
        """Lag in m at which R/R(0) first falls to ``drop`` along ``axis``; NaN if it does not, or if R(0) is zero.

        Between lags R is interpolated linearly, with ``logarithmic`` its logarithm: exact for an exponential, where
        linear interpolation is up to 6 % too long at a decay length of one pixel.

        Raises
        ------
        InputError
            If the axis is unknown or ``drop`` not between 0 and 1.
        """
        require.between(drop, 0.0, 1.0, "drop that defines a correlation length")
        lags, values = self.along(axis)
        return first_crossing(lags, values, drop * self.mean_square, logarithmic=logarithmic)

    def within(self, largest: LagRange) -> Autocovariance:
        """The part with lags up to ``largest`` pixels, for maps of the centre and for the texture."""
        k, moved = (min(have, wanted) for have, wanted in zip(self.range, largest, strict=True))
        part = (slice(0, k + 1), slice(self.range[1] - moved, self.range[1] + moved + 1))
        return Autocovariance(self.values[part].copy(), self.pairs[part].copy(), self.spacing, self.size)


def autocovariance(surface: Surface) -> Autocovariance:
    """Autocovariance of ``surface`` about the mean of its valid points, at all lags.

    A complete periodic surface: circular, up to half the map. Otherwise the sum over the valid pairs over their
    number, which is unbiased but scatters at lags beyond a quarter of the map. Missing points need no filling.
    """
    valid = ~surface.mask
    heights = np.where(surface.mask, 0.0, surface.heights - mean_height(surface)).astype(np.float64, copy=False)
    largest = tuple(n // 2 if surface.periodic else n - 1 for n in surface.shape)
    padded = tuple(n if surface.periodic else fast_length(2 * n - 1) for n in surface.shape)
    transform = RealTransform((padded[0], padded[1]), thread_count())
    sums = _pair_sums(heights, transform, (largest[0], largest[1]))
    if surface.n_missing:
        pairs = np.rint(_pair_sums(valid.astype(np.float64), transform, (largest[0], largest[1])))
    else:
        pairs = _complete_pairs(surface, (largest[0], largest[1]))
    with np.errstate(divide="ignore", invalid="ignore"):
        values = np.where(pairs > 0.0, sums / pairs, np.nan)
    return Autocovariance(values, pairs, surface.grid.spacing, surface.size)


def first_crossing(lags: RealArray, values: RealArray, level: float, *, logarithmic: bool = False) -> float:
    """First of the ``lags`` at which ``values`` fall to ``level``, interpolated; NaN if they do not."""
    below = np.flatnonzero(values <= level)
    if below.size == 0 or not level > 0.0:
        return math.nan
    after = int(below[0])
    if after == 0:
        return float(lags[0])
    high, low = float(values[after - 1]), float(values[after])
    if logarithmic and low > 0.0:
        share = math.log(high / level) / math.log(high / low)
    else:
        share = (high - level) / (high - low)
    return float(lags[after - 1] + share * (lags[after] - lags[after - 1]))


def _pair_sums(field: RealArray, transform: RealTransform, largest: LagRange) -> RealArray:
    """Σ f(x) f(x + r) over all x for the lags up to ``largest``, of ``field`` (nx, ny) padded to the transform."""
    work = np.zeros(transform.shape)
    work[: field.shape[0], : field.shape[1]] = field
    spectrum = transform.forward(work)
    spectrum *= spectrum.conj()
    full = transform.backward(spectrum, out=work)
    k, moved = largest
    sums: RealArray = np.concatenate([full[: k + 1, transform.shape[1] - moved :], full[: k + 1, : moved + 1]], axis=1)
    return sums


def _complete_pairs(surface: Surface, largest: LagRange) -> RealArray:
    if surface.periodic:
        return np.full((largest[0] + 1, 2 * largest[1] + 1), float(surface.grid.n_points))
    along_x = surface.shape[0] - np.arange(largest[0] + 1.0)
    along_y = surface.shape[1] - np.abs(np.arange(-largest[1], largest[1] + 1.0))
    pairs: RealArray = along_x[:, None] * along_y[None, :]
    return pairs
