"""Surfaces of a problem document: read or generated, then prepared step by step."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

from ..core import units
from ..surfaces.common_grid import on_common_grid
from ..surfaces.pair import turned_over
from ..surfaces.prepare.extent import cropped, periodised, resampled, sliced, tapered
from ..surfaces.prepare.fill import filled
from ..surfaces.prepare.filter import filtered, tip_limited
from ..surfaces.prepare.level import despiked, levelled, line_corrected
from ..surfaces.read import read
from ..surfaces.surface import Surface
from .build_generated import build_generated
from .quantities import si_values
from .schemas import surfaces as tables
from .schemas.preparation import (
    Crop,
    Despike,
    Fill,
    Filter,
    Level,
    LineCorrect,
    Periodise,
    Resample,
    Slice,
    Step,
    Taper,
    TipLimit,
)
from .schemas.values import MIDDLE

_Table: TypeAlias = tables.SurfaceTable


def build_surface(table: _Table, folder: Path) -> Surface:
    """Surface of ``table`` after its preparation steps; a relative file path starts at ``folder``."""
    if isinstance(table, tables.FileSurface):
        return build_file_surface(table, folder)
    return _prepared(build_generated(table, folder, build_file_surface), table)


def build_file_surface(table: tables.FileSurface, folder: Path) -> Surface:
    """Surface of a file after its preparation steps."""
    return _prepared(_from_file(table, folder), table)


def build_surfaces(table: _Table, counter: _Table | None, folder: Path) -> tuple[Surface, Surface | None]:
    """Surface and counter surface, the latter turned over and placed as it asks, so that it lies in the frame of the first."""
    surface = build_surface(table, folder)
    if counter is None:
        return surface, None
    other = build_surface(counter, folder)
    if counter.mirror not in (None, "none"):
        other = turned_over(other, axis=str(counter.mirror))
    if counter.place is None:
        return surface, other
    place = si_values(counter.place)
    pair = on_common_grid(
        surface, other, shift=place.get("shift", (0.0, 0.0)), angle=place.get("angle", 0.0), spacing=place.get("pixel")
    )
    return pair.surface, pair.counter_surface


def _prepared(surface: Surface, table: _Table) -> Surface:
    for step in table.prepare:
        surface = prepared(surface, step)
    return surface


def prepared(surface: Surface, step: Step) -> Surface:
    """``surface`` after one preparation step."""
    carry_out: Callable[[Surface, Any], Surface] = _STEPS[type(step)]
    return carry_out(surface, step)


def _level(surface: Surface, step: Level) -> Surface:
    return levelled(surface, (step.form or "plane") if step.degree is None else step.degree, robust=step.robust)


def _filter(surface: Surface, step: Filter) -> Surface:
    given = si_values(step)
    cutoffs = {name: (given[name], given.get(f"{name}_y", given[name])) for name in ("short", "long") if name in given}
    return filtered(surface, short=cutoffs.get("short"), long=cutoffs.get("long"), kind=step.kind, order=step.order)


def _slice(surface: Surface, step: Slice) -> Surface:
    x, y = (_length(at) if at not in (None, MIDDLE) else at for at in (step.x, step.y))
    return sliced(surface, x=x, y=y, length=_length(step.length))  # type: ignore[arg-type]


_STEPS: dict[type, Callable[[Surface, Any], Surface]] = {
    Level: _level,
    Crop: lambda surface, step: cropped(surface, x=_interval(step.x), y=_interval(step.y)),
    Resample: lambda surface, step: resampled(surface, step.points),
    Fill: lambda surface, step: filled(surface, step.method),
    Despike: lambda surface, step: despiked(surface, step.threshold, window=step.window),
    LineCorrect: lambda surface, step: line_corrected(surface, step.axis),
    Filter: _filter,
    TipLimit: lambda surface, step: tip_limited(surface, _length(step.radius)),
    Taper: lambda surface, step: tapered(surface, step.width),
    Periodise: lambda surface, _: periodised(surface),
    Slice: _slice,
}
"""What carries out each kind of step."""


def _from_file(table: tables.FileSurface, folder: Path) -> Surface:
    return read(
        folder / table.path,
        channel=table.channel,
        size=None if table.size is None else units.parse_size(table.size),
        height_unit=table.height_unit,
        z_scale=None if table.z_scale is None else _length(table.z_scale),
    )


def _interval(ends: tuple[str, str] | None) -> tuple[float, float] | None:
    return None if ends is None else (_length(ends[0]), _length(ends[1]))


def _length(value: float | str) -> float:
    return units.parse(value, "length", "length")
