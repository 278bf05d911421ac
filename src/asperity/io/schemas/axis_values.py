"""Values of one scalar of a problem document, in a list."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator

Value: TypeAlias = str | int | float | tuple[int, int]
"""One value of an axis: text with a unit where the document has one, a number, or the points of a
grid."""


def _values(value: object) -> object:
    """A list of values, of which pairs may be lists, as tuples."""
    if not isinstance(value, list | tuple):
        return value
    return tuple(tuple(item) if isinstance(item, list) else item for item in value)


Values: TypeAlias = Annotated[tuple[Value, ...], BeforeValidator(_values)]
"""Values of an axis in the order given."""
