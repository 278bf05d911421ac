"""The files with heights of a session: a list with pictures from which one is chosen, all are
pressed in one batch, compared, or taken for scans of one surface."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from nicegui import ui

from ..core.errors import AsperityError
from ..core.units import show
from ..io.schemas.study import DEFAULT_QUANTITIES
from ..io.schemas.surfaces import FileReading
from ..parts.registry import parts
from ..run.document import files_named
from ..studies.documents import study_from_table
from ..studies.plan import make_plan
from .beginning import measured, scanned
from .layout import failure, text_table
from .pages_run import start_sweep
from .session import Kept, Session
from .widgets import Context

SURFACES = ("surface", "counter_surface")

SMALL, LARGE = 96, 320
"""Points of a picture along its longer side, in the list and where files are compared."""


def files_with_heights(session: Session) -> list[Kept]:
    """Files of the session but those that its document names for something else than a surface."""
    others = {key: value for key, value in session.draft.table.items() if key not in SURFACES}
    taken = set(files_named(others))
    return [item for item in session.files if item.path not in taken]


def reading(session: Session) -> dict[str, Any]:
    """What the document says of its file that this does not say itself, for others like it."""
    table = session.draft.get("surface")
    known = table if isinstance(table, dict) and table.get("kind") == "file" else {}
    return {key: value for key, value in known.items() if key in FileReading.model_fields and key != "path"}


def batch(session: Session, files: list[Kept]) -> dict[str, Any]:
    """Study of the problem of the session with each of ``files``.

    Raises
    ------
    InputError
        If the document is incomplete or wrong.
    """
    paths = [session.from_sweeps(item.path) for item in files]
    table = session.draft.get("surface")
    surface = table if isinstance(table, dict) and table.get("kind") == "file" else measured(files[0].path)
    problem = {**session.draft.table, "surface": {**surface, "path": files[0].path}}
    asked = [part.headline for part in parts() if part.headline and part.table in problem]
    return {
        "version": 1,
        "title": f"{session.draft.get('title') or 'Contact'}: {len(files)} files",
        "problem": session.named_from_sweeps(problem),
        "quantities": [*DEFAULT_QUANTITIES, *asked],
        "axes": [{"path": "surface.path", "name": "file", "values": paths}],
    }


class FileList:
    """List of the files with heights, of which those that are ticked are worked on; drawn where
    there are several."""

    def __init__(self, key: str, context: Context, below: Callable[[], ui.element]) -> None:
        self.key, self.context, self.session, self._below = key, context, context.session, below
        self.ticked: dict[str, bool] = {}
        self._pictures: dict[str, ui.element] = {}
        self._client = ui.context.client
        self.box = ui.element("div").classes("whole")
        self.draw()

    def draw(self) -> None:
        """Draw the list again, with the files that have come."""
        self.box.clear()
        self._pictures = {}
        files = files_with_heights(self.session)
        if len(files) < 2:
            return
        chosen = self.session.draft.get("surface", "path")
        with self.box, ui.card().classes("table files").props("flat bordered"):
            ui.label(f"Files ({len(files)})").classes("table-title")
            with ui.element("ul").classes("file-list"):
                for item in files:
                    self._row(item, here=item.path == chosen)
            with ui.row().classes("adders"):
                for text, name, icon, work in (
                    ("Compare", "compare", "compare", self.compare),
                    ("Press each", "batch", "playlist_play", self.press_each),
                    ("Scans of one surface", "one", "grain", self.one_surface),
                ):
                    ui.button(text, icon=icon, on_click=work).props(f"outline dense no-caps data-files={name}")
            ui.label(
                "For the files that are ticked: beside one another; the whole problem with each of them, as a sweep; "
                "or one surface generated from all."
            ).classes("hint")
        with self.box:
            ui.timer(0.01, self.look, once=True)

    def _row(self, item: Kept, *, here: bool) -> None:
        with ui.element("li").classes("file" + (" here" if here else "")).props(f'data-file="{item.label}"'):
            ui.checkbox(
                value=self.ticked.setdefault(item.path, True),
                on_change=lambda e, path=item.path: self.ticked.update({path: bool(e.value)}),
            ).props(f'dense aria-label="{item.label}"')
            self._pictures[item.path] = ui.element("div").classes("file-look")
            with self._pictures[item.path]:
                ui.spinner()
            if here:
                ui.label("chosen").classes("hint file-use")
            else:
                for props, icon, work in (("data-choose", None, self.choose), ("data-remove", "delete", self.remove)):
                    button = ui.button("Choose" if icon is None else "", icon=icon, on_click=lambda w=work: w(item))
                    name = "" if icon is None else f'aria-label="remove {item.label}"'
                    button.props(f"flat dense no-caps {props} {name}").classes("file-use")

    async def look(self) -> None:
        """Draw the pictures, one after the other."""
        for item in files_with_heights(self.session):
            if item.path not in self.session.glances:
                self.session.glances[item.path] = await self._glance(item, SMALL)
            if self._client.is_deleted:
                return
            box = self._pictures.get(item.path)
            if box is None:
                continue
            box.clear()
            with box:
                _look(item, self.session.glances[item.path], self.session)

    async def _glance(self, item: Kept, points: int, **more: Any) -> dict[str, Any]:
        """What a worker says of one file: as it is, or else as the document says of its own."""
        tables = [measured(item.path), {**measured(item.path), **reading(self.session)}]
        folder = str(self.session.folder)
        answer: dict[str, Any] = await self.session.helper.call(
            "glance", tables=tables, folder=folder, points=points, **more
        )
        return answer

    def _ticked(self, least: int) -> list[Kept]:
        found = [item for item in files_with_heights(self.session) if self.ticked.get(item.path, True)]
        if len(found) < least:
            ui.notify(f"Tick at least {least} files.")
            return []
        return found

    def choose(self, item: Kept) -> None:
        """Take one file for the surface; what is said of the one before stays."""
        self.context.set(("surface",), {**measured(item.path), **self._said_of(item)})
        ui.navigate.reload()

    def remove(self, item: Kept) -> None:
        """Remove a file that the document does not name; runs have their own."""
        if item.path in set(files_named(self.session.draft.table)):
            ui.notify("The document names this file: choose another one first.")
            return
        self.session.forget_file(Path(item.path))
        self.session.touched()
        self.draw()

    def _said_of(self, item: Kept) -> dict[str, Any]:
        """What the document says of its file, if this one does not say it itself."""
        return reading(self.session) if self.session.glances.get(item.path, {}).get("needed") else {}

    def one_surface(self) -> None:
        """Take the files for scans of one surface, which is generated."""
        if found := self._ticked(1):
            table = scanned([item.path for item in found])
            for scan, item in zip(table["spectrum"]["scans"], found, strict=True):
                scan |= self._said_of(item)
            self.context.set(("surface",), table)
            ui.navigate.reload()

    def press_each(self) -> None:
        """Begin the batch: the problem with each of the files."""
        if not (found := self._ticked(2)):
            return
        try:
            study = batch(self.session, found)
            make_plan(study_from_table(study, self.session.folder / "sweeps" / "new", "batch"))
            start_sweep(self.session, study["title"], study)
        except AsperityError as error:
            ui.notify(self.session.said(str(error)), type="negative", multi_line=True)
            return
        ui.navigate.to(f"/s/{self.key}/sweep")

    async def compare(self) -> None:
        """Show the files on one scale of colours beside one another, with a table of their
        roughness."""
        if not (found := self._ticked(2)):
            return
        box = self._below()
        box.clear()
        with box, ui.row():
            ui.spinner()
            ui.label("measuring the surfaces")
        known = {item.path: await self._glance(item, LARGE, measured=True) for item in found}
        good = {path: answer for path, answer in known.items() if "error" not in answer}
        ends = [end for answer in good.values() for end in answer["ends"]]
        for path in good:
            item = next(item for item in found if item.path == path)
            known[path] |= await self._glance(item, LARGE, ends=[min(ends), max(ends)])
        if self._client.is_deleted:
            return
        box.clear()
        with box:
            _compared(found, known, ends, self.session)
        self._client.run_javascript(f"getHtmlElement({box.id}).scrollIntoView({{ behavior: 'smooth' }})")


def _look(item: Kept, answer: dict[str, Any], session: Session) -> None:
    """Picture of one file with its name and size, or why there is none."""
    if "error" not in answer:
        ui.html(f'<img src="{answer["picture"]}" alt="">', sanitize=False).classes("file-picture")
    else:
        ui.icon("broken_image").classes("file-picture")
    with ui.element("div").classes("file-words"):
        ui.label(item.label)
        if "error" in answer:
            ui.label(session.said(answer["error"])).classes("hint bad")
        else:
            ui.label(f"{answer['text']}, rms {show(answer['Sq'], 'm', 3)}").classes("hint numbers")


def _compared(files: list[Kept], answers: dict[str, Any], ends: list[float], session: Session) -> None:
    """Pictures on one scale, and the table."""
    ui.html("<h2>Compared</h2>", sanitize=False)
    if ends:
        low, high = show(min(ends), "m", 3), show(max(ends), "m", 3)
        ui.label(f"Heights in the same colours, from {low} (dark) to {high} (light).").classes("hint")
    good = [item for item in files if "error" not in answers[item.path]]
    with ui.element("div").classes("gallery compared"):
        for item in files:
            with ui.element("figure").props(f'data-compared="{item.label}"'):
                if item in good:
                    picture = answers[item.path]["picture"]
                    ui.html(f'<img src="{picture}" alt="heights">', sanitize=False)
                else:
                    failure(session.said(answers[item.path]["error"]))
                with ui.element("figcaption"):
                    ui.label(item.label).classes("table-title")
                    if item in good:
                        ui.label(answers[item.path]["text"]).classes("hint")
    if not good:
        return
    names = list(dict.fromkeys(name for item in good for name, _ in answers[item.path]["headline"]))
    rows = [[item.label, *(dict(answers[item.path]["headline"]).get(name, "–") for name in names)] for item in good]
    text_table(["file", *names], rows)
