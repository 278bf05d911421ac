"""Materials and liquids by name, with a source for every value."""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from importlib import resources
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ..core import require, units
from ..core.errors import FileFormatError, InputError
from .elastic import INCOMPRESSIBLE, Elastic, Strength

# Libraries of named records in TOML, every value with its source: how files are read and names are found.


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


# Named materials. Every value carries its source; a user's own file overrides and extends the built-in list.


KIND = Kind(
    "material",
    "asperity materials",
    required=("youngs_modulus", "poisson_ratio"),
    values=("youngs_modulus", "poisson_ratio", "hardness", "yield_stress"),
)
"""Keys of a material in a file."""

BUILT_IN = "materials.toml"
"""Name of the built-in material file, as shown in messages."""


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
    built_in = parsed(built_in_text(BUILT_IN), BUILT_IN, KIND, _record)
    if path is None:
        return built_in
    return overridden(built_in, parsed(read_text(Path(path), KIND), str(path), KIND, _record))


def material(name: str, *, library: str | Path | None = None) -> Elastic:
    """Half-space of the material ``name`` (or alias, in any case) from the built-in list or the file ``library``.

    Raises
    ------
    InputError
        If no material has that name, with the nearest names, or if the file cannot be used (see ``materials``).
    """
    return find(name, materials(library), KIND).body


def _record(name: str, table: Any, file: str) -> MaterialRecord:
    where, entries, aliases, note = checked(name, table, file, KIND)
    values = {
        key: sourced(entry, f"{key} {where}", _conversion(key, f"{key} {where}")) for key, entry in entries.items()
    }
    return MaterialRecord(name, aliases=aliases, note=note, **values)


def _conversion(key: str, what: str) -> Callable[[Any], float]:
    """How the value of ``key`` is read."""
    if key == "poisson_ratio":
        return lambda value: require.within(value, -1.0, 0.5, what, INCOMPRESSIBLE)
    return lambda value: require.positive(units.parse(value, "pressure", what), f"{what} (Pa)")


# Named liquids between surfaces. Every value carries its source; a user's own file overrides and extends the list.


KIND_LIQUIDS = Kind(
    "liquid",
    "asperity liquids",
    required=("surface_tension", "temperature"),
    values=("surface_tension", "temperature", "molar_volume", "viscosity"),
)
"""Keys of a liquid in a file."""

DIMENSIONS = {
    "surface_tension": "surface tension",
    "temperature": "temperature",
    "molar_volume": "molar volume",
    "viscosity": "viscosity",
}
"""Kind of quantity of each value."""

BUILT_IN_LIQUIDS = "liquids.toml"
"""Name of the built-in liquid file, as shown in messages."""

WATER = "water"
"""The liquid whose adsorbed film follows from the humidity."""


@dataclass(frozen=True)
class Liquid:
    """What a film between surfaces needs of its liquid.

    Parameters
    ----------
    surface_tension
        γ in N/m, > 0.
    temperature
        In K at which the values hold, > 0.
    molar_volume, viscosity
        m³/mol and Pa s; NaN where not known.
    name, sources
        Name of the liquid and where its values come from.

    Raises
    ------
    InputError
        If a value is not positive.
    """

    surface_tension: float
    temperature: float = 293.15
    molar_volume: float = math.nan
    viscosity: float = math.nan
    name: str = ""
    sources: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require.positive(self.surface_tension, "surface tension (N/m)")
        require.positive(self.temperature, "temperature (K)")
        for value, what in ((self.molar_volume, "molar volume (m^3/mol)"), (self.viscosity, "viscosity (Pa s)")):
            if not math.isnan(value):
                require.positive(value, what)

    def require_molar_volume(self) -> float:
        """Molar volume in m³/mol.

        Raises
        ------
        InputError
            If it is not known.
        """
        if math.isnan(self.molar_volume):
            raise InputError(
                f"molar volume of {self.name or 'the liquid'} must be known for menisci at a humidity, but is not. "
                "Give the film thickness and the meniscus height instead; lubricants have no vapour to speak of."
            )
        return self.molar_volume

    @property
    def adsorbs_as_water(self) -> bool:
        """Whether the empirical film of water on carbon holds for it."""
        return self.name == WATER


@dataclass(frozen=True)
class LiquidRecord:
    """Surface tension (N/m), temperature (K), molar volume (m³/mol) and viscosity (Pa s) of one named liquid.

    ``name`` and ``aliases`` find it, in any case; ``note`` is its condition or a caveat.
    """

    name: str
    surface_tension: Sourced
    temperature: Sourced
    molar_volume: Sourced | None = None
    viscosity: Sourced | None = None
    aliases: tuple[str, ...] = ()
    note: str = ""

    @property
    def values(self) -> dict[str, Sourced]:
        """The known values by key, in the order of the fields."""
        found = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: value for key, value in found.items() if isinstance(value, Sourced)}

    @property
    def liquid(self) -> Liquid:
        """The liquid, with name and one source a value."""
        numbers = {key: item.value for key, item in self.values.items()}
        sources = tuple(f"{key}: {item.source}" for key, item in self.values.items())
        return Liquid(**numbers, name=self.name, sources=sources)


def liquids(path: str | Path | None = None) -> tuple[LiquidRecord, ...]:
    """All liquids: the built-in ones, and those of the TOML file at ``path`` if given.

    The file has tables ``[liquid."name"]`` with ``surface_tension`` and ``temperature`` (required), ``molar_volume``,
    ``viscosity``, ``aliases`` and ``note``; a value is text with a unit (``"72 mN/m"``) or
    ``{ value = "72 mN/m", source = "..." }``. Its names win over built-in ones.

    Raises
    ------
    InputError
        If the file is missing or not TOML, or a key or value in it cannot be used.
    """
    built_in = parsed(built_in_text(BUILT_IN_LIQUIDS), BUILT_IN_LIQUIDS, KIND_LIQUIDS, _record_liquids)
    if path is None:
        return built_in
    return overridden(built_in, parsed(read_text(Path(path), KIND_LIQUIDS), str(path), KIND_LIQUIDS, _record_liquids))


def liquid(name: str, *, library: str | Path | None = None) -> Liquid:
    """Liquid ``name`` (or alias, in any case) from the built-in list or the file ``library``.

    Raises
    ------
    InputError
        If no liquid has that name, with the nearest names, or if the file cannot be used (see ``liquids``).
    """
    return find(name, liquids(library), KIND_LIQUIDS).liquid


def _record_liquids(name: str, table: Any, file: str) -> LiquidRecord:
    where, entries, aliases, note = checked(name, table, file, KIND_LIQUIDS)
    values = {
        key: sourced(entry, f"{key} {where}", _conversion_liquids(key, f"{key} {where}"))
        for key, entry in entries.items()
    }
    return LiquidRecord(name, aliases=aliases, note=note, **values)


def _conversion_liquids(key: str, what: str) -> Callable[[Any], float]:
    unit = units.DIMENSIONS[DIMENSIONS[key]]
    return lambda value: require.positive(units.parse(value, DIMENSIONS[key], what), f"{what} ({unit})")
