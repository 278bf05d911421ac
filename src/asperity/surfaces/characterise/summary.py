"""All roughness quantities of a surface."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from operator import attrgetter
from typing import Any, ClassVar, TypeVar

from ...core import require
from ...core.errors import InputError
from ...core.late import Drawn
from ...core.quantity import Quantity
from ...core.units import percent
from ..prepare.level import filled
from ..surface import Surface, maps_only
from .correlation import (
    DROP_1E,
    DROP_TENTH,
    Autocovariance,
    FractalParameters,
    ScaleDependence,
    StructureFunction,
    autocovariance,
    fractal_parameters,
    scale_dependence,
    structure_function,
    tip_cutoff,
)
from .heights import (
    FunctionalParameters,
    HeightDistribution,
    HeightParameters,
    MaterialRatioCurve,
    functional_parameters,
    height_distribution,
    height_parameters,
    material_ratio_curve,
    tilt_share,
)
from .moments import DifferenceMoments, SlopeTensor, SpectralMoments, difference_moments, spectral_moments
from .quantities import QUANTITIES
from .slopes import developed_area_ratio, rms_slope
from .spectral_fit import MEASURED_MODEL_ERROR, SpectralFit, fit_spectrum
from .spectrum import (
    PowerSpectrum,
    ProfileSpectrum,
    RadialSpectrum,
    chosen_window,
    effective_samples,
    power_spectrum,
    profile_spectrum,
    radial_spectrum,
)
from .summits import ProfilePeaks, Summits, SummitStatistics, profile_peaks, summit_statistics, summits
from .texture import AngularSpectrum, angular_spectrum, doubts_of_texture, texture_lengths

# Quantities that are not defined on every surface.


T = TypeVar("T")


@dataclass(eq=False)
class Attempts:
    """Evaluates quantities; one that is undefined for the surface gives None and adds a sentence to
    ``remarks``."""

    remarks: list[str] = field(default_factory=list)

    def __call__(self, what: str, measure: Callable[[], T]) -> T | None:
        """Value of ``measure()``, or None after an ``InputError``; ``what`` names it in the
        remark."""
        try:
            return measure()
        except InputError as error:
            self.remarks.append(f"No {what}: {error}")
            return None

    def along_axes(self, what: str, measure: Callable[[str], T]) -> tuple[T | None, T | None]:
        """Values of ``measure("x")`` and ``measure("y")``."""
        return self(f"{what} along x", lambda: measure("x")), self(f"{what} along y", lambda: measure("y"))


# Functions from which the quantities follow, each computed once.


@dataclass(frozen=True, eq=False)
class Curves:
    """Functions of a surface; tuples hold those along x and y. None where a function is not
    defined."""

    material_ratio: MaterialRatioCurve
    distribution: HeightDistribution
    autocovariance: Autocovariance
    summits: Summits
    structure: tuple[StructureFunction | None, StructureFunction | None]
    scale: tuple[ScaleDependence | None, ScaleDependence | None]


@dataclass(frozen=True, eq=False)
class SpectralCurves:
    """Spectra of a surface; ``tip_cutoff`` (m) is the wavelength below which they were not fitted,
    NaN if none was given.

    ``power`` two-dimensional spectrum, ``radial`` its mean over rings, ``profiles`` those along x
    and y, ``angular`` by direction, ``fit`` the fitted model. None where it is not defined.
    """

    power: PowerSpectrum | None
    radial: RadialSpectrum | None
    profiles: tuple[ProfileSpectrum | None, ProfileSpectrum | None]
    angular: AngularSpectrum | None
    fit: SpectralFit | None
    tip_cutoff: float

    @property
    def lag_range(self) -> tuple[float, float] | None:
        """Lags in m between which second differences follow one power law; None if not known."""
        if self.fit is None:
            return None
        shortest, longest = self.fit.lag_range
        return max(shortest, 0.0 if math.isnan(self.tip_cutoff) else self.tip_cutoff), longest


def measured_spectra(
    surface: Surface, window: str, *, tip_radius: float | None, curves: Curves, attempt: Attempts
) -> SpectralCurves:
    """Spectra of the complete ``surface``, fitted above the length that a tip of ``tip_radius`` (m)
    resolves."""
    cutoff = math.nan
    if tip_radius is not None:
        cutoff = max((tip_cutoff(curve, tip_radius) for curve in curves.scale if curve is not None), default=math.nan)
    power = attempt("power spectrum", lambda: power_spectrum(surface, window))
    lines = "hann" if window == "radial hann" else window
    profiles = attempt.along_axes(
        "spectrum of profiles", lambda axis: profile_spectrum(surface, axis=axis, window=lines)
    )
    if power is None:
        return SpectralCurves(None, None, profiles, None, None, cutoff)
    reliable = 0.0 if math.isnan(cutoff) else cutoff
    error = 0.0 if surface.periodic else MEASURED_MODEL_ERROR
    return SpectralCurves(
        power,
        radial=radial_spectrum(power),
        profiles=profiles,
        angular=angular_spectrum(power),
        fit=attempt("fitted spectrum", lambda: fit_spectrum(power, reliable_wavelength=reliable, model_error=error)),
        tip_cutoff=cutoff,
    )


def completed(surface: Surface, fill: str | None, attempt: Attempts) -> Surface:
    """``surface`` with its missing points filled by the method ``fill``, for the spectra; as it is
    without one."""
    if fill is None or surface.n_missing == 0:
        return surface
    complete = filled(surface, fill)  # type: ignore[arg-type]  # checked by the function
    step = complete.origin.history[-1]
    attempt.remarks.append(f"Only for the spectra the surface was {step}; all other quantities exclude these points.")
    return complete


# The groups of quantities.


_NAN = math.nan


@dataclass(frozen=True)
class SpatialParameters:
    """Lengths over which heights are correlated (m) and directions of the texture (rad from +x
    towards +y, [0, π)).

    ``Sal``, ``Str``, ``Std`` of ISO 25178-2, with a lower bound of Sal and an upper one of Str,
    which are known where these are not; ``lay`` across the steepest axis of the slope tensor,
    which is less sensitive to noise than Std; ``beta_e_x``, ``beta_e_y`` distance of R/R(0) = 1/e
    and ``beta_01_x``, ``beta_01_y`` (β*) of 0.1 along the axes. NaN where the correlation does not
    fall that far inside the map.
    """

    Sal: float
    Str: float
    Sal_least: float
    Str_most: float
    Std: float
    lay: float
    beta_e_x: float
    beta_e_y: float
    beta_01_x: float
    beta_01_y: float


@dataclass(frozen=True)
class HybridParameters:
    """``Sdq`` rms gradient, ``Sdr`` developed area less one (both dimensionless), ``Ssc`` mean
    summit curvature (1/m)."""

    Sdq: float
    Sdr: float
    Ssc: float


@dataclass(frozen=True)
class Moments:
    """Moments by finite differences and from the spectrum."""

    difference: DifferenceMoments
    spectral: SpectralMoments


@dataclass(frozen=True)
class SummitDensities:
    """Summit statistics by both definitions: above 8 neighbours (``eight``, the one to use) and
    above 4 (``four``)."""

    eight: SummitStatistics
    four: SummitStatistics


@dataclass(frozen=True)
class SpectralParameters:
    """Fitted form of the spectrum; relative standard errors (``*_error``) but for exponents, whose
    are absolute.

    ``exponent_1``, ``exponent_2`` of C ~ q^-a; ``hurst`` = (a1 - 2)/2 where that is a Hurst
    exponent, between 0 and 1 to two standard errors; ``longest_wave``, ``shortest_wave`` (m)
    between which it was found; ``plateau`` C0 (m⁴) and ``rolloff_wavelength``
    (m), NaN if the scan shows no roll-off; ``crossover_wavelength`` (m) between two power laws;
    ``floor`` (m⁴) of white noise; ``short_cutoff`` wavelength (m) at which the spectrum ends. NaN
    for what the spectrum does not have.
    """

    hurst: float = _NAN
    hurst_error: float = _NAN
    longest_wave: float = _NAN
    shortest_wave: float = _NAN
    exponent_1: float = _NAN
    exponent_1_error: float = _NAN
    exponent_2: float = _NAN
    exponent_2_error: float = _NAN
    plateau: float = _NAN
    plateau_error: float = _NAN
    rolloff_wavelength: float = _NAN
    rolloff_error: float = _NAN
    crossover_wavelength: float = _NAN
    crossover_error: float = _NAN
    floor: float = _NAN
    floor_error: float = _NAN
    short_cutoff: float = _NAN


@dataclass(frozen=True)
class Sampling:
    """Sampling error of the map, for Gaussian heights.

    ``effective_samples`` number of independent heights; ``Sq_error`` relative scatter of Sq from
    map to map, 1/sqrt(2 N_eff); ``tip_cutoff`` length (m) below which the tip may have distorted
    the map, NaN if no tip was given.
    """

    effective_samples: float
    Sq_error: float
    tip_cutoff: float


def spectral_parameters(fit: SpectralFit) -> SpectralParameters:
    """The numbers of ``fit``."""
    model, errors = fit.model, fit.errors
    two = len(model.exponents) == 2
    longest, shortest = fit.band
    return SpectralParameters(
        hurst=fit.hurst,
        hurst_error=_NAN if math.isnan(fit.hurst) else fit.hurst_error,
        longest_wave=_NAN if math.isnan(fit.hurst) else longest,
        shortest_wave=_NAN if math.isnan(fit.hurst) else shortest,
        exponent_1=model.exponents[0],
        exponent_1_error=errors["exponent_1"],
        exponent_2=model.exponents[1] if two else _NAN,
        exponent_2_error=errors.get("exponent_2", _NAN),
        plateau=model.level if fit.has_rolloff else _NAN,
        plateau_error=errors["level"] if fit.has_rolloff else _NAN,
        rolloff_wavelength=model.rolloff_wavelength if fit.has_rolloff else _NAN,
        rolloff_error=errors["rolloff_wavelength"] if fit.has_rolloff else _NAN,
        crossover_wavelength=model.crossover_wavelength,
        crossover_error=errors.get("crossover_wavelength", _NAN),
        floor=model.floor if "floor" in errors else _NAN,
        floor_error=errors.get("floor", _NAN),
        short_cutoff=fit.short_cutoff,
    )


_DECADE = 10.0  # ratio of the wavelengths that a self-affine surface shows at least


def doubts_of_self_affinity(fit: SpectralFit | None, along: Sequence[FractalParameters]) -> list[str]:
    """Why the profiles are not taken as self-affine, a sentence for each reason; empty if they
    are."""
    if fit is None or math.isnan(fit.hurst):
        return ["Not self-affine: the spectrum has no Hurst exponent between 0 and 1."]
    found = [
        f"Not self-affine: the Hurst exponents {item.hurst:.2f} ± {item.dimension_error:.2g} of second differences "
        f"along {item.axis} and {fit.hurst:.2f} ± {fit.hurst_error:.2g} of the spectrum differ by more than twice "
        "their standard error."
        for item in along
        if item.dimension_error > 0.0 and not fit.agrees(item.hurst, item.dimension_error)
    ]
    longest, shortest = fit.band
    if longest < _DECADE * shortest:
        ratio = longest / shortest
        found.append(f"Not self-affine: one power law holds over a factor {ratio:.2g} of wavelengths, not a decade.")
    return found


def undefined(kind: type[T], **known: Any) -> T:
    """Instance of the dataclass ``kind`` with NaN for all fields that are not ``known``."""
    return kind(**{item.name: known.get(item.name, _NAN) for item in fields(kind)})  # type: ignore[arg-type]


_NO_MOMENTS = undefined(SpectralMoments)
_TILT = 1e-3  # share of the mean square height in a plane above which a map was not levelled


@dataclass(frozen=True, eq=False, repr=False)
class Characterisation(Drawn):
    """The numbers that describe ``surface``, in SI units, in groups; NaN for what is not defined.

    ``heights``, ``spatial``, ``hybrid``, ``functional``: parameters of ISO 25178-2; ``moments``,
    ``summits``, ``peaks_x``, ``peaks_y``, ``fractal_x``, ``fractal_y``, ``spectrum``: statistics
    for contact theories; ``sampling``: their sampling error; ``curves`` and ``spectra``: the
    functions from which they follow; ``remarks``: one sentence for each quantity that could not be
    computed and each assumption. ``values()`` lists every quantity with unit, definition and
    source.
    """

    surface: Surface
    heights: HeightParameters
    spatial: SpatialParameters
    hybrid: HybridParameters
    functional: FunctionalParameters
    moments: Moments
    summits: SummitDensities
    peaks_x: ProfilePeaks
    peaks_y: ProfilePeaks
    fractal_x: FractalParameters
    fractal_y: FractalParameters
    spectrum: SpectralParameters
    sampling: Sampling
    curves: Curves
    spectra: SpectralCurves
    remarks: tuple[str, ...] = ()

    _KEYS: ClassVar[tuple[str, ...]] = (
        "Abbott1933",
        "Bhushan1998",
        "Ganti1995",
        "ISO25178",
        "Istas1997",
        "Jacobs2017",
        "Kent1997",
        "Majumdar1990",
        "McCool1987",
        "Nayak1971",
        "Sanner2022",
        "Sykulski2019",
        "Whitehouse1970",
        "Whittle1953",
    )

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the definitions, the surface and its preparation."""
        return tuple(sorted({*self._KEYS, *self.surface.citation_keys}))

    @property
    def self_affine(self) -> bool:
        """Whether one power law holds: the Hurst exponents of second differences and of the
        spectrum agree, over a decade of wavelengths or more; if not, ``remarks`` say why."""
        return not doubts_of_self_affinity(self.spectra.fit, (self.fractal_x, self.fractal_y))

    def values(self) -> tuple[tuple[Quantity, float], ...]:
        """Every quantity with its value, in the order of ``QUANTITIES``."""
        return tuple((quantity, float(attrgetter(quantity.name)(self))) for quantity in QUANTITIES)


