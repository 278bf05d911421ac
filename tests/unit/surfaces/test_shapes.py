"""Shapes: closed forms, highest point at zero, periodicity and refusals."""

import numpy as np
import pytest
from refusals import refused

from asperity import generate as g
from asperity.core.errors import InputError
from asperity.core.grid import Grid

GRID = Grid((32, 24), (1e-7, 2e-7))
SHAPES = {
    "sphere": lambda grid: g.sphere(grid, radius=1e-3),
    "exact sphere": lambda grid: g.sphere(grid, radius=1e-5, exact=True),
    "paraboloid": lambda grid: g.elliptic_paraboloid(grid, radius_x=1e-3, radius_y=2e-3),
    "cylinder": lambda grid: g.cylinder(grid, radius=1e-3),
    "cone": lambda grid: g.cone(grid, slope=0.1),
    "punch": lambda grid: g.flat_punch(grid, radius=1e-6, depth=1e-6),
    "rounded punch": lambda grid: g.flat_punch(grid, radius=1e-6, depth=1e-6, edge_radius=4e-7),
    "wedge": lambda grid: g.wedge(grid, slope=0.1),
    "power law": lambda grid: g.power_law(grid, exponent=3.0, radius=2e-6, height=5e-8),
    "sinusoid": lambda grid: g.sinusoid(grid, amplitude=1e-9, wavelength=1.6e-6),
    "bisinusoid": lambda grid: g.bisinusoid(grid, amplitude=1e-9, wavelength=1.6e-6),
    "flat": g.flat,
}


@pytest.mark.parametrize("name", SHAPES)
def test_highest_point_is_zero_at_the_centre_node(name):
    surface = SHAPES[name](GRID)
    assert surface.shape == GRID.shape
    assert (surface.dx, surface.dy) == GRID.spacing
    assert surface.heights.max() == 0.0
    assert surface.heights[16, 12] == 0.0
    assert surface.origin.source
    assert surface.origin.history[0].startswith("generated: ")


@pytest.mark.parametrize("name", SHAPES)
def test_only_waves_are_periodic(name):
    assert SHAPES[name](GRID).periodic is (name in ("sinusoid", "bisinusoid"))


def test_closed_forms_at_a_node():
    x, y = 5 * 1e-7, -3 * 2e-7
    node = (16 + 5, 12 - 3)
    r = np.hypot(x, y)
    expected = {
        "sphere": -(r**2) / 2e-3,
        "exact sphere": -1e-5 + np.sqrt(1e-10 - r**2),
        "paraboloid": -(x**2) / 2e-3 - y**2 / 4e-3,
        "cylinder": -(x**2) / 2e-3,
        "cone": -0.1 * r,
        "punch": 0.0,
        "rounded punch": -(4e-7 - np.sqrt(4e-7**2 - (r - 6e-7) ** 2)),
        "wedge": -0.1 * x,
        "power law": -5e-8 * (r / 2e-6) ** 3,
        "sinusoid": 1e-9 * (np.cos(2 * np.pi * x / 1.6e-6) - 1),
        "bisinusoid": 1e-9 * (np.cos(2 * np.pi * x / 1.6e-6) + np.cos(2 * np.pi * y / 1.6e-6) - 2),
    }
    for name, value in expected.items():
        # the closed form of the exact sphere cancels 5 digits, hence the absolute part
        assert SHAPES[name](GRID).heights[node] == pytest.approx(value, rel=1e-12, abs=1e-20), name


def test_cylinder_along_x_varies_along_y_only():
    heights = g.cylinder(GRID, radius=1e-3, axis="x").heights
    assert np.ptp(heights, axis=0).max() == 0.0
    assert heights[0, 0] == pytest.approx(-((12 * 2e-7) ** 2) / 2e-3, rel=1e-12)


def test_sinusoid_along_y():
    heights = g.sinusoid(GRID, amplitude=1e-9, wavelength=4.8e-6, axis="y").heights
    assert np.ptp(heights, axis=0).max() == 0.0
    assert heights.min() == pytest.approx(-2e-9, rel=1e-12)


