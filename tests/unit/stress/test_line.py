"""Stress under line contacts: closed forms, quadrature, limits, agreement with the contact and with
other boundaries."""

import numpy as np
import pytest
from axisymmetric import wavenumbers
from refusals import refused

import asperity as asp
from asperity.core.tensor import AXES, STRESSES
from asperity.physics.stress.compute import StressPlanes
from asperity.physics.stress.kernels.coefficients import FIELDS, LineCoefficients
from asperity.physics.stress.kernels.transfer import transfer
from asperity.physics.stress.regions import planes
from asperity.physics.stress.tractions import Tractions
from asperity.theories.single.hertz import HertzLine
from asperity.theories.subsurface.hertz import hertz_line_normal

BODY = asp.Layered(
    [asp.Layer(asp.Elastic(4.0, 0.2), 0.8), asp.Layer(asp.Elastic(0.5, 0.4), 1.5)], asp.Elastic(1.0, 0.3)
)
GRID = asp.Grid((24, 1), (0.5, 1.0))
LOADS = ("x", "y", "z")


def cylinder(body, n=201, half=2.0, radius=50.0, load=0.05):
    """Contact of a cylinder pressed with ``load`` per length; pixels of 2 half / n."""
    x = np.linspace(-half, half, n)
    surface = asp.Surface(-(x[:, None] ** 2) / (2 * radius), x[1] - x[0], 1.0)
    return asp.solve(asp.ContactProblem(surface, body, boundary=asp.FreeLine()), asp.Force(load))


def test_hertz_line_contact():
    """Stress on the axis in closed form (Johnson 1985, eq. 4.46); pixels of a/45 leave 2e-3 of
    p0."""
    body = asp.Elastic(1.0, 0.3)
    result = cylinder(body)
    answer = HertzLine(body.plane_strain_modulus, 50.0).at_load(0.05)
    a, p0 = float(answer.radius), float(answer.max_pressure)
    zeta = np.array([0.2, 0.5, 0.786, 2.0])
    field = asp.stress(result, zeta * a, on=asp.stresses.DepthProfile())
    closed = hertz_line_normal(0.0 * zeta, zeta, 1.0, shear=1.0, nu=0.3).stress
    np.testing.assert_allclose(field.normal_zz / p0, closed.zz, atol=3e-3)
    np.testing.assert_allclose(field.normal_xx / p0, closed.xx, atol=3e-3)
    np.testing.assert_allclose(field.normal_yy, 0.3 * (field.normal_xx + field.normal_zz), atol=1e-12)
    assert set(field.citation_keys) == {"Johnson1985", "Liu2002", "Flamant1892"}


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("depth", [0.3, 0.8, 1.4, 2.3, 4.0])
def test_coefficients_agree_with_quadrature(load, depth):
    """∫ F cos(αx) 2 sin(αa)/α dα by Gauss panels, at both sides of interfaces; 1e-8 was found, near
    the surface.

    Displacements along the load are compared by differences between offsets, which no datum
    changes.
    """
    a, dx = 0.5 * GRID.spacing[0], GRID.spacing[0]
    for plane in planes(BODY, [depth]):
        ready = LineCoefficients(BODY, plane, GRID, 12.0)
        found = vars(ready.stress(load)) | {axis: getattr(ready.displacement(load), axis) for axis in AXES}
        alpha, weight = wavenumbers(45.0 / plane.depth, 24 * dx + plane.depth)
        amplitudes, nu = transfer(BODY, plane, alpha), plane.region.material.poisson_ratio
        for name, (amplitude, cosine, sign) in FIELDS[load].items():
            along = cosine and name in AXES
            datum = np.cos(alpha * 3 * dx) if along else 0.0
            for k in (0, 1, 6, 23):
                wave = (np.cos if cosine else np.sin)(alpha * k * dx) - datum
                integrand = amplitude(amplitudes, nu) * 2 * np.sin(alpha * a) / alpha * wave
                here = found[name][k, 0] - (found[name][3, 0] if along else 0.0)
                assert here == pytest.approx(sign * float((integrand * weight).sum()) / np.pi, abs=1e-7)


@pytest.mark.parametrize("load", LOADS)
def test_identical_layers_are_a_half_space(load):
    """Remainders by transform against closed forms of strips; 1e-9 of unit traction is the accuracy
    of the tables."""
    solid = asp.Elastic(2.0, 0.3)
    layered = asp.Layered([asp.Layer(solid, 0.7), asp.Layer(solid, 1.1)], solid)
    for depth in (0.0, 0.4, 1.2, 3.0):
        (bare,) = planes(solid, [depth])
        one = LineCoefficients(asp.Layered((), solid), bare, GRID, 12.0)
        for plane in planes(layered, [depth]):
            other = LineCoefficients(layered, plane, GRID, 12.0)
            for name in STRESSES:
                np.testing.assert_allclose(
                    getattr(other.stress(load), name), getattr(one.stress(load), name), atol=1e-9
                )
            for name in AXES:
                wanted = getattr(one.displacement(load), name)
                np.testing.assert_allclose(getattr(other.displacement(load), name), wanted, atol=1e-9)


