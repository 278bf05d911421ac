"""A run is explored while it goes on: progress, maps of the first steps, files behind."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from .app_server import AppServer, install_part
from .expecting import expect

LONG = 90_000

PROBLEM = """
version = 2
title = "A long path"

[surface]
kind = "rough"
points = [256, 256]
size = "2 um x 2 um"
seed = 5

[surface.spectrum]
kind = "gaussian"
rms_height = "4 nm"
correlation_length = "0.1 um"

[[body.layers]]
material = "DLC"
thickness = "50 nm"

[body.base]
material = "steel"

[control.path]
mean_pressure = ["200 MPa"]
steps = 40

[stress]

[slow]
value = 4
"""

PART = '''
import time
from pathlib import Path
from asperity.core.quantity import Quantity
from asperity.core.settings import Settings, setting
from asperity.core.values import Positive
from asperity.parts.part import Found, Part


class SlowSettings(Settings):
    """What is found."""

    value: Positive = setting(1.0, help="Value")


class Slow(Part):
    """An analysis that ends when a file beside this one is there."""

    name = table = "slow"
    title = "Slow analysis"
    settings = SlowSettings
    quantities = (Quantity("slow_value", "1", "value that was found"),)

    def compute(self, ask, solved):
        with solved.stage("slow analysis"):
            while not Path(__file__).with_name("go").exists():
                time.sleep(0.05)
        return Found({"slow_value": ask.value})
'''

VIEWER = "document.querySelector('[data-scene]').viewer"


@pytest.fixture
def app(tmp_path: Path, request: Any) -> Iterator[AppServer]:
    """The application on a path of so many loads, 40 by default, with an analysis that ends when it
    may."""
    problem = PROBLEM.replace("steps = 40", f"steps = {getattr(request, 'param', 40)}")
    install_part(tmp_path, "slow_part", PART, "slow", "Slow")
    (tmp_path / "problem.toml").write_text(problem, encoding="utf-8")
    with AppServer((str(tmp_path / "problem.toml"), "--threads", "1"), packages=tmp_path) as running:
        yield running


def begun(app: AppServer, open_page: Callable[..., Any]) -> Any:
    """Explore of a run that was just begun."""
    page = open_page(app.address, viewport={"width": 1400, "height": 950}).page
    page.wait_for_url("**/s/**")
    page.goto(f"{page.url.rsplit('/', 1)[0]}/run")
    page.click("[data-run-explore]")
    page.wait_for_url("**/explore?run=*")
    return page


@pytest.mark.slow
def test_maps_of_the_first_steps_are_explored_while_others_are_solved(
    app: AppServer, open_page: Callable[..., Any]
) -> None:
    page = begun(app, open_page)
    page.wait_for_selector("[data-ready]", timeout=LONG)
    assert page.locator("[data-verdict]").count() == 0, "the run goes on"
    page.wait_for_selector("[data-curve-so-far] .main-svg", timeout=LONG)
    page.evaluate(f"{VIEWER}.setView(0.5e-6, 1.5e-6, 4)")
    page.evaluate(f"{VIEWER}.setLine(0.2e-6, 0.3e-6, 1.2e-6, 1.4e-6)")
    page.evaluate(f"{VIEWER}.choose('gap')")

    assert app.packages is not None
    (app.packages / "go").touch()
    page.wait_for_selector("[data-verdict]", timeout=LONG)
    page.wait_for_function(f"{VIEWER}.scene.steps && {VIEWER}.scene.steps.numbers.length === 40", timeout=LONG)
    page.wait_for_function(f"{VIEWER}.visible.every((panel) => panel.raster)", timeout=LONG)
    assert page.evaluate(f"[...{VIEWER}.centre, {VIEWER}.zoom]") == pytest.approx([0.5e-6, 1.5e-6, 4.0])
    assert page.evaluate(f"{VIEWER}.line") == pytest.approx([0.2e-6, 0.3e-6, 1.2e-6, 1.4e-6])
    assert page.evaluate(f"{VIEWER}.visible.map((panel) => panel.map.name)") == ["gap"]
    assert page.evaluate(f"{VIEWER}.scene.steps.numbers[{VIEWER}.position.steps]") == 40, "the decisive step"

    page.click("[data-files]")
    page.wait_for_selector(".downloads >> text=report", timeout=LONG)  # without drawing the page again
    page.wait_for_function(f"Math.abs({VIEWER}.zoom - 4) < 1e-6")
    expect(page.locator("[data-behind]")).to_have_count(0)
    page.wait_for_function(f"{VIEWER}.panels.some((panel) => panel.map.name === 'planes')", timeout=LONG)
    page.wait_for_function(f"Math.abs({VIEWER}.zoom - 4) < 1e-6")

    shares = page.evaluate(
        f"(async () => {{ const v = {VIEWER}; await v.choose('contact'); const all = [];"
        " for (const step of [0, 20, 39]) { await v.set('steps', step); all.push(v.visible[0].raster.shares[0]); }"
        " return all; })()"
    )
    assert 1.0 > shares[0] > shares[1] > shares[2] > 0.0, "more touches at a larger load"


@pytest.mark.slow
@pytest.mark.parametrize("app", [1000], indirect=True)
def test_progress_tells_step_and_time_and_a_run_is_cancelled_where_it_is_watched(
    app: AppServer, open_page: Callable[..., Any]
) -> None:
    page = begun(app, open_page)
    page.wait_for_selector("text=/step [0-9]+ of 1000.* left$/", timeout=LONG)
    page.wait_for_selector("[data-curve-so-far] .main-svg", timeout=LONG)
    points = "document.querySelector('[data-curve-so-far] .js-plotly-plot').data[0].x.length"
    first = page.evaluate(points)
    page.wait_for_function(f"{points} > {first}", timeout=LONG)
    page.click("text=Cancel")
    page.wait_for_selector("text=/^Cancelled/", timeout=LONG)
    page.wait_for_selector("[data-scene]", state="detached")


def test_a_map_that_nobody_made_is_not_found(app: AppServer) -> None:
    cookie = app.cookie()
    key = app.session(cookie)
    for name in ("pressure", "..%2f..%2fproblem.toml", "%2fetc%2fpasswd"):
        status, _, _ = app.ask("GET", f"/views/{key}/001-aaaaaa/{name}", cookie=cookie)
        assert status == 404
