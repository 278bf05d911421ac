"""Reports as colleagues see them: verdict first, contents, figures before tables, each stress once;
on a phone, and on paper."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from study_cases import LOADS, SEEDS, InProcess, study

from asperity.report.comparison import write_comparison_report
from asperity.report.study import write_study_report
from asperity.studies.campaign import prepare_study
from asperity.studies.compare import compare
from asperity.studies.run import carry_out

from .expecting import expect
from .test_report_page import PHONE, opened, report  # noqa: F401

Open = Callable[..., Any]

PAPER = (680, 1009)
"""Width and height of what is printed on a sheet of A4 within margins of 15 mm, in CSS pixels."""


@pytest.fixture(scope="module")
def pages(report: Any, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:  # noqa: F811
    """The report of a contact, of a study, and of a comparison."""
    folder = tmp_path_factory.mktemp("pages")
    campaign = prepare_study(study(axes=[LOADS, SEEDS], title="Loads"), folder / "study")
    carry_out(campaign.plan, campaign.records, InProcess())
    write_study_report(campaign, folder / "study.html")
    write_comparison_report(compare(report.outcome.result.problem), folder / "comparison.html")
    return {"contact": report.file, "study": folder / "study.html", "comparison": folder / "comparison.html"}


@pytest.mark.parametrize("name", ["contact", "study", "comparison"])
def test_contents_stand_below_the_verdict_and_lead_to_every_section(
    name: str, pages: dict[str, Path], open_page: Open
) -> None:
    page = open_page(pages[name]).page
    links = page.locator("nav[aria-label=Contents] a")
    targets = [link.get_attribute("href") for link in links.all()]
    headings = page.eval_on_selector_all("main h2", "all => all.map((h) => '#' + h.id)")
    assert targets == headings
    assert headings[0] == ("#found" if name == "study" else "#figures")
    for text, heading in zip(links.all_inner_texts(), page.locator("main h2").all_inner_texts(), strict=True):
        assert heading.startswith(text)
    order = page.evaluate(
        "['header', '.banner', 'nav', 'main'].map((s) => document.querySelector(s).getBoundingClientRect().top)"
    )
    assert order == sorted(order)
    links.last.click()
    assert page.url.endswith(targets[-1])


@pytest.mark.parametrize("name", ["contact", "study", "comparison"])
def test_figures_stand_before_tables(name: str, pages: dict[str, Path], open_page: Open) -> None:
    page = open_page(pages[name], java_script_enabled=False).page
    code = """all => all.map((s) => [...s.querySelectorAll("figure, table")].map((e) => e.tagName).join(" "))"""
    for tags in page.eval_on_selector_all("main section", code):
        assert re.fullmatch(r"(FIGURE ?)*(TABLE ?)*", tags)
    whole = " ".join(page.eval_on_selector_all("main section", code)).split()
    assert whole[0] == "FIGURE"


def test_each_stress_is_drawn_once(report: Any, open_page: Open) -> None:  # noqa: F811
    page = opened(report, open_page)
    heads = page.locator(".av-below:visible h4").all_inner_texts()
    pictures = page.locator("figure:visible h3").all_inner_texts()
    flat = [title for title in (*heads, *pictures) if "in space" not in title]  # a view is no second map
    stresses = [title for title in flat if "tress" in title or title.startswith("σ")]
    assert len(stresses) == len(report.scene["sections"])
    assert len(set(stresses)) == len(stresses)
    page.emulate_media(media="print")
    printed = page.locator("section[aria-labelledby=stress] figure:visible h3").all_inner_texts()
    assert len(set(printed)) == len(printed) > len(stresses), "sections, and planes at several depths"
    assert not any("close-up" in title for title in printed)


@pytest.mark.parametrize("name", ["contact", "study", "comparison"])
def test_wide_tables_scroll_on_a_phone_and_by_keyboard(name: str, pages: dict[str, Path], open_page: Open) -> None:
    page = open_page(pages[name], **PHONE).page
    page.wait_for_timeout(300)
    assert page.evaluate("document.documentElement.scrollWidth") <= 420
    code = (
        """all => all.filter((t) => !t.closest(".scroll") && t.scrollWidth > t.parentElement.clientWidth + 1).length"""
    )
    assert page.eval_on_selector_all("table", code) == 0
    boxes = page.locator(".scroll[tabindex='0']")
    wide = [box for box in boxes.all() if box.evaluate("b => b.scrollWidth > b.clientWidth + 1")]
    assert wide, "some table is wider than a phone"
    wide[0].press("ArrowRight")
    page.wait_for_timeout(300)
    assert wide[0].evaluate("b => b.scrollLeft") > 0


@pytest.mark.parametrize("name", ["contact", "study", "comparison"])
def test_printed_pages_are_full(name: str, pages: dict[str, Path], open_page: Open, tmp_path: Path) -> None:
    page = open_page(pages[name], viewport={"width": PAPER[0], "height": PAPER[1]}).page
    page.wait_for_timeout(300)
    page.emulate_media(media="print")
    tall = page.evaluate("document.body.getBoundingClientRect().height")
    assert page.evaluate("document.documentElement.scrollWidth") <= PAPER[0]
    margin = dict.fromkeys(("top", "bottom", "left", "right"), "15mm")
    sheets = len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4", margin=margin)))
    assert sheets <= math.ceil(1.2 * tall / PAPER[1]), "a sixth of the paper is blank at most, beside the last sheet"


def test_a_study_that_is_not_done_says_so_first(tmp_path: Path, open_page: Open) -> None:
    campaign = prepare_study(study(axes=[LOADS]), tmp_path / "study")
    write_study_report(campaign, tmp_path / "study.html")
    page = open_page(tmp_path / "study.html").page
    expect(page.locator(".banner").first).to_contain_text("3 cases are missing")
    assert page.locator("nav[aria-label=Contents] a").count() == page.locator("main h2").count() > 2
