"""What a design document asks: variables with bounds, an objective, constraints, and the cases
that all of them are taken of."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...core import units
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...io.schemas.design import ConstraintTable, DesignTable, GoalTable, VariableTable
from ...io.schemas.study import DEFAULT_QUANTITIES, AxisTable, DerivedTable
from ...run.build import build
from ...run.document import checked
from ...run.refusals import stand_ins
from ..axes import Base, Point, make_axis
from ..documents import LoadedStudy
from ..expressions import Expression
from ..places import Edit, Place, edited, locate, problem_table
from ..plan import Plan, limit_of, make_plan, measures

MOST_CHOICES, MOST_SEARCHES = 200, 60
"""Combinations of choices that are all tried, and searches by gradients (combinations times starts)
beyond which choices and numbers evolve together unless something else is asked for."""

DIGITS = 9
"""Digits of the values of variables: a search that is run again finds the same ones."""


@dataclass(frozen=True)
class Variable:
    """One scalar at ``place`` under its ``name``.

    A number runs from ``low`` to ``high`` and starts at ``start``, on a logarithmic scale (``log``)
    or a linear one, all SI; scalars ``also`` are factors of it. A choice is one of ``points``.
    """

    name: str
    place: Place
    low: float = math.nan
    high: float = math.nan
    start: float = math.nan
    log: bool = False
    also: tuple[tuple[Place, float], ...] = ()
    points: tuple[Point, ...] = ()

    @property
    def width(self) -> float:
        """Length of its range, in logarithms where the scale is."""
        return math.log(self.high / self.low) if self.log else self.high - self.low

    def value(self, share: float) -> float:
        """Value at a ``share`` of the range, from 0 to 1."""
        at = min(max(share, 0.0), 1.0)
        found = self.low * math.exp(at * self.width) if self.log else self.low + at * self.width
        return min(max(rounded(found), self.low), self.high)

    def share(self, value: float) -> float:
        """Where ``value`` lies in the range."""
        return math.log(value / self.low) / self.width if self.log else (value - self.low) / self.width

    def rate(self, value: float) -> float:
        """Change of the value with the share."""
        return value * self.width if self.log else self.width

    def edits(self, value: float) -> tuple[Edit, ...]:
        """Changes of the document for ``value``."""
        found = [(self.place, value), *((place, factor * value) for place, factor in self.also)]
        return tuple(_edit(place, number) for place, number in found)


def rounded(value: float) -> float:
    """``value`` with ``DIGITS`` digits."""
    return float(f"{value:.{DIGITS - 1}e}")


def _edit(place: Place, number: float) -> Edit:
    written = place.written(number)
    return Edit(place.keys, written, written if place.quantity is None else place.content(written, Path()))


@dataclass(frozen=True)
class Criterion:
    """An objective or a constraint.

    Attributes
    ----------
    name
        The quantity, or the variable that it is.
    unit, label
        SI unit and words.
    larger
        Whether larger values are better.
    limit
        Least or largest value of a constraint; NaN of an objective.
    over
        What is taken of the cases: worst, each or mean.
    cases
        Numbers of the cases that it is taken of.
    variable
        Number of the variable that it is; None for a quantity.
    """

    name: str
    unit: str
    label: str
    larger: bool
    limit: float = math.nan
    over: str = "worst"
    cases: tuple[int, ...] = (0,)
    variable: int | None = None

    @property
    def goal(self) -> str:
        """What is asked of it, in words."""
        if math.isnan(self.limit):
            return "maximise" if self.larger else "minimise"
        return "at least" if self.larger else "at most"


@dataclass(frozen=True)
class Site:
    """A design: number of the point of each choice, and values of the other variables, SI."""

    choice: tuple[int, ...]
    values: tuple[float, ...]


@dataclass(frozen=True)
class DesignProblem:
    """A design document, checked.

    Attributes
    ----------
    plan
        The study: its axes are the cases, its samples come first.
    numbers, choices
        Variables of both kinds.
    objective, second, constraints
        What is to be best, the second objective of a front, and what must hold.
    """

    plan: Plan
    numbers: tuple[Variable, ...]
    choices: tuple[Variable, ...]
    objective: Criterion
    second: Criterion | None
    constraints: tuple[Criterion, ...]

    @property
    def table(self) -> DesignTable:
        """Its table."""
        found = self.plan.document.design
        assert found is not None
        return found

    @property
    def evolves(self) -> bool:
        """Whether choices and numbers are sought together by an evolution: where it is asked for,
        and where searches for each combination of choices would be too many."""
        if self.table.method != "auto":
            return self.table.method == "evolution"
        count = math.prod(len(each.points) for each in self.choices)
        return count > 1 and (count * self.table.starts > MOST_SEARCHES if self.numbers else count > MOST_CHOICES)

    @property
    def population(self) -> int:
        """Designs of a generation of an evolution."""
        return self.table.population or min(max(8 * len(self.variables), 16), 64)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """Numbers, then choices."""
        return (*self.numbers, *self.choices)

    @property
    def samples(self) -> int:
        """Number of samples of each case."""
        return 1 if self.plan.document.monte_carlo is None else self.plan.shape[0]

    @property
    def case_names(self) -> tuple[str, ...]:
        """Each case in words; empty where there is but one."""
        axes = self.plan.axes[self.samples_axis :]
        found = []
        for at in itertools.product(*(range(len(axis)) for axis in axes)):
            points = [axis.points[n].coordinate for axis, n in zip(axes, at, strict=True)]
            texts = [
                f"{axis.name} {x if isinstance(x, str) else units.show(x, axis.unit)}"
                for axis, x in zip(axes, points, strict=True)
            ]
            found.append(", ".join(texts))
        return tuple(found)

    @property
    def samples_axis(self) -> int:
        """Number of axes of samples, which come first."""
        return int(self.plan.document.monte_carlo is not None)

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of all scalars that numbers set."""
        return tuple(place.path for each in self.numbers for place in (each.place, *(other for other, _ in each.also)))

    def combinations(self) -> Iterator[tuple[int, ...]]:
        """All combinations of the choices."""
        return itertools.product(*(range(len(each.points)) for each in self.choices))

    def place(self, choice: tuple[int, ...], shares: RealArray) -> Site:
        """The design at ``shares`` of the ranges."""
        return Site(choice, tuple(each.value(float(z)) for each, z in zip(self.numbers, shares, strict=True)))

    def shares(self, place: Site) -> RealArray:
        """Where the values of a design lie in their ranges."""
        return np.array([each.share(v) for each, v in zip(self.numbers, place.values, strict=True)])

    def edits(self, place: Site) -> tuple[Edit, ...]:
        """Changes of the base problem for a design."""
        return edits_of(self.numbers, self.choices, place)


