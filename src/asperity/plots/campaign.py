"""Figures of campaigns: curves on axes, samples, convergence, critical thicknesses,
sensitivities."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import RealArray
from ..core.quantity import Labelled
from .picture import (
    BLACK,
    BLUE,
    GREEN,
    NO_CONTACT,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
    Scale,
    legend_above,
    literal,
    scale,
    wide_range,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY, BLACK)
"""Colours of curves in turn."""


MOST_TICKS = 8
"""Levels up to which each gets its tick."""

LINE = 34
"""Letters of the longest line of a label."""


@dataclass(frozen=True, eq=False)
class Curve:
    """Values (SI) of one curve; ``band`` is the half width of a band around it, of the same
    shape."""

    label: str
    values: RealArray
    band: RealArray | None = None


@dataclass(frozen=True, eq=False)
class Transition:
    """A quantity between two limits, and the thicknesses (m, NaN where there is none) at which it
    leaves and reaches them."""

    label: str
    values: RealArray
    at_zero: float
    at_infinity: float
    floor: float
    ceiling: float


def plot_curves(x: Labelled, y: Labelled, curves: Sequence[Curve], ax: Axes) -> Axes:
    """Draw ``curves`` of the quantity that ``y`` names against ``x`` on ``ax``; ``y.values`` set
    the scale."""
    along, up = scale(x.values, x.quantity.unit), scale(y.values, y.quantity.unit)
    order = np.argsort(x.values)
    for number, curve in enumerate(curves):
        colour = COLOURS[number % len(COLOURS)]
        values, places = up(curve.values)[order], along(x.values)[order]
        if curve.band is not None:
            half = up(curve.band)[order]
            ax.fill_between(places, values - half, values + half, color=colour, alpha=0.2, linewidth=0.0)
        ax.plot(places, values, color=colour, marker="o", markersize=3.0, label=literal(curve.label) or None)
    for drawn, set_scale in (
        (x.values, ax.set_xscale),
        (np.concatenate([curve.values for curve in curves]), ax.set_yscale),
    ):
        if wide_range(drawn):
            set_scale("log")
    return _labelled(ax, (x.quantity.label, along), (y.quantity.label, up), legend=any(curve.label for curve in curves))


def plot_samples(y: Labelled, mean: float, half_width: float, ax: Axes) -> Axes:
    """Draw the distribution of the samples ``y`` on ``ax``, with their ``mean`` and its confidence
    interval."""
    along = scale(y.values, y.quantity.unit)
    good = along(y.values)[np.isfinite(y.values)]
    if good.size:
        ax.hist(
            good, bins=int(np.clip(2.0 * good.size ** (1.0 / 3.0), 5, 40)), color=SKY, edgecolor="white", linewidth=0.4
        )
    middle = float(along(mean))
    if math.isfinite(half_width):
        half = float(along(half_width))
        ax.axvspan(
            middle - half, middle + half, color=VERMILLION, alpha=0.25, linewidth=0.0, label="confidence of the mean"
        )
    ax.axvline(middle, color=BLACK, linestyle="--", label=f"mean {middle:.4g} {along.symbol}".rstrip())
    return _labelled(ax, (y.quantity.label, along), ("samples", Scale("", 1.0)), legend=True)


def plot_running_mean(y: Labelled, half_widths: RealArray, means: RealArray, ax: Axes) -> Axes:
    """Draw the mean of the quantity that ``y`` names against the number of samples on ``ax``, with
    its confidence."""
    counts, up = np.arange(1, means.size + 1), scale(means, y.quantity.unit)
    ax.fill_between(counts, up(means - half_widths), up(means + half_widths), color=SKY, alpha=0.4, linewidth=0.0)
    ax.plot(counts, up(means), color=BLUE)
    return _labelled(ax, ("samples", Scale("", 1.0)), (f"mean of {y.quantity.label}", up), legend=False)


def plot_convergence(levels: Labelled, y: Labelled, extrapolated: float, ax: Axes) -> Axes:
    """Draw the quantity ``y`` from the coarsest to the finest of the ``levels`` on ``ax``, and its
    extrapolation."""
    along, up = scale(levels.values, levels.quantity.unit), scale(y.values, y.quantity.unit)
    ax.plot(along(levels.values), up(y.values), color=BLUE, marker="o", markersize=3.5)
    if math.isfinite(extrapolated):
        limit = float(up(extrapolated))
        ax.axhline(limit, color=BLACK, linestyle="--", label=f"extrapolated {limit:.5g} {up.symbol}".rstrip())
    ax.set_xscale("log")
    if levels.values.size <= MOST_TICKS:
        ax.set_xticks(along(levels.values), [f"{level:g}" for level in along(levels.values)])
        ax.minorticks_off()
    if levels.values[0] > levels.values[-1]:
        ax.invert_xaxis()
    return _labelled(ax, (levels.quantity.label, along), (y.quantity.label, up), legend=math.isfinite(extrapolated))


def plot_transitions(thickness: Labelled, y: Labelled, transitions: Sequence[Transition], ax: Axes) -> Axes:
    """Draw a quantity against the ``thickness`` of a layer on ``ax``: limits as lines, floor and
    ceiling as triangles."""
    along, up = scale(thickness.values, thickness.quantity.unit), scale(y.values, y.quantity.unit)
    for number, item in enumerate(transitions):
        colour = COLOURS[number % len(COLOURS)]
        ax.plot(
            along(thickness.values),
            up(item.values),
            color=colour,
            marker="o",
            markersize=3.0,
            label=literal(item.label) or None,
        )
        for limit in (item.at_zero, item.at_infinity):
            ax.axhline(float(up(limit)), color=colour, linestyle=":", linewidth=0.8)
    marked = False
    for name, marker in (("floor", "^"), ("ceiling", "v")):
        places = [(float(getattr(item, name)), item.values) for item in transitions]
        there = [(x, np.interp(math.log(x), np.log(thickness.values), values)) for x, values in places if x > 0.0]
        if there:
            x, heights = np.array(there).T
            ax.plot(along(x), up(heights), color=BLACK, marker=marker, markersize=7.0, linestyle="", label=name)
            marked = True
    ax.set_xscale("log")
    return _labelled(
        ax, (thickness.quantity.label, along), (y.quantity.label, up), legend=marked or len(transitions) > 1
    )


def plot_sensitivities(
    names: Sequence[str], low: RealArray, high: RealArray, y: Labelled, base: float, ax: Axes
) -> Axes:
    """Draw how far low and high values of each scalar in ``names`` move a quantity from its
    ``base``, largest on top."""
    along = scale(np.concatenate([low, high, [base]]), y.quantity.unit)
    order = np.argsort(np.abs(high - low))
    rows = np.arange(order.size)
    middle = float(along(base))
    for values, colour, label in ((low, SKY, "low"), (high, ORANGE, "high")):
        ax.barh(rows, along(values)[order] - middle, left=middle, height=0.6, color=colour, label=label)
    ax.axvline(middle, color=BLACK, linewidth=0.8)
    ax.set_yticks(rows, [literal(names[number]) for number in order])
    ax.set_xlabel(with_unit(y.quantity.label, along))
    return legend_above(ax)


def _labelled(ax: Axes, x: tuple[str, Scale], y: tuple[str, Scale], *, legend: bool) -> Axes:
    ax.set(xlabel=with_unit(*x), ylabel=with_unit(*y))
    ax.grid(visible=True, color=NO_CONTACT, linewidth=0.6)
    ax.set_axisbelow(True)
    return legend_above(ax) if legend else ax


def with_unit(label: str, unit: Scale) -> str:
    """``label`` of an axis with its unit, in lines."""
    return "\n".join(wrap(f"{label} ({unit.symbol})" if unit.symbol else label, LINE))
