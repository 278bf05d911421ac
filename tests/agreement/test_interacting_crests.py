"""Crests that press each other down against the boundary-element solution of the same smooth
bumps."""

from __future__ import annotations

import numpy as np
import pytest
from contact_cases import TIGHT, elastic

import asperity as asp
from asperity.theories.rough.interacting_crests import InteractingCrests

PIXEL, N = 8e-9, 160
RADIUS, MODULUS, DELTA = 1e-6, 1e11, 8e-9
# on pixels, so that first touch is that of the crests; contact radii are about 90 nm, distances
# five times that
PLACES = np.array([[40, 40], [96, 44], [48, 104], [112, 112]])
HEIGHTS = np.array([0.0, -1e-9, -2e-9, -5e-10])


def solved(shape: str, wavelength: float) -> asp.ContactResult:
    x = PIXEL * np.arange(N)
    r2 = [(x[:, None] - PIXEL * i) ** 2 + (x[None, :] - PIXEL * j) ** 2 for i, j in PLACES]
    depth = wavelength**2 / (2.0 * np.pi**2 * RADIUS)
    if shape == "paraboloid":
        drops = [d / (2.0 * RADIUS) for d in r2]
    else:
        drops = [0.5 * depth * (1.0 - np.cos(np.minimum(2.0 * np.pi * np.sqrt(d) / wavelength, np.pi))) for d in r2]
    heights = np.max([z - drop for z, drop in zip(HEIGHTS, drops, strict=True)], axis=0)
    problem = asp.ContactProblem(asp.Surface(heights, PIXEL), elastic(MODULUS), boundary=asp.Free())
    return asp.solve(problem, asp.Approach(DELTA), solver=TIGHT)


def crests(shape: str, wavelength: float, interaction: str = "far field") -> InteractingCrests:
    x, y = PIXEL * PLACES.T.astype(float)
    depth = np.full(4, wavelength**2 / (2.0 * np.pi**2 * RADIUS))
    area = (N * PIXEL) ** 2
    return InteractingCrests(
        MODULUS, x, y, HEIGHTS, depth, np.full(4, wavelength), area, interaction=interaction, shape=shape
    )


@pytest.mark.parametrize(("shape", "wavelength"), [("paraboloid", 1e-6), ("sine", 8e-7)])
def test_loads_of_interacting_crests_are_those_of_the_solver(shape, wavelength):
    result = solved(shape, wavelength)

    def shares(interaction: str) -> tuple[float, float]:
        """Load and area over those of the solver."""
        theory = crests(shape, wavelength, interaction)
        found = theory.at_separation(theory.highest - DELTA)
        areas = found.area_fraction / (result.contact_area / theory.area)
        return float((found.pressure * theory.area / result.force)[0]), float(areas[0])

    # ten pixels to a contact radius leave below 1 % in the load and a pixel of the rim in the area;
    # point forces 0.4 % of the displacements between crests; two terms of the sine 0.3 % at a/λ =
    # 0.11
    load, area = shares("far field")
    assert load == pytest.approx(1.0, abs=0.01)
    assert area == pytest.approx(1.0, abs=0.03)
    assert 1.2 < shares("off")[0] < 1.35  # crests that stand alone carry a quarter too much
