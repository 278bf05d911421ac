"""Load paths: state carried, operator reused, failures flagged, cheaper than solves from nothing,
laws of hysteresis."""

from __future__ import annotations

import gc
import itertools
import math
import re
import tracemalloc
import weakref
from collections import Counter
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from contact_cases import elastic, rough
from refusals import refused

import asperity as asp
from asperity.contact.operators import Operator
from asperity.contact.solve import steps
from asperity.contact.solvers.protocol import SolverState
from asperity.core.arrays import RealArray
from asperity.core.engine import CpuEngine
from asperity.solvers import ActiveSet, ContactQP, FixedMean

SOLVER = ActiveSet(tolerance=1e-10)
LOADS = (0.05, 0.1, 0.15)


def problem(law: Any = None, shape: tuple[int, int] = (24, 20), boundary: Any = None) -> asp.ContactProblem:
    return asp.ContactProblem(
        rough(shape, 3), elastic(1.0), law=law or asp.plasticity.HardWall(), boundary=boundary or asp.Periodic()
    )


def pressures(values: tuple[float, ...]) -> list[asp.MeanPressure]:
    return [asp.MeanPressure(v) for v in values]


def energy_distance(a: asp.ContactResult, b: asp.ContactResult, extra: float = 0.0) -> tuple[float, float]:
    """|p_a - p_b|_K and its bound from both certificates; ``extra`` adds to the square of the
    latter.

    Each lies within sqrt(G) of the exact solution, G = field error times load times rms height
    (times the pixel area).
    """
    operator = asp.solvers.prepare_operator(a.problem.compliance, a.problem.grid, a.problem.boundary)
    difference = a.pressure - b.pressure
    scale = float(a.problem.profile().std()) * max(a.pressure.sum(), b.pressure.sum())
    parts = (math.sqrt((r.certificate.field_error + 1e-13) * scale) for r in (a, b))
    bound = sum(parts) + math.sqrt(extra)
    return math.sqrt(max(float((difference * operator.apply(difference)).sum()), 0.0)), bound


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_every_kind_of_control_equals_its_own_solve(boundary: Any) -> None:
    posed = problem(boundary=boundary)
    aim = asp.solve(posed, asp.MeanPressure(0.08), solver=SOLVER)
    controls = [asp.Force(0.05 * 480), asp.Approach(aim.approach), asp.MeanGap(aim.mean_gap), asp.MeanPressure(0.02)]
    path = asp.solve(posed, asp.History(controls), solver=SOLVER)
    assert path.converged
    for result, control in zip(path.steps, controls, strict=True):
        assert result.control is control
        alone = asp.solve(posed, control, solver=SOLVER)
        assert result.mean_pressure == pytest.approx(alone.mean_pressure, rel=1e-6)
        # a position fixes the load to 1e-6 only, which moves the solution by as much
        found, bound = energy_distance(result, alone, extra=(1e-6**2) * 2 * alone.elastic_energy)
        assert found <= bound


def test_arrays_of_a_path_are_the_values_of_its_results() -> None:
    path = asp.solve(problem(asp.Hardness(0.4)), asp.History(pressures(LOADS)))
    np.testing.assert_allclose(path.mean_pressure, LOADS, rtol=1e-12)
    for name in ("mean_pressure", "area_fraction_corrected", "approach", "mean_gap", "plastic_work"):
        np.testing.assert_array_equal(getattr(path, name), [getattr(r, name) for r in path.steps])
    assert (np.diff(path.approach) > 0.0).all()
    assert (np.diff(path.mean_gap) < 0.0).all()
    assert np.isnan(path.steps[0].normal_stiffness)
    assert asp.solve(problem(), asp.History(pressures((0.1,))), keep=asp.Keep()).steps[0].normal_stiffness > 0.0


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_load_unload_reload(boundary: Any) -> None:
    hardness = 0.4
    loading, unloading = (0.05, 0.1, 0.15, 0.2), (0.15, 0.1, 0.05)
    posed = problem(asp.Hardness(hardness), boundary=boundary)
    path = asp.solve(posed, asp.History(pressures((*loading, *unloading, 0.2))), solver=SOLVER)
    assert path.converged
    assert (path.plastic_work >= 0.0).all()
    assert (path.plastic_work[:4] > 0.0).all()
    top, reloaded = path.steps[3], path.steps[-1]

    # unloading is elastic but for points whose neighbours lose contact, where pressure may rise to
    # the cap
    assert path.plastic_work[4:].sum() <= 0.02 * path.plastic_work[:4].sum()
    indentations = [r.permanent_indentation for r in path.steps]
    for before, after in itertools.pairwise(indentations):
        assert (after >= before).all()

    # hysteresis: at equal load the bodies are closer after than before, by the dent left
    for down, up in zip(path.steps[4:7], path.steps[2::-1], strict=True):
        assert down.approach > up.approach
        assert down.elastic_energy < top.elastic_energy

    # reload: |p - p'|_K² <= dw·|p - p'| for profiles that differ by dw (variational inequality)
    added = indentations[6] - indentations[3]
    found, bound = energy_distance(top, reloaded, float((added * abs(top.pressure - reloaded.pressure)).sum()))
    assert found <= bound
    assert path.plastic_work[-1] <= 1e-3 * path.plastic_work[:4].sum()
    assert reloaded.approach == pytest.approx(top.approach, rel=2e-3)


