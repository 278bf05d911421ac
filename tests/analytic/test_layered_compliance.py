"""Wavenumber compliance of layered bodies: published closed form, limits, and a multiprecision
table."""

import numpy as np
import pytest
from reference_data import every_row, reference
from solid_cases import elastic, layered, on_half_space

import asperity as asp
from asperity.solids.compliance.layered import LayerStack, interface_compliances
from asperity.solids.compliance.tensor import surface_tensor

ALPHA_H = np.geomspace(1e-4, 1e2, 61)
ROWS = reference("spectral_compliance")


def surface(body, alpha):
    return interface_compliances(body, alpha)[0]


@every_row(ROWS, label=lambda row: f"case-{row['case']:g}")
def test_every_row_of_the_table(row):
    """Table exact to its 16 digits; sums of positive terms keep the arithmetic's accuracy: 1.6e-15
    found, 1e-14 allowed.

    The coupling can vanish, so its error is measured against the geometric mean of the diagonal.
    """
    found = surface(layered(row), row["alpha"])
    assert pytest.approx(row["C_LL"], rel=1e-14) == found.LL
    assert found.zz == pytest.approx(row["C_zz"], rel=1e-14)
    assert pytest.approx(row["C_TT"], rel=1e-14) == found.T
    assert found.Lz == pytest.approx(row["C_Lz"], abs=1e-14 * np.sqrt(row["C_LL"] * row["C_zz"]))


@every_row([r for r in ROWS if r["xi"] * r["eta"]], label=lambda row: f"case-{row['case']:g}")
def test_cartesian_tensor_of_the_table(row):
    """The wavevector of the row is the mode (1, 1) or one of its mirror images on a grid made for
    it."""
    xi, eta = row["xi"], row["eta"]
    grid = asp.Grid((4, 4), (0.5 * np.pi / abs(xi), 0.5 * np.pi / abs(eta)))
    tensor = surface_tensor(grid, layered(row))
    at, mirror = (1 if xi > 0 else -1, 1), np.sign(eta)
    scale = np.sqrt(np.outer(*2 * [[row["Cxx"], row["Cyy"], row["Czz"]]]))
    assert tensor.xx[at] == pytest.approx(row["Cxx"], rel=1e-14)
    assert tensor.yy[at] == pytest.approx(row["Cyy"], rel=1e-14)
    assert tensor.zz[at] == pytest.approx(row["Czz"], rel=1e-14)
    assert mirror * tensor.xy[at] == pytest.approx(row["Cxy"], abs=1e-14 * scale[0, 1])
    assert tensor.xz[at] == pytest.approx(row["Im_Cxz"], abs=1e-14 * scale[0, 2])
    assert mirror * tensor.yz[at] == pytest.approx(row["Im_Cyz"], abs=1e-14 * scale[1, 2])


@pytest.mark.parametrize(("ratio", "digits"), [(0.1, 1e-14), (1.0, 1e-14), (10.0, 1e-13), (1000.0, 1e-9), (1e-3, 1e-9)])
def test_single_layer_closed_form(ratio, digits):
    """Burmister (1945), O'Sullivan & King (1988); the closed form itself loses digits where the
    moduli differ much."""
    body = on_half_space(ratio, 2.0, nu=0.25, nu_base=0.4)
    G1, G2 = body.layers[0].material.shear_modulus, body.base.shear_modulus
    mu, x, theta = G1 / G2, ALPHA_H, np.exp(-2.0 * ALPHA_H)
    lam = 1.0 - 4.0 * (1.0 - 0.25) / (1.0 + mu * (3.0 - 4.0 * 0.4))
    kap = (mu - 1.0) / (mu + 3.0 - 4.0 * 0.25)
    R = 1.0 / (1.0 - (lam + kap + 4.0 * kap * x**2) * theta + lam * kap * theta**2)
    alpha = ALPHA_H / 2.0
    closed = (1.0 - 0.25) / (G1 * alpha) * (1.0 + 4.0 * kap * x * theta - lam * kap * theta**2) * R
    np.testing.assert_allclose(surface(body, alpha).zz, closed, rtol=digits)


def test_single_layer_antiplane_closed_form():
    """C_T from the two exponentials of the layer: (1/G1 alpha)(1 + r theta)/(1 - r theta), r =
    (mu - 1)/(mu + 1)."""
    body = on_half_space(7.0, 2.0)
    mu, theta = 7.0, np.exp(-2.0 * ALPHA_H)
    r = (1.0 - mu) / (1.0 + mu)
    closed = (1.0 - r * theta) / (1.0 + r * theta) / (body.layers[0].material.shear_modulus * ALPHA_H / 2.0)
    np.testing.assert_allclose(surface(body, ALPHA_H / 2.0).T, closed, rtol=1e-14)


