"""Finite elements against fields they must hold exactly, another library, an expanding cavity,
Hertz and collapse loads."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse
from reference_data import Row, reference
from refusals import refused

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.core.errors import ConvergenceError, InputError
from asperity.fem import contact, elements, linear, mesh, solid
from asperity.solids.plasticity import J2, LinearHardening, PlasticState

STEEL = asp.Elastic(1.0, 0.3)
KINDS = {"axisymmetric": elements.axisymmetric, "plane strain": elements.plane_strain}


def distorted(seed: int = 3) -> mesh.Mesh:
    """4 x 5 quadrilaterals, the inner points of which lie anywhere."""
    regular = mesh.tensor_mesh(np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.5, 6), np.zeros(5, dtype=np.intp))
    inner = (regular.points[:, 0] % 1.0 > 0.0) & (regular.points[:, 1] % 1.5 > 0.0)
    moved = regular.points + 0.06 * np.random.default_rng(seed).uniform(-1, 1, regular.points.shape) * inner[:, None]
    return mesh.Mesh(moved, regular.cells, regular.region)


def held(
    body: solid.Solid, known: RealArray, prescribed: np.ndarray, state: PlasticState | None = None
) -> tuple[RealArray, solid.Response, list[float]]:
    """Displacement with the ``known`` values at ``prescribed`` unknowns, by Newton's method, and
    unbalanced forces on the way."""
    u, start, left = np.zeros(len(known)), state or body.virgin(), []
    for _ in range(25):
        found = body.respond(u, start, stiffness=True)
        assert found.stiffness is not None
        move = np.where(prescribed, known - u, 0.0)
        left.append(float(np.abs(found.forces[~prescribed]).max() / np.abs(found.forces).max()) if u.any() else 1.0)
        if left[-1] < 1e-13 or (len(left) > 3 and left[-1] < 1e-11 and left[-1] > 0.1 * left[-2]):
            return u, found, left
        right = np.where(prescribed, 0.0, -found.forces - found.stiffness @ move)
        u = u + move + linear.factorised(linear.without(found.stiffness, prescribed))(right)
    raise AssertionError(left)


@pytest.mark.parametrize("kind", KINDS)
def test_patch(kind: str) -> None:
    """Uniform strain, elastic or plastic, is held exactly by distorted elements."""
    grid = distorted()
    parts = KINDS[kind](grid)
    edge = (grid.points % np.array([1.0, 1.5]) == 0.0).any(axis=1)
    shear = 0.0 if kind == "axisymmetric" else 0.004
    x, z = grid.points.T
    known = np.stack([0.003 * x + shear * z, -0.008 * z], axis=1).ravel()
    for law in (STEEL, J2(STEEL, LinearHardening(0.002, 0.1))):
        u, found, _ = held(solid.Solid(parts, (law,)), known, np.repeat(edge, 2))
        np.testing.assert_allclose(u, known, atol=1e-14)
        assert np.ptp(found.stress, axis=(0, 1)).max() < 1e-13
        assert (found.state.accumulated > 0.001).all() == isinstance(law, J2)


def test_plane_strain_stiffness_is_that_of_another_library() -> None:
    """On rectangles the mean of the dilatation is that at the centre, which scikit-fem integrates
    with one point."""
    skfem = pytest.importorskip("skfem")
    from skfem.helpers import ddot, div, sym_grad, trace

    x, z = np.array([0.0, 0.4, 1.0, 1.3]), np.array([0.0, 0.5, 0.7, 1.6])
    grid = mesh.tensor_mesh(x, z, np.zeros(3, dtype=np.intp))
    own = solid.Solid(elements.plane_strain(grid), (STEEL,))
    stiffness = own.respond(np.zeros(own.elements.size), own.virgin(), stiffness=True).stiffness
    G, K = STEEL.shear_modulus, STEEL.youngs_modulus / (3 * (1 - 2 * STEEL.poisson_ratio))
    other = skfem.MeshQuad(grid.points.T.copy(), grid.cells.T.copy().astype(np.int64), sort_t=False)
    kind = skfem.ElementVector(skfem.ElementQuad1())
    shear = skfem.BilinearForm(
        lambda u, v, w: 2 * G * (ddot(sym_grad(u), sym_grad(v)) - trace(sym_grad(u)) * trace(sym_grad(v)) / 3)
    )
    volume = skfem.BilinearForm(lambda u, v, w: K * div(u) * div(v))
    centre = np.array([[0.5], [0.5]]), np.array([1.0])
    # the change of shape uses the local dilatation, the change of volume its mean
    wanted = shear.assemble(skfem.Basis(other, kind, intorder=3)) + volume.assemble(
        skfem.Basis(other, kind, quadrature=centre)
    )
    assert stiffness is not None
    np.testing.assert_allclose(stiffness.toarray(), wanted.toarray(), atol=1e-13)


def rings(outer: float, around: int) -> mesh.Mesh:
    """A quarter of a spherical shell from radius 1 to ``outer``, square elements."""
    angles = np.linspace(0.0, 0.5 * np.pi, around + 1)
    radii = np.exp(np.arange(round(np.log(outer) * around / (0.5 * np.pi)) + 1) * 0.5 * np.pi / around)
    flat = mesh.tensor_mesh(angles, radii, np.zeros(len(radii) - 1, dtype=np.intp))
    angle, radius = flat.points.T
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points[np.abs(points) < 1e-12 * radius[:, None]] = 0.0
    return mesh.Mesh(points, flat.cells[:, [0, 3, 2, 1]], flat.region)


def cavity(row: Row, around: int) -> tuple[float, list[float]]:
    """Pressure over Y in a cavity that is widened to the displacement of ``row`` in one step, and
    the residuals of Newton's method."""
    E, nu, c = float(row["E_over_Y"]), float(row["nu"]), float(row["c_over_a"])
    grid = rings(4.0 * c, around)
    parts = elements.axisymmetric(grid)
    body = solid.Solid(parts, (J2(asp.Elastic(E, nu), LinearHardening(1.0)),))
    radius = np.linalg.norm(grid.points, axis=1)
    inner, outer = radius < 1.0 + 1e-9, radius > radius.max() - 1e-9
    far = (1.0 + nu) / E * c**3 / (3.0 * radius**2)
    known = (np.where(inner, float(row["u_a_over_a"]), far) / radius)[:, None] * grid.points
    fixed = np.repeat((inner | outer)[:, None], 2, axis=1) | (grid.points == 0.0)
    _, found, left = held(body, known.ravel(), fixed.ravel())
    force = (found.forces.reshape(-1, 2)[inner] * grid.points[inner]).sum()
    return float(force) / (2.0 * np.pi), left


