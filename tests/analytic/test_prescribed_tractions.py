"""Stresses under prescribed tractions: point, line and patch loads and arrays, against closed
forms; layered bodies."""

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.tensor import STRESSES
from asperity.theories.subsurface.hertz import hertz_normal, hertz_shear
from asperity.theories.subsurface.loads import boussinesq, cerruti, flamant_normal, flamant_tangential, strip_pressure

BODY = asp.Elastic(2.6, 0.3)
"""Shear modulus 1."""

SAME_LAYERS = asp.Layered([asp.Layer(BODY, 3.0), asp.Layer(BODY, 4.0)], BODY)
COATED = asp.Layered([asp.Layer(asp.Elastic(10.0, 0.25), 3.0)], BODY)


def grid(n=33, rows=None):
    return asp.Grid((n, n if rows is None else rows), (1.0, 1.0))


def stress(body, tractions, depths, **more):
    return asp.stress(asp.stresses.LoadedBody(body, tractions), depths, **more)


@pytest.mark.parametrize("at", [(16.0, 16.0), (16.5, 16.25)])
def test_point_load_is_that_of_boussinesq_and_cerruti(at):
    """The second moment of the four pixels is Δ²/12 + f(1 - f)Δ², whose relative effect at depth z
    is of order (Δ/z)²."""
    load = asp.stresses.PointLoad(at, normal=2.0, tangential=(0.5, -1.0))
    depth = 8.0
    field = stress(BODY, asp.stresses.Tractions.of(grid(), load, boundary="free"), [depth], displacement=True)
    x, y = (line - c for line, c in zip(grid().coordinates(), at, strict=True))
    constants = {"shear": 1.0, "nu": 0.3}
    along_y = cerruti(y, x, depth, **constants).exchanged()
    closed = boussinesq(x, y, depth, **constants) * 2.0 + cerruti(x, y, depth, **constants) * 0.5 + along_y * -1.0
    largest = np.abs(closed.stress.zz).max()
    for name in STRESSES:
        expected = getattr(closed.stress, name)
        np.testing.assert_allclose(getattr(field.tensor, name)[0], expected, atol=2.5 / depth**2 * largest)
    for name in ("x", "y", "z"):
        expected = getattr(closed.displacement, name)
        atol = np.abs(closed.displacement.z).max() / depth**2
        np.testing.assert_allclose(getattr(field.displacement, name)[0], expected, atol=atol)


def test_patch_is_that_of_love():
    """Stress below the corner of a uniformly loaded rectangle (Love 1929), in the form of Newmark;
    four of them make any point."""
    patch = asp.stresses.PatchLoad(x=(9.5, 15.5), y=(11.5, 21.5), pressure=3.0)
    z = 2.5
    field = stress(BODY, asp.stresses.Tractions.of(grid(), patch, boundary="free"), [z])

    def corner(a, b):
        r = math.sqrt(a * a + b * b + z * z)
        bend = a * b * z / r * (1.0 / (a * a + z * z) + 1.0 / (b * b + z * z))
        return math.atan2(a * b, z * r) + bend

    def below(x, y):
        sides = [(15.5 - x, 1.0), (9.5 - x, -1.0)], [(21.5 - y, 1.0), (11.5 - y, -1.0)]
        return -3.0 / (2.0 * math.pi) * sum(s * t * corner(a, b) for a, s in sides[0] for b, t in sides[1])

    for i, j in [(12, 16), (9, 12), (3, 30), (16, 22)]:
        assert field.normal_zz[0, i, j] == pytest.approx(below(i, j), rel=1e-10)


