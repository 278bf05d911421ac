"""Love's patch against independent quadrature, the point load far away, and the mean over a
half-space."""

import numpy as np
import pytest
from reference_data import every_row, reference

from asperity.core.grid import Grid
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solids.compliance.influence import patch_displacement

ROWS = [row for row in reference("homogeneous_patch") if row["load"] == "z" and row["z"] == 0.0]


@every_row(ROWS, label=lambda row: f"case{row['case']:g}")
def test_displacement_agrees_with_adaptive_cubature(row):
    """The reference is accurate to 1e-13 absolute for unit traction; E = 1 there."""
    found = patch_displacement(np.array(row["x"]), np.array(row["y"]), 2 * row["a"], 2 * row["b"])
    plane_strain = row["E"] / (1 - row["nu"] ** 2)
    assert found / plane_strain == pytest.approx(row["uz"], abs=2e-13)


def test_reference_rows_exist():
    assert len(ROWS) >= 5


def test_centre_of_square():
    """4 ln(1 + sqrt 2) / pi times side over E' (Johnson 1985, sec. 3.3)."""
    centre = patch_displacement(np.array(0.0), np.array(0.0), 2.0, 2.0)
    assert centre == pytest.approx(2.0 * 4.0 * np.log(1.0 + np.sqrt(2.0)) / np.pi, rel=1e-15)


@pytest.mark.parametrize("angle", [0.0, 0.3, np.pi / 4, np.pi / 2])
def test_far_field_joins_the_near_field(angle):
    """Closed form and multipole agree at the switch; the closed form there loses about eps
    (d/a)^3 ~ 1e-8."""
    below, above = 299.9999, 300.0001
    u = patch_displacement(np.cos(angle) * np.array([below, above]), np.sin(angle) * np.array([below, above]), 1.0, 1.0)
    assert u[0] * below == pytest.approx(u[1] * above, rel=1e-8)


def test_far_field_is_a_point_load():
    u = patch_displacement(np.array(1e5), np.array(0.0), 3.0, 2.0)
    assert u == pytest.approx(6.0 / (np.pi * 1e5), rel=1e-9)


def test_patches_tile():
    """Four quarter patches are one patch: superposition with dx different from dy."""
    x, y = np.array([0.1, 2.7, -5.0]), np.array([0.2, 0.0, 3.0])
    whole = patch_displacement(x, y, 2.0, 3.0)
    parts = sum(patch_displacement(x - i, y - j, 1.0, 1.5) for i in (-0.5, 0.5) for j in (-0.75, 0.75))
    np.testing.assert_allclose(parts, whole, rtol=1e-13)


def test_influence_is_symmetric_in_the_axes():
    wide = HalfSpace(3.0).influence(Grid((5, 7), (1.0, 2.0)))
    tall = HalfSpace(3.0).influence(Grid((7, 5), (2.0, 1.0)))
    np.testing.assert_allclose(wide, tall.T, rtol=1e-13)
