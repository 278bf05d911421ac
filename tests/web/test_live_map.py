"""The map on the pages Surface and Prepare follows the form: at once, with nothing typed, and the
last one stays where a value is wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from .app_server import AppServer
from .expecting import expect
from .test_app import LONG, base_of, choose, document, fill, go, start_of

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def app() -> Iterator[AppServer]:
    with AppServer(("--demo", "--threads", "1")) as running:
        yield running


@pytest.fixture
def page(app: AppServer, open_page: Callable[..., Any]) -> Any:
    """The page Surface of a session in which a generator has been chosen."""
    page = open_page(app.address, viewport={"width": 1400, "height": 900}).page
    page.goto(start_of(page))
    page.click("text=Begin")
    base_of(page)
    page.click("button:has-text('A generator')")
    arrived(page)
    return page


def arrived(page: Any, name: str = "surface", state: str = "shown") -> str:
    """Numbers below the map of the preview ``name`` when it is that of the form."""
    page.wait_for_selector(f"[data-preview={name}][data-state={state}] .map .main-svg", timeout=LONG)
    return str(page.inner_text(f"[data-preview={name}] .numbers"))


def changed(page: Any, name: str, before: str) -> str:
    """The same once it is not as ``before``."""
    page.wait_for_function(
        "([name, before]) => { const at = document.querySelector(`[data-preview=${name}][data-state=shown] .numbers`);"
        " return at && at.innerText !== before }",
        arg=[name, before],
        timeout=LONG,
    )
    return arrived(page, name)


def generator(page: Any, word: str, key: str = "surface.kind") -> None:
    """Choose a kind in the list that is searched by typing its name."""
    page.fill(f'input[data-key="{key}"]', word)
    page.click(f'.q-menu .q-item >> text="{word}"')


def test_generators_and_steps_show_a_map_with_nothing_typed(page: Any) -> None:
    told = arrived(page)
    for word in ("sphere", "laser bumps", "two process", "rank ordered", "particles"):
        generator(page, word)
        told = changed(page, "surface", told)
        assert document(page)["surface"]["kind"] == word.replace(" ", "_")
    choose(page, "surface.matrix.kind", "two slopes")
    told = changed(page, "surface", told)
    page.click("text=Counter surface")
    generator(page, "grooves", "counter_surface.kind")
    arrived(page, "counter_surface")
    go(page, "prepare")
    told = arrived(page, "after")
    for number, step in enumerate(("crop", "filter", "tip limit", "resample", "slice"), start=1):
        page.click(f'[data-add="{step.replace(" ", "_")}"]')
        page.wait_for_selector(f"text={number}. {step}")
        told = arrived(page, "after")
    assert "64 × 1 points" in told
    page.click('[data-add="level"]')  # one after the other, however fast they are pressed
    page.click('[data-add="resample"]')
    page.wait_for_selector("text=7. resample")
    assert "32 × 1 points" in changed(page, "after", told)
    expect(page.locator(".failure")).to_have_count(0)


def test_the_last_map_stays_beside_what_is_wrong(page: Any) -> None:
    told = arrived(page)
    generator(page, "grooves")
    told = changed(page, "surface", told)
    wrong = '[data-wrong="surface"] .failure'
    fill(page, "surface.depth", "5")  # has no unit: said by the entry itself
    arrived(page, state="wrong")
    page.wait_for_selector("label:has([data-key='surface.depth']) .q-field__messages:has-text('Depth')")
    expect(page.locator(".failure")).to_have_count(0)
    fill(page, "surface.depth", "")  # is missing: said by the entry, but found by the whole
    page.wait_for_selector("label:has([data-key='surface.depth']) .q-field__messages:has-text('Depth')")
    fill(page, "surface.depth", "30 nm")
    changed(page, "surface", told)
    page.wait_for_selector("label:has([data-key='surface.depth']) .q-field__messages div", state="detached")
    fill(page, "surface.pitch", "3 um")  # does not fit in the size: said beside the table
    page.wait_for_selector(wrong)
    arrived(page, state="wrong")
    page.wait_for_function(
        "getComputedStyle(document.querySelector('[data-preview=surface] > .preview')).opacity < 0.9"
    )
    fill(page, "surface.pitch", "2.5 um")
    arrived(page)
    expect(page.locator(".failure")).to_have_count(0)


def test_a_step_that_fails_says_so_itself(page: Any) -> None:
    go(page, "prepare")
    told = arrived(page, "after")
    page.click('[data-add="resample"]')
    told = changed(page, "after", told)
    page.click('[data-add="filter"]')
    changed(page, "after", told)
    fill(page, "surface.prepare.1.short", "1 nm")
    page.wait_for_selector('[data-wrong="surface.prepare.1"] .failure')
    arrived(page, "after", "wrong")
    arrived(page, "before")


def test_what_needs_a_file_says_so(page: Any) -> None:
    generator(page, "from line scan")
    page.wait_for_selector("text=Drop the file on this page first.")


def test_typed_values_survive_another_choice(page: Any) -> None:
    generator(page, "sphere")
    page.wait_for_selector('input[data-key="surface.radius"]')
    fill(page, "surface.points", "64x64")
    fill(page, "surface.radius", "7 um")
    page.wait_for_selector("text=64 × 64 points")
    generator(page, "cone")
    page.wait_for_selector('input[data-key="surface.slope"]')
    generator(page, "sphere")
    page.wait_for_selector('input[data-key="surface.radius"]')
    surface = document(page)["surface"]
    assert (surface["points"], surface["radius"]) == ("64x64", "7 um")
