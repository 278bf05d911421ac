"""The functions behind the numbers of a characterisation, each computed once."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..prepare.fill import filled
from ..surface import Surface
from .attempts import Attempts
from .autocorrelation import Autocovariance, autocovariance
from .distribution import HeightDistribution, height_distribution
from .material_ratio import MaterialRatioCurve, material_ratio_curve
from .spectral_fit import SpectralFit, fit_spectrum
from .spectrum import PowerSpectrum, ProfileSpectrum, RadialSpectrum, power_spectrum, profile_spectrum, radial_spectrum
from .structure import ScaleDependence, StructureFunction, scale_dependence, structure_function, tip_cutoff
from .summits import Summits, summits
from .texture import AngularSpectrum, angular_spectrum

_MODEL_ERROR = 0.1  # of power laws fitted to measured maps, which are not periodic


@dataclass(frozen=True, eq=False)
class Curves:
    """Functions of a surface; tuples hold those along x and y. None where a function is not defined."""

    material_ratio: MaterialRatioCurve
    distribution: HeightDistribution
    autocovariance: Autocovariance
    summits: Summits
    structure: tuple[StructureFunction | None, StructureFunction | None]
    scale: tuple[ScaleDependence | None, ScaleDependence | None]


@dataclass(frozen=True, eq=False)
class SpectralCurves:
    """Spectra of a surface; ``tip_cutoff`` (m) is the wavelength below which they were not fitted, NaN if none was given.

    ``power`` two-dimensional spectrum, ``radial`` its mean over rings, ``profiles`` those along x and y, ``angular`` by
    direction, ``fit`` the fitted model. None where it is not defined.
    """

    power: PowerSpectrum | None
    radial: RadialSpectrum | None
    profiles: tuple[ProfileSpectrum | None, ProfileSpectrum | None]
    angular: AngularSpectrum | None
    fit: SpectralFit | None
    tip_cutoff: float


def measured_curves(surface: Surface, attempt: Attempts) -> Curves:
    """Functions of ``surface`` that need no spectrum; missing points are left out."""
    structure = attempt.along_axes("structure function", lambda axis: structure_function(surface, axis=axis))
    known = dict(zip("xy", structure, strict=True))
    scale = attempt.along_axes(
        "scale-dependent curvature", lambda axis: scale_dependence(surface, axis=axis, structure=known[axis])
    )
    return Curves(
        material_ratio=material_ratio_curve(surface),
        distribution=height_distribution(surface),
        autocovariance=autocovariance(surface),
        summits=summits(surface),
        structure=structure,
        scale=scale,
    )


def measured_spectra(
    surface: Surface, window: str, *, tip_radius: float | None, curves: Curves, attempt: Attempts
) -> SpectralCurves:
    """Spectra of the complete ``surface``, fitted above the length that a tip of ``tip_radius`` (m) resolves."""
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
    error = 0.0 if surface.periodic else _MODEL_ERROR
    return SpectralCurves(
        power,
        radial=radial_spectrum(power),
        profiles=profiles,
        angular=angular_spectrum(power),
        fit=attempt("fitted spectrum", lambda: fit_spectrum(power, reliable_wavelength=reliable, model_error=error)),
        tip_cutoff=cutoff,
    )


def completed(surface: Surface, fill: str | None, attempt: Attempts) -> Surface:
    """``surface`` with its missing points filled by the method ``fill``, for the spectra; as it is without one."""
    if fill is None or surface.n_missing == 0:
        return surface
    complete = filled(surface, fill)
    step = complete.origin.history[-1]
    attempt.remarks.append(f"For the spectra alone the surface was {step}; all other numbers leave these points out.")
    return complete
