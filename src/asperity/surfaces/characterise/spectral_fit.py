"""Fit of a plateau and power laws to a measured spectrum by the debiased Whittle likelihood.

The values of a periodogram are exponentially distributed about their expectation E, so -2 ln L =
Σ N_b [I_b/E_b + ln E_b] over rings of N_b modes with the mean I_b, each pair of opposite modes
counted once (Whittle 1953). E holds what window and sampling do to the spectrum (Sykulski et al.
2019).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from .expectation import RingExpectation, ring_expectation
from .spectral_model import SpectralModel
from .spectrum import LOST_MODES, PowerSpectrum, RadialSpectrum, default_edges, radial_spectrum

# Maximum Whittle likelihood of one shape of spectrum: starting values, optimisation, standard
# errors.


_STARTS = 4  # best of the grid of starting values that are optimised
_BREAKS = 9  # starting values of a break along the range
_ITERATIONS = 60  # of Fisher scoring at most; ten are usual
_SMALLEST_GAIN = 1e-12  # of the deviance per mode by an iteration that goes on
_STEEPEST = 12.0  # bound of an exponent
_NEAREST = 0.1  # least ln(q_c/q_r) of two power laws


@dataclass(frozen=True)
class Shape:
    """Form of a spectrum: with or without ``plateau`` and ``floor``, and the number ``slopes`` of
    power laws.

    ``rounded``: the plateau goes over into the power law as (1 + q²/q_r²)^(-a/2), without a corner;
    ``folded``: short waves that the points do not resolve appear as longer ones.
    """

    plateau: bool
    slopes: int
    floor: bool
    rounded: bool = False
    folded: bool = False

    @property
    def parameters(self) -> int:
        """Number of free parameters."""
        return 1 + self.slopes + (self.slopes - 1) + int(self.plateau) + int(self.floor)

    @property
    def name(self) -> str:
        """Words for the shape."""
        laws = "power law" if self.slopes == 1 else "two power laws"
        start = ("rounded plateau + " if self.rounded else "plateau + ") if self.plateau else ""
        return start + laws + (" + floor" if self.floor else "") + (", folded" if self.folded else "")


@dataclass(frozen=True, eq=False)
class Solution:
    """Best parameters of a ``shape``: logarithms of level, breaks and floor and plain exponents,
    relative to ``unit``.

    ``values`` in the order ln C0, [ln q_r], [ln q_c/q_r or ln q_c], a1, [a2], [ln C_n]; ``unit`` (q
    in rad/m, C in m⁴) of the logarithms; ``expected`` (rings,) mean of each ring in m⁴ and
    ``gradient`` (parameters, rings) of its logarithm; ``deviance`` Σ N_b [I/E + ln E] with E in
    that unit.
    """

    shape: Shape
    values: RealArray
    unit: tuple[float, float]
    expected: RealArray
    gradient: RealArray
    deviance: float

    def model(self, longest: float) -> SpectralModel:
        """The spectrum with these parameters; without a plateau it begins at the ``longest`` wave
        (m)."""
        log_level, log_r, log_c, exponents, log_floor = _split(self.shape, self.values)
        unit_q, unit_c = self.unit
        if not self.shape.plateau:  # the level is stated at q = unit
            log_r = math.log(2.0 * math.pi / (longest * unit_q))
            log_level -= exponents[0] * log_r
        rolloff = 2.0 * math.pi / (unit_q * math.exp(log_r))
        return SpectralModel(
            level=unit_c * math.exp(log_level),
            rolloff_wavelength=rolloff,
            exponents=exponents,
            crossover_wavelength=2.0 * math.pi / (unit_q * math.exp(log_c)),
            floor=unit_c * math.exp(log_floor),
            longest_wavelength=math.inf if self.shape.plateau else rolloff,
            rounded=self.shape.rounded,
        )

    @property
    def exponent(self) -> float:
        """Exponent of the first power law."""
        return _split(self.shape, self.values)[3][0]

    def errors(self, rings: RadialSpectrum, lost: float) -> dict[str, float]:
        """Standard errors from the Fisher information of N_b/(2 ``lost``) independent modes a ring;
        NaN if singular."""
        information = (self.gradient * (0.5 * rings.modes / lost)) @ self.gradient.T
        try:
            covariance = np.linalg.inv(information)
        except np.linalg.LinAlgError:
            covariance = np.full_like(information, np.nan)
        shape = self.shape
        names = ["level"] + ["rolloff_wavelength"] * shape.plateau + ["crossover_wavelength"] * (shape.slopes == 2)
        names += ["exponent_1", "exponent_2"][: shape.slopes] + ["floor"] * shape.floor
        if shape.plateau and shape.slopes == 2:  # ln q_c = ln q_r + the fitted distance
            into = np.eye(len(names))
            into[names.index("crossover_wavelength"), names.index("rolloff_wavelength")] = 1.0
            covariance = into @ covariance @ into.T
        with np.errstate(invalid="ignore"):
            return dict(zip(names, (float(e) for e in np.sqrt(np.diag(covariance))), strict=True))


def fitted_shape(rings: RadialSpectrum, shape: Shape, expectation: RingExpectation) -> Solution:
    """Parameters of ``shape`` with the maximum likelihood of the expected ``rings``, from the best
    of several starts, by Fisher scoring with Levenberg's damping."""
    unit = (float(np.exp(np.mean(np.log(rings.q)))), float(np.exp(np.mean(np.log(rings.psd)))))
    nodes, measured, modes = np.log(expectation.q / unit[0]), rings.psd / unit[1], rings.modes / rings.modes.sum()

    def seen(values: RealArray) -> tuple[RealArray, RealArray, float]:
        expected, gradient = expected_rings(shape, values, nodes, expectation.weights)
        return expected, gradient, float(modes @ (measured / expected + np.log(expected)))

    log_q = np.log(rings.q / unit[0])
    low, high, log_i = float(log_q[0]), float(log_q[-1]), np.log(measured)
    wide = 5.0 + float(log_i.max() - log_i.min())
    bounds = [(float(log_i.min()) - wide, float(log_i.max()) + wide)]
    bounds += [(low, high)] if shape.plateau else []
    bounds += [(_NEAREST, high - low) if shape.plateau else (low, high)] if shape.slopes == 2 else []
    bounds += [(-_STEEPEST, _STEEPEST)] * shape.slopes
    bounds += [(float(log_i.min()) - 12.0, float(log_i.max()))] if shape.floor else []
    lower, upper = np.array(bounds).T
    starts = [np.clip(start, lower, upper) for start in _starts(shape, log_q, measured, rings.modes)]
    starts = sorted(starts, key=lambda values: seen(values)[2])[:_STARTS]
    found = []
    for start in starts:
        values, damping = start, 1e-3
        expected, gradient, least = seen(values)
        for _ in range(_ITERATIONS):
            information = (gradient * modes) @ gradient.T
            downhill = gradient @ (modes * (measured / expected - 1.0))
            # a parameter at its bound that would leave the range stays
            free = ~((values <= lower) & (downhill < 0.0) | (values >= upper) & (downhill > 0.0))
            part = information[np.ix_(free, free)]
            before = least
            while damping < 1e8:
                step = np.zeros(values.size)
                step[free] = np.linalg.solve(part + damping * np.diag(np.diag(part) + 1e-12), downhill[free])
                trial = np.clip(values + step, lower, upper)
                trial_seen = seen(trial)
                if trial_seen[2] < least:
                    values, (expected, gradient, least) = trial, trial_seen
                    damping = max(0.1 * damping, 1e-12)
                    break
                damping *= 10.0
            if before - least < _SMALLEST_GAIN:
                break
        found.append((least, values, expected, gradient))
    least, values, expected, gradient = min(found, key=lambda item: item[0])
    return Solution(shape, values, unit, unit[1] * expected, gradient, least * float(rings.modes.sum()))