@maps_only
def characterise(
    surface: Surface, *, fill: str | None = "harmonic", window: str = "auto", tip_radius: float | None = None
) -> Characterisation:
    """All roughness quantities of ``surface``: ISO 25178-2 parameters, spectra, correlation,
    summits, fractal parameters.

    Nothing is levelled, filtered or cropped: prepare the surface first. Heights are measured from
    their mean. Raises InputError if a choice is unknown or the radius is not positive. What cannot
    be computed for this surface is NaN and explained in ``remarks``.

    Parameters
    ----------
    surface
        Prepared surface, measured or generated; periodic or not, any pixels.
    fill
        Method by which missing points are filled for the spectra (see ``filled``), or None for no
        spectra. All other quantities exclude missing points.
    window
        Window of the spectra, see ``asperity.roughness.power_spectrum``.
    tip_radius
        Radius in m of the tip of the scanning probe: waves that it may have distorted are excluded
        from the fitted spectrum.
    """
    chosen_window(window, surface)
    if tip_radius is not None:
        require.positive(tip_radius, "radius of the tip (m)")
    attempt = Attempts()
    complete = completed(surface, fill, attempt)
    structure = attempt.along_axes("structure function", lambda axis: structure_function(surface, axis=axis))
    known = dict(zip("xy", structure, strict=True))
    scale = attempt.along_axes(
        "scale-dependent curvature", lambda axis: scale_dependence(surface, axis=axis, structure=known[axis])
    )
    covariance, found = autocovariance(surface), summits(surface)
    curves = Curves(material_ratio_curve(surface), height_distribution(surface), covariance, found, structure, scale)
    spectra = measured_spectra(complete, window, tip_radius=tip_radius, curves=curves, attempt=attempt)
    if not surface.periodic and (share := tilt_share(surface)) > _TILT:
        attempt.remarks.append(f"A plane contains {percent(share)} of the mean square height; level the surface first.")
    none = undefined(DifferenceMoments, slope_tensor=undefined(SlopeTensor))
    difference = attempt("moments by differences", lambda: difference_moments(surface)) or none
    tensor, lengths, eight = difference.slope_tensor, texture_lengths(covariance), summit_statistics(found)
    attempt.remarks.extend(doubts_of_texture(lengths, periodic=surface.periodic))
    fractal = attempt.along_axes(
        "fractal dimension",
        lambda axis: fractal_parameters(surface, axis=axis, structure=known[axis], lag_range=spectra.lag_range),
    )
    attempt.remarks.extend(doubts_of_self_affinity(spectra.fit, [item for item in fractal if item is not None]))
    samples = math.nan if spectra.power is None else effective_samples(spectra.power)
    core = attempt("core of the material ratio curve", lambda: functional_parameters(curves.material_ratio))
    slope = attempt("rms gradient Sdq", lambda: rms_slope(surface))
    area = attempt("developed area Sdr", lambda: developed_area_ratio(surface))
    return Characterisation(
        surface,
        heights=height_parameters(surface),
        spatial=SpatialParameters(
            Sal=lengths.Sal,
            Str=lengths.Str,
            Sal_least=lengths.Sal_least,
            Str_most=lengths.Str_most,
            Std=math.nan if spectra.angular is None else spectra.angular.peak,
            lay=(tensor.direction + 0.5 * math.pi) % math.pi if tensor.xx + tensor.yy > 0.0 else math.nan,
            beta_e_x=covariance.correlation_length(DROP_1E, axis="x"),
            beta_e_y=covariance.correlation_length(DROP_1E, axis="y"),
            beta_01_x=covariance.correlation_length(DROP_TENTH, axis="x"),
            beta_01_y=covariance.correlation_length(DROP_TENTH, axis="y"),
        ),
        hybrid=HybridParameters(_NAN if slope is None else slope, _NAN if area is None else area, eight.mean_curvature),
        functional=core or undefined(FunctionalParameters),
        moments=Moments(difference, _NO_MOMENTS if spectra.power is None else spectral_moments(spectra.power)),
        summits=SummitDensities(eight, summit_statistics(summits(surface, 4))),
        peaks_x=profile_peaks(surface, axis="x"),
        peaks_y=profile_peaks(surface, axis="y"),
        fractal_x=fractal[0] or undefined(FractalParameters, axis="x"),
        fractal_y=fractal[1] or undefined(FractalParameters, axis="y"),
        spectrum=SpectralParameters() if spectra.fit is None else spectral_parameters(spectra.fit),
        sampling=Sampling(samples, 1.0 / math.sqrt(2.0 * samples) if samples > 0.0 else math.nan, spectra.tip_cutoff),
        curves=curves,
        spectra=spectra,
        remarks=tuple(attempt.remarks),
    )
