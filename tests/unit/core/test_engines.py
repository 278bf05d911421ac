"""All engines do the same: pass by pass, and in whole solves."""

from __future__ import annotations

import functools
import importlib
import itertools
import math
import sys
from dataclasses import dataclass, fields, replace
from types import ModuleType, SimpleNamespace
from typing import Any

import array_api_strict
import numpy as np
import pytest
from contact_cases import elastic, rough
from emulated_gpu import EmulatedGpu
from refusals import refused

import asperity as asp
from asperity.contact.controls import Control
from asperity.contact.law import InterfaceLaw
from asperity.contact.solvers.active_set.bounds import _PRIOR, _SCATTER_SHARE, entering_levels, free_set
from asperity.core.arrays import RealArray
from asperity.core.engine import SQUARE_SIDE, Engine, Load, SplineModel, blocks, cpu
from asperity.core.engine import gpu as gpu_engine

REFERENCE = asp.engines.CpuEngine(1)
OTHERS: dict[str, Engine] = {
    "cpu with two threads": asp.engines.CpuEngine(2),
    "numpy": asp.engines.ArrayEngine(np),
    "array_api_strict": asp.engines.ArrayEngine(array_api_strict),
    "second device": asp.engines.ArrayEngine(array_api_strict, device=array_api_strict.Device("device1")),
    "emulated gpu": EmulatedGpu(),
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
        found, wanted = (convolved(e, e.convolution(kernel, shape, dtype), field, dtype) for e in (engine, REFERENCE))
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
    found, wanted = (
        convolved(e, e.convolution(kernel, shape, dtype, padded), field, dtype) for e in (engine, REFERENCE)
    )
    agree(found, wanted, 3, dtype)
    direct = 2.0 * field
    direct[1:] += 0.5 * field[:-1]
    direct[:-1] += 0.5 * field[1:]
    agree(found, direct, 3, dtype)


def convolved(engine: Engine, convolution: Any, field: RealArray, dtype: str) -> RealArray:
    out = engine.zeros((field.shape[0], field.shape[1]), dtype)
    returned = convolution.apply(engine.array(field, dtype), out)
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
        "shifted",
        "changed",
    ):
        agree(getattr(found, name), getattr(wanted, name), case.p.size, dtype)
    agree(found.alone, found.direction, 1, dtype)
    agree(found.sums[5], found.sums[4], case.p.size, dtype)
    assert not found.released.any()


def work_on_free_set(engine: Engine, case: Iterate, dtype: str, centred: bool) -> SimpleNamespace:
    """One conjugate gradient step with made-up numbers, a step of the pressure, and what is seen at
    each stage."""
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
    alone, _ = free.update_direction(z, 0.25, 0.0, free.zeros(), r, None)  # the same without a field
    alone, again = free.update_direction(z, 0.25, 0.5, alone, r, None)
    seen.alone = scattered(alone)
    kt, *third = free.gather_products(response, t, r, free.zeros())
    d, r, _ = free.update_solution(0.7, t, kt, 0.125, free.zeros(), r)
    d, r, left = free.update_solution(0.3, t, kt, 0.125, d, r)
    assert left == pytest.approx(free.square(r), rel=1e-6 if dtype == "float32" else 1e-14)
    seen.advanced = [scattered(d), scattered(r)]
    seen.sums = [*first, product, second, again, *third]
    old, total = free.gather(p)
    found, seen.clipped = free.add_clipped(p, d, 0.8, cap)
    seen.moved = engine.numpy(p).copy()
    raised = free.rescale(p, 1.25, 0.125, cap)
    seen.loads = [total, *values_of(found), *values_of(raised)]
    free.interpolate(old, 0.25, p)
    seen.blended = engine.numpy(p).copy()
    seen.shifted = scattered(free.shifted(r, 0.25))
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
@every_type
@pytest.mark.parametrize("load", [None, 50.0])
def test_the_loaded_points_of_a_free_set(engine: Engine, dtype: str, load: float | None) -> None:
    """Two steps of pressure, after each of which what is tensile leaves: pressures scaled to a
    load, another vector, a residual of zero, and the change by both."""
    shape = (12, 7)
    case, ramp, down = iterate(shape, "none"), np.arange(84.0).reshape(shape), 0.125 * iterate(shape, "none").p.max()
    _, u, h, _ = case.on(engine)
    p = engine.array(case.p.copy(), "float64")
    free = free_set(engine.survey(p, u, h, None), case.level, 1.0, dtype)

    def seen(points: Any, vector: Any) -> RealArray:
        """Array with a ``vector`` of the set ``points``, zero elsewhere."""
        found = engine.zeros(shape, dtype)
        points.scatter(vector, found)
        return engine.numpy(found)

    inside, before = seen(free, free.shifted(free.zeros(), 1.0)) > 0.0, free.gather(p)[0]
    left, values, vector, pressure = free, before, free.gather(engine.array(ramp, dtype))[0], case.p
    for _ in range(2):
        left, values, vector = left.loaded(values + left.shifted(left.zeros(), -down), load, vector)
        inside, pressure = inside & (pressure > down), pressure - down
        if load is not None:
            pressure = pressure * (load / pressure[inside].sum())
    wanted = np.where(inside, pressure, 0.0)
    rounding = 8.0 * EPS[dtype] * wanted.max()
    assert 0 < left.size == inside.sum() < free.size
    assert left.entering == 0
    assert left.square(left.residual(centred=False)) == 0.0
    np.testing.assert_array_equal(seen(left, vector), np.where(inside, ramp, 0.0))
    after = free.spread(left, values)
    change = seen(free, free.change(after, before, 3.0))
    free.put(after, p)
    np.testing.assert_allclose(engine.numpy(p), wanted, atol=rounding)
    np.testing.assert_allclose(change, (engine.numpy(p) - case.p) / 3.0, atol=rounding)
    spread = engine.field(shape, dtype) if isinstance(engine, asp.engines.CpuEngine) else engine.zeros(shape, dtype)
    left.scatter_add(vector, 2.0, spread)
    np.testing.assert_array_equal(engine.numpy(spread), np.where(inside, 2.0 * ramp, 0.0))


