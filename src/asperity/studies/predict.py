"""Contacts of rough surfaces predicted from a table of solved ones, without solving."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Self, TypeAlias

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
from ..physics.menisci.film import LiquidFilm
from ..solids.compliance.halfspace import contact_compliance
from ..solids.elastic import Elastic, Rigid
from ..solids.layers import Body, Bonded, Layered, contact_modulus, weaker_strength
from ..surfaces.characterise.correlation import DROP_TENTH, autocovariance
from ..surfaces.characterise.spectrum import PowerSpectrum, power_spectrum
from ..surfaces.generate.autocorrelation import ExponentialAutocorrelation
from ..surfaces.generate.gaussian import Spectrum
from ..surfaces.prepare.level import filled
from ..surfaces.surface import Surface
from ..theories.rough.predictor import (
    LEAST_GAP,
    LEAST_PIXELS,
    MENISCI,
    SQRT_J2,
    SQRT_J2_ERROR,
    Expected,
    Groups,
    predictor,
)

Rough: TypeAlias = Surface | Spectrum
"""A measured or generated map, or the spectrum of surfaces that have not been made."""

LAYER_NU = (0.2, 0.4)
"""Poisson's ratios of a layer and its base between which the factors of a layer hold."""

LEAST_PROPORTION, LARGEST_PROPORTION = 0.5, 2.0
"""Ratio of the 10 % lengths along x and y between which a surface counts as isotropic."""

ROUNDS, SETTLED = 50, 1e-6
"""Rounds in which the pull of menisci is added to the load, and the relative change that ends
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
    rms
        Rms height in m.
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
    nayak: float
    length: float
    modulus: float

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
        In m.
    max_sqrtJ2
        Largest √J₂ below the surface in Pa; NaN of layered bodies.
    yield_factor
        Factor on ``max_sqrtJ2`` at which the body first yields, Y/(√3 √J₂); NaN where the yield
        stress is not known.
    meniscus_pressure
        Force of the menisci over nominal area in Pa, added to the load; NaN without a film.
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
    meniscus_pressure: Expected
    pressure: float
    groups: Groups
    waves: Waves
    findings: tuple[Advice, ...] = ()

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
    Quantity("meniscus_pressure", "Pa", "force of the menisci / nominal area"),
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
    film: LiquidFilm | None = None,
) -> Prediction:
    """Predict area, largest pressure, gap, yield and menisci of a rough surface that is pressed
    against a body, in milliseconds and without solving.

    The numbers are read from a table of contacts of Gaussian surfaces with exponential
    autocorrelation, by the mean pressure over the rms pressure s of full contact of the bodies as
    they are layered,

        s² = Σ |h(q)|²/c(q)²,

    and Nayak's bandwidth α. The contact is periodic, elastic and without friction.

    Parameters
    ----------
    surface
        Map of heights (levelled, if measured), or a spectrum such as
        ``ExponentialAutocorrelation(rms_height, correlation_length)`` of surfaces on a ``grid``.
    body
        Half-space, or one bonded layer on a half-space with 0.25 <= E1/E2 <= 5.6 and Poisson's
        ratios from 0.2 to 0.4.
    control
        ``MeanPressure`` in Pa or ``Force`` in N.
    grid
        Pixels and size of the surfaces of a spectrum.
    counter_body
        Rigid, or a half-space where ``body`` is one too.
    film
        Liquid film whose menisci are as high as it is thick, from a quarter to three rms heights;
        their pull is added to the load.

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
    ratio, thickness = _layer(body, counter_body)
    base = Groups(
        pressure / waves.full_contact,
        pressure * waves.length / (waves.modulus * waves.rms * waves.stiffening),
        waves.nayak,
        math.sqrt(used.area) / waves.length,
        used.n_points,
        ratio,
        thickness / waves.length,
    )
    groups, pull = _with_menisci(base, pressure, film, waves)
    _require_inside(groups)
    read = predictor()
    peak = read.peak(groups).times(waves.full_contact)
    largest = peak.times(SQRT_J2, SQRT_J2_ERROR) if ratio == 1.0 else UNKNOWN
    area = read.area(groups)
    found = Prediction(
        area_fraction=area,
        area_fraction_pixels=read.area(groups, "area_pixels"),
        peak_pressure=peak,
        mean_gap=read.gap(groups).times(waves.rms),
        max_sqrtJ2=largest,
        yield_factor=_yield_factor(largest, body, counter_body),
        meniscus_pressure=pull,
        pressure=pressure,
        groups=groups,
        waves=waves,
    )
    return replace(found, findings=_findings(found, surface, body, counter_body))


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


