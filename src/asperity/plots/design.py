"""Figures of designs: how a search went, margins of the constraints, the front of two
objectives."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import BoolArray, RealArray
from ..core.quantity import Labelled
from .campaign import LINE
from .picture import BLACK, BLUE, GREEN, NO_CONTACT, VERMILLION, legend_above, literal, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDEST = 200.0
"""Margins in percent that are drawn at most; the number of a larger one is written."""


def plot_history(objective: Labelled, feasible: BoolArray, ax: Axes, *, larger: bool = False) -> Axes:
    """Draw the ``objective`` of all designs that a search met, in order, on ``ax``, and the best so
    far of those that are ``feasible``, (n,); ``larger`` values are the better ones."""
    up = scale(objective.values, objective.quantity.unit)
    values, counts = up(objective.values), np.arange(1, len(objective.values) + 1)
    for chosen, colour, label in ((feasible, BLUE, "limits met"), (~feasible, VERMILLION, "a limit missed")):
        if chosen.any():
            ax.plot(counts[chosen], values[chosen], "o", color=colour, markersize=4.0, label=label)
    if feasible.any():
        worst = -np.inf if larger else np.inf
        kept = np.where(feasible & np.isfinite(values), values, worst)
        best = np.maximum.accumulate(kept) if larger else np.minimum.accumulate(kept)
        ax.step(counts, np.where(np.isfinite(best), best, np.nan), where="post", color=BLACK, label="best so far")
    good = values[np.isfinite(values)]
    if good.size and good.min() > 0.0 and good.max() > 30.0 * good.min():
        ax.set_yscale("log")
    return _labelled(ax, "designs met by the search", _with_unit(objective, up.symbol), legend=True)


def plot_margins(names: Sequence[str], margins: RealArray, ax: Axes) -> Axes:
    """Draw how far each of the constraints ``names`` is within its limit on ``ax``, as shares of
    it; negative where it is missed."""
    rows, percents = np.arange(len(names))[::-1], 100.0 * np.asarray(margins)
    drawn = np.clip(np.nan_to_num(percents), -WIDEST, WIDEST)
    ax.barh(rows, drawn, height=0.6, color=[GREEN if margin >= 0.0 else VERMILLION for margin in percents])
    for row, width, margin in zip(rows, drawn, percents, strict=True):
        ax.annotate(
            f"{margin:.3g} %",
            (width, row),
            xytext=(4 if width >= 0.0 else -4, 0),
            textcoords="offset points",
            ha="left" if width >= 0.0 else "right",
            va="center",
        )
    ax.axvline(0.0, color=BLACK, linewidth=0.8)
    ax.margins(x=0.25)
    ax.set_yticks(rows, ["\n".join(map(literal, wrap(name, LINE))) for name in names])
    return _labelled(ax, "margin (% of the limit)", "", legend=False)


def plot_front(first: Labelled, second: Labelled, chosen: int | None, ax: Axes) -> Axes:
    """Draw the ``first`` of two objectives against the ``second`` on ``ax``, (n,) each; the point
    ``chosen`` is the recommended one."""
    along, up = scale(second.values, second.quantity.unit), scale(first.values, first.quantity.unit)
    x, y = along(second.values), up(first.values)
    ax.plot(x, y, "o-", color=BLUE, markersize=4.0)
    if chosen is not None:
        ax.plot(x[chosen], y[chosen], "D", color=VERMILLION, label="best of the first objective")
    for values, set_scale in ((x, ax.set_xscale), (y, ax.set_yscale)):
        if values.size and values.min() > 0.0 and values.max() > 30.0 * values.min():
            set_scale("log")
    return _labelled(ax, _with_unit(second, along.symbol), _with_unit(first, up.symbol), legend=chosen is not None)


def plot_fit(x: Labelled, y: Labelled, deviation: RealArray, model: RealArray, ax: Axes) -> Axes:
    """Draw the measured quantity ``y`` with its ``deviation`` against ``x`` on ``ax``, and the
    ``model``, (n,) each."""
    along, up = scale(x.values, x.quantity.unit), scale(y.values, y.quantity.unit)
    order = np.argsort(x.values)
    ax.errorbar(
        along(x.values), up(y.values), up(2.0 * deviation), fmt="o", color=BLUE, markersize=4.0, label="measured, 2 s"
    )
    ax.plot(along(x.values)[order], up(model)[order], color=VERMILLION, label="fit")
    return _labelled(ax, _with_unit(x, along.symbol), _with_unit(y, up.symbol), legend=True)


def plot_profile_likelihood(x: Labelled, rises: RealArray, limit: float, ax: Axes) -> Axes:
    """Draw the ``rises`` of a sum of squares against the parameter ``x`` on ``ax``, (n,) each, with
    the ``limit`` of its interval."""
    along = scale(x.values, x.quantity.unit)
    ax.plot(along(x.values), rises, "o-", color=BLUE, markersize=4.0)
    ax.axhline(limit, color=VERMILLION, linestyle="--", label="95 %")
    return _labelled(ax, _with_unit(x, along.symbol), "rise of the sum of squares", legend=True)


def _with_unit(what: Labelled, symbol: str) -> str:
    return "\n".join(wrap(f"{what.quantity.label} ({symbol})" if symbol else what.quantity.label, LINE))


def _labelled(ax: Axes, x: str, y: str, *, legend: bool) -> Axes:
    ax.set(xlabel=x, ylabel=y)
    ax.grid(visible=True, color=NO_CONTACT, linewidth=0.6)
    ax.set_axisbelow(True)
    return legend_above(ax) if legend else ax
