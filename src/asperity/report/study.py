"""A self-contained HTML page on a study, its figures, tables and files."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..core.units import percent, show
from ..io.atomic import atomic_file
from ..io.tables import cell
from ..io.tree import node_of, write_tree
from ..io.words import Rows
from ..parts.advice import DOUBT
from ..parts.part import Table
from ..plots.campaign import (
    Curve,
    Transition,
    plot_convergence,
    plot_curves,
    plot_running_mean,
    plot_samples,
    plot_sensitivities,
    plot_transitions,
)
from ..plots.picture import CURVE_SIZE, Figure, curve_figure
from ..plots.together import save_pictures
from ..studies.campaign import Campaign
from ..studies.collect import CampaignState, Cause
from ..studies.monte_carlo import CONFIDENCE, estimate
from .page import shown, software_rows, write_page
from .points import axis_name, axis_words, coordinate_text, labelled, point_text
from .sweeps import MOST_CURVES, curves_axis, first_of, influence_texts, region_text, sweep_figures

if TYPE_CHECKING:
    import xarray


# Which figures a study gets, and what they show.


Draw: TypeAlias = "Callable[[Campaign, Any, Any, str], Iterator[Figure]]"
"""Draws the figures of one quantity from results and derived numbers."""


def study_figures(campaign: Campaign, data: xarray.Dataset, derived: xarray.Dataset | None) -> list[Figure]:
    """Figures of the results ``data`` of a study and of what was ``derived`` from them: one or more
    for each quantity."""
    draw: Draw = _DRAWN.get(campaign.study.document.kind, lambda of, data, _, name: sweep_figures(of, data, name))
    return [figure for name in campaign.plan.columns for figure in draw(campaign, data, derived, name)]


def _monte_carlo(campaign: Campaign, data: xarray.Dataset, derived: Any, name: str) -> Iterator[Figure]:
    array, y = data[name], labelled(data[name])
    means = derived[f"{name}_mean"]
    along = curves_axis(means)
    first, more = first_of(array, "sample")
    if along is not None:
        rows, where = _rows(means, along)
        bands, _ = _rows(derived[f"{name}_deviation"], along)
        curves = [
            Curve(text, np.asarray(row), np.asarray(band)) for (text, row), (_, band) in zip(rows, bands, strict=True)
        ]
        x = labelled(data[along])
        title = f"{y.quantity.title}, mean and scatter"
        caption = (
            f"Mean of {y.quantity.label} over the samples; the band is one standard deviation on either side{where}."
        )
        yield curve_figure(f"{name}_mean", title, caption, lambda ax: plot_curves(x, y, curves, ax))
    table = campaign.study.document.monte_carlo
    confidence = CONFIDENCE if table is None or table.stop is None else table.stop.confidence
    whole = estimate(np.asarray(first), confidence)
    samples = Labelled(y.quantity, np.asarray(first, dtype=float))
    title, caption = f"{y.quantity.title}, distribution", f"Distribution over the samples{more}."
    yield curve_figure(
        f"{name}_samples", title, caption, lambda ax: plot_samples(samples, whole.mean, whole.half_width, ax)
    )
    done = int(np.flatnonzero(np.isfinite(samples.values)).max(initial=-1)) + 1  # the rest is still to be computed
    running = [estimate(samples.values[: n + 1], confidence) for n in range(done)]
    halves, centres = (np.array([getattr(item, key) for item in running]) for key in ("half_width", "mean"))
    title = f"{y.quantity.title}, running mean"
    caption = f"Mean of the first samples and its confidence interval of {percent(confidence)}{more}."
    yield curve_figure(f"{name}_running", title, caption, lambda ax: plot_running_mean(y, halves, centres, ax))


def _convergence(campaign: Campaign, data: xarray.Dataset, derived: Any, name: str) -> Iterator[Figure]:
    table = campaign.study.document.convergence
    assert table is not None
    array, more = first_of(data[name], "level")
    limit, _ = first_of(derived[f"{name}_extrapolated"], "")
    label = {"grid": "points along x", "domain": "factor on the size"}.get(table.of, "tolerance")
    levels = Labelled(Quantity("level", "1", label), np.asarray(data["level"], dtype=float))
    y = labelled(array)
    caption = f"{y.quantity.label} from coarse to fine, and its Richardson extrapolation{more}."
    yield curve_figure(name, y.quantity.title, caption, lambda ax: plot_convergence(levels, y, float(limit), ax))


def _critical(campaign: Campaign, data: xarray.Dataset, derived: Any, name: str) -> Iterator[Figure]:
    rows, more = _rows(data[name], "thickness")
    found = {key: _rows(derived[f"{name}_{key}"], "")[0] for key in ("at_zero", "at_infinity", "floor", "ceiling")}
    transitions = [
        Transition(text, np.asarray(row)[1:-1], **{key: float(found[key][number][1]) for key in found})
        for number, (text, row) in enumerate(rows)
    ]
    y, thickness = labelled(data[name]), labelled(data["thickness"][1:-1])
    caption = (
        f"{y.quantity.title} against the thickness of the layer; dotted: without the layer and with an endless "
        f"one. Below the floor the layer does not matter, above the ceiling what lies under it does not{more}."
    )
    yield curve_figure(name, y.quantity.title, caption, lambda ax: plot_transitions(thickness, y, transitions, ax))


def _sensitivity(campaign: Campaign, data: xarray.Dataset, derived: Any, name: str) -> Iterator[Figure]:
    low, more = first_of(derived[f"{name}_low"], "scalar")
    high, _ = first_of(derived[f"{name}_high"], "scalar")
    base, _ = first_of(data[name].isel(parameter=0), "")
    names, y = [str(text) for text in np.asarray(derived["scalar"])], labelled(data[name])
    size = (CURVE_SIZE[0], max(1.6, 0.8 + 0.35 * len(names)))
    caption = f"{y.quantity.label} at the low and the high value of each scalar{more}."
    ends = np.asarray(low), np.asarray(high)
    yield curve_figure(
        name, y.quantity.title, caption, lambda ax: plot_sensitivities(names, *ends, y, float(base), ax), size
    )


_DRAWN: dict[str, Draw] = {
    "monte_carlo": _monte_carlo,
    "convergence": _convergence,
    "critical_thickness": _critical,
    "sensitivity": _sensitivity,
}
"""What draws the figures of each kind of study."""


def _rows(array: xarray.DataArray, along: str) -> tuple[list[tuple[str, xarray.DataArray]], str]:
    """Rows of ``array`` along one axis with the points of the longest other axis as text; and where
    the rest stands."""
    others = sorted((str(dim) for dim in array.dims if dim != along), key=lambda dim: -array.sizes[dim])
    fixed, more = first_of(array, along, *others[:1])
    if not others:
        return [("", fixed)], more
    count = array.sizes[others[0]]
    points = [round(number) for number in np.linspace(0, count - 1, min(count, MOST_CURVES))]
    rows = [(point_text(array[others[0]][number]), fixed.isel({others[0]: number})) for number in points]
    return rows, more


# The numbers of a study in words for tables.


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


def summary(campaign: Campaign, state: CampaignState) -> str:
    """One or two sentences on the study and how far it is."""
    kind = KINDS[campaign.study.document.kind]
    total = state.done + state.failed + state.missing
    counts = [len(axis) for axis in campaign.plan.axes]
    if state.samples is not None:
        counts[0] = state.samples
    axes = " × ".join(f"{count} {axis_name(axis)}" for count, axis in zip(counts, campaign.plan.axes, strict=True))
    text = f"{kind}: {total} cases ({axes}). {state.done} done, {state.failed} failed, {state.missing} missing."
    if state.samples is not None:
        text += f" The mean was known well enough after {state.samples} samples."
    return text


def sentences(campaign: Campaign, data: xarray.Dataset) -> list[str]:
    """What a sweep says as a whole: where all limits hold, and which axis decides each quantity."""
    if campaign.study.document.kind != "sweep":
        return []
    return [text for text in (region_text(campaign, data), *influence_texts(campaign, data)) if text]


def axis_rows(campaign: Campaign) -> Rows:
    """What is varied, and from where to where."""
    rows: Rows = []
    for axis in campaign.plan.axes:
        ends = [axis.points[number].coordinate for number in (0, len(axis) - 1)]
        texts = [coordinate_text(end, axis.unit) for end in ends]
        where = f" ({axis.path})" if axis.path else ""
        rows.append((f"{axis_name(axis)}{where}", f"{len(axis)} points, {texts[0]} to {texts[1]}"))
    for table in () if campaign.study.document.monte_carlo is None else campaign.study.document.monte_carlo.random:
        values = {key: getattr(table, key) for key in ("mean", "deviation", "low", "high")}
        given = ", ".join(f"{key} {value}" for key, value in values.items() if value is not None)
        rows.append((f"random: {table.path}", f"{table.distribution}{', ' if given else ''}{given}"))
    return rows


def derived_table(campaign: Campaign, data: xarray.Dataset, derived: xarray.Dataset) -> Table:
    """Derived numbers of every quantity at every point of the other axes."""
    columns = COLUMNS[campaign.study.document.kind]
    cells: list[tuple[str, ...]] = []
    for name in campaign.plan.columns:
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
    return Table(("Quantity", "At", *(heading for _, heading in columns)), tuple(cells))


def case_table(campaign: Campaign, data: xarray.Dataset) -> Table:
    """The first cases with their coordinates and quantities."""
    names = (*(item.quantity.name for item in campaign.plan.derived if not item.measured), *campaign.plan.columns)
    dims = [str(dim) for dim in data["outcome"].dims]
    headings = (*(axis_words(data[dim]) for dim in dims), *(str(data[name].attrs["long_name"]) for name in names))
    cells: list[tuple[str, ...]] = []
    for at in np.ndindex(data["outcome"].shape):
        if len(cells) == MOST_ROWS:
            break
        place = dict(zip(dims, at, strict=True))
        row = [
            coordinate_text(data[dim][number].item(), str(data[dim].attrs.get("units", "1")))
            for dim, number in place.items()
        ]
        row += [_text(float(data[name].isel(place)), str(data[name].attrs["units"])) for name in names]
        cells.append(tuple(row))
    return Table(headings, tuple(cells))


def warning_texts(state: CampaignState) -> list[str]:
    """What stands above a study: where the energy is hardly known, and in how many cases there are
    other warnings."""
    doubted = [cause for cause in state.findings if cause.kind == f"warning ({DOUBT})"]
    others = [cause for cause in state.findings if cause.kind.startswith("warning") and cause not in doubted]
    texts = [f"{_cases(cause.count)}, of which the first: {cause.first.message}" for cause in doubted]
    listed = ", ".join(f"{cause.kind[len('warning (') : -1]} in {_cases(cause.count)}" for cause in others)
    return [*texts, *([f"There are warnings: {listed}."] if others else [])]


def _cases(count: int) -> str:
    return f"{count} case{'s' if count > 1 else ''}"


def cause_table(campaign: Campaign, causes: Iterable[Cause], heading: str) -> Table:
    """``causes`` of failures, warnings or notes with their number and first case."""
    units: dict[str, str] = {}
    words = {axis.name: axis_name(axis) for axis in campaign.plan.axes}
    for axis in campaign.plan.axes:
        units |= {axis.name: axis.unit, **axis.columns}
    cells = []
    for cause in causes:
        places = (
            f"{words.get(name, name.replace('_', ' '))} = {coordinate_text(value, units.get(name, '1'))}"
            for name, value in cause.first.at.items()
        )
        cells.append((str(cause.count), f"{cause.kind}: {cause.first.message}", ", ".join(places)))
    return Table(("Cases", heading, "First at"), tuple(cells))


def _text(value: float | str, unit: str, *, share: bool = False) -> str:
    if isinstance(value, str):
        return value
    if math.isnan(value):
        return "–"
    return percent(value) if share else show(value, unit)


# A self-contained HTML page on a study.


def write_study_report(
    campaign: Campaign, path: str | Path, *, figures: Sequence[Figure] | None = None, overwrite: bool = False
) -> None:
    """Write a page on ``campaign``, as far as it is, to the HTML file ``path``; it needs no network
    and no other file.

    ``figures`` are those that have been drawn already.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    data, derived, state = campaign.dataset(), campaign.analysis(), campaign.state()
    found = [
        ("derived", "Findings", None if derived is None else derived_table(campaign, data, derived)),
        ("failures", "Failures by cause", cause_table(campaign, state.causes, "Cause")),
        ("findings", "Warnings and notes", cause_table(campaign, state.findings, "Warning or note")),
    ]
    write_page(
        path,
        "study.html",
        title=campaign.title,
        state=state,
        summary=summary(campaign, state),
        sentences=sentences(campaign, data),
        warnings=warning_texts(state),
        axes=axis_rows(campaign),
        tables=[(name, heading, table) for name, heading, table in found if table is not None and table.cells],
        cases=case_table(campaign, data),
        n_cases=int(data["outcome"].size),
        figures=shown(study_figures(campaign, data, derived) if figures is None else figures),
        provenance=[
            ("collected (UTC)", data.attrs["created"]),
            *software_rows(json.loads(data.attrs["software"])),
        ],
        citation_keys=data.attrs["citation_keys"].split(),
        document=data.attrs["study"],
        document_of="Study",
        overwrite=overwrite,
    )


