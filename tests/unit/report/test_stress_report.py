"""Stresses in words: tables by layer, interfaces, yield; and the part of the report that shows
them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest
from contact_cases import rough

import asperity as asp
from asperity.core.units import show
from asperity.physics.stress.figures import line_figures
from asperity.physics.stress.survey import Strengths, StressRequest, StressSurvey, survey
from asperity.physics.stress.work import (
    interface_table,
    maxima_table,
    region_text,
    remarks,
    setting_rows,
    strength_table,
    yield_sentence,
    yield_table,
)
from asperity.report import write_report
from asperity.run.execute import analysed

pytestmark = pytest.mark.usefixtures("unrendered")

FILM = asp.Elastic(200e9, 0.25, asp.Strength(hardness=14e9), name="film")
BASE = asp.Elastic(100e9, 0.3, name="base")


def surveyed(film: asp.Elastic = FILM, base: asp.Elastic = BASE, **keys: object) -> StressSurvey:
    surface = rough((20, 16), 3, spacing=(1.0, 1.0), power=2.0)
    surface = asp.Surface(surface.heights * 1e-9, 1e-7, periodic=True)
    body = asp.Layered([asp.Layer(film, 1e-7)], base)
    result = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(2e8))
    return survey(StressRequest(friction=0.3, **keys), result)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def found() -> StressSurvey:
    return surveyed(direction=math.pi / 2.0, strengths=Strengths(tensile=1e6, interface_shear=1e15))


def test_maxima_state_value_and_place(found: StressSurvey) -> None:
    table = maxima_table(found)
    assert len(table.cells) == 8 + 3
    assert all(len(cells) == len(table.headings) for cells in table.cells)
    film = found.maxima[0]
    assert table.cells[0][:3] == ("film, 0 to 100 nm", "von Mises", show(film.von_mises.value, "Pa"))
    assert table.cells[1][2] == show(film.von_mises.value / math.sqrt(3.0), "Pa")
    assert table.cells[0][3] == show(film.von_mises.x + 0.5e-7, "m"), "middles of pixels, as in figures"
    assert table.cells[4][0] == "base, below 100 nm"
    faces = {cells[5] for cells in table.cells[4:8]}
    assert faces <= {"100 nm, upper face"} | {show(depth, "m") for depth in found.depths}


def test_interfaces(found: StressSurvey) -> None:
    shear, peel = interface_table(found).cells
    assert shear[:3] == ("film / base, 100 nm", "shear", show(found.interfaces[0].shear.value, "Pa"))
    assert peel[1] == "peel (tension)"
    pressed = replace(found.interfaces[0], peel=replace(found.interfaces[0].peel, value=-1.0))
    assert interface_table(replace(found, interfaces=(pressed,))).cells[1][2] == "none"


def test_yield_of_known_and_unknown_strengths(found: StressSurvey) -> None:
    film, base = yield_table(found).cells
    assert film[2] == "5 GPa (H/2.8)"
    assert film[3] == f"{5e9 / found.maxima[0].von_mises.value:.3g}"
    assert base[2:4] == ("not known", "not known")
    sentence = yield_sentence(found)
    assert "film" in sentence
    assert sentence.endswith("The strength of base is not known.")
    weak = surveyed(base=asp.Elastic(100e9, 0.3, asp.Strength(yield_stress=1e6), name="base"))
    assert yield_sentence(weak).startswith(
        "The body yields: in base at a depth of 100 nm (its upper face), the von Mises"
    )
    none = surveyed(film=asp.Elastic(200e9, 0.25))
    assert yield_sentence(none).startswith("No strength of any part of the body is known")
    assert yield_table(none).cells[0][0] == "layer 1, 0 to 100 nm"


def test_given_strengths(found: StressSurvey) -> None:
    tension, shear = strength_table(found).cells
    assert tension[0] == "tension"
    assert tension[3].endswith(": fails")
    assert shear[3].endswith(": holds")
    assert strength_table(surveyed()).cells == ()


def test_settings(found: StressSurvey) -> None:
    rows = dict(setting_rows(found))
    assert rows["friction coefficient"] == "0.3"
    assert rows["direction of the shear traction on the body"] == "90° from x towards y"
    assert rows["planes"].startswith(f"{found.depths.size} from 0 to ")
    still = dict(setting_rows(surveyed(sections=(), depths=(3e-8,))))
    assert still["planes"] == "1 at a depth of 30 nm"
    assert "shear traction" not in dict(setting_rows(replace(found, request=StressRequest())))


def test_layers_of_a_graded_coating_are_one() -> None:
    surface = asp.Surface(rough((12, 12), 3).heights * 1e-9, 1e-7, periodic=True)
    body = asp.Layered(asp.solids.graded(FILM, BASE, 1e-6, sublayers=5), BASE)
    result = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(2e8))
    found = survey(StressRequest(), result)
    assert len(found.maxima) == 6
    table = maxima_table(found)
    assert {cells[0] for cells in table.cells[:-3]} == {"graded film - base (5 layers), 0 to 1 µm", "base, below 1 µm"}
    assert {cells[0] for cells in table.cells[-3:]} == {"whole body"}
    largest = max(part.von_mises.value for part in found.maxima[:5])
    assert yield_table(found).cells[0][1] == show(largest, "Pa"), "its strength is not known"
    assert table.cells[0][2] == show(largest, "Pa")
    assert len(interface_table(found).cells) == 2, "only the one below the coating"
    assert region_text([found.maxima[-1].region]) == "base, below 1 µm"


def test_plastic_contacts_carry_a_warning(found: StressSurvey) -> None:
    problem = replace(found.result.problem, law=asp.Hardness(0.6 * found.result.max_pressure))
    plastic = survey(found.request, asp.solve(problem, found.result.control))
    assert plastic.result.plastic.any()
    assert len(remarks(plastic)) == len(remarks(found)) + 1
    assert "hardness" in remarks(plastic)[-1]


def test_the_report_shows_them(found: StressSurvey, tmp_path: Path) -> None:
    figures = tuple(line_figures(found, found.result.problem.boundary))
    outcome = analysed(found.result, {"stress": found.request, "yielding": True})
    write_report(outcome, tmp_path / "r.html")
    write_report(found.result, tmp_path / "bare.html")
    html, bare = ((tmp_path / name).read_text(encoding="utf-8") for name in ("r.html", "bare.html"))
    assert 'id="stress"' in html
    assert 'id="stress"' not in bare
    assert html.count("data:image/png") == bare.count("data:image/png") + len(figures)
    assert "http" not in html.replace("http-equiv", "").split("Please cite")[0]
    for text in ("film, 0 to 100 nm", "Onset of yield", "Given strengths", "film / base, 100 nm", figures[0].title):
        assert text in html
    assert html.count("film, 0 to 100 nm") == 2, "the name of a layer stands once in each table"
    assert "[Burmister1945]" in html
    assert "[Tabor1951]" in html
    assert "[Tabor1951]" not in bare
