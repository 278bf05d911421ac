"""Kinds of quantity that the fields of tables hold."""

from __future__ import annotations

from pydantic.fields import FieldInfo

from ..core.settings import declared
from ..core.values import Interval, Lengths, Number, Several


def quantity(field: FieldInfo) -> str | None:
    """Kind of quantity that the ``field`` of a table holds as text, None for any other."""
    values = declared("", field).values
    values = values.item if isinstance(values, Several) else values
    if isinstance(values, Lengths | Interval):
        return "size" if isinstance(values, Lengths) else "length"
    return values.quantity or None if isinstance(values, Number) else None
