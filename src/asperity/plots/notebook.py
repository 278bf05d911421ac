"""What notebooks show of surfaces, results and stress fields: a card of numbers with a small picture, and figures."""

from __future__ import annotations

import base64
from html import escape
from typing import TYPE_CHECKING, Any

from ..contact.history import HistoryResult
from ..contact.result import ContactResult
from ..core import require
from ..core.grid import Grid
from ..core.text import printable
from ..io.words import heading_and_rows
from ..stress.field import StressField
from ..surfaces.surface import Surface
from .contact import MENISCI, PATH_PLOTS, PLASTIC_PLOTS, PLOTS
from .maps import plot_heights
from .picture import CURVE_SIZE, VIEW_SIZE, map_size, png, style
from .stress import QUANTITIES, SECTION_SIZE, plot_stress_map, plot_stress_profile, plot_stress_section
from .surface import plot_surface_view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SMALL = 110
"""Resolution of the picture of a card in dots per inch."""


def plot(thing: object, kind: str, ax: Axes | None, **options: Any) -> Axes:
    """Draw the figure ``kind`` of ``thing`` on ``ax``, or on a new figure of pyplot.

    Raises InputError if the thing has no such figure.
    """
    if ax is not None:
        return _draw(thing, kind, ax, **options)
    from matplotlib import pyplot

    size, projection = _shape(thing, kind)
    with style():
        figure = pyplot.figure(figsize=size, layout="constrained")  # labels stay inside however it is saved
        return _draw(thing, kind, figure.add_subplot(projection=projection), **options)


def card(thing: object) -> str:
    """HTML with the numbers of ``thing`` beside a small picture; needs no other file."""
    heading, rows = heading_and_rows(thing)
    size, projection = _shape(thing, "")
    picture = png(lambda ax: _draw(thing, "", ax), size, projection=projection, dpi=SMALL)
    cells = "".join(
        f"<tr><th style='text-align:left;font-weight:normal;color:#55606c'>{escape(printable(label))}</th>"
        f"<td style='text-align:left'>{escape(printable(text))}</td></tr>"
        for label, text in rows
    )
    return (
        "<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start'>"
        f"<div><b>{escape(heading)}</b><table>{cells}</table></div>"
        f"<img alt='{escape(heading)}' style='max-height:16em' src='data:image/png;base64,"
        f"{base64.b64encode(picture).decode('ascii')}'></div>"
    )


def _draw(thing: Any, kind: str, ax: Axes, **options: Any) -> Axes:
    if isinstance(thing, Surface):
        draw = {"heights": plot_heights, "view": plot_surface_view}
        return draw[require.one_of(kind or "heights", draw, "figure of a surface")](thing, ax, **options)
    if isinstance(thing, ContactResult):
        draws = {figure.name: figure.draw for figure in (*PLOTS, *PLASTIC_PLOTS, MENISCI)}
        return draws[require.one_of(kind or "pressure", draws, "figure of a result")](thing, ax, **options)
    if isinstance(thing, HistoryResult):
        loops = {figure.name: figure.draw for figure in PATH_PLOTS}
        return loops[require.one_of(kind or "load_loop", loops, "figure of a load history")](thing, ax, **options)
    if thing.dims == ("plane",):
        return plot_stress_profile(thing, ax, *([(kind,)] if kind else []), **options)
    wanted = require.one_of(kind or "von_mises", QUANTITIES, "stress to draw")
    draw_stress = plot_stress_map if len(thing.dims) == 3 else plot_stress_section
    return draw_stress(thing, ax, wanted, **options)


def _shape(thing: Any, kind: str) -> tuple[tuple[float, float], str | None]:
    """Width and height in inches of the figure ``kind`` of ``thing``, and the projection of its axes."""
    if isinstance(thing, Surface):
        return (VIEW_SIZE, "3d") if kind == "view" else (map_size(thing.grid), None)
    if isinstance(thing, ContactResult):
        curves = [figure.name for figure in (*PLOTS, *PLASTIC_PLOTS) if figure.kind != "map"]
        return (CURVE_SIZE if kind in curves else map_size(thing.problem.grid)), None
    if isinstance(thing, HistoryResult):
        return CURVE_SIZE, None
    assert isinstance(thing, StressField)
    if len(thing.dims) == 3:
        return map_size(Grid((thing.x.size, thing.y.size), thing.spacing)), None
    return (SECTION_SIZE if len(thing.dims) == 2 else CURVE_SIZE), None
