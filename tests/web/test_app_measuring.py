"""Measuring with the mouse in a real browser: profile and cursors, masks, what a step removes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

import asperity as asp
from asperity.core.units import parse

from .app_server import AppServer
from .test_app import LONG, base_of, document, fill, go, put, start_of

SLOPE = 0.05
"""Height over length along x of the plane that is measured."""

SIDE, POINTS = 10e-6, 1100
"""Side of the plane in m, and points along it: more than the map shows."""


@pytest.fixture
def app() -> Iterator[AppServer]:
    """The demonstration, whose surface has no steps yet."""
    with AppServer(("--demo", "--threads", "1")) as running:
        yield running


@pytest.fixture(scope="module")
def plane(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An inclined plane with its size and unit."""
    file = tmp_path_factory.mktemp("plane") / "plane.nc"
    x = (np.arange(POINTS) + 0.5) * (SIDE / POINTS)
    surface = asp.Surface(np.broadcast_to(SLOPE * x[:, None], (POINTS, POINTS)), SIDE / POINTS)
    asp.save(surface, file)
    return file


@pytest.fixture
def page(app: AppServer, open_page: Callable[..., Any]) -> Any:
    found = open_page(app.address, viewport={"width": 1400, "height": 1000}, accept_downloads=True).page
    base_of(found)
    return found


def surface_with(page: Any, file: Path) -> None:
    """A new session whose surface is in ``file``, without any step."""
    page.goto(start_of(page))
    page.click("text=Begin")
    base_of(page)
    put(page, file)
    page.wait_for_selector(".measured .js-plotly-plot", timeout=LONG)


def corners(page: Any, key: str) -> dict[str, float]:
    """Rectangle of the screen that the axes of a picture enclose."""
    page.wait_for_function(f"document.querySelector('[data-measure=\"{key}\"] .js-plotly-plot')?._fullLayout?.xaxis")
    found: dict[str, float] = page.evaluate(
        """key => { const plot = document.querySelector(`[data-measure="${key}"] .js-plotly-plot`);
        plot.scrollIntoView({ block: "center" });
        const { left, top } = plot.getBoundingClientRect(), { xaxis, yaxis } = plot._fullLayout;
        return { x: left + xaxis._offset, y: top + yaxis._offset, width: xaxis._length, height: yaxis._length }; }""",
        key,
    )
    return found


