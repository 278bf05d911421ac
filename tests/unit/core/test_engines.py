"""All engines do the same: pass by pass, and in whole solves."""

from __future__ import annotations

import functools
import importlib
import math
from dataclasses import dataclass, fields
from types import ModuleType, SimpleNamespace
from typing import Any

import array_api_strict
import numpy as np
import pytest
from contact_cases import elastic, rough
from refusals import refused

import asperity as asp
from asperity.contact.laws import InterfaceLaw
from asperity.contact.problem import Control
from asperity.contact.solvers.active_set.bounds import _PRIOR, entering_levels, free_set
from asperity.core.arrays import RealArray
from asperity.core.engine import SQUARE_SIDE, CoarseCompliance, Engine, Hierarchy, Load, Merge
from asperity.core.engine.cpu import SERIAL_BELOW

REFERENCE = asp.CpuEngine(1)
OTHERS: dict[str, Engine] = {
    "cpu with two threads": asp.CpuEngine(2),
    "numpy": asp.ArrayEngine(np),
    "array_api_strict": asp.ArrayEngine(array_api_strict),
    "second device": asp.ArrayEngine(array_api_strict, device=array_api_strict.Device("device1")),
}
SHAPES = [(1, 1), (1, 9), (7, 1), (5, 8), (12, 7), (33, 33)]
CAPS = ["none", "one", "map"]
EPS = {"float64": 2.3e-16, "float32": 1.2e-7}

every_engine = pytest.mark.parametrize("engine", OTHERS.values(), ids=list(OTHERS))
every_shape = pytest.mark.parametrize("shape", SHAPES, ids=str)
every_cap = pytest.mark.parametrize("cap", CAPS)
every_type = pytest.mark.parametrize("dtype", list(EPS))


@dataclass(frozen=True)
class Iterate:
    """Random iterate with points at zero, at the cap and between."""

    p: RealArray
    u: RealArray
    h: RealArray
    cap: RealArray | None
    level: float

    def on(self, engine: Engine) -> tuple[Any, Any, Any, Any]:
        cap = None if self.cap is None else engine.array(self.cap, "float64")
        return engine.array(self.p, "float64"), engine.array(self.u, "float64"), engine.array(self.h, "float64"), cap


def iterate(shape: tuple[int, int], cap: str, seed: int = 0) -> Iterate:
    rng = np.random.default_rng([seed, *shape, CAPS.index(cap)])
    p = np.maximum(rng.standard_normal(shape), 0.0)
    u, h = rng.standard_normal((2, *shape))
    caps = {"none": None, "one": np.ones(1), "map": rng.uniform(0.3, 1.5, p.size)}
    bound = caps[cap]
    if bound is not None:
        p = np.minimum(p, bound if bound.size == 1 else bound.reshape(shape))
    return Iterate(p, u, h, bound, 0.1)


def agree(found: Any, wanted: Any, size: int, dtype: str = "float64") -> None:
    """Equal to the rounding of ``size`` terms of order one."""
    np.testing.assert_allclose(found, wanted, rtol=20 * EPS[dtype], atol=20 * EPS[dtype] * size)


def values_of(record: object) -> list[float]:
    return [getattr(record, field.name) for field in fields(record)]  # type: ignore[arg-type]


@every_engine
def test_arrays_go_in_and_out(engine: Engine) -> None:
    values = np.arange(6.0).reshape(2, 3)
    for dtype in EPS:
        back = engine.numpy(engine.array(values, dtype))
        assert back.dtype == dtype
        assert np.array_equal(back, values)
        assert np.array_equal(engine.numpy(engine.zeros((2, 3), dtype)), np.zeros((2, 3)))
    assert engine.numpy(engine.array(2.5, "float64")).sum() == 2.5


