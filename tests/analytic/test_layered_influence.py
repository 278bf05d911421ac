"""Free influence coefficients of layered and homogeneous bodies: tables, closed forms, independent
quadratures."""

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused
from scipy import special
from solid_cases import elastic, layered, on_half_space

import asperity as asp
from asperity.solids.compliance.halfspace import HalfSpace, contact_compliance
from asperity.solids.compliance.influence import ISOTROPIC, patch_coefficients
from asperity.solids.compliance.layered import LayerStack, interface_compliances, samples
from asperity.solids.compliance.tensor import BodiesSurface, influence_tensor

ROWS = reference("layered_influence_surface")
CONFIGURATIONS = sorted({row["config"] for row in ROWS})
STATED = 1e-8
"""Relative error of ``patch_coefficients`` by its documentation."""


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_every_row_of_the_table(configuration):
    """All components under all loads, against the polar quadrature of the table (1e-13 absolute for
    a unit traction).

    On the rigid base displacements fall exponentially, to 1e-13 of the loaded pixel's; there the
    error counts against the value that a half-space of the layer's material would have.
    """
    rows = [row for row in ROWS if row["config"] == configuration]
    body, side = layered(rows[0]), rows[0]["Delta"]
    t = influence_tensor(asp.Grid((61, 61), (side, side)), body)
    for row in rows:
        i, j = abs(int(row["i"])), abs(int(row["j"]))
        x, y = np.sign(row["i"]) or 1.0, np.sign(row["j"]) or 1.0
        responses = {
            "x": (t.xx[i, j], x * y * t.xy[i, j], -x * t.xz[i, j]),
            "y": (x * y * t.xy[i, j], t.yy[i, j], -y * t.yz[i, j]),
            "z": (x * t.xz[i, j], y * t.yz[i, j], t.zz[i, j]),
        }
        expected = np.array([row["ux"], row["uy"], row["uz"]])
        distance = max(np.hypot(i, j), 0.5) * side
        half_space = side**2 / (np.pi * body.layers[0].material.plane_strain_modulus * distance)
        allowed = STATED * np.linalg.norm(expected) + 1e-12 * half_space + 2e-13
        np.testing.assert_allclose(responses[row["load"]], expected, rtol=0, atol=allowed, err_msg=str(row))


@every_row(reference("patch_center_displacement"), label=lambda row: f"case-{row['case']:g}")
def test_centre_of_a_patch(row):
    """Layers from a hundredth to a hundred times the patch (Peng 2001, fig. 3.9): rounding only."""
    body = on_half_space(row["E1_over_E2"], row["h_over_Delta"], nu=row["nu1"], nu_base=row["nu2"])
    found = LayerStack(body).influence(asp.Grid((1, 1), (1.0, 1.0)))[0, 0]
    assert found == pytest.approx(row["uz_E2_over_p_Delta"], rel=2e-13)


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 3.0), (20.0, 1.0)])
def test_three_zones_give_love_s_patch(spacing):
    """The same machinery on a homogeneous body, where Love's formula is exact to 1e-9."""
    grid = asp.Grid((150, 130), spacing)
    kernel = samples(elastic(0.91, 0.3), 1.0).kernel(lambda c: c.zz)
    np.testing.assert_allclose(patch_coefficients(kernel, grid, ISOTROPIC), HalfSpace(1.0).influence(grid), rtol=STATED)


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 2.5)])
def test_homogeneous_tensor_is_the_closed_form(spacing):
    """All nine surface components under a rectangle (Kalker 1990; Johnson 1985, sec. 3.4), summed
    over its corners."""
    G, nu = 2.0, 0.3
    grid = asp.Grid((24, 30), spacing)
    t = influence_tensor(grid, asp.Elastic(2.0 * G * (1.0 + nu), nu))
    x, y = np.broadcast_arrays(*grid.coordinates())

    def corners(f):
        a, b = 0.5 * spacing[0], 0.5 * spacing[1]
        return sum(sx * sy * f(x + sx * a, y + sy * b) for sx in (1, -1) for sy in (1, -1))

    lx = lambda X, Y: Y * np.arcsinh(X / np.abs(Y))  # noqa: E731
    ly = lambda X, Y: X * np.arcsinh(Y / np.abs(X))  # noqa: E731
    expected = {
        "xx": corners(lambda X, Y: (1 - nu) * ly(X, Y) + lx(X, Y)) / (2 * np.pi * G),
        "yy": corners(lambda X, Y: ly(X, Y) + (1 - nu) * lx(X, Y)) / (2 * np.pi * G),
        "zz": corners(lambda X, Y: ly(X, Y) + lx(X, Y)) * (1 - nu) / (2 * np.pi * G),
        "xy": -corners(np.hypot) * nu / (2 * np.pi * G),
        "xz": -corners(lambda X, Y: Y * np.log(np.hypot(X, Y)) + X * np.arctan(Y / X)) * (1 - 2 * nu) / (4 * np.pi * G),
        "yz": -corners(lambda X, Y: X * np.log(np.hypot(X, Y)) + Y * np.arctan(X / Y)) * (1 - 2 * nu) / (4 * np.pi * G),
    }
    for name, values in expected.items():
        scale = grid.pixel_area / (2 * np.pi * G * np.maximum(np.hypot(x, y), 0.5))
        np.testing.assert_array_less(np.abs(getattr(t, name) - values), STATED * scale, err_msg=name)