def drag(page: Any, key: str, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Drag on a picture between two places in shares of its axes, from the lower left."""
    box = corners(page, key)
    places = [(box["x"] + x * box["width"], box["y"] + (1.0 - y) * box["height"]) for x, y in (start, end)]
    page.mouse.move(*places[0])
    page.mouse.down()
    page.mouse.move(*places[1], steps=6)
    page.mouse.up()


def readings(page: Any) -> dict[str, str]:
    """What stands between the cursors, by name."""
    page.wait_for_selector(".readings dd")
    names, texts = (page.locator(f".readings {part}").all_inner_texts() for part in ("dt", "dd"))
    return dict(zip(names, texts, strict=True))


def metres(text: str) -> float:
    """A length in m of its text."""
    return float(parse(text, "length", "length"))


def value(page: Any, name: str) -> str:
    """Text of an entry of the profile."""
    return str(page.input_value(f'input[data-measured="{name}"]'))


def moved(page: Any, name: str, before: float) -> float:
    """Wait until an entry of the profile no longer holds a length, and by how much it changed."""
    page.wait_for_function(
        """([name, before]) => Math.abs(
        parseFloat(document.querySelector(`[data-measured=${name}]`).value) - before) > 1e-4""",
        arg=[name, before * 1e6],
    )
    return metres(value(page, name)) - before


def title(page: Any, key: str, text: str) -> None:
    """Wait until the title of a picture begins so."""
    page.wait_for_function(
        """([key, text]) => document.querySelector(`[data-measure="${key}"] .js-plotly-plot`)
        ?.layout.title.text.startsWith(text)""",
        arg=[key, text],
    )


def until(page: Any, name: str, text: str) -> None:
    """Wait until a reading is that."""
    page.wait_for_function(
        """([name, text]) => [...document.querySelectorAll(".readings dl > div")].some((pair) =>
        pair.querySelector("dt").innerText === name && pair.querySelector("dd").innerText === text)""",
        arg=[name, text],
    )


def use(page: Any, tool: str) -> None:
    """Let the mouse do what ``tool`` is for, and wait until it does."""
    page.click(f'[data-tool="{tool}"]')
    page.wait_for_selector(f'[data-tool="{tool}"][aria-pressed=true]')
    page.wait_for_timeout(300)


@pytest.mark.slow
def test_a_profile_with_cursors_on_an_inclined_plane(page: Any, plane: Path, tmp_path: Path) -> None:
    """Slope and angle are those of the plane whatever the direction, at the full resolution of a
    surface that the map thins out; ends and cursors move by mouse, keyboard and numbers."""
    surface_with(page, plane)
    go(page, "prepare")
    for left in ("2. fill", "1. fill"):
        page.click(".item button[aria-label=remove] >> nth=0")
        page.wait_for_selector(f"text={left}", state="detached")
    page.wait_for_selector("text=every 3th point")
    go(page, "surface")
    page.wait_for_selector("text=every 3th point")
    use(page, "line")
    found = readings(page)
    angle = math.degrees(math.atan(SLOPE))
    assert found["angle"] == f"{angle:.4g}°"
    page.wait_for_selector("text=/99\\d points at the full resolution/")  # 90 % of 1100, not of 367

    drag(page, "map-surface", (0.2, 0.3), (0.7, 0.9))  # another line, oblique
    until(page, "angle", f"{math.degrees(math.atan(SLOPE * 0.5 / math.hypot(0.5, 0.6))):.4g}°")
    pixel = SIDE / corners(page, "map-surface")["width"]
    assert abs(metres(value(page, "x0")) - 2e-6) <= pixel + SIDE / POINTS
    assert abs(metres(value(page, "y1")) - 9e-6) <= pixel + SIDE / POINTS
    page.focus('[data-part="end-2"]')
    before = metres(value(page, "x1"))
    page.keyboard.press("ArrowRight")
    assert moved(page, "x1", before) == pytest.approx(SIDE / POINTS, abs=2e-10)  # five digits are shown
    for name, text in (("x0", "1 um"), ("y0", "5 um"), ("x1", "9 um"), ("y1", "5 um")):
        page.fill(f'input[data-measured="{name}"]', text)
        page.wait_for_timeout(500)
    until(page, "angle", f"{angle:.4g}°")

    for name, text in (("a", "1 um"), ("b", "5 um")):
        page.fill(f'input[data-measured="{name}"]', text)
        page.wait_for_timeout(500)
    page.wait_for_function("Math.abs(parseFloat(document.querySelector('[data-measured=b]').value) - 5) < 0.01")
    found = readings(page)
    assert metres(found["Δx"]) == pytest.approx(4e-6, abs=1.01 * SIDE / POINTS)
    assert metres(found["Δz"]) == pytest.approx(SLOPE * metres(found["Δx"]), rel=1e-3)  # four digits are shown
    assert metres(found["height at B"]) - metres(found["height at A"]) == pytest.approx(metres(found["Δz"]), rel=2e-3)
    place = metres(value(page, "b"))
    page.locator('[data-part="cursor-1"]').press("Shift+ArrowLeft")
    assert -moved(page, "b", place) == pytest.approx(10.0 * SIDE / POINTS, rel=0.01)
    drag(page, "curve-surface", (metres(value(page, "b")) / 8e-6, 0.5), (0.95, 0.5))
    page.wait_for_function("parseFloat(document.querySelector('[data-measured=b]').value) > 7.4")

    with page.expect_download() as download:
        page.click('[aria-label="download the profile as CSV"]')
    download.value.save_as(tmp_path / "profile.csv")
    table = np.loadtxt(tmp_path / "profile.csv", delimiter=",", skiprows=1)
    np.testing.assert_allclose(table[:, 3], SLOPE * table[:, 1], rtol=1e-9)
    page.click('[aria-label="remove the profile"]')
    page.wait_for_selector(".profile", state="hidden")


def missing(page: Any) -> int:
    """How many points are missing, as the page says."""
    found = re.search(r"(\d+) points missing", page.inner_text(".numbers >> nth=0"))
    return int(found[1]) if found else 0


@pytest.mark.slow
def test_regions_are_masked_with_the_mouse(page: Any) -> None:
    """Three shapes become one step of the document; one of them is removed on the map, undone, and
    what would mask everything is refused."""
    go(page, "surface")
    page.wait_for_selector(".measured .js-plotly-plot", timeout=LONG)
    use(page, "rectangle")
    drag(page, "map-surface", (0.6, 0.6), (0.8, 0.9))
    page.wait_for_selector("[data-region='rectangle 1']")
    page.wait_for_selector("text=points missing")
    pixel = 1.0 / corners(page, "map-surface")["width"]
    assert missing(page) / 256**2 == pytest.approx(0.06, abs=0.5 * (pixel + 1.0 / 256) * 2.0)
    use(page, "ellipse")
    drag(page, "map-surface", (0.1, 0.1), (0.4, 0.4))
    page.wait_for_selector("[data-region='ellipse 2']")
    use(page, "polygon")
    box = corners(page, "map-surface")
    for x, y in ((0.1, 0.6), (0.4, 0.6), (0.25, 0.9)):
        page.mouse.click(box["x"] + x * box["width"], box["y"] + (1.0 - y) * box["height"])
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-region='polygon 3']")
    use(page, "freehand")
    box = corners(page, "map-surface")
    page.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + 0.7 * box["height"])
    page.mouse.down()
    for turn in np.linspace(0.0, 2.0 * np.pi, 90):
        x, y = 0.6 + 0.1 * math.cos(turn), 0.7 + 0.1 * math.sin(turn)
        page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
    page.mouse.up()
    page.wait_for_selector("[data-region='polygon 4']")
    (mask,) = document(page)["surface"]["prepare"]
    assert [region["kind"] for region in mask["regions"]] == ["rectangle", "ellipse", "polygon", "polygon"]
    assert 15 < len(mask["regions"][3]["x"]) < 60  # of 90
    centre = [metres(text) for text in mask["regions"][1]["centre"]]
    assert centre == pytest.approx([2.5e-6, 2.5e-6], abs=10e-6 * pixel)

    page.locator('[aria-label="remove ellipse 2 from the mask"]').press("Enter")
    page.wait_for_selector("[data-region='polygon 4']", state="detached")
    assert len(document(page)["surface"]["prepare"][0]["regions"]) == 3
    page.click("button[aria-label=undo]")
    page.wait_for_selector("[data-region='polygon 4']", timeout=LONG)
    assert len(document(page)["surface"]["prepare"][0]["regions"]) == 4

    go(page, "prepare")  # the same in the form, with what fills it
    page.wait_for_selector("text=4. polygon")
    page.click('[data-add="fill"]')
    page.wait_for_function("!document.querySelector('.numbers')?.innerText.includes('missing')")
    page.click(".step-head:has-text('1. mask')")
    page.wait_for_selector("text=/\\d+ points become missing/")
    page.click(".step-head:has-text('2. fill')")
    page.wait_for_selector("text=/\\d+ missing points are filled/")
    fill(page, "surface.prepare.0.regions.2.x", "0 um, 10 um, 10 um, 0 um")
    fill(page, "surface.prepare.0.regions.2.y", "0 um, 0 um, 10 um, 10 um")
    page.wait_for_selector("[role=alert]:has-text('65536')")


@pytest.mark.slow
def test_what_a_step_removes_is_shown_live(page: Any) -> None:
    """Before, after and their difference of the step that is pressed; cut-offs are bars of their
    length on the map, and rms heights add up as the maps do."""
    go(page, "prepare")
    page.wait_for_selector(".measured .js-plotly-plot", timeout=LONG)
    page.click('[data-add="level"]')
    page.click('[data-add="filter"]')
    fill(page, "surface.prepare.1.short", "0.3 um")
    fill(page, "surface.prepare.1.long", "3 um")
    page.click(".step-head:has-text('2. filter')")
    page.wait_for_selector("text=After step 2 of 2: filter")
    page.wait_for_selector("text=Before step 2 of 2: filter")
    assert page.get_attribute(".step-head:has-text('2. filter')", "aria-pressed") == "true"
    page.wait_for_selector(".measure-bar")
    lengths = page.eval_on_selector_all(
        "[data-measure=map-after] .measure-bar",
        "bars => bars.map(bar => [Number(bar.dataset.length), Number(bar.dataset.pixels)])",
    )
    width = corners(page, "map-after")["width"]
    assert sorted(length for length, _ in lengths) == [0.3e-6, 3e-6]
    for length, pixels in lengths:
        assert pixels == pytest.approx(length / 10e-6 * width, rel=1e-6)
    values = {}
    begins = {"Before": "Before step 2", "After": "After step 2", "What it removes": "What step 2 of 2 removes"}
    for what, text in begins.items():
        page.click(f'[data-toggle="map-after"] >> text={what}')
        title(page, "map-after", text)
        values[what] = page.evaluate(
            """() => { const plot = document.querySelector("[data-measure=map-after] .js-plotly-plot");
            const trace = plot._fullData[0], unit = { nm: 1, pm: 1e-3 }[trace.colorbar.title.text];
            return [...trace.z].map((row) => [...row].map((value) => value * unit)); }"""
        )
    before, after, removed = (np.array(values[what]) for what in ("Before", "After", "What it removes"))
    single = 4.0 * np.finfo(np.float32).eps * np.abs(before).max()
    np.testing.assert_allclose(removed, before - after, rtol=0.0, atol=single)
    rms = float(np.sqrt(np.mean((removed - removed.mean()) ** 2)))
    said = page.inner_text("[data-removed] >> nth=0")
    shown = re.search(r"Removed: rms (\S+) (\S+),", said)
    assert shown is not None, said
    assert metres(f"{shown[1]} {shown[2]}") == pytest.approx(rms * 1e-9, rel=1e-3)  # four digits are shown

    fill(page, "surface.prepare.1.long", "2 um")  # it follows every change
    page.wait_for_selector("text=long cut-off 2 µm")
    page.wait_for_function("said => document.querySelector('[data-removed]').innerText !== said", arg=said)
    page.click("text=Look at all steps together")
    title(page, "map-after", "What all steps remove")


@pytest.mark.slow
def test_a_line_scan_has_its_cursors_on_the_curve(page: Any, tmp_path: Path) -> None:
    x = 0.5 * np.arange(1200)
    np.savetxt(tmp_path / "trace.txt", np.c_[x, 20.0 + 0.1 * x])
    page.goto(start_of(page))
    page.click("text=Begin")
    base_of(page)
    put(page, tmp_path / "trace.txt")
    page.wait_for_selector('input[data-key="surface.lateral_unit"]', timeout=LONG)
    fill(page, "surface.lateral_unit", "um")
    fill(page, "surface.height_unit", "nm")
    page.wait_for_selector(".measured[data-kind=curve] .js-plotly-plot", timeout=LONG)
    go(page, "prepare")
    page.click(".item button[aria-label=remove] >> nth=0")  # the line that is levelled
    page.wait_for_selector("text=2. fill", state="detached")
    go(page, "surface")
    page.wait_for_selector(".measured[data-kind=curve] .js-plotly-plot", timeout=LONG)
    use(page, "line")
    found = readings(page)
    assert metres(found["Δz"]) == pytest.approx(1e-4 * metres(found["Δx"]), rel=2e-3)
    before = metres(value(page, "a"))
    page.locator('[data-measure="map-surface"] [data-part="cursor-0"]').press("ArrowRight")
    assert moved(page, "a", before) == pytest.approx(0.5e-6, rel=0.05)
    use(page, "range")
    drag(page, "map-surface", (0.4, 0.5), (0.6, 0.5))
    page.wait_for_selector("[data-region='rectangle 1']")
    mask, after = document(page)["surface"]["prepare"]
    assert set(mask["regions"][0]) == {"kind", "x"}
    assert after["step"] == "fill"


@pytest.mark.slow
def test_the_tools_fit_a_small_screen(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = open_page(app.address, viewport={"width": 420, "height": 900}, color_scheme="dark").page
    base_of(page)
    go(page, "surface")
    page.wait_for_selector(".measured .js-plotly-plot", timeout=LONG)
    use(page, "line")
    readings(page)
    use(page, "rectangle")
    drag(page, "map-surface", (0.2, 0.2), (0.5, 0.5))
    page.wait_for_selector("[data-region='rectangle 1']")
    assert page.evaluate("document.documentElement.scrollWidth") <= 420
    names = page.eval_on_selector_all(".map-tools button", "all => all.map(one => one.getAttribute('aria-label'))")
    assert all(names)
