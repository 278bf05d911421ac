"""What the user asks of the parts: options derived from their settings, and the tables of the document they fill."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..core.errors import InputError
from .declared import Given, Option, options_of


def part_options(*names: str) -> tuple[Option, ...]:
    """Options for the settings of the parts with these ``names``; of all parts if none is named."""
    from ..parts.registry import BUILT_IN, parts

    found: list[Option] = []
    for part in parts():
        if part.settings is not None and (not names or part.name in names):
            prefix = "" if part in BUILT_IN else f"{part.name.replace('_', '-')}-"
            found += options_of(part.settings, (part.table,), panel=part.title, prefix=prefix)
    return tuple(found)


def with_parts(table: Mapping[str, Any], given: Given, asked: tuple[str, ...] = ()) -> dict[str, Any]:
    """``table`` of a document with what is ``given`` over it; the tables that are ``asked`` for are there in any case.

    Friction alone asks for the stresses that it causes.

    Raises
    ------
    InputError
        If a table is asked for that no part has.
    """
    from ..parts.registry import parts

    known = [part.table for part in parts() if part.settings is not None]
    made = dict(table)
    for name, values in given.table().items():
        before = made.get(name)
        made[name] = {**(before if isinstance(before, dict) else {}), **values}
    for name in asked:
        if name not in known:
            raise InputError(f"--with must be one of {', '.join(known)}, but is {name!r}.")
        made.setdefault(name, {})
    if "friction" in given.table() and "film" not in made:
        made.setdefault("stress", {})
    return made


def part_names(given: Given, *, everything: bool) -> dict[str, str]:
    """What the user calls the keys of the parts: those that are ``given``, or with ``everything`` all of them."""
    names = {
        ".".join(option.path): option.name for option in given.options if everything or option.path in given.values
    }
    tables = {name.partition(".")[0] for name in names}
    return {**{name: f"the {name.replace('_', ' ')}" for name in tables}, **names}
