"""Everything about a surface at once."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from operator import attrgetter
from typing import ClassVar

from ...core import require
from ...core.quantity import Quantity
from ...core.units import percent
from ..surface import Surface
from .attempts import Attempts
from .autocorrelation import DROP_1E, DROP_TENTH
from .curves import Curves, SpectralCurves, completed, measured_curves, measured_spectra
from .expectation import effective_samples
from .fractal import FractalParameters, fractal_parameters
from .heights import HeightParameters, height_parameters
from .material_ratio import FunctionalParameters, functional_parameters
from .moments import DifferenceMoments, SlopeTensor, SpectralMoments, difference_moments, spectral_moments
from .parameters import (
    HybridParameters,
    Moments,
    Sampling,
    SpatialParameters,
    SpectralParameters,
    SummitDensities,
    spectral_parameters,
    undefined,
)
from .peaks import ProfilePeaks, profile_peaks
from .quantities import QUANTITIES
from .slopes import developed_area_ratio, rms_slope
from .summits import summit_statistics, summits
from .texture import texture_lengths
from .tilt import tilt_share
from .windows import chosen_window

_TILT = 1e-3  # share of the mean square height in a plane above which a map was not levelled


@dataclass(frozen=True, eq=False)
class Characterisation:
    """The numbers that describe ``surface``, in SI units, in groups; NaN for what is not defined.

    ``heights``, ``spatial``, ``hybrid``, ``functional``: parameters of ISO 25178-2; ``moments``, ``summits``,
    ``peaks_x``, ``peaks_y``, ``fractal_x``, ``fractal_y``, ``spectrum``: statistics for contact theories; ``sampling``:
    how sure they are; ``curves`` and ``spectra``: the functions behind them; ``remarks``: what could not be computed or
    was done first, one sentence each. ``values()`` lists every number with its unit, definition and source.
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
    curves: Curves = field(repr=False)
    spectra: SpectralCurves = field(repr=False)
    remarks: tuple[str, ...] = ()

    _KEYS: ClassVar[tuple[str, ...]] = (
        "Abbott1933",
        "Bhushan1998",
        "Ganti1995",
        "ISO25178",
        "Jacobs2017",
        "Majumdar1990",
        "McCool1987",
        "Nayak1971",
        "Sanner2022",
        "Whitehouse1970",
        "Whittle1953",
    )

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the definitions, the surface and its preparation."""
        return tuple(sorted({*self._KEYS, *self.surface.citation_keys}))

    def values(self) -> tuple[tuple[Quantity, float], ...]:
        """Every number with what it is, in the order of ``QUANTITIES``."""
        return tuple((quantity, float(attrgetter(quantity.name)(self))) for quantity in QUANTITIES)


def characterise(
    surface: Surface, *, fill: str | None = "harmonic", window: str = "auto", tip_radius: float | None = None
) -> Characterisation:
    """Measure everything about ``surface``: ISO 25178-2 parameters, spectra, correlation, summits, fractal and more.

    Nothing is levelled, filtered or cropped: prepare the surface first. Heights count from their mean.

    Parameters
    ----------
    surface
        Prepared surface, measured or generated; periodic or not, any pixels.
    fill
        How missing points are filled for the spectra (see ``filled``), or None to do without spectra. All other
        quantities leave missing points out, whatever is chosen.
    window
        Window of the spectra, see ``asperity.roughness.power_spectrum``.
    tip_radius
        Radius in m of the tip of the scanning probe: waves that it may have shaped are left out of the fitted spectrum.

    Raises
    ------
    InputError
        If a choice is unknown or the radius is not positive. What cannot be computed for this surface is NaN and
        explained in ``remarks``.
    """
    chosen_window(window, surface)
    if tip_radius is not None:
        require.positive(tip_radius, "radius of the tip (m)")
    attempt = Attempts()
    complete = completed(surface, fill, attempt)
    curves = measured_curves(surface, attempt)
    spectra = measured_spectra(complete, window, tip_radius=tip_radius, curves=curves, attempt=attempt)
    if not surface.periodic and (share := tilt_share(surface)) > _TILT:
        attempt.remarks.append(f"A plane carries {percent(share)} of the mean square height; level the surface first.")
    return _summary(surface, curves, spectra, attempt)


def _summary(surface: Surface, curves: Curves, spectra: SpectralCurves, attempt: Attempts) -> Characterisation:
    moments, eight = _moments(surface, spectra, attempt), summit_statistics(curves.summits)
    known = dict(zip("xy", curves.structure, strict=True))
    fractal = attempt.along_axes(
        "fractal dimension", lambda axis: fractal_parameters(surface, axis=axis, structure=known[axis])
    )
    core = attempt("core of the material ratio curve", lambda: functional_parameters(curves.material_ratio))
    return Characterisation(
        surface,
        heights=height_parameters(surface),
        spatial=_spatial(curves, spectra, moments.difference.slope_tensor),
        hybrid=_hybrid(surface, eight.mean_curvature, attempt),
        functional=core or undefined(FunctionalParameters),
        moments=moments,
        summits=SummitDensities(eight, summit_statistics(summits(surface, 4))),
        peaks_x=profile_peaks(surface, axis="x"),
        peaks_y=profile_peaks(surface, axis="y"),
        fractal_x=fractal[0] or undefined(FractalParameters, axis="x"),
        fractal_y=fractal[1] or undefined(FractalParameters, axis="y"),
        spectrum=SpectralParameters() if spectra.fit is None else spectral_parameters(spectra.fit),
        sampling=_sampling(spectra),
        curves=curves,
        spectra=spectra,
        remarks=tuple(attempt.remarks),
    )


def _moments(surface: Surface, spectra: SpectralCurves, attempt: Attempts) -> Moments:
    difference = attempt("moments by differences", lambda: difference_moments(surface))
    return Moments(
        difference or undefined(DifferenceMoments, slope_tensor=undefined(SlopeTensor)),
        undefined(SpectralMoments) if spectra.power is None else spectral_moments(spectra.power),
    )


def _spatial(curves: Curves, spectra: SpectralCurves, tensor: SlopeTensor) -> SpatialParameters:
    covariance, lengths = curves.autocovariance, texture_lengths(curves.autocovariance)
    return SpatialParameters(
        Sal=lengths.Sal,
        Str=lengths.Str,
        Std=math.nan if spectra.angular is None else spectra.angular.peak,
        lay=(tensor.direction + 0.5 * math.pi) % math.pi if tensor.xx + tensor.yy > 0.0 else math.nan,
        beta_e_x=covariance.correlation_length(DROP_1E, axis="x"),
        beta_e_y=covariance.correlation_length(DROP_1E, axis="y"),
        beta_01_x=covariance.correlation_length(DROP_TENTH, axis="x"),
        beta_01_y=covariance.correlation_length(DROP_TENTH, axis="y"),
    )


def _hybrid(surface: Surface, summit_curvature: float, attempt: Attempts) -> HybridParameters:
    slope = attempt("rms gradient Sdq", lambda: rms_slope(surface))
    area = attempt("developed area Sdr", lambda: developed_area_ratio(surface))
    return HybridParameters(
        Sdq=math.nan if slope is None else slope, Sdr=math.nan if area is None else area, Ssc=summit_curvature
    )


def _sampling(spectra: SpectralCurves) -> Sampling:
    samples = math.nan if spectra.power is None else effective_samples(spectra.power)
    return Sampling(samples, 1.0 / math.sqrt(2.0 * samples) if samples > 0.0 else math.nan, spectra.tip_cutoff)
