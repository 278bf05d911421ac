"""Figures of repeated passes: residual stress against depth, and what each pass adds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...core.arrays import RealArray
from ...plots.picture import BLACK, BLUE, GREEN, VERMILLION, Plot, figures_by, legend_above, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ...plots.picture import Figure


LEAST = 1e-4
"""Share of the first pass below which curves end: there rounding and the tolerance of the balance
are seen."""


@dataclass(frozen=True, eq=False)
class PassPicture:
    """What figures of passes are drawn from, SI.

    Attributes
    ----------
    depth, along, across
        (n,) depths in m below the middle of the track and residual stresses along and across it in
        Pa.
    interfaces
        Depths of the interfaces in m.
    growth, onward, work
        (passes,) growth of the accumulated plastic strain and change of the plastic strain in each
        pass, and its plastic work over that of the first.
    forward, groove
        (passes,) motion of the surface in each pass and depth of the groove after it in m.
    """

    depth: RealArray
    along: RealArray
    across: RealArray
    interfaces: RealArray
    growth: RealArray
    onward: RealArray
    work: RealArray
    forward: RealArray
    groove: RealArray


def plot_residual_depth(shown: PassPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the residual stresses along and across the track against depth; tension is
    positive."""
    metres, pascals = scale(shown.depth, "m"), scale(np.append(shown.along, shown.across), "Pa")
    breaks = np.searchsorted(shown.depth, shown.interfaces)  # stresses jump from layer to layer
    depth = np.insert(shown.depth, breaks, shown.interfaces)
    for values, colour, label in ((shown.along, BLUE, "along the track"), (shown.across, VERMILLION, "across it")):
        broken = np.insert(values, breaks, np.nan)
        ax.plot(metres(depth), pascals(broken), color=colour, marker=".", label=label)
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    for depth in shown.interfaces:
        if depth < shown.depth[-1]:
            ax.axvline(float(metres(depth)), color="0.6", linewidth=0.7, linestyle=":")
    ax.set(
        xlabel=f"depth ({metres.symbol})",
        ylabel=f"residual stress ({pascals.symbol})",
        xlim=(0.0, float(metres(shown.depth[-1]))),
    )
    return legend_above(ax)


def plot_pass_flow(shown: PassPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` what each pass adds, over the growth of the plastic strain and the plastic
    work of the first."""
    number = np.arange(1, shown.growth.size + 1)
    first = float(shown.growth.max())
    columns = (
        (shown.growth / first, BLUE, "o", "growth of the plastic strain"),
        (shown.onward / first, GREEN, "s", "change of the plastic strain"),
        (shown.work, VERMILLION, "^", "plastic work"),
    )
    for values, colour, marker, label in columns:
        seen = np.where(values >= LEAST, values, np.nan)
        ax.semilogy(number, seen, color=colour, marker=marker, ms=3.5, label=label)
    ax.set(xlabel="pass", ylabel="over that of the first pass", ylim=(LEAST, 2.0))
    ax.set_xticks(number[:: max(1, number.size // 10)])
    return legend_above(ax, columns=2)


def plot_pass_motion(shown: PassPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the depth of the groove after each pass, and how far the surface has moved
    along the track."""
    number = np.arange(shown.groove.size + 1)
    groove, moved = np.append(0.0, shown.groove), np.append(0.0, np.cumsum(shown.forward))
    metres = scale(np.append(groove, moved), "m")
    ax.plot(number, metres(groove), color=BLUE, marker="o", ms=3.5, label="depth of the groove")
    ax.plot(number, metres(moved), color=GREEN, marker="s", ms=3.5, label="motion of the surface along the track")
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    ax.set(xlabel="passes", ylabel=f"displacement of the surface ({metres.symbol})")
    ax.set_xticks(number[:: max(1, number.size // 10)])
    return legend_above(ax)


RESIDUAL_DEPTH = Plot(
    "passes_residual_depth",
    "Residual stress against depth",
    "Stresses that stay below the middle of the track after the last pass; dotted lines are interfaces.",
    plot_residual_depth,
)
PASS_FLOW = Plot(
    "passes_flow",
    "What each pass adds",
    "Growth of the accumulated plastic strain and change of the plastic strain below the middle of the track, "
    "and plastic work, over those of the first pass. What falls below 1e-4 is not drawn. Where all fall the "
    "body shakes down; where growth stays and the change falls, cycles are closed; where both stay, strain "
    "adds up.",
    plot_pass_flow,
)
PASS_MOTION = Plot(
    "passes_motion",
    "Groove and motion of the surface",
    "Depth of the groove in the middle of the track after each pass, and how far its surface has moved along "
    "the track.",
    plot_pass_motion,
)


def pass_figures(values: Mapping[str, Any]) -> tuple[Figure, ...]:
    """Figures of passes that ``values`` by the names of quantities allow."""
    names = ("profile_depth", "residual_along", "residual_across", "interfaces")
    columns = ("growth", "onward", "dissipation", "forward", "groove")
    shown = PassPicture(
        *(np.atleast_1d(np.asarray(values.get(f"passes_{name}", ()), float)) for name in (*names, *columns))
    )
    plots = [RESIDUAL_DEPTH]
    if shown.growth.size > 1 and shown.growth.max() > 0.0:
        plots += [PASS_FLOW, PASS_MOTION]
    return figures_by(plots, shown)