def test_hertz_pressure_with_friction_as_an_array():
    """Mean of the pressure in each pixel by 8 x 8 points; pixels of a/24 leave 0.1 % of p0 at a
    depth of a/4."""
    cell, a, mu = grid(65), 24.0, 0.3
    x, y = cell.centred_coordinates()
    fine = (np.arange(8) - 3.5) / 8.0
    squares = (x[..., None, None] + fine[:, None]) ** 2 + (y[..., None, None] + fine) ** 2
    pressure = np.sqrt(np.clip(1.0 - squares / a**2, 0.0, None)).mean(axis=(2, 3))
    depths = np.array([6.0, 12.0, 24.0])
    field = stress(BODY, asp.stresses.Tractions(cell, pressure, asp.stresses.Sliding(mu), "free"), depths)
    for number, depth in enumerate(depths):
        place = {"x": x / a, "y": y / a, "z": depth / a, "contact_radius": 1.0, "shear": 1.0, "nu": 0.3}
        closed = hertz_normal(**place).stress + hertz_shear(**place).stress * mu
        for name in STRESSES:
            np.testing.assert_allclose(getattr(field.tensor, name)[number], getattr(closed, name), atol=1e-3)


def test_line_and_strip_in_plane_strain():
    row = grid(65, rows=1)
    x = row.coordinates()[0] - 32.0
    line = asp.stresses.LineLoad((32.0, 0.0), (32.0, 1.0), normal=2.0, tangential=(1.0, 0.0))
    found = stress(BODY, asp.stresses.Tractions.of(row, line, boundary="free line"), [8.0]).tensor
    closed = flamant_normal(x, 8.0, shear=1.0, nu=0.3) * 2.0 + flamant_tangential(x, 8.0, shear=1.0, nu=0.3)
    for name in STRESSES:
        np.testing.assert_allclose(getattr(found, name)[0], getattr(closed.stress, name), atol=1e-3)
    strip = asp.stresses.PatchLoad(x=(28.5, 35.5), y=(0.0, 1.0), pressure=1.0)
    found = stress(BODY, asp.stresses.Tractions.of(row, strip, boundary="free line"), [1.5]).tensor
    closed = strip_pressure(x, 1.5, 3.5, shear=1.0, nu=0.3)
    for name in STRESSES:
        np.testing.assert_allclose(getattr(found, name)[0], getattr(closed.stress, name), atol=1e-10)


@pytest.mark.parametrize("boundary", ["periodic", "free"])
def test_layers_like_the_base_change_nothing(boundary):
    loads = (
        asp.stresses.PointLoad((10.3, 20.0), 1.0, (0.5, 0.0)),
        asp.stresses.PatchLoad((3.0, 9.2), (5.0, 7.0), 0.4, (0.0, -0.1)),
    )
    tractions = asp.stresses.Tractions.of(grid(), *loads, boundary=boundary)
    plain, layered = (stress(body, tractions, [1.0, 5.0]) for body in (BODY, SAME_LAYERS))
    for name in STRESSES:
        one, other = getattr(plain.tensor, name), getattr(layered.tensor, name)
        np.testing.assert_allclose(other, one, atol=1e-6 * np.abs(one).max())


def test_layered_body_under_the_tractions_of_a_contact_has_the_stresses_of_the_contact():
    x, y = grid().centred_coordinates()
    surface = asp.Surface(-(x**2 + y**2) / 100.0, 1.0, 1.0)
    result = asp.solve(asp.ContactProblem(surface, COATED, boundary=asp.Free()), asp.Force(30.0))
    tractions = asp.stresses.Tractions(result.problem.grid, result.pressure, asp.stresses.Sliding(0.2), "free")
    before, after = asp.stress(result, [1.0, 3.0], friction=0.2), stress(COATED, tractions, [1.0, 3.0])
    for name in STRESSES:
        np.testing.assert_array_equal(getattr(after.tensor, name), getattr(before.tensor, name))


def test_far_from_a_coating_a_point_load_is_that_of_boussinesq():
    """The stress at 80 layer thicknesses is that of the base: 1.1 % less by the layer, 0.7 % by the
    size of the pixel."""
    thin = asp.Layered([asp.Layer(asp.Elastic(5.2, 0.3), 0.1)], BODY)
    load = asp.stresses.PointLoad((16.0, 16.0), 1.0)
    found = stress(
        thin, asp.stresses.Tractions.of(grid(), load, boundary="free"), [8.0], on=asp.stresses.DepthProfile(16.0, 16.0)
    )
    assert found.normal_zz[0] == pytest.approx(-3.0 / (2.0 * math.pi * 64.0), rel=0.02)


