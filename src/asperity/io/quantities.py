"""Values of a document in SI: every text whose kind of quantity the schema states becomes a number."""

from __future__ import annotations

from typing import Any, get_args

from pydantic.fields import FieldInfo

from ..core import units
from .schemas.values import Table


def si_values(table: Table, leave: tuple[str, ...] = ()) -> dict[str, Any]:
    """Values of ``table`` by key, quantities in SI units; without the keys to ``leave`` and those that are not given."""
    values: dict[str, Any] = {}
    for key, field in type(table).model_fields.items():
        value = getattr(table, key)
        if key not in leave and value is not None:
            values[key] = _in_si(value, quantity(field), key)
    return values


def quantity(field: FieldInfo) -> str | None:
    """Kind of quantity that the ``field`` of a model holds as text, None for any other."""
    found = _stated(field.json_schema_extra)
    for annotation in (*field.metadata, field.annotation):
        found = found or _within(annotation)
    return found


def _within(annotation: Any) -> str | None:
    """The kind of quantity in an annotation such as ``Length | None`` or ``tuple[Length, Length]``."""
    if isinstance(annotation, FieldInfo):
        return _stated(annotation.json_schema_extra)
    for part in (*getattr(annotation, "__metadata__", ()), *get_args(annotation)):
        found = _within(part)
        if found is not None:
            return found
    return None


def _stated(extra: Any) -> str | None:
    return extra.get("quantity") if isinstance(extra, dict) else None


def _in_si(value: Any, kind: str | None, key: str) -> Any:
    if kind is None or not isinstance(value, str | tuple):
        return value
    if isinstance(value, tuple):
        return tuple(_in_si(item, kind, key) for item in value)
    return units.parse_size(value, key) if kind == "size" else units.parse(value, kind, key)
