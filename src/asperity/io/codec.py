"""Frozen dataclasses as labelled values and back, to the bit: what is stored is told by their
fields (``core.quantity.measured``).

A field is a number, text, an array with named axes, a tuple of numbers, arrays by name, another
dataclass, whose fields follow it as ``field_of``, or a tuple of dataclasses, whose fields are
columns. One whose type is no dataclass but a protocol or several types, such as a law, is described
as JSON. Steps of a history stand along ``step`` where an array is one over the grid or a single
number; anything else may have another length in each step, and stands in rows one after the other
with a count for each step.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from functools import cache
from inspect import get_annotations
from types import MappingProxyType
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np

from ..contact.answer import Answer
from ..core.errors import FileFormatError
from ..core.quantity import COLUMNS, Labelled, Quantity, stored_quantities
from ..core.registry import ANSWERS, home
from .description import describe, import_of_package, kind_name, rebuild, subclasses
from .tree import Node, Stack

COUNT = "_count"
"""Ending of the name of the lengths of rows."""

HERE = "answered"
"""Variable of a group of a history: the place of what it holds among all that a step has, from 1;
zero where it has none."""

KIND = "kind"
"""Attribute of a group: the qualified name of its dataclass."""

GRID_AXES = ("x", "y")
"""Axes of the grid."""


def answer_kind(name: str) -> type[Answer]:
    """The kind of answer of this qualified ``name``: one of this package, or one of one's own that
    has been imported or is of an installed package that adds parts; for no other is anything
    imported.

    Raises
    ------
    FileFormatError
        If there is none.
    """
    own = {f"asperity.{place}": place for place in ANSWERS}
    if name in own:
        found: type[Answer] = home(own[name])
        return found
    kinds = {kind_name(kind): kind for kind in subclasses(Answer)}
    if name not in kinds:
        import_of_package(name)
        kinds = {kind_name(kind): kind for kind in subclasses(Answer)}
    if name not in kinds:
        known = ", ".join(sorted({*own, *kinds}))
        raise FileFormatError(
            f"answer in a result file must be one of {known}, but is {name!r}; import what defines it, or "
            "update asperity."
        )
    return kinds[name]


# One dataclass.


def values_of(found: object, prefix: str = "") -> Iterator[Labelled]:
    """Stored values of ``found`` with what they are, under names that begin with ``prefix``."""
    kind: Any = type(found)
    hints, columns = _hints(kind), _columns(kind)
    for quantity in stored_quantities(kind):
        value, hint = getattr(found, quantity.name), hints[quantity.name]
        named = replace(quantity, name=prefix + quantity.name)
        if value is None:
            continue
        if isinstance(value, Mapping):
            for item in columns[quantity.name]:
                if item.name in value:
                    yield Labelled(replace(item, name=prefix + item.name, dims=quantity.dims), value[item.name])
        elif columns.get(quantity.name):
            dims = (*quantity.dims,)
            for number, item in enumerate(columns[quantity.name]):
                yield Labelled(replace(item, name=f"{named.name}_{item.name}", dims=dims), np.asarray(value)[:, number])
        elif _row_kind(hint) is not None:
            yield from _rows_of(value, _row_kind(hint), named.name)
        elif _nested(hint) is not None:
            yield from values_of(value, f"{named.name}_")
        elif is_dataclass(value):
            maps: dict[str, Any] = {}
            yield Labelled(replace(named, unit=""), json.dumps(describe(value, maps, named.name)))
            for key, array in maps.items():
                yield Labelled(Quantity(key, "", f"map of {named.label}", GRID_AXES), array)
        elif isinstance(value, tuple):
            yield Labelled(replace(named, dims=quantity.dims or (named.name,)), np.asarray(value))
        elif isinstance(value, np.ndarray):
            own = tuple(f"{named.name}_{axis}" for axis in range(value.ndim))
            yield Labelled(replace(named, dims=quantity.dims if len(quantity.dims) == value.ndim else own), value)
        elif isinstance(value, str | Enum):
            yield Labelled(replace(named, unit=""), str(value))
        else:
            yield Labelled(named, value)


def made_of(kind: type, values: Mapping[str, Any], known: Mapping[str, Any], prefix: str = "") -> Any:
    """The dataclass ``kind`` of stored ``values`` by name, and of fields that are ``known``.

    Raises
    ------
    KeyError
        If a value is missing.
    """
    hints, columns, made = _hints(kind), _columns(kind), dict(known)
    for quantity in stored_quantities(kind):
        name, hint = prefix + quantity.name, hints[quantity.name]
        if get_origin(hint) is Mapping:
            there = (item.name for item in columns[quantity.name] if prefix + item.name in values)
            made[quantity.name] = {key: np.asarray(values[prefix + key]) for key in there}
        elif columns.get(quantity.name):
            parts = [np.asarray(values[f"{name}_{item.name}"]) for item in columns[quantity.name]]
            made[quantity.name] = np.stack(parts, axis=1)
        elif _row_kind(hint) is not None:
            made[quantity.name] = _rows_made(_row_kind(hint), values, name)
        elif (inner := _nested(hint)) is not None:
            kept = inner is hint or any(f"{name}_{item.name}" in values for item in stored_quantities(inner))
            made[quantity.name] = made_of(inner, values, {}, f"{name}_") if kept else None
        elif name not in values and type(None) in get_args(hint):
            made[quantity.name] = None
        else:
            made[quantity.name] = _one(hint, values[name], values)
    return kind(**made)


def _one(hint: Any, value: Any, maps: Mapping[str, Any] = MappingProxyType({})) -> Any:
    """A single stored ``value`` as what the type ``hint`` of its field asks for; ``maps`` are
    arrays that a description names."""
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and not value.ndim):
        value = value.item()
    if isinstance(hint, type) and issubclass(hint, Enum):
        return hint(value)
    if get_origin(hint) is tuple:
        return tuple(_one(get_args(hint)[0], item) for item in np.asarray(value).tolist())
    if hint in (int, float, bool, str):
        if isinstance(value, str) is not (hint is str) or isinstance(value, np.ndarray):
            raise ValueError(f"{value!r:.60} is no {hint.__name__}")
        return hint(value)
    if isinstance(value, str) and get_origin(hint) is not Literal:
        # a description; no text in a step of a history in which there is none
        return rebuild(json.loads(value), maps) if value else None
    return value


def _rows_of(rows: Sequence[Any], kind: Any, name: str) -> Iterator[Labelled]:
    """A tuple of dataclasses of this ``kind`` as columns; nothing of an empty one."""
    if not rows:
        return
    for quantity in stored_quantities(kind):
        column = [getattr(row, quantity.name) for row in rows]
        named = replace(quantity, name=f"{name}_{quantity.name}", dims=(name, *quantity.dims))
        hint = _hints(kind)[quantity.name]
        inner = (len(get_args(hint)),) if get_origin(hint) is tuple else ()
        if hint is str:
            yield Labelled(replace(named, unit=""), np.asarray(column, dtype=object))
        else:
            plain = hint if hint in (int, bool) else float
            yield Labelled(named, np.asarray(column, dtype=plain).reshape(len(column), *inner))


def _rows_made(kind: Any, values: Mapping[str, Any], name: str) -> tuple[Any, ...]:
    hints = _hints(kind)
    names = [item.name for item in stored_quantities(kind)]
    if not any(f"{name}_{key}" in values for key in names):
        return ()
    columns = [[_one(hints[key], value) for value in np.asarray(values[f"{name}_{key}"])] for key in names]
    return tuple(kind(**dict(zip(names, row, strict=True))) for row in zip(*columns, strict=True))


@cache
def _hints(kind: Any) -> dict[str, Any]:
    """Types of the fields of ``kind``; other annotations of it may name what only type checkers
    import."""
    names, found = {item.name for item in fields(kind)}, dict[str, Any]()
    for base in reversed(kind.__mro__):
        own = {name: text for name, text in get_annotations(base).items() if name in names}
        found |= get_type_hints(type(base.__name__, (), {"__annotations__": own, "__module__": base.__module__}))
    return found


@cache
def _columns(kind: Any) -> dict[str, tuple[Quantity, ...]]:
    return {item.name: item.metadata.get(COLUMNS, ()) for item in fields(kind)}


def _nested(hint: Any) -> Any:
    """The dataclass that the type ``hint`` is, or is where it is not None; None if it is something
    else."""
    kinds = [kind for kind in get_args(hint) if kind is not type(None)] if type(None) in get_args(hint) else [hint]
    inner = kinds[0] if len(kinds) == 1 else None
    return inner if isinstance(inner, type) and is_dataclass(inner) else None


def _row_kind(hint: Any) -> Any:
    """The dataclass of which the type ``hint`` is a tuple; None if it is something else."""
    inside = get_args(hint)[:1] if get_origin(hint) is tuple else ()
    return inside[0] if inside and isinstance(inside[0], type) and is_dataclass(inside[0]) else None


# Groups, and steps of a history.


def group_of(found: Any) -> Node:
    """Group of a dataclass."""
    return Node(tuple(values_of(found)), {KIND: kind_name(type(found))})


def values_in(node: Node) -> dict[str, Any]:
    """Values of a group by name."""
    return {item.quantity.name: item.values for item in node.values}


def stacked(rows: Sequence[Mapping[str, Labelled] | None]) -> tuple[Labelled, ...]:
    """Values of every step of a history by name, None for a step without: along ``step``, or in
    rows with a count for each step."""
    names = dict.fromkeys(name for row in rows if row is not None for name in row)
    found: list[Labelled] = []
    for name in names:
        quantity = next(row[name].quantity for row in rows if row is not None and name in row)
        values = [None if row is None or name not in row else np.asarray(row[name].values) for row in rows]
        example = next(value for value in values if value is not None)
        if not example.ndim or set(quantity.dims) & set(GRID_AXES):
            none = np.asarray("") if example.dtype.kind in "UO" else np.zeros(example.shape, example.dtype)
            each = [none if value is None else value for value in values]
            along: Any = Stack(tuple(each)) if example.ndim else np.stack(each)
            found.append(Labelled(replace(quantity, dims=("step", *quantity.dims)), along))
            continue
        counts = np.array([0 if value is None else len(value) for value in values])
        label = f"how many {quantity.label} of the step"
        found.append(Labelled(Quantity(name + COUNT, "1", label, ("step",)), counts))
        dims = (f"{name}_row", *quantity.dims[1:])
        found.append(Labelled(replace(quantity, dims=dims), np.concatenate([v for v in values if v is not None])))
    return tuple(found)


class Steps:
    """Values of the steps of a history in a group that ``stacked`` made."""

    def __init__(self, node: Node) -> None:
        self._along, self._rows = dict[str, Any](), dict[str, tuple[Any, Any]]()
        self._length = node.dims().get("step", 0)
        whole = values_in(node)
        for item in node.values:
            name, values = item.quantity.name, item.values
            if name + COUNT in whole:
                self._rows[name] = values, np.concatenate([[0], np.cumsum(whole[name + COUNT])])
            elif item.quantity.dims[:1] == ("step",):
                self._along[name] = values

    def at(self, step: int) -> dict[str, Any]:
        """Values of one ``step`` by name; none where no step from it on has what the group
        holds."""
        if step >= self._length:
            return {}
        found = {name: values[step] for name, values in self._along.items()}
        return found | {name: values[ends[step] : ends[step + 1]] for name, (values, ends) in self._rows.items()}


def steps_group(found: Sequence[Any], kind: type, places: Sequence[int]) -> Node:
    """Group of the same ``kind`` of dataclass in every step of a history, None where a step has
    none; ``places`` are those among all that a step has."""
    rows = [None if each is None else {item.quantity.name: item for item in values_of(each)} for each in found]
    here = Labelled(Quantity(HERE, "1", "place of this in the step, 0 if it has none", ("step",)), np.array(places))
    return Node((here, *stacked(rows)), {KIND: kind_name(kind)})
