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
from .picture import BLACK, BLUE, GREEN, NO_CONTACT, VERMILLION, legend_above, literal, saying, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BAR, TEXT, GAP, REST = 0.2, 0.145, 0.12, 0.9
"""Heights in inches of a bar, of a line of the name above it, of the gap to the next name, and of
axis and legend."""

WHOLE = 40
"""Letters of the longest line of the name of a bar."""

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
    percents = 100.0 * np.asarray(margins)
    colours = [GREEN if margin >= 0.0 else VERMILLION for margin in percents]
    _bars(
        names,
        percents,
        colours,
        [f"{margin:.3g} %" if abs(margin) < 1e3 else f"{margin:.0f} %" for margin in percents],
        ax,
    )
    return _labelled(ax, "margin (% of the limit)", "", legend=False)


def plot_changes(names: Sequence[str], changes: RealArray, met: BoolArray, ax: Axes) -> Axes:
    """Draw by what share an objective changes with each of the changes ``names`` on ``ax``, (n,),
    and whether all limits are ``met`` with it."""
    percents = 100.0 * np.asarray(changes)
    texts = [f"{each:+.3g} %" if np.isfinite(each) else "not known" for each in percents]
    _bars(names, percents, [GREEN if good else VERMILLION for good in met], texts, ax)
    for good, colour, label in ((met.any(), GREEN, "limits met"), ((~met).any(), VERMILLION, "a limit missed")):
        if good:
            ax.plot([], [], "s", color=colour, markersize=7.0, label=label)
    return _labelled(ax, "change of the objective (%)", "", legend=True)


def bars_height(names: Sequence[str]) -> float:
    """Height in inches of a figure with a bar for each of the ``names``, which stand above them."""
    return REST + sum(BAR + GAP + TEXT * len(wrap(name, WHOLE)) for name in names)


def _bars(names: Sequence[str], values: RealArray, colours: Sequence[str], texts: Sequence[str], ax: Axes) -> None:
    """Draw ``values`` as bars from the top of ``ax``, each under its name and with its text at the
    end."""
    drawn, place = np.clip(np.nan_to_num(values), -WIDEST, WIDEST), 0.0
    for name, width, colour, text in zip(names, drawn, colours, texts, strict=True):
        lines = wrap(name, WHOLE)
        place -= GAP + TEXT * len(lines)
        ax.text(
            0.01,
            place + 0.02,
            "\n".join(map(literal, lines)),
            transform=ax.get_yaxis_transform(),
            va="bottom",
            linespacing=1.0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5},
        )
        place -= BAR
        ax.barh(place + 0.5 * BAR, width, height=BAR, color=colour)
        ax.annotate(
            text,
            (width, place + 0.5 * BAR),
            xytext=(4 if width >= 0.0 else -4, 0),
            textcoords="offset points",
            ha="left" if width >= 0.0 else "right",
            va="center",
        )
    ax.axvline(0.0, color=BLACK, linewidth=0.8)
    ax.margins(x=0.3)
    ax.set_yticks([])
    ax.set_ylim(place - GAP, 0.0)


def plot_front(first: Labelled, second: Labelled, chosen: int | None, ax: Axes, *, designs: Sequence[str] = ()) -> Axes:
    """Draw the ``first`` of two objectives against the ``second`` on ``ax``, (n,) each; the point
    ``chosen`` is the recommended one. ``designs`` in words are what a page reads out."""
    along, up = scale(second.values, second.quantity.unit), scale(first.values, first.quantity.unit)
    x, y = along(second.values), up(first.values)
    (line,) = ax.plot(x, y, "o-", color=BLUE, markersize=4.0)
    if designs:
        saying(line, designs)
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
