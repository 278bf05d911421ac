"""Point and patch responses of layered bodies in real space: every row of the tables, lattices, and
free convolution."""

import functools

import numpy as np
import pytest
from elastic_fields import expected, found, label
from layered_bodies import body_of, plane_of
from reference_data import every_row, reference

import asperity as asp
from asperity.core.tensor import AXES, STRESSES, Displacement, ElasticFields, StressTensor
from asperity.physics.stress.boundaries import FreePlanes
from asperity.physics.stress.kernels import coefficients
from asperity.physics.stress.kernels.coefficients import PlaneCoefficients
from asperity.physics.stress.kernels.patch import Patch, patch_fields
from asperity.physics.stress.regions import planes
from asperity.physics.stress.tractions import ShearTraction, Sliding, Tractions
from asperity.theories.subsurface.loads import boussinesq, cerruti

PATCHES, POINTS = (
    sorted(reference(name), key=lambda row: (row["config"], row["region"], row["z"], row["load"]))
    for name in ("layered_patch_fields", "layered_point_fields")
)
LAYERED = asp.Layered(
    [asp.Layer(asp.Elastic(400.0, 0.2), 0.5), asp.Layer(asp.Elastic(50.0, 0.45), 3.0)], asp.Elastic(200.0, 0.3)
)


TERMS = {
    "pressure": coefficients.STRESS_UNDER_PRESSURE | coefficients.DISPLACEMENT_UNDER_PRESSURE,
    "shear": coefficients.STRESS_UNDER_SHEAR | coefficients.DISPLACEMENT_UNDER_SHEAR,
}


@functools.lru_cache(maxsize=8)
def kernels_of(body, plane, traction):
    names = {name for line in TERMS[traction].values() for name, _, _ in line}
    return PlaneCoefficients(body.reduced, plane, asp.Grid((1, 1), (1.0, 1.0))).kernels(names)


def point_response(body, plane, load):
    """Function of (x, y): all fields of a point force, less those of a homogeneous body in the
    outermost region."""
    traction = "pressure" if load == "z" else "shear"
    terms, kernels = TERMS[traction], kernels_of(body, plane, traction)

    def fields(x, y):
        x, y = np.broadcast_arrays(x, y)
        r = np.hypot(x, y)
        k = {name: kernel.response(r) for name, kernel in kernels.items()}
        sums = {
            key: sum(sign * k[name] * angular.factor(x / r, y / r) for name, angular, sign in line)
            for key, line in terms.items()
        }
        return ElasticFields(Displacement(*(sums[a] for a in AXES)), StressTensor(*(sums[s] for s in STRESSES)))

    return fields


def homogeneous_constants(plane):
    return {"shear": plane.region.material.shear_modulus, "nu": plane.region.material.poisson_ratio}


@pytest.mark.slow
@every_row(POINTS, label=label)
def test_point_forces_on_layered_bodies(row):
    """The table is accurate to 1e-13 absolute per unit force. Worst difference found: 6e-14, 4e-13
    of the field."""
    body = body_of(row)
    plane = plane_of(row, body, row["z"])
    x, y = np.array([row["x"]]), np.array([row["y"]])
    fields = point_response(body, plane, row["load"])(x, y)
    if plane.region.index == 0:
        force = boussinesq if row["load"] == "z" else cerruti
        fields = fields + force(x, y, row["z"], **homogeneous_constants(plane))
    np.testing.assert_allclose(found(fields)[:, 0], expected(row), atol=2e-13, rtol=0)


def graded(low, high, levels=14, gauss=12):
    """Gauss points on (low, high), in panels that halve towards zero from both sides."""
    node, weight = np.polynomial.legendre.leggauss(gauss)
    edges = {low, high} | ({0.0} if low < 0.0 < high else set())
    edges |= {s * 2.0**-k * max(abs(low), abs(high)) for k in range(levels) for s in (-1, 1)}
    inside = np.array(sorted(e for e in edges if low <= e <= high))
    middle, half = 0.5 * (inside[1:] + inside[:-1]), 0.5 * np.diff(inside)
    return (middle[:, None] + half[:, None] * node).ravel(), (half[:, None] * weight).ravel()


def patch_by_quadrature(body, plane, row):
    """All fields of a patch at the point of the ``row``: the point response over the patch, by
    brute force."""
    x, y, a, b, load = row["x"], row["y"], row["a"], row["b"], row["load"]
    if load == "y":
        turned = row | {"x": y, "y": x, "a": b, "b": a, "load": "x"}
        return patch_by_quadrature(body, plane, turned).exchanged()
    (u, wu), (v, wv) = graded(x - a, x + a), graded(y - b, y + b)
    fields = point_response(body, plane, load)(u[:, None], v[None, :]).map(lambda f: wu @ f @ wv)
    if plane.region.index > 0:
        return fields
    return fields + patch_fields(x, y, row["z"], Patch((2 * a, 2 * b), load), **homogeneous_constants(plane))


def patch_is_that_of_the_table(row):
    """The table is accurate to 1e-13 absolute per unit traction. Worst difference found: 9e-15."""
    body = body_of(row)
    plane = plane_of(row, body, row["z"])
    fields = patch_by_quadrature(body, plane, row)
    np.testing.assert_allclose(found(fields), expected(row), atol=1e-13, rtol=0)


OFTEN = PATCHES[::7]
"""Rows of the quick test; with those of the slow one they are all rows."""