@pytest.mark.parametrize(("alpha_h", "error"), [(1e-3, 3e-5), (1e-4, 3e-7)])
def test_thin_layers_to_first_order(alpha_h, error):
    """Bracket of (4.8) for each component; what is left falls with the square of the thickness
    (relative to d/alpha)."""
    layers = [(4.0, 0.2, 1.0), (0.3, 0.45, 2.0)]
    body = asp.Layered([asp.Layer(elastic(E, nu), h) for E, nu, h in layers], elastic(1.0, 0.35))
    base, alpha = body.base, alpha_h
    Gs = base.shear_modulus
    c, d = (1.0 - 2.0 * 0.35) / (2.0 * Gs), (1.0 - 0.35) / Gs
    zz, LL, Lz, T = d / alpha, d / alpha, c / alpha, 1.0 / (Gs * alpha)
    for layer in body.layers:
        G, nu, h = layer.material.shear_modulus, layer.material.poisson_ratio, layer.thickness
        zz += h * ((1 - 2 * nu) / (2 * G * (1 - nu)) - 2 * nu / (1 - nu) * c - 2 * G / (1 - nu) * c**2)
        LL += h * (1 / G + 2 * c - 2 * G / (1 - nu) * d**2)
        Lz += h * d * ((1 - 2 * nu) / (1 - nu) - 2 * G * c / (1 - nu))
        T += h * (1 / G - G / Gs**2)
    found = surface(body, alpha)
    for value, expansion in ((found.zz, zz), (found.LL, LL), (found.Lz, Lz), (found.T, T)):
        assert value == pytest.approx(expansion, abs=10.0 * error * d / alpha)


def test_rigid_base_at_long_wavelengths_is_the_mean_mode():
    """diag(sum h/G, sum h/G, sum h/M), approached with the square of alpha h."""
    body = asp.Layered([asp.Layer(elastic(2.0, 0.3), 1.0), asp.Layer(elastic(0.5, 0.1), 0.5)], asp.RigidBase())
    found = surface(body, 1e-5)
    shear = sum(layer.thickness / layer.material.shear_modulus for layer in body.layers)
    assert LayerStack(body).mean_mode() == pytest.approx(float(found.zz), rel=1e-8)
    assert pytest.approx(shear, rel=1e-8) == found.LL
    assert pytest.approx(shear, rel=1e-8) == found.T
    tensor = surface_tensor(asp.Grid((4, 4), (1.0, 1.0)), body)
    assert tensor.xx[0, 0] == tensor.yy[0, 0] == pytest.approx(shear, rel=1e-15)
    assert tensor.zz[0, 0] == LayerStack(body).mean_mode()


def test_incompressible_layer_on_a_rigid_base_bears_any_mean_pressure():
    """Reynolds' thin film of rubber: C_zz = (alpha h)² h/(3G) for alpha h << 1, nothing in the
    mean."""
    body = asp.Layered([asp.Layer(elastic(3.0, 0.5), 2.0)], asp.RigidBase())
    assert LayerStack(body).mean_mode() == 0.0
    assert surface(body, 1e-4).zz == pytest.approx((2e-4) ** 2 * 2.0 / 3.0, rel=1e-6)


def test_sheet_on_a_frictionless_base():
    """Thin plate: C_zz = 1/(D alpha^4 + 1/C_base), D = E' h³/12; C_LL that of the membrane, 1/(E' h
    alpha²), and of the bending by the eccentric traction. Shear deformation is left out: errors of
    the order (alpha h)² = 1e-4 at most."""
    stiff = asp.Layer(elastic(1e6, 0.3), 1e-3, asp.Frictionless())
    body = asp.Layered([stiff], elastic(1.0, 0.3))
    E = stiff.material.plane_strain_modulus
    alpha = np.array([0.3, 1.0, 3.0, 10.0])
    found = surface(body, alpha)
    plate = 1.0 / (E * 1e-9 / 12.0 * alpha**4 + 0.5 * body.base.plane_strain_modulus * alpha)
    np.testing.assert_allclose(found.zz, plate, rtol=1e-4)
    np.testing.assert_allclose(found.LL, 1.0 / (E * 1e-3 * alpha**2) + (0.5e-3 * alpha) ** 2 * plate, rtol=1e-4)
    np.testing.assert_allclose(found.T, 1.0 / (stiff.material.shear_modulus * 1e-3 * alpha**2), rtol=1e-4)


