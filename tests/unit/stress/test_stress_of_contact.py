"""asp.stress on solved contacts: Hertz, the sphere on a layer, sections, streams, both bodies,
boundaries, refusals."""

import numpy as np
import pytest
from axisymmetric import SphereOnLayer
from axisymmetric import fields as hankel_fields
from catalogue import oblong, rough, sphere
from refusals import refused

import asperity as asp
from asperity.core.tensor import STRESSES
from asperity.physics.stress.compute import StressPlanes
from asperity.physics.stress.regions import planes
from asperity.physics.stress.tractions import Tractions
from asperity.theories.subsurface.hertz import hertz_normal, hertz_shear

DISK = asp.Layered(
    [asp.Layer(asp.Elastic(280e9, 0.25, name="DLC"), 50e-9), asp.Layer(asp.Elastic(190e9, 0.3), 200e-9)],
    asp.Elastic(70e9, 0.33, name="Al-Mg"),
)


def paraboloid(n=65, spacing=1.0, radius=1e3):
    grid = asp.Grid((n, n), (spacing, spacing))
    x, y = grid.centred_coordinates()
    return asp.Surface(-(x**2 + y**2) / (2 * radius), spacing, spacing)


@pytest.fixture(scope="module")
def hertz():
    """Sphere of R = 1000 on E' = 1/0.91, contact radius 24 on 65² pixels of 1, with p0 =
    2E'a/πR."""
    body = asp.Elastic(1.0, 0.3)
    a = 24.0
    force = 4.0 * a**3 / (3.0 * 1e3) / 0.91
    result = asp.solve(asp.ContactProblem(paraboloid(), body, boundary=asp.Free()), asp.Force(force))
    return result, a, 2.0 * a / (np.pi * 1e3) / 0.91


def test_hertz_stress_on_the_axis(hertz):
    """Pixels of a/24: the contact edge is a staircase of relative area error 1e-3, and so is the
    pressure's."""
    result, a, p0 = hertz
    zeta = np.array([0.1, 0.25, 0.48, 1.0, 2.0])
    field = asp.stress(result, zeta * a, on=asp.stresses.DepthProfile(32.0, 32.0))
    closed = hertz_normal(0.0 * zeta, 0.0 * zeta, zeta, 1.0, shear=1.0, nu=0.3).stress
    np.testing.assert_allclose(field.normal_zz / p0, closed.zz, atol=2e-3)
    np.testing.assert_allclose(field.normal_xx / p0, closed.xx, atol=2e-3)
    np.testing.assert_allclose(field.normal_yy, field.normal_xx, atol=1e-8 * p0)  # the solver's asymmetry
    np.testing.assert_allclose(field.shear_xz, 0.0, atol=1e-8 * p0)


def test_sliding_hertz_on_the_surface(hertz):
    """Inside the contact σ_xx is in closed form (Hamilton 1983); two pixels from the edge it is
    right within 3 %.

    At the edge itself, x = -a, lies the maximum; it is a cusp that pixels round off by about
    (Δ/a)^1/2.
    """
    result, a, p0 = hertz
    field = asp.stress(result, [0.0], on=asp.stresses.Section(y="max"), friction=0.5)

    def sliding(x):
        at = {"x": np.array(x), "y": np.array(0.0), "z": 0.0, "contact_radius": 1.0, "shear": 1.0, "nu": 0.3}
        return (hertz_normal(**at) + hertz_shear(**at) * 0.5).stress

    for column in (10, 14, 20, 26, 38, 44, 50, 54):
        closed = sliding((column - 32) / a)
        assert field.normal_xx[0, column] / p0 == pytest.approx(float(closed.xx), abs=0.03)
        assert field.shear_xz[0, column] / p0 == pytest.approx(float(closed.xz), abs=0.02)
    edge = float(sliding(-1.0).xx)
    peak = field.peak(field.normal_xx)
    assert peak.value / p0 == pytest.approx(edge, rel=np.sqrt(1.0 / a))
    assert peak.x == pytest.approx(32.0 - a, abs=1.0)
    assert (peak.depth, peak.side) == (0.0, "surface")


