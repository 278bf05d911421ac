"""Pages of the bodies and of load and physics in a real browser: rows of layers with their
constants and sources, the drawing beside them, the load, and the cards of physics."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.registry import FORMS
from asperity.run.document import checked

from .app_server import AppServer
from .expecting import expect
from .test_app import choose, document, fill

HEAD = """
version = 2

[surface]
kind = "rough"
points = [32, 32]
size = "1 um x 1 um"
seed = 1

[surface.spectrum]
kind = "gaussian"
rms_height = "1 nm"
correlation_length = "0.2 um"
"""

COATED = (
    HEAD
    + """
[[body.layers]]
material = "DLC"
thickness = "5 nm"
hardness = "12 GPa"

[[body.layers]]
material = "chromium"
thickness = "1 nm"
interface = "frictionless"

[[body.layers]]
kind = "linear"
thickness = "0.5 um"
top = "steel"
bottom = { name = "own end", youngs_modulus = "100 GPa", poisson_ratio = 0.3, hardness = "60 HRC" }

[body.base]
material = "glass ceramics"

[control]
mean_pressure = "4 MPa"
"""
)


@pytest.fixture
def app(tmp_path: Path) -> Iterator[Callable[[str], AppServer]]:
    """Starts the application on the text of a document."""
    started: list[AppServer] = []

    def start(text: str) -> AppServer:
        (tmp_path / "problem.toml").write_text(text, encoding="utf-8")
        started.append(AppServer((str(tmp_path / "problem.toml"), "--threads", "1")).__enter__())
        return started[-1]

    yield start
    for one in started:
        one.__exit__()


def opened(server: AppServer, open_page: Callable[..., Any], step: str, width: int = 1400) -> Any:
    page = open_page(server.address, viewport={"width": width, "height": 900}).page
    page.wait_for_url("**/s/**")
    page.goto(f"{page.url.rsplit('/', 1)[0]}/{step}")
    page.wait_for_selector("h1")
    page.wait_for_timeout(500)
    return page


def cell(page: Any, row: str, symbol: str) -> Any:
    """The constant of a row."""
    return page.locator(f'[data-row="{row}"] > [data-symbol="{symbol}"]')


def resolved(page: Any, row: str) -> list[str]:
    """What a row shows of E, ν, H and Y."""
    return [cell(page, row, symbol).locator("button").inner_text() for symbol in "EνHY"]


@pytest.mark.slow
def test_a_row_shows_what_the_body_will_have_and_its_sources_on_demand(
    app: Callable[[str], AppServer], open_page: Callable[..., Any]
) -> None:
    page = opened(app(COATED), open_page, "bodies")
    tops = [page.locator(f'[data-row="body.{row}"]').bounding_box()["y"] for row in ("layers.0", "layers.1", "base")]
    assert tops == sorted(tops)
    cells = [page.locator('[data-row="body.layers.0"] > *').nth(n).bounding_box() for n in range(1, 8)]
    assert max(box["y"] for box in cells) - min(box["y"] for box in cells) < 12.0, "one row"
    assert resolved(page, "body.layers.0") == ["140 GPa", "0.25", "12 GPa", "not known"]
    assert resolved(page, "body.base")[0] == "150 GPa"
    assert cell(page, "body.layers.0", "H").locator(".mark").inner_text() == "own"
    assert "7.372 GPa" in cell(page, "body.layers.2.bottom", "H").locator(".mark").inner_text()
    expect(page.locator("[data-source]")).to_have_count(0)

    cell(page, "body.layers.0", "E").locator("button").click()
    page.wait_for_selector("[data-source='body.layers.0.youngs_modulus']:has-text('Bhushan')")
    page.keyboard.press("Escape")
    page.wait_for_selector("[data-source]", state="detached")
    cell(page, "body.layers.0", "H").locator("button").focus()
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-source]:has-text('The library has 15 GPa')")
    page.click("[data-back='body.layers.0.hardness']")
    page.wait_for_function(
        "document.querySelector('[data-row=\"body.layers.0\"] [data-symbol=H]').innerText === '15 GPa'"
    )
    page.keyboard.press("Escape")
    assert "hardness" not in document(page)["body"]["layers"][0]

    cell(page, "body.layers.1", "Y").locator("button").click()
    fill(page, "body.layers.1.yield_stress", "500 MPa")
    page.wait_for_selector('[data-row="body.layers.1"] [data-symbol="Y"] .mark:has-text("own")')
    page.keyboard.press("Escape")
    cell(page, "body.layers.1", "E").locator("button").click()
    page.click("text=Take these as own constants")
    fill(page, "body.layers.1.youngs_modulus", "300 GPa")
    page.wait_for_timeout(700)
    layer = document(page)["body"]["layers"][1]
    assert (layer["youngs_modulus"], layer["yield_stress"], layer["interface"]) == (
        "300 GPa",
        "500 MPa",
        "frictionless",
    )
    page.click('[data-details="body.layers.1"]')
    page.click('[data-back="body.layers.1"]')
    page.wait_for_function(
        "document.querySelector('[data-row=\"body.layers.1\"] [data-symbol=E]').innerText === '279.1 GPa'"
    )
    layer = document(page)["body"]["layers"][1]
    assert layer["material"] == "chromium"
    assert not {"youngs_modulus", "yield_stress", "name"} & layer.keys()


@pytest.mark.slow
def test_layers_are_added_moved_and_removed_and_all_else_is_folded(
    app: Callable[[str], AppServer], open_page: Callable[..., Any]
) -> None:
    page = opened(app(COATED), open_page, "bodies")
    expect(page.locator('[data-key="body.layers.0.interface"]')).to_have_count(0)
    page.click('[data-details="body.layers.0"]')
    choose(page, "body.layers.0.interface", "frictionless")
    page.wait_for_function("document.querySelectorAll('[data-body=body] .slips').length === 2")
    page.locator('[data-move="body.layers.0.later"]').press("Enter")
    page.wait_for_selector('[data-row="body.layers.1"] input[value="DLC"], [data-row="body.layers.1"] :text("DLC")')
    page.wait_for_selector("[data-move='body.layers.1.later']:focus")
    page.click('[data-remove="body.layers.0"]')
    page.wait_for_selector('[data-row="body.layers.2"]', state="detached")
    page.click('[data-body=body] [data-add="layer"]')
    page.wait_for_selector(".stack text:has-text('not chosen yet')")
    choose(page, "body.layers.2.material", "copper")
    fill(page, "body.layers.2.thickness", "20 nm")
    page.wait_for_selector(".stack text:has-text('copper, 20 nm')")
    found = document(page)["body"]
    assert [layer.get("material") for layer in found["layers"]] == ["DLC", None, "copper"]
    assert found["base"]["material"] == "glass ceramics"
    for _ in range(3):
        page.click('[data-remove="body.layers.0"]')
        page.wait_for_timeout(400)
    page.wait_for_selector('[data-row="body"]')
    found = document(page)["body"]
    assert found["material"] == "glass ceramics"
    assert not {"layers", "base"} & found.keys()
    page.click('[data-body=body] [data-add="linear"]')
    fill(page, "body.layers.0.thickness", "1 um")
    for end, material in (("top", "DLC"), ("bottom", "steel")):
        choose(page, f"body.layers.0.{end}.material", material)
    page.wait_for_selector(".stack linearGradient", state="attached")
    page.wait_for_timeout(500)
    assert checked(document(page)).body.layers[0].kind == "linear"


@pytest.mark.slow
@pytest.mark.parametrize("width", [1400, 420])
def test_the_drawing_stays_in_view_and_follows_each_change(
    app: Callable[[str], AppServer], open_page: Callable[..., Any], width: int
) -> None:
    page = opened(app(COATED), open_page, "bodies", width)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.click('[data-details="body.layers.0"]')
    page.click('[data-details="body.layers.1"]')
    page.wait_for_timeout(500)
    drawing = page.locator("[data-body=body] .stack")
    drawing.locator("text=DLC, 5 nm").wait_for()
    before = page.evaluate("scrollY")
    page.locator('[data-row="body.base"]').scroll_into_view_if_needed()
    page.wait_for_timeout(300)
    assert page.evaluate("scrollY") > before + 100.0
    box, header = drawing.bounding_box(), page.locator("header").bounding_box()
    assert header["y"] + header["height"] <= box["y"]
    assert box["y"] + box["height"] <= 900.0
    assert box["height"] < 450.0
    fill(page, "body.layers.0.thickness", "0.1 um")
    drawing.locator("text=DLC, 100 nm").wait_for()
    page.wait_for_selector("[data-body=body] figcaption:has-text('601 nm')")
    page.wait_for_selector("[data-body=body] figcaption:has-text('chromium, 1 nm would be thinner than a pixel')")
    thin = page.locator("[data-body=body] .stack rect.thin")
    assert thin.count() == 1
    assert thin.bounding_box()["height"] >= 2.0
    assert drawing.locator("linearGradient").count() == 1
    assert drawing.locator(".slips").count() == 1


@pytest.mark.slow
def test_a_body_that_is_not_chosen_is_not_drawn_as_rigid(
    app: Callable[[str], AppServer], open_page: Callable[..., Any]
) -> None:
    page = opened(app(HEAD), open_page, "bodies")
    body, counter = (page.locator(f"[data-body={name}] .stack") for name in ("body", "counter_body"))
    assert body.text_content() == "not chosen yet"
    assert body.locator("rect.open").evaluate("e => getComputedStyle(e).strokeDasharray") not in ("none", "")
    assert body.locator("rect.open").evaluate("e => getComputedStyle(e).fill") == "none"
    assert body.locator(".rigid, .hatch").count() == 0
    assert counter.text_content() == "rigid (default)"
    page.click('[data-key="counter_body.kind"] >> text=A material')
    counter.locator("text=steel").wait_for()
    page.click('[data-key="counter_body.kind"] >> text=Rigid')
    page.wait_for_function("document.querySelector('[data-body=counter_body] .stack').textContent === 'rigid'")
    page.click('[data-key="body.kind"] >> text=Own constants')
    page.wait_for_selector("[data-body=body] .stack text:text-is('own material')")
    assert body.locator("rect.open").count() == 1


@pytest.mark.slow
def test_the_load_comes_first_and_settings_are_folded(
    app: Callable[[str], AppServer], open_page: Callable[..., Any]
) -> None:
    page = opened(app(COATED), open_page, "load")
    places = [page.locator(place).first.bounding_box()["y"] for place in (".load", "[data-setting]", "[data-card]")]
    assert places == sorted(places)
    assert page.locator('[data-setting="boundary"]').inner_text().split("\n")[:2] == ["Boundary", "periodic"]
    assert not page.locator('[data-key="boundary.kind"] >> visible=true').count()
    page.click('[data-setting="boundary"]')
    choose(page, "boundary.kind", "free")
    page.wait_for_selector('[data-setting="boundary"] .q-item__label--caption:has-text("free")')
    expect(page.locator('input[data-key="control.mean_pressure"]')).to_have_value("4 MPa")
    page.click('[data-key="control.kind"] >> text=Load path')
    page.wait_for_selector('input[data-key="control.mean_pressure"]', state="detached")
    fill(page, "control.path.mean_pressure", "50 MPa, 0, 80 MPa")
    page.wait_for_timeout(800)
    found = document(page)
    assert found["control"] == {"path": {"mean_pressure": ["50 MPa", "0", "80 MPa"], "steps": 10}}
    assert found["boundary"]["kind"] == "free"


@pytest.mark.slow
def test_only_chosen_cards_are_unfolded(app: Callable[[str], AppServer], open_page: Callable[..., Any]) -> None:
    page = opened(app(COATED + "\n[friction]\ncoefficient = 0.3\n"), open_page, "load")
    cards = page.locator("[data-card]")
    order = cards.evaluate_all("cards => cards.map(card => card.dataset.card)")
    assert order == [name for names in FORMS.values() for name in names]
    expect(page.locator("[data-card] .picture svg")).to_have_count(len(order))
    words = cards.locator(".physics-words > .hint").all_inner_texts()
    assert all(re.fullmatch(r"[A-Z][^.]+\.", text) for text in words)
    unfolded = (
        "cards => cards.filter(card => card.querySelector('.physics-settings').offsetHeight).map(c => c.dataset.card)"
    )
    assert cards.evaluate_all(unfolded) == ["friction"]
    expect(page.locator('input[data-key="friction.coefficient"]')).to_be_visible()
    expect(page.locator('input[data-key="friction.direction"]')).not_to_be_visible()
    page.click('[data-card="friction"] [data-details] .q-item')
    page.wait_for_selector('input[data-key="friction.direction"]')

    page.locator('[data-key="adhesion"]').press("Space")
    page.wait_for_selector('input[data-key="adhesion.work"]')
    assert cards.evaluate_all(unfolded) == ["adhesion", "friction"]
    fill(page, "adhesion.work", "50 mJ/m**2")
    fill(page, "adhesion.range", "1 nm")
    page.wait_for_timeout(800)
    assert document(page)["adhesion"]["work"] == "50 mJ/m**2"
    page.click('[data-key="friction"]')
    page.wait_for_selector('input[data-key="friction.coefficient"]', state="detached")
    page.click('[data-key="stress"]')
    page.wait_for_timeout(500)
    found = document(page)
    assert not found.get("friction", {}).get("coefficient")
    page.reload()
    page.wait_for_selector('input[data-key="adhesion.work"]')
    assert cards.evaluate_all(unfolded) == ["adhesion", "stress"]
    colours = []
    for dark in ("light", "dark"):
        page.emulate_media(color_scheme=dark)
        page.wait_for_timeout(400)
        colours.append(
            page.locator('[data-card="film"] .picture svg path').first.evaluate("e => getComputedStyle(e).stroke")
        )
    assert colours[0] != colours[1], "pictures take the colour of the text"
