"""The page of a design that ``asperity design`` leaves, in a real browser: recommended design,
margins and figures as stored, on wide screens and phones, and its accessibility."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from study_cases import PROBLEM

from asperity.core.units import percent, show

from .expecting import expect
from .test_accessibility import violations
from .test_report_page import PHONE

Open = Callable[..., Any]

FILM = {"layers": [{"material": "DLC", "thickness": "20 nm"}], "base": {"material": "steel"}}
DESIGN = {
    "minimise": "max_pressure",
    "variables": [
        {"path": "surface.spectrum.rms_height", "name": "rms", "low": "0.5 nm", "high": "4 nm"},
        {"path": "body.layers.0.material", "name": "film", "choices": ["DLC", "TiN"]},
    ],
    "constraints": [{"quantity": "mean_gap", "at_least": "1.5 nm"}],
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the command leaves, run as a user does."""
    place = tmp_path_factory.mktemp("design")
    tables = {"version": 1, "title": "Smoothest film", "problem": {**PROBLEM, "body": FILM}, "design": DESIGN}
    (place / "film.toml").write_text(tomli_w.dumps(tables), encoding="utf-8")
    command = [sys.executable, "-m", "asperity", "design", str(place / "film.toml"), "--workers", "1"]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return place / "film-results"


def rows(folder: Path) -> dict[tuple[str, str], dict[str, str]]:
    """Rows of the table of the design by kind and name."""
    with (folder / "design.csv").open(newline="", encoding="utf-8") as text:
        return {(row["kind"], row["name"]): row for row in csv.DictReader(text)}


def test_the_recommended_design_stands_first(folder: Path, open_page: Open) -> None:
    watched = open_page(folder / "report.html", viewport={"width": 1400, "height": 900})
    page, found = watched.page, json.loads((folder / "design.json").read_text(encoding="utf-8"))
    expect(page.locator("h1")).to_have_text("Smoothest film")
    expect(page.locator(".banner")).to_contain_text(found["verdict"])
    stored = rows(folder)
    header = page.locator("header, .banner, .cards")
    best = show(float(stored["variable", "rms"]["value"]), "m")
    expect(page.locator("body")).to_contain_text(best)
    assert any(best in text for text in header.all_inner_texts())
    assert any(stored["variable", "film"]["value"] in text for text in header.all_inner_texts())
    watched.check()


def test_margins_and_changes_are_those_stored(folder: Path, open_page: Open) -> None:
    page = open_page(folder / "report.html", viewport={"width": 1400, "height": 900}).page
    limit = json.loads((folder / "design.json").read_text(encoding="utf-8"))["constraints"][0]
    row = page.locator("table tr", has_text="mean gap").first
    expect(row).to_contain_text(show(limit["limit"], "m"))
    expect(row).to_contain_text(percent(limit["margin"]))


def test_figures_are_drawn_and_lie_before_tables(folder: Path, open_page: Open) -> None:
    page = open_page(folder / "report.html", viewport={"width": 1400, "height": 900}).page
    figures = page.locator("main figure")
    drawn = {file.stem for file in (folder / "plots").glob("*.png")}
    assert {"history", "margins"} <= drawn
    expect(figures).to_have_count(len(drawn))
    for figure in figures.all():
        picture = figure.locator("img, svg").first
        expect(picture).to_be_visible()
        box = picture.bounding_box()
        assert box is not None
        assert min(box["width"], box["height"]) > 100.0
    first_table = page.locator("main table").first.evaluate("e => e.getBoundingClientRect().top")
    assert figures.first.evaluate("e => e.getBoundingClientRect().top") < first_table


@pytest.mark.parametrize("width", [1400, 420])
def test_nothing_is_wider_than_the_screen(width: int, folder: Path, open_page: Open) -> None:
    options: dict[str, Any] = PHONE if width == 420 else {"viewport": {"width": 1400, "height": 900}}
    page = open_page(folder / "report.html", **options).page
    expect(page.locator(".banner")).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for link in page.locator("nav[aria-label=Contents] a").all():
        link.click()
        expect(page.locator(str(link.get_attribute("href")))).to_be_in_viewport()
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_page_is_accessible(scheme: str, folder: Path, open_page: Open) -> None:
    page = open_page(folder / "report.html", color_scheme=scheme).page
    expect(page.locator("main figure").first).to_be_visible()
    assert violations(page) == []
