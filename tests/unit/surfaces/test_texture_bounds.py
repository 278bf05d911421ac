"""Sal and Str of autocorrelations in closed form, and their bounds where a map is too small."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference

import asperity as asp
from asperity.surfaces.characterise.correlation import Autocovariance
from asperity.surfaces.characterise.texture import doubts_of_texture, texture_lengths


def elliptic(row) -> Autocovariance:
    """Autocovariance with the semi-lengths of ``row``, on pixels of a tenth of the shorter one."""
    pixel = 0.1 * min(row["beta_x"], row["beta_y"], 0.1 * row["Lx"])
    half = [round(0.5 * row[side] / pixel) for side in ("Lx", "Ly")]
    x, y = np.arange(half[0] + 1)[:, None] * pixel, np.arange(-half[1], half[1] + 1)[None, :] * pixel
    ratio = np.hypot(x / row["beta_x"], y / row["beta_y"])
    values = np.exp(-(ratio**2)) if row["acf"] == "gaussian" else np.exp(-ratio)
    return Autocovariance(values, np.ones_like(values), (pixel, pixel), (row["Lx"], row["Ly"]))


@every_row(reference("profiles/str_bounds"), label=lambda row: f"case {row['case']:g}")
def test_bounds_of_reference_autocorrelations(row):
    found = texture_lengths(elliptic(row))
    # linear interpolation of R over a pixel d of 0.1 β or less: at most d² |R''/R'|/4 < d²/(2 β)
    accuracy = 0.01
    assert found.Sal_least == pytest.approx(row["Sal_lower_bound"], rel=accuracy)
    assert found.Str_most == pytest.approx(row["Str_upper_bound"], rel=2.0 * accuracy)
    if row["Sal_is_exact"]:
        assert found.Sal == pytest.approx(row["true_Sal"], rel=accuracy)
    else:
        assert math.isnan(found.Sal)
        assert found.Sal_least <= row["true_Sal"]
    if row["all_directions_decay"]:
        assert found.Str == pytest.approx(row["true_Str"], rel=2.0 * accuracy)
        assert found.Str == found.Str_most
    else:
        assert math.isnan(found.Str)
        assert found.Str_most >= row["true_Str"]
    assert bool(doubts_of_texture(found, periodic=True)) != bool(row["all_directions_decay"] and row["Sal_is_exact"])


def test_a_characterisation_tells_the_bound():
    """Grooves across a map: the bound is a number and a sentence."""
    grooves = np.random.default_rng(1).standard_normal(128)[:, None] * np.ones((1, 128))
    found = asp.characterise(asp.Surface(grooves, 1e-6))
    assert math.isnan(found.spatial.Str)
    assert 0.0 < found.spatial.Str_most < 0.1
    assert found.spatial.Sal_least == found.spatial.Sal
    assert any("Str is at most" in remark for remark in found.remarks)


def test_an_early_fall_is_told():
    """Waves as long as the map: the drop of the autocorrelation lies beyond a quarter of it."""
    x = np.arange(96.0)
    heights = np.cos(2.0 * np.pi * x[:, None] / 120.0) + np.cos(2.0 * np.pi * x[None, :] / 7.0)
    found = asp.characterise(asp.levelled(asp.Surface(heights, 1.0)))
    assert any("Str is an upper bound" in remark or "Str is at most" in remark for remark in found.remarks)


@pytest.mark.parametrize("shape", [(64, 1), (1, 64)])
def test_a_profile_has_one_direction(shape):
    profile = np.random.default_rng(2).standard_normal(64).reshape(shape)
    found = texture_lengths(asp.roughness.autocovariance(asp.Surface(profile, 1.0)))
    assert math.isfinite(found.Sal)
    assert math.isnan(found.Str)
    assert math.isnan(found.Str_most)
