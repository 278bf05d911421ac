"""Fields under periodic loads: a plain sum over waves, orientation, equilibrium, energy, precision,
mean mode."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from layered_bodies import layered_bodies

import asperity as asp
from asperity.core.tensor import STRESSES
from asperity.physics.stress.boundaries import PeriodicPlanes
from asperity.physics.stress.kernels.transfer import transfer
from asperity.physics.stress.regions import planes
from asperity.physics.stress.tractions import ShearTraction, Sliding, Tractions

BODY = asp.Layered(
    [asp.Layer(asp.Elastic(400e9, 0.2), 5e-9), asp.Layer(asp.Elastic(50e9, 0.45), 30e-9)], asp.Elastic(200e9, 0.3)
)
DEPTHS = [0.0, 2e-9, 5e-9, 20e-9, 35e-9, 60e-9]


def random_loads(grid, shear="fields", seed=0, mean=0.0):
    rng = np.random.default_rng(seed)
    p, qx, qy = 1e9 * rng.standard_normal((3, *grid.shape))
    p += mean - p.mean()
    given_shear = {
        "none": Sliding(0.0),
        "sliding": Sliding(0.3, 0.7),
        "fields": ShearTraction(qx - qx.mean(), qy - qy.mean()),
    }
    return Tractions(grid, p, given_shear[shear])


def fields_of(source, plane):
    """All nine fields (9, nx, ny): displacements, stresses."""
    return np.array([*vars(source.displacement(plane)).values(), *vars(source.stress(plane)).values()])


def sum_over_waves(loads, body, plane):
    """The same by the formulas of the turned frame at every wavevector, with both signs of the
    highest of an even grid."""
    (nx, ny), spacing = loads.grid.shape, loads.grid.spacing
    p, qx, qy = (np.fft.fft2(f) for f in (loads.pressure, loads.shear_x, loads.shear_y))
    xi, eta = (2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip((nx, ny), spacing, strict=True))
    alpha = np.hypot(xi[:, None], eta[None, :])
    alpha[0, 0] = 1.0
    t = {k: v.reshape(nx, ny) for k, v in vars(transfer(body.reduced, plane, alpha.ravel())).items()}
    nu, total = plane.region.material.poisson_ratio, np.zeros((9, nx, ny), complex)
    for sign_x in (1, -1):
        for sign_y in (1, -1):
            a, b = xi.copy(), eta.copy()
            a[nx // 2] *= sign_x if nx % 2 == 0 else 1
            b[ny // 2] *= sign_y if ny % 2 == 0 else 1
            c, s = a[:, None] / alpha, b[None, :] / alpha
            q_L, q_T = c * qx + s * qy, -s * qx + c * qy
            t_L = -1j * q_L
            tau_z, tau_L = t["tau_zz"] * p + t["tau_zL"] * t_L, t["tau_Lz"] * p + t["tau_LL"] * t_L
            LL = t["LL_z"] * p + t["LL_L"] * t_L
            TT, LT, Lz, Tz = nu * (LL - tau_z), 1j * t["LT"] * q_T, -1j * tau_L, -t["tau_T"] * q_T
            u_L, u_T = 1j * (t["U_z"] * p + t["U_L"] * t_L), t["u_T"] * q_T
            total += 0.25 * np.array(
                [
                    c * u_L - s * u_T,
                    s * u_L + c * u_T,
                    t["W_z"] * p + t["W_L"] * t_L,
                    c * c * LL + s * s * TT - 2 * s * c * LT,
                    s * s * LL + c * c * TT + 2 * s * c * LT,
                    -tau_z,
                    s * c * (LL - TT) + (c * c - s * s) * LT,
                    c * Lz - s * Tz,
                    s * Lz + c * Tz,
                ]
            )
    total[:, 0, 0] = 0.0
    return np.fft.ifft2(total, axes=(1, 2)).real


@pytest.mark.parametrize("shear", ["none", "sliding", "fields"])
@pytest.mark.parametrize(
    ("shape", "spacing"),
    [
        ((16, 12), (3e-9, 5e-9)),
        ((9, 15), (3e-9, 2e-9)),
        ((1, 16), (4e-9, 4e-9)),
        ((8, 1), (4e-9, 9e-9)),
        ((7, 10), (3e-9, 3e-9)),
    ],
)
def test_every_plane_is_the_sum_over_waves(shape, spacing, shear):
    """Even and odd grids, dx != dy, lines. The polynomials in wavenumber are good to 1e-13 of the
    field where it matters and to 1e-15 of the surface traction everywhere."""
    loads = random_loads(asp.Grid(shape, spacing), shear)
    source = PeriodicPlanes(loads, BODY, threads=1)
    for plane in planes(BODY, DEPTHS):
        got, wanted = fields_of(source, plane), sum_over_waves(loads, BODY, plane)
        for part, surface in ((slice(0, 3), 1e9 * 1e-8 / 200e9), (slice(3, 9), 1e9)):
            got[part] -= got[part].mean(axis=(1, 2), keepdims=True)
            scale = np.abs(wanted[part]).max()
            np.testing.assert_allclose(got[part], wanted[part], atol=2e-12 * scale + 1e-13 * surface, rtol=0)


def test_tractions_return_at_the_surface_exactly():
    loads = random_loads(asp.Grid((12, 10), (2e-9, 3e-9)), mean=2e9)
    stress = PeriodicPlanes(loads, BODY, threads=1).stress(planes(BODY, [0.0])[0])
    np.testing.assert_array_equal(stress.zz, -loads.pressure)
    np.testing.assert_array_equal(stress.xz, -loads.shear_x)
    np.testing.assert_array_equal(stress.yz, -loads.shear_y)


def test_both_sides_of_an_interface_share_tractions_and_displacements():
    loads = random_loads(asp.Grid((12, 10), (2e-9, 3e-9)), mean=2e9)
    source = PeriodicPlanes(loads, BODY, threads=1)
    for depth in (5e-9, 35e-9):
        above, below = (fields_of(source, plane) for plane in planes(BODY, [depth]))
        for k in (0, 1, 2, 5, 7, 8):
            np.testing.assert_allclose(below[k], above[k], atol=1e-12 * np.abs(above[:3] if k < 3 else above[3:]).max())
        assert np.abs(above[3] - below[3]).max() > 0.1 * np.abs(above[3]).max()


def test_a_quarter_turn_of_the_load_turns_the_field():
    """The grid transposed, x and y exchanged (with the shear along the exchanged axes)."""
    grid = asp.Grid((10, 12), (2e-9, 3e-9))
    loads = random_loads(grid)
    turned = Tractions(
        asp.Grid((12, 10), (3e-9, 2e-9)),
        loads.pressure.T.copy(),
        ShearTraction(loads.shear_y.T.copy(), loads.shear_x.T.copy()),
    )
    for plane in planes(BODY, DEPTHS):
        a, b = PeriodicPlanes(loads, BODY, threads=1), PeriodicPlanes(turned, BODY, threads=1)
        one, other = a.stress(plane), b.stress(plane).map(np.transpose).exchanged()
        for name in STRESSES:
            np.testing.assert_allclose(getattr(other, name), getattr(one, name), atol=1e-5)  # of 1e9 Pa


def test_opposite_directions_of_sliding_mirror_the_shear_part():
    grid = asp.Grid((10, 12), (2e-9, 3e-9))
    pressure = random_loads(grid).pressure
    plane = planes(BODY, [4e-9])[0]
    parts = [
        PeriodicPlanes(Tractions(grid, pressure, Sliding(mu, angle)), BODY, threads=1).stress(plane)
        for mu, angle in ((0.0, 0.0), (0.4, 0.3), (0.4, 0.3 + np.pi))
    ]
    for name in STRESSES:
        alone, one, other = (getattr(part, name) for part in parts)
        np.testing.assert_allclose(one + other, 2.0 * alone, atol=1e-5)


def test_loads_superpose():
    grid = asp.Grid((9, 8), (2e-9, 3e-9))
    a, b = random_loads(grid, seed=1), random_loads(grid, seed=2)
    both = Tractions(
        grid, a.pressure - 2 * b.pressure, ShearTraction(a.shear_x - 2 * b.shear_x, a.shear_y - 2 * b.shear_y)
    )
    plane = planes(BODY, [6e-9])[0]
    x, y, z = (fields_of(PeriodicPlanes(loads, BODY, threads=1), plane) for loads in (a, b, both))
    np.testing.assert_allclose(z[3:], x[3:] - 2 * y[3:], atol=1e-5)
    np.testing.assert_allclose(z[:3], x[:3] - 2 * y[:3], atol=1e-14 * 1e-9)


@settings(max_examples=15)
@given(layered_bodies(contrast=30.0), st.data())
def test_forces_balance_at_every_point_inside(body, data):
    """div σ = 0: spectral derivatives along the planes, two sixth-order differences across them
    that tell their error."""
    grid = asp.Grid((11, 9), (0.7, 0.9))  # odd: no highest wavenumber without a derivative
    loads = Tractions(grid, *(lambda f: (f[0], ShearTraction(f[1], f[2])))(smooth(grid)))
    source = PeriodicPlanes(loads, body, threads=1)
    number = data.draw(st.integers(0, len(body.layers) - 1))
    layer = body.layers[number]
    middle = sum(part.thickness for part in body.layers[:number]) + 0.5 * layer.thickness
    step = min(layer.thickness / 8.0, 0.1)

    def at(z):
        return source.stress(planes(body, [z])[0])

    def across(h):
        weights = {1: 3.0 / 4.0, 2: -3.0 / 20.0, 3: 1.0 / 60.0}
        sides = {k: (at(middle + k * h), at(middle - k * h)) for k in weights}
        return [
            sum(w * (getattr(sides[k][0], n) - getattr(sides[k][1], n)) / h for k, w in weights.items())
            for n in ("xz", "yz", "zz")
        ]

    here, coarse, fine = at(middle), across(step), across(0.5 * step)
    rows = (("xx", "xy"), ("xy", "yy"), ("xz", "yz"))
    for (along_x, along_y), rough, exact in zip(rows, coarse, fine, strict=True):
        force = derivative(getattr(here, along_x), grid, 0) + derivative(getattr(here, along_y), grid, 1) + exact
        error = np.abs(exact - rough).max() + 1e-11 / step
        np.testing.assert_array_less(np.abs(force), error)


def smooth(grid):
    """Three fields of long waves."""
    x, y = grid.coordinates()
    u, v = 2 * np.pi * x / grid.size[0], 2 * np.pi * y / grid.size[1]
    return [np.cos(u) * np.sin(v) + 0.5, np.sin(u) + np.cos(2 * v), np.cos(u - v)]


def derivative(field, grid, axis):
    q = 2 * np.pi * np.fft.fftfreq(grid.shape[axis], grid.spacing[axis])
    q = q[:, None] if axis == 0 else q[None, :]
    return np.fft.ifft(1j * q * np.fft.fft(field, axis=axis), axis=axis).real


@pytest.mark.parametrize("base", [asp.Elastic(2.0, 0.25), asp.RigidBase()], ids=["half-space", "rigid base"])
def test_strain_energy_is_the_work_of_the_tractions(base):
    """½∫σ:ε dV by Gauss points through every layer equals ½∫(p u_z + q·u) dA, and is positive at
    every point."""
    body = asp.Layered([asp.Layer(asp.Elastic(5.0, 0.2), 0.3), asp.Layer(asp.Elastic(0.7, 0.4), 0.8)], base)
    grid = asp.Grid((9, 7), (0.5, 0.6))
    p, qx, qy = (f - f.mean() for f in smooth(grid))
    loads = Tractions(grid, p, ShearTraction(qx, qy))
    source = PeriodicPlanes(loads, body, threads=1)
    u = source.displacement(planes(body, [0.0])[0])
    work = 0.5 * grid.pixel_area * float((p * u.z + qx * u.x + qy * u.y).sum())
    node, weight = np.polynomial.legendre.leggauss(20)
    energy = 0.0
    edges = [0.0, 0.3, 1.1] + ([] if isinstance(base, asp.RigidBase) else [2.1, 4.1, 8.1, 16.1])
    for top, bottom in pairwise(edges):
        for t, w in zip(node, weight, strict=True):
            plane = planes(body, [0.5 * (top + bottom) + 0.5 * (bottom - top) * t])[0]
            s, E, nu = source.stress(plane), plane.region.material.youngs_modulus, plane.region.material.poisson_ratio
            trace = s.xx + s.yy + s.zz
            squares = s.xx**2 + s.yy**2 + s.zz**2 + 2 * (s.xy**2 + s.xz**2 + s.yz**2)
            density = ((1 + nu) * squares - nu * trace**2) / (2 * E)
            assert density.min() > 0.0
            energy += 0.5 * (bottom - top) * w * grid.pixel_area * float(density.sum())
    assert energy == pytest.approx(work, rel=1e-9)  # Gauss points of exponentials, and exp(-2·1.4·16) left out below


def test_the_mean_load_is_uniaxial_strain():
    body = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.2), 2.0)], asp.Elastic(1.0, 0.4))
    grid = asp.Grid((4, 6), (1.0, 1.0))
    source = PeriodicPlanes(Tractions(grid, np.full((4, 6), 3.0), Sliding(0.5, np.pi / 2)), body, threads=1)
    for plane in planes(body, [1.0, 5.0]):
        nu = plane.region.material.poisson_ratio
        stress = source.stress(plane)
        for name, wanted in (
            ("xx", -nu / (1 - nu) * 3),
            ("yy", -nu / (1 - nu) * 3),
            ("zz", -3),
            ("xy", 0),
            ("xz", 0),
            ("yz", -1.5),
        ):
            np.testing.assert_allclose(getattr(stress, name), wanted, atol=1e-14)
    sink = [source.displacement(plane).z.mean() for plane in planes(body, [0.0, 1.0, 2.0])]
    uniaxial = (1 - 2 * 0.2) / (2 * (4.0 / 2.4) * 0.8)
    np.testing.assert_allclose(sink[:3], [0.0, -3.0 * uniaxial, -6.0 * uniaxial], atol=1e-14)


def test_the_mean_load_on_a_rigid_base_moves_the_surface():
    body = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.2), 2.0)], asp.RigidBase())
    grid = asp.Grid((4, 6), (1.0, 1.0))
    source = PeriodicPlanes(Tractions(grid, np.full((4, 6), 3.0), Sliding(0.5)), body, threads=1)
    surface, bottom = (source.displacement(plane) for plane in planes(body, [0.0, 2.0]))
    np.testing.assert_allclose(surface.z, 3.0 * 2.0 * (1 - 2 * 0.2) / (2 * (4.0 / 2.4) * 0.8), rtol=1e-14)
    np.testing.assert_allclose(surface.x, 1.5 * 2.0 / (4.0 / 2.4), rtol=1e-14)
    np.testing.assert_allclose(bottom.z, 0.0, atol=1e-15)


def test_single_precision_differs_by_its_rounding_only():
    """Relative to the largest stress: 1e-7 of single precision times a few, through the
    transforms."""
    loads = random_loads(asp.Grid((64, 48), (2e-9, 3e-9)), "sliding", mean=2e9)
    for plane in planes(BODY, DEPTHS):
        double = PeriodicPlanes(loads, BODY, threads=1).stress(plane)
        single = PeriodicPlanes(loads, BODY, dtype="float32", threads=1).stress(plane)
        assert single.xx.dtype == np.float32
        largest = max(np.abs(c).max() for c in vars(double).values())
        for name in STRESSES:
            np.testing.assert_allclose(getattr(single, name), getattr(double, name), atol=2e-6 * largest)


def test_results_do_not_depend_on_threads():
    loads = random_loads(asp.Grid((64, 48), (2e-9, 3e-9)), "fields")
    plane = planes(BODY, [3e-9])[0]
    one, two = (PeriodicPlanes(loads, BODY, threads=n).stress(plane) for n in (1, 2))
    for name in STRESSES:
        np.testing.assert_allclose(getattr(two, name), getattr(one, name), rtol=0, atol=1e-5)


def test_order_of_planes_does_not_matter():
    """Waves that do not reach a deep plane leave nothing of a shallow one behind, in stress or in
    displacement."""
    grid = asp.Grid((32, 24), (1e-9, 1e-9))
    loads, found = random_loads(grid), planes(BODY, [2e-9, 40e-9, 300e-9])
    shallow, deep, deepest = found
    source = PeriodicPlanes(loads, BODY, threads=2)
    for plane in (shallow, deepest, deep, deepest, shallow, deep):
        np.testing.assert_array_equal(fields_of(source, plane), fields_of(PeriodicPlanes(loads, BODY), plane))