test_some_patches_on_layered_bodies = every_row(OFTEN, label=label)(patch_is_that_of_the_table)
test_patches_on_layered_bodies = pytest.mark.slow(
    every_row([row for row in PATCHES if row not in OFTEN], label=label)(patch_is_that_of_the_table)
)


@functools.lru_cache(maxsize=8)
def under_the_pixel(body, plane, grid):
    return PlaneCoefficients(body.reduced, plane, grid)


@every_row([row for row in PATCHES if row["x"] == row["y"] == 0.0], label=label)
def test_coefficients_under_the_loaded_pixel(row):
    """The stated error is 1e-8 of the largest coefficient, which is this one. Worst found:
    2e-14."""
    body = body_of(row)
    plane = plane_of(row, body, row["z"])
    ready = under_the_pixel(body, plane, asp.Grid((1, 1), (2 * row["a"], 2 * row["b"])))
    fields = ElasticFields(ready.displacement(row["load"]), ready.stress(row["load"])).map(lambda f: f[0, 0])
    np.testing.assert_allclose(found(fields), expected(row), atol=1e-13, rtol=0)


def test_reference_rows_exist():
    assert len(PATCHES) == 180
    assert len(POINTS) == 166


@pytest.mark.parametrize("depth", [0.0, 0.2, 0.5, 1.3, 5.0])
@pytest.mark.parametrize("load", ["x", "y", "z"])
def test_lattices_agree_with_quadrature(load, depth):
    """Pixels near, at middle distance and far, where the coefficients are made in different ways;
    dx != dy."""
    grid = asp.Grid((40, 60), (1.0, 0.6))
    for plane in planes(LAYERED, [depth]):
        ready = PlaneCoefficients(LAYERED, plane, grid)
        found_fields = ElasticFields(ready.displacement(load), ready.stress(load))
        largest = np.abs(found(found_fields)).max(axis=(1, 2))
        for i, j in ((0, 0), (1, 0), (1, 2), (4, 5), (15, 3), (21, 1), (39, 59)):
            row = {"x": i * 1.0, "y": j * 0.6, "z": plane.depth, "a": 0.5, "b": 0.3, "load": load}
            wanted = found(patch_by_quadrature(LAYERED, plane, row))
            here = found(found_fields.map(lambda f, i=i, j=j: f[i, j]))
            np.testing.assert_array_less(np.abs(here - wanted), 1e-8 * np.maximum(largest, 1e-3 * largest[3:].max()))


@pytest.mark.parametrize("load", ["x", "y", "z"])
def test_the_effect_of_a_thin_layer_is_proportional_to_its_thickness(load):
    """At depth 8 a layer of thickness 0.004 acts to first order; the next is some ten times its
    share 5e-4 of the depth."""
    base, grid = asp.Elastic(1.0, 0.3), asp.Grid((12, 5), (1.0, 1.0))

    def stress(thickness):
        body = asp.Layered([asp.Layer(asp.Elastic(3.0, 0.2), thickness)], base)
        found = PlaneCoefficients(body.reduced, planes(body, [8.0])[0], grid).stress(load)
        return np.array(list(vars(found).values()))

    bare = stress(0.0)
    whole, half = stress(4e-3) - bare, stress(2e-3) - bare
    np.testing.assert_allclose(whole, 2.0 * half, atol=2e-2 * np.abs(whole).max())
    assert np.abs(whole).max() < 1e-2 * np.abs(bare).max()


SHEARS = {
    "none": lambda shape: Sliding(0.0),
    "sliding": lambda shape: Sliding(0.3, 0.7),
    "fields": lambda shape: ShearTraction(*np.random.default_rng(5).standard_normal((2, *shape))),
}


@pytest.mark.parametrize("shear", SHEARS)
@pytest.mark.parametrize("body", [asp.Elastic(10.0, 0.3), LAYERED], ids=["homogeneous", "layered"])
def test_free_convolution_is_the_double_sum(body, shear):
    """Every pixel on every other, one by one; nx != ny, dx != dy; rounding of the transforms."""
    shape = (5, 6)
    grid = asp.Grid(shape, (1.0, 0.7))
    pressure = np.random.default_rng(4).standard_normal(shape)
    loads = Tractions(grid, pressure, SHEARS[shear](shape), "free")
    source = FreePlanes(loads, body, threads=1)
    for plane in planes(body, [0.0, 0.5, 2.0]):
        total = np.zeros((9, *shape))
        ready = PlaneCoefficients(asp.Layered((), body) if isinstance(body, asp.Elastic) else body, plane, grid)
        for load, traction in (("z", pressure), ("x", loads.shear_x), ("y", loads.shear_y)):
            k = found(ElasticFields(ready.displacement(load), ready.stress(load)))
            for i, j, m, n in np.ndindex(*shape, *shape):
                sign = [
                    (-1.0 if m < i and (name + load).count("x") % 2 else 1.0)
                    * (-1.0 if n < j and (name + load).count("y") % 2 else 1.0)
                    for name in (*AXES, *STRESSES)
                ]
                total[:, m, n] += sign * k[:, abs(m - i), abs(n - j)] * traction[i, j]
        got = found(ElasticFields(source.displacement(plane), source.stress(plane)))
        for part in (slice(0, 3), slice(3, 9)):
            np.testing.assert_allclose(got[part], total[part], atol=1e-14 * np.abs(total[part]).max() * 10)