def _split(shape: Shape, values: RealArray) -> tuple[float, float, float, tuple[float, ...], float]:
    """ln C0, ln q_r, ln q_c, exponents and ln C_n; the level of a spectrum without plateau is
    stated at ln q = 0."""
    rest = [float(v) for v in values]
    log_level = rest.pop(0)
    log_r = rest.pop(0) if shape.plateau else 0.0
    log_c = log_r + rest.pop(0) if shape.slopes == 2 else math.nan
    exponents = tuple(rest.pop(0) for _ in range(shape.slopes))
    return log_level, log_r, log_c, exponents, rest.pop(0) if shape.floor else -math.inf


def expected_rings(
    shape: Shape, values: RealArray, log_q: RealArray, weights: RealArray
) -> tuple[RealArray, RealArray]:
    """Mean of each ring, ``weights`` (rings, nodes) times C at the ``log_q`` (nodes,) plus the
    floor, and the derivatives of its logarithm by the parameters, shape (parameters, rings)."""
    level, log_r, bend, exponents, floor = _split(shape, values)
    rows: list[RealArray] = [np.ones(log_q.shape)]
    first, beyond = log_q, np.ones(log_q.shape)
    if shape.rounded:
        twice = 2.0 * (log_q - log_r)
        first = 0.5 * np.logaddexp(0.0, twice)
        beyond = np.exp(twice - 2.0 * first)
    elif shape.plateau:
        first = np.maximum(log_q - log_r, 0.0)
        beyond = (log_q > log_r).astype(float)
    log_c = level - exponents[0] * first
    slope_rows = [-first]
    if shape.plateau:
        rows.append(exponents[0] * beyond)
    if shape.slopes == 2:
        step = exponents[1] - exponents[0]
        second = np.maximum(log_q - bend, 0.0)
        past = (second > 0.0).astype(float)
        log_c = log_c - step * second
        rows += [step * past]
        if shape.plateau:
            rows[1] = rows[1] + step * past
        slope_rows = [second - first, -second]
    psd = np.exp(log_c)
    expected, gradient = weights @ psd, (np.array(rows + slope_rows) * psd) @ weights.T
    if shape.floor:
        noise = math.exp(floor)
        expected = expected + noise
        gradient = np.vstack([gradient, np.full(expected.shape, noise)])
    return expected, gradient / expected


