"""Words and kinds of value that only documents of contact problems hold; all others are those of ``core.values``."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from ...contact.solvers.by_name import SOLVERS
from ...core import units
from ...core.errors import InputError
from ...core.values import Choice, Number, Values

FROM_BODY = "from body"
"""Hardness that stands for the lowest known hardness of the two bodies."""

EFFECTIVE = "effective"
"""Hardness that stands for that of the softer body with all its layers, by the depth of the indentation."""

NONE = "0"
"""Turning point of a load path without load."""

MIDDLE = "middle"
"""Word for a position: of the line in the middle of a map."""


class _Channel(Values):
    """Name of a data channel, or its number, 0 or more."""

    metavar = "NAME"

    def read(self, value: Any, what: str) -> str | int:
        """The name or number."""
        if (isinstance(value, str) and value.strip()) or (type(value) is int and value >= 0):
            found: str | int = value
            return found
        raise InputError(f"{what} must be the name of a channel or its number, 0 or more, but is {value!r}.")

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """Text or a number."""
        return {"anyOf": [{"type": "string"}, {"type": "integer", "minimum": 0}]}


class _LengthUnit(Values):
    """Name of a unit of length."""

    metavar = "UNIT"

    def read(self, value: Any, what: str) -> str:
        """The name."""
        units.unit_factor(str(value), "length", what)
        return str(value)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """Text."""
        return {"type": "string", "examples": ["nm"]}


Channel: TypeAlias = Annotated[str | int, _Channel()]
HeightUnit: TypeAlias = Annotated[str, _LengthUnit()]
Method: TypeAlias = Annotated[str, Choice({name: name for name in SOLVERS})]
PressureOrBody: TypeAlias = Annotated[float | str, Number("pressure", above=0.0, words=(FROM_BODY, EFFECTIVE))]
PathPressure: TypeAlias = Annotated[float | str, Number("pressure", least=0.0, words=(NONE,))]
PathForce: TypeAlias = Annotated[float | str, Number("force", least=0.0, words=(NONE,))]
PathLength: TypeAlias = Annotated[float | str, Number("length", least=0.0, words=(NONE,))]
