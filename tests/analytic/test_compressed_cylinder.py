"""Cylinders between platens: upright and bonded against reference values, with little friction
against first order, lying against the series of a disc."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused
from scipy.special import j1

import asperity as asp
from asperity import theories
from asperity.fem import compressed_cylinder
from asperity.fem.elements import Elements
from asperity.fem.linear import held
from asperity.fem.quadratic import quadratic_mesh, quadratic_plane_strain, quadratic_rings
from asperity.fem.solid import Solid


@pytest.mark.parametrize("kind", [quadratic_rings, quadratic_plane_strain])
def test_elements_of_nine_points_hold_uniform_strain(kind) -> None:
    """And a field whose strain is linear, which is in balance without forces inside."""
    grid = quadratic_mesh(np.array([0.0, 0.3, 1.0]), np.array([0.0, 0.7, 0.9, 1.5]))
    elements: Elements = kind(grid)
    x, z = grid.points.T
    known = np.stack([0.003 * x, -0.008 * z], axis=1).ravel()
    body = Solid(elements, (asp.Elastic(1.0, 0.3),))
    edge = (x == 0.0) | (x == 1.0) | (z == 0.0) | (z == 1.5)
    matrix = elements.pattern.matrix(body.entries)
    np.testing.assert_allclose(held(matrix, known, np.repeat(edge, 2)), known, atol=1e-15)
    if kind is quadratic_plane_strain:  # pure bending: u_x = x z, u_z = -(x² + ν/(1-ν) z²)/2
        known = np.stack([x * z, -0.5 * (x**2 + 0.3 / 0.7 * z**2)], axis=1).ravel()
        np.testing.assert_allclose(held(matrix, known, np.repeat(edge, 2)), known, atol=1e-13)


@every_row(reference("missing/bonded_cylinder"))
def test_bonded_cylinders_of_reference(row: Row) -> None:
    """By two codes, whose extrapolation moved by the error of the row; 2e-5 is that of the mesh."""
    solid, height = asp.Elastic(3e9, row["nu"]), row["height_over_diameter"]
    found = compressed_cylinder(solid, 0.02 * height, 0.02)
    error = 2e-5 + row["rel_extrapolation"]
    assert found.apparent_modulus / 3e9 == pytest.approx(row["E_apparent_over_E"], rel=error)
    assert found.oedometer_modulus / 3e9 == pytest.approx(row["oedometer_over_E"], rel=1e-7)
    assert found.stick_radius == 0.01
    assert found.bulge[0] == 0.0
    assert np.all(found.bulge[1:] > 0.0)


def test_a_bonded_disc_that_is_ever_flatter_comes_to_the_oedometer() -> None:
    """From below, by what the rim of one height gives way: in proportion to height over
    diameter."""
    solid = asp.Elastic(1.0, 0.3)
    short = [
        1.0 - found.apparent_modulus / found.oedometer_modulus
        for found in (compressed_cylinder(solid, height, 1.0, parts=4) for height in (0.04, 0.02, 0.01))
    ]
    ratios = np.array(short[:-1]) / np.array(short[1:])
    np.testing.assert_allclose(ratios, 2.0, rtol=0.05)
    assert abs(ratios[1] - 2.0) < abs(ratios[0] - 2.0)


def test_little_friction_adds_two_thirds_of_friction_times_poissons_ratio_over_slenderness() -> None:
    """Betti's theorem with the uniform field; what is left is of second order."""
    solid, height = asp.Elastic(1.0, 0.4), 1.5
    left = []
    for friction in (0.02, 0.01):
        found = compressed_cylinder(solid, height, 1.0, friction=friction, parts=8)
        left.append(found.apparent_modulus - 1.0 - 2.0 / 3.0 * friction * 0.4 / height)
    assert left[0] / left[1] == pytest.approx(4.0, rel=0.03)
    assert abs(left[1]) < 0.02 * 2.0 / 3.0 * 0.01 * 0.4 / height


