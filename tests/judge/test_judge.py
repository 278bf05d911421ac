"""Random problems over all physics: what is called converged fulfils its equations, and nearly all are solved."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from judge.equations import equations
from judge.judge import all_judged, failures, table
from judge.problems import KINDS, problem
from judge.solved import Solved, solved

import asperity as asp


def test_no_problem_is_wrongly_called_converged() -> None:
    assert failures(list(all_judged(range(60)))) == []


@pytest.mark.slow
def test_no_problem_of_five_hundred_is_wrongly_called_converged() -> None:
    assert failures(list(all_judged(range(60, 560)))) == []


def test_problems_are_the_same_for_the_same_seed() -> None:
    for seed in range(len(KINDS)):
        first, second = problem(seed), problem(seed)
        np.testing.assert_array_equal(first.problem.profile(), second.problem.profile())
        assert [repr(step) for step in first.steps] == [repr(step) for step in second.steps]


def damaged(found: Solved, share: float) -> Solved:
    """Results whose pressure is larger by this ``share`` at the point that bears most, and whose certificates are as they were."""
    changed = []
    for result in found.results:
        pressure = np.array(result.pressure, dtype=float)
        pressure[np.unravel_index(np.argmax(pressure), pressure.shape)] *= 1.0 + share
        changed.append(replace(result, pressure=pressure))
    rolling = found.rolling if found.rolling is None else replace(found.rolling, normal=changed[0])
    return Solved(tuple(changed), rolling)


@pytest.mark.parametrize("kind", dict.fromkeys(KINDS))
def test_a_wrong_pressure_is_seen(kind: str) -> None:
    seeds = [seed for seed in range(100) if KINDS[seed % len(KINDS)] == kind][:3]
    for seed in seeds:
        case = problem(seed)
        found = solved(case)
        assert found.converged
        assert any(result.pressure.any() for result in found.results)
        assert max(check.ratio for check in equations(case, damaged(found, 0.02))) > 10.0, seed


def test_failures_name_what_is_wrong() -> None:
    verdicts = list(all_judged(range(20)))
    assert failures(verdicts) == []
    false = replace(verdicts[0], outcome="false", cause="balance of force")
    refused = replace(verdicts[1], outcome="refused", cause="NoSolutionError: load")
    found = failures([false, refused, *verdicts[2:]])
    assert [text.split(":")[0] for text in found] == ["seed 0 (normal)", "1 of 20 refused or not converged"]
    assert "| layered | refused | NoSolutionError: load | 1 |" in table([false, refused, *verdicts[2:]])
    assert any(text.startswith("too few") for text in failures(verdicts[:9] * 3))


def test_all_controls_boundaries_and_laws_come_up() -> None:
    cases = [problem(seed) for seed in range(1000)]
    controls = {type(step.normal) for case in cases for step in case.steps}
    assert controls == {
        *(asp.MeanPressure, asp.Force, asp.Approach, asp.MeanGap, asp.Unloaded, asp.Pull, asp.FixedGrips)
    }
    assert {type(step.tangential) for case in cases for step in case.steps} == {
        *(type(None), asp.Shift, asp.TangentialForce)
    }
    assert {type(case.problem.boundary) for case in cases} == {asp.Periodic, asp.Free, asp.FreeLine}
    assert len({type(case.problem.adhesion) for case in cases}) == 8
    assert {type(case.problem.friction) for case in cases} == {
        *(type(None), asp.Coulomb, asp.TrescaFriction, asp.FullStick)
    }
    loads = [
        step.normal.value / case.problem.contact_modulus
        for case in cases
        for step in case.steps
        if isinstance(step.normal, asp.MeanPressure)
    ]
    assert np.log10(max(loads) / min(loads)) > 14.0
