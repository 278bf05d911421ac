"""Contacts limited by hardness in closed form: the flat punch with a plastic rim, the sphere at
onset."""

from __future__ import annotations

import math

import numpy as np
import pytest
from contact_cases import elastic, square_grid
from refusals import refused

import asperity as asp
from asperity.solvers import ActiveSet

TIGHT = ActiveSet(tolerance=1e-9)
HARDNESS = 0.5


def punch(n: int) -> tuple[asp.ContactProblem, float]:
    """Rigid flat punch on E* = 1, and the radius of the disk with the area of its pixels."""
    grid = square_grid(n, 2.6)
    x, y = grid.coordinates()
    inside = np.hypot(x - 1.3, y - 1.3) < 1.0
    surface = asp.Surface(np.where(inside, 0.0, -1000.0), *grid.spacing)
    posed = asp.ContactProblem(surface, elastic(1.0), boundary=asp.Free(), law=asp.Hardness(HARDNESS))
    return posed, math.sqrt(np.count_nonzero(inside) * grid.pixel_area / math.pi)


@pytest.mark.parametrize("beta", [0.4, 0.7, 0.9])
def test_flat_punch_with_a_plastic_rim(beta):
    """Rim b < r < a at the hardness, no singularity at b = β a: with h(t) = ∫ r p dr/(r² - t²)^½ =
    E* χ/2 (Sneddon 1965)

    δ = (2H/E*) (a² - b²)^½ and P = 2 H a² [arccos β + β (1 - β²)^½].
    """
    posed, a = punch(64)
    result = asp.solve(posed, asp.Approach(2.0 * HARDNESS * a * math.sqrt(1.0 - beta**2)), solver=TIGHT)
    force = 2.0 * HARDNESS * a**2 * (math.acos(beta) + beta * math.sqrt(1.0 - beta**2))
    # the outline of 49 pixels across is off by parts of a pixel: measured 8e-4 at 32², 1.4e-4 at
    # 64², 5e-5 at 128²
    assert result.force == pytest.approx(force, rel=5e-4)
    # the rim ends between two rings of pixels: half a pixel of b on either side
    pixel = 2.6 / 64 / a
    assert abs(result.plastic_area_fraction - (1.0 - beta**2)) <= 2.0 * beta * 0.5 * pixel + 0.25 * pixel**2
    assert result.indented_area == pytest.approx(result.plastic_area_fraction * math.pi * a**2, rel=1e-12)


def test_flat_punch_bears_no_more_than_hardness_times_area():
    posed, a = punch(32)
    result = asp.solve(posed, asp.Approach(50.0 * HARDNESS * a), solver=TIGHT)
    assert result.force == pytest.approx(HARDNESS * math.pi * a**2, rel=1e-12)
    assert result.mean_real_pressure == pytest.approx(HARDNESS, rel=1e-12)


def sphere(n: int, hardness: float) -> asp.ContactProblem:
    grid = square_grid(n, 0.4)
    x, y = grid.coordinates()
    surface = asp.Surface(-((x - 0.2) ** 2 + (y - 0.2) ** 2) / 2.0, *grid.spacing)
    return asp.ContactProblem(surface, elastic(1.0), boundary=asp.Free(), law=asp.Hardness(hardness))


def test_first_yield_of_a_sphere():
    """p0 = H at P = π³ R² H³/(6 E*²); the mean pressure of a pixel is that of its middle to
    (dx/a)²/8 = 2e-4."""
    found = asp.plasticity.plastic_load(sphere(64, 0.1), fraction=0.0, solver=TIGHT)
    onset = math.pi**3 * 0.1**3 / 6.0
    assert found.below.plastic_area_fraction == 0.0 < found.above.plastic_area_fraction
    assert found.above.force <= found.force * 1.001
    assert found.force == pytest.approx(onset, rel=2e-3)


def test_the_two_percent_load_of_spheres_is_similar():
    """Scaling E* and H by a factor scales the load; the load grows with the share asked for."""
    loads = [
        asp.plasticity.plastic_load(sphere(48, 0.1), fraction=share, solver=TIGHT).force
        for share in (0.0, 0.02, 0.2, 0.6)
    ]
    assert loads == sorted(loads)
    assert loads[0] < loads[-1]
    stiff = sphere(48, 0.1)
    stiff = asp.ContactProblem(stiff.surface, elastic(7.0), boundary=asp.Free(), law=asp.Hardness(0.7))
    found = asp.plasticity.plastic_load(stiff, solver=TIGHT)
    assert found.force == pytest.approx(7.0 * loads[1], rel=1e-6)
    assert not found.below.is_plastic
    assert found.above.is_plastic
    assert found.mean_pressure == found.below.mean_pressure


def test_a_smooth_surface_yields_as_a_whole():
    flat = asp.ContactProblem(asp.Surface(np.zeros((8, 8)), 1.0, periodic=True), elastic(1.0), law=asp.Hardness(0.4))
    with refused(asp.errors.NoSolutionError, "plastic share 0.02"):
        asp.plasticity.plastic_load(flat)


def test_the_first_passage_is_found_though_the_share_falls_again():
    """A pin yields at H times one pixel; pressed in, it is a small share of the flat around it that
    touches next."""
    pin = np.full((8, 8), -1.0)
    pin[3, 3] = 1.0
    posed = asp.ContactProblem(asp.Surface(pin, 1.0), elastic(1.0), boundary=asp.Free(), law=asp.Hardness(1e-3))
    found = asp.plasticity.plastic_load(posed)
    assert found.above.mean_pressure == pytest.approx(1e-3 / 64, rel=2e-3)
    assert asp.solve(posed, asp.MeanPressure(16e-3 / 64)).plastic_area_fraction < 0.02


def test_a_plastic_load_needs_a_limit():
    posed = asp.ContactProblem(sphere(8, 1.0).surface, elastic(1.0), boundary=asp.Free())
    with refused(asp.InputError, "law of a contact with a plastic load"):
        asp.plasticity.plastic_load(posed)


@pytest.mark.parametrize("share", [-0.1, 1.0, float("nan")])
def test_the_share_must_be_a_share(share):
    with refused(asp.InputError, "share of the real area"):
        asp.plasticity.plastic_load(sphere(8, 1.0), fraction=share)
