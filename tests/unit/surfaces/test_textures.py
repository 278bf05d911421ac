"""Textures: closed forms at nodes, periods, volumes in closed form, and refusals."""

import numpy as np
import pytest
from refusals import refused

from asperity import generate as g
from asperity.core.errors import InputError
from asperity.core.grid import Grid

GRID = Grid((240, 180), (1e-7, 2e-7))  # 24 µm x 36 µm
PITCH = (8e-6, 12e-6)

TEXTURES = {
    "laser bumps": lambda grid: g.laser_bumps(
        grid, pitch=PITCH, rim_height=2e-8, rim_radius=1.5e-6, rim_width=4e-7, depth=1e-8
    ),
    "dimples": lambda grid: g.dimples(grid, pitch=PITCH, radius=1e-6, depth=1e-7, sharpness=2.0),
    "pillars": lambda grid: g.dimples(grid, pitch=PITCH, radius=1e-6, depth=1e-7, raised=True),
    "vee grooves along y": lambda grid: g.grooves(grid, pitch=8e-6, width=3e-6, depth=1e-7),
}


@pytest.mark.parametrize("name", TEXTURES)
def test_texture_repeats_with_its_pitch_and_is_symmetric(name):
    surface = TEXTURES[name](GRID)
    h = surface.heights
    assert surface.periodic
    assert (surface.dx, surface.dy) == GRID.spacing
    np.testing.assert_allclose(np.roll(h, 80, axis=0), h, rtol=0.0, atol=1e-18)
    np.testing.assert_allclose(np.roll(h, 60, axis=1), h, rtol=0.0, atol=1e-18)
    # even about the centre, node (nx // 2, ny // 2)
    np.testing.assert_allclose(np.roll(h[::-1, ::-1], (1, 1), axis=(0, 1)), h, rtol=0.0, atol=1e-18)
    assert name.split(" along")[0] in surface.origin.history[0]


def test_closed_forms_at_nodes():
    i, j = 120 + 7, 90 - 4
    r = np.hypot(7e-7, 8e-7)
    bump = 2e-8 * np.exp(-(((r - 1.5e-6) / 4e-7) ** 2)) - 1e-8 * np.exp(-((r / 1.5e-6) ** 2))
    assert TEXTURES["laser bumps"](GRID).heights[i, j] == pytest.approx(bump, rel=1e-10)
    assert TEXTURES["dimples"](GRID).heights[i, j] == pytest.approx(-1e-7 * np.exp(-((r / 1e-6) ** 4)), rel=1e-10)
    assert TEXTURES["pillars"](GRID).heights[i, j] == pytest.approx(1e-7 * (np.exp(-((r / 1e-6) ** 2)) - 1), rel=1e-10)
    assert TEXTURES["vee grooves along y"](GRID).heights[i, j] == pytest.approx(-1e-7 * (1 - 7e-7 / 1.5e-6), rel=1e-10)


def test_volume_of_gaussian_dimples():
    """Σ h dx dy = -n π a² d: sums of smooth periodic functions are exact to exp(-(π a/Δ)²)."""
    surface = g.dimples(GRID, pitch=PITCH, radius=1e-6, depth=1e-7)
    assert surface.heights.sum() * GRID.pixel_area == pytest.approx(-9 * np.pi * 1e-12 * 1e-7, rel=1e-9)


@pytest.mark.parametrize(("section", "mean"), [("vee", 1 / 2), ("round", 2 / 3), ("cosine", 1 / 2)])
@pytest.mark.parametrize("axis", ["x", "y"])
def test_grooves_have_the_section_asked_for(section, mean, axis):
    grid = Grid((4000, 2), (1e-8, 1e-6)) if axis == "y" else Grid((2, 4000), (1e-6, 1e-8))
    surface = g.grooves(grid, pitch=1e-5, width=4e-6, depth=3e-7, section=section, axis=axis)
    assert np.ptp(surface.heights, axis=1 if axis == "y" else 0).max() == 0.0
    # mean depth of the section times its share of the pitch; trapezoidal error of 400 nodes per
    # groove
    assert surface.heights.mean() == pytest.approx(-3e-7 * mean * 0.4, rel=1e-4)
    assert surface.heights.max() == 0.0
    assert surface.heights.min() == pytest.approx(-3e-7, rel=1e-12)


def test_dome_for_a_rim_of_radius_zero():
    made = g.laser_bumps(GRID, pitch=PITCH, rim_height=2e-8, rim_radius=0.0, rim_width=1e-6)
    assert made.heights[120, 90] == made.heights.max() == pytest.approx(2e-8)


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: g.grooves(GRID, pitch=7e-6, width=1e-6, depth=1e-7), "grid size along x"),
        (lambda: g.grooves(GRID, pitch=8e-6, width=9e-6, depth=1e-7), "width of the grooves"),
        (lambda: g.grooves(GRID, pitch=8e-6, width=1e-6, depth=1e-7, section="u"), "section of grooves()"),
        (lambda: g.grooves(GRID, pitch=8e-6, width=1e-6, depth=1e-7, axis="z"), "axis of grooves()"),
        (lambda: g.dimples(GRID, pitch=(8e-6,), radius=1e-6, depth=1e-7), "pitch (m) of dimples()"),
        (lambda: g.dimples(GRID, pitch=PITCH, radius=1e-6, depth=1e-7, sharpness=0.5), "sharpness of dimples()"),
        (
            lambda: g.laser_bumps(GRID, pitch=PITCH, rim_height=1e-8, rim_radius=-1.0, rim_width=1e-6),
            "rim_radius (m) of laser_bumps()",
        ),
        (
            lambda: g.laser_bumps(GRID, pitch=PITCH, rim_height=0.0, rim_radius=0.0, rim_width=1e-6),
            "rim_height (m) of laser_bumps()",
        ),
    ],
)
def test_refusals(make, subject):
    with refused(InputError, subject):
        make()
