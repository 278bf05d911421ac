"""One generated surface as a table of its own, checked as in a document."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import TypeAdapter, ValidationError

from ..core.errors import InputError
from ..core.settings import problems
from .schemas.surfaces import Generated, RandomSurface, Shape


def checked_surface(table: Mapping[str, Any], where: str, names: Mapping[str, str]) -> Shape | RandomSurface:
    """Surface described by ``table``.

    Parameters
    ----------
    table
        As under [surface] in a document.
    where
        What is checked, for the message.
    names
        What to call a dotted key in messages instead.

    Raises
    ------
    InputError
        If anything is missing, unknown or out of range; the message has one line for each problem.
    """
    adapter: TypeAdapter[Shape | RandomSurface] = TypeAdapter(Generated)
    try:
        return adapter.validate_python(dict(table))
    except ValidationError as error:
        lines = problems(error, adapter.json_schema(), names)
    if len(lines) == 1:
        raise InputError(f"{where}: {lines[0]}")
    raise InputError(f"{where} has {len(lines)} problems:\n" + "\n".join(f"  {line}" for line in lines))
