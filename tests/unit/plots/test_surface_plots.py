"""Figures of a surface show its numbers, in stated units, whatever the surface."""

from __future__ import annotations

import io
import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from PIL import Image
from refusals import refused

import asperity as asp
from asperity import plots
from asperity.core.errors import OutputError

NAMES = (
    "heights",
    "view",
    "distribution",
    "material_ratio",
    "spectrum",
    "spectrum_map",
    "autocorrelation",
    "scale_dependence",
    "summits",
)


def rough(shape: tuple[int, int] = (96, 64), *, holes: bool = False, periodic: bool = False) -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2e-9), hurst=0.8, rolloff_wavelength=2e-7, shortest_wavelength=0.0
    )
    surface = asp.generate.gaussian(asp.Grid(shape, (1e-8, 2e-8)), spectrum, seed=1)
    heights = np.array(surface.heights)
    if holes:
        heights[3:6, 7:9] = np.nan
    return asp.Surface(heights, 1e-8, 2e-8, periodic=periodic)


MAKERS = {
    "periodic": lambda: rough(periodic=True),
    "with holes": lambda: rough(holes=True),
    "profile": lambda: asp.Surface(rough((200, 64)).heights[:, :1], 1e-8),
    "column": lambda: asp.Surface(rough((64, 200)).heights[:1], 1e-8),
    "slender": lambda: asp.Surface(rough((64, 200)).heights[:4], 1e-8),
    "flat": lambda: asp.Surface(np.zeros((20, 30)), 1e-8),
    "point": lambda: asp.Surface([[1.0]], 1e-8),
}


@pytest.fixture(scope="module", params=MAKERS)
def found(request: pytest.FixtureRequest) -> tuple[str, asp.roughness.Characterisation]:
    return request.param, asp.characterise(MAKERS[request.param]())


@pytest.fixture(scope="module")
def measured() -> asp.roughness.Characterisation:
    return asp.characterise(rough())


@pytest.fixture
def ax() -> Axes:
    figure = Figure()
    FigureCanvasAgg(figure)
    return figure.add_subplot()


RENDERED = ("with holes", "profile", "flat", "point")
"""Surfaces whose figures are all rendered, besides the measured one; of the others those are whose
size follows the map."""


@pytest.mark.parametrize("plot", plots.SURFACE_PLOTS, ids=lambda plot: plot.name)
def test_every_figure_of_every_surface_is_a_picture(plot, found):
    name, characterised = found
    if plot.kind == "curve" and name not in RENDERED:
        figure = Figure()
        FigureCanvasAgg(figure)
        plot.draw(characterised, figure.add_subplot())
        return
    is_a_picture(plots.render(plot, characterised))


def is_a_picture(content: bytes) -> None:
    picture = Image.open(io.BytesIO(content))
    assert picture.format == "PNG"
    assert min(picture.size) > 200
    assert max(picture.size) < 2400
    assert np.asarray(picture.convert("L")).std() > 1.0  # something is drawn


def test_the_spectrum_by_direction_has_its_waves_where_they_are(ax: Axes) -> None:
    """Waves of 4 and -3 periods: two points of the map, opposite each other."""
    nx, ny, pixel = 24, 18, 1e-8
    x, y = np.arange(nx)[:, None] / nx, np.arange(ny)[None, :] / ny
    surface = asp.Surface(1e-9 * np.cos(2.0 * np.pi * (4 * x - 3 * y)), pixel, periodic=True)
    plots.plot_spectrum_map(asp.roughness.characterise(surface), ax)
    (image,) = ax.images
    values, (left, right, low, high) = np.asarray(image.get_array()), image.get_extent()
    step_x, step_y = (right - left) / nx, (high - low) / ny
    rows, columns = np.nonzero(values > 0.5 * values.max())
    unit = 2.0 * np.pi / (nx * pixel) / step_x  # rad/m of one of the axis
    found = sorted(zip(left + (columns + 0.5) * step_x, low + (rows + 0.5) * step_y, strict=True))
    waves = [(unit * qx, unit * qy) for qx, qy in found]
    expected = 2.0 * np.pi * np.array([4 / (nx * pixel), -3 / (ny * pixel)])
    np.testing.assert_allclose(waves, [-expected, expected], rtol=1e-12)


def test_the_standard_set(measured, tmp_path, monkeypatch):
    paths = plots.save_roughness_plots(measured, tmp_path / "pictures")
    assert tuple(path.stem for path in paths) == NAMES
    for path in paths:
        is_a_picture(path.read_bytes())
    monkeypatch.setattr("asperity.plots.picture.png", lambda *_, **__: b"new")
    with refused(OutputError, "output file"):
        plots.save_roughness_plots(measured, tmp_path / "pictures")
    plots.save_roughness_plots(measured, tmp_path / "pictures", overwrite=True)
    assert {path.read_bytes() for path in paths} == {b"new"}
    (tmp_path / "file").write_text("")
    with refused(OutputError, "folder of the plots"):
        plots.save_roughness_plots(measured, tmp_path / "file" / "pictures")


def test_distribution_is_that_of_the_heights(measured, ax):
    plots.plot_height_distribution(measured, ax)
    assert ax.get_xlabel() == "height (nm)"
    (normal,) = ax.lines
    x, y = normal.get_data()
    assert np.max(y) == pytest.approx(1.0 / (math.sqrt(2.0 * math.pi) * measured.heights.Sq * 1e9), rel=1e-3)
    assert np.trapezoid(y, x) == pytest.approx(1.0, abs=0.02)
    assert f"{measured.heights.Ssk:.2f}" in ax.get_title(loc="right")


