"""A cut through the contact: the deformed surfaces above, the pressure between them below."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..contact.result import ContactResult
from ..core.arrays import RealArray
from ..core.units import show
from .style import BLACK, BLUE, VERMILLION, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHARE = 0.36
"""Share of the height of the axes that the pressure takes, at the bottom."""


def plot_section(result: ContactResult, ax: Axes) -> Axes:
    """Draw the cut of ``result`` along x through the highest pressure on ``ax``; pressure on a second y axis.

    The composite rough surface carries all deformation of both bodies, so the counter surface is drawn flat.
    Without contact the cut goes through the smallest gap.
    """
    row = _row(result)
    grid = result.problem.grid
    length = scale(grid.size[0], "m")
    x = length((np.arange(grid.shape[0]) + 0.5) * grid.spacing[0])
    counter = np.full(x.shape, result.offset)
    rough = result.offset - result.gap[:, row]
    middle = float(np.mean(rough))
    rough, counter = rough - middle, counter - middle
    height = scale(np.concatenate([rough, counter]), "m")
    _draw_surfaces(x, height(rough), height(counter), ax)
    ax.set(
        xlabel=f"x ({length.symbol})"
        + (f", at y = {show((row + 0.5) * grid.spacing[1], 'm')}" if grid.shape[1] > 1 else ""),
        ylabel=f"height ({height.symbol})",
        xlim=(0.0, float(length(grid.size[0]))),
    )
    _draw_pressure(x, result.pressure[:, row], ax)
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.3, borderpad=0.2)
    return ax


def _row(result: ContactResult) -> int:
    if result.contact.any():
        return int(np.argmax((result.pressure == result.pressure.max()).sum(axis=0)))  # plastic: many are highest
    return int(np.unravel_index(np.argmin(result.gap), result.gap.shape)[1])


def _draw_surfaces(x: RealArray, rough: RealArray, counter: RealArray, ax: Axes) -> None:
    low, high = float(min(rough.min(), counter.min())), float(max(rough.max(), counter.max()))
    span = (high - low) or 1.0
    bottom, top = low - span * (SHARE + 0.06) / (1.0 - SHARE - 0.16), high + span * 0.10 / (1.0 - SHARE - 0.16)
    ax.fill_between(x, rough, low - 0.04 * span, color="0.80", linewidth=0.0)
    ax.fill_between(x, counter, top, color="0.90", linewidth=0.0)
    ax.plot(x, counter, color=BLACK, linewidth=1.0, label="counter surface")
    ax.plot(x, rough, color=BLUE, linewidth=1.0, label="deformed rough surface")
    ax.set_ylim(bottom, top)
    ax.set_yticks([tick for tick in ax.get_yticks() if low - 0.02 * span <= tick <= top])


def _draw_pressure(x: RealArray, pressure: RealArray, ax: Axes) -> None:
    from matplotlib.ticker import MaxNLocator

    in_unit = scale(pressure, "Pa")
    drawn = in_unit(pressure)
    largest = float(drawn.max()) or 1.0
    twin = ax.twinx()
    twin.fill_between(x, drawn, color=VERMILLION, alpha=0.25, linewidth=0.0)
    twin.plot(x, drawn, color=VERMILLION, linewidth=1.0)
    ax.plot([], [], color=VERMILLION, label="pressure")
    twin.set_ylim(0.0, 1.12 * largest / SHARE)
    ticks = [float(tick) for tick in MaxNLocator(3).tick_values(0.0, largest) if tick <= 1.12 * largest]
    twin.set_yticks(ticks)
    twin.set_ylabel(f"pressure ({in_unit.symbol})", color=VERMILLION, y=SHARE / 2.0)
    twin.tick_params(axis="y", colors=VERMILLION)
