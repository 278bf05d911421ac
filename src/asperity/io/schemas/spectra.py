"""Spectra, autocorrelations and distributions of heights of random surfaces."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings
from ...core.values import Fraction, Hurst, Length, NonNegativeLength, Positive, Psd, Real
from .base import FileSurface

AMPLITUDES = ("rms_height", "rms_slope", "plateau")
"""Keys of which a spectrum has exactly one."""


class _Amplitude(Settings):
    """Exactly one amplitude: an rms height, an rms slope or the plateau of the spectrum."""

    rms_height: Length | None = None
    rms_slope: Positive | None = None
    plateau: Psd | None = None

    @model_validator(mode="after")
    def _one_amplitude(self) -> _Amplitude:
        given = [key for key in AMPLITUDES if getattr(self, key) is not None]
        if len(given) != 1:
            raise InputError(
                f" must give exactly one of {', '.join(AMPLITUDES)}, but gives {' and '.join(given) or 'none'}."
            )
        return self


class ExponentialSpectrum(Settings):
    """Exponential autocorrelation; at ``correlation_length`` it has dropped to ``drop`` (0.1 unless said otherwise)."""

    kind: Literal["exponential"]
    rms_height: Length
    correlation_length: Length
    correlation_length_y: Length | None = None
    drop: Fraction = 0.1


class GaussianSpectrum(Settings):
    """Gaussian autocorrelation, of a smooth surface; lengths as for the exponential one."""

    kind: Literal["gaussian"]
    rms_height: Length
    correlation_length: Length
    correlation_length_y: Length | None = None
    drop: Fraction = 0.1


class SelfAffineSpectrum(_Amplitude):
    """Plateau and power law; a shortest wavelength of 0 keeps all waves of the grid."""

    kind: Literal["self_affine"]
    hurst: Hurst
    rolloff_wavelength: Length
    shortest_wavelength: NonNegativeLength
    longest_wavelength: Length | None = None


class TwoSlopesSpectrum(_Amplitude):
    """Plateau and two power laws q^-a, with ``exponents`` [a1, a2] above and below the ``crossover_wavelength``."""

    kind: Literal["two_slopes"]
    exponents: tuple[Positive, Positive]
    rolloff_wavelength: Length
    crossover_wavelength: Length
    shortest_wavelength: NonNegativeLength | None = None
    longest_wavelength: Length | None = None


class TableSpectrum(Settings):
    """Isotropic spectrum C at some ``wavelengths``, in descending order; straight in between on logarithmic scales."""

    kind: Literal["table"]
    wavelengths: tuple[Length, ...]
    psd: tuple[Psd, ...]


class MeasuredSpectrum(Settings):
    """Spectrum of the ``surface`` in a file, which should be levelled and filled; a ``floor`` of noise is subtracted."""

    kind: Literal["measured"]
    surface: FileSurface
    isotropic: bool = True
    floor: Psd | None = None


SpectrumTable: TypeAlias = Annotated[
    ExponentialSpectrum | GaussianSpectrum | SelfAffineSpectrum | TwoSlopesSpectrum | TableSpectrum | MeasuredSpectrum,
    Field(discriminator="kind"),
]
"""One spectrum, told apart by the key ``kind``."""


class MomentsHeights(Settings):
    """Heights of given skewness and kurtosis (3 for Gaussian heights), of Johnson's or Pearson's system."""

    kind: Literal["moments"]
    skewness: Real = 0.0
    kurtosis: Positive = 3.0
    system: Literal["johnson", "pearson"] = "johnson"


class MeasuredHeights(Settings):
    """Heights distributed as those of the ``surface`` in a file, which should be levelled."""

    kind: Literal["measured"]
    surface: FileSurface


class TwoLevelsHeights(Settings):
    """Two Gaussian levels: the upper one on a ``share`` of the area, widths and distance in deviations of the lower."""

    kind: Literal["two_levels"]
    share: Fraction
    separation: Positive
    upper_deviation: Positive = 1.0


HeightsTable: TypeAlias = Annotated[MomentsHeights | MeasuredHeights | TwoLevelsHeights, Field(discriminator="kind")]
"""One distribution of heights, told apart by the key ``kind``."""
