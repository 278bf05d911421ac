"""What a design is: the recommended values, how far every limit is from them, and how sure that
is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ...core.units import percent, show
from ...core.words import printable
from ...io.description import software
from ...io.tables import write_table
from ..recorded import Recorded, plain

Value = float | str
"""Value of a variable: SI, or the choice."""


@dataclass(frozen=True)
class DesignVariable:
    """One variable of a recommended design.

    Attributes
    ----------
    name, path, unit
        Its name, the scalar of the problem, and its SI unit.
    value
        The recommended value.
    low, high
        Bounds, SI; NaN of a choice.
    at_bound
        ``"low"`` or ``"high"`` where the value lies at a bound, else empty.
    """

    name: str
    path: str
    unit: str
    value: Value
    low: float = math.nan
    high: float = math.nan
    at_bound: str = ""


@dataclass(frozen=True)
class Objective:
    """An objective: its ``name``, ``label``, SI ``unit``, the ``goal`` minimise or maximise, and
    its ``value``."""

    name: str
    label: str
    unit: str
    goal: str
    value: float


@dataclass(frozen=True)
class Margin:
    """One constraint at the recommended design.

    Attributes
    ----------
    name, label, unit
        The quantity.
    goal, limit
        ``"at least"`` or ``"at most"``, and the limit, SI.
    value
        What it is: of several cases the worst one, of samples the mean less or more some standard
        deviations.
    margin
        How far it is within the limit, as a share of it; negative where it is missed.
    met, active
        Whether it holds within the tolerance of the search, and whether it holds the design back.
    case
        The case that counts, in words; empty where there is but one.
    price
        Change of the objective in percent by 1 % of the limit; NaN where it is not active or not
        known.
    """

    name: str
    label: str
    unit: str
    goal: str
    limit: float
    value: float
    margin: float
    met: bool
    active: bool
    case: str = ""
    price: float = math.nan

    @property
    def words(self) -> str:
        """The constraint in words, with its case."""
        return f"{self.label} {self.goal} {show(self.limit, self.unit)}" + (f", {self.case}" if self.case else "")


@dataclass(frozen=True)
class Change:
    """What a change of one ``variable`` to ``value`` does: the ``objective``, and the ``margins``
    of all ``limits`` of the design; NaN where it cannot be computed."""

    variable: str
    value: Value
    objective: float
    margins: tuple[float, ...]


@dataclass(frozen=True)
class Trial:
    """Where one search has ended: ``values`` of the variables, the ``objective``, whether all
    limits are met, whether it ``converged``, and its ``message``."""

    values: tuple[Value, ...]
    objective: float
    feasible: bool
    converged: bool
    message: str


@dataclass(frozen=True)
class FrontPoint:
    """A design of a front: ``values`` of the variables and both objectives, SI."""

    values: tuple[Value, ...]
    objective: float
    second: float


@dataclass(frozen=True, eq=False, repr=False)
class Design(Recorded):
    """A recommended design, all SI.

    Attributes
    ----------
    title
        Of the study.
    variables, objective, constraints
        The recommended design: values, objective, margins of all constraints.
    second
        The second objective, where a front was asked for; else None.
    limits
        Names of the constraints, one over each of the cases but once.
    changes
        What a change of each number by ten percent, and each other choice, does.
    trials
        Where the searches from all starts ended, the best first.
    history
        Objective and violation of the limits, relative, of every design that a search met, in
        order.
    front
        Designs between both objectives; empty where there is but one.
    feasible
        Whether all constraints are met.
    converged
        Whether the search from which the design comes ended by its criterion.
    unmet
        Words on each constraint that cannot be met.
    solves, reused, failed
        Contacts that were solved, those that were kept from before, and designs that failed.
    failure
        Why the first of them failed.
    tolerance
        Share of a limit by which it may be missed and still counts as met.
    citation_keys
        Keys of the sources behind the contacts of the recommended design.
    """

    title: str
    variables: tuple[DesignVariable, ...]
    objective: Objective
    constraints: tuple[Margin, ...]
    limits: tuple[str, ...]
    changes: tuple[Change, ...]
    trials: tuple[Trial, ...]
    history: tuple[tuple[float, float], ...]
    feasible: bool
    converged: bool
    second: Objective | None = None
    front: tuple[FrontPoint, ...] = ()
    unmet: tuple[str, ...] = ()
    solves: int = 0
    reused: int = 0
    failed: int = 0
    failure: str = ""
    tolerance: float = 1e-3
    citation_keys: tuple[str, ...] = ()
    software: dict[str, str] = field(default_factory=software)

    def __getitem__(self, name: str) -> Value:
        """Recommended value of the variable with this name or path.

        Raises
        ------
        KeyError
            If there is none.
        """
        for each in self.variables:
            if name in (each.name, each.path):
                return each.value
        raise KeyError(name)

    @property
    def active(self) -> tuple[str, ...]:
        """Names of the constraints that hold the design back."""
        return tuple(each.name for each in self.constraints if each.active)

    @property
    def agreeing(self) -> int:
        """Number of searches that end within one percent of the best objective with all limits
        met."""
        best = self.objective.value
        return sum(each.feasible and abs(each.objective - best) <= 0.01 * abs(best) for each in self.trials)

    @property
    def verdict(self) -> str:
        """One sentence on whether the design can be taken."""
        if not self.feasible:
            return "No design meets all constraints: " + "; ".join(self.unmet) + ". This one misses them least."
        many = len(self.trials)
        agree = f"{self.agreeing} of {many} searches end there" if many > 1 else "one search"
        if not self.converged:
            return f"All constraints hold, but the search did not converge ({self.trials[0].message}); {agree}."
        return f"All constraints hold; {agree}."

    def __repr__(self) -> str:
        lines = [printable(f"Design {self.title}".rstrip()), f"  {self.verdict}"]
        for heading, headings, rows in self.tables():
            lines += ["", f"  {heading}"]
            widths = [max(len(row[n]) for row in (headings, *rows)) for n in range(len(headings))]
            for row in (headings, *rows):
                text = "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
                lines.append(printable(f"    {text}".rstrip()))
        return "\n".join([*lines, "", f"  {self.work}"])

    @property
    def work(self) -> str:
        """What it took, in words."""
        failed = f"; {self.failed} designs could not be computed ({self.failure})" if self.failed else ""
        return f"{self.solves} contacts solved, {self.reused} kept from before{failed}."

    def tables(self) -> Iterator[tuple[str, tuple[str, ...], list[tuple[str, ...]]]]:
        """Heading, headings of columns and rows of text of each table."""
        yield (
            "Recommended",
            ("", "value", "from", "to"),
            [(each.name, value_text(each.value, each.unit), *_bounds(each)) for each in self.variables],
        )
        goals = [one for one in (self.objective, self.second) if one is not None]
        yield "Objective", ("", "", "value"), [(one.label, one.goal, value_text(one.value, one.unit)) for one in goals]
        if self.constraints:
            headings = ("", "", "limit", "value", "margin", "", "by 1 % of the limit", "case")
            rows = [_row(each) for each in self.constraints]
            kept = [n for n in range(len(headings)) if n < len(headings) - 2 or any(row[n] for row in rows)]
            yield "Constraints", tuple(headings[n] for n in kept), [tuple(row[n] for n in kept) for row in rows]
        if self.changes:
            names = tuple(f"margin of {limit}" for limit in self.limits)
            yield "Changes", ("", "to", "objective", *names), [self._change(each) for each in self.changes]
        if self.front and self.second is not None:
            second, front = self.second, self.front
            shown = {self.objective.name, second.name}
            others = [n for n, each in enumerate(self.variables) if each.name not in shown]
            columns = (self.objective.label, second.label, *(self.variables[n].name for n in others))
            texts = [
                [value_text(one.objective, self.objective.unit), value_text(one.second, second.unit)] for one in front
            ]
            for row, point in zip(texts, front, strict=True):
                row += [value_text(point.values[n], self.variables[n].unit) for n in others]
            yield "Front", columns, [tuple(row) for row in texts]

    @property
    def in_words(self) -> tuple[str, ...]:
        """Each design of the front: both objectives, and the values of the variables."""
        if self.second is None:
            return ()
        goals = (self.objective, self.second)
        return tuple(
            ", ".join(
                f"{one.label} {value_text(value, one.unit)}"
                for one, value in zip(goals, (point.objective, point.second), strict=True)
            )
            + ": "
            + ", ".join(
                f"{each.name} {value_text(value, each.unit)}"
                for each, value in zip(self.variables, point.values, strict=True)
            )
            for point in self.front
        )

    def searches(self) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
        """Headings of columns and rows of text on where every search has ended."""
        names = tuple(each.name for each in self.variables)
        rows = [
            (
                *(value_text(value, each.unit) for each, value in zip(self.variables, trial.values, strict=True)),
                value_text(trial.objective, self.objective.unit),
                "met" if trial.feasible else "missed",
                trial.message if trial.converged else f"{trial.message} (not converged)",
            )
            for trial in self.trials
        ]
        return (*names, self.objective.label, "limits", "ended"), rows

    def _change(self, change: Change) -> tuple[str, ...]:
        unit = next(each.unit for each in self.variables if each.name == change.variable)
        ratio = change.objective / self.objective.value - 1.0 if self.objective.value else math.nan
        margins = (_share(margin) for margin in change.margins)
        return change.variable, value_text(change.value, unit), _signed(ratio), *margins

    def record(self) -> dict[str, Any]:
        """Everything as plain values, SI; what is not known is None."""
        found: dict[str, Any] = plain(asdict(self))
        return found | {"agreeing": self.agreeing, "active": list(self.active), "verdict": self.verdict}

    def save_csv(self, path: str | Path, *, overwrite: bool = False) -> None:
        """Write variables, objective and constraints to the CSV file ``path``, SI; errors as of
        ``save_json``."""
        rows: list[tuple[Any, ...]] = [("kind", "name", "unit", "goal", "limit", "value", "margin")]
        rows += [("variable", each.name, each.unit, "", "", each.value, "") for each in self.variables]
        goals = [one for one in (self.objective, self.second) if one is not None]
        rows += [("objective", one.name, one.unit, one.goal, "", one.value, "") for one in goals]
        for one in self.constraints:
            rows.append(("constraint", one.name, one.unit, one.goal, one.limit, one.value, one.margin))
        write_table(rows, path, overwrite=overwrite)


def value_text(value: Value, unit: str) -> str:
    """A value of a variable or objective for tables."""
    if isinstance(value, str):
        return value
    return "–" if math.isnan(value) else show(value, unit)


def _bounds(each: DesignVariable) -> tuple[str, str]:
    return tuple(  # type: ignore[return-value]
        "" if math.isnan(end) else value_text(end, each.unit) + (" (at it)" if each.at_bound == name else "")
        for name, end in (("low", each.low), ("high", each.high))
    )


def _share(value: float) -> str:
    return "–" if math.isnan(value) else percent(value)


def _signed(value: float) -> str:
    return "–" if math.isnan(value) else f"{100.0 * value:+.3g} %"


def _row(each: Margin) -> tuple[str, ...]:
    state = "missed" if not each.met else "active" if each.active else "met"
    price = "" if math.isnan(each.price) else f"objective {each.price:+.3g} %"
    limit, value = value_text(each.limit, each.unit), value_text(each.value, each.unit)
    return each.label, each.goal, limit, value, _share(each.margin), state, price, each.case