@pytest.mark.parametrize("ratio", [0.25, 2.0])
def test_sphere_on_a_layer(ratio):
    """Against the integral equation: solver, free coefficients and convolution together, at pixels
    of a0/16."""
    exact = SphereOnLayer(ratio, 0.3, 0.3, 1.0)
    scale = 16.0
    surface = paraboloid(n=65, radius=exact.radius * scale)
    body = asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), scale)], asp.Elastic(1.0, 0.3))
    problem = asp.ContactProblem(surface, body, boundary=asp.Free())
    result = asp.solve(problem, asp.Force(2.0 * np.pi / 3.0 * scale**2))
    depths = np.array([0.3, 0.5, 1.0, 2.0]) * scale
    field = asp.stress(result, depths, on=asp.stresses.Section(y=32.0), friction=0.25)
    for number, plane in enumerate(field.planes):
        at = next(p for p in planes(exact.body, [plane.depth / scale]) if p.region.index == plane.region.index)
        for column in (32, 40, 24):
            wanted = hankel_fields(exact.body, at, exact, (column - 32) / scale, 0.25)[1]
            for name in STRESSES:
                assert getattr(field.tensor, name)[number, column] == pytest.approx(getattr(wanted, name), abs=6e-3)


@pytest.fixture(scope="module")
def rough_result():
    return asp.solve(asp.ContactProblem(oblong(), DISK), asp.MeanPressure(2e8))


def test_sections_and_profiles_are_parts_of_the_whole(rough_result):
    depths = [0.0, 20e-9, 50e-9, 250e-9, 400e-9]
    whole = asp.stress(rough_result, depths, friction=0.2, direction=(1.0, 1.0), displacement=True)
    i, j = np.unravel_index(np.argmax(rough_result.pressure), rough_result.pressure.shape)
    grid = rough_result.problem.grid
    assert whole.dims == ("plane", "x", "y")
    assert whole.tensor.xx.shape == (7, *grid.shape)
    cases = (
        (asp.stresses.Section(y="max"), ("plane", "x"), (slice(None), slice(None), j)),
        (asp.stresses.Section(x="max"), ("plane", "y"), (slice(None), i, slice(None))),
        (asp.stresses.Section(x="pressure"), ("plane", "y"), (slice(None), i, slice(None))),
        (asp.stresses.Section(y=2.2 * grid.spacing[1]), ("plane", "x"), (slice(None), slice(None), 2)),
        (asp.stresses.DepthProfile(), ("plane",), (slice(None), i, j)),
        (asp.stresses.DepthProfile(0.0, "max"), ("plane",), (slice(None), 0, j)),
    )
    for on, dims, index in cases:
        part = asp.stress(rough_result, depths, on=on, friction=0.2, direction=np.pi / 4, displacement=True)
        assert part.dims == dims
        for name in STRESSES:
            np.testing.assert_allclose(getattr(part.tensor, name), getattr(whole.tensor, name)[index], atol=1e-3)
        np.testing.assert_allclose(part.displacement.z, whole.displacement.z[index], atol=1e-20)


def test_planes_come_one_by_one_and_are_the_same(rough_result):
    depths = np.linspace(0.0, 400e-9, 9)
    whole = asp.stress(rough_result, depths, friction=0.3, dtype="float32")
    stream = asp.stresses.stress_planes(rough_result, depths, friction=0.3, dtype="float32")
    assert iter(stream) is stream
    for number, field in enumerate(stream):
        assert len(field.planes) == 1
        assert field.planes[0] == whole.planes[number]
        assert field.tensor.xx.dtype == np.float32
        np.testing.assert_array_equal(field.von_mises[0], whole.von_mises[number])
    assert number == len(whole.planes) - 1


def test_labels_of_planes(rough_result):
    field = asp.stress(rough_result, [300e-9, 0.0, 50e-9, 250e-9], on=asp.stresses.DepthProfile())
    np.testing.assert_array_equal(field.depth, [0.0, 50e-9, 50e-9, 250e-9, 250e-9, 300e-9])
    np.testing.assert_array_equal(field.region, [0, 0, 1, 1, 2, 2])
    assert [plane.side for plane in field.planes] == ["surface", "above", "below", "above", "below", "inside"]
    assert [region.name for region in field.regions] == ["DLC", "layer 2", "Al-Mg"]
    inner = field.within("layer 2")
    assert inner.tensor.xx.shape == (2,)
    np.testing.assert_array_equal(field.within(1).normal_xx, field.normal_xx[2:4])
    np.testing.assert_array_equal(field.within("Diamond-like carbon").normal_xx, field.within("DLC").normal_xx)
    with refused(asp.InputError, "region of a stress field", "0", "1", "2"):
        field.within("DLC2")