@pytest.mark.parametrize(
    ("alpha", "limit", "known"),
    [
        (0.3, 5.57570987, (2.5e-4, 6.4e-5, 1.6e-5, 4.0e-6, 1.0e-6, 2.5e-7)),
        (1.0, 1.36417812, (1.3e-3, 3.5e-4, 9.1e-5, 2.3e-5, 5.7e-6, 1.4e-6)),
        (5.0, 0.1285392, (1.8e-2, 5.4e-3, 1.5e-3, 3.7e-4, 9.4e-5, 2.4e-5)),
    ],
    ids=lambda value: f"{value:g}" if isinstance(value, float) else "",
)
def test_graded_coating_converges_with_second_order(alpha, limit, known):
    """E from 4 E_s to E_s exponentially over h = 1, nu = 0.3, with 4, 8, … 128 sublayers: known
    errors, two digits each.

    The limits are known to 9 and 7 digits, which blurs the smallest errors by 1e-9 and 1e-7.
    """
    errors = []
    for count in (4, 8, 16, 32, 64, 128):
        coating = asp.solids.graded(elastic(4.0, 0.3), elastic(1.0, 0.3), 1.0, sublayers=count)
        errors.append(abs(float(surface(asp.Layered(coating, elastic(1.0, 0.3)), alpha).zz) / limit - 1.0))
    assert errors == pytest.approx(known, rel=0.05, abs=4e-7 if alpha == 5.0 else 2e-9)
    assert -np.diff(np.log2(errors[2:])) == pytest.approx([2.0] * 3, abs=0.15)


def test_gibson_soil_deflects_locally():
    """Incompressible half-space with G = m z: C_zz = 1/2m at every wavenumber (Gibson 1967), here
    by geometric layers."""
    edges = np.concatenate([[0.0], np.geomspace(1e-4, 1e2, 320)])
    middle = 0.5 * (edges[1:] + edges[:-1])
    layers = [asp.Layer(elastic(3.0 * z, 0.5), h) for z, h in zip(middle, np.diff(edges), strict=True)]
    body = asp.Layered(layers, elastic(3.0 * edges[-1], 0.5))
    np.testing.assert_allclose(2.0 * surface(body, np.array([0.3, 1.0, 3.0])).zz, 1.0, rtol=1e-3)


@pytest.mark.parametrize(
    "grading", [asp.solids.LinearGrading(), asp.solids.ExponentialGrading(), asp.solids.PowerGrading(2.0)]
)
def test_gradings_agree_with_the_differential_equations(grading):
    """(3.2) integrated through the continuous profile, from the base up, for both loads."""
    from scipy.integrate import solve_ivp

    top, bottom, h, alpha = elastic(5.0, 0.25), elastic(1.0, 0.25), 1.0, 1.3
    base = elastic(2.0, 0.4)

    def rates(depth, y):
        U, W, tau_z, tau_L = y
        G, nu = grading.modulus(top.shear_modulus, bottom.shear_modulus, depth / h), 0.25
        return [
            -alpha * W - tau_L / G,
            nu / (1 - nu) * alpha * U - (1 - 2 * nu) / (2 * G * (1 - nu)) * tau_z,
            alpha * tau_L,
            -alpha / (1 - nu) * (2 * G * alpha * U + nu * tau_z),
        ]

    C = surface(asp.Layered([], base), alpha)
    starts = ((float(C.Lz), float(C.zz), 1.0, 0.0), (float(C.LL), float(C.Lz), 0.0, 1.0))
    ends = np.array([solve_ivp(rates, (h, 0.0), start, rtol=1e-11, atol=1e-13).y[:, -1] for start in starts])
    exact = np.linalg.solve(ends[:, 2:], ends[:, :2])  # rows: unit tau_z, unit tau_L; columns U, W
    errors = []
    for count in (20, 40):
        found = surface(asp.Layered(asp.solids.graded(top, bottom, h, grading=grading, sublayers=count), base), alpha)
        errors.append(np.abs(np.array([found.Lz, found.zz, found.LL]) - [exact[0, 0], exact[0, 1], exact[1, 0]]).max())
    assert errors[1] < 1e-3 * exact[0, 1]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)
