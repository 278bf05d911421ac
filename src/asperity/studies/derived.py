"""Values of scalars over all cases of a study, axes that set a scalar by an expression, and numbers
derived from scalars and results."""

from __future__ import annotations

import keyword
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from operator import getitem
from typing import Any

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.quantity import Quantity
from ..core.units import dimension
from ..io.schemas.study import AxisTable, DerivedTable
from ..run.document import checked
from .axes import Axis, Base, Point, Rule, coordinate
from .expressions import Expression
from .places import Edit, Place, edited, locate, problem_table


@dataclass(frozen=True)
class Derived:
    """A number by an ``expression`` of letters, axes and results.

    ``measured``: it takes a result, so that it is one itself; else it says where a case lies.
    """

    expression: Expression
    quantity: Quantity
    measured: bool


@dataclass(frozen=True)
class Scalars:
    """Scalars of the problem over all cases on ``axes``, by their ``letters`` in expressions; of
    the problem after ``edits`` where there are some."""

    base: Base
    axes: tuple[Axis, ...]
    letters: Mapping[str, Place]
    edits: tuple[Edit, ...] = ()
    _found: dict[tuple[Any, ...], RealArray] = field(default_factory=dict, init=False, repr=False, compare=False)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points of each axis."""
        return tuple(len(axis) for axis in self.axes)

    def after(self, edits: Sequence[Edit]) -> Scalars:
        """The same of the base problem after ``edits``."""
        return replace(self, edits=tuple(edits))

    @cached_property
    def _table(self) -> dict[str, Any]:
        return edited(problem_table(self.base.document), self.edits)

    @cached_property
    def units(self) -> dict[str, str]:
        """Units of all names that are known before anything is solved: letters, and axes of
        numbers."""
        axes = {axis.name: axis.unit for axis in self.axes if self._along(axis) is not None}
        return axes | {letter: place.unit for letter, place in self.letters.items()}

    def named(self, name: str) -> RealArray:
        """Values (SI) over all cases of a letter or an axis."""
        if name in self.letters:
            return self.at(self.letters[name])
        number, axis = next((n, axis) for n, axis in enumerate(self.axes) if axis.name == name)
        values = self._along(axis)
        assert values is not None
        return self._spread(values, number)

    def at(self, place: Place) -> RealArray:
        """Values (SI) over all cases of the scalar at ``place``.

        Raises
        ------
        InputError
            If the problem has none there, or it is no number.
        """
        if place.keys not in self._found:
            self._found[place.keys] = self._at(place)
        return self._found[place.keys]

    def ruled(self, index: Sequence[int], edits: Sequence[Edit]) -> tuple[Edit, ...]:
        """Changes of the case at ``index`` by axes with a rule, beside its other ``edits``."""
        made = []
        for axis in self.axes:
            if axis.rule is not None:
                value = axis.rule.place.written(float(self.at(axis.rule.place)[tuple(index)]))
                made.append(Edit(axis.rule.place.keys, value, axis.rule.place.content(value, self.base.folder)))
        return (*edits, *made)

    def require_rules(self) -> None:
        """Check the axes with a rule: units, numbers, and the problems with the smallest and the
        largest.

        Raises
        ------
        InputError
            If one of them cannot be.
        """
        for axis in self.axes:
            if axis.rule is None:
                continue
            place, expression = axis.rule.place, axis.rule.expression
            require_names(expression, self.units)
            unit = expression.unit(self.units)
            if dimension(unit) != dimension(place.unit):
                raise InputError(
                    f"{expression.what} must have the unit {place.unit} of {place.path}, but has "
                    f"{'none' if unit == '1' else unit}."
                )
            values = self.at(place)
            if not np.isfinite(values).all():
                raise InputError(
                    f"{expression.what} must give a finite number in every case, but does not in "
                    f"{np.count_nonzero(~np.isfinite(values))} of {values.size}: it divides by zero, or takes a scalar "
                    "that it sets itself."
                )
            for end in (values.min(), values.max()):
                value = place.written(float(end))
                edit = Edit(place.keys, value, place.content(value, self.base.folder))
                checked(edited(self._table, [edit]), f"problem with {place.path} = {value!r}")

    def _at(self, place: Place) -> RealArray:
        for axis in self.axes:
            if axis.rule is not None and axis.rule.place.keys == place.keys:
                self._found[place.keys] = np.full(self.shape, np.nan)  # what a circle of rules would find
                expression = axis.rule.expression
                return np.broadcast_to(
                    np.asarray(expression.value({name: self.named(name) for name in expression.names}), dtype=float),
                    self.shape,
                )
        for number, axis in enumerate(self.axes):
            values = _set_on(axis, place)
            if values is not None:
                return self._spread(values, number)
        table: Any = self._table
        try:
            value = coordinate(place, reduce(getitem, place.keys, table))
        except (KeyError, IndexError):
            raise InputError(f"{place.path} must have a value in the problem for an expression; give one.") from None
        if isinstance(value, str):
            raise InputError(f"{place.path} must be a number for an expression, but is {value!r}.")
        return np.broadcast_to(value, self.shape)

    def _spread(self, values: Sequence[float], number: int) -> RealArray:
        """``values`` along the axis of this ``number``, over all cases."""
        found = np.array(values, dtype=float).reshape([-1 if n == number else 1 for n in range(len(self.axes))])
        return np.broadcast_to(found, self.shape)

    def _along(self, axis: Axis) -> list[float] | None:
        values = [point.coordinate for point in axis.points]
        numbers = [value for value in values if isinstance(value, float)]
        return numbers if len(numbers) == len(values) else None


def _set_on(axis: Axis, place: Place) -> list[float] | None:
    """Values of the scalar at ``place`` at the points of ``axis``; None where it does not set
    it."""
    found: list[float] = []
    for point in axis.points:
        value = None
        for edit in point.edits:
            if edit.change == "set" and edit.keys == place.keys:
                value = edit.content[0] if isinstance(edit.content, list) else edit.content
            elif edit.change != "set" and place.keys[: len(edit.keys)] == edit.keys:
                value = np.nan  # the layer is not there, or never ends
        if value is None:
            return None
        if isinstance(value, str):
            raise InputError(
                f"{place.path} must be a number for an expression, but is {value!r} on the axis {axis.name}."
            )
        found.append(float(value))
    return found or None


def require_names(expression: Expression, known: Mapping[str, str]) -> None:
    """Check that all names of ``expression`` are ``known``; an InputError if one is not."""
    for name in expression.names:
        if name not in known:
            raise InputError(
                f"{expression.what} must consist of letters of the study, axes and quantities, but has {name!r}. "
                f'Give its path under letters, such as {name} = "control.mean_pressure"; there are '
                f"{', '.join(known) or 'none'}."
            )


def located(base: Base, letters: Mapping[str, str]) -> dict[str, Place]:
    """Scalars that ``letters`` stand for, by their paths.

    Raises
    ------
    InputError
        If a letter is no name, or a path leads nowhere.
    """
    for letter in letters:
        require_name(letter, "letter of a study")
    return {letter: locate(base.document, path) for letter, path in letters.items()}


def require_name(name: str, what: str) -> None:
    """Check that ``name`` can stand in an expression; an InputError if not."""
    if not name.isidentifier() or keyword.iskeyword(name):
        raise InputError(
            f"{what} must be a name of letters, digits and _, not beginning with a digit, but is {name!r}."
        )


def ruled_axis(base: Base, table: AxisTable, name: str) -> Axis:
    """Axis of plain numbers by whose values, under its ``name``, an expression sets a scalar.

    Raises
    ------
    InputError
        If values are no plain numbers, the name is none, or others are to follow.
    """
    assert table.expression is not None
    require_name(name, f"name of the axis {table.path} in its expression")
    if table.also:
        raise InputError(
            f"axis {name} must leave out also, because an expression sets {table.path}, but has it. Add an axis with "
            "an expression for what is to follow."
        )
    place, what = locate(base.document, table.path), f"value of the axis {name}, which an expression takes,"
    if table.values is not None:
        values = [_plain(value, what) for value in table.values]
    else:
        first, last = (_plain(end, what) for end in (table.first, table.last))
        if table.scale == "log":
            require.positive(first, f"first of the logarithmic range {name}")
            require.positive(last, f"last of the logarithmic range {name}")
        spaced = np.geomspace if table.scale == "log" else np.linspace
        values = [float(value) for value in spaced(first, last, table.count or 1)]
    points = [Point(value, ()) for value in values]
    rule = Rule(place, Expression(table.expression, f"expression of the axis {name}"))
    return Axis(name, "1", "", points, place.is_load, rule=rule, title=name)


def _plain(value: object, what: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"{what} must be a plain number, but is {value!r}.")
    return require.finite(float(value), what)


def derived_numbers(
    tables: Mapping[str, DerivedTable], scalars: Scalars, measured: Mapping[str, Quantity]
) -> tuple[Derived, ...]:
    """What ``tables`` derive from ``scalars`` and ``measured`` quantities, in their order; those
    before may be taken too.

    Raises
    ------
    InputError
        If an expression is none, has an unknown name or unlike units, or a name is taken.
    """
    made: dict[str, Derived] = {}
    units = {name: item.unit for name, item in measured.items()} | scalars.units
    for name, table in tables.items():
        require_name(name, "name of a derived number")
        if name in units:
            raise InputError(
                f"name of a derived number must not be that of a letter, axis or quantity, but is {name!r}."
            )
        expression = Expression(table.expression, f"expression of {name}")
        require_names(expression, units)
        for other in expression.names:
            if other in scalars.units:
                scalars.named(other)  # the problem must have it
        takes = any(
            (other in measured and other not in scalars.units) or (other in made and made[other].measured)
            for other in expression.names
        )
        units[name] = expression.unit(units)
        label = table.label or f"{name} = {table.expression}"
        made[name] = Derived(expression, Quantity(name, units[name], label), takes)
    return tuple(made.values())


def derived_values(
    derived: Sequence[Derived], scalars: Scalars, measured: Mapping[str, RealArray]
) -> dict[str, RealArray]:
    """Values (SI) over all cases of all ``derived`` numbers, where ``measured`` holds those of the
    quantities they take."""
    found: dict[str, RealArray] = {}
    for item in derived:
        known = {
            name: found[name] if name in found else scalars.named(name) if name in scalars.units else measured[name]
            for name in item.expression.names
        }
        values = np.asarray(item.expression.value(known), dtype=float)
        found[item.quantity.name] = np.broadcast_to(values, scalars.shape)
    return found


def derived_slopes(
    derived: Sequence[Derived], values: Mapping[str, RealArray], slopes: Mapping[str, RealArray]
) -> dict[str, RealArray]:
    """Derivatives of those ``derived`` numbers all of whose names have ``slopes`` along one
    direction, at the ``values`` of all names."""
    found: dict[str, RealArray] = {}
    for item in derived:
        known = {**slopes, **found}
        if all(name in known for name in item.expression.names):
            found[item.quantity.name] = np.asarray(item.expression.slope(values, known), dtype=float)
    return found
