"""Cropping, slicing, resampling, and making a surface periodic."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.scipy_parts import interpolate
from ...core.spectral import RealTransform
from ...core.status import require_memory
from ...core.units import show
from ...core.values import Length, LengthRange, Number, Points
from ..surface import Surface, lines_too, maps_only
from .level import recorded, require_complete

# Cropping.


@lines_too
@checked
def cropped(
    surface: Surface,
    *,
    x: Annotated[LengthRange | None, "part to keep along x, from the corner"] = None,
    y: Annotated[LengthRange | None, "part to keep along y, from the corner"] = None,
) -> Surface:
    """Part of the surface between ``x`` = (x0, x1) and ``y`` = (y0, y1) in m from its corner,
    rounded to whole pixels.

    An omitted range keeps the full side. Pixel i covers i·dx to (i+1)·dx, so the size of the result
    is x1 - x0 to within one pixel. A cropped periodic surface is not periodic; level it again.
    Raises InputError if a range is reversed, empty after rounding, or reaches more than half a
    pixel outside the surface.
    """
    (first_x, last_x), (first_y, last_y) = _pixels(surface, x, 0), _pixels(surface, y, 1)
    if (last_x - first_x, last_y - first_y) == surface.shape:
        return surface
    heights = surface.heights[first_x:last_x, first_y:last_y]
    nx, ny = heights.shape
    step = f"cropped: x {show(first_x * surface.dx, 'm')} to {show(last_x * surface.dx, 'm')}"
    if surface.shape[1] > 1:
        step += f", y {show(first_y * surface.dy, 'm')} to {show(last_y * surface.dy, 'm')} ({nx} x {ny} points)"
    else:
        step += f" ({nx} points)"
    return Surface(heights, surface.dx, surface.dy, origin=surface.origin.continued(step))


def _pixels(surface: Surface, limits: tuple[float, float] | None, axis: int) -> tuple[int, int]:
    count, spacing, name = surface.shape[axis], surface.grid.spacing[axis], "xy"[axis]
    if limits is None:
        return 0, count
    start, end = require.two(limits, f"limits of the crop along {name}", "Write (start, end) in m.")
    low = require.finite(start, f"start of the crop along {name} (m)")
    high = require.finite(end, f"end of the crop along {name} (m)")
    first, last = round(low / spacing), round(high / spacing)
    if high <= low or last <= first:
        raise InputError(
            f"crop along {name} must end at least one pixel ({spacing:g} m) after its start, "
            f"but runs from {low:g} to {high:g} m."
        )
    if first < 0 or last > count:
        raise InputError(
            f"crop along {name} must lie within 0 and {count * spacing:g} m, but runs from {low:g} to {high:g} m."
        )
    return first, last


# One line of a map, for contacts in plane strain.


Position: TypeAlias = float | Literal["middle"]
"""Coordinate in m from the corner, or "middle"."""


@maps_only
@checked
def sliced(
    surface: Surface,
    *,
    x: Annotated[
        Position | None,
        Number("length", least=0.0, words=("middle",)),
        "position of the line across x, from the corner",
    ] = None,
    y: Annotated[
        Position | None,
        Number("length", least=0.0, words=("middle",)),
        "position of the line across y, from the corner",
    ] = None,
    length: Annotated[Length, "length along y that forces and areas belong to"] = 1.0,
) -> Surface:
    """One line of ``surface``, at ``y`` or at ``x``, as a surface (n, 1) along x.

    Raises InputError if none or both positions are given, the position lies outside the map, or the
    length is not positive.
    """
    if (x is None) == (y is None):
        raise InputError(f"line of a map must be given by exactly one of x and y, but is given by x={x!r}, y={y!r}.")
    axis = 0 if y is None else 1
    position = x if y is None else y
    count, spacing, name = surface.shape[axis], surface.grid.spacing[axis], "xy"[axis]
    place = float(count // 2 * spacing if position == "middle" else position or 0.0)
    if not 0.0 <= place <= count * spacing * (1.0 + 1e-9):
        raise InputError(
            f"{name} of a line must lie on the map, between 0 and {show(count * spacing, 'm')}, but is "
            f"{show(place, 'm')}."
        )
    number = count // 2 if position == "middle" else min(int(place / spacing), count - 1)
    heights = np.take(surface.heights, number, axis=axis)[:, None]
    step = f"sliced: line at {name} = {show((number + 0.5) * spacing, 'm')} ({heights.size} points)"
    return Surface(
        heights,
        surface.grid.spacing[1 - axis],
        length,
        periodic=surface.periodic,
        origin=surface.origin.continued(step),
    )


# Resampling at constant physical size.


@lines_too
@checked
def resampled(
    surface: Surface, points: Annotated[Points, "new numbers of points along x and y; (n, 1) of a line scan"]
) -> Surface:
    """Surface of the same physical size on ``points`` = (nx, ny) points; the pixel size changes
    accordingly.

    A periodic surface is resampled in Fourier space: zeros are added, or short waves removed (node
    0 stays in place, the Nyquist lines of even sizes are split in halves). Any other surface is
    interpolated by a bicubic spline along an axis that becomes finer and averaged over pixel areas
    along an axis that becomes coarser (pixel areas stay in place). Removing short waves and
    averaging both reduce the rms height; neither aliases. Raises InputError if a number of points
    is not a whole number >= 1 or points are missing.
    """
    nx, ny = points
    require_complete(surface, "resampled")
    if (nx, ny) == surface.shape:
        return surface
    needed = 3.0 * 8.0 * nx * ny  # heights and two arrays to make them
    require_memory(needed, "points of the resampled surface", f"{nx} x {ny}", "resample to fewer points ({resample})")
    heights: RealArray = surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        how = "in Fourier space"
        spectrum = RealTransform(surface.shape).forward(heights)
        old_x, old_y = surface.shape
        if ny != old_y:  # a half spectrum
            result = np.zeros((old_x, ny // 2 + 1), dtype=complex)
            kept = min(spectrum.shape[1], result.shape[1])
            result[:, :kept] = spectrum[:, :kept]
            half = min(old_y, ny) // 2
            if min(old_y, ny) % 2 == 0 and ny > old_y:
                result[:, half] *= 0.5
            elif min(old_y, ny) % 2 == 0:
                line = spectrum[:, half]
                result[:, half] = line + np.conj(np.roll(line[::-1], 1))  # both signs of the new Nyquist wavenumber
            spectrum = result
        if nx != old_x:  # all signs of the wavenumber
            kept = min(old_x, nx)
            positive, negative, half = (kept + 1) // 2, (kept - 1) // 2, kept // 2
            result = np.zeros((nx, spectrum.shape[1]), dtype=complex)
            result[:positive] = spectrum[:positive]
            if negative:
                result[-negative:] = spectrum[-negative:]
            if kept % 2 == 0 and nx > old_x:
                result[half] = result[-half] = 0.5 * spectrum[half]
            elif kept % 2 == 0:
                result[half] = spectrum[half] + spectrum[-half]
            spectrum = result
        heights = RealTransform((nx, ny)).backward(spectrum * (nx * ny / heights.size))
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


def _axis_resampled(heights: RealArray, new: int) -> RealArray:
    """Heights at ``new`` points of axis 0: means over equal intervals, from the cumulative integral
    of the pixel values, or a spline."""
    old = heights.shape[0]
    if new == old:
        return heights
    if new < old:
        integral = np.concatenate([np.zeros((1, heights.shape[1])), np.cumsum(heights, axis=0)])
        edges = np.arange(new + 1) * (old / new)
        whole = np.minimum(edges.astype(int), old - 1)
        at_edges = integral[whole] + (edges - whole)[:, None] * heights[whole]
        return np.asarray(np.diff(at_edges, axis=0) * (new / old))
    if old == 1:
        return np.repeat(heights, new, axis=0)
    centres = (np.arange(new) + 0.5) * (old / new) - 0.5  # pixel centres in units of the old pixel
    spline = interpolate.make_interp_spline(np.arange(old, dtype=float), heights, k=3 if old > 3 else 1)
    return spline(centres)


# Periodic surfaces by a taper at the borders or by removal of the smooth component.


@lines_too
@checked
def tapered(
    surface: Surface,
    width: Annotated[
        float, Number(above=0.0, most=0.5), "width of the tapered strip at each border as a fraction of the side"
    ] = 0.1,
) -> Surface:
    """Periodic surface whose heights are tapered to their mean at the borders (cosine or Tukey
    taper).

    Raises InputError if the width is out of range or points are missing.
    """
    require_complete(surface, "tapered")
    heights = surface.heights.astype(np.float64, copy=False)
    mean = float(heights.mean())
    places = [(np.arange(n) + 0.5) / n for n in surface.shape]
    nearest = [np.minimum(place, 1.0 - place) / width for place in places]
    weight_x, weight_y = (np.sin(0.5 * np.pi * np.minimum(share, 1.0)) ** 2 for share in nearest)
    result = mean + weight_x[:, None] * weight_y[None, :] * (heights - mean)
    step = f"tapered: cosine over {width:g} of the side at each border"
    return recorded(surface, result, step, periodic=True)


@lines_too
def periodised(surface: Surface) -> Surface:
    """Periodic surface: the surface less the smooth component that contains the jumps between
    opposite borders.

    The smooth component s solves the discrete periodic equation ∇²s = v, where v is zero inside the
    map and holds the jumps at its borders, so that the discrete Laplacian of all interior points
    and the mean height are preserved. A periodic surface is returned unchanged. Source: Moisan
    (2011), eqs. 11-14, here with the weights 1/dx² and 1/dy². Raises InputError if points are
    missing.
    """
    if surface.periodic:
        return surface
    require_complete(surface, "periodised")
    heights = surface.heights.astype(np.float64, copy=False)
    (nx, ny), smallest = heights.shape, min(surface.grid.spacing)
    weight_x, weight_y = ((smallest / step) ** 2 for step in surface.grid.spacing)
    jumps = np.zeros_like(heights)
    jump_x, jump_y = weight_x * (heights[-1] - heights[0]), weight_y * (heights[:, -1] - heights[:, 0])
    jumps[0] += jump_x
    jumps[-1] -= jump_x
    jumps[:, 0] += jump_y
    jumps[:, -1] -= jump_y
    angle_x, angle_y = Grid((nx, ny), (1.0, 1.0)).wavevector()
    laplacian = -4.0 * (weight_x * np.sin(angle_x / 2.0) ** 2 + weight_y * np.sin(angle_y / 2.0) ** 2)
    laplacian[0, 0] = 1.0
    transform = RealTransform((nx, ny))
    spectrum = transform.forward(jumps) / laplacian
    spectrum[0, 0] = 0.0
    smooth = transform.backward(spectrum)
    text = f"periodised: smooth component (rms {show(float(smooth.std()), 'm', 3)}) removed"
    return recorded(surface, heights - smooth, text, periodic=True, citation_keys=("Moisan2011",))
