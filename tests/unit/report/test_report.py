"""A report is one file that states everything, escapes what it is given, and cries when a result is
not converged."""

from __future__ import annotations

import base64
import hashlib
import io
import re
from dataclasses import dataclass, replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from refusals import refused

import asperity as asp
from asperity.contact.result import SCALARS
from asperity.core.arrays import array_digest
from asperity.core.citations import reference
from asperity.core.errors import OutputError
from asperity.io.words import body_rows, body_text, scalar_text, surface_rows
from asperity.plots import PLASTIC_PLOTS, PLOTS
from asperity.report import write_report
from asperity.report.page import prose, script
from asperity.solvers import ConjugateGradient
from asperity.surfaces.surface import Origin

pytestmark = pytest.mark.usefixtures("unrendered")

VOID = {"meta", "link", "img", "br", "wbr"}


class Page(HTMLParser):
    """Visible text, tags with their attributes, and whether every element is closed."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str]]] = []
        self.open: list[str] = []
        self.words: list[str] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, {key: value or "" for key, value in attrs}))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] not in ("style", "title", "script"):
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())

    def all(self, tag: str) -> list[dict[str, str]]:
        return [attributes for name, attributes in self.tags if name == tag]


def problem() -> asp.ContactProblem:
    noise = np.random.default_rng(3).standard_normal((20, 14)) * 3e-9
    origin = Origin("<script>alert('x')</script> & co.x3p", "topo", {"lens": "50x"}, ("levelled by a plane",))
    surface = asp.Surface(noise, 2e-8, 1e-8, periodic=True, origin=origin)
    sources = ("youngs_modulus: Bhushan 1999", "poisson_ratio: assumed: as bulk")
    coating = asp.Elastic(1.4e11, 0.25, asp.Strength(hardness=1.5e10), name="DLC", sources=sources)
    return asp.ContactProblem(surface, coating, counter_body=asp.Elastic(4.5e11, 0.22), law=asp.Hardness(1.5e10))


@pytest.fixture(scope="module")
def result() -> asp.ContactResult:
    return asp.solve(problem(), asp.MeanPressure(1.25e9))


@pytest.fixture(scope="module")
def html(result: asp.ContactResult, tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("report") / "report.html"
    advice = (
        asp.contact.Advice("warning", "pixel <size>", "Refine to 5 nm & repeat."),
        asp.contact.Advice("note", "regime", "Contact fraction 18 %."),
    )
    write_report(result, path, advice=advice, document="format = 1\nname = '<b>'\n")
    assert [entry.name for entry in path.parent.iterdir()] == ["report.html"]
    return path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(html: str) -> Page:
    return Page(html)


def test_page_is_well_formed(page: Page, html: str) -> None:
    assert page.open == []
    assert html.lstrip().startswith("<!DOCTYPE html>")
    assert page.all("html") == [{"lang": "en"}]
    assert len(page.all("h1")) == 1
    identifiers = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert len(set(identifiers)) == len(identifiers)
    assert {item["aria-labelledby"] for item in page.all("section")} == set(identifiers)


def test_nothing_is_loaded_from_elsewhere(page: Page, html: str) -> None:
    loaded = [value for _, attributes in page.tags for key, value in attributes.items() if key in {"src", "href"}]
    loaded = [value for value in loaded if not value.startswith("#")]
    assert len(loaded) == len(PLOTS) + len(PLASTIC_PLOTS) + 1
    assert all(value.startswith("data:") for value in loaded)
    assert [item for item in page.all("script") if item != {"type": "application/json"}] == [{}], "one script"
    policy = next(item["content"] for item in page.all("meta") if "http-equiv" in item)
    digest = base64.b64encode(hashlib.sha256(script().encode()).digest()).decode()
    assert policy.startswith(f"default-src 'none'; img-src data:; script-src 'sha256-{digest}'; style-src 'sha256-")
    assert html.count(f"<script>{script()}</script>") == 1
    assert not re.search(r"""<[^>]* on[a-z]+=""", html.replace(script(), "")), "a handler within an element"
    assert "eval(" not in script()
    assert "@import" not in html
    assert "url(" not in html


def test_every_scalar_is_listed_with_its_unit(page: Page, result: asp.ContactResult) -> None:
    for quantity in SCALARS:
        shown = scalar_text(quantity, result)
        assert f"{quantity.label} {shown}" in page.text
    assert "mean (nominal) pressure 1.25 GPa" in page.text
    assert f"number of contact spots {result.n_spots}" in page.text


def test_inputs_are_stated(page: Page) -> None:
    for text in (
        "size 400 nm × 140 nm",
        "points 20 × 14",
        "pixel 20 nm × 10 nm",
        "step 1 levelled by a plane",
        "lens 50x",
        "material DLC Young's modulus E 140 GPa Poisson's ratio ν 0.25 hardness H 15 GPa",
        "source of Young's modulus E Bhushan 1999",
        "source of Poisson's ratio ν assumed: as bulk",
        "perfectly flat",
        "Young's modulus E 450 GPa",
        "boundary periodic",
        "interface law hardness pressure limit 15 GPa",
        "prescribed mean pressure 1.25 GPa",
    ):
        assert text in page.text, text


def test_figures_are_pictures_with_alternative_text(page: Page) -> None:
    images = page.all("img")
    assert [item["alt"].split(".")[0] for item in images] == [plot.title for plot in (*PLOTS, *PLASTIC_PLOTS)]
    for item in images:
        head, data = item["src"].split(",")
        assert head == "data:image/png;base64"
        Image.open(io.BytesIO(base64.b64decode(data))).verify()


def test_certificate_is_explained(page: Page, result: asp.ContactResult) -> None:
    assert "differs from the exact one on this grid by at most this fraction" in page.text
    assert f"{result.certificate.duality_gap:.4g} The total energy" in page.text
    assert f"iterations {result.certificate.iterations} Steps" in page.text


def test_provenance_citations_and_document_are_there(page: Page, result: asp.ContactResult) -> None:
    assert array_digest(result.problem.surface.heights) in page.text
    assert f"numpy {np.__version__}" in page.text
    assert len(result.citation_keys) > 3
    for key in result.citation_keys:
        assert f"[{key}] {reference(key)}" in page.text
    assert "format = 1 name = '<b>'" in page.text


def test_text_from_files_is_escaped(page: Page, html: str) -> None:
    assert html.count("<script>") == 1
    assert "<b>'" not in html
    assert "Contact report: <script>alert('x')</script> & co.x3p" in page.text
    assert "Warning: pixel <size> Refine to 5 nm & repeat." in page.text


def test_converged_result_has_no_alarm(page: Page) -> None:
    assert [item["role"] for item in page.all("div") if item.get("role", "region") != "region"] == ["status"]
    assert "NOT CONVERGED" not in page.text
    assert "Note: regime" in page.text


def test_failure_is_said_first_with_its_remedy(tmp_path: Path) -> None:
    failed = asp.solve(
        problem(), asp.MeanPressure(1e9), solver=ConjugateGradient(max_iterations=2), on_failure="return"
    )
    write_report(failed, tmp_path / "r.html")
    page = Page((tmp_path / "r.html").read_text(encoding="utf-8"))
    assert [item["class"] for item in page.all("div") if item.get("role") == "alert"] == ["banner bad"]
    assert failed.status.remedy in page.text
    assert page.text.index("NOT CONVERGED") < page.text.index("real contact area")
    assert "Problem document" not in page.text


def test_existing_file_is_kept_unless_overwritten(result: asp.ContactResult, tmp_path: Path) -> None:
    path = tmp_path / "r.html"
    path.write_text("mine")
    with pytest.raises(OutputError):
        write_report(result, path)
    assert path.read_text() == "mine"
    with refused(asp.InputError, "advice of a report"):
        write_report(result, path, advice=("careful",), overwrite=True)  # type: ignore[arg-type]
    assert path.read_text() == "mine"


def test_unknown_numbers_and_unnamed_surfaces_are_said_in_words(result: asp.ContactResult, tmp_path: Path) -> None:
    bare = asp.Surface(result.problem.surface.heights, 1e-8)
    unknown = replace(
        result, problem=replace(result.problem, surface=bare), normal_stiffness=np.nan, citation_keys=("Nobody1900",)
    )
    write_report(unknown, tmp_path / "r.html")
    page = Page((tmp_path / "r.html").read_text(encoding="utf-8"))
    assert "normal stiffness per nominal area not computed" in page.text
    assert "source given as an array" in page.text
    assert "[Nobody1900] unknown reference" in page.text


def test_bodies_made_of_parts_are_listed_part_by_part() -> None:
    @dataclass(frozen=True)
    class Film:
        material: asp.Elastic
        thickness: float

    @dataclass(frozen=True)
    class Stack:
        layers: tuple[Film, ...]
        base: asp.Elastic

    rows = body_rows(Stack((Film(asp.Elastic(1.4e11, 0.25, name="DLC"), 5e-9),), asp.Elastic(1e11, 0.3)))
    assert ("kind", "stack") in rows
    assert ("layers 1: thickness", "5 nm") in rows
    assert ("layers 1: material: Young's modulus E", "140 GPa") in rows
    assert ("base: Poisson's ratio ν", "0.3") in rows


def test_heights_of_masked_surfaces_are_measured_on_valid_points() -> None:
    rows = dict(surface_rows(asp.Surface([[0.0, 2e-6], [np.nan, 2e-6]], 1e-6)))
    assert rows["peak to valley"] == "2 µm"
    assert rows["rms height"] == "942.8 nm"


def test_layered_bodies_are_listed_from_the_surface_down() -> None:
    film = asp.Elastic(1e9, 0.4)
    dlc = asp.Elastic(1.4e11, 0.25, asp.Strength(1.5e10), name="DLC", sources=("youngs_modulus: Bhushan 1999",))
    steel = asp.Elastic(2.1e11, 0.3, asp.Strength(yield_stress=3e8), name="steel", sources=("user",))
    body = asp.Layered([asp.Layer(dlc, 5e-9, asp.Frictionless()), asp.Layer(film, 2e-6)], steel, name="disk")
    assert body_text(body) == "DLC 5 nm (slips) / (E = 1 GPa, ν = 0.4) 2 µm / steel"
    assert body_rows(body) == [
        ("name", "disk"),
        ("layer 1", "5 nm of DLC: E = 140 GPa, ν = 0.25, H = 15 GPa; slips without friction on what is below"),
        ("layer 2", "2 µm of E = 1 GPa, ν = 0.4; bonded to what is below"),
        ("base", "steel: E = 210 GPa, ν = 0.3, Y = 300 MPa"),
        ("source of Young's modulus E (DLC)", "Bhushan 1999"),
        ("source (steel)", "user"),
    ]
    assert body_text(asp.Layered([asp.Layer(dlc, 5e-9)], asp.RigidBase())) == "DLC 5 nm / rigid base"
    assert body_text(asp.Rigid()) == "rigid"


def test_graded_coatings_take_one_row() -> None:
    top, bottom = asp.Elastic(4e11, 0.25, name="TiN"), asp.Elastic(2e11, 0.3, name="steel")
    body = asp.Layered([asp.Layer(top, 1e-8), *asp.solids.graded(top, bottom, 1e-6, sublayers=4)], bottom)
    assert body_text(body) == "TiN 10 nm / graded TiN - steel 1 µm in 4 layers / steel"
    rows = dict(body_rows(body))
    assert rows["layers 2 to 5"].startswith("1 µm of graded TiN - steel in 4 layers: E = 366.8 GPa … 218.1 GPa;")


def test_options_and_exponents_are_not_broken_at_their_hyphens() -> None:
    text = str(prose("Periodise it (--periodise, or --short-cutoff 1um) <b>; to 2.21e-08 of afm_film"))
    assert '<span class="whole">--periodise</span>,' in text
    assert '<span class="whole">--short-cutoff</span> 1um) &lt;b&gt;' in text
    assert '<span class="whole">2.21e-08</span> of afm_<wbr>film' in text
