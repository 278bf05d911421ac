"""The figures of the stresses that a document asks for: sections, depth profiles, maps of planes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from ..core.grid import Grid
from ..core.units import show
from ..stress.field import StressField
from ..stress.survey import StressSurvey, SurveyedSection
from .figure import Figure
from .picture import CURVE_SIZE, map_size, png
from .stress import MAGNITUDES, QUANTITIES, TENSIONS, plot_stress_map, plot_stress_profile, plot_stress_section

SECTION_SIZE = (6.4, 3.4)
"""Width and height in inches of a section."""

CLOSE_UP = 3.0
"""Length over depth of a close-up; sections more than twice as long get one."""

PROFILE = ("von_mises", "max_principal", "normal_zz", "shear_xz", "shear_yz")
"""Stresses on a depth profile; shear that is everywhere less than a thousandth of the largest stress is left out."""


def line_figures(survey: StressSurvey) -> Iterator[Figure]:
    """Figures of the sections and depth profiles of ``survey``."""
    for number, section in enumerate(survey.sections, start=1):
        yield from _section(section, number)
    for number, field in enumerate(survey.profiles, start=1):
        picture = png(partial(plot_stress_profile, field, quantities=_worth_drawing(field)), CURVE_SIZE)
        caption = "Stresses against depth; a break where a stress jumps at an interface."
        yield Figure(f"stress_profile_{number}", f"Depth profile {number}", caption, picture)


def map_figure(plane: StressField, number: int) -> Figure:
    """Figure of the von Mises stress on a whole ``plane``, the ``number``-th."""
    section = plane.planes[0]
    depth = "the surface" if section.side == "surface" else f"a depth of {show(section.depth, 'm')}"
    side = f", just {section.side} the interface" if section.side in ("above", "below") else ""
    size = map_size(Grid((plane.x.size, plane.y.size), plane.spacing))
    return Figure(
        f"stress_plane_{number}",
        f"Von Mises stress at {depth}{side}",
        f"Map of the von Mises stress at {depth}{side}, in {section.region.name}.",
        png(partial(plot_stress_map, plane), size),
    )


def _section(section: SurveyedSection, number: int) -> Iterator[Figure]:
    """The whole section, and where that is long the close-up of the maximum, for each quantity."""
    field = section.field
    axis = "y" if field.dims[1] == "x" else "x"
    at = show(float(getattr(field, axis)) + 0.5 * field.spacing["xy".index(axis)], "m")
    for quantity in section.quantities:
        kind = QUANTITIES[quantity]
        title = kind.title if field.single_row else f"{kind.title} at {axis} = {at}"
        name = f"stress_section_{number}_{quantity}"
        said = "depth downwards, interfaces as lines, a cross at the largest "
        said += "tension." if (kind.name in TENSIONS) else "magnitude."
        if kind.name not in MAGNITUDES:
            tension = " Red is tension, blue compression, the darkest blue beyond the scale."
            said += tension if (kind.name in TENSIONS) else " Red and blue are the two directions."
        near = close_up(field, quantity)
        log = near is not None and not (kind.name not in MAGNITUDES)
        scale = " Steps are equal factors." if log else ""
        draw = partial(plot_stress_section, field, quantity=quantity, log=log)
        yield Figure(name, title, f"Vertical plane, {said}{scale}", png(draw, SECTION_SIZE))
        if near is not None:
            draw = partial(plot_stress_section, near, quantity=quantity)
            yield Figure(f"{name}_near", f"{title}, close-up", f"Part of the plane, {said}", png(draw, SECTION_SIZE))


def close_up(field: StressField, quantity: str) -> StressField | None:
    """The part of a long section about its maximum; None where the section is short."""
    axis, values = field.dims[1], getattr(field, quantity)
    line, length = getattr(field, axis), CLOSE_UP * float(field.depth[-1])
    peak = field.peak(values if quantity in TENSIONS else np.abs(values))
    if line[-1] - line[0] <= 2.0 * length:
        return None
    middle = float(np.clip(getattr(peak, axis), line[0] + 0.5 * length, line[-1] - 0.5 * length))
    part = np.flatnonzero(np.abs(line - middle) <= 0.5 * length)
    if part.size < 3:
        return None
    tensor = field.tensor.map(lambda component: component[:, part])
    lines = {"x": field.x, "y": field.y} | {axis: line[part]}
    return replace(field, tensor=tensor, x=lines["x"], y=lines["y"])


def _worth_drawing(field: StressField) -> tuple[str, ...]:
    sizes = {name: float(np.abs(getattr(field, name)).max()) for name in PROFILE}
    return tuple(name for name, size in sizes.items() if size > 1e-3 * max(sizes.values()))
