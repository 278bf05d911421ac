"""Fit of a plateau and power laws to a measured spectrum by Whittle's likelihood.

The values of a periodogram are exponentially distributed about C(q), so -2 ln L = Σ N_b
[I_b/C(q_b) + ln C(q_b)] over rings of N_b modes with the mean I_b, each pair of opposite modes
counted once (Whittle 1953).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..generate.power_laws import PowerLaws
from .spectrum import LOST_MODES, PowerSpectrum, RadialSpectrum, default_edges, radial_spectrum

# The model: a plateau, one or two power laws and a floor.


@dataclass(frozen=True, kw_only=True)
class SpectralModel:
    """C(q) = C0 up to q_r, C0 (q/q_r)^-a1 up to q_c, from there on with the exponent a2, plus a
    floor.

    Zero beyond the longest and the shortest wave; a spectrum without plateau begins at its
    roll-off. Convention of Jacobs, Junge & Pastewka (2017). ``asperity.generate.gaussian`` accepts
    it as a spectrum. Raises InputError if a number is out of range or the wavelengths are out of
    order.

    Parameters
    ----------
    level
        C0 in m⁴, the value at the roll-off.
    rolloff_wavelength
        λ_r = 2π/q_r in m.
    exponents
        (a1,) or (a1, a2), any real numbers; a = 2 + 2H of a self-affine surface with the Hurst
        exponent H.
    crossover_wavelength
        λ_c = 2π/q_c <= λ_r in m where the exponent changes; needed with two exponents.
    floor
        Added constant C_n in m⁴: white noise of the mean square height C_n/(dx dy).
    shortest_wavelength
        Shortest wave in m; 0 for no limit but the grid.
    longest_wavelength
        Longest wave in m, at least λ_r; equal to it, there is no plateau.
    """

    level: float
    rolloff_wavelength: float
    exponents: tuple[float, ...]
    crossover_wavelength: float = math.nan
    floor: float = 0.0
    shortest_wavelength: float = 0.0
    longest_wavelength: float = math.inf
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    def __post_init__(self) -> None:
        require.positive(self.level, "level of a spectrum (m^4)")
        require.positive(self.rolloff_wavelength, "roll-off wavelength (m)")
        if len(self.exponents) not in (1, 2):
            raise InputError(f"exponents of a spectrum must be one or two, but are {self.exponents!r}.")
        for exponent in self.exponents:
            require.finite(exponent, "exponent of a spectrum")
        if len(self.exponents) == 2:
            require.at_most(self.crossover_wavelength, self.rolloff_wavelength, "crossover wavelength (m)")
        if not self.shortest_wavelength < self.rolloff_wavelength <= self.longest_wavelength:
            raise InputError(
                "wavelengths of a spectrum must satisfy shortest < roll-off <= longest, but are "
                f"{self.shortest_wavelength:g}, {self.rolloff_wavelength:g} and {self.longest_wavelength:g} m."
            )

    @property
    def has_plateau(self) -> bool:
        """Whether there are waves longer than the roll-off."""
        return self.rolloff_wavelength < self.longest_wavelength

    @property
    def hurst(self) -> tuple[float, ...]:
        """(a - 2)/2 for each exponent; a Hurst exponent only if it lies between 0 and 1."""
        return tuple(0.5 * (exponent - 2.0) for exponent in self.exponents)

    @cached_property
    def law(self) -> PowerLaws:
        """Shape of the spectrum without its floor."""
        bends = [self.rolloff_wavelength] + [self.crossover_wavelength] * (len(self.exponents) - 1)
        shortest = 2.0 * math.pi / self.shortest_wavelength if self.shortest_wavelength > 0.0 else math.inf
        longest = 2.0 * math.pi / self.longest_wavelength
        return PowerLaws(tuple(2.0 * math.pi / bend for bend in bends), self.exponents, longest, shortest)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: two roll-off
        wavelengths."""
        return 2.0 * self.rolloff_wavelength

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ at the wavenumbers ``q`` (rad/m, any shape), zero at q = 0."""
        number = np.asarray(q, dtype=float)
        relative = self.law.relative(number.ravel()).reshape(number.shape)
        return np.where(relative > 0.0, self.level * relative + self.floor, 0.0)

    def moments(self, shortest_wavelength: float = 0.0, longest_wavelength: float = math.inf) -> tuple[float, ...]:
        """Profile moments m0 (m²), m2, m4 (1/m²) of the continuous surface between two wavelengths
        (m), without floor.

        m0 = (1/2π) ∫ q C dq, m2 = (1/4π) ∫ q³ C dq, m4 = (3/16π) ∫ q⁵ C dq. Infinite where an
        integral diverges.
        """
        high = min(self.law.high, 2.0 * math.pi / shortest_wavelength if shortest_wavelength > 0.0 else math.inf)
        law = replace(self.law, low=max(self.law.low, 2.0 * math.pi / longest_wavelength), high=high)
        factors = ((1.0, 0.5), (3.0, 0.25), (5.0, 0.1875))  # power and factor of 1/π
        return tuple(self.level * factor / math.pi * law.integral(power) for power, factor in factors)

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid holds no mode of the spectrum.
        """
        values = self.psd(grid.wavenumber())
        if not values.any():
            raise InputError(
                f"grid of {grid.size[0]:g} x {grid.size[1]:g} m must hold waves of the spectrum, but has none. "
                "Change its size."
            )
        return values

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        laws = " and ".join(f"q^-{exponent:.4g}" for exponent in self.exponents)
        start = "plateau" if self.has_plateau else "no plateau"
        bend = f", crossover {self.crossover_wavelength:.4g} m" if len(self.exponents) == 2 else ""
        floor = f", floor {self.floor:.4g} m^4" if self.floor > 0.0 else ""
        return f"{start}, {self.level:.4g} m^4 at {self.rolloff_wavelength:.4g} m, {laws}{bend}{floor}"