def test_loads_keep_force_and_moment():
    cell = asp.Grid((20, 24), (0.5, 0.25))
    loads = [
        asp.stresses.PointLoad((3.3, 2.2), 2.0, (1.0, 0.5)),
        asp.stresses.LineLoad((1.0, 1.0), (6.0, 4.0), 0.3),
        asp.stresses.PatchLoad((2.1, 4.9), (1.3, 3.4), 1.5, (0.0, 0.2)),
    ]
    moments = [(2.0, 3.3, 2.2), (0.3 * math.hypot(5.0, 3.0), 3.5, 2.5), (1.5 * 2.8 * 2.1, 3.5, 2.35)]
    x, y = cell.coordinates()
    for load, (force, at_x, at_y) in zip(loads, moments, strict=True):
        amounts = asp.stresses.Tractions.of(cell, load, boundary="free").pressure * cell.pixel_area
        assert amounts.sum() == pytest.approx(force)
        assert (amounts * x).sum() / force == pytest.approx(at_x, abs=0.02)  # a patch edge moves within its pixel
        assert (amounts * y).sum() / force == pytest.approx(at_y, abs=0.02)


def test_periodic_loads_come_back_on_the_other_side():
    cell = grid(8)
    patch = asp.stresses.Tractions.of(cell, asp.stresses.PatchLoad((-2.5, 1.5), (6.5, 9.5), 1.0)).pressure
    shifted = asp.stresses.Tractions.of(cell, asp.stresses.PatchLoad((0.5, 4.5), (2.5, 5.5), 1.0)).pressure
    np.testing.assert_allclose(patch, np.roll(shifted, (-3, 4), axis=(0, 1)))
    point = asp.stresses.Tractions.of(cell, asp.stresses.PointLoad((7.5, -0.5), 1.0)).pressure
    assert point[[7, 7, 0, 0], [7, 0, 7, 0]] == pytest.approx([0.25] * 4)


def test_refusals():
    cell, row = grid(8), grid(8, rows=1)
    with refused(InputError, "x of a load", "7", "9"):
        asp.stresses.Tractions.of(cell, asp.stresses.PointLoad((9.0, 2.0), 1.0), boundary="free")
    with refused(InputError, "range of a patch along y (m)", "7.5"):
        asp.stresses.Tractions.of(cell, asp.stresses.PatchLoad((1.0, 2.0), (6.0, 9.0), 1.0), boundary="free")
    with refused(InputError, "range of a patch along x (m)", "8"):
        asp.stresses.Tractions.of(cell, asp.stresses.PatchLoad((1.0, 12.0), (6.0, 7.0), 1.0))
    with refused(InputError, "range of a patch along x (m)"):
        asp.stresses.PatchLoad((2.0, 1.0), (6.0, 9.0), 1.0)
    with refused(InputError, "end of a line load (m)"):
        asp.stresses.LineLoad((1.0, 1.0), (1.0, 1.0), 1.0)
    with refused(InputError, "point load"):
        asp.stresses.Tractions.of(row, asp.stresses.PointLoad((1.0, 0.0), 1.0), boundary="free line")
    with refused(InputError, "line load on a grid of one point along y"):
        asp.stresses.Tractions.of(row, asp.stresses.LineLoad((1.0, 0.0), (2.0, 0.0), 1.0), boundary="free line")
    with refused(InputError, "load on a grid"):
        asp.stresses.Tractions.of(cell, 1.0)
    loaded = asp.stresses.LoadedBody(BODY, asp.stresses.Tractions.of(cell, asp.stresses.PointLoad((4.0, 4.0), 1.0)))
    with refused(InputError, "friction and counter body of prescribed tractions"):
        asp.stress(loaded, [1.0], friction=0.3)
    with refused(InputError, "tractions of a loaded body"):
        asp.stresses.LoadedBody(BODY, np.zeros((3, 3)))