@every_engine
@every_shape
@every_type
def test_periodic_convolutions_agree(engine: Engine, shape: tuple[int, int], dtype: str) -> None:
    rng = np.random.default_rng(shape)
    kernel = rng.uniform(0.5, 2.0, (shape[0], shape[1] // 2 + 1))
    kernel[:, 0] = 1.0
    kernel[:, -1] = 1.0  # real fields: these columns are even
    for mean_mode in (0.0, 1.0):
        kernel[0, 0] = mean_mode
        field = rng.standard_normal(shape)
        for method in ("apply", "solve"):
            found, wanted = (
                convolved(e, e.convolution(kernel, shape, dtype), method, field, dtype) for e in (engine, REFERENCE)
            )
            assert found.dtype == dtype
            agree(found, wanted, 3, dtype)


@every_engine
@every_shape
@every_type
def test_free_convolutions_agree(engine: Engine, shape: tuple[int, int], dtype: str) -> None:
    padded = 2 * shape[0] + 1, 2 * shape[1]
    rng = np.random.default_rng(shape)
    point = np.zeros(padded)
    point[0, 0], point[1, 0], point[-1, 0] = 2.0, 0.5, 0.5
    kernel = np.fft.rfft2(point).real
    field = rng.standard_normal(shape)
    for method in ("apply", "solve"):
        found, wanted = (
            convolved(e, e.padded_convolution(kernel, shape, padded, dtype), method, field, dtype)
            for e in (engine, REFERENCE)
        )
        agree(found, wanted, 3, dtype)
    direct = 2.0 * field
    direct[1:] += 0.5 * field[:-1]
    direct[:-1] += 0.5 * field[1:]
    applied = convolved(engine, engine.padded_convolution(kernel, shape, padded, dtype), "apply", field, dtype)
    agree(applied, direct, 3, dtype)


def convolved(engine: Engine, convolution: Any, method: str, field: RealArray, dtype: str) -> RealArray:
    out = engine.zeros((field.shape[0], field.shape[1]), dtype)
    returned = getattr(convolution, method)(engine.array(field, dtype), out)
    assert np.array_equal(engine.numpy(returned), engine.numpy(out)), "the result is in the array that was given"
    return engine.numpy(out)


@every_engine
@every_shape
@every_cap
def test_totals_agree(engine: Engine, shape: tuple[int, int], cap: str) -> None:
    case = iterate(shape, cap)
    found, wanted = (values_of(e.survey(*case.on(e)).totals) for e in (engine, REFERENCE))
    agree(found, wanted, case.p.size)


@every_engine
@every_cap
@pytest.mark.parametrize("everywhere", ["zero", "between", "full"])
def test_totals_of_empty_selections(engine: Engine, cap: str, everywhere: str) -> None:
    case = iterate((5, 8), cap)
    bound = np.full(case.p.shape, 1.0) if case.cap is None else np.broadcast_to(case.cap, case.p.size).reshape(5, 8)
    p = {"zero": 0.0 * bound, "between": 0.5 * bound, "full": bound.copy()}[everywhere]
    case = Iterate(p, case.u, case.h, case.cap, case.level)
    found, wanted = (e.survey(*case.on(e)).totals for e in (engine, REFERENCE))
    agree(values_of(found), values_of(wanted), p.size)
    assert (found.lowest_open == math.inf) == (everywhere != "zero" and cap != "none")
    assert (found.highest_capped == -math.inf) == (everywhere != "full" or cap == "none")


@every_engine
@every_shape
@every_cap
def test_violations_agree(engine: Engine, shape: tuple[int, int], cap: str) -> None:
    case = iterate(shape, cap)
    found, wanted = (e.violation(*case.on(e), case.level) for e in (engine, REFERENCE))
    agree(values_of(found), values_of(wanted), case.p.size)


@every_engine
@every_shape
@every_cap
@every_type
@pytest.mark.parametrize("centred", [False, True])
def test_passes_over_a_free_set_agree(
    engine: Engine, shape: tuple[int, int], cap: str, dtype: str, centred: bool
) -> None:
    case = iterate(shape, cap)
    found, wanted = (work_on_free_set(e, case, dtype, centred) for e in (engine, REFERENCE))
    assert found.size == wanted.size
    assert found.entering == wanted.entering
    assert found.clipped == wanted.clipped
    for name in (
        "residual",
        "gathered",
        "direction",
        "advanced",
        "sums",
        "moved",
        "loads",
        "blended",
        "changed",
    ):
        agree(getattr(found, name), getattr(wanted, name), case.p.size, dtype)
    assert not found.released.any()


def work_on_free_set(engine: Engine, case: Iterate, dtype: str, centred: bool) -> SimpleNamespace:
    """One conjugate gradient step with made-up numbers, a step of the pressure, and what is seen at each stage."""
    rng = np.random.default_rng(3)
    response = engine.array(rng.standard_normal(case.p.shape), dtype)
    p, u, h, cap = case.on(engine)
    p = engine.array(case.p.copy(), "float64")
    field = engine.zeros((case.p.shape[0], case.p.shape[1]), dtype)
    free = free_set(engine.survey(p, u, h, cap), case.level, 2.5, dtype)

    def scattered(vector: Any) -> RealArray:
        free.scatter(vector, field)
        return engine.numpy(field).copy()

    r = free.residual(centred=centred and free.size > 0)
    seen = SimpleNamespace(size=free.size, entering=free.entering, residual=scattered(r))
    z, *first = free.gather_products(response, r, r, free.zeros())
    seen.gathered = scattered(z)
    t, product = free.update_direction(z, 0.25, 0.0, free.zeros(), r, field)
    t, second = free.update_direction(z, 0.25, 0.5, t, r, field)
    seen.direction = engine.numpy(field).copy()
    kt, *third = free.gather_products(response, t, r, free.zeros())
    d, r, _ = free.update_solution(0.7, t, kt, 0.125, free.zeros(), r)
    d, r, left = free.update_solution(0.3, t, kt, 0.125, d, r)
    assert left == pytest.approx(free.square(r), rel=1e-6 if dtype == "float32" else 1e-14)
    seen.advanced = [scattered(d), scattered(r)]
    seen.sums = [*first, product, second, *third]
    old, total = free.gather(p)
    found, seen.clipped = free.add_clipped(p, d, 0.8, cap)
    seen.moved = engine.numpy(p).copy()
    raised = free.rescale(p, 1.25, 0.125, cap)
    seen.loads = [total, *values_of(found), *values_of(raised)]
    free.interpolate(old, 0.25, p)
    seen.blended = engine.numpy(p).copy()
    change, product = free.scatter_change(old, p, r, field)
    seen.changed = [engine.numpy(field).copy(), scattered(change)]
    seen.sums.append(product)
    engine.clear_field(free, field)
    seen.released = engine.numpy(field)
    return seen


@every_cap
def test_a_clipped_step_is_what_it_says(cap: str) -> None:
    case = iterate((12, 7), cap)
    bound = np.inf if case.cap is None else case.cap if case.cap.size == 1 else case.cap.reshape(12, 7)
    _, u, h, flat = case.on(REFERENCE)
    q = case.p.copy()
    free = free_set(REFERENCE.survey(q, u, h, flat), case.level, 1.0, "float64")
    r = free.residual(centred=False)
    field = np.zeros((12, 7))
    free.scatter(r, field)
    inside = field != 0.0
    old, total = free.gather(q)
    assert total == pytest.approx(case.p[inside].sum())
    unclipped = case.p + 3.0 * field
    found, clipped = free.add_clipped(q, r, 3.0, flat)
    wanted = np.where(inside, np.clip(unclipped, 0.0, bound), case.p)
    np.testing.assert_allclose(q, wanted, atol=1e-15)
    below = inside & (wanted < bound)
    assert clipped == np.count_nonzero(inside & ((unclipped < 0.0) | (unclipped > bound)))
    assert found == Load(pytest.approx(wanted[inside].sum()), pytest.approx(wanted[below].sum()), below.sum())
    change, product = free.scatter_change(old, q, r, field)
    np.testing.assert_allclose(field, wanted - case.p, atol=1e-15)
    assert product == pytest.approx(((wanted - case.p) * -(case.u - case.h - case.level)).sum())
    np.testing.assert_array_equal(change, field[inside])
    free.rescale(q, 2.0, 0.5, flat)
    np.testing.assert_allclose(q, np.where(below, np.minimum(2.0 * wanted + 0.5, bound), wanted), atol=1e-15)


@every_engine
@every_type
def test_tensile_points_are_counted_and_cleared(engine: Engine, dtype: str) -> None:
    case, shape = iterate((12, 7), "none"), (12, 7)
    _, u, h, _ = case.on(engine)
    p = engine.array(case.p.copy(), "float64")
    free = free_set(engine.survey(p, u, h, None), case.level, 1.0, dtype)
    field = engine.zeros(shape, dtype)
    free.scatter(free.residual(centred=False), field)
    step = engine.numpy(field).astype(float)
    tensile, tension, pressure = free.add_unclipped(p, free.residual(centred=False), 3.0)
    wanted = case.p + 3.0 * step
    np.testing.assert_allclose(engine.numpy(p), wanted, atol=1e-15)
    assert tensile == np.count_nonzero(wanted < 0.0) > 0
    assert tension == pytest.approx(-wanted[wanted < 0.0].sum())
    assert pressure == pytest.approx(wanted[(wanted > 0.0) & (step != 0.0)].sum())
    # they count as unloaded, but do not enter
    survey = engine.survey(p, u, h, None)
    assert survey.totals.pressure == pytest.approx(np.maximum(wanted, 0.0).sum())
    assert survey.totals.work == pytest.approx((np.maximum(wanted, 0.0) * (case.u - case.h)).sum())
    violation = engine.violation(p, u, h, None, case.level)
    gap = case.u - case.h - case.level
    assert violation.above == pytest.approx((np.maximum(wanted, 0.0) * np.maximum(gap, 0.0)).sum())
    following = free_set(survey, 1e3, 1.0, dtype)  # a level at which all that may enter does
    assert following.size == wanted.size - tensile
    # what is added to a field is the change
    change = free.clear_tension(p, 1.25, 1.5)
    pressed = np.where(step != 0.0, 1.25 * np.maximum(wanted, 0.0), wanted)
    np.testing.assert_allclose(engine.numpy(p), pressed, atol=1e-15)
    free.scatter_add(change, 0.5, field)
    rounding = 1e-14 if dtype == "float64" else 4.0 * EPS[dtype] * np.abs(step).max()
    np.testing.assert_allclose(engine.numpy(field), step + (pressed - wanted) / 3.0, atol=rounding)


@every_engine
@every_cap
def test_members_of_a_free_set(engine: Engine, cap: str) -> None:
    case = iterate((12, 7), cap)
    bound = np.inf if case.cap is None else case.cap if case.cap.size == 1 else case.cap.reshape(12, 7)
    gap = case.u - case.h - case.level
    movable = (case.p > 0.0) & (case.p < bound)
    points = movable.sum() + _PRIOR  # of one square, with those of the wider ones, which are empty
    apart = gap - gap[movable].sum() / points
    margin = 0.5 * np.sqrt((apart[movable] ** 2).sum() / points)
    entering = ((case.p <= 0.0) & (apart < -margin)) | ((case.p > 0.0) & (case.p >= bound) & (apart > margin))
    inside = entering | movable
    field = engine.zeros((12, 7), "float64")
    free = free_set(engine.survey(*case.on(engine)), case.level, 2.0, "float64")
    free.scatter(free.residual(centred=False), field)
    assert (free.size, free.entering) == (inside.sum(), entering.sum())
    agree(engine.numpy(field), np.where(inside, -gap / 2.0, 0.0), 1)


@every_engine
def test_points_enter_that_stand_out_of_the_scatter_of_the_loaded_ones(engine: Engine) -> None:
    """Half of the scatter; 4 of 132 points of the prior, which is the same here and empty above, weaken it by 2 %."""
    rng = np.random.default_rng(9)
    shape, scatter, base = (2 * SQUARE_SIDE, SQUARE_SIDE), 0.02, 30.0
    loaded = np.indices(shape).sum(axis=0) % 2 == 0
    apart = rng.uniform(-0.05, 0.05, shape)
    residual = np.where(loaded, scatter * (-1.0) ** (np.indices(shape)[0] // 2), apart)
    arrays = [engine.array(values, "float64") for values in (loaded.astype(float), base + residual, np.zeros(shape))]
    free = free_set(engine.survey(*arrays, None), base, 1.0, "float64")
    field = engine.zeros(shape, "float64")
    free.scatter(free.gather(engine.array(np.ones(shape), "float64"))[0], field)
    entered = (engine.numpy(field) > 0.0) & ~loaded
    sure = ~loaded & (np.abs(apart + 0.5 * scatter) > 0.02 * scatter)
    np.testing.assert_array_equal(entered[sure], (apart < -0.5 * scatter)[sure])
    assert free.entering == entered.sum()


@every_engine
def test_points_enter_by_the_level_of_their_neighbourhood(engine: Engine) -> None:
    """A region whose loaded points all stand too high or low by one amount takes in the points that fit that amount."""
    rng = np.random.default_rng(8)
    shape = (3 * SQUARE_SIDE, 2 * SQUARE_SIDE + 5)
    offset = np.kron(
        np.array([[0.0, 0.8, -0.4], [0.2, -1.0, 0.6], [-0.6, 0.4, 0.1]]), np.ones((SQUARE_SIDE, SQUARE_SIDE))
    )
    offset = offset[: shape[0], : shape[1]]
    loaded = rng.uniform(size=shape) < 0.5
    apart = rng.uniform(-1.0, 1.0, shape)
    u = np.where(loaded, 0.0, apart) + offset
    arrays = [engine.array(values, "float64") for values in (loaded.astype(float), u, np.zeros(shape))]
    free = free_set(engine.survey(*arrays, None), 0.0, 1.0, "float64")
    field = engine.zeros(shape, "float64")
    free.scatter(free.copy(free.gather(engine.array(np.ones(shape), "float64"))[0]), field)
    entered = (engine.numpy(field) > 0.0) & ~loaded
    # four points of a wider square, at most 1.8 off, count beside the loaded ones: half of 16 x 5 in the last columns
    sure = np.abs(apart) > 0.25
    np.testing.assert_array_equal(entered[sure & ~loaded], (apart < 0.0)[sure & ~loaded])
    assert free.entering == entered.sum()


def means_of(count: RealArray, total: RealArray) -> RealArray:
    """Mean of each square, by the definition: the next wider one counts as so many points."""
    if count.size == 1:
        return total / (count + _PRIOR)
    nx, ny = count.shape
    wide = [np.add.reduceat(np.add.reduceat(v, range(0, nx, 2), 0), range(0, ny, 2), 1) for v in (count, total)]
    above = np.kron(means_of(*wide), np.ones((2, 2)))[:nx, :ny]
    return (total + _PRIOR * above) / (count + _PRIOR)


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (6, 1), (5, 3), (8, 16), (33, 17)])
def test_levels_of_a_square_are_mean_and_scatter_with_wider_ones(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(4)
    values, level = rng.normal(3.0, 0.5, (*shape, 20)), 2.7
    count = rng.integers(0, 20, shape).astype(float)
    values[np.arange(20) >= count[..., None]] = 0.0
    squares = np.stack([count, values.sum(axis=-1), (values**2).sum(axis=-1)], axis=-1)
    mean = level + means_of(count, squares[..., 1] - level * count)
    apart = np.where(np.arange(20) < count[..., None], values - mean[..., None], 0.0)
    margin = 0.5 * np.sqrt(means_of(count, (apart**2).sum(axis=-1)))
    expected = np.stack([mean - margin, mean + margin], axis=-1)
    np.testing.assert_allclose(entering_levels(squares, level), expected, rtol=0.0, atol=1e-12)


def test_without_points_between_the_bounds_levels_are_those_of_the_plane() -> None:
    np.testing.assert_array_equal(entering_levels(np.zeros((4, 7, 3)), 0.3), np.full((4, 7, 2), 0.3))


@every_engine
@every_type
def test_an_empty_free_set(engine: Engine, dtype: str) -> None:
    p, u, h = (engine.array(values, "float64") for values in (np.zeros((3, 4)), np.ones((3, 4)), np.zeros((3, 4))))
    field = engine.zeros((3, 4), dtype)
    free = free_set(engine.survey(p, u, h, None), 0.5, 1.0, dtype)
    r = free.residual(centred=False)
    assert (free.size, free.entering) == (0, 0)
    _, *sums = free.gather_products(engine.array(np.ones((3, 4)), dtype), r, r, free.zeros())
    assert sums == [0.0, 0.0, 0.0]
    assert free.add_clipped(p, free.zeros(), 1.0, None) == (Load(0.0, 0.0, 0), 0)
    cells = engine.cells((3, 4), (HIERARCHY, SHIFTED), None, dtype)
    cells.factorise(free)
    assert list(cells.solve(free, r, r, free.zeros())[1:]) == [0.0, 0.0, 0.0]
    engine.clear_field(free, field)
    assert not engine.numpy(field).any()
    assert not engine.numpy(p).any()


@every_engine
@every_shape
@every_type
def test_fields_are_added(engine: Engine, shape: tuple[int, int], dtype: str) -> None:
    given, values = np.random.default_rng(shape).standard_normal((2, *shape))
    field, out = engine.field(shape, dtype), engine.array(values.copy(), "float64")
    field[...] = engine.array(given, dtype)
    engine.add(field, 0.5, out)
    agree(engine.numpy(out), values + 0.5 * given, 1, dtype)


@every_engine
@every_shape
def test_pressures_are_refined(engine: Engine, shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(shape)
    half = -(-shape[0] // 2), -(-shape[1] // 2)
    coarse, base = np.maximum(rng.standard_normal(half), 0.0), rng.standard_normal(half)
    heights = rng.standard_normal(shape)
    fine = engine.prolonged(coarse, base, heights, 0.3)
    for (i, j), value in np.ndenumerate(fine):
        p = coarse[i // 2, j // 2]
        assert value == pytest.approx(max(0.0, p + 0.3 * (heights[i, j] - base[i // 2, j // 2])) if p > 0.0 else 0.0)


HIERARCHY = Hierarchy(tuple(Merge(True, True, 0, 1, 0.5) for _ in range(4)))
SHIFTED = Hierarchy(tuple(Merge(True, level % 2 == 0, level % 2, int(level % 2 == 0), 0.5) for level in range(4)))
PLAIN = tuple(Merge(True, True, 0, 0, 0.5) for _ in range(4))


def rolled(shape: tuple[int, int]) -> Hierarchy:
    """Cells that reach over the borders."""
    return Hierarchy(PLAIN, (min(5, shape[0] - 1), min(3, shape[1] - 1)))


def cells_matrix(shape: tuple[int, int], hierarchy: Hierarchy) -> RealArray:
    """1 + sum over cells of w 1 1^T, from the places of the points alone."""
    x, y = ((axis.ravel() + roll) % n for axis, roll, n in zip(np.indices(shape), hierarchy.roll, shape, strict=True))
    matrix = np.eye(x.size)
    for merge in hierarchy.merges:
        x = (x + merge.offset_x) // 2 if merge.x else x
        y = (y + merge.offset_y) // 2 if merge.y else y
        matrix += merge.weight * ((x[:, None] == x) & (y[:, None] == y))
    return matrix


@pytest.mark.parametrize("engine", [REFERENCE, *OTHERS.values()], ids=["cpu", *OTHERS])
@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (7, 1), (5, 8), (12, 7), (16, 16), (12, 90)], ids=str)
@pytest.mark.parametrize("wraps", [False, True], ids=["", "round"])
@every_type
def test_nested_cells_are_inverted_exactly(engine: Engine, shape: tuple[int, int], dtype: str, wraps: bool) -> None:
    rng = np.random.default_rng(shape)
    hierarchies = (HIERARCHY, rolled(shape) if wraps else SHIFTED)
    cells = engine.cells(shape, hierarchies, None, dtype)
    for share in (0.2, 0.6, 0.03, 1.0, 0.02, 0.04):  # the same buffers for one set after the other, sparse and crowded
        inside = rng.uniform(size=shape) < share
        p, h = np.where(inside, 1.0, 0.0), rng.standard_normal(shape)
        arrays = (engine.array(values, "float64") for values in (p, np.where(inside, 0.0, 100.0), h))
        free = free_set(engine.survey(*arrays, None), -10.0, 1.0, dtype)
        assert free.entering == 0
        cells.factorise(free)
        r = free.residual(centred=False)
        z, total, first, second = cells.solve(free, r, r, free.zeros())
        field = engine.zeros(shape, dtype)
        free.scatter(r, field)
        load = engine.numpy(field).astype(float)[inside]
        free.scatter(z, field)
        found = engine.numpy(field).astype(float)
        chosen = np.ix_(inside.ravel(), inside.ravel())
        inverses = [np.linalg.inv(cells_matrix(shape, hierarchy)[chosen]) for hierarchy in hierarchies]
        wanted = np.mean([inverse @ load for inverse in inverses], axis=0) if load.size else load
        tolerance = 100.0 * EPS[dtype] * (1.0 + np.abs(load).sum())
        np.testing.assert_allclose(found[inside], wanted, atol=tolerance)
        assert not found[~inside].any()
        assert total == pytest.approx(wanted.sum(), abs=tolerance * load.size)
        assert first == second == pytest.approx(wanted @ load, abs=tolerance * load.size)


@pytest.mark.parametrize("engine", [REFERENCE, *OTHERS.values()], ids=["cpu", *OTHERS])
@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (7, 1), (5, 8), (12, 7), (16, 16), (12, 90)], ids=str)
@pytest.mark.parametrize("shares", [(0.4, 0.7), (0.02, 0.03)], ids=["crowded", "sparse"])
@every_type
def test_nested_cells_deflect_under_a_change_elsewhere(
    engine: Engine, shape: tuple[int, int], shares: tuple[float, float], dtype: str
) -> None:
    """Whatever they were prepared for before. Points that change and are watched both deflect by their cells alone."""
    rng = np.random.default_rng(shape)
    hierarchies = (HIERARCHY, SHIFTED)
    cells = engine.cells(shape, hierarchies, None, dtype)
    masks = [rng.uniform(size=shape) < share for share in shares]
    heights = (rng.standard_normal(shape) for _ in masks)
    iterates = ((np.where(m, 1.0, 0.0), np.where(m, 0.0, 100.0), h) for m, h in zip(masks, heights, strict=True))
    changed, watched = (
        free_set(engine.survey(*(engine.array(v, "float64") for v in fields), None), -1e3, 1.0, dtype)
        for fields in iterates
    )
    load, r = changed.residual(centred=False), watched.residual(centred=False)
    cells.factorise(watched)
    cells.solve(watched, r, r, watched.zeros())
    field = engine.zeros(shape, dtype)

    def scattered(free: Any, vector: Any) -> RealArray:
        engine.clear_field(changed, field)
        engine.clear_field(watched, field)
        free.scatter(vector, field)
        return engine.numpy(field).astype(float).ravel()

    model = np.mean([cells_matrix(shape, hierarchy) for hierarchy in hierarchies], axis=0) - np.eye(field.size)
    given = scattered(changed, load)
    wanted = np.where(masks[1].ravel(), scattered(watched, r) - 0.3 * (model @ given), 0.0)
    found = scattered(watched, cells.predicted_residual(watched, r, changed, load, 0.3))
    np.testing.assert_allclose(found, wanted, atol=100.0 * EPS[dtype] * (1.0 + np.abs(given).sum()))


def corrected_hierarchies(periodic: bool) -> tuple[Hierarchy, Hierarchy]:
    """Cells of weights that fall off from level to level, until few are left."""
    weights = (0.4, 0.15, 0.05, 0.02, 0.01)
    if periodic:
        merges = tuple(Merge(True, True, 0, 0, weight) for weight in weights)
        return Hierarchy(merges), Hierarchy(merges, (5, 3))
    first, second = (
        tuple(Merge(True, True, (k + one) % 2, (k + one + 1) % 2, weight) for k, weight in enumerate(weights))
        for one in (0, 1)
    )
    return Hierarchy(first), Hierarchy(second)


def coarse_on(shape: tuple[int, int], periodic: bool) -> CoarseCompliance:
    """Convolution on cells of 4 x 4 points, from positive coefficients that fall off with distance."""
    nx, ny = (n // 4 if periodic else n // 4 + 1 for n in shape)
    padded = (nx, ny) if periodic else (2 * nx - 1, 2 * ny)
    x, y = (np.minimum(np.arange(n), n - np.arange(n)) for n in padded)
    response = 0.1 * np.exp(-0.8 * np.hypot(x[:, None], y[None, :]))
    kernel = np.fft.rfft2(response).real
    assert kernel.min() > 0.0
    return CoarseCompliance(2, kernel, (nx, ny), padded)


def places(shape: tuple[int, int], hierarchy: Hierarchy, depth: int) -> tuple[Any, Any]:
    """Cell of the level along x and y of every point."""
    x, y = ((axis.ravel() + roll) % n for axis, roll, n in zip(np.indices(shape), hierarchy.roll, shape, strict=True))
    for merge in hierarchy.merges[:depth]:
        x, y = (x + merge.offset_x) // 2, (y + merge.offset_y) // 2
    return x, y


def one_step(
    shape: tuple[int, int], hierarchy: Hierarchy, coarse: CoarseCompliance, inside: RealArray, r: RealArray
) -> RealArray:
    """One step of conjugate gradients from the answer of nested cells, for the loads f on cells, by dense matrices."""
    low = cells_matrix(shape, Hierarchy(hierarchy.merges[: coarse.depth - 1], hierarchy.roll))[np.ix_(inside, inside)]
    x, y = (axis[inside] for axis in places(shape, hierarchy, coarse.depth))
    cell, inverse = np.unique(x * coarse.cells[1] + y, return_inverse=True)
    member = np.zeros((x.size, cell.size))
    member[np.arange(x.size), inverse] = 1.0
    cx, cy = np.divmod(cell, coarse.cells[1])
    response = np.fft.irfft2(coarse.kernel, s=coarse.padded)
    a = response[np.subtract.outer(cx, cx) % coarse.padded[0], np.subtract.outer(cy, cy) % coarse.padded[1]]
    model = np.zeros_like(a)
    for number, merge in enumerate(hierarchy.merges[coarse.depth - 1 :]):
        if number:
            cx, cy = (cx + merge.offset_x) // 2, (cy + merge.offset_y) // 2
        model += merge.weight * ((cx[:, None] == cx) & (cy[:, None] == cy))
    below = np.linalg.inv(low)
    passed, unit = member.T @ below @ r, np.diag(member.T @ below @ member)
    nested = np.linalg.inv(np.diag(1.0 / unit) + model)
    f = nested @ (passed / unit)
    residual = passed / unit - f / unit - a @ f
    t = nested @ residual
    f = f + (t @ residual) / (t @ (t / unit + a @ t)) * t
    return np.asarray(below @ (r - member @ ((passed - f) / unit)))


@pytest.mark.parametrize("engine", [REFERENCE, *OTHERS.values()], ids=["cpu", *OTHERS])
@pytest.mark.parametrize("shape", [(16, 16), (24, 32)], ids=str)
@pytest.mark.parametrize("periodic", [True, False], ids=["round", "free"])
@every_type
def test_coarse_corrected_cells_take_one_step_of_conjugate_gradients(
    engine: Engine, shape: tuple[int, int], periodic: bool, dtype: str
) -> None:
    rng = np.random.default_rng(shape)
    hierarchies, coarse = corrected_hierarchies(periodic), coarse_on(shape, periodic)
    cells = engine.cells(shape, hierarchies, coarse, dtype)
    for share in (0.1, 0.6, 1.0):
        inside = rng.uniform(size=shape) < share
        p, h = np.where(inside, 1.0, 0.0), rng.standard_normal(shape)
        arrays = (engine.array(values, "float64") for values in (p, np.where(inside, 0.0, 100.0), h))
        free = free_set(engine.survey(*arrays, None), -10.0, 1.0, dtype)
        cells.factorise(free)
        r = free.residual(centred=False)
        z, total, first, _ = cells.solve(free, r, r, free.zeros())
        field = engine.zeros(shape, dtype)
        free.scatter(r, field)
        load = engine.numpy(field).astype(float)[inside]
        free.scatter(z, field)
        found = engine.numpy(field).astype(float)
        chosen = inside.ravel()
        wanted = np.mean([one_step(shape, hierarchy, coarse, chosen, load) for hierarchy in hierarchies], axis=0)
        tolerance = 100.0 * EPS[dtype] * (1.0 + np.abs(load).sum())
        np.testing.assert_allclose(found[inside], wanted, atol=tolerance)
        assert not found[~inside].any()
        assert total == pytest.approx(wanted.sum(), abs=tolerance * load.size)
        assert first == pytest.approx(wanted @ load, abs=tolerance * load.size)


@pytest.mark.parametrize("engine", [REFERENCE, *OTHERS.values()], ids=["cpu", *OTHERS])
def test_a_coarse_compliance_of_nested_cells_is_inverted_exactly(engine: Engine) -> None:
    """Constants over cells of the level and over the whole grid: the guess is the answer, and the step is none."""
    shape, own, everywhere = (16, 16), 0.05, 0.003
    merges = tuple(Merge(True, True, 0, 0, weight) for weight in (0.4, own, 0.0, everywhere))
    hierarchies = Hierarchy(merges), Hierarchy(merges, (5, 3))
    kernel = np.full((4, 3), own)
    kernel[0, 0] += everywhere * 16
    rng = np.random.default_rng(3)
    inside = rng.uniform(size=shape) < 0.4
    arrays = (engine.array(np.where(inside, *pair), "float64") for pair in ((1.0, 0.0), (0.0, 100.0)))
    survey = engine.survey(*arrays, engine.array(rng.standard_normal(shape), "float64"), None)
    free = free_set(survey, 0.0, 1.0, "float64")
    r, found = free.residual(centred=False), []
    for coarse in (None, CoarseCompliance(2, kernel, (4, 4), (4, 4))):
        cells = engine.cells(shape, hierarchies, coarse, "float64")
        cells.factorise(free)
        field = engine.zeros(shape, "float64")
        free.scatter(cells.solve(free, r, r, free.zeros()).vector, field)
        found.append(engine.numpy(field))
    np.testing.assert_allclose(found[1], found[0], atol=1e-13 * np.abs(found[0]).max())


@every_cap
def test_passes_do_not_depend_on_the_number_of_threads(cap: str) -> None:
    case = iterate((700, 701), cap)  # enough for three threads, on the free too
    one, three = asp.CpuEngine(1), asp.CpuEngine(3)
    first, second = (values_of(e.survey(*case.on(e)).totals) for e in (one, three))
    assert first == second
    if cap != "none":
        first, second = (values_of(e.violation(*case.on(e), case.level)) for e in (one, three))
        assert first == second
    first, second = (work_on_free_set(e, case, "float32", centred=True) for e in (one, three))
    assert first.size > SERIAL_BELOW
    for name in vars(first):
        assert np.array_equal(getattr(first, name), getattr(second, name)), name


def test_an_engine_has_a_name() -> None:
    assert asp.ArrayEngine(np).name == "numpy (cpu)"
    assert asp.ArrayEngine(array_api_strict).name.startswith("array_api_strict (")
    assert asp.CpuEngine(2).name.endswith("2 threads)")


def test_what_is_no_array_library_is_refused() -> None:
    with refused(asp.InputError, "namespace of ArrayEngine"):
        asp.ArrayEngine("cupy")


def test_libraries_without_transforms_or_writable_arrays_are_refused() -> None:
    class Frozen:
        def __array_namespace__(self, api_version: str | None = None) -> Any:
            return bare

        def __setitem__(self, key: object, value: object) -> None:
            raise TypeError

    bare: Any = ModuleType("bare")
    bare.zeros = lambda n: Frozen()
    with refused(asp.InputError, "namespace of ArrayEngine"):
        asp.ArrayEngine(bare)
    bare.fft = ModuleType("fft")
    with refused(asp.InputError, "namespace of ArrayEngine"):
        asp.ArrayEngine(bare)


TOLERANCE = 1e-9
MODULUS = 100.0
LOADS: dict[str, Control] = {"load": asp.MeanPressure(8.0), "approach": asp.Approach(2.0)}
LAWS: dict[str, InterfaceLaw] = {"elastic": asp.HardWall(), "hardness": asp.Hardness(60.0)}
BOUNDARIES = {"periodic": asp.Periodic(), "free": asp.Free()}


@pytest.mark.parametrize(
    ("engine", "precision"),
    [
        pytest.param(engine, precision, id=f"{name}-{precision}")
        for name, engine in OTHERS.items()
        for precision in ("mixed", "double")
        if (name, precision) != ("second device", "double")  # where arrays lie does not depend on their type
    ],
)
@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("control", LOADS)
def test_solutions_agree(engine: Engine, boundary: str, law: str, control: str, precision: str) -> None:
    """(p - q)·K (p - q) <= G(p) + G(q), the duality gaps, each at most tolerance x total pressure x rms height.

    That bounds single points by the smallest eigenvalue of K: contact may differ only where the pressure is below it.
    """
    found = solution(engine, boundary, law, control, precision)
    wanted = reference_solution(boundary, law, control, precision)
    p, q, problem = found.pressure, wanted.pressure, wanted.problem
    operator = asp.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    bound = 2.0 * TOLERANCE * problem.profile().std() * max(p.sum(), q.sum())
    assert ((p - q) * operator.apply(p - q)).sum() <= bound
    eigenvalues = operator.kernel.ravel()[1 if operator.zero_mean_mode else 0 :]
    assert eigenvalues.min() > 0.0
    differ = (p > 0.0) != (q > 0.0)
    assert np.all(np.maximum(p, q)[differ] <= np.sqrt(bound / eigenvalues.min()))
    assert found.area_fraction == pytest.approx(wanted.area_fraction, abs=differ.mean() + 1e-15)
    assert np.abs(p - q).max() <= 1e-7 * q.max(), "in truth they follow the same path, to rounding"


def solution(engine: Engine, boundary: str, law: str, control: str, precision: Any) -> asp.ContactResult:
    surface = rough((65, 70), seed=5, spacing=(0.3, 0.25))
    problem = asp.ContactProblem(surface, elastic(MODULUS), boundary=BOUNDARIES[boundary], law=LAWS[law])
    solver = asp.solvers.ActiveSet(tolerance=TOLERANCE, precision=precision)
    return asp.solve(problem, LOADS[control], solver=solver, engine=engine, keep=asp.Keep(stiffness=False))


@functools.cache
def reference_solution(boundary: str, law: str, control: str, precision: str) -> asp.ContactResult:
    return solution(REFERENCE, boundary, law, control, precision)


def gpu() -> Engine:
    """Engine on the GPU, if there is one."""
    try:
        cupy = importlib.import_module("cupy")
    except ImportError:
        pytest.skip("needs a GPU: cupy is not installed")
    try:
        return asp.ArrayEngine(cupy)
    except cupy.cuda.runtime.CUDARuntimeError as error:
        pytest.skip(f"needs a GPU: cupy finds none ({error})")


def test_arrays_and_passes_on_a_gpu() -> None:
    engine = gpu()
    test_arrays_go_in_and_out(engine)
    for shape in SHAPES:
        test_pressures_are_refined(engine, shape)
        for dtype in EPS:
            test_fields_are_added(engine, shape, dtype)
            test_nested_cells_are_inverted_exactly(engine, shape, dtype)
            test_periodic_convolutions_agree(engine, shape, dtype)
            test_free_convolutions_agree(engine, shape, dtype)
        for cap in CAPS:
            test_totals_agree(engine, shape, cap)
            test_violations_agree(engine, shape, cap)
            for dtype in EPS:
                test_passes_over_a_free_set_agree(engine, shape, cap, dtype, centred=True)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("control", LOADS)
def test_solutions_on_a_gpu(boundary: str, law: str, control: str) -> None:
    test_solutions_agree(gpu(), boundary, law, control, "mixed")
