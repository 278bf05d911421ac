"""Response of layered bodies to eigenstrain and surface tractions: exact solutions, other parts of
the package, symmetries, conservation."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import Row, reference
from refusals import refused
from scipy.special import j0, j1

import asperity as asp
from asperity.core.arrays import RealArray
from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.solids.eigenstrain.cells import DepthCells, depth_edges
from asperity.solids.eigenstrain.operator import EigenstrainOperator, Wavevectors, swept
from asperity.solids.eigenstrain.tables import SweepTable

NAMES = ("xx", "yy", "zz", "xy", "xz", "yz")
WEIGHTS = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])[None, :, None, None]
SUBSTRATE = asp.Elastic(200e9, 0.3)
STACK = asp.Layered(
    [asp.Layer(asp.Elastic(400e9, 0.25), 0.7e-6), asp.Layer(asp.Elastic(70e9, 0.35), 0.9e-6)], SUBSTRATE
)
ON_RIGID = asp.Layered([asp.Layer(asp.Elastic(70e9, 0.35), 3e-6)], asp.RigidBase())
GRID = Grid((15, 14), (0.5e-6, 0.4e-6))

CASES: dict[object, list[Row]] = {}
for line in reference("eigenstrain_cuboid_surface"):
    CASES.setdefault(line["case"], []).append(line)


def polar(largest: float, panel: float, reach: float) -> tuple[RealArray, RealArray, RealArray]:
    """Wavevectors in polar coordinates up to ``largest`` and their weights, for functions that
    reach as far as ``reach``."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    ends = np.linspace(0.0, largest, int(np.ceil(largest / panel)) + 1)
    half = 0.5 * np.diff(ends)
    alpha = (half[:, None] * nodes + 0.5 * (ends[1:] + ends[:-1])[:, None]).ravel()
    count = int(2.0 * largest * reach + 80)
    angle = 2.0 * np.pi * (np.arange(count) + 0.5) / count
    share = (alpha * (half[:, None] * weights).ravel())[:, None] * np.full(count, 0.5 / (np.pi * count))
    return (alpha[:, None] * np.cos(angle)).ravel(), (alpha[:, None] * np.sin(angle)).ravel(), share.ravel()


@pytest.mark.parametrize("case", sorted(CASES, key=str))
def test_cuboids(case: object) -> None:
    """Displacement of the surface over a uniform cuboid of each component, known to 1e-11, by
    quadrature over all wavevectors."""
    row = CASES[case][0]
    nu, a, b, half, middle, x, y = (
        float(row[name]) for name in ("nu", "half_x", "half_y", "half_z", "depth_centre", "x", "y")
    )
    reach = float(np.hypot(a + abs(x), b + abs(y)))
    qx, qy, share = polar(32.0 / (middle - half), min(2.0 / reach, 2.0 / middle), reach)
    waves = Wavevectors.single(qx, qy)
    table = SweepTable.of(DepthCells(asp.Elastic(1.0, nu), np.array([0.0, middle - half, middle + half])), waves.alpha)
    shape = 4.0 * a * b * np.sinc(qx * a / np.pi) * np.sinc(qy * b / np.pi)
    phase = np.exp(1j * (qx * x + qy * y)) * share
    for row in CASES[case]:
        fields = np.zeros((2, 6, 1, qx.size), dtype=complex)
        fields[1, NAMES.index(str(row["component"])), 0] = shape
        moved = swept(table, waves, np.zeros((3, 1, qx.size), dtype=complex), fields)[:, 0]
        found = [(moved[2] @ phase).real, (moved[0] @ phase).real]
        wanted = [float(row["uz"]), float(row["ux"])]
        assert found == pytest.approx(wanted, abs=1e-10 * np.abs(wanted).max())


