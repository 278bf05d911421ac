"""Surfaces with given heights: laws of skewness and kurtosis, Gaussian surfaces translated to them,
ranks put in order."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal, Protocol, TypeAlias, get_args

import numpy as np

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import Declared, checked
from ...core.pearson import Pearson, require_possible
from ...core.scipy_parts import optimize, special
from ...core.spectral import RealTransform, mode_sum, thread_count
from ...core.status import NoProgress, Progress
from ...core.values import Count, Fraction, Number, Positive, Real
from ..surface import Surface, generated
from .gaussian import CLIP_LIMIT, Spectrum, SurfaceSeed, filtered_noise, lattice_eigenvalues, negative_part
from .power_laws import mean_square

# Johnson's system of distributions: the one with given skewness and kurtosis, as a function of a
# normal number.
#
# G = γ + δ f((z - ξ)/λ) is standard normal; unbounded z = ξ + λ sinh((G - γ)/δ), bounded z = ξ +
# λ/(1 + exp(-(G - γ)/δ)), lognormal z = ξ + λ exp((G - γ)/δ) (Johnson 1949). Here z has zero mean
# and unit variance.


KINDS = ("normal", "lognormal", "unbounded", "bounded")
"""Families of the system."""

_ON_LINE = 1e-7  # distance of the kurtosis from the lognormal line, relative to it, below which the lognormal serves
_STEP, _REACH = 0.2, 9.6  # trapezoidal rule over G; the error of its step is exp(-2π² δ/step) for poles at iπδ
_WIDEST_DELTA = 1e3  # of a symmetric bounded distribution: kurtosis 3 - 2e-6
_SMALLEST_DELTA = 0.01  # beyond, the bounded family is two spikes that the rule above does not resolve
_SQRT_TWO_PI = math.sqrt(2.0 * math.pi)


@dataclass(frozen=True)
class Johnson:
    """Distribution of one ``kind`` of the system with its four parameters; made by
    :func:`johnson`."""

    kind: str
    gamma: float
    delta: float
    xi: float
    scale: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1949", "Tuenter2001")

    @property
    def label(self) -> str:
        """Name of the curve in words."""
        return self.kind if self.kind in ("normal", "lognormal") else f"Johnson's {self.kind}"

    def of_normal(self, normal: RealArray) -> RealArray:
        """z(G): the number of this distribution for each standard normal number; increasing."""
        if self.kind == "normal":
            return normal
        shape = {"unbounded": np.sinh, "bounded": special.expit, "lognormal": np.exp}[self.kind]
        return np.asarray(self.xi + self.scale * shape((normal - self.gamma) / self.delta))


def johnson(skewness: float, kurtosis: float) -> Johnson:
    """Distribution of zero mean, unit variance and the given ``skewness`` and ``kurtosis`` (3 for
    Gaussian heights).

    The lognormal curve in the plane of both divides the unbounded family (larger kurtosis; Tuenter
    2001) from the bounded one, whose moments come by quadrature. Raises InputError if kurtosis <
    1 + skewness², which no distribution has, or so close to it that only two heights remain.
    """
    require_possible(skewness, kurtosis)
    if abs(skewness) < _ON_LINE:
        skewness = 0.0
    if skewness < 0.0:
        # the distribution of -z as an increasing function of a normal number
        other = johnson(-skewness, kurtosis)
        if other.kind == "unbounded":
            return replace(other, gamma=-other.gamma, xi=-other.xi)
        if other.kind == "bounded":
            return replace(other, gamma=-other.gamma, xi=-(other.xi + other.scale))
        if other.kind == "lognormal":  # -z(-G) = -ξ - λ exp(-(G + γ)/δ)
            return replace(other, gamma=-other.gamma, delta=-other.delta, xi=-other.xi, scale=-other.scale)
        return other
    # w = exp(1/δ²) >= 1 of the lognormal, (w - 1)(w + 2)² = skewness²; the bracket from (w + 2)² >=
    # 9
    top = 1.0 + skewness**2 / 9.0 + 1e-15
    w = _root(lambda w: (w - 1.0) * (w + 2.0) ** 2 - skewness**2, 1.0, top, xtol=1e-15, rtol=1e-14)
    line = w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0
    if abs(kurtosis - line) <= _ON_LINE * line:
        if skewness == 0.0:
            return Johnson("normal", 0.0, 1.0, 0.0, 1.0)
        scale = 1.0 / math.sqrt(w * (w - 1.0))  # exp(G/δ) has the mean w^½ and the variance w (w - 1)
        return Johnson("lognormal", 0.0, 1.0 / math.sqrt(math.log(w)), -scale * math.sqrt(w), scale)
    return _unbounded(skewness, kurtosis) if kurtosis > line else _bounded(skewness, kurtosis, w)


def _root(function: Callable[[float], float], low: float, high: float, **accuracy: Any) -> float:
    """Where ``function`` is zero between ``low`` and ``high``."""
    return float(optimize.brentq(function, low, high, **accuracy))


def _unbounded(skewness: float, kurtosis: float) -> Johnson:
    """Tuenter (2001): skewness² as a function of w alone, at the given kurtosis, and its one
    root."""
    square = skewness**2

    def m(w: float) -> float:
        return -2.0 + math.sqrt(max(0.0, 4.0 + 2.0 * (w * w - (kurtosis + 3.0) / (w * w + 2.0 * w + 3.0))))

    # the lognormal with this kurtosis, m = 0
    low = _root(lambda w: w**4 + 2.0 * w**3 + 3.0 * w**2 - 3.0 - kurtosis, 1.0, kurtosis**0.25 + 1.0)
    high = math.sqrt(math.sqrt(2.0 * kurtosis - 2.0) - 1.0)  # the symmetric one, m = w - 1
    w, omega = high, 0.0
    if square > 0.0:
        w = _root(lambda w: (w - 1.0 - m(w)) * (w + 2.0 + 0.5 * m(w)) ** 2 - square, low, high, xtol=1e-15, rtol=1e-14)
        sinh_square = (w + 1.0) / (2.0 * w) * max(0.0, (w - 1.0) / m(w) - 1.0)
        omega = -math.asinh(math.sqrt(sinh_square))  # negative for positive skewness
    variance = 0.5 * (w - 1.0) * (w * math.cosh(2.0 * omega) + 1.0)
    scale, delta = 1.0 / math.sqrt(variance), 1.0 / math.sqrt(math.log(w))
    return Johnson("unbounded", omega * delta, delta, scale * math.sqrt(w) * math.sinh(omega), scale)


def _bounded(skewness: float, kurtosis: float, w: float) -> Johnson:
    """At each δ the skewness fixes γ; along this line the kurtosis rises from 1 + skewness² to the
    lognormal one.

    The line is followed to a per cent, Newton's method does the rest.
    """

    def gamma_at(delta: float) -> float:
        if skewness == 0.0:
            return 0.0
        top = 1.0
        while _bounded_moments(top, delta).skewness < skewness:
            top *= 2.0
        return float(
            optimize.brentq(lambda gamma: _bounded_moments(gamma, delta).skewness - skewness, 0.0, top, rtol=1e-4)
        )

    def missing(log_delta: float) -> float:
        delta = math.exp(log_delta)
        return _bounded_moments(gamma_at(delta), delta).kurtosis - kurtosis

    def both(unknown: RealArray) -> list[float]:
        found = _bounded_moments(float(unknown[0]), math.exp(float(unknown[1])))
        return [found.skewness - skewness, found.kurtosis - kurtosis]

    widest = 1.0 / math.sqrt(math.log(w)) if skewness > 0.0 else _WIDEST_DELTA  # the lognormal of this skewness
    low, high = math.log(_SMALLEST_DELTA), math.log(widest * (1.0 - 1e-6))
    if missing(low) > 0.0:
        raise InputError(
            f"kurtosis {kurtosis:.4g} of the heights at skewness {skewness:.4g} must be further above its limit "
            f"1 + skewness² = {1.0 + skewness**2:.4g}, at which there are only two heights."
        )
    start = float(optimize.brentq(missing, low, high, xtol=1e-3)) if missing(high) > 0.0 else high
    gamma, log_delta = (float(value) for value in optimize.root(both, [gamma_at(math.exp(start)), start], tol=1e-13).x)
    gamma = 0.0 if skewness == 0.0 else gamma
    if max(abs(error) for error in both(np.array([gamma, log_delta]))) > _ON_LINE:
        raise ArithmeticError(f"no bounded distribution found for skewness {skewness:g} and kurtosis {kurtosis:g}.")
    found = _bounded_moments(gamma, math.exp(log_delta))
    return Johnson("bounded", gamma, math.exp(log_delta), -found.mean / found.deviation, 1.0 / found.deviation)


@dataclass(frozen=True)
class _Moments:
    mean: float
    deviation: float
    skewness: float
    kurtosis: float


def _bounded_moments(gamma: float, delta: float) -> _Moments:
    """Moments of 1/(1 + exp(-(G - γ)/δ)) by the trapezoidal rule."""
    step = _STEP * min(1.0, delta)
    normal = np.arange(-_REACH, _REACH + 0.5 * step, step)
    weight = step / _SQRT_TWO_PI * np.exp(-0.5 * normal**2)
    u = (normal - gamma) / delta
    logarithm = u - np.logaddexp(0.0, u)
    largest = float(logarithm[-1])  # far from the bounds the values are tiny, and lognormal
    values = np.exp(logarithm - largest)
    mean = float(weight @ values)
    centred = values - mean
    square, third, fourth = (float(weight @ centred**power) for power in (2, 3, 4))
    deviation = math.sqrt(square)
    unit = math.exp(largest)
    return _Moments(mean * unit, deviation * unit, third / deviation**3, fourth / square**2)


# Distribution of heights with given skewness and kurtosis, of one of the systems that have one for
# every such pair.


System: TypeAlias = Literal["johnson", "pearson"]
"""System of distributions of heights."""

HeightSkewness: TypeAlias = Annotated[Real, "skewness of the heights; 0 for Gaussian ones"]
HeightKurtosis: TypeAlias = Annotated[Positive, "kurtosis of the heights; 3 for Gaussian ones"]
HeightSystem: TypeAlias = Annotated[System, "system of distributions of the heights; their tails differ"]


class HeightLaw(Protocol):
    """A distribution of zero mean and unit variance."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind it."""

    @property
    def label(self) -> str:
        """Name of the curve, for the history."""

    def of_normal(self, normal: RealArray) -> RealArray:
        """The number of this distribution for each standard normal number; increasing."""


