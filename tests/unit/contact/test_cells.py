"""Nested cells as a preconditioner: what they are built of, and how fast conjugate gradients converge with them."""

from __future__ import annotations

import numpy as np
import pytest

import asperity as asp
from asperity.contact.solvers.active_set import linear_system
from asperity.contact.solvers.active_set.bounds import free_set
from asperity.contact.solvers.active_set.linear_system import (
    CoarseCorrection,
    LinearSystem,
    NestedCells,
    RestrictedInverse,
    ScaledOperator,
    Stopping,
    coarse_correction,
    conjugate_gradients,
    hierarchies,
    pixel_compliance,
    preconditioner,
)
from asperity.core.arrays import RealArray
from asperity.core.engine import Engine, FreeSet, Hierarchy
from asperity.solids.compliance.halfspace import Compliance, HalfSpace

BODY = HalfSpace(2.0)
SHAPES = [(1, 1), (1, 64), (37, 1), (16, 16), (12, 50), (31, 17)]


def grid(shape: tuple[int, int], spacing: tuple[float, float] = (1.0, 1.0)) -> asp.Grid:
    return asp.Grid(shape, spacing)


def counts(shape: tuple[int, int], hierarchy: Hierarchy) -> list[tuple[int, int]]:
    """Numbers of cells along x and y, level by level."""
    found = [shape]
    for merge in hierarchy.merges:
        nx, ny = found[-1]
        found.append(
            (
                (nx - 1 + merge.offset_x) // 2 + 1 if merge.x else nx,
                (ny - 1 + merge.offset_y) // 2 + 1 if merge.y else ny,
            )
        )
    return found


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("periodic", [False, True])
def test_both_hierarchies_end_in_few_cells_and_share_their_weights(shape: tuple[int, int], periodic: bool) -> None:
    first, second = hierarchies(BODY, grid(shape), periodic=periodic, share=1.0)
    assert [(m.x, m.y, m.weight) for m in first.merges] == [(m.x, m.y, m.weight) for m in second.merges]
    for hierarchy in (first, second):
        assert max(counts(shape, hierarchy)[-1]) <= 2
        for merge in hierarchy.merges:
            assert merge.offset_x <= merge.x
            assert merge.offset_y <= merge.y
            assert merge.weight > 0.0 or shape == (1, 1)
    if periodic:
        assert first.merges == second.merges
        assert all(0 <= roll < n and (roll > 0 or n < 3) for roll, n in zip(second.roll, shape, strict=True))
    elif max(shape) > 2:
        assert [(m.offset_x, m.offset_y) for m in first.merges] != [(m.offset_x, m.offset_y) for m in second.merges]


def test_on_a_periodic_grid_the_hierarchies_lie_a_third_of_a_cell_apart() -> None:
    rolls = hierarchies(BODY, grid((1024, 96)), periodic=True, share=1.0)[1].roll
    for roll, n in zip(rolls, (1024, 96), strict=True):
        side = 4
        while side <= n:
            apart = roll % side / side
            assert abs(min(apart, 1.0 - apart) - 1.0 / 3.0) <= 1.0 / side
            side *= 2


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 3.0), (7.0, 1.0)])
def test_cells_are_as_square_as_the_pixels_allow(spacing: tuple[float, float]) -> None:
    sides = list(spacing)
    for merge in hierarchies(BODY, grid((256, 256), spacing), periodic=False, share=1.0)[0].merges:
        sides = [side * (2.0 if pairs else 1.0) for side, pairs in zip(sides, (merge.x, merge.y), strict=True)]
        if all(side < 256 * step for side, step in zip(sides, spacing, strict=True)):
            assert max(sides) / min(sides) <= max(2.0, max(spacing) / min(spacing))
            assert sides[0] / sides[1] < 2.0 * spacing[0] / spacing[1] or sides[0] <= 2.0 * sides[1]


def test_weights_are_the_energies_of_haar_functions() -> None:
    """Mean over the three Haar functions of a cell of side H under c = 2/(E' q), on a grid much larger than the cell."""
    n, side = 512, 16
    operator = asp.prepare_operator(BODY, grid((n, n)), asp.Periodic())
    energies = []
    for signs in ([[1, 1], [-1, -1]], [[1, -1], [1, -1]], [[1, -1], [-1, 1]]):
        field = np.zeros((n, n))
        field[: 2 * side, : 2 * side] = np.kron(signs, np.ones((side, side)))
        energies.append(float((field * operator.apply(field)).sum() / (field**2).sum()))
    model = float(BODY.spectral(np.array([np.pi / side]))[0])
    # pi / H instead of the mean is exact to one percent in the continuum; the grid resolves the cell to another
    assert np.mean(energies) == pytest.approx(model, rel=0.03)


