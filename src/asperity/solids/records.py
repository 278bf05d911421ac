"""Libraries of named records in TOML, every value with its source: how files are read and names are found."""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import resources
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ..core.errors import FileFormatError, InputError


class Named(Protocol):
    """A frozen dataclass with the names it is found under."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def aliases(self) -> tuple[str, ...]:
        """Other names."""


Record = TypeVar("Record", bound=Named)


@dataclass(frozen=True)
class Sourced:
    """SI ``value`` with the text of its ``source``.

    A source that begins with ``assumed:`` marks a value that was not measured on this very substance.
    """

    value: float
    source: str

    @property
    def assumed(self) -> bool:
        """Whether the value is an assumption."""
        return self.source.startswith("assumed:")


@dataclass(frozen=True)
class Kind:
    """What a library holds: ``noun`` for messages and tables, the command that ``lists`` it, keys of its records.

    ``values`` are the keys of sourced values, the ``required`` ones first.
    """

    noun: str
    lists: str
    required: tuple[str, ...]
    values: tuple[str, ...]

    @property
    def keys(self) -> tuple[str, ...]:
        """Every key of a record."""
        return (*self.values, "aliases", "note")


def built_in_text(name: str) -> str:
    """Text of the built-in library file ``name``."""
    return resources.files(__package__).joinpath("data", name).read_text(encoding="utf-8")


def read_text(path: Path, kind: Kind) -> str:
    """Text of a user's library file.

    Raises
    ------
    FileFormatError
        If it does not exist or is no text.
    """
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileFormatError(f"{kind.noun} file must exist, but {path} does not; check the path.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"{kind.noun} file must be a readable text file in UTF-8, but {path} is not: {error}."
        ) from None


def parsed(text: str, file: str, kind: Kind, make: Callable[[str, Any, str], Record]) -> tuple[Record, ...]:
    """Records that ``make`` makes of name and table of each entry of the TOML ``text``, and of the name of the ``file``.

    Raises
    ------
    FileFormatError
        If the text is no TOML.
    InputError
        If it holds anything else, or names are not distinct.
    """
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FileFormatError(f"{kind.noun} file must be valid TOML, but {file} is not: {error}.") from None
    tables = document.get(kind.noun)
    unknown = sorted(set(document) - {kind.noun})
    if unknown or not isinstance(tables, dict) or not tables:
        received = f"the key {unknown[0]!r}" if unknown else "no such table"
        raise InputError(f'{kind.noun} file {file} must hold tables [{kind.noun}."name"] only, but has {received}.')
    records = tuple(make(name, table, file) for name, table in tables.items())
    owner: dict[str, str] = {}
    for record in records:
        for key in lookup_keys(record):
            if owner.setdefault(key, record.name) != record.name:
                raise InputError(
                    f"names and aliases in {kind.noun} file {file} must be distinct, but {key!r} belongs to both "
                    f"{owner[key]!r} and {record.name!r}; rename one."
                )
    return records


def checked(name: str, table: Any, file: str, kind: Kind) -> tuple[str, Mapping[str, Any], tuple[str, ...], str]:
    """What messages call the record, its values by key, its aliases and its note; all as a file of this ``kind`` must be.

    Raises
    ------
    InputError
        If a key is unknown or missing, or aliases or note are not text.
    """
    where = f"of {kind.noun} {name!r} in {file}"
    if not isinstance(table, dict):
        raise InputError(f"entry {where} must be a table with {' and '.join(kind.required)}, but is {table!r}.")
    unknown = sorted(set(table) - set(kind.keys))
    if unknown:
        raise InputError(f"key {where} must be one of {', '.join(kind.keys)}, but is {unknown[0]!r}.")
    for key in kind.required:
        if key not in table:
            raise InputError(f"{key} {where} must be given, but is missing.")
    aliases, note = table.get("aliases", []), table.get("note", "")
    if not isinstance(aliases, list) or not all(isinstance(alias, str) for alias in aliases):
        raise InputError(f'aliases {where} must be a list of names, such as ["steel"], but is {aliases!r}.')
    if not isinstance(note, str):
        raise InputError(f"note {where} must be text, but is {note!r}.")
    return where, {key: table[key] for key in kind.values if key in table}, tuple(aliases), note


def sourced(entry: Any, what: str, convert: Callable[[Any], float]) -> Sourced:
    """Value from ``entry``, a bare value or a table with value and source, by ``convert``.

    Raises
    ------
    InputError
        If the entry has other keys, or the source is no text.
    """
    if not isinstance(entry, dict):
        entry = {"value": entry}
    if "value" not in entry or set(entry) - {"value", "source"}:
        raise InputError(
            f"{what} must have a value and may have a source, but has the keys {', '.join(entry) or 'none'}."
        )
    source = entry.get("source", "user")
    if not isinstance(source, str) or not source.strip():
        raise InputError(f"source of {what} must be text, but is {source!r}.")
    return Sourced(convert(entry["value"]), source)


def overridden(built_in: Sequence[Record], own: Sequence[Record]) -> tuple[Record, ...]:
    """Both lists; a name or alias in ``own`` wins over the same in ``built_in``."""
    taken = {key for record in own for key in lookup_keys(record)}
    kept = (
        replace(  # type: ignore[type-var]
            record, aliases=tuple(alias for alias in record.aliases if normal(alias) not in taken)
        )
        for record in built_in
        if normal(record.name) not in taken
    )
    return (*kept, *own)


def find(name: str, records: Iterable[Record], kind: Kind) -> Record:
    """Record with that name or alias, in any case.

    Raises
    ------
    InputError
        If there is none, with the nearest names.
    """
    index = {key: record for record in records for key in lookup_keys(record)}
    wanted = normal(str(name))
    if wanted in index:
        return index[wanted]
    containing = [key for key in index if wanted and wanted in key.split()]
    near = (*containing, *difflib.get_close_matches(wanted, index, n=3))
    names = list(dict.fromkeys(index[key].name for key in near))[:3]
    hint = f"did you mean {' or '.join(names)}? The command `{kind.lists}` lists all names."
    raise InputError(
        f"{kind.noun} must be a name in the {kind.noun} library, but is {name!r}; "
        + (hint if names else f"the command `{kind.lists}` lists all names.")
    )


def normal(name: str) -> str:
    """Name as it is compared: in lower case, with single spaces."""
    return " ".join(name.casefold().split())


def lookup_keys(record: Named) -> tuple[str, ...]:
    """Names under which ``record`` is found."""
    return tuple(normal(name) for name in (record.name, *record.aliases))
