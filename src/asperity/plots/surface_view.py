"""A surface seen from the side in space, and its summits seen from above."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.arrays import RealArray
from ..core.grid import Grid
from ..surfaces.characterise.summary import Characterisation
from ..surfaces.surface import Surface
from .maps import plot_heights
from .style import HEIGHT_MAP, VERMILLION, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_FACES = 180  # along the longer side of a view; more do not show at its size
_TALLEST = 0.18  # height of the box over its longer side
_LIGHT = {"azdeg": 315.0, "altdeg": 35.0}


def plot_surface_view(surface: Surface, ax: Axes) -> Axes:
    """Draw ``surface`` in space, lit from the upper left, on the three-dimensional axes ``ax``.

    Heights are exaggerated to a fifth of the longer side; large maps are thinned to 180 points along it by block
    averages. Missing points are gaps. A profile has no view.
    """
    view: Any = ax  # of the class Axes3D
    heights, grid = _thinned(surface)
    if 1 in grid.shape:
        view.text2D(0.5, 0.5, "a profile has no view", transform=view.transAxes, ha="center", va="center")
        return ax
    length, height = scale(max(grid.size), "m"), scale(heights, "m")
    z = np.asarray(height(heights))
    x, y = np.broadcast_arrays(*(length(c) for c in grid.coordinates()))
    view.plot_surface(
        x,
        y,
        np.nan_to_num(z, nan=float(np.nanmin(z))),
        facecolors=_shaded(z, tuple(float(length(d)) / float(length(max(grid.size))) for d in grid.spacing)),
        rstride=1,
        cstride=1,
        linewidth=0.0,
        antialiased=False,
        shade=False,
    )
    view.set(xlabel=f"x ({length.symbol})", ylabel=f"y ({length.symbol})", zlabel=f"height ({height.symbol})")
    _box(view, grid)
    return ax


def _shaded(z: RealArray, spacing: tuple[float, ...]) -> RealArray:
    """Colours (nx, ny, 4) of the heights ``z``, lit; transparent where missing. Spacing over the longer side."""
    from matplotlib import colormaps
    from matplotlib.colors import LightSource, Normalize

    low, spread = float(np.nanmin(z)), float(np.nanmax(z) - np.nanmin(z)) or 1.0
    # the slopes of the picture, not those of the surface, make the shading
    dx, dy = (d * spread / _TALLEST for d in spacing)
    light, norm = LightSource(**_LIGHT), Normalize(low, low + spread)
    filled = np.nan_to_num(z, nan=low)
    colours: RealArray = light.shade(filled, colormaps[HEIGHT_MAP], norm=norm, blend_mode="soft", dx=dy, dy=dx)
    colours[np.isnan(z), 3] = 0.0
    return colours


def _box(view: Any, grid: Grid) -> None:
    """Shape, direction and faint grid of the box around the view."""
    width, depth = (max(side / max(grid.size), 0.15) for side in grid.size)
    view.set_box_aspect((width, depth, _TALLEST), zoom=1.1)
    view.view_init(elev=40.0, azim=-55.0)
    for axis in (view.xaxis, view.yaxis, view.zaxis):
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis._axinfo["grid"].update(color="0.88", linewidth=0.5)
    view.locator_params(nbins=5)
    view.locator_params(axis="z", nbins=3)


def plot_summits(found: Characterisation, ax: Axes) -> Axes:
    """Draw the heights of ``found`` and its summits (above 8 neighbours), larger dots for blunter ones, on ``ax``."""
    surface, summits = found.surface, found.curves.summits
    plot_heights(surface, ax)
    if 1 in surface.shape or summits.count == 0:
        return ax
    length = scale(max(surface.size), "m")
    radius = 1.0 / summits.curvature
    # area of a dot as the radius, about the mean; a map of a hundred thousand summits gets small dots
    mean = min(12.0, 4000.0 / summits.count)
    area = np.clip(mean * radius / radius.mean(), 0.15 * mean, 6.0 * mean)
    x, y = (summits.i + 0.5) * surface.dx, (summits.j + 0.5) * surface.dy
    ax.scatter(length(x), length(y), s=area, color=VERMILLION, linewidths=0.0, alpha=0.85)
    ax.set_title(f"{summits.count} summits", loc="left")
    return ax


def _thinned(surface: Surface) -> tuple[RealArray, Grid]:
    """Heights about their mean, averaged over blocks so that the longer side has at most ``_FACES`` points."""
    step = max(1, min(int(np.ceil(max(surface.shape) / _FACES)), min(surface.shape) // 2))
    count = tuple(n // step for n in surface.shape)
    part = surface.heights[: count[0] * step, : count[1] * step] - np.nanmean(surface.heights, dtype=np.float64)
    blocks = part.reshape(count[0], step, count[1], step).mean(axis=(1, 3))
    return blocks, Grid((count[0], count[1]), (step * surface.dx, step * surface.dy))
