"""Stick and slip: what is prescribed along the surfaces, and what it comes to in forces, areas, slip and heat."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import model_validator

from ...core import units
from ...core.errors import InputError, UnitError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.status import Advice
from ...core.units import percent, show
from ...core.values import Angle, Count, Number, SignedLength, Whole
from ...parts.part import Found, Part, Solved, Table, Words
from .part import sticks

if TYPE_CHECKING:
    from ...contact.controls import Control, Step
    from ...contact.history import HistoryResult
    from ...contact.problem import ContactProblem
    from ...contact.tangential import Tangential
    from ...plots.picture import Figure
    from .fretting import Loop

SignedForce: TypeAlias = Annotated[float, Number("force")]

KEYS = ("shift", "force", "twist")
"""What can be prescribed along the surfaces, one of them."""

LINEAR = (
    Quantity("tangential_stiffness", "N/m", "change of the tangential force / change of the shift along it"),
    Quantity("contraction_factor", "1", "reduction of what pressure and shear are off by a round between them"),
)
"""Numbers of the last step, linearised."""

USUAL_STEPS = 8
"""Steps from zero to the largest value where it turns, if not said otherwise; one where it does not."""

COARSE = 0.1
"""Share of the tangential work lost to the length of the steps above which that is a finding."""


class ShearStep(Settings):
    """One step: the load or position, that before if it is left out, and a shift or tangential force.

    One value is along the direction of the friction, two are along x and y. As text ``"50 MPa, 5 nm"``.
    """

    mean_pressure: Annotated[float, Number("pressure", above=0.0)] | None = None
    load: Annotated[float, Number("force", above=0.0)] | None = None
    approach: Annotated[float, Number("length", above=0.0)] | None = None
    shift: tuple[SignedLength, ...] | None = None
    force: tuple[SignedForce, ...] | None = None
    twist: Angle | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_line(cls, value: Any) -> Any:
        """Table of the step in text such as ``"50 MPa, 5 nm"`` or ``"1 mN, 5 nm, 2 nm"``: load or approach, then shift or force.

        The message lacks the name of the option or key at its beginning.
        """
        if not isinstance(value, str):
            return value
        first, *rest = (part.strip() for part in value.split(","))
        normal = _key_of(first, {"mean_pressure": "pressure", "load": "force", "approach": "length"})
        along = _key_of(rest[0], {"shift": "length", "force": "force", "twist": "angle"}) if rest else None
        if normal is None or (rest and along is None) or len(rest) > 2:
            raise InputError(
                f' must be a load and a shift or force, such as "50MPa,5nm" or "1mN,5nm,0nm", but is {value!r}.'
            )
        return {normal: first, **({} if along is None else {along: rest[0] if along == "twist" else rest})}

    @model_validator(mode="after")
    def _at_most_one(self) -> ShearStep:
        _require_at_most_one(self, ("mean_pressure", "load", "approach"))
        _require_at_most_one(self, KEYS)
        for key in KEYS[:2]:
            if getattr(self, key) is not None and len(getattr(self, key)) not in (1, 2):
                raise InputError(f".{key} must be one value along the friction, or two along x and y.")
        return self

    def normal(self, before: Control) -> Control:
        """Load or position of this step."""
        from ...contact.controls import Approach, Force, MeanPressure

        kinds: dict[str, Any] = {"mean_pressure": MeanPressure, "load": Force, "approach": Approach}
        chosen: Control = next(
            (kinds[key](value) for key in kinds if (value := getattr(self, key)) is not None), before
        )
        return chosen

    def tangential(self, direction: float) -> Tangential | None:
        """Shift or force of this step; None for that before."""
        for key in KEYS:
            value = getattr(self, key)
            if value is not None:
                return _control(key, value if isinstance(value, tuple) else (value,), direction)
        return None


def _key_of(text: str, kinds: dict[str, str]) -> str | None:
    """Key whose kind of quantity the unit in ``text`` is of."""
    for key, kind in kinds.items():
        try:
            units.parse(text, kind, "")
        except UnitError:
            continue
        return key
    return None


class ShearSettings(Settings):
    """What is prescribed along the surfaces after they are pressed: turning points of a shift, tangential force or twist.

    They are along the direction of the table [friction]. ``cycles`` run to the opposite of the last one and back. A list of
    ``history`` steps with load and shift of each takes the place of all that. With nothing the surfaces are pressed only.
    """

    shift: tuple[SignedLength, ...] | None = setting(
        None, option="--shift", help="Of the counter body along the friction, stick and slip: 5nm; 5nm,-5nm,5nm"
    )
    force: tuple[SignedForce, ...] | None = setting(
        None, option="--tangential-force", help="On the body along the friction, instead of a shift: 1mN"
    )
    twist: tuple[Angle, ...] | None = setting(
        None, option="--twist", help="Of the counter body about the normal, instead of a shift, for --boundary free"
    )
    cycles: Annotated[int, Whole(0)] = setting(0, option="--cycles", help="Closed cycles to the opposite and back")
    steps: Count | None = setting(
        None, option="--cycle-steps", help="Steps from zero to the largest shift; 8 where it turns, else 1"
    )
    history: tuple[ShearStep, ...] = setting(
        (), option="--step", help="Step of a history, load and shift: 50MPa,5nm. May be repeated"
    )

    @model_validator(mode="after")
    def _one(self) -> ShearSettings:
        given = _require_at_most_one(self, KEYS)
        if given and not getattr(self, given):
            raise InputError(f'.{given} must hold at least one turning point, such as "5 nm", but is empty.')
        if self.history and (given or self.cycles or self.steps):
            raise InputError(".history must be given alone, without shift, force, twist, cycles and steps.")
        if not given and (self.cycles or self.steps):
            raise InputError(
                " must give a shift, force or twist (--shift, --tangential-force, --twist) with its cycles and steps (--cycles, "
                "--cycle-steps), but gives none."
            )
        return self

    def controls(self, direction: float) -> tuple[Tangential, ...]:
        """What is prescribed in the steps after pressing."""
        key = next((key for key in KEYS if getattr(self, key) is not None), None)
        if key is None:
            return ()
        points = [0.0, *map(float, getattr(self, key))]
        points += [sign * points[-1] for _ in range(self.cycles) for sign in (-1.0, 1.0)]
        largest = max(map(abs, points))
        steps = self.steps or (USUAL_STEPS if len(points) > 2 else 1)
        found: list[Tangential] = []
        for start, end in itertools.pairwise(points):
            count = max(1, round(steps * abs(end - start) / largest)) if largest > 0.0 else 1
            shares = [number / count for number in range(1, count + 1)]
            found += [_control(key, (start * (1.0 - s) + end * s,), direction) for s in shares]
        return tuple(found)


def _require_at_most_one(table: Settings, keys: Sequence[str]) -> str | None:
    given = [key for key in keys if getattr(table, key) is not None]
    if len(given) > 1:
        raise InputError(f" must give at most one of {', '.join(keys)}, but gives {' and '.join(given)}.")
    return given[0] if given else None


def _control(key: str, values: Sequence[float], direction: float) -> Tangential:
    """The shift, force or twist with these ``values``: one along ``direction`` (rad), or along x and y."""
    from ...contact.tangential import Shift, TangentialForce

    if key == "twist":
        return Shift(twist=values[0])
    along = (values[0] * math.cos(direction), values[0] * math.sin(direction)) if len(values) == 1 else values
    x, y = (0.0 if abs(value) < 1e-15 * max(map(abs, along)) else float(value) for value in along)
    return (Shift if key == "shift" else TangentialForce)(x, y)


@dataclass(frozen=True)
class Sheared:
    """What is asked for along the surfaces, and the direction (rad) of the friction."""

    settings: ShearSettings
    direction: float


class StickSlip(Part):
    """Shear tractions within the bound of friction: where the surfaces stick, where they slip, and the heat."""

    name = "stick_slip"
    title = "Stick and slip"
    table = "shear"
    settings = ShearSettings
    whole_path = True
    of_result = "stick_slip"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of a step, and the heat of the last cycle."""
        from .fretting import SHEAR_SCALARS

        return (
            *SHEAR_SCALARS,
            Quantity("cycle_dissipation", "J", "energy dissipated by slip in the last closed cycle"),
            *LINEAR,
        )

    def settings_in(self, document: Any) -> ShearSettings | None:
        """The table [shear], an empty one where the law of friction asks for stick and slip."""
        found: ShearSettings | None = document.shear
        return ShearSettings() if found is None and sticks(document) else found

    def asked(self, document: Any, folder: Path) -> Sheared:
        """The table [shear] with the direction of the friction."""
        settings = self.settings_in(document) or ShearSettings()
        friction = document.friction
        if friction.law == "coulomb" and not friction.coefficient:
            raise InputError(
                "friction must be given together with a shift, tangential force or twist, but its coefficient is 0. Give "
                'friction.coefficient (--friction 0.3), or friction.law = "full stick" (--friction-law "full stick").',
                subject="friction",
            )
        return Sheared(settings, friction.direction)

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
        from ...contact.controls import Step, as_step
        from ...contact.tangential import Shift, TangentialForce

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
        from .fretting import loop_of, shear_numbers
        from .linearised import contraction_factor, tangential_stiffness

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
        return Found(values, None, _findings(solved, factor), found.citation_keys)

    def citations(self, ask: Sheared, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of law and method."""
        from .answer import StickSlip as Outcome

        return Outcome.citation_keys

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of stick and slip, of the heat, section, and the loop of a history."""
        from ...plots.picture import figures_by
        from .figures import LOOP_PLOTS, SHEAR_PLOTS

        if solved.path is None or len(solved.path.steps) < 2:
            return figures_by(SHEAR_PLOTS, solved.result)
        return (*figures_by(SHEAR_PLOTS[:2], solved.result), *figures_by(LOOP_PLOTS, solved.path))

    def words(self, found: Found, solved: Solved) -> Words:
        """Shares of the area, forces, heat; steps and cycles of a history."""
        from ...io.words import value_text
        from .fretting import SHEAR_SCALARS, loop_of, shear_numbers

        result, path = solved.result, solved.path
        contact, numbers = result.require_stick_slip(), shear_numbers(result)
        loop = None if path is None or len(path.steps) < 2 else loop_of(path.steps)
        cycle = None if loop is None or not loop.cycles else show(float(loop.cycle_energies[-1]), "J", 3)
        tables: list[tuple[str, Table]] = []
        if path is not None and loop is not None:
            if loop.cycles:
                tables.append(("Cycles", cycle_table(loop)))
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


def _findings(solved: Solved, factor: float) -> tuple[Advice, ...]:
    """Gross sliding, steps that are too coarse, and a coupling that barely contracts."""
    steps = (solved.result,) if solved.path is None else solved.path.steps
    made = []
    sliding = sum(step.contact.any() and step.require_stick_slip().slipping[step.contact].all() for step in steps)
    if sliding:
        text = f"All points slide in {sliding} of {len(steps)} steps: the tangential force is all that friction bears."
        made.append(Advice("note", "gross sliding", text))
    if solved.path is not None and len(steps) > 2:
        # share of the tangential work that the length of the steps takes
        balance = solved.path.energies
        work = float(abs(balance.tangential_work).max())
        lost = abs(float(balance.step_work[-1])) / work if work > 0.0 else 0.0
        if lost > COARSE:
            text = (
                f"The length of the steps takes {percent(lost)} of the tangential work, which is neither stored nor heat. Take more steps "
                "(shear.steps, --cycle-steps; of time, --time-steps) where slip reverses or turns."
            )
            made.append(Advice("note", "length of the steps", text))
    if factor > 0.0:  # where shear changes the pressure the two settle in turn
        certificate = solved.result.certificate
        check = next((item for item in certificate.couplings if item.name == "stick_slip"), None)
        met = "" if check is None else f" After {certificate.rounds} rounds it was {check.residual:.1e}."
        text = f"A round between pressure and shear multiplies their error by {factor:.2g}"
        if factor >= 1.0:
            more = "the alternation does not contract, and the solution found may be one of several"
            remedy = "Lower the friction coefficient, or follow the path in smaller steps."
            made.append(Advice("warning", "contraction of pressure and shear", f"{text}: {more}.{met} {remedy}"))
        else:
            made.append(Advice("note", "contraction of pressure and shear", f"{text}.{met}"))
    return tuple(made)


# In words and tables.


REMARK = (
    "A point sticks while its shear traction is below the bound of the friction, and slips along its traction at the bound. Steps are "
    "implicit: slip that turns or reverses within a step is seen at its end only."
)
"""What the model is."""


def _share(value: float) -> str:
    return "–" if math.isnan(value) else percent(value)


def law_text(law: Any) -> str:
    """The law of friction with its numbers."""
    import numpy as np

    def span(values: Any, unit: str) -> str:
        low, high = float(np.min(values)), float(np.max(values))
        return show(low, unit) if low == high else f"{show(low, unit)} to {show(high, unit)}, by point"

    if hasattr(law, "coefficient"):
        limit = f", at most {show(law.limit, 'Pa')}" if math.isfinite(law.limit) else ""
        return f"{law.name}, coefficient {span(law.coefficient, '1')}{limit}"
    return f"{law.name}, {span(law.strength, 'Pa')}" if hasattr(law, "strength") else str(law.name)


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
    from .fretting import loop_of, shear_numbers

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
