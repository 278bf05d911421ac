"""Figures of adhesion: where the surfaces touch and attract, net traction, and the loop of force
and approach."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.history import HistoryResult
from ...contact.result import ContactResult
from ...plots.maps import Kinds, plot_map
from ...plots.picture import BLACK, BLUE, NO_CONTACT, ORANGE, VERMILLION, Plot, legend_above, scale
from .loop import adhesion_loop

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CLASSES = (("apart", NO_CONTACT), ("attracts", ORANGE), ("touches", BLUE))
"""Name and colour of each kind of point, in the order of their numbers."""


def adhesion_kinds(result: ContactResult) -> Kinds:
    """Where the surfaces of ``result`` touch, and where they attract within the range; InputError
    if it has no adhesion."""
    law = result.require_adhesion().law
    kinds = np.where(result.contact, 2.0, np.where(result.gap < law.range, 1.0, 0.0))
    return Kinds(kinds, result.problem.grid, CLASSES)


def plot_adhesion(result: ContactResult, ax: Axes) -> Axes:
    """Draw on ``ax`` where the surfaces of ``result`` touch, and where they attract within the
    range."""
    return plot_map(adhesion_kinds(result), ax)


def plot_traction_section(result: ContactResult, ax: Axes) -> Axes:
    """Draw pressure and attraction of ``result`` along x through the largest pressure on ``ax``."""
    found, grid = result.require_adhesion(), result.problem.grid
    row = int(np.unravel_index(np.argmax(result.pressure + found.attraction), grid.shape)[1])
    net = (result.pressure - found.attraction)[:, row]
    length, in_pa = scale(grid.size[0], "m"), scale(net, "Pa")
    x = length((np.arange(grid.shape[0]) + 0.5) * grid.spacing[0])
    ax.plot(x, in_pa(net), color=BLACK, label="net traction")
    ax.plot(x, -in_pa(found.attraction[:, row]), color=ORANGE, linestyle="--", label="attraction")
    ax.axhline(0.0, color="0.8", linewidth=0.5)
    ax.set(xlabel=f"x ({length.symbol})", ylabel=f"traction ({in_pa.symbol})", xlim=(0.0, float(length(grid.size[0]))))
    return legend_above(ax)


def plot_adhesion_loop(history: HistoryResult, ax: Axes) -> Axes:
    """Draw the external force of ``history`` against the approach on ``ax``: the way there, the way
    back, jumps and pull-off."""
    loop = adhesion_loop(history.steps)
    in_m, in_n = scale(loop.approach, "m"), scale(loop.force, "N")
    x, y = in_m(loop.approach), in_n(loop.force)
    deepest = int(np.argmax(loop.approach))
    ax.axhline(0.0, color="0.8", linewidth=0.5)
    ax.plot(x[: deepest + 1], y[: deepest + 1], color=BLACK, marker=".", linestyle="--", label="approach")
    if deepest + 1 < x.size:
        ax.plot(x[deepest:], y[deepest:], color=BLUE, marker=".", label="parting")
    jumps = np.flatnonzero(loop.jumped)
    for number, step in enumerate(jumps):
        pair = slice(max(step - 1, 0), step + 1)
        ax.plot(x[pair], y[pair], color=VERMILLION, linewidth=2.0, label="jump" if number == 0 else None)
    if loop.pull_off_force > 0.0:
        ax.plot(x[loop.pull_off], y[loop.pull_off], "o", color=VERMILLION, fillstyle="none", label="pull-off")
    ax.set(xlabel=f"approach ({in_m.symbol})", ylabel=f"external force ({in_n.symbol})")
    return legend_above(ax)


def plot_branch(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw on ``ax`` the external force along a branch, ``branch_force`` (N) of ``values``, against
    ``branch_approach`` (m)."""
    approach, force = np.asarray(values["branch_approach"]), np.asarray(values["branch_force"])
    stable = np.asarray(values["branch_margin"]) > 0.0
    in_m, in_n = scale(approach, "m"), scale(force, "N")
    x, y = in_m(approach), in_n(force)
    ax.axhline(0.0, color="0.8", linewidth=0.5)
    parts = ((stable, BLUE, "-", "grips hold"), (~stable, VERMILLION, "--", "grips cannot hold"))
    for wanted, colour, line, label in parts:
        # a piece reaches to the next point of the other kind
        ends = wanted | np.roll(wanted, 1)
        ends[0] = wanted[0]
        if wanted.any():
            ax.plot(np.where(ends, x, np.nan), np.where(ends, y, np.nan), color=colour, linestyle=line, label=label)
    ax.set(xlabel=f"approach ({in_m.symbol})", ylabel=f"external force ({in_n.symbol})")
    return legend_above(ax)


ADHESION_PLOTS = (
    Plot(
        "adhesive_zone",
        "Adhesive zone",
        "Where the surfaces touch, and where they attract without touching, within the range of the adhesion; "
        "shares of the nominal area.",
        plot_adhesion,
        "map",
        shows=adhesion_kinds,
    ),
    Plot(
        "traction_section",
        "Net traction",
        "Pressure less attraction along x through the largest pressure.",
        plot_traction_section,
    ),
)
"""Figures of a result with adhesion in the order of a report."""

ADHESION_LOOP = Plot(
    "adhesion_loop",
    "Force against approach",
    "External force against the approach of the bodies; a tensile force is negative. Jumps lose energy, and "
    "with the loop they make the hysteresis.",
    plot_adhesion_loop,
)
"""Figure of a history with adhesion."""

BRANCH_PLOT = Plot(
    "adhesive_branch",
    "Branch between the jumps",
    "External force along the branch from the deepest contact on. Where grips cannot hold the contact, the "
    "smallest eigenvalue of its energy is negative; they jump at the folds.",
    plot_branch,
)
"""Figure of the values of a branch."""
