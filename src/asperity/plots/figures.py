"""Whole figures as PNG: the standard set of a result, and the picture of one surface."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from ..contact.result import ContactResult
from ..io.atomic import atomic_file
from ..surfaces.surface import Surface
from .histogram import plot_gap_histogram, plot_pressure_histogram
from .maps import plot_contact, plot_gap, plot_heights, plot_indentation, plot_pressure, plot_residual
from .picture import CURVE_SIZE, map_size, png, save_pictures
from .section import plot_section

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Draw: TypeAlias = "Callable[[ContactResult, Axes], Axes]"
"""Draws a result on axes."""


@dataclass(frozen=True)
class Plot:
    """One figure of the standard set: ``name`` of its file, ``title``, ``caption``, how to draw it, map or curve."""

    name: str
    title: str
    caption: str
    draw: Draw
    is_map: bool = True


def _plot_surface(result: ContactResult, ax: Axes) -> Axes:
    return plot_heights(result.problem.surface, ax)


PLOTS = (
    Plot("heights", "Heights", "Heights of the rough surface, relative to their mean.", _plot_surface),
    Plot("pressure", "Pressure", "Contact pressure; grey where the bodies do not touch.", plot_pressure),
    Plot(
        "pressure_log",
        "Pressure, logarithmic",
        "Contact pressure on a logarithmic scale of three decades below the maximum.",
        partial(plot_pressure, log=True),
    ),
    Plot("contact", "Contact", "Where the bodies touch, elastically or at the hardness.", plot_contact),
    Plot("gap", "Gap", "Gap between the deformed surfaces; grey in contact.", plot_gap),
    Plot(
        "section",
        "Section",
        "Cut along x through the highest pressure: deformed composite surface against the counter surface, "
        "and the pressure below. Heights are exaggerated.",
        plot_section,
        is_map=False,
    ),
    Plot(
        "histogram",
        "Distribution of pressure",
        "Probability density of the pressure over the real contact area.",
        plot_pressure_histogram,
        is_map=False,
    ),
    Plot(
        "gap_histogram",
        "Distribution of the gap",
        "Probability density of the gap over the area out of contact.",
        plot_gap_histogram,
        is_map=False,
    ),
)
"""The standard figures of a result in the order of a report."""

PLASTIC_PLOTS = (
    Plot(
        "indentation",
        "Plastic zone",
        "Permanent indentation of the composite surface wherever the pressure has ever reached its limit; grey elsewhere.",
        plot_indentation,
    ),
    Plot(
        "residual",
        "Residual surface",
        "Heights of the composite surface that is left when the load is taken away, relative to their mean.",
        plot_residual,
    ),
)
"""The figures of a result that is permanently indented."""


def plots_of(result: ContactResult) -> tuple[Plot, ...]:
    """Figures that say something of ``result``: the standard ones, and those of its plastic zone if it has any."""
    return (*PLOTS, *PLASTIC_PLOTS) if result.indented.any() else PLOTS


def render(plot: Plot, result: ContactResult) -> bytes:
    """PNG of ``plot`` for ``result``."""
    size = map_size(result.problem.grid) if plot.is_map else CURVE_SIZE
    return png(lambda ax: plot.draw(result, ax), size)


def save_plots(result: ContactResult, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the standard figures of ``result`` as PNG into ``folder`` (made if missing) and return their paths.

    Raises
    ------
    OutputError
        If a file exists and ``overwrite`` is false, or the folder cannot be made or written.
    """
    return save_pictures(
        {plot.name: partial(render, plot, result) for plot in plots_of(result)}, folder, overwrite=overwrite
    )


def save_surface_plot(surface: Surface, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the map of heights of ``surface`` as PNG to ``path``.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_bytes(png(lambda ax: plot_heights(surface, ax), map_size(surface.grid)))
