"""Which page stands at which address, and the page on which a session begins."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import MappingProxyType
from typing import Any

from fastapi.responses import RedirectResponse
from nicegui import ui

from ..core.errors import AsperityError
from ..run.document import PRESETS, read_table
from .beginning import fill
from .layout import frame, look
from .pages_bodies import bodies_page
from .pages_explore import explore_page
from .pages_load import load_page
from .pages_run import run_page
from .pages_surface import prepare_page, roughness_page, surface_page
from .pages_sweep import sweep_page
from .session import Place, Session

PAGES = MappingProxyType(
    {
        "surface": surface_page,
        "prepare": prepare_page,
        "roughness": roughness_page,
        "bodies": bodies_page,
        "load": load_page,
        "run": run_page,
    }
)
"""What draws each page."""

OF_RUNS = MappingProxyType({"explore": explore_page, "sweep": sweep_page})
"""Pages that show one run, and another one beside it."""


def add_pages(app: Any, place: Place) -> None:
    """Register all pages."""

    @ui.page("/")
    def home() -> Any:
        if place.sessions:
            return RedirectResponse(f"/s/{next(reversed(place.sessions))}/surface")
        return RedirectResponse("/start")

    @ui.page("/start")
    def start() -> None:
        look()
        _start(place)

    @ui.page("/s/{key}/{step}")
    def page(key: str, step: str, run: str = "", beside: str = "") -> Any:
        session = place.sessions.get(key)
        if session is None or step not in {*PAGES, *OF_RUNS}:
            return RedirectResponse("/start")
        with frame(place, key, session, step):
            if step in OF_RUNS:
                OF_RUNS[step](key, session, run, beside)
            else:
                PAGES[step](key, session)
        return None


def _start(place: Place) -> None:
    """Begin a session, or open one again."""
    ui.page_title("asperity")
    ui.dark_mode(value=None)

    def begin(first: Callable[[Session], None], folder: Path | None = None, to: str = "surface") -> None:
        try:
            key, session = place.new(folder)
            first(session)
        except AsperityError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        session.touched()
        ui.navigate.to(f"/s/{key}/{to}")

    def open_again() -> None:
        try:
            path = place.allowed(str(folder.value or ""))
        except AsperityError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        begin(lambda session: None, path)

    with ui.element("main").classes("start"):
        ui.html("<h1>asperity – contact of layered rough surfaces</h1>", sanitize=False)
        ui.label("Everything is computed on this machine; nothing is sent anywhere.").classes("hint")
        with ui.element("div").classes("beside"):
            with ui.card().classes("table").props("flat bordered"):
                ui.label("A new contact").classes("table-title")
                ui.label("From a measured surface, or one that is generated.").classes("hint")
                ui.button("Begin", on_click=lambda: begin(lambda session: None)).props("no-caps")
            with ui.card().classes("table").props("flat bordered"):
                ui.label("An example").classes("table-title")
                ui.label("A built-in problem, or an interface of the literature.").classes("hint")
                ui.button("Coated rough disk", on_click=lambda: begin(lambda session: fill(session, demo=True))).props(
                    "no-caps outline"
                )
                for name in PRESETS:
                    ui.button(
                        name, on_click=lambda n=name: begin(lambda session: session.draft.replace(read_table(n)))
                    ).props("no-caps outline")
            with ui.card().classes("table").props("flat bordered"):
                ui.label("A kept session").classes("table-title")
                ui.label("The folder in which it was kept, or a new one to keep it in from the start.").classes("hint")
                folder = ui.input("Folder", placeholder="~/contacts/disk").classes("wide")
                ui.button("Open", on_click=open_again).props("no-caps outline")
        if place.sessions:
            ui.label("Open sessions").classes("table-title")
            for key, session in place.sessions.items():
                title = str(session.draft.get("title") or "Contact without a title")
                kept = f" – kept in {session.folder}" if session.kept else ""
                ui.link(f"{title}{kept}, {len(session.runs)} runs", f"/s/{key}/surface")