def test_weights_add_up_to_the_compliance_at_the_wavelength_of_the_cell() -> None:
    spacing = (1e-7, 1e-7)
    merges = hierarchies(BODY, grid((64, 64), spacing), periodic=True, share=1.0)[0].merges
    own = pixel_compliance(BODY, grid((64, 64), spacing))
    assert own == pytest.approx(float(BODY.spectral(np.array([np.pi / 1e-7]))[0]))
    total, points = 1.0, 1
    for merge in merges:
        points *= 4
        total += merge.weight * points
        assert total == pytest.approx(np.sqrt(points))  # 1/q: a cell twice as large deflects twice as much


def rough_set(shape: tuple[int, int], share: float, seed: int) -> RealArray:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=shape[0] / 4, shortest_wavelength=8.0
    )
    heights = asp.generate.gaussian(grid(shape), spectrum, seed=seed).heights
    return np.where(heights > np.quantile(heights, 1.0 - share), 1.0, 0.0)


def on_set(
    inside: RealArray,
    compliance: Compliance = BODY,
    boundary: asp.Boundary | None = None,
    engine: Engine | None = None,
) -> tuple[ScaledOperator, FreeSet]:
    operator = asp.prepare_operator(compliance, grid(inside.shape), boundary or asp.Periodic(), engine=engine)
    scaled = ScaledOperator.of(operator, "float64", 1.0)
    zero = np.zeros(inside.shape)
    return scaled, free_set(operator.engine.survey(inside, zero, zero, None), 0.0, 1.0, "float64")


def steps_to(
    inside: RealArray, reduction: float, compliance: Compliance = BODY, boundary: asp.Boundary | None = None
) -> float:
    """FFT pairs of the grid to reduce the residual of a rough right side."""
    scaled, free = on_set(inside, compliance, boundary)
    r, _ = free.gather(np.random.default_rng(0).standard_normal(inside.shape).cumsum(axis=0))
    r -= r.mean()
    found = conjugate_gradients(LinearSystem(scaled, free, zero_sum=True), r, Stopping(reduction, 200))
    assert found.reached
    return found.pairs / scaled.operator.pairs_per_application


@pytest.mark.parametrize("share", [0.02, 0.1, 0.4, 0.9])
def test_the_steps_needed_hardly_depend_on_grid_and_area(share: float) -> None:
    """A factor 0.28 a step at worst: 1e-6 in 11 steps. Without a preconditioner the number grows with the grid, and with
    cells that end at the borders of the periodic grid with the area, to 19."""
    for n in (64, 128, 256):
        assert steps_to(rough_set((n, n), share, 3), 1e-6) <= 11.0


@pytest.mark.parametrize("shape", [(1, 500), (500, 1)])
def test_lines_and_other_boundaries_converge_as_well(shape: tuple[int, int]) -> None:
    inside = np.where(np.random.default_rng(1).uniform(size=shape) < 0.3, 1.0, 0.0)
    assert steps_to(inside, 1e-6) <= 30.0
    assert steps_to(rough_set((96, 80), 0.2, 5), 1e-6, boundary=asp.Free()) <= 30.0


def film(ratio: float, thickness: float = 4.0) -> Compliance:
    """Compliance of a film over that of its base."""
    layered = asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
    return asp.ContactProblem(asp.Surface(np.zeros((8, 8)), 1.0, 1.0, periodic=True), layered).compliance


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=["periodic", "free"])
@pytest.mark.parametrize(("ratio", "thickness"), [(0.1, 4.0), (2.0, 4.0), (10.0, 4.0), (10.0, 10.0)])
def test_layers_converge_as_well(ratio: float, thickness: float, boundary: asp.Boundary) -> None:
    """A factor 0.44 a step at worst, 1e-6 in 17 steps; a twentieth more pairs for the coarse correction."""
    assert steps_to(rough_set((128, 128), 0.2, 7), 1e-6, film(ratio, thickness), boundary) <= 17.0 * 1.06


