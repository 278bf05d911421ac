"""Stick and slip asked for by a document: forces, areas, slip and heat in numbers, figures and
words."""

from __future__ import annotations

import math
from typing import Any, ClassVar, Literal

import numpy as np

from ...contact.controls import Control, Step, as_step
from ...contact.history import HistoryResult
from ...contact.problem import ContactProblem
from ...contact.tangential import Shift, TangentialForce
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Solved, Table, Words, Work
from ...plots.picture import Figure, figures_by
from .answer import StickSlip as Outcome
from .figures import LOOP_PLOTS, SHEAR_PLOTS
from .fretting import SHEAR_SCALARS, loop_of, shear_numbers
from .linearised import contraction_factor, tangential_stiffness
from .part_stick_slip import LINEAR, Sheared

COARSE = 0.1
"""Share of the tangential work lost to the length of the steps above which that is a finding."""


class StickSlipWork(Work):
    """Shear tractions within the bound of friction: where the surfaces stick, where they slip, and
    the heat: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = Outcome.citation_keys

    def check(self, ask: Sheared, problem: ContactProblem) -> None:
        """Refuse a twist of a contact that repeats."""
        settings = ask.settings
        if any(problem.boundary.wraps) and (settings.twist or any(step.twist for step in settings.history)):
            raise InputError(
                f"twist must be left out for the boundary {problem.boundary.name}, where the contact repeats, "
                "but is given. "
                "Choose {boundary.kind=free}."
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
        stiffness = factor = math.nan
        if solved.result.pressure.any():
            # along the shift, or where there is none along the force or x
            ways = ((found.shift_x, found.shift_y), (found.force_x, found.force_y), (1.0, 0.0))
            way = next(pair for pair in ways if math.hypot(*pair) > 0.0)
            stiffness = tangential_stiffness(solved.result).along(*way)
            factor = contraction_factor(solved.result)
        linear = dict(zip((item.name for item in LINEAR), (stiffness, factor), strict=True))
        values = {**shear_numbers(solved.result), "cycle_dissipation": last, **linear}
        steps = (solved.result,) if solved.path is None else solved.path.steps
        made = []
        sliding = sum(step.contact.any() and step.require_stick_slip().slipping[step.contact].all() for step in steps)
        if sliding:
            fact = (
                f"All points slide in {sliding} of {len(steps)} steps: the tangential force is all that friction bears."
            )
            made.append(Advice("note", "gross sliding", fact, numbers={"sliding": float(sliding), "steps": len(steps)}))
        if solved.path is not None and len(steps) > 2:
            # share of the tangential work that the length of the steps takes
            balance = solved.path.energies
            work = float(abs(balance.tangential_work).max())
            lost = abs(float(balance.step_work[-1])) / work if work > 0.0 else 0.0
            if lost > COARSE:
                fact = (
                    f"The length of the steps takes {percent(lost)} of the tangential work, which is "
                    "neither stored nor heat."
                )
                remedy = "Take more steps ({shear.steps}; of time, {viscoelastic.steps}) where slip reverses or turns."
                numbers, concerns = (
                    {"share": lost, "largest": COARSE},
                    ("dissipated", "total_dissipated", "cycle_dissipation"),
                )
                made.append(Advice("note", "length of the steps", fact, remedy, numbers, concerns))
        if factor > 0.0:  # where shear changes the pressure the two settle in turn
            certificate = solved.result.certificate
            check = next((item for item in certificate.couplings if item.name == "stick_slip"), None)
            met = "" if check is None else f" After {certificate.rounds} rounds it was {check.residual:.1e}."
            text = f"A round between pressure and shear multiplies their error by {factor:.2g}"
            remedy, numbers = "", {"factor": factor, "largest": 1.0}
            if factor >= 1.0:
                text += ": the alternation does not contract, and the solution found may be one of several"
                remedy = (
                    "Lower the friction coefficient ({friction.coefficient}), or follow the path in "
                    "smaller steps ({shear.steps})."
                )
            level: Literal["note", "warning"] = "warning" if factor >= 1.0 else "note"
            made.append(Advice(level, "contraction of pressure and shear", f"{text}.{met}", remedy, numbers))
        return Found(values, None, tuple(made), found.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of stick and slip, of the heat, section, and the loop of a history."""
        if solved.path is None or len(solved.path.steps) < 2:
            return figures_by(SHEAR_PLOTS, solved.result)
        return (*figures_by(SHEAR_PLOTS[:2], solved.result), *figures_by(LOOP_PLOTS, solved.path))

    def words(self, found: Found, solved: Solved) -> Words:
        """Shares of the area, forces, heat; steps and cycles of a history."""
        result, path = solved.result, solved.path
        contact, numbers = result.require_stick_slip(), shear_numbers(result)
        loop = None if path is None or len(path.steps) < 2 else loop_of(path.steps)
        cycle = None if loop is None or not loop.cycles else show(float(loop.cycle_energies[-1]), "J", 3)
        tables: list[tuple[str, Table]] = []
        if path is not None and loop is not None:
            if loop.cycles:
                cells = []
                for number, ((first, last), lost) in enumerate(
                    zip(loop.cycles, loop.cycle_energies, strict=True), start=1
                ):
                    shift, forces = loop.shift[first : last + 1], loop.force[first : last + 1]
                    ranges = (
                        f"{show(float(v.min()), unit, 4)} to {show(float(v.max()), unit, 4)}"
                        for v, unit in ((shift, "m"), (forces, "N"))
                    )
                    cells.append((str(number), f"{first + 1} to {last + 1}", *ranges, show(float(lost), "J", 4)))
                tables.append(("Cycles", Table(("Cycle", "Steps", "Shift", "Tangential force", "Heat"), tuple(cells))))
            tables.append(("Steps", step_table(path)))

        share = numbers["slip_area_fraction"]
        slips = "All of the contact slides" if share == 1.0 else f"{percent(share)} of the contact area slips"
        if share == 0.0:
            slips = "All of the contact sticks"
        heat = f"has dissipated {show(numbers['total_dissipated'], 'J', 3)}"
        sentence = f"{slips}; friction {heat if cycle is None else f'dissipates {cycle} a cycle'}."
        if math.isnan(share):
            sentence = "The surfaces do not touch: there is no friction."

        force = show(math.hypot(numbers["force_x"], numbers["force_y"]), "N")
        headline = [("slipping / real contact area", _share(share)), ("tangential force", force)]
        if cycle is not None:
            headline.append(("heat of a cycle", cycle))

        control = contact.tangential
        unit, twist = "m" if control.name == "shift" else "N", getattr(control, "twist", 0.0)
        turned = f", twist {math.degrees(twist):.4g}°" if twist else ""
        prescribed = f"{show(control.x, unit)} along x, {show(control.y, unit)} along y{turned}"
        rows = [("friction", law_text(contact.law)), (f"prescribed {control.name}", prescribed)]
        for item in SHEAR_SCALARS:
            value = numbers[item.name]
            if math.isfinite(value) and not (item.name in ("torque", "twist") and any(result.problem.boundary.wraps)):
                rows.append((item.label, value_text(item, value)))
        for check in result.certificate.couplings:
            if check.name == "stick_slip":
                rows.append(("change from round to round of pressure and shear", f"factor {check.rate:.2g}"))
        for item in LINEAR:
            if math.isfinite(value := found.values.get(item.name, math.nan)):
                rows.append((item.label, value_text(item, value)))
        return Words(sentence, headline, rows, tuple(tables), (REMARK,))


REMARK = (
    "A point sticks while its shear traction is below the bound of the friction, and slips along its traction "
    "at the bound. Steps are implicit: slip that turns or reverses within a step is seen at its end only."
)
"""What the model is."""


def _share(value: float) -> str:
    return "–" if math.isnan(value) else percent(value)


def law_text(law: Any) -> str:
    """The law of friction with its numbers."""

    def span(values: Any, unit: str) -> str:
        low, high = float(np.min(values)), float(np.max(values))
        return show(low, unit) if low == high else f"{show(low, unit)} to {show(high, unit)}, by point"

    if hasattr(law, "coefficient"):
        limit = f", at most {show(law.limit, 'Pa')}" if math.isfinite(law.limit) else ""
        return f"{law.name}, coefficient {span(law.coefficient, '1')}{limit}"
    return f"{law.name}, {span(law.strength, 'Pa')}" if hasattr(law, "strength") else str(law.name)


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