# Maximum Whittle likelihood of one shape of spectrum: starting values, optimisation, standard
# errors.


_STARTS = 3  # best of the grid of starting values that are optimised
_BREAKS = 9  # starting values of a break along the range
_SCORING_STEPS = 20  # at most; three to five are usual
_STEEPEST = 12.0  # bound of an exponent
_NEAREST = 0.1  # least ln(q_c/q_r) of two power laws


@dataclass(frozen=True)
class Shape:
    """Form of a spectrum: with or without ``plateau`` and ``floor``, and the number ``slopes`` of
    power laws."""

    plateau: bool
    slopes: int
    floor: bool

    @property
    def parameters(self) -> int:
        """Number of free parameters."""
        return 1 + self.slopes + (self.slopes - 1) + int(self.plateau) + int(self.floor)

    @property
    def name(self) -> str:
        """Words for the shape."""
        laws = "power law" if self.slopes == 1 else "two power laws"
        return ("plateau + " if self.plateau else "") + laws + (" + floor" if self.floor else "")


@dataclass(frozen=True, eq=False)
class Solution:
    """Best parameters of a ``shape``: logarithms of level, breaks and floor and plain exponents,
    relative to ``unit``.

    ``values`` in the order ln C0, [ln q_r], [ln q_c/q_r or ln q_c], a1, [a2], [ln C_n]; ``unit`` (q
    in rad/m, C in m⁴) of the logarithms; ``deviance`` Σ N_b [I/C + ln C] with C in that unit.
    """

    shape: Shape
    values: RealArray
    unit: tuple[float, float]
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
        )

    def errors(self, rings: RadialSpectrum, lost: float) -> dict[str, float]:
        """Standard errors from the Fisher information of N_b/(2 ``lost``) independent modes a ring;
        NaN if singular."""
        _, gradient = _log_psd(self.shape, self.values, np.log(rings.q / self.unit[0]))
        information = (gradient * (0.5 * rings.modes / lost)) @ gradient.T
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


