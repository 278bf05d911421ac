"""Uniform traction on a rectangle: independent cubature, the far field, the surface, lattices of
coefficients."""

import numpy as np
import pytest
from elastic_fields import constants, expected, found, label
from reference_data import every_row, reference

from asperity.core.grid import Grid
from asperity.physics.stress.kernels.patch import Patch, displacement_coefficients, patch_fields, stress_coefficients
from asperity.solids.compliance.influence import patch_displacement
from asperity.theories.subsurface.loads import boussinesq, cerruti

ROWS = reference("homogeneous_patch")
BODY = {"shear": 0.4, "nu": 0.3}


@every_row(ROWS, label=label)
def test_all_fields_agree_with_cubature(row):
    """The table is accurate to 1e-13 absolute per unit traction. Worst difference found: 4e-14."""
    fields = patch_fields(
        row["x"], row["y"], row["z"], Patch((2 * row["a"], 2 * row["b"]), row["load"]), **constants(row)
    )
    np.testing.assert_allclose(found(fields), expected(row), atol=1e-13, rtol=0)


def test_reference_rows_cover_all_loads_and_the_surface():
    assert {row["load"] for row in ROWS} == {"x", "y", "z"}
    assert sum(row["z"] == 0.0 for row in ROWS) > 10


@pytest.mark.parametrize("load", ["x", "y", "z"])
def test_far_field_joins_the_near_field_and_is_a_point_force(load):
    """Corner differences lose eps (d/a)³, about 1e-8 of the field, where the four forces take
    over."""
    direction = np.array([0.48, 0.6, 0.64])
    inner, outer = (
        found(patch_fields(*(d * direction), Patch((1.0, 2.0), load), **BODY)) * ([d] * 3 + [d**2] * 6)
        for d in (599.999999, 600.000001)
    )
    np.testing.assert_allclose(inner, outer, atol=1e-7 * np.abs(outer).max(), rtol=0)
    far = 1e5 * direction
    point = {
        "z": lambda: boussinesq(*far, **BODY),
        "x": lambda: cerruti(*far, **BODY),
        "y": lambda: cerruti(far[1], far[0], far[2], **BODY).exchanged(),
    }[load]()
    wanted = 2.0 * found(point)  # the size of the next term is (side / distance)² = 4e-10
    np.testing.assert_allclose(found(patch_fields(*far, Patch((1.0, 2.0), load), **BODY)), wanted, rtol=1e-7)


def test_mean_values_on_the_edges_of_the_surface():
    """Inside the traction, on an edge half of it, on a corner a quarter."""
    x, y = np.array([0.0, 0.5, 0.5, 0.7]), np.array([0.0, 0.0, 1.0, 0.0])
    for load, component in (("x", "xz"), ("y", "yz"), ("z", "zz")):
        stress = patch_fields(x, y, 0.0, Patch((1.0, 2.0), load), **BODY).stress
        np.testing.assert_allclose(getattr(stress, component), [-1.0, -0.5, -0.25, 0.0], atol=1e-15)


@pytest.mark.parametrize("load", ["x", "y", "z"])
@pytest.mark.parametrize("z", [0.0, 0.3e-6, 5e-6])
def test_coefficients_are_the_fields_at_the_pixels(load, z):
    """dx != dy, nx != ny, lengths of micrometres; differences are roundings of corner sums up to 11
    sides away."""
    grid = Grid((6, 11), (1e-6, 0.6e-6))
    x, y = grid.coordinates()
    fields = patch_fields(x, y, z, Patch(grid.spacing, load), shear=2e9, nu=0.25)
    stress = stress_coefficients(grid, z, load, 0.25)
    for name, component in vars(stress).items():
        np.testing.assert_allclose(component, getattr(fields.stress, name), atol=1e-14)
    displacement = displacement_coefficients(grid, z, load, 2e9, 0.25)
    for name, component in vars(displacement).items():
        np.testing.assert_allclose(component, getattr(fields.displacement, name), atol=1e-14 * 1e-6 / 2e9)


def test_surface_displacement_is_loves():
    """The same number from the formula of the contact operator (E' = 1 there)."""
    grid, nu = Grid((5, 4), (1.0, 0.7)), 0.2
    x, y = grid.coordinates()
    love = patch_displacement(x, y, *grid.spacing) * (1.0 - nu) / 2.0
    np.testing.assert_allclose(displacement_coefficients(grid, 0.0, "z", 1.0, nu).z, love, rtol=1e-14)


def test_large_lattices_are_made_in_blocks():
    """Rows of the lattice do not depend on where a block ends."""
    grid = Grid((300, 1000), (1.0, 1.0))
    whole = stress_coefficients(grid, 0.5, "z", 0.3)
    np.testing.assert_array_equal(whole.zz[:3], stress_coefficients(Grid((3, 1000), (1.0, 1.0)), 0.5, "z", 0.3).zz)
    row = patch_fields(np.full(1000, 131.0), np.arange(1000.0), 0.5, Patch((1.0, 1.0), "z"), shear=1.0, nu=0.3)
    np.testing.assert_allclose(whole.zz[131], row.stress.zz, atol=1e-11)


@pytest.mark.parametrize("load", ["x", "z"])
def test_fields_are_in_equilibrium(load):
    """div σ = 0 by fourth-order differences; their error h⁴ f⁽⁵⁾/30 is about 1e-7 here."""
    h, point = 0.02, np.array([0.4, 0.3, 0.6])
    weights = {-2: 1.0 / 12.0, -1: -8.0 / 12.0, 1: 8.0 / 12.0, 2: -1.0 / 12.0}
    force = np.zeros(3)
    for axis, names in enumerate((("xx", "xy", "xz"), ("xy", "yy", "yz"), ("xz", "yz", "zz"))):
        for step, weight in weights.items():
            at = point + step * h * np.eye(3)[axis]
            stress = patch_fields(*at, Patch((1.0, 2.0), load), **BODY).stress
            force += weight / h * np.array([getattr(stress, name) for name in names])
    np.testing.assert_allclose(force, 0.0, atol=5e-6)
