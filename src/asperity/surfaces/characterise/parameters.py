"""The groups of numbers that make up the characterisation of a surface."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, TypeVar

from .moments import DifferenceMoments, SpectralMoments
from .spectral_fit import SpectralFit
from .summits import SummitStatistics

T = TypeVar("T")

_NAN = math.nan


@dataclass(frozen=True)
class SpatialParameters:
    """Lengths over which heights are correlated (m) and directions of the texture (rad from +x towards +y, [0, π)).

    ``Sal``, ``Str``, ``Std`` of ISO 25178-2; ``lay`` across the steepest axis of the slope tensor, which is less
    sensitive to noise than Std; ``beta_e_x``, ``beta_e_y`` distance of R/R(0) = 1/e and ``beta_01_x``, ``beta_01_y``
    (β*) of 0.1 along the axes. NaN where the correlation does not fall that far inside the map.
    """

    Sal: float
    Str: float
    Std: float
    lay: float
    beta_e_x: float
    beta_e_y: float
    beta_01_x: float
    beta_01_y: float


@dataclass(frozen=True)
class HybridParameters:
    """``Sdq`` rms gradient, ``Sdr`` developed area less one (both dimensionless), ``Ssc`` mean summit curvature (1/m)."""

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
    """Summit statistics by both definitions: above 8 neighbours (``eight``, the one to use) and above 4 (``four``)."""

    eight: SummitStatistics
    four: SummitStatistics


@dataclass(frozen=True)
class SpectralParameters:
    """Fitted form of the spectrum; relative standard errors (``*_error``) but for exponents, whose are absolute.

    ``exponent_1``, ``exponent_2`` of C ~ q^-a; ``hurst`` = (a1 - 2)/2 where that is a Hurst exponent, between 0 and 1 to
    two standard errors; ``plateau`` C0 (m⁴) and ``rolloff_wavelength``
    (m), NaN if the scan shows no roll-off; ``crossover_wavelength`` (m) between two power laws; ``floor`` (m⁴) of white
    noise; ``short_cutoff`` wavelength (m) at which the spectrum ends. NaN for what the spectrum does not have.
    """

    hurst: float = _NAN
    hurst_error: float = _NAN
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
    """How far the map speaks for the surface, if its heights are Gaussian.

    ``effective_samples`` number of independent heights; ``Sq_error`` relative scatter of Sq from map to map,
    1/sqrt(2 N_eff); ``tip_cutoff`` length (m) below which the tip may have shaped the map, NaN if no tip was given.
    """

    effective_samples: float
    Sq_error: float
    tip_cutoff: float


def spectral_parameters(fit: SpectralFit) -> SpectralParameters:
    """The numbers of ``fit``."""
    model, errors = fit.model, fit.errors
    two = len(model.exponents) == 2
    self_affine = 0.0 < model.hurst[0] <= 1.0 + 2.0 * fit.hurst_error
    return SpectralParameters(
        hurst=model.hurst[0] if self_affine else _NAN,
        hurst_error=fit.hurst_error if self_affine else _NAN,
        exponent_1=model.exponents[0],
        exponent_1_error=errors["exponent_1"],
        exponent_2=model.exponents[1] if two else _NAN,
        exponent_2_error=errors.get("exponent_2", _NAN),
        plateau=model.level if model.has_plateau else _NAN,
        plateau_error=errors["level"] if model.has_plateau else _NAN,
        rolloff_wavelength=model.rolloff_wavelength if model.has_plateau else _NAN,
        rolloff_error=errors.get("rolloff_wavelength", _NAN),
        crossover_wavelength=model.crossover_wavelength,
        crossover_error=errors.get("crossover_wavelength", _NAN),
        floor=model.floor if "floor" in errors else _NAN,
        floor_error=errors.get("floor", _NAN),
        short_cutoff=fit.short_cutoff,
    )


def undefined(kind: type[T], **known: Any) -> T:
    """Group of the dataclass ``kind`` with NaN for all that is not ``known``."""
    return kind(**{item.name: known.get(item.name, _NAN) for item in fields(kind)})  # type: ignore[arg-type]
