"""Values of one scalar of a problem document, in a list, and limits of a quantity."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator, model_validator

from ...core.errors import InputError
from ...core.settings import Settings
from ...core.values import NonEmpty

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


class LimitTable(Settings):
    """A ``quantity`` that must be ``at_least`` or ``at_most`` a limit, text with a unit where it
    has one."""

    quantity: NonEmpty
    at_least: str | int | float | None = None
    at_most: str | int | float | None = None

    @model_validator(mode="after")
    def _one_limit(self) -> LimitTable:
        if (self.at_least is None) == (self.at_most is None):
            given = "neither" if self.at_least is None else "both"
            raise InputError(f" must give exactly one of at_least and at_most, but gives {given}.")
        return self
