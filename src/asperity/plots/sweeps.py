"""Figures of sweeps: curves in panels, points of all cases, maps of two axes with the limits on
them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import RealArray
from ..core.quantity import Labelled, Limit
from ..core.units import show
from .campaign import COLOURS, MOST_TICKS, Curve, plot_curves, with_unit
from .picture import BLACK, NO_CONTACT, VERMILLION, legend_above, literal, saying, scale, wide_range

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PANEL = (2.7, 2.1)
"""Width and height in inches of one of several panels, with its labels."""

MARKERS = "osD^v<>PX*"
"""Marks of points in turn."""


@dataclass(frozen=True, eq=False)
class Panel:
    """One panel: where it stands on further axes, and its curves."""

    title: str
    curves: tuple[Curve, ...]


def plot_panels(x: Labelled, y: Labelled, panels: Sequence[Sequence[Panel]], limit: Limit | None, ax: Axes) -> Axes:
    """Draw rows of ``panels`` of the quantity that ``y`` names against ``x`` in place of ``ax``,
    all on one scale, one legend above them."""
    figure, rows, columns = ax.figure, len(panels), max(map(len, panels))
    ax.set_axis_off()
    above = figure.add_gridspec(rows, columns, hspace=0.12 + 0.14 * any(each.title for each in panels[0]), wspace=0.08)
    first: Axes | None = None
    for number, row in enumerate(panels):
        for at, panel in enumerate(row):
            drawn = figure.add_subplot(above[number, at], sharex=first, sharey=first)
            first = first or drawn
            plot_curves(x, y, panel.curves, drawn)
            if limit is not None:
                plot_limit(limit, y, drawn)
            legend = drawn.get_legend()
            if legend is not None and (number or at):
                legend.remove()
            drawn.set_title("\n".join(map(literal, panel.title.split("; "))), fontsize=8.5)
            if at:
                drawn.set_ylabel("")
                drawn.tick_params(labelleft=False, which="both")
            if number < rows - 1:
                drawn.set_xlabel("")
                drawn.tick_params(labelbottom=False, which="both")
    assert first is not None
    if first.get_legend() is not None:
        legend_above(first, 4, 1.12 if panels[0][0].title else 1.0)
    return first


def plot_limit(limit: Limit, y: Labelled, ax: Axes) -> None:
    """Draw a ``limit`` of ``y`` across ``ax``."""
    up = scale(y.values, y.quantity.unit)
    ax.axhline(float(up(limit.value)), color=BLACK, linestyle="--", linewidth=0.9)


def plot_points(x: Labelled, y: Labelled, groups: Sequence[tuple[str, RealArray, RealArray]], ax: Axes) -> Axes:
    """Draw the points of all cases in named ``groups`` (x, y in SI) on ``ax``; ``x`` and ``y`` set
    the scales."""
    along, up = scale(x.values, x.quantity.unit), scale(y.values, y.quantity.unit)
    for number, (name, across, values) in enumerate(groups):
        colour, marker = COLOURS[number % len(COLOURS)], MARKERS[number % len(MARKERS)]
        order = np.argsort(across)
        ax.plot(
            along(across)[order],
            up(values)[order],
            color=colour,
            marker=marker,
            markersize=3.5,
            linestyle="",
            markerfacecolor="none",
            label=literal(name) or None,
        )
    if wide_range(x.values):
        ax.set_xscale("log")
    if wide_range(y.values):
        ax.set_yscale("log")
    ax.set(xlabel=with_unit(x.quantity.label, along), ylabel=with_unit(y.quantity.label, up))
    ax.grid(visible=True, color=NO_CONTACT, linewidth=0.6)
    ax.set_axisbelow(True)
    return legend_above(ax) if any(name for name, _, _ in groups) else ax


def plot_planes(x: Labelled, y: Labelled, z: Labelled, titles: Sequence[str], limit: Limit | None, ax: Axes) -> Axes:
    """Draw the quantity ``z`` (panels, nx, ny) over two axes, a cell a case, in panels with their
    ``titles`` in place of ``ax``, and where its ``limit`` is reached."""
    from matplotlib.colors import LogNorm, Normalize

    along, over, up = (scale(item.values, item.quantity.unit) for item in (x, y, z))
    values = up(z.values)
    good = values[np.isfinite(values)]
    low, high = (float(good.min()), float(good.max())) if good.size else (0.0, 1.0)
    norm = LogNorm(low, high) if wide_range(z.values) else Normalize(low, high if high > low else low + 1.0)
    across, upward = np.argsort(x.values), np.argsort(y.values)
    figure = ax.figure
    ax.set_axis_off()
    places = figure.add_gridspec(1, len(titles), wspace=0.08)
    drawn: list[Axes] = []
    for number, title in enumerate(titles):
        here = figure.add_subplot(
            places[0, number], sharex=drawn[0] if drawn else None, sharey=drawn[0] if drawn else None
        )
        cells = np.ma.masked_invalid(values[number][np.ix_(across, upward)].T)
        image = here.imshow(cells, norm=norm, cmap="viridis", origin="lower", aspect="auto")
        if limit is not None and cells.count() and cells.min() < float(up(limit.value)) < cells.max():
            here.contour(cells, levels=[float(up(limit.value))], colors=[VERMILLION], linewidths=1.6)
        _say_cells(x, y, Labelled(z.quantity, z.values[number]), limit, here, title)
        here.set_title(literal(title), fontsize=8.5)
        here.set_xlabel(with_unit(x.quantity.label, along))
        here.tick_params(labelleft=number == 0)
        drawn.append(here)
    drawn[0].set_xticks(*_named(along(x.values)[across], 4 if len(titles) > 1 else MOST_TICKS))
    drawn[0].set_yticks(*_named(over(y.values)[upward], MOST_TICKS))
    drawn[0].set_ylabel(with_unit(y.quantity.label, over))
    figure.colorbar(image, ax=drawn, pad=0.02).set_label(with_unit(z.quantity.label, up))
    if limit is not None:
        text = f"limit: at {'least' if limit.least else 'most'} {float(up(limit.value)):.4g} {up.symbol}".rstrip()
        drawn[0].plot([], [], color=VERMILLION, linewidth=1.6, label=text)
        legend_above(drawn[0], height=1.12 if titles[0] else 1.0)
    return drawn[0]


def _say_cells(x: Labelled, y: Labelled, z: Labelled, limit: Limit | None, ax: Axes, title: str) -> None:
    """Let every cell of a map of ``z`` (nx, ny) on ``ax`` say where it lies, its value, and whether
    the ``limit`` holds there; a line that is not seen for each row, the topmost first."""
    across, upward = np.argsort(x.values), np.argsort(y.values)
    for row in range(upward.size)[::-1]:
        texts = []
        for column in across:
            value = float(z.values[column, upward[row]])
            where = (
                *([title] if title else []),
                _with_value(x, x.values[column]),
                _with_value(y, y.values[upward[row]]),
            )
            said = _with_value(z, value) if np.isfinite(value) else f"{z.quantity.label} not known"
            if limit is not None and np.isfinite(value):
                good = value >= limit.value if limit.least else value <= limit.value
                end = f"at {'least' if limit.least else 'most'} {show(limit.value, z.quantity.unit)}"
                said = f"{said}, limit ({end}) {'met' if good else 'missed'}"
            texts.append(f"{', '.join(where)}: {said}")
        (line,) = ax.plot(np.arange(across.size), np.full(across.size, row), linestyle="", scalex=False, scaley=False)
        saying(line, texts)


def _with_value(what: Labelled, value: float) -> str:
    return f"{what.quantity.label} {show(float(value), what.quantity.unit)}"


def _named(values: RealArray, most: int) -> tuple[RealArray, list[str]]:
    """Places of cells with their ``values``, of at ``most`` so many."""
    chosen = np.unique(np.linspace(0, values.size - 1, min(values.size, most)).round().astype(int))
    return chosen, [f"{values[number]:.3g}" for number in chosen]
