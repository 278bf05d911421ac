"""What a study varies: axes of points, each of which changes some scalars of the problem
document."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from ..core import require
from ..core.errors import InputError
from ..io.schemas.study import AxisTable
from ..run.document import ProblemDocument, checked
from .expressions import Expression
from .places import Edit, Place, edited, locate, problem_table

Coordinate: TypeAlias = float | str
"""Where a point lies on its axis: a number in SI units, or a word."""


@dataclass(frozen=True)
class Point:
    """One point of an axis: its coordinate, its changes, and further ``columns`` to be listed
    beside it."""

    coordinate: Coordinate
    edits: tuple[Edit, ...]
    columns: Mapping[str, Coordinate] = field(default_factory=dict)


@dataclass(frozen=True)
class Rule:
    """How an axis sets the scalar at ``place``: by an ``expression``, which takes its values, other
    axes and scalars."""

    place: Place
    expression: Expression


@dataclass(frozen=True)
class Axis:
    """One dimension of a study.

    ``points`` may be made when they are asked for. ``columns`` holds the units of the columns of
    its points; ``is_load``: its points differ in the load alone; ``title``: the name that the study
    gives it. Points of an axis with a ``rule`` have no changes of their own: these depend on the
    other axes.
    """

    name: str
    unit: str
    path: str
    points: Sequence[Point]
    is_load: bool = False
    columns: Mapping[str, str] = field(default_factory=dict)
    rule: Rule | None = None
    title: str = ""

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True)
class Base:
    """The problem ``document`` that a study starts from, and the ``folder`` at which its relative
    paths start."""

    document: ProblemDocument
    folder: Path

    def edit(self, place: Place, value: Any) -> Edit:
        """Change of the scalar at ``place`` to ``value`` as a document writes it.

        Raises
        ------
        InputError
            If the changed document has a problem.
        """
        made = Edit(place.keys, value, place.content(value, self.folder))
        checked(edited(problem_table(self.document), [made]), f"problem with {place.path} = {value!r}")
        return made


def make_axis(base: Base, table: AxisTable, name: str) -> Axis:
    """Axis that ``table`` describes.

    Raises
    ------
    InputError
        If a path leads nowhere, a value does not suit it, or ``also`` does not fit the values.
    """
    place = locate(base.document, table.path)
    values = values_of(place, table)
    followers = [(locate(base.document, path), rule) for path, rule in table.also.items()]
    points = []
    for number, value in enumerate(values):
        position = coordinate(place, value)
        changes = [(place, value)]
        for other, rule in followers:  # from a list, or that many times the value
            if isinstance(rule, tuple):
                if len(rule) != len(values):
                    raise InputError(
                        f"also.{other.path} must hold {len(values)} values like {place.path}, but holds {len(rule)}."
                    )
                changes.append((other, _as_written(other, rule[number])))
            elif other.unit != place.unit:
                raise InputError(
                    f"also.{other.path} must be a list, because its unit {other.unit} is not the unit "
                    f"{place.unit} of {place.path}."
                )
            else:
                changes.append((other, other.written(rule * place.number(value))))
        # checked together: a hardness alone may have no modulus to go with
        edits = tuple(Edit(at.keys, new, at.content(new, base.folder)) for at, new in changes)
        shown = ", ".join(f"{at.path} = {new!r}" for at, new in changes)
        checked(edited(problem_table(base.document), edits), f"problem with {shown}")
        points.append(Point(position, edits))
    if not all(isinstance(point.coordinate, float) for point in points):  # all of them numbers, or else all words
        points = [Point(str(point.coordinate), point.edits, point.columns) for point in points]
    is_load = place.is_load and all(other.is_load for other, _ in followers)
    return Axis(name, place.unit, place.path, tuple(points), is_load, title=table.name or "")


def listed(axes: Sequence[Axis]) -> Axis:
    """One axis that goes through the points of all ``axes`` together.

    Raises
    ------
    InputError
        If they are not equally long, or one sets its scalar by an expression.
    """
    for part in axes:
        if part.rule is not None:
            raise InputError(
                f'axes of a study with combine = "list" must have values of their scalars, but {part.name} has an '
                "expression; list the values, or combine the axes as a grid."
            )
    lengths = {part.name: len(part) for part in axes}
    if len(set(lengths.values())) > 1:
        shown = ", ".join(f"{name} has {count}" for name, count in lengths.items())
        raise InputError(f'axes of a study with combine = "list" must have equally many values, but {shown}.')
    points = [
        Point(
            float(number),
            tuple(edit for point in row for edit in point.edits),
            {part.name: point.coordinate for part, point in zip(axes, row, strict=True)},
        )
        for number, row in enumerate(zip(*(part.points for part in axes), strict=True))
    ]
    return Axis("case", "1", "", points, all(part.is_load for part in axes), {part.name: part.unit for part in axes})


def values_of(place: Place, table: Any, scale: str = "linear") -> list[Any]:
    """Values of a list or range as a document writes them.

    Raises
    ------
    InputError
        If a range is not one of numbers, or a logarithmic one is not positive.
    """
    if table.values is not None:
        return [_as_written(place, value) for value in table.values]
    first, last = place.number(table.first), place.number(table.last)
    if (table.scale or scale) == "log":
        require.positive(first, f"first of a logarithmic range of {place.path}")
        require.positive(last, f"last of a logarithmic range of {place.path}")
        numbers = np.geomspace(first, last, table.count)
    else:
        numbers = np.linspace(first, last, table.count)
    return list(dict.fromkeys(place.written(float(number)) for number in numbers))


def coordinate(place: Place, value: Any) -> Coordinate:
    """Where ``value``, as a document writes it, lies on an axis."""
    found = value if place.quantity is None else place.content(value, Path())
    if isinstance(found, list):
        return float(found[0]) if found[0] == found[1] else str(value)
    if isinstance(found, int) and not isinstance(found, bool):
        return require.finite(found, f"value of {place.path}")
    return found if isinstance(found, float) else str(found)


def _as_written(place: Place, value: Any) -> Any:
    if place.keys[-1] == "points":
        return [value, value] if isinstance(value, int) else list(value) if isinstance(value, tuple) else value
    if place.quantity not in (None, "size"):
        found = place.content(value, Path()) if isinstance(value, str) else place.number(value)
        return place.written(found) if isinstance(found, float) else value
    return value