def _layer(body: Body, counter_body: Body) -> tuple[float, float]:
    """E1/E2 and thickness (m) of the one layer of the bodies; 1 and inf without one."""
    bodies = [one.bare if isinstance(one, Layered) else one for one in (body, counter_body)]
    layered = [one for one in bodies if isinstance(one, Layered) and one.layers]
    solve = f"Solve it: {in_words('{solve}')}."
    plain = all(isinstance(_base(one), Elastic | Rigid) for one in bodies)
    if not plain:
        raise InputError(f"bodies of a prediction must be elastic half-spaces below their layers, but are not. {solve}")
    if not layered:
        return 1.0, math.inf
    rigid = any(isinstance(one, Rigid) for one in bodies)
    if len(layered) > 1 or not rigid or len(layered[0].layers) > 1:
        raise InputError(
            "bodies of a prediction must be half-spaces, or one layer on a half-space against a rigid "
            f"surface, but have more layers or a soft counter body. {solve}"
        )
    layer, base = layered[0].layers[0], layered[0].base
    top = layer.material
    if not isinstance(layer.interface, Bonded) or not isinstance(top, Elastic) or not isinstance(base, Elastic):
        raise InputError(f"layer of a prediction must be homogeneous, elastic and bonded, but is not. {solve}")
    for material in (top, base):
        if not LAYER_NU[0] <= material.poisson_ratio <= LAYER_NU[1]:
            raise InputError(
                f"Poisson's ratios of a layer and its base must be from {LAYER_NU[0]} to {LAYER_NU[1]} for a "
                f"prediction, but one is {material.poisson_ratio:g}. {solve}"
            )
    return top.youngs_modulus / base.youngs_modulus, layer.thickness


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


def _with_menisci(groups: Groups, pressure: float, film: LiquidFilm | None, waves: Waves) -> tuple[Groups, Expected]:
    """Groups with the pull of the menisci of ``film`` in the load, and that pull in Pa."""
    if film is None:
        return groups, UNKNOWN
    height = film.meniscus_height / waves.rms
    if film.meniscus_height != film.thickness:
        raise InputError(
            f"meniscus height (m) must be the thickness {film.thickness:g} of the film for a prediction, but is "
            f"{film.meniscus_height:g}. Solve it: {in_words('{solve}')}."
        )
    if not MENISCI[0] <= height <= MENISCI[-1]:
        raise InputError(
            f"thickness of the film must be from {MENISCI[0]} to {MENISCI[-1]} rms heights for a prediction, but "
            f"is {height:.3g}. Solve it: {in_words('{solve}')}."
        )
    pull, fed = Expected(0.0, 0.0, 0.0), groups
    for _ in range(ROUNDS):
        more = 1.0 + pull.value / pressure
        fed = replace(groups, y=groups.y * more, X=groups.X * more)
        _require_inside(fed)
        gap = predictor().gap(fed).value
        if gap < LEAST_GAP:
            raise InputError(
                f"mean gap must be at least {LEAST_GAP} rms heights for a prediction of menisci, but is {gap:.2g}. "
                f"Solve it: {in_words('{solve}')}."
            )
        before, pull = pull, predictor().menisci(fed, height).times(film.suction)
        if abs(pull.value - before.value) <= SETTLED * (pressure + pull.value):
            return fed, pull
    raise InputError(
        f"film must pull less than the surfaces resist for a prediction, but its pull of {pull.value:.3g} Pa does "
        f"not settle. Solve it: {in_words('{solve}')}."
    )


def _yield_factor(largest: Expected, body: Body, counter_body: Body) -> Expected:
    """Factor on the largest √J₂ at which the weaker body yields."""
    strength = weaker_strength(body, counter_body).get("yield_stress", math.nan)
    if not math.isfinite(strength * largest.value):
        return UNKNOWN
    factor = strength / math.sqrt(3.0) / largest.value
    return Expected(factor, factor * largest.error / largest.value, factor * largest.scatter / largest.value)


def _findings(found: Prediction, surface: Rough, body: Body, counter_body: Body) -> tuple[Advice, ...]:
    """What should be known of the prediction."""
    made, peak = [], found.peak_pressure
    hardness = weaker_strength(body, counter_body).get("hardness", math.inf)
    if peak.value > hardness:
        made.append(
            Advice(
                "warning",
                "prediction elastic",
                f"The largest pressure {peak.value:.3g} Pa exceeds the hardness {hardness:.3g} Pa: the real area is "
                "larger and the pressure lower than predicted.",
                "Solve it with {hardness}.",
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
                concerns=("peak_pressure", "max_sqrtJ2", "yield_factor"),
            )
        )
    if isinstance(surface, Surface):
        deviation = (surface.heights - np.mean(surface.heights)) / np.std(surface.heights)
        skewness, kurtosis = float(np.nanmean(deviation**3)), float(np.nanmean(deviation**4))
        if abs(skewness) > 0.5 or abs(kurtosis - 3.0) > 1.0:
            made.append(
                Advice(
                    "warning",
                    "prediction Gaussian",
                    f"The heights have a skewness of {skewness:.2g} and a kurtosis of {kurtosis:.2g}, and the table "
                    "is of Gaussian surfaces.",
                    "Solve it: {solve}.",
                    {"skewness": skewness, "kurtosis": kurtosis},
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
