"""Scans by a tip, the surface behind a scan, where it is certain, and the tip from a scan."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp

s = asp.surfaces
NM = 1e-9
TIPS = (s.SphericalTip(10 * NM), s.ParabolicTip(8 * NM), s.ConicalTip(4 * NM, math.radians(40.0)))
ROUNDING = 1e-22
"""Metres; sums of two heights of some 20 nm."""


def rough(*, periodic: bool, missing: bool = False) -> asp.Surface:
    """Rough surface of rectangular pixels, much steeper than the tips reach into."""
    g = asp.generate
    spectrum = g.SelfAffine(
        amplitude=g.RmsHeight(5 * NM), hurst=0.7, rolloff_wavelength=40 * NM, shortest_wavelength=5 * NM
    )
    heights = g.gaussian(asp.Grid((72, 48), (1.0 * NM, 1.6 * NM)), spectrum, seed=4).heights.copy()
    if missing:
        heights[30:33, 20:24] = np.nan
    return asp.Surface(heights, 1.0 * NM, 1.6 * NM, periodic=periodic)


@pytest.mark.parametrize("tip", TIPS, ids=lambda tip: type(tip).__name__)
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("missing", [True, False])
def test_reconstruction_lies_between_surface_and_scan_and_is_idempotent(
    tip: s.SphericalTip, periodic: bool, missing: bool
) -> None:
    true = rough(periodic=periodic, missing=missing)
    scan = s.scanned(true, tip)
    found = s.reconstructed(scan, tip)
    np.testing.assert_array_equal(found.mask, true.mask)
    known = ~true.mask
    assert (found.heights <= scan.heights)[known].all()
    assert (found.heights >= true.heights - ROUNDING)[known].all()
    assert (scan.heights > found.heights + 1 * NM)[known].any()  # the tip did not reach everywhere
    np.testing.assert_allclose(s.scanned(found, tip).heights, scan.heights, rtol=0.0, atol=ROUNDING)
    again = s.reconstructed(s.scanned(found, tip), tip)
    np.testing.assert_allclose(again.heights, found.heights, rtol=0.0, atol=ROUNDING)
    assert (found.periodic, found.grid) == (periodic, true.grid)


@pytest.mark.parametrize("tip", TIPS, ids=lambda tip: type(tip).__name__)
@pytest.mark.parametrize("periodic", [True, False])
def test_certain_points_are_those_of_the_true_surface(tip: s.SphericalTip, periodic: bool) -> None:
    true = rough(periodic=periodic, missing=True)
    scan = s.scanned(true, tip)
    certain = s.certain_points(scan, tip)
    assert 0.005 < certain.mean() < 0.9
    assert not certain[true.mask].any()
    found = s.reconstructed(scan, tip)
    np.testing.assert_allclose(found.heights[certain], true.heights[certain], rtol=0.0, atol=ROUNDING)
    masked = s.reconstructed(scan, tip, mask_uncertain=True)
    np.testing.assert_array_equal(masked.mask, ~certain)
    np.testing.assert_array_equal(masked.heights[certain], found.heights[certain])


@pytest.mark.parametrize("tip", TIPS, ids=lambda tip: type(tip).__name__)
def test_dilation_is_that_of_its_definition(tip: s.SphericalTip) -> None:
    true = rough(periodic=False)
    scan = s.scanned(true, tip)
    x, y = (np.arange(n) * d for n, d in zip(true.shape, true.grid.spacing, strict=True))
    for i, j in ((0, 0), (11, 40), (71, 47), (35, 20)):
        lifted = true.heights - tip.above_apex((x - x[i])[:, None], (y - y[j])[None, :])
        assert scan.heights[i, j] == pytest.approx(lifted.max(), abs=ROUNDING)


@pytest.mark.parametrize("tip", TIPS, ids=lambda tip: type(tip).__name__)
def test_flat_stays_flat_and_is_certain(tip: s.SphericalTip) -> None:
    flat = asp.Surface(np.full((9, 7), 3 * NM), NM)
    for made in (s.scanned(flat, tip), s.reconstructed(flat, tip)):
        np.testing.assert_array_equal(made.heights, flat.heights)
    assert s.certain_points(flat, tip).all()


def test_sphere_blunter_than_the_tip_comes_back_exactly() -> None:
    grid = asp.Grid((61, 41), (1.0 * NM, 1.5 * NM))
    ball = asp.generate.sphere(grid, radius=200 * NM, exact=True)
    true = asp.Surface(ball.heights, *grid.spacing)
    tip = s.ParabolicTip(20 * NM)
    scan = s.scanned(true, tip)
    inside = (slice(4, -4), slice(3, -3))  # slope 0.15 at most: the tip touches 3 nm beside its apex
    found = s.reconstructed(scan, tip).heights
    np.testing.assert_allclose(found[inside], true.heights[inside], rtol=0.0, atol=ROUNDING)
    # spheres of radii R and r touch along their normals: the scan is a sphere of radius R + r
    wide = s.scanned(true, s.SphericalTip(20 * NM))
    middle = (slice(20, 41), slice(14, 27))
    x, y = ((np.arange(n) - n // 2) * d for n, d in zip(grid.shape, grid.spacing, strict=True))
    larger = np.sqrt((220 * NM) ** 2 - x[:, None] ** 2 - y[None, :] ** 2) - 220 * NM
    level = wide.heights[30, 20] - larger[30, 20]
    # touching half a pixel off along each axis, with the curvature of both
    off = 0.5 * ((0.5 * NM) ** 2 + (0.75 * NM) ** 2) * (1 / (200 * NM) + 1 / (20 * NM)) * 1.2
    assert np.abs(wide.heights - level - larger)[middle].max() <= off


def test_shapes_of_tips() -> None:
    r = np.linspace(0.0, 30 * NM, 301)
    none = np.zeros(1)
    ball, cone, sharp = s.SphericalTip(20 * NM), s.ConicalTip(20 * NM, 0.8), s.ConicalTip(0.0, 0.8)
    inside = r <= 20 * NM
    expected = 20 * NM - np.sqrt((20 * NM) ** 2 - r[inside] ** 2)
    np.testing.assert_allclose(ball.above_apex(r[inside], none), expected, rtol=1e-9, atol=1e-24)
    assert np.isinf(ball.above_apex(r[~inside], none)).all()
    joint = 20 * NM * math.cos(0.4)
    tangent = 20 * NM * (1.0 - math.sin(0.4)) + (r - joint) / math.tan(0.4)
    expected = np.where(r < joint, ball.above_apex(np.minimum(r, joint), none), tangent)
    np.testing.assert_allclose(cone.above_apex(none, r), expected, rtol=1e-9, atol=1e-24)
    np.testing.assert_allclose(sharp.above_apex(r, none), r / math.tan(0.4), rtol=1e-12)
    for tip in (ball, cone, sharp, s.ParabolicTip(20 * NM)):
        for height in (1 * NM, 15 * NM):
            width = tip.reach(height)[0]
            assert tip.above_apex(np.array([width]), none) == pytest.approx(height, rel=1e-9)


def test_measured_tip_is_the_same_as_its_formula() -> None:
    true = rough(periodic=True)
    tip = TIPS[2]
    reach_x, reach_y = (int(r / d) for r, d in zip(tip.reach(50 * NM), true.grid.spacing, strict=True))
    x, y = np.arange(-reach_x, reach_x + 1) * true.dx, np.arange(-reach_y, reach_y + 1) * true.dy
    measured = s.MeasuredTip(tip.above_apex(x[:, None], y[None, :]), true.dx, true.dy)
    scan = s.scanned(true, tip)
    np.testing.assert_allclose(s.scanned(true, measured).heights, scan.heights, rtol=0.0, atol=ROUNDING)
    np.testing.assert_array_equal(s.certain_points(scan, measured), s.certain_points(scan, tip))


@pytest.mark.parametrize("periodic", [True, False])
def test_spikes_give_the_tip(periodic: bool) -> None:
    heights = np.zeros((120, 90))
    for place in ((40, 40), (75, 30), (60, 55)):
        heights[place] = 30 * NM
    tip, pixel = s.ConicalTip(4 * NM, math.radians(50.0)), (1.0 * NM, 1.5 * NM)
    scan = s.scanned(asp.Surface(heights, *pixel, periodic=periodic), tip)
    found = s.estimated_tip(scan, (21, 15))
    x, y = (np.arange(21) - 10) * pixel[0], (np.arange(15) - 7) * pixel[1]
    true = np.minimum(tip.above_apex(x[:, None], y[None, :]), 30 * NM)  # the height of the spikes
    np.testing.assert_allclose(found.heights, true, rtol=0.0, atol=ROUNDING)


def test_estimate_bounds_the_tip_from_outside() -> None:
    true, tip = rough(periodic=True), TIPS[2]
    found = s.estimated_tip(s.scanned(true, tip), (11, 9))
    x, y = (np.arange(11) - 5) * true.dx, (np.arange(9) - 4) * true.dy
    expected = tip.above_apex(x[:, None], y[None, :])
    assert (found.heights <= expected + ROUNDING).all()
    assert found.heights.max() > 0.5 * expected.max()
    # a blunter tip moves the surface behind the scan no higher than the tip itself would
    scan = s.scanned(true, tip)
    assert (s.reconstructed(scan, found).heights <= s.reconstructed(scan, tip).heights + ROUNDING).all()


def test_noise_threshold_keeps_the_estimate_from_becoming_too_sharp() -> None:
    heights = np.zeros((120, 120))
    heights[30:100:23, 30:100:23] = 30 * NM
    tip, noise = s.ConicalTip(4 * NM, math.radians(50.0)), 0.1 * NM
    clean = s.scanned(asp.Surface(heights, NM), tip)
    drawn = np.random.default_rng(3).uniform(-noise, noise, heights.shape)
    scan = asp.Surface(clean.heights + drawn, NM)
    x = (np.arange(17) - 8) * NM
    true = tip.above_apex(x[:, None], x[None, :])
    sharp = s.estimated_tip(scan, (17, 17)).heights
    kept = s.estimated_tip(scan, (17, 17), noise=2 * noise).heights
    assert (sharp - true).max() > noise
    # no difference of two heights is wrong by more than twice the noise, so that the bound holds
    assert (kept <= true + ROUNDING).all()
    assert (true - kept).max() <= 4 * noise  # the threshold, and the error of a difference


def test_refusals() -> None:
    scan = rough(periodic=False)
    with refused(asp.errors.InputError, "radius (m) of SphericalTip"):
        s.SphericalTip(-1.0)
    with refused(asp.errors.InputError, "opening (rad) of ConicalTip"):
        s.ConicalTip(NM, 4.0)
    with refused(asp.errors.InputError, "heights of a tip (m)", "(3, 4)"):
        s.MeasuredTip(np.zeros((3, 4)), NM)
    with refused(asp.errors.InputError, "heights of a tip (m)"):
        s.MeasuredTip(np.ones((3, 3)), NM)
    with refused(asp.errors.InputError, "pixels of a tip"):
        s.reconstructed(scan, s.MeasuredTip(np.zeros((3, 3)), NM))
    with refused(asp.errors.InputError, "tip"):
        s.reconstructed(scan, s.ParabolicTip(1e-3))
    with refused(asp.errors.InputError, "numbers of pixels of a tip"):
        s.estimated_tip(scan, (4, 5))
    with refused(asp.errors.InputError, "scan"):
        s.estimated_tip(scan, (41, 41))