@pytest.mark.parametrize(
    ("layers", "base"),
    [
        ([(1e-3, 0.3, 1.0)], (1.0, 0.3)),
        ([(1e3, 0.3, 1.0)], (1.0, 0.3)),
        ([(100.0, 0.2, 0.05), (0.01, 0.5, 0.2), (3.0, 0.45, 1.0)], (1.0, 0.3)),
        ([(2.0, 0.4, 1.0), (0.1, 0.3, 0.3)], None),
    ],
    ids=["soft", "stiff", "three layers", "rigid base"],
)
@pytest.mark.parametrize("order", [0, 1, 2])
def test_point_response_by_another_quadrature(layers, base, order):
    """Gauss panels, graded towards zero and as short as half a wave of the Bessel function; the
    near field in closed form."""
    body = asp.Layered(
        [asp.Layer(elastic(E, nu), h) for E, nu, h in layers], asp.RigidBase() if base is None else elastic(*base)
    )
    pick = {0: lambda c: c.zz, 1: lambda c: c.Lz, 2: lambda c: 0.5 * (c.LL - c.T)}[order]
    known = samples(body, body.thickness)
    kernel, top = known.kernel(pick, order), float(pick(known.high))
    node, weight = np.polynomial.legendre.leggauss(24)
    for r in np.array([0.03, 0.5, 3.0, 30.0]) * body.thickness:
        graded = np.geomspace(1e-12 / body.thickness, 40.0 / body.layers[0].thickness, 600)
        ends = np.unique(np.concatenate([[0.0], graded, np.arange(0.0, graded[-1], 3.0 / r)]))
        half = 0.5 * np.diff(ends)
        alpha = (ends[:-1] + half)[:, None] + half[:, None] * node
        regular = alpha * pick(interface_compliances(body, alpha)[0]) - top
        wave = special.jv(order, alpha * r)
        total = top + r * float(np.sum(half[:, None] * weight * regular * wave))
        scale = max(abs(top), abs(float(pick(known.low))))
        assert float(kernel.strength(np.array([r]))[0]) == pytest.approx(total, abs=1e-11 * scale)


@pytest.mark.parametrize("thickness", [0.01, 0.7, 30.0])
@pytest.mark.parametrize("ratio", [1e-3, 0.01, 5.0, 1e3])
def test_coarse_pixels_are_sums_of_fine_ones(ratio, thickness):
    """Nine thirds of a pixel under the same pressure make the pixel, across all zones; modulus
    ratios to a thousand."""
    stack = LayerStack(on_half_space(ratio, thickness))
    coarse = stack.influence(asp.Grid((40, 25), (1.0, 1.5)))
    fine = stack.influence(asp.Grid((121, 76), (1.0 / 3.0, 0.5)))
    reach = np.abs(np.arange(-1, 119)), np.abs(np.arange(-1, 74))
    near = fine[np.ix_(*reach)]
    nine = sum(near[1 + a :: 3, 1 + b :: 3][:39, :24] for a in (-1, 0, 1) for b in (-1, 0, 1))
    # displacements on a soft layer change sign, where they are small beside those of a half-space
    # of its material
    top = HalfSpace(stack.body.layers[0].material.plane_strain_modulus).influence(asp.Grid((39, 24), (1.0, 1.5)))
    np.testing.assert_array_less(np.abs(coarse[:39, :24] - nine), STATED * np.maximum(np.abs(nine), top))


