"""Figures of a contact: the standard set, sections, distributions, menisci, and the curves of a
load path."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..contact.history import HistoryResult
from ..contact.law import LimitByDepth
from ..contact.measure import distribution
from ..contact.result import ContactResult
from ..core.arrays import RealArray
from ..core.registry import PHYSICS, home
from ..core.units import show
from ..io.atomic import atomic_file
from ..surfaces.surface import Surface
from .maps import (
    Look,
    contact_kinds,
    enlarge_contact,
    enlarge_island,
    gap_field,
    heights_field,
    indentation_field,
    map_of,
    plot_heights,
    plot_pressure,
    pressure_field,
)
from .picture import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PRESSURE_MAP,
    PURPLE,
    SKY,
    VERMILLION,
    Figure,
    Plot,
    Scale,
    figures_by,
    legend_above,
    map_size,
    png,
    say_exaggeration,
    scale,
)
from .together import save_pictures
from .view import draw_view, thinned

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# A cut through the contact: the deformed surfaces above, the pressure between them below.


SHARE = 0.36
"""Share of the height of the axes that the pressure takes, at the bottom."""


def plot_section(result: ContactResult, ax: Axes) -> Axes:
    """Draw the cut of ``result`` along x through the highest pressure on ``ax``; pressure on a
    second y axis.

    The composite rough surface carries all deformation of both bodies, so the counter surface is
    drawn flat. Without contact the cut goes through the smallest gap.
    """
    from matplotlib.ticker import MaxNLocator

    row = row_of_section(result)
    grid = result.problem.grid
    length = scale(grid.size[0], "m")
    x = length((np.arange(grid.shape[0]) + 0.5) * grid.spacing[0])
    counter = np.full(x.shape, result.offset)
    rough = result.offset - result.gap[:, row]
    middle = float(np.mean(rough))
    rough, counter = rough - middle, counter - middle
    height = scale(np.concatenate([rough, counter]), "m")
    rough, counter = height(rough), height(counter)
    lowest, highest = float(min(rough.min(), counter.min())), float(max(rough.max(), counter.max()))
    span = (highest - lowest) or 1.0
    free = 1.0 - SHARE - 0.16
    bottom, top = lowest - span * (SHARE + 0.06) / free, highest + span * 0.10 / free
    ax.fill_between(x, rough, lowest - 0.04 * span, color="0.80", linewidth=0.0)
    ax.fill_between(x, counter, top, color="0.90", linewidth=0.0)
    ax.plot(x, counter, color=BLACK, linewidth=1.0, label="counter surface")
    ax.plot(x, rough, color=BLUE, linewidth=1.0, label="deformed rough surface")
    ax.set_ylim(bottom, top)
    ax.set_yticks([tick for tick in ax.get_yticks() if lowest - 0.02 * span <= tick <= top])
    ax.set(
        xlabel=f"x ({length.symbol})"
        + (f", at y = {show((row + 0.5) * grid.spacing[1], 'm')}" if grid.shape[1] > 1 else ""),
        ylabel=f"height ({height.symbol})",
        xlim=(0.0, float(length(grid.size[0]))),
    )
    low, high = ax.get_ylim()
    say_exaggeration(ax, "heights", grid.size[0], (high - low) * height.factor)
    in_pa = scale(result.pressure[:, row], "Pa")
    pressure = in_pa(result.pressure[:, row])
    largest = float(pressure.max()) or 1.0
    twin = ax.twinx()
    twin.fill_between(x, pressure, color=VERMILLION, alpha=0.25, linewidth=0.0)
    twin.plot(x, pressure, color=VERMILLION, linewidth=1.0, label="pressure")
    ax.plot([], [], color=VERMILLION, label="pressure")
    twin.set_ylim(0.0, 1.12 * largest / SHARE)
    ticks = [float(tick) for tick in MaxNLocator(3).tick_values(0.0, largest) if tick <= 1.12 * largest]
    twin.set_yticks(ticks)
    twin.set_ylabel(f"pressure ({in_pa.symbol})", color=VERMILLION, y=SHARE / 2.0)
    twin.tick_params(axis="y", colors=VERMILLION)
    return legend_above(ax, 3, 1.04)


def row_of_section(result: ContactResult) -> int:
    """Row of the grid along x through the highest pressure, without contact through the smallest
    gap."""
    if result.contact.any():
        return int(np.argmax((result.pressure == result.pressure.max()).sum(axis=0)))  # plastic: many are highest
    return int(np.unravel_index(np.argmin(result.gap), result.gap.shape)[1])


# How pressure and gap are distributed over the area.


def plot_pressure_histogram(result: ContactResult, ax: Axes) -> Axes:
    """Draw the probability density of the pressure over the real contact area of ``result`` on
    ``ax``.

    Marked are the mean real pressure and, if it is one number, the hardness where it is reached.
    """
    pressure = result.pressure[result.contact]
    in_unit = scale(pressure, "Pa")
    if not _histogram(pressure, in_unit, ax, "contact pressure", "no contact"):
        return ax
    mean = float(in_unit(result.mean_real_pressure))
    ax.axvline(mean, color=BLACK, linestyle="--", label=f"mean {mean:.3g} {in_unit.symbol}")
    cap = result.problem.law.pressure_cap()
    if result.plastic.any() and not isinstance(cap, np.ndarray) and not isinstance(result.problem.law, LimitByDepth):
        hardness = float(in_unit(cap))
        ax.axvline(hardness, color=VERMILLION, linestyle=":", label=f"hardness {hardness:.3g} {in_unit.symbol}")
    return legend_above(ax)


def plot_gap_histogram(result: ContactResult, ax: Axes) -> Axes:
    """Draw the probability density of the gap over the open area of ``result`` on ``ax``, with the
    mean gap marked."""
    gap = result.gap[~result.contact]
    in_unit = scale(gap, "m")
    if not _histogram(gap, in_unit, ax, "gap", "full contact"):
        return ax
    mean = float(in_unit(result.mean_gap))
    ax.axvline(mean, color=BLACK, linestyle="--", label=f"mean over the whole area {mean:.3g} {in_unit.symbol}")
    return legend_above(ax)


def _histogram(values: RealArray, in_unit: Scale, ax: Axes, name: str, if_none: str) -> bool:
    """Bars of the density of ``values``; False, and the words ``if_none``, where there are none."""
    ax.set(xlabel=f"{name} ({in_unit.symbol})", ylabel=f"probability density (1/{in_unit.symbol})")
    if values.size == 0:
        ax.text(0.5, 0.5, if_none, transform=ax.transAxes, ha="center", va="center")
        return False
    bins = int(np.clip(2.0 * values.size ** (1.0 / 3.0), 5, 60))  # Rice's rule
    bars = distribution(np.asarray(in_unit(values)), bins)
    ax.stairs(bars.density, bars.edges, fill=True, color=SKY, edgecolor="white", linewidth=0.4)
    ax.set_xlim(0.0, 1.04 * float(bars.edges[-1]))
    return True


# Whole figures as PNG: the standard set of a result, and the picture of one surface.


PEAKS = 120
"""Points along the longer side of a view of pressures."""


def plot_pressure_view(result: ContactResult, ax: Axes) -> Axes:
    """Draw the pressure of ``result`` in space on the three-dimensional axes ``ax``, as in the
    figures of Bhushan (1998, fig. 26).

    Large maps show the largest pressure of each block.
    """
    pressure, grid = thinned(np.asarray(result.pressure), result.problem.grid, np.max, PEAKS)
    return draw_view(pressure, grid, ax, Look("Pa", "pressure", PRESSURE_MAP), 2.0)


PLOTS = (
    map_of(
        "heights",
        "Heights",
        "Heights of the rough surface, relative to their mean.",
        lambda result: heights_field(result.problem.surface),
        by_step=False,
    ),
    Plot(
        "pressure",
        "Pressure",
        "Contact pressure; grey where the bodies do not touch.",
        plot_pressure,
        "map",
        beside=enlarge_contact,
        shows=pressure_field,
    ),
    Plot(
        "pressure_log",
        "Pressure, logarithmic",
        "Contact pressure on a logarithmic scale of three decades below the maximum.",
        partial(plot_pressure, log=True),
        "map",
        enlarge_contact,
        shows=pressure_field,
    ),
    map_of(
        "contact",
        "Contact",
        "Where the bodies touch, elastically or at the hardness.",
        contact_kinds,
        enlarge_contact,
    ),
    map_of(
        "gap",
        "Gap",
        "Gap between the deformed surfaces; grey in contact.",
        gap_field,
        enlarge_contact,
    ),
    Plot(
        "pressure_view",
        "Pressure in space",
        "Contact pressure as hills over the surface, the highest of each block where a map has many points; flat where "
        "the bodies do not touch.",
        plot_pressure_view,
        "view",
    ),
    Plot(
        "section",
        "Section",
        "Cut along x through the highest pressure: deformed composite surface against the counter surface, "
        "and the pressure below.",
        plot_section,
    ),
    Plot(
        "histogram",
        "Distribution of pressure",
        "Probability density of the pressure over the real contact area.",
        plot_pressure_histogram,
    ),
    Plot(
        "gap_histogram",
        "Distribution of the gap",
        "Probability density of the gap over the area out of contact.",
        plot_gap_histogram,
    ),
)
"""The standard figures of a result in the order of a report."""

PLASTIC_PLOTS = (
    map_of(
        "indentation",
        "Plastic zone",
        "Permanent indentation of the composite surface wherever the pressure has ever reached its limit; "
        "grey elsewhere.",
        indentation_field,
        lambda result, ax: enlarge_island(
            result.indented, result.problem.grid, result.problem.boundary.wraps, "largest plastic zone", ax
        ),
    ),
    map_of(
        "residual",
        "Residual surface",
        "Heights of the composite surface that is left when the load is taken away, relative to their mean.",
        lambda result: heights_field(result.residual_surface()),
    ),
)
"""The figures of a result that is permanently indented."""


def plots_of(result: ContactResult) -> tuple[Plot, ...]:
    """Figures that say something of ``result``: the standard ones, and those of its plastic zone if
    it has any."""
    flat = 1 in result.problem.grid.shape  # a line has no view
    chosen = tuple(plot for plot in PLOTS if not (flat and plot.kind == "view"))
    return (*chosen, *PLASTIC_PLOTS) if result.indented.any() else chosen


def contact_figures(result: ContactResult) -> tuple[Figure, ...]:
    """Figures of any ``result``."""
    return figures_by(tuple(plot for plot in plots_of(result) if plot in PLOTS), result)


def physics_plots(result: ContactResult | None = None) -> Iterator[tuple[Plot, ...]]:
    """Figures of each physics whose answer a result shows, of those that ``result`` has; of all
    without one."""
    for known in PHYSICS.values():
        for name, place in known.figures.items():
            if result is None or name in result.couplings:
                yield home(place)


def figures_of(result: Any) -> tuple[Figure, ...]:
    """All figures of a ``result`` (a contact or load path)."""
    contact = result.last if isinstance(result, HistoryResult) else result
    path = figures_by(PATH_PLOTS, result) if isinstance(result, HistoryResult) else ()
    own = (plot for plots in physics_plots(contact) for plot in plots)
    return (*figures_by(plots_of(contact), contact), *path, *figures_by(tuple(own), contact))


def save_plots(result: ContactResult, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the standard figures of ``result`` as PNG into ``folder`` (made if missing) and return
    their paths.

    Raises OutputError if a file exists and ``overwrite`` is false, or the folder cannot be made or
    written.
    """
    return save_pictures(figures_of(result), folder, overwrite=overwrite)


