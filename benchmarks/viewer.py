"""How long the viewer of maps takes from an event to the drawn frame, with a load path on 1024 ×
1024 points, as the page Explore of the application shows it.

A coated rough surface is loaded in steps; its maps are shown by headless Chromium, which draws on
the processor. Steps are changed by arrow keys on the slider, once as a person presses them and once
as a held key repeats them, and the pointer is moved over the large map. The time of an event runs
from its time stamp, which the browser gives it on arrival, to the end of the frame in which it is
drawn, when a pixel of the map has been read back; it includes the wait for that frame.

Usage: python benchmarks/viewer.py [--points 1024] [--steps 40] [--write]
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from tables import add_option, made, show

MAPS = ("pressure", "gap", "contact", "heights")
SCREEN = {"width": 1400, "height": 900}
HELD = 33
"""Time in ms between the repeats of a held key."""

PRESSED = 150
"""Time in ms between single presses."""

PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>viewer</title>
<style>body {{ margin: 0; padding: 0 20px; width: 1120px; }} {style}</style><div id="maps"></div>
<script>{script}</script>"""

LISTEN = """(kind) => {
  const viewer = window.viewer;
  window.times = [];
  const drawn = (event) => requestAnimationFrame(() => {
    const canvas = viewer.visible[0].canvas;
    canvas.getContext("2d").getImageData(0, 0, 1, 1);
    const channel = new MessageChannel();
    channel.port1.onmessage = () => window.times.push(performance.now() - event.timeStamp);
    channel.port2.postMessage(0);
  });
  if (window.listening) viewer.element.removeEventListener(...window.listening);
  window.listening = [kind, drawn];
  viewer.element.addEventListener(kind, drawn);
}"""


def scene(points: int, steps: int) -> dict[str, Any]:
    """Maps of a load path as the application makes them."""
    import asperity as asp
    from asperity.report.scene import scene_of
    from asperity.web.views import BUDGET

    document = {
        "version": 2,
        "surface": {
            "kind": "rough",
            "points": [points, points],
            "size": "10 um x 10 um",
            "seed": 1,
            "spectrum": {"kind": "gaussian", "rms_height": "5 nm", "correlation_length": "0.2 um"},
        },
        "body": {"layers": [{"material": "DLC", "thickness": "50 nm"}], "base": {"material": "steel"}},
        "control": {"path": {"mean_pressure": ["300 MPa"], "steps": steps}},
    }
    found = scene_of(asp.run(document), budget=BUDGET)
    assert found is not None
    return found


def opened(page: Any, maps: dict[str, Any], folder: Path) -> None:
    """Show the ``maps`` and wait until nothing is left to be decoded."""
    from asperity.report import page as report

    file = folder / "viewer.html"
    file.write_text(PAGE.format(style=report.style(), script=report.script()), encoding="utf-8")
    page.goto(file.as_uri())
    page.evaluate(
        "async (scene) => { window.viewer = AsperityViewer.create(document.getElementById('maps'), scene, "
        "{ layout: 'one' }); await viewer.ready; }",
        maps,
    )


def stepped(page: Any, keys: str, count: int, pause: float) -> list[float]:
    """Times in ms of ``count`` presses of one of the ``keys`` on the slider through the steps."""
    page.locator("[data-slider=steps] input").focus()
    page.evaluate(LISTEN, "input")
    for _ in range(count):
        page.keyboard.press(keys)
        page.wait_for_timeout(pause)
    page.wait_for_timeout(300)
    return [float(value) for value in page.evaluate("times")]


def hovered(page: Any, count: int) -> list[float]:
    """Times in ms of ``count`` moves of the pointer over the large map."""
    box = page.locator(".av-panel:visible canvas").first.bounding_box()
    page.evaluate(LISTEN, "pointermove")
    for number in range(count):
        share = 0.2 + 0.6 * number / count
        page.mouse.move(box["x"] + share * box["width"], box["y"] + (1.0 - share) * box["height"])
        page.wait_for_timeout(20)
    page.wait_for_timeout(200)
    return [float(value) for value in page.evaluate("times")]


def measured(page: Any, count: int) -> list[list[str]]:
    """Rows: map, event, number, median, 90th percentile and worst in ms."""
    rows = []
    for name in MAPS:
        page.evaluate("(name) => viewer.choose(name)", name)
        page.wait_for_timeout(500)
        found = {
            "step, key pressed": stepped(page, "ArrowLeft", count, PRESSED),
            "step, key held": stepped(page, "ArrowRight", count, HELD),
            "pointer": hovered(page, 100),
        }
        for event, times in found.items():
            if event != "pointer" and name == "heights":
                continue  # the same at all steps
            middle, most = np.percentile(times, (50, 90))
            rows.append([name, event, str(len(times)), f"{middle:.0f}", f"{most:.0f}", f"{max(times):.0f}"])
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--points", type=int, default=1024)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--scene", type=Path, help="file that keeps the maps between two runs of this script")
    parser.add_argument("--settle", type=float, default=20.0, help="time in s before the first event")
    add_option(parser)
    given = parser.parse_args()
    from playwright.sync_api import sync_playwright

    if given.scene is not None and given.scene.is_file():
        maps = json.loads(given.scene.read_text(encoding="utf-8"))
    else:
        maps = scene(given.points, given.steps)
        if given.scene is not None:
            given.scene.write_text(json.dumps(maps), encoding="utf-8")
    program = os.environ.get("ASPERITY_CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        root = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        browser = playwright.chromium.launch(executable_path=program, args=["--disable-gpu", *root])
        page = browser.new_page(viewport=SCREEN)
        opened(page, maps, Path(folder))
        page.wait_for_timeout(1000 * given.settle)
        rows = measured(page, given.steps - 1)
        browser.close()
    show(made("viewer", ("map", "event", "events", "median (ms)", "90 % (ms)", "worst (ms)"), rows), write=given.write)


if __name__ == "__main__":
    main()
