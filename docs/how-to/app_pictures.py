"""Takes the pictures of ``app.md``: the application on the demonstration, in the system's chromium.

``python docs/how-to/app_pictures.py`` takes a minute or two; it needs the group ``test`` and
chromium.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent
SWITCHES = ("--no-sandbox", "--disable-background-networking", "--disable-component-update", "--disable-sync")
WAIT = 120_000


def take(page: Any, address: str) -> None:
    """Walk through a session and write the pictures beside this file."""
    page.goto(address)
    page.wait_for_url("**/s/**")
    base = page.url.rsplit("/", 1)[0]
    page.wait_for_selector(".map .main-svg", timeout=WAIT)
    page.wait_for_timeout(1500)
    page.screenshot(path=FOLDER / "app-surface.png")
    page.goto(f"{base}/bodies")
    page.wait_for_selector(".stack rect")
    page.wait_for_timeout(800)
    page.screenshot(path=FOLDER / "app-bodies.png")
    page.goto(f"{base}/run")
    page.click("[data-run]")
    page.wait_for_selector("[data-state=done]", timeout=WAIT)
    page.goto(f"{base}/explore")
    page.wait_for_selector("[data-ready]", timeout=WAIT)
    page.wait_for_timeout(1500)
    page.screenshot(path=FOLDER / "app-explore.png")
    page.goto(f"{base}/sweep")
    page.wait_for_selector("[data-sweep]")
    for key, text in (("first", "1 MPa"), ("last", "100 MPa"), ("count", "6")):
        page.fill(f'input[data-key="{key}"]', text)
    page.click("[data-sweep]")
    page.wait_for_selector("[data-curve='6']", timeout=WAIT)
    page.wait_for_timeout(2500)
    page.screenshot(path=FOLDER / "app-sweep.png")


def main() -> None:
    """Start the application, take the pictures, and end it."""
    from playwright.sync_api import sync_playwright

    command = [sys.executable, "-m", "asperity", "app", "--demo", "--no-browser"]
    running = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert running.stdout is not None
    try:
        found = re.search(r"http://\S+", running.stdout.readline())
        assert found is not None
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=SWITCHES)
            take(browser.new_page(viewport={"width": 1280, "height": 860}), found[0])
            browser.close()
    finally:
        running.terminate()


if __name__ == "__main__":
    main()