# Everything that a study leaves for people and programs, in its folder.


RESULTS, CASES, FINDINGS, REPORT, PLOTS = "results.nc", "cases.csv", "findings.csv", "report.html", "plots"
"""Names in the folder."""


def write_study_files(campaign: Campaign, folder: Path) -> tuple[Path, ...]:
    """Write dataset, tables, figures and page of ``campaign`` into ``folder``, over those of an
    earlier time.

    Raises
    ------
    OutputError
        If one of them cannot be written.
    """
    data, derived = campaign.dataset(), campaign.analysis()
    write_tree(node_of(data), folder / RESULTS, overwrite=True)
    _table(data, folder / CASES)
    written = [folder / RESULTS, folder / CASES]
    if derived is not None:
        _table(derived, folder / FINDINGS)
        written.append(folder / FINDINGS)
    figures = study_figures(campaign, data, derived)
    save_pictures(figures, folder / PLOTS, overwrite=True)
    write_study_report(campaign, folder / REPORT, figures=figures, overwrite=True)
    return (*written, folder / PLOTS, folder / REPORT)


def _table(data: xarray.Dataset, path: Path) -> None:
    """All variables of ``data`` by case, SI, exact."""
    with atomic_file(path, overwrite=True) as partial:
        frame = data.to_dataframe() if data.sizes else data.expand_dims("all").to_dataframe()
        frame = frame.reset_index() if data.sizes else frame
        texts = frame.select_dtypes(exclude=["number", "bool"]).columns
        frame[texts] = frame[texts].map(cell)
        frame.rename(columns=cell).to_csv(partial, index=False)
