"""Pictures of stresses: depth downwards, jumps at interfaces, units, refusals."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from catalogue import oblong
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from refusals import refused

import asperity as asp
from asperity import plots
from asperity.physics.stress import figures

BODY = asp.Layered([asp.Layer(asp.Elastic(280e9, 0.25, name="DLC"), 50e-9)], asp.Elastic(70e9, 0.33, name="Al-Mg"))


@pytest.fixture(scope="module")
def contact() -> asp.ContactResult:
    return asp.solve(asp.ContactProblem(oblong(), BODY), asp.MeanPressure(2e8))


@pytest.fixture
def ax() -> Axes:
    figure = Figure()
    FigureCanvasAgg(figure)
    return figure.add_subplot()


DEPTHS = asp.stresses.depths_through(BODY, 200e-9, per_region=5)


@pytest.fixture(
    scope="module", params=[asp.stresses.Section(y="max"), asp.stresses.Section(x="max")], ids=["along x", "along y"]
)
def section(request, contact) -> asp.stresses.StressField:
    return asp.stress(contact, DEPTHS, on=request.param, friction=0.3)


@pytest.mark.parametrize("quantity", figures.QUANTITIES)
def test_every_quantity_of_a_section(section, ax, quantity):
    assert plots.plot_stress_section(section, ax, quantity) is ax
    ax.figure.draw_without_rendering()
    bottom, top = ax.get_ylim()
    assert bottom == pytest.approx(200.0)
    assert top == 0.0
    axis = section.dims[1]
    assert ax.get_xlabel().startswith(f"{axis} (")
    assert ax.get_ylabel() == "depth (nm)"
    (interface,) = [line for line in ax.lines if line.get_linestyle() == "-" and len(line.get_ydata()) == 2]
    assert interface.get_ydata()[0] == pytest.approx(50.0)
    (bar,) = ax.child_axes
    words = bar.get_ylabel().split()  # long labels are broken in lines
    assert words[:-1] == figures.QUANTITIES[quantity].label.split()
    assert {text.get_text() for text in ax.texts} == {"DLC", "Al-Mg"}
    low, high = bar.get_ylim()
    values = getattr(section, quantity)
    if quantity not in figures.MAGNITUDES:
        assert low == pytest.approx(-high)
    else:
        assert low == 0.0
        assert high >= values.max() * 1e-9


def test_the_cross_is_at_the_largest_value(contact, ax):
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"))
    plots.plot_stress_section(field, ax, "normal_zz")
    (cross,) = [line for line in ax.lines if line.get_marker() == "x"]
    column = int(np.argmin(field.normal_zz[0]))
    assert cross.get_ydata()[0] == 0.0
    assert cross.get_xdata()[0] * 1e-6 == pytest.approx((column + 0.5) * field.spacing[0])


def test_the_cross_of_a_principal_stress_is_at_the_largest_tension(contact, ax):
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"), friction=0.5)
    plots.plot_stress_section(field, ax, "principal_tensile")
    (cross,) = [line for line in ax.lines if line.get_marker() == "x"]
    plane, column = np.unravel_index(field.principal_tensile.argmax(), field.principal_tensile.shape)
    assert cross.get_ydata()[0] == pytest.approx(field.depth[plane] * 1e9)
    assert cross.get_xdata()[0] * 1e-6 == pytest.approx((column + 0.5) * field.spacing[0])


def test_signed_stresses_are_white_about_zero(contact, ax):
    """No contour at zero, whose line would follow rounding; colours of either sign are mirror
    images."""
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"), friction=0.5)
    plots.plot_stress_section(field, ax, "shear_xz")
    levels = ax.collections[0].levels
    assert np.abs(levels).min() > 0.01 * levels.max()
    np.testing.assert_allclose(levels, -levels[::-1])
    below, white, above = ax.collections[0].to_rgba([levels[0], 0.0, levels[-1]])
    assert white[:3].min() > 0.9
    assert below[2] > below[0]
    assert above[0] > above[2]


def test_compression_does_not_drown_the_tension(contact, ax):
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"), friction=0.5)
    assert -field.principal_tensile.min() > 1.5 * field.principal_tensile.max()
    plots.plot_stress_section(field, ax, "principal_tensile")
    filled = ax.collections[0]
    largest = field.principal_tensile.max()
    assert min(abs(filled.levels[-1] * unit / largest - 1.1) for unit in (1e6, 1e9)) < 0.2
    assert filled.extend == "min"
    white = filled.to_rgba([0.0])[0]
    assert white[:3].min() > 0.9


def test_a_line_has_no_place_along_y(ax):
    profile = asp.Surface(asp.surfaces.sliced(oblong(), y="middle").heights, 1e-7, 1.0)
    result = asp.solve(asp.ContactProblem(profile, BODY, boundary=asp.FreeLine()), asp.Force(1.0))
    plots.plot_stress_section(asp.stress(result, DEPTHS, on=asp.stresses.Section(y="max")), ax)
    assert "at y" not in ax.get_xlabel()
    ax.clear()
    plots.plot_stress_profile(asp.stress(result, DEPTHS, on=asp.stresses.DepthProfile()), ax)
    assert "at x = " in ax.get_xlabel()
    assert "y =" not in ax.get_xlabel()
    ax.clear()
    plots.plot_contact(result, ax)
    assert ax.get_xlabel() == "x (µm)"
    assert (ax.get_ylabel(), len(ax.get_yticks())) == ("", 0)
    ax.clear()
    assert plots.plot_section(result, ax).get_xlabel() == "x (µm)"


def test_logarithmic_steps_of_signed_stresses(contact, ax):
    """Equal factors on both sides of zero, which is white; small stresses of either sign are told
    apart."""
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"), friction=0.5)
    plots.plot_stress_section(field, ax, "shear_xz", log=True)
    filled = ax.collections[0]
    half = filled.levels[filled.levels > 0.0]
    np.testing.assert_allclose(filled.levels, np.concatenate([-half[::-1], half]), rtol=1e-12)
    np.testing.assert_allclose(half[1:] / half[:-1], 100.0 ** (1.0 / (half.size - 1)), rtol=1e-12)
    below, white, above = filled.to_rgba([-0.1 * half[-1], 0.0, 0.1 * half[-1]])
    assert white[:3].min() > 0.9
    assert below[2] > below[0]
    assert above[0] > above[2]


def test_logarithmic_steps(contact, ax):
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"))
    plots.plot_stress_section(field, ax, "sqrt_J2", log=True)
    ax.figure.canvas.draw()
    low, high = ax.child_axes[0].get_ylim()
    assert high / low == pytest.approx(100.0)
    labels = [text.get_text() for text in ax.child_axes[0].get_yticklabels()]
    assert labels
    assert not any("e" in label for label in labels)


def test_sections_as_deep_as_long_are_to_scale(ax):
    grid = asp.Grid((33, 33), (1e-6, 1e-6))
    x, y = grid.centred_coordinates()
    sphere = asp.Surface(-(x**2 + y**2) / 2e-3, 1e-6, 1e-6)
    result = asp.solve(asp.ContactProblem(sphere, asp.Elastic(200e9, 0.3), boundary=asp.Free()), asp.Force(0.5))
    plots.plot_stress_section(asp.stress(result, np.linspace(0, 2e-5, 9), on=asp.stresses.Section(y="max")), ax)
    assert ax.get_aspect() == pytest.approx(1.0)
    assert not ax.texts  # one region needs no name


def test_profiles_break_at_interfaces(contact, ax):
    field = asp.stress(contact, DEPTHS, on=asp.stresses.DepthProfile(), friction=0.3)
    assert plots.plot_stress_profile(field, ax, ("normal_xx", "von_mises")) is ax
    ax.figure.canvas.draw()
    assert ax.yaxis_inverted()
    curves = [line for line in ax.lines if len(line.get_ydata()) == 6]
    assert len(curves) == 4  # two quantities in two regions
    upper, lower = curves[0], curves[1]
    assert upper.get_ydata()[-1] == lower.get_ydata()[0] == pytest.approx(50.0)
    jump = (upper.get_xdata()[-1] - lower.get_xdata()[0]) / (field.normal_xx[5] - field.normal_xx[6])
    assert jump in (pytest.approx(1e-6), pytest.approx(1e-9))
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["σxx", "von Mises stress"]


@pytest.mark.parametrize(
    ("plane", "words"), [(0, "surface"), (1, "depth 10 nm"), (5, "depth 50 nm, above the interface")]
)
def test_maps_of_planes(contact, ax, plane, words):
    field = asp.stress(contact, DEPTHS, friction=0.3)
    plots.plot_stress_map(field, ax, "shear_xz", plane=plane)
    ax.figure.canvas.draw()
    (image,) = ax.images
    low, high = image.get_clim()
    assert low == pytest.approx(-high)
    drawn = np.asarray(image.get_array()).T
    np.testing.assert_allclose(drawn / np.abs(drawn).max(), field.shear_xz[plane] / np.abs(field.shear_xz[plane]).max())
    label = ax.child_axes[0].get_ylabel() or ax.child_axes[0].get_xlabel()
    assert label.startswith(f"σxz, {words}")


def test_layers_of_one_name_are_one_and_names_of_thin_layers_stay_apart(ax):
    film, base = asp.Elastic(280e9, 0.25, name="film"), asp.Elastic(70e9, 0.33, name="base")
    thin = [asp.Layer(asp.Elastic(300e9, 0.2, name=name), 1e-9) for name in ("a", "b", "c")]
    body = asp.Layered([*thin, *asp.solids.graded(film, base, 40e-9, sublayers=6)], base)
    result = asp.solve(asp.ContactProblem(oblong(), body), asp.MeanPressure(2e8))
    field = asp.stress(
        result, asp.stresses.depths_through(body, 100e-9, per_region=1), on=asp.stresses.Section(y="max")
    )
    plots.plot_stress_section(field, ax, "von_mises")
    ax.figure.canvas.draw()
    *texts, exaggeration = ax.texts
    within, beside = texts[:2], texts[2:]  # thick regions hold their names, thin ones have them beside
    assert [text.get_text() for text in texts] == ["graded film - base", "base", "a", "b", "c"]
    tops, outside = {"graded film - base": (3.0, 43.0), "base": (43.0, 100.0)}, ax.get_window_extent()
    for text in within:
        low, high = (outside.y1 - outside.height * depth / 100.0 for depth in reversed(tops[text.get_text()]))
        assert low < text.get_window_extent().y0 < text.get_window_extent().y1 < high
    bar = ax.child_axes[0].get_window_extent()
    assert all(
        outside.x1 < Text.get_window_extent(text).x0 < Text.get_window_extent(text).x1 < bar.x0 for text in beside
    )
    times = (outside.height / 100e-9) / (outside.width / (field.x[-1] - field.x[0]))
    assert exaggeration.get_text() == f"depth × {float(f'{times:.2g}'):g}"
    lines = [line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == "-" and len(line.get_ydata()) == 2]
    assert lines == pytest.approx([1.0, 2.0, 3.0, 43.0])
    boxes = [Text.get_window_extent(text) for text in beside]
    assert all(upper.y0 > lower.y0 + 0.8 * lower.height for upper, lower in pairwise(boxes))
    assert all(outside.y0 <= box.y0 and box.y1 <= outside.y1 for box in boxes)


def test_refusals(contact, ax):
    section = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"))
    whole, profile = asp.stress(contact, [0.0]), asp.stress(contact, DEPTHS, on=asp.stresses.DepthProfile())
    with refused(asp.InputError, "stress to draw"):
        plots.plot_stress_section(section, ax, "colour")
    with refused(asp.InputError, "field of a stress section"):
        plots.plot_stress_section(whole, ax)
    with refused(asp.InputError, "field of a stress section"):
        plots.plot_stress_section(asp.stress(contact, [0.0, 50e-9], on=asp.stresses.Section(y="max")), ax)
    with refused(asp.InputError, "field of a stress profile"):
        plots.plot_stress_profile(section, ax)
    with refused(asp.InputError, "field of a stress map"):
        plots.plot_stress_map(profile, ax)
    with refused(asp.InputError, "plane of a stress map", "0"):
        plots.plot_stress_map(whole, ax, plane=1)
