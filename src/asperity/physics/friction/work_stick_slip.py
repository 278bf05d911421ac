"""Stick and slip asked for by a document: forces, areas, slip and heat in numbers, figures and words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ...contact.controls import Control, Step, as_step
from ...contact.history import EnergyBalance, HistoryResult
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.tangential import Shift, Tangential, TangentialForce
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, Words, Work
from ...plots.picture import Figure, figures_by
from .answer import StickSlip as Outcome
from .figures import LOOP_PLOTS, SHEAR_PLOTS
from .fretting import SHEAR_SCALARS, Loop, loop_of, shear_numbers
from .linearised import contraction_factor, tangential_stiffness
from .part_stick_slip import LINEAR, Sheared

COARSE = 0.1
"""Share of the tangential work lost to the length of the steps above which that is a finding."""


class StickSlipWork(Work):
    """Shear tractions within the bound of friction: where the surfaces stick, where they slip, and the heat: what is done for it."""

    def check(self, ask: Sheared, problem: ContactProblem) -> None:
        """Refuse a twist of a contact that repeats."""
        settings = ask.settings
        if any(problem.boundary.wraps) and (settings.twist or any(step.twist for step in settings.history)):
            raise InputError(
                f"twist must be left out for the boundary {problem.boundary.name}, where the contact repeats, but is given. "
                'Choose boundary.kind = "free" (--boundary free).'
            )

    def course(self, ask: Sheared, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The load with no shift, then the steps along the surface."""
        settings, last = ask.settings, as_step(controls[-1]).normal
        if settings.history:
            found: list[Step | Control] = list(controls[:-1])
            for wanted in settings.history:
                last = wanted.normal(last)
                found.append(Step(last, wanted.tangential(ask.direction)))
            return tuple(found)
        rest = TangentialForce() if settings.force is not None else Shift()
        pressed = tuple(Step(as_step(control).normal, rest) for control in controls)
        return (*pressed, *(Step(last, control) for control in settings.controls(ask.direction)))

    def compute(self, ask: Sheared, solved: Solved) -> Found:
        """Scalars of the last step, and of the last cycle."""
        found = solved.result.require_stick_slip()
        loop = None if solved.path is None else loop_of(solved.path.steps)
        last = math.nan if loop is None or not loop.cycles else float(loop.cycle_energies[-1])
        stiffness, factor = _linearised(solved.result)
        linear = dict(zip((item.name for item in LINEAR), (stiffness, factor), strict=True))
        values = {**shear_numbers(solved.result), "cycle_dissipation": last, **linear}
        return Found(values, None, (*_findings(solved), *_contraction(solved.result, factor)), found.citation_keys)

    def citations(self, ask: Sheared, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of law and method."""
        return Outcome.citation_keys

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of stick and slip, of the heat, section, and the loop of a history."""
        if solved.path is None or len(solved.path.steps) < 2:
            return figures_by(SHEAR_PLOTS, solved.result)
        return (*figures_by(SHEAR_PLOTS[:2], solved.result), *figures_by(LOOP_PLOTS, solved.path))

    def words(self, found: Found, solved: Solved) -> Words:
        """Shares of the area, forces, heat; steps and cycles of a history."""
        words = shear_words(solved.result, solved.path)
        return replace(words, rows=[*words.rows, *_linear_rows(found.values)])


def _findings(solved: Solved) -> tuple[Advice, ...]:
    """Gross sliding, steps that are too coarse, and a coupling that barely contracts."""
    steps = (solved.result,) if solved.path is None else solved.path.steps
    made = []
    sliding = [number for number, step in enumerate(steps, start=1) if _slides(step)]
    if sliding:
        text = f"All points slide in {len(sliding)} of {len(steps)} steps: the tangential force is all that friction bears."
        made.append(Advice("note", "gross sliding", text))
    if solved.path is not None and len(steps) > 2:
        lost = _lost(solved.path.energies)
        if lost > COARSE:
            text = (
                f"The length of the steps takes {percent(lost)} of the tangential work, which is neither stored nor heat. Take more steps "
                "(shear.steps, --cycle-steps; of time, --time-steps) where slip reverses or turns."
            )
            made.append(Advice("note", "length of the steps", text))
    return tuple(made)


def _linearised(result: ContactResult) -> tuple[float, float]:
    """Tangential stiffness along the shift, or where there is none along the force or x, and contraction factor."""
    if not result.pressure.any():
        return math.nan, math.nan
    found = result.require_stick_slip()
    ways = ((found.shift_x, found.shift_y), (found.force_x, found.force_y), (1.0, 0.0))
    way = next(pair for pair in ways if math.hypot(*pair) > 0.0)
    return tangential_stiffness(result).along(*way), contraction_factor(result)


def _contraction(result: ContactResult, factor: float) -> tuple[Advice, ...]:
    """How pressure and shear settle in turn, where shear changes the pressure."""
    if not factor > 0.0:
        return ()
    check = next((item for item in result.certificate.couplings if item.name == "stick_slip"), None)
    met = "" if check is None else f" After {result.certificate.rounds} rounds it was {check.residual:.1e}."
    if factor >= 1.0:
        text = (
            f"A round between pressure and shear multiplies their error by {factor:.2g}: the alternation does not contract, and the "
            f"solution found may be one of several.{met} Lower the friction coefficient, or follow the path in smaller steps."
        )
        return (Advice("warning", "contraction of pressure and shear", text),)
    text = f"A round between pressure and shear multiplies their error by {factor:.2g}.{met}"
    return (Advice("note", "contraction of pressure and shear", text),)


def _linear_rows(values: Mapping[str, float]) -> Rows:
    shown = [item for item in LINEAR if math.isfinite(values.get(item.name, math.nan))]
    return [(item.label, value_text(item, values[item.name])) for item in shown]


def _slides(step: ContactResult) -> bool:
    found = step.require_stick_slip()
    return bool(step.contact.any() and found.slipping[step.contact].all())


def _lost(balance: EnergyBalance) -> float:
    """Share of the tangential work that the length of the steps takes."""
    work = float(abs(balance.tangential_work).max())
    return abs(float(balance.step_work[-1])) / work if work > 0.0 else 0.0


def shear_words(result: ContactResult, path: HistoryResult | None) -> Words:
    """Sentence, scalars, cycles and steps."""
    loop = None if path is None or len(path.steps) < 2 else loop_of(path.steps)
    tables: list[tuple[str, Table]] = []
    if path is not None and loop is not None:
        if loop.cycles:
            tables.append(("Cycles", cycle_table(loop)))
        tables.append(("Steps", step_table(path)))
    return Words(
        shear_sentence(result, loop), headline_rows(result, loop), shear_rows(result), tuple(tables), (REMARK,)
    )


REMARK = (
    "A point sticks while its shear traction is below the bound of the friction, and slips along its traction at the bound. Steps are "
    "implicit: slip that turns or reverses within a step is seen at its end only."
)
"""What the model is."""


def shear_sentence(result: ContactResult, loop: Loop | None) -> str:
    """One sentence on what slips, and what that dissipates."""
    numbers = shear_numbers(result)
    share = numbers["slip_area_fraction"]
    if math.isnan(share):
        return "The surfaces do not touch: there is no friction."
    slips = "All of the contact slides" if share == 1.0 else f"{percent(share)} of the contact area slips"
    if share == 0.0:
        slips = "All of the contact sticks"
    if loop is not None and loop.cycles:
        return f"{slips}; friction dissipates {show(float(loop.cycle_energies[-1]), 'J', 3)} a cycle."
    return f"{slips}; friction has dissipated {show(numbers['total_dissipated'], 'J', 3)}."


def headline_rows(result: ContactResult, loop: Loop | None) -> Rows:
    """Slipping area, tangential force and heat of a cycle."""
    numbers = shear_numbers(result)
    force = math.hypot(numbers["force_x"], numbers["force_y"])
    rows = [
        ("slipping / real contact area", _share(numbers["slip_area_fraction"])),
        ("tangential force", show(force, "N")),
    ]
    if loop is not None and loop.cycles:
        rows.append(("heat of a cycle", show(float(loop.cycle_energies[-1]), "J", 3)))
    return rows


def _share(value: float) -> str:
    return "–" if math.isnan(value) else percent(value)


def shear_rows(result: ContactResult) -> Rows:
    """Law, what is prescribed, every scalar, and how well the coupling with the pressure contracts."""
    found, numbers = result.require_stick_slip(), shear_numbers(result)
    rows = [("friction", law_text(found.law)), (f"prescribed {found.tangential.name}", control_text(found.tangential))]
    for item in SHEAR_SCALARS:
        value = numbers[item.name]
        if math.isfinite(value) and not (item.name in ("torque", "twist") and any(result.problem.boundary.wraps)):
            rows.append((item.label, value_text(item, value)))
    for check in result.certificate.couplings:
        if check.name == "stick_slip":
            rows.append(("change from round to round of pressure and shear", f"factor {check.rate:.2g}"))
    return rows


def law_text(law: Any) -> str:
    """The law of friction with its numbers."""

    def span(values: Any, unit: str) -> str:
        low, high = float(np.min(values)), float(np.max(values))
        return show(low, unit) if low == high else f"{show(low, unit)} to {show(high, unit)}, by point"

    if hasattr(law, "coefficient"):
        limit = f", at most {show(law.limit, 'Pa')}" if math.isfinite(law.limit) else ""
        return f"{law.name}, coefficient {span(law.coefficient, '1')}{limit}"
    return f"{law.name}, {span(law.strength, 'Pa')}" if hasattr(law, "strength") else str(law.name)


def control_text(control: Tangential) -> str:
    """Components of a shift or tangential force."""
    unit = "m" if control.name == "shift" else "N"
    twist = getattr(control, "twist", 0.0)
    turned = f", twist {math.degrees(twist):.4g}°" if twist else ""
    return f"{show(control.x, unit)} along x, {show(control.y, unit)} along y{turned}"


def cycle_table(loop: Loop) -> Table:
    """Steps, range and heat of every closed cycle."""
    cells = []
    for number, ((first, last), heat) in enumerate(zip(loop.cycles, loop.cycle_energies, strict=True), start=1):
        shift, force = loop.shift[first : last + 1], loop.force[first : last + 1]
        ranges = (
            f"{show(float(v.min()), unit, 4)} to {show(float(v.max()), unit, 4)}"
            for v, unit in ((shift, "m"), (force, "N"))
        )
        cells.append((str(number), f"{first + 1} to {last + 1}", *ranges, show(float(heat), "J", 4)))
    return Table(("Cycle", "Steps", "Shift", "Tangential force", "Heat"), tuple(cells))


def step_table(path: HistoryResult) -> Table:
    """Load, shift, force, slipping share and heat of every step."""
    loop, cells = loop_of(path.steps), []
    for number, step in enumerate(path.steps):
        numbers = shear_numbers(step)
        cells.append(
            (
                str(number + 1),
                show(step.mean_pressure, "Pa", 4),
                show(float(loop.shift[number]), "m", 4),
                show(float(loop.force[number]), "N", 4),
                _share(numbers["slip_area_fraction"]),
                show(numbers["dissipated"], "J", 3),
                "converged" if step.converged else "NOT CONVERGED",
            )
        )
    headings = ("Step", "Mean pressure", "Shift", "Tangential force", "Slips", "Heat", "Status")
    return Table(headings, tuple(cells))
