"""From drawing functions to PNG: one look for all figures, SI-prefixed axes, one set of axes a
figure, no window."""

from __future__ import annotations

import gc
import io
import math
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..contact.result import ContactResult
from ..core import units
from ..core.arrays import RealArray
from ..core.grid import Grid

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Common style of all figures: colours distinguishable by colour-blind readers, SI-prefixed axes,
# print resolution.


BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, VERMILLION, PURPLE = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#F0E442",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)
"""Colours of Okabe & Ito, distinct under every common colour blindness."""

NO_CONTACT = "#ECECEC"
"""Light grey of points without contact or without a value."""

HEIGHT_MAP, PRESSURE_MAP, GAP_MAP = "cividis", "viridis", "cividis"
"""Colour maps of even lightness."""

SLENDER = 8.0
"""Ratio of sides above which a map is stretched instead of drawn to scale."""

DPI = 200
"""Resolution of pictures in dots per inch."""

SETTINGS: Any = {
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.linewidth": 0.7,
    "axes.grid": False,
    "axes.formatter.useoffset": False,
    "lines.linewidth": 1.2,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "image.origin": "lower",
}
"""Settings of figures that this package makes; axes handed in by a caller keep the caller's."""

CONDUCTING = ("ohm", "K/W", "S", "W/K", "S/m**2", "W/(m**2*K)")
"""Units of resistances, conductances and conductances per area."""

KINDS = {
    unit: kind
    for kind, unit in units.DIMENSIONS.items()
    if kind in ("length", "pressure", "force", "energy", "time", "area")
} | {"Pa/m": "stiffness", "N/m": "surface tension", **dict.fromkeys(CONDUCTING, "conductance")}
"""Kind of quantity by SI unit, of those that are drawn with prefixes."""


@dataclass(frozen=True)
class Scale:
    """Prefixed unit in which values are drawn: ``symbol`` for labels, SI value of one unit in
    ``factor``."""

    symbol: str
    factor: float

    def __call__(self, values: Any) -> Any:
        """``values`` (SI) in this unit."""
        return np.asarray(values, dtype=float) / self.factor


def scale(values: RealArray | float, unit: str) -> Scale:
    """Scale in which the largest finite magnitude of ``values`` (SI ``unit``) lies between 1 and
    1000.

    A unit that takes no prefixes stays, and that of plain numbers ("1") is empty.
    """
    if unit not in KINDS:
        return Scale("" if unit == "1" else unit, 1.0)
    magnitude = np.abs(np.asarray(values, dtype=float))
    largest = float(magnitude.max(initial=0.0, where=np.isfinite(magnitude)))
    symbol = units.show(largest, unit).split(" ")[1]
    return Scale(symbol, units.parse_in(f"1 {symbol}", unit, "unit of an axis"))


LOGARITHMIC = 30.0
"""Ratio of largest and smallest value beyond which an axis is logarithmic."""


def wide_range(values: RealArray) -> bool:
    """Whether positive ``values`` need a logarithmic axis."""
    good = values[np.isfinite(values)]
    return bool(good.size and good.min() > 0.0 and good.max() / good.min() > LOGARITHMIC)


def colour_table(name: str) -> bytes:
    """Red, green and blue of the 256 colours of the colour map ``name``, a byte each."""
    from matplotlib import colormaps

    return bytes(colormaps[name](np.arange(256), bytes=True)[:, :3].tobytes())


def literal(text: str) -> str:
    """``text`` as it is drawn: no formula, no control characters, of at most 40 characters."""
    shown = "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in text)
    return (shown if len(shown) <= 40 else f"{shown[:39]}…").replace("$", r"\$")


BAR, BAR_ROOM = 0.08, 0.62
"""Width of a colour bar with its gap, over that of its axes, and of its numbers and label, in
inches."""


def make_room(ax: Axes, *, right: float = 0.0, top: float = 0.0, share: float = 0.0) -> None:
    """Keep ``right`` and ``top`` inches, and ``share`` of the width that is left, of the place of
    ``ax`` for what lies beside it.

    What is drawn there then stays within a subplot.
    """
    from matplotlib.transforms import Bbox

    def locate(axes: Any, renderer: Any) -> Bbox:
        place, (width, height) = axes.get_position(original=True), axes.figure.bbox.size / axes.figure.dpi
        wide = max(place.width - right / width, 0.4 * place.width) / (1.0 + share)
        tall = max(place.height - top / height, 0.4 * place.height)
        return Bbox.from_bounds(place.x0, place.y0, wide, tall)

    ax.set_axes_locator(locate)


