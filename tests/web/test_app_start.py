"""The page on which a session begins: examples with pictures, each a press away from its result."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.run.document import EXAMPLES, PRESETS, load_document

from .app_server import AppServer
from .test_app import LONG, base_of

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def app() -> Iterator[AppServer]:
    with AppServer(("--threads", "1")) as running:
        yield running


def begin(app: AppServer, open_page: Callable[..., Any], width: int = 1400) -> Any:
    """The page on which sessions begin, also while there are some."""
    page = open_page(app.address, viewport={"width": width, "height": 900}).page
    page.wait_for_url(re.compile(r"/(start|s/.*)$"))
    page.goto(re.sub(r"/(start|s/.*)$", "/start", page.url))
    return page


@pytest.mark.parametrize("width", [1400, 420])
def test_examples_stand_with_their_pictures(app: AppServer, open_page: Callable[..., Any], width: int) -> None:
    page = begin(app, open_page, width)
    page.wait_for_selector("[data-example]")
    page.evaluate("document.querySelectorAll('.example img').forEach((img) => { img.loading = 'eager' })")
    page.wait_for_function(
        "[...document.querySelectorAll('.example img')].every((img) => img.complete && img.naturalWidth === 360)"
    )
    names = page.eval_on_selector_all("[data-example]", "cards => cards.map((card) => card.dataset.example)")
    assert names == list(EXAMPLES)
    for name in EXAMPLES:
        text = page.inner_text(f"[data-example={name}]")
        assert load_document(name).title in text
        assert EXAMPLES[name] in text
    for name in PRESETS:
        assert page.is_visible(f"button:has-text('{name}')")
    assert page.is_visible("button:has-text('Begin')")
    assert page.is_visible("input[aria-label='Folder']")
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("name", ["metal-seal", "flattened-metal"])
def test_a_press_leads_to_the_result(app: AppServer, open_page: Callable[..., Any], name: str) -> None:
    page = begin(app, open_page)
    page.locator(f"[data-example={name}]").press("Enter")
    page.wait_for_url("**/explore?run=*", timeout=LONG)
    page.wait_for_selector("[data-ready]", timeout=LONG)
    assert load_document(name).title in page.inner_text(".bar")
    page.go_back()
    page.wait_for_selector(f"[data-example={name}]")


def test_a_run_that_fails_says_why(open_page: Callable[..., Any]) -> None:
    with AppServer(("--threads", "1", "--time-limit", "0.01")) as server:
        page = open_page(server.address, viewport={"width": 1400, "height": 900}).page
        page.click("[data-example=coated-disk]")
        page.wait_for_selector("text=/^Stopped after 0.01 s/", timeout=LONG)
        page.click("text=What to change, and all runs")
        page.wait_for_selector("[data-state=failed] .failure")


def test_an_interface_of_the_literature_is_opened(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = begin(app, open_page)
    page.click("button:has-text('mems')")
    base_of(page)
    page.wait_for_selector("text=Carbon on a silicon micro-machine")
