"""Vertical sections and depth profiles through the maxima of a survey, cut out of whole planes as they pass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..core.grid import Grid
from ..core.tensor import StressTensor
from .field import Peak, StressField
from .request import Contact, Place, StressRequest, WantedSection
from .where import DepthProfile, Position, Section, Selection, Where, selection


def wanted_lines(request: StressRequest, result: Contact, peaks: dict[str, Peak]) -> dict[Where, tuple[str, ...]]:
    """Sections and profiles at positions of nodes, each with what it is to show.

    A section through the maximum is one for each stress, on the plane through its own largest magnitude.
    """
    grid = result.problem.grid
    found: dict[Where, tuple[str, ...]] = {}
    for section in request.sections:
        for quantity in _shown_on(section):
            place = getattr(peaks[quantity], section.axis) if section.place == "max" else section.place
            where = Section(**{section.axis: _on_node(place, section.place, grid, section.axis)})
            found[where] = tuple(dict.fromkeys((*found.get(where, ()), quantity)))
    top = peaks["von_mises"]
    for line in request.profiles:
        x, y = (_on_node(getattr(top, a) if p == "max" else p, p, grid, a) for a, p in (("x", line.x), ("y", line.y)))
        found[DepthProfile(x, y)] = ()
    return found


def _shown_on(section: WantedSection) -> tuple[str, ...]:
    return ("von_mises", "principal_tensile", "shear_xz" if section.axis == "y" else "shear_yz")


def _on_node(place: Place, wanted: Place, grid: Grid, axis: str) -> Position:
    """Position of a node: the user's is that of figures, where a node owns the pixel that begins there."""
    if place == "pressure":
        return "max"  # as the library calls the place of the highest pressure
    assert isinstance(place, float)
    return place - 0.5 * grid.spacing["xy".index(axis)] if isinstance(wanted, float) else place


def cut(planes: Iterator[StressField], lines: list[Where], result: Contact) -> list[StressField]:
    """The ``lines`` out of whole planes."""
    places = [selection(line, result.problem.grid, result.pressure) for line in lines]
    cuts: list[list[StressField]] = [[] for _ in lines]
    for field in planes:
        for place, found in zip(places, cuts, strict=True):
            found.append(_at(field, place))
    for found in cuts:
        if found[-1].planes[0].side == "below":  # the region that begins at the last depth is not shown
            found.pop()
    return [_joined(found) for found in cuts]


def _at(field: StressField, place: Selection) -> StressField:
    """The points of a whole plane that ``place`` picks."""
    part = (slice(None), *place.index)
    tensor = field.tensor.map(lambda component: component[part].copy())
    return replace(field, tensor=tensor, x=place.x, y=place.y, dims=("plane", *place.dims))


def _joined(planes: list[StressField]) -> StressField:
    """One field of the fields of single ``planes``."""
    components = (np.concatenate([getattr(f.tensor, name) for f in planes]) for name in vars(planes[0].tensor))
    return replace(planes[0], planes=tuple(f.planes[0] for f in planes), tensor=StressTensor(*components))
