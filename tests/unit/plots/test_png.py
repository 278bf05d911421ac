"""From a figure to its PNG: what is drawn is found, whatever its place, and kept to the bit."""

from __future__ import annotations

import io
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from asperity.plots.picture import AxesCurves, content_of, encoded, png, style, uncrowd

DPI = 100


def test_a_reader_finds_the_pixels_and_the_resolution() -> None:
    pixels = np.random.default_rng(1).integers(0, 256, (31, 47, 3), dtype=np.uint8)
    read = Image.open(io.BytesIO(encoded(pixels, 200)))
    assert np.array_equal(np.asarray(read), pixels)
    assert read.info["dpi"] == pytest.approx((200.0, 200.0), rel=1e-4)


@pytest.mark.parametrize("far", [False, True], ids=["near the axes", "far from the axes"])
def test_the_content_is_what_the_artists_fill(far: bool) -> None:
    figure = Figure(figsize=(4.0, 3.0), dpi=DPI)
    renderer = FigureCanvasAgg(figure).get_renderer()
    ax = figure.add_subplot()
    ax.plot([0.0, 1.0], [0.0, 1.0])
    ax.set(xlabel="x", ylabel="y")
    beside = ax.inset_axes((1.4, 0.0, 0.5, 1.0))
    beside.set_xlabel("x")
    if far:
        ax.annotate("M", (0.5, 3.0), xycoords="axes fraction", annotation_clip=False)
    pixels, box = content_of(figure)
    tight = figure.get_tightbbox(renderer).padded(0.06)  # type: ignore[no-untyped-call]
    assert (box.width * DPI, box.height * DPI) == pytest.approx(pixels.shape[1::-1], abs=0.1)
    assert box.extents == pytest.approx(tight.extents, abs=6 / DPI), "texts reach a few pixels beyond their letters"
    edge = round(0.06 * DPI) - 2
    inside = pixels[edge:-edge, edge:-edge]
    assert (pixels != 255).sum() == (inside != 255).sum() > 0, "the border is white"


def test_curves_lie_where_the_picture_shows_them() -> None:
    curves: list[AxesCurves] = []

    def draw(ax: Axes) -> Axes:
        ax.plot([0.0, 1.0], [0.0, 1.0])
        ax.set_facecolor("red")
        ax.spines[:].set_visible(False)
        return ax

    picture = np.asarray(Image.open(io.BytesIO(png(draw, (4.0, 3.0), dpi=DPI, curves=curves))))
    red = (picture == (255, 0, 0)).all(axis=2)
    rows, columns = np.flatnonzero(red.any(axis=1)), np.flatnonzero(red.any(axis=0))
    left, top, right, bottom = curves[0].box
    height, width = red.shape
    assert (left * width, right * width) == pytest.approx((columns[0], columns[-1] + 1), abs=1.0)
    assert (top * height, bottom * height) == pytest.approx((rows[0], rows[-1] + 1), abs=1.0)


@pytest.mark.parametrize(
    ("lowest", "decades", "width"),
    [(2e-5, 1.2, 4.5), (3e3, 1.0, 3.5), (1.1, 0.4, 3.5), (0.0103, 0.2, 3.5), (1.0, 3.0, 4.5)],
)
def test_labels_of_logarithmic_axes_do_not_overlap(lowest: float, decades: float, width: float) -> None:
    """Axes of about a decade, where matplotlib labels the ticks between; two labels at least tell
    the scale."""
    with style():
        figure = Figure(figsize=(width, 3.0), dpi=100, layout="constrained")
        FigureCanvasAgg(figure)
        ax = figure.add_subplot()
        ax.plot([lowest, lowest * 10.0**decades], [1.0, 2.0])
        ax.set(xscale="log", xlabel="p")
        uncrowd(figure)
        figure.canvas.draw()
    low, high = ax.get_xlim()
    seen = [
        label.get_window_extent()
        for minor in (False, True)
        for at, label in zip(ax.get_xticks(minor=minor), ax.get_xticklabels(minor=minor), strict=True)
        if low <= at <= high and label.get_text()
    ]
    boxes = sorted((box.x0, box.x1) for box in seen)
    assert len(boxes) >= 2
    assert all(left[1] < right[0] for left, right in pairwise(boxes))