def test_twenty_steps_equal_twenty_solves_and_cost_less() -> None:
    """Measured at 128²: 0.8 of the pairs. Extrapolated pressures miss the front of the contact,
    which moves."""
    posed, solver = benchmark(128), ActiveSet(tolerance=1e-6)
    controls = pressures(tuple(np.linspace(0.01, 0.2, 20)))
    path = asp.solve(posed, asp.History(controls), solver=solver)
    operator = asp.solvers.prepare_operator(posed.compliance, posed.grid, posed.boundary)
    keep = asp.Keep(stiffness=False)
    cold = [asp.solve(posed, control, solver=solver, operator=operator, keep=keep) for control in controls]
    for warm, alone in zip(path.steps, cold, strict=True):
        found, bound = energy_distance(warm, alone)
        assert found <= bound
    used = [sum(r.certificate.fft_pairs for r in results) for results in (path.steps, cold)]
    assert used[0] <= 0.9 * used[1]


def benchmark(n: int) -> asp.ContactProblem:
    """Self-affine, H = 0.8, roll-off L/4, cut-off 8 pixels, unit rms slope, E* = 1."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0
    )
    return asp.ContactProblem(asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=1), elastic(1.0))


class Counting:
    """Operator that counts what is asked of it."""

    def __init__(self, inner: Operator) -> None:
        self.inner = inner
        self.asked: Counter[str] = Counter()

    def __getattr__(self, name: str) -> Any:
        self.asked[name] += 1
        return getattr(self.inner, name)


def test_the_given_operator_serves_every_step(monkeypatch: pytest.MonkeyPatch) -> None:
    posed = problem()
    counting = Counting(asp.solvers.prepare_operator(posed.compliance, posed.grid, posed.boundary))

    def never(*_: object, **__: object) -> None:
        raise AssertionError("a second operator was prepared")

    monkeypatch.setattr(import_module("asperity.contact.solve"), "prepare_operator", never)
    seen = []
    for _ in steps(posed, pressures(LOADS), operator=counting):  # type: ignore[arg-type]
        seen.append(counting.asked["convolution"])
    assert len(set(seen)) == len(LOADS)


def test_without_operator_one_is_prepared(monkeypatch: pytest.MonkeyPatch) -> None:
    made = []

    def counted(*arguments: Any, **options: Any) -> Operator:
        made.append(options)
        return asp.solvers.prepare_operator(*arguments, **options)

    monkeypatch.setattr(import_module("asperity.contact.solve"), "prepare_operator", counted)
    engine = asp.engines.CpuEngine(1)
    asp.solve(problem(), asp.History(pressures(LOADS)), engine=engine)
    assert made == [{"engine": engine}]


@dataclass(frozen=True)
class Flaky:
    """Fast solver that gives up at the mean pressure ``at`` and notes where every solve starts."""

    at: float
    starts: list[RealArray | None] = field(default_factory=list)
    inner: ActiveSet = SOLVER
    name: ClassVar[str] = "flaky"
    citation_keys: ClassVar[tuple[str, ...]] = ()
    tolerance: ClassVar[float] = SOLVER.tolerance
    max_iterations: ClassVar[int] = SOLVER.max_iterations

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        self.starts.append(start)
        state = self.inner.init(qp, start)
        fails = isinstance(qp.constraint, FixedMean) and qp.constraint.mean_pressure == self.at
        return replace(state, error=0.5, exhausted=True) if fails else state

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        return self.inner.step(qp, state)


def test_a_failed_step_is_flagged_and_the_next_starts_from_the_last_good_one() -> None:
    solver = Flaky(at=0.1)
    path = asp.solve(problem(asp.Hardness(0.4)), asp.History(pressures(LOADS)), solver=solver, on_failure="return")
    assert [r.converged for r in path.steps] == [True, False, True]
    assert not path.converged
    assert path.steps[1].status.outcome == "stagnated"
    np.testing.assert_array_equal(solver.starts[2], path.steps[0].pressure)
    straight = asp.solve(problem(asp.Hardness(0.4)), asp.History(pressures((0.05, 0.15))), solver=SOLVER)
    np.testing.assert_array_equal(
        path.steps[2].permanent_indentation, straight.steps[1].permanent_indentation
    )  # nothing of the failed step is left


def test_a_failed_first_step_leaves_the_given_state() -> None:
    posed = problem(asp.Hardness(0.4))
    given = asp.solve(posed, asp.MeanPressure(0.12), solver=SOLVER).state
    solver = Flaky(at=0.05)
    path = asp.solve(posed, asp.History(pressures((0.05, 0.06))), solver=solver, state=given, on_failure="return")
    assert solver.starts[1] is given.pressure
    np.testing.assert_array_equal(path.steps[1].permanent_indentation >= given.permanent_indentation, True)


def test_a_failed_step_raises_with_its_number_and_result() -> None:
    with refused(asp.ConvergenceError, "Step 2 of the history") as caught:
        asp.solve(problem(), asp.History(pressures(LOADS)), solver=Flaky(at=0.1))
    assert isinstance(caught.value.result, asp.ContactResult)
    assert caught.value.result.control == asp.MeanPressure(0.1)
    assert caught.value.result.status.outcome == "stagnated"
    assert caught.value.result.status.remedy in str(caught.value)


@pytest.mark.parametrize("on_failure", ["raise", "return"])
def test_a_step_without_solution_raises_with_its_number(on_failure: Any) -> None:
    with refused(asp.errors.NoSolutionError, "Step 2 of the history: mean pressure"):
        asp.solve(problem(asp.Hardness(0.4)), asp.History(pressures((0.1, 0.5))), on_failure=on_failure)


def test_splitting_a_path_changes_nothing_beyond_the_tolerance() -> None:
    posed = problem(asp.Hardness(0.4))
    whole = asp.solve(posed, asp.History(pressures(LOADS)), solver=SOLVER)
    first = asp.solve(posed, asp.History(pressures(LOADS[:2])), solver=SOLVER)
    second = asp.solve(posed, asp.History(pressures(LOADS[2:])), solver=SOLVER, state=first.steps[-1].state)
    found, bound = energy_distance(whole.steps[-1], second.steps[-1])
    assert found <= bound


def test_steps_hold_few_results_and_are_solved_when_asked_for() -> None:
    seen: list[weakref.ref[asp.ContactResult]] = []
    most = 0
    for result in steps(problem(), pressures(tuple(np.linspace(0.02, 0.2, 8)))):
        seen.append(weakref.ref(result))
        most = max(most, sum(reference() is not None for reference in seen))
    assert most <= 3
    solver = Flaky(at=0.0)
    stream = steps(problem(), pressures(LOADS), solver=solver)
    assert not solver.starts
    next(stream)
    assert len(solver.starts) == 1


def test_a_path_holds_no_operator_and_no_gap_that_its_numbers_need() -> None:
    """Beside pressure and displacement of each step little is held, also after its areas were read:
    gap and edges are twice as much."""
    posed = problem(shape=(96, 96))
    operator = asp.solvers.prepare_operator(posed.compliance, posed.grid, posed.boundary)
    gone = weakref.ref(operator)
    path = asp.solve(posed, asp.History(pressures(LOADS)), operator=operator)
    path.scalars("area_fraction_corrected")  # imports and compiles what areas need
    tracemalloc.start()
    path = asp.solve(posed, asp.History(pressures(LOADS)), operator=operator)
    del operator
    gc.collect()
    assert gone() is None
    before = tracemalloc.get_traced_memory()[0]
    for name in ("area_fraction_corrected", "mean_gap", "contact_perimeter"):
        path.scalars(name)
    gc.collect()
    grown = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert grown < 0.25 * len(path) * path.last.pressure.nbytes


MANY = tuple(np.geomspace(0.02, 0.3, 33))


@pytest.mark.parametrize("count", [15, 16, 24, 33])
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_chains_of_loads_give_the_path_of_its_steps(boundary: Any, count: int) -> None:
    """In order, each within its certificate of the steps one after the other, whatever the number
    of threads."""
    posed, loads = problem(boundary=boundary), pressures(MANY[:count])
    paths = [asp.solve(posed, asp.History(loads), solver=SOLVER, engine=CpuEngine(threads)) for threads in (1, 3)]
    for one, other, alone, load in zip(
        *(path.steps for path in paths), steps(posed, loads, solver=SOLVER), loads, strict=True
    ):
        assert one.control is other.control is load
        np.testing.assert_allclose(one.pressure, other.pressure, rtol=0.0, atol=1e-12 * one.pressure.max())
        found, bound = energy_distance(one, alone)
        assert found <= bound
    cold = sum(step.state.earlier is None for step in paths[0].steps)
    assert cold == max(1, min(4, count // 8))


@pytest.mark.parametrize("law", [asp.Hardness(0.2), None], ids=["hardness", "progress"])
def test_steps_that_remember_and_steps_that_are_watched_follow_one_another(law: Any) -> None:
    seen: list[float] = []

    class Watch:
        def update(self, iteration: int, error: float, tolerance: float) -> None:
            seen.append(error)

    path = asp.solve(problem(law), asp.History(pressures(MANY[:16])), progress=None if law else Watch())
    assert [step.state.earlier is None for step in path.steps] == [True] + 15 * [False]
    assert bool(seen) is not bool(law)


@dataclass(frozen=True)
class FailsAbove(ActiveSet):
    """Gives up at loads above ``most``."""

    most: float = 0.0

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        following = super().step(qp, state)
        assert isinstance(qp.constraint, FixedMean)
        return replace(following, exhausted=qp.constraint.mean_pressure > self.most)


def test_a_failure_in_a_chain_has_its_number_in_the_history() -> None:
    loads, solver = pressures(MANY[:20]), FailsAbove(tolerance=1e-12, most=MANY[13])
    with refused(asp.ConvergenceError, "Step 15 of the history") as caught:
        asp.solve(problem(), asp.History(loads), solver=solver)
    assert caught.value.result.control is loads[14]
    path = asp.solve(problem(), asp.History(loads), solver=solver, on_failure="return")
    assert [step.converged for step in path.steps] == 14 * [True] + 6 * [False]


def test_inputs_are_left_alone() -> None:
    posed = problem(asp.Hardness(0.4))
    state = asp.solve(posed, asp.MeanPressure(0.05)).state
    kept = state.pressure.copy(), state.permanent_indentation.copy(), posed.profile().copy()
    asp.solve(posed, asp.History(pressures(LOADS)), state=state)
    for found, wanted in zip((state.pressure, state.permanent_indentation, posed.profile()), kept, strict=True):
        np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize(
    ("controls", "subject", "shown"),
    [
        ([], "steps of a history", "none"),
        (asp.MeanPressure(0.1), "steps of a history", "History([MeanPressure(value=0.1)])"),
        (0.1, "steps of a history", "0.1"),
        ([asp.MeanPressure(0.1), 0.2], "step 2 of a history", "0.2"),
    ],
)
def test_wrong_controls_are_refused_before_any_step(controls: Any, subject: str, shown: str) -> None:
    with refused(asp.InputError, subject, shown):
        steps(problem(), controls)


def test_wrong_choice_on_failure_is_refused() -> None:
    with refused(asp.InputError, "on_failure"):
        steps(problem(), pressures(LOADS), on_failure="ignore")  # type: ignore[arg-type]


def test_the_examples_of_the_guide() -> None:
    text = (Path(__file__).parents[3] / "docs/how-to/load-paths.md").read_text(encoding="utf-8")
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(50e-9), hurst=0.8, rolloff_wavelength=3e-6, shortest_wavelength=0.8e-6
    )
    scan = asp.generate.gaussian(asp.Grid((32, 32), (0.1e-6, 0.1e-6)), spectrum, seed=1)
    names: dict[str, Any] = {"scan": scan}
    text = re.sub(r"^scan = .*\n", "", text, flags=re.MULTILINE)  # reads the file of the reader
    for block in re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
        exec(compile(block, "load-paths.md", "exec"), names)  # noqa: S102 - running the page is the test
    path = names["path"]
    assert len(path.steps) == 12
    assert path.plastic_work[:10].sum() > 0.0
    assert path.plastic_work[10:].sum() <= 0.02 * path.plastic_work[:10].sum()
    np.testing.assert_allclose(names["areas"], path.area_fraction_corrected[:10], rtol=1e-3)
