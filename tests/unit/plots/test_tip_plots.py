"""Figures of a scan and the tip that took it."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

import asperity as asp

s, plots = asp.surfaces, asp.plots
NM = 1e-9


@pytest.fixture(scope="module")
def true() -> asp.Surface:
    heights = np.zeros((40, 30))
    heights[10:14, 10:20], heights[25, 20] = 12 * NM, 20 * NM
    heights[30, 5] = np.nan
    return asp.Surface(heights, 1.0 * NM, 1.5 * NM)


TIPS = (
    s.SphericalTip(6 * NM),
    s.ConicalTip(3 * NM, math.radians(40.0)),
    s.MeasuredTip([[2 * NM, 0.0, 1 * NM]], 1.0 * NM, 1.5 * NM),
)


@pytest.mark.parametrize("tip", TIPS, ids=lambda tip: type(tip).__name__)
def test_all_are_pictures(true: asp.Surface, tip: s.SphericalTip, tmp_path: Path) -> None:
    paths = plots.save_tip_plots(s.scanned(true, tip), tip, tmp_path)
    assert [path.stem for path in paths] == [plot.name for plot in plots.TIP_PLOTS]
    for path in paths:
        with Image.open(path) as picture:
            assert np.asarray(picture.convert("L")).std() > 1.0


def axes() -> object:
    figure = Figure()
    FigureCanvasAgg(figure)
    return figure.add_subplot()


def test_they_show_the_numbers(true: asp.Surface) -> None:
    tip = TIPS[0]
    scan = s.scanned(true, tip)
    behind, certain = s.reconstructed(scan, tip), s.certain_points(scan, tip)
    section = plots.plot_tip_section(scan, tip, axes())
    before, after, dots = section.lines
    np.testing.assert_allclose(
        before.get_ydata() - after.get_ydata(), (scan.heights - behind.heights)[:, 20] / NM, atol=1e-9
    )
    assert len(dots.get_xdata()) == certain[:, 20].sum()
    drawn = plots.plot_certainty(scan, tip, axes())
    assert f"{100 * certain.mean():.1f}" in drawn.get_legend().get_texts()[1].get_text()
    profile = plots.plot_tip(scan, tip, axes()).lines[0]
    fine = profile.get_xdata() * NM
    np.testing.assert_allclose(
        profile.get_ydata() * NM, tip.above_apex(fine, np.zeros(fine.size)), rtol=1e-6, atol=1e-15
    )