def test_material_ratio_runs_from_peak_to_valley(measured, ax):
    plots.plot_material_ratio(measured, ax)
    curve = next(line for line in ax.lines if line.get_label() == "measured")
    x, y = curve.get_data()
    assert (x[0], x[-1]) == (0.0, 100.0)
    assert y[0] == pytest.approx(measured.heights.Sp * 1e9)
    assert y[-1] == pytest.approx(-measured.heights.Sv * 1e9)
    core_line = next(line for line in ax.lines if line.get_label() == "core line")
    top, bottom = core_line.get_ydata()
    assert top - bottom == pytest.approx(measured.functional.Sk * 1e9)


def test_spectrum_in_units_of_the_axes(measured, ax):
    plots.plot_spectrum(measured, ax)
    assert "rad/nm" in ax.get_xlabel()
    curve = next(line for line in ax.lines if line.get_label() == "measured")
    q, psd = curve.get_data()
    assert q == pytest.approx(measured.spectra.radial.q * 1e-9)
    assert psd == pytest.approx(measured.spectra.radial.psd * 1e36)
    model = next(line for line in ax.lines if "q^" in str(line.get_label()))
    q, psd = model.get_data()
    assert psd == pytest.approx(measured.spectra.fit.model.psd(np.asarray(q) * 1e9) * 1e36)
    assert q[0] == pytest.approx(measured.spectra.fit.first * 1e-9)
    assert q[-1] == pytest.approx(measured.spectra.fit.last * 1e-9)


def test_autocorrelation_starts_at_one_and_meets_its_length(measured, ax):
    plots.plot_autocorrelation(measured, ax)
    along_x = next(line for line in ax.lines if str(line.get_label()).startswith("along x"))
    lag, value = along_x.get_data()
    assert value[0] == pytest.approx(1.0)
    length = measured.spatial.beta_e_x * 1e9
    assert np.interp(length, lag, value) == pytest.approx(math.exp(-1.0), rel=1e-9)
    assert f"{length:.3g}" in str(along_x.get_label())


def test_scale_dependence_starts_at_the_slope_of_the_map(ax):
    found = asp.characterise(rough(), tip_radius=5e-7)
    plots.plot_scale_dependence(found, ax)
    along_x = next(line for line in ax.lines if line.get_label() == "slope along x")
    length, slope = along_x.get_data()
    assert length[0] == pytest.approx(10.0)  # nm
    assert slope[0] == pytest.approx(math.sqrt(found.moments.difference.m2_x))
    assert any("tip cut-off" in str(line.get_label()) for line in ax.lines) == (
        0.0 < found.sampling.tip_cutoff < math.inf
    )


def test_summits_lie_where_they_are(measured, ax):
    plots.plot_summits(measured, ax)
    dots = [item for item in ax.collections if isinstance(item, PathCollection)]
    places = np.asarray(dots[0].get_offsets())
    summits = measured.curves.summits
    assert places.shape == (summits.count, 2)
    assert places[:, 0] == pytest.approx((summits.i + 0.5) * 0.01)  # µm
    assert places[:, 1] == pytest.approx((summits.j + 0.5) * 0.02)
    assert f"{summits.count} summits" in ax.get_title(loc="left")


def test_view_shows_the_heights_the_right_way_round(monkeypatch):
    figure = Figure()
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(projection="3d")
    drawn = {}
    monkeypatch.setattr(axes, "plot_surface", lambda x, y, z, **options: drawn.update(x=x, y=y, z=z, **options))
    heights = np.zeros((40, 30))
    heights[30, 5] = 6e-9  # large x, small y
    plots.plot_surface_view(asp.Surface(heights, 1e-8), axes)
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_zlabel()) == ("x (nm)", "y (nm)", "height (nm)")
    at = np.unravel_index(np.argmax(drawn["z"]), drawn["z"].shape)
    assert (drawn["x"][at], drawn["y"][at]) == pytest.approx((300.0, 50.0))
    assert drawn["z"][at] == pytest.approx(6.0 * (1.0 - 1.0 / 1200.0))
    assert drawn["facecolors"].shape == (40, 30, 4)


def test_thinned_views_keep_the_mean_of_blocks():
    from asperity.plots.surface import _thinned

    surface = asp.Surface(np.arange(400.0 * 200.0).reshape(400, 200), 1e-9, 2e-9)
    heights, grid = _thinned(surface)
    assert max(grid.shape) <= 180
    assert grid.shape == (133, 66)
    assert grid.spacing == pytest.approx((3e-9, 6e-9))
    assert heights[0, 0] == pytest.approx(surface.heights[:3, :3].mean() - surface.heights.mean())


def test_colours_stay_those_of_the_caller(measured, tmp_path: Path):
    from matplotlib import rcParams

    before = dict(rcParams)
    plots.render(plots.SURFACE_PLOTS[0], measured)
    assert dict(rcParams) == before


@pytest.mark.parametrize("shape", [(40, 30), (30, 40)])
def test_view_says_how_much_heights_are_exaggerated(shape):
    figure = Figure()
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(projection="3d")
    heights = 1e-9 * np.random.default_rng(1).standard_normal(shape)
    plots.plot_surface_view(asp.Surface(heights, 1e-8), axes)
    (text,) = [item.get_text() for item in axes.texts if "×" in item.get_text()]
    sides = np.ptp([axes.get_xlim(), axes.get_ylim()], axis=1)  # nm, as heights
    across, up = sides.max(), np.ptp(axes.get_zlim())
    assert text == f"heights × {float(f'{0.18 * across / up:.2g}'):g}"