def size_of(ax: Axes) -> tuple[float, float]:
    """Width and height of ``ax`` in inches, before an aspect is applied."""
    locate: Any = ax.get_axes_locator()
    place: Any = ax.get_position(original=True) if locate is None else locate(ax, None)
    figure: Any = ax.figure
    return place.width * figure.bbox.width / figure.dpi, place.height * figure.bbox.height / figure.dpi


def say_exaggeration(ax: Axes, what: str, across: float, up: float) -> None:
    """Write above the right end of ``ax`` how much larger ``what`` is drawn than lengths across;
    ranges of the axes in m."""
    width, height = size_of(ax)
    times = (height / up) / (width / across) if up > 0.0 and across > 0.0 else 1.0
    if max(times, 1.0 / times) > 1.05:
        ax.annotate(
            times_text(what, times),
            (1.0, 1.0),
            (0, 3),
            "axes fraction",
            "offset points",
            ha="right",
            fontsize=7.5,
        )


def times_text(what: str, times: float) -> str:
    """How many ``times`` larger ``what`` is drawn than lengths across, in words."""
    return f"{what} × {float(f'{times:.2g}'):g}"


def legend_above(ax: Axes, columns: int = 2, height: float = 1.0) -> Axes:
    """``ax`` with its legend above, where it hides nothing."""
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, height), ncols=columns, borderaxespad=0.3, borderpad=0.2)
    return ax


def apart(places: list[float], room: float) -> list[float]:
    """Increasing ``places`` between 0 and 1, moved as far as needed to be ``room`` apart and half
    of it from the ends."""
    room = min(room, 1.0 / max(len(places), 1))
    moved: list[float] = []
    for place in places:
        moved.append(max(place, moved[-1] + room if moved else 0.5 * room))
    for number in reversed(range(len(moved))):
        moved[number] = min(moved[number], 1.0 - room * (len(moved) - number - 0.5))
    return moved


@contextmanager
def style() -> Iterator[None]:
    """Within it, matplotlib draws in the style of this package; outside nothing changes."""
    from matplotlib import rc_context

    with rc_context(SETTINGS):
        yield


LABEL_WIDTH, LABEL_HEIGHT = 0.62, 0.17
"""Inches along an axis that a label such as 3×10⁻⁴ takes, and across it."""


def uncrowd(figure: Any) -> None:
    """Label logarithmic axes of ``figure`` within a decade only where labels do not overlap: those
    of matplotlib do on axes of about one."""
    from matplotlib.ticker import FuncFormatter

    for ax in figure.axes:
        for axis, room in ((ax.xaxis, LABEL_WIDTH), (ax.yaxis, LABEL_HEIGHT)):
            if axis.get_scale() == "log":
                axis.set_minor_formatter(FuncFormatter(partial(_within_decade, axis, room)))


def _within_decade(axis: Any, room: float, value: float, place: int | None) -> str:
    """Label of the minor tick at ``value``: none where two decades are labelled, or others are
    nearer than ``room`` in inches."""
    low, high = sorted(axis.get_view_interval())
    major = [at for at in axis.get_majorticklocs() if low <= at <= high]
    if len(major) > 1:
        return ""
    box = axis.axes.bbox
    length = (box.width if axis.axis_name == "x" else box.height) / axis.get_figure().dpi
    inch = math.log10(high / low) / length
    labelled = [math.log10(at) for at in major]
    leading = {
        at: round(at / 10.0 ** math.floor(math.log10(at))) for at in axis.get_minorticklocs() if low <= at <= high
    }
    for at in sorted(leading, key=lambda at: (FIRST_LABELS.index(leading[at]), at)):
        if all(abs(math.log10(at) - other) >= room * inch for other in labelled):
            labelled.append(math.log10(at))
            if math.isclose(at, value, rel_tol=1e-9):
                return rf"$\mathdefault{{{leading[at]}\times10^{{{math.floor(math.log10(at))}}}}}$"
    return ""


FIRST_LABELS = (2, 5, 3, 7, 4, 6, 8, 9, 1)
"""Multiples of a power of ten in the order in which they are labelled."""


# A drawn figure with its texts.