@pytest.mark.parametrize("rho", [0.0, 0.7, 2.0])
def test_dilatational_ball(rho: float) -> None:
    """u_z = -(1 + ν) ε (4 r³/3) d/(ρ² + d²)^(3/2) outside a ball of radius r at the depth d; slices
    of constant strain converge to it as their thickness squared."""
    radius, depth, nu = 0.6, 1.0, 0.3
    exact = -(1.0 + nu) * 4.0 * radius**3 / 3.0 * depth / (rho**2 + depth**2) ** 1.5
    nodes, weights = np.polynomial.legendre.leggauss(16)
    errors = []
    alpha = 60.0 * np.arange(0.5, 3000.0) / 3000.0
    waves = Wavevectors.single(alpha, np.zeros_like(alpha))
    for slices in (10, 20):
        edges = np.concatenate([[0.0], np.linspace(depth - radius, depth + radius, slices + 1)])
        table = SweepTable.of(DepthCells(asp.Elastic(1.0, nu), edges), waves.alpha)
        fields = np.zeros((slices + 1, 6, 1, alpha.size), dtype=complex)
        for number in range(1, slices + 1):
            z = 0.5 * (edges[number] + edges[number + 1]) + 0.5 * (edges[number + 1] - edges[number]) * nodes
            across = np.sqrt(radius**2 - (z - depth) ** 2)
            discs = 2.0 * np.pi * across[:, None] * j1(alpha * across[:, None]) / alpha
            fields[number, :3, 0] = 0.5 * weights @ discs
        moved = swept(table, waves, np.zeros((3, 1, alpha.size), dtype=complex), fields)[2, 0].real
        found = float((moved * alpha * j0(alpha * rho)).sum()) * 0.02 / (2.0 * np.pi)
        errors.append(abs(found / exact - 1.0))
    assert errors[1] < 4e-3
    assert errors[1] < errors[0] / 3.5


def operator(
    body: asp.Elastic | asp.Layered, grid: Grid = GRID, *, free: bool = False, cells: int = 12
) -> EigenstrainOperator:
    depth = 3e-6 if body is ON_RIGID else 5e-6
    return EigenstrainOperator.prepared(
        grid, DepthCells(body, depth_edges(body, depth, 0.2e-6, cells)), free=free, threads=1
    )


def random_strain(made: EigenstrainOperator, seed: int) -> RealArray:
    return np.random.default_rng(seed).normal(size=(made.cells.count, 6, *made.grid.shape))


def product(made: EigenstrainOperator, stress: RealArray, strain: RealArray) -> float:
    """∫ σ : ε dV over the pixel area."""
    return float((stress * strain * WEIGHTS * made.cells.thickness[:, None, None, None]).sum())


@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("body", [SUBSTRATE, STACK, ON_RIGID], ids=["half-space", "layers", "rigid base"])
def test_symmetry_and_reciprocity(body: asp.Elastic | asp.Layered, free: bool) -> None:
    """Betti: eigenstrain to stress is symmetric and takes energy, and by (5.1) tractions do on its
    displacement what their stress does on it."""
    made = operator(body, free=free)
    one, two = random_strain(made, 1), random_strain(made, 2)
    (of_one, moved), (of_two, _) = made.stress(one), made.stress(two)
    assert product(made, of_one, two) == pytest.approx(product(made, of_two, one), rel=1e-12)
    assert product(made, of_one, one) < 0.0
    generator = np.random.default_rng(3)
    pressure, shear = generator.normal(size=GRID.shape), generator.normal(size=(2, *GRID.shape))
    loaded, _ = made.stress(None, pressure, shear)
    work = float((pressure * moved[2]).sum() + (shear * moved[:2]).sum())
    assert work == pytest.approx(product(made, loaded, one), rel=1e-12)


