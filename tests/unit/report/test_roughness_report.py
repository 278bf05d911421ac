"""The page on a surface's roughness: for every surface, with its numbers in words."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import OutputError
from asperity.report.roughness import (
    NOT_DEFINED,
    headline_values,
    peak_comparison,
    quantity_rows,
    quantity_text,
    summary,
    summit_comparison,
    write_roughness_report,
)
from asperity.roughness import QUANTITIES

pytestmark = pytest.mark.usefixtures("unrendered")

BY_PATH = {quantity.name: quantity for quantity in QUANTITIES}


def generated(hurst: float = 0.8, *, rolloff: float = 2e-7, size: int = 128) -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2e-9), hurst=hurst, rolloff_wavelength=rolloff, shortest_wavelength=8e-8
    )
    return asp.generate.gaussian(asp.Grid((size, size), (1e-8, 1e-8)), spectrum, seed=1)


@pytest.fixture(scope="module")
def found() -> asp.roughness.Characterisation:
    return asp.characterise(generated())


@pytest.mark.parametrize(
    "surface",
    [
        pytest.param(generated(), id="periodic"),
        pytest.param(asp.Surface(np.where(np.eye(64) > 0, np.nan, generated(size=64).heights), 1e-8), id="holes"),
        pytest.param(asp.Surface(generated().heights[:, :1], 1e-8), id="profile"),
        pytest.param(asp.Surface(np.zeros((8, 8)), 1e-8), id="flat"),
        pytest.param(asp.Surface([[1.0]], 1e-8), id="point"),
    ],
)
def test_a_page_of_every_surface(surface, tmp_path):
    path = tmp_path / "page.html"
    write_roughness_report(asp.characterise(surface), path)
    text = path.read_text(encoding="utf-8")
    assert text.count("<img ") == len(asp.plots.SURFACE_PLOTS)
    assert not re.search(r"\bnan\b", text)


def test_titles_are_escaped(found, tmp_path, monkeypatch):
    monkeypatch.setattr("asperity.plots.picture.png", lambda *a, **k: b"")
    path = tmp_path / "page.html"
    write_roughness_report(found, path, title="<film> & co")
    assert "&lt;film&gt; &amp; co" in path.read_text(encoding="utf-8")
    with refused(OutputError, "output file"):
        write_roughness_report(found, path)


def test_every_defined_number_has_a_row(found):
    told = {name for _, rows in quantity_rows(found) for name, _, _ in rows}
    for label in ("rms height Sq", "Hurst exponent H", "summit radius R"):
        assert label in told
    assert "fractal dimension of profiles D" not in told  # the roll-off leaves two lags
    texts = {name: text for _, rows in quantity_rows(found) for name, text, _ in rows}
    assert "±" in texts["Hurst exponent H"]
    assert "± " in texts["rms height Sq"]
    assert " (x), " in texts["mean square slope m2"]
    assert NOT_DEFINED not in texts.values()
    headings = [heading for heading, _ in quantity_rows(found)]
    assert len(set(headings)) == len(headings)


@pytest.mark.parametrize(
    ("path", "value", "text"),
    [
        ("heights.Sq", 2.5e-9, "2.5 nm"),
        ("spatial.Std", math.pi / 4.0, "45°"),
        ("functional.Smr1", 0.099, "9.9 %"),
        ("summits.eight.count", 1200.0, "1200"),
        ("spectrum.hurst", 0.8, "0.8"),
        ("spatial.Str", math.nan, NOT_DEFINED),
    ],
)
def test_texts_of_numbers(path, value, text):
    assert quantity_text(BY_PATH[path], value) == text


def test_headline(found):
    assert headline_values(found)[0] == ("rms height Sq", quantity_text(BY_PATH["heights.Sq"], found.heights.Sq, 3))
    assert len(headline_values(found)) == 8


def test_summary_tells_the_spectrum(found):
    text = summary(found)
    assert "isotropic" in text
    assert "Hurst exponent 0." in text
    assert "roll-off at" in text
    none = summary(asp.characterise(generated(0.5, rolloff=5e-6)))
    assert "no roll-off" in none
    assert "spectrum" not in summary(asp.characterise(asp.Surface(np.zeros((8, 8)), 1.0)))


def number(text: str) -> float:
    return float(text.split(" ")[0])


def test_summits_of_a_resolved_gaussian_surface_are_those_of_nayak():
    surface = asp.characterise(generated(size=512))
    table = {row[0]: row[1:] for row in summit_comparison(surface)}
    # eight pixels to the shortest wave: lattice summits are 3 % fewer and blunter; 2000 of them
    # scatter by 5 %
    for label in ("density of summits", "mean summit curvature", "summit radius 1/<κ>"):
        measured, _, spectral = table[label]
        assert number(measured) == pytest.approx(number(spectral), rel=0.1), label
    peaks = {label: (measured, theory) for label, measured, theory in peak_comparison(surface)}
    for label, (measured, theory) in peaks.items():
        assert number(measured) == pytest.approx(number(theory), rel=0.05 if "height" not in label else 0.15), label


def test_comparison_where_there_is_nothing_to_compare():
    flat = asp.characterise(asp.Surface(np.zeros((8, 8)), 1.0))
    assert summit_comparison(flat) == []
    assert peak_comparison(flat) == []


def test_public_functions(found, tmp_path: Path, monkeypatch):
    monkeypatch.setattr("asperity.plots.picture.png", lambda *a, **k: b"")
    asp.report.write_roughness_report(found, tmp_path / "page.html")
    assert len(asp.plots.save_roughness_plots(found, tmp_path / "pictures")) == len(asp.plots.SURFACE_PLOTS)
