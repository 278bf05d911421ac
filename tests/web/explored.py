"""Kept runs for tests of the page Explore: two of one size and one of another, solved once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .app_server import AppServer

LONG = 90_000

PROBLEM = """
version = 2
title = "{title}"

[surface]
kind = "rough"
points = [{points}, {points}]
size = "{size} um x {size} um"
seed = 5

[surface.spectrum]
kind = "gaussian"
rms_height = "4 nm"
correlation_length = "0.3 um"

[[body.layers]]
material = "DLC"
thickness = "50 nm"

[body.base]
material = "steel"

[control.path]
mean_pressure = ["{load} MPa", "10 MPa"]
steps = 2

[stress]
"""

RUNS = (
    {"title": "Fine", "points": 48, "size": 2, "load": 60},
    {"title": "Coarse", "points": 32, "size": 2, "load": 40},
    {"title": "Large", "points": 32, "size": 3, "load": 40},
)


def solved(open_page: Any, folder: Path, runs: int = len(RUNS)) -> Path:
    """Folder of a kept session with the first ``runs`` of ``RUNS``, made in the application below
    ``folder``."""
    kept = folder / "kept"
    for number, run in enumerate(RUNS[:runs], start=1):
        document = folder / f"{run['title']}.toml"
        document.write_text(PROBLEM.format(**run), encoding="utf-8")
        with AppServer((str(document), "--threads", "1", "--folder", str(kept))) as app:
            page = open_page(app.address)
            page.wait_for_url("**/s/**")
            page.goto(f"{page.url.rsplit('/', 1)[0]}/run")
            page.click("[data-run]")
            page.wait_for_function(f"document.querySelectorAll('[data-state=done]').length === {number}", timeout=LONG)
            page.goto(page.url.replace("/run", "/explore"))
            page.wait_for_selector("[data-ready]", timeout=LONG)
            page.goto("about:blank")
    return kept


def solved_in(browser: Any, folder: Path, runs: int = len(RUNS)) -> Path:
    """The same in windows of the ``browser`` that nobody watches."""

    def opened(address: str) -> Any:
        page = browser.new_page()
        page.goto(address)
        return page

    return solved(opened, folder, runs)


def keys(kept: Path) -> list[str]:
    """Keys of the runs, in their order."""
    return sorted(item.name for item in (kept / "runs").iterdir() if item.is_dir())
