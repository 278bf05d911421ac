"""Figures of campaigns: what is drawn is what was found, in readable units."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.figure import Figure

from asperity.core.quantity import Labelled, Quantity
from asperity.plots.campaign import (
    MOST_TICKS,
    Curve,
    Transition,
    plot_convergence,
    plot_curves,
    plot_running_mean,
    plot_samples,
    plot_sensitivities,
    plot_transitions,
)
from asperity.plots.picture import CURVE_SIZE, png, scale

X = Labelled(Quantity("q", "Pa", "mean pressure"), np.array([5e6, 1e6, 2e6]))
Y = Labelled(Quantity("q", "m", "approach"), np.array([3e-9, 1e-9, 2e-9]))


@pytest.fixture
def ax():
    return Figure().add_subplot()


def test_curves_are_drawn_in_order_and_with_units(ax):
    plot_curves(X, Y, [Curve("a$\\frac{$\x1b", Y.values), Curve("b", 2.0 * Y.values, np.full(3, 0.5e-9))], ax)
    first, second = ax.lines
    np.testing.assert_allclose(first.get_xdata(), [1.0, 2.0, 5.0])
    np.testing.assert_allclose(second.get_ydata(), [2.0, 4.0, 6.0])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("mean pressure (MPa)", "approach (nm)")
    assert len(ax.collections) == 1
    assert ax.get_xscale() == "linear"
    assert ax.get_legend_handles_labels()[1] == ["a\\$\\frac{\\$\ufffd", "b"]
    ax.figure.draw_without_rendering()  # names are no formulas


def test_decades_are_logarithmic_and_numbers_have_no_unit(ax):
    share = Labelled(
        Quantity("q", "1", "real contact area / nominal area (perimeter-corrected)"), np.array([1e-4, 1e-2, 1e-1])
    )
    plot_curves(
        Labelled(Quantity("q", "m", "thickness"), np.array([1e-9, 1e-7, 1e-6])), share, [Curve("", share.values)], ax
    )
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    assert "\n" in ax.get_ylabel(), "long labels take two lines"
    assert ax.get_legend() is None


def test_a_failed_case_leaves_a_hole(ax):
    plot_curves(X, Y, [Curve("", np.array([3e-9, math.nan, 2e-9]))], ax)
    assert np.isnan(ax.lines[0].get_ydata()[0])


def test_samples_show_mean_and_confidence(ax):
    plot_samples(Labelled(Quantity("q", "m", "gap"), np.array([1e-9, 2e-9, math.nan, 3e-9])), 2e-9, 0.5e-9, ax)
    assert sum(patch.get_height() for patch in ax.patches[:-1]) == 3
    assert "mean 2 nm" in ax.get_legend_handles_labels()[1]
    plot_running_mean(Y, np.array([math.nan, 1e-9, 0.5e-9]), Y.values, ax)


def test_convergence_marks_levels_and_limit(ax):
    levels = Labelled(Quantity("q", "1", "points along x"), np.array([16.0, 32.0, 64.0]))
    plot_convergence(levels, Y, 0.9e-9, ax)
    assert [text.get_text() for text in ax.get_xticklabels()] == ["16", "32", "64"]
    assert ax.lines[1].get_ydata()[0] == pytest.approx(0.9)
    assert levels.values.size <= MOST_TICKS


def test_tolerances_run_from_coarse_to_fine(ax):
    plot_convergence(Labelled(Quantity("q", "1", "tolerance"), np.array([1e-2, 1e-4, 1e-6])), Y, math.nan, ax)
    assert ax.get_xlim()[0] > ax.get_xlim()[1]


def test_floor_and_ceiling_lie_on_the_curve(ax):
    thickness = Labelled(Quantity("q", "m", "thickness"), np.array([1e-9, 1e-8, 1e-7]))
    item = Transition("", np.array([1.0, 2.0, 3.0]), 1.0, 3.0, 10**-8.5, math.nan)
    plot_transitions(thickness, Labelled(Quantity("q", "Pa", "p"), item.values), [item], ax)
    (mark,) = [line for line in ax.lines if line.get_marker() == "^"]
    assert float(mark.get_ydata()[0]) == pytest.approx(1.5)
    assert not [line for line in ax.lines if line.get_marker() == "v"]


def test_the_largest_sensitivity_is_on_top(ax):
    low, high = np.array([1.9, 1.0]), np.array([2.1, 3.0])
    plot_sensitivities(["small", "large"], low, high, Labelled(Quantity("q", "1", "y"), low), 2.0, ax)
    assert [text.get_text() for text in ax.get_yticklabels()] == ["small", "large"]
    assert [bar.get_width() for bar in ax.patches] == pytest.approx([-0.1, -1.0, 0.1, 1.0])


@pytest.mark.parametrize(
    ("value", "unit", "symbol"),
    [(2e-3, "N", "mN"), (3e12, "Pa/m", "TPa/m"), (0.02, "1", ""), (5e-15, "J", "fJ"), (1.0, "m**-2", "m**-2")],
)
def test_every_unit_has_a_scale(value, unit, symbol):
    found = scale(value, unit)
    assert found.symbol == symbol
    assert float(found(value)) * found.factor == pytest.approx(value, rel=1e-12, abs=0.0)


def test_a_picture_is_made():
    assert png(lambda ax: plot_curves(X, Y, [Curve("", Y.values)], ax), CURVE_SIZE).startswith(b"\x89PNG")
