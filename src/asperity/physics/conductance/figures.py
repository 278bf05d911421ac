"""Figures of conductance: where the flow crosses, how the potential is constricted around it, and
conductance over the load of a path."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...plots.maps import Field, Look, map_of
from ...plots.picture import BLUE, GAP_MAP, PRESSURE_MAP, VERMILLION, Plot, legend_above, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NAMES = {"electrical": "current", "thermal": "heat"}
"""What flows."""


@dataclass(frozen=True, eq=False)
class Flowing:
    """What figures are drawn from: of each flow by its name ``density`` and ``drop`` (nx, ny) and
    ``path``, the conductance per area at each step; ``pressure`` of the steps in Pa, empty without
    a path."""

    problem: ContactProblem
    density: dict[str, RealArray]
    drop: dict[str, RealArray]
    path: dict[str, RealArray]
    pressure: RealArray


UNITS = {"electrical": "S/m²", "thermal": "W/(m²·K)"}
"""Of flux density per unit drop."""

SI = {"electrical": "S/m**2", "thermal": "W/(m**2*K)"}
"""The same as units are read."""


def density_field(shown: Flowing, flow: str) -> Field:
    """Flux density per unit drop, on three decades; no flow is blank."""
    density = shown.density[flow]
    crosses = np.isfinite(density) & (density > 0.0)
    look = Look(
        UNITS[flow],
        f"{NAMES[flow]} density per drop",
        PRESSURE_MAP,
        log=bool(crosses.any()),
        blank="no flow",
        blank_value=0.0,
        reduced="max",
    )
    return Field(np.where(crosses, density, np.nan), shown.problem.grid, look)


def drop_field(shown: Flowing, flow: str) -> Field:
    """Share of the drop between the bodies that is spent at each point: all in contact, less
    around it where the flow spreads."""
    look = Look("%", "potential at the interface / drop", GAP_MAP, from_zero=False)
    return Field(100.0 * shown.drop[flow], shown.problem.grid, look)


def plot_path(shown: Flowing, ax: Axes, flow: str) -> Axes:
    """Draw on ``ax`` the conductance per area over the mean pressure of the steps, loading and
    unloading."""
    values, pressure = shown.path[flow], shown.pressure
    in_pa, per_area = scale(pressure, "Pa"), scale(values, SI[flow])
    top = int(np.argmax(pressure))
    for part, colour, label in ((slice(0, top + 1), BLUE, "loading"), (slice(top, None), VERMILLION, "unloading")):
        if values[part].size > 1 or label == "loading":
            ax.plot(in_pa(pressure[part]), per_area(values[part]), color=colour, marker=".", label=label)
    ax.set(
        xlabel=f"mean pressure ({in_pa.symbol})",
        ylabel=f"{flow} conductance per area ({per_area.symbol})",
        xlim=(0.0, None),
        ylim=(0.0, None),
    )
    return legend_above(ax)


def _plots(flow: str) -> tuple[Plot, Plot, Plot]:
    name = NAMES[flow]
    return (
        map_of(
            f"{flow}_density",
            f"{name.capitalize()} density",
            f"Density of the {name} through the interface per unit drop between the bodies. It is largest at "
            "the edges of the spots, where it grows without bound but for the pixels.",
            partial(density_field, flow=flow),
            by_step=False,
        ),
        map_of(
            f"{flow}_drop",
            f"Constriction of the {name}",
            "Potential at the interface over the drop between the bodies: all of it in contact, and the lower the less "
            "the flow is constricted around a point.",
            partial(drop_field, flow=flow),
            by_step=False,
        ),
        Plot(
            f"{flow}_path",
            f"{flow.capitalize()} conductance over the load",
            f"{flow.capitalize()} conductance per nominal area over the mean pressure of the steps. Where points have "
            "yielded, the unloaded joint conducts better than before.",
            partial(plot_path, flow=flow),
        ),
    )


PLOTS = {flow: _plots(flow) for flow in NAMES}
"""Maps of density and potential, and the curve of a path, by flow."""