def _starts(shape: Shape, log_q: RealArray, measured: RealArray, modes: RealArray) -> list[RealArray]:
    """Weighted least squares of ln I for every combination of breaks on a grid along the range."""
    breaks = np.linspace(log_q[0], log_q[-1], _BREAKS + 2)[1:-1]
    log_i, weight = np.log(measured), np.sqrt(np.minimum(modes, 1e4))
    floors = [float(log_i.min()) - 0.7] if shape.floor else [-math.inf]
    if shape.plateau and shape.slopes == 2:
        pairs = [(a, b) for a, b in itertools.combinations(breaks, 2) if b - a >= _NEAREST]
    elif shape.plateau or shape.slopes == 2:
        pairs = [(b, b) for b in breaks]
    else:
        pairs = [(0.0, 0.0)]
    starts = []
    for (log_r, log_c), floor in itertools.product(pairs, floors):
        first = np.maximum(log_q - log_r, 0.0) if shape.plateau else log_q
        columns = [np.ones(log_q.shape), -first]
        if shape.slopes == 2:
            second = np.maximum(log_q - log_c, 0.0)
            columns = [np.ones(log_q.shape), second - first, -second]
        matrix = np.array(columns).T * weight[:, None]
        solved = np.linalg.lstsq(matrix, log_i * weight, rcond=None)[0]
        values = [solved[0]]
        values += [log_r] if shape.plateau else []
        values += [log_c - (log_r if shape.plateau else 0.0)] if shape.slopes == 2 else []
        values += list(np.clip(solved[1:], -_STEEPEST, _STEEPEST)) + ([floor] if shape.floor else [])
        starts.append(np.array(values))
    return starts


# Short cut-off of generated or filtered surfaces.


_RINGS = 8  # over which the spectrum is extrapolated
_DROP = 0.02  # share of the extrapolation below which all of the rest must lie


