"""Maps of a surface or a contact seen from above: x to the right, y up. Grids of one row become
curves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby
from textwrap import wrap
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..contact.measure import labelled
from ..contact.result import ContactResult, passing_gap
from ..core.arrays import BoolArray, RealArray
from ..core.grid import Grid
from ..core.units import percent
from ..surfaces.surface import Surface
from .picture import (
    BAR,
    BAR_ROOM,
    BLUE,
    GAP_MAP,
    HEIGHT_MAP,
    NO_CONTACT,
    PRESSURE_MAP,
    SLENDER,
    VERMILLION,
    Plot,
    Scale,
    make_room,
    scale,
    size_of,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage

DECADES = 3.0
"""Range of the logarithmic pressure map below the maximum, in powers of ten."""

WIDE = 2.0
"""Ratio of width to height above which the colour bar lies above the map instead of beside it."""


@dataclass(frozen=True)
class Look:
    """How a field is shown: SI unit, label, colour map; whether colours start at zero, centre on
    it, are logarithmic.

    ``blank`` is what points without a value are, and ``blank_value`` (SI) what they count as along
    a line; ``reduced`` says which value stands for a block of points where a map is shown coarser
    than it is: ``max``, ``min`` or ``mean``.
    """

    unit: str
    label: str
    colours: str
    from_zero: bool = True
    about_zero: bool = False
    log: bool = False
    blank: str = "no value"
    blank_value: float | None = None
    reduced: str = "mean"


@dataclass(frozen=True)
class Depth:
    """Where a plane in a body lies: ``value`` in m, in words, and name, top and bottom (m) of its
    layer."""

    value: float
    words: str
    layer: tuple[str, float, float]


@dataclass(frozen=True, eq=False)
class Field:
    """A map: ``values`` (nx, ny) in SI, NaN where blank, on a grid, how they look, and for a plane
    in a body its depth."""

    values: RealArray
    grid: Grid
    look: Look
    depth: Depth | None = None


@dataclass(frozen=True, eq=False)
class Kinds:
    """A map of classes: the number of the class of each point (nx, ny), and name and colour of each
    class."""

    kinds: RealArray | NDArray[np.uint8]
    grid: Grid
    classes: tuple[tuple[str, str], ...]


@dataclass(frozen=True, eq=False)
class Cut:
    """A stress on a vertical section: ``values`` (planes, points) in Pa, the field they belong to,
    look and range of the colours."""

    field: Any
    values: RealArray
    look: Look
    range: tuple[float, float]

    @property
    def layers(self) -> tuple[tuple[str, float, float], ...]:
        """Name, top and bottom (m) of the layers, neighbours of one name as one."""
        runs = [list(run) for _, run in groupby(self.field.regions, key=lambda region: region.name)]
        return tuple((run[0].name, run[0].top, run[-1].bottom) for run in runs)


def plot_map(shown: Field | Kinds, ax: Axes) -> Axes:
    """Draw a map on ``ax``."""
    if isinstance(shown, Kinds):
        return plot_classes(shown.kinds, shown.grid, ax, shown.classes)
    return plot_field(shown.values, shown.grid, ax, shown.look)


def map_of(
    name: str,
    title: str,
    caption: str,
    shows: Callable[[Any], Field | Kinds],
    beside: Callable[[Any, Axes], bool] | None = None,
    *,
    by_step: bool = True,
) -> Plot:
    """Figure of the map that ``shows`` gives, which is all that is drawn; the others as of
    ``Plot``."""
    return Plot(name, title, caption, lambda thing, ax: plot_map(shows(thing), ax), "map", beside, shows, by_step)


def heights_field(surface: Surface) -> Field:
    """Heights of ``surface`` relative to their mean; missing points are blank."""
    level = np.nanmean(surface.heights, dtype=np.float64)
    flat = np.nanmax(surface.heights) == np.nanmin(surface.heights)
    heights = np.where(surface.mask, np.nan, 0.0) if flat else surface.heights - level  # not the rounding of the mean
    return Field(heights, surface.grid, Look("m", "height", HEIGHT_MAP, from_zero=False, blank="missing"))


def plot_heights(surface: Surface, ax: Axes) -> Axes:
    """Draw the heights of ``surface`` relative to their mean on ``ax``; missing points are grey."""
    return plot_map(heights_field(surface), ax)


def gap_field(result: ContactResult) -> Field:
    """Gap between the deformed surfaces of ``result``; points in contact are blank."""
    gap = np.where(result.contact, np.nan, passing_gap(result))
    look = Look("m", "gap", GAP_MAP, blank="in contact", blank_value=0.0, reduced="min")
    return Field(gap, result.problem.grid, look)


def plot_gap(result: ContactResult, ax: Axes) -> Axes:
    """Draw the gap between the deformed surfaces of ``result`` on ``ax``; points in contact are
    grey."""
    return plot_map(gap_field(result), ax)


def pressure_field(result: ContactResult, *, log: bool = False) -> Field:
    """Contact pressure of ``result``, with ``log`` on three decades; no contact is blank."""
    pressure = np.where(result.contact, result.pressure, np.nan)
    log = log and bool(result.contact.any())
    look = Look("Pa", "contact pressure", PRESSURE_MAP, log=log, blank="no contact", blank_value=0.0, reduced="max")
    return Field(pressure, result.problem.grid, look)


def plot_pressure(result: ContactResult, ax: Axes, *, log: bool = False) -> Axes:
    """Draw the contact pressure of ``result`` on ``ax``, with ``log`` on three decades; no contact
    is grey."""
    return plot_map(pressure_field(result, log=log), ax)


def indentation_field(result: ContactResult) -> Field:
    """Permanent indentation of ``result``: the plastic zone; blank where the surface never
    yielded."""
    dents = np.where(result.indented, result.permanent_indentation, np.nan)
    blank = "never plastic"
    look = Look("m", "permanent indentation", PRESSURE_MAP, blank=blank, blank_value=0.0, reduced="max")
    return Field(dents, result.problem.grid, look)


def plot_indentation(result: ContactResult, ax: Axes) -> Axes:
    """Draw the permanent indentation of ``result`` on ``ax``: the plastic zone; grey where the
    surface never yielded."""
    return plot_map(indentation_field(result), ax)


def plot_residual(result: ContactResult, ax: Axes) -> Axes:
    """Draw the heights of the composite surface that is left of ``result`` when the load is taken
    away on ``ax``."""
    return plot_heights(result.residual_surface(), ax)


def contact_kinds(result: ContactResult) -> Kinds:
    """Where the bodies of ``result`` touch: not, elastically, or at the hardness."""
    kinds = np.add(result.contact, result.plastic, dtype=np.uint8)
    classes = (("no contact", NO_CONTACT), ("elastic", BLUE), ("plastic", VERMILLION))
    return Kinds(kinds, result.problem.grid, classes if result.plastic.any() else classes[:2])


def plot_contact(result: ContactResult, ax: Axes) -> Axes:
    """Draw where the bodies of ``result`` touch on ``ax``: not, elastically, or at the hardness."""
    return plot_map(contact_kinds(result), ax)


def plot_classes(
    kinds: RealArray | NDArray[np.uint8], grid: Grid, ax: Axes, classes: tuple[tuple[str, str], ...]
) -> Axes:
    """Draw the number of the class of each point, ``kinds`` (nx, ny), on ``ax``, with shares of the
    area above the map.

    ``classes`` are name and colour of each.
    """
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    colours = [colour for _, colour in classes]
    image = _image(kinds, grid, ax, cmap=ListedColormap(colours), vmin=-0.5, vmax=len(classes) - 0.5)
    image.set_interpolation("nearest")
    handles = [
        Patch(
            facecolor=colour, edgecolor="0.4", linewidth=0.5, label=f"{name} {percent(float(np.mean(kinds == kind)))}"
        )
        for kind, (name, colour) in enumerate(classes)
    ]
    spacing = {"handlelength": 1.0, "handletextpad": 0.5, "columnspacing": 1.2, "borderaxespad": 0.3, "borderpad": 0.2}
    columns = len(handles) if len(handles) < 4 else 2
    ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, **spacing)
    return ax


def plot_field(values: RealArray, grid: Grid, ax: Axes, look: Look) -> Axes:
    """Map of ``values`` (nx, ny, SI, NaN where blank) with a colour bar, or their curve along a
    grid of one row."""
    from matplotlib.colors import LogNorm, Normalize
    from matplotlib.ticker import FuncFormatter, NullFormatter

    in_unit = scale(values, look.unit)
    title = f"{look.label} ({in_unit.symbol})" if in_unit.symbol else look.label
    drawn = in_unit(values)
    if 1 in grid.shape:
        axis = 0 if grid.shape[0] >= grid.shape[1] else 1
        length: Scale = scale(grid.size[axis], "m")
        places = (np.arange(drawn.size) + 0.5) * grid.spacing[axis]
        ax.plot(length(places), drawn.ravel(), color=BLUE, marker=".", markersize=3.0)
        ax.set(xlabel=f"{'xy'[axis]} ({length.symbol})", ylabel=title, xlim=(0.0, float(length(grid.size[axis]))))
        ax.set_yscale("log" if look.log else "linear")
        return ax
    low, high = limits(drawn, look)
    norm = LogNorm(high * 10.0**-DECADES, high, clip=True) if look.log else Normalize(low, high)
    image = _image(drawn, grid, ax, cmap=look.colours, norm=norm)
    width, height = grid.size
    wide = WIDE < width / height <= SLENDER  # the bar then lies above
    ratio = max(width / height, height / width)
    aspect = 1.0 if ratio > SLENDER else min(ratio, 4.0)  # keeps the bar's thickness on oblong maps
    place = (0.0, 1.0 + 0.03 * aspect, 1.0, 0.03 * aspect) if wide else (1.0 + 0.03 * aspect, 0.0, 0.045 * aspect, 1.0)
    title = "\n".join(wrap(title, 44))
    room = BAR_ROOM + 0.15 * title.count("\n")
    make_room(ax, top=room) if wide else make_room(ax, right=room, share=BAR * aspect)
    bar_axes = ax.inset_axes(place)
    bar = ax.figure.colorbar(image, cax=bar_axes, orientation="horizontal" if wide else "vertical")
    bar.set_label(title)
    if look.log:
        bar.formatter = FuncFormatter(lambda value, _: f"{value:g}")
        bar.minorformatter = NullFormatter()
    if wide:
        bar_axes.xaxis.set_ticks_position("top")
        bar_axes.xaxis.set_label_position("top")
    return ax


def limits(drawn: RealArray, look: Look) -> tuple[float, float]:
    """Range of colours of the values ``drawn``; equal or absent ones get a range of one unit."""
    finite = drawn[np.isfinite(drawn)]
    low = 0.0 if look.from_zero or not finite.size else float(finite.min())
    high = float(finite.max(initial=low))
    if high <= low:
        low, high = (low, low + 1.0) if look.from_zero else (low - 0.5, low + 0.5)
    return (-max(abs(low), abs(high)), max(abs(low), abs(high))) if look.about_zero else (low, high)


def _image(drawn: RealArray | NDArray[np.uint8], grid: Grid, ax: Axes, *, cmap: Any, **options: Any) -> AxesImage:
    """Pixels of ``drawn`` [x, y] with x to the right and y up, lengths to scale unless the map is
    very slender."""
    from matplotlib import colormaps

    row = 1 in grid.shape
    length = scale(grid.size[0] if row else max(grid.size), "m")
    width, height = (float(side) for side in length(grid.size))
    ratio = max(width, height) / min(width, height)
    colours = (colormaps[cmap] if isinstance(cmap, str) else cmap).with_extremes(bad=NO_CONTACT)
    image = ax.imshow(
        np.ma.masked_invalid(drawn.T),
        origin="lower",
        extent=(0.0, width, 0.0, height),
        aspect="auto" if ratio > SLENDER else "equal",
        cmap=colours,
        **options,
    )
    ax.locator_params(nbins=6, steps=(1, 2, 5, 10))
    ax.set(xlabel=f"x ({length.symbol})", ylabel="" if row else f"y ({length.symbol})")
    if row:  # nothing varies along y
        ax.set_yticks([])
    return image


@dataclass(frozen=True)
class Window:
    """Part of a map: its first pixel along x and y, which may lie before the border of a periodic
    map, and its pixels."""

    first: tuple[int, int]
    count: tuple[int, int]


def island(there: BoolArray, grid: Grid, wraps: tuple[bool, bool], at: tuple[int, int] | None = None) -> Window | None:
    """Square window about the largest island of the points ``there``, or that of the point ``at``.

    None where that is no detail of the map.
    """
    if 1 in grid.shape or max(grid.size) > SLENDER * min(grid.size) or not there.any():
        return None
    labels, _ = labelled(there, wraps=wraps)
    spot = labels == (np.argmax(np.bincount(labels[there])) if at is None else labels[at])
    ends = []  # first and last pixel along each axis; the last is beyond the border where the island crosses it
    for axis in (0, 1):
        along = spot.any(axis=1 - axis)
        places = np.flatnonzero(along)
        first, last = int(places[0]), int(places[-1])
        if wraps[axis] and not along.all():
            gaps = np.diff(np.append(places, places[0] + along.size))
            widest = int(np.argmax(gaps))
            first, last = int(places[(widest + 1) % places.size]), int(places[widest])
            last += along.size if last < first else 0
        ends.append((first, last))
    widths = [(last - first + 1) * d for (first, last), d in zip(ends, grid.spacing, strict=True)]
    side = max(ROUND * max(widths), FEWEST * max(grid.spacing))
    if side > LARGEST * min(grid.size):
        return None
    nx, ny = (round(side / d) for d in grid.spacing)
    i, j = (
        start if wraps[axis] else int(np.clip(start, 0, grid.shape[axis] - n))
        for axis, n in ((0, nx), (1, ny))
        for start in [(ends[axis][0] + ends[axis][1] + 1 - n) // 2]
    )
    return Window((i, j), (nx, ny))


ROUND, FEWEST, LARGEST = 1.8, 16, 0.5
"""Side of a window in widths of the contact, its fewest pixels, and the share of the map from which
it is not drawn."""


def enlarge(ax: Axes, grid: Grid, window: Window, title: str) -> Axes:
    """Draw the pixels of the map on ``ax`` within ``window`` once more, beside it, and a rectangle
    where they are."""
    from matplotlib.patches import Rectangle
    from matplotlib.patheffects import withStroke

    image: Any = ax.images[0]
    width, height = size_of(ax)
    aspect = grid.size[0] / grid.size[1]
    width, height = min(width, height * aspect), min(height, width / aspect)  # as drawn to scale
    bar = 0.0 if not ax.child_axes or aspect > WIDE else BAR_ROOM + BAR * width
    beside = ax.inset_axes((1.0 + (bar + 0.6) / width, 0.0, height / width, 1.0))
    steps = [float(end) / n for end, n in zip(image.get_extent()[1::2], grid.shape, strict=True)]
    (x, nx), (y, ny) = ((i * d, n * d) for i, n, d in zip(window.first, window.count, steps, strict=True))
    rows, columns = (np.arange(window.first[axis], window.first[axis] + window.count[axis]) for axis in (1, 0))
    pixels: Any = np.ma.filled(np.ma.asarray(image.get_array(), dtype=float), np.nan)
    beside.imshow(
        np.ma.masked_invalid(pixels.take(rows, 0, mode="wrap").take(columns, 1, mode="wrap")),
        origin="lower",
        extent=(x, x + nx, y, y + ny),
        cmap=image.get_cmap(),
        norm=image.norm,
        interpolation="nearest",
    )
    beside.locator_params(nbins=4)
    beside.set(xlabel=ax.get_xlabel(), ylabel=ax.get_ylabel())
    beside.set_title(title, loc="left")
    outline = [withStroke(linewidth=1.6, foreground="white")]  # seen on dark and on light maps
    ax.add_patch(Rectangle((x, y), nx, ny, fill=False, edgecolor="black", linewidth=0.6, path_effects=outline))
    return beside


def enlarge_contact(result: ContactResult, ax: Axes) -> bool:
    """Draw the largest contact of ``result`` enlarged beside its map on ``ax``; False where it is
    no detail of the map."""
    if result not in _LARGEST_CONTACTS:
        problem = result.problem
        _LARGEST_CONTACTS[result] = island(result.contact, problem.grid, problem.boundary.wraps)
    window = _LARGEST_CONTACTS[result]
    if window is not None:
        enlarge(ax, result.problem.grid, window, "largest contact")
    return window is not None


_LARGEST_CONTACTS: WeakKeyDictionary[ContactResult, Window | None] = WeakKeyDictionary()
"""Windows that every map of a contact shows: to find one takes as long as a fifth of a map."""


def enlarge_island(
    there: BoolArray,
    grid: Grid,
    wraps: tuple[bool, bool],
    title: str,
    ax: Axes,
    at: tuple[int, int] | None = None,
) -> bool:
    """Draw an island of the points ``there`` enlarged beside its map on ``ax``, as ``island``
    chooses it; whether it is one."""
    window = island(there, grid, wraps, at)
    if window is not None:
        enlarge(ax, grid, window, title)
    return window is not None