def test_stored_energy_is_bounded_by_that_of_blocked_strain() -> None:
    """0 <= -ε:S:ε <= ε:C:ε, on which the convergence of return mappings rests."""
    made = operator(STACK)
    for seed in range(3):
        strain = random_strain(made, seed)
        stress, _ = made.stress(strain)
        blocked = np.empty_like(strain)
        for number, solid in enumerate(made.cells.materials):
            G, nu = solid.shear_modulus, solid.poisson_ratio
            trace = strain[number, :3].sum(axis=0)
            blocked[number] = 2.0 * G * strain[number]
            blocked[number, :3] += 2.0 * G * nu / (1.0 - 2.0 * nu) * trace
        assert 0.0 < -product(made, stress, strain) < product(made, blocked, strain)


def test_tractions_give_the_stress_of_the_package() -> None:
    """Means over the cells of the stress field that the package computes by other means."""
    grid = Grid((15, 17), GRID.spacing)
    smooth, shear = spot(grid)
    made, sheared = operator(STACK, grid), asp.stresses.ShearTraction(*shear)
    found, _ = made.stress(None, smooth, shear)
    loaded = asp.stresses.LoadedBody(STACK, asp.stresses.Tractions(grid, smooth, sheared, "periodic"))
    nodes, weights = np.polynomial.legendre.leggauss(8)
    for number in (1, made.cells.count // 2, made.cells.count - 1):
        low, high = made.cells.edges[number : number + 2]
        field = asp.stress(loaded, 0.5 * (high + low) + 0.5 * (high - low) * nodes)
        for part, name in enumerate(NAMES):
            mean = 0.5 * np.tensordot(weights, getattr(field.tensor, name), 1)
            np.testing.assert_allclose(found[number, part], mean, atol=1e-9)


def spot(grid: Grid) -> tuple[RealArray, RealArray]:
    """A smooth pressure about the middle of ``grid`` and shear tractions of its shape."""
    x, y = grid.centred_coordinates()
    smooth = np.exp(-((x / 1.2e-6) ** 2) - (y / 1.2e-6) ** 2)
    return smooth, np.stack([0.3 * smooth, -0.2 * smooth])


def test_images_of_tractions_on_a_padded_grid() -> None:
    """Where a contact does not repeat the stress is that on a much larger grid, up to images that
    fall with the length at least squared."""

    def at(count: int) -> RealArray:
        grid = Grid((count, count), (0.5e-6, 0.5e-6))
        made = EigenstrainOperator.prepared(
            grid, DepthCells(STACK, np.array([0.0, 0.7e-6, 1.6e-6, 3e-6])), free=True, threads=1
        )
        found = made.stress(None, *spot(grid))[0]
        begin = count // 2 - 6
        return found[:, :, begin : begin + 12, begin : begin + 12]

    exact, *coarser = (at(count) for count in (96, 24, 12))
    large, small = (float(np.abs(found - exact).max()) for found in coarser)
    assert large < 4e-3
    assert large < small / 4.0


def test_layers_of_one_material_are_homogeneous() -> None:
    """Interfaces and depth cells that divide others do not matter where nothing changes there."""
    layered = asp.Layered([asp.Layer(SUBSTRATE, 0.7e-6), asp.Layer(SUBSTRATE, 0.9e-6)], SUBSTRATE)
    edges = depth_edges(layered, 5e-6, 0.2e-6, 12)
    made = [EigenstrainOperator.prepared(GRID, DepthCells(body, edges), threads=1) for body in (layered, SUBSTRATE)]
    strain = random_strain(made[0], 4)
    (one, moved), (two, the_same) = (each.stress(strain) for each in made)
    np.testing.assert_allclose(one, two, atol=1e-12 * np.abs(two).max())
    np.testing.assert_allclose(moved, the_same, atol=1e-12 * np.abs(the_same).max())
    halved = np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))
    finer = EigenstrainOperator.prepared(GRID, DepthCells(SUBSTRATE, halved), threads=1)
    stress, _ = finer.stress(np.repeat(strain, 2, axis=0))
    np.testing.assert_allclose(0.5 * (stress[::2] + stress[1::2]), two, atol=1e-11 * np.abs(two).max())