def test_interfaces_carry_the_same_tractions_from_both_sides(rough_result):
    field = asp.stress(rough_result, [50e-9, 250e-9], friction=0.4)
    first, second = field.interfaces
    assert (first.above.name, first.below.name, first.depth) == ("DLC", "layer 2", 50e-9)
    assert (second.above.name, second.below.name, second.depth) == ("layer 2", "Al-Mg", 250e-9)
    scale = np.abs(field.normal_zz).max()
    np.testing.assert_allclose(first.peel, field.normal_zz[1], atol=1e-11 * scale)
    np.testing.assert_allclose(first.shear, np.hypot(field.shear_xz[1], field.shear_yz[1]), atol=1e-11 * scale)


def test_the_counter_body_carries_the_opposite_shear():
    """Equal bodies: the same pressure, shear reversed; so its stress is that of the body slid the
    other way."""
    problem = asp.ContactProblem(rough(), DISK, counter_body=DISK)
    result = asp.solve(problem, asp.MeanPressure(1e8))
    depths = [0.0, 30e-9, 120e-9]
    mirrored = asp.stress(result, depths, friction=0.3, direction=0.4 + np.pi)
    counter = asp.stress(result, depths, friction=0.3, direction=0.4, of="counter_body")
    shear = asp.stresses.ShearTraction(0.3 * np.cos(0.4) * result.pressure, 0.3 * np.sin(0.4) * result.pressure)
    from_fields = asp.stress(result, depths, friction=shear, of="counter_body")
    for name in STRESSES:
        scale = 1e-12 * np.abs(counter.normal_zz).max()
        np.testing.assert_allclose(getattr(counter.tensor, name), getattr(mirrored.tensor, name), atol=scale)
        np.testing.assert_allclose(getattr(from_fields.tensor, name), getattr(mirrored.tensor, name), atol=10 * scale)


def test_free_and_periodic_agree_for_a_small_load_in_a_large_box():
    """A load on 8 of 128 pixels: images change the stress by its ratio of area to box times a few,
    1e-3 of the peak.

    Smooth, so that constant traction on pixels and its trigonometric interpolation differ little
    (1 %, at the surface).
    """
    grid = asp.Grid((128, 96), (1.0, 1.25))
    x, y = grid.centred_coordinates()
    pressure = np.exp(-(x**2 + y**2) / 4.0**2)
    body = asp.Layered([asp.Layer(asp.Elastic(3.0, 0.2), 5.0)], asp.Elastic(1.0, 0.3))
    shear = asp.stresses.Sliding(0.4, 0.3)
    for depth in (2.0, 5.0, 9.0):
        fields = [
            StressPlanes(Tractions(grid, pressure, shear, kind), body, [depth]).whole(displacement=True)
            for kind in ("periodic", "free")
        ]
        for name in STRESSES:
            one, other = (getattr(field.tensor, name) for field in fields)
            np.testing.assert_allclose(one, other, atol=1e-2)
        sinks = [field.displacement.z - field.displacement.z[0, 64, 48] for field in fields]
        np.testing.assert_allclose(sinks[0][:, 56:72, 40:56], sinks[1][:, 56:72, 40:56], atol=0.02 * np.ptp(sinks[1]))


def test_the_surface_displacement_is_that_of_the_contact():
    """Three routes to one number: the contact's operator, periodic planes, influence
    coefficients."""
    for boundary in (asp.Periodic(), asp.Free()):
        for body in (asp.Elastic(100e9, 0.3), DISK):
            result = asp.solve(asp.ContactProblem(rough(), body, boundary=boundary), asp.MeanPressure(1e8))
            u = asp.stress(result, [0.0], displacement=True).displacement.z[0]
            np.testing.assert_allclose(u, result.displacement, atol=1e-7 * np.abs(u).max())


def test_a_large_load_decays_with_depth():
    """Saint-Venant: at depths beyond the sphere's contact the stress is that of the force, -3F/2πz²
    on the axis."""
    result = asp.solve(asp.ContactProblem(sphere(), asp.Elastic(100e9, 0.3), boundary=asp.Free()), asp.Force(5e-5))
    depth = 50 * sphere().grid.size[0]
    top = np.unravel_index(np.argmax(result.pressure), result.pressure.shape)
    field = asp.stress(result, [depth], on=asp.stresses.DepthProfile(*(k * 1e-7 for k in top)))
    assert field.normal_zz[0] == pytest.approx(-3 * result.force / (2 * np.pi * depth**2), rel=1e-3)


