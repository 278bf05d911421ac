"""Figures show the numbers of the result, the right way up and in stated units."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from PIL import Image
from refusals import refused

import asperity as asp
from asperity import plots
from asperity.core.errors import OutputError
from asperity.plots.maps import Look, Window, enlarge, island, plot_field
from asperity.plots.picture import literal, scale

NAMES = (
    *("heights", "pressure", "pressure_log", "contact", "gap", "pressure_view", "section", "histogram"),
    "gap_histogram",
)


@pytest.fixture
def ax() -> Axes:
    figure = Figure()
    FigureCanvasAgg(figure)
    return figure.add_subplot()


def drawn(ax: Axes) -> Axes:
    ax.figure.canvas.draw()
    return ax


def bar_label(ax: Axes) -> str:
    (bar,) = ax.child_axes
    return str(bar.get_ylabel() or bar.get_xlabel())


@pytest.mark.parametrize(
    ("largest", "unit", "symbol", "factor"),
    [
        (5e-9, "m", "nm", 1e-9),
        (1e-6, "m", "µm", 1e-6),
        (0.02, "m", "mm", 1e-3),
        (4e5, "Pa", "kPa", 1e3),
        (2.5e9, "Pa", "GPa", 1e9),
        (0.0, "Pa", "Pa", 1.0),
        (np.nan, "m", "m", 1.0),
    ],
)
def test_prefix_follows_the_magnitude(largest: float, unit: str, symbol: str, factor: float) -> None:
    chosen = scale(np.array([-largest, 0.0]), unit)
    assert chosen.symbol == symbol
    assert chosen.factor == pytest.approx(factor)
    assert chosen(2.0 * factor) == pytest.approx(2.0)


def test_x_is_to_the_right_and_y_is_up(ax: Axes) -> None:
    heights = np.zeros((4, 3))
    heights[3, 0] = 6e-9  # largest x, smallest y
    drawn(plots.plot_heights(asp.Surface(heights, 2e-6, 1e-6), ax))
    image = ax.images[0]
    assert image.origin == "lower"
    assert image.get_extent() == pytest.approx([0.0, 8.0, 0.0, 3.0])
    shown = np.asarray(image.get_array())
    assert shown.shape == (3, 4)
    assert np.unravel_index(shown.argmax(), shown.shape) == (0, 3)
    assert shown.max() - shown.min() == pytest.approx(6.0)
    assert ax.get_aspect() == 1.0
    assert (ax.get_xlabel(), ax.get_ylabel(), bar_label(ax)) == ("x (µm)", "y (µm)", "height (nm)")


def test_missing_points_are_blank(ax: Axes) -> None:
    heights = np.random.default_rng(0).standard_normal((6, 5)) * 1e-6
    heights[2, 3] = np.nan
    drawn(plots.plot_heights(asp.Surface(heights, 1e-6), ax))
    shown = ax.images[0].get_array()
    assert np.argwhere(np.ma.getmaskarray(shown)).tolist() == [[3, 2]]


def test_equal_heights_are_zero_and_not_rounding(ax: Axes) -> None:
    drawn(plots.plot_heights(asp.Surface(np.full((7, 7), 3e-6), 1e-6), ax))
    assert np.all(np.asarray(ax.images[0].get_array()) == 0.0)
    assert bar_label(ax) == "height (m)"


def test_pressure_map_holds_the_pressure(elastic: asp.ContactResult, ax: Axes) -> None:
    drawn(plots.plot_pressure(elastic, ax))
    image = ax.images[0]
    shown = image.get_array()
    np.testing.assert_allclose(shown.filled(0.0), elastic.pressure.T / 1e9)
    np.testing.assert_array_equal(~np.ma.getmaskarray(shown), elastic.contact.T)
    assert bar_label(ax) == "contact pressure (GPa)"
    assert image.get_clim() == pytest.approx((0.0, elastic.max_pressure / 1e9))


def test_logarithmic_pressure_spans_three_decades(elastic: asp.ContactResult, ax: Axes) -> None:
    drawn(plots.plot_pressure(elastic, ax, log=True))
    assert isinstance(ax.images[0].norm, LogNorm)
    low, high = ax.images[0].get_clim()
    assert high / low == pytest.approx(1e3)
    assert high == pytest.approx(elastic.max_pressure / 1e9)


def test_gap_is_blank_in_contact(elastic: asp.ContactResult, ax: Axes) -> None:
    drawn(plots.plot_gap(elastic, ax))
    shown = ax.images[0].get_array()
    np.testing.assert_array_equal(np.ma.getmaskarray(shown), elastic.contact.T)
    assert shown.max() == pytest.approx(elastic.gap.max() / 1e-9)
    assert bar_label(ax) == "gap (nm)"


def test_contact_map_tells_elastic_from_plastic(
    elastic: asp.ContactResult, plastic: asp.ContactResult, ax: Axes
) -> None:
    assert plastic.plastic.any()
    assert not plastic.plastic.all()
    drawn(plots.plot_contact(plastic, ax))
    np.testing.assert_array_equal(np.asarray(ax.images[0].get_array()).T == 2.0, plastic.plastic)
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert texts[2] == f"plastic {100 * plastic.plastic.mean():.3g} %"
    other = Figure().add_subplot()
    plots.plot_contact(elastic, other)
    assert [text.get_text().split()[0] for text in other.get_legend().get_texts()] == ["no", "elastic"]


def test_section_goes_through_the_highest_pressure(elastic: asp.ContactResult, ax: Axes) -> None:
    drawn(plots.plot_section(elastic, ax))
    row = np.unravel_index(elastic.pressure.argmax(), elastic.pressure.shape)[1]
    twin = ax.figure.axes[1]
    np.testing.assert_allclose(twin.lines[0].get_ydata(), elastic.pressure[:, row] / 1e9)
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in ax.lines}
    gap = lines["counter surface"] - lines["deformed rough surface"]
    np.testing.assert_allclose(gap * 1e-9, elastic.gap[:, row], atol=1e-15)
    assert lines["deformed rough surface"].mean() == pytest.approx(0.0, abs=1e-9)
    assert twin.get_ylabel() == "pressure (GPa)"
    assert f"at y = {(row + 0.5) * 10:g} nm" in ax.get_xlabel()


def test_histogram_is_a_density_with_its_marks(plastic: asp.ContactResult, ax: Axes) -> None:
    drawn(plots.plot_pressure_histogram(plastic, ax))
    density, edges, _ = ax.patches[0].get_data()
    assert (density * np.diff(edges)).sum() == pytest.approx(1.0)
    mean, hardness = (line.get_xdata()[0] for line in ax.lines)
    assert mean == pytest.approx(plastic.mean_real_pressure / 1e9)
    assert hardness == pytest.approx(3.0)
    assert ax.get_ylabel() == "probability density (1/GPa)"


def test_gap_histogram_covers_the_open_area(plastic: asp.ContactResult, ax: Axes) -> None:
    drawn(plots.plot_gap_histogram(plastic, ax))
    density, edges, _ = ax.patches[0].get_data()
    middle = 0.5 * (edges[1:] + edges[:-1])
    open_mean = plastic.gap[~plastic.contact].mean()
    assert (density * np.diff(edges) * middle).sum() == pytest.approx(open_mean * 1e9, abs=np.diff(edges)[0] / 2)
    assert ax.get_xlabel() == "gap (nm)"


def test_every_figure_of_every_contact_is_drawn(result: asp.ContactResult) -> None:
    """Rendered where the shape asks for something special; for other shapes all that rendering
    computes before."""
    grid = result.problem.grid
    for plot in plots.PLOTS:
        if 1 in grid.shape or min(grid.shape) == 4:
            assert plots.render(plot, result).startswith(b"\x89PNG")
        else:
            figure = Figure()
            FigureCanvasAgg(figure)
            plot.draw(result, figure.add_subplot(projection="3d" if plot.kind == "view" else None))
            figure.draw_without_rendering()


def test_the_largest_contact_is_enlarged_beside_its_map(ax: Axes) -> None:
    grid = asp.Grid((120, 40), (1e-6, 2e-6))
    there = np.zeros(grid.shape, dtype=bool)
    there[20:22, 10:12] = True  # 2 x 4 µm
    there[118:, 30] = there[:3, 30] = True  # 5 x 2 µm, across the border
    window = island(there, grid, (True, True))
    assert window == Window((104, 22), (32, 16))  # 16 pixels of 2 µm, about x = 120.5 µm
    assert island(there, grid, (False, False)) == Window((5, 3), (32, 16))  # about 21 µm, 22 µm
    assert island(np.ones(grid.shape, dtype=bool), grid, (True, True)) is None
    values = np.arange(4800.0).reshape(grid.shape)
    plot_field(values, grid, ax, Look("m", "height", "cividis"))
    beside = drawn(enlarge(ax, grid, window, "largest contact"))
    np.testing.assert_array_equal(
        np.asarray(beside.images[0].get_array()).T, values[np.arange(104, 136) % 120, 22:38] / 1e3
    )
    assert beside.get_xlim() == pytest.approx((104.0, 136.0))
    assert beside.get_ylim() == pytest.approx((44.0, 76.0))
    assert beside.images[0].get_clim() == ax.images[0].get_clim()
    assert beside.get_window_extent().x0 > ax.child_axes[0].get_tightbbox().x1


@pytest.mark.parametrize("shape", [(24, 16), (60, 16)])
def test_a_colour_bar_with_its_label_stays_in_its_subplot(shape: tuple[int, int]) -> None:
    figure = Figure(figsize=(9.0, 3.5))
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, 2)
    places = [ax.get_window_extent().frozen() for ax in axes]
    for ax, place in zip(axes, places, strict=True):
        plots.plot_heights(asp.Surface(np.random.default_rng(0).standard_normal(shape) * 1e-7, 1e-6), ax)
        figure.canvas.draw()
        box = ax.child_axes[0].get_tightbbox()
        assert box.x1 <= place.x1 + 12.0  # the half of a number at the end of a bar
        assert box.y1 <= place.y1 + 2.0


def test_names_are_drawn_as_they_are(ax: Axes) -> None:
    ax.set_title(literal("$\\frac{$\x1b[31m\n" + 60 * "x"))
    assert drawn(ax).get_title() == "\\$\\frac{\\$\ufffd[31m\ufffd" + 25 * "x" + "…"


def test_files_are_pictures_of_print_size(elastic: asp.ContactResult, tmp_path: Path) -> None:
    before = dict(rcParams)
    paths = plots.save_plots(elastic, tmp_path / "plots")
    assert [path.name for path in paths] == [f"{name}.png" for name in NAMES]
    assert sorted(path.name for path in (tmp_path / "plots").iterdir()) == sorted(path.name for path in paths)
    for path in paths:
        with Image.open(path) as image:
            assert 600 < image.size[0] < 2400
            assert len(image.convert("RGB").getcolors(1 << 20) or []) > 10
    assert dict(rcParams) == before


def test_existing_files_are_kept_unless_overwritten(elastic: asp.ContactResult, tmp_path: Path) -> None:
    (tmp_path / "heights.png").write_text("mine")
    with refused(OutputError, "output file", "heights.png"):
        plots.save_plots(elastic, tmp_path)
    assert (tmp_path / "heights.png").read_text() == "mine"
    plots.save_surface_plot(elastic.problem.surface, tmp_path / "heights.png", overwrite=True)
    assert (tmp_path / "heights.png").read_bytes().startswith(b"\x89PNG")
    with refused(OutputError, "folder of the plots"):
        plots.save_plots(elastic, tmp_path / "heights.png" / "deeper")


def test_import_is_light() -> None:
    code = (
        "import sys, asperity.plots, asperity.io.results, asperity.io.export; print('matplotlib' in "
        "sys.modules or 'xarray' in sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert run.stdout.strip() == "False"