def save_surface_plot(surface: Surface, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the map of heights of ``surface`` as PNG to ``path``.

    Raises OutputError if the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_bytes(png(lambda ax: plot_heights(surface, ax), map_size(surface.grid)))


# Curves of a load path: load against approach, area against load, and where the work goes.


LOADING = (BLUE, SKY, GREEN)
"""Colours of the first, the second and every further loading."""

UNLOADING = (VERMILLION, ORANGE, PURPLE)
"""Colours of the first, the second and every further unloading."""


def plot_load_loop(path: HistoryResult, ax: Axes) -> Axes:
    """Draw the mean pressure of every step of ``path`` against its approach on ``ax``, each
    direction in its colour."""
    load, approach = (_from_touch(path, values) for values in (path.mean_pressure, path.approach))
    in_m, in_pa = scale(approach, "m"), scale(load, "Pa")
    _draw_legs(in_m(approach), in_pa(load), path, ax)
    ax.set(xlabel=f"approach from first touch ({in_m.symbol})", ylabel=f"mean pressure ({in_pa.symbol})")
    return ax


def plot_area_loop(path: HistoryResult, ax: Axes) -> Axes:
    """Draw the real area of every step of ``path``, in percent of the nominal area, against the
    mean pressure on ``ax``."""
    load, area = (_from_touch(path, values) for values in (path.mean_pressure, path.area_fraction_corrected))
    in_pa = scale(load, "Pa")
    _draw_legs(in_pa(load), 100.0 * area, path, ax)
    ax.set(xlabel=f"mean pressure ({in_pa.symbol})", ylabel="real contact area (% of nominal)")
    return ax


def plot_energies(path: HistoryResult, ax: Axes) -> Axes:
    """Draw external work, elastic energy and plastic work after every step of ``path`` on
    ``ax``."""
    balance = path.energies
    in_j = scale(np.concatenate([balance.external_work, balance.elastic_energy, balance.plastic_work]), "J")
    step = np.arange(1, len(path.steps) + 1)
    kinds = {
        "external work ∫F dδ": (balance.external_work, BLACK, "-"),
        "elastic energy": (balance.elastic_energy, BLUE, "-"),
        "plastic work": (balance.plastic_work, VERMILLION, "-"),
        "elastic + plastic": (balance.elastic_energy + balance.plastic_work, ORANGE, ":"),
    }
    if balance.tangential_work.any():
        kinds["tangential work ΣQΔδ"] = (balance.tangential_work, GREEN, "-")
        kinds["dissipated by slip"] = (balance.slip_work, PURPLE, "-")
    if balance.jump_work.any():
        kinds["lost in jumps"] = (balance.jump_work, PURPLE, "--")
    for label, (energy, colour, line) in kinds.items():
        ax.plot(step, in_j(energy), color=colour, linestyle=line, marker=".", markersize=3.0, label=label)
    ax.set(xlabel="step", ylabel=f"energy ({in_j.symbol})", xlim=(0.5, step[-1] + 0.5))
    ax.locator_params(axis="x", integer=True)
    return legend_above(ax)


def _from_touch(path: HistoryResult, values: RealArray) -> RealArray:
    """``values`` of every step; a path of virgin surfaces begins at first touch, where all of them
    are zero."""
    return np.concatenate([[0.0], values]) if path.start is None else values


def _draw_legs(x: RealArray, y: RealArray, path: HistoryResult, ax: Axes) -> None:
    """Curve of the points ``x``, ``y``, each direction of the load in its colour; a part starts
    where the last one ended."""
    before = len(x) - len(path.steps)
    load = _from_touch(path, path.mean_pressure)
    counts = {True: 0, False: 0}
    for first, last in itertools.pairwise((0, *(turn + before for turn in path.turns))):
        rising = bool(load[last] > load[first])
        number = counts[rising]
        counts[rising] += 1
        colour = (LOADING if rising else UNLOADING)[min(number, len(LOADING) - 1)]
        name = ("loading" if rising else "unloading") + (f" {number + 1}" if number else "")
        part, line = slice(first, last + 1), "-" if rising else "--"
        ax.plot(x[part], y[part], color=colour, marker=".", markersize=3.5, label=name, linestyle=line)
    ax.set_xlim(left=min(0.0, float(np.min(x))))
    ax.set_ylim(bottom=0.0)
    legend_above(ax, 4)


# The figures of a load path.


PATH_PLOTS = (
    Plot(
        "load_loop",
        "Load against approach",
        "Mean pressure against approach from first touch of the virgin surfaces. The area within a loop is "
        "the plastic work per nominal area.",
        plot_load_loop,
    ),
    Plot(
        "area_loop",
        "Area against load",
        "Real contact area against mean pressure. After yielding, the same load has more area than before.",
        plot_area_loop,
    ),
    Plot(
        "energies",
        "Where the work goes",
        "External work, elastic energy and plastic work after each step. The dotted line lies on the black "
        "one but for the error of the steps.",
        plot_energies,
    ),
)
"""The figures of a load path in the order of a report."""


def save_path_plots(path: HistoryResult, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the figures of ``path`` as PNG into ``folder`` (made if missing) and return their
    paths.

    Raises OutputError if a file exists and ``overwrite`` is false, or the folder cannot be made or
    written.
    """
    return save_pictures(figures_by(PATH_PLOTS, path), folder, overwrite=overwrite)