def height_law(skewness: float, kurtosis: float, system: str = "johnson") -> HeightLaw:
    """Distribution of zero mean, unit variance and the given ``skewness`` and ``kurtosis``, of
    ``johnson`` or ``pearson``.

    Raises InputError if no distribution has these moments, only one of two heights, or the system
    is unknown.
    """
    if require.one_of(system, get_args(System), "system of distributions of the heights") == "pearson":
        return Pearson(skewness, kurtosis)
    return johnson(skewness, kurtosis)


# Distributions of heights that a surface can be made to have exactly: by moments, of a measured
# surface, of two levels.


class Marginal(Protocol):
    """Distribution of heights up to their mean and scale."""

    def sorted_heights(self, count: int) -> RealArray:
        """``count`` heights in ascending order, in any unit, that stand for the distribution."""

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""


@dataclass(frozen=True)
class HeightMoments(Declared):
    """Heights of given ``skewness`` and ``kurtosis`` (3 for Gaussian ones): the distribution of
    Johnson's or Pearson's system.

    Raises InputError if kurtosis < 1 + skewness², or the system is unknown.
    """

    skewness: HeightSkewness = 0.0
    kurtosis: HeightKurtosis = 3.0
    system: HeightSystem = "johnson"

    def __post_init__(self) -> None:
        super().__post_init__()
        height_law(self.skewness, self.kurtosis, self.system)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the system."""
        return height_law(self.skewness, self.kurtosis, self.system).citation_keys

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count; their moments are those asked for up to the tails beyond
        the outermost."""
        law = height_law(self.skewness, self.kurtosis, self.system)
        return law.of_normal(special.ndtri((np.arange(count) + 0.5) / count))

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        law = height_law(self.skewness, self.kurtosis, self.system)
        return f"skewness {self.skewness:.4g}, kurtosis {self.kurtosis:.4g} ({law.label})"


