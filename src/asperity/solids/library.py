"""Materials and liquids by name, with a source for every value; a user's own TOML file overrides
and extends the built-in one."""

from __future__ import annotations

import difflib
import functools
import math
import tomllib
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields, replace
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Self, TypeVar, get_type_hints

from ..core import require, units
from ..core.errors import FileFormatError, InputError
from ..core.late import Tabled
from ..core.text import read_text
from .elastic import INCOMPRESSIBLE, Conduction, Elastic, Hardening, Strength
from .plasticity import LinearHardening, Swift, Voce
from .relaxation import Relaxation
from .relaxation_text import AT, series_of, shift_of
from .viscoelastic import TemperatureShift, Viscoelastic


@dataclass(frozen=True)
class Sourced:
    """SI ``value`` with the text of its ``source``.

    A source that begins with ``assumed:`` marks a value that was not measured on this very
    substance.
    """

    value: float
    source: str

    @property
    def assumed(self) -> bool:
        """Whether the value is an assumption."""
        return self.source.startswith("assumed:")


@dataclass(frozen=True, kw_only=True)
class Record:
    """A named substance: ``name`` and ``aliases`` find it, in any case; ``note`` is its condition
    or a caveat.

    A kind of substance adds its values as fields, marked with the kind of quantity ("ratio" for a
    Poisson's ratio), with the default None where a file may leave them out, and has in ``noun``
    what messages and tables of files call it.
    """

    name: str
    aliases: tuple[str, ...] = ()
    note: str = ""
    noun: ClassVar[str]
    more: ClassVar[tuple[str, ...]] = ()
    """Further keys that a kind of substance reads by itself."""

    @classmethod
    @functools.cache
    def kinds(cls) -> Mapping[str, str]:
        """Kind of quantity of each value, by key."""
        hints = get_type_hints(cls, include_extras=True)
        found = {key: hint.__metadata__[0] for key, hint in hints.items() if hasattr(hint, "__metadata__")}
        return MappingProxyType(found)

    @property
    def values(self) -> dict[str, Sourced]:
        """The known values by key."""
        found = {key: getattr(self, key) for key in self.kinds()}
        return {key: value for key, value in found.items() if value is not None}

    @property
    def sources(self) -> tuple[str, ...]:
        """One text a value: its key and its source."""
        return tuple(f"{key}: {value.source}" for key, value in self.values.items())

    @property
    def keys(self) -> tuple[str, ...]:
        """Name and aliases as they are compared: in lower case, with single spaces."""
        return tuple(_normal(name) for name in (self.name, *self.aliases))

    @classmethod
    def all(cls, path: str | Path | None = None) -> Records[Self]:
        """The built-in records, and those of the TOML file at ``path``, whose names and aliases
        win.

        The file has tables ``[noun."name"]`` with the keys of the values, ``aliases`` and ``note``;
        a value is text with a unit (``"140 GPa"``) or ``{ value = "140 GPa", source = "..." }``,
        the source being "user" by default.

        FileFormatError if the file is missing, no text in UTF-8 or no TOML; InputError if a key is
        unknown or missing, a value cannot be used, or names are not distinct.
        """
        file = f"{cls.noun}s.toml"
        text = resources.files(__package__).joinpath("data", file).read_text(encoding="utf-8")
        built_in = cls._parsed(text, file)
        if path is None:
            return Records(built_in)
        own = cls._parsed(read_text(path, f"{cls.noun} file"), str(path))
        taken = {key for record in own for key in record.keys}
        kept = (
            replace(record, aliases=tuple(alias for alias in record.aliases if _normal(alias) not in taken))
            for record in built_in
            if record.keys[0] not in taken
        )
        return Records((*kept, *own))

    @classmethod
    def find(cls, name: str, path: str | Path | None = None) -> Self:
        """Record with that name or alias, in any case; errors as for ``all``.

        InputError if there is none, with the nearest names.
        """
        index = {key: record for record in cls.all(path) for key in record.keys}
        wanted = _normal(str(name))
        if wanted in index:
            return index[wanted]
        containing = [key for key in index if wanted and wanted in key.split()]
        near = (*containing, *difflib.get_close_matches(wanted, index, n=3))
        names = list(dict.fromkeys(index[key].name for key in near))[:3]
        hint = f"did you mean {' or '.join(names)}? The" if names else "the"
        raise InputError(
            f"{cls.noun} must be a name in the {cls.noun} library, but is {name!r}; "
            f"{hint} command `asperity {cls.noun}s` lists all names."
        )

    @classmethod
    def _parsed(cls, text: str, file: str) -> tuple[Self, ...]:
        try:
            document = tomllib.loads(text)
        except (ValueError, RecursionError) as error:
            raise FileFormatError(f"{cls.noun} file must be valid TOML, but {file} is not: {error}.") from None
        tables = document.get(cls.noun)
        unknown = sorted(set(document) - {cls.noun})
        if unknown or not isinstance(tables, dict) or not tables:
            received = f"the key {unknown[0]!r}" if unknown else "no such table"
            raise InputError(f'{cls.noun} file {file} must hold tables [{cls.noun}."name"] only, but has {received}.')
        records = tuple(cls._of(table, name, f"of {cls.noun} {name!r} in {file}") for name, table in tables.items())
        owner: dict[str, str] = {}
        for record in records:
            for key in record.keys:
                if owner.setdefault(key, record.name) != record.name:
                    raise InputError(
                        f"names and aliases in {cls.noun} file {file} must be distinct, but {key!r} belongs to both "
                        f"{owner[key]!r} and {record.name!r}; rename one."
                    )
        return records

    @classmethod
    def _of(cls, table: Any, name: str, where: str) -> Self:
        """The record ``name`` of a table; ``where`` it stands, for messages."""
        kinds, defaults = cls.kinds(), {item.name: item.default for item in fields(cls)}
        required = [key for key in kinds if defaults[key] is MISSING]
        if not isinstance(table, dict):
            raise InputError(f"entry {where} must be a table with {' and '.join(required)}, but is {table!r}.")
        known = (*kinds, *cls.more, "aliases", "note")
        unknown = sorted(set(table) - set(known))
        if unknown:
            raise InputError(f"key {where} must be one of {', '.join(known)}, but is {unknown[0]!r}.")
        for key in required:
            if key not in table:
                raise InputError(f"{key} {where} must be given, but is missing.")
        aliases, note = table.get("aliases", []), table.get("note", "")
        if not isinstance(aliases, list) or not all(isinstance(alias, str) for alias in aliases):
            raise InputError(f'aliases {where} must be a list of names, such as ["steel"], but is {aliases!r}.')
        if not isinstance(note, str):
            raise InputError(f"note {where} must be text, but is {note!r}.")
        values: dict[str, Any] = {}
        for key, kind in kinds.items():
            if key not in table:
                continue
            what = f"{key} {where}"
            entry = table[key] if isinstance(table[key], dict) else {"value": table[key]}
            if "value" not in entry or set(entry) - {"value", "source"}:
                raise InputError(
                    f"{what} must have a value and may have a source, but has the keys {', '.join(entry) or 'none'}."
                )
            source, value = entry.get("source", "user"), entry["value"]
            if not isinstance(source, str) or not source.strip():
                raise InputError(f"source of {what} must be text, but is {source!r}.")
            if kind == "ratio":
                ratio = units.parse(value, "number", what) if isinstance(value, str) else value
                number = require.within(ratio, -1.0, 0.5, what, INCOMPRESSIBLE)
            else:
                number = require.positive(units.parse(value, kind, what), f"{what} ({units.DIMENSIONS[kind]})")
            values[key] = Sourced(number, source)
        return cls(name=name, aliases=tuple(aliases), note=note, **values)


