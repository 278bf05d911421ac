"""Contacts of rough surfaces predicted from a table of solved ones, without solving."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np

from ..contact.controls import Force, MeanPressure, mean_pressure
from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.quantity import Quantity
from ..core.spectral import RealTransform, mode_sum, thread_count
from ..core.status import Advice
from ..core.words import in_words
from ..solids.compliance.halfspace import contact_compliance
from ..solids.elastic import Elastic, Rigid
from ..solids.layers import Body, Layered, contact_modulus, weaker_strength
from ..surfaces.characterise.correlation import DROP_TENTH, autocovariance
from ..surfaces.characterise.heights import height_parameters
from ..surfaces.characterise.spectrum import PowerSpectrum, power_spectrum
from ..surfaces.generate.autocorrelation import ExponentialAutocorrelation
from ..surfaces.generate.gaussian import Spectrum
from ..surfaces.prepare.level import filled
from ..surfaces.surface import Surface
from ..theories.rough.predictor import (
    CAPPED_GAP,
    CAPPED_RANGE,
    HEIGHTS,
    LEAST_GAP,
    LEAST_PIXELS,
    MOST_CAPPED,
    SQRT_J2,
    SQRT_J2_ERROR,
    Expected,
    Groups,
    capped,
    of_shape,
    predictor,
)
from .one_layer import one_layer

Rough: TypeAlias = Surface | Spectrum
"""A measured or generated map, or the spectrum of surfaces that have not been made."""

LEAST_PROPORTION, LARGEST_PROPORTION = 0.5, 2.0
"""Ratio of the 10 % lengths along x and y between which a surface counts as isotropic."""

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

MEANING = {
    "y": "mean pressure / rms pressure of full contact",
    "X": "mean pressure × 10 % length / (modulus × rms height × ε)",
    "nayak": "bandwidth α",
    "nayak, layered": "bandwidth α of a surface on a layered body",
    "size": "side / 10 % length",
    "ratio": "modulus of the layer / that of its base",
    "thickness": "thickness of the layer / 10 % length",
}
"""Groups in words."""


@dataclass(frozen=True)
class Waves:
    """Sums over the waves of a rough surface and the compliance of the bodies that it presses on.

    Attributes
    ----------
    full_contact
        s in Pa, rms pressure of full contact, s² = Σ |h|²/c².
    stiffening
        ε, mean of c_base/c with the weights |h|² q^(-1/2)/c_base; 1 on a half-space.
    rms, gradient
        Rms height in m, and rms of the gradient.
    nayak
        Bandwidth α = m0 m4/m2².
    length
        10 % length β in m, the mean of those along x and y; NaN if the correlation does not fall so
        far.
    modulus
        Contact modulus in Pa of the half-spaces below the layers.
    """

    full_contact: float
    stiffening: float
    rms: float
    gradient: float
    nayak: float
    length: float
    modulus: float

    @property
    def summit_length(self) -> float:
        """λ in m, rms gradient over rms curvature √(m2/m4): as wide as the smallest contacts."""
        return self.rms / self.gradient * math.sqrt(1.5 / self.nayak)

    @classmethod
    def of(cls, spectrum: PowerSpectrum, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums over the modes of ``spectrum``."""
        grid = spectrum.grid
        q = grid.wavenumber()
        q[0, 0] = q[-1, -1]  # any wavenumber: the mean has no share
        psd = spectrum.psd.copy()
        psd[0, 0] = 0.0
        m0, m2, m4 = (mode_sum(grid, psd * q**order) for order in (0, 2, 4))
        if not m0 > 0.0:
            raise InputError("surface of a prediction must be rough, but is flat.")
        compliance = contact_compliance(body, counter_body).spectral(q)
        modulus = contact_modulus(_base(body), _base(counter_body))
        weights = psd / np.sqrt(q)
        return cls(
            full_contact=math.sqrt(mode_sum(grid, psd / np.square(compliance))),
            stiffening=mode_sum(grid, weights / compliance) / mode_sum(grid, 0.5 * modulus * q * weights),
            rms=math.sqrt(m0),
            gradient=math.sqrt(m2),
            nayak=1.5 * m0 * m4 / m2**2,  # m2 and m4 of profiles are 1/2 and 3/8 of these sums
            length=_length(grid, psd),
            modulus=modulus,
        )

    @classmethod
    def of_spectrum(cls, grid: Grid, spectrum: Spectrum, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums expected of surfaces with the ``spectrum`` on a ``grid``."""
        found = cls.of(PowerSpectrum(grid, spectrum.lattice_psd(grid), "none"), body, counter_body)
        if not isinstance(spectrum, ExponentialAutocorrelation):
            return found
        # as it is without the removal of the mean from maps of finite size
        return replace(found, length=_isotropic(*(math.log(10.0) * decay for decay in spectrum.decay_lengths)))

    @classmethod
    def of_surface(cls, surface: Surface, body: Body, counter_body: Body = Rigid()) -> Self:
        """Sums of a map, of a measured one with a Hann window; missing points are filled."""
        whole = filled(surface) if surface.n_missing else surface
        found = cls.of(power_spectrum(whole), body, counter_body)
        covariance = autocovariance(surface)
        lengths = [covariance.correlation_length(DROP_TENTH, axis=axis, logarithmic=True) for axis in ("x", "y")]
        return replace(found, length=_isotropic(*lengths))


def _base(body: Body) -> Any:
    return body.base if isinstance(body, Layered) else body


def _length(grid: Grid, psd: RealArray) -> float:
    """10 % length of the autocovariance that belongs to the spectrum ``psd``."""
    covariance = RealTransform(grid.shape, thread_count()).backward(psd.astype(complex))
    lengths = []
    for values, pixel in ((covariance[:, 0], grid.spacing[0]), (covariance[0], grid.spacing[1])):
        below = np.flatnonzero(values <= DROP_TENTH * values[0])
        if below.size == 0:
            return math.nan
        after = int(below[0])
        high, low, level = float(values[after - 1]), float(values[after]), DROP_TENTH * float(values[0])
        share = math.log(high / level) / math.log(high / low) if low > 0.0 else (high - level) / (high - low)
        lengths.append(pixel * (after - 1 + share))
    return _isotropic(*lengths)


def _isotropic(along_x: float, along_y: float) -> float:
    """Mean of two lengths, which must be about the same."""
    if not math.isfinite(along_x + along_y):
        raise InputError(
            "autocorrelation of the surface must fall to 10 % within the map for a prediction, but does "
            "not. Level the surface, take a larger map, or solve it."
        )
    if not LEAST_PROPORTION <= along_x / along_y <= LARGEST_PROPORTION:
        raise InputError(
            f"surface of a prediction must be isotropic, but its 10 % lengths are {along_x:.3g} m along x and "
            f"{along_y:.3g} m along y. Solve it: {in_words('{solve}')}."
        )
    return 0.5 * (along_x + along_y)


@dataclass(frozen=True)
class Prediction:
    """What a contact is expected to be, without solving it.

    Each number is an ``Expected``: mean over surfaces of the same statistics, standard error of
    that mean, standard deviation from one surface to the next, and ``band`` of both.

    Attributes
    ----------
    area_fraction
        Real contact area over nominal area, freed of the size of the pixels by the perimeter
        (Yastrebov, Anciaux & Molinari 2017). ``area_fraction_corrected`` of a result finds the
        edges between pixels instead.
    area_fraction_pixels
        Pixels in contact over all: ``area_fraction`` of a result.
    peak_pressure
        Largest pressure of a pixel in Pa; an extreme value, for which the band says more than the
        mean.
    mean_gap
        In m; NaN, as the counted pixels, of surfaces without an exponential autocorrelation, and
        where much of the contact is at the hardness.
    max_sqrtJ2
        Largest √J₂ below the surface in Pa; NaN of layered bodies and at the hardness.
    yield_factor
        Factor on ``max_sqrtJ2`` at which the body first yields, Y/(√3 √J₂); NaN where the yield
        stress is not known.
    pull_pressure
        Pull over nominal area in Pa, added to the load; NaN where nothing pulls.
    pressure
        Mean pressure in Pa that is prescribed.
    groups
        The groups y, X, α, size, and those of a layer, by which the table is read.
    waves
        Sums over the waves of the surface, among them the rms pressure of full contact.
    findings
        What should be known before the numbers are used.
    """

    area_fraction: Expected
    area_fraction_pixels: Expected
    peak_pressure: Expected
    mean_gap: Expected
    max_sqrtJ2: Expected
    yield_factor: Expected
    pull_pressure: Expected
    pressure: float
    groups: Groups
    waves: Waves
    findings: tuple[Advice, ...] = ()
    citation_keys: ClassVar[tuple[str, ...]] = ("Nayak1971", "Peng2001", "Yastrebov2017")

    def values(self) -> list[tuple[Quantity, Expected]]:
        """Every number that is known, with name, unit and label."""
        found = [(quantity, getattr(self, quantity.name)) for quantity in QUANTITIES]
        return [(quantity, value) for quantity, value in found if math.isfinite(value.value)]


QUANTITIES = (
    Quantity("area_fraction", "1", "real contact area / nominal area"),
    Quantity("area_fraction_pixels", "1", "pixels in contact / all pixels"),
    Quantity("peak_pressure", "Pa", "largest pressure of a pixel"),
    Quantity("mean_gap", "m", "mean gap"),
    Quantity("max_sqrtJ2", "Pa", "largest √J₂ below the surface"),
    Quantity("yield_factor", "1", "factor at which the body first yields"),
    Quantity("pull_pressure", "Pa", "pull / nominal area"),
)
"""Numbers of a prediction, in their order."""

UNKNOWN = Expected(math.nan, math.nan, math.nan)


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
    ratio, thickness, of_layers = one_layer(body, counter_body, waves.length, used)
    base = Groups(
        pressure / waves.full_contact,
        pressure * waves.length / (waves.modulus * waves.rms * waves.stiffening),
        waves.nayak,
        math.sqrt(used.area) / waves.length,
        used.n_points,
        ratio,
        thickness / waves.length,
    )
    groups, pulled = _with_pull(base, pressure, pull, waves)
    _require_inside(groups)
    _require_gaussian(surface)
    alike = _exponential(waves, used)
    if pull is not None and not alike:
        raise InputError(
            "surface must have an exponential autocorrelation for a prediction with a pull, but has another. "
            f"Solve it: {in_words('{solve}')}."
        )
    unlike = math.hypot(0.0 if alike else UNLIKE, of_layers)
    area, pixels, peak, gap = _elastic(groups, surface, alike, unlike)
    peak = peak.times(waves.full_contact)
    elastic = peak
    if hardness is not None:
        u = _hard(hardness, pressure, groups, pull)
        area, pixels, peak = capped(area, u, "area"), capped(pixels, u, "area_pixels"), peak.below(hardness)
        gap = gap if u <= CAPPED_GAP else UNKNOWN
    largest = peak.times(SQRT_J2, SQRT_J2_ERROR) if ratio == 1.0 and peak == elastic else UNKNOWN
    found = Prediction(
        area_fraction=area,
        area_fraction_pixels=pixels,
        peak_pressure=peak,
        mean_gap=gap.times(waves.rms),
        max_sqrtJ2=largest,
        yield_factor=_yield_factor(largest, body, counter_body),
        pull_pressure=pulled,
        pressure=pressure,
        groups=groups,
        waves=waves,
    )
    return replace(found, findings=_findings(found, surface, alike, (body, counter_body), hardness))


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
    pixels = predictor().area(groups, "area_pixels").value * groups.points
    if pixels < LEAST_PIXELS:
        raise InputError(
            f"pixels in contact must be at least {LEAST_PIXELS:g} for a prediction, but {pixels:.2g} are "
            f"expected. Raise the load or enlarge the surface, or solve several surfaces: {in_words('{solve}')}."
        )


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


def _yield_factor(largest: Expected, body: Body, counter_body: Body) -> Expected:
    """Factor on the largest √J₂ at which the weaker body yields."""
    strength = weaker_strength(body, counter_body).get("yield_stress", math.nan)
    if not math.isfinite(strength * largest.value):
        return UNKNOWN
    factor = strength / math.sqrt(3.0) / largest.value
    return Expected(factor, factor * largest.error / largest.value, factor * largest.scatter / largest.value)


def _elastic(groups: Groups, surface: Rough, alike: bool, unlike: float) -> tuple[Expected, ...]:
    """Area, counted area, largest pressure over s and gap over the rms height of an elastic
    contact, with the relative standard error ``unlike`` of other surfaces and several layers."""
    read = predictor()
    found = {
        "area": read.area(groups).times(1.0, unlike),
        "area_pixels": read.area(groups, "area_pixels").times(1.0, unlike) if alike else UNKNOWN,
        "peak": read.peak(groups).times(1.0, unlike),
        "gap": read.gap(groups) if alike else UNKNOWN,
    }
    if isinstance(surface, Surface):
        skewness, kurtosis = _shape(surface)
        found = {name: of_shape(one, groups.y, skewness, kurtosis - 3.0, name) for name, one in found.items()}
    return tuple(found.values())


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
