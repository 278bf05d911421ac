"""Change of the number of points at constant physical size."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.spectral import RealTransform
from ..surface import Surface
from .steps import require_complete


def resampled(surface: Surface, shape: tuple[int, int]) -> Surface:
    """Surface of the same physical size on ``shape`` = (nx, ny) points; the pixel size changes accordingly.

    A periodic surface is resampled in Fourier space: zeros are added, or short waves removed (node 0 stays in place,
    the Nyquist lines of even sizes are split in halves). Any other surface is interpolated by a bicubic spline along
    an axis that becomes finer and averaged over pixel areas along an axis that becomes coarser (pixel areas stay in
    place). Removing short waves and averaging both lower the rms height; neither folds short waves back.

    Raises
    ------
    InputError
        If a number of points is not a whole number >= 1 or points are missing.
    """
    pair = require.two(shape, "shape of a resampled surface", "Write (nx, ny).")
    nx, ny = (require.integer(n, 1, f"number of points along {axis}") for n, axis in zip(pair, "xy", strict=True))
    require_complete(surface, "resampled")
    if (nx, ny) == surface.shape:
        return surface
    heights: RealArray = surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        how = "in Fourier space"
        heights = _fourier_resampled(heights, (nx, ny))
    else:
        how = ", ".join(
            f"{axis} by {'bicubic spline' if new > old else 'area averaging'}"
            for axis, new, old in zip("xy", (nx, ny), surface.shape, strict=True)
            if new != old
        )
        heights = _axis_resampled(_axis_resampled(heights, nx).T, ny).T
    step = f"resampled: {surface.shape[0]} x {surface.shape[1]} -> {nx} x {ny} points, {how}"
    size_x, size_y = surface.size
    return Surface(heights, size_x / nx, size_y / ny, periodic=surface.periodic, origin=surface.origin.continued(step))


def _fourier_resampled(heights: RealArray, shape: tuple[int, int]) -> RealArray:
    old = (heights.shape[0], heights.shape[1])
    spectrum = RealTransform(old).forward(heights)
    spectrum = _resized_half_axis(spectrum, old[1], shape[1])
    spectrum = _resized_full_axis(spectrum, shape[0])
    return RealTransform(shape).backward(spectrum * (shape[0] * shape[1] / heights.size))


def _resized_full_axis(spectrum: ComplexArray, new: int) -> ComplexArray:
    """Spectrum with ``new`` modes along axis 0 (all signs of the wavenumber)."""
    old, kept = spectrum.shape[0], min(spectrum.shape[0], new)
    if new == old:
        return spectrum
    positive, negative = (kept + 1) // 2, (kept - 1) // 2
    result = np.zeros((new, spectrum.shape[1]), dtype=complex)
    result[:positive] = spectrum[:positive]
    if negative:
        result[-negative:] = spectrum[-negative:]
    if kept % 2 == 0:
        half = kept // 2
        if new > old:
            result[half] = result[-half] = 0.5 * spectrum[half]
        else:
            result[half] = spectrum[half] + spectrum[-half]
    return result


def _resized_half_axis(spectrum: ComplexArray, old: int, new: int) -> ComplexArray:
    """Half spectrum of ``old`` real points along axis 1 turned into that of ``new`` points."""
    if new == old:
        return spectrum
    result = np.zeros((spectrum.shape[0], new // 2 + 1), dtype=complex)
    kept = min(spectrum.shape[1], result.shape[1])
    result[:, :kept] = spectrum[:, :kept]
    half = min(old, new) // 2
    if min(old, new) % 2 == 0:
        if new > old:
            result[:, half] *= 0.5
        else:
            line = spectrum[:, half]
            result[:, half] = line + np.conj(np.roll(line[::-1], 1))  # both signs of the new Nyquist wavenumber
    return result


def _axis_resampled(heights: RealArray, new: int) -> RealArray:
    old = heights.shape[0]
    if new == old:
        return heights
    return _averaged(heights, new) if new < old else _interpolated(heights, new)


def _averaged(heights: RealArray, new: int) -> RealArray:
    """Mean over each of ``new`` equal intervals of axis 0, from the cumulative integral of the pixel values."""
    old = heights.shape[0]
    integral = np.concatenate([np.zeros((1, heights.shape[1])), np.cumsum(heights, axis=0)])
    edges = np.arange(new + 1) * (old / new)
    whole = np.minimum(edges.astype(int), old - 1)
    at_edges = integral[whole] + (edges - whole)[:, None] * heights[whole]
    averaged: RealArray = np.diff(at_edges, axis=0) * (new / old)
    return averaged


def _interpolated(heights: RealArray, new: int) -> RealArray:
    from scipy.interpolate import make_interp_spline

    old = heights.shape[0]
    if old == 1:
        return np.repeat(heights, new, axis=0)
    centres = (np.arange(new) + 0.5) * (old / new) - 0.5  # pixel centres in units of the old pixel
    spline = make_interp_spline(np.arange(old, dtype=float), heights, k=3 if old > 3 else 1)
    interpolated: RealArray = spline(centres)
    return interpolated
