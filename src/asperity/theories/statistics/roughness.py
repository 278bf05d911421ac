"""Roughness parameters that theories of rough contact use, in SI units.

``asperity.roughness_of`` measures them on a ``Surface``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled

T = TypeVar("T")


@dataclass(frozen=True)
class MomentTensor:
    """Mean products of derivatives of the height, m_ab = (1/4π²) ∫ q_x^a q_y^b C d²q.

    ``m20`` <h_x²>, ``m11`` <h_x h_y>, ``m02`` <h_y²>, dimensionless; ``m40`` <h_xx²>, ``m31``,
    ``m22`` <h_xx h_yy>, ``m13``, ``m04`` <h_yy²> in 1/m². The fourth moments are NaN where they are
    not known.
    """

    m20: float
    m11: float
    m02: float
    m40: float = math.nan
    m31: float = math.nan
    m22: float = math.nan
    m13: float = math.nan
    m04: float = math.nan

    @property
    def principal_slopes(self) -> tuple[float, float]:
        """Largest and smallest mean square slope of a profile over all directions."""
        half = math.hypot(0.5 * (self.m20 - self.m02), self.m11)
        mean = 0.5 * (self.m20 + self.m02)
        return mean + half, max(0.0, mean - half)


@dataclass(frozen=True)
class MomentCovariance:
    """Mean products of height (``m0``, m²), slope (``m2``) and second derivative (``m4``, 1/m²) of
    two surfaces that face each other, both positive toward the other body.

    Zero for surfaces that know nothing of each other, negative for run-in pairs, whose crests lie
    against valleys. Slopes and second derivatives are those of profiles, averaged over all
    directions.
    """

    m0: float = 0.0
    m2: float = 0.0
    m4: float = 0.0

    @classmethod
    def of(cls, first: Roughness, second: Roughness, together: Roughness) -> MomentCovariance:
        """From both surfaces and their sum, ``together``: half of what the moments of the sum are
        more than those of its parts."""
        parts = ("m0", "m2", "m4")
        return cls(*(0.5 * (getattr(together, m) - getattr(first, m) - getattr(second, m)) for m in parts))


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Radial power spectrum: ``psd`` (n,) in m⁴ at the wavenumbers ``q`` (n,), rising, in rad/m.

    In the convention of the library, m0 = (1/4π²) ∫ C d²q = (1/2π) ∫ q C dq (Jacobs, Junge &
    Pastewka 2017); spectra with m0 = ∫ C d²q are 4π² times smaller.
    """

    q: RealArray
    psd: RealArray

    def __post_init__(self) -> None:
        if self.q.ndim != 1 or self.q.shape != self.psd.shape or self.q.size < 2:
            raise InputError(
                f"spectrum must be two arrays of the same length of at least 2, but has shapes {self.q.shape} and "
                f"{self.psd.shape}."
            )
        if not (self.q[0] > 0.0 and np.all(np.diff(self.q) > 0.0)):
            raise InputError("wavenumbers of a spectrum (rad/m) must be positive and rising, but are not. Sort them.")


@dataclass(frozen=True, eq=False)
class SummitList:
    """The summits of one map.

    ``x``, ``y`` (n,) positions in m; ``height`` (n,) above the mean plane of the surface in m;
    ``curvature`` (n,) mean curvature in 1/m, positive; ``area`` of the map in m²; ``period`` (Lx,
    Ly) of a periodic map in m or None.
    """

    x: RealArray
    y: RealArray
    height: RealArray
    curvature: RealArray
    area: float
    period: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        shapes = {np.shape(values) for values in (self.x, self.y, self.height, self.curvature)}
        if len(shapes) != 1 or self.height.ndim != 1 or self.height.size == 0:
            raise InputError(
                f"summits must be four arrays of the same length of at least 1, but have shapes {sorted(shapes)}. "
                "A surface without summits has no asperity theory."
            )
        require.positive(self.area, "area of the map with the summits (m^2)")
        if not np.all(self.curvature > 0.0):
            raise InputError(
                f"curvatures of summits must be positive, but the smallest is {float(self.curvature.min()):g} 1/m."
            )

    @property
    def count(self) -> int:
        """Number of summits."""
        return int(self.height.size)

    @property
    def density(self) -> float:
        """Summits per area in 1/m²."""
        return self.count / self.area

    @property
    def radius(self) -> RealArray:
        """(n,) radii of curvature R = 1/κ in m."""
        return 1.0 / self.curvature

    @property
    def mean_radius(self) -> float:
        """1/<κ> in m."""
        return 1.0 / float(self.curvature.mean())

    @property
    def mean_height(self) -> float:
        """Mean height above the mean plane of the surface in m."""
        return float(self.height.mean())

    @property
    def height_deviation(self) -> float:
        """Standard deviation σ_s of the heights in m."""
        return float(self.height.std())

    @property
    def height_skewness(self) -> float:
        """Skewness of the heights; NaN if all are equal."""
        return _standardised_moment(self.height, 3)

    @property
    def height_kurtosis(self) -> float:
        """Kurtosis of the heights, 3 for a Gaussian; NaN if all are equal."""
        return _standardised_moment(self.height, 4)


