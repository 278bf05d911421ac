"""Every page of the application, and a report, against WCAG 2 A and AA by axe-core, dark and light;
landmarks, language, keyboard, and the choice of dark or light."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.web.layout import STEPS

from .app_server import AppServer
from .colours import contrast
from .expecting import expect
from .explored import LONG, keys, solved_in

Open = Callable[..., Any]
AXE = Path(__file__).with_name("axe") / "axe.min.js"
LEVELS = ("wcag2a", "wcag2aa", "wcag21a", "wcag21aa")

LEFT_OFF: dict[str, str] = {}
"""Rules that are not asked for, with the reason; there are none."""

PAGES = ("start", *STEPS)
SCHEMES = ("light", "dark")


@pytest.fixture(scope="module")
def kept(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return solved_in(browser, tmp_path_factory.mktemp("accessible"), runs=2)


@pytest.fixture(scope="module")
def app(kept: Path) -> Iterator[AppServer]:
    with AppServer(("--threads", "1", "--folder", str(kept))) as running:
        yield running


def opened(app: AppServer, open_page: Open, name: str, query: str = "", **options: Any) -> Any:
    """The page ``name``, once it is drawn."""
    page = open_page(app.address, **({"viewport": {"width": 1400, "height": 900}} | options)).page
    page.wait_for_url("**/s/**")
    to(page, name, query)
    return page


def to(page: Any, name: str, query: str = "") -> None:
    """Go from one page of the application to the page ``name``."""
    base = page.url.partition("?")[0].rpartition("/")[0]
    page.goto(f"{base.partition('/s/')[0]}/start" if name == "start" else f"{base}/{name}{query}")
    page.wait_for_selector("h1", state="attached")
    if name == "explore":
        page.wait_for_selector("[data-ready]", timeout=LONG)
    page.wait_for_timeout(1500)


STILL = """() => {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync("*, ::before, ::after { transition: none !important; animation: none !important; }");
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
}"""


def violations(page: Any, within: str = "html") -> list[str]:
    """Rule, place and reason of everything that axe-core finds ``within`` an element whose
    fading in and out has ended."""
    page.evaluate(STILL)
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found = page.evaluate(
        "([within, rules]) => axe.run(within, rules).then((all) => all.violations.flatMap((rule) =>"
        " rule.nodes.map((node) => `${rule.id}: ${node.html.slice(0, 200)} ${node.failureSummary}`)))",
        [
            within,
            {
                "runOnly": {"type": "tag", "values": list(LEVELS)},
                "rules": {name: {"enabled": False} for name in LEFT_OFF},
            },
        ],
    )
    return [str(item) for item in found]


@pytest.mark.slow
@pytest.mark.parametrize("scheme", SCHEMES)
def test_no_page_violates_wcag(scheme: str, app: AppServer, open_page: Open) -> None:
    page = opened(app, open_page, "surface", color_scheme=scheme)
    found = {}
    for name in PAGES:
        back = page.url
        to(page, name)
        found[name] = violations(page)
        page.goto(back)
    assert not any(found.values()), found


@pytest.mark.slow
@pytest.mark.parametrize("scheme", SCHEMES)
def test_nothing_that_opens_violates_wcag(scheme: str, app: AppServer, open_page: Open, kept: Path) -> None:
    first, second = keys(kept)
    page = opened(app, open_page, "explore", f"?run={first}&beside={second}", color_scheme=scheme)
    page.click("[data-subtract]")
    page.wait_for_selector("[data-difference-map] canvas")
    assert violations(page) == []
    to(page, "explore")
    for summary in page.locator("main summary").all():
        summary.click()
    for item in page.locator(".q-expansion-item").all():
        item.locator(".q-item").first.click()
    if page.locator("[data-theories]").count():
        page.click("[data-theories]")
    page.wait_for_selector(".theories .main-svg", timeout=LONG)
    page.wait_for_selector(".space .main-svg", timeout=LONG)
    page.wait_for_timeout(500)
    assert violations(page) == []
    page.evaluate("scrollTo(0, 0)")
    page.click("[aria-label='dark or light']")
    page.wait_for_selector("[data-look=dark]")
    page.wait_for_timeout(400)
    assert violations(page) == []
    page.keyboard.press("Escape")
    page.click("text=Copy as")
    page.wait_for_selector(".q-menu >> text=document")
    page.wait_for_timeout(400)
    assert violations(page) == []
    page.click(".q-menu >> text=document")
    page.wait_for_selector(".q-dialog .code")
    page.wait_for_timeout(1500)
    assert violations(page, ".q-dialog") == []


@pytest.mark.slow
@pytest.mark.parametrize("scheme", SCHEMES)
def test_no_report_violates_wcag(scheme: str, kept: Path, open_page: Open) -> None:
    page = open_page(next(kept.glob("runs/*/report.html")), color_scheme=scheme).page
    page.wait_for_function("document.querySelector('[data-viewer]').viewer !== undefined")
    page.evaluate("document.querySelector('[data-viewer]').viewer.ready")
    assert violations(page) == []


UNREACHED = """() => [...document.querySelectorAll("body *")].filter((e) => {
    const style = getComputedStyle(e), focused = (x) => x.tabIndex >= 0 && !x.disabled;
    if (!["pointer", "crosshair", "move"].includes(style.cursor) || !e.offsetParent) return false;
    if (e.parentElement && getComputedStyle(e.parentElement).cursor === style.cursor) return false;
    for (let x = e; x; x = x.parentElement) if (focused(x)) return false;
    const field = e.closest("label, .q-field, .av-stage, .js-plotly-plot") || e;
    return ![...field.querySelectorAll("*")].some(focused);
    }).map((e) => e.outerHTML.slice(0, 160))"""
"""What answers to a press, where neither it nor what is around or within it takes the focus."""


@pytest.mark.slow
def test_every_page_has_language_landmarks_and_is_reached_by_keyboard(app: AppServer, open_page: Open) -> None:
    page = opened(app, open_page, "surface")
    for name in PAGES:
        back = page.url
        to(page, name)
        assert page.evaluate("document.documentElement.lang").startswith("en"), name
        expect(page.locator("main, [role=main]")).to_have_count(1)
        assert page.locator("main").get_attribute("aria-label"), name
        expect(page.locator("h1")).to_have_count(1)
        if name != "start":
            expect(page.locator("header")).to_have_count(1)
            expect(page.locator("nav[aria-label]")).to_have_count(1)
            expect(page.locator("nav [aria-current=page]")).to_have_count(1)
        if name == "explore":
            page.click("[data-spots]")
            page.wait_for_selector("tr[data-spot]", timeout=LONG)
        assert page.evaluate(UNREACHED) == [], name
        page.evaluate("document.activeElement.blur()")
        reached = set()
        for _ in range(8):
            page.keyboard.press("Tab")
            reached.add(page.evaluate("document.activeElement.outerHTML.slice(0, 300)"))
        assert len(reached) > 5, name
        page.goto(back)


def rgb(text: str) -> str:
    """A colour "#rrggbb" as "rgb(r, g, b)"."""
    return f"rgb({', '.join(str(int(text[k : k + 2], 16)) for k in (1, 3, 5))})"


@pytest.mark.slow
def test_dark_or_light_is_kept_and_axes_are_legible_in_both(app: AppServer, open_page: Open) -> None:
    page = opened(app, open_page, "explore", color_scheme="light")
    is_dark = "document.body.classList.contains('body--dark')"
    assert not page.evaluate(is_dark), "as the system at first"
    page.click("[data-space]")
    page.click("[data-compared]")
    if page.locator("[data-theories]").count():
        page.click("[data-theories]")
    page.wait_for_selector(".theories .main-svg", timeout=LONG)
    page.wait_for_selector(".space .main-svg", timeout=LONG)
    page.wait_for_timeout(800)
    for scheme in SCHEMES:
        page.evaluate("scrollTo(0, 0)")
        page.click("[aria-label='dark or light']")
        page.click(f"[data-look={scheme}]")
        page.wait_for_function(f"{is_dark} === {str(scheme == 'dark').lower()}", timeout=LONG)
        page.wait_for_timeout(800)
        behind = page.evaluate("getComputedStyle(document.body).backgroundColor")
        look = page.evaluate("document.querySelector('[data-scene]').viewer.look")
        texts = page.eval_on_selector_all(
            ".js-plotly-plot :is(.xtick text, .ytick text, .xtitle, .ytitle, .legendtext, .colorbar text)",
            "all => all.map((e) => getComputedStyle(e).fill)",
        )
        assert len(texts) > 10
        axes = page.evaluate(
            "[...document.querySelectorAll('.js-plotly-plot')].map((p) => p._fullLayout.scene).filter(Boolean)"
            ".flatMap((s) => [s.xaxis, s.yaxis, s.zaxis]).flatMap((a) => [a.tickfont.color, a.title.font.color])"
        )
        assert len(axes) == 6
        for colour in [*texts, *map(rgb, axes), rgb(look["soft"]), rgb(look["ink"]), rgb(look["accent"])]:
            assert contrast(colour, behind) >= 4.5, (scheme, colour)

    page.reload()
    page.wait_for_selector("[data-ready]", timeout=LONG)
    assert page.evaluate(is_dark)
    for name in ("surface", "explore", "start"):
        back = page.url
        to(page, name)
        assert page.evaluate(is_dark), name
    page.goto(back)
    page.wait_for_selector("[data-ready]", timeout=LONG)
    page.click("[aria-label='dark or light']")
    expect(page.locator("[data-look=dark]")).to_have_attribute("aria-checked", "true")
    page.click("[data-look=system]")
    page.wait_for_function(f"!{is_dark}", timeout=LONG)
    page.reload()
    page.wait_for_selector("[data-ready]", timeout=LONG)
    assert not page.evaluate(is_dark)
