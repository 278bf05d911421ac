"""Figures of sealing: where the fluid flows and which throats decide, its pressure, the path of
contact that closes the gap, leak rates against the load; flow factors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...plots.maps import Field, Kinds, Look, map_of, plot_classes, plot_map
from ...plots.picture import BLACK, BLUE, GREEN, VERMILLION, Plot, legend_above, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class LeakPicture:
    """What figures of sealing are drawn from: values of a result or of its file, SI."""

    problem: ContactProblem
    values: Mapping[str, Any]
    facts: Mapping[str, Any]

    def field(self, name: str) -> RealArray:
        """(nx, ny) array of the values."""
        return np.asarray(self.values[name], float)

    def column(self, name: str) -> RealArray:
        """One-dimensional array of the values; empty where there is none."""
        return np.atleast_1d(np.asarray(self.values.get(name, []), float))


def flow_field(shown: LeakPicture) -> Field:
    """Flow per width over its mean, logarithmic, blank where nothing flows."""
    size = np.hypot(shown.field("leak_flux_x"), shown.field("leak_flux_y"))
    look = Look("1", "flow per width / mean", "viridis", log=True, blank="no flow", reduced="max")
    return Field(np.where(size > 0.0, size, np.nan), shown.problem.grid, look)


NUMBERED = 3
"""Throats whose numbers stand beside their circles: those of the largest shares."""


def plot_flow(shown: LeakPicture, ax: Axes) -> Axes:
    """Draw the flow on ``ax`` with lines along it and circles around the throats."""
    plot_map(flow_field(shown), ax)
    grid = shown.problem.grid
    # the map is drawn in a unit of length of its own
    low, high = ax.get_xlim()
    factor = (high - low) / grid.size[0]
    x, y = ((np.arange(n) + 0.5) * step * factor for n, step in zip(grid.shape, grid.spacing, strict=True))
    along, across = shown.field("leak_flux_x"), shown.field("leak_flux_y")
    if np.any(along) or np.any(across):
        ax.streamplot(x, y, along.T, across.T, color="0.85", linewidth=0.5, arrowsize=0.5, density=1.4)
    places = np.stack([shown.column("throat_x"), shown.column("throat_y")]) * factor
    ax.scatter(places[0], places[1], s=60.0, facecolors="none", edgecolors=VERMILLION, linewidths=1.2, label="throats")
    for number, place in enumerate(places.T[:NUMBERED], start=1):
        ax.annotate(str(number), place, (5.0, 4.0), textcoords="offset points", color=VERMILLION, weight="bold")
    ax.set(xlim=(low, high), ylim=(0.0, grid.size[1] * factor))
    return ax


def pressure_field(shown: LeakPicture) -> Field:
    """Pressure of the fluid, blank where there is none."""
    pressure = shown.field("fluid_pressure")
    look = Look("Pa", "pressure of the fluid", "cividis", from_zero=False, blank="no fluid")
    return Field(np.where(pressure > 0.0, pressure, np.nan), shown.problem.grid, look)


CLASSES = (("contact", "0.45"), ("fluid", "#cfe8f7"), ("dry gap", "#f2f2f2"), ("closed path", VERMILLION))


def closed_kinds(shown: LeakPicture) -> Kinds:
    """Contact, gaps that the fluid reaches and those that it does not, and the path that closes the
    gap."""
    grid, pressure = shown.problem.grid, shown.field("fluid_pressure")
    kinds = np.where(pressure > 0.0, 1.0, np.where(shown.field("leak_gap") > 0.0, 2.0, 0.0))
    at = [
        np.minimum((shown.column(f"closed_path_{a}") / step).astype(int), n - 1)
        for a, step, n in zip("xy", grid.spacing, grid.shape, strict=True)
    ]
    kinds[at[0], at[1]] = 3.0
    return Kinds(kinds, grid, CLASSES)


def plot_closed(shown: LeakPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the path of contact that closes the gap."""
    found = closed_kinds(shown)
    return plot_classes(found.kinds, found.grid, ax, found.classes)


