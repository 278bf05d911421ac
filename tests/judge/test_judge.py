"""Random problems over all physics: what is called converged fulfils its equations, and nearly all
are solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from judge.checks import LARGEST_RATIO
from judge.equations import equations
from judge.judge import Verdict, all_judged, failures, table
from judge.problems import KINDS, Case, problem
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


Damage = Callable[[asp.ContactResult], asp.ContactResult]


def highest(result: asp.ContactResult) -> asp.ContactResult:
    """The point that bears most bears 2 % more."""
    pressure = np.array(result.pressure, dtype=float)
    pressure[np.unravel_index(np.argmax(pressure), pressure.shape)] *= 1.02
    return replace(result, pressure=pressure)


def coupled(name: str, **factors: float) -> Damage:
    """Damage by which fields of what the coupling ``name`` found are multiplied."""

    def damage(result: asp.ContactResult) -> asp.ContactResult:
        found = result.couplings[name]
        changed = replace(found, **{key: factor * getattr(found, key) for key, factor in factors.items()})
        return replace(result, couplings={**result.couplings, name: changed})

    return damage


def strained(result: asp.ContactResult) -> asp.ContactResult:
    """Plastic strain is 1 % too large."""
    found = result.require_plastic_flow()
    state = replace(found.flowed.state, plastic_strain=1.01 * found.flowed.state.plastic_strain)
    changed = replace(found, flowed=replace(found.flowed, state=state))
    return replace(result, couplings={**result.couplings, "plastic_flow": changed})


DAMAGES: list[tuple[str, str, Damage]] = [
    ("normal", "balance of force", lambda r: replace(r, pressure=1.0001 * np.asarray(r.pressure))),
    ("normal", "pressure not negative", lambda r: replace(r, pressure=np.asarray(r.pressure) - 1e-9 * r.max_pressure)),
    ("normal", "elastic energy", lambda r: replace(r, elastic_energy=1.001 * r.elastic_energy)),
    ("normal", "stated gap", lambda r: replace(r, approach=1.01 * r.approach)),
    ("hardness", "no healing", lambda r: replace(r, permanent_indentation=-0.01 * r.permanent_indentation)),
    ("hardness", "plastic work", lambda r: replace(r, plastic_work=1.001 * r.plastic_work)),
    ("hardness", "pressure below the hardness", lambda r: replace(r, pressure=1.001 * np.asarray(r.pressure))),
    ("wet", "force of the menisci", coupled("menisci", meniscus_force=1.01)),
    ("adhesive", "law of adhesion", coupled("adhesion", attraction=1.01)),
    ("adhesive", "elastic energy", coupled("adhesion", elastic_energy=1.001)),
    ("adhesive", "energy of the interface", coupled("adhesion", interface_energy=1.001)),
    ("stick-slip", "friction cone", coupled("stick_slip", traction=1.01)),
    ("stick-slip", "friction law", coupled("stick_slip", shift_x=1.05, shift_y=1.05)),
    ("stick-slip", "heat of slip", coupled("stick_slip", dissipated=1.01)),
    ("in time", "displacement in time", lambda r: replace(r, displacement=1.001 * np.asarray(r.displacement))),
    ("in time", "heat", coupled("creep", dissipated=1.01)),
    ("plastic flow", "return mapping", strained),
]
"""Physics, the equation that sees it, and what is wrong."""


def cases_of(kind: str, seeds: range) -> list[Case]:
    return [problem(seed) for seed in seeds if KINDS[seed % len(KINDS)] == kind]


@pytest.mark.parametrize(
    ("kind", "equation", "damage"), DAMAGES, ids=lambda value: value if isinstance(value, str) else ""
)
def test_every_equation_sees_what_it_is_for(kind: str, equation: str, damage: Damage) -> None:
    seen = []
    for case in cases_of(kind, range(240)):
        found = solved(case)
        wrong = Solved(tuple(map(damage, found.results)))
        if kind == "stick-slip" and any(result.stick_slip is None for result in found.results):
            continue
        seen = [check for check in equations(case, wrong) if check.name == equation and check.ratio > LARGEST_RATIO]
        if seen:
            assert not [check for check in equations(case, found) if check.name == equation and check in seen]
            return
    pytest.fail(f"{equation} was not seen to be wrong")


@pytest.mark.parametrize("damage", [{"traction": 1.01}, {"traction": 0.9}, {"dissipated": 1.001}], ids=str)
def test_equations_of_rolling_see_what_is_wrong(damage: dict[str, float]) -> None:
    case = cases_of("rolling", range(20))[0]
    found = solved(case).rolling
    assert found is not None
    wrong = replace(found, **{name: factor * getattr(found, name) for name, factor in damage.items()})
    assert max(check.ratio for check in equations(case, Solved((found.normal,), wrong))) > LARGEST_RATIO


@pytest.mark.parametrize("kind", dict.fromkeys(KINDS))
def test_a_wrong_pressure_is_seen(kind: str) -> None:
    for case in cases_of(kind, range(100))[:3]:
        found = solved(case)
        assert found.converged
        wrong = tuple(map(highest, found.results))
        rolling = found.rolling if found.rolling is None else replace(found.rolling, normal=wrong[0])
        assert max(check.ratio for check in equations(case, Solved(wrong, rolling))) > LARGEST_RATIO, case.seed


def test_failures_name_what_is_wrong() -> None:
    right = [Verdict(seed, KINDS[seed % len(KINDS)], "right") for seed in range(60)]
    assert failures(right) == []
    false = replace(right[0], outcome="false", cause="balance of force")
    refused = [replace(each, outcome="refused", cause="NoSolutionError: load") for each in right[1:3]]
    found = failures([false, *refused, *right[3:]])
    assert [text.split(":")[0] for text in found] == ["seed 0 (normal)", "2 of 60 refused or not converged"]
    assert "| layered | refused | NoSolutionError: load | 1 |" in table([false, *refused, *right[3:]])
    assert [text for text in failures(right[:5] * 12) if text.startswith("too few")]


def test_all_controls_boundaries_and_laws_come_up() -> None:
    cases = [problem(seed) for seed in range(1000)]
    controls = {type(step.normal) for case in cases for step in case.steps}
    assert controls == {
        *(asp.MeanPressure, asp.Force, asp.Approach, asp.MeanGap, asp.Unloaded, asp.contact.Pull, asp.FixedGrips)
    }
    assert {type(step.tangential) for case in cases for step in case.steps} == {
        *(type(None), asp.Shift, asp.TangentialForce)
    }
    assert {type(case.problem.boundary) for case in cases} == {asp.Periodic, asp.Free, asp.FreeLine}
    assert len({type(case.problem.adhesion) for case in cases}) == 8
    assert {type(case.problem.friction) for case in cases} == {
        *(type(None), asp.Coulomb, asp.friction.TrescaFriction, asp.friction.FullStick)
    }
    loads = [
        step.normal.value / case.problem.contact_modulus
        for case in cases
        for step in case.steps
        if isinstance(step.normal, asp.MeanPressure)
    ]
    assert np.log10(max(loads) / min(loads)) > 14.0


@pytest.mark.parametrize("seed", [3484, 4573, 5553])
def test_steps_that_seem_to_make_energy_state_that_as_error(seed: int) -> None:
    """Of an edge without range, or beside a hardness, the trapezium may miss more than half of ΔF
    Δδ: what it finds made is its error."""
    case = problem(seed)
    for step in asp.solve(case.problem, asp.History(case.steps)):
        found = step.require_adhesion()
        scale = abs(found.elastic_energy) + abs(found.interface_energy)
        assert found.dissipated + found.dissipated_error >= -1e-12 * scale
