"""Figures of a scan and the tip that took it: the surface behind it, where that is certain, the
shape of the tip."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.arrays import BoolArray
from ..surfaces.prepare.tip import Tip, certain_points, reconstructed
from ..surfaces.surface import Surface
from .maps import Kinds, heights_field, map_of, plot_map
from .picture import BLACK, BLUE, NO_CONTACT, ORANGE, VERMILLION, Figure, Plot, figures_by, legend_above, scale
from .together import save_pictures

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class ScanByTip:
    """A scan, ``surface``, and the ``tip`` that took it."""

    surface: Surface
    tip: Tip

    @cached_property
    def behind(self) -> Surface:
        """The surface behind the scan."""
        return reconstructed(self.surface, self.tip)

    @cached_property
    def certain(self) -> BoolArray:
        """Where that is certain, (nx, ny)."""
        return certain_points(self.surface, self.tip)

    @property
    def kinds(self) -> Kinds:
        """Where the surface behind the scan is certain."""
        names = (("uncertain", NO_CONTACT), ("certain", BLUE))
        return Kinds(self.certain.astype(float), self.surface.grid, names)


def plot_certainty(scan: Surface, tip: Tip, ax: Axes) -> Axes:
    """Draw where the surface behind a ``scan`` with ``tip`` is certain on ``ax``."""
    return plot_map(ScanByTip(scan, tip).kinds, ax)


def plot_tip_section(scan: Surface, tip: Tip, ax: Axes) -> Axes:
    """Draw a ``scan`` and the surface behind it along x through the highest point on ``ax``, with
    the places that are certain."""
    return _section(ScanByTip(scan, tip), ax)


def _section(found: ScanByTip, ax: Axes) -> Axes:
    scan, behind = found.surface, found.behind
    row = int(np.unravel_index(np.nanargmax(scan.heights), scan.shape)[1])
    x = (np.arange(scan.shape[0]) + 0.5) * scan.dx
    before, after, certain = scan.heights[:, row], behind.heights[:, row], found.certain[:, row]
    level = float(np.nanmean(before))
    along, up = scale(scan.size[0], "m"), scale(before - level, "m")
    ax.set(xlabel=f"x ({along.symbol})", ylabel=f"height ({up.symbol})", xlim=(0.0, float(along(scan.size[0]))))
    ax.plot(along(x), up(before - level), color=BLACK, linewidth=0.9, label="scan")
    ax.plot(along(x), up(after - level), color=VERMILLION, linewidth=0.9, label="behind the tip")
    ax.plot(
        along(x[certain]),
        up(after[certain] - level),
        color=BLUE,
        linestyle="",
        marker=".",
        markersize=4.0,
        label="certain",
    )
    return legend_above(ax, 3)


def plot_tip(scan: Surface, tip: Tip, ax: Axes) -> Axes:
    """Draw sections of ``tip`` along x and y on ``ax``, as far as it can touch the surface of
    ``scan``."""
    height = float(np.nanmax(scan.heights) - np.nanmin(scan.heights)) or min(scan.grid.spacing)
    reach = tip.reach(height)
    longest = max(*reach, *scan.grid.spacing)
    along, up = scale(longest, "m"), scale(height, "m")
    ax.set(xlabel=f"distance from the axis ({along.symbol})", ylabel=f"height above the apex ({up.symbol})")
    for axis, colour in ((0, BLUE), (1, ORANGE)):
        spacing = scan.grid.spacing[axis]
        half = int(reach[axis] / spacing * (1.0 + 1e-12))
        fine = np.linspace(-reach[axis], reach[axis], 201)
        pixels = np.arange(-half, half + 1) * spacing
        for places, look in ((fine, {"linewidth": 0.9}), (pixels, {"linestyle": "", "marker": "."})):
            sides = (places, np.zeros(places.size)) if axis == 0 else (np.zeros(places.size), places)
            heights = tip.above_apex(*sides)
            shown = np.where(heights <= height, heights, np.nan)
            options: dict[str, Any] = look | ({"label": f"along {'xy'[axis]}"} if places is fine else {})
            ax.plot(along(places), up(shown), color=colour, **options)
    return legend_above(ax)


TIP_PLOTS = (
    map_of("scan", "Scan", "Heights of the scan.", lambda found: heights_field(found.surface)),
    map_of(
        "reconstruction",
        "Surface behind the tip",
        "The highest surface that agrees with the scan and the tip.",
        lambda found: heights_field(found.behind),
    ),
    map_of(
        "certainty",
        "Certainty",
        "Where the surface behind the tip is the true one: the tip touched at exactly one place.",
        lambda found: found.kinds,
    ),
    Plot(
        "tip_section",
        "Section",
        "Scan and surface behind the tip along x through the highest point.",
        _section,
    ),
    Plot(
        "tip",
        "Tip",
        "Sections of the tip through its apex, with the pixels of the scan.",
        lambda found, ax: plot_tip(found.surface, found.tip, ax),
    ),
)
"""The standard figures of a scan by a tip."""


def tip_figures(scan: Surface, tip: Tip) -> tuple[Figure, ...]:
    """The standard figures of a ``scan`` by a ``tip``."""
    return figures_by(TIP_PLOTS, ScanByTip(scan, tip))


def save_tip_plots(scan: Surface, tip: Tip, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the standard figures of a ``scan`` by a ``tip`` as PNG into ``folder`` (made if
    missing).

    Raises OutputError if a file exists and ``overwrite`` is false, or the folder cannot be made or
    written; InputError if the tip does not fit the scan.
    """
    return save_pictures(tip_figures(scan, tip), folder, overwrite=overwrite)
