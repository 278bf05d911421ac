"""Flow through a gap against closed forms, its symmetry and limits, and its certificate."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
import pytest
from numpy.typing import NDArray
from reference_data import Row, every_row, reference
from refusals import refused
from scipy import ndimage

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.physics.sealing import solver
from asperity.physics.sealing.flow import GapFlow, flow_tensor, flow_through
from asperity.physics.sealing.network import clusters

Field = NDArray[np.float64]
GEOMETRIES = reference("transport/gap_flow")
OBSTACLES = reference("transport/obstacle_array")


def flow(gap: Field, length: float = 1.0, width: float = 1.0, **options: object) -> GapFlow:
    """Flow through a ``gap`` on a grid of ``length`` x ``width`` m."""
    grid = Grid(gap.shape, (length / gap.shape[0], width / gap.shape[1]))
    return flow_through(gap, grid, **options)  # type: ignore[arg-type]


def rough(n: int = 64, seed: int = 3, waves: float = 2.0) -> Field:
    """Random periodic heights (n, n) with an rms of one."""
    heights = ndimage.gaussian_filter(np.random.default_rng(seed).standard_normal((n, n)), waves, mode="wrap")
    return np.asarray(heights / heights.std())


def rate_of(row: Row, n: int) -> float:
    """The flow of a ``row`` of the table of closed forms on ``n`` cells along its variable."""
    kind, q, x = str(row["geometry"]), float(row["parameter"]), (np.arange(n) + 0.5) / n
    along, across = np.ones((1, 3)), np.ones((3, 1))
    repeat = {"wraps": (True, True), "repeats": True}
    if kind.startswith("sinusoid"):
        wave = 1.0 + q * np.cos(2.0 * np.pi * x)
        return flow(wave[:, None] * along if "across" in kind else across * wave, **repeat).transmissivity
    if kind.startswith("taper"):
        return flow((1.0 + (q - 1.0) * x)[:, None] * along).transmissivity
    if kind.startswith("step"):
        step = np.where(x < 0.5, 1.0, q)
        return flow(step[:, None] * along if "length" in kind else across * step).transmissivity
    if kind.startswith("parabolic_channel"):
        return flow(across * (4.0 * x * (1.0 - x))).transmissivity
    if kind.startswith("parabolic_throat"):
        length = 80.0 * np.sqrt(2.0 * q)
        return flow((q + 0.5 * ((x - 0.5) * length) ** 2)[:, None] * along, length).rate
    # an annulus in the logarithm of the radius and the angle, in which the equation is the same
    return flow(np.ones((n, 3)), np.log(q), 2.0 * np.pi).rate


@every_row(GEOMETRIES, lambda row: f"{row['geometry']} {row['parameter']}")
def test_flow_converges_to_the_closed_forms(row: Row) -> None:
    exact = float(row["transmissivity"])
    n = 512 if "sinusoid" in str(row["geometry"]) else 2048
    coarse, fine = (abs(rate_of(row, k) / exact - 1.0) for k in (n // 2, n))
    # the order is two, at a step of the gap one, at which the error is that of the last halving
    assert fine <= max(0.7 * coarse, 1e-12)
    assert fine < 1e-2


@every_row(OBSTACLES, lambda row: str(row["area_fraction"]))
def test_flow_around_obstacles(row: Row) -> None:
    n, fraction, exact = 128, float(row["area_fraction"]), float(row["K_eff_impermeable"])
    x = (np.arange(n) + 0.5) / n - 0.5
    gap = np.where(np.hypot(x[:, None], x[None]) < np.sqrt(fraction / np.pi), 0.0, 1.0)
    tensor = flow_tensor(gap, Grid((n, n), (1.0 / n, 1.0 / n)))
    # the circle is jagged by a pixel: a radius that errs by half of one moves K by dK/dr / (2 n)
    radius = np.sqrt(fraction / np.pi)
    near = [(r["area_fraction"], r["K_eff_impermeable"]) for r in OBSTACLES]
    slope = np.gradient([k for _, k in near], np.sqrt(np.array([f for f, _ in near], float) / np.pi))
    error = abs(np.interp(radius, np.sqrt(np.array([f for f, _ in near], float) / np.pi), slope)) / (2 * n)
    assert tensor.matrix[0, 0] == pytest.approx(exact, abs=error)
    assert tensor.matrix[1, 1] == pytest.approx(tensor.matrix[0, 0], rel=1e-12)
    assert abs(tensor.matrix[0, 1]) < 1e-12


@pytest.mark.parametrize("lift", [2.0, 0.5, 0.2])
@pytest.mark.parametrize("repeats", [False, True])
def test_certificate(lift: float, repeats: bool) -> None:
    found = flow(np.maximum(rough() + lift, 0.0), wraps=(True, True), repeats=repeats)
    assert not found.sealed
    assert found.section_error < 1e-8
    assert found.residual < 1e-8
    bounds, faces = found.bounds, found.face_bounds
    assert bounds.lower <= bounds.upper * (1.0 + 1e-14)
    assert bounds.upper - bounds.lower < 1e-10 * found.rate
    assert faces.lower < found.rate < faces.upper
    # what is dissipated is what flows, under one unit of pressure
    assert found.dissipated.sum() == pytest.approx(found.rate, rel=1e-10)


def test_bounds_hold_for_a_pressure_that_is_not_the_solution() -> None:
    found = flow(np.maximum(rough() + 0.5, 0.0))
    wrong = np.where(found.net.carrying, found.pressure + 1e-3 * rough(seed=8), np.nan)
    other = GapFlow(found.gap, found.grid, "x", False, (False, False), found.net, wrong)
    assert other.bounds.lower < found.rate < other.bounds.upper


def test_tensor_is_symmetric_and_turns_with_the_surface() -> None:
    gap = np.maximum(rough() + 0.6, 0.0)
    grid = Grid(gap.shape, (2e-6, 3e-6))
    tensor = flow_tensor(gap, grid)
    matrix = tensor.matrix
    assert matrix[0, 1] == pytest.approx(matrix[1, 0], rel=1e-9)
    assert (tensor.principal > 0.0).all()
    turned = flow_tensor(gap.T.copy(), grid.exchanged).matrix
    np.testing.assert_allclose(turned, matrix.T[::-1, ::-1], rtol=1e-9)
    moved = flow_tensor(np.roll(gap, (11, 23), (0, 1)), grid).matrix
    np.testing.assert_allclose(moved, matrix, rtol=1e-9)


def test_flow_scales_with_the_cube_of_the_gap_and_not_with_the_pixel() -> None:
    gap = np.maximum(rough() + 0.6, 0.0)
    unit = flow(gap, wraps=(False, True))
    nano = flow(1e-9 * gap, 5e-6, 5e-6, wraps=(False, True))
    assert nano.rate == pytest.approx(1e-27 * unit.rate, rel=1e-9)
    assert nano.equivalent_gap == pytest.approx(1e-9 * unit.equivalent_gap, rel=1e-9)


def test_a_wider_gap_never_lets_less_through() -> None:
    heights, before = rough(), 0.0
    for lift in (0.2, 0.3, 0.5, 1.0, 2.0):
        rate = flow(np.maximum(heights + lift, 0.0)).rate
        assert rate > before
        before = rate


def test_wall_and_slit() -> None:
    gap = np.ones((16, 12))
    gap[7] = 0.0
    assert flow(gap).sealed
    assert flow(gap).rate == 0.0
    assert flow(gap, way="y", wraps=(True, True)).rate > 0.0
    gap[7, 5] = 1.0
    slit = flow(gap)
    assert not slit.sealed
    assert slit.flux[0][7, 5] == pytest.approx(slit.rate)


def test_corners_let_nothing_through() -> None:
    chess = np.add.outer(np.arange(8), np.arange(8)) % 2 * 1.0
    assert flow(chess, wraps=(True, True), repeats=True).sealed
    assert flow(chess).sealed


def test_a_cluster_must_go_around_the_grid() -> None:
    gap = np.zeros((12, 12))
    gap[1:, 4] = 1.0
    assert flow(gap, wraps=(True, True), repeats=True).sealed
    gap[0, 4] = 1.0
    assert not flow(gap, wraps=(True, True), repeats=True).sealed
    diagonal = np.zeros((12, 12))
    for i in range(12):
        diagonal[i, i] = diagonal[i, (i + 1) % 12] = 1.0
    found = clusters(diagonal > 0.0, (True, True))
    assert found.winds[:, 1].all()
    matrix = flow_tensor(diagonal, Grid((12, 12), (1.0, 1.0))).matrix
    # one channel along the diagonal lets fluid through along it only
    np.testing.assert_allclose(matrix, matrix[0, 0] * np.ones((2, 2)), rtol=1e-12)


def test_channel_that_winds_twice() -> None:
    gap = np.zeros((12, 12))
    for column in (2, 8):  # the two columns are one channel: each leads on to the other beyond the seam
        gap[:, column] = 1.0
    gap[0, :] = 0.0
    for column in range(2, 9):
        gap[11, column] = 0.0
    gap[11, 2] = gap[11, 8] = gap[0, 2] = gap[0, 8] = 1.0
    found = clusters(gap > 0.0, (True, True))
    assert found.winds[0, 1:].all()
    assert not found.winds[1].any()


def test_dead_ends_and_pools_change_nothing() -> None:
    gap = np.zeros((16, 16))
    gap[:, 3:6] = 1.0
    bare = flow(gap)
    gap[4:8, 6:9] = 0.5
    gap[10:12, 12:14] = 2.0
    assert flow(gap).rate > bare.rate  # the dead end widens the way a little
    assert not flow(gap).net.carrying[10, 12]
    pool = flow(np.where(np.arange(16)[None] >= 11, gap, np.where(np.arange(16)[None] < 6, gap, 0.0)))
    assert pool.rate == pytest.approx(bare.rate, rel=1e-12)


def test_checkerboard_is_the_geometric_mean() -> None:
    """Keller (1964) and Dykhne (1971); convergence at the corners is slow, with a power that the
    ratio sets."""
    ratio, errors = 1.5, []
    for n in (32, 64, 128):
        half = np.arange(n) < n // 2
        gap = np.where(half[:, None] ^ half[None], 1.0, ratio)
        errors.append(flow(gap, wraps=(True, True), repeats=True).transmissivity / ratio**1.5 - 1.0)
    assert abs(errors[2]) < abs(errors[1]) < abs(errors[0])
    assert abs(errors[2]) < 1e-2


def test_lognormal_gap_is_the_geometric_mean() -> None:
    """Dykhne (1971): the field and its reciprocal are alike, so K K' = 1 for each sample on
    average."""
    heights, spread = rough(128, waves=4.0), 0.3
    pair = [flow_tensor(np.exp(sign * spread * heights), Grid((128, 128), (1.0, 1.0))).matrix for sign in (1.0, -1.0)]
    # Keller: the tensor of the reciprocal field, turned by a right angle, is the inverse
    turned = np.array([[0.0, -1.0], [1.0, 0.0]])
    product = pair[0] @ (turned @ pair[1] @ turned.T)
    np.testing.assert_allclose(product, np.eye(2), atol=5e-3)


@pytest.mark.skipif(find_spec("pyamg") is None, reason="pyamg, of the extra flow, is not installed")
def test_multigrid_finds_the_same() -> None:
    gap = np.maximum(rough(96) + 0.8, 0.0)
    for options in ({"wraps": (False, True)}, {"wraps": (True, True), "repeats": True}):
        direct, multigrid = (flow(gap, method=method, **options) for method in ("direct", "multigrid"))
        assert multigrid.method == "multigrid"
        assert multigrid.rate == pytest.approx(direct.rate, rel=1e-9)
        assert multigrid.section_error < 1e-8


def test_multigrid_that_is_not_installed_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solver, "pyamg", None)
    with refused(InputError, "method for flow", "multigrid"):
        flow(np.ones((4, 4)), method="multigrid")


@pytest.mark.parametrize(
    ("made", "subject", "shown"),
    [
        (lambda: flow(-np.ones((4, 4))), "gap", "-1"),
        (lambda: flow(np.full((4, 4), np.nan)), "gap", "(4, 4)"),
        (lambda: flow(np.ones((1, 4))), "grid of a flow along x", "1"),
        (lambda: flow(np.ones((4, 4)), way="z"), "direction of flow", "z"),
        (lambda: flow(np.ones((4, 4)), repeats=True), "grid of a flow by a mean gradient", "x"),
        (lambda: flow_through(np.ones((4, 4)), Grid((4, 5), (1.0, 1.0))), "gap", "(4, 5)"),
    ],
)
def test_wrong_input(made: Callable[[], GapFlow], subject: str, shown: str) -> None:
    with refused(InputError, subject, shown):
        made()