def test_paraboloid_and_sphere_differ_by_r4():
    small = Grid((9, 9), (1e-7, 1e-7))
    parabola, sphere = g.sphere(small, radius=1e-5).heights, g.sphere(small, radius=1e-5, exact=True).heights
    x, y = small.centred_coordinates()
    r2 = x**2 + y**2
    # next term r⁴/(8R³); the one after it is smaller by r²/(2R²) < 2e-3
    np.testing.assert_allclose(parabola - sphere, r2**2 / 8e-15, rtol=2e-3, atol=1e-22)


def test_punch_depth_outside():
    heights = SHAPES["punch"](GRID).heights
    assert heights[0, 0] == -1e-6
    assert heights[26, 12] == 0.0  # r = a belongs to the punch
    assert heights[27, 12] == -1e-6


def test_power_laws_between_cone_and_punch():
    cone, parabola = (g.power_law(GRID, exponent=n, radius=1e-6, height=1e-8).heights for n in (1.0, 2.0))
    np.testing.assert_allclose(cone, g.cone(GRID, slope=0.01).heights, rtol=1e-12)
    np.testing.assert_allclose(parabola, g.sphere(GRID, radius=1e-6**2 / 2e-8).heights, rtol=1e-12)


def test_rounded_edge_meets_flat_and_flank():
    fine = Grid((400, 3), (1e-8, 1e-8))
    h = g.flat_punch(fine, radius=1e-6, depth=1e-6, edge_radius=4e-7).heights[200:, 1]
    r = np.arange(200) * 1e-8
    assert np.all(h[r <= 6e-7 + 1e-15] == 0.0)
    assert h[99] == pytest.approx(-4e-7 + np.sqrt(4e-7**2 - 3.9e-7**2))  # nearly a quarter circle down
    assert h[101] == -1e-6
    np.testing.assert_allclose(np.hypot(h[60:100] + 4e-7, r[60:100] - 6e-7), 4e-7, rtol=1e-9)


def test_wedge_along_x_varies_along_y_only():
    heights = g.wedge(GRID, slope=0.1, axis="x").heights
    assert np.ptp(heights, axis=0).max() == 0.0
    assert heights[0, 0] == pytest.approx(-0.1 * 12 * 2e-7, rel=1e-12)


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: g.wedge(GRID, slope=0.0), "slope of wedge()"),
        (lambda: g.wedge(GRID, slope=0.1, axis="z"), "axis of wedge()"),
        (lambda: g.power_law(GRID, exponent=-1.0, radius=1.0, height=1.0), "exponent of power_law()"),
        (lambda: g.flat_punch(GRID, radius=1e-6, depth=1e-7, edge_radius=2e-7), "edge radius of a punch (m)"),
        (lambda: g.sphere(GRID, radius=0.0), "radius (m) of sphere()"),
        (lambda: g.sphere(GRID, radius=1e-6, exact=True), "grid of an exact sphere"),
        (lambda: g.cylinder(GRID, radius=1.0, axis="z"), "axis of cylinder()"),
        (lambda: g.cone(GRID, slope=-1.0), "slope of cone()"),
        (lambda: g.flat_punch(GRID, radius=1e-6, depth=0.0), "depth (m) of flat_punch()"),
        (lambda: g.sinusoid(GRID, amplitude=1e-9, wavelength=1.5e-6), "grid size along x"),
        (lambda: g.sinusoid(GRID, amplitude=1e-9, wavelength=1e-7), "wavelength"),
        (lambda: g.bisinusoid(GRID, amplitude=1e-9, wavelength=3.2e-6), "grid size along y"),
        (
            lambda: g.elliptic_paraboloid(GRID, radius_x=1.0, radius_y=float("nan")),
            "radius_y (m) of elliptic_paraboloid()",
        ),
    ],
)
def test_refusals(make, subject):
    with refused(InputError, subject):
        make()
