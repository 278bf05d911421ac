"""A long step of an adhesive contact, divided by the range of the attraction so that the contact
stays on its branch.

Newton's method and the descent of the energy find the equilibrium downhill from where they start. A
step of more than about a range may start behind the ridge that ends another branch. Parts of half a
range follow the branch. A part whose work does not agree with the change of the energy is divided
further, to an eighth of the range; where both agree and the bodies are pressed together parts grow.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from ...contact.controls import Approach, Control, FixedGrips, Force, MeanGap, Pull, Unloaded, mean_pressure
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.state import InterfaceState
from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from .law import Adhesion, SoftAdhesion, cohesive_length

Solved = Callable[[Control, InterfaceState | None], ContactResult]
"""Contact under a control, started from a state."""

PART = 0.5
"""Longest part over the range, or over the least gap where that is more: a Lennard-Jones contact of
Tabor's parameter 1.5 kept its branch with 0.9."""

_SMOOTH = 0.04
"""Share of |ΔF Δδ| by which the trapezoidal work of a smooth part may miss the change of the
energy; a parabola misses less."""

_LEVEL = 0.005
"""Share of |F Δδ| that it may miss besides, for at the largest pull ΔF is zero."""

_REFINED = 0.25
"""Smallest part over the longest: a jump is closed in to that, since a part across the largest pull
looks like one."""

_SHARES = 1.0 / 32.0
"""Smallest part of a step of force, whose jumps have no smallest length."""


@dataclass(frozen=True, eq=False)
class _Way:
    """From where the step begins, ``start``, to its ``end`` (m or N), under controls ``at`` each
    value; ``force`` if that is prescribed."""

    start: float
    end: float
    at: Callable[[float], Control]
    force: bool = False


def divides(problem: ContactProblem, state: InterfaceState | None) -> bool:
    """Whether steps from ``state`` may be divided: adhesion of a finite range, and no physics
    beside it but a hardness or gross sliding.

    Where the cohesive length is less than a pixel single points snap, and there is no branch to
    follow.
    """
    if problem.adhesion is None or math.isinf(problem.adhesion.strength) or state is None:
        return False
    if cohesive_length(problem.adhesion, problem.contact_modulus) < max(problem.grid.pixels):
        return False
    alone = (
        all(item.keyword in ("adhesion", "friction") for item in problem.physics) and "stick_slip" not in state.memory
    )
    return alone and bool(state.memory.get("adhesion"))


def in_ranges(problem: ContactProblem, control: Control, state: InterfaceState, solved: Solved) -> ContactResult:
    """Result under ``control`` by parts, see the module; of one part where the step is no longer
    than that.

    Its losses, jumps and work are those of all parts. Where a part has no solution or does not
    converge, the whole step is solved at once, so that errors name what was asked for.
    """
    law = problem.adhesion
    assert law is not None
    way = _way_of(problem, control, state.memory["adhesion"])
    at, done, share = state, 0.0, _part(way, law, state.memory["adhesion"])
    if share >= 1.0 and not way.force:
        return solved(control, state)
    found: list[ContactResult] = []
    while done < 1.0:
        known = at.memory["adhesion"]
        longest = _part(way, law, known)
        least = _SHARES if way.force else _REFINED * longest
        share = min(share, 1.0 - done)
        last = done + share >= 1.0 - 1e-9
        result: ContactResult | None = None
        with suppress(NoSolutionError):
            result = solved(control if last else way.at(way.start + (done + share) * (way.end - way.start)), at)
        if result is not None and not result.converged:
            result = None
        smooth = short = False
        if result is not None:
            # smooth: work by the trapezoidal rule and change of the energy agree as on a branch
            adhesive = result.require_adhesion()
            step, force = result.approach - float(known["approach"]), (adhesive.external_force, float(known["force"]))
            energy = adhesive.elastic_energy + adhesive.interface_energy - float(known["energy"]) + result.plastic_work
            missed = abs(0.5 * sum(force) * step - energy)
            allowed = _SMOOTH * abs((force[0] - force[1]) * step) + _LEVEL * max(map(abs, force)) * abs(step)
            smooth = not adhesive.jumped and missed <= allowed
            moved = abs(result.approach - float(known["approach"]))
            short = way.force and moved <= _length(law, known) and not result.require_adhesion().jumped
        if not (smooth or short) and share > least:
            share = max(0.5 * share, least)
            continue
        if result is None:  # a part of the smallest length did not converge
            return solved(control, state)
        found.append(result)
        at, done = result.state, 1.0 if last else done + share
        grows = smooth and (way.force or result.require_adhesion().external_force > 0.0 < float(known["force"]))
        share = 2.0 * share if grows else min(2.0 * share, longest)
    if len(found) == 1:
        return found[0]
    # the last part with losses, jumps and work of all of them
    final, parts = found[-1], [each.require_adhesion() for each in found]
    whole = replace(
        parts[-1].summed(parts[:-1]),
        steps=sum(part.steps for part in parts),
        newton_steps=sum(part.newton_steps for part in parts),
        fft_pairs=sum(part.fft_pairs for part in parts),
    )
    plastic = final.total_plastic_work - state.plastic_work
    return replace(final, plastic_work=plastic, couplings={**final.couplings, "adhesion": whole})


def _length(law: Adhesion, known: Mapping[str, RealArray]) -> float:
    """Longest part in m from an interface with the ``known`` gap."""
    return PART * max(law.range, float(known["gap"].min()) - law.spacing)


def _part(way: _Way, law: Adhesion, known: Mapping[str, RealArray]) -> float:
    """Longest part over the whole step of position."""
    whole = abs(way.end - way.start)
    return 1.0 if way.force or whole == 0.0 else min(_length(law, known) / whole, 1.0)


def _way_of(problem: ContactProblem, control: Control, known: Mapping[str, RealArray]) -> _Way:
    approach, force = float(known["approach"]), float(known["force"])
    if isinstance(control, FixedGrips):
        stiffness = control.stiffness
        return _Way(approach + force / stiffness, control.value, lambda value: FixedGrips(value, stiffness))
    if isinstance(control, Approach):
        return _Way(approach, control.value, FixedGrips)  # which may be apart
    if isinstance(control, MeanGap):
        law, gap = problem.adhesion, known["gap"]
        core = np.minimum(gap, law.peak) if isinstance(law, SoftAdhesion) and law.spacing > 0.0 else 0.0
        return _Way(float((gap - core).mean()), control.value, MeanGap)
    if isinstance(control, Pull):
        return _Way(force, -control.value, _loaded, force=True)
    end = 0.0 if isinstance(control, Unloaded) else mean_pressure(control, problem.grid) * problem.grid.area
    return _Way(force, end, _loaded, force=True)


def _loaded(force: float) -> Control:
    """Control of an external ``force`` in N of either sign."""
    if force == 0.0:
        return Unloaded()
    return Force(force) if force > 0.0 else Pull(-force)
