"""The page of sweeps: one scalar of the document is varied, and the curves grow while the cases
finish."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from nicegui import ui

from ..core.errors import AsperityError
from ..io.schemas.study import DEFAULT_QUANTITIES
from ..io.tables import table_text
from ..plots.picture import scale
from ..report.study import case_table
from ..studies.campaign import STUDY, open_study
from ..studies.documents import study_from_table
from ..studies.places import scalars
from ..studies.plan import make_plan, measures
from . import maps
from .layout import failure, text_table
from .pages_run import STATES, cancel, progress, start_sweep
from .session import Run, Session

NOT_VARIED = ("path", "materials_file", "liquids_file", "kind", "step", "version", "title")
"""Keys whose values are no numbers."""


def sweep_page(key: str, session: Session, chosen: str = "", beside: str = "") -> None:
    """Form of a new sweep, and all sweeps with their curves."""
    try:
        document = session.draft.document()
    except AsperityError:
        document = None
    if document is None:
        failure("The document is not complete yet: the page Run lists what is missing.")
    with ui.element("div").classes("two"):
        with ui.element("section"):
            if document is not None:
                _form(session, document)
        with ui.element("section"):
            sweeps = [run for run in session.runs.values() if run.kind == "sweep"]
            if not sweeps:
                ui.label("Sweeps appear here; their curves grow while cases finish.").classes("hint")
            for run in reversed(sweeps):
                _Sweep(key, session, run)


def _form(session: Session, document: Any) -> None:
    """Axis, values and quantities."""
    places = {p.path: p for p in scalars(document) if p.path.rpartition(".")[2] not in NOT_VARIED}
    given = {
        path: session.draft.get(*(int(key) if key.isdigit() else key for key in path.split("."))) for path in places
    }
    usual = next((path for path in places if path.startswith("control.") and given[path]), None)
    known = measures()

    def table() -> dict[str, Any]:
        def value(text: str) -> Any:
            place = places[str(axis.value)]
            return text if place.quantity is not None else float(text)

        row: dict[str, Any] = {"path": axis.value, "scale": spacing.value}
        row |= {"first": value(first.value), "last": value(last.value), "count": int(count.value or 0)}
        return {
            "version": 1,
            "title": f"{session.draft.get('title') or 'Contact'} against {axis.value}",
            "problem": session.draft.table,
            "quantities": list(quantities.value or ()),
            "axes": [row],
        }

    def begin() -> None:
        try:
            made = table()
            there = {**made, "problem": session.named_from_sweeps(made["problem"])}
            make_plan(study_from_table(there, session.folder / "sweeps" / "new", "sweep"))
            start_sweep(session, made["title"], made)
        except (AsperityError, ValueError, TypeError, KeyError) as error:
            ui.notify(session.said(str(error)), type="negative", multi_line=True)
            return
        ui.navigate.reload()

    with ui.card().classes("table").props("flat bordered"):
        ui.label("A new sweep").classes("table-title")
        axis = ui.select(sorted(places), label="What is varied", value=usual, with_input=True).props(
            "dense data-key=axis"
        )
        with ui.element("div").classes("fields"):
            current = str(given[usual] if usual else "")
            first = ui.input("From", value=current, placeholder="1 MPa").props("dense stack-label data-key=first")
            last = ui.input("To", placeholder="100 MPa").props("dense stack-label data-key=last")
            count = ui.number("Cases", value=8, min=1, precision=0).props("dense data-key=count")
            spacing = ui.select(["linear", "log"], label="Spacing", value="log").props("dense data-key=scale")
        quantities = ui.select(
            {name: f"{name}: {quantity.label}" for name, quantity in known.items()},
            label="Quantities",
            value=list(DEFAULT_QUANTITIES),
            multiple=True,
            with_input=True,
        ).props("dense use-chips data-key=quantities")
        ui.button("Start the sweep", icon="play_arrow", on_click=begin).props("no-caps data-sweep")
        ui.label("It is the study that asperity run carries out; finished cases are never lost.").classes("hint")


class _Sweep:
    """One sweep with a curve for each quantity."""

    def __init__(self, key: str, session: Session, run: Run) -> None:
        self.session, self.run, self.seen = session, run, ""
        self.folder: Path = session.folder_of(run)
        self.client = ui.context.client
        with (
            ui.card()
            .classes("table run")
            .props(f'flat bordered data-run-key="{run.key}" data-state="{run.state}"') as card
        ):
            self.card = card
            with ui.row().classes("item-head"):
                self.icon = ui.icon(STATES[run.state])
                ui.label(f"{run.key.split('-')[0]}  {run.title}").classes("table-title")
                ui.space()
                if run.state == "running":
                    ui.button("Cancel", icon="stop", on_click=lambda: cancel(session, run)).props("no-caps flat dense")
                else:
                    ui.button("Study document", on_click=self.document).props("no-caps flat dense")
                    ui.button("Table (CSV)", on_click=self.csv).props("no-caps flat dense")
            if run.state == "running":
                progress(session, run)
            elif run.message:
                ui.label(run.message).classes("failure")
            self.plots = ui.element("div").classes("gallery")
        ui.timer(0.05, self.grow, once=True)
        if run.state == "running":
            ui.timer(1.0, self.grow)

    async def grow(self) -> None:
        """Draw the cases that are finished."""
        if self.run.state != self.card.props.get("data-state"):
            ui.navigate.reload()
            return
        if not (self.folder / STUDY).is_file():
            return
        loop = asyncio.get_running_loop()
        if self.run.table["axes"][0].get("name") == "file":
            cases = await loop.run_in_executor(None, _cases, self.folder)
            if not self.client.is_deleted and cases is not None and str(cases) != self.seen:
                self.seen = str(cases)
                self.plots.clear()
                with self.plots.classes(remove="gallery"):
                    text_table(*cases[:2])
                    for text in cases[2]:
                        failure(self.session.said(text))
            return
        found = await loop.run_in_executor(None, _columns, self.folder)
        if self.client.is_deleted or found is None or str(found) == self.seen:
            return
        self.seen = str(found)
        axis, columns = found
        along = scale(np.array(axis.values), axis.unit)
        self.plots.clear()
        with self.plots:
            for column in columns:
                log = self.run.table["axes"][0].get("scale") == "log"
                up, values = scale(np.array(column.values), column.unit), column.values
                lines = [(column.label, along(axis.values), up(values))]
                figure = maps.curves(lines, with_unit(axis.label, along.symbol), up.symbol, log=log)
                figure["layout"]["title"] = {"text": with_unit(column.label, up.symbol), "font": {"size": 13}}
                ui.plotly(figure).classes("map small").props(f'data-curve="{sum(np.isfinite(values))}"')

    def document(self) -> None:
        """Give out the study, for ``asperity run``."""
        ui.download.content((self.folder / STUDY).read_text(encoding="utf-8"), "study.toml")

    def csv(self) -> None:
        """Give out the table of all cases."""
        if self.run.table["axes"][0].get("name") == "file":
            if (cases := _cases(self.folder)) is not None:
                ui.download.content(table_text([cases[0], *cases[1]]), "batch.csv")
            return
        found = _columns(self.folder)
        if found is None:
            return
        every = (found[0], *found[1])
        names = [with_unit(column.label, column.unit) for column in every]
        rows = zip(*(column.values for column in every), strict=True)
        ui.download.content(table_text([names, *rows]), "sweep.csv")


@dataclass(frozen=True)
class Column:
    """Values of an axis or a quantity, SI."""

    label: str
    unit: str
    values: list[float]


def with_unit(label: str, unit: str) -> str:
    """Title of an axis."""
    return f"{label} / {unit}" if unit not in ("", "1") else label


def _cases(folder: Path) -> tuple[list[str], list[list[str]], list[str]] | None:
    """Headings and rows of the table of all cases, files by their names, and why some failed; None
    if there is nothing yet."""
    try:
        campaign = open_study(folder)
        found, causes = case_table(campaign, campaign.dataset()), campaign.causes()
    except (AsperityError, OSError, ValueError):
        return None
    failed = [f"{Path(str(cause.first.at['file'])).name}: {cause.first.message}" for cause in causes]
    also = [f" ({cause.count - 1} more files likewise)" if cause.count > 1 else "" for cause in causes]
    texts = [text + more for text, more in zip(failed, also, strict=True)]
    return [*found.headings], [[Path(row[0]).name, *row[1:]] for row in found.cells], texts


def _columns(folder: Path) -> tuple[Column, list[Column]] | None:
    """The axis, and every quantity; None if there is nothing yet."""
    try:
        campaign = open_study(folder)
        data = campaign.dataset()
    except (AsperityError, OSError, ValueError):
        return None

    def column(name: str) -> Column:
        variable = data[name]
        label = str(variable.attrs.get("long_name", name))
        values = [float(value) for value in np.asarray(variable.values, dtype=float)]
        return Column(label, str(variable.attrs.get("units", "1")), values)

    return column(campaign.plan.axes[0].name), [column(name) for name in campaign.study.document.quantities]
