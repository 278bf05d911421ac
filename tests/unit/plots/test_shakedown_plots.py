"""Pictures of shakedown: both bounds of a curve, contours of a map with the layers that set it."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import asperity as asp
from asperity import plots

FRICTION = np.array([0.0, 0.2, 0.4])


@pytest.fixture
def ax() -> Axes:
    return Figure().add_subplot()


def curve(factor: float, gap: float, region: tuple[int, int, int]) -> asp.stresses.ShakedownCurve:
    limit = factor * np.array([4.0, 3.0, 2.0])
    return asp.stresses.ShakedownCurve(FRICTION, limit, limit * (1.0 + gap), np.zeros(3), np.array(region))


@pytest.mark.parametrize(("gap", "lines"), [(0.1, 2), (0.0, 1)])
def test_curve(ax: Axes, gap: float, lines: int) -> None:
    shown = curve(1.0, gap, (0, 0, 0))
    assert plots.plot_shakedown_curve(shown, ax, per=2.0, label="p/k") is ax
    assert len(ax.lines) == lines
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), 2.0 * shown.limit)
    assert ax.get_ylabel() == "p/k"


def test_map(ax: Axes) -> None:
    found = asp.stresses.shakedown_map([0.0, 1e-6], [curve(1.0, 0.1, (0, 0, 0)), curve(1.5, 0.1, (1, 1, 0))])
    plots.plot_shakedown_map(found, ax)
    (dots,) = ax.lines
    np.testing.assert_array_equal(dots.get_xydata(), [[0.0, 1e-6], [0.2, 1e-6]])
    assert ax.get_ylabel() == "coating thickness (m)"


def test_map_of_one_value(ax: Axes) -> None:
    shown = asp.stresses.ShakedownCurve(FRICTION, np.ones(3), np.ones(3), np.zeros(3), np.zeros(3))
    plots.plot_shakedown_map(asp.stresses.shakedown_map([0.0, 1.0], [shown, shown]), ax)
    assert not ax.lines
