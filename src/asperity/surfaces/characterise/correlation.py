"""Autocorrelation, structure functions, fractal dimension and amplitude."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.spectral import RealTransform, fast_length, thread_count
from ..surface import Surface, of_lines
from .heights import mean_height, rms_height
from .slopes import axis_index, increments, mean_square, stencil_sums

# Autocovariance and correlation lengths.


LagRange: TypeAlias = tuple[int, int]
"""Largest lags along x and y in pixels."""

DROP_1E, DROP_TENTH, DROP_ISO = math.exp(-1.0), 0.1, 0.2
"""Values of R/R(0) that define a correlation length: 1/e (β_e), 0.1 (β*, Peng & Bhushan 2001), 0.2
(ISO 25178-2)."""


@dataclass(frozen=True, eq=False)
class Autocovariance:
    """R(r) = <h(x) h(x + r)> at the lags r = (k dx, l dy), 0 <= k <= K and -L <= l <= L; R(-r) =
    R(r).

    ``values`` (K + 1, 2 L + 1) in m², ``pairs`` number of pairs of points behind each of them, NaN
    where there is none; ``spacing`` (dx, dy) and ``size`` of the map in m.
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
        along_x, along_y = lag if lag[0] >= 0 else (-lag[0], -lag[1])
        return float(self.values[along_x, self.range[1] + along_y])

    def along(self, axis: str) -> tuple[RealArray, RealArray]:
        """Lags (m) from 0 along +``axis`` and R (m²) there.

        Raises InputError if the axis is neither x nor y.
        """
        number = axis_index(axis)
        values = self.values[:, self.range[1]] if number == 0 else self.values[0, self.range[1] :]
        return np.arange(values.size) * self.spacing[number], values

    def correlation_length(self, drop: float, *, axis: str = "x", logarithmic: bool = False) -> float:
        """Lag in m at which R/R(0) first falls to ``drop`` along ``axis``; NaN if it does not, or
        if R(0) is zero.

        Between lags R is interpolated linearly, with ``logarithmic`` its logarithm: exact for an
        exponential, where linear interpolation is up to 6 % too long at a decay length of one
        pixel. Raises InputError if the axis is unknown or ``drop`` not between 0 and 1.
        """
        require.between(drop, 0.0, 1.0, "drop that defines a correlation length")
        lags, values = self.along(axis)
        level = drop * self.mean_square
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

    def within(self, largest: LagRange) -> Autocovariance:
        """The part with lags up to ``largest`` pixels."""
        most_x, most_y = (min(pair) for pair in zip(self.range, largest, strict=True))
        part = (slice(0, most_x + 1), slice(self.range[1] - most_y, self.range[1] + most_y + 1))
        return Autocovariance(self.values[part].copy(), self.pairs[part].copy(), self.spacing, self.size)


