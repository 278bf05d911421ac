"""Pages on the surface: where its heights come from, what prepares them, and how rough they are."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import numpy as np
from nicegui import events, run, ui

from ..core.errors import AsperityError
from ..core.units import show
from ..io.schemas.surfaces import FileSurface
from ..run.document import document_model, is_archive
from . import maps
from .beginning import measured, open_document, scanned
from .draft import Keys
from .forms import asked_of
from .layout import drop, failure, rows
from .map_tools import Heard, Masks, Picture, Profiles, Stage, Toolbar, steps_of
from .measuring import outlines
from .pages_files import FileList, files_with_heights
from .places import Places
from .session import Session
from .starting import COUNTER, SURFACE, Extent, Starting, begun
from .widgets import Context, entry, kinds, listed

SCANS: Keys = (SURFACE, "spectrum", "scans")


class Preview:
    """Map of the surface as it stands, computed by the helper of the session a moment after the
    last change, with the tools that measure and mask on it.

    With a ``stage`` it shows the surface before or after the step that is looked at, or what that
    removes; ``what`` of these it shows first. The last map stays, dimmed, while there is no new
    one; why there is none is said at one of the ``places`` of the form, or above the map.
    """

    def __init__(
        self,
        session: Session,
        title: str,
        name: str,
        *,
        of: str = SURFACE,
        stage: Stage | None = None,
        what: str = "after",
        masks: Masks | None = None,
        places: Places | None = None,
    ) -> None:
        self.session, self.title, self.of, self.stage, self.what = session, title, of, stage, what
        self.places = places
        self._masks = masks
        self.view: tuple[float, float, float, float] | None = None
        self.picture = Picture(f"map-{name}", session.scratch / f"{name}.npy", title)
        self.profiles: Profiles | None = None
        self._file = session.scratch / f"{name}.bin"
        self._wanted = 0
        self._plot: Any = None
        self._kind = ""
        with ui.element("section").classes("preview previewed").props(f'data-preview="{name}"') as self.whole:
            self.state = ui.element("div").classes("preview-state").props('role="status"')
            self.box = ui.element("section").classes("preview")
        self._client = ui.context.client

    @property
    def answer(self) -> dict[str, Any]:
        """What was computed last."""
        return self.picture.answer

    @property
    def shown_steps(self) -> int:
        """Steps of preparation that the surface that is shown has gone through."""
        if self.stage is None:
            return len(steps_of(self.session.draft))
        return self.stage.since if self.what == "before" else self.stage.upto

    def known(self) -> dict[str, Any]:
        """What is known of the surface as it stands now; nothing while it is computed."""
        return self.answer if self.whole.props.get("data-state") == "shown" else {}

    def later(self) -> None:
        """Compute it soon; only the last of many changes counts."""
        self._wanted += 1
        self._now("computing")
        asyncio.get_running_loop().create_task(self._soon(self._wanted))

    def _now(self, state: str, text: str = "") -> None:
        """Show that the map is that of the surface, or why it is not: state ``none``, ``shown``,
        ``computing`` or ``wrong``, for the reason ``text``."""
        self.whole.props(f"data-state={state} aria-busy={'true' if state == 'computing' else 'false'}")
        self.state.clear()
        with self.state:
            if state == "computing":
                ui.spinner(size="1.1em")
                ui.label("computing the map …").classes("hint")
            if text:
                failure(text)
            if state == "wrong" and self.answer:
                ui.label("The map below is the last one that could be computed.").classes("hint")

    def _wrong(self, text: str, place: str) -> None:
        """Say why there is no map, where the form has a place for it."""
        text = text.removeprefix("surface: ")  # which surface it is, the page says
        keys = (self.of, *(int(part) if part.isdigit() else part for part in place.split(".") if part))
        said = self.places is not None and self.places.show(keys, text)
        self._now("wrong", "" if said else text)

    async def _soon(self, number: int) -> None:
        await asyncio.sleep(0.3)
        if number == self._wanted:
            await self.now()

    async def now(self) -> None:
        """Compute and draw it."""
        table = self.session.draft.get(self.of)
        if not isinstance(table, dict) or not table.get("kind"):
            self.picture.answer, self._kind = {}, ""
            self._now("none")
            with self.box.clear() or self.box:
                ui.label("Choose a file or a generator: the surface is then shown here.").classes("hint")
            return
        number = self._wanted
        self._now("computing")
        task: dict[str, Any] = {"table": table, "folder": str(self.session.folder), "out": str(self._file)}
        if self.stage is not None:
            task |= {"steps": self.stage.upto, "since": self.stage.since, "show": self.what}
        answer = await self.session.helper.call("surface", **task)
        if number != self._wanted or self._client.is_deleted:
            return
        if "error" in answer:
            self._wrong(self.session.said(answer["error"]), answer.get("place", ""))
            return
        if self.places is not None:
            self.places.clear()
        self.picture.answer = answer
        self._now("shown")
        self.draw()

    def draw(self) -> None:
        """Draw what was computed; a picture that is there already shows it in place."""
        title = self.title if self.stage is None else self.stage.title(self.what)
        self.picture.name = title
        kind = "" if not self.picture.there else "curve" if self.picture.is_line else "map"
        if kind != self._kind or not kind:
            self.box.clear()
            with self.box:
                self._frame(kind, title)
            self._kind = kind
        if "nothing" in self.answer:
            with self._words.clear() or self._words:
                ui.label(self.answer["nothing"])
        else:
            self._plot.update_figure(self._figure(title))
            self._tell()
            with self._words.clear() or self._words:
                self._in_words()
        if self.profiles is not None:
            self.profiles.draw()

    def _frame(self, kind: str, title: str) -> None:
        """What stays while the surface changes: the tools, the picture, and room for words."""
        if self.stage is not None:
            shown = {"before": "Before", "after": "After", "removed": "What it removes"}
            ui.toggle(shown, value=self.what, on_change=lambda e: self._turn(e.value)).props(
                f'no-caps dense data-toggle="{self.picture.key}" aria-label="what the map shows"'
            )
        if kind:
            self._tools = Toolbar(self.picture, self._use, masking=self._masks is not None)
            with self.picture.frame(kind):
                self._plot = ui.plotly(self._figure(title)).classes("map")
                self._plot.props('role="figure" aria-label="map of heights"').on(
                    "plotly_relayout", self._moved, [*AXES, WHOLE]
                )
        elif self.stage is not None:
            ui.label(title).classes("table-title")
        self._words = ui.element("div").classes("preview")

    def _figure(self, title: str) -> dict[str, Any]:
        nx, ny = self.answer["shape"]
        values = np.frombuffer(self._file.read_bytes(), "<f4").reshape(ny, nx)
        drawn = maps.height_map if ny > 1 else maps.height_line
        figure = drawn(values, tuple(self.answer["spacing"]), title)
        figure["layout"]["uirevision"] = str(self.answer["size"])  # stays enlarged while the heights change
        return figure

    def _tell(self) -> None:
        """Let the drawing above the picture know what is there."""
        size = self.picture.size
        unit, scale = maps.scaled(size[0] if self.picture.is_line else max(size))
        bars = [
            {"length": value, "text": f"{name} cut-off {show(value, 'm', 3)}"}
            for name, value in self.answer.get("cutoffs", {}).items()
        ]
        self.picture.push(
            scale=scale,
            unit=unit,
            size=[size[0], None] if self.picture.is_line else list(size),
            pixel=list(self.answer["pixel"]),
            outlines=outlines(steps_of(self.session.draft), self.shown_steps, size) if self._masks else [],
            bars=[] if self.picture.is_line else bars,
            tool=self._tools.tool,
        )

    def _in_words(self) -> None:
        full = self.answer["full"]
        text = (
            f"{full[0]} × {full[1]} points, rms height {show(self.answer['Sq'], 'm', 4)}, peak to "
            f"valley {show(self.answer['Sz'], 'm', 4)}"
        )
        if self.answer["missing"]:
            text += f", {self.answer['missing']} points missing"
        ui.label(text).classes("numbers")
        if "words" in self.answer:
            ui.label(self.answer["words"]).classes("numbers").props("data-removed")
        if self.answer["step"] > 1:
            ui.label(f"Shown with every {self.answer['step']}th point along both sides.").classes("hint")
        with ui.expansion("What this surface is").classes("wide"):
            rows(self.answer["rows"])
            for step in self.answer["history"]:
                ui.label(step).classes("hint")

    def _turn(self, what: str) -> None:
        """Show the surface ``before`` or ``after`` the step, or what it ``removed``."""
        self.what = what
        self.later()

    def _use(self, tool: str) -> None:
        """What a tool that was chosen needs; the first one for profiles brings one."""
        if tool == "line" and self.profiles is not None:
            self.profiles.use(True)

    def told(self, told: dict[str, Any]) -> None:
        """What a person did on the picture."""
        what = told.get("what")
        if what in ("line", "cursors") and self.profiles is not None:
            self.profiles.told(told)
        elif self._masks is not None and self.picture.there:
            self._masks.told(told, self.picture, self.shown_steps)

    def _moved(self, event: events.GenericEventArguments) -> None:
        found = [event.args.get(name) for name in AXES]
        if event.args.get(WHOLE):
            self.view = None
        elif all(isinstance(value, int | float) for value in found):
            _, scale = maps.scaled(max(self.answer["size"]))
            x0, x1, y0, y1 = (float(value) * scale for value in found)
            lx, ly = self.answer["size"]
            self.view = (max(0.0, x0), min(lx, x1), max(0.0, y0), min(ly, y1))


AXES = ("xaxis.range[0]", "xaxis.range[1]", "yaxis.range[0]", "yaxis.range[1]")
"""What Plotly reports of a part that was chosen with the mouse."""

WHOLE = "xaxis.autorange"
"""The same of the whole picture."""


def surface_page(key: str, session: Session) -> None:
    """Choose a file or a generator; the preview follows."""
    shown: dict[str, Any] = {}

    fills = Starting(session, lambda: [item.path for item in files_with_heights(session)], lambda: shown["map"].known())
    context = Context(session, lambda keys: shown["map"].later(), fills)
    item = next(item for item in asked_of(document_model()) if item.name == SURFACE)
    assert item.tables is not None
    tables = item.tables
    generators = tuple(word for word in tables if word != "file")
    leave = frozenset({"prepare", "mirror", "place", "kind"})

    def chosen() -> str:
        """Which source the document has."""
        table = session.draft.get(SURFACE) or {}
        spectrum = table.get("spectrum")
        many = isinstance(spectrum, dict) and spectrum.get("kind") == "scans"
        return "file" if table.get("kind") == "file" else "scans" if many else "made"

    @ui.refreshable
    def source() -> None:
        if chosen() == "file":
            _file_form(context, leave)
        else:
            kinds(context, item, (SURFACE,), leave, generators)

    left: dict[str, Any] = {}

    def choose(kind: str) -> None:
        left[chosen()] = session.draft.get(SURFACE)
        if left.get(kind):  # as it was before another source was chosen
            context.set((SURFACE,), left[kind])
        elif kind == "file":
            path = session.files[-1].path if session.files else None
            context.set((SURFACE,), {"kind": "file"} if path is None else measured(path))
        elif kind == "scans":
            context.set((SURFACE,), scanned([file.path for file in session.files]))
        else:
            context.set((SURFACE,), begun(tables, "kind", "rough", {}, Extent()))
        source.refresh()

    async def uploaded(event: events.GenericEventArguments) -> None:
        given = event.args.get("paths") if isinstance(event.args, dict) else None
        paths = [path for path in given or () if path in session.labels]
        archives = [path for path in paths if is_archive(path)]
        if archives:
            await _opened(session, Path(archives[-1]))
            return
        if not paths:
            return
        if chosen() == "scans":  # more of them
            scans = session.draft.get(*SCANS)
            new = [{"path": path} for path in paths]
            context.set(SCANS, [*(scans if isinstance(scans, list) else []), *new])
            source.refresh()
        elif len(paths) == 1 or session.draft.get(SURFACE) is None:
            context.set((SURFACE,), measured(paths[0]))
            ui.navigate.reload()
            return
        shown["files"].draw()

    with ui.element("div").classes("two"):
        with ui.element("section"):
            drop(
                key,
                "drop files with heights, or choose them",
                "Drop files with heights here, or press to choose",
                "any format of instruments, text, pictures, NumPy arrays, archives of problems that were shared; "
                "nothing leaves this machine",
            )
            ui.on("asperity-uploaded", uploaded)
            sources = {"file": "A file", "scans": "Many scans", "made": "A generator"}
            begins = chosen() if session.draft.get(SURFACE) else None
            ui.toggle(sources, value=begins, on_change=lambda e: choose(e.value)).props("no-caps dense")
            ui.label("Many scans: all files are scans of one surface, and one like it is generated.").classes("hint")
            shown["files"] = FileList(key, context, lambda: below)
            source()
            _counter_surface(session, fills)
        with ui.element("section"):
            heard = Heard()
            preview = Preview(session, "Surface as prepared", "surface", masks=Masks(context), places=context.places)
            shown["map"] = preview
            preview.profiles = Profiles(heard, "surface", [preview.picture])
            heard.of(preview.picture.key, preview.told)
    below = ui.element("section").classes("whole")
    ui.timer(0.01, shown["map"].now, once=True)


def _counter_surface(session: Session, fills: Starting) -> None:
    """The surface of the other body, if it is rough, too, with its map."""
    context = Context(session, lambda keys: shown.later(), fills)
    item = next(entry for entry in asked_of(document_model()) if entry.name == COUNTER)
    with ui.expansion("Counter surface (rough, too)", value=session.draft.get(COUNTER) is not None).classes("wide"):
        kinds(context, item, (COUNTER,))
        with ui.element("section"):
            heard = Heard()
            shown = Preview(session, "Counter surface", COUNTER, of=COUNTER, places=context.places)
            shown.profiles = Profiles(heard, COUNTER, [shown.picture])
            heard.of(shown.picture.key, shown.told)
    ui.timer(0.01, shown.now, once=True)


async def _opened(session: Session, archive: Path) -> None:
    """Take the problem of an ``archive`` that was dropped, which is not needed any more then."""
    try:
        await run.io_bound(open_document, session, archive)
    except AsperityError as error:
        ui.notify(session.said(str(error)), type="negative", multi_line=True)
        return
    finally:
        session.forget_file(archive)
    session.touched()
    ui.navigate.reload()


def _file_form(context: Context, leave: frozenset[str]) -> None:
    """Which file and channel, and what the file does not say itself."""
    session = context.session
    path = session.draft.get(SURFACE, "path")
    box = ui.element("div")
    entries = {item.name: item for item in asked_of(FileSurface, leave)}

    async def look() -> None:
        answer = await session.helper.call("inspect", path=path) if path in session.labels else {}
        with box:
            if "error" in answer:
                failure(session.said(answer["error"]))
            found = answer.get("channels", [])
            if len(found) > 1:
                options = {item["index"]: item["text"] for item in found}
                ui.select(
                    options,
                    label="Channel",
                    value=session.draft.get(SURFACE, "channel"),
                    clearable=True,
                    on_change=lambda e: context.set((SURFACE, "channel"), e.value),
                ).props('dense data-key="surface.channel"').classes("field wide")

    with ui.card().classes("table").props("flat bordered"):
        entry(context, entries["path"], (SURFACE, "path"))
        with ui.element("div").classes("fields"):
            for name, item in entries.items():
                if name not in ("path", "channel"):
                    entry(context, item, (SURFACE, name))
        ui.label("Size and units are asked only where the file does not state them.").classes("hint")
    ui.timer(0.01, look, once=True)


def prepare_page(key: str, session: Session) -> None:
    """Steps of preparation beside their effect: pressing on one shows what it does."""
    shown: dict[str, Preview] = {}

    def changed(keys: Keys = ()) -> None:
        for item in shown.values():
            item.later()

    fills = Starting(
        session, lambda: [item.path for item in files_with_heights(session)], lambda: shown["after"].known()
    )
    context = Context(session, changed, fills)
    item = next(item for item in asked_of(FileSurface) if item.name == "prepare")
    stage = Stage(lambda: steps_of(session.draft))

    def crop() -> None:
        drawn = [preview for preview in shown.values() if preview.view is not None]
        if not drawn:
            ui.notify("Draw a rectangle on one of the maps first.")
            return
        assert drawn[0].view is not None
        x0, x1, y0, y1 = (f"{value * 1e6:.5g} um" for value in drawn[0].view)
        present, at = steps_of(session.draft), drawn[0].shown_steps  # it belongs to the surface that is shown
        step = {"step": "crop", "x": [x0, x1], "y": [y0, y1]}
        context.set((SURFACE, "prepare"), [*present[:at], step, *present[at:]])
        ui.navigate.reload()

    if not isinstance(session.draft.get(SURFACE), dict):
        ui.label("Choose a surface first.")
        ui.link("Surface", f"/s/{key}/surface")
        return

    def look(number: int | None) -> None:
        stage.chosen = None if number == stage.step else number
        mark()
        changed()

    def mark() -> None:
        for number, button in heads.items():
            button.props(f"aria-pressed={'true' if number == stage.step else 'false'}")
        whole.set_visibility(stage.step is not None)

    def head(number: int, text: str) -> None:
        button = ui.button(text, icon="visibility", color=None, on_click=lambda: look(number)).classes("step-head")
        button.props(f"flat dense no-caps aria-pressed={'true' if number == stage.step else 'false'}")
        heads[number] = button.tooltip("show what this step does")

    heads: dict[int, Any] = {}

    @ui.refreshable
    def steps() -> None:
        heads.clear()
        listed(context, item, (SURFACE, "prepare"), titled=False, head=head, changed=mark)

    def again() -> None:
        steps.refresh()
        mark()

    masks = Masks(context, stage, again)
    with ui.element("div").classes("two"):
        with ui.element("section"):
            ui.label(
                "The steps below are the history that the document keeps; every change can be undone. Press on the "
                "name of one to see what it does."
            ).classes("hint")
            ui.button("Crop to the rectangle drawn", icon="crop", on_click=crop).props("no-caps outline")
            whole = ui.button("Look at all steps together", icon="layers", on_click=lambda: look(None))
            whole.props("no-caps flat dense").set_visibility(False)
            steps()
        with ui.element("section"):
            heard = Heard()
            for name, what in (("after", "after"), ("before", "before")):
                places = context.places if what == "after" else None
                preview = Preview(session, "", name, stage=stage, what=what, masks=masks, places=places)
                shown[name] = preview
                heard.of(preview.picture.key, preview.told)
                if name == "after":
                    place = ui.element("div")
            with place:
                profiles = Profiles(heard, "prepare", [preview.picture for preview in shown.values()])
            for preview in shown.values():
                preview.profiles = profiles

    async def both() -> None:
        await shown["after"].now()
        await shown["before"].now()

    ui.timer(0.01, both, once=True)


def roughness_page(key: str, session: Session) -> None:
    """All parameters of the prepared surface, with their curves."""
    out = session.scratch / "roughness"
    client = ui.context.client
    box = ui.element("section")

    async def compute() -> None:
        table = session.draft.get(SURFACE)
        box.clear()
        if not isinstance(table, dict):
            with box:
                ui.label("Choose a surface first.")
            return
        with box, ui.row():
            ui.spinner()
            ui.label("measuring the surface")
        answer = await session.helper.call("roughness", table=table, folder=str(session.folder), out=str(out))
        if client.is_deleted:
            return
        box.clear()
        with box:
            _roughness(key, answer)

    ui.timer(0.01, compute, once=True)


def _roughness(key: str, answer: dict[str, Any]) -> None:
    if "error" in answer:
        failure(answer["error"])
        return
    with ui.element("div").classes("tiles"):
        for name, text in answer["headline"]:
            with ui.element("div").classes("tile"):
                ui.label(text).classes("value")
                ui.label(name).classes("hint")
    for name, title in answer["reports"]:
        ui.link(title, f"/files/{key}/roughness/{name}", new_tab=True)
    with ui.element("div").classes("gallery"):
        for name, title, caption in answer["figures"]:
            with ui.element("figure"):
                ui.image(f"/files/{key}/roughness/{name}.png").props(f'alt="{name}"')
                with ui.element("figcaption"):
                    ui.label(title).classes("table-title")
                    ui.label(caption).classes("hint")
    for title, lines in answer["groups"]:
        with ui.expansion(title).classes("wide"):
            rows([(name, text) for name, text, _ in lines])