@dataclass(frozen=True)
class Drawing:
    """What drawing gives: the PNG, the points of the curves in it, and whether a part is drawn
    ``enlarged`` beside."""

    picture: bytes
    curves: tuple[AxesCurves, ...] = ()
    enlarged: bool = False


@dataclass(frozen=True, eq=False)
class Figure:
    """A figure, drawn when its picture is asked for: ``name`` of its file, ``title``, ``text`` of
    the caption, what draws it.

    ``draw`` may be the PNG itself.
    """

    name: str
    title: str
    text: str
    draw: Callable[[], Drawing] | bytes
    kind: str = "curve"
    """Kind of the figure, as that of ``Plot``."""
    shows: Callable[[], Any] | None = None
    """Gives the map that the figure shows (``maps.Field``, ``maps.Kinds`` or ``maps.Cut``), for a
    page that lets it be explored."""
    of_step: Callable[[Any], Any] | None = None
    """The same map of another step of a load path."""
    wide: bool = False
    """Whether it needs the whole width of a page, as one with a part enlarged does anyway."""
    of: Any = None
    """What it shows, such as the contact at one step of a load path; or the number of that step,
    from 1."""

    @cached_property
    def drawing(self) -> Drawing:
        """The figure, drawn once."""
        return Drawing(self.draw) if isinstance(self.draw, bytes) else self.draw()

    @property
    def is_drawn(self) -> bool:
        """Whether nothing is left to draw."""
        return isinstance(self.draw, bytes) or "drawing" in vars(self)

    def keep(self, drawing: Drawing) -> None:
        """Take the ``drawing`` that another process has made."""
        vars(self)["drawing"] = drawing

    @property
    def picture(self) -> bytes:
        """The PNG."""
        return self.drawing.picture

    @property
    def caption(self) -> str:
        """What is seen, a part enlarged too."""
        return self.text + (BESIDE if self.drawing.enlarged else "")


@dataclass(frozen=True, eq=False)
class AxesCurves:
    """Curves on axes of a picture.

    ``box`` are left, top, right and bottom of the axes as shares of the picture; of ``x`` and ``y``
    label, limits and whether they are logarithmic; ``curves`` are names and points, in the units of
    the axes. ``texts`` are what the points of each curve say instead of their values, none for
    most; ``cells``: the points are cells that fill the axes.
    """

    box: tuple[float, float, float, float]
    x: tuple[str, tuple[float, float], bool]
    y: tuple[str, tuple[float, float], bool]
    curves: tuple[tuple[str, RealArray, RealArray], ...]
    texts: tuple[tuple[str, ...], ...] = ()
    cells: bool = False


def saying(line: Any, texts: Iterable[str]) -> None:
    """Let the points of a drawn ``line`` say ``texts``, one each, where a page reads them out."""
    line.set_gid("\n".join(" ".join(text.split()) for text in texts))


# From drawing functions to PNG: one figure, one set of axes, no window.


CURVE_SIZE = (5.6, 3.4)
"""Width and height in inches of figures that are no maps."""

VIEW_SIZE = (5.6, 4.2)
"""Width and height in inches of a view in space."""

MAP_SIZE = 3.4
"""Longer side of a map in inches, about."""


@dataclass(frozen=True)
class Plot:
    """How one figure is made: ``name`` of its file, ``title``, ``caption``, what draws it; ``kind``
    map, curve or view."""

    name: str
    title: str
    caption: str
    draw: Callable[[Any, Axes], Axes]
    kind: str = "curve"
    beside: Callable[[Any, Axes], bool] | None = None
    """Draws a part enlarged beside the map; whether it did."""
    shows: Callable[[Any], Any] | None = None
    """Gives the map itself, as ``maps.Field`` or ``maps.Kinds``."""
    by_step: bool = True
    """Whether the map differs from step to step of a load path."""


_PAD = 0.06
"""White border of a picture in inches."""

_ROOM = 0.9
"""Room in inches around all axes, legends and texts for what belongs to them; where that takes
more, all artists are asked for their places."""

_LEVEL, _RUN_LENGTHS = 1, 3
"""Level and strategy of the PNG encoder: pictures are a tenth larger than by its usual level and
take two thirds of the time to encode."""

BESIDE = " Beside it the part within the rectangle, enlarged."


def render(plot: Plot, thing: Any) -> bytes:
    """PNG of ``plot`` for ``thing``: a contact, a load path or a characterised surface."""
    return _drawing(plot, thing).picture


