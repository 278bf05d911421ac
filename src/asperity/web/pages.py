"""Which page stands at which address."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from fastapi.responses import RedirectResponse
from nicegui import ui

from .layout import frame, look
from .pages_bodies import bodies_page
from .pages_explore import explore_page
from .pages_load import load_page
from .pages_run import run_page
from .pages_start import start_page
from .pages_surface import prepare_page, roughness_page, surface_page
from .pages_sweep import sweep_page
from .session import Place

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
        start_page(place)

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
