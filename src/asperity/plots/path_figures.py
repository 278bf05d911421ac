"""The figures of a load path."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from ..contact.path import LoadPath
from .path_curves import plot_area_loop, plot_energies, plot_load_loop
from .picture import CURVE_SIZE, png, save_pictures

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DrawPath: TypeAlias = "Callable[[LoadPath, Axes], Axes]"
"""Draws a load path on axes."""


@dataclass(frozen=True)
class PathPlot:
    """One figure of a load path: ``name`` of its file, ``title``, ``caption``, how to draw it."""

    name: str
    title: str
    caption: str
    draw: DrawPath


PATH_PLOTS = (
    PathPlot(
        "load_loop",
        "Load against approach",
        "Mean pressure against approach from first touch of the virgin surfaces. The area within a loop is the plastic work "
        "per nominal area.",
        plot_load_loop,
    ),
    PathPlot(
        "area_loop",
        "Area against load",
        "Real contact area against mean pressure. After yielding, the same load has more area than before.",
        plot_area_loop,
    ),
    PathPlot(
        "energies",
        "Where the work goes",
        "External work, elastic energy and plastic work after each step. The dotted line lies on the black one but for the "
        "error of the steps.",
        plot_energies,
    ),
)
"""The figures of a load path in the order of a report."""


def render_path_plot(plot: PathPlot, path: LoadPath) -> bytes:
    """PNG of ``plot`` for ``path``."""
    return png(partial(plot.draw, path), CURVE_SIZE)


def save_path_plots(path: LoadPath, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the figures of ``path`` as PNG into ``folder`` (made if missing) and return their paths.

    Raises
    ------
    OutputError
        If a file exists and ``overwrite`` is false, or the folder cannot be made or written.
    """
    pictures = {plot.name: partial(render_path_plot, plot, path) for plot in PATH_PLOTS}
    return save_pictures(pictures, folder, overwrite=overwrite)
