"""The page on which a run is explored: maps with section line and sliders, the surface in space,
spots, theories, certificate."""

from __future__ import annotations

import base64
import json
from collections.abc import Awaitable, Callable
from contextlib import suppress
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from nicegui import events, ui

from ..core.errors import AsperityError
from ..core.status import SENTENCES
from ..core.units import show
from . import maps
from .differences import Told, difference, run_name
from .layout import failure, rows, text_table
from .pages_run import cancel, downloads, progress, start
from .remedies import Remedy, remedies
from .session import Run, Session
from .views import SCENE, SHOWN, SPACE, THEORIES, spots_file

COLOURED = MappingProxyType(
    {
        "height": ("Height", "height", "m", "Cividis"),
        "pressure": ("Pressure", "pressure", "Pa", "Viridis"),
        "plastic": ("Contact and plastic zone", "0 open, 1 elastic, 2 plastic", "", "Portland"),
    }
)
"""By what the surface in space is coloured: button, name, unit and colours."""


def explore_page(key: str, session: Session, chosen: str = "", beside: str = "") -> None:
    """The run ``chosen``, by default the last one of which there is something to show, and another
    one ``beside`` it."""
    done = {run.key: run for run in session.runs.values() if run.key == chosen or session.explorable(run)}
    if not done:
        ui.label("Nothing has been solved yet.").classes("hint")
        ui.link("Run", f"/s/{key}/run")
        return
    run = done.get(chosen) or next(reversed(done.values()))
    other = done.get(beside)
    titles = {item.key: f"{item.key.split('-')[0]}  {item.title}" for item in done.values()}

    def to(name: str, value: str | None) -> None:
        query = {"run": run.key, "beside": other.key if other else "", name: value or ""}
        ui.navigate.to(f"/s/{key}/explore?run={query['run']}&beside={query['beside']}")

    with ui.row().classes("item-head runs-shown"):
        ui.select(titles, label="Run", value=run.key, on_change=lambda e: to("run", e.value)).props("dense").classes(
            "pick"
        )
        ui.select(
            {k: text for k, text in titles.items() if k != run.key},
            label="beside it",
            value=None if other is None else other.key,
            clearable=True,
            on_change=lambda e: to("beside", e.value),
        ).props("dense data-key=beside").classes("pick")
    if other:
        ui.element("div").classes("together").props('data-together role="group" aria-label="what both runs share"')
    with ui.element("div").classes("beside explored" if other else "whole"):
        explored = []
        for item in filter(None, (run, other)):
            with ui.element("section").classes("whole").props(f'aria-label="{run_name(item)}"'):
                explored.append(_Explored(key, session, item, numbered=other is not None))
        if other:
            difference(explored[0].told, explored[1].told, (run_name(run), run_name(other)))


async def _nothing(step: int) -> None:
    """Fill no table."""


