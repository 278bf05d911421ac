"""From drawing functions to PNG: one look for all figures, SI-prefixed axes, one set of axes a figure, no window."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core import units
from ..core.arrays import RealArray
from ..core.errors import OutputError
from ..core.grid import Grid
from ..io.atomic import atomic_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Common style of all figures: colours distinguishable by colour-blind readers, SI-prefixed axes, print resolution.


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

KINDS = {
    unit: kind
    for kind, unit in units.DIMENSIONS.items()
    if kind in ("length", "pressure", "force", "energy", "time", "area")
} | {"Pa/m": "stiffness", "N/m": "surface tension"}
"""Kind of quantity by SI unit, of those that are drawn with prefixes."""


@dataclass(frozen=True)
class Scale:
    """Prefixed unit in which values are drawn: ``symbol`` for labels, SI value of one unit in ``factor``."""

    symbol: str
    factor: float

    def __call__(self, values: Any) -> Any:
        """``values`` (SI) in this unit."""
        return np.asarray(values, dtype=float) / self.factor


def scale(values: RealArray | float, unit: str) -> Scale:
    """Scale in which the largest finite magnitude of ``values`` (SI ``unit``) lies between 1 and 1000.

    A unit that takes no prefixes stays, and that of plain numbers ("1") is empty.
    """
    if unit not in KINDS:
        return Scale("" if unit == "1" else unit, 1.0)
    magnitude = np.abs(np.asarray(values, dtype=float))
    largest = float(magnitude.max(initial=0.0, where=np.isfinite(magnitude)))
    symbol = units.show(largest, unit).split(" ")[1]
    return Scale(symbol, units.unit_factor(symbol, KINDS[unit], "unit of an axis"))


@contextmanager
def style() -> Iterator[None]:
    """Within it, matplotlib draws in the style of this package; outside nothing changes."""
    from matplotlib import rc_context

    with rc_context(SETTINGS):
        yield


# A drawn figure with what a report says of it.


@dataclass(frozen=True)
class Figure:
    """A drawn figure: ``name`` of its file, ``title``, ``caption``, and the PNG."""

    name: str
    title: str
    caption: str
    picture: bytes


# From drawing functions to PNG: one figure, one set of axes, no window.


CURVE_SIZE = (5.6, 3.4)
"""Width and height in inches of figures that are no maps."""

VIEW_SIZE = (5.6, 4.2)
"""Width and height in inches of a view in space."""

MAP_SIZE = 3.4
"""Longer side of a map in inches, about."""


@dataclass(frozen=True)
class Plot:
    """How one figure is made: ``name`` of its file, ``title``, ``caption``, what draws it; ``kind`` map, curve or view."""

    name: str
    title: str
    caption: str
    draw: Callable[[Any, Axes], Axes]
    kind: str = "curve"


def render(plot: Plot, thing: Any) -> bytes:
    """PNG of ``plot`` for ``thing``: a contact, a load path or a characterised surface."""
    last = getattr(thing, "last", thing)
    grid = getattr(last, "problem", last).surface.grid
    size = {"map": map_size(grid), "view": VIEW_SIZE}.get(plot.kind, CURVE_SIZE)
    return png(lambda ax: plot.draw(thing, ax), size, projection="3d" if plot.kind == "view" else None)


def drawn(plots: Iterable[Plot], thing: Any) -> tuple[Figure, ...]:
    """Figures of ``thing`` by ``plots``."""
    return tuple(Figure(plot.name, plot.title, plot.caption, render(plot, thing)) for plot in plots)


def png(
    draw: Callable[[Axes], Axes], size: tuple[float, float], *, projection: str | None = None, dpi: int = DPI
) -> bytes:
    """Picture of what ``draw`` puts on the axes of a new figure of ``size`` inches, cropped to its content.

    ``projection`` of the axes, ``3d`` for a view in space; ``dpi`` dots per inch.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    buffer = io.BytesIO()
    with style():
        figure = Figure(figsize=size)
        FigureCanvasAgg(figure)
        draw(figure.add_subplot(projection=projection))
        figure.savefig(buffer, format="png", dpi=dpi, bbox_inches="tight", pad_inches=0.06)
    return buffer.getvalue()


def map_size(grid: Grid) -> tuple[float, float]:
    """Figure for a map with its longer side of MAP_SIZE; slender maps are stretched (see ``maps``)."""
    width, height = grid.size
    ratio = width / height
    if 1 in grid.shape or not 1.0 / SLENDER <= ratio <= SLENDER:
        return CURVE_SIZE
    longer = MAP_SIZE * (1.5 if ratio > 2.0 else 1.0) / 0.775  # 0.775 is the share of the figure that the axes take
    return (longer, longer / ratio) if ratio >= 1.0 else (longer * ratio, longer)


def save_pictures(
    pictures: Mapping[str, Callable[[], bytes]], folder: str | Path, *, overwrite: bool = False
) -> tuple[Path, ...]:
    """Write ``pictures``, made one after the other, under their names as PNG into ``folder`` (made if missing).

    Raises
    ------
    OutputError
        If a file exists and ``overwrite`` is false, or the folder cannot be made or written.
    """
    place = Path(folder)
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"folder of the plots {place} cannot be made: {error.strerror}; choose another.") from error
    paths = tuple(place / f"{name}.png" for name in pictures)
    for make, path in zip(pictures.values(), paths, strict=True):
        with atomic_file(path, overwrite=overwrite) as file:
            file.write_bytes(make())
    return paths
