"""What every stack of layers must obey, whatever its materials and thicknesses."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from solid_cases import MATERIALS, THICKNESSES, elastic, stacks

import asperity as asp
from asperity.solids.compliance.layered import (
    LayerStack,
    PlaneVector,
    half_space,
    interface_compliances,
    layer_matrices,
    lower_face,
    lowered,
)
from asperity.solids.compliance.tensor import surface_tensor

WAVENUMBERS = np.geomspace(1e-6, 1e4, 21)
many = settings(max_examples=100)
BONDED = st.just(asp.solids.Bonded())
COMPONENTS = ("LL", "zz", "Lz", "T")


def surface(body, alpha=WAVENUMBERS):
    return interface_compliances(body, alpha)[0]


def assert_same(found, expected, rtol):
    """Equal components; the coupling may vanish and is compared on the scale of the others."""
    scale = np.sqrt(expected.LL * expected.zz)
    for name in COMPONENTS:
        difference = np.abs(getattr(found, name) - getattr(expected, name))
        assert (difference <= rtol * (scale if name == "Lz" else getattr(expected, name))).all(), name


@many
@given(stacks())
def test_compliance_is_positive_definite(body):
    """An incompressible layer that slips has a determinant of (alpha h)² only, which rounding may
    cover."""
    found = surface(body)
    for diagonal in (found.LL, found.zz, found.T):
        assert (diagonal > 0.0).all()
        assert np.isfinite(diagonal).all()
    assert (found.LL * found.zz - found.Lz**2 > -1e-14 * found.LL * found.zz).all()


@many
@given(MATERIALS, st.lists(THICKNESSES, min_size=1, max_size=6))
def test_identical_layers_are_one_half_space(material, thicknesses):
    """And so is a single layer of the base's material: the interfaces are invisible to rounding."""
    body = asp.Layered([asp.Layer(material, h) for h in thicknesses], material)
    expected = half_space(WAVENUMBERS, shear_modulus=material.shear_modulus, nu=material.poisson_ratio)
    assert_same(surface(body), expected, 2e-14)


@many
@given(stacks(most=3), MATERIALS, st.integers(0, 3))
def test_layers_of_no_thickness_vanish(body, material, at):
    layers = list(body.layers)
    layers.insert(at, asp.Layer(material, 0.0, asp.Frictionless()))
    with_it, without = surface(asp.Layered(layers, body.base)), surface(body)
    for name in COMPONENTS:
        np.testing.assert_array_equal(getattr(with_it, name), getattr(without, name))


@many
@given(stacks(most=3, interfaces=BONDED), MATERIALS)
def test_a_thin_layer_changes_little(body, material):
    """First order in h: its own compliance h/G, and its stiffness G h against the deformation alpha
    C of what is below."""
    alpha, h, G = np.array([1e-3, 1.0]), 1e-12, material.shear_modulus
    thin = surface(asp.Layered([asp.Layer(material, h), *body.layers], body.base), alpha)
    bare = surface(body, alpha)
    largest, least = np.max([bare.LL, bare.zz, bare.T], axis=0), np.min([bare.LL, bare.zz, bare.T], axis=0)
    change = h * (1.0 / (G * least) + G * alpha**2 * largest**2 / least)
    assert_same(thin, bare, 10.0 * change + 1e-13)


@many
@given(stacks(most=3), MATERIALS)
def test_under_a_layer_of_infinite_thickness_nothing_matters(body, material):
    endless = asp.Layer(material, np.inf)
    expected = half_space(WAVENUMBERS, shear_modulus=material.shear_modulus, nu=material.poisson_ratio)
    assert_same(surface(asp.Layered([endless, *body.layers], body.base)), expected, 1e-14)
    layers = [*body.layers, endless]
    assert_same(surface(asp.Layered(layers, asp.RigidBase())), surface(asp.Layered(body.layers, material)), 1e-14)