def edits_of(numbers: tuple[Variable, ...], choices: tuple[Variable, ...], place: Site) -> tuple[Edit, ...]:
    """Changes of the base problem by which the variables have their values of a design; choices
    first, which may take a table whole."""
    chosen = [e for each, n in zip(choices, place.choice, strict=True) for e in each.points[n].edits]
    return (*chosen, *(e for each, v in zip(numbers, place.values, strict=True) for e in each.edits(v)))


def make_design(study: LoadedStudy) -> DesignProblem:
    """What ``study`` with a table [design] asks; all that can be wrong is found before the first
    solve.

    Raises
    ------
    InputError
        If it has no such table, a path leads nowhere, a bound cannot be used, a quantity is
        unknown or lacks data in one of the choices, a limit has another unit, or names clash.
    """
    table = study.document.design
    if table is None:
        raise InputError(
            "study of a design must have the table [design], but has none. Give it variables and an objective, or "
            "compute the study: asperity run."
        )
    if study.document.monte_carlo is not None and study.document.monte_carlo.stop is not None:
        raise InputError("monte_carlo.stop must be left out of a design, whose samples are the same everywhere.")
    if study.document.monte_carlo is None and table.robust:
        raise InputError("design.robust must be left out without samples, but is given. Add the table [monte_carlo].")
    base = Base(study.problem, study.folder)
    numbers, choices = _variables(base, table)
    names = [each.name for each in (*numbers, *choices)]
    asked = [
        name for name in _asked(table) if name not in (*names, *(each.place.path for each in (*numbers, *choices)))
    ]
    letters = _letters(study.document.letters, (*numbers, *choices))
    asked = _measured(asked, study.document.derived, letters)
    kept = () if study.document.quantities == DEFAULT_QUANTITIES else study.document.quantities
    quantities = tuple(dict.fromkeys((*asked, *kept))) or DEFAULT_QUANTITIES[:1]
    document = study.document.model_copy(update={"quantities": quantities, "letters": letters})
    first = edits_of(numbers, choices, Site((0,) * len(choices), tuple(each.start for each in numbers)))
    plan = make_plan(LoadedStudy(document, study.problem, study.folder), first)
    _require_apart(plan, (*numbers, *choices))
    found = DesignProblem(plan, numbers, choices, _goal(table, plan, numbers, choices), None, ())
    second = None if table.pareto is None else _goal(table.pareto, plan, numbers, choices)
    limits = tuple(_limit(item, found, n) for n, item in enumerate(table.constraints))
    made = DesignProblem(plan, numbers, choices, found.objective, second, limits)
    _require_possible(made, base, asked)
    return made


def _asked(table: DesignTable) -> Iterator[str]:
    for goal in (table, table.pareto):
        if goal is not None:
            yield str(goal.minimise or goal.maximise)
    yield from (item.quantity for item in table.constraints)


