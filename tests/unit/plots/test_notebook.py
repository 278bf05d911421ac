"""What notebooks show: one screen of text, a card with a picture, figures on the axes that are
given."""

from __future__ import annotations

import base64
import io
import os
import re
import subprocess
import sys
from html.parser import HTMLParser

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image
from refusals import refused

import asperity as asp
from asperity.core.late import Tabled
from asperity.core.units import show
from asperity.solids.library import liquids
from asperity.theories.ask import ways_of
from asperity.theories.catalogue import FAMILIES


@pytest.fixture(scope="module")
def result() -> asp.ContactResult:
    x = np.arange(24) * 1e-7
    heights = 2e-9 * (np.cos(2.0 * np.pi * x / 2.4e-6)[:, None] + np.cos(2.0 * np.pi * x / 1.2e-6)[None, :16])
    origin = asp.Surface(heights, 1e-7).origin.continued("made of <two> cosines")
    disk = asp.Layered([asp.Layer(asp.material("DLC"), thickness=5e-8)], base=asp.material("steel"))
    surface = asp.Surface(heights, 1e-7, periodic=True, origin=origin)
    return asp.solve(asp.ContactProblem(surface, disk, law=asp.Hardness(2e10)), asp.MeanPressure(1e8))


@pytest.fixture(scope="module")
def field(result: asp.ContactResult) -> asp.stresses.StressField:
    return asp.stress(result, [0.0, 2e-8, 5e-8, 2e-7])


def things(result: asp.ContactResult, field: asp.stresses.StressField) -> list[object]:
    return [
        result.problem.surface,
        result,
        field,
        asp.stress(result, asp.stresses.depths_through(result.problem.body, 2e-7), on=asp.stresses.Section(y="max")),
    ]


def test_repr_fits_on_a_screen(result, field):
    for thing in (*things(result, field), result.problem, result.problem.body):
        lines = repr(thing).splitlines()
        assert len(lines) <= 25
        assert max(map(len, lines)) <= 160


def test_repr_tells_what_matters(result, field):
    assert "24 × 16" in repr(result.problem.surface)
    assert repr(result.problem.body) == "<Layered DLC 50 nm / steel>"
    assert "hardness 20 GPa" in repr(result.problem)
    assert repr(result).startswith("Contact, converged\n")
    assert "prescribed mean pressure" in repr(result)
    assert re.search(r"largest von Mises stress\s+[\d.]+ [MG]Pa in DLC", repr(field))


def test_small_things_show_themselves_in_one_line(result, field):
    assert repr(asp.Elastic(1e9, 0.3)) == "<Elastic E = 1 GPa, ν = 0.3>"
    assert repr(asp.Elastic(2e11, 0.3, asp.Strength(hardness=5e9), "steel")) == (
        "<Elastic steel: E = 200 GPa, ν = 0.3, H = 5 GPa>"
    )
    film = asp.LiquidFilm.of(asp.liquid("water"), 5e-10)
    wet = asp.solve(asp.ContactProblem(result.problem.surface, asp.material("DLC"), film=film), asp.MeanPressure(1e8))
    unknown = asp.stress(asp.stresses.LoadedBody(asp.Elastic(1e9, 0.3), _tractions()), [1e-8])
    for thing in (
        wet.menisci,
        asp.first_yield(field),
        asp.first_yield(unknown),
        asp.characterise(result.problem.surface),
    ):
        shown = repr(thing)
        assert shown.startswith(f"<{type(thing).__name__}")
        assert len(shown) <= 200
        assert "\n" not in shown
    assert f"load factor {asp.first_yield(field).load_factor:.3g}" in repr(asp.first_yield(field))


def _tractions() -> asp.stresses.Tractions:
    grid = asp.Grid((8, 8), (1e-8, 1e-8))
    return asp.stresses.Tractions(grid, np.full(grid.shape, 1e6))


