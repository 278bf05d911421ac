"""Figures of wear: maps of what is gone and where a coating is worn through, a section as it
wears, depth and contact along the way, bearing curves."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...plots.animation import save_frames
from ...plots.maps import Field, Kinds, Look, map_of
from ...plots.picture import (
    BLACK,
    BLUE,
    GREEN,
    NO_CONTACT,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
    Plot,
    Scale,
    legend_above,
    literal,
    scale,
    style,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DEPTH_MAP = "magma"
"""Colours of worn depths."""

WAYS = "viridis"
"""Colours of states along the way, the first dark."""

SHOWN = 6
"""States that a figure of the section shows."""

CURVE_POINTS = 401
"""Points of a bearing curve."""


@dataclass(frozen=True, eq=False)
class WearPicture:
    """What figures of wear are drawn from: values of a result or of its file, SI."""

    problem: ContactProblem
    values: Mapping[str, Any]
    facts: Mapping[str, Any]

    def array(self, name: str) -> RealArray:
        """The values of that name; empty where there are none."""
        return np.asarray(self.values.get(name, []), float)

    @property
    def way(self) -> RealArray:
        """Distance in m of every step, of fretting the cycles."""
        return self.array("course_cycles" if self.facts["fretting"] else "course_distance")

    def along(self, way: RealArray) -> tuple[Scale, str]:
        """Scale and label of an axis of ``way``."""
        in_unit = scale(way, "1" if self.facts["fretting"] else "m")
        motion = "rolled" if self.facts.get("rolls") else "slid"
        return in_unit, "cycles" if self.facts["fretting"] else f"distance {motion} ({in_unit.symbol})"

    def at(self, name: str) -> float:
        """Way after which something is reached; NaN where it is not."""
        return float(self.values.get(f"{name}_cycles" if self.facts["fretting"] else name, np.nan))


def worn_field(shown: WearPicture) -> Field:
    """Worn depth of both bodies together."""
    look = Look("m", "worn depth", DEPTH_MAP, reduced="max")
    return Field(shown.array("worn_body") + shown.array("worn_counter_body"), shown.problem.grid, look)


def bare_kinds(shown: WearPicture) -> Kinds:
    """Where nothing is gone, where the coating is worn, and where it is gone."""
    depth = shown.array("worn_body") + shown.array("worn_counter_body")
    kinds = np.where(depth > 0.0, 1.0, 0.0) + np.where(shown.array("worn_bare") > 0.0, 1.0, 0.0)
    classes = (("as it was", NO_CONTACT), ("worn", BLUE), ("worn through", VERMILLION))
    return Kinds(kinds, shown.problem.grid, classes)


def plot_section_heights(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the heights on a section, as they wear."""
    return _section(shown, ax, shown.array("section_heights"), "m", "height")


