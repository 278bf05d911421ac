"""Names of the curves of a comparison stand where the curves end or leave the axes."""

from __future__ import annotations

import numpy as np
import pytest
import xarray

from asperity.plots.comparison import LABEL_ROOM, OTHERS, nearest, plot_comparison_area, plot_comparison_gap

PRESSURE = np.geomspace(1e-4, 1e-1, 7)
THEORIES = ("high", "steep", "low", "short")


def gaps() -> xarray.Dataset:
    """Mean gaps over rms heights: within the axes, through the bottom, never within, and known at
    light loads only."""
    x = np.log10(PRESSURE) + 4.0  # from 0 to 3
    curves = np.stack([1.8 - 0.2 * x, 1.5 - 2.0 * x, -5.0 - x, np.where(x < 1.2, 1.0 + 0.0 * x, np.nan)])
    valid = np.ones(curves.shape, dtype=bool)
    return xarray.Dataset(
        {
            "gap": (("theory", "load"), curves),
            "gap_valid": (("theory", "load"), valid),
            "numerical_mean_gap": (("load",), 2.0 - 0.3 * x),
            "relative_pressure": (("load",), PRESSURE),
        },
        coords={"theory": list(THEORIES)},
        attrs={"rms_height_m": 1.0},
    )


def test_names_stand_apart_and_point_to_the_last_visible_place_of_their_curves() -> None:
    from matplotlib.figure import Figure

    figure = Figure()
    ax = plot_comparison_gap(gaps(), figure.add_subplot())
    named = {text.get_text(): text for text in ax.texts}
    assert set(named) == {*THEORIES, "numerical"}
    heights = sorted(text.get_position()[1] for text in named.values())
    assert min(np.diff(heights)) >= 0.999 * LABEL_ROOM
    low, high = ax.get_ylim()
    to_data = ax.transAxes + ax.transData.inverted()
    ends = {name: to_data.transform(text.xy) for name, text in named.items()}
    assert ends["high"] == pytest.approx([1e-1, 1.2], rel=1e-6)
    assert ends["numerical"] == pytest.approx([1e-1, 1.1], rel=1e-6)
    assert ends["short"] == pytest.approx([1e-3, 1.0], rel=1e-6)
    assert np.log10(ends["steep"][0]) == pytest.approx(-4.0 + (1.5 - low) / 2.0, rel=1e-6)
    assert ends["steep"][1] == pytest.approx(low, abs=1e-9 * (high - low))
    assert ends["low"] == pytest.approx([1e-1, low], rel=1e-6)


def areas() -> xarray.Dataset:
    """Areas of five theories beside an exact one of 100 p/E*: off by 20, 1, 5 and 10 %, the last
    nowhere valid; the first is above one at the largest load, the third is valid at half of the
    loads."""
    factors = np.array([1.2, 1.01, 0.95, 1.1, 1.0])
    x = np.geomspace(1e-4, 9.8e-3, 6)
    exact = 100.0 * x
    valid = np.ones((5, 6), dtype=bool)
    valid[2, 3:] = valid[4] = False
    return xarray.Dataset(
        {
            "area_fraction": (("theory", "load"), factors[:, None] * exact),
            "area_fraction_valid": (("theory", "load"), valid),
            "area_fraction_deviation": (("theory", "load"), np.repeat(factors[:, None] - 1.0, 6, axis=1)),
            "numerical_area_fraction": (("load",), exact),
            "numerical_area_fraction_corrected": (("load",), exact),
            "relative_pressure": (("load",), x),
        },
        coords={"theory": ["far", "best", "half", "third", "never"]},
    )


def test_three_theories_are_named_and_nothing_is_drawn_beyond_limits_or_above_one() -> None:
    from matplotlib.figure import Figure

    data = areas()
    assert nearest(data) == ("best", "half", "third")
    ax = plot_comparison_area(data, Figure().add_subplot())
    assert {text.get_text() for text in ax.texts} == {"best", "half", "third", "numerical"}
    lines = {str(line.get_label()): line for line in ax.lines}
    assert "never" not in lines
    assert np.isfinite(lines["half"].get_ydata()).tolist() == [True] * 3 + [False] * 3
    assert np.isfinite(lines["far"].get_ydata()).tolist() == [True] * 5 + [False]
    assert lines["far"].get_color() == OTHERS
    bold = lines.pop("numerical")
    assert bold.get_color() == "#000000"
    assert bold.get_linewidth() > max(line.get_linewidth() for line in lines.values())
    colours = {lines[name].get_color() for name in nearest(data)}
    assert len(colours) == 3
    assert not colours & {OTHERS, bold.get_color()}
    assert ax.get_ylim()[1] == 1.0


def test_without_a_numerical_solution_all_are_named() -> None:
    assert nearest(areas().drop_vars("area_fraction_deviation")) == ()