def test_plane_strain_lines_have_no_out_of_plane_strain():
    """A periodic grid of one row along y: σ_yy = ν(σ_xx + σ_zz), no shear out of the plane."""
    surface = asp.Surface(1e-9 * np.cos(2 * np.pi * np.arange(32) / 32)[:, None], 1e-7, 1e-7)
    result = asp.solve(asp.ContactProblem(surface, DISK), asp.MeanPressure(1e6))
    field = asp.stress(result, [10e-9, 100e-9, 400e-9], friction=0.3)
    nu = np.array([plane.region.material.poisson_ratio for plane in field.planes])[:, None, None]
    scale = 1e-12 * np.abs(field.normal_zz).max()
    np.testing.assert_allclose(field.normal_yy, nu * (field.normal_xx + field.normal_zz), atol=scale)
    np.testing.assert_allclose(field.shear_yz, 0.0, atol=scale)
    np.testing.assert_allclose(field.shear_xy, 0.0, atol=scale)


def test_citations_follow_body_and_boundary(rough_result):
    assert "Burmister1945" in asp.cite(asp.stress(rough_result, [1e-9], on=asp.stresses.DepthProfile())).replace(
        "[", ""
    )
    free = asp.solve(asp.ContactProblem(rough(), asp.Elastic(1e9, 0.3), boundary=asp.Free()), asp.MeanPressure(1e6))
    keys = asp.stress(free, [1e-9], on=asp.stresses.DepthProfile(), friction=0.1).citation_keys
    assert set(keys) == {"Johnson1985", "Liu2002", "Love1929", "Cerruti1882"}


@pytest.mark.parametrize(
    ("arguments", "subject", "shown"),
    [
        ({"depths": []}, "depths", "empty"),
        ({"depths": [-1e-9]}, "depth (m)", "-1e-09"),
        ({"depths": [float("nan")]}, "depth (m)", "nan"),
        ({"depths": [0.0], "of": "counter_body"}, "body in which stresses are asked", "rigid"),
        ({"depths": [0.0], "of": "third"}, "body in which stresses are asked", "'third'"),
        ({"depths": [0.0], "on": "x"}, "points of a plane", "'x'"),
        ({"depths": [0.0], "friction": -0.3}, "friction coefficient", "-0.3"),
        ({"depths": [0.0], "friction": 0.3, "direction": (0.0, 0.0)}, "direction of sliding", "(0, 0)"),
        ({"depths": [0.0], "dtype": "int"}, "precision of stresses", "'int'"),
        ({"depths": [0.0], "on": asp.stresses.Section(y=1.0)}, "y of a section or profile (m)", "9e-07"),
        (
            {"depths": [0.0], "friction": asp.stresses.ShearTraction(np.zeros((2, 2)), np.zeros((2, 2)))},
            "shear traction along x (Pa)",
            "(2, 2)",
        ),
    ],
)
def test_refusals(rough_result, arguments, subject, shown):
    with refused(asp.InputError, subject, shown):
        asp.stress(rough_result, **arguments)


def test_more_refusals():
    with refused(asp.InputError, "section"):
        asp.stresses.Section()
    with refused(asp.InputError, "section"):
        asp.stresses.Section(x=0.0, y=0.0)
    with refused(asp.InputError, "position of a section (m)", "middle", "pressure"):
        asp.stresses.Section(x="middle")
    with refused(asp.InputError, "x of a depth profile (m)"):
        asp.stresses.DepthProfile(x="left")
    surface = rough()
    slipping = asp.Layered([asp.Layer(asp.Elastic(1e9, 0.3), 1e-7, asp.Frictionless())], asp.Elastic(1e9, 0.3))
    result = asp.solve(asp.ContactProblem(surface, slipping), asp.MeanPressure(1e6))
    asp.stress(result, [1e-7], on=asp.stresses.DepthProfile())
    with refused(asp.InputError, "mean shear traction", "frictionless"):
        asp.stress(result, [1e-7], friction=0.1)
    on_rock = asp.Layered([asp.Layer(asp.Elastic(1e9, 0.3), 1e-7)], asp.RigidBase())
    result = asp.solve(asp.ContactProblem(surface, on_rock), asp.MeanPressure(1e6))
    with refused(asp.InputError, "depth (m)", "1e-07", "2e-07"):
        asp.stress(result, [2e-7])


