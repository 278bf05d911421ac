"""Areal filters: reference maps, transmission in closed form, borders, missing points, spikes, and
refusals."""

import re

import numpy as np
import pytest
from ensemble import average, require_accepted, rows
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import FOLDER, every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import ExponentialAutocorrelation, gaussian, sinusoid
from asperity.surfaces.prepare.filter import filtered, transmission
from asperity.surfaces.prepare.level import levelled
from asperity.surfaces.surface import Surface

ROWS = reference("surfaces_map_filter")
MAPS = np.load(FOLDER / "surfaces_maps.npz")


def row_id(row):
    return f"{row['map']}-{row['quantity']}"


@every_row(ROWS, label=row_id)
def test_reference_maps(row):
    dx, dy = MAPS[f"{row['map']}_spacing"]
    surface = Surface(MAPS[row["map"]], dx, dy, periodic=bool(MAPS[f"{row['map']}_periodic"]))
    surface = levelled(surface, "quadratic" if row["prep"] == "poly2" else "mean")
    name, cutoff, reach = re.fullmatch(r"(\w+)\[lc=(\d+),Lc=([\d.]+)\]", row["quantity"]).groups()
    low = filtered(surface, short=float(cutoff), reach=float(reach)).heights
    valid = ~surface.mask
    if name == "rms_lowpass":
        value = np.sqrt(np.mean(low[valid] ** 2))
    elif name == "rms_highpass":
        value = np.sqrt(np.mean((surface.heights - low)[valid] ** 2))
    else:
        value = low[tuple(int(n) for n in name.split("_")[-2:])]
    assert value == pytest.approx(row["value"], rel=row["tol_rel"])


def test_noise_ensemble_meets_its_acceptance_intervals():
    grid = Grid((128, 128), (1.0, 1.0))

    def statistics(seed):
        noise = np.random.default_rng(seed).standard_normal(grid.shape)
        z = filtered(Surface(noise, 1.0, periodic=True), short=10.0).heights
        z = z - z.mean()
        return {"m0": np.mean(z**2), "m2x_fd": np.mean((np.roll(z, -1, 0) - z) ** 2)}

    require_accepted("G10", average(statistics(seed) for seed in range(int(rows("G10")[0]["n_realisations"]))))


@pytest.mark.parametrize("ratio", [0.25, 0.5, 1.0, 2.0, 5.0])  # wavelength over cut-off
@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("axis", ["x", "y"])
def test_wave_passes_as_the_standard_says(ratio, order, axis):
    """2^-(λc/λ)², 50 % at the cut-off; order 2: (1 + t) e^-t with t = 1.678 (λc/λ)², 50 % too."""
    n, period = 320, 32
    shape = (n, 16) if axis == "x" else (16, n)
    # kernels of the ratios below 1 would be finer than the wave: keep the wave at 32 pixels and
    # move the cut-off
    cutoff = period / ratio
    wave = sinusoid(Grid(shape, (1.0, 1.0)), amplitude=1.0, wavelength=float(period), axis=axis)
    low = filtered(wave, short=cutoff, order=order, reach=1.5)
    found = 0.5 * np.ptp(low.heights)
    expected = float(transmission(1.0 / ratio, order))
    if order < 2:
        assert expected == pytest.approx(2.0 ** -(1.0 / ratio**2), rel=1e-12)
    assert found == pytest.approx(expected, abs=1e-6 if order < 2 else 1e-5)
    high = filtered(wave, long=cutoff, order=order, reach=1.5)
    np.testing.assert_allclose(high.heights + low.heights, wave.heights, atol=1e-12)


def test_transmission_at_the_cutoff_is_one_half():
    for order in (0, 1, 2):
        assert transmission(1.0, order) == pytest.approx(0.5, abs=1e-12)


def test_filter_along_one_direction_only():
    """A cut-off of four pixels along y passes what one of the wavelength removes along x."""
    grid = Grid((64, 64), (1.0, 1.0))
    x, y = grid.coordinates()
    along_x, along_y = np.cos(2 * np.pi * x / 16) + 0.0 * y, np.cos(2 * np.pi * y / 16) + 0.0 * x
    low = filtered(Surface(along_x + along_y, 1.0, periodic=True), short=(16.0, 4.0), reach=2.0).heights
    kept = 2.0 ** -((4 / 16) ** 2)
    np.testing.assert_allclose(low, 0.5 * along_x + kept * along_y, atol=5e-3)  # the kernel of 4 pixels passes 0.5019