@every_engine
@pytest.mark.parametrize("shape", [(8, 12), (9, 7), (1, 10), (130, 66)])
@pytest.mark.parametrize("wraps", [(True, True), (False, False), (True, False)])
def test_interpolation_between_coarser_points(engine: Engine, shape: tuple[int, int], wraps: tuple[bool, bool]) -> None:
    """A plane comes out as it is between the outermost points of a coarse grid; around them it goes
    on on the other side, or is flat."""
    x, y = np.meshgrid(*(np.arange(-(-n // 2)) for n in shape), indexing="ij")
    found = engine.interpolated(3.0 * x - 2.0 * y + 1.0, shape, wraps)

    def along(n: int, around: bool) -> RealArray:
        """Coordinate of each point in the units of coarse points, if linear interpolation of that
        coordinate is all there is."""
        coarse, place = -(-n // 2), 0.5 * np.arange(n) - 0.25
        wide = np.arange(-1.0, coarse + 1.0)
        return np.interp(place, wide, wide % coarse if around else np.clip(wide, 0, coarse - 1))

    wanted = 3.0 * along(shape[0], wraps[0])[:, None] - 2.0 * along(shape[1], wraps[1]) + 1.0
    np.testing.assert_allclose(found, wanted, atol=1e-12 * np.abs(wanted).max())


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
    """Half of the scatter; 4 of 132 points of the prior, which is the same here and empty above,
    weaken it by 2 %."""
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
    """A region whose loaded points all stand too high or low by one amount takes in the points that
    fit that amount."""
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
    # four points of a wider square, at most 1.8 off, count beside the loaded ones: half of 16 x 5
    # in the last columns
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
    np.testing.assert_allclose(entering_levels(squares, level, _SCATTER_SHARE), expected, rtol=0.0, atol=1e-12)


def test_without_points_between_the_bounds_levels_are_those_of_the_plane() -> None:
    np.testing.assert_array_equal(entering_levels(np.zeros((4, 7, 3)), 0.3, _SCATTER_SHARE), np.full((4, 7, 2), 0.3))


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
    prepared = engine.splines((3, 4), splines((3, 4), (True, True), BOTH), dtype)
    prepared.factorise(free)
    assert list(prepared.solve(free, r, r, free.zeros())[1:]) == [0.0, 0.0, 0.0]
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
    fine = engine.numpy(engine.prolonged(engine.array(coarse, "float64"), base, heights, 0.3))
    for (i, j), value in np.ndenumerate(fine):
        p = coarse[i // 2, j // 2]
        assert value == pytest.approx(max(0.0, p + 0.3 * (heights[i, j] - base[i // 2, j // 2])) if p > 0.0 else 0.0)


def splines(shape: tuple[int, int], wraps: tuple[bool, bool], merges: tuple[tuple[bool, bool], ...]) -> SplineModel:
    """Random coefficients, none along an axis of one point."""
    rng = np.random.default_rng([*shape, *wraps])
    weights, rises = (tuple(rng.uniform(0.1, 1.0, len(merges)).tolist()) for _ in range(2))
    x, y = (float(n > 1) for n in shape)
    return SplineModel(
        wraps,
        merges,
        tuple((level < 3 and along_x, level > 0 and along_y) for level, (along_x, along_y) in enumerate(merges)),
        weights,
        (1.0, 0.3 * x, 0.2 * y, 0.1 * x * y),
        rises,
        1.7,
        (0.3 * x, -0.2 * y),
        (0.25 * x, 0.9 * y),
    )


def parts_matrix(n: int, wraps: bool) -> RealArray:
    """Shares of ``n`` parts in their cells, by the definition."""
    count, shift = ((n + 1) // 2, 0) if wraps else (n // 2 + 2, 1)
    matrix = np.zeros((n, count))
    for part in range(n):
        own = part // 2
        beside = own - 1 if part % 2 == 0 else own + 1
        matrix[part, own + shift] += 0.75
        matrix[part, (beside + shift) % count] += 0.25
    return matrix


def levels_of(shape: tuple[int, int], model: SplineModel) -> list[RealArray]:
    """Shares of the parts of every level in its cells."""
    found, sizes = [], list(shape)
    for merge in model.merges:
        axes = [
            parts_matrix(n, wrap) if pairs else np.eye(n)
            for n, wrap, pairs in zip(sizes, model.wraps, merge, strict=True)
        ]
        sizes = [axis.shape[1] for axis in axes]
        found.append(np.kron(*axes))
    return found


def moved(shape: tuple[int, int], model: SplineModel, x: int, y: int) -> RealArray:
    """Matrix that picks the value of the point so far away; none comes from beyond a rim that does
    not wrap."""
    picked = []
    for n, wrap, places in zip(shape, model.wraps, (x, y), strict=True):
        matrix = np.zeros((n, n))
        for i in range(n):
            if wrap or 0 <= i + places < n:
                matrix[i, (i + places) % n] += 1.0
        picked.append(matrix)
    return np.kron(*picked)


def average_matrix(n: int, wraps: bool) -> RealArray:
    """Averages over ``n`` cells and those beside them, by the definition."""
    matrix = 0.5 * np.eye(n)
    for cell in range(n):
        for beside in (cell - 1, cell + 1):
            if wraps or 0 <= beside < n:
                matrix[cell, beside % n] += 0.25
    return matrix


def averages_of(shape: tuple[int, int], model: SplineModel) -> list[RealArray]:
    """Averages over the cells of every level."""
    found, sizes = [], list(shape)
    for merge, average in zip(model.merges, model.averages, strict=True):
        sizes = [
            parts_matrix(n, wrap).shape[1] if pairs else n
            for n, wrap, pairs in zip(sizes, model.wraps, merge, strict=True)
        ]
        axes = [
            average_matrix(n, wrap) if along else np.eye(n)
            for n, wrap, along in zip(sizes, model.wraps, average, strict=True)
        ]
        found.append(np.kron(*axes))
    return found


@functools.cache
def compliance_matrix(shape: tuple[int, int], model: SplineModel) -> RealArray:
    """own + sum of w P A P^T."""
    point, x, y, diagonal = model.own
    found, splines = point * np.eye(math.prod(shape)), np.eye(math.prod(shape))
    for sign in (1, -1):
        found += 0.5 * x * moved(shape, model, sign, 0) + 0.5 * y * moved(shape, model, 0, sign)
        found += 0.25 * diagonal * (moved(shape, model, sign, 1) + moved(shape, model, sign, -1))
    for weight, parts, average in zip(model.weights, levels_of(shape, model), averages_of(shape, model), strict=True):
        splines = splines @ parts
        found += weight * splines @ average @ splines.T
    return found


def overlap_matrix(sizes: tuple[int, ...], wraps: tuple[bool, bool], passed: RealArray) -> RealArray:
    """Row sums of the products of B-splines less the products, of parts that pass up the same
    between the middles of neighbouring cells: their mean there."""
    cells = [parts_matrix(n, wrap).shape[1] for n, wrap in zip(sizes, wraps, strict=True)]
    found, values = np.zeros((math.prod(cells), math.prod(cells))), passed.reshape(sizes)
    products = np.array([[0.625, 0.375], [0.375, 0.625]])
    missing = np.eye(4) - np.kron(products, products)
    for block in np.ndindex(*cells):
        corners, parts = [], []
        for first, number, n, wrap in zip(block, cells, sizes, wraps, strict=True):
            second = (first + 1) % number if wrap else first + 1
            corners.append((first, second) if second < number else ())
            after = 2 * second if wrap else 2 * first
            parts.append([part for part in (2 * first + (1 if wrap else -1), after) if 0 <= part < n])
        if all(corners):
            mean = 0.25 * values[np.ix_(*parts)].sum()
            at = [i * cells[1] + j for i in corners[0] for j in corners[1]]
            for i, row in zip(at, missing, strict=True):
                np.add.at(found[i], at, mean * row)
    return found


def inverse_matrix(shape: tuple[int, int], model: SplineModel, inside: RealArray) -> RealArray:
    """The recursion with row sums, level by level as dense matrices, between local stiffnesses; on
    the points of the set."""
    member = inside.ravel().astype(float)
    local = np.eye(member.size)
    for axis, (x, y) in enumerate(((1, 0), (0, 1))):
        for sign in (1, -1):
            near, far = (moved(shape, model, step * sign * x, step * sign * y) for step in (1, 2))
            neighbours = member[:, None] * near * member
            local += 0.25 * model.fall[axis] * (np.diag(neighbours.sum(axis=1)) - neighbours)
            local += model.bend[axis] / 16.0 * (3.0 * np.eye(member.size) - 4.0 * near + far)
    alone = np.diag(local)
    together = alone + (local - np.diag(alone)) @ member if model.corrections else np.ones(member.size)
    levels, unit, g = levels_of(shape, model), member, []
    sizes, corrections = shape, []
    shares = model.corrections or (0.0,) * len(levels)
    for weight, parts, merge, share in zip(model.inverse_weights, levels, model.merges, shares, strict=True):
        sums = parts.T @ unit
        correction = np.eye(sums.size)
        if all(merge) and share:
            per = np.divide(1.0, sums, out=np.zeros_like(sums), where=sums > 0.0)
            correction += share * per[:, None] * overlap_matrix(sizes, model.wraps, unit)
        corrections.append(correction)
        sizes = tuple(
            parts_matrix(n, wrap).shape[1] if pairs else n
            for n, wrap, pairs in zip(sizes, model.wraps, merge, strict=True)
        )
        g.append(1.0 / (1.0 + weight * sums))
        unit = g[-1] * sums
    above: RealArray = np.zeros(())
    for depth in range(len(levels) - 1, -1, -1):
        own = np.diag(g[depth] * model.inverse_weights[depth])
        if depth + 1 < len(levels):
            own += np.diag(g[depth]) @ levels[depth + 1] @ above @ levels[depth + 1].T @ np.diag(g[depth])
        above = corrections[depth] @ own
    found = local - together[:, None] * (levels[0] @ above @ levels[0].T)
    chosen = np.flatnonzero(member)
    inverse: RealArray = model.stiffness * found[np.ix_(chosen, chosen)]
    return inverse


@functools.cache
def inverse_on(shape: tuple[int, int], model: SplineModel, inside: bytes) -> RealArray:
    """The same for a set given by its bytes, made and checked once for all engines and types:
    positive definite, and symmetric but for the correction."""
    inverse = inverse_matrix(shape, model, np.frombuffer(inside, bool).reshape(shape))
    if not model.corrections:
        np.testing.assert_allclose(inverse, inverse.T, atol=1e-14)
    assert inverse.size == 0 or np.linalg.eigvalsh(inverse + inverse.T)[0] > 0.0
    return inverse


WRAPS = [(True, True), (False, False), (True, False)]
BOTH = tuple((True, True) for _ in range(4))
FIRST_Y = ((False, True), (True, True), (True, False), (True, True))


def set_of(engine: Engine, inside: RealArray, dtype: str) -> Any:
    """Free set of the points ``inside`` with a random residual."""
    fields = (
        np.where(inside, 1.0, 0.0),
        np.where(inside, 0.0, 100.0),
        np.random.default_rng(inside.size).standard_normal(inside.shape),
    )
    return free_set(engine.survey(*(engine.array(values, "float64") for values in fields), None), -10.0, 1.0, dtype)


SPLINE_SHAPES = [(1, 1), (1, 9), (7, 1), (5, 8), (12, 7), (16, 16), (12, 30)]
CORRECTIONS = [(), (0.65, 0.5, 0.6, 0.4), (0.0, 0.65, 0.5, 0.6)]


@pytest.mark.parametrize(
    ("engine", "shape"),
    [
        pytest.param(engine, shape, id=f"{name}-{shape}")
        for name, engine in {"cpu": REFERENCE, **OTHERS}.items()
        for shape in (SPLINE_SHAPES if engine is REFERENCE else SPLINE_SHAPES[3:5])
    ],
)
@pytest.mark.parametrize("wraps", WRAPS, ids=["round", "free", "strip"])
@pytest.mark.parametrize("corrections", CORRECTIONS, ids=["plain", "corrected", "from the second level"])
@every_type
def test_nested_splines_are_those_of_dense_matrices(
    engine: Engine, shape: tuple[int, int], wraps: tuple[bool, bool], corrections: tuple[float, ...], dtype: str
) -> None:
    """Products, prediction and inverse, which is positive definite; the same buffers for one set
    after the other."""
    rng, clear = np.random.default_rng(shape), engine.zeros(shape, dtype)
    for merges in (BOTH, FIRST_Y):
        merges = tuple((x and shape[0] > 1, y and shape[1] > 1) for x, y in merges)
        model = replace(splines(shape, wraps, merges), corrections=corrections)
        prepared, dense = engine.splines(shape, model, dtype), compliance_matrix(shape, model)

        def on_points(free: Any, vector: Any) -> RealArray:
            free.scatter(vector, clear)
            found: RealArray = engine.numpy(clear).astype(float).ravel()
            engine.clear_field(free, clear)
            return found

        for share in (0.2, 0.6, 1.0, 0.1):
            inside, other = (rng.uniform(size=shape) < part for part in (share, 0.4))
            free, loaded = (set_of(engine, points, dtype) for points in (inside, other))
            r, change = free.residual(centred=False), loaded.residual(centred=False)
            load, given = on_points(free, r), on_points(loaded, change)
            tolerance = 200.0 * EPS[dtype] * (1.0 + np.abs(load).sum() + np.abs(given).sum())
            prepared.factorise(free)
            inverse = inverse_on(shape, model, inside.tobytes())
            picked = load[inside.ravel()]
            for found, wanted in (
                (prepared.solve(free, r, r, free.zeros()), inverse @ picked),
                (prepared.deflection(free, r, r, free.zeros()), (dense @ load)[inside.ravel()]),
                (prepared.solve(free, r, r, free.zeros()), inverse @ picked),
            ):
                values = on_points(free, found.vector)
                np.testing.assert_allclose(values[inside.ravel()], wanted, atol=tolerance)
                assert not values[~inside.ravel()].any()
                assert found.total == pytest.approx(wanted.sum(), abs=tolerance * picked.size)
                assert found.first == found.second == pytest.approx(wanted @ picked, abs=tolerance * picked.size)
            predicted = on_points(free, prepared.predicted_residual(free, r, loaded, change))
            np.testing.assert_allclose(predicted, np.where(inside.ravel(), load - dense @ given, 0.0), atol=tolerance)
            again = on_points(free, prepared.solve(free, r, r, free.zeros()).vector)
            np.testing.assert_allclose(again[inside.ravel()], inverse @ picked, atol=tolerance)


@pytest.mark.parametrize("shape", [(5, 8), (16, 12)], ids=str)
def test_points_of_a_conductance_of_their_own_yield_by_it(shape: tuple[int, int]) -> None:
    """Without a local stiffness the inverse is that of the recursion for points that yield by it
    times their load."""
    rng = np.random.default_rng(shape)
    model = replace(splines(shape, (True, True), BOTH), fall=(0.0, 0.0), bend=(0.0, 0.0))
    inside = rng.uniform(size=shape) < 0.6
    free, prepared = set_of(REFERENCE, inside, "float64"), REFERENCE.splines(shape, model, "float64")
    conductance = np.where(rng.uniform(size=free.size) < 0.5, 1.0, rng.uniform(-0.4, 0.8, free.size))
    spread = np.zeros(shape)
    spread[inside] = conductance
    whole = inverse_matrix(shape, model, spread)  # 1 - P X P^T with loads that count by their conductance
    r = free.residual(centred=False).copy()
    prepared.factorise(free, conductance)
    found = prepared.solve_with(free, r, conductance)
    chosen = np.flatnonzero(spread.ravel())
    assert chosen.size == free.size
    cells = np.eye(free.size) - whole / model.stiffness
    wanted = model.stiffness * conductance * (r - cells @ (conductance * r))
    np.testing.assert_allclose(found, wanted, atol=1e-12 * (1.0 + np.abs(r).sum()))


@every_cap
def test_passes_do_not_depend_on_the_number_of_threads(cap: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (blocks, cpu):
        monkeypatch.setattr(module, "SERIAL_BELOW", 1 << 17)
    case = iterate((700, 701), cap)  # enough for three threads, on the free set too
    one, three = asp.engines.CpuEngine(1), asp.engines.CpuEngine(3)
    first, second = (values_of(e.survey(*case.on(e)).totals) for e in (one, three))
    assert first == second
    if cap != "none":
        first, second = (values_of(e.violation(*case.on(e), case.level)) for e in (one, three))
        assert first == second
    first, second = (work_on_free_set(e, case, "float32", centred=True) for e in (one, three))
    assert first.size > blocks.SERIAL_BELOW
    for name in vars(first):
        assert np.array_equal(getattr(first, name), getattr(second, name)), name


def test_an_engine_has_a_name() -> None:
    assert asp.engines.ArrayEngine(np).name == "numpy (cpu)"
    assert asp.engines.ArrayEngine(array_api_strict).name.startswith("array_api_strict (")
    assert asp.engines.CpuEngine(2).name.endswith("2 threads)")
    assert EmulatedGpu().name == "gpu (emulated)"


def test_what_is_no_array_library_is_refused() -> None:
    with refused(asp.InputError, "namespace of ArrayEngine"):
        asp.engines.ArrayEngine("cupy")


def test_libraries_without_transforms_or_writable_arrays_are_refused() -> None:
    class Frozen:
        def __array_namespace__(self, api_version: str | None = None) -> Any:
            return bare

        def __setitem__(self, key: object, value: object) -> None:
            raise TypeError

    bare: Any = ModuleType("bare")
    bare.zeros = lambda n: Frozen()
    with refused(asp.InputError, "namespace of ArrayEngine"):
        asp.engines.ArrayEngine(bare)
    bare.fft = ModuleType("fft")
    with refused(asp.InputError, "namespace of ArrayEngine"):
        asp.engines.ArrayEngine(bare)


TOLERANCE = 1e-9
MODULUS = 100.0
LOADS: dict[str, Control] = {"load": asp.MeanPressure(8.0), "approach": asp.Approach(2.0)}
LAWS: dict[str, InterfaceLaw] = {"elastic": asp.plasticity.HardWall(), "hardness": asp.Hardness(60.0)}
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
    """(p - q)·K (p - q) <= G(p) + G(q), the duality gaps, each at most tolerance x total pressure x
    rms height.

    That bounds single points by the smallest eigenvalue of K: contact may differ only where the
    pressure is below it.
    """
    found = solution(engine, boundary, law, control, precision)
    wanted = reference_solution(boundary, law, control, precision)
    p, q, problem = found.pressure, wanted.pressure, wanted.problem
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    bound = 2.0 * TOLERANCE * problem.profile().std() * max(p.sum(), q.sum())
    assert ((p - q) * operator.apply(p - q)).sum() <= bound
    eigenvalues = operator.kernel.ravel()[1 if operator.zero_mean_mode else 0 :]
    assert eigenvalues.min() > 0.0
    differ = (p > 0.0) != (q > 0.0)
    assert np.all(np.maximum(p, q)[differ] <= np.sqrt(bound / eigenvalues.min()))
    assert found.area_fraction == pytest.approx(wanted.area_fraction, abs=differ.mean() + 1e-15)
    assert np.abs(p - q).max() <= 1e-7 * q.max(), "in truth they follow the same path, to rounding"
    # the rounding of single precision may decide on the last step; the load of a position is found
    # along with the pressure on a CPU alone
    if precision == "double" and (control != "approach" or found.certificate.rounds == wanted.certificate.rounds):
        assert found.certificate.iterations == wanted.certificate.iterations
        assert found.certificate.fft_pairs == wanted.certificate.fft_pairs


def solution(engine: Engine, boundary: str, law: str, control: str, precision: Any) -> asp.ContactResult:
    surface = rough((65, 70), seed=5, spacing=(0.3, 0.25))
    problem = asp.ContactProblem(surface, elastic(MODULUS), boundary=BOUNDARIES[boundary], law=LAWS[law])
    solver = asp.solvers.ActiveSet(tolerance=TOLERANCE, precision=precision)
    return asp.solve(problem, LOADS[control], solver=solver, engine=engine, keep=asp.Keep(stiffness=False))


@functools.cache
def reference_solution(boundary: str, law: str, control: str, precision: str) -> asp.ContactResult:
    return solution(REFERENCE, boundary, law, control, precision)


@pytest.mark.parametrize("shape", [(5, 8), (1, 9), (12, 7), (17, 18)])
@every_type
def test_large_levels_of_a_gpu_have_kernels_of_their_own(
    shape: tuple[int, int], dtype: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One block goes up and down the small levels; with fewer of them the answer is the same."""
    monkeypatch.setattr(gpu_engine, "_TURNING", 4)
    for wraps in WRAPS:
        for corrections in ((), (0.65, 0.5, 0.6, 0.4)):
            test_nested_splines_are_those_of_dense_matrices(EmulatedGpu(), shape, wraps, corrections, dtype)


@functools.cache
def gpu() -> Engine:
    """Engine of the GPU, if there is one."""
    try:
        return asp.engines.GpuEngine()
    except asp.InputError as error:
        pytest.skip(f"needs a GPU: {error}")


def test_arrays_and_passes_on_a_gpu() -> None:
    engine = gpu()
    test_arrays_go_in_and_out(engine)
    for shape in SHAPES:
        test_pressures_are_refined(engine, shape)
        for dtype in EPS:
            test_fields_are_added(engine, shape, dtype)
            for wraps, corrections in itertools.product(WRAPS, CORRECTIONS):
                test_nested_splines_are_those_of_dense_matrices(engine, shape, wraps, corrections, dtype)
            test_periodic_convolutions_agree(engine, shape, dtype)
            test_free_convolutions_agree(engine, shape, dtype)
            test_an_empty_free_set(engine, dtype)
            test_tensile_points_are_counted_and_cleared(engine, dtype)
            test_the_loaded_points_of_a_free_set(engine, dtype, 50.0)
        for cap in CAPS:
            test_totals_agree(engine, shape, cap)
            test_violations_agree(engine, shape, cap)
            for dtype in EPS:
                test_passes_over_a_free_set_agree(engine, shape, cap, dtype, centred=True)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("control", LOADS)
@pytest.mark.parametrize("precision", ["mixed", "double"])
def test_solutions_on_a_gpu(boundary: str, law: str, control: str, precision: str) -> None:
    test_solutions_agree(gpu(), boundary, law, control, precision)


def test_solutions_by_array_operations_on_a_gpu() -> None:
    gpu()
    test_solutions_agree(
        asp.engines.ArrayEngine(importlib.import_module("cupy")), "periodic", "elastic", "load", "double"
    )


def test_without_cupy_or_a_gpu_the_engine_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cupy", None)
    with refused(asp.InputError, "library of GpuEngine", "pip install cupy-cuda12x"):
        asp.engines.GpuEngine()

    def none() -> int:
        raise RuntimeError("no CUDA-capable device is detected")

    runtime = SimpleNamespace(getDeviceCount=none, CUDARuntimeError=RuntimeError)
    monkeypatch.setitem(sys.modules, "cupy", SimpleNamespace(cuda=SimpleNamespace(runtime=runtime)))
    with refused(asp.InputError, "machine of GpuEngine", "no CUDA-capable device is detected"):
        asp.engines.GpuEngine()