def short_cutoff(spectrum: PowerSpectrum, rings: RadialSpectrum) -> float:
    """Wavenumber in rad/m of the last mode before the spectrum drops to zero; NaN if it does not.

    The drop is where all further rings lie below 2 % of the power law through the eight rings
    before, which does not happen by the scatter of a periodogram. The wavenumber is that of the
    last single mode above this level.
    """
    with np.errstate(divide="ignore"):
        log_q, log_c = np.log(rings.q), np.log(rings.psd)
    for ring in range(_RINGS, rings.q.size - 1):
        before = slice(ring - _RINGS, ring)
        slope, level = np.polyfit(log_q[before] - log_q[ring], log_c[before], 1)
        after = slice(ring + 1, None)  # the cut-off may lie within the ring itself
        if np.all(log_c[after] < level + slope * (log_q[after] - log_q[ring]) + math.log(_DROP)):
            q = spectrum.grid.wavenumber()
            near = (q > rings.low[ring - 1]) & (q <= rings.high[ring])
            expected = np.exp(level - slope * log_q[ring] + slope * np.log(q[near]))
            above = q[near][spectrum.psd[near] > _DROP * expected]
            return float(above.max(initial=rings.high[ring - 1]))
    return math.nan


_TOP = 0.95  # share of the Nyquist wavenumber up to which modes are fitted, periodic maps
_TOP_WINDOWED = 0.7  # of measured ones, whose shortest waves bear the traces of the instrument
_FIRST_WINDOWED = 2.5  # modes; the window mixes the first two with the mean
_PLATEAU_MODES = 10.0  # smallest number of modes below the roll-off that identifies a plateau
_PLATEAU_ERROR = 0.5  # largest standard error of ln q_r of a plateau that is identified
_FEWEST_RINGS = 8  # two more than the parameters of the largest shape

SHAPES = tuple(
    Shape(plateau, slopes, floor, rounded, folded)
    for folded in (False, True)
    for slopes in (1, 2)
    for plateau, rounded in ((False, False), (True, False), (True, True))
    for floor in (False, True)
    if not (floor and folded) and not (rounded and slopes == 2)
)
"""The shapes that are tried: one or two power laws, with or without a plateau, with or without a
floor, of a surface with or without waves that the points do not resolve."""


@dataclass(frozen=True, eq=False)
class SpectralFit:
    """Model of a spectrum with the standard errors of its parameters.

    ``model``; ``errors``: relative standard error of ``level``, ``rolloff_wavelength``,
    ``crossover_wavelength`` and ``floor``, absolute one of ``exponent_1``, ``exponent_2``, for the
    parameters that were fitted (Fisher information, modes lost to the window counted; that of
    ``exponent_1`` also holds the differences to other shapes of one number of power laws, weighted
    by their probability exp(-BIC/2)); ``first``, ``last`` wavenumber (rad/m) of the fitted range;
    ``short_cutoff`` wavelength (m) below which the spectrum vanishes, NaN if it extends to the end
    of the range; ``mean_square_ratio``, ``slope_ratio`` mean square height and slope of the
    expected spectrum over those of the measured one in the range; ``rings`` the spectrum that was
    fitted and ``expected`` (m⁴) what the model lets expect of each; ``has_rolloff`` whether the
    model has a plateau that at least ten modes hold and whose wavelength is known to a factor of
    1.65; ``folded`` whether the surface has waves that the points do not resolve; ``candidates``
    Bayesian information criterion, less the best, by shape.
    """

    model: SpectralModel
    errors: dict[str, float]
    first: float
    last: float
    short_cutoff: float
    mean_square_ratio: float
    slope_ratio: float
    rings: RadialSpectrum
    expected: RealArray
    has_rolloff: bool
    folded: bool
    candidates: dict[str, float]
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017", "Sykulski2019", "Whittle1953")

    @property
    def hurst_error(self) -> float:
        """Standard error of the Hurst exponent of the first power law."""
        return 0.5 * self.errors["exponent_1"]

    @property
    def band(self) -> tuple[float, float]:
        """Longest and shortest wavelength in m of the first power law within the fitted range."""
        longest, shortest = 2.0 * math.pi / self.first, 2.0 * math.pi / self.last
        if self.model.has_plateau:
            longest = min(longest, self.model.rolloff_wavelength)
        if len(self.model.exponents) == 2:
            shortest = max(shortest, self.model.crossover_wavelength)
        return longest, shortest

    @property
    def lag_range(self) -> tuple[float, float]:
        """Lags in m between which second differences follow a power law and a constant: from the
        short cut-off to a tenth of the roll-off wavelength, a twentieth of a rounded one; from 0 or
        to infinity if there is none."""
        shortest = 0.0 if math.isnan(self.short_cutoff) else self.short_cutoff
        if not self.has_rolloff:
            return shortest, math.inf
        return shortest, (_ROUNDED_LAG if self.model.rounded else _CORNER_LAG) * self.model.rolloff_wavelength

    @property
    def hurst(self) -> float:
        """Hurst exponent of the first power law; NaN if that is not between 0 and 1 to two standard
        errors."""
        found = self.model.hurst[0]
        return found if 0.0 < found <= 1.0 + 2.0 * self.hurst_error else math.nan

    def agrees(self, hurst: float, error: float) -> bool:
        """Whether another estimate of the Hurst exponent differs by less than twice the standard
        error of the difference."""
        return abs(hurst - self.hurst) <= _APART * math.hypot(error, self.hurst_error)

    def structure_amplitude(self, resolution: float) -> float:
        """C in m of the structure function S(τ) = C η^(2D-3) τ^(4-2D), η = ``resolution`` (m), of
        profiles of the first power law without end; NaN unless 0 < H < 1.

        S = (1/π) ∫ q C(q) [1 - J0(qτ)] dq = (c/π) Γ(1-H)/(2H 4^H Γ(1+H)) τ^(2H) for C = c
        q^(-2-2H).
        """
        exponent, hurst = self.model.exponents[0], self.model.hurst[0]
        if not 0.0 < hurst < 1.0:
            return math.nan
        at_resolution = self.model.level * (2.0 * math.pi / self.model.rolloff_wavelength) ** exponent
        factor = math.gamma(1.0 - hurst) / (2.0 * math.pi * hurst * 4.0**hurst * math.gamma(1.0 + hurst))
        return float(at_resolution * factor * resolution ** (2.0 * hurst) / resolution)


