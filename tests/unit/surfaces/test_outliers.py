"""Spikes, scan lines, polynomials of any degree, robust levelling, and the tip cut-off."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import (
    ExponentialAutocorrelation,
    GaussianAutocorrelation,
    RmsHeight,
    SelfAffine,
    gaussian,
)
from asperity.surfaces.characterise.slopes import rms_profile_curvature
from asperity.surfaces.prepare.filter import filtered, reliability_cutoff, tip_limited
from asperity.surfaces.prepare.level import despiked, levelled, line_corrected
from asperity.surfaces.surface import Surface

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # the library warns where MPI is missing
    from SurfaceTopography import Topography

GRID = Grid((60, 44), (1.0, 1.4))


def rough(seed=1, grid=GRID, periodic=True):
    base = gaussian(grid, GaussianAutocorrelation(1.0, 8.0), seed=seed)
    return Surface(base.heights, base.dx, base.dy, periodic=periodic)


# spikes


@pytest.mark.parametrize("periodic", [True, False])
def test_spikes_are_masked_and_nothing_else(periodic):
    base = rough(periodic=periodic)
    heights = base.heights.copy()
    places = ([0, 17, 17, 59, 30], [0, 20, 21, 43, 5])
    heights[places] += [9.0, -9.0, 9.0, 9.0, 9.0]
    found = despiked(Surface(heights, 1.0, 1.4, periodic=periodic), 12.0)
    expected = np.zeros(GRID.shape, dtype=bool)
    expected[places] = True
    np.testing.assert_array_equal(found.mask, expected)
    np.testing.assert_array_equal(found.heights[~expected], heights[~expected])
    assert found.origin.history[-1].startswith("despiked: 5 points more than")


def test_missing_points_stay_missing_and_take_no_part():
    heights = rough().heights.copy()
    heights[10:14, 10:14] = np.nan
    heights[12, 20] += 9.0
    found = despiked(Surface(heights, 1.0, 1.4), 12.0)
    assert found.n_missing == 17
    assert found.mask[12, 20]


def test_spike_on_a_flat_map_and_digital_steps():
    flat = np.zeros((40, 40))
    flat[7, 8] = 1.0
    assert np.argwhere(despiked(Surface(flat, 1.0)).mask).tolist() == [[7, 8]]
    digital = np.zeros((40, 40))
    digital.ravel()[np.random.default_rng(1).choice(1600, 320, replace=False)] = 1.0  # one step of the converter
    assert despiked(Surface(digital, 1.0)).n_missing == 0


@settings(max_examples=15)
@given(seed=st.integers(0, 50), scale=st.floats(0.01, 100.0), offset=st.floats(-50.0, 50.0))
def test_spikes_do_not_depend_on_scale_and_offset(seed, scale, offset):
    heights = np.random.default_rng(seed).standard_t(2, size=(20, 24))
    one, other = (despiked(Surface(h, 1.0)).mask for h in (heights, scale * heights + offset))
    np.testing.assert_array_equal(one, other)


def test_median_of_the_neighbourhood_by_brute_force():
    """Where a node is masked follows from the median of its window, borders cut and missing points
    left out."""
    heights = np.random.default_rng(2).standard_t(1.5, size=(14, 12))
    heights[3, 4] = np.nan
    padded = np.pad(heights, 1, constant_values=np.nan)
    median = np.array([[np.nanmedian(padded[i : i + 3, j : j + 3]) for j in range(12)] for i in range(14)])
    distance = np.abs(heights - median)
    scale = 1.482602218505602 * np.nanmedian(distance)
    expected = (distance > 4.0 * scale) | np.isnan(heights)
    np.testing.assert_array_equal(despiked(Surface(heights, 1.0), 4.0, window=3).mask, expected)


# scan lines


@pytest.mark.parametrize("axis", ["x", "y"])
def test_offsets_of_scan_lines_are_removed(axis):
    base = rough()
    heights = base.heights if axis == "x" else base.heights.T
    offsets = 5.0 * np.random.default_rng(4).standard_normal(heights.shape[1])
    spoilt = heights + offsets[None, :]
    spoilt = spoilt if axis == "x" else spoilt.T
    found = line_corrected(Surface(spoilt, 1.0, 1.0), axis)
    # slopes along the lines are untouched, offsets between neighbours are those of the surface up
    # to its own median
    number = "xy".index(axis)
    np.testing.assert_allclose(np.diff(found.heights, axis=number), np.diff(spoilt, axis=number), atol=1e-12)
    steps = np.median(np.diff(found.heights, axis=1 - number), axis=number)
    np.testing.assert_allclose(steps, 0.0, atol=1e-12)
    assert np.std(np.median(found.heights, axis=number)) < 0.5 < np.std(offsets)


def test_a_line_without_points_takes_the_offset_of_the_one_before():
    heights = np.arange(30.0)[:, None] + np.array([0.0, 3.0, np.nan, 3.0, 1.0])[None, :]
    found = line_corrected(Surface(heights, 1.0))
    assert found.n_missing == 30
    assert np.ptp(found.heights[:, [0, 1]], axis=1).max() == pytest.approx(0.0, abs=1e-12)


# levelling


@settings(max_examples=25)
@given(degree=st.integers(0, 8), seed=st.integers(0, 99), holes=st.booleans())
def test_any_degree_removes_its_polynomials_and_leaves_a_residual_orthogonal_to_them(degree, seed, holes):
    random = np.random.default_rng(seed)
    base = rough().heights.copy()
    if holes:
        base[5:15, 30:40] = np.nan
    x, y = (np.linspace(-1.0, 1.0, n) for n in GRID.shape)
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    added = sum(
        c * x[:, None] ** a * y[None, :] ** b for c, (a, b) in zip(random.normal(size=len(powers)), powers, strict=True)
    )
    residual = levelled(Surface(base, 1.0, 1.4), degree).heights
    np.testing.assert_allclose(levelled(Surface(base + added, 1.0, 1.4), degree).heights, residual, atol=1e-11)
    valid = ~np.isnan(residual)
    for a, b in powers:
        product = (x[:, None] ** a * y[None, :] ** b)[valid] @ residual[valid]
        assert abs(product) < 1e-10 * valid.sum()


def test_degrees_and_names_agree():
    surface = rough()
    for name, degree in (("mean", 0), ("plane", 1), ("quadratic", 2)):
        one, other = levelled(surface, name), levelled(surface, degree)
        np.testing.assert_array_equal(one.heights, other.heights)
        assert one.origin.history == other.origin.history
    assert "polynomial of degree 5 removed" in levelled(surface, 5).origin.history[-1]
    with refused(InputError, "degree of the form to be removed", "20"):
        levelled(surface, 21)
    with refused(InputError, "degree of the form to be removed"):
        levelled(surface, -1)


def test_robust_levelling_is_not_tilted_by_pits():
    x, y = GRID.coordinates()
    noise = 0.01 * np.random.default_rng(1).standard_normal(GRID.shape)
    pits = np.where((x > 45) & (y > 40), -5.0, 0.0)
    tilt = 0.03 * x - 0.01 * y + 2.0
    surface = Surface(noise + pits + tilt, 1.0, 1.4)
    plain, robust = levelled(surface).heights, levelled(surface, robust=True).heights
    outside = pits == 0.0
    # the plane through the other nodes alone is uncertain by noise/sqrt(N), some 3e-4
    expected = levelled(Surface(np.where(outside, noise + tilt, np.nan), 1.0, 1.4)).heights
    np.testing.assert_allclose(robust[outside], expected[outside], atol=1e-3)
    assert np.abs(plain[outside] - expected[outside]).max() > 0.2
    assert "robustly without" in levelled(surface, robust=True).origin.history[-1]


def test_robust_levelling_of_a_plane_ends():
    x, _ = GRID.coordinates()
    np.testing.assert_allclose(levelled(Surface(x + np.zeros(GRID.shape), 1.0), robust=True).heights, 0.0, atol=1e-12)


# tip


def scanned(surface, radius):
    """Grey dilation by a parabolic tip: the map a tip of that radius would record."""
    half = int(np.ceil(np.sqrt(2 * radius * np.ptp(surface.heights)) / min(surface.grid.spacing)))
    result = np.full(surface.shape, -np.inf)
    for i in range(-half, half + 1):
        for j in range(-half, half + 1):
            sag = ((i * surface.dx) ** 2 + (j * surface.dy) ** 2) / (2 * radius)
            result = np.maximum(result, np.roll(surface.heights, (i, j), axis=(0, 1)) - sag)
    return Surface(result, surface.dx, surface.dy, periodic=True)


SHARP = gaussian(
    Grid((128, 128), (1.0, 1.0)),
    SelfAffine(amplitude=RmsHeight(1.0), hurst=0.8, rolloff_wavelength=64.0, shortest_wavelength=2.0),
    seed=1,
)


@pytest.mark.parametrize("radius", [6.0, 12.0, 25.0])
def test_cutoff_is_that_of_the_library_along_x(radius):
    seen = scanned(SHARP, radius)
    theirs = Topography(seen.heights, seen.size, periodic=True).scanning_probe_reliability_cutoff(radius)
    along_x = Surface(seen.heights, 1.0, 1e3, periodic=True)  # no curvature along y to speak of
    ours = reliability_cutoff(along_x, radius)
    # both interpolate between stencils of whole pixels: ours linearly on a geometric ladder, theirs
    # on every pixel
    assert ours == pytest.approx(theirs, abs=2.0 + 0.2 * theirs)


def test_cutoff_grows_with_the_tip_and_waves_below_it_are_removed():
    cutoffs = [reliability_cutoff(scanned(SHARP, radius), radius) for radius in (4.0, 16.0)]
    assert 0.0 < cutoffs[0] < cutoffs[1] < 64.0
    seen = scanned(SHARP, 16.0)
    limited = tip_limited(seen, 16.0)
    np.testing.assert_array_equal(limited.heights, filtered(seen, short=cutoffs[1]).heights)
    assert rms_profile_curvature(limited) < 0.5 * rms_profile_curvature(seen)
    assert limited.origin.history[-1].startswith("tip-limited: waves below")
    assert {"Sanner2022", "ISO16610-61"} <= set(limited.citation_keys)


def test_sharp_tip_removes_nothing():
    smooth = rough()
    assert reliability_cutoff(smooth, 1e-3) == 0.0
    kept = tip_limited(smooth, 1e-3)
    np.testing.assert_array_equal(kept.heights, smooth.heights)
    assert "nothing removed" in kept.origin.history[-1]


def test_blunt_tip_is_refused():
    with refused(InputError, "radius of the tip"):
        tip_limited(gaussian(Grid((64, 64), (1.0, 1.0)), ExponentialAutocorrelation(1.0, 3.0), seed=1), 1e9)


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: despiked(rough(), 0.0), "threshold of despiked()", "0.0"),
        (lambda: despiked(rough(), window=4), "window of despiked()", "4"),
        (lambda: despiked(rough(), window=1), "window of despiked()", "1"),
        (lambda: line_corrected(rough(), "z"), "axis of line_corrected()", "'z'"),
        (lambda: tip_limited(rough(), -1.0), "radius (m) of tip_limited()", "-1.0"),
    ],
)
def test_refusals(make, subject, shown):
    with refused(InputError, subject, shown):
        make()
