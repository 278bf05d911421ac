"""Stresses inside a body: vertical sections with their layers, depth profiles, maps of planes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import groupby
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.boundary import Boundary
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.quantity import Quantity
from ...core.units import show
from ...plots.maps import Cut, Depth, Field, Look, enlarge_island, limits, plot_field
from ...plots.picture import (
    BAR,
    BAR_ROOM,
    BLACK,
    BLUE,
    CURVE_SIZE,
    GREEN,
    ORANGE,
    PRESSURE_MAP,
    PURPLE,
    SKY,
    VERMILLION,
    VIEW_SIZE,
    Drawing,
    Figure,
    apart,
    curve_figure,
    legend_above,
    literal,
    make_room,
    map_size,
    png,
    say_exaggeration,
    scale,
    size_of,
)
from ...plots.view import draw_view, thinned
from .field import DERIVED, StressField
from .regions import Plane
from .survey import StressSurvey, SurveyedSection

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Stresses inside a body: vertical sections with their layers, depth profiles, maps of one plane.


LEVELS = 12
"""Number of steps of a contour plot."""

DECADES = 2.0
"""Range of a logarithmic contour plot below the maximum, in powers of ten."""

SIGNED_MAP, UNSIGNED_MAP = "RdBu_r", "viridis"
"""Colour maps of stresses of either sign (white at zero, red in tension) and of magnitudes."""

LETTER = 0.08
"""Width of a letter of a label in inches, about."""

LABEL_ROOM = 0.09
"""Height of the name of a region over that of the axes: the least thickness in which it stands, and
the least distance."""

COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, BLACK)
"""Colours of the curves of a depth profile, in order."""


MAGNITUDES = ("sqrt_J2", "von_mises", "tresca", "max_shear")
"""Stresses that are never negative."""

TENSIONS = ("max_principal", "principal_tensile")
"""Stresses of which the tension matters alone."""

QUANTITIES = {quantity.name: quantity for quantity in DERIVED}
"""Attributes of a StressField that can be drawn."""


def plot_stress_section(field: StressField, ax: Axes, quantity: str = "sqrt_J2", *, log: bool = False) -> Axes:
    """Draw contours of one ``quantity`` of a vertical section on ``ax``, depth downwards,
    interfaces as lines.

    With ``log`` the steps are equal factors over two decades below the maximum; of signed stresses
    the same on both sides of zero, white between.

    Regions are drawn apart, so a stress that jumps at an interface jumps in the picture. The cross
    marks the largest magnitude, of principal stresses the largest tension. Signed stresses are
    white about zero. Depth is to the scale of the section unless that were less than a sixth of its
    length. Raises InputError if the field is no section, has a region with one plane only, or the
    quantity is unknown.
    """
    from matplotlib.colors import BoundaryNorm

    kind = _known(quantity)
    if len(field.dims) != 2 or len(field.planes) < 2:
        raise InputError("field of a stress section must have the axes plane and x or y; compute it on a Section(...).")
    axis, other = (field.dims[1], "y" if field.dims[1] == "x" else "x")
    line, at = _middle(field, axis), float(_middle(field, other))
    values = getattr(field, quantity)
    in_unit, length = scale(values, "Pa"), scale(float(line[-1] - line[0]), "m")
    depth_unit = scale(field.depth, "m")
    levels = _levels(in_unit(values), kind, log=log)
    # filled contours, region by region, on common levels
    along, shown = length(line), in_unit(values)
    colours = SIGNED_MAP if kind.name not in MAGNITUDES else UNSIGNED_MAP
    extend, low = ("min", -np.inf) if kind.name in TENSIONS else ("neither", levels[0])
    norm = BoundaryNorm(levels, 256)
    contours: Any = None
    for part in _parts(field):
        if len(part) < 2:
            raise InputError(
                "field of a stress section must have at least two planes in every region; see depths_through."
            )
        depth = depth_unit(field.depth[part])
        inside = np.clip(shown[part], low, levels[-1])
        contours = ax.contourf(along, depth, inside, levels, cmap=colours, norm=norm, extend=extend)
        ax.contour(along, depth, inside, levels[1:-1], colors="black", linewidths=0.3, alpha=0.5)
    beside = _draw_interfaces(field, ax, depth_unit)
    peak = field.peak(values if kind.name in TENSIONS else np.abs(values))
    x = float(length(getattr(peak, axis) + 0.5 * field.spacing["xy".index(axis)]))
    ax.plot(x, float(depth_unit(peak.depth)), "x", color=BLACK, markersize=5, clip_on=False)
    ax.set(
        xlabel=f"{axis} ({length.symbol})" + ("" if field.single_row else f", at {other} = {show(at, 'm')}"),
        ylabel=f"depth ({depth_unit.symbol})",
        xlim=(float(length(line[0])), float(length(line[-1]))),
        ylim=(float(depth_unit(field.depth[-1])), 0.0),
    )
    make_room(ax, right=BAR_ROOM + beside, share=BAR)
    across = float(line[-1] - line[0])
    exaggerated = not across / 6.0 < field.depth[-1] < 6.0 * across
    if exaggerated:
        say_exaggeration(ax, "depth", across, float(field.depth[-1]))
    else:
        ax.set_aspect(length.factor**-1 * depth_unit.factor, adjustable="box")
    place = ax.inset_axes((1.03 + beside / size_of(ax)[0], 0.0, 0.035, 1.0))
    bar = ax.figure.colorbar(contours, cax=place, format=_two_digits if log else "%g")
    height = size_of(ax)[1] if exaggerated else size_of(ax)[0] * float(field.depth[-1]) / across
    bar.set_label("\n".join(wrap(f"{kind.label} ({in_unit.symbol})", max(12, int(height / LETTER)))))
    if kind.name not in MAGNITUDES:
        every = math.ceil(0.15 * levels.size / height)  # inches for a number
        bar.set_ticks(levels[::-1][::every].tolist())
        bar.minorticks_off()
    return ax


def plot_stress_profile(
    field: StressField, ax: Axes, quantities: tuple[str, ...] = ("sqrt_J2", "normal_xx", "shear_xz")
) -> Axes:
    """Draw ``quantities`` of a depth profile against depth on ``ax``, depth downwards, with a break
    at each interface.

    Raises InputError if the field is no depth profile or a quantity is unknown.
    """
    kinds = [_known(quantity) for quantity in quantities]
    if field.dims != ("plane",):
        raise InputError("field of a stress profile must have the axis plane only; compute it on a DepthProfile(...).")
    drawn = np.stack([getattr(field, quantity) for quantity in quantities])
    in_unit, depth_unit = scale(drawn, "Pa"), scale(field.depth, "m")
    for values, kind, colour in zip(drawn, kinds, COLOURS, strict=False):
        label: str | None = kind.label
        for part in _parts(field):
            marker = "." if len(part) == 1 else ""
            ax.plot(in_unit(values[part]), depth_unit(field.depth[part]), color=colour, label=label, marker=marker)
            label = None
    _draw_interfaces(field, ax, depth_unit)
    ax.axvline(0.0, color="0.7", linewidth=0.6, zorder=0)
    ax.set(
        xlabel=f"stress ({in_unit.symbol}), at "
        + ", ".join(f"{a} = {show(float(_middle(field, a)), 'm')}" for a in ("x" if field.single_row else "xy")),
        ylabel=f"depth ({depth_unit.symbol})",
        ylim=(float(depth_unit(field.depth[-1])) or 1.0, 0.0),
    )
    # above, where it hides neither curves nor interfaces
    return legend_above(ax, min(3, len(kinds)))


def plot_stress_map(field: StressField, ax: Axes, quantity: str = "von_mises", *, plane: int = 0) -> Axes:
    """Draw one ``quantity`` on one ``plane`` (its position in the field) as a map on ``ax``, x to
    the right and y up.

    Raises InputError if the planes of the field are not whole, or quantity or plane is unknown.
    """
    kind = _known(quantity)
    if field.dims != ("plane", "x", "y"):
        raise InputError("field of a stress map must have the axes plane, x and y; compute it on Everywhere().")
    if not 0 <= plane < len(field.planes):
        raise InputError(f"plane of a stress map must be 0 to {len(field.planes) - 1}, but is {plane}.")
    section = field.planes[plane]
    values = getattr(field.only(plane), quantity)[0]
    grid = Grid((field.x.size, field.y.size), field.spacing)
    return plot_field(values, grid, ax, _look(kind, _place(section)))


def _place(section: Plane) -> str:
    """Where a plane lies, in words."""
    side = "" if section.side in ("surface", "inside") else f", {section.side} the interface"
    return "surface" if section.side == "surface" else f"depth {show(section.depth, 'm')}{side}"


def _look(kind: Quantity, place: str = "") -> Look:
    """Colours of a stress: from zero for magnitudes, about zero for those of either sign."""
    magnitude = kind.name in MAGNITUDES
    colours, label = (UNSIGNED_MAP if magnitude else SIGNED_MAP), ", ".join(filter(None, (kind.label, place)))
    reduced = "max" if magnitude else "mean"
    return Look("Pa", label, colours, from_zero=magnitude, about_zero=not magnitude, reduced=reduced)


def _cut(field: StressField, quantity: str) -> Cut:
    """One ``quantity`` of a section; where tension matters alone colours end at the largest."""
    values, kind = getattr(field, quantity), QUANTITIES[quantity]
    look = _look(kind)
    ends = limits(np.maximum(values, 0.0) if kind.name in TENSIONS and values.max() > 0.0 else values, look)
    return Cut(field, values, look, ends)


def _known(quantity: str) -> Quantity:
    return QUANTITIES[require.one_of(quantity, QUANTITIES, "stress to draw")]


def _middle(field: StressField, axis: str) -> RealArray:
    """Coordinates of the middles of the pixels, as in all figures."""
    return np.asarray(getattr(field, axis) + 0.5 * field.spacing["xy".index(axis)])


def _parts(field: StressField) -> list[list[int]]:
    """Positions of the planes of each region."""
    numbered = groupby(range(len(field.planes)), key=lambda number: field.planes[number].region.index)
    return [list(part) for _, part in numbered]


def _two_digits(value: float, _: object) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _levels(values: RealArray, kind: Quantity, *, log: bool) -> RealArray:
    """Steps of the contours: from zero or by equal factors for magnitudes; for signed stresses
    symmetric about zero.

    Where tension matters alone they end at the largest, so that a compression many times as large
    does not hide it. Zero itself is no step of signed stresses: far from the contact its line would
    follow rounding errors.
    """
    from matplotlib.ticker import MaxNLocator

    high = float(values.max()) if kind.name in TENSIONS else 0.0
    high = high if high > 0.0 else float(np.abs(values).max()) or 1.0
    if log and kind.name in MAGNITUDES:
        return high * np.logspace(-DECADES, 0.0, 2 * LEVELS + 1)
    if log:
        half = high * np.logspace(-DECADES, 0.0, LEVELS + 1)
        return np.concatenate([-half[::-1], half])
    steps = np.array(
        MaxNLocator(LEVELS, symmetric=kind.name not in MAGNITUDES).tick_values(
            -high if kind.name not in MAGNITUDES else 0.0, high
        )
    )
    return steps[np.abs(steps) > 1e-9 * high] if kind.name not in MAGNITUDES else steps


def _draw_interfaces(field: StressField, ax: Axes, depth_unit: Any) -> float:
    """Lines at the interfaces and the names of the regions: in their regions, or beside those that
    are too thin.

    Neighbours of one name are one region. Returns the room in inches that the names beside take.
    """
    parts = list(dict.fromkeys(plane.region for plane in field.planes))
    runs = [list(run) for _, run in groupby(parts, key=lambda region: region.name)]
    for run in runs[1:]:
        ax.axhline(float(depth_unit(run[0].top)), color=BLACK, linewidth=0.8)
    if len(runs) < 2:
        return 0.0
    last = field.depth[-1]
    ends = [(run[0].top / last, min(run[-1].bottom / last, 1.0), literal(run[0].name)) for run in runs]
    look: dict[str, Any] = {"xycoords": "axes fraction", "va": "center", "fontsize": 7.5}
    box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.7}
    thin = [end for end in ends if end[1] - end[0] < LABEL_ROOM]
    for top, bottom, name in ends:
        if bottom - top >= LABEL_ROOM:
            ax.annotate(name, (0.985, 1.0 - 0.5 * (top + bottom)), ha="right", bbox=box, **look)
    line = {"arrowstyle": "-", "linewidth": 0.5, "shrinkA": 0.0, "shrinkB": 0.0}
    for (top, bottom, name), place in zip(thin, apart([0.5 * (t + b) for t, b, _ in thin], LABEL_ROOM), strict=True):
        at = (1.0, 1.0 - 0.5 * (top + bottom))
        ax.annotate(name, at, (1.02, 1.0 - place), ha="left", arrowprops=line, **look)
    return 0.12 + 0.07 * max(len(name) for *_, name in thin) if thin else 0.0


# The figures of the stresses of a document: sections, depth profiles, maps of planes.


SECTION_SIZE = (6.4, 3.4)
"""Width and height in inches of a section."""

CLOSE_UP = 3.0
"""Length over depth of a close-up; sections more than twice as long get one."""

PROFILE = ("von_mises", "max_principal", "normal_zz", "shear_xz", "shear_yz")
"""Stresses on a depth profile; shear that is everywhere less than a thousandth of the largest
stress is left out."""


def line_figures(survey: StressSurvey, boundary: Boundary) -> Iterator[Figure]:
    """Figures of the sections and depth profiles of ``survey``, of a contact with this
    ``boundary``."""
    for number, section in enumerate(survey.sections, start=1):
        for figure in _section(section, number, wraps=boundary.wraps["xy".index(section.field.dims[1])]):
            yield replace(figure, of=survey.step)
    for number, field in enumerate(survey.profiles, start=1):
        sizes = {name: float(np.abs(getattr(field, name)).max()) for name in PROFILE}
        quantities = tuple(name for name, size in sizes.items() if size > 1e-3 * max(sizes.values()))
        draw = partial(plot_stress_profile, field, quantities=quantities)
        caption = "Stresses against depth; a break where a stress jumps at an interface."
        yield replace(
            curve_figure(f"stress_profile_{number}", f"Depth profile {number}", caption, draw), of=survey.step
        )


VIEW_POINTS = 120
"""Points along the longer side of a view."""

PEAK = 0.5
"""Share of the largest stress above which points about the maximum are enlarged."""


def map_figure(plane: StressField, number: int, boundary: Boundary, *, step: int = 0) -> Figure:
    """Figure of the von Mises stress on a whole ``plane``, the ``number``-th, and of its maximum
    enlarged beside; at a ``step`` of the load path, from 1."""
    section = plane.planes[0]
    depth = "the surface" if section.side == "surface" else f"a depth of {show(section.depth, 'm')}"
    side = f", just {section.side} the interface" if section.side in ("above", "below") else ""
    kind, part, grid = QUANTITIES["von_mises"], section.region, Grid((plane.x.size, plane.y.size), plane.spacing)
    stress = np.asarray(
        plane.von_mises[0], dtype=np.float32
    )  # all planes wait for their figures: without the other components
    place = Depth(section.depth, _place(section), (part.name, part.top, part.bottom))
    shown, look = Field(stress, grid, _look(kind), place), _look(kind, _place(section))

    def draw() -> Drawing:
        enlarged: list[bool] = []
        i, j = np.unravel_index(int(stress.argmax()), stress.shape)

        def map_of(ax: Axes) -> Axes:
            plot_field(stress, grid, ax, look)
            high = stress >= PEAK * stress.max()
            enlarged.append(enlarge_island(high, grid, boundary.wraps, "about the maximum", ax, (int(i), int(j))))
            return ax

        return Drawing(png(map_of, map_size(grid)), enlarged=any(enlarged))

    text = f"Map of the von Mises stress at {depth}{side}, in {section.region.name}."
    title = f"Von Mises stress at {depth}{side}"
    return Figure(f"stress_plane_{number}", title, text, draw, "map", lambda: shown, of=step)


def view_figure(planes: Sequence[StressField], *, step: int = 0) -> Figure | None:
    """Figure in space of the von Mises stress on that of the whole ``planes`` on which it is
    largest; None without a plane, or on a line."""
    wide = [plane for plane in planes if 1 not in (plane.x.size, plane.y.size)]
    if not wide:
        return None
    plane = max(wide, key=lambda each: float(each.von_mises[0].max()))
    section, grid = plane.planes[0], Grid((plane.x.size, plane.y.size), plane.spacing)
    stress = np.asarray(plane.von_mises[0], dtype=np.float32)
    depth = "the surface" if section.side == "surface" else f"a depth of {show(section.depth, 'm')}"

    def draw() -> Drawing:
        hills, blocks = thinned(stress, grid, np.max, VIEW_POINTS)

        def view(ax: Axes) -> Axes:
            return draw_view(hills, blocks, ax, Look("Pa", "von Mises stress", PRESSURE_MAP), 2.0)

        return Drawing(png(view, VIEW_SIZE, projection="3d"))

    text = f"Von Mises stress at {depth}, in {section.region.name}, as hills; the highest of each block of points."
    return Figure("stress_view", f"Von Mises stress in space at {depth}", text, draw, "view", of=step)


def _section(section: SurveyedSection, number: int, *, wraps: bool) -> Iterator[Figure]:
    """The whole section, and where that is long the close-up of the maximum, for each quantity."""
    field = section.field
    axis = "y" if field.dims[1] == "x" else "x"
    at = show(float(getattr(field, axis)) + 0.5 * field.spacing["xy".index(axis)], "m")
    for quantity in section.quantities:
        kind = QUANTITIES[quantity]
        title = kind.title if field.single_row else f"{kind.title} at {axis} = {at}"
        name = f"stress_section_{number}_{quantity}"
        caption = "depth downwards, interfaces as lines, a cross at the largest "
        caption += "tension." if kind.name in TENSIONS else "magnitude."
        if kind.name not in MAGNITUDES:
            tension = " Red is tension, blue compression, the darkest blue beyond the scale."
            caption += tension if kind.name in TENSIONS else " Red and blue are the two directions."
        near = close_up(field, quantity, wraps=wraps)
        log = near is not None
        scale = (
            " Steps are equal factors" + ("." if kind.name in MAGNITUDES else ", on both sides of zero.") if log else ""
        )
        draw = partial(plot_stress_section, field, quantity=quantity, log=log)
        shows = partial(_cut, field, quantity)
        yield Figure(name, title, f"Vertical plane, {caption}{scale}", partial(_drawn, draw), "cut", shows)
        if near is not None:
            draw = partial(plot_stress_section, near, quantity=quantity)
            text = f"Part of the plane, {caption}"
            yield Figure(f"{name}_near", f"{title}, close-up", text, partial(_drawn, draw), "cut")


def _drawn(draw: Callable[[Axes], Axes]) -> Drawing:
    return Drawing(png(draw, SECTION_SIZE))


def close_up(field: StressField, quantity: str, *, wraps: bool = False) -> StressField | None:
    """The part of a long section about its maximum; None where the section is short.

    Where the field ``wraps`` along the section, the maximum is in the middle and x or y run on
    across the border.
    """
    axis, values = field.dims[1], getattr(field, quantity)
    line, length = getattr(field, axis), CLOSE_UP * float(field.depth[-1])
    peak = field.peak(values if quantity in TENSIONS else np.abs(values))
    if line[-1] - line[0] <= 2.0 * length:
        return None
    step = field.spacing["xy".index(axis)]
    half = int(0.5 * length / step)
    middle = round((getattr(peak, axis) - line[0]) / step)
    first = middle - half if wraps else int(np.clip(middle - half, 0, line.size - 2 * half - 1))
    part = np.arange(first, first + 2 * half + 1)
    if part.size < 3:
        return None
    tensor = field.tensor.map(lambda component: component.take(part, 1, mode="wrap"))
    lines = {"x": field.x, "y": field.y} | {axis: line[0] + step * part}
    return replace(field, tensor=tensor, x=lines["x"], y=lines["y"])


def figure_of(field: StressField, kind: str) -> tuple[Callable[..., Axes], tuple[float, float]]:
    """What draws the stress ``kind`` of ``field`` on axes, von Mises' if it is empty, and the size
    in inches."""
    if field.dims == ("plane",):
        return lambda ax, **options: plot_stress_profile(field, ax, *([(kind,)] if kind else []), **options), CURVE_SIZE
    wanted = require.one_of(kind or "von_mises", QUANTITIES, "stress to draw")
    if len(field.dims) == 3:
        size = map_size(Grid((field.x.size, field.y.size), field.spacing))
        return lambda ax, **options: plot_stress_map(field, ax, wanted, **options), size
    return lambda ax, **options: plot_stress_section(field, ax, wanted, **options), SECTION_SIZE