def fitted_shape(rings: RadialSpectrum, shape: Shape) -> Solution:
    """Parameters of ``shape`` with the maximum likelihood, from the best of several starts."""
    from scipy.optimize import minimize

    unit = (float(np.exp(np.mean(np.log(rings.q)))), float(np.exp(np.mean(np.log(rings.psd)))))
    log_q, measured = np.log(rings.q / unit[0]), rings.psd / unit[1]

    def deviance(values: RealArray) -> tuple[float, RealArray]:
        log_c, gradient = _log_psd(shape, values, log_q)
        ratio = measured * np.exp(-log_c)
        return float(rings.modes @ (ratio + log_c)) / scale, gradient @ (rings.modes * (1.0 - ratio)) / scale

    scale = float(rings.modes.sum())
    starts = sorted(_starts(shape, log_q, measured, rings.modes), key=lambda values: deviance(values)[0])[:_STARTS]
    low, high, log_i = float(log_q[0]), float(log_q[-1]), np.log(measured)
    wide = 5.0 + float(log_i.max() - log_i.min())
    bounds = [(float(log_i.min()) - wide, float(log_i.max()) + wide)]
    bounds += [(low, high)] if shape.plateau else []
    bounds += [(_NEAREST, high - low) if shape.plateau else (low, high)] if shape.slopes == 2 else []
    bounds += [(-_STEEPEST, _STEEPEST)] * shape.slopes
    bounds += [(float(log_i.min()) - 12.0, float(log_i.max()))] if shape.floor else []
    options: Any = {"maxfun": 2000, "ftol": 1e-13, "gtol": 1e-8}
    found = [minimize(deviance, start, jac=True, bounds=bounds, method="TNC", options=options) for start in starts]
    best = min(found, key=lambda item: float(item.fun))
    values, least = np.asarray(best.x), float(best.fun)
    lower, upper = np.array(bounds).T
    # Fisher scoring: the optimiser stops within about 1e-4 of the minimum, depending on rounding
    for _ in range(_SCORING_STEPS):
        gradient = _log_psd(shape, values, log_q)[1]
        information = (gradient * rings.modes) @ gradient.T / scale
        step = np.linalg.lstsq(information, deviance(values)[1], rcond=None)[0]
        trials = [np.clip(values - factor * step, lower, upper) for factor in (1.0, 0.5, 0.25)]
        reached = [deviance(trial)[0] for trial in trials]
        if min(reached) >= least:
            break
        values, least = trials[int(np.argmin(reached))], min(reached)
    return Solution(shape, values, unit, least * scale)


def _split(shape: Shape, values: RealArray) -> tuple[float, float, float, tuple[float, ...], float]:
    """ln C0, ln q_r, ln q_c, exponents and ln C_n; the level of a spectrum without plateau is
    stated at ln q = 0."""
    rest = [float(v) for v in values]
    log_level = rest.pop(0)
    log_r = rest.pop(0) if shape.plateau else 0.0
    log_c = log_r + rest.pop(0) if shape.slopes == 2 else math.nan
    exponents = tuple(rest.pop(0) for _ in range(shape.slopes))
    return log_level, log_r, log_c, exponents, rest.pop(0) if shape.floor else -math.inf


def _log_psd(shape: Shape, values: RealArray, log_q: RealArray) -> tuple[RealArray, RealArray]:
    """ln C at ``log_q`` and its derivatives by the parameters, shape (parameters, rings)."""
    level, log_r, bend, exponents, floor = _split(shape, values)
    rows: list[RealArray] = [np.ones(log_q.shape)]
    first = np.maximum(log_q - log_r, 0.0) if shape.plateau else log_q
    log_c = level - exponents[0] * first
    beyond = (log_q > log_r).astype(float)
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
    rows += slope_rows
    if shape.floor:
        total = np.logaddexp(log_c, floor)
        share = np.exp(log_c - total)
        return total, np.array([row * share for row in rows] + [1.0 - share])
    return log_c, np.array(rows)


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


_TOP = 0.95  # share of the Nyquist wavenumber up to which modes are fitted
_FIRST_WINDOWED = 2.5  # modes; the window mixes the first two with the mean
_PLATEAU_MODES = 10.0  # smallest number of modes below the roll-off that identifies a plateau
_FEWEST_RINGS = 8  # two more than the parameters of the largest shape

SHAPES = tuple(
    Shape(plateau, slopes, floor) for slopes in (1, 2) for plateau in (False, True) for floor in (False, True)
)
"""The shapes that are tried: one or two power laws, with or without a plateau, with or without a
floor."""


