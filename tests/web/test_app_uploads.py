"""Several files at once: all arrive, and are chosen from, compared, pressed and taken for scans of
one surface."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.grid import Grid
from asperity.files import save_surface
from asperity.generate import ExponentialAutocorrelation, gaussian

from .app_server import AppServer
from .expecting import expect
from .test_app import LONG, base_of, document, go, start_of

COUNT = 6


@pytest.fixture(scope="module")
def app() -> Iterator[AppServer]:
    with AppServer(("--demo", "--threads", "1")) as running:
        yield running


@pytest.fixture(scope="module")
def scans(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Maps with their scale, each rougher than the one before."""
    folder = tmp_path_factory.mktemp("scans")
    files = [folder / f"scan {number}.nc" for number in range(1, COUNT + 1)]
    for number, file in enumerate(files, start=1):
        model = ExponentialAutocorrelation(number * 1e-9, 8e-8)
        save_surface(gaussian(Grid((32, 32), (1e-8, 1e-8)), model, seed=number), file)
    return files


def drop(page: Any, files: list[Path]) -> None:
    """Drop ``files`` on the area, as from the desktop."""
    transfer = page.evaluate_handle("new DataTransfer()")
    for file in files:
        page.evaluate(
            "([transfer, name, bytes]) => transfer.items.add(new File([new Uint8Array(bytes)], name))",
            [transfer, file.name, list(file.read_bytes())],
        )
    page.dispatch_event(".drop", "drop", {"dataTransfer": transfer})


def begun(app: AppServer, open_page: Callable[..., Any], width: int = 1400) -> Any:
    """A page of a new session."""
    page = open_page(app.address, viewport={"width": width, "height": 900}).page
    page.goto(start_of(page))
    page.click("text=Begin")
    base_of(page)
    page.wait_for_selector(".drop")
    return page


