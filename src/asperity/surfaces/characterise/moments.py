"""Moments of the power spectrum, from finite differences of the heights or from the spectrum
itself.

m_ab = (1/4π²) ∫ q_x^a q_y^b C d²q is the covariance of derivatives of the height; m0, m2, m4
without a second index are the mean square height, slope and second derivative of a *profile* (Nayak
1971; McCool 1987).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.spectral import mode_sum
from ..surface import Surface, maps_only
from .heights import rms_height
from .slopes import (
    increments,
    mean_of,
    rms_laplacian,
    rms_profile_curvature,
    rms_profile_slope,
    second_differences,
)
from .spectrum import PowerSpectrum


@dataclass(frozen=True)
class SlopeTensor:
    """Mean products of the slopes: ``xx`` <h_x²>, ``xy`` <h_x h_y>, ``yy`` <h_y²>, dimensionless.

    Its principal axes describe the texture: profiles along ``direction`` are steepest, the lay is
    perpendicular to it.
    """

    xx: float
    xy: float
    yy: float

    @property
    def largest(self) -> float:
        """Mean square slope of profiles along ``direction``."""
        return 0.5 * (self.xx + self.yy) + math.hypot(0.5 * (self.xx - self.yy), self.xy)

    @property
    def smallest(self) -> float:
        """Mean square slope of profiles across ``direction``, along the lay."""
        return max(0.0, 0.5 * (self.xx + self.yy) - math.hypot(0.5 * (self.xx - self.yy), self.xy))

    @property
    def direction(self) -> float:
        """Angle in rad of the steepest profiles from +x towards +y, in (-π/2, π/2]."""
        return 0.5 * math.atan2(2.0 * self.xy, self.xx - self.yy)


@dataclass(frozen=True)
class DifferenceMoments:
    """Profile moments by finite differences along x and y.

    ``m0`` mean square height (m², normalised by N), ``m2_x``, ``m2_y`` mean square slope
    (dimensionless), ``m4_x``, ``m4_y`` mean square second derivative (1/m²), ``rms_laplacian`` in
    1/m, and the ``slope_tensor``.
    """

    m0: float
    m2_x: float
    m2_y: float
    m4_x: float
    m4_y: float
    rms_laplacian: float
    slope_tensor: SlopeTensor

    @property
    def m2(self) -> float:
        """Mean of both directions; meaningful if the surface is isotropic."""
        return 0.5 * (self.m2_x + self.m2_y)

    @property
    def m4(self) -> float:
        """Mean of both directions in 1/m²; meaningful if the surface is isotropic."""
        return 0.5 * (self.m4_x + self.m4_y)

    @property
    def alpha_x(self) -> float:
        """Nayak's parameter m0 m4/m2² of the profiles along x; NaN without slopes."""
        return nayak_parameter(self.m0, self.m2_x, self.m4_x)

    @property
    def alpha_y(self) -> float:
        """Nayak's parameter m0 m4/m2² of the profiles along y; NaN without slopes."""
        return nayak_parameter(self.m0, self.m2_y, self.m4_y)

    @property
    def alpha(self) -> float:
        """Nayak's parameter of the mean moments of both directions; NaN without slopes."""
        return nayak_parameter(self.m0, self.m2, self.m4)


@maps_only
def difference_moments(surface: Surface) -> DifferenceMoments:
    """Moments of ``surface`` by forward first and central second differences over all valid pairs
    and triples.

    A periodic surface wraps. Each derivative multiplies the spectrum by [sin(q d/2)/(q d/2)]²:
    waves shorter than about eight pixels are underestimated (McCool 1987). Raises InputError if
    there are no three valid neighbours along x or along y.
    """
    return DifferenceMoments(
        m0=rms_height(surface) ** 2,
        m2_x=rms_profile_slope(surface, axis="x") ** 2,
        m2_y=rms_profile_slope(surface, axis="y") ** 2,
        m4_x=rms_profile_curvature(surface, axis="x") ** 2,
        m4_y=rms_profile_curvature(surface, axis="y") ** 2,
        rms_laplacian=rms_laplacian(surface),
        slope_tensor=slope_tensor(surface),
    )


class MixedMoments(NamedTuple):
    """<h_xx h_xy>, <h_xx h_yy> and <h_yy h_xy> in 1/m²."""

    m31: float
    m22: float
    m13: float


