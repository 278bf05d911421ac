"""From drawing functions to PNG: one figure, one set of axes, no window."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.errors import OutputError
from ..core.grid import Grid
from ..io.atomic import atomic_file
from .maps import SLENDER
from .style import DPI, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CURVE_SIZE = (5.6, 3.4)
"""Width and height in inches of figures that are no maps."""

MAP_SIZE = 3.4
"""Longer side of a map in inches, about."""


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