@pytest.mark.slow
def test_all_files_that_are_dropped_at_once_arrive(
    app: AppServer, scans: list[Path], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    page = begun(app, open_page)
    bad = tmp_path / "notes.txt"
    bad.write_text("these are no heights\n", encoding="utf-8")
    drop(page, [*scans, bad])
    page.wait_for_selector(f".file-picture img >> nth={COUNT - 1}", timeout=LONG)
    expect(page.locator(".file")).to_have_count(COUNT + 1)
    page.wait_for_selector("[data-file='notes.txt'] .bad")
    assert page.inner_text(".file.here .file-words").startswith("scan 1.nc")
    expect(page.locator("[data-file='scan 6.nc']")).to_contain_text("32 × 32 points, 320 nm × 320 nm, rms")
    assert document(page)["surface"]["path"] == "scan 1.nc"
    sources = page.eval_on_selector_all(".file-picture img", "found => found.map(item => item.src)")
    assert len(set(sources)) == COUNT

    with page.expect_navigation():
        page.click("[data-file='scan 4.nc'] [data-choose]")
    page.wait_for_selector(".file.here:has-text('scan 4.nc')")
    assert document(page)["surface"]["path"] == "scan 4.nc"

    page.wait_for_selector("[data-file='notes.txt'] .bad")
    for name in ("notes.txt", "scan 2.nc"):
        page.click(f"[data-file='{name}'] .q-checkbox")
    page.click("[data-files=compare]")
    page.wait_for_selector(".compared img", timeout=LONG)
    expect(page.locator("[data-compared]")).to_have_count(COUNT - 1)
    rows = page.eval_on_selector_all(
        ".spots tbody tr", "found => found.map(row => row.innerText.split('\\t')[0].trim())"
    )
    assert rows == [f"scan {number}.nc" for number in (1, 3, 4, 5, 6)]
    spans = page.evaluate(SPANS)
    assert spans == sorted(spans), "the rougher a map, the more of the common colours it has"
    assert spans[0] < 0.6 * spans[-1]

    with page.expect_navigation():
        page.click("[data-files=one]")
    page.wait_for_selector('[data-key="surface.spectrum.scans.4.path"]')
    assert [entry["path"] for entry in document(page)["surface"]["spectrum"]["scans"]] == rows


FIRST_CELLS, TEXTS = ".spots tbody tr td:first-child", "found => found.map(cell => cell.innerText.trim())"

SPANS = """[...document.querySelectorAll('.compared img')].map(image => {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const green = context.getImageData(0, 0, canvas.width, canvas.height).data.filter((_, at) => at % 4 === 1).sort();
  return green[green.length - 1] - green[0];
})"""
"""Range of the green of every picture, which grows along the scale of colours."""


@pytest.mark.slow
def test_a_batch_presses_each_of_the_files(
    app: AppServer, scans: list[Path], open_page: Callable[..., Any], tmp_path: Path
) -> None:
    page = open_page(app.address, viewport={"width": 1400, "height": 900}).page
    page.goto(start_of(page))
    page.click("text=Coated rough disk")
    base_of(page)
    page.wait_for_selector(".drop")
    unscaled = tmp_path / "unscaled.txt"
    np.savetxt(unscaled, np.random.default_rng(1).normal(size=(16, 16)))
    drop(page, [*scans[:3], unscaled])
    page.wait_for_selector(".file-picture img >> nth=2", timeout=LONG)
    page.wait_for_selector("[data-file='unscaled.txt'] .bad")
    before = document(page)["surface"]
    assert before["kind"] != "file", "the surface that was there stays until one is chosen"
    page.click("[data-files=batch]")
    page.wait_for_url("**/sweep")
    page.wait_for_function(
        "[...document.querySelectorAll('.spots tbody tr')].filter(row => /MPa|GPa/.test(row.innerText)).length === 3",
        timeout=2 * LONG,
    )
    names = page.eval_on_selector_all(
        ".spots tbody tr td:first-child", "found => found.map(cell => cell.innerText.trim())"
    )
    assert names == ["scan 1.nc", "scan 2.nc", "scan 3.nc", "unscaled.txt"]
    page.wait_for_selector("[data-state=done]", timeout=LONG)
    page.wait_for_selector(".failure:has-text('unscaled.txt')", timeout=LONG)
    go(page, "surface")
    page.wait_for_selector(".file")
    assert document(page)["surface"] == before


@pytest.mark.slow
def test_files_beside_one_of_which_the_form_says_what_it_lacks(
    app: AppServer, open_page: Callable[..., Any], tmp_path: Path
) -> None:
    """Size and unit that are given for one text hold for others like it."""
    files = [tmp_path / f"text {number}.txt" for number in (1, 2, 3)]
    for number, file in enumerate(files):
        np.savetxt(file, np.random.default_rng(number).normal(size=(16, 16)))
    page = begun(app, open_page)
    drop(page, files[:1])
    page.wait_for_selector('input[data-key="surface.size"]')
    page.wait_for_selector("text=does not state its size", timeout=LONG)
    page.fill('input[data-key="surface.size"]', "1 um x 1 um")
    page.fill('input[data-key="surface.height_unit"]', "nm")
    page.wait_for_selector("text=16 × 16 points", timeout=LONG)
    drop(page, files[1:])
    page.wait_for_selector(".file-picture img >> nth=2", timeout=LONG)
    with page.expect_navigation():
        page.click("[data-file='text 3.txt'] [data-choose]")
    page.wait_for_selector(".file.here:has-text('text 3.txt')")
    asked = document(page)["surface"]
    assert (asked["path"], asked["size"], asked["height_unit"]) == ("text 3.txt", "1 um x 1 um", "nm")
    with page.expect_navigation():
        page.click("[data-files=one]")
    page.wait_for_selector('[data-key="surface.spectrum.scans.2.path"]')
    entries = document(page)["surface"]["spectrum"]["scans"]
    assert {entry["height_unit"] for entry in entries} == {"nm"}


@pytest.mark.slow
def test_the_list_fits_a_phone(app: AppServer, scans: list[Path], open_page: Callable[..., Any]) -> None:
    page = begun(app, open_page, width=420)
    drop(page, scans[:3])
    page.wait_for_selector(".file-picture img >> nth=2", timeout=LONG)
    page.click("[data-files=compare]")
    page.wait_for_selector(".compared img >> nth=2", timeout=LONG)
    assert page.evaluate("document.documentElement.scrollWidth") <= 420