@of_lines
def autocovariance(surface: Surface) -> Autocovariance:
    """Autocovariance of ``surface`` about the mean of its valid points, at all lags.

    For a complete periodic surface it is circular, up to half the map. Otherwise it is the mean
    over the valid pairs, which is unbiased but has a large variance at lags beyond a quarter of the
    map. Missing points need no filling.
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
        lost = 0.0 if surface.periodic else 1.0  # pairs that a pixel of lag takes across the border
        along_x, along_y = (n - lost * np.arange(top + 1) for n, top in zip(surface.shape, largest, strict=True))
        pairs = along_x[:, None] * np.concatenate([along_y[:0:-1], along_y])
    with np.errstate(divide="ignore", invalid="ignore"):
        values = np.where(pairs > 0.0, sums / pairs, np.nan)
    return Autocovariance(values, pairs, surface.grid.spacing, surface.size)


def _pair_sums(field: RealArray, transform: RealTransform, largest: LagRange) -> RealArray:
    """Σ f(x) f(x + r) over all x for the lags up to ``largest``, of ``field`` (nx, ny) padded to
    the transform."""
    work = np.zeros(transform.shape)
    work[: field.shape[0], : field.shape[1]] = field
    spectrum = transform.forward(work)
    spectrum *= spectrum.conj()
    full = transform.backward(spectrum, out=work)
    positive_x, (_, most_y) = full[: largest[0] + 1], largest
    return np.concatenate([positive_x[:, full.shape[1] - most_y :], positive_x[:, : most_y + 1]], axis=1)


# Structure function and scale-dependent slopes and curvatures.


@dataclass(frozen=True, eq=False)
class StructureFunction:
    """S(τ) = <[h(x + τ) - h(x)]²> along ``axis``: ``lag`` τ in m, ``value`` S in m²."""

    axis: str
    lag: RealArray
    value: RealArray


@dataclass(frozen=True, eq=False)
class ScaleDependence:
    """Slope and curvature of profiles along ``axis`` over stencils of total length ℓ (Sanner et al.
    2022).

    ``slope_length`` (m) and ``slope`` = <[(h(x+ℓ) - h(x))/ℓ]²>^½; ``curvature_length`` (m),
    ``curvature`` (1/m) = <[(h(x+ℓ/2) - 2h(x) + h(x-ℓ/2))/(ℓ/2)²]²>^½ and ``sharpest`` (1/m), the
    smallest of these second derivatives, negative at peaks. At the shortest stencils they are the
    finite-difference slope and curvature of the map.
    """

    axis: str
    slope_length: RealArray
    slope: RealArray
    curvature_length: RealArray
    curvature: RealArray
    sharpest: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Sanner2022",)


@of_lines
def mean_square_increment(surface: Surface, lag: tuple[int, int]) -> float:
    """S in m² at the ``lag`` (k, l) in pixels, of either sign: mean over all valid pairs; a
    periodic surface wraps.

    Raises InputError if there is no valid pair.
    """
    return mean_square(increments(surface, lag), "structure function")


@of_lines
def structure_function(surface: Surface, *, axis: str = "x", lags: Sequence[int] | None = None) -> StructureFunction:
    """Structure function of the profiles along ``axis``, averaged over all lines; needs no mean and
    no filling.

    Raises InputError if a lag has no valid pair or is not a whole number >= 1.

    Parameters
    ----------
    surface
        Surface; a tilt adds (slope τ)², so level it first.
    axis
        ``x`` or ``y``.
    lags
        Whole numbers of pixels >= 1; by default geometrically spaced, five per factor of two, up to
        half the map.
    """
    number = axis_index(axis)
    steps = geometric_lags(surface.shape[number] // 2) if lags is None else tuple(lags)
    values = [stencil_sums(surface, axis, 1, step).square for step in steps]
    return StructureFunction(axis, np.array(steps) * surface.grid.spacing[number], np.array(values))


@of_lines
def scale_dependence(
    surface: Surface,
    *,
    axis: str = "x",
    steps: Sequence[int] | None = None,
    structure: StructureFunction | None = None,
) -> ScaleDependence:
    """Scale-dependent slope and curvature of ``surface`` along ``axis``.

    Raises InputError if the map is too small for a stencil or no stencil is valid.

    Parameters
    ----------
    surface
        Surface; missing points are left out, a periodic surface wraps.
    axis
        ``x`` or ``y``.
    steps
        Distances between neighbouring points of the stencils in pixels; by default geometric, five
        per factor of two, up to a quarter of the map.
    structure
        Structure function along the axis, from which the slopes follow, if already computed.
    """
    number = axis_index(axis)
    chosen = geometric_lags(surface.shape[number] // 4) if steps is None else tuple(steps)
    known = structure_function(surface, axis=axis, lags=chosen) if structure is None else structure
    spacing = surface.grid.spacing[number]
    sums = [stencil_sums(surface, axis, 2, step) for step in chosen]
    areas = (spacing * np.array(chosen)) ** 2
    return ScaleDependence(
        axis,
        slope_length=known.lag,
        slope=np.sqrt(known.value) / known.lag,
        curvature_length=2.0 * spacing * np.array(chosen),
        curvature=np.sqrt([found.square for found in sums]) / areas,
        sharpest=np.array([found.least for found in sums]) / areas,
    )


def tip_cutoff(dependence: ScaleDependence, tip_radius: float, *, factor: float = 0.5) -> float:
    """Stencil length in m below which a tip of ``tip_radius`` (m) may have distorted the map;
    discard shorter waves.

    There the smallest scale-dependent second derivative reaches -``factor``/``tip_radius``,
    interpolated between the stencils (Sanner et al. 2022, eq. 10, with the empirical factor 1/2). 0
    if the sharpest peak is blunter at every length, infinity if it is sharper at every length.
    Raises InputError if the radius or the factor is not positive, or there is no stencil.
    """
    require.positive(tip_radius, "radius of the tip (m)")
    require.positive(factor, "factor of the tip criterion")
    if dependence.sharpest.size == 0:
        raise InputError("scale dependence must hold at least one stencil for a tip cut-off, but is empty.")
    limit = -factor / tip_radius
    sharper = np.flatnonzero(dependence.sharpest < limit)
    if sharper.size == 0:
        return 0.0
    last = int(sharper[-1])
    if last + 1 == dependence.sharpest.size:
        return math.inf
    inner, outer = dependence.sharpest[last], dependence.sharpest[last + 1]
    share = (limit - inner) / (outer - inner)
    lengths = dependence.curvature_length
    return float(lengths[last] + share * (lengths[last + 1] - lengths[last]))


def geometric_lags(largest: int, per_octave: int = 5) -> tuple[int, ...]:
    """Integers from 1 to ``largest``, up to ``per_octave`` per factor of two, the same for every
    ``largest``."""
    count = 1 + math.ceil(per_octave * math.log2(max(1, largest)))
    spaced = np.unique(np.rint(2.0 ** (np.arange(count) / per_octave)).astype(int))
    return tuple(int(lag) for lag in spaced if lag <= max(1, largest))


# Fractal dimension and amplitude of the profiles of a surface, from their second differences.


GAMMA = 1.5
"""Ratio γ of neighbouring frequencies of the Weierstrass-Mandelbrot profile that defines G
(Majumdar & Bhushan 1990)."""

_FIRST_LAG = 2  # pixels; shorter lags are affected by the instrument and by interpolation
_OCTAVES = 4  # least ratio of the lags, two octaves, that shows a power beside a constant
_SHARE = 20  # of the map that the longest lag is; longer ones hold too few independent stretches
_FEWEST = 4  # lags of a fit of three numbers with a residual
_BLOCKS = 16  # parts of the map that the jackknife leaves out in turn
_WIDE = 64  # lines at least for parts of a quarter of them
_POWERS = np.arange(0.02, 1.3001, 0.005)  # Hurst exponents tried
_INSIDE = 1.96  # standard errors between D and the dimensions 1 and 2 of a fractal profile


@dataclass(frozen=True)
class FractalParameters:
    """Power law of the profiles along ``axis`` from their second differences: V(τ) = <[h(x+τ) -
    2h(x) + h(x-τ)]²> = a τ^(2H) + b (Istas & Lang 1997; Kent & Wood 1997).

    A tilt and waves much longer than τ do not enter, nor does the constant b, which is positive for
    noise and negative for a surface whose short waves are missing. ``dimension`` D = 2 - H of the
    profile (that of the surface is D + 1) and ``dimension_error``, its standard error from the
    scatter between 16 parts of the map (jackknife); ``amplitude`` C and ``resolution`` η (= pixel)
    in m of the structure function S(τ) = C η^(2D-3) τ^(4-2D) that belongs to it (Ganti & Bhushan
    1995), a = (4 - 4^H) S(τ)/τ^(2H); ``roughness`` G in m for γ = 1.5, NaN if not self-affine;
    ``constant`` b in m²; ``first_lag``, ``last_lag`` of the fit in m; ``residual`` rms of V
    relative to the fit.
    """

    axis: str
    dimension: float
    dimension_error: float
    amplitude: float
    resolution: float
    roughness: float
    constant: float
    first_lag: float
    last_lag: float
    residual: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Ganti1995", "Istas1997", "Kent1997", "Majumdar1990")

    @property
    def hurst(self) -> float:
        """Hurst exponent 2 - D of the fitted range."""
        return 2.0 - self.dimension

    @property
    def self_affine(self) -> bool:
        """Whether D lies between 1 and 2 by more than 1.96 standard errors, so that the profile is
        fractal in this range."""
        margin = _INSIDE * self.dimension_error
        return 1.0 + margin < self.dimension < 2.0 - margin


@of_lines
def fractal_parameters(
    surface: Surface,
    *,
    axis: str = "x",
    lags: Sequence[int] | None = None,
    structure: StructureFunction | None = None,
    lag_range: tuple[float, float] | None = None,
) -> FractalParameters:
    """Fit the second differences of ``surface`` along ``axis`` by a power law and a constant.

    Raises InputError if the lags are fewer than four or span less than two octaves, if the second
    differences are zero, or if they do not grow as a power of the lag.

    Parameters
    ----------
    surface
        Surface; missing points are left out.
    axis
        ``x`` or ``y``.
    lags
        Lags of the fit in pixels; by default geometrically spaced from 2 pixels to a twentieth of
        the map, or to half the lag where the structure function reaches the mean square height,
        half of its limit: about a tenth of the roll-off wavelength, if that is not known.
    structure
        Structure function along the axis, if already computed, which shows that lag.
    lag_range
        Shortest and longest default lag in m, if the ends of the power law are known: see
        ``SpectralFit.lag_range``.
    """
    number = axis_index(axis)
    spacing, points = surface.grid.spacing[number], surface.shape[number]
    chosen = _default_lags(surface, axis, structure, lag_range) if lags is None else tuple(lags)
    if len(chosen) < _FEWEST:
        raise InputError(
            f"lags of a fractal dimension must be at least {_FEWEST} along {axis}, but are {len(chosen)}. "
            "Name more, or use a finer map."
        )
    for lag in chosen:
        require.integer(lag, 1, "lag of a second difference (pixels)")
    if not surface.periodic and 2 * max(chosen) >= points:
        raise InputError(
            f"lags of a fractal dimension must be shorter than half of the {points} points along {axis}, "
            f"but one is {max(chosen)} pixels."
        )
    sums, counts = (np.array(part) for part in zip(*(_block_sums(surface, number, lag) for lag in chosen), strict=True))
    filled = (counts > 0.0).all(axis=0)
    if not filled.any() or not (sums.sum(axis=1) > 1e-20 * counts.sum(axis=1) * rms_height(surface) ** 2).all():
        raise InputError(
            f"second differences along {axis} must be positive at every lag for a fractal dimension, but are zero at "
            f"one of {chosen[0]} to {chosen[-1]} pixels. Use a surface that is rough and has fewer missing points."
        )
    values = _with_parts_left_out(sums[:, filled], counts[:, filled])
    unit = float(np.exp(np.mean(np.log(values[:, 0]))))
    x = np.array(chosen, dtype=float)
    powers = _fitted_powers(x, values / unit)
    hurst = float(powers[0])
    if not _POWERS[0] < hurst < _POWERS[-1]:
        raise InputError(
            f"second differences along {axis} must grow as a power of the lag between {2.0 * _POWERS[0]:.2g} and "
            f"{2.0 * _POWERS[-1]:.2g} for a fractal dimension, but the best power of {chosen[0]} to {chosen[-1]} "
            "pixels is not between them: the profile is smooth, or has no long waves."
        )
    # of the jackknife
    error = math.sqrt((powers.size - 2.0) * float(np.var(powers[1:]))) if powers.size > 2 else math.nan
    (slope, constant), misfit = _with_power(x, values[:, 0] / unit, hurst)
    dimension = 2.0 - hurst
    # S at one pixel over the pixel
    amplitude = unit * slope / (4.0 - 4.0**hurst) / spacing if hurst < 1.0 and slope > 0.0 else math.nan
    found = FractalParameters(
        axis,
        dimension=dimension,
        dimension_error=error,
        amplitude=amplitude,
        resolution=spacing,
        roughness=fractal_roughness(dimension, amplitude, spacing),
        constant=unit * constant,
        first_lag=chosen[0] * spacing,
        last_lag=chosen[-1] * spacing,
        residual=misfit,
    )
    return found if found.self_affine else replace(found, roughness=math.nan)


def _default_lags(
    surface: Surface, axis: str, structure: StructureFunction | None, lag_range: tuple[float, float] | None
) -> tuple[int, ...]:
    """Lags from two pixels to a twentieth of the map, within the ``lag_range`` in m and below the
    lag where S reaches Sq², half of it if the range is not known.

    Raises InputError if they span less than two octaves.
    """
    number = axis_index(axis)
    spacing, points = surface.grid.spacing[number], surface.shape[number]
    shortest, longest = (0.0, math.inf) if lag_range is None else (lag / spacing for lag in lag_range)
    first = max(_FIRST_LAG, math.ceil(shortest * (1.0 - 1e-9)))
    farthest, reason = points / _SHARE, f"a twentieth of the {points} points"
    if farthest >= _OCTAVES * first:
        if structure is None:
            structure = structure_function(surface, axis=axis, lags=geometric_lags(points // 10))
        reached = int(np.argmax(np.append(structure.value > rms_height(surface) ** 2, True)))
        half = math.inf
        if reached < structure.lag.size:
            near = slice(max(0, reached - 1), reached + 1)
            half = float(np.interp(rms_height(surface) ** 2, structure.value[near], structure.lag[near])) / spacing
        half *= 0.5 if lag_range is None else 1.0
        if min(half, longest) < farthest:
            farthest, reason = min(half, longest), "a share of the roll-off wavelength"
    if farthest < _OCTAVES * first:
        raise InputError(
            f"lags of a fractal dimension along {axis} must span two octaves, from {first} to {_OCTAVES * first} "
            f"pixels, but end at {farthest:.3g} pixels, {reason}. Use a finer or larger map, or take the Hurst "
            "exponent of the spectrum, which allows for the roll-off."
        )
    return tuple(lag for lag in geometric_lags(int(farthest)) if lag >= first)


def _block_sums(surface: Surface, number: int, lag: int) -> tuple[RealArray, RealArray]:
    """Sum of the squared second differences over ``lag`` pixels in each part of the map, and their
    number."""
    h = surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        values = np.roll(h, lag, number) + np.roll(h, -lag, number) - 2.0 * h
    else:
        n = h.shape[number]
        near, middle, far = (
            h[(slice(None),) * number + (slice(start, n - 2 * lag + start),)] for start in (0, lag, 2 * lag)
        )
        values = (far - middle) - (middle - near)
    across = 4 if values.shape[1 - number] >= _WIDE else 1
    along = min(_BLOCKS // across, values.shape[number])
    parts = (along, across) if number == 0 else (across, along)
    edges = [np.arange(count) * n // count for n, count in zip(values.shape, parts, strict=True)]

    def by_part(field: RealArray) -> RealArray:
        return np.add.reduceat(np.add.reduceat(field, edges[0], axis=0), edges[1], axis=1).ravel()

    valid = ~np.isnan(values) if surface.n_missing else np.ones(values.shape, dtype=bool)
    return by_part(np.where(valid, values, 0.0) ** 2), by_part(valid.astype(np.float64))


def _with_parts_left_out(sums: RealArray, counts: RealArray) -> RealArray:
    """Mean square of all parts, then without each of them, (lags, 1 + parts), of their ``sums`` and
    ``counts`` (lags, parts); the first alone of a single part."""
    whole, total = sums.sum(axis=1, keepdims=True), counts.sum(axis=1, keepdims=True)
    if sums.shape[1] == 1:
        return np.asarray(whole / total)
    return np.concatenate([whole / total, (whole - sums) / (total - counts)], axis=1)


def _with_power(x: RealArray, values: RealArray, power: float) -> tuple[tuple[float, float], float]:
    """a and b of a x^(2 ``power``) + b by relative least squares, and the rms misfit."""
    matrix = np.array([x ** (2.0 * power), np.ones(x.size)]).T / values[:, None]
    found = np.linalg.lstsq(matrix, np.ones(x.size), rcond=None)[0]
    misfit = matrix @ found - 1.0
    return (float(found[0]), float(found[1])), math.sqrt(float(misfit @ misfit) / x.size)


def _fitted_powers(x: RealArray, values: RealArray) -> RealArray:
    """Best H of a x^(2H) + b, a > 0, for each column of ``values`` (lags, columns) by relative
    least squares; at an end of the tried range where the best lies beyond."""
    t = (x / np.exp(np.mean(np.log(x)))) ** (2.0 * _POWERS[:, None])  # (powers, lags)
    inverse = 1.0 / values
    xx, xy, yy = t**2 @ inverse**2, t @ inverse**2, (inverse**2).sum(axis=0)
    bx, by = t @ inverse, inverse.sum(axis=0)
    determinant = xx * yy - xy**2
    slope, constant = (bx * yy - by * xy) / determinant, (by * xx - bx * xy) / determinant
    misfit = np.where(slope > 0.0, x.size - slope * bx - constant * by, np.inf)
    best = np.argmin(misfit, axis=0)
    inner, columns = np.clip(best, 1, _POWERS.size - 2), np.arange(values.shape[1])
    left, middle, right = (misfit[inner + step, columns] for step in (-1, 0, 1))
    with np.errstate(invalid="ignore", divide="ignore"):
        shift = 0.5 * (left - right) / (left - 2.0 * middle + right)
    shift = np.where((best == inner) & np.isfinite(shift), np.clip(shift, -0.5, 0.5), best - inner)
    return np.asarray(_POWERS[inner] + shift * (_POWERS[1] - _POWERS[0]))


def structure_coefficient(dimension: float) -> float:
    """B(D) = π (2π)^(4-2D)/[2 Γ(5-2D) sin π(2-D)], the factor of S = B G^(2(D-1)) τ^(4-2D)/ln γ.

    For a profile with the frequencies γ^n in cycles per length; papers that use radians omit
    (2π)^(4-2D). Raises InputError if not 1 < ``dimension`` < 2.
    """
    require.between(dimension, 1.0, 2.0, "fractal dimension of a profile")
    power = 4.0 - 2.0 * dimension
    return (
        math.pi
        * math.pow(2.0 * math.pi, power)
        / (2.0 * math.gamma(1.0 + power) * math.sin(math.pi * (2.0 - dimension)))
    )


def spectrum_coefficient(dimension: float) -> float:
    """c1/C = Γ(5-2D) sin[π(2-D)]/2π of the two-sided spectrum P = c1 η^(2D-3)/ω^(5-2D), ω in rad/m.

    Source: Ganti & Bhushan (1995); Bhushan (1998), eq. 33b, whose printed denominator is
    incomplete. Raises InputError if not 1 < ``dimension`` < 2.
    """
    require.between(dimension, 1.0, 2.0, "fractal dimension of a profile")
    return math.gamma(5.0 - 2.0 * dimension) * math.sin(math.pi * (2.0 - dimension)) / (2.0 * math.pi)


def fractal_roughness(dimension: float, amplitude: float, resolution: float, gamma: float = GAMMA) -> float:
    """G in m from C η^(2D-3) = B(D) G^(2(D-1))/ln γ; NaN unless 1 < D < 2."""
    if not 1.0 < dimension < 2.0:
        return math.nan
    # in logarithms, because G of a smooth surface underflows
    log_power = math.log(amplitude) + (2.0 * dimension - 3.0) * math.log(resolution)
    log_power += math.log(math.log(gamma) / structure_coefficient(dimension))
    return math.exp(log_power / (2.0 * (dimension - 1.0)))