@dataclass(frozen=True, eq=False)
class SpectralFit:
    """Model of a spectrum with the standard errors of its parameters.

    ``model``; ``errors``: relative standard error of ``level``, ``rolloff_wavelength``,
    ``crossover_wavelength`` and ``floor``, absolute one of ``exponent_1``, ``exponent_2``, for the
    parameters that were fitted (Fisher information, modes lost to the window counted); ``first``,
    ``last`` wavenumber (rad/m) of the fitted range; ``short_cutoff`` wavelength (m) below which the
    spectrum vanishes, NaN if it extends to the end of the range; ``mean_square_ratio``,
    ``slope_ratio`` mean square height and slope of the model over those of the spectrum in the
    range; ``rings`` the spectrum that was fitted; ``candidates`` Bayesian information criterion,
    less the best, by shape.
    """

    model: SpectralModel
    errors: dict[str, float]
    first: float
    last: float
    short_cutoff: float
    mean_square_ratio: float
    slope_ratio: float
    rings: RadialSpectrum
    candidates: dict[str, float]
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017", "Whittle1953")

    @property
    def has_rolloff(self) -> bool:
        """Whether the spectrum has a plateau; otherwise the roll-off wavelength exceeds the scan
        size."""
        return self.model.has_plateau

    @property
    def hurst_error(self) -> float:
        """Standard error of the Hurst exponent of the first power law."""
        return 0.5 * self.errors["exponent_1"]


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
        white noise; by default selected by the criterion. A plateau of fewer than ten modes is
        accepted only if ``plateau`` is True.
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
    first = 0.0 if spectrum.window == "none" else _FIRST_WINDOWED * 2.0 * np.pi / min(spectrum.grid.size)
    last = _TOP * spectrum.nyquist
    if reliable_wavelength > 0.0:
        last = min(last, 2.0 * np.pi / reliable_wavelength)
    edges = default_edges(spectrum)
    edges = np.unique(np.clip(edges, max(first, edges[0]), max(last, edges[0])))
    rings = radial_spectrum(spectrum, edges)
    last_wave = short_cutoff(spectrum, rings)
    if not math.isnan(last_wave):
        edges = np.unique(np.minimum(edges, last_wave))
        rings = radial_spectrum(spectrum, edges)
    if rings.q.size < _FEWEST_RINGS or not np.all(rings.psd > 0.0):
        raise InputError(
            f"spectrum must hold power in at least {_FEWEST_RINGS} rings of modes for a fit, but has {rings.q.size}. "
            "Use a map of more points, or one that is not flat."
        )
    cutoff = 2.0 * math.pi / last_wave

    lost = LOST_MODES[spectrum.window] ** 2
    error = require.finite(model_error, "relative error of the model")
    # fewer modes, so that the relative variance of a ring's mean is 2 lost/N + error²
    weighed = replace(rings, modes=1.0 / (1.0 / rings.modes + error**2 / (2.0 * lost)))
    found = []
    for shape in SHAPES:
        features = zip((plateau, slopes, floor), (shape.plateau, shape.slopes, shape.floor), strict=True)
        if not all(wish in (None, has) for wish, has in features):
            continue
        solution = fitted_shape(weighed, shape)
        if plateau is None and shape.plateau:
            rolloff = 2.0 * math.pi / solution.model(math.inf).rolloff_wavelength
            if rings.modes[rings.q < rolloff].sum() < _PLATEAU_MODES:
                continue
        found.append(solution)
    information = math.log(0.5 * float(weighed.modes.sum()))  # logarithm of the number of independent modes
    criteria = {item.shape.name: item.deviance / lost + item.shape.parameters * information for item in found}
    best = min(found, key=lambda item: criteria[item.shape.name])
    model = replace(best.model(2.0 * math.pi / rings.low[0]), shortest_wavelength=0.0 if math.isnan(cutoff) else cutoff)
    # of mean square height and slope, in the range of the rings
    weights = [rings.modes * rings.q**power for power in (0, 2)]
    ratios = [float(weight @ model.psd(rings.q) / (weight @ rings.psd)) for weight in weights]
    return SpectralFit(
        model,
        best.errors(weighed, lost),
        first=float(rings.low[0]),
        last=float(rings.high[-1]),
        short_cutoff=cutoff,
        mean_square_ratio=ratios[0],
        slope_ratio=ratios[1],
        rings=rings,
        candidates={name: value - criteria[best.shape.name] for name, value in criteria.items()},
    )