def test_shear_without_mean_above_an_interface_that_slips():
    """Free and periodic agree where images do not count: two Gaussians of shear that cancel up to
    their second moment, whose field falls like (width/r)³. Constant tractions on pixels lack
    (αΔ)²/24 of the waves, α about 2/width, along each axis; on the surface edges of pixels count,
    so only planes below are compared (found: 0.008)."""
    body = asp.Layered([asp.Layer(asp.Elastic(3.0, 0.3), 6.0, asp.Frictionless())], asp.Elastic(1.0, 0.2))
    grid, width = asp.Grid((96, 96), (1.0, 1.0)), 6.0
    x, y = (line - 48.0 for line in grid.coordinates())
    bell = np.exp(-(x**2 + y**2) / (2 * width**2))
    qx = bell * (1.0 - x**2 / width**2)
    shear = asp.stresses.ShearTraction(qx - qx.mean(), np.zeros_like(qx))
    fields = [
        StressPlanes(Tractions(grid, np.zeros_like(qx), shear, boundary), body, [3.0, 6.0]).whole()
        for boundary in ("free", "periodic")
    ]
    bound = 2 * (2.0 / width) ** 2 / 24 + 8 * (width / 96.0) ** 3
    for name in STRESSES:
        free, periodic = (getattr(field.tensor, name) for field in fields)
        np.testing.assert_allclose(free, periodic, atol=bound, err_msg=name)  # of the largest traction, 1
    assert not fields[0].within(1).shear_xz.any()
    assert StressPlanes(Tractions(grid, np.zeros_like(qx), shear), body, [3.0]).whole(displacement=True).displacement


def test_depths_through_a_body():
    depths = asp.stresses.depths_through(DISK, 1e-6, per_region=4)
    assert (np.diff(depths) > 0.0).all()
    np.testing.assert_allclose(depths[:9], [0.0, 12.5e-9, 25e-9, 37.5e-9, 50e-9, 100e-9, 150e-9, 200e-9, 250e-9])
    assert depths[-1] == pytest.approx(1e-6)
    assert (np.diff(np.diff(depths[8:])) > 0.0).all()
    assert len(planes(DISK, depths)) == len(depths) + 2  # both sides of two interfaces
    np.testing.assert_allclose(asp.stresses.depths_through(DISK, 150e-9, per_region=1), [0.0, 50e-9, 150e-9])
    with refused(asp.InputError, "deepest depth (m)"):
        asp.stresses.depths_through(DISK, 0.0)


def test_free_fields_pass_through_interfaces():
    """Coefficients above and below an interface come by different routes (closed forms and
    transforms, transforms)."""
    body = asp.Layered(
        [asp.Layer(asp.Elastic(5.0, 0.2), 0.7), asp.Layer(asp.Elastic(0.4, 0.4), 2.0)], asp.Elastic(1.0, 0.3)
    )
    grid = asp.Grid((30, 24), (1.0, 0.8))
    loads = Tractions(grid, np.random.default_rng(1).random(grid.shape), asp.stresses.Sliding(0.4, 1.0), "free")
    field = StressPlanes(loads, body, [0.7, 2.7]).whole(displacement=True)
    for above in (0, 2):
        for component in (field.normal_zz, field.shear_xz, field.shear_yz, *vars(field.displacement).values()):
            scale = np.abs(component[above]).max()
            np.testing.assert_allclose(component[above + 1], component[above], atol=1e-7 * scale)


def test_trends_of_a_rough_coated_contact():
    """Friction raises the largest √J2 and σxz and lifts them to the surface; the pressure has
    nothing to do with it.

    A stiffer layer bears higher stresses on less area (Peng & Bhushan 2001, figs 8 to 11, in
    character).
    """
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=0.25e-6
    )
    scan = asp.generate.gaussian(asp.Grid((128, 128), (25e-9, 25e-9)), spectrum, seed=4)
    largest, areas = {}, {}
    for ratio in (0.5, 2.0):
        body = asp.Layered([asp.Layer(asp.Elastic(ratio * 100e9, 0.3), 1e-6)], asp.Elastic(100e9, 0.3))
        result = asp.solve(asp.ContactProblem(scan, body), asp.MeanPressure(20e6))
        areas[ratio] = result.area_fraction
        depths = np.concatenate([[0.0], np.geomspace(12e-9, 2e-6, 24)])
        for mu in (0.0, 0.25, 0.5):
            field = asp.stress(result, depths, friction=mu)
            largest[ratio, mu] = field.peak(field.sqrt_J2), field.peak(np.abs(field.shear_xz))
        root, shear = zip(*(largest[ratio, mu] for mu in (0.0, 0.25, 0.5)), strict=True)
        assert root[0].value < root[1].value < root[2].value
        assert shear[0].value < shear[1].value < shear[2].value
        assert root[2].depth < root[0].depth
        assert shear[2].depth < shear[0].depth
    for mu in (0.0, 0.25, 0.5):
        assert largest[2.0, mu][0].value > 1.5 * largest[0.5, mu][0].value
    assert areas[0.5] > 1.5 * areas[2.0]