def test_the_inverse_of_cells_is_symmetric_and_positive() -> None:
    rng = np.random.default_rng(2)
    inside = rough_set((48, 40), 0.3, 11)
    scaled, free = on_set(inside)
    cells = NestedCells(scaled, free)
    a, b = (free.gather(rng.standard_normal(inside.shape))[0] for _ in range(2))
    ab = cells.solve(b, a, free.zeros()).second
    ba = cells.solve(a, b, free.zeros()).second
    assert ab == pytest.approx(ba, rel=1e-12)
    assert cells.solve(a, a, free.zeros()).first > 0.0


def without_correction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(linear_system, "coarse_correction", lambda operator: None)


def test_the_coarse_correction_saves_pairs_on_stiff_films(monkeypatch: pytest.MonkeyPatch) -> None:
    """Surfaces with a tenth in contact took 17 to 19 pairs for 19 and 20, the cost of the correction included; here two together."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=128.0, shortest_wavelength=8.0
    )
    coated = asp.Layered([asp.Layer(asp.Elastic(10.0, 0.3), 20.0)], base=asp.Elastic(1.0, 0.3))
    solver, pairs = asp.solvers.ActiveSet(tolerance=1e-6), [0.0, 0.0]
    for number in range(2):
        if number:
            without_correction(monkeypatch)
        for seed in (1, 3):
            problem = asp.ContactProblem(asp.generate.gaussian(grid((512, 512)), spectrum, seed=seed), coated)
            pairs[number] += asp.solve(problem, asp.MeanPressure(0.4), solver=solver).certificate.fft_pairs
    assert pairs[0] < 0.95 * pairs[1]


def correction_on(
    shape: tuple[int, int], compliance: Compliance, spacing: tuple[float, float] = (1.0, 1.0)
) -> CoarseCorrection | None:
    boundary = asp.Periodic() if min(shape) > 1 else asp.FreeLine()
    return coarse_correction(asp.prepare_operator(compliance, grid(shape, spacing), boundary))


def test_the_coarse_correction_is_for_steep_compliances_on_grids_that_their_cells_divide() -> None:
    stiff = film(10.0)
    found = correction_on((64, 96), stiff)
    assert found is not None
    assert found.pairs == 4.0 / 64.0
    assert found.form.cells == found.form.padded == (8, 12)
    assert found.form.kernel.min() >= 0.0
    for gentle in (BODY, film(0.5), film(2.0)):
        assert correction_on((64, 96), gentle) is None
    for shape in ((65, 96), (64, 92), (24, 64), (512, 1)):
        assert correction_on(shape, stiff) is None
    assert correction_on((64, 64), stiff, (1.0, 3.0)) is None
    free = coarse_correction(asp.prepare_operator(stiff, grid((65, 90)), asp.Free()))
    assert free is not None
    assert free.form.cells == (9, 13)  # room for cells that begin up to seven points outside


def test_the_inverse_with_coarse_correction_is_nearly_symmetric_and_positive() -> None:
    """It is the same matrix for all loads but for the length of the inner step, which they decide: measured 2e-5."""
    rng = np.random.default_rng(2)
    inside = rough_set((64, 64), 0.3, 11)
    scaled, free = on_set(inside, film(10.0))
    cells = NestedCells(scaled, free)
    a, b = (free.gather(rng.standard_normal(inside.shape))[0] for _ in range(2))
    ab, aa = cells.solve(b, a, free.zeros()).second, cells.solve(a, a, free.zeros()).first
    ba, bb = cells.solve(a, b, free.zeros()).second, cells.solve(b, b, free.zeros()).first
    assert abs(ab - ba) < 1e-3 * np.sqrt(aa * bb)
    assert min(aa, bb) > 0.0


def test_the_coarse_correction_does_not_depend_on_the_number_of_threads() -> None:
    inside = rough_set((256, 256), 0.3, 5)
    r, found = np.random.default_rng(6).standard_normal(inside.shape), []
    for threads in (1, 2, 3):
        scaled, free = on_set(inside, film(10.0), engine=asp.CpuEngine(threads))
        picked, _ = free.gather(r)
        found.append(NestedCells(scaled, free).solve(picked, picked, free.zeros()).vector)
    assert np.array_equal(found[0], found[1])
    assert np.array_equal(found[0], found[2])


def test_full_contact_is_left_to_the_inverse_that_is_exact_there() -> None:
    scaled, free = on_set(np.ones((32, 32)))
    assert isinstance(preconditioner(scaled, free), RestrictedInverse)
    assert steps_to(np.ones((32, 32)), 1e-10) <= 4.0
    assert isinstance(preconditioner(*on_set(rough_set((32, 32), 0.5, 1))), NestedCells)