@many
@given(stacks(most=3, interfaces=BONDED), st.integers(0, 2), st.floats(0.01, 0.99))
def test_cutting_a_layer_in_two_changes_nothing(body, at, share):
    layers = list(body.layers)
    cut = layers.pop(at % len(layers))
    parts = [asp.Layer(cut.material, cut.thickness * s) for s in (share, 1.0 - share)]
    at %= len(layers) + 1
    assert_same(surface(asp.Layered(layers[:at] + parts + layers[at:], body.base)), surface(body), 5e-14)


@many
@given(stacks(), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_scaling_with_length_and_modulus(body, longer, stiffer):
    """C(alpha) = length/modulus times a function of alpha·length."""
    length, modulus = 10.0**longer, 10.0**stiffer

    def scaled(m):
        return asp.Elastic(m.youngs_modulus * modulus, m.poisson_ratio)

    layers = [asp.Layer(scaled(la.material), la.thickness * length, la.interface) for la in body.layers]
    base = body.base if isinstance(body.base, asp.RigidBase) else scaled(body.base)
    found = surface(asp.Layered(layers, base), WAVENUMBERS / length)
    assert_same(found.scaled(modulus / length), surface(body), 1e-12)


@many
@given(stacks(), st.floats(1.01, 100.0), st.integers(0, 4))
def test_a_stiffer_material_deflects_less_under_normal_and_antiplane_load(body, factor, at):
    """Minimum of complementary energy: scaling up one modulus lowers every quadratic form of the
    compliance."""
    layers = list(body.layers)
    at %= len(layers)
    m = layers[at].material
    layers[at] = asp.Layer(
        asp.Elastic(m.youngs_modulus * factor, m.poisson_ratio), layers[at].thickness, layers[at].interface
    )
    stiff, soft = surface(asp.Layered(layers, body.base)), surface(body)
    for name in ("LL", "zz", "T"):
        assert (getattr(stiff, name) <= getattr(soft, name) * (1.0 + 1e-13)).all()


@many
@given(
    stacks(most=3, moduli=st.floats(0.1, 10.0), thicknesses=st.floats(0.1, 1.0), interfaces=BONDED, rigid=False),
    st.floats(0.1, 2.0),
)
def test_transfer_matrices_agree_where_they_work(body, alpha):
    """Independent algorithm: the matrix exponential of the equations of elasticity through each
    layer, from the base up.

    It loses about exp(2 alpha h) of its digits, at most 1e6 for these thicknesses and wavenumbers.
    """
    C = surface(asp.Layered([], body.base), alpha)
    up = np.array([[C.LL, C.Lz], [C.Lz, C.zz], [1.0, 0.0], [0.0, 1.0]], dtype=float)  # U, W, tau_L, tau_z
    across = np.array([C.T, 1.0])
    for layer in reversed(body.layers):
        G, nu, h = layer.material.shear_modulus, layer.material.poisson_ratio, layer.thickness
        down = [
            [0.0, -alpha, -1.0 / G, 0.0],
            [nu / (1 - nu) * alpha, 0.0, 0.0, -(1 - 2 * nu) / (2 * G * (1 - nu))],
            [-2 * G * alpha**2 / (1 - nu), 0.0, 0.0, -alpha * nu / (1 - nu)],
            [0.0, 0.0, alpha, 0.0],
        ]
        up = expm(-h * np.array(down)) @ up
        across = expm(-h * np.array([[0.0, -1.0 / G], [-G * alpha**2, 0.0]])) @ across
    matrix = up[:2] @ np.linalg.inv(up[2:])
    found = surface(body, alpha)
    np.testing.assert_allclose([[found.LL, found.Lz], [found.Lz, found.zz]], matrix, rtol=0, atol=1e-8 * found.zz)
    assert pytest.approx(across[0] / across[1], rel=1e-8) == found.T


@many
@given(stacks(most=1), st.tuples(*3 * [st.integers(-9, 9)]), st.floats(-2.0, 2.0))
def test_energy_balance_of_a_layer(body, load, exponent):
    """Work of the tractions on top = energy in the layer and below; the part below is never more
    than the whole."""
    alpha = np.array([10.0**exponent])
    layer = body.layers[0]
    solid = layer.material
    matrices = layer_matrices(alpha, layer.thickness, shear_modulus=solid.shear_modulus, nu=solid.poisson_ratio)
    top, below = interface_compliances(body, alpha)
    traction = PlaneVector(*(np.array([float(value)]) for value in load))
    under = lowered(traction, below, matrices, layer.interface)

    def work(t, v):
        return t.L * v.L + t.z * v.z, t.T * v.T

    whole, part = work(traction, top.displacement(traction)), work(under, below.displacement(under))
    for all_of_it, share in zip(whole, part, strict=True):
        assert -1e-12 * all_of_it <= share <= all_of_it * (1.0 + 1e-12)
    face = lower_face(traction, below, matrices, layer.interface)
    ground = below.displacement(under)
    size = float(np.abs(face.L).max() + np.abs(face.z).max())
    np.testing.assert_allclose(face.z, ground.z, rtol=0, atol=1e-9 * size)
    if isinstance(layer.interface, asp.solids.Bonded):
        np.testing.assert_allclose(face.L, ground.L, rtol=0, atol=1e-9 * size)
        np.testing.assert_allclose(face.T, ground.T, rtol=1e-9)
    else:
        assert not under.L.any()
        assert not under.T.any()


@many
@given(stacks(interfaces=BONDED))
def test_tables_are_as_good_as_direct_evaluation(body):
    """Large maps are interpolated: 1e-13 relative."""
    stack = LayerStack(body)
    alpha = np.geomspace(1e-5, 1e5, 9001) / body.thickness
    found, direct = stack.plane(alpha), interface_compliances(body, alpha)[0]
    assert_same(found, direct, 1e-13)
    np.testing.assert_array_equal(stack.spectral(alpha), found.zz)


@many
@given(stacks(), st.integers(1, 8), st.integers(1, 8), st.integers(0, 999))
def test_surface_tensor_is_reciprocal_positive_and_real(body, nx, ny, seed):
    """Hermitian and positive: real tractions give real displacements and do positive work."""
    grid = asp.Grid((nx, ny), (0.3, 0.2))
    t = surface_tensor(grid, body)
    tractions = np.random.default_rng(seed).standard_normal((3, nx, ny))
    qx, qy, p = np.fft.rfft2(tractions)
    ux = t.xx * qx + t.xy * qy + 1j * t.xz * p
    uy = t.xy * qx + t.yy * qy + 1j * t.yz * p
    uz = -1j * t.xz * qx - 1j * t.yz * qy + t.zz * p
    u = np.array([np.fft.irfft2(v, s=(nx, ny)) for v in (ux, uy, uz)])
    for component, spectrum in zip(u, (ux, uy, uz), strict=True):
        np.testing.assert_allclose(
            np.fft.rfft2(component), spectrum, rtol=0, atol=1e-12 * np.abs(spectrum).max() + 1e-300
        )
    assert (tractions * u).sum() >= 0.0


def test_opposed_bodies_of_one_material_do_not_couple():
    """Relative displacements: diagonal terms double, normal and tangential directions decouple
    (Johnson 1985, sec. 7.1)."""
    body = asp.Layered([asp.Layer(elastic(5.0, 0.2), 0.4)], elastic(1.0, 0.3))
    grid = asp.Grid((6, 5), (1.0, 0.7))
    one, two = surface_tensor(grid, body), surface_tensor(grid, body, body)
    for name in ("xx", "yy", "zz", "xy"):
        np.testing.assert_allclose(getattr(two, name), 2.0 * getattr(one, name), rtol=1e-15)
    assert not two.xz.any()
    assert not two.yz.any()
    above = surface_tensor(grid, asp.Rigid(), body)
    np.testing.assert_array_equal(above.xz, -one.xz)