def test_no_cell_passes_on_a_net_force() -> None:
    """Residual tractions on any plane balance each other, and close to the free surface they
    vanish."""
    edges = np.array([0.0, 1e-10, 0.4e-6, 0.8e-6, 1.4e-6, 2.5e-6])
    made = EigenstrainOperator.prepared(GRID, DepthCells(SUBSTRATE, edges), threads=1)
    strain = random_strain(made, 5)
    strain[0] = 0.0
    stress, _ = made.stress(strain)
    largest = np.abs(stress).max()
    assert np.abs(stress[:, [2, 4, 5]].mean(axis=(2, 3))).max() < 1e-12 * largest
    assert (
        np.abs(stress[0, [2, 4, 5]]).max() < 2e-3 * largest
    )  # grows from zero with depth times the largest wavenumber


def test_images_of_a_padded_grid_fall_with_its_length() -> None:
    """The displacement over a strained spot nears that of an unbounded body as the cube of the
    distance of its images."""
    error = []
    nodes, depth, nu = 6, 1.5e-6, 0.3
    for count in (16, 32):
        grid = Grid((count, count), (0.5e-6, 0.5e-6))
        made = EigenstrainOperator.prepared(
            grid, DepthCells(asp.Elastic(1e9, nu), np.array([0.0, depth, depth + 0.1e-6])), free=True, threads=1
        )
        x, y = grid.centred_coordinates()
        strain = np.zeros((2, 6, *grid.shape))
        strain[1, :3] = np.exp(-(x**2 + y**2) / 0.8e-6**2)
        moved = made.stress(strain)[1][2]
        # superposed balls: the displacement by a small volume V is -(1 + ν) V/π d/R³
        z = depth + 0.05e-6 * (1.0 + np.polynomial.legendre.leggauss(nodes)[0])
        w = 0.05e-6 * np.polynomial.legendre.leggauss(nodes)[1]
        s = (np.arange(-60, 61) + 0.5)[:, None] * 0.05e-6
        spot = np.exp(-(s**2 + s.T**2) / 0.8e-6**2) * 0.05e-6**2
        exact = (
            -(1.0 + nu)
            / np.pi
            * sum(wi * float((spot * zi / (s**2 + s.T**2 + zi**2) ** 1.5).sum()) for wi, zi in zip(w, z, strict=True))
        )
        error.append(abs(moved.min() / exact - 1.0))
    assert error[0] < 2e-2
    assert error[1] < error[0] / 6.0


def test_edges_of_depth_cells() -> None:
    """Interfaces are edges, cells are thinnest at the surface and beside interfaces, and their
    number is near the one asked for."""
    edges = depth_edges(STACK, 5e-6, 0.1e-6, 40)
    assert abs(edges.size - 41) <= 2
    assert np.diff(edges)[0] == pytest.approx(0.1e-6, rel=0.2)
    assert any(edge == pytest.approx(0.7e-6) for edge in edges)
    assert edges[-1] == pytest.approx(5e-6)
    assert np.diff(edges).argmax() == edges.size - 2
    assert depth_edges(ON_RIGID, 9e-6, 0.1e-6)[-1] == pytest.approx(3e-6)


@pytest.mark.parametrize(
    "edges", [[0.0, 1e-6], [0.1e-6, 0.7e-6, 1.6e-6], [0.0, 0.7e-6, 0.5e-6]], ids=["interface", "start", "order"]
)
def test_refused_edges(edges: list[float]) -> None:
    with refused(InputError, "edges of depth cells (m)"):
        DepthCells(STACK, np.array(edges))


def test_slipping_layers_are_refused() -> None:
    slipping = asp.Layered([asp.Layer(SUBSTRATE, 1e-6, asp.Frictionless())], SUBSTRATE)
    with refused(InputError, "layers that hold an eigenstrain"):
        depth_edges(slipping, 2e-6, 0.1e-6)
