"""The figures of the stresses that were asked for: which there are, what they show, close-ups of
long sections."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from contact_cases import rough
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import asperity as asp
import asperity.physics.stress.figures as stress_plots
from asperity.core.units import show
from asperity.physics.stress.figures import (
    CLOSE_UP,
    close_up,
    line_figures,
    map_figure,
    plot_stress_section,
    view_figure,
)
from asperity.physics.stress.survey import StressRequest, StressSurvey, WantedProfile, WantedSection, survey

BODY = asp.Layered([asp.Layer(asp.Elastic(3e9, 0.25, name="film"), 1e-6)], asp.Elastic(1e9, 0.3, name="base"))


def surveyed(size: int) -> StressSurvey:
    surface = rough((size, 12), 3, spacing=(1e-6, 1e-6), power=2.0)
    surface = asp.Surface(surface.heights * 1e-7, 1e-6, periodic=True)
    result = asp.solve(asp.ContactProblem(surface, BODY), asp.MeanPressure(2e6))
    sections, profiles = (WantedSection("y", "pressure"), WantedSection("x", 3e-6)), (WantedProfile("max", "max"),)
    return survey(StressRequest(0.3, sections=sections, profiles=profiles, depths=(0.0, 1e-6), deepest=4e-6), result)


@pytest.fixture(scope="module")
def long() -> StressSurvey:
    return surveyed(96)


def test_every_section_and_profile_has_its_figures(long: StressSurvey) -> None:
    figures = list(line_figures(long, long.result.problem.boundary))
    names = [figure.name for figure in figures]
    assert len(set(names)) == len(names)
    section = [name for name in names if name.startswith("stress_section_1")]
    assert section == [
        f"stress_section_1_{quantity}{part}"
        for quantity in ("von_mises", "principal_tensile", "shear_xz")
        for part in ("", "_near")
    ]
    assert "stress_section_2_shear_yz" in names
    assert names[-1] == "stress_profile_1"
    assert all(figure.picture.startswith(b"\x89PNG") for figure in figures)
    titles = {figure.name: figure.title for figure in figures}
    row = int(np.unravel_index(long.result.pressure.argmax(), long.result.pressure.shape)[1])
    assert titles["stress_section_1_von_mises"] == f"Von Mises stress at y = {show((row + 0.5) * 1e-6, 'm')}"
    assert titles["stress_section_1_shear_xz"].startswith("σxz at y")
    captions = {figure.name: figure.caption for figure in figures}
    assert captions["stress_section_1_von_mises"].endswith("Steps are equal factors.")
    assert "Red is tension" in captions["stress_section_1_principal_tensile"]


def test_close_ups_hold_the_maximum_and_short_sections_have_none(long: StressSurvey) -> None:
    for section in long.sections[:1]:
        for quantity in section.quantities:
            near = close_up(section.field, quantity)
            assert near is not None
            values, part = getattr(section.field, quantity), getattr(near, quantity)
            assert part.shape == (len(section.field.planes), near.x.size)
            assert part.max() == values.max() or np.abs(part).max() == np.abs(values).max()
            assert near.x[-1] - near.x[0] <= CLOSE_UP * section.field.depth[-1] * (1.0 + 1e-9)
            first = int(np.flatnonzero(section.field.x == near.x[0])[0])
            np.testing.assert_array_equal(part, values[:, first : first + near.x.size])
    short = surveyed(16)
    assert close_up(short.sections[1].field, "von_mises") is None
    names = [figure.name for figure in line_figures(short, short.result.problem.boundary)]
    assert not any(name.startswith("stress_section_2") and name.endswith("near") for name in names)


def test_close_up_wraps_over_the_period_and_its_colours_reach_the_maximum(long: StressSurvey) -> None:
    field = long.sections[0].field
    step, n = field.spacing[0], field.x.size
    at = round(field.peak(field.von_mises).x / step)
    moved = replace(field, tensor=field.tensor.map(lambda part: np.roll(part, -at, axis=1)))  # the maximum at x = 0
    near = close_up(moved, "von_mises", wraps=True)
    assert near is not None
    assert near.x[0] < 0.0 < near.x[-1]
    assert near.peak(near.von_mises).x == 0.0 == near.x[near.x.size // 2]
    numbers = np.rint(near.x / step).astype(int)
    np.testing.assert_array_equal(near.von_mises, moved.von_mises[:, numbers % n])
    ax = Figure().add_subplot()
    plot_stress_section(near, ax, "von_mises")
    (bar,) = ax.child_axes
    top = bar.get_ylim()[1] * {"MPa": 1e6, "GPa": 1e9, "kPa": 1e3}[bar.get_ylabel().rpartition("(")[2][:-1]]
    assert near.von_mises.max() == field.von_mises.max() <= top


def test_maps_of_planes(long: StressSurvey) -> None:
    planes = enumerate(long.planes(long.request.depths), start=1)
    figures = [map_figure(plane, number, long.result.problem.boundary) for number, plane in planes]
    assert [figure.name for figure in figures] == ["stress_plane_1", "stress_plane_2", "stress_plane_3"]
    assert [figure.title for figure in figures] == [
        "Von Mises stress at the surface",
        "Von Mises stress at a depth of 1 µm, just above the interface",
        "Von Mises stress at a depth of 1 µm, just below the interface",
    ]
    assert figures[2].caption.endswith("in base.")
    assert all(figure.picture.startswith(b"\x89PNG") for figure in figures)


def test_the_view_in_space_is_of_the_plane_of_the_largest_stress(long: StressSurvey) -> None:
    planes = list(long.planes(long.request.depths))
    largest = [float(plane.von_mises.max()) for plane in planes]
    figure = view_figure(planes)
    assert figure is not None
    assert (
        figure.title == f"Von Mises stress in space at {('the surface', *['a depth of 1 µm'] * 2)[np.argmax(largest)]}"
    )
    assert figure.picture.startswith(b"\x89PNG")
    deeper = view_figure(planes[1:])
    assert deeper is not None
    assert deeper.title.endswith("a depth of 1 µm")
    assert view_figure([]) is None


def test_maps_of_planes_show_their_maximum_enlarged(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[Axes] = []
    monkeypatch.setattr(stress_plots, "png", lambda draw, size: drawn.append(draw(Figure(size).add_subplot())) or b"")
    surface = asp.generate.sphere(asp.Grid((64, 48), (1e-7, 1e-7)), radius=2e-5)
    result = asp.solve(asp.ContactProblem(surface, asp.Elastic(1e9, 0.3), boundary=asp.Free()), asp.Force(1e-7))
    plane = asp.stress(result, depths=[1e-7])
    stress = plane.von_mises[0]
    there = int(np.unravel_index(stress.argmax(), stress.shape)[0])
    for move in (0, -there):  # where it is, and at the border, over which the window wraps
        moved = replace(plane, tensor=plane.tensor.map(lambda part, move=move: np.roll(part, move, axis=1)))
        figure = map_figure(moved, 1, asp.Periodic())
        assert figure.drawing.enlarged
        assert figure.caption.endswith("enlarged.")
        (beside,) = [axes for axes in drawn[-1].child_axes if axes.get_title(loc="left") == "about the maximum"]
        assert any("depth 100 nm" in axes.get_ylabel().replace("\n", " ") for axes in drawn[-1].child_axes)
        values, whole = (np.asarray(axes.images[0].get_array()) for axes in (beside, drawn[-1]))
        assert values.max() == whole.max()
        assert values.size < whole.size / 4
        low, high = beside.get_xlim()
        at = 0.1 * (there + move + 0.5)  # µm
        assert low < at < high or low < at + 6.4 < high
    flat = replace(plane, tensor=plane.tensor.map(np.ones_like))
    assert not map_figure(flat, 1, asp.Free()).drawing.enlarged