def _letters(given: Mapping[str, str], variables: tuple[Variable, ...]) -> dict[str, str]:
    """Paths by the letters of expressions: those ``given``, and the names of variables."""
    letters = dict(given)
    for each in variables:
        if letters.setdefault(each.name, each.place.path) != each.place.path:
            raise InputError(
                f"letter {each.name} must lead to the variable of this name, {each.place.path}, but leads to "
                f"{given[each.name]}; give one of them another name."
            )
    return {name: path for name, path in letters.items() if name in given or name.isidentifier()}


def _measured(names: list[str], derived: Mapping[str, DerivedTable], letters: Mapping[str, str]) -> list[str]:
    """Quantities of a contact that the numbers with these ``names`` take, which may be derived."""
    known, found = measures(), [name for name in names if name not in derived]
    for name, table in derived.items():
        taken = Expression(table.expression, f"expression of {name}").names
        found += [other for other in taken if other in known and other not in letters]
    return list(dict.fromkeys(found))


def _variables(base: Base, table: DesignTable) -> tuple[tuple[Variable, ...], tuple[Variable, ...]]:
    numbers: list[Variable] = []
    choices: list[Variable] = []
    taken: set[str] = set(measures())
    for item in table.variables:
        words = item.path.split(".")
        short = ("_".join(words[-count:]) for count in range(1, len(words) + 1))
        free = (name for name in short if name not in taken and not name[0].isdigit())
        name = item.name or next(free, item.path)
        if name in taken:
            raise InputError(
                f"name of the variable {item.path} must differ from other variables and from quantities, but is "
                f"{name!r}; give it another name."
            )
        taken.add(name)
        if item.choices is None:
            numbers.append(_number(base, item, name))
        else:
            axis = make_axis(base, AxisTable(path=item.path, values=item.choices, also=item.also), name)
            choices.append(Variable(name, locate(base.document, item.path), points=tuple(axis.points)))
    count = math.prod(len(each.points) for each in choices)
    if count > MOST_CHOICES and table.method not in ("auto", "evolution"):
        raise InputError(
            f"choices of a design must have at most {MOST_CHOICES} combinations for the method {table.method}, but "
            f"have {count}; give the method evolution."
        )
    return tuple(numbers), tuple(choices)


def _number(base: Base, item: VariableTable, name: str) -> Variable:
    place = locate(base.document, item.path)
    low, high = place.number(item.low), place.number(item.high)
    if not low < high:
        raise InputError(f"high of {place.path} must be above low, but runs from {item.low!r} to {item.high!r}.")
    if place.whole or place.keys[-1] == "points":
        raise InputError(f"{place.path} must be given as choices, since it is a whole number, but has low and high.")
    log = low > 0.0 if item.scale is None else item.scale == "log"
    if log and low <= 0.0:
        raise InputError(f"low of {place.path} must be above zero on a logarithmic scale, but is {item.low!r}.")
    also: list[tuple[Place, float]] = []
    for path, rule in item.also.items():
        other = locate(base.document, path)
        if isinstance(rule, tuple) or other.unit != place.unit:
            raise InputError(
                f"also.{other.path} must be a number, that many times {place.path}, in the same unit, but is "
                f"{rule!r} and in {other.unit}."
            )
        also.append((other, float(rule)))
    given = item.start if item.start is not None else _present(base, place)
    start = math.sqrt(low * high) if log else 0.5 * (low + high)
    if given is not None and (item.start is not None or low <= place.number(given) <= high):
        start = place.number(given)
    if not low <= start <= high:
        raise InputError(f"start of {place.path} must lie from {item.low!r} to {item.high!r}, but is {item.start!r}.")
    found = Variable(name, place, low, high, start, log, tuple(also))
    for value in (low, high):
        checked(edited(problem_table(base.document), found.edits(value)), f"problem with {place.path} = {value:g}")
    return found


def _present(base: Base, place: Place) -> Any:
    """Value of the scalar in the base problem, None if it is not a number there."""
    found: Any = problem_table(base.document)
    try:
        for key in place.keys:
            found = found[key]
        place.number(found)
    except (KeyError, IndexError, TypeError, InputError):
        return None
    return found


def _goal(table: GoalTable, plan: Plan, numbers: tuple[Variable, ...], choices: tuple[Variable, ...]) -> Criterion:
    name, larger = str(table.minimise or table.maximise), table.maximise is not None
    for number, each in enumerate(numbers):
        if name in (each.name, each.place.path):
            return Criterion(each.name, each.place.unit, each.name.replace("_", " "), larger, variable=number)
    if name in {text for each in choices for text in (each.name, each.place.path)}:
        raise InputError(f"objective of a design must be a quantity or a number, but {name} is a choice.")
    known = plan.known[name]
    return Criterion(name, known.unit, known.label, larger, over=table.over, cases=_cases(plan, table.at, name))


