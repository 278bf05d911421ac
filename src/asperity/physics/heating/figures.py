"""Figures of frictional heating: flash temperature and share of the heat as maps, the distribution
over the contact, a section with depth, and the flash temperature over the load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...plots.maps import Field, Look, map_of
from ...plots.picture import BLACK, BLUE, VERMILLION, Plot, legend_above, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEAT_MAP = "inferno"
"""Colours of temperatures."""


@dataclass(frozen=True, eq=False)
class HeatPicture:
    """What figures of heating are drawn from: values of a result or of its file, SI."""

    problem: ContactProblem
    values: Mapping[str, Any]

    def array(self, name: str) -> RealArray:
        """The values of that name; empty where there are none."""
        return np.asarray(self.values.get(name, []), float)


def rise_field(shown: HeatPicture) -> Field:
    """Temperature rise of the hotter surface at every point: on the contact both are one."""
    bodies = [shown.array("flash_body"), shown.array("flash_counter_body")]
    there = [body for body in bodies if np.isfinite(body).all()]
    rise = shown.array("flash_rise")
    around = np.max(there, axis=0) if there else rise
    look = Look("K", "temperature rise", HEAT_MAP, from_zero=False, reduced="max")
    return Field(np.where(np.isfinite(rise), rise, around), shown.problem.grid, look)


def share_field(shown: HeatPicture) -> Field:
    """Share of the heat that goes into the body in percent; below 0 or above 100 where one body
    warms the other, blank where none is made."""
    heat, into = shown.array("friction_heat"), shown.array("friction_heat_body")
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(heat > 0.0, 100.0 * np.clip(into / heat, -0.5, 1.5), np.nan)
    look = Look("%", "share of the heat into the body", "RdBu_r", from_zero=False, blank="no heat")
    return Field(share, shown.problem.grid, look)


def plot_distribution(shown: HeatPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the share of the contact that is hotter than a temperature rise."""
    level, part = shown.array("flash_level"), shown.array("flash_part")
    ax.plot(level, 100.0 * part, color=BLUE)
    for name, colour, label in (
        ("flash_mean", BLACK, "mean"),
        ("flash_heat_mean", VERMILLION, "mean weighted with the heat"),
    ):
        ax.axvline(float(shown.values[name]), color=colour, linestyle="--", linewidth=0.8, label=label)
    ax.set(xlabel="temperature rise (K)", ylabel="contact that is hotter (%)", ylim=(0.0, 100.0))
    return legend_above(ax)


def plot_section(shown: HeatPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the temperature rise on a section through both bodies at the hottest point,
    the body below."""
    from matplotlib.colors import Normalize

    depth, grid = shown.array("heat_depth"), shown.problem.grid
    parts = [shown.array(f"heat_section_{which}") for which in ("counter_body", "body")]
    high = max(float(np.nanmax(part)) for part in parts if np.isfinite(part).any())
    norm = Normalize(min(0.0, *(float(np.nanmin(part)) for part in parts if np.isfinite(part).any())), high)
    in_m, deep = scale(grid.size[0], "m"), scale(float(depth[-1]), "m")
    x = in_m((np.arange(grid.shape[0]) + 0.5) * grid.spacing[0])
    drawn: Any = None
    for part, sign in zip(parts, (1.0, -1.0), strict=True):
        if np.isfinite(part).any():
            drawn = ax.pcolormesh(x, sign * deep(depth), part, cmap=HEAT_MAP, norm=norm, shading="gouraud")
    ax.axhline(0.0, color="0.8", linewidth=0.8)
    ax.figure.colorbar(drawn, ax=ax, label="temperature rise (K)")
    ax.set(xlabel=f"x ({in_m.symbol})", ylabel=f"counter body above, body below ({deep.symbol})")
    return ax


def plot_path(shown: HeatPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the flash temperature of the steps of a load path over their mean pressure."""
    load, rise = shown.array("path_flash_load"), shown.array("path_flash_temperature")
    in_pa = scale(load, "Pa")
    top = int(np.argmax(load))
    for part, colour, label in ((slice(0, top + 1), BLUE, "loading"), (slice(top, None), VERMILLION, "unloading")):
        if rise[part].size > 1 or label == "loading":
            ax.plot(in_pa(load[part]), rise[part], color=colour, marker=".", label=label)
    ax.set(
        xlabel=f"mean contact pressure ({in_pa.symbol})",
        ylabel="flash temperature (K)",
        xlim=(0.0, None),
        ylim=(0.0, None),
    )
    return legend_above(ax)


RISE_PLOT = map_of(
    "flash_rise",
    "Flash temperature",
    "Steady temperature rise over the bulk while the surfaces slide: on the contact that of both, elsewhere that of "
    "the hotter surface. Behind the spots of the moving body lie their wakes.",
    rise_field,
    by_step=False,
)
SHARE_PLOT = map_of(
    "heat_share",
    "Share of the heat",
    "Share of the heat that goes into the body, at each point of contact. It is negative where the moving counter body "
    "arrives hot and warms the body.",
    share_field,
    by_step=False,
)
DISTRIBUTION_PLOT = Plot(
    "flash_distribution",
    "Distribution of the temperature",
    "Share of the contact that is hotter than a temperature rise.",
    plot_distribution,
)
SECTION_PLOT = Plot(
    "heat_section",
    "Temperature below the surface",
    "Temperature rise on a section along x through the hottest point, in both bodies. Depth is drawn larger.",
    plot_section,
)
PATH_PLOT = Plot(
    "flash_path",
    "Flash temperature over the load",
    "Flash temperature at each step of the load path.",
    plot_path,
)
