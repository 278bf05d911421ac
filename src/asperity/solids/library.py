"""Named materials. Every value carries its source; a user's own file overrides and extends the built-in list."""

from __future__ import annotations

import difflib
import tomllib
from dataclasses import dataclass, fields, replace
from importlib import resources
from pathlib import Path
from typing import Any

from ..core import require, units
from ..core.errors import FileFormatError, InputError
from .elastic import INCOMPRESSIBLE, Elastic
from .strength import Strength

REQUIRED_KEYS = ("youngs_modulus", "poisson_ratio")
"""Keys that every material in a file must have."""

OPTIONAL_KEYS = ("hardness", "yield_stress", "aliases", "note")
"""Keys that a material in a file may have."""

BUILT_IN = "materials.toml"
"""Name of the built-in material file, as shown in messages."""


@dataclass(frozen=True)
class Sourced:
    """SI ``value`` (Pa, or dimensionless for Poisson's ratio) with the text of its ``source``.

    A source that begins with ``assumed:`` marks a value that was not measured on this very material.
    """

    value: float
    source: str

    @property
    def assumed(self) -> bool:
        """Whether the value is an assumption."""
        return self.source.startswith("assumed:")


@dataclass(frozen=True)
class MaterialRecord:
    """Elastic constants and strength of one named material.

    Parameters
    ----------
    name, aliases
        Names under which it is found, in any case.
    youngs_modulus
        E in Pa, > 0.
    poisson_ratio
        nu, -1 < nu <= 0.5.
    hardness, yield_stress
        Hardness and tensile yield stress in Pa, > 0; None where not known.
    note
        Condition of the material or caveat.
    """

    name: str
    youngs_modulus: Sourced
    poisson_ratio: Sourced
    hardness: Sourced | None = None
    yield_stress: Sourced | None = None
    aliases: tuple[str, ...] = ()
    note: str = ""

    @property
    def values(self) -> dict[str, Sourced]:
        """The known values by key, in the order of the fields."""
        found = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: value for key, value in found.items() if isinstance(value, Sourced)}

    @property
    def body(self) -> Elastic:
        """Half-space of this material, with name, strength and one source a value."""
        return Elastic(
            self.youngs_modulus.value,
            self.poisson_ratio.value,
            Strength(
                hardness=self.hardness.value if self.hardness else float("nan"),
                yield_stress=self.yield_stress.value if self.yield_stress else float("nan"),
            ),
            name=self.name,
            sources=tuple(f"{key}: {value.source}" for key, value in self.values.items()),
        )


def materials(path: str | Path | None = None) -> tuple[MaterialRecord, ...]:
    """All materials: the built-in ones, and those of the TOML file at ``path`` if given.

    A name or alias in the user's file wins over the same name or alias in the built-in list. Keys of a material are
    ``youngs_modulus`` and ``poisson_ratio`` (required), ``hardness``, ``yield_stress``, ``aliases`` and ``note``; a
    value is text with a unit (``"140 GPa"``) or ``{ value = "140 GPa", source = "..." }``, the source being
    "user" by default.

    Raises
    ------
    InputError
        If the file is missing or not TOML, or a key or value in it cannot be used.
    """
    text = resources.files(__package__).joinpath("data", BUILT_IN).read_text(encoding="utf-8")
    built_in = _parse_records(text, BUILT_IN)
    if path is None:
        return built_in
    own = _parse_records(_read_text(Path(path)), str(path))
    taken = {key for record in own for key in _lookup_keys(record)}
    kept = (
        replace(record, aliases=tuple(alias for alias in record.aliases if _normal(alias) not in taken))
        for record in built_in
        if _normal(record.name) not in taken
    )
    return (*kept, *own)