R = TypeVar("R", bound=Record)


class Records(Tabled, tuple[R, ...]):
    """Records of substances, which show themselves as a table."""


def _normal(name: str) -> str:
    return " ".join(name.casefold().split())


@dataclass(frozen=True, kw_only=True)
class MaterialRecord(Record):
    """Young's modulus, hardness and tensile yield stress in Pa, > 0, and Poisson's ratio, -1 <
    nu <= 0.5, of a material; ``wear_coefficient`` in m²/N.

    A viscoelastic one has a ``relaxation`` of Young's modulus, whose value is then that of the
    first instant; ``elastic_bulk`` and ``shift`` (with ``shift_source``) as of ``Viscoelastic``.
    Hardening is linear with ``hardening_modulus`` in Pa, of Swift with ``swift_exponent`` and
    ``swift_strain``, or of Voce with ``voce_gain`` in Pa and ``voce_rate``; ``kinematic`` in Pa and
    ``recall`` are those of the back stress. ``thermal_conductivity`` is in W/(m K),
    ``electrical_resistivity`` in Ω m, ``volumetric_heat_capacity`` in J/(m³ K),
    ``thermal_expansion`` in 1/K.
    """

    youngs_modulus: Annotated[Sourced, "pressure"]
    poisson_ratio: Annotated[Sourced, "ratio"]
    hardness: Annotated[Sourced | None, "hardness"] = None
    yield_stress: Annotated[Sourced | None, "pressure"] = None
    relaxation: Relaxation | None = None
    elastic_bulk: bool = False
    shift: TemperatureShift | None = None
    shift_source: str = ""
    hardening_modulus: Annotated[Sourced | None, "pressure"] = None
    swift_exponent: Annotated[Sourced | None, "number"] = None
    swift_strain: Annotated[Sourced | None, "number"] = None
    voce_gain: Annotated[Sourced | None, "pressure"] = None
    voce_rate: Annotated[Sourced | None, "number"] = None
    kinematic: Annotated[Sourced | None, "pressure"] = None
    recall: Annotated[Sourced | None, "number"] = None
    wear_coefficient: Annotated[Sourced | None, "wear coefficient"] = None
    thermal_conductivity: Annotated[Sourced | None, "thermal conductivity"] = None
    electrical_resistivity: Annotated[Sourced | None, "electrical resistivity"] = None
    volumetric_heat_capacity: Annotated[Sourced | None, "volumetric heat capacity"] = None
    thermal_expansion: Annotated[Sourced | None, "thermal expansion"] = None
    noun: ClassVar[str] = "material"
    more: ClassVar[tuple[str, ...]] = ("elastic_bulk", "shift")

    @property
    def hardening(self) -> Hardening | None:
        """Law of hardening that is given, from the yield stress.

        InputError if it lacks a value, more than one law is given, or the yield stress is not
        known.
        """
        laws: dict[str, tuple[str, ...]] = {
            "linear": ("hardening_modulus",),
            "Swift": ("swift_exponent", "swift_strain"),
            "Voce": ("voce_gain", "voce_rate"),
        }
        given = {law: [key for key in keys if getattr(self, key) is not None] for law, keys in laws.items()}
        named = [law for law, keys in given.items() if keys]
        if not named:
            return None
        missing = [key for key in laws[named[0]] if key not in given[named[0]]] + (
            ["yield_stress"] if self.yield_stress is None else []
        )
        if len(named) > 1 or missing:
            received = f"{' and '.join(named)}" if len(named) > 1 else f"{named[0]} without {' and '.join(missing)}"
            raise InputError(
                f"hardening of material {self.name!r} must be one law with all its values and a yield stress, "
                f"but is {received}."
            )
        first = self.values["yield_stress"].value
        numbers = [self.values[key].value for key in laws[named[0]]]
        if named[0] == "linear":
            return LinearHardening(first, numbers[0])
        return Swift(first, numbers[1], numbers[0]) if named[0] == "Swift" else Voce(first, *numbers)

    @property
    def body(self) -> Elastic:
        """Half-space of this material, with name, strength and one source a value."""
        strength = Strength(
            hardness=self.hardness.value if self.hardness else math.nan,
            yield_stress=self.yield_stress.value if self.yield_stress else math.nan,
            hardening=self.hardening,
            kinematic=self.kinematic.value if self.kinematic else 0.0,
            recall=self.recall.value if self.recall else 0.0,
            wear_coefficient=self.wear_coefficient.value if self.wear_coefficient else math.nan,
        )
        conducting = tuple(item.name for item in fields(Conduction))
        conduction = Conduction(**{key: item.value for key, item in self.values.items() if key in conducting})
        if self.relaxation is None:
            constants = self.youngs_modulus.value, self.poisson_ratio.value
            return Elastic(*constants, strength, name=self.name, sources=self.sources, conduction=conduction)
        sources = (*self.sources, *([f"shift: {self.shift_source}"] if self.shift_source else []))
        return Viscoelastic.prony(
            self.relaxation.relaxed,
            self.relaxation.terms,
            self.poisson_ratio.value,
            strength=strength,
            name=self.name,
            sources=sources,
            conduction=conduction,
            elastic_bulk=self.elastic_bulk,
            shift=self.shift,
        )

    @classmethod
    def _of(cls, table: Any, name: str, where: str) -> Self:
        """The record ``name`` of a table, with what makes it viscoelastic."""
        if not isinstance(table, dict):
            return super()._of(table, name, where)
        plain, more = dict(table), dict[str, Any]()
        modulus = table.get("youngs_modulus")
        text = modulus.get("value") if isinstance(modulus, dict) else modulus
        if isinstance(text, str) and AT in text:
            series = more["relaxation"] = series_of(text, f"youngs_modulus {where}")
            first = f"{series.instantaneous!r} Pa"
            plain["youngs_modulus"] = {**modulus, "value": first} if isinstance(modulus, dict) else first
        bulk = plain.pop("elastic_bulk", False)
        if not isinstance(bulk, bool):
            raise InputError(f"elastic_bulk {where} must be true or false, but is {bulk!r}.")
        entry = plain.pop("shift", None)
        if entry is not None:
            entry = entry if isinstance(entry, dict) else {"value": entry}
            more["shift"] = shift_of(str(entry.get("value", "")), f"shift {where}")
            more["shift_source"] = str(entry.get("source", "user"))
        if "relaxation" not in more and (bulk or entry is not None):
            key = "elastic_bulk" if bulk else "shift"
            raise InputError(
                f"{key} {where} must be given with a youngs_modulus that relaxes, such as 3MPa+10MPa@10ms, but "
                "it does not."
            )
        return replace(super()._of(plain, name, where), elastic_bulk=bulk, **more)