@dataclass(frozen=True)
class SummitNumbers:
    """What theories of summits need of them where the summits themselves are not known, as of the
    surface of a line scan.

    ``density`` (1/m²), ``mean_radius`` 1/<κ> (m), ``mean_height`` above the mean plane and
    ``height_deviation`` σ_s (m), all positive; skewness and kurtosis of the heights, by default
    those of a Gaussian.
    """

    density: float
    mean_radius: float
    mean_height: float
    height_deviation: float
    height_skewness: float = 0.0
    height_kurtosis: float = 3.0

    def __post_init__(self) -> None:
        for name, unit in (("density", "1/m^2"), ("mean_radius", "m"), ("mean_height", "m"), ("height_deviation", "m")):
            require.positive(getattr(self, name), f"{name.replace('_', ' ')} of summits ({unit})")


@dataclass(frozen=True)
class Fractal:
    """``dimension`` D of self-affine profiles, between 1 and 2, and their fractal ``roughness`` G
    in m.

    ``shortest`` and ``longest``: lengths in m between which the profiles were found to be so; NaN
    where not known.
    """

    dimension: float
    roughness: float
    shortest: float = math.nan
    longest: float = math.nan


@dataclass(frozen=True, eq=False, repr=False)
class Roughness(Tabled):
    """The numbers of a surface that theories of rough contact are built from. None stands for what
    is not known.

    InputError if a moment or the area is not positive.

    Parameters
    ----------
    m0, m2, m4
        Mean square height (m²), slope (dimensionless) and second derivative (1/m²) of a profile,
        averaged over all directions; positive. The rms gradient of the surface is sqrt(2 m2).
    area
        Nominal area in m².
    moments
        Moments by direction, for anisotropic theories.
    spectrum
        Radial power spectrum.
    summits
        Summits of the map.
    summit_numbers
        Numbers of the summits, where these themselves are not known.
    heights
        Samples (n,) of the height above the mean plane in m.
    fractal
        Fractal dimension and roughness, where the profiles are self-affine.
    correlation_length
        Lag in m at which the autocorrelation has fallen to 1/e; NaN where it does not. The lag of
        1/10 is longer, for an exponential autocorrelation by ln 10.
    skewness, kurtosis
        Of the surface heights; 0 and 3 for a Gaussian surface.
    assumption
        What is taken for granted, in words, where the numbers come from a line scan; empty for a
        map.
    """

    m0: float
    m2: float
    m4: float
    area: float = math.nan
    moments: MomentTensor | None = None
    spectrum: Spectrum | None = field(default=None, repr=False)
    summits: SummitList | None = field(default=None, repr=False)
    heights: RealArray | None = field(default=None, repr=False)
    skewness: float = 0.0
    kurtosis: float = 3.0
    fractal: Fractal | None = None
    correlation_length: float = math.nan
    assumption: str = field(default="", repr=False)
    summit_numbers: SummitNumbers | None = None

    def __post_init__(self) -> None:
        fix = "A flat surface has no roughness theory."
        require.positive(self.m0, "moment m0 (m^2)", fix)
        require.positive(self.m2, "moment m2", fix)
        require.positive(self.m4, "moment m4 (1/m^2)", fix)
        if not math.isnan(self.area):
            require.positive(self.area, "nominal area (m^2)")

    def paired(self, other: Roughness, covariance: MomentCovariance = MomentCovariance()) -> Roughness:
        """Roughness of the sum of this surface and the ``other``, against which a plane stands for
        both: m = m_1 + m_2 + 2 c of each moment (Bhushan 1998, sec. 3.2).

        It holds the moments, and the area of this surface. InputError if a moment of the sum is not
        positive.
        """
        return Roughness(
            self.m0 + other.m0 + 2.0 * covariance.m0,
            self.m2 + other.m2 + 2.0 * covariance.m2,
            self.m4 + other.m4 + 2.0 * covariance.m4,
            area=self.area,
        )

    @property
    def alpha(self) -> float:
        """Nayak's bandwidth parameter m0 m4/m2²."""
        return self.m0 * self.m4 / self.m2**2

    @property
    def rms_height(self) -> float:
        """sqrt(m0) in m."""
        return math.sqrt(self.m0)

    @property
    def rms_gradient(self) -> float:
        """sqrt(<|∇h|²>) = sqrt(2 m2)."""
        return math.sqrt(2.0 * self.m2)

    @property
    def anisotropy(self) -> float | None:
        """Ratio of the principal mean square slopes, from 1 on; None if moments by direction are
        not known."""
        if self.moments is None:
            return None
        steep, gentle = self.moments.principal_slopes
        return steep / gentle if gentle > 0.0 else math.inf

    def of_summits(self, theory: str) -> SummitList | SummitNumbers:
        """The summits, or else their numbers; InputError that the ``theory`` needs them if neither
        is known."""
        return self.known(self.summit_numbers, "its summits", theory) if self.summits is None else self.summits

    def known(self, part: T | None, what: str, theory: str) -> T:
        """``part`` of this value; InputError with ``what`` the ``theory`` needs if it is None."""
        if part is None:
            raise InputError(
                f"roughness for the theory {theory} must hold {what}, but does not. "
                "Measure it with asperity.roughness_of on a map that has it, or give it to Roughness."
            )
        return part


def _standardised_moment(values: RealArray, order: int) -> float:
    deviation = values.std()
    return float(np.mean(((values - values.mean()) / deviation) ** order)) if deviation > 0.0 else math.nan