def fit_spectrum(
    spectrum: PowerSpectrum,
    *,
    plateau: bool | None = None,
    slopes: int | None = None,
    floor: bool | None = None,
    reliable_wavelength: float = 0.0,
    model_error: float = 0.0,
) -> SpectralFit:
    """Fit ``spectrum`` by the shape selected by the Bayesian information criterion.

    Raises InputError if fewer than eight rings of modes hold power, or an argument is out of range.

    Parameters
    ----------
    spectrum
        Spectrum of a levelled surface.
    plateau, slopes, floor
        Whether the model has a plateau, how many power laws (1 or 2), whether it has a floor of
        white noise; by default selected by the criterion, as are the form of the roll-off, with a
        corner or rounded, and whether the surface has waves that the points do not resolve.
    reliable_wavelength
        Shortest wavelength in m that the instrument resolves (see ``tip_cutoff``); shorter ones are
        left out.
    model_error
        Relative error of the model, which no real surface follows exactly; 0.1 keeps the thousands
        of short waves of a measured map from dominating the fit, 0 is for surfaces generated with
        such a spectrum.
    """
    if slopes not in (None, 1, 2):
        raise InputError(f"number of power laws of a spectrum must be 1 or 2, but is {slopes!r}.")
    require.finite(reliable_wavelength, "shortest reliable wavelength (m)")
    rings, last_wave = _fitted_rings(spectrum, reliable_wavelength)
    cutoff = 2.0 * math.pi / last_wave
    lost = LOST_MODES[spectrum.window] ** 2
    error = require.finite(model_error, "relative error of the model")
    # fewer modes, so that the relative variance of a ring's mean is 2 lost/N + error²
    weighed = replace(rings, modes=1.0 / (1.0 / rings.modes + error**2 / (2.0 * lost)))
    expectations = [ring_expectation(spectrum.grid, rings, folded=folded) for folded in (False, True)]
    found = []
    for shape in SHAPES:
        features = zip((plateau, slopes, floor), (shape.plateau, shape.slopes, shape.floor), strict=True)
        if not all(wish in (None, has) for wish, has in features) or (shape.folded and not math.isnan(cutoff)):
            continue
        found.append(fitted_shape(weighed, shape, expectations[shape.folded]))
    information = math.log(0.5 * float(weighed.modes.sum()))  # logarithm of the number of independent modes
    # a measured map usually has waves shorter than two pixels, a periodic one has to show them
    folding = information if spectrum.window == "none" else 0.0
    criteria = [
        item.deviance / lost
        + (item.shape.parameters - item.shape.plateau) * information
        + _CORNER * item.shape.plateau
        + folding * item.shape.folded
        for item in found
    ]
    best = found[int(np.argmin(criteria))]
    longest = 2.0 * math.pi / rings.low[0]
    model = replace(best.model(longest), shortest_wavelength=0.0 if math.isnan(cutoff) else cutoff)
    errors = best.errors(weighed, lost)
    errors["exponent_1"] = _error_of_first_exponent(best, found, np.array(criteria), weighed, lost)
    enough = rings.modes[rings.q < 2.0 * math.pi / model.rolloff_wavelength].sum() >= _PLATEAU_MODES
    known = errors.get("rolloff_wavelength", math.inf) < _PLATEAU_ERROR
    # of mean square height and slope, in the range of the rings
    ratios = [
        float((rings.modes * rings.q**n) @ best.expected / ((rings.modes * rings.q**n) @ rings.psd)) for n in (0, 2)
    ]
    return SpectralFit(
        model,
        errors,
        first=float(rings.low[0]),
        last=float(rings.high[-1]),
        short_cutoff=cutoff,
        mean_square_ratio=ratios[0],
        slope_ratio=ratios[1],
        rings=rings,
        expected=best.expected,
        has_rolloff=bool(model.has_plateau and (plateau or (enough and known))),
        folded=best.shape.folded,
        candidates={
            item.shape.name: criterion - min(criteria) for item, criterion in zip(found, criteria, strict=True)
        },
    )


