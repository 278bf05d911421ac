"""Spatial parameters of ISO 25178-2: autocorrelation lengths and direction of the texture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from .correlation import DROP_ISO, Autocovariance
from .spectrum import PowerSpectrum

_TIE = (
    1e-9  # a mode on the border of two sectors, or on the Nyquist circle, belongs to the same one whatever the rounding
)
_RAY_STEPS = 2  # samples per pixel along a ray
_BLOCK = 1 << 20  # samples taken at once


@dataclass(frozen=True)
class TextureLengths:
    """``Sal`` shortest distance in m at which R/R(0) drops to 0.2, ``Str`` = Sal/longest such
    distance (0 to 1).

    ``Sal_direction``, ``longest_direction`` are the angles of both in rad from +x towards +y, in
    [0, π). NaN where no direction decays inside the map, or (Str and the longest direction) where
    one does not.
    """

    Sal: float
    Str: float
    Sal_direction: float
    longest_direction: float


@dataclass(frozen=True, eq=False)
class AngularSpectrum:
    """Share of the mean square height by the direction of its waves.

    ``angle`` of the middle of the sectors in rad from +x towards +y, in [0, π); ``density`` per
    rad, whose integral over [0, π) is one (NaN for a flat map).
    """

    angle: RealArray
    density: RealArray

    @property
    def peak(self) -> float:
        """Std: direction in rad, [0, π), of the strongest waves; the lay is perpendicular to it.
        NaN for a flat map."""
        return math.nan if np.isnan(self.density).any() else float(self.angle[int(np.argmax(self.density))])


def texture_lengths(autocovariance: Autocovariance, drop: float = DROP_ISO) -> TextureLengths:
    """Sal and Str (ISO 25178-2, 4.3.1 and 4.3.2) from the first falls to ``drop`` R(0) along rays,
    one per degree.

    Rays end at half the map; R is interpolated bilinearly, in blocks of distances from the origin
    up to the last crossing. Raises InputError if ``drop`` is not between 0 and 1.
    """
    require.between(drop, 0.0, 1.0, "drop that defines a correlation length")
    half = tuple(
        max(1, round(0.5 * side / d)) for side, d in zip(autocovariance.size, autocovariance.spacing, strict=True)
    )
    centre = autocovariance.within((half[0], half[1]))
    k_max, l_max = centre.range
    angles = np.deg2rad(np.arange(180.0))
    farthest = math.hypot(*(k * d for k, d in zip(centre.range, centre.spacing, strict=True)))
    step = min(centre.spacing) / _RAY_STEPS
    distances = step * np.arange(int(farthest / step) + 2)
    lengths = np.full(angles.size, np.nan)
    open_rays = np.arange(angles.size)
    level, block = drop * centre.mean_square, max(2, _BLOCK // angles.size)
    for start in range(0, distances.size - 1, block - 1):
        part = distances[start : start + block]
        # R by bilinear interpolation, NaN outside the range
        x, y = np.cos(angles[open_rays])[:, None] * part, np.sin(angles[open_rays])[:, None] * part
        flip = np.where(x < 0.0, -1.0, 1.0)  # R(-r) = R(r)
        row, column = flip * x / centre.spacing[0], flip * y / centre.spacing[1] + l_max
        outside = (row > k_max) | (column < 0.0) | (column > 2 * l_max)
        low_k = np.clip(np.floor(row).astype(int), 0, max(0, k_max - 1))
        low_l = np.clip(np.floor(column).astype(int), 0, max(0, 2 * l_max - 1))
        part_k, part_l = row - low_k, column - low_l
        next_k, next_l = np.minimum(low_k + 1, k_max), np.minimum(low_l + 1, 2 * l_max)
        lower = centre.values[low_k, low_l] * (1.0 - part_l) + centre.values[low_k, next_l] * part_l
        upper = centre.values[next_k, low_l] * (1.0 - part_l) + centre.values[next_k, next_l] * part_l
        values = np.where(outside, np.nan, lower * (1.0 - part_k) + upper * part_k)
        below = values <= level
        crossed = below.any(axis=1)
        after = np.maximum(below.argmax(axis=1), 1)[crossed]
        high, low = values[crossed, after - 1], values[crossed, after]
        share = np.divide(high - level, high - low, out=np.zeros_like(high), where=high > low)
        lengths[open_rays[crossed]] = part[after - 1] + share * (part[after] - part[after - 1])
        open_rays = open_rays[~crossed]
        if open_rays.size == 0:
            break
    found = np.isfinite(lengths)
    if not found.any() or autocovariance.mean_square == 0.0:
        return TextureLengths(math.nan, math.nan, math.nan, math.nan)
    shortest = int(np.nanargmin(lengths))
    Sal = float(lengths[shortest])
    if not found.all():
        return TextureLengths(Sal, math.nan, float(angles[shortest]), math.nan)
    longest = int(np.argmax(lengths))
    return TextureLengths(Sal, Sal / float(lengths[longest]), float(angles[shortest]), float(angles[longest]))


def angular_spectrum(spectrum: PowerSpectrum) -> AngularSpectrum:
    """Spectrum summed over sectors within the Nyquist circle, from the third mode of a windowed map
    on.

    Sectors hold at least two modes at the Nyquist circle and span at least one degree; the value of
    a sector is the mean over its modes, which removes the effect of the square lattice of modes.
    The angle of the largest density is Std (ISO 25178-2, 4.3.3), which is more sensitive to noise
    than the axis of the slope tensor.
    """
    qx, qy = spectrum.grid.wavevector()
    q = spectrum.grid.wavenumber()
    first = 0.0 if spectrum.window == "none" else 2.5 * 2.0 * np.pi / min(spectrum.grid.size)
    inside = (q > first) & (q <= spectrum.nyquist * (1.0 + _TIE))
    count = int(np.clip(np.pi * min(spectrum.grid.shape) / 4.0, 4, 180))
    angle = np.mod(np.arctan2(np.broadcast_to(qy, q.shape)[inside], np.broadcast_to(qx, q.shape)[inside]), np.pi)
    sector = np.minimum((angle * (count / np.pi) + 0.5 + _TIE).astype(int) % count, count - 1)
    power = np.bincount(sector, spectrum.psd[inside], count)
    modes = np.bincount(sector, minlength=count)
    density = power / np.maximum(modes, 1)
    total = density.sum() * np.pi / count
    middle = np.arange(count) * np.pi / count
    return AngularSpectrum(middle, density / total if total > 0.0 else np.full(count, np.nan))