def test_roughness_has_figures_and_a_card(result):
    found = asp.characterise(result.problem.surface)
    for kind in ("", "material_ratio", "heights"):
        ax = Figure().add_subplot()
        assert found.plot(kind, ax) is ax
        assert ax.has_data()
    assert "<img" in found._repr_html_()
    with refused(asp.InputError, "figure of a characterisation", "'sound'"):
        found.plot("sound", Figure().add_subplot())


def test_cards_are_closed_html_with_a_small_picture(result, field):
    for thing in things(result, field):
        html = thing._repr_html_()
        open_tags: list[str] = []
        parser = HTMLParser()
        parser.handle_starttag = lambda tag, attrs, tags=open_tags: tags.append(tag) if tag != "img" else None
        parser.handle_endtag = lambda tag, tags=open_tags: tags.pop()
        parser.feed(html)
        assert open_tags == []
        assert "<two>" not in html
        picture = Image.open(io.BytesIO(base64.b64decode(html.split("base64,")[1].split("'")[0])))
        assert max(picture.size) <= 900
        assert len(html) < 150_000


@pytest.mark.parametrize("kind", ["", "pressure", "gap", "contact", "section", "histogram"])
def test_results_draw_on_given_axes(result, kind):
    ax = Figure().add_subplot()
    assert result.plot(kind, ax) is ax
    assert ax.has_data()


def test_surfaces_and_fields_draw_on_given_axes(result, field):
    ax = Figure().add_subplot()
    assert result.problem.surface.plot(ax=ax) is ax
    ax = Figure().add_subplot()
    field.plot("sqrt_J2", ax, plane=1)
    assert "√J2" in ax.child_axes[0].get_ylabel()
    ax = Figure().add_subplot()
    things(result, field)[-1].plot("shear_xz", ax)
    assert ax.get_ylabel().startswith("depth")


def test_load_paths_and_profiles_draw_on_given_axes(result):
    path = asp.solve(result.problem, asp.History([asp.MeanPressure(5e7), asp.MeanPressure(1e8)]))
    profile = asp.stress(result, asp.stresses.depths_through(result.problem.body, 2e-7), on=asp.stresses.DepthProfile())
    for thing in (path, profile):
        ax = Figure().add_subplot()
        assert thing.plot(ax=ax) is ax
        assert ax.has_data()


def test_without_axes_a_figure_of_pyplot_is_made(result):
    matplotlib.use("Agg")
    from matplotlib import pyplot

    try:
        assert result.plot().figure in map(pyplot.figure, pyplot.get_fignums())
        assert result.problem.surface.plot("view").name == "3d"
    finally:
        pyplot.close("all")


def tables() -> list[object]:
    rough = asp.roughness_of(asp.Surface(np.random.default_rng(1).normal(size=(32, 32)) * 1e-9, 1e-8))
    theory = asp.theories.GreenwoodWilliamson.from_roughness(rough, E_star=1e11)
    sphere = asp.theories.HertzPoint(1e11, 1e-3)
    answers = [theory.at_pressure(np.geomspace(1e6, 1e8, 20)), sphere.at_load(1.0), sphere.at_load([1.0, 2.0])]
    return [asp.solids.materials(), liquids(), rough, *answers]


def test_lists_and_answers_of_theories_are_tables():
    """One row a point or a substance, quantities with their units; long curves are shortened."""
    materials, _, rough, curve, one, two = tables()
    assert len(materials._repr_html_().split("<tr>")) == 2 + len(materials)
    assert re.search(r"steel\s+210 GPa\s+0.3", repr(materials))
    assert materials == tuple(materials)
    assert re.search(rf"rms height\s+{show(rough.rms_height, 'm')}", repr(rough))
    assert 10 <= len(repr(curve).splitlines()) <= 14
    assert "1 MPa" in curve._repr_html_()
    assert len(repr(two).splitlines()) == 4
    assert re.search(r"approach\s+383.2 nm", repr(one))
    asked = asp.theories.evaluate(asp.theories.HertzPoint(1e11, 1e-3), load=[1.0, 2.0])
    assert re.search(r"2 N\s+608.2 nm", repr(asked))
    for thing in (*tables(), asked):
        html = thing._repr_html_()
        assert html.count("<td") == html.count("</td>") > 0
        assert max(map(len, repr(thing).splitlines())) <= 160