CAVITIES = [row for row in reference("expanding_cavity") if float(row["nu"]) < 0.5]


@pytest.mark.parametrize(
    "case", [row["case"] for row in CAVITIES if row["E_over_Y"] in (200.0,) and row["c_over_a"] in (1.2, 3.0)]
)
def test_expanding_cavity(case: float) -> None:
    """The pressure of Hill's cavity; the error of bilinear elements falls fourfold when they are
    halved."""
    row = next(row for row in CAVITIES if row["case"] == case)
    errors = [cavity(row, around)[0] / float(row["p_over_Y"]) - 1.0 for around in (12, 24)]
    assert abs(errors[1]) < 0.003
    assert abs(errors[1]) < 0.35 * abs(errors[0])


def test_newton_is_quadratic() -> None:
    """With the consistent tangent the number of right digits doubles at the end."""
    row = next(row for row in CAVITIES if row["c_over_a"] == 3.0)
    left = np.array(cavity(row, 12)[1])
    last = np.flatnonzero(left < 3e-2)[0]
    before, after = left[last : last + 2]
    assert after < 10.0 * before**2


def pressed(
    resolution: mesh.Resolution, law: asp.Elastic | J2, *, plane: bool = False, friction: float = 0.0
) -> tuple[contact.Pressed, RealArray]:
    """A half-space beneath contacts of radius 1 at most, and the places of the points that may
    touch."""
    grid = mesh.layered_mesh(asp.Layered([], STEEL), 1.0, resolution)
    parts = elements.plane_strain(grid) if plane else elements.axisymmetric(grid)
    near = grid.surface[grid.points[grid.surface, 0] < 2.0]
    fixed = np.zeros((len(grid.points), 2), dtype=bool)
    fixed[grid.side(-1), 0] = True
    fixed[grid.side(1)] = fixed[grid.lower] = True
    along = 2 * near[:, None] if friction else np.zeros((len(near), 0), dtype=np.intp)
    surface = contact.ContactSurface(2 * near + 1, fixed.ravel(), along, friction)
    return contact.Pressed(solid.Solid(parts, (law,)), surface), grid.points[near, 0]


@pytest.mark.slow
@pytest.mark.parametrize("by_force", [False, True])
def test_hertz(by_force: bool) -> None:
    """Load within 0.3 % of Hertz, the contact radius within half an element, by approach and by
    force alike."""
    body, r = pressed(mesh.Resolution(growth=1.1, distance=1000.0), STEEL)
    E_star, R, a = STEEL.plane_strain_modulus, 10.0, 0.9
    load = 4.0 * E_star * a**3 / (3.0 * R)
    target = contact.Target(r**2 / (2 * R), None if by_force else a**2 / R, load if by_force else 0.0)
    found = body.advance(body.undeformed(), lambda part: target)
    assert found.force == pytest.approx(load, rel=1e-9 if by_force else 0.003)
    assert found.approach == pytest.approx(a**2 / R, rel=0.003)
    assert abs(r[found.touching].max() + 0.5 * r[1] - a) <= 0.5 * r[1] + 1e-12


def test_a_layer_of_rigid_base_and_interfaces_of_the_mesh() -> None:
    """A line of the mesh lies at every interface, six elements are in the thinnest layer, and the
    mesh ends at a rigid base."""
    body = asp.Layered([asp.Layer(STEEL, 0.01), asp.Layer(asp.Elastic(2.0, 0.3), 0.5)], asp.RigidBase())
    grid = mesh.layered_mesh(body, 1.0, mesh.Resolution())
    z = np.unique(grid.points[:, 1])
    assert z.max() == pytest.approx(0.51)
    assert np.abs(z - 0.01).min() < 1e-15
    assert (z <= 0.01).sum() >= 7
    assert (np.diff(z)[1:] / np.diff(z)[:-1]).max() < 1.3
    assert {*grid.region} == {0, 1}


def test_what_meshes_refuse() -> None:
    with refused(InputError, "distance of the far boundary (contact radii)", "2"):
        mesh.Resolution(distance=2.0)
    slips = asp.Layered([asp.Layer(STEEL, 0.1, asp.Frictionless())], STEEL)
    with refused(InputError, "interface of a meshed layer", "Frictionless"):
        mesh.layered_mesh(slips, 1.0, mesh.Resolution())
    with refused(InputError, "Poisson's ratio of a meshed solid", "0.5"):
        solid.elastic_tensor(asp.Elastic(1.0, 0.5))
    with pytest.raises(ConvergenceError):
        linear.factorised(scipy.sparse.csc_array(np.zeros((2, 2))))
