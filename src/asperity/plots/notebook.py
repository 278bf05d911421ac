"""What notebooks show of surfaces, results, stress fields and comparisons: a card of numbers with a
small picture, and figures."""

from __future__ import annotations

import base64
from collections.abc import Callable, Sequence
from functools import partial
from html import escape
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from ..contact.history import HistoryResult
from ..contact.result import ContactResult
from ..core import require
from ..core.registry import DRAWN, MORE_FIGURES, PATH_FIGURES, home
from ..core.words import printable
from ..io.description import kind_name
from ..io.words import heading_and_rows
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..surfaces.characterise.summary import Characterisation
from ..surfaces.profile import Profile
from ..surfaces.profile_summary import ProfileCharacterisation
from ..surfaces.surface import Surface
from .comparison import SIZE as COMPARISON_SIZE
from .comparison import comparison_plots
from .contact import PATH_PLOTS, PLASTIC_PLOTS, PLOTS, physics_plots
from .maps import plot_heights
from .picture import CURVE_SIZE, VIEW_SIZE, Plot, map_size, png, style, uncrowd
from .profile import PROFILE_PLOTS, plot_profile
from .scans import SCANS_PLOTS
from .surface import SURFACE_PLOTS, plot_surface_view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SMALL = 110
"""Resolution of the picture of a card in dots per inch."""


def plot(thing: object, kind: str, ax: Axes | None, **options: Any) -> Axes:
    """Draw the figure ``kind`` of ``thing`` on ``ax``, or on a new figure of pyplot.

    Raises InputError if the thing has no such figure.
    """
    chosen = _chosen(thing, kind)
    if ax is not None:
        return chosen.draw(ax, **options)
    from matplotlib import pyplot

    # loads the backend: that of notebooks makes pyplot interactive, which the end of the style
    # would undo
    pyplot.draw_if_interactive()  # type: ignore[no-untyped-call]
    with style():
        figure = pyplot.figure(figsize=chosen.size, layout="constrained")  # labels stay inside however it is saved
        drawn = chosen.draw(figure.add_subplot(projection=chosen.projection), **options)
        uncrowd(figure)
        return drawn


def card(thing: object) -> str:
    """HTML with the numbers of ``thing`` beside a small picture; needs no other file."""
    heading, rows = heading_and_rows(thing)
    chosen = _chosen(thing, "")
    picture = png(chosen.draw, chosen.size, projection=chosen.projection, dpi=SMALL)
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


class _Chosen(NamedTuple):
    """A figure: what draws it on axes, its width and height in inches, and the projection of its
    axes."""

    draw: Callable[..., Axes]
    size: tuple[float, float]
    projection: str | None = None


_OF_SURFACE = (Plot("heights", "", "", plot_heights, "map"), Plot("view", "", "", plot_surface_view, "view"))


def _chosen(thing: Any, kind: str) -> _Chosen:
    """The figure ``kind`` of ``thing``, the most telling one if it is empty."""
    name = kind_name(type(thing))
    for drawn in DRAWN:
        if name == f"asperity.{drawn.home}":
            return _Chosen(*home(drawn.figure)(thing, kind))
    thing = getattr(thing, "dataset", thing)  # of a comparison
    thing = getattr(thing, "drawn", thing)  # of an outcome
    plots: Sequence[Plot]
    if isinstance(thing, Surface):
        what, first, plots = "a surface", "heights", _OF_SURFACE
    elif isinstance(thing, Profile):
        what, first, plots = "a line scan", "heights", (Plot("heights", "", "", plot_profile),)
    elif isinstance(thing, ProfileCharacterisation):
        what, first, plots = "a characterised line scan", "trace", PROFILE_PLOTS
    elif isinstance(thing, Characterisation):
        what, first, plots = "a characterisation", "distribution", SURFACE_PLOTS
    elif isinstance(thing, ScansSpectrum):
        what, first, plots = "a spectrum of scans", "spectrum", SCANS_PLOTS
    elif isinstance(thing, ContactResult):
        more = (*physics_plots(), *map(home, MORE_FIGURES))
        what, first, plots = "a result", "pressure", (*PLOTS, *PLASTIC_PLOTS, *chain.from_iterable(more))
    elif isinstance(thing, HistoryResult):
        own = {name: home(place) for name, place in PATH_FIGURES.items()}
        first = next((plots[0].name for name, plots in own.items() if name in thing.last.couplings), "load_loop")
        what, plots = "a load history", (*PATH_PLOTS, *chain.from_iterable(own.values()))
    else:
        what, first, plots = "a comparison", "area", comparison_plots(thing)
    by_name = {plot.name: plot for plot in plots}
    plot = by_name[require.one_of(kind or first, by_name, f"figure of {what}")]
    draw = partial(plot.draw, thing)
    if plot.kind == "view":
        return _Chosen(draw, VIEW_SIZE, "3d")
    if plot.kind == "map":
        one = getattr(thing, "last", thing)
        return _Chosen(draw, map_size(getattr(one, "problem", getattr(one, "surface", one)).grid))
    return _Chosen(draw, COMPARISON_SIZE if plot.kind == "comparison" else CURVE_SIZE)