def materials(path: str | Path | None = None) -> Records[MaterialRecord]:
    """All materials: the built-in ones, and those of the TOML file at ``path`` if given, whose
    names and aliases win.

    Keys of a material are ``youngs_modulus`` and ``poisson_ratio`` (required), ``hardness``,
    ``yield_stress``, those of hardening (``MaterialRecord``), ``wear_coefficient``,
    ``thermal_conductivity``, ``electrical_resistivity``, ``volumetric_heat_capacity``,
    ``thermal_expansion``, ``aliases`` and ``note``; a value is text with a unit
    (``"140 GPa"``) or ``{ value = "140 GPa", source = "..." }``, the source being "user" by
    default. A modulus such as ``"3 MPa + 10 MPa @ 10 ms"`` relaxes;
    ``elastic_bulk = true`` and ``shift``, such as ``"WLF 298 K; 8.86; 101.6 K"`` or
    ``"Arrhenius 298 K; 80 kJ/mol"``, may stand beside it.

    InputError if the file is missing or not TOML, or a key or value in it cannot be used.
    """
    return MaterialRecord.all(path)


def material(name: str, *, library: str | Path | None = None) -> Elastic:
    """Half-space of the material ``name`` (or alias, in any case) from the built-in list or the
    file ``library``.

    InputError if no material has that name, with the nearest names, or if the file cannot be used
    (see ``materials``).
    """
    return MaterialRecord.find(name, library).body