def test_every_answer_of_a_theory_shows_itself_as_a_table():
    for theory in (theory for family in FAMILIES.values() for theory in family):
        for way in ways_of(theory):
            method = getattr(theory, way.method)
            answer = vars(sys.modules[method.__module__])[method.__annotations__["return"]]
            assert issubclass(answer, Tabled), answer


BACKEND = """
import matplotlib
from matplotlib.backends.backend_agg import FigureCanvas, new_figure_manager
from matplotlib.backends.backend_agg import show

matplotlib.interactive(True)
"""
"""A backend that does to pyplot what that of notebooks does when it is loaded, at the first
figure."""

SURFACE = "import numpy as np, asperity as asp\nsurface = asp.Surface(np.eye(8) * 1e-9, 1e-7)\n"


def test_the_first_figure_leaves_pyplot_as_its_backend_has_switched_it(tmp_path):
    """Else notebooks show the first figure alone: what is not interactive when it is made is not
    shown."""
    (tmp_path / "switching.py").write_text(BACKEND)
    code = SURFACE + "surface.plot()\nimport matplotlib\nassert matplotlib.is_interactive()\n"
    paths = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    environment = {**os.environ, "MPLBACKEND": "module://switching", "PYTHONPATH": paths}
    subprocess.run([sys.executable, "-c", code], env=environment, check=True, timeout=120)


def test_a_kernel_shows_every_figure():
    """In a fresh kernel, with figures of pyplot between those of the package."""
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    nbformat = pytest.importorskip("nbformat")
    cells = [
        SURFACE,
        "surface.plot()",
        "surface.plot()",
        "from matplotlib import pyplot\npyplot.plot([1, 2])",
        "surface",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in cells])
    nbclient.NotebookClient(notebook, timeout=120).execute()
    pictures = [["image/png" in output.get("data", ()) for output in cell.outputs] for cell in notebook.cells]
    assert [sum(shown) for shown in pictures] == [0, 1, 1, 1, 0]
    assert "<img" in notebook.cells[-1].outputs[0]["data"]["text/html"]


def test_labels_of_a_new_figure_lie_inside_it(result):
    from matplotlib import pyplot

    path = asp.solve(result.problem, asp.History.ramps(asp.MeanPressure, [1e8, 0.0], steps=2))
    try:
        for axes in (path.plot("load_loop"), result.plot(), result.plot("section")):
            axes.figure.canvas.draw()
            frame = axes.figure.bbox.padded(1.0)
            for label in (axes.xaxis.label, axes.yaxis.label):
                box = label.get_window_extent()
                assert frame.contains(*box.min)
                assert frame.contains(*box.max)
    finally:
        pyplot.close("all")


def test_menisci_of_a_wet_contact_are_drawn_and_dry_ones_refused(result):
    film = asp.LiquidFilm.of(asp.liquid("water"), 5e-10)
    wet = asp.solve(asp.ContactProblem(result.problem.surface, asp.material("DLC"), film=film), asp.MeanPressure(1e8))
    ax = Figure().add_subplot()
    assert wet.plot("menisci", ax) is ax
    assert ax.has_data()
    with refused(asp.InputError, "problem of the result"):
        result.plot("menisci", Figure().add_subplot())


def test_unknown_figures_are_refused(result, field):
    subjects = "figure of a surface", "figure of a result", "stress to draw", "stress to draw"
    for thing, subject in zip(things(result, field), subjects, strict=True):
        with refused(asp.InputError, subject, "'sound'"):
            thing.plot("sound", Figure().add_subplot())
