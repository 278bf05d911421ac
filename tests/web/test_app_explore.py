"""What a page shows of a solved contact, and sweeps, in a real browser; a part of another package
appears everywhere."""

from __future__ import annotations

import shutil
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
title = "Coated"

[surface]
kind = "rough"
points = [48, 48]
size = "2 um x 2 um"
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
mean_pressure = ["50 MPa", "0"]
steps = 2

[stress]
"""

PART = '''
from asperity.core.quantity import Quantity
from asperity.core.settings import Settings, setting
from asperity.core.values import Pressure
from asperity.parts.part import Found, Part, Words


class HotSettings(Settings):
    """Where the pressure is high."""

    level: Pressure = setting("100 MPa", help="Pressure from which a point counts")


class Hot(Part):
    """Share of the contact under a high pressure."""

    name = table = "hot"
    title = "Hot points"
    settings = HotSettings
    quantities = (Quantity("hot_share", "1", "share of the contact under a high pressure"),)

    def compute(self, ask, solved):
        return Found({"hot_share": float((solved.result.pressure >= ask.level).mean())})

    def words(self, found, solved):
        return Words(f"Hot: {found.values['hot_share']:.3g} of the surface.")
'''


@pytest.fixture(scope="module")
def app(tmp_path_factory: pytest.TempPathFactory) -> Iterator[AppServer]:
    """The application on a problem, with a package that adds a part."""
    folder = tmp_path_factory.mktemp("packages")
    install_part(folder, "hot_spots", PART, "hot", "Hot")
    (folder / "problem.toml").write_text(PROBLEM, encoding="utf-8")
    kept = folder / "kept"
    arguments = (str(folder / "problem.toml"), "--threads", "1", "--folder", str(kept))
    with AppServer(arguments, packages=folder) as running:
        yield running


def opened(app: AppServer, open_page: Callable[..., Any], step: str) -> Any:
    page = open_page(app.address, viewport={"width": 1400, "height": 950}, accept_downloads=True).page
    page.wait_for_url("**/s/**")
    page.goto(f"{page.url.rsplit('/', 1)[0]}/{step}")
    page.wait_for_selector("h1")
    return page


def explored(app: AppServer, open_page: Callable[..., Any]) -> Any:
    """Explore of the last run; one is made if no test before has made any."""
    page = opened(app, open_page, "run")
    if not page.locator("[data-state=done]").count():
        page.click("[data-run]")
        page.wait_for_selector("[data-state=done]", timeout=LONG)
    page.goto(page.url.replace("/run", "/explore"))
    page.wait_for_selector("[data-ready]", timeout=LONG)
    return page


def one_load(page: Any) -> None:
    """Give one load instead of a path, on the page of the load; tests share the problem and run in
    any order."""
    if not page.locator('input[data-key="control.mean_pressure"]').count():
        page.click('[data-key="control.kind"] >> text=Mean pressure')
        page.fill('input[data-key="control.mean_pressure"]', "40 MPa")
        page.wait_for_timeout(800)


@pytest.mark.slow
def test_a_part_of_another_package_and_a_solved_contact(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = opened(app, open_page, "load")
    page.click('[data-key="hot"]')
    page.fill('input[data-key="hot.level"]', "1 MPa")
    page.wait_for_timeout(800)
    page.goto(page.url.replace("/load", "/run"))
    page.click("[data-run]")
    page.wait_for_selector("[data-state=done]", timeout=LONG)
    page.click("[data-state=done] >> text=Explore")
    page.wait_for_selector("[data-ready]", timeout=LONG)
    page.click("text=Hot points")
    page.wait_for_selector("text=/^Hot: [0-9.e-]+ of the surface/")

    sliders = page.locator("[data-scene] input[type=range]")
    assert sliders.count() == 2, "load steps, and depths"
    page.click("[data-thumb=planes]")
    before = page.locator("[data-scene] output").all_inner_texts()
    for number in range(2):
        sliders.nth(number).press("ArrowRight" if number else "ArrowLeft")
    page.wait_for_function(
        "before => JSON.stringify([...document.querySelectorAll('[data-scene] output')].map(e => e.innerText)) "
        "!== JSON.stringify(before)",
        arg=before,
    )
    expect(page.locator("[data-scene] option", has_text="Von Mises stress below the section line")).to_have_count(1)

    viewer = "document.querySelector('[data-scene]').viewer"
    line = page.evaluate(f"{viewer}.line")
    page.click(".av-ends summary")
    field = page.locator("[data-scene] fieldset input").nth(1)
    field.fill("0.5")
    field.press("Enter")
    page.wait_for_function(f"line => JSON.stringify({viewer}.line) !== JSON.stringify(line)", arg=line)
    page.click("text=Certificate: what proves the solution")
    page.wait_for_selector("[data-certificate] td:has-text('active_set')")


@pytest.mark.slow
def test_the_spots_are_those_of_the_step_that_the_maps_show(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = explored(app, open_page)
    page.click("[data-spots]")
    row = page.locator("tr[data-spot]").first
    row.wait_for(state="visible", timeout=LONG)
    slider = page.locator("[data-slider=steps] input")
    steps = int(slider.get_attribute("max"))
    first = int(slider.input_value())
    assert first < steps, "the path ends without load"
    page.wait_for_selector(f"[data-spots] >> text=at step {first + 1} of {steps + 1}: mean pressure 50 MPa")
    before = page.locator("tr[data-spot]").count()
    slider.press("ArrowLeft")
    page.wait_for_selector(f"[data-spots] >> text=at step {first} of {steps + 1}: mean pressure 12.5 MPa", timeout=LONG)
    x, y = (float(part) for part in row.get_attribute("data-spot").split(","))
    found = page.evaluate(f"document.querySelector('[data-scene]').viewer.highlight({{ x: {x!r}, y: {y!r} }})")
    assert found is not None, "the spot is in the map of the step"
    area, unit = row.locator("td").nth(3).inner_text().split(" ")
    assert float(area) * {"nm²": 1e-18, "µm²": 1e-12}[unit] == pytest.approx(found["area"], rel=1e-3)
    page.keyboard.press("End")
    page.wait_for_selector(f"[data-spots] >> text=Contact spots: 0, at step {steps + 1} of {steps + 1}", timeout=LONG)
    assert before > 0
    expect(page.locator("tr[data-spot]")).to_have_count(0)


@pytest.mark.slow
def test_spots_are_marked_and_the_surface_is_shown_in_space(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = opened(app, open_page, "load")
    one_load(page)
    page.goto(page.url.replace("/load", "/run"))
    done = page.locator("[data-state=done]").count()
    page.click("[data-run]")
    page.wait_for_function(f"document.querySelectorAll('[data-state=done]').length > {done}", timeout=LONG)
    page.goto(page.url.replace("/run", "/explore"))
    page.wait_for_selector("[data-ready]", timeout=LONG)
    page.click("[data-spots]")
    row = page.locator("tr[data-spot]").first
    row.wait_for(state="visible", timeout=LONG)
    row.press("Enter")
    viewer = "document.querySelector('[data-scene]').viewer"
    page.wait_for_function(f"{viewer}.marked !== null && {viewer}.zoom > 1", timeout=LONG)
    page.click("[data-space]")
    page.wait_for_selector(".space .main-svg", timeout=LONG)
    page.click("text=Contact and plastic zone")
    page.click("[data-files]")
    with page.expect_download(timeout=LONG) as download:
        page.click("text=Fields as VTK")
    assert Path(download.value.path()).read_bytes().startswith(b'<?xml version="1.0"?>')


@pytest.mark.slow
def test_a_remedy_is_applied_and_run_again(tmp_path: Path, open_page: Callable[..., Any]) -> None:
    light = PROBLEM.partition("[control.path]")[0] + '[control]\nmean_pressure = "1 MPa"\n'
    (tmp_path / "light.toml").write_text(light, encoding="utf-8")
    with AppServer((str(tmp_path / "light.toml"), "--threads", "1")) as app:
        page = opened(app, open_page, "run")
        page.click("[data-run]")
        page.wait_for_selector("[data-state=done]", timeout=LONG)
        page.click("[data-state=done] >> text=Explore")
        page.wait_for_selector("[data-ready]", timeout=LONG)
        page.click("[data-verdicts] summary")
        expect(page.locator("[data-verdict=Trust]")).to_contain_text("The contact has")
        found = page.locator("[data-advice=Trust]")
        for finding in [found, *page.locator("[data-finding]").all()]:
            assert finding.locator("[data-remedy], [data-choose]").count() > 0, finding.inner_text()
        assert found.locator("[data-choose]").inner_text() == "Choose Control: Mean pressure"
        finer = "Prepare: resample (96 x 96 points)"
        found.locator("[data-remedy]", has_text=finer).click()
        page.wait_for_url("**/run")
        page.wait_for_selector(f"[data-state=done]:has-text('{finer}')", timeout=LONG)
        page.click(f"[data-state=done]:has-text('{finer}') >> text=Explore")
        page.wait_for_selector("[data-ready]", timeout=LONG)
        page.wait_for_function(
            "cell => Math.abs(document.querySelector('[data-scene]').viewer.cell[0] / cell - 1) < 1e-6", arg=2e-6 / 96
        )


@pytest.mark.slow
def test_what_a_part_refuses_stands_beside_its_table_before_the_run(
    tmp_path: Path, open_page: Callable[..., Any]
) -> None:
    plain = (
        PROBLEM.partition("[[body.layers]]")[0] + '[body]\nmaterial = "steel"\n\n[control]\nmean_pressure = "1 GPa"\n'
    )
    (tmp_path / "plain.toml").write_text(plain, encoding="utf-8")
    with AppServer((str(tmp_path / "plain.toml"), "--threads", "1")) as app:
        page = opened(app, open_page, "load")
        page.wait_for_timeout(1500)
        expect(page.locator("[data-refused]:not(:empty)")).to_have_count(0)
        page.click('[data-key="plastic_flow"]')
        beside = page.locator("[data-refused=plastic_flow]")
        beside.locator("text=yield stress of steel must be known").wait_for(timeout=LONG)
        assert "Bodies: Yield stress" in beside.inner_text()
        expect(page.locator("[data-refused]:not(:empty)")).to_have_count(1)
        card = page.locator(".table", has=page.locator('[data-key="plastic_flow"]')).bounding_box()
        below = beside.bounding_box()
        assert 0.0 <= below["y"] - card["y"] - card["height"] < 40.0
        page.goto(page.url.replace("/load", "/run"))
        page.wait_for_selector("[data-refused] >> text=yield stress of steel must be known", timeout=LONG)
        expect(page.locator("text=The document is complete.")).not_to_be_visible()
        page.goto(page.url.replace("/run", "/bodies"))
        page.wait_for_selector("[data-refused=body] >> text=yield stress of steel must be known", timeout=LONG)
        page.click('[data-row=body] [data-symbol="Y"] button')
        page.fill('input[data-key="body.yield_stress"]', "400 MPa")
        page.wait_for_function("document.querySelectorAll('[data-refused]:not(:empty)').length === 0", timeout=LONG)
        page.goto(page.url.replace("/bodies", "/load"))
        page.wait_for_timeout(2500)
        expect(page.locator("[data-refused]:not(:empty)")).to_have_count(0)


@pytest.mark.slow
def test_theories_stand_grey_beside_the_exact_solution_but_for_the_nearest(
    app: AppServer, open_page: Callable[..., Any]
) -> None:
    page = explored(app, open_page)
    page.click("[data-compared]")
    page.click("[data-theories]")
    page.wait_for_selector(".theories .main-svg", timeout=LONG)
    code = (
        "document.querySelector('.theories.js-plotly-plot, .theories .js-plotly-plot').data.map((t) => "
        "[t.meta, t.line.color, t.line.width, Math.max(...t.y.filter((v) => v !== null)), t.showlegend !== false])"
    )
    *theories, exact = page.evaluate(code)
    assert exact[:2] == ["boundary elements", "#000000"]
    assert exact[2] > max(width for _, _, width, _, _ in theories)
    assert max(largest for _, _, _, largest, _ in (*theories, exact)) <= 1.0
    coloured = [item for item in theories if item[1] != "#b4b8be"]
    assert 1 <= len(coloured) <= 3
    assert len({colour for _, colour, _, _, _ in (*coloured, exact)}) == len(coloured) + 1
    assert len({name for name, *_ in theories}) == len(theories) > len(coloured)
    shown = page.locator(".theories .legendtext").all_text_contents()
    assert shown[0] == "boundary elements"
    assert {name for name, *_ in coloured} < set(shown)
    assert len(shown) == len(coloured) + 2
    assert "MPa" in page.locator(".theories .xtitle").text_content()
    ticks = page.locator(".theories .xtick").all_text_contents()
    assert not any(letter in text for text in ticks for letter in "kMGµ")


@pytest.mark.slow
def test_a_phone_shows_what_was_solved_without_scrolling_sideways(
    app: AppServer, open_page: Callable[..., Any]
) -> None:
    page = open_page(app.address, viewport={"width": 390, "height": 800}).page
    page.wait_for_url("**/s/**")
    base = page.url.rsplit("/", 1)[0]
    page.goto(f"{base}/run")
    page.wait_for_selector("[data-run]")
    if not page.locator("[data-state=done]").count():
        page.click("[data-run]")
        page.wait_for_selector("[data-state=done]", timeout=LONG)
    page.goto(f"{base}/explore")
    page.wait_for_selector("[data-ready]", timeout=LONG)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.goto(f"{base}/sweep")
    page.wait_for_selector("[data-sweep]")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


@pytest.mark.slow
def test_curves_of_a_sweep(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = opened(app, open_page, "load")
    one_load(page)
    page.goto(page.url.replace("/load", "/sweep"))
    page.wait_for_selector("[data-sweep]")
    page.fill('input[data-key="first"]', "10 MPa")
    page.fill('input[data-key="last"]', "80 MPa")
    page.fill('input[data-key="count"]', "3")
    page.click("[data-sweep]")
    page.wait_for_selector("[data-curve='3']", timeout=LONG)
    page.wait_for_selector("[data-state=done] >> text=Study document", timeout=LONG)
    with page.expect_download() as table:
        page.click("text=Table (CSV)")
    lines = Path(table.value.path()).read_text(encoding="utf-8").splitlines()
    assert len(lines) == 4
    areas = [float(line.split(",")[1]) for line in lines[1:]]
    assert areas == sorted(areas)
    assert areas[0] > 0.0


@pytest.mark.slow
def test_a_kept_session_is_opened_again(app: AppServer, open_page: Callable[..., Any], tmp_path: Path) -> None:
    kept = Path(app.arguments[-1])
    page = opened(app, open_page, "run")
    if page.locator("[data-state=done]").count() == 0:  # no test before this one has run in this process
        page.click("[data-run]")
        page.wait_for_selector("[data-state=done]", timeout=LONG)
    shutil.copytree(kept, tmp_path / "kept")  # the folder itself is open in the first application
    with AppServer(("--folder", str(tmp_path / "kept"))) as again:
        page = opened(again, open_page, "run")
        runs = len(list((kept / "runs").glob("*/report.html")))
        assert runs > 0
        expect(page.locator("[data-state=done]")).to_have_count(runs)