def plot_section_depth(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the worn depth of both bodies on a section."""
    heights = np.atleast_2d(shown.array("section_heights"))
    _section(shown, ax, heights[0] - heights, "m", "worn depth")
    ax.invert_yaxis()
    return ax


def plot_section_pressure(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the pressure on a section, as it wears."""
    _section(shown, ax, shown.array("section_pressure"), "Pa", "contact pressure")
    top = max((float(np.max(line.get_ydata(), initial=0.0)) for line in ax.get_lines()), default=0.0)
    return ax if top <= 0.0 else _logarithmic(ax, top)


def _logarithmic(ax: Axes, top: float) -> Axes:
    """Show three decades below ``top``; pressures fall by as much."""
    ax.set(yscale="log", ylim=(top / 1e3, 1.5 * top))
    return ax


def _section(shown: WearPicture, ax: Axes, values: RealArray, unit: str, label: str) -> Axes:
    """Draw the rows of a section on ``ax``, coloured by the way."""
    from matplotlib import colormaps

    rows, ways, grid = np.atleast_2d(values), np.atleast_1d(shown.array("section_way")), shown.problem.grid
    chosen = np.unique(np.linspace(0, len(ways) - 1, SHOWN).round().astype(int))
    rows, ways, axis = rows[chosen], ways[chosen], 1 if shown.facts["across"] else 0
    in_unit, length = scale(rows, unit), scale(grid.size[axis], "m")
    x = length((np.arange(grid.shape[axis]) + 0.5) * grid.spacing[axis])
    in_way, _ = shown.along(ways)
    of = "cycles" if shown.facts["fretting"] else in_way.symbol
    for number, (row, way) in enumerate(zip(rows, ways, strict=True)):
        colour = colormaps[WAYS](0.9 * number / max(1, len(ways) - 1))
        ax.plot(x, in_unit(row), color=colour, linewidth=1.0, label=f"{float(in_way(way)):.6g} {of}")
    ax.set(xlabel=f"{'xy'[axis]} ({length.symbol})", ylabel=f"{label} ({in_unit.symbol})")
    ax.set_xlim(0.0, float(length(grid.size[axis])))
    return legend_above(ax, columns=3)


def plot_depth(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the worn depth along the way, with the thickness of coatings and the allowed
    depth, and when they are reached."""
    way, depth, area = shown.way, shown.array("course_max_depth"), shown.problem.grid.area
    mean = shown.array("course_worn_volume") / area
    levels = [(value, VERMILLION, "thickness of a coating") for value in shown.facts["thickness"]]
    allowed = shown.facts["allowed"]
    levels += [] if allowed is None else [(allowed, ORANGE, "allowed depth")]
    near = [item for item in levels if item[0] <= 3.0 * float(depth.max())]
    in_m = scale(np.append(depth, [value for value, _, _ in near]), "m")
    in_way, label = shown.along(way)
    ax.plot(in_way(way), in_m(depth), color=BLUE, label="largest")
    if np.isfinite(float(shown.values["wear_mean_depth"])):
        ax.plot(in_way(way), in_m(mean), color=GREEN, label="mean of the nominal area")
    for value, colour, name in near:
        ax.axhline(float(in_m(value)), color=colour, linestyle="--", linewidth=0.8, label=name)
    for name, colour in (("wear_breakthrough", VERMILLION), ("wear_life", ORANGE)):
        if np.isfinite(shown.at(name)):
            ax.axvline(float(in_way(shown.at(name))), color=colour, linestyle=":", linewidth=0.8)
    ax.set(xlabel=label, ylabel=f"worn depth ({in_m.symbol})", xlim=(0.0, float(in_way(way[-1]))), ylim=(0.0, None))
    return legend_above(ax)


def plot_course(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` real area, largest pressure and rms height along the way, and the force along
    the surface where it rolls, over those at its start."""
    in_way, label = shown.along(shown.way)
    low, high = 1.0, 1.0
    for name, colour, text in (
        ("course_area_fraction", BLUE, "real contact area"),
        ("course_max_pressure", VERMILLION, "maximum pressure"),
        ("course_rms_height", GREEN, "rms height"),
        ("course_tangential_force", ORANGE, "tangential force"),
    ):
        values = shown.array(name)
        if values.size and values[0] > 0.0:
            share = values / values[0]
            low, high = min(low, float(share.min())), max(high, float(share.max()))
            ax.plot(in_way(shown.way), share, color=colour, label=text)
    ax.axhline(1.0, color=BLACK, linewidth=0.5)
    ax.set(xlabel=label, ylabel="over that at the start", xlim=(0.0, float(in_way(shown.way[-1]))))
    if low > 0.5 and high < 2.0:
        room = max(0.1 * (high - low), 1e-3)
        ax.set_ylim(low - room, high + room)
    else:
        ax.set(yscale="log", ylim=(min(0.1, 0.7 * low), max(10.0, 1.4 * high)))
    return legend_above(ax, columns=3)


def plot_bearing(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the material ratio curves of the surface before and after, from the mean plane
    of the former."""
    before, after = np.asarray(shown.problem.profile(), float), shown.array("worn_heights")
    level, in_m = float(before.mean()), scale(np.ptp(before), "m")
    ratios = np.linspace(0.0, 1.0, CURVE_POINTS)
    for heights, colour, text in ((before, BLACK, "before"), (after, VERMILLION, "after")):
        curve = np.quantile(heights.ravel() - level, 1.0 - ratios)
        ax.plot(100.0 * ratios, in_m(curve), color=colour, label=text)
    numbers = [float(shown.values[f"wear_peak_height_{when}"]) for when in ("first", "last")]
    if np.isfinite(numbers).all():
        first, last = (f"{float(in_m(number)):.3g}" for number in numbers)
        ax.set_title(f"Spk {first} → {last} {in_m.symbol}", loc="right")
    ax.set(xlabel="material ratio (%)", ylabel=f"height ({in_m.symbol})", xlim=(0.0, 100.0))
    return legend_above(ax)


LAYER_COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, BLACK)
"""Colours of layers from the surface down."""


def plot_worn_stresses(shown: WearPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` the largest stress of each layer over its yield stress along the way; where no
    yield stress is known, the von Mises stress."""
    layers = [literal(str(name)) for name in np.atleast_1d(shown.values["wear_layer"])]
    used = shown.array("course_utilisation").reshape(-1, len(layers))
    known = bool(np.isfinite(used).any())
    columns = used if known else shown.array("course_von_mises").reshape(-1, len(layers))
    at = np.flatnonzero(np.isfinite(shown.array("course_coating")))
    in_way, label = shown.along(shown.way)
    unit = scale(columns, "1" if known else "Pa")
    for number, (name, column) in enumerate(zip(layers, unit(columns[at]).T, strict=True)):
        if np.isfinite(column).any():
            colour = LAYER_COLOURS[number % len(LAYER_COLOURS)]
            ax.plot(in_way(shown.way[at]), column, color=colour, marker=".", label=name)
    if known:
        ax.axhline(1.0, color=BLACK, linestyle="--", linewidth=0.8, label="yield stress")
    ylabel = "largest stress / yield stress" if known else f"largest von Mises stress ({unit.symbol})"
    ax.set(xlabel=label, ylabel=ylabel, xlim=(0.0, float(in_way(shown.way[-1]))), yscale="log")
    return legend_above(ax, columns=3)


WORN_PLOT = map_of(
    "worn_depth",
    "Worn depth",
    "Depth that both bodies together have lost.",
    worn_field,
    by_step=False,
)
BARE_PLOT = map_of(
    "worn_through",
    "Where the coating is gone",
    "Where a coating is worn through, and where it is worn but still there.",
    bare_kinds,
    by_step=False,
)
SECTION_PLOTS = (
    Plot(
        "worn_profile",
        "Section as it wears",
        "Heights along x, or across a track or wheel, through the point that is pressed most at first, after the ways "
        "above.",
        plot_section_heights,
    ),
    Plot(
        "worn_section_depth",
        "Depth of the section",
        "Depth that both bodies have lost on the same section, after the same ways.",
        plot_section_depth,
    ),
    Plot(
        "worn_section_pressure",
        "Pressure as it wears",
        "Contact pressure on the same section, after the same ways.",
        plot_section_pressure,
    ),
)
DEPTH_PLOT = Plot(
    "wear_life",
    "Worn depth along the way",
    "Largest and mean worn depth, with the thickness of coatings and the allowed depth where these are near; dotted "
    "when they are reached.",
    plot_depth,
)
COURSE_PLOT = Plot(
    "wear_course",
    "Contact along the way",
    "Real contact area, maximum pressure, rms height, and where it rolls the force along the surface, over those at "
    "the start.",
    plot_course,
)
BEARING_PLOT = Plot(
    "bearing_curve",
    "Bearing curve before and after",
    "Share of the composite surface that is higher than a height, from the mean plane before wear.",
    plot_bearing,
)
STRESS_PLOT = Plot(
    "wear_stresses",
    "Stresses as it wears",
    "Largest stress of each layer over its yield stress, or the stress where that is not known, with what is left of "
    "the coating.",
    plot_worn_stresses,
)


# The section as an animated picture.

FRAME_SIZE, PAUSE = (5.6, 4.6), 400
"""Width and height of a frame in inches, and ms that it stands."""


def wear_frames(shown: WearPicture, dpi: int = 100) -> tuple[bytes, ...]:
    """PNG of the section and of its pressure at each state that was kept, all of one range of
    axes."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    heights, pressure = (np.atleast_2d(shown.array(f"section_{name}")) for name in ("heights", "pressure"))
    ways, grid, axis = np.atleast_1d(shown.array("section_way")), shown.problem.grid, 1 if shown.facts["across"] else 0
    in_m, in_pa, length = scale(float(np.ptp(heights)), "m"), scale(pressure, "Pa"), scale(grid.size[axis], "m")
    x, top = length((np.arange(grid.shape[axis]) + 0.5) * grid.spacing[axis]), float(in_pa(pressure.max()))
    level, low, high = float(heights.max()), float(in_m(np.ptp(heights))), 0.05 * float(in_m(np.ptp(heights)))
    in_way, _ = shown.along(ways)
    made = []
    with style():
        for way, row, pressed in zip(ways, heights, pressure, strict=True):
            figure, buffer = Canvas(figsize=FRAME_SIZE, dpi=dpi), io.BytesIO()
            FigureCanvasAgg(figure)
            above, below = figure.subplots(2, sharex=True, gridspec_kw={"hspace": 0.12, "left": 0.15, "top": 0.92})
            above.plot(x, in_m(heights[0] - level), color="0.7", linewidth=0.8)
            above.plot(x, in_m(row - level), color=BLUE)
            below.fill_between(x, in_pa(pressed), color=VERMILLION, alpha=0.6, linewidth=0.0)
            above.set(ylabel=f"height ({in_m.symbol})", ylim=(-low - high, high))
            below.set(xlabel=f"{'xy'[axis]} ({length.symbol})", ylabel=f"pressure ({in_pa.symbol})")
            below.set(xlim=(0.0, float(length(grid.size[axis]))), ylim=(0.0, 1.05 * top or 1.0))
            of = "cycles" if shown.facts["fretting"] else in_way.symbol
            above.set_title(f"after {float(in_way(way)):.4g} {of}", loc="left")
            figure.savefig(buffer, format="png")
            made.append(buffer.getvalue())
    return tuple(made)


def save_wear(shown: WearPicture, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write the section as it wears, with its pressure, as an animated picture (.gif, .png or
    .webp).

    Raises
    ------
    InputError
        If the suffix is another, or there are fewer than two states.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    many = len(np.atleast_1d(shown.array("section_way")))
    return save_frames(path, lambda: wear_frames(shown), many, pause=PAUSE, overwrite=overwrite)
