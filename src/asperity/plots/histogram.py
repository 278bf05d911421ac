"""How pressure and gap are distributed over the area."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..contact.laws import LimitByDepth
from ..contact.measure import distribution
from ..contact.result import ContactResult
from ..core.arrays import RealArray
from .style import BLACK, SKY, VERMILLION, Scale, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_pressure_histogram(result: ContactResult, ax: Axes) -> Axes:
    """Draw the probability density of the pressure over the real contact area of ``result`` on ``ax``.

    Marked are the mean real pressure and, if it is one number, the hardness where it is reached.
    """
    pressure = result.pressure[result.contact]
    in_unit = scale(pressure, "Pa")
    if not _histogram(pressure, in_unit, ax, "contact pressure", "no contact"):
        return ax
    _mark(ax, float(in_unit(result.mean_real_pressure)), f"mean {{:.3g}} {in_unit.symbol}", BLACK, "--")
    cap = result.problem.law.pressure_cap()
    if result.plastic.any() and not isinstance(cap, np.ndarray) and not isinstance(result.problem.law, LimitByDepth):
        _mark(ax, float(in_unit(cap)), f"hardness {{:.3g}} {in_unit.symbol}", VERMILLION, ":")
    return _with_legend(ax)


def plot_gap_histogram(result: ContactResult, ax: Axes) -> Axes:
    """Draw the probability density of the gap over the open area of ``result`` on ``ax``, with the mean gap marked."""
    gap = result.gap[~result.contact]
    in_unit = scale(gap, "m")
    if not _histogram(gap, in_unit, ax, "gap", "full contact"):
        return ax
    _mark(ax, float(in_unit(result.mean_gap)), f"mean over the whole area {{:.3g}} {in_unit.symbol}", BLACK, "--")
    return _with_legend(ax)


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


def _mark(ax: Axes, at: float, label: str, color: str, linestyle: str) -> None:
    ax.axvline(at, color=color, linestyle=linestyle, label=label.format(at))


def _with_legend(ax: Axes) -> Axes:
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.3, borderpad=0.2)
    return ax
