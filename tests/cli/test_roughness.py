"""``info --full``: every quantity as text, as JSON, as pictures and as a page."""

from __future__ import annotations

import json
import math
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import SCALE, Runner
from refusals import subject_of

import asperity as asp
from asperity import roughness


@pytest.fixture
def film(tmp_path: Path) -> Path:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(3e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=0.0
    )
    surface = asp.generate.gaussian(asp.Grid((96, 64), (5e-8, 5e-8)), spectrum, seed=1)
    heights = np.array(surface.heights)
    heights[5:8, 7:9] = np.nan
    path = tmp_path / "film.npy"
    np.save(path, heights * 1e9)
    return path


FILM = ("--size", "4.8um x 3.2um", "--height-unit", "nm")


def test_all_quantities_are_listed(run: Runner, film: Path) -> None:
    result = run("info", film, *FILM, "--full")
    assert result.exit_code == 0, result.stderr
    assert [symbol for symbol in ("Sq", "Sk", "η", "H", "a1") if f" {symbol} " not in result.stdout] == []


def test_json_holds_what_python_finds(run: Runner, film: Path) -> None:
    result = run("info", film, *FILM, "--full", "--json", "--level", "quadratic")
    found = json.loads(result.stdout)
    surface = asp.levelled(asp.read(film, size=(4.8e-6, 3.2e-6), height_unit="nm"), "quadratic")
    expected = asp.characterise(surface)
    assert found["levelled"] == "quadratic"
    quantities = found["roughness"]["quantities"]
    assert set(quantities) == {quantity.name for quantity in roughness.QUANTITIES}
    for quantity, value in expected.values():
        entry = quantities[quantity.name]
        assert (entry["unit"], entry["label"], entry["symbol"]) == (quantity.unit, quantity.label, quantity.symbol)
        if math.isfinite(value):
            assert entry["value"] == pytest.approx(value, rel=1e-12)
        else:
            assert entry["value"] is None
    assert found["roughness"]["remarks"] == list(expected.remarks)
    curves = found["roughness"]["curves"]
    assert curves["spectrum"]["psd_m4"] == pytest.approx(expected.spectra.radial.psd.tolist())
    assert curves["autocovariance_x"]["value_m2"][0] == pytest.approx(expected.heights.Sq**2)
    assert curves["material_ratio"]["height_m"][0] == pytest.approx(expected.heights.Sp)
    assert curves["structure_function_y"]["lag_m"][0] == pytest.approx(5e-8)


def test_json_without_full_is_short(run: Runner, film: Path) -> None:
    assert "roughness" not in json.loads(run("info", film, *FILM, "--json").stdout)


class Page(HTMLParser):
    """Collects pictures, links and text of a page, and checks that tags close in order."""

    VOID = ("meta", "link", "img", "br", "wbr", "hr")

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.pictures: list[str] = []
        self.text = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in self.VOID:
            self.open.append(tag)
        if tag == "img":
            self.pictures.append(dict(attrs)["src"] or "")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


def test_the_page_stands_alone(run: Runner, film: Path, tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    result = run("info", film, *FILM, "--report", target)
    assert result.exit_code == 0, result.stderr
    assert str(target.name) in result.stdout.replace("\n", "")
    source = target.read_text(encoding="utf-8")
    page = Page()
    page.feed(source)
    assert page.open == []
    assert len(page.pictures) == len(asp.plots.SURFACE_PLOTS)
    assert all(picture.startswith("data:image/png;base64,") for picture in page.pictures)
    assert not re.search(r"""(?:src|href)=["'](?!data:|#)""", source)
    for text in ("film.npy", "ISO 25178-2", "SHA-256"):
        assert text in page.text
    assert run("info", film, *FILM, "--report", target).exit_code == 2


def test_all_pictures(run: Runner, film: Path, tmp_path: Path) -> None:
    folder = tmp_path / "pictures"
    assert run("info", film, *FILM, "--plots", folder).exit_code == 0
    assert len(list(folder.glob("*.png"))) == len(asp.plots.SURFACE_PLOTS)


def test_a_tip(run: Runner, film: Path) -> None:
    command = ("info", film, *FILM, "--full", "--json", "--tip-radius", "100nm")
    quantities = json.loads(run(*command).stdout)["roughness"]["quantities"]
    assert quantities["sampling.tip_cutoff"]["value"] is not None
    result = run("info", film, *FILM, "--tip-radius", "100")
    assert subject_of(result) == "--tip-radius"


@pytest.mark.parametrize(
    ("option", "value", "subject"),
    [
        ("--report", "page.pdf", "--report"),
        ("--plot", "map.jpg", "--plot"),
        ("--level", "cubic", "form to be removed"),
    ],
)
def test_refusals(run: Runner, matrix: Path, option: str, value: str, subject: str) -> None:
    result = run("info", matrix, *SCALE, option, value)
    assert subject_of(result) == subject