MEASURED_MODEL_ERROR = 0.1
"""Relative error of power laws fitted to measured maps, which are not periodic."""

_APART = 2.0  # standard errors between two estimates of one Hurst exponent
_CORNER_LAG, _ROUNDED_LAG = 0.1, 0.05  # longest lags of second differences in roll-off wavelengths
_CORNER = 2.0  # of the criterion for a roll-off, which every surface has at some wavelength (Akaike's)
_NEGLIGIBLE = 20.0  # difference of the criterion beyond which a shape has no weight


def _error_of_first_exponent(
    best: Solution, found: Sequence[Solution], criteria: RealArray, rings: RadialSpectrum, lost: float
) -> float:
    """Standard error of the first exponent of the ``best`` shape, over all shapes of so many power
    laws that the data do not tell apart."""
    squares, weights = 0.0, 0.0
    for item, criterion in zip(found, criteria - criteria.min(), strict=True):
        if item.shape.slopes == best.shape.slopes and criterion < _NEGLIGIBLE:
            error = item.errors(rings, lost)["exponent_1"]
            squares += math.exp(-0.5 * criterion) * (error**2 + (item.exponent - best.exponent) ** 2)
            weights += math.exp(-0.5 * criterion)
    return math.sqrt(float(squares) / weights)


def _fitted_rings(spectrum: PowerSpectrum, reliable_wavelength: float) -> tuple[RadialSpectrum, float]:
    """Rings of modes to fit, and the wavenumber (rad/m) of the last wave of a spectrum that ends,
    NaN if it does not.

    InputError if fewer than eight rings hold power.
    """
    first = 0.0 if spectrum.window == "none" else _FIRST_WINDOWED * 2.0 * np.pi / min(spectrum.grid.size)
    last = _TOP * spectrum.nyquist
    if reliable_wavelength > 0.0:
        last = min(last, 2.0 * np.pi / reliable_wavelength)
    edges = default_edges(spectrum)
    edges = np.unique(np.clip(edges, max(first, edges[0]), max(last, edges[0])))
    rings = radial_spectrum(spectrum, edges)
    last_wave = short_cutoff(spectrum, rings)
    end = last_wave
    if spectrum.window != "none":
        end = float(np.fmin(end, _TOP_WINDOWED * spectrum.nyquist))
    if not math.isnan(end) and end < edges[-1]:
        edges = np.unique(np.minimum(edges, max(end, edges[0])))
        rings = radial_spectrum(spectrum, edges)
    if rings.q.size < _FEWEST_RINGS or not np.all(rings.psd > 0.0):
        raise InputError(
            f"spectrum must hold power in at least {_FEWEST_RINGS} rings of modes for a fit, but has {rings.q.size}. "
            "Use a map of more points, or one that is not flat."
        )
    return rings, last_wave