def material(name: str, *, library: str | Path | None = None) -> Elastic:
    """Half-space of the material ``name`` (or alias, in any case) from the built-in list or the file ``library``.

    Raises
    ------
    InputError
        If no material has that name, with the nearest names, or if the file cannot be used (see ``materials``).
    """
    index = {key: record for record in materials(library) for key in _lookup_keys(record)}
    wanted = _normal(str(name))
    if wanted in index:
        return index[wanted].body
    containing = [key for key in index if wanted and wanted in key.split()]
    near = (*containing, *difflib.get_close_matches(wanted, index, n=3))
    names = list(dict.fromkeys(index[key].name for key in near))[:3]
    hint = f"did you mean {' or '.join(names)}? The command `asperity materials` lists all names."
    raise InputError(
        f"material must be a name in the material library, but is {name!r}; "
        + (hint if names else "the command `asperity materials` lists all names.")
    )


def _normal(name: str) -> str:
    return " ".join(name.casefold().split())


def _lookup_keys(record: MaterialRecord) -> tuple[str, ...]:
    return tuple(_normal(name) for name in (record.name, *record.aliases))


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileFormatError(f"material file must exist, but {path} does not; check the path.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"material file must be a readable text file in UTF-8, but {path} is not: {error}."
        ) from None


def _parse_records(text: str, file: str) -> tuple[MaterialRecord, ...]:
    """Records of the TOML ``text``; ``file`` names it in messages."""
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise FileFormatError(f"material file must be valid TOML, but {file} is not: {error}.") from None
    tables = document.get("material")
    unknown = sorted(set(document) - {"material"})
    if unknown or not isinstance(tables, dict) or not tables:
        received = f"the key {unknown[0]!r}" if unknown else "no such table"
        raise InputError(f'material file {file} must hold tables [material."name"] only, but has {received}.')
    records = tuple(_record(name, table, file) for name, table in tables.items())
    owner: dict[str, str] = {}
    for record in records:
        for key in _lookup_keys(record):
            if owner.setdefault(key, record.name) != record.name:
                raise InputError(
                    f"names and aliases in material file {file} must be distinct, but {key!r} belongs to both "
                    f"{owner[key]!r} and {record.name!r}; rename one."
                )
    return records


def _record(name: str, table: object, file: str) -> MaterialRecord:
    where = f"of material {name!r} in {file}"
    if not isinstance(table, dict):
        raise InputError(f"entry {where} must be a table with {' and '.join(REQUIRED_KEYS)}, but is {table!r}.")
    unknown = sorted(set(table) - {*REQUIRED_KEYS, *OPTIONAL_KEYS})
    if unknown:
        raise InputError(
            f"key {where} must be one of {', '.join(REQUIRED_KEYS + OPTIONAL_KEYS)}, but is {unknown[0]!r}."
        )
    for key in REQUIRED_KEYS:
        if key not in table:
            raise InputError(f"{key} {where} must be given, but is missing.")
    aliases, note = table.get("aliases", []), table.get("note", "")
    if not isinstance(aliases, list) or not all(isinstance(alias, str) for alias in aliases):
        raise InputError(f'aliases {where} must be a list of names, such as ["steel"], but is {aliases!r}.')
    if not isinstance(note, str):
        raise InputError(f"note {where} must be text, but is {note!r}.")
    values = {key: _sourced(key, table[key], where) for key in (*REQUIRED_KEYS, *OPTIONAL_KEYS[:2]) if key in table}
    return MaterialRecord(name, aliases=tuple(aliases), note=note, **values)


def _sourced(key: str, entry: Any, where: str) -> Sourced:
    """Value of ``key`` from ``entry``, a bare value or a table with value and source."""
    what = f"{key} {where}"
    if not isinstance(entry, dict):
        entry = {"value": entry}
    if "value" not in entry or set(entry) - {"value", "source"}:
        raise InputError(
            f"{what} must have a value and may have a source, but has the keys {', '.join(entry) or 'none'}."
        )
    source = entry.get("source", "user")
    if not isinstance(source, str) or not source.strip():
        raise InputError(f"source of {what} must be text, but is {source!r}.")
    value = entry["value"]
    if key == "poisson_ratio":
        return Sourced(require.within(value, -1.0, 0.5, what, INCOMPRESSIBLE), source)
    return Sourced(require.positive(units.parse(value, "pressure", what), f"{what} (Pa)"), source)