def plot_path(shown: LeakPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the leak rates of a load path against the mean contact pressure, and where the
    gap closes."""
    rates, loads = shown.column("path_leak_rate"), shown.column("path_leak_load")
    in_pa = scale(loads, "Pa")
    leaks = rates > 0.0
    ax.plot(in_pa(loads[leaks]), 1e9 * rates[leaks], color=BLUE, marker=".", label="leaks")
    if not leaks.all():
        lowest = 1e9 * rates[leaks].min()
        ax.plot(in_pa(loads[~leaks]), np.full(int((~leaks).sum()), lowest), "v", color=BLACK, label="sealed")
    closing = float(shown.values["sealing_pressure"])
    if np.isfinite(closing):
        ax.axvline(float(in_pa(closing)), color=VERMILLION, linestyle="--", linewidth=0.8, label="the gap closes")
    ax.set(xlabel=f"mean contact pressure ({in_pa.symbol})", ylabel="leak rate (mm³/s)", yscale="log")
    return legend_above(ax, columns=3)


FLOW_PLOT = Plot(
    "leak_flow",
    "Flow and throats",
    "Flow per width over its mean, with lines along it. Circles are the throats that lose half of the pressure, with "
    "the numbers of the first in the table.",
    plot_flow,
    "map",
    shows=flow_field,
    by_step=False,
)
PRESSURE_PLOT = map_of(
    "fluid_pressure",
    "Pressure of the fluid",
    "Pressure of the fluid in the gap; blank where there is none. Under a mean gradient it repeats but for its fall.",
    pressure_field,
    by_step=False,
)
CLOSED_PLOT = map_of(
    "closed_path",
    "Path of contact that seals",
    "A shortest path of contact across the flow, which closes the gap.",
    closed_kinds,
    by_step=False,
)
PATH_PLOT = Plot(
    "leak_path",
    "Leak rate against the load",
    "Leak rate at each step of the load path, of a gas at one atmosphere, and the load at which the gap closes.",
    plot_path,
)


# Flow factors.


@dataclass(frozen=True, eq=False)
class FactorPicture:
    """What the figure of flow factors is drawn from: columns of the table by their names."""

    columns: Mapping[str, RealArray]
    facts: Mapping[str, Any]


def plot_factors(shown: FactorPicture, ax: Axes) -> Axes:
    """Draw the flow factors on ``ax`` against the separation, and Patir and Cheng's fits."""
    columns, along = shown.columns, str(shown.facts["direction"])
    ratio = columns["separation_ratio"]
    labels = (f"φ along {along}", f"φ along {'yx'['xy'.index(along)]}", "$φ_s$")
    for name, color, label in zip(
        ("pressure_along", "pressure_across", "shear"), (BLUE, VERMILLION, GREEN), labels, strict=True
    ):
        ax.plot(ratio, columns[name], color=color, marker=".", label=label)
        error = columns[f"{name}_error"]
        if np.isfinite(error).all():
            ax.fill_between(ratio, columns[name] - error, columns[name] + error, color=color, alpha=0.2, linewidth=0.0)
    fits = (("fitted_pressure", BLACK, "Patir & Cheng, φ"), ("fitted_shear", "0.5", "Patir & Cheng, $φ_s$"))
    for name, color, label in fits:
        ax.plot(ratio, columns[name], color=color, linestyle="--", linewidth=0.8, label=label)
    ax.set(xlabel="separation of the mean planes / rms height", ylabel="flow factor")
    ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    return legend_above(ax, columns=3)


FACTORS_PLOT = Plot(
    "flow_factors",
    "Flow factors",
    "Flow by pressure over that of smooth surfaces at the same separation, φ, and what the roughness carries by shear, "
    "φ_s; dashed the isotropic fits of Patir and Cheng. Bands are standard errors.",
    plot_factors,
)