@settings(max_examples=15)
@given(
    shape=st.tuples(st.integers(12, 30), st.integers(12, 30)),
    cutoff=st.floats(4.0, 12.0),  # at most the longer side
    order=st.integers(0, 2),
    data=st.data(),
)
def test_polynomials_of_the_order_pass_unchanged_up_to_borders_and_holes(shape, cutoff, order, data):
    grid = Grid(shape, (1.0, 0.9))
    x, y = grid.centred_coordinates()
    coefficients = data.draw(st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6))
    powers = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
    terms = [
        c * (x / 10) ** a * (y / 10) ** b for c, (a, b) in zip(coefficients, powers, strict=True) if a + b <= order
    ]
    heights = sum(terms) + np.zeros(shape)
    heights[3:6, 4:7] = np.nan
    low = filtered(Surface(heights, 1.0, 0.9), short=cutoff, order=order).heights
    np.testing.assert_array_equal(np.isnan(low), np.isnan(heights))
    np.testing.assert_allclose(low, heights, atol=2e-6)  # 1e-10 of the trace is added to the equations


def test_direct_sum_with_missing_points():
    """One node by its definition: normalised weights exp(-π (r/αλ)²) over the valid nodes within
    reach."""
    heights = np.random.default_rng(3).standard_normal((30, 26))
    heights[10:13, 5] = np.nan
    low = filtered(Surface(heights, 1.0, 1.5), short=(5.0, 6.0)).heights
    x, y = np.arange(30)[:, None] * 1.0, np.arange(26)[None, :] * 1.5
    alpha = np.sqrt(np.log(2.0) / np.pi)
    for i, j in ((0, 0), (11, 6), (29, 13)):
        dx, dy = x - x[i], y - y[:, j]
        s = np.exp(-np.pi * ((dx / (alpha * 5.0)) ** 2 + (dy / (alpha * 6.0)) ** 2))
        s = s * (np.abs(dx) <= 5.0) * (np.abs(dy) <= 6.0) * ~np.isnan(heights)
        assert low[i, j] == pytest.approx(np.nansum(s * heights) / s.sum(), abs=1e-12)


def test_profile_is_filtered_whatever_its_width():
    """One point along y, whose pixel is wider than the cut-off."""
    x = np.arange(200)
    profile = np.sin(2 * np.pi * x / 40)[:, None] + np.sin(2 * np.pi * x / 5)[:, None]
    low = filtered(Surface(profile, 1e-8, 1e-5, periodic=True), short=10e-8).heights
    expected = 2.0 ** -((10 / 40) ** 2) * np.sin(2 * np.pi * x / 40) + 2.0 ** -((10 / 5) ** 2) * np.sin(
        2 * np.pi * x / 5
    )
    np.testing.assert_allclose(low[:, 0], expected, atol=1e-5)


def test_single_precision_maps_are_filtered_in_double():
    heights = np.random.default_rng(1).standard_normal((40, 30))
    single = filtered(Surface(heights.astype(np.float32), 1.0), short=8.0).heights
    np.testing.assert_allclose(single, filtered(Surface(heights, 1.0), short=8.0).heights, atol=1e-7)


def spiky(seed=1):
    base = gaussian(Grid((96, 96), (1.0, 1.0)), ExponentialAutocorrelation(1.0, 12.0), seed=seed)
    heights = base.heights.copy()
    spikes = np.random.default_rng(seed).choice(heights.size, 60, replace=False)
    heights.ravel()[spikes] += 60.0
    return base, Surface(heights, 1.0, periodic=True), np.isin(np.arange(heights.size), spikes).reshape(heights.shape)


@pytest.mark.parametrize("order", [0, 2])
def test_robust_filter_ignores_spikes(order):
    base, spoilt, spikes = spiky()
    clean = filtered(base, short=20.0, kind="robust", order=order).heights
    robust = filtered(spoilt, short=20.0, kind="robust", order=order).heights
    plain = filtered(spoilt, short=20.0, order=order).heights
    halo = np.abs(plain - filtered(base, short=20.0, order=order).heights).max()
    # what is left is the noise of the nodes that the spikes replace, next to spikes of 60 times the
    # noise
    assert halo > 1.0
    assert np.abs(robust - clean).max() < 0.15 * halo
    assert spikes.sum() == 60


def test_robust_filter_of_normal_residuals_is_nearly_the_plain_one():
    base, _, _ = spiky()
    plain, robust = (filtered(base, short=20.0, kind=kind).heights for kind in ("gaussian", "robust"))
    # the biweight of three standard deviations gives away a fifth of the efficiency
    assert np.std(robust - plain) < 0.2 * np.std(base.heights - plain)


def test_robust_filter_of_a_smooth_surface_ends():
    flat = Surface(np.zeros((20, 20)), 1.0)
    np.testing.assert_array_equal(filtered(flat, short=5.0, kind="robust").heights, 0.0)


