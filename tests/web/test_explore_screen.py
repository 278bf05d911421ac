"""The page Explore as one screen, and two runs beside one another: what they share, and what
differs."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.arrays import RealArray

from .app_server import AppServer
from .expecting import expect
from .explored import LONG, RUNS, keys, solved_in

Open = Callable[..., Any]
SCREEN = {"viewport": {"width": 1400, "height": 900}}
SUBTRACTED = "document.querySelector('[data-difference-map] [data-of]').viewer"
SETTLED = 1500
"""Time in ms after which neither scrolling nor a step goes on."""


@pytest.fixture(scope="module")
def kept(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return solved_in(browser, tmp_path_factory.mktemp("explored"))


@pytest.fixture(scope="module")
def app(kept: Path) -> Iterator[AppServer]:
    with AppServer(("--threads", "1", "--folder", str(kept))) as running:
        yield running


def explored(app: AppServer, open_page: Open, *runs: int, **options: Any) -> Any:
    """The page with these runs, the first large."""
    page = open_page(app.address, **(SCREEN | options)).page
    page.wait_for_url("**/s/**")
    names = keys(Path(app.arguments[-1]))
    chosen = "&beside=".join(names[run] for run in runs)
    page.goto(f"{page.url.rsplit('/', 1)[0]}/explore?run={chosen}")
    page.wait_for_function(f"document.querySelectorAll('[data-ready]').length === {len(runs)}", timeout=LONG)
    page.wait_for_function(  # planes in the body come last, after which the maps are drawn once more
        "[...document.querySelectorAll('[data-scene]')].every(({ viewer }) => viewer.panels.every((p) => p.raster) &&"
        " viewer.panels.some((p) => p.map.name === 'planes'))",
        timeout=LONG,
    )
    page.wait_for_timeout(300)
    return page


def of(page: Any, code: str, number: int = 0) -> Any:
    """Value of ``code``, in which v is the viewer of run ``number``, after two frames."""
    viewer = f"document.querySelectorAll('[data-scene]')[{number}].viewer"
    frames = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
    return page.evaluate(
        f"(async () => {{ const v = {viewer}; const found = {code}; await {frames}; return found; }})()"
    )


def values_of(page: Any, name: str, number: int, step: int = 0) -> RealArray:
    """Map ``name`` of run ``number`` as it was stored (nx, ny)."""
    code = (
        f"await (async () => {{ const map = v.scene.maps.find((m) => m.name === '{name}'), array = map.arrays[{step}];"
        " const r = await v.raster(array, map); return { shape: [r.nx, r.ny], low: r.low, step: r.step,"
        " masked: r.masked, numbers: [...r.levels[0].q] }; })()"
    )
    found = of(page, code, number)
    numbers = np.array(found["numbers"]).reshape(found["shape"][::-1]).T
    return np.where(numbers == found["masked"], np.nan, found["low"] + found["step"] * numbers)


@pytest.mark.slow
def test_the_whole_page_is_one_screen_and_small_maps_are_live(app: AppServer, open_page: Open) -> None:
    page = explored(app, open_page, 0)
    assert page.evaluate("scrollY") == 0
    seen = [".verdicts", ".headline", "[data-slider=steps]", ".av-row", ".av-panel canvas", ".av-curve canvas"]
    for name in (*seen, ".av-below canvas"):
        box = page.locator(f"{name}:visible").first.bounding_box()
        assert box["y"] > 0, name
        assert box["y"] + box["height"] <= 900, name
    large = page.locator(".av-panel:not(.av-below) canvas:visible").first.bounding_box()
    thumbs = page.locator("[data-thumb]")
    assert thumbs.count() == of(page, "v.panels.length")
    expect(page.locator(".av-panel:not(.av-below):visible")).to_have_count(1)
    assert all(large["width"] > 3 * thumb.bounding_box()["width"] for thumb in thumbs.all())
    row = page.locator(".av-row").bounding_box()
    section = page.locator(".av-curve:visible").bounding_box()
    assert section["y"] >= row["y"] + row["height"]

    picture = "(t) => t.querySelector('canvas').toDataURL()"
    before = {name: page.locator(f"[data-thumb={name}]").evaluate(picture) for name in ("pressure", "gap", "heights")}
    slider = page.locator("[data-slider=steps] input")
    slider.press("ArrowLeft")
    page.wait_for_timeout(SETTLED)
    after = {name: page.locator(f"[data-thumb={name}]").evaluate(picture) for name in before}
    assert [name for name in before if before[name] != after[name]] == ["pressure", "gap"]

    gap = page.locator("[data-thumb=gap]")
    gap.press("Enter")
    page.wait_for_selector(".av-panel[data-map=gap]:visible")
    expect(page.locator(".av-panel:not(.av-below):visible")).to_have_count(1)
    page.wait_for_selector("[data-thumb='gap']:focus")
    assert gap.get_attribute("aria-pressed") == "true"
    expect(page.locator("[data-thumb=pressure]")).to_have_attribute("aria-pressed", "false")
    expect(page.locator("[data-curve=gap]")).to_be_visible()

    canvas = page.locator(".av-panel[data-map=gap] canvas").first.bounding_box()
    page.mouse.move(canvas["x"] + 0.5 * canvas["width"], canvas["y"] + 0.4 * canvas["height"])
    x, y = of(page, "v.cursor")
    for name in ("heights", "pressure"):
        expected = of(page, f"v.panels.find((p) => p.map.name === '{name}').text({x!r}, {y!r})")
        assert expected != ""
        expect(page.locator(f"[data-thumb={name}] .av-thumb-value")).to_have_text(expected)


@pytest.mark.slow
def test_sentences_and_tables_are_folded_until_they_are_opened(app: AppServer, open_page: Open) -> None:
    page = explored(app, open_page, 0)
    line = page.locator("[data-verdict=Result]")
    assert line.evaluate("e => e.scrollWidth > e.clientWidth"), "cut at the end of the line"
    expect(page.locator("[data-remedy]:visible, [data-choose]:visible, td:visible, .downloads:visible")).to_have_count(
        0
    )
    page.locator("[data-verdicts] summary").press("Enter")
    assert not line.evaluate("e => e.scrollWidth > e.clientWidth")


@pytest.mark.slow
def test_a_phone_has_one_column(app: AppServer, open_page: Open) -> None:
    for runs in ((0,), (0, 1)):
        page = explored(app, open_page, *runs, viewport={"width": 420, "height": 900})
        if len(runs) > 1:
            page.click("[data-subtract]")
            page.wait_for_selector("[data-difference-map] canvas")
        assert page.evaluate("document.documentElement.scrollWidth") <= 420
        page.wait_for_timeout(SETTLED)
        left, side = page.evaluate(
            "['.av-maps', '.av-side'].map((s) => document.querySelector(s).getBoundingClientRect().toJSON())"
        )
        assert side["top"] >= left["bottom"]
        assert left["width"] > 350


@pytest.mark.slow
def test_two_runs_share_colours_step_map_cross_and_view(app: AppServer, open_page: Open) -> None:
    page = explored(app, open_page, 0, 1)
    colours = "(() => { const c = v.panels.find((p) => p.map.name === 'pressure').colours; return [c.low, c.high]; })()"
    whole = "v.panels.find((p) => p.map.name === 'pressure').map.range"
    ranges = [of(page, whole, number) for number in (0, 1)]
    assert ranges[0] != ranges[1]
    shared = [min(low for low, _ in ranges), max(high for _, high in ranges)]
    assert of(page, colours, 0) == of(page, colours, 1) == shared
    page.locator("[data-together] input[name=colours]").uncheck()
    assert [of(page, colours, number) for number in (0, 1)] == ranges
    page.locator("[data-together] input[name=colours]").check()
    assert of(page, colours, 0) == of(page, colours, 1) == shared
    page.locator(".av-range input:visible").nth(1).fill("1")
    page.keyboard.press("Enter")
    assert of(page, colours, 0) == of(page, colours, 1) == [shared[0], 1e9]

    slider = page.locator("[data-slider=steps] input").first
    slider.press("Home")
    page.keyboard.press("ArrowRight")
    assert (of(page, "v.position.steps", 0), of(page, "v.position.steps", 1)) == (1, 1)
    page.locator("[data-together] input[name=steps]").uncheck()
    page.locator("[data-slider=steps] input").nth(1).press("ArrowRight")
    assert (of(page, "v.position.steps", 0), of(page, "v.position.steps", 1)) == (1, 2)
    page.locator("[data-together] input[name=steps]").check()
    assert (of(page, "v.position.steps", 0), of(page, "v.position.steps", 1)) == (1, 1)

    page.locator("[data-scene] >> nth=1").locator("[data-thumb=heights]").click()
    expect(page.locator(".av-panel[data-map=heights]:visible")).to_have_count(2)
    first = page.locator(".av-panel[data-map=heights] canvas").first
    first.scroll_into_view_if_needed()
    canvas = first.bounding_box()
    page.mouse.move(canvas["x"] + 0.6 * canvas["width"], canvas["y"] + 0.3 * canvas["height"])
    assert of(page, "v.cursor", 0) == pytest.approx(of(page, "v.cursor", 1), rel=1e-12)
    texts = page.locator(".av-panel[data-map=heights] .av-value").all_inner_texts()
    said = page.locator("[data-both]").inner_text()
    assert all(re.fullmatch(r"−?[\d.]+ nm", text) and text in said for text in texts)
    values = [float(text.split(" ")[0].replace("−", "-")) for text in texts]
    less = re.search(r"difference (−?[\d.]+) nm", said)
    assert less is not None
    assert float(less[1].replace("−", "-")) == pytest.approx(
        values[0] - values[1], abs=0.016
    )  # three roundings to 0.01
    page.mouse.move(5, 500)
    expect(page.locator("[data-both]")).to_have_text("")

    of(page, "v.zoomBy(2.0, 0.5e-6, 0.5e-6)", 1)
    assert of(page, "v.zoom", 0) == 2.0
    assert of(page, "v.centre", 0) == pytest.approx(of(page, "v.centre", 1))
    of(page, "v.setLine(0.1e-6, 0.2e-6, 1.5e-6, 1.6e-6)", 0)
    assert of(page, "v.line", 1) == pytest.approx([0.1e-6, 0.2e-6, 1.5e-6, 1.6e-6])


def averaged(values: RealArray, count: int) -> RealArray:
    """Mean of ``values`` over the area of each of ``count`` × ``count`` points of the same size."""
    n = values.shape[0]
    share = np.zeros((count, n))
    for k in range(count):
        for i in range(n):
            share[k, i] = max(0.0, min((k + 1) / count, (i + 1) / n) - max(k / count, i / n)) * count
    return np.asarray(share @ values @ share.T)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["heights", "pressure"])
def test_a_map_of_the_difference_and_its_size_in_words(name: str, app: AppServer, open_page: Open) -> None:
    page = explored(app, open_page, 0, 1)
    page.click(f"[data-thumb={name}] >> nth=0")
    page.click("[data-subtract]")
    page.wait_for_selector(f"[data-difference-map] [data-of={name}]")
    step = of(page, "v.position.steps", 0)
    along = step if name == "pressure" else 0
    fine, coarse = (np.nan_to_num(values_of(page, name, number, along)) for number in (0, 1))
    expected = averaged(fine, RUNS[1]["points"]) - coarse
    array, limits = page.evaluate(
        f"(() => {{ const p = {SUBTRACTED}.panels[0], r = p.raster;"
        " return [Array.from(r.levels[0].q, (q) => r.low + r.step * q), [p.colours.low, p.colours.high]]; })()"
    )
    known = np.abs(expected).max()
    np.testing.assert_allclose(np.reshape(array, expected.shape).T, expected, rtol=0.0, atol=2e-5 * known)
    assert limits[0] == -limits[1] == pytest.approx(-known, rel=1e-4)
    middle = page.evaluate(
        f"(() => {{ const c = {SUBTRACTED}.panels[0].colours;"
        " const p = c.colour(c.share(0)); return [p & 255, (p >> 8) & 255, (p >> 16) & 255]; })()"
    )
    assert min(middle) > 240, "white at zero"

    said = page.locator("[data-difference-words]").inner_text()
    found = re.search(
        r"difference (−?[\d.e-]+) (\w+) at x = .*; mean (−?[\d.e-]+) ?(\w*), root mean square ([\d.e-]+) (\w+)", said
    )
    assert found is not None, said
    unit = {"nm": 1e-9, "pm": 1e-12, "MPa": 1e6, "GPa": 1e9, "kPa": 1e3, "Pa": 1.0, "fm": 1e-15, "": 0.0}
    numbers = [float(found[k].replace("−", "-")) * unit[found[k + 1]] for k in (1, 3, 5)]
    assert numbers[0] == pytest.approx(expected.flat[np.abs(expected).argmax()], rel=1e-3)
    assert numbers[1] == pytest.approx(expected.mean(), rel=5e-3, abs=1e-5 * known)
    assert numbers[2] == pytest.approx(np.sqrt((expected**2).mean()), rel=5e-3)
    assert "48 × 48" in said
    assert "32 × 32" in said

    cells = page.locator("[data-difference-numbers] tbody tr").nth(1).locator("td").all_inner_texts()
    assert cells[0] == "mean pressure"
    one, other, less = (float(text.split(" ")[0].replace("−", "-")) for text in cells[1:])
    assert (one, other, less) == pytest.approx((60.0, 40.0, 20.0), rel=1e-3)


@pytest.mark.slow
def test_the_difference_follows_the_step_and_surfaces_of_other_size_are_refused(
    app: AppServer, open_page: Open
) -> None:
    page = explored(app, open_page, 0, 1)
    page.click("[data-subtract]")
    words = page.locator("[data-difference-words]")
    page.wait_for_function("document.querySelector('[data-difference-words]').textContent.includes('60 MPa')")
    page.locator("[data-slider=steps] input").first.focus()
    page.keyboard.press("Home")
    page.wait_for_function("!document.querySelector('[data-difference-words]').textContent.includes('60 MPa')")
    fine, coarse = (np.nan_to_num(values_of(page, "pressure", number, 0)) for number in (0, 1))
    expected = averaged(fine, 32) - coarse
    largest = float(np.abs(expected).max())
    page.wait_for_function(
        f"largest => Math.abs({SUBTRACTED}.panels[0].colours.high / largest - 1) < 1e-4", arg=largest
    )
    of(page, "v.zoomBy(2.0, 0.5e-6, 0.5e-6)", 0)
    page.wait_for_function(f"{SUBTRACTED}.zoom === 2")

    page = explored(app, open_page, 0, 2)
    page.click("[data-subtract]")
    page.wait_for_function("document.querySelector('[data-difference-words]').textContent !== ''")
    words = page.locator("[data-difference-words]")
    assert "2 µm × 2 µm" in words.inner_text()
    assert "3 µm × 3 µm" in words.inner_text()
    expect(page.locator("[data-difference-map] canvas:visible")).to_have_count(0)


@pytest.mark.slow
def test_a_chosen_spot_is_centred_in_view(app: AppServer, open_page: Open) -> None:
    page = explored(app, open_page, 0)
    page.click("[data-spots]")
    row = page.locator("tr[data-spot]").first
    row.wait_for(state="visible", timeout=LONG)
    row.scroll_into_view_if_needed()
    row.click()
    page.wait_for_timeout(SETTLED)
    box = page.locator(".av-panel:not(.av-below) canvas:visible").first.bounding_box()
    assert 0 <= box["y"] <= 900 - box["height"], "the map is in view"
    x, y = (float(part) for part in row.get_attribute("data-spot").split(","))
    centred(page, x, y)

    of(page, "v.reset()")
    second = page.locator("tr[data-spot]").nth(1)
    x, y = (float(part) for part in second.get_attribute("data-spot").split(","))
    code = f"[r.left + p.axes.px({x!r}), r.top + p.axes.py({y!r})]"
    place = of(page, f"((p, r) => {code})(v.visible[0], v.visible[0].canvas.getBoundingClientRect())")
    page.mouse.click(*place)
    page.wait_for_timeout(SETTLED)
    centred(page, x, y)
    assert "chosen" in second.get_attribute("class")
    expect(page.locator("tr.chosen")).to_have_count(1)


def centred(page: Any, x: float, y: float) -> None:
    """The view is enlarged, and the spot with x, y stands in its middle, or as near as the edges of
    the surface allow."""
    zoom, centre, size, marked = of(
        page, "[v.zoom, v.centre, v.size, [v.marked.x0, v.marked.x1, v.marked.y0, v.marked.y1]]"
    )
    assert zoom > 1.0
    across = marked[0] < 0 or marked[1] > size[0] or marked[2] < 0 or marked[3] > size[1]
    middle = [x, y] if across else [0.5 * (marked[0] + marked[1]), 0.5 * (marked[2] + marked[3])]
    assert marked[0] <= x <= marked[1] or across
    for k in (0, 1):
        half = 0.5 * size[k] / zoom
        assert centre[k] == pytest.approx(min(max(middle[k], half), size[k] - half), rel=1e-9)
    limits = of(page, "(({ x0, x1, y0, y1 }) => [x0, x1, y0, y1])(v.visible[0].axes)")
    assert limits[0] <= x <= limits[1]
    assert limits[2] <= y <= limits[3]


@pytest.mark.slow
def test_few_points_of_a_step_are_drawn_before_all_are_there(app: AppServer, open_page: Open) -> None:
    page = explored(app, open_page, 0)
    page.wait_for_timeout(SETTLED)
    arrays = "v.panels.filter((p) => p.map.along === 'steps').flatMap((p) => p.map.arrays)"
    page.wait_for_function(
        f"(() => {{ const v = document.querySelector('[data-scene]').viewer;"
        f" return {arrays}.every((a) => v.atHand(a)[0] !== undefined); }})()",
        timeout=LONG,
    )
    code = (
        "(() => { const p = v.panels.find((p) => p.map.name === 'pressure'), a = p.map.arrays[0], few = p.raster;"
        " v.kept.delete(a); v.few.set(a, few); v.set('steps', 0); return p.raster === few; })()"
    )
    assert of(page, code), "what is at hand is shown at once"
    page.wait_for_timeout(500)
    values = values_of(page, "pressure", 0, 0)
    i, j = np.unravel_index(np.nanargmax(np.nan_to_num(values)), values.shape)
    x, y = (float((k + 0.5) * side) for k, side in zip((i, j), of(page, "v.cell"), strict=True))
    shown = of(page, f"v.panels.find((p) => p.map.name === 'pressure').at({x!r}, {y!r})")
    assert shown == pytest.approx(values[i, j], rel=1e-6)
