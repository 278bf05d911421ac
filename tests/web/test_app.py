"""Whole sessions in a real browser."""

from __future__ import annotations

import csv
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

import asperity as asp
from asperity.run.document import checked

from .app_server import AppServer

LONG = 60_000
"""Milliseconds that the first work of a new process may take."""


@pytest.fixture(scope="module")
def demo() -> Iterator[AppServer]:
    with AppServer(("--demo", "--most-upload", "1", "--threads", "1")) as running:
        yield running


def base_of(page: Any) -> str:
    """Address of the session that ``page`` shows."""
    page.wait_for_url("**/s/**")
    return str(page.url).rsplit("/", 1)[0]


def start_of(page: Any) -> str:
    """Address of the page on which sessions begin, of the application that ``page`` shows."""
    return f"{base_of(page).rpartition('/s/')[0]}/start"


def go(page: Any, step: str) -> None:
    """Open another step of the same session and wait for it."""
    page.goto(f"{base_of(page)}/{step}")
    page.wait_for_selector("h1")


def fill(page: Any, key: str, text: str) -> None:
    """Type ``text`` into the entry of a key of the document."""
    page.fill(f'input[data-key="{key}"]', text)


def choose(page: Any, key: str, word: str) -> None:
    """Choose a word of the entry of a key."""
    page.click(f'[data-key="{key}"] >> visible=true')
    page.click(f'.q-menu .q-item:has-text("{word}") >> nth=0')


def details(page: Any, row: str) -> None:
    """Unfold what a row or card has beside, where it is folded."""
    fold = page.locator(f'[data-details="{row}"]')
    header = "e => e.matches('[aria-expanded]') ? e : e.querySelector('[aria-expanded]')"
    if fold.evaluate(f"e => ({header})(e).getAttribute('aria-expanded')") == "false":
        fold.click()


def put(page: Any, file: Path) -> None:
    """Choose a ``file`` in the area on which files are dropped."""
    with page.expect_file_chooser() as chooser:
        page.click(".drop")
    chooser.value.set_files(str(file))


def document(page: Any) -> dict[str, Any]:
    """The document as the page copies it."""
    page.click("text=Copy as")
    page.click(".q-menu >> text=document")
    text = page.inner_text(".copy code, .copy pre")
    page.locator(".copy button", has_text="Close").press("Enter")  # a click misses it where the text grows meanwhile
    page.wait_for_selector(".copy", state="hidden")  # until then its end takes the focus
    return tomllib.loads(text)


