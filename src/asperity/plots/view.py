"""Maps in space: heights, pressures and stresses as hills, lit from the side."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.arrays import RealArray
from ..core.grid import Grid
from .maps import Look
from .picture import scale, times_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FACES = 180
"""Points along the longer side of a view; more do not show at its size."""

_TALLEST = 0.18  # height of the box over its longer side
_LIGHT = {"azdeg": 315.0, "altdeg": 35.0}


def thinned(
    values: RealArray, grid: Grid, reduce: Callable[..., RealArray] = np.mean, most: int = FACES
) -> tuple[RealArray, Grid]:
    """``values`` (nx, ny) reduced over blocks so that the longer side has at most ``most`` points:
    by their mean, or by what ``reduce`` makes of the axes of a block."""
    step = max(1, min(int(np.ceil(max(grid.shape) / most)), min(grid.shape) // 2))
    count = tuple(n // step for n in grid.shape)
    part = values[: count[0] * step, : count[1] * step]
    blocks = reduce(part.reshape(count[0], step, count[1], step), axis=(1, 3))
    return blocks, Grid((count[0], count[1]), (step * grid.spacing[0], step * grid.spacing[1]))


def draw_view(values: RealArray, grid: Grid, ax: Axes, look: Look, tall: float = 1.0) -> Axes:
    """Draw ``values`` (nx, ny) in space on the three-dimensional axes ``ax``, lit from the upper
    left, in the unit, words and colours of their ``look``; missing points are gaps, and a line of
    points has no view.

    ``tall`` is the height of the box over the usual one.
    """
    from matplotlib import colormaps
    from matplotlib.colors import LightSource, Normalize

    view: Any = ax  # of the class Axes3D
    if 1 in grid.shape:
        view.text2D(0.5, 0.5, "a profile has no view", transform=view.transAxes, ha="center", va="center")
        return ax
    length, upright, tallest = scale(max(grid.size), "m"), scale(values, look.unit), tall * _TALLEST
    z = np.asarray(upright(values))
    x, y = np.broadcast_arrays(*(length(c) for c in grid.coordinates()))
    low, spread = float(np.nanmin(z)), float(np.nanmax(z) - np.nanmin(z)) or 1.0
    # the slopes of the picture, not those of the map, make the shading
    dx, dy = (float(length(d)) / float(length(max(grid.size))) * spread / tallest for d in grid.spacing)
    light, norm, solid = LightSource(**_LIGHT), Normalize(low, low + spread), np.nan_to_num(z, nan=low)
    faces = light.shade(solid, colormaps[look.colours], norm=norm, blend_mode="soft", dx=dy, dy=dx)
    faces[np.isnan(z), 3] = 0.0
    view.plot_surface(
        x, y, solid, facecolors=faces, rstride=1, cstride=1, linewidth=0.0, antialiased=False, shade=False
    )
    view.set(xlabel=f"x ({length.symbol})", ylabel=f"y ({length.symbol})", zlabel=f"{look.label} ({upright.symbol})")
    width, depth = (max(side / max(grid.size), 0.15) for side in grid.size)
    view.set_box_aspect((width, depth, tallest), zoom=1.1)
    view.view_init(elev=40.0, azim=-55.0)
    for axis in (view.xaxis, view.yaxis, view.zaxis):
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis._axinfo["grid"].update(color="0.88", linewidth=0.5)
    view.locator_params(nbins=5)
    view.locator_params(axis="z", nbins=3)
    if look.unit == "m":
        along = float(np.ptp((view.get_xlim, view.get_ylim)[int(grid.size[1] > grid.size[0])]())) * length.factor
        times = tallest * along / (float(np.ptp(view.get_zlim())) * upright.factor)
        view.text2D(1.0, 0.9, times_text("heights", times), transform=view.transAxes, ha="right", fontsize=7.5)
    return ax
