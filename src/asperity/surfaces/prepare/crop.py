"""Cropping to a rectangle."""

from __future__ import annotations

from ...core import require
from ...core.errors import InputError
from ...core.units import show
from ..surface import Surface


def cropped(surface: Surface, *, x: tuple[float, float] | None = None, y: tuple[float, float] | None = None) -> Surface:
    """Part of the surface between ``x`` = (x0, x1) and ``y`` = (y0, y1) in m from its corner, rounded to whole pixels.

    An omitted range keeps the full side. Pixel i covers i·dx to (i+1)·dx, so the size of the result is x1 - x0 to
    within one pixel. A cropped periodic surface is no longer periodic and needs new levelling.

    Raises
    ------
    InputError
        If a range is reversed, empty after rounding, or reaches more than half a pixel outside the surface.
    """
    (first_x, last_x), (first_y, last_y) = _pixels(surface, x, 0), _pixels(surface, y, 1)
    if (last_x - first_x, last_y - first_y) == surface.shape:
        return surface
    heights = surface.heights[first_x:last_x, first_y:last_y]
    nx, ny = heights.shape
    step = (
        f"cropped: x {show(first_x * surface.dx, 'm')} to {show(last_x * surface.dx, 'm')}, "
        f"y {show(first_y * surface.dy, 'm')} to {show(last_y * surface.dy, 'm')} ({nx} x {ny} points)"
    )
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
