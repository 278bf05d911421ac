"""Two bodies on one grid: shifts, rotations, pixels, overlaps, periods and missing points."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import GaussianAutocorrelation, gaussian
from asperity.surfaces.pair import composite, largest_rectangle, on_common_grid
from asperity.surfaces.surface import Surface


def smooth(x, y):
    """A surface known everywhere, with waves no shorter than 20."""
    return np.sin(0.31 * x + 0.1 * y) + 0.5 * np.cos(0.17 * x - 0.26 * y + 1.0)


def sampled(size, pixel, origin=(0.0, 0.0), turned=0.0):
    """Map of the known surface on the rectangle at ``origin``, turned about its middle by
    ``turned``."""
    shape = tuple(round(s / d) for s, d in zip(size, pixel, strict=True))
    x = (np.arange(shape[0])[:, None] + 0.5) * pixel[0] - 0.5 * size[0]
    y = (np.arange(shape[1])[None, :] + 0.5) * pixel[1] - 0.5 * size[1]
    along_x = np.cos(turned) * x - np.sin(turned) * y + origin[0] + 0.5 * size[0]
    along_y = np.sin(turned) * x + np.cos(turned) * y + origin[1] + 0.5 * size[1]
    return Surface(smooth(along_x, along_y), *pixel)


# bicubic splines of waves of 20 pixels: (q Δ)⁴/80 of their height, more at the borders
SPLINE = 2e-3


@settings(max_examples=20)
@given(
    shift=st.tuples(st.floats(-15.0, 15.0), st.floats(-15.0, 15.0)),
    angle=st.floats(-np.pi, np.pi),
    fine=st.floats(0.7, 1.3),
)
def test_two_maps_of_one_surface_agree_wherever_they_lie(shift, angle, fine):
    """Map 2 is taken from the place and direction to which it is then brought back."""
    one = sampled((60.0, 50.0), (1.0, 1.0))
    middle = (30.0 + shift[0], 25.0 + shift[1])
    count = (round(64 / fine), round(56 / fine))
    size = (count[0] * fine, count[1] * fine)
    other = sampled(size, (fine, fine), (middle[0] - 0.5 * size[0], middle[1] - 0.5 * size[1]), angle)
    pair = on_common_grid(one, other, shift=shift, angle=angle)
    assert pair.surface.grid == pair.counter_surface.grid
    assert pair.surface.dx == pytest.approx(min(1.0, fine))
    inner = (slice(2, -2), slice(2, -2))
    np.testing.assert_allclose(pair.surface.heights[inner], pair.counter_surface.heights[inner], atol=2 * SPLINE)
    assert pair.composite().shape == pair.surface.shape


def test_equal_grids_stay_as_they_are():
    one, other = (Surface(np.random.default_rng(s).standard_normal((20, 16)), 1.0, 1.5) for s in (1, 2))
    pair = on_common_grid(one, other)
    np.testing.assert_allclose(pair.surface.heights, one.heights, atol=1e-13)
    np.testing.assert_allclose(pair.counter_surface.heights, other.heights, atol=1e-13)
    np.testing.assert_allclose(pair.composite().heights, composite(one, other).heights, atol=1e-13)


def test_shift_by_whole_pixels_crops():
    one, other = (Surface(np.random.default_rng(s).standard_normal((20, 16)), 1.0, 1.5) for s in (1, 2))
    pair = on_common_grid(one, other, shift=(3.0, -4.5))
    np.testing.assert_allclose(pair.surface.heights, one.heights[3:, :-3], atol=1e-13)
    np.testing.assert_allclose(pair.counter_surface.heights, other.heights[:-3, 3:], atol=1e-13)


@pytest.mark.parametrize("quarter", [1, 2, 3])
def test_quarter_turns_permute_the_nodes(quarter):
    one, other = (Surface(np.random.default_rng(s).standard_normal((18, 18)), 1.0) for s in (1, 2))
    pair = on_common_grid(one, other, angle=quarter * np.pi / 2)
    np.testing.assert_allclose(pair.counter_surface.heights, turned(other.heights, quarter), atol=1e-12)


def turned(h, quarter):
    """Map turned by quarter turns from +x to +y: new(i, j) = old(j, n - 1 - i)."""
    n = len(h)
    for _ in range(quarter):
        h = np.array([[h[j, n - 1 - i] for j in range(n)] for i in range(n)])
    return h


def test_mirror_comes_before_the_turn():
    one, other = (Surface(np.random.default_rng(s).standard_normal((12, 12)), 1.0) for s in (1, 2))
    pair = on_common_grid(one, other, mirrored="x", angle=np.pi / 2)
    np.testing.assert_allclose(pair.counter_surface.heights, turned(other.heights[::-1], 1), atol=1e-12)
    assert any("turned over" in step for step in pair.counter_surface.origin.history)


def test_periodic_maps_of_one_period_stay_periodic_and_shift_exactly():
    model = GaussianAutocorrelation(1.0, 9.0)
    one = gaussian(Grid((48, 40), (1.0, 1.5)), model, seed=1)
    other = gaussian(Grid((96, 60), (0.5, 1.0)), model, seed=2)
    pair = on_common_grid(one, other, shift=(2.5, -3.0))
    assert pair.surface.periodic
    assert pair.counter_surface.periodic
    assert pair.surface.grid.spacing == (0.5, 1.0)
    np.testing.assert_allclose(pair.counter_surface.heights, np.roll(other.heights, (5, -3), axis=(0, 1)), atol=1e-12)
    np.testing.assert_allclose(pair.surface.heights[::2, ::3], one.heights[:, ::2], atol=1e-6)  # node 0 stays in place


def test_periodic_map_covers_everything():
    one = Surface(np.random.default_rng(1).standard_normal((60, 50)), 1.0)
    tile = gaussian(Grid((24, 24), (1.0, 1.0)), GaussianAutocorrelation(1.0, 4.0), seed=2)
    pair = on_common_grid(one, tile, shift=(100.0, -31.0), angle=0.4)
    assert pair.surface.shape == (60, 50)
    assert pair.counter_surface.n_missing == 0
    assert not pair.surface.periodic
    # a quarter turn and whole pixels: nodes of the tile, repeated
    straight = on_common_grid(one, tile, shift=(1.0, 2.0))
    nodes_x = (np.arange(60) - 30 - 1 + 12) % 24
    nodes_y = (np.arange(50) - 25 - 2 + 12) % 24
    np.testing.assert_allclose(straight.counter_surface.heights, tile.heights[np.ix_(nodes_x, nodes_y)], atol=1e-6)


def test_missing_points_stay_missing_and_spoil_their_neighbours_only():
    heights = np.random.default_rng(1).standard_normal((30, 30))
    heights[10:13, 20] = np.nan
    one, other = Surface(heights, 1.0), Surface(np.zeros((30, 30)), 1.0)
    same = on_common_grid(one, other).surface
    np.testing.assert_array_equal(same.mask, np.isnan(heights))
    finer = on_common_grid(one, other, spacing=(0.5, 0.5)).surface
    assert finer.mask[20:26, 40:42].all()
    assert finer.n_missing == 8 * 4  # the pixels whose middles lie between a missing node and the next one


@settings(max_examples=30)
@given(angle=st.floats(-3.0, 3.0), ratio=st.floats(0.3, 3.0), x=st.floats(-0.6, 0.6), y=st.floats(-0.6, 0.6))
def test_largest_rectangle_lies_inside_and_is_not_beaten_by_random_ones(angle, ratio, x, y):
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [ratio, 1.0] @ turn.T + [x, y]
    low, high = max(-1.0, corners[:, 0].min()), min(1.0, corners[:, 0].max())
    x0, x1, y0, y1 = largest_rectangle(corners, (low, high, -1.0, 1.0))

    def inside(px, py):
        local = (np.array([px, py]) - [x, y]) @ turn
        return bool(np.all(np.abs(local) <= np.array([ratio, 1.0]) * (1 + 1e-6))) and max(abs(px), abs(py)) <= 1 + 1e-9

    assert all(inside(px, py) for px in (x0, x1) for py in (y0, y1))
    random = np.random.default_rng(1)
    for _ in range(200):
        a, b = np.sort(random.uniform(-1, 1, 2)), np.sort(random.uniform(-1, 1, 2))
        if all(inside(px, py) for px in a for py in b):
            assert (a[1] - a[0]) * (b[1] - b[0]) <= (x1 - x0) * (y1 - y0) * (1 + 1e-3)


ONE = Surface(np.zeros((20, 20)), 1.0)


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: on_common_grid(ONE, ONE, shift=(25.0, 0.0)), "surfaces", "0 m"),
        (lambda: on_common_grid(ONE, ONE, shift=(18.5, 0.0)), "surfaces", "1.5 m"),
        (lambda: on_common_grid(ONE, ONE, spacing=(2.0, 1.0)), "pixel of the common grid along x", "2 m"),
        (lambda: on_common_grid(ONE, ONE, spacing=(0.5, -1.0)), "pixel of the common grid along y (m)", "-1.0"),
        (lambda: on_common_grid(ONE, ONE, angle=np.nan), "angle of the counter surface (rad)", "nan"),
        (lambda: on_common_grid(ONE, ONE, mirrored="z"), "mirror of the counter surface", "'z'"),
    ],
)
def test_refusals(make, subject, shown):
    with refused(InputError, subject, shown):
        make()