def test_two_bodies_add_up():
    body, other = on_half_space(5.0, 0.7), on_half_space(0.2, 2.0)
    grid = asp.Grid((30, 20), (0.1, 0.2))
    for pair, parts in (((body, other), (body, other)), ((body, elastic(3.0, 0.2)), (body, elastic(3.0, 0.2)))):
        both = contact_compliance(*pair).influence(grid)
        alone = sum(contact_compliance(part, asp.Rigid()).influence(grid) for part in parts)
        np.testing.assert_allclose(both, alone, rtol=1e-14)
        one, two = (influence_tensor(grid, part) for part in parts)
        relative = influence_tensor(grid, *parts)
        np.testing.assert_allclose(relative.xz, one.xz - two.xz, rtol=0, atol=1e-15 * np.abs(one.xz).max())
        np.testing.assert_allclose(relative.xx, one.xx + two.xx, rtol=1e-14)


def test_slipping_layers_have_no_tangential_coefficients():
    body = asp.Layered([asp.Layer(elastic(2.0, 0.3), 1.0, asp.Frictionless())], elastic(1.0, 0.3))
    with refused(asp.InputError, "layers under a tangential traction"):
        influence_tensor(asp.Grid((4, 4), (1.0, 1.0)), body)
    assert LayerStack(body).influence(asp.Grid((4, 4), (1.0, 1.0))).min() > 0.0


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_strips_under_shear_step_from_the_top_layer_to_what_holds_it(nu):
    """u_z of a line force Q is ±(1-2ν)Q/4G near it and with the base's constants far away; the
    contraction ν/2G of a sheet gives ∓νQ/4G over an interface that slips. The approach to the
    limits is like h/x and x/h."""
    film, base, dx = elastic(2.0, nu), elastic(1.0, 0.1), 1e-4
    bonded = asp.Layered([asp.Layer(film, 1.0)], base)
    slipping = asp.Layered([asp.Layer(film, 1.0, asp.Frictionless())], base)
    near = 0.25 * (1.0 - 2.0 * nu) / film.shear_modulus
    for body, far in (
        (bonded, 0.25 * 0.8 / base.shear_modulus),
        (slipping, -0.25 * nu / film.shear_modulus),
        (film, near),
    ):
        close = BodiesSurface(body, asp.Rigid()).coupling_strips(asp.Grid((6, 1), (dx, 1.0)))[:, 0]
        assert close[0] == 0.0
        np.testing.assert_allclose(close[1:] / dx, near, atol=1e-3)
        distant = BodiesSurface(body, asp.Rigid()).coupling_strips(asp.Grid((6, 1), (1e4, 1.0)))[:, 0]
        np.testing.assert_allclose(distant[1:] / 1e4, far, atol=1e-3)
    pair = BodiesSurface(bonded, film).coupling_strips(asp.Grid((6, 1), (0.3, 1.0)))
    alone = [BodiesSurface(body, asp.Rigid()).coupling_strips(asp.Grid((6, 1), (0.3, 1.0))) for body in (bonded, film)]
    np.testing.assert_allclose(pair, alone[0] - alone[1], atol=1e-15)


def test_coupling_of_a_slipping_layer_tends_to_that_of_a_sheet():
    """αC_Lz from (1-2ν)/2G of the film to -ν/2G: u_x far from a normal point force is -αC_Lz/(2πr)
    x/r."""
    film = elastic(2.0, 0.3)
    body = asp.Layered([asp.Layer(film, 1.0, asp.Frictionless())], elastic(1.0, 0.1))
    xz, yz = BodiesSurface(body, asp.Rigid()).coupling_pixels(asp.Grid((5, 5), (1e4, 1e4)))
    expected = 0.3 / (2.0 * film.shear_modulus) / (2.0 * np.pi * np.arange(3, 5) * 1e4) * 1e8
    # a pixel instead of a point: the mean of x/r² over a square, harmonic but for the fourth order,
    # 1/60 r^-4 at most
    np.testing.assert_allclose(xz[3:, 0], expected, rtol=2e-3)
    np.testing.assert_allclose(yz, xz.T, rtol=1e-9, atol=1e-9 * np.abs(xz).max())
