"""The standard figures of a surface, as PNG."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from ..core.grid import Grid
from ..surfaces.characterise.summary import Characterisation
from .maps import plot_heights
from .picture import CURVE_SIZE, map_size, png, save_pictures
from .spectrum import plot_scale_dependence, plot_spectrum
from .surface_curves import plot_autocorrelation, plot_height_distribution, plot_material_ratio
from .surface_view import plot_summits, plot_surface_view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Draw: TypeAlias = "Callable[[Characterisation, Axes], Axes]"
"""Draws a characterisation on axes."""

VIEW_SIZE = (5.6, 4.2)
"""Width and height in inches of a view in space."""


@dataclass(frozen=True)
class SurfacePlot:
    """One figure: ``name`` of its file, ``title``, ``caption``, how to draw it; ``kind`` map, curve or view in space."""

    name: str
    title: str
    caption: str
    draw: Draw
    kind: str = "curve"


def _heights(found: Characterisation, ax: Axes) -> Axes:
    return plot_heights(found.surface, ax)


def _view(found: Characterisation, ax: Axes) -> Axes:
    return plot_surface_view(found.surface, ax)


SURFACE_PLOTS = (
    SurfacePlot("heights", "Heights", "Heights relative to their mean; missing points are grey.", _heights, "map"),
    SurfacePlot("view", "View", "The surface in space; heights are exaggerated.", _view, "view"),
    SurfacePlot(
        "distribution",
        "Distribution of heights",
        "Probability density of the heights, and the normal density of the same deviation.",
        plot_height_distribution,
    ),
    SurfacePlot(
        "material_ratio",
        "Material ratio",
        "Material ratio (Abbott) curve with the equivalent line of the core; triangles for peaks and valleys.",
        plot_material_ratio,
    ),
    SurfacePlot(
        "spectrum",
        "Power spectrum",
        "Radial mean of the power spectrum and the fitted model; the range of the fit is shaded.",
        plot_spectrum,
    ),
    SurfacePlot(
        "autocorrelation",
        "Autocorrelation",
        "Autocorrelation along x and y; its falls to 1/e and to 0.1 define correlation lengths.",
        plot_autocorrelation,
    ),
    SurfacePlot(
        "scale_dependence",
        "Slope and curvature by scale",
        "Rms slope and curvature of profiles against the length of the stencil.",
        plot_scale_dependence,
    ),
    SurfacePlot(
        "summits",
        "Summits",
        "Points above all eight neighbours; the area of a dot grows with the radius of the summit.",
        plot_summits,
        "map",
    ),
)
"""The standard figures of a surface in the order of a report."""


def render_surface_plot(plot: SurfacePlot, found: Characterisation) -> bytes:
    """PNG of ``plot`` for ``found``."""
    projection = "3d" if plot.kind == "view" else None
    return png(lambda ax: plot.draw(found, ax), _size(plot.kind, found.surface.grid), projection=projection)


def save_roughness_plots(found: Characterisation, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the standard figures of a characterised surface as PNG into ``folder`` (made if missing).

    Raises
    ------
    OutputError
        If a file exists and ``overwrite`` is false, or the folder cannot be made or written.
    """
    return save_pictures(
        {plot.name: partial(render_surface_plot, plot, found) for plot in SURFACE_PLOTS}, folder, overwrite=overwrite
    )


def _size(kind: str, grid: Grid) -> tuple[float, float]:
    return map_size(grid) if kind == "map" else VIEW_SIZE if kind == "view" else CURVE_SIZE
