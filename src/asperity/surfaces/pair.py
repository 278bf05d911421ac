"""Two surfaces as a pair: on one grid whatever their pixels, sizes, places and directions, and as
one composite surface."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.scipy_parts import interpolate
from ..core.spectral import RealTransform, thread_count
from ..core.units import show
from .prepare.extent import resampled
from .prepare.level import filled, require_complete
from .surface import Origin, Surface

# The largest rectangle along x and y in a convex polygon: where two maps overlap.


_CANDIDATES, _REFINEMENTS = 201, 6  # for each end of the rectangle, and how often the search is narrowed


def largest_rectangle(
    corners: RealArray, limits: tuple[float, float, float, float]
) -> tuple[float, float, float, float]:
    """Rectangle x0, x1, y0, y1 of the largest area within the convex polygon ``corners`` (n, 2) and
    the ``limits``.

    Between x0 and x1 the lower border of a convex polygon is highest and the upper one lowest at
    the ends, so two numbers are searched for: among all pairs of candidates, then more closely
    around the best pair.
    """
    low_x, high_x, low_y, high_y = limits
    own = corners[(corners[:, 0] > low_x) & (corners[:, 0] < high_x), 0]
    best, width = (low_x, high_x), high_x - low_x
    slack = _ROUNDING * np.ptp(corners[:, 0])
    for _ in range(_REFINEMENTS):
        near = np.concatenate([np.linspace(end - width, end + width, _CANDIDATES) for end in best])
        x = np.unique(np.concatenate([np.clip(near, low_x, high_x), own, [low_x, high_x]]))
        lower, upper = np.full(x.shape, np.inf), np.full(x.shape, -np.inf)  # borders y of the polygon
        for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            left, right = (start, end) if start[0] <= end[0] else (end, start)
            if right[0] - left[0] <= slack:
                continue
            on = (x >= left[0] - slack) & (x <= right[0] + slack)
            y = left[1] + (x[on] - left[0]) / (right[0] - left[0]) * (right[1] - left[1])
            lower[on], upper[on] = np.minimum(lower[on], y), np.maximum(upper[on], y)
        lower, upper = np.maximum(lower, low_y), np.minimum(upper, high_y)
        height = np.minimum(upper[:, None], upper[None, :]) - np.maximum(lower[:, None], lower[None, :])
        area = (x[None, :] - x[:, None]) * np.where(x[None, :] > x[:, None], np.maximum(height, 0.0), 0.0)
        i, j = np.unravel_index(int(area.argmax()), area.shape)
        best, width = (float(x[i]), float(x[j])), 4.0 * width / _CANDIDATES
    bottom, top = max(lower[i], lower[j]), min(upper[i], upper[j])
    return best[0], best[1], float(bottom), float(top)


_ROUNDING = 1e-9  # relative; lengths that differ by less are equal
_MARGIN = 12  # pixels around a periodic map, where the borders of a spline have decayed to 1e-7


@dataclass(frozen=True, eq=False)
class SurfacePair:
    """Two surfaces on one grid and in one lateral frame, each with heights positive out of its own
    body."""

    surface: Surface
    counter_surface: Surface

    def composite(self) -> Surface:
        """Sum of the two, which alone enters frictionless contact."""
        return composite(self.surface, self.counter_surface)


def on_common_grid(
    surface: Surface,
    counter_surface: Surface,
    *,
    shift: tuple[float, float] = (0.0, 0.0),
    angle: float = 0.0,
    mirrored: str | None = None,
    spacing: tuple[float, float] | None = None,
) -> SurfacePair:
    """Both surfaces resampled on one grid that covers where they overlap, in the frame of the
    first.

    The counter surface is turned over (see ``turned_over``), rotated about its middle by ``angle``,
    and laid so that its middle is ``shift`` away from the middle of ``surface``. Both are
    interpolated by bicubic splines at the nodes of the common grid; a node is missing where a
    neighbour of the map is. The overlap is the largest rectangle along x and y that both cover; a
    periodic surface covers everything. The pair is periodic if both are, with equal sizes, and
    without rotation.

    The relative place of two rough bodies is a free parameter of their contact: average over
    several shifts. Raises InputError if a value is not a number, the pixel is coarser than that of
    a map, or the overlap is less than two pixels wide.

    Parameters
    ----------
    surface, counter_surface
        Surfaces, each levelled beforehand.
    shift
        (along x, along y) in m.
    angle
        In rad, from +x towards +y.
    mirrored
        None, ``x`` or ``y``: how the counter surface is turned over.
    spacing
        Pixel (dx, dy) in m; the finer of both, along each axis, if omitted. A coarser one would
        fold short waves: filter or resample first.
    """
    shift_x, shift_y = (require.finite(s, f"shift along {a} (m)") for s, a in zip(shift, "xy", strict=True))
    angle = require.finite(angle, "angle of the counter surface (rad)")
    other = counter_surface if mirrored is None else turned_over(counter_surface, axis=mirrored)
    # a rotated map is as fine along x and y as its finer side is along either
    others = (other.dx, other.dy) if angle == 0.0 else (min(other.dx, other.dy),) * 2
    finest = pixel = (min(surface.dx, others[0]), min(surface.dy, others[1]))
    if spacing is not None:
        pair = require.two(spacing, "pixel of the common grid (m)", "Write (dx, dy).")
        dx, dy = (
            require.positive(d, f"pixel of the common grid along {a} (m)") for d, a in zip(pair, "xy", strict=True)
        )
        pixel = (dx, dy)
    for d, fine, name in zip(pixel, finest, "xy", strict=True):
        if d > fine * (1.0 + _ROUNDING):
            raise InputError(
                f"pixel of the common grid along {name} must not be coarser than the finer map ({fine:g} m), "
                f"but is {d:g} m. Filter or resample the surfaces first."
            )
    words = f", shift {show(shift_x, 'm')}, {show(shift_y, 'm')}, angle {math.degrees(angle):.6g}°"
    same_size = np.allclose(surface.size, other.size, rtol=_ROUNDING, atol=0.0)
    if surface.periodic and other.periodic and same_size and angle == 0.0:
        grid = _grid((0.0, surface.size[0], 0.0, surface.size[1]), pixel, fill=True)
        return SurfacePair(_moved(surface, (0.0, 0.0), grid, ""), _moved(other, (shift_x, shift_y), grid, words))
    # the largest rectangle x0, x1, y0, y1 (m) in the frame of the surface that both maps cover
    size_x, size_y = surface.size
    region = 0.0, size_x, 0.0, size_y
    if not other.periodic:
        half = 0.5 * np.array(other.size)
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * half @ turn.T
        corners += np.array([0.5 * size_x + shift_x, 0.5 * size_y + shift_y])
        if surface.periodic:
            region = -np.inf, np.inf, -np.inf, np.inf
        low_x, high_x = max(region[0], corners[:, 0].min()), min(region[1], corners[:, 0].max())
        covered = low_x < high_x
        region = largest_rectangle(corners, (low_x, high_x, *region[2:])) if covered else (0.0, 0.0, 0.0, 0.0)
    grid = _grid(region, pixel, fill=False)
    x = region[0] + (np.arange(grid.shape[0]) + 0.5)[:, None] * grid.spacing[0]
    y = region[2] + (np.arange(grid.shape[1]) + 0.5)[None, :] * grid.spacing[1]
    # the nodes in the frame of the counter surface, from its corner
    u, v = x - 0.5 * surface.size[0] - shift_x, y - 0.5 * surface.size[1] - shift_y
    along_u = math.cos(angle) * u + math.sin(angle) * v + 0.5 * other.size[0]
    along_v = -math.sin(angle) * u + math.cos(angle) * v + 0.5 * other.size[1]
    return SurfacePair(
        _interpolated(surface, grid, (x + 0.0 * y, y + 0.0 * x), ""),
        _interpolated(other, grid, (along_u, along_v), words),
    )


def _grid(region: tuple[float, float, float, float], pixel: tuple[float, float], *, fill: bool) -> Grid:
    """Grid on the ``region`` x0, x1, y0, y1: whole pixels, or with ``fill`` pixels that fill it."""
    shape, spacing = [], []
    for low, high, d, name in ((region[0], region[1], pixel[0], "x"), (region[2], region[3], pixel[1], "y")):
        ratio = (high - low) / d
        count = round(ratio) if abs(ratio - round(ratio)) < 1e-6 else (math.ceil(ratio) if fill else math.floor(ratio))
        if count < 2:
            raise InputError(
                f"surfaces must overlap by at least two pixels ({2.0 * d:g} m) along {name}, but overlap by "
                f"{max(0.0, high - low):g} m. Change shift or angle."
            )
        shape.append(count)
        spacing.append((high - low) / count if fill else d)
    return Grid((shape[0], shape[1]), (spacing[0], spacing[1]))


def _moved(surface: Surface, shift: tuple[float, float], grid: Grid, words: str) -> Surface:
    """Periodic surface shifted in Fourier space and on ``grid``; missing points are refused by the
    resampling."""
    require_complete(surface, "brought on a common periodic grid")
    heights: RealArray = surface.heights.astype(np.float64, copy=False)
    if shift != (0.0, 0.0):
        transform = RealTransform(surface.shape, thread_count())
        qx, qy = surface.grid.wavevector()
        heights = transform.backward(transform.forward(heights) * np.exp(-1j * (qx * shift[0] + qy * shift[1])))
    moved = surface.with_heights(heights, _step(grid, words))
    return resampled(moved, grid.shape)


def _interpolated(surface: Surface, grid: Grid, nodes: tuple[RealArray, RealArray], words: str) -> Surface:
    """Surface on ``grid``, whose ``nodes`` (x, y) in m, each (nx, ny), are counted from the corner
    of the map."""
    along = [node / d - 0.5 for node, d in zip(nodes, surface.grid.spacing, strict=True)]  # in pixels from node 0
    if surface.periodic:
        along = [number % n for number, n in zip(along, surface.shape, strict=True)]
    else:
        along = [np.clip(number, -0.5, n - 0.5) for number, n in zip(along, surface.shape, strict=True)]
    complete = filled(surface, "nearest").heights.astype(np.float64)
    pad = _MARGIN if surface.periodic else 0
    padded = np.pad(complete, pad, mode="wrap") if pad else complete
    degree = [min(3, n - 1) for n in padded.shape]
    own = [np.arange(n, dtype=float) - pad for n in padded.shape]
    spline = interpolate.RectBivariateSpline(own[0], own[1], padded, kx=degree[0], ky=degree[1])
    heights: RealArray
    if surface.periodic:
        heights = spline.ev(along[0], along[1])
    else:
        # beyond the middle of the outermost pixels (by half a pixel) the spline would be clamped:
        # it is continued by its tangent
        inside = [np.clip(number, 0.0, n - 1.0) for number, n in zip(along, surface.shape, strict=True)]
        heights = spline.ev(inside[0], inside[1])
        for axis, (dx, dy) in enumerate(((1, 0), (0, 1))):
            beyond = along[axis] - inside[axis]
            outside = beyond != 0.0
            if outside.any():
                heights[outside] += beyond[outside] * spline.ev(inside[0][outside], inside[1][outside], dx=dx, dy=dy)
    if surface.n_missing:  # a point is missing where a node of the map around it is
        ends = []
        for number, n in zip(along, surface.shape, strict=True):
            low, high = np.floor(number + _ROUNDING).astype(int), np.ceil(number - _ROUNDING).astype(int)
            ends.append([end % n if surface.periodic else np.clip(end, 0, n - 1) for end in (low, high)])
        for i, j in itertools.product(*ends):
            heights[surface.mask[i, j]] = np.nan
    origin = surface.origin.continued(_step(grid, words))
    return Surface(heights, *grid.spacing, origin=origin)


def _step(grid: Grid, words: str) -> str:
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    return f"on a common grid: {nx} x {ny} points of {show(dx, 'm')} x {show(dy, 'm')}{words}"


# Two rough bodies as one composite surface.


def composite(surface: Surface, counter_surface: Surface, *, mirrored: str | None = None) -> Surface:
    """Sum h = h1 + h2 of two surfaces, each with heights positive out of its own body.

    Only this sum enters the undeformed gap g = g0 - h of frictionless half-spaces (Peng 2001, app.
    D). A map of the upper body is measured looking at that body: turning it over about the y axis
    replaces x by Lx - x (``mirrored="x"``), about the x axis y by Ly - y (``mirrored="y"``). Points
    missing in either surface are missing in the sum, which is periodic only if both are; a periodic
    surface is mirrored about its node 0, any other about its middle. Raises InputError if the grids
    differ, the mirror is unknown, or no point is valid in both surfaces.

    Parameters
    ----------
    surface, counter_surface
        Surfaces with equal numbers of points and equal pixel sizes (to 1e-6).
    mirrored
        None, ``x`` or ``y``: how the counter surface is turned over.
    """
    other = counter_surface if mirrored is None else turned_over(counter_surface, axis=mirrored)
    pair = (surface, other)
    if surface.shape != other.shape or not np.allclose(surface.grid.spacing, other.grid.spacing, rtol=1e-6, atol=0.0):
        first, second = (f"{s.shape[0]} x {s.shape[1]} points of {s.dx:.6g} x {s.dy:.6g} m" for s in pair)
        raise InputError(
            "the two surfaces of a pair must have equal numbers of points and pixel sizes, but have "
            f"{first} and {second}. Use cropped() and resampled() to bring them on one grid."
        )
    steps = (f"surface {number}: {step}" for number, s in enumerate(pair, start=1) for step in s.origin.history)
    source = " + ".join(s.origin.source or "unnamed surface" for s in pair)
    keys = tuple(dict.fromkeys((*surface.citation_keys, *other.citation_keys, "Peng2001")))
    origin = Origin(source, history=(*steps, "composite: sum of surfaces 1 and 2"), citation_keys=keys)
    periodic = surface.periodic and counter_surface.periodic
    return Surface(surface.heights + other.heights, surface.dx, surface.dy, periodic=periodic, origin=origin)


def turned_over(surface: Surface, *, axis: str = "x") -> Surface:
    """Map of the upper body, measured looking at it, in the lateral frame of the lower one.

    ``axis`` ``"x"`` replaces x by Lx - x (turned about the y axis), ``"y"`` y by Ly - y. A periodic
    surface is mirrored about its node 0, any other about its middle. Raises InputError if the axis
    is not ``x`` or ``y``.
    """
    along = "xy".index(require.one_of(axis, ("x", "y"), "mirror of the counter surface"))
    flipped = np.flip(surface.heights, along)
    heights = np.roll(flipped, 1, along) if surface.periodic else flipped
    return surface.with_heights(heights, f"turned over: mirrored along {axis}")
