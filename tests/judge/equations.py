"""Equations of every physics, evaluated from the fields of results with operators in double
precision, beside what the results state of their error."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from judge import history, interface, normal, shear
from judge.checks import Check, norm
from judge.normal import Pressed
from judge.problems import Case
from judge.solved import Solved

import asperity as asp
from asperity.contact.operators import Operator, prepare_operator
from asperity.physics.friction.operator import TangentialOperator


def equations(case: Case, found: Solved) -> list[Check]:
    """Checks of every step of a ``case`` that was solved."""
    problem = case.problem
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=asp.engines.CpuEngine(1))
    if case.rolled is not None:
        return _rolled(case, found, operator)
    if case.kind == "in time":
        return _in_time(case, found.results, operator)
    along = shear.operator_of(problem) if case.kind == "stick-slip" else None
    checks: list[Check] = []
    for step, (before, result) in zip(case.steps, pairwise((None, *found.results)), strict=True):
        assert result is not None
        checks += _of_step(step, (before, result), operator, along)
    return checks


def _of_step(
    step: asp.Step,
    results: tuple[asp.ContactResult | None, asp.ContactResult],
    operator: Operator,
    along: TangentialOperator | None,
) -> list[Check]:
    """Checks of the result of ``step``, the second of ``results``, beside the one before it;
    ``along`` is the compliance along the surface."""
    before, result = results
    none = np.zeros(result.problem.grid.shape)
    dented = none if before is None else np.asarray(before.permanent_indentation, dtype=float)
    of = Pressed(result, operator, none, before=dented)
    if result.adhesion is not None:
        attraction = result.require_adhesion().attraction
        return interface.adhesion(replace(of, lift=-operator.apply(attraction)), step.normal)
    if along is not None:
        if result.stick_slip is None:
            lift, checks = shear.sliding(along, result)
            return [*_pressed(replace(of, lift=lift, lift_error=shear.SLIDING * norm(lift)), step.normal), *checks]
        lift, error = along.lift(result.require_stick_slip().traction), shear.lift_error(along, result)
        lifted = replace(of, lift=lift, lift_error=error)
        return [*_pressed(lifted, step.normal), *shear.stick_slip(along, result, before, step.tangential)]
    if result.plastic_flow is not None:
        imprint = result.require_plastic_flow().displacement
        return [*_pressed(replace(of, imprint=imprint), step.normal), *history.plastic_flow(result, before)]
    if result.menisci is not None:
        checks = [*normal.bounds(of), *normal.complementarity(of), *normal.gaps(of)]
        if isinstance(step.normal, asp.Approach | asp.MeanGap):
            checks += normal.load(of, step.normal)
        return [*checks, *interface.menisci(of, step.normal)]
    return _pressed(of, step.normal)


def _pressed(of: Pressed, control: object) -> list[Check]:
    """What holds for every contact without attraction."""
    return [
        *normal.bounds(of),
        *normal.complementarity(of),
        *normal.gaps(of),
        *normal.load(of, control),
        *normal.yielding(of),
        *normal.elastic_energy(of),
    ]


def _rolled(case: Case, found: Solved, operator: Operator) -> list[Check]:
    rolling = found.rolling
    assert rolling is not None
    assert case.rolled is not None
    along = shear.operator_of(case.problem)
    lift = along.lift(rolling.traction)
    of = Pressed(rolling.normal, operator, lift, 1e-4 * float(np.linalg.norm(lift)))
    checks = shear.rolling(along, rolling, transient=case.rolled.method == "transient")
    return [*_pressed(of, case.steps[0].normal), *checks]


def _in_time(case: Case, results: tuple[asp.ContactResult, ...], operator: Operator) -> list[Check]:
    body = case.problem.body
    assert isinstance(body, asp.Viscoelastic)
    past, checks = history.Remembered.virgin(body, case.problem.grid.shape), list[Check]()
    for step, result in zip(case.steps, results, strict=True):
        assert result.creep is not None
        times = result.creep.time
        length = float(times[-1] - times[-2])
        factor = past.factor(length)
        lift = np.asarray(result.creep.retarded_displacement, dtype=float)
        if case.time_steps.number == 1:
            whole, past, found = history.in_time(operator, past, result, step.duration)
            checks += found
            lift = whole - factor * operator.apply(np.asarray(result.pressure, dtype=float))
        of = Pressed(result, operator, lift, factor=factor)
        checks += [*normal.bounds(of), *normal.complementarity(of), *normal.gaps(of), *normal.load(of, step.normal)]
    return [*checks, *history.energy_in_time(results)]