@dataclass(frozen=True, eq=False)
class HeightsOf(Declared):
    """Heights distributed as those of a measured ``surface``, levelled beforehand; missing points
    do not count."""

    surface: Annotated[Surface, "measured heights, levelled"]

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count, linear between the sorted heights at (k - 1/2)/N."""
        valid = self.surface.heights[~self.surface.mask].astype(np.float64)
        quantiles: RealArray = np.quantile(valid, (np.arange(count) + 0.5) / count, method="hazen")
        return np.sort(quantiles)

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        return f"heights of {self.surface.origin.source or 'a surface'}"

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the surface."""
        return self.surface.citation_keys


@dataclass(frozen=True)
class TwoLevels(Declared):
    """Two Gaussian distributions of heights, ``separation`` apart: the upper one on the ``share``
    of the area.

    ``separation`` of their means and ``upper_deviation`` in units of the standard deviation of the
    lower one. Equal distributions show two maxima if their means are more than two standard
    deviations apart.
    """

    share: Annotated[Fraction, "share of the area"]
    separation: Annotated[Positive, "distance of the two levels in standard deviations of the lower one"]
    upper_deviation: Annotated[Positive, "standard deviation of the upper level in those of the lower one"] = 1.0

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count, by inversion of the distribution function on a fine
        table."""
        low = min(-9.0, self.separation - 9.0 * self.upper_deviation)
        high = max(9.0, self.separation + 9.0 * self.upper_deviation)
        z = np.linspace(low, high, max(200_001, 4 * count))
        upper = special.ndtr((z - self.separation) / self.upper_deviation)
        below = (1.0 - self.share) * special.ndtr(z) + self.share * upper
        return np.interp((np.arange(count) + 0.5) / count, below, z)

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        distance = f"{self.separation:.4g} apart, the upper {self.upper_deviation:.4g} as wide"
        return f"two levels {distance} on {self.share:.4g} of the area"


@dataclass(frozen=True)
class Weibull(Declared):
    """Heights of Weibull's distribution, p = k x^(k-1) exp(-x^k).

    ``shape`` k: 1 exponential, 2 Rayleigh's, 3.6 nearly symmetric. ``upward`` false turns it over:
    scattered valleys below a plateau, as of worn surfaces.
    """

    shape: Annotated[float, Number(above=0.1, most=100.0), "shape k"]
    upward: Annotated[bool, "whether the long tail is above the mean"] = True
    citation_keys: ClassVar[tuple[str, ...]] = ("Weibull1951",)

    def sorted_heights(self, count: int) -> RealArray:
        """Quantiles at (k - 1/2)/count."""
        share = (np.arange(count) + 0.5) / count
        heights: RealArray = (-np.log1p(-share)) ** (1.0 / self.shape)
        return heights if self.upward else -heights[::-1]

    def describe(self) -> str:
        """Words and numbers for the history of a surface."""
        return f"Weibull's heights of shape {self.shape:.4g}{'' if self.upward else ', turned over'}"


# Surfaces whose heights are a function of a Gaussian field: any marginal distribution, at any
# resolution.


_TERMS, _REST = 400, 1e-13  # most Hermite coefficients of a translation, and the variance they may miss
_HERMITE_STEP, _HERMITE_REACH = 0.005, 12.0  # trapezoidal rule for them
_TABLE = 20001  # correlations between -1 and 1 at which the map is tabulated; linear interpolation is good to 1e-8


@checked
def translated(
    grid: Grid,
    spectrum: Annotated[Spectrum, "spectrum"],
    *,
    seed: SurfaceSeed,
    skewness: HeightSkewness,
    kurtosis: HeightKurtosis,
    system: HeightSystem = "johnson",
    predistorted: Annotated[
        bool, "whether the spectrum is that of the heights, or of the Gaussian field they are made of"
    ] = True,
) -> Surface:
    """Periodic surface z = T(G) of given skewness and kurtosis, G a Gaussian field and T of a
    system of distributions.

    Every height has the distribution of T exactly, at any resolution; the moments of a realisation
    scatter about it. T changes the correlation of two heights by a few per cent; ``predistorted``
    gives G the autocovariance from which T makes that of ``spectrum``. The mean is not removed.
    Raises InputError if no distribution has these moments, or no Gaussian field has the
    autocovariance that the translation would need.

    Parameters
    ----------
    grid
        Nodes of the surface.
    spectrum
        Any spectrum or autocorrelation; its rms height is that of the surface.
    seed
        Whole number >= 0 (PCG64, in the order of the array).
    skewness, kurtosis
        Of the heights, kurtosis >= 1 + skewness².
    system
        ``johnson`` or ``pearson``: of the distribution of the heights.
    predistorted
        Whether ``spectrum`` is that of the heights; otherwise of G.
    """
    law = height_law(skewness, kurtosis, system)
    eigenvalues = lattice_eigenvalues(spectrum, grid)
    square = mean_square(grid, eigenvalues * grid.pixel_area)
    eigenvalues = eigenvalues / square
    clipped = 0.0
    if predistorted:  # eigenvalues of the Gaussian field
        transform = RealTransform(grid.shape, thread_count())
        wanted = transform.backward(eigenvalues.astype(complex))
        table = np.linspace(-1.0, 1.0, _TABLE)
        reachable = translated_correlation(law, table)
        lowest = float(wanted.min())
        if lowest < reachable[0]:
            raise InputError(
                f"autocorrelation of these heights must not fall below {reachable[0]:.4g}, the least that a "
                f"translation of this skewness and kurtosis reaches, but falls to {lowest:.4g}. Use "
                "rank_ordered()."
            )
        needed = np.interp(wanted, reachable, table)
        needed[0, 0] = 1.0
        values = transform.forward(needed).real
        clipped = negative_part(grid, values)
        if clipped > CLIP_LIMIT:
            raise InputError(
                "no Gaussian field has the autocorrelation that a translation to this skewness and kurtosis "
                f"needs: its spectrum would be negative by {clipped:.2g} of the whole. Use rank_ordered(), or "
                "predistorted=False.",
                subject="autocorrelation of the Gaussian field",
            )
        eigenvalues = np.maximum(values, 0.0)
    heights = math.sqrt(square) * law.of_normal(filtered_noise(grid, eigenvalues, seed))
    how = (
        f"autocorrelation predistorted, negative part {clipped:.1e} clipped"
        if predistorted
        else "of the Gaussian field"
    )
    what = f"skewness {skewness:.4g}, kurtosis {kurtosis:.4g} ({law.label}), {how}"
    text = f"translation, {spectrum.describe(grid)}, {what}, PCG64 seed {seed}"
    keys = (*citation_keys(spectrum), *law.citation_keys)
    return generated(grid, heights, "translation", text, citation_keys=keys)


def translated_correlation(law: HeightLaw, correlation: RealArray) -> RealArray:
    """Correlation of T(G1) and T(G2) for that of the normal numbers G1, G2: ρ_z = Σ c_k² ρ_G^k, k =
    1, 2, …

    c_k are the Hermite coefficients of T = Σ c_k He_k/sqrt(k!).
    """
    normal = np.arange(-_HERMITE_REACH, _HERMITE_REACH + 0.5 * _HERMITE_STEP, _HERMITE_STEP)
    weighted = law.of_normal(normal) * np.exp(-0.5 * normal**2) * (_HERMITE_STEP / math.sqrt(2.0 * math.pi))
    before, now = np.ones_like(normal), normal
    squares: list[float] = []
    for k in range(1, _TERMS + 1):
        squares.append(float(weighted @ now) ** 2)
        if sum(squares) > 1.0 - _REST:
            break
        before, now = now, (normal * now - math.sqrt(k) * before) / math.sqrt(k + 1.0)
    normalised = np.array(squares) / sum(squares)  # to the variance 1
    return np.asarray(np.polynomial.polynomial.polyval(correlation, np.concatenate([[0.0], normalised])))


# Surfaces with a prescribed spectrum and prescribed heights at once, by alternating between the
# two.


_KEYS = ("Schreiber1996", "PerezRafols2019")
_PATIENCE, _SETTLED = 10, 0.97  # the error of the amplitudes has settled when so many iterations leave so much of it
_ERROR_LIMIT = 0.05  # relative error of the amplitudes beyond which spectrum and heights do not go together


@checked
def rank_ordered(
    grid: Grid,
    spectrum: Annotated[Spectrum, "spectrum"],
    heights: Annotated[Marginal, "distribution of heights"],
    *,
    seed: SurfaceSeed,
    last: Annotated[Literal["heights", "spectrum"], "whether heights or spectrum are exact in the end"] = "heights",
    tolerance: Annotated[Positive, "relative error of the waves' amplitudes at which to stop"] = 1e-4,
    max_iterations: Annotated[Count, "iterations after which to stop"] = 1000,
    progress: Progress = NoProgress(),
) -> Surface:
    """Periodic surface with the amplitudes of ``spectrum`` and the distribution of ``heights``.

    From a random arrangement of the heights two steps alternate: the amplitudes of the waves are
    replaced by those of the spectrum, then the values by the wanted heights in the same order of
    rank (Schreiber & Schmitz 1996; Pérez-Ràfols & Almqvist 2019). It ends at the ``tolerance``, or
    when ten more iterations improve the amplitudes by less than 3 %: spectra that end at long waves
    leave errors of 1e-3 to 1e-2 with heavy tails of the heights. The history records the error.
    Spectrum and histogram do not scatter between realisations. Rounding differences between FFT
    libraries are amplified by the ranks: another library gives another realisation. ``heights`` are
    ``HeightMoments``, ``HeightsOf`` a measured surface, ``TwoLevels``, or any with
    ``sorted_heights`` and ``describe``; ``progress`` receives the relative error of the amplitudes.
    Raises InputError if the spectrum cannot carry these heights: a relative error of the amplitudes
    above 5 % is left.
    """
    psd = spectrum.lattice_psd(grid)
    square = mean_square(grid, psd)
    wanted = heights.sorted_heights(grid.n_points)
    wanted = wanted - wanted.mean()
    wanted *= np.sqrt(square / np.mean(np.square(wanted)))
    amplitude = np.sqrt(psd * (grid.n_points / grid.pixel_area))
    transform = RealTransform(grid.shape, thread_count())
    values = np.random.Generator(np.random.PCG64(seed)).permutation(wanted).reshape(grid.shape)
    errors: list[float] = []
    iterations, settled = max_iterations, False
    for iteration in range(1, max_iterations + 1):
        modes = transform.forward(values)
        errors.append(_amplitude_error(modes, amplitude, grid))
        stalled = len(errors) > _PATIENCE and errors[-1] > _SETTLED * errors[-1 - _PATIENCE]
        if stalled or errors[-1] <= tolerance:
            iterations, settled = iteration - 1, True
            break
        order = np.argsort(_with_amplitudes(modes, amplitude, transform), axis=None)
        values = np.empty(grid.shape)
        values.ravel()[order] = wanted
        progress.update(iteration, errors[-1], 0.0)
    error = _amplitude_error(transform.forward(values), amplitude, grid)
    if error > _ERROR_LIMIT:
        raise InputError(
            f"spectrum and distribution of the heights must go together, but after {iterations} iterations the "
            f"amplitudes are off by {error:.2g}: waves of so few lengths cannot add up to heights of "
            f"{heights.describe()}. Use a broader spectrum or other heights."
        )
    exact = f"amplitudes to {error:.1e}"
    if last == "spectrum":
        values = _with_amplitudes(transform.forward(values), amplitude, transform)
        apart = np.sort(values, axis=None) - wanted
        exact = f"heights to {np.sqrt(np.mean(np.square(apart)) / np.mean(np.square(wanted))):.1e}"
    state = f"{iterations} iterations, {'settled' if settled else 'not settled'}, {exact}"
    text = f"rank-ordered, {spectrum.describe(grid)}, {heights.describe()}, {state}, PCG64 seed {seed}"
    keys = (*citation_keys(spectrum), *citation_keys(heights), *_KEYS)
    return generated(grid, values, "rank-ordered", text, citation_keys=keys)


def _with_amplitudes(modes: ComplexArray, amplitude: RealArray, transform: RealTransform) -> RealArray:
    """Values of the ``modes``, which are overwritten, with their phases kept and their amplitudes
    replaced."""
    magnitude = np.abs(modes)
    modes *= np.divide(amplitude, magnitude, out=np.zeros_like(magnitude), where=magnitude > 0.0)
    return transform.backward(modes)


def _amplitude_error(modes: ComplexArray, amplitude: RealArray, grid: Grid) -> float:
    """sqrt(Σ (|F| - |F0|)² / Σ |F0|²) over all modes."""
    missing = mode_sum(grid, np.square(np.abs(modes) - amplitude))
    return float(np.sqrt(missing / mode_sum(grid, np.square(amplitude))))
