"""The page of a result in a real browser: what it shows is what was stored, by mouse, touch and
keyboard, and nothing is fetched."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.report.scene import decoded, scene_of
from asperity.run.execute import Outcome

from .colours import contrast
from .expecting import expect

DOCUMENT = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [48, 32],
        "size": "1.2 um x 0.64 um",
        "seed": 3,
        "spectrum": {"kind": "gaussian", "rms_height": "2 nm", "correlation_length": "0.15 um"},
    },
    "body": {
        "layers": [{"material": "DLC", "thickness": "20 nm"}],
        "base": {"material": "steel"},
    },
    "counter_body": {"rigid": True},
    "boundary": {"kind": "periodic"},
    "control": {"path": {"mean_pressure": ["300 MPa", "100 MPa"], "steps": 2}},
    "friction": {"coefficient": 0.3},
    "stress": {"depths": ["5 nm", "20 nm", "60 nm"], "sections": ["y=max"]},
}

PHONE = {"viewport": {"width": 420, "height": 900}, "device_scale_factor": 2.0, "has_touch": True, "is_mobile": True}
FACTORS = {"GPa": 1e9, "MPa": 1e6, "kPa": 1e3, "µm": 1e-6, "nm": 1e-9, "pm": 1e-12}
Open = Callable[..., Any]


@dataclass(frozen=True)
class Report:
    """A page, and what it was made of."""

    file: Path
    outcome: Outcome
    scene: dict[str, Any]

    def map(self, name: str) -> dict[str, Any]:
        found: dict[str, Any] = next(item for item in self.scene["maps"] if item["name"] == name)
        return found

    def values(self, name: str, number: int = 0) -> RealArray:
        return decoded(self.map(name)["arrays"][number])

    @property
    def decisive(self) -> asp.ContactResult:
        """The contact that the page shows at first."""
        return self.outcome.solved.at().result


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Report:
    outcome = asp.run(DOCUMENT)
    path = tmp_path_factory.mktemp("page") / "report.html"
    asp.write_report(outcome, path)
    scene = scene_of(outcome)
    assert scene is not None
    return Report(path, outcome, scene)


def opened(report: Report, open_page: Open, **options: Any) -> Any:
    """The page, once its maps are drawn."""
    page = open_page(report.file, **options).page
    page.wait_for_function("document.querySelector('[data-viewer]').viewer !== undefined")
    page.evaluate("document.querySelector('[data-viewer]').viewer.ready")
    return page


def viewer(page: Any, code: str) -> Any:
    """Value of ``code``, in which v is the viewer, after the next frame."""
    return page.evaluate(
        f"(async () => {{ const v = document.querySelector('[data-viewer]').viewer; const found = await ({code});"
        " await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))); return found; })()"
    )


def panel(page: Any, name: str) -> Any:
    return page.locator(f".av-panel[data-map='{name}']")


def place(page: Any, name: str, x: float, y: float) -> tuple[float, float]:
    """Where x, y (m) of a map lies on the screen."""
    panel(page, name).scroll_into_view_if_needed()
    at = viewer(
        page,
        f"(() => {{ const p = v.panels.find((p) => p.map.name === '{name}'), r = p.canvas.getBoundingClientRect();"
        f" return [r.left + p.axes.px({x}), r.top + p.axes.py({y})]; }})()",
    )
    return float(at[0]), float(at[1])


def shown(text: str) -> tuple[float, float]:
    """SI value of a text such as "1.25 GPa", and what one unit of its last digit is."""
    number, unit = text.split(" ")
    value = float(number.replace("−", "-"))
    decimals = len(number.split(".")[1]) if "." in number else 0
    return value * FACTORS[unit], 10.0**-decimals * FACTORS[unit]


@pytest.mark.parametrize("name", ["heights", "pressure", "gap", "planes"])
def test_the_value_under_the_pointer_is_that_of_the_result(name: str, report: Report, open_page: Open) -> None:
    page, result = opened(report, open_page), report.decisive
    dx, dy = result.problem.grid.spacing
    viewer(page, f"v.show(['{name}'])")
    viewer(page, "v.showLine(false)")  # its ends lie over points
    values = report.values(name)
    if name == "pressure":
        values = np.where(result.contact, result.pressure, np.nan)
    elif name == "gap":
        values = np.where(result.contact, np.nan, result.gap)
    elif name == "heights":
        values = result.problem.surface.heights - result.problem.surface.heights.mean()
    for i, j in ((3, 30), (24, 16), *np.argwhere(np.isfinite(values))[[0, -1]]):
        x, y = place(page, name, (i + 0.5) * dx, (j + 0.5) * dy)
        page.mouse.move(x, y)
        viewer(page, "0")
        text = panel(page, name).locator(".av-value").inner_text()
        if math.isnan(values[i, j]):
            assert text == report.map(name)["blank"]["text"]
        else:
            value, digit = shown(text)
            assert abs(value - values[i, j]) <= 0.61 * digit
        where = panel(page, name).locator(".av-at").inner_text()
        read = [float(found) * 1e-6 for found in re.findall(r"= ([\d.]+) µm", where)]
        assert read == pytest.approx([(i + 0.5) * dx, (j + 0.5) * dy], abs=0.02e-6)


def test_classes_are_named(report: Report, open_page: Open) -> None:
    page, result = opened(report, open_page), report.decisive
    dx, dy = result.problem.grid.spacing
    i, j = np.argwhere(result.contact)[0]
    assert viewer(page, f"v.read({(i + 0.5) * dx}, {(j + 0.5) * dy})")["contact"] == "elastic"
    share = panel(page, "contact").locator("button", has_text="elastic")
    assert f"{100.0 * result.area_fraction:.4g} %" in share.inner_text()
    share.click()
    assert share.get_attribute("aria-pressed") == "true"


def test_zoom_and_pan_are_shared(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    before = limits(page)
    assert before["pressure"] == before["gap"]
    x, y = place(page, "pressure", 0.3e-6, 0.2e-6)
    page.mouse.click(x, y)
    page.mouse.wheel(0, -400)
    viewer(page, "0")
    zoomed = limits(page)
    assert zoomed["pressure"] == zoomed["gap"] == zoomed["heights"] != before["pressure"]
    assert zoomed["pressure"][1] - zoomed["pressure"][0] < 0.6 * (before["pressure"][1] - before["pressure"][0])
    at = place(page, "pressure", 0.3e-6, 0.2e-6)
    assert at == pytest.approx((x, y), abs=1.5), "the point under the pointer stays"
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 40, y, steps=4)
    page.mouse.up()
    viewer(page, "0")
    assert limits(page)["gap"][0] > zoomed["gap"][0]
    page.mouse.dblclick(x, y)
    viewer(page, "0")
    assert limits(page) == before


def limits(page: Any) -> dict[str, list[float]]:
    code = "Object.fromEntries(v.visible.map((p) => [p.map.name, [p.axes.x0, p.axes.x1, p.axes.y0, p.axes.y1]]))"
    found: dict[str, list[float]] = viewer(page, code)
    return found


def test_curves_along_the_section_line_are_interpolated_values(report: Report, open_page: Open) -> None:
    page, result = opened(report, open_page), report.decisive
    (dx, dy), ends = result.problem.grid.spacing, (0.11e-6, 0.07e-6, 0.93e-6, 0.51e-6)
    viewer(page, f"v.setLine({', '.join(map(str, ends))})")
    first = report.scene["steps"]["first"]
    for name, values in (("pressure", result.pressure), ("gap", result.gap)):
        found = np.array(viewer(page, f"Array.from(v.curves.find((c) => c.panel.map.name === '{name}').values)"))
        t = np.linspace(0.0, 1.0, found.size)
        u = (ends[0] + t * (ends[2] - ends[0])) / dx - 0.5
        w = (ends[1] + t * (ends[3] - ends[1])) / dy - 0.5
        np.testing.assert_allclose(found, bilinear(values, u, w), atol=0.51 * report.map(name)["arrays"][first]["step"])


def bilinear(values: RealArray, u: RealArray, w: RealArray) -> RealArray:
    i, j = np.floor(u).astype(int), np.floor(w).astype(int)
    a, b = u - i, w - j
    low = (1 - a) * values[i, j] + a * values[i + 1, j]
    return np.asarray((1 - b) * low + b * ((1 - a) * values[i, j + 1] + a * values[i + 1, j + 1]))


def test_the_section_line_moves_by_mouse_and_keyboard(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    start = viewer(page, "[...v.line]")
    handle = panel(page, "heights").locator(".av-handle").first
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    page.mouse.move(box["x"] + 13, box["y"] + 13)
    page.mouse.down()
    page.mouse.move(box["x"] + 60, box["y"] + 13, steps=3)
    page.mouse.up()
    moved = viewer(page, "[...v.line]")
    assert moved[0] > start[0] + 0.05e-6
    assert moved[2:] == start[2:]
    handle.press("ArrowRight")
    assert viewer(page, "v.line[0]") == pytest.approx(moved[0] + 25e-9, rel=1e-9)
    assert "x =" in handle.get_attribute("aria-valuetext")
    page.get_by_label("Section line", exact=False).first.focus()
    page.locator(".av-place input").nth(0).fill("0.2")
    page.keyboard.press("Enter")
    assert viewer(page, "v.line[0]") == pytest.approx(0.2e-6)


def test_the_sliders_change_step_and_depth(report: Report, open_page: Open) -> None:
    page, path = opened(report, open_page), report.outcome.path
    assert path is not None
    slider = page.locator("[data-slider='steps'] input")
    assert slider.get_attribute("aria-valuetext").startswith(f"{path.peak + 1} of {len(path.steps)}")
    dx, dy = path.last.problem.grid.spacing
    for number in (0, 1):
        slider.fill(str(number))
        slider.dispatch_event("input")
        viewer(page, f"v.set('steps', {number})")
        i, j = np.unravel_index(np.argmax(path.steps[number].pressure), path.last.pressure.shape)
        value, digit = shown(viewer(page, f"v.read({(i + 0.5) * dx}, {(j + 0.5) * dy})")["pressure"])
        assert abs(value - path.steps[number].pressure[i, j]) <= 0.61 * digit
    slider.press("ArrowRight")
    assert viewer(page, "v.position.steps") == 2
    viewer(page, f"v.set('steps', {path.peak})")
    viewer(page, "v.show(['planes'])")
    for number in (0, 3):
        viewer(page, f"v.set('depths', {number})")
        value, digit = shown(viewer(page, f"v.read({5.5 * dx}, {7.5 * dy})")["planes"])
        assert abs(value - report.values("planes", number)[5, 7]) <= 0.61 * digit


def test_stresses_belong_to_one_step_and_leave_with_it(report: Report, open_page: Open) -> None:
    page, path = opened(report, open_page), report.outcome.path
    assert path is not None
    first = report.scene["steps"]["first"]
    assert (first, report.scene["steps"]["numbers"][first]) == (path.peak, path.peak + 1)
    viewer(page, "v.show(['heights', 'pressure', 'planes'])")
    of_one = page.locator(".av-panel:has(.av-step)")
    assert of_one.count() == len(report.scene["sections"]) + 2, "sections, planes, and what is below the line"
    for number in range(of_one.count()):
        assert of_one.nth(number).locator("canvas").first.is_visible()
        assert f"step {path.peak + 1} of {len(path.steps)}:" in of_one.nth(number).locator(".av-step").inner_text()
    assert panel(page, "pressure").locator(".av-step").count() == 0
    viewer(page, f"v.set('steps', {len(path.steps) - 1})")
    expect(page.locator(".av-panel:has(.av-step) canvas:visible")).to_have_count(0)
    assert panel(page, "heights").locator("canvas").first.is_visible()
    assert panel(page, "pressure").locator("canvas").first.is_visible()
    assert "planes" not in viewer(page, "v.read(0.5e-6, 0.3e-6)")
    panel(page, "planes").get_by_role("button", name=f"show step {path.peak + 1}").click()
    viewer(page, "0")
    assert viewer(page, "v.position.steps") == first
    assert panel(page, "planes").locator("canvas").first.is_visible()


def test_in_a_small_page_the_decisive_step_has_all_its_points(
    report: Report, open_page: Open, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = sum(len(array["data"]) for item in report.scene["maps"] for array in item["arrays"])
    monkeypatch.setattr("asperity.report.write.scene_of", partial(scene_of, budget=int(0.75 * whole)))
    asp.write_report(report.outcome, tmp_path / "small.html")
    page = opened(replace(report, file=tmp_path / "small.html"), open_page)
    code = "v.visible.map((p) => [p.map.name, p.raster.cell[0] / v.cell[0]])"
    assert dict(viewer(page, code)) == dict.fromkeys(("heights", "pressure", "contact", "gap"), 1.0)
    viewer(page, "v.set('steps', 0)")
    coarse = dict(viewer(page, code))
    assert coarse["heights"] == 1.0
    assert max(coarse.values()) > 1.0
    step = report.scene["steps"]["numbers"][report.scene["steps"]["first"]]
    assert f"in all steps but step {step}" in page.locator(".av-note").last.inner_text()


def test_words_and_pictures_name_their_step(report: Report, open_page: Open) -> None:
    page, solved = opened(report, open_page), report.outcome.solved
    where = solved.at().where
    page.emulate_media(media="print")
    for name in ("stress", "yielding"):
        assert where in page.locator(f"h2#{name}").inner_text()
    for title in ("Pressure", "Gap", "Section"):
        figure = page.locator("figure", has=page.locator("h3", has_text=re.compile(f"^{title}$")))
        assert where in figure.locator("figcaption").inner_text()
    captions = page.locator("section[aria-labelledby=stress] figcaption").all_inner_texts()
    assert len(captions) > 3
    assert all(where in text for text in captions)


def test_a_map_is_read_and_zoomed_with_the_keyboard(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    canvas = panel(page, "pressure").locator("canvas").first
    assert "Contact pressure" in canvas.get_attribute("aria-label")
    canvas.press("ArrowRight")
    viewer(page, "0")
    expect(page.locator(".av-live")).to_have_text(re.compile("^Pressure: "))
    page.keyboard.press("+")
    assert viewer(page, "v.zoom") == pytest.approx(1.5)
    left = viewer(page, "v.centre[0]")
    page.keyboard.press("Shift+ArrowRight")
    assert viewer(page, "v.centre[0]") > left
    page.keyboard.press("0")
    assert viewer(page, "v.zoom") == 1.0


def test_a_contact_spot_is_marked_as_measured(report: Report, open_page: Open) -> None:
    page, result = opened(report, open_page), report.decisive
    dx, dy = result.problem.grid.spacing
    i, j = np.unravel_index(np.argmax(result.pressure), result.pressure.shape)
    code = (
        f"(() => {{ const m = v.highlight({{ x: {(i + 0.5) * dx}, y: {(j + 0.5) * dy} }}); return [m.area, "
        f"m.largest]; }})()"
    )
    area, largest = viewer(page, code)
    assert np.isclose(area, result.spot_areas, rtol=1e-9).any()
    assert largest == pytest.approx(result.max_pressure, rel=1e-4)
    page.mouse.click(*place(page, "pressure", (i + 0.5) * dx, (j + 0.5) * dy))
    expect(page.locator(".av-live")).to_contain_text("area")


def test_colours_follow_range_and_scale(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    at = panel(page, "pressure")
    at.get_by_label("logarithmic").check()
    assert viewer(page, "v.panels.find((p) => p.map.name === 'pressure').colours.log") is True
    at.locator("input[type=text]").last.fill("0.5")
    page.keyboard.press("Enter")
    unit = report.map("pressure")["unit"]["factor"]
    assert viewer(page, "v.panels.find((p) => p.map.name === 'pressure').colours.high") == pytest.approx(0.5 * unit)
    at.get_by_role("button", name="whole range").click()
    assert viewer(page, "v.panels.find((p) => p.map.name === 'pressure').colours.high") == pytest.approx(
        report.map("pressure")["range"][1]
    )


def test_stresses_below_have_their_layers(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    below = page.locator(".av-below").first
    below.scroll_into_view_if_needed()
    box = below.locator("canvas").first.bounding_box()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.4 * box["height"])
    assert re.search(r"[MG]Pa at x = [\d.]+ µm, depth [\d.]+ nm", below.locator(".av-value").inner_text())
    section = report.scene["sections"][0]
    assert [layer["text"] for layer in section["layers"]] == ["DLC", "steel"]
    assert section["interfaces"] == [{"depth": pytest.approx(20e-9)}]
    point = viewer(
        page, f"v.belows[0].value({section['start']} + 10.5 * {section['array']['cell'][0]}, {section['depths'][2]})"
    )
    assert point == pytest.approx(decoded(section["array"])[10, 2], rel=1e-6)


def test_curves_of_pictures_have_their_values(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    figure = page.locator("figure[data-curves]", has_text="Load against approach")
    image = figure.locator("img")
    image.focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    path = report.outcome.path
    assert path is not None
    text = figure.locator(".av-tip").inner_text()
    approach, pressure = (float(found) for found in re.findall(r"([\d.]+) (?:nm|MPa)", text))
    assert text.startswith("loading")
    assert approach == pytest.approx(path.steps[1].approach * 1e9, rel=1e-3)
    assert pressure == pytest.approx(path.steps[1].mean_pressure * 1e-6, rel=1e-3)
    box = image.bounding_box()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    page.keyboard.press("Escape")


def pictures(page: Any) -> set[str]:
    found = page.eval_on_selector_all(
        "figure", "all => all.filter(f => f.offsetHeight > 0).map(f => f.querySelector('h3').textContent)"
    )
    return set(found)


def test_without_scripts_all_is_pictures(report: Report, open_page: Open) -> None:
    with_scripts = opened(report, open_page)
    assert "Pressure" not in pictures(with_scripts)
    without = open_page(report.file, java_script_enabled=False).page
    assert without.locator("figure:visible").count() == without.locator("figure").count()
    assert without.get_by_role("img", name=re.compile("^Pressure. Contact pressure")).is_visible()
    assert without.locator("[data-viewer]").inner_text().strip() == ""


def test_print_shows_the_pictures(report: Report, open_page: Open) -> None:
    page = opened(report, open_page)
    page.emulate_media(media="print", color_scheme="dark")
    assert {"Heights", "Pressure", "Contact", "Gap", "Section"} <= pictures(page)
    expect(page.locator(".av-maps")).not_to_be_visible()
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"


def test_a_phone_scrolls_one_way_and_reads_by_touch(report: Report, open_page: Open) -> None:
    page = opened(report, open_page, **PHONE)
    assert page.evaluate("document.documentElement.scrollWidth") <= 420
    x, y = place(page, "heights", 0.5e-6, 0.3e-6)
    page.touchscreen.tap(x, y)
    viewer(page, "0")
    assert re.fullmatch(r"−?[\d.]+ nm", panel(page, "heights").locator(".av-value").inner_text())


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_is_readable_in_both_schemes(scheme: str, report: Report, open_page: Open) -> None:
    page = opened(report, open_page, color_scheme=scheme)
    background = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, re.findall(r"\d+", background))) < 200) == (scheme == "dark")
    code = """all => all.filter(e => e.offsetHeight &&
        [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim())).map(e => {
        const clear = b => ["rgba(0, 0, 0, 0)", "transparent"].includes(getComputedStyle(b).backgroundColor);
        let b = e; while (b && clear(b)) b = b.parentElement;
        const behind = b ? getComputedStyle(b).backgroundColor : "rgb(255, 255, 255)";
        return [getComputedStyle(e).color, behind, e.outerHTML.slice(0, 80)]; })"""
    pairs = page.eval_on_selector_all("body *:not(script):not(canvas)", code)
    poor = {text for colour, behind, text in pairs if contrast(colour, behind) < 4.5}
    assert poor == set()
    look = viewer(page, "v.look")
    for name in ("soft", "ink", "accent"):
        red, green, blue = (int(look[name][k : k + 2], 16) for k in (1, 3, 5))
        assert contrast(f"rgb({red}, {green}, {blue})", background) >= 4.5


@pytest.fixture
def damaged(report: Report, tmp_path: Path) -> Path:
    """The page with its script altered, which its policy then forbids."""
    text = report.file.read_text(encoding="utf-8").replace('"use strict";', '"use strict"; window.altered = true;', 1)
    path = tmp_path / "altered.html"
    path.write_text(text, encoding="utf-8")
    return path


def test_an_altered_script_does_not_run(damaged: Path, browser: Any) -> None:
    context = browser.new_context()
    page = context.new_page()
    page.goto(damaged.as_uri())
    assert page.evaluate("window.altered") is None
    assert "Pressure" in pictures(page)
    context.close()
