"""Figures of rolling: where a contact sticks and slips, traction along the rolling direction,
creep-force curves, forces over the distance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...core.units import show
from ...plots.maps import plot_classes
from ...plots.picture import BLACK, BLUE, GREEN, ORANGE, VERMILLION, Plot, legend_above, scale
from ..friction.figures import CLASSES
from ..friction.fretting import OPEN, SLIPS, STICKS
from .rolling import DIRECTIONS

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class RollingPicture:
    """What figures of rolling are drawn from: values of a result or of its file, SI.

    ``traction`` and ``slip`` are (2, nx, ny), ``bound`` (nx, ny); ``curve`` and ``path`` columns by
    name, empty if there are none.
    """

    problem: ContactProblem
    direction: str
    traction: RealArray
    slip: RealArray
    bound: RealArray
    curve: Mapping[str, RealArray] = field(default_factory=dict)
    path: Mapping[str, RealArray] = field(default_factory=dict)

    @property
    def kinds(self) -> RealArray:
        """(nx, ny): open, sticking or slipping."""
        slips = np.any(self.slip != 0.0, axis=0)
        return np.where(self.bound > 0.0, np.where(slips, float(SLIPS), float(STICKS)), float(OPEN))


def plot_rolling_map(shown: RollingPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` where the rolling contact is open, sticks and slips, with an arrow along which
    it rolls."""
    grid, axis = shown.problem.grid, DIRECTIONS[shown.direction]
    plot_classes(shown.kinds, grid, ax, CLASSES)
    if min(grid.shape) > 1:
        step = [0.0, 0.0]
        step[axis.axis] = 0.16 * axis.sign
        at = [0.12, 0.1]
        at[axis.axis] -= 0.5 * step[axis.axis]
        ax.annotate(
            "",
            xy=(at[0] + step[0], at[1] + step[1]),
            xytext=(at[0], at[1]),
            xycoords="axes fraction",
            arrowprops={"arrowstyle": "-|>", "color": BLACK, "lw": 1.4},
        )
    return ax


def plot_rolling_section(shown: RollingPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the shear traction along the rolling direction, on the row with the largest
    bound, between the bounds of the friction."""
    grid, axis = shown.problem.grid, DIRECTIONS[shown.direction]
    finite = np.where(np.isfinite(shown.bound), shown.bound, 0.0)
    measure = finite if finite.any() else np.hypot(*shown.traction)
    row = int(np.argmax(measure.sum(axis=axis.axis)))
    spacing, count = grid.spacing[axis.axis], grid.shape[axis.axis]

    def along(values: RealArray) -> RealArray:
        return np.asarray(np.take(values, row, axis=1 - axis.axis))

    size = np.array([np.abs(part).sum() for part in shown.traction])
    leading = int(np.argmax(size))
    bound = np.where(np.isfinite(along(shown.bound)), along(shown.bound), np.nan)
    length, in_pa = scale(count * spacing, "m"), scale(np.append(bound, along(shown.traction[leading])), "Pa")
    x = length((np.arange(count) + 0.5) * spacing)
    ax.fill_between(x, -in_pa(bound), in_pa(bound), color="0.88", linewidth=0.0, label="bound of the friction")
    names = ("x", "y")
    for component, colour in ((leading, BLUE), (1 - leading, ORANGE)):
        if component == leading or size[component] > 1e-3 * size[leading]:
            ax.plot(
                x, in_pa(along(shown.traction[component])), color=colour, label=f"traction along {names[component]}"
            )
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    name, across = names[axis.axis], names[1 - axis.axis]
    place = f", at {across} = {show((row + 0.5) * grid.spacing[1 - axis.axis], 'm')}" if min(grid.shape) > 1 else ""
    arrow = f"{name} ({length.symbol}){place}; rolls {'to the right' if axis.sign > 0 else 'to the left'}"
    ax.set(xlabel=arrow, ylabel=f"shear traction ({in_pa.symbol})", xlim=(0.0, float(length(count * spacing))))
    return legend_above(ax)


_STYLES = {
    "": ("this contact", BLUE, "-", "."),
    "fastsim": ("FASTSIM", ORANGE, "--", ""),
    "carter": ("Carter", GREEN, "--", ""),
}


def plot_creep_curve(shown: RollingPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the creep-force curve: size of the tangential force against the share of the
    creepages asked for, theories beside it."""
    curve = shown.curve
    forces = {
        name: np.hypot(
            curve[f"{name}{'_' * bool(name)}longitudinal_force"], curve[f"{name}{'_' * bool(name)}lateral_force"]
        )
        for name in _STYLES
        if f"{name}{'_' * bool(name)}longitudinal_force" in curve
    }
    in_n = scale(np.concatenate(list(forces.values())), "N")
    for name, force in forces.items():
        label, colour, line, marker = _STYLES[name]
        ax.plot(
            np.append(0.0, curve["share"]),
            np.append(0.0, in_n(force)),
            color=colour,
            linestyle=line,
            marker=marker,
            label=label,
        )
    limit = float(np.atleast_1d(curve["friction_limit"])[0])
    if np.isfinite(limit):
        ax.axhline(float(in_n(limit)), color=BLACK, linewidth=0.7, linestyle=":", label="limit of the friction")
    ax.set(
        xlabel="share of the creepages asked for",
        ylabel=f"tangential force ({in_n.symbol})",
        xlim=(0.0, None),
        ylim=(0.0, None),
    )
    return legend_above(ax)


def plot_rough_path(shown: RollingPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the forces of a rough wheel on the body along x and y over the distance
    rolled."""
    path = shown.path
    length, in_n = scale(path["distance"], "m"), scale(np.append(path["force_x"], path["force_y"]), "N")
    for name, colour in (("force_x", BLUE), ("force_y", VERMILLION)):
        ax.plot(length(path["distance"]), in_n(path[name]), color=colour, label=f"along {name[-1]}")
    ax.axvline(
        float(length(float(np.atleast_1d(path["running_in"])[0]))),
        color="0.6",
        linewidth=0.7,
        linestyle=":",
        label="end of the running-in",
    )
    ax.set(xlabel=f"distance rolled ({length.symbol})", ylabel=f"force on the body ({in_n.symbol})", xlim=(0.0, None))
    return legend_above(ax, columns=3)


ROLLING_PLOTS = (
    Plot(
        "rolling_map",
        "Stick and slip as it rolls",
        "Where the contact is open, sticks and slips as it rolls along the arrow; shares of the nominal area. "
        "Material enters at the head of the arrow.",
        plot_rolling_map,
        "map",
    ),
    Plot(
        "rolling_section",
        "Traction as it rolls",
        "Shear traction on the body along the rolling direction, on the row with the largest bound, between "
        "the bounds that the friction sets.",
        plot_rolling_section,
    ),
)
"""Figures of every rolling contact."""

CURVE_PLOT = Plot(
    "creep_curve",
    "Creep-force curve",
    "Tangential force against the share of the creepages that were asked for. Theories of smooth wheels of "
    "equal bodies are drawn beside it where they hold.",
    plot_creep_curve,
)
PATH_PLOT = Plot(
    "rolling_path",
    "Force of the rough wheel",
    "Forces on the body over the distance rolled; means are taken after the running-in.",
    plot_rough_path,
)