def _limit(table: ConstraintTable, found: DesignProblem, number: int) -> Criterion:
    name = table.quantity
    for each in found.variables:
        if name in (each.name, each.place.path):
            raise InputError(
                f"quantity of constraint {number + 1} must not be a variable, but {name} is one; narrow its bounds."
            )
    known, larger = found.plan.known[name], table.at_least is not None
    text = table.at_least if larger else table.at_most
    limit = limit_of(text, known.unit, f"limit of {name}")
    return Criterion(name, known.unit, known.label, larger, limit, table.over, _cases(found.plan, table.at, name))


def _cases(plan: Plan, at: Mapping[str, Any], name: str) -> tuple[int, ...]:
    """Numbers of the cases at the values ``at`` of the axes; of all of them where it is empty."""
    axes = plan.axes[int(plan.document.monte_carlo is not None) :]
    kept: list[list[int]] = []
    given = dict(at)
    for axis in axes:
        numbers = list(range(len(axis)))
        if axis.name in given:
            value = given.pop(axis.name)
            wanted: Any = value
            if not all(isinstance(point.coordinate, str) for point in axis.points):
                wanted = limit_of(value, axis.unit, f"value of {axis.name} for {name}")
            numbers = [
                n
                for n, point in enumerate(axis.points)
                if point.coordinate == wanted
                or (not isinstance(wanted, str) and math.isclose(float(point.coordinate), wanted, rel_tol=1e-9))
            ]
            if not numbers:
                raise InputError(f"value of {axis.name} for {name} must be one of its axis, but is {value!r}.")
        kept.append(numbers)
    if given:
        there = ", ".join(axis.name for axis in axes) or "none"
        raise InputError(
            f"axis of the cases of {name} must be one of the study ({there}), but is {next(iter(given))!r}."
        )
    shape = tuple(len(axis) for axis in axes)
    return tuple(int(np.ravel_multi_index(index, shape)) if shape else 0 for index in itertools.product(*kept))


def _require_apart(plan: Plan, variables: tuple[Variable, ...]) -> None:
    """Refuse scalars that two variables, or a variable and an axis, set."""
    seen: list[tuple[tuple[Any, ...], str]] = []
    for axis in plan.axes:
        if axis.name in {each.name for each in variables}:
            raise InputError(
                f"name of a variable must differ from those of the axes, but {axis.name} is one; give it another name."
            )
        if axis.rule is not None:
            own = axis.rule.place.keys
            seen.append((("control",) if own[0] == "control" else own, axis.name))
        for edit in axis.points[0].edits:
            seen.append((("control",) if edit.keys[0] == "control" else edit.keys, axis.name))
    for each in variables:
        keys = [edit.keys for edit in each.points[0].edits] if each.points else []
        keys = keys or [place.keys for place in (each.place, *(place for place, _ in each.also))]
        for one in keys:
            found = ("control",) if one[0] == "control" else one
            for known, name in seen:
                if known == found and name != each.name:
                    raise InputError(
                        f"variables and axes must set different scalars, but {name} and {each.name} both set "
                        f"{'.'.join(map(str, one))}."
                    )
            seen.append((found, each.name))


def _to_check(design: DesignProblem) -> Iterator[tuple[int, ...]]:
    """Combinations of choices that are built before anything is solved: all, or of many those that
    differ from the first in one choice."""
    counts = [len(each.points) for each in design.choices]
    if math.prod(counts) <= MOST_CHOICES:
        yield from design.combinations()
        return
    first = (0,) * len(counts)
    for n, count in enumerate(counts):
        yield from ((*first[:n], at, *first[n + 1 :]) for at in range(min(n, 1), count))


def _require_possible(design: DesignProblem, base: Base, asked: list[str]) -> None:
    """Refuse a design that cannot be built, or whose quantities lack data, in one of the choices;
    surfaces are not made."""
    table, plan = problem_table(base.document), design.plan
    ends = [tuple(each.low for each in design.numbers), tuple(each.high for each in design.numbers)]
    for choice in _to_check(design):
        for values in dict.fromkeys(ends):
            own = design.edits(Site(choice, values))
            edits = (*own, *plan.edits((0,) * len(plan.axes), plan.scalars.after(own)))
            shown = ", ".join(f"{'.'.join(map(str, edit.keys))} = {edit.value!r}" for edit in edits)
            case = build(checked(edited(table, edits), f"problem with {shown}"), base.folder, surfaces=stand_ins)
            for part in (part for part in case.parts if part.name in case.asks):
                unknown = part.at_work.unknown(case.asks[part.name], case.problem)
                for name in (name for name in asked if name in unknown):
                    raise InputError(f"quantity {name} of the design must be known everywhere, but {unknown[name]}.")
