"""What a form asks, made from the declarations of a table: fields with label, help, unit, choices
and default, and tables within."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, Union, get_args, get_origin

from ..core import units
from ..core.errors import AsperityError
from ..core.parameters import Parameter, taken_apart
from ..core.settings import Settings, declared
from ..core.values import Choice, Flag, Interval, Number, Numbers, Several, Whole
from ..core.words import label_of

Shape = Literal["flag", "choice", "number", "text", "table", "kinds", "list"]


@dataclass(frozen=True)
class Asked:
    """One entry of a form.

    Attributes
    ----------
    name, label, help
        Key in the table, what it is called, and one line on it.
    shape
        How it is entered: a flag, one of ``choices``, a number or text with a unit, a ``table`` of
        entries, one of several ``kinds`` of tables, or a ``list`` of those.
    hint
        Example or default, shown where nothing has been entered.
    required
        Whether it must be given.
    parameter
        Its declaration.
    tables
        Table by its kind; the only one of a ``table`` under the empty name.
    tag
        Key that names the kind.
    """

    name: str
    label: str
    help: str
    shape: Shape
    hint: str
    required: bool
    parameter: Parameter
    choices: tuple[str, ...] = ()
    tables: Mapping[str, type[Settings]] | None = None
    tag: str = ""

    def text_of(self, value: Any) -> str:
        """Text of an entry that holds ``value``, as its declaration reads it."""
        if not isinstance(value, list | tuple):
            return "" if value is None else str(value)
        values = self.parameter.values
        between = "x" if isinstance(values, Numbers) else " : " if isinstance(values, Interval) else ", "
        return between.join(map(str, value))

    def problem(self, text: Any) -> str | None:
        """Why ``text`` cannot stand here; None if it can."""
        if text in (None, "") or self.tables is not None:
            return None
        values = self.parameter.values
        try:
            if isinstance(values, Several):
                parts = [part.strip() for part in text.split(",")] if isinstance(text, str) else text
                for part in parts:
                    values.item.read(part, self.label)
            else:
                values.read(text, self.label)
        except AsperityError as error:
            return str(error)
        return None


def asked_of(model: type[Settings], leave: frozenset[str] = frozenset()) -> tuple[Asked, ...]:
    """Entries of the form for the table ``model``, without the keys to ``leave``."""
    made = []
    for name, field in model.model_fields.items():
        if name in leave:
            continue
        item = declared(name, field)
        base, _ = taken_apart(item.annotation)
        made.append(_asked(item, base))
    return tuple(made)


def _asked(item: Parameter, base: Any) -> Asked:
    label = label_of(item.name)
    values, default = item.values, item.default
    plain = isinstance(default, str | int | float) and not isinstance(default, bool)
    hint = ""
    if plain and default != "":
        shown: Any = default
        if isinstance(values, Choice):
            shown = next((word for word, value in values.words.items() if default in (value, word)), str(default))
        elif isinstance(default, float) and item.unit:
            shown = units.show(default, item.unit)
        hint = f"default: {shown}"
    elif isinstance(values, Number) and values.words:
        hint = f"{units.EXAMPLES.get(values.quantity, 'a number')} or {', '.join(values.words)}"
    elif isinstance(values, Number) and values.percent:
        hint = "such as 5 %"
    elif isinstance(values, Number) and values.quantity:
        hint = f"such as {units.EXAMPLES.get(values.quantity, f'1 {values.unit}')}"
    given: dict[str, Any] = {
        "name": item.name,
        "label": label,
        "help": item.help.rstrip(".").replace("``", ""),
        "hint": hint,
        "required": item.required,
        "parameter": item,
    }
    inner = get_args(base)[0] if get_origin(base) is tuple and get_args(base) else None
    tables = tables_in(base if inner is None else inner)
    if tables:
        tag = next((key for key in ("kind", "step") if all(_constants(table, key) for table in tables)), "")
        by_kind = {word: table for table in tables for word in (_constants(table, tag) or ("",))}
        shape: Shape = "list" if inner is not None else "kinds" if len(by_kind) > 1 else "table"
        return Asked(shape=shape, tables=by_kind, tag=tag if len(by_kind) > 1 or inner is not None else "", **given)
    if isinstance(values, Flag):
        return Asked(shape="flag", **given)
    if isinstance(values, Choice):
        return Asked(shape="choice", choices=tuple(values.words), **given)
    return Asked(shape="number" if isinstance(values, Number | Whole) else "text", **given)


def tables_in(annotation: Any) -> tuple[type[Settings], ...]:
    """The tables that an ``annotation`` allows, each once."""
    base, _ = taken_apart(annotation)
    if isinstance(base, type):
        return (base,) if issubclass(base, Settings) else ()
    if get_origin(base) is Union or type(base).__name__ == "UnionType":
        return tuple(table for part in get_args(base) for table in tables_in(part))
    return ()


def _constants(table: type[Settings], key: str) -> tuple[str, ...]:
    """The words that the ``key`` of a ``table`` may be, if these are all it may be."""
    field = table.model_fields.get(key)
    if field is None:
        return ()
    base, _ = taken_apart(field.annotation)
    return tuple(map(str, get_args(base))) if get_origin(base) is Literal else ()
