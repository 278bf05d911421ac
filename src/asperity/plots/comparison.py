"""Curves of theories beside the numerical solution: area, its slope, gap, deviations; from the
dataset of a comparison."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..io.atomic import atomic_file
from ..theories.ask import Evaluation
from .picture import (
    BLACK,
    BLUE,
    CURVE_SIZE,
    GREEN,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
    Figure,
    Plot,
    apart,
    curve_figure,
    literal,
    png,
    scale,
)

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

COLOURS = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
"""Colours of theories in turn."""

LINES = ("-", "--", ":", "-.")
"""Lines of theories, each for one turn of the colours."""

MUTED, OTHERS = "0.82", "0.7"
"""Grey of an answer beyond the limits of its theory, and of the theories beside the nearest."""

NEAREST = 3
"""Theories that are named beside the numerical solution."""

LABEL_ROOM = 0.042
"""Least distance of the names of curves over the height of the axes."""

SIZE = (CURVE_SIZE[0], 4.2)
"""Width and height in inches of a comparison, which has room for the names of all theories beside
their curves."""

STEEPEST = 5.0
"""Slope at which the axes of slopes end: twice the largest limit of an elastic theory."""

LARGEST_DEVIATION = 1.0
"""Deviation beyond which the axis of deviations ends."""


VALID_BY = {"gap": "gap_valid"}
"""Variable with the loads at which a theory holds, for quantities with another one than the
area."""


def nearest(data: xarray.Dataset) -> tuple[str, ...]:
    """Names of the theories of ``data`` whose area is nearest to the numerical one, at most
    ``NEAREST``.

    They are ranked by the root mean square of their deviations within their limits, which they keep
    at half of the loads or more. Empty without the numerical solution.
    """
    if "area_fraction_deviation" not in data:
        return ()
    off = np.where(data["area_fraction_valid"].values, _values(data["area_fraction_deviation"]), np.nan)
    known = np.isfinite(off).sum(axis=1)
    rms = np.sqrt(np.nansum(off**2, axis=1) / np.maximum(known, 1))
    ranked = np.argsort(np.where(2 * known >= off.shape[1], rms, np.inf), kind="stable")
    return tuple(str(data["theory"].values[n]) for n in ranked[:NEAREST] if 2 * known[n] >= off.shape[1])


def within_limits(values: RealArray, valid: BoolArray, *, share: bool) -> RealArray:
    """``values`` where a theory is within its limits, NaN elsewhere; of a ``share`` none is above
    one."""
    shown: RealArray = np.where(valid & ~(share & (values > 1.0)), values, np.nan)
    return shown


def plot_comparison_area(data: xarray.Dataset, ax: Axes) -> Axes:
    """Draw the area fraction of every curve of ``data`` against p/E* on ``ax``, both
    logarithmic."""
    curves = _draw(data, "area_fraction", ax)
    if "numerical_area_fraction" in data:
        pixels = _values(data["numerical_area_fraction"])
        ax.plot(_values(data["relative_pressure"]), pixels, color=BLACK, linestyle="", marker=".", markersize=2.0)
        curves += _points(data, "numerical_area_fraction_corrected", ax)
    ax.set(xscale="log", yscale="log", xlabel="p/E*", ylabel="real area / nominal area")
    ax.set_ylim(top=1.0)
    return _named(ax, curves)


def _plot_slopes(name: str, label: str, data: xarray.Dataset, ax: Axes) -> Axes:
    """Draw the slope ``name`` of the area of every curve of ``data`` against p/E* on ``ax``."""
    curves = _draw(data, name, ax) + _points(data, f"numerical_{name}", ax)
    ax.set(xscale="log", xlabel="p/E*", ylabel=label)
    ax.set_ylim(0.0, min(STEEPEST, ax.get_ylim()[1]))
    return _named(ax, curves)


def plot_comparison_gap(data: xarray.Dataset, ax: Axes) -> Axes:
    """Draw the mean gap of every curve of ``data`` against p/E* on ``ax``, in rms heights."""
    rms = float(data.attrs["rms_height_m"])
    curves = _draw(data, "gap", ax, unit=rms)
    curves += _points(data, "numerical_mean_gap", ax, unit=rms)
    in_m = scale(rms, "m")
    label = f"mean gap / rms height ({float(in_m(rms)):.3g} {in_m.symbol})"
    ax.set(xscale="log", xlabel="p/E*", ylabel=label)
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    if "numerical_mean_gap" in data:
        highest = float(np.nanmax(_values(data["numerical_mean_gap"]))) / rms
        ax.set_ylim(-0.4 * highest, 1.25 * highest)
    return _named(ax, curves)


def plot_comparison_deviation(data: xarray.Dataset, ax: Axes) -> Axes:
    """Draw the relative deviation of the area of every theory of ``data`` against the numerical
    area on ``ax``."""
    area = 100.0 * _values(data["numerical_area_fraction_corrected"])
    curves = _draw(data, "area_fraction_deviation", ax, unit=0.01, against=area)
    ax.axhline(0.0, color=BLACK, linewidth=0.8)
    ax.set(
        xscale="log", xlabel="real area of the numerical solution (% of nominal)", ylabel="deviation of the area (%)"
    )
    low, high = ax.get_ylim()
    ax.set_ylim(max(low, -100.0 * LARGEST_DEVIATION), min(high, 100.0 * LARGEST_DEVIATION))
    return _named(ax, curves)


COMPARISON_PLOTS = (
    Plot(
        "area",
        "Area against pressure",
        "Real area per nominal area against nominal pressure over E*. Points: boundary elements, corrected "
        "for the pixels (small points: pixels counted). The theories nearest to them are named, the others grey; "
        "curves end where a theory is beyond its limits.",
        plot_comparison_area,
        "comparison",
    ),
    Plot(
        "kappa",
        "Slope of the area",
        "κ = (A/A₀) E* h'/p, with the rms gradient h', is constant where the area is proportional to the load. "
        "Limits at vanishing load: √(2π) of Bush, Gibson and Thomas, √(8/π) of Persson. The axis ends at 5.",
        partial(_plot_slopes, "kappa", "κ = (A/A₀) E* h'/p"),
        "comparison",
    ),
    Plot(
        "local_slope",
        "Local slope of the area",
        "d(A/A₀)/d(p/(E* h')) by differences between neighbouring loads.",
        partial(_plot_slopes, "slope", "d(A/A₀)/d(p/(E* h'))"),
        "comparison",
    ),
    Plot(
        "gap",
        "Mean gap against pressure",
        "Mean gap of the deformed surfaces; the separation of the mean planes for theories that define no gap.",
        plot_comparison_gap,
        "comparison",
    ),
    Plot(
        "deviation",
        "Deviation of the area from the numerical solution",
        "Area of the theory over that of the boundary elements, less one; the axis ends at 100 %.",
        plot_comparison_deviation,
        "comparison",
    ),
)
"""The figures of a comparison in the order of a report; the last one needs the numerical
solution."""


def comparison_plots(data: xarray.Dataset) -> tuple[Plot, ...]:
    """Those of the figures that the dataset of a comparison has the values for."""
    return COMPARISON_PLOTS if "numerical_area_fraction" in data else COMPARISON_PLOTS[:-1]


def comparison_figures(data: xarray.Dataset) -> tuple[Figure, ...]:
    """The figures of a comparison from its dataset."""
    return tuple(
        curve_figure(plot.name, plot.title, plot.caption, partial(plot.draw, data), SIZE, wide=True)
        for plot in comparison_plots(data)
    )


class _Curve(NamedTuple):
    """A curve with its name and colour."""

    name: str
    x: RealArray
    y: RealArray
    color: str


def _draw(
    data: xarray.Dataset, name: str, ax: Axes, *, unit: float = 1.0, against: RealArray | None = None
) -> list[_Curve]:
    """Curves of ``data[name]`` in ``unit`` within the limits of each theory: those of the nearest
    in colours, which are returned, the others grey; all in colours without a numerical solution."""
    curves = []
    x, named = _values(data["relative_pressure"]) if against is None else against, nearest(data)
    for number, theory in enumerate(map(str, data["theory"].values)):
        row = data.sel(theory=theory)
        valid = np.asarray(row[VALID_BY.get(name, "area_fraction_valid")].values, dtype=bool)
        values = within_limits(_values(row[name]) / unit, valid, share=name == "area_fraction")
        if not np.isfinite(values).any():
            continue
        place = named.index(theory) if theory in named else number
        if named and theory not in named:
            ax.plot(x, values, color=OTHERS, linewidth=0.7, zorder=1.0, label=literal(theory))
            continue
        colour, line = COLOURS[place % len(COLOURS)], LINES[place // len(COLOURS) % len(LINES)]
        ax.plot(x, values, color=colour, linestyle=line, label=literal(theory))
        curves.append(_Curve(literal(theory), x, values, colour))
    return curves


def _points(data: xarray.Dataset, name: str, ax: Axes, *, unit: float = 1.0) -> list[_Curve]:
    if name not in data:
        return []
    x, values = _values(data["relative_pressure"]), _values(data[name]) / unit
    ax.plot(x, values, color=BLACK, marker="o", markersize=4.0, linewidth=2.0, zorder=3.0, label="numerical")
    return [_Curve("numerical", x, values, BLACK)]


def _named(ax: Axes, curves: list[_Curve]) -> Axes:
    """Name every curve where it ends or leaves the axes, in its colour; names are moved apart, in
    the order of the ends."""
    curves = [curve for curve in curves if np.isfinite(curve.y).any()]
    if curves:
        ax.set_xlim(right=max(float(curve.x.max()) for curve in curves))  # curves end where their names begin
    to_axes = ax.transData + ax.transAxes.inverted()
    ends = []
    for curve in curves:
        finite = np.isfinite(curve.y)
        x, y = _last_inside(to_axes.transform(np.column_stack([curve.x[finite], curve.y[finite]])))
        ends.append((y, x, curve))
    # of curves that leave through the bottom the last one is the highest there, through the top the
    # lowest
    ends.sort(key=lambda end: (end[0], end[1] if end[0] < 0.5 else -end[1]))
    for (y, x, curve), place in zip(ends, apart([end[0] for end in ends], LABEL_ROOM), strict=True):
        line = {"arrowstyle": "-", "color": "0.6", "linewidth": 0.5, "linestyle": ":"}  # no part of the curve
        ax.annotate(
            curve.name,
            (x, y),
            (1.1, place),
            "axes fraction",
            arrowprops=line | {"shrinkA": 1.0, "shrinkB": 0.0, "relpos": (0.0, 0.5)},
            color=curve.color,
            fontsize=7.0,
            va="center",
        )
    return ax


def _last_inside(points: RealArray) -> tuple[float, float]:
    """Last place of a line through ``points`` (n, 2) within the unit square; where it is all
    outside, its end moved to the border."""
    for start, end in zip(points[-2::-1], points[:0:-1], strict=True):
        step = end - start
        with np.errstate(divide="ignore", invalid="ignore"):
            ways = np.sort(
                np.stack([-start / step, (1.0 - start) / step]), axis=0
            )  # where it crosses, as shares of the step
        within = (start >= 0.0) & (start <= 1.0)
        enters = np.where(step == 0.0, np.where(within, -np.inf, np.inf), ways[0]).max(initial=0.0)
        leaves = np.where(step == 0.0, np.inf, ways[1]).min(initial=1.0)
        if enters <= leaves:
            x, y = np.clip(start + leaves * step, 0.0, 1.0)
            return float(x), float(y)
    x, y = np.clip(points[-1], 0.0, 1.0)
    return float(x), float(y)


def _values(variable: xarray.DataArray) -> RealArray:
    return np.asarray(variable.values, dtype=float)


def save_answer_plot(found: Evaluation, path: Path, *, overwrite: bool = False) -> None:
    """Draw every column of the answer ``found`` of a theory against the first and write it to
    ``path``; grey beyond its limits.

    Raises
    ------
    InputError
        If the answer holds fewer than two points.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    if not found.columns or found.columns[0][1].size < 2:
        raise InputError("plot of an answer must have a range of values, such as {range}, but there is one point.")
    (axis, x), *columns = found.columns
    across = scale(x, axis.unit)
    logarithmic = "log" if x.min() > 0.0 and x.max() > 20.0 * x.min() else "linear"

    def draw(first: Axes) -> Axes:
        figure: Any = first.figure
        first.remove()
        places = figure.subplots(-(-len(columns) // 2), min(2, len(columns)), squeeze=False)
        for ax, (column, y) in zip(places.flat, columns, strict=False):
            up = scale(y, column.unit)
            ax.plot(across(x), up(y), color=MUTED)
            ax.plot(across(x), np.where(found.holds(column.name), up(y), np.nan), color=BLUE)
            rising = logarithmic == "log" and np.nanmin(y) > 0.0
            ax.set(xscale=logarithmic, yscale="log" if rising else "linear")
            ax.set_title(column.name.replace("_", " ") + (f", {up.symbol}" if up.symbol else ""))
        for ax in places.flat[len(columns) :]:
            ax.set_axis_off()
        for ax in places[-1]:
            ax.set_xlabel(f"{axis.label}{f', {across.symbol}' if across.symbol else ''}")
        figure.suptitle(found.theory.title)
        figure.tight_layout()
        return first

    rows = -(-len(columns) // 2)
    picture = png(draw, (7.0, 0.6 + 2.1 * rows))
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_bytes(picture)