def figures_by(plots: Iterable[Plot], thing: Any) -> tuple[Figure, ...]:
    """Figures of ``thing`` by ``plots``."""
    made = []
    for plot in plots:
        shows = None if plot.shows is None else partial(plot.shows, thing)
        of_step = plot.shows if plot.by_step and isinstance(thing, ContactResult) else None
        draw = partial(_drawing, plot, thing)
        made.append(Figure(plot.name, plot.title, plot.caption, draw, plot.kind, shows, of_step, of=thing))
    return tuple(made)


def _drawing(plot: Plot, thing: Any) -> Drawing:
    size = VIEW_SIZE if plot.kind == "view" else CURVE_SIZE
    if plot.kind == "map":
        last = getattr(thing, "last", thing)
        size = map_size(getattr(last, "problem", last).surface.grid)
    enlarged: list[bool] = []

    def draw(ax: Axes) -> Axes:
        plot.draw(thing, ax)
        enlarged.append(plot.beside is not None and plot.beside(thing, ax))
        return ax

    if plot.kind == "curve":
        return _curves(draw, size)
    picture = png(draw, size, projection="3d" if plot.kind == "view" else None)
    return Drawing(picture, enlarged=any(enlarged))


def curve_figure(
    name: str,
    title: str,
    text: str,
    draw: Callable[[Axes], Axes],
    size: tuple[float, float] = CURVE_SIZE,
    *,
    wide: bool = False,
) -> Figure:
    """Figure of the curves that ``draw`` puts on axes of ``size`` inches, with their points;
    ``wide`` as in ``Figure``."""
    return Figure(name, title, text, partial(_curves, draw, size), wide=wide)


def _curves(draw: Callable[[Axes], Axes], size: tuple[float, float]) -> Drawing:
    curves: list[AxesCurves] = []
    picture = png(draw, size, curves=curves)
    return Drawing(picture, tuple(curves))


def png(
    draw: Callable[[Axes], Axes],
    size: tuple[float, float],
    *,
    projection: str | None = None,
    dpi: int = DPI,
    curves: list[AxesCurves] | None = None,
) -> bytes:
    """Picture of what ``draw`` puts on the axes of a new figure of ``size`` inches, cropped to its
    content.

    ``projection`` of the axes, ``3d`` for a view in space; ``dpi`` dots per inch. The points of its
    ``curves`` are added to a list.
    """
    # a figure makes some 10⁴ objects that all live as long as it does: to look for garbage among
    # them takes a tenth of its time
    searches = gc.isenabled()
    gc.disable()
    try:
        with style():
            return encoded(_pixels(draw, size, projection, dpi, curves), dpi)
    finally:
        if searches:
            gc.enable()


