"""What a sweep shows and says: figures with every axis on them, which axis decides, where all
limits hold."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.quantity import Labelled, Limit
from ..core.units import percent
from ..plots.campaign import Curve, plot_curves
from ..plots.picture import CURVE_SIZE, Figure, curve_figure
from ..plots.sweeps import PANEL, Panel, plot_limit, plot_panels, plot_planes, plot_points
from ..studies.campaign import Campaign
from ..studies.influence import influence, region
from .points import axis_words, coordinate_text, labelled, point_text

if TYPE_CHECKING:
    import xarray

MOST_CURVES, MOST_COLUMNS, MOST_ROWS = 7, 4, 3
"""Curves in one panel, panels beside and below one another."""

LEAST_PLANE = 3
"""Points of an axis from which on a map over it shows more than curves."""

NEGLIGIBLE = 0.01
"""Share of the variance below which an axis does not count."""


def sweep_figures(campaign: Campaign, data: xarray.Dataset, name: str) -> Iterator[Figure]:
    """Figures of the quantity ``name``: curves over the longest axis of numbers, further axes as
    curves and panels; points over numbers that say where a case lies; a map over two axes."""
    array, limit = data[name], _limit(campaign, name)
    along = curves_axis(array)
    if along is None:
        return
    y = labelled(array)
    x = labelled(data[along] if along != "case" else data[along].assign_attrs(long_name="case"))
    panels, more = _panels(array, along)
    caption = f"{y.quantity.title} against {x.quantity.label}{more}."
    if limit is not None:
        caption += " Dashed: the limit."
    if len(panels) == 1 and len(panels[0]) == 1:
        curves = panels[0][0].curves

        def draw(ax: Any) -> Any:
            plot_curves(x, y, curves, ax)
            if limit is not None:
                plot_limit(limit, y, ax)
            return ax

        yield curve_figure(name, y.quantity.title, caption, draw)
    else:
        columns = max(map(len, panels))
        size = PANEL[0] * columns, PANEL[1] * len(panels)
        yield curve_figure(
            name, y.quantity.title, caption, lambda ax: plot_panels(x, y, panels, limit, ax), size, wide=columns > 2
        )
    for item in campaign.plan.derived:
        if not item.measured:
            yield _points(data, name, item.quantity.name)
    plane = _planes(data, array, along, limit)
    if plane is not None:
        yield plane


def _points(data: xarray.Dataset, name: str, over: str) -> Figure:
    """All cases over a number that says where they lie, marked by the axis of the fewest points
    that it may differ along."""
    x, y, array = labelled(data[over]), labelled(data[name]), data[name]
    dims = sorted((str(dim) for dim in array.dims if 1 < array.sizes[dim] <= MOST_CURVES), key=lambda d: array.sizes[d])
    if dims:
        groups = [
            (
                point_text(data[dims[0]][number]),
                np.asarray(data[over].isel({dims[0]: number}), dtype=float).ravel(),
                np.asarray(array.isel({dims[0]: number}), dtype=float).ravel(),
            )
            for number in range(array.sizes[dims[0]])
        ]
    else:
        groups = [("", x.values.ravel(), y.values.ravel())]
    title = f"{y.quantity.title} against {x.quantity.label}"
    return curve_figure(f"{name}_over_{over}", title, f"{title}: all cases.", lambda ax: plot_points(x, y, groups, ax))


def _planes(data: xarray.Dataset, array: xarray.DataArray, along: str, limit: Limit | None) -> Figure | None:
    """Maps over the two longest axes of numbers, a panel for each point of a further one."""
    others = sorted((str(dim) for dim in array.dims if dim != along), key=lambda dim: -array.sizes[dim])
    numbers = [dim for dim in others if array.sizes[dim] >= LEAST_PLANE and data[dim].dtype.kind == "f"]
    if not numbers or array.sizes[along] < LEAST_PLANE:
        return None
    over = numbers[0]
    third = next((dim for dim in others if dim != over and array.sizes[dim] > 1), None)
    kept = (along, over) if third is None else (along, over, third)
    shown, more = first_of(array, *kept)
    points = [0] if third is None else _chosen(array.sizes[third], MOST_COLUMNS)
    parts = [shown if third is None else shown.isel({third: number}) for number in points]
    titles = ["" if third is None else point_text(data[third][number]) for number in points]
    x, y, z = labelled(data[along]), labelled(data[over]), labelled(array)
    stack = Labelled(z.quantity, np.stack([np.asarray(part.transpose(along, over), dtype=float) for part in parts]))
    title = f"{z.quantity.title} over {x.quantity.label} and {y.quantity.label}"
    size = CURVE_SIZE if len(parts) == 1 else (PANEL[0] * len(parts) + 0.8, PANEL[1] + 0.4)
    return curve_figure(
        f"{array.name}_map",
        title,
        f"{title}, a cell a case{more}." + ("" if limit is None else " The line: where the limit is reached."),
        lambda ax: plot_planes(x, y, stack, titles, limit, ax),
        size,
        wide=len(parts) > 2,
    )


def _limit(campaign: Campaign, name: str) -> Limit | None:
    """The first limit of a quantity."""
    return next((limit for quantity, limit in campaign.plan.limits if quantity == name), None)


def curves_axis(data: xarray.DataArray) -> str | None:
    """The axis of numbers with the most points, of which there must be two; None without."""
    numeric = {str(dim): size for dim, size in data.sizes.items() if size > 1 and data[dim].dtype.kind == "f"}
    return max(numeric, key=lambda dim: numeric[dim]) if numeric else None


def _panels(array: xarray.DataArray, along: str) -> tuple[list[list[Panel]], str]:
    """Rows of panels with curves along one axis: the longest other axis as curves, the next two as
    panels; and what is left out."""
    others = sorted((str(dim) for dim in array.dims if dim != along), key=lambda dim: -array.sizes[dim])
    others = [dim for dim in others if array.sizes[dim] > 1]
    fixed, more = first_of(array, along, *others[:3])
    chosen = [
        _chosen(array.sizes[dim], most)
        for dim, most in zip(others, (MOST_CURVES, MOST_COLUMNS, MOST_ROWS), strict=False)
    ]
    left = [
        axis_words(array[dim]) for dim, points in zip(others, chosen, strict=False) if len(points) < array.sizes[dim]
    ]
    if left:
        more = f"{more}; of {' and '.join(left)} some points only"
    rows: list[list[Panel]] = []
    for third in chosen[2] if len(others) > 2 else [None]:
        row = []
        for second in chosen[1] if len(others) > 1 else [None]:
            place = {} if second is None else {others[1]: second}
            place |= {} if third is None else {others[2]: third}
            title = "; ".join(point_text(array[dim][number]) for dim, number in place.items())
            part = fixed.isel(place)
            curves = [
                Curve(point_text(array[others[0]][number]), np.asarray(part.isel({others[0]: number}), dtype=float))
                for number in (chosen[0] if others else ())
            ]
            row.append(Panel(title, tuple(curves) or (Curve("", np.asarray(part, dtype=float)),)))
        rows.append(row)
    return rows, more


def _chosen(count: int, most: int) -> list[int]:
    return [round(number) for number in np.linspace(0, count - 1, min(count, most))]


def first_of(array: xarray.DataArray, *kept: str) -> tuple[xarray.DataArray, str]:
    """``array`` at the first point of all axes that are not ``kept``, and these points as text."""
    dims = [str(dim) for dim in array.dims if dim not in kept]
    texts = [point_text(array[dim][0]) for dim in dims if array.sizes[dim] > 1 or array.ndim > len(kept) + 1]
    return array.isel(dict.fromkeys(dims, 0)), f", at {', '.join(texts)}" if texts else ""


# In words.


def influence_texts(campaign: Campaign, data: xarray.Dataset) -> list[str]:
    """One sentence on each quantity: which axes decide it, and how much."""
    texts = []
    for name in campaign.plan.columns:
        array = data[name].squeeze()
        dims = [str(dim) for dim in array.dims]
        found = influence(np.asarray(array, dtype=float), dims) if len(dims) > 1 else None
        if found is None:
            continue
        words = {dim: axis_words(data[dim]) for dim in dims}
        counted = [(words[dim], share) for dim, share in found.shares if share >= NEGLIGIBLE]
        small = [words[dim] for dim, share in found.shares if share < NEGLIGIBLE]
        parts = [f"{word} {percent(share, 2)}" for word, share in counted[1:]]
        if small:
            parts.append(f"{' and '.join(small)} below {percent(NEGLIGIBLE, 2)}")
        if found.together >= NEGLIGIBLE:
            parts.append(f"axes together {percent(found.together, 2)}")
        what = f"{array.attrs['long_name']} over the cases{' (of its logarithm)' if found.logarithmic else ''}"
        if counted:
            word, share = counted[0]
            first = f"{word[:1].upper()}{word[1:]} decides {percent(share, 2)} of the variation of {what}"
        else:
            first = f"No axis alone decides the variation of {what}"
        texts.append("; ".join([first, *parts]) + ".")
    return texts


def region_text(campaign: Campaign, data: xarray.Dataset) -> str:
    """Where all limits hold; empty where the study has none."""
    limits = campaign.plan.limits
    if not limits:
        return ""
    within = np.ones(data["outcome"].shape, dtype=bool)
    for name, limit in limits:
        values = np.asarray(data[name], dtype=float)
        with np.errstate(invalid="ignore"):
            within &= values >= limit.value if limit.least else values <= limit.value
    found = region(within)
    given = " and ".join(
        f"{data[name].attrs['long_name']} at {'least' if limit.least else 'most'} "
        f"{coordinate_text(limit.value, str(data[name].attrs['units']))}"
        for name, limit in limits
    )
    if not found.fitting:
        return f"No case is within all limits ({given})."
    parts = []
    for dim, (first, last) in zip(map(str, data["outcome"].dims), found.ranges, strict=True):
        points = data[dim]
        ends = [point_text(points[number]) for number in (first, last)]
        if first == last and points.size > 1:
            parts.append(ends[0])
        elif (first, last) != (0, points.size - 1):
            parts.append(f"{ends[0]} to {ends[1].removeprefix(axis_words(points)).strip()}")
    where = f"all those at {', '.join(parts)} among them" if parts else "whatever the axes"
    count = math.prod(last - first + 1 for first, last in found.ranges)
    return f"{found.fitting} of {found.cases} cases are within all limits ({given}), {where} ({count} cases)."