def test_band_pass_keeps_the_wave_in_between():
    grid = Grid((240, 8), (1.0, 1.0))
    long, middle, short = (sinusoid(grid, amplitude=1.0, wavelength=float(w)).heights + 1.0 for w in (240, 40, 5))
    band = filtered(Surface(long + middle + short, 1.0, periodic=True), short=14.0, long=110.0)
    kept = 2.0 ** -((14 / 40) ** 2) * (1.0 - 2.0 ** -((110 / 40) ** 2))
    leak = 2.0 ** -((14 / 240) ** 2) * (1.0 - 2.0 ** -((110 / 240) ** 2)), 2.0 ** -((14 / 5) ** 2)
    expected = kept * middle + leak[0] * long + leak[1] * short
    np.testing.assert_allclose(band.heights, expected, atol=2e-4)
    assert band.origin.history[-1].startswith(
        "filtered: short waves from 14 m, long waves from 110 m on removed, gaussian"
    )
    assert band.citation_keys == ("ISO16610-61",)


@pytest.mark.parametrize("n", [48, 47])
def test_sharp_band_pass_takes_modes_whole(n):
    surface = Surface(np.random.default_rng(1).standard_normal((n, 40)), 1.0, 1.2, periodic=True)
    band = filtered(surface, short=4.0, long=20.0, kind="sharp")
    before, after = np.fft.rfft2(surface.heights), np.fft.rfft2(band.heights)
    q = surface.grid.wavenumber()
    inside = (q <= 2 * np.pi / 4.0 * (1 + 1e-9)) & (q >= 2 * np.pi / 20.0 * (1 - 1e-9))
    np.testing.assert_allclose(after, np.where(inside, before, 0.0), atol=1e-11)
    low = filtered(surface, short=4.0, kind="sharp")
    assert low.heights.mean() == pytest.approx(surface.heights.mean(), abs=1e-13)


@settings(max_examples=15)
@given(seed=st.integers(0, 99), a=st.floats(-3.0, 3.0), kind=st.sampled_from(["gaussian", "robust"]))
def test_filters_commute_with_transposition_offset_and_scale(seed, a, kind):
    heights = np.random.default_rng(seed).standard_normal((24, 20))
    low = filtered(Surface(heights, 1.0, 1.5), short=(6.0, 8.0), kind=kind).heights
    turned = filtered(Surface(heights.T, 1.5, 1.0), short=(8.0, 6.0), kind=kind).heights
    np.testing.assert_allclose(turned, low.T, atol=1e-10)
    moved = filtered(Surface(2.0 * heights + a, 1.0, 1.5), short=(6.0, 8.0), kind=kind).heights
    np.testing.assert_allclose(moved, 2.0 * low + a, atol=1e-9)


def test_white_noise_is_reduced_as_the_standard_implies():
    """2.266 Δx Δy/(λx λy) of the variance is left."""
    noise = Surface(np.random.default_rng(5).standard_normal((512, 512)), 1.0, periodic=True)
    low = filtered(noise, short=(12.0, 9.0)).heights
    effective = 512**2 / (2 * 2 * np.pi * (0.1873906 * 12) * (0.1873906 * 9))  # independent values, for the scatter
    assert low.var() == pytest.approx(2.2662 / (12 * 9), rel=5.0 * np.sqrt(2.0 / effective))


@pytest.mark.parametrize(
    ("choice", "subject", "shown"),
    [
        ({}, "cut-off of a filter", "neither"),
        ({"short": 3.0}, "short cut-off of a filter", "3 m"),
        ({"short": 1e3}, "short cut-off of a filter", "1 km"),
        ({"long": 1e3}, "long cut-off of a filter", "1 km"),
        ({"short": (8.0, 5.0)}, "short cut-off of a filter", "5 m"),
        ({"short": 20.0, "long": 10.0}, "short cut-off of a filter", "20.0"),
        ({"short": -1.0}, "short cut-off of a filter (m)", "-1.0"),
        ({"short": 10.0, "kind": "spline"}, "kind of filter", "'spline'"),
        ({"short": 10.0, "order": 3}, "order of a filter", "3"),
        ({"short": 10.0, "reach": 0.0}, "reach of a filter (cut-offs)", "0.0"),
        ({"short": 10.0, "kind": "sharp"}, "surface", "gaussian"),
    ],
)
def test_refusals(choice, subject, shown):
    with refused(InputError, subject, shown):
        filtered(Surface(np.random.default_rng(1).standard_normal((32, 32)), 1.0, 1.5), **choice)