@pytest.mark.parametrize(
    "body",
    [asp.Elastic(1.0, 0.3), BODY, asp.Layered([asp.Layer(asp.Elastic(1.0, 0.2), 1.0)], asp.RigidBase())],
    ids=["half-space", "layered", "rigid base"],
)
def test_surface_displacement_is_that_of_the_contact(body):
    """Coefficients of the contact are good to 1e-8; the datum is the same."""
    result = cylinder(body, n=61)
    u = asp.stress(result, [0.0], displacement=True).displacement.z[0]
    np.testing.assert_allclose(u, result.displacement, atol=1e-7 * np.abs(u).max())


def test_a_long_period_is_nearly_free():
    """Images in a period of 256 change the stress of a load of width 4 by its share of the cell;
    the mean mode is left."""
    n = 512
    grid = asp.Grid((n, 1), (0.5, 1.0))
    x = grid.centred_coordinates()[0]
    pressure = np.exp(-(x**2) / 2.0)
    shear = asp.stresses.Sliding(0.3, 0.5)
    periodic, free = (
        StressPlanes(Tractions(grid, pressure, shear, kind), BODY, [1.0, 3.0]).whole()
        for kind in ("periodic", "free line")
    )
    near = slice(n // 2 - 20, n // 2 + 20)
    for name in STRESSES:
        one, other = (getattr(field.tensor, name)[:, near, 0] for field in (periodic, free))
        np.testing.assert_allclose(one, other, atol=0.02)


def test_continuity_across_interfaces():
    grid = asp.Grid((16, 1), (0.4, 1.0))
    rng = np.random.default_rng(3)
    loads = Tractions(grid, rng.random((16, 1)), asp.stresses.ShearTraction(*rng.random((2, 16, 1))), "free line")
    field = StressPlanes(loads, BODY, [0.8, 2.3]).whole(displacement=True)
    for above in (0, 2):
        for component in (field.normal_zz, field.shear_xz, field.shear_yz, *vars(field.displacement).values()):
            np.testing.assert_allclose(component[above + 1], component[above], atol=1e-7)


def test_a_free_line_has_one_point_along_y():
    with refused(asp.InputError, "grid of a free line"):
        Tractions(asp.Grid((4, 2), (1.0, 1.0)), np.zeros((4, 2)), asp.stresses.Sliding(0.0), "free line")


SLIPPING = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.2), 0.8, asp.Frictionless())], asp.Elastic(1.0, 0.3))


def test_a_layer_that_slips_carries_a_sheared_line_to_both_sides():
    """Nothing else holds it: σxx over its thickness is the force of half the traction on either
    side, σxy likewise; in the base there is none far away. Gauss points are exact for the smooth
    profile; waves die out like exp(-πx/h)."""
    grid = asp.Grid((64, 1), (0.25, 1.0))
    pressure, (qx, qy) = np.zeros((2, 64, 1))[0], np.zeros((2, 64, 1))
    qx[30:33], qy[30:33] = 2.0, 1.0
    loads = Tractions(grid, pressure, asp.stresses.ShearTraction(qx, qy), "free line")
    nodes, weights = np.polynomial.legendre.leggauss(8)
    field = StressPlanes(loads, SLIPPING, 0.4 * (1.0 + nodes)).whole()
    force = np.einsum("k,kx->x", 0.4 * weights, field.normal_xx[..., 0])
    across = np.einsum("k,kx->x", 0.4 * weights, field.shear_xy[..., 0])
    np.testing.assert_allclose(force[40:], -0.5 * 1.5, rtol=1e-3)
    np.testing.assert_allclose(force[:22], 0.5 * 1.5, rtol=1e-3)
    np.testing.assert_allclose(across[40:], -0.5 * 0.75, rtol=1e-6)
    np.testing.assert_allclose(across[:22], 0.5 * 0.75, rtol=1e-6)
    base = StressPlanes(loads, SLIPPING, [0.8, 2.0]).whole().within(1)
    np.testing.assert_allclose(base.shear_xz[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(base.shear_xy, 0.0, atol=1e-9)
    with refused(asp.InputError, "displacement under shear traction"):
        StressPlanes(loads, SLIPPING, [0.4]).whole(displacement=True)
