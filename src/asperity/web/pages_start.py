"""The page on which a session begins: a new contact, an interface of the literature, a kept
session, or a finished example."""

from __future__ import annotations

import html
import tomllib
from collections.abc import Callable
from pathlib import Path

from nicegui import ui

from ..core.errors import AsperityError
from ..run.document import EXAMPLES, PRESETS, built_in, read_table
from .layout import main_named, root_path
from .pages_run import start
from .session import Place, Session


def start_page(place: Place) -> None:
    """Begin a session, or open one again."""
    ui.page_title("asperity")
    main_named("Start")
    with ui.element("div").classes("start"):
        ui.html("<h1>asperity – contact of layered rough surfaces</h1>", sanitize=False)
        ui.label("Everything is computed on this machine; nothing is sent anywhere.").classes("hint")
        with ui.element("div").classes("ways"):
            _own(place)
            _literature(place)
            _kept(place)
        if place.sessions:
            _open_sessions(place)
        ui.html("<h2>Finished examples</h2>", sanitize=False)
        ui.label(
            "A press runs one, which takes some seconds, and shows its result; then change what you like."
        ).classes("hint")
        with ui.element("div").classes("examples"):
            for name, question in EXAMPLES.items():
                _example(place, name, question)


def _begin(place: Place, first: Callable[[Session], str | None], folder: Path | None = None) -> None:
    """Begin a session by what is done ``first``, which may tell the page to go to."""
    try:
        key, session = place.new(folder)
        to = first(session) or "surface"
    except AsperityError as error:
        ui.notify(str(error), type="negative", multi_line=True)
        return
    session.touched()
    ui.navigate.to(f"/s/{key}/{to}")


def _own(place: Place) -> None:
    with ui.card().classes("table").props("flat bordered"):
        ui.label("A new contact").classes("table-title")
        ui.label("From a measured surface, or one that is generated.").classes("hint")
        ui.button("Begin", on_click=lambda: _begin(place, lambda session: None)).props("no-caps")


def _literature(place: Place) -> None:
    def preset(session: Session, name: str) -> None:
        session.draft.replace(read_table(name))

    with ui.card().classes("table").props("flat bordered"):
        ui.label("An interface of the literature").classes("table-title")
        ui.label("With its roughness, layers, film and load, to be changed and run.").classes("hint")
        with ui.row().classes("adders"):
            for name in PRESETS:
                ui.button(name, on_click=lambda n=name: _begin(place, lambda session: preset(session, n))).props(
                    "no-caps outline dense"
                )


def _kept(place: Place) -> None:
    def open_again() -> None:
        try:
            path = place.allowed(str(folder.value or ""))
        except AsperityError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        _begin(place, lambda session: None, path)

    with ui.card().classes("table").props("flat bordered"):
        ui.label("A kept session").classes("table-title")
        ui.label("The folder in which it was kept, or a new one to keep it in from the start.").classes("hint")
        with ui.row().classes("adders"):
            folder = ui.input("Folder", placeholder="~/contacts/disk").props("dense").classes("folder")
            ui.button("Open", on_click=open_again).props("no-caps outline")


def _open_sessions(place: Place) -> None:
    ui.html("<h2>Open sessions</h2>", sanitize=False)
    for key, session in place.sessions.items():
        title = str(session.draft.get("title") or "Contact without a title")
        count = len(session.runs)
        kept = f" – kept in {session.folder}" if session.kept else ""
        ui.link(f"{title}{kept}, {count} run{'' if count == 1 else 's'}", f"/s/{key}/surface")


def _example(place: Place, name: str, question: str) -> None:
    """Picture, title and question of an example; pressed, it is run."""
    table = tomllib.loads(built_in(name))

    def run(session: Session) -> str:
        session.draft.replace(table)
        return f"explore?run={start(session, table['title']).key}"

    def pressed() -> None:
        card.props("disabled")  # once is enough
        _begin(place, run)

    with ui.element("button").classes("example").props(f'type="button" data-example="{name}"') as card:
        ui.element("img").props(f'src="{root_path()}/examples/{name}.png" alt="" width=360 height=240 loading=lazy')
        ui.html(html.escape(table["title"]), sanitize=False, tag="span").classes("table-title")
        ui.html(html.escape(question), sanitize=False, tag="span").classes("hint")
    card.on("click", pressed)