def full_name(name: str) -> str:
    """Name of the built-in material that is also called ``name``, in any case; ``name`` itself if
    there is none."""
    return next((record.name for record in MaterialRecord.all() if _normal(name) in record.keys), name)


@dataclass(frozen=True)
class Liquid:
    """What a film between surfaces needs of its liquid.

    InputError if a value is not positive.

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
        """Molar volume in m³/mol. InputError if it is not known."""
        if math.isnan(self.molar_volume):
            raise InputError(
                f"molar volume of {self.name or 'the liquid'} must be known for menisci at a humidity, but is not. "
                "Give the film thickness and the meniscus height instead; lubricants have hardly any vapour."
            )
        return self.molar_volume

    @property
    def adsorbs_as_water(self) -> bool:
        """Whether the empirical film of water on carbon holds for it."""
        return self.name == "water"


@dataclass(frozen=True, kw_only=True)
class LiquidRecord(Record):
    """Surface tension (N/m), temperature (K), molar volume (m³/mol) and viscosity (Pa s), all > 0,
    of a liquid."""

    surface_tension: Annotated[Sourced, "surface tension"]
    temperature: Annotated[Sourced, "temperature"]
    molar_volume: Annotated[Sourced | None, "molar volume"] = None
    viscosity: Annotated[Sourced | None, "viscosity"] = None
    noun: ClassVar[str] = "liquid"

    @property
    def liquid(self) -> Liquid:
        """The liquid, with name and one source a value."""
        numbers = {key: item.value for key, item in self.values.items()}
        return Liquid(**numbers, name=self.name, sources=self.sources)


def liquids(path: str | Path | None = None) -> Records[LiquidRecord]:
    """All liquids: the built-in ones, and those of the TOML file at ``path`` if given, whose names
    and aliases win.

    The file has tables ``[liquid."name"]`` with ``surface_tension`` and ``temperature`` (required),
    ``molar_volume``, ``viscosity``, ``aliases`` and ``note``; values as for ``materials``
    (``"72 mN/m"``).

    InputError if the file is missing or not TOML, or a key or value in it cannot be used.
    """
    return LiquidRecord.all(path)


def liquid(name: str, *, library: str | Path | None = None) -> Liquid:
    """Liquid ``name`` (or alias, in any case) from the built-in list or the file ``library``.

    InputError if no liquid has that name, with the nearest names, or if the file cannot be used
    (see ``liquids``).
    """
    return LiquidRecord.find(name, library).liquid