def _pixels(
    draw: Callable[[Axes], Axes],
    size: tuple[float, float],
    projection: str | None,
    dpi: int,
    curves: list[AxesCurves] | None,
) -> NDArray[np.uint8]:
    """What ``png`` encodes. Nothing refers to its figure any more, so that the next search for
    garbage frees it at once."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.patches import StepPatch

    figure = Figure(figsize=size, dpi=dpi)
    FigureCanvasAgg(figure)
    draw(figure.add_subplot(projection=projection))
    uncrowd(figure)
    pixels, content = content_of(figure)
    if curves is None:
        return pixels
    every: Any = figure.axes
    for ax in every:
        found, texts = [], list[tuple[str, ...]]()
        for line in ax.get_lines():
            if line.get_transform() == ax.transData and len(line.get_xdata()) > 1:  # others mark a value
                label = str(line.get_label())
                x, y = (np.asarray(values, dtype=float) for values in line.get_data())
                found.append(("" if label.startswith("_") else label, x, y))
                texts.append(tuple(str(line.get_gid()).split("\n")) if line.get_gid() else ())
        for patch in ax.patches:
            if isinstance(patch, StepPatch):
                bars: Any = patch.get_data()
                found.append(("", 0.5 * (bars.edges[1:] + bars.edges[:-1]), np.asarray(bars.values, dtype=float)))
                texts.append(())
        if not found:
            continue
        place = ax.get_window_extent()
        left, right = ((float(edge) / figure.dpi - content.x0) / content.width for edge in (place.x0, place.x1))
        top, bottom = (1.0 - (float(edge) / figure.dpi - content.y0) / content.height for edge in (place.y1, place.y0))
        across = (ax.get_xlabel(), ax.get_xlim(), ax.get_xscale() == "log")
        up = (ax.get_ylabel(), ax.get_ylim(), ax.get_yscale() == "log")
        said = tuple(texts) if any(texts) else ()
        cells = bool(said and ax.images)
        curves.append(AxesCurves((left, top, right, bottom), across, up, tuple(found), said, cells))
    return pixels


def content_of(figure: Any) -> tuple[NDArray[np.uint8], Any]:
    """Pixels of what is drawn on ``figure``, (rows, columns, 3) from the top, and the box in inches
    that they fill.

    To draw a figure with room around it and look where it is white takes less time than to ask its
    artists for their places, which lays out all texts once more.
    """
    from matplotlib.transforms import Bbox

    pixels, box = _drawn(figure, Bbox.union(list(_places(figure))).padded(_ROOM))
    inked = pixels.view(np.uint32)[:, :, 0] != 0xFFFFFFFF
    rows, columns = (np.flatnonzero(inked.any(axis=axis)) for axis in (1, 0))
    pad = round(_PAD * figure.dpi)
    (top, bottom), (first, last) = ((int(ends[0]) - pad, int(ends[-1]) + pad + 1) for ends in (rows, columns))
    if min(top, first) < 0 or bottom > pixels.shape[0] or last > pixels.shape[1]:
        pixels, box = _drawn(figure, figure.get_tightbbox(figure.canvas.get_renderer()).padded(_PAD))
        return pixels[:, :, :3], box
    x, y = box.x0 + np.array((first, last)) / figure.dpi, box.y1 - np.array((bottom, top)) / figure.dpi
    return pixels[top:bottom, first:last, :3], Bbox.from_extents(x[0], y[0], x[1], y[1])


def _places(figure: Any) -> Iterator[Any]:
    """Box in inches of every axes of ``figure``, put where its aspect and its locator want it, and
    of the texts and legends on it."""
    waiting, renderer = list(figure.axes), figure.canvas.get_renderer()
    while waiting:
        ax = waiting.pop()
        locate = ax.get_axes_locator()
        ax.apply_aspect(locate(ax, renderer) if locate else None)
        waiting += ax.child_axes
        for artist in filter(None, (ax.patch, *ax.texts, ax.get_legend())):
            yield artist.get_window_extent(renderer).transformed(figure.dpi_scale_trans.inverted())


def _drawn(figure: Any, box: Any) -> tuple[NDArray[np.uint8], Any]:
    """Pixels of ``figure`` (rows, columns, 4) within a ``box`` (in inches), widened to whole
    pixels, and that box."""
    from matplotlib.transforms import Bbox

    first, last = np.floor(box.min * figure.dpi), np.ceil(box.max * figure.dpi)
    columns, rows = (last - first).astype(int)
    buffer, rounding = io.BytesIO(), 1e-3  # the sides are cut off to whole pixels
    within = Bbox([first / figure.dpi, (last + rounding) / figure.dpi])
    figure.savefig(buffer, format="rgba", dpi=figure.dpi, bbox_inches=within)
    return np.frombuffer(buffer.getbuffer(), np.uint8).reshape(rows, columns, 4), within


def encoded(pixels: NDArray[np.uint8], dpi: float) -> bytes:
    """PNG of red, green and blue ``pixels`` (rows, columns, 3) from the top, at ``dpi`` dots per
    inch."""
    from PIL import Image

    buffer = io.BytesIO()
    image = Image.fromarray(np.ascontiguousarray(pixels))
    image.save(buffer, format="png", dpi=(dpi, dpi), compress_level=_LEVEL, compress_type=_RUN_LENGTHS)
    return buffer.getvalue()


def map_size(grid: Grid) -> tuple[float, float]:
    """Figure for a map with its longer side of MAP_SIZE; slender maps are stretched (see
    ``maps``)."""
    width, height = grid.size
    ratio = width / height
    if 1 in grid.shape or not 1.0 / SLENDER <= ratio <= SLENDER:
        return CURVE_SIZE
    longer = MAP_SIZE * (1.5 if ratio > 2.0 else 1.0)
    wide, tall = (longer, longer / ratio) if ratio >= 1.0 else (longer * ratio, longer)
    bar = (0.0, BAR_ROOM) if ratio > 2.0 else (BAR * wide + BAR_ROOM, 0.0)
    return (wide + bar[0]) / 0.775, (tall + bar[1]) / 0.77  # shares of the figure that the axes take
