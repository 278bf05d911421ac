"""Contacts of rough surfaces predicted from a table of solved ones, without solving."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ...contact.controls import Force, MeanPressure, mean_pressure
from ...core import require
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.status import Advice
from ...core.words import in_words
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Body, weaker_strength
from ...surfaces.characterise.heights import height_parameters
from ...surfaces.generate.autocorrelation import ExponentialAutocorrelation
from ...surfaces.surface import Surface
from ...theories.rough.predictor import (
    CAPPED_GAP,
    CAPPED_RANGE,
    HEIGHTS,
    LEAST_GAP,
    LEAST_PIXELS,
    MOST_CAPPED,
    Expected,
    Groups,
    capped,
    of_shape,
    predictor,
)
from ...theories.rough.predictor_stress import UNKNOWN
from .one_layer import OneLayer, one_layer
from .prediction import MEANING, Prediction
from .waves import Rough, Waves
from .yielding import Numbers, Part, largest_stresses, parts_of, unknown_parts, yield_factor, yield_loads

LIKENESS = 1.25
"""Factor by which bandwidth and gradient may differ from those of an exponential autocorrelation of
the same rms height, 10 % length and pixel for a surface to count as such."""

UNLIKE = 0.12
"""Relative standard error of area and largest pressure of other surfaces: rms of self-affine ones
of Hurst exponents 0.3 to 0.8. Their gap is a quarter of the rms height off, and not predicted."""

MOST_SKEWNESS, MOST_EXCESS = 0.6, 0.7
"""Skewness, and kurtosis less 3, up to which maps are predicted, with errors that grow with both:
of generated surfaces with a skewness of 0.5 the area is a third off at small loads, with a kurtosis
of 3.5 a fifth."""

ROUNDS, SETTLED = 50, 1e-6
"""Rounds in which a pull is added to the load, and the relative change that ends
them."""


def predict(
    surface: Rough,
    body: Body,
    control: MeanPressure | Force,
    *,
    grid: Grid | None = None,
    counter_body: Body = Rigid(),
    pull: tuple[float, float] | None = None,
    hardness: float | None = None,
) -> Prediction:
    """Predict area, largest pressure, gap and yield of a rough surface that is pressed against a
    body, in milliseconds and without solving.

    The numbers are read from a table of contacts of Gaussian surfaces with exponential
    autocorrelation, by the mean pressure over the rms pressure s of full contact of the bodies as
    they are layered,

        s² = Σ |h(q)|²/c(q)²,

    and Nayak's bandwidth α. The contact is periodic, elastic or limited by a hardness, and without
    friction.

    Parameters
    ----------
    surface
        Map of heights (levelled, if measured), or a spectrum such as
        ``ExponentialAutocorrelation(rms_height, correlation_length)`` of surfaces on a ``grid``.
    body
        Half-space, or bonded layers on a half-space with Poisson's ratios from 0.2 to 0.4: one with
        0.25 <= E1/E2 <= 5.6, or several that are about as compliant as one.
    control
        ``MeanPressure`` in Pa or ``Force`` in N.
    grid
        Pixels and size of the surfaces of a spectrum.
    counter_body
        Rigid, or a half-space where ``body`` is one too.
    pull
        Tension in Pa between the surfaces wherever they do not touch and the gap is at most a
        reach in m, from a quarter to three rms heights; it is added to the load. Of the liquid
        film ``film`` it is (film.suction, film.thickness).
    hardness
        H in Pa, which no pressure exceeds, from 1.25 times the mean pressure on; by default none.
        Not with a pull.

    Raises
    ------
    InputError
        If the contact is outside what the table holds: solve it then.

    Examples
    --------
    >>> rough = asp.generate.ExponentialAutocorrelation(1e-9, 0.5e-6)
    >>> grid = asp.Grid((256, 256), (0.05e-6, 0.05e-6))
    >>> found = asp.predict(rough, asp.Elastic(100e9, 0.3), asp.MeanPressure(20e6), grid=grid)
    >>> 0.02 < found.area_fraction.value < 0.03
    True
    """
    require.instance(control, MeanPressure | Force, "load of a prediction", "Give {load}.")  # type: ignore[arg-type]
    waves, used = _waves(surface, grid, body, counter_body)
    pressure = mean_pressure(control, used)
    require.positive(pressure, "mean pressure of a prediction (Pa)")
    one = one_layer(body, counter_body, waves.length, used)
    base = _groups(pressure, waves, used, one)
    groups, pulled = _with_pull(base, pressure, pull, waves)
    _require_inside(groups)
    _require_gaussian(surface)
    alike = _exponential(waves, used)
    if pull is not None and not alike:
        raise InputError(
            "surface must have an exponential autocorrelation for a prediction with a pull, but has another. "
            f"Solve it: {in_words('{solve}')}."
        )
    read = _Read(surface, waves, alike, math.hypot(0.0 if alike else UNLIKE, one.error))
    area, pixels, peak, gap = read.elastic(groups)
    elastic = peak
    if hardness is not None:
        u = _hard(hardness, pressure, groups, pull)
        area, pixels, peak = capped(area, u, "area"), capped(pixels, u, "area_pixels"), peak.below(hardness)
        gap = gap if u <= CAPPED_GAP else UNKNOWN
    parts = parts_of(body, counter_body, one) if alike or math.isinf(one.thickness) else ()
    here, capped_there = (groups, elastic), peak != elastic
    largest = Numbers() if capped_there else largest_stresses(parts, here)
    loads, unsaid = read.yield_loads(groups, parts) if pull is None else (Numbers(), [])
    found = Prediction(
        area_fraction=area,
        area_fraction_pixels=pixels,
        peak_pressure=peak,
        mean_gap=gap.times(waves.rms),
        max_sqrtJ2=largest.first,
        max_sqrtJ2_layer=largest.layer,
        max_sqrtJ2_base=largest.base,
        yield_factor=UNKNOWN if capped_there else yield_factor(parts, here),
        yield_load=loads.first,
        yield_load_layer=loads.layer,
        yield_load_base=loads.base,
        pull_pressure=pulled,
        pressure=pressure,
        groups=groups,
        waves=waves,
    )
    said = _findings(found, surface, alike, (body, counter_body), hardness)
    return replace(found, findings=(*said, *unknown_parts(one, groups, alike), *unsaid))


def _groups(pressure: float, waves: Waves, grid: Grid, one: OneLayer) -> Groups:
    """Groups of a contact under a mean ``pressure`` in Pa."""
    return Groups(
        pressure / waves.full_contact,
        pressure * waves.length / (waves.modulus * waves.rms * waves.stiffening),
        waves.nayak,
        math.sqrt(grid.area) / waves.length,
        grid.n_points,
        one.ratio,
        one.thickness / waves.length,
        one.thickness / waves.summit_length,
    )


def _waves(surface: Rough, grid: Grid | None, body: Body, counter_body: Body) -> tuple[Waves, Grid]:
    """Sums over the waves of ``surface``, and its grid."""
    if isinstance(surface, Surface):
        if grid is not None:
            raise InputError("grid must be left out for a map of heights, which has its own, but is given.")
        return Waves.of_surface(surface, body, counter_body), surface.grid
    if not hasattr(surface, "lattice_psd"):
        raise InputError(
            "surface of a prediction must be a map of heights or a spectrum, such as "
            f"ExponentialAutocorrelation(1e-9, 0.5e-6), but is {type(surface).__name__}."
        )
    if grid is None:
        raise InputError("grid must be given for a spectrum, such as Grid((256, 256), (50e-9, 50e-9)), but is not.")
    return Waves.of_spectrum(grid, surface, body, counter_body), grid


def _require_inside(groups: Groups) -> None:
    """Refuse ``groups`` outside the table.

    Raises
    ------
    InputError
        With the group, its range and what to do.
    """
    solve = f"Solve it: {in_words('{solve}')}."
    for limits, value in predictor().outside(groups):
        ends = f"from {limits.low:.3g} to {limits.high:.3g}"
        if limits.low == 0.0:
            ends = f"at most {limits.high:.3g}"
        elif limits.high == math.inf:
            ends = f"at least {limits.low:.3g}"
        raise InputError(f"{MEANING[limits.name]} must be {ends} for a prediction, but is {value:.3g}. {solve}")
    pixels = _pixels(groups)
    if pixels < LEAST_PIXELS:
        raise InputError(
            f"pixels in contact must be at least {LEAST_PIXELS:g} for a prediction, but {pixels:.2g} are "
            f"expected. Raise the load or enlarge the surface, or solve several surfaces: {in_words('{solve}')}."
        )


def _pixels(groups: Groups) -> float:
    """Number of pixels in contact that is expected."""
    return predictor().area(groups, "area_pixels").value * groups.points


def _exponential(waves: Waves, grid: Grid) -> bool:
    """Whether the waves of a surface are about those of an exponential autocorrelation."""
    try:
        like = Waves.of_spectrum(grid, ExponentialAutocorrelation(waves.rms, waves.length), Elastic(1.0, 0.0))
    except InputError:  # a map too small for its 10 % length
        return False
    ratios = (waves.nayak / like.nayak, waves.gradient / like.gradient)
    return all(1.0 / LIKENESS <= ratio <= LIKENESS for ratio in ratios)


def _shape(surface: Surface) -> tuple[float, float]:
    """Skewness and kurtosis of the heights."""
    found = height_parameters(surface)
    return found.Ssk, found.Sku


def _require_gaussian(surface: Rough) -> None:
    """Refuse maps whose heights are far from Gaussian."""
    if not isinstance(surface, Surface):
        return
    skewness, kurtosis = _shape(surface)
    if abs(skewness) > MOST_SKEWNESS or abs(kurtosis - 3.0) > MOST_EXCESS:
        raise InputError(
            f"heights of a prediction must be about Gaussian, with a skewness within {MOST_SKEWNESS:g} of 0 and a "
            f"kurtosis within {MOST_EXCESS:g} of 3, but theirs are {skewness:.2g} and {kurtosis:.2g}. Solve it: "
            f"{in_words('{solve}')}."
        )


def _with_pull(
    groups: Groups, pressure: float, pull: tuple[float, float] | None, waves: Waves
) -> tuple[Groups, Expected]:
    """Groups with the ``pull`` in the load, and what it comes to in Pa of the nominal area."""
    if pull is None:
        return groups, UNKNOWN
    given = require.two(pull, "pull of a prediction (Pa, m)")
    tension, reach = (require.positive(value, "pull of a prediction (Pa, m)") for value in given)
    height = reach / waves.rms
    if not HEIGHTS[0] <= height <= HEIGHTS[-1]:
        raise InputError(
            f"reach of a pull must be from {HEIGHTS[0]} to {HEIGHTS[-1]} rms heights for a prediction, but "
            f"is {height:.3g}. Solve it: {in_words('{solve}')}."
        )
    found, fed = Expected(0.0, 0.0, 0.0), groups
    for _ in range(ROUNDS):
        more = 1.0 + found.value / pressure
        fed = replace(groups, y=groups.y * more, X=groups.X * more)
        _require_inside(fed)
        gap = predictor().gap(fed).value
        if gap < LEAST_GAP:
            raise InputError(
                f"mean gap must be at least {LEAST_GAP} rms heights for a prediction with a pull, but is {gap:.2g}. "
                f"Solve it: {in_words('{solve}')}."
            )
        before, found = found, predictor().share_below(fed, height).times(tension)
        if abs(found.value - before.value) <= SETTLED * (pressure + found.value):
            return fed, found
    raise InputError(
        f"pull of a prediction must be less than the surfaces resist, but {found.value:.3g} Pa do not settle. "
        f"Solve it: {in_words('{solve}')}."
    )


@dataclass(frozen=True)
class _Read:
    """Reads elastic contacts of one surface from the table: whether it is ``alike`` one with an
    exponential autocorrelation, and the relative standard error ``unlike`` of others and of several
    layers."""

    surface: Rough
    waves: Waves
    alike: bool
    unlike: float

    def elastic(self, groups: Groups) -> tuple[Expected, Expected, Expected, Expected]:
        """Area, counted area, largest pressure in Pa and gap over the rms height."""
        read, unlike = predictor(), self.unlike
        area = self._shaped(read.area(groups).times(1.0, unlike), groups, "area")
        pixels = read.area(groups, "area_pixels").times(1.0, unlike) if self.alike else UNKNOWN
        gap = read.gap(groups) if self.alike else UNKNOWN
        pixels, gap = self._shaped(pixels, groups, "area_pixels"), self._shaped(gap, groups, "gap")
        return area, pixels, self.peak(groups), gap

    def peak(self, groups: Groups) -> Expected:
        """Largest pressure in Pa."""
        found = self._shaped(predictor().peak(groups).times(1.0, self.unlike), groups, "peak")
        return found.times(self.waves.full_contact)

    def _shaped(self, found: Expected, groups: Groups, name: str) -> Expected:
        """``found`` with the error of heights that are not Gaussian."""
        if not isinstance(self.surface, Surface):
            return found
        skewness, kurtosis = self._shape
        return of_shape(found, groups.y, skewness, kurtosis - 3.0, name)

    @cached_property
    def _shape(self) -> tuple[float, float]:
        return _shape(self.surface) if isinstance(self.surface, Surface) else (0.0, 3.0)

    def yield_loads(self, groups: Groups, parts: Sequence[Part]) -> tuple[Numbers, list[Advice]]:
        """Factors on the load at which ``parts`` first yield, and what is to be said of them."""

        def under(factor: float) -> Groups:
            return replace(groups, y=groups.y * factor, X=groups.X * factor)

        if not any(math.isfinite(part.yield_stress) for part in parts):
            return Numbers(), []
        limits = next(one for one in predictor().ranges if one.name == "y")
        low, high = limits.low / groups.y, limits.high / groups.y
        while low < 1.0 and _pixels(under(low)) < LEAST_PIXELS:
            low *= 1.1
        return yield_loads(
            parts, lambda factor: (under(factor), self.peak(under(factor))), (min(low, 1.0), max(high, 1.0))
        )


def _hard(hardness: float, pressure: float, groups: Groups, pull: tuple[float, float] | None) -> float:
    """Mean real pressure of the elastic contact over the ``hardness``, inside of what was tried."""
    solve = f"Solve it: {in_words('{solve}')}."
    require.positive(hardness, "hardness of a prediction (Pa)")
    if pull is not None:
        raise InputError(f"pull of a prediction must be left out with a hardness, but both are given. {solve}")
    if pressure > MOST_CAPPED * hardness:
        raise InputError(
            f"hardness of a prediction must be at least {1.0 / MOST_CAPPED:g} times the mean pressure, but is "
            f"{hardness / pressure:.3g} times it. {solve}"
        )
    u = pressure / (hardness * predictor().area(groups, "area_pixels").value)
    if u > CAPPED_RANGE:
        raise InputError(
            f"mean real pressure of the elastic contact / hardness must be at most {CAPPED_RANGE:g} for a prediction, "
            f"but is {u:.3g}: there the area is the load over the hardness. {solve}"
        )
    return u


def _findings(
    found: Prediction, surface: Rough, alike: bool, bodies: tuple[Body, Body], given: float | None
) -> tuple[Advice, ...]:
    """What should be known of the prediction."""
    made, peak = [], found.peak_pressure
    if not alike:
        made.append(
            Advice(
                "warning",
                "prediction exponential",
                "The waves are not those of an exponential autocorrelation, of which the table is: area and largest "
                f"pressure have a standard error of {UNLIKE:.0%}, and counted pixels and gap are not predicted.",
                "Solve it: {solve}.",
                {"nayak": found.waves.nayak},
            )
        )
    hardness = weaker_strength(*bodies).get("hardness", math.inf)
    if given is None and peak.value > hardness:
        made.append(
            Advice(
                "warning",
                "prediction elastic",
                f"The largest pressure {peak.value:.3g} Pa exceeds the hardness {hardness:.3g} Pa: the real area is "
                "larger and the pressure lower than predicted.",
                "Predict or solve it with {hardness}.",
                {"peak_pressure": peak.value, "hardness": hardness},
            )
        )
    if found.groups.size > 40.0:
        made.append(
            Advice(
                "note",
                "prediction size",
                f"The side is {found.groups.size:.3g} times the 10 % length, of which the table has up to 40: the "
                "largest pressure is extrapolated with the logarithm of the area.",
                numbers={"size": found.groups.size},
            )
        )
    if isinstance(surface, Surface):
        skewness, kurtosis = _shape(surface)
        if abs(skewness) > 0.3 or abs(kurtosis - 3.0) > 0.5:
            made.append(
                Advice(
                    "note",
                    "prediction Gaussian",
                    f"The heights have a skewness of {skewness:.2g} and a kurtosis of {kurtosis:.2g}, and the table "
                    "is of Gaussian surfaces: errors are those of generated surfaces of such heights.",
                    numbers={"skewness": skewness, "kurtosis": kurtosis},
                )
            )
        if not surface.periodic:
            made.append(
                Advice(
                    "note",
                    "prediction window",
                    "The map is not periodic: its spectrum is that of a Hann window, which scatters by a tenth.",
                )
            )
    return tuple(made)
