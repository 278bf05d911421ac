"""How the pressure is distributed over the real contact area."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..contact.result import ContactResult
from .style import BLACK, SKY, VERMILLION, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_pressure_histogram(result: ContactResult, ax: Axes) -> Axes:
    """Draw the probability density of the pressure over the real contact area of ``result`` on ``ax``.

    Marked are the mean real pressure and, if it is one number, the hardness where it is reached.
    """
    pressure = result.pressure[result.contact]
    in_unit = scale(pressure, "Pa")
    ax.set(xlabel=f"contact pressure ({in_unit.symbol})", ylabel=f"probability density (1/{in_unit.symbol})")
    if pressure.size == 0:
        ax.text(0.5, 0.5, "no contact", transform=ax.transAxes, ha="center", va="center")
        return ax
    bins = int(np.clip(2.0 * pressure.size ** (1.0 / 3.0), 5, 60))  # Rice's rule
    top = float(in_unit(pressure.max()))
    ax.hist(in_unit(pressure), bins, range=(0.0, top), density=True, color=SKY, edgecolor="white", linewidth=0.4)
    mean = float(in_unit(result.mean_real_pressure))
    ax.axvline(mean, color=BLACK, linestyle="--", label=f"mean {mean:.3g} {in_unit.symbol}")
    cap = result.problem.law.pressure_cap()
    if result.plastic.any() and not isinstance(cap, np.ndarray):
        hardness = float(in_unit(cap))
        ax.axvline(hardness, color=VERMILLION, linestyle=":", label=f"hardness {hardness:.3g} {in_unit.symbol}")
    ax.set_xlim(0.0, 1.04 * top)
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.3, borderpad=0.2)
    return ax