@maps_only
def mixed_moments(surface: Surface) -> MixedMoments:
    """Mean products of the central second differences at the nodes where all exist.

    As of ``difference_moments`` short waves are underestimated. NaN where no node has all of its
    eight neighbours. Raises InputError for maps of fewer than three points along x or y.
    """
    xx, yy = (second_differences(surface, axis) for axis in "xy")
    along_y = increments(surface, (0, 2))
    if surface.periodic:
        along_y = np.roll(along_y, 1, axis=1)
        xy = np.roll(along_y, -1, axis=0) - np.roll(along_y, 1, axis=0)
    else:
        xx, yy, xy = xx[:, 1:-1], yy[1:-1], along_y[2:] - along_y[:-2]
    dx, dy = surface.dx, surface.dy
    pairs = ((xx, xy, 4.0 * dx**3 * dy), (xx, yy, dx**2 * dy**2), (yy, xy, 4.0 * dx * dy**3))
    there = ~np.isnan(xx + yy + xy)
    if not there.any():
        return MixedMoments(math.nan, math.nan, math.nan)
    return MixedMoments(*(float(np.mean(one[there] * other[there])) / unit for one, other, unit in pairs))


@maps_only
def slope_tensor(surface: Surface) -> SlopeTensor:
    """Mean products of the forward slopes at the nodes where both exist.

    Raises InputError if no node has both slopes.
    """
    along_x, along_y = increments(surface, (1, 0)) / surface.dx, increments(surface, (0, 1)) / surface.dy
    along_x, along_y = along_x[:, : along_y.shape[1]], along_y[: along_x.shape[0]]
    both = np.isnan(along_x) | np.isnan(along_y) if surface.n_missing else None
    if both is not None:
        along_x, along_y = along_x[~both], along_y[~both]
    products = (along_x * along_x, along_x * along_y, along_y * along_y)
    return SlopeTensor(*(mean_of(product, "slope") for product in products))


@dataclass(frozen=True)
class SpectralMoments:
    """Sums (1/A) Σ q_x^a q_y^b C over all modes of a spectrum: ``mab`` in m^(2-a-b).

    For odd powers the Nyquist component counts as zero, its sign being undefined.
    """

    m00: float
    m20: float
    m11: float
    m02: float
    m40: float
    m31: float
    m22: float
    m13: float
    m04: float

    @property
    def m0(self) -> float:
        """Mean square height in m²."""
        return self.m00

    @property
    def m2(self) -> float:
        """Mean square slope of a profile, averaged over all directions: (m20 + m02)/2."""
        return 0.5 * (self.m20 + self.m02)

    @property
    def m4(self) -> float:
        """Mean square second derivative of a profile in 1/m², averaged over all directions: 3/8
        <(∇²h)²>."""
        return 0.375 * self.rms_laplacian**2

    @property
    def alpha(self) -> float:
        """Nayak's parameter m0 m4/m2² >= 1.5; NaN without slopes."""
        return nayak_parameter(self.m0, self.m2, self.m4)

    @property
    def rms_gradient(self) -> float:
        """sqrt(<|∇h|²>), dimensionless."""
        return math.sqrt(self.m20 + self.m02)

    @property
    def rms_laplacian(self) -> float:
        """sqrt(<(∇²h)²>) in 1/m, twice the rms mean curvature."""
        return math.sqrt(self.m40 + 2.0 * self.m22 + self.m04)

    @property
    def slope_tensor(self) -> SlopeTensor:
        """Mean products of the slopes."""
        return SlopeTensor(self.m20, self.m11, self.m02)


def spectral_moments(spectrum: PowerSpectrum) -> SpectralMoments:
    """Moments of ``spectrum`` by summation over its modes.

    On a periodic surface these are the mean squares of the derivatives of its trigonometric
    interpolation. The window of a non-periodic one adds scatter and a share of about (2π σ/L)² to
    the mean square slope.
    """
    qx, qy = spectrum.grid.wavevector()
    odd_x, odd_y = spectrum.grid.wavevector(odd=True)
    values = []
    for power_x, power_y in ((0, 0), (2, 0), (1, 1), (0, 2), (4, 0), (3, 1), (2, 2), (1, 3), (0, 4)):
        factor_x = (odd_x if power_x % 2 else qx) ** power_x
        factor_y = (odd_y if power_y % 2 else qy) ** power_y
        # one row of sums over q_x: the matrix product does not write a field as large as the
        # spectrum
        values.append(mode_sum(spectrum.grid, (factor_x.ravel() @ spectrum.psd)[None, :] * factor_y))
    return SpectralMoments(*values)


def nayak_parameter(m0: float, m2: float, m4: float) -> float:
    """α = m0 m4/m2², at least 1.5 for an isotropic Gaussian surface and 1 for any profile; NaN for
    m2 = 0."""
    return m0 * m4 / m2**2 if m2 > 0.0 else math.nan