def test_friction_leads_from_free_ends_to_bonded_ones() -> None:
    """Rings of four points come to the bonded value as their size falls, first order in it."""
    solid = asp.Elastic(1.0, 0.3)
    free = compressed_cylinder(solid, 1.0, 1.0, friction=0.0, parts=8)
    assert free.apparent_modulus == pytest.approx(1.0, rel=1e-10)
    np.testing.assert_allclose(free.bulge, 0.15, rtol=1e-9)  # ν/2 of height over diameter 1
    moduli, sticks = zip(
        *(
            (found.apparent_modulus, found.stick_radius)
            for found in (compressed_cylinder(solid, 1.0, 1.0, friction=mu, parts=8) for mu in (0.1, 0.2, 0.3, 2.0))
        ),
        strict=True,
    )
    assert np.all(np.diff(moduli) > 0.0)
    assert np.all(np.diff(sticks) > 0.0)
    bonded = compressed_cylinder(solid, 1.0, 1.0).apparent_modulus
    assert moduli[-1] == pytest.approx(bonded, rel=4e-4)
    finer = compressed_cylinder(solid, 1.0, 1.0, friction=2.0, parts=16).apparent_modulus
    assert abs(finer - bonded) < 0.6 * abs(moduli[-1] - bonded)


def test_cylinders_that_cannot_be() -> None:
    solid = asp.Elastic(1.0, 0.3)
    with refused(asp.InputError, "friction of the platens"):
        compressed_cylinder(solid, 1.0, 1.0, friction=-0.1)
    with refused(asp.InputError, "elements over radius or half height"):
        compressed_cylinder(solid, 1.0, 1.0, parts=2)
    with refused(asp.InputError, "Poisson's ratio of a meshed solid"):
        compressed_cylinder(asp.Elastic(1.0, 0.5), 1.0, 1.0)


def disc_compression(half_width: float, modes: int) -> float:
    """Approach times E* over load of a disc of radius 1 and ν = 0.3 under two opposite Hertz
    pressures, by the series of its radial displacement in even n."""
    G, kappa, n = 0.5 * (1.0 - 0.3), 3.0 - 4.0 * 0.3, np.arange(2.0, modes, 2.0)  # E* = 1
    compliance = (1.0 / (n - 1.0) + kappa / (n + 1.0)) / (4.0 * G)
    pressure = 2.0 / np.pi * 2.0 * j1(n * half_width) / (n * half_width)
    return 2.0 * float((kappa - 1.0) / (4.0 * G * np.pi) + (compliance * pressure).sum())


def test_a_lying_cylinder_is_compressed_as_the_series_of_a_disc() -> None:
    """Johnson's formula and the next term, which is that of the strain (1 - 2ν)p/2G along a curved
    surface, up to the square of a/R and its logarithm: 0.01 ln(20)/0.04 ln(10) = 1/3.1."""
    left = []
    for a in (0.2, 0.1):
        load = 0.25 * np.pi * a**2
        found = theories.CompressedCylinder(1.0, 1.0).at_load(load)
        assert found.radius == pytest.approx(a, rel=1e-14)
        more = 2.0 * (1.0 - 2.0 * 0.3) * a / (3.0 * np.pi * 0.35)
        left.append(abs(found.approach / load + more - disc_compression(a, 400000)))
    assert left[0] < 0.2**2
    assert left[0] / left[1] == pytest.approx(3.1, rel=0.1)


def test_the_stiffness_of_a_lying_cylinder_is_the_slope_of_its_load() -> None:
    roller = theories.CompressedCylinder(1e11, 1e-3)
    low, middle, high = (roller.at_load(load) for load in (0.999e4, 1e4, 1.001e4))
    assert middle.stiffness == pytest.approx(20.0 / (high.approach - low.approach), rel=1e-6)
    rest = roller.at_load(0.0)
    assert (rest.approach, rest.stiffness, rest.radius) == (0.0, 0.0, 0.0)
