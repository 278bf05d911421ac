"""Error bars of a number of a contact from those of its parameters: by sensitivities, and by
sampling with these as control variate."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...contact.controls import MeanPressure
from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.active_set.solver import ActiveSet
from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.late import Shown
from ...core.spectral import RealTransform, multiplicity, thread_count
from ...core.units import percent, show
from .answer import Sensitivities
from .loads import solved_at
from .one_load import posed, stepped_problem
from .outputs import Output
from .parameters import HEIGHTS, LOAD, changed
from .ranged import Ranged
from .sensitivities import sensitivities
from .yielding import STRENGTH, FirstYield

NOISE = "noise"
"""Name of the noise of heights among the sources."""

QUANTILE = 1.959963984540054
"""Standard deviations within which 95 % of normal numbers lie."""

CLOSE = 1e-7
"""Tolerance of the solves of samples."""


@dataclass(frozen=True)
class HeightNoise:
    """Noise of a height map, stationary and independent of the surface.

    InputError if a value is negative.

    Parameters
    ----------
    rms
        Standard deviation in m.
    correlation_length
        ξ of the covariance rms² exp(-r²/ξ²) in m; zero for white noise.
    """

    rms: float
    correlation_length: float = 0.0

    def __post_init__(self) -> None:
        require.not_negative(self.rms, "rms of the noise of heights (m)")
        require.not_negative(self.correlation_length, "correlation length of the noise of heights (m)")

    def spectrum(self, grid: Grid) -> RealArray:
        """Transform of the covariance on the half spectrum of ``grid``, where the noise repeats."""
        shape = np.exp(-0.25 * (grid.wavenumber() * self.correlation_length) ** 2)
        whole = float((shape * multiplicity(grid)).sum()) / grid.n_points
        return np.asarray(self.rms**2 * shape / whole)

    def variance(self, slope: RealArray, grid: Grid) -> float:
        """Variance a · Σ a of a number whose derivative to each height is ``slope`` a."""
        spectrum = RealTransform(grid.shape, thread_count()).forward(slope)
        return float((np.abs(spectrum) ** 2 * self.spectrum(grid) * multiplicity(grid)).sum()) / grid.n_points

    def drawn(self, grid: Grid, generator: np.random.Generator) -> RealArray:
        """One map of it, (nx, ny) in m."""
        transform = RealTransform(grid.shape, thread_count())
        white = transform.forward(generator.standard_normal(grid.shape))
        return transform.backward(white * np.sqrt(self.spectrum(grid)))


@dataclass(frozen=True, eq=False)
class Sampled:
    """What solves with drawn parameters give.

    Attributes
    ----------
    values
        J of each sample, (n,).
    predicted
        J e^(c · z) by the sensitivities at the same parameters, (n,).
    mean
        Mean of J, with the prediction as control variate.
    mean_error
        Standard error of that.
    deviation
        Standard deviation of J.
    gain
        Variance of the plain mean over that of this one.
    """

    values: RealArray
    predicted: RealArray
    mean: float
    mean_error: float
    deviation: float
    gain: float


@dataclass(frozen=True, eq=False, repr=False)
class Uncertainty(Shown):
    """Error bar of a number J, from independent errors of its parameters.

    The parameters are lognormal with small or large deviations of their logarithms; so is J where
    it is a product of their powers, and to first order anywhere.

    Attributes
    ----------
    sensitivities
        Of J to the parameters.
    parts
        Standard deviation of ln J by each source alone: names of parameters, and ``"noise"``.
    sampled
        Of solves with drawn parameters; None without.
    """

    sensitivities: Sensitivities
    parts: Mapping[str, float]
    sampled: Sampled | None = field(default=None)

    @property
    def value(self) -> float:
        """J of the contact: the median."""
        return self.sensitivities.value

    @property
    def relative(self) -> float:
        """Standard deviation of ln J: the linear relative one of J."""
        return math.sqrt(sum(part * part for part in self.parts.values()))

    @property
    def mean(self) -> float:
        """Mean of the lognormal J, value e^(v/2)."""
        return self.value * math.exp(0.5 * self.relative**2)

    @property
    def deviation(self) -> float:
        """Standard deviation of the lognormal J."""
        return abs(self.mean) * math.sqrt(math.expm1(self.relative**2))

    def quantile(self, share: float) -> float:
        """J below which it lies with the probability ``share``, between 0 and 1."""
        from scipy.special import ndtri

        chance = require.between(share, 0.0, 1.0, "share of a quantile")
        return self.value * math.exp(float(ndtri(chance)) * self.relative)

    @property
    def interval(self) -> tuple[float, float]:
        """Bounds between which J lies in 95 of 100 cases."""
        ends = (self.value * math.exp(sign * QUANTILE * self.relative) for sign in (-1.0, 1.0))
        low, high = sorted(ends)
        return low, high

    @property
    def shares(self) -> Mapping[str, float]:
        """Share of the variance by each source, the largest first."""
        whole = self.relative**2 or 1.0
        found = {name: part * part / whole for name, part in self.parts.items()}
        return dict(sorted(found.items(), key=lambda item: -item[1]))

    @property
    def bias(self) -> float:
        """Mean of the samples over the value, less one: what the linear estimate does not see. NaN
        without samples."""
        return math.nan if self.sampled is None else self.sampled.mean / self.value - 1.0

    def line(self) -> str:
        """What it is in one line."""
        unit = self.sensitivities.output.unit
        first = ", ".join(f"{name} {percent(share, 2)}" for name, share in list(self.shares.items())[:3])
        amount = f"{show(self.value, unit, 4)} ± {percent(self.relative, 2)}"
        return f"Uncertainty {amount} of {self.sensitivities.output.name}: {first}"


def uncertainty(
    result: ContactResult,
    of: str | Output = "approach",
    scatter: Mapping[str, float] | None = None,
    *,
    noise: HeightNoise | None = None,
    samples: int = 0,
    seed: int = 0,
    engine: Engine | None = None,
) -> Uncertainty:
    """Error bar of a number of the contact ``result`` at held load.

    By the sensitivities, var ln J = Σ (n_k s_k)² + a · Σ_h a/J², n_k the relative sensitivities,
    s_k the standard deviations of the logarithms and a = dJ/dh. Samples of solved contacts show
    what is not linear, with the prediction as control variate.

    Parameters
    ----------
    result
        A contact, as for ``sensitivities``.
    of
        The number, as for ``sensitivities``.
    scatter
        Standard deviation of the logarithm, about the relative one, by the name of each parameter;
        that of ``"heights"`` is the calibration of the height scale. Of ``FirstYield(stress)`` also
        ``"strength"``.
    noise
        Of the heights.
    samples
        Contacts that are solved with drawn parameters, none or at least 4.
    seed
        Of these.
    engine
        Machine to compute on.

    Raises
    ------
    InputError
        If there is no scatter and no noise, a scatter is negative or of an unknown parameter, or as
        of ``sensitivities``.
    """
    given = dict(scatter or {})
    for name, deviation in given.items():
        require.not_negative(deviation, f"scatter of {name}")
    if not given and noise is None:
        raise InputError("scatter must name a parameter, or noise be given, for an uncertainty, but neither is.")
    names = (*given, *((HEIGHTS,) if noise is not None and HEIGHTS not in given else ()))
    found = sensitivities(result, of, names, held="load", engine=engine)
    if not found.value:
        raise InputError(f"number of an uncertainty must not be zero, but is: {found.output.name}.")
    parts = {name: abs(found.relative[name]) * deviation for name, deviation in given.items()}
    if noise is not None:
        slope = np.asarray(found[HEIGHTS])
        parts[NOISE] = math.sqrt(noise.variance(slope, result.problem.grid)) / abs(found.value)
    bare = Uncertainty(found, parts)
    count = require.integer(samples, 0, "number of samples of an uncertainty")
    if not count:
        return bare
    if count < _LEAST:
        raise InputError(f"number of samples of an uncertainty must be 0 or at least {_LEAST}, but is {count}.")
    drawn = _Draws(result, found, given, noise, engine)
    generator = np.random.default_rng(seed)
    pairs = np.array([drawn.one(generator) for _ in range(count)])
    return Uncertainty(found, parts, _sampled(pairs[:, 0], pairs[:, 1], bare.mean))


_LEAST = 4
"""Samples from which a slope and a variance can be found."""


def _sampled(values: RealArray, predicted: RealArray, exact: float) -> Sampled:
    """Mean of ``values`` with the ``predicted`` ones, whose mean is ``exact``, as control
    variate."""
    count, spread = values.size, float(predicted.var())
    slope = float(np.cov(values, predicted, ddof=0)[0, 1]) / spread if spread else 0.0
    rest = values - slope * predicted
    error, plain = float(rest.std(ddof=2)), float(values.std(ddof=1))
    mean = float(rest.mean()) + slope * exact
    gain = (plain / error) ** 2 if error else math.inf
    return Sampled(values, predicted, mean, error / math.sqrt(count), plain, gain)


@dataclass(frozen=True, eq=False)
class _Draws:
    """Solves with drawn parameters."""

    result: ContactResult
    found: Sensitivities
    scatter: Mapping[str, float]
    noise: HeightNoise | None
    engine: Engine | None

    def one(self, generator: np.random.Generator) -> tuple[float, float]:
        """J of one sample, and J as predicted."""
        problem, pressure, log, strength = self.result.problem, self.result.mean_pressure, 0.0, 1.0
        for name, deviation in self.scatter.items():
            z = deviation * float(generator.standard_normal())
            log += self.found.relative[name] * z
            if name == LOAD:
                pressure *= math.exp(z)
            elif name == STRENGTH:
                strength *= math.exp(z)
            else:
                of, step = self.found.output, math.expm1(z)
                stepped = of.stepped if isinstance(of, Ranged) else stepped_problem
                problem = stepped(problem, name, step)
        if self.noise is not None:
            added = self.noise.drawn(problem.grid, generator)
            log += float((np.asarray(self.found[HEIGHTS]) * added).sum()) / self.found.value
            problem = changed(problem, HEIGHTS, added)
        return self._value(problem, pressure, strength), self.found.value * math.exp(log)

    def _value(self, problem: ContactProblem, pressure: float, strength: float) -> float:
        """J of ``problem`` at a mean ``pressure``, with the ``strength`` over that of the layer."""
        output, method = self.found.output, ActiveSet(tolerance=CLOSE)
        if isinstance(output, FirstYield):
            force, own = pressure * problem.grid.area, strength * float(np.asarray(self.found.parameters[STRENGTH]))
            return output.factor(problem, force, own, self.found.value)
        if isinstance(output, Ranged):
            return output.of(
                solved_at(problem, pressure * output.factors(self.result), self.engine, CLOSE), self.engine
            )
        operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=self.engine)
        result = solve(problem, MeanPressure(pressure), solver=method, operator=operator)
        return output.at(posed(result, operator)).value