def finished(page: Any, count: int = 1) -> None:
    """Wait until so many runs are done."""
    page.wait_for_function(f"document.querySelectorAll('[data-state=done]').length >= {count}", timeout=LONG)


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A scan as text without size and unit, with a hostile name."""
    folder = tmp_path_factory.mktemp("scans")
    file = folder / "<b onmouseover=alert(1)>scan 7.txt"
    heights = np.random.default_rng(3).normal(scale=2.0, size=(32, 32))
    smooth = np.fft.ifft2(
        np.fft.fft2(heights) * np.exp(-((np.fft.fftfreq(32)[:, None] ** 2 + np.fft.fftfreq(32) ** 2) * 200))
    ).real
    np.savetxt(file, smooth)
    return file


@pytest.mark.slow
def test_a_whole_session(demo: AppServer, scan: Path, open_page: Callable[..., Any], tmp_path: Path) -> None:
    page = open_page(demo.address, viewport={"width": 1400, "height": 900}, accept_downloads=True).page
    base_of(page)
    page.goto(start_of(page))
    page.click("text=Begin")
    base_of(page)
    with page.expect_file_chooser() as chooser:
        page.click(".drop")
    chooser.value.set_files(str(scan))
    page.wait_for_selector(
        "text=does not state its size", timeout=LONG
    )  # neither size nor unit is in the file, and none is guessed
    fill(page, "surface.size", "1 um x 1 um")
    fill(page, "surface.height_unit", "nm")
    page.wait_for_selector(".map", timeout=LONG)
    page.wait_for_selector("text=32 × 32 points")
    assert page.query_selector("[onmouseover]") is None

    go(page, "prepare")
    page.click('[data-add="periodise"]')
    page.wait_for_selector("text=3. periodise")
    page.click("button[aria-label=undo]")
    page.wait_for_selector("text=3. periodise", state="detached")
    page.click("button[aria-label=redo]")
    page.wait_for_selector("text=3. periodise")

    go(page, "bodies")
    page.click('[data-key="body.kind"] >> text=Layers')
    fill(page, "body.layers.0.thickness", "5 nm")
    page.wait_for_selector(".stack text:has-text('DLC, 5 nm')")

    go(page, "load")
    fill(page, "control.mean_pressure", "5")
    page.wait_for_selector("text=/must have a unit|with a unit|a unit such/")
    fill(page, "control.mean_pressure", "20 MPa")
    page.wait_for_timeout(700)

    go(page, "run")
    fill(page, "title", "<script>alert(1)</script>")
    page.wait_for_timeout(600)
    page.click("[data-run]")
    page.wait_for_selector("[data-state=running]")
    page.click("text=Cancel")
    page.wait_for_selector("[data-state=cancelled]")
    page.click("[data-run]")
    finished(page)
    with page.expect_download() as csv_file:
        page.click("text=scalars (CSV)")
    with page.expect_download() as result_file:
        page.click("text=result (NetCDF)")
    with page.expect_download() as document_file:
        page.click("[data-state=done] >> text=document")
    asked = tomllib.loads(Path(document_file.value.path()).read_text(encoding="utf-8"))
    assert asked["title"] == "<script>alert(1)</script>"
    same_as_the_command(asked, scan, Path(csv_file.value.path()), Path(result_file.value.path()), tmp_path)
    assert re.search(r"scan 7\.txt", str(document(page)["surface"]["path"]))


def same_as_the_command(asked: dict[str, Any], scan: Path, scalars: Path, result: Path, folder: Path) -> None:
    """``asperity contact`` with the same document gives the same numbers to the last bit."""
    import tomli_w
    from typer.testing import CliRunner

    from asperity.cli.main import app

    (folder / "scan.txt").write_bytes(scan.read_bytes())
    asked["surface"]["path"] = "scan.txt"
    (folder / "problem.toml").write_text(tomli_w.dumps(asked), encoding="utf-8")
    ran = CliRunner().invoke(app, ["contact", "--from", str(folder / "problem.toml"), "--out", str(folder / "run")])
    assert ran.exit_code == 0, ran.output
    own, other = (numbers(path) for path in (folder / "run" / "scalars.csv", scalars))
    assert own == other
    copy = folder / "downloaded.nc"
    copy.write_bytes(result.read_bytes())
    one, two = asp.load(folder / "run" / "result.nc"), asp.load(copy)
    assert isinstance(one, asp.ContactResult)
    assert isinstance(two, asp.ContactResult)
    for name in ("pressure", "gap", "displacement"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))


def numbers(file: Path) -> list[list[str]]:
    """Rows of a table of scalars, without what depends on the clock."""
    with file.open(encoding="utf-8", newline="") as source:
        return [row for row in csv.reader(source) if "time" not in row[0] and "memory" not in row[0]]


@pytest.mark.slow
def test_a_viscoelastic_body_held_under_its_load(demo: AppServer, open_page: Callable[..., Any]) -> None:
    """Entries of the relaxation and of the times are those of the document, which is complete."""
    page = open_page(demo.address, viewport={"width": 1400, "height": 900}).page
    go(page, "bodies")
    page.click('[data-key="body.kind"] >> text=Own constants')
    details(page, "body")
    choose(page, "body.relaxation.kind", "prony")
    fill(page, "body.relaxation.relaxed", "1 GPa")
    fill(page, "body.relaxation.moduli", "10 GPa, 3 GPa")
    fill(page, "body.relaxation.times", "10 ms, 0.1 s")
    fill(page, "body.poisson_ratio", "0.4")
    fill(page, "body.hardness", "10 GPa")
    page.wait_for_timeout(700)
    go(page, "load")
    page.click('[data-key="stress"]')
    page.click('[data-key="viscoelastic"]')
    fill(page, "viscoelastic.hold", "0.1 s")
    details(page, "viscoelastic")
    fill(page, "viscoelastic.steps", "3")
    page.wait_for_timeout(700)
    asked = document(page)
    relaxation = asked["body"]["relaxation"]
    assert (relaxation["moduli"], relaxation["times"]) == (["10 GPa", "3 GPa"], ["10 ms", "0.1 s"])
    assert asked["viscoelastic"]["hold"] == ["0.1 s"]
    assert checked(asked).body.relaxation is not None


@pytest.mark.slow
def test_moduli_are_dropped_on_a_measured_relaxation(
    demo: AppServer, open_page: Callable[..., Any], tmp_path: Path
) -> None:
    """A sound table becomes that of the body; one with a wrong unit is refused in words, under the
    name that it was given."""
    sound, wrong = tmp_path / "rubber.csv", tmp_path / "wrong.csv"
    rubber = asp.Viscoelastic.prony(3e6, ((10e6, 0.01),), 0.5)
    frequency = np.geomspace(0.1, 1e3, 12)
    moduli = rubber.complex_modulus(2 * np.pi * frequency) / 1e6
    rows = "\n".join(f"{f},{e.real},{e.imag}" for f, e in zip(frequency, moduli, strict=True))
    sound.write_text(f"frequency (Hz), storage modulus (MPa), loss modulus (MPa)\n{rows}\n")
    wrong.write_text(f"frequency (kg), storage modulus (MPa), loss modulus (MPa)\n{rows}\n")
    page = open_page(demo.address, viewport={"width": 1400, "height": 900}).page
    go(page, "bodies")
    page.click('[data-key="body.kind"] >> text=Own constants')
    details(page, "body")
    choose(page, "body.relaxation.kind", "measured")
    fill(page, "body.poisson_ratio", "0.5")
    page.wait_for_timeout(700)
    put(page, wrong)
    page.wait_for_selector("text=wrong.csv")
    assert "moduli_file" not in document(page)["body"]["relaxation"]
    with page.expect_navigation():
        put(page, sound)
    page.wait_for_selector("h1")
    relaxation = document(page)["body"]["relaxation"]
    assert (relaxation["kind"], relaxation["moduli_file"]) == ("measured", "rubber.csv")


@pytest.mark.slow
def test_files_are_dropped_as_scans_of_one_surface(scan: Path, open_page: Callable[..., Any], tmp_path: Path) -> None:
    with AppServer(("--demo", "--most-upload", "1", "--threads", "1")) as server:  # sessions of others stay as they are
        page = open_page(server.address, viewport={"width": 1400, "height": 900}).page
        base_of(page)
        page.goto(start_of(page))
        page.click("text=Begin")
        base_of(page)
        page.click("button:has-text('Many scans')")
        page.wait_for_selector('[data-key="surface.spectrum.kind"]')
        other = tmp_path / "other.npy"
        np.save(other, np.loadtxt(scan))
        put(page, scan)
        page.wait_for_selector('[data-key="surface.spectrum.scans.0.path"]')
        put(page, other)
        page.wait_for_selector('[data-key="surface.spectrum.scans.1.path"]')
        fill(page, "surface.spectrum.scans.1.size", "1 um")
        fill(page, "surface.spectrum.scans.1.height_unit", "m")
        page.wait_for_timeout(1000)
        scans = document(page)["surface"]["spectrum"]["scans"]
        assert [Path(entry["path"]).name for entry in scans] == [scan.name, other.name]
        assert scans[1]["size"] == "1 um"


@pytest.mark.slow
def test_two_windows_show_the_same_document(demo: AppServer, open_page: Callable[..., Any]) -> None:
    one, two = (open_page(demo.address, viewport={"width": 1200, "height": 800}).page for _ in range(2))
    address = base_of(one)
    two.goto(f"{address}/load")
    go(one, "load")
    fill(one, "control.mean_pressure", "7 MPa")
    two.wait_for_function("document.querySelector('input[data-key=\"control.mean_pressure\"]')?.value === '7 MPa'")
    two.close()
    fill(one, "control.mean_pressure", "4 MPa")
    one.wait_for_timeout(600)
    assert document(one)["control"] == {"mean_pressure": "4 MPa"}


@pytest.mark.slow
def test_a_run_goes_on_when_its_window_is_closed(demo: AppServer, open_page: Callable[..., Any]) -> None:
    page = open_page(demo.address).page
    go(page, "run")
    page.wait_for_selector("[data-run]")
    before = page.locator("[data-state=done]").count()
    address = page.url
    page.click("[data-run]")
    page.wait_for_selector("[data-state=running]")
    context = page.context
    page.close()
    again = context.new_page()
    again.goto(address)
    finished(again, before + 1)


def test_a_file_over_the_cap_is_refused_in_words(
    demo: AppServer, open_page: Callable[..., Any], tmp_path: Path
) -> None:
    large = tmp_path / "large.txt"
    large.write_bytes(b"0 " * 2**20)
    watched = open_page(demo.address)
    base_of(watched.page)
    watched.page.wait_for_selector(".drop")
    with watched.page.expect_file_chooser() as chooser:
        watched.page.click(".drop")
    chooser.value.set_files(str(large))
    watched.page.wait_for_selector("text=more than 1 MiB")
    assert all("413" in text for text in watched.errors)  # the browser's own line about the refused request
    watched.errors.clear()


@pytest.mark.slow
def test_a_phone_shows_every_page_without_scrolling_sideways(demo: AppServer, open_page: Callable[..., Any]) -> None:
    page = open_page(demo.address, viewport={"width": 390, "height": 800}).page
    base_of(page)
    for step in ("surface", "prepare", "bodies", "load", "run"):
        go(page, step)
        page.wait_for_timeout(300)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390, step


@pytest.mark.slow
def test_keys_reach_the_steps_and_the_drop_area(demo: AppServer, open_page: Callable[..., Any]) -> None:
    page = open_page(demo.address).page
    base_of(page)
    page.wait_for_selector(".drop")
    choosers: list[Any] = []
    page.on("filechooser", lambda chooser: choosers.append(chooser))
    for _ in range(20):  # the preview may draw the page again between the focus and the key
        page.locator(".drop").press("Enter")
        page.wait_for_timeout(500)
        if choosers:
            break
    assert choosers
    page.locator("a.step:has-text('Bodies')").press("Enter")
    page.wait_for_url("**/bodies")
    names = page.evaluate(
        "[...document.querySelectorAll('button')].filter(b => !b.innerText.trim() && "
        "!b.getAttribute('aria-label')).length"
    )
    assert names == 0, "every button has a name"