class _Explored:
    """One run."""

    def __init__(self, key: str, session: Session, run: Run, *, numbered: bool) -> None:
        self.key, self.session, self.run = key, session, run
        if numbered:
            with ui.element("h2"):
                ui.label(f"{run_name(run).capitalize()}  {run.title}")
        self.box = ui.element("div").classes("whole")
        self.client = ui.context.client
        self.fill_spots: Callable[[int], Awaitable[None]] = _nothing
        self.step_wanted = 0
        self.told = Told()
        ui.on("asperity-step", self.stepped)
        ui.timer(0.01, self.load, once=True)

    def file(self, ending: str) -> Path:
        """File of what is shown."""
        views = self.session.views_of(self.run)
        return views.with_name(views.name + ending)

    async def load(self, *, stresses: bool = False) -> None:
        """Show the run; what is not there yet is made from its result first."""
        if not stresses and self.run.state != "done" and not self.file(SHOWN).is_file():
            self.live()
            return
        if stresses or not self.file(SHOWN).is_file():
            self.box.clear()
            with self.box, ui.row():
                ui.spinner()
                ui.label("computing the stresses in the body" if stresses else "reading the result")
            result = str(self.session.folder_of(self.run) / "result.nc")
            task = {"result": result, "views": str(self.session.views_of(self.run)), "stresses": stresses}
            answer = await self.session.helper.call("views", **task)
            if self.client.is_deleted:
                return
            if "error" in answer:
                self.box.clear()
                with self.box:
                    failure(answer["error"])
                return
        shown = json.loads(self.file(SHOWN).read_text(encoding="utf-8"))
        self.box.clear()
        with self.box:
            self.draw(shown)

    def live(self) -> None:
        """What is known while the run goes on: how far it is, and the maps of the steps so far."""
        with self.box:
            with ui.row().classes("item-head"):
                ui.label("This run goes on; what is known so far is shown.").classes("hint")
                ui.button("Cancel", icon="stop", on_click=lambda: cancel(self.session, self.run)).props(
                    "no-caps flat dense"
                )
            progress(self.session, self.run)
            area = ui.element("div").classes("whole")

        async def look() -> None:
            if self.file(SHOWN).is_file():
                timer.deactivate()
                await self.load()
            elif self.run.state in ("failed", "cancelled"):
                timer.deactivate()
                self.box.clear()
                with self.box:
                    failure(self.run.message)
                    ui.link("What to change, and all runs", f"/s/{self.key}/run")
            elif not area.default_slot.children and self.file(SCENE).is_file():
                with area:
                    self.scene()

        timer = ui.timer(0.3, look)

    def scene(self) -> None:
        """Place of the maps, which are drawn again when there are more of them."""
        name = f"scene-{self.run.key}"
        scene = ui.element("div").classes("scene").props(f'id="{name}" data-scene="/views/{self.key}/{self.run.key}"')
        scene.props(f'data-label="{run_name(self.run)}" role="region" aria-label="maps of {run_name(self.run)}"')
        stand = self.file(SCENE).stat().st_mtime_ns

        def look() -> None:
            nonlocal stand
            if (new := self.file(SCENE).stat().st_mtime_ns) != stand:
                stand = new
                ui.run_javascript(f"asperityMaps({json.dumps(name)})")

        ui.timer(0.5, look)

    def files(self) -> None:
        """Links to the files of the run, which may still be written."""

        @ui.refreshable
        def links() -> None:
            if self.run.state == "running":
                text = "Report, pictures and files are being written; everything can be explored meanwhile."
                ui.label(text).classes("hint").props("data-behind")
                progress(self.session, self.run, curve=False)
            elif self.run.state == "done":
                downloads(self.key, self.session, self.run)
                ui.button("Fields as VTK", icon="download", on_click=self.vtk).props("no-caps flat dense")
            else:
                failure(self.run.message)

        with ui.expansion().classes("wide").props("data-files") as box:
            links()

        def told() -> None:
            box.text = "Files" if self.run.state != "running" else "Files: report and pictures are being written"

        told()
        if self.run.state == "running":

            def look() -> None:
                if self.run.state != "running":
                    timer.deactivate()
                    told()
                    links.refresh()

            timer = ui.timer(0.3, look)

    def draw(self, shown: dict[str, Any]) -> None:
        """Draw everything, what matters most first: verdict, headline and maps on one screen, the
        rest folded below."""
        self.head(shown)
        self.scene()
        if not shown["stressed"] and self.run.state == "done":
            with ui.row().classes("item-head"):
                ui.label("No stresses were asked for.").classes("hint")
                ui.button("Compute the stresses in the body", on_click=lambda: self.load(stresses=True)).props(
                    "no-caps outline dense data-stresses"
                )
        self.spots(shown, f"scene-{self.run.key}")
        self.in_space_on_demand(shown)
        self.theories()
        self.words(shown)
        self.files()
        self.told.tell(shown["numbers"])

    def head(self, shown: dict[str, Any]) -> None:
        """Verdict in a line each, whole with remedies where it is opened, and the headline."""
        message, remedy, converged = shown["status"]
        if not converged:
            failure(f"Not converged: {message} {remedy}")
            self.remedies(shown, "{iterations}")
        grade, fails = shown["grade"], shown["fails"]
        classes = ("", "failing" if fails else "", {"not": "failing", "doubtful": "doubtful"}.get(grade, ""))
        beside = [item for item in shown["findings"] if item[4]]
        with ui.element("details").classes("verdicts").props("data-verdicts"):
            with ui.element("summary"):
                for (name, text), style in zip(shown["verdict"], classes, strict=True):
                    with ui.element("span").classes(f"verdict {style}").props(f"data-verdict={name}"):
                        with ui.element("b"):
                            ui.label(f"{name}: ")
                        ui.label(text)
                more = f", and {len(beside)} more" if beside else ""
                ui.label(f"Whole sentences and remedies{more}").classes("hint opener")
            for _, _, _, advised, elsewhere in shown["findings"]:
                if not elsewhere:  # the sentence on trust tells it
                    with ui.element("div").props(f"data-advice={SENTENCES[-1]}"):
                        self.remedies(shown, advised)
            for level, criterion, text, advised, _ in beside:
                style = "finding" if level == "warning" else "finding note"
                with ui.element("div").classes(style).props("data-finding"):
                    ui.label(criterion).classes("table-title")
                    ui.label(text)
                    self.remedies(shown, advised)
        with ui.element("div").classes("tiles headline"):
            for label, text in shown["headline"]:
                value, doubted, _ = text.partition(" (doubtful)")
                with ui.element("div").classes("tile"):
                    with ui.element("div").classes("of-value"):
                        ui.label(value).classes("value")
                        if doubted:
                            ui.label("doubtful").classes("mark")
                    ui.label(label).classes("hint")

    def in_space_on_demand(self, shown: dict[str, Any]) -> None:
        """The surface in space, drawn when it is opened for the first time."""
        at = f" at {shown['at']}" if shown["at"] else ""
        drawn = False

        async def opened(event: events.ValueChangeEventArguments[Any]) -> None:
            nonlocal drawn
            if event.value and not drawn:
                drawn = True
                if (space := await self.fetched(SPACE)) is not None:
                    with box:
                        self.in_space(space)

        box = ui.expansion(f"Surface in space{at}", on_value_change=opened).classes("wide").props("data-space")

    async def fetched(self, name: str) -> dict[str, Any] | None:
        """Content of the file ``name`` of the run, as soon as it is there; None if the page is left
        before, or nobody makes it."""
        file = await self.session.made(self.run, name, lambda: not self.client.is_deleted)
        if file is None:
            return None
        found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        return found

    def remedies(self, shown: dict[str, Any], text: str) -> None:
        """What the ``text`` of a remedy advises: applied to the document of this run, which is then
        run again, or the page where a person chooses."""
        for item in remedies(text, self.run.table, shown["points"], shown["cell"]):
            if item.table is None:
                ui.link(f"Choose {item.words}", f"/s/{self.key}/{item.page}").classes("remedy").props("data-choose")
            else:
                button = ui.button(f"{item.words}: apply and run again", icon="replay")
                button.props("no-caps outline dense data-remedy").classes("remedy")
                button.on_click(lambda item=item: self.again(item))

    def again(self, item: Remedy) -> None:
        """Run the document of this run once more, with the remedy ``item``; the change can be
        undone."""
        assert item.table is not None
        self.session.draft.replace(item.table)
        self.session.touched()
        try:
            start(self.session, f"{self.run.title}, {item.words}")
        except AsperityError as error:
            ui.notify(self.session.said(str(error)), type="negative", multi_line=True)
            return
        ui.navigate.to(f"/s/{self.key}/run")

    async def vtk(self) -> None:
        """Write the fields for ParaView and give them out."""
        out = self.session.scratch / f"{self.run.key}.vti"
        result = str(self.session.folder_of(self.run) / "result.nc")
        answer = await self.session.helper.call("vtk", result=result, out=str(out))
        if "error" in answer:
            ui.notify(answer["error"], type="negative", multi_line=True)
        else:
            ui.download.file(out, "fields.vti")

    def spots(self, shown: dict[str, Any], name: str) -> None:
        """Table of the contact spots of the load step that the maps show; a row is marked in
        them."""
        texts = shown["step_texts"]
        box = ui.expansion().classes("wide").props("data-spots")
        with box:
            note = ui.label().classes("hint")
            ui.label("Choose a row: the spot is marked in the maps.").classes("hint")
            table = ui.html("", sanitize=False).classes("spots")

        async def fill(step: int) -> None:
            self.step_wanted = step
            found = await self.fetched(spots_file(shown["places"][step]))
            if found is None or self.step_wanted != step:
                return
            box.text = f"Contact spots: {found['count']}" + (f", at step {texts[step]}" if texts[step] else "")
            note.text = f"The {len(found['rows'])} largest."
            note.set_visibility(len(found["rows"]) < found["count"])
            table.content = _spot_table(found["rows"], name)

        self.fill_spots = fill
        ui.timer(0.01, lambda: fill(shown["step"]), once=True)

    async def stepped(self, event: events.GenericEventArguments) -> None:
        """The maps of a run show another load step: so does its table of spots."""
        of, step = event.args.get("of"), event.args.get("step")
        if of == f"scene-{self.run.key}" and isinstance(step, int) and step >= 0:
            with suppress(IndexError):
                await self.fill_spots(step)

    def in_space(self, space: dict[str, Any]) -> None:
        """The surface in space, coloured by one of several fields."""
        fields = {
            name: np.frombuffer(base64.b64decode(space[name]), "<f4").reshape(space["shape"]) for name in COLOURED
        }
        cell = (float(space["cell"][0]), float(space["cell"][1]))

        def figure(by: str) -> dict[str, Any]:
            _, title, unit, scale = COLOURED[by]
            values = fields[by]
            if unit:
                symbol, factor = maps.scaled(
                    float(np.nanmax(np.abs(values), initial=0.0)), unit, {"m": "length", "Pa": "pressure"}[unit]
                )
                return maps.in_space(fields["height"], values / factor, cell, f"{title} / {symbol}", scale)
            return maps.in_space(fields["height"], values, cell, title, scale)

        block = space["block"]
        toggle = ui.toggle({name: texts[0] for name, texts in COLOURED.items()}, value="height")
        toggle.props("no-caps dense data-key=space")
        plot = ui.plotly(figure("height")).classes("space").props('role="figure" aria-label="surface in space"')
        toggle.on_value_change(lambda e: plot.update_figure(figure(e.value)))
        if block > 1:
            text = (
                f"Decimated: each point stands for {block} × {block} points of the grid, with their mean "
                "height and their largest pressure."
            )
            ui.label(text).classes("hint").props("data-decimated")
        ui.label("Heights are exaggerated; drag to turn, scroll to come nearer.").classes("hint")

    def theories(self) -> None:
        """Curves of the theories, computed when they are asked for."""
        with ui.expansion("Comparison with theories").classes("wide").props("data-compared"):
            box = ui.element("div").classes("whole")

        def draw(answer: dict[str, Any]) -> None:
            box.clear()
            with box:
                ui.label(answer["sentence"])
                ui.plotly(maps.theories(**{key: answer[key] for key in maps.OF_THEORIES})).classes("space theories")
                with ui.expansion(f"Left out: {len(answer['left_out'])}").classes("wide"):
                    rows(answer["left_out"])
                for text in answer["remarks"]:
                    ui.label(text).classes("hint")

        async def compute() -> None:
            if self.run.state == "running":
                ui.notify("The result is still being written; ask for the theories when it is.")
                return
            box.clear()
            with box, ui.row():
                ui.spinner()
                ui.label("solving a dozen loads and asking the theories")
            result = str(self.session.folder_of(self.run) / "result.nc")
            answer = await self.session.helper.call(
                "theories", result=result, views=str(self.session.views_of(self.run))
            )
            if self.client.is_deleted:
                return
            if "error" in answer:
                box.clear()
                with box:
                    failure(answer["error"])
            else:
                draw(answer)

        if self.file(THEORIES).is_file():
            draw(json.loads(self.file(THEORIES).read_text(encoding="utf-8")))
        else:
            with box:
                ui.button("Compare with theories", on_click=compute).props("no-caps outline data-theories")

    def words(self, shown: dict[str, Any]) -> None:
        """Words of all parts, and the certificate."""
        for part in shown["parts"]:
            with ui.expansion(part["title"]).classes("wide"):
                if part["sentence"]:
                    ui.label(part["sentence"])
                rows(part["rows"])
                for title, headings, cells in part["tables"]:
                    ui.label(title).classes("table-title")
                    text_table(headings, cells, tall=False)
                for text in part["remarks"]:
                    ui.label(text).classes("hint")
        with ui.expansion("Certificate: what proves the solution").classes("wide").props("data-certificate"):
            text_table(["check", "value", "meaning"], shown["certificate"], tall=False)


def _spot_table(rows: list[list[float]], name: str) -> str:
    """Spots as HTML: place, area, load, mean and largest pressure; of the maps of the element
    ``name``."""
    headings = ("spot", "x", "y", "area", "load", "mean pressure", "largest pressure")
    made = "".join(f'<th scope="col">{text}</th>' for text in headings)
    lines = [f"<table><thead><tr>{made}</tr></thead><tbody>"]
    for number, (x, y, *values) in enumerate(rows, start=1):
        texts = [str(number), show(x, "m", 4), show(y, "m", 4)]
        texts += [show(v, u, 4) for v, u in zip(values, ("m**2", "N", "Pa", "Pa"), strict=True)]
        cells = "".join(f"<td>{text}</td>" for text in texts)
        lines.append(f'<tr tabindex="0" data-spot="{x!r},{y!r}" data-of="{name}">{cells}</tr>')
    return "".join([*lines, "</tbody></table>"])
