"""Spatial parameters of ISO 25178-2: autocorrelation lengths and direction of the texture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.units import show
from .correlation import DROP_ISO, Autocovariance
from .spectrum import PowerSpectrum

_TIE = (
    1e-9  # a mode on the border of two sectors, or on the Nyquist circle, belongs to the same one whatever the rounding
)
_RAY_STEPS = 2  # samples per pixel along a ray
_BLOCK = 1 << 20  # samples taken at once
_SHARE = 0.5  # of a ray, half the map: autocorrelations about the mean of a map fall too early beyond


@dataclass(frozen=True)
class TextureLengths:
    """``Sal`` shortest distance in m at which R/R(0) drops to 0.2, ``Str`` = Sal/longest such
    distance (0 to 1).

    ``Sal_direction``, ``longest_direction`` are the angles of both in rad from +x towards +y, in
    [0, π). Rays end at the border of half the map. Sal is NaN where a ray without a drop ends
    before the shortest drop that was found, Str where any ray has none; the other direction is then
    the one that reaches farthest. ``Sal_least`` and ``Str_most`` are bounds that hold all the same,
    equal to Sal and Str where these are known. ``farthest_share``: the longest distance over the
    length of its ray; R is about the mean of the map, which makes it fall too early near one. All
    are NaN for a flat map, Str and its bound for a profile.
    """

    Sal: float
    Str: float
    Sal_direction: float
    longest_direction: float
    Sal_least: float
    Str_most: float
    farthest_share: float


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
    if 0 in centre.range:  # a profile
        angles = np.array([0.0 if k_max else 0.5 * math.pi])
    cosines, sines = np.cos(angles), np.sin(angles)
    cosines[np.abs(cosines) < 1e-15] = 0.0  # along y
    lengths = _first_drops(centre, drop * centre.mean_square, cosines, sines)
    if autocovariance.mean_square == 0.0:
        return TextureLengths(*[math.nan] * 7)
    found = np.isfinite(lengths)
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.fmin(k_max * centre.spacing[0] / np.abs(cosines), l_max * centre.spacing[1] / np.abs(sines))
    # a ray without a drop decays beyond its end
    least = np.where(found, lengths, reach)
    longest = int(np.argmax(least))
    least_Sal, farthest = float(least.min()), float(least[longest])
    if not found.any():
        most = 1.0 if angles.size > 1 else math.nan
        return TextureLengths(math.nan, math.nan, math.nan, float(angles[longest]), least_Sal, most, math.nan)
    shortest = int(np.nanargmin(lengths))
    shown = float(lengths[shortest])
    Sal = shown if shown <= least_Sal else math.nan
    most = shown / farthest if angles.size > 1 else math.nan
    return TextureLengths(
        Sal,
        most if found.all() else math.nan,
        float(angles[shortest]),
        float(angles[longest]),
        least_Sal,
        float(np.minimum(1.0, most)),
        farthest / float(reach[longest]),
    )


def _first_drops(centre: Autocovariance, level: float, cosines: RealArray, sines: RealArray) -> RealArray:
    """Distance in m at which R first falls to ``level`` along each ray; NaN where it does not
    before the border."""
    k_max, l_max = centre.range
    farthest = math.hypot(*(k * d for k, d in zip(centre.range, centre.spacing, strict=True)))
    step = min(centre.spacing) / _RAY_STEPS
    distances = step * np.arange(int(farthest / step) + 2)
    lengths = np.full(cosines.size, np.nan)
    open_rays = np.arange(cosines.size)
    block = max(2, _BLOCK // cosines.size)
    for start in range(0, distances.size - 1, block - 1):
        part = distances[start : start + block]
        # R by bilinear interpolation, NaN outside the range
        x, y = cosines[open_rays][:, None] * part, sines[open_rays][:, None] * part
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
    return lengths


def doubts_of_texture(lengths: TextureLengths, *, periodic: bool) -> list[str]:
    """Why Sal or Str of a map is not known or is only a bound, a sentence for each; empty where
    both are."""
    if math.isnan(lengths.Sal_least):
        return ["No autocorrelation length and no texture aspect ratio: the map is flat."]
    if math.isnan(lengths.Str_most):
        return ["No texture aspect ratio Str: a profile has one direction."]
    direction, found = f"{math.degrees(lengths.longest_direction):.0f}°", []
    if math.isnan(lengths.Sal):
        found.append(
            "No autocorrelation length Sal: a direction along which the autocorrelation does not fall to 0.2 within "
            f"half the map ends first; Sal is at least {show(lengths.Sal_least, 'm', 3)}. Use a larger map."
        )
    if math.isnan(lengths.Str):
        found.append(
            f"No texture aspect ratio Str: the autocorrelation does not fall to 0.2 along {direction} within half the "
            f"map; Str is at most {lengths.Str_most:.3g}. Use a longer map along it."
        )
    elif not periodic and lengths.farthest_share > _SHARE:
        found.append(
            f"Texture aspect ratio Str is an upper bound: along {direction} the autocorrelation falls to 0.2 beyond a "
            "quarter of the map, where it does so too early, since it is taken about the mean of the map. "
            "Use a longer map along it."
        )
    return found


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
