"""A step of load in which plastic flow does not settle, cut into parts, each from the state that
the one before left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ...contact.controls import Approach, Control, Force, MeanGap, MeanPressure, Unloaded
from ...contact.result import ContactResult
from ...contact.state import InterfaceState
from .answer import NAME

FINEST = 4
"""Times that a step is halved at most."""


def in_parts(
    control: Control,
    state: InterfaceState | None,
    failed: ContactResult,
    solved: Callable[[Control, InterfaceState | None], ContactResult],
) -> ContactResult:
    """Result under ``control`` by twice as many parts until all of them are ``solved``, and says
    so; ``failed``, of one step, if none are."""
    # in equal steps from the load or position of the state
    problem, profile = failed.problem, failed.problem.profile()
    mean, approach, gap = 0.0, 0.0, float(profile.max() - profile.mean())
    known = {} if state is None else state.memory.get(NAME, {})
    if "place" in known:
        mean, approach, gap = (float(value) for value in known["place"])
    elif state is not None:
        mean = float(state.pressure.mean())
    begin = {MeanPressure: mean, Force: mean * problem.grid.area, Approach: approach, MeanGap: gap, Unloaded: mean}
    kind = type(control)
    first = begin.get(kind, float(control.value))
    made = MeanPressure if kind is Unloaded else kind
    for count in (2**halved for halved in range(1, FINEST + 1)):
        values = [first + (control.value - first) * k / count for k in range(1, count)]
        parts = (*(made(value) for value in values if value > 0.0), control)  # type: ignore[call-arg]
        at, spent = state, 0
        for part in parts:
            result = solved(part, at)
            spent += result.require_plastic_flow().iterations
            if not result.converged:
                break
            at = result.state
        if result.converged:
            # with the plastic work and the iterates of all parts
            flow = result.require_plastic_flow()
            whole = replace(flow, step_work=flow.work - float(known.get("work", 0.0)), iterations=spent)
            message = (
                f"{result.status.message} Plastic flow did not settle in one step: the load was reached in "
                f"{len(parts)} equal parts."
            )
            status = replace(result.status, message=message)
            return replace(result, status=status, couplings={**result.couplings, NAME: whole})
    return failed
