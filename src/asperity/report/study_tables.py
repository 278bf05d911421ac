"""The numbers of a study in words for tables."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.units import percent, show
from ..io.words import Rows
from ..studies.campaign import Campaign, CampaignState
from .study_figures import coordinate_text, point_text

if TYPE_CHECKING:
    import xarray

KINDS = {
    "sweep": "Sweep",
    "monte_carlo": "Monte-Carlo study",
    "convergence": "Convergence study",
    "critical_thickness": "Study of critical thickness",
    "sensitivity": "Study of sensitivity",
}
"""Names of the kinds of study."""

COLUMNS = {
    "monte_carlo": (
        ("mean", "mean"),
        ("deviation", "standard deviation"),
        ("half_width", "± (confidence)"),
        ("count", "samples"),
    ),
    "convergence": (
        ("order", "observed order"),
        ("extrapolated", "extrapolated"),
        ("error", "error of the finest level"),
    ),
    "critical_thickness": (
        ("floor", "floor"),
        ("ceiling", "ceiling"),
        ("at_zero", "without the layer"),
        ("at_infinity", "endless layer"),
    ),
    "sensitivity": (("low", "at the low value"), ("high", "at the high value"), ("elasticity", "% per %")),
}
"""Derived numbers of each kind of study, and their headings."""

MOST_ROWS = 60
"""Rows of the table of cases in a report; the files hold all."""


@dataclass(frozen=True)
class StudyTable:
    """A table of text."""

    headings: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]


def summary(campaign: Campaign, state: CampaignState) -> str:
    """One or two sentences on the study and how far it is."""
    kind = KINDS[campaign.study.document.kind]
    total = state.done + state.failed + state.missing
    counts = {axis.name: len(axis) for axis in campaign.plan.axes}
    if state.samples is not None:
        counts["sample"] = state.samples
    axes = " × ".join(f"{count} {name.replace('_', ' ')}" for name, count in counts.items())
    text = f"{kind}: {total} cases ({axes}). {state.done} done, {state.failed} failed, {state.missing} missing."
    if state.samples is not None:
        text += f" The mean was known well enough after {state.samples} samples."
    return text


def axis_rows(campaign: Campaign) -> Rows:
    """What is varied, and from where to where."""
    rows: Rows = []
    for axis in campaign.plan.axes:
        ends = [axis.points[number].coordinate for number in (0, len(axis) - 1)]
        texts = [coordinate_text(end, axis.unit) for end in ends]
        where = f" ({axis.path})" if axis.path else ""
        rows.append((f"{axis.name.replace('_', ' ')}{where}", f"{len(axis)} points, {texts[0]} to {texts[1]}"))
    for table in () if campaign.study.document.monte_carlo is None else campaign.study.document.monte_carlo.random:
        values = {key: getattr(table, key) for key in ("mean", "deviation", "low", "high")}
        given = ", ".join(f"{key} {value}" for key, value in values.items() if value is not None)
        rows.append((f"random: {table.path}", f"{table.distribution}{', ' if given else ''}{given}"))
    return rows


def derived_table(campaign: Campaign, data: xarray.Dataset, derived: xarray.Dataset) -> StudyTable:
    """Derived numbers of every quantity at every point of the other axes."""
    columns = COLUMNS[campaign.study.document.kind]
    cells: list[tuple[str, ...]] = []
    for name in campaign.study.document.quantities:
        label = str(data[name].attrs["long_name"])
        shape = derived[f"{name}_{columns[0][0]}"]
        for at in np.ndindex(shape.shape):
            place = dict(zip(map(str, shape.dims), at, strict=True))
            where = ", ".join(point_text(derived[dim][number]) for dim, number in place.items())
            texts = []
            for key, _ in columns:
                variable = derived[f"{name}_{key}"].isel(place)
                texts.append(_text(variable.item(), str(variable.attrs["units"]), share=key == "error"))
            cells.append((label, where, *texts))
    return StudyTable(("Quantity", "At", *(heading for _, heading in columns)), tuple(cells))


def case_table(campaign: Campaign, data: xarray.Dataset) -> StudyTable:
    """The first cases with their coordinates and quantities."""
    names = campaign.study.document.quantities
    dims = [str(dim) for dim in data["outcome"].dims]
    headings = (*(dim.replace("_", " ") for dim in dims), *(str(data[name].attrs["long_name"]) for name in names))
    cells: list[tuple[str, ...]] = []
    for at in np.ndindex(data["outcome"].shape):
        if len(cells) == MOST_ROWS:
            break
        place = dict(zip(dims, at, strict=True))
        row = [point_text(data[dim][number]).removeprefix(f"{dim.replace('_', ' ')} ") for dim, number in place.items()]
        row += [_text(float(data[name].isel(place)), str(data[name].attrs["units"])) for name in names]
        cells.append(tuple(row))
    return StudyTable(headings, tuple(cells))


def failure_table(campaign: Campaign) -> StudyTable:
    """Causes of failures with their number and first case."""
    cells = []
    for cause in campaign.causes():
        at = ", ".join(
            f"{name} = {value:.6g}" if isinstance(value, float) else f"{name} = {value}"
            for name, value in cause.first.at.items()
        )
        cells.append((str(cause.count), f"{cause.kind}: {cause.first.message}", at))
    return StudyTable(("Cases", "Cause", "First at"), tuple(cells))


def _text(value: float | str, unit: str, *, share: bool = False) -> str:
    if isinstance(value, str):
        return value
    if math.isnan(value):
        return "–"
    return percent(value) if share else show(value, unit)
