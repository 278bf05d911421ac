"""Preparation: what each step must keep, what it must remove, and what it must record."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import FOLDER, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import RmsHeight, SelfAffine, gaussian
from asperity.surfaces.characterise.heights import rms_height
from asperity.surfaces.prepare.extent import cropped, periodised, resampled, tapered
from asperity.surfaces.prepare.level import filled, levelled
from asperity.surfaces.surface import Surface

GRID = Grid((36, 30), (1e-7, 1.5e-7))
FORMS = {"mean": 0, "plane": 1, "quadratic": 2}


def rough(seed=0, grid=GRID, periodic=False):
    spectrum = SelfAffine(
        amplitude=RmsHeight(1e-8), hurst=0.7, rolloff_wavelength=1.5e-6, shortest_wavelength=2.2 * max(grid.spacing)
    )
    surface = gaussian(grid, spectrum, seed=seed)
    return Surface(surface.heights, surface.dx, surface.dy, periodic=periodic, origin=surface.origin)


def with_hole(surface, region):
    mask = np.zeros(surface.shape, dtype=bool)
    mask[region] = True
    return Surface(surface.heights, surface.dx, surface.dy, periodic=surface.periodic, mask=mask)


def polynomial(degree, coefficients, grid=GRID):
    x, y = grid.coordinates()
    x, y = x / grid.size[0], y / grid.size[1]
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    return sum(c * x**a * y**b for c, (a, b) in zip(coefficients, powers, strict=False)) + np.zeros(grid.shape)


# levelling


@settings(max_examples=20)
@given(
    form=st.sampled_from(sorted(FORMS)),
    coefficients=st.lists(st.floats(-1e-6, 1e-6), min_size=6, max_size=6),
    holes=st.booleans(),
)
def test_levelling_removes_an_added_form_and_is_idempotent(form, coefficients, holes):
    base = rough()
    if holes:
        base = with_hole(base, np.s_[3:9, 10:20])
    added = Surface(base.heights + polynomial(FORMS[form], coefficients), base.dx, base.dy)
    once = levelled(base, form)
    rounding = 1e-13 * 1e-5  # fifty times the rounding of the largest added height, 6e-6 m
    np.testing.assert_allclose(levelled(added, form).heights, once.heights, rtol=0.0, atol=rounding)
    np.testing.assert_allclose(levelled(once, form).heights, once.heights, rtol=0.0, atol=rounding)
    np.testing.assert_array_equal(once.mask, base.mask)


@pytest.mark.parametrize(("form", "group"), [("plane", "detrend1"), ("quadratic", "detrend2")])
@pytest.mark.parametrize("name", ["P1", "O1", "N1", "N1m", "S1"])
def test_removed_form_is_the_reference_polynomial(name, form, group):
    maps = np.load(FOLDER / "surfaces_maps.npz")
    dx, dy = maps[f"{name}_spacing"]
    surface = Surface(maps[name], dx, dy)
    x, y = surface.grid.coordinates()
    expected = np.zeros(surface.shape)
    for row in reference("surfaces_map_heights_slopes"):
        if row["map"] == name and row["prep"] == group:
            expected += row["value"] * x ** int(row["quantity"][1]) * y ** int(row["quantity"][2])
    removed = surface.heights - levelled(surface, form).heights
    valid = ~surface.mask
    np.testing.assert_allclose(removed[valid], expected[valid], rtol=0.0, atol=1e-10)  # twelve digits are printed


@pytest.mark.parametrize(
    ("form", "kept"), [("mean", True), ("plane", False), ("quadratic", False), (0, True), (3, False)]
)
def test_a_periodic_surface_less_a_plane_is_no_longer_periodic(form, kept):
    wave = np.sin(2.0 * np.pi * np.arange(16) / 16)[:, None] * np.ones(8)
    flat = levelled(Surface(wave, 1.0, periodic=True), form)
    assert flat.periodic is kept
    before, after = (float(h[0, 0] - h[-1, 0]) for h in (wave, flat.heights))
    assert (after == pytest.approx(before, abs=1e-12)) is kept  # the step from the last point to the first


def test_levelling_in_blocks_equals_one_factorisation():
    tall = Grid((900, 100), (1e-7, 1e-7))  # more points than one block
    heights = np.random.default_rng(1).standard_normal(tall.shape)
    x, y = (c.ravel() for c in np.broadcast_arrays(*tall.centred_coordinates()))
    basis = np.column_stack([np.ones_like(x), x * 1e5, y * 1e5])
    expected = heights.ravel() - basis @ np.linalg.lstsq(basis, heights.ravel(), rcond=None)[0]
    np.testing.assert_allclose(levelled(Surface(heights, 1e-7)).heights.ravel(), expected, atol=1e-12)


def test_levelling_is_recorded_with_numbers():
    tilted = Surface(rough().heights + polynomial(1, [0.0, 0.0, 1e-6]), GRID.spacing[0], GRID.spacing[1])
    (step,) = levelled(tilted).origin.history
    assert step.startswith("levelled: plane removed (rms ")
    assert "nm -> " in step


@pytest.mark.parametrize(
    ("heights", "form", "subject", "shown"),
    [
        (np.ones((4, 4)), "cubic", "form to be removed", "'cubic'"),
        (np.ones((1, 8)), "plane", "surface", "plane"),
        (np.where(np.eye(4, dtype=bool), 1.0, np.nan), "plane", "surface", "plane"),
        (np.ones((2, 2)), "quadratic", "surface", "quadratic"),
    ],
)
def test_levelling_refuses(heights, form, subject, shown):
    with refused(InputError, subject, shown):
        levelled(Surface(heights, 1.0), form)


# cropping


@settings(max_examples=30)
@given(data=st.data())
def test_crop_has_the_asked_size_to_a_pixel_and_the_same_heights(data):
    surface = rough()
    x0 = data.draw(st.just(0.0) | st.floats(1.0e-12, 1.0e-6))  # lengths below 1e-41 m are refused
    x1 = data.draw(st.floats(x0 + 2e-7, 3.6e-6))
    part = cropped(surface, x=(x0, x1))
    assert abs(part.size[0] - (x1 - x0)) <= surface.dx * (1 + 1e-9)
    assert part.size[1] == pytest.approx(surface.size[1])
    first = round(x0 / surface.dx)
    np.testing.assert_array_equal(part.heights, surface.heights[first : first + part.shape[0]])
    assert part is surface if part.shape == surface.shape else part.origin.history[-1].startswith("cropped: ")


def test_crop_keeps_the_mask_and_drops_the_period():
    surface = with_hole(rough(periodic=True), np.s_[5:7, 5:7])
    part = cropped(surface, x=(5e-7, 1e-6), y=(0.0, 1.5e-6))
    assert part.shape == (5, 10)
    assert part.n_missing == 4
    assert not part.periodic
    assert cropped(surface).periodic


@pytest.mark.parametrize(
    ("limits", "subject", "shown"),
    [
        ({"x": (1e-6, 1e-6)}, "x (m) of cropped()", "1e-06 to 1e-06"),
        ({"x": (2e-6, 1e-6)}, "x (m) of cropped()", "2e-06 to 1e-06"),
        ({"y": (0.0, 1.0)}, "crop along y", "0 to 1 m"),
        ({"x": (-1e-6, 1e-6)}, "crop along x", "-1e-06 to 1e-06 m"),
        ({"x": (0.0, float("nan"))}, "x (m) of cropped()", "nan"),
        ({"y": 1e-6}, "y (m) of cropped()", "1e-06"),
    ],
)
def test_crop_refuses(limits, subject, shown):
    with refused(InputError, subject, shown):
        cropped(rough(), **limits)


# resampling


@pytest.mark.parametrize("shape", [(36, 30), (37, 31), (35, 30), (36, 29)])
@pytest.mark.parametrize("finer", [(72, 60), (73, 45), (37, 90), (51, 31)])
def test_periodic_refinement_interpolates_and_returns(shape, finer):
    base = Surface(np.random.default_rng(3).standard_normal(shape), 1e-7, 2e-7, periodic=True)
    fine = resampled(base, finer)
    assert fine.size == pytest.approx(base.size, rel=1e-14)
    assert fine.periodic
    np.testing.assert_allclose(resampled(fine, shape).heights, base.heights, atol=1e-13)
    if finer == (72, 60) and shape == (36, 30):
        np.testing.assert_allclose(fine.heights[::2, ::2], base.heights, atol=1e-13)


@pytest.mark.parametrize("shape", [(64, 40), (65, 41), (20, 14), (19, 15)])
def test_periodic_resampling_is_exact_for_a_resolved_wave(shape):
    def wave(grid):
        x, y = (c / s for c, s in zip(grid.coordinates(), grid.size, strict=True))
        return np.cos(2 * np.pi * (3 * x - 2 * y) + 0.4) + np.sin(2 * np.pi * 6 * y) + 0.2

    coarse = Surface(wave(GRID), *GRID.spacing, periodic=True)
    result = resampled(coarse, shape)
    np.testing.assert_allclose(result.heights, wave(result.grid), atol=1e-13)


@pytest.mark.parametrize("shape", [(72, 60), (50, 31)])
def test_spline_refinement_is_exact_for_a_cubic(shape):
    def cubic(grid):
        x, y = ((np.arange(n) + 0.5) / n for n in grid.shape)  # pixel centres, which stay in place
        x, y = x[:, None], y[None, :]
        return x**3 - 2 * x * y**3 + y**2

    result = resampled(Surface(cubic(GRID), *GRID.spacing), shape)
    np.testing.assert_allclose(result.heights, cubic(result.grid), atol=1e-12)
    assert "bicubic spline" in result.origin.history[-1]


@pytest.mark.parametrize("shape", [(18, 10), (7, 30), (35, 29)])
def test_averaging_keeps_the_volume_and_says_so(shape):
    base = rough()
    result = resampled(base, shape)
    assert result.heights.mean() == pytest.approx(base.heights.mean(), abs=1e-22)
    assert "area averaging" in result.origin.history[-1]
    assert rms_height(result) < rms_height(base)


def test_block_average_by_whole_numbers():
    base = rough()
    blocks = base.heights.reshape(18, 2, 10, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(resampled(base, (18, 10)).heights, blocks, atol=1e-22)


def test_resampling_refuses():
    with refused(InputError, "surface"):
        resampled(with_hole(rough(), np.s_[1, 1]), (8, 8))
    with refused(InputError, "points of resampled()"):
        resampled(rough(), (8, 0))
    with refused(InputError, "points of resampled()", "2"):
        resampled(rough(), 8)


# filling


@pytest.mark.parametrize("method", ["harmonic", "mean", "nearest"])
@pytest.mark.parametrize("periodic", [False, True])
def test_fill_leaves_valid_points_alone_and_stays_in_their_range(method, periodic):
    surface = with_hole(rough(periodic=periodic), np.s_[0:6, 4:12])
    result = filled(surface, method)
    assert result.n_missing == 0
    assert result.periodic is periodic
    valid = ~surface.mask
    np.testing.assert_array_equal(result.heights[valid], surface.heights[valid])
    assert result.heights.max() <= surface.heights[valid].max() * (1 + 1e-12)
    assert result.heights.min() >= surface.heights[valid].min() * (1 + 1e-12)
    assert result.origin.history[-1].startswith("filled: 48 points (4.44%")


@settings(max_examples=20)
@given(slope_x=st.floats(-1.0, 1.0), slope_y=st.floats(-1.0, 1.0), corner=st.integers(1, 12))
def test_harmonic_fill_reproduces_a_linear_function(slope_x, slope_y, corner):
    x, y = GRID.coordinates()
    plane = slope_x * x + slope_y * y
    surface = with_hole(Surface(plane, *GRID.spacing), np.s_[corner : corner + 9, corner + 2 : corner + 9])
    np.testing.assert_allclose(filled(surface).heights, plane, rtol=0.0, atol=1e-13 * 1e-5)


def test_harmonic_fill_of_a_hole_across_the_border_uses_the_period():
    heights = np.repeat(np.arange(24.0)[:, None], 8, axis=1)
    heights[20:], heights[:3] = np.nan, np.nan  # rims: 19 at node 19 and 3 at node 27 = 3
    result = filled(Surface(heights, 1.0, periodic=True)).heights[:, 0]
    nodes = np.arange(20, 27)
    np.testing.assert_allclose(result[nodes % 24], 19.0 - 2.0 * (nodes - 19), rtol=1e-12)


def test_nearest_fill_measures_in_metres_and_wraps():
    heights = np.array([[1.0, np.nan, np.nan, 4.0], [2.0, np.nan, np.nan, 5.0]])
    result = filled(Surface(heights, 1.0, 1.0), "nearest").heights
    np.testing.assert_array_equal(result, [[1.0, 1.0, 4.0, 4.0], [2.0, 2.0, 5.0, 5.0]])
    column = np.array([[1.0], [np.nan], [3.0], [4.0], [5.0], [np.nan]])
    assert filled(Surface(column, 1.0, periodic=True), "nearest").heights[5, 0] in (1.0, 5.0)
    edge = np.array([[7.0], [1.0], [2.0], [3.0], [np.nan], [np.nan]])
    assert filled(Surface(edge, 1.0, periodic=True), "nearest").heights[5, 0] == 7.0
    assert filled(Surface(edge, 1.0), "nearest").heights[5, 0] == 3.0


def test_mean_fill():
    assert filled(Surface([[1.0, np.nan], [2.0, 6.0]], 1.0), "mean").heights[0, 1] == 3.0


def test_fill_refuses_and_leaves_complete_surfaces_alone():
    surface = rough()
    assert filled(surface) is surface
    with refused(InputError, "method of filled()"):
        filled(surface, "cubic")


# making periodic


def _interior_laplacian(heights, spacing):
    h = heights
    along_x = (h[2:, 1:-1] - 2 * h[1:-1, 1:-1] + h[:-2, 1:-1]) / spacing[0] ** 2
    return along_x + (h[1:-1, 2:] - 2 * h[1:-1, 1:-1] + h[1:-1, :-2]) / spacing[1] ** 2


@pytest.mark.parametrize("shape", [(36, 30), (35, 31)])
def test_periodised_keeps_interior_curvature_and_mean(shape):
    grid = Grid(shape, (1e-7, 1.5e-7))
    base = Surface(rough(grid=grid).heights + polynomial(2, [0, 3e-8, 1e-8, -2e-8, 1e-8, 2e-8], grid), *grid.spacing)
    result = periodised(base)
    assert result.periodic
    assert result.heights.mean() == pytest.approx(base.heights.mean(), rel=1e-12)
    before, after = (_interior_laplacian(s.heights, grid.spacing) for s in (base, result))
    np.testing.assert_allclose(after, before, rtol=0.0, atol=1e-11 * np.abs(before).max())


def test_periodised_closes_the_jump_between_the_borders():
    base = Surface(rough().heights + polynomial(1, [0.0, 0.0, 2e-7]), *GRID.spacing)
    result = periodised(base)

    def jump(surface):
        return np.sqrt(np.mean((surface.heights[0] - surface.heights[-1]) ** 2))

    inside = np.sqrt(np.mean(np.diff(base.heights, axis=0) ** 2))
    assert jump(base) > 10 * inside
    assert jump(result) < 2 * inside
    assert result.origin.history[-1].startswith("periodised: smooth component")


def test_periodised_removes_nothing_where_the_borders_agree():
    heights = rough().heights.copy()
    heights[-1], heights[:, -1] = heights[0], heights[:, 0]
    heights[-1, -1] = heights[0, 0]
    result = periodised(Surface(heights, *GRID.spacing))
    np.testing.assert_allclose(result.heights, heights, atol=1e-22)


@pytest.mark.parametrize("width", [0.1, 0.5])
def test_taper_keeps_the_middle_and_ends_at_the_mean(width):
    big = rough(grid=Grid((200, 160), (1e-7, 1e-7)))
    result = tapered(big, width)
    mean = big.heights.mean()
    assert result.periodic
    inner = np.s_[int(200 * width) : 200 - int(200 * width), int(160 * width) : 160 - int(160 * width)]
    np.testing.assert_allclose(result.heights[inner], big.heights[inner], rtol=0.0, atol=1e-22)
    edge = np.sin(0.5 * np.pi * 0.5 / 200 / width) ** 2  # weight at the centre of the outermost pixel
    assert np.abs(result.heights[0] - mean).max() <= edge * np.abs(big.heights[0] - mean).max() * (1 + 1e-12)
    assert "tapered" in result.origin.history[-1]


def test_making_periodic_refuses_and_leaves_periodic_surfaces_alone():
    surface = rough(periodic=True)
    assert periodised(surface) is surface
    hole = with_hole(rough(), np.s_[2, 2])
    for make in (periodised, tapered):
        with refused(InputError, "surface"):
            make(hole)
    for width in (0.0, 0.6, -0.1):
        with refused(InputError, "width of tapered()"):
            tapered(surface, width)


def test_steps_never_change_their_input():
    surface = with_hole(rough(), np.s_[3:5, 3:5])
    before = surface.heights.copy()
    tapered(resampled(filled(levelled(surface)), (20, 20)))
    np.testing.assert_array_equal(surface.heights, before)
    assert surface.origin.history == ()


def test_sliced_lines_are_those_of_the_map():
    surface = asp.Surface(np.arange(12.0).reshape(4, 3), 1e-6, 2e-6, periodic=True)
    along_x, along_y = asp.surfaces.sliced(surface, y="middle"), asp.surfaces.sliced(surface, x=3.2e-6, length=0.5)
    np.testing.assert_array_equal(along_x.heights[:, 0], [1.0, 4.0, 7.0, 10.0])
    assert (along_x.shape, along_x.dx, along_x.dy, along_x.periodic) == ((4, 1), 1e-6, 1.0, True)
    np.testing.assert_array_equal(along_y.heights[:, 0], [9.0, 10.0, 11.0])
    assert (along_y.dx, along_y.dy) == (2e-6, 0.5)
    np.testing.assert_array_equal(asp.surfaces.sliced(surface, y=6e-6).heights, surface.heights[:, 2:])
    assert asp.surfaces.sliced(surface, y=0.0).origin.history == ("sliced: line at y = 1 µm (4 points)",)
    holed = asp.surfaces.sliced(asp.Surface([[1.0, np.nan], [2.0, 3.0]], 1.0), y=1.5)
    assert holed.n_missing == 1
    for keys, subject, shown in (
        ({}, "line of a map", "x=None, y=None"),
        ({"x": 0.0, "y": 0.0}, "line of a map", "x=0.0, y=0.0"),
        ({"y": 6.1e-6}, "y of a line", "0 and 6 µm, but is 6.1 µm"),
        ({"x": -1e-9}, "x (m) of sliced()", "-1e-09"),
        ({"x": "end"}, "x (m) of sliced()", "middle"),
        ({"x": 0.0, "length": 0.0}, "length (m) of sliced()", "0.0"),
    ):
        with refused(asp.InputError, subject, shown):
            asp.surfaces.sliced(surface, **keys)
